//! A controller that computes with a chain of its own: what it knows stays where nothing better is
//! found.

use crate::support::{poseshift, report, repository, scratch};
use serde_json::Value;
use std::path::Path;

fn made(arguments: &[&str], folder: &Path) {
    poseshift()
        .current_dir(folder)
        .args(arguments)
        .assert()
        .success();
}

/// The position of the real arm, mm.
fn place(profile: &str, folder: &Path) -> [f64; 3] {
    let found = report(poseshift().current_dir(folder).args([
        "fk",
        "--profile",
        profile,
        "--model",
        "real",
        "--tool",
        "t",
        "--joints",
        "asked.csv",
        "--json",
    ]));
    fn number(found: &Value, key: &str) -> Option<f64> {
        match found {
            Value::Object(map) => {
                let own = map.get(key).and_then(Value::as_f64);
                own.or_else(|| map.values().find_map(|value| number(value, key)))
            }
            Value::Array(list) => list.iter().find_map(|value| number(value, key)),
            _ => None,
        }
    }
    ["x_mm", "y_mm", "z_mm"].map(|key| number(&found, key).expect("a place"))
}

#[test]
fn a_controller_with_a_chain_of_its_own_keeps_it_where_the_arm_has_it() {
    let folder = scratch();
    let folder = folder.path();
    let robot = repository("robots/universal_robots_ur10.yaml");
    let chain = repository("tests/data/ur_calibration/ur10_far.calibration.conf");
    let [robot, chain] = [&robot, &chain].map(|path| path.to_str().expect("a plain path"));
    made(
        &[
            "profile",
            "add-tool",
            robot,
            "t=40,20,100,0,0,0,1",
            "-o",
            "ur.yaml",
        ],
        folder,
    );
    made(
        &[
            "profile",
            "import-ur",
            chain,
            "--profile",
            "ur.yaml",
            "-o",
            "own.yaml",
        ],
        folder,
    );
    made(
        &[
            "plan",
            "--profile",
            "own.yaml",
            "--count",
            "40",
            "-o",
            "plan.csv",
        ],
        folder,
    );
    made(
        &[
            "simulate",
            "--profile",
            "own.yaml",
            "--joints",
            "plan.csv",
            "--noise-mm",
            "0.03",
            "-o",
            "seen.csv",
        ],
        folder,
    );
    made(
        &[
            "calibrate",
            "--profile",
            "own.yaml",
            "--measurements",
            "seen.csv",
            "-o",
            "found.yaml",
        ],
        folder,
    );
    let asked = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n10,-80,90,-100,-90,0\n";
    std::fs::write(folder.join("asked.csv"), asked).expect("scratch");
    // the arm is what the controller believes: hundredths of the noise, not its own correction
    let (truth, found) = (place("own.yaml", folder), place("found.yaml", folder));
    for (a, b) in truth.iter().zip(&found) {
        assert!((a - b).abs() < 0.1, "{truth:?} {found:?}");
    }
}
