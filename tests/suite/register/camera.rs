//! `handeye` by command: robot poses from the calibrated model, and corners that the robot touched.

use super::{noisy, normal, random_pose, seeded};
use crate::support::{poseshift, random_joints, repository, scratch, text};
use poseshift::geometry::{Pose, Quaternion, Rotation, Vector, norm, sub};
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use rand::rngs::StdRng;
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;

const MM: f64 = 1e-3;
const THESIS: &str = "robots/abb_irb120_thesis.yaml";

fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = poseshift()
        .current_dir(folder)
        .arg("handeye")
        .args(arguments)
        .output()
        .expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.code(),
        text(&output.stdout),
        text(&output.stderr),
    )
}

fn report(folder: &Path, arguments: &[&str]) -> Value {
    let all: Vec<&str> = arguments.iter().copied().chain(["--json"]).collect();
    let (status, out, reported) = run(folder, &all);
    assert_eq!(status, Some(0), "{reported}");
    serde_json::from_str(&out).expect("JSON and nothing else")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// How far a pose of the report puts this point from where the truth has it, mm.
fn miss_mm(found: &Value, truth: &Pose, at: Vector) -> f64 {
    let place = ["x_mm", "y_mm", "z_mm"].map(|key| MM * number(&found[key]));
    let turn = std::array::from_fn(|k| number(&found["quaternion"][k]));
    let pose = Pose::from_parts(place, Quaternion(turn).normalized());
    norm(sub(pose.transform(at), truth.transform(at))) / MM
}

fn poses(all: &[Pose]) -> String {
    let mut text = String::from("x_mm,y_mm,z_mm,qw,qx,qy,qz\n");
    for pose in all {
        let [x, y, z] = pose.translation.map(|v| v / MM);
        let [w, i, j, k] = pose.rotation.quaternion().0;
        writeln!(text, "{x},{y},{z},{w},{i},{j},{k}").expect("text");
    }
    text
}

/// Joint angles of an arm and where its flange stands then.
fn postures(random: &mut StdRng, profile: &str, count: usize) -> (String, Vec<Pose>) {
    let profile = Profile::from_yaml(profile).expect("a profile");
    // the arm carries the profile's only tool
    let mut flange = Mounted::flange();
    flange.load = profile.tools.values().next().and_then(|tool| tool.load);
    let arm = profile.real_model(&flange, &Conditions::default());
    let mut table = String::from("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n");
    let mut flanges = Vec::new();
    for _ in 0..count {
        let q = random_joints(random, &profile);
        table += &(q.map(|q| q.to_degrees().to_string()).join(",") + "\n");
        flanges.push(arm.forward(&q, &Conditions::default()));
    }
    (table, flanges)
}

#[test]
fn joints_and_the_calibrated_model_keep_the_arms_error_out_of_the_camera() {
    let folder = scratch();
    let at = folder.path();
    let mut random = seeded(40);
    let (camera, board) = (
        Pose::from_xyz_rxryrz([0.05, -0.03, 0.09, 0.4, -0.2, 1.0]),
        Pose::from_xyz_rxryrz([0.6, 0.1, 0.02, 0.05, 0.0, 0.7]),
    );
    let (joints, flanges) = postures(&mut random, &text(THESIS), 24);
    let seen: Vec<Pose> = flanges
        .iter()
        .map(|f| camera.inverse() * f.inverse() * board)
        .collect();
    std::fs::write(at.join("joints.csv"), joints).expect("scratch");
    std::fs::write(at.join("board.csv"), poses(&seen)).expect("scratch");
    let thesis = text(THESIS);
    let effects = thesis.find("  effects:").expect("its calibration");
    std::fs::write(
        at.join("nominal.yaml"),
        format!("{}  effects: []\n", &thesis[..effects]),
    )
    .expect("scratch");
    let calibrated = repository(THESIS).display().to_string();
    let with = |profile: &str| {
        report(
            at,
            &[
                "joints.csv",
                "board.csv",
                "--setup",
                "eye-in-hand",
                "--profile",
                profile,
            ],
        )
    };
    let (real, nominal) = (with(&calibrated), with("nominal.yaml"));
    assert!(
        miss_mm(&real["camera"], &camera, [0.0; 3]) < 1e-6,
        "{}",
        real["camera"]
    );
    assert!(miss_mm(&real["board"], &board, [0.0; 3]) < 1e-6);
    // frames left aside, the nominal model is off by more than half a millimetre
    assert!(number(&real["residual_mm"]) < 1e-6);
    assert!(
        number(&nominal["residual_mm"]) > 0.1,
        "{}",
        nominal["residual_mm"]
    );
    assert!(
        miss_mm(&nominal["camera"], &camera, [0.0; 3]) > 0.02,
        "{}",
        nominal["camera"]
    );
    let (status, _, reported) = run(at, &["joints.csv", "board.csv", "--setup", "eye-in-hand"]);
    assert!(
        status == Some(2) && reported.contains("--profile"),
        "{reported}"
    );
    // of several tools springs must know which they carry
    let two = text(THESIS).replacen("tools:\n", "tools:\n  other: {mass_kg: 1, frame: {x_mm: 0, y_mm: 0, z_mm: 90, rx_deg: 0, ry_deg: 0, rz_deg: 0}}\n", 1);
    std::fs::write(at.join("two.yaml"), two).expect("scratch");
    let files = ["joints.csv", "board.csv", "--setup", "eye-in-hand"];
    let (status, _, reported) = run(at, &[&files[..], &["--profile", "two.yaml"]].concat());
    assert!(
        status == Some(2) && reported.contains("choose one with --tool"),
        "{reported}"
    );
    let of_one = [&files[..], &["--profile", "two.yaml", "--tool", "artifact"]].concat();
    let found = report(at, &of_one);
    assert!(miss_mm(&found["camera"], &camera, [0.0; 3]) < 1e-6);
}

#[test]
fn with_joints_frames_are_where_fk_has_the_flange_wherever_the_chain_begins() {
    let folder = scratch();
    let at = folder.path();
    let mut random = seeded(41);
    let (camera, board) = (
        Pose::from_xyz_rxryrz([1.5, 0.1, 1.2, 3.0, 0.2, -0.3]),
        Pose::from_xyz_rxryrz([0.02, 0.01, 0.1, 0.1, 0.0, 0.7]),
    );
    // FANUC's world is as high as axis 2, and other chains begin upside down
    let moved = "base: {x_mm: 100, y_mm: 0, z_mm: -450, rx_deg: 180";
    let profile = text(THESIS).replace("base: {x_mm: 0, y_mm: 0, z_mm: 0, rx_deg: 0", moved);
    assert!(profile.contains(moved));
    let (joints, flanges) = postures(&mut random, &profile, 24);
    let seen: Vec<Pose> = flanges
        .iter()
        .map(|f| camera.inverse() * *f * board)
        .collect();
    std::fs::write(at.join("profile.yaml"), profile).expect("scratch");
    std::fs::write(at.join("joints.csv"), joints).expect("scratch");
    std::fs::write(at.join("poses.csv"), poses(&flanges)).expect("scratch");
    std::fs::write(at.join("board.csv"), poses(&seen)).expect("scratch");
    let setup = ["board.csv", "--setup", "eye-to-hand"];
    let by_poses = [&["poses.csv"][..], &setup].concat();
    let by_joints = [&["joints.csv"][..], &setup, &["--profile", "profile.yaml"]].concat();
    for arguments in [by_poses, by_joints] {
        let found = report(at, &arguments);
        let off = miss_mm(&found["camera"], &camera, [0.0; 3]);
        assert!(off < 1e-6, "{arguments:?}: {}", found["camera"]);
    }
}

/// Rows `touched, seen` of corners, as the command reads them.
fn corners(rows: &[(Vector, Vector, usize)]) -> String {
    let mut text = String::from("x_mm,y_mm,z_mm,cx_mm,cy_mm,cz_mm,row\n");
    for (touched, seen, row) in rows {
        let cells: Vec<String> = touched
            .iter()
            .chain(seen)
            .map(|v| (v / MM).to_string())
            .collect();
        writeln!(text, "{},{row}", cells.join(",")).expect("text");
    }
    text
}

#[test]
fn touched_corners_correct_the_camera_of_both_setups() {
    for setup in ["eye-to-hand", "eye-in-hand"] {
        let folder = scratch();
        let at = folder.path();
        let mut random = seeded(41);
        let (camera, board) = (random_pose(&mut random, 0.4), random_pose(&mut random, 0.3));
        let flanges: Vec<Pose> = (0..20).map(|_| random_pose(&mut random, 0.6)).collect();
        let in_hand = setup == "eye-in-hand";
        // the board is seen with 1 mm and 0.2 deg of noise, corners with 0.02 mm
        let look = |flange: &Pose, random: &mut StdRng| {
            let carried = if in_hand { flange.inverse() } else { *flange };
            let noise = Pose {
                rotation: Rotation::from_vector([0.0; 3].map(|_: f64| 3.5e-3 * normal(random))),
                translation: [0.0; 3].map(|_: f64| MM * normal(random)),
            };
            camera.inverse() * carried * board * noise
        };
        let seen: Vec<Pose> = flanges.iter().map(|f| look(f, &mut random)).collect();
        let rows: Vec<(Vector, Vector, usize)> = (0..16_u8)
            .map(|i| {
                let row = usize::from(i % 4);
                let spot = [
                    0.04 * f64::from(i % 4),
                    0.05 * f64::from(i / 4),
                    0.4 + 0.01 * f64::from(i % 3),
                ];
                let base_from_camera = if in_hand {
                    flanges[row] * camera
                } else {
                    camera
                };
                let touched = noisy(&mut random, base_from_camera.transform(spot), 2e-5);
                (touched, noisy(&mut random, spot, 2e-5), row + 1)
            })
            .collect();
        std::fs::write(at.join("robot.csv"), poses(&flanges)).expect("scratch");
        std::fs::write(at.join("board.csv"), poses(&seen)).expect("scratch");
        std::fs::write(at.join("corners.csv"), corners(&rows)).expect("scratch");
        let base = ["robot.csv", "board.csv", "--setup", setup];
        let without = report(at, &base);
        assert!(without["corners"].is_null());
        let with: Vec<&str> = base
            .into_iter()
            .chain(["--corners", "corners.csv", "-o", "camera.yaml"])
            .collect();
        let with = report(at, &with);
        let reported = &with["corners"];
        assert_eq!(reported["accepted"], true, "{setup}: {reported}");
        assert!(
            number(&reported["left_out_mm"]) < 0.5 * number(&reported["before_mm"]),
            "{reported}"
        );
        // where the corners are; at the camera itself their noise is some times as large
        let work = [0.06, 0.075, 0.41];
        let rough = miss_mm(&without["camera"], &camera, work);
        let fine = miss_mm(&with["camera"], &camera, work);
        println!("{setup}: {rough:.3} mm by the board, {fine:.3} mm with corners");
        assert!(fine < 0.5 * rough, "{setup}: {rough} {fine}");
        let frame = std::fs::read_to_string(at.join("camera.yaml")).expect("written");
        assert!(frame.starts_with("poseshift: frame/1"), "{frame}");

        // corners that are seen with 10 mm of noise make nothing better
        let others: Vec<_> = rows
            .iter()
            .map(|(touched, seen, row)| (*touched, noisy(&mut random, *seen, 0.01), *row))
            .collect();
        std::fs::write(at.join("others.csv"), corners(&others)).expect("scratch");
        let all: Vec<&str> = base
            .into_iter()
            .chain(["--corners", "others.csv"])
            .collect();
        let kept = report(at, &all);
        assert_eq!(kept["corners"]["accepted"], false);
        assert_eq!(kept["camera"], without["camera"]);
        assert!(
            kept["findings"]
                .to_string()
                .contains("corners-not-accepted")
        );
    }
}

#[test]
fn bad_corners_are_refused_with_their_place() {
    let folder = scratch();
    let at = folder.path();
    let data = |name: &str| {
        repository("tests/data/register")
            .join(name)
            .display()
            .to_string()
    };
    let (robot, board) = (data("robot.csv"), data("board.csv"));
    let head = "x_mm,y_mm,z_mm,cx_mm,cy_mm,cz_mm,row\n";
    for (rows, word) in [
        ("1,2,3,4,5,6,99\n", "ROBOT has rows 1 to"),
        ("1,2,3,4,5,6,1.5\n", "row 1.5"),
        ("1,2,3,4,x,6,1\n", "cy_mm"),
        ("1,2,3,4,5,6,1\n9,2,3,4,5,6,1\n", "corners"),
    ] {
        std::fs::write(at.join("corners.csv"), format!("{head}{rows}")).expect("scratch");
        let (status, _, reported) = run(
            at,
            &[
                &robot,
                &board,
                "--setup",
                "eye-in-hand",
                "--corners",
                "corners.csv",
                "-o",
                "camera.yaml",
            ],
        );
        assert!(
            status == Some(2) && reported.contains(word),
            "{word}: {reported}"
        );
        assert!(!at.join("camera.yaml").exists());
    }
}

#[test]
fn other_units_and_rows_that_stand_out_do_not_pass_in_silence() {
    let folder = scratch();
    let at = folder.path();
    let mut random = seeded(44);
    let (camera, board) = (
        Pose::from_xyz_rxryrz([0.05, -0.03, 0.09, 0.4, -0.2, 1.0]),
        Pose::from_xyz_rxryrz([0.6, 0.1, 0.02, 0.05, 0.0, 0.7]),
    );
    let (_, flanges) = postures(&mut random, &text(THESIS), 20);
    let mut seen: Vec<Pose> = flanges
        .iter()
        .map(|f| camera.inverse() * f.inverse() * board)
        .collect();
    for pose in &mut seen {
        pose.translation = noisy(&mut random, pose.translation, 1e-4);
    }
    let write = |name: &str, all: &[Pose], factor: f64| {
        let mut all = all.to_vec();
        for pose in &mut all {
            pose.translation = pose.translation.map(|x| factor * x);
        }
        std::fs::write(at.join(name), poses(&all)).expect("scratch");
    };
    let with = ["robot.csv", "board.csv", "--setup", "eye-in-hand"];
    for (robot, board, word) in [
        (1.0, 1e-3, "BOARD's positions times 1000"),
        (1e-3, 1.0, "ROBOT's positions times 1000"),
        (1.0, 1.0 / 25.4, "BOARD's positions times 25.4"),
        (1e-3, 1e-3, "are they in metres?"),
    ] {
        write("robot.csv", &flanges, robot);
        write("board.csv", &seen, board);
        let (status, _, reported) = run(at, &with);
        let flat = reported.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            status == Some(2) && flat.contains(word),
            "{word}: {reported}"
        );
    }
    write("robot.csv", &flanges, 1.0);
    write("board.csv", &seen, 1.0);
    assert_eq!(report(at, &with)["findings"], Value::Array(Vec::new()));
    seen[6].translation[0] += 0.02;
    write("board.csv", &seen, 1.0);
    let found = report(at, &with);
    let messages = found["findings"].as_array().expect("findings");
    assert!(
        messages.len() == 1 && messages[0].to_string().contains("row 7 "),
        "{messages:?}"
    );
}
