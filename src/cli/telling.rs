//! What a command does with its result: files, a page, then JSON alone, or findings and text.

use super::{Output, layout, print};
use crate::finding::Severity;
use crate::report::html::page::Page;
use crate::report::{Report, Style};
use crate::task::{Failure, files};
use clap::Args;
use std::path::{Path, PathBuf};

/// The page that is asked for.
#[derive(Args)]
pub(super) struct ReportFile {
    /// Write a report to look at: one HTML file with views, charts and tables that needs no network
    #[arg(long = "report", value_name = "FILE.html")]
    file: Option<PathBuf>,
}

impl ReportFile {
    /// Whether there is one to write.
    pub(super) fn is_wanted(&self) -> bool {
        self.file.is_some()
    }

    /// Neither the report nor another output may take the place of what is read, nor of one another.
    pub(super) fn refuse_over<'a>(
        &'a self,
        inputs: impl IntoIterator<Item = &'a Path>,
        outputs: impl IntoIterator<Item = &'a Path>,
    ) -> Result<(), Failure> {
        let own = self.file.iter().map(PathBuf::as_path);
        files::refuse_over(inputs, outputs.into_iter().chain(own))
    }

    /// The page as one more output.
    pub(super) fn output(&self, page: Option<&Page>) -> Option<(PathBuf, Vec<u8>)> {
        let file = self.file.as_ref()?;
        Some((file.clone(), page?.html().into_bytes()))
    }

    /// Its name.
    pub(super) fn name(&self) -> Option<String> {
        self.file.as_ref().map(|file| file.display().to_string())
    }

    /// What is told when it is written.
    pub(super) fn told(&self) -> String {
        let told = |file: &PathBuf| format!("report written to {}\n", file.display());
        self.file.as_ref().map_or(String::new(), told)
    }
}

/// A file to write.
pub(super) type File = (PathBuf, Vec<u8>);

/// Which findings are told without `--verbose`.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Told {
    /// Every one.
    All,
    /// Errors and warnings, and of many alike the first.
    Main,
}

/// Writes the files and the page, all or none, then prints the JSON alone, or findings to standard error and the text to
/// standard output. `also` is told after the text.
pub(super) fn finish(
    found: &impl Report,
    written: Vec<File>,
    report: Option<&ReportFile>,
    (told, also): (Told, &str),
    output: Output,
) -> Result<(), Failure> {
    write(found, written, report)?;
    if output.json {
        return print(&found.json());
    }
    print_findings(found, told, output);
    if output.quiet {
        return Ok(());
    }
    layout::print_text(&text(found, output))?;
    print(also)?;
    print(&report.map_or_else(String::new, ReportFile::told))
}

/// As [`finish`] of a result whose answer is printed alone: everything else goes to standard error.
pub(super) fn finish_beside(
    found: &impl Report,
    written: Vec<File>,
    report: Option<&ReportFile>,
    output: Output,
) -> Result<(), Failure> {
    write(found, written, report)?;
    print_findings(found, Told::Main, output);
    if !output.quiet {
        let report = report.map_or_else(String::new, ReportFile::told);
        anstream::eprint!("{}{report}", text(found, output));
    }
    Ok(())
}

fn write(
    found: &impl Report,
    mut written: Vec<File>,
    report: Option<&ReportFile>,
) -> Result<(), Failure> {
    if let Some(report) = report.filter(|report| report.is_wanted()) {
        written.extend(report.output(found.page().as_ref()));
    }
    files::write_all(&written)
}

fn print_findings(found: &impl Report, told: Told, output: Output) {
    if output.quiet {
        let mut errors = found.findings().to_vec();
        errors.retain(|finding| finding.severity == Severity::Error);
        layout::print_findings(&errors, true);
    } else {
        layout::print_findings(found.findings(), output.verbose || told == Told::All);
    }
}

fn text(found: &impl Report, output: Output) -> String {
    found.text(Style {
        width: layout::width(),
        every: output.verbose,
    })
}

/// Prints a table that is the result itself, whole lines and whatever else is asked for; with `--json` the document.
pub(super) fn print_table(found: &impl Report, output: Output) -> Result<(), Failure> {
    if output.json {
        return print(&found.json());
    }
    print(&found.text(Style {
        width: usize::MAX,
        every: true,
    }))
}

/// Prints a JSON Schema.
pub(super) fn print_schema(schema: &serde_json::Value) -> Result<(), Failure> {
    print(&format!("{schema:#}\n"))
}
