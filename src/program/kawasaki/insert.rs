//! Moves between those of a program: the statement again, with its target written out.
//!
//! Clamps behind the target act where the robot arrives: only the last piece keeps them. Settings
//! without `ALWAYS` hold for one move: they are written again in front of each.

use super::reader::behind_label;
use super::sections::{lines, opens};
use crate::program::insert::{indent, sole_use, spliced, starts_with_word};
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

/// A statement that goes to one target and adds nothing to it.
struct Plain<'a> {
    source: &'a Source,
    span: Range<usize>,
    /// Where its target stands.
    at: Range<usize>,
    target: &'a Target,
}

impl<'a> Plain<'a> {
    /// The statement of a move where it begins with one of these words.
    fn of(
        sources: &'a [Source],
        program: &'a Program,
        motion: usize,
        verbs: &[&str],
    ) -> Option<Self> {
        let motion = sole_use(program, motion)?;
        let source = &sources[motion.file as usize];
        let instruction = &program.instructions[motion.instruction as usize];
        let span = instruction.span();
        let is_plain = motion.displacement == Displacement::None
            && starts_with_word(&source.bytes[span.clone()], verbs);
        Some(Self {
            source,
            span,
            at: instruction.target_span.range()?,
            target: program.target_of(motion).filter(|_| is_plain)?,
        })
    }

    /// The statement with another target, and nothing behind that.
    fn to(&self, numbers: &[Vec<u8>]) -> Vec<u8> {
        let target = written(self.target, numbers);
        let span = self.span.start..self.at.end;
        spliced(&self.source.bytes, &span, &[(self.at.clone(), &target)])
    }
}

/// Settings that hold for the next move alone, unless `ALWAYS` stands there.
const ONCE: &[&[u8]] = &[b"SPEED", b"ACCURACY", b"ACCEL", b"DECEL"];
/// Statements that do not only run on to the next one.
const TURNS: &[&[u8]] = &[
    b"IF", b"ELSE", b"ELSEIF", b"CASE", b"SCASE", b"VALUE", b"SVALUE", b"ANY", b"WHILE", b"FOR",
    b"DO", b"END", b"UNTIL", b"GOTO", b"CALL", b"SCALL", b"EXTCALL", b"JUMP", b"SJUMP", b"RETURN",
];

/// The settings that hold for a move alone: they stand between it and the move before. `None` where
/// the text does not tell whether they hold for each run of it.
fn settings<'a>(sources: &'a [Source], program: &Program, motion: usize) -> Option<Vec<&'a [u8]>> {
    let own = program.moves[motion].instruction as usize;
    let instruction = &program.instructions[own];
    let file = instruction.place.file;
    let before = program.instructions[..own].last();
    let before = before.filter(|before| before.place.file == file);
    let start = before.map_or(0, |before| before.span().end);
    let bytes = &sources[file as usize].bytes;
    let mut found = Vec::new();
    let mut words = Vec::new();
    for line in lines(bytes, start..instruction.span().start) {
        if opens(line.text, b".PROGRAM") {
            found.clear();
            continue;
        }
        let (label, part) = behind_label(line.words(bytes, &mut words));
        let is = |known: &&[u8]| part.is_word(0, known);
        let is_setting = ONCE.iter().any(is);
        let is_once = is_setting && part.find(b"ALWAYS").is_none();
        let turns = label.is_some() || TURNS.iter().any(is);
        if !found.is_empty() && (turns || is_setting && !is_once) {
            return None;
        }
        if is_once {
            found.push(part.whole());
        }
    }
    Some(found)
}

/// Statements on lines of their own before another.
struct Lines<'a> {
    source: &'a Source,
    blanks: &'a [u8],
    text: Vec<u8>,
}

impl<'a> Lines<'a> {
    fn before(statement: &Plain<'a>) -> Option<Self> {
        let source = statement.source;
        Some(Self {
            source,
            blanks: indent(&source.bytes, statement.span.start)?,
            text: Vec::new(),
        })
    }

    /// Adds a statement; `None` where its line becomes too long.
    fn add(&mut self, statement: &[u8]) -> Option<()> {
        self.text.extend_from_slice(statement);
        self.text.extend_from_slice(self.source.line_end());
        self.text.extend_from_slice(self.blanks);
        (self.blanks.len() + statement.len() <= LONGEST_LINE).then_some(())
    }

    fn add_all(&mut self, statements: &[&[u8]]) -> Option<()> {
        statements.iter().try_for_each(|one| self.add(one))
    }
}

fn repeat(sources: &[Source], program: &Program, insertion: &Insertion) -> Option<Replacements> {
    let verbs: &[&str] = if insertion.is_split() {
        &["JMOVE", "LMOVE", "HMOVE", "C1MOVE", "C2MOVE"]
    } else {
        &["JMOVE", "LMOVE", "HMOVE"]
    };
    let whole = Plain::of(sources, program, insertion.motion, verbs)?;
    let mut changes = Vec::new();
    if let Some(numbers) = &insertion.own {
        changes.push((whole.at.clone(), written(whole.target, numbers)));
    }
    if !insertion.is_split() {
        let once = settings(sources, program, insertion.motion)?;
        let mut lines = Lines::before(&whole)?;
        for piece in &insertion.between {
            lines.add(&whole.to(&piece.end))?;
            lines.add_all(&once)?;
        }
        changes.push((whole.span.start..whole.span.start, lines.text));
    }
    Some(changes)
}

/// `C1MOVE` and `C2MOVE` once more for each part of an arc but the last, which is the arc's own
/// with another point on its way.
fn arc(sources: &[Source], program: &Program, insertion: &Insertion) -> Option<Replacements> {
    let through = insertion.motion.checked_sub(1)?;
    if program.moves[through].motion != Motion::ArcVia {
        return None;
    }
    let first = Plain::of(sources, program, through, &["C1MOVE"])?;
    let second = Plain::of(sources, program, insertion.motion, &["C2MOVE"])?;
    // its clamp would act at another point of the arc
    if first.at.end != first.span.end {
        return None;
    }
    let (last, parts) = insertion.between.split_last()?;
    let mut changes = vec![(first.at.clone(), written(first.target, last.via.as_ref()?))];
    if let Some(numbers) = &insertion.own {
        changes.push((second.at.clone(), written(second.target, numbers)));
    }
    if !parts.is_empty() {
        let of_first = settings(sources, program, through)?;
        let of_second = settings(sources, program, insertion.motion)?;
        let mut lines = Lines::before(&first)?;
        for part in parts {
            lines.add(&first.to(part.via.as_ref()?))?;
            lines.add_all(&of_second)?;
            lines.add(&second.to(&part.end))?;
            lines.add_all(&of_first)?;
        }
        changes.push((first.span.start..first.span.start, lines.text));
    }
    Some(changes)
}
