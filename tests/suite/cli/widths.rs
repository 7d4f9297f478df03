//! Text for people fits the terminal.

use super::reports::{COMMANDS, given};
use crate::support::scratch;
use std::path::Path;

/// Commands besides those whose reports are looked at: long findings, tables with reasons,
/// refusals.
const MORE: &[&str] = &[
    "calibrate --profile @robots/abb_irb120_thesis.yaml --measurements measured.csv -v",
    "validate --profile calibrated.yaml --measurements measured.csv -v",
    "plan --profile @robots/abb_irb120_thesis.yaml --count 40 --candidates 200 --starts 1 -o \
     others.csv",
    "compensate @programs/krl/cam/in/pocket.src --profile @programs/krl/profile.yaml -o pocket.src \
     -v",
    "check @programs/rapid/olp/in/Deburr.mod --profile @robots/abb_irb120_thesis.yaml --cell \
     @tests/browser/cell.yaml -v",
    "register @docs/measuring/nominal.csv @docs/measuring/touched.csv --robust --at 1000,0,0",
    "register @docs/measuring/drawing.csv @docs/measuring/scan.csv --icp -v",
    "handeye @docs/measuring/robot.csv @docs/measuring/board.csv --setup eye-in-hand -v",
    "hexapod --taught @docs/measuring/taught.csv --base-mm 300.01,299.98,300.02 -o device.yaml",
    "hexapod --reach --base-mm 300,300,300 --tool-mm 150,150,150 --frame device.yaml --profile \
     @robots/fanuc_lrmate200ic.yaml",
    "profile show calibrated.yaml",
    "profile diff calibrated.yaml @robots/abb_irb120_thesis.yaml",
    "ik --profile calibrated.yaml --poses @docs/measuring/robot.csv",
    "plan --profile @robots/abb_irb120_thesis.yaml --count 2 -o none.csv",
];

/// These print data, which are as long as they are.
const DATA: &[&str] = &[
    "fk ",
    "ik ",
    "profile new ",
    "hexapod --taught ",
    "completions ",
    "man",
];

/// The first line that is too wide, not counting names of files.
fn too_wide(text: &str, width: usize) -> Option<&str> {
    let letters = |line: &str| {
        let named = line.split_whitespace().filter(|word| word.contains('/'));
        line.chars().count() - named.map(|word| word.chars().count()).sum::<usize>()
    };
    // the parser of the command line breaks no usage
    let is_usage = |line: &str| line.trim_start().starts_with("Usage:");
    text.lines()
        .find(|line| letters(line) > width && !is_usage(line))
}

fn reported(line: &str, folder: &Path, columns: Option<usize>) -> (String, String) {
    let mut command = given(line, folder);
    command.envs(columns.map(|columns| ("COLUMNS", columns.to_string())));
    let output = command.output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    (text(output.stdout), text(output.stderr))
}

#[test]
fn no_line_is_wider_than_the_terminal() {
    let folder = scratch();
    let commands = COMMANDS
        .iter()
        .map(|(line, ..)| *line)
        .chain(MORE.iter().copied());
    let mut seen = 0;
    for line in commands {
        for width in [80, 60] {
            let (out, err) = reported(line, folder.path(), Some(width));
            let out = if DATA.iter().any(|data| line.starts_with(data)) {
                String::new()
            } else {
                out
            };
            for text in [&out, &err] {
                assert_eq!(
                    too_wide(text, width),
                    None,
                    "{line} in {width} columns:\n{text}"
                );
                seen += text.lines().count();
            }
        }
    }
    assert!(seen > 800, "{seen} lines");
}

#[test]
fn help_fits_the_terminal() {
    let folder = scratch();
    let (commands, _) = reported("--help", folder.path(), Some(80));
    let names = commands
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .take_while(|line| !line.is_empty())
        .filter_map(|line| line.strip_prefix("  ")?.split(' ').next())
        .filter(|name| !name.is_empty());
    let mut count = 0;
    for name in names {
        for width in [80, 60] {
            let (help, _) = reported(&format!("{name} --help"), folder.path(), Some(width));
            assert_eq!(
                too_wide(&help, width),
                None,
                "{name} in {width} columns:\n{help}"
            );
        }
        count += 1;
    }
    assert!(count > 15, "{count} commands");
}

#[test]
fn where_nobody_looks_text_is_eighty_columns_without_colour_and_a_finding_is_one_line() {
    let folder = scratch();
    let show = "profile show @robots/abb_irb120_thesis.yaml";
    assert_eq!(
        reported(show, folder.path(), None),
        reported(show, folder.path(), Some(80))
    );
    let finds = "compensate @programs/krl/cam/in/pocket.src --profile @programs/krl/profile.yaml \
        -o out.src";
    let (out, _) = reported(finds, folder.path(), None);
    let finding = out
        .lines()
        .find(|line| line.contains("warning[displaced-target]"))
        .expect("a finding");
    assert!(finding.ends_with("off its own wanted pose"), "{finding}");
    assert!(!out.contains('\x1b'), "{out}");
    let mut forced = given(finds, folder.path());
    let coloured = forced
        .env("CLICOLOR_FORCE", "1")
        .output()
        .expect("the program starts");
    assert!(String::from_utf8_lossy(&coloured.stdout).contains("\x1b[1;33mwarning"));
}
