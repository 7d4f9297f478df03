//! Moves put between those of a program: what languages share.

use super::{Before, Displacement, Instruction, Motion, Move, Number, Program, Source, Target};
use std::ops::Range;

/// A target to be put between two of a program: the text of each number, in the order of
/// [`super::Language::roles`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Between {
    /// The point that an arc to it passes through.
    pub via: Option<Vec<Vec<u8>>>,
    /// The target.
    pub end: Vec<Vec<u8>>,
}

/// Moves to be put before one of a program's, like it but for their targets. Where the move is an
/// arc, the last entry is the move itself with another point on its way.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Insertion {
    /// Index of the move in [`super::Program::moves`].
    pub motion: usize,
    /// The targets on the way.
    pub between: Vec<Between>,
    /// A target of its own for the move itself, which it shares with others so far.
    pub own: Option<Vec<Vec<u8>>>,
}

impl Insertion {
    /// No move is added: the move itself gets a target of its own.
    #[must_use]
    pub fn is_split(&self) -> bool {
        self.between.is_empty()
    }
}

/// Byte ranges of a file, and what to put in their place.
pub type Replacements = Vec<(Range<usize>, Vec<u8>)>;

/// What puts moves into a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Inserted {
    /// For each insertion its text; `None` where the move cannot be repeated.
    pub moves: Vec<Option<Replacements>>,
    /// What the file needs besides them: positions that stand elsewhere, counts.
    pub rest: Replacements,
    /// What other files need, by their index in the sources.
    pub elsewhere: Vec<(usize, Replacements)>,
}

impl Inserted {
    /// No move can be repeated.
    #[must_use]
    pub fn none(insertions: &[Insertion]) -> Self {
        Self::each(insertions, |_| None)
    }

    /// Each by itself.
    pub fn each(
        insertions: &[Insertion],
        insert: impl FnMut(&Insertion) -> Option<Replacements>,
    ) -> Self {
        Self {
            moves: insertions.iter().map(insert).collect(),
            ..Self::default()
        }
    }
}

/// The blanks before a byte of a line; `None` where something else stands there.
pub(super) fn indent(bytes: &[u8], at: usize) -> Option<&[u8]> {
    let line = line_start(bytes, at);
    let blanks = &bytes[line..at];
    blanks
        .iter()
        .all(|b| matches!(b, b' ' | b'\t'))
        .then_some(blanks)
}

/// First byte of the line that a byte stands in.
pub(super) fn line_start(bytes: &[u8], at: usize) -> usize {
    let before = bytes[..at].iter().rposition(|b| matches!(b, b'\n' | b'\r'));
    before.map_or(0, |end| end + 1)
}

/// Pairs of numbers with something else, in the order of the text.
fn in_order<'a, T>(numbers: &'a [Number], with: &'a [T]) -> Vec<(&'a Number, &'a T)> {
    let mut pairs: Vec<_> = numbers.iter().zip(with).collect();
    pairs.sort_by_key(|(number, _)| number.start);
    pairs
}

/// A part of a file with other numbers; `None` where one of them does not stand in it.
pub(super) fn with_numbers(
    bytes: &[u8],
    span: &Range<usize>,
    numbers: &[Number],
    texts: &[Vec<u8>],
) -> Option<Vec<u8>> {
    let mut out = Vec::new();
    let mut done = span.start;
    for (number, text) in in_order(numbers, texts) {
        let start = number.start as usize;
        let end = start + usize::from(number.length);
        if start < done || end > span.end {
            return None;
        }
        out.extend_from_slice(&bytes[done..start]);
        out.extend_from_slice(text);
        done = end;
    }
    out.extend_from_slice(&bytes[done..span.end]);
    Some(out)
}

/// What of a target stands for its external axes: from one target to another they stand still where
/// it is the same.
pub(super) type External = fn(&[Source], &Program, &Target) -> Option<Vec<u8>>;

/// How the moves of a language are written again where their targets stand in them.
pub(super) struct Manner {
    /// Whether an instruction, as the text has it, does nothing but go to its target.
    pub repeats: fn(&[u8]) -> bool,
    /// The external axes of a target; nothing where the language has none.
    pub external: Option<External>,
    /// The longest line of the language in bytes.
    pub longest: usize,
}

impl Manner {
    /// See [`super::Language::insert`].
    pub(super) fn insert(
        &self,
        sources: &[Source],
        program: &Program,
        insertions: &[Insertion],
    ) -> Inserted {
        Inserted::each(insertions, |one| self.one(sources, program, one))
    }

    /// The instruction again, with the target of its move written out.
    fn one(
        &self,
        sources: &[Source],
        program: &Program,
        insertion: &Insertion,
    ) -> Option<Replacements> {
        let motion = &program.moves[insertion.motion];
        let target = program.target_of(motion)?;
        let repeated = Repeated::of(sources, program, insertion, self.longest)?;
        if !insertion.is_split() {
            if !(self.repeats)(&repeated.source.bytes[repeated.span.clone()]) {
                return None;
            }
            let mut from = before(program, motion)?;
            if repeated.via.is_some() {
                from = before(program, from)?;
            }
            if let Some(external) = self.external {
                let of = |target: &Target| external(sources, program, target);
                let (from, to) = (of(program.target_of(from)?)?, of(target)?);
                if from != to {
                    return None;
                }
            }
        }
        repeated.insert(insertion, |numbers| {
            let bytes = &sources[target.file as usize].bytes;
            let own = program.numbers_of(target);
            let mut text = with_numbers(bytes, &target.span(), own, numbers)?;
            // what was broken over lines stays one line
            text.retain(|b| !matches!(b, b'\n' | b'\r'));
            Some(text)
        })
    }
}

/// A move whose instruction goes to no other target.
pub(super) fn sole_use(program: &Program, index: usize) -> Option<&Move> {
    let motion = &program.moves[index];
    let others = [index.wrapping_sub(1), index + 1];
    let mut others = others.into_iter().filter_map(|at| program.moves.get(at));
    let is_sole = others
        .all(|other| other.instruction != motion.instruction || other.target == motion.target);
    is_sole.then_some(motion)
}

/// The only move that may come before another.
fn before<'a>(program: &'a Program, motion: &Move) -> Option<&'a Move> {
    match program.before(motion) {
        [Before::One(before)] => program.moves.get(*before as usize),
        _ => None,
    }
}

/// The instruction that goes to the point an arc passes through, in front of the one to its end.
fn via(program: &Program, end: u32) -> Option<&Instruction> {
    let via = program.instructions.get(end.checked_sub(1)? as usize)?;
    let is_one = via.place == program.instructions[end as usize].place;
    (via.motion == Motion::ArcVia && is_one).then_some(via)
}

/// Whether a text starts with one of these words, in any case.
pub(super) fn starts_with_word(text: &[u8], words: &[&str]) -> bool {
    let in_word = |b: &&u8| b.is_ascii_alphanumeric() || **b == b'_';
    let first = &text[..text.iter().take_while(in_word).count()];
    let is = |word: &&str| first.eq_ignore_ascii_case(word.as_bytes());
    words.iter().any(is)
}

/// An instruction that is written again for every target before its own.
pub(super) struct Repeated<'a> {
    /// The file it stands in.
    source: &'a Source,
    /// Its text.
    span: Range<usize>,
    /// The blanks before it.
    blanks: &'a [u8],
    /// Where the point on the way of an arc stands in it.
    via: Option<Range<usize>>,
    /// Where its target stands in it.
    end: Range<usize>,
    /// The longest line of the language in bytes.
    longest: usize,
}

impl<'a> Repeated<'a> {
    /// The instruction of a move that goes to one target, and to that itself, on lines of its own.
    pub(super) fn of(
        sources: &'a [Source],
        program: &Program,
        insertion: &Insertion,
        longest: usize,
    ) -> Option<Self> {
        let motion = sole_use(program, insertion.motion)?;
        if motion.displacement != Displacement::None {
            return None;
        }
        let instruction = &program.instructions[motion.instruction as usize];
        let source = &sources[motion.file as usize];
        let span = instruction.span();
        let is_arc = insertion.between.iter().any(|b| b.via.is_some());
        let via = if is_arc {
            Some(via(program, motion.instruction)?.target_span.range()?)
        } else {
            None
        };
        Some(Self {
            source,
            // a split puts nothing before the move
            blanks: if insertion.is_split() {
                b""
            } else {
                indent(&source.bytes, span.start)?
            },
            via,
            end: instruction.target_span.range()?,
            longest,
            span,
        })
    }

    /// The instruction for each target, in lines before it; `written` makes a target of its
    /// numbers. `None` where one cannot be written, or a line becomes too long.
    pub(super) fn insert(
        &self,
        insertion: &Insertion,
        mut written: impl FnMut(&[Vec<u8>]) -> Option<Vec<u8>>,
    ) -> Option<Replacements> {
        let (mut text, mut changes) = (Vec::new(), Vec::new());
        for (number, Between { via, end }) in insertion.between.iter().enumerate() {
            let through = match via {
                Some(numbers) => Some((self.via.clone()?, written(numbers)?)),
                None => None,
            };
            // the last part of an arc is the move itself with another point
            if self.via.is_some() && number + 1 == insertion.between.len() {
                changes.extend(through);
                continue;
            }
            let here = written(end)?;
            let mut parts: Vec<(Range<usize>, &[u8])> = Vec::new();
            parts.extend(through.iter().map(|(at, text)| (at.clone(), &text[..])));
            parts.push((self.end.clone(), &here));
            let line = spliced(&self.source.bytes, &self.span, &parts);
            if line.len() + self.blanks.len() > self.longest {
                return None;
            }
            text.extend(line);
            text.extend_from_slice(self.source.line_end());
            text.extend_from_slice(self.blanks);
        }
        if let Some(numbers) = &insertion.own {
            changes.push((self.end.clone(), written(numbers)?));
        }
        if !text.is_empty() {
            changes.push((self.span.start..self.span.start, text));
        }
        Some(changes)
    }
}

/// A part of a file with parts of it replaced, in the order of the text.
pub(super) fn spliced(
    bytes: &[u8],
    span: &Range<usize>,
    parts: &[(Range<usize>, &[u8])],
) -> Vec<u8> {
    let mut out = Vec::new();
    let mut done = span.start;
    for (at, with) in parts {
        out.extend_from_slice(&bytes[done..at.start]);
        out.extend_from_slice(with);
        done = at.end;
    }
    out.extend_from_slice(&bytes[done..span.end]);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_put_where_they_stand_whatever_their_order() {
        let number = |start| Number {
            start,
            length: 1,
            value: 0.0,
        };
        let numbers = [number(5), number(1)];
        let texts = [b"xx".to_vec(), b"".to_vec()];
        let out = with_numbers(b"a1b, 2;", &(0..7), &numbers, &texts);
        assert_eq!(out.as_deref(), Some(&b"ab, xx;"[..]));
        assert_eq!(with_numbers(b"a1b, 2;", &(0..5), &numbers, &texts), None);
    }
}
