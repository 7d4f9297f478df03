//! The sections of a file: programs, transformations (`.TRANS`), joints (`.JOINTS`), and of
//! `.SYSDATA` the tool and base. Others are passed over.
//!
//! A section begins with its keyword in the first column and ends with `.END`. Names of a program's
//! own begin with a dot, too: only known keywords in capitals open a section.

use super::keywords::keyword;
use crate::program::kit::{Fault, content_start};
use crate::program::script::{Place, short};
use crate::program::words::{Kind, Spelling, Word, Words, in_names};
use crate::program::{Number, Source, number};
use std::ops::Range;

/// One line of `.TRANS` or `.JOINTS`.
#[derive(Clone, Debug)]
pub(super) struct Entry<'a> {
    /// The name, `#` of joints with it.
    pub name: &'a [u8],
    pub place: Place,
    pub end: u32,
    pub numbers: Vec<Number>,
}

/// One program.
#[derive(Clone, Debug)]
pub(super) struct Program<'a> {
    pub name: &'a [u8],
    /// In small letters.
    pub parameters: Vec<Vec<u8>>,
    pub place: Place,
    /// Its lines without the first and `.END`.
    pub lines: Range<usize>,
}

/// What files hold.
#[derive(Debug, Default)]
pub(super) struct Sections<'a> {
    pub programs: Vec<Program<'a>>,
    pub entries: Vec<Entry<'a>>,
    /// `TOOL` and `BASE` of `.SYSDATA`: what they were when the controller was saved.
    pub saved: Vec<Entry<'a>>,
    /// Names of `.REALS`, and their values.
    pub reals: Vec<(&'a [u8], f64)>,
}

/// A line without its end, and where it begins.
#[derive(Clone, Copy, Debug)]
struct Line<'a> {
    text: &'a [u8],
    start: usize,
}

/// A line of a program.
pub(super) struct Statement<'a, 'w> {
    /// Where the line begins.
    pub start: usize,
    /// What it is jumped to by.
    pub label: Option<&'a [u8]>,
    /// What its words begin with.
    pub keyword: &'static str,
    /// All behind the label.
    pub words: Words<'a, 'w>,
}

impl<'a> Program<'a> {
    /// Visits its lines, but for those whose text is not wanted.
    pub(super) fn each(
        &self,
        bytes: &'a [u8],
        is_wanted: impl Fn(&[u8]) -> bool,
        mut visit: impl FnMut(&Statement<'a, '_>),
    ) {
        let mut found = Vec::new();
        for line in lines(bytes, self.lines.clone()).filter(|line| is_wanted(line.text)) {
            let (label, words) = behind_label(line.words(bytes, &mut found));
            let words = commanded(words);
            visit(&Statement {
                start: line.start,
                label,
                keyword: keyword(words),
                words,
            });
        }
    }
}

/// What a process gives the monitor to do (`MC TOOL t`), where that sets something.
///
/// # Source
/// *Not verified on a controller.*
fn commanded<'a, 'w>(line: Words<'a, 'w>) -> Words<'a, 'w> {
    let command = line.behind(usize::from(line.is_word(0, b"MC")));
    let sets = matches!(
        keyword(command),
        "TOOL" | "BAse" | "POint" | "HEre" | "WEight"
    );
    if sets { command } else { line }
}

/// The number or name that a line begins with to be jumped to, and what is behind it.
fn behind_label<'a, 'w>(line: Words<'a, 'w>) -> (Option<&'a [u8]>, Words<'a, 'w>) {
    let has_colon = line.is(1, b':') && !line.is_word(0, b"ANY");
    if line.kind(0) == Some(Kind::Number) || has_colon {
        let words = if line.is(1, b':') { 2 } else { 1 };
        return (Some(line.text(0)), line.behind(words));
    }
    (None, line)
}

/// How words are written: names have dots.
pub(super) const SPELLING: Spelling = Spelling {
    comment: b";",
    in_names: in_names(b"_.$"),
    has_escapes: false,
    has_entities: false,
};

impl<'a> Line<'a> {
    /// Its words, which are put into `found`.
    fn words<'w>(&self, bytes: &'a [u8], found: &'w mut Vec<Word>) -> Words<'a, 'w> {
        found.clear();
        SPELLING.add(bytes, self.start..self.start + self.text.len(), found);
        Words { bytes, all: found }
    }
}

/// The lines of a part of a file; they end with LF, CR LF or CR.
fn lines(bytes: &[u8], range: Range<usize>) -> impl Iterator<Item = Line<'_>> {
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
fn opens(line: &[u8], keyword: &[u8]) -> bool {
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
/// Moves of another language with `.PROGRAM` (V+).
const OTHER: &[&[u8]] = &[
    b"MOVE", b"MOVES", b"APPRO", b"APPROS", b"DEPART", b"DEPARTS",
];
/// Sections with what a controller is set to, which end with `.END`; numbers may stand behind these
/// words.
const SETTINGS: &[&[u8]] = &[
    b".ROBOTDATA",
    b".OPE_INFO",
    b".CONDITION",
    b".AUXDATA",
    b".SIG_COMMENT",
];

/// Sections that no other language has.
const SECTIONS: &[&[u8]] = &[b".TRANS", b".JOINTS", b".REALS", b".SYSDATA", b".NETCONF"];

/// Whether a keyword begins a section of settings: also of the panel, whose sections have several names.
fn is_setting(word: &[u8]) -> bool {
    SETTINGS.contains(&word) || word.starts_with(b".INTER_PANEL")
}

/// Bytes in which a zero says that it is no text.
const LOOKED_AT: usize = 1 << 16;

/// The keyword in the first column without numbers behind it.
fn section(line: &[u8]) -> &[u8] {
    let end = line
        .iter()
        .position(|b| b.is_ascii_whitespace() || *b == b';');
    let mut word = &line[..end.unwrap_or(line.len())];
    while let [front @ .., b'0'..=b'9'] = word {
        word = front;
    }
    word
}

/// Whether bytes look like a file of this language. In whole saves programs stand behind much that
/// the controller is set to.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    if memchr::memchr(0, &bytes[..bytes.len().min(LOOKED_AT)]).is_some() {
        return false;
    }
    let mut opened = false;
    let mut found = Vec::new();
    for line in lines(bytes, content_start(bytes)..bytes.len()) {
        if line.text.first() == Some(&b'.') {
            opened |= opens(line.text, b".PROGRAM");
            let word = section(line.text);
            if SECTIONS.contains(&word) || is_setting(word) {
                return true;
            }
        }
        if opened {
            let words = line.words(bytes, &mut found);
            if (0..2).any(|at| OWN.iter().any(|own| words.is_word(at, own)))
                || (0..words.len()).any(|at| words.is(at, b'#') && words.is(at + 1, b'['))
            {
                return true;
            }
        }
    }
    false
}

/// Whether a file that is called as programs of this language are is one, though it may move nothing.
pub(super) fn accepts(source: &Source) -> bool {
    let bytes = &source.bytes;
    let mut sections = Sections::default();
    if !sections.read(source, 0).is_ok_and(|is_one| is_one) {
        return false;
    }
    let mut is_other = false;
    for program in &sections.programs {
        program.each(
            bytes,
            |_| true,
            |statement| {
                let words = statement.words;
                is_other |= OTHER.iter().any(|other| words.is_word(0, other)) && !words.is(1, b'=');
            },
        );
    }
    !is_other
}

impl<'a> Sections<'a> {
    /// Adds those of a file; whether some section of the language is there.
    pub(super) fn read(&mut self, source: &'a Source, file: u32) -> Result<bool, Fault> {
        enum Open {
            Nothing,
            Entries,
            System,
            Reals,
            Program,
            Settings,
            Other,
        }
        let bytes = &source.bytes;
        let (mut open, mut opened_at, mut is_one) = (Open::Nothing, 0, false);
        let mut buffer = Vec::new();
        for line in lines(bytes, content_start(bytes)..bytes.len()) {
            let text = line.text;
            if opens(text, b".END") {
                open = Open::Nothing;
            } else if opens(text, b".PROGRAM") {
                let words = line.words(bytes, &mut buffer);
                self.programs.push(header(words, line, file));
                (open, opened_at, is_one) = (Open::Program, line.start, true);
            } else if opens(text, b".TRANS") || opens(text, b".JOINTS") {
                (open, opened_at, is_one) = (Open::Entries, line.start, true);
            } else if matches!(open, Open::Nothing | Open::Other) && is_setting(section(text)) {
                (open, opened_at, is_one) = (Open::Settings, line.start, true);
            } else if matches!(open, Open::Nothing | Open::Other) && text.starts_with(b".") {
                // a line such as `.*header` or `.NETCONF …` has no end of its own
                let is_system = opens(text, b".SYSDATA");
                open = match () {
                    () if is_system => Open::System,
                    () if opens(text, b".REALS") => Open::Reals,
                    () => Open::Other,
                };
                opened_at = line.start;
                is_one |= !matches!(open, Open::Other) || section(text) == b".NETCONF";
            } else if matches!(open, Open::System) {
                if text.starts_with(b"TOOL ") || text.starts_with(b"BASE ") {
                    self.saved.extend(entry(line, file).ok().flatten());
                }
            } else if matches!(open, Open::Reals) {
                self.reals.extend(real(text));
            } else if matches!(open, Open::Entries) {
                self.entries.extend(entry(line, file)?);
            } else if matches!(open, Open::Program)
                && let Some(program) = self.programs.last_mut()
            {
                program.lines.end = line.start + text.len();
            }
        }
        match open {
            // others may be a line alone
            Open::Nothing | Open::Other | Open::Reals => Ok(is_one),
            Open::Entries | Open::System | Open::Program | Open::Settings => Err(Fault::unclosed(
                opened_at,
                "the section (its last line is .END)",
            )),
        }
    }
}

/// Those of one file.
pub(super) fn read(source: &Source) -> Result<Sections<'_>, Fault> {
    let mut found = Sections::default();
    found.read(source, 0)?;
    Ok(found)
}

/// `.PROGRAM name(a,b) #553; comment`
fn header<'a>(words: Words<'a, '_>, line: Line<'a>, file: u32) -> Program<'a> {
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
        place: Place::new(file, short(line.start)),
        lines: end..end,
    }
}

/// The name of a parameter: `.p`, also of joints `.#p`, of a pose `.&p`, and of an array `.p[]`.
fn parameter(part: Words) -> Vec<u8> {
    let part = part.before(b'[');
    let last = part.text(part.len().saturating_sub(1)).to_ascii_lowercase();
    match part.len() {
        1 => last,
        _ => [b".", &last[..]].concat(),
    }
}

/// `name = 1.0`
fn real(line: &[u8]) -> Option<(&[u8], f64)> {
    let at = memchr::memchr(b'=', line)?;
    let value = number::parse(line[at + 1..].trim_ascii())?;
    Some((line[..at].trim_ascii(), value))
}

/// `name 1.0 2.0 …`; nothing of an empty line.
fn entry(line: Line<'_>, file: u32) -> Result<Option<Entry<'_>>, Fault> {
    let start_of =
        |field: &[u8]| line.start + (field.as_ptr() as usize - line.text.as_ptr() as usize);
    let fields = line.text.split(u8::is_ascii_whitespace);
    let mut fields = fields.filter(|field| !field.is_empty());
    let Some(name) = fields.next().filter(|name| name[0] != b';') else {
        return Ok(None);
    };
    let mut numbers = Vec::with_capacity(6);
    for field in fields {
        let start = start_of(field);
        let fault = || Fault::unexpected(start..start + field.len(), "a number");
        numbers.push(number::placed(field, start).ok_or_else(fault)?);
    }
    Ok(Some(Entry {
        name,
        place: Place::new(file, short(start_of(name))),
        end: short(line.start + line.text.trim_ascii_end().len()),
        numbers,
    }))
}
