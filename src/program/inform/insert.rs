//! Moves between those of a job: the line again, to a new `C` position.

use super::lines::{Lines, whole, words};
use crate::program::insert::{indent, line_end, line_start, spliced, with_numbers};
use crate::program::{Between, Inserted, Insertion, Program, Replacements, Source, Target};
use std::ops::Range;

/// Highest number of a position.
const MOST_POSITIONS: u32 = 99_999;
/// Tags that say how fast and how near to go.
const PLAIN: &[&[u8]] = &[
    b"V=", b"VJ=", b"VR=", b"VE=", b"PL=", b"CR=", b"ACC=", b"DEC=",
];
/// Header lines that hold for the positions below them, in the order in which jobs have them.
const HEADERS: usize = 5;

/// Which of those a header line is.
fn header(key: &[u8]) -> Option<usize> {
    match key {
        b"USER" => Some(0),
        b"TOOL" => Some(1),
        b"POSTYPE" => Some(2),
        b"PULSE" | b"RECTAN" | b"ANGLE" => Some(3),
        b"RCONF" => Some(4),
        _ => None,
    }
}

/// The header lines above a position.
type Above<'a> = [Option<&'a [u8]>; HEADERS];

/// The positions of one job.
struct Positions<'a> {
    /// First byte of the job.
    start: usize,
    /// Behind its last line.
    end: usize,
    /// First bytes of the lines of `C` positions, with the header lines above them.
    lines: Vec<(usize, Above<'a>)>,
    highest: u32,
    /// Digits of a position's number.
    digits: usize,
    /// Number of `C` positions that the header announces.
    announced: Option<(Range<usize>, u32)>,
    /// Behind the line of the last `C` position.
    behind: usize,
    /// Whether other positions follow under the same header lines.
    goes_on: bool,
}

/// The byte behind a line and its end.
fn behind_line(bytes: &[u8], at: usize) -> usize {
    let end = line_end(bytes, at);
    match &bytes[end..] {
        [b'\r', b'\n', ..] => end + 2,
        [] => end,
        _ => end + 1,
    }
}

/// All jobs of a file that have positions.
fn jobs(bytes: &[u8]) -> Vec<Positions<'_>> {
    let mut found: Vec<Positions> = Vec::new();
    let (mut above, mut inside): (Above, bool) = ([None; HEADERS], false);
    for line in Lines::of(bytes) {
        if line.text == b"/JOB" {
            found.push(Positions {
                start: line.start,
                end: bytes.len(),
                lines: Vec::new(),
                highest: 0,
                digits: 5,
                announced: None,
                behind: 0,
                goes_on: false,
            });
            (above, inside) = ([None; HEADERS], false);
            let count = found.len();
            if count > 1 {
                found[count - 2].end = line.start;
            }
        }
        let Some(job) = found.last_mut() else {
            continue;
        };
        if let Some(text) = line.text.strip_prefix(b"///") {
            let mut parts = words(text);
            let key = parts.next().unwrap_or_default();
            if let Some(which) = header(key).filter(|_| inside) {
                above[which] = Some(line.text);
            }
            if let (b"NPOS", Some(counts)) = (key, parts.next()) {
                let first = counts.split(|b| *b == b',').next().unwrap_or_default();
                let behind = text[key.len()..].trim_ascii_start().len();
                let at = line.start + line.text.len() - behind;
                job.announced = whole(first).map(|count| (at..at + first.len(), count));
            }
        } else if let Some(text) = line.text.strip_prefix(b"//") {
            inside = words(text).next() == Some(b"POS");
        } else if inside && let Some(equals) = memchr::memchr(b'=', line.text) {
            let name = line.text[..equals].trim_ascii_end();
            if let Some(number) = name.strip_prefix(b"C").and_then(whole) {
                job.lines.push((line.start, above));
                job.highest = job.highest.max(number);
                job.digits = name.len() - 1;
                job.behind = behind_line(bytes, line.start);
                job.goes_on = false;
            } else {
                job.goes_on = true;
            }
        }
    }
    found
}

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
fn plain_move(bytes: &[u8], start: usize, verbs: &[&[u8]]) -> Option<(Range<usize>, Range<usize>)> {
    let end = line_end(bytes, start);
    let span = start..start + bytes[start..end].trim_ascii_end().len();
    let text = &bytes[span.clone()];
    let mut parts = words(text);
    let verb = parts.next()?;
    let name = parts.next()?;
    name.strip_prefix(b"C").and_then(whole)?;
    let tagged = |word: &[u8]| PLAIN.iter().any(|tag| word.starts_with(tag));
    (verbs.contains(&verb) && parts.all(tagged)).then(|| {
        let at = start
            + verb.len()
            + (text.len() - verb.len() - text[verb.len()..].trim_ascii_start().len());
        (span, at..at + name.len())
    })
}

impl<'a> Copied<'a> {
    fn of(
        bytes: &'a [u8],
        program: &Program,
        job: &Positions<'a>,
        insertion: &Insertion,
    ) -> Option<Self> {
        let motion = &program.moves[insertion.motion];
        let is_arc = insertion.between.iter().any(|b| b.via.is_some());
        let verbs: &[&[u8]] = if is_arc {
            &[b"MOVC"]
        } else {
            &[b"MOVJ", b"MOVL"]
        };
        let start = motion.offset as usize;
        let (span, operand) = plain_move(bytes, start, verbs)?;
        let mut via = None;
        if is_arc {
            let through = &program.moves[insertion.motion.checked_sub(1)?];
            via = Some(plain_move(bytes, through.offset as usize, verbs)?);
        }
        let at = line_start(bytes, program.targets[motion.target?].offset as usize);
        let (start, above) = *job
            .lines
            .iter()
            .find(|(start, _)| line_start(bytes, *start) == at)?;
        let end = line_end(bytes, start);
        let equals = start + memchr::memchr(b'=', &bytes[start..end])?;
        Some(Self {
            blanks: indent(bytes, span.start)?,
            span,
            operand,
            via,
            above,
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

/// See [`crate::program::Language::insert`].
pub(super) fn insert(
    source: &Source,
    program: &Program,
    file: usize,
    insertions: &[Insertion],
) -> Inserted {
    let bytes = &source.bytes;
    let mut inserted = Inserted {
        moves: vec![None; insertions.len()],
        rest: Vec::new(),
    };
    for job in jobs(bytes) {
        let Some((_, last)) = job.lines.last() else {
            continue;
        };
        let mut new = NewPositions {
            source,
            digits: job.digits,
            next: job.highest + 1,
            above: *last,
            text: Vec::new(),
            count: 0,
        };
        for (insertion, done) in insertions.iter().zip(&mut inserted.moves) {
            let motion = &program.moves[insertion.motion];
            let target = &program.targets[motion.target.expect("inserted moves have a target")];
            let inside = |offset: u32| (job.start..job.end).contains(&(offset as usize));
            let own = target.file as usize == file && inside(target.offset);
            if !own || !inside(motion.offset) {
                continue;
            }
            let before = (new.next, new.count, new.text.len(), new.above);
            *done = Copied::of(bytes, program, &job, insertion)
                .and_then(|copied| repeat(program, target, &copied, insertion, &mut new));
            if done.is_none() {
                new.text.truncate(before.2);
                (new.next, new.count, new.above) = (before.0, before.1, before.3);
            }
        }
        if new.count > 0 {
            if job.goes_on {
                new.put_headers(last);
            }
            inserted.rest.push((job.behind..job.behind, new.text));
            if let Some((at, count)) = job.announced {
                let count = format!("{}", count + new.count);
                inserted.rest.push((at, count.into_bytes()));
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
    // an arc's parts stand before its first line
    let first = copied.via.as_ref().map_or(&copied.span, |(span, _)| span);
    changes.push((first.start..first.start, text));
    Some(changes)
}
