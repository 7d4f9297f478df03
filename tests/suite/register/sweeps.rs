//! `axes`: files that cannot be meant are reported, and uncertainties hold the truth.

use crate::support::{poseshift, repository, scratch};
use serde_json::Value;

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";

/// The sweeps of the guide: header and cells.
fn sweeps() -> (Vec<String>, Vec<Vec<String>>) {
    let text = std::fs::read_to_string(repository("docs/measuring/sweeps.csv")).expect("a file");
    let mut lines = text
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect());
    (lines.next().expect("a header"), lines.collect())
}

fn column(header: &[String], name: &str) -> usize {
    let found = header.iter().position(|column| column == name);
    found.unwrap_or_else(|| panic!("no column {name}"))
}

/// Exit status, report and standard error of the sweeps, changed.
fn axes(
    profile: &str,
    change: impl Fn(&[String], &mut Vec<Vec<String>>),
) -> (Option<i32>, Value, String) {
    let folder = scratch();
    let (header, mut rows) = sweeps();
    change(&header, &mut rows);
    let lines: Vec<String> = [header]
        .iter()
        .chain(&rows)
        .map(|row| row.join(","))
        .collect();
    std::fs::write(folder.path().join("s.csv"), lines.join("\n")).expect("scratch");
    let run = |json: bool| {
        let mut command = poseshift();
        command.current_dir(folder.path());
        command.args(["axes", "s.csv", "--profile"]);
        command.arg(repository(profile));
        if json {
            command.arg("--json");
        }
        command.output().expect("the program starts")
    };
    let reported = run(false);
    let value = serde_json::from_slice(&run(true).stdout).unwrap_or(Value::Null);
    (
        reported.status.code(),
        value,
        String::from_utf8_lossy(&reported.stderr).into_owned(),
    )
}

fn scaled(name: &'static str, by: f64) -> impl Fn(&[String], &mut Vec<Vec<String>>) {
    move |header, rows| {
        let at = column(header, name);
        for row in rows {
            row[at] = (row[at].parse::<f64>().expect("a number") * by).to_string();
        }
    }
}

#[test]
fn sweeps_that_no_base_and_tool_of_the_robot_explain_are_refused_with_what_does() {
    let (status, _, reported) = axes(PROFILE, |header, rows| {
        for name in ["x_mm", "y_mm", "z_mm"] {
            scaled(name, 1e-3)(header, rows);
        }
    });
    assert!(
        status == Some(2) && reported.contains("metres"),
        "{reported}"
    );
    let (status, _, reported) = axes(PROFILE, |header, rows| {
        let (x, y) = (column(header, "x_mm"), column(header, "y_mm"));
        for row in rows {
            row.swap(x, y);
        }
    });
    assert!(
        status == Some(2) && reported.contains("swapped"),
        "{reported}"
    );
    let (status, _, reported) = axes(PROFILE, scaled("q2_deg", -1.0));
    assert!(
        status == Some(2) && reported.contains("joint 2 counts the other way"),
        "{reported}"
    );
    let (status, _, reported) = axes("robots/kuka_kr6_r900.yaml", |_, _| ());
    assert!(
        status == Some(2) && reported.contains("is it this robot"),
        "{reported}"
    );
}

#[test]
fn a_row_on_no_circle_is_left_out_and_named() {
    let (_, clean, _) = axes(PROFILE, |_, _| ());
    assert_eq!(clean["findings"], serde_json::json!([]));
    let (status, found, reported) = axes(PROFILE, |header, rows| {
        let at = column(header, "x_mm");
        rows[5][at] = (rows[5][at].parse::<f64>().expect("a number") + 5.0).to_string();
    });
    assert_eq!(status, Some(0), "{reported}");
    // the header is line 1
    assert!(
        reported.contains("s.csv:7:1: warning[outlier]: left out"),
        "{reported}"
    );
    assert_eq!(found["findings"][0]["id"], "outlier");
    for key in ["x_mm", "y_mm", "z_mm"] {
        let [a, b] = [&found, &clean].map(|v| v["base"][key].as_f64().expect("a number"));
        assert!((a - b).abs() < 0.05, "{key}: {a} and {b}");
    }
}

#[test]
fn the_sag_of_the_arm_is_in_the_sigma_and_three_rows_have_none() {
    // the truth that the guide's data were made with
    const TRUE_Z_MM: f64 = 0.103;
    let (_, found, _) = axes(PROFILE, |_, _| ());
    let z = found["base"]["z_mm"].as_f64().expect("a number");
    let sigma = found["base_sigma"]["z_mm"].as_f64().expect("a number");
    assert!((z - TRUE_Z_MM).abs() > 0.3, "{z}");
    assert!((z - TRUE_Z_MM).abs() < 3.0 * sigma, "{z} +/- {sigma}");
    assert_eq!(found["base_sag"]["from"], "profile");
    // without compliance in the profile, a typical arm's
    let folder = scratch();
    let text = std::fs::read_to_string(repository(PROFILE)).expect("a profile");
    let without = |start: &str| {
        let lines = text.lines().filter(|line| !line.contains(start));
        lines.map(|line| format!("{line}\n")).collect::<String>()
    };
    let soft = folder.path().join("stiff.yaml");
    std::fs::write(&soft, without("effect: joint_compliance")).expect("scratch");
    let (_, stiff, _) = axes(soft.to_str().expect("a name"), |_, _| ());
    assert_eq!(stiff["base_sag"]["from"], "typical");
    assert_eq!(stiff["findings"], serde_json::json!([]));
    let z = stiff["base"]["z_mm"].as_f64().expect("a number");
    let sigma = stiff["base_sigma"]["z_mm"].as_f64().expect("a number");
    assert!((z - TRUE_Z_MM).abs() < 2.5 * sigma, "{z} +/- {sigma}");
    // and without a tool that weighs something, it is said
    let (_, bare, _) = axes("robots/abb_irb120.yaml", |_, _| ());
    assert_eq!(bare["base_sag"]["from"], "typical");
    assert_eq!(bare["findings"][0]["id"], "no-tool-mass");
    let (status, few, _) = axes(PROFILE, |_, rows| {
        let mut count = std::collections::BTreeMap::new();
        rows.retain(|row| {
            let seen: &mut usize = count.entry(row[0].clone()).or_default();
            *seen += 1;
            *seen <= 3
        });
    });
    assert_eq!(status, Some(0));
    assert!(few["base"].is_object() && few["base_sigma"].is_null());
    assert!(few["joints"][0]["noise_mm"].is_null());
}

#[test]
fn a_device_that_the_profile_knows_is_taken_into_account() {
    let (_, plain, _) = axes(PROFILE, |_, _| ());
    assert_eq!(plain["device_known"], false);
    // a tracker at (2100, -3400, 700) mm, rotated by 90 deg about the vertical: what it sees is
    // turned back
    let folder = scratch();
    let text = std::fs::read_to_string(repository(PROFILE)).expect("a profile");
    let placed = "calibration:\n  world_from_device:\n    \
                  pose: {x_mm: 2100, y_mm: -3400, z_mm: 700, rx_deg: 0, ry_deg: 0, rz_deg: 90}\n";
    let known = folder.path().join("known.yaml");
    std::fs::write(&known, text.replacen("calibration:\n", placed, 1)).expect("scratch");
    let (status, found, reported) = axes(known.to_str().expect("a name"), |header, rows| {
        let [x, y, z] = ["x_mm", "y_mm", "z_mm"].map(|name| column(header, name));
        for row in rows {
            let [wx, wy, wz] = [x, y, z].map(|i| row[i].parse::<f64>().expect("a number"));
            row[x] = (wy + 3400.0).to_string();
            row[y] = (2100.0 - wx).to_string();
            row[z] = (wz - 700.0).to_string();
        }
    });
    assert_eq!(status, Some(0), "{reported}");
    assert_eq!(found["device_known"], true);
    for frame in ["base", "tool"] {
        for key in ["x_mm", "y_mm", "z_mm"] {
            let [a, b] = [&found, &plain].map(|v| v[frame][key].as_f64().expect("a number"));
            assert!((a - b).abs() < 1e-6, "{frame} {key}: {a} and {b}");
        }
    }
}
