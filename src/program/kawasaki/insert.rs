//! Moves between those of a program: the statement again, with its target written out.

use crate::program::insert::{Repeated, indent, sole_use, spliced, starts_with_word};
use crate::program::{
    Displacement, Inserted, Insertion, Motion, Program, Replacements, Shape, Source, Target,
};
use std::ops::Range;

/// The longest line of a program.
const LONGEST_LINE: usize = 255;

/// See [`crate::program::Language::insert`].
pub(super) fn insert(sources: &[Source], program: &Program, insertions: &[Insertion]) -> Inserted {
    Inserted::each(insertions, |one| {
        if one.between.iter().any(|part| part.via.is_some()) {
            arc(sources, program, one)
        } else {
            repeat(sources, program, one)
        }
    })
}

/// A target written out.
fn written(target: &Target, numbers: &[Vec<u8>]) -> Vec<u8> {
    let (open, close): (&[u8], &[u8]) = match target.layout.shape {
        Shape::Pose => (b"TRANS(", b")"),
        Shape::Joints => (b"#[", b"]"),
    };
    [open, &numbers.join(&b","[..]), close].concat()
}

fn repeat(sources: &[Source], program: &Program, insertion: &Insertion) -> Option<Replacements> {
    let motion = &program.moves[insertion.motion];
    let target = program.target_of(motion)?;
    let instruction = &program.instructions[motion.instruction as usize];
    let bytes = &sources[motion.file as usize].bytes;
    let plain: &[&str] = if insertion.is_split() {
        &["JMOVE", "LMOVE", "HMOVE", "C1MOVE", "C2MOVE"]
    } else {
        &["JMOVE", "LMOVE", "HMOVE"]
    };
    if !starts_with_word(&bytes[instruction.span()], plain) {
        return None;
    }
    let repeated = Repeated::of(sources, program, insertion, LONGEST_LINE)?;
    repeated.insert(insertion, |numbers| Some(written(target, numbers)))
}

/// A statement that does nothing but go to its target: its bytes, and those of the target.
fn plain<'p>(
    source: &Source,
    program: &'p Program,
    motion: usize,
    verb: &str,
) -> Option<(Range<usize>, Range<usize>, &'p Target)> {
    let motion = sole_use(program, motion)?;
    let instruction = &program.instructions[motion.instruction as usize];
    let span = instruction.span();
    let is_plain = motion.displacement == Displacement::None
        && starts_with_word(&source.bytes[span.clone()], &[verb]);
    let target = program.target_of(motion).filter(|_| is_plain)?;
    Some((span, instruction.target_span.range()?, target))
}

/// `C1MOVE` and `C2MOVE` once more for each part of an arc but the last, which is the arc's own
/// with another point on its way.
fn arc(sources: &[Source], program: &Program, insertion: &Insertion) -> Option<Replacements> {
    let through = insertion.motion.checked_sub(1)?;
    let source = &sources[program.moves[insertion.motion].file as usize];
    if program.moves[through].motion != Motion::ArcVia {
        return None;
    }
    let (first, first_target, via) = plain(source, program, through, "C1MOVE")?;
    let (second, second_target, end) = plain(source, program, insertion.motion, "C2MOVE")?;
    let blanks = indent(&source.bytes, first.start)?;
    let (last, parts) = insertion.between.split_last()?;
    let mut text = Vec::new();
    let mut line = |span: &Range<usize>, at: &Range<usize>, target: &[u8]| {
        text.extend(spliced(&source.bytes, span, &[(at.clone(), target)]));
        text.extend_from_slice(source.line_end());
        text.extend_from_slice(blanks);
    };
    for part in parts {
        line(&first, &first_target, &written(via, part.via.as_ref()?));
        line(&second, &second_target, &written(end, &part.end));
    }
    let mut changes = vec![(first_target, written(via, last.via.as_ref()?))];
    if let Some(numbers) = &insertion.own {
        changes.push((second_target, written(end, numbers)));
    }
    if !text.is_empty() {
        changes.push((first.start..first.start, text));
    }
    Some(changes)
}
