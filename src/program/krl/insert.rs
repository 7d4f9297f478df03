//! Moves between those of a program: the instruction again, with a position written out.

use super::LONGEST_LINE;
use crate::program::insert::{Repeated, bracketed, indent, line_end, with_numbers};
use crate::program::{Insertion, Program, Replacements, Source, Target};
use std::ops::Range;

/// Moves whose way is told by their targets alone.
const REPEATED: &[&[u8]] = &[b"PTP", b"LIN", b"CIRC", b"SPTP", b"SLIN", b"SCIRC"];

/// The position that stands at `at`: an aggregate, or a name with its index.
fn position(bytes: &[u8], at: usize, end: usize) -> Option<Range<usize>> {
    if bytes.get(at) == Some(&b'{') {
        return bracketed(bytes, at).filter(|span| span.end <= end);
    }
    let mut here = at;
    while here < end {
        match bytes[here] {
            b'[' => here = bracketed(bytes, here)?.end,
            b if b.is_ascii_alphanumeric() || b == b'_' || b == b'$' => here += 1,
            _ => break,
        }
    }
    (here > at && here <= end).then_some(at..here)
}

fn skip_blanks(bytes: &[u8], mut at: usize) -> usize {
    while matches!(bytes.get(at), Some(b' ' | b'\t')) {
        at += 1;
    }
    at
}

/// The positions of a move, and the end of its text before a comment.
fn positions(bytes: &[u8], start: usize, count: usize) -> Option<(Vec<Range<usize>>, usize)> {
    let line = line_end(bytes, start);
    let end = memchr::memchr(b';', &bytes[start..line]).map_or(line, |length| start + length);
    let end = start + bytes[start..end].trim_ascii_end().len();
    let word = bytes[start..end]
        .iter()
        .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
        .count();
    let verb = &bytes[start..start + word];
    REPEATED
        .iter()
        .find(|known| verb.eq_ignore_ascii_case(known))?;
    let mut found: Vec<Range<usize>> = Vec::new();
    let mut at = start + word;
    for number in 0..count {
        at = skip_blanks(bytes, at);
        if number > 0 {
            if bytes.get(at) != Some(&b',') {
                return None;
            }
            at = skip_blanks(bytes, at + 1);
        }
        let span = position(bytes, at, end)?;
        at = span.end;
        found.push(span);
    }
    // behind them: C_DIS and WITH, but no product, and no angle of an arc
    let behind = skip_blanks(bytes, at);
    let goes_on = matches!(bytes.get(behind), Some(b',' | b':'));
    (behind >= end || !goes_on).then_some((found, end))
}

/// The aggregate of a position as the file has it.
fn aggregate(sources: &[Source], target: &Target) -> Option<Range<usize>> {
    let bytes = &sources[target.file as usize].bytes;
    let start = target.offset as usize;
    // a declaration may name the position first
    let line = line_end(bytes, start);
    let open = start + memchr::memchr(b'{', &bytes[start..line])?;
    bracketed(bytes, open)
}

/// Values of the external axes, as they are written.
fn external<'a>(sources: &'a [Source], target: &Target) -> Option<Vec<(u8, &'a [u8])>> {
    let bytes = &sources[target.file as usize].bytes;
    let text = &bytes[aggregate(sources, target)?];
    let inside = text.trim_ascii_start().strip_prefix(b"{")?;
    let inside = inside.strip_suffix(b"}")?;
    // behind the name of the structure
    let inside = memchr::memchr(b':', inside).map_or(inside, |at| &inside[at + 1..]);
    let mut found = Vec::new();
    for component in inside.split(|b| *b == b',') {
        if let [b'E' | b'e', number @ b'1'..=b'6', value @ ..] = component.trim_ascii() {
            found.push((*number, value.trim_ascii()));
        }
    }
    Some(found)
}

/// Whether external axes are where they were.
fn stands_still(sources: &[Source], from: &Target, to: &Target) -> bool {
    let value = |text: &[u8]| crate::program::number::parse(text);
    match (external(sources, from), external(sources, to)) {
        (Some(from), Some(to)) => to.iter().all(|(axis, there)| {
            let here = from.iter().find(|(other, _)| other == axis);
            let here = here.map_or(Some(0.0), |(_, text)| value(text));
            here.is_some() && here == value(there)
        }),
        _ => false,
    }
}

/// See [`crate::program::Language::insert`].
pub(super) fn insert(
    sources: &[Source],
    program: &Program,
    insertion: &Insertion,
) -> Option<Replacements> {
    let motion = &program.moves[insertion.motion];
    let source = &sources[motion.file as usize];
    let bytes = &source.bytes;
    let target = &program.targets[motion.target?];
    let start = motion.offset as usize;
    let blanks = indent(bytes, start)?;
    let is_arc = insertion.between.iter().any(|b| b.via.is_some());
    let (spans, end) = positions(bytes, start, if is_arc { 2 } else { 1 })?;
    let before = insertion.motion.checked_sub(if is_arc { 2 } else { 1 })?;
    let before = &program.targets[program.moves[before].target?];
    if !stands_still(sources, before, target) {
        return None;
    }
    let held = aggregate(sources, target)?;
    let written = |numbers: &[Vec<u8>]| {
        let bytes = &sources[target.file as usize].bytes;
        with_numbers(bytes, &held, program.numbers_of(target), numbers)
    };
    let repeated = Repeated {
        source,
        span: start..end,
        blanks,
        via: is_arc.then(|| spans[0].clone()),
        end: spans[spans.len() - 1].clone(),
        longest: LONGEST_LINE,
    };
    repeated.insert(insertion, written)
}
