//! What statements decide by, and what they give to which name.

use super::names::{NameId, Named, Names, spell};
use super::{Deciding, Headers};
use crate::program::script::{Place, short};
use crate::program::words::{Kind, Word, Words};
use foldhash::HashSet;
use std::ops::Range;

/// Reads one file.
pub(super) fn read(
    manner: &Deciding,
    (file, bytes, part): (usize, &[u8], Range<usize>),
    names: &mut Names,
) {
    let mut reader = Reader {
        manner,
        file: short(file),
        routine: 0,
        routine_name: None,
        own: HashSet::default(),
        outer: Vec::new(),
        depth: 0,
        names,
        spelling: Vec::new(),
        uses: Vec::new(),
    };
    if let Some(headers) = &manner.headers {
        reader.headers(headers, &bytes[..part.start]);
    }
    let mut found: Vec<Word> = Vec::new();
    let Range { mut start, end } = part;
    while start < end {
        let length = memchr::memchr2(b'\n', b'\r', &bytes[start..end]);
        let line_end = length.map_or(end, |length| start + length);
        let known = found.len();
        manner.spelling.add(bytes, start..line_end, &mut found);
        start = line_end + 1;
        let Some(sign) = manner.end else {
            reader.statement(Words { bytes, all: &found });
            found.clear();
            continue;
        };
        let mut from = 0;
        for at in known..found.len() {
            if found[at].kind == Kind::Sign(sign) {
                reader.statement(Words {
                    bytes,
                    all: &found[from..at],
                });
                from = at + 1;
            }
        }
        found.drain(..from);
    }
    reader.statement(Words { bytes, all: &found });
}

/// A name in an expression.
#[derive(Clone, Copy, Debug)]
struct Use {
    named: Named,
    /// It stands in an index.
    chooses: bool,
    /// It stands in what a function is given that does not give numbers of it.
    is_apart: bool,
}

struct Reader<'a> {
    manner: &'a Deciding,
    file: u32,
    routine: u32,
    routine_name: Option<NameId>,
    /// The names that the present routine declares.
    own: HashSet<Box<[u8]>>,
    /// The routines around it.
    outer: Vec<Outer>,
    /// Blocks around the present statement.
    depth: usize,
    names: &'a mut Names,
    spelling: Vec<u8>,
    uses: Vec<Use>,
}

/// A routine that goes on behind another one in it, and the blocks around that.
struct Outer {
    depth: usize,
    routine: u32,
    routine_name: Option<NameId>,
    own: HashSet<Box<[u8]>>,
}

/// Whether a text is one of some words, in any case.
fn is_one(of: &[&[u8]], text: &[u8]) -> bool {
    of.iter().any(|word| word.eq_ignore_ascii_case(text))
}

/// An open bracket.
#[derive(Clone, Copy)]
struct Open {
    is_index: bool,
    is_apart: bool,
    measures: bool,
}

impl Reader<'_> {
    fn place(&self, words: Words) -> Place {
        Place::new(self.file, short(words.span().start))
    }

    /// The name and the own names of the routine that a file is.
    fn headers(&mut self, headers: &Headers, text: &[u8]) {
        self.names.routines += 1;
        self.routine = self.names.routines;
        let named = |sign: &'static [u8]| {
            let all = memchr::memmem::find_iter(text, sign).map(move |at| &text[at + sign.len()..]);
            all.filter_map(|rest| Some(&rest[..memchr::memchr(b'"', rest)?]))
        };
        let parameters = named(headers.parameter)
            .map(|name| self.declare(name))
            .collect();
        for name in named(headers.own) {
            self.declare(name);
        }
        if let Some(name) = named(headers.routine).next() {
            spell(name, &mut self.spelling);
            let routine = self.names.name(0, &self.spelling);
            self.names.declare(routine, parameters);
        }
    }

    /// Blocks begin and end, and routines in routines with them.
    fn count_blocks(&mut self, words: Words) {
        for at in (0..words.len()).filter(|at| words.is_name(*at)) {
            let word = words.text(at);
            if is_one(self.manner.blocks, word) {
                if is_one(self.manner.routines, word) {
                    self.outer.push(Outer {
                        depth: self.depth,
                        routine: self.routine,
                        routine_name: self.routine_name,
                        own: self.own.clone(),
                    });
                }
                self.depth += 1;
            } else if word == b"end" {
                self.depth = self.depth.saturating_sub(1);
                let ended = self.outer.pop_if(|outer| outer.depth >= self.depth);
                if let Some(outer) = ended {
                    (self.routine, self.own) = (outer.routine, outer.own);
                    self.routine_name = outer.routine_name;
                }
            }
        }
    }

    fn statement(&mut self, words: Words) {
        let mut rest = words;
        if !self.manner.blocks.is_empty() {
            self.count_blocks(words);
        }
        // lines with numbers
        if words.kind(0) == Some(Kind::Number) && words.is(1, b':') {
            rest = words.behind(2);
            if rest.is(0, b'!') {
                return;
            }
        }
        while !rest.is_empty() {
            rest = self.first(rest);
        }
    }

    /// Reads the first statement of some words; gives what is behind it.
    fn first<'b, 'w>(&mut self, words: Words<'b, 'w>) -> Words<'b, 'w> {
        let manner = self.manner;
        let is = |of: &[&[u8]], at: usize| words.is_name(at) && is_one(of, words.text(at));
        let is_end = |sign: &u8| words.is(0, *sign);
        if is(manner.skips, 0) && !words.is(1, b'=') || manner.condition_end.iter().any(is_end) {
            return words.behind(1);
        }
        let routine = (0..words.len()).find(|at| is(manner.routines, *at));
        if routine == Some(0) {
            return self.begin(words);
        }
        let words_here = words.part(0..routine.unwrap_or(words.len()));
        let is_word = |at: &usize| is(manner.decides, *at) && !words.is(at + 1, b'=');
        let Some(at) = (0..words_here.len()).find(is_word) else {
            self.plain(words_here);
            return words.behind(words_here.len());
        };
        if at > 0 {
            self.plain(words.part(0..at));
        }
        let end = at + 1 + self.condition_length(words_here.behind(at + 1));
        let place = self.place(words.behind(at));
        self.look(words.part(at + 1..end));
        for of in std::mem::take(&mut self.uses) {
            if !of.is_apart {
                self.names.decide(of.named, place);
            }
        }
        words.behind(end)
    }

    /// The words of the condition that some begin with: up to a name behind an operand.
    fn condition_length(&self, words: Words) -> usize {
        let mut at = 0;
        let mut is_operand = false;
        while at < words.len() {
            match words.kind(at) {
                Some(Kind::Sign(b'(' | b'[' | b'{')) => {
                    at = words.closing(at);
                    is_operand = true;
                }
                Some(Kind::Sign(sign)) if self.manner.condition_end.contains(&sign) => return at,
                Some(Kind::Name) if is_one(self.manner.joins, words.text(at)) => is_operand = false,
                Some(Kind::Name) if is_operand => return at,
                Some(Kind::Sign(_)) => is_operand = false,
                _ => is_operand = true,
            }
            at += 1;
        }
        words.len()
    }

    /// A routine begins.
    fn begin<'b, 'w>(&mut self, words: Words<'b, 'w>) -> Words<'b, 'w> {
        self.names.routines += 1;
        self.routine = self.names.routines;
        self.own.clear();
        let open = (1..words.len().min(5)).find(|at| words.is(*at, b'('));
        let Some(open) = open.filter(|at| words.is_name(at - 1)) else {
            self.routine_name = words.is_name(1).then(|| {
                spell(words.text(1), &mut self.spelling);
                self.names.name(0, &self.spelling)
            });
            return words.behind(2);
        };
        spell(words.text(open - 1), &mut self.spelling);
        let routine = self.names.name(0, &self.spelling);
        self.routine_name = Some(routine);
        let (inside, count) = words.inside(open);
        let mut parameters = Vec::new();
        let mut last = None;
        for at in 0..=inside.len() {
            if at == inside.len() || inside.is(at, b',') || inside.is(at, b'\\') {
                parameters.extend(last.take());
            } else if inside.is_name(at) && !(last.is_some() && inside.is(at - 1, b':')) {
                last = Some(self.declare(inside.text(at)));
            }
        }
        self.names.declare(routine, parameters);
        words.behind(open + count)
    }

    /// A name is one of the present routine's own.
    fn declare(&mut self, name: &[u8]) -> NameId {
        spell(name, &mut self.spelling);
        self.own.insert(Box::from(&self.spelling[..]));
        self.names.name(self.routine, &self.spelling)
    }

    /// The name that a spelling means here.
    fn named(&mut self) -> NameId {
        let array = memchr::memchr(b'[', &self.spelling).unwrap_or(self.spelling.len());
        if is_one(self.manner.of_file, &self.spelling[..array]) {
            return self.names.name(Names::of_file(self.file), &self.spelling);
        }
        let is_own =
            self.spelling.first() == Some(&b'.') || self.own.contains(&self.spelling[..array]);
        self.names
            .name(if is_own { self.routine } else { 0 }, &self.spelling)
    }

    /// A statement that decides nothing but which element it names.
    fn plain(&mut self, words: Words) {
        let manner = self.manner;
        let first = (0..words.len()).find(|at| words.is_name(*at));
        let Some(first) = first else { return };
        let place = self.place(words);
        if self.routine > 0 && is_one(manner.declares, words.text(first)) {
            for at in first + 1..words.len() {
                if words.is(at, b'=') {
                    break;
                }
                if words.is_name(at) {
                    self.declare(words.text(at));
                }
            }
        }
        let mut assign = None;
        let mut at = 0;
        while at < words.len() {
            match words.kind(at) {
                Some(Kind::Sign(b'(' | b'[' | b'{')) => at = words.closing(at),
                Some(Kind::Sign(b'=')) => {
                    assign = Some(at);
                    break;
                }
                _ => {}
            }
            at += 1;
        }
        let word = words.text(first);
        let measures = is_one(manner.measures, word);
        let is_set = is_one(manner.sets, word);
        if word.eq_ignore_ascii_case(b"return") {
            self.look(words.behind(first + 1));
            let to = self.routine_name;
            return self.give(to, measures, place);
        }
        let (to, from) = match assign {
            Some(at) => (words.part(0..at), words.behind(at + 1)),
            None if is_set => {
                let behind = words.behind(first + 1);
                let end = self.reference(behind);
                (behind.part(0..end), behind.behind(end))
            }
            None => {
                self.look(words);
                self.give(None, false, place);
                return self.called(words, first, place);
            }
        };
        let written = self.written(to);
        self.choices(place);
        self.look(from);
        self.give(written, measures, place);
    }

    /// The words of the name that some begin with.
    fn reference(&self, words: Words) -> usize {
        let is_indexed = words.is_name(0) && words.is(1, self.manner.index);
        if is_indexed {
            1 + words.inside(1).1
        } else {
            words.len().min(1)
        }
    }

    /// The name that is written: the last one before the sign.
    fn written(&mut self, to: Words) -> Option<NameId> {
        self.look(to);
        let mut all = self.uses.iter().rev();
        let found = all.find(|of| !of.chooses)?;
        Some(found.named.name)
    }

    /// Names that stand in indices decide.
    fn choices(&mut self, place: Place) {
        for of in std::mem::take(&mut self.uses) {
            if of.chooses && !of.is_apart {
                self.names.decide(of.named, place);
            }
        }
    }

    /// What was looked at is given to a name.
    fn give(&mut self, to: Option<NameId>, measures: bool, place: Place) {
        for of in &self.uses {
            let mut from = of.named;
            from.is_read |= measures;
            if let Some(to) = to.filter(|_| !of.is_apart) {
                self.names.give(to, from, place);
            }
        }
        self.choices(place);
    }

    /// What an instruction that may be a routine is given: `f a,b` and `f(a,b)`.
    fn called(&mut self, words: Words, first: usize, place: Place) {
        if !self.names.has_parameters || words.len() < first + 2 {
            return;
        }
        let (given, name) = match words.find(b"call").filter(|at| words.is_name(at + 1)) {
            Some(at) => (words.behind(at + 2), at + 1),
            None => (words.behind(first + 1), first),
        };
        let given = if given.is(0, b'(') {
            given.inside(0).0
        } else {
            given
        };
        spell(words.text(name), &mut self.spelling);
        let spelling = std::mem::take(&mut self.spelling);
        self.arguments(&spelling, given, place);
        self.spelling = spelling;
    }

    fn arguments(&mut self, routine: &[u8], given: Words, place: Place) {
        let mut from = 0;
        let (mut at, mut count) = (0, 0);
        let mut id = None;
        while at <= given.len() {
            if given.is(at, b'(') || given.is(at, b'[') || given.is(at, b'{') {
                at = given.closing(at) + 1;
                continue;
            }
            if at == given.len() || given.is(at, b',') || given.is(at, b'\\') {
                self.look(given.part(from..at));
                for of in std::mem::take(&mut self.uses) {
                    if !of.is_apart {
                        let routine = *id.get_or_insert_with(|| self.names.name(0, routine));
                        self.names.call(routine, count, of.named, place);
                    }
                }
                (from, count) = (at + 1, count + 1);
            }
            at += 1;
        }
    }

    /// Finds the names in an expression.
    fn look(&mut self, words: Words) {
        self.uses.clear();
        let manner = self.manner;
        let mut open: Vec<Open> = Vec::new();
        let mut at = 0;
        while at < words.len() {
            let now = open.last().copied().unwrap_or(Open {
                is_index: false,
                is_apart: false,
                measures: false,
            });
            match words.kind(at) {
                Some(Kind::Sign(sign @ (b'(' | b'[' | b'{'))) => {
                    let behind_name =
                        at > 0 && words.is_name(at - 1) && words.text(at - 1) != manner.literal;
                    let behind =
                        behind_name || at > 0 && (words.is(at - 1, b')') || words.is(at - 1, b']'));
                    let function: &[u8] = if behind_name && sign == b'(' {
                        words.text(at - 1)
                    } else {
                        b""
                    };
                    open.push(Open {
                        is_index: now.is_index || sign == manner.index && behind,
                        is_apart: now.is_apart || is_one(manner.apart, function),
                        measures: now.measures || is_one(manner.measures, function),
                    });
                }
                Some(Kind::Sign(b')' | b']' | b'}')) => {
                    open.pop();
                }
                Some(Kind::Name) => self.use_of(words, at, now),
                _ => {}
            }
            at += 1;
        }
    }

    /// The name at a word is used.
    fn use_of(&mut self, words: Words, at: usize, open: Open) {
        let manner = self.manner;
        let text = words.text(at);
        let is_part = at > 0 && words.is(at - 1, b'.');
        let is_literal = text == manner.literal && words.is(at + 1, b'[') && {
            let (inside, _) = words.inside(at + 1);
            (0..inside.len()).any(|at| inside.is(at, b','))
        };
        let is_field = manner.index != b'{' && is_field_of_braces(words, at);
        if is_part || is_literal || is_field || is_one(manner.joins, text) {
            return;
        }
        spell(text, &mut self.spelling);
        if at > 0 && words.is(at - 1, b'#') {
            self.spelling.insert(0, b'#');
        }
        let mut is_read = open.measures;
        let mut behind = at + 1;
        let mut is_other_part = false;
        if words.is(behind, manner.index) {
            let (inside, count) = words.inside(behind);
            behind += count;
            let has_parts = (0..inside.len()).any(|at| inside.is(at, b','));
            if manner.index_reads {
                is_read = true;
            } else if inside.kind(0) == Some(Kind::Number) {
                is_read |= has_parts && manner.index == b'[';
                self.spelling.push(b'[');
                self.spelling.extend_from_slice(inside.text(0));
                if has_parts && manner.index == b'{' {
                    for at in 1..inside.len() {
                        self.spelling.extend_from_slice(inside.text(at));
                    }
                }
                self.spelling.push(b']');
            }
        }
        if words.is(behind, b'.') && words.is_name(behind + 1) {
            is_other_part = is_one(manner.stays, words.text(behind + 1));
            is_read = true;
        }
        let named = Named {
            name: self.named(),
            is_read,
        };
        self.uses.push(Use {
            named,
            chooses: open.is_index,
            is_apart: open.is_apart || is_other_part,
        });
    }
}

/// Whether a word is the name of a field in braces: `{X 1,Y 2}`, `{E6POS: X 1}`.
fn is_field_of_braces(words: Words, at: usize) -> bool {
    if at == 0 {
        return false;
    }
    let begins = words.is(at - 1, b'{') || words.is(at - 1, b',') || words.is(at - 1, b':');
    if !begins {
        return false;
    }
    let mut depth = 0_usize;
    let before = (0..at).rev().find(|at| match words.kind(*at) {
        Some(Kind::Sign(b'}' | b')' | b']')) => {
            depth += 1;
            false
        }
        Some(Kind::Sign(b'{' | b'(' | b'[')) if depth > 0 => {
            depth -= 1;
            false
        }
        Some(Kind::Sign(b'{' | b'(' | b'[')) => true,
        _ => false,
    });
    before.is_some_and(|open| words.is(open, b'{'))
}
