//! What `time_s` counts from: switching the cold robot on, or something else.

use crate::support::{poseshift, repository, scratch};
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::path::Path;

const TRUTH: &str = "robots/abb_irb120_thesis.yaml";
const DRIFT: &str =
    "effects:\n    - {effect: warm_up_drift, joint: 2, angle_deg: 0.05, time_constant_s: 1800}\n";

fn run(folder: &Path, command: &str) -> Value {
    let output = poseshift()
        .current_dir(folder)
        .args(command.split(' '))
        .arg("--json")
        .output()
        .expect("the program starts");
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{command}: {}", String::from_utf8_lossy(&output.stderr)))
}

fn is_found(report: &Value, id: &str) -> bool {
    let findings = report["findings"].as_array().expect("findings");
    findings.iter().any(|finding| finding["id"] == id)
}

/// Effects with joint and standing.
fn effects(report: &Value) -> Vec<(String, u64, String)> {
    let all = report["effects"].as_array().expect("effects");
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let one = |effect: &Value| {
        let joint = effect["joint"].as_u64().unwrap_or(0);
        (text(&effect["effect"]), joint, text(&effect["standing"]))
    };
    all.iter().map(one).collect()
}

#[test]
fn a_clock_that_begins_late_shows_no_warm_up() {
    let folder = scratch();
    let at = folder.path();
    let truth = std::fs::read_to_string(repository(TRUTH)).expect("a profile");
    let warm = truth.replacen("effects:\n", DRIFT, 1);
    std::fs::write(at.join("truth.yaml"), &truth).expect("scratch");
    std::fs::write(at.join("warm.yaml"), warm).expect("scratch");
    let mut random = rand::rngs::StdRng::seed_from_u64(4);
    let mut joints = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg".to_owned();
    for _ in 0..150 {
        let q = [100.0, 70.0, 60.0, 120.0, 90.0, 150.0].map(|end: f64| {
            let angle = random.random_range(-end..end);
            format!("{angle:.4}")
        });
        joints += &format!("\n{}", q.join(","));
    }
    std::fs::write(at.join("q.csv"), joints).expect("scratch");
    run(
        at,
        "simulate --profile warm.yaml --joints q.csv --noise-mm 0.02 --interval-s 60 -o m.csv",
    );
    let measured = std::fs::read_to_string(at.join("m.csv")).expect("measurements");
    let header = measured.lines().next().expect("a header");
    let column = header.split(',').position(|name| name == "time_s");
    let column = column.expect("a column of times");
    for began_s in [0.0, 60.0, 600.0, 3600.0, 36_000.0, 1.79e9] {
        let rows = measured.lines().skip(1).map(|line| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            let time_s: f64 = cells[column].parse().expect("a number");
            cells[column] = format!("{}", time_s + began_s);
            cells.join(",")
        });
        let text = [header.to_owned()].into_iter().chain(rows);
        std::fs::write(at.join("m.csv"), text.collect::<Vec<_>>().join("\n")).expect("scratch");
        let late = began_s > 100.0;
        let report = run(
            at,
            "diagnose --quick --profile truth.yaml --measurements m.csv",
        );
        assert_eq!(is_found(&report, "time-late"), late, "{began_s}: {report}");
        let untested = report["cannot_test"].as_array().expect("a list");
        let mut untested = untested.iter().map(|one| &one["effect"]);
        assert_eq!(untested.any(|id| id == "warm_up_drift"), late, "{began_s}");
        let wanted = if late {
            "session_drift"
        } else {
            "warm_up_drift"
        };
        let found = effects(&report);
        assert!(
            matches!(&found[..], [(id, 2, standing)] if id == wanted && standing != "possible"),
            "{began_s}: {found:?}"
        );
        // where nothing counts with time it does not matter
        for (command, said) in [
            ("validate --profile truth.yaml --measurements m.csv", false),
            ("validate --profile warm.yaml --measurements m.csv", late),
            (
                "calibrate --level 0 --profile truth.yaml --measurements m.csv",
                false,
            ),
            (
                "calibrate --level 0 --identify warm_up_drift:2 --profile warm.yaml --measurements m.csv",
                late,
            ),
        ] {
            let report = run(at, command);
            assert_eq!(is_found(&report, "time-late"), said, "{began_s}: {command}");
        }
    }
}
