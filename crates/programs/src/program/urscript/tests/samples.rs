//! The sample programs.

use super::*;
use std::path::Path;

fn sample(case: &str) -> Vec<Source> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("programs/urscript")
        .join(case)
        .join("in");
    let mut files: Vec<_> = std::fs::read_dir(&folder)
        .expect("a sample")
        .map(|entry| entry.expect("a file").path())
        .collect();
    files.sort();
    let read = |path: &std::path::PathBuf| {
        let bytes = std::fs::read(path).expect("a file");
        Source::new(path.display().to_string(), bytes)
    };
    files.iter().map(read).collect()
}

#[test]
fn samples_have_targets_and_nothing_to_complain_about() {
    for (case, targets, moves) in [("backup", 14, 16), ("olp", 21, 22), ("cam", 483, 483)] {
        let sources = sample(case);
        assert!(sources.iter().all(|source| UrScript.recognises(source)));
        let program = read_sources(&sources).expect("a program");
        assert_eq!(
            (program.targets.len(), program.moves.len()),
            (targets, moves),
            "{case}"
        );
        assert_eq!(program.findings, [], "{case}");
        let known =
            |tool: &crate::program::Tool| tool.flange_from_tool.is_some() && tool.load.is_some();
        assert!(program.tools.iter().all(known), "{case}");
        assert!(
            program
                .frames
                .iter()
                .all(|frame| frame.world_from_frame.is_some())
        );
    }
}

#[test]
fn waypoints_of_the_sample_keep_their_seeds() {
    let program = read_sources(&sample("backup")).expect("a program");
    let seeded: Vec<_> = program
        .moves
        .iter()
        .filter(|m| program.near(m).is_some())
        .collect();
    assert_eq!(seeded.len(), 3);
    // no target lies on the numbers of a `_q`
    let named = |target: &crate::program::Target| target.name.clone();
    assert!(
        program
            .targets
            .iter()
            .filter_map(named)
            .all(|name| name.ends_with("_p"))
    );
}
