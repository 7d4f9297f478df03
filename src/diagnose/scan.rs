//! Every candidate beside a model, kept at hand while the model changes.

use super::beside::{Beside, Group};
use super::candidates::Candidate;
use super::fit::{Fit, Projection};
use super::search::{Chosen, Scored, World, overlaps};
use super::table::Column;
use rayon::prelude::*;

/// Rows on both sides of a row from which on an effect holds.
const ROWS_BESIDE: usize = 5;

/// Every candidate seen from a fit without effects: good as long as its weights are.
#[derive(Debug)]
struct Seen {
    base: Fit,
    projections: Vec<Projection>,
    groups: Vec<Group>,
}

/// A model with effects, and every candidate beside it.
#[derive(Debug)]
pub struct View {
    seen: Seen,
    full: Fit,
    beside: Beside,
    /// Products of each candidate's columns with those of the effects.
    cross: Vec<Vec<f64>>,
    /// Columns of the effects that are shown.
    shown: Vec<Vec<Column>>,
}

impl Seen {
    fn of(world: &World, full: &Fit) -> Self {
        let base = full.with_held(world.residual, &world.held(&[]));
        let projections = base.projections(&world.candidates.columns);
        let group = |candidate: &Candidate| {
            let own = candidate.columns.iter().map(|i| &projections[*i]);
            Group::of(&base, &own.collect::<Vec<_>>())
        };
        let groups = world.candidates.list.par_iter().map(group).collect();
        Self {
            base,
            projections,
            groups,
        }
    }
}

impl View {
    /// Without effects.
    #[must_use]
    pub fn of(world: &World) -> Self {
        let full = world.fit(&[]);
        let seen = Seen::of(world, &full);
        let beside = Beside::of(&seen.base, &full, &[]);
        let cross = vec![Vec::new(); seen.projections.len()];
        Self {
            seen,
            full,
            beside,
            cross,
            shown: Vec::new(),
        }
    }

    /// Turns to a model with these effects.
    pub fn show(&mut self, world: &World, chosen: &[Chosen]) {
        let same = self.shown.len() == chosen.len();
        if same && (self.shown.iter().zip(chosen)).all(|(s, c)| *s == c.columns) {
            return;
        }
        self.full = world.fit(chosen);
        if self.seen.base.roots != self.full.roots {
            self.seen = Seen::of(world, &self.full);
        }
        let effects: Vec<&[Column]> = chosen.iter().map(|c| c.columns.as_slice()).collect();
        let beside = Beside::of(&self.seen.base, &self.full, &effects);
        let projections = self.seen.projections.par_iter();
        self.cross = projections.map(|p| beside.cross(p)).collect();
        self.beside = beside;
        self.shown = chosen.iter().map(|c| c.columns.clone()).collect();
    }

    /// Every candidate beside a model with all of these effects, best first.
    pub fn best(&mut self, world: &World, chosen: &[Chosen]) -> Vec<Scored> {
        self.show(world, chosen);
        self.scan(world, chosen, &vec![true; chosen.len()])
    }

    /// How much chi-squared rises without the effects that are not kept.
    #[must_use]
    pub fn loss(&self, keep: &[bool]) -> f64 {
        let all = self.beside.kept(&vec![true; keep.len()]);
        let kept = self.beside.kept(keep);
        (self.beside.deviance(&kept) - self.beside.deviance(&all)) / self.full.scale.powi(2)
    }

    /// Every candidate beside those of the effects shown that are kept, best first.
    #[must_use]
    pub fn scan(&self, world: &World, chosen: &[Chosen], keep: &[bool]) -> Vec<Scored> {
        let with: Vec<&Chosen> = (chosen.iter().zip(keep))
            .filter_map(|(c, keep)| keep.then_some(c))
            .collect();
        let kept = self.beside.kept(keep);
        let columns: Vec<&Column> = with.iter().flat_map(|c| &c.columns).collect();
        let any_row = world.candidates.list.iter().any(|c| c.row.is_some());
        let fit = any_row.then(|| self.seen.base.seeking(&columns, &self.full));
        let taken = |candidate: &Candidate, row: Option<u32>| {
            with.iter().any(|c| overlaps(candidate, row, &c.candidate))
        };
        let scored = |(index, candidate): (usize, &Candidate)| -> Vec<Scored> {
            let of = |row, gain: super::fit::Gain| Scored {
                index,
                row,
                cost: world.cost(candidate, gain.count),
                gain,
            };
            if let Some(fit) = fit.as_ref().filter(|_| candidate.row.is_some()) {
                let own = candidate.columns.iter();
                let own: Vec<&Column> = own.map(|i| &world.candidates.columns[*i]).collect();
                let gains = fit.gains_from_rows(world.layout, &own, ROWS_BESIDE);
                let rows = gains
                    .into_iter()
                    .map(|(row, gain)| (u32::try_from(row + 1).ok(), gain));
                let free = rows.filter(|(row, _)| !taken(candidate, *row));
                return free.map(|(row, gain)| of(row, gain)).collect();
            }
            if taken(candidate, None) {
                return Vec::new();
            }
            let own = candidate.columns.iter();
            let cross: Vec<&[f64]> = own.map(|i| self.cross[*i].as_slice()).collect();
            let group = &self.seen.groups[index];
            let gain = self.beside.gain(group, &cross, &kept, &candidate.least);
            gain.map(|gain| of(None, gain)).into_iter().collect()
        };
        let list = world.candidates.list.par_iter().enumerate();
        let mut all: Vec<Scored> = list.flat_map_iter(scored).collect();
        all.sort_by(|a, b| b.merit().total_cmp(&a.merit()));
        all
    }
}
