//! Which registers programs may read as they were before the run: those that they do not write on
//! every way before.

use crate::program::script::RoutineId;
use foldhash::HashSet;
use std::collections::BTreeMap;

/// What a program does with the numbers in registers.
#[derive(Clone, Debug)]
pub(super) enum Step {
    Reads(u32),
    /// A number of a position register, whichever.
    ReadsAny,
    Writes {
        number: u32,
        /// Also where the program ends: no jump to its end passes it by.
        at_end: bool,
    },
    /// It runs another; whatever way it goes, or on some.
    Calls {
        routine: RoutineId,
        is_sure: bool,
        at_end: bool,
    },
}

impl Step {
    fn counts_at_end(&self) -> bool {
        match self {
            Self::Writes { at_end, .. } | Self::Calls { at_end, .. } => *at_end,
            Self::Reads(_) | Self::ReadsAny => false,
        }
    }
}

/// The steps of all programs, in the order of their texts.
#[derive(Debug, Default)]
pub(super) struct Steps {
    all: BTreeMap<RoutineId, Vec<Step>>,
    /// Programs that run next to those that start them.
    started: HashSet<RoutineId>,
}

type Sets = BTreeMap<RoutineId, HashSet<u32>>;

impl Steps {
    pub(super) fn add(&mut self, routine: RoutineId, steps: impl IntoIterator<Item = Step>) {
        self.all.entry(routine).or_default().extend(steps);
    }

    pub(super) fn starts(&mut self, routine: RoutineId) {
        self.started.insert(routine);
    }

    /// The numbers that may be read as they were before; `positions` are those of position
    /// registers.
    pub(super) fn read_before(&self, positions: &[u32]) -> HashSet<u32> {
        let writes = self.until_stable(|steps, writes| {
            let mut written: HashSet<u32> = HashSet::default();
            for step in steps.iter().filter(|step| step.counts_at_end()) {
                add_written(&mut written, step, writes);
            }
            written
        });
        let reads = self.until_stable(|steps, reads| {
            let mut read: HashSet<u32> = HashSet::default();
            let mut written: HashSet<u32> = HashSet::default();
            for step in steps {
                let is_open = |number: &&u32| !written.contains(*number);
                match step {
                    Step::Reads(number) => read.extend(Some(number).filter(is_open)),
                    Step::ReadsAny => read.extend(positions.iter().filter(is_open)),
                    Step::Writes { .. } => {}
                    Step::Calls { routine, .. } => {
                        read.extend(reads.get(routine).into_iter().flatten().filter(is_open));
                    }
                }
                add_written(&mut written, step, &writes);
            }
            read
        });
        let mut found = HashSet::default();
        for routine in self.entries() {
            found.extend(reads.get(&routine).into_iter().flatten());
        }
        found
    }

    /// What each program comes to, which depends on those that it calls.
    fn until_stable(&self, of: impl Fn(&[Step], &Sets) -> HashSet<u32>) -> Sets {
        let mut sets = Sets::new();
        loop {
            let mut is_stable = true;
            for (routine, steps) in &self.all {
                let now = of(steps, &sets);
                let before = sets.get(routine).map_or(0, HashSet::len);
                is_stable &= now.len() == before;
                sets.insert(*routine, now);
            }
            if is_stable {
                return sets;
            }
        }
    }

    /// The programs that may run first, or next to others; of those that only call each other all.
    fn entries(&self) -> HashSet<RoutineId> {
        let callees = |routine: RoutineId| {
            let steps = self.all.get(&routine).into_iter().flatten();
            steps.filter_map(|step| match step {
                Step::Calls { routine, .. } => Some(*routine),
                _ => None,
            })
        };
        let called: HashSet<RoutineId> = self.all.keys().copied().flat_map(callees).collect();
        let is_first =
            |routine: &&RoutineId| !called.contains(*routine) || self.started.contains(*routine);
        let mut entries: HashSet<RoutineId> = self.all.keys().filter(is_first).copied().collect();
        let mut reached = entries.clone();
        let mut open: Vec<RoutineId> = entries.iter().copied().collect();
        while let Some(one) = open.pop() {
            open.extend(callees(one).filter(|callee| reached.insert(*callee)));
        }
        entries.extend(
            self.all
                .keys()
                .filter(|routine| !reached.contains(*routine)),
        );
        entries
    }
}

/// What is written behind a step whatever way a program goes.
fn add_written(written: &mut HashSet<u32>, step: &Step, writes: &Sets) {
    match step {
        Step::Writes { number, .. } => _ = written.insert(*number),
        Step::Calls {
            routine,
            is_sure: true,
            ..
        } => written.extend(writes.get(routine).into_iter().flatten()),
        _ => {}
    }
}
