//! Which kind of closed form an arm has, from the numbers of its chain.

use super::{Arm, Wrist};
use crate::geometry::{AxisRotation, Pose, Rotation};
use crate::model::{Chain, Geometry, Link, Mechanism};

/// How far an angle or length of the chain may be from what the closed form needs, radians or
/// metres.
const TOLERANCE: f64 = 1e-9;
/// Below this sine of the angle between two axes of an offset wrist they count as parallel: the
/// joints about them cannot be distinguished.
const LEAST_SINE: f64 = 1e-3;

/// Which condition of the closed forms an arm does not meet.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Unsupported {
    /// An angle between axes.
    #[error(
        "no closed-form inverse: alpha of row {row} is {found_deg} deg where {needed} is needed"
    )]
    Alpha {
        /// Row, from 1.
        row: usize,
        /// Its α.
        found_deg: f64,
        /// What would do.
        needed: &'static str,
    },
    /// Neither a spherical wrist, nor one with axis 6 offset from axis 5, nor three parallel axes.
    #[error(
        "no closed-form inverse: alpha of row 4 is {alpha_4_deg} deg, so axes 2, 3 and 4 are not \
         parallel; and axes 4 \
         and 5 do not meet: {key} of row {row} is {found_mm} mm where 0 is needed"
    )]
    Wrist {
        /// α of row 4.
        alpha_4_deg: f64,
        /// `a` or `d`.
        key: &'static str,
        /// Row, from 1.
        row: usize,
        /// The length that is in the way.
        found_mm: f64,
    },
    /// An offset that three parallel axes do not allow.
    #[error(
        "no closed-form inverse: axes 2, 3 and 4 are parallel, and a of row {row} is {found_mm} mm \
         where 0 is needed"
    )]
    ParallelOffset {
        /// Row, from 1.
        row: usize,
        /// The length that is in the way.
        found_mm: f64,
    },
    /// A link without length.
    #[error("no closed-form inverse: {link} has no length")]
    NoLength {
        /// Which link.
        link: &'static str,
    },
}

fn near(angle: f64, wanted: f64) -> bool {
    let turn = std::f64::consts::TAU;
    let gap = (angle - wanted).rem_euclid(turn);
    gap.min(turn - gap) < TOLERANCE
}

fn right_angle(row: usize, link: &Link) -> Result<f64, Unsupported> {
    let quarter = std::f64::consts::FRAC_PI_2;
    if near(link.alpha_rad, quarter) {
        Ok(1.0)
    } else if near(link.alpha_rad, -quarter) {
        Ok(-1.0)
    } else {
        Err(Unsupported::Alpha {
            row,
            found_deg: link.alpha_rad.to_degrees(),
            needed: "90 or -90",
        })
    }
}

fn straight_angle(link: &Link) -> Option<f64> {
    if near(link.alpha_rad, 0.0) {
        Some(1.0)
    } else if near(link.alpha_rad, std::f64::consts::PI) {
        Some(-1.0)
    } else {
        None
    }
}

/// What the last three rows are.
fn wrist(l: &[Link; 6]) -> Result<Wrist, Unsupported> {
    let is_there = |length: f64| length.abs() > TOLERANCE;
    let right_angles = right_angle(5, &l[4]).and_then(|_| right_angle(6, &l[5]));
    let parallel = straight_angle(&l[3]).is_some();
    if is_there(l[4].a_m) || (parallel && is_there(l[4].d_m)) {
        if parallel && right_angles.is_ok() && !is_there(l[5].a_m) {
            return Ok(Wrist::Parallel);
        }
    } else if right_angles.is_ok() && !is_there(l[4].d_m) && !is_there(l[5].a_m) {
        return Ok(Wrist::Spherical);
    }
    if is_there(l[4].a_m) {
        if parallel {
            right_angles?;
            return Err(Unsupported::ParallelOffset {
                row: 6,
                found_mm: 1e3 * l[5].a_m,
            });
        }
        return Err(Unsupported::Wrist {
            alpha_4_deg: l[3].alpha_rad.to_degrees(),
            key: "a",
            row: 5,
            found_mm: 1e3 * l[4].a_m,
        });
    }
    for (row, link) in [(5, &l[4]), (6, &l[5])] {
        if link.alpha_rad.sin().abs() < LEAST_SINE {
            return Err(Unsupported::Alpha {
                row,
                found_deg: link.alpha_rad.to_degrees(),
                needed: "another angle than 0 or 180",
            });
        }
    }
    Ok(Wrist::Offset)
}

/// Where the arm faces along x of the frame that axis 1 turned, and whether it stands along axis 1
/// or against it: the same arm has a chain of either sense.
///
/// Axis 2 stands in front of axis 1 and above the base. Where it stands on axis 1 the arm faces
/// along x of its base with joint 1 at zero, and where it stands at the base it is above along
/// axis 1.
fn facing(l: &[Link; 6], home_1_rad: f64) -> (f64, f64) {
    let sign = |length: f64| (length.abs() > TOLERANCE).then(|| length.signum());
    let turned = Rotation::about_x(l[0].alpha_rad) * Rotation::about_z(home_1_rad);
    let front = sign(l[1].a_m).or_else(|| sign((turned * [1.0, 0.0, 0.0])[0]));
    (front.unwrap_or(1.0), sign(l[0].d_m).unwrap_or(1.0))
}

impl Arm {
    /// Recognises the kind of arm.
    ///
    /// # Errors
    /// The first condition that fails.
    pub fn of(geometry: &Geometry, mechanism: &Mechanism) -> Result<Self, Unsupported> {
        let l = &geometry.links;
        let e2 = right_angle(2, &l[1])?;
        let s3 = straight_angle(&l[2]).ok_or(Unsupported::Alpha {
            row: 3,
            found_deg: l[2].alpha_rad.to_degrees(),
            needed: "0 or 180",
        })?;
        let (sine_4, cosine_4) = l[3].alpha_rad.sin_cos();
        let parallel = straight_angle(&l[3]);
        let wrist = wrist(l)?;
        // axis 4 stands on the arm's plane where axes 2, 3 and 4 are parallel
        let (forearm, along_4) = match (wrist, parallel) {
            (Wrist::Parallel, Some(s4)) => ([l[3].a_m, 0.0], s4),
            _ => ([l[3].a_m, -sine_4 * l[3].d_m], cosine_4),
        };
        let lateral = l[1].d_m + s3 * (l[2].d_m + along_4 * l[3].d_m);
        let forearm_m = forearm[0].hypot(forearm[1]);
        for (link, length) in [
            ("the upper arm (a of row 3)", l[2].a_m),
            ("the forearm (a and d of row 4)", forearm_m),
        ] {
            if length.abs() < TOLERANCE {
                return Err(Unsupported::NoLength { link });
            }
        }
        let home: [f64; 6] =
            std::array::from_fn(|i| l[i].theta_rad + mechanism.joints[i].offset_rad);
        let sign = std::array::from_fn(|i| mechanism.joints[i].sign);
        let (front, up) = facing(l, home[0]);
        let base_from_turning = Pose {
            rotation: Rotation::about_x(l[0].alpha_rad),
            translation: Rotation::about_x(l[0].alpha_rad) * [0.0, 0.0, l[0].d_m],
        };
        let base_from_turning = Pose::from_translation(l[0].a_m, 0.0, 0.0) * base_from_turning;
        let link6_from_tool = geometry.link6_from_flange * geometry.flange_from_tool;
        let alpha_6 = AxisRotation::of(l[5].alpha_rad);
        let back = Pose::from_translation(0.0, 0.0, -l[5].d_m);
        Ok(Self {
            wrist,
            mechanism: mechanism.clone(),
            chain: Chain::of(geometry, mechanism),
            home: home.map(AxisRotation::of),
            sign,
            turning_from_world: (geometry.world_from_base * base_from_turning).inverse(),
            tool_from_link6: link6_from_tool.inverse() * back,
            e2,
            e5: right_angle(5, &l[4]).unwrap_or(0.0),
            e6: right_angle(6, &l[5]).unwrap_or(0.0),
            s3,
            s4: parallel.unwrap_or(0.0),
            link4_from_wrist: Rotation::about_x(-l[3].alpha_rad),
            lateral_m: -e2 * lateral,
            a2_m: l[1].a_m,
            a3_m: l[2].a_m,
            forearm_m,
            forearm: AxisRotation::toward(forearm[1], forearm[0]),
            a5_m: l[4].a_m,
            d5_m: l[4].d_m,
            alpha_4: AxisRotation::of(l[3].alpha_rad),
            alpha_5: AxisRotation::of(l[4].alpha_rad),
            alpha_6,
            meeting_in_last_m: [
                -l[5].a_m,
                -l[4].d_m * alpha_6.sine,
                -l[4].d_m * alpha_6.cosine,
            ],
            front_sign: front,
            elbow_sign: -front * up * e2 * s3 * l[2].a_m.signum(),
            wrist_sign: sign[4]
                * if home[4].cos() < -TOLERANCE {
                    -1.0
                } else {
                    1.0
                },
        })
    }
}
