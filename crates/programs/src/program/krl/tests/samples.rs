//! The sample programs.

use super::*;
use std::path::{Path, PathBuf};

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("a file").path();
            if path.is_dir() {
                open.push(path);
            } else {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn sample(case: &str) -> Vec<Source> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("programs/krl")
        .join(case)
        .join("in");
    let read = |path: &PathBuf| {
        let bytes = std::fs::read(path).expect("a file");
        Source::new(path.display().to_string(), bytes)
    };
    files(&folder).iter().map(read).collect()
}

#[test]
fn samples_have_targets_and_nothing_to_complain_about() {
    for (case, targets, moves) in [("backup", 14, 20), ("olp", 27, 29), ("cam", 421, 422)] {
        let sources = sample(case);
        assert!(
            sources.iter().all(|source| Krl.recognises(source)),
            "{case}"
        );
        let program = crate::motion::read(&Krl, &sources, &Settings::default()).expect("a program");
        let counts = (program.targets.len(), program.moves.len());
        assert_eq!(counts, (targets, moves), "{case}");
        // one move goes back to where an interrupt was
        let notes: &[&str] = if case == "olp" {
            &["run-time-position"]
        } else {
            &[]
        };
        assert_eq!(ids(&program), notes, "{case}");
        for used in &program.moves {
            if program.goes_to_pose(used) {
                assert!(program.tools[used.tool].flange_from_tool.is_some());
                assert!(program.frames[used.frame].world_from_frame.is_some());
            }
        }
    }
}

#[test]
fn the_sample_of_refusals_has_each_of_them() {
    let program = crate::motion::read(&Krl, &sample("refused"), &Settings::default());
    let program = program.expect("a program");
    let errors: std::collections::BTreeSet<_> = program
        .findings
        .iter()
        .filter(|finding| finding.severity == Severity::Error)
        .map(|finding| finding.id)
        .collect();
    let expected = [
        "absolutely-accurate",
        "frame-chosen-at-run-time",
        "held-work-piece",
        "partial-target",
        "relative-move",
        "target-has-expressions",
        "target-not-in-files",
        "target-passed-to-routine",
    ];
    assert_eq!(errors.into_iter().collect::<Vec<_>>(), expected);
}
