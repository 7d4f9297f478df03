//! What fuzzing found once: read again without a panic, a hang, or a half-written file.

use crate::support::{files_below, poseshift, repository, scratch};
use std::time::{Duration, Instant};

#[test]
fn programs_that_once_failed_end_with_an_answer() {
    let folder = repository("tests/data/fuzz");
    let found = files_below(&folder);
    let mut run = 0;
    for file in found.iter().filter(|file| file.components().count() == 2) {
        let language = file
            .components()
            .next()
            .expect("a language")
            .as_os_str()
            .to_owned();
        let scratch = scratch();
        let began = Instant::now();
        let output = poseshift()
            .arg("compensate")
            .arg(folder.join(file))
            .args([
                "--tool",
                "0,0,0,0,0,0",
                "--frame",
                "300,0,400,0,0,0",
                "--joint-targets",
                "correct",
            ])
            .arg("--profile")
            .arg(repository("robots/abb_irb120_thesis.yaml"))
            .arg("--language")
            .arg(language)
            .arg("-o")
            .arg(scratch.path().join("out"))
            .timeout(Duration::from_mins(1))
            .output()
            .expect("the program starts");
        let reported = String::from_utf8_lossy(&output.stderr);
        let status = output.status.code();
        assert!(
            matches!(status, Some(0..=2)),
            "{}: {reported}",
            file.display()
        );
        assert!(
            !reported.contains("internal error"),
            "{}: {reported}",
            file.display()
        );
        assert_eq!(
            status == Some(0),
            scratch.path().join("out").exists(),
            "{}",
            file.display()
        );
        assert!(began.elapsed() < Duration::from_mins(1));
        run += 1;
    }
    assert_eq!(
        run,
        found
            .iter()
            .filter(|file| file.components().count() == 2)
            .count()
    );
}
