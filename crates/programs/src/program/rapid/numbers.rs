//! What numbers may be: constants, what FOR counts, and data with all that is written into them.

use super::builtins::{self, Known};
use super::places::{PlaceWrite, Value, axis_of};
use super::resolved::{Entity, Resolved};
use super::syntax::{
    Argument, Called, Callee, Component, Counting, Expression, Function, Index, StatementKind,
    Storage, Type, Verb, indices,
};
use crate::program::contexts::{Given, Numbered};
use crate::program::names::{Context, Meaning, Symbol};
use crate::program::numbers::{Blocks, Numbers, Operand, Site, counted, evaluated, word};
use crate::program::quantity::{Arithmetic, Quantity, is_letter};
use crate::program::script::Place;

/// Data that tasks share have the number of their group, above this.
pub(super) const SHARED: u32 = 1 << 31;
/// What functions give has the number of the routine, above this.
pub(super) const RESULT: u32 = 1 << 30;
/// Coordinates have their number above this.
pub(super) const COMPONENT: u32 = 1 << 29;

/// What is written into a number.
#[derive(Clone, Copy, Debug)]
pub(super) enum Written {
    /// The value of these bytes.
    Text {
        file: u32,
        bytes: (u32, u32),
        context: Context,
    },
    /// What it is, and these bytes.
    Added {
        file: u32,
        bytes: (u32, u32),
        context: Context,
    },
    /// What it is, and this.
    More(f64),
    Unfollowed,
    /// This coordinate of what these bytes name.
    Coordinate {
        file: u32,
        bytes: (u32, u32),
        context: Context,
        axis: usize,
    },
    Zero,
}

/// All that is written into numbers and coordinates.
#[derive(Default)]
struct Noted {
    numbers: Numbers<Written>,
    given: Given<Written>,
    places: Vec<PlaceWrite>,
}

impl Resolved<'_> {
    /// What a number is called in [`Self::numbers`].
    pub(super) fn number(&self, datum: u32) -> u32 {
        self.group_of(datum).map_or(datum, |group| SHARED | group)
    }

    /// Notes all that is written into numbers.
    pub(super) fn find_numbers(&mut self) {
        let mut noted = Noted::default();
        let blank = self.declared(&mut noted.numbers);
        for (at, routine) in (0..).zip(&self.parsed.routines) {
            if routine.is_trap {
                noted.numbers.runs_at_any_time(at);
            }
        }
        let mut blocks = Blocks::default();
        let mut context = Context {
            module: 0,
            routine: None,
        };
        let mut file = 0;
        for statement in &self.parsed.statements {
            if !matches!(statement.kind, StatementKind::Text { .. }) {
                noted.numbers.stands(statement.offset, &blocks);
            }
            match statement.kind {
                StatementKind::Text {
                    file: in_file,
                    context: now,
                } => {
                    (context, file) = (now, in_file);
                    blocks.begin(context.routine.unwrap_or(u32::MAX));
                }
                // elements of an array are one number, which one of them does not set anew
                StatementKind::Assign {
                    name,
                    index,
                    component: Component::Whole,
                    ..
                } => {
                    let data = self.numbers_named(name, context);
                    if data.is_empty() {
                        let (at, mut site) = ((file, statement.offset), || blocks.site());
                        self.note_place(name, index, at, context, &mut site, &mut noted.places);
                    } else {
                        let bytes = self.assigned_bytes(file, statement.offset);
                        let written = Written::Text {
                            file,
                            bytes,
                            context,
                        };
                        let site = (index == Index::Whole).then(|| blocks.site());
                        for datum in data {
                            if site.is_none() {
                                noted.numbers.scatters(datum);
                            }
                            noted.numbers.write(datum, written, site.clone());
                        }
                    }
                }
                StatementKind::Assign { name, index, .. } => {
                    let (at, mut site) = ((file, statement.offset), || blocks.site());
                    self.note_place(name, index, at, context, &mut site, &mut noted.places);
                }
                StatementKind::Function(function) => {
                    let of = self.parsed.functions[function as usize];
                    let callee = Callee::Named(of.name);
                    let is_built_in = !self.is_routine(of.name, context);
                    if is_built_in {
                        self.function(&of, context, &mut noted);
                    } else {
                        let at = (file, statement.offset);
                        self.give(callee, (true, of.arguments), context, at, &mut noted);
                    }
                }
                StatementKind::Call(Called {
                    callee,
                    verb,
                    arguments,
                    ..
                }) => {
                    if matches!(callee, Callee::Late) || verb == Verb::CallByVar {
                        noted.numbers.calls_any();
                    }
                    let name = match callee {
                        Callee::Named(name) if self.is_routine(name, context) => None,
                        Callee::Named(name) => Some(name),
                        _ => None,
                    };
                    match (name, verb) {
                        (Some(name), Verb::Writes(_)) => {
                            let site = blocks.site();
                            let at = (arguments, context, file);
                            self.built_in(name, at, &site, &mut noted);
                        }
                        (Some(_), Verb::WritesTool) => {
                            self.lose_all(false, arguments, context, &mut noted);
                        }
                        (Some(_), Verb::WritesNamed) => {
                            for at in self.set_by_name(arguments, context, file) {
                                noted.numbers.give_up(self.number(at));
                                self.note_whole_place(at, Value::Unfollowed, &mut noted.places);
                            }
                        }
                        (None, _) | (_, Verb::Other | Verb::CallByVar) => {
                            let given = (false, arguments);
                            let at = (file, statement.offset);
                            self.give(callee, given, context, at, &mut noted);
                        }
                        _ => {}
                    }
                }
                StatementKind::Return(value) => {
                    let has_value = value != Expression::Nothing;
                    if let Some(routine) = context.routine.filter(|_| has_value) {
                        let written = Written::Text {
                            file,
                            bytes: self.given_back(file, statement.offset),
                            context,
                        };
                        noted.numbers.write(RESULT | routine, written, None);
                    }
                }
                StatementKind::If(_) | StatementKind::Test(_) => blocks.open(Some(1)),
                StatementKind::ElseIf(_) | StatementKind::Case(_) | StatementKind::Else => {
                    blocks.branch();
                }
                StatementKind::Loop { most, .. } => {
                    blocks.open(most);
                    let at = (file, statement.offset);
                    self.bound(at, context, blocks.last(), &mut noted.numbers);
                }
                StatementKind::EndChoice | StatementKind::EndLoop { .. } => blocks.close(),
                StatementKind::Goto(_)
                | StatementKind::Handler(_)
                | StatementKind::Retry { .. } => {
                    noted.numbers.jumps(context.routine.unwrap_or(u32::MAX));
                }
                _ => {}
            }
        }
        for &(name, context) in &self.parsed.results {
            self.lose(name, context, &mut noted);
        }
        let Noted {
            mut numbers,
            given,
            places,
        } = noted;
        // data without a value begin with 0; where nothing writes them nothing is meant by that
        for (number, site) in blank {
            if numbers.is_written(number) {
                numbers.write(number, Written::Zero, site);
            } else {
                numbers.lose(number);
            }
        }
        self.coordinates = self.coordinates(&places, &mut numbers);
        self.numbers = numbers;
        self.given = given;
    }

    /// Notes what numbers are declared with; those without a value are left.
    fn declared(&self, numbers: &mut Numbers<Written>) -> Vec<(u32, Option<Site>)> {
        let mut blank = Vec::new();
        for (at, datum) in (0..).zip(&self.parsed.data) {
            if datum.kind != Type::Num {
                continue;
            }
            let number = self.number(at);
            // data of a routine begin anew with it
            let routine = datum.context.routine;
            let routine = routine.filter(|_| datum.storage == Storage::Variable);
            let site = routine.map(Site::at_start);
            let value = self.parsed.values.get(&at).copied();
            let written = match (value, datum.storage) {
                (Some(bytes), _) => Written::Text {
                    file: datum.place.file,
                    bytes,
                    context: datum.context,
                },
                (None, Storage::Variable) => {
                    blank.push((number, site));
                    continue;
                }
                // what calls give it
                (None, Storage::Parameter { .. }) => continue,
                _ => {
                    numbers.lose(number);
                    continue;
                }
            };
            numbers.write(number, written, site);
        }
        blank
    }

    /// The data that a name may mean.
    pub(super) fn data_named(&self, name: Symbol, context: Context) -> Vec<u32> {
        match self.meaning(name, context) {
            Meaning::One(datum) => vec![datum],
            Meaning::Several(list) => self.several(list).to_vec(),
            Meaning::Nothing => Vec::new(),
        }
    }

    /// The numbers that a name may mean.
    pub(super) fn numbers_named(&self, name: Symbol, context: Context) -> Vec<u32> {
        let data = self.data_named(name, context).into_iter();
        let numbers = data.filter(|datum| self.datum(*datum).kind == Type::Num);
        numbers.map(|datum| self.number(datum)).collect()
    }

    /// The value of the assignment that begins there.
    pub(super) fn assigned_bytes(&self, file: u32, offset: u32) -> (u32, u32) {
        let text = &self.sources[file as usize].bytes[offset as usize..];
        let end = memchr::memchr(b';', text).unwrap_or(text.len());
        let start = memchr::memmem::find(&text[..end], b":=").map_or(end, |at| at + 2);
        let at = |by: usize| offset + crate::program::script::short(by);
        (at(start), at(end))
    }

    /// What stands behind the RETURN that begins there.
    fn given_back(&self, file: u32, offset: u32) -> (u32, u32) {
        let text = &self.sources[file as usize].bytes[offset as usize..];
        let end = memchr::memchr(b';', text).unwrap_or(text.len());
        let start = text.iter().take_while(|b| b.is_ascii_alphabetic()).count();
        let at = |by: usize| offset + crate::program::script::short(by);
        (at(start.min(end)), at(end))
    }

    /// The value of an argument: of `\h:=-200` what is behind the sign.
    pub(super) fn value_bytes(&self, file: u32, argument: &Argument) -> (u32, u32) {
        let (start, end) = argument.span;
        if argument.option.is_none() {
            return (start, end);
        }
        let text = &self.sources[file as usize].bytes[indices(argument.span)];
        let sign = memchr::memmem::find(text, b":=").map(|at| at + 2);
        let behind = crate::program::script::short(sign.unwrap_or(text.len()));
        (start + behind, end)
    }

    /// An instruction of the language that writes.
    fn built_in(
        &self,
        name: Symbol,
        (arguments, context, file): ((u32, u32), Context, u32),
        site: &Site,
        noted: &mut Noted,
    ) {
        let given = &self.parsed.arguments[indices(arguments)];
        let by = match self.spelling(name).to_ascii_lowercase().as_str() {
            "incr" => Some(Written::More(1.0)),
            "decr" => Some(Written::More(-1.0)),
            "clear" => Some(Written::Zero),
            // data of the text, by their name
            "getdataval" => Some(Written::Unfollowed),
            "add" => given.get(1).map(|argument| Written::Added {
                file,
                bytes: argument.span,
                context,
            }),
            _ => None,
        };
        let of = match by {
            Some(Written::Unfollowed) => given.last(),
            _ => given.first(),
        };
        let Some((by, of)) = by.zip(of) else {
            return self.lose_all(false, arguments, context, noted);
        };
        if let Some((name, index)) = self.place_of(&of.expression) {
            let sets_anew = matches!(by, Written::Zero);
            let site = (!sets_anew || index == Index::Whole).then_some(site);
            for number in self.numbers_named(name, context) {
                if index != Index::Whole {
                    noted.numbers.scatters(number);
                }
                noted.numbers.write(number, by, site.cloned());
            }
            for datum in self.data_named(name, context) {
                self.note_whole_place(datum, Value::Unfollowed, &mut noted.places);
            }
        }
    }

    /// A function of the language, or of no file, may write what it is given.
    fn function(&self, of: &Function, context: Context, noted: &mut Noted) {
        match self.known(of, context) {
            Known::Harmless | Known::Actual => {}
            Known::Writes(_) | Known::Other => {
                self.lose_all(true, of.arguments, context, noted);
            }
        }
    }

    /// All arguments may be written.
    fn lose_all(
        &self,
        of_function: bool,
        arguments: (u32, u32),
        context: Context,
        noted: &mut Noted,
    ) {
        for argument in &self.list(of_function)[indices(arguments)] {
            if let Some((name, _)) = self.place_of(&argument.expression) {
                self.lose(name, context, noted);
            }
        }
    }

    /// What only the running program knows is written into data.
    fn lose(&self, name: Symbol, context: Context, noted: &mut Noted) {
        for number in self.numbers_named(name, context) {
            noted.numbers.lose(number);
        }
        for datum in self.data_named(name, context) {
            self.note_whole_place(datum, Value::Lost, &mut noted.places);
        }
    }

    /// A routine has what it is given, and may write that by reference.
    fn give(
        &self,
        callee: Callee,
        (of_function, arguments): (bool, (u32, u32)),
        context: Context,
        (file, offset): (u32, u32),
        noted: &mut Noted,
    ) {
        let call = (context.routine.unwrap_or(u32::MAX), offset);
        let callees = self.callees(callee, arguments, context, file);
        if callees.foreign {
            self.lose_all(of_function, arguments, context, noted);
        }
        let given = &self.list(of_function)[indices(arguments)];
        let Noted {
            numbers,
            given: by_call,
            places,
        } = noted;
        for &routine in &callees.routines {
            numbers.calls(context.routine.unwrap_or(u32::MAX), routine);
            for (datum, argument) in self.parameters(routine, given) {
                let Some(argument) = argument else { continue };
                let bytes = self.value_bytes(file, argument);
                let site = Site::at_start(routine);
                let value = Value::Text(file, bytes, context, Some(site.clone()));
                self.note_whole_place(datum, value, places);
                let is_number = self.datum(datum).kind == Type::Num;
                let place = self.place_of(&argument.expression);
                let Some((name, _)) = place.filter(|_| self.is_written_back(datum)) else {
                    if is_number {
                        let written = Written::Text {
                            file,
                            bytes,
                            context,
                        };
                        by_call.note(routine, call, self.number(datum), written);
                        numbers.write(self.number(datum), written, Some(site));
                    }
                    continue;
                };
                for back in self.data_named(name, context) {
                    self.note_whole_place(back, Value::Unfollowed, places);
                }
                match *self.numbers_named(name, context) {
                    [number] if is_number => numbers.unite(number, self.number(datum)),
                    ref several => {
                        for number in several {
                            numbers.give_up(*number);
                        }
                        if is_number {
                            numbers.give_up(self.number(datum));
                        }
                    }
                }
            }
        }
    }

    /// The value of an expression at a place; `own` gives that of operands that are no names.
    pub(super) fn quantity(
        &self,
        text: &[u8],
        at: Place,
        context: Context,
        own: &mut dyn FnMut(&[u8]) -> Option<Quantity>,
    ) -> Quantity {
        let here = (context.routine.unwrap_or(u32::MAX), at.offset);
        let of = &mut |number| self.value_at(number, here, &mut |other| self.whenever(other));
        self.evaluated(text, at, context, of, own)
    }

    pub(super) fn written_value(
        &self,
        what: Written,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        match what {
            Written::Zero => Quantity::exactly(0.0),
            Written::Unfollowed => Quantity::endless(),
            Written::Coordinate {
                file,
                bytes,
                context,
                axis,
            } => {
                let text = self.sources[file as usize].bytes[indices(bytes)].trim_ascii();
                let text = [text, [&b".x"[..], b".y", b".z"][axis]].concat();
                let at = Place::new(file, bytes.0);
                self.evaluated(&text, at, context, of, &mut |_| None)
            }
            Written::More(by) => Quantity::own().plus(Quantity::exactly(by)),
            Written::Text {
                file,
                bytes,
                context,
            }
            | Written::Added {
                file,
                bytes,
                context,
            } => {
                let text = &self.sources[file as usize].bytes[indices(bytes)];
                let at = Place {
                    file,
                    offset: bytes.0,
                };
                let value = self.evaluated(text, at, context, of, &mut |_| None);
                if matches!(what, Written::Added { .. }) {
                    return Quantity::own().plus(value);
                }
                value
            }
        }
    }

    pub(super) fn evaluated(
        &self,
        text: &[u8],
        at: Place,
        context: Context,
        of: &mut dyn FnMut(u32) -> Quantity,
        own: &mut dyn FnMut(&[u8]) -> Option<Quantity>,
    ) -> Quantity {
        evaluated(Arithmetic::Real, text, &mut |operand| match operand {
            Operand::Name(name) => Some(self.named(name, at, context, of)),
            Operand::Other(operand) => own(operand).or_else(|| self.operand(operand, context, of)),
        })
    }

    /// The value of a name.
    fn named(
        &self,
        name: &[u8],
        at: Place,
        context: Context,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        let Some(name) = self.parsed.symbols.find(name) else {
            return Quantity::unknown();
        };
        if let Some(counting) = self.parsed.counting(name, at) {
            return self.counted(counting, of);
        }
        match *self.numbers_named(name, context) {
            [number] => of(number),
            // a signal, or what other files declare
            [] if self.meaning(name, context) == Meaning::Nothing => Quantity::unknown(),
            [] => Quantity::endless(),
            ref several => {
                let all: Vec<_> = several.iter().map(|number| of(*number)).collect();
                Quantity::any(&all)
            }
        }
    }

    /// The value of an operand that is no name alone: what a function gives, or a component; `None`
    /// where it is worked out of the numbers in it.
    fn operand(
        &self,
        operand: &[u8],
        context: Context,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Option<Quantity> {
        let length = operand.iter().take_while(|b| is_letter(**b)).count();
        let (name, rest) = operand.split_at(length);
        let sign = *rest.trim_ascii_start().first()?;
        let spelling = String::from_utf8_lossy(name).to_ascii_lowercase();
        let Some(name) = self.parsed.symbols.find(name) else {
            // a function of the language is no name of the text
            let is_known = sign == b'(' && builtins::is_worked_out(&spelling);
            let is_actual = sign == b'(' && builtins::function(&spelling) == Known::Actual;
            return match (is_known, is_actual) {
                (true, _) => None,
                // where the robot is may be anywhere
                (_, true) => Some(Quantity::endless()),
                _ => Some(Quantity::unknown()),
            };
        };
        if sign == b'(' && spelling == "dim" {
            let (size, file) = self.dimension(operand, context)?;
            let at = Place::new(file, 0);
            return Some(self.evaluated(size, at, context, of, &mut |_| None));
        }
        if sign == b'(' {
            return match self.function_of(name, context) {
                Some(routine) => Some(of(RESULT | routine)),
                None if self.is_routine(name, context)
                    || self.known_function(name, context) == Known::Actual =>
                {
                    Some(Quantity::endless())
                }
                None => (!builtins::is_worked_out(&spelling)).then(Quantity::unknown),
            };
        }
        let data = match self.meaning(name, context) {
            Meaning::Nothing => return Some(Quantity::unknown()),
            Meaning::One(datum) if rest.contains(&b'.') => datum,
            _ => return None,
        };
        let coordinate = axis_of(rest).map(|axis| (self.number(data), axis));
        if let Some(number) = coordinate.and_then(|key| self.coordinates.get(&key)) {
            return Some(of(*number));
        }
        // another task may write what is shared
        if self.is_written(Entity::Declared(data)) || self.group_of(data).is_some() {
            return Some(Quantity::endless());
        }
        let kept = [&b".trans.x"[..], b".trans.y", b".trans.z"];
        let axis = (0..)
            .zip(kept)
            .find(|(_, axis)| rest.eq_ignore_ascii_case(axis));
        let number = axis.and_then(|(axis, _)| self.coordinate(data, axis));
        Some(number.unwrap_or_else(Quantity::endless))
    }

    /// What a FOR loop counts with.
    fn counted(&self, counting: &Counting, of: &mut dyn FnMut(u32) -> Quantity) -> Quantity {
        let bytes = &self.sources[counting.file as usize].bytes;
        let text = bytes[indices(counting.range)].to_ascii_lowercase();
        let mut value = |from: &str, to: &[&str]| {
            let start = word(&text, from)? + from.len();
            let rest = &text[start..];
            let end = to
                .iter()
                .find_map(|to| word(rest, to))
                .unwrap_or(rest.len());
            let at = Place {
                file: counting.file,
                offset: counting.range.0,
            };
            Some(self.evaluated(&rest[..end], at, counting.context, of, &mut |_| None))
        };
        let from = value("from", &["to"]);
        let (Some(from), Some(to)) = (from, value("to", &["step", "do"])) else {
            return Quantity::unknown();
        };
        let step = value("step", &["do"]);
        counted(&from, &to, step)
    }
}
