//! Imported factory calibrations against an independent standard Denavit–Hartenberg model
//! (`tests/data/ur_calibration`).

use crate::support::{gap, numbers_of, poseshift, random_joints, repository, scratch, table, text};
use poseshift::inverse::{Arm, Inverse, Status};
use poseshift::model::Conditions;
use poseshift::model::effects::{Effect, Kind, MOST_PARAMETERS, Site};
use poseshift::model::profile::{ControllerModel, Mounted, Profile, universal_robots};
use rand::SeedableRng;

const FOLDER: &str = "tests/data/ur_calibration";
const POSE: [&str; 7] = ["x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"];

/// Case, its nominal profile, and rounding of sums of lengths that cancel: 1e-16 of the longest, a
/// few times.
const CASES: [(&str, &str, f64); 3] = [
    ("ur5_usual", "universal_robots_ur5", 2e-9),
    ("ur10_far", "universal_robots_ur10", 5e-8),
    ("ur5_tilted", "universal_robots_ur5", 2e-9),
];
const ANGLE_RAD: f64 = 1e-12;

fn nominal(name: &str) -> Profile {
    Profile::from_yaml(&text(&format!("robots/{name}.yaml"))).expect("a shipped profile")
}

fn calibrated(case: &str, ending: &str, nominal: &Profile) -> Profile {
    let file = text(&format!("{FOLDER}/{case}.{ending}"));
    let effects = universal_robots::link_geometry(&file, nominal).expect(case);
    Profile {
        controller: ControllerModel::Calibrated,
        own_effects: Some(effects),
        ..nominal.clone()
    }
}

fn rows(case: &str) -> Vec<([f64; 6], [f64; 7])> {
    table(&format!("{FOLDER}/{case}.expected.csv"))
        .iter()
        .map(|row| (row.joints("q{}_deg"), row.numbers(POSE)))
        .collect()
}

#[test]
fn both_files_give_the_poses_of_the_maker_s_table() {
    for (case, robot, tolerance_mm) in CASES {
        let nominal = nominal(robot);
        for ending in ["calibration.conf", "kinematics.yaml"] {
            let profile = calibrated(case, ending, &nominal);
            let controller = profile.controller_model(&Mounted::flange());
            let expected = rows(case);
            assert_eq!(expected.len(), 40);
            for (q, pose) in expected {
                let found = controller.forward(&q, &Conditions::default());
                let (distance, angle) = gap(numbers_of(&found), pose);
                assert!(
                    distance < tolerance_mm && angle < ANGLE_RAD,
                    "{case} {ending}: {distance} mm {angle} rad"
                );
            }
        }
    }
}

#[test]
fn the_rows_are_near_the_nominal_ones() {
    for (case, robot, _) in CASES {
        let nominal = nominal(robot);
        let profile = calibrated(case, "calibration.conf", &nominal);
        for effect in profile.own_effects.iter().flatten() {
            let [alpha, a, beta, theta, d, ..] = effect.parameters;
            assert!(
                [alpha, beta, theta].iter().all(|angle| angle.abs() < 0.02),
                "{case}: {effect:?}"
            );
            assert!(
                [a, d].iter().all(|length| length.abs() < 0.003),
                "{case}: {effect:?}"
            );
        }
    }
}

/// The maker's numbers row by row, a and alpha one row further, without β.
fn as_printed(case: &str, nominal: &Profile) -> Profile {
    let file = text(&format!("{FOLDER}/{case}.calibration.conf"));
    let list = |key: &str| -> Vec<f64> {
        let line = file.lines().find(|line| line.starts_with(key)).expect(key);
        let inside = line.split(['[', ']']).nth(1).expect("a list");
        inside
            .split(',')
            .map(|number| number.trim().parse().expect("a number"))
            .collect()
    };
    let [theta, a, d, alpha] = ["delta_theta", "delta_a", "delta_d", "delta_alpha"].map(list);
    let effect = |index: usize| {
        let before = |list: &[f64]| if index == 0 { 0.0 } else { list[index - 1] };
        let mut parameters = [0.0; MOST_PARAMETERS];
        parameters[..5].copy_from_slice(&[before(&alpha), before(&a), 0.0, theta[index], d[index]]);
        Effect {
            kind: Kind::LinkGeometry,
            site: Site {
                index,
                ..Site::default()
            },
            parameters,
        }
    };
    Profile {
        controller: ControllerModel::Calibrated,
        own_effects: Some((0..6).map(effect).collect()),
        ..nominal.clone()
    }
}

#[test]
fn the_inverse_of_a_calibrated_controller_converges_from_the_nominal_closed_form() {
    let mut random = rand::rngs::StdRng::seed_from_u64(3);
    let (mut tried, mut spent, mut most) = (0_u32, 0_u32, 0_u32);
    for (case, robot, _) in CASES {
        let nominal = nominal(robot);
        // with β and small numbers as imported, and with the hundreds of metres as the file has
        // them
        for profile in [
            calibrated(case, "calibration.conf", &nominal),
            as_printed(case, &nominal),
        ] {
            let tool = Mounted::flange();
            let inverse = Inverse {
                arm: Arm::of(&profile.geometry(&tool), &profile.mechanism).expect("parallel axes"),
                real: profile.controller_model(&tool),
                conditions: Conditions::default(),
            };
            for _ in 0..300 {
                let q = random_joints(&mut random, &profile);
                let (branch, margins) = inverse.arm.posture(&q);
                let clear =
                    margins.wrist_rad.min(margins.elbow_rad) > 0.1 && margins.shoulder_m > 0.05;
                let inside = q.iter().all(|angle| angle.abs() < 6.2);
                if !clear || !inside {
                    continue;
                }
                let wanted = inverse.real.forward(&q, &inverse.conditions);
                let outcome = inverse.solve(&wanted, branch, &q);
                assert_eq!(outcome.status, Status::Converged, "{case}: {q:?}");
                for i in 0..6 {
                    assert!(
                        (outcome.q[i] - q[i]).abs() < 1e-6,
                        "{case}: joint {i} of {q:?}"
                    );
                }
                tried += 1;
                spent += outcome.iterations;
                most = most.max(outcome.iterations);
            }
        }
    }
    assert!(tried > 700, "{tried}");
    assert!(
        spent <= 8 * tried && most <= 30,
        "{spent} of {tried}, at most {most}"
    );
}

#[test]
fn the_command_writes_a_profile_that_fk_reads_and_compensation_waits_for() {
    let folder = scratch();
    let out = folder.path().join("cell/ur5.yaml");
    let import = |calibration: &str, profile: &str| {
        let mut command = poseshift();
        command
            .args(["profile", "import-ur"])
            .arg(repository(&format!("{FOLDER}/{calibration}")))
            .arg("--profile")
            .arg(repository(profile))
            .arg("-o")
            .arg(&out);
        command
    };
    let ur5 = "robots/universal_robots_ur5.yaml";
    import("ur5_usual.calibration.conf", ur5).assert().success();
    let written = std::fs::read_to_string(&out).expect("the profile");
    let original = text(ur5);
    // everything but the controller is as it was
    let lines: Vec<&str> = written.lines().collect();
    for line in original
        .lines()
        .filter(|line| !line.starts_with("controller:"))
    {
        assert!(lines.contains(&line), "{line}");
    }
    let profile = Profile::from_yaml(&written).expect("a profile");
    assert_eq!(profile.own_effects.as_ref().map(Vec::len), Some(6));
    // nothing better is known of the real arm
    let (q, pose) = rows("ur5_usual")[7];
    let conditions = Conditions::default();
    let real = profile
        .real_model(&Mounted::flange(), &conditions)
        .forward(&q, &conditions);
    let (distance, _) = gap(numbers_of(&real), pose);
    assert!(distance < 1e-8, "{distance}");
    // written once only; another arm's calibration is refused
    import("ur5_usual.calibration.conf", ur5).assert().code(2);
    std::fs::remove_file(&out).expect("it was there");
    import("ur10_far.kinematics.yaml", ur5).assert().code(2);
    import("ORIGIN.md", ur5).assert().code(2);
    import("ur5_usual.calibration.conf", "robots/abb_irb120.yaml")
        .assert()
        .code(2);
    assert!(!out.exists());
}

#[test]
fn the_effects_of_the_controller_are_reported_and_counted_as_a_difference() {
    let folder = scratch();
    let out = folder.path().join("ur5.yaml");
    let ur5 = repository("robots/universal_robots_ur5.yaml");
    poseshift()
        .args(["profile", "import-ur", "--json"])
        .arg(repository(&format!("{FOLDER}/ur5_tilted.kinematics.yaml")))
        .arg("--profile")
        .arg(&ur5)
        .arg("-o")
        .arg(&out)
        .assert()
        .success();
    let reported = |arguments: &[&std::ffi::OsStr]| -> serde_json::Value {
        let output = poseshift()
            .arg("profile")
            .args(arguments)
            .arg("--json")
            .output()
            .expect("the program starts");
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    let facts = reported(&["show".as_ref(), out.as_ref()]);
    assert!(
        facts["facts"]["controller effect link_geometry link 3"].is_string(),
        "{facts}"
    );
    assert_eq!(facts["deviation"]["max_mm"], 0.0);
    let diff = reported(&["diff".as_ref(), ur5.as_ref(), out.as_ref()]);
    let keys: Vec<_> = diff["differences"]
        .as_array()
        .expect("a list")
        .iter()
        .collect();
    let is_of_controller = |row: &&serde_json::Value| {
        row["key"]
            .as_str()
            .is_some_and(|key| key.starts_with("controller"))
    };
    assert!(
        keys.len() >= 6 && keys.iter().all(is_of_controller),
        "{diff}"
    );
    let schema = Profile::schema();
    assert!(schema.to_string().contains("\"link_geometry\""));
    assert!(
        schema["$defs"]["ControllerFile"]["properties"]["effects"].is_object(),
        "{schema}"
    );
}
