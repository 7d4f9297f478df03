//! What is refused, and how; what must stay as it is.

use super::{errors, profile, profile_at_home, rapid, run, written};
use poseshift::compensate::compensate;
use poseshift::geometry::{Pose, Rotation};
use poseshift::model::profile::Profile;
use poseshift::program;

const TRACK: &str = "external_axes:\n  track:\n    - {axis: eax_a, direction: [1, 0, 0], zero_mm: \
    0, min_mm: 0, max_mm: 2000}\n";
const KRL_TRACK: &str = "external_axes:\n  track:\n    - {axis: E1, direction: [1, 0, 0], zero_mm: \
    0, min_mm: 0, max_mm: 2000}\n";
const TABLE: &str = "external_axes:\n  positioners:\n    - name: STN1\n      axes:\n        - \
    {axis: eax_b, at: {x_mm: 600, y_mm: 0, z_mm: 300, rx_deg: 0, ry_deg: 0, rz_deg: 0}, min_deg: \
    -180, max_deg: 180}\n";
const ARM: &str = "{effect: link_geometry, link: 3, theta_deg: 0.1, a_mm: 0.3}";
const RAIL: &str = "{effect: track_scale, axis: 1, ratio: 5.0e-4}";
const HOME: &str = "MoveAbsJ [[0,0,10,0,60,0],[0,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n";

fn go(x: f64, eax: &str, more: &str) -> String {
    format!(
        "MoveJ [[{x},200,700],[0,0.1,0.9949874371,0],[0,0,0,0],[{eax},9E9,9E9,9E9,9E9]],v100,fine,t{more};\n"
    )
}

fn found(profile: &Profile, data: &str, body: &str) -> Vec<&'static str> {
    let text = rapid(data, body);
    errors(&run(profile, &[("t.mod", &text)]).expect("read"))
}

#[test]
fn a_target_at_two_places_of_the_rail_has_two_fake_targets() {
    let profile = profile(TRACK, &[ARM, RAIL]);
    let text = rapid(
        "",
        &[
            HOME,
            &go(640.0, "100,9E9", ""),
            &go(740.0, "200,9E9", ""),
            &go(640.0, "140,9E9", ""),
        ]
        .concat(),
    );
    let out = written(&profile, &[("t.mod", &text)]);
    let lines: Vec<&str> = out
        .lines()
        .filter(|line| line.starts_with("MoveJ"))
        .collect();
    let x = |line: &str| -> f64 {
        let inside = line.split("[[").nth(1).expect("a target");
        inside
            .split(',')
            .next()
            .expect("a number")
            .parse()
            .expect("a number")
    };
    // the base that goes along sees the same but for the scale of the rail
    let by = x(lines[1]) - x(lines[0]) - 100.0;
    assert!((by + 0.05).abs() < 0.002, "{by}");
    // the same target from another place of the rail
    let numbers = |line: &str| -> Vec<f64> {
        let fields = line
            .split(['[', ']', ','])
            .filter_map(|field| field.parse().ok());
        fields.take(3).collect()
    };
    let (a, b) = (numbers(lines[0]), numbers(lines[2]));
    let most = a
        .iter()
        .zip(&b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    assert!(most > 0.01, "{a:?} {b:?}");
}

#[test]
fn a_target_that_moves_use_at_two_values_is_shared() {
    // an offset makes two of one
    let data = "CONST robtarget \
        p:=[[640,200,700],[0,0.1,0.9949874371,0],[0,0,0,0],[100,9E9,9E9,9E9,9E9,9E9]];";
    let body =
        format!("{HOME}MoveJ p,v100,fine,t;\nEOffsSet [40,0,0,0,0,0];\nMoveJ p,v100,fine,t;\n");
    assert_eq!(
        found(&profile(TRACK, &[ARM, RAIL]), data, &body),
        ["target-shared"]
    );
    let shared = run(
        &profile(TRACK, &[ARM, RAIL]),
        &[("a.mod", &rapid(data, &body))],
    );
    let shared = shared.expect("a program").findings;
    let message = &shared
        .iter()
        .find(|f| f.id == "target-shared")
        .expect("it")
        .message;
    assert!(
        message.contains("differ in where external axes stand"),
        "{message}"
    );
    // without an error of arm or rail nothing is left to tell them apart but the posture
    let off = format!(
        "{HOME}MoveJ p,v100,fine,t;\nEOffsSet [40,0,0,0,0,0];\nEOffsOff;\nMoveJ p,v100,fine,t;\n"
    );
    assert_eq!(found(&profile(TRACK, &[ARM, RAIL]), data, &off), [""; 0]);
}

#[test]
fn a_constant_offset_is_added_and_another_refused() {
    let rail = profile(TRACK, &[ARM, RAIL]);
    let plain = rapid("", &[HOME, &go(640.0, "140,9E9", "")].concat());
    let offset = rapid(
        "",
        &[
            HOME,
            "EOffsSet [40,0,0,0,0,0];\n",
            &go(640.0, "100,9E9", ""),
        ]
        .concat(),
    );
    let last = |text: &str| {
        let out = written(&rail, &[("t.mod", text)]);
        let line = out
            .lines()
            .find(|line| line.starts_with("MoveJ"))
            .expect("a move");
        line.split("],[0,0,0,0]").next().expect("a pose").to_owned()
    };
    assert_eq!(last(&plain), last(&offset));
    for unknown in ["EOffsSet dx;\n", "EOffsOn;\n"] {
        let body = [HOME, unknown, &go(640.0, "100,9E9", "")].concat();
        // the joint target before is not shifted
        assert_eq!(
            found(&rail, "", &body),
            ["external-offset-unknown"],
            "{unknown}"
        );
    }
}

#[test]
fn without_errors_of_arm_and_rail_there_is_nothing_to_correct() {
    let text = rapid("", &[HOME, &go(640.0, "100,9E9", "")].concat());
    assert!(run(&profile(TRACK, &[]), &[("t.mod", &text)]).is_err());
}

#[test]
fn a_rail_is_as_if_the_base_stood_there() {
    let text = rapid("", &[HOME, &go(640.0, "100,9E9", "")].concat());
    let on_rail = written(&profile(TRACK, &[ARM]), &[("t.mod", &text)]);
    // the same base, shifted by hand, and the unit let through
    let mut there = profile("external_axes: {other: [eax_a]}\n", &[ARM]);
    there.world_from_base.translation[0] += 0.1;
    assert_eq!(on_rail, written(&there, &[("t.mod", &text)]));
}

#[test]
fn a_positioner_is_as_if_the_frame_stood_there() {
    let wobj = |fixed: &str, unit: &str, user: &str| {
        format!("PERS wobjdata w:=[FALSE,{fixed},\"{unit}\",[{user}],[[0,0,0],[1,0,0,0]]];")
    };
    let body = "MoveAbsJ [[0,0,10,0,60,0],[9E9,90,9E9,9E9,9E9,9E9]],v100,fine,t;\n\
        MoveJ [[100,30,200],[0,0.1,0.9949874371,0],[0,0,0,0],[9E9,90,9E9,9E9,9E9,9E9]],v100,fine,t\\WObj:=w;\n";
    let carried = rapid(&wobj("FALSE", "STN1", "[9,9,9],[1,0,0,0]"), body);
    let fixed = rapid(
        &wobj("TRUE", "", "[600,0,300],[0.70710678118,0,0,0.70710678118]"),
        body,
    );
    let moves = |profile: &Profile, text: &str| {
        let out = written(profile, &[("t.mod", text)]);
        out.lines()
            .find(|line| line.starts_with("MoveJ"))
            .expect("a move")
            .to_owned()
    };
    let let_through = profile("external_axes: {other: [eax_b]}\n", &[ARM]);
    let reported = moves(&profile(TABLE, &[ARM]), &carried);
    assert_eq!(reported, moves(&let_through, &fixed));
}

#[test]
fn what_the_profile_does_not_describe_is_refused_by_name() {
    let body = [HOME, &go(640.0, "100,9E9", "")].concat();
    assert_eq!(
        found(&profile("", &[ARM]), "", &body),
        ["external-axis-unknown"]
    );
    assert_eq!(
        found(
            &profile("external_axes: {other: [eax_a]}\n", &[ARM]),
            "",
            &body
        ),
        [""; 0]
    );
    let wobj = "PERS wobjdata w:=[FALSE,FALSE,\"STN2\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];";
    let on_unit = [HOME, &go(640.0, "0,9E9", "\\WObj:=w")].concat();
    assert_eq!(
        found(&profile(TABLE, &[ARM]), wobj, &on_unit),
        ["positioner-unknown"]
    );
    assert_eq!(
        found(&profile("", &[ARM]), wobj, &on_unit),
        ["positioner-unknown"]
    );
    for (unit, id) in [("CNV1", "moving-frame"), ("ROB_2", "two-robots")] {
        let wobj = wobj.replace("STN2", unit);
        assert_eq!(found(&profile(TABLE, &[ARM]), &wobj, &on_unit), [id]);
    }
    // the seventh joint of an arm
    let seven = go(640.0, "100,9E9", "").replace("[0,0,0,0]", "[0,0,0,1010]");
    assert_eq!(
        found(&profile("", &[ARM]), "", &[HOME, &seven].concat()),
        ["seven-axis-arm"]
    );
}

#[test]
fn limits_and_values_that_nobody_knows_are_errors() {
    let rail = profile(TRACK, &[ARM, RAIL]);
    let body = |eax: &str| [HOME, &go(640.0, eax, "")].concat();
    assert_eq!(
        found(&rail, "", &body("2000.5,9E9")),
        ["external-axis-limit"]
    );
    assert_eq!(
        found(&rail, "", &body("9E9,9E9")),
        ["external-value-unknown"]
    );
    assert_eq!(found(&rail, "", &body("q,9E9")), ["external-value-unknown"]);
}

#[test]
fn an_offset_in_the_world_needs_one_angle_of_the_positioner() {
    let cell = profile(TABLE, &[ARM]);
    let wobj = "PERS wobjdata w:=[FALSE,FALSE,\"STN1\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];";
    let go = |angle: f64| {
        format!(
            "MoveJ [[40,20,400],[0,0.1,0.9949874371,0],[0,0,0,0],[9E9,{angle},9E9,9E9,9E9,9E9]],\
             v100,fine,t\\WObj:=w;\n"
        )
    };
    let result = |second: f64| {
        let text = rapid(wobj, &format!("{}{}", go(10.0), go(second)));
        let sources = super::sources(&[("t.mod", &text)]);
        let language = program::language_of(&sources[0]).expect("a language");
        let mut options = super::options();
        options.work_offset = Some(Pose::from_translation(0.005, 0.0, 0.0));
        compensate(language, &sources, &cell, &options).map(|_| ())
    };
    assert!(result(10.0).is_ok());
    let refused = result(20.0).expect_err("a part that rotates").to_string();
    assert!(
        refused.starts_with("t.mod:7:")
            && refused.contains("`STN1`")
            && refused.contains("in line 6"),
        "{refused}"
    );
}

#[test]
fn what_a_positioner_does_wrong_is_in_the_offset_of_the_part_that_was_measured_on_it() {
    let zero = "{effect: positioner_zero, axis: 1, deg: 0.05}";
    let cell = profile(TABLE, &[ARM, zero]);
    let text = rapid(
        "PERS wobjdata w:=[FALSE,FALSE,\"STN1\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];",
        "MoveAbsJ [[0,0,10,0,60,0],[9E9,10,9E9,9E9,9E9,9E9]],v100,fine,t;\nMoveL \
         [[40,20,400],[0,0.1,0.9949874371,0],[0,0,0,0],[9E9,10,9E9,9E9,9E9,9E9]],v100,fine,\
         t\\WObj:=w;\n",
    );
    let with = |work_offset: Option<Pose>| {
        let sources = super::sources(&[("t.mod", &text)]);
        let language = program::language_of(&sources[0]).expect("a language");
        let mut options = super::options();
        options.work_offset = work_offset;
        options.correct_joint_targets = true;
        let done = compensate(language, &sources, &cell, &options).expect("read");
        assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
        let written = done
            .written(language, &sources, "", false)
            .expect("written");
        let text = String::from_utf8(written.sources[0].bytes.clone()).expect("ASCII");
        let of_move = text.lines().find(|line| line.contains("MoveL"));
        of_move.expect("the move").to_owned()
    };
    // the table's axis is at x 600 mm, parallel to z
    let axis = Pose::from_translation(0.6, 0.0, 0.0);
    let turned = Pose {
        rotation: Rotation::from_vector([0.0, 0.0, 0.05_f64.to_radians()]),
        ..Pose::identity()
    };
    let touched = axis * turned * axis.inverse();
    assert_eq!(with(Some(touched)), with(None));
    assert_ne!(with(Some(Pose::identity())), with(None));
}

#[test]
fn a_component_that_krl_leaves_out_keeps_its_value() {
    let rail = profile(KRL_TRACK, &[ARM, RAIL]);
    let pose = "X 640,Y 200,Z 700,A 10,B 5,C 170";
    let reported = |body: &str| {
        let text = format!("DEF t()\n$TOOL=TOOL_DATA[1]\n$BASE=$WORLD\n{body}END\n");
        errors(&run(&rail, &[("t.src", &text)]).expect("read"))
    };
    let home = "PTP {A1 0,A2 0,A3 10,A4 0,A5 60,A6 0,E1 100}\n";
    assert_eq!(reported(&format!("{home}PTP {{{pose}}}\n")), [""; 0]);
    let home = "PTP {A1 0,A2 0,A3 10,A4 0,A5 60,A6 0}\n";
    assert_eq!(
        reported(&format!("{home}PTP {{{pose}}}\n")),
        ["external-value-unknown"]
    );
    let both = "IF x THEN\nPTP {A1 0,A2 0,A3 10,A4 0,A5 60,A6 0,E1 100}\nELSE\nPTP {A1 0,A2 0,A3 \
        10,A4 0,A5 60,A6 0,E1 150}\nENDIF\n";
    assert_eq!(
        reported(&format!("{both}PTP {{{pose}}}\n")),
        ["external-value-unknown"]
    );
}

#[test]
fn a_profile_says_where_it_is_wrong() {
    let error = |external: &str, effects: &str| {
        let text = crate::support::text("robots/abb_irb120.yaml");
        let plain = &text[..text.find("calibration:").expect("a list of effects")];
        let lines = plain.lines().count();
        let text = format!("{plain}{external}calibration: {{effects: [{effects}]}}\n");
        let error = Profile::from_yaml(&text).expect_err("a fault");
        (error.line - lines, error.fault.to_string(), error.hint())
    };
    let track = |rest: &str| format!("external_axes:\n  track:\n    - {{axis: E1, {rest}}}\n");
    for (rest, says) in [
        ("direction: [0, 0, 0], min_mm: 0, max_mm: 1", "no direction"),
        (
            "direction: [0, 0, 1], min_mm: 0, max_mm: 1",
            "up is nearly along",
        ),
        (
            "direction: [1, 0, 0], min_mm: 5, max_mm: 1",
            "min_mm 5 is not below max_mm 1",
        ),
        (
            "direction: [1, 0, 0], min_mm: 0, max_mm: 1, pulses_per_mm: -1",
            "above 0",
        ),
        (
            "direction: [1, 0, 0], min_mm: 0, max_mm: 1, length: 3",
            "unknown field `length`",
        ),
    ] {
        let (line, message, _) = error(&track(rest), "");
        assert!(message.contains(says), "{message}");
        assert_eq!(line, 3, "{message}");
    }
    let always = |name: &str, axis: &str| {
        format!(
            "    - name: {name}\n      follows: always\n      axes: [{{axis: {axis}, at: {{x_mm: 0, \
             y_mm: 0, z_mm: 0, rx_deg: 0, ry_deg: 0, rz_deg: 0}}, min_deg: 0, max_deg: 1}}]\n"
        )
    };
    let two = [always("ST1", "EC1"), always("ST2", "EC2")].concat();
    let (line, message, _) = error(&format!("external_axes:\n  positioners:\n{two}"), "");
    assert!(
        message.contains("`ST2`") && message.contains("`ST1`"),
        "{message}"
    );
    assert_eq!(line, 6, "{message}");
    let good = track("direction: [1, 0, 0], min_mm: 0, max_mm: 1000");
    for (effect, says, hint) in [
        (
            "{effect: track_scale, axis: 2, ratio: 1e-4}",
            "axis 2 is not a linear axis",
            "1 is E1",
        ),
        (
            "{effect: positioner_zero, axis: 1, deg: 0.1}",
            "axis 1 is not an axis of a positioner",
            "1 is E1",
        ),
        // a step of 500 mm in a metre
        (
            "{effect: track_scale, axis: 1, ratio: 0.5}",
            "ratio",
            "large: true",
        ),
        (
            "{effect: track_straightness, axis: 1, along: x, degree: 2, mm: 1}",
            "must be one of y, z",
            "",
        ),
        (
            "{effect: track_ripple, axis: 1, along: x, period_mm: 0.0001, cos_mm: 1}",
            "at most three decimals",
            "",
        ),
    ] {
        let (line, message, reported) = error(&good, effect);
        assert!(message.contains(says), "{message}");
        assert!(reported.contains(hint), "{reported}");
        assert_eq!(line, 4);
    }
}

#[test]
fn what_another_robot_or_a_station_carries_is_refused_with_its_reason() {
    // a base on a kinematic of another controller
    let config = |controller: u32| {
        format!(
            "DEFDAT $CONFIG\nFRAME BASE_DATA[32]\nBASE_DATA[7]={{X 10.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C \
             0.0}}\nDECL MACHINE_FRAME_DATA_TYPE x\nMACHINE_FRAME_DAT[7]={{MACH_DEF_INDEX 0,COOP_KRC_INDEX {controller},PARENT[] \" \",GEO \" \"}}\nENDDAT\n"
        )
    };
    let text = "DEF t()\n$TOOL=TOOL_DATA[1]\n$BASE=BASE_DATA[7]\nPTP {A1 0,A2 0,A3 10,A4 0,A5 \
        60,A6 0}\nPTP {X 640,Y 200,Z 700,A 10,B 5,C 170}\nEND\n";
    for (controller, expected) in [(1, &[][..]), (2, &["two-robots"])] {
        let config = config(controller);
        let done = run(
            &profile("", &[ARM]),
            &[("t.src", text), ("$config.dat", &config)],
        );
        let done = done.expect("read");
        assert_eq!(errors(&done), expected, "{:?}", done.findings);
    }
    // a job that is relative to a station
    let job = |attributes: &str, groups: &str| {
        format!(
            "/JOB\n//NAME T\n//POS\n///NPOS 2,0,0,0,0,0\n///TOOL 1\n///POSTYPE \
             ANGLE\n///ANGLE\nC00000=0,0,10,0,60,0\n///USER 3\n///POSTYPE \
             USER\n///RECTAN\n///RCONF 0,0,0,0,0,0,0,0\nC00001=350,100,350,170,5,10\n//INST\n///DATE 2024/01/01 10:00\n///ATTR {attributes}\n///FRAME USER 3\n///GROUP1 RB1\n{groups}NOP\nMOVJ C00000 VJ=5.00\nMOVL C00001 V=30.0\nEND\n"
        )
    };
    for (attributes, groups, expected) in [
        ("SC,RW", "///GROUP2 ST1\n", &[][..]),
        ("SC,RW,RJ", "", &[]),
        ("SC,RW,RJ", "///GROUP2 ST1\n", &["moving-frame"]),
    ] {
        let done = run(
            &profile_at_home(&[ARM]),
            &[("T.JBI", &job(attributes, groups))],
        );
        let done = done.expect("read");
        assert_eq!(errors(&done), expected, "{:?}", done.findings);
    }
}

#[test]
fn a_move_beyond_the_measured_part_of_a_rail_is_reported_once() {
    let bent = "{effect: track_straightness, axis: 1, along: y, degree: 2, mm: 0.4}";
    let mut rail = profile(TRACK, &[ARM, bent]);
    let body = |eax: &str| [HOME, &go(640.0, eax, ""), &go(650.0, eax, "")].concat();
    let reported = |rail: &Profile, eax: &str| {
        let done = run(rail, &[("t.mod", &rapid("", &body(eax)))]).expect("read");
        let found = done
            .findings
            .iter()
            .filter(|f| f.id == "track-extrapolated");
        found.map(|f| f.message.clone()).collect::<Vec<_>>()
    };
    assert!(reported(&rail, "1500,9E9").is_empty());
    let quality = r#"{"track_mm": [[0.0, 1000.0]]}"#;
    rail.quality = Some(serde_json::from_str(quality).expect("JSON"));
    let beyond = reported(&rail, "1500,9E9");
    assert_eq!(beyond.len(), 1, "{beyond:?}");
    assert!(
        beyond[0].contains("1500") && beyond[0].contains("1000"),
        "{beyond:?}"
    );
    assert!(reported(&rail, "900,9E9").is_empty());
}
