//! What calls give to the numbers of a routine, call by call: what these numbers displace a position
//! by is that of the call which goes there.

use super::displacing::Displacing;
use super::kit;
use super::quantity::Quantity;
use super::script::{
    Argument, ByCall, Expr, Held, Place, Remark, RoutineId, Script, Variable, VariableId,
};
use super::transformations::{At, Of};
use foldhash::HashMap;
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Calls of a routine that are distinguished, each in all calls of its caller.
const MOST_CONTEXTS: usize = 16_384;
/// Displacements that are worked out for calls apart, in a program.
const MOST_APART: usize = 200_000;

/// Which call a routine runs in that is none of the files'.
const UNKNOWN: Remark = kit::computed("computed-target", "give the file that calls it too");

/// A call of a routine.
#[derive(Clone, Debug)]
pub(super) struct Context {
    call: At,
    /// The call of the caller, where what is given depends on that.
    caller: Option<usize>,
    /// The numbers that it gives.
    given: Vec<(u32, Quantity)>,
}

/// What is so in all calls of a routine, and what in each of them where they differ.
#[derive(Clone, Debug)]
pub(super) struct Varied<T> {
    pub all: T,
    each: Vec<T>,
}

impl<T> Varied<T> {
    pub(super) fn one(all: T) -> Self {
        let each = Vec::new();
        Self { all, each }
    }

    pub(super) fn map<U>(self, mut to: impl FnMut(T) -> U) -> Varied<U> {
        Varied {
            all: to(self.all),
            each: self.each.into_iter().map(to).collect(),
        }
    }
}

impl<T: Clone> Varied<T> {
    /// Changes it by something.
    pub(super) fn with<U: Clone>(&mut self, by: Varied<U>, change: impl Fn(&mut T, U)) {
        if self.each.is_empty() {
            self.each = vec![self.all.clone(); by.each.len()];
        }
        change(&mut self.all, by.all.clone());
        let each = by.each.into_iter().map(Some).chain(std::iter::repeat(None));
        for (of, each) in self.each.iter_mut().zip(each) {
            change(of, each.unwrap_or_else(|| by.all.clone()));
        }
    }
}

/// What calls give to numbers of routines; `W` is how the text writes it.
#[derive(Debug)]
pub(super) struct Given<W> {
    /// By routine and call.
    calls: HashMap<u32, BTreeMap<At, Vec<(u32, W)>>>,
    /// How often each number is given.
    times: HashMap<u32, usize>,
    /// The calls of routines, once a position in one asks.
    contexts: RefCell<HashMap<u32, Rc<[Context]>>>,
    /// What has been worked out for calls apart.
    apart: Cell<usize>,
}

impl<W> Default for Given<W> {
    fn default() -> Self {
        Self {
            calls: HashMap::default(),
            times: HashMap::default(),
            contexts: RefCell::default(),
            apart: Cell::default(),
        }
    }
}

impl<W> Given<W> {
    /// A call gives a number, which is `own` to the routine.
    pub(super) fn note(&mut self, callee: RoutineId, call: At, own: u32, written: W) {
        let calls = self.calls.entry(callee).or_default();
        calls.entry(call).or_default().push((own, written));
        *self.times.entry(own).or_default() += 1;
    }

    /// How often calls give a number.
    pub(super) fn times(&self, own: u32) -> usize {
        self.times.get(&own).copied().unwrap_or_default()
    }

    /// Whether so much more may be worked out for calls apart.
    fn affords(&self, more: usize) -> bool {
        let apart = self.apart.get() + more;
        let affords = apart <= MOST_APART;
        if affords {
            self.apart.set(apart);
        }
        affords
    }

    fn known_contexts(&self, routine: RoutineId) -> Option<Rc<[Context]>> {
        self.contexts.borrow().get(&routine).cloned()
    }
}

/// The numbers of a program, of which calls give some.
pub(super) trait Numbered {
    /// How the text writes them.
    type W: Copy;

    fn given(&self) -> &Given<Self::W>;

    /// Whether nothing but calls writes a number.
    fn is_only_given(&self, number: u32) -> bool;

    /// What a number may be whenever it is looked at.
    fn whenever(&self, number: u32) -> Quantity;

    /// What it is at a statement, where `of` gives what it may be whenever it is looked at.
    fn value_at(&self, number: u32, _at: At, of: &mut Of) -> Quantity {
        of(number)
    }

    /// What is written at a statement comes to.
    fn written(&self, written: Self::W, at: At, of: &mut Of) -> Quantity;

    /// Whether calls of a routine give it a number, and nothing else writes that.
    fn is_given_to(&self, routine: RoutineId, number: u32) -> bool {
        let given = self.given();
        let calls = given
            .calls
            .get(&routine)
            .filter(|_| given.times(number) > 0);
        let mut all = calls.into_iter().flat_map(BTreeMap::values).flatten();
        all.any(|(own, _)| *own == number) && self.is_only_given(number)
    }

    /// What a number is in a call.
    fn value_in(&self, number: u32, context: &Context) -> Quantity {
        let given = context.given.iter().find(|(own, _)| *own == number);
        given.map_or_else(|| self.whenever(number), |(_, value)| value.clone())
    }

    /// The calls of a routine; none where they are not distinguished.
    fn contexts(&self, routine: RoutineId) -> Rc<[Context]>
    where
        Self: Sized,
    {
        let given = self.given();
        if let Some(known) = given.known_contexts(routine) {
            return known;
        }
        // a routine that calls itself is not followed
        given.contexts.borrow_mut().insert(routine, Rc::default());
        let found = self.contexts_of(routine).unwrap_or_default();
        let found: Rc<[Context]> = found.into();
        (given.contexts.borrow_mut()).insert(routine, Rc::clone(&found));
        found
    }

    fn contexts_of(&self, routine: RoutineId) -> Option<Vec<Context>>
    where
        Self: Sized,
    {
        let mut found = Vec::new();
        for (&call, given) in self.given().calls.get(&routine)? {
            let given = || given.iter().filter(|(own, _)| self.is_only_given(*own));
            let each = varied(self, call, &mut |of| -> Vec<(u32, Quantity)> {
                let value = |(own, written)| (own, self.written(written, call, of));
                given().copied().map(value).collect()
            });
            let is_varied = !each.each.is_empty();
            let each = if is_varied { each.each } else { vec![each.all] };
            for (caller, given) in each.into_iter().enumerate() {
                found.push(Context {
                    call,
                    caller: is_varied.then_some(caller),
                    given,
                });
            }
            if found.len() > MOST_CONTEXTS {
                return None;
            }
        }
        Some(found)
    }
}

/// What comes of numbers at a statement, in all calls of its routine and in each.
pub(super) fn varied<N: Numbered, T>(
    numbers: &N,
    at: At,
    evaluate: &mut dyn FnMut(&mut Of) -> T,
) -> Varied<T> {
    let asks = Cell::new(false);
    let all = evaluate(&mut |number| {
        numbers.value_at(number, at, &mut |number| {
            asks.set(asks.get() || numbers.is_given_to(at.0, number));
            numbers.whenever(number)
        })
    });
    if !asks.get() {
        return Varied::one(all);
    }
    let contexts = numbers.contexts(at.0);
    if !numbers.given().affords(contexts.len()) {
        return Varied::one(all);
    }
    let each = contexts.iter().map(|context| {
        evaluate(&mut |number| {
            let of = &mut |number| numbers.value_in(number, context);
            numbers.value_at(number, at, of)
        })
    });
    Varied {
        all,
        each: each.collect(),
    }
}

/// The variables that hold which call of a routine is followed.
#[derive(Debug, Default)]
pub(super) struct Calls(HashMap<RoutineId, VariableId>);

impl Calls {
    fn of(&mut self, routine: RoutineId, script: &mut Script) -> VariableId {
        *self.0.entry(routine).or_insert_with(|| {
            let place = script.routines[routine as usize].place;
            let declared = script.unknown(UNKNOWN);
            script.variable(Variable {
                routine: Some(routine),
                ..Variable::new("call", place, declared)
            })
        })
    }

    /// A position of a routine, displaced.
    pub(super) fn displaced(
        &mut self,
        base: Expr,
        by: Varied<Displacing>,
        routine: RoutineId,
        script: &mut Script,
    ) -> Expr {
        let by = by.map(Displacing::displacement);
        let otherwise = script.displacement(by.all.clone());
        if by.each.iter().all(|each| *each == by.all) {
            return script.displaced(base, otherwise);
        }
        let call = self.of(routine, script);
        let mut of = BTreeMap::new();
        for (number, by) in (0..).zip(by.each) {
            of.insert(number, script.displacement(by));
        }
        let by = ByCall {
            call,
            by: of,
            otherwise,
        };
        script.displaced_by_call(base, by)
    }

    /// Makes calls say which they are.
    pub(super) fn hand_over<W>(mut self, of: &Given<W>, script: &mut Script) {
        let mut open: Vec<RoutineId> = self.0.keys().copied().collect();
        open.sort_unstable();
        let mut given: HashMap<Place, Vec<(RoutineId, Argument)>> = HashMap::default();
        while let Some(routine) = open.pop() {
            let own = self.0[&routine];
            let mut calls: BTreeMap<At, Vec<(i64, Option<usize>)>> = BTreeMap::new();
            let contexts = of.known_contexts(routine).unwrap_or_default();
            for (number, context) in (0..).zip(contexts.iter()) {
                let numbers = calls.entry(context.call).or_default();
                numbers.push((number, context.caller));
            }
            for ((caller, at), numbers) in calls {
                let value = if let [(number, None)] = numbers[..] {
                    script.held(Held::Number(number))
                } else {
                    if !self.0.contains_key(&caller) {
                        open.push(caller);
                    }
                    let by = self.of(caller, script);
                    let table = script.table("call");
                    for (number, caller) in numbers {
                        let held = script.held(Held::Number(number));
                        let held = script.variable(Variable::new("call", Place::NOWHERE, held));
                        let entries = &mut script.tables[table as usize].entries;
                        entries.extend(caller.and_then(|of| Some((i64::try_from(of).ok()?, held))));
                    }
                    Expr::Element { table, number: by }
                };
                let file = script.routines[caller as usize].place.file;
                let argument = Argument::new(Some(own), value, None);
                let given = given.entry(Place::new(file, at)).or_default();
                given.push((routine, argument));
            }
        }
        for at in 0..script.calls.len() {
            let call = &script.calls[at];
            let Some(more) = given.get(&call.place) else {
                continue;
            };
            let before = call.arguments.start as usize..call.arguments.end as usize;
            let mut arguments = script.arguments[before].to_vec();
            let more = more.iter().filter(|(to, _)| call.callees.contains(to));
            arguments.extend(more.map(|(_, argument)| *argument));
            let arguments = script.give(arguments);
            script.calls[at].arguments = arguments;
        }
    }
}

/// Steps of which nothing is known yet.
pub(super) fn nothing() -> Varied<Displacing> {
    Varied::one(Displacing::new())
}
