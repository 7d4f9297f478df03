//! Moves between those of a program: the call again, with a pose written out.

use crate::program::insert::{Repeated, bracketed, indent, with_numbers};
use crate::program::{Insertion, Motion, Program, Replacements, Source, Target};
use std::ops::Range;

/// The literal `p[...]` of a target, with its letter.
fn literal(bytes: &[u8], target: &Target) -> Option<Range<usize>> {
    let start = target.offset as usize;
    let open = start + usize::from(bytes.get(start) == Some(&b'p'));
    let inside = bracketed(bytes, open)?;
    Some(start..inside.end)
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
    let at = motion.instruction as usize;
    let call = &program.instructions[at];
    let start = call.place.offset as usize;
    let via = match call.motion {
        Motion::ArcEnd if !insertion.is_split() => Some(
            program.instructions[at.checked_sub(1)?]
                .target_span
                .range()?,
        ),
        _ => None,
    };
    let held = literal(&sources[target.file as usize].bytes, target)?;
    let written = |numbers: &[Vec<u8>]| {
        let bytes = &sources[target.file as usize].bytes;
        let mut text = with_numbers(bytes, &held, program.numbers_of(target), numbers)?;
        text.retain(|b| !matches!(b, b'\n' | b'\r'));
        Some(text)
    };
    let repeated = Repeated {
        source,
        span: start..call.end as usize,
        blanks: indent(bytes, start)?,
        via,
        end: call.target_span.range()?,
        longest: usize::MAX,
    };
    repeated.insert(insertion, written)
}
