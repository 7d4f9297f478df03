//! What variables hold: which are followed, and the value of an expression.

use super::{Flow, MOST_FACTORS, MOST_NEAR, MOST_WRITES, Modes, State};
use crate::motion::before::{ANYWHERE, Stop};
use crate::motion::holding::{Atom, DECLARED, Holding, MOST_VALUES, NOTHING, Site};
use crate::program::Displacement;
use crate::program::script::{
    ByCall, DisplacementId, Expr, Factor, Held, How, NOT_DISPLACED, Product, Statement, TableId,
    ValueId, VariableId, Written, short,
};
use foldhash::{HashMap, HashMapExt};
use std::rc::Rc;

impl Flow<'_> {
    /// Decides which variables are tracked: those with more than one thing to hold.
    pub(super) fn track(&mut self) {
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
                    if declared == Expr::Absent && !self.reads_modes(value) =>
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

    /// Whether a value depends on tool and work frame where it is read.
    fn reads_modes(&self, value: Expr) -> bool {
        let Expr::Value(value) = value else {
            return false;
        };
        matches!(self.value(value), Held::ActualWith { .. })
    }

    /// What an expression without variables that are written holds; of one with such variables
    /// their declarations.
    pub(super) fn constant(&mut self, value: Expr, site: Site) -> Holding {
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
    pub(super) fn plain(
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
            Expr::Value(value) => {
                let value = match script.values.get(value as usize) {
                    Some(Held::ActualWith { tool, frame }) => {
                        let with = [*tool, *frame].map(|of| of_variable(self, of));
                        self.read_with(with)
                    }
                    _ => value,
                };
                self.holdings.one(Atom::Value(value), site)
            }
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
                self.displaced(base, by, site)
            }
            Expr::DisplacedByCall { base, by } => {
                let base = of_variable(self, script.lists[base as usize]);
                let by = &script.by_calls[by as usize];
                let call = of_variable(self, Expr::Variable(by.call));
                let mut all = NOTHING;
                for by in self.by_call(by, call) {
                    let one = self.displaced(base, by, site);
                    all = self.holdings.join(all, one);
                }
                all
            }
            Expr::Product(product) => {
                let of = &script.products[product as usize];
                let each: Vec<Holding> = (of.factors.iter())
                    .map(|factor| of_variable(self, *factor))
                    .collect();
                self.product(of, &each, site)
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
                    let one = if let Some(variable) = entry {
                        let held = of_variable(self, Expr::Variable(variable));
                        // the selection is what a message names
                        let atoms = self.holdings.of(held).to_vec();
                        let placed = atoms
                            .into_iter()
                            .map(|(atom, of)| (atom, if of == DECLARED { site } else { of }));
                        self.holdings.intern(placed.collect())
                    } else {
                        let unknown = script.tables[table as usize].unknown;
                        let unknown = unknown.filter(|_| atom != Atom::Uncertain);
                        self.holdings.one(unknown.map_or(atom, Atom::Unknown), site)
                    };
                    all = self.holdings.join(all, one);
                }
                all
            }
        }
    }

    /// The products of frames that these hold.
    fn product(&mut self, of: &Product, each: &[Holding], site: Site) -> Holding {
        let mut all: Vec<Vec<Factor>> = vec![Vec::new()];
        for held in each {
            let atoms = self.holdings.of(*held).iter();
            let factors: Option<Vec<_>> = atoms.map(|(atom, _)| self.factors(*atom)).collect();
            let factors = factors.unwrap_or_default();
            let longer = |before: &Vec<Factor>| {
                let one = |more: &Vec<Factor>| [&before[..], more].concat();
                factors.iter().map(one).collect::<Vec<_>>()
            };
            all = all.iter().flat_map(longer).collect();
            let is_long = |one: &Vec<Factor>| one.len() > MOST_FACTORS;
            if all.is_empty() || all.len() > MOST_VALUES || all.iter().any(is_long) {
                return self.holdings.one(Atom::Unknown(of.otherwise), site);
            }
        }
        let atoms = all.into_iter().map(|factors| {
            let made = self.script.values.len() + self.made.len();
            let key = (of.name.clone(), factors, of.otherwise);
            let value = *self.products.entry(key).or_insert_with_key(|key| {
                self.made.push(Held::Product {
                    name: key.0.clone(),
                    of: key.1.clone().into(),
                    otherwise: key.2,
                });
                short(made)
            });
            (Atom::Value(value), site)
        });
        let atoms = atoms.collect();
        self.holdings.intern(atoms)
    }

    /// The factors of a frame; nothing where it is none that is known.
    fn factors(&self, atom: Atom) -> Option<Vec<Factor>> {
        match atom {
            Atom::Target {
                target,
                displacement: NOT_DISPLACED,
            } => Some(vec![Factor::Target(target)]),
            Atom::Value(value) if value != ValueId::MAX => match self.value(value) {
                Held::Frame(_) | Held::Record { .. } => Some(vec![Factor::Value(value)]),
                Held::Product { of, .. } => Some(of.to_vec()),
                _ => None,
            },
            _ => None,
        }
    }

    /// Positions, displaced at a place.
    fn displaced(&mut self, base: Holding, by: DisplacementId, site: Site) -> Holding {
        let atoms = self.holdings.of(base).to_vec();
        let mut displaced = Vec::with_capacity(atoms.len());
        for (atom, of) in atoms {
            match atom {
                Atom::Target {
                    target,
                    displacement,
                } => {
                    let all = self.displaced_again(displacement, by, site);
                    displaced.extend(all.into_iter().map(|displacement| {
                        (
                            Atom::Target {
                                target,
                                displacement,
                            },
                            of,
                        )
                    }));
                }
                Atom::Value(value) if self.is_of_robot(value) => {
                    displaced.push((self.near_robot(value, by), of));
                }
                other => displaced.push((other, of)),
            }
        }
        self.holdings.intern(displaced)
    }

    /// What displaces in the calls whose numbers a variable may hold.
    pub(in crate::motion) fn by_call(&self, of: &ByCall, calls: Holding) -> Vec<DisplacementId> {
        let number = |(atom, _): &(Atom, Site)| match atom {
            Atom::Value(value) => match self.value(*value) {
                Held::Number(number) => of.by.get(number).copied(),
                _ => None,
            },
            _ => None,
        };
        let known: Option<Vec<_>> = self.holdings.of(calls).iter().map(number).collect();
        let mut all = known.unwrap_or_default();
        if all.is_empty() {
            all.push(of.otherwise);
        }
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The value of where the robot is, whatever holds its tool and its work frame.
    pub(super) fn here(&mut self) -> ValueId {
        *self.here.get_or_insert_with(|| {
            self.made.push(Held::Actual);
            short(self.script.values.len() + self.made.len() - 1)
        })
    }

    /// The value of where the robot is, with what holds its tool and its work frame.
    fn read_with(&mut self, with: [Holding; 2]) -> ValueId {
        let with = with.map(|of| {
            let atoms = self.holdings.of(of).iter();
            let atoms = atoms.map(|(atom, site)| match atom {
                // another one each time
                Atom::Unknown(_) if *site != DECLARED => (Atom::Anything, DECLARED),
                atom => (*atom, DECLARED),
            });
            let atoms = atoms.collect();
            self.holdings.intern(atoms)
        });
        if let Some((value, _)) = self.reads.iter().find(|(_, known)| *known == with) {
            return *value;
        }
        self.made.push(Held::Actual);
        let value = short(self.script.values.len() + self.made.len() - 1);
        self.reads.push((value, with));
        value
    }

    /// Where the robot is, just read with what these hold.
    fn freshly(&mut self, of: [Expr; 2], read: Holding) -> Holding {
        let &[(Atom::Value(value), site)] = self.holdings.of(read) else {
            return read;
        };
        let known = (self.fresh.iter()).find(|(_, own, then)| (*own, *then) == (of, value));
        let known = known.map(|(fresh, ..)| *fresh);
        let fresh = known.unwrap_or_else(|| {
            self.made.push(Held::Actual);
            let made = short(self.script.values.len() + self.made.len() - 1);
            self.fresh.push((made, of, value));
            made
        });
        self.holdings.one(Atom::Value(fresh), site)
    }

    /// A variable is written: positions that were read with what it held before are no more as they
    /// would be read now.
    pub(super) fn outdate(&mut self, state: &mut State, variable: VariableId) {
        let of = Expr::Variable(variable);
        let read = self.fresh.iter().filter(|(_, own, _)| own.contains(&of));
        let read: HashMap<ValueId, ValueId> =
            read.map(|(fresh, _, then)| (*fresh, *then)).collect();
        if read.is_empty() {
            return;
        }
        let then = |atom: &Atom| match atom {
            Atom::Value(value) => read.get(value).copied(),
            _ => None,
        };
        for slot in 0..state.holds.len() {
            let atoms = self.holdings.of(state.holds[slot]);
            if !atoms.iter().any(|(atom, _)| then(atom).is_some()) {
                continue;
            }
            let atoms = atoms.iter().map(|(atom, site)| match then(atom) {
                Some(value) => (Atom::Value(value), *site),
                None => (*atom, *site),
            });
            let atoms = atoms.collect();
            Rc::make_mut(&mut state.holds)[slot] = self.holdings.intern(atoms);
        }
    }

    /// Whether a variable is what it was since a position was read with it, as long as that is fresh.
    fn keeps(&self, of: Expr) -> bool {
        let Expr::Variable(variable) = of else {
            return false;
        };
        let is_own = self.script.variables[variable as usize].routine.is_some();
        !is_own && !self.anytime.contains_key(&variable) && !self.has_concurrent
    }

    /// Whether a value is where the robot was, displaced or not.
    pub(super) fn is_of_robot(&self, value: ValueId) -> bool {
        let held = self.value(value);
        matches!(
            held,
            Held::Actual | Held::ActualWith { .. } | Held::NearActual
        )
    }

    /// Whether the text says by what something displaces.
    pub(in crate::motion) fn is_said(&self, by: DisplacementId) -> bool {
        let displacement = self.displacement(by);
        matches!(
            displacement,
            Displacement::None | Displacement::By(_) | Displacement::Within(_)
        )
    }

    /// Where the robot was, displaced: that stays such a position where the text says by what.
    pub(super) fn near_robot(&mut self, value: ValueId, by: DisplacementId) -> Atom {
        if by == NOT_DISPLACED {
            return Atom::Value(value);
        }
        if !self.is_said(by) {
            return Atom::Anything;
        }
        let by = match self.near_by.get(&value) {
            // displaced again and again
            Some(None) => return Atom::Value(value),
            Some(_) => None,
            None => Some(by).filter(|_| self.near_by.len() < MOST_NEAR),
        };
        if let Some(near) = self.near.get(&(value, by)) {
            return Atom::Value(*near);
        }
        self.made.push(Held::NearActual);
        let near = short(self.script.values.len() + self.made.len() - 1);
        self.near.insert((value, by), near);
        self.near_by.insert(near, by);
        let fresh = self.fresh.iter().find(|(fresh, ..)| *fresh == value);
        let read = fresh.map_or(value, |(.., then)| *then);
        let with = self.reads.iter().find(|(of, _)| *of == read);
        if let Some((_, with)) = with.copied() {
            self.reads.push((near, with));
        }
        Atom::Value(near)
    }

    /// By what a move to where the robot was, displaced by so much, is displaced in all, where that is
    /// one amount that the text says.
    pub(in crate::motion) fn near_by(
        &self,
        value: ValueId,
        by: DisplacementId,
    ) -> Option<DisplacementId> {
        match self.near_by.get(&value) {
            None => Some(by),
            Some(before) => before.filter(|_| by == NOT_DISPLACED),
        }
    }

    /// Whether a move to where the robot was has the tool and the work frame of that position.
    pub(in crate::motion) fn is_as_read(&self, value: ValueId, stop: Stop) -> bool {
        let fresh = self.fresh.iter().find(|(fresh, ..)| *fresh == value);
        let (read_with, value) = match fresh {
            Some((_, of, then)) => (*of, *then),
            None => ([Expr::Absent; 2], value),
        };
        let instruction = &self.script.instructions[self.instructions[stop as usize] as usize];
        let modal = &self.script.modals[instruction.modal as usize];
        let gone_with = [modal.tool, modal.frame];
        let Some((_, with)) = self.reads.iter().find(|(of, _)| *of == value) else {
            return matches!(self.value(value), Held::Actual | Held::NearActual);
        };
        let Some(reached) = self.reached[stop as usize] else {
            return false;
        };
        let one = |holding: Holding| {
            let mut atoms = self.holdings.of(holding).iter();
            let mut known = atoms.by_ref().filter(|(atom, _)| *atom != Atom::Uncertain);
            let (first, site) = known.next()?;
            let is_one = known.next().is_none();
            let is_known = match first {
                Atom::Value(_) | Atom::Target { .. } => true,
                // what the robot has when the program starts
                Atom::Unknown(_) => *site == DECLARED,
                _ => false,
            };
            (is_one && is_known).then_some(*first)
        };
        let of = |modes: &Modes| [modes.tool, modes.frame].map(one);
        let own = of(&self.modes[reached.modes as usize]);
        let modes = self.modes[reached.modes as usize];
        let raw = [modes.tool, modes.frame];
        (0..2).all(|at| match with[at] {
            // positions have frames of their own, wherever they are
            NOTHING if raw[at] == NOTHING => true,
            _ if read_with[at] == gone_with[at] && self.keeps(read_with[at]) => true,
            _ if own[at].is_none() => false,
            // that of the move before
            NOTHING => self.modes.iter().all(|modes| of(modes)[at] == own[at]),
            read => one(read) == own[at],
        })
    }

    pub(super) fn variable(&mut self, state: &State, variable: VariableId) -> Holding {
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
    pub(super) fn evaluate(&mut self, state: &State, value: Expr, site: Site) -> Holding {
        if let Expr::Value(held) = value
            && self.is_of_robot(held)
        {
            let known = self.stood.get(&site).copied().unwrap_or(state.before);
            let mut before = self.sets.union(known, state.before);
            if state.led.is_some() {
                let anywhere = self.sets.one(ANYWHERE);
                before = self.sets.union(before, anywhere);
            }
            self.stood.insert(site, before);
            if let Held::ActualWith { tool, frame } = *self.value(held) {
                let read = self.plain(value, site, &mut |flow, inner| {
                    flow.evaluate(state, inner, site)
                });
                return self.freshly([tool, frame], read);
            }
        }
        match value {
            Expr::Variable(variable) => self.variable(state, variable),
            other => self.plain(other, site, &mut |flow, inner| {
                flow.evaluate(state, inner, site)
            }),
        }
    }

    pub(super) fn set(&mut self, state: &mut State, variable: VariableId, holding: Holding) {
        self.last_modes = None;
        if self.is_concurrent {
            if !self.is_of_writer(variable) {
                let before = self.anytime.get(&variable).copied().unwrap_or(NOTHING);
                let joined = self.holdings.join(before, holding);
                self.anytime.insert(variable, joined);
            }
        } else if self.has_concurrent && !state.is_alone {
            let key = (self.writer, variable);
            let before = self.concurrent.get(&key).copied().unwrap_or(NOTHING);
            let joined = self.holdings.join(before, holding);
            self.concurrent.insert(key, joined);
        }
        self.hold(state, variable, holding);
    }

    /// Whether a variable is a local one of the routine that runs, which starts none that could see
    /// it.
    fn is_of_writer(&self, variable: VariableId) -> bool {
        self.script.variables[variable as usize].routine == Some(self.writer)
            && !self.starts_others[self.writer as usize]
    }

    /// Sets a variable that no other routine sees: what this holds is no other's.
    pub(super) fn hold(&mut self, state: &mut State, variable: VariableId, holding: Holding) {
        if let Some(slot) = self.slots[variable as usize]
            && state.holds[slot as usize] != holding
        {
            self.outdate(state, variable);
            Rc::make_mut(&mut state.holds)[slot as usize] = holding;
        }
    }
}
