//! The code of a program: statements as words, and the names in them.
//!
//! A statement is a line; one with a bracket open goes on.

use crate::program::words::{Kind, Spelling, Word, Words, in_names, unquoted};
use std::borrow::Cow;
use std::ops::Range;

/// Since s7, code stands as it is.
pub(super) static PLAIN: Spelling = Spelling {
    comment: b"//",
    in_names: in_names(b"$_"),
    has_escapes: true,
    has_entities: false,
};
/// Before, quotes and signs are entities.
static ESCAPED: Spelling = Spelling {
    comment: b"//",
    in_names: in_names(b"$_"),
    has_escapes: true,
    has_entities: true,
};

/// Lines that a statement has at most.
const MOST_LINES: usize = 40;

/// The statements of a program.
#[derive(Debug)]
pub(super) struct Code<'a> {
    bytes: &'a [u8],
    words: Vec<Word>,
    /// Behind the last word of each statement.
    ends: Vec<usize>,
}

impl<'a> Code<'a> {
    pub(super) fn of(bytes: &'a [u8], code: Range<usize>, is_escaped: bool) -> Self {
        let spelling = if is_escaped { &ESCAPED } else { &PLAIN };
        let (mut words, mut ends) = (Vec::new(), Vec::new());
        let Range { mut start, end } = code;
        let (mut depth, mut lines) = (0_usize, 0);
        while start < end {
            let known = words.len();
            let length = memchr::memchr2(b'\n', b'\r', &bytes[start..end]);
            let line_end = length.map_or(end, |length| start + length);
            spelling.add(bytes, start..line_end, &mut words);
            start = line_end + 1;
            for word in &words[known..] {
                match word.kind {
                    Kind::Sign(b'(' | b'[' | b'{') => depth += 1,
                    Kind::Sign(b')' | b']' | b'}') => depth = depth.saturating_sub(1),
                    _ => {}
                }
            }
            lines += usize::from(bytes.get(line_end) == Some(&b'\n'));
            if depth == 0 || lines >= MOST_LINES {
                ends.push(words.len());
                (depth, lines) = (0, 0);
            }
        }
        ends.push(words.len());
        Self { bytes, words, ends }
    }

    /// The words of each statement.
    pub(super) fn statements(&self) -> impl Iterator<Item = Words<'a, '_>> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        let all = starts.zip(&self.ends).map(|(start, end)| Words {
            bytes: self.bytes,
            all: &self.words[start..*end],
        });
        all.filter(|words| !words.is_empty())
    }
}

/// A name as the code uses it: `alias:name[index].field`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reference<'a> {
    pub alias: &'a [u8],
    pub name: &'a [u8],
    /// What stands in the brackets, `0` where there are none; `None` where only the running
    /// program knows.
    pub key: Option<&'a [u8]>,
    pub has_field: bool,
    /// Its words.
    pub words: usize,
}

impl<'a> Reference<'a> {
    /// The name that words begin with.
    pub(super) fn of(words: Words<'a, '_>) -> Option<Self> {
        if !words.is_name(0) {
            return None;
        }
        let has_alias = words.is(1, b':') && words.is_name(2);
        let at = if has_alias { 2 } else { 0 };
        let mut found = Self {
            alias: if has_alias { words.text(0) } else { b"" },
            name: words.text(at),
            key: Some(b"0"),
            has_field: false,
            words: at + 1,
        };
        let mut has_index = false;
        loop {
            let next = found.words;
            if words.is(next, b'[') {
                let (inside, count) = words.inside(next);
                if !found.has_field && !has_index {
                    (found.key, has_index) = (key(inside), true);
                }
                found.words += count;
            } else if words.is(next, b'.') && words.is_name(next + 1) {
                found.has_field = true;
                found.words += 2;
            } else {
                return Some(found);
            }
        }
    }

    /// The name that words are, without a field.
    pub(super) fn whole(words: Words<'a, '_>) -> Option<Self> {
        Self::of(words).filter(|name| name.words == words.len() && !name.has_field)
    }
}

/// A key without the blanks between its numbers: `0, 1` is `0,1`.
pub(super) fn plain_key(key: &[u8]) -> Cow<'_, [u8]> {
    let is_blank = u8::is_ascii_whitespace;
    let is_part = |b: &u8| b.is_ascii_digit() || *b == b',' || is_blank(b);
    if key.iter().any(is_blank) && key.iter().all(is_part) {
        return key.iter().copied().filter(|b| !is_blank(b)).collect();
    }
    Cow::Borrowed(key)
}

/// The key that words between brackets are: a number, a text, or `0,1` of arrays of more
/// dimensions.
fn key<'a>(inside: Words<'a, '_>) -> Option<&'a [u8]> {
    if inside.len() == 1 && inside.kind(0) == Some(Kind::Text) {
        return Some(unquoted(inside.text(0)));
    }
    let is_part = |word: &Word| matches!(word.kind, Kind::Number | Kind::Sign(b','));
    let is_key = !inside.is_empty() && inside.all.iter().all(is_part);
    is_key.then(|| inside.whole())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str, is_escaped: bool) -> Vec<Vec<&str>> {
        let code = Code::of(text.as_bytes(), 0..text.len(), is_escaped);
        let each = code.statements().map(|words| {
            let spans = (0..words.len()).map(|at| words.part(at..at + 1).span());
            spans.map(|span| &text[span]).collect()
        });
        each.collect()
    }

    #[test]
    fn a_line_is_a_statement_and_open_brackets_go_on() {
        let code = "a=b[1] // movel(\r\n\r\nmovel(p,\n {1,-2.5e1,.5},t)\nx!=\"a//\\\"b\" & 3\n";
        assert_eq!(
            words(code, false),
            [
                vec!["a", "=", "b", "[", "1", "]"],
                vec![
                    "movel", "(", "p", ",", "{", "1", ",", "-", "2.5e1", ",", ".5", "}", ",", "t",
                    ")"
                ],
                vec!["x", "!=", "\"a//\\\"b\"", "&", "3"],
            ]
        );
    }

    #[test]
    fn entities_are_the_signs_that_they_stand_for() {
        let code = "put(&quot;a&lt;b&quot;)\nif a&lt;=3 &amp; b\n";
        assert_eq!(
            words(code, true),
            [
                vec!["put", "(", "&quot;a&lt;b&quot;", ")"],
                vec!["if", "a", "&lt;=", "3", "&amp;", "b"]
            ]
        );
    }
}
