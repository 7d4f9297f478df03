//! Calls: routines of the files with their parameters, others, and instructions that write their
//! arguments.

use super::builtins::Known;
use super::moves::plain;
use super::resolved::{Callees, Entity, Resolved, named};
use super::syntax::{Argument, Base, Callee, Expression, Index, Part, Path, Type, Verb, indices};
use super::translate::Translator;
use super::verbs::Led;
use crate::program::names::Symbol;
use crate::program::notation::mentions;
use crate::program::script::{self, Call, Expr, Held, How, Remark, VariableId};
use foldhash::HashSet;

/// How a routine that is not in the files is taken to move.
const UNKNOWN_MOVE: Verb = Verb::Move {
    path: Path::Linear,
    led: Led::Alone,
    tool_inside: false,
};

/// Instructions of ABB's options that move with the tool that they are given, as all that move do.
///
/// # Source
/// ABB, Application manual - Arc and Arc Sensor: `SmarTac` and multi-pass welding.
fn only_reads_tools(routine: &str) -> bool {
    let lower = routine.to_ascii_lowercase();
    matches!(
        &*lower,
        "search_1d" | "search_part" | "search_groove" | "arcrepl"
    )
}

impl Translator<'_> {
    /// An instruction or a procedure call.
    pub(super) fn call(&mut self, callee: Callee, verb: Verb, arguments: Part, end: u32) {
        let resolved = self.resolved;
        let all = &resolved.parsed.arguments[indices(arguments)];
        let meant = self.meant(callee, verb, arguments);
        if meant != verb
            && matches!(meant, Verb::Move { .. })
            && let Callee::Named(name) = callee
        {
            self.assume_move(name);
        }
        match meant {
            Verb::Mode(mode, set) => self.mode(mode, set, arguments),
            Verb::Wander { back } => self.wander(back, end),
            Verb::Yields { begins } => self.yields(callee, begins),
            Verb::ClearsPath => self.clear_path(),
            Verb::GripLoad => self.grip_load(arguments),
            Verb::Writes(position) => {
                let mut positional = all.iter().filter(|argument| argument.option.is_none());
                if let Some(argument) = positional.nth(usize::from(position)) {
                    match self.grown(callee, all) {
                        Some(how) => self.write_argument(argument, how),
                        None => self.becomes_unknown(argument),
                    }
                }
            }
            Verb::WritesTool => {
                for argument in all {
                    if self.is_tool(argument) {
                        self.becomes_unknown(argument);
                    }
                }
            }
            Verb::WritesNamed => self.writes_named(arguments),
            verb @ Verb::Move { .. } => self.go(callee, verb, arguments, end),
            Verb::CallByVar => {
                let callees = match all.first().map(|argument| argument.expression) {
                    Some(Expression::Text(start, end)) => {
                        let bytes = &resolved.sources[self.here.file as usize].bytes;
                        let prefix = &bytes[start as usize..end as usize];
                        resolved.any_routine((0, 0), &crate::program::Source::text(prefix))
                    }
                    _ => resolved.any_routine((0, 0), ""),
                };
                self.goes_to(&callees, &[], "CallByVar".into(), true);
            }
            Verb::Harmless | Verb::Other => {
                let callees = resolved.callees(callee, arguments, self.context, self.here.file);
                let name = match callee {
                    Callee::Named(name) => resolved.spelling(name).into(),
                    Callee::Text(..) | Callee::Late => "a late-bound call".into(),
                };
                self.goes_to(&callees, all, name, matches!(verb, Verb::Other));
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

    /// Whether arguments are those of a move, in their order: one target, speed and what else is no
    /// position, one tool, and no other tool or work object than `\WObj`.
    fn is_like_move(&self, arguments: Part) -> bool {
        let all = &self.resolved.parsed.arguments[indices(arguments)];
        let (options, positional): (Vec<_>, Vec<_>) =
            all.iter().partition(|argument| argument.option.is_some());
        let [target, between @ .., tool] = &positional[..] else {
            return false;
        };
        let is_wobj = |argument: &&&Argument| argument.option == self.words.wobj;
        let has_wobj = options.iter().any(|argument| is_wobj(&argument));
        let is_undeclared =
            || plain(tool).is_some_and(|name| self.resolved.kind(name, self.context).is_none());
        let others = options.iter().filter(|argument| !is_wobj(argument));
        let mut others = others.chain(between);
        !between.is_empty()
            && self.leads_to_target(target)
            && (self.is_tool(tool) || has_wobj && is_undeclared())
            && !others.any(|other| self.leads_to_target(other) || self.frame_given(other).is_some())
    }

    /// The tool or work object that an argument is, or a part of which it is.
    fn frame_given(&self, argument: &Argument) -> Option<(Symbol, Index)> {
        let (name, index) = self.resolved.place_of(&argument.expression)?;
        let kind = self.resolved.kind(name, self.context);
        let kind = kind.or_else(|| self.wanted.get(&name).copied())?;
        kind.is_frame().then_some((name, index))
    }

    /// Says once of a routine that is not in the files that its calls are taken for moves.
    fn assume_move(&mut self, name: Symbol) {
        if self.remarks.contains_key(&("move-assumed", name)) {
            return;
        }
        let remark = self.remark(name, |name| {
            Remark::warning_about(
                "move-assumed",
                format!(
                    "{name} is not in the files: it is taken to move straight to the target that it \
                     is given, with the tool and the work object of the call (wobj0 where it names \
                     none), to go nowhere else and to change nothing"
                ),
                "give the module that declares it, too",
            )
        });
        let remark = self.builder.script.remarks[remark as usize].clone();
        self.say(remark);
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
                led,
                tool_inside,
            } => self.wants_of_move(all, path, led, tool_inside),
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
        self.goes_to(&callees, all, resolved.spelling(of.name).into(), false);
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

    /// The trap of this name may run from here on.
    pub(super) fn connect(&mut self, trap: Symbol) {
        let callee = Callee::Named(trap);
        let callees = self
            .resolved
            .callees(callee, (0, 0), self.context, self.here.file);
        let name = self.resolved.spelling(trap);
        let call = Call::of(self.here, callees.routines.into(), name, 0..0);
        self.builder.start(call, true);
    }

    /// A call of routines with arguments.
    fn goes_to(&mut self, callees: &Callees, all: &[Argument], name: Box<str>, leads: bool) {
        let mut given = Vec::new();
        for &routine in &callees.routines {
            self.bind(routine, all, &mut given);
        }
        if callees.foreign {
            self.give_away(all, &mut given);
        }
        let is_foreign = callees.routines.is_empty();
        if is_foreign {
            self.frames_unknown(&name, all);
        }
        // a routine that is not in the files and gets nothing changes nothing that is known
        if is_foreign && given.is_empty() && !leads {
            return;
        }
        for &routine in &callees.routines {
            self.meet_again(routine, all);
        }
        let arguments = self.builder.script.give(given);
        self.emit_call(Call {
            place: self.here,
            callees: callees.routines.clone().into(),
            foreign: callees.foreign,
            leads: leads && is_foreign,
            writes_only: false,
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
            if let Some((choice, value)) = self.choice_given(datum, argument) {
                given.push(script::Argument::new(Some(choice), value, None));
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
                    if self.is_shared(datum, argument)
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

    /// The positions that a routine gets that is not in the files.
    fn give_away(&mut self, all: &[Argument], given: &mut Vec<script::Argument>) {
        for argument in all {
            if !self.leads_to_target(argument) {
                continue;
            }
            let value = match argument.expression {
                Expression::Member { name, index } => {
                    let index = self.resolved.parsed.index(index);
                    self.position(name, index, Type::Robtarget)
                }
                expression => self.position_from(expression, Type::Robtarget),
            };
            given.push(script::Argument::new(None, value, value.variable()));
        }
    }

    /// A routine that is not in the files may write the tools and work objects that it is given, or
    /// parts of which it is given.
    fn frames_unknown(&mut self, routine: &str, all: &[Argument]) {
        for argument in all {
            let Some((name, index)) = self.frame_given(argument) else {
                continue;
            };
            let spelled = self.resolved.spelling(name).to_ascii_lowercase();
            // the controller's own are constant
            if matches!(&*spelled, "tool0" | "wobj0") || only_reads_tools(routine) {
                continue;
            }
            let value = self.builder.script.unknown(Remark::error_about(
                "frame-chosen-at-run-time",
                format!(
                    "{routine}, which is not in the files, is given {} and may write it",
                    self.resolved.spelling(name)
                ),
                "give the module that declares it, too, or give it a copy",
            ));
            for variable in self.written(name, index) {
                self.emit_write(self.here, variable, How::Whole(value));
            }
        }
    }

    /// Whether a parameter is by reference and written, or what it is given is: by its own name, or
    /// through another parameter.
    fn is_shared(&self, parameter: u32, argument: &Argument) -> bool {
        let resolved = self.resolved;
        let given = || {
            let (name, _) = resolved.place_of(&argument.expression)?;
            resolved.entity_of(name, self.context)
        };
        resolved.is_written_back(parameter)
            || resolved.is_by_reference(parameter)
                && given().is_some_and(|entity| {
                    // the variable of a caller's caller may be
                    let is_handed_on = matches!(entity, Entity::Declared(datum)
                        if resolved.is_by_reference(datum));
                    is_handed_on || resolved.is_written(entity)
                })
    }

    /// A routine that is given a whole array by reference meets it again where it names it itself, or
    /// a routine that it calls does: what either name writes is not followed into the other.
    fn meet_again(&mut self, routine: u32, all: &[Argument]) {
        let resolved = self.resolved;
        for (datum, argument) in resolved.parameters(routine, all) {
            let given = argument.filter(|argument| {
                let is_target = resolved.datum(datum).kind.is_target();
                is_target && resolved.is_by_reference(datum) && !self.is_one_of(argument)
            });
            let Some((name, Index::Whole)) =
                given.and_then(|given| resolved.place_of(&given.expression))
            else {
                continue;
            };
            let entity = resolved.entity_of(name, self.context);
            // the parameter hides it
            if resolved.datum(datum).name == name {
                continue;
            }
            let is_written = resolved.is_written(Entity::Declared(datum))
                || entity.is_some_and(|entity| resolved.is_written(entity));
            if is_written && resolved.names_within(routine, name) {
                let how = How::PartSomehow(self.changed());
                for variable in self.written(name, Index::Whole) {
                    self.emit_write(self.here, variable, how.clone());
                }
            }
        }
    }

    /// Whether an argument is a variable of its own, which a routine may write as a whole.
    fn is_one_of(&self, argument: &Argument) -> bool {
        let Some((name, index)) = self.resolved.place_of(&argument.expression) else {
            return true;
        };
        let entity = self.resolved.entity_of(name, self.context);
        entity.is_some_and(|entity| self.is_one(entity, index))
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
}

impl Resolved<'_> {
    /// Whether the text of a routine has a name, or that of one whose name it has.
    fn names_within(&self, routine: u32, name: Symbol) -> bool {
        let routines = &self.parsed.routines;
        let text_of = |routine: u32| {
            let place = routines[routine as usize].place;
            let bytes = &self.sources[place.file as usize].bytes;
            let behind = routines.iter().map(|other| other.place);
            let behind = behind.filter(|other| other.file == place.file && *other > place);
            let end = behind.map(|other| other.offset as usize).min();
            bytes[place.offset as usize..end.unwrap_or(bytes.len())].to_ascii_lowercase()
        };
        let small = |name: Symbol| self.spelling(name).to_ascii_lowercase().into_bytes();
        let (mut open, mut known) = (vec![routine], HashSet::from_iter([routine]));
        while let Some(routine) = open.pop() {
            let text = text_of(routine);
            if mentions(&text, &small(name)) {
                return true;
            }
            let called = (0..).zip(routines).map(|(at, other)| (at, other.name));
            let called =
                called.filter(|(at, other)| !known.contains(at) && mentions(&text, &small(*other)));
            let called: Vec<u32> = called.map(|(at, _)| at).collect();
            known.extend(&called);
            open.extend(called);
        }
        false
    }
}
