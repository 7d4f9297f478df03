//! At which temperature an arm is as its profile says, where nothing tells: rows say how it grows,
//! not from where.
//!
//! `k·(T − R)` of all lengths is `k·(T − R')` and the same part `k·(R' − R)` of each, which is what a
//! device does whose lengths are wrong, but for where it stands and for the tool. Where rows do not
//! distinguish both, a temperature between is written: with `a` and `b` what the profile without
//! growth is off by in these rows (root mean square) where `R` and where `R'` is right, `(R'·a +
//! R·b)/(a + b)` is off by the same part `|R − R'|/(a + b)` of that, whichever is. By the triangle
//! inequality it is at most one: the profile is no worse than it was.

use super::instead::{Instead, group_of};
use super::{CLEAR, TIE};
use crate::diagnose::estimator::gain::{Gain, Given};
use crate::diagnose::estimator::table::Column;
use crate::diagnose::question::{Session, Trust};
use crate::diagnose::search::candidates::{Candidate, columns_of};
use crate::diagnose::search::tried::{calibrated_at, known_reference, reference};
use crate::diagnose::search::{Chosen, ODDS, Scored};
use crate::identify::input_checks::{Remark, WHOLE_FILE};
use crate::model::effects::{Effect, Kind};

/// Lengths on drawings are those at this temperature, °C (ISO 1).
const STANDARD_C: f64 = 20.0;
/// Growth from two temperatures that are so far apart is growth from any.
const APART_C: f64 = 10.0;

/// A temperature of lengths that rows do not distinguish from a wrong scale of the device.
#[derive(Clone, Debug)]
pub(crate) struct Open {
    /// Index of the growth found, where its temperature was sought.
    growth: Option<usize>,
    /// Index of the device's scale, where that was found, too.
    scale: Option<usize>,
    /// The candidate of that scale, what it gains and its value in typical sizes where the arm is as
    /// its profile says at [`STANDARD_C`].
    device: Scored,
    /// In words: the device with that scale.
    with_scale: String,
    /// In words: the arm with another temperature, and a device whose lengths are right.
    without_scale: String,
    /// What is written, °C.
    written_c: f64,
    /// By how much what was found is better than the other, in twice a log likelihood.
    behind: f64,
}

/// Whether it is the effect of the data that does what another temperature does.
fn is_of_device(growth: Kind, candidate: &Candidate) -> bool {
    let definition = candidate.effect.definition();
    definition.of_data && definition.search.alternatives.contains(&growth)
}

/// Growth from this temperature, °C.
fn from(growth: &Effect, number: usize, celsius: f64) -> Effect {
    let mut effect = growth.clone();
    effect.parameters[number] = celsius;
    effect
}

/// The temperature of lengths, where these rows leave it open.
pub(crate) fn open(session: &Session, used: &[bool], chosen: &[Chosen]) -> Option<Open> {
    let problem = &session.problem;
    // lengths that are fitted are others at another temperature, and nothing else differs
    if session.trust == Trust::Nothing || calibrated_at(&problem.profile).is_some() {
        return None;
    }
    let is_growth = |effect: &Effect| reference(effect).is_some();
    let found = (chosen.iter()).position(|c| is_growth(&c.candidate.effect));
    let own = problem.profile.effects.iter().find(|e| is_growth(e));
    let growth = found.map(|i| &chosen[i].candidate.effect).or(own)?;
    let number = reference(growth)?;
    let list = &session.candidates.list;
    let at = list.iter().position(|c| is_of_device(growth.kind, c))?;
    let scale = (chosen.iter()).position(|c| is_of_device(growth.kind, &c.candidate));
    let sought = found.filter(|_| known_reference(&problem.profile).is_none());
    sought.or(scale)?;
    let rate = (0..growth.definition().parameters.len()).find(|n| *n != number)?;
    let [cold_c, warm_c] = [STANDARD_C, STANDARD_C + APART_C];
    let wanted = [
        (from(growth, number, cold_c), vec![rate]),
        (from(growth, number, warm_c), vec![rate]),
        (list[at].effect.clone(), list[at].sought.clone()),
    ];
    let columns: Vec<Vec<Column>> = columns_of(problem, &session.about, &wanted);
    let columns: Vec<Column> = columns.into_iter().flatten().collect();
    let world = session.world(used, &[]);
    let (base, fit) = world.fits(chosen);
    let effects: Vec<&[Column]> = chosen.iter().map(|c| c.columns.as_slice()).collect();
    let given = Given::of((&base, world.held), &fit, &effects);
    let others = (0..chosen.len()).map(|i| ![found, scale].contains(&Some(i)));
    let kept = given.kept(&others.collect::<Vec<bool>>());
    let gain = |of: &[usize]| -> Option<Gain> {
        let own: Vec<Column> = of.iter().map(|i| columns[*i].clone()).collect();
        let (group, cross) = group_of(&world, &base, &given, &own);
        let cross: Vec<&[f64]> = cross.iter().map(Vec::as_slice).collect();
        given.gain(&group, &cross, &kept, &vec![None; own.len()])
    };
    let (standard, elsewhere, scaled) = (gain(&[0])?, gain(&[0, 1])?, gain(&[0, 2])?);
    if elsewhere.gain.max(scaled.gain) - standard.gain <= CLEAR {
        return None;
    }
    let better = elsewhere.gain - scaled.gain + 2.0 * ODDS.ln();
    let behind = if scale.is_some() { -better } else { better };
    if behind >= CLEAR {
        return None;
    }
    // growth from several temperatures is growth from one
    let definition = &growth.definition().parameters[rate];
    let size = definition.prior_sigma * definition.unit.in_si();
    let mut parts = vec![
        (elsewhere.values[0] * size, cold_c),
        (elsewhere.values[1] * size, warm_c),
    ];
    parts.extend(own.map(|own| (own.parameters[rate], own.parameters[number])));
    let all: f64 = parts.iter().map(|(rate, _)| rate).sum();
    let without_c = parts.iter().map(|(rate, from)| rate * from).sum::<f64>() / all;
    if !without_c.is_finite() {
        return None;
    }
    let rows = problem.rows.iter().zip(used).filter(|(_, used)| **used);
    let warmth = rows.filter_map(|(row, _)| row.conditions.temperature_c);
    let warmth: Vec<f64> = warmth.collect();
    let off = |from: f64| -> f64 {
        let squares: f64 = warmth.iter().map(|t| (t - from).powi(2)).sum();
        (squares / warmth.len().max(1) as f64).sqrt()
    };
    let (a, b) = (off(STANDARD_C), off(without_c));
    let written_c = (without_c * a + STANDARD_C * b) / (a + b).max(f64::MIN_POSITIVE);
    let values = scaled.values[1..].to_vec();
    let device = list[at].with(&values);
    let key = &device.definition().parameters[list[at].sought[0]];
    Some(Open {
        growth: sought,
        scale,
        with_scale: format!(
            "{} with {} = {:.0}, the arm being as its profile says at {STANDARD_C} degrees",
            device.label(),
            key.key,
            device.parameters[list[at].sought[0]] / key.unit.in_si()
        ),
        without_scale: format!(
            "an arm that is as its profile says at {without_c:.1} degrees, and a device whose \
             lengths are right"
        ),
        device: Scored {
            index: at,
            row: None,
            gain: Gain {
                gain: scaled.gain - standard.gain,
                count: values.len(),
                values,
            },
            cost: 0.0,
        },
        written_c,
        behind,
    })
}

impl Open {
    /// What may be in the place of the effects found.
    pub(crate) fn instead(&self) -> Vec<Instead> {
        let what = match self.scale {
            Some(_) => &self.without_scale,
            None => &self.with_scale,
        };
        let each = self.growth.into_iter().chain(self.scale);
        let instead = each.map(|of| Instead {
            of,
            what: what.clone(),
            behind: self.behind.max(TIE),
        });
        instead.collect()
    }

    /// The effects found with the temperature that is written, and the device's scale with which
    /// they are what was measured.
    pub(crate) fn between(
        &self,
        session: &Session,
        used: &[bool],
        found: &[Chosen],
    ) -> Vec<Chosen> {
        let mut chosen = found.to_vec();
        let Some(growth) = self.growth.map(|i| &mut chosen[i]) else {
            return chosen;
        };
        let effect = &mut growth.candidate.effect;
        if let Some(number) = reference(effect) {
            effect.parameters[number] = self.written_c;
        }
        let own = (
            growth.candidate.effect.clone(),
            growth.candidate.sought.clone(),
        );
        let columns = columns_of(&session.problem, &session.about, &[own]);
        growth.columns = columns.into_iter().flatten().collect();
        if self.scale.is_none() {
            chosen.push(session.world(used, &[]).chosen(&self.device));
        }
        chosen
    }

    /// That the profile has a temperature between, where it gets one.
    pub(crate) fn remark(&self) -> Option<Remark> {
        self.growth?;
        let message = format!(
            "at which temperature the arm is as its profile says does not follow from these rows: \
             {} does the same to them as {}; reference_c of the profile written is {:.1}, between \
             both: it is no worse than the profile was, whichever is right",
            self.with_scale, self.without_scale, self.written_c
        );
        let hint = "measure a length that is known (a scale bar, two nests), and give --reject \
                    measurement_scale where the device's lengths are right; a profile that was \
                    calibrated with temperature_c says at which it was";
        Some(Remark {
            id: "reference-open",
            warning: true,
            line: WHOLE_FILE.into(),
            message,
            hint: hint.into(),
        })
    }
}
