//! A program file as bytes, and its lines.

use crate::finding::{Finding, Severity};
use std::borrow::Cow;
use std::sync::OnceLock;

/// A file's name and bytes. The encoding does not matter: nothing is decoded but for messages.
#[derive(Clone, Debug)]
pub struct Source {
    /// The file as the user named it.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// It is read for what it declares, and stays as it is: others use its tools, frames, targets
    /// and routines.
    pub is_context: bool,
    /// First byte of each line.
    line_starts: OnceLock<Vec<usize>>,
}

impl Source {
    /// A file of this name and content.
    #[must_use]
    pub fn new(name: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self {
            name: name.into(),
            bytes,
            is_context: false,
            line_starts: OnceLock::new(),
        }
    }

    /// A file that is read for what it declares only.
    #[must_use]
    pub fn context(name: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self {
            is_context: true,
            ..Self::new(name, bytes)
        }
    }

    fn line_starts(&self) -> &[usize] {
        self.line_starts.get_or_init(|| line_starts(&self.bytes))
    }

    /// The bytes of a line without its end; the first is line 0.
    #[must_use]
    pub fn line(&self, index: usize) -> Option<&[u8]> {
        let starts = self.line_starts();
        let end = starts.get(index + 1).copied().unwrap_or(self.bytes.len());
        let line = &self.bytes[*starts.get(index)?..end];
        let line = line.strip_suffix(b"\n").unwrap_or(line);
        Some(line.strip_suffix(b"\r").unwrap_or(line))
    }

    /// Line and column of a byte, both from 1; lines end with LF, CR LF or CR. The column counts
    /// bytes.
    #[must_use]
    pub fn line_column(&self, offset: usize) -> (usize, usize) {
        let starts = self.line_starts();
        let line = starts.partition_point(|&start| start <= offset);
        (line, offset - starts[line - 1] + 1)
    }

    /// A finding at a byte of this file.
    #[must_use]
    pub fn finding(
        &self,
        offset: usize,
        id: &'static str,
        severity: Severity,
        message: String,
        hint: &str,
    ) -> Finding {
        let (line, column) = self.line_column(offset);
        Finding {
            id,
            severity,
            file: self.name.clone(),
            line,
            column,
            message,
            hint: hint.into(),
            accepted: false,
        }
    }

    /// The line end of this file: that of its first line, LF where it has only one line.
    #[must_use]
    pub fn line_end(&self) -> &'static [u8] {
        match self.bytes.iter().position(|b| matches!(b, b'\n' | b'\r')) {
            Some(at) if self.bytes[at] == b'\n' => b"\n",
            Some(at) if self.bytes.get(at + 1) == Some(&b'\n') => b"\r\n",
            Some(_) => b"\r",
            None => b"\n",
        }
    }

    /// Bytes as text for messages: UTF-8 where they are, Latin-1 otherwise.
    #[must_use]
    pub fn text(bytes: &[u8]) -> Cow<'_, str> {
        std::str::from_utf8(bytes).map_or_else(
            |_| bytes.iter().copied().map(char::from).collect(),
            Cow::Borrowed,
        )
    }
}

fn line_starts(bytes: &[u8]) -> Vec<usize> {
    let ends = memchr::memchr2_iter(b'\n', b'\r', bytes)
        .filter(|&at| bytes[at] == b'\n' || bytes.get(at + 1) != Some(&b'\n'));
    std::iter::once(0).chain(ends.map(|at| at + 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_with_lf_crlf_or_cr_in_one_file() {
        let source = Source::new("a", b"a\nbc\r\nd\re".to_vec());
        let places: Vec<_> = [0, 2, 3, 6, 8]
            .iter()
            .map(|&o| source.line_column(o))
            .collect();
        assert_eq!(places, [(1, 1), (2, 1), (2, 2), (3, 1), (4, 1)]);
        assert_eq!(source.line_end(), b"\n");
        assert_eq!(Source::new("a", b"x\r\n".to_vec()).line_end(), b"\r\n");
        assert_eq!(Source::new("a", b"x\ry".to_vec()).line_end(), b"\r");
    }

    #[test]
    fn odd_bytes_are_shown_as_latin_1() {
        assert_eq!(Source::text(b"GR\xd6SSE"), "GR\u{d6}SSE");
        assert_eq!(Source::text("≔".as_bytes()), "≔");
    }
}
