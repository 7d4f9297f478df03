//! Small programs whose thin reading lands elsewhere: what each means, or that it is refused with
//! both places.

use super::{BACKLASH, P, PLAIN, done, errors, given, message, profile_of, rapid, try_with};
use poseshift::compensate::{CompensateError, Options, compensate};
use poseshift::geometry::Pose;
use poseshift::program::{self, Source};

#[test]
fn a_target_that_joints_reach_from_both_sides_is_refused_with_both_lines() {
    // row b: joint 2 comes to p from below and from above
    let data = format!("CONST robtarget p := [[430,0,400],{P};");
    let body = "MoveAbsJ [[0,-20,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
        p,v100,fine,tool0;\n\
                MoveAbsJ [[0,60,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
                    p,v100,fine,tool0;";
    let done = done(&[BACKLASH], &[("t.mod", &rapid(&data, body))]);
    assert_eq!(errors(&done), ["target-shared"]);
    let reported = message(&done, "target-shared");
    assert!(
        reported.contains("line 5") && reported.contains("line 7"),
        "{reported}"
    );
}

#[test]
fn a_target_reached_twice_in_one_way_has_one_fake_target() {
    let data = format!("CONST robtarget p := [[430,0,400],{P};");
    let body = "MoveAbsJ [[0,-20,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
        p,v100,fine,tool0;\n\
                MoveAbsJ [[0,-20,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
                    p,v100,fine,tool0;";
    let done = done(&[BACKLASH, PLAIN], &[("t.mod", &rapid(&data, body))]);
    assert_eq!(errors(&done), [""; 0]);
    assert_eq!(done.summary.compensated, 1);
}

#[test]
fn a_straight_move_keeps_the_branch_of_its_path() {
    // row d: the nearest largest joint change is on the other side of the stretched elbow, a3 =
    // atan(35 / 420)
    let program = "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\nPTP {A1 0,A2 -20,A3 40,A4 0,A5 \
        70,A6 -60}\n\
                   LIN {X 859.202,Y 0,Z 364.860,A -160,B 0,C 180}\nEND\n";
    let kr6 = profile_of(
        "robots/kuka_kr6_r900.yaml",
        &["{effect: link_geometry, link: 3, theta_deg: 0.1}"],
    );
    let source = Source::new("t.src", program.as_bytes().to_vec());
    let language = program::language_of(&source).expect("a language");
    let done = compensate(language, &[source], &kr6, &given()).expect("read");
    assert_eq!(errors(&done), [""; 0]);
    let q = done.targets[1].q.expect("solved");
    assert!(q[2] > (35.0_f64 / 420.0).atan(), "{q:?}");
    assert!(q[4] > 0.0, "joint 5 keeps its sign: {q:?}");
    let shift = done.targets[1].shift.distance_m;
    assert!(shift < 1e-3, "of the path's own branch: {shift}");
}

#[test]
fn an_assignment_in_a_branch_before_the_move_is_refused_with_both_values() {
    // row h
    let data = "PERS wobjdata w1 := \
        [FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\nVAR num n := 0;";
    let body = format!(
        "IF n > 0 THEN\nw1.oframe.trans.x := -20;\nENDIF\nMoveJ \
         [[430,0,400],{P},v100,fine,tool0\\WObj:=w1;"
    );
    let done = done(&[PLAIN], &[("t.mod", &rapid(data, &body))]);
    assert_eq!(errors(&done), ["target-shared"]);
    assert!(
        message(&done, "target-shared").contains("line 6"),
        "{:?}",
        done.findings
    );
}

#[test]
fn an_assignment_behind_the_move_reaches_the_next_run_of_data_that_is_kept() {
    // row h
    let wobj = "wobjdata w1 := [FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];";
    let body =
        format!("MoveJ [[430,0,400],{P},v100,fine,tool0\\WObj:=w1;\nw1.oframe.trans.x := -20;");
    let kept = done(
        &[PLAIN],
        &[("t.mod", &rapid(&format!("PERS {wobj}"), &body))],
    );
    assert_eq!(errors(&kept), ["target-shared"]);
    let before =
        format!("w1.oframe.trans.x := -20;\nMoveJ [[430,0,400],{P},v100,fine,tool0\\WObj:=w1;");
    let before = done(
        &[PLAIN],
        &[("t.mod", &rapid(&format!("PERS {wobj}"), &before))],
    );
    assert_eq!(errors(&before), [""; 0]);
}

#[test]
fn an_assignment_in_a_routine_that_nothing_calls_leaves_the_declaration() {
    // row h
    let text = format!(
        "MODULE t\nPERS wobjdata w1 := [FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n\
         PROC main()\nMoveJ [[430,0,400],{P},v100,fine,tool0\\WObj:=w1;\nENDPROC\n\
         PROC setup()\nw1.oframe.trans.x := -200;\nENDPROC\nENDMODULE\n"
    );
    let done = done(&[PLAIN], &[("t.mod", &text)]);
    assert_eq!(errors(&done), [""; 0]);
    let reported = message(&done, "write-not-called");
    assert!(reported.contains("w1"), "{reported}");
}

#[test]
fn writes_of_instructions_and_functions_are_seen() {
    // row j
    for write in [
        "Add p10.trans.y, 40;",
        "Incr p10.trans.y;",
        "UnpackRawBytes rb, 1, p10.trans.x \\Float4;",
        "ok := StrToVal(s, p10.trans.x);",
    ] {
        let data = format!(
            "PERS robtarget p10 := [[430,0,400],{P};\nVAR rawbytes rb;\nVAR iodev io;\nVAR bool \
             ok;\nVAR string s;"
        );
        let body = format!("{write}\nMoveJ p10,v100,fine,tool0;");
        let text = rapid(&data, &body);
        let alone = done(&[PLAIN], &[("t.mod", &text)]);
        // no move goes to the numbers in the file: they stay
        assert_eq!(errors(&alone), [""; 0], "{write}");
        assert!(message(&alone, "target-assigned-at-run-time").contains("line 8"));
        assert_eq!(alone.summary.compensated, 0, "{write}");
        // a move to them before the write needs them corrected, and the one behind it does not
        let body = format!("MoveJ p10,v100,fine,tool0;\n{write}\nMoveJ p10,v100,fine,tool0;");
        let both = done(&[PLAIN], &[("t.mod", &rapid(&data, &body))]);
        assert_eq!(errors(&both), ["target-assigned-at-run-time"], "{write}");
    }
    // a whole position that is read in: the move stays as it is
    let data = format!("PERS robtarget p10 := [[430,0,400],{P};\nVAR iodev io;");
    let body = "ReadAnyBin io, p10;\nMoveJ p10,v100,fine,tool0;";
    let done = done(&[PLAIN], &[("t.mod", &rapid(&data, body))]);
    assert!(message(&done, "computed-target").contains("run time"));
}

#[test]
fn a_target_given_to_a_function_that_is_not_in_the_files_is_refused() {
    // row k
    let data = format!("PERS robtarget p10 := [[430,0,400],{P};\nVAR bool b;");
    let body = "b := fPlace(p10);\nMoveJ p10,v100,fine,tool0;";
    let done = done(&[PLAIN], &[("t.mod", &rapid(&data, body))]);
    assert!(
        errors(&done).contains(&"target-passed-to-routine"),
        "{:?}",
        done.findings
    );
    assert!(message(&done, "target-passed-to-routine").contains("line 5"));
}

#[test]
fn the_tool_of_the_inverse_is_that_of_its_call() {
    // row l
    let text = "def t():\n  set_tcp(p[0,0,0.15,0,0,0])\n  q = \
        get_inverse_kin(p[0.35,0,0.4,0,3.1415926,0])\n  \
                set_tcp(p[0,0,0,0,0,0])\n  movej(q)\nend\nt()\n";
    let done = done(&[PLAIN], &[("t.script", text)]);
    let used: Vec<_> = done
        .program
        .moves
        .iter()
        .map(|m| {
            done.program.tools[m.tool]
                .flange_from_tool
                .expect("a tool")
                .translation[2]
        })
        .collect();
    assert_eq!(used, [0.15]);
}

#[test]
fn external_axes_that_carry_something_are_refused_until_they_are_described() {
    // row i
    let target =
        |eax: &str| format!("[[430,0,400],[0,0,1,0],[0,0,0,0],[{eax},9E9,9E9,9E9,9E9,9E9]]");
    let one = |eax: &str| {
        let body = format!("MoveJ {},v100,fine,tool0;", target(eax));
        errors(&done(&[PLAIN], &[("t.mod", &rapid("", &body))]))
    };
    assert_eq!(one("9E9"), [""; 0]);
    assert_eq!(one("0"), [""; 0]);
    assert_eq!(one("1500"), ["external-axis-unknown"]);
}

#[test]
fn rounding_may_not_give_the_error_back() {
    // row o: quaternion and coordinates without decimals
    let body = format!("MoveJ [[430,0,400],{P},v100,fine,tool0;");
    let done = done(&[PLAIN], &[("t.mod", &rapid("", &body))]);
    assert_eq!(errors(&done), [""; 0]);
    assert!(done.summary.max_before_m > 2e-4, "{:?}", done.summary);
    assert!(done.summary.max_rounding_m < 1e-6, "{:?}", done.summary);
    assert!(done.summary.max_rounding_rad < 2e-5, "{:?}", done.summary);
}

#[test]
fn a_profile_that_corrects_nothing_marks_nothing() {
    // row q
    let body = format!("MoveJ [[430,0,400],{P},v100,fine,tool0;");
    let files = [("t.mod", &*rapid("", &body))];
    let refused = try_with(given(), &[], &files);
    assert!(matches!(refused, Err(CompensateError::NothingToCorrect)));
    let moved = Options {
        work_offset: Some(Pose::from_translation(0.001, 0.0, 0.0)),
        ..given()
    };
    let moved = try_with(moved, &[], &files).expect("the part is moved");
    assert_eq!(moved.summary.compensated, 1, "{:?}", moved.findings);
}

#[test]
fn conf_off_lasts_across_calls() {
    // row r
    let text = "MODULE t\nPROC main()\nConfL\\Off;\nMoveAbsJ \
        [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\ngo;\nENDPROC\n\
         PROC go()\nMoveL [[420,0,400],[0,0,1,0],[1,1,1,1],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nENDPROC\nENDMODULE\n";
    let done = done(&[PLAIN], &[("t.mod", text)]);
    assert!(
        !done
            .findings
            .iter()
            .any(|f| f.id == "configuration-mismatch"),
        "{:?}",
        done.findings
    );
}

#[test]
fn parameters_bind_at_every_call() {
    let text = format!(
        "MODULE t\nCONST robtarget p1 := [[430,0,400],{P};\nCONST robtarget p2 := \
         [[430,50,400],{P};\n\
         PROC main()\nrm p1;\nrm p2;\nENDPROC\nPROC rm(robtarget p)\nMoveJ \
             p,v100,fine,tool0;\nENDPROC\nENDMODULE\n"
    );
    let done = done(&[PLAIN], &[("t.mod", &text)]);
    assert_eq!(errors(&done), [""; 0]);
    assert_eq!(done.summary.compensated, 2);
}

#[test]
fn a_position_that_the_robot_reported_itself_stays() {
    let data = format!("VAR robtarget here;\nCONST robtarget p1 := [[430,0,400],{P};");
    let body = "MoveJ p1,v100,fine,tool0;\nhere := CRobT(\\Tool:=tool0);\nMoveL \
        here,v100,fine,tool0;\nMoveL p1,v100,fine,tool0;";
    let done = done(&[PLAIN], &[("t.mod", &rapid(&data, body))]);
    assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
    assert_eq!(done.summary.compensated, 1);
}

#[test]
fn a_dead_point_among_used_ones_stays_with_a_note() {
    let data = format!(
        "CONST robtarget p1 := [[430,0,400],{P};\nCONST robtarget old := [[430,0,300],{P};"
    );
    let done = done(
        &[PLAIN],
        &[("t.mod", &rapid(&data, "MoveJ p1,v100,fine,tool0;"))],
    );
    assert_eq!(errors(&done), [""; 0]);
    assert!(message(&done, "target-unused-here").contains("old"));
}

#[test]
fn all_unknown_tools_and_frames_are_named_with_the_options_that_give_them() {
    let body = format!(
        "MoveJ [[430,0,400],{P},v100,fine,tGun\\WObj:=wLeft;\nMoveJ \
         [[430,0,410],{P},v100,fine,tGrip\\WObj:=wRight;"
    );
    let refused = try_with(
        Options::default(),
        &[PLAIN],
        &[("t.mod", &rapid("", &body))],
    );
    let Err(CompensateError::Placement(unknown)) = refused else {
        panic!("refused");
    };
    let hint = unknown.hint();
    for option in [
        "--tool tGun=",
        "--tool tGrip=",
        "--frame wLeft=",
        "--frame wRight=",
    ] {
        assert!(hint.contains(option), "{hint}");
    }
}

#[test]
fn the_joints_before_the_first_move_tell_its_direction() {
    let body = format!("MoveJ [[430,0,400],{P},v100,fine,tool0;");
    let from = |q2: f64| {
        let options = Options {
            start_joints: Some([0.0, q2, 0.1, 0.0, 1.2, 0.0]),
            ..given()
        };
        let done = try_with(options, &[BACKLASH], &[("t.mod", &rapid("", &body))]).expect("read");
        done.targets[0].q.expect("solved")[1]
    };
    // the width of the backlash
    let apart = (from(-0.4) - from(1.2)).abs();
    assert!((apart - 0.1_f64.to_radians()).abs() < 1e-4, "{apart}");
}

/// Reads files as the motion model does.
fn read(files: &[(&str, &str)]) -> program::Program {
    let sources: Vec<Source> = files
        .iter()
        .map(|(name, text)| Source::new(*name, text.as_bytes().to_vec()))
        .collect();
    let language = program::language_of(&sources[0]).expect("a language");
    let settings = program::Settings::default();
    poseshift::motion::read(language, &sources, &settings).expect("read")
}

/// Where the flange is with these joints, degrees, as FANUC writes it.
fn fanuc_pose(joints: [f64; 6]) -> String {
    let profile = super::profile(&[PLAIN]);
    let controller = profile.controller_model(&poseshift::model::profile::Mounted::flange());
    let q = joints.map(f64::to_radians);
    let pose = controller.forward(&q, &poseshift::model::Conditions::default());
    let m = &pose.rotation.0;
    let r = m[1][0].atan2(m[0][0]).to_degrees();
    let p = (-m[2][0]).atan2(m[2][1].hypot(m[2][2])).to_degrees();
    let w = m[2][1].atan2(m[2][2]).to_degrees();
    let [x, y, z] = pose.translation.map(|v| 1e3 * v);
    format!(
        "X = {x:.3} mm, Y = {y:.3} mm, Z = {z:.3} mm,\n    W = {w:.3} deg, P = {p:.3} deg, R = \
         {r:.3} deg"
    )
}

#[test]
fn a_configuration_that_no_solution_has_is_said() {
    let pose = fanuc_pose([0.0, -10.0, 20.0, 60.0, 50.0, 30.0]);
    let done = |first: &str, config: &str| {
        let program = format!(
            "/PROG T\n/MN\n{first}   2:J P[2] 10% FINE ;\n/POS\n\
             P[1]{{\n   GP1:\n    UF : 0, UT : 0,\n    J1 = 0.000 deg, J2 = -10.000 deg, J3 = \
                 20.000 deg,\n    \
             J4 = 60.000 deg, J5 = 50.000 deg, J6 = 30.000 deg\n}};\n\
             P[2]{{\n   GP1:\n    UF : 0, UT : 0, CONFIG : '{config}, 0, 0, 0',\n    {pose}\n}};\n/END\n"
        );
        done(&[PLAIN], &[("t.ls", &program)])
    };
    let after = "   1:J P[1] 10% FINE ;\n";
    for flip in ['N', 'F'] {
        let side = |config: &str, is_said: bool| {
            let done = done(after, &format!("{flip} {config}"));
            assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
            let said = done
                .findings
                .iter()
                .any(|f| f.id == "configuration-mismatch");
            assert_eq!(said, is_said, "{flip} {config}: {:?}", done.findings);
            done.targets[1].q.expect("solved")[4].signum()
        };
        // joint 1 does not go so far round that the wrist is behind it
        assert_eq!(side("U T", false), side("U B", true), "{flip}");
        let alone = done("", &format!("{flip} U B"));
        assert!(
            errors(&alone).contains(&"configuration-unknown"),
            "{flip}: {:?}",
            alone.findings
        );
    }
}

#[test]
fn whole_rotations_of_a_joint_move_are_those_of_config() {
    // row e: behind J6 = -290 the rotation nearest to the joints before is another than CONFIG
    // gives
    let pose = fanuc_pose([0.0, -10.0, 20.0, 10.0, 50.0, 179.95]);
    let program = |flip: char, turn: i32| {
        format!(
            "/PROG T\n/MN\n   1:J P[1] 10% FINE ;\n   2:J P[2] 10% FINE ;\n/POS\n\
             P[1]{{\n   GP1:\n    UF : 0, UT : 0,\n    J1 = 0.000 deg, J2 = -10.000 deg, J3 = \
                 20.000 deg,\n    \
             J4 = 10.000 deg, J5 = 50.000 deg, J6 = -290.000 deg\n}};\n\
             P[2]{{\n   GP1:\n    UF : 0, UT : 0, CONFIG : '{flip} U T, 0, 0, {turn}',\n    \
             {pose}\n}};\n/END\n"
        )
    };
    let joint_6 = |turn: i32| -> Vec<f64> {
        ['N', 'F']
            .iter()
            .filter_map(|flip| {
                let done = done(&[PLAIN], &[("t.ls", &program(*flip, turn))]);
                let agrees = !done
                    .findings
                    .iter()
                    .any(|f| f.id == "configuration-mismatch");
                let q = done.targets[1].q.filter(|_| agrees)?;
                Some(q[5].to_degrees())
            })
            .collect()
    };
    let near = |found: Vec<f64>, q6: f64| found.iter().any(|q| (q - q6).abs() < 2.0);
    assert!(near(joint_6(0), 179.95), "{:?}", joint_6(0));
    assert!(near(joint_6(-1), -180.05), "{:?}", joint_6(-1));
}

#[test]
fn a_move_to_a_position_that_nobody_understands_does_not_vanish() {
    // row n: the move behind it does not begin where the one before it ended
    let rapid = rapid(
        &format!("CONST robtarget p := [[430,0,400],{P};\nVAR robtarget where;"),
        "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
         fSomewhere(3),v100,fine,tool0;\nMoveL p,v100,fine,tool0;",
    );
    let fanuc = "/PROG T\n/MN\n   1:J P[1] 10% FINE ;\n   2:J PR[5] 10% FINE ;\n   3:L P[2] \
        100mm/sec FINE ;\n/POS\n\
        P[1]{\n   GP1:\n    UF : 0, UT : 0,\n    J1 = 0.000 deg, J2 = 0.000 deg, J3 = 0.000 \
            deg,\n    J4 = 0.000 deg, J5 = 60.000 deg, J6 = 0.000 deg\n};\n\
        P[2]{\n   GP1:\n    UF : 0, UT : 0, CONFIG : 'N U T, 0, 0, 0',\n    X = 430.000 mm, Y = \
            0.000 mm, Z = 400.000 mm,\n    W = 180.000 deg, P = 0.000 deg, R = 0.000 \
            deg\n};\n/END\n";
    let urscript = "def t():\n  set_tcp(p[0,0,0,0,0,0])\n  movej([0,-1.0,1.0,0,1.0,0])\n  \
        movel(somewhere(3))\n  movel(p[0.43,0.0,0.4,0.0,1.5,0.0])\nend\n";
    let inform = "/JOB\n//NAME T\n//POS\n///NPOS 2,0,0,1,0,0\n///TOOL 0\n///POSTYPE \
        BASE\n///RECTAN\n///RCONF 0,0,0,0,0,0,0,0\n\
        C00000=430.000,0.000,500.000,180.0000,0.0000,0.0000\nC00001=430.000,0.000,400.000,180.0000,0.0000,0.0000\n\
        //INST\n///DATE 2020/01/01 00:00\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\nMOVJ C00000 VJ=10.00\nMOVJ P[I001] VJ=10.00\nMOVL C00001 V=100.0\nEND\n";
    for (name, text) in [
        ("t.mod", rapid.as_str()),
        ("t.ls", fanuc),
        ("t.script", urscript),
        ("t.jbi", inform),
    ] {
        let program = read(&[(name, text)]);
        let targets: Vec<bool> = program.moves.iter().map(|m| m.target.is_some()).collect();
        assert_eq!(targets, [true, false, true], "{name}");
        let before = program.before(&program.moves[2]);
        assert_eq!(before, [program::Before::One(1)], "{name}");
    }
}

#[test]
fn numbers_written_over_a_part_of_a_copy_lose_their_correction() {
    let program = |write: &str| {
        rapid(
            &format!("CONST robtarget p := [[430,0,300],{P};\nVAR robtarget here;"),
            &format!(
                "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
                 p,v100,fine,tool0;\nhere := p;\n{write}\nMoveL here,v100,fine,tool0;"
            ),
        )
    };
    let over = done(&[PLAIN], &[("t.mod", &program("here.trans.z := 320;"))]);
    assert_eq!(errors(&over), ["target-overwritten"], "{:?}", over.findings);
    let script = |write: &str| {
        format!(
            "def t():\n  set_tcp(p[0,0,0,0,0,0])\n  p1 = p[0.43,0.0,0.3,0.0,3.14159,0.0]\n  \
             movej([0,0,0,0,1.0,0])\n  movej(p1)\n  \
             q = p1\n  {write}\n  movel(q)\nend\n"
        )
    };
    let over = done(&[PLAIN], &[("t.script", &script("q[2] = 0.32 # above"))]);
    assert_eq!(errors(&over), ["target-overwritten"], "{:?}", over.findings);
    let more = done(&[PLAIN], &[("t.script", &script("q[2] = q[2] + 0.02"))]);
    assert_eq!(errors(&more), [""; 0], "{:?}", more.findings);
    // what is added to the old value takes the correction along
    let more = done(
        &[PLAIN],
        &[("t.mod", &program("here.trans.z := here.trans.z + 20;"))],
    );
    assert_eq!(errors(&more), [""; 0], "{:?}", more.findings);
    assert!(
        more.findings.iter().any(|f| f.id.starts_with("displace")),
        "{:?}",
        more.findings
    );
}

#[test]
fn connecting_a_trap_calls_nothing() {
    let program = |connect: &str| {
        format!(
            "MODULE t\nCONST robtarget p := [[430,0,300],{P};\nPERS tooldata tA := \
             [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];\n\
             VAR intnum i1;\nPROC main()\n{connect}MoveJ p,v100,fine,tA;\nENDPROC\nTRAP \
                 tMeas\ntA.tframe.trans.z := 140;\nENDTRAP\nENDMODULE\n"
        )
    };
    // the trap may run at any time in both: what it writes is uncertain everywhere
    for connect in ["", "CONNECT i1 WITH tMeas;\n"] {
        let done = done(&[PLAIN], &[("t.mod", &program(connect))]);
        assert!(done.is_refused(), "{connect}: {:?}", done.findings);
    }
}

#[test]
fn a_side_that_nobody_knows_is_reported() {
    let program = rapid(
        &format!("CONST robtarget p := [[430,0,400],{P};"),
        "MoveJ p,v100,fine,tool0;",
    );
    let files = [("t.mod", program.as_str())];
    let unknown = done(&[BACKLASH], &files);
    assert!(message(&unknown, "direction-uncertain").contains("joint 2"));
    let options = Options {
        start_joints: Some([0.0, -0.5, 0.0, 0.0, 1.0, 0.0]),
        ..given()
    };
    let known = try_with(options, &[BACKLASH], &files).expect("read");
    assert!(!known.findings.iter().any(|f| f.id == "direction-uncertain"));
}

/// A target that is come to from a point at a height that the running program is given.
fn from_a_height(height: &str, first: &str) -> String {
    format!(
        "MODULE t\nCONST robtarget p := [[430,0,400],{P};\nPROC rGo(robtarget at,num h)\n\
         MoveJ Offs(at,0,0,{height}),v100,fine,tool0;\nMoveL at,v100,fine,tool0;\nENDPROC\n\
         PROC main()\n\
         MoveAbsJ [[0,-20,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n{first}rGo \
         p,AInput(ai1);\nENDPROC\nENDMODULE\n"
    )
}

#[test]
fn behind_a_point_that_only_the_running_program_knows_no_side_is_known() {
    let text = from_a_height("h", "");
    let unknown = done(&[BACKLASH], &[("t.mod", &text)]);
    // the point may be 0.4 mm off, from whichever side joint 2 comes
    assert_eq!(errors(&unknown), ["displacement-unknown"]);
    let options = Options {
        max_derived_error_m: Some(5e-4),
        ..given()
    };
    let unknown = try_with(options, &[BACKLASH], &[("t.mod", &text)]).expect("read");
    assert_eq!(errors(&unknown), [""; 0], "{:?}", unknown.findings);
    let reported = message(&unknown, "direction-uncertain");
    for word in ["line 4", "`p`", "joint 2", "in the middle"] {
        assert!(reported.contains(word), "{word}: {reported}");
    }
    // the middle of the backlash is where the nominal arm stands
    assert!(unknown.targets[0].shift.distance_m < 1e-9);
    // the same with the number in the text: joint 2 comes from the side of the height
    let written = done(&[BACKLASH], &[("t.mod", &from_a_height("44", ""))]);
    let is_uncertain = |f: &poseshift::finding::Finding| f.id == "direction-uncertain";
    assert!(!written.findings.iter().any(is_uncertain));
    assert!(written.targets[0].shift.distance_m > 1e-4);
}

#[test]
fn numbers_for_a_known_side_serve_an_unknown_one_with_a_warning() {
    let text = from_a_height("h", "MoveJ p,v100,fine,tool0;\n");
    let options = Options {
        max_derived_error_m: Some(1e-3),
        ..given()
    };
    let done = try_with(options, &[BACKLASH], &[("t.mod", &text)]).expect("read");
    assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
    let reported = message(&done, "direction-uncertain");
    assert!(reported.contains("as in line 9"), "{reported}");
    assert!(done.targets[0].shift.distance_m > 1e-4);
}

#[test]
fn a_point_displaced_twice_by_what_the_program_knows_is_judged_from_both_sides() {
    let text = from_a_height("h", "").replace("MoveL at,", "MoveL Offs(at,0,0,-h),");
    let done = done(&[BACKLASH], &[("t.mod", &text)]);
    assert!(done.findings.iter().all(|f| f.id != "direction-uncertain"));
    let found = done
        .findings
        .iter()
        .filter(|f| f.id == "displacement-unknown");
    let both = found.filter(|f| f.message.contains("whichever side joint 2"));
    assert_eq!(both.count(), 2, "{:?}", done.findings);
}
