//! The three forms of every result: text, JSON and page tell the same numbers, and the JSON is what
//! its schema says.

use super::data;
use super::schema::faults;
use crate::cli::reports::{COMMANDS, given};
use crate::support::{repository, run, scratch};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// Numbers that are names: quantiles, standards, what is counted in words.
const NAMES: [&str; 8] = [
    "95 %",
    "99.7 %",
    "ISO 9283",
    "mean + 3 std",
    "more than 0.9",
    "at 1000 postures",
    "1 std",
    "SHA-256",
];

/// Every number of a document, its lengths of lists and how often it says yes; and every text.
#[derive(Default)]
struct Known {
    numbers: Vec<f64>,
    texts: String,
}

impl Known {
    fn of(value: &Value) -> Self {
        let mut known = Self::default();
        known.add(value);
        known
    }

    fn add(&mut self, value: &Value) {
        match value {
            Value::Number(number) => self.numbers.extend(number.as_f64()),
            Value::String(text) => {
                self.texts.push_str(text);
                self.texts.push('\n');
            }
            Value::Array(list) => {
                self.numbers.push(list.len() as f64);
                let yes = list.iter().filter(|one| {
                    one.as_object()
                        .is_some_and(|one| one.values().any(|v| *v == Value::Bool(true)))
                });
                let yes = yes.count();
                self.numbers.extend([yes as f64, (list.len() - yes) as f64]);
                for one in list {
                    self.add(one);
                }
            }
            Value::Object(map) => {
                for (key, one) in map {
                    self.texts.push_str(key);
                    self.texts.push('\n');
                    self.add(one);
                }
            }
            Value::Null | Value::Bool(_) => {}
        }
    }

    /// Whether a number as it is written, in the document's unit, in thousandths or in per cent of
    /// it, stands in it.
    fn has(&self, written: &str) -> bool {
        let digits = written.trim_start_matches(['+', '-']);
        if self.texts.contains(digits) {
            return true;
        }
        let value: f64 = written.parse().expect("a number");
        let half = half_a_digit(digits) + 1e-12 * value.abs();
        let near = |x: f64| (x - value).abs() <= half || (x + value).abs() <= half;
        self.numbers
            .iter()
            .any(|x| [1.0, 100.0, 1000.0, 2.0, 0.0].iter().any(|k| near(k * x)))
    }

    /// Whether a bound as it is written, which is rounded outwards, is that of a number in it.
    fn bounds(&self, written: &str, from_above: bool) -> bool {
        let value: f64 = written.parse().expect("a number");
        let digit = 2.0 * half_a_digit(written.trim_start_matches('-'));
        // as far as the JSON has decimals
        let beyond = |x: &f64| if from_above { value - x } else { x - value };
        let mut numbers = self.numbers.iter();
        numbers.any(|x| (-1e-6..digit).contains(&beyond(x)))
    }
}

/// What stands in front of bounds, and whether they are from above.
const BOUNDS: [(&str, bool); 2] = [("never more than", true), ("never less than", false)];

/// The bounds of a text, and the rest of it: a page has the number in front of its words, a text
/// behind them, and in degrees in their line.
fn without_bounds(text: &str, is_page: bool) -> (Vec<(String, bool)>, String) {
    let is_number = |word: &str| word.parse::<f64>().is_ok();
    let (mut found, mut rest) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words: Vec<&str> = line.split_whitespace().collect();
        let mut at = 0;
        while at + 3 <= words.len() {
            let said = words[at..at + 3].join(" ");
            let bound = BOUNDS.iter().find(|(words, _)| *words == said);
            at += 1;
            let Some((_, from_above)) = bound else {
                continue;
            };
            let numbers = if is_page {
                vec![
                    (0..at)
                        .rfind(|at| is_number(words[*at]))
                        .expect("its number"),
                ]
            } else {
                let in_deg = (at + 3..words.len() - 1).find(|at| words[at + 1] == "deg");
                std::iter::once(at + 2).chain(in_deg).collect()
            };
            for number in numbers {
                found.push((words[number].to_owned(), *from_above));
                words[number] = "";
            }
        }
        rest.push(words.join(" "));
    }
    (found, rest.join("\n"))
}

/// Half a unit of the last digit that is written, and what arithmetic takes.
fn half_a_digit(digits: &str) -> f64 {
    let (mantissa, exponent) = digits.split_once('e').unwrap_or((digits, "0"));
    let length = |text: &str| i32::try_from(text.len()).expect("a short number");
    let decimals = match mantissa.split_once('.') {
        Some((_, decimals)) => length(decimals),
        None => length(mantissa.trim_end_matches('0')) - length(mantissa),
    };
    let exponent: i32 = exponent.parse().expect("an exponent");
    0.500_001 * 10_f64.powi(exponent - decimals)
}

/// The numbers of a text, names of them left out.
fn numbers(text: &str) -> Vec<String> {
    let mut text = text.replace(['\u{a0}', '\u{2192}', '\u{b1}', '\u{b0}'], " ");
    for name in NAMES {
        text = text.replace(name, " ");
    }
    let mut found = Vec::new();
    for word in text.split(|c: char| c.is_whitespace() || "()[]{},;:=/|<>%&\"'`".contains(c)) {
        let word = word.trim_matches(['.', '\u{2026}']);
        let digits = word.trim_start_matches(['+', '-']);
        if digits.starts_with(|c: char| c.is_ascii_digit()) && word.parse::<f64>().is_ok() {
            found.push(word.to_owned());
        }
    }
    found
}

/// How many numbers of a text are in the JSON; those that are not go to `unknown`.
fn count(known: &Known, text: &str, what: &str, unknown: &mut Vec<String>) -> usize {
    let (bounds, text) = without_bounds(text, what.starts_with("page"));
    let beyond = bounds.iter().filter(|(n, above)| !known.bounds(n, *above));
    let numbers = numbers(&text);
    let missing = numbers.iter().filter(|n| !known.has(n));
    let missing: Vec<&String> = missing.chain(beyond.map(|(n, _)| n)).collect();
    if !missing.is_empty() {
        unknown.push(format!("{what}: {missing:?}"));
    }
    numbers.len() + bounds.len() - missing.len()
}

/// What a page says without its script: the text between the tags of its body.
fn body(page: &Path) -> String {
    let html = std::fs::read_to_string(page).expect("a page");
    let body = html.split("<body").nth(1).expect("a body");
    // the command line and the date are no result
    let body = body.split("<footer").next().unwrap_or_default();
    let mut text = String::new();
    for piece in body.split('<').skip(1) {
        text.push(' ');
        text.push_str(piece.split_once('>').map_or("", |(_, text)| text));
    }
    text
}

/// The numbers of the tables that a page shows.
fn shown(page: &Path) -> String {
    let html = std::fs::read_to_string(page).expect("a page");
    if html.contains(r#"type="application/zlib" id="data""#) {
        // many points: their tables are samples of a cloud
        return String::new();
    }
    let data = data(page);
    let mut text = String::new();
    for section in data["sections"].as_array().expect("sections") {
        if section["type"] != "table" {
            continue;
        }
        let table = &data["tables"][section["table"].as_str().expect("a table")];
        for column in table["columns"].as_array().expect("columns") {
            let values = column["values"].as_array().into_iter().flatten();
            for value in values.filter(|v| v.is_number()) {
                text += &format!("{value} ");
            }
        }
    }
    text
}

#[test]
fn text_json_and_page_of_every_command_tell_the_same_numbers() {
    let folder = scratch();
    let (mut reported, mut drawn, mut kinds) = (0, 0, BTreeSet::new());
    let mut unknown = Vec::new();
    for (number, (line, status, kind)) in COMMANDS.iter().enumerate() {
        let page = folder.path().join(format!("page{number}.html"));
        let has_page = given(&format!("{line} --help"), folder.path())
            .output()
            .is_ok_and(|help| String::from_utf8_lossy(&help.stdout).contains("--report"));
        let mut command = given(line, folder.path());
        command.arg("--json");
        if has_page {
            command.arg("--report").arg(&page);
        }
        let output = command.output().expect("the program starts");
        assert_eq!(output.status.code(), Some(*status), "{line}");
        if kind.is_empty() {
            continue;
        }
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let mut known = Known::of(&report);
        // names: of files and options, and of robots
        known.texts += line;
        for word in line
            .split(' ')
            .filter(|word| Path::new(word).extension().is_some_and(|e| e == "yaml"))
        {
            let path = word.strip_prefix('@').map(repository);
            let path = path.unwrap_or_else(|| folder.path().join(word));
            let profile = std::fs::read_to_string(path).unwrap_or_default();
            let robot = profile.lines().filter(|line| line.starts_with("robot:"));
            known.texts.extend(robot);
        }
        // what is printed is the same result once more: nothing here depends on the time
        if line.starts_with("profile ")
            && let Some((_, made)) = line.split_once("-o ")
        {
            std::fs::remove_file(folder.path().join(made)).expect("it was written");
        }
        let printed = given(line, folder.path())
            .output()
            .expect("the program starts");
        let printed = String::from_utf8(printed.stdout).expect("UTF-8");
        let what = format!("text of {line}");
        reported += count(&known, &printed, &what, &mut unknown);
        if has_page {
            let what = format!("page of {line}");
            drawn += count(&known, &body(&page), &what, &mut unknown);
            drawn += count(&known, &shown(&page), &what, &mut unknown);
        }
        kinds.insert(kind.split('/').next().unwrap_or_default().to_owned());
    }
    assert!(unknown.is_empty(), "not in the JSON: {unknown:#?}");
    assert!(reported > 500 && drawn > 300, "{reported} {drawn}");
    assert!(kinds.len() > 12, "{kinds:?}");
}

#[test]
fn every_report_is_what_its_schema_says() {
    let folder = scratch();
    let mut seen = 0;
    let names = run(&["schema"]).1;
    for (line, _, kind) in COMMANDS {
        let name = kind.split('/').next().unwrap_or_default();
        let is_known = names
            .lines()
            .any(|known| known.split(' ').next() == Some(name));
        let output = given(line, folder.path())
            .arg("--json")
            .output()
            .expect("the program starts");
        if kind.is_empty() {
            continue;
        }
        assert!(is_known, "no schema of {kind}");
        let schema: Value = serde_json::from_str(&run(&["schema", name]).1).expect("a schema");
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(faults(&schema, &report), Vec::<String>::new(), "{line}");
        // a schema that takes everything would show nothing
        let mut other = report.clone();
        other["poseshift"] = "another/1".into();
        assert!(!faults(&schema, &other).is_empty(), "{line}");
        seen += 1;
    }
    assert!(seen > 14, "{seen}");
}
