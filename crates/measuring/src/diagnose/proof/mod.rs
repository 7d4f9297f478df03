//! What the effects found are worth on rows that were not used to choose them.

pub(crate) mod improved;

use crate::diagnose::diagnosis::Options;
use crate::diagnose::estimator::chances::mean_tail;
use crate::diagnose::estimator::table::lengths_m;
use crate::diagnose::judgement::attempt::Attempt;
use crate::diagnose::question::{Trust, for_choice};
use crate::diagnose::search::candidates::Candidate;
use crate::diagnose::search::waves::near;
use crate::diagnose::search::{Chosen, World};
use crate::geometry::units::mm_from_m;
use crate::identify::measurements::Measurements;
use crate::identify::statistics::Spread;
use std::collections::BTreeMap;

/// From so many rows on, one part of them is predicted.
const MANY_ROWS: usize = 400;
/// Parts of the measurements that are left out in turn.
const FOLDS: usize = 5;
/// With fewer parts left out, found again is no evidence.
pub(crate) const FEWEST_PARTS: usize = 4;
/// From so many configurations on, a part is several blocks of neighbours.
const MANY_CONFIGURATIONS: usize = 80;
/// Blocks of a part then.
const BLOCKS: usize = 4;
/// A step found this near to one of the choice is that one.
const NEAR_ROWS: u32 = 20;
/// And found again this near.
const SAME_ROWS: u32 = 5;

/// Better beyond chance: less likely than this by chance.
const BEYOND_CHANCE: f64 = 0.01;

/// Rows that neither of two models was fitted to, predicted by both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compared {
    /// Errors of the model without the effects found, mm.
    pub start: Spread,
    /// With them.
    pub found: Spread,
    /// All that the profile has was fitted again without these rows, for both; else the profile is
    /// taken as it is.
    pub refitted: bool,
    /// Probability that they are better by so much by chance: Student's t of the differences, one
    /// for each configuration.
    pub p_value: f64,
}

impl Compared {
    fn of(start: &[f64], found: &[f64], configurations: &[usize], refitted: bool) -> Option<Self> {
        let mm = |lengths: &[f64]| lengths.iter().map(|l| mm_from_m(*l)).collect::<Vec<_>>();
        let mut by: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
        for ((a, b), configuration) in start.iter().zip(found).zip(configurations) {
            let (sum, count) = by.entry(*configuration).or_default();
            *sum += a - b;
            *count += 1.0;
        }
        let differences: Vec<f64> = by.values().map(|(sum, count)| sum / count).collect();
        Some(Self {
            start: Spread::of(&mm(start))?,
            found: Spread::of(&mm(found))?,
            refitted,
            p_value: mean_tail(&differences),
        })
    }

    /// The effects found predict better, beyond chance.
    #[must_use]
    pub fn is_better(&self) -> bool {
        self.p_value < BEYOND_CHANCE
    }

    /// They predict worse on average.
    #[must_use]
    pub fn is_worse(&self) -> bool {
        self.found.mean > self.start.mean
    }
}

/// Rows not used, predicted.
#[derive(Clone, Debug)]
pub(crate) struct Proof {
    /// Lengths of their residuals, metres: present model, what is absorbed, then with each effect.
    lengths: Vec<Vec<f64>>,
    /// The profile as it is, against its calibration with the effects found on top. A profile that
    /// was calibrated with these rows has seen those left out: it is better than it should be.
    /// None where it is fitted anew.
    pub profile: Option<Compared>,
    /// Everything that the profile has fitted again without the rows left out, without and with
    /// the effects found.
    pub equal: Option<Compared>,
    /// The profile as it is, against all this, where it was not calibrated with these measurements:
    /// no answer may be worse.
    pub present: Option<Compared>,
    /// All effects found, fitted without the rows left out, predict them no worse than those that
    /// are found again without them.
    pub all_predict: bool,
    /// For each effect, in how many parts it was found again, and of how many.
    pub again: Vec<(usize, usize)>,
}

impl Proof {
    /// Nothing was left out.
    pub(crate) fn none(effects: usize) -> Self {
        Self {
            lengths: vec![Vec::new(); 2 + effects],
            profile: None,
            equal: None,
            present: None,
            all_predict: true,
            again: vec![(0, 0); effects],
        }
    }

    /// The comparison by which the effects found are judged: the better of those that are fair to
    /// them.
    pub(crate) fn judged(&self) -> Option<Compared> {
        let both = self.profile.iter().chain(&self.equal);
        both.copied().min_by(|a, b| a.p_value.total_cmp(&b.p_value))
    }

    /// Rows left out are predicted better than without what was found, beyond chance, and no worse
    /// than by a profile that has not seen them.
    pub(crate) fn is_better(&self) -> bool {
        self.judged().is_some_and(|judged| judged.is_better())
            && !self.present.is_some_and(|present| present.is_worse())
    }

    /// Statistics of each step, mm.
    pub(crate) fn spreads(&self) -> Vec<Option<Spread>> {
        let of = |lengths: &Vec<f64>| {
            Spread::of(&lengths.iter().map(|l| mm_from_m(*l)).collect::<Vec<_>>())
        };
        self.lengths.iter().map(of).collect()
    }
}

/// Rows to choose with in parts: contiguous blocks of whole configurations.
fn folds(measurements: &Measurements, choice: &[bool]) -> Vec<Vec<usize>> {
    let configurations = measurements.configurations();
    let last = configurations
        .iter()
        .max()
        .map_or(0, |last| last + 1)
        .max(1);
    let each = if last >= MANY_CONFIGURATIONS {
        BLOCKS
    } else {
        1
    };
    let fold = |row: usize| (configurations[row] * FOLDS * each / last) % FOLDS;
    (0..FOLDS)
        .map(|f| {
            let rows = (0..choice.len()).filter(|row| choice[*row]);
            rows.filter(|row| fold(*row) == f).collect()
        })
        .collect()
}

/// Rows that are predicted, part by part, and those that are left out besides to see what is found
/// again.
struct Parts {
    predicted: Vec<Vec<usize>>,
    /// Whether the choice is another one without those predicted.
    are_of_choice: bool,
    left_out: Vec<Vec<usize>>,
}

impl Parts {
    /// Rows kept for it are predicted, else the rows to choose with, of many one part.
    fn of(measurements: &Measurements, choice: &[bool]) -> Self {
        let mut folds = folds(measurements, choice);
        folds.retain(|rows| !rows.is_empty());
        let validate: Vec<usize> = (0..choice.len()).filter(|r| !choice[*r]).collect();
        let are_of_choice = validate.is_empty();
        if !are_of_choice {
            return Self {
                predicted: vec![validate],
                are_of_choice,
                left_out: folds,
            };
        }
        let most = if choice.len() > MANY_ROWS { 1 } else { FOLDS };
        let left_out = folds.split_off(most.min(folds.len()));
        Self {
            predicted: folds,
            are_of_choice,
            left_out,
        }
    }
}

/// Where a step lies is a fact of the data: rows left out near it cannot say.
fn keep_rows(world: &World, chosen: &[Chosen], own: &mut [Chosen]) {
    for found in own.iter_mut().filter(|c| c.candidate.row.is_some()) {
        let near = |w: &&Chosen| {
            let rows = w.candidate.row.zip(found.candidate.row);
            w.candidate.effect.kind == found.candidate.effect.kind
                && rows.is_some_and(|(x, y)| x.abs_diff(y) <= NEAR_ROWS)
        };
        if let Some(known) = chosen.iter().find(near) {
            found.candidate.row = known.candidate.row;
            found.candidate.effect.site.order = known.candidate.effect.site.order;
            found.columns = world.columns(&found.candidate);
        }
    }
}

/// The same effect at the same place.
fn like(a: &Candidate, b: &Candidate) -> bool {
    let rows = a.row.zip(b.row);
    a.effect.kind == b.effect.kind
        && rows.is_none_or(|(x, y)| x.abs_diff(y) <= SAME_ROWS)
        && (a.row.is_some() || a.effect.site == b.effect.site || near(&a.effect, &b.effect))
}

/// What one part of the rows, left out, says.
struct Part {
    lengths: Vec<Vec<f64>>,
    equal: [Vec<f64>; 2],
    /// By all effects found.
    all: Vec<f64>,
    again: Vec<bool>,
    configurations: Vec<usize>,
}

/// Which of the effects found this choice has, too.
fn again(found: &[Chosen], own: &[Chosen]) -> Vec<bool> {
    let is_again = |found: &Chosen| {
        // one that a person asked for is there whatever its merit
        let is_again = |c: &Chosen| like(&found.candidate, &c.candidate) && c.merit() > 0.0;
        own.iter().any(is_again)
    };
    found.iter().map(is_again).collect()
}

/// The choice made again without parts of the measurements, and those predicted with these of the
/// effects found.
pub(crate) fn held_out(
    attempt: &Attempt,
    chosen: &[Chosen],
    measurements: &Measurements,
    options: &Options,
) -> Proof {
    let session = &attempt.session;
    let choice = for_choice(measurements);
    let parts = Parts::of(measurements, &choice);
    let steps = 2 + chosen.len();
    let mut lengths = vec![Vec::new(); steps];
    let configurations = measurements.configurations();
    let present = lengths_m(&session.problem, &session.layout, &session.present);
    let free = vec![1.0; session.shares.len()];
    let without = |test: &[usize]| -> Vec<bool> {
        let mut used = choice.clone();
        for row in test {
            used[*row] = false;
        }
        used
    };
    let choose = |world: &World| -> Vec<Chosen> {
        let mut own = world.search(session.first(world));
        keep_rows(world, chosen, &mut own);
        own
    };
    let one = |test: &Vec<usize>| -> Part {
        let used = without(test);
        let world = session.world(&used, &options.accept);
        let own = choose(&world);
        let mut lengths = vec![test.iter().map(|r| present[*r]).collect()];
        let predicted = |world: &World, kept: &[Chosen]| -> Vec<f64> {
            let all = lengths_m(&session.problem, &session.layout, &world.rest(kept));
            test.iter().map(|r| all[*r]).collect()
        };
        // those of the effects found that this choice finds, too: no others are judged
        let among = |wanted: &[Chosen]| -> Vec<Chosen> {
            let is_among = |c: &&Chosen| wanted.iter().any(|w| like(&w.candidate, &c.candidate));
            own.iter().filter(is_among).cloned().collect()
        };
        for step in 0..=chosen.len() {
            lengths.push(predicted(&world, &among(&chosen[..step])));
        }
        let found = among(chosen);
        let anew = session.world_of(&used, &options.accept, &free);
        Part {
            lengths,
            equal: [predicted(&anew, &[]), predicted(&anew, &found)],
            all: predicted(&world, chosen),
            again: again(chosen, &own),
            configurations: test.iter().map(|r| configurations[*r]).collect(),
        }
    };
    let (mut equal, mut of_rows) = ([Vec::new(), Vec::new()], Vec::new());
    let mut of_all: Vec<f64> = Vec::new();
    let mut flags: Vec<Vec<bool>> = Vec::new();
    // one after the other: each holds a basis of its own, and its search runs on all cores
    for part in parts.predicted.iter().map(one) {
        for (all, own) in lengths.iter_mut().zip(part.lengths) {
            all.extend(own);
        }
        for (all, own) in equal.iter_mut().zip(part.equal) {
            all.extend(own);
        }
        of_rows.extend(part.configurations);
        of_all.extend(part.all);
        flags.extend(parts.are_of_choice.then_some(part.again));
    }
    if !chosen.is_empty() {
        flags.extend(parts.left_out.iter().map(|test| {
            let used = without(test);
            let own = choose(&session.world(&used, &options.accept));
            again(chosen, &own)
        }));
    }
    let times = |i: usize| flags.iter().filter(|again| again[i]).count();
    let again = (0..chosen.len()).map(|i| (times(i), flags.len()));
    let profile = match attempt.trust {
        Trust::Calibrated { .. } => Compared::of(&lengths[0], &lengths[steps - 1], &of_rows, false),
        Trust::Nothing => None,
    };
    let present = (options.is_new)
        .then(|| Compared::of(&lengths[0], &lengths[steps - 1], &of_rows, false))
        .flatten();
    let all_predict = of_all.iter().sum::<f64>() <= lengths[steps - 1].iter().sum::<f64>();
    Proof {
        present,
        all_predict,
        lengths,
        profile,
        equal: Compared::of(&equal[0], &equal[1], &of_rows, true),
        again: again.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of three reflectors at each of so many configurations, the last kept for validation.
    fn rows(configurations: usize, validate: usize) -> (Measurements, Vec<bool>) {
        let header = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,point\n";
        let mut csv = header.to_owned();
        for k in 0..3 * configurations {
            csv += &format!("{},0,0,0,0,0,{k},0,0,p{}\n", k / 3, k % 3);
        }
        let measurements = Measurements::from_csv(csv.as_bytes()).expect("a table");
        let choice = (0..3 * configurations).map(|k| k / 3 < configurations - validate);
        let choice = choice.collect();
        (measurements, choice)
    }

    #[test]
    fn parts_are_whole_configurations_and_many_enough() {
        for (configurations, validate, predicted) in [(60, 0, 5), (200, 0, 1), (60, 10, 1)] {
            let (measurements, choice) = rows(configurations, validate);
            let parts = Parts::of(&measurements, &choice);
            assert_eq!(parts.predicted.len(), predicted);
            assert_eq!(parts.are_of_choice, validate == 0);
            let again = parts.left_out.len() + if validate == 0 { predicted } else { 0 };
            assert!(again >= FEWEST_PARTS, "{configurations}: {again}");
            let all: Vec<&Vec<usize>> = parts.predicted.iter().chain(&parts.left_out).collect();
            for part in &all {
                for row in *part {
                    let first = row / 3 * 3;
                    assert!((first..first + 3).all(|other| part.contains(&other)));
                }
            }
            let count: usize = all.iter().map(|part| part.len()).sum();
            assert_eq!(count, 3 * configurations);
        }
    }
}
