//! What the documents say, checked: generated tables, the example, links, commands.
//!
//! `POSESHIFT_BLESS=1 cargo test documents` writes the generated tables anew.

use crate::support::{files_below, is_tracked, poseshift, repository, scratch, text};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

fn listed(command: &str, key: &str) -> Vec<Value> {
    let output = poseshift()
        .args([command, "--json"])
        .output()
        .expect("the program starts");
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    report[key].as_array().expect("a list").clone()
}

fn word<'a>(row: &'a Value, key: &str) -> &'a str {
    row[key].as_str().unwrap_or("")
}

fn languages() -> String {
    let mut table = String::from("| language | files | rewritten |\n|---|---|---|\n");
    for row in listed("languages", "languages") {
        let list = |key: &str, before: &str, between: &str| {
            let items = row[key].as_array().expect("a list").iter();
            let items = items.map(|item| format!("{before}{}", item.as_str().expect("text")));
            items.collect::<Vec<_>>().join(between)
        };
        table += &format!(
            "| {} (`{}`) | {} | {} |\n",
            word(&row, "name"),
            word(&row, "id"),
            list("extensions", ".", " "),
            list("rewrites", "", "; ")
        );
    }
    table + "\n`poseshift languages` also lists what each leaves alone and refuses.\n"
}

fn robots() -> String {
    let mut table = String::from("| robot | profile | closed-form inverse |\n|---|---|---|\n");
    let mut makers: BTreeMap<String, usize> = BTreeMap::new();
    for row in listed("robots", "robots") {
        if row["origin"] == "catalogue" {
            *makers
                .entry(word(&row, "manufacturer").to_owned())
                .or_default() += 1;
            continue;
        }
        let calibrated = if row["effects"] == 0 {
            ""
        } else {
            ", calibrated"
        };
        table += &format!(
            "| {} {}{calibrated} | `{}` | {} |\n",
            word(&row, "manufacturer"),
            word(&row, "model"),
            word(&row, "name"),
            word(&row, "closed_form_inverse")
        );
    }
    let all: usize = makers.values().sum();
    let makers = makers.iter().map(|(maker, arms)| format!("{maker} {arms}"));
    let makers: Vec<String> = makers.collect();
    table
        + &format!(
            "\nand {all} more from public files, whose limits are to be set from the data sheet: {} (`poseshift robots --search TEXT`).\n",
            makers.join(", ")
        )
}

fn findings() -> String {
    let mut table =
        String::from("| finding | | meaning | what to do | of |\n|---|---|---|---|---|\n");
    for row in listed("explain", "findings") {
        let list = |key: &str| {
            let items = row[key].as_array().expect("a list").iter();
            items
                .map(|item| item.as_str().expect("text"))
                .collect::<Vec<_>>()
                .join(" ")
        };
        let of = Some(list("languages")).filter(|of| !of.is_empty());
        table += &format!(
            "| `{}` | {} | {} | {} | {} |\n",
            word(&row, "id"),
            word(&row, "severity"),
            word(&row, "meaning"),
            word(&row, "remedy"),
            of.unwrap_or_else(|| list("commands"))
        );
    }
    table
}

#[test]
fn generated_tables_are_those_of_the_program() {
    for (document, name, table) in [
        ("README.md", "languages", languages()),
        ("README.md", "robots", robots()),
        ("docs/findings.md", "findings", findings()),
    ] {
        let mut all = text(document);
        let head = format!("<!-- generated: {name} -->\n");
        let start = all.find(&head).expect("a place for the table") + head.len();
        let end = start + all[start..].find("<!-- end -->").expect("its end");
        if std::env::var_os("POSESHIFT_BLESS").is_some() {
            all.replace_range(start..end, &table);
            std::fs::write(repository(document), &all).expect("a writable file");
        } else {
            let help = "POSESHIFT_BLESS=1 cargo test documents writes it anew";
            assert_eq!(&all[start..end], table, "{name}: {help}");
        }
    }
}

#[test]
fn the_example_of_the_readme_is_the_sample() {
    let readme = text("README.md");
    let mut seen = 0;
    for line in readme.lines() {
        let file = match line.get(..1) {
            Some("-") if line.contains("[[") => "programs/rapid/olp/in/Deburr.mod",
            Some("+") if line.contains("[[") => "programs/rapid/olp/out/Deburr.mod",
            _ => continue,
        };
        let program = text(file);
        for part in line[1..].split('…') {
            assert!(
                program.contains(part.trim_start_matches("],")),
                "{file} has no {part}"
            );
            seen += 1;
        }
    }
    assert_eq!(seen, 4);
}

fn documents() -> Vec<PathBuf> {
    let docs = files_below(&repository("docs")).into_iter();
    let mut all: Vec<_> = docs.map(|file| PathBuf::from("docs").join(file)).collect();
    all.extend(["README.md".into(), "robots/README.md".into()]);
    all.retain(|file| file.extension().is_some_and(|e| e == "md"));
    all
}

#[test]
fn links_between_documents_lead_somewhere() {
    let mut links = 0;
    for document in documents() {
        let text = text(document.to_str().expect("a plain name"));
        for rest in text.split("](").skip(1) {
            let link = rest.split([')', '#']).next().unwrap_or("");
            if link.is_empty() || link.contains("://") {
                continue;
            }
            let mut target = document.parent().expect("a folder").to_owned();
            for part in PathBuf::from(link).components() {
                match part {
                    Component::ParentDir => assert!(target.pop(), "{link} leads out"),
                    Component::CurDir => {}
                    part => target.push(part),
                }
            }
            let target = target.to_str().expect("a plain name");
            assert!(is_tracked(target), "{}: {link}", document.display());
            links += 1;
        }
    }
    assert!(links > 8);
}

#[test]
fn commands_of_the_readme_do_what_it_says() {
    let scratch = scratch();
    let run = run_commands("README.md", scratch.path());
    assert!(run >= 5, "{run} commands");
    assert!(scratch.path().join("Deburr_compensated.mod").is_file());
}

#[test]
fn commands_of_the_way_from_a_tracker_to_a_program_run() {
    let scratch = scratch();
    assert_eq!(run_commands("docs/calibration.md", scratch.path()), 6);
    assert!(scratch.path().join("weld.src").is_file());
}

/// Runs the commands of a document's `console` blocks as they stand but for the program's own path. How many there are.
fn run_commands(document: &str, folder: &Path) -> usize {
    let readme = text(document);
    let mut run = 0;
    for block in readme.split("```console\n").skip(1) {
        let block = block.split("```").next().expect("a block has an end");
        for line in block.lines() {
            let line = line.strip_prefix("$ ").unwrap_or(line);
            let words: Vec<&str> = line.split_whitespace().collect();
            let arguments = match words.as_slice() {
                ["poseshift", rest @ ..] | ["cargo", "run", "--release", "--", rest @ ..] => rest,
                ["cargo", ..] => continue,
                other => panic!("not understood: {other:?}"),
            };
            let mut command = poseshift();
            command.current_dir(folder);
            for word in arguments {
                let word = &word.replace('"', "");
                // what an earlier command of the reader wrote is not an input
                if word.contains('/') && is_tracked(word) {
                    command.arg(repository(word));
                } else {
                    command.arg(word);
                }
            }
            let output = command.output().expect("the program starts");
            // the difference between two profiles is an answer like that of `diff`
            let expected = i32::from(arguments.starts_with(&["profile", "diff"]));
            let told = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(expected), "{line}: {told}");
            run += 1;
        }
    }
    run
}
