//! Why a file cannot be read as a program.

/// A file that is not a program of its language, or a broken one. Places are lines and columns from
/// 1.
#[derive(Debug, thiserror::Error, Clone, PartialEq, Eq)]
pub enum ReadError {
    /// The bytes are no text.
    #[error("{file}: {}", self.message())]
    Binary {
        /// The file.
        file: String,
        /// The byte that no program holds.
        byte: u8,
        /// Where it stands.
        offset: usize,
    },
    /// The file is too large for its places to be kept.
    #[error("{file}: {}", self.message())]
    TooLarge {
        /// The file.
        file: String,
        /// Its size.
        size: usize,
        /// The limit.
        limit: usize,
    },
    /// The text has none of the marks of the language.
    #[error("{file}: {}", self.message())]
    NotThisLanguage {
        /// The file.
        file: String,
        /// The language it was read as.
        language: &'static str,
        /// What a program of that language has.
        missing: &'static str,
    },
    /// Something that was opened is not closed.
    #[error("{file}:{line}:{column}: {}", self.message())]
    Unclosed {
        /// The file.
        file: String,
        /// Line where it opens.
        line: usize,
        /// Column where it opens.
        column: usize,
        /// What opens there: a string, a bracket, a module.
        what: &'static str,
    },
    /// Something else stands where the language wants one thing.
    #[error("{file}:{line}:{column}: {}", self.message())]
    Unexpected {
        /// The file.
        file: String,
        /// Line.
        line: usize,
        /// Column.
        column: usize,
        /// What stands there.
        found: String,
        /// What belongs there.
        expected: &'static str,
    },
    /// A number that no robot can use.
    #[error("{file}:{line}:{column}: {}", self.message())]
    BadValue {
        /// The file.
        file: String,
        /// Line.
        line: usize,
        /// Column.
        column: usize,
        /// The text of the number.
        value: String,
        /// What it should be.
        meaning: &'static str,
        /// The limit it breaks.
        limit: &'static str,
    },
}

impl ReadError {
    /// What is wrong, without the place.
    #[must_use]
    pub fn message(&self) -> String {
        match self {
            Self::Binary { byte, offset, .. } => {
                format!("not a text file (byte {byte:#04x} at offset {offset})")
            }
            Self::TooLarge { size, limit, .. } => {
                format!("{size} bytes; the limit is {limit} bytes")
            }
            Self::NotThisLanguage {
                language, missing, ..
            } => format!("no program in {language}: it has no {missing}"),
            Self::Unclosed { what, .. } => format!("{what} is not closed"),
            Self::Unexpected {
                found, expected, ..
            } => format!("found {found}, where {expected} belongs"),
            Self::BadValue {
                value,
                meaning,
                limit,
                ..
            } => format!("{value} is no {meaning}: {limit}"),
        }
    }

    /// File, line and column; line and column are 0 where the error concerns the whole file.
    #[must_use]
    pub fn place(&self) -> (&str, usize, usize) {
        match self {
            Self::Binary { file, .. }
            | Self::TooLarge { file, .. }
            | Self::NotThisLanguage { file, .. } => (file, 0, 0),
            Self::Unclosed {
                file, line, column, ..
            }
            | Self::Unexpected {
                file, line, column, ..
            }
            | Self::BadValue {
                file, line, column, ..
            } => (file, *line, *column),
        }
    }
}
