//! One path in every language: the same fake targets, and the same joints.

use super::generated::compensated;
use crate::path;
use crate::support::{poseshift, repository, scratch, text};
use serde_json::Value;

const POINTS: u32 = 60;
/// Far enough apart to cross the work space.
const EVERY: u32 = 130;
/// Three decimals of a millimetre, four of a degree at half a metre, twice.
const POSITION_MM: f64 = 0.005;
/// FANUC writes three decimals of a degree.
const ANGLE: f64 = 2e-5;

fn number(pose: &Value, key: &str) -> f64 {
    pose[key].as_f64().expect("a number")
}

/// Fake poses and joints of the straight moves.
fn fakes(language: &str, ending: &str) -> Vec<Value> {
    compensated((language, ending), POINTS, EVERY).targets
}

#[test]
fn a_path_has_the_same_fake_targets_in_every_language() {
    let (first, others) = path::WRITTEN.split_first().expect("languages");
    let expected = fakes(first.0, first.1);
    assert_eq!(expected.len(), POINTS as usize);
    for (language, ending) in others {
        let found = fakes(language, ending);
        assert_eq!(found.len(), expected.len(), "{language}");
        for (index, (a, b)) in expected.iter().zip(&found).enumerate() {
            let (p, q) = (&a["fake"], &b["fake"]);
            for key in ["x_mm", "y_mm", "z_mm"] {
                let gap = (number(p, key) - number(q, key)).abs();
                assert!(gap < POSITION_MM, "{language} {index} {key}: {gap} mm");
            }
            let part = |pose: &Value, i: usize| pose["quaternion"][i].as_f64().expect("a number");
            let cosine: f64 = (0..4).map(|i| part(p, i) * part(q, i)).sum();
            let chord = (2.0 - 2.0 * cosine.abs()).max(0.0).sqrt();
            assert!(chord < ANGLE, "{language} {index}: {chord}");
            assert_eq!(a["branch"], b["branch"], "{language} {index}");
            assert!(number(a, "shift_mm") > 0.5, "the arm is calibrated");
        }
    }
}

#[test]
fn val3_counts_from_the_shoulder_wherever_the_profile_begins() {
    let shoulder = text("programs/val3/profile.yaml");
    // an effect of the base rotates about where the profile begins
    let lines = shoulder.lines().filter(|line| !line.contains("base_frame"));
    let shoulder: String = lines.map(|line| format!("{line}\n")).collect();
    let foot = shoulder.replacen("z_mm: 0,", "z_mm: -478,", 1).replacen(
        "theta_deg: 0, d_mm: 0,",
        "theta_deg: 0, d_mm: 478,",
        1,
    );
    assert_eq!(foot.matches("478").count(), 2);
    let [one, other] = [shoulder, foot].map(|profile| {
        let scratch = scratch();
        let file = scratch.path().join("profile.yaml");
        std::fs::write(&file, profile).expect("scratch");
        let output = poseshift()
            .arg("compensate")
            .arg(repository("programs/val3/olp/in"))
            .args(["--json", "--profile"])
            .arg(file)
            .arg("-o")
            .arg(scratch.path().join("out"))
            .output()
            .expect("the program starts");
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let targets = report["targets"].as_array().expect("a list");
        let fakes = targets.iter().filter(|target| !target["fake"].is_null());
        fakes
            .flat_map(|target| ["x_mm", "y_mm", "z_mm"].map(|key| number(&target["fake"], key)))
            .collect::<Vec<f64>>()
    });
    assert_eq!(one.len(), other.len());
    assert!(one.len() >= 27, "{one:?}");
    let gap = one.iter().zip(&other).map(|(a, b)| (a - b).abs());
    assert!(gap.fold(0.0, f64::max) < 1e-6);
}
