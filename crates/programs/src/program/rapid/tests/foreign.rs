//! What routines that are not in the files, and instructions that name data, may write.

use super::*;

/// The findings of a call, then a move to `p1` with `t` in `w`.
fn before_a_move(call: &str) -> Vec<&'static str> {
    ids(&path(&format!("{call}\nMoveL p1,v5,z5,t\\WObj:=w;")))
}

#[test]
fn a_call_with_the_arguments_of_a_move_is_taken_for_one_with_a_warning() {
    for call in [
        "Pick p2,v5,z5,t\\WObj:=w;",
        "Pick p2,v5,10,z5,t\\WObj:=w\\TLoad:=load0;",
        "Pick Offs(p2,0,0,1),v5,z5,t;",
        "Pick p2,v5,z5,gun\\WObj:=w;",
    ] {
        let program = path(&format!("{call}\nPick p3,v5,z5,t\\WObj:=w;"));
        assert_eq!(to(&program), ["p2", "p3"], "{call}");
        assert_eq!(ids(&program), ["move-assumed"], "{call}");
        assert!(said(&program)[0].message.starts_with("Pick "), "{call}");
    }
}

#[test]
fn joints_that_are_written_out_are_what_a_move_goes_to() {
    let joints = "[[0,10,10,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    let program = path(&format!("ArcMoveAbsJ {joints},v5,z5,t;\nMoveL p1,v5,z5,t;"));
    assert_eq!(to(&program)[1..], ["p1"]);
    assert_eq!(program.moves.len(), 2);
    assert_eq!(ids(&program), ["move-assumed"]);
}

#[test]
fn a_call_with_more_than_a_move_has_may_do_anything_with_its_targets() {
    for call in [
        "Pick p1,p2,v5,z5,t\\WObj:=w;",
        "Pick p1,t,w;",
        "Pick p1,t\\WObj:=w;",
        "Pick p1,v5,z5,t,w;",
        "Pick p1,v5,z5,t\\Frame:=w;",
        "Pick p1,v5,z5,t\\Appr:=p2;",
        "Pick p1,v5,t,t2\\WObj:=w;",
        "Pick p1,v5,w.uframe,t\\WObj:=w;",
        "Pick p1,t;",
    ] {
        let program = path(&format!("{call}\nMoveL p1,v5,z5,tool0;"));
        let found = ids(&program);
        let is_given_away = |id: &&str| *id == "target-passed-to-routine";
        assert!(
            !found.is_empty() && found.iter().all(is_given_away),
            "{call}: {found:?}"
        );
        assert!(blocked(&program).contains(&"p1"), "{call}");
    }
}

#[test]
fn process_instructions_that_move_are_known() {
    for call in [
        "SpotML p2,v5,gun1,spot1\\G2:=g2,t\\WObj:=w;",
        "ContactL\\DesiredTorque:=0.1,p2,v5,t\\WObj:=w;",
        "NutL p2,v5,nut1,gun1,t\\WObj:=w;",
    ] {
        let program = path(call);
        assert_eq!(
            (to(&program), ids(&program)),
            (vec!["p2"], vec![]),
            "{call}"
        );
    }
}

#[test]
fn a_part_of_a_frame_that_is_given_away_counts_as_the_frame() {
    for given in [
        "w",
        "w.oframe",
        "w.uframe.trans.x",
        "t",
        "t.tframe",
        "t.tload.mass",
    ] {
        for call in [
            format!("CamPose {given};"),
            format!("ok:=fCam({given});"),
            format!("IF fCam({given}) Stop;"),
            format!("%\"CamPose\"% {given};"),
        ] {
            let found = before_a_move(&call);
            assert_eq!(found, ["frame-chosen-at-run-time"], "{call}");
        }
    }
    let program = path("gunchange t;\nMoveL p1,v5,z5,t\\WObj:=w;");
    let message = &said(&program)[0].message;
    assert!(
        message.contains("gunchange") && message.contains(" t "),
        "{message}"
    );
    // by value, or nothing that the move has
    for call in ["CamPose w.uframe.trans.x+1;", "CamPose t2;"] {
        assert_eq!(before_a_move(call), [""; 0], "{call}");
    }
}

#[test]
fn data_that_are_set_by_their_names_or_types_are_not_known() {
    for call in [
        "SetDataVal \"w\",x;",
        "SetDataVal \"W\",x;",
        "SetDataVal \"t\",x;",
        "SetDataVal name,x;",
        "SetDataVal name,w;",
        "SetDataVal name,[FALSE,TRUE,s,f,f];",
        "SetDataVal name,s.frame;",
        "SetAllDataVal \"wobjdata\"\\Object:=\"w.*\",x;",
        "SetAllDataVal \"tooldata\",x;",
    ] {
        let found = before_a_move(call);
        assert!(
            found.contains(&"frame-assigned-at-run-time"),
            "{call}: {found:?}"
        );
    }
    for call in [
        "SetDataVal \"t2\",x;",
        "SetAllDataVal \"num\",x;",
        // a value of another type than that of tools and work objects
        "SetDataVal name,\"text\";",
        "SetDataVal name,TRUE;",
        "SetDataVal name,5;",
        "SetDataVal name\\TaskName:=\"T_ROB2\",n+1;",
        "SetDataVal name,place;",
        "SetDataVal name,w.uframe;",
        "SetDataVal name,Offs(p1,0,0,5);",
        "GetDataVal name,place;",
    ] {
        let given = format!("VAR num n;\nVAR pos place;\n{call}");
        assert_eq!(before_a_move(&given), [""; 0], "{call}");
    }
}

#[test]
fn loads_that_something_may_write_are_not_known() {
    let read = |call: &str| {
        ids(&read(&format!(
            "MODULE m\nCONST robtarget p:=[[1,2,3],[1,0,0,0],CONF;\nPERS loaddata \
             l:=[4,[0,0,50],[1,0,0,0],0,0,0];\nPROC main()\n{call}\nMoveL \
             p,v5,z5,tool0\\TLoad:=l;\nENDPROC\nENDMODULE\n"
        )))
    };
    for call in [
        "grip l;",
        "weigh l.mass;",
        "SetDataVal \"l\",x;",
        "SetAllDataVal \"loaddata\",x;",
    ] {
        assert_eq!(read(call), ["load-chosen-at-run-time"], "{call}");
    }
    for call in ["", "SetDataVal \"t\",x;", "SetAllDataVal \"num\",x;"] {
        assert_eq!(read(call), [""; 0], "{call}");
    }
}

#[test]
fn what_a_move_calls_on_its_way_may_have_run_at_the_next_move() {
    let rest = "MoveL p2,v5,z5,t\\WObj:=w;\nENDPROC\nPROC ch()\nPDispSet d;\nENDPROC\nPROC other()\n\
                MoveL p3,v5,z5,t;";
    for call in [
        "MoveLSync p1,v5,z5,t\\WObj:=w,\"ch\";",
        "MoveJSync p1,v5,z5,t\\WObj:=w,\"CH\";",
        "MoveCSync p3,p1,v5,z5,t\\WObj:=w,\"m:ch\";",
        "MoveLSync p1,v5,z5,t\\WObj:=w,name;",
    ] {
        let program = path(&format!("PDispOff;\n{call}\n{rest}"));
        assert_eq!(ids(&program), ["displacement-active"], "{call}");
        assert_eq!(blocked(&program), ["p2"], "{call}");
    }
    let call = "MoveLSync p1,v5,z5,t\\WObj:=w,\"other\";";
    assert_eq!(ids(&path(&format!("PDispOff;\n{call}\n{rest}"))), [""; 0]);
}

#[test]
fn a_late_bound_call_with_the_name_of_a_module_finds_its_own_routine() {
    let data = "CONST robtarget p1:=[[1,2,3],[1,0,0,0],CONF;\n\
                PERS wobjdata w:=[FALSE,TRUE,\"\",[[1,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n";
    let frames = |call: &str, local: &str, name: &str| {
        let a = format!(
            "MODULE a\n{data}PROC main()\n{call}\nMoveL p1,v5,z5,tool0\\WObj:=w;\nENDPROC\nLOCAL \
             PROC run()\nw.uframe.trans.x:=3;\nENDPROC\nENDMODULE"
        );
        let b = format!("MODULE b\n{local}PROC {name}()\nw.uframe.trans.x:=2;\nENDPROC\nENDMODULE");
        let program = read_files(&[&a, &b]).expect("two modules");
        assert!(!ids(&program).contains(&"write-not-called"), "{call}");
        let frames = program.moves.iter().map(|m| {
            let of = program.frames[m.frame].world_from_frame.expect("a frame");
            (1e3 * of.translation[0]).round()
        });
        frames.collect::<Vec<_>>()
    };
    assert_eq!(frames("%\"b:run\"%;\nrun;", "LOCAL ", "run"), [3.0]);
    assert_eq!(frames("run;\n%\"b:run\"%;", "LOCAL ", "run"), [2.0]);
    assert_eq!(frames("run;\n%\"B:Go\"%;", "", "go"), [2.0]);
    assert_eq!(frames("run;\n%\"b:Main\"%;", "", "Main"), [2.0]);
}

#[test]
fn the_main_of_a_module_that_another_calls_goes_on_with_what_its_caller_set() {
    let a = "MODULE a\nPROC main()\nConfL\\Off;\n%\"b:Main\"%;\nENDPROC\nENDMODULE";
    let b = "MODULE b\nCONST robtarget p1:=[[1,2,3],[1,0,0,0],CONF;\nPROC Main()\nMoveL \
             p1,v5,z5,tool0;\nENDPROC\nENDMODULE";
    let program = read_files(&[a, b]).expect("two modules");
    let configured: Vec<_> = program.moves.iter().map(|m| m.configured).collect();
    assert_eq!(configured, [false]);
}

#[test]
fn what_the_controller_keeps_in_mind_lasts_over_the_end_of_a_cycle() {
    let program = path("MoveL p1,v5,z5,t;\nPDispSet d;");
    assert_eq!(ids(&program), ["displacement-active"]);
    for cycle in [
        "MoveL p1,v5,z5,t;\nPDispSet d;\nPDispOff;",
        "PDispOff;\nMoveL p1,v5,z5,t;\nPDispSet d;",
    ] {
        assert_eq!(ids(&path(cycle)), [""; 0], "{cycle}");
    }
    let data = "CONST robtarget p:=[[1,2,3],[1,0,0,0],CONF;\nPERS loaddata \
                l:=[4,[0,0,50],[1,0,0,0],0,0,0];\nPERS tooldata \
                g:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];";
    let program = read(&format!(
        "MODULE m\n{data}\nPROC main()\nMoveL p,v5,z5,g;\nGripLoad l;\nENDPROC\nENDMODULE\n"
    ));
    let mut masses: Vec<_> = program
        .moves
        .iter()
        .map(|m| {
            let tool = &program.tools[m.tool];
            let carried_kg = tool.carried.map_or(0.0, |part| part.mass_kg);
            tool.load.expect("a load").mass_kg + carried_kg
        })
        .collect();
    masses.sort_by(f64::total_cmp);
    assert_eq!(masses, [1.0, 5.0]);
}

#[test]
fn a_position_of_the_robot_is_right_as_it_is_with_its_own_tool_and_work_object_only() {
    let reads = [
        ("p3:=CRobT(\\Tool:=t\\WObj:=w);\nMoveL p3", "t\\WObj:=w"),
        (
            "p3:=CalcRobT(CJointT(),t\\WObj:=w);\nMoveL p3",
            "t\\WObj:=w",
        ),
        ("SearchL di,p3,p1,v5,t\\WObj:=w;\nMoveL p3", "t\\WObj:=w"),
        ("p3:=CRobT();\nMoveL p3", "t\\WObj:=w"),
        ("MoveL CRobT(\\Tool:=t\\WObj:=w)", "t\\WObj:=w"),
    ];
    for (read, own) in reads {
        let go = |with: &str| {
            ids(&path(&format!(
                "MoveL p1,v5,z5,t\\WObj:=w;\n{read},v5,z5,{with};"
            )))
        };
        assert_eq!(go(own), ["run-time-position"], "{read}");
        for other in ["t2\\WObj:=w", "t", "tool0"] {
            assert_eq!(go(other), ["computed-target"], "{read} {other}");
        }
    }
    // the same by way of parameters
    let library = "goBack t;\nENDPROC\nPROC goBack(PERS tooldata g)\np3:=CRobT(\\Tool:=g\\WObj:=w);\n\
                   MoveL p3,v5,z5,g\\WObj:=w;";
    assert_eq!(ids(&path(library)), ["run-time-position"]);
    // joints are joints
    let program = path("MoveL p1,v5,z5,t2;\nMoveAbsJ CJointT(),v5,z5,t;");
    assert_eq!(ids(&program), ["run-time-position"]);
}

#[test]
fn an_axis_that_is_kept_at_its_angle_is_said() {
    assert_eq!(before_a_move("SingArea\\LockAxis4;"), ["axis-locked"]);
    assert_eq!(before_a_move("SingArea\\Wrist;"), [""; 0]);
}
