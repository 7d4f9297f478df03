//! Where a row of measurements stands.

use std::fmt;
use std::sync::Arc;

/// A line of a file.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Line {
    /// Which file, where several are read as one.
    pub file: Option<Arc<str>>,
    /// From 1; 0 is the whole file.
    pub number: usize,
}

impl From<usize> for Line {
    fn from(number: usize) -> Self {
        Self { file: None, number }
    }
}

impl Line {
    /// As a cell of a table: `7`, or `b.csv:7` of several files.
    #[must_use]
    pub fn short(&self) -> String {
        let number = self.number;
        self.file
            .as_ref()
            .map_or_else(|| number.to_string(), |file| format!("{file}:{number}"))
    }
}

impl fmt::Display for Line {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "line {}", self.number)?;
        self.file
            .as_ref()
            .map_or(Ok(()), |file| write!(to, " of {file}"))
    }
}
