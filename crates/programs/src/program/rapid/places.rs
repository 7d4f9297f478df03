//! What the coordinates of `pos` data may be, and of targets that nothing writes; how many elements
//! arrays have.

use super::numbers::{COMPONENT, Written};
use super::resolved::Resolved;
use super::syntax::{Element, Index, Storage, Stored, Type, indices};
use crate::program::names::{Context, Meaning, Symbol};
use crate::program::number;
use crate::program::numbers::{Numbers, Site, parts};
use crate::program::quantity::{Quantity, is_letter};
use crate::program::script::short;
use foldhash::HashMap;

/// The coordinates, in their order.
const AXES: [&[u8]; 3] = [b".x", b".y", b".z"];

/// What is written into the coordinates of data.
#[derive(Debug)]
pub(super) struct PlaceWrite {
    datum: u32,
    /// One of them, or all.
    axis: Option<usize>,
    value: Value,
}

/// What a value is.
#[derive(Clone, Debug)]
pub(super) enum Value {
    /// That of these bytes of a file.
    Text(u32, (u32, u32), Context, Option<Site>),
    /// It is not followed.
    Unfollowed,
    /// Only the running program knows it.
    Lost,
}

/// What the coordinates of data are called in the numbers, by what data are called there.
pub(super) type Coordinates = HashMap<(u32, usize), u32>;

/// The coordinate that a component names.
pub(super) fn axis_of(component: &[u8]) -> Option<usize> {
    AXES.iter()
        .position(|axis| component.eq_ignore_ascii_case(axis))
}

impl Resolved<'_> {
    /// Notes what an assignment writes into data that have coordinates.
    pub(super) fn note_place(
        &self,
        name: Symbol,
        index: Index,
        (file, offset): (u32, u32),
        context: Context,
        site: &mut dyn FnMut() -> Site,
        writes: &mut Vec<PlaceWrite>,
    ) {
        let bytes = self.assigned_bytes(file, offset);
        let text = &self.sources[file as usize].bytes[offset as usize..bytes.0 as usize];
        let own = text.strip_suffix(b":=").unwrap_or(text).trim_ascii_end();
        let axis = own.len().checked_sub(2).and_then(|at| axis_of(&own[at..]));
        let is_known = axis.is_some() || !own.contains(&b'.');
        for datum in self.data_named(name, context) {
            if self.is_place(datum) {
                let site = (index == Index::Whole).then(&mut *site);
                let value = if is_known {
                    Value::Text(file, bytes, context, site)
                } else {
                    Value::Unfollowed
                };
                writes.push(PlaceWrite { datum, axis, value });
            }
        }
    }

    /// All coordinates of data are written, if they have any.
    pub(super) fn note_whole_place(&self, datum: u32, value: Value, writes: &mut Vec<PlaceWrite>) {
        if self.is_place(datum) {
            writes.push(PlaceWrite {
                datum,
                axis: None,
                value,
            });
        }
    }

    /// Whether data are `pos`: that word stands before the name of a parameter, and behind the
    /// keywords that a declaration begins with.
    pub(super) fn is_place(&self, datum: u32) -> bool {
        let of = self.datum(datum);
        if of.kind != Type::Other {
            return false;
        }
        let (before, behind) = self.sources[of.place.file as usize]
            .bytes
            .split_at(of.place.offset as usize);
        let is_pos = |word: &[u8]| word.eq_ignore_ascii_case(b"pos");
        if matches!(of.storage, Storage::Parameter { .. }) {
            let before = before.trim_ascii_end();
            let length = before.iter().rev().take_while(|b| is_letter(**b)).count();
            return is_pos(&before[before.len() - length..]);
        }
        let keywords: [&[u8]; 5] = [b"local", b"task", b"const", b"pers", b"var"];
        let mut words = behind.split(|byte| !is_letter(*byte));
        let first = words.find(|word| {
            !word.is_empty() && !keywords.iter().any(|of| word.eq_ignore_ascii_case(of))
        });
        first.is_some_and(is_pos)
    }

    /// What a target is declared with along an axis, mm.
    pub(super) fn coordinate(&self, datum: u32, axis: u8) -> Option<Quantity> {
        let of = self.datum(datum);
        let Stored::Elements {
            sizes: [0, 0, 0],
            elements,
        } = of.value
        else {
            return None;
        };
        let [Element::Target(target)] = self.parsed.elements[indices(elements)] else {
            return None;
        };
        let text = self.sources[of.place.file as usize]
            .bytes
            .get(of.place.offset as usize..)?;
        let text = &text[..memchr::memchr(b';', text)?];
        let value = &text[memchr::memmem::find(text, b":=")? + 2..];
        let inside = value.trim_ascii().strip_prefix(b"[")?;
        let place = parts(inside)
            .next()
            .filter(|_| of.kind == Type::Robtarget)?;
        let place = place.trim_ascii().strip_prefix(b"[")?.strip_suffix(b"]")?;
        let value = number::parse(parts(place).nth(usize::from(axis))?.trim_ascii())?;
        Some(Quantity::coordinate(value, target, axis))
    }

    /// The text of how many elements an array has: `Dim(a,1)` of `CONST num a{40}`.
    pub(super) fn dimension(&self, call: &[u8], context: Context) -> Option<(&[u8], u32)> {
        let inside = call.strip_suffix(b")")?;
        let inside = &inside[memchr::memchr(b'(', inside)? + 1..];
        let mut given = parts(inside);
        let (array, which) = (given.next()?.trim_ascii(), given.next()?.trim_ascii());
        let name = self.parsed.symbols.find(array)?;
        let Meaning::One(datum) = self.meaning(name, context) else {
            return None;
        };
        let of = self.datum(datum);
        let is_parameter = matches!(of.storage, Storage::Parameter { .. });
        let text = &self.sources[of.place.file as usize].bytes[of.place.offset as usize..];
        let end = memchr::memchr2(b';', b':', text).filter(|_| !is_parameter)?;
        let open = memchr::memchr(b'{', &text[..end])? + 1;
        let size = which
            .first()?
            .checked_sub(b'1')
            .filter(|_| which.len() == 1)?;
        let size = parts(&text[open..end]).nth(usize::from(size))?;
        Some((size, of.place.file))
    }

    /// Puts all that is written into coordinates into the numbers.
    pub(super) fn coordinates(
        &self,
        writes: &[PlaceWrite],
        numbers: &mut Numbers<Written>,
    ) -> Coordinates {
        let mut all = Coordinates::default();
        let mut number = |datum: u32, axis: usize| {
            let next = COMPONENT | short(all.len());
            *all.entry((self.number(datum), axis)).or_insert(next)
        };
        for at in (0..short(self.parsed.data.len())).filter(|at| self.is_place(*at)) {
            let of = self.datum(at);
            let file = of.place.file;
            let text = &self.sources[file as usize].bytes;
            let rest = &text[of.place.offset as usize..];
            let end = memchr::memchr(b';', rest).unwrap_or(rest.len());
            let value = memchr::memmem::find(&rest[..end], b":=");
            let span = |from: usize, to: usize| {
                let at = |by: usize| of.place.offset + short(by);
                (at(from), at(to))
            };
            let is_parameter = matches!(of.storage, Storage::Parameter { .. });
            for axis in 0..3 {
                let number = number(at, axis);
                match value.filter(|_| !is_parameter) {
                    Some(sign) => {
                        let bytes = span(sign + 2, end);
                        self.coordinate_written(
                            number,
                            axis,
                            (file, bytes),
                            of.context,
                            None,
                            numbers,
                        );
                    }
                    None if is_parameter => {}
                    // begins with 0
                    None if of.storage == Storage::Variable => {
                        numbers.write(number, Written::Zero, None);
                    }
                    None => numbers.lose(number),
                }
            }
        }
        for write in writes {
            for axis in 0..3 {
                if write.axis.is_some_and(|of| of != axis) {
                    continue;
                }
                let number = number(write.datum, axis);
                match write.value.clone() {
                    Value::Unfollowed => numbers.give_up(number),
                    Value::Lost => numbers.lose(number),
                    Value::Text(file, bytes, context, site) if write.axis.is_some() => {
                        let written = Written::Text {
                            file,
                            bytes,
                            context,
                        };
                        numbers.write(number, written, site);
                    }
                    Value::Text(file, bytes, context, site) => {
                        let value = (file, bytes);
                        self.coordinate_written(number, axis, value, context, site, numbers);
                    }
                }
            }
        }
        all
    }

    /// One coordinate of a value for all three.
    fn coordinate_written(
        &self,
        number: u32,
        axis: usize,
        (file, bytes): (u32, (u32, u32)),
        context: Context,
        site: Option<Site>,
        numbers: &mut Numbers<Written>,
    ) {
        let text = &self.sources[file as usize].bytes[indices(bytes)];
        let value = text.trim_ascii();
        let is_name = |b: &u8| is_letter(*b) || matches!(b, b'.' | b'{' | b'}' | b',');
        let written =
            if let Some(inside) = value.strip_prefix(b"[").and_then(|v| v.strip_suffix(b"]")) {
                let Some(part) = parts(inside)
                    .nth(axis)
                    .filter(|_| parts(inside).count() == 3)
                else {
                    return numbers.give_up(number);
                };
                let from = part.as_ptr() as usize - text.as_ptr() as usize;
                let start = bytes.0 + short(from);
                Written::Text {
                    file,
                    bytes: (start, start + short(part.len())),
                    context,
                }
            } else if !value.is_empty() && value.iter().all(is_name) {
                Written::Coordinate {
                    file,
                    bytes,
                    context,
                    axis,
                }
            } else {
                return numbers.give_up(number);
            };
        numbers.write(number, written, site);
    }
}
