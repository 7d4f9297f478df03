//! Where programs start, what runs concurrently, what is kept from run to run, and text that
//! nothing reaches.

use super::{Flow, From, MOST_ROUNDS, NO_INSTANCE, State};
use crate::motion::before::{ANYWHERE, START};
use crate::motion::holding::{DECLARED, Holding};
use crate::motion::readers::{read_elsewhere, written_by};
use crate::program::script::{
    Expr, Routine, RoutineId, Start, Statement, VariableId, Written, short,
};
use foldhash::HashSet;
use std::rc::Rc;

impl Flow<'_> {
    /// Routines that run at any time: what they write, others may find at any place.
    pub(super) fn run_concurrent(&mut self) {
        let routines = self.script.routines.iter().enumerate();
        let concurrent: Vec<RoutineId> = routines
            .filter(|(_, routine)| routine.start == Start::Concurrent)
            .map(|(at, _)| short(at))
            .collect();
        if concurrent.is_empty() {
            return;
        }
        let by_others = self.started_by_others();
        self.is_concurrent = true;
        for _ in 0..MOST_ROUNDS {
            let before = self.anytime.clone();
            self.forget();
            let declared = self.declared_state(ANYWHERE);
            for &routine in &concurrent {
                let state = match self.started.get(&routine).cloned() {
                    Some(state) => self.with_concurrent(Some(routine), state),
                    // nothing has been seen to start it yet
                    None if by_others[routine as usize] => continue,
                    None => self.with_concurrent(None, declared.clone()),
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

    /// Of each routine whether a statement starts it that then runs concurrently.
    pub(super) fn started_by_others(&self) -> Vec<bool> {
        let mut by_others = vec![false; self.script.routines.len()];
        for statement in &self.script.statements {
            if let Statement::Start(call) = statement {
                for &routine in &*self.script.calls[*call as usize].callees {
                    by_others[routine as usize] = true;
                }
            }
        }
        by_others
    }

    /// A state in which all that may hold which others write meanwhile: what is started together
    /// with what starts the routine; anything where nothing in the files does.
    fn with_concurrent(&mut self, routine: Option<RoutineId>, mut state: State) -> State {
        let near = routine.map(|routine| self.started_with(routine));
        let is_near = |writer: &RoutineId| near.as_ref().is_none_or(|near| near.contains(writer));
        let mut holds = state.holds.to_vec();
        let written = self.concurrent.iter();
        for ((_, variable), &written) in written.filter(|((writer, _), _)| is_near(writer)) {
            if let Some(slot) = self.slots[*variable as usize] {
                let slot = slot as usize;
                holds[slot] = self.holdings.join(holds[slot], written);
            }
        }
        state.holds = Rc::new(holds);
        state.is_alone = false;
        state
    }

    /// The routines that run where something starts this one: what those come to, through calls,
    /// from which the start is come to.
    fn started_with(&mut self, routine: RoutineId) -> Rc<HashSet<RoutineId>> {
        if let Some(known) = self.started_with.get(&routine) {
            return Rc::clone(known);
        }
        let script = self.script;
        let mut is_called = vec![false; script.routines.len()];
        let mut starters = Vec::new();
        for (at, of) in (0..).zip(&script.routines) {
            let own = of.statements.start as usize..of.statements.end as usize;
            for statement in &script.statements[own] {
                let (Statement::Call(call) | Statement::Start(call)) = *statement else {
                    continue;
                };
                let call = &script.calls[call as usize];
                let callees = &call.callees;
                if matches!(statement, Statement::Start(_)) && callees.contains(&routine) {
                    starters.push(at);
                }
                for &callee in &**callees {
                    is_called[callee as usize] |= callee != at && !call.writes_only;
                }
            }
        }
        let mut with = HashSet::default();
        for (at, of) in (0..).zip(&script.routines) {
            if of.start == Start::Main || !is_called[at as usize] {
                let reached = script.reached_from(&[at]);
                if starters.iter().any(|starter| reached.contains(starter)) {
                    with.extend(reached);
                }
            }
        }
        let perhaps = script.calls.iter().filter(|call| call.writes_only);
        let perhaps: Vec<RoutineId> = perhaps.flat_map(|call| &*call.callees).copied().collect();
        if with.is_empty() {
            with.extend(0..short(script.routines.len()));
        }
        with.extend(script.reached_from(&perhaps));
        let with = Rc::new(with);
        self.started_with.insert(routine, Rc::clone(&with));
        with
    }

    pub(super) fn forget(&mut self) {
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
        self.at_any_time.clear();
        self.called_by_dead.clear();
        self.size = 0;
    }

    /// Routines that the controller or the operator starts.
    pub(super) fn run_entries(&mut self) {
        let script = self.script;
        let mut is_called = vec![false; script.routines.len()];
        for (at, routine) in script.routines.iter().enumerate() {
            for statement in &script.statements
                [routine.statements.start as usize..routine.statements.end as usize]
            {
                if let Statement::Call(call) = statement {
                    let call = &script.calls[*call as usize];
                    for &callee in &*call.callees {
                        is_called[callee as usize] |= callee as usize != at && !call.writes_only;
                    }
                }
            }
        }
        let starts = |(at, routine): (usize, &Routine)| {
            let starts = match routine.start {
                Start::Main => true,
                Start::Called => !is_called[at],
                Start::Inner | Start::Concurrent => false,
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
        let mut are_started = true;
        while !entries.is_empty() {
            for &routine in &entries {
                let instance = self.instance(routine, 0, NO_INSTANCE);
                if !are_started {
                    self.called_by_dead.insert(instance);
                }
                self.enter(instance, &state);
                instances.push(instance);
            }
            are_started = false;
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
            entries = self.never_called();
        }
        if instances.len() > 1 {
            self.note_operators(&instances);
        }
    }

    /// Routines that only text calls that nothing reaches, or that nothing calls and that are part of
    /// another: those that no other of them calls. The operator may start them all the same.
    fn never_called(&self) -> Vec<RoutineId> {
        let script = self.script;
        let reached: HashSet<RoutineId> = self.instances.iter().map(|of| of.routine).collect();
        let all = (0..).zip(&script.routines);
        let is_called = |of: &Routine| matches!(of.start, Start::Called | Start::Inner);
        let unreached = all.filter(|(at, of)| is_called(of) && !reached.contains(at));
        let mut unreached: Vec<RoutineId> = unreached.map(|(at, _)| at).collect();
        let mut inner: HashSet<RoutineId> = HashSet::default();
        for &at in &unreached {
            let own = script.routines[at as usize].statements.clone();
            for statement in &script.statements[own.start as usize..own.end as usize] {
                if let Statement::Call(call) = statement {
                    let callees = script.calls[*call as usize].callees.iter();
                    inner.extend(callees.filter(|callee| **callee != at));
                }
            }
        }
        if unreached.iter().any(|at| !inner.contains(at)) {
            unreached.retain(|at| !inner.contains(at));
        }
        unreached
    }

    /// Whether an instance is of a routine that only text calls that nothing reaches, or runs in one.
    pub(super) fn is_called_by_dead(&self, mut instance: u32) -> bool {
        if self.called_by_dead.is_empty() {
            return false;
        }
        while self.instances[instance as usize].caller != NO_INSTANCE {
            instance = self.instances[instance as usize].caller;
        }
        self.called_by_dead.contains(&instance)
    }

    /// What the controller keeps from run to run is there when the routine starts again; whether
    /// that is new.
    pub(super) fn keep(&mut self, instance: u32) -> bool {
        let of = &self.instances[instance as usize];
        let (Some(entry), Some(exit)) = (of.entry.clone(), of.exit.clone()) else {
            return false;
        };
        let mut again = entry.clone();
        again.is_alone &= self.script.ends_what_runs || exit.is_alone;
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

    /// Notes what moves of routines have that only the operator starts, as it is declared, and what
    /// the program writes: it may be what the last run has left.
    fn note_left(&mut self, entries: &[u32]) {
        let script = self.script;
        let is_main = |instance: u32| {
            let routine = self.instances[instance as usize].routine;
            script.routines[routine as usize].start == Start::Main
        };
        let mains = entries.iter().filter(|entry| is_main(**entry));
        let mains = mains.map(|entry| self.instances[*entry as usize].routine);
        let written = written_by(script, &mains.collect::<Vec<_>>());
        if written.is_empty() {
            return;
        }
        let is_declared = |holding: Holding| {
            let mut atoms = self.holdings.of(holding).iter();
            atoms.any(|(_, site)| *site == DECLARED)
        };
        let roots: HashSet<u32> = entries.iter().copied().collect();
        let mut found = Vec::new();
        for at in 0..short(self.instances.len()) {
            let mut root = at;
            while self.instances[root as usize].caller != NO_INSTANCE {
                root = self.instances[root as usize].caller;
            }
            if !roots.contains(&root) || is_main(root) {
                continue;
            }
            let of = &self.instances[at as usize];
            let instructions = script.routines[of.routine as usize].instructions.clone();
            for (stop, instruction) in (of.first_stop..).zip(instructions) {
                let Some(reached) = self.reached.get(stop as usize).copied().flatten() else {
                    continue;
                };
                let modes = self.modes[reached.modes as usize];
                let instruction = &script.instructions[instruction as usize];
                let modal = &script.modals[instruction.modal as usize];
                let used = [
                    (modal.tool, Some(modes.tool)),
                    (modal.frame, Some(modes.frame)),
                    (modal.load, Some(modes.load)),
                    (instruction.target, reached.target),
                ];
                found.extend(used.iter().filter_map(|(expr, holding)| {
                    let variable = expr.variable().filter(|of| {
                        let of = &script.variables[*of as usize];
                        of.kept && of.routine.is_none()
                    })?;
                    let site = *written.get(&variable)?;
                    is_declared((*holding)?).then_some((variable, site))
                }));
            }
        }
        self.left.extend(found);
    }

    /// Notes what routines write that only the operator starts, and what others read: these do not
    /// see it.
    pub(super) fn note_operators(&mut self, entries: &[u32]) {
        self.note_left(entries);
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

    /// Whether a move that nothing reaches goes to a parameter that no call gives, in a routine that
    /// is called.
    fn is_never_given(&self, routine: usize, instruction: u32) -> bool {
        let script = self.script;
        let of = &script.routines[routine];
        let mut target = script.instructions[instruction as usize].target;
        while let Expr::Displaced { base, .. } | Expr::DisplacedByCall { base, .. } = target {
            target = script.lists[base as usize];
        }
        let Expr::Variable(parameter) = target else {
            return false;
        };
        let given = script.arguments.iter();
        let mut given = given.filter(|argument| argument.parameter == Some(parameter));
        let owner = script.variables[parameter as usize].routine;
        owner == Some(short(routine))
            && self.visited[of.statements.start as usize]
            && given.clone().next().is_some()
            && given.all(|argument| matches!(argument.value, Expr::Unknown(_)))
    }

    /// Text that nothing reaches: it starts from the declarations where it begins.
    pub(super) fn run_dead(&mut self) {
        for routine in 0..self.script.routines.len() {
            let of = &self.script.routines[routine];
            let mut own = None;
            for at in of.statements.clone() {
                let Statement::Move(instruction) = self.script.statements[at as usize] else {
                    continue;
                };
                if self.visited[at as usize] || self.is_never_given(routine, instruction) {
                    continue;
                }
                let instance = *own.get_or_insert_with(|| {
                    let known = self.instances.iter();
                    let known = known
                        .enumerate()
                        .find(|(_, i)| i.routine as usize == routine && !i.writes_only);
                    known.map(|(at, _)| short(at))
                });
                let instance =
                    instance.unwrap_or_else(|| self.instance(short(routine), 0, NO_INSTANCE));
                own = Some(Some(instance));
                self.dead = Some(instance);
                let before = (of.statements.start..at).rev();
                let unreached = before.take_while(|at| !self.visited[*at as usize]);
                let first = unreached.last().unwrap_or(at);
                self.push(instance, first, From::Dead);
                self.run_work();
            }
        }
    }
}
