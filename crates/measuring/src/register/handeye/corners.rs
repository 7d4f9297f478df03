//! The camera's pose refined by corners that the robot touched.

use super::refine::rms_m;
use crate::geometry::{Pose, Vector, sub};
use crate::register::RegisterError;
use crate::register::kabsch::{kabsch, noise_m};
use crate::register::uncertainty::PoseCovariance;

/// The refinement and whether it is to be trusted.
#[derive(Clone, Debug)]
pub struct Corners {
    /// `T_new = T_icp · T_init`, or `T_init` where it is not accepted.
    pub camera: Pose,
    /// `T_icp`, in the frame that the camera's pose maps into.
    pub correction: Pose,
    /// Whether left-out corners improve.
    pub accepted: bool,
    /// Root mean square distance of the corners with `T_init`, metres.
    pub before_m: f64,
    /// With `T_new` fitted to all, metres.
    pub after_m: f64,
    /// Of each corner with `T_new` fitted to the others, metres.
    pub left_out_m: f64,
    /// Covariance of `T_new` from the noise of the corners.
    pub covariance: PoseCovariance,
}

/// Fits `T_icp` to matched corners by Kabsch and accepts `T_icp · T_init` only if corners left out
/// of the fit come nearer.
///
/// `seen_m`: corners in the camera's frame; `touched_m`: the same in the frame that the camera's
/// pose maps into. Metres.
///
/// # Errors
/// As [`kabsch`]; at least four corners are needed, so that three remain when one is left out.
pub fn refine_by_corners(
    camera: &Pose,
    seen_m: &[Vector],
    touched_m: &[Vector],
) -> Result<Corners, RegisterError> {
    if seen_m.len() == touched_m.len() && seen_m.len() < 4 {
        return Err(RegisterError::TooFewToJudge {
            found: seen_m.len(),
            needed: 4,
        });
    }
    let placed: Vec<Vector> = seen_m.iter().map(|p| camera.transform(*p)).collect();
    let fit = kabsch(&placed, touched_m, None)?;
    let residuals = fit.residuals_m(&placed, touched_m);
    let before: Vec<Vector> = touched_m
        .iter()
        .zip(&placed)
        .map(|(q, p)| sub(*q, *p))
        .collect();
    let mut out = Vec::with_capacity(placed.len());
    for leave in 0..placed.len() {
        let weights: Vec<f64> = (0..placed.len())
            .map(|i| if i == leave { 0.0 } else { 1.0 })
            .collect();
        let others = kabsch(&placed, touched_m, Some(&weights))?;
        out.push(sub(
            touched_m[leave],
            others.to_from_from.transform(placed[leave]),
        ));
    }
    let (before_m, left_out_m) = (rms_m(&before), rms_m(&out));
    let accepted = left_out_m < before_m;
    Ok(Corners {
        camera: if accepted {
            fit.to_from_from * *camera
        } else {
            *camera
        },
        correction: fit.to_from_from,
        accepted,
        before_m,
        after_m: rms_m(&residuals),
        left_out_m,
        covariance: fit.covariance(&placed, None, noise_m(&residuals, None)),
    })
}
