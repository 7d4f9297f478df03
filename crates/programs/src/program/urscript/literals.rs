//! The numbers between the brackets of a pose or a list of joints.

use super::syntax::{Content, Literal};
use super::tokens::number_length;
use crate::program::Number;
use crate::program::number::{parse, parse_start};
use crate::program::script::short;

/// What the brackets hold.
pub(super) enum Found {
    /// Six numbers, and the byte behind the closing bracket.
    Six(Content, usize),
    /// Not six numbers.
    Else,
    /// A number that no robot can take, at this place, and why.
    Bad(usize, usize, &'static str),
}

/// Behind blanks and comments.
fn blanks(bytes: &[u8], mut at: usize) -> usize {
    while let Some(byte) = bytes.get(at) {
        match byte {
            b' ' | b'\t' | b'\n' | b'\r' => at += 1,
            b'#' => {
                let rest = &bytes[at..];
                at += memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
            }
            _ => break,
        }
    }
    at
}

/// The end of a word that stands for a number which is not finite, where no variable has its name.
fn word_without_value(bytes: &[u8], start: usize) -> Option<usize> {
    let rest = &bytes[start..];
    let is_of_word = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    let length = rest.iter().position(|byte| !is_of_word(byte))?;
    let word = &rest[..length];
    if !["nan", "inf", "infinity"]
        .iter()
        .any(|name| word.eq_ignore_ascii_case(name.as_bytes()))
    {
        return None;
    }
    let is_assigned = memchr::memmem::find_iter(bytes, word).any(|at| {
        let behind = blanks(bytes, at + length);
        bytes.get(behind) == Some(&b'=') && bytes.get(behind + 1) != Some(&b'=')
    });
    (!is_assigned).then_some(start + length)
}

/// Reads six numbers from the byte behind the opening bracket into `numbers`, which stays as it was
/// where they are not six.
pub(super) fn six(bytes: &[u8], start: usize, pose: bool, numbers: &mut Vec<Number>) -> Found {
    let first = numbers.len();
    let mut degrees = [false; 6];
    let mut at = start;
    for k in 0..6 {
        at = blanks(bytes, at);
        let rest = &bytes[at..];
        degrees[k] = rest.starts_with(b"d2r(");
        if degrees[k] {
            at = blanks(bytes, at + 4);
        }
        let rest = &bytes[at..];
        let sign = usize::from(matches!(rest.first(), Some(b'+' | b'-')));
        let fits = |length: usize| length >= sign + number_length(&rest[sign..]);
        let quick = parse_start(rest).filter(|(_, length)| fits(*length));
        let (value, length) = if let Some(found) = quick {
            found
        } else {
            let length = sign + number_length(&rest[sign..]);
            let Some(value) = parse(&rest[..length]) else {
                numbers.truncate(first);
                let text = std::str::from_utf8(&rest[..length]).ok();
                let digits = rest[sign..length].first().is_some_and(u8::is_ascii_digit);
                let value = text.and_then(|text| text.parse::<f64>().ok());
                if digits && value.is_some_and(f64::is_infinite) {
                    return Found::Bad(at, at + length, "it is too large");
                }
                let word = word_without_value(bytes, at + sign);
                return word.map_or(Found::Else, |end| Found::Bad(at, end, "it is not finite"));
            };
            (value, length)
        };
        let Ok(bytes_of) = u16::try_from(length) else {
            numbers.truncate(first);
            return Found::Else;
        };
        numbers.push(Number {
            start: short(at),
            length: bytes_of,
            value,
        });
        at = blanks(bytes, at + length);
        if degrees[k] {
            if bytes.get(at) != Some(&b')') {
                break;
            }
            at = blanks(bytes, at + 1);
        }
        let wanted = if k == 5 { b']' } else { b',' };
        if bytes.get(at) != Some(&wanted) {
            break;
        }
        at += 1;
        if k == 5 {
            let bits = (0..6).fold(0, |bits, k| bits | u8::from(degrees[k]) << k);
            if bits == 0 {
                return Found::Six(Content::Numbers, at);
            }
            if !(pose && degrees[..3].contains(&true)) {
                return Found::Six(Content::Degrees(bits), at);
            }
        }
    }
    numbers.truncate(first);
    Found::Else
}

/// A literal whose elements are not six numbers.
pub(super) fn other(offset: usize, end: usize, pose: bool, elements: u32) -> Literal {
    Literal {
        offset: short(offset),
        end: short(end),
        pose,
        content: Content::Expressions,
        numbers: 0..0,
        elements,
        computed: false,
        names: 0..0,
    }
}
