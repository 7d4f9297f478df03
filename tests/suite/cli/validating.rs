//! `validate`: files that cannot be meant, and figures that do not mean what they seem to.

use crate::support::{poseshift, repository, scratch};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

const TRUTH: &str = "robots/abb_irb120_thesis.yaml";

fn seeded(seed: usize) -> StdRng {
    StdRng::seed_from_u64(u64::try_from(seed).expect("a small number"))
}

fn run(folder: &Path, command: &str) -> (Option<i32>, Value, String) {
    let mut arguments: Vec<String> = command.split(' ').map(str::to_owned).collect();
    for word in &mut arguments {
        *word = word.replace("TRUTH", repository(TRUTH).to_str().expect("UTF-8"));
    }
    let output = poseshift()
        .current_dir(folder)
        .args(&arguments)
        .arg("--json")
        .output()
        .expect("the program starts");
    (
        output.status.code(),
        serde_json::from_slice(&output.stdout).unwrap_or(Value::Null),
        String::from_utf8_lossy(&output.stderr).into_owned(),
    )
}

fn validate(folder: &Path, profile: &str, rest: &str) -> (Option<i32>, Value, String) {
    run(
        folder,
        &format!("validate --profile {profile} --measurements m.csv{rest}"),
    )
}

/// Measurements `m.csv` of the truth in a folder of their own.
fn measured(count: usize) -> TempDir {
    let folder = scratch();
    let mut joints = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg".to_owned();
    let mut random = seeded(count);
    for _ in 0..count {
        let ends = [150.0, 100.0, 65.0, 150.0, 110.0, 170.0];
        let q = ends.map(|end: f64| random.random_range(-end..end).to_string());
        joints += &format!("\n{}", q.join(","));
    }
    std::fs::write(folder.path().join("q.csv"), joints).expect("scratch");
    let simulate = "simulate --profile TRUTH --joints q.csv --noise-mm 0.02 -o m.csv";
    let (status, _, reported) = run(folder.path(), simulate);
    assert_eq!(status, Some(0), "{reported}");
    folder
}

/// Changes the numbers of some columns of `m.csv`.
fn change(folder: &Path, columns: &[&str], by: impl Fn(f64) -> f64) {
    let path = folder.join("m.csv");
    let text = std::fs::read_to_string(&path).expect("measurements");
    let header: Vec<&str> = text.lines().next().expect("a header").split(',').collect();
    let mut out = header.join(",");
    for line in text.lines().skip(1) {
        let cells = line.split(',').zip(&header).map(|(cell, name)| {
            if columns.contains(name) {
                by(cell.parse().expect("a number")).to_string()
            } else {
                cell.to_owned()
            }
        });
        out += &format!("\n{}", cells.collect::<Vec<_>>().join(","));
    }
    std::fs::write(path, out).expect("scratch");
}

fn ids(report: &Value) -> Vec<&str> {
    let findings = report["findings"].as_array().expect("findings");
    findings.iter().filter_map(|f| f["id"].as_str()).collect()
}

#[test]
fn files_that_cannot_be_meant_are_refused_as_by_calibrate() {
    let joints = ["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"];
    let folder = measured(40);
    assert_eq!(validate(folder.path(), "TRUTH", "").0, Some(0));
    change(folder.path(), &joints, f64::to_radians);
    let (status, _, reported) = validate(folder.path(), "TRUTH", "");
    assert!(
        status == Some(2) && reported.contains("radians"),
        "{reported}"
    );
    let folder = measured(40);
    change(folder.path(), &["x_mm", "y_mm", "z_mm"], |v| v / 1000.0);
    let (status, _, reported) = validate(folder.path(), "TRUTH", "");
    assert!(
        status == Some(2) && reported.contains("metres"),
        "{reported}"
    );
    let folder = measured(2);
    let (status, _, reported) = validate(folder.path(), "TRUTH", "");
    assert_eq!(status, Some(2));
    assert!(
        !reported.contains("--level") && reported.contains("configurations"),
        "{reported}"
    );
}

#[test]
fn rows_that_the_profile_was_calibrated_with_are_reported() {
    let folder = measured(30);
    let at = folder.path();
    let calibrate = "calibrate --profile TRUTH --measurements m.csv --level 0 --date day -o c.yaml";
    let (status, _, reported) = run(at, calibrate);
    assert_eq!(status, Some(0), "{reported}");
    let (_, report, _) = validate(at, "c.yaml", "");
    assert_eq!(ids(&report), ["seen-before"]);
    validate(at, "c.yaml", " --report page.html");
    let page = std::fs::read_to_string(at.join("page.html")).expect("a page");
    assert!(page.contains("seen-before"));
    // others are news
    change(at, &["x_mm"], |x| x + 0.001);
    let (_, report, _) = validate(at, "c.yaml", "");
    assert!(ids(&report).is_empty(), "{report}");
    // and the profile tells what it is worth
    let show = poseshift()
        .current_dir(at)
        .args(["profile", "show", "c.yaml"])
        .output()
        .expect("the program starts");
    let text = String::from_utf8(show.stdout).expect("UTF-8");
    for word in ["date  day", "rows  30", "error after", "±"] {
        assert!(text.contains(word), "{word}: {text}");
    }
}

#[test]
fn a_device_set_up_anew_is_reported_and_refitted_with_its_regions_and_its_controller() {
    let folder = measured(40);
    let at = folder.path();
    let calibrate = "calibrate --profile TRUTH --measurements m.csv --level 0 -o c.yaml";
    assert_eq!(run(at, calibrate).0, Some(0));
    change(at, &["x_mm"], |x| x + 0.001);
    let (_, before, _) = validate(at, "c.yaml", "");
    change(at, &["x_mm"], |x| x + 3000.0);
    let (status, moved, _) = validate(at, "c.yaml", "");
    assert_eq!(status, Some(0));
    let finding = &moved["findings"][0];
    assert_eq!(finding["id"], "worse-than-nominal");
    assert!(
        finding["hint"]
            .as_str()
            .expect("a hint")
            .contains("--refit-frames")
    );
    let (_, refitted, _) = validate(at, "c.yaml", " --refit-frames");
    assert!(ids(&refitted).is_empty(), "{refitted}");
    assert_eq!(
        refitted["position"]["controller"],
        refitted["position"]["frames_only"]
    );
    let regions = |report: &Value| -> Vec<Value> {
        let parts = report["parts"].as_array().expect("parts");
        let those = parts.iter().filter(|part| part["by"] == "region");
        those.map(|part| part["name"].clone()).collect()
    };
    assert_eq!(regions(&before), regions(&refitted));
    assert!(regions(&before).len() > 2);
}

#[test]
fn sigmas_in_another_unit_are_reported_with_the_factor() {
    let folder = measured(40);
    let path = folder.path().join("m.csv");
    let text = std::fs::read_to_string(&path).expect("measurements");
    assert!(text.lines().next().expect("a header").contains("sigma_mm"));
    change(folder.path(), &["sigma_mm"], |sigma| sigma * 1000.0);
    let (_, report, _) = validate(folder.path(), "TRUTH", "");
    assert_eq!(ids(&report), ["sigma-large"]);
    change(folder.path(), &["sigma_mm"], |sigma| sigma * 1e-5);
    let (_, report, _) = validate(folder.path(), "TRUTH", "");
    assert_eq!(ids(&report), ["sigma-small"]);
}

#[test]
fn tables_that_are_no_csv_are_named_with_the_way_out() {
    let folder = measured(20);
    let path = folder.path().join("m.csv");
    let text = std::fs::read_to_string(&path).expect("measurements");
    for (from, to, word) in [(",", ";", "semicolons"), (",", "\t", "tabs")] {
        std::fs::write(&path, text.replace(from, to)).expect("scratch");
        // measurements are read as they come, other tables are not
        let (status, _, reported) = validate(folder.path(), "TRUTH", "");
        assert_eq!(status, Some(0), "{reported}");
        let (status, _, reported) = run(folder.path(), "simulate --profile TRUTH --joints m.csv");
        assert!(
            status == Some(2) && reported.contains(word) && reported.contains("sed"),
            "{reported}"
        );
    }
    std::fs::write(&path, text.replace(',', ";").replace('.', ",")).expect("scratch");
    let (status, _, reported) = validate(folder.path(), "TRUTH", "");
    assert_eq!(status, Some(0), "{reported}");
    let (status, _, reported) = run(folder.path(), "simulate --profile TRUTH --joints m.csv");
    assert!(
        status == Some(2) && reported.contains("decimals"),
        "{reported}"
    );
    std::fs::write(&path, "").expect("scratch");
    let (status, _, reported) = validate(folder.path(), "TRUTH", "");
    assert!(
        status == Some(2) && reported.contains("empty"),
        "{reported}"
    );
    let mut bytes = text.into_bytes();
    let place = bytes.len() - 3;
    bytes[place] = 0xb5;
    std::fs::write(&path, bytes).expect("scratch");
    let (status, _, reported) = run(folder.path(), "simulate --profile TRUTH --joints m.csv");
    assert!(
        status == Some(2) && reported.contains("UTF-8") && reported.contains("iconv"),
        "{reported}"
    );
    assert!(!reported.contains("m.csv:21:1\n"), "{reported}");
}

#[test]
fn folds_identify_the_level_and_hold_to_the_priors_that_are_asked_for() {
    let folder = measured(24);
    let folded = |rest: &str| {
        let (status, report, reported) = validate(folder.path(), "TRUTH", rest);
        assert_eq!(status, Some(0), "{reported}");
        let mean = report["folds"]["real"]["position"]["mean_mm"].as_f64();
        mean.unwrap_or_else(|| panic!("{report:#}"))
    };
    let frames = folded(" --folds 4 --level 0");
    let geometry = folded(" --folds 4 --level 2");
    let held = folded(" --folds 4 --level 2 --priors");
    // the profile's own effects stay where no level seeks them
    assert!(frames < 0.1, "{frames}");
    assert!((geometry - held).abs() > 1e-6, "{geometry} {held}");
    // but those of a calibrated profile may have seen the rows that are left out
    let truth = std::fs::read_to_string(repository(TRUTH)).expect("a profile");
    let calibrated = "calibration:\n  provenance: {measurements_sha256: [\"0\"]}\n  effects:\n";
    let own = truth.replacen("calibration:\n  effects:\n", calibrated, 1);
    assert_ne!(own, truth);
    std::fs::write(folder.path().join("own.yaml"), own).expect("scratch");
    let rest = " --folds 4 --level 0";
    let (status, report, reported) = validate(folder.path(), "own.yaml", rest);
    assert_eq!(status, Some(0), "{reported}");
    let anew = report["folds"]["real"]["position"]["mean_mm"].as_f64();
    assert!(
        anew.is_some_and(|anew| anew > 5.0 * frames),
        "{anew:?} {frames}"
    );
    // some thirty parameters from 54 numbers: priors help
    assert!(held < geometry, "{held} {geometry}");
    let (status, _, reported) = validate(folder.path(), "TRUTH", " --level 2");
    assert!(
        status == Some(2) && reported.contains("--folds"),
        "{reported}"
    );
}

#[test]
fn ten_poses_say_whether_an_arm_is_as_calibrated() {
    let folder = measured(60);
    let at = folder.path();
    let calibrate = "calibrate --profile TRUTH --measurements m.csv --level 0 -o c.yaml";
    assert_eq!(run(at, calibrate).0, Some(0));
    let ten = measured(10);
    std::fs::copy(ten.path().join("m.csv"), at.join("m.csv")).expect("scratch");
    let (status, report, _) = validate(at, "c.yaml", " --as-calibrated");
    let said = &report["as_calibrated"];
    assert_eq!(
        (status, &said["answer"]),
        (Some(0), &Value::from("as calibrated"))
    );
    assert!(said["ratio"].as_f64() < said["limit"].as_f64(), "{said}");
    let [own, of_rows] =
        [&said["rms_mm"], &report["position"]["real"]["rms_mm"]].map(Value::as_f64);
    let apart = own.zip(of_rows).map(|(a, b)| (a - b).abs());
    assert!(apart.is_some_and(|mm| mm < 1e-12), "{own:?} {of_rows:?}");
    // a joint that stands off by twice what is said to be seen is seen
    let off = said["sees_joints_deg"][1].as_f64().expect("joint 2 shows");
    change(at, &["q2_deg"], |q| q + 2.0 * off);
    let (status, report, _) = validate(at, "c.yaml", " --as-calibrated");
    assert_eq!(status, Some(1));
    assert_eq!(report["as_calibrated"]["answer"], "measure again");
    assert!(ids(&report).contains(&"not-as-calibrated"), "{report}");
    let (status, _, reported) = validate(at, "TRUTH", " --as-calibrated");
    assert!(
        status == Some(2) && reported.contains("does not say how well"),
        "{reported}"
    );
}

/// Three reflectors at each of so many configurations, in which joints repeat to this (uniform),
/// in `m.csv`; the profile with their places is `three.yaml`.
fn three_reflectors(count: usize, repeats_deg: f64) -> TempDir {
    let folder = measured(count);
    let at = folder.path();
    let places = "points: {a: [0, 0, 0], b: [60, -40, 20], \
                  c: [-50, -30, 40]}";
    let truth = std::fs::read_to_string(repository(TRUTH)).expect("a profile");
    let three = truth.replace("points: {}", places);
    std::fs::write(at.join("three.yaml"), three).expect("scratch");
    let commanded = std::fs::read_to_string(at.join("q.csv")).expect("joints");
    let mut random = seeded(count + 1);
    let mut stood = String::from("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg");
    for line in commanded.lines().skip(1) {
        let angles = line.split(',').map(|cell| {
            let off = random.random_range(-1.0..1.0) * repeats_deg;
            (cell.parse::<f64>().expect("a number") + off).to_string()
        });
        stood += &format!("\n{}", angles.collect::<Vec<_>>().join(","));
    }
    std::fs::write(at.join("stood.csv"), stood).expect("scratch");
    let simulate = "simulate --profile three.yaml --joints stood.csv --noise-mm 0.015 -o m.csv";
    let (status, _, reported) = run(at, simulate);
    assert_eq!(status, Some(0), "{reported}");
    // the table has what was commanded
    let text = std::fs::read_to_string(at.join("m.csv")).expect("measurements");
    let mut out = text.lines().next().expect("a header").to_owned();
    for (k, line) in text.lines().skip(1).enumerate() {
        let angles = commanded.lines().nth(1 + k / 3).expect("a configuration");
        let cells: Vec<&str> = line.split(',').collect();
        out += &format!("\n{},{angles},{}", cells[0], cells[7..].join(","));
    }
    assert!(
        out.starts_with("id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,"),
        "{out}"
    );
    std::fs::write(at.join("m.csv"), out).expect("scratch");
    folder
}

#[test]
fn reflectors_of_one_pose_are_no_poses_of_their_own() {
    // the limit of an F test of 90 numbers is 1.43, that of 30 is 1.8
    for (repeats_deg, limits) in [(0.0, 1.35..1.5), (0.005, 1.55..1.95)] {
        let folder = three_reflectors(60, repeats_deg);
        let at = folder.path();
        let calibrate = "calibrate --profile three.yaml --measurements m.csv --level 0 -o c.yaml";
        let (status, _, reported) = run(at, calibrate);
        assert_eq!(status, Some(0), "{reported}");
        let ten = three_reflectors(10, repeats_deg);
        std::fs::copy(ten.path().join("m.csv"), at.join("m.csv")).expect("scratch");
        let (_, report, reported) = validate(at, "c.yaml", " --as-calibrated");
        let said = &report["as_calibrated"];
        let limit = said["limit"].as_f64();
        let limit = limit.unwrap_or_else(|| panic!("{reported}"));
        assert!(limits.contains(&limit), "{repeats_deg}: {said}");
        // a profile that does not say how its rows missed: as if they had missed alike
        let text = std::fs::read_to_string(at.join("c.yaml")).expect("a profile");
        let older: Vec<&str> = (text.lines())
            .filter(|line| !line.contains("shared_factor:") && !line.contains("configurations:"))
            .collect();
        assert_eq!(older.len() + 2, text.lines().count(), "{text}");
        std::fs::write(at.join("c.yaml"), older.join("\n")).expect("scratch");
        let (_, report, _) = validate(at, "c.yaml", " --as-calibrated");
        let limit = report["as_calibrated"]["limit"].as_f64();
        assert!(limit.is_some_and(|l| (1.6..1.95).contains(&l)), "{report}");
    }
}

#[test]
fn runs_say_since_when_an_arm_errs_otherwise() {
    let folder = measured(40);
    let at = folder.path();
    let truth = std::fs::read_to_string(repository(TRUTH)).expect("a profile");
    let gear =
        "effects:\n    - {effect: joint_harmonic, joint: 3, order: 1, cos_deg: 0.05, sin_deg: 0}\n";
    std::fs::write(at.join("worn.yaml"), truth.replacen("effects:\n", gear, 1)).expect("scratch");
    let mut files = String::new();
    for night in 0..7 {
        let robot = if night < 4 { "TRUTH" } else { "worn.yaml" };
        let simulate = format!(
            "simulate --profile {robot} --joints q.csv --noise-mm 0.02 --seed {night} -o \
             n{night}.csv"
        );
        assert_eq!(run(at, &simulate).0, Some(0));
        files += &format!(" --measurements n{night}.csv");
    }
    let (status, report, reported) = run(
        at,
        &format!("diagnose --quick --runs --profile TRUTH{files}"),
    );
    assert_eq!(status, Some(0), "{reported}");
    let changes = report["drift"]["changes"].as_array().expect("changes");
    assert_eq!(changes.len(), 1, "{report}");
    assert_eq!(
        (&changes[0]["since"], changes[0]["run"].as_u64()),
        (&"n4.csv".into(), Some(5))
    );
    assert_eq!(
        (report["rows"].as_u64(), &report["effects"][0]["effect"]),
        (Some(120), &"joint_harmonic".into())
    );
    let few = "diagnose --runs --profile TRUTH --measurements n0.csv --measurements n1.csv";
    let (status, _, reported) = run(at, few);
    assert!(
        status == Some(2) && reported.contains("too few for a change"),
        "{reported}"
    );
}

/// Measurements `m.csv` of an arm whose third joint is counted with the second, the profile `f.yaml`,
/// and the same rows `n.csv` without the columns of directions.
fn coupled() -> TempDir {
    let folder = scratch();
    let at = folder.path();
    let arm =
        std::fs::read_to_string(repository("robots/fanuc_lrmate200ic.yaml")).expect("a profile");
    let arm = arm
        .replace(
            "effects: []",
            "effects:\n    - {effect: backlash, joint: 3, width_deg: 0.08}",
        )
        .replace(
            "tools: {}",
            "tools: {t: {frame: {x_mm: 40, y_mm: 0, z_mm: 120, rx_deg: 0, ry_deg: 0, rz_deg: 0}}}",
        );
    std::fs::write(at.join("f.yaml"), arm).expect("scratch");
    let mut joints = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg".to_owned();
    let mut random = seeded(5);
    for _ in 0..40 {
        let ends = [100.0, 40.0, 40.0, 100.0, 90.0, 100.0];
        let q = ends.map(|end: f64| random.random_range(-end..end).to_string());
        joints += &format!("\n{}", q.join(","));
    }
    std::fs::write(at.join("q.csv"), joints).expect("scratch");
    let simulate = "simulate --profile f.yaml --joints q.csv -o m.csv";
    let (status, _, reported) = run(at, simulate);
    assert_eq!(status, Some(0), "{reported}");
    let text = std::fs::read_to_string(at.join("m.csv")).expect("measurements");
    let header: Vec<&str> = text.lines().next().expect("a header").split(',').collect();
    let without = text.lines().map(|line| {
        let cells = line.split(',').zip(&header);
        let kept = cells.filter(|(_, name)| !name.starts_with("dir"));
        kept.map(|(cell, _)| cell).collect::<Vec<_>>().join(",")
    });
    let without = without.collect::<Vec<_>>().join("\n");
    std::fs::write(at.join("n.csv"), without).expect("scratch");
    folder
}

#[test]
fn a_coupled_joint_comes_from_the_side_of_its_gearbox_in_simulations_too() {
    let folder = coupled();
    let at = folder.path();
    let max = |rest: &str| {
        let (status, report, reported) = run(at, &format!("validate --profile f.yaml {rest}"));
        assert_eq!(status, Some(0), "{reported}");
        report["position"]["real"]["max_mm"]
            .as_f64()
            .expect("a number")
    };
    let [written, derived] = [
        "--measurements m.csv",
        "--measurements n.csv --driven-in-order",
    ];
    assert!(max(written) < 1e-6, "{}", max(written));
    assert!(max(derived) < 1e-6, "{}", max(derived));
    // the pendant's angle of joint 3 goes the other way in some rows
    let text = std::fs::read_to_string(at.join("m.csv")).expect("measurements");
    let header: Vec<&str> = text.lines().next().expect("a header").split(',').collect();
    let column = |name: &str| -> Vec<f64> {
        let index = header.iter().position(|h| *h == name).expect("a column");
        let cell = |line: &str| line.split(',').nth(index)?.parse().ok();
        text.lines().skip(1).filter_map(cell).collect()
    };
    let (q, side) = (column("q3_deg"), column("dir3"));
    let others = q.windows(2).zip(&side[1..]);
    let others = others.filter(|(pair, side)| (pair[1] - pair[0]) * **side < 0.0);
    assert!(others.count() > 3);
}

#[test]
fn a_single_row_that_is_off_is_named_and_says_nothing_of_the_others() {
    let folder = measured(40);
    let row = std::cell::Cell::new(0);
    change(folder.path(), &["x_mm"], |x| {
        row.set(row.get() + 1);
        x + if row.get() == 17 { 5.0 } else { 0.0 }
    });
    let (_, report, _) = validate(folder.path(), "TRUTH", "");
    assert_eq!(ids(&report), ["outliers"]);
    let finding = &report["findings"][0];
    assert_eq!(finding["line"], 18, "{finding}");
    // all are, too, where the stated deviations are too small
    change(folder.path(), &["sigma_mm"], |sigma| sigma * 1e-2);
    let (_, report, _) = validate(folder.path(), "TRUTH", "");
    assert_eq!(ids(&report), ["outliers", "sigma-small"]);
}
