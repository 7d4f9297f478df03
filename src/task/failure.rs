//! Why a task could not be done, as data: a message, the way out, and the place in a text that is
//! to blame.

use crate::model::profile::ProfileError;
use crate::printable::name_of;
use crate::program::Source;
use std::ops::Range;
use std::path::Path;

/// Whose fault a [`Failure`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blame {
    /// What was given: arguments, files, too few data (exit status 2).
    Given,
    /// poseshift itself (exit status 3).
    Program,
}

/// Why a task could not be done.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Failure {
    /// What went wrong, with the value and the limit.
    pub message: String,
    /// The way out; empty where there is none.
    pub hint: String,
    /// The place in a text that is to blame.
    pub place: Option<Excerpt>,
    /// Whose fault it is.
    pub blame: Blame,
}

/// One line of a text and what in it is to blame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// The file as the user named it.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in bytes, from 1.
    pub column: usize,
    /// The line, or what is around the place in a long one; each byte that is no ASCII is shown as
    /// one sign.
    pub text: String,
    /// What in `text` is to blame, in bytes.
    pub span: Range<usize>,
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
        Self {
            message: message.into(),
            hint: hint.into(),
            place: None,
            blame: Blame::Given,
        }
    }

    /// What can only be a fault of poseshift.
    pub fn internal(message: impl Into<String>) -> Self {
        Self {
            blame: Blame::Program,
            ..Self::new(message)
        }
    }

    /// A file that could not be read or written.
    pub fn file(path: &Path, doing: &str, error: &std::io::Error) -> Self {
        Self::new(format!("cannot {doing} {}: {error}", name_of(path)))
    }

    /// A fault of a profile, with its line.
    pub fn profile(name: &str, text: &str, error: &ProfileError) -> Self {
        let source = Source::new(name, text.as_bytes().to_vec());
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

    /// A place in a text by line and column, from 1, and its length in bytes; the whole text where
    /// the line is 0.
    pub fn at(
        source: &Source,
        line: usize,
        column: usize,
        length: Option<usize>,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Self {
        let (message, file) = (message.into(), source.name.clone());
        let Some(bytes) = line.checked_sub(1).and_then(|index| source.line(index)) else {
            return Self::with_hint(format!("{file}: {message}"), hint);
        };
        let at = column.saturating_sub(1).min(bytes.len());
        let at = at + bytes[at..].iter().take_while(|b| **b == b' ').count();
        let word = bytes[at..]
            .iter()
            .take_while(|b| !b.is_ascii_whitespace() && !b",;[]{}()".contains(b))
            .count();
        let end = (at + length.unwrap_or(word).max(1)).min(bytes.len());
        let (from, to) = (at.saturating_sub(AROUND), (end + AROUND).min(bytes.len()));
        let shown = |b: &u8| {
            if b.is_ascii_graphic() || *b == b' ' {
                char::from(*b)
            } else {
                '\u{b7}'
            }
        };
        let text: String = bytes[from..to].iter().map(shown).collect();
        let byte = |byte: usize| {
            text.char_indices()
                .nth(byte - from)
                .map_or(text.len(), |(index, _)| index)
        };
        let span = byte(at)..byte(end);
        Self {
            place: Some(Excerpt {
                file,
                line,
                column: at + 1,
                text,
                span,
            }),
            ..Self::with_hint(message, hint)
        }
    }
}
