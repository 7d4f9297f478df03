//! Moves between those of a job: the line again, to a new `C` position.

use super::job::{HEADERS, Job, Letter, Positions};
use crate::program::insert::{indent, sole_use, spliced, with_numbers};
use crate::program::kit::line_behind;
use crate::program::script::Instruction;
use crate::program::{Between, Inserted, Insertion, Program, Replacements, Source, Target};
use std::ops::Range;

/// Highest number of a position.
const MOST_POSITIONS: u32 = 99_999;

/// The header lines above a position.
type Above<'a> = [Option<&'a [u8]>; HEADERS];

/// What the copies of one move are made of.
struct Copied<'a> {
    /// The line without its blanks, and the blanks.
    span: Range<usize>,
    blanks: &'a [u8],
    /// The name of the position in it.
    operand: Range<usize>,
    /// Of an arc: the line and the position of the point on the way.
    via: Option<(Range<usize>, Range<usize>)>,
    above: Above<'a>,
    /// The line of its position behind the `=`.
    body: Range<usize>,
}

/// A line that does nothing but go to a `C` position, and the name of that.
fn plain_move(
    bytes: &[u8],
    instruction: &Instruction,
    verbs: &[&[u8]],
) -> Option<(Range<usize>, Range<usize>)> {
    let span = instruction.span();
    let name = instruction.target_span.range()?;
    let verb = &bytes[span.start..];
    let behind = line_behind(bytes, span.end).unwrap_or(bytes.len());
    let rest = &bytes[span.end..behind];
    let is_plain = verbs.iter().any(|known| verb.starts_with(known))
        && bytes[name.start] == b'C'
        && rest.trim_ascii().is_empty();
    is_plain.then_some((span, name))
}

impl<'a> Copied<'a> {
    fn of(
        bytes: &'a [u8],
        program: &Program,
        positions: &Positions<'a>,
        insertion: &Insertion,
    ) -> Option<Self> {
        let motion = sole_use(program, insertion.motion)?;
        let is_arc = insertion.between.iter().any(|b| b.via.is_some());
        let verbs: &[&[u8]] = if insertion.is_split() {
            &[b"MOVJ ", b"MOVL ", b"MOVC ", b"MOVS "]
        } else if is_arc {
            &[b"MOVC "]
        } else {
            &[b"MOVJ ", b"MOVL "]
        };
        let instruction =
            |of: &crate::program::Move| &program.instructions[of.instruction as usize];
        let (span, operand) = plain_move(bytes, instruction(motion), verbs)?;
        let mut via = None;
        if is_arc {
            let through = &program.moves[insertion.motion.checked_sub(1)?];
            via = Some(plain_move(bytes, instruction(through), verbs)?);
        }
        let at = program.targets[motion.target?].offset;
        let own = positions
            .targets
            .binary_search_by_key(&at, |target| target.offset);
        let own = own.ok()?;
        let Range { start, end } = positions.targets[own].span();
        let equals = start + memchr::memchr(b'=', &bytes[start..end])?;
        Some(Self {
            blanks: indent(bytes, span.start)?,
            span,
            operand,
            via,
            above: positions.header(own).lines,
            body: equals..end,
        })
    }
}

/// New positions of a job.
struct NewPositions<'a> {
    source: &'a Source,
    digits: usize,
    next: u32,
    /// Header lines above the next new position.
    above: Above<'a>,
    text: Vec<u8>,
    count: u32,
}

impl<'a> NewPositions<'a> {
    /// Header lines where they are not those above.
    fn put_headers(&mut self, above: &Above<'a>) {
        for which in 0..HEADERS {
            if let Some(line) = above[which].filter(|line| self.above[which] != Some(line)) {
                self.text.extend_from_slice(line);
                self.text.extend_from_slice(self.source.line_end());
            }
        }
        self.above = *above;
    }

    /// A position like that of a move with other numbers; its name.
    fn add(
        &mut self,
        program: &Program,
        target: &Target,
        copied: &Copied<'a>,
        numbers: &[Vec<u8>],
    ) -> Option<Vec<u8>> {
        if self.next > MOST_POSITIONS {
            return None;
        }
        let bytes = &self.source.bytes;
        let own = program.numbers_of(target);
        let body = with_numbers(bytes, &copied.body, own, numbers)?;
        let name = format!("C{:0width$}", self.next, width = self.digits).into_bytes();
        self.put_headers(&copied.above);
        self.text.extend_from_slice(&name);
        self.text.extend(body);
        self.text.extend_from_slice(self.source.line_end());
        self.next += 1;
        self.count += 1;
        Some(name)
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
pub(super) fn insert(
    source: &Source,
    program: &Program,
    file: usize,
    insertions: &[Insertion],
) -> Inserted {
    let bytes = &source.bytes;
    let mut inserted = Inserted::none(insertions);
    let mut positions = Positions::default();
    if positions.read(source, 0).is_err() {
        return inserted;
    }
    for job in &positions.jobs {
        let Some(own) = Own::of(bytes, &positions, job) else {
            continue;
        };
        let mut new = NewPositions {
            source,
            digits: own.digits,
            next: own.highest + 1,
            above: own.above,
            text: Vec::new(),
            count: 0,
        };
        for (insertion, done) in insertions.iter().zip(&mut inserted.moves) {
            let motion = &program.moves[insertion.motion];
            let target = &program.targets[motion.target.expect("inserted moves have a target")];
            let is_own = target.file as usize == file && own.range.contains(&target.offset);
            if !is_own || !own.range.contains(&motion.offset) {
                continue;
            }
            let before = (new.next, new.count, new.text.len(), new.above);
            *done = Copied::of(bytes, program, &positions, insertion)
                .and_then(|copied| repeat(program, target, &copied, insertion, &mut new));
            if done.is_none() {
                new.text.truncate(before.2);
                (new.next, new.count, new.above) = (before.0, before.1, before.3);
            }
        }
        if new.count > 0 {
            if own.goes_on {
                new.put_headers(&own.above);
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

fn repeat<'a>(
    program: &Program,
    target: &Target,
    copied: &Copied<'a>,
    insertion: &Insertion,
    new: &mut NewPositions<'a>,
) -> Option<Replacements> {
    let source = new.source;
    let (bytes, end) = (&source.bytes, source.line_end());
    let (mut text, mut changes) = (Vec::new(), Vec::new());
    for (number, Between { via, end: here }) in insertion.between.iter().enumerate() {
        let via = match (via, &copied.via) {
            (Some(numbers), Some(place)) => {
                Some((new.add(program, target, copied, numbers)?, place))
            }
            _ => None,
        };
        // the last part of an arc is the move itself with another point
        if let Some((name, (_, operand))) = &via
            && number + 1 == insertion.between.len()
        {
            changes.push((operand.clone(), name.clone()));
            continue;
        }
        let here = new.add(program, target, copied, here)?;
        let mut line = |span: &Range<usize>, operand: &Range<usize>, name: &[u8]| {
            text.extend(spliced(bytes, span, &[(operand.clone(), name)]));
            text.extend_from_slice(end);
            text.extend_from_slice(copied.blanks);
        };
        if let Some((name, (span, operand))) = &via {
            line(span, operand, name);
        }
        line(&copied.span, &copied.operand, &here);
    }
    if let Some(numbers) = &insertion.own {
        let name = new.add(program, target, copied, numbers)?;
        changes.push((copied.operand.clone(), name));
    }
    if !text.is_empty() {
        // an arc's parts stand before its first line
        let first = copied.via.as_ref().map_or(&copied.span, |(span, _)| span);
        changes.push((first.start..first.start, text));
    }
    Some(changes)
}
