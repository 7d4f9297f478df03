//! The table of findings: one for all, and the same as what modules say of themselves.

use crate::support::{files_below, repository, run};
use poseshift::finding::{Severity, TABLE, kind};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

const LANGUAGES: [&str; 6] = ["csv", "fanuc", "inform", "krl", "rapid", "urscript"];

/// Every text of the source that is in quotes, the table itself left out.
fn quoted() -> BTreeSet<String> {
    let source = repository("src");
    let mut words = BTreeSet::new();
    for file in files_below(&source) {
        if file.extension().is_none_or(|e| e != "rs") || file.starts_with("finding") {
            continue;
        }
        let text = std::fs::read_to_string(source.join(file)).expect("source");
        words.extend(text.split('"').map(str::to_owned));
    }
    words
}

#[test]
fn the_table_is_sorted_has_each_id_once_and_none_that_nothing_finds() {
    let ids: Vec<&str> = TABLE.iter().map(|kind| kind.id).collect();
    let sorted: Vec<&str> = ids
        .iter()
        .copied()
        .collect::<BTreeSet<_>>()
        .into_iter()
        .collect();
    assert_eq!(ids, sorted);
    let words = quoted();
    for kind in TABLE {
        assert!(words.contains(kind.id), "nothing finds {}", kind.id);
        assert!(!kind.meaning.is_empty() && !kind.remedy.is_empty());
        assert!(!kind.commands.is_empty(), "{}", kind.id);
    }
}

#[test]
fn languages_say_of_their_findings_what_the_table_says() {
    let mut severities: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for language in LANGUAGES {
        let module = format!("src/program/{language}/mod.rs");
        let text = crate::support::text(&module);
        let mut told = BTreeSet::new();
        for line in text.lines() {
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            if let ["//!", id, severity @ ("error" | "warning" | "note"), ..] = cells.as_slice() {
                let id = id.trim_matches('`').to_owned();
                let of_id = severities.entry(id.clone()).or_default();
                of_id.insert((*severity).to_owned());
                told.insert(id);
            }
        }
        let of_table = TABLE
            .iter()
            .filter(|kind| kind.languages.contains(&language));
        let known: BTreeSet<String> = of_table.map(|kind| kind.id.to_owned()).collect();
        assert_eq!(told, known, "{module}");
    }
    // what one language lets through with a warning another has to refuse: the table has the worse
    for (id, told) in severities {
        let of_table = kind(&id).expect("in the table").severity;
        let word = |severity: Severity| format!("{severity:?}").to_lowercase();
        assert!(told.contains(&word(of_table)), "{id}: {told:?}");
    }
}

#[test]
fn explain_tells_one_finding_and_asks_back_for_none() {
    let (status, out, _) = run(&["explain", "near-singularity"]);
    assert_eq!(status, 0);
    let of = kind("near-singularity").expect("in the table");
    let flat = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        flat(&out).contains(of.meaning) && flat(&out).contains(of.remedy),
        "{out}"
    );
    let (status, _, told) = run(&["explain", "near-nothing"]);
    assert_eq!(status, 2);
    assert!(told.contains("near-singularity"), "{told}");
    let (_, out, _) = run(&["explain", "--json"]);
    let report: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(
        report["findings"].as_array().map(Vec::len),
        Some(TABLE.len())
    );
}

/// Whether a text is a name in kebab-case of several words.
fn is_id(text: &str) -> bool {
    text.contains('-')
        && text.starts_with(|c: char| c.is_ascii_lowercase())
        && !text.ends_with('-')
        && text
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
}

#[test]
fn what_the_source_finds_is_in_the_table() {
    let source = repository("src");
    let mut seen = BTreeSet::new();
    for file in files_below(&source) {
        if file.extension().is_none_or(|e| e != "rs") || file.starts_with("finding") {
            continue;
        }
        let text = std::fs::read_to_string(source.join(&file)).expect("source");
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let lines: Vec<&str> = code.lines().collect();
        for (n, line) in lines.iter().enumerate() {
            // an id stands before its severity
            let behind = &lines[n..lines.len().min(n + 3)];
            let has_severity = behind.iter().any(|line| line.contains("Severity::"));
            let before = n.checked_sub(1).map_or("", |n| lines[n]);
            let is_remark = [before, line]
                .iter()
                .any(|line| line.contains("remark(") || line.contains("warning("));
            for word in line.split('"').skip(1).step_by(2) {
                if is_id(word) && (has_severity || is_remark) {
                    assert!(kind(word).is_some(), "{}: {word}", file.display());
                    seen.insert(word.to_owned());
                }
            }
        }
    }
    assert!(seen.len() > 80, "{}", seen.len());
}
