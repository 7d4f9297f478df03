//! Standard input and output: a program in and out, and a report that could not be printed is no
//! success.
#![cfg(unix)]

use crate::support::{files_below, repository, scratch};
use std::path::Path;
use std::process::{Command, Output};

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
const SAMPLE: &str = "programs/rapid/olp/in/Deburr.mod";

fn world() -> tempfile::TempDir {
    let folder = scratch();
    std::fs::copy(repository(PROFILE), folder.path().join("p.yaml")).expect("scratch");
    std::fs::copy(repository(SAMPLE), folder.path().join("in.mod")).expect("scratch");
    folder
}

/// Runs a command line of a shell; the program is `p`.
fn shell(folder: &Path, line: &str) -> Output {
    let line = format!("p() {{ \"$POSESHIFT\" \"$@\"; }}; set -o pipefail; {line}");
    let output = Command::new("bash")
        .args(["-c", &line])
        .current_dir(folder)
        .env("POSESHIFT", env!("CARGO_BIN_EXE_poseshift"))
        .output();
    output.expect("a shell")
}

fn reported(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn a_program_goes_from_standard_input_to_standard_output() {
    let folder = world();
    let written = shell(
        folder.path(),
        "p compensate in.mod --profile p.yaml -o out.mod",
    );
    assert_eq!(written.status.code(), Some(0), "{}", reported(&written));
    let wanted = std::fs::read(folder.path().join("out.mod")).expect("written");
    for line in [
        "p compensate --profile p.yaml -o - - < in.mod",
        "p compensate - --profile p.yaml -o /dev/stdout --language rapid < in.mod",
        "p compensate in.mod --profile p.yaml -o -",
        "cat in.mod | p compensate - --profile p.yaml -o - | cat",
        "p compensate - --profile p.yaml -o stream.mod < in.mod > /dev/null && cat stream.mod",
    ] {
        let output = shell(folder.path(), line);
        assert_eq!(
            output.status.code(),
            Some(0),
            "{line}: {}",
            reported(&output)
        );
        assert!(
            output.stdout == wanted,
            "{line}: {}",
            String::from_utf8_lossy(&output.stdout)
        );
    }
    // what is reported of it stands next to it
    let output = shell(
        folder.path(),
        "p compensate - --profile p.yaml -o - < in.mod",
    );
    assert!(
        reported(&output).contains("file(s) of ABB RAPID"),
        "{}",
        reported(&output)
    );
    // a check of it
    let output = shell(folder.path(), "p check - --profile p.yaml --json < in.mod");
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a report");
    assert_eq!(report["input"], "-", "{}", reported(&output));
}

#[test]
fn streams_that_cannot_be_meant_are_refused() {
    let folder = world();
    std::fs::create_dir(folder.path().join("out")).expect("scratch");
    let before = files_below(folder.path());
    for line in [
        "p compensate - in.mod --profile p.yaml -o out < in.mod",
        "p compensate - - --profile p.yaml -o out < in.mod",
        "p compensate - --profile p.yaml --in-place < in.mod",
        "p compensate - --profile p.yaml -o out < in.mod",
        "p compensate . --profile p.yaml -o -",
        "p compensate - --profile p.yaml -o - --json < in.mod",
        "p compensate - --profile p.yaml -o - --report - < in.mod",
        "p compensate - --profile p.yaml -o - < /dev/null",
        "echo 'no program' | p compensate - --profile p.yaml -o -",
        "p compensate in.mod --profile /dev/zero -o x.mod",
        "p compensate /dev/zero --profile p.yaml -o x.mod",
    ] {
        let output = shell(folder.path(), line);
        assert_eq!(
            output.status.code(),
            Some(2),
            "{line}: {}",
            reported(&output)
        );
        assert!(output.stdout.is_empty(), "{line}");
        assert!(
            reported(&output).contains("error"),
            "{line}: {}",
            reported(&output)
        );
        assert_eq!(files_below(folder.path()), before, "{line}");
    }
    // refused, and so no program: nothing else is taken for one
    let line = "p compensate in.mod --profile p.yaml -o - --max-shift 0.001mm,0.001deg";
    let output = shell(folder.path(), line);
    assert_eq!(output.status.code(), Some(1), "{}", reported(&output));
    assert!(output.stdout.is_empty() && reported(&output).contains("nothing is written"));
}

/// Asserts that a command does what it is asked where nothing is wrong with its streams.
fn works(line: &str, status: i32) {
    let folder = world();
    let output = shell(folder.path(), &format!("p {line} > /dev/null"));
    assert_eq!(
        output.status.code(),
        Some(status),
        "{line}: {}",
        reported(&output)
    );
}

/// A check whose answer is no.
const NO: &str = "check in.mod --profile p.yaml --max-path-error 0.001";

#[test]
fn a_reader_that_has_gone_makes_no_success() {
    let folder = world();
    // the reader has gone before anything is printed
    let gone = |line: &str| {
        let output = shell(
            folder.path(),
            &format!("exec 3> >(:); sleep 0.3; p {line} >&3; echo $? >&2"),
        );
        let reported = reported(&output);
        let status = reported
            .lines()
            .last()
            .and_then(|line| line.parse::<i32>().ok());
        (status.expect("a status"), reported)
    };
    let closed = |line: &str| shell(folder.path(), &format!("p {line} >&-"));
    let plain = shell(folder.path(), &format!("p {NO}"));
    assert_eq!(plain.status.code(), Some(1), "{}", reported(&plain));
    assert_eq!(gone(NO).0, 1);
    assert_eq!(gone(&format!("{NO} --json")).0, 1);
    let before = files_below(folder.path());
    for line in [
        "check in.mod --profile p.yaml",
        "compensate in.mod --profile p.yaml -o out.mod",
        "compensate in.mod --profile p.yaml -o out.mod --json --report r.html",
        "compensate in.mod --profile p.yaml -o -",
        "compensate in.mod --profile p.yaml -o - --report r.html",
        "profile show p.yaml",
        "profile new --robot abb_irb120 -o new.yaml",
        "profile new --robot abb_irb120",
        "profile schema",
        "robots",
        "schema",
        "man",
        "completions bash",
        "plan --profile p.yaml --count 6 --candidates 40 --level 0",
        "plan --profile p.yaml --count 6 --candidates 40 --level 0 -o q.csv",
        "--help",
        "--version",
    ] {
        works(line, 0);
        let (status, reported) = gone(line);
        assert_eq!(status, 2, "{line}: {reported}");
        assert_eq!(files_below(folder.path()), before, "{line}: {reported}");
        // nor one that was never there
        let output = closed(line);
        let reported = self::reported(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {reported}");
        assert!(
            reported.contains("standard output") || line.starts_with("--"),
            "{line}: {reported}"
        );
        assert_eq!(files_below(folder.path()), before, "{line}: {reported}");
    }
    assert_eq!(closed(NO).status.code(), Some(1));
    // at status 1, too, nothing is written that could not be known
    assert_eq!(gone(&format!("{NO} --report r.html --junit j.xml")).0, 1);
    assert_eq!(files_below(folder.path()), before);
}

#[test]
fn a_full_standard_output_or_error_is_status_2_and_nothing_is_written() {
    let folder = world();
    let before = files_below(folder.path());
    for line in [
        NO,
        "check in.mod --profile p.yaml --json",
        "check in.mod --profile p.yaml --report r.html --junit j.xml",
        "compensate in.mod --profile p.yaml -o out.mod",
        "compensate in.mod --profile p.yaml -o -",
        "compensate in.mod --profile p.yaml -o new/out.mod --json",
        "profile show p.yaml",
        "languages",
        "explain",
        "schema check",
        "man",
        "--help",
        "--version",
        "compensate --help",
    ] {
        works(line, i32::from(line == NO));
        let output = shell(folder.path(), &format!("p {line} > /dev/full"));
        assert_eq!(
            output.status.code(),
            Some(2),
            "{line}: {}",
            reported(&output)
        );
        assert_eq!(files_below(folder.path()), before, "{line}");
    }
    // nothing that stands there alone is lost either
    let output = shell(
        folder.path(),
        "p compensate in.mod --profile p.yaml -o - 2> /dev/full",
    );
    assert_eq!(output.status.code(), Some(2));
    let output = shell(
        folder.path(),
        "p compensate nothing.mod --profile p.yaml -o x 2> /dev/full",
    );
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(files_below(folder.path()), before);
    // and nobody has to look
    let output = shell(
        folder.path(),
        "p compensate in.mod --profile p.yaml -o out.mod > /dev/null",
    );
    assert_eq!(output.status.code(), Some(0), "{}", reported(&output));
}

#[test]
fn every_result_of_a_command_may_go_to_standard_output() {
    let folder = world();
    for (line, begins) in [
        ("p check in.mod --profile p.yaml --junit -", "<?xml"),
        ("p check in.mod --profile p.yaml --report /dev/stdout", "<!"),
        ("p profile new --robot abb_irb120 -o -", "#"),
        (
            "p plan --profile p.yaml --count 6 --candidates 40 --level 0 -o -",
            "id,",
        ),
    ] {
        let output = shell(folder.path(), line);
        let out = String::from_utf8_lossy(&output.stdout);
        assert!(
            out.starts_with(begins),
            "{line}: {out}{}",
            reported(&output)
        );
    }
    assert!(!folder.path().join("-").exists());
}

#[test]
fn what_is_printed_goes_neither_onto_what_is_read_nor_into_the_place_of_an_output() {
    let folder = world();
    let at = folder.path();
    std::fs::hard_link(at.join("in.mod"), at.join("hard.mod")).expect("scratch");
    std::fs::write(at.join("out.mod"), "").expect("scratch");
    std::fs::write(
        at.join("q.csv"),
        "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n0,0,0,0,30,0\n",
    )
    .expect("scratch");
    let content = || {
        let files = files_below(at).into_iter();
        let files = files.map(|name| (std::fs::read(at.join(&name)).expect("a file"), name));
        files.collect::<Vec<_>>()
    };
    let before = content();
    for line in [
        "p compensate - --profile p.yaml -o - < in.mod >> in.mod",
        "p compensate - --profile p.yaml -o - < in.mod >> hard.mod",
        "p compensate in.mod --profile p.yaml -o - >> in.mod",
        "p compensate in.mod --profile p.yaml -o - 1<> in.mod",
        "p compensate in.mod --profile p.yaml --in-place >> in.mod",
        "p compensate in.mod --profile p.yaml -o new.mod >> p.yaml",
        "p check in.mod --profile p.yaml --json >> p.yaml",
        "p check . --profile p.yaml --ignore out.mod >> hard.mod",
        "p profile show p.yaml >> p.yaml",
        "p fk --profile p.yaml --joints q.csv >> q.csv",
        // its errors
        "p check in.mod --profile p.yaml 2>> in.mod",
        "p check in.mod --profile p.yaml >> in.mod 2>&1",
        "p compensate in.mod --profile p.yaml -o new.mod --max-shift 0.001mm,0.001deg 2>> in.mod",
        // lost with the file that is replaced
        "p compensate in.mod --profile p.yaml -o out.mod > out.mod",
        "p compensate in.mod --profile p.yaml -o out.mod --json 2> out.mod",
        "p check in.mod --profile p.yaml --report out.mod > out.mod",
    ] {
        let output = shell(at, line);
        let said = reported(&output) + &String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(2), "{line}: {said}");
        let now = content();
        let names = |all: &[(Vec<u8>, std::path::PathBuf)]| {
            all.iter().map(|(_, name)| name.clone()).collect::<Vec<_>>()
        };
        assert_eq!(names(&now), names(&before), "{line}");
        for ((was, name), (is, _)) in before.iter().zip(&now) {
            let is_said = name == Path::new("out.mod") && line.contains("2> out.mod");
            assert!(is == was || is_said, "{line}: {}", name.display());
        }
        // where it can be heard it is said
        if !line.ends_with("2>&1") && !line.contains("2> out.mod") {
            assert!(said.contains("standard "), "{line}: {said}");
        }
        std::fs::write(at.join("out.mod"), "").expect("scratch");
    }
    // a file that nobody reads takes it
    let output = shell(at, "p check in.mod --profile p.yaml >> log.txt 2>> log.txt");
    assert_eq!(output.status.code(), Some(0), "{}", reported(&output));
}
