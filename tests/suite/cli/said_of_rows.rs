//! What is said of rows, effects and profiles that are wrong: the part that is, all of them, and why.

use crate::support::{poseshift, repository, scratch};
use std::path::Path;

const THESIS: &str = "robots/abb_irb120_thesis.yaml";

/// Status, standard output, standard error in one line.
fn run(folder: &Path, command: &str) -> (Option<i32>, String, String) {
    let output = poseshift()
        .current_dir(folder)
        .args(command.split(' '))
        .output()
        .expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let words = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    (
        output.status.code(),
        text(&output.stdout),
        words(text(&output.stderr)),
    )
}

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
        let (status, _, reported) = run(folder.path(), &command);
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

#[test]
fn a_length_that_no_urdf_has_is_refused_by_its_key() {
    let folder = scratch();
    with(folder.path(), "d_mm: 290", "d_mm: 2e6");
    let (status, _, reported) = run(folder.path(), "profile export --urdf p.yaml");
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
    let (status, out, reported) = run(folder.path(), "profile show p.yaml");
    assert_eq!(status, Some(0), "{reported}");
    assert!(out.contains("couplings\n  3 on 2  1\n"), "{out}");
    with(
        folder.path(),
        "coupling: []",
        "coupling:\n    - {joint: 3, on: 2, ratio: 1}\n    - {joint: 3, on: 2, ratio: 1}",
    );
    let (status, _, reported) = run(folder.path(), "profile show p.yaml");
    assert_eq!(status, Some(2), "{reported}");
    assert!(
        reported.contains("the coupling of joint 3 on joint 2 stands twice"),
        "{reported}"
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
    let (_, _, reported) = run(
        folder.path(),
        "validate --profile p.yaml --measurements m.csv",
    );
    assert!(reported.contains("they count up to 6 times"), "{reported}");
}

#[test]
fn an_angle_that_is_too_large_is_said_as_it_was_given() {
    let folder = scratch();
    std::fs::copy(repository(THESIS), folder.path().join("p.yaml")).expect("scratch");
    let (status, _, reported) = run(
        folder.path(),
        "plan --profile p.yaml --count 60 --margin-deg 500",
    );
    assert_eq!(status, Some(2), "{reported}");
    assert!(reported.contains("--margin-deg is 500;"), "{reported}");
}
