//! Whether an arm still errs as it did when it was calibrated; a few poses are enough.
//!
//! Where nothing has changed the gaps `g` are normal with the covariance `σ²·S`: the variance that
//! the calibration left and, common to all rows, what its parameters are not known by. Then
//! `gᵀS⁻¹g / (n·σ²)` is F with `n` numbers and the freedom of `σ²`. Frames that are fitted to the
//! rows are parameters of which nothing is known. What a change must be to be seen is the
//! noncentrality at which F exceeds its limit with the power wanted.
//!
//! Of `k` rows of one configuration the gaps correlate by `ρ`: joints that repeat imperfectly move
//! them alike. The mean square of `n` such numbers spreads as that of `n·c` independent ones, `c =
//! k / ((1 + (k − 1)ρ)² + (k − 1)(1 − ρ)²)`, by the eigenvalues of their correlation; `ρ` is that of
//! the calibration's own rows, by its design effect `1 + (k − 1)ρ`, and one where it does not say.
//!
//! # Source
//! F. E. Satterthwaite, Biometrics Bulletin 2 (1946), for the degrees of freedom of a mean square of
//! numbers that correlate; L. Kish, *Survey Sampling* (1965), for the design effect.
//! H. Scheffé, *The Analysis of Variance* (1959), 2.8 and appendix IV, for F and its power; C. R.
//! Rao, *Linear Statistical Inference* (1973), 4a, for predicted rows; M. A. Woodbury (1950) for
//! `S⁻¹`.

use crate::diagnose::estimator::chances::{f_power, f_quantile, f_tail};
use crate::geometry::units::m_from_mm;
use crate::identify::parameters::Subject;
use crate::identify::problem::{Estimate, Problem};
use crate::identify::statistics::misses;
use crate::identify::validation::{Refit, Validation};
use crate::model::Slot;
use crate::profile::Profile;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use serde_json::Value;
use std::sync::Arc;

/// Probability that an arm as it was is measured again.
pub const SIGNIFICANCE: f64 = 0.01;
/// Probability with which a change that is called visible is seen.
pub const POWER: f64 = 0.9;
/// Step of derivatives, metres and radians.
const STEP: f64 = 1e-6;
/// A frame of which nothing is known lies within so much, metres and radians.
const UNKNOWN: f64 = 1.0;
/// Of a joint's effect a smaller part is not seen: frames that are fitted take it up.
const LEAST_SEEN: f64 = 1e-5;
/// Rows of one configuration say how alike they miss where there are so many of them.
const LEAST_TOGETHER: f64 = 1.2;
/// Of a variance, rounding.
const ROUNDED: f64 = 1e-6;

/// The answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AsCalibrated {
    /// Whether the arm errs as it did.
    pub is_so: bool,
    /// Root mean square of the errors, metres.
    pub rms_m: f64,
    /// Mean square of the errors over that which is expected of an arm as it was: one, about.
    pub ratio: f64,
    /// Beyond this it is not.
    pub limit: f64,
    /// Probability of such an error, or a larger one, of an arm as it was.
    pub p_value: f64,
    /// A change that moves these poses by so much (root mean square, metres) is seen with
    /// [`POWER`].
    pub sees_m: f64,
    /// A joint that stands off by so much, radians, likewise; `None` where these poses do not show
    /// it.
    pub sees_rad: [Option<f64>; 6],
}

/// What a calibration says of its own errors.
struct Quality<'a> {
    /// Variance of a coordinate, m².
    variance: f64,
    /// Its degrees of freedom.
    freedom: f64,
    /// The parameters identified.
    names: Vec<&'a str>,
    /// The lower triangle of their covariance, in the units of files.
    covariance: Vec<Vec<f64>>,
    /// How the rows of one configuration correlate.
    alike: f64,
    /// Rows of one configuration, their mean.
    together: f64,
}

/// How many independent numbers tell as much as one of so many that correlate by `alike`.
fn counting(together: f64, alike: f64) -> f64 {
    let others = (together - 1.0).max(0.0);
    let common = 1.0 + others * alike;
    (1.0 + others) / (common * common + others * (1.0 - alike).powi(2))
}

/// Why a profile and rows do not say whether the arm is as it was calibrated.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unsaid {
    /// The profile does not say how well its arm was calibrated.
    #[error("does not say how well its arm was calibrated")]
    NoQuality,
    /// A key of the block `quality` is missing, or is no such number.
    #[error("calibration.quality: {key} is missing, or not {wanted}")]
    Key {
        /// Which key.
        key: String,
        /// What it has to be.
        wanted: &'static str,
    },
    /// Too few numbers for the frames that are fitted to them.
    #[error("{rows} rows are too few for the frames that are fitted to them")]
    TooFew {
        /// How many.
        rows: usize,
    },
}

/// From the block `quality` of a profile.
fn quality_of(profile: &Profile) -> Result<Quality<'_>, Unsaid> {
    let quality = profile.quality.as_ref().ok_or(Unsaid::NoQuality)?;
    let wrong = |key: &str, wanted| Unsaid::Key {
        key: key.to_owned(),
        wanted,
    };
    let (kind, coordinates) = match quality["after"]["position"] {
        Value::Object(_) => ("position", 3.0),
        _ => ("range", 1.0),
    };
    let above_0 = |value: &Value, key: &str| {
        let number = value.as_f64().filter(|number| *number > 0.0);
        number.ok_or_else(|| wrong(key, "a number above 0"))
    };
    let of_errors = |key: &str| {
        let named = format!("after.{kind}.{key}");
        above_0(&quality["after"][kind][key], &named)
    };
    let (n, rms_m) = (of_errors("n")?, m_from_mm(of_errors("rms_mm")?));
    let freedom = above_0(&quality["degrees_of_freedom"], "degrees_of_freedom")?;
    let no_list = wrong("parameters", "a list with the key of each");
    let Some(parameters) = quality["parameters"].as_array() else {
        return Err(no_list);
    };
    let names = parameters.iter().map(|p| p["key"].as_str());
    let triangle = "covariance_lower_triangle";
    let rows = quality[triangle].as_array();
    let row = |row: &Value| row.as_array()?.iter().map(Value::as_f64).collect();
    // orientations count among the numbers, and not here
    let part = freedom / (freedom + parameters.len() as f64);
    // rows of one configuration, and how many times their common variance is that of each
    let together = quality["configurations"]
        .as_f64()
        .map(|all| n / all.max(1.0));
    let design = quality["shared_factor"]
        .as_f64()
        .map(|factor| factor * factor);
    let alike = together.zip(design).filter(|(k, _)| *k > LEAST_TOGETHER);
    let together = together.unwrap_or(1.0).max(1.0);
    let found = Quality {
        alike: alike.map_or(1.0, |(k, design)| {
            ((design - 1.0) / (k - 1.0)).clamp(0.0, 1.0)
        }),
        together,
        variance: rms_m * rms_m / coordinates / part,
        freedom: part * n * coordinates,
        names: names.collect::<Option<_>>().ok_or(no_list)?,
        covariance: (rows.and_then(|rows| rows.iter().map(row).collect()))
            .ok_or_else(|| wrong(triangle, "rows of numbers"))?,
    };
    if found.freedom < 1.0 {
        return Err(wrong(
            "degrees_of_freedom",
            "so large that the coordinates have one",
        ));
    }
    let is_whole = found.covariance.len() == found.names.len()
        && (found.covariance.iter().zip(1..)).all(|(row, width)| row.len() == width);
    if !is_whole || !found.is_covariance() {
        return Err(wrong(
            triangle,
            "a covariance of the parameters (positive semi-definite)",
        ));
    }
    Ok(found)
}

impl Quality<'_> {
    /// Whether the matrix is positive semi-definite, up to rounding.
    fn is_covariance(&self) -> bool {
        let sigma = |i: usize| self.covariance[i][i].max(f64::MIN_POSITIVE).sqrt();
        let count = self.names.len();
        let correlation = DMatrix::from_fn(count, count, |i, j| {
            let own = self.covariance[i.max(j)][i.min(j)] / sigma(i) / sigma(j);
            if i == j { own + ROUNDED } else { own }
        });
        correlation.cholesky().is_some()
    }

    /// The parameters that an estimate has, too, and their covariance, SI.
    fn of_estimate(&self, estimate: &Estimate) -> (Vec<Subject>, DMatrix<f64>) {
        let known: Vec<(usize, Subject, f64)> = (self.names.iter().enumerate())
            .filter_map(|(index, name)| {
                let (subject, unit) = parameter(estimate, name)?;
                Some((index, subject, unit))
            })
            .collect();
        let covariance = DMatrix::from_fn(known.len(), known.len(), |i, j| {
            let ((a, _, of_a), (b, _, of_b)) = (&known[i], &known[j]);
            self.covariance[*a.max(b)][*a.min(b)] * of_a * of_b
        });
        let subjects = known.iter().map(|(_, subject, _)| *subject);
        (subjects.collect(), covariance)
    }
}

/// Variance of a coordinate that a profile's calibration left, m², and its degrees of freedom; `None`
/// where it does not say.
pub(super) fn left_by_calibration(profile: &Profile) -> Option<(f64, f64)> {
    let quality = quality_of(profile).ok()?;
    Some((quality.variance, quality.freedom))
}

/// How well a profile's calibration knows the parameters of an estimate: which, and their
/// covariance, SI; `None` where it does not say.
pub(super) fn known_of(
    profile: &Profile,
    estimate: &Estimate,
) -> Option<(Vec<Subject>, DMatrix<f64>)> {
    let quality = quality_of(profile).ok()?;
    Some(quality.of_estimate(estimate))
}

/// Gaps of the coordinates of positions and distances, metres.
fn gaps(problem: &Problem, estimate: &Estimate) -> DVector<f64> {
    let missed = misses(problem, estimate);
    let rows = problem.rows.iter().zip(&missed);
    let numbers = rows.flat_map(|(row, miss)| miss.gap[..row.observed.count().min(3)].iter());
    DVector::from_vec(numbers.copied().collect())
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
        gaps(&problem, &estimate)
    };
    (at(STEP) - at(-STEP)) / (2.0 * STEP)
}

/// `S = 1 + B·Bᵀ`, by `B` and what its inverse needs.
struct Expected {
    factor: DMatrix<f64>,
    inner: Cholesky<f64, Dyn>,
}

impl Expected {
    fn of(found: &Validation, quality: &Quality) -> Option<Self> {
        let (problem, estimate) = (&found.problem, &found.estimate);
        let by = |subject| {
            slope(problem, estimate, |_, e, step| {
                *e.value_mut(subject) += step;
            })
        };
        let (known, covariance) = quality.of_estimate(estimate);
        let sigma = quality.variance.sqrt();
        let eigen = (covariance / quality.variance).symmetric_eigen();
        let roots = eigen.eigenvalues.map(|value| value.max(0.0).sqrt());
        let slopes: Vec<_> = known.into_iter().map(by).collect();
        let count = problem
            .rows
            .iter()
            .map(|row| row.observed.count().min(3))
            .sum();
        let mut factor = DMatrix::zeros(count, 0);
        if !slopes.is_empty() {
            let turned = eigen.eigenvectors * DMatrix::from_diagonal(&roots);
            factor = DMatrix::from_columns(&slopes) * turned;
        }
        if found.refit == Refit::Judged {
            for parameter in &problem.parameters {
                let column = by(parameter.subject) * (UNKNOWN / sigma);
                let last = factor.ncols();
                factor = factor.insert_column(last, 0.0);
                factor.column_mut(last).copy_from(&column);
            }
        }
        let inner = DMatrix::identity(factor.ncols(), factor.ncols()) + factor.tr_mul(&factor);
        let inner = inner.cholesky()?;
        Some(Self { factor, inner })
    }

    /// `vᵀS⁻¹v`.
    fn size(&self, v: &DVector<f64>) -> f64 {
        let across = self.factor.tr_mul(v);
        (v.norm_squared() - across.dot(&self.inner.solve(&across))).max(0.0)
    }

    /// The mean of `S⁻¹`'s diagonal.
    fn mean(&self) -> f64 {
        let (n, p) = self.factor.shape();
        (n as f64 - p as f64 + self.inner.inverse().trace()) / n as f64
    }
}

/// The value of a name such as `link_geometry link 2 alpha_deg`, and its unit.
fn parameter(estimate: &Estimate, name: &str) -> Option<(Subject, f64)> {
    let mut effects = estimate.effects.iter().enumerate();
    effects.find_map(|(effect, known)| {
        let key = name.strip_prefix(&known.label())?.strip_prefix(' ')?;
        let parameters = known.definition().parameters;
        let parameter = parameters.iter().position(|p| p.key == key)?;
        let unit = parameters[parameter].unit.in_si();
        Some((Subject::Effect(Slot { effect, parameter }), unit))
    })
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

/// Whether the rows judged are those of an arm as the profile's calibration left it.
///
/// # Errors
/// The profile does not say how well that is, or too few numbers were measured.
pub fn as_calibrated(profile: &Profile, found: &Validation) -> Result<AsCalibrated, Unsaid> {
    let quality = quality_of(profile)?;
    let (problem, estimate) = (&found.problem, &found.estimate);
    let gaps = gaps(problem, estimate);
    let too_few = Unsaid::TooFew {
        rows: problem.rows.len(),
    };
    let Some(expected) = Expected::of(found, &quality) else {
        return Err(too_few);
    };
    let fitted = match found.refit {
        Refit::Judged => problem.parameters.len(),
        Refit::No | Refit::Others => 0,
    };
    let numbers = gaps.len() as f64 - fitted as f64;
    if numbers < 1.0 {
        return Err(too_few);
    }
    let ratio = expected.size(&gaps) / numbers / quality.variance;
    let together = problem.rows.len() as f64 / problem.configurations().max(1) as f64;
    let part = counting(together, quality.alike);
    let independent = (numbers * part).max(1.0);
    let freedom = (quality.freedom * counting(quality.together, quality.alike)).max(1.0);
    let limit = f_quantile(1.0 - SIGNIFICANCE, independent, freedom);
    let noncentrality = visible(limit, independent, freedom) / part * quality.variance;
    let rows = problem.rows.len() as f64;
    let sees_rad = std::array::from_fn(|joint| {
        let whole = slope(problem, estimate, |p, _, step| {
            for row in Arc::make_mut(&mut p.rows) {
                row.q[joint] += step;
            }
        });
        let seen = expected.size(&whole);
        let is_seen = seen > LEAST_SEEN * whole.norm_squared();
        is_seen.then(|| (noncentrality / seen).sqrt())
    });
    Ok(AsCalibrated {
        is_so: ratio <= limit,
        rms_m: (gaps.norm_squared() / rows).sqrt(),
        ratio,
        limit,
        p_value: f_tail(ratio, independent, freedom),
        sees_m: (noncentrality / rows / expected.mean()).sqrt(),
        sees_rad,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::random::Random;
    use serde_json::json;

    #[test]
    fn numbers_that_correlate_count_as_fewer() {
        assert!((counting(1.0, 1.0) - 1.0).abs() < 1e-12);
        assert!((counting(3.0, 0.0) - 1.0).abs() < 1e-12);
        assert!((counting(3.0, 1.0) - 1.0 / 3.0).abs() < 1e-12);
        // the variance of the mean square of 30 groups of three is 2 / (90 c)
        for alike in [0.3, 0.8] {
            let mut random = Random::new(4);
            let (count, mut squares) = (20_000, 0.0);
            for _ in 0..count {
                let mut sum = 0.0;
                for _ in 0..30 {
                    let common = f64::sqrt(alike) * random.normal();
                    let own = || f64::sqrt(1.0 - alike);
                    sum += (0..3)
                        .map(|_| (common + own() * random.normal()).powi(2))
                        .sum::<f64>();
                }
                squares += (sum / 90.0 - 1.0_f64).powi(2);
            }
            let found = squares / f64::from(count);
            let expected = 2.0 / (90.0 * counting(3.0, alike));
            assert!(
                (found / expected - 1.0).abs() < 0.05,
                "{alike}: {found} {expected}"
            );
        }
    }

    #[test]
    fn a_block_that_does_not_say_how_well_names_its_key() {
        let text = include_str!("../../../../robots/abb_irb120_thesis.yaml");
        let mut profile = Profile::from_yaml(text).expect("a shipped profile");
        assert_eq!(quality_of(&profile).err(), Some(Unsaid::NoQuality));
        let keys = ["x_mm", "y_mm", "z_mm"].map(|key| json!({"key": format!("base_frame {key}")}));
        let whole = json!({
            "after": {"position": {"n": 20, "rms_mm": 0.1}},
            "degrees_of_freedom": 57,
            "parameters": keys,
            "covariance_lower_triangle": [[1.0], [0.9, 1.0], [0.9, 0.9, 1.0]],
        });
        profile.quality = Some(whole.clone());
        assert!(quality_of(&profile).is_ok());
        // the third goes with the first and against the second, which go together
        let odd = json!([[1.0], [0.9, 1.0], [0.9, -0.9, 1.0]]);
        for (pointer, value, key) in [
            (
                "/after/position/rms_mm",
                json!(0.0),
                "after.position.rms_mm",
            ),
            ("/degrees_of_freedom", json!(null), "degrees_of_freedom"),
            (
                "/covariance_lower_triangle",
                odd,
                "covariance_lower_triangle",
            ),
        ] {
            let mut changed = whole.clone();
            *changed.pointer_mut(pointer).expect("it is there") = value;
            profile.quality = Some(changed);
            let said = quality_of(&profile).err().map(|why| why.to_string());
            let said = said.unwrap_or_default();
            assert!(
                said.contains(&format!("quality: {key} is missing")),
                "{said}"
            );
        }
    }
}
