//! What readers of all languages share.

use super::{ReadError, Source};

/// No text has a zero byte, and places are kept in 32 bits.
///
/// # Errors
/// Where the file is none that a program can be in.
pub(super) fn check_bytes(source: &Source) -> Result<(), ReadError> {
    let limit = u32::MAX as usize;
    let (file, size) = (source.name.clone(), source.bytes.len());
    if size >= limit {
        return Err(ReadError::TooLarge { file, size, limit });
    }
    match memchr::memchr(0, &source.bytes) {
        Some(offset) => Err(ReadError::Binary {
            file,
            byte: 0,
            offset,
        }),
        None => Ok(()),
    }
}

/// Why a text cannot be read, by offsets; becomes a [`ReadError`] with the source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// What opens here is not closed.
    Unclosed { at: u32, what: &'static str },
    /// Something else stands where one thing belongs.
    Unexpected {
        start: u32,
        end: u32,
        expected: &'static str,
    },
    /// A number no robot can use.
    BadValue {
        start: u32,
        end: u32,
        meaning: &'static str,
        limit: &'static str,
    },
    /// A byte that no text has.
    Binary { at: u32 },
}

/// Bytes of a wrong part that an error message repeats at most.
const SHOWN: usize = 40;

impl Fault {
    /// The error with file, line and column; `whole` is what is read at a time, such as "the line".
    pub(super) fn in_source(self, source: &Source, whole: &str) -> ReadError {
        let file = source.name.clone();
        let shown = |start: u32, end: u32| {
            let end = (end as usize).min(start as usize + SHOWN);
            match source.bytes.get(start as usize..end) {
                Some(text) if !text.is_empty() => Source::text(text).into_owned(),
                _ => format!("the end of {whole}"),
            }
        };
        let at = match self {
            Self::Unclosed { at, .. } | Self::Binary { at } => at,
            Self::Unexpected { start, .. } | Self::BadValue { start, .. } => start,
        };
        let (line, column) = source.line_column(at as usize);
        match self {
            Self::Unclosed { what, .. } => ReadError::Unclosed {
                file,
                line,
                column,
                what,
            },
            Self::Unexpected {
                start,
                end,
                expected,
            } => ReadError::Unexpected {
                file,
                line,
                column,
                found: shown(start, end),
                expected,
            },
            Self::BadValue {
                start,
                end,
                meaning,
                limit,
            } => ReadError::BadValue {
                file,
                line,
                column,
                value: shown(start, end),
                meaning,
                limit,
            },
            Self::Binary { at } => ReadError::Binary {
                file,
                byte: source.bytes[at as usize],
                offset: at as usize,
            },
        }
    }
}
