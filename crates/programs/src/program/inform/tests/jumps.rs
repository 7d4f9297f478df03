//! Where jobs may go on: jumps, calls and returns with a condition, jumps by a number, traps.

use super::*;
use crate::program::Before;

/// Whether each move of the job `A` is refused for a shift that may be on; `OFF` switches it off.
fn shifted(instructions: &str) -> Vec<bool> {
    let main = job(&format!("{USER}{}", points(3)), instructions);
    let off = job("", "SFTOF").replace("//NAME A", "//NAME OFF");
    let on = job("", "SFTON P001\nRET IFEXPRESS (B000=1)\nSFTOF").replace("//NAME A", "//NAME ON");
    let program = read_files(&[&main, &off, &on], &Settings::default()).expect("jobs");
    let moves = program.moves.iter();
    let targets = moves.filter_map(|m| program.target_of(m));
    targets.map(|target| target.blocked).collect()
}

#[test]
fn a_condition_of_any_form_leaves_both_ways_open() {
    for tail in [
        "IF IN#(1)=ON",
        "IFEXP IN#(1)=ON AND IN#(2)=ON",
        "IFEXPRESS (IN#(1)=ON AND IN#(2)=ON)",
        "IFEXPRESS(B000=1)",
        "SOMETIMES",
    ] {
        let over = format!("SFTON P001\nJUMP *E {tail}\nSFTOF\n*E\nMOVL C00000");
        assert_eq!(shifted(&over), [true], "{tail}");
        let on = format!("JUMP *E {tail}\nSFTON P001\n*E\nMOVL C00000");
        assert_eq!(shifted(&on), [true], "{tail}");
        let call = format!("SFTON P001\nCALL JOB:OFF {tail}\nMOVL C00000");
        assert_eq!(shifted(&call), [true], "{tail}");
        let away = format!("SFTON P001\nJUMP JOB:OFF {tail}\nMOVL C00000");
        assert_eq!(shifted(&away), [true], "{tail}");
        let back = format!("MOVL C00001\nRET {tail}\nMOVL C00000");
        assert_eq!(shifted(&back), [false, false], "{tail}");
    }
    assert_eq!(shifted("CALL JOB:ON\nMOVL C00000"), [true]);
    // without one there is one way
    let over = "SFTON P001\nCALL JOB:OFF\nMOVL C00000\nJUMP *E\nSFTON P001\n*E\nMOVL C00001";
    assert_eq!(shifted(over), [false, false]);
}

#[test]
fn a_jump_by_a_number_goes_to_any_label_of_the_job() {
    let ahead = "SFTON P001\nJUMP LABEL:B000\n*1\nSFTOF\nMOVL C00000\n*2\nMOVL C00001";
    assert_eq!(shifted(ahead), [false, true]);
    let behind = "*1\nMOVL C00000\nSFTON P001\nJUMP LABEL:B000 IF B000>0\nSFTOF\nMOVL C00001";
    assert_eq!(shifted(behind), [true, false]);
}

#[test]
fn a_trap_leaves_the_move_for_its_label() {
    let trapped = "SFTON P001\nMOVL C00000 V=5.0 TRAP *E\nSFTOF\nMOVL C00001\nRET\n*E\nMOVL C00002";
    assert_eq!(shifted(trapped), [true, false, true]);
    let positions = format!("{USER}{}", points(3));
    let program = read(&job(
        &positions,
        "MOVL C00000\nMOVL C00001 TRAP *E\nMOVL C00002\nRET\n*E\nMOVL C00000",
    ));
    let befores: Vec<Before> = program.moves.iter().map(|m| m.before).collect();
    let (start, one) = (Before::Start, Before::One);
    assert_eq!(program.moves[2].target, None);
    assert_eq!(befores, [start, one(0), one(1), one(1), one(2)]);
}

#[test]
fn a_base_at_another_height_is_said_where_positions_count_from_there() {
    let heights = |positions: &str, z_m: f64| {
        let settings = Settings {
            world_from_base: Some(Pose {
                translation: [0.0, 0.0, z_m],
                ..Pose::identity()
            }),
            ..Settings::default()
        };
        let text = job(positions, "MOVJ C00000");
        let program = read_files(&[&text], &settings).expect("a job");
        let found = program.findings.iter().filter(|f| f.id == "base-height");
        found.map(|f| f.message.clone()).collect::<Vec<_>>()
    };
    let pose = format!("{USER}{}", points(1));
    let said = heights(&pose, 0.5);
    assert_eq!(said.len(), 1);
    assert!(
        said[0].contains("500.0 mm below the robot's base"),
        "{said:?}"
    );
    assert!(heights(&pose, -0.275)[0].contains("275.0 mm above"));
    assert_eq!(heights(&pose, 0.0), [""; 0]);
    let joints = format!("///POSTYPE ANGLE\n///ANGLE\nC00000={P6}");
    assert_eq!(heights(&joints, 0.5), [""; 0]);
}
