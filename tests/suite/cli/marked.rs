//! A compensated program is known in every language, by each line of its marker alone.

use super::limits::run_in;
use crate::golden::cases;
use crate::support::{files_below, poseshift, repository, scratch};
use std::collections::BTreeSet;
use std::path::Path;

/// Compensates a folder as its case says; status and what is reported.
fn compensate(folder: &Path, case: &crate::golden::Case, top: &Path) -> (Option<i32>, String) {
    let out = scratch();
    let output = poseshift()
        .current_dir(top)
        .args(["compensate"])
        .arg(folder)
        .args(["--profile", &case.profile, "-o"])
        .arg(out.path().join("out"))
        .args(&case.options)
        .output()
        .expect("the program starts");
    let reported = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code(), reported)
}

fn copy(from: &Path, to: &Path) {
    for name in files_below(from) {
        let place = to.join(&name);
        std::fs::create_dir_all(place.parent().expect("a folder")).expect("scratch");
        std::fs::copy(from.join(name), place).expect("scratch");
    }
}

/// Some controllers end lines with a carriage return alone.
fn line_end(text: &[u8]) -> u8 {
    if text.contains(&b'\n') { b'\n' } else { b'\r' }
}

/// The lines of one text that are not in another.
fn new_lines<'a>(before: &[u8], after: &'a [u8]) -> Vec<&'a [u8]> {
    let end = line_end(after);
    let old: BTreeSet<&[u8]> = before.split(|b| *b == end).collect();
    let lines = after.split(|b| *b == end);
    lines.filter(|line| !old.contains(line)).collect()
}

#[test]
fn each_line_of_a_marker_alone_is_enough_in_every_language() {
    let mut languages = BTreeSet::new();
    let mut lines_seen = 0;
    for (folder, case) in cases() {
        let top = folder.clone();
        let language = folder
            .parent()
            .and_then(Path::file_name)
            .expect("a language")
            .to_owned();
        if case.status != 0 || !languages.insert(language.clone()) {
            continue;
        }
        // the marker, by its difference from a file that says the same
        let (plain, marked) = (folder.join("in"), folder.join("out"));
        let name = files_below(&marked)
            .into_iter()
            .find(|name| {
                let text = std::fs::read(marked.join(name)).expect("a golden file");
                let text = String::from_utf8_lossy(&text).into_owned();
                text.contains("poseshift compensated")
            })
            .expect("a file with a marker");
        let before = std::fs::read(plain.join(&name)).expect("the original");
        let after = std::fs::read(marked.join(&name)).expect("the golden file");
        let end = line_end(&after);
        let is_marker = |line: &&[u8]| {
            let text = String::from_utf8_lossy(line).to_ascii_lowercase();
            let hex = text
                .trim()
                .trim_start_matches(|c: char| !c.is_ascii_alphanumeric());
            let is_hash = hex.len() >= 16 && hex.bytes().all(|b| b.is_ascii_hexdigit());
            text.contains("poseshift")
                || text.contains("version")
                || is_hash
                || (text.contains("profile") || text.contains("source"))
        };
        let marker: Vec<&[u8]> = new_lines(&before, &after)
            .into_iter()
            .filter(is_marker)
            .collect();
        assert!(
            marker.len() >= 3,
            "{}: {} lines",
            name.display(),
            marker.len()
        );
        for line in &marker {
            let text = String::from_utf8_lossy(line.trim_ascii_end()).into_owned();
            let forms = [
                text.clone(),
                text.to_ascii_uppercase(),
                text.to_ascii_lowercase(),
                text.replace(' ', "   "),
                format!("{text}  "),
            ];
            for form in forms {
                let place = scratch();
                copy(&plain, place.path());
                let all_but: Vec<&[u8]> = after
                    .split(|b| *b == end)
                    .filter(|l| !marker.contains(l))
                    .collect();
                // where the marker stood
                let at = after
                    .split(|b| *b == end)
                    .position(|l| marker.contains(&l))
                    .expect("a marker");
                let mut lines = all_but;
                lines.insert(at, form.as_bytes());
                std::fs::write(place.path().join(&name), lines.join(&end)).expect("scratch");
                let (status, reported) = compensate(place.path(), &case, &top);
                assert_eq!(status, Some(2), "{language:?}: {form:?}: {reported}");
                assert!(
                    reported.contains("already compensated"),
                    "{language:?}: {form:?}: {reported}"
                );
                lines_seen += 1;
            }
        }
        // without all of them nothing is known, and nothing else is refused
        let place = scratch();
        copy(&plain, place.path());
        let (_, reported) = compensate(place.path(), &case, &top);
        assert!(!reported.contains("already compensated"), "{reported}");
    }
    let all = std::fs::read_dir(repository("programs")).expect("samples");
    let all = all.filter(|entry| entry.as_ref().expect("an entry").path().is_dir());
    assert_eq!(languages.len(), all.count(), "{languages:?}");
    assert!(lines_seen > 60, "{lines_seen}");
}

#[test]
fn a_marker_without_its_hashes_is_compared_with_nothing() {
    for (language, program) in [
        ("urscript", "olp/in/Deburr_bracket.script"),
        ("kawasaki", "olp/in/TRIM.pg"),
        ("rapid", "olp/in/Deburr.mod"),
    ] {
        let folder = scratch();
        let name = program.rsplit('/').next().expect("a name");
        let original = repository(&format!("programs/{language}/{program}"));
        let profile = match language {
            "rapid" => repository("robots/abb_irb120_thesis.yaml"),
            _ => repository(&format!("programs/{language}/profile.yaml")),
        };
        let [original, profile] = [&original, &profile].map(|path| path.to_str().expect("plain"));
        let made = ["compensate", original, "--profile", profile, "-o", name];
        let (status, said) = run_in(folder.path(), &made);
        assert_eq!(status, 0, "{language}: {said}");
        let fake = std::fs::read_to_string(folder.path().join(name)).expect("written");
        let check = ["check", name, "--nominal", original, "--profile", profile];
        let whole = run_in(folder.path(), &check);
        for lost in ["profile ", "source "] {
            let is_hash = |line: &&str| {
                let mut words = line.split_once(lost).map_or("", |(_, rest)| rest).chars();
                words
                    .by_ref()
                    .take(64)
                    .filter(char::is_ascii_hexdigit)
                    .count()
                    == 64
            };
            let kept: Vec<&str> = fake.lines().filter(|line| !is_hash(line)).collect();
            assert!(kept.len() < fake.lines().count(), "{language}: {lost}");
            std::fs::write(folder.path().join(name), kept.join("\n") + "\n").expect("scratch");
            let (status, said) = run_in(folder.path(), &check);
            assert!(
                status == 2 && said.contains("marker") && said.contains("--force"),
                "{language}, {lost}: {said}"
            );
            let (status, _) = run_in(folder.path(), &[&check[..], &["--force"]].concat());
            assert_eq!(status, whole.0, "{language}, {lost}");
        }
    }
}
