//! A real robot, where the folder with its measurements is there.

use crate::support::{poseshift, repository, scratch};
use serde_json::Value;

#[test]
fn on_the_ur5_springs_compete_with_harmonics_and_cannot_be() {
    let folder = repository("../shared/data/real/ur5_tracker");
    let (profile, csv) = (folder.join("profile.yaml"), folder.join("fit.csv"));
    if !profile.is_file() {
        println!("skipped: {} is not there", folder.display());
        return;
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
