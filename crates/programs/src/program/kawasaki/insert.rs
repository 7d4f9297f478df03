//! Moves between those of a program: the statement again, with its target written out.
//!
//! Clamps behind the target act where the robot arrives: only the last piece keeps them. Settings
//! without `ALWAYS` hold for one move: they are written again in front of each.

use super::keywords::{begins_with, find};
use super::moves::Verb;
use super::reader::behind_label;
use super::sections::{lines, read};
use super::watches::OPENING;
use crate::program::insert::{indent, sole_use, spliced, starts_with_word};
use crate::program::words::Words;
use crate::program::{
    Displacement, Inserted, Insertion, Motion, Program, Replacements, Shape, Source, Target,
};
use foldhash::HashMap;
use std::cell::LazyCell;
use std::ops::{Deref, Range};

/// The longest line of a program.
const LONGEST_LINE: usize = 255;

/// See [`crate::program::Language::insert`].
pub(super) fn insert(sources: &[Source], program: &Program, insertions: &[Insertion]) -> Inserted {
    let text = LazyCell::new(|| Text::of(sources));
    Inserted::each(insertions, |one| {
        if one.between.iter().any(|part| part.via.is_some()) {
            arc(sources, program, &text, one)
        } else {
            repeat(sources, program, &text, one)
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
    file: usize,
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
            file: motion.file as usize,
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
/// Statements that do not only run on to the next one, but for those that open a block.
const TURNS: &[&[u8]] = &[
    b"IF", b"ELSE", b"ELSEIF", b"VALUE", b"SVALUE", b"ANY", b"END", b"UNTIL", b"GOTO", b"CALL",
    b"SCALL", b"EXTCALL", b"JUMP", b"SJUMP", b"RETURN", b"RETURNE",
];
/// Statements besides moves that use up what is set for the next move alone.
const PAUSES: &[&[u8]] = &[b"DELAY", b"STABLE"];

/// What stands between a move and the one before it in the text.
#[derive(Default)]
struct Before<'a> {
    /// The settings for the move alone.
    once: Vec<&'a [u8]>,
    /// One for all moves stands behind them.
    is_mixed: bool,
    /// Whether the speed among them is a time.
    is_timed: Option<bool>,
    /// The program may come from elsewhere, with what is set there.
    is_turned: bool,
    /// The move before, where nothing but settings stands between.
    follows: Option<usize>,
    /// `MVWAIT` asks how far this move is.
    is_awaited: bool,
}

/// The moves of all files as their text has them.
#[derive(Default)]
struct Text<'a> {
    /// By file and first byte.
    moves: HashMap<(usize, usize), Before<'a>>,
    /// There are settings for one move, and those of which the text does not tell the move.
    sets_once: bool,
    is_loose: bool,
    /// A signal may take the program from between a setting and its move.
    is_watched: bool,
    /// The speed of all moves may be a time.
    is_timed: bool,
    /// `MVWAIT` asks for a move that the text does not tell.
    is_awaited: bool,
}

impl<'a> Text<'a> {
    fn of(sources: &'a [Source]) -> Self {
        let mut found = Self::default();
        for (file, source) in sources.iter().enumerate() {
            for program in read(source).unwrap_or_default().programs {
                found.add(file, &source.bytes, program.lines);
            }
        }
        found
    }

    fn add(&mut self, file: usize, bytes: &'a [u8], of: Range<usize>) {
        let mut present = self.turn(&Before::default());
        let mut last = None;
        let mut words = Vec::new();
        for line in lines(bytes, of) {
            let (label, part) = behind_label(line.words(bytes, &mut words));
            let is = |known: &&[u8]| begins_with(part, known);
            if label.is_some() || TURNS.iter().chain(OPENING).any(is) {
                (present, last) = (self.turn(&present), None);
            }
            if part.is_empty() {
                continue;
            }
            let at = (file, part.span().start);
            if Verb::of(part).is_some() || PAUSES.iter().any(is) {
                let next = Before {
                    follows: Some(at.1),
                    ..Before::default()
                };
                self.moves.insert(at, std::mem::replace(&mut present, next));
                last = Some(at);
            } else if ONCE.iter().any(is) {
                let speed_is_time = is(&&b"SPEED"[..]).then(|| is_time(part));
                if part.find(b"ALWAYS").is_some() {
                    self.is_timed |= speed_is_time == Some(true);
                    present.is_mixed |= !present.once.is_empty();
                } else {
                    self.sets_once = true;
                    present.is_timed = speed_is_time.or(present.is_timed);
                    present.once.push(part.whole());
                }
            } else {
                present.follows = None;
                if is(&&b"MVWAIT"[..]) {
                    match last.and_then(|last| self.moves.get_mut(&last)) {
                        Some(of_last) => of_last.is_awaited = true,
                        None => self.is_awaited = true,
                    }
                }
                let is_watch = is(&&b"ON"[..]) || is(&&b"ONI"[..]);
                self.is_watched |= is_watch && find(part, b"GOTO").is_some();
            }
        }
        self.turn(&present);
    }

    /// What stands before a place that the program may come to from elsewhere.
    fn turn(&mut self, present: &Before) -> Before<'a> {
        self.is_loose |= !present.once.is_empty();
        Before {
            is_turned: true,
            ..Before::default()
        }
    }

    /// The settings that are written again with each piece of a move; `None` where the text does
    /// not tell them for each run of it, or where pieces would do something else.
    fn settings(&self, statement: &Plain) -> Option<&[&'a [u8]]> {
        let before = self.moves.get(&(statement.file, statement.span.start))?;
        let is_brought = self.is_loose || self.sets_once && self.is_watched;
        // a time is that of the whole move
        let is_timed = before.is_timed.unwrap_or(self.is_timed);
        let is_awaited = before.is_awaited || self.is_awaited;
        let is_other = before.is_mixed || before.is_turned && is_brought || is_timed || is_awaited;
        (!is_other).then_some(&before.once)
    }
}

/// Whether a speed is a time: `SPEED 5 S`, `SPEED 5S`.
fn is_time(part: Words) -> bool {
    (1..part.len()).any(|at| {
        let text = part.text(at);
        let is_unit = at > 1 && part.is_word(at, b"S") && !part.is(at - 1, b'/');
        is_unit || text[0].is_ascii_digit() && matches!(text, [.., b's' | b'S'])
    })
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

fn repeat<'a>(
    sources: &'a [Source],
    program: &Program,
    text: &impl Deref<Target = Text<'a>>,
    insertion: &Insertion,
) -> Option<Replacements> {
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
        let once = text.settings(&whole)?;
        let mut lines = Lines::before(&whole)?;
        for piece in &insertion.between {
            lines.add(&whole.to(&piece.end))?;
            lines.add_all(once)?;
        }
        changes.push((whole.span.start..whole.span.start, lines.text));
    }
    Some(changes)
}

/// `C1MOVE` and `C2MOVE` once more for each part of an arc but the last, which is the arc's own
/// with another point on its way.
fn arc(
    sources: &[Source],
    program: &Program,
    text: &Text,
    insertion: &Insertion,
) -> Option<Replacements> {
    let through = insertion.motion.checked_sub(1)?;
    if program.moves[through].motion != Motion::ArcVia {
        return None;
    }
    let first = Plain::of(sources, program, through, &["C1MOVE"])?;
    let second = Plain::of(sources, program, insertion.motion, &["C2MOVE"])?;
    // a clamp, or what stands between the two, would act at another point of the arc
    let between = text.moves.get(&(second.file, second.span.start))?;
    if first.at.end != first.span.end || between.follows != Some(first.span.start) {
        return None;
    }
    let of_first = text.settings(&first)?;
    let of_second = text.settings(&second)?;
    let (last, parts) = insertion.between.split_last()?;
    let mut changes = vec![(first.at.clone(), written(first.target, last.via.as_ref()?))];
    if let Some(numbers) = &insertion.own {
        changes.push((second.at.clone(), written(second.target, numbers)));
    }
    if !parts.is_empty() {
        let mut lines = Lines::before(&first)?;
        for part in parts {
            lines.add(&first.to(part.via.as_ref()?))?;
            lines.add_all(of_second)?;
            lines.add(&second.to(&part.end))?;
            lines.add_all(of_first)?;
        }
        changes.push((first.span.start..first.span.start, lines.text));
    }
    Some(changes)
}
