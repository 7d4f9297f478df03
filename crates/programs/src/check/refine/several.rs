//! Moves of one instruction: in a loop, behind a branch, in a routine that is called more than once.

use super::{Change, Job};
use std::collections::BTreeMap;

impl Job<'_> {
    /// The changes of all stops, and of several at the end of one instruction (in a loop, in a
    /// routine that is called more than once) a single one: new targets before it are on the way to
    /// each of them, or on that to none.
    pub(super) fn one_each(&self, mut changes: Vec<Option<Change>>) -> Vec<Change> {
        let mut stops: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for stop in 0..changes.len() {
            let instruction = self.walk.motion(stop).instruction;
            stops.entry(instruction).or_default().push(stop);
        }
        for stops in stops.values().filter(|stops| stops.len() > 1) {
            let between = |stop: &usize| {
                let insertion = changes[*stop].as_ref()?.insertion.as_ref()?;
                Some(&insertion.between)
            };
            let Some(first) = stops.iter().find(|stop| between(stop).is_some()).copied() else {
                continue;
            };
            let is_same = stops.iter().all(|stop| between(stop) == between(&first));
            let insertions = stops.iter().filter_map(|stop| {
                let change = changes[*stop].as_ref()?;
                change.insertion.as_ref().map(|_| change.whole_m)
            });
            let whole_m = insertions.fold(0.0, f64::max);
            for stop in stops.iter().filter(|stop| **stop != first || !is_same) {
                changes[*stop].take_if(|change| change.insertion.is_some());
            }
            if !is_same {
                let why = "the robot comes here from several moves";
                changes[first] = Some(Change {
                    file: self.walk.motion(first).file as usize,
                    whole_m,
                    insertion: None,
                    finding: Some(self.failed(self.walk.motion(first), whole_m, why)),
                });
            }
        }
        changes.into_iter().flatten().collect()
    }
}
