//! Data that several tasks share, and what one task writes while another runs.
//!
//! A PERS that is neither LOCAL nor TASK is one datum in all tasks of the controller that declare it.
//!
//! # Source
//! ABB, Technical reference manual RAPID Overview, and Application manual Controller software,
//! Multitasking: persistent data between tasks.

use super::aggregate::Leaf;
use super::resolved::{Resolved, named};
use super::syntax::{
    Callee, Datum, Element, Parsed, Part, StatementKind, Storage, Stored, Type, Verb, indices,
};
use super::translate::Translator;
use crate::program::names::{Context, Symbol};
use crate::program::script::Place;
use crate::program::script::{Expr, How, Start, Written, short};
use crate::program::{Source, TargetId};
use foldhash::{HashMap, HashMapExt};

/// One datum that several modules declare.
pub(super) struct Group {
    pub name: Symbol,
    /// The modules that declare it.
    pub modules: Vec<u32>,
    /// All declarations.
    pub members: Vec<u32>,
    /// Those that have its value; one where it does not matter which.
    pub declarations: Vec<u32>,
    /// All of these have the same value.
    pub alike: bool,
}

/// The data that tasks may share.
pub(super) fn groups(parsed: &Parsed, sources: &[Source]) -> Vec<Group> {
    let is_shared = |datum: &&Datum| datum.storage == Storage::Shared;
    // names are mostly declared once
    let mut times: Vec<u8> = Vec::new();
    for datum in parsed.data.iter().filter(is_shared) {
        let at = datum.name.0 as usize;
        if times.len() <= at {
            times.resize(at + 1, 0);
        }
        times[at] = times[at].saturating_add(1);
    }
    let mut found: Vec<Vec<u32>> = Vec::new();
    let mut known: HashMap<(Symbol, Type), usize> = HashMap::new();
    for (at, datum) in (0..).zip(&parsed.data) {
        if is_shared(&datum) && times[datum.name.0 as usize] > 1 {
            let group = *known.entry((datum.name, datum.kind)).or_insert_with(|| {
                found.push(Vec::new());
                found.len() - 1
            });
            found[group].push(at);
        }
    }
    let groups = found.iter().map(|all| group(parsed, sources, all));
    groups.flatten().collect()
}

/// Declarations of one name and type as one datum; `None` where a module has two of them.
fn group(parsed: &Parsed, sources: &[Source], all: &[u32]) -> Option<Group> {
    let datum = |at: u32| &parsed.data[at as usize];
    let first = datum(*all.first()?);
    let mut modules: Vec<u32> = all.iter().map(|at| datum(*at).context.module).collect();
    modules.sort_unstable();
    if all.len() < 2 || modules.windows(2).any(|pair| pair[0] == pair[1]) {
        return None;
    }
    let has_value = |at: &u32| !matches!(datum(*at).value, Stored::Nothing | Stored::Computed);
    let mut declarations: Vec<u32> = all.iter().copied().filter(has_value).collect();
    if declarations.is_empty() {
        declarations.push(all[0]);
    }
    let one = datum(declarations[0]);
    let alike = declarations[1..]
        .iter()
        .all(|other| are_alike(parsed, sources, one, datum(*other)));
    // each target has numbers of its own that are rewritten
    if alike && !first.kind.is_target() {
        declarations.truncate(1);
    }
    Some(Group {
        name: first.name,
        modules,
        members: all.to_vec(),
        declarations,
        alike,
    })
}

/// Whether two declarations have the same value.
fn are_alike(parsed: &Parsed, sources: &[Source], first: &Datum, other: &Datum) -> bool {
    let leaves = |one: Part, two: Part| {
        let (one, two) = (&parsed.leaves[indices(one)], &parsed.leaves[indices(two)]);
        let bytes = [first, other].map(|of| &sources[of.place.file as usize].bytes[..]);
        let mut pairs = one.iter().zip(two);
        one.len() == two.len() && pairs.all(|(one, two)| is_same_leaf([*one, *two], bytes))
    };
    match (first.value, other.value) {
        (
            Stored::Elements {
                elements: one,
                sizes,
            },
            Stored::Elements {
                elements: two,
                sizes: others,
            },
        ) => {
            let (one, two) = (
                &parsed.elements[indices(one)],
                &parsed.elements[indices(two)],
            );
            let same = |(one, two): (&Element, &Element)| match (one, two) {
                (Element::Target(one), Element::Target(two)) => {
                    numbers(parsed, *one) == numbers(parsed, *two)
                }
                _ => false,
            };
            sizes == others && one.len() == two.len() && one.iter().zip(two).all(same)
        }
        (Stored::Leaves(one), Stored::Leaves(two)) => leaves(one, two),
        (
            Stored::Row { leaves: one, count },
            Stored::Row {
                leaves: two,
                count: others,
            },
        ) => count == others && leaves(one, two),
        (one, two) => one == two,
    }
}

/// Whether two leaves have the same value, each of a file with these bytes.
fn is_same_leaf(leaves: [Leaf; 2], [one, two]: [&[u8]; 2]) -> bool {
    let text = |bytes: &[u8], start: u32, length: u16| {
        let start = start as usize;
        bytes
            .get(start..start + usize::from(length))
            .map(<[u8]>::to_vec)
    };
    match leaves {
        [
            Leaf::Number { value, .. },
            Leaf::Number { value: other, .. },
        ] => value.total_cmp(&other).is_eq(),
        [
            Leaf::Text { start, length },
            Leaf::Text {
                start: there,
                length: others,
            },
        ] => text(one, start, length) == text(two, there, others),
        [Leaf::Computed, _] => false,
        [leaf, other] => leaf == other,
    }
}

/// The numbers of a target with its external axes, bit by bit.
fn numbers(parsed: &Parsed, target: TargetId) -> (Vec<u64>, Vec<(u8, u64)>, u8) {
    let own = &parsed.targets[target].numbers;
    let own = &parsed.numbers[own.start as usize..own.end as usize];
    let external = &parsed.external;
    let from = external.partition_point(|(of, ..)| *of < target);
    let axes = external[from..].iter().take_while(|(of, ..)| *of == target);
    (
        own.iter().map(|number| number.value.to_bits()).collect(),
        axes.map(|(_, axis, value)| (*axis, value.to_bits()))
            .collect(),
        parsed.external_zeros[target],
    )
}

/// The tasks that may run a routine, bit by bit.
type Tasks = u64;

/// Nobody knows which.
const ANY: Tasks = u64::MAX;

impl Resolved<'_> {
    /// Of each routine whether another task may move the robot while it writes; empty where tasks
    /// share nothing.
    pub(super) fn written_meanwhile(&self) -> Vec<bool> {
        if !self.has_shared() {
            return Vec::new();
        }
        let routines = &self.parsed.routines;
        let is_main = |at: &usize| self.is_main(short(*at));
        let mains: Vec<usize> = (0..routines.len()).filter(is_main).collect();
        let mut calls: Vec<Vec<u32>> = vec![Vec::new(); routines.len()];
        let mut moves = vec![false; routines.len()];
        self.follow_calls(&mut calls, &mut moves);
        let mut tasks: Vec<Tasks> = vec![0; routines.len()];
        for (bit, &main) in mains.iter().enumerate() {
            let task = if mains.len() < 64 { 1 << bit } else { ANY };
            let mut open = vec![short(main)];
            while let Some(routine) = open.pop() {
                let of = &mut tasks[routine as usize];
                if *of & task != task {
                    *of |= task;
                    open.extend(&calls[routine as usize]);
                }
            }
        }
        // what nothing calls belongs to the task of its module
        let of_module = |module: u32| {
            let mut own = mains
                .iter()
                .filter(|main| routines[**main].module == module);
            own.next().map_or(ANY, |main| tasks[*main])
        };
        let all: Vec<Tasks> = tasks
            .iter()
            .zip(routines)
            .map(|(task, routine)| match *task {
                0 => of_module(routine.module),
                task => task,
            })
            .collect();
        let mut moving: Vec<Tasks> = all
            .iter()
            .copied()
            .zip(moves)
            .filter(|of| of.1)
            .map(|of| of.0)
            .collect();
        moving.sort_unstable();
        moving.dedup();
        let meanwhile = |own: &Tasks| {
            let is_own = |of: &Tasks| of == own && own.is_power_of_two();
            !moving.iter().all(is_own)
        };
        all.iter().map(meanwhile).collect()
    }

    /// The routines that each routine calls, and whether it moves the robot.
    fn follow_calls(&self, calls: &mut [Vec<u32>], moves: &mut [bool]) {
        let mut context = Context {
            module: 0,
            routine: None,
        };
        let mut file = 0;
        for statement in &self.parsed.statements {
            let (callee, verb, arguments, of_function) = match statement.kind {
                StatementKind::Text {
                    file: in_file,
                    context: now,
                } => {
                    (context, file) = (now, in_file);
                    continue;
                }
                StatementKind::Call(call) => (call.callee, call.verb, call.arguments, false),
                StatementKind::Function(function) => {
                    let of = self.parsed.functions[function as usize];
                    (Callee::Named(of.name), Verb::Other, of.arguments, true)
                }
                _ => continue,
            };
            let Some(routine) = context.routine.map(|routine| routine as usize) else {
                continue;
            };
            let callees = self.callees(callee, arguments, context, file);
            // what is not in the files and is given a target may move to it
            let is_given = || {
                let mut given = self.list(of_function)[indices(arguments)].iter();
                given.any(|argument| {
                    named(&argument.expression)
                        .and_then(|name| self.kind(name, context))
                        .is_some_and(Type::is_target)
                })
            };
            moves[routine] |= matches!(verb, Verb::Move { .. } | Verb::Yields { .. })
                || verb == Verb::Other && callees.foreign && is_given();
            calls[routine].extend(callees.routines);
        }
    }
}

impl Translator<'_> {
    /// Whether others may move the robot while the present routine writes.
    fn is_meanwhile(&self) -> bool {
        let routine = self.context.routine.map(|routine| routine as usize);
        let of = routine.and_then(|routine| self.writes_meanwhile.get(routine));
        of.copied().unwrap_or(false)
    }

    /// Notes what other tasks find of this write at any time.
    pub(super) fn note_meanwhile(&mut self, place: Place, variable: Written, how: &How) {
        if !self.is_meanwhile() {
            return;
        }
        let script = &self.builder.script;
        let is_shared = match variable {
            Written::One(variable) => self.shared.contains(&variable),
            Written::AnyOf(table) => {
                let mut entries = script.tables[table as usize].entries.values();
                entries.any(|variable| self.shared.contains(variable))
            }
        };
        if !is_shared {
            return;
        }
        let how = match how {
            // what this task's own data hold nobody else knows
            How::Whole(value) if self.depends(*value) => How::PartSomehow(self.changed()),
            how => how.clone(),
        };
        self.meanwhile.push((place, variable, how));
    }

    /// Whether a value depends on what variables hold.
    fn depends(&self, value: Expr) -> bool {
        let lists = &self.builder.script.lists;
        match value {
            Expr::Variable(_) | Expr::Element { .. } => true,
            Expr::Any { first, end } => {
                let mut all = lists[first as usize..end as usize].iter();
                all.any(|inner| self.depends(*inner))
            }
            Expr::Displaced { base, .. } | Expr::DisplacedByCall { base, .. } => {
                self.depends(lists[base as usize])
            }
            _ => false,
        }
    }

    /// What tasks write while others run, in any order and any number of times.
    pub(super) fn run_meanwhile(&mut self) {
        let all = std::mem::take(&mut self.meanwhile);
        let Some(first) = all.first() else {
            return;
        };
        let builder = &mut self.builder;
        let routine = builder.declare("", first.0, Start::Concurrent);
        builder.open(routine);
        builder.begin_loop(true);
        for (place, variable, how) in all {
            builder.begin_if(None);
            builder.write(place, variable, how);
            builder.end_choice();
        }
        builder.end_loop(false);
        builder.close();
    }
}
