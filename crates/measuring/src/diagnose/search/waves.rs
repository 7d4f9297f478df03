//! Orders of waves in a joint's angle, up to those of its gear: a periodogram of the residual.
//!
//! A wave of every order has two columns at every joint; those of the lowest orders are candidates
//! from the beginning, the others only where the periodogram has a peak.
//!
//! # Source
//! J. D. Scargle, "Studies in astronomical time series analysis II" (1982): the periodogram of
//! unevenly spaced readings, here with the weight that the joint has in each of them.

use super::candidates::{Candidates, MOST_ORDERS, columns_of};
use crate::diagnose::estimator::fit::Fit;
use crate::diagnose::estimator::table::{Column, Layout, dot};
use crate::identify::problem::{Estimate, Problem};
use crate::model::JOINTS;
use crate::model::effects::{Effect, Kind, MOST_PARAMETERS, REGISTRY, Site, SiteKey};
use rayon::prelude::*;

/// Half orders are tried from here on, periods in one revolution: below, they are what any slow
/// function is made of.
const HALVES_FROM: u32 = 6;
/// And up to here: two gears in series.
const HALVES_TO: u32 = 64;
/// The highest order: the waves of a strain wave gear of 1 : 160, two each revolution of its
/// generator.
const HIGHEST: u32 = 320;
/// Peaks of a joint that are looked at.
const PEAKS: usize = 3;

/// Orders between two of the periodogram that a peak is refined by.
const FINE: u32 = 100;
/// A wave between orders gains so much more than that of the next order, to be it: the price of a
/// value chosen, with strong evidence (R. E. Kass, A. E. Raftery, "Bayes factors" (1995)).
const BETWEEN: f64 = 10.0;

/// Every order of the periodogram, in the registry's count, ascending.
fn orders() -> Vec<u32> {
    let one = SiteKey::Order.one();
    let whole = (MOST_ORDERS + 1..=HIGHEST).map(|n| n * one);
    let halves = (HALVES_FROM..HALVES_TO).map(|n| n * one + one / 2);
    let mut all: Vec<u32> = whole.chain(halves).collect();
    all.sort_unstable();
    all
}

/// How many waves there are to choose from.
pub(crate) fn places() -> usize {
    JOINTS * orders().len()
}

/// The effect that is a wave.
pub(crate) fn wave(joint: usize, order: u32) -> Effect {
    let has_order = |kind: &&Kind| kind.definition().site.contains(&SiteKey::Order);
    Effect {
        kind: *(REGISTRY.iter().find(has_order)).expect("a wave is in the registry"),
        site: Site {
            index: joint,
            order,
            ..Site::default()
        },
        parameters: [0.0; MOST_PARAMETERS],
    }
}

/// What the rows say of a joint: the product of its rotation with the residual, its square, and its
/// angle.
struct Seen {
    slopes: Column,
    squares: Column,
    angles: Column,
}

impl Seen {
    fn of(problem: &Problem, layout: &Layout, fit: &Fit, turn: &Column, joint: usize) -> Self {
        let weighted: Column = turn.iter().zip(&fit.roots).map(|(c, w)| c * w).collect();
        let rows = 0..layout.rows();
        let with = |other: &Column| -> Column {
            let each = rows.clone().map(|row| layout.row(row));
            each.map(|r| dot(&weighted[r.clone()], &other[r])).collect()
        };
        let mechanism = problem.mechanism();
        let angle = |row: usize| mechanism.commanded(&problem.rows[row].q)[joint];
        Self {
            slopes: with(&fit.left),
            squares: with(&weighted),
            angles: rows.clone().map(angle).collect(),
        }
    }

    /// What a wave of this order gains, in units of its noise squared, before it is seen given all
    /// that is fitted.
    fn gain(&self, order: f64, variance: f64) -> f64 {
        let (mut a, mut b, mut cc, mut cs, mut ss) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for ((slope, square), angle) in self.slopes.iter().zip(&self.squares).zip(&self.angles) {
            let (s, c) = (order * angle).sin_cos();
            a += slope * c;
            b += slope * s;
            cc += square * c * c;
            cs += square * c * s;
            ss += square * s * s;
        }
        let size = cc * ss - cs * cs;
        if size <= 1e-6 * cc * ss {
            return 0.0;
        }
        (a * a * ss - 2.0 * a * b * cs + b * b * cc) / (size * variance)
    }
}

/// Waves that the residual of a fit has and that are no candidates yet, where they are worth more
/// than `least`.
pub(crate) fn peaks(
    problem: &Problem,
    estimate: &Estimate,
    layout: &Layout,
    fit: &Fit,
    known: &Candidates,
    least: f64,
) -> Vec<Effect> {
    let orders = orders();
    let periods: Vec<f64> = orders.iter().map(|n| wave(0, *n).site.periods()).collect();
    let variance = fit.evidence().powi(2);
    // a wave of no period: the joint's rotation alone
    let turns: Vec<(Effect, Vec<usize>)> = (0..JOINTS).map(|i| (wave(i, 0), vec![0])).collect();
    let turns = columns_of(problem, estimate, &turns);
    let of_joint = |joint: usize| -> Vec<Effect> {
        let seen = Seen::of(problem, layout, fit, &turns[joint][0], joint);
        let gains: Vec<f64> = periods.iter().map(|n| seen.gain(*n, variance)).collect();
        let is_peak = |k: &usize| {
            let neighbours = [k.checked_sub(1), Some(k + 1)].into_iter().flatten();
            let mut neighbours = neighbours.filter_map(|other| gains.get(other));
            gains[*k] > least && neighbours.all(|other| *other <= gains[*k])
        };
        let mut found: Vec<usize> = (0..orders.len()).filter(is_peak).collect();
        found.sort_by(|a, b| gains[*b].total_cmp(&gains[*a]));
        found.truncate(PEAKS);
        let between = |k: usize| {
            let least = orders[k.saturating_sub(1)];
            let most = orders[(k + 1).min(orders.len() - 1)];
            let step = (SiteKey::Order.one() / FINE).max(1);
            let fine = (least..=most).step_by(step as usize);
            let gain = |order: u32| seen.gain(wave(0, order).site.periods(), variance);
            let all = fine.map(|order| (gain(order), order));
            let best = all.max_by(|a, b| a.0.total_cmp(&b.0));
            // by the residual with the wave: without it the noise seems louder than it is
            let rest = |gain: f64| (fit.freedom - gain).max(0.01 * fit.freedom);
            let by = |gain: f64| fit.freedom * (rest(gains[k]) / rest(gain)).ln();
            best.filter(|(gain, _)| by(*gain) > BETWEEN)
                .map_or(orders[k], |(_, order)| order)
        };
        found.into_iter().map(|k| wave(joint, between(k))).collect()
    };
    let found: Vec<Vec<Effect>> = (0..JOINTS).into_par_iter().map(of_joint).collect();
    let all = found.into_iter().flatten();
    all.filter(|effect| known.is_new(effect)).collect()
}

/// Whether two effects are waves of one joint with orders that are next to each other in the
/// periodogram: the same wave.
pub(crate) fn near(a: &Effect, b: &Effect) -> bool {
    a.kind == b.kind
        && a.definition().site.contains(&SiteKey::Order)
        && a.site.index == b.site.index
        && a.site.order.abs_diff(b.site.order) <= SiteKey::Order.one() / 2
}

/// The waves of the orders next to that of an effect, where it is a wave of the periodogram and
/// they are no candidates yet.
pub(crate) fn neighbours(effect: &Effect, known: &Candidates) -> Vec<Effect> {
    if !effect.definition().site.contains(&SiteKey::Order) {
        return Vec::new();
    }
    let orders = orders();
    let Ok(own) = orders.binary_search(&effect.site.order) else {
        return Vec::new();
    };
    let next = [own.checked_sub(1), Some(own + 1)].into_iter().flatten();
    let next = next.filter_map(|k| orders.get(k));
    let all = next.map(|order| wave(effect.site.index, *order));
    all.filter(|effect| known.is_new(effect)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wave_between_whole_orders_has_its_own_peak() {
        let angles: Column = (0..90).map(|k| 2.4 * (f64::from(k) * 0.77).sin()).collect();
        let squares: Column = (0..90).map(|k| 1.0 + 0.5 * f64::from(k % 3)).collect();
        for hidden in [13.5, 17.0, 101.0] {
            let slopes = (angles.iter().zip(&squares)).map(|(q, w)| w * (hidden * q + 0.4).cos());
            let seen = Seen {
                slopes: slopes.collect(),
                squares: squares.clone(),
                angles: angles.clone(),
            };
            let of = |n: &u32| seen.gain(wave(0, *n).site.periods(), 1.0);
            let best = orders().into_iter().max_by(|a, b| of(a).total_cmp(&of(b)));
            let best = best.map(|n| wave(0, n).site.periods());
            assert_eq!(best, Some(hidden));
        }
        assert_eq!(orders().len() * JOINTS, places());
        assert!(orders().windows(2).all(|w| w[0] < w[1]));
    }
}
