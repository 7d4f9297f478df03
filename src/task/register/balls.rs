//! Spheres and holes of which the surface was touched.

use super::Feature as TouchedFeature;
use super::matched::{Touched, warning};
use super::points::{Feature, Pair};
use crate::finding::Finding;
use crate::geometry::Vector;
use crate::geometry::units::mm_from_m;
use crate::register::features::{self, FeatureError, Round, noise_of};
use crate::task::Failure;

/// The centre of a sphere or a hole and the noise of its touches.
pub(super) fn round(
    pair: &Pair,
    probe_radius_m: f64,
    to_name: &str,
    findings: &mut Vec<Finding>,
) -> Result<(Touched, TouchedFeature), Failure> {
    let touches: Vec<Vector> = pair.to.iter().map(|row| row.point_m).collect();
    let id = &pair.from.id;
    let fail = |error: FeatureError| Failure::new(format!("{to_name}: {id}: {error}"));
    let is_sphere = pair.from.feature == Feature::Sphere;
    let (fit, parameters): (Round, usize) = if is_sphere {
        (features::sphere(&touches).map_err(fail)?, 4)
    } else {
        (features::circle(&touches).map_err(fail)?, 3)
    };
    // the ball stands outside a sphere and inside a hole
    let radius_m = if is_sphere {
        fit.radius_m - probe_radius_m
    } else {
        fit.radius_m + probe_radius_m
    };
    if radius_m <= 0.0 {
        let message = format!(
            "{to_name}: {id}: the centres of the ball lie on a radius of {:.4} mm; a ball of {:.4} \
             mm touches a sphere from outside, at more than its own radius",
            mm_from_m(fit.radius_m),
            mm_from_m(probe_radius_m)
        );
        let hint = "are the coordinates in mm, and is --probe-radius-mm the ball's radius?";
        return Err(Failure::with_hint(message, hint));
    }
    let noise = noise_of(&fit.residuals_m, parameters);
    if let Some(nominal) = pair.from.radius_m {
        let off = radius_m - nominal;
        let limit = noise.map_or(5e-5, |n| (5.0 * n * fit.radius_sigma).max(2e-5));
        if off.abs() > limit {
            let message = format!(
                "{id}: radius {:.4} mm instead of {:.4} mm (limit {:.4} mm)",
                mm_from_m(radius_m),
                mm_from_m(nominal),
                mm_from_m(limit)
            );
            findings.push(
                warning("feature-radius", to_name, message).hint("is the probe's radius right?"),
            );
        }
    }
    let feature = TouchedFeature {
        id: id.clone(),
        feature: if is_sphere { "sphere" } else { "hole" },
        touches: touches.len(),
        centre_mm: fit.centre_m.map(mm_from_m),
        radius_mm: mm_from_m(radius_m),
        noise_mm: noise.map(mm_from_m),
    };
    let (variance_m2, shape) = centre_noise(pair, &fit);
    let of_touch = (0..3).map(|k| fit.centre_covariance[k][k]).sum::<f64>() / 3.0;
    let touched = Touched {
        id: id.clone(),
        from_m: pair.from.point_m,
        to_m: fit.centre_m,
        variance_m2,
        weight: pair.from.weight.or(pair.to[0].weight),
        shape,
        of_touch,
    };
    Ok((touched, feature))
}

/// The mean variance of the three coordinates of a fitted centre, where the deviations of its
/// touches are known, and its covariance as a part of that.
fn centre_noise(pair: &Pair, fit: &Round) -> (Option<f64>, Option<[[f64; 3]; 3]>) {
    let squares = pair.to.iter().map(|row| row.sigma_m.map(|s| s * s));
    let sum: Option<f64> = squares.sum();
    let touch_m2 = sum.map(|sum| sum / pair.to.len() as f64);
    let of_from = pair.from.sigma_m.map(|s| s * s);
    let covariance: [[f64; 3]; 3] = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let from = of_from.filter(|_| i == j).unwrap_or(0.0);
            touch_m2.unwrap_or(1.0) * fit.centre_covariance[i][j] + from
        })
    });
    let mean = (0..3).map(|k| covariance[k][k]).sum::<f64>() / 3.0;
    let shape = (mean > 0.0).then(|| covariance.map(|row| row.map(|one| one / mean)));
    match (of_from, touch_m2) {
        // touches of unknown noise next to a stated one: no shape can be given
        (Some(of_from), None) => (Some(of_from), None),
        (None, None) => (None, shape),
        (_, Some(_)) => (Some(mean), shape),
    }
}
