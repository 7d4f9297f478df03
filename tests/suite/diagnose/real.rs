//! A real robot, where the folder with its measurements is there.

use crate::shapes::{SHAPES, set};
use crate::support::{poseshift, repository, scratch, skipped};
use serde_json::Value;
use std::path::Path;

/// The report on a robot whose geometry was calibrated first; `None` where its measurements are not
/// there.
fn diagnosed(robot: &str) -> Option<Value> {
    let folder = repository("../shared/data/real").join(robot);
    let (profile, csv) = (folder.join("profile.yaml"), folder.join("fit.csv"));
    if !profile.is_file() {
        skipped(&format!("{} is not there", folder.display()));
        return None;
    }
    let scratch = scratch();
    let geometry = scratch.path().join("geometry.yaml");
    let calibrated = poseshift()
        .args(["calibrate", "--level", "2", "-q", "--profile"])
        .args([&profile, &"--measurements".into(), &csv, &"-o".into()])
        .arg(&geometry)
        .output()
        .expect("the program starts");
    assert!(calibrated.status.success(), "{calibrated:?}");
    let run = poseshift()
        .args(["diagnose", "--json", "--quick", "--profile"])
        .args([&geometry, &"--measurements".into(), &csv])
        .output()
        .expect("the program starts");
    let report: Value = serde_json::from_slice(&run.stdout).expect("JSON");
    // nothing was left out: nothing tells that it predicts better
    assert_eq!(report["verdict"], "undetermined");
    assert_eq!(run.status.code(), Some(1));
    Some(report)
}

/// Every other configuration of a file, the even ones or the odd, with how far the joints moved
/// last.
fn half(csv: &str, odd: bool) -> String {
    let mut lines = csv.lines().filter(|line| !line.starts_with('#'));
    let header = lines.next().expect("a header");
    let names: Vec<&str> = header.split(',').collect();
    let first = names.iter().position(|n| *n == "q1_deg").expect("a column");
    let moves: Vec<String> = (1..7).map(|i| format!("move{i}_deg")).collect();
    let mut out = format!("{header},{}\n", moves.join(","));
    let (mut last, mut moved, mut number) = (None, [0.0; 6], 0);
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let q: [f64; 6] = std::array::from_fn(|i| cells[first + i].parse().expect("an angle"));
        if let Some(before) = last.filter(|before| *before != q) {
            let before: [f64; 6] = before;
            moved = std::array::from_fn(|i| q[i] - before[i]);
            number += 1;
        }
        last = Some(q);
        if (number % 2 == 1) == odd {
            let moved = moved.map(|m| format!("{m:.6}"));
            out += &format!("{line},{}\n", moved.join(","));
        }
    }
    out
}

/// Calibrated and diagnosed with every other configuration: what the profile written misses the
/// others by, over what the one calibrated alone misses, for both halves. `None` where nothing was
/// written, and of the whole where the measurements are not there.
fn other_half(robot: &str) -> Option<Vec<Option<f64>>> {
    let folder = repository("../shared/data/real").join(robot);
    let (profile, csv) = (folder.join("profile.yaml"), folder.join("fit.csv"));
    if !profile.is_file() {
        skipped(&format!("{} is not there", folder.display()));
        return None;
    }
    let text = std::fs::read_to_string(csv).expect("measurements");
    Some(halves(&profile, &text))
}

/// The same of a profile and a table of measurements.
fn halves(profile: &Path, text: &str) -> Vec<Option<f64>> {
    let run = |arguments: &[&Path], code: &[i32]| {
        let out = poseshift()
            .args(arguments)
            .output()
            .expect("the program starts");
        let status = out.status.code().expect("it ended");
        assert!(
            code.contains(&status),
            "{}",
            String::from_utf8_lossy(&out.stderr)
        );
        out.stdout
    };
    let each = [false, true].map(|odd| {
        let scratch = scratch();
        let at = |name: &str| scratch.path().join(name);
        let (own, other) = (at("own.csv"), at("other.csv"));
        let (level, better) = (at("level3.yaml"), at("better.yaml"));
        std::fs::write(&own, half(text, odd)).expect("scratch");
        std::fs::write(&other, half(text, !odd)).expect("scratch");
        let word = Path::new;
        run(
            &[
                word("calibrate"),
                word("--level"),
                word("3"),
                word("-q"),
                word("--profile"),
                profile,
                word("--measurements"),
                &own,
                word("-o"),
                &level,
            ],
            &[0],
        );
        run(
            &[
                word("diagnose"),
                word("-q"),
                word("--profile"),
                &level,
                word("--measurements"),
                &own,
                word("-o"),
                &better,
            ],
            &[0, 1],
        );
        let mean = |profile: &Path| {
            let json = run(
                &[
                    word("validate"),
                    word("--json"),
                    word("--profile"),
                    profile,
                    word("--measurements"),
                    &other,
                ],
                &[0, 1],
            );
            let report: Value = serde_json::from_slice(&json).expect("JSON");
            report["position"]["real"]["mean_mm"]
                .as_f64()
                .expect("a mean")
        };
        better.is_file().then(|| mean(&better) / mean(&level))
    });
    each.to_vec()
}

#[test]
fn the_other_half_of_generated_measurements_is_predicted_better() {
    for shape in &SHAPES {
        let set = set(shape, 7);
        let scratch = scratch();
        let profile = scratch.path().join("nominal.yaml");
        std::fs::write(&profile, &set.profile).expect("scratch");
        let parts = halves(&profile, &set.csv);
        // down to the noise and what nobody knows at best
        let best = set.floor_mm / set.level_3_mm;
        println!("{}: {parts:.3?}, at best {best:.3}", shape.name);
        assert!(
            parts
                .iter()
                .all(|part| part.is_some_and(|part| part < 0.5 + 0.5 * best)),
            "{}: {parts:?}, at best {best}",
            shape.name
        );
    }
}

#[test]
fn the_other_half_of_the_ma1400_is_predicted_better_by_a_fifth() {
    let Some(parts) = other_half("ma1400_leica") else {
        return;
    };
    assert!(
        parts.iter().all(|p| p.is_some_and(|p| p < 0.8)),
        "{parts:?}"
    );
}

/// In one half a step near the beginning is found that no part of the rows shows again: the base is not
/// that of the rows before it.
#[test]
fn the_other_half_of_the_irb120_is_predicted_better_by_a_fifth() {
    let Some(parts) = other_half("irb120_faro") else {
        return;
    };
    assert!(
        parts.iter().all(|p| p.is_some_and(|p| p < 0.8)),
        "{parts:?}"
    );
}

#[test]
fn the_other_half_of_the_tx2_is_not_predicted_worse() {
    let Some(parts) = other_half("tx2_90l_tmac") else {
        return;
    };
    assert!(parts.iter().flatten().all(|p| *p < 1.0), "{parts:?}");
}

/// Level 3 of the UR5 has a spring of J2 that is surely negative, and what is found does not mend
/// that. It predicts better all the same.
#[test]
fn what_the_start_has_wrong_itself_does_not_keep_the_better_profile_back() {
    let folder = repository("../shared/data/real/ur5_tracker");
    let (profile, csv) = (folder.join("profile.yaml"), folder.join("fit.csv"));
    if !profile.is_file() {
        skipped(&format!("{} is not there", folder.display()));
        return;
    }
    let scratch = scratch();
    let [level, better] = ["level3.yaml", "better.yaml"].map(|name| scratch.path().join(name));
    let run = |command: &str, profile: &Path, output: &Path| {
        let mut run = poseshift();
        run.args([command, "--profile"]).arg(profile);
        run.arg("--measurements").arg(&csv).arg("-o").arg(output);
        let out = run.output().expect("the program starts");
        assert_eq!(out.status.code(), Some(0), "{out:?}");
        String::from_utf8(out.stdout).expect("a text")
    };
    run("calibrate", &profile, &level);
    let calibrated = std::fs::read_to_string(&level).expect("the profile");
    assert!(calibrated.contains("rad_per_n_m: -"), "{calibrated}");
    let report = run("diagnose", &level, &better);
    // the report says both
    let report: String = report.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in ["below what is possible", "12 effects are as many as one"] {
        assert!(report.contains(said), "{said}: {report}");
    }
    assert!(better.is_file());
}

#[test]
fn on_the_ma1400_alternatives_differ_by_what_the_measurements_say_only() {
    let Some(report) = diagnosed("ma1400_leica") else {
        return;
    };
    let poses = report["telling_poses"].as_array().expect("a list");
    let apart = poses.iter().filter_map(|pose| pose["apart_mm"].as_f64());
    let most = apart.fold(0.0, f64::max);
    // the present model misses by 1.4 mm: alternatives that fit better do not differ by centimetres
    assert!(most > 0.05 && most < 10.0, "{most}");
}

#[test]
fn on_the_ur5_springs_compete_with_harmonics_and_cannot_be() {
    let Some(report) = diagnosed("ur5_tracker") else {
        return;
    };
    let impossible = report["impossible"].as_array().expect("a list");
    let springs = impossible
        .iter()
        .find(|i| i["effects"][0]["effect"] == "joint_compliance")
        .expect("springs compete");
    let spring = springs["effects"][0]["parameters"]["rad_per_n_m"].as_f64();
    assert!(spring.is_some_and(|c| c < -1e-5), "{springs}");
    let instead = springs["instead_of"].as_array().expect("a list");
    let harmonics = instead.iter().filter_map(Value::as_str);
    assert!(
        harmonics
            .into_iter()
            .all(|e| e.starts_with("joint_harmonic")),
        "{springs}"
    );
    assert!(springs["part"].as_f64().is_some_and(|part| part > 0.25));
}
