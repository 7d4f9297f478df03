//! `diagnose` from outside: report, files, exit status, bad input.

use super::{group, without_sigma};
use crate::support::{poseshift, report, run, scratch, text};
use crate::trial::{Case, case};
use serde_json::Value;
use std::path::PathBuf;

fn files(case: &Case) -> (tempfile::TempDir, PathBuf, PathBuf) {
    let folder = scratch();
    let (profile, csv) = (
        folder.path().join("profile.yaml"),
        folder.path().join("measured.csv"),
    );
    std::fs::write(&profile, &case.profile_text).expect("a writable folder");
    std::fs::write(&csv, &case.csv).expect("a writable folder");
    (folder, profile, csv)
}

/// A calibrated robot with an effect of this kind hidden in it.
pub fn case_with(what: &str) -> Case {
    // kinds follow from the number
    let number = (0..96)
        .find(|n| case(group("calibrated"), *n, 3, 30).what == what)
        .expect("every kind is hidden");
    case(group("calibrated"), number, 3, 150)
}

#[test]
fn the_report_names_the_effect_and_the_profile_has_it() {
    let case = case_with("backlash");
    let (folder, profile, csv) = files(&case);
    let better = folder.path().join("better.yaml");
    let report = report(
        poseshift()
            .args(["diagnose", "--json", "--profile"])
            .arg(&profile)
            .arg("--measurements")
            .arg(&csv)
            .arg("-o")
            .arg(&better),
    );
    assert_eq!(report["poseshift"], "diagnosis/1");
    assert_eq!(report["verdict"], "explained");
    let effect = &report["effects"][0];
    assert_eq!(effect["effect"], "backlash");
    for key in ["parameters", "evidence", "before", "after", "joint"] {
        assert!(!effect[key].is_null(), "{key}");
    }
    for key in [
        "where",
        "alternatives",
        "cannot_test",
        "held_out",
        "noise_mm",
    ] {
        assert!(!report[key].is_null(), "{key}");
    }
    let rms = |step: &str| {
        report["held_out"][step]["rms_mm"]
            .as_f64()
            .expect("a number")
    };
    assert!(rms("after") < 0.5 * rms("before"));
    let text = std::fs::read_to_string(&better).expect("the improved profile");
    assert!(text.contains("effect: backlash") && text.contains("diagnosis"));
    // the improved profile needs nothing more
    let again = poseshift()
        .args(["diagnose", "--json", "--profile"])
        .arg(&better)
        .arg("--measurements")
        .arg(&csv)
        .output()
        .expect("the program starts");
    let report: Value = serde_json::from_slice(&again.stdout).expect("JSON");
    assert_eq!(report["verdict"], "nothing_missing", "{report:#}");
}

#[test]
fn an_effect_of_the_data_is_refused_in_a_profile() {
    let case = case(group("clean"), 0, 3, 30);
    let (folder, _, _) = files(&case);
    let profile = folder.path().join("shifted.yaml");
    let text = case.profile_text.replace(
        "  effects:\n",
        "  effects:\n    - {effect: frame_shift, row: 5, x_mm: 1}\n",
    );
    std::fs::write(&profile, text).expect("a writable folder");
    let run = poseshift()
        .args(["profile", "show"])
        .arg(&profile)
        .output()
        .expect("the program starts");
    assert_eq!(run.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&run.stderr).contains("effect of measurements"));
}

#[test]
fn too_few_rows_and_constant_columns_are_reported() {
    let short = case(group("clean"), 0, 3, 8);
    let (folder, profile, csv) = files(&short);
    let better = folder.path().join("better.yaml");
    let run = poseshift()
        .args(["diagnose", "--profile"])
        .arg(&profile)
        .arg("--measurements")
        .arg(&csv)
        .arg("-o")
        .arg(&better)
        .output()
        .expect("the program starts");
    assert_eq!(run.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&run.stderr).contains("too few"));
    assert!(!better.exists());
    let mut constant = case(group("clean"), 0, 3, 60);
    constant.csv = without_change(&constant.csv);
    let (_folder, profile, csv) = files(&constant);
    let run = poseshift()
        .args(["diagnose", "--json", "--quick", "--profile"])
        .arg(&profile)
        .arg("--measurements")
        .arg(&csv)
        .output()
        .expect("the program starts");
    let report: Value = serde_json::from_slice(&run.stdout).expect("JSON");
    let missing: Vec<&str> = report["cannot_test"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|c| c["effect"].as_str())
        .collect();
    assert_eq!(missing, ["thermal_growth", "warm_up_drift"]);
}

/// The measurements at one temperature and one time.
fn without_change(csv: &str) -> String {
    let header = csv.lines().next().expect("a header");
    let columns: Vec<&str> = header.split(',').collect();
    let at = |name: &str| columns.iter().position(|c| *c == name).expect("a column");
    let (temperature, time) = (at("temperature_c"), at("time_s"));
    let rows = csv.lines().skip(1).map(|line| {
        let mut cells: Vec<&str> = line.split(',').collect();
        cells[temperature] = "22";
        cells[time] = "0";
        cells.join(",")
    });
    format!("{header}\n{}\n", rows.collect::<Vec<_>>().join("\n"))
}

#[test]
fn a_person_overrules() {
    let case = case_with("joint_scale");
    let (_folder, profile, csv) = files(&case);
    let run = poseshift()
        .args([
            "diagnose",
            "--json",
            "--quick",
            "--reject",
            "joint_scale",
            "--accept",
            "backlash:2",
            "--profile",
        ])
        .arg(&profile)
        .arg("--measurements")
        .arg(&csv)
        .output()
        .expect("the program starts");
    let report: Value = serde_json::from_slice(&run.stdout).expect("JSON");
    let names: Vec<&str> = report["effects"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|e| e["effect"].as_str())
        .collect();
    assert!(
        names.contains(&"backlash") && !names.contains(&"joint_scale"),
        "{names:?}"
    );
}

#[test]
fn what_a_person_wants_and_the_rows_cannot_show_is_refused() {
    let mut case = case(group("clean"), 0, 3, 60);
    case.csv = without_change(&case.csv);
    for (word, reason) in [
        ("thermal_growth", "temperature_c ranges over 0.00 degrees"),
        ("warm_up_drift:1", "time_s is constant"),
        ("joint_harmonic:2", "joint_harmonic:2:1"),
    ] {
        let (status, _, reported) = diagnosed(&case, &["--quick", "--accept", word]);
        assert_eq!(status, 2, "{word}: {reported}");
        assert!(reported.contains(reason), "{word}: {reported}");
    }
}

/// The measurements with each row's place changed: by the row, and all places.
fn with_places(csv: &str, change: impl Fn(usize, &[[f64; 3]]) -> [f64; 3]) -> String {
    let header = csv.lines().next().expect("a header");
    let at = header
        .split(',')
        .position(|c| c == "x_mm")
        .expect("a column");
    let cells: Vec<Vec<&str>> = csv
        .lines()
        .skip(1)
        .map(|l| l.split(',').collect())
        .collect();
    let places: Vec<[f64; 3]> = cells
        .iter()
        .map(|row| std::array::from_fn(|k| row[at + k].parse().expect("a number")))
        .collect();
    let mut out = format!("{header}\n");
    for (number, row) in cells.iter().enumerate() {
        let new = change(number, &places).map(|x| format!("{x:.6}"));
        let mut row: Vec<&str> = row.clone();
        for k in 0..3 {
            row[at + k] = &new[k];
        }
        out += &format!("{}\n", row.join(","));
    }
    out
}

/// Status, standard output and standard error of a diagnosis.
pub fn diagnosed(case: &Case, more: &[&str]) -> (i32, String, String) {
    let (_folder, profile, csv) = files(case);
    let run = poseshift()
        .args(["diagnose", "--profile"])
        .arg(&profile)
        .arg("--measurements")
        .arg(&csv)
        .args(more)
        .output()
        .expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        run.status.code().expect("it ended"),
        text(&run.stdout),
        text(&run.stderr),
    )
}

#[test]
fn lengths_in_another_unit_are_reported_by_name() {
    let mut case = case(group("clean"), 0, 3, 60);
    let plain = case.csv.clone();
    for (of_mm, says) in [(1e-3, "metres"), (1.0 / 25.4, "inches")] {
        case.csv = with_places(&plain, |row, all| all[row].map(|x| of_mm * x));
        let (status, out, error) = diagnosed(&case, &["--quick"]);
        assert_eq!((status, out.as_str()), (2, ""));
        assert!(error.contains(says), "{error}");
    }
}

#[test]
fn rows_that_belong_to_other_poses_get_no_confident_name() {
    let mut case = case(group("clean"), 0, 3, 60);
    let plain = case.csv.clone();
    case.csv = with_places(&plain, |row, all| all[(37 * row + 11) % all.len()]);
    let (status, out, error) = diagnosed(&case, &["--quick"]);
    assert_ne!(status, 0, "{out}{error}");
    assert!(!out.contains("of the disagreement goes"), "{out}");
}

#[test]
fn one_pose_again_and_again_says_nothing() {
    let mut case = case(group("clean"), 0, 3, 40);
    let first = case.csv.lines().nth(1).expect("a row").to_owned();
    let header = case.csv.lines().next().expect("a header");
    case.csv = format!("{header}\n{}", format!("{first}\n").repeat(40));
    let (status, out, error) = diagnosed(&case, &[]);
    assert_eq!((status, out.as_str()), (2, ""));
    assert!(error.contains("same pose"), "{error}");
}

#[test]
fn the_text_is_read_in_a_minute() {
    let (status, out, error) = diagnosed(&case_with("backlash"), &[]);
    assert_eq!(status, 0, "{error}");
    let lines: Vec<&str> = out.lines().take(4).collect();
    assert!(lines[0].starts_with("Explained:"), "{out}");
    assert!(
        lines[1].contains("% of the disagreement goes: ")
            && lines[1].ends_with("mm on 150 poses not used."),
        "{out}"
    );
    assert!(
        lines[2].starts_with("certain   J") && lines[2].ends_with("when it reverses (backlash)."),
        "{out}"
    );
    assert!(lines[3].starts_with("residual  0.03"), "{out}");
    // no bar where nobody looks, no line wider than a terminal
    assert_eq!(error, "");
    for line in out.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
}

#[test]
fn where_a_column_is_missing_the_effects_that_need_it_are_listed() {
    let mut case = case(group("clean"), 0, 3, 60);
    // without directions, temperatures, times
    case.csv = case
        .csv
        .lines()
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let kept: Vec<&str> = cells[..9].iter().chain(&cells[17..]).copied().collect();
            kept.join(",") + "\n"
        })
        .collect();
    let (status, out, error) = diagnosed(&case, &["--json", "--quick"]);
    assert_eq!(status, 0, "{error}");
    let report: Value = serde_json::from_str(&out).expect("JSON");
    let missing: Vec<(&str, &str)> = report["cannot_test"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|c| {
            (
                c["effect"].as_str().expect("an id"),
                c["missing"].as_str().expect("a column"),
            )
        })
        .collect();
    for (effect, column) in [
        ("backlash", "dir"),
        ("thermal_growth", "temperature_c"),
        ("warm_up_drift", "time_s"),
    ] {
        assert!(
            missing
                .iter()
                .any(|(e, m)| *e == effect && m.contains(column)),
            "{missing:?}"
        );
    }
}

#[test]
fn measurements_of_another_robot_get_no_confident_name() {
    // cases alternate between two robots
    let mut case = case(group("clean"), 0, 3, 60);
    let other = crate::trial::case(group("clean"), 1, 3, 60);
    case.csv = other.csv;
    let (status, out, error) = diagnosed(&case, &["--quick"]);
    assert_ne!(status, 0, "{out}{error}");
    assert!(
        out.is_empty() || out.starts_with("What is missing cannot be determined"),
        "{out}"
    );
}

#[test]
fn another_tool_is_called_a_tool_or_nothing() {
    let mut case = case(group("clean"), 0, 3, 80);
    // the profile's tool is longer than the one that was measured
    case.profile_text = case.profile_text.replace("z_mm: 100", "z_mm: 160");
    let (status, out, error) = diagnosed(&case, &["--json", "--quick"]);
    if status == 2 {
        assert!(!error.is_empty());
        return;
    }
    let report: Value = serde_json::from_str(&out).expect("JSON");
    let names: Vec<&str> = report["effects"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|e| e["effect"].as_str())
        .collect();
    assert!(
        report["verdict"] == "undetermined" || names == ["tool_frame"],
        "{names:?} {}",
        report["verdict"]
    );
}

#[test]
fn without_a_noise_to_judge_by_nothing_is_named() {
    // a drawing: frames, geometry and compliance take nearly all that 14 rows say, and there is no
    // sigma_mm
    let case = without_sigma(case(group("nominal"), 0, 3, 14));
    let (status, out, error) = diagnosed(&case, &[]);
    assert_eq!((status, out.as_str()), (2, ""));
    assert!(error.contains("too few"), "{error}");
}

/// The report of a robot whose joint 2 has a spring of `real`, in rad/(N m), where its profile has
/// one of `known`.
fn of_springs(known: &str, real: &str) -> Value {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let with = |name: &str, compliance: &str| {
        let text = text("robots/abb_irb120_thesis.yaml");
        let (before, after) = text
            .split_once("joint: 2, rad_per_n_m: ")
            .expect("a spring of joint 2");
        let (_, after) = after.split_once('}').expect("its end");
        let path = at(name);
        let text = format!("{before}joint: 2, rad_per_n_m: {compliance}}}{after}");
        std::fs::write(&path, text).expect("a writable folder");
        path
    };
    let (known, real) = (with("known.yaml", known), with("real.yaml", real));
    let (joints, measured) = (at("joints.csv"), at("measured.csv"));
    let reported = |arguments: &str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        let (status, out, error) = run(&arguments);
        assert!(status < 2, "{error}");
        out
    };
    reported(&format!(
        "plan --profile {known} --count 150 --candidates 500 --starts 1 -o {joints}"
    ));
    reported(&format!(
        "simulate --profile {real} --joints {joints} --noise-mm 0.03 --seed 1 -o {measured}"
    ));
    let json = reported(&format!(
        "diagnose --profile {known} --measurements {measured} --json"
    ));
    serde_json::from_str(&json).expect("JSON")
}

#[test]
fn a_spring_that_would_push_is_no_answer() {
    let report = of_springs("0", "-6e-5");
    assert_eq!(report["verdict"], "undetermined", "{report:#}");
    let reasons = report["reasons"].to_string();
    assert!(reasons.contains("below what is possible"), "{reasons}");
}

#[test]
fn a_spring_that_pushes_in_the_profile_may_push_less() {
    let report = of_springs("-6e-5", "-2e-5");
    let first = &report["effects"][0];
    assert_eq!(
        (&first["effect"], &first["joint"]),
        (&"joint_compliance".into(), &2.into()),
        "{report:#}"
    );
    let found = first["parameters"]["rad_per_n_m"].as_f64();
    assert!(
        found.is_some_and(|found| (found + 2e-5).abs() < 4e-6),
        "{first}"
    );
}
