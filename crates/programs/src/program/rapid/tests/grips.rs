//! What the gripper carries.

use super::*;

const PART: &str = "PERS loaddata part:=[3,[0,0,80],[1,0,0,0],0,0,0];\nPERS loaddata \
                    none:=[0,[0,0,0],[1,0,0,0],0,0,0];\n";

/// The mass and the centre of gravity of the load of each move, by mass.
fn loads(statements: &str) -> Vec<(f64, [f64; 3])> {
    let program = path(&format!("{PART}{statements}"));
    let load = |m: &crate::program::Move| {
        let tool = &program.tools[m.tool];
        let own = tool.load.expect("a load");
        let pose = tool.flange_from_tool.expect("a pose");
        tool.carried.map_or(own, |part| own.with(part, &pose))
    };
    let load = |m| {
        (
            load(m).mass_kg,
            load(m).cog_m.map(|x| (x * 1e6).round() / 1e6),
        )
    };
    let mut all: Vec<_> = program.moves.iter().map(load).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(ids(&program), [""; 0], "{statements}");
    all
}

#[test]
fn what_the_gripper_carries_adds_to_the_load_of_the_tool() {
    let own = (1.5, [0.0, 0.0, 0.05]);
    // (1.5 · 50 + 3 · (100 + 80)) / 4.5 mm
    let both = (4.5, [0.0, 0.0, 0.136_667]);
    let go = "MoveL p1,v5,z5,t;\n";
    for (statements, expected) in [
        (
            format!("{go}GripLoad part;\n{go}GripLoad load0;\n{go}"),
            vec![own, own, both],
        ),
        (format!("GripLoad part;\nGripLoad none;\n{go}"), vec![own]),
        (format!("IF a GripLoad part;\n{go}"), vec![own, both]),
        (
            format!("grip;\n{go}ENDPROC\n{PART}PROC grip()\nGripLoad part;"),
            vec![both],
        ),
        (
            format!("GripLoad part;\n{}", go.replace("t;", "t\\TLoad:=load0;")),
            vec![both],
        ),
        (
            format!(
                "GripLoad part;\n{}",
                go.replace("t;", "t\\TLoad:=[2,[0,0,9],[1,0,0,0],0,0,0];")
            ),
            vec![(2.0, [0.0, 0.0, 0.009])],
        ),
        (go.into(), vec![own]),
    ] {
        assert_eq!(loads(&statements), expected, "{statements}");
    }
    // the tool of a parameter, of a variable, of an element, and one that the program writes
    for statements in [
        "GripLoad part;\ngo t;\nENDPROC\nPROC go(PERS tooldata g)\nMoveL p1,v5,z5,g;",
        "VAR tooldata g;\ng:=t;\nGripLoad part;\nMoveL p1,v5,z5,g;",
        "PERS tooldata of{1}:=[[TRUE,[[0,0,100],[1,0,0,0]],[1.5,[0,0,50],[1,0,0,0],0,0,0]]];\nGripLoad \
         part;\nMoveL p1,v5,z5,of{1};",
    ] {
        assert_eq!(loads(statements), [both], "{statements}");
    }
    let heavier = "t.tload.mass:=9;\nGripLoad part;\nMoveL p1,v5,z5,t;";
    // (9 · 50 + 3 · (100 + 80)) / 12 mm
    assert_eq!(loads(heavier), [(12.0, [0.0, 0.0, 0.0825])]);
    // a tool that points along x of the flange: (3 · 80, 0, 3 · 100) / 4 mm
    let turned = "PERS tooldata u:=[TRUE,[[0,0,100],[0.7071068,0,0.7071068,0]],[1,[0,0,0],[1,0,0,0],0,\
                  0,0]];\nGripLoad part;\nMoveL p1,v5,z5,u;";
    assert_eq!(loads(turned), [(4.0, [0.06, 0.0, 0.075])]);
}

#[test]
fn loads_that_the_text_does_not_say_are_a_warning_at_their_place() {
    for statements in [
        "GripLoad other;\nMoveL p1,v5,z5,t;",
        "part.mass:=4;\nGripLoad part;\nMoveL p1,v5,z5,t;",
    ] {
        let program = path(&format!("{PART}{statements}"));
        assert!(ids(&program).contains(&"grip-load"), "{statements}");
    }
    let program = path(&format!("{PART}GripLoad part;\nMoveL p1,v5,z5,gun;"));
    assert_eq!(ids(&program), [""; 0]);
    let tool = &program.tools[program.moves[0].tool];
    let carried = tool.carried.expect("a part");
    assert_eq!(
        (tool.load, carried.mass_kg),
        (None, 3.0),
        "the profile may have the rest"
    );
    let program = path("GripLoad load0;\nMoveL p1,v5,z5,gun;");
    assert_eq!(ids(&program), [""; 0]);
}
