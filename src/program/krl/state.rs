//! What is known of $TOOL, $BASE, `FDAT_ACT` and `$IPO_MODE` at a statement.

use super::notes::{Fdat, Index, Ipo};
use super::tokens::Place;
use crate::program::rapid::names::Symbol;
use std::collections::HashMap;

/// What a tool or base is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Setting {
    /// What it was before the program.
    Initial,
    /// An entry of its table.
    Entry(u32),
    /// $NULLFRAME, or $WORLD.
    Zero,
    /// A variable of the files, by its declaration.
    Declared(u32, Index),
    /// A variable that the files do not declare.
    Undeclared(Symbol),
    /// EK: it hangs on another kinematic.
    Moving,
    /// Six numbers, by their bits.
    Literal([u64; 6]),
    /// What an FDAT says.
    Fdat(Fdat),
    /// A mode.
    Ipo(Ipo),
}

/// The value of one variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// As it was where the routine started.
    Entry,
    /// This setting, by [`Settings::of`].
    Is(u32),
    /// Only the running program knows; the statement that says so.
    Unknown(Place),
}

/// The value of one variable, and a call outside the files that may have changed it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    pub value: Value,
    pub doubt: Option<Place>,
}

impl Slot {
    pub fn new(value: Value) -> Self {
        Self { value, doubt: None }
    }

    /// What holds where two ways meet.
    fn merge(self, other: Self, at: Place) -> Self {
        let value = match (self.value, other.value) {
            (a, b) if a == b => a,
            (unknown @ Value::Unknown(_), _) | (_, unknown @ Value::Unknown(_)) => unknown,
            _ => Value::Unknown(at),
        };
        Self {
            value,
            doubt: self.doubt.or(other.doubt),
        }
    }

    /// The value where `Entry` stands for `entry`.
    pub fn resolve(self, entry: Self) -> Self {
        if self.value == Value::Entry {
            Self {
                value: entry.value,
                doubt: self.doubt.or(entry.doubt),
            }
        } else {
            self
        }
    }
}

/// Tool, base, mode, `FDAT_ACT`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct State(pub [Slot; 4]);

pub const TOOL: usize = 0;
pub const BASE: usize = 1;
pub const IPO: usize = 2;
pub const FDAT: usize = 3;

impl State {
    /// Everything as it was where the routine started.
    pub fn entry() -> Self {
        Self([Slot::new(Value::Entry); 4])
    }

    /// Nothing is known.
    pub fn unknown(at: Place) -> Self {
        Self([Slot::new(Value::Unknown(at)); 4])
    }

    pub fn merge(self, other: Self, at: Place) -> Self {
        Self(std::array::from_fn(|i| self.0[i].merge(other.0[i], at)))
    }

    pub fn resolve(self, entry: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i].resolve(entry.0[i])))
    }

    /// After a call to a routine outside the files.
    pub fn doubted(self, at: Place) -> Self {
        Self(self.0.map(|slot| Slot {
            doubt: slot.doubt.or(Some(at)),
            ..slot
        }))
    }
}

/// Every setting once.
#[derive(Debug, Default)]
pub struct Settings {
    list: Vec<Setting>,
    ids: HashMap<Setting, u32>,
}

impl Settings {
    pub fn id(&mut self, setting: Setting) -> u32 {
        let list = &mut self.list;
        *self.ids.entry(setting).or_insert_with(|| {
            list.push(setting);
            super::tokens::index(list.len() - 1)
        })
    }

    pub fn of(&self, id: u32) -> Setting {
        self.list[id as usize]
    }
}

/// A state for each statement, kept once where neighbours have the same.
pub struct States {
    kinds: Vec<State>,
    /// Indices in `kinds`; [`NONE`] where there is none.
    of: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl States {
    /// None yet, for `count` statements.
    pub fn new(count: usize) -> Self {
        Self {
            kinds: Vec::new(),
            of: vec![NONE; count],
        }
    }

    pub fn set(&mut self, statement: usize, state: State) {
        if self.kinds.last() != Some(&state) {
            self.kinds.push(state);
        }
        self.of[statement] = super::tokens::index(self.kinds.len() - 1);
    }

    pub fn get(&self, statement: usize) -> Option<State> {
        self.kinds.get(self.of[statement] as usize).copied()
    }

    pub fn iter(&self) -> impl Iterator<Item = Option<State>> {
        (0..self.of.len()).map(|statement| self.get(statement))
    }
}
