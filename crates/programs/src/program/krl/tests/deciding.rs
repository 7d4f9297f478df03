//! Decisions by numbers of points.

use super::*;
use crate::program::deciding::shown;

fn by(statements: &str) -> Vec<String> {
    shown(&path(&format!("PTP XP1\nLIN XP2\n{statements}")))
}

#[test]
fn numbers_of_points_that_moves_use_decide() {
    for (statements, expected) in [
        ("IF XP1.Z>=300 THEN\nHALT\nENDIF", &["XP1"][..]),
        (
            "IF ($IN[1]==TRUE) AND (xp1.z>XP2.z) THEN\nHALT\nENDIF",
            &["XP1", "XP2"],
        ),
        ("z=XP1.Z\nIF z>=300 THEN\nHALT\nENDIF", &["XP1>"]),
        ("n=XP1.X/50\nFOR i=1 TO n\nHALT\nENDFOR", &["XP1>"]),
        ("WHILE XP2.Y<i\ni=i-1\nENDWHILE", &["XP2"]),
        (
            "high(XP2)\nEND\nDEF high(p:IN)\nIF p.Z>3 THEN\nHALT\nENDIF",
            &["XP2"],
        ),
    ] {
        assert_eq!(by(statements), expected, "{statements}");
    }
}

#[test]
fn what_is_followed_or_never_rewritten_decides_nothing() {
    for statements in [
        "IF XP3.Z>=300 THEN\nHALT\nENDIF",
        "IF $POS_ACT.Z>=300 THEN\nHALT\nENDIF",
        "XP3=XP1\nXP3.Z=XP1.Z+50\nIF $IN[1] THEN\nLIN XP3\nENDIF",
        "IF XP1.E1>=300 THEN\nHALT\nENDIF",
        "; IF XP1.Z>3 THEN\nIF a THEN\nHALT\nENDIF",
        "up()\nIF z>3 THEN\nHALT\nENDIF\nEND\nDEF up()\nDECL REAL z\nz=XP1.Z",
    ] {
        assert_eq!(by(statements), [""; 0], "{statements}");
    }
}
