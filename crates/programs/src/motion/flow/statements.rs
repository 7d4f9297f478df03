//! Statements gone through to a fixed point: work, joins, moves.

use super::{
    DEEPEST, Flow, From, Instance, Item, MOST_MORE, MOST_TIMES, MOST_VISITS, Modes, NO_INSTANCE,
    Reached, State,
};
use crate::motion::before::{ANYWHERE, Stop};
use crate::motion::holding::{Atom, DECLARED, Holding, NOTHING, Site};
use crate::program::script::{
    Argument, Call, Condition, Expected, Expr, Held, Label, ModalId, RoutineId, Statement,
    VariableId, Wanted, Written, short,
};
use std::collections::BTreeSet;
use std::rc::Rc;

impl<'a> Flow<'a> {
    pub(super) fn arguments(&self, call: &Call) -> &'a [Argument] {
        &self.script.arguments[call.arguments.start as usize..call.arguments.end as usize]
    }

    pub(super) fn declared_state(&mut self, before: Stop) -> State {
        let holds = (0..self.tracked.len())
            .map(|slot| {
                let declared = self.script.variables[self.tracked[slot] as usize].declared;
                self.constant(declared, DECLARED)
            })
            .collect();
        State {
            holds: Rc::new(holds),
            before: self.sets.one(before),
            led: None,
            is_alone: self.all_are_started,
        }
    }

    pub(super) fn join(&mut self, a: &State, b: &State) -> State {
        let holds = if Rc::ptr_eq(&a.holds, &b.holds) {
            Rc::clone(&a.holds)
        } else {
            let joined = a
                .holds
                .iter()
                .zip(b.holds.iter())
                .map(|(a, b)| self.holdings.join(*a, *b))
                .collect::<Vec<_>>();
            if joined == *a.holds {
                Rc::clone(&a.holds)
            } else {
                Rc::new(joined)
            }
        };
        State {
            holds,
            before: self.sets.union(a.before, b.before),
            led: a.led.or(b.led),
            is_alone: a.is_alone && b.is_alone,
        }
    }

    /// The routine that a stop is in.
    pub(in crate::motion) fn routine_of(&self, stop: usize) -> RoutineId {
        let behind = (self.instances).partition_point(|of| of.first_stop as usize <= stop);
        self.instances[behind - 1].routine
    }

    pub(super) fn instance(&mut self, routine: RoutineId, depth: u32, caller: u32) -> u32 {
        let of = &self.script.routines[routine as usize];
        let first_stop = short(self.reached.len());
        let count = of.instructions.len();
        self.reached.resize(self.reached.len() + count, None);
        self.instructions.extend(of.instructions.clone());
        self.size += of.statements.len();
        self.instances.push(Instance {
            routine,
            depth,
            caller,
            first_stop,
            same: Rc::default(),
            entry: None,
            exit: None,
            raised: None,
            writes_only: false,
            waiting: BTreeSet::new(),
        });
        short(self.instances.len() - 1)
    }

    /// The instance of a routine for a call.
    pub(super) fn called(&mut self, caller: u32, statement: u32, routine: RoutineId) -> u32 {
        let key = (caller, statement, routine);
        if let Some(&known) = self.by_call.get(&key) {
            return known;
        }
        let writes_only = self.counts_by_writes(caller, statement);
        let depth = self.instances[caller as usize].depth + 1;
        let mut chain = caller;
        let mut is_recursive = false;
        while chain != NO_INSTANCE {
            is_recursive |= self.instances[chain as usize].routine == routine;
            chain = self.instances[chain as usize].caller;
        }
        let most = MOST_TIMES * self.script.statements.len() + MOST_MORE;
        let length = self.script.routines[routine as usize].statements.len();
        let is_own =
            !writes_only && depth <= DEEPEST && !is_recursive && self.size + length <= most;
        let made = if is_own {
            let made = self.instance(routine, depth, caller);
            self.instances[made as usize].same = self.given_by(caller, statement, routine);
            made
        } else if let Some(&known) = self.merged.get(&(routine, writes_only)) {
            known
        } else {
            let made = self.instance(routine, DEEPEST + 1, NO_INSTANCE);
            self.instances[made as usize].writes_only = writes_only;
            self.merged.insert((routine, writes_only), made);
            made
        };
        self.by_call.insert(key, made);
        made
    }

    pub(super) fn push(&mut self, instance: u32, statement: u32, from: From) {
        self.work.push(Item {
            depth: self.instances[instance as usize].depth,
            statement: std::cmp::Reverse(statement),
            instance,
            from,
        });
    }

    /// Joins a state into the beginning of an instance.
    pub(super) fn enter(&mut self, instance: u32, state: &State) {
        let joined = match &self.instances[instance as usize].entry {
            Some(entry) => {
                let entry = entry.clone();
                self.join(&entry, state)
            }
            None => state.clone(),
        };
        let of = &mut self.instances[instance as usize];
        if of.entry.as_ref() != Some(&joined) {
            let start = self.script.routines[of.routine as usize].statements.start;
            of.entry = Some(joined);
            self.push(instance, start, From::Entry);
        }
    }

    pub(super) fn arrive(&mut self, instance: u32, label: Label, state: &State) {
        let place = self.label_places[label as usize];
        let key = (instance, label);
        // the text may have no such label: nothing is known to follow; what is reached is not
        // reached from dead text
        if place == u32::MAX || self.dead == Some(instance) && self.visited[place as usize] {
            return;
        }
        let joined = match self.at_labels.get(&key) {
            Some((old, _)) => {
                let old = old.clone();
                let joined = self.join(&old, state);
                if joined == old {
                    return;
                }
                joined
            }
            None => state.clone(),
        };
        let queued = matches!(self.at_labels.insert(key, (joined, true)), Some((_, true)));
        if !queued {
            self.push(instance, place, From::Label(label));
        }
    }

    pub(super) fn run_work(&mut self) {
        let mut visits = 0_usize;
        while let Some(item) = self.work.pop() {
            // a routine with many callers wakes each of them whenever its end changes
            while self.work.peek() == Some(&item) {
                self.work.pop();
            }
            self.writer = self.instances[item.instance as usize].routine;
            visits += 1;
            let most = MOST_VISITS * (self.size + 1000);
            if visits > most {
                self.give_up();
                return;
            }
            let (state, at) = match item.from {
                From::Entry => {
                    let entry = self.instances[item.instance as usize].entry.clone();
                    (entry, item.statement.0)
                }
                From::Label(label) => {
                    let Some((state, queued)) = self.at_labels.get_mut(&(item.instance, label))
                    else {
                        continue;
                    };
                    *queued = false;
                    self.visited[item.statement.0 as usize] = true;
                    (Some(state.clone()), item.statement.0 + 1)
                }
                From::Call => (
                    self.behind_call(item.instance, item.statement.0),
                    item.statement.0 + 1,
                ),
                From::Dead => (Some(self.declared_state(ANYWHERE)), item.statement.0),
            };
            if let Some(state) = state {
                visits += self.run(item.instance, at, state);
            }
        }
    }

    /// Nothing is distinguished any more: everything that is written is unknown.
    pub(super) fn give_up(&mut self) {
        self.work.clear();
        self.chosen.clear();
        self.holdings.lose_all();
        let unknown = self.holdings.one(Atom::Anything, DECLARED);
        let before = self.sets.one(ANYWHERE);
        for modes in &mut self.modes {
            for holding in [&mut modes.tool, &mut modes.frame] {
                if *holding != NOTHING {
                    *holding = unknown;
                }
            }
        }
        for reached in self.reached.iter_mut().flatten() {
            reached.target = reached.target.map(|_| unknown);
            reached.before = before;
        }
    }

    /// Goes from a statement on until the flow parts; how many statements that were.
    pub(super) fn run(&mut self, instance: u32, mut at: u32, mut state: State) -> usize {
        let script = self.script;
        let routine = self.instances[instance as usize].routine;
        let range = script.routines[routine as usize].statements.clone();
        let mut visits = 1;
        while at < range.end {
            visits += 1;
            let statement = script.statements[at as usize];
            // a label is visited where its state is gone on with
            self.visited[at as usize] |= !matches!(statement, Statement::Label(_));
            match statement {
                Statement::Move(_) if self.instances[instance as usize].writes_only => {}
                Statement::Move(instruction) => self.go(instance, instruction, at, &mut state),
                Statement::Write(write) => {
                    let write = &script.writes[write as usize];
                    self.write(write, at, &mut state);
                    match write.variable {
                        Written::One(variable) => self.share(instance, variable, &mut state),
                        Written::AnyOf(table) => {
                            for variable in script.tables[table as usize].entries.values() {
                                self.share(instance, *variable, &mut state);
                            }
                        }
                    }
                }
                Statement::Call(number) => {
                    let call = &script.calls[number as usize];
                    self.call(instance, call, at, &mut state);
                    if call.leads {
                        state.led = Some(number);
                        if self.is_concurrent && call.foreign {
                            self.at_any_time.insert((number, Some(routine)));
                        }
                    }
                    let is_idle = |routine: &RoutineId| self.idle[*routine as usize];
                    if !call.callees.iter().all(is_idle) {
                        self.at_calls.insert((instance, at), state);
                        let before = self.behind_call(instance, at);
                        match before {
                            Some(behind) => state = behind,
                            None => return visits,
                        }
                    }
                }
                Statement::Start(number) => {
                    let call = &script.calls[number as usize];
                    self.start(call, at, &state);
                    state.is_alone = false;
                    if call.leads && call.callees.is_empty() && self.dead.is_none() {
                        self.at_any_time.insert((number, None));
                    }
                }
                Statement::Label(label) => {
                    self.arrive(instance, label, &state);
                    return visits;
                }
                Statement::Branch(label) => self.arrive(instance, label, &state),
                Statement::BranchUnless(condition) => {
                    let condition = script.conditions[condition as usize];
                    let (may_be, may_not_be) = self.may_be(&state, condition);
                    if may_not_be {
                        self.arrive(instance, condition.otherwise, &state);
                    }
                    if !may_be {
                        return visits;
                    }
                }
                Statement::Jump(label) => {
                    self.arrive(instance, label, &state);
                    return visits;
                }
                Statement::Enter(number) => self.begin_rounds(number, &mut state),
                Statement::Return | Statement::Exit => break,
                Statement::Raise => {
                    self.raise(instance, &state);
                    return visits;
                }
                Statement::Catch(_) => {}
            }
            at += 1;
        }
        self.leave(instance, &state);
        visits
    }

    pub(super) fn leave(&mut self, instance: u32, state: &State) {
        self.end(instance, state, |of| &mut of.exit);
    }

    /// A routine ends with an error.
    pub(super) fn raise(&mut self, instance: u32, state: &State) {
        self.end(instance, state, |of| &mut of.raised);
    }

    fn end(&mut self, instance: u32, state: &State, of: fn(&mut Instance) -> &mut Option<State>) {
        if self.dead == Some(instance) && self.instances[instance as usize].entry.is_some() {
            return;
        }
        let joined = match of(&mut self.instances[instance as usize]).clone() {
            Some(end) => self.join(&end, state),
            None => state.clone(),
        };
        let end = of(&mut self.instances[instance as usize]);
        if end.as_ref() != Some(&joined) {
            *end = Some(joined);
            for (caller, statement) in self.instances[instance as usize].waiting.clone() {
                self.push(caller, statement, From::Call);
            }
        }
    }

    pub(super) fn go(&mut self, instance: u32, at: u32, site: Site, state: &mut State) {
        let script = self.script;
        let instruction = &script.instructions[at as usize];
        let of = &self.instances[instance as usize];
        let first = script.routines[of.routine as usize].instructions.start;
        let stop = of.first_stop + (at - first);
        let target = match instruction.target {
            Expr::Value(value) => match script.values[value as usize] {
                Held::ActualWith { tool, frame } => {
                    let modal = &script.modals[instruction.modal as usize];
                    // read where it is gone to
                    Some(if (modal.tool, modal.frame) == (tool, frame) {
                        let here = self.here();
                        self.holdings.one(Atom::Value(here), site)
                    } else {
                        self.evaluate(state, instruction.target, site)
                    })
                }
                _ => None,
            },
            Expr::Absent | Expr::Target(_) | Expr::Unknown(_) => None,
            other if self.is_choice(other) => {
                if !self.is_fixed(other) {
                    self.chosen.insert(stop, Rc::clone(&state.holds));
                }
                None
            }
            other => Some(self.evaluate(state, other, site)),
        };
        let modes = match &self.last_modes {
            Some((modal, holds, modes))
                if *modal == instruction.modal && Rc::ptr_eq(holds, &state.holds) =>
            {
                *modes
            }
            _ => self.modes(instruction.modal, site, state),
        };
        let is_live = self.reached[stop as usize].is_some_and(|before| !before.is_dead);
        self.reached[stop as usize] = Some(Reached {
            modes,
            target,
            before: state.before,
            led: state.led.take(),
            is_concurrent: self.is_concurrent,
            is_dead: (self.dead.is_some() || self.is_called_by_dead(instance)) && !is_live,
        });
        state.before = self.sets.one(stop);
    }

    /// What of a guard may say something: flags, numbers and loads leave room for what does.
    fn speaking(&mut self, held: Holding) -> Holding {
        let is_silent = |(atom, _): &(Atom, Site)| match atom {
            Atom::Value(value) => matches!(
                self.value(*value),
                Held::Flag(_)
                    | Held::Number(_)
                    | Held::Load(_)
                    | Held::LoadOf { .. }
                    | Held::Carried(_)
            ),
            _ => false,
        };
        let atoms = self.holdings.of(held);
        if !atoms.iter().any(is_silent) {
            return held;
        }
        let rest = atoms.iter().filter(|atom| !is_silent(atom)).copied();
        let rest = rest.collect();
        self.holdings.intern(rest)
    }

    /// With what a move at a place runs.
    pub(super) fn modes(&mut self, of: ModalId, site: Site, state: &State) -> u32 {
        let script = self.script;
        let modal = &script.modals[of as usize];
        let mut guard = NOTHING;
        for &variable in &*script.guards[modal.guards as usize] {
            let one = self.variable(state, variable);
            let one = self.speaking(one);
            guard = self.holdings.join(guard, one);
        }
        for expected in &*script.expected[modal.expected as usize] {
            if let Some(site) = self.differs(state, expected) {
                let one = self.holdings.one(Atom::Unknown(expected.remark), site);
                guard = self.holdings.join(guard, one);
            }
        }
        let mut is_anywhere = true;
        // what the move itself names is written nowhere else: many moves then hold the same
        let mut held = |value| match value {
            Expr::Absent | Expr::Value(_) | Expr::Target(_) | Expr::Unknown(_) => {
                self.evaluate(state, value, DECLARED)
            }
            Expr::Variable(_) => self.evaluate(state, value, site),
            Expr::Element { .. }
            | Expr::Any { .. }
            | Expr::Displaced { .. }
            | Expr::DisplacedByCall { .. }
            | Expr::Product(_) => {
                is_anywhere = false;
                self.evaluate(state, value, site)
            }
        };
        let modes = Modes {
            tool: held(modal.tool),
            frame: held(modal.frame),
            load: held(modal.load),
            configured: held(modal.configured),
            wrist: held(modal.wrist),
            guard,
        };
        let all = &mut self.modes;
        let id = *self.mode_ids.entry(modes).or_insert_with(|| {
            all.push(modes);
            short(all.len() - 1)
        });
        self.last_modes = is_anywhere.then(|| (of, Rc::clone(&state.holds), id));
        id
    }

    /// Whether an expression is one of several, displaced or not: the resolver looks at each of
    /// them.
    pub(super) fn is_choice(&self, value: Expr) -> bool {
        match value {
            Expr::Any { .. } => true,
            Expr::Displaced { base, .. } | Expr::DisplacedByCall { base, .. } => {
                self.is_choice(self.script.lists[base as usize])
            }
            _ => false,
        }
    }

    /// What a variable holds at a stop that goes to one of several positions.
    pub(in crate::motion) fn chosen_at(&mut self, stop: Stop, variable: VariableId) -> Holding {
        let held = match (self.slots[variable as usize], self.chosen.get(&stop)) {
            (Some(slot), Some(holds)) => holds[slot as usize],
            _ => self.fixed[variable as usize],
        };
        match self.anytime.get(&variable) {
            Some(&also) => self.holdings.join(held, also),
            None => held,
        }
    }

    /// Where a variable was given the number that it certainly holds in the place of the one that a
    /// move expects.
    pub(super) fn differs(&mut self, state: &State, expected: &Expected) -> Option<Site> {
        let held = self.variable(state, expected.variable);
        let atoms = self.holdings.of(held);
        let is_other = |atom: &Atom| {
            matches!(atom, Atom::Value(value)
                if matches!(self.value(*value), Held::Number(number) if *number != expected.number))
        };
        let (_, site) = atoms.first()?;
        atoms
            .iter()
            .all(|(atom, _)| is_other(atom))
            .then_some(*site)
    }

    /// Whether a variable may hold what a branch depends on, and whether it may hold something
    /// else; both where nothing is known of it, and in text that nothing reaches.
    fn may_be(&self, state: &State, condition: Condition) -> (bool, bool) {
        let (variable, wanted) = condition.test;
        let held = match self.slots[variable as usize] {
            Some(slot) => state.holds[slot as usize],
            None => self.fixed[variable as usize],
        };
        let atoms = self.holdings.of(held);
        let holds = |atom: &Atom| match atom {
            Atom::Value(value) => match (self.value(*value), wanted) {
                (Held::Flag(flag), Wanted::Flag(wanted)) => Some(*flag == wanted),
                (Held::Number(number), Wanted::Number(wanted)) => Some(*number == wanted),
                (Held::Number(number), Wanted::NotNumber(other)) => Some(*number != other),
                _ => None,
            },
            _ => None,
        };
        let may = |is: bool| {
            atoms.is_empty() || self.dead.is_some() || {
                let mut all = atoms.iter();
                all.any(|(atom, _)| holds(atom).is_none_or(|holds| holds == is))
            }
        };
        (may(true), may(false))
    }

    /// Whether an expression says the same whatever was before.
    pub(super) fn is_fixed(&self, value: Expr) -> bool {
        match value {
            Expr::Absent | Expr::Target(_) | Expr::Value(_) | Expr::Unknown(_) => true,
            Expr::Variable(variable) => {
                self.slots[variable as usize].is_none() && !self.anytime.contains_key(&variable)
            }
            Expr::Element { .. } => false,
            Expr::Displaced { base, .. } => self.is_fixed(self.script.lists[base as usize]),
            Expr::DisplacedByCall { base, by } => {
                let call = self.script.by_calls[by as usize].call;
                self.is_fixed(self.script.lists[base as usize])
                    && self.is_fixed(Expr::Variable(call))
            }
            Expr::Any { first, end } => self.script.lists[first as usize..end as usize]
                .iter()
                .all(|inner| self.is_fixed(*inner)),
            Expr::Product(product) => self.script.products[product as usize]
                .factors
                .iter()
                .all(|factor| self.is_fixed(*factor)),
        }
    }
}
