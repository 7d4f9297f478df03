//! Moves between those of a program: the call again, with a pose written out.

use crate::program::insert::{Repeated, arguments, bracketed, indent, with_numbers};
use crate::program::{Insertion, Program, Replacements, Source, Target, number};
use std::ops::Range;

/// Place of the time of the whole way among the arguments: with it the speed is not obeyed.
fn time_place(verb: &[u8]) -> Option<usize> {
    matches!(verb, b"movej" | b"movel").then_some(3)
}

/// The argument without the name that it may be given by.
pub(super) fn value(bytes: &[u8], span: &Range<usize>) -> (Option<Range<usize>>, Range<usize>) {
    let text = &bytes[span.clone()];
    let name = text
        .iter()
        .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
        .count();
    let behind = &text[name..];
    let blanks = behind.len() - behind.trim_ascii_start().len();
    if name > 0 && behind.trim_ascii_start().first() == Some(&b'=') {
        let start = span.start + name + blanks + 1;
        let more = bytes[start..span.end].len() - bytes[start..span.end].trim_ascii_start().len();
        return (Some(span.start..span.start + name), start + more..span.end);
    }
    (None, span.clone())
}

/// Whether the call says how long the whole way takes.
fn is_timed(bytes: &[u8], verb: &[u8], all: &[Range<usize>]) -> bool {
    let Some(place) = time_place(verb) else {
        return false;
    };
    all.iter().enumerate().any(|(at, span)| {
        let (name, value) = value(bytes, span);
        let is_time = name.map_or(at == place, |name| &bytes[name] == b"t");
        is_time && number::parse(&bytes[value]) != Some(0.0)
    })
}

/// The literal `p[...]` of a target, with its letter.
fn literal(bytes: &[u8], target: &Target) -> Option<Range<usize>> {
    let start = target.offset as usize;
    let open = start + usize::from(bytes.get(start) == Some(&b'p'));
    let inside = bracketed(bytes, open)?;
    Some(start..inside.end)
}

/// Where the target's numbers stand, or are named, in an argument.
fn place(bytes: &[u8], target: &Target, argument: &Range<usize>) -> Option<Range<usize>> {
    let own = literal(bytes, target)?;
    if argument.contains(&own.start) {
        return Some(own);
    }
    // a variable: the pose itself, not one computed from it
    let name = target.name.as_ref()?.as_bytes();
    let before = bytes[..own.start].trim_ascii_end().strip_suffix(b"=")?;
    if !before.trim_ascii_end().ends_with(name) {
        return None;
    }
    let is_word = |b: &u8| b.is_ascii_alphanumeric() || *b == b'_';
    let text = &bytes[argument.clone()];
    let mut found = memchr::memmem::find_iter(text, name).filter(|at| {
        let before = at.checked_sub(1).map(|at| text[at]);
        let behind = text.get(at + name.len());
        !before.as_ref().is_some_and(is_word) && !behind.is_some_and(is_word)
    });
    let at = argument.start + found.next()?;
    found.next().is_none().then_some(at..at + name.len())
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
    let open = start + memchr::memchr(b'(', &bytes[start..])?;
    let verb = bytes[start..open].trim_ascii_end();
    let call = start..bracketed(bytes, open)?.end;
    let all = arguments(bytes, open + 1, call.end - 1);
    let is_broken = bytes[call.clone()]
        .iter()
        .any(|b| matches!(b, b'\n' | b'\r' | b'#'));
    if is_broken || is_timed(bytes, verb, &all) || target.file != motion.file {
        return None;
    }
    let is_arc = insertion.between.iter().any(|b| b.via.is_some());
    let (mut via, mut end_at) = (None, 0);
    if is_arc {
        let through = &program.moves[insertion.motion.checked_sub(1)?];
        let through = &program.targets[through.target?];
        via = Some(place(bytes, through, &value(bytes, all.first()?).1)?);
        end_at = 1;
    }
    let end = place(bytes, target, &value(bytes, all.get(end_at)?).1)?;
    let held = literal(bytes, target)?;
    let written = |numbers: &[Vec<u8>]| {
        let mut text = with_numbers(bytes, &held, program.numbers_of(target), numbers)?;
        text.retain(|b| !matches!(b, b'\n' | b'\r'));
        Some(text)
    };
    let repeated = Repeated {
        source,
        span: call,
        blanks,
        via,
        end,
        longest: usize::MAX,
    };
    repeated.insert(insertion, written)
}
