//! Values of parameters that are chosen from lists: torques, time constants, temperatures.

use super::candidates::range;
use crate::identify::parameters::minimal;
use crate::identify::problem::{Estimate, Problem};
use crate::model::JOINTS;
use crate::model::effects::{Effect, Kind, List, MOST_PARAMETERS, Sets, Site};
use crate::profile::Profile;

/// Time constants tried, parts of the session's length.
const TIME_CONSTANTS: [f64; 6] = [0.05, 0.12, 0.25, 0.5, 1.0, 2.0];
/// Torques of a knee tried, parts of the largest torque in the measurements.
const KNEES: [f64; 7] = [0.05, 0.1, 0.17, 0.25, 0.35, 0.5, 0.7];

/// Temperatures tried at which the arm may be as its profile says, where nothing tells: parts of the
/// measurements' range from their mean.
const REFERENCES: [f64; 12] = [
    -1.5, -1.25, -1.0, -0.75, -0.5, -0.25, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5,
];

/// The parameters that are sought together, and a parameter with the value that a list chose for
/// it.
pub(super) type Variant = (Vec<usize>, Option<(usize, f64)>);

/// Which parameters are sought together, and the values of those that are chosen from a list.
pub(super) fn variants(kind: Kind, site: &Site, tried: &Tried) -> Vec<Variant> {
    let definition = kind.definition();
    let all = 0..definition.parameters.len();
    match definition.search.sets {
        Sets::All => vec![(all.collect(), None)],
        Sets::Of(sets) => sets.iter().map(|set| (set.to_vec(), None)).collect(),
        Sets::Minimal => {
            let own = &tried.geometry[site.index];
            let each = own.iter().map(|n| (vec![*n], None));
            let together = (own.len() > 2).then(|| (own.clone(), None));
            each.chain(together).collect()
        }
        Sets::At(number, list) => {
            let here = Effect {
                kind,
                site: site.clone(),
                parameters: [0.0; MOST_PARAMETERS],
            };
            let others = all.filter(|n| *n != number && here.has(definition.parameters[*n].key));
            let others: Vec<usize> = others.collect();
            let values = match list {
                List::Temperatures => &tried.references,
                List::Torques => &tried.knees[site.index],
                List::Times => &tried.constants,
                List::Rows => &tried.row_constants,
            };
            let with = |value: &f64| (others.clone(), Some((number, *value)));
            values.iter().map(with).collect()
        }
    }
}

/// The temperature at which a calibration found the lengths of the arm, °C.
pub(crate) fn calibrated_at(profile: &Profile) -> Option<f64> {
    let provenance = profile.provenance.as_ref()?;
    provenance["temperature_c"].as_f64()
}

/// The parameter of an effect that says at which temperature the arm is as its profile says.
pub(crate) fn reference(effect: &Effect) -> Option<usize> {
    let (number, list) = effect.definition().listed()?;
    (list == List::Temperatures).then_some(number)
}

/// That temperature, °C, where the profile says it: by the growth that it has, or by its calibration.
pub(crate) fn known_reference(profile: &Profile) -> Option<f64> {
    let own = profile.effects.iter();
    let mut own = own.filter_map(|effect| Some(effect.parameters[reference(effect)?]));
    own.next().or_else(|| calibrated_at(profile))
}

/// The parameter of an effect that is chosen from a list and counts like a fitted one: it shapes the
/// effect. At which temperature the arm is as its profile says may be known.
pub(crate) fn choice(problem: &Problem, effect: &Effect) -> Option<usize> {
    let (number, _) = effect.definition().listed()?;
    let is_known = reference(effect).is_some() && known_reference(&problem.profile).is_some();
    (!is_known).then_some(number)
}

/// Values that are chosen from lists.
#[derive(Clone, Debug, Default)]
pub struct Tried {
    /// Torques of knees, N·m, of each joint.
    pub knees: [Vec<f64>; JOINTS],
    /// Time constants, seconds.
    pub constants: Vec<f64>,
    /// Constants of a drift from row to row, rows.
    pub row_constants: Vec<f64>,
    /// Reference temperatures, °C.
    pub references: Vec<f64>,
    /// Parameters of each link's geometry that a complete and minimal model has: the others do
    /// what a neighbour's do.
    pub geometry: [Vec<usize>; JOINTS],
}

impl Tried {
    /// From the measurements' own ranges.
    #[must_use]
    pub fn of(problem: &Problem, estimate: &Estimate) -> Self {
        let models = problem.models(estimate, &[]);
        let mut most = [0.0_f64; JOINTS];
        for row in problem.rows.iter() {
            let torques = models[row.rig].torques(&row.q, &row.conditions);
            for i in 0..JOINTS {
                most[i] = most[i].max(torques[i].abs());
            }
        }
        let knees = most.map(|t| {
            if t > 1e-3 {
                KNEES.map(|part| part * t).to_vec()
            } else {
                Vec::new()
            }
        });
        let times: Vec<f64> = problem
            .rows
            .iter()
            .filter_map(|r| r.conditions.time_s)
            .collect();
        let length = times.iter().fold(0.0, |most, t| f64::max(most, *t));
        let constants = if length > 0.0 {
            TIME_CONSTANTS.map(|p| p * length).to_vec()
        } else {
            Vec::new()
        };
        let temperatures: Vec<f64> = problem
            .rows
            .iter()
            .filter_map(|r| r.conditions.temperature_c)
            .collect();
        let mean = temperatures.iter().sum::<f64>() / temperatures.len().max(1) as f64;
        let references = if let Some(known) = known_reference(&problem.profile) {
            vec![known]
        } else {
            let range = range(temperatures.iter().copied());
            let parts = REFERENCES.map(|part| mean + part * range);
            [20.0, mean].into_iter().chain(parts).collect()
        };
        // the first link's are the base's, the last one's turn and offset the tool's
        let keys = Kind::LinkGeometry.definition().parameters;
        let geometry = std::array::from_fn(|link| {
            let own = |n: &usize| match link {
                0 => false,
                5 => ["alpha_deg", "a_mm"].contains(&keys[*n].key),
                _ => minimal(&problem.profile, link, keys[*n].key),
            };
            (0..keys.len()).filter(own).collect()
        });
        Self {
            knees,
            constants,
            row_constants: TIME_CONSTANTS
                .map(|p| p * problem.rows.len() as f64)
                .to_vec(),
            references,
            geometry,
        }
    }
}
