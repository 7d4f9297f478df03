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
