//! The sections of a file: programs, transformations (`.TRANS`), joints (`.JOINTS`), and of
//! `.SYSDATA` the tool and base. Others are passed over.
//!
//! A section begins with its keyword in the first column and ends with `.END`. Names of a program's
//! own begin with a dot, too: only known keywords in capitals open a section.

use crate::program::kit::{Fault, content_start};
use crate::program::script::short;
use crate::program::words::{Spelling, Word, Words, in_names};
use crate::program::{Number, Source, number};
use std::ops::Range;

/// One line of `.TRANS` or `.JOINTS`.
#[derive(Clone, Debug)]
pub(super) struct Entry<'a> {
    /// The name, `#` of joints with it.
    pub name: &'a [u8],
    pub at: u32,
    pub end: u32,
    pub numbers: Vec<Number>,
}

/// One program.
#[derive(Clone, Debug)]
pub(super) struct Program<'a> {
    pub name: &'a [u8],
    /// In small letters.
    pub parameters: Vec<Vec<u8>>,
    pub at: u32,
    /// Its lines without the first and `.END`.
    pub lines: Range<usize>,
}

/// What a file holds.
#[derive(Debug, Default)]
pub(super) struct Sections<'a> {
    pub programs: Vec<Program<'a>>,
    pub entries: Vec<Entry<'a>>,
    /// `TOOL` and `BASE` of `.SYSDATA`: what they were when the controller was saved.
    pub saved: Vec<Entry<'a>>,
    /// Some section of the language is there.
    pub is_one: bool,
}

/// A line without its end, and where it begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    pub text: &'a [u8],
    pub start: usize,
}

/// How words are written: names have dots.
static SPELLING: Spelling = Spelling {
    comment: b";",
    in_names: in_names(b"_.$"),
    has_escapes: false,
    has_entities: false,
};

impl<'a> Line<'a> {
    /// Its words, which are put into `found`.
    pub(super) fn words<'w>(&self, bytes: &'a [u8], found: &'w mut Vec<Word>) -> Words<'a, 'w> {
        found.clear();
        SPELLING.add(bytes, self.start..self.start + self.text.len(), found);
        Words { bytes, all: found }
    }
}

/// The lines of a part of a file; they end with LF, CR LF or CR.
pub(super) fn lines(bytes: &[u8], range: Range<usize>) -> impl Iterator<Item = Line<'_>> {
    let mut at = range.start;
    std::iter::from_fn(move || {
        let rest = bytes.get(at..range.end).filter(|rest| !rest.is_empty())?;
        let length = memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        let line = Line {
            text: &rest[..length],
            start: at,
        };
        at += length + 1;
        Some(line)
    })
}

/// Whether a line is this keyword in the first column.
pub(super) fn opens(line: &[u8], keyword: &[u8]) -> bool {
    let behind = line.strip_prefix(keyword).and_then(|rest| rest.first());
    line == keyword || behind.is_some_and(|b| b.is_ascii_whitespace() || *b == b';')
}

/// Words that only this language has, among those that other languages with `.PROGRAM` have.
const OWN: &[&[u8]] = &[
    b"LMOVE",
    b"JMOVE",
    b"HMOVE",
    b"XMOVE",
    b"C1MOVE",
    b"C2MOVE",
    b"LAPPRO",
    b"JAPPRO",
    b"LDEPART",
    b"JDEPART",
    b"TWAIT",
    b"ACCURACY",
];
/// Bytes that are looked at.
const LOOKED_AT: usize = 1 << 16;

/// Whether bytes look like a file of this language.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(LOOKED_AT)];
    if memchr::memchr(0, head).is_some() {
        return false;
    }
    let (mut opened, mut own) = (false, false);
    let mut found = Vec::new();
    for line in lines(head, content_start(head)..head.len()) {
        opened |= opens(line.text, b".PROGRAM");
        if opens(line.text, b".TRANS") || opens(line.text, b".JOINTS") {
            return true;
        }
        let words = line.words(head, &mut found);
        own |= (0..2).any(|at| OWN.iter().any(|own| words.is_word(at, own)));
        own |= (0..words.len()).any(|at| words.is(at, b'#') && words.is(at + 1, b'['));
        if opened && own {
            return true;
        }
    }
    false
}

/// Reads a file.
pub(super) fn read(source: &Source) -> Result<Sections<'_>, Fault> {
    enum Open {
        Nothing,
        Entries,
        System,
        Program,
        Other,
    }
    let bytes = &source.bytes;
    let mut found = Sections::default();
    let (mut open, mut opened_at) = (Open::Nothing, 0);
    let mut buffer = Vec::new();
    for line in lines(bytes, content_start(bytes)..bytes.len()) {
        let text = line.text;
        if opens(text, b".END") {
            open = Open::Nothing;
        } else if opens(text, b".PROGRAM") {
            found
                .programs
                .push(header(line.words(bytes, &mut buffer), line));
            (open, opened_at, found.is_one) = (Open::Program, line.start, true);
        } else if opens(text, b".TRANS") || opens(text, b".JOINTS") {
            (open, opened_at, found.is_one) = (Open::Entries, line.start, true);
        } else if matches!(open, Open::Nothing) && text.starts_with(b".") {
            let is_system = opens(text, b".SYSDATA");
            open = if is_system { Open::System } else { Open::Other };
            opened_at = line.start;
            found.is_one |= is_system;
        } else if matches!(open, Open::System) {
            let is_frame = text.starts_with(b"TOOL ") || text.starts_with(b"BASE ");
            let frame = Some(line).filter(|_| is_frame);
            found
                .saved
                .extend(frame.and_then(|line| entry(line).ok().flatten()));
        } else if matches!(open, Open::Entries) {
            found.entries.extend(entry(line)?);
        } else if matches!(open, Open::Program)
            && let Some(program) = found.programs.last_mut()
        {
            program.lines.end = line.start + text.len();
        }
    }
    match open {
        // others may be a line alone
        Open::Nothing | Open::Other => Ok(found),
        Open::Entries | Open::System | Open::Program => Err(Fault::unclosed(
            opened_at,
            "the section (its last line is .END)",
        )),
    }
}

/// `.PROGRAM name(a,b) #553; comment`
fn header<'a>(words: Words<'a, '_>, line: Line<'a>) -> Program<'a> {
    let mut parameters = Vec::new();
    if words.is(2, b'(') {
        let list = words.inside(2).0.list().into_iter();
        let named = list.filter(|part| !part.is_empty());
        parameters.extend(named.map(parameter));
    }
    let end = line.start + line.text.len();
    Program {
        name: words.text(1),
        parameters,
        at: short(line.start),
        lines: end..end,
    }
}

/// The name of a parameter: `.p`, also of joints `.#p`, of a pose `.&p`, and of an array `.p[]`.
fn parameter(part: Words) -> Vec<u8> {
    let open = (0..part.len()).find(|at| part.is(*at, b'['));
    let part = part.part(0..open.unwrap_or(part.len()));
    let last = part.text(part.len().saturating_sub(1)).to_ascii_lowercase();
    match part.len() {
        1 => last,
        _ => [b".", &last[..]].concat(),
    }
}

/// `name 1.0 2.0 …`; nothing of an empty line.
fn entry(line: Line<'_>) -> Result<Option<Entry<'_>>, Fault> {
    let text = line.text.trim_ascii_end();
    let blanks = text.len() - text.trim_ascii_start().len();
    let mut at = blanks;
    let name_length = text[at..]
        .iter()
        .take_while(|b| !b.is_ascii_whitespace())
        .count();
    let name = &text[at..at + name_length];
    if name.is_empty() || name[0] == b';' {
        return Ok(None);
    }
    at += name_length;
    let mut numbers = Vec::with_capacity(6);
    while let Some(byte) = text.get(at) {
        if byte.is_ascii_whitespace() {
            at += 1;
            continue;
        }
        let field = text[at..].split(u8::is_ascii_whitespace).next();
        let field = field.unwrap_or_default();
        let start = line.start + at;
        let fault = || Fault::unexpected(start..start + field.len(), "a number");
        numbers.push(number::placed(field, start).ok_or_else(fault)?);
        at += field.len();
    }
    Ok(Some(Entry {
        name,
        at: short(line.start + blanks),
        end: short(line.start + text.len()),
        numbers,
    }))
}
