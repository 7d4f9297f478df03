//! What the effects found are worth on rows that were not used to choose them.

use super::attempt::Attempt;
use super::candidates::Candidate;
use super::diagnosis::Options;
use super::search::{Chosen, World};
use super::session::for_choice;
use super::table::lengths_m;
use crate::geometry::units::mm_from_m;
use crate::identify::measurements::Measurements;
use crate::identify::statistics::Spread;
use rayon::prelude::*;

/// From so many rows on, one part of them is left out, once.
const MANY_ROWS: usize = 400;
/// Parts of the measurements that are left out in turn.
const FOLDS: usize = 5;
/// From so many configurations on, a part is several blocks of neighbours.
const MANY_CONFIGURATIONS: usize = 80;
/// Blocks of a part then.
const BLOCKS: usize = 4;
/// A step found this near to one of the choice is that one.
const NEAR_ROWS: u32 = 20;
/// And found again this near.
const SAME_ROWS: u32 = 5;

/// Rows not used, predicted.
#[derive(Clone, Debug)]
pub(super) struct Proof {
    /// Lengths of their residuals, metres: present model, what is absorbed, then with each effect.
    lengths: Vec<Vec<f64>>,
    /// For each effect, in how many parts it was found again, and of how many.
    pub again: Vec<(usize, usize)>,
}

impl Proof {
    /// Nothing was left out.
    pub(super) fn none(effects: usize) -> Self {
        Self {
            lengths: vec![Vec::new(); 2 + effects],
            again: vec![(0, 0); effects],
        }
    }

    /// Statistics of each step, mm.
    pub(super) fn spreads(&self) -> Vec<Option<Spread>> {
        let of = |lengths: &Vec<f64>| {
            Spread::of(&lengths.iter().map(|l| mm_from_m(*l)).collect::<Vec<_>>())
        };
        self.lengths.iter().map(of).collect()
    }
}

/// Rows that are left out, part by part: those kept for it, else contiguous blocks of whole configurations.
fn parts(measurements: &Measurements, choice: &[bool]) -> Vec<Vec<usize>> {
    let rows = choice.len();
    let validate: Vec<usize> = (0..rows).filter(|r| !choice[*r]).collect();
    if !validate.is_empty() {
        return vec![validate];
    }
    let configurations = measurements.configurations();
    let last = configurations.last().copied().unwrap_or(0) + 1;
    let each = if last >= MANY_CONFIGURATIONS {
        BLOCKS
    } else {
        1
    };
    let fold = |row: usize| (configurations[row] * FOLDS * each / last) % FOLDS;
    // many rows: one part is enough to judge by
    let parts = if rows > MANY_ROWS { 1 } else { FOLDS };
    (0..parts)
        .map(|f| (0..rows).filter(|r| fold(*r) == f).collect())
        .collect()
}

/// Where a step lies is a fact of the data: rows left out beside it cannot say.
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
        && (a.row.is_some() || a.effect.site == b.effect.site)
}

/// The choice made again without parts of the measurements, and those predicted.
pub(super) fn held_out(attempt: &Attempt, measurements: &Measurements, options: &Options) -> Proof {
    let session = &attempt.session;
    let choice = for_choice(measurements);
    let tests = parts(measurements, &choice);
    let steps = 2 + attempt.chosen.len();
    let mut lengths = vec![Vec::new(); steps];
    let mut again = vec![(0, 0); attempt.chosen.len()];
    let present = lengths_m(&session.problem, &session.layout, &session.present);
    let one = |test: &Vec<usize>| -> (Vec<Vec<f64>>, Vec<bool>) {
        let mut used = choice.clone();
        for row in test {
            used[*row] = false;
        }
        let world = session.world(&used, &options.accept);
        let mut own = world.search(Vec::new());
        keep_rows(&world, &attempt.chosen, &mut own);
        let mut lengths = vec![test.iter().map(|r| present[*r]).collect()];
        for step in 0..=attempt.chosen.len() {
            let wanted = &attempt.chosen[..step];
            let kept: Vec<Chosen> = if step == attempt.chosen.len() {
                own.clone()
            } else {
                own.iter()
                    .filter(|c| wanted.iter().any(|w| like(&w.candidate, &c.candidate)))
                    .cloned()
                    .collect()
            };
            let fit = world.fit(&kept);
            let rest = fit.unweighted_rest(&session.residual, &world.held(&kept));
            let all = lengths_m(&session.problem, &session.layout, &rest);
            lengths.push(test.iter().map(|r| all[*r]).collect());
        }
        let again = attempt
            .chosen
            .iter()
            .map(|found| own.iter().any(|c| like(&found.candidate, &c.candidate)));
        (lengths, again.collect())
    };
    // what is left out does not depend on the other parts
    let parts: Vec<_> = tests
        .par_iter()
        .filter(|t| !t.is_empty())
        .map(one)
        .collect();
    for (own, found) in parts {
        for (all, own) in lengths.iter_mut().zip(own) {
            all.extend(own);
        }
        for ((times, of), found) in again.iter_mut().zip(found) {
            *of += 1;
            *times += usize::from(found);
        }
    }
    Proof { lengths, again }
}
