//! Which tool and load are set where a move stands: followed through branches, loops and calls.
//!
//! Where more than one value may be set, none is told. A function starts with what is set where it is called; where it is
//! not called, with nothing set. What a thread sets may be set anywhere.

use super::syntax::{Event, ExprId, FunctionId, Notes, Symbol};
use crate::program::Load;
use std::collections::HashMap;

/// Functions of one name that are told apart: a program has one.
const MOST_OF_A_NAME: usize = 4;
/// Passes over the file after which loops and calls must have settled.
const MOST_PASSES: usize = 8;

/// What may be set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Set<T> {
    /// The text is never reached.
    Unreached,
    /// Nothing yet.
    Nothing,
    /// This.
    Value(T),
    /// One of several, or something that only the running program knows; the places of two assignments.
    Several(u32, u32),
}

/// A tool by its number, with the place where it is set.
#[derive(Clone, Copy, Debug)]
pub struct Keyed {
    pub key: u32,
    pub offset: u32,
}

impl PartialEq for Keyed {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

/// Tool and load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    pub tool: Set<Keyed>,
    /// `Some(None)` where it is set, but not written out.
    pub load: Set<Option<Load>>,
}

const UNREACHED: State = State {
    tool: Set::Unreached,
    load: Set::Unreached,
};
const NOTHING: State = State {
    tool: Set::Nothing,
    load: Set::Nothing,
};
const SEVERAL: State = State {
    tool: Set::Several(0, 0),
    load: Set::Several(0, 0),
};

fn join<T: PartialEq + Copy>(a: Set<T>, b: Set<T>, place: impl Fn(T) -> u32) -> Set<T> {
    let place = |set: Set<T>| match set {
        Set::Value(value) => place(value),
        _ => 0,
    };
    match (a, b) {
        (Set::Unreached, other) | (other, Set::Unreached) => other,
        (Set::Several(..), _) => a,
        (_, Set::Several(..)) => b,
        _ if a == b => a,
        _ => Set::Several(place(a), place(b)),
    }
}

impl State {
    fn and(self, other: Self) -> Self {
        Self {
            tool: join(self.tool, other.tool, |tool| tool.offset),
            load: join(self.load, other.load, |_| 0),
        }
    }
}

/// What a call of each function does, and with what it starts; grows from pass to pass.
struct Known {
    entry: Vec<State>,
    exit: Vec<State>,
    /// It sets something, itself or in what it calls.
    sets: Vec<bool>,
    /// What comes back to the start of each loop, by function.
    loops: Vec<Vec<State>>,
    changed: bool,
}

impl Known {
    fn grow(state: &mut State, by: State, changed: &mut bool) {
        let joined = state.and(by);
        if joined != *state {
            *state = joined;
            *changed = true;
        }
    }
}

enum Open {
    Branch {
        before: State,
        joined: State,
        complete: bool,
    },
    Loop {
        index: usize,
        start: State,
        breaks: State,
    },
}

/// The state at each step. `key_of` tells which tools are the same; `None` is one that only the running program knows.
pub fn states(
    notes: &Notes,
    key_of: &mut dyn FnMut(ExprId, FunctionId) -> Option<u32>,
) -> Vec<State> {
    let count = notes.functions.len();
    let mut keys: HashMap<(ExprId, u32), Option<u32>> = HashMap::new();
    let mut tools: Vec<u32> = Vec::new();
    for (at, function) in notes.functions.iter().enumerate() {
        for event in &function.events {
            if let Event::Tool(value, offset) = event {
                let key = key_of(*value, super::syntax::index(at));
                keys.insert((*value, *offset), key);
                tools.push(key.unwrap_or(u32::MAX));
            }
        }
    }
    tools.sort_unstable();
    tools.dedup();
    let mut states = vec![UNREACHED; notes.steps.len()];
    let names = functions_by_name(notes);
    if names.values().any(|all| all.len() > MOST_OF_A_NAME) {
        return vec![SEVERAL; notes.steps.len()];
    }
    let callees = |name: &Symbol| names.get(name).map_or(&[][..], Vec::as_slice);
    let mut known = Known {
        entry: vec![UNREACHED; count],
        exit: vec![UNREACHED; count],
        sets: vec![false; count],
        loops: vec![Vec::new(); count],
        changed: true,
    };
    for (at, function) in notes.functions.iter().enumerate() {
        let sets = |event: &Event| matches!(event, Event::Tool(..) | Event::Load(_));
        known.sets[at] = function.events.iter().any(sets);
    }
    let mut is_called = vec![false; count];
    for function in &notes.functions {
        for event in &function.events {
            if let Event::Call(name) = event {
                for &callee in callees(name) {
                    is_called[callee] = true;
                }
            }
        }
    }
    for at in 0..count {
        if !is_called[at] {
            known.entry[at] = NOTHING;
        }
    }
    for pass in 0.. {
        if pass == MOST_PASSES {
            return vec![SEVERAL; notes.steps.len()];
        }
        known.changed = false;
        for at in 0..count {
            follow(notes, at, &callees, &keys, &mut known, &mut states);
        }
        if !known.changed {
            break;
        }
    }
    let in_threads = reached_from_threads(notes, &callees);
    let threads_set = (0..count).any(|at| in_threads[at] && known.sets[at]);
    if tools.len() > 1 {
        for (step, state) in notes.steps.iter().zip(&mut states) {
            if threads_set || in_threads[step.function as usize] {
                state.tool = SEVERAL.tool;
            }
        }
    }
    states
}

fn functions_by_name(notes: &Notes) -> HashMap<Symbol, Vec<usize>> {
    let mut names: HashMap<Symbol, Vec<usize>> = HashMap::new();
    for (at, function) in notes.functions.iter().enumerate() {
        if let Some(name) = function.name {
            names.entry(name).or_default().push(at);
        }
    }
    names
}

/// Functions that run in a thread.
fn reached_from_threads<'n>(notes: &Notes, callees: &dyn Fn(&Symbol) -> &'n [usize]) -> Vec<bool> {
    let mut reached = vec![false; notes.functions.len()];
    let threads = notes.functions.iter().enumerate();
    let mut open: Vec<usize> = threads
        .filter(|(_, f)| f.thread)
        .map(|(at, _)| at)
        .collect();
    while let Some(at) = open.pop() {
        if std::mem::replace(&mut reached[at], true) {
            continue;
        }
        for event in &notes.functions[at].events {
            if let Event::Call(name) = event {
                open.extend(callees(name));
            }
        }
    }
    reached
}

/// One pass over one function.
fn follow<'n>(
    notes: &Notes,
    at: usize,
    callees: &dyn Fn(&Symbol) -> &'n [usize],
    keys: &HashMap<(ExprId, u32), Option<u32>>,
    known: &mut Known,
    states: &mut [State],
) {
    let mut state = known.entry[at];
    let mut left = UNREACHED;
    let mut open: Vec<Open> = Vec::new();
    let mut loops = 0;
    for event in &notes.functions[at].events {
        match event {
            Event::Tool(value, offset) => {
                state.tool = match keys.get(&(*value, *offset)).copied().flatten() {
                    Some(key) => Set::Value(Keyed {
                        key,
                        offset: *offset,
                    }),
                    None => Set::Several(*offset, *offset),
                };
            }
            Event::Load(load) => state.load = Set::Value(*load),
            Event::Call(name) => {
                let mut after = UNREACHED;
                for &callee in callees(name) {
                    Known::grow(&mut known.entry[callee], state, &mut known.changed);
                    let thread = notes.functions[callee].thread;
                    if known.sets[callee] && !thread {
                        if !known.sets[at] {
                            known.sets[at] = true;
                            known.changed = true;
                        }
                        after = after.and(known.exit[callee]);
                    } else {
                        after = after.and(state);
                    }
                }
                if !callees(name).is_empty() {
                    state = after;
                }
            }
            Event::If => open.push(Open::Branch {
                before: state,
                joined: UNREACHED,
                complete: false,
            }),
            Event::Else | Event::ElseIf => {
                if let Some(Open::Branch {
                    before,
                    joined,
                    complete,
                }) = open.last_mut()
                {
                    *joined = joined.and(state);
                    *complete |= *event == Event::Else;
                    state = *before;
                }
            }
            Event::EndIf => {
                if let Some(Open::Branch {
                    before,
                    joined,
                    complete,
                }) = open.pop()
                {
                    state = state.and(joined);
                    if !complete {
                        state = state.and(before);
                    }
                }
            }
            Event::Loop => {
                if known.loops[at].len() <= loops {
                    known.loops[at].push(UNREACHED);
                }
                state = state.and(known.loops[at][loops]);
                open.push(Open::Loop {
                    index: loops,
                    start: state,
                    breaks: UNREACHED,
                });
                loops += 1;
            }
            Event::EndLoop => {
                if let Some(Open::Loop {
                    index,
                    start,
                    breaks,
                }) = open.pop()
                {
                    Known::grow(&mut known.loops[at][index], state, &mut known.changed);
                    state = state.and(start).and(breaks);
                }
            }
            Event::Break | Event::Continue => {
                let innermost = open.iter_mut().rev().find_map(|open| match open {
                    Open::Loop { index, breaks, .. } => Some((*index, breaks)),
                    Open::Branch { .. } => None,
                });
                if let Some((index, breaks)) = innermost {
                    *breaks = breaks.and(state);
                    if *event == Event::Continue {
                        Known::grow(&mut known.loops[at][index], state, &mut known.changed);
                    }
                }
                state = UNREACHED;
            }
            Event::Return => {
                left = left.and(state);
                state = UNREACHED;
            }
            Event::Step(step) => states[*step as usize] = state,
        }
    }
    Known::grow(&mut known.exit[at], state.and(left), &mut known.changed);
}
