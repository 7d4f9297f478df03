//! A page and its HTML.

use super::cell::Cell;
use super::chart::{Axis, Chart, Heat, Kind, Series, Tone};
use super::numbers::{Column, Table};
use crate::finding::{Finding, Severity};
use crate::report::escaped;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, HashMap};
use std::fmt::Write;
use std::io::Write as _;

/// What draws the page.
const SCRIPT: &str = include_str!("assets/report.js");
const STYLE: &str = include_str!("assets/report.css");

/// Findings that a page holds; of more it says how many there are.
pub(crate) const MOST_FINDINGS: usize = 5000;

/// Bytes of data that stand in a page as they are; more are packed.
const PLAIN: usize = 300_000;

/// How the answer looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Level {
    /// Nothing to worry about.
    Good,
    /// Look at it.
    Warning,
    /// The answer is no.
    Error,
}

impl Level {
    /// As the worst of the findings.
    #[must_use]
    pub(crate) fn of(findings: &[Finding]) -> Self {
        match findings.iter().map(|f| f.severity).max() {
            Some(Severity::Error) => Self::Error,
            Some(Severity::Warning) => Self::Warning,
            _ => Self::Good,
        }
    }
}

/// The answer in a sentence.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Verdict {
    /// How it looks.
    pub level: Level,
    /// The sentence.
    pub text: String,
}

/// One of the few numbers that stand first.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Fact {
    /// What it is.
    pub label: String,
    /// It, with its unit.
    pub value: String,
}

/// A short table that is readable without a script.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Summary {
    /// Headings.
    pub heads: Vec<String>,
    /// Rows of texts.
    pub rows: Vec<Vec<String>>,
}

/// A table shown as such.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Shown {
    /// Its title.
    pub title: String,
    /// What it says.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub note: String,
    /// The table's name.
    pub table: String,
}

/// Sentences.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Text {
    /// Its title.
    pub title: String,
    /// One paragraph each.
    pub lines: Vec<String>,
}

/// A part of a page.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub(crate) enum Section {
    /// A view in space.
    Cell(Box<Cell>),
    /// A chart.
    Chart(Chart),
    /// Correlations.
    Heat(Heat),
    /// A table.
    Table(Shown),
    /// Sentences.
    Text(Text),
}

/// A report.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Page {
    /// What it is about.
    pub title: String,
    /// Which files, which robot.
    #[serde(skip)]
    pub lead: Vec<String>,
    /// The answer.
    #[serde(skip)]
    pub verdict: Verdict,
    /// The numbers that stand first.
    #[serde(skip)]
    pub facts: Vec<Fact>,
    /// A table that stands first.
    #[serde(skip)]
    pub summary: Option<Summary>,
    /// Tables by name.
    pub tables: BTreeMap<String, Table>,
    /// What is shown, in this order.
    pub sections: Vec<Section>,
}

impl Page {
    /// A page with nothing on it.
    #[must_use]
    pub(crate) fn new(title: String, level: Level, answer: String) -> Self {
        Self {
            title,
            lead: Vec::new(),
            verdict: Verdict {
                level,
                text: answer,
            },
            facts: Vec::new(),
            summary: None,
            tables: BTreeMap::new(),
            sections: Vec::new(),
        }
    }

    /// One of the numbers that stand first.
    pub(crate) fn fact(&mut self, label: &str, value: String) {
        self.facts.push(Fact {
            label: label.into(),
            value,
        });
    }

    /// A table under a name, shown.
    pub(crate) fn show(&mut self, name: &str, title: &str, note: &str, table: Table) {
        self.tables.insert(name.into(), table);
        self.sections.push(Section::Table(Shown {
            title: title.into(),
            note: note.into(),
            table: name.into(),
        }));
    }

    /// A histogram of the values of one series, or of several on one axis, with its table; none of
    /// no values.
    pub(crate) fn histogram(
        &mut self,
        name: &str,
        title: &str,
        (label, unit): (&str, &'static str),
        series: &[(&str, Tone, &[f64])],
    ) {
        let values: Vec<(&str, &[f64])> = series.iter().map(|(name, _, v)| (*name, *v)).collect();
        let (table, log) = super::numbers::histogram(label, unit, &values);
        if table.rows() == 0 {
            return;
        }
        self.tables.insert(name.into(), table);
        let mut chart = Chart::new(title, name, Axis::new(label, unit), Axis::new("count", ""));
        chart.x.log = log;
        chart.wide = series.len() > 1;
        for (k, (name, tone, _)) in series.iter().enumerate() {
            let mut series = Series::new(Kind::Histogram, 0, 2 + k, name, *tone);
            series.x2 = Some(1);
            chart.series.push(series);
        }
        self.sections.push(Section::Chart(chart));
    }

    /// Findings: those that say the same of one file once with their number, errors before warnings
    /// before notes.
    pub(crate) fn findings(&mut self, findings: &[Finding]) {
        if findings.is_empty() {
            return;
        }
        let mut alike: HashMap<(Severity, &str, &str, &str), usize> = HashMap::new();
        // the first of those that are alike, and how many they are
        let mut kept: Vec<(usize, usize)> = Vec::new();
        for (
            i,
            Finding {
                id,
                severity,
                file,
                message,
                ..
            },
        ) in findings.iter().enumerate()
        {
            let known = *alike
                .entry((*severity, id, file, message))
                .or_insert(kept.len());
            match kept.get_mut(known) {
                Some((_, count)) => *count += 1,
                None => kept.push((i, 1)),
            }
        }
        kept.sort_by_key(|&(i, _)| std::cmp::Reverse(findings[i].severity));
        let distinct = kept.len();
        kept.truncate(MOST_FINDINGS);
        let mut note = String::new();
        if distinct > kept.len() {
            let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
            for finding in findings {
                *counts.entry(finding.id).or_default() += 1;
            }
            let counts: Vec<String> = counts.iter().map(|(id, n)| format!("{n} {id}")).collect();
            let _ = write!(
                note,
                "{} of {} are listed; --json has all. In all: {}.",
                kept.len(),
                findings.len(),
                counts.join(", ")
            );
        }
        let of = |(i, _): &(usize, usize)| &findings[*i];
        let repeated = kept.iter().any(|(_, count)| *count > 1);
        let word = |severity: Severity| match severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        };
        let mut table = Table {
            columns: vec![
                Column::names("severity", kept.iter().map(|i| word(of(i).severity))),
                Column::names("id", kept.iter().map(|i| of(i).id)),
                Column::names("file", kept.iter().map(|i| of(i).file.as_str())),
                Column::counts("line", kept.iter().map(|i| of(i).line)),
                Column::texts("message", kept.iter().map(|i| of(i).message.clone())),
                Column::names("hint", kept.iter().map(|i| of(i).hint.as_str())),
            ],
        };
        if repeated {
            let counts = kept.iter().map(|(_, count)| *count);
            table.columns.insert(2, Column::counts("count", counts));
        }
        self.show("findings", "Findings", &note, table);
    }

    /// The whole file. `made`: when, and by which command line.
    #[must_use]
    pub(crate) fn html(&self, made: &str) -> String {
        let (kind, data) = stored(embedded(self));
        let (title, header) = (escaped(&self.title), self.header());
        let (policy, version) = (hash(SCRIPT), env!("CARGO_PKG_VERSION"));
        let made = escaped(made);
        format!(
            r#"<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src '{policy}'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="referrer" content="no-referrer">
<title>{title}</title>
<style>{STYLE}</style>
</head>
<body>
<header>
<h1>{title}</h1>
{header}</header>
<main id="page"><noscript><p>The numbers above are complete; views, charts and long tables need JavaScript, which this file carries itself.</p></noscript></main>
<footer><p>poseshift {version}, {made}</p><p>Everything shown is in this file; it asks nothing of the network. Distances are millimetres, angles degrees.</p></footer>
<script type="{kind}" id="data">{data}</script>
<script>{SCRIPT}</script>
</body>
</html>
"#
        )
    }

    /// What is read without a script: files, the answer, the numbers that stand first, the table
    /// that stands first.
    fn header(&self) -> String {
        let mut out = String::new();
        for line in &self.lead {
            out += &format!("<p class=\"lead\">{}</p>\n", escaped(line));
        }
        let level = match self.verdict.level {
            Level::Good => "good",
            Level::Warning => "warning",
            Level::Error => "error",
        };
        let text = escaped(&self.verdict.text);
        out += &format!("<p class=\"verdict {level}\">{text}</p>\n<ul class=\"facts\">\n");
        for Fact { label, value } in &self.facts {
            let (label, value) = (escaped(label), escaped(value));
            out += &format!("<li><b>{value}</b><span>{label}</span></li>\n");
        }
        out += "</ul>\n";
        if let Some(summary) = &self.summary {
            let cells = |tag: &str, cells: &[String]| -> String {
                let cell = |(k, text): (usize, &String)| {
                    let class = if k > 0 { " class=\"number\"" } else { "" };
                    let scope = if tag == "th" { " scope=\"col\"" } else { "" };
                    format!("<{tag}{scope}{class}>{}</{tag}>", escaped(text))
                };
                cells.iter().enumerate().map(cell).collect()
            };
            let rows = summary.rows.iter().map(|row| cells("td", row));
            out += &format!(
                "<div class=\"summary\" tabindex=\"0\" role=\"region\" \
                 aria-label=\"Summary\"><table \
                 aria-label=\"Summary\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>\n</table></div>\n",
                cells("th", &summary.heads),
                rows.map(|row| format!("<tr>{row}</tr>\n"))
                    .collect::<String>()
            );
        }
        out
    }
}

/// The hash by which a content security policy knows a script.
fn hash(script: &str) -> String {
    let digest = Sha256::digest(script.as_bytes());
    format!("sha256-{}", STANDARD.encode(digest))
}

/// Data as they stand in the page, with their kind: JSON, or much of it packed (zlib, base64).
fn stored(json: String) -> (&'static str, String) {
    if json.len() <= PLAIN {
        return ("application/json", json);
    }
    let mut packer = ZlibEncoder::new(Vec::new(), Compression::fast());
    let packed = packer
        .write_all(json.as_bytes())
        .and_then(|()| packer.finish())
        .expect("memory takes all bytes");
    ("application/zlib", STANDARD.encode(packed))
}

/// JSON in which no markup begins or ends, to stand in a script element.
fn embedded(value: &impl Serialize) -> String {
    let json =
        serde_json::to_string(value).expect("a page holds numbers and texts under text keys");
    let mut out = String::with_capacity(json.len() + json.len() / 16);
    for letter in json.chars() {
        match letter {
            // these stand only in texts
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                write!(out, "\\u{:04x}", u32::from(letter)).expect("a string takes all text");
            }
            _ => out.push(letter),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finding(k: usize) -> Finding {
        Finding {
            id: if k.is_multiple_of(2) { "even" } else { "odd" },
            severity: if k == 99_999 {
                Severity::Error
            } else {
                Severity::Note
            },
            file: "</script><script>alert(1)</script>".into(),
            line: k,
            column: 1,
            message: format!("\u{2028}\"quoted\" & <b>bold</b> \u{fc} {k}"),
            hint: String::new(),
            accepted: false,
        }
    }

    #[test]
    fn names_that_are_markup_stay_text() {
        let evil = "</title><script>alert('x')</script>\"&";
        let mut page = Page::new(evil.into(), Level::Error, evil.into());
        page.lead.push(evil.into());
        page.fact(evil, evil.into());
        page.findings(&[finding(1)]);
        let html = page.html("today: poseshift");
        // the two script elements are the data and the program itself
        assert_eq!(html.matches("<script").count(), 2);
        assert_eq!(html.matches("</script").count(), 2);
        assert!(!html.contains("<b>bold"));
        assert!(!html.contains('\u{2028}'));
    }

    #[test]
    fn the_policy_names_the_script_that_the_page_has() {
        let html = Page::new("t".into(), Level::Good, "fine".into()).html("");
        let script = html
            .rsplit_once("<script>")
            .and_then(|(_, rest)| rest.split_once("</script>"))
            .expect("a script")
            .0;
        assert!(html.contains(&format!("script-src '{}'", hash(script))));
        assert!(!script.contains("</script"), "the script would end itself");
    }

    /// The data of a page, whether they are packed or not.
    fn data(html: &str) -> String {
        let between = |from: &str| Some(html.split_once(from)?.1.split_once("</script>")?.0);
        if let Some(json) = between(r#"<script type="application/json" id="data">"#) {
            return json.to_owned();
        }
        let packed = between(r#"<script type="application/zlib" id="data">"#).expect("data");
        let packed = STANDARD.decode(packed).expect("base64");
        let mut json = String::new();
        std::io::Read::read_to_string(&mut flate2::read::ZlibDecoder::new(&packed[..]), &mut json)
            .expect("zlib");
        json
    }

    #[test]
    fn of_very_many_findings_the_worst_are_kept_and_all_are_counted() {
        let findings: Vec<Finding> = (0..100_000).map(finding).collect();
        let mut page = Page::new("t".into(), Level::Error, "no".into());
        page.findings(&findings);
        let table = &page.tables["findings"];
        assert_eq!(table.rows(), MOST_FINDINGS);
        let html = page.html("today: poseshift");
        let data = data(&html);
        assert!(data.contains("50000 even, 50000 odd"));
        assert!(data.contains("99999"), "the only error is listed");
        assert!(html.len() < 1_500_000, "{}", html.len());
    }

    #[test]
    fn findings_that_say_the_same_are_one_row_with_their_number() {
        let mut findings: Vec<Finding> = (0..2_593)
            .map(|k| Finding {
                message: "the same".into(),
                ..finding(2 * k)
            })
            .collect();
        findings.push(finding(99_999));
        let mut page = Page::new("t".into(), Level::Error, "no".into());
        page.findings(&findings);
        let table = &page.tables["findings"];
        assert_eq!(table.rows(), 2);
        let counts = table.columns.iter().find(|c| c.label == "count");
        let counts = serde_json::to_string(&counts.expect("counts").values).expect("JSON");
        assert_eq!(counts, "[1,2593]", "the error first");
    }

    #[test]
    fn data_of_any_length_are_what_the_page_holds() {
        for count in [1, MOST_FINDINGS] {
            let findings: Vec<Finding> = (0..count).map(finding).collect();
            let mut page = Page::new("t".into(), Level::Error, "no".into());
            page.findings(&findings);
            let html = page.html("today: poseshift");
            assert_eq!(data(&html), embedded(&page));
            assert_eq!(html.contains(r#"type="application/zlib""#), count > 1);
            assert_eq!(html.matches("</script").count(), 2);
        }
    }
}
