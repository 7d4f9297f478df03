//! The effects' values with everything fitted together, without linearisation, and the improved
//! profile.

use super::fit::{Fit, Held};
use super::table::{Layout, add_scaled, table};
use crate::diagnose::as_calibrated::known_of;
use crate::diagnose::search::Chosen;
use crate::diagnose::search::candidates::least;
use crate::identify::parameters::{Parameter, Subject};
use crate::identify::problem::{Estimate, Problem};
use crate::model::Slot;
use crate::model::profile::Profile;
use nalgebra::DMatrix;

/// Rounds of Gauss–Newton.
const TURNS: usize = 4;
/// A calibration that does not say how sure it is knows its parameters to this part of their typical
/// sizes.
const KNOWN: f64 = 0.3;
/// No calibration is surer, in typical sizes.
const SURE: f64 = 1e-3;

/// Effects with values, and the residuals.
#[derive(Clone, Debug)]
pub struct Refit {
    /// Everything with its value.
    pub estimate: Estimate,
    /// Where each effect found stands in the estimate.
    pub places: Vec<usize>,
    /// Standard deviation of each sought parameter of each effect, SI.
    pub sigmas: Vec<Vec<f64>>,
    /// What came out where nothing physical is.
    pub impossible: Vec<Beyond>,
    /// The residual's `rᵀ M r`, see [`Fit`].
    pub deviance: f64,
    /// Residuals are so many standard deviations of the rows.
    pub scale: f64,
    /// As of [`Fit::design`].
    pub design: f64,
    /// Measured numbers in use, by weight, minus free parameters.
    pub freedom: f64,
    /// Sum of squared parts along columns held by their calibration, and how many there are.
    pub strain: (f64, usize),
    /// Residuals at the estimate, in standard deviations of the rows.
    pub residual: Vec<f64>,
}

impl Refit {
    /// The standard deviation by which evidence counts.
    #[must_use]
    pub fn evidence(&self) -> f64 {
        self.scale * self.design.sqrt()
    }
}

/// A value that is smaller than any that is physical.
#[derive(Clone, Copy, Debug)]
pub struct Beyond {
    /// Which.
    pub slot: Slot,
    /// How far below, in its standard deviations.
    pub sigmas: f64,
}

/// Puts effects found into an estimate; returns where they stand.
pub fn put(estimate: &mut Estimate, chosen: &[Chosen]) -> Vec<usize> {
    let mut places = Vec::new();
    for found in chosen {
        let effect = &found.candidate.effect;
        let at = estimate
            .effects
            .iter()
            .position(|e| e.same_place(effect))
            .unwrap_or_else(|| {
                estimate.effects.push(effect.clone());
                estimate.effects.len() - 1
            });
        for (number, value) in found.candidate.sought.iter().zip(&found.values) {
            let definition = &effect.definition().parameters[*number];
            estimate.effects[at].parameters[*number] +=
                value * definition.prior_sigma * definition.unit.in_si();
        }
        places.push(at);
    }
    places
}

/// What a fit begins with.
#[derive(Clone, Copy)]
pub(crate) struct Start<'a> {
    /// The comparison.
    pub problem: &'a Problem,
    /// Numbers of its rows.
    pub layout: &'a Layout,
    /// Values without the effects that are found.
    pub estimate: &'a Estimate,
    /// How freely each of the problem's parameters is fitted: see [`Held`].
    pub shares: &'a [f64],
    /// The scale is at least this.
    pub floor: f64,
}

/// Fits everything together on the rows in use; the last fit is that of the residuals at the
/// estimate.
#[must_use]
pub(crate) fn refit(start: Start, chosen: &[Chosen], used: &[bool]) -> (Refit, Fit) {
    let Start {
        problem,
        layout,
        shares,
        floor,
        ..
    } = start;
    let mut estimate = start.estimate.clone();
    let places = put(&mut estimate, chosen);
    let mut parameters: Vec<Parameter> = problem.parameters.clone();
    let mut owners = Vec::new();
    for (found, at) in chosen.iter().zip(&places) {
        for number in &found.candidate.sought {
            let definition = &found.candidate.effect.definition().parameters[*number];
            owners.push(parameters.len());
            parameters.push(Parameter {
                key: String::new(),
                subject: Subject::Effect(Slot {
                    effect: *at,
                    parameter: *number,
                }),
                unit: definition.unit,
                scale: definition.prior_sigma * definition.unit.in_si(),
                rank: 0,
                prior: None,
                asked: false,
            });
        }
    }
    let shares: Vec<f64> = (shares.iter())
        .copied()
        .chain(owners.iter().map(|_| 1.0))
        .collect();
    let mut turn = 0;
    loop {
        let (residual, columns) = table(problem, &estimate, &parameters);
        let held: Vec<Held> = (columns.iter().zip(&shares).enumerate())
            .map(|(i, (column, share))| Held {
                column,
                share: *share,
                sought: i >= problem.parameters.len(),
            })
            .collect();
        let fit = Fit::of(layout, used, &residual, &held, floor);
        if turn == TURNS {
            let others: Vec<Held> = held[..problem.parameters.len()].to_vec();
            let without = fit.with_held(&residual, &others);
            let projections = without.projections(&columns[problem.parameters.len()..]);
            let own = without.deviations(&projections.iter().collect::<Vec<_>>());
            let mut own = own
                .into_iter()
                .zip(&owners)
                .map(|(s, i)| s * parameters[*i].scale);
            let sigmas = chosen
                .iter()
                .map(|c| own.by_ref().take(c.candidate.sought.len()).collect())
                .collect();
            let impossible = beyond(&estimate, (problem, &parameters), &fit, &residual, &held);
            let refit = Refit {
                estimate,
                places,
                sigmas,
                impossible,
                deviance: fit.deviance,
                scale: fit.scale,
                design: fit.design,
                freedom: fit.freedom,
                strain: fit.strain,
                residual,
            };
            return (refit, fit);
        }
        // what is held by its calibration stays: its prior stands at the profile's value. The
        // effects are estimated with it integrated out, what is free then fits the rest
        let values = fit.values(held.len());
        let (mut rest, mut free) = (residual.clone(), Vec::new());
        for (i, one) in held.iter().enumerate() {
            if one.sought {
                add_scaled(&mut rest, -values[i], one.column);
                *estimate.value_mut(parameters[i].subject) += values[i] * parameters[i].scale;
            } else if one.share == 1.0 {
                free.push(i);
            }
        }
        let own: Vec<Held> = free.iter().map(|i| held[*i]).collect();
        let values = fit.with_held(&rest, &own).values(own.len());
        for (i, value) in free.into_iter().zip(values) {
            *estimate.value_mut(parameters[i].subject) += value * parameters[i].scale;
        }
        turn += 1;
    }
}

/// Values of what was fitted, of these parameters, that lie below what is physical.
fn beyond(
    estimate: &Estimate,
    (problem, parameters): (&Problem, &[Parameter]),
    fit: &Fit,
    residual: &[f64],
    held: &[Held],
) -> Vec<Beyond> {
    let free = parameters.iter().zip(held).enumerate();
    let below = free.filter_map(|(i, (parameter, own))| {
        let Subject::Effect(slot) = parameter.subject else {
            return None;
        };
        let effect = &estimate.effects[slot.effect];
        let least = least(problem, effect, slot.parameter)?;
        let by = least - effect.parameters[slot.parameter];
        if by <= 0.0 || own.share < 1.0 {
            return None;
        }
        let mut others = held.to_vec();
        others.remove(i);
        let without = fit.with_held(residual, &others);
        let projections = without.projections(&[own.column.to_vec()]);
        let sigma = without.deviations(&[&projections[0]])[0] * parameter.scale;
        Some(Beyond {
            slot,
            sigmas: by / sigma,
        })
    });
    below.collect()
}

/// The estimate with the parameters that their calibration holds moved by what the residuals say
/// beyond chance, as far as the calibration is not sure of them: what these rows do not show stays
/// as it was calibrated. `None` where that is nothing, or does not lower the residuals themselves.
///
/// # Source
/// W. James, C. Stein, "Estimation with quadratic loss" (1961), for a calibration that does not say
/// how sure it is; else the posterior mean of a normal prior, whose size is that of the pull at it
/// (empirical Bayes: B. Efron, C. Morris (1973)).
pub(crate) fn moved(start: Start, profile: &Profile, refit: &Refit, fit: &Fit) -> Option<Estimate> {
    let Start {
        problem, shares, ..
    } = start;
    let (strain, count) = refit.strain;
    if count < 3 {
        return None;
    }
    let variance = refit.evidence().powi(2);
    let chance = variance * (count as f64 - 2.0);
    let factor = 1.0 - chance / strain.max(chance);
    if factor < 0.05 {
        return None;
    }
    let held: Vec<usize> = (0..shares.len()).filter(|i| shares[*i] < 1.0).collect();
    let known = known_of(profile, &refit.estimate);
    let part = if known.is_some() { 1.0 } else { factor };
    let mut prior = DMatrix::identity(held.len(), held.len()) * KNOWN.powi(2);
    if let Some((subjects, covariance)) = known {
        let times = (strain / (variance * count as f64)).max(1.0);
        let place = |i: usize| {
            let own = problem.parameters[held[i]].subject;
            subjects.iter().position(|subject| *subject == own)
        };
        let scale = |i: usize| problem.parameters[held[i]].scale;
        for i in 0..held.len() {
            for j in 0..held.len() {
                if let (Some(a), Some(b)) = (place(i), place(j)) {
                    prior[(i, j)] = times * covariance[(a, b)] / (scale(i) * scale(j));
                }
            }
            prior[(i, i)] += SURE.powi(2);
        }
    }
    let inverse = variance * prior.cholesky()?.inverse();
    let mut precision = DMatrix::zeros(shares.len(), shares.len());
    for (i, a) in held.iter().enumerate() {
        for (j, b) in held.iter().enumerate() {
            precision[(*a, *b)] = inverse[(i, j)];
        }
    }
    let mut estimate = refit.estimate.clone();
    let values = fit.followed(shares.len(), part, &precision);
    for (parameter, value) in problem.parameters.iter().zip(values) {
        *estimate.value_mut(parameter.subject) += value * parameter.scale;
    }
    let left = |estimate: &Estimate| -> f64 {
        let (residual, _) = table(problem, estimate, &[]);
        let weighted = residual.iter().zip(&fit.roots);
        weighted.map(|(r, root)| (r * root).powi(2)).sum()
    };
    (left(&estimate) < left(&refit.estimate)).then_some(estimate)
}
