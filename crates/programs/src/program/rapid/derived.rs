//! Which numbers come from targets, and take the correction of these along. All others are as the
//! text, a sensor or the operator has them: where they become coordinates, nothing is corrected.

use super::builtins::Known;
use super::resolved::{Entity, Resolved};
use super::syntax::{
    Argument, Assigned, Base, Callee, Component, Expression, Part, StatementKind, Type, indices,
};
use crate::program::names::{Context, Meaning, Symbol};
use crate::program::script::Place;
use foldhash::HashMap;

/// Steps from one name to the next that are followed against the order of the text.
const MOST_ROUNDS: usize = 32;

/// What holds numbers: data, or what a function gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Holder {
    Data(Entity),
    Result(u32),
}

/// What a holder gets: a value, or what a routine writes into a parameter.
#[derive(Clone, Copy)]
pub(super) enum Origin {
    /// The assignment stands in this place.
    Value(Expression, Context, Option<Place>),
    /// What a call gives to a parameter that is written back: it has that from its beginning.
    Given(Expression, Context),
    Parameter(u32),
}

/// What holders get, in the order of the text.
#[derive(Default)]
pub(super) struct Origins {
    holders: Vec<(Holder, Vec<Origin>)>,
    known: HashMap<Holder, usize>,
}

impl Origins {
    fn add(&mut self, holder: Holder, origin: Origin) {
        let at = *self.known.entry(holder).or_insert_with(|| {
            self.holders.push((holder, Vec::new()));
            self.holders.len() - 1
        });
        self.holders[at].1.push(origin);
    }

    /// What one of them gets.
    pub(super) fn of(&self, holder: Holder) -> &[Origin] {
        let at = self.known.get(&holder);
        at.map_or(&[], |at| &self.holders[*at].1)
    }
}

impl Resolved<'_> {
    /// Whether all of a value comes from targets.
    pub(super) fn is_from_target(&self, value: &Expression, context: Context) -> bool {
        match *value {
            Expression::Point {
                base: Base::Target(_),
                ..
            } => true,
            Expression::Composed(at) | Expression::List(at) => {
                let places = &self.parsed.composed[at as usize].places;
                places.iter().all(|place| self.carry(*place, context))
            }
            _ => self.any_name(value, &|name| self.carries(name, context)),
        }
    }

    /// Whether a target with expressions in it has a coordinate or joint that comes from no target.
    pub(super) fn has_own_place(&self, value: &Expression, context: Context) -> bool {
        let places = |at: u32| &self.parsed.composed[at as usize].places;
        let own = |place: &Part| !self.carry(*place, context);
        match *value {
            Expression::Composed(at) => places(at).iter().any(own),
            // coordinates or joints stand first, as a whole
            Expression::List(at) => places(at).first().is_some_and(own),
            _ => false,
        }
    }

    /// Whether all that data get comes from targets.
    pub(super) fn is_derived_datum(&self, datum: u32) -> bool {
        let data = Holder::Data(Entity::Declared(datum));
        self.derived.contains(&data)
    }

    /// Whether one of these names carries numbers of a target.
    fn carry(&self, names: Part, context: Context) -> bool {
        let mut names = self.parsed.mentions[indices(names)].iter();
        names.any(|name| self.carries(*name, context))
    }

    fn carries(&self, name: Symbol, context: Context) -> bool {
        let data = |datum: u32| {
            self.datum(datum).kind.is_target()
                || self
                    .derived
                    .contains(&Holder::Data(Entity::Declared(datum)))
        };
        match self.meaning(name, context) {
            Meaning::One(datum) => data(datum),
            Meaning::Several(list) => self.several(list).iter().all(|datum| data(*datum)),
            Meaning::Nothing => {
                let data = Holder::Data(Entity::Undeclared(name));
                let result = self.function_of(name, context).map(Holder::Result);
                self.derived.contains(&data)
                    || result.is_some_and(|result| self.derived.contains(&result))
                    || self.known_function(name, context) == Known::Actual
            }
        }
    }

    /// Whether there is such a name in a value.
    pub(super) fn any_name(&self, value: &Expression, is: &dyn Fn(Symbol) -> bool) -> bool {
        match *value {
            Expression::Point {
                base: Base::Named { name, .. },
                ..
            }
            | Expression::Member { name, .. } => is(name),
            Expression::Point {
                base: Base::Function(function),
                ..
            } => {
                let of = &self.parsed.functions[function as usize];
                let given = &self.parsed.given[indices(of.arguments)];
                is(of.name) || given.iter().any(|of| self.any_name(&of.expression, is))
            }
            _ => self.parsed.names_in(value).iter().any(|name| is(*name)),
        }
    }

    /// Finds the data and functions whose numbers all come from targets. What data are declared with
    /// does not count: it is mostly what they hold before the program runs.
    pub(super) fn find_derived(&mut self) {
        let is_place = |kind: &StatementKind| {
            matches!(
                kind,
                StatementKind::Assign {
                    component: Component::Place,
                    ..
                }
            )
        };
        let mut statements = self.parsed.statements.iter();
        let is_part = |of: &Argument| matches!(of.expression, Expression::Member { .. });
        let mut given = [false, true].into_iter().flat_map(|of| self.list(of));
        if self.parsed.composed.is_empty()
            && !statements.any(|of| is_place(&of.kind))
            && !given.any(is_part)
        {
            return;
        }
        let Origins { mut holders, .. } = self.origins();
        for _ in 0..MOST_ROUNDS {
            let before = holders.len();
            holders.retain(|(holder, origins)| {
                let is_derived = self.is_derived(*holder, origins);
                if is_derived {
                    self.derived.insert(*holder);
                }
                !is_derived
            });
            if holders.len() == before {
                break;
            }
        }
    }

    /// Whether all that a holder gets comes from targets; what it had, and something more, tells
    /// nothing.
    fn is_derived(&self, holder: Holder, origins: &[Origin]) -> bool {
        let mut others = origins.iter().filter(|origin| match origin {
            Origin::Value(value, context, _) => {
                let own = |name| self.entity_of(name, *context).map(Holder::Data) == Some(holder);
                !self.any_name(value, &own)
            }
            Origin::Given(..) => false,
            Origin::Parameter(_) => true,
        });
        let comes = |origin: &Origin| match origin {
            Origin::Value(value, context, _) | Origin::Given(value, context) => {
                self.is_from_target(value, *context)
            }
            Origin::Parameter(datum) => self
                .derived
                .contains(&Holder::Data(Entity::Declared(*datum))),
        };
        others.clone().next().is_some() && others.all(comes)
    }

    /// The data that a name means; `None` where the files do not tell which.
    pub(super) fn entity_of(&self, name: Symbol, context: Context) -> Option<Entity> {
        match self.meaning(name, context) {
            Meaning::One(datum) => Some(Entity::Declared(datum)),
            Meaning::Nothing => Some(Entity::Undeclared(name)),
            Meaning::Several(_) => None,
        }
    }

    /// What data that are no targets get, and functions give.
    pub(super) fn origins(&self) -> Origins {
        let mut origins = Origins::default();
        for &(datum, names) in &self.parsed.initial {
            let value = Expression::Computed(names);
            let origin = Origin::Value(value, self.datum(datum).context, None);
            origins.add(Holder::Data(Entity::Declared(datum)), origin);
        }
        let (mut file, mut context) = (
            0,
            Context {
                module: 0,
                routine: None,
            },
        );
        for statement in &self.parsed.statements {
            match statement.kind {
                StatementKind::Text {
                    file: in_file,
                    context: now,
                } => (file, context) = (in_file, now),
                StatementKind::Assign {
                    name,
                    value: Assigned::To(value),
                    ..
                } => {
                    if !self.kind(name, context).is_some_and(Type::is_target)
                        && let Some(entity) = self.entity_of(name, context)
                    {
                        let at = Some(Place::new(file, statement.offset));
                        origins.add(Holder::Data(entity), Origin::Value(value, context, at));
                    }
                }
                StatementKind::Return(value) => {
                    if let Some(routine) = context.routine {
                        origins.add(Holder::Result(routine), Origin::Value(value, context, None));
                    }
                }
                StatementKind::Function(function) => {
                    let of = self.parsed.functions[function as usize];
                    let callee = Callee::Named(of.name);
                    self.add_given(callee, (of.arguments, true), (context, file), &mut origins);
                }
                StatementKind::Call(call) => {
                    let given = (call.arguments, false);
                    self.add_given(call.callee, given, (context, file), &mut origins);
                }
                _ => {}
            }
        }
        origins
    }

    /// What parameters get from a call, and what it gets from them.
    fn add_given(
        &self,
        callee: Callee,
        (arguments, of_function): (Part, bool),
        (context, file): (Context, u32),
        origins: &mut Origins,
    ) {
        let callees = self.callees(callee, arguments, context, file);
        if callees.foreign {
            return;
        }
        let arguments = &self.list(of_function)[indices(arguments)];
        for routine in callees.routines {
            for (datum, argument) in self.parameters(routine, arguments) {
                let Some(value) = argument.map(|argument| argument.expression) else {
                    continue;
                };
                let of_target = matches!(value, Expression::Member { .. })
                    && self.is_from_target(&value, context);
                let parameter = Holder::Data(Entity::Declared(datum));
                if of_target || !self.is_written_back(datum) {
                    origins.add(parameter, Origin::Value(value, context, None));
                } else {
                    origins.add(parameter, Origin::Given(value, context));
                }
                if self.is_written_back(datum)
                    && let Some((name, _)) = self.place_of(&value)
                    && let Some(entity) = self.entity_of(name, context)
                {
                    origins.add(Holder::Data(entity), Origin::Parameter(datum));
                }
            }
        }
    }
}
