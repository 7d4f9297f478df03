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

    /// The move is an arc with points on its way.
    #[must_use]
    pub fn is_arc(&self) -> bool {
        self.between.iter().any(|part| part.via.is_some())
    }
}

/// All that is put into one file.
#[derive(Clone, Copy, Debug)]
pub struct Insertions<'a> {
    /// The files.
    pub sources: &'a [Source],
    /// What was read of them.
    pub program: &'a Program,
    /// Index of the file in the sources.
    pub file: usize,
    /// What is put into it.
    pub list: &'a [Insertion],
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
    /// Why an instruction, as the text has it, cannot be written again: what it does besides going
    /// to its target.
    pub forbids: fn(&[u8]) -> Option<&'static str>,
    /// The external axes of a target; nothing where the language has none.
    pub external: Option<External>,
    /// The longest line of the language in bytes.
    pub longest: usize,
    /// What a comment to the end of a line begins with.
    pub comment: u8,
}

impl Manner {
    /// See [`super::Language::insert`].
    pub(super) fn insert(&self, into: &Insertions) -> Inserted {
        Inserted::each(into.list, |one| self.one(into, one))
    }

    /// Makes one line of a target that is broken over several, without the comments between its numbers.
    fn join_lines(&self, text: &mut Vec<u8>) {
        let mut is_comment = false;
        text.retain(|byte| {
            let ends = matches!(byte, b'\n' | b'\r');
            is_comment = !ends && (is_comment || *byte == self.comment);
            !ends && !is_comment
        });
    }

    /// The instruction again, with the target of its move written out.
    fn one(&self, into: &Insertions, insertion: &Insertion) -> Option<Replacements> {
        let Insertions {
            sources, program, ..
        } = *into;
        let motion = &program.moves[insertion.motion];
        let target = program.target_of(motion)?;
        let repeated = Repeated::of(into, insertion, self.longest)?;
        if !insertion.is_split() {
            let line = &repeated.lines[0];
            if (self.forbids)(&repeated.source.bytes[line.span.clone()]).is_some() {
                return None;
            }
            let mut from = before(program, motion)?;
            if line.targets.len() > 1 {
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
        repeated.insert(insertion, |_, numbers| {
            let bytes = &sources[target.file as usize].bytes;
            let own = program.numbers_of(target);
            let mut text = with_numbers(bytes, &target.span(), own, numbers)?;
            self.join_lines(&mut text);
            Some(text)
        })
    }
}

/// A move whose instruction goes to no other target.
pub(crate) fn sole_use(program: &Program, index: usize) -> Option<&Move> {
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

/// What speaks against a move that begins with another word than moves that only go to their
/// target.
pub(super) const DOES_MORE: &str = "it does more than go to its target";

/// Whether a text starts with one of these words, in any case.
pub(super) fn starts_with_word(text: &[u8], words: &[&str]) -> bool {
    let in_word = |b: &&u8| b.is_ascii_alphanumeric() || **b == b'_';
    let first = &text[..text.iter().take_while(in_word).count()];
    let is = |word: &&str| first.eq_ignore_ascii_case(word.as_bytes());
    words.iter().any(is)
}

/// What new moves need at another place: positions of their own.
#[derive(Debug, Default)]
pub(super) struct Added {
    pub text: Vec<u8>,
    /// How many positions it has.
    pub count: u32,
}

impl Added {
    /// Adds what one insertion needs; nothing where it cannot be done.
    pub(super) fn attempt<T>(&mut self, add: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        let before = (self.text.len(), self.count);
        let done = add(self);
        if done.is_none() {
            self.text.truncate(before.0);
            self.count = before.1;
        }
        done
    }
}

/// A line of a move, or of its two an arc has.
pub(super) struct Line {
    /// What of it is written again.
    pub span: Range<usize>,
    /// Where targets stand in it.
    pub targets: Vec<Range<usize>>,
    /// What stands behind each copy.
    pub behind: Vec<u8>,
}

/// A move that is written again for every target before its own.
pub(super) struct Repeated<'a> {
    /// The file it stands in.
    pub source: &'a Source,
    /// What stands before it in its line.
    pub before: Vec<u8>,
    /// Its lines with its target; of an arc with the point on its way before that.
    pub lines: Vec<Line>,
    /// The longest line of the language in bytes.
    pub longest: usize,
}

impl<'a> Repeated<'a> {
    /// The instruction of a move that goes to one target, and to that itself, on lines of its own.
    pub(super) fn of(into: &Insertions<'a>, insertion: &Insertion, longest: usize) -> Option<Self> {
        let program = into.program;
        let motion = sole_use(program, insertion.motion)?;
        if motion.displacement != Displacement::None {
            return None;
        }
        let instruction = &program.instructions[motion.instruction as usize];
        let source = &into.sources[motion.file as usize];
        let span = instruction.span();
        let mut targets = Vec::new();
        if insertion.is_arc() {
            targets.push(via(program, motion.instruction)?.target_span.range()?);
        }
        targets.push(instruction.target_span.range()?);
        // a split puts nothing before the move
        let before = if insertion.is_split() {
            b""
        } else {
            indent(&source.bytes, span.start)?
        };
        Some(Self {
            source,
            before: before.to_vec(),
            lines: vec![Line {
                span,
                targets,
                behind: source.line_end().to_vec(),
            }],
            longest,
        })
    }

    /// Its lines for each target, before it; `written` makes a target of its numbers, one on the
    /// way of an arc (true) or at the end. `None` where one cannot be written, or a line becomes
    /// too long.
    pub(super) fn insert(
        &self,
        insertion: &Insertion,
        mut written: impl FnMut(bool, &[Vec<u8>]) -> Option<Vec<u8>>,
    ) -> Option<Replacements> {
        let bytes = &self.source.bytes;
        let places: Vec<_> = self.lines.iter().flat_map(|line| &line.targets).collect();
        let (first, last) = (places[0], places[places.len() - 1]);
        let (mut text, mut changes) = (Vec::new(), Vec::new());
        for (number, Between { via, end }) in insertion.between.iter().enumerate() {
            let through = match via {
                Some(numbers) => Some(written(true, numbers)?),
                None => None,
            };
            // the last part of an arc is the move itself with another point
            if places.len() > 1 && number + 1 == insertion.between.len() {
                changes.push((first.clone(), through?));
                continue;
            }
            let mut targets = through.into_iter().chain([written(false, end)?]);
            for line in &self.lines {
                let parts = line.targets.iter().cloned().zip(targets.by_ref());
                let copy = spliced(bytes, &line.span, parts);
                if self.before.len() + copy.len() > self.longest {
                    return None;
                }
                text.extend_from_slice(&self.before);
                text.extend(copy);
                text.extend_from_slice(&line.behind);
            }
        }
        if let Some(numbers) = &insertion.own {
            changes.push((last.clone(), written(false, numbers)?));
        }
        if !text.is_empty() {
            let at = line_start(bytes, self.lines[0].span.start);
            changes.push((at..at, text));
        }
        Some(changes)
    }
}

/// A part of a file with parts of it replaced, in the order of the text.
fn spliced(
    bytes: &[u8],
    span: &Range<usize>,
    parts: impl Iterator<Item = (Range<usize>, Vec<u8>)>,
) -> Vec<u8> {
    let mut out = Vec::new();
    let mut done = span.start;
    for (at, with) in parts {
        out.extend_from_slice(&bytes[done..at.start]);
        out.extend(with);
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
