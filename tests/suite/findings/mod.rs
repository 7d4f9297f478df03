//! The table of findings: one for all, and the same as what modules say of themselves.

use crate::support::{run, sources};
use poseshift::finding::{TABLE, kind};
use poseshift::program::LANGUAGES;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Every text of the source that is in quotes, the table itself left out.
fn quoted() -> BTreeSet<String> {
    let mut words = BTreeSet::new();
    for (file, text) in sources() {
        if file.starts_with("finding") {
            continue;
        }
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

/// The code of a file of the source, without its tests and comments.
fn code(text: &str) -> String {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines();
    lines
        .filter(|line| !line.trim_start().starts_with("//"))
        .fold(String::new(), |all, line| all + line + "\n")
}

#[test]
fn the_languages_of_a_finding_are_the_folders_that_find_it() {
    let languages: Vec<&str> = LANGUAGES.iter().map(|l| l.about().id).collect();
    let mut found: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (file, text) in sources() {
        let name = file.to_string_lossy().into_owned();
        if name.starts_with("finding") || name.contains("/tests") {
            continue;
        }
        let folder = name
            .strip_prefix("program/")
            .and_then(|name| name.split('/').next());
        let language = folder.and_then(|folder| languages.iter().find(|l| **l == folder));
        for word in code(&text).split('"').skip(1).step_by(2) {
            if let Some(kind) = kind(word).filter(|kind| kind.id == word) {
                // what is found outside the folders is found in all languages
                found
                    .entry(kind.id)
                    .or_default()
                    .insert(language.map_or("all", |l| l));
            }
        }
    }
    for kind in TABLE {
        let of_table: BTreeSet<&str> = kind.languages.iter().copied().collect();
        let folders = found.remove(kind.id).unwrap_or_default();
        let folders = if folders.contains("all") {
            BTreeSet::new()
        } else {
            folders
        };
        assert_eq!(of_table, folders, "{}", kind.id);
    }
}

#[test]
fn earlier_names_lead_to_the_finding_and_are_none_of_today() {
    let today: BTreeSet<&str> = TABLE.iter().map(|kind| kind.id).collect();
    let mut earlier = BTreeSet::new();
    for of in TABLE {
        for was in of.was {
            assert!(!today.contains(was) && earlier.insert(*was), "{was}");
            assert_eq!(kind(was).map(|kind| kind.id), Some(of.id));
        }
    }
    let (status, out, _) = run(&["explain", "incremental-move"]);
    assert_eq!(status, 0);
    assert!(out.contains("relative-move"), "{out}");
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
    let (status, _, reported) = run(&["explain", "near-nothing"]);
    assert_eq!(status, 2);
    assert!(reported.contains("near-singularity"), "{reported}");
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
    let mut seen = BTreeSet::new();
    for (file, text) in sources() {
        if file.starts_with("finding") {
            continue;
        }
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
