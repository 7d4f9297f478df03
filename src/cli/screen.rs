//! Standard output and standard error: the one place that writes there, and that keeps control
//! characters of files from them.

use super::files::Identity;
use crate::printable::printable_lines;
use crate::report::layout::coloured;
use crate::task::Failure;
use std::io::{ErrorKind, IsTerminal, Read, Result, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether standard error leads onto a file that is read.
static IS_MUTE: AtomicBool = AtomicBool::new(false);

/// Says nothing on standard error from now on: it would damage a file that is read.
pub(super) fn mute_errors() {
    IS_MUTE.store(true, Ordering::Relaxed);
}

/// Why a text did not arrive.
pub(super) enum Stop {
    /// Whoever read it has gone.
    Closed(&'static str),
    /// Something else.
    Failed(Failure),
}

impl From<Failure> for Stop {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

impl From<Stop> for Failure {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Closed(whither) => Self::with_hint(
                format!("{whither} was closed before all was printed"),
                "nothing is written",
            ),
            Stop::Failed(failure) => failure,
        }
    }
}

fn arrived(whither: &'static str, written: Result<()>) -> std::result::Result<(), Stop> {
    written.map_err(|error| match error.kind() {
        ErrorKind::BrokenPipe => Stop::Closed(whither),
        _ => Stop::Failed(Failure::with_hint(
            format!("cannot write to {whither}: {error}"),
            "nothing is written",
        )),
    })
}

/// A text as people get it.
fn for_people(text: &str) -> String {
    coloured(&printable_lines(text))
}

/// Prints a text for people to standard output.
pub(super) fn print(text: &str) -> std::result::Result<(), Stop> {
    let mut out = anstream::stdout().lock();
    let written = out.write_all(for_people(text).as_bytes());
    arrived("standard output", written.and_then(|()| out.flush()))
}

/// Prints what programs read to standard output, byte by byte; where people see it as they may see
/// it.
pub(super) fn print_data(data: &mut dyn Read) -> std::result::Result<(), Stop> {
    let mut out = std::io::stdout().lock();
    let written = if out.is_terminal() {
        let mut bytes = Vec::new();
        data.read_to_end(&mut bytes).and_then(|_| {
            let text = String::from_utf8_lossy(&bytes);
            out.write_all(printable_lines(&text).as_bytes())
        })
    } else {
        std::io::copy(data, &mut out).map(drop)
    };
    arrived("standard output", written.and_then(|()| out.flush()))
}

/// Prints a text for people to standard error.
pub(super) fn print_errors(text: &str) -> std::result::Result<(), Stop> {
    if IS_MUTE.load(Ordering::Relaxed) {
        return Ok(());
    }
    let mut out = anstream::stderr().lock();
    arrived("standard error", out.write_all(for_people(text).as_bytes()))
}

/// Says on standard error what concerns no result.
pub(super) fn warn(line: &str) {
    // where nobody can hear it, nobody does
    let _ = print_errors(&format!("warning: {line}\n"));
}

/// Says on standard error why the program ends.
pub(super) fn complain(failure: &Failure) {
    let text = super::failure::render(failure);
    // where nobody can hear it, the exit status says it
    let _ = if IS_MUTE.load(Ordering::Relaxed) {
        let is_apart = Identity::of_standard_output() != Identity::of_standard_error();
        is_apart.then(|| writeln!(anstream::stdout().lock(), "{text}"))
    } else {
        Some(writeln!(anstream::stderr().lock(), "{text}"))
    };
}

/// Prints what the parser of the command line says; the exit status.
pub(super) fn print_usage(error: &clap::Error) -> u8 {
    let plain = error.render().to_string();
    let printed = if printable_lines(&plain) == plain {
        error.print()
    } else {
        std::io::stderr().write_all(printable_lines(&plain).as_bytes())
    };
    if !error.use_stderr() && printed.and_then(|()| std::io::stdout().flush()).is_ok() {
        0
    } else {
        2
    }
}
