//! The sample programs.

use super::*;
use std::path::Path;

fn sample(case: &str) -> Vec<Source> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("programs/rapid")
        .join(case)
        .join("in");
    let mut files: Vec<_> = std::fs::read_dir(&folder)
        .expect("a sample")
        .map(|entry| entry.expect("a file").path())
        .collect();
    files.sort();
    files
        .iter()
        .map(|path| {
            Source::new(
                path.display().to_string(),
                std::fs::read(path).expect("a file"),
            )
        })
        .collect()
}

#[test]
fn samples_have_targets_and_nothing_to_complain_about() {
    for (case, targets, moves) in [
        ("backup", 12, 27),
        ("olp", 29, 29),
        ("cam", 5000, 5000),
        ("modules", 9, 12),
    ] {
        let program = motion::read(&Rapid, &sample(case), &Settings::default()).expect("a program");
        assert_eq!(
            (program.targets.len(), program.moves.len()),
            (targets, moves),
            "{case}"
        );
        assert_eq!(program.findings, [], "{case}");
        assert!(
            program
                .tools
                .iter()
                .all(|tool| tool.flange_from_tool.is_some())
        );
        assert!(
            program
                .frames
                .iter()
                .all(|frame| frame.world_from_frame.is_some())
        );
    }
}

#[test]
fn a_module_without_targets_is_read_with_the_others() {
    let sources = sample("modules");
    let logic = sources
        .iter()
        .position(|source| source.name.ends_with("CellLogic.mod"));
    let program = motion::read(&Rapid, &sources, &Settings::default()).expect("a program");
    let logic = short(logic.expect("the module without targets"));
    assert!(program.targets.iter().all(|target| target.file != logic));
}
