//! Calls: routines of the files with their parameters, others, and instructions that write their
//! arguments.

use super::builtins::Known;
use super::resolved::{Callees, Entity, named};
use super::syntax::{Argument, Base, Callee, Expression, Index, Part, Path, Type, Verb, indices};
use super::translate::Translator;
use crate::program::names::{Meaning, Symbol};
use crate::program::script::{self, Call, Expr, Held, How, Place, VariableId, Written, short};

/// An instruction that is not known but has a target and a tool moves like the ones that are.
const UNKNOWN_MOVE: Verb = Verb::Move {
    path: Path::Linear,
    first: 0,
    tool_inside: false,
};

impl Translator<'_> {
    /// An instruction or a procedure call.
    pub(super) fn call(&mut self, callee: Callee, verb: Verb, arguments: Part, end: u32) {
        let resolved = self.resolved;
        let all = &resolved.parsed.arguments[indices(arguments)];
        match self.meant(callee, verb, arguments) {
            Verb::Mode(mode, set) => self.mode(mode, set, arguments),
            Verb::Wander { back } => self.wander(back, end),
            Verb::GripLoad => self.grip_load(arguments),
            Verb::Writes(position) => {
                let mut positional = all.iter().filter(|argument| argument.option.is_none());
                if let Some(argument) = positional.nth(usize::from(position)) {
                    self.becomes_unknown(argument);
                }
            }
            Verb::WritesTool => {
                for argument in all {
                    if self.is_tool(argument) {
                        self.becomes_unknown(argument);
                    }
                }
            }
            Verb::WritesNamed => self.writes_named(all),
            verb @ Verb::Move { .. } => self.go(verb, arguments, end),
            Verb::CallByVar => {
                let callees = match all.first().map(|argument| argument.expression) {
                    Some(Expression::Text(start, end)) => {
                        let bytes = &resolved.sources[self.here.file as usize].bytes;
                        let prefix = &bytes[start as usize..end as usize];
                        resolved.any_routine((0, 0), &crate::program::Source::text(prefix))
                    }
                    _ => resolved.any_routine((0, 0), ""),
                };
                self.goes_to(&callees, &[], "CallByVar".into());
            }
            Verb::Harmless | Verb::Other => {
                let callees = resolved.callees(callee, arguments, self.context, self.here.file);
                let name = match callee {
                    Callee::Named(name) => resolved.spelling(name).into(),
                    Callee::Text(..) | Callee::Late => "a late-bound call".into(),
                };
                self.goes_to(&callees, all, name);
            }
        }
    }

    /// What an instruction does where the files do not declare a routine of its name.
    pub(super) fn meant(&self, callee: Callee, verb: Verb, arguments: Part) -> Verb {
        let Callee::Named(name) = callee else {
            return verb;
        };
        match verb {
            _ if self.resolved.is_routine(name, self.context) => Verb::Other,
            Verb::Other if self.is_like_move(arguments) => UNKNOWN_MOVE,
            _ => verb,
        }
    }

    fn is_like_move(&self, arguments: Part) -> bool {
        let all = &self.resolved.parsed.arguments[indices(arguments)];
        let wobj = self.words.wobj;
        let is_frame = |argument: &Argument| {
            wobj.is_some() && argument.option == wobj || self.is_tool(argument)
        };
        all.iter().any(is_frame) && all.iter().any(|argument| self.leads_to_target(argument))
    }

    /// Whether an argument gives a target away.
    fn leads_to_target(&self, argument: &Argument) -> bool {
        let resolved = self.resolved;
        let is_target = |name: Symbol| {
            resolved
                .kind(name, self.context)
                .is_some_and(Type::is_target)
        };
        match argument.expression {
            Expression::Point { base, .. } => match base {
                Base::Target(_) => true,
                Base::Named { name, .. } => is_target(name),
                Base::Function(_) => false,
            },
            Expression::Member { name, .. } => is_target(name),
            Expression::Composed(_) | Expression::List(_) | Expression::Computed(_) => resolved
                .parsed
                .names_in(&argument.expression)
                .iter()
                .any(|&name| is_target(name)),
            Expression::Nothing | Expression::Text(..) | Expression::Load(_) => false,
        }
    }

    /// Names that an instruction uses as targets or frames.
    pub(super) fn wants(&self, callee: Callee, verb: Verb, arguments: Part) -> Vec<(Symbol, Type)> {
        let all = &self.resolved.parsed.arguments[indices(arguments)];
        match self.meant(callee, verb, arguments) {
            Verb::Move {
                path,
                first,
                tool_inside,
            } => self.wants_of_move(all, path, first, tool_inside),
            Verb::Other => {
                let callees =
                    self.resolved
                        .callees(callee, arguments, self.context, self.here.file);
                let mut wants = Vec::new();
                for routine in callees.routines {
                    for (datum, argument) in self.resolved.parameters(routine, all) {
                        let kind = self.resolved.datum(datum).kind;
                        if kind.is_target() || kind.is_frame() {
                            let name = argument.and_then(|argument| named(&argument.expression));
                            wants.extend(name.map(|name| (name, kind)));
                        }
                    }
                }
                wants
            }
            _ => Vec::new(),
        }
    }

    /// A function that the present statement calls; the last of them where `is_last`.
    pub(super) fn function(&mut self, function: u32, is_last: bool) {
        let resolved = self.resolved;
        let of = resolved.parsed.functions[function as usize];
        let all = &resolved.parsed.given[indices(of.arguments)];
        self.here.offset = of.offset;
        if let Known::Writes(position) = resolved.known(&of, self.context) {
            let mut positional = all.iter().filter(|argument| argument.option.is_none());
            if let Some(argument) = positional.nth(usize::from(position)) {
                self.becomes_unknown(argument);
            }
            return;
        }
        let callee = Callee::Named(of.name);
        let callees = resolved.callees(callee, of.arguments, self.context, self.here.file);
        self.goes_to(&callees, all, resolved.spelling(of.name).into());
        // the next call of it writes over what it gives
        if !is_last && let Some(result) = self.result_of(function) {
            let apart = self.temporary(resolved.spelling(of.name), Expr::Absent);
            self.set(apart, Expr::Variable(result));
            self.kept_results.insert(function, apart);
        }
    }

    /// The variable that holds what a function of the files gives; `None` where it gives no target
    /// or frame.
    pub(super) fn result_of(&mut self, function: u32) -> Option<VariableId> {
        if let Some(&apart) = self.kept_results.get(&function) {
            return Some(apart);
        }
        let of = self.resolved.parsed.functions[function as usize];
        let callee = Callee::Named(of.name);
        let callees = self
            .resolved
            .callees(callee, of.arguments, self.context, self.here.file);
        let [routine] = callees.routines[..] else {
            return None;
        };
        let gives = self.resolved.parsed.routines[routine as usize].gives;
        (gives.is_target() || gives.is_frame()).then(|| self.result(routine))
    }

    /// A call of routines with arguments.
    fn goes_to(&mut self, callees: &Callees, all: &[Argument], name: Box<str>) {
        let mut given = Vec::new();
        for &routine in &callees.routines {
            self.bind(routine, all, &mut given);
        }
        if callees.foreign {
            self.give_away(all, &mut given);
            // a routine that is not in the files and gets nothing changes nothing that is known
            if callees.routines.is_empty() && given.is_empty() {
                return;
            }
        }
        let arguments = self.builder.script.give(given);
        self.emit_call(Call {
            place: self.here,
            callees: callees.routines.clone().into(),
            foreign: callees.foreign,
            leads: false,
            name,
            arguments,
        });
        for &routine in &callees.routines {
            self.written_back(routine, all);
        }
    }

    /// What the parameters of a routine are given.
    fn bind(&mut self, routine: u32, all: &[Argument], given: &mut Vec<script::Argument>) {
        let resolved = self.resolved;
        for (datum, argument) in resolved.parameters(routine, all) {
            let parameter = *resolved.datum(datum);
            let kind = parameter.kind;
            if let Some(presence) = self.presence(routine, parameter.name) {
                let value = self.is_given(argument);
                given.push(script::Argument::new(Some(presence), value, None));
            }
            if !kind.is_target() && !kind.is_frame() {
                continue;
            }
            let variable = self.parameter(datum);
            let value = match argument {
                None if self.is_left_out(routine, datum) => Expr::Value(self.wobj0),
                None => self.unknown(kind),
                Some(argument) if kind.is_frame() => self.frame_from(argument.expression),
                Some(argument) => self.position_from(argument.expression, kind),
            };
            let back = match (value, argument) {
                (Expr::Variable(variable), Some(argument))
                    if resolved.is_written_back(datum)
                        && (kind.is_frame() || self.is_one_of(argument)) =>
                {
                    Some(variable)
                }
                _ => None,
            };
            given.push(script::Argument::new(Some(variable), value, back));
        }
    }

    /// Whether a call gives an optional parameter: one that is handed on (`\\name?own`) is given
    /// where the caller was given it.
    fn is_given(&mut self, argument: Option<&Argument>) -> Expr {
        let bytes = &self.resolved.sources[self.here.file as usize].bytes;
        let text = argument.map_or(&b""[..], |argument| {
            &bytes[argument.span.0 as usize..argument.span.1 as usize]
        });
        if !text.contains(&b'?') {
            return Expr::Value(self.builder.script.value(Held::Flag(argument.is_some())));
        }
        let own = argument.and_then(|argument| named(&argument.expression));
        let own = own.zip(self.context.routine);
        let presence = own.and_then(|(name, caller)| self.presence(caller, name));
        presence.map_or(Expr::Absent, Expr::Variable)
    }

    /// Whether a work object that is not given is one that moves leave out, too (`\WObj?name`):
    /// these are in wobj0.
    fn is_left_out(&self, routine: u32, parameter: u32) -> bool {
        let of = self.resolved.datum(parameter);
        of.kind == Type::Wobjdata && self.resolved.parsed.if_given.contains(&(routine, of.name))
    }

    /// The variable of a parameter.
    fn parameter(&mut self, datum: u32) -> VariableId {
        let entity = Entity::Declared(datum);
        if let Some(&known) = self.variables.get(&(entity, 0)) {
            return known;
        }
        let kind = self.resolved.datum(datum).kind;
        let holds = self.unknown(kind);
        self.variable(entity, 0, holds)
    }

    fn unknown(&mut self, kind: Type) -> Expr {
        if kind.is_frame() {
            self.frame_chosen()
        } else {
            self.computed()
        }
    }

    /// What a routine gets that is not in the files.
    fn give_away(&mut self, all: &[Argument], given: &mut Vec<script::Argument>) {
        for argument in all {
            let frame = match argument.expression {
                Expression::Point {
                    base: Base::Named { name, index },
                    steps: (a, b),
                } if a == b
                    && self
                        .resolved
                        .kind(name, self.context)
                        .or_else(|| self.wanted.get(&name).copied())
                        .is_some_and(Type::is_frame) =>
                {
                    Some(self.frame(name, self.resolved.parsed.index(index)))
                }
                _ => None,
            };
            let value = match frame {
                Some(value) => value,
                None if self.leads_to_target(argument) => match argument.expression {
                    Expression::Member { name, index } => {
                        let index = self.resolved.parsed.index(index);
                        self.position(name, index, Type::Robtarget)
                    }
                    expression => self.position_from(expression, Type::Robtarget),
                },
                None => continue,
            };
            let back = match value {
                Expr::Variable(variable) => Some(variable),
                _ => None,
            };
            if frame.is_none() || back.is_some() {
                given.push(script::Argument::new(None, value, back));
            }
        }
    }

    /// Whether an argument is a variable of its own, which a routine may write as a whole.
    fn is_one_of(&self, argument: &Argument) -> bool {
        let Some((name, index)) = self.resolved.place_of(&argument.expression) else {
            return true;
        };
        match self.resolved.meaning(name, self.context) {
            Meaning::One(datum) => self.is_one(Entity::Declared(datum), index),
            Meaning::Nothing => self.is_one(Entity::Undeclared(name), index),
            Meaning::Several(_) => false,
        }
    }

    /// What a routine writes through its parameters besides variables that it is given as a whole:
    /// parts of data, and elements that only the running program knows.
    fn written_back(&mut self, routine: u32, all: &[Argument]) {
        let resolved = self.resolved;
        for (datum, argument) in resolved.parameters(routine, all) {
            let Some(argument) = argument else {
                continue;
            };
            if !resolved.is_written_back(datum) {
                continue;
            }
            if matches!(argument.expression, Expression::Member { .. }) {
                let is_own = resolved.is_derived_datum(datum);
                let part = How::part(is_own, false, self.changed());
                self.write_argument(argument, part);
            }
            if !resolved.datum(datum).kind.is_target() || self.is_one_of(argument) {
                continue;
            }
            let Some((name, index)) = resolved.place_of(&argument.expression) else {
                continue;
            };
            let whole = Expr::Variable(self.parameter(datum));
            for variable in self.written(name, index) {
                let part = resolved.is_in_parts(datum).then(|| self.changed());
                let part = part.map(How::PartSomehow);
                for how in part.into_iter().chain([How::Whole(whole)]) {
                    let place = self.here;
                    self.emit_write(place, variable, how);
                }
            }
        }
    }

    /// An instruction writes its argument.
    fn becomes_unknown(&mut self, argument: &Argument) {
        let kind =
            named(&argument.expression).and_then(|name| self.resolved.kind(name, self.context));
        let value = self.unknown(kind.unwrap_or(Type::Robtarget));
        let value = if kind.is_some_and(Type::is_frame) {
            self.frame_assigned()
        } else {
            value
        };
        self.write_argument(argument, How::Whole(value));
    }

    /// `SetDataVal`, `SetAllDataVal`: writes data whose names or types it is given.
    fn writes_named(&mut self, all: &[Argument]) {
        let resolved = self.resolved;
        let text = all.iter().find_map(|argument| match argument.expression {
            Expression::Text(start, end) => Some((start as usize, end as usize)),
            _ => None,
        });
        let bytes = &resolved.sources[self.here.file as usize].bytes;
        let text = text.map(|(start, end)| bytes[start..end].to_ascii_lowercase());
        for at in 0..short(resolved.parsed.data.len()) {
            let datum = resolved.datum(at);
            if !resolved.is_written(Entity::Declared(at)) || datum.context.routine.is_some() {
                continue;
            }
            let name = resolved
                .spelling(datum.name)
                .as_bytes()
                .to_ascii_lowercase();
            let names_type = text
                .as_ref()
                .is_some_and(|text| Type::named(text) != Type::Other);
            let meant = match &text {
                Some(text) if names_type => Type::named(text) == datum.kind,
                Some(text) => *text == name,
                None => true,
            };
            if !meant {
                continue;
            }
            let value = if datum.kind.is_target() {
                self.position_of_datum(at, Index::Whole)
            } else {
                continue;
            };
            let how = How::PartSomehow(self.changed());
            let variable = match value {
                Expr::Variable(variable) => Written::One(variable),
                Expr::Any { .. } => Written::AnyOf(self.table(Entity::Declared(at))),
                _ => continue,
            };
            let place: Place = self.here;
            self.emit_write(place, variable, how);
        }
    }
}
