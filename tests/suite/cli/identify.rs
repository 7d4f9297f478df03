//! `plan`, `simulate`, `calibrate`, `validate`.

use crate::support::{poseshift, repository, scratch};
use serde_json::Value;
use std::path::Path;

const TRUTH: &str = "robots/abb_irb120_thesis.yaml";

fn run(folder: &Path, arguments: &[&str]) -> Value {
    let filled: Vec<String> = arguments
        .iter()
        .map(|a| a.replace("DIR", folder.to_str().expect("UTF-8")))
        .collect();
    let output = poseshift()
        .current_dir(repository(""))
        .args(&filled)
        .arg("--json")
        .output()
        .expect("the program starts");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{filled:?}: {errors}");
    serde_json::from_slice(&output.stdout).expect("a report")
}

#[test]
fn a_plan_is_simulated_calibrated_and_validated() {
    let folder = scratch();
    let at = folder.path();
    let text = std::fs::read_to_string(repository(TRUTH)).expect("a shipped profile");
    let effects = text.find("  effects:").expect("its calibration");
    std::fs::write(
        at.join("nominal.yaml"),
        format!("{}  effects: []\n", &text[..effects]),
    )
    .expect("scratch");
    let plan = run(
        at,
        &[
            "plan",
            "--profile",
            TRUTH,
            "--count",
            "40",
            "--candidates",
            "400",
            "--starts",
            "1",
            "-o",
            "DIR/q.csv",
            "--program",
            "DIR/measure.mod",
        ],
    );
    assert_eq!(plan["poseshift"], "plan/1");
    assert!(plan["o1"].as_f64().expect("a number") > 0.0);
    assert!(at.join("measure.mod").is_file());
    run(
        at,
        &[
            "simulate",
            "--profile",
            TRUTH,
            "--joints",
            "DIR/q.csv",
            "--noise-mm",
            "0.02",
            "-o",
            "DIR/m.csv",
        ],
    );
    let found = run(
        at,
        &[
            "calibrate",
            "--profile",
            "DIR/nominal.yaml",
            "--measurements",
            "DIR/m.csv",
            "-o",
            "DIR/c.yaml",
            "--date",
            "a day",
        ],
    );
    assert_eq!(found["poseshift"], "calibration/1");
    for key in [
        "parameters",
        "observability",
        "outliers",
        "before",
        "frames_only",
        "after",
    ] {
        assert!(!found[key].is_null(), "{key}");
    }
    let written = std::fs::read_to_string(at.join("c.yaml")).expect("the calibrated profile");
    assert!(written.contains("date: \"a day\"") && written.contains("covariance"));
    let seen = run(
        at,
        &[
            "validate",
            "--profile",
            "DIR/c.yaml",
            "--measurements",
            "DIR/m.csv",
        ],
    );
    assert_eq!(seen["poseshift"], "validation/1");
    let real = seen["position"]["real"]["mean_mm"]
        .as_f64()
        .expect("a number");
    assert!(real < 0.05, "{real}");
    assert!(seen["distance"]["controller"]["pairs"] == 780);
}

#[test]
fn a_bad_cell_and_too_few_rows_write_nothing() {
    let folder = scratch();
    let file = folder.path().join("m.csv");
    let out = folder.path().join("c.yaml");
    let header = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n";
    for (rows, word) in [
        ("1,2,3,4,5,6,1,x,3\n", "y_mm"),
        (
            "1,2,3,4,5,6,1,2,3\n9,8,7,6,5,4,3,2,100\n50,40,3,2,1,0,100,200,3\n",
            "too few",
        ),
    ] {
        std::fs::write(&file, format!("{header}{rows}")).expect("scratch");
        let output = poseshift()
            .current_dir(repository(""))
            .args(["calibrate", "--profile", TRUTH, "--measurements"])
            .arg(&file)
            .arg("-o")
            .arg(&out)
            .output()
            .expect("the program starts");
        assert_eq!(output.status.code(), Some(2));
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(errors.contains(word), "{errors}");
        assert!(!out.exists());
    }
}
