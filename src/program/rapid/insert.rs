//! Moves between those of a program: the instruction again, with a target written out.

use crate::program::insert::{Repeated, arguments, bracketed, indent, with_numbers};
use crate::program::{Insertion, Program, Replacements, Source, Target};
use std::ops::Range;

/// Instructions that do nothing but go to their target, or go on with their process on the way. Others switch outputs, count
/// distances or call procedures at their target, and would do so again at each new one.
const REPEATED: &[&str] = &[
    "movej", "movel", "movec", "arcl", "arcc", "displ", "dispc", "paintl", "paintc",
];

/// The text of an instruction up to its semicolon; strings and comments do not stand in one that moves.
fn instruction(bytes: &[u8], offset: usize) -> Option<Range<usize>> {
    let end = memchr::memchr(b';', &bytes[offset..])? + offset;
    let text = &bytes[offset..end];
    (!text.contains(&b'!') && !text.contains(&b'"')).then_some(offset..end + 1)
}

/// The argument that is a target: its literal, or its name.
fn argument(
    bytes: &[u8],
    all: &[Range<usize>],
    target: &Target,
    inside: bool,
) -> Option<Range<usize>> {
    let offset = target.offset as usize;
    if inside && let Some(found) = all.iter().find(|range| range.start == offset) {
        return Some(found.clone());
    }
    let name = target.name.as_ref()?.as_bytes();
    all.iter()
        .find(|range| bytes[(*range).clone()].eq_ignore_ascii_case(name))
        .cloned()
}

/// The aggregate of a target with other numbers.
fn aggregate(
    sources: &[Source],
    program: &Program,
    target: &Target,
    texts: &[Vec<u8>],
) -> Option<Vec<u8>> {
    let bytes = &sources[target.file as usize].bytes;
    let span = bracketed(bytes, target.offset as usize)?;
    let mut out = with_numbers(bytes, &span, program.numbers_of(target), texts)?;
    // what was broken over lines stays one line
    out.retain(|b| !matches!(b, b'\n' | b'\r'));
    Some(out)
}

/// External axes of a target, as they are written.
fn external<'a>(sources: &'a [Source], program: &Program, target: &Target) -> Option<&'a [u8]> {
    let bytes = &sources[target.file as usize].bytes;
    let last = program.numbers_of(target).last()?;
    let span = bracketed(bytes, target.offset as usize)?;
    bytes.get(last.start as usize + usize::from(last.length)..span.end)
}

/// Whether external axes stand still from one target to another, as far as the text tells.
fn stands_still(sources: &[Source], program: &Program, from: &Target, to: &Target) -> bool {
    from.layout != to.layout || external(sources, program, from) == external(sources, program, to)
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
    let span = instruction(bytes, motion.offset as usize)?;
    let word = bytes[span.clone()]
        .iter()
        .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
        .count();
    let verb = &bytes[span.start..span.start + word];
    let known = |name: &&&str| verb.eq_ignore_ascii_case(name.as_bytes());
    REPEATED.iter().find(known)?;
    let all = arguments(bytes, span.start + word, span.end - 1);
    let end = argument(bytes, &all, target, target.file == motion.file)?;
    let is_arc = insertion.between.iter().any(|b| b.via.is_some());
    let mut via = None;
    if is_arc {
        let before = &program.moves[insertion.motion.checked_sub(1)?];
        let through = &program.targets[before.target?];
        let inside = through.file == motion.file;
        via = Some(argument(bytes, &all, through, inside)?);
    }
    let before = insertion.motion.checked_sub(if is_arc { 2 } else { 1 })?;
    let before = &program.targets[program.moves[before].target?];
    if !stands_still(sources, program, before, target) {
        return None;
    }
    let blanks = indent(bytes, span.start).unwrap_or_default();
    let written = |numbers: &[Vec<u8>]| aggregate(sources, program, target, numbers);
    let repeated = Repeated {
        source,
        span,
        blanks,
        via,
        end,
        longest: usize::MAX,
    };
    repeated.insert(insertion, written)
}
