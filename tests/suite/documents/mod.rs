//! What the documents say, checked: generated tables, the example, links, commands.
//!
//! `POSESHIFT_BLESS=1 cargo test documents` writes the generated tables anew.

mod commands;
mod words;

use crate::support::{files_below, is_tracked, poseshift, repository, text};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Component, PathBuf};

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
            "\nand {all} more from public files, whose limits are to be set from the data sheet: \
             {} (`poseshift robots --search TEXT`).\n",
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
