//! Fake targets put into edits, portion by portion, on all processors.

use super::approach::{Approach, Solved};
use super::outcome::Tally;
use super::rewrite::{self, Portion};
use super::split::Split;
use super::{Job, TargetReport, deciding, displaced};
use crate::finding::Finding;
use crate::geometry::{Pose, Separation};
use crate::inverse::Outcome;
use crate::program::Edits;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Targets rewritten by one thread at a time.
const CHUNK: usize = 128;

/// What became of all targets.
pub(super) struct Rewritten {
    /// Of each of the program's targets, unless only the summary is asked for.
    pub reports: Vec<TargetReport>,
    /// Of each source.
    pub edits: Vec<Edits>,
    pub tally: Tally,
    /// Fake targets that points are derived from.
    pub fakes: BTreeMap<usize, Pose>,
    /// How far targets are shifted by whose numbers the program decides, metres.
    pub deciding: BTreeMap<usize, f64>,
    /// Moves that are to get a target of their own.
    pub splits: Vec<Split>,
    /// Configuration data that change: index in the program's numbers, and the value.
    pub meant: Vec<(u32, f64)>,
    /// As [`Portion::needed`].
    pub needed: Separation,
}

/// Puts the fake targets into edits, on all processors.
pub(super) fn rewrite_all(
    job: &Job,
    approaches: &[Approach],
    outcomes: &[Outcome],
    findings: &mut Vec<Finding>,
) -> Rewritten {
    let fractions = rewrite::fractions(job);
    let mut groups: Vec<std::ops::Range<usize>> = Vec::with_capacity(approaches.len());
    let mut from = 0;
    for at in 1..=approaches.len() {
        if at == approaches.len() || approaches[at].target != approaches[from].target {
            groups.push(from..at);
            from = at;
        }
    }
    if approaches.is_empty() {
        groups.clear();
    }
    let bases = displaced::bases(job);
    let rewrite = |groups: &[std::ops::Range<usize>]| {
        let mut portion = Portion::new(&bases, groups.len());
        let mut group = Vec::with_capacity(1);
        for range in groups {
            group.clear();
            let solved = |at: usize| Solved::of(job, &approaches[at], &outcomes[at]);
            group.extend(range.clone().map(solved));
            portion.add(job, &group, &fractions);
        }
        portion
    };
    let reported = if job.options.summary_only {
        0
    } else {
        job.ground.program.targets.len()
    };
    let mut all = Rewritten {
        reports: vec![TargetReport::new(None); reported],
        edits: room_for_edits(job),
        tally: Tally::new(job),
        fakes: BTreeMap::new(),
        deciding: deciding::targets(job),
        splits: Vec::new(),
        meant: Vec::new(),
        needed: Separation::default(),
    };
    let chunks: Vec<&[std::ops::Range<usize>]> = groups.chunks(CHUNK).collect();
    // a few chunks for each thread at a time: what they return is not in memory twice for a long
    // program
    let mut some = chunks.chunks(8 * rayon::current_num_threads());
    let of = |some: &[&[std::ops::Range<usize>]]| -> Vec<Portion> {
        some.par_iter().map(|groups| rewrite(groups)).collect()
    };
    let mut portions = some.next().map(of);
    while let Some(done) = portions {
        // the next are written while these are put together
        let next = some.next();
        portions = rayon::join(|| next.map(of), || all.add(job, done, findings)).0;
    }
    all
}

impl Rewritten {
    /// Adds what was done with some of the targets.
    fn add(&mut self, job: &Job, portions: Vec<Portion>, findings: &mut Vec<Finding>) {
        for portion in portions {
            for (target, report) in portion.reports {
                self.tally.add(job, target, &report);
                if let Some(fake) = report
                    .fake
                    .filter(|_| portion.bases.contains(&target) || job.ridden.contains(&target))
                {
                    self.fakes.insert(target, fake);
                }
                // a target that is written out at its moves keeps its numbers
                let is_other = report.changed && report.fake.is_some();
                if let Some(shift_m) = self.deciding.get_mut(&target).filter(|_| is_other) {
                    *shift_m = report.shift.distance_m;
                }
                if let Some(place) = self.reports.get_mut(target) {
                    *place = report;
                }
            }
            for (source, changes) in &portion.edits {
                self.edits[*source as usize].append(changes);
            }
            findings.extend(portion.findings);
            self.splits.extend(portion.splits);
            self.meant.extend(portion.meant);
            self.needed = rewrite::largest(self.needed, portion.needed);
        }
    }
}

/// For each file an empty list with room for new text in place of all numbers of its targets.
fn room_for_edits(job: &Job) -> Vec<Edits> {
    let program = job.ground.program;
    let mut room = vec![(0, 0); job.ground.sources.len()];
    for target in &program.targets {
        let (spans, bytes) = &mut room[target.file as usize];
        for number in program.numbers_of(target) {
            *spans += 1;
            *bytes += usize::from(number.length) + 1;
        }
    }
    room.into_iter()
        .map(|(spans, bytes)| Edits::with_room(spans, bytes))
        .collect()
}
