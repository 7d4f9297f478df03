//! From measurements to a verdict.

use super::candidates::{Candidate, CannotTest};
use super::poses::{Telling, telling};
use super::refit::{Refit, refit, shrink};
use super::search::{Chosen, Scored, World};
use super::session::{Session, Trust, for_choice, is_nominal, session};
use super::table::Layout;
use super::unknown::{Library, Likeness, Unknown, chance, likeness};
use super::whereabouts::{Spot, spots};
use crate::geometry::units::mm_from_m;
use crate::identify::IdentifyError;
use crate::identify::measurements::Measurements;
use crate::identify::parameters::Pick;
use crate::identify::problem::{Estimate, Problem};
use crate::identify::robust::limit;
use crate::identify::screening::Remark;
use crate::identify::statistics::Spread;
use crate::model::effects::{Effect, Kind};
use crate::model::profile::Profile;

/// A calibration of unknown worth is taken to be worth as much as these measurements.
const DEFAULT_G: f64 = 1.0;
/// Another effect explains the data nearly as well where it is worse by no more than this, twice a log likelihood.
pub const NEARLY: f64 = 6.0;
/// Two effects cannot be told apart where one is better by less than this.
const TIE: f64 = 1.0;
/// A function outside the registry is better than an effect where it gains this much more.
const UNKNOWN_BETTER: f64 = 14.0;
/// And this part: an effect's torque or time constant is known to a grid only.
const UNKNOWN_PART: f64 = 0.01;
/// Neighbours are alike where that is less likely by chance.
const ALIKE: f64 = 2e-4;
/// Noise is more than stated where that is less likely by chance, in standard deviations of its estimate.
const LOUDER: f64 = 4.0;
/// From so many rows on, one part of them is left out, once.
const MANY_ROWS: usize = 400;
/// Configurations that tell rivals apart.
const TELLING: usize = 12;
/// Parts of the measurements that are left out in turn.
const FOLDS: usize = 5;
/// A row is an outlier beyond this many times the length that 99.7 % of normal rows stay below.
const OUTLIER: f64 = 1.6;

/// What a person may ask for.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Effects that are in the model whatever the evidence.
    pub accept: Vec<Pick>,
    /// Effects that are not considered.
    pub reject: Vec<Pick>,
    /// Leave out cross-validation.
    pub quick: bool,
}

/// The answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The effects found explain the disagreement down to the noise.
    Explained,
    /// The model agrees with the measurements within the noise.
    NothingMissing,
    /// Something is missing and it cannot be told what.
    Undetermined,
}

impl Verdict {
    /// Its name in reports.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::NothingMissing => "nothing_missing",
            Self::Undetermined => "undetermined",
        }
    }
}

/// An effect that explains the data nearly as well as one that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Rival {
    /// The effect, with its values.
    pub effect: Effect,
    /// Index of the effect found that it would stand for.
    pub instead_of: usize,
    /// Fall of chi-squared.
    pub gain: f64,
    /// By how much the effect found is better, in twice a log likelihood, its choice counted.
    pub behind: f64,
}

/// An effect that was found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The effect with its values.
    pub effect: Effect,
    /// Indices of the parameters that were sought.
    pub sought: Vec<usize>,
    /// Standard deviations of those, SI.
    pub sigmas: Vec<f64>,
    /// Fall of chi-squared when it is added to the others.
    pub gain: f64,
    /// Probability of that by chance, times the number of tests made.
    pub p_value: f64,
    /// Fall of the information criterion.
    pub bic: f64,
    /// A person asked for it.
    pub accepted: bool,
    /// Errors on rows not used for its choice, with the effects before it and with it too, mm.
    pub before: Option<Spread>,
    /// With it.
    pub after: Option<Spread>,
    /// In how many of the parts of the measurements it was found again without them.
    pub found_again: (usize, usize),
}

/// Where the noise's size comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseSource {
    /// The column `sigma_mm`.
    Given,
    /// Poses measured more than once.
    Repeats,
    /// What every model leaves.
    Left,
}

/// A row that no model explains.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlierRow {
    /// Line in the file.
    pub line: usize,
    /// Its id.
    pub id: String,
    /// Length of its residual, metres.
    pub length_m: f64,
    /// In standard deviations of the noise.
    pub times: f64,
}

/// Everything found.
pub struct Diagnosis {
    /// The answer.
    pub verdict: Verdict,
    /// Why, one sentence each.
    pub reasons: Vec<String>,
    /// Effects in the order found; the first ones explain most.
    pub found: Vec<Found>,
    /// Configurations that would tell the strongest rival from the effect found.
    pub telling: Vec<Telling>,
    /// Effects that explain the data nearly as well.
    pub rivals: Vec<Rival>,
    /// Functions outside the registry that explain more.
    pub unknown: Vec<Unknown>,
    /// Where the disagreement lies.
    pub spots: Vec<Spot>,
    /// Effects that cannot be tested.
    pub cannot_test: Vec<CannotTest>,
    /// Whether frames, geometry (and compliance) were fitted anew.
    pub absorbed: bool,
    /// Whether the base was fitted: the device is elsewhere than the profile says.
    pub elsewhere: bool,
    /// Errors on rows not used: the present model, then with everything.
    pub held_out: Option<(Spread, Spread)>,
    /// With frames, geometry and what the profile has fitted anew, without effects found.
    pub absorbed_only: Option<Spread>,
    /// Noise of a coordinate, metres, and where it comes from.
    pub noise_m: f64,
    /// Where from.
    pub noise_source: NoiseSource,
    /// What is left of a coordinate, metres.
    pub left_m: f64,
    /// Rows that do not fit.
    pub outliers: Vec<OutlierRow>,
    /// What a person should look at.
    pub remarks: Vec<Remark>,
    /// Present residuals and those left, metres, a length for each row.
    pub lengths: (Vec<f64>, Vec<f64>),
    /// The improved robot: effects of the data left out.
    pub profile: Profile,
    /// The comparison and the values, to go on from.
    pub problem: Problem,
    /// The values.
    pub estimate: Estimate,
}

/// What a search on one set of assumptions found.
struct Attempt {
    session: Session,
    chosen: Vec<Chosen>,
    refit: Refit,
    unknown: Vec<Unknown>,
    rivalled: Vec<(usize, Unknown)>,
    likeness: Likeness,
    strained: Option<f64>,
    louder: Option<f64>,
    /// Deviance and costs in common units: less is better.
    merit: f64,
    trust: Trust,
}

impl Attempt {
    fn clean(&self) -> bool {
        self.unknown.is_empty()
            && self.rivalled.is_empty()
            && self.likeness.in_order > ALIKE
            && self.likeness.in_posture > ALIKE
            && self.strained.is_none()
            && self.louder.is_none()
    }
}

/// Noise of repeated poses in standard deviations of the rows, with its degrees of freedom.
fn repeats(problem: &Problem, layout: &Layout, residual: &[f64]) -> Option<(f64, usize)> {
    let mut groups: std::collections::BTreeMap<String, Vec<usize>> =
        std::collections::BTreeMap::new();
    for (i, row) in problem.rows.iter().enumerate() {
        let key = format!(
            "{:?} {:?} {} {:?}",
            row.q, row.conditions.direction, row.tool, row.point
        );
        groups.entry(key).or_default().push(i);
    }
    let (mut sum, mut freedom) = (0.0, 0);
    for rows in groups.values().filter(|rows| rows.len() > 1) {
        let count = layout.row(rows[0]).len();
        for k in 0..count {
            let values: Vec<f64> = rows
                .iter()
                .map(|r| residual[layout.row(*r).start + k])
                .collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            sum += values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
            freedom += values.len() - 1;
        }
    }
    (freedom >= 10).then(|| ((sum / freedom as f64).sqrt(), freedom))
}

fn lengths_m(problem: &Problem, layout: &Layout, residual: &[f64]) -> Vec<f64> {
    (0..layout.rows())
        .map(|row| {
            let range = layout.row(row);
            let part = &residual[range.start..range.start + range.len().min(3)];
            part.iter().map(|r| r * r).sum::<f64>().sqrt() * problem.rows[row].sigma_m
        })
        .collect()
}

/// A p-value with the number of tests made.
fn corrected(gain: f64, count: usize, peers: usize) -> f64 {
    (chance(gain, count.max(1)) * (peers * crate::model::effects::REGISTRY.len()) as f64).min(1.0)
}

fn attempt(
    profile: &Profile,
    measurements: &Measurements,
    trust: Trust,
    options: &Options,
    progress: &mut dyn FnMut(&str),
) -> Result<(Attempt, Vec<Remark>), IdentifyError> {
    let leave = |effect: &Effect| options.reject.iter().any(|pick| pick.means(effect));
    progress("fitting frames and geometry");
    let (mut session, remarks) = session(profile, measurements, trust, &leave)?;
    let used = for_choice(measurements);
    let given = !session.problem.sigma_assumed;
    let floor = if given { 1.0 } else { 1e-6 };
    progress("trying every effect");
    let mut chosen = Vec::new();
    for round in 0..3 {
        let world = World {
            layout: &session.layout,
            residual: &session.residual,
            held: &session.columns,
            shares: &session.shares,
            candidates: &session.candidates,
            used: &used,
            floor,
            accepted: &options.accept,
        };
        chosen = world.search(chosen);
        if round == 2 || !session.refine(&chosen) {
            break;
        }
    }
    progress("fitting what was found");
    let mut refit = refit(
        &session.problem,
        &session.layout,
        &session.estimate,
        &session.shares,
        &chosen,
        &used,
        floor,
    );
    let world = World {
        layout: &session.layout,
        residual: &session.residual,
        held: &session.columns,
        shares: &session.shares,
        candidates: &session.candidates,
        used: &used,
        floor,
        accepted: &options.accept,
    };
    progress("looking for what no effect explains");
    let library = Library::of(&session.problem, &session.estimate);
    let fit = world.fit(&chosen);
    let mut unknown = library.scan(&session.layout, &refit.fit);
    unknown.retain(|u| u.gain > library.cost(u.count));
    let mut rivalled = Vec::new();
    for i in 0..chosen.len() {
        let others: Vec<Chosen> = chosen
            .iter()
            .enumerate()
            .filter(|(k, _)| *k != i)
            .map(|(_, c)| c.clone())
            .collect();
        let without = fit.with_held(&session.layout, &session.residual, &world.held(&others));
        let own = &chosen[i];
        let own_gain =
            (without.deviance - refit.fit.deviance.min(fit.deviance)) / fit.scale.powi(2);
        let parameters = own.values.len() + own.candidate.chosen;
        if let Some(best) = library.scan(&session.layout, &without).into_iter().next() {
            let fair = 3.0 * (best.count as f64 - parameters as f64).max(0.0);
            if best.gain - fair > own_gain * (1.0 + UNKNOWN_PART) + UNKNOWN_BETTER {
                rivalled.push((i, best));
            }
        }
    }
    let likeness = likeness(&session.problem, &session.layout, &used, &refit.fit);
    let strained = match trust {
        Trust::Calibrated { g } if refit.fit.strain.1 > 0 => {
            let (strain, count) = refit.fit.strain;
            let p = chance(strain / (refit.fit.scale.powi(2) * (1.0 + g)), count);
            (p < 1e-4).then_some(p)
        }
        _ => None,
    };
    let spread = (2.0 / refit.fit.freedom).sqrt();
    let excess = (refit.fit.scale * refit.fit.scale - 1.0) / spread;
    let louder = (given && excess > LOUDER).then_some(refit.fit.scale);
    let columns = match trust {
        Trust::Nothing => session.shares.len() as f64,
        Trust::Calibrated { .. } => session.shares.iter().filter(|s| **s == 1.0).count() as f64,
    };
    let numbers = (0..session.layout.rows())
        .filter(|r| used[*r])
        .map(|r| session.layout.row(r).len())
        .sum::<usize>() as f64;
    let merit =
        refit.fit.deviance + columns * numbers.ln() + chosen.iter().map(|c| c.cost).sum::<f64>();
    if matches!(trust, Trust::Calibrated { .. }) {
        shrink(&session.problem, &session.shares, &mut refit);
    }
    Ok((
        Attempt {
            session,
            chosen,
            refit,
            unknown,
            rivalled,
            likeness,
            strained,
            louder,
            merit,
            trust,
        },
        remarks,
    ))
}

/// How many rows a profile's calibration was made with, from its provenance.
fn calibrated_rows(profile: &Profile) -> Option<f64> {
    profile
        .provenance
        .as_ref()?
        .get("rows")?
        .as_f64()
        .filter(|n| *n > 0.0)
}

/// Diagnoses measurements against a profile. `progress` is told what is being done.
///
/// # Errors
/// Measurements that contradict the robot or themselves, or are too few for the parameters that have to be fitted.
pub fn diagnose(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
    progress: &mut dyn FnMut(&str),
) -> Result<Diagnosis, IdentifyError> {
    let used = for_choice(measurements);
    let (best, remarks) = if is_nominal(profile) {
        attempt(profile, measurements, Trust::Nothing, options, progress)?
    } else {
        let rows = used.iter().filter(|u| **u).count() as f64;
        let g = calibrated_rows(profile).map_or(DEFAULT_G, |n| (rows / n).clamp(0.1, 10.0));
        let trusted = attempt(
            profile,
            measurements,
            Trust::Calibrated { g },
            options,
            progress,
        )?;
        if trusted.0.clean() {
            trusted
        } else {
            // the calibration itself may be out of date
            match attempt(profile, measurements, Trust::Nothing, options, progress) {
                Ok(anew) => {
                    let scale = anew
                        .0
                        .refit
                        .fit
                        .scale
                        .min(trusted.0.refit.fit.scale)
                        .powi(2);
                    let better = |a: &Attempt| a.merit_at(scale);
                    if better(&anew.0) + 10.0 < better(&trusted.0) {
                        anew
                    } else {
                        trusted
                    }
                }
                Err(IdentifyError::TooFew { .. } | IdentifyError::NotConverged { .. }) => trusted,
                Err(other) => return Err(other),
            }
        }
    };
    conclude(profile, measurements, options, &best, remarks, progress)
}

impl Attempt {
    fn merit_at(&self, variance: f64) -> f64 {
        let fit = &self.refit.fit;
        self.merit - fit.deviance + fit.deviance / variance
    }
}

impl Session {
    /// Adds candidates with list values nearer to those found: a knee's torque, a time constant. Whether there were any.
    fn refine(&mut self, chosen: &[Chosen]) -> bool {
        let mut any = false;
        for found in chosen {
            let effect = &found.candidate.effect;
            let number = match effect.kind {
                Kind::ComplianceKnee => 0,
                Kind::WarmUpDrift => 4,
                _ => continue,
            };
            let at = effect.parameters[number];
            let near: Vec<f64> = self
                .candidates
                .list
                .iter()
                .filter(|c| c.effect.kind == effect.kind && c.effect.site == effect.site)
                .map(|c| c.effect.parameters[number])
                .collect();
            let below = near
                .iter()
                .copied()
                .filter(|v| *v < at)
                .fold(0.5 * at, f64::max);
            let above = near
                .iter()
                .copied()
                .filter(|v| *v > at)
                .fold(f64::INFINITY, f64::min)
                .min(2.0 * at);
            let mut wanted = Vec::new();
            for value in [
                0.6 * at + 0.4 * below,
                0.8 * at + 0.2 * below,
                0.8 * at + 0.2 * above,
                0.6 * at + 0.4 * above,
            ] {
                let mut effect = effect.clone();
                effect.parameters[number] = value;
                wanted.push((effect, found.candidate.sought.clone()));
            }
            let columns = super::candidates::columns_of(&self.problem, &self.estimate, &wanted);
            for ((effect, _), own) in wanted.into_iter().zip(columns) {
                let first = self.candidates.columns.len();
                let count = own.len();
                self.candidates.columns.extend(own);
                self.candidates.list.push(Candidate {
                    effect,
                    columns: (first..first + count).collect(),
                    ..found.candidate.clone()
                });
            }
            any = true;
        }
        any
    }
}

/// Lengths of residuals of rows not used for the choice, after each step: present model, absorbed, then each effect.
fn held_out(
    attempt: &Attempt,
    measurements: &Measurements,
    options: &Options,
    floor: f64,
) -> (Vec<Vec<f64>>, Vec<(usize, usize)>) {
    let session = &attempt.session;
    let rows = session.layout.rows();
    let choice = for_choice(measurements);
    let validate: Vec<usize> = (0..rows).filter(|r| !choice[*r]).collect();
    let tests: Vec<Vec<usize>> = if validate.is_empty() {
        // contiguous blocks, four for each part, whole configurations
        let configurations = measurements.configurations();
        let last = configurations.last().copied().unwrap_or(0) + 1;
        let blocks = FOLDS * if last >= 80 { 4 } else { 1 };
        let fold = |row: usize| (configurations[row] * blocks / last) % FOLDS;
        // many rows: one part is enough to judge by
        let parts = if rows > MANY_ROWS { 1 } else { FOLDS };
        (0..parts)
            .map(|f| (0..rows).filter(|r| fold(*r) == f).collect())
            .collect()
    } else {
        vec![validate]
    };
    let steps = 2 + attempt.chosen.len();
    let mut lengths = vec![Vec::new(); steps];
    let mut again = vec![(0, 0); attempt.chosen.len()];
    let present = lengths_m(&session.problem, &session.layout, &session.present);
    for test in tests.into_iter().filter(|t| !t.is_empty()) {
        let mut used = choice.clone();
        for row in &test {
            used[*row] = false;
        }
        let world = World {
            layout: &session.layout,
            residual: &session.residual,
            held: &session.columns,
            shares: &session.shares,
            candidates: &session.candidates,
            used: &used,
            floor,
            accepted: &options.accept,
        };
        let mut own = world.search(Vec::new());
        // where a step lies is a fact of the data: rows left out beside it cannot say
        for found in own.iter_mut().filter(|c| c.candidate.row.is_some()) {
            let near = |w: &&Chosen| {
                let apart = w
                    .candidate
                    .row
                    .zip(found.candidate.row)
                    .map_or(u32::MAX, |(x, y)| x.abs_diff(y));
                w.candidate.effect.kind == found.candidate.effect.kind && apart <= 20
            };
            if let Some(known) = attempt.chosen.iter().find(near) {
                found.candidate.row = known.candidate.row;
                found.candidate.effect.site.order = known.candidate.effect.site.order;
                found.columns = world.columns(&found.candidate);
            }
        }
        let like = |a: &Candidate, b: &Candidate| {
            let rows = a.row.zip(b.row).is_none_or(|(x, y)| x.abs_diff(y) <= 5);
            a.effect.kind == b.effect.kind
                && rows
                && (a.row.is_some() || a.effect.site == b.effect.site)
        };
        lengths[0].extend(test.iter().map(|r| present[*r]));
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
            lengths[1 + step].extend(test.iter().map(|r| all[*r]));
        }
        for (found, (times, of)) in attempt.chosen.iter().zip(&mut again) {
            *of += 1;
            *times += usize::from(own.iter().any(|c| like(&found.candidate, &c.candidate)));
        }
    }
    (lengths, again)
}

fn spread_mm(lengths: &[f64]) -> Option<Spread> {
    Spread::of(&lengths.iter().map(|l| mm_from_m(*l)).collect::<Vec<_>>())
}

fn conclude(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
    attempt: &Attempt,
    remarks: Vec<Remark>,
    progress: &mut dyn FnMut(&str),
) -> Result<Diagnosis, IdentifyError> {
    let session = &attempt.session;
    let used = for_choice(measurements);
    let given = !session.problem.sigma_assumed;
    let floor = if given { 1.0 } else { 1e-6 };
    let sigma_m = {
        let mut all: Vec<f64> = session.problem.rows.iter().map(|r| r.sigma_m).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    };
    let left_m = attempt.refit.fit.scale * sigma_m;
    let repeated = repeats(&session.problem, &session.layout, &attempt.refit.residual);
    let (noise_m, noise_source) = match repeated {
        _ if given => (sigma_m, NoiseSource::Given),
        Some((noise, _)) => (noise * sigma_m, NoiseSource::Repeats),
        None => (left_m, NoiseSource::Left),
    };
    progress("checking on rows that were not used");
    let (lengths, again) = if options.quick {
        (
            vec![Vec::new(); 2 + attempt.chosen.len()],
            vec![(0, 0); attempt.chosen.len()],
        )
    } else {
        held_out(attempt, measurements, options, floor)
    };
    let spreads: Vec<Option<Spread>> = lengths.iter().map(|l| spread_mm(l)).collect();
    let mut found = Vec::new();
    for (i, chosen) in attempt.chosen.iter().enumerate() {
        let mut effect = attempt.refit.estimate.effects[attempt.refit.places[i]].clone();
        effect.site = chosen.candidate.effect.site.clone();
        let parameters = chosen.values.len() + chosen.candidate.chosen;
        let numbers = attempt.refit.fit.freedom;
        found.push(Found {
            effect,
            sought: chosen.candidate.sought.clone(),
            sigmas: attempt.refit.sigmas[i].clone(),
            gain: chosen.gain,
            p_value: corrected(chosen.gain, parameters, chosen.candidate.peers),
            bic: chosen.gain - parameters as f64 * numbers.ln(),
            accepted: options
                .accept
                .iter()
                .any(|p| p.means(&chosen.candidate.effect)),
            before: spreads[1 + i],
            after: spreads[2 + i],
            found_again: again[i],
        });
    }
    let mut rivals = Vec::new();
    for (i, chosen) in attempt.chosen.iter().enumerate() {
        for rival in &chosen.rivals {
            let behind = chosen.merit() - rival.merit();
            if behind < NEARLY || rival.gain.gain > 0.95 * chosen.gain {
                rivals.push(rival_of(
                    &session.candidates.list[rival.index],
                    rival,
                    i,
                    behind,
                ));
            }
        }
    }
    rivals.sort_by(|a, b| a.behind.total_cmp(&b.behind));
    let mut reasons = Vec::new();
    let tied: Vec<&Rival> = rivals
        .iter()
        .filter(|r| r.behind < TIE && !found[r.instead_of].accepted)
        .collect();
    let plain = |r: &Rival| {
        r.effect.kind == found[r.instead_of].effect.kind && r.effect.definition().of_data()
    };
    for rival in tied.iter().filter(|r| !plain(r)) {
        reasons.push(format!(
            "{} and {} explain the measurements equally well",
            found[rival.instead_of].effect.label(),
            rival.effect.label()
        ));
    }
    for (i, unknown) in attempt.rivalled.iter().filter(|(i, _)| !found[*i].accepted) {
        reasons.push(format!(
            "{} looks like the answer among the effects known, but {} explains more (chi-squared {:.0} against {:.0})",
            found[*i].effect.label(),
            unknown.name,
            unknown.gain,
            found[*i].gain
        ));
    }
    if let Some(unknown) = attempt.unknown.first() {
        reasons.push(format!(
            "what is left depends on {} (chi-squared falls by {:.0}): no effect known does that",
            unknown.name, unknown.gain
        ));
    }
    if attempt.likeness.in_order < ALIKE {
        reasons.push(format!(
            "rows one after another miss alike (p = {:.1e}): something changes with time",
            attempt.likeness.in_order
        ));
    }
    if attempt.likeness.in_posture < ALIKE {
        reasons.push(format!(
            "like postures miss alike (p = {:.1e}): the model lacks something",
            attempt.likeness.in_posture
        ));
    }
    if let Some(p) = attempt.strained {
        reasons.push(format!(
            "geometry or compliance in the profile are off as a whole (p = {p:.1e}): calibrate anew"
        ));
    }
    if let Some(scale) = attempt.louder {
        reasons.push(format!(
            "what is left is {scale:.2} times the noise that sigma_mm states"
        ));
    }
    let verdict = if !reasons.is_empty() {
        Verdict::Undetermined
    } else if found.is_empty() {
        Verdict::NothingMissing
    } else {
        Verdict::Explained
    };
    let present_scale = attempt.refit.fit.scale;
    let spots = spots(
        &session.problem,
        &session.layout,
        &session.present_estimate,
        &used,
        &session.present,
        present_scale,
    );
    let left_lengths = lengths_m(&session.problem, &session.layout, &attempt.refit.residual);
    let mut outliers = Vec::new();
    for row in 0..session.layout.rows() {
        let range = session.layout.row(row);
        let length = attempt.refit.residual[range.clone()]
            .iter()
            .map(|r| r * r)
            .sum::<f64>()
            .sqrt();
        let most = OUTLIER * limit(range.len()) * attempt.refit.fit.scale;
        if length > most {
            let m = &measurements.rows[row];
            outliers.push(OutlierRow {
                line: m.line,
                id: m.id.clone(),
                length_m: left_lengths[row],
                times: length / attempt.refit.fit.scale,
            });
        }
    }
    outliers.sort_by(|a, b| b.times.total_cmp(&a.times));
    // the rival takes the place of the effect found, everything is fitted again, and where the two models differ tells
    let mut telling_poses = Vec::new();
    let of_robot = rivals.iter().find(|r| {
        !r.effect.definition().of_data() && !found[r.instead_of].effect.definition().of_data()
    });
    if let Some(rival) = of_robot {
        let scored = attempt.chosen[rival.instead_of].rivals.iter().find(|s| {
            let other = &session.candidates.list[s.index].effect;
            other.kind == rival.effect.kind && other.site == rival.effect.site
        });
        if let Some(scored) = scored {
            let world = World {
                layout: &session.layout,
                residual: &session.residual,
                held: &session.columns,
                shares: &session.shares,
                candidates: &session.candidates,
                used: &used,
                floor,
                accepted: &options.accept,
            };
            let mut other = attempt.chosen.clone();
            other[rival.instead_of] = world.chosen(scored);
            let refitted = refit(
                &session.problem,
                &session.layout,
                &session.estimate,
                &session.shares,
                &other,
                &used,
                floor,
            );
            telling_poses = telling(
                profile,
                &session.problem,
                &attempt.refit.estimate,
                &refitted.estimate,
                TELLING,
            )?;
        }
    }
    let telling = telling_poses;
    let last = spreads.len() - 1;
    let profile = improved(profile, session, &attempt.refit.estimate, attempt.trust);
    let present_lengths = lengths_m(&session.problem, &session.layout, &session.present);
    Ok(Diagnosis {
        verdict,
        reasons,
        found,
        telling,
        rivals,
        unknown: attempt.unknown.clone(),
        spots,
        cannot_test: session.candidates.cannot_test.clone(),
        absorbed: attempt.trust == Trust::Nothing,
        elsewhere: session.elsewhere,
        held_out: spreads[0].zip(spreads[last]),
        absorbed_only: spreads[1],
        noise_m,
        noise_source,
        left_m,
        outliers,
        remarks,
        lengths: (present_lengths, left_lengths),
        profile,
        problem: session.problem.clone(),
        estimate: attempt.refit.estimate.clone(),
    })
}

fn rival_of(candidate: &Candidate, scored: &Scored, instead_of: usize, behind: f64) -> Rival {
    let mut effect = candidate.effect.clone();
    for (number, value) in candidate.sought.iter().zip(&scored.gain.values) {
        let definition = &effect.definition().parameters[*number];
        effect.parameters[*number] += value * definition.prior_sigma * definition.unit.in_si();
    }
    if let Some(row) = scored.row {
        effect.site.order = row;
    }
    Rival {
        effect,
        instead_of,
        gain: scored.gain.gain,
        behind,
    }
}

/// The profile with what was found, effects of the data left out.
fn improved(profile: &Profile, session: &Session, estimate: &Estimate, trust: Trust) -> Profile {
    let mut improved = profile.clone();
    let keep_base = matches!(trust, Trust::Calibrated { .. }) && session.elsewhere;
    improved.effects = estimate
        .effects
        .iter()
        .filter(|e| {
            let kept_out = keep_base && e.kind == Kind::BaseFrame;
            !(e.is_zero() || e.definition().of_data() || kept_out)
        })
        .cloned()
        .collect();
    if keep_base {
        // the device stands elsewhere: that says nothing of the robot
        improved.effects.extend(
            profile
                .effects
                .iter()
                .filter(|e| e.kind == Kind::BaseFrame)
                .cloned(),
        );
    } else {
        improved.world_from_base = estimate.world_from_base;
    }
    for (point, value) in session.problem.points.iter().zip(&estimate.points_m) {
        improved.points.insert(point.name.clone(), *value);
    }
    improved
}
