//! The load that the arm carries at a move.

use super::*;

#[test]
fn loads_that_are_not_the_tools_are_noted() {
    let program = path("GripLoad load0;\nGripLoad part;\nMoveL p1,v5,z5,t\\WObj:=w;");
    assert_eq!(ids(&program), ["grip-load"]);
}

#[test]
fn the_load_of_a_move_is_that_of_its_text() {
    let declared = "PERS loaddata l:=[3,[0,0,80],[1,0,0,0],0,0,0];\n";
    for load in ["l", "[3,[0,0,80],[1,0,0,0],0,0,0]"] {
        let program = path(&format!(
            "{declared}MoveL p1,v5,z5,t\\TLoad:={load}\\WObj:=w;"
        ));
        let load = program.tools[program.moves[0].tool].load.expect("a load");
        assert!((load.mass_kg - 3.0).abs() < 1e-12 && (load.cog_m[2] - 0.08).abs() < 1e-12);
        assert_eq!(ids(&program), [""; 0]);
    }
    for (before, load) in [
        ("l.mass:=5;", "l"),
        ("l:=other;", "l"),
        ("", "other"),
        ("", "l{2}"),
        ("", "[m,[0,0,80],[1,0,0,0],0,0,0]"),
    ] {
        let program = path(&format!(
            "{declared}{before}\nMoveL p1,v5,z5,t\\TLoad:={load};"
        ));
        let taken = program.tools[program.moves[0].tool].load.expect("a load");
        assert!((taken.mass_kg - 1.5).abs() < 1e-12, "that of the tool");
        assert_eq!(
            ids(&program),
            ["load-chosen-at-run-time"],
            "{before} {load}"
        );
    }
}

#[test]
fn load0_is_the_constant_of_the_controller() {
    let program = path("t.tload:=load0;\nMoveL p1,v5,z5,t;");
    assert_eq!(ids(&program), [""; 0], "{:?}", program.findings);
    let load = program.tools[program.moves[0].tool].load.expect("a load");
    assert!((load.mass_kg - 0.001).abs() < 1e-12, "{load:?}");
}
