//! Where the device's base stands, from three taught points and exact distances.

use super::HexapodError;
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Vector, norm, sub};
use crate::register::kabsch::{Fit, kabsch};

/// Taught distances may differ from the exact ones by so much, metres: more is a wrong point.
const LIMIT_M: f64 = 0.02;

/// The frame of the base balls in the robot's coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseFrame {
    /// `robot_from_base`: origin B1, x to B2, B3 in the xy plane with y > 0.
    pub robot_from_base: Pose,
    /// The residual of each taught point, metres.
    pub residual_m: [Vector; 3],
    /// Root mean square of it, metres.
    pub rms_m: f64,
}

/// Lays the triangle with the exact distances on the three taught points: in the plane through
/// them, with the least sum of squares. The robot's small errors of position average out, and the
/// distances stay exact.
///
/// # Errors
/// If the distances are no triangle, the points are in a line, or they contradict the distances.
///
/// # Source
/// Thesis, eqs. 4.1–4.12. Both triangles are plane, so the fit in space is the fit in that plane.
pub fn set_base_frame(taught_m: [Vector; 3], base_m: [f64; 3]) -> Result<BaseFrame, HexapodError> {
    let longest = (0..3).fold(0, |m, i| if base_m[i] > base_m[m] { i } else { m });
    let rest = base_m.iter().sum::<f64>() - base_m[longest];
    let triangle = |names: [&'static str; 3]| HexapodError::Triangle {
        which: "the base",
        longest: names[longest],
        found_mm: mm_from_m(base_m[longest]),
        limit_mm: mm_from_m(rest),
    };
    let names = ["b12", "b23", "b31"];
    if !base_m.iter().all(|b| b.is_finite() && *b > 0.0) || base_m[longest] >= rest {
        return Err(triangle(names));
    }
    for (k, name) in names.into_iter().enumerate() {
        let taught = norm(sub(taught_m[(k + 1) % 3], taught_m[k]));
        let gap = (taught - base_m[k]).abs();
        if gap.is_nan() || gap > LIMIT_M {
            return Err(HexapodError::Taught {
                name,
                taught_mm: mm_from_m(taught),
                exact_mm: mm_from_m(base_m[k]),
                limit_mm: mm_from_m(LIMIT_M),
            });
        }
    }
    let x = (base_m[0].powi(2) + base_m[2].powi(2) - base_m[1].powi(2)) / (2.0 * base_m[0]);
    let y = (base_m[2].powi(2) - x * x).max(0.0).sqrt();
    let exact = [[0.0; 3], [base_m[0], 0.0, 0.0], [x, y, 0.0]];
    // distances within the limit of a triangle make points in a line only where the triangle is one
    let fit: Fit = kabsch(&exact, &taught_m, None).map_err(|_| triangle(names))?;
    let left = fit.residuals_m(&exact, &taught_m);
    Ok(BaseFrame {
        robot_from_base: fit.to_from_from,
        rms_m: fit.rmsd_m(&exact, &taught_m, None),
        residual_m: [left[0], left[1], left[2]],
    })
}
