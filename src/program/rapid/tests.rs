//! What the language reads, by behaviour.

mod posts;
mod robust;
mod samples;

use super::*;
use crate::program::{Displacement, Layout, Motion, Settings, Shape, Shift, Tool};

const POSE: Layout = Layout {
    shape: Shape::Pose,
    variant: 0,
};

const CONF: &str = "[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";

fn read_files(texts: &[&str]) -> Result<Program, ReadError> {
    let named = texts.iter().enumerate();
    let sources: Vec<Source> = named
        .map(|(k, text)| Source::new(format!("{k}.mod"), text.replace("CONF", CONF).into_bytes()))
        .collect();
    Rapid.read(&sources, &Settings::default())
}

fn read(text: &str) -> Program {
    read_files(&[text]).expect("a program")
}

/// A module with targets p1 to p3, a tool and a work object, and this in its procedure.
fn path(statements: &str) -> Program {
    read(&format!(
        "MODULE m\n CONST robtarget p1:=[[1,2,3],[1,0,0,0],CONF;\n\
         CONST robtarget p2:=[[4,5,6],[1,0,0,0],CONF;\n\
         PERS robtarget p3:=[[7,8,9],[1,0,0,0],CONF;\n\
         PERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1.5,[0,0,50],[1,0,0,0],0,0,0]];\n\
         PERS wobjdata w:=[FALSE,TRUE,\"\",[[100,0,0],[0.707107,0,0,0.707107]],[[10,0,0],[1,0,0,0]]];\n\
         PROC main()\n{statements}\nENDPROC\nENDMODULE\n"
    ))
}

fn ids(program: &Program) -> Vec<&'static str> {
    program.findings.iter().map(|finding| finding.id).collect()
}

fn blocked(program: &Program) -> Vec<&str> {
    let blocked = program.targets.iter().filter(|target| target.blocked);
    blocked
        .map(|target| target.name.as_deref().unwrap_or("-"))
        .collect()
}

fn to(program: &Program) -> Vec<&str> {
    let names = program
        .moves
        .iter()
        .map(|m| program.targets[m.target.unwrap()].name.as_deref());
    names.map(|name| name.unwrap_or("-")).collect()
}

#[test]
fn a_move_names_its_target_tool_and_work_object() {
    let program = path("MoveL p2, v100, z10, t\\WObj:=w;");
    let only = &program.moves[0];
    assert_eq!((to(&program), only.motion), (vec!["p2"], Motion::Linear));
    let Tool {
        name,
        flange_from_tool: Some(pose),
        load: Some(load),
    } = &program.tools[only.tool]
    else {
        panic!("a known tool");
    };
    assert_eq!((name.as_str(), pose.translation), ("t", [0.0, 0.0, 0.1]));
    assert!((load.mass_kg - 1.5).abs() < 1e-12 && (load.cog_m[2] - 0.05).abs() < 1e-12);
    let frame = program.frames[only.frame]
        .world_from_frame
        .expect("a frame");
    // uframe turns by 90 degrees about z, so the x of oframe is y
    assert!(
        (frame.translation[0] - 0.1).abs() < 1e-9 && (frame.translation[1] - 0.01).abs() < 1e-9
    );
    let numbers = program.numbers_of(&program.targets[1]);
    assert_eq!(numbers.len(), 11);
    assert!((numbers[1].value - 5.0).abs() < 1e-12);
    assert_eq!(program.findings, []);
}

#[test]
fn a_move_without_work_object_is_in_wobj0_and_unknown_frames_stay_unknown() {
    let program = path("MoveJ p1,v100,z10,tool0;\nMoveL p2,v100,fine,gun,\\WObj:=table;");
    let poses: Vec<_> = program.tools.iter().map(|t| t.flange_from_tool).collect();
    assert_eq!(poses, [Some(Pose::identity()), None]);
    let frames: Vec<_> = program
        .frames
        .iter()
        .map(|f| (f.name.as_str(), f.world_from_frame))
        .collect();
    assert_eq!(frames, [("wobj0", Some(Pose::identity())), ("table", None)]);
}

#[test]
fn arcs_have_a_via_point_and_an_end() {
    let program = path("movec p1,Offs(p2,0,0,0),v100,z10,t;");
    let motions: Vec<_> = program.moves.iter().map(|m| m.motion).collect();
    assert_eq!(motions, [Motion::ArcVia, Motion::ArcEnd]);
    assert_eq!(to(&program), ["p1", "p2"]);
}

#[test]
fn every_kind_of_declaration_and_array_is_a_target() {
    let program = read(
        "MODULE m\nLOCAL CONST robtarget a:=[[1,2,3],[1,0,0,0],CONF;\n\
         TASK PERS robtarget b:=[[1,2,3],[1,0,0,0],CONF;\nVAR robtarget c;\n\
         LOCAL VAR robtarget d := [ [1, 2, 3] ,\r\n [1,0,0,0],CONF;\n\
         CONST jointtarget j:=[[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
         PERS robtarget g{2,2}:=[[[[1,0,0],[1,0,0,0],CONF,[[2,0,0],[1,0,0,0],CONF],\
         [[[3,0,0],[1,0,0,0],CONF,[[4,0,0],[1,0,0,0],CONF]];\n\
         PROC main()\nMoveAbsJ j\\NoEOffs,v5,z5,tool0\\WObj:=x;\nMoveL g{2,1},v5,z5,tool0;\n\
         MoveL g{i,1},v5,z5,tool0;\nMoveL c,v5,z5,tool0;\nENDPROC\nENDMODULE",
    );
    let names: Vec<_> = program
        .targets
        .iter()
        .filter_map(|t| t.name.as_deref())
        .collect();
    assert_eq!(
        names,
        ["a", "b", "d", "j", "g{1,1}", "g{1,2}", "g{2,1}", "g{2,2}"]
    );
    assert_eq!(
        to(&program),
        ["j", "g{2,1}", "g{1,1}", "g{1,2}", "g{2,1}", "g{2,2}"]
    );
    assert_eq!(
        program.frames[0].name, "wobj0",
        "MoveAbsJ ignores the work object"
    );
    assert_eq!(ids(&program), ["computed-target"]);
}

#[test]
fn displacements_add_up_and_unknown_ones_are_told() {
    let program = path(
        "CONST num up:=30;\nMoveL offs(p1,1,-2,+3),v5,z5,t;\nMoveL OFFS(Offs(p1,0,0,5),0,0,-up),v5,z5,t;\n\
         MoveL RelTool(p1,0,0,10\\Rz:=90),v5,z5,t;\nMoveL Reltool(OFFS(p1,-50,100,100),0,0,0\\Rx:=180),v5,z5,t;\n\
         MoveL Offs(p1,0,0,height),v5,z5,t;\nMoveL MirPos(p1,mirror),v5,z5,t;",
    );
    let by: Vec<_> = program
        .moves
        .iter()
        .map(|m| m.displacement.clone())
        .collect();
    assert_eq!(
        by[0],
        Displacement::By(Box::new(Shift::in_frame([0.001, -0.002, 0.003])))
    );
    assert_eq!(
        by[1],
        Displacement::By(Box::new(Shift::in_frame([0.0, 0.0, -0.025])))
    );
    let Displacement::By(turn) = &by[2] else {
        panic!("in the tool");
    };
    assert!((turn.in_tool.rotation.angle() - 90.0 * DEG).abs() < 1e-12);
    assert!(matches!(&by[3], Displacement::By(both) if both.in_frame_m == [-0.05, 0.1, 0.1]));
    assert_eq!(by[4..], [Displacement::Unknown, Displacement::Unknown]);
    assert!(program.moves.iter().all(|m| m.target.unwrap() == 0));
}

#[test]
fn odd_instructions_find_their_arguments() {
    let program = path(
        "MoveLDO p1, v1000, z30, t2, do1, 1;\nTriggL p1,v5,gunon\\T2:=x,z5,t\\WObj:=w;\n\
         SearchL\\Stop, di1, found, p2, v5, t;\nMoveL p1\\ID:=10,v5\\V:=3,z5\\Z:=1,t;\n\
         MoveL p2,v100,Clad1,z2,laser,\\WObj:=w;\nDrillL p2,v5,drill,z1,t;\nArcLStart p1,v5,sm,wd,fine,t;",
    );
    assert_eq!(to(&program), ["p1", "p1", "p2", "p1", "p2", "p2", "p1"]);
    let tools: Vec<_> = program
        .moves
        .iter()
        .map(|m| program.tools[m.tool].name.as_str())
        .collect();
    assert_eq!(tools, ["t2", "t", "t", "t", "laser", "t", "t"]);
    assert_eq!(ids(&program), ["sync-move"]);
}

#[test]
fn comments_and_strings_hold_no_targets() {
    let program = path(
        "! CONST robtarget x:=[[1\nTPWrite \"MoveL [[1,2,3],[1,0,0,0]! ;\";\n! MoveL p1,v5,z5,t;",
    );
    assert_eq!((program.targets.len(), program.moves.len()), (3, 0));
}

#[test]
fn monitoring_of_the_configuration_follows_confl_and_confj() {
    let program = path(
        "MoveL p1,v5,z5,t;\nConfL\\Off;\nMoveL p1,v5,z5,t;\nMoveJ p1,v5,z5,t;\nConfJ \\Off;\n\
         MoveJ p1,v5,z5,t;\nConfL \\On;\nMoveC p1,p2,v5,z5,t;\nENDPROC\nPROC b()\nMoveJ p1,v5,z5,t;",
    );
    let configured: Vec<_> = program.moves.iter().map(|m| m.configured).collect();
    assert_eq!(configured, [true, false, true, false, true, true, true]);
}

#[test]
fn targets_that_code_changes_are_blocked() {
    for statement in [
        "p3.trans.x := p3.trans.x + 1;",
        "p3 := CRobT();",
        "p3.extax.eax_a:=5;",
        "SearchL \\Stop, di1, p3, p1, v5, t;",
        "IF a=1 p3:=p1;",
    ] {
        let program = path(statement);
        assert_eq!(blocked(&program), ["p3"], "{statement}");
        assert_eq!(program.findings[0].line, 4, "the line of the target");
        assert!(program.findings[0].message.contains("line 8"));
    }
    let program = path("q:=[[1,2,3],[1,0,0,0],CONF;\nMoveL q,v5,z5,t;");
    assert_eq!(blocked(&program), ["q"]);
}

#[test]
fn expressions_names_and_routines_block_targets() {
    let program =
        path("MoveL [[x,2,3],[1,0,0,0],CONF,v5,z5,t;\nMoveJ [[1,2,3],[1,0,0,0],conf,ext],v5,z5,t;");
    assert_eq!(ids(&program), ["target-has-expressions"; 2]);
    let program = path("MoveL [[1,2,3],[1,0,0,0],[0,0,0,0],ext],v5,z5,t;");
    assert_eq!(
        blocked(&program),
        Vec::<&str>::new(),
        "external axes stay as they are"
    );
    let program = path("CONST robtarget all{2}:=[p1,p2];\nMoveL all{i},v5,z5,t;");
    assert_eq!(blocked(&program), ["p1", "p2"]);
    let program = path("Pick p1;\nENDPROC\nPROC Pick(robtarget p1)\nMoveL p1,v5,z5,t;");
    assert_eq!(blocked(&program), ["p1"]);
    assert_eq!(
        ids(&program),
        ["target-passed-to-routine", "computed-target"]
    );
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
    assert_eq!(program.findings, []);
}

#[test]
fn different_frames_hold_one_after_another_in_straight_text_only() {
    let text = "w.uframe.trans := [0,0,100];\nMoveL p1,v5,z5,t\\WObj:=w;\n\
                w.uframe.trans := [0,0,200];\nMoveL p2,v5,z5,t\\WObj:=w;";
    let program = path(text);
    let z: Vec<_> = program
        .frames
        .iter()
        .map(|f| f.world_from_frame.expect("a frame").translation[2])
        .collect();
    assert_eq!(z, [0.1, 0.2]);
    for crooked in [
        format!("IF a THEN\n{text}\nENDIF"),
        format!("{text}\nENDPROC\nPROC b()\nMoveL p1,v5,z5,t\\WObj:=w;"),
        format!("MoveL p1,v5,z5,t\\WObj:=w;\n{text}"),
        text.replace("200", "x"),
        text.replacen("MoveL", "Other;\nMoveL", 1),
    ] {
        let program = path(&crooked);
        assert!(blocked(&program).contains(&"p1"), "{crooked}");
        assert!(
            ids(&program)
                .iter()
                .all(|id| *id == "frame-assigned-at-run-time")
        );
    }
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
            "PERS wobjdata x:=[FALSE,TRUE,\"STN1\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];",
            "moving-frame",
        ),
    ] {
        let program = path(&format!("{declaration}\nMoveL p1,v5,z5,t\\WObj:=x;"));
        assert_eq!((ids(&program), blocked(&program)), (vec![id], vec!["p1"]));
    }
    let program = path(
        "PERS tooldata x:=[FALSE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\nMoveL p1,v5,z5,x;",
    );
    assert_eq!(ids(&program), ["stationary-tool"]);
    let program = path("MoveL p1,v5,z5,tools{i};\nMoveL p2,v5,z5,t\\WObj:=w{2};");
    assert_eq!(ids(&program), ["frame-chosen-at-run-time"]);
    assert_eq!(program.frames[1].name, "w{2}");
}

#[test]
fn an_active_displacement_blocks_what_it_may_reach() {
    let program =
        path("MoveL p1,v5,z5,t;\nPDispSet d;\nMoveL p2,v5,z5,t;\nPDispOff;\nMoveL p3,v5,z5,t;");
    assert_eq!(blocked(&program), ["p2"]);
    let program = path(
        "PDispOn p9,t;\nsub;\nPDispOff;\nENDPROC\nPROC sub()\nMoveL p1,v5,z5,t;\nENDPROC\nPROC c()\nMoveL p2,v5,z5,t;",
    );
    assert_eq!(blocked(&program), ["p1"]);
    let program = path("EOffsSet e;\nENDPROC\nPROC sub()\nMoveL p1,v5,z5,t;");
    assert_eq!(ids(&program), ["displacement-active"]);
    let program = path("WHILE a DO\nMoveL p1,v5,z5,t;\nPDispSet d;\nENDWHILE\nPDispOff;");
    assert_eq!(blocked(&program), ["p1"], "the second time round");
}

#[test]
fn local_data_hide_others_and_double_names_are_ambiguous() {
    let declare = |local: &str, x: i32| {
        format!(
            "{local}CONST robtarget p:=[[{x},0,0],[1,0,0,0],CONF;\nPROC r{x}()\nMoveL p,v5,z5,tool0;\nENDPROC\n"
        )
    };
    let file = |name: &str, body: &str| format!("MODULE {name}\n{body}ENDMODULE\n");
    let two = [
        file("a", &declare("", 1)),
        file("b", &declare("LOCAL ", 2)),
        file("c", "PROC m()\nmovej P,v5,z5,tool0;\nENDPROC\n"),
    ];
    let program = read_files(&two.each_ref().map(String::as_str)).expect("three modules");
    assert_eq!(
        program
            .moves
            .iter()
            .map(|m| m.target.unwrap())
            .collect::<Vec<_>>(),
        [0, 1, 0]
    );
    let three = [&two[0], &file("b", &declare("", 2)), &two[2]];
    let program = read_files(&three.map(String::as_str)).expect("three modules");
    assert_eq!(ids(&program), ["target-name-ambiguous"; 2]);
}

#[test]
fn missing_semicolons_short_ifs_and_headers_do_not_hide_moves() {
    let program = read(
        "%%%\n VERSION:1\n LANGUAGE:ENGLISH\n%%%\n\nMODULE m(SYSMODULE, NOSTEPIN)\nPROC a()\n SetDO d, 1\n SetDO d, 0\n\
         IF di1=1 MoveL [[1,2,3],[1,0,0,0],CONF,v5,z5,tool0;\n TEST n\n CASE 1,2:\n\
         MoveL [[4,2,3],[1,0,0,0],CONF,v5,z5,tool0;\n DEFAULT:\n Stop;\n ENDTEST\n FOR i FROM 1 TO 3 DO\n\
         MoveL [[5,2,3],[1,0,0,0],CONF,v5,z5,tool0;\n ENDFOR\nERROR\n RETRY;\nENDPROC\nENDMODULE",
    );
    assert_eq!((program.targets.len(), program.moves.len()), (3, 3));
    assert_eq!(program.findings, []);
}

#[test]
fn broken_text_is_an_error_with_its_place() {
    for (text, place, word) in [
        ("MODULE m\nPROC a()\nENDPROC\n", (1, 1), "module"),
        ("MODULE m\nPROC a()\n", (2, 1), "routine"),
        (
            "MODULE m\nCONST robtarget p:=[[1,2,3],[1,0,0,0];\nENDMODULE",
            (2, 20),
            "bracket",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1,2,3,4],[1,0,0,0],CONF;\nENDMODULE",
            (2, 27),
            "]",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1,2,3],[1,0,0,0],CONF];\nENDMODULE",
            (2, 75),
            "semicolon",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1e400,2,3],[1,0,0,0],CONF;\nENDMODULE",
            (2, 22),
            "number",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[NaN,2,3],[1,0,0,0],CONF;\nENDMODULE",
            (2, 22),
            "number",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1.#QNAN,2,3],[1,0,0,0],CONF;\nENDMODULE",
            (2, 22),
            "number",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1,9E9,3],[1,0,0,0],CONF;\nENDMODULE",
            (2, 24),
            "coordinate",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1,2,3],[0,0,0,0],CONF;\nENDMODULE",
            (2, 30),
            "quaternion",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1,2,3],[1,0.2,0,0],CONF;\nENDMODULE",
            (2, 30),
            "quaternion",
        ),
        (
            "MODULE m\nPROC a()\nTPWrite \"open;\nENDPROC\nENDMODULE",
            (3, 9),
            "string",
        ),
    ] {
        let error = read_files(&[text]).expect_err(text);
        let (_, line, column) = error.place();
        assert_eq!((line, column), place, "{error}");
        assert!(error.to_string().contains(word), "{error}");
    }
    assert!(matches!(
        read_files(&["hello world"]),
        Err(ReadError::NotThisLanguage { .. })
    ));
    assert!(matches!(
        read_files(&["MODULE\0"]),
        Err(ReadError::Binary { .. })
    ));
}

#[test]
fn a_slightly_short_quaternion_is_made_a_unit_one() {
    let numbers = [1.0, 2.0, 3.0, 0.995, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let Value::Pose(pose) = Rapid.decode(POSE, &numbers, &Settings::default()).value else {
        panic!("a pose");
    };
    assert!(pose.rotation.angle() < 1e-12 && (pose.translation[2] - 0.003).abs() < 1e-15);
}

#[test]
fn encoding_keeps_the_sign_of_the_quaternion() {
    let mut numbers = [0.0, 0.0, 0.0, -0.6, 0.8, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let value = Rapid.decode(POSE, &numbers, &Settings::default()).value;
    let posture = Posture {
        joints_rad: [0.1; 6],
        behind_axis_1: false,
        behind_lower_arm: false,
    };
    Rapid.encode(
        POSE,
        &value,
        &posture,
        &posture,
        &Settings::default(),
        &mut numbers,
    );
    assert!((numbers[3] + 0.6).abs() < 1e-12 && (numbers[4] - 0.8).abs() < 1e-12);
}

#[test]
fn the_marker_stands_behind_the_module_line() {
    let marker = Marker {
        version: "1".into(),
        profile_sha256: "a".into(),
        source_sha256: "b".into(),
    };
    for (text, before) in [
        (
            "%%%\r\n  VERSION:1\r\n%%%\r\nMODULE m(SYSMODULE) ! x\r\nENDMODULE\r\n",
            "ENDMODULE",
        ),
        ("CONST robtarget p:=[[1,2,3],[1,0,0,0],CONF;\n", "CONST"),
        ("MODULE m ENDMODULE", "MODULE"),
    ] {
        let source = Source::new("a", text.replace("CONF", CONF).into_bytes());
        let (at, lines) = Rapid.mark(&source, &marker);
        assert!(source.bytes[at..].starts_with(before.as_bytes()), "{text}");
        assert!(lines.ends_with(source.line_end()) && lines.starts_with(b"  ! "));
        let mut marked = source.bytes.clone();
        marked.splice(at..at, lines);
        assert!(
            Rapid
                .read(&[Source::new("a", marked)], &Settings::default())
                .is_ok()
        );
    }
}

#[test]
fn rapid_is_told_from_other_text() {
    for text in [
        "%%%\nVERSION:1\n%%%\nMODULE m\nENDMODULE",
        "! c\nMODULE x(NOSTEPIN)\nEND",
        "CONST robtarget p:=[[1",
        "MoveL p10, v100, z10, tool0;",
        "MoveJ [[1,2,3],[1,0,0,0]",
    ] {
        assert!(Rapid.recognises(&Source::new("a", text.into())), "{text}");
    }
    for text in [
        "1 MOV P1\n2 MVS P2",
        "PROCEDURE x\n SET TALK OFF\nRETURN",
        "module foo\n implicit none\nend module",
        "module foo(a, b);\n input a;\nendmodule",
        "/PROG A\n/MN\n",
        "DEF x()\nPTP HOME\nEND",
        "",
    ] {
        assert!(!Rapid.recognises(&Source::new("a", text.into())), "{text}");
    }
}

#[test]
fn nothing_before_a_move_swallows_it() {
    for before in [
        "<SMT>",
        "sub\n",
        "Set do1\n",
        "x:=y",
        "x:=1\n",
        "label:",
        "<SMT>;",
        "Stop",
        "IF a=1",
        "IF a THEN\n",
    ] {
        let program = path(&format!("{before} MoveL p1,v5,z5,t;\nMoveL p2,v5,z5,t;"));
        assert_eq!(to(&program), ["p1", "p2"], "{before}");
    }
}

#[test]
fn loads_that_are_not_the_tools_are_noted() {
    let program = path("GripLoad load0;\nGripLoad part;\nMoveL p1,v5,z5,t\\WObj:=w\\TLoad:=heavy;");
    assert_eq!(ids(&program), ["grip-load"; 2]);
}
