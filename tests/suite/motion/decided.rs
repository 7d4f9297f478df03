//! What the user decides: accepted errors, targets split, ways past a singularity, files for their
//! declarations only, good programs next to refused ones.

use super::{BACKLASH, P, PLAIN, done, errors, given, message, profile, rapid, try_with};
use poseshift::compensate::{AtSingularity, Compensation, Options, compensate};
use poseshift::finding::Severity;
use poseshift::geometry::{Pose, Separation};
use poseshift::model::profile::Mounted;
use poseshift::program::{self, Marker, Source};

fn sources(files: &[(&str, &str)]) -> Vec<Source> {
    files
        .iter()
        .map(|(name, text)| Source::new(*name, text.as_bytes().to_vec()))
        .collect()
}

fn written(done: Compensation, files: &[(&str, &str)]) -> Vec<String> {
    let sources = sources(files);
    let language = program::language_of(&sources[0]).expect("a language");
    let written = done
        .written(language, &sources, &"0".repeat(64), false)
        .expect("what is written reads back");
    let text = |source: Source| String::from_utf8(source.bytes).expect("text");
    written.sources.into_iter().map(text).collect()
}

/// A target that a joint with backlash comes to from both sides, in each language that holds
/// targets by name.
fn from_both_sides() -> Vec<(&'static str, String)> {
    let joints = |q2: &str| format!("[[0,{q2},0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]]");
    let rapid = rapid(
        &format!("CONST robtarget p := [[430,0,400],{P};"),
        &format!(
            "MoveAbsJ {},v100,fine,tool0;\nMoveJ p,v100,fine,tool0;\nMoveAbsJ \
             {},v100,fine,tool0;\nMoveJ p,v100,fine,tool0;",
            joints("-20"),
            joints("60")
        ),
    );
    let krl = "DEF t()\nDECL E6POS XP={X 430,Y 0,Z 400,A 0,B 90,C 0,S 2,T \
        2}\n$TOOL=$NULLFRAME\n$BASE=$WORLD\n\
               PTP {A1 0,A2 -20,A3 0,A4 0,A5 60,A6 0}\nPTP XP\nPTP {A1 0,A2 60,A3 0,A4 0,A5 60,A6 \
                   0}\nPTP XP\nEND\n";
    let urscript = "def t():\n  set_tcp(p[0,0,0,0,0,0])\n  p1 = p[0.43,0.0,0.4,0.0,1.5,0.0]\n  \
        movej([0,-0.35,0,0,1.0,0])\n  movej(p1)\n  \
                    movej([0,1.05,0,0,1.0,0])\n  movej(p1)\nend\n";
    let fanuc = "/PROG T\n/MN\n   1:J P[1] 10% FINE ;\n   2:J P[2] 10% FINE ;\n   3:J P[3] 10% \
        FINE ;\n   4:J P[2] 10% FINE ;\n/POS\n\
                 P[1]{\n   GP1:\n    UF : 0, UT : 0,\n    J1 = 0.000 deg, J2 = -20.000 deg, J3 = \
                     0.000 deg,\n    J4 = 0.000 deg, J5 = 60.000 deg, J6 = 0.000 deg\n};\n\
                 P[2]{\n   GP1:\n    UF : 0, UT : 0, CONFIG : 'N U T, 0, 0, 0',\n    X = 430.000 \
                     mm, Y = 0.000 mm, Z = 400.000 mm,\n    W = 180.000 deg, P = 0.000 deg, R = \
                     0.000 deg\n};\n\
                 P[3]{\n   GP1:\n    UF : 0, UT : 0,\n    J1 = 0.000 deg, J2 = 60.000 deg, J3 = \
                     0.000 deg,\n    J4 = 0.000 deg, J5 = 60.000 deg, J6 = 0.000 deg\n};\n/END\n";
    let inform = "/JOB\n//NAME T\n//POS\n///NPOS 3,0,0,0,0,0\n///TOOL 0\n///POSTYPE \
        ANGLE\n///ANGLE\n\
        C00000=0.0000,-20.0000,0.0000,0.0000,60.0000,0.0000\nC00001=0.0000,60.0000,0.0000,0.0000,60.0000,0.0000\n\
        ///POSTYPE BASE\n///RECTAN\n///RCONF 0,0,0,0,0,0,0,0\nC00002=430.000,0.000,400.000,180.0000,0.0000,0.0000\n\
        //INST\n///DATE 2020/01/01 00:00\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\nMOVJ C00000 VJ=10.00\nMOVJ C00002 VJ=10.00\n\
        MOVJ C00001 VJ=10.00\nMOVJ C00002 VJ=10.00\nEND\n";
    vec![
        ("t.mod", rapid),
        ("t.jbi", inform.into()),
        ("t.src", krl.into()),
        ("t.script", urscript.into()),
        ("t.ls", fanuc.into()),
    ]
}

#[test]
fn a_shared_target_is_split_into_one_for_each_move() {
    for (name, text) in from_both_sides() {
        let files = [(name, text.as_str())];
        let shared = try_with(given(), &[BACKLASH], &files).expect("read");
        assert_eq!(errors(&shared), ["target-shared"], "{name}");
        let options = Options {
            split_targets: true,
            ..given()
        };
        let done = try_with(options, &[BACKLASH], &files).expect("read");
        assert_eq!(errors(&done), [""; 0], "{name} {:?}", done.findings);
        assert_eq!(done.added.targets.len(), 2, "{name}");
        let [first, second] = [&done.added.targets[0], &done.added.targets[1]];
        let apart = first.iter().zip(second).map(|(a, b)| (a - b).abs());
        assert!(
            apart.fold(0.0, f64::max) > 1e-4,
            "{name}: {first:?} {second:?}"
        );
        let after = written(done, &files);
        // each lands where it is wanted: nothing is left to correct against the original
        let again = [(name, after[0].as_str())];
        let checked = super::landings(&[BACKLASH], &again, &files);
        assert!(checked < 0.002, "{name}: {checked} mm\n{}", after[0]);
    }
}

#[test]
fn what_can_be_split_is_split_whatever_is_accepted() {
    for (name, text) in from_both_sides() {
        let files = [(name, text.as_str())];
        let options = Options {
            split_targets: true,
            accepted: vec!["target-shared".parse().expect("an acceptance")],
            ..given()
        };
        let done = try_with(options, &[BACKLASH], &files).expect("read");
        assert_eq!(done.added.targets.len(), 2, "{name}");
        assert!(done.findings.iter().all(|f| f.id != "target-shared"));
        assert_eq!(done.decided, [""; 0], "{name}");
    }
}

#[test]
fn a_target_that_points_are_derived_from_is_not_split_and_says_why() {
    let (name, text) = from_both_sides().swap_remove(0);
    let last = "MoveJ p,v100,fine,tool0;\n";
    let behind = text.rfind(last).expect("a move") + last.len();
    let derived = "MoveJ Offs(p,0,0,10),v100,fine,tool0;\n";
    let text = format!("{}{derived}{}", &text[..behind], &text[behind..]);
    let options = Options {
        split_targets: true,
        ..given()
    };
    let done = try_with(options, &[BACKLASH], &[(name, text.as_str())]).expect("read");
    let refused = done.findings.iter().find(|f| f.id == "target-shared");
    let hint = &refused.expect("a finding").hint;
    assert!(hint.contains("derives points from this one"), "{hint}");
}

#[test]
fn a_point_that_is_split_off_has_the_frame_that_is_selected_at_the_move() {
    let at = "CONFIG : 'N U T, 0, 0, 0',\n    X = 430.000 mm, Y = 0.000 mm, Z = 400.000 mm,\n    W = \
              180.000 deg, P = 0.000 deg, R = 0.000 deg\n};\n";
    let of = |select: &str, of_copy: &str| {
        format!(
            "/PROG T\n/MN\n   1:  UFRAME_NUM=0 ;\n   2:  UTOOL_NUM=1 ;\n   3:  PR[5]=P[2] ;\n   \
             4:J P[1] 10% FINE ;\n   5:  {select}_NUM=2 ;\n   6:L PR[5] 100mm/sec FINE ;\n   7:  \
             {select}_NUM={of_copy} ;\n   8:L P[2] 100mm/sec FINE ;\n/POS\nP[1]{{\n   GP1:\n    UF : 0, UT : 1,\n    J1 = 0.000 deg, J2 = -20.000 deg, J3 = 0.000 deg,\n    J4 = 0.000 deg, J5 = 60.000 deg, J6 = 0.000 deg\n}};\nP[2]{{\n   GP1:\n    UF : 0, UT : 1, {at}/END\n"
        )
    };
    for (select, of_copy, first) in [
        ("UTOOL", "1", "UF : 0, UT : 2,"),
        ("UFRAME", "0", "UF : 2, UT : 1,"),
    ] {
        let mut options = Options {
            split_targets: true,
            ..given()
        };
        let mut tool = |name: &str, z_m: f64| {
            let tool = Mounted {
                name: name.to_owned(),
                flange_from_tool: Pose::from_translation(0.0, 0.01, z_m),
                load: None,
            };
            options.given.tools.insert(Some(name.to_owned()), tool);
        };
        tool("1", 0.1);
        if select == "UTOOL" {
            tool("2", 0.15);
        } else {
            let pose = Pose::from_translation(0.0, 0.01, 0.02);
            options.given.frames.insert(Some("2".to_owned()), pose);
        }
        let text = of(select, of_copy);
        let files = [("t.ls", text.as_str())];
        let done = try_with(options, &[PLAIN], &files).expect("read");
        assert_eq!(errors(&done), [""; 0], "{select} {:?}", done.findings);
        let after = written(done, &files).swap_remove(0);
        let point = after.split("P[3]{").nth(1).expect("a point of its own");
        assert!(point.contains(first), "{select}: {after}");
    }
}

#[test]
fn corners_that_are_cut_are_noted_where_directions_count() {
    let (_, text) = from_both_sides().swap_remove(0);
    let cut = text.replace("MoveJ p,v100,fine", "MoveJ p,v100,z10");
    let notes = |text: &str, effect: &str| -> Vec<usize> {
        let done = try_with(given(), &[effect], &[("t.mod", text)]).expect("read");
        let notes = done.findings.iter().filter(|f| f.id == "corner-direction");
        notes.map(|note| note.line).collect()
    };
    let line = 1 + cut
        .lines()
        .position(|line| line.contains("z10"))
        .expect("a corner");
    assert_eq!(notes(&cut, BACKLASH), [line]);
    assert_eq!(notes(&text, BACKLASH), [0; 0]);
    assert_eq!(notes(&cut, PLAIN), [0; 0]);
}

#[test]
fn an_accepted_error_is_a_warning_and_the_marker_records_it() {
    let (name, text) = from_both_sides().swap_remove(0);
    let files = [(name, text.as_str())];
    let accept = |text: &str| Options {
        accepted: vec![text.parse().expect("an acceptance")],
        ..given()
    };
    let done = try_with(accept("target-shared:t.mod:2"), &[BACKLASH, PLAIN], &files).expect("read");
    assert!(!done.is_refused(), "{:?}", done.findings);
    let taken = done.findings.iter().find(|f| f.id == "target-shared");
    assert!(taken.is_some_and(|f| f.accepted && f.severity == Severity::Warning));
    assert_eq!(done.decided, ["accepted target-shared"]);
    // a line where there is none: it is said, and the error stays
    let done = try_with(accept("target-shared:t.mod:3"), &[BACKLASH, PLAIN], &files).expect("read");
    assert!(done.is_refused());
    assert!(done.findings.iter().any(|f| f.id == "acceptance-unused"));
}

#[test]
fn the_marker_of_a_file_names_what_was_accepted() {
    let data =
        format!("CONST robtarget p := [[430,0,400],{P};\nCONST robtarget r := [[400,50,420],{P};");
    let body = "MoveAbsJ [[0,-20,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
        p,v100,fine,tool0;\n\
                MoveAbsJ [[0,60,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
                    p,v100,fine,tool0;\nMoveJ r,v100,fine,tool0;";
    let text = rapid(&data, body);
    let files = [("t.mod", text.as_str())];
    let options = Options {
        accepted: vec!["target-shared".parse().expect("an acceptance")],
        ..given()
    };
    let done = try_with(options, &[BACKLASH], &files).expect("read");
    let after = written(done, &files);
    assert!(
        after[0].contains("! accepted target-shared"),
        "{}",
        after[0]
    );
    assert!(after[0].contains("CONST robtarget p := [[430,0,400],"));
    assert!(Marker::find(after[0].as_bytes()).is_some());
}

#[test]
fn at_the_singularity_of_the_wrist_the_user_chooses_a_way_out() {
    // joint 5 a hundredth of a degree from zero, joint 4 near its limit: the small correction asks
    // it to turn far

    let effects = ["{effect: link_geometry, link: 5, alpha_deg: 0.05}"];
    let profile = profile(&effects);
    let tool = Mounted::flange();
    let controller = profile.controller_model(&tool);
    let mut refused = 0;
    for (q4, q5) in [
        (155.0, 0.01),
        (-155.0, 0.02),
        (158.0, -0.01),
        (-158.0, -0.03),
    ] {
        let q = [10.0_f64, 20.0, 10.0, q4, q5, 30.0].map(f64::to_radians);
        let pose = controller.forward(&q, &poseshift::model::Conditions::default());
        let [w, x, y, z] = pose.rotation.quaternion().0;
        let [px, py, pz] = pose.translation.map(|m| 1e3 * m);
        let text = format!(
            "x_mm,y_mm,z_mm,qw,qx,qy,qz,near1_deg,near2_deg,near3_deg,near4_deg,near5_deg,near6_deg\n\
             {px:.9},{py:.9},{pz:.9},{w:.12},{x:.12},{y:.12},{z:.12},10,20,10,{q4},{q5},30\n"
        );
        let files = [("t.csv", text.as_str())];
        let plain = try_with(given(), &effects, &files).expect("read");
        if !plain.is_refused() {
            continue;
        }
        refused += 1;
        let hint = &plain
            .findings
            .iter()
            .find(|f| f.severity == Severity::Error)
            .expect("an error")
            .hint;
        assert!(hint.contains("--at-singularity"), "{hint}");
        for way in [AtSingularity::Flip, AtSingularity::Nearest] {
            let word = format!("{way:?}").to_lowercase();
            if !hint.contains(&format!("--at-singularity {word}")) {
                continue;
            }
            let options = Options {
                at_singularity: way,
                ..given()
            };
            let done = try_with(options, &effects, &files).expect("read");
            assert_eq!(errors(&done), [""; 0], "{word} {:?}", done.findings);
            assert!(done.findings.iter().any(|f| f.id == "at-singularity"));
            let q = done.targets[0].q.expect("solved");
            let real = profile.real_model(&tool, &poseshift::model::Conditions::default());
            let gap = real
                .forward(&q, &poseshift::model::Conditions::default())
                .separation(&pose);
            assert!(gap.distance_m < 2e-9, "{word} {gap:?}");
            if way == AtSingularity::Flip {
                assert!(gap.angle_rad < 1e-8, "{word} {gap:?}");
                assert!(q[4].signum() != q5.signum(), "{word} {q:?}");
            } else {
                assert!((q[3].to_degrees() - q4).abs() < 1e-6, "{word} {q:?}");
                assert!(gap.angle_rad < 0.01, "{word} {gap:?}");
            }
        }
    }
    assert!(refused >= 2, "{refused} of 4 are refused without a choice");
}

#[test]
fn files_of_context_are_read_and_stay() {
    let tools = "MODULE cell\nPERS tooldata tGun := \
        [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];\nENDMODULE\n";
    let main = rapid(
        &format!("CONST robtarget p := [[430,0,300],{P};"),
        "MoveJ p,v100,fine,tGun;",
    );
    let read = |context: &str| {
        let sources = [
            Source::new("t.mod", main.as_bytes().to_vec()),
            Source::context("cell.sys", context.as_bytes().to_vec()),
        ];
        let language = program::language_of(&sources[0]).expect("a language");
        let options = Options::default();
        let done = compensate(language, &sources, &profile(&[PLAIN]), &options).expect("read");
        let findings = done.findings.clone();
        let targets = done.summary.targets;
        (
            findings,
            targets,
            done.written(language, &sources, "", false)
                .expect("written"),
        )
    };
    let (findings, targets, written) = read(tools);
    assert!(
        findings.iter().all(|f| f.severity != Severity::Error),
        "{findings:?}"
    );
    assert_eq!(targets, 1);
    assert_eq!(written.is_written, [true, false]);
    assert_eq!(written.sources[1].bytes, tools.as_bytes());
    assert_ne!(written.sources[0].bytes, main.as_bytes());
    // a target of a context file that a program goes to must not be left in silence
    let other = rapid("", "MoveJ far,v100,fine,tGun;");
    let context = tools.replace(
        "ENDMODULE",
        &format!("CONST robtarget far := [[430,0,300],{P};\nENDMODULE"),
    );
    let sources = [
        Source::new("t.mod", other.into_bytes()),
        Source::context("cell.sys", context.into_bytes()),
    ];
    let language = program::language_of(&sources[0]).expect("a language");
    let done =
        compensate(language, &sources, &profile(&[PLAIN]), &Options::default()).expect("read");
    assert_eq!(errors(&done), ["target-in-context"]);
    assert!(message(&done, "target-in-context").contains("cell.sys line"));
}

#[test]
fn what_a_context_file_makes_of_a_target_is_reported_at_the_target() {
    let main = rapid(
        &format!("CONST robtarget p := [[430,0,300],{P};"),
        "MoveJ p,v100,fine,tool0;\n go p;",
    );
    let library = "MODULE lib\nPROC go(robtarget q)\nVAR robtarget own;\nown:=q;\n\
        own.trans.z:=260;\nMoveL own,v100,fine,tool0;\nENDPROC\nENDMODULE\n";
    let run = |as_context: bool| {
        let bytes = library.as_bytes().to_vec();
        let sources = [
            Source::new("t.mod", main.as_bytes().to_vec()),
            if as_context {
                Source::context("lib.mod", bytes)
            } else {
                Source::new("lib.mod", bytes)
            },
        ];
        let language = program::language_of(&sources[0]).expect("a language");
        compensate(language, &sources, &profile(&[PLAIN]), &Options::default()).expect("read")
    };
    for (as_context, file) in [(false, "lib.mod"), (true, "t.mod")] {
        let done = run(as_context);
        assert_eq!(errors(&done), ["target-overwritten"], "{:?}", done.findings);
        let found = done.findings.iter().find(|f| f.id == "target-overwritten");
        assert_eq!(found.map(|f| f.file.as_str()), Some(file));
        assert!(!as_context || message(&done, "target-overwritten").contains("line 6 of lib.mod"));
    }
}

#[test]
fn good_programs_are_those_that_share_nothing_with_a_refused_one() {
    let module = |name: &str, body: &str| {
        format!("MODULE {name}\nPROC {name}()\n{body}\nENDPROC\nENDMODULE\n")
    };
    let literal = format!("[[430,0,400],{P}");
    let files = [
        (
            "good.mod",
            module("good", &format!("MoveJ {literal},v100,fine,tool0;")),
        ),
        (
            "bad.mod",
            module("bad", &format!("MoveJ {literal},v100,fine,tNone;")),
        ),
        (
            "calls.mod",
            module(
                "calls",
                &format!(
                    "MoveJ {literal},v100,fine,tool0;\nbad;\nMoveL {literal},v100,fine,tool0;"
                ),
            ),
        ),
    ];
    let files: Vec<(&str, &str)> = files
        .iter()
        .map(|(name, text)| (*name, text.as_str()))
        .collect();
    // by itself an unknown tool ends the run
    assert!(try_with(Options::default(), &[PLAIN], &files).is_err());
    let options = Options {
        each_for_itself: true,
        ..Options::default()
    };
    let done = try_with(options, &[PLAIN], &files).expect("read");
    assert_eq!(errors(&done), ["frame-unknown"]);
    assert!(message(&done, "frame-unknown").contains("tNone"));
    assert_eq!(done.refused, [false, true, true]);
    let sources = sources(&files);
    let language = program::language_of(&sources[0]).expect("a language");
    let written = done.written(language, &sources, "", true).expect("written");
    assert_eq!(written.is_written, [true, false, false]);
    assert_eq!(written.sources[1].bytes, sources[1].bytes);
    assert_ne!(written.sources[0].bytes, sources[0].bytes);
}

#[test]
fn the_correction_has_a_limit_and_the_displacement_of_the_part_has_none() {
    let files = [(
        "t.mod",
        rapid(
            &format!("CONST robtarget p := [[430,0,400],{P};"),
            "MoveAbsJ [[0,-20,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
             p,v100,fine,tool0;",
        ),
    )];
    let files: Vec<(&str, &str)> = files.iter().map(|(n, t)| (*n, t.as_str())).collect();
    let with = |options: Options| try_with(options, &[PLAIN], &files).expect("read");
    let displaced = with(Options {
        work_offset: Some(Pose::from_translation(-0.04, 0.03, 0.0)),
        ..given()
    });
    assert!(!displaced.is_refused(), "{:?}", displaced.findings);
    assert!(displaced.summary.max_shift_m > 1e-5 && displaced.summary.max_shift_m < 2e-3);
    let shift = displaced.summary.max_shift_m;
    let limited = with(Options {
        max_shift: Some(Separation {
            distance_m: 0.5 * shift,
            angle_rad: 1.0,
        }),
        ..given()
    });
    assert_eq!(errors(&limited), ["shift-too-large"]);
    // it stays as far off as it was
    let off = |done: &Compensation| -> Vec<Option<Separation>> {
        done.targets.iter().map(|target| target.before).collect()
    };
    assert!(off(&limited).iter().any(Option::is_some));
    assert_eq!(off(&limited), off(&with(given())));
    assert!(limited.targets.iter().all(|t| t.rounding == t.before));
    assert!(message(&limited, "shift-too-large").contains("--max-shift"));
    assert_eq!(limited.summary.compensated, 0);
    let decided = &limited.decided;
    assert!(decided[0].starts_with("max-shift 0.") && decided[0].ends_with("deg"));
}

#[test]
fn configuration_data_are_of_the_part_where_the_program_has_it() {
    // with the part moved to the other side of y = 0, joints 1 and 6 change their signs: T 4 is
    // right for the program, T 37 for what is written
    let text = "DEF t()\nDECL E6POS XP={X 430,Y 1.0,Z 400,A 0,B 180,C 0,S 2,T 4}\n\
        $TOOL=$NULLFRAME\n$BASE=$WORLD\nPTP {A1 0,A2 -20,A3 0,A4 0,A5 60,A6 0}\nPTP XP\nEND\n";
    let files = [("t.src", text)];
    for (y_mm, turn, is_same) in [(0.0, "T 4}", true), (-2.0, "T 37}", false)] {
        let options = Options {
            work_offset: Some(Pose::from_translation(0.0, 1e-3 * y_mm, 0.0)),
            ..given()
        };
        let done = try_with(options, &[PLAIN], &files).expect("read");
        assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
        let has = |id: &str| done.findings.iter().any(|f| f.id == id);
        assert!(!has("configuration-mismatch"), "{:?}", done.findings);
        assert_eq!(has("configuration-changed"), !is_same);
        let after = written(done, &files);
        assert!(after[0].contains(turn), "{}", after[0]);
    }
}

#[test]
fn joint_targets_that_stay_are_reported_where_the_part_is_moved() {
    let text = "def t():\n  set_tcp(p[0,0,0,0,0,0])\n  movej([0,-0.35,0,0,1.0,0])\n  \
        movel(p[0.43,0.0,0.4,0.0,1.5,0.0])\n  movel([0.1,0.0,0,0,1.0,0])\nend\n";
    let moved = |by: f64, correct_joint_targets: bool| {
        let options = Options {
            work_offset: Some(Pose::from_translation(by, 0.0, 0.0)),
            correct_joint_targets,
            ..given()
        };
        let done = try_with(options, &[PLAIN], &[("t.script", text)]).expect("read");
        let stay = done
            .findings
            .iter()
            .filter(|f| f.id == "joint-target-stays");
        stay.map(|f| (f.line, f.severity)).collect::<Vec<_>>()
    };
    assert_eq!(
        moved(0.005, false),
        [(3, Severity::Warning), (5, Severity::Error)]
    );
    assert_eq!(moved(0.005, true), []);
    assert_eq!(moved(0.0, false), []);
}

#[test]
fn an_effect_without_angles_has_room_for_those_of_the_search() {
    // a limit of no angle at all would refuse what the search leaves
    let files = from_both_sides();
    for (name, text) in &files {
        let files = [(*name, text.as_str())];
        let shift = "{effect: base_frame, x_mm: 0.05}";
        let done = try_with(given(), &[shift], &files).expect("read");
        assert_eq!(errors(&done), [""; 0], "{name} {:?}", done.findings);
    }
}

#[test]
fn a_written_loop_is_checked_against_its_original() {
    // a move that the robot comes to in two ways has two stops in both programs
    let text = rapid(
        &format!("CONST robtarget p := [[430,0,400],{P};\nCONST robtarget r := [[400,60,420],{P};"),
        "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nFOR i FROM 1 TO 3 \
         DO\nMoveL p,v100,fine,tool0;\nMoveL r,v100,fine,tool0;\nENDFOR",
    );
    let files = [("t.mod", text.as_str())];
    let done = try_with(given(), &[PLAIN], &files).expect("read");
    assert_eq!(errors(&done), [""; 0]);
    let after = written(done, &files);
    let again = [("t.mod", after[0].as_str())];
    assert!(super::landings(&[PLAIN], &again, &files) < 0.002);
    assert!(super::landings(&[PLAIN], &files, &files) > 0.1);
}

#[test]
fn an_accepted_target_gets_the_numbers_that_miss_least() {
    let (name, text) = from_both_sides().swap_remove(0);
    let files = [(name, text.as_str())];
    let options = Options {
        accepted: vec!["target-shared".parse().expect("an acceptance")],
        ..given()
    };
    let done = try_with(options, &[BACKLASH, PLAIN], &files).expect("read");
    assert_eq!(done.summary.compensated, 1, "{:?}", done.findings);
    let after = written(done, &files);
    let before = super::landings(&[BACKLASH, PLAIN], &files, &files);
    let landed = super::landings(&[BACKLASH, PLAIN], &[(name, after[0].as_str())], &files);
    assert!(landed < 0.8 * before, "{landed} of {before} mm");
}

#[test]
fn a_part_that_is_written_of_data_that_the_files_do_not_declare_is_not_left_out() {
    let run = |write: &str, more: &str, used: &str| {
        let text = format!(
            "MODULE t\nVAR num x;\nPROC main()\n{write}\nMoveJ [[430,0,400],{P},v100,fine,{used};\n\
             ENDPROC\n{more}\nENDMODULE\n"
        );
        errors(&done(&[PLAIN], &[("t.mod", &text)]))
    };
    let set = "PROC place(INOUT wobjdata w)\nw.oframe.trans.x := 5;\nENDPROC";
    for (write, more, used) in [
        ("w1.oframe.trans.x := -20;", "", "tool0\\WObj:=w1"),
        ("w1.oframe.trans := [x,0,0];", "", "tool0\\WObj:=w1"),
        ("w1.uframe := [[0,0,0],[1,0,0,0]];", "", "tool0\\WObj:=w1"),
        ("w1.ufprog := FALSE;", "", "tool0\\WObj:=w1"),
        ("place w1;", set, "tool0\\WObj:=w1"),
        ("t1.tframe.trans.z := 150;", "", "t1"),
        ("t1.tload.mass := 3;", "", "t1"),
    ] {
        let errors = run(write, more, used);
        assert_eq!(errors, ["frame-assigned-at-run-time"], "{write}");
    }
    // a routine that is not in the files may write what it is given
    assert_eq!(
        run("setw w1;", "", "tool0\\WObj:=w1"),
        ["frame-chosen-at-run-time"]
    );
    // what is written as a whole is known
    let whole = "w1 := [FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[5,0,0],[1,0,0,0]]];";
    assert_eq!(run(whole, "", "tool0\\WObj:=w1"), [""; 0]);
    assert_eq!(run("", "", "tool0\\WObj:=w1"), [""; 0]);
}

#[test]
fn where_nothing_tells_the_posture_that_of_another_move_to_the_target_is_taken() {
    // joints 16, 12, -2, 80, 60, 20 deg; the move in the branch has the wrist on the other side; it
    // says so where it never runs, too
    for condition in ["n == 1", "1 == 2"] {
        let text = format!(
            "def t():\n  set_tcp(p[0,0,0.1,0,0,0])\n  home = \
            p[0.388198,0.263919,0.530188,-0.744695,-2.258760,-1.863143]\n  if ({condition}):\n    \
            movej(get_inverse_kin(home, qnear=[0.279,0.209,-0.035,-1.745,-1.047,-2.793]))\n  \
            end\n  here = get_actual_tcp_pose()\n  movel(here)\n  movej(home)\nend\nt()\n"
        );
        let done = done(&[PLAIN], &[("t.script", &text)]);
        assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
        assert_eq!(done.summary.compensated, 1);
        let assumed = message(&done, "posture-assumed");
        let joints = "joints 16.0, 12.0, -2.0, -100.0, -60.0, -160.0 deg";
        assert!(assumed.contains(joints), "{condition}: {assumed}");
    }
}
