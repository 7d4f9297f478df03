//! Every command of the documents runs, in their order, and prints what stands below it.
//!
//! Blocks `sh` and `console` hold commands; where they begin with `$ `, the other lines are printed
//! by the command above them. A command whose files have names in capitals (`ROBOT.yaml`,
//! `FOLDER/fit.csv`) is a pattern: its options are checked, no more.

use super::documents;
use crate::support::{poseshift, repository, scratch, text};
use std::path::Path;
use std::process::Command;

/// A command, and the lines that the document says it prints.
struct Step {
    command: String,
    shown: Vec<String>,
}

/// The commands of a document in their order: of its blocks, and of lines set in as code.
fn steps(page: &str) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut block: Option<(bool, bool)> = None;
    let mut lines = page.lines().peekable();
    let step = |command: &str| Step {
        command: command.to_owned(),
        shown: Vec::new(),
    };
    while let Some(line) = lines.next() {
        if let Some(kind) = line.strip_prefix("```") {
            let prompted = lines.peek().is_some_and(|first| first.starts_with("$ "));
            let is_shell = matches!(kind, "sh" | "console");
            block = block.is_none().then_some((is_shell, prompted));
            continue;
        }
        match block {
            None => {
                if let Some(command) = line.strip_prefix("    poseshift ") {
                    steps.push(step(&format!("poseshift {command}")));
                }
            }
            Some((false, _)) => {}
            Some((true, false)) => steps.push(step(line)),
            Some((true, true)) => {
                if let Some(command) = line.strip_prefix("$ ") {
                    steps.push(step(command));
                } else {
                    let last = steps.last_mut().expect("a block begins with its command");
                    last.shown.push(line.trim_end().to_owned());
                }
            }
        }
    }
    steps
}

/// Whether a word stands for a file of the reader's own.
fn is_pattern(word: &str) -> bool {
    let stem = word.split(['.', '/']).next().unwrap_or("");
    stem.len() > 1 && stem.chars().all(|c| c.is_ascii_uppercase() || c == '_')
}

/// The command as a shell runs it here; `None` for the build's own commands.
fn runnable(command: &str) -> Option<String> {
    let command = command.replacen("cargo run --release --", "poseshift", 1);
    let command = command.strip_prefix("time ").unwrap_or(&command);
    let builds = ["cargo ", "cd web", "tests/browser/"];
    let is_built = builds.iter().any(|begin| command.starts_with(begin));
    (!is_built).then(|| command.to_owned())
}

/// Exit status and everything printed, standard output first.
fn run(folder: &Path, command: &str) -> (Option<i32>, String) {
    let program = poseshift();
    let given = Path::new(program.get_program()).parent().expect("a folder");
    let path = std::env::var("PATH").expect("a search path");
    let output = Command::new("sh")
        .args(["-c", command])
        .env("PATH", format!("{}:{path}", given.display()))
        .current_dir(folder)
        .output()
        .expect("a shell");
    let printed = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    (output.status.code(), printed.into_owned())
}

/// Runs a document's commands in a folder that looks like the repository; how many ran, and how
/// many printed lines were found.
fn run_all(document: &str, folder: &Path) -> (usize, usize) {
    for part in ["docs", "programs", "robots", "tests"] {
        std::os::unix::fs::symlink(repository(part), folder.join(part)).expect("scratch");
    }
    // the page on measuring stands among its files
    if document == "docs/measuring.md" {
        for entry in std::fs::read_dir(repository("docs/measuring")).expect("its data") {
            let entry = entry.expect("a file");
            std::fs::copy(entry.path(), folder.join(entry.file_name())).expect("scratch");
        }
    }
    let (mut ran, mut found) = (0, 0);
    for step in steps(&text(document)) {
        let Some(command) = runnable(&step.command) else {
            continue;
        };
        let (status, printed) = run(folder, &command);
        if command.split_whitespace().any(is_pattern) {
            // all that is wrong with it is that the file is not there
            let is_missing = status == Some(2) && printed.contains("o such file");
            assert!(is_missing, "{document}: {command}: {status:?} {printed}");
            continue;
        }
        // the difference between two profiles is an answer like that of `diff`
        let expected = i32::from(command.starts_with("poseshift profile diff"));
        assert_eq!(status, Some(expected), "{document}: {command}: {printed}");
        let mut lines = printed.lines().map(str::trim_end);
        for shown in &step.shown {
            let is_there = lines.any(|line| line == shown);
            assert!(
                is_there,
                "{document}: {command}: no line `{shown}` in its place in\n{printed}"
            );
            found += 1;
        }
        ran += 1;
    }
    (ran, found)
}

#[test]
fn commands_of_the_documents_run_and_print_what_stands_there() {
    let (mut ran, mut found) = (0, 0);
    for document in documents() {
        let document = document.to_str().expect("a plain name");
        let scratch = scratch();
        let (commands, lines) = run_all(document, scratch.path());
        match document {
            "README.md" => {
                assert!(commands >= 20, "{commands}");
                assert!(scratch.path().join("Deburr_compensated.mod").is_file());
            }
            "docs/calibration.md" => assert!(scratch.path().join("weld.src").is_file()),
            "docs/measuring.md" => assert!(commands >= 11 && lines >= 15, "{commands} {lines}"),
            "docs/diagnosis.md" => assert!(commands >= 5 && lines >= 15, "{commands} {lines}"),
            _ => {}
        }
        ran += commands;
        found += lines;
    }
    assert!(ran >= 45 && found >= 35, "{ran} {found}");
}
