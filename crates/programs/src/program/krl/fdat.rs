//! FDAT: the numbers of a tool and a base and the mode of a move, `FDAT_ACT` and those that inline
//! forms copy there.

use super::data::fdat;
use super::frames::{Choice, State, Table};
use super::names::{DataKind, Fdat, Index, Stored};
use super::reader::Reader;
use super::remarks::fdat_missing;
use super::tokens::{Cursor, Kind, Read};
use crate::program::names::Symbol;
use crate::program::script::{Expr, Place, Variable, VariableId};

/// The parts of an FDAT that say with what a move runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Part {
    Tool,
    Base,
    Mode,
}

impl Part {
    /// The part of a name in capitals.
    fn named(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"TOOL_NO" => Self::Tool,
            b"BASE_NO" => Self::Base,
            b"IPO_FRAME" => Self::Mode,
            _ => return None,
        })
    }

    /// The state of the controller that holds it for the next move.
    fn state(self) -> State {
        match self {
            Self::Tool => State::FdatTool,
            Self::Base => State::FdatBase,
            Self::Mode => State::FdatIpo,
        }
    }
}

const PARTS: [Part; 3] = [Part::Tool, Part::Base, Part::Mode];

impl Reader {
    /// The FDAT of a name, where the files have it and no statement changes it.
    pub(super) fn fdat_of(&self, name: Symbol, at: Index) -> Option<Fdat> {
        match self.names.constant(name, at, self.context())? {
            Stored::Fdat(fdat) => Some(fdat),
            _ => None,
        }
    }

    fn part_of_fdat(&mut self, fdat: Fdat, part: Part) -> Expr {
        match part {
            Part::Tool => self.number_of(fdat.tool.map(Choice::Entry)),
            Part::Base => self.number_of(fdat.base.map(Choice::Entry)),
            Part::Mode => self.mode_value(fdat.is_external),
        }
    }

    /// The variable of a part of an FDAT that no routine is given.
    fn fdat_variable(&mut self, name: Symbol, at: Index, part: Part) -> Option<VariableId> {
        let datum = self.names.datum(name, self.context())?;
        let of = self.names.data[datum as usize];
        let is_followed = at == Index::Whole && !self.names.given_away.contains(&of.name);
        if of.kind != DataKind::Fdat || !is_followed || self.names.given_away.contains(&name) {
            return None;
        }
        if let Some(known) = self.fdats.get(&(datum, part)) {
            return Some(*known);
        }
        let declared = match self.names.values(datum, at).last() {
            Some((_, _, Stored::Fdat(fdat))) => self.part_of_fdat(*fdat, part),
            _ => self.chosen(),
        };
        let spelled = self.names.symbols.spelling(of.name);
        let made = self.builder.script.variable(Variable {
            kept: of.kept,
            routine: of.context.routine,
            ..Variable::new(spelled, of.place, declared)
        });
        self.fdats.insert((datum, part), made);
        Some(made)
    }

    /// The number of the tool or base of an FDAT that the files do not have.
    fn fdat_missing(&mut self, name: Symbol) -> Option<VariableId> {
        let is_known = self.names.datum(name, self.context()).is_some();
        if is_known || self.names.touched.contains(&name) {
            return None;
        }
        if let Some(known) = self.fdats_missing.get(&name) {
            return Some(*known);
        }
        let spelled = self.names.symbols.spelling(name).to_owned();
        let unknown = self.unknown(fdat_missing(&spelled));
        let script = &mut self.builder.script;
        let made = script.variable(Variable::new(spelled, Place::NOWHERE, unknown));
        self.fdats_missing.insert(name, made);
        Some(made)
    }

    /// Likewise of one that stands alone, as in `STOOL2(FP1)`.
    pub(super) fn missing_in(&mut self, mut cursor: Cursor) -> Option<Choice> {
        let token = cursor.next();
        let is_alone = token.kind == Kind::Name && cursor.peek().kind == Kind::End;
        let name = self.symbol(&cursor, token);
        let missing = is_alone.then(|| self.fdat_missing(name))?;
        missing.map(Choice::By)
    }

    /// What a part of an FDAT is.
    fn fdat_value(&mut self, name: Symbol, at: Index, part: Part) -> Expr {
        if let Some(fdat) = self.fdat_of(name, at) {
            return self.part_of_fdat(fdat, part);
        }
        if let Some(variable) = self.fdat_variable(name, at, part) {
            return Expr::Variable(variable);
        }
        if part != Part::Mode
            && let Some(missing) = self.fdat_missing(name)
        {
            return Expr::Variable(missing);
        }
        // data that are not in the files are of a tool that the robot holds, as all that are
        let is_held =
            !self.declared.has_fixed_tools && self.names.datum(name, self.context()).is_none();
        let unknown = Fdat {
            is_external: is_held.then_some(false),
            ..Fdat::default()
        };
        self.part_of_fdat(unknown, part)
    }

    /// The number of the tool, or of the base, of an FDAT.
    pub(super) fn number_in(&mut self, name: Symbol, at: Index, is_tool: bool) -> Option<Choice> {
        if let Some(fdat) = self.fdat_of(name, at) {
            let number = if is_tool { fdat.tool } else { fdat.base };
            return number.map(Choice::Entry);
        }
        let part = if is_tool { Part::Tool } else { Part::Base };
        let variable = self.fdat_variable(name, at, part);
        let variable = variable.or_else(|| self.fdat_missing(name));
        variable.map(Choice::By)
    }

    /// The mode of an FDAT.
    pub(super) fn mode_in(&mut self, name: Symbol, at: Index) -> Expr {
        self.fdat_value(name, at, Part::Mode)
    }

    /// `FDAT_ACT=FP1`, `FDAT_ACT={...}`; the cursor stands behind `=`.
    pub(super) fn activate(&mut self, place: Place, cursor: &mut Cursor) -> Read<()> {
        let values = self.fdat_values(cursor)?;
        for (part, value) in PARTS.into_iter().zip(values) {
            self.set(place, part.state(), value);
        }
        let [tool, base, _] = values;
        let is_known = matches!((tool, base), (Expr::Value(_), Expr::Value(_)));
        self.active = is_known.then_some((tool, base));
        Ok(())
    }

    /// The parts of an FDAT as it is written: numbers, a name, or what a function returns.
    fn fdat_values(&mut self, cursor: &mut Cursor) -> Read<[Expr; 3]> {
        if cursor.blanks() == b'{' {
            let found = fdat(cursor)?;
            return Ok(PARTS.map(|part| self.part_of_fdat(found, part)));
        }
        let token = cursor.next();
        if cursor.text(token).eq_ignore_ascii_case(b"FDAT_ACT") {
            return Ok(PARTS.map(|part| self.states.expr(part.state())));
        }
        let name = self.symbol(cursor, token);
        let at = Index::of(cursor.brackets()?, cursor);
        if cursor.blanks() == b'(' {
            return Ok(PARTS.map(|part| self.part_of_fdat(Fdat::default(), part)));
        }
        Ok(PARTS.map(|part| self.fdat_value(name, at, part)))
    }

    /// `F=FP1`, `F={...}`; the cursor stands behind `=`.
    pub(super) fn write_whole_fdat(
        &mut self,
        name: Symbol,
        at: Index,
        cursor: &mut Cursor,
    ) -> Read<()> {
        let values = self.fdat_values(cursor)?;
        for (part, value) in PARTS.into_iter().zip(values) {
            if let Some(variable) = self.fdat_variable(name, at, part) {
                self.put(self.here, variable, value);
            }
        }
        Ok(())
    }

    /// What is written into a part; the cursor stands behind `=`.
    fn given_part(&mut self, part: Part, cursor: &mut Cursor) -> Expr {
        if part == Part::Mode {
            return self.mode(cursor);
        }
        let choice = self.choice(*cursor, Table::Tool);
        self.number_of(choice)
    }

    /// `FDAT_ACT.TOOL_NO=3`
    pub(super) fn activate_part(&mut self, place: Place, part: &[u8], cursor: &mut Cursor) {
        if let Some(part) = Part::named(part) {
            self.active = None;
            let value = self.given_part(part, cursor);
            self.set(place, part.state(), value);
        }
    }

    /// What the text does not tell is written into a part.
    pub(super) fn lose_fdat(&mut self, name: Symbol, at: Index, part: &[u8]) {
        if let Some(part) = Part::named(part)
            && let Some(variable) = self.fdat_variable(name, at, part)
        {
            let value = self.part_of_fdat(Fdat::default(), part);
            self.put(self.here, variable, value);
        }
    }

    /// `FP1.BASE_NO=3`
    pub(super) fn write_fdat(&mut self, name: Symbol, at: Index, part: &[u8], cursor: &mut Cursor) {
        if let Some(part) = Part::named(part)
            && let Some(variable) = self.fdat_variable(name, at, part)
        {
            let value = self.given_part(part, cursor);
            self.put(self.here, variable, value);
        }
    }
}
