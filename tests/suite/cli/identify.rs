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
    // positions that the controller computes of its joints are none of the arm
    let computed = [
        "simulate",
        "--profile",
        "DIR/nominal.yaml",
        "--joints",
        "DIR/q.csv",
    ];
    run(at, &[&computed[..], &["-o", "DIR/own.csv"]].concat());
    let calibrate = [
        "calibrate",
        "--profile",
        "DIR/nominal.yaml",
        "--measurements",
    ];
    let ids = |rows: &str| {
        let found = run(at, &[&calibrate[..], &[rows, "-o", "DIR/d.yaml"]].concat());
        let findings = found["findings"].as_array().expect("findings").clone();
        findings.iter().any(|f| f["id"] == "positions-computed")
    };
    assert!(ids("DIR/own.csv") && !ids("DIR/m.csv"));
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

/// Joint angles of 40 configurations, degrees, and each a little off them.
fn configurations() -> (Vec<[f64; 6]>, Vec<[f64; 6]>) {
    use rand::{RngExt, SeedableRng};
    let mut random = rand::rngs::StdRng::seed_from_u64(9);
    let mut meant = Vec::new();
    let mut real = Vec::new();
    for _ in 0..40 {
        let q =
            [120.0, 60.0, 50.0, 120.0, 100.0, 150.0].map(|most| random.random_range(-most..most));
        real.push(q.map(|angle| angle + random.random_range(-0.02..0.02)));
        meant.push(q);
    }
    (meant, real)
}

#[test]
fn rows_of_one_configuration_that_miss_alike_are_said_to_count_once() {
    let folder = scratch();
    let at = folder.path();
    let thesis = std::fs::read_to_string(repository("robots/abb_irb120_thesis.yaml"));
    let thesis = thesis.expect("a profile");
    let points = "points: {a: [0, 0, 50], b: [60, -20, 80], c: [-40, 70, 60]}";
    std::fs::write(at.join("p.yaml"), thesis.replacen("points: {}", points, 1)).expect("scratch");
    let (meant, real) = configurations();
    let cells = |q: &[f64; 6]| q.map(|angle| angle.to_string()).join(",");
    let rows: Vec<String> = real.iter().map(cells).collect();
    let header = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg";
    std::fs::write(at.join("q.csv"), format!("{header}\n{}\n", rows.join("\n"))).expect("scratch");
    let run = |command: &str| {
        let output = poseshift()
            .current_dir(at)
            .args(command.split(' '))
            .output();
        let output = output.expect("the program starts");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{command}: {said}");
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    run("simulate --profile p.yaml --joints q.csv --noise-mm 0.01 --seed 3 -o m.csv");
    // what the joints scatter by is in every reflector of a configuration, and in no column
    let seen = std::fs::read_to_string(at.join("m.csv")).expect("measurements");
    let mut lines = seen.lines();
    let names = lines.next().expect("a header");
    let first = names
        .split(',')
        .position(|name| name == "q1_deg")
        .expect("joints");
    let as_meant = |line: &str| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        let q1: f64 = cells[first].parse().expect("an angle");
        let nearest = (0..40).min_by(|a, b| {
            let off = |k: &usize| (real[*k][0] - q1).abs();
            off(a).total_cmp(&off(b))
        });
        for (joint, angle) in meant[nearest.expect("one")].iter().enumerate() {
            cells[first + joint] = angle.to_string();
        }
        cells.join(",") + "\n"
    };
    let scattered: String = lines.map(as_meant).collect();
    std::fs::write(at.join("s.csv"), format!("{names}\n{scattered}")).expect("scratch");
    let calibrate = |file: &str| format!("calibrate --profile p.yaml --measurements {file}");
    let words = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let text = words(run(&calibrate("s.csv")));
    assert!(
        text.contains("rows of one configuration miss alike"),
        "{text}"
    );
    let factor = |file: &str| {
        let report = run(&(calibrate(file) + " --json"));
        let report: Value = serde_json::from_str(&report).expect("a report");
        report["shared_factor"].as_f64().expect("a number")
    };
    // three reflectors that miss alike count as one: the root of three, of 40 configurations
    let shared = factor("s.csv");
    assert!((1.3..2.0).contains(&shared), "{shared}");
    assert_eq!(factor("m.csv"), 1.0);
    assert!(!run(&calibrate("m.csv")).contains("miss alike"));
}
