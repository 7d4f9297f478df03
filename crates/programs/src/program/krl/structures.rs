//! Positions that are members of structures (STRUC), each a variable called `s.P`, data of other
//! data lists (IMPORT), and what functions return.

use super::aggregate;
use super::names::{DataKind, Datum, Index, Stored};
use super::reader::Reader;
use super::remarks::COMPUTED;
use super::targets::Owner;
use super::tokens::{Cursor, Kind, Read, Token, capitals, lines};
use crate::program::Source;
use crate::program::kit::content_start;
use crate::program::names::{Context, Symbol};
use crate::program::script::{Argument, Expr, How, Place, Variable, VariableId};

/// Structures in structures.
const DEEPEST: usize = 4;

/// The members of a type that the files declare, and their types.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Structure {
    members: Vec<(Box<[u8]>, Symbol, DataKind)>,
}

/// A structure as a whole.
pub(super) enum Structured {
    Named(Symbol, Index),
    /// What this routine returns.
    Returned(u32),
}

/// `IMPORT E6POS XP1 IS /R1/PTS..XP1`
#[derive(Debug)]
pub(super) struct Import {
    name: Symbol,
    /// The data list.
    of: Box<[u8]>,
    there: Symbol,
    context: Context,
}

impl Reader {
    /// Reads the types that a file declares.
    pub(super) fn types(&mut self, source: &Source) {
        let bytes = &source.bytes;
        for (at, end) in lines(bytes, content_start(bytes)) {
            let mut cursor = Cursor { bytes, at, end };
            if !matches!(cursor.blanks(), b'S' | b's' | b'G' | b'g') {
                continue;
            }
            let mut word = cursor.next();
            if cursor.text(word).eq_ignore_ascii_case(b"GLOBAL") {
                word = cursor.next();
            }
            if cursor.text(word).eq_ignore_ascii_case(b"STRUC") {
                self.structure(cursor);
            }
        }
    }

    /// `my E6POS P,Q[3],INT n`
    fn structure(&mut self, mut cursor: Cursor) {
        let name = cursor.next();
        let name = self.symbol(&cursor, name);
        let mut members = Vec::new();
        let mut of = None;
        loop {
            let mut token = cursor.next();
            if token.kind != Kind::Name {
                break;
            }
            if cursor.peek().kind == Kind::Name {
                of = Some(token);
                token = cursor.next();
            }
            let Some(of) = of else { break };
            let (Ok(_), member) = (cursor.brackets(), cursor.text(token).into()) else {
                break;
            };
            let kind = DataKind::named(capitals(cursor.text(of), &mut [0; 24]));
            members.push((member, self.symbol(&cursor, of), kind));
            if !cursor.take(b',') {
                break;
            }
        }
        let new = Structure { members };
        let types = &mut self.names.structures;
        match types.iter().find(|known| known.0 == name) {
            None => types.push((name, new)),
            // of two by one name nothing is known
            Some((_, known)) if *known == new => {}
            Some(_) => types.retain(|known| known.0 != name),
        }
    }

    /// The kind of a type that the files declare.
    pub(super) fn structure_of(&self, name: Symbol) -> DataKind {
        let found = self.names.structures.iter().position(|of| of.0 == name);
        found.map_or(DataKind::Other, DataKind::Structure)
    }

    fn members_of(&self, kind: DataKind) -> Vec<(Box<[u8]>, DataKind)> {
        let DataKind::Structure(at) = kind else {
            return Vec::new();
        };
        let members = self.names.structures[at].1.members.iter();
        members
            .map(|(name, of, kind)| match kind {
                DataKind::Other => (name.clone(), self.structure_of(*of)),
                kind => (name.clone(), *kind),
            })
            .filter(|(_, kind)| kind.is_place() || matches!(kind, DataKind::Structure(_)))
            .collect()
    }

    /// Declares the members of a variable.
    pub(super) fn declare_members(&mut self, of: Datum, global: bool) {
        let spelled = self.names.symbols.spelling(of.name);
        if spelled.matches('.').count() >= DEEPEST {
            return;
        }
        for (member, kind) in self.members_of(of.kind) {
            let path = self.names.symbols.path(of.name, &member);
            let name = self.names.symbols.intern(&path);
            let datum = Datum { name, kind, ..of };
            self.names.declare(datum, global);
            self.declare_members(datum, global);
        }
    }

    /// The values of the members of a variable: `{P {X 1,...},n 2}`.
    pub(super) fn member_values(
        &mut self,
        name: Symbol,
        kind: DataKind,
        index: Index,
        cursor: &mut Cursor,
    ) -> Read<()> {
        let members = self.members_of(kind);
        let mut nested = Vec::new();
        aggregate::each(cursor, |_, key, field| {
            if let aggregate::Field::Nested(start) = field {
                nested.push((key, start));
            }
            Ok(())
        })?;
        for (key, start) in nested {
            let text = cursor.text(key);
            let found = members.iter().find(|of| of.0.eq_ignore_ascii_case(text));
            let Some((member, kind)) = found else {
                continue;
            };
            let path = self.names.symbols.path(name, member);
            let path = self.names.symbols.intern(&path);
            let mut inner = cursor.part(start, cursor.end);
            if !kind.is_place() {
                self.member_values(path, *kind, index, &mut inner)?;
                continue;
            }
            let aggregate = aggregate::read(&mut inner)?;
            let called = self.names.symbols.spelling(path).to_owned();
            let called = match index {
                Index::At([first, 0, 0]) => called.replacen('.', &format!("[{first}]."), 1),
                _ => called,
            };
            let target = self.add(&aggregate, start..inner.at, Some(called.into()));
            if let Some(datum) = self.names.last_of(path, self.module) {
                let value = (datum, index, Stored::Target(target));
                self.names.values.push(value);
            }
        }
        Ok(())
    }

    /// What `name[..].P[..]` is, with what is a member of it, behind its name and index: up to the
    /// first part that is none.
    pub(super) fn member(
        &mut self,
        name: Symbol,
        at: Option<(usize, usize)>,
        cursor: &mut Cursor,
    ) -> Read<(Symbol, Index)> {
        let (mut name, mut index) = (name, Index::of(at, cursor));
        loop {
            let mut ahead = *cursor;
            let kind = self.names.kind(name, self.context());
            if !matches!(kind, Some(DataKind::Structure(_))) || !ahead.take(b'.') {
                return Ok((name, index));
            }
            let part = ahead.next();
            let symbols = &self.names.symbols;
            let member = symbols.find(&symbols.path(name, ahead.text(part)));
            let is_declared = |member: &Symbol| self.names.kind(*member, self.context()).is_some();
            let Some(member) = member.filter(is_declared) else {
                return Ok((name, index));
            };
            let inner = Index::of(ahead.brackets()?, &ahead);
            (name, index, *cursor) = (member, index.inside(inner), ahead);
        }
    }

    /// The positions in a structure, as what stands behind its name: `.P`, `.Q.P`.
    fn places_of(&self, kind: DataKind, depth: usize) -> Vec<(Vec<u8>, DataKind)> {
        let mut all = Vec::new();
        for (member, kind) in self.members_of(kind) {
            let path = [b".", &member[..]].concat();
            if kind.is_place() {
                all.push((path, kind));
            } else if depth < DEEPEST {
                let inner = self.places_of(kind, depth + 1).into_iter();
                all.extend(inner.map(|(rest, kind)| ([&path[..], &rest].concat(), kind)));
            }
        }
        all
    }

    /// The name of a position in a structure.
    fn place_in(&mut self, of: Symbol, path: &[u8]) -> Symbol {
        let name = self.names.symbols.spelling(of).as_bytes();
        let name = [name, path].concat();
        self.names.symbols.intern(&name)
    }

    /// What a structure as a whole is: by its name, or what a function returns.
    fn structure_value(&mut self, kind: DataKind, cursor: &mut Cursor) -> Read<Option<Structured>> {
        let name = cursor.next();
        if name.kind != Kind::Name {
            return Ok(None);
        }
        let symbol = self.symbol(cursor, name);
        if cursor.blanks() == b'(' {
            let routine = self.names.routine(symbol, self.context());
            let returns = routine.map(|of| self.names.heads[of as usize].returns);
            return Ok(routine
                .filter(|_| returns == Some(kind))
                .map(Structured::Returned));
        }
        let at = cursor.brackets()?;
        let (symbol, at) = self.member(symbol, at, cursor)?;
        let is_whole = cursor.peek().kind == Kind::End;
        let is_it = is_whole && self.names.kind(symbol, self.context()) == Some(kind);
        Ok(is_it.then_some(Structured::Named(symbol, at)))
    }

    /// A position in a structure as a whole; `None` is: the text does not tell which.
    fn place_of(&mut self, of: Option<&Structured>, path: &[u8]) -> Expr {
        let known = match of {
            Some(Structured::Named(name, at)) => {
                let name = self.place_in(*name, path);
                self.named(name, *at)
            }
            Some(Structured::Returned(routine)) => {
                Some(Expr::Variable(self.returned_in(*routine, path)))
            }
            None => None,
        };
        known.unwrap_or_else(|| self.unknown(COMPUTED))
    }

    /// `S2=S`, `S2=MK(XP1)`; the cursor stands behind `=`.
    pub(super) fn write_structure(
        &mut self,
        (name, at): (Symbol, Index),
        kind: DataKind,
        mut cursor: Cursor,
    ) -> Read<()> {
        let value = self.structure_value(kind, &mut cursor)?;
        self.structure_becomes((name, at), kind, value.as_ref());
        Ok(())
    }

    /// What a structure as a whole becomes; `None` is: the text does not tell.
    pub(super) fn structure_becomes(
        &mut self,
        (name, at): (Symbol, Index),
        kind: DataKind,
        value: Option<&Structured>,
    ) {
        for (path, _) in self.places_of(kind, 0) {
            let own = self.place_in(name, &path);
            let Some(datum) = self.names.datum(own, self.context()) else {
                continue;
            };
            let value = self.place_of(value, &path);
            self.write_element(Owner::Datum(datum), at, How::Whole(value));
        }
    }

    /// The positions in a structure that a call gives to a parameter of the same type, or to a routine
    /// that is not in the files.
    pub(super) fn positions_given(
        &mut self,
        (name, at): (Symbol, Index),
        parameter: Option<(u32, bool)>,
    ) -> Vec<Argument> {
        let Some(kind @ DataKind::Structure(_)) = self.names.kind(name, self.context()) else {
            return Vec::new();
        };
        let to = parameter.map(|(datum, _)| self.names.data[datum as usize]);
        if to.is_some_and(|to| to.kind != kind) {
            return Vec::new();
        }
        let by_reference = parameter.is_none_or(|(_, by_reference)| by_reference);
        let mut all = Vec::new();
        for (path, _) in self.places_of(kind, 0) {
            let own = self.place_in(name, &path);
            let Some(value) = self.named(own, at) else {
                continue;
            };
            let variable = to.and_then(|to| {
                let name = self.place_in(to.name, &path);
                let datum = self.names.datum(name, to.context)?;
                Some(self.variable_of(datum))
            });
            let back = match value {
                Expr::Variable(variable) if by_reference => Some(variable),
                _ => None,
            };
            all.push(Argument::new(variable, value, back));
        }
        all
    }

    /// The variable that holds a position in the structure that a function returns.
    fn returned_in(&mut self, routine: u32, path: &[u8]) -> VariableId {
        if let Some(known) = self.structures_returned.get(&(routine, path.to_vec())) {
            return *known;
        }
        let script = &mut self.builder.script;
        let of = &script.routines[routine as usize];
        let name = format!("{}(){}", of.name, Source::text(path));
        let made = script.variable(Variable::new(name, of.place, Expr::Absent));
        self.structures_returned
            .insert((routine, path.to_vec()), made);
        made
    }

    /// `IMPORT E6POS XP1 IS /R1/PTS..XP1`; the cursor stands behind IMPORT.
    pub(super) fn import(&mut self, mut cursor: Cursor) {
        cursor.next();
        let name = cursor.next();
        let (Ok(_), is) = (cursor.brackets(), cursor.next()) else {
            return;
        };
        if name.kind != Kind::Name || !cursor.text(is).eq_ignore_ascii_case(b"IS") {
            return;
        }
        let path = &cursor.bytes[cursor.at..cursor.end];
        let path = path.split(|b| matches!(b, b';' | b'[')).next();
        let path = path.unwrap_or_default().trim_ascii();
        let Some(dots) = path.windows(2).rposition(|two| two == b"..") else {
            return;
        };
        let list = &path[..dots];
        let folder = memchr::memrchr(b'/', list).map_or(0, |slash| slash + 1);
        let import = Import {
            name: self.symbol(&cursor, name),
            of: list[folder..].to_ascii_lowercase().into(),
            there: self.names.symbols.intern(&path[dots + 2..]),
            context: self.context(),
        };
        self.names.imports.push(import);
    }

    /// The variable that holds what a function with a position returns.
    pub(super) fn result_in(&mut self, routine: u32) -> Option<VariableId> {
        let head = &self.names.heads[routine as usize];
        if !head.returns.is_place() {
            return None;
        }
        if let Some(known) = head.result {
            return Some(known);
        }
        let script = &mut self.builder.script;
        let of = &script.routines[routine as usize];
        // one that ends without RETURN stops the program
        let result = Variable::new(format!("{}()", of.name), of.place, Expr::Absent);
        let made = script.variable(result);
        self.names.heads[routine as usize].result = Some(made);
        Some(made)
    }

    /// Notes what a function just returned to where it is called: it may return something else before
    /// that is used.
    pub(super) fn note_returned(&mut self, name: Token, routine: u32) {
        let Some(result) = self.result_in(routine) else {
            return;
        };
        let script = &self.builder.script;
        let of = script.variables[result as usize].clone();
        let place = Place::new(self.file, name.start);
        let copy = self.builder.script.variable(Variable { place, ..of });
        self.put(place, copy, Expr::Variable(result));
        let kind = self.names.heads[routine as usize].returns;
        self.results.push((name.start, copy, kind));
    }

    /// What the function returned that this statement calls there.
    pub(super) fn returned(&self, name: Token) -> Option<(Expr, DataKind)> {
        let of = self.results.iter().find(|(start, ..)| *start == name.start);
        of.map(|(_, result, kind)| (Expr::Variable(*result), *kind))
    }

    /// `RETURN XP2`; the cursor stands behind RETURN.
    pub(super) fn return_value(&mut self, mut cursor: Cursor) -> Read<()> {
        let routine = self.context().routine;
        let result = routine.and_then(|of| self.result_in(of));
        let returns = routine.map_or(DataKind::Other, |of| self.names.heads[of as usize].returns);
        if let (Some(routine), DataKind::Structure(_)) = (routine, returns) {
            let value = self.structure_value(returns, &mut cursor)?;
            for (path, _) in self.places_of(returns, 0) {
                let value = self.place_of(value.as_ref(), &path);
                let variable = self.returned_in(routine, &path);
                self.put(self.here, variable, value);
            }
        }
        if let Some(result) = result.filter(|_| cursor.peek().kind != Kind::End) {
            let point = self.point(&mut cursor)?;
            let value = self.value_of(&point, returns);
            self.put(self.here, result, value);
        }
        Ok(())
    }
}

impl super::names::Names {
    /// Names of other data lists mean what these declare; nothing is known of the members of
    /// structures that are written as a whole or given to routines.
    pub(super) fn settle_structures(&mut self) {
        for import in std::mem::take(&mut self.imports) {
            let is_of = |key: &str| {
                let name = key.rsplit(['/', '\\']).next().unwrap_or(key);
                name.as_bytes() == &*import.of
            };
            let mut modules = (0..).zip(&self.modules).filter(|(_, of)| is_of(&of.key));
            let (Some((module, _)), None) = (modules.next(), modules.next()) else {
                continue;
            };
            let there = Context {
                module,
                routine: None,
            };
            let is_it = |datum: &Datum| datum.name == import.there && datum.context == there;
            let Some(datum) = self.data.iter().position(is_it) else {
                continue;
            };
            let datum = crate::program::script::short(datum);
            self.alias(import.name, import.context, datum);
            for [a, b] in [[import.name, import.there], [import.there, import.name]] {
                if self.touched.contains(&a) {
                    self.touched.insert(b);
                }
                let range = (a, Index::At([0; 3]))..(a, Index::Variable);
                let elements: Vec<_> = self.elements.range(range).map(|of| of.1).collect();
                self.elements.extend(elements.into_iter().map(|at| (b, at)));
            }
        }
        if self.structures.is_empty() {
            return;
        }
        let mut lost = vec![false; self.data.len()];
        for (lost, datum) in lost.iter_mut().zip(&self.data) {
            let spelled = self.symbols.spelling(datum.name);
            let is_handed = |dot: usize| {
                let whole = self.symbols.find(&spelled.as_bytes()[..dot]);
                whole.is_some_and(|whole| self.handed.contains(&whole))
            };
            *lost = spelled.match_indices('.').any(|(dot, _)| is_handed(dot));
            if *lost {
                self.touched.insert(datum.name);
            }
        }
        self.values.retain(|(datum, ..)| !lost[*datum as usize]);
    }
}
