//! Files whose functions call each other: they are read as one text.

use super::syntax::{Parsed, Symbol};
use super::verbs;
use crate::program::kit::content_start;
use crate::program::script::{Place, Span, short};
use crate::program::{Number, Source};
use foldhash::{HashMap, HashMapExt, HashSet};
use std::collections::BTreeMap;

/// Files, one behind the other.
pub(super) struct Text<'s> {
    pub sources: &'s [Source],
    /// Each file, an index in the sources, and its first byte in the text.
    files: Vec<(u32, u32)>,
}

impl<'s> Text<'s> {
    /// One file alone.
    pub(super) fn of(sources: &'s [Source], file: usize) -> Self {
        let files = vec![(short(file), 0)];
        Self { sources, files }
    }

    /// Several, and the bytes of them all; each file begins behind a line end.
    pub(super) fn joined(sources: &'s [Source], together: &[usize]) -> (Self, Source) {
        let mut bytes = Vec::new();
        let mut files = Vec::with_capacity(together.len());
        for &file in together {
            let start = bytes.len();
            files.push((short(file), short(start)));
            bytes.extend_from_slice(&sources[file].bytes);
            let mark = content_start(&sources[file].bytes);
            bytes[start..start + mark].fill(b' ');
            bytes.push(b'\n');
        }
        (Self { sources, files }, Source::new("", bytes))
    }

    /// The first bytes of its files.
    pub(super) fn starts(&self) -> impl Iterator<Item = u32> + '_ {
        self.files.iter().map(|(_, start)| *start)
    }

    /// A byte of the text in its file.
    pub(super) fn place(&self, offset: u32) -> Place {
        let behind = self.files.partition_point(|(_, start)| *start <= offset);
        let (file, start) = self.files[behind - 1];
        Place::new(file, offset - start)
    }

    /// Bytes of the text in the file of a place; none where they are of another one.
    pub(super) fn span(&self, span: Span, of: Place) -> Span {
        let (start, end) = (self.place(span.start), self.place(span.end));
        if start.file != of.file {
            return Span::default();
        }
        Span {
            start: start.offset,
            end: end.offset,
        }
    }

    /// Numbers of the text become those of their files.
    pub(super) fn put(&self, numbers: &mut [Number]) {
        for number in numbers {
            number.start = self.place(number.start).offset;
        }
    }
}

/// Which files are one text: in one a function is called that it has not, and another has.
pub(super) fn together(files: &[Parsed]) -> Vec<Vec<usize>> {
    let mut having: HashMap<&[u8], Vec<usize>> = HashMap::new();
    for (file, parsed) in files.iter().enumerate() {
        let outer = parsed.functions.iter().filter(|of| of.parent == 0);
        for name in outer.filter_map(|of| of.name) {
            having.entry(parsed.bytes(name)).or_default().push(file);
        }
    }
    let mut first: Vec<usize> = (0..files.len()).collect();
    for (file, parsed) in files.iter().enumerate() {
        let own: HashSet<Symbol> = parsed.functions.iter().filter_map(|of| of.name).collect();
        let called: HashSet<Symbol> = parsed.calls.iter().map(|call| call.name).collect();
        let names = called.difference(&own).map(|name| parsed.bytes(*name));
        for name in names.filter(|name| !verbs::is_of_language(name)) {
            for &other in having.get(name).into_iter().flatten() {
                let (a, b) = (first[file], first[other]);
                for one in first.iter_mut().filter(|one| **one == a.max(b)) {
                    *one = a.min(b);
                }
            }
        }
    }
    let mut all: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (file, first) in first.into_iter().enumerate() {
        all.entry(first).or_default().push(file);
    }
    all.into_values().collect()
}
