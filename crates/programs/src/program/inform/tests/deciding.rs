//! Decisions by numbers of position variables.

use super::*;
use crate::program::deciding::shown;

fn by(instructions: &str) -> Vec<String> {
    let positions = format!("///NPOS 1,0,0,2,0,0\n{USER}C00000={P6}\nP00001={P6}\nP00002={P6}");
    let moves = "MOVJ C00000 VJ=1.00\nMOVL P001 V=10.0";
    shown(&read(&job(&positions, &format!("{moves}\n{instructions}"))))
}

#[test]
fn numbers_of_positions_that_moves_use_decide() {
    for (instructions, expected) in [
        (
            "GETE D000 P001 (3)\nIFTHEN D000>300000\nTIMER T=1.00\nENDIF",
            &["P001>"][..],
        ),
        (
            "GETE D000 P001 (3)\nSET D001 D000\nADD D001 5\nJUMP *A IF D001>3\n*A",
            &["P001>"],
        ),
        (
            "SET P003 P001\nGETE D000 P003 (1)\nWHILE D000<5\nINC D000\nENDWHILE",
            &["P001>"],
        ),
    ] {
        assert_eq!(by(instructions), expected, "{instructions}");
    }
}

#[test]
fn what_is_followed_or_never_rewritten_decides_nothing() {
    for instructions in [
        "GETE D000 P002 (3)\nIFTHEN D000>300000\nTIMER T=1.00\nENDIF",
        "GETE D000 P001 (3)\nIFTHEN D001>300000\nTIMER T=1.00\nENDIF",
        "GETE D000 P001 (3)\nSETE P003 (3) D000\nJUMP *A IF IN#(1)=ON\n*A",
        "GETE D000 P001 (3)\n'JUMP *A IF D000>3\nJUMP *A IF IN#(1)=ON\n*A",
    ] {
        assert_eq!(by(instructions), [""; 0], "{instructions}");
    }
}
