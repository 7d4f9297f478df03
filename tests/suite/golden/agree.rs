//! One path in every language: the same fake targets, and the same joints.

use crate::path;
use crate::support::{poseshift, scratch};
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
    let scratch = scratch();
    let at = |name: &str| scratch.path().join(name);
    std::fs::write(at("profile.yaml"), path::profile(language)).expect("scratch");
    let program = at(&format!("path.{ending}"));
    std::fs::write(&program, path::program(language, POINTS, EVERY)).expect("scratch");
    let output = poseshift()
        .arg("compensate")
        .arg(&program)
        .args(["--tool", "artifact", "--json", "--profile"])
        .arg(at("profile.yaml"))
        .arg("-o")
        .arg(at("out"))
        .output()
        .expect("the program starts");
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{language}: {told}{}",
        String::from_utf8_lossy(&output.stdout)
    );
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["language"], language);
    let targets = report["targets"].as_array().expect("a list").iter();
    targets
        .filter(|target| !target["fake"].is_null())
        .cloned()
        .collect()
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
