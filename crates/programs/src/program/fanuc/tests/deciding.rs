//! Decisions by numbers of points.

use super::*;
use crate::program::deciding::shown;

fn by(lines: &[&str]) -> Vec<String> {
    let moves = ["J P[1] 100% FINE", "L P[2:above] 9mm/sec FINE"];
    let all = moves.iter().chain(lines).enumerate();
    let text: String = all
        .map(|(at, line)| format!("{:4}:  {line} ;\n", at + 1))
        .collect();
    shown(&read(
        &text,
        &(usual("1") + &usual("2:\"above\"") + &usual("3")),
    ))
}

#[test]
fn numbers_of_points_that_moves_use_decide() {
    for (lines, expected) in [
        (
            &[
                "PR[1]=P[1]",
                "R[1:height]=PR[1,3]",
                "IF R[1]>=300,JMP LBL[1]",
                "LBL[1]",
            ][..],
            &["P[1]>"][..],
        ),
        (
            &["PR[1:x]=P[2]", "IF (PR[1,3]>300) THEN", "ENDIF"],
            &["P[2]"],
        ),
        (
            &[
                "PR[1]=P[1]",
                "R[1]=PR[1,1] DIV 50",
                "FOR R[2]=1 TO R[1]",
                "ENDFOR",
            ],
            &["P[1]>"],
        ),
        (
            &[
                "PR[1]=P[1]",
                "R[1]=PR[1,1]",
                "L P[R[1]] 9mm/sec FINE",
                "JMP LBL[1]",
                "LBL[1]",
            ],
            &["P[1]>"],
        ),
    ] {
        assert_eq!(by(lines), expected, "{lines:?}");
    }
}

#[test]
fn what_is_followed_or_never_rewritten_decides_nothing() {
    for lines in [
        &["PR[1]=P[3]", "IF PR[1,3]>=300,JMP LBL[1]", "LBL[1]"][..],
        &["PR[1]=LPOS", "IF PR[1,3]>=300,JMP LBL[1]", "LBL[1]"],
        &[
            "PR[1]=P[1]",
            "PR[1,3]=PR[1,3]+50",
            "IF DI[1]=ON,JMP LBL[1]",
            "LBL[1]",
            "L PR[1] 9mm/sec FINE",
        ],
        &[
            "PR[1]=P[1]",
            "R[1]=PR[1,3]",
            "!IF R[1]>3",
            "IF R[2]=1,JMP LBL[1]",
            "LBL[1]",
        ],
    ] {
        assert_eq!(by(lines), [""; 0], "{lines:?}");
    }
}
