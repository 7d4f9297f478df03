//! What the language reads, by behaviour.

mod arrays;
mod asked;
mod calls;
mod deciding;
mod derived;
mod errors;
mod foreign;
mod frames;
mod grips;
mod loads;
mod posts;
mod present;
mod robust;
mod samples;
mod sensors;
mod tasks;
mod text;

use super::*;
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::geometry::units::DEG;
use crate::motion;
use crate::program::{Displacement, Motion, Program, Shape, Shift, Stride, Target, Tool, Value};

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
    motion::read(&Rapid, &sources, &Settings::default())
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

/// Findings, but for the note that targets are not used.
fn said(program: &Program) -> Vec<&Finding> {
    let findings = program.findings.iter();
    findings.filter(|f| f.id != "target-unused-here").collect()
}

fn ids(program: &Program) -> Vec<&'static str> {
    said(program).iter().map(|finding| finding.id).collect()
}

/// Targets that moves go to and that are blocked.
fn blocked(program: &Program) -> Vec<&str> {
    let used = |at: &usize| program.moves.iter().any(|m| m.target == Some(*at));
    let blocked = (0..program.targets.len()).filter(|at| program.targets[*at].blocked);
    blocked
        .filter(used)
        .map(|at| &program.targets[at])
        .map(|target| target.name.as_deref().unwrap_or("-"))
        .collect()
}

fn to(program: &Program) -> Vec<&str> {
    let names = program.moves.iter().map(|m| {
        m.target
            .map_or(Some("?"), |at| program.targets[at].name.as_deref())
    });
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
        ..
    } = &program.tools[only.tool]
    else {
        panic!("a known tool");
    };
    assert_eq!((name.as_str(), pose.translation), ("t", [0.0, 0.0, 0.1]));
    assert!((load.mass_kg - 1.5).abs() < 1e-12 && (load.cog_m[2] - 0.05).abs() < 1e-12);
    let frame = program.frames[only.frame]
        .world_from_frame
        .expect("a frame");
    // uframe rotates by 90 degrees about z, so the x of oframe is y
    assert!(
        (frame.translation[0] - 0.1).abs() < 1e-9 && (frame.translation[1] - 0.01).abs() < 1e-9
    );
    let numbers = program.numbers_of(&program.targets[1]);
    assert_eq!(numbers.len(), 11);
    assert!((numbers[1].value - 5.0).abs() < 1e-12);
    assert_eq!(ids(&program), [""; 0]);
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
        ["j", "g{2,1}", "g{1,1}", "g{1,2}", "g{2,1}", "g{2,2}", "?"]
    );
    assert_eq!(
        program.frames[0].name, "wobj0",
        "MoveAbsJ ignores the work object"
    );
    assert_eq!(ids(&program), ["computed-target"]);
}

#[test]
fn displacements_add_up_and_unknown_ones_are_reported() {
    let program = path(
        "CONST num up:=30;\nMoveL offs(p1,1,-2,+3),v5,z5,t;\nMoveL \
         OFFS(Offs(p1,0,0,5),0,0,-up),v5,z5,t;\n\
         MoveL RelTool(p1,0,0,10\\Rz:=90),v5,z5,t;\nMoveL \
             Reltool(OFFS(p1,-50,100,100),0,0,0\\Rx:=180),v5,z5,t;\n\
         MoveL Offs(p1,0,0,height),v5,z5,t;\nMoveL MirPos(p1,mirror),v5,z5,t;",
    );
    let by: Vec<_> = program
        .moves
        .iter()
        .map(|m| m.displacement.clone())
        .collect();
    assert_eq!(
        by[0],
        Displacement::By(Box::new(Shift::along([0.001, -0.002, 0.003])))
    );
    assert_eq!(
        by[1],
        Displacement::By(Box::new(Shift::along([0.0, 0.0, -0.025])))
    );
    let Displacement::By(turn) = &by[2] else {
        panic!("in the tool");
    };
    assert!((turn.in_tool.rotation.angle() - 90.0 * DEG).abs() < 1e-12);
    assert!(
        matches!(&by[3], Displacement::By(both) if both.in_frame.translation == [-0.05, 0.1, 0.1])
    );
    assert_eq!(by[4..], [Displacement::Unknown, Displacement::Unbounded]);
    assert!(program.moves.iter().all(|m| m.target.unwrap() == 0));
}

#[test]
fn what_a_loop_counts_with_hides_a_constant() {
    let program = path(
        "CONST num i:=5;\nFOR i FROM 1 TO 40 DO\nMoveL Offs(p1,0,0,i),v5,z5,t;\nWHILE a DO\nMoveL \
         RelTool(p1,0,0,-i),v5,z5,t;\nENDWHILE\nENDFOR\nMoveL Offs(p1,0,0,i),v5,z5,t;",
    );
    let by: Vec<_> = program.moves.iter().map(|m| &m.displacement).collect();
    let counted = |shift: Shift| {
        let step = |most| Stride::By {
            shift,
            most: Some(most),
        };
        Displacement::Within(Box::new([step(1), step(39)]))
    };
    let in_tool = Shift {
        in_tool: Pose::from_translation(0.0, 0.0, -0.001),
        ..Shift::none()
    };
    let up = Shift::along([0.0, 0.0, 0.001]);
    assert_eq!(by[..2], [&counted(up), &counted(in_tool)]);
    assert!(matches!(by[2], Displacement::By(_)), "behind the loop");
}

#[test]
fn odd_instructions_find_their_arguments() {
    let program = path(
        "MoveLDO p1, v1000, z30, t2, do1, 1;\nTriggL p1,v5,gunon\\T2:=x,z5,t\\WObj:=w;\n\
         SearchL\\Stop, di1, found, p2, v5, t;\nMoveL p1\\ID:=10,v5\\V:=3,z5\\Z:=1,t;\n\
         MoveL p2,v100,Clad1,z2,laser,\\WObj:=w;\nDrillL p2,v5,drill,z1,t;\nArcLStart \
             p1,v5,sm,wd,fine,t;",
    );
    assert_eq!(to(&program), ["p1", "p1", "p2", "p1", "p2", "p2", "p1"]);
    let tools: Vec<_> = program
        .moves
        .iter()
        .map(|m| program.tools[m.tool].name.as_str())
        .collect();
    assert_eq!(tools, ["t2", "t", "t", "t", "laser", "t", "t"]);
    assert_eq!(ids(&program), ["sync-move", "move-assumed"]);
}

#[test]
fn switches_replace_speed_and_zone() {
    for (with, speed_m_s, zone_m, cuts_corner) in [
        ("v10,fine", Some(0.01), Some(0.0), false),
        ("v10\\V:=2000,z10", Some(2.0), Some(0.01), true),
        ("v10\\v := 2000 ,z10\\Z:=3", Some(2.0), Some(0.003), true),
        ("v10\\V:=fast,z10", None, Some(0.01), true),
        ("v1000\\T:=10,fine", None, Some(0.0), false),
        ("v1000\\T:=time,z10\\Z:=size", None, None, true),
        ("v10,fine\\Z:=3", Some(0.01), Some(0.0), false),
    ] {
        let program = path(&format!("MoveL p1,{with},t;"));
        let said = program.speed_zone(&program.moves[0]);
        let near = |found: Option<f64>, wanted: Option<f64>| match (found, wanted) {
            (Some(found), Some(wanted)) => (found - wanted).abs() < 1e-12,
            (found, wanted) => found == wanted,
        };
        assert!(near(said.speed_m_s, speed_m_s), "{with}: {said:?}");
        assert!(near(said.zone_m, zone_m), "{with}: {said:?}");
        assert_eq!(said.cuts_corner(), cuts_corner, "{with}");
    }
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
         MoveJ p1,v5,z5,t;\nConfL \\On;\nMoveC p1,p2,v5,z5,t;\nENDPROC\nPROC b()\nMoveJ \
             p1,v5,z5,t;",
    );
    let configured: Vec<_> = program.moves.iter().map(|m| m.configured).collect();
    assert_eq!(configured, [true, false, true, false, true, true, true]);
}

#[test]
fn targets_that_code_changes_are_blocked() {
    for statement in [
        "p3.trans.x := p3.trans.x + 1;",
        "p3.extax.eax_a:=5;",
        "IF a=1 p3.trans:=p1.trans;",
        "Add p3.trans.y,40;",
        "UnpackRawBytes rb,1,p3.trans.x\\Float4;",
        "ReadAnyBin file,p3.trans.z;",
        "ok:=StrToVal(s,p3.trans.x);",
        "IF StrToVal(s,p3.trans.x) Stop;",
        "SetDataVal \"p3\",q;",
    ] {
        for text in [
            format!("{statement}\nMoveL p3,v5,z5,t;"),
            // PERS data are kept to the next run
            format!("MoveL p3,v5,z5,t;\n{statement}"),
        ] {
            let program = path(&text);
            let is_p3 = |target: &&Target| target.name.as_deref() == Some("p3");
            let p3 = program.targets.iter().find(is_p3).expect("a target");
            assert!(p3.blocked, "{text}");
            let finding = said(&program)[0];
            assert_eq!(finding.id, "target-assigned-at-run-time", "{text}");
            assert_eq!(finding.line, 4, "the line of the target");
            assert!(finding.message.contains("line 8") || finding.message.contains("line 9"));
        }
    }
}

#[test]
fn positions_that_the_robot_reported_are_right_as_they_are() {
    for statement in [
        "p3 := CRobT();",
        "p3 := CRobT(\\Tool:=t \\WObj:=wobj0);",
        "SearchL \\Stop, di1, p3, p1, v5, t;",
    ] {
        let program = path(&format!("{statement}\nMoveL p3,v5,z5,t;"));
        assert_eq!(blocked(&program), [""; 0], "{statement}");
        assert_eq!(ids(&program), ["run-time-position"], "{statement}");
        assert_eq!(to(&program).last(), Some(&"?"), "the move is still there");
        // in the first run it is as declared
        let program = path(&format!("MoveL p3,v5,z5,t;\n{statement}"));
        assert_eq!(
            (blocked(&program), ids(&program)),
            (vec![], vec!["run-time-position"])
        );
        assert_eq!(to(&program)[..2], ["p3", "?"], "{statement}");
    }
    for computed in [
        "p3:=CRobT(\\Tool:=t);\np3.trans.z:=p3.trans.z+reg1;\nMoveL p3,v5,z5,t;",
        "p3:=CRobT(\\Tool:=t);\np3.trans.z:=700;\nMoveL p3,v5,z5,t;",
        "p3:=CRobT(\\Tool:=t);\np3.trans:=[1,2,3];\nMoveL p3,v5,z5,t;",
        "j1:=CJointT();\nj1.robax.rax_6:=j1.robax.rax_6+20;\nMoveAbsJ j1,v5,z5,t;",
    ] {
        let program = path(computed);
        assert_eq!(ids(&program), ["computed-target"], "{computed}");
        assert!(
            program
                .findings
                .iter()
                .all(|f| f.severity < Severity::Error)
        );
    }
    for of_robot in [
        "MoveAbsJ CJointT(),v5,z5,t;",
        "VAR jointtarget j9;\nj9:=CJointT();\nMoveJ CalcRobT(j9,t),v5,z5,t;",
        "MoveJ CalcRobT(CJointT(),t),v5,z5,t;",
    ] {
        assert_eq!(ids(&path(of_robot)), ["run-time-position"], "{of_robot}");
    }
    // of anything else the controller computes the nominal arm
    for of_text in [
        "MoveJ CalcRobT(j1,t),v5,z5,t;",
        "VAR jointtarget j9;\nj9:=CJointT();\nj9.robax.rax_1:=5;\nMoveJ CalcRobT(j9,t),v5,z5,t;",
        "VAR jointtarget j9;\nj9:=CJointT();\nOther j9;\nMoveJ CalcRobT(j9,t),v5,z5,t;",
        "j1:=CalcJointT(place(1),t);\nMoveAbsJ j1,v5,z5,t;",
        "MoveJ CalcRobT(place(1),t),v5,z5,t;",
        "MoveJ CalcRobT(CalcJointT(p1,t),t),v5,z5,t;",
        "MoveAbsJ CalcJointT(same(p1),t),v5,z5,t;",
    ] {
        let found = ids(&path(&format!("{of_text}\nReset do1;")));
        assert!(found.contains(&"computed-target"), "{of_text}: {found:?}");
        assert!(
            !found.contains(&"run-time-position"),
            "{of_text}: {found:?}"
        );
    }
    let program = path("MoveL p1,v5,z5,t;\nMoveJ CalcRobT(p1,t),v5,z5,t;");
    assert_eq!(program.moves[1].displacement, Displacement::Unknown);
}

#[test]
fn a_target_holds_what_was_written_last() {
    let program = path("q:=[[1,2,3],[1,0,0,0],CONF;\nMoveL q,v5,z5,t;\nq:=p1;\nMoveL q,v5,z5,t;");
    assert_eq!((to(&program), blocked(&program)), (vec!["q", "p1"], vec![]));
    let program = path("IF a=1 p3:=p1;\nMoveL p3,v5,z5,t;");
    assert_eq!((to(&program), ids(&program)), (vec!["p1", "p3"], vec![]));
    let program = path("p3:=Offs(p1,0,0,7);\nMoveL p3,v5,z5,t;\np3.trans.x:=1;\nMoveL p3,v5,z5,t;");
    assert_eq!(to(&program), ["p1", "p1"]);
    assert!(matches!(program.moves[0].displacement, Displacement::By(_)));
    assert_eq!(program.moves[1].displacement, Displacement::Overwritten);
}

#[test]
fn expressions_names_and_routines_block_targets() {
    let program =
        path("MoveL [[x,2,3],[1,0,0,0],CONF,v5,z5,t;\nMoveJ [[1,2,3],[1,0,0,0],conf,ext],v5,z5,t;");
    assert_eq!(ids(&program), ["target-has-expressions"; 2]);
    assert!(
        program
            .findings
            .iter()
            .all(|f| f.severity < Severity::Error)
    );
    let program = path("MoveL [[1,2,3],[1,0,0,0],[0,0,0,0],ext],v5,z5,t;");
    assert_eq!(
        blocked(&program),
        Vec::<&str>::new(),
        "external axes stay as they are"
    );
    let program = path("MoveL [p1.trans,p2.rot,p1.robconf,p1.extax],v5,z5,t;");
    assert_eq!(to(&program), ["p1", "p2"], "both flow into it");
    assert!(
        program
            .moves
            .iter()
            .all(|m| m.displacement == Displacement::Unbounded)
    );
    let program = path("CONST robtarget all{2}:=[p1,p2];\nMoveL all{i},v5,z5,t;");
    assert_eq!(
        (to(&program), blocked(&program)),
        (vec!["p1", "p2"], vec![])
    );
}

#[test]
fn blocks_and_jumps_lead_where_they_say() {
    let before = |statements: &str, at: usize| -> Vec<String> {
        let program = path(statements);
        let all = program.before(&program.moves[at]).iter();
        let name = |before: &crate::program::Before| match before {
            crate::program::Before::One(one) => to(&program)[*one as usize].to_owned(),
            other => format!("{other:?}"),
        };
        let mut names: Vec<_> = all.map(name).collect();
        names.sort();
        names
    };
    let go = |name: &str| format!("MoveL {name},v5,z5,t;\n");
    let (a, b, c) = (go("p1"), go("p2"), go("p3"));
    assert_eq!(
        before(&format!("{a}IF x THEN\n{b}ENDIF\n{c}"), 2),
        ["p1", "p2"]
    );
    assert_eq!(
        before(&format!("{a}IF x THEN\n{b}ELSE\n{a}ENDIF\n{c}"), 3),
        ["p1", "p2"]
    );
    assert_eq!(before(&format!("{a}IF x {b}{c}"), 2), ["p1", "p2"]);
    assert_eq!(
        before(&format!("{a}FOR i FROM 1 TO 3 DO\n{b}ENDFOR\n{c}"), 1),
        ["p1", "p2"]
    );
    assert_eq!(
        before(&format!("{a}WHILE TRUE DO\n{b}{c}ENDWHILE"), 1),
        ["p1", "p3"]
    );
    assert_eq!(before(&format!("{a}GOTO l;\n{b}l:\n{c}"), 2), ["p1"]);
    assert_eq!(
        before(
            &format!("{a}TEST n\nCASE 1:\n{b}CASE 2:\nRETURN;\nDEFAULT:\nEXIT;\nENDTEST\n{c}"),
            2
        ),
        ["p2"]
    );
    assert_eq!(
        before(&format!("{a}sub;\n{c}ENDPROC\nPROC sub()\n{b}"), 1),
        ["p2"]
    );
}

#[test]
fn moves_that_nobody_understands_are_there() {
    let program = path(
        "MoveL p1,v5,z5,t;\nMoveL rec.p,v5,z5,t;\nPathRecMoveBwd;\nEGMRunPose e,1;\nMoveJ \
         pHome,v5,z5,t;\nMoveL p2,v5,z5,t;",
    );
    assert_eq!(to(&program), ["p1", "?", "?", "?", "?", "p2"]);
    assert_eq!(
        ids(&program),
        [
            "computed-target",
            "run-time-position",
            "computed-target",
            "target-not-in-files"
        ]
    );
    let program = path("MoveAbsJ jHome,v5,z5,t;");
    assert_eq!(ids(&program), ["joint-target-not-in-files"]);
    assert_eq!(program.findings[0].severity, Severity::Note);
}

#[test]
fn external_axes_are_refused_until_their_unit_is_known() {
    let go = |axes: &str| format!("MoveL [[1,2,3],[1,0,0,0],[0,0,0,0],[{axes}]],v5,z5,t;\n");
    for axes in [
        "9E9,9E9,9E9,9E9,9E9,9E9",
        "0,0,0,0,0,0",
        "0,9E+09,8.999999E+09,0,0,9E9",
    ] {
        let program = path(&go(axes).repeat(2));
        assert_eq!(ids(&program), [""; 0], "{axes}");
    }
    let program = path(&(go("1500,9E9,9E9,9E9,9E9,9E9") + &go("0,9E9,9E9,9E9,9E9,9E9")));
    assert_eq!(ids(&program), ["external-axis-unknown"; 2]);
    assert!(said(&program)[0].message.contains("eax_a is 1500"));
    assert!(said(&program)[1].message.contains("eax_a is 0"));
    let program = path(&("!x\n".to_owned() + &go("9E9,-15.5,9E9,9E9,9E9,9E9")));
    assert!(said(&program)[0].message.contains("eax_b is -15.5"));
}

#[test]
fn sensors_that_correct_a_path_are_reported_once_a_place() {
    let program = path("MoveL p1,v5,z5,t\\Corr;\nMoveL p2,v5,z5,t\\Corr;\nMoveL p1,v5,z5,t;");
    assert_eq!(
        (ids(&program), blocked(&program)),
        (vec!["corrected-by-sensor"; 2], vec![])
    );
}

#[test]
fn wrist_mode_lasts_until_it_is_left() {
    let program = path(
        "MoveL p1,v5,z5,t;\nSingArea\\Wrist;\nsub;\nMoveL p2,v5,z5,t;\nENDPROC\nPROC sub()\nMoveL \
         p1,v5,z5,t;\nSingArea\\Off;",
    );
    let free: Vec<_> = program.moves.iter().map(|m| m.free_orientation).collect();
    assert_eq!(free, [false, false, true]);
}

#[test]
fn arcs_on_which_the_tool_rotates_otherwise_are_blocked() {
    let arcs = "MoveC p1,p2,v5,z5,t;\nCirPathMode\\CirPointOri;\nMoveC p1,p2,v5,z5,t;\n\
        MoveL p3,v5,z5,t;\nCirPathMode\\PathFrame;\nMoveC p1,p2,v5,z5,t;";
    assert_eq!(ids(&path(arcs)), ["move-not-supported"; 2]);
    assert_eq!(
        ids(&path(&arcs.replace("CirPointOri", "PathFrame"))),
        [""; 0]
    );
}

#[test]
fn an_active_displacement_blocks_what_it_may_reach() {
    for set in ["PDispSet d", "PDispAdd d"] {
        let program = path(&format!(
            "MoveL p1,v5,z5,t;\n{set};\nMoveL p2,v5,z5,t;\nPDispOff;\nMoveL p3,v5,z5,t;"
        ));
        assert_eq!(blocked(&program), ["p2"], "{set}");
    }
    let program = path(
        "PDispOn p9,t;\nsub;\nPDispOff;\nENDPROC\nPROC sub()\nMoveL p1,v5,z5,t;\nENDPROC\nPROC \
         c()\nMoveL p2,v5,z5,t;",
    );
    assert_eq!(blocked(&program), ["p1"]);
    let program = path("EOffsSet e;\nENDPROC\nPROC sub()\nMoveL p1,v5,z5,t;");
    assert_eq!(ids(&program), [""; 0], "nothing calls it meanwhile");
    let program = path("EOffsSet e;\nsub;\nENDPROC\nPROC sub()\nMoveL p1,v5,z5,t;");
    assert_eq!(ids(&program), ["external-offset-unknown"]);
    let program = path("WHILE a DO\nMoveL p1,v5,z5,t;\nPDispSet d;\nENDWHILE\nPDispOff;");
    assert_eq!(blocked(&program), ["p1"], "the second time round");
}

#[test]
fn local_data_hide_others_and_double_names_are_ambiguous() {
    let declare = |local: &str, x: i32| {
        format!(
            "{local}CONST robtarget p:=[[{x},0,0],[1,0,0,0],CONF;\nPROC r{x}()\nMoveL \
             p,v5,z5,tool0;\nENDPROC\n"
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
fn a_routine_of_the_files_hides_offs() {
    for name in ["Offs", "RelTool"] {
        let program = path(&format!(
            "MoveL {name}(p1,0,0,5),v5,z5,t;\nENDPROC\nFUNC robtarget {name}(robtarget p,num x,num \
             y,num z)\nRETURN p2;\nENDFUNC\nPROC more()"
        ));
        assert_eq!(to(&program), ["p2"], "{name}");
        assert_eq!(program.moves[0].displacement, Displacement::None, "{name}");
    }
}
