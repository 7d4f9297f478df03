//! What the components of frames may be, of those that displace positions or stand in sums.

use super::names::{DataKind, Index, Stored};
use super::numbers::{COMPONENT, Known, Written};
use super::reader::Reader;
use super::tokens::{Cursor, Kind, Token};
use crate::program::Shape;
use crate::program::names::{Context, Symbol};
use crate::program::numbers::{Site, parts};
use crate::program::quantity::{Quantity, is_letter};
use crate::program::script::{Place, short};
use foldhash::HashSet;

/// The components of a frame, in their order.
const LETTERS: [u8; 6] = *b"XYZABC";

/// Bytes between brackets that are looked back over.
const LONGEST_INDEX: usize = 80;

/// What is written into a frame.
#[derive(Debug)]
pub(super) struct FrameWrite {
    name: Symbol,
    within: Context,
    /// The component, of one; all of them else.
    part: Option<u8>,
    value: Value,
    site: Option<Site>,
}

/// A value of a frame or of a component.
#[derive(Clone, Debug)]
pub(super) enum Value {
    /// In a context, which begins there.
    Text(Box<[u8]>, Place, Context),
    /// It is not followed.
    Unfollowed,
    /// Only the running program knows it.
    Lost,
}

/// The number of a component by its letter.
pub(super) fn part_of(name: &[u8]) -> Option<u8> {
    let [letter] = name else { return None };
    let at = LETTERS
        .iter()
        .position(|of| letter.eq_ignore_ascii_case(of))?;
    u8::try_from(at).ok()
}

impl Known {
    /// What a component of a frame is called in the numbers.
    fn component(&mut self, of: u32, part: u8) -> u32 {
        let next = COMPONENT | u32::try_from(self.components.len()).unwrap_or(0);
        *self.components.entry((of, part)).or_insert(next)
    }

    /// A routine is given a value for a frame.
    pub(super) fn frame_given(
        &mut self,
        (name, within): (Symbol, Context),
        value: Value,
        site: Site,
    ) {
        self.frames.push(FrameWrite {
            name,
            within,
            part: None,
            value,
            site: Some(site),
        });
    }

    /// A frame, or a component of it, is written in a way that the text does not tell.
    pub(super) fn frame_lost(
        &mut self,
        (name, within): (Symbol, Context),
        part: Option<u8>,
        value: Value,
    ) {
        self.frames.push(FrameWrite {
            name,
            within,
            part,
            value,
            site: None,
        });
    }
}

impl Reader {
    /// Notes which frames a line asks for components, or puts into products.
    pub(super) fn note_displacing(&mut self, cursor: Cursor) {
        let line = &cursor.bytes[cursor.at..cursor.end];
        for at in memchr::memchr_iter(b'.', line) {
            let is_part = part_of(&line[at + 1..line.len().min(at + 2)]).is_some()
                && !line.get(at + 2).copied().is_some_and(is_letter);
            if !is_part {
                continue;
            }
            let before = line[..at].trim_ascii_end();
            let before = match before.strip_suffix(b"]") {
                Some(inside) => {
                    let near = inside.len().saturating_sub(LONGEST_INDEX);
                    let open = memchr::memrchr(b'[', &inside[near..]);
                    &inside[..open.map_or(0, |open| near + open)]
                }
                None => before,
            };
            let length = before.iter().rev().take_while(|b| is_letter(**b)).count();
            let name = &before[before.len() - length..];
            if name.first().is_some_and(|b| !b.is_ascii_digit()) {
                let name = self.names.symbols.intern(name);
                self.names.known.displacing.push(name);
            }
        }
        if memchr::memchr(b':', line).is_none() {
            return;
        }
        let mut cursor = cursor;
        let (mut before, mut is_product): (Option<Symbol>, bool) = (None, false);
        let mut depth = 0_u32;
        loop {
            let token = cursor.next();
            match token.kind {
                Kind::End => return,
                Kind::Sign(b'{') => depth += 1,
                Kind::Sign(b'}') => depth = depth.saturating_sub(1),
                _ if depth > 0 => {}
                Kind::Name => {
                    let name = self.symbol(&cursor, token);
                    if cursor.brackets().is_err() {
                        return;
                    }
                    if is_product {
                        self.names.known.displacing.push(name);
                    }
                    before = Some(name);
                    is_product = false;
                }
                Kind::Sign(b':') => {
                    self.names.known.displacing.extend(before);
                    is_product = true;
                }
                _ => (before, is_product) = (None, false),
            }
        }
    }

    /// Notes what an assignment of this value, from `start` on, writes into a frame.
    pub(super) fn frame_written(
        &mut self,
        name: Symbol,
        part: Option<Token>,
        start: usize,
        cursor: &Cursor,
        site: Option<Site>,
    ) {
        let value = cursor.bytes[start..cursor.at.clamp(start, cursor.end)].trim_ascii();
        let is_frame = |first: &u8| is_letter(*first) && !first.is_ascii_digit() || *first == b'{';
        let part = match part {
            None if !value.first().is_some_and(is_frame) => return,
            None => None,
            Some(part) => match part_of(cursor.text(part)) {
                Some(part) => Some(part),
                None => return,
            },
        };
        let context = self.context();
        self.names.known.frames.push(FrameWrite {
            name,
            within: context,
            part,
            value: Value::Text(value.into(), Place::new(self.file, short(start)), context),
            site,
        });
    }

    /// Works out the components of frames that displace, once all is read.
    pub(super) fn settle_components(&mut self) {
        let mut open = std::mem::take(&mut self.names.known.displacing);
        let frames = std::mem::take(&mut self.names.known.frames);
        if open.is_empty() {
            return;
        }
        let mut order: Vec<usize> = (0..frames.len()).collect();
        order.sort_by_key(|at| frames[*at].name.0);
        let mut declared: Vec<(u32, u32)> = Vec::new();
        for (at, datum) in (0..).zip(&self.names.data) {
            if datum.kind.is_place() {
                declared.push((datum.name.0, at));
            }
        }
        declared.sort_unstable();
        let mut seen = HashSet::default();
        while let Some(name) = open.pop() {
            if !seen.insert(name) {
                continue;
            }
            let first = declared.partition_point(|of| of.0 < name.0);
            for (_, datum) in declared[first..].iter().take_while(|of| of.0 == name.0) {
                self.declared_components(*datum);
            }
            let first = order.partition_point(|at| frames[*at].name.0 < name.0);
            let own = order[first..].iter().map(|at| &frames[*at]);
            for write in own.take_while(|write| write.name == name) {
                self.component_written(write, &mut open);
            }
        }
    }

    /// What a frame is declared with.
    fn declared_components(&mut self, datum: u32) {
        let of = self.names.data[datum as usize];
        let number = self.names.number(of.name, of.context);
        for (_, _, value) in self.names.values(datum, Index::Variable).to_vec() {
            let script = &self.builder.script;
            let all = match value {
                Stored::Target(target) if script.targets[target].layout.shape == Shape::Pose => {
                    let numbers = script.numbers_of(target).first_chunk::<6>();
                    numbers.map(|all| (target, all.each_ref().map(|number| number.value)))
                }
                _ => None,
            };
            for part in 0..6 {
                let known = &mut self.names.known;
                let component = known.component(number, part);
                match all {
                    Some((target, all)) => {
                        let value = all[usize::from(part)];
                        let value = match of.kind {
                            // an offset is not rewritten
                            DataKind::Frame => Written::Exactly(value),
                            _ => Written::Coordinate(value, target, part),
                        };
                        known.numbers.write(component, value, None);
                    }
                    // with components left out, or expressions
                    None => known.numbers.give_up(component),
                }
            }
        }
    }

    fn component_written(&mut self, write: &FrameWrite, open: &mut Vec<Symbol>) {
        let number = self.names.number(write.name, write.within);
        let known = &mut self.names.known;
        let (text, at, context) = match &write.value {
            Value::Text(text, at, context) => (text, *at, *context),
            other => {
                let parts = write.part.map_or(0..6, |part| part..part + 1);
                for part in parts {
                    let component = known.component(number, part);
                    match other {
                        Value::Lost => known.numbers.lose(component),
                        _ => known.numbers.give_up(component),
                    }
                }
                return;
            }
        };
        if let Some(part) = write.part {
            let value = Written::Value(text.clone(), at, context);
            let component = known.component(number, part);
            known.numbers.write(component, value, write.site.clone());
            return;
        }
        if let Some(inside) = text.strip_prefix(b"{") {
            let inside = inside.rsplit(|byte| *byte == b':').next().unwrap_or(inside);
            for field in parts(inside.strip_suffix(b"}").unwrap_or(inside)) {
                let field = field.trim_ascii();
                let key = field.iter().take_while(|b| is_letter(**b)).count();
                if let Some(part) = part_of(&field[..key]) {
                    let value = field[key..].trim_ascii();
                    let value = Written::Value(value.into(), at, context);
                    let known = &mut self.names.known;
                    let component = known.component(number, part);
                    known.numbers.write(component, value, write.site.clone());
                }
            }
            return;
        }
        let length = text.iter().take_while(|b| is_letter(**b)).count();
        let rest = text[length..].trim_ascii();
        let is_name =
            length > 0 && (rest.is_empty() || rest.starts_with(b"[") && rest.ends_with(b"]"));
        if is_name {
            open.push(self.names.symbols.intern(&text[..length]));
        }
        for part in 0..6 {
            let known = &mut self.names.known;
            let component = known.component(number, part);
            if is_name {
                let letter = [LETTERS[usize::from(part)]];
                let value = [&text[..length], rest, b".", &letter].concat();
                let value = Written::Value(value.into(), at, context);
                known.numbers.write(component, value, write.site.clone());
            } else {
                known.numbers.give_up(component);
            }
        }
    }

    /// The six components of a frame; `None` where nothing is written into one of them.
    pub(super) fn components(&self, name: Symbol) -> Option<[Quantity; 6]> {
        let number = self.names.number(name, self.context());
        let is_declared = self.names.datum(name, self.context()).is_some();
        let mut all = [0.0; 6].map(Quantity::exactly);
        for (part, of) in (0..6).zip(&mut all) {
            let component = self.names.known.components.get(&(number, part))?;
            let value = self.number_value_of(*component);
            *of = if is_declared {
                value
            } else {
                // files that are not here may write it
                Quantity::any(&[value, Quantity::unknown()])
            };
        }
        Some(all)
    }
}
