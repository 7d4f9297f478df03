//! What is said on standard error when a command could not do its work.

use super::layout;
use crate::printable::printable_lines;
use crate::report::layout::flush;
use crate::task::{Blame, Failure};
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

/// How a fault of poseshift itself is reported.
pub(super) const REPORT_IT: &str = "this is a fault of poseshift, nothing is written: please \
    report it with the line above, the \
                             command, its files, and what `poseshift --version` says";

/// The text for standard error.
pub(super) fn render(failure: &Failure) -> String {
    let (label, hint) = match failure.blame {
        Blame::Given => ("error: ", failure.hint.as_str()),
        Blame::Program => ("internal error: ", REPORT_IT),
    };
    let (message, hint) = (printable_lines(&failure.message), printable_lines(hint));
    let (message, hint) = (&broken(&message, label), &broken(&hint, " = help: "));
    let level = match failure.blame {
        Blame::Given => Level::ERROR,
        Blame::Program => Level::ERROR.with_name("internal error"),
    };
    let title = level.primary_title(message);
    let group = match &failure.place {
        None => Group::with_title(title),
        Some(place) => title.element(
            Snippet::source(&place.text)
                .path(&place.file)
                .line_start(place.line)
                .annotation(AnnotationKind::Primary.span(place.span.clone())),
        ),
    };
    let group = if hint.is_empty() {
        group
    } else {
        group.element(Level::HELP.message(hint))
    };
    Renderer::styled()
        .term_width(layout::seen_of_errors().unwrap_or(140))
        .render(&[group])
}

/// A text broken where somebody sees it, with room for what stands before it.
fn broken(text: &str, before: &str) -> String {
    match layout::seen_of_errors() {
        Some(width) => flush(text, width.saturating_sub(before.len())),
        None => text.to_owned(),
    }
}
