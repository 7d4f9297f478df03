//! The texts of `robots`, `effects`, `languages` and `explain`.

use crate::finding::Severity;
use crate::report::Style;
use crate::task::catalogue::{Effects, Languages, Origin, Robots};
use crate::task::explain::Explanations;

pub(super) fn robots(found: &Robots, _: Style) -> String {
    let mut text = String::new();
    let width = found.robots.iter().map(|r| r.name.len()).max();
    let width = width.unwrap_or(0);
    for r in &found.robots {
        let calibrated = if r.effects == 0 { "" } else { ", calibrated" };
        let profile = match r.origin {
            Origin::Profile => ", data sheet",
            Origin::Catalogue => "",
        };
        text += &format!(
            "{:width$} {} {} ({}{calibrated}{profile})\n",
            r.name, r.manufacturer, r.model, r.closed_form_inverse
        );
    }
    text += &format!(
        "{} robots; where no data sheet is named the numbers are those of one public file: set the \
         limits from the data sheet\n",
        found.robots.len()
    );
    text + "`poseshift profile new --robot NAME` starts a profile from one of them\n"
}

pub(super) fn effects(found: &Effects, _: Style) -> String {
    let mut text = String::new();
    for e in &found.effects {
        let keys = e.parameters.iter().map(|p| p.key);
        let keys: Vec<&str> = e.site.iter().copied().chain(keys).collect();
        text += &format!(
            "{}\n  {}\n  keys: {}\n  {}\n",
            e.effect,
            e.summary,
            keys.join(", "),
            e.equation
        );
        text.extend(e.needs.iter().map(|need| format!("  needs {need}\n")));
        text += &format!("  source: {}\n\n", e.source);
    }
    text
}

pub(super) fn languages(found: &Languages, _: Style) -> String {
    let mut text = String::new();
    for l in &found.languages {
        text += &format!("{}  {} (.{})\n", l.id, l.name, l.extensions.join(" ."));
        for (what, items) in [
            ("rewrites", l.rewrites),
            ("leaves", l.leaves),
            ("refuses", l.refuses),
        ] {
            text += &format!("  {what}\n");
            text.extend(items.iter().map(|item| format!("    {item}\n")));
        }
        text += &format!("  finds\n    {}\n", l.findings.join(", "));
    }
    text
}

pub(super) fn explanations(found: &Explanations, _: Style) -> String {
    let mut text = String::new();
    for f in &found.findings {
        let severity = match f.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        };
        text += &format!(
            "{} ({severity})\n  {}\n  {}\n  found by {}",
            f.id,
            f.meaning,
            f.remedy,
            f.commands.join(", ")
        );
        if !f.languages.is_empty() {
            text += &format!("; in {}", f.languages.join(", "));
        }
        if f.acceptable {
            text += "; --accept takes it";
        }
        if !f.was.is_empty() {
            text += &format!("; earlier called {}", f.was.join(", "));
        }
        text.push('\n');
    }
    text
}
