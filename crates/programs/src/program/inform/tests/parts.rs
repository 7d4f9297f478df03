//! What instructions add to copies of positions.

use super::*;
use crate::geometry::units::MM;
use crate::program::{Displacement, Shift};

/// What displaces the point of the last move.
fn displaced(instructions: &str) -> Displacement {
    let positions = format!("{USER}P00001={P6}\nP00002=0,0,200,0,0,0\nP00004=0,0,9,0,0,45");
    let text = format!("SET LP001 P001\n{instructions}\nMOVL LP001 V=5");
    let program = read(&job(&positions, &text));
    // behind a condition, too
    let mut moves = program.moves.iter().rev();
    let motion = moves
        .find(|motion| motion.displacement != Displacement::None)
        .expect("a move");
    let target = program.target_of(motion).expect("a copy of a target");
    assert_eq!(target.name.as_deref(), Some("P001"), "{instructions}");
    motion.displacement.clone()
}

fn up(by_mm: f64) -> Displacement {
    Displacement::By(Box::new(Shift::along([0.0, 0.0, by_mm * MM])))
}

#[test]
fn a_position_of_the_files_displaces_a_copy_by_its_numbers() {
    assert_eq!(displaced("ADD LP001 P002"), up(200.0));
    assert_eq!(displaced("SUB LP001 P002"), up(-200.0));
}

#[test]
fn what_only_the_robot_knows_displaces_a_copy_as_a_sensor_does() {
    for text in ["ADD LP001 P003", "GETS PX003 $PX002\nADD LP001 P003"] {
        assert_eq!(displaced(text), Displacement::Unknown, "{text}");
    }
}

#[test]
fn what_the_text_tells_and_is_not_followed_has_no_bound() {
    for text in [
        "SETE P002 (3) 100000\nADD LP001 P002",
        "ADD P002 P002\nADD LP001 P002",
        "SET P003 P002\nADD LP001 P003",
        "SUB P003 P002\nADD LP001 P003",
        "ADD LP001 P004",
        "ADD LP001 P004 IF IN#(1)=ON",
        "ADD LP001 LP001",
        "ADD LP001 P[B000]",
        "MUL LP001 (3) 2",
        "GETE D005 P001 (3)\nADD D005 200000\nSETE LP001 (3) D005",
        // moves go to what is added
        "MOVL P002 V=5\nADD LP001 P002",
        "SET LP002 P002\nMOVL LP002 V=5\nADD LP001 P002",
    ] {
        assert_eq!(displaced(text), Displacement::Unbounded, "{text}");
    }
    // numbers that are no more than numbers
    assert_eq!(
        displaced("SET D005 200000\nSETE LP001 (3) D005"),
        Displacement::Overwritten
    );
}
