//! At which angles of a positioner its plate is measured.

use super::begin;
use crate::geometry::{Pose, Vector};
use crate::identify::error::IdentifyError;
use crate::identify::imagined::Derivatives;
use crate::identify::line::Line;
use crate::identify::measurements::{Measurement, Measurements, Observed};
use crate::identify::parameters::Selection;
use crate::identify::plan::{Plan, Request, select};
use crate::identify::random::Random;
use crate::model::Conditions;
use crate::model::external::{Listed, Stand};
use crate::profile::Profile;

/// A seed of its own.
const SEED: u64 = 0x91a7;

/// Chooses angles of a positioner, by its index, at which reflectors on its plate tell its errors
/// best, as [`crate::identify::plan::plan`] chooses postures of an arm. `reflectors` are roughly
/// where they are on the plate, metres; without any they are the profile's, whose coordinates are
/// known.
///
/// # Errors
/// No reflectors; fewer numbers than parameters; parameters that cannot be determined at all.
#[allow(
    clippy::missing_panics_doc,
    reason = "what is expected holds by construction"
)]
pub fn plan_plates(
    profile: &Profile,
    positioner: usize,
    reflectors: &[Vector],
    selection: &Selection,
    request: &Request,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Plan, IdentifyError> {
    let mut profile = profile.clone();
    let own = &mut profile.external.positioners[positioner];
    let mut selection = selection.clone();
    if !reflectors.is_empty() {
        let named = reflectors.iter().zip(1..);
        own.points = named.map(|(p, n)| (format!("r{n}"), *p)).collect();
        selection
            .identify
            .extend(crate::identify::pick::Pick::parse_list("points").expect("a word of the list"));
    }
    let (name, points) = (own.name.clone(), own.points.clone());
    if points.is_empty() {
        return Err(IdentifyError::Suspicious {
            message: format!("positioner {name} has no `points` to measure"),
            hint:
                "--reflector 300,50,20: roughly where one is on the plate, mm; several are better"
                    .into(),
        });
    }
    let mut random = Random::new(request.seed ^ SEED);
    let first = profile.external.first_of(positioner);
    let last = first + profile.external.positioners[positioner].axes.len();
    let margin_rad = request.constraints.margin_rad;
    let mut stands: Vec<Stand> = request.given_stands.clone();
    for _ in 0..request.candidates {
        let listed = profile.external.listed().enumerate();
        let values = listed.map(|(k, axis)| match axis {
            Listed::Rotary(axis, ..) if (first..last).contains(&k) => {
                random.between(axis.min_rad + margin_rad, axis.max_rad - margin_rad)
            }
            _ => f64::NAN,
        });
        stands.push(Stand {
            values: values.collect(),
            directions: Vec::new(),
        });
    }
    let row = |stand: &Stand, point: &String| Measurement {
        line: Line::default(),
        id: String::new(),
        q: [0.0; 6],
        observed: if request.poses {
            Observed::Pose(Pose::identity())
        } else {
            Observed::Position([0.0; 3])
        },
        tool: None,
        point: Some(point.clone()),
        point_in_tool_m: points.get(point).copied(),
        conditions: Conditions::default(),
        stand: stand.clone(),
        plate: Some(name.clone()),
        sigma_m: Some(request.sigma_m),
        sigma_rad: None,
        purpose: None,
        contact: None,
    };
    let rows = stands.iter().flat_map(|stand| {
        points
            .keys()
            .map(|point| row(stand, point))
            .collect::<Vec<_>>()
    });
    let rows = Measurements {
        rows: rows.collect(),
        columns: Vec::new(),
    };
    let (problem, mut estimate) = begin(&profile, &rows, &selection)?;
    if problem.parameters.is_empty() {
        return Err(IdentifyError::NoParameters);
    }
    // nothing was seen yet: the points are where they are said to be
    for (point, value) in problem.points.iter().zip(&mut estimate.points_m) {
        *value = points[&point.name];
    }
    let derivatives = Derivatives::of_rows(&problem, &estimate, points.len(), request.sigma_m);
    let given = request.given_stands.len();
    let mut found = select(derivatives, problem.parameters, (given, 1), request, tell)?;
    let chosen = found.chosen.iter().map(|i| stands[given + i].clone());
    let mut chosen: Vec<Stand> = chosen.collect();
    // from one end to the other
    chosen.sort_by(|a, b| {
        let both = a.values.iter().zip(&b.values);
        let mut gaps = both.map(|(a, b)| a.total_cmp(b)).filter(|gap| gap.is_ne());
        gaps.next().unwrap_or(std::cmp::Ordering::Equal)
    });
    found.stands = request.given_stands.iter().cloned().chain(chosen).collect();
    Ok(found)
}
