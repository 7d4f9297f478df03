//! Moves between those of a program: the instruction again, with a target written out.

use crate::program::insert::{Repeated, bracketed, indent, with_numbers};
use crate::program::{Before, Insertion, Move, MoveText, Program, Replacements, Source, Target};
use std::ops::Range;

/// Instructions that do nothing but go to their target, or go on with their process on the way. Others switch outputs, count
/// distances or call procedures at their target, and would do so again at each new one.
const REPEATED: &[&str] = &[
    "movej", "movel", "movec", "arcl", "arcc", "displ", "dispc", "paintl", "paintc",
];

/// The text of an instruction with its semicolon; strings and comments do not stand in one that moves.
fn text<'a>(source: &'a Source, instruction: &MoveText) -> Option<&'a [u8]> {
    let span = instruction.place.offset as usize..instruction.end as usize;
    let text = source.bytes.get(span)?;
    (text.ends_with(b";") && !text.contains(&b'!') && !text.contains(&b'"')).then_some(text)
}

/// Where a move's own target stands in its instruction, itself or by its name.
fn argument(sources: &[Source], program: &Program, motion: &Move) -> Option<Range<usize>> {
    let span = program.instructions[motion.instruction as usize]
        .target_span
        .range()?;
    let target = &program.targets[motion.target?];
    let is_itself = target.file == motion.file && target.offset as usize == span.start;
    let text = &sources[motion.file as usize].bytes[span.clone()];
    let is_name = |name: &str| text.eq_ignore_ascii_case(name.as_bytes());
    (is_itself || target.name.as_deref().is_some_and(is_name)).then_some(span)
}

/// The only move that may come before another.
fn before<'a>(program: &'a Program, motion: &Move) -> Option<&'a Move> {
    match program.before(motion) {
        [Before::One(before)] => program.moves.get(*before as usize),
        _ => None,
    }
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
    let target = &program.targets[motion.target?];
    let instruction = &program.instructions[motion.instruction as usize];
    let blanks = indent(&source.bytes, instruction.place.offset as usize).unwrap_or_default();
    let written = |numbers: &[Vec<u8>]| aggregate(sources, program, target, numbers);
    let end = argument(sources, program, motion)?;
    if insertion.is_split() {
        let repeated = Repeated {
            source,
            span: instruction.place.offset as usize..instruction.end as usize,
            blanks,
            via: None,
            end,
            longest: usize::MAX,
        };
        return repeated.insert(insertion, written);
    }
    let text = text(source, instruction)?;
    let word = text
        .iter()
        .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
        .count();
    let known = |name: &&&str| text[..word].eq_ignore_ascii_case(name.as_bytes());
    REPEATED.iter().find(known)?;
    let is_arc = insertion.between.iter().any(|b| b.via.is_some());
    let (mut via, mut from) = (None, before(program, motion)?);
    if is_arc {
        via = Some(argument(sources, program, from)?);
        from = before(program, from)?;
    }
    if !stands_still(sources, program, &program.targets[from.target?], target) {
        return None;
    }
    let repeated = Repeated {
        source,
        span: instruction.place.offset as usize..instruction.end as usize,
        blanks,
        via,
        end,
        longest: usize::MAX,
    };
    repeated.insert(insertion, written)
}
