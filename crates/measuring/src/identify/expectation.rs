//! What the uncertainties of the parameters mean for the arm elsewhere.

use super::normal::Normal;
use super::observation::Observation;
use super::parameters::{FIRST_PHYSICAL, Parameter, Subject};
use super::problem::{Estimate, PointRef, Problem, Row};
use super::random::Random;
use super::robust::Loss;
use super::uncertainty::Uncertainty;
use crate::geometry::{Four, Pose, Scalar, Vector, WIDTH, add, cross, scale};
use crate::model::external::Stand;
use crate::model::{Conditions, FourMotions, Motion};
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};
use std::sync::Arc;

/// Random postures within the joint limits.
pub const POSTURES: usize = 300;
/// Base, tool and points are believed to be within so many of their typical sizes where the data do
/// not tell.
const ANYWHERE: f64 = 100.0;
/// Residuals are larger than the noise stated where chance makes them so less often.
const BY_CHANCE: f64 = 1e-3;

/// Derivatives of what is observed of a row by the parameters, in their scales and in standard
/// deviations of the row.
pub(super) fn slopes(
    seen: &Observation,
    motions: &[Motion],
    parameters: &[Parameter],
    mut each: impl FnMut(usize, [f64; 6]),
) {
    let mut motion = motions.iter();
    for (column, parameter) in parameters.iter().enumerate() {
        let slope = match parameter.subject {
            Subject::Effect(_) => motion.next().map_or([0.0; 6], |m| seen.slope(m)),
            Subject::Point { point, axis } => seen.slope_of_point(point, axis),
            Subject::Feature { feature, value } => seen.slope_of_feature(feature, value),
        };
        each(column, slope.map(|x| x * parameter.scale));
    }
}

/// The same in four postures, with the tools there and the point at `arm` from their origins: how
/// the point is shifted and how the tool turns, metres and radians a scale.
#[inline(always)]
pub(super) fn four_slopes(
    pose: &Pose<Four>,
    arm: Vector<Four>,
    motions: &[FourMotions],
    parameters: &[Parameter],
    points: [PointRef; WIDTH],
    mut each: impl FnMut(usize, Vector<Four>, Vector<Four>),
) {
    let none = [Four::zero(); 3];
    let mut motion = motions.iter();
    for (column, parameter) in parameters.iter().enumerate() {
        let (shift, turn) = match parameter.subject {
            Subject::Effect(_) => match motion.next() {
                Some(m) => (add(m.shift_m, cross(m.turn_rad, arm)), m.turn_rad),
                None => (none, none),
            },
            Subject::Point { point, axis } => {
                let mut own = pose.rotation.axis(axis);
                for (lane, other) in points.iter().enumerate() {
                    if *other != PointRef::Named(point) {
                        for own in &mut own {
                            own.0[lane] = 0.0;
                        }
                    }
                }
                (own, none)
            }
            // nothing is touched where a position is measured
            Subject::Feature { .. } => (none, none),
        };
        let size = Four::constant(parameter.scale);
        each(column, scale(size, shift), scale(size, turn));
    }
}

/// Root mean square of the position error that is to be expected of the first measured point over
/// the joint limits, metres.
///
/// The parameters' covariance from the measurements (`loss` as they were weighted, standard
/// deviations of the rows as large as the residuals say), where values that the data do not tell
/// vary as those of other arms do: each has its typical size as a prior; and what the model misses
/// of the rows themselves beyond their noise. `None` where the measurements are touches only.
pub fn expected_error_m(
    problem: &Problem,
    estimate: &Estimate,
    loss: Loss,
    uncertainty: &Uncertainty,
) -> Option<f64> {
    let parameters = &problem.parameters;
    let factor = uncertainty.applied_factor * uncertainty.shared_factor;
    let mut information =
        Normal::of(problem, estimate, parameters, loss).matrix / (factor * factor).max(1e-12);
    for (i, parameter) in parameters.iter().enumerate() {
        let sigma = if parameter.rank >= FIRST_PHYSICAL {
            1.0
        } else {
            ANYWHERE
        };
        information[(i, i)] += (sigma * sigma).recip();
    }
    let covariance = information.cholesky()?.inverse();
    let like = problem
        .rows
        .iter()
        .find(|row| row.observed.point_m().is_some() || row.observed.count() == 1)
        .filter(|row| row.touched.is_none())?;
    let mut random = Random::new(1);
    let joints = &problem.profile.mechanism.joints;
    let track = &problem.profile.external.track;
    let axes = track.iter().map(|axis| (axis.min_m, axis.max_m));
    let mut elsewhere = problem.clone();
    let rows = (0..POSTURES)
        .map(|_| Row {
            q: std::array::from_fn(|i| random.between(joints[i].min_rad, joints[i].max_rad)),
            observed: super::measurements::Observed::Position([0.0; 3]),
            conditions: Conditions::default(),
            stand: Stand {
                values: axes
                    .clone()
                    .map(|(low, high)| random.between(low, high))
                    .collect(),
                directions: Vec::new(),
            },
            sigma_m: 1.0,
            ..like.clone()
        })
        .collect();
    elsewhere.rows = Arc::new(rows);
    elsewhere.sort_rigs(&estimate.effects);
    let models = elsewhere.models(estimate, parameters);
    let effects = parameters
        .iter()
        .filter(|p| matches!(p.subject, Subject::Effect(_)))
        .count();
    let mut motions = vec![Motion::default(); effects];
    let mut jacobian = DMatrix::zeros(3, parameters.len());
    let mut sum = 0.0;
    for row in elsewhere.rows.iter() {
        let pose = models[row.rig].evaluate(&row.q, &row.conditions, &mut motions);
        let seen = elsewhere.observe(estimate, row, pose);
        slopes(&seen, &motions, parameters, |column, slope| {
            jacobian.set_column(column, &DVector::from_column_slice(&slope[..3]));
        });
        sum += (&jacobian * &covariance * jacobian.transpose()).trace();
    }
    let mean = sum / POSTURES as f64 + lacking_m2(problem, uncertainty);
    Some(mean.sqrt())
}

/// Mean square of what the model misses of a measured place beyond the noise that is stated, where
/// that is beyond chance, m²; all that it misses where nothing states the noise and nothing of the
/// arm was fitted.
fn lacking_m2(problem: &Problem, uncertainty: &Uncertainty) -> f64 {
    let squared = uncertainty.sigma_factor.powi(2);
    let freedom = uncertainty.degrees_of_freedom.max(1) as f64;
    let of_arm = problem.parameters.iter();
    let of_arm = of_arm.filter(|p| p.rank >= FIRST_PHYSICAL).count();
    let noise = match (problem.sigma_assumed, of_arm) {
        (true, 0) => 0.0,
        (true, _) => return 0.0,
        (false, _) => 1.0,
    };
    let by_chance = ChiSquared::new(freedom).map_or(1.0, |chi| chi.sf(squared * freedom));
    if by_chance > BY_CHANCE && noise > 0.0 {
        return 0.0;
    }
    let sigmas = problem.rows.iter().map(|row| row.sigma_m.powi(2));
    let variance = sigmas.sum::<f64>() / problem.rows.len().max(1) as f64;
    3.0 * variance * (squared - noise).max(0.0)
}
