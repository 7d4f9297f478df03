//! Moves between those of a program: the instruction again, with a position written out.

use super::LONGEST_LINE;
use super::aggregate;
use super::tokens::Cursor;
use crate::program::insert::{Repeated, bracketed, indent, line_end, with_numbers};
use crate::program::script::Place;
use crate::program::{
    Before, Displacement, Insertion, Motion, MoveText, Program, Replacements, Source, Target,
};
use std::ops::Range;

/// Moves whose path is told by their targets alone.
const REPEATED: &[&[u8]] = &[b"PTP", b"LIN", b"CIRC", b"SPTP", b"SLIN", b"SCIRC"];

/// Whether the instruction may be written again with another target.
fn is_repeated(bytes: &[u8], instruction: &MoveText) -> bool {
    let start = instruction.place.offset as usize;
    let text = &bytes[start..instruction.end as usize];
    let word = text
        .iter()
        .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_');
    let verb = &text[..word.count()];
    REPEATED
        .iter()
        .any(|known| verb.eq_ignore_ascii_case(known))
}

/// The aggregate of a position as the file has it.
fn aggregate(bytes: &[u8], target: &Target) -> Option<Range<usize>> {
    bracketed(bytes, target.offset as usize)
}

/// Whether external axes are where they were.
fn stands_still(sources: &[Source], from: &Target, to: &Target) -> bool {
    let external = |target: &Target| {
        let bytes = &sources[target.file as usize].bytes;
        let start = target.offset as usize;
        let mut cursor = Cursor {
            bytes,
            at: start,
            end: line_end(bytes, start),
        };
        let found = aggregate::read(&mut cursor).ok()?;
        Some(found.external.map(Option::unwrap_or_default))
    };
    let (Some(from), Some(to)) = (external(from), external(to)) else {
        return false;
    };
    from == to
}

/// The instruction that goes to the point an arc passes through, in front of the one to its end.
fn via_of(program: &Program, at: u32) -> Option<&MoveText> {
    let via = program.instructions.get(at.checked_sub(1)? as usize)?;
    let place: Place = program.instructions[at as usize].place;
    (via.motion == Motion::ArcVia && via.place == place).then_some(via)
}

/// See [`crate::program::Language::insert`].
pub(super) fn insert(
    sources: &[Source],
    program: &Program,
    insertion: &Insertion,
) -> Option<Replacements> {
    let motion = &program.moves[insertion.motion];
    let instruction = &program.instructions[motion.instruction as usize];
    let source = &sources[motion.file as usize];
    let target = program.target_of(motion)?;
    if motion.displacement != Displacement::None {
        return None;
    }
    let start = instruction.place.offset as usize;
    let blanks = indent(&source.bytes, start)?;
    let bytes = &sources[target.file as usize].bytes;
    let held = aggregate(bytes, target)?;
    let written =
        |numbers: &[Vec<u8>]| with_numbers(bytes, &held, program.numbers_of(target), numbers);
    if insertion.is_split() {
        let repeated = Repeated {
            source,
            span: start..instruction.end as usize,
            blanks,
            via: None,
            end: instruction.target_span.range()?,
            longest: LONGEST_LINE,
        };
        return repeated.insert(insertion, written);
    }
    if !is_repeated(&source.bytes, instruction) {
        return None;
    }
    let is_arc = insertion.between.iter().any(|b| b.via.is_some());
    let mut before = motion.before;
    let via = if is_arc {
        let Before::One(at) = before else { return None };
        before = program.moves[at as usize].before;
        Some(via_of(program, motion.instruction)?.target_span.range()?)
    } else {
        None
    };
    let Before::One(before) = before else {
        return None;
    };
    let before = program.target_of(&program.moves[before as usize])?;
    if !stands_still(sources, before, target) {
        return None;
    }
    let repeated = Repeated {
        source,
        span: start..instruction.end as usize,
        blanks,
        via,
        end: instruction.target_span.range()?,
        longest: LONGEST_LINE,
    };
    repeated.insert(insertion, written)
}
