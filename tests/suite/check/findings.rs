//! What a check says of single moves: singularities, configurations, turns, reach; how sure it is;
//! whole circles.

use super::{THESIS, joint_move, part, profile, rapid, run};
use crate::support::{poseshift, repository, scratch};
use poseshift::check::cell::Cell;
use poseshift::check::{Check, Options};
use poseshift::compensate::compensate;
use poseshift::finding::Severity;
use poseshift::geometry::{norm, sub};
use poseshift::model::{Conditions, Model};
use poseshift::program::Source;
use poseshift::program::rapid::Rapid;

/// A straight move to where joints would bring the nominal arm, with configuration data.
fn straight_to(q: [f64; 6], by_mm: [f64; 3], configuration: [i32; 4]) -> String {
    let profile = profile(THESIS);
    let tool = profile.tool("artifact").expect("its tool");
    let model = profile.controller_model(&tool);
    let pose = model.forward(&q.map(f64::to_radians), &Conditions::default());
    let t: Vec<String> = (0..3)
        .map(|k| format!("{:.6}", 1e3 * pose.translation[k] + by_mm[k]))
        .collect();
    let r = pose.rotation.quaternion().0.map(|x| format!("{x:.10}"));
    format!(
        "    MoveL [[{}],[{}],{configuration:?},[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\n",
        t.join(","),
        r.join(",")
    )
}

fn checked(lines: &str) -> Check {
    run(
        &profile(THESIS),
        None,
        &rapid(lines),
        None,
        &Options::default(),
    )
}

fn ids(check: &Check) -> Vec<(&'static str, Severity)> {
    check.findings.iter().map(|f| (f.id, f.severity)).collect()
}

#[test]
fn the_slower_of_translation_and_rotation_says_how_long_a_move_takes() {
    // the tool rotates by 45 degrees, at 500 deg/s
    let q = [10.0, 0.0, 0.0, 0.0, 60.0, 0.0];
    let rotated = straight_to([10.0, 0.0, 0.0, 0.0, 60.0, 45.0], [0.0; 3], [0, 0, 0, 0]);
    let of = |speed: &str| {
        let lines = joint_move(q) + "    ConfL\\Off;\n" + &rotated.replace("v100", speed);
        let found = checked(&lines);
        let limits = found.moves[1].limits.as_ref().expect("limits");
        let fast = found.findings.iter().find(|f| f.id == "joint-speed");
        (
            limits.duration_s.expect("seconds"),
            fast.map(|f| f.message.clone()),
        )
    };
    let (fast, said) = of("v7000");
    assert!((fast - 0.09).abs() < 1e-6, "{fast}");
    // joint 6 rotates by 500 deg/s on the mean, and can 420
    let said = said.expect("too fast");
    assert!(said.contains("joint 6 would rotate at 5"), "{said}");
    let (slow, said) = of("v5");
    assert!(slow > 1.0 && said.is_none(), "{slow} {said:?}");
}

#[test]
fn of_joints_that_are_too_fast_the_one_farthest_beyond_its_speed_is_named() {
    let q = [10.0, 0.0, 0.0, 0.0, 60.0, 0.0];
    let fast = straight_to(q, [0.0, 0.0, -60.0], [0, 0, 0, 0]).replace("v100", "v7000");
    let found = checked(&(joint_move(q) + "    ConfL\\Off;\n" + &fast));
    let said = found.findings.iter().find(|f| f.id == "joint-speed");
    let said = &said.expect("too fast").message;
    let joint: usize = said
        .split("joint ")
        .nth(1)
        .and_then(|t| t[..1].parse().ok())
        .expect("one");
    let number = |text: &str| -> f64 {
        text.split(' ')
            .next()
            .and_then(|t| t.parse().ok())
            .expect("a number")
    };
    let rate = number(said.split("rotate at ").nth(1).expect("its rate"));
    // the fastest of all, for those beyond are alike here
    let limits = found.moves[1].limits.as_ref().expect("limits");
    let fastest = limits.rate_rad / limits.duration_s.expect("seconds");
    assert!(
        (rate - fastest.to_degrees()).abs() < 0.1,
        "joint {joint}: {rate} of {fastest}"
    );
    assert!(said.contains("other"), "{said}");
}

#[test]
fn a_straight_move_past_a_stretched_wrist_is_warned_of() {
    // the tool keeps its orientation and goes down: joints 2 and 3 pass where joint 5 is zero
    let q = [10.0, 0.0, 0.0, 0.0, 4.0, 0.0];
    let off = "    ConfL\\Off;\n";
    let near = checked(&(joint_move(q) + off + &straight_to(q, [0.0, 0.0, -60.0], [0, 0, 0, 0])));
    assert!(
        ids(&near).contains(&("near-singularity", Severity::Warning)),
        "{:?}",
        near.findings
    );
    let q = [10.0, 0.0, 0.0, 0.0, 60.0, 0.0];
    let far = checked(&(joint_move(q) + off + &straight_to(q, [0.0, 0.0, -60.0], [0, 0, 0, 0])));
    assert!(
        !ids(&far).iter().any(|(id, _)| *id == "near-singularity"),
        "{:?}",
        far.findings
    );
}

#[test]
fn a_configuration_that_a_straight_move_cannot_reach_is_an_error() {
    let from = [10.0, 10.0, 10.0, 60.0, 40.0, 10.0];
    let by = [10.0, 15.0, 5.0];
    let same = checked(&(joint_move(from) + &straight_to(from, by, [0, 0, 0, 0])));
    assert!(!same.is_refused(), "{:?}", same.findings);
    // joints 4 and 6 rotated by half, joint 5 to the other side
    let other = checked(&(joint_move(from) + &straight_to(from, by, [0, -2, -2, 1])));
    assert!(
        ids(&other).contains(&("configuration-change", Severity::Error)),
        "{:?}",
        other.findings
    );
}

#[test]
fn limits_count_at_a_target_that_the_robot_comes_to_from_an_unknown_place() {
    // joint 1 ends at 165 degrees, joint 5 at 120
    let found = checked(&joint_move([170.0, 0.0, 0.0, 0.0, 122.0, 0.0]));
    let limit = found.findings.iter().find(|f| f.id == "joint-limit");
    let message = &limit.expect("the first target counts").message;
    let worst_first = message.find("joint 1 leaves its limits by 5.000");
    let then = message.find("joint 5 leaves its limits by 2.000");
    assert!(worst_first < then && worst_first.is_some(), "{message}");
    let near = checked(&joint_move([164.5, 0.0, 0.0, 0.0, 30.0, 0.0]));
    assert!(ids(&near).contains(&("near-joint-limit", Severity::Warning)));
    let margin_rad = near.moves[0].limits.expect("limits").margin_rad;
    assert!((margin_rad.to_degrees() - 0.5).abs() < 1e-6, "{margin_rad}");
}

#[test]
fn a_straight_move_past_axis_1_leaves_the_limits_though_both_ends_are_inside() {
    let from = [60.0, 0.0, 20.0, 0.0, 70.0, 0.0];
    let to = [-120.0, 0.0, 20.0, 0.0, 70.0, 0.0];
    let lines = joint_move(from) + "    ConfL\\Off;\n" + &straight_to(to, [0.0; 3], [-2, 0, 0, 0]);
    let found = checked(&lines);
    // axis 1 would go on to 240 degrees
    let limit = found
        .findings
        .iter()
        .find(|f| f.id == "joint-limit")
        .expect("it is found");
    assert!(
        limit.severity == Severity::Error
            && limit.message.contains("joint 1 leaves its limits by 75.0"),
        "{}",
        limit.message
    );
    assert!(ids(&found).contains(&("configuration-change", Severity::Error)));
}

#[test]
fn a_straight_move_through_the_shoulder_is_out_of_reach_though_both_ends_are_not() {
    // the wrist at the height of axis 2, 0.2 m before it, and as far behind it; elbow and forearm
    // differ by 40 mm
    let from = [90.0, 10.0, 62.1, 0.0, 30.0, 0.0];
    let lines = joint_move(from) + "    ConfL\\Off;\n";
    let through =
        checked(&(lines.clone() + &straight_to(from, [10.0, -412.0, 0.0], [-1, 0, 0, 0])));
    let reported = through
        .findings
        .iter()
        .find(|f| f.id == "path-out-of-reach")
        .expect("it is found");
    assert!(
        reported.severity == Severity::Error && reported.message.contains("out of reach at 40 %"),
        "{}",
        reported.message
    );
    let given = checked(&(lines + &straight_to(from, [150.0, -20.0, 0.0], [0, 0, 0, 0])));
    assert!(
        !ids(&given).iter().any(|(id, _)| *id == "path-out-of-reach"),
        "{:?}",
        given.findings
    );
}

#[test]
fn near_a_singularity_numbers_are_those_of_samples() {
    let q = [10.0, 0.0, 0.0, 0.0, 4.0, 0.0];
    let off = "    ConfL\\Off;\n";
    let found = checked(&(joint_move(q) + off + &straight_to(q, [0.0, 0.0, -60.0], [0, 0, 0, 0])));
    let limits = found.moves[1].limits.expect("it comes from the first");
    assert!(limits.margin_rad.abs() < 7.0, "{limits:?}");
    assert!(found.moves[1].path.is_some_and(|path| !path.certified));
}

#[test]
fn a_wrist_that_turns_more_than_half_a_turn_is_noted() {
    let at = |q6: f64| joint_move([0.0, 0.0, 0.0, 0.0, 30.0, q6]);
    let found = checked(&(at(-150.0) + &at(150.0)));
    let note = found
        .findings
        .iter()
        .find(|f| f.id == "large-turn")
        .expect("it is noted");
    assert!(
        note.severity == Severity::Note && note.message.contains("joint 6 rotates by 300.0"),
        "{}",
        note.message
    );
    assert!(!found.is_refused());
}

fn command(arguments: &[&str]) -> (i32, String) {
    let output = poseshift()
        .current_dir(repository(""))
        .args(arguments)
        .output()
        .expect("the program starts");
    let status = output.status.code().expect("it ended");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, error) = (text(&output.stdout), text(&output.stderr));
    (status, if out.is_empty() { error } else { out })
}

#[test]
fn a_calibrated_robot_is_predicted_with_an_uncertainty_that_grows_with_the_noise() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let mut state = 5;
    let mut joints = String::from("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n");
    for _ in 0..60 {
        let half = [150.0, 60.0, 50.0, 140.0, 110.0, 170.0];
        let q = half.map(|h| format!("{:.4}", h * (2.0 * part(&mut state) - 1.0)));
        joints += &format!("{}\n", q.join(","));
    }
    std::fs::write(at("joints.csv"), joints).expect("a writable folder");
    let program = "MODULE t
  PERS tooldata artifact := [TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];
  PROC main()
    MoveAbsJ [[20,10,10,10,40,10],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,artifact;
  ENDPROC
ENDMODULE
";
    std::fs::write(at("t.mod"), program).expect("a writable folder");
    let robot = "robots/abb_irb120_thesis.yaml";
    let mut sigmas = Vec::new();
    for noise in ["0.02", "0.1"] {
        let simulate = [
            "simulate",
            "--profile",
            robot,
            "--joints",
            &at("joints.csv"),
            "--noise-mm",
            noise,
            "--seed",
            "4",
            "-o",
            &at("m.csv"),
        ]
        .map(str::to_owned);
        let (status, reported) = command(&simulate.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(status, 0, "{reported}");
        let (m, c, t) = (at("m.csv"), at("c.yaml"), at("t.mod"));
        let calibrate = [
            "calibrate",
            "--profile",
            robot,
            "--measurements",
            &m,
            "-o",
            &c,
        ];
        let (status, reported) = command(&calibrate);
        assert_eq!(status, 0, "{reported}");
        let (status, text) = command(&["check", &t, "--profile", &c]);
        assert_eq!(status, 0, "{text}");
        assert!(text.contains(" \u{b1} "), "{text}");
        let (_, text) = command(&["check", &t, "--profile", &c, "--json"]);
        let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        sigmas.push(
            report["moves"][0]["uncertainty_mm"]
                .as_f64()
                .unwrap_or_else(|| panic!("{text}")),
        );
    }
    // five times the noise, five times the uncertainty, as far as 60 rows tell the noise
    let ratio = sigmas[1] / sigmas[0];
    assert!((3.0..8.0).contains(&ratio), "{sigmas:?}");
    assert!((0.001..0.05).contains(&sigmas[0]), "{sigmas:?}");
}

#[test]
fn a_whole_circle_stays_one_within_the_limit() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let point = |x: f64, y: f64| {
        format!(
            "[[{x:.4},{y:.4},300.1234],[0.0001,0.0000,0.9999,0.0000],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
        )
    };
    let (a, b, c, d) = (
        point(500.0, 0.0),
        point(380.0, 120.0),
        point(260.0, 0.0),
        point(380.0, -120.0),
    );
    let text = format!(
        "MODULE t
  PERS tooldata artifact := [TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];
  PROC main()
    ConfL\\Off;
    ConfJ\\Off;
    MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,artifact;
    MoveJ {a},v200,fine,artifact;
    MoveC {b},{c},v100,z1,artifact;
    MoveC {d},{a},v100,fine,artifact;
  ENDPROC
ENDMODULE
"
    );
    std::fs::write(at("t.mod"), text).expect("a writable folder");
    let robot = "robots/abb_irb120_thesis.yaml";
    let mut worst = Vec::new();
    for (name, limit) in [("plain.mod", "10"), ("fine.mod", "0.03")] {
        let (t, out) = (at("t.mod"), at(name));
        let (status, reported) = command(&[
            "compensate",
            &t,
            "--profile",
            robot,
            "--max-path-error",
            limit,
            "-o",
            &out,
        ]);
        assert_eq!(status, 0, "{reported}");
        let (_, json) = command(&["check", &out, "--nominal", &t, "--profile", robot, "--json"]);
        let report: serde_json::Value = serde_json::from_str(&json).expect("JSON");
        let moves = report["moves"].as_array().expect("moves");
        let arcs = moves.iter().filter(|m| m["kind"] == "arc");
        let errors = arcs.filter_map(|m| m["max_path_error_mm"].as_f64());
        worst.push(errors.fold(0.0, f64::max));
    }
    assert!(worst[0] > 0.03 && worst[1] <= 0.03, "{worst:?}");
    // nothing but arcs was put in
    let fine = std::fs::read_to_string(at("fine.mod")).expect("it was written");
    assert!(
        fine.matches("MoveC").count() > 2 && !fine.contains("MoveL"),
        "{fine}"
    );
}

#[test]
fn a_collision_that_only_compensation_makes_is_found_and_named() {
    let profile = profile(THESIS);
    let tool = profile.tool("artifact").expect("its tool");
    let q = [0.0, 20.0, 10.0, 0.0, 30.0, 0.0];
    let original = rapid(&joint_move(q));
    let correct = poseshift::compensate::Options {
        correct_joint_targets: true,
        ..poseshift::compensate::Options::default()
    };
    let mut compensation = compensate(&Rapid, &original, &profile, &correct).expect("compensated");
    let fake = compensation.targets[0].q.expect("it converged");
    let edits = compensation.edits.remove(0);
    let written = [Source::new("t.mod", edits.apply(&original[0].bytes))];
    // the tool is where it should be, the forearm is not
    let conditions = Conditions::default();
    let real = profile.real_model(&tool, &conditions);
    let forearm = |model: &Model, q: &[f64; 6]| model.link_frames(q, &conditions)[3].translation;
    let radians = q.map(f64::to_radians);
    let wanted = forearm(&profile.controller_model(&tool), &radians);
    let (before, after) = (forearm(&real, &radians), forearm(&real, &fake));
    let away = sub(after, wanted);
    let gap_m = norm(away);
    assert!(gap_m > 1e-4, "{gap_m}");
    // a ball of 1 mm that one of 20 mm on the forearm touches by half the gap
    let ball: [f64; 3] =
        std::array::from_fn(|k| wanted[k] + away[k] / gap_m * (0.021 + 0.5 * gap_m));
    assert!(norm(sub(before, ball)) > 0.021, "uncompensated it is clear");
    let allowed: Vec<String> = (1..=6)
        .flat_map(|link| {
            ["ball", "bulge"].map(|body| format!("{{a: link{link}, b: {body}, allow: true}}"))
        })
        .collect();
    let text = format!(
        "poseshift: cell/1\nbodies:\n  - {{name: ball, sphere_mm: {{radius: 1}}, at: {{x_mm: {}, \
         y_mm: {}, z_mm: {}, rx_deg: 0, ry_deg: 0, rz_deg: 0}}}}\nattached: [{{name: bulge, to: \
         link3, sphere_mm: {{radius: 20}}}}]\npairs: [{}]\n",
        1e3 * ball[0],
        1e3 * ball[1],
        1e3 * ball[2],
        allowed.join(", ")
    );
    let cell = Cell::from_yaml(&text).expect("a cell");
    let options = Options::default();
    let found = run(&profile, Some(&cell), &original, None, &options);
    assert_eq!(
        (found.summary.collisions, found.summary.nominal_collisions),
        (0, 0)
    );
    let found = run(&profile, Some(&cell), &written, Some(&original), &options);
    assert_eq!(
        (found.summary.collisions, found.summary.nominal_collisions),
        (1, 0)
    );
    let reported = found.findings.iter().find(|f| f.id == "collision");
    let message = &reported.expect("a finding").message;
    assert!(
        message.contains("the real arm's bulge touches ball"),
        "{message}"
    );
}

#[test]
fn a_target_in_reach_of_a_base_at_the_origin_names_the_base() {
    let folder = scratch();
    let base = "base: {x_mm: 0, y_mm: 0, z_mm: 0";
    assert!(THESIS.contains(base));
    let (here, moved) = (
        folder.path().join("here.yaml"),
        folder.path().join("moved.yaml"),
    );
    std::fs::write(&here, THESIS).expect("scratch");
    std::fs::write(
        &moved,
        THESIS.replace(base, "base: {x_mm: 5000, y_mm: 0, z_mm: 0"),
    )
    .expect("scratch");
    let lines = straight_to([10.0, 0.0, 0.0, 0.0, 60.0, 0.0], [0.0; 3], [0, 0, 0, 0]);
    std::fs::write(folder.path().join("p.mod"), &rapid(&lines)[0].bytes).expect("scratch");
    let run = |profile: &std::path::Path| {
        let mut command = poseshift();
        command
            .current_dir(folder.path())
            .args(["check", "p.mod", "--profile"]);
        let out = command.arg(profile).output().expect("the program starts");
        String::from_utf8_lossy(&out.stderr).into_owned() + &String::from_utf8_lossy(&out.stdout)
    };
    let named = "kinematics.base of the profile is at (5000, 0, 0) mm";
    let reported = run(&moved);
    assert!(
        reported.contains("out-of-reach") && reported.contains(named),
        "{reported}"
    );
    let reported = run(&here);
    assert!(!reported.contains("out-of-reach"), "{reported}");
}

#[test]
fn a_target_that_no_correction_explains_is_not_one_of_the_original() {
    let joints = "    MoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\n";
    let program = |by_mm: f64| {
        let line = straight_to(
            [0.0, 12.0, 12.0, 0.0, 60.0, 0.0],
            [by_mm, 0.0, 0.0],
            [0, 0, 0, 0],
        );
        rapid(&format!("    ConfL\\Off;\n{joints}{line}"))
    };
    let found = |by_mm: f64| {
        let (original, options) = (program(0.0), Options::default());
        let check = run(
            &profile(THESIS),
            None,
            &program(by_mm),
            Some(&original),
            &options,
        );
        let elsewhere = check.findings.iter().filter(|f| f.id == "target-elsewhere");
        elsewhere.map(|f| (f.severity, f.line)).collect::<Vec<_>>()
    };
    assert_eq!(found(15.0), []);
    let [(severity, line)] = found(30.0)[..] else {
        panic!("{:?}", found(30.0));
    };
    assert_eq!(severity, Severity::Warning);
    assert!(line > 0);
}

#[test]
fn joints_rotate_as_fast_with_backlash_as_without() {
    let target = |y: f64| {
        format!(
            "[[400,{y},300],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\n"
        )
    };
    let lines = joint_move([0.0, 0.0, 0.0, 0.0, 60.0, 0.0])
        + &format!("    ConfL\\Off;\n    MoveL {}", target(-250.0))
        + &format!("    MoveL {}", target(235.0));
    let backlash = (1..7)
        .map(|joint| format!("\n    - {{effect: backlash, joint: {joint}, width_deg: -0.05}}"));
    let backlash: String = backlash.collect();
    let with = THESIS.replace("\n  effects:", &format!("\n  effects:{backlash}"));
    assert_ne!(with, THESIS);
    let rates = |text: &str| {
        let sources = rapid(&lines);
        let found = run(&profile(text), None, &sources, None, &Options::default());
        let moves = found.moves.iter().skip(1);
        let rates = moves.map(|m| m.limits.as_ref().expect("limits").rate_rad);
        rates.collect::<Vec<_>>()
    };
    let (plain, loose) = (rates(THESIS), rates(&with));
    for (a, b) in plain.iter().zip(&loose) {
        assert!((a / b - 1.0).abs() < 0.05, "{plain:?} {loose:?}");
    }
}

#[test]
fn sides_that_nobody_knows_and_moves_that_are_not_followed_are_reported() {
    let backlash = "\n  effects:\n    - {effect: backlash, joint: 1, width_deg: 0.05}";
    let loose = THESIS.replace("\n  effects:", backlash);
    let target = "[[350,-100,300],[0,0,1,0],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    let found = |lines: &str, start_joints: Option<[f64; 6]>| {
        let options = Options {
            start_joints,
            ..Options::default()
        };
        let found = run(&profile(&loose), None, &rapid(lines), None, &options);
        let about = |id: &str| {
            let of = found.findings.iter().find(|f| f.id == id)?;
            Some((of.severity, of.message.clone()))
        };
        (about("direction-uncertain"), about("not-followed"))
    };
    let go = format!("    MoveJ {target},v100,fine,artifact;\n");
    let (uncertain, left) = found(&go, None);
    let (severity, said) = uncertain.expect("the first side");
    // half of 0.05 deg at some 0.36 m
    assert!(
        severity == Severity::Warning && said.contains("0.159 mm"),
        "{said}"
    );
    assert_eq!(left, None);
    let away = [-40.0, 10.0, 20.0, 0.0, 60.0, 0.0].map(f64::to_radians);
    assert_eq!(found(&go, Some(away)).0, None);
    let steps = format!(
        "    CONST robtarget p:={target};\n    ConfL\\Off;\n    FOR i FROM 0 TO 9 DO\n    MoveL \
         Offs(p,0,i*10,0),v100,fine,artifact;\n    ENDFOR\n"
    );
    let (_, left) = found(
        &(joint_move([-20.0, 10.0, 20.0, 0.0, 60.0, 0.0]) + &steps),
        None,
    );
    assert_eq!(left.map(|(severity, _)| severity), Some(Severity::Warning));
}
