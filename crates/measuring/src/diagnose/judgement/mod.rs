//! What may be believed: of each effect found, and of the whole.
//!
//! Explanation and prediction are two questions. The verdict is `explained` where nothing speaks
//! against the effects found, `improved` where something does but rows left out are predicted
//! better with them; each effect has its own standing.

pub mod accepted;
pub(crate) mod attempt;
pub(crate) mod conclusion;
pub(crate) mod in_a_row;
pub(crate) mod instead;
pub mod poses;
pub(crate) mod reference;
pub mod whereabouts;

use self::attempt::{ALIKE, Attempt, Louder};
use crate::diagnose::diagnosis::{Alternative, Found, Verdict};
use crate::diagnose::estimator::refit::{Beyond, Refit};
use crate::diagnose::outside::chance;
use crate::diagnose::proof::{FEWEST_PARTS, Proof};
use crate::diagnose::search::MOST_EFFECTS;
use crate::diagnose::search::candidates::{CannotTest, least, range};
use crate::diagnose::search::stand_ins::StandIn;
use crate::diagnose::search::waves::near;
use crate::geometry::norm;
use crate::geometry::units::mm_from_m;
use crate::model::effects::{BASE, Effect, Kind, Need, SiteKey};
use crate::model::{JOINTS, Slot};
use std::f64::consts::TAU;

/// Two effects cannot be distinguished where one is better by less than this, in twice a log
/// likelihood: odds of 1.6.
pub(crate) const TIE: f64 = 1.0;
/// One is clearly better beyond this: odds of 150 (R. E. Kass, A. E. Raftery, "Bayes factors"
/// (1995): very strong).
pub(crate) const CLEAR: f64 = 10.0;
/// So many low functions of one joint's angle, a slow harmonic among them, are the series of another.
const SERIES: usize = 2;
/// So many functions of one joint's angle, two waves among them, are the series of another, too.
const WAVES: usize = 3;
/// Waves from so many periods a revolution on are those of a gear's teeth; eccentric parts make
/// fewer.
const TEETH: f64 = 10.0;
/// Fewer periods of a wave in the range of its angle are what any slow function looks like.
const FEW_PERIODS: f64 = 2.0;
/// A value is clearly none that is possible by more than this many standard deviations.
const CLEARLY: f64 = 5.0;
/// An effect is there by its own evidence where chance does that less often.
pub(crate) const EVIDENT: f64 = 1e-4;
/// Chance does what is there more seldom than this, the usual level.
const SHOWN: f64 = 0.05;
/// And found again in this part of the measurements' parts.
pub(crate) const AGAIN: f64 = 0.8;
/// Numbers beyond the parameters that tell their own noise: to 7 %.
const TELLS_NOISE: f64 = 100.0;
/// The joint that turns the flange.
const LAST: usize = JOINTS - 1;
/// Index of a joint's zero in its link's geometry.
const THETA: usize = 3;
/// Where the tool is from the base, about: there a base that is rotated is seen to be.
const REACH_M: f64 = 0.5;
/// Odds beyond e to this are not distinguished.
const MOST_LN_ODDS: f64 = 20.0;

/// How sure an effect is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Standing {
    /// Another explains as much, or it is not found again: it may be the answer.
    Possible,
    /// There, but something else may be in its place, or something larger is missing besides it.
    Likely,
    /// By its own evidence, with nothing in its place.
    Certain,
}

impl Standing {
    /// Its name in reports.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Certain => "certain",
            Self::Likely => "likely",
            Self::Possible => "possible",
        }
    }
}

/// What may be in the place of an effect found.
#[derive(Clone, Debug, PartialEq)]
pub struct Against {
    /// An effect, several, or a function outside the registry.
    pub what: String,
    /// Odds of the effect found against it.
    pub odds: f64,
}

/// The whole.
pub(crate) struct Judged {
    /// Why it may not be the answer, one sentence each.
    pub reasons: Vec<String>,
    pub verdict: Verdict,
}

/// Judges the outcome of a search.
pub(crate) fn judge(
    attempt: &Attempt,
    proof: &Proof,
    found: &[Found],
    alternatives: &[Alternative],
) -> Judged {
    let reasons = objections(attempt, proof, found, alternatives);
    let is_possible = !beyond(&attempt.refit).any(|beyond| is_new(attempt, beyond))
        && attempt.strangers().is_none()
        && attempt.hopeless_m().is_none();
    let verdict = match (reasons.is_empty(), found.is_empty()) {
        (true, true) => Verdict::NothingMissing,
        (true, false) => Verdict::Explained,
        (false, false) if is_possible && proof.is_better() => Verdict::Improved,
        (false, _) => Verdict::Undetermined,
    };
    Judged { reasons, verdict }
}

/// Odds of what is better by so much, in twice a log likelihood.
pub(crate) fn odds_of(behind: f64) -> f64 {
    (0.5 * behind).clamp(-MOST_LN_ODDS, MOST_LN_ODDS).exp()
}

/// Says how sure each effect is, and what may be in its place.
pub(crate) fn stand(
    attempt: &Attempt,
    found: &mut [Found],
    alternatives: &[Alternative],
    stand_ins: &[StandIn],
) {
    let series = series(attempt, found).map_or_else(Vec::new, |series| series.members);
    let is_missing = !series.is_empty()
        || attempt.likeness.in_posture < ALIKE
        || attempt.louder.is_some()
        || !pushing(&attempt.refit).is_empty();
    let is_changing = attempt.likeness.in_order < ALIKE
        || attempt.likeness.opposite < ALIKE
        || attempt.unknown.first().is_some_and(|u| u.of_session);
    let smooth: Vec<bool> = found.iter().map(|f| is_smooth(attempt, f)).collect();
    // rows that fit no model bend what is fitted to the others
    let is_bent = attempt.strangers().is_some() || attempt.hopeless_m().is_some();
    let has_strangers = !attempt.in_a_row.is_empty();
    let unresolved: Vec<bool> = (found.iter())
        .map(|f| is_unresolved(attempt, found, f))
        .collect();
    for (i, one) in found.iter_mut().enumerate() {
        let mut against: Vec<Against> = Vec::new();
        let mut put = |what: String, behind: f64| {
            if behind < CLEAR {
                let odds = odds_of(behind);
                against.push(Against { what, odds });
            }
        };
        for alternative in alternatives.iter().filter(|r| r.instead_of == i) {
            if !is_same(alternative, one) {
                put(alternative.effect.label(), alternative.behind);
            }
        }
        for (_, unknown) in attempt.outdone.iter().filter(|(of, _)| *of == i) {
            put(
                unknown.name.clone(),
                one.gain - unknown.fair_gain(one.sought.len()),
            );
        }
        for other in attempt.instead.iter().filter(|r| r.of == i) {
            put(other.what.clone(), other.behind.max(TIE));
        }
        for group in stand_ins.iter().filter(|s| s.instead_of.contains(&i)) {
            let labels: Vec<String> = group.effects.iter().map(Effect::label).collect();
            put(labels.join(" + "), group.behind);
        }
        against.sort_by(|a, b| a.odds.total_cmp(&b.odds));
        let (untested, twin) = (untested(attempt, one), twin(attempt, one));
        let is_tied = against.first().is_some_and(|a| a.odds < odds_of(TIE));
        let (times, of) = one.found_again;
        let is_again = of >= FEWEST_PARTS && times as f64 >= AGAIN * of as f64;
        // the residual is larger than it, or as smooth: the shadow of what is missing may look like
        // this
        let is_shadow = (attempt.unknown.first()).is_some_and(|u| u.gain > one.gain || smooth[i])
            || smooth[i] && is_missing
            || one.effect.definition().of_data && is_changing;
        one.standing = if is_tied || is_bent || series.contains(&i) || is_seldom(one) {
            Standing::Possible
        } else if against.is_empty()
            && is_again
            && !(is_shadow || has_strangers || unresolved[i] || one.accepted)
            && unusual(one).is_none()
            && untested.is_empty()
            && from_one_side(attempt, one).is_none()
            && twin.is_none()
            && one.p_value < EVIDENT
        {
            Standing::Certain
        } else {
            Standing::Likely
        };
        against.extend(untested.into_iter().map(|alternative| Against {
            what: format!(
                "{}, which needs {}",
                alternative.kind.definition().id,
                alternative.missing
            ),
            odds: 1.0,
        }));
        if let Some(what) = from_one_side(attempt, one).filter(|_| against.is_empty()) {
            let what = format!("{what}, which rows from the other side would show");
            against.push(Against { what, odds: 1.0 });
        }
        if let Some(what) = twin {
            let what = what.to_owned();
            against.insert(0, Against { what, odds: 1.0 });
        }
        one.against = against;
    }
}

/// Effects that do what one found does, and that cannot be tested.
fn untested<'a>(attempt: &'a Attempt, found: &Found) -> Vec<&'a CannotTest> {
    let alternatives = found.effect.definition().search.alternatives;
    let all = attempt.session.candidates.cannot_test.iter();
    all.filter(|c| alternatives.contains(&c.kind)).collect()
}

/// What an effect found cannot be distinguished from because its joint comes to all rows from one
/// side: backlash and a moved zero do the same then.
fn from_one_side(attempt: &Attempt, found: &Found) -> Option<&'static str> {
    let definition = found.effect.definition();
    let is_zero = found.effect.kind == Kind::LinkGeometry && found.sought.contains(&THETA);
    let is_by_side = definition.needs.contains(&Need::Directions);
    let sides = &attempt.session.candidates.one_sided;
    let is_one_sided = sides.get(found.effect.site.index) == Some(&true);
    (is_one_sided && (is_zero || is_by_side)).then_some(if is_zero {
        "backlash"
    } else {
        "a moved zero"
    })
}

/// What does exactly the same to the measurements as an effect found, whatever is measured: a joint
/// that drifts rotates all that is beyond it about its axis, as a device does that turns about the
/// first one, and a tool about the last one.
fn twin(attempt: &Attempt, found: &Found) -> Option<&'static str> {
    let effect = &found.effect;
    let definition = effect.definition();
    // the axis of joint 1 goes along a rail, that of a device does not
    let is_fixed = (attempt.session.problem.profile.external.track).is_empty();
    if !definition.site.contains(&SiteKey::JointOrBase) {
        return (definition.search.or_of_device).then_some(
            "a measuring device whose lengths change, which fixed points measured again would show",
        );
    }
    match effect.site.index {
        BASE => (definition.search.or_of_device).then_some(
            "a drift of the measuring device, which a fixed point measured again would show",
        ),
        0 => is_fixed.then_some(
            "a measuring device or a base that turns about the axis of joint 1, which fixed points \
             measured again would show",
        ),
        LAST => Some(
            "a tool or a reflector that turns about the axis of joint 6, which it measured again \
             on the flange would show",
        ),
        _ => None,
    }
}

/// The same effect: rows from which on one of the data holds, and orders of a wave, may lie a
/// little apart.
fn is_same(alternative: &Alternative, found: &Found) -> bool {
    let is_step = alternative.effect.definition().begins_at_a_row()
        && alternative.effect.site.index == found.effect.site.index;
    alternative.effect.kind == found.effect.kind && is_step
        || near(&alternative.effect, &found.effect)
}

/// Whether a smooth function of the posture may stand for what it does: it has no step, no side
/// that a joint comes from, and no two whole periods in its range.
fn is_smooth(attempt: &Attempt, found: &Found) -> bool {
    let definition = found.effect.definition();
    let is_sharp = definition.of_data && !definition.needs.contains(&Need::Places)
        || definition.needs.contains(&Need::Directions)
        || definition.needs.contains(&Need::Moves)
        || definition.site.contains(&SiteKey::Order) && periods(attempt, found) >= FEW_PERIODS;
    !is_sharp
}

/// Periods of a wave in the range of its joint's angle.
fn periods(attempt: &Attempt, found: &Found) -> f64 {
    let site = &found.effect.site;
    let angles = (attempt.session.problem.rows.iter()).map(|row| row.q[site.index]);
    site.periods() * range(angles) / TAU
}

/// Whether another wave of the same joint differs from this one by less than a period in the range
/// of its angle.
fn is_unresolved(attempt: &Attempt, found: &[Found], one: &Found) -> bool {
    let effect = &one.effect;
    if !effect.definition().site.contains(&SiteKey::Order) {
        return false;
    }
    let own = periods(attempt, one);
    let of_joint = |f: &&Found| {
        let other = &f.effect.site;
        f.effect.kind == effect.kind && other.index == effect.site.index && *other != effect.site
    };
    let mut others = found.iter().filter(of_joint);
    others.any(|f| (periods(attempt, f) - own).abs() < 1.0)
}

/// Joints with waves that cannot be distinguished in the ranges of their angles, one sentence for
/// each.
fn unresolved(attempt: &Attempt, found: &[Found]) -> Vec<String> {
    let of_joint = |joint: usize| {
        let own = |f: &&Found| !f.accepted && f.effect.site.index == joint;
        let own = found.iter().filter(own);
        let own: Vec<&Found> = own.filter(|f| is_unresolved(attempt, found, f)).collect();
        let orders = own.iter().map(|f| f.effect.site.periods().to_string());
        let orders = orders.collect::<Vec<_>>().join(", ");
        (own.len() > 1).then(|| {
            format!(
                "waves of joint {} of orders {orders} cannot be distinguished in the range of its \
                 angle: one of an order between them is as likely",
                joint + 1
            )
        })
    };
    (0..JOINTS).filter_map(of_joint).collect()
}

/// Found again in fewer than half of the parts of the measurements.
pub(crate) fn is_seldom(found: &Found) -> bool {
    let (times, of) = found.found_again;
    2 * times < of
}

/// Whether the residual is the only thing that says how loud the noise is, and there is too little
/// of it.
fn nobody_knows(attempt: &Attempt) -> bool {
    let states = !attempt.session.problem.sigma_assumed || attempt.repeats.is_some();
    !states && attempt.refit.freedom < TELLS_NOISE
}

/// Two figures with three decimals, and more where they would look alike.
pub(crate) fn apart(before: f64, after: f64) -> String {
    let with = |decimals: usize| [before, after].map(|x| format!("{x:.decimals$}"));
    let differ = |words: &[String; 2]| words[0] != words[1];
    let words = (3..9).map(with).find(differ).unwrap_or_else(|| with(9));
    words.join(" → ")
}

/// What the measurements say against effects that a person accepted.
fn overruled(found: &[Found], alternatives: &[Alternative]) -> Vec<String> {
    let mut reasons = Vec::new();
    for (i, one) in found.iter().enumerate().filter(|(_, f)| f.accepted) {
        let label = one.effect.label();
        // nobody has chosen it among many
        let p_value = chance(one.gain, one.sought.len().max(1));
        if p_value > SHOWN {
            reasons.push(format!(
                "the measurements do not show {label}, which was accepted: chance does as much (p = {p_value:.2})"
            ));
        }
        let mut others = alternatives.iter().filter(|r| r.instead_of == i);
        if let Some(better) = others.find(|r| r.behind < -CLEAR && !is_same(r, one)) {
            reasons.push(format!(
                "{} explains the measurements better than {label}, which was accepted: odds {:.0} to 1",
                better.effect.label(),
                odds_of(-better.behind).min(1e6)
            ));
        }
    }
    reasons
}

/// Why the effects found may not be the answer, one sentence each; none where they are.
fn objections(
    attempt: &Attempt,
    proof: &Proof,
    found: &[Found],
    alternatives: &[Alternative],
) -> Vec<String> {
    let mut reasons = Vec::new();
    if let Some(judged) = proof.judged().filter(|j| !found.is_empty() && j.is_worse()) {
        reasons.push(format!(
            "rows left out are predicted worse with what was found: {} mm",
            apart(judged.start.mean, judged.found.mean)
        ));
    }
    if let Some(present) = proof.present.filter(|p| !found.is_empty() && p.is_worse()) {
        reasons.push(format!(
            "rows left out are predicted worse than by the profile as it is: {} mm",
            apart(present.start.mean, present.found.mean)
        ));
    }
    reasons.extend(attempt.in_a_row.iter().map(|rows| rows.words.clone()));
    if let Some((strangers, of)) = attempt.strangers() {
        reasons.push(format!(
            "{strangers} of {of} rows fit no model: what explains the others may have come of them"
        ));
    }
    if let Some(large) = attempt.sigma_large().filter(|_| found.is_empty()) {
        reasons.push(format!(
            "{}: what is missing may be below them",
            large.message
        ));
    }
    if let Some(off_m) = attempt.hopeless_m() {
        reasons.push(format!(
            "rows are still {:.1} mm off (root mean square): no arm is that far from its drawing",
            mm_from_m(off_m)
        ));
    }
    for one in found.iter().filter(|f| !f.accepted && is_seldom(f)) {
        let (times, of) = one.found_again;
        reasons.push(format!(
            "{} is found again in {times} of {of} parts of the measurements only",
            one.effect.label()
        ));
    }
    let tied = |r: &&Alternative| {
        let own = &found[r.instead_of];
        r.behind < TIE && !own.accepted && !is_same(r, own)
    };
    for alternative in alternatives.iter().filter(tied) {
        reasons.push(format!(
            "{} and {} explain the measurements equally well",
            found[alternative.instead_of].effect.label(),
            alternative.effect.label()
        ));
    }
    reasons.extend(overruled(found, alternatives));
    for one in found.iter().filter(|f| !f.accepted) {
        for alternative in untested(attempt, one) {
            reasons.push(format!(
                "{} may be {}, which cannot be tested: it needs {}",
                one.effect.label(),
                alternative.kind.definition().id,
                alternative.missing
            ));
        }
    }
    for one in found.iter().filter(|f| !f.accepted) {
        if let Some(what) = from_one_side(attempt, one) {
            let joint = one.effect.site.index + 1;
            reasons.push(format!(
                "{} may be {what}: joint {joint} comes to all rows from one side (dir{joint} does \
                 not change)",
                one.effect.label()
            ));
        }
    }
    reasons.extend(outdone(attempt, found));
    reasons.extend(unresolved(attempt, found));
    if let Some(series) = series(attempt, found) {
        reasons.push(format!(
            "{} effects at joint {} are functions of its angle alone: together they may imitate \
             one that is not known",
            series.members.len(),
            series.joint + 1
        ));
    }
    if found.len() >= MOST_EFFECTS {
        reasons.push(format!(
            "{} effects are as many as one diagnosis names, and there may be more: diagnose again \
             from the improved profile",
            found.len()
        ));
    }
    if let Some(unknown) = attempt.unknown.first() {
        reasons.push(format!(
            "the residual depends on {} (chi-squared falls by {:.0}): no effect known does that",
            unknown.name, unknown.gain
        ));
    }
    if attempt.likeness.in_order < ALIKE {
        reasons.push(format!(
            "rows one after another miss alike (p = {:.1e}): something changes with time",
            attempt.likeness.in_order
        ));
    }
    if attempt.likeness.opposite < ALIKE {
        reasons.push(format!(
            "rows one after another miss opposite to one another (p = {:.1e}): something changes \
             from row to row",
            attempt.likeness.opposite
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
    reasons.extend(found.iter().filter(|f| !f.accepted).filter_map(unusual));
    if found.is_empty() && nobody_knows(attempt) {
        reasons.push(format!(
            "nothing states the noise, and {:.0} numbers beyond what is fitted are too few to tell \
             it: state sigma_mm or repeat poses",
            attempt.refit.freedom
        ));
    }
    if let Some(Louder { times, than }) = attempt.louder {
        reasons.push(format!("the residual is {times:.2} times {than}"));
    }
    reasons
}

/// Values that clearly nothing physical has.
fn beyond(refit: &Refit) -> impl Iterator<Item = &Beyond> {
    refit.impossible.iter().filter(|b| b.sigmas > CLEARLY)
}

/// Whether the profile has no value in the same place that is as clearly none: where it has, what
/// was found is no better than it in that, and may be better in all else.
fn is_new(attempt: &Attempt, beyond: &Beyond) -> bool {
    let Slot { effect, parameter } = beyond.slot;
    let own = &attempt.refit.estimate.effects[effect];
    let Some(least) = least(&attempt.session.problem, own, parameter) else {
        return true;
    };
    let mut before = attempt.session.present_estimate.effects.iter();
    let Some(before) = before.find(|e| e.same_place(own)) else {
        return true;
    };
    let sigma = (least - own.parameters[parameter]) / beyond.sigmas;
    least - before.parameters[parameter] <= CLEARLY * sigma
}

/// Values that nothing physical has, one sentence for each.
fn pushing(refit: &Refit) -> Vec<String> {
    let sentence = |beyond: &Beyond| {
        let effect = &refit.estimate.effects[beyond.slot.effect];
        let parameter = &effect.definition().parameters[beyond.slot.parameter];
        let value = effect.parameters[beyond.slot.parameter] / parameter.unit.in_si();
        format!(
            "{} fits the measurements with {} = {value:.2e}, {:.0} standard deviations below what \
             is possible: something else is missing or the masses are wrong",
            effect.label(),
            parameter.key,
            beyond.sigmas
        )
    };
    beyond(refit).map(sentence).collect()
}

/// Why an effect found is no error of an arm, where its value is beyond what any has: others were
/// refused for that.
fn unusual(found: &Found) -> Option<String> {
    // where a base or a tool stands is none
    if matches!(found.effect.kind, Kind::BaseFrame | Kind::ToolFrame) {
        return None;
    }
    let (parameter, value, limit) = found.effect.beyond_usual()?;
    let rest = if found.effect.definition().of_data {
        format!(
            "more than the {limit:.0e} of what moves within a session: it was set up anew, or \
             something else is missing"
        )
    } else {
        format!("and no arm has more than {limit:.0e}: something else is missing")
    };
    Some(format!(
        "{} fits the measurements with {} = {value:.2e}, {rest}",
        found.effect.label(),
        parameter.key
    ))
}

/// Effects that functions outside the registry explain more than, one sentence for each function.
fn outdone(attempt: &Attempt, found: &[Found]) -> Vec<String> {
    let outdone = attempt.outdone.iter();
    let outdone: Vec<_> = outdone.filter(|(i, _)| !found[*i].accepted).collect();
    let mut names: Vec<&str> = outdone.iter().map(|(_, u)| u.name.as_str()).collect();
    names.dedup();
    let mut texts = Vec::new();
    let sentence = |name: &str| {
        let of: Vec<_> = outdone.iter().filter(|(_, u)| u.name == name).collect();
        let (i, unknown) = of[0];
        let label = found[*i].effect.label();
        let against = format!(
            "chi-squared {:.0} against {:.0}",
            unknown.gain, found[*i].gain
        );
        match of.len() {
            1 => format!(
                "{label} looks like the answer among the effects known, but {name} explains more \
                 ({against})"
            ),
            n => format!(
                "{label} and {} more look like answers among the effects known, but {name} \
                 explains more than each ({against})",
                n - 1
            ),
        }
    };
    for name in names {
        let text = sentence(name);
        if !texts.contains(&text) {
            texts.push(text);
        }
    }
    texts
}

/// Effects that may together be the series of a function that is not known.
struct Series {
    joint: usize,
    /// Indices of the effects found.
    members: Vec<usize>,
}

/// Effects found at one joint that may together be the series of another function of its angle:
/// low ones where a slow harmonic is among them, without two whole periods in its range; or more of
/// them and of waves than an eccentric gear has.
fn series(attempt: &Attempt, found: &[Found]) -> Option<Series> {
    let is_wave = |i: &usize| found[*i].effect.definition().is_wave();
    let is_slow = |i: &usize| !is_wave(i) || periods(attempt, &found[*i]) < FEW_PERIODS;
    let is_low = |i: &usize| !is_wave(i) || found[*i].effect.site.periods() < TEETH;
    (0..JOINTS).find_map(|joint| {
        let all = (0..found.len()).filter(|i| is_of_angle(joint, &found[*i]));
        let members: Vec<usize> = all.collect();
        let only = |is: &dyn Fn(&usize) -> bool| -> Vec<usize> {
            members.iter().copied().filter(|i| is(i)).collect()
        };
        let (slow, low) = (only(&is_slow), only(&is_low));
        let waves = low.iter().filter(|i| is_wave(i)).count();
        let is_series =
            slow.iter().any(is_wave) && low.len() >= SERIES || low.len() >= WAVES && waves >= 2;
        is_series.then_some(Series { joint, members })
    })
}

/// Whether an effect is a function of this joint's angle alone: the zero of the first joint is that
/// of the base, of the last one that of the tool.
fn is_of_angle(joint: usize, found: &Found) -> bool {
    let effect = &found.effect;
    if found.accepted {
        return false;
    }
    let [x, y, z, _, _, about_z] = effect.parameters;
    match effect.kind {
        Kind::BaseFrame => joint == 0 && about_z.abs() * REACH_M > norm([x, y, z]),
        Kind::ToolFrame => joint + 1 == JOINTS,
        _ if effect.site.index != joint => false,
        Kind::LinkGeometry => found.sought.contains(&THETA),
        _ => effect.definition().of_joint_angle(),
    }
}

#[cfg(test)]
mod tests {
    use super::apart;

    #[test]
    fn figures_of_which_one_is_worse_differ() {
        assert_eq!(apart(0.2181, 0.0442), "0.218 → 0.044");
        assert_eq!(apart(0.049_81, 0.049_93), "0.0498 → 0.0499");
    }
}
