//! What instructions add to copies of positions.

use super::*;
use crate::geometry::units::MM;
use crate::program::{Displacement, Shift, Stride};

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
    for (text, by) in [
        ("SETE P002 (3) 100000\nADD LP001 P002", 100.0),
        ("SET P003 P002\nADD LP001 P003", 200.0),
        (
            "SET P003 P002\nSUB P003 P002\nSUB P003 P002\nADD LP001 P003",
            -200.0,
        ),
        (
            "SETE P002 (3) 5000\nSET P003 P002\nSETE P002 (3) 0\nADD P003 P003\nADD LP001 P003",
            10.0,
        ),
        ("SET D000 -5000\nSETE P002 (3) D000\nADD LP001 P002", -5.0),
        (
            "SET D000 7\nSET D001 EXPRESS D000 * ( 2 + 1 )\nMUL D001 1000\nDEC D001\nSUB D001 999\n\
             SETE P002 (3) D001\nADD LP001 P002",
            20.0,
        ),
    ] {
        assert_eq!(displaced(text), up(by), "{text}");
    }
}

/// In the coordinates of another frame it is displaced along the axes of that one.
#[test]
fn what_displaces_a_position_in_other_coordinates_has_no_bound() {
    for text in [
        "CNVRT LPX001 LPX001 BF\nADD LP001 P002",
        "CNVRT LPX001 PX001 UF#(5)\nSUB LP001 P002",
        "CNVRT PX009 PX001 RF\nSET LP001 P009\nADD LP001 P002",
        "CNVRT LPX001 PX001 BF\nGETE D005 LP001 (3)\nADD D005 200000\nSETE LP001 (3) D005",
    ] {
        assert_eq!(displaced(text), Displacement::Unbounded, "{text}");
    }
    // another position in other coordinates
    assert_eq!(displaced("CNVRT PX009 PX004 BF\nADD LP001 P002"), up(200.0));
}

#[test]
fn a_number_of_a_position_and_something_more_displaces() {
    for text in [
        "GETE D005 P001 (3)\nADD D005 200000\nSETE LP001 (3) D005",
        "GETE D005 LP001 (3)\nADD D005 200000\nSETE LP001 (3) D005",
        "GETE LD005 LP001 (3)\nSET D001 150000\nADD LD005 D001\nADD LD005 50000\nSETE LP001 (3) LD005",
        "GETE D005 LP001 (3)\nSETE LP001 (3) EXPRESS\nSET LP001 P001\nGETE D005 LP001 (3)\n\
         SET D006 EXPRESS D005 + 200000\nSETE LP001 (3) D006",
    ] {
        assert_eq!(displaced(text), up(200.0), "{text}");
    }
    for text in [
        // another number of it, twice, a half, behind a label, after the position has changed
        "GETE D005 LP001 (2)\nADD D005 200000\nSETE LP001 (3) D005",
        "GETE D005 LP001 (3)\nADD D005 D005\nSETE LP001 (3) D005",
        "GETE D005 LP001 (3)\nDIV D005 2\nSETE LP001 (3) D005",
        "GETE D005 LP001 (3)\n*L\nADD D005 200000\nSETE LP001 (3) D005",
        "GETE D005 LP001 (3)\nCALL JOB:X\nADD D005 200000\nSETE LP001 (3) D005",
        "GETE D005 LP001 (3)\nSET LP001 P001\nSETE LP001 (3) D005",
    ] {
        assert_eq!(displaced(text), Displacement::Unbounded, "{text}");
    }
}

#[test]
fn numbers_that_loops_count_displace_as_far_as_these_run() {
    let most = |text: &str| match displaced(text) {
        Displacement::Within(strides) => {
            let each = strides.iter().map(|stride| match stride {
                Stride::By { shift, most } => {
                    let most = most.map_or(f64::INFINITY, f64::from);
                    shift.in_frame.translation[2].abs() * most
                }
                _ => panic!("along z"),
            });
            each.sum::<f64>() / MM
        }
        other => panic!("{text}: {other:?}"),
    };
    let go = "SETE P002 (3) D000\nSET LP001 P001\nADD LP001 P002\nMOVL LP001 V=5";
    for (text, wanted) in [
        // with what the files have: 200
        (
            format!("FOR B000= 1 TO 4\nSET D000 EXPRESS B000 * 100000\n{go}\nNEXT B000"),
            400.0,
        ),
        (
            format!("SET D000 0\nFOR I000 = 1 TO 5\n{go}\nADD D000 100000\nNEXT I000"),
            500.0,
        ),
        (
            format!("SET D000 0\nWHILE D000<300000\n{go}\nADD D000 100000\nENDWHILE"),
            300.0,
        ),
        (
            format!("SET D000 0\nWHILE D000<=300000\n{go}\nADD D000 100000\nENDWHILE"),
            400.0,
        ),
        (
            format!("SET D000 0\n*L\n{go}\nADD D000 100000\nJUMP *L IF D000<300000"),
            300.0,
        ),
        (
            format!(
                "SET D000 0\n*L\n{go}\nADD D000 100000\nJUMP *L IFEXPRESS (D000<300000 AND \
                 IN#(1)=ON)"
            ),
            300.0,
        ),
        (
            format!(
                "SET D000 0\nSET B000 0\n*L\n{go}\nADD D000 100000\nINC B000\nJUMP *L IF B000<3"
            ),
            300.0,
        ),
        (
            format!(
                "SET B000 0\n*L\nJUMP *E IF B000>=4\nSET D000 EXPRESS B000 * 100000\n{go}\nINC \
                 B000\nJUMP *L\n*E"
            ),
            400.0,
        ),
        (
            format!(
                "SET D000 0\n*L\n{go}\nADD D000 100000\nIFTHEN D000>=300000\nSET D000 0\nENDIF\nJUMP *L"
            ),
            300.0,
        ),
    ] {
        let found = most(&text);
        assert!((found - wanted).abs() < 1e-6, "{text}: {found}");
    }
    for text in [
        // nothing bounds the loop, or sets it anew; the counter changes
        format!("SET D000 0\n*L\n{go}\nADD D000 100000\nJUMP *L IF D001<300000"),
        format!("*L\n{go}\nADD D000 100000\nJUMP *L IF D000<300000\nSET D000 0\nJUMP *L"),
        format!("SET D000 0\n*L\n{go}\nADD D000 100000\nJUMP *L IF IN#(1)=ON"),
        format!("FOR I000 = 1 TO 5\n{go}\nADD D000 100000\nNEXT I000"),
        format!("SET D000 0\nFOR I000 = 1 TO 5\n{go}\nADD D000 100000\nDEC I000\nNEXT I000"),
        format!("SET D000 0\nWHILE IN#(1)=ON\n{go}\nINC D000\nENDWHILE"),
    ] {
        let found = displaced(&text);
        let is_bounded = match &found {
            Displacement::Within(strides) => strides
                .iter()
                .all(|stride| matches!(stride, Stride::By { most: Some(_), .. })),
            Displacement::None | Displacement::By(_) => true,
            _ => false,
        };
        assert!(!is_bounded, "{text}: {found:?}");
    }
}

/// What displaces each move, and the ids of errors; positions in these header lines.
fn shifted(head: &str, instructions: &str) -> (Vec<Displacement>, Vec<String>) {
    let positions = format!(
        "{head}{}P00002=0,0,200,0,0,0\nP00004=0,0,9,0,0,45",
        points(2)
    );
    let program = read(&job(&positions, instructions));
    let errors = program.findings.iter();
    let errors = errors.filter(|of| of.severity == crate::finding::Severity::Error);
    (
        program
            .moves
            .iter()
            .map(|of| of.displacement.clone())
            .collect(),
        errors.map(|of| of.id.to_owned()).collect(),
    )
}

#[test]
fn a_shift_of_the_text_displaces_moves_until_it_is_off() {
    let none = || Displacement::None;
    let two = "MOVL C00000 V=5\n";
    for (instructions, wanted) in [
        (
            format!("{two}SFTON P002 UF#(12)\n{two}SFTOF\n{two}"),
            vec![none(), up(200.0), none()],
        ),
        (
            format!("SETE P002 (3) -50000\nSFTON P002 UF#(12)\n{two}"),
            vec![up(-50.0)],
        ),
        (
            format!(
                "SETE P002 (3) 9000\nSFTON P002 UF#(12)\n{two}SETE P002 (3) 0\nSFTON P002 \
                 UF#(12)\n{two}"
            ),
            vec![up(9.0), none()],
        ),
        (
            format!("IFTHEN IN#(1)=ON\nSFTON P002 UF#(12)\nENDIF\n{two}SFTOF"),
            vec![none(), up(200.0)],
        ),
    ] {
        let (mut found, errors) = shifted(USER, &instructions);
        if instructions.starts_with("IF") && found[0] != none() {
            found.reverse();
        }
        assert_eq!((found, errors), (wanted, vec![]), "{instructions}");
    }
    // what is copied and added up
    for (text, by) in [
        ("SET P003 P002\nSFTON P003 UF#(12)", 200.0),
        ("SET P003 P002\nADD P003 P002\nSFTON P003 UF#(12)", 400.0),
        ("SET P003 P002\nSUB P003 P006\nSFTON P003 UF#(12)", 170.0),
    ] {
        let head = format!("{USER}P00006=0,0,30,0,0,0\n");
        let (found, errors) = shifted(&head, &format!("{text}\n{two}"));
        assert_eq!((found, errors), (vec![up(by)], vec![]), "{text}");
    }
    // a job of its own switches it on, with what it is given
    let base = "///TOOL 3\n///POSTYPE BASE\n///RECTAN\n///RCONF 1,0,0,0,0,0,0,0\n";
    let main = job(
        &format!("{base}{}", points(1)),
        &format!("CALL JOB:ON ARGF250\n{two}"),
    );
    let on = "GETARG LD000 IARG#(1)\nMUL LD000 1000\nSETE P009 (1) 0\nSETE P009 (2) 0\nSETE P009 \
        (3) LD000\nSETE P009 (4) 0\nSETE P009 (5) 0\nSETE P009 (6) 0\nSFTON P009 BF";
    let on = job("", on).replace("//NAME A", "//NAME ON");
    let program = read_files(&[&main, &on], &Settings::default()).expect("jobs");
    let last = program.moves.last().expect("a move");
    assert_eq!(last.displacement, up(250.0), "{:?}", program.findings);
    // in the base, whether it says so or not
    for frame in ["", " BF", " RF"] {
        let text = format!("SFTON P002{frame}\n{two}");
        assert_eq!(shifted(base, &text), (vec![up(200.0)], vec![]), "{frame}");
    }
}

#[test]
fn a_shift_of_external_axes_moves_these() {
    let settings = |listed: &[&str]| Settings {
        external: crate::program::ExternalNames {
            listed: listed.iter().map(|&name| name.into()).collect(),
            linear: listed.iter().map(|name| name.starts_with('B')).collect(),
            pulses: vec![None; listed.len()],
            ..crate::program::ExternalNames::default()
        },
        ..Settings::default()
    };
    let base = "///TOOL 3\n///POSTYPE BASE\n///RECTAN\n///RCONF 1,0,0,0,0,0,0,0\n";
    let positions = format!(
        "{base}{}P00002=0,0,200,0,0,0\nBP00001=500.000\nEX00001=0.000\nBC00000=100.000",
        points(1)
    );
    let text = "MOVL C00000 BC00000 V=5\nSFTON P002 BP001 EX001 BF\nMOVL C00000 BC00000 \
        V=5\nSFTOF\nMOVL C00000 BC00000 V=5";
    let read =
        |listed: &[&str]| read_files(&[&job(&positions, text)], &settings(listed)).expect("a job");
    let program = read(&["BC1"]);
    let shifts = program.moves.iter().map(|of| of.displacement.clone());
    let wanted = [Displacement::None, up(200.0), Displacement::None];
    assert!(shifts.eq(wanted), "{:?}", program.findings);
    let offsets = program.moves.iter().map(|of| {
        let at = (of.external_state as usize).checked_sub(1);
        at.map_or(0.0, |at| program.external_states[at].offset[0])
    });
    assert!(offsets.eq([0.0, 500.0, 0.0]));
    // of an axis that nobody knows it is refused
    let program = read(&[]);
    assert!(ids(&program).contains(&"displacement-active"));
}

#[test]
fn a_shift_that_is_not_followed_refuses_moves() {
    let go = "MOVL C00000 V=5";
    for shift in [
        "SFTON P002",
        "SFTON P002 BF",
        "SFTON P002 TF",
        "SFTON P002 UF#(3)",
        "SFTON P004 UF#(12)",
        "SFTON P003 UF#(12)",
        "SFTON P[B000] UF#(12)",
        "SFTON3D P002 UF#(12)",
        "GETS PX002 $PX001\nSFTON P002 UF#(12)",
        "SETE P002 (3) D000\nSFTON P002 UF#(12)",
        "SET P003 P004\nSFTON P003 UF#(12)",
        "SET P003 P002\nMOVL P002 V=5\nSFTON P003 UF#(12)",
        "SET P003 P002\nADD P003 P005\nSFTON P003 UF#(12)",
        "SFTON P002 BP001 UF#(12)",
        "SFTON P002 EX[B000] UF#(12)",
        "MOVL P002 V=5\nSFTON P002 UF#(12)",
    ] {
        let (_, errors) = shifted(USER, &format!("{shift}\n{go}"));
        assert_eq!(
            errors.first().map(String::as_str),
            Some("displacement-active"),
            "{shift}"
        );
    }
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
        // from run to run
        "ADD P002 P002\nADD LP001 P002",
        "ADD LP001 P004",
        "ADD LP001 P004 IF IN#(1)=ON",
        "ADD LP001 LP001",
        "ADD LP001 P[B000]",
        "MUL LP001 (3) 2",
        // moves go to what is added
        "MOVL P002 V=5\nADD LP001 P002",
        "SET LP002 P002\nMOVL LP002 V=5\nADD LP001 P002",
    ] {
        assert_eq!(displaced(text), Displacement::Unbounded, "{text}");
    }
    let Displacement::AtLeast(strides) = displaced("SUB P003 P002\nADD LP001 P003") else {
        panic!("what P003 is before is not known");
    };
    let adds_up = |stride: &Stride| matches!(stride, Stride::By { most: None, .. });
    assert!(strides.iter().any(adds_up));
    // numbers that are no more than numbers
    assert_eq!(
        displaced("SET D005 200000\nSETE LP001 (3) D005"),
        Displacement::Overwritten
    );
}
