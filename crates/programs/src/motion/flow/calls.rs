//! Calls: what holds in a routine and behind its call.

use super::{Flow, State};
use crate::motion::before::ANYWHERE;
use crate::motion::holding::{Atom, DECLARED, Holding, Site};
use crate::program::script::{Call, Expr, How, RoutineId, Statement, VariableId, Written, short};
use foldhash::{HashMap, HashMapExt};
use std::collections::BTreeSet;
use std::rc::Rc;

impl Flow<'_> {
    /// Whether a statement calls routines of the files, of which the running program chooses one.
    pub(in crate::motion) fn calls_one_of(&self, site: Site) -> bool {
        match self.script.statements.get(site as usize) {
            Some(Statement::Call(call)) => !self.script.calls[*call as usize].callees.is_empty(),
            _ => false,
        }
    }

    /// Finds the routines that change nothing that is tracked and move nothing, whatever they call.
    pub(super) fn find_idle(&mut self) {
        let script = self.script;
        let mut idle = vec![true; script.routines.len()];
        let mut callers: HashMap<RoutineId, Vec<RoutineId>> = HashMap::new();
        let mut busy = Vec::new();
        for (at, routine) in (0..).zip(&script.routines) {
            let range = routine.statements.start as usize..routine.statements.end as usize;
            let is_busy = script.statements[range]
                .iter()
                .any(|statement| match statement {
                    Statement::Move(_) | Statement::Start(_) => true,
                    Statement::Write(write) => match script.writes[*write as usize].variable {
                        Written::One(variable) => self.slots[variable as usize].is_some(),
                        Written::AnyOf(_) => true,
                    },
                    Statement::Call(call) => {
                        let call = &script.calls[*call as usize];
                        for callee in &*call.callees {
                            callers.entry(*callee).or_default().push(at);
                        }
                        call.foreign || call.leads
                    }
                    _ => false,
                });
            if is_busy {
                busy.push(at);
            }
        }
        while let Some(routine) = busy.pop() {
            if std::mem::replace(&mut idle[routine as usize], false) {
                busy.extend(callers.get(&routine).into_iter().flatten());
            }
        }
        self.idle = idle;
    }

    /// What a call itself does before it goes anywhere: arguments are given away, what is shared is
    /// uncertain.
    pub(super) fn call(&mut self, instance: u32, call: &Call, site: Site, state: &mut State) {
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
                self.share(instance, variable, state);
            }
        }
        let uncertain = self.holdings.one(Atom::Uncertain, site);
        for at in 0..self.changing.len() {
            let slot = self.changing[at] as usize;
            self.outdate(state, self.tracked[slot]);
            let joined = self.holdings.join(state.holds[slot], uncertain);
            Rc::make_mut(&mut state.holds)[slot] = joined;
        }
    }

    /// Finds what is shared with routines that are not in the files and has another value somewhere
    /// in them than its declared one: modes that the files leave as they are, others are taken to
    /// leave, too.
    pub(super) fn find_changing(&mut self) {
        let script = self.script;
        let mut written: HashMap<VariableId, Vec<Option<Expr>>> = HashMap::new();
        for statement in &script.statements {
            if let Statement::Write(write) = statement
                && let Written::One(variable) = script.writes[*write as usize].variable
            {
                let whole = match &script.writes[*write as usize].how {
                    How::Whole(value) => Some(*value),
                    _ => None,
                };
                written.entry(variable).or_default().push(whole);
            }
        }
        for back in script.arguments.iter().filter_map(|argument| argument.back) {
            written.entry(back).or_default().push(None);
        }
        let changes = |variable: VariableId| {
            let declared = |of: VariableId| script.variables[of as usize].declared;
            let own = declared(variable);
            let (mut seen, mut open) = (vec![variable], vec![variable]);
            while let Some(of) = open.pop() {
                let values = written.get(&of);
                // what is written before it is read is not what was declared
                if values.is_none() && of != variable && declared(of) != own {
                    return true;
                }
                for value in values.into_iter().flatten() {
                    match *value {
                        Some(value) if value == own => {}
                        Some(Expr::Variable(from)) => {
                            if !seen.contains(&from) {
                                seen.push(from);
                                open.push(from);
                            }
                        }
                        _ => return true,
                    }
                }
            }
            false
        };
        let shared = (0..short(script.variables.len()))
            .filter(|variable| script.variables[*variable as usize].shared && changes(*variable));
        self.changing = shared
            .filter_map(|variable| self.slots[variable as usize])
            .collect();
    }

    /// The state behind a call, as far as the routines that it calls have come; `None` where none
    /// has come to its end.
    pub(super) fn behind_call(&mut self, instance: u32, statement: u32) -> Option<State> {
        let Statement::Call(call) = self.script.statements[statement as usize] else {
            return None;
        };
        let call = &self.script.calls[call as usize];
        let start = self.at_calls.get(&(instance, statement))?.clone();
        let mut behind = call.foreign.then(|| start.clone());
        // what only writes goes to no others of that kind
        let is_within = call.writes_only && self.instances[instance as usize].writes_only;
        for &routine in call.callees.iter().filter(|_| !is_within) {
            if self.idle[routine as usize] {
                behind = Some(match behind {
                    Some(other) => self.join(&other, &start),
                    None => start.clone(),
                });
                continue;
            }
            let callee = self.called(instance, statement, routine);
            let writes_only = self.instances[callee as usize].writes_only;
            let mut entry = self.entry_of(call, routine, statement, &start);
            if writes_only {
                (entry.before, entry.led) = (self.sets.one(ANYWHERE), None);
            }
            let waiting = &mut self.instances[callee as usize].waiting;
            waiting.insert((instance, statement));
            self.enter(callee, &entry);
            if let Some(raised) = self.instances[callee as usize].raised.clone() {
                let back = self.back_from(&start, &raised, call, routine, instance);
                self.catch(instance, statement, &back);
            }
            let Some(mut exit) = self.instances[callee as usize].exit.clone() else {
                continue;
            };
            if writes_only {
                exit = self.with_written(&start, &exit, routine);
            }
            let back = self.back_from(&start, &exit, call, routine, instance);
            behind = Some(match behind {
                Some(other) => self.join(&other, &back),
                None => back,
            });
        }
        behind
    }

    /// A routine that a statement calls ends with an error.
    fn catch(&mut self, instance: u32, statement: u32, state: &State) {
        let script = self.script;
        let behind = &script.statements[statement as usize + 1..];
        let mut is_caught = false;
        for following in behind {
            let Statement::Catch(label) = *following else {
                break;
            };
            self.arrive(instance, label, state);
            is_caught = true;
        }
        if !is_caught {
            self.raise(instance, state);
        }
    }

    /// The state in which a call enters a routine: its own variables are as declared, whatever an
    /// earlier call left in them; what it is given is bound.
    pub(super) fn entry_of(
        &mut self,
        call: &Call,
        routine: RoutineId,
        site: Site,
        start: &State,
    ) -> State {
        let mut entry = start.clone();
        for slot in self.locals.get(&routine).cloned().unwrap_or_default() {
            let variable = self.tracked[slot as usize];
            let declared = self.script.variables[variable as usize].declared;
            let held = self.constant(declared, DECLARED);
            self.hold(&mut entry, variable, held);
        }
        for argument in self.arguments(call) {
            if let Some(parameter) = argument.parameter
                && self.script.variables[parameter as usize].routine == Some(routine)
            {
                let held = self.evaluate(start, argument.value, site);
                self.hold(&mut entry, parameter, held);
            }
        }
        entry
    }

    /// Notes with what routines are started that then run concurrently with the others.
    pub(super) fn start(&mut self, call: &Call, site: Site, state: &State) {
        for &routine in &*call.callees {
            let mut entry = self.entry_of(call, routine, site, state);
            entry.before = self.sets.one(ANYWHERE);
            if let Some(before) = self.started.get(&routine).cloned() {
                entry = self.join(&before, &entry);
            }
            self.started.insert(routine, entry);
        }
    }

    /// Whether what a statement calls counts by what it writes alone.
    pub(super) fn counts_by_writes(&self, caller: u32, statement: u32) -> bool {
        let is_said = match self.script.statements[statement as usize] {
            Statement::Call(call) => self.script.calls[call as usize].writes_only,
            _ => false,
        };
        is_said || self.instances[caller as usize].writes_only
    }

    /// The slots of what a routine may write, and all that it calls.
    fn slots_written(&mut self, routine: RoutineId) -> Rc<[u32]> {
        if let Some(known) = self.slots_written.get(&routine) {
            return Rc::clone(known);
        }
        let script = self.script;
        let mut slots = BTreeSet::new();
        let mut add = |variable: VariableId| slots.extend(self.slots[variable as usize]);
        for routine in script.reached_from(&[routine]) {
            let own = &script.routines[routine as usize].statements;
            for statement in &script.statements[own.start as usize..own.end as usize] {
                match *statement {
                    Statement::Write(write) => match script.writes[write as usize].variable {
                        Written::One(variable) => add(variable),
                        Written::AnyOf(table) => {
                            let entries = &script.tables[table as usize].entries;
                            for variable in entries.values() {
                                add(*variable);
                            }
                        }
                    },
                    Statement::Call(call) => {
                        let given = self.arguments(&script.calls[call as usize]);
                        given.iter().filter_map(|one| one.back).for_each(&mut add);
                    }
                    _ => {}
                }
            }
        }
        let slots: Rc<[u32]> = slots.into_iter().collect();
        self.slots_written.insert(routine, Rc::clone(&slots));
        slots
    }

    /// The state behind a routine that counts by what it writes alone.
    fn with_written(&mut self, start: &State, exit: &State, routine: RoutineId) -> State {
        let mut state = start.clone();
        state.is_alone &= exit.is_alone;
        for &slot in &*self.slots_written(routine) {
            let slot = slot as usize;
            self.outdate(&mut state, self.tracked[slot]);
            if state.holds[slot] != exit.holds[slot] {
                Rc::make_mut(&mut state.holds)[slot] = exit.holds[slot];
            }
        }
        state
    }

    /// The state that a routine leaves, with the caller's own variables as they were.
    pub(super) fn back_from(
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
        // its own parameters are what the variables are that it is given for them
        for (parameter, variable) in &*Rc::clone(&self.instances[instance as usize].same) {
            let held = self.variable(&back, *variable);
            self.hold(&mut back, *parameter, held);
        }
        for argument in self.arguments(call) {
            if let (Some(parameter), Some(variable)) = (argument.parameter, argument.back)
                && self.script.variables[parameter as usize].routine == Some(routine)
                && self.slots[parameter as usize].is_some()
            {
                let held = self.variable(exit, parameter);
                let written = self.come_back(held, variable);
                self.set(&mut back, variable, written);
                self.share(instance, variable, &mut back);
            }
        }
        back
    }

    /// The parameters by reference of a routine that a call gives, and those of its callers, with the
    /// variable that each is in the end.
    pub(super) fn given_by(
        &self,
        caller: u32,
        statement: u32,
        routine: RoutineId,
    ) -> Rc<[(VariableId, VariableId)]> {
        let before = &self.instances[caller as usize].same;
        let Statement::Call(call) = self.script.statements[statement as usize] else {
            return Rc::clone(before);
        };
        let call = &self.script.calls[call as usize];
        let given = self.arguments(call).iter().filter_map(|argument| {
            let (parameter, variable) = (argument.parameter?, argument.back?);
            let is_own = self.script.variables[parameter as usize].routine == Some(routine);
            // not a part of it
            let is_whole = argument.value == Expr::Variable(variable);
            let known = before.iter().find(|(of, _)| *of == variable);
            (is_own && is_whole).then(|| (parameter, known.map_or(variable, |(_, of)| *of)))
        });
        let given: Vec<_> = given.collect();
        if given.is_empty() {
            return Rc::clone(before);
        }
        before.iter().copied().chain(given).collect()
    }

    /// A variable is written: so it is under the other names that it has in a routine that is given
    /// it by reference.
    pub(super) fn share(&mut self, instance: u32, variable: VariableId, state: &mut State) {
        let same = Rc::clone(&self.instances[instance as usize].same);
        if same.is_empty() {
            return;
        }
        let known = same.iter().find(|(parameter, _)| *parameter == variable);
        let one = known.map_or(variable, |(_, one)| *one);
        let held = self.variable(state, variable);
        let names = same.iter().filter(|(_, of)| *of == one);
        for other in names.map(|(parameter, _)| *parameter).chain([one]) {
            if other != variable {
                let held = self.come_back(held, other);
                self.set(state, other, held);
            }
        }
    }

    /// What a variable holds that was given by reference: of its own position parts may have been
    /// written.
    pub(super) fn come_back(&mut self, held: Holding, variable: VariableId) -> Holding {
        let Expr::Target(own) = self.script.variables[variable as usize].declared else {
            return held;
        };
        let own = short(own);
        let is_part_written = |atom: Atom| match atom {
            Atom::Target {
                target,
                displacement,
            } => target == own && self.is_part_written(displacement),
            _ => false,
        };
        let mut atoms = self.holdings.of(held).to_vec();
        if atoms.iter().all(|(atom, _)| !is_part_written(*atom)) {
            return held;
        }
        for (atom, _) in &mut atoms {
            if is_part_written(*atom) {
                *atom = Atom::Changed { target: own };
            }
        }
        self.holdings.intern(atoms)
    }
}
