//! Decisions by numbers of targets: after a compensation these are those of the fake targets.
//!
//! What is followed is names: a name that a statement gives numbers of another one has these, too.
//! Each language says with which words its statements decide and give ([`Deciding`]); what a name is,
//! and in which order statements run, does not matter.
//!
//! # Limits
//! Records, and what a routine writes into what it is given, are not followed.

mod names;
mod statements;

use super::script::Place;
use super::words::Spelling;
use super::{Language, Program, Script, Source, TargetId};
use names::Names;
use std::ops::Range;

/// How statements of a language read numbers of targets, and decide.
#[derive(Debug)]
pub struct Deciding {
    pub(super) spelling: Spelling,
    /// A text that reads numbers of targets has one of these.
    pub(super) signs: &'static [&'static [u8]],
    /// Likewise, where that is not a matter of one word.
    pub(super) reads: fn(&[u8]) -> bool,
    /// The statements of a file, where they are not all of it.
    pub(super) part: fn(&[u8]) -> Range<usize>,
    /// What ends a statement, where that is not the end of its line.
    pub(super) end: Option<u8>,
    /// What ends a condition outside brackets.
    pub(super) condition_end: &'static [u8],
    /// Opens the bracket of an index.
    pub(super) index: u8,
    /// What an index gives is a number of a position.
    pub(super) index_reads: bool,
    /// Words behind which a condition, a count or a choice stands.
    pub(super) decides: &'static [&'static [u8]],
    /// Words in front of a statement that are none of it.
    pub(super) skips: &'static [&'static [u8]],
    /// Words within an expression.
    pub(super) joins: &'static [&'static [u8]],
    /// Words with which a routine begins.
    pub(super) routines: &'static [&'static [u8]],
    /// Words with which a block begins that `end` ends, where routines stand in routines.
    pub(super) blocks: &'static [&'static [u8]],
    /// What stands in front of the name of a routine that a file is, and of its own names, before
    /// its statements.
    pub(super) headers: Option<Headers>,
    /// Arrays that each file has for itself.
    pub(super) of_file: &'static [&'static [u8]],
    /// Words with which a statement declares names of a routine.
    pub(super) declares: &'static [&'static [u8]],
    /// Instructions that write what they name first.
    pub(super) sets: &'static [&'static [u8]],
    /// Functions, and instructions, that give numbers of the positions they are given.
    pub(super) measures: &'static [&'static [u8]],
    /// Functions that do not give numbers of what they are given.
    pub(super) apart: &'static [&'static [u8]],
    /// Parts of a position that no correction changes.
    pub(super) stays: &'static [&'static [u8]],
    /// Begins a position in numbers, before its bracket.
    pub(super) literal: &'static [u8],
}

/// What stands in front of names in a file that is one routine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Headers {
    pub routine: &'static [u8],
    pub parameter: &'static [u8],
    pub own: &'static [u8],
}

/// Bytes from the first word of a routine to its bracket at most.
const LONGEST_HEADER: usize = 100;

impl Deciding {
    /// Of a language that is not like any other: lines, indices in square brackets.
    pub(super) const fn new(spelling: Spelling) -> Self {
        Self {
            spelling,
            signs: &[],
            reads: |_| false,
            part: |bytes| 0..bytes.len(),
            end: None,
            condition_end: b"",
            index: b'[',
            index_reads: false,
            decides: &[],
            skips: &[b"THEN", b"DO", b"ELSE", b"OF"],
            joins: &[],
            routines: &[],
            blocks: &[],
            headers: None,
            of_file: &[],
            declares: &[],
            sets: &[],
            measures: &[],
            apart: &[],
            stays: &[],
            literal: b"",
        }
    }

    /// Whether a routine of a text has parameters; it may only look so.
    fn has_parameters(&self, text: &[u8]) -> bool {
        let has = |at: usize| {
            let line = &text[at..text.len().min(at + LONGEST_HEADER)];
            let open = memchr::memchr(b'(', line);
            let behind = open.map(|open| line[open + 1..].trim_ascii_start());
            behind.is_some_and(|behind| !behind.starts_with(b")"))
        };
        let of_word = |word: &[u8]| memchr::memmem::find_iter(text, word).any(has);
        let signs = self.headers.iter().map(|headers| headers.parameter);
        let mut words = self.routines.iter();
        words.any(|word| of_word(word) || of_word(&word.to_ascii_lowercase()))
            || signs
                .into_iter()
                .any(|sign| memchr::memmem::find(text, sign).is_some())
    }

    fn is_read(&self, text: &[u8]) -> bool {
        let has = |sign: &&[u8]| memchr::memmem::find(text, sign).is_some();
        self.signs.iter().any(has) || (self.reads)(text)
    }
}

/// A statement that reads numbers of a target, by which the program then decides.
#[derive(Clone, Debug, PartialEq)]
pub struct Decided {
    /// The statement that reads them.
    pub place: Place,
    /// The first statement that decides by them, where that is another one.
    pub decides: Option<Place>,
    /// The target, or the array that it is an element of.
    pub name: Box<str>,
    /// The targets that moves go to of this name.
    pub targets: Box<[TargetId]>,
}

/// Whether a program may decide anything: most do not, and nothing is to be looked for in them.
pub(crate) fn may_decide(script: &Script) -> bool {
    use super::script::Statement::{Branch, BranchUnless, Enter};
    let decides =
        |of: &super::script::Statement| matches!(of, Branch(_) | BranchUnless(_) | Enter(_));
    !script.lists.is_empty() || !script.tables.is_empty() || script.statements.iter().any(decides)
}

/// The statements that read numbers of targets which moves use, and by which the program decides.
pub(crate) fn decided(
    language: &dyn Language,
    sources: &[Source],
    program: &Program,
) -> Vec<Decided> {
    let Some(manner) = language.deciding() else {
        return Vec::new();
    };
    let parts = sources.iter().map(|source| (manner.part)(&source.bytes));
    let parts: Vec<Range<usize>> = parts.collect();
    let mut texts = sources.iter().zip(&parts);
    if !texts.any(|(source, part)| manner.is_read(&source.bytes[part.clone()])) {
        return Vec::new();
    }
    let mut names = Names::default();
    names.has_parameters = sources
        .iter()
        .any(|source| manner.has_parameters(&source.bytes));
    for (file, source) in sources.iter().enumerate() {
        let part = parts[file].clone();
        statements::read(manner, (file, &source.bytes, part), &mut names);
    }
    names.decided(sources, program)
}

/// The targets by whose numbers a program decides, for tests: with `>` where they are read elsewhere.
#[cfg(test)]
pub(super) fn shown(program: &Program) -> Vec<String> {
    let mark = |of: &Decided| if of.decides.is_some() { ">" } else { "" };
    let all = program.decided.iter();
    all.map(|of| format!("{}{}", of.name, mark(of))).collect()
}
