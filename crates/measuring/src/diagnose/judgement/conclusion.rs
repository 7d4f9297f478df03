//! What an attempt's outcome means: effects with their evidence, alternatives, objections, the
//! verdict, and the improved profile.

use super::accepted::not_taken;
use super::attempt::Attempt;
use super::in_a_row::beyond;
use super::poses::{Telling, telling};
use super::reference::Open;
use super::whereabouts::spots;
use super::{Judged, Standing, apart, is_seldom, judge, stand};
use crate::diagnose::diagnosis::{
    Alternative, Diagnosis, FollowedRow, Found, NoiseSource, Options, OutlierRow, Verdict,
};
use crate::diagnose::estimator::refit::refit;
use crate::diagnose::estimator::table::{dot, lengths_m};
use crate::diagnose::outside::chance;
use crate::diagnose::proof::improved::improved;
use crate::diagnose::proof::{Proof, held_out};
use crate::diagnose::question::{Session, Trust, for_choice};
use crate::diagnose::search::candidates::{Candidate, range};
use crate::diagnose::search::stand_ins::{StandIn, impossible, stand_ins};
use crate::diagnose::search::{Chosen, Scored};
use crate::geometry::Pose;
use crate::identify::IdentifyError;
use crate::identify::input_checks::Remark;
use crate::identify::input_checks::screening::moved_fitted_tools;
use crate::identify::measurements::Measurements;
use crate::identify::off::Off;
use crate::identify::pick::Pick;
use crate::identify::problem::{Estimate, Row};
use crate::identify::statistics::Spread;
use crate::model::effects::{Effect, Kind, Seen, of_arm};
use crate::profile::Profile;
use rayon::prelude::*;

/// Another effect explains the data nearly as well where it is worse by no more than this, twice a
/// log likelihood.
const NEARLY: f64 = 6.0;
/// Or where its gain is this part of that of the effect found.
const NEARLY_PART: f64 = 0.95;
/// Metres or radians below this are roundings.
const ROUNDING: f64 = 1e-12;
/// Configurations that tell alternatives apart.
const TELLING: usize = 12;
/// A row is followed where so much of its own numbers is in its expectation.
const FOLLOWED: f64 = 0.7;

/// Draws the conclusions from the better attempt.
///
/// # Errors
/// Joint limits that leave no room for configurations that tell alternatives apart.
pub(crate) fn conclude(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
    attempt: &Attempt,
    mut remarks: Vec<Remark>,
    progress: &mut dyn FnMut(&str),
) -> Result<Diagnosis, IdentifyError> {
    let session = &attempt.session;
    let used = for_choice(measurements);
    progress("checking on rows that were not used");
    let mut proof = if options.quick {
        Proof::none(attempt.chosen.len())
    } else {
        held_out(attempt, &attempt.chosen, measurements, options)
    };
    let mut spreads = proof.spreads();
    let mut found = effects(attempt, options, &proof, &spreads);
    let alternatives = alternatives(attempt);
    let Judged {
        mut reasons,
        mut verdict,
    } = judge(attempt, &proof, &found, &alternatives);
    // what competes with a group is reported where the answer is uncertain; else only what explains
    // nearly all
    let world = session.world(&used, &options.accept);
    let uncertain = !reasons.is_empty();
    let stand_ins = stand_ins(attempt, &world, (!uncertain).then_some(NEARLY_PART));
    let impossible = if uncertain {
        impossible(attempt, &world)
    } else {
        Vec::new()
    };
    stand(attempt, &mut found, &alternatives, &stand_ins);
    let again = |chosen: &[Chosen]| refit(session.start(), chosen, &used).0.estimate;
    let each = 0..if options.steps {
        attempt.chosen.len()
    } else {
        0
    };
    let without = each.into_par_iter().map(|i| {
        let mut others = attempt.chosen.clone();
        others.remove(i);
        again(&others)
    });
    // what is written is what is proved: without what the profile does not follow
    if let Some(followed) = followed_only(attempt, &found, verdict) {
        let own = held_out(attempt, &followed, measurements, options);
        if own.is_better() {
            spreads = put_spreads(&mut found, verdict, &own);
            proof = own;
        } else {
            reasons.extend(not_better(&found, verdict, &own));
            verdict = Verdict::Undetermined;
        }
    }
    let written = written(profile, attempt, &mut found, (verdict, proof.all_predict));
    remarks.extend(attempt.open.as_ref().and_then(Open::remark));
    remarks.extend(attempt.sigma_large());
    if remarks.iter().all(|known| known.id != "tool-elsewhere") {
        remarks.extend(moved_fitted_tools(profile, &attempt.refit.estimate));
    }
    let (noise_m, noise_source, residual_m) = noise(attempt);
    let together: Vec<_> = attempt
        .in_a_row
        .iter()
        .map(|own| own.rows.clone())
        .collect();
    let offs = offs(attempt);
    let residual_lengths = lengths_m(&session.problem, &session.layout, &attempt.refit.residual);
    let present_lengths = lengths_m(&session.problem, &session.layout, &session.present);
    Ok(Diagnosis {
        verdict,
        reasons,
        telling: telling_poses(
            profile,
            attempt,
            options,
            &used,
            &found,
            &alternatives,
            &stand_ins,
        )?,
        without: without.collect(),
        bare: options.steps.then(|| again(&[])),
        followed: followed(attempt, measurements),
        found,
        alternatives,
        stand_ins,
        impossible,
        unknown: attempt.unknown.clone(),
        spots: spots(
            &session.problem,
            &session.layout,
            &session.present_estimate,
            &used,
            &session.present,
            attempt.refit.scale,
            &together,
        ),
        cannot_test: session.candidates.cannot_test.clone(),
        absorbed: attempt.trust == Trust::Nothing,
        changed: attempt.changed.clone(),
        elsewhere: session.elsewhere,
        held_out: spreads[0].zip(spreads[spreads.len() - 1]),
        absorbed_only: spreads[1],
        noise_m,
        noise_source,
        residual_m,
        residual_spots: spots(
            &session.problem,
            &session.layout,
            &attempt.refit.estimate,
            &used,
            &attempt.refit.residual,
            attempt.refit.scale,
            &together,
        ),
        judged: proof.judged().filter(|_| !attempt.chosen.is_empty()),
        not_taken: not_taken(attempt, &world),
        outliers: outliers(attempt, measurements, &offs),
        offs,
        remarks,
        lengths: (present_lengths, residual_lengths),
        profile: improved(profile, session, &written.0, &written.1),
        problem: session.problem.clone(),
        estimate: attempt.refit.estimate.clone(),
    })
}

/// Whether an effect of the session is not sure enough for the robot to be where it left it.
fn is_unsure(found: &Found, verdict: Verdict) -> bool {
    verdict == Verdict::Improved
        && !found.accepted
        && found.effect.definition().of_data
        && found.standing == Standing::Possible
}

/// The effects found without those of the session that the profile does not follow, where there are
/// any and some of the arm remain.
fn followed_only(attempt: &Attempt, found: &[Found], verdict: Verdict) -> Option<Vec<Chosen>> {
    let both = attempt.chosen.iter().zip(found);
    let followed = both.filter(|(_, f)| !is_unsure(f, verdict));
    let followed: Vec<Chosen> = followed.map(|(chosen, _)| chosen.clone()).collect();
    let is_of_arm = |chosen: &Chosen| !chosen.candidate.effect.definition().of_data;
    (followed.len() < found.len() && followed.iter().any(is_of_arm)).then_some(followed)
}

/// Errors on rows not used are those of what is written, step by step; of an effect that the profile
/// does not follow there are none.
fn put_spreads(found: &mut [Found], verdict: Verdict, proof: &Proof) -> Vec<Option<Spread>> {
    let spreads = proof.spreads();
    let mut step = 1;
    for one in found {
        (one.before, one.after) = (None, None);
        if !is_unsure(one, verdict) {
            (one.before, one.after) = (spreads[step], spreads[step + 1]);
            step += 1;
        }
    }
    spreads
}

/// Why nothing is written: rows left out are not predicted better without what the profile would not
/// follow.
fn not_better(found: &[Found], verdict: Verdict, proof: &Proof) -> Option<String> {
    let judged = proof.judged()?;
    let unsure = found.iter().filter(|f| is_unsure(f, verdict));
    let labels: Vec<String> = unsure.map(|f| f.effect.label()).collect();
    Some(format!(
        "{} is not sure enough for a profile to follow it, and without it rows left out are not \
         predicted better beyond chance: {} mm",
        labels.join(" + "),
        apart(judged.start.mean, judged.found.mean)
    ))
}

/// The values that the improved profile gets, and effects of the session that are not sure enough
/// for the robot to be where they left it; says of each effect whether the profile has it.
///
/// What the profile does not follow was not fitted either: what is fitted along with it is right
/// only together with it.
///
/// Where not all that was found is believed, an effect that was found again too seldom was not in
/// the predictions that the answer rests on: the profile is without it, unless all that was found
/// predicts rows left out as well.
fn written(
    profile: &Profile,
    attempt: &Attempt,
    found: &mut [Found],
    (verdict, all_predict): (Verdict, bool),
) -> (Estimate, Vec<Effect>) {
    let mut unsure = Vec::new();
    for one in found.iter_mut().filter(|f| !f.accepted) {
        let is_improved = verdict == Verdict::Improved;
        one.in_profile = all_predict || !(is_improved && is_seldom(one));
        if is_unsure(one, verdict) {
            one.in_profile = false;
            unsure.push(one.effect.clone());
        }
    }
    let (own, moved) = if attempt.open.is_none() && found.iter().all(|f| f.in_profile) {
        (attempt.refit.clone(), attempt.moved.clone())
    } else {
        let all = match &attempt.open {
            Some(open) => open.between(&attempt.session, &attempt.used, &attempt.chosen),
            None => attempt.chosen.clone(),
        };
        // the device's scale that makes up for the temperature that is written comes last
        let kept = found.iter().map(|f| f.in_profile);
        let kept = kept.chain(std::iter::repeat(true)).zip(all);
        let kept = kept.filter(|(is_kept, _)| *is_kept).map(|(_, c)| c);
        attempt.refitted(profile, &kept.collect::<Vec<_>>())
    };
    // where nothing of the arm is missing nothing of it is moved
    let is_of_arm = |f: &Found| !f.effect.definition().of_data;
    let moved = moved.filter(|_| verdict != Verdict::NothingMissing && found.iter().any(is_of_arm));
    (moved.unwrap_or(own.estimate), unsure)
}

/// Noise of a coordinate, where it comes from, and the residual of a coordinate, metres.
fn noise(attempt: &Attempt) -> (f64, NoiseSource, f64) {
    let sigma_m = attempt.sigma_m();
    // the scale by which evidence counts is not below the noise that is stated
    let is_large = attempt.sigma_large().is_some();
    let scale = if is_large {
        attempt.refit.mean
    } else {
        attempt.refit.scale
    };
    let residual_m = scale * sigma_m;
    if !attempt.session.problem.sigma_assumed {
        return (sigma_m, NoiseSource::Given, residual_m);
    }
    match attempt.repeats {
        Some(repeats) => (repeats.scale * sigma_m, NoiseSource::Repeats, residual_m),
        None => (residual_m, NoiseSource::Residuals, residual_m),
    }
}

/// A p-value with the number of tests made.
pub(crate) fn corrected(gain: f64, count: usize, peers: usize) -> f64 {
    (chance(gain, count.max(1)) * (peers * of_arm().count()) as f64).min(1.0)
}

/// The effects found, with their values, their evidence, and what each is worth on rows not used.
fn effects(
    attempt: &Attempt,
    options: &Options,
    proof: &Proof,
    spreads: &[Option<Spread>],
) -> Vec<Found> {
    let refit = &attempt.refit;
    let rows = &attempt.session.problem.rows;
    let points = attempt.session.problem.points.iter();
    let seen = Seen {
        base_m: refit.estimate.world_from_base.translation,
        rows: rows.len(),
        seconds: range(rows.iter().filter_map(|row| row.conditions.time_s)),
        points: points.map(|point| point.name.clone()).collect(),
    };
    let of = |(i, chosen): (usize, &Chosen)| {
        let place = &refit.estimate.effects[refit.places[i]];
        let mut effect = since(place, &refit.estimate, &attempt.session);
        effect.site = chosen.candidate.effect.site.clone();
        // of frames it is reported how they moved
        let is_total = !matches!(effect.kind, Kind::BaseFrame | Kind::ToolFrame);
        let mut of_profile = attempt.session.problem.profile.effects.iter();
        let was = of_profile.find(|e| is_total && e.same_place(&effect));
        let parameters = chosen.values.len() + chosen.candidate.chosen;
        let asked_for = |p: &Pick| p.means(&chosen.candidate.effect);
        Found {
            sought: chosen.candidate.sought.clone(),
            sigmas: refit.sigmas[i].clone(),
            listed: (effect.definition().listed()).and_then(|(number, _)| {
                let sigma = refit.chosen_sigmas[i].filter(|s| s.is_finite());
                sigma.map(|sigma| (number, sigma))
            }),
            was: was.cloned(),
            effect,
            gain: chosen.gain,
            p_value: corrected(chosen.gain, parameters, chosen.candidate.peers),
            bic: chosen.gain - parameters as f64 * refit.freedom.ln(),
            accepted: options.accept.iter().any(asked_for),
            before: spreads[1 + i],
            after: spreads[2 + i],
            found_again: proof.again[i],
            seen: seen.clone(),
            in_profile: true,
            standing: Standing::Possible,
            against: Vec::new(),
        }
    };
    attempt.chosen.iter().enumerate().map(of).collect()
}

/// An effect as it is reported: of a frame how it stands in `now` from where it stood before.
fn since(effect: &Effect, now: &Estimate, session: &Session) -> Effect {
    let before = &session.present_estimate;
    let mut moved = effect.clone();
    let stood = |of: &Estimate, own: Option<&Effect>| {
        let deviation =
            own.map_or_else(Pose::identity, |own| Pose::from_xyz_rxryrz(own.parameters));
        match effect.kind {
            Kind::BaseFrame => of.world_from_base * deviation,
            _ => deviation,
        }
    };
    if matches!(effect.kind, Kind::BaseFrame | Kind::ToolFrame) {
        // a tool that was fitted before is still where the profile has it
        let mut known = if effect.kind == Kind::ToolFrame {
            session.problem.profile.effects.iter()
        } else {
            before.effects.iter()
        };
        let known = known.find(|e| e.same_place(effect));
        let by = stood(before, known).inverse() * stood(now, Some(effect));
        // a part that did not move is zero, without roundings
        let part = |x: f64| if x.abs() < ROUNDING { 0.0 } else { x };
        moved.parameters = by.xyz_rxryrz().map(part);
    }
    moved
}

/// Effects that explain the data nearly as well as those found, the nearest first.
fn alternatives(attempt: &Attempt) -> Vec<Alternative> {
    let mut alternatives = Vec::new();
    for (i, chosen) in attempt.chosen.iter().enumerate() {
        for alternative in &chosen.alternatives {
            let behind = chosen.merit() - alternative.merit();
            if behind < NEARLY || alternative.gain.gain > NEARLY_PART * chosen.gain {
                let candidate = &attempt.session.candidates.list[alternative.index];
                alternatives.push(alternative_of(candidate, alternative, i, behind));
            }
        }
    }
    alternatives.sort_by(|a, b| a.behind.total_cmp(&b.behind));
    alternatives
}

/// How far each row is off with what was found.
fn offs(attempt: &Attempt) -> Vec<Off> {
    let (problem, layout) = (&attempt.session.problem, &attempt.session.layout);
    let of = |(row, own): (usize, &Row)| {
        let residual = &attempt.refit.residual[layout.row(row)];
        let (place, turned) = residual.split_at(residual.len().min(3));
        let length = |part: &[f64]| dot(part, part).sqrt();
        let angle = (!turned.is_empty()).then(|| length(turned) * own.sigma_rad);
        Off::new(own, length(place) * own.sigma_m, angle)
    };
    problem.rows.iter().enumerate().map(of).collect()
}

/// Rows that what was found does not explain, the farthest first.
fn outliers(attempt: &Attempt, measurements: &Measurements, offs: &[Off]) -> Vec<OutlierRow> {
    let (layout, refit) = (&attempt.session.layout, &attempt.refit);
    let mut outliers = Vec::new();
    for (row, m) in measurements.rows.iter().enumerate() {
        if let Some(times) = beyond(layout, refit, row) {
            outliers.push(OutlierRow {
                line: m.line.clone(),
                id: m.id.clone(),
                off: offs[row],
                times,
            });
        }
    }
    outliers.sort_by(|a, b| b.times.total_cmp(&a.times));
    outliers
}

/// Rows that the model follows whatever they say, by their leverage.
fn followed(attempt: &Attempt, measurements: &Measurements) -> Vec<FollowedRow> {
    let rows = measurements.rows.iter().zip(&attempt.leverage);
    let mut followed: Vec<FollowedRow> = rows
        .filter(|(_, leverage)| **leverage > FOLLOWED)
        .map(|(m, leverage)| FollowedRow {
            line: m.line.clone(),
            id: m.id.clone(),
            leverage: *leverage,
        })
        .collect();
    followed.sort_by(|a, b| b.leverage.total_cmp(&a.leverage));
    followed
}

/// Configurations that tell the strongest alternative from the effect found: the alternative takes
/// its place, everything is fitted again, and where the two models differ most tells.
fn telling_poses(
    profile: &Profile,
    attempt: &Attempt,
    options: &Options,
    used: &[bool],
    found: &[Found],
    alternatives: &[Alternative],
    stand_ins: &[StandIn],
) -> Result<Vec<Telling>, IdentifyError> {
    let session = &attempt.session;
    let mut all = Vec::new();
    // half of them for each, where there are both
    let count = |both: bool| if both { TELLING / 2 } else { TELLING };
    let tell = |other: &Estimate, tells: (String, String), count: usize| {
        let found = &attempt.refit.estimate;
        telling(profile, &session.problem, found, other, &tells, count)
    };
    let labels = |effects: &mut dyn Iterator<Item = &Effect>| {
        effects.map(Effect::label).collect::<Vec<_>>().join(" + ")
    };
    let of_robot = |r: &&Alternative| {
        !r.effect.definition().of_data && !found[r.instead_of].effect.definition().of_data
    };
    let single = alternatives.iter().find(of_robot).and_then(|alternative| {
        let scored = attempt.chosen[alternative.instead_of]
            .alternatives
            .iter()
            .find(|s| {
                let other = &session.candidates.list[s.index].effect;
                other.kind == alternative.effect.kind && other.site == alternative.effect.site
            });
        scored.map(|scored| (alternative, scored))
    });
    if let Some((alternative, scored)) = single {
        let world = session.world(used, &options.accept);
        let mut other = attempt.chosen.clone();
        other[alternative.instead_of] = world.chosen(scored);
        let (refitted, _) = refit(session.start(), &other, used);
        let tells = (
            found[alternative.instead_of].effect.label(),
            alternative.effect.label(),
        );
        all = tell(&refitted.estimate, tells, count(!stand_ins.is_empty()))?;
    }
    if let Some(stand_in) = stand_ins.first() {
        let tells = (
            labels(&mut stand_in.instead_of.iter().map(|i| &found[*i].effect)),
            labels(&mut stand_in.effects.iter()),
        );
        all.extend(tell(&stand_in.estimate, tells, count(single.is_some()))?);
    }
    Ok(all)
}

fn alternative_of(
    candidate: &Candidate,
    scored: &Scored,
    instead_of: usize,
    behind: f64,
) -> Alternative {
    let mut effect = candidate.with(&scored.gain.values);
    if let Some(row) = scored.row {
        effect.site.order = row;
    }
    Alternative {
        effect,
        instead_of,
        gain: scored.gain.gain,
        behind,
    }
}
