//! Moves between those of a job: the line again, to a new `C` position.

use super::job::{HEADERS, Job, Letter, Positions};
use crate::program::insert::{Added, Line, Repeated, indent, sole_use, with_numbers};
use crate::program::kit::line_behind;
use crate::program::script::Instruction;
use crate::program::{Inserted, Insertion, Insertions, Move, Program, Replacements, Target};
use std::ops::Range;

/// Highest number of a position.
const MOST_POSITIONS: u32 = 99_999;

/// The header lines above a position.
type Above<'a> = [Option<&'a [u8]>; HEADERS];

/// What the copies of one move are made of.
struct Copied<'a> {
    repeated: Repeated<'a>,
    target: &'a Target,
    above: Above<'a>,
    /// The line of its position behind the `=`.
    body: Range<usize>,
}

/// A line that goes to a `C` position, and the name of that; with words, one that begins with any of
/// them and does nothing else.
fn move_line(
    bytes: &[u8],
    instruction: &Instruction,
    verbs: Option<&[&[u8]]>,
) -> Option<(Range<usize>, Range<usize>)> {
    let span = instruction.span();
    let name = instruction.target_span.range()?;
    let is_plain = verbs.is_none_or(|verbs| {
        let verb = &bytes[span.start..];
        let behind = line_behind(bytes, span.end).unwrap_or(bytes.len());
        let rest = &bytes[span.end..behind];
        verbs.iter().any(|known| verb.starts_with(known)) && rest.trim_ascii().is_empty()
    });
    (is_plain && bytes[name.start] == b'C').then_some((span, name))
}

impl<'a> Copied<'a> {
    fn of(into: &Insertions<'a>, positions: &Positions<'a>, insertion: &Insertion) -> Option<Self> {
        let (source, program) = (&into.sources[into.file], into.program);
        let bytes = &source.bytes;
        let motion = sole_use(program, insertion.motion)?;
        let is_arc = insertion.is_arc();
        let verbs: Option<&[&[u8]]> = if insertion.is_split() {
            None
        } else if is_arc {
            Some(&[b"MOVC "])
        } else {
            Some(&[b"MOVJ ", b"MOVL "])
        };
        let line = |of: &Move| {
            let instruction = &program.instructions[of.instruction as usize];
            let (span, name) = move_line(bytes, instruction, verbs)?;
            Some(Line {
                span,
                targets: vec![name],
                behind: source.line_end().to_vec(),
            })
        };
        let mut lines = Vec::new();
        if is_arc {
            lines.push(line(&program.moves[insertion.motion.checked_sub(1)?])?);
        }
        lines.push(line(motion)?);
        let target = program.target_of(motion)?;
        let own = positions
            .targets
            .binary_search_by_key(&target.offset, |target| target.offset);
        let own = own.ok()?;
        let Range { start, end } = positions.targets[own].span();
        let equals = start + memchr::memchr(b'=', &bytes[start..end])?;
        let before = indent(bytes, lines.last()?.span.start)?.to_vec();
        Some(Self {
            repeated: Repeated {
                source,
                before,
                lines,
                longest: usize::MAX,
            },
            target,
            above: positions.header(own).lines,
            body: equals..end,
        })
    }

    /// The text of the move with new positions behind the last of a job.
    fn repeat(
        &self,
        program: &Program,
        insertion: &Insertion,
        (job, above): (&Own<'a>, &mut Above<'a>),
        new: &mut Added,
    ) -> Option<Replacements> {
        let source = self.repeated.source;
        let own = program.numbers_of(self.target);
        self.repeated.insert(insertion, |_, numbers| {
            let number = job.highest + 1 + new.count;
            if number > MOST_POSITIONS {
                return None;
            }
            let body = with_numbers(&source.bytes, &self.body, own, numbers)?;
            let name = format!("C{number:0width$}", width = job.digits).into_bytes();
            put_headers(&mut new.text, above, &self.above, source.line_end());
            new.count += 1;
            new.text.extend_from_slice(&name);
            new.text.extend(body);
            new.text.extend_from_slice(source.line_end());
            Some(name)
        })
    }
}

/// Header lines where they are not those above.
fn put_headers<'a>(text: &mut Vec<u8>, above: &mut Above<'a>, wanted: &Above<'a>, end: &[u8]) {
    for (above, wanted) in above.iter_mut().zip(wanted) {
        if let Some(line) = wanted.filter(|line| *above != Some(line)) {
            text.extend_from_slice(line);
            text.extend_from_slice(end);
        }
        *above = *wanted;
    }
}

/// The `C` positions of one job.
struct Own<'a> {
    /// First bytes of the job and of what is behind it.
    range: Range<u32>,
    highest: u32,
    /// Digits of a position's number.
    digits: usize,
    /// Behind the line of the last one.
    behind: usize,
    /// The header lines above that.
    above: Above<'a>,
    /// Other positions follow under the same header lines.
    goes_on: bool,
}

impl<'a> Own<'a> {
    fn of(bytes: &[u8], positions: &Positions<'a>, job: &Job) -> Option<Self> {
        let own = |target: &usize| positions.points[*target].letter == Letter::C;
        let last = job.targets.clone().rev().find(own)?;
        let numbers = job.targets.clone().filter(own);
        let highest = numbers
            .map(|target| positions.points[target].number)
            .max()?;
        let offset = positions.targets[last].offset;
        let name = &bytes[offset as usize + 1..];
        Some(Self {
            range: job.offset..crate::program::script::short(job.instructions.end),
            highest,
            digits: name.iter().take_while(|byte| byte.is_ascii_digit()).count(),
            behind: line_behind(bytes, offset as usize).unwrap_or(bytes.len()),
            above: positions.header(last).lines,
            goes_on: job.last_position > offset,
        })
    }
}

/// See [`crate::program::Language::insert`].
pub(super) fn insert(into: &Insertions) -> Inserted {
    let source = &into.sources[into.file];
    let mut inserted = Inserted::none(into.list);
    let mut positions = Positions::default();
    if positions.read(source, 0).is_err() {
        return inserted;
    }
    for job in &positions.jobs {
        let Some(own) = Own::of(&source.bytes, &positions, job) else {
            continue;
        };
        let (mut new, mut above) = (Added::default(), own.above);
        for (insertion, done) in into.list.iter().zip(&mut inserted.moves) {
            let motion = &into.program.moves[insertion.motion];
            let target = into.program.target_of(motion);
            let target = target.expect("inserted moves have a target");
            let is_own = target.file as usize == into.file && own.range.contains(&target.offset);
            if !is_own || !own.range.contains(&motion.offset) {
                continue;
            }
            let before = above;
            *done = Copied::of(into, &positions, insertion).and_then(|copied| {
                let job = (&own, &mut above);
                new.attempt(|new| copied.repeat(into.program, insertion, job, new))
            });
            if done.is_none() {
                above = before;
            }
        }
        if new.count > 0 {
            if own.goes_on {
                put_headers(&mut new.text, &mut above, &own.above, source.line_end());
            }
            inserted.rest.push((own.behind..own.behind, new.text));
            if let Some((count, span)) = job.announced {
                let count = format!("{}", count + new.count).into_bytes();
                inserted
                    .rest
                    .push((span.start as usize..span.end as usize, count));
            }
        }
    }
    inserted
}
