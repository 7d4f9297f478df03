//! The words of one statement: names with what hangs on them, and lists in brackets.

use super::tokens::{self, Token};
use crate::program::script::short;
use crate::program::{Number, number};
use std::ops::Range;

/// A name as the code uses it: `alias:name[index].field`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reference<'a> {
    pub alias: &'a [u8],
    pub name: &'a [u8],
    /// What stands in the brackets.
    pub index: Index<'a>,
    pub has_field: bool,
    /// Its words.
    pub words: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Index<'a> {
    None,
    Key(&'a [u8]),
    /// Only the running program knows.
    Any,
}

/// The words of a statement, with its bytes.
#[derive(Clone, Copy)]
pub(super) struct Line<'a, 't> {
    pub bytes: &'a [u8],
    pub tokens: &'t [Token],
}

impl<'a> Line<'a, '_> {
    pub(super) fn text(&self, at: usize) -> &'a [u8] {
        let found = self.tokens.get(at);
        found.map_or(b"", |token| &self.bytes[token.start..token.end])
    }

    pub(super) fn is(&self, at: usize, sign: u8) -> bool {
        self.tokens.get(at).is_some_and(|token| token.is(sign))
    }

    pub(super) fn is_name(&self, at: usize) -> bool {
        let token = self.tokens.get(at);
        token.is_some_and(|token| token.kind == tokens::Kind::Name)
    }

    /// The number that it is, with its sign.
    pub(super) fn number(&self) -> Option<Number> {
        let (first, last) = (self.tokens.first()?, self.tokens.last()?);
        let has_sign = matches!(first.kind, tokens::Kind::Sign(b'-' | b'+'));
        let is_one = self.tokens.len() == 1 + usize::from(has_sign);
        if !is_one || last.kind != tokens::Kind::Number {
            return None;
        }
        let text = &self.bytes[first.start..last.end];
        Some(Number {
            start: short(first.start),
            length: u16::try_from(text.len()).ok()?,
            value: number::parse(text)?,
        })
    }

    /// Its words of this range.
    pub(super) fn part(&self, range: Range<usize>) -> Self {
        Self {
            tokens: &self.tokens[range],
            ..*self
        }
    }

    /// The word that closes the bracket at one; behind the last word where none does.
    pub(super) fn closing(&self, open: usize) -> usize {
        let mut depth = 0_usize;
        for (at, token) in self.tokens.iter().enumerate().skip(open) {
            match token.kind {
                tokens::Kind::Sign(b'(' | b'[' | b'{') => depth += 1,
                tokens::Kind::Sign(b')' | b']' | b'}') => {
                    depth = depth.saturating_sub(1);
                    if depth == 0 {
                        return at;
                    }
                }
                _ => {}
            }
        }
        self.tokens.len()
    }

    /// What stands between the commas of the bracket at a word, and the word that closes it.
    pub(super) fn list(&self, open: usize) -> (Vec<Self>, usize) {
        let close = self.closing(open);
        let (mut parts, mut start, mut at) = (Vec::new(), open + 1, open + 1);
        while at < close {
            if self.is(at, b',') {
                parts.push(self.part(start..at));
                start = at + 1;
            } else if matches!(self.tokens[at].kind, tokens::Kind::Sign(b'(' | b'[' | b'{')) {
                at = self.closing(at);
            }
            at += 1;
        }
        if start < close {
            parts.push(self.part(start..close));
        }
        (parts, close.min(self.tokens.len()))
    }

    /// The name that begins at a word.
    pub(super) fn reference(&self, at: usize) -> Option<Reference<'a>> {
        if !self.is_name(at) {
            return None;
        }
        let (alias, name, mut next) = if self.is(at + 1, b':') && self.is_name(at + 2) {
            (self.text(at), self.text(at + 2), at + 3)
        } else {
            (&b""[..], self.text(at), at + 1)
        };
        let mut index = Index::None;
        let mut has_field = false;
        loop {
            if self.is(next, b'[') {
                let close = self.closing(next);
                if !has_field && index == Index::None {
                    index = self.index(next + 1..close);
                }
                next = (close + 1).min(self.tokens.len());
            } else if self.is(next, b'.') && self.is_name(next + 1) {
                has_field = true;
                next += 2;
            } else {
                return Some(Reference {
                    alias,
                    name,
                    index,
                    has_field,
                    words: next - at,
                });
            }
        }
    }

    fn index(&self, range: Range<usize>) -> Index<'a> {
        let inside = self.part(range);
        match inside.tokens {
            [one] if one.kind == tokens::Kind::Number => Index::Key(inside.text(0)),
            [one] if one.kind == tokens::Kind::Text => {
                let text = inside.text(0);
                let text = text.strip_prefix(b"&quot;").unwrap_or(text);
                let text = text.strip_suffix(b"&quot;").unwrap_or(text);
                let text = text.strip_prefix(b"\"").unwrap_or(text);
                Index::Key(text.strip_suffix(b"\"").unwrap_or(text))
            }
            // elements of arrays of more dimensions: `0,1`
            [first, .., last]
                if (0..inside.tokens.len()).all(|at| {
                    inside.is(at, b',') || inside.tokens[at].kind == tokens::Kind::Number
                }) =>
            {
                Index::Key(&self.bytes[first.start..last.end])
            }
            _ => Index::Any,
        }
    }
}
