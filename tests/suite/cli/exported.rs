//! From a profile to what other programs read: URDF, tables, a driver's calibration.

use super::robots::{profile, reported, words};
use crate::support::{Row, repository, scratch, table};
use poseshift::geometry::{Pose, Rotation};
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use serde_json::Value;
use std::path::Path;

/// Where the flange is by the numbers of an exported table, joint angles of the controller in
/// radians.
fn by_table(rows: &[Row], ends: [&Pose; 2], classic: bool, q: &[f64; 6]) -> Pose {
    let x = |row: &Row| Pose {
        rotation: Rotation::about_x(row.number("alpha_deg").to_radians()),
        translation: [row.number("a_mm") * 1e-3, 0.0, 0.0],
    };
    let mut pose = *ends[0];
    for (row, q) in rows.iter().zip(q) {
        let theta = row.number("theta_deg").to_radians() + row.number("sign") * q;
        let z = Pose {
            rotation: Rotation::about_z(theta),
            translation: [0.0, 0.0, row.number("d_mm") * 1e-3],
        };
        pose = if classic {
            pose * z * x(row)
        } else {
            let beta = Pose::from_rotation(Rotation::about_y(row.number("beta_deg").to_radians()));
            pose * x(row) * beta * z
        };
    }
    pose * *ends[1]
}

/// The pose of a comment of a table.
fn commented(text: &str, what: &str) -> Pose {
    let line = text
        .lines()
        .find(|line| line.starts_with(&format!("# {what}")))
        .expect(what);
    let numbers: Vec<f64> = line
        .split(['_', ' ', ','])
        .filter_map(|word| word.parse().ok())
        .collect();
    let [x, y, z, rx, ry, rz] = numbers[numbers.len() - 6..] else {
        panic!("{line}")
    };
    Pose::from_xyz_rxryrz([
        x * 1e-3,
        y * 1e-3,
        z * 1e-3,
        rx.to_radians(),
        ry.to_radians(),
        rz.to_radians(),
    ])
}

/// A profile with every number of the geometry off, and with effects that no chain of fixed numbers
/// has.
fn calibrated(nominal: &str, folder: &Path) -> Profile {
    let mut text = std::fs::read_to_string(repository(nominal)).expect("a profile");
    let mut effects =
        String::from("effects:\n    - {effect: base_frame, x_mm: 0.3, rz_deg: 0.02}\n");
    for link in 2..=6 {
        effects += &format!(
            "    - {{effect: link_geometry, link: {link}, alpha_deg: 0.006, a_mm: 0.13, beta_deg: \
             0.0{link}, theta_deg: -0.05, d_mm: 0.0{link}}}\n"
        );
    }
    let geometry = text.replace("effects: []", effects.trim_end());
    effects += "    - {effect: backlash, joint: 3, width_deg: 0.02}\n    - {effect: \
        joint_harmonic, joint: 2, order: 1, cos_deg: 0.01, sin_deg: 0.0}";
    assert!(text.contains("effects: []"));
    text = text.replace("effects: []", &effects);
    std::fs::write(folder.join("real.yaml"), text).expect("scratch");
    Profile::from_yaml(&geometry).unwrap_or_else(|error| panic!("{error}"))
}

fn postures(profile: &Profile) -> impl Iterator<Item = [f64; 6]> {
    let joints = profile.mechanism.joints;
    (1..200).map(move |k| {
        std::array::from_fn(|i| {
            let part = 0.5 + 0.5 * (f64::from(k) * (i as f64 + 1.7)).sin();
            joints[i].min_rad + part * (joints[i].max_rad - joints[i].min_rad)
        })
    })
}

#[test]
fn what_was_identified_leaves_as_a_urdf_and_as_tables_that_move_alike() {
    for nominal in [
        "robots/abb_irb120.yaml",
        "robots/kuka_kr6_r900.yaml",
        "robots/fanuc_lrmate200ic.yaml",
    ] {
        let folder = scratch();
        let geometry = calibrated(nominal, folder.path());
        let model = geometry.real_model(&Mounted::flange(), &Conditions::default());
        let export = |form: &str, file: &str| {
            let (status, out, error) = reported(
                folder.path(),
                &["profile", "export", "real.yaml", form, "-o", file],
            );
            assert_eq!(status, Some(0), "{error}");
            let out = words(&out);
            for said in [
                "backlash",
                "joint_harmonic",
                "mm (mean), at most",
                "1000 postures",
            ] {
                assert!(out.contains(said), "{said}: {out}");
            }
            std::fs::read_to_string(folder.path().join(file)).expect("written")
        };
        let mechanical = |q: &[f64; 6]| geometry.mechanism.commanded(q);
        for (form, classic, first) in [
            ("--mdh-csv", false, "before row 1, the base"),
            ("--dh-csv", true, "before row 1"),
        ] {
            let text = export(form, "table.csv");
            let path = folder.path().join("table.csv");
            let rows = table(path.to_str().expect("a plain name"));
            let ends = [commented(&text, first), commented(&text, "behind row 6")];
            for q in postures(&geometry) {
                let real = model.forward(&q, &Conditions::default());
                let table = by_table(&rows, [&ends[0], &ends[1]], classic, &mechanical(&q));
                let gap = table.separation(&real);
                assert!(
                    gap.distance_m < 1e-9 && gap.angle_rad < 1e-9,
                    "{nominal} {form} {gap:?}"
                );
            }
            std::fs::remove_file(path).expect("it was written");
        }
        export("--urdf", "arm.urdf");
        // read back by the ordinary command, whose chain is another one
        let back = [
            "profile",
            "from-urdf",
            "arm.urdf",
            "--tip",
            "tool0",
            "--maker",
            "none",
            "-o",
            "back.yaml",
        ];
        let (status, _, error) = reported(folder.path(), &back);
        assert_eq!(status, Some(0), "{error}");
        let back = profile(&folder.path().join("back.yaml"));
        let again = back.controller_model(&Mounted::flange());
        for q in postures(&geometry) {
            let real = model.forward(&q, &Conditions::default());
            let gap = again
                .forward(&mechanical(&q), &Conditions::default())
                .separation(&real);
            assert!(
                gap.distance_m < 1e-9 && gap.angle_rad < 1e-9,
                "{nominal} {gap:?}"
            );
        }
        let mass = |profile: &Profile| profile.bodies.iter().map(|body| body.mass_kg).sum::<f64>();
        assert!((mass(&back) - mass(&geometry)).abs() < 1e-9);
    }
}

#[test]
fn a_factory_calibration_leaves_as_the_driver_reads_it() {
    let folder = scratch();
    let geometry = calibrated("robots/universal_robots_ur5.yaml", folder.path());
    let (status, out, error) = reported(
        folder.path(),
        &[
            "profile",
            "export",
            "real.yaml",
            "--ur-kinematics",
            "-o",
            "kinematics.yaml",
        ],
    );
    assert_eq!(status, Some(0), "{error}");
    assert!(words(&out).contains("where the base stands"), "{out}");
    let nominal = repository("robots/universal_robots_ur5.yaml");
    let nominal = nominal.to_str().expect("a plain name");
    let import = [
        "profile",
        "import-ur",
        "kinematics.yaml",
        "--profile",
        nominal,
        "-o",
        "back.yaml",
    ];
    let (status, _, error) = reported(folder.path(), &import);
    assert_eq!(status, Some(0), "{error}");
    let back = profile(&folder.path().join("back.yaml"));
    let again = back.controller_model(&Mounted::flange());
    // without the place of the base, which the file does not have
    let mut arm = geometry.clone();
    arm.effects.remove(0);
    let real = arm.real_model(&Mounted::flange(), &Conditions::default());
    for q in postures(&geometry) {
        let gap = again
            .forward(&q, &Conditions::default())
            .separation(&real.forward(&q, &Conditions::default()));
        assert!(gap.distance_m < 1e-9 && gap.angle_rad < 1e-9, "{gap:?}");
    }
    // no other maker's driver reads it
    let abb = repository("robots/abb_irb120.yaml");
    let abb = abb.to_str().expect("a plain name");
    let (status, _, error) = reported(
        folder.path(),
        &["profile", "export", abb, "--ur-kinematics"],
    );
    assert_eq!(status, Some(2));
    assert!(words(&error).contains("maker is ABB"), "{error}");
    let (status, _, error) = reported(folder.path(), &["profile", "export", abb]);
    assert_eq!(status, Some(2));
    assert!(error.contains("--mdh-csv"), "{error}");
    let (status, out, _) = reported(folder.path(), &["profile", "export", abb, "--json"]);
    let report: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(
        (status, report["chain"]["rows"].as_array().map(Vec::len)),
        (Some(0), Some(6))
    );
}

#[test]
fn names_that_no_urdf_can_have_are_refused_with_their_key() {
    let folder = scratch();
    let path = folder.path().join("robot.yaml");
    let nominal = std::fs::read_to_string(repository("robots/abb_irb120_thesis.yaml"));
    let nominal = nominal.expect("a shipped profile");
    for sign in ["\\x01", "\\x07", "\\x1b", "\\n", "\\uFFFE"] {
        for (old, new, key) in [
            (
                "\"IRB 120-3/0.6\"",
                format!("\"IRB{sign}\""),
                "robot.model: ",
            ),
            ("  artifact:", format!("  \"art{sign}\":"), "tools: "),
        ] {
            assert!(nominal.contains(old), "{old}");
            std::fs::write(&path, nominal.replacen(old, &new, 1)).expect("scratch");
            let arguments = [
                "profile",
                "export",
                "robot.yaml",
                "--urdf",
                "-o",
                "robot.urdf",
            ];
            let (status, _, said) = reported(folder.path(), &arguments);
            assert_eq!(status, Some(2), "{key} {sign}: {said}");
            assert!(said.contains(key), "{key} {sign}: {said}");
            assert!(!folder.path().join("robot.urdf").exists());
        }
    }
}
