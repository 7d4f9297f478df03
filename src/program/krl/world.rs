//! Names resolved over all files.

use super::notes::{Action, DataKind, Datum, Flow, Index, Notes, Statement, Stored};
use super::tokens::index;
use crate::program::rapid::names::{Context, Meaning, Scopes, Symbol};

/// Routines of the controller and its packages that change neither tool nor base.
const HARMLESS: [&[u8]; 14] = [
    b"set_cd_params",
    b"ir_stopm",
    b"sread",
    b"swrite",
    b"cread",
    b"cwrite",
    b"copen",
    b"cclose",
    b"timer_limit",
    b"clear_krlmsg",
    b"set_krlmsg",
    b"msgnotify",
    b"delete_backward_buffer",
    b"sync_interrupt",
];

/// All that was noted, with its names resolved.
pub struct World {
    pub notes: Notes,
    data: Scopes,
    routines: Scopes,
    /// Values by declaration and element, in that order.
    values: Vec<(u32, Index, Stored)>,
    assigned: Vec<bool>,
    calls: Vec<Vec<u32>>,
}

/// What a name of a position leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lead {
    /// Values of this declaration, part of [`World::values`].
    Values {
        datum: u32,
        first: usize,
        last: usize,
    },
    /// Declared, without a value in the files.
    Empty(u32),
    /// Declared more than once.
    Ambiguous,
    /// Not in the files.
    Unknown,
}

impl World {
    pub fn new(notes: Notes) -> Self {
        let (mut data, mut routines) = (Scopes::default(), Scopes::default());
        for (at, datum) in notes.data.iter().enumerate() {
            data.add(datum.name, datum.context, !datum.global, index(at));
        }
        let mut first_of_module = vec![true; notes.modules.len()];
        for (at, routine) in notes.routines.iter().enumerate() {
            let context = Context {
                module: routine.module,
                routine: None,
            };
            // the first routine of a file is seen everywhere
            let first = std::mem::take(&mut first_of_module[routine.module as usize]);
            routines.add(routine.name, context, !(first || routine.global), index(at));
        }
        let mut world = Self {
            assigned: vec![false; notes.data.len()],
            calls: vec![Vec::new(); notes.routines.len()],
            values: Vec::new(),
            data,
            routines,
            notes,
        };
        let resolved = world.notes.initials.iter().filter_map(|initial| {
            let datum = world.datum(initial.name, initial.context)?.ok()?;
            Some((datum, initial.index, initial.value))
        });
        let mut values: Vec<_> = resolved.collect();
        values.sort_by_key(|&(datum, index, _)| (datum, index));
        world.values = values;
        for at in 0..world.notes.assigned.len() {
            let assigned = world.notes.assigned[at];
            match world.data.meaning(assigned.name, assigned.context) {
                Meaning::One(datum) => world.assigned[datum as usize] = true,
                Meaning::Several(list) => {
                    for &datum in world.data.several(list) {
                        world.assigned[datum as usize] = true;
                    }
                }
                Meaning::Nothing => {}
            }
        }
        for at in 0..world.notes.statements.len() {
            let statement = world.notes.statements[at];
            if let Action::Call(name) = statement.action
                && let Some(callee) = world.routine(name, world.context(&statement))
            {
                world.calls[statement.routine as usize].push(callee);
            }
        }
        world
    }

    pub fn context(&self, statement: &Statement) -> Context {
        Context {
            module: self.notes.routines[statement.routine as usize].module,
            routine: Some(statement.routine),
        }
    }

    /// The routine of a name.
    pub fn routine(&self, name: Symbol, context: Context) -> Option<u32> {
        match self.routines.meaning(name, context) {
            Meaning::One(routine) => Some(routine),
            _ => None,
        }
    }

    /// The declaration of a name; `Err` where there are several.
    pub fn datum(&self, name: Symbol, context: Context) -> Option<Result<u32, ()>> {
        match self.data.meaning(name, context) {
            Meaning::One(datum) => Some(Ok(datum)),
            Meaning::Several(_) => Some(Err(())),
            Meaning::Nothing => None,
        }
    }

    pub fn declared(&self, datum: u32) -> &Datum {
        &self.notes.data[datum as usize]
    }

    /// Every declaration that a name may mean.
    pub fn candidates(&self, name: Symbol, context: Context) -> Vec<u32> {
        match self.data.meaning(name, context) {
            Meaning::One(datum) => vec![datum],
            Meaning::Several(list) => self.data.several(list).to_vec(),
            Meaning::Nothing => Vec::new(),
        }
    }

    /// Whether a statement changes a variable.
    pub fn is_assigned(&self, datum: u32) -> bool {
        self.assigned[datum as usize]
    }

    /// The values of one element, or of all where only the running program knows which.
    pub fn lead(&self, name: Symbol, at: Index, context: Context) -> Lead {
        let datum = match self.datum(name, context) {
            None => return Lead::Unknown,
            Some(Err(())) => return Lead::Ambiguous,
            Some(Ok(datum)) => datum,
        };
        let (first, last) = self.range(datum, at);
        if first == last {
            return Lead::Empty(datum);
        }
        Lead::Values { datum, first, last }
    }

    /// The values of a declaration, or of one element of it.
    pub fn range(&self, datum: u32, at: Index) -> (usize, usize) {
        let all = |key: (u32, Index)| {
            let first = self.values.partition_point(|&(d, i, _)| (d, i) < key);
            let last = self.values.partition_point(|&(d, i, _)| (d, i) <= key);
            (first, last)
        };
        match at {
            Index::Whole | Index::At(_) => all((datum, at)),
            Index::Variable => {
                let first = self.values.partition_point(|&(d, ..)| d < datum);
                let last = self.values.partition_point(|&(d, ..)| d <= datum);
                (first, last)
            }
        }
    }

    /// One value by its place in the list.
    pub fn value(&self, at: usize) -> (Index, Stored) {
        let (_, index, value) = self.values[at];
        (index, value)
    }

    /// The only value of an element.
    pub fn one(&self, datum: u32, at: Index) -> Option<Stored> {
        let (first, last) = self.range(datum, at);
        (last == first + 1).then(|| self.values[first].2)
    }

    /// Each target with a name, and its declaration.
    pub fn named_targets(&self) -> impl Iterator<Item = (u32, usize)> {
        self.values
            .iter()
            .filter_map(|&(datum, _, value)| match value {
                Stored::Target(target) => Some((datum, target)),
                _ => None,
            })
    }

    /// The kind of what a name stands for.
    pub fn kind(&self, name: Symbol, context: Context) -> Option<DataKind> {
        let datum = self.datum(name, context)?.ok()?;
        Some(self.declared(datum).kind)
    }

    /// Names of routines that change neither tool nor base.
    pub fn harmless(&self) -> Vec<Symbol> {
        let found = HARMLESS.iter().map(|name| self.notes.symbols.find(name));
        found.flatten().collect()
    }

    /// All routines, each behind those it calls.
    pub fn callees_first(&self) -> Vec<u32> {
        let mut order = Vec::with_capacity(self.calls.len());
        let mut seen = vec![false; self.calls.len()];
        for start in 0..self.calls.len() {
            if seen[start] {
                continue;
            }
            seen[start] = true;
            let mut open = vec![(index(start), 0)];
            while let Some((routine, next)) = open.last_mut() {
                match self.calls[*routine as usize].get(*next) {
                    None => {
                        order.push(*routine);
                        open.pop();
                    }
                    Some(&callee) => {
                        *next += 1;
                        if !std::mem::replace(&mut seen[callee as usize], true) {
                            open.push((callee, 0));
                        }
                    }
                }
            }
        }
        order
    }

    /// Whether the robot may come here by another way than from the statement before.
    pub fn is_crossing(statement: &Statement) -> bool {
        matches!(statement.action, Action::Flow(flow) if flow != Flow::Return)
    }
}
