//! Values in brackets, read against a template of their type.
//!
//! A template is a text of brackets and leaves: `n` a number, `b` TRUE or FALSE, `s` a string.
//! Where the program has something else in the place of a leaf or of a whole bracket, those leaves
//! are [`Leaf::Computed`].

use super::reader::Reader;
use super::syntax::Part;
use super::tokens::{Fault, Kind, Token};
use crate::program::number;
use crate::program::script::short;

pub(super) const ROBTARGET: &[u8] = b"[[nnn][nnnn][nnnn][nnnnnn]]";
pub(super) const JOINTTARGET: &[u8] = b"[[nnnnnn][nnnnnn]]";
/// robhold, tframe, tload.
pub(super) const TOOLDATA: &[u8] = b"[b[[nnn][nnnn]][n[nnn][nnnn]nnn]]";
/// robhold, ufprog, ufmec, uframe, oframe.
pub(super) const WOBJDATA: &[u8] = b"[bbs[[nnn][nnnn]][[nnn][nnnn]]]";
pub(super) const LOADDATA: &[u8] = b"[n[nnn][nnnn]nnn]";
pub(super) const POSE: &[u8] = b"[[nnn][nnnn]]";
pub(super) const POS: &[u8] = b"[nnn]";
pub(super) const ORIENT: &[u8] = b"[nnnn]";
pub(super) const NUM: &[u8] = b"n";
pub(super) const BOOL: &[u8] = b"b";
pub(super) const STRING: &[u8] = b"s";

/// What a quaternion must be.
pub(super) const UNIT_LIMIT: &str = "its length may differ from 1 by 0.01 at most";

/// Most leaves of a template.
pub(super) const MOST: usize = 20;

/// One part of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Leaf {
    /// A number with its field.
    Number { value: f64, start: u32, length: u16 },
    /// TRUE or FALSE.
    Bool(bool),
    /// A string, empty or not.
    Text { start: u32, length: u16 },
    /// An expression.
    Computed,
    /// Not given.
    Missing,
}

impl Leaf {
    /// The number, where it is one.
    pub(super) fn number(self) -> Option<f64> {
        match self {
            Self::Number { value, .. } => Some(value),
            _ => None,
        }
    }
}

/// The leaves of a value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaves {
    leaves: [Leaf; MOST],
    count: usize,
    /// The names in the first of them.
    names: [Part; PLACES],
}

/// Leaves whose names are kept: coordinates, or joints.
const PLACES: usize = 6;

impl Leaves {
    pub(super) fn new() -> Self {
        Self {
            leaves: [Leaf::Missing; MOST],
            count: 0,
            names: [(0, 0); PLACES],
        }
    }

    pub(super) fn as_slice(&self) -> &[Leaf] {
        &self.leaves[..self.count]
    }

    /// The names in each of the first leaves, parts of [`super::syntax::Parsed::mentions`].
    pub(super) fn names(&self, count: usize) -> &[Part] {
        &self.names[..count]
    }

    /// Adds a leaf with these names in it.
    fn add(&mut self, leaf: Leaf, names: Part) {
        if let Some(slot) = self.names.get_mut(self.count) {
            *slot = names;
        }
        self.push(leaf);
    }

    fn push(&mut self, leaf: Leaf) {
        self.leaves[self.count] = leaf;
        self.count += 1;
    }
}

/// What a value is called where it should stand.
const WANTED: &str = "a value of this type";

impl Reader<'_> {
    /// Reads a value against a template; the present token is its first.
    pub(super) fn aggregate(&mut self, template: &[u8]) -> Result<Leaves, Fault> {
        let mut leaves = Leaves::new();
        let start = self.token.start as usize;
        if let Some(end) = plain_numbers(self.bytes, start, template, &mut leaves) {
            self.jump(end)?;
            return Ok(leaves);
        }
        leaves.count = 0;
        let mut openers = [0_u32; 4];
        let mut depth = 0;
        let mut at = 0;
        while let Some(&part) = template.get(at) {
            let first_name = short(self.parsed.mentions.len());
            match part {
                b']' => {
                    if !self.token.is(b']') {
                        return Err(self.unclosed_or_unexpected(openers[depth - 1], "]"));
                    }
                    depth -= 1;
                    self.advance()?;
                    at += 1;
                }
                b'[' if self.token.is(b'[') => {
                    openers[depth] = self.token.start;
                    depth += 1;
                    self.advance()?;
                    at += 1;
                    continue;
                }
                b'[' => {
                    let end = closing(template, at);
                    self.computed(&openers, depth)?;
                    let names = (first_name, short(self.parsed.mentions.len()));
                    for _ in template[at..end].iter().filter(|b| b.is_ascii_lowercase()) {
                        leaves.add(Leaf::Computed, names);
                    }
                    at = end;
                }
                _ => {
                    let leaf = self.leaf(part, &openers, depth)?;
                    leaves.add(leaf, (first_name, short(self.parsed.mentions.len())));
                    at += 1;
                }
            }
            // between neighbours stands a comma
            if depth > 0 && template.get(at).is_some_and(|&next| next != b']') {
                if !self.token.is(b',') {
                    return Err(self.unclosed_or_unexpected(openers[depth - 1], ","));
                }
                self.advance()?;
            }
        }
        Ok(leaves)
    }

    fn leaf(&mut self, part: u8, openers: &[u32; 4], depth: usize) -> Result<Leaf, Fault> {
        let first = self.token;
        let mark = self.mark();
        let leaf = match (part, first.kind) {
            (b'n', Kind::Number | Kind::Sign(b'-' | b'+')) => self.signed_number()?,
            (b'b' | b'n', Kind::Name) => {
                let name = self.text(first);
                let leaf = if part == b'b' && name.eq_ignore_ascii_case(b"true") {
                    Leaf::Bool(true)
                } else if part == b'b' && name.eq_ignore_ascii_case(b"false") {
                    Leaf::Bool(false)
                } else {
                    not_a_number(name, first)?;
                    Leaf::Computed
                };
                self.advance()?;
                leaf
            }
            (b's', Kind::Text) => {
                self.advance()?;
                Leaf::Text {
                    start: first.start,
                    length: u16::try_from(first.end - first.start).unwrap_or(u16::MAX),
                }
            }
            _ => Leaf::Computed,
        };
        let ends = depth == 0 || self.token.is(b',') || self.token.is(b']');
        if leaf != Leaf::Computed && ends {
            return Ok(leaf);
        }
        self.rewind(mark);
        self.computed(openers, depth)?;
        Ok(Leaf::Computed)
    }

    /// A number with its sign in one field, or [`Leaf::Computed`].
    fn signed_number(&mut self) -> Result<Leaf, Fault> {
        let first = self.token;
        if first.kind != Kind::Number {
            self.advance()?;
            if self.token.kind == Kind::Name {
                not_a_number(self.text(self.token), self.token)?;
            }
            let between = &self.bytes[first.end as usize..self.token.start as usize];
            let is_near = between.iter().all(|b| matches!(b, b' ' | b'\t'));
            if self.token.kind != Kind::Number || !is_near {
                return Ok(Leaf::Computed);
            }
        }
        let (start, end) = (first.start, self.token.end);
        let digits = self.text(self.token);
        let value = number::parse(digits).or_else(|| based(digits));
        let sign = if first.is(b'-') { -1.0 } else { 1.0 };
        let value = value.map(|value| sign * value).ok_or(Fault::BadValue {
            start,
            end,
            meaning: "number",
            limit: "it must be finite and written in decimal digits",
        })?;
        let length = u16::try_from(end - start).map_err(|_| Fault::BadValue {
            start,
            end,
            meaning: "number",
            limit: "it must have fewer than 65536 digits",
        })?;
        self.advance()?;
        Ok(Leaf::Number {
            value,
            start,
            length,
        })
    }

    /// Passes over an expression inside a bracket, to the comma or bracket that ends it.
    fn computed(&mut self, openers: &[u32; 4], depth: usize) -> Result<(), Fault> {
        let first = self.token;
        self.expression()?;
        if self.token.start == first.start {
            let opener = openers[depth.saturating_sub(1)];
            return Err(self.unclosed_or_unexpected(opener, WANTED));
        }
        Ok(())
    }

    fn unclosed_or_unexpected(&self, opener: u32, expected: &'static str) -> Fault {
        if self.token.kind == Kind::End || self.token.is(b';') {
            return Fault::unclosed(opener as usize, "bracket");
        }
        Fault::unexpected(self.token.start as usize..self.token.end as usize, expected)
    }
}

/// A whole number in hexadecimal, octal or binary digits: `0x32`, `0o62`, `0b110010`.
///
/// # Source
/// ABB, Technical reference manual RAPID kernel, "Numerical literals".
fn based(text: &[u8]) -> Option<f64> {
    let [b'0', base, digits @ ..] = text else {
        return None;
    };
    let base = match base {
        b'x' | b'X' => 16,
        b'o' | b'O' => 8,
        b'b' | b'B' => 2,
        _ => return None,
    };
    let value = u32::from_str_radix(std::str::from_utf8(digits).ok()?, base);
    value.ok().map(f64::from)
}

/// The leaves of a value of numbers with nothing but blanks between them, and the byte behind it.
/// `None` for all others: the way by tokens knows what is wrong with them, if anything is.
fn plain_numbers(
    bytes: &[u8],
    start: usize,
    template: &[u8],
    leaves: &mut Leaves,
) -> Option<usize> {
    let mut at = start;
    for (k, &part) in template.iter().enumerate() {
        let comma = k > 0 && part != b']' && template[k - 1] != b'[';
        if comma {
            at = past_blanks(bytes, at);
            if bytes.get(at) != Some(&b',') {
                return None;
            }
            at += 1;
        }
        at = past_blanks(bytes, at);
        if part == b'n' {
            let (value, length) = number::parse_start(&bytes[at..])?;
            // a file is smaller than 4 GiB and such a number shorter than 30 bytes
            #[allow(clippy::cast_possible_truncation)]
            leaves.push(Leaf::Number {
                value,
                start: at as u32,
                length: length as u16,
            });
            at += length;
            if !matches!(
                bytes.get(at),
                Some(b',' | b']' | b' ' | b'\t' | b'\r' | b'\n')
            ) {
                return None;
            }
        } else {
            if bytes.get(at) != Some(&part) {
                return None;
            }
            at += 1;
        }
    }
    Some(at)
}

fn past_blanks(bytes: &[u8], mut at: usize) -> usize {
    while let Some(b' ' | b'\t' | b'\r' | b'\n') = bytes.get(at) {
        at += 1;
    }
    at
}

/// NaN and infinity are no names of data.
fn not_a_number(name: &[u8], token: Token) -> Result<(), Fault> {
    if [&b"nan"[..], b"inf", b"infinity"]
        .iter()
        .any(|word| name.eq_ignore_ascii_case(word))
    {
        return Err(Fault::BadValue {
            start: token.start,
            end: token.end,
            meaning: "number",
            limit: "it must be finite and written in decimal digits",
        });
    }
    Ok(())
}

/// The byte after the bracket that closes the one at `at`.
fn closing(template: &[u8], at: usize) -> usize {
    let mut depth = 0;
    let length = template[at..].iter().position(|part| {
        match part {
            b'[' => depth += 1,
            b']' => depth -= 1,
            _ => {}
        }
        depth == 0
    });
    at + length.expect("templates are balanced") + 1
}
