//! Tools and work objects that statements write, or that are refused.

use super::*;

#[test]
fn parts_of_frames_that_are_written_from_constants_are_their_numbers() {
    let constants = "CONST pose u:=[[1, 2,3],[0.707107,0,0,0.707107]];\nCONST pos c:=[4,5,6];\nCONST num \
                     h:=7;\nPERS wobjdata w2:=[FALSE,TRUE,\"\",[[8,9,1],[1,0,0,0]],[[0,0,2],[1,0,0,0]]];\n\
                     PERS tooldata t2:=[TRUE,[[0,0,3],[1,0,0,0]],[2,[0,0,4],[1,0,0,0],0,0,0]];\nCONST \
                     loaddata l:=[5,[0,0,6],[1,0,0,0],0,0,0];\nVAR pos v:=[1,2,3];\n";
    for (written, numbers) in [
        (
            "w.uframe:=u;",
            "w.uframe:=[[1,2,3],[0.707107,0,0,0.707107]];",
        ),
        ("w.uframe.trans:=c;", "w.uframe.trans:=[4,5,6];"),
        ("w.oframe.trans.z:=h;", "w.oframe.trans.z:=7;"),
        ("w.oframe:=w2.uframe;", "w.oframe:=[[8,9,1],[1,0,0,0]];"),
        (
            "w.oframe.trans.x:=w2.oframe.trans.z;",
            "w.oframe.trans.x:=2;",
        ),
        ("t.tframe:=t2.tframe;", "t.tframe:=[[0,0,3],[1,0,0,0]];"),
        ("t.tload:=l;", "t.tload:=[5,[0,0,6],[1,0,0,0],0,0,0];"),
        ("w.uframe.trans.z:=-h;", "w.uframe.trans.z:=-7;"),
        ("w.uframe.trans:=[h,2*h,c.z];", "w.uframe.trans:=[7,14,6];"),
    ] {
        let read = |write: &str| {
            let program = path(&format!("{constants}{write}\nMoveL p1,v5,z5,t\\WObj:=w;"));
            assert_eq!(ids(&program), [""; 0], "{write}");
            (program.tools.clone(), program.frames.clone())
        };
        assert_eq!(read(written), read(numbers), "{written}");
    }
    for written in [
        "w.uframe.trans:=v;",
        "w.uframe.trans:=c2;",
        "w.uframe.trans.z:=n;",
        "w.uframe:=PoseMult(u,v);",
        "w.uframe.rot:=OrientZYX(n,0,0);",
    ] {
        let program = path(&format!("{constants}{written}\nMoveL p1,v5,z5,t\\WObj:=w;"));
        assert_eq!(ids(&program), ["frame-assigned-at-run-time"], "{written}");
    }
}

#[test]
fn functions_of_constants_make_frames() {
    let constants = "CONST pose a:=[[100,0,0],[0.7071067811865476,0,0,0.7071067811865476]];\nCONST pose \
                     b:=[[0,20,0],[1,0,0,0]];\nCONST num turn:=90;\n";
    // the first turns the y of the second into its own -x
    for (written, place, x) in [
        ("w.uframe:=PoseMult(a, b);", [80, 0, 0], [0, 1, 0]),
        ("w.uframe:=PoseMult(b,a);", [100, 20, 0], [0, 1, 0]),
        ("w.uframe:=PoseInv(a);", [0, 100, 0], [0, -1, 0]),
        ("w.uframe:=PoseMult(PoseInv(a),a);", [0, 0, 0], [1, 0, 0]),
        (
            "w.uframe:=[[1,2,3],OrientZYX(turn,0,0)];",
            [1, 2, 3],
            [0, 1, 0],
        ),
        (
            "w.uframe:=[b.trans,OrientZYX(0,turn,45)];",
            [0, 20, 0],
            [0, 0, -1],
        ),
        ("w.uframe.rot:=OrientZYX(0,0,turn);", [0, 0, 0], [1, 0, 0]),
    ] {
        let start = "w.uframe:=[[0,0,0],[1,0,0,0]];\nw.oframe:=[[0,0,0],[1,0,0,0]];\n";
        let program = path(&format!(
            "{constants}{start}{written}\nMoveL p1,v5,z5,t\\WObj:=w;"
        ));
        let frame = program.frames[program.moves[0].frame].world_from_frame;
        let frame = frame.expect("a frame");
        // hundredths of a millimetre are enough
        #[allow(clippy::cast_possible_truncation)]
        let rounded = |number: f64| number.round() as i64;
        let at = frame.translation.map(|m| rounded(m * 1e3));
        let axis = [0, 1, 2].map(|row| rounded(frame.rotation.0[row][0]));
        assert_eq!((at, axis), (place, x), "{written}");
        assert_eq!(ids(&program), [""; 0], "{written}");
    }
}

#[test]
fn frames_assigned_once_or_alike_replace_the_declared_ones() {
    let program = path(
        "w.uframe := [[0,0,500],[1,0,0,0]];\nt.tframe.trans.z:=42;\nMoveL p1,v5,z5,t\\WObj:=w;\n\
         w.uframe := [[0,0,500],[1,0,0,0]];",
    );
    let frame = program.frames[0].world_from_frame.expect("a frame");
    assert_eq!(frame.translation, [0.01, 0.0, 0.5]);
    let tool = program.tools[0].flange_from_tool.expect("a tool");
    assert_eq!(tool.translation, [0.0, 0.0, 0.042]);
    assert_eq!(ids(&program), [""; 0]);
}

fn heights(program: &Program) -> Vec<f64> {
    let frame = |m: &crate::program::Move| program.frames[m.frame].world_from_frame;
    let z = |m| (frame(m).expect("a frame").translation[2] * 1e3).round();
    program.moves.iter().map(z).collect()
}

#[test]
fn different_frames_hold_one_after_another() {
    let text = "w.uframe.trans := [0,0,100];\nMoveL p1,v5,z5,t\\WObj:=w;\n\
                w.uframe.trans := [0,0,200];\nMoveL p2,v5,z5,t\\WObj:=w;";
    assert_eq!(heights(&path(text)), [100.0, 200.0]);
    assert_eq!(
        heights(&path(&format!("IF a THEN\n{text}\nENDIF"))),
        [100.0, 200.0]
    );
    let other = format!("{text}\nENDPROC\nPROC b()\nMoveL p1,v5,z5,t\\WObj:=w;");
    assert_eq!(heights(&path(&other)), [100.0, 200.0, 0.0], "as declared");
    // PERS data are kept to the next run
    let before = format!("MoveL p1,v5,z5,t\\WObj:=w;\n{text}");
    assert_eq!(heights(&path(&before)), [0.0, 200.0, 100.0, 200.0]);
    let written = path(&before).moves[1].frame_written.expect("a place");
    assert!(written.offset > 0);
    let program = path(&text.replace("200", "x"));
    assert_eq!(
        (ids(&program), blocked(&program)),
        (vec!["frame-assigned-at-run-time"], vec!["p2"])
    );
    let called = format!(
        "MoveL p1,v5,z5,t\\WObj:=w;\nENDPROC\nPROC never()\n{}",
        text.replace("p1", "p3")
    );
    let program = path(&called);
    assert_eq!(
        heights(&program),
        [0.0, 100.0, 200.0],
        "the declaration holds"
    );
    assert_eq!(ids(&program), ["write-not-called"]);
    // the other way round: what the program writes is there when the operator starts a routine
    for (routine, is_reported) in [
        ("MoveL p2,v5,z5,t\\WObj:=w;", true),
        ("MoveL p2,v5,z5,t;", false),
        ("w:=wobj0;\nMoveL p2,v5,z5,t\\WObj:=w;", true),
    ] {
        let left = format!(
            "MoveL p1,v5,z5,t\\WObj:=w;\nw.oframe.trans.x:=200;\nENDPROC\nPROC service()\n{routine}"
        );
        let program = path(&left);
        let found: Vec<_> = ids(&program);
        assert_eq!(
            found.contains(&"write-not-called"),
            is_reported,
            "{routine}: {found:?}"
        );
    }
}

#[test]
fn tools_and_work_objects_are_written_by_others() {
    for text in [
        "Incr w.oframe.trans.x;\nMoveL p1,v5,z5,t\\WObj:=w;",
        "MToolTCPCalib j1,j2,j3,j4,t,max,mean;\nMoveL p1,v5,z5,t;",
        "w.oframe:=f(1);\nMoveL p1,v5,z5,t\\WObj:=w;",
        "w:=CWObj();\nMoveL p1,v5,z5,t\\WObj:=w;",
    ] {
        let program = path(text);
        assert!(ids(&program)[0].starts_with("frame-"), "{text}");
        assert_eq!(blocked(&program), ["p1"], "{text}");
    }
    let program = path("SetFrame w;\nMoveL p1,v5,z5,t\\WObj:=w;");
    assert_eq!(ids(&program), ["frame-chosen-at-run-time"]);
    let program = path("w:=w2;\nMoveL p1,v5,z5,t\\WObj:=w;");
    assert_eq!(
        (program.frames[0].name.as_str(), ids(&program)),
        ("w2", vec![])
    );
}

#[test]
fn more_values_of_a_tool_than_are_followed_are_refused_at_each_move() {
    let each = |at: usize| {
        format!(
            "PERS tooldata a{at}:=[TRUE,[[0,0,{at}],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n\
             IF DInput(d{at})=1 THEN\nt:=a{at};\nENDIF\n"
        )
    };
    let many: String = (1..7).map(each).collect();
    // one of the moves in another frame
    let program = path(&format!(
        "{many}MoveL p1,v5,z5,t;\nMoveL p2,v5,z5,t\\WObj:=w;"
    ));
    assert_eq!(ids(&program), ["frame-chosen-at-run-time"; 2]);
    assert_eq!(blocked(&program), ["p1", "p2"]);
}

#[test]
fn work_pieces_in_hand_and_moving_frames_are_refused() {
    for (declaration, id) in [
        (
            "PERS wobjdata x:=[TRUE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];",
            "held-work-piece",
        ),
        (
            "PERS wobjdata x:=[FALSE,FALSE,\"CNV1\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];",
            "moving-frame",
        ),
        (
            "PERS wobjdata x:=[FALSE,FALSE,\"ROB_2\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];",
            "two-robots",
        ),
    ] {
        let program = path(&format!("{declaration}\nMoveL p1,v5,z5,t\\WObj:=x;"));
        assert_eq!((ids(&program), blocked(&program)), (vec![id], vec!["p1"]));
    }
    // on a unit the frame is that of the unit, and the user frame of the file is not used; a fixed
    // one is fixed whatever is named
    for (fixed, on, x) in [("FALSE", 1, 0.002), ("TRUE", 0, 0.003)] {
        let wobj = format!(
            "PERS wobjdata x:=[FALSE,{fixed},\"STN1\",[[1,0,0],[1,0,0,0]],[[2,0,0],[1,0,0,0]]];"
        );
        let program = path(&format!("{wobj}\nMoveL p1,v5,z5,t\\WObj:=x;"));
        let frame = &program.frames[0];
        assert_eq!((ids(&program), frame.on.len()), (vec![], on));
        assert_eq!(
            frame.world_from_frame.map(|pose| pose.translation[0]),
            Some(x)
        );
    }
    let program = path(
        "PERS tooldata x:=[FALSE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\nMoveL \
         p1,v5,z5,x;",
    );
    assert_eq!(ids(&program), ["stationary-tool"]);
    let program = path("MoveL p1,v5,z5,tools{i};\nMoveL p2,v5,z5,t\\WObj:=w{2};");
    assert_eq!(ids(&program), ["frame-chosen-at-run-time"]);
    assert_eq!(program.frames[1].name, "w{2}");
}

#[test]
fn data_of_a_module_are_kept_to_the_next_cycle() {
    let data = |storage: &str| {
        format!(
            "MODULE m\n CONST robtarget p1:=[[1,2,3],[1,0,0,0],CONF;\n{storage} wobjdata \
             w:=[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\nPROC main()\n"
        )
    };
    let go = "MoveL p1,v5,z5,tool0\\WObj:=w;\n";
    let set = "w.uframe.trans:=[0,0,100];\n";
    let end = "ENDPROC\nENDMODULE";
    for storage in ["PERS", "VAR", "LOCAL VAR"] {
        let data = data(storage);
        let program = read(&format!("{data}{go}{set}{end}"));
        assert_eq!(heights(&program), [0.0, 100.0], "{storage}");
        let program = read(&format!("{data}{set}{go}{end}"));
        assert_eq!(heights(&program), [100.0], "{storage}");
    }
    let program = path(
        "VAR wobjdata own:=[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\nMoveL \
         p1,v5,z5,t\\WObj:=own;\nown.uframe.trans:=[0,0,100];",
    );
    assert_eq!(heights(&program), [0.0], "of a routine's own");
}

#[test]
fn tools_and_work_objects_in_a_row_are_where_the_file_says() {
    let at = |x: i32| format!("[TRUE,[[0,0,{x}],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]");
    let work = "[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,50],[1,0,0,0]]]";
    let program = path(&format!(
        "PERS tooldata ts{{2}}:=[{},{}];\nPERS wobjdata ws{{1}}:=[{work}];\nMoveL \
         p1,v5,z5,ts{{1}};\nMoveL p2,v5,z5,ts{{2}}\\WObj:=ws{{1}};",
        at(100),
        at(200)
    ));
    let tool = |m: &crate::program::Move| program.tools[m.tool].flange_from_tool;
    let z: Vec<_> = program
        .moves
        .iter()
        .map(|m| tool(m).expect("a tool").translation[2])
        .collect();
    assert_eq!((z, ids(&program)), (vec![0.1, 0.2], vec![]));
    assert_eq!(program.tools[0].name, "ts{1}");
    assert_eq!(heights(&program), [0.0, 50.0]);
    for row in ["[t,t]", "[[t,t],[t,t]]", "other"] {
        let program = path(&format!(
            "PERS tooldata ts{{2}}:={row};\nMoveL p1,v5,z5,ts{{1}};"
        ));
        assert_eq!(program.tools[0].flange_from_tool, None, "{row}");
        assert_eq!(program.tools[0].name, "ts{1}", "{row}");
    }
    let program = path(&format!(
        "PERS tooldata ts{{1}}:=[{}];\nMoveL p1,v5,z5,ts{{2}};",
        at(100)
    ));
    assert_eq!(program.tools[0].flange_from_tool, None, "behind the last");
}
