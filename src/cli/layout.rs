//! How wide the output is: `COLUMNS` where it is set, else the terminal, else 80. The one place
//! that knows it.

use super::Output;
use crate::finding::{Finding, Severity};
use crate::report;
use crate::report::layout::wrapped_lines;

/// Columns where nothing gives them: of a pipe or a file, so that the same text is written
/// everywhere.
const UNKNOWN: usize = 80;
/// Fewer columns than the first are not laid out for; more than the last are hard to read.
const LEAST_AND_MOST: (usize, usize) = (40, 100);

fn bounded(columns: usize) -> usize {
    columns.clamp(LEAST_AND_MOST.0, LEAST_AND_MOST.1)
}

fn given() -> Option<usize> {
    std::env::var("COLUMNS").ok().and_then(|n| n.parse().ok())
}

/// Columns of standard output.
pub(super) fn width() -> usize {
    seen().unwrap_or(UNKNOWN)
}

/// Columns of standard output where somebody sees it.
fn seen() -> Option<usize> {
    let terminal = || terminal_size::terminal_size_of(std::io::stdout());
    given()
        .or_else(|| terminal().map(|(width, _)| usize::from(width.0)))
        .map(bounded)
}

/// Columns of standard error where somebody sees it.
pub(super) fn seen_of_errors() -> Option<usize> {
    let terminal = || terminal_size::terminal_size_of(std::io::stderr());
    given()
        .or_else(|| terminal().map(|(width, _)| usize::from(width.0)))
        .map(bounded)
}

/// Every line of a text broken to the columns of standard output.
pub(super) fn fitted(text: &str) -> String {
    wrapped_lines(text, width())
}

/// Findings for standard output. Where nobody sees them a finding is one line, for `grep` and
/// editors. Quiet output has the errors alone.
pub(super) fn findings(findings: &[Finding], output: Output) -> String {
    if !output.quiet {
        return of_findings(findings, output.verbose, seen());
    }
    of_findings(&errors(findings), output.verbose, seen())
}

/// The errors alone.
pub(super) fn errors(findings: &[Finding]) -> Vec<Finding> {
    let is_error = |finding: &&Finding| finding.severity == Severity::Error;
    findings.iter().filter(is_error).cloned().collect()
}

/// Findings for standard error, as [`findings`] has them.
pub(super) fn findings_of_errors(findings: &[Finding], every: bool) -> String {
    of_findings(findings, every, seen_of_errors())
}

fn of_findings(findings: &[Finding], every: bool, width: Option<usize>) -> String {
    let text = report::findings::text(findings, every);
    match width {
        Some(width) => wrapped_lines(&text, width),
        None => text,
    }
}
