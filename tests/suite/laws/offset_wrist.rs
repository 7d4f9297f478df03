//! The inverse of an arm whose axis 6 passes axis 5 at a distance.

use crate::support::{random_joints, run, scratch, shipped_profiles, text};
use poseshift::geometry::{Pose, wrap};
use poseshift::inverse::{Arm, Inverse, Status, TOLERANCE_M, TOLERANCE_RAD};
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;

const POSES: usize = 10_000;
const FILE: &str = "robots/yaskawa_ma1400.yaml";
/// Errors of some tenths of a millimetre and a degree.
const EFFECTS: &str = "effects:
    - {effect: base_frame, x_mm: 1.2, y_mm: -0.8, z_mm: 0.5, rx_deg: 0.03, ry_deg: -0.05, rz_deg: 0.1}
    - {effect: link_geometry, link: 2, a_mm: 0.3, alpha_deg: 0.05, theta_deg: -0.12}
    - {effect: link_geometry, link: 3, a_mm: -0.4, alpha_deg: -0.03, beta_deg: 0.04}
    - {effect: link_geometry, link: 5, alpha_deg: 0.06, a_mm: 0.2, d_mm: -0.3}
    - {effect: link_geometry, link: 6, alpha_deg: -0.08, a_mm: 0.25}
    - {effect: joint_harmonic, joint: 4, order: 1, cos_deg: 0.02, sin_deg: -0.03}
";

fn arm_of(profile: &Profile) -> Arm {
    Arm::of(&profile.geometry(&Mounted::flange()), &profile.mechanism).expect("an offset wrist")
}

fn nominal() -> Profile {
    let is = |(name, _): &(String, Profile)| name == "yaskawa_ma1400.yaml";
    shipped_profiles().into_iter().find(is).expect("shipped").1
}

fn calibrated_text() -> String {
    let (before, _) = {
        let text = text(FILE);
        let (before, after) = text.split_once("effects: []").expect("a nominal profile");
        (before.to_owned(), after.to_owned())
    };
    before + EFFECTS
}

#[test]
fn postures_away_from_the_borders_are_found_without_knowing_them() {
    let profile = nominal();
    let (arm, model) = (
        arm_of(&profile),
        profile.controller_model(&Mounted::flange()),
    );
    let mut random = StdRng::seed_from_u64(11);
    let (mut clear, mut same, mut found) = (0, 0, 0);
    for _ in 0..POSES {
        let q = random_joints(&mut random, &profile);
        let wanted = model.forward(&q, &Conditions::default());
        let (branch, margins) = arm.posture(&q);
        let solution = arm.solve_branch(&wanted, branch, &[0.0; 6]);
        if solution.beyond == 0.0 {
            found += 1;
            let gap = model
                .forward(&solution.q, &Conditions::default())
                .separation(&wanted);
            assert!(
                gap.distance_m < 1e-11 && gap.angle_rad < 1e-10,
                "{q:?} {gap:?}"
            );
        }
        if arm.is_only_posture(&margins) {
            clear += 1;
            assert_eq!(solution.beyond, 0.0, "{q:?}");
            same += usize::from((0..6).all(|i| wrap(solution.q[i] - q[i]).abs() < 1e-8));
        }
    }
    println!("{found} of {POSES} found; of {clear} clear ones {same} as they were");
    assert!(2 * clear > POSES, "{clear}");
    assert!(1000 * same >= 997 * clear, "{same} of {clear}");
    assert!(100 * found >= 97 * POSES, "{found}");
}

#[test]
fn the_calibrated_inverse_converges_from_postures_some_degrees_away() {
    let profile = Profile::from_yaml(&calibrated_text()).expect("a calibrated profile");
    let conditions = Conditions::default();
    let inverse = Inverse {
        arm: arm_of(&profile),
        real: profile.real_model(&Mounted::flange(), &conditions),
        conditions,
    };
    let mut random = StdRng::seed_from_u64(12);
    let (mut clear, mut converged, mut all) = (0, 0, 0);
    for _ in 0..POSES {
        let q = random_joints(&mut random, &profile);
        let wanted = inverse.real.forward(&q, &inverse.conditions);
        let (branch, margins) = inverse.arm.posture(&q);
        let near = q.map(|q| q + random.random_range(-0.1..0.1));
        let outcome = inverse.solve(&wanted, branch, &near);
        let is_found = matches!(outcome.status, Status::Converged | Status::JointLimit(_));
        all += usize::from(is_found);
        if is_found {
            let gap = inverse
                .real
                .forward(&outcome.q, &inverse.conditions)
                .separation(&wanted);
            assert!(gap.distance_m < TOLERANCE_M && gap.angle_rad < TOLERANCE_RAD);
        }
        if inverse.arm.is_only_posture(&margins) {
            clear += 1;
            converged += usize::from(is_found);
        }
    }
    println!("{all} of {POSES} converge; of {clear} clear ones {converged}");
    assert_eq!(converged, clear);
    assert!(100 * all >= 99 * POSES, "{all}");
}

#[test]
fn a_path_lands_and_poses_near_a_border_are_reported() {
    let profile = Profile::from_yaml(&calibrated_text()).expect("a calibrated profile");
    let (arm, tool) = (arm_of(&profile), Mounted::flange());
    let nominal = profile.controller_model(&tool);
    let real = profile.real_model(&tool, &Conditions::default());
    let joints = [
        [20.0, 10.0, -15.0, 30.0, 40.0, -60.0],
        [-35.0, 25.0, 5.0, -20.0, 30.0, 45.0],
        // axes 4 and 6 in line but for 3 degrees
        [10.0, 15.0, -10.0, 12.0, 87.0, 20.0],
    ]
    .map(|q: [f64; 6]| q.map(f64::to_radians));
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let (given, written, by) = (at("path.csv"), at("fake.csv"), at("real.yaml"));
    std::fs::write(&by, calibrated_text()).expect("scratch");
    let mut rows = String::from("id,x_mm,y_mm,z_mm,qw,qx,qy,qz\n");
    for (k, q) in joints.iter().enumerate() {
        let pose = nominal.forward(q, &Conditions::default());
        let [x, y, z] = pose.translation.map(|m| 1e3 * m);
        let [w, i, j, k_] = pose.rotation.quaternion().0;
        rows += &format!("{k},{x:.6},{y:.6},{z:.6},{w:.10},{i:.10},{j:.10},{k_:.10}\n");
    }
    std::fs::write(&given, rows).expect("scratch");
    let (status, json, error) = run(&[
        "compensate",
        &given,
        "--profile",
        &by,
        "-o",
        &written,
        "--tool",
        "0,0,0,0,0,0",
        "--json",
    ]);
    assert_eq!(status, 0, "{error}");
    let report: Value = serde_json::from_str(&json).expect("JSON");
    let reported: Vec<_> = report["findings"]
        .as_array()
        .expect("findings")
        .iter()
        .filter(|f| f["id"] == "several-postures")
        .collect();
    assert_eq!(reported.len(), 1, "{report}");
    assert_eq!(reported[0]["line"], 4);
    let poses = |file: &str| -> Vec<Pose> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_path(file)
            .expect("a table");
        let rows = reader.records().map(|row| {
            let row = row.expect("a row");
            let n: Vec<f64> = (1..8).map(|k| row[k].parse().expect("a number")).collect();
            let q = poseshift::geometry::Quaternion([n[3], n[4], n[5], n[6]]);
            Pose::from_parts([n[0] / 1e3, n[1] / 1e3, n[2] / 1e3], q.normalized())
        });
        rows.collect()
    };
    for ((wanted, fake), q) in poses(&given).iter().zip(poses(&written)).zip(&joints) {
        let (branch, _) = arm.posture(q);
        let reached = arm.solve_branch(&fake, branch, q);
        assert_eq!(reached.beyond, 0.0);
        let gap = real
            .forward(&reached.q, &Conditions::default())
            .separation(wanted);
        assert!(gap.distance_m < 2e-6, "{gap:?}");
        assert!(fake.separation(wanted).distance_m > 1e-4);
    }
}

/// An arm of the catalogue with an offset wrist, and an error of its own.
fn cobot() -> (tempfile::TempDir, String) {
    let folder = scratch();
    let file = folder.path().join("arm.yaml").display().to_string();
    let made = ["profile", "new", "--robot", "yaskawa_hc10", "-o", &file];
    let (status, _, said) = run(&made);
    assert_eq!(status, 0, "{said}");
    let text = std::fs::read_to_string(&file).expect("a profile");
    let (before, _) = text.split_once("effects: []").expect("a nominal profile");
    std::fs::write(&file, before.to_owned() + EFFECTS).expect("scratch");
    (folder, file)
}

#[test]
fn a_posture_at_the_border_of_two_branches_is_among_all_answers() {
    let (_folder, file) = cobot();
    let profile = Profile::from_yaml(&std::fs::read_to_string(file).expect("a profile"));
    let profile = profile.expect("a profile");
    let arm = arm_of(&profile);
    let mut random = StdRng::seed_from_u64(5);
    for _ in 0..300 {
        let mut q = random_joints(&mut random, &profile);
        // the arm is stretched out
        q[2] = 0.0;
        if q[4].sin().abs() < 0.1 {
            continue;
        }
        let answers = arm.solve_all(&arm.forward(&q), &q);
        let apart = |answer: &poseshift::inverse::Answer| {
            let each = (0..6).map(|i| wrap(answer.q[i] - q[i]).abs());
            each.fold(0.0, f64::max)
        };
        let nearest = answers.iter().map(apart).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{q:?}: {nearest}");
    }
}

#[test]
fn a_straight_path_goes_on_where_it_leaves_its_branch() {
    let (folder, file) = cobot();
    let profile = Profile::from_yaml(&std::fs::read_to_string(&file).expect("a profile"));
    let arm = arm_of(&profile.expect("a profile"));
    let joints = |third: f64| [0.0, -70.0, third, -60.0, -50.0, 15.0];
    for thirds in [
        [-0.5, -0.25, 0.0, 0.25, 0.5],
        [-1.0, -0.1, 0.1, 1.0, 2.0],
        [-4.0, -2.0, -0.01, 1.0, 3.0],
    ] {
        let mut rows = String::from("id,x_mm,y_mm,z_mm,qw,qx,qy,qz\n");
        for third in thirds {
            let pose = arm.forward(&joints(third).map(f64::to_radians));
            let [x, y, z] = pose.translation.map(|m| 1e3 * m);
            let [w, i, j, k] = pose.rotation.quaternion().0;
            rows += &format!("{third},{x:.6},{y:.6},{z:.6},{w:.10},{i:.10},{j:.10},{k:.10}\n");
        }
        let given = folder.path().join("path.csv").display().to_string();
        std::fs::write(&given, rows).expect("scratch");
        let start = joints(thirds[0]).map(|q| q.to_string()).join(",");
        let start = format!("--start-joints={start}");
        let common = [
            &given,
            "--profile",
            &file,
            "--tool",
            "0,0,0,0,0,0",
            &start,
            "--json",
        ];
        let (_, json, said) = run(&[&["check"], &common[..]].concat());
        let report: Value = serde_json::from_str(&json).unwrap_or_else(|_| panic!("{said}"));
        let moves = report["moves"].as_array().expect("moves");
        for (third, one) in thirds.iter().zip(moves) {
            let found: Vec<f64> = serde_json::from_value(one["joints_deg"].clone()).expect("six");
            let near = |(a, b): (&f64, f64)| (a - b).abs() < 0.01;
            assert!(
                found.iter().zip(joints(*third)).all(near),
                "{third}: {found:?}"
            );
        }
        // and the corrected ones are those of the same postures
        let written = folder.path().join("fake.csv").display().to_string();
        let out = ["-o", &written, "--force"];
        let (status, json, said) = run(&[&["compensate"], &common[..], &out].concat());
        assert_eq!(status, 0, "{said}");
        let report: Value = serde_json::from_str(&json).expect("JSON");
        let targets = report["targets"].as_array().expect("targets");
        for (third, one) in thirds.iter().zip(targets) {
            let found: Vec<f64> = serde_json::from_value(one["joints_deg"].clone()).expect("six");
            let near = |(a, b): (&f64, f64)| (a - b).abs() < 2.0;
            assert!(
                found.iter().zip(joints(*third)).all(near),
                "{third}: {found:?}"
            );
        }
    }
}

#[test]
fn poses_that_one_posture_of_a_branch_reaches_are_not_reported() {
    let (folder, file) = cobot();
    let profile = Profile::from_yaml(&std::fs::read_to_string(&file).expect("a profile"));
    let profile = profile.expect("a profile");
    let arm = arm_of(&profile);
    let mut random = StdRng::seed_from_u64(11);
    let (mut several, mut path) = (Vec::new(), String::from("id,x_mm,y_mm,z_mm,qw,qx,qy,qz\n"));
    for line in 2..42_u64 {
        let q = random_joints(&mut random, &profile);
        let pose = arm.forward(&q);
        let answers = arm.solve_all(&pose, &q);
        // the second answer of a branch
        if answers.iter().any(|of| of.root == 1) {
            several.push(line);
        }
        let [x, y, z] = pose.translation.map(|m| 1e3 * m);
        let [w, i, j, k] = pose.rotation.quaternion().0;
        path += &format!("{line},{x:.6},{y:.6},{z:.6},{w:.10},{i:.10},{j:.10},{k:.10}\n");
    }
    let given = folder.path().join("path.csv").display().to_string();
    std::fs::write(&given, path).expect("scratch");
    let written = folder.path().join("fake.csv").display().to_string();
    let (_, json, said) = run(&[
        "compensate",
        &given,
        "--profile",
        &file,
        "-o",
        &written,
        "--tool",
        "0,0,0,0,0,0",
        "--keep-going",
        "--json",
    ]);
    let report: Value = serde_json::from_str(&json).unwrap_or_else(|_| panic!("{said}"));
    let found = report["findings"].as_array().expect("findings").iter();
    let found = found.filter(|f| f["id"] == "several-postures");
    let lines: Vec<u64> = found.filter_map(|f| f["line"].as_u64()).collect();
    assert!(
        lines.iter().all(|line| several.contains(line)),
        "{lines:?} of {several:?}"
    );
    assert!((4..20).contains(&lines.len()), "{lines:?}");
}
