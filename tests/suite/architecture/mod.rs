//! The direction in which the modules use each other.

use crate::support::{files_below, repository, sources};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path};

/// Who may use whom. A module not named here is used by nobody it should not be.
const ALLOWED: &[(&str, &[&str])] = &[
    ("finding", &[]),
    ("printable", &[]),
    ("geometry", &[]),
    ("nearest", &[]),
    ("model", &["geometry", "nearest", "printable"]),
    ("inverse", &["geometry", "model"]),
    // and its own, in what its macro writes elsewhere
    (
        "profile",
        &["file", "geometry", "model", "nearest", "printable", "shape"],
    ),
    (
        "identify",
        &[
            "geometry", "inverse", "model", "nearest", "profile", "register",
        ],
    ),
    (
        "register",
        &["geometry", "inverse", "model", "printable", "profile"],
    ),
    ("diagnose", &["geometry", "identify", "model", "profile"]),
    ("program", &["geometry", "finding"]),
    (
        "motion",
        &[
            "finding",
            "geometry",
            "inverse",
            "model",
            "nearest",
            "printable",
            "profile",
            "program",
        ],
    ),
    (
        "compensate",
        &[
            "finding", "geometry", "inverse", "model", "motion", "profile", "program",
        ],
    ),
    ("xml", &[]),
    (
        "urdf",
        &["geometry", "model", "nearest", "printable", "xml"],
    ),
    (
        "check",
        &[
            "compensate",
            "finding",
            "geometry",
            "inverse",
            "model",
            "motion",
            "profile",
            "program",
            "xml",
        ],
    ),
    (
        "task",
        &[
            "check",
            "compensate",
            "diagnose",
            "finding",
            "geometry",
            "identify",
            "inverse",
            "model",
            "motion",
            "nearest",
            "printable",
            "program",
            "register",
            "urdf",
        ],
    ),
    (
        "report",
        &[
            "check",
            "compensate",
            "diagnose",
            "finding",
            "geometry",
            "identify",
            "inverse",
            "model",
            "printable",
            "program",
            "task",
        ],
    ),
    (
        "cli",
        &[
            "check",
            "compensate",
            "diagnose",
            "finding",
            "geometry",
            "identify",
            "model",
            "motion",
            "nearest",
            "printable",
            "program",
            "register",
            "report",
            "task",
            "urdf",
        ],
    ),
    ("main", &[]),
    ("lib", &[]),
];

/// The top modules that a file's code names after `crate::`, tests in it left out.
fn used_by(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or(text);
    let code: String = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .collect::<Vec<_>>()
        .join("\n");
    let names = code.split("crate::").skip(1);
    names
        .map(|rest| {
            rest.chars()
                .take_while(|c| c.is_ascii_lowercase() || *c == '_')
                .collect()
        })
        .collect()
}

#[test]
fn modules_use_each_other_in_one_direction() {
    let allowed: BTreeMap<&str, BTreeSet<&str>> = ALLOWED
        .iter()
        .map(|(name, uses)| (*name, uses.iter().copied().collect()))
        .collect();
    let mut seen = 0;
    for (file, text) in sources() {
        let first = file.components().next().expect("a path");
        let Component::Normal(top) = first else {
            panic!("{}", file.display())
        };
        let top = Path::new(top)
            .file_stem()
            .and_then(|s| s.to_str())
            .expect("a plain name");
        let is_test = file
            .components()
            .any(|c| matches!(Path::new(&c).file_stem(), Some(s) if s == "tests" || s == "laws"));
        let may = allowed
            .get(top)
            .unwrap_or_else(|| panic!("{} is in no module of the list", file.display()));
        for used in used_by(&text)
            .into_iter()
            .filter(|used| used != top && !used.is_empty() && !is_test)
        {
            assert!(
                may.contains(used.as_str()),
                "{} uses {used}",
                file.display()
            );
            seen += 1;
        }
    }
    assert!(seen > 20, "{seen} uses seen");
}

/// The code of the files of a folder of the sources, tests in them left out.
fn code_of(folder: &str) -> Vec<(String, String)> {
    sources()
        .into_iter()
        .filter_map(|(file, text)| Some((file.strip_prefix(folder).ok()?.to_owned(), text)))
        .map(|(file, text)| {
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            let code: Vec<&str> = code
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"))
                .collect();
            (file.display().to_string(), code.join("\n"))
        })
        .collect()
}

#[test]
fn a_command_imports_nothing_of_another_command_and_makes_no_json() {
    let files = code_of("cli");
    let commands: BTreeSet<&str> = files
        .iter()
        .filter(|(_, code)| code.contains("fn run(&self"))
        .filter_map(|(file, _)| file.strip_suffix(".rs"))
        .collect();
    assert!(commands.len() > 15, "{commands:?}");
    for (file, code) in &files {
        assert!(!code.contains("json!"), "{file} makes JSON");
        if file == "mod.rs" {
            continue;
        }
        for command in commands
            .iter()
            .filter(|command| file != &format!("{command}.rs"))
        {
            let import = format!("super::{command}::");
            assert!(!code.contains(&import), "{file} uses {command}");
        }
    }
}

#[test]
fn tasks_print_nothing_and_know_no_arguments() {
    for (file, code) in code_of("task") {
        for word in [
            "println!",
            "eprint",
            "clap::",
            "std::env",
            "std::io::stdout",
        ] {
            assert!(!code.contains(word), "{file} uses {word}");
        }
    }
}

#[test]
fn every_shipped_profile_is_built_in() {
    let files: BTreeSet<String> = files_below(&repository("robots"))
        .iter()
        .filter(|path| path.extension().is_some_and(|e| e == "yaml"))
        .map(|path| {
            path.file_stem()
                .and_then(|s| s.to_str())
                .expect("a plain name")
                .to_owned()
        })
        .collect();
    let built_in: BTreeSet<String> = poseshift::model::profile::SHIPPED
        .iter()
        .map(|(name, _)| (*name).to_owned())
        .collect();
    assert_eq!(files, built_in);
}

/// Kinds of effects that say where something is or how long a link is.
const PLACES: [&str; 8] = [
    "BaseFrame",
    "ToolFrame",
    "LinkGeometry",
    "FrameShift",
    "ToolSlip",
    "PositionerAxis",
    "PositionerPlate",
    "PositionerZero",
];
/// Kinds that a file names besides, and why.
const NAMED: [(&str, &str); 3] = [
    // what the levels `joints` and `compliance` of `calibrate` are
    ("identify/parameters.rs", "JointScale"),
    ("identify/parameters.rs", "JointCompliance"),
    // what sag is
    ("register/axes/sag.rs", "JointCompliance"),
];

#[test]
fn only_its_own_file_names_an_effect() {
    let registry = crate::support::text("crates/kinematics/src/model/effects/mod.rs");
    let list = registry.split("registry! {").nth(1).expect("the list");
    let list = list.split('}').next().expect("its end");
    let kinds: Vec<&str> = (list.split(','))
        .filter_map(|line| line.trim().split_once("::"))
        .map(|(_, kind)| kind)
        .collect();
    assert!(kinds.len() > 30 && PLACES.iter().all(|place| kinds.contains(place)));
    let mut named = BTreeSet::new();
    for (file, code) in code_of("") {
        let file = file.replace('\\', "/");
        if file.starts_with("model/effects") || file.ends_with("tests.rs") {
            continue;
        }
        for rest in code.split("Kind::").skip(1) {
            let kind: String = (rest.chars())
                .take_while(char::is_ascii_alphanumeric)
                .collect();
            if kinds.contains(&kind.as_str()) && !PLACES.contains(&kind.as_str()) {
                named.insert((file.clone(), kind));
            }
        }
    }
    let known = NAMED.map(|(file, kind)| (file.to_owned(), kind.to_owned()));
    assert_eq!(named, BTreeSet::from(known));
}
