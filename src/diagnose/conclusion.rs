//! What an attempt's outcome means: effects with their evidence, rivals, doubts, the verdict, and the improved profile.

use super::attempt::{ALIKE, Attempt};
use super::candidates::Candidate;
use super::diagnosis::{
    Diagnosis, FollowedRow, Found, NoiseSource, Options, OutlierRow, Rival, Verdict,
};
use super::poses::{Telling, telling};
use super::proof::{Proof, held_out};
use super::refit::{Beyond, Refit, refit};
use super::search::{Chosen, Scored};
use super::session::{Session, Trust, for_choice};
use super::stand_ins::{StandIn, impossible, stand_ins};
use super::table::lengths_m;
use super::unknown::chance;
use super::whereabouts::spots;
use crate::identify::IdentifyError;
use crate::identify::doubt::Remark;
use crate::identify::measurements::Measurements;
use crate::identify::parameters::Pick;
use crate::identify::problem::Estimate;
use crate::identify::robust::limit;
use crate::identify::statistics::Spread;
use crate::model::JOINTS;
use crate::model::effects::{Effect, Kind, REGISTRY};
use crate::model::profile::{DevicePlace, Profile};
use rayon::prelude::*;

/// Another effect explains the data nearly as well where it is worse by no more than this, twice a log likelihood.
const NEARLY: f64 = 6.0;
/// Or where its gain is this part of that of the effect found.
const NEARLY_PART: f64 = 0.95;
/// Two effects cannot be told apart where one is better by less than this.
const TIE: f64 = 1.0;
/// Configurations that tell rivals apart.
const TELLING: usize = 12;
/// A row is an outlier beyond this many times the length that 99.7 % of normal rows stay below.
const OUTLIER: f64 = 1.6;
/// So many functions of one joint's angle, a harmonic among them, are the series of another.
const SERIES: usize = 3;
/// A value fitted along is clearly below zero by more than this many standard deviations.
const CLEARLY: f64 = 5.0;
/// A row is followed where so much of its own numbers is in its expectation.
const FOLLOWED: f64 = 0.7;

/// Draws the conclusions from the better attempt.
///
/// # Errors
/// Joint limits that leave no room for configurations that tell rivals apart.
pub(super) fn conclude(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
    attempt: &Attempt,
    remarks: Vec<Remark>,
    progress: &mut dyn FnMut(&str),
) -> Result<Diagnosis, IdentifyError> {
    let session = &attempt.session;
    let used = for_choice(measurements);
    progress("checking on rows that were not used");
    let proof = if options.quick {
        Proof::none(attempt.chosen.len())
    } else {
        held_out(attempt, measurements, options)
    };
    let spreads = proof.spreads();
    let found = effects(attempt, options, &proof, &spreads);
    let rivals = rivals(attempt);
    let reasons = doubts(attempt, &found, &rivals);
    let verdict = if !reasons.is_empty() {
        Verdict::Undetermined
    } else if found.is_empty() {
        Verdict::NothingMissing
    } else {
        Verdict::Explained
    };
    // what competes with a group is told where the answer is in doubt; else only what explains nearly all
    let world = session.world(&used, &options.accept);
    let doubted = verdict == Verdict::Undetermined;
    let stand_ins = stand_ins(attempt, &world, (!doubted).then_some(NEARLY_PART));
    let impossible = if doubted {
        impossible(attempt, &world)
    } else {
        Vec::new()
    };
    let again = |chosen: &[Chosen]| {
        refit(
            &session.problem,
            &session.layout,
            &session.estimate,
            &session.shares,
            chosen,
            &used,
            session.floor(),
        )
        .estimate
    };
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
    let (noise_m, noise_source, left_m) = noise(attempt);
    let left_lengths = lengths_m(&session.problem, &session.layout, &attempt.refit.residual);
    let present_lengths = lengths_m(&session.problem, &session.layout, &session.present);
    Ok(Diagnosis {
        verdict,
        reasons,
        telling: telling_poses(
            profile, attempt, options, &used, &found, &rivals, &stand_ins,
        )?,
        without: without.collect(),
        bare: options.steps.then(|| again(&[])),
        followed: followed(attempt, measurements),
        found,
        rivals,
        stand_ins,
        impossible,
        unknown: attempt.unknown.clone(),
        spots: spots(
            &session.problem,
            &session.layout,
            &session.present_estimate,
            &used,
            &session.present,
            attempt.refit.fit.scale,
        ),
        cannot_test: session.candidates.cannot_test.clone(),
        absorbed: attempt.trust == Trust::Nothing,
        elsewhere: session.elsewhere,
        held_out: spreads[0].zip(spreads[spreads.len() - 1]),
        absorbed_only: spreads[1],
        noise_m,
        noise_source,
        left_m,
        outliers: outliers(attempt, measurements, &left_lengths),
        remarks,
        lengths: (present_lengths, left_lengths),
        profile: improved(profile, session, &attempt.refit.estimate),
        problem: session.problem.clone(),
        estimate: attempt.refit.estimate.clone(),
    })
}

/// Noise of a coordinate, where it comes from, and what is left of a coordinate, metres.
fn noise(attempt: &Attempt) -> (f64, NoiseSource, f64) {
    let sigma_m = attempt.sigma_m();
    let left_m = attempt.refit.fit.scale * sigma_m;
    if !attempt.session.problem.sigma_assumed {
        return (sigma_m, NoiseSource::Given, left_m);
    }
    match attempt.repeats {
        Some(repeats) => (repeats.scale * sigma_m, NoiseSource::Repeats, left_m),
        None => (left_m, NoiseSource::Residuals, left_m),
    }
}

/// A p-value with the number of tests made.
fn corrected(gain: f64, count: usize, peers: usize) -> f64 {
    (chance(gain, count.max(1)) * (peers * REGISTRY.len()) as f64).min(1.0)
}

/// The effects found, with their values, their evidence, and what each is worth on rows not used.
fn effects(
    attempt: &Attempt,
    options: &Options,
    proof: &Proof,
    spreads: &[Option<Spread>],
) -> Vec<Found> {
    let refit = &attempt.refit;
    let of = |(i, chosen): (usize, &Chosen)| {
        let mut effect = refit.estimate.effects[refit.places[i]].clone();
        effect.site = chosen.candidate.effect.site.clone();
        let parameters = chosen.values.len() + chosen.candidate.chosen;
        let asked_for = |p: &Pick| p.means(&chosen.candidate.effect);
        Found {
            effect,
            sought: chosen.candidate.sought.clone(),
            sigmas: refit.sigmas[i].clone(),
            gain: chosen.gain,
            p_value: corrected(chosen.gain, parameters, chosen.candidate.peers),
            bic: chosen.gain - parameters as f64 * refit.fit.freedom.ln(),
            accepted: options.accept.iter().any(asked_for),
            before: spreads[1 + i],
            after: spreads[2 + i],
            found_again: proof.again[i],
        }
    };
    attempt.chosen.iter().enumerate().map(of).collect()
}

/// Effects that explain the data nearly as well as those found, the nearest first.
fn rivals(attempt: &Attempt) -> Vec<Rival> {
    let mut rivals = Vec::new();
    for (i, chosen) in attempt.chosen.iter().enumerate() {
        for rival in &chosen.rivals {
            let behind = chosen.merit() - rival.merit();
            if behind < NEARLY || rival.gain.gain > NEARLY_PART * chosen.gain {
                let candidate = &attempt.session.candidates.list[rival.index];
                rivals.push(rival_of(candidate, rival, i, behind));
            }
        }
    }
    rivals.sort_by(|a, b| a.behind.total_cmp(&b.behind));
    rivals
}

/// Why the effects found may not be the answer, one sentence each; none where they are.
fn doubts(attempt: &Attempt, found: &[Found], rivals: &[Rival]) -> Vec<String> {
    let mut reasons = Vec::new();
    // rows from which on an effect of the data holds may lie a little apart
    let plain = |r: &Rival| {
        r.effect.kind == found[r.instead_of].effect.kind && r.effect.definition().of_data()
    };
    let tied = |r: &&Rival| r.behind < TIE && !found[r.instead_of].accepted && !plain(r);
    for rival in rivals.iter().filter(tied) {
        reasons.push(format!(
            "{} and {} explain the measurements equally well",
            found[rival.instead_of].effect.label(),
            rival.effect.label()
        ));
    }
    reasons.extend(outdone(attempt, found));
    if let Some((joint, count)) = imitated(found) {
        reasons.push(format!(
            "{count} effects at joint {joint} are functions of its angle alone: together they imitate one that is not known"
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
    reasons.extend(pushing(&attempt.refit));
    if let Some(scale) = attempt.louder {
        let source = if attempt.session.problem.sigma_assumed {
            "repeated poses show"
        } else {
            "sigma_mm states"
        };
        reasons.push(format!(
            "what is left is {scale:.2} times the noise that {source}"
        ));
    }
    reasons
}

/// Values fitted along that nothing physical has, one sentence for each.
fn pushing(refit: &Refit) -> Vec<String> {
    let clear = refit.impossible.iter().filter(|b| b.sigmas > CLEARLY);
    let sentence = |beyond: &Beyond| {
        let effect = &refit.estimate.effects[beyond.slot.effect];
        let parameter = &effect.definition().parameters[beyond.slot.parameter];
        let value = effect.parameters[beyond.slot.parameter] / parameter.unit.in_si();
        format!(
            "{} fits the measurements with {} = {value:.2e}, {:.0} standard deviations below zero: no spring is like that, \
             something else is missing or the masses are wrong",
            effect.label(),
            parameter.key,
            beyond.sigmas
        )
    };
    clear.map(sentence).collect()
}

/// Effects that functions outside the registry explain more than, one sentence for each function.
fn outdone(attempt: &Attempt, found: &[Found]) -> Vec<String> {
    let rivalled = attempt.rivalled.iter();
    let rivalled: Vec<_> = rivalled.filter(|(i, _)| !found[*i].accepted).collect();
    let mut names: Vec<&str> = rivalled.iter().map(|(_, u)| u.name.as_str()).collect();
    names.dedup();
    let mut told = Vec::new();
    let sentence = |name: &str| {
        let of: Vec<_> = rivalled.iter().filter(|(_, u)| u.name == name).collect();
        let (i, unknown) = of[0];
        let label = found[*i].effect.label();
        let against = format!(
            "chi-squared {:.0} against {:.0}",
            unknown.gain, found[*i].gain
        );
        match of.len() {
            1 => format!(
                "{label} looks like the answer among the effects known, but {name} explains more ({against})"
            ),
            n => format!(
                "{label} and {} more look like answers among the effects known, but {name} explains more than each ({against})",
                n - 1
            ),
        }
    };
    for name in names {
        let text = sentence(name);
        if !told.contains(&text) {
            told.push(text);
        }
    }
    told
}

/// A joint, from 1, at which so many effects were found that together they are the series of any function of its angle.
fn imitated(found: &[Found]) -> Option<(usize, usize)> {
    (0..JOINTS).find_map(|joint| {
        let at = |f: &&Found| f.effect.site.index == joint && !f.accepted;
        let of = |kind| {
            found
                .iter()
                .filter(at)
                .filter(|f| f.effect.kind == kind)
                .count()
        };
        let harmonics = of(Kind::JointHarmonic);
        let count = harmonics + of(Kind::JointScale) + of(Kind::LinkGeometry);
        (harmonics >= 1 && count >= SERIES).then_some((joint + 1, count))
    })
}

/// Rows that what was found does not explain, the farthest first.
fn outliers(attempt: &Attempt, measurements: &Measurements, left_m: &[f64]) -> Vec<OutlierRow> {
    let (layout, refit) = (&attempt.session.layout, &attempt.refit);
    let mut outliers = Vec::new();
    for (row, m) in measurements.rows.iter().enumerate() {
        let range = layout.row(row);
        let squares = refit.residual[range.clone()].iter().map(|r| r * r);
        let length = squares.sum::<f64>().sqrt();
        if length > OUTLIER * limit(range.len()) * refit.fit.scale {
            outliers.push(OutlierRow {
                line: m.line.clone(),
                id: m.id.clone(),
                length_m: left_m[row],
                times: length / refit.fit.scale,
            });
        }
    }
    outliers.sort_by(|a, b| b.times.total_cmp(&a.times));
    outliers
}

/// Rows that the model follows whatever they say, by their leverage.
fn followed(attempt: &Attempt, measurements: &Measurements) -> Vec<FollowedRow> {
    let leverage = attempt.refit.fit.leverage(&attempt.session.layout);
    let rows = measurements.rows.iter().zip(leverage);
    let mut followed: Vec<FollowedRow> = rows
        .filter(|(_, leverage)| *leverage > FOLLOWED)
        .map(|(m, leverage)| FollowedRow {
            line: m.line.clone(),
            id: m.id.clone(),
            leverage,
        })
        .collect();
    followed.sort_by(|a, b| b.leverage.total_cmp(&a.leverage));
    followed
}

/// Configurations that tell the strongest rival from the effect found: the rival takes its place, everything is fitted
/// again, and where the two models differ most tells.
fn telling_poses(
    profile: &Profile,
    attempt: &Attempt,
    options: &Options,
    used: &[bool],
    found: &[Found],
    rivals: &[Rival],
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
    let of_robot = |r: &&Rival| {
        !r.effect.definition().of_data() && !found[r.instead_of].effect.definition().of_data()
    };
    let single = rivals.iter().find(of_robot).and_then(|rival| {
        let scored = attempt.chosen[rival.instead_of].rivals.iter().find(|s| {
            let other = &session.candidates.list[s.index].effect;
            other.kind == rival.effect.kind && other.site == rival.effect.site
        });
        scored.map(|scored| (rival, scored))
    });
    if let Some((rival, scored)) = single {
        let world = session.world(used, &options.accept);
        let mut other = attempt.chosen.clone();
        other[rival.instead_of] = world.chosen(scored);
        let refitted = refit(
            &session.problem,
            &session.layout,
            &session.estimate,
            &session.shares,
            &other,
            used,
            session.floor(),
        );
        let tells = (found[rival.instead_of].effect.label(), rival.effect.label());
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
fn improved(profile: &Profile, session: &Session, estimate: &Estimate) -> Profile {
    let mut improved = profile.clone();
    // a device that stands elsewhere, or that the profile knows of, says nothing of the robot
    let keep_base = session.elsewhere || profile.device.is_some();
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
        let mut fitted = improved.clone();
        fitted.world_from_base = estimate.world_from_base;
        fitted.effects.clone_from(&estimate.effects);
        let nearer = profile.world_from_real_base() * fitted.world_from_real_base().inverse();
        improved.device = Some(DevicePlace {
            world_from_device: nearer * session.world_from_device,
            sigma: None,
        });
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
