//! Every candidate given a model, kept at hand while the model changes.

use super::candidates::Candidate;
use super::{Chosen, Scored, World, overlaps};
use crate::diagnose::estimator::fit::Fit;
use crate::diagnose::estimator::gain::{Gain, Given, Group};
use crate::diagnose::estimator::steps::Steps;
use crate::diagnose::estimator::table::{Column, Stored, dot};
use crate::diagnose::judgement::CLEAR;
use crate::model::effects::Kind;
use rayon::prelude::*;

/// Rows on both sides of a row from which on an effect holds.
pub(crate) const ROWS_GIVEN: usize = 5;

/// Every candidate seen from a fit without effects: good as long as its weights are.
#[derive(Debug)]
struct Seen {
    base: Fit,
    groups: Vec<Group>,
    /// Of candidates that begin at a row.
    steps: Vec<Option<Steps>>,
}

/// A model with effects, and every candidate given it.
#[derive(Debug)]
pub(crate) struct View {
    /// Products of the candidates' columns with those that are held, while every row counts fully.
    products: Vec<Vec<f64>>,
    seen: Seen,
    full: Fit,
    side: Side,
    /// Columns of the effects that are shown.
    shown: Vec<Vec<Column>>,
}

/// The effects of a model, and what every candidate has in common with them.
#[derive(Debug)]
struct Side {
    given: Given,
    /// Products of each candidate's columns with those of the effects.
    cross: Vec<Vec<f64>>,
    /// The same from each first row on, of candidates that begin at a row.
    steps: Vec<Option<Vec<Vec<Vec<f64>>>>>,
}

impl Side {
    fn of(world: &World, seen: &Seen, full: &Fit, chosen: &[Chosen]) -> Self {
        let effects: Vec<&[Column]> = chosen.iter().map(|c| c.columns.as_slice()).collect();
        let base = &seen.base;
        let given = Given::of((base, world.held), full, &effects);
        let cross = |column: &Stored| {
            let own = base.weighted(&column.column());
            given.partial().iter().map(|p| dot(p, &own)).collect()
        };
        let cross = world.candidates.columns.par_iter().map(cross).collect();
        let from = |(steps, candidate): (&Option<Steps>, &Candidate)| {
            let columns = || from_row_1(world, candidate);
            let own = |steps: &Steps| steps.cross(base, world.layout, &columns(), &given);
            steps.as_ref().map(own)
        };
        let all = seen.steps.iter().zip(&world.candidates.list);
        let steps = all.map(from).collect();
        Self {
            given,
            cross,
            steps,
        }
    }
}

/// Columns of a candidate that begins at a row, as if it began with the first.
fn from_row_1(world: &World, candidate: &Candidate) -> Vec<Column> {
    let own = candidate.columns.iter();
    own.map(|i| world.candidates.columns[*i].column()).collect()
}

/// Leaves out what others are held against, and with it the drifts with a short constant that
/// explain no more, clearly, than what is there from the first row on.
fn without_short_drifts(world: &World, all: &mut Vec<Scored>) {
    let list = &world.candidates.list;
    let steady = all.iter().filter(|s| list[s.index].is_measure);
    let steady: Vec<(usize, f64)> = steady.map(|s| (s.index, s.gain.gain)).collect();
    all.retain(|s| {
        let candidate = &list[s.index];
        let mut held = steady.iter().filter(|(i, _)| candidate.steady == Some(*i));
        !candidate.is_measure && held.all(|(_, gain)| s.gain.gain > gain + CLEAR)
    });
}

/// Products of candidates' columns, by their indices, seen from a fit of what is held.
fn group_of(world: &World, products: &[Vec<f64>], base: &Fit, columns: &[usize]) -> Group {
    let own = |i: &usize| world.candidates.columns[*i].column();
    let own: Vec<Column> = columns.iter().map(own).collect();
    let both = columns.iter().zip(&own);
    let taken = both.map(|(i, column)| world.normal.taken(base, column, &products[*i]));
    let taken: Vec<Vec<f64>> = taken.collect();
    let own: Vec<Column> = own.iter().map(|column| base.weighted(column)).collect();
    let with = |column: &Column| own.iter().map(|other| dot(column, other)).collect();
    let slopes = own.iter().map(|column| dot(column, &base.left));
    Group::of(own.iter().map(with).collect(), slopes.collect(), &taken)
}

impl Seen {
    fn of(world: &World, products: &[Vec<f64>], base: Fit) -> Self {
        let list = world.candidates.list.par_iter();
        let group = |candidate: &Candidate| group_of(world, products, &base, &candidate.columns);
        let groups = list.clone().map(group).collect();
        let begins = |candidate: &Candidate| {
            candidate.row.map(|_| {
                let columns = from_row_1(world, candidate);
                Steps::of((&base, world.held), world.layout, &columns, ROWS_GIVEN)
            })
        };
        let steps = list.map(begins).collect();
        Self {
            base,
            groups,
            steps,
        }
    }
}

impl View {
    /// Without effects.
    #[must_use]
    pub(crate) fn of(world: &World) -> Self {
        let columns = world.candidates.columns.par_iter();
        let products = columns.map(|c| world.normal.products(&c.column()));
        let products: Vec<Vec<f64>> = products.collect();
        let (base, full) = world.fits(&[]);
        let seen = Seen::of(world, &products, base);
        Self {
            side: Side::of(world, &seen, &full, &[]),
            products,
            seen,
            full,
            shown: Vec::new(),
        }
    }

    /// Turns to a model with these effects.
    pub(crate) fn show(&mut self, world: &World, chosen: &[Chosen]) {
        let same = self.shown.len() == chosen.len();
        if same && (self.shown.iter().zip(chosen)).all(|(s, c)| *s == c.columns) {
            return;
        }
        let (base, full) = world.fits(chosen);
        self.full = full;
        if self.seen.base.roots != self.full.roots {
            self.seen = Seen::of(world, &self.products, base);
        }
        self.side = Side::of(world, &self.seen, &self.full, chosen);
        self.shown = chosen.iter().map(|c| c.columns.clone()).collect();
    }

    /// Every candidate given a model with all of these effects, best first.
    pub(crate) fn best(&mut self, world: &World, chosen: &[Chosen]) -> Vec<Scored> {
        self.show(world, chosen);
        self.scan(world, chosen, &vec![true; chosen.len()])
    }

    /// How much chi-squared rises without the effects that are not kept.
    #[must_use]
    pub(crate) fn loss(&self, keep: &[bool]) -> f64 {
        let given = &self.side.given;
        let all = given.kept(&vec![true; keep.len()]);
        (given.deviance(&given.kept(keep)) - given.deviance(&all)) / self.full.evidence().powi(2)
    }

    /// Every candidate given those of the effects shown that are kept, best first.
    #[must_use]
    pub(crate) fn scan(&self, world: &World, chosen: &[Chosen], keep: &[bool]) -> Vec<Scored> {
        self.scan_side(world, &self.side, chosen, keep)
    }

    /// Every candidate given other effects than those shown, with the weights and the scale of
    /// those shown.
    #[must_use]
    pub(crate) fn scan_others(&self, world: &World, others: &[Chosen]) -> Vec<Scored> {
        let side = Side::of(world, &self.seen, &self.full, others);
        self.scan_side(world, &side, others, &vec![true; others.len()])
    }

    /// What all of a kind gain together given those of the effects shown that are kept: which
    /// candidates, one for each place, and their gain and values. Values stay physical only if
    /// they are `bounded`.
    #[must_use]
    pub(crate) fn set_of(
        &self,
        world: &World,
        (chosen, keep): (&[Chosen], &[bool]),
        kind: Kind,
        bounded: bool,
    ) -> Option<(Vec<usize>, Gain)> {
        let list = &world.candidates.list;
        let is_taken = |i: usize| {
            let mut with = chosen.iter().zip(keep).filter(|(_, keep)| **keep);
            with.any(|(c, _)| overlaps(&list[i], None, &c.candidate))
        };
        let own = |i: &usize| {
            list[*i].effect.kind == kind && list[*i].columns.len() == 1 && !is_taken(*i)
        };
        let own: Vec<usize> = (0..list.len()).filter(own).collect();
        let columns: Vec<usize> = own.iter().map(|i| list[*i].columns[0]).collect();
        let bound = |i: &usize| list[*i].least[0].filter(|_| bounded);
        let least: Vec<Option<f64>> = own.iter().map(bound).collect();
        let group = group_of(world, &self.products, &self.seen.base, &columns);
        let cross = columns.iter().map(|c| self.side.cross[*c].as_slice());
        let cross: Vec<&[f64]> = cross.collect();
        let kept = self.side.given.kept(keep);
        let gain = self.side.given.gain(&group, &cross, &kept, &least)?;
        Some((own, gain))
    }

    /// What all of a kind would gain together given the effects shown: one for each place, those
    /// at their bound left out.
    #[must_use]
    pub(crate) fn all_of(&self, world: &World, chosen: &[Chosen], kind: Kind) -> Vec<Scored> {
        let list = &world.candidates.list;
        let all = vec![true; chosen.len()];
        let Some((own, gain)) = self.set_of(world, (chosen, &all), kind, true) else {
            return Vec::new();
        };
        let live: Vec<usize> = (0..own.len()).filter(|k| gain.values[*k] != 0.0).collect();
        // the gain belongs to all of them: each has its part
        let part = gain.gain / live.len().max(1) as f64;
        let one = |k: usize| Scored {
            index: own[k],
            row: None,
            gain: Gain {
                gain: part,
                values: vec![gain.values[k]],
                count: 1,
            },
            cost: world.cost(&list[own[k]], part, 1),
        };
        live.into_iter().map(one).collect()
    }

    fn scan_side(
        &self,
        world: &World,
        side: &Side,
        chosen: &[Chosen],
        keep: &[bool],
    ) -> Vec<Scored> {
        let with: Vec<&Chosen> = (chosen.iter().zip(keep))
            .filter_map(|(c, keep)| keep.then_some(c))
            .collect();
        let kept = side.given.kept(keep);
        let taken = |candidate: &Candidate, row: Option<u32>| {
            with.iter().any(|c| overlaps(candidate, row, &c.candidate))
        };
        let scored = |(index, candidate): (usize, &Candidate)| -> Vec<Scored> {
            let of = |row, gain: Gain| Scored {
                index,
                row,
                cost: world.cost(candidate, gain.gain, gain.count),
                gain,
            };
            if let (Some(steps), Some(cross)) = (&self.seen.steps[index], &side.steps[index]) {
                let free = vec![None; candidate.columns.len()];
                let each = steps.rows.iter().zip(&steps.groups).zip(cross);
                return each
                    .filter_map(|((row, group), cross)| {
                        let row = u32::try_from(row + 1).ok();
                        if taken(candidate, row) {
                            return None;
                        }
                        let cross: Vec<&[f64]> = cross.iter().map(Vec::as_slice).collect();
                        let gain = side.given.gain(group, &cross, &kept, &free)?;
                        Some(of(row, gain))
                    })
                    .collect();
            }
            if taken(candidate, None) {
                return Vec::new();
            }
            let own = candidate.columns.iter();
            let cross: Vec<&[f64]> = own.map(|i| side.cross[*i].as_slice()).collect();
            let group = &self.seen.groups[index];
            let gain = side.given.gain(group, &cross, &kept, &candidate.least);
            let gain = gain.filter(|gain| candidate.is_usual(&gain.values));
            gain.map(|gain| of(None, gain)).into_iter().collect()
        };
        let list = world.candidates.list.par_iter().enumerate();
        let mut all: Vec<Scored> = list.flat_map_iter(scored).collect();
        without_short_drifts(world, &mut all);
        all.sort_by(|a, b| b.merit().total_cmp(&a.merit()));
        all
    }
}
