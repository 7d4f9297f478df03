//! The lines of a file, and the words and numbers in them.

use crate::program::kit::{self, Fault};
use crate::program::{Number, ReadError, Source, number};
use std::ops::Range;

/// A line without its end and the blanks around it, and its first byte's place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    pub start: usize,
    pub text: &'a [u8],
}

/// The lines of a text; they end with LF, CR LF or CR.
#[derive(Clone, Debug)]
pub(super) struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Lines<'a> {
    /// The lines from a byte on.
    pub(super) fn from(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at }
    }

    /// The lines behind a byte order mark.
    pub(super) fn of(bytes: &'a [u8]) -> Self {
        Self::from(bytes, kit::content_start(bytes))
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        let text = &rest[..length];
        let blank = |b: &&u8| is_blank(**b);
        let before = text.iter().take_while(blank).count();
        let start = self.at + before;
        // the CR of CR LF ends a line, the LF an empty one
        self.at += length + 1;
        let behind = text[before..].iter().rev().take_while(blank).count();
        let text = &text[before..length - behind];
        Some(Line { start, text })
    }
}

/// The lines between these bytes but for plain moves to `C` positions, which most of a long job are:
/// what else a job does is looked for several times.
pub(super) fn other_than_moves(
    bytes: &[u8],
    between: Range<usize>,
) -> impl Iterator<Item = Line<'_>> {
    let is_move = |line: &Line| matches!(line.text, [b'M', b'O', b'V', _, b' ', b'C', ..]);
    Lines::from(&bytes[..between.end], between.start).filter(move |line| !is_move(line))
}

/// Blanks, tabs, and the Ctrl-Z that some editors put at the end.
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x1a)
}

/// The words of a line: what stands between blanks.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    placed_words(text).map(|(_, word)| word)
}

/// The words of a line, and where in it they start.
pub(super) fn placed_words(text: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut at = 0;
    let all = text.split(|&b| is_blank(b)).map(move |word| {
        let start = at;
        at += word.len() + 1;
        (start, word)
    });
    all.filter(|(_, word)| !word.is_empty())
}

/// What follows `prefix` and a blank or nothing; `None` where the text starts otherwise.
pub(super) fn after<'a>(text: &'a [u8], prefix: &[u8]) -> Option<&'a [u8]> {
    let rest = text.strip_prefix(prefix)?;
    match rest.first() {
        None => Some(rest),
        Some(&b) if is_blank(b) => Some(rest.trim_ascii_start()),
        Some(_) => None,
    }
}

/// The numbers between commas of a part of a line.
pub(super) fn numbers(source: &Source, from: usize, to: usize) -> Result<Vec<Number>, ReadError> {
    let mut found = Vec::with_capacity(8);
    add_numbers(source, from, to, &mut found)?;
    Ok(found)
}

/// Adds these numbers to others.
pub(super) fn add_numbers(
    source: &Source,
    from: usize,
    to: usize,
    found: &mut Vec<Number>,
) -> Result<(), ReadError> {
    let mut at = from;
    for field in source.bytes[from..to].split(|&b| b == b',') {
        let before = field.iter().take_while(|&&b| is_blank(b)).count();
        let text = &field[before..];
        let behind = text.iter().rev().take_while(|&&b| is_blank(b)).count();
        let text = &text[..text.len() - behind];
        let fault = || unexpected(source, at + before, text, "a number");
        found.push(number::placed(text, at + before).ok_or_else(fault)?);
        at += field.len() + 1;
    }
    Ok(())
}

/// What stands at a place is not what belongs there.
pub(super) fn unexpected(
    source: &Source,
    at: usize,
    found: &[u8],
    expected: &'static str,
) -> ReadError {
    Fault::unexpected(at..at + found.len(), expected).in_source(source)
}
