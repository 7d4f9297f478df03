//! One search on one set of assumptions about the profile, and what of its outcome must be
//! questioned.

use super::in_a_row::{InARow, beyond, in_a_row};
use super::instead::{Instead, instead};
use super::reference::{Open, open};
use crate::diagnose::as_calibrated::left_by_calibration;
use crate::diagnose::diagnosis::Options;
use crate::diagnose::estimator::chances::{chi_squared_tail, f_tail, normal_tail};
use crate::diagnose::estimator::fit::Fit;
use crate::diagnose::estimator::gain::{Given, Kept};
use crate::diagnose::estimator::refit::{Changed, Last, Refit, changed, moved, refit};
use crate::diagnose::estimator::table::{Column, dot, lengths_m};
use crate::diagnose::outside::{Library, Likeness, Unknown, chance, likeness};
use crate::diagnose::question::noise::{Repeats, of_repeats};
use crate::diagnose::question::shifts::Shifts;
use crate::diagnose::question::{Session, Trust, for_choice, session};
use crate::diagnose::search::{Chosen, by_gain};
use crate::identify::IdentifyError;
use crate::identify::input_checks::plausibility::HOPELESS_M;
use crate::identify::input_checks::{Remark, sigma};
use crate::identify::measurements::Measurements;
use crate::identify::pick::Pick;
use crate::identify::problem::Estimate;
use crate::model::effects::{Effect, Kind, SiteKey};
use crate::profile::Profile;

/// A function outside the registry is better than an effect where it gains this much more.
const UNKNOWN_BETTER: f64 = 14.0;
/// And this part: an effect's torque or time constant is known to a grid only.
const UNKNOWN_PART: f64 = 0.01;
/// A value within this many of its standard deviations is none.
const NONE: f64 = 3.0;
/// An effect that gains less than this part of what it gains in the linear model, and less than it
/// costs, is not there: half, so that what is near its cost is judged as the search does.
const NEEDED: f64 = 0.5;
/// Searches, with values of lists nearer to those found and waves of the residual in between.
const ROUNDS: usize = 4;
/// Turns in which a large step of the device settles, and the weight of orientations.
const SETTLING: usize = 4;
/// Neighbours are alike where that is less likely by chance.
pub(crate) const ALIKE: f64 = 2e-4;
/// A calibration is off as a whole where the pull at it is less likely by chance.
const STRAINED: f64 = 1e-4;
/// More rows that fit no model than this leave a mark on what is fitted to the others.
const MOST_APART: f64 = 0.02;
/// Noise is more than stated where that is less likely by chance, in standard deviations of its
/// estimate.
pub(crate) const LOUDER: f64 = 4.0;
/// A row is an outlier beyond this many times the length that 99.7 % of normal rows stay below.
pub(crate) const OUTLIER: f64 = 1.6;
/// More outliers than this part of the rows are no exceptions.
const MOST_OUTLIERS: f64 = 0.1;

/// A residual beyond the noise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Louder {
    /// So many times.
    pub times: f64,
    /// What says how loud the noise is, in words.
    pub than: &'static str,
}

/// What a search on one set of assumptions found.
pub(crate) struct Attempt {
    pub session: Session,
    /// Rows that are used.
    pub used: Vec<bool>,
    pub chosen: Vec<Chosen>,
    pub refit: Refit,
    /// Its estimate with what the calibration holds moved, where that is.
    pub moved: Option<Estimate>,
    /// How much of each row's own numbers its expectation follows.
    pub leverage: Vec<f64>,
    /// Functions outside the registry that explain the residual.
    pub unknown: Vec<Unknown>,
    /// Functions outside the registry that explain more than the effect with this index.
    pub outdone: Vec<(usize, Unknown)>,
    /// What is no effect and may be in the place of one found.
    pub instead: Vec<Instead>,
    /// The temperature of lengths, where the rows leave it open.
    pub open: Option<Open>,
    /// Rows one after another that fit no model.
    pub in_a_row: Vec<InARow>,
    pub likeness: Likeness,
    pub strained: Option<f64>,
    /// Effects of the profile that were fitted again and are not what they were.
    pub changed: Vec<Changed>,
    /// How much louder the residual is than what is known of the noise, where that is beyond
    /// chance.
    pub louder: Option<Louder>,
    /// Noise by repeated poses given what was found, where `sigma_mm` does not state it.
    pub repeats: Option<Repeats>,
    /// Deviance and costs in common units: less is better.
    merit: f64,
    pub trust: Trust,
}

impl Attempt {
    /// Nothing speaks against it.
    pub(crate) fn clean(&self) -> bool {
        self.unknown.is_empty()
            && self.outdone.is_empty()
            && self.likeness.in_order > ALIKE
            && self.likeness.opposite > ALIKE
            && self.likeness.in_posture > ALIKE
            && self.strained.is_none()
            && self.louder.is_none()
    }

    /// Values with some of the effects found, and the same with what the calibration holds moved.
    pub(crate) fn refitted(
        &self,
        profile: &Profile,
        chosen: &[Chosen],
    ) -> (Refit, Option<Estimate>) {
        let (own, last) = refit(self.session.start(), chosen, &self.used);
        let moved = by_trust(self.trust, &self.session, profile, (&own, &last.fit));
        (own, moved)
    }

    /// How many of the rows in use fit no model, and of how many, where these are too many to be
    /// exceptions.
    pub(crate) fn strangers(&self) -> Option<(usize, usize)> {
        let (layout, refit) = (&self.session.layout, &self.refit);
        let in_use = (0..layout.rows()).filter(|row| self.used[*row]);
        let (mut strangers, mut count) = (0, 0);
        for row in in_use {
            count += 1;
            strangers += usize::from(beyond(layout, refit, row).is_some());
        }
        (strangers as f64 > MOST_OUTLIERS * count as f64).then_some((strangers, count))
    }

    /// What rows are still off by, root mean square, metres, where no arm is that far from its
    /// drawing. Single rows that fit no model do not count: they are reported as such.
    pub(crate) fn hopeless_m(&self) -> Option<f64> {
        let (layout, refit) = (&self.session.layout, &self.refit);
        let lengths = lengths_m(&self.session.problem, layout, &refit.residual);
        let (apart, others): (Vec<usize>, Vec<usize>) =
            (0..layout.rows()).partition(|row| beyond(layout, refit, *row).is_some());
        let are_many = apart.len() as f64 > MOST_APART * layout.rows() as f64;
        let counted = if are_many {
            (0..layout.rows()).collect()
        } else {
            others
        };
        let squares = counted.iter().map(|row| lengths[*row] * lengths[*row]);
        let rms = (squares.sum::<f64>() / counted.len().max(1) as f64).sqrt();
        (rms > HOPELESS_M).then_some(rms)
    }

    /// That the residual is far below the noise that is stated.
    pub(crate) fn sigma_large(&self) -> Option<Remark> {
        if self.session.problem.sigma_assumed {
            return None;
        }
        let said = sigma(self.refit.mean, self.refit.freedom);
        said.filter(|remark| remark.id == "sigma-large")
    }

    /// The median of the rows' standard deviations, metres.
    pub(crate) fn sigma_m(&self) -> f64 {
        sigma_m(&self.session)
    }

    /// Its merit with residuals of this variance: less is better.
    pub(crate) fn merit_at(&self, variance: f64) -> f64 {
        let deviance = self.refit.deviance;
        self.merit - deviance + deviance / variance
    }
}

/// Effects found that a function outside the registry would explain better, by their index.
fn outdone(
    (session, used): (&Session, &[bool]),
    library: &Library,
    chosen: &[Chosen],
    refit: &Refit,
) -> Vec<(usize, Unknown)> {
    let (base, fit) = session.world(used, &[]).fits(chosen);
    let effects: Vec<&[Column]> = chosen.iter().map(|c| c.columns.as_slice()).collect();
    let given = Given::of((&base, &session.columns), &fit, &effects);
    let without = |i: usize| -> Vec<bool> { (0..chosen.len()).map(|k| k != i).collect() };
    let kept: Vec<Kept> = (0..chosen.len()).map(|i| given.kept(&without(i))).collect();
    let best = library.scan(&session.layout, (&base, &session.columns), &given, &kept);
    let mut outdone = Vec::new();
    for ((i, own), best) in chosen.iter().enumerate().zip(best) {
        let left = refit.deviance.min(fit.deviance);
        let own_gain = (given.deviance(&kept[i]) - left) / fit.evidence().powi(2);
        let parameters = own.values.len() + own.candidate.chosen;
        let more = own_gain * (1.0 + UNKNOWN_PART) + UNKNOWN_BETTER;
        let best = best.into_iter().next();
        outdone.extend(
            best.filter(|b| b.fair_gain(parameters) > more)
                .map(|b| (i, b)),
        );
    }
    outdone
}

/// Probability that what a calibration holds is pulled this hard by chance, where that is small.
fn strain(trust: Trust, refit: &Refit) -> Option<f64> {
    let Trust::Calibrated { g } = trust else {
        return None;
    };
    let (strain, count) = refit.strain;
    if count == 0 {
        return None;
    }
    let p = chance(strain / (refit.evidence().powi(2) * (1.0 + g)), count);
    (p < STRAINED).then_some(p)
}

/// The residual over the noise that is stated, else that repeated poses show, else what the
/// profile's calibration left, where that is beyond chance; `sigma_m` is that of the rows.
fn louder(
    session: &Session,
    ((scale, freedom), sigma_m): ((f64, f64), f64),
    repeats: Option<Repeats>,
    profile: &Profile,
) -> Option<Louder> {
    let (chance, times, than) = if !session.problem.sigma_assumed {
        let chance = chi_squared_tail(scale * scale * freedom, freedom);
        (chance, scale, "the noise that sigma_mm states")
    } else if let Some(repeats) = repeats {
        let chance = repeats.chance_of(scale, freedom);
        (
            chance,
            scale / repeats.scale,
            "the noise that repeated poses show",
        )
    } else {
        let (variance_m2, of_calibration) = left_by_calibration(profile)?;
        let ratio = (scale * sigma_m).powi(2) / variance_m2;
        let chance = f_tail(ratio, freedom, of_calibration);
        (chance, ratio.sqrt(), "what the profile's calibration left")
    };
    (chance < normal_tail(LOUDER)).then_some(Louder { times, than })
}

/// Scale and degrees of freedom of the residuals of all rows but the outliers, which are reported
/// as such; where there are too many of them, of all.
fn without_outliers(session: &Session, (refit, fit): (&Refit, &Fit), used: &[bool]) -> (f64, f64) {
    let layout = &session.layout;
    let in_use: Vec<usize> = (0..layout.rows()).filter(|row| used[*row]).collect();
    let is_outlier = |row: &&usize| beyond(layout, refit, **row).is_some();
    let outliers: Vec<usize> = in_use.iter().filter(is_outlier).copied().collect();
    if outliers.is_empty() || outliers.len() as f64 > MOST_OUTLIERS * in_use.len() as f64 {
        return (refit.scale, refit.freedom);
    }
    let squares = |of: &[f64], rows: &[usize]| -> f64 {
        let each = rows.iter().map(|row| layout.row(*row));
        each.map(|range| dot(&of[range.clone()], &of[range])).sum()
    };
    let deviance = (refit.deviance - squares(&fit.left, &outliers)).max(0.0);
    let weight = squares(&fit.roots, &in_use) - squares(&fit.roots, &outliers);
    let free: f64 = fit.shares.iter().filter(|s| **s == 1.0).sum();
    let scale = (deviance / (weight - free).max(1.0)).sqrt();
    (scale, (weight / fit.design - free).max(1.0))
}

/// The median of the rows' standard deviations, metres.
fn sigma_m(session: &Session) -> f64 {
    let rows = session.problem.rows.iter();
    let mut sigmas: Vec<f64> = rows.map(|row| row.sigma_m).collect();
    sigmas.sort_by(f64::total_cmp);
    sigmas[sigmas.len() / 2]
}

/// What a calibration holds moved, where there is one.
fn by_trust(
    trust: Trust,
    session: &Session,
    profile: &Profile,
    (refit, fit): (&Refit, &Fit),
) -> Option<Estimate> {
    match trust {
        Trust::Calibrated { .. } => moved(session.start(), profile, refit, fit),
        Trust::Nothing => None,
    }
}

/// Deviance, the information criterion's price of what is fitted freely, and what naming the
/// effects costs.
fn merit(session: &Session, trust: Trust, used: &[bool], chosen: &[Chosen], refit: &Refit) -> f64 {
    let columns = match trust {
        Trust::Nothing => session.shares.len(),
        Trust::Calibrated { .. } => session.shares.iter().filter(|s| **s == 1.0).count(),
    };
    let numbers = (0..session.layout.rows())
        .filter(|r| used[*r])
        .map(|r| session.layout.row(r).len())
        .sum::<usize>() as f64;
    refit.deviance + columns as f64 * numbers.ln() + chosen.iter().map(|c| c.cost).sum::<f64>()
}

/// The effects found in a session, with values of lists nearer to them and waves of the residual.
fn searched(session: &mut Session, used: &[bool], options: &Options) -> Vec<Chosen> {
    let leave = |effect: &Effect| options.reject.iter().any(|pick| pick.means(effect));
    let has_order = |pick: &&Pick| {
        let kind = pick.kind.map(Kind::definition);
        kind.is_some_and(|definition| definition.site.contains(&SiteKey::Order))
    };
    let is_new = |effect: &Effect| session.candidates.is_new(effect);
    let asked = options.accept.iter().filter(has_order);
    let asked: Vec<Effect> = asked.flat_map(Pick::effects).filter(is_new).collect();
    (session.candidates).add_waves(&session.problem, &session.about, asked);
    let mut chosen = session.first(&session.world(used, &options.accept));
    for round in 0..ROUNDS {
        let world = session.world(used, &options.accept);
        chosen = world.search(chosen);
        if round + 1 == ROUNDS || !session.refine(&chosen, used, &leave) {
            break;
        }
    }
    by_gain(chosen)
}

/// The effects found without those that only a model linear about the start needs: what two do
/// together, a softer spring under a lighter load, is a product that is missing there, and another
/// effect takes its place. Fitted without linearisation none of its values is beyond its uncertainty,
/// and it gains less than it costs.
fn needed(
    session: &Session,
    used: &[bool],
    options: &Options,
    mut chosen: Vec<Chosen>,
) -> Vec<Chosen> {
    let world = session.world(used, &options.accept);
    while chosen.len() > 1 && session.shifts.is_empty() {
        let (all, _) = refit(session.start(), &chosen, used);
        let variance = all.evidence().powi(2);
        let is_none = |i: usize| {
            let candidate = &chosen[i].candidate;
            let now = &all.estimate.effects[all.places[i]].parameters;
            let mut before = session.start().estimate.effects.iter();
            let before = before.find(|e| e.same_place(&candidate.effect));
            let mut each = candidate.sought.iter().zip(&all.sigmas[i]);
            each.all(|(number, sigma)| {
                let from = before.map_or(0.0, |effect| effect.parameters[*number]);
                (now[*number] - from).abs() < NONE * sigma
            })
        };
        let needless = (0..chosen.len()).find(|i| {
            let own = &chosen[*i];
            if world.wanted(&own.candidate) || !is_none(*i) {
                return false;
            }
            let mut others = chosen.clone();
            others.remove(*i);
            let (without, _) = refit(session.start(), &others, used);
            let fall = (without.deviance - all.deviance) / variance;
            fall < own.cost && fall < NEEDED * own.gain
        });
        let Some(needless) = needless else { break };
        chosen.remove(needless);
    }
    chosen
}

/// Searches on one set of assumptions, and asks what of the outcome must be questioned.
///
/// # Errors
/// As [`super::diagnose`].
pub(crate) fn attempt(
    profile: &Profile,
    measurements: &Measurements,
    trust: Trust,
    options: &Options,
    progress: &mut dyn FnMut(&str),
) -> Result<(Attempt, Vec<Remark>), IdentifyError> {
    let leave = |effect: &Effect| options.reject.iter().any(|pick| pick.means(effect));
    progress("fitting frames and geometry");
    let used = for_choice(measurements);
    let mut anew = |shifts: &Shifts, weight: Option<f64>| {
        let begin = (shifts, weight);
        let (mut session, remarks) = session(profile, measurements, trust, &leave, begin)?;
        progress("trying every effect");
        let chosen = searched(&mut session, &used, options);
        Ok::<_, IdentifyError>((session, remarks, chosen))
    };
    let mut shifts = Shifts::default();
    let (mut session, mut remarks, mut chosen) = anew(&shifts, None)?;
    // a large step is solved before others are sought
    for _ in 0..SETTLING {
        let own = (profile, measurements);
        let Some(next) = shifts.next(own, &session, &chosen, &used) else {
            break;
        };
        match anew(&next, None) {
            Ok(found) if next.are_among(&found.2) => (session, remarks, chosen) = found,
            _ => break,
        }
        shifts = next;
    }
    // orientations are weighed by what the effects found leave of them, until these are the same
    for _ in 0..SETTLING {
        if session.orientations.is_empty() {
            break;
        }
        let (_, Last { fit, columns }) = refit(session.start(), &chosen, &used);
        let of_places = session
            .orientations
            .against_places(&session.layout, (&fit, &columns));
        let Some(times) = of_places else { break };
        match anew(&shifts, Some(times * session.orientations_by)) {
            Ok(found) if shifts.are_among(&found.2) => (session, remarks, chosen) = found,
            _ => break,
        }
    }
    let chosen = needed(&session, &used, options, chosen);
    // where the arm is measured
    let trust = session.trust;
    progress("fitting what was found");
    let (refit, last) = refit(session.start(), &chosen, &used);
    progress("looking for what no effect explains");
    let library = Library::of(&session.problem, &session.about);
    let Last { fit, columns } = last;
    let given = Given::of((&fit, &columns), &fit, &[]);
    let kept = [given.kept(&[])];
    let left = library.scan(&session.layout, (&fit, &columns), &given, &kept);
    let mut unknown = left.into_iter().next().unwrap_or_default();
    unknown.retain(|u| u.gain > library.cost(u.count));
    let likeness = likeness(&session.problem, &session.layout, &used, &fit);
    let leverage = fit.leverage(&session.layout, &columns);
    let moved = by_trust(trust, &session, profile, (&refit, &fit));
    let loudness = without_outliers(&session, (&refit, &fit), &used);
    let outdone = outdone((&session, &used), &library, &chosen, &refit);
    let mut instead = instead(&session, &used, &chosen);
    let open = open(&session, &used, &chosen);
    instead.extend(open.iter().flat_map(Open::instead));
    let in_a_row = in_a_row(&session, &refit, measurements);
    let strained = strain(trust, &refit);
    let changed = changed(session.start(), profile, (&refit, &fit));
    // with what was found: it may have changed from one repetition to the next
    let repeats = (session.repeats)
        .and_then(|_| of_repeats(&session.problem, &session.layout, &refit.residual, &used));
    let louder = louder(&session, (loudness, sigma_m(&session)), repeats, profile);
    let merit = merit(&session, trust, &used, &chosen, &refit);
    Ok((
        Attempt {
            session,
            used,
            chosen,
            refit,
            moved,
            leverage,
            unknown,
            outdone,
            instead,
            open,
            in_a_row,
            likeness,
            strained,
            changed,
            louder,
            repeats,
            merit,
            trust,
        },
        remarks,
    ))
}
