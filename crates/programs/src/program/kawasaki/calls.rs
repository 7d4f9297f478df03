//! Calls: what runs, and what it is handed.

use super::arrays::is_array;
use super::moves::is_joints;
use super::reader::Reader;
use super::remarks::{COMPUTED, taken_apart};
use super::sections::Statement;
use super::targets::Name;
use crate::program::Source;
use crate::program::script::{
    Argument, Call, Expr, Held, How, RoutineId, Start, TableId, VariableId, Written,
};
use crate::program::words::{Kind, Words, unquoted};

/// How what is called runs.
#[derive(Clone, Copy)]
pub(super) enum Runs {
    /// Here, and the program goes on behind it.
    Now,
    /// Between any two statements of the others.
    AtAnyTime,
    /// Likewise as a process, which may not move the robot.
    WithoutMoves,
}

/// A name that a program hands to another, which may write it.
pub(super) struct Handed {
    pub name: Name,
    pub by: RoutineId,
    /// The other program's name in small letters.
    pub to: Vec<u8>,
    /// The number of the parameter.
    pub number: usize,
}

impl Handed {
    /// Adds the names of a call `name(a,b)`.
    pub(super) fn note(call: Words, by: RoutineId, handed: &mut Vec<Self>) {
        if !call.is(1, b'(') {
            return;
        }
        let given = call.inside(1).0.list().into_iter().enumerate();
        handed.extend(given.filter_map(|(number, given)| {
            let (name, words) = Name::of(given)?;
            (words == given.len()).then(|| Self {
                name,
                by,
                to: call.text(0).to_ascii_lowercase(),
                number,
            })
        }));
    }
}

/// What a parameter is called in the program that has it: joints have their sign there.
pub(super) fn stem_of(parameter: &[u8], given: &Name) -> Vec<u8> {
    let sign: &[u8] = if given.is_joints() { b"#" } else { b"" };
    [sign, parameter].concat()
}

/// What a parameter is called as a number: no text has such a name.
fn as_number(parameter: &[u8]) -> Vec<u8> {
    [b".=", parameter].concat()
}

/// Which programs only the running program may choose among.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Any {
    /// All: `SCALL $name`.
    Program,
    /// `pg1`, `pg2`, …, whose number signals give: `EXTCALL`.
    Selected,
}

impl Any {
    /// Whether a program of this name, in small letters, is among them.
    fn is_one(self, name: &[u8]) -> bool {
        let number = name.strip_prefix(b"pg").unwrap_or_default();
        self == Self::Program || !number.is_empty() && number.iter().all(u8::is_ascii_digit)
    }
}

/// Whether the controller runs a program of this name where it is switched on.
pub(super) fn is_started(name: &[u8]) -> bool {
    let name = name.to_ascii_lowercase();
    name.starts_with(b"autostart") && name.ends_with(b".pc")
}

/// The program that `PCEXECUTE 2: name` starts: the number of the process may stand before it.
pub(super) fn started<'a, 'w>(rest: Words<'a, 'w>) -> Words<'a, 'w> {
    let colon = (0..rest.len()).find(|at| rest.is(*at, b':'));
    rest.behind(colon.map_or(0, |at| at + 1))
}

impl<'a> Reader<'a> {
    /// Names that are handed to programs that write them are written, too; likewise those whose
    /// numbers are read out of them.
    pub(super) fn note_handed(&mut self, handed: &[Handed]) {
        loop {
            let known = (self.written.len(), self.apart.len());
            for one in handed {
                for &callee in &self.programs_of(&one.to) {
                    let Some(parameter) = self.parameters[callee as usize].get(one.number) else {
                        continue;
                    };
                    let own = stem_of(parameter, &one.name);
                    if self.written.contains(&(callee, own.clone())) {
                        self.written.insert((one.by, one.name.stem.clone()));
                    }
                    if let Some(place) = self.apart.get(&(Some(callee), own)).copied() {
                        let owner = self.owner_in(&one.name, one.by);
                        let name = (owner, one.name.stem.clone());
                        self.apart.entry(name).or_insert(place);
                    }
                }
            }
            for (copy, of) in &self.copied {
                if let Some(place) = self.apart.get(copy).copied() {
                    self.apart.entry(of.clone()).or_insert(place);
                }
            }
            if known == (self.written.len(), self.apart.len()) {
                break;
            }
        }
        let names = self.written.iter().map(|(routine, stem)| {
            let name = Name {
                stem: stem.clone(),
                key: None,
            };
            (self.owner_in(&name, *routine), name.stem)
        });
        self.assigned = names.collect();
    }

    /// Elements that programs are handed to write are there before any text asks for one of them.
    pub(super) fn note_written(&mut self, handed: &[Handed]) {
        for one in handed.iter().filter(|one| !is_array(&one.name)) {
            if self.written.contains(&(one.by, one.name.stem.clone())) {
                let place = self.builder.script.routines[one.by as usize].place;
                self.assign(&one.name, place, one.by);
            }
        }
    }

    /// Targets whose numbers a program reads out of them stay as they are.
    pub(super) fn refuse_apart(&mut self) {
        let mut apart: Vec<_> = std::mem::take(&mut self.apart).into_iter().collect();
        apart.sort_unstable();
        for ((owner, stem), place) in apart {
            let source = &self.sources[place.file as usize];
            let (line, _) = source.line_column(place.offset as usize);
            let remark = taken_apart(&source.name, line);
            let elements = self.names.get(&owner).and_then(|names| names.get(&stem));
            if let Some(table) = elements.map(|elements| elements.table) {
                self.builder.script.refuse_all(table, remark);
            }
        }
    }

    /// The programs of a name; none where the files do not have it.
    pub(super) fn programs_of(&self, name: &[u8]) -> Box<[RoutineId]> {
        let known = self.programs.get(&name.to_ascii_lowercase());
        known.map_or_else(Box::default, |all| all[..].into())
    }

    /// Whether a statement is a call.
    pub(super) fn calls(&mut self, statement: &Statement<'a, '_>) -> bool {
        let rest = statement.words.behind(1);
        match statement.keyword {
            "CAll" | "JUMP" => self.call(rest, Runs::Now),
            "SCAll" | "SJUMP" => self.call_text(rest),
            "EXtcall" => self.call_any(statement.words, Any::Selected),
            _ => return false,
        }
        if matches!(statement.keyword, "JUMP" | "SJUMP") {
            // from there it goes back to the caller of this one
            self.builder.back();
        }
        true
    }

    /// `CALL name(a,b)`, `JUMP name`
    pub(super) fn call(&mut self, part: Words<'a, '_>, runs: Runs) {
        if part.is_empty() {
            return;
        }
        let callees = self.programs_of(part.text(0));
        let (mut arguments, mut chosen) = (Vec::new(), Vec::new());
        if part.is(1, b'(') {
            let given = part.inside(1).0.list();
            for (number, given) in given.into_iter().enumerate() {
                self.argument(given, number, &callees, &mut arguments);
                chosen.extend(self.chosen(given, number, &callees));
            }
        }
        let call = self.call_of(part.text(0), callees, arguments);
        match runs {
            Runs::Now => self.put_call(call),
            Runs::AtAnyTime => self.builder.start(call, true),
            Runs::WithoutMoves => self.builder.start(call, false),
        }
        // what only the running program chooses is then what the parameter is
        for (table, parameter) in chosen {
            let how = How::Whole(Expr::Variable(parameter));
            self.write(Written::AnyOf(table), how);
        }
    }

    /// `SCALL "name"`, `SCALL $name,error`, `SJUMP "name"`
    fn call_text(&mut self, part: Words<'a, '_>) {
        let list = part.list();
        match list.first() {
            Some(name) if name.len() == 1 && name.kind(0) == Some(Kind::Text) => {
                let name = unquoted(name.text(0));
                let callees = self.programs_of(name);
                let call = self.call_of(name, callees, Vec::new());
                self.put_call(call);
            }
            _ => self.call_any(part, Any::Program),
        }
    }

    /// Some program, and only the running program knows which: one of these in the files, or another.
    fn call_any(&mut self, part: Words<'a, '_>, any: Any) {
        let place = self.place(self.here.at);
        let known = self.any.iter().find(|(of, _)| *of == any);
        let routine = if let Some((_, routine)) = known {
            *routine
        } else {
            let made = (self.builder).declare("any program", place, Start::Called);
            self.called.insert(made);
            self.any.push((any, made));
            made
        };
        self.put_call(Call {
            foreign: true,
            leads: true,
            ..Call::of(place, [routine].into(), Source::text(part.whole()), 0..0)
        });
    }

    /// Calls say which they are to programs that ask.
    pub(super) fn hand_over_calls(&mut self) {
        let by_calls = std::mem::take(&mut self.by_calls);
        if let Some(known) = self.known.get() {
            by_calls.hand_over(&known.entries.given, &mut self.builder.script);
        }
    }

    /// What stands for any program: a routine that calls one of them.
    pub(super) fn write_any(&mut self) {
        for (any, routine) in std::mem::take(&mut self.any) {
            let place = self.builder.script.routines[routine as usize].place;
            let ones = self.programs.iter().filter(|(name, _)| any.is_one(name));
            let mut callees: Vec<RoutineId> = ones.flat_map(|(_, all)| all).copied().collect();
            callees.sort_unstable();
            self.builder.open(routine);
            self.builder.begin_choice();
            for callee in callees {
                self.builder.next_branch(false);
                let call = Call::of(place, [callee].into(), "any program", 0..0);
                self.builder.call(call);
            }
            self.builder.end_choice();
            self.builder.close();
        }
    }

    /// A call of a name.
    fn call_of(&mut self, name: &[u8], callees: Box<[RoutineId]>, given: Vec<Argument>) -> Call {
        let own = self.here.routine;
        self.called
            .extend(callees.iter().filter(|callee| **callee != own));
        let arguments = self.builder.script.give(given);
        let place = self.place(self.here.at);
        Call::of(place, callees, Source::text(name), arguments)
    }

    /// What a call does to the flow, where it stands.
    fn put_call(&mut self, call: Call) {
        self.builder.call(call);
        self.here.last = None;
    }

    /// Where only the running program knows what it calls, what no call names may be started by the
    /// operator all the same.
    pub(super) fn start_uncalled(&mut self) {
        if self.any.is_empty() {
            return;
        }
        for (routine, of) in (0..).zip(&mut self.builder.script.routines) {
            if of.start == Start::Called && !self.called.contains(&routine) {
                of.start = Start::Main;
            }
        }
    }

    fn argument(
        &mut self,
        given: Words<'a, '_>,
        number: usize,
        callees: &[RoutineId],
        arguments: &mut Vec<Argument>,
    ) {
        if let Some(value) = self.number_given(given) {
            for &callee in callees {
                if let Some(own) = self.parameters[callee as usize].get(number) {
                    let own = self.parameter(callee, as_number(own), Vec::new());
                    arguments.push(Argument::new(Some(own), value, None));
                }
            }
        }
        let name = Name::of(given).filter(|(_, words)| *words == given.len());
        if name.is_none() && (is_joints(given) || self.is_transformation(given, self.here.routine))
        {
            return self.position_given(given, number, callees, arguments);
        }
        let Some((name, _)) = name.filter(|(name, _)| self.is_known(name)) else {
            return;
        };
        let is_whole = is_array(&name);
        let elements = if is_whole {
            self.elements_given(&name)
        } else {
            let position = self.position(given);
            vec![(Vec::new(), self.expr(&position))]
        };
        if callees.is_empty() {
            let values = elements.iter().map(|(_, value)| *value);
            arguments.extend(values.map(|value| Argument::new(None, value, None)));
        }
        for &callee in callees {
            let Some(parameter) = self.parameters[callee as usize].get(number) else {
                continue;
            };
            let stem = stem_of(parameter, &name);
            let keys = if is_whole {
                let all = self.given.get(&(callee, stem.clone()));
                all.cloned().unwrap_or_default()
            } else {
                [Vec::new()].into()
            };
            for key in keys {
                let value = elements.iter().find(|(own, _)| *own == key);
                // what another call gave is there no more
                let value = value.map_or_else(|| self.unknown(COMPUTED), |(_, value)| *value);
                let parameter = self.parameter(callee, stem.clone(), key);
                arguments.push(Argument::new(Some(parameter), value, value.variable()));
            }
        }
    }

    /// A position that a call works out: `p+TRANS(0,0,50)`.
    fn position_given(
        &mut self,
        given: Words<'a, '_>,
        number: usize,
        callees: &[RoutineId],
        arguments: &mut Vec<Argument>,
    ) {
        let position = self.position(given);
        let value = self.expr(&position);
        if callees.is_empty() {
            arguments.push(Argument::new(None, value, None));
        }
        let sign: &[u8] = if is_joints(given) { b"#" } else { b"" };
        for &callee in callees {
            if let Some(own) = self.parameters[callee as usize].get(number) {
                let own = self.parameter(callee, [sign, own].concat(), Vec::new());
                arguments.push(Argument::new(Some(own), value, None));
            }
        }
    }

    /// The array of which a call gives an element that only the running program chooses, with the
    /// parameters that it is given for where programs write these.
    fn chosen(
        &mut self,
        given: Words,
        number: usize,
        callees: &[RoutineId],
    ) -> Vec<(TableId, VariableId)> {
        let name =
            Name::of(given).filter(|(name, words)| *words == given.len() && name.key.is_none());
        let table = name.and_then(|(name, _)| Some((self.table(&name)?, name)));
        let Some((table, name)) = table else {
            return Vec::new();
        };
        let mut all = Vec::new();
        for &callee in callees {
            let Some(parameter) = self.parameters[callee as usize].get(number) else {
                continue;
            };
            let stem = stem_of(parameter, &name);
            if self.written.contains(&(callee, stem.clone())) {
                all.push((table, self.parameter(callee, stem, Vec::new())));
            }
        }
        all
    }

    /// The number that a call gives; `None` where the text does not tell it.
    fn number_given(&mut self, given: Words<'a, '_>) -> Option<Expr> {
        if let Some(number) = given.whole_number() {
            return Some(self.builder.script.held(Held::Number(number)));
        }
        self.given_number(given).map(Expr::Variable)
    }

    /// The parameter that words are where nothing but calls writes it as a number.
    pub(super) fn given_number(&mut self, words: Words) -> Option<VariableId> {
        let routine = self.here.routine;
        let (name, _) = Name::of(words).filter(|(_, count)| *count == 1 && words.len() == 1)?;
        let is_own = self.parameters[routine as usize].contains(&name.stem);
        let is_only_given = is_own && self.is_only_given(routine, &name.stem);
        is_only_given.then(|| self.parameter(routine, as_number(&name.stem), Vec::new()))
    }

    /// The variable of a program's parameter, or of an element of it.
    pub(super) fn parameter(
        &mut self,
        callee: RoutineId,
        stem: Vec<u8>,
        key: Vec<u8>,
    ) -> VariableId {
        let caller = std::mem::replace(&mut self.here.routine, callee);
        let parameter = self.variable(&Name {
            stem,
            key: Some(key),
        });
        self.here.routine = caller;
        parameter
    }
}
