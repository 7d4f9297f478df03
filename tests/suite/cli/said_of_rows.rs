//! What is said of rows, effects and profiles that are wrong: the part that is, all of them, and why.

use crate::support::{repository, run_in, scratch};
use serde_json::Value;
use std::path::Path;

const THESIS: &str = "robots/abb_irb120_thesis.yaml";

/// A folder with the thesis's robot, and measurements of 60 of its postures, with these options.
fn measured(options: &str) -> tempfile::TempDir {
    let folder = scratch();
    std::fs::copy(repository(THESIS), folder.path().join("p.yaml")).expect("scratch");
    for command in [
        "plan --profile p.yaml --count 60 -o j.csv".to_owned(),
        format!(
            "simulate --profile p.yaml --joints j.csv --noise-mm 0.02 --seed 3{options} -o m.csv"
        ),
    ] {
        let (status, _, reported) = run_in(folder.path(), &command);
        assert_eq!(status, Some(0), "{command}: {reported}");
    }
    folder
}

/// The profile with another text in it.
fn with(folder: &Path, from: &str, to: &str) {
    let text = std::fs::read_to_string(repository(THESIS)).expect("the profile");
    assert!(text.contains(from), "{from}");
    std::fs::write(folder.join("p.yaml"), text.replacen(from, to, 1)).expect("scratch");
}

/// Writes the profile without springs, and with gravity upside down.
fn upside_down(folder: &Path) {
    let text = std::fs::read_to_string(repository(THESIS)).expect("the profile");
    let springs = text
        .lines()
        .filter(|line| !line.contains("effect: joint_compliance"));
    let text = springs
        .map(|line| line.to_owned() + "\n")
        .collect::<String>();
    let text = text.replacen(
        "gravity_m_s2: [0, 0, -9.81]",
        "gravity_m_s2: [0, 0, 9.81]",
        1,
    );
    std::fs::write(folder.join("p.yaml"), text).expect("scratch");
}

fn json(out: &str) -> Value {
    serde_json::from_str(out).expect("JSON")
}

#[test]
fn a_wrong_orientation_is_said_in_degrees() {
    let folder = measured(" --kind pose --noise-deg 0.005");
    let text = std::fs::read_to_string(folder.path().join("m.csv")).expect("rows");
    let at = text.lines().next().expect("a header").split(',');
    let at = at
        .clone()
        .position(|name| name == "qw")
        .expect("a quaternion");
    let rows = text.lines().enumerate().map(|(number, line)| {
        let mut cells: Vec<&str> = line.split(',').collect();
        if number == 8 {
            cells[at..at + 4].rotate_left(1);
        }
        cells.join(",") + "\n"
    });
    std::fs::write(folder.path().join("m.csv"), rows.collect::<String>()).expect("scratch");
    for command in ["calibrate", "diagnose"] {
        let command = format!("{command} --profile p.yaml --measurements m.csv");
        let (_, out, reported) = run_in(folder.path(), &command);
        if command.starts_with("calibrate") {
            assert!(
                reported.contains("the worst misses by ") && reported.contains("°, "),
                "{reported}"
            );
        } else {
            let line = out.lines().find(|line| line.contains("line 9: "));
            assert!(
                line.is_some_and(|line| line.contains('°') && !line.contains("mm")),
                "{out}"
            );
        }
        let (_, out, _) = run_in(folder.path(), &(command + " --json"));
        let report = json(&out);
        assert_eq!(report["worst_row"]["line"], 9);
        for row in [&report["worst_row"], &report["outliers"][0]] {
            assert!(
                row["residual_deg"].as_f64().is_some_and(|deg| deg > 20.0),
                "{row}"
            );
            assert!(
                row["residual_mm"].as_f64().is_some_and(|mm| mm < 1.0),
                "{row}"
            );
        }
        if let Some(reason) = report["outliers"][0]["reason"].as_str() {
            assert!(reason.contains('°') && !reason.contains("mm"), "{reason}");
        }
    }
}

#[test]
fn an_accepted_effect_that_is_not_in_the_model_is_said_with_the_reason() {
    let folder = measured("");
    let said = |effect: &str| {
        let command = format!(
            "diagnose --profile p.yaml --measurements m.csv --json --quick --accept {effect}"
        );
        let (_, out, _) = run_in(folder.path(), &command);
        let report = json(&out);
        let findings = report["findings"].as_array().expect("a list").clone();
        let own = findings
            .into_iter()
            .find(|f| f["id"] == "accepted-not-in-model");
        own.map(|f| f["message"].as_str().expect("a text").to_owned())
    };
    let of_first = said("joint_compliance:1").expect("a finding");
    assert!(
        of_first.contains("joint_compliance:1") && of_first.contains("no load acts"),
        "{of_first}"
    );
    // with gravity upside down springs would have to push
    upside_down(folder.path());
    let of_spring = said("joint_compliance:3").expect("a finding");
    assert!(
        of_spring.contains("joint_compliance:3") && of_spring.contains("possible, 0,"),
        "{of_spring}"
    );
    assert_eq!(said("base_frame"), None);
    // people see it, too
    let (_, _, reported) = run_in(
        folder.path(),
        "diagnose --profile p.yaml --measurements m.csv --accept joint_compliance:1",
    );
    assert!(reported.contains("no load acts"), "{reported}");
}

#[test]
fn a_length_that_no_urdf_has_is_refused_by_its_key() {
    let folder = scratch();
    with(folder.path(), "d_mm: 290", "d_mm: 2e6");
    let (status, _, reported) = run_in(folder.path(), "profile export --urdf p.yaml");
    assert_eq!(status, Some(2), "{reported}");
    for word in ["d_mm of joint 1 is 2000000", "1000000 mm"] {
        assert!(reported.contains(word), "{reported}");
    }
}

#[test]
fn a_coupling_is_given_once_and_shown() {
    let folder = scratch();
    with(
        folder.path(),
        "coupling: []",
        "coupling: [{joint: 3, on: 2, ratio: 1}]",
    );
    let (status, out, reported) = run_in(folder.path(), "profile show p.yaml");
    assert_eq!(status, Some(0), "{reported}");
    assert!(out.contains("couplings\n  3 on 2  1\n"), "{out}");
    with(
        folder.path(),
        "coupling: []",
        "coupling:\n    - {joint: 3, on: 2, ratio: 1}\n    - {joint: 3, on: 2, ratio: 1}",
    );
    let (status, _, reported) = run_in(folder.path(), "profile show p.yaml");
    assert_eq!(status, Some(2), "{reported}");
    assert!(
        reported.contains("the coupling of joint 3 on joint 2 stands twice"),
        "{reported}"
    );
}

#[test]
fn gravity_upside_down_makes_all_springs_negative_and_is_said() {
    let folder = measured("");
    upside_down(folder.path());
    let (_, out, _) = run_in(
        folder.path(),
        "calibrate --profile p.yaml --measurements m.csv --json",
    );
    let report = json(&out);
    let findings = report["findings"].as_array().expect("a list");
    let own = findings.iter().find(|f| f["id"] == "negative-compliance");
    let own = own.unwrap_or_else(|| panic!("{findings:#?}"));
    let message = own["message"].as_str().expect("a text");
    for joint in 2..=6 {
        assert!(
            message.contains(&format!("joint_compliance joint {joint} ")),
            "{message}"
        );
    }
    assert!(
        own["hint"]
            .as_str()
            .is_some_and(|hint| hint.contains("gravity_m_s2")),
        "{own}"
    );
}

#[test]
fn rows_that_stand_six_times_count_six_times() {
    let folder = measured("");
    let text = std::fs::read_to_string(folder.path().join("m.csv")).expect("rows");
    let (header, rows) = text.split_once('\n').expect("a header");
    std::fs::write(
        folder.path().join("m.csv"),
        format!("{header}\n{}", rows.repeat(6)),
    )
    .expect("scratch");
    let (_, _, reported) = run_in(
        folder.path(),
        "validate --profile p.yaml --measurements m.csv",
    );
    assert!(reported.contains("they count up to 6 times"), "{reported}");
}

#[test]
fn an_angle_that_is_too_large_is_said_as_it_was_given() {
    let folder = scratch();
    std::fs::copy(repository(THESIS), folder.path().join("p.yaml")).expect("scratch");
    let (status, _, reported) = run_in(
        folder.path(),
        "plan --profile p.yaml --count 60 --margin-deg 500",
    );
    assert_eq!(status, Some(2), "{reported}");
    assert!(reported.contains("--margin-deg is 500;"), "{reported}");
}

#[test]
fn what_a_person_decided_is_done_whatever_the_verdict_and_figures_differ() {
    let folder = measured("");
    let command =
        "diagnose --profile p.yaml --measurements m.csv --accept joint_compliance:3 -o o.yaml";
    let (status, out, reported) = run_in(folder.path(), command);
    assert_eq!(status, Some(0), "{reported}");
    assert!(folder.path().join("o.yaml").exists(), "{out}");
    let out: String = out.split_whitespace().collect::<Vec<_>>().join(" ");
    if let Some((_, rest)) = out.split_once("predicted worse with what was found: ") {
        let mut words = rest.split(' ');
        assert_ne!(words.next(), words.nth(1), "{out}");
    }
}
