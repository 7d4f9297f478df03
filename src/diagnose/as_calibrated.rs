//! Whether an arm still errs as it did when it was calibrated; a few poses are enough.
//!
//! The mean square of the gaps of a coordinate, over that which the calibration left, is F where
//! nothing has changed. What a change must move these poses by to be seen is the noncentrality at
//! which F exceeds its limit with the power wanted.
//!
//! # Source
//! H. Scheffé, *The Analysis of Variance* (1959), 2.8 and appendix IV, for F and its power; the mean
//! square of rows that were not used is larger by one and the parameters over the numbers (H.
//! Akaike, "Fitting autoregressive models for prediction", 1969).

use super::chances::{f_power, f_quantile, f_tail};
use crate::geometry::units::m_from_mm;
use crate::identify::problem::{Estimate, Problem};
use crate::identify::statistics::misses;
use crate::identify::validation::{Refit, Validation};
use crate::model::profile::Profile;
use nalgebra::{DMatrix, DVector};

/// Probability that an arm as it was is measured again.
pub const SIGNIFICANCE: f64 = 0.01;
/// Probability with which a change that is called visible is seen.
pub const POWER: f64 = 0.9;
/// Step of derivatives, metres and radians.
const STEP: f64 = 1e-6;

/// The answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AsCalibrated {
    /// Whether the arm errs as it did.
    pub is_so: bool,
    /// Root mean square of the errors, metres.
    pub rms_m: f64,
    /// What is expected of an arm as it was, metres.
    pub expected_m: f64,
    /// Beyond this it is not, metres.
    pub limit_m: f64,
    /// Probability of such an error, or a larger one, of an arm as it was.
    pub p_value: f64,
    /// A change that moves these poses by so much (root mean square, metres) is seen with [`POWER`].
    pub sees_m: f64,
    /// A joint that stands off by so much, radians, likewise; `None` where these poses do not show
    /// it.
    pub sees_rad: [Option<f64>; 6],
}

/// What a calibration says of its own errors.
#[derive(Clone, Copy, Debug)]
struct Left {
    /// Variance of a coordinate, m².
    variance: f64,
    /// Its degrees of freedom.
    freedom: f64,
    /// By how much the mean square of other rows is larger.
    growth: f64,
}

/// From the block `quality` of a profile.
fn left(profile: &Profile) -> Option<Left> {
    let quality = profile.quality.as_ref()?;
    let (kind, coordinates) = match quality["after"]["position"] {
        serde_json::Value::Object(_) => ("position", 3.0),
        _ => ("range", 1.0),
    };
    let number = |key: &str| quality["after"][kind][key].as_f64();
    let (n, rms_m) = (number("n")?, m_from_mm(number("rms_mm")?));
    let freedom = quality["degrees_of_freedom"].as_f64()?;
    let numbers = freedom + quality["parameters"].as_array()?.len() as f64;
    // orientations count among the numbers, and not here
    let part = freedom / numbers;
    let found = Left {
        variance: rms_m * rms_m / coordinates / part,
        freedom: part * n * coordinates,
        growth: 2.0 - part,
    };
    (found.variance > 0.0 && found.freedom >= 1.0).then_some(found)
}

/// Gaps of the coordinates of positions and distances, metres.
fn gaps(problem: &Problem, estimate: &Estimate) -> Vec<f64> {
    let missed = misses(problem, estimate);
    let rows = problem.rows.iter().zip(&missed);
    let numbers = rows.flat_map(|(row, miss)| miss.gap[..row.observed.count().min(3)].iter());
    numbers.copied().collect()
}

/// How the gaps change with something, by central differences.
fn slope(
    problem: &Problem,
    estimate: &Estimate,
    change: impl Fn(&mut Problem, &mut Estimate, f64),
) -> DVector<f64> {
    let at = |step: f64| {
        let (mut problem, mut estimate) = (problem.clone(), estimate.clone());
        change(&mut problem, &mut estimate, step);
        DVector::from_vec(gaps(&problem, &estimate))
    };
    (at(STEP) - at(-STEP)) / (2.0 * STEP)
}

/// The noncentrality at which F exceeds `limit` with [`POWER`].
fn visible(limit: f64, a: f64, b: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while f_power(limit, a, b, high) < POWER && high < 1e6 {
        high *= 2.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f_power(limit, a, b, middle) < POWER {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Whether the rows judged are those of an arm as the profile's calibration left it; `None` where
/// the profile does not say how well that is, or too few numbers were measured.
#[must_use]
pub fn as_calibrated(profile: &Profile, found: &Validation) -> Option<AsCalibrated> {
    let left = left(profile)?;
    let (problem, estimate) = (&found.problem, &found.estimate);
    let gaps = gaps(problem, estimate);
    let fitted: Vec<DVector<f64>> = match found.refit {
        Refit::Judged => {
            let each = problem.parameters.iter();
            each.map(|p| {
                slope(problem, estimate, |_, e, step| {
                    *e.value_mut(p.subject) += step
                })
            })
            .collect()
        }
        Refit::No | Refit::Others => Vec::new(),
    };
    let numbers = gaps.len() as f64 - fitted.len() as f64;
    if numbers < 1.0 {
        return None;
    }
    let squares: f64 = gaps.iter().map(|g| g * g).sum();
    let variance = left.variance * left.growth;
    let ratio = squares / numbers / variance;
    let limit = f_quantile(1.0 - SIGNIFICANCE, numbers, left.freedom);
    let noncentrality = visible(limit, numbers, left.freedom) * variance;
    let rows = problem.rows.len() as f64;
    // what frames that were fitted take up is not seen
    let taken = (!fitted.is_empty()).then(|| {
        let svd = DMatrix::from_columns(&fitted).svd(true, false);
        let u = svd.u.expect("it was asked for");
        let most = svd.singular_values.max();
        let kept = (0..u.ncols()).filter(|k| svd.singular_values[*k] > 1e-9 * most);
        DMatrix::from_columns(&kept.map(|k| u.column(k).into_owned()).collect::<Vec<_>>())
    });
    let sees_rad = std::array::from_fn(|joint| {
        let whole = slope(problem, estimate, |p, _, step| {
            p.rows.iter_mut().for_each(|row| row.q[joint] += step);
        });
        let seen = match &taken {
            Some(u) => &whole - u * (u.transpose() * &whole),
            None => whole.clone(),
        };
        let is_seen = seen.norm() > 1e-3 * whole.norm();
        is_seen.then(|| noncentrality.sqrt() / seen.norm())
    });
    Some(AsCalibrated {
        is_so: ratio <= limit,
        rms_m: (squares / rows).sqrt(),
        expected_m: (variance * numbers / rows).sqrt(),
        limit_m: (limit * variance * numbers / rows).sqrt(),
        p_value: f_tail(ratio, numbers, left.freedom),
        sees_m: (noncentrality / rows).sqrt(),
        sees_rad,
    })
}
