//! Configurations that tell two explanations apart: where their models, both fitted to the same
//! measurements, differ most.

use crate::identify::IdentifyError;
use crate::identify::plan::{Constraints, candidates};
use crate::identify::problem::{Estimate, Problem};
use crate::model::Conditions;
use crate::profile::Profile;

/// Random configurations to choose from.
const DRAWS: usize = 3000;
/// Distance from the joint limits, radians.
const MARGIN_RAD: f64 = 0.02;
/// Two configurations are different where some joint differs by this, radians.
const APART_RAD: f64 = 0.35;

/// A configuration, and how far apart two models expect the tool there, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Telling {
    /// Joint angles in the controller's sense, radians.
    pub q: [f64; 6],
    /// Distance of the two places of the tool, metres.
    pub apart_m: f64,
    /// What it tells from what: effects found, and those in their place.
    pub tells: (String, String),
}

/// The configurations inside the joint limits at which two estimates differ most, at most `count`.
///
/// # Errors
/// Joint limits that leave no room.
pub fn telling(
    profile: &Profile,
    problem: &Problem,
    a: &Estimate,
    b: &Estimate,
    tells: &(String, String),
    count: usize,
) -> Result<Vec<Telling>, IdentifyError> {
    let constraints = Constraints {
        margin_rad: MARGIN_RAD,
        ..Constraints::default()
    };
    let (draws, _) = candidates(profile, &problem.tools[0], &constraints, DRAWS, 1)?;
    let (first, second) = (problem.models(a, &[]), problem.models(b, &[]));
    let mut all: Vec<Telling> = draws
        .into_iter()
        .map(|q| {
            // the joints may arrive from either side
            let apart = [-1.0, 1.0].map(|direction| {
                let conditions = Conditions {
                    direction: [direction; 6],
                    ..Conditions::default()
                };
                let one = first[0].evaluate(&q, &conditions, &mut []);
                one.separation(&second[0].evaluate(&q, &conditions, &mut []))
                    .distance_m
            });
            Telling {
                q,
                apart_m: apart[0].max(apart[1]),
                tells: tells.clone(),
            }
        })
        .collect();
    all.sort_by(|x, y| y.apart_m.total_cmp(&x.apart_m));
    let mut chosen: Vec<Telling> = Vec::new();
    for telling in all {
        let far = |other: &Telling| (0..6).any(|i| (telling.q[i] - other.q[i]).abs() > APART_RAD);
        if chosen.iter().all(far) {
            chosen.push(telling);
        }
        if chosen.len() == count {
            break;
        }
    }
    Ok(chosen)
}
