//! One word for a thing, that of the field, and British spelling: in the documents, in what
//! commands print, in comments and in names.

use crate::support::{files_below, repository, text};

/// What is not written, and what is.
const WORDS: [(&str, &str); 14] = [
    ("told", "reported, known, said"),
    ("beside", "next to, offset from, besides"),
    ("rival", "alternative"),
    ("rivals", "alternatives"),
    ("doubts", "input checks"),
    ("color", "colour"),
    ("colors", "colours"),
    ("center", "centre"),
    ("behavior", "behaviour"),
    ("gray", "grey"),
    ("neighbor", "neighbour"),
    ("neighbors", "neighbours"),
    ("analyze", "analyse"),
    ("modeled", "modelled"),
];

/// Words of the list in a text: where, and what stands for it.
fn misused(place: &str, line: &str) -> Vec<String> {
    let words = line.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '-'));
    let found = words.filter_map(|word| {
        let word = word.to_lowercase();
        let (_, instead) = WORDS.iter().find(|(known, _)| *known == word)?;
        Some(format!("{place}: `{word}`, instead: {instead}"))
    });
    found.collect()
}

/// What stands between marks, or outside of them.
fn pieces(line: &str, mark: char, inside: bool) -> String {
    let every = line.split(mark).skip(usize::from(inside)).step_by(2);
    every.collect::<Vec<_>>().join(" ")
}

#[test]
fn documents_and_what_is_printed_have_the_words_of_the_field() {
    let mut wrong = Vec::new();
    let mut lines = 0;
    let mut look = |name: &str, mark: char, inside: bool| {
        let mut is_code = false;
        for (number, line) in text(name).lines().enumerate() {
            if !inside && line.starts_with("```") {
                is_code = !is_code;
            }
            // names in code, and the tests of a module
            if is_code || inside && line.trim_start().starts_with("//") {
                continue;
            }
            lines += 1;
            let place = format!("{name}:{}", number + 1);
            wrong.extend(misused(&place, &pieces(line, mark, inside)));
        }
    };
    for name in ["README.md", "CONTRIBUTING.md", "SECURITY.md"] {
        look(name, '`', false);
    }
    for (folder, ending, mark) in [
        ("docs", ".md", '`'),
        ("src/report", ".rs", '"'),
        ("src/cli", ".rs", '"'),
        ("src/task", ".rs", '"'),
        ("crates/programs/src/finding", ".rs", '"'),
    ] {
        for path in files_below(&repository(folder)) {
            let name = format!("{folder}/{}", path.display());
            if name.ends_with(ending) {
                look(&name, mark, mark == '"');
            }
        }
    }
    assert!(lines > 5_000, "only {lines} lines were read");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    // the test sees what it looks for
    assert_eq!(misused("here", "The rest is told.").len(), 1);
    assert_eq!(
        misused("here", &pieces("`told` and told", '`', false)).len(),
        1
    );
}

/// Words of the list in comments, texts and parts of names; ids of findings that are a promise
/// stay.
#[test]
fn comments_and_names_have_the_words_of_the_field() {
    let mut wrong = Vec::new();
    let mut lines = 0;
    for folder in ["src", "crates", "tests", "examples", "benches"] {
        for path in files_below(&repository(folder)) {
            let name = format!("{folder}/{}", path.display());
            let is_rust = path.extension().is_some_and(|ending| ending == "rs");
            if !is_rust || name == "tests/suite/documents/words.rs" {
                continue;
            }
            for (number, line) in text(&name).lines().enumerate() {
                lines += 1;
                let place = format!("{name}:{}", number + 1);
                let line = line.replace("wrist-not-told", "");
                wrong.extend(misused(&place, &line.replace('_', " ")));
            }
        }
    }
    assert!(lines > 100_000, "only {lines} lines were read");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(misused("here", &"fn is_told()".replace('_', " ")).len(), 1);
}
