//! A real robot, where the folder with its measurements is there.

use crate::support::{poseshift, repository, scratch};
use serde_json::Value;

/// The report on a robot whose geometry was calibrated first; `None` where its measurements are not there.
fn diagnosed(robot: &str) -> Option<Value> {
    let folder = repository("../shared/data/real").join(robot);
    let (profile, csv) = (folder.join("profile.yaml"), folder.join("fit.csv"));
    if !profile.is_file() {
        println!("skipped: {} is not there", folder.display());
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
    assert_eq!(run.status.code(), Some(1));
    let report: Value = serde_json::from_slice(&run.stdout).expect("JSON");
    assert_eq!(report["verdict"], "undetermined");
    Some(report)
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
