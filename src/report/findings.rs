//! Findings as lines of text.

use super::layout::{BLUE, PLAIN, RED, YELLOW};
use crate::finding::{Finding, Severity};
use crate::printable::printable;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Findings of one name that are shown before the rest is only counted.
const SHOWN: usize = 5;

/// One line a finding, `file:line:column: severity[id]: message`, with its hint once a name. Where
/// `every` is false, notes are left out and of many findings of one name the first are shown and
/// the rest is counted.
#[must_use]
pub(crate) fn text(findings: &[Finding], every: bool) -> String {
    let mut out = String::new();
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    let shown = |finding: &&Finding| every || finding.severity > Severity::Note;
    for finding in findings.iter().filter(shown) {
        let count = seen.entry(finding.id).or_default();
        *count += 1;
        if every || *count <= SHOWN {
            line(finding, *count == 1, &mut out);
        }
    }
    for (id, count) in seen.iter().filter(|(_, count)| !every && **count > SHOWN) {
        let rest = count - SHOWN;
        writeln!(out, "… and {rest} more {id} (-v or --json shows all)")
            .expect("a string takes all text");
    }
    out
}

fn line(finding: &Finding, with_hint: bool, out: &mut String) {
    let Finding {
        id,
        severity,
        file,
        line,
        column,
        message,
        hint,
        accepted,
    } = finding;
    let (colour, word) = match severity {
        _ if *accepted => (YELLOW, "accepted"),
        Severity::Error => (RED, "error"),
        Severity::Warning => (YELLOW, "warning"),
        Severity::Note => (BLUE, "note"),
    };
    // one line stays one, whatever a name in it holds
    let (message, hint) = (printable(message), printable(hint));
    let place = if *line == 0 {
        file.clone()
    } else {
        format!("{file}:{line}:{column}")
    };
    writeln!(out, "{place}: {colour}{word}{PLAIN}[{id}]: {message}")
        .expect("a string takes all text");
    if with_hint && !hint.is_empty() {
        writeln!(out, "    {hint}").expect("a string takes all text");
    }
}
