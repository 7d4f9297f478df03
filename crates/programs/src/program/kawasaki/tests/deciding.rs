//! Decisions by numbers of transformations.

use super::*;
use crate::program::deciding::shown;

fn by(lines: &str) -> Vec<String> {
    let moves = "TOOL grip\nBASE NULL\nJMOVE #home\nLMOVE p1\nLMOVE p[1]\nLMOVE p[2]";
    shown(&read(&format!("{moves}\n{lines}")))
}

#[test]
fn numbers_of_points_that_moves_use_decide() {
    for (lines, expected) in [
        ("IF DZ(p1)>=300 THEN\nTWAIT 1\nEND", &["p1"][..]),
        ("z = DZ(p1)\nIF z>=300 THEN\nTWAIT 1\nEND", &["p1>"]),
        (
            "GOTO 10 IF DISTANCE(p1,p[1])>100\n10 TWAIT 1",
            &["p1", "p[1]"],
        ),
        (
            "n = INT((DX(p[1])-DX(p[2]))/50)\nFOR i = 0 TO n\nTWAIT 1\nEND",
            &["p[1]>", "p[2]>"],
        ),
        ("IF DX(p[i])>3 THEN\nTWAIT 1\nEND", &["p"]),
        (
            "POINT q = SHIFT(p1 BY 1,2,3)\nIF DX(q)>3 THEN\nTWAIT 1\nEND",
            &["p1"],
        ),
        (
            "CALL up(p1)\n.END\n.PROGRAM up(.p)\nIF DZ(.p)>3 THEN\nTWAIT 1\nEND",
            &["p1"],
        ),
    ] {
        assert_eq!(by(lines), expected, "{lines}");
    }
}

#[test]
fn what_is_followed_or_never_rewritten_decides_nothing() {
    for lines in [
        // refused
        "DECOMPOSE x[0]=p1\nIF x[2]>3 THEN\nTWAIT 1\nEND",
        "IF DZ(off)>=300 THEN\nTWAIT 1\nEND",
        "IF SIG(1) THEN\nLMOVE SHIFT(p1 BY DX(p1),0,0)\nEND",
        "POINT q = HERE\nIF DZ(q)>3 THEN\nTWAIT 1\nEND",
        "z = DZ(p1)\nIF SIG(1) THEN\nPRINT z\nEND",
        "; IF DZ(p1)>3 THEN\nIF a THEN\nTWAIT 1\nEND",
        "IF EXISTTRANS(p1) THEN\nz = DX(off)\nEND",
    ] {
        assert_eq!(by(lines), [""; 0], "{lines}");
    }
}
