//! What is told when a command could not do its work: exit status 2.

use super::layout;
use crate::model::profile::ProfileError;
use crate::program::Source;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use std::path::Path;

/// Why a command could not do its work.
pub enum Failure {
    /// A message with its way out.
    Plain {
        /// What went wrong.
        message: String,
        /// The way out, or empty.
        hint: String,
    },
    /// A place in a text file is to blame.
    Excerpt(Excerpt),
    /// Standard output is closed.
    Pipe,
}

/// One line of a text file and what in it is to blame.
pub struct Excerpt {
    message: String,
    hint: String,
    file: String,
    /// Line number, from 1.
    line: usize,
    text: String,
    span: std::ops::Range<usize>,
}

/// Bytes of a long line that are shown before and behind the place.
const AROUND: usize = 120;

impl Failure {
    /// A message alone.
    pub fn new(message: impl Into<String>) -> Self {
        Self::with_hint(message, "")
    }

    /// A message and the way out.
    pub fn with_hint(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::Plain {
            message: message.into(),
            hint: hint.into(),
        }
    }

    /// A file that could not be read or written.
    pub fn file(path: &Path, doing: &str, error: &std::io::Error) -> Self {
        Self::new(format!("cannot {doing} {}: {error}", path.display()))
    }

    /// Standard output that could not be written.
    #[allow(clippy::needless_pass_by_value)]
    pub fn output(error: std::io::Error) -> Self {
        if error.kind() == std::io::ErrorKind::BrokenPipe {
            Self::Pipe
        } else {
            Self::new(format!("cannot write to standard output: {error}"))
        }
    }

    /// A fault of a profile, with its line.
    pub fn profile(path: &Path, text: &str, error: &ProfileError) -> Self {
        let source = Source::new(path.display().to_string(), text.as_bytes().to_vec());
        let length = error.span.map(|(start, end)| end.saturating_sub(start));
        Self::at(
            &source,
            error.line,
            error.column,
            length,
            error.fault.to_string(),
            error.hint(),
        )
    }

    /// A place in a file by line and column; the whole file where the line is 0.
    pub fn at(
        source: &Source,
        line: usize,
        column: usize,
        length: Option<usize>,
        message: String,
        hint: String,
    ) -> Self {
        let file = source.name.clone();
        let Some(bytes) = line.checked_sub(1).and_then(|index| source.line(index)) else {
            return Self::Plain {
                message: format!("{file}: {message}"),
                hint,
            };
        };
        let at = column.saturating_sub(1).min(bytes.len());
        let at = at + bytes[at..].iter().take_while(|b| **b == b' ').count();
        let word = bytes[at..]
            .iter()
            .take_while(|b| !b.is_ascii_whitespace() && !b",;[]{}()".contains(b))
            .count();
        let end = (at + length.unwrap_or(word).max(1)).min(bytes.len());
        // columns count bytes: each byte that is no ASCII is shown as one sign
        let (from, to) = (at.saturating_sub(AROUND), (end + AROUND).min(bytes.len()));
        let shown = |b: &u8| {
            if b.is_ascii_graphic() || *b == b' ' {
                char::from(*b)
            } else {
                '\u{b7}'
            }
        };
        let text: String = bytes[from..to].iter().map(shown).collect();
        let place = |byte: usize| {
            text.char_indices()
                .nth(byte - from)
                .map_or(text.len(), |(index, _)| index)
        };
        let span = place(at)..place(end);
        Self::Excerpt(Excerpt {
            message,
            hint,
            file,
            line,
            text,
            span,
        })
    }

    /// The text for standard error.
    pub fn render(&self) -> String {
        let (message, hint, excerpt) = match self {
            Self::Pipe => return String::new(),
            Self::Plain { message, hint } => (message, hint, None),
            Self::Excerpt(excerpt) => (&excerpt.message, &excerpt.hint, Some(excerpt)),
        };
        let (message, hint) = (&broken(message, "error: "), &broken(hint, " = help: "));
        let title = Level::ERROR.primary_title(message);
        let group = match excerpt {
            None => annotate_snippets::Group::with_title(title),
            Some(Excerpt {
                file,
                line,
                text,
                span,
                ..
            }) => {
                let annotation = AnnotationKind::Primary.span(span.clone());
                title.element(
                    Snippet::source(text)
                        .path(file)
                        .line_start(*line)
                        .annotation(annotation),
                )
            }
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
}

/// A text broken where somebody sees it, with room for what stands before it.
fn broken(text: &str, before: &str) -> String {
    match layout::seen_of_errors() {
        Some(width) => layout::flush(text, width.saturating_sub(before.len())),
        None => text.to_owned(),
    }
}
