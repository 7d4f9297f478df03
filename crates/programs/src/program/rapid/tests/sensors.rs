//! Moves that a sensor ends or leads.

use super::{ids, path, said, to};

/// What may have led the robot elsewhere before a move behind these.
fn led(statements: &str) -> Option<String> {
    let program = path(&format!(
        "MoveJ p1,v5,fine,t;\n{statements}\nMoveL p3,v5,fine,t;"
    ));
    let before = program.call_before(program.moves.len() - 1);
    before.map(str::to_owned)
}

#[test]
fn a_move_behind_one_that_contact_ends_begins_anywhere() {
    for go in [
        "ContactL \\DesiredTorque:=4,p2,v5,t;",
        "ContactL\\DesiredTorque:=tq{2},p2,v5,\\Zone:=z1,t,\\WObj:=w;",
        "ContactL p2,v5,t;",
    ] {
        assert_eq!(led(go).as_deref(), Some("a move that contact ends"), "{go}");
        let program = path(go);
        assert_eq!((to(&program), ids(&program)), (vec!["p2"], vec![]), "{go}");
    }
    assert_eq!(led("ClearPath;").as_deref(), Some("a path that is cleared"));
    for go in ["MoveL p2,v5,z5,t;", "SpeedRefresh 50;\nStartMove;"] {
        assert_eq!(led(go), None, "{go}");
    }
}

#[test]
fn force_and_guides_lead_moves_elsewhere_than_their_targets() {
    for (go, name) in [
        (
            "FCPress1LStart p2,v30,\\Fz:=200,50,\\PosSupvDist:=150,z30,t\\WObj:=w;",
            "FCPress1LStart",
        ),
        ("FCPressL p2,v30,180,z30,t\\WObj:=w;", "FCPressL"),
        ("FCPressEnd p2,v30,\\DeactOnly,t\\WObj:=w;", "FCPressEnd"),
    ] {
        let program = path(go);
        assert_eq!(to(&program), ["p2"], "{go}");
        assert_eq!(ids(&program), ["corrected-by-sensor"], "{go}");
        assert!(said(&program)[0].message.contains(name), "{go}");
        assert_eq!(
            led(go).as_deref(),
            Some("a force that leads the arm"),
            "{go}"
        );
    }
    let program =
        path("FCPressC p1,p2,v30,180,z30,t;\nEGMMoveL id,p1,v5,z5,t;\nEGMMoveC id,p2,p3,v5,z5,t;");
    assert_eq!(to(&program), ["p1", "p2", "p1", "p2", "p3"]);
    assert_eq!(ids(&program), ["corrected-by-sensor"; 3]);
}

#[test]
fn what_gives_way_to_forces_stands_nobody_knows_where_and_writes_no_tool() {
    let program = path(
        "MoveL p1,v5,fine,t\\WObj:=w;\nFCCalib l;\nFCSupvForce\\Zmax:=1000;\nFCAct t\\WObj:=w;\n\
         FCCondForce\\ZMin:=-2\\ZMax:=2,80;\nFCRefLine FC_LIN_Z,-5,90;\nFCRefStart;\n\
         FCCondWaitWhile;\nFCRefStop;\nFCDeact;\nv:=FCGetForce(\\Tool:=t);\n\
         EGMActMove id,t.tframe\\SampleRate:=24;\nMoveL p2,v5,fine,t\\WObj:=w;",
    );
    assert_eq!(ids(&program), ["corrected-by-sensor"; 2]);
    assert_eq!(
        led("FCAct t;\nFCDeact;").as_deref(),
        Some("a force that leads the arm")
    );
}
