//! What holds at each move and which moves come before it, whichever way the program runs.
//!
//! Forward data flow to a fixed point over the statements of all routines. A routine is gone
//! through once for each call of it, up to a depth; beyond, and where routines call themselves, its
//! callers are joined. What variables hold is a [`Holding`], where the robot comes from a
//! [`Before`]; both only grow, so that it ends.
//!
//! # Source
//! G. A. Kildall, "A unified approach to global program optimization" (1973).

use super::before::{ANYWHERE, Before, START, Sets, Stop};
use super::holding::{Atom, DECLARED, Holding, Holdings, NOTHING, Site};
use super::readers::read_elsewhere;
use crate::program::script::{
    Argument, Call, DISPLACED_SOMEHOW, Expected, Expr, Held, How, Label, ModalId, NOT_DISPLACED,
    OVERWRITTEN, Part, PartValue, RoutineId, Script, Start, Statement, TableId, ValueId,
    VariableId, Write, Written, short,
};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};
use std::collections::BinaryHeap;
use std::rc::Rc;

/// Calls inside calls that are distinguished.
const DEEPEST: u32 = 6;
/// Statements of all instances of routines: so many times those of the script, and so many more.
const MOST_TIMES: usize = 3;
const MOST_MORE: usize = 20_000;
/// Times that what is kept from run to run, or written at any time, is gone through.
const MOST_ROUNDS: usize = 8;
/// Entries of a table that all its writes by unknown numbers may reach; beyond, they hold anywhere.
const MOST_WRITES: usize = 1_000_000;
/// Statements gone through, times those of the instances, after which the flow gives up.
const MOST_VISITS: usize = 200;

/// No caller, or several.
const NO_INSTANCE: u32 = u32::MAX;

/// What holds where a move begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reached {
    /// Index in [`Flow::modes`].
    pub modes: u32,
    /// `None` where the instruction's own expression says it whatever was before.
    pub target: Option<Holding>,
    pub before: Before,
}

/// With what a move runs, whichever way the program came to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Modes {
    pub tool: Holding,
    pub frame: Holding,
    pub load: Holding,
    pub configured: Holding,
    pub wrist: Holding,
    /// What speaks against the move.
    pub guard: Holding,
}

/// A routine as one call of it runs.
#[derive(Debug)]
struct Instance {
    routine: RoutineId,
    depth: u32,
    /// Instance that calls it; [`NO_INSTANCE`] where several or none do.
    caller: u32,
    /// Stop of its first move.
    first_stop: Stop,
    entry: Option<State>,
    exit: Option<State>,
    /// Calls that wait for its end: instance and statement.
    waiting: Vec<(u32, u32)>,
}

#[derive(Clone, Debug, PartialEq)]
struct State {
    /// By slot of the variables that are tracked.
    holds: Rc<Vec<Holding>>,
    before: Before,
}

/// Where to go on, the deepest routine first and there the first statement: [`BinaryHeap`] gives
/// the largest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Item {
    depth: u32,
    /// Counted down from the last one.
    statement: std::cmp::Reverse<u32>,
    instance: u32,
    from: From,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum From {
    Entry,
    Label(Label),
    Call,
    /// Text that nothing reaches.
    Dead,
}

/// The name of a record and what its parts are.
type Content = (Box<str>, Vec<(u8, u64)>);

/// What a part is, to compare.
fn bits(value: PartValue) -> (u8, u64) {
    match value {
        PartValue::Number(number) => (0, number.to_bits()),
        PartValue::Flag(flag) => (1, flag.into()),
        PartValue::Text { empty } => (2, empty.into()),
        PartValue::Missing => (3, 0),
        PartValue::Computed => (4, 0),
    }
}

/// The flow through a script.
pub(super) struct Flow<'a> {
    script: &'a Script,
    pub holdings: Holdings,
    pub sets: Sets,
    /// Values that writes of parts made, behind those of the script.
    pub made: Vec<Held>,
    more_parts: Vec<Part>,
    made_parts: HashMap<(ValueId, u32, u32), Option<ValueId>>,
    /// Records that writes of parts made, by what is in them: what comes round again is the same.
    made_records: HashMap<Content, ValueId>,
    /// Slots of the variables of each routine's own.
    locals: HashMap<RoutineId, Vec<u32>>,
    /// The slot of each variable that is tracked.
    slots: Vec<Option<u32>>,
    /// What the others hold.
    fixed: Vec<Holding>,
    /// Variables in slots.
    tracked: Vec<VariableId>,
    /// Tables that are written at so many places by numbers that only the running program knows,
    /// that what is written holds anywhere.
    loose: HashSet<TableId>,
    /// What routines that run at any time may write, by variable.
    anytime: HashMap<VariableId, Holding>,
    label_places: Vec<u32>,
    instances: Vec<Instance>,
    by_call: HashMap<(u32, u32, RoutineId), u32>,
    merged: HashMap<RoutineId, u32>,
    at_labels: HashMap<(u32, Label), (State, bool)>,
    at_calls: HashMap<(u32, u32), State>,
    work: BinaryHeap<Item>,
    visited: Vec<bool>,
    /// Statements of all instances.
    size: usize,
    /// By stop.
    pub reached: Vec<Option<Reached>>,
    /// With what moves run, each once.
    pub modes: Vec<Modes>,
    mode_ids: HashMap<Modes, u32>,
    /// Those of the last move, for a move with the same words where variables hold the same.
    last_modes: Option<(ModalId, Rc<Vec<Holding>>, u32)>,
    /// What variables hold where a move goes to one of several positions.
    chosen: HashMap<Stop, Rc<Vec<Holding>>>,
    /// Instruction of each stop.
    pub instructions: Vec<u32>,
    /// Targets that are given to routines that are not in the files, and the call's statement.
    pub given_away: Vec<(u32, Site)>,
    /// Where variables are written in routines that nothing in the files calls.
    pub by_operator: Vec<(VariableId, Site)>,
    is_concurrent: bool,
    /// With what routines are started concurrently with others.
    started: HashMap<RoutineId, State>,
    /// What those that start others write, by variable.
    concurrent: HashMap<VariableId, Holding>,
    /// The instance whose text is gone through that nothing reaches.
    dead: Option<u32>,
}

impl<'a> Flow<'a> {
    /// Follows a script.
    pub(super) fn of(script: &'a Script) -> Self {
        let mut label_places = vec![u32::MAX; script.labels as usize];
        for (at, statement) in script.statements.iter().enumerate() {
            if let Statement::Label(label) = statement {
                label_places[*label as usize] = short(at);
            }
        }
        let mut flow = Self {
            script,
            holdings: Holdings::new(),
            sets: Sets::new(),
            made: Vec::new(),
            more_parts: Vec::new(),
            made_parts: HashMap::new(),
            made_records: HashMap::new(),
            locals: HashMap::new(),
            slots: Vec::new(),
            fixed: Vec::new(),
            tracked: Vec::new(),
            loose: HashSet::new(),
            anytime: HashMap::new(),
            label_places,
            instances: Vec::new(),
            by_call: HashMap::new(),
            merged: HashMap::new(),
            at_labels: HashMap::new(),
            at_calls: HashMap::new(),
            work: BinaryHeap::new(),
            visited: vec![false; script.statements.len()],
            size: 0,
            reached: Vec::new(),
            modes: Vec::new(),
            mode_ids: HashMap::new(),
            last_modes: None,
            chosen: HashMap::new(),
            instructions: Vec::new(),
            given_away: Vec::new(),
            by_operator: Vec::new(),
            is_concurrent: false,
            started: HashMap::new(),
            concurrent: HashMap::new(),
            dead: None,
        };
        flow.track();
        for _ in 0..MOST_ROUNDS {
            let before = (
                flow.started.clone(),
                flow.concurrent.clone(),
                flow.anytime.clone(),
            );
            flow.forget();
            flow.run_concurrent();
            flow.run_entries();
            if flow.started.is_empty()
                || before
                    == (
                        flow.started.clone(),
                        flow.concurrent.clone(),
                        flow.anytime.clone(),
                    )
            {
                break;
            }
        }
        flow.run_dead();
        flow.given_away.sort_unstable();
        flow.given_away.dedup();
        flow
    }

    /// The value of an identifier, the flow's own included.
    pub(super) fn value(&self, value: ValueId) -> &Held {
        let at = value as usize;
        let own = self.script.values.len();
        if at < own {
            &self.script.values[at]
        } else {
            &self.made[at - own]
        }
    }

    // ---- variables

    /// Decides which variables are tracked: those with more than one thing to hold.
    fn track(&mut self) {
        let script = self.script;
        let count = script.variables.len();
        let mut writes: Vec<(u32, Site)> = vec![(0, DECLARED); count];
        let mut whole: Vec<Option<Expr>> = vec![None; count];
        let mut any: HashMap<TableId, usize> = HashMap::new();
        for (at, statement) in script.statements.iter().enumerate() {
            let mut note = |variable: VariableId, value: Option<Expr>| {
                let (n, site) = &mut writes[variable as usize];
                *n += 1;
                *site = short(at);
                whole[variable as usize] = value;
            };
            match statement {
                Statement::Write(write) => {
                    let write = &script.writes[*write as usize];
                    match (write.variable, &write.how) {
                        (Written::One(variable), How::Whole(value)) => note(variable, Some(*value)),
                        (Written::One(variable), _) => note(variable, None),
                        (Written::AnyOf(table), _) => *any.entry(table).or_insert(0_usize) += 1,
                    }
                }
                Statement::Call(call) | Statement::Start(call) => {
                    let call = &script.calls[*call as usize];
                    for argument in self.arguments(call) {
                        for variable in [argument.parameter, argument.back].into_iter().flatten() {
                            note(variable, None);
                        }
                    }
                    if call.foreign {
                        // shared variables are uncertain behind it
                        for (variable, _) in script
                            .variables
                            .iter()
                            .enumerate()
                            .filter(|(_, v)| v.shared)
                        {
                            writes[variable].0 += 1;
                            whole[variable] = None;
                        }
                    }
                }
                _ => {}
            }
        }
        for (table, times) in any {
            let entries = &script.tables[table as usize].entries;
            let is_loose = times.saturating_mul(entries.len()) > MOST_WRITES;
            for &variable in entries.values() {
                writes[variable as usize].0 += 2;
                whole[variable as usize] = None;
                if is_loose {
                    let changed = self.changed(variable);
                    let changed = self.holdings.one(changed, DECLARED);
                    self.anytime.insert(variable, changed);
                }
            }
            if is_loose {
                self.loose.insert(table);
            }
        }
        for variable in 0..count {
            let declared = script.variables[variable].declared;
            let (n, site) = writes[variable];
            // written once, as a whole, from nothing: whoever reads it reads that
            let once = match (n, whole[variable]) {
                (0, _) => Some((declared, DECLARED)),
                (1, Some(value @ (Expr::Target(_) | Expr::Value(_))))
                    if declared == Expr::Absent =>
                {
                    Some((value, site))
                }
                _ => None,
            };
            if let Some((value, site)) = once {
                let holding = self.constant(value, site);
                self.fixed.push(holding);
                self.slots.push(None);
            } else {
                self.fixed.push(NOTHING);
                let slot = short(self.tracked.len());
                self.slots.push(Some(slot));
                self.tracked.push(short(variable));
                if let Some(routine) = self.script.variables[variable].routine {
                    self.locals.entry(routine).or_default().push(slot);
                }
            }
        }
    }

    /// What an expression without variables that are written holds; of one with such variables
    /// their declarations.
    fn constant(&mut self, value: Expr, site: Site) -> Holding {
        match value {
            Expr::Variable(variable) if (variable as usize) < self.fixed.len() => {
                if self.slots[variable as usize].is_none() {
                    self.fixed[variable as usize]
                } else {
                    let declared = self.script.variables[variable as usize].declared;
                    self.constant(declared, site)
                }
            }
            Expr::Variable(variable) => {
                let declared = self.script.variables[variable as usize].declared;
                if matches!(declared, Expr::Variable(_)) {
                    return NOTHING;
                }
                self.constant(declared, site)
            }
            other => self.plain(other, site, &mut |flow, inner| flow.constant(inner, site)),
        }
    }

    /// What an expression holds; `of_variable` gives it for a variable.
    fn plain(
        &mut self,
        value: Expr,
        site: Site,
        of_variable: &mut dyn FnMut(&mut Self, Expr) -> Holding,
    ) -> Holding {
        let script = self.script;
        match value {
            Expr::Absent => NOTHING,
            Expr::Target(target) => {
                let atom = Atom::Target {
                    target: short(target),
                    displacement: NOT_DISPLACED,
                };
                self.holdings.one(atom, site)
            }
            Expr::Value(value) => self.holdings.one(Atom::Value(value), site),
            Expr::Unknown(remark) => self.holdings.one(Atom::Unknown(remark), site),
            Expr::Any { first, end } => {
                let mut all = NOTHING;
                for inner in &script.lists[first as usize..end as usize] {
                    let one = of_variable(self, *inner);
                    all = self.holdings.join(all, one);
                }
                all
            }
            Expr::Displaced { base, by } => {
                let base = of_variable(self, script.lists[base as usize]);
                let atoms = self.holdings.of(base).to_vec();
                let displaced = atoms.into_iter().map(|(atom, site)| {
                    let atom = match atom {
                        Atom::Target {
                            target,
                            displacement: NOT_DISPLACED,
                        } => Atom::Target {
                            target,
                            displacement: by,
                        },
                        Atom::Target {
                            target,
                            displacement,
                        } => Atom::Target {
                            target,
                            displacement: if displacement == OVERWRITTEN {
                                OVERWRITTEN
                            } else {
                                DISPLACED_SOMEHOW
                            },
                        },
                        // except where the robot itself was, nothing is as it is
                        Atom::Value(value) if *self.value(value) == Held::Actual => Atom::Anything,
                        other => other,
                    };
                    (atom, site)
                });
                let displaced = displaced.collect();
                self.holdings.intern(displaced)
            }
            Expr::Variable(_) => of_variable(self, value),
            Expr::Element { table, number } => {
                let numbers = of_variable(self, Expr::Variable(number));
                let mut all = NOTHING;
                for (atom, site) in self.holdings.of(numbers).to_vec() {
                    let entry = match atom {
                        Atom::Value(value) => match self.value(value) {
                            Held::Number(number) => {
                                script.tables[table as usize].entries.get(number).copied()
                            }
                            _ => None,
                        },
                        _ => None,
                    };
                    let one = match entry {
                        Some(variable) => {
                            let held = of_variable(self, Expr::Variable(variable));
                            // the selection is what a message names
                            let atoms = self.holdings.of(held).to_vec();
                            let placed = atoms
                                .into_iter()
                                .map(|(atom, of)| (atom, if of == DECLARED { site } else { of }));
                            self.holdings.intern(placed.collect())
                        }
                        None => self.holdings.one(atom, site),
                    };
                    all = self.holdings.join(all, one);
                }
                all
            }
        }
    }

    fn variable(&mut self, state: &State, variable: VariableId) -> Holding {
        let held = match self.slots[variable as usize] {
            Some(slot) => state.holds[slot as usize],
            None => self.fixed[variable as usize],
        };
        match self.anytime.get(&variable) {
            Some(&also) => self.holdings.join(held, also),
            None => held,
        }
    }

    /// What an expression holds in a state.
    fn evaluate(&mut self, state: &State, value: Expr, site: Site) -> Holding {
        match value {
            Expr::Variable(variable) => self.variable(state, variable),
            other => self.plain(other, site, &mut |flow, inner| {
                flow.evaluate(state, inner, site)
            }),
        }
    }

    fn set(&mut self, state: &mut State, variable: VariableId, holding: Holding) {
        self.last_modes = None;
        if self.is_concurrent {
            let before = self.anytime.get(&variable).copied().unwrap_or(NOTHING);
            let joined = self.holdings.join(before, holding);
            self.anytime.insert(variable, joined);
        } else if !self.started.is_empty() {
            let before = self.concurrent.get(&variable).copied().unwrap_or(NOTHING);
            let joined = self.holdings.join(before, holding);
            self.concurrent.insert(variable, joined);
        }
        if let Some(slot) = self.slots[variable as usize]
            && state.holds[slot as usize] != holding
        {
            Rc::make_mut(&mut state.holds)[slot as usize] = holding;
        }
    }

    // ---- statements

    fn arguments(&self, call: &Call) -> &'a [Argument] {
        &self.script.arguments[call.arguments.start as usize..call.arguments.end as usize]
    }

    fn declared_state(&mut self, before: Stop) -> State {
        let holds = (0..self.tracked.len())
            .map(|slot| {
                let declared = self.script.variables[self.tracked[slot] as usize].declared;
                self.constant(declared, DECLARED)
            })
            .collect();
        State {
            holds: Rc::new(holds),
            before: self.sets.one(before),
        }
    }

    fn join(&mut self, a: &State, b: &State) -> State {
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
        }
    }

    fn instance(&mut self, routine: RoutineId, depth: u32, caller: u32) -> u32 {
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
            entry: None,
            exit: None,
            waiting: Vec::new(),
        });
        short(self.instances.len() - 1)
    }

    /// The instance of a routine for a call.
    fn called(&mut self, caller: u32, statement: u32, routine: RoutineId) -> u32 {
        let key = (caller, statement, routine);
        if let Some(&known) = self.by_call.get(&key) {
            return known;
        }
        let depth = self.instances[caller as usize].depth + 1;
        let mut chain = caller;
        let mut is_recursive = false;
        while chain != NO_INSTANCE {
            is_recursive |= self.instances[chain as usize].routine == routine;
            chain = self.instances[chain as usize].caller;
        }
        let most = MOST_TIMES * self.script.statements.len() + MOST_MORE;
        let length = self.script.routines[routine as usize].statements.len();
        let is_own = depth <= DEEPEST && !is_recursive && self.size + length <= most;
        let made = if is_own {
            self.instance(routine, depth, caller)
        } else if let Some(&known) = self.merged.get(&routine) {
            known
        } else {
            let made = self.instance(routine, DEEPEST + 1, NO_INSTANCE);
            self.merged.insert(routine, made);
            made
        };
        self.by_call.insert(key, made);
        made
    }

    fn push(&mut self, instance: u32, statement: u32, from: From) {
        self.work.push(Item {
            depth: self.instances[instance as usize].depth,
            statement: std::cmp::Reverse(statement),
            instance,
            from,
        });
    }

    /// Joins a state into the beginning of an instance.
    fn enter(&mut self, instance: u32, state: &State) {
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

    fn arrive(&mut self, instance: u32, label: Label, state: &State) {
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

    fn run_work(&mut self) {
        let mut visits = 0_usize;
        while let Some(item) = self.work.pop() {
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
    fn give_up(&mut self) {
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
    fn run(&mut self, instance: u32, mut at: u32, mut state: State) -> usize {
        let script = self.script;
        let routine = self.instances[instance as usize].routine;
        let range = script.routines[routine as usize].statements.clone();
        let mut visits = 1;
        while at < range.end {
            self.visited[at as usize] = true;
            visits += 1;
            match script.statements[at as usize] {
                Statement::Move(instruction) => self.go(instance, instruction, at, &mut state),
                Statement::Write(write) => {
                    self.write(&script.writes[write as usize], at, &mut state);
                }
                Statement::Call(call) => {
                    let call = &script.calls[call as usize];
                    self.call(instance, call, at, &mut state);
                    if !call.callees.is_empty() {
                        self.at_calls.insert((instance, at), state);
                        let before = self.behind_call(instance, at);
                        match before {
                            Some(behind) => state = behind,
                            None => return visits,
                        }
                    }
                }
                Statement::Start(call) => {
                    self.start(&script.calls[call as usize], at, &state);
                }
                Statement::Label(label) => {
                    self.arrive(instance, label, &state);
                    return visits;
                }
                Statement::Branch(label) => self.arrive(instance, label, &state),
                Statement::Jump(label) => {
                    self.arrive(instance, label, &state);
                    return visits;
                }
                Statement::Return | Statement::Exit => break,
            }
            at += 1;
        }
        self.leave(instance, &state);
        visits
    }

    fn leave(&mut self, instance: u32, state: &State) {
        if self.dead == Some(instance) && self.instances[instance as usize].entry.is_some() {
            return;
        }
        let joined = match &self.instances[instance as usize].exit {
            Some(exit) => {
                let exit = exit.clone();
                self.join(&exit, state)
            }
            None => state.clone(),
        };
        let of = &mut self.instances[instance as usize];
        if of.exit.as_ref() != Some(&joined) {
            of.exit = Some(joined);
            for (caller, statement) in of.waiting.clone() {
                self.push(caller, statement, From::Call);
            }
        }
    }

    fn go(&mut self, instance: u32, at: u32, site: Site, state: &mut State) {
        let script = self.script;
        let instruction = &script.instructions[at as usize];
        let of = &self.instances[instance as usize];
        let first = script.routines[of.routine as usize].instructions.start;
        let stop = of.first_stop + (at - first);
        let target = match instruction.target {
            Expr::Absent | Expr::Target(_) | Expr::Value(_) | Expr::Unknown(_) => None,
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
        self.reached[stop as usize] = Some(Reached {
            modes,
            target,
            before: state.before,
        });
        state.before = self.sets.one(stop);
    }

    /// With what a move at a place runs.
    fn modes(&mut self, of: ModalId, site: Site, state: &State) -> u32 {
        let script = self.script;
        let modal = &script.modals[of as usize];
        let mut guard = NOTHING;
        for &variable in &*script.guards[modal.guards as usize] {
            let one = self.variable(state, variable);
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
            Expr::Element { .. } | Expr::Any { .. } | Expr::Displaced { .. } => {
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
    fn is_choice(&self, value: Expr) -> bool {
        match value {
            Expr::Any { .. } => true,
            Expr::Displaced { base, .. } => self.is_choice(self.script.lists[base as usize]),
            _ => false,
        }
    }

    /// What a variable holds at a stop that goes to one of several positions.
    pub(super) fn chosen_at(&mut self, stop: Stop, variable: VariableId) -> Holding {
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
    fn differs(&mut self, state: &State, expected: &Expected) -> Option<Site> {
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

    /// Whether an expression says the same whatever was before.
    fn is_fixed(&self, value: Expr) -> bool {
        match value {
            Expr::Absent | Expr::Target(_) | Expr::Value(_) | Expr::Unknown(_) => true,
            Expr::Variable(variable) => {
                self.slots[variable as usize].is_none() && !self.anytime.contains_key(&variable)
            }
            Expr::Element { .. } => false,
            Expr::Displaced { base, .. } => self.is_fixed(self.script.lists[base as usize]),
            Expr::Any { first, end } => self.script.lists[first as usize..end as usize]
                .iter()
                .all(|inner| self.is_fixed(*inner)),
        }
    }

    fn write(&mut self, write: &Write, site: Site, state: &mut State) {
        match write.variable {
            Written::One(variable) => {
                let holding = self.written(write, variable, site, state);
                self.set(state, variable, holding);
            }
            Written::AnyOf(table) if self.loose.contains(&table) => {}
            Written::AnyOf(table) => {
                for variable in self.script.tables[table as usize].entries.values() {
                    let held = self.variable(state, *variable);
                    if !matches!(write.how, How::Whole(_)) && self.is_in_parts(held, *variable) {
                        continue;
                    }
                    let holding = self.written(write, *variable, site, state);
                    let either = self.holdings.join(held, holding);
                    self.set(state, *variable, either);
                }
            }
        }
    }

    /// What a variable holds that something may have written: its own position with other numbers,
    /// or anything.
    fn changed(&self, variable: VariableId) -> Atom {
        match self.script.variables[variable as usize].declared {
            Expr::Target(target) => Atom::Changed {
                target: short(target),
            },
            _ => Atom::Anything,
        }
    }

    /// Whether a variable holds its own target, of which some parts may be written over: once more
    /// changes nothing.
    fn is_in_parts(&self, held: Holding, variable: VariableId) -> bool {
        let Expr::Target(own) = self.script.variables[variable as usize].declared else {
            return false;
        };
        let atoms = self.holdings.of(held).iter().map(|(atom, _)| *atom);
        let own = short(own);
        atoms
            .clone()
            .any(|atom| atom == Atom::Changed { target: own })
            && atoms.clone().all(|atom| match atom {
                Atom::Changed { target } => target == own,
                Atom::Target {
                    target,
                    displacement,
                } => target == own && displacement == NOT_DISPLACED,
                _ => false,
            })
    }

    /// What a variable holds behind a write.
    fn written(
        &mut self,
        write: &Write,
        variable: VariableId,
        site: Site,
        state: &State,
    ) -> Holding {
        let (first, parts, somehow) = match &write.how {
            How::Whole(value) => {
                let held = self.evaluate(state, *value, site);
                let atoms = self.holdings.of(held).to_vec();
                // of a copy the write that made it another tells more than the copying
                let is_copy = matches!(value, Expr::Variable(_) | Expr::Element { .. });
                let here = atoms
                    .into_iter()
                    .map(|(atom, of)| match of {
                        of if is_copy && of != DECLARED => (atom, of),
                        _ => (atom, site),
                    })
                    .collect();
                return self.holdings.intern(here);
            }
            How::Parts { first, parts } => (*first, parts.clone(), None),
            How::PartSomehow(remark) | How::PartNumber(remark) => (0, 0..0, Some(*remark)),
        };
        let own = match self.script.variables[variable as usize].declared {
            Expr::Target(target) => Some(short(target)),
            _ => None,
        };
        // numbers of the text do not know of a correction; what is computed is mostly the old value
        // and something more
        let by = if matches!(write.how, How::PartNumber(_)) {
            OVERWRITTEN
        } else {
            DISPLACED_SOMEHOW
        };
        let held = self.variable(state, variable);
        let atoms = self.holdings.of(held).to_vec();
        let mut changed = Vec::with_capacity(atoms.len());
        for (atom, _) in atoms {
            let atom = match atom {
                Atom::Target { target, .. } if own == Some(target) => Atom::Changed { target },
                Atom::Target { target, .. } => Atom::Target {
                    target,
                    displacement: by,
                },
                Atom::Value(value) => match somehow {
                    Some(remark) => Atom::Unknown(remark),
                    None => self
                        .with_parts(value, first, parts.clone())
                        .map_or(atom, Atom::Value),
                },
                other => other,
            };
            changed.push((atom, site));
        }
        self.holdings.intern(changed)
    }

    /// A record with other parts; `None` where it is none.
    fn with_parts(
        &mut self,
        value: ValueId,
        first: u32,
        parts: std::ops::Range<u32>,
    ) -> Option<ValueId> {
        let key = (value, first, parts.start);
        if let Some(known) = self.made_parts.get(&key) {
            return *known;
        }
        let made = self.make_record(value, first, parts);
        self.made_parts.insert(key, made);
        made
    }

    fn make_record(
        &mut self,
        value: ValueId,
        first: u32,
        parts: std::ops::Range<u32>,
    ) -> Option<ValueId> {
        let Held::Record {
            name,
            parts: old,
            on,
        } = self.value(value).clone()
        else {
            return None;
        };
        let script = self.script;
        let mut all = self.parts_of(&old);
        let end = first as usize + parts.len();
        if all.len() < end {
            let place = script.parts[parts.start as usize].place;
            all.resize(
                end,
                Part {
                    value: PartValue::Missing,
                    place,
                    length: 0,
                },
            );
        }
        all[first as usize..end]
            .copy_from_slice(&script.parts[parts.start as usize..parts.end as usize]);
        let before = self.parts_of(&old);
        let same =
            before.len() == all.len() && before.iter().zip(&all).all(|(a, b)| a.value == b.value);
        if same {
            return Some(value);
        }
        let content = (
            name.clone(),
            all.iter().map(|part| bits(part.value)).collect(),
        );
        if let Some(&known) = self.made_records.get(&content) {
            return Some(known);
        }
        let start = short(script.parts.len() + self.more_parts.len());
        self.more_parts.extend(all);
        let end = short(script.parts.len() + self.more_parts.len());
        self.made.push(Held::Record {
            name,
            parts: start..end,
            on,
        });
        let made = short(script.values.len() + self.made.len() - 1);
        self.made_records.insert(content, made);
        Some(made)
    }

    /// The parts of a record.
    pub(super) fn parts_of(&self, parts: &std::ops::Range<u32>) -> Vec<Part> {
        let own = short(self.script.parts.len());
        let (list, by) = if parts.start < own || parts.is_empty() {
            (&self.script.parts, 0)
        } else {
            (&self.more_parts, own)
        };
        list[(parts.start - by) as usize..(parts.end - by) as usize].to_vec()
    }

    // ---- calls

    /// What a call itself does before it goes anywhere: arguments are given away, what is shared is
    /// uncertain.
    fn call(&mut self, instance: u32, call: &Call, site: Site, state: &mut State) {
        let _ = instance;
        if !call.foreign {
            return;
        }
        for argument in self.arguments(call) {
            let held = self.evaluate(state, argument.value, site);
            for (atom, _) in self.holdings.of(held).to_vec() {
                if let Atom::Target { target, .. } | Atom::Changed { target } = atom {
                    self.given_away.push((target, site));
                }
            }
            if let Some(variable) = argument.back.filter(|_| call.callees.is_empty()) {
                let own = self.changed(variable);
                let changed = self.holdings.one(own, site);
                self.set(state, variable, changed);
            }
        }
        let uncertain = self.holdings.one(Atom::Uncertain, site);
        for variable in 0..self.script.variables.len() {
            if self.script.variables[variable].shared
                && let Some(slot) = self.slots[variable]
            {
                let held = state.holds[slot as usize];
                let joined = self.holdings.join(held, uncertain);
                Rc::make_mut(&mut state.holds)[slot as usize] = joined;
            }
        }
    }

    /// The state behind a call, as far as the routines that it calls have come; `None` where none
    /// has come to its end.
    fn behind_call(&mut self, instance: u32, statement: u32) -> Option<State> {
        let Statement::Call(call) = self.script.statements[statement as usize] else {
            return None;
        };
        let call = &self.script.calls[call as usize];
        let start = self.at_calls.get(&(instance, statement))?.clone();
        let mut behind = call.foreign.then(|| start.clone());
        for &routine in &*call.callees {
            let callee = self.called(instance, statement, routine);
            let entry = self.entry_of(call, routine, statement, &start);
            let waiting = &mut self.instances[callee as usize].waiting;
            if !waiting.contains(&(instance, statement)) {
                waiting.push((instance, statement));
            }
            self.enter(callee, &entry);
            let Some(exit) = self.instances[callee as usize].exit.clone() else {
                continue;
            };
            let back = self.back_from(&start, &exit, call, routine, instance);
            behind = Some(match behind {
                Some(other) => self.join(&other, &back),
                None => back,
            });
        }
        behind
    }

    /// The state in which a call enters a routine: what it is given is bound.
    fn entry_of(&mut self, call: &Call, routine: RoutineId, site: Site, start: &State) -> State {
        let mut entry = start.clone();
        for argument in self.arguments(call) {
            if let Some(parameter) = argument.parameter
                && self.script.variables[parameter as usize].routine == Some(routine)
            {
                let held = self.evaluate(start, argument.value, site);
                self.set(&mut entry, parameter, held);
            }
        }
        entry
    }

    /// Notes with what routines are started that then run concurrently with the others.
    fn start(&mut self, call: &Call, site: Site, state: &State) {
        for &routine in &*call.callees {
            let mut entry = self.entry_of(call, routine, site, state);
            entry.before = self.sets.one(ANYWHERE);
            if let Some(before) = self.started.get(&routine).cloned() {
                entry = self.join(&before, &entry);
            }
            self.started.insert(routine, entry);
        }
    }

    /// The state that a routine leaves, with the caller's own variables as they were.
    fn back_from(
        &mut self,
        start: &State,
        exit: &State,
        call: &Call,
        routine: RoutineId,
        instance: u32,
    ) -> State {
        let mut back = exit.clone();
        let caller = self.instances[instance as usize].routine;
        if let Some(own) = self.locals.get(&caller) {
            for &slot in own {
                let before = start.holds[slot as usize];
                if back.holds[slot as usize] != before {
                    Rc::make_mut(&mut back.holds)[slot as usize] = before;
                }
            }
        }
        for argument in self.arguments(call) {
            if let (Some(parameter), Some(variable)) = (argument.parameter, argument.back)
                && self.script.variables[parameter as usize].routine == Some(routine)
                && self.slots[parameter as usize].is_some()
            {
                let held = self.variable(exit, parameter);
                let written = self.come_back(held, variable);
                self.set(&mut back, variable, written);
            }
        }
        back
    }

    /// What a variable holds that was given by reference: of its own position parts may have been
    /// written.
    fn come_back(&mut self, held: Holding, variable: VariableId) -> Holding {
        let Expr::Target(own) = self.script.variables[variable as usize].declared else {
            return held;
        };
        let part_written = [DISPLACED_SOMEHOW, OVERWRITTEN].map(|displacement| Atom::Target {
            target: short(own),
            displacement,
        });
        let mut atoms = self.holdings.of(held).to_vec();
        if atoms.iter().all(|(atom, _)| !part_written.contains(atom)) {
            return held;
        }
        for (atom, _) in &mut atoms {
            if part_written.contains(atom) {
                *atom = Atom::Changed { target: short(own) };
            }
        }
        self.holdings.intern(atoms)
    }

    // ---- where programs start

    /// Routines that run at any time: what they write, others may find at any place.
    fn run_concurrent(&mut self) {
        let routines = self.script.routines.iter().enumerate();
        let concurrent: Vec<RoutineId> = routines
            .filter(|(_, routine)| routine.start == Start::Concurrent)
            .map(|(at, _)| short(at))
            .collect();
        if concurrent.is_empty() {
            return;
        }
        let mut by_others = vec![false; self.script.routines.len()];
        for statement in &self.script.statements {
            if let Statement::Start(call) = statement {
                for &routine in &*self.script.calls[*call as usize].callees {
                    by_others[routine as usize] = true;
                }
            }
        }
        self.is_concurrent = true;
        for _ in 0..MOST_ROUNDS {
            let before = self.anytime.clone();
            self.forget();
            let declared = self.declared_state(ANYWHERE);
            for &routine in &concurrent {
                let state = match self.started.get(&routine).cloned() {
                    Some(state) => self.with_concurrent(state),
                    // nothing has been seen to start it yet
                    None if by_others[routine as usize] => continue,
                    None => declared.clone(),
                };
                let instance = self.instance(routine, 0, NO_INSTANCE);
                self.enter(instance, &state);
            }
            self.run_work();
            if self.anytime == before {
                break;
            }
        }
        self.is_concurrent = false;
    }

    /// A state in which all that others write meanwhile may hold.
    fn with_concurrent(&mut self, mut state: State) -> State {
        let mut holds = state.holds.to_vec();
        for (variable, &written) in &self.concurrent {
            if let Some(slot) = self.slots[*variable as usize] {
                let slot = slot as usize;
                holds[slot] = self.holdings.join(holds[slot], written);
            }
        }
        state.holds = Rc::new(holds);
        state
    }

    fn forget(&mut self) {
        self.instances.clear();
        self.by_call.clear();
        self.merged.clear();
        self.at_labels.clear();
        self.at_calls.clear();
        self.reached.clear();
        self.modes.clear();
        self.mode_ids.clear();
        self.last_modes = None;
        self.chosen.clear();
        self.instructions.clear();
        self.size = 0;
    }

    /// Routines that the controller or the operator starts.
    fn run_entries(&mut self) {
        let script = self.script;
        let mut is_called = vec![false; script.routines.len()];
        for (at, routine) in script.routines.iter().enumerate() {
            for statement in &script.statements
                [routine.statements.start as usize..routine.statements.end as usize]
            {
                if let Statement::Call(call) = statement {
                    for &callee in &*script.calls[*call as usize].callees {
                        is_called[callee as usize] |= callee as usize != at;
                    }
                }
            }
        }
        let starts = |(at, routine): (usize, &crate::program::script::Routine)| {
            let starts = match routine.start {
                Start::Main => true,
                Start::Called => !is_called[at],
                Start::Concurrent => false,
            };
            starts.then_some(short(at))
        };
        let mut entries: Vec<RoutineId> = script
            .routines
            .iter()
            .enumerate()
            .filter_map(starts)
            .collect();
        if entries.is_empty() {
            entries = (0..short(script.routines.len())).collect();
        }
        let state = self.declared_state(START);
        let mut instances = Vec::with_capacity(entries.len());
        for &routine in &entries {
            let instance = self.instance(routine, 0, NO_INSTANCE);
            self.enter(instance, &state);
            instances.push(instance);
        }
        for _ in 0..MOST_ROUNDS {
            self.run_work();
            let mut changed = false;
            for &instance in &instances {
                changed |= self.keep(instance);
            }
            if !changed {
                break;
            }
        }
        if entries.len() > 1 {
            self.note_operators(&instances);
        }
    }

    /// What the controller keeps from run to run is there when the routine starts again; whether
    /// that is new.
    fn keep(&mut self, instance: u32) -> bool {
        let of = &self.instances[instance as usize];
        let (Some(entry), Some(exit)) = (of.entry.clone(), of.exit.clone()) else {
            return false;
        };
        let mut again = entry.clone();
        for (slot, variable) in self.tracked.iter().enumerate() {
            if self.script.variables[*variable as usize].kept {
                let joined = self.holdings.join(entry.holds[slot], exit.holds[slot]);
                if joined != entry.holds[slot] {
                    Rc::make_mut(&mut again.holds)[slot] = joined;
                }
            }
        }
        let changed = again != entry;
        if changed {
            self.enter(instance, &again);
        }
        changed
    }

    /// Notes what routines write that only the operator starts, and what others read: these do not
    /// see it.
    fn note_operators(&mut self, entries: &[u32]) {
        let script = self.script;
        let routine_of = |instance: &u32| self.instances[*instance as usize].routine;
        let entries: Vec<RoutineId> = entries.iter().map(routine_of).collect();
        let mut written: Vec<(VariableId, RoutineId)> = Vec::new();
        let mut sites = Vec::new();
        for &routine in &entries {
            let of = &script.routines[routine as usize];
            if of.start == Start::Main {
                continue;
            }
            for at in of.statements.clone() {
                if let Statement::Write(write) = script.statements[at as usize]
                    && let Written::One(variable) = script.writes[write as usize].variable
                    && script.variables[variable as usize].routine.is_none()
                {
                    written.push((variable, routine));
                    sites.push(at);
                }
            }
        }
        let elsewhere = read_elsewhere(script, &entries, &written);
        let noted = written.into_iter().zip(sites);
        let noted = noted.filter(|(written, _)| elsewhere.contains(written));
        self.by_operator
            .extend(noted.map(|((variable, _), site)| (variable, site)));
    }

    /// Text that nothing reaches: its moves start from the declarations.
    fn run_dead(&mut self) {
        for routine in 0..self.script.routines.len() {
            let of = &self.script.routines[routine];
            let mut own = None;
            for at in of.statements.clone() {
                let is_move = matches!(self.script.statements[at as usize], Statement::Move(_));
                if !is_move || self.visited[at as usize] {
                    continue;
                }
                let instance = *own.get_or_insert_with(|| {
                    let known = self.instances.iter();
                    let known = known
                        .enumerate()
                        .find(|(_, i)| i.routine as usize == routine);
                    known.map(|(at, _)| short(at))
                });
                let instance =
                    instance.unwrap_or_else(|| self.instance(short(routine), 0, NO_INSTANCE));
                own = Some(Some(instance));
                self.dead = Some(instance);
                self.push(instance, at, From::Dead);
                self.run_work();
            }
        }
    }

    /// Where a write stands, or the declaration of what a variable holds.
    pub(super) fn place_of(&self, site: Site) -> Option<crate::program::script::Place> {
        let script = self.script;
        Some(match script.statements.get(site as usize)? {
            Statement::Move(at) => script.instructions[*at as usize].place,
            Statement::Write(at) => script.writes[*at as usize].place,
            Statement::Call(at) | Statement::Start(at) => script.calls[*at as usize].place,
            _ => return None,
        })
    }
}
