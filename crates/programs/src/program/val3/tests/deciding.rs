//! Decisions by numbers of points.

use super::*;
use crate::program::deciding::shown;

fn by(code: &str) -> Vec<String> {
    let points = data("pA", "pointRx", &["key=\"0\" x=\"500\" fatherId=\"fA[0]\""])
        + &data(
            "pB",
            "pointRx",
            &[
                "key=\"0\" y=\"2\" fatherId=\"fA[0]\"",
                "key=\"1\" y=\"3\" fatherId=\"fA[0]\"",
            ],
        )
        + &data("pC", "pointRx", &["key=\"0\" y=\"2\" fatherId=\"fA[0]\""]);
    let moves = "movej(pA,tA,m)\nmovel(pB[0],tA,m)\nmovel(pB[1],tA,m)";
    shown(&project(&points, &format!("{moves}\n{code}")))
}

#[test]
fn numbers_of_points_that_moves_use_decide() {
    for (code, expected) in [
        ("if pA.trsf.z>=300\nput(1)\nendIf", &["pA"][..]),
        (
            "if (bX and distance(pA,pB[1])>3)\nput(1)\nendIf",
            &["pA", "pB[1]"],
        ),
        ("nZ=pA[0].trsf.z\nwhile nZ>3\nput(1)\nendWhile", &["pA>"]),
        (
            "nD=distance(pA,pB[1])\nfor nI=0 to nD\nput(1)\nendFor",
            &["pA>", "pB[1]>"],
        ),
        ("trX=pB[1].trsf\nif trX.x>3\nput(1)\nendIf", &["pB[1]>"]),
        (
            "switch round(pB[nI].trsf.x)\ncase 1\nput(1)\nbreak\nendSwitch",
            &["pB"],
        ),
    ] {
        assert_eq!(by(code), expected, "{code}");
    }
}

#[test]
fn what_is_followed_or_never_rewritten_decides_nothing() {
    for code in [
        "if pC.trsf.z>=300\nput(1)\nendIf",
        "if bX\nmovel(appro(pA,{0,0,pA.trsf.z,0,0,0}),tA,m)\nendIf",
        "pC=pA\npC.trsf.z=pA.trsf.z+5\nif bX\nmovel(pC,tA,m)\nendIf",
        "nI=movel(pA,tA,m)\nif nI>3\nput(pA.trsf.x)\nendIf",
        "// if pA.trsf.z>=300\nif bX\nput(1)\nendIf",
    ] {
        assert_eq!(by(code), [""; 0], "{code}");
    }
}
