//! `diagnose` from outside: report, files, exit status, bad input.

use crate::support::{poseshift, scratch};
use crate::trial::{Case, GROUPS, case};
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

fn group(name: &str) -> &'static crate::trial::Group {
    GROUPS
        .iter()
        .find(|g| g.name == name)
        .expect("a group of the trial")
}

#[test]
fn the_report_names_the_effect_and_the_profile_has_it() {
    // a joint's backlash: kinds follow from the number
    let number = (0..64)
        .find(|n| case(group("calibrated"), *n, 3, 30).what == "backlash")
        .expect("every kind is hidden");
    let case = case(group("calibrated"), number, 3, 150);
    let (folder, profile, csv) = files(&case);
    let better = folder.path().join("better.yaml");
    let run = poseshift()
        .args(["diagnose", "--json", "--profile"])
        .arg(&profile)
        .arg("--measurements")
        .arg(&csv)
        .arg("-o")
        .arg(&better)
        .output()
        .expect("the program starts");
    assert_eq!(
        run.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    let report: Value = serde_json::from_slice(&run.stdout).expect("JSON");
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
fn too_few_rows_and_constant_columns_are_told() {
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
    let header = constant.csv.lines().next().expect("a header").to_owned();
    let columns: Vec<&str> = header.split(',').collect();
    let at = |name: &str| columns.iter().position(|c| *c == name).expect("a column");
    let (temperature, time) = (at("temperature_c"), at("time_s"));
    let rows = constant.csv.lines().skip(1).map(|line| {
        let mut cells: Vec<&str> = line.split(',').collect();
        cells[temperature] = "22";
        cells[time] = "0";
        cells.join(",")
    });
    constant.csv = format!("{header}\n{}\n", rows.collect::<Vec<_>>().join("\n"));
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

#[test]
fn a_person_overrules() {
    let number = (0..64)
        .find(|n| case(group("calibrated"), *n, 3, 30).what == "joint_scale")
        .expect("every kind is hidden");
    let case = case(group("calibrated"), number, 3, 150);
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
