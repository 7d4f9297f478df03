//! The effects' values with everything fitted together, without linearisation, and the improved
//! profile.

use super::fit::{Fit, Normal};
use super::table::{Column, Layout, table};
use crate::diagnose::as_calibrated::known_of;
use crate::diagnose::question::is_frame_or_geometry;
use crate::diagnose::search::Chosen;
use crate::diagnose::search::candidates::{least, parameter};
use crate::diagnose::search::tried::choice;
use crate::identify::parameters::{Parameter, Subject};
use crate::identify::problem::{Estimate, Problem};
use crate::model::Slot;
use crate::model::effects::Effect;
use crate::profile::Profile;
use nalgebra::DMatrix;

/// Rounds of Gauss–Newton.
const TURNS: usize = 4;
/// A calibration that does not say how sure it is knows its parameters to this part of their typical
/// sizes.
const KNOWN: f64 = 0.3;
/// An effect of the profile has changed where one of its parameters is farther from where it was, in
/// standard deviations: chance 6e-7 for each.
const CHANGED: f64 = 5.0;
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
    /// Standard deviation of what was chosen from a list for each effect (a torque, a time constant),
    /// SI; those of what was sought count it as fitted, too.
    pub chosen_sigmas: Vec<Option<f64>>,
    /// What came out where nothing physical is.
    pub impossible: Vec<Beyond>,
    /// The residual's `rᵀ M r`, see [`Fit`].
    pub deviance: f64,
    /// As of [`Fit::scale`].
    pub scale: f64,
    /// As of [`Fit::mean`].
    pub mean: f64,
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

/// An effect that was fitted again, and came out elsewhere than it was.
#[derive(Clone, Debug)]
pub struct Changed {
    /// As the profile has it.
    pub before: Effect,
    /// As these measurements say.
    pub after: Effect,
    /// Standard deviation of each parameter that was fitted, by its number, SI.
    pub sigmas: Vec<(usize, f64)>,
    /// How far the farthest of them is from where it was, in its standard deviations.
    pub times: f64,
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
    /// How freely each of the problem's parameters is fitted: see [`Normal`].
    pub shares: &'a [f64],
    /// The scale is at least this.
    pub floor: f64,
}

/// The fit of the residuals at the values found.
pub(crate) struct Last {
    /// The fit.
    pub fit: Fit,
    /// Columns of everything that was fitted.
    pub columns: Vec<Column>,
}

/// Fits everything together on the rows in use.
#[must_use]
pub(crate) fn refit(start: Start, chosen: &[Chosen], used: &[bool]) -> (Refit, Last) {
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
    for (found, at) in chosen.iter().zip(&places) {
        let effect = &found.candidate.effect;
        let own = found.candidate.sought.iter();
        parameters.extend(own.map(|number| parameter(*at, effect, *number)));
    }
    let first = problem.parameters.len();
    let mut turn = 0;
    let last = loop {
        let (residual, columns) = table(problem, &estimate, &parameters);
        let (held, sought) = columns.split_at(first);
        let sought: Vec<&[f64]> = sought.iter().map(Vec::as_slice).collect();
        let normal = Normal::of((layout, used), &residual, (held, shares), floor);
        let fit = normal.fit(&sought);
        if turn == TURNS {
            break (residual, Last { fit, columns });
        }
        // what is held by its calibration stays: its prior stands at the profile's value. The
        // effects are estimated with it integrated out, what is free then fits the rest
        let values = fit.values_as_calibrated(parameters.len());
        for (parameter, value) in parameters.iter().zip(values) {
            *estimate.value_mut(parameter.subject) += value * parameter.scale;
        }
        turn += 1;
    };
    let (residual, last) = last;
    let fit = &last.fit;
    // what was chosen from a list is uncertain, too
    let listed = |chosen: &Chosen| choice(problem, &chosen.candidate.effect);
    let mut with_chosen = parameters.clone();
    let mut chosen_at: Vec<Option<usize>> = Vec::new();
    for (found, at) in chosen.iter().zip(&places) {
        chosen_at.push(listed(found).map(|number| {
            with_chosen.push(parameter(*at, &found.candidate.effect, number));
            with_chosen.len() - 1
        }));
    }
    let uncertain = (with_chosen.len() > parameters.len()).then(|| {
        let (residual, columns) = table(problem, &estimate, &with_chosen);
        let (held, sought) = columns.split_at(first);
        let sought: Vec<&[f64]> = sought.iter().map(Vec::as_slice).collect();
        Normal::of((layout, used), &residual, (held, shares), floor).fit(&sought)
    });
    let uncertain = uncertain.as_ref().unwrap_or(fit);
    let sigma = |index: usize| uncertain.deviation(index) * with_chosen[index].scale;
    let chosen_sigmas = chosen_at.iter().map(|at| at.map(sigma)).collect();
    let mut own = (first..parameters.len()).map(sigma);
    let sigmas = chosen
        .iter()
        .map(|c| own.by_ref().take(c.candidate.sought.len()).collect())
        .collect();
    let refit = Refit {
        impossible: beyond(&estimate, (problem, &parameters), fit, shares),
        estimate,
        places,
        sigmas,
        chosen_sigmas,
        deviance: fit.deviance,
        scale: fit.scale,
        mean: fit.mean,
        design: fit.design,
        freedom: fit.freedom,
        strain: fit.strain,
        residual,
    };
    (refit, last)
}

/// Effects of the profile, frames and geometry left out, that were fitted freely and came out
/// elsewhere beyond chance: the farthest first.
pub(crate) fn changed(
    start: Start,
    profile: &Profile,
    (refit, fit): (&Refit, &Fit),
) -> Vec<Changed> {
    let Start {
        problem, shares, ..
    } = start;
    let mut all: Vec<Changed> = Vec::new();
    for (at, after) in refit.estimate.effects.iter().enumerate() {
        let before = profile.effects.iter().find(|e| e.same_place(after));
        let Some(before) = before.filter(|e| !is_frame_or_geometry(e.kind)) else {
            continue;
        };
        // what was found on top of it is named on its own
        if refit.places.contains(&at) {
            continue;
        }
        let own = problem.parameters.iter().zip(shares).enumerate();
        let fitted = own.filter_map(|(i, (parameter, share))| match parameter.subject {
            Subject::Effect(slot) if slot.effect == at && *share == 1.0 => {
                Some((slot.parameter, fit.deviation(i) * parameter.scale))
            }
            _ => None,
        });
        let sigmas: Vec<(usize, f64)> = fitted.collect();
        let times = sigmas.iter().map(|(number, sigma)| {
            (after.parameters[*number] - before.parameters[*number]).abs() / sigma
        });
        let times = times.fold(0.0, f64::max);
        if times > CHANGED {
            all.push(Changed {
                before: before.clone(),
                after: after.clone(),
                sigmas,
                times,
            });
        }
    }
    all.sort_by(|a, b| b.times.total_cmp(&a.times));
    all
}

/// Values of what was fitted freely, of these parameters, that lie below what is physical.
fn beyond(
    estimate: &Estimate,
    (problem, parameters): (&Problem, &[Parameter]),
    fit: &Fit,
    shares: &[f64],
) -> Vec<Beyond> {
    let free = parameters.iter().enumerate();
    let free = free.filter(|(i, _)| shares.get(*i).is_none_or(|share| *share == 1.0));
    let below = free.filter_map(|(i, parameter)| {
        let Subject::Effect(slot) = parameter.subject else {
            return None;
        };
        let effect = &estimate.effects[slot.effect];
        let least = least(problem, effect, slot.parameter)?;
        let by = least - effect.parameters[slot.parameter];
        (by > 0.0).then(|| Beyond {
            slot,
            sigmas: by / (fit.deviation(i) * parameter.scale),
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
