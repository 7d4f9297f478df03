//! Frames from few touches: three points, 3-2-1, and registration of points and planes together.

mod contradicted;
mod datums;
mod planes;

pub use datums::{Datums, three_two_one};
pub use planes::weighted_points_and_planes;
pub use planes::{FeatureFit, Misfit, Part, TouchedPlane, points_and_planes};

use super::RegisterError;
use super::features::FeatureError;
use super::kabsch::Redundancy;
use super::uncertainty::PoseCovariance;
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Rotation, Vector, cross, dot, norm, scale, sub};
use nalgebra::{DMatrix, Matrix6};

/// A point nearer to a line than this part of the line's length does not say which way a frame
/// rotates about it.
const NEAR_LINE: f64 = 1e-3;

/// Why touches give no frame.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FrameError {
    /// A feature cannot be fitted.
    #[error("{datum}: {error}")]
    Feature {
        /// Which datum.
        datum: &'static str,
        /// Why.
        error: FeatureError,
    },
    /// A direction that is not determined.
    #[error("{what}: {found_mm:.6} mm off {of} (limit {limit_mm:.6} mm)")]
    NearLine {
        /// What was to give a direction.
        what: &'static str,
        /// Distance, mm.
        found_mm: f64,
        /// Of what.
        of: &'static str,
        /// The smallest that is accepted, mm.
        limit_mm: f64,
    },
    /// Too few touches on a datum.
    #[error("{datum} has {found} touches and needs {needed}")]
    TooFew {
        /// Which datum.
        datum: &'static str,
        /// How many there are.
        found: usize,
        /// How many it takes.
        needed: usize,
    },
    /// Touches on the side of a datum on which the part is not.
    #[error(
        "{} {} on the {} side of the {} datum, by up to {off_mm:.3} mm (limit {limit_mm:.3} mm): \
         the part lies on its {} side",
        touches_of(touches), if touches.len() == 1 { "lies" } else { "lie" },
        SIDES[*datum].1, NAMES[*datum], SIDES[*datum].0
    )]
    OtherSide {
        /// The datum, from 0.
        datum: usize,
        /// Datum and place in it of each touch, both from 0.
        touches: Vec<(usize, usize)>,
        /// How far the farthest is off, mm.
        off_mm: f64,
        /// The largest that is accepted, mm.
        limit_mm: f64,
    },
    /// Points and planes that leave a motion open.
    #[error(
        "points and planes leave a motion free: {motion} (smallest singular value {smallest:.1e} \
         of the largest)"
    )]
    Free {
        /// Which motion.
        motion: String,
        /// Ratio of singular values.
        smallest: f64,
    },
    /// Several motions that fit alike.
    #[error(
        "another pose fits as well: the part turned by {apart_deg:.2} deg (it leaves \
         {other_mm:.4} mm root mean square, the best {best_mm:.4} mm)"
    )]
    Ambiguous {
        /// Rotation between both, degrees.
        apart_deg: f64,
        /// What the other one leaves, mm.
        other_mm: f64,
        /// What the best one leaves, mm.
        best_mm: f64,
    },
    /// The points alone are at fault.
    #[error(transparent)]
    Points(#[from] RegisterError),
}

/// Datums of a part.
const NAMES: [&str; 3] = ["primary", "secondary", "tertiary"];
/// On which side of each the part lies in the frame that they make, and on which it does not.
const SIDES: [(&str, &str); 3] = [("-z", "+z"), ("+y", "-y"), ("+x", "-x")];

fn touches_of(touches: &[(usize, usize)]) -> String {
    let name = |(datum, touch): &(usize, usize)| format!("{} touch {}", NAMES[*datum], touch + 1);
    touches.iter().map(name).collect::<Vec<_>>().join(", ")
}

impl FrameError {
    /// The way out; empty where the message says it all.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Ambiguous { .. } => {
                "a plane's touches do not show its outer side: touch a point off the planes and \
                 off their lines of intersection, too"
            }
            Self::Points(error) => error.hint(),
            Self::OtherSide { .. } => {
                "look whether the touches have the right datum; of a part that is not convex there \
                 give all touches their outward normals nx,ny,nz"
            }
            _ => "",
        }
    }
}

fn unit(
    what: &'static str,
    of: &'static str,
    v: Vector,
    scale_m: f64,
) -> Result<Vector, FrameError> {
    let length = norm(v);
    let limit = NEAR_LINE * scale_m;
    if length.is_nan() || length <= limit {
        return Err(FrameError::NearLine {
            what,
            found_mm: mm_from_m(length),
            of,
            limit_mm: mm_from_m(limit),
        });
    }
    Ok(scale(1.0 / length, v))
}

fn from_axes(x: Vector, z: Vector, origin: Vector) -> Pose {
    let y = cross(z, x);
    Pose {
        rotation: Rotation(std::array::from_fn(|i| [x[i], y[i], z[i]])),
        translation: origin,
    }
}

/// The frame with its origin at the first point, x toward the second, and the third in the xy plane
/// with y > 0.
///
/// # Errors
/// If two points coincide or the third lies on the x axis.
pub fn three_points([origin, on_x, in_xy]: [Vector; 3]) -> Result<Pose, FrameError> {
    let along = sub(on_x, origin);
    let reach = norm(sub(in_xy, origin)).max(norm(along));
    let x = unit("the point on x", "the origin", along, reach)?;
    let to_third = sub(in_xy, origin);
    let across = sub(to_third, scale(dot(x, to_third), x));
    let y = unit("the point in the xy plane", "the x axis", across, reach)?;
    Ok(from_axes(x, cross(x, y), origin))
}

/// Step of derivatives, metres.
const STEP_M: f64 = 1e-6;

/// What the residuals of a construction come to, each over the deviation of its touch, by central
/// differences: a frame that is no least-squares fit of all of them, as 3-2-1, or short edges make
/// them larger than the noise.
///
/// With their covariance `C`, `tr C` in the mean, with `(tr C)²/tr C²` degrees of freedom.
///
/// # Errors
/// As `residuals_m`, which gives the residual of each input.
///
/// # Source
/// F. E. Satterthwaite, Biometrics Bulletin 2 (1946).
pub fn redundancy<E>(
    inputs_m: &[Vector],
    sigmas_m: &[f64],
    residuals_m: impl Fn(&[Vector]) -> Result<Vec<f64>, E>,
) -> Result<Redundancy, E> {
    let count = inputs_m.len();
    let mut jacobian = DMatrix::zeros(count, 3 * count);
    let mut moved = inputs_m.to_vec();
    for i in 0..count {
        for k in 0..3 {
            let mut at = |sign: f64| {
                moved[i][k] = inputs_m[i][k] + sign * STEP_M;
                residuals_m(&moved)
            };
            let (after, before) = (at(1.0)?, at(-1.0)?);
            moved[i][k] = inputs_m[i][k];
            for r in 0..count {
                let slope = (after[r] - before[r]) / (2.0 * STEP_M);
                jacobian[(r, 3 * i + k)] = slope * sigmas_m[i] / sigmas_m[r];
            }
        }
    }
    let covariance = &jacobian * jacobian.transpose();
    let mean = covariance.trace();
    Ok(Redundancy {
        mean,
        freedom: mean * mean / covariance.norm_squared().max(f64::MIN_POSITIVE),
    })
}

/// Carries the noise of touches through a construction by central differences.
///
/// `inputs_m` are the touched points, `sigmas_m` the standard deviation of each one's coordinates;
/// `construct` gives the frame.
///
/// # Errors
/// As `construct`.
pub fn propagate<E>(
    inputs_m: &[Vector],
    sigmas_m: &[f64],
    construct: impl Fn(&[Vector]) -> Result<Pose, E>,
) -> Result<PoseCovariance, E> {
    let centre = construct(inputs_m)?;
    let step = STEP_M;
    let mut jacobian = DMatrix::zeros(6, 3 * inputs_m.len());
    let mut moved = inputs_m.to_vec();
    for i in 0..inputs_m.len() {
        for k in 0..3 {
            let mut ends = [centre; 2];
            for (end, sign) in ends.iter_mut().zip([1.0, -1.0]) {
                moved[i][k] = inputs_m[i][k] + sign * step;
                *end = construct(&moved)?;
            }
            moved[i][k] = inputs_m[i][k];
            let turn = (ends[0].rotation * ends[1].rotation.transpose()).vector();
            let shift = sub(ends[0].translation, ends[1].translation);
            for r in 0..3 {
                jacobian[(r, 3 * i + k)] = turn[r] / (2.0 * step) * sigmas_m[i];
                jacobian[(3 + r, 3 * i + k)] = shift[r] / (2.0 * step) * sigmas_m[i];
            }
        }
    }
    let covariance = &jacobian * jacobian.transpose();
    let matrix = Matrix6::from_fn(|i, j| covariance[(i, j)]);
    Ok(PoseCovariance::new(centre.translation, &matrix))
}
