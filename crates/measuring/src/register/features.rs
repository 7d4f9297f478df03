//! Features from touches: planes, spheres, circles (holes), and what the probe's radius does to
//! them.

use super::kabsch::scatter;
use super::linear::svd;
use crate::geometry::units::mm_from_m;
use crate::geometry::{Vector, add, cross, dot, norm, scale, sub};
use nalgebra::{DMatrix, DVector};

/// Points in a plane or line whose extent across it is below this part of their length do not fix a
/// feature.
const FLAT: f64 = 1e-3;
/// Largest number of Gauss–Newton steps.
const STEPS: usize = 50;

/// Why touches give no feature.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FeatureError {
    /// Too few touches.
    #[error("{found} touches; a {shape} takes {needed}")]
    TooFew {
        /// What was to be fitted.
        shape: &'static str,
        /// How many there are.
        found: usize,
        /// How many it takes.
        needed: usize,
    },
    /// Touches that do not spread in enough directions.
    #[error(
        "the touches of the {shape} lie in a {lie}: they extend across it by {across:.1e} of their \
         length (limit {limit:.0e})"
    )]
    Flat {
        /// What was to be fitted.
        shape: &'static str,
        /// Where they lie.
        lie: &'static str,
        /// Extent across, as a part of the length.
        across: f64,
        /// The smallest that is accepted.
        limit: f64,
    },
    /// Touches that are not on such a shape.
    #[error(
        "the touches fit no {shape}: after {STEPS} steps the centre still moves by {step_mm:.3e} mm"
    )]
    NoFit {
        /// What was to be fitted.
        shape: &'static str,
        /// The last step, mm.
        step_mm: f64,
    },
}

/// A plane through touches.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// Centre of the touches, metres.
    pub centre_m: Vector,
    /// Unit normal; its sign is open.
    pub normal: Vector,
    /// Distance of each touch along the normal, metres.
    pub residuals_m: Vec<f64>,
}

/// A sphere, or a circle in space, through touches.
#[derive(Clone, Debug, PartialEq)]
pub struct Round {
    /// Centre, metres.
    pub centre_m: Vector,
    /// Radius through the centres of the probe's ball, metres.
    pub radius_m: f64,
    /// Axis of a circle (unit, sign open); zero for a sphere.
    pub axis: Vector,
    /// Distance of each touch from the surface or, in the plane, from the circle, metres.
    pub residuals_m: Vec<f64>,
    /// Distance of each touch from a circle's plane, metres; empty for a sphere.
    pub axial_m: Vec<f64>,
    /// Covariance of the centre's coordinates for touches of standard deviation one: times σ² it
    /// is in m².
    pub centre_covariance: [[f64; 3]; 3],
    /// Standard uncertainty of the radius for touches of standard deviation one.
    pub radius_sigma: f64,
}

/// Standard deviation of the residual of a fit of `parameters` numbers.
#[must_use]
pub fn noise_of(residuals_m: &[f64], parameters: usize) -> Option<f64> {
    let freedom = residuals_m
        .len()
        .checked_sub(parameters)
        .filter(|f| *f > 0)?;
    #[allow(clippy::cast_precision_loss)]
    Some((residuals_m.iter().map(|r| r * r).sum::<f64>() / freedom as f64).sqrt())
}

fn enough(shape: &'static str, found: usize, needed: usize) -> Result<(), FeatureError> {
    if found < needed {
        return Err(FeatureError::TooFew {
            shape,
            found,
            needed,
        });
    }
    Ok(())
}

/// Half-extents of points along their main directions and those directions, longest first.
pub(crate) fn extents(points: &[Vector]) -> (Vector, [(f64, Vector); 3]) {
    let (centre, scatter) = scatter(points, None);
    let eigen = scatter.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let of = |i: usize| {
        let axis = eigen.eigenvectors.column(i);
        let extent = eigen.eigenvalues[i].max(0.0).sqrt();
        (extent, [axis[0], axis[1], axis[2]])
    };
    (centre, order.map(of))
}

/// The plane with the least squared distances from the touches: normal along their least extent.
///
/// # Errors
/// Fewer than three touches, or all in a line.
pub fn plane(points: &[Vector]) -> Result<Plane, FeatureError> {
    enough("plane", points.len(), 3)?;
    let (centre_m, axes) = extents(points);
    let across = axes[1].0 / axes[0].0;
    if across.is_nan() || across < FLAT {
        return Err(FeatureError::Flat {
            shape: "plane",
            lie: "line",
            across,
            limit: FLAT,
        });
    }
    let normal = axes[2].1;
    let residuals_m = points
        .iter()
        .map(|p| dot(normal, sub(*p, centre_m)))
        .collect();
    Ok(Plane {
        centre_m,
        normal,
        residuals_m,
    })
}

/// The sphere with the least squared distances from the touches.
///
/// Start: linear least squares of `|p|² = 2 c·p + (r² − |c|²)`; then Gauss–Newton on `|p − c| − r`.
///
/// # Errors
/// Fewer than four touches, all in a plane, or no convergence.
pub fn sphere(points: &[Vector]) -> Result<Round, FeatureError> {
    enough("sphere", points.len(), 4)?;
    let (_, axes) = extents(points);
    let across = axes[2].0 / axes[0].0;
    if across.is_nan() || across < FLAT {
        return Err(FeatureError::Flat {
            shape: "sphere",
            lie: "plane",
            across,
            limit: FLAT,
        });
    }
    round("sphere", points)
}

/// The circle in space through touches: their plane, and in it the circle with the least squared
/// distances.
///
/// # Errors
/// Fewer than three touches, all in a line, or no convergence.
pub fn circle(points: &[Vector]) -> Result<Round, FeatureError> {
    enough("circle", points.len(), 3)?;
    let Plane {
        centre_m: middle,
        normal,
        residuals_m: axial_m,
    } = plane(points).map_err(|error| match error {
        FeatureError::Flat { across, limit, .. } => FeatureError::Flat {
            shape: "circle",
            lie: "line",
            across,
            limit,
        },
        other => other,
    })?;
    let x = extents(points).1[0].1;
    let y = cross(normal, x);
    let flat: Vec<[f64; 2]> = points
        .iter()
        .map(|p| sub(*p, middle))
        .map(|d| [dot(x, d), dot(y, d)])
        .collect();
    let fit = round_in("circle", &flat)?;
    let place = |c: &[f64]| add(scale(c[0], x), scale(c[1], y));
    let mut covariance = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            for (a, u) in [x, y].iter().enumerate() {
                for (b, v) in [x, y].iter().enumerate() {
                    covariance[i][j] += u[i] * fit.covariance[(a, b)] * v[j];
                }
            }
            #[allow(clippy::cast_precision_loss)]
            let axial = normal[i] * normal[j] / points.len() as f64;
            covariance[i][j] += axial;
        }
    }
    Ok(Round {
        centre_m: add(middle, place(&fit.centre)),
        radius_m: fit.radius,
        axis: normal,
        residuals_m: fit.residuals,
        axial_m,
        centre_covariance: covariance,
        radius_sigma: fit.covariance[(2, 2)].sqrt(),
    })
}

fn round(shape: &'static str, points: &[Vector]) -> Result<Round, FeatureError> {
    let fit = round_in(shape, points)?;
    Ok(Round {
        centre_m: [fit.centre[0], fit.centre[1], fit.centre[2]],
        radius_m: fit.radius,
        axis: [0.0; 3],
        residuals_m: fit.residuals,
        axial_m: Vec::new(),
        centre_covariance: std::array::from_fn(|i| std::array::from_fn(|j| fit.covariance[(i, j)])),
        radius_sigma: fit.covariance[(3, 3)].sqrt(),
    })
}

/// A circle (N = 2) or sphere (N = 3) in its own space.
struct RoundFit {
    centre: Vec<f64>,
    radius: f64,
    residuals: Vec<f64>,
    /// Of centre and radius for a unit standard deviation.
    covariance: DMatrix<f64>,
}

fn round_in<const N: usize>(
    shape: &'static str,
    points: &[[f64; N]],
) -> Result<RoundFit, FeatureError> {
    #[allow(clippy::cast_precision_loss)]
    let count = points.len() as f64;
    let middle: [f64; N] =
        std::array::from_fn(|k| points.iter().map(|p| p[k]).sum::<f64>() / count);
    let local: Vec<[f64; N]> = points
        .iter()
        .map(|p| std::array::from_fn(|k| p[k] - middle[k]))
        .collect();
    let size = local
        .iter()
        .flatten()
        .map(|v| v.abs())
        .fold(0.0_f64, f64::max);
    let rows = DMatrix::from_fn(points.len(), N + 1, |i, j| {
        if j < N { 2.0 * local[i][j] } else { size }
    });
    let squares = DVector::from_fn(points.len(), |i, _| {
        local[i].iter().map(|v| v * v).sum::<f64>()
    });
    let start = solve(&rows, &squares);
    let mut centre: Vec<f64> = start.rows(0, N).iter().copied().collect();
    let squared = start[N] * size + centre.iter().map(|v| v * v).sum::<f64>();
    let mut radius = squared.max(0.0).sqrt();
    let mut jacobian = DMatrix::zeros(points.len(), N + 1);
    let mut left = DVector::zeros(points.len());
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        for (i, p) in local.iter().enumerate() {
            let away: [f64; N] = std::array::from_fn(|k| p[k] - centre[k]);
            let distance = away.iter().map(|v| v * v).sum::<f64>().sqrt();
            for k in 0..N {
                jacobian[(i, k)] = -away[k] / distance.max(f64::MIN_POSITIVE);
            }
            jacobian[(i, N)] = -1.0;
            left[i] = distance - radius;
        }
        let step = solve(&jacobian, &-&left);
        for k in 0..N {
            centre[k] += step[k];
        }
        radius += step[N];
        last = step.norm();
        if last.is_nan() || last < 1e-12 * (size + radius) {
            break;
        }
    }
    let settled = last <= 1e-7 * (size + radius) && radius < 1e4 * size;
    if !settled {
        return Err(FeatureError::NoFit {
            shape,
            step_mm: mm_from_m(last),
        });
    }
    let information = jacobian.transpose() * &jacobian;
    let covariance = information.try_inverse().ok_or(FeatureError::NoFit {
        shape,
        step_mm: mm_from_m(last),
    })?;
    Ok(RoundFit {
        centre: (0..N).map(|k| middle[k] + centre[k]).collect(),
        radius,
        residuals: left.iter().copied().collect(),
        covariance,
    })
}

/// Least squares by singular values: directions that the data leave open stay at zero.
fn solve(rows: &DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let svd = svd(rows);
    let mut along = svd.left.transpose() * right;
    for (value, s) in along.iter_mut().zip(svd.values.iter()) {
        *value = if *s > 1e-13 * svd.values[0] {
            *value / s
        } else {
            0.0
        };
    }
    &svd.right * along
}

/// A touched surface point from the centre of the probe's ball, the ball's radius and the surface's
/// outward normal.
#[must_use]
pub fn compensated(ball_centre_m: Vector, probe_radius_m: f64, outward: Vector) -> Vector {
    let length = norm(outward);
    sub(ball_centre_m, scale(probe_radius_m / length, outward))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_sphere(centre: Vector, radius: f64) -> Vec<Vector> {
        let at = |i: u32| {
            let (a, b) = (0.7 * f64::from(i), 0.2 + 0.11 * f64::from(i));
            let d = [a.cos() * b.cos(), a.sin() * b.cos(), b.sin()];
            add(centre, scale(radius, d))
        };
        (0..9).map(at).collect()
    }

    #[test]
    fn a_sphere_far_from_the_origin_is_found_to_rounding() {
        let fit = sphere(&on_sphere([2.0, -3.0, 1.5], 0.0125)).expect("a sphere");
        assert!(norm(sub(fit.centre_m, [2.0, -3.0, 1.5])) < 1e-12);
        assert!((fit.radius_m - 0.0125).abs() < 1e-12);
    }

    #[test]
    fn flat_sets_are_refused_by_name() {
        let line: Vec<Vector> = (0..5).map(|i| [f64::from(i), 0.0, 1.0]).collect();
        assert!(matches!(plane(&line), Err(FeatureError::Flat { .. })));
        assert!(matches!(circle(&line), Err(FeatureError::Flat { .. })));
        let ring: Vec<Vector> = on_sphere([0.0; 3], 1.0)
            .iter()
            .map(|p| [p[0], p[1], 0.0])
            .collect();
        assert!(matches!(sphere(&ring), Err(FeatureError::Flat { .. })));
        assert!(matches!(
            sphere(&ring[..3]),
            Err(FeatureError::TooFew { .. })
        ));
    }
}
