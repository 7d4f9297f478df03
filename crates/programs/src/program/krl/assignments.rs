//! Assignments to positions, tools, bases and numbers.

use super::aggregate::EXTERNAL;
use super::frames::{State, Table};
use super::names::{DataKind, Index, whole};
use super::reader::Reader;
use super::remarks::{ASSIGNED, COMPUTED};
use super::targets::Owner;
use super::tokens::{Cursor, Kind, Read, Token, capitals};
use crate::program::displacing::grown_by_any;
use crate::program::names::Symbol;
use crate::program::notation::mentions;
use crate::program::number;
use crate::program::script::{Expr, How, PartValue, Remark, Written};

impl Reader {
    /// A whole number is written; only those matter that choose a tool or base.
    pub(super) fn count(&mut self, name: Symbol, at: Index, number: Option<u32>) {
        if !self.names.choosing.contains(&name) {
            return;
        }
        let Some(datum) = self.names.datum(name, self.context()) else {
            return;
        };
        let value = match number {
            Some(number) => self.number_value(number),
            None => self.chosen(),
        };
        if at == Index::Whole {
            let variable = self.variable_of(datum);
            self.put(self.here, variable, value);
        }
    }

    /// An assignment; the cursor stands behind `=`.
    pub(super) fn assignment(
        &mut self,
        (first, word): (Token, &[u8]),
        ((name, index), at): ((Symbol, Index), Option<(usize, usize)>),
        part: Option<Token>,
        mut cursor: Cursor,
    ) -> Read<()> {
        if cursor.take(b'=') {
            return Ok(());
        }
        let place = self.here;
        let mut buffer = [0; 24];
        let part = part.map(|part| capitals(cursor.text(part), &mut buffer));
        if let Some(state) = State::named(word) {
            return self.write_state(place, state, part, &mut cursor);
        }
        if matches!(word, b"$CIRC_TYPE" | b"$CIRC_MODE") {
            let values = self.circle(first, &mut cursor);
            self.set_circles(place, values);
            return Ok(());
        }
        if word == b"LDAT_ACT" {
            let active = self.circles.active;
            match part {
                None => {
                    let (turning, [of_arcs, ..]) = self.ldat(&mut cursor);
                    self.set(place, State::LdatOrientation, turning);
                    self.put(place, active, of_arcs);
                }
                Some(b"ORI_TYP") => {
                    let value = self.orientation(&mut cursor);
                    self.set(place, State::LdatOrientation, value);
                }
                Some(b"CIRC_TYP") => {
                    if let [Some(value), ..] = self.circle(first, &mut cursor) {
                        self.put(place, active, value);
                    }
                }
                Some(_) => {}
            }
            return Ok(());
        }
        if word == b"FDAT_ACT" {
            return match part {
                None => self.activate(place, &mut cursor),
                Some(part) => {
                    self.activate_part(place, part, &mut cursor);
                    Ok(())
                }
            };
        }
        if let Some(table) = Table::named(word) {
            return self.write_entry(place, table, at, part, &mut cursor);
        }
        if word.first() == Some(&b'$') {
            return Ok(());
        }
        let at = index;
        let datum = self.names.datum(name, self.context());
        let kind = datum.map(|datum| self.names.data[datum as usize].kind);
        match kind {
            Some(DataKind::Number) => {
                let mut ahead = cursor;
                let token = ahead.next();
                let value = whole(number::parse(ahead.text(token)));
                let alone = ahead.peek().kind == Kind::End;
                self.count(name, at, value.filter(|_| alone));
            }
            Some(DataKind::Fdat) => match part {
                Some(part) => self.write_fdat(name, at, part, &mut cursor),
                None => self.write_whole_fdat(name, at, &mut cursor)?,
            },
            Some(kind) if kind.is_place() => {
                let owner = Owner::Datum(datum.expect("it has a kind"));
                self.write_position(owner, at, part, cursor)?;
            }
            Some(kind @ DataKind::Structure(_)) if part.is_none() => {
                self.write_structure((name, at), kind, cursor)?;
            }
            None if self.looks_like_position(cursor) => {
                self.write_position(Owner::Nobody(name), at, part, cursor)?;
            }
            _ => {}
        }
        Ok(())
    }

    /// Whether a value may be a position, for names that the files do not declare.
    fn looks_like_position(&self, mut cursor: Cursor) -> bool {
        if cursor.blanks() == b'{' {
            return true;
        }
        let name = cursor.next();
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(name), &mut buffer);
        word.starts_with(b"$POS_")
            || word.starts_with(b"$AXIS_")
            || self.mentions_position(cursor.part(name.start as usize, cursor.end))
    }

    /// `XP1={...}`, `XP1=XP2:off`, `XP1.Z=...`
    fn write_position(
        &mut self,
        owner: Owner,
        at: Index,
        part: Option<&[u8]>,
        mut cursor: Cursor,
    ) -> Read<()> {
        self.last = None;
        let how = if let Some(how) = part.and_then(|part| self.axis_written(part)) {
            how
        } else if let Some(part) = part {
            match self.part_written(owner, part, cursor) {
                Some(how) => how,
                None => self.part_becomes(part, cursor),
            }
        } else if cursor.peek().kind == Kind::End {
            return Ok(());
        } else if self.is_frame_of_controller(owner, cursor) {
            How::Whole(self.frame(Table::Base, "", &mut cursor)?)
        } else {
            let point = self.point(&mut cursor)?;
            let is_whole = cursor.peek().kind == Kind::End;
            let value = match point.target {
                _ if !is_whole => self.computed(true),
                Expr::Target(target) if self.builder.script.targets[target].numbers.is_empty() => {
                    // what is not given stays as it was
                    let how = How::PartSomehow(self.builder.script.remark(COMPUTED));
                    self.write_element(owner, at, how);
                    return Ok(());
                }
                _ => self.value_of(&point, self.kind_of(owner)),
            };
            How::Whole(value)
        };
        self.write_element(owner, at, how);
        Ok(())
    }

    fn kind_of(&self, owner: Owner) -> DataKind {
        match owner {
            Owner::Datum(datum) => self.names.data[datum as usize].kind,
            // as most are that moves go to
            Owner::Nobody(_) => DataKind::Position,
        }
    }

    /// `BF.Z=120` of a FRAME, which may be a tool or base.
    fn part_written(&mut self, owner: Owner, part: &[u8], cursor: Cursor) -> Option<How> {
        if self.kind_of(owner) != DataKind::Frame {
            return None;
        }
        let how = self.part_of_frame(self.here, part, cursor)?;
        let How::Parts { ref parts, .. } = how else {
            return None;
        };
        let part = &self.builder.script.parts[parts.start as usize];
        matches!(part.value, PartValue::Number(_)).then_some(how)
    }

    /// Whether a FRAME becomes a tool or base: `BF=BASE_DATA[1]`, `BF=$BASE:F`.
    fn is_frame_of_controller(&self, owner: Owner, mut cursor: Cursor) -> bool {
        let name = cursor.next();
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(name), &mut buffer);
        self.kind_of(owner) == DataKind::Frame
            && (Table::named(word).is_some()
                || matches!(State::named(word), Some(State::Tool | State::Base))
                || matches!(word, b"$NULLFRAME" | b"$WORLD" | b"$ROBROOT"))
    }

    /// What becomes of a position of which the value of an external axis is written.
    pub(super) fn axis_written(&mut self, part: &[u8]) -> Option<How> {
        let mut listed = EXTERNAL.iter();
        let axis = listed
            .find(|name| part.eq_ignore_ascii_case(name.as_bytes()) && self.bit_of(name) != 0)?;
        Some(How::Whole(self.unknown(Remark::external_written(axis))))
    }

    /// What `p.Z=` makes of a position: it displaces it by 200 mm where `p.Z+200` is behind it, or
    /// that of the position that it is a copy of.
    fn part_becomes(&mut self, part: &[u8], cursor: Cursor) -> How {
        let remark = self.builder.script.remark(COMPUTED);
        let letters = |text: &[u8]| -> Vec<u8> {
            let letters = text.iter().filter(|b| !b.is_ascii_whitespace());
            letters.map(u8::to_ascii_uppercase).collect()
        };
        let own = cursor.bytes[self.here.offset as usize..cursor.at].trim_ascii_end();
        let own = letters(own.strip_suffix(b"=").unwrap_or(own));
        let value = &cursor.bytes[cursor.at..cursor.end];
        let value = value.split(|&b| b == b';').next().unwrap_or(value);
        let part = letters(part);
        let is_named = |name: &[u8]| part[..] == *name;
        let names = [&b"X"[..], b"Y", b"Z", b"C", b"B", b"A"];
        let at = names.into_iter().position(is_named);
        if let Some(at) = at
            && let Some((term, of, by)) = self.term_and_rest(value, &own, &letters)
            && let Some(displacement) = grown_by_any(at, by)
        {
            if term == own {
                return self.builder.script.part_by(remark, displacement);
            }
            let mut other = cursor.part(cursor.at + of.start, cursor.at + of.end);
            if at < 3
                && let Some(other) = self.part_of(&mut other, &part)
            {
                let by = self.builder.script.displacement(displacement);
                return How::PartOf {
                    remark,
                    of: other,
                    axis: at,
                    by,
                };
            }
        }
        let is_own = mentions(&letters(value), &own);
        How::part(is_own, at.is_some_and(|at| at > 2), remark)
    }

    /// The position of which a value is this part.
    fn part_of(&mut self, cursor: &mut Cursor, part: &[u8]) -> Option<Expr> {
        let name = cursor.next();
        let at = cursor.brackets().ok()?;
        let is_name = name.kind == Kind::Name && cursor.take(b'.');
        let field = cursor.next();
        let is_part = is_name && cursor.text(field).eq_ignore_ascii_case(part);
        let is_part = is_part && cursor.peek().kind == Kind::End;
        let symbol = self.symbol(cursor, name);
        is_part.then(|| self.named(symbol, Index::of(at, cursor)))?
    }

    pub(super) fn write_element(&mut self, owner: Owner, at: Index, how: How) {
        if at == Index::Variable && self.refuse_array(owner, ASSIGNED) {
            return;
        }
        let variable = match at {
            Index::Variable => Written::AnyOf(self.table_of(owner)),
            _ => Written::One(self.variable(owner, at)),
        };
        self.builder.write(self.here, variable, how);
    }
}
