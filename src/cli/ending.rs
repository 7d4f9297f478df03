//! What a command does with its result: files, a page, then JSON alone, or findings and text.

use super::files::{Files, NewFile, is_standard_output};
use super::progress::Progress;
use super::screen::{self, Stop};
use super::{Answer, Output, layout};
use crate::geometry::Convention;
use crate::printable::{name_of, shell_word};
use crate::report::html::page::Page;
use crate::report::{Report, Style};
use crate::task::{Document, Failure};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::ffi::OsString;
use std::io::{self, BufWriter, Cursor, Read, Seek};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, SystemTime};
use tempfile::SpooledTempFile;

/// Bytes of a document that wait in memory.
const IN_MEMORY: usize = 16 << 20;

/// The page that is asked for.
#[derive(Args)]
pub(super) struct ReportFile {
    /// Write a report to look at: one HTML file with views, charts and tables that needs no
    /// network
    #[arg(long = "report", value_name = "FILE.html")]
    file: Option<PathBuf>,
}

impl ReportFile {
    /// Whether there is one to write.
    pub(super) fn is_wanted(&self) -> bool {
        self.file.is_some()
    }

    /// Neither the report nor another output may take the place of what was read, nor of one
    /// another.
    pub(super) fn refuse_over<'a>(
        &'a self,
        files: &Files,
        outputs: impl IntoIterator<Item = &'a Path>,
    ) -> Result<(), Failure> {
        files.refuse_over(outputs.into_iter().chain(self.file.as_deref()))
    }

    /// The page as one more output.
    pub(super) fn output(&self, page: Option<&Page>) -> Option<NewFile<'static>> {
        let file = self.file.as_ref()?;
        Some((file.clone(), page?.html(&made()).into_bytes().into()))
    }

    /// Its name.
    pub(super) fn name(&self) -> Option<String> {
        self.file.as_deref().map(name_of)
    }

    /// What is said when it is written.
    pub(super) fn written(&self) -> String {
        let line = |name: String| format!("report written to {name}\n");
        self.name().map_or(String::new(), line)
    }
}

/// When a page is made, and by which command line. `SOURCE_DATE_EPOCH`, seconds since 1970, takes
/// the place of the time, so that the same run gives the same bytes.
fn made() -> String {
    let given = std::env::var("SOURCE_DATE_EPOCH").ok();
    let given = given.and_then(|seconds| seconds.parse().ok());
    let now = given.map_or_else(SystemTime::now, |seconds| {
        SystemTime::UNIX_EPOCH + Duration::from_secs(seconds)
    });
    let date = humantime::format_rfc3339_seconds(now).to_string();
    let words = WORDS.lock().unwrap_or_else(PoisonError::into_inner);
    let words = words
        .iter()
        .map(|word| shell_word(&word.to_string_lossy()).into_owned());
    let words: Vec<String> = words.collect();
    format!("{date}: poseshift {}", words.join(" "))
}

/// The command line without the program's name: pages say it.
static WORDS: Mutex<Vec<OsString>> = Mutex::new(Vec::new());

/// Keeps the command line that is run.
pub(super) fn remember(arguments: &[OsString]) {
    let words = arguments.iter().skip(1).cloned().collect();
    *WORDS.lock().unwrap_or_else(PoisonError::into_inner) = words;
}

/// How frames are shown besides.
#[derive(Args, Clone, Copy, Default)]
pub(super) struct Pendant {
    /// Show frames as this maker's teach pendant does, too
    #[arg(long, value_name = "MAKER", value_parser = convention())]
    convention: Option<Convention>,
}

/// One of the conventions, by its name.
fn convention() -> impl TypedValueParser<Value = Convention> {
    let of = |name: &str| Convention::ALL.into_iter().find(|c| c.id() == name);
    PossibleValuesParser::new(Convention::ALL.map(Convention::id))
        .map(move |name| of(&name).expect("one of the names"))
}

impl Pendant {
    /// The frames of a result, by name.
    fn frames(self, found: &impl Report) -> Vec<(String, String)> {
        let Some(convention) = self.convention else {
            return Vec::new();
        };
        let frames = found.frames().into_iter();
        frames
            .map(|(name, pose)| (name, convention.shown(&(&pose).into())))
            .collect()
    }

    /// They as lines.
    fn text(self, found: &impl Report) -> String {
        let Some(convention) = self.convention else {
            return String::new();
        };
        let frames = self.frames(found).into_iter();
        let lines = frames.map(|(name, shown)| format!("  {name}: {shown}\n"));
        let lines: String = lines.collect();
        if lines.is_empty() {
            return lines;
        }
        layout::fitted(&format!(
            "as a teach pendant shows it ({}):\n{lines}",
            convention.id()
        ))
    }
}

/// Which findings are shown without `--verbose`.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shown {
    /// Every one.
    All,
    /// Errors and warnings, and of many alike the first.
    Main,
}

/// How a command ends.
pub(super) struct Ending<'a> {
    /// The files that it writes, the page apart.
    pub written: Vec<NewFile<'a>>,
    /// The page that is asked for.
    pub report: Option<&'a ReportFile>,
    /// Which findings are shown.
    pub shown: Shown,
    /// What is said behind the text.
    pub also: &'a str,
    /// How frames are shown besides.
    pub pendant: Pendant,
    /// What the exit status says.
    pub answer: Answer,
    /// What is drawn until the result is printed.
    pub progress: Option<Progress>,
}

impl Default for Ending<'_> {
    fn default() -> Self {
        Self {
            written: Vec::new(),
            report: None,
            shown: Shown::Main,
            also: "",
            pendant: Pendant::default(),
            answer: Answer::Yes,
            progress: None,
        }
    }
}

/// What is printed.
#[derive(Default)]
pub(super) struct Said {
    /// For people, to standard output; to standard error where that is taken by what programs
    /// read.
    pub text: String,
    /// For programs, to standard output.
    pub data: Option<Box<dyn Read>>,
    /// For people, to standard error.
    pub errors: String,
}

impl Said {
    /// A text for people.
    pub(super) fn text(text: String) -> Self {
        Self {
            text,
            ..Self::default()
        }
    }

    /// What programs read.
    pub(super) fn data(data: impl Into<Vec<u8>>) -> Self {
        Self {
            data: Some(Box::new(Cursor::new(data.into()))),
            ..Self::default()
        }
    }

    /// The document as programs read it: what is long waits on disk until it is printed.
    pub(super) fn json(document: &impl Document) -> Result<Self, Failure> {
        let spool = || {
            let mut out = BufWriter::new(SpooledTempFile::new(IN_MEMORY));
            document.write_json(&mut out)?;
            let mut spool = out.into_inner().map_err(io::IntoInnerError::into_error)?;
            spool.rewind()?;
            Ok(spool)
        };
        let spool = spool().map_err(|error: io::Error| {
            let folder = std::env::temp_dir();
            Failure::with_hint(
                format!("cannot keep the JSON in {}: {error}", name_of(&folder)),
                "TMPDIR names another folder",
            )
        })?;
        Ok(Self {
            data: Some(Box::new(spool)),
            ..Self::default()
        })
    }

    fn print(self) -> Result<(), Stop> {
        screen::print_errors(&self.errors)?;
        match self.data {
            Some(mut data) => {
                screen::print_errors(&self.text)?;
                screen::print_data(&mut *data)
            }
            None => screen::print(&self.text),
        }
    }
}

/// Writes files and prints, both or neither. A reader that has gone changes no answer but to worse.
pub(super) fn deliver(
    files: &Files,
    written: &[NewFile],
    said: Said,
    answer: Answer,
) -> Result<Answer, Failure> {
    deliver_verified(files, written, || Ok(()), said, answer)
}

/// As [`deliver`], where `verify` must not fail: it runs while the files are made.
pub(super) fn deliver_verified(
    files: &Files,
    written: &[NewFile],
    verify: impl FnOnce() -> Result<(), Failure> + Send,
    mut said: Said,
    answer: Answer,
) -> Result<Answer, Failure> {
    if let Some((_, bytes)) = written.iter().find(|(path, _)| is_standard_output(path)) {
        if said.data.is_some() {
            return Err(Failure::with_hint(
                "an output and the result would both be written to standard output",
                "name a file for the output",
            ));
        }
        said.data = Some(Box::new(Cursor::new(bytes.to_vec())));
    }
    match files.write(written, verify, || said.print()) {
        Ok(()) => Ok(answer),
        Err(Stop::Closed(_)) if answer == Answer::No => Ok(answer),
        Err(stop) => Err(stop.into()),
    }
}

/// Writes the files and the page, all or none, and prints the JSON alone, or findings to standard
/// error and the text to standard output.
pub(super) fn finish(
    files: &Files,
    found: &impl Report,
    ending: Ending,
    output: Output,
) -> Result<Answer, Failure> {
    let written = ending.report.map_or_else(String::new, ReportFile::written);
    let said = if output.json {
        Said::json(found)?
    } else if output.quiet {
        Said {
            errors: findings(found, ending.shown, output),
            ..Said::default()
        }
    } else {
        Said {
            text: layout::fitted(&text(found, output))
                + &ending.pendant.text(found)
                + ending.also
                + &written,
            errors: findings(found, ending.shown, output),
            data: None,
        }
    };
    deliver_with_page(files, found, ending, said)
}

/// As [`finish`] of a result whose answer is printed alone: everything else goes to standard error.
pub(super) fn finish_with_data(
    files: &Files,
    found: &impl Report,
    data: String,
    ending: Ending,
    output: Output,
) -> Result<Answer, Failure> {
    let mut errors = findings(found, ending.shown, output);
    if !output.quiet {
        errors += &text(found, output);
        errors += &ending.pendant.text(found);
        errors += &ending.report.map_or_else(String::new, ReportFile::written);
    }
    let said = Said {
        errors,
        ..Said::data(data)
    };
    deliver_with_page(files, found, ending, said)
}

fn deliver_with_page(
    files: &Files,
    found: &impl Report,
    ending: Ending,
    said: Said,
) -> Result<Answer, Failure> {
    let mut written = ending.written;
    if let Some(report) = ending.report.filter(|report| report.is_wanted()) {
        let mut page = found.page();
        if let Some(page) = &mut page {
            for (name, shown) in ending.pendant.frames(found) {
                page.fact(&format!("{name}, as a teach pendant shows it"), shown);
            }
        }
        written.extend(report.output(page.as_ref()));
    }
    drop(ending.progress);
    deliver(files, &written, said, ending.answer)
}

/// What should be looked at, as standard error gets it.
pub(super) fn findings(found: &impl Report, shown: Shown, output: Output) -> String {
    if output.quiet {
        layout::findings_of_errors(&layout::errors(found.findings()), true)
    } else {
        layout::findings_of_errors(found.findings(), output.verbose || shown == Shown::All)
    }
}

fn text(found: &impl Report, output: Output) -> String {
    found.text(Style {
        width: layout::width(),
        every: output.verbose,
    })
}

/// Prints a table that is the result itself, whole lines and whatever else is asked for; with
/// `--json` the document.
pub(super) fn print_table(
    found: &impl Report,
    output: Output,
    answer: Answer,
) -> Result<Answer, Failure> {
    let said = if output.json {
        Said::json(found)?
    } else {
        Said {
            errors: findings(found, Shown::Main, output),
            ..Said::data(found.text(Style {
                width: usize::MAX,
                every: true,
            }))
        }
    };
    deliver(&Files::default(), &[], said, answer)
}

/// Prints a JSON Schema.
pub(super) fn print_schema(schema: &serde_json::Value) -> Result<Answer, Failure> {
    Ok(screen::print_data(&mut format!("{schema:#}\n").as_bytes()).map(|()| Answer::Yes)?)
}
