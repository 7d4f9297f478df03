//! Which moves may come before a move.

use crate::program::script::short;
use foldhash::{HashMap, HashMapExt};

/// A place where the robot may come from.
pub(super) type Stop = u32;
/// Where the robot stands when the program starts.
pub(super) const START: Stop = u32::MAX - 1;
/// Anywhere: more moves than are distinguished, or an event.
pub(super) const ANYWHERE: Stop = u32::MAX;
/// Moves that are distinguished.
const MOST: usize = 64;

/// A set of stops, an index of [`Sets`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Before(pub u32);

/// Every set once.
#[derive(Debug)]
pub(super) struct Sets {
    /// Those of several; of one stop the set is the stop itself.
    list: Vec<Box<[Stop]>>,
    ids: HashMap<Box<[Stop]>, u32>,
    unions: HashMap<(u32, u32), u32>,
}

/// Numbers of sets in the list begin here; smaller ones are the stop that is alone.
const LISTED: u32 = 1 << 31;

impl Sets {
    pub(super) fn new() -> Self {
        Self {
            list: Vec::new(),
            ids: HashMap::new(),
            unions: HashMap::new(),
        }
    }

    /// The set of one stop.
    pub(super) fn one(&mut self, stop: Stop) -> Before {
        if stop < LISTED {
            return Before(stop);
        }
        self.intern(&[stop])
    }

    fn intern(&mut self, stops: &[Stop]) -> Before {
        if let [one] = stops
            && *one < LISTED
        {
            return Before(*one);
        }
        let list = &mut self.list;
        let id = *self.ids.entry(stops.into()).or_insert_with_key(|stops| {
            list.push(stops.clone());
            LISTED + short(list.len() - 1)
        });
        Before(id)
    }

    /// The stops of a set.
    pub(super) fn of<'a>(&'a self, before: &'a Before) -> &'a [Stop] {
        if before.0 < LISTED {
            std::slice::from_ref(&before.0)
        } else {
            &self.list[(before.0 - LISTED) as usize]
        }
    }

    /// Either.
    pub(super) fn union(&mut self, a: Before, b: Before) -> Before {
        if a == b {
            return a;
        }
        let key = (a.0.min(b.0), a.0.max(b.0));
        if let Some(&union) = self.unions.get(&key) {
            return Before(union);
        }
        let mut both = [self.of(&a), self.of(&b)].concat();
        both.sort_unstable();
        both.dedup();
        if both.len() > MOST {
            both = vec![ANYWHERE];
        }
        if both.contains(&ANYWHERE) {
            both = vec![ANYWHERE];
        }
        let union = self.intern(&both);
        self.unions.insert(key, union.0);
        union
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_union_has_each_stop_once() {
        let mut sets = Sets::new();
        let (a, b) = (sets.one(3), sets.one(5));
        let both = sets.union(a, b);
        assert_eq!(sets.of(&both), [3, 5]);
        assert_eq!(sets.union(both, b), both);
        let start = sets.one(START);
        let three = sets.union(both, start);
        assert_eq!(sets.of(&three), [3, 5, START]);
    }

    #[test]
    fn too_many_are_anywhere() {
        let mut sets = Sets::new();
        let mut all = sets.one(0);
        for stop in 1..100 {
            let one = sets.one(stop);
            all = sets.union(all, one);
        }
        assert_eq!(sets.of(&all), [ANYWHERE]);
    }
}
