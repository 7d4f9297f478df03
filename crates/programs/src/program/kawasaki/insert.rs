//! Moves between those of a program: the statement again, with its target written out.
//!
//! Clamps behind the target act where the robot arrives: only the last piece keeps them. Settings
//! without `ALWAYS` hold for one move: they are written again in front of each.

use super::keywords::find;
use super::moves::Verb;
use super::sections::{self, read};
use super::watches::OPENING;
use crate::program::insert::{Line, Repeated, indent, sole_use, starts_with_word};
use crate::program::words::Words;
use crate::program::{
    Displacement, Inserted, Insertion, Insertions, Motion, Replacements, Shape, Source, Target,
};
use foldhash::HashMap;
use std::cell::LazyCell;
use std::ops::{Deref, Range};

/// The longest line of a program.
const LONGEST_LINE: usize = 255;

/// See [`crate::program::Language::insert`].
pub(super) fn insert(into: &Insertions) -> Inserted {
    let text = LazyCell::new(|| Text::of(into.sources));
    Inserted::each(into.list, |one| repeat(into, &text, one))
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
    fn of(into: &Insertions<'a>, motion: usize, verbs: &[&str]) -> Option<Self> {
        let program = into.program;
        let motion = sole_use(program, motion)?;
        let source = &into.sources[motion.file as usize];
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
}

/// Settings that hold for the next move alone, unless `ALWAYS` stands there.
const ONCE: &[&str] = &["SPeed", "ACCUracy", "ACCEl", "DECEl"];
/// Statements that do not only run on to the next one, but for those that open a block.
const TURNS: &[&str] = &[
    "IF", "ELse", "ELSEIF", "VALUE", "SVALUE", "ANY", "ENd", "UNtil", "GOto", "CAll", "SCAll",
    "EXtcall", "JUMP", "SJUMP", "RETurn", "RETURNE",
];
/// Statements besides moves that use up what is set for the next move alone.
const PAUSES: &[&str] = &["DELay", "STAble"];

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
            for program in &read(source).unwrap_or_default().programs {
                found.add(file, &source.bytes, program);
            }
        }
        found
    }

    fn add(&mut self, file: usize, bytes: &'a [u8], of: &sections::Program<'a>) {
        let mut present = self.turn(&Before::default());
        let mut last = None;
        of.each(
            bytes,
            |_| true,
            |line| {
                let (keyword, part) = (line.keyword, line.words);
                if line.label.is_some() || TURNS.contains(&keyword) || OPENING.contains(&keyword) {
                    (present, last) = (self.turn(&present), None);
                }
                if part.is_empty() {
                    return;
                }
                let at = (file, part.span().start);
                if Verb::of(line).is_some() || PAUSES.contains(&keyword) {
                    let next = Before {
                        follows: Some(at.1),
                        ..Before::default()
                    };
                    self.moves.insert(at, std::mem::replace(&mut present, next));
                    last = Some(at);
                } else if ONCE.contains(&keyword) {
                    let speed_is_time = (keyword == "SPeed").then(|| is_time(part));
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
                    if keyword == "MVWAIT" {
                        match last.and_then(|last| self.moves.get_mut(&last)) {
                            Some(of_last) => of_last.is_awaited = true,
                            None => self.is_awaited = true,
                        }
                    }
                    let is_watch = matches!(keyword, "ON" | "ONI");
                    self.is_watched |= is_watch && find(part, "GOto").is_some();
                }
            },
        );
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

/// The statements of a move again, each without what stands behind its target, and with the
/// settings for the next one alone behind it.
fn repeat<'a>(
    into: &Insertions<'a>,
    text: &impl Deref<Target = Text<'a>>,
    insertion: &Insertion,
) -> Option<Replacements> {
    let moves = if insertion.is_arc() {
        arc(into, text, insertion)?
    } else {
        let verbs: &[&str] = if insertion.is_split() {
            &["JMOVE", "LMOVE", "HMOVE", "C1MOVE", "C2MOVE"]
        } else {
            &["JMOVE", "LMOVE", "HMOVE"]
        };
        vec![Plain::of(into, insertion.motion, verbs)?]
    };
    let source = moves[0].source;
    // the last part of an arc is the arc itself
    let before = if insertion.between.len() < moves.len() {
        b""
    } else {
        indent(&source.bytes, moves[0].span.start)?
    };
    let mut lines = Vec::new();
    for (at, one) in moves.iter().enumerate() {
        let mut behind = source.line_end().to_vec();
        if !insertion.is_split() {
            for once in text.settings(&moves[(at + 1) % moves.len()])? {
                behind.extend([before, once, source.line_end()].concat());
            }
        }
        lines.push(Line {
            span: one.span.start..one.at.end,
            targets: vec![one.at.clone()],
            behind,
        });
    }
    let repeated = Repeated {
        source,
        before: before.to_vec(),
        lines,
        longest: LONGEST_LINE,
    };
    repeated.insert(insertion, |is_via, numbers| {
        let of = if is_via { moves.first() } else { moves.last() };
        Some(written(of?.target, numbers))
    })
}

/// `C1MOVE` and `C2MOVE` of an arc.
fn arc<'a>(into: &Insertions<'a>, text: &Text, insertion: &Insertion) -> Option<Vec<Plain<'a>>> {
    let through = insertion.motion.checked_sub(1)?;
    if into.program.moves[through].motion != Motion::ArcVia {
        return None;
    }
    let first = Plain::of(into, through, &["C1MOVE"])?;
    let second = Plain::of(into, insertion.motion, &["C2MOVE"])?;
    // a clamp, or what stands between the two, would act at another point of the arc
    let between = text.moves.get(&(second.file, second.span.start))?;
    let is_plain = first.at.end == first.span.end && between.follows == Some(first.span.start);
    is_plain.then(|| vec![first, second])
}
