//! Names resolved over all files: data, routines, and what may be written.

use super::builtins::Known;
use super::derived::Holder;
use super::numbers::Written;
use super::places::Coordinates;
use super::shared::Group;
use super::syntax::{
    Argument, Assigned, Base, Callee, Component, Datum, Expression, Function, Index, Parsed, Part,
    StatementKind, Storage, Stored, Type, Verb, indices,
};
use super::verbs::{Led, Verbs};
use crate::program::Source;
use crate::program::contexts::Given as GivenNumbers;
use crate::program::names::{Context, Meaning, Scopes, Symbol};
use crate::program::numbers::Numbers;
use crate::program::script::short;
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// All that was noted, with its names resolved.
pub(super) struct Resolved<'a> {
    pub parsed: Parsed,
    pub sources: &'a [Source],
    data: Scopes,
    routines: Scopes,
    /// What functions do, by symbol.
    verbs: Verbs,
    /// Data that statements may write, by datum.
    written: Vec<bool>,
    /// The same of names that the files do not declare.
    undeclared: HashSet<Symbol>,
    /// Data that are written at an index that is not constant, or as a whole.
    scattered: HashSet<Entity>,
    /// Arrays without values that routines of the files fill.
    filled: HashSet<u32>,
    /// Data a part of which is written, such as `p.trans`.
    in_parts: HashSet<u32>,
    /// Data that something else than where the robot stands is written into.
    otherwise: HashSet<u32>,
    /// Data and functions that are no targets, whose numbers all come from targets.
    pub(super) derived: HashSet<Holder>,
    /// What is written into numbers.
    pub(super) numbers: Numbers<Written>,
    /// What calls give to them.
    pub(super) given: GivenNumbers<Written>,
    /// What the coordinates of `pos` data are called in the numbers.
    pub(super) coordinates: Coordinates,
    /// The group of each datum that tasks share, and whether its declarations are alike.
    shared: HashMap<u32, (usize, bool)>,
    /// Routines whose names stand in late-bound calls.
    late_bound: HashSet<u32>,
}

/// Data: a declaration, or a name that the files do not declare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Entity {
    Declared(u32),
    Undeclared(Symbol),
}

/// The routines that a call may mean.
#[derive(Clone, Debug, Default)]
pub(super) struct Callees {
    pub routines: Vec<u32>,
    /// It may be one that is not in the files.
    pub foreign: bool,
}

/// A call with what it is given.
#[derive(Clone, Copy)]
pub(super) struct Given {
    pub callee: Callee,
    pub verb: Verb,
    pub arguments: Part,
    pub of_function: bool,
    pub context: Context,
    pub file: u32,
}

impl<'a> Resolved<'a> {
    pub(super) fn new(
        parsed: Parsed,
        verbs: Verbs,
        groups: &[Group],
        sources: &'a [Source],
    ) -> Self {
        let (mut data, mut routines) = (Scopes::default(), Scopes::default());
        let mut shared = HashMap::new();
        for (at, group) in groups.iter().enumerate() {
            let all = group
                .members
                .iter()
                .map(|datum| (*datum, (at, group.alike)));
            shared.extend(all);
            data.add_shared(group.name, &group.modules, &group.declarations);
        }
        for (at, datum) in (0..).zip(&parsed.data) {
            if !shared.contains_key(&at) {
                data.add(datum.name, datum.context, datum.local, at);
            }
        }
        for (at, routine) in parsed.routines.iter().enumerate() {
            let context = Context {
                module: routine.module,
                routine: None,
            };
            routines.add(routine.name, context, routine.local, short(at));
        }
        let written = vec![false; parsed.data.len()];
        let mut resolved = Self {
            parsed,
            sources,
            data,
            routines,
            verbs,
            written,
            undeclared: HashSet::new(),
            scattered: HashSet::new(),
            filled: HashSet::new(),
            in_parts: HashSet::new(),
            otherwise: HashSet::new(),
            derived: HashSet::new(),
            numbers: Numbers::default(),
            given: GivenNumbers::default(),
            coordinates: Coordinates::default(),
            shared,
            late_bound: HashSet::new(),
        };
        resolved.find_written();
        resolved.find_numbers();
        resolved.find_derived();
        resolved
    }

    pub(super) fn datum(&self, datum: u32) -> &Datum {
        &self.parsed.data[datum as usize]
    }

    pub(super) fn spelling(&self, name: Symbol) -> &str {
        self.parsed.symbols.spelling(name)
    }

    pub(super) fn meaning(&self, name: Symbol, context: Context) -> Meaning {
        self.data.meaning(name, context)
    }

    pub(super) fn several(&self, list: u32) -> &[u32] {
        self.data.several(list)
    }

    /// Whether several declarations are one datum with one value.
    pub(super) fn are_alike(&self, list: u32) -> bool {
        let of = |datum: &u32| self.shared.get(datum).filter(|of| of.1);
        let all = self.several(list);
        let first = all.first().and_then(of);
        first.is_some() && all.iter().all(|datum| of(datum) == first)
    }

    /// Whether tasks share a datum.
    pub(super) fn is_shared(&self, entity: Entity) -> bool {
        matches!(entity, Entity::Declared(datum) if self.shared.contains_key(&datum))
    }

    /// The group of a datum that tasks share.
    pub(super) fn group_of(&self, datum: u32) -> Option<u32> {
        self.shared.get(&datum).map(|(group, _)| short(*group))
    }

    /// Whether tasks share any.
    pub(super) fn has_shared(&self) -> bool {
        !self.shared.is_empty()
    }

    /// What a function that is called here does if it is one of the language.
    pub(super) fn known(&self, function: &Function, context: Context) -> Known {
        self.known_function(function.name, context)
    }

    /// Likewise by its name.
    pub(super) fn known_function(&self, name: Symbol, context: Context) -> Known {
        self.verbs.known(name, context.module)
    }

    /// The function of the files that a name means.
    pub(super) fn function_of(&self, name: Symbol, context: Context) -> Option<u32> {
        match self.routines.meaning(name, context) {
            Meaning::One(routine) => Some(routine),
            _ => None,
        }
    }

    pub(super) fn is_written(&self, entity: Entity) -> bool {
        match entity {
            Entity::Declared(datum) => self.written[datum as usize],
            Entity::Undeclared(name) => self.undeclared.contains(&name),
        }
    }

    /// Whether data are written at an index that is not constant, or as a whole.
    pub(super) fn is_scattered(&self, entity: Entity) -> bool {
        self.scattered.contains(&entity)
    }

    /// Whether routines of the files fill an array without values.
    pub(super) fn is_filled(&self, entity: Entity) -> bool {
        matches!(entity, Entity::Declared(datum) if self.filled.contains(&datum))
    }

    /// Whether a part of data is written, such as `p.trans`.
    pub(super) fn is_in_parts(&self, datum: u32) -> bool {
        self.in_parts.contains(&datum)
    }

    /// Whether a parameter is the variable that a call gives it.
    pub(super) fn is_by_reference(&self, parameter: u32) -> bool {
        matches!(
            self.datum(parameter).storage,
            Storage::Parameter {
                by_reference: true,
                ..
            }
        )
    }

    /// Whether what a routine writes into a parameter is written where it is called.
    pub(super) fn is_written_back(&self, parameter: u32) -> bool {
        self.is_by_reference(parameter) && self.written[parameter as usize]
    }

    /// The data that an expression is or a part of which it is, and which element of them.
    pub(super) fn place_of(&self, expression: &Expression) -> Option<(Symbol, Index)> {
        let name = named(expression)?;
        let index = match *expression {
            Expression::Point {
                base: Base::Named { index, .. },
                ..
            }
            | Expression::Member { index, .. } => self.parsed.index(index),
            _ => Index::Whole,
        };
        Some((name, index))
    }

    /// Whether a name is written that the files do not declare.
    pub(super) fn has_undeclared(&self) -> bool {
        !self.undeclared.is_empty()
    }

    /// The type of what a name means; of several declarations that of the first.
    pub(super) fn kind(&self, name: Symbol, context: Context) -> Option<Type> {
        match self.meaning(name, context) {
            Meaning::One(datum) => Some(self.datum(datum).kind),
            Meaning::Several(list) => Some(self.datum(self.several(list)[0]).kind),
            Meaning::Nothing => None,
        }
    }

    /// Whether a call names a routine of the files.
    pub(super) fn is_routine(&self, name: Symbol, context: Context) -> bool {
        self.routines.meaning(name, context) != Meaning::Nothing
    }

    /// The routines that a call may mean.
    pub(super) fn callees(
        &self,
        callee: Callee,
        arguments: Part,
        context: Context,
        file: u32,
    ) -> Callees {
        let named = |name: Option<Symbol>| {
            let meaning = name.map_or(Meaning::Nothing, |name| {
                self.routines.meaning(name, context)
            });
            match meaning {
                Meaning::One(routine) => vec![routine],
                Meaning::Several(list) => self.routines.several(list).to_vec(),
                Meaning::Nothing => Vec::new(),
            }
        };
        let routines = match callee {
            Callee::Named(name) => named(Some(name)),
            Callee::Text(start, end) => {
                let text = &self.sources[file as usize].bytes[start as usize..end as usize];
                let mut names = text
                    .rsplit(|b| *b == b':')
                    .map(|name| self.parsed.symbols.find(name));
                let name = names.next().flatten();
                match names.next() {
                    Some(module) => self.of_module(module, name),
                    None => named(name),
                }
            }
            Callee::Late => return self.any_routine(arguments, ""),
        };
        Callees {
            foreign: routines.is_empty(),
            routines,
        }
    }

    /// The procedures of this name in the modules of another, local ones too.
    fn of_module(&self, module: Option<Symbol>, name: Option<Symbol>) -> Vec<u32> {
        let (Some(module), Some(name)) = (module, name) else {
            return Vec::new();
        };
        let routines = (0..).zip(&self.parsed.routines);
        let named = routines.filter(|(_, of)| {
            let own = self.parsed.modules[of.module as usize];
            of.is_procedure && of.name == name && own == Some(module)
        });
        named.map(|(routine, _)| routine).collect()
    }

    /// Whether the controller starts a routine: of several called `main` not one that another calls
    /// by its name.
    pub(super) fn is_main(&self, routine: u32) -> bool {
        let name = self.spelling(self.parsed.routines[routine as usize].name);
        name.eq_ignore_ascii_case("main") && !self.late_bound.contains(&routine)
    }

    /// Every procedure whose name begins so and that takes so many arguments, and others.
    pub(super) fn any_routine(&self, arguments: Part, prefix: &str) -> Callees {
        let positional = self.parsed.arguments[indices(arguments)]
            .iter()
            .filter(|argument| argument.option.is_none())
            .count();
        let fits = |at: &usize| {
            let routine = &self.parsed.routines[*at];
            let name = self.spelling(routine.name);
            let begins = name
                .get(..prefix.len())
                .is_some_and(|begin| begin.eq_ignore_ascii_case(prefix));
            let required = self.parsed.data[indices(routine.parameters)]
                .iter()
                .filter(|datum| !matches!(datum.storage, Storage::Parameter { optional: true, .. }))
                .count();
            routine.is_procedure
                && begins
                && required == positional
                && !name.eq_ignore_ascii_case("main")
        };
        let routines = (0..self.parsed.routines.len()).filter(fits).map(short);
        Callees {
            routines: routines.collect(),
            foreign: true,
        }
    }

    /// The parameter of a routine that each argument is for.
    pub(super) fn parameters<'b>(
        &'b self,
        routine: u32,
        arguments: &'b [Argument],
    ) -> impl Iterator<Item = (u32, Option<&'b Argument>)> {
        let mut positional = arguments
            .iter()
            .filter(|argument| argument.option.is_none());
        let (first, end) = self.parsed.routines[routine as usize].parameters;
        (first..end).map(move |datum| {
            let parameter = self.datum(datum);
            let argument = match parameter.storage {
                Storage::Parameter { optional: true, .. } => arguments
                    .iter()
                    .find(|argument| argument.option == Some(parameter.name)),
                _ => positional.next(),
            };
            (datum, argument)
        })
    }

    // ---- what may be written

    /// Marks what a name may mean, of which a part is written; whether that is new.
    fn mark_part(&mut self, name: Symbol, context: Context) -> bool {
        match self.data.meaning(name, context) {
            Meaning::One(datum) => self.in_parts.insert(datum),
            _ => false,
        }
    }

    /// Marks what a name may mean, where an element of it is written by anything but the robot's own
    /// position; whether that is new.
    fn mark(&mut self, (name, index): (Symbol, Index), context: Context) -> bool {
        match self.data.meaning(name, context) {
            Meaning::One(datum) => drop(self.otherwise.insert(datum)),
            Meaning::Several(list) => {
                let all = self.data.several(list).iter().copied();
                self.otherwise.extend(all);
            }
            Meaning::Nothing => {}
        }
        self.mark_written((name, index), context)
    }

    /// Marks what a name may mean, where an element of it is written; whether that is new.
    fn mark_written(&mut self, (name, index): (Symbol, Index), context: Context) -> bool {
        let is_scattered = !matches!(index, Index::At(_));
        let data = match self.data.meaning(name, context) {
            Meaning::One(datum) => vec![datum],
            Meaning::Several(list) => self.data.several(list).to_vec(),
            Meaning::Nothing => {
                if is_scattered {
                    self.scattered.insert(Entity::Undeclared(name));
                }
                return self.undeclared.insert(name);
            }
        };
        let mut changed = false;
        for datum in data {
            if is_scattered && self.datum(datum).value == Stored::Computed {
                self.scattered.insert(Entity::Declared(datum));
            }
            let constant = self.datum(datum).storage == Storage::Constant;
            let written = &mut self.written[datum as usize];
            changed |= !constant && !*written;
            *written |= !constant;
        }
        changed
    }

    /// Whether arguments are given to functions or instructions in [`Parsed::given`] or
    /// [`Parsed::arguments`].
    pub(super) fn list(&self, of_function: bool) -> &[Argument] {
        if of_function {
            &self.parsed.given
        } else {
            &self.parsed.arguments
        }
    }

    fn find_written(&mut self) {
        let mut calls = Vec::new();
        let mut context = Context {
            module: 0,
            routine: None,
        };
        let mut file = 0;
        for at in 0..self.parsed.statements.len() {
            match self.parsed.statements[at].kind {
                StatementKind::Text {
                    file: in_file,
                    context: now,
                } => (context, file) = (now, in_file),
                StatementKind::Assign {
                    name,
                    index,
                    component,
                    value,
                } => {
                    if component == Component::Whole && self.tells_robot(value, context) {
                        self.mark_written((name, index), context);
                    } else {
                        self.mark((name, index), context);
                    }
                    if component != Component::Whole {
                        self.mark_part(name, context);
                    }
                }
                StatementKind::Function(function) => {
                    let function = self.parsed.functions[function as usize];
                    let given = Given {
                        callee: Callee::Named(function.name),
                        verb: Verb::Other,
                        arguments: function.arguments,
                        of_function: true,
                        context,
                        file,
                    };
                    if let Known::Writes(position) = self.known(&function, context) {
                        self.mark_argument(given, position);
                    } else {
                        calls.push(given);
                    }
                }
                StatementKind::Call(call) => {
                    let given = Given {
                        callee: call.callee,
                        verb: call.verb,
                        arguments: call.arguments,
                        of_function: false,
                        context,
                        file,
                    };
                    self.note_call(given, &mut calls);
                }
                _ => {}
            }
        }
        self.find_asked(&calls);
        // what a routine writes into a parameter by reference is written where it is called
        loop {
            let mut changed = false;
            for call in &calls {
                changed |= self.mark_given(*call);
            }
            if !changed {
                break;
            }
        }
        if !(0..short(self.parsed.routines.len())).any(|routine| self.is_main(routine)) {
            self.late_bound.clear();
        }
    }

    /// Whether what is assigned is where the robot stands: `CJointT()`, `CRobT()`.
    fn tells_robot(&self, value: Assigned, context: Context) -> bool {
        let Assigned::To(Expression::Point {
            base: Base::Function(function),
            steps: (a, b),
        }) = value
        else {
            return false;
        };
        let function = &self.parsed.functions[function as usize];
        let is_actual = self.known(function, context) == Known::Actual;
        a == b && is_actual && !self.converts(function.name)
    }

    /// Whether a function that may tell where the robot is does so of what it is given: `CalcRobT`.
    pub(super) fn converts(&self, function: Symbol) -> bool {
        let name = self.spelling(function).as_bytes();
        name.get(..4)
            .is_some_and(|first| first.eq_ignore_ascii_case(b"calc"))
    }

    /// Whether an expression can only be where the robot stands, or stood.
    pub(super) fn is_of_robot(&self, expression: &Expression, context: Context) -> bool {
        let (base, (a, b)) = match *expression {
            Expression::Point { base, steps } => (base, steps),
            // a function in an argument: joints are no sum of others
            Expression::Computed(names) => {
                let first = self
                    .parsed
                    .mentions
                    .get(indices(names))
                    .and_then(<[_]>::first);
                return first.is_some_and(|&name| {
                    self.known_function(name, context) == Known::Actual && !self.converts(name)
                });
            }
            _ => return false,
        };
        match base {
            _ if a != b => false,
            Base::Function(function) => {
                let function = &self.parsed.functions[function as usize];
                let given = &self.parsed.given[indices(function.arguments)];
                self.known(function, context) == Known::Actual
                    && (!self.converts(function.name)
                        || given
                            .iter()
                            .find(|of| of.option.is_none())
                            .is_some_and(|of| self.is_of_robot(&of.expression, context)))
            }
            Base::Named { name, .. } => match self.meaning(name, context) {
                Meaning::One(datum) => {
                    let is_parameter =
                        matches!(self.datum(datum).storage, Storage::Parameter { .. });
                    let entity = Entity::Declared(datum);
                    !is_parameter && self.is_written(entity) && !self.otherwise.contains(&datum)
                }
                _ => false,
            },
            Base::Target(_) => false,
        }
    }

    fn note_call(&mut self, given: Given, calls: &mut Vec<Given>) {
        let verb = match given.callee {
            Callee::Named(name) if self.is_routine(name, given.context) => Verb::Other,
            _ => given.verb,
        };
        match verb {
            Verb::Writes(position) => self.mark_argument(given, position),
            Verb::Move {
                led: Led::Search, ..
            } => self.mark_argument(given, 1),
            Verb::WritesTool => {
                for at in indices(given.arguments) {
                    if let Some(place) = self.place_of(&self.parsed.arguments[at].expression) {
                        self.mark(place, given.context);
                    }
                }
            }
            Verb::WritesNamed => {
                let meant = self.moves_set_by_name(given.arguments, given.context, given.file);
                for datum in meant {
                    self.otherwise.insert(datum);
                    self.written[datum as usize] = true;
                }
            }
            _ => {}
        }
        if matches!(verb, Verb::Other | Verb::CallByVar) {
            calls.push(given);
        }
        if matches!(given.callee, Callee::Text(..)) {
            let named = self.callees(given.callee, given.arguments, given.context, given.file);
            self.late_bound.extend(named.routines);
        }
    }

    fn mark_argument(&mut self, given: Given, position: u8) {
        let mut positional = self.list(given.of_function)[indices(given.arguments)]
            .iter()
            .filter(|argument| argument.option.is_none());
        let Some(expression) = positional
            .nth(usize::from(position))
            .map(|of| of.expression)
        else {
            return;
        };
        if let Some(place) = self.place_of(&expression) {
            self.mark(place, given.context);
            if matches!(expression, Expression::Member { .. }) {
                self.mark_part(place.0, given.context);
            }
        }
    }

    /// Marks what a call may write through its arguments; whether that is new.
    fn mark_given(&mut self, given: Given) -> bool {
        let callees = self.callees(given.callee, given.arguments, given.context, given.file);
        let arguments = &self.list(given.of_function)[indices(given.arguments)];
        let (mut places, mut filled, mut parts) = (Vec::new(), Vec::new(), Vec::new());
        for &routine in &callees.routines {
            for (datum, argument) in self.parameters(routine, arguments) {
                let expression = argument.map(|argument| argument.expression);
                let Some(expression) = expression.filter(|_| self.is_written_back(datum)) else {
                    continue;
                };
                let Some((name, index)) = self.place_of(&expression) else {
                    continue;
                };
                places.push((name, index));
                if matches!(expression, Expression::Member { .. }) || self.is_in_parts(datum) {
                    parts.push(name);
                } else if index == Index::Whole {
                    filled.push(name);
                }
            }
        }
        if callees.foreign {
            let own = arguments
                .iter()
                .filter_map(|argument| self.place_of(&argument.expression));
            places.extend(own.filter(|(name, _)| {
                // of what the files do not declare, the moves say later what it is
                self.kind(*name, given.context)
                    .is_none_or(Type::is_of_moves)
                    || given
                        .context
                        .routine
                        .is_some_and(|routine| self.parsed.values_asked.contains(&(routine, *name)))
            }));
        }
        let mut changed = false;
        for place in places {
            changed |= self.mark(place, given.context);
        }
        for name in parts {
            changed |= self.mark_part(name, given.context);
        }
        for name in filled {
            if let Meaning::One(datum) = self.data.meaning(name, given.context)
                && self.datum(datum).value == Stored::Computed
            {
                self.filled.insert(datum);
            }
        }
        changed
    }

    /// Whether the value that a target is declared with may be another one when the program runs, or is none:
    /// something writes it, or it has no value yet.
    pub(super) fn may_be_another(&self, target: usize, is_blank: bool) -> bool {
        let declares = |datum: &Datum| match datum.value {
            Stored::Elements { elements, .. } => self.parsed.elements[indices(elements)]
                .contains(&super::syntax::Element::Target(target)),
            _ => false,
        };
        let found = self.parsed.data.iter().position(declares);
        found.is_some_and(|at| self.written[at] || is_blank)
    }
}

/// The data that an argument is or a part of which it is.
pub(super) fn named(expression: &Expression) -> Option<Symbol> {
    match *expression {
        Expression::Point {
            base: Base::Named { name, .. },
            steps: (a, b),
        } if a == b => Some(name),
        Expression::Member { name, .. } => Some(name),
        _ => None,
    }
}
