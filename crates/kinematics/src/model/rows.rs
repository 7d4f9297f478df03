//! Rows of the chain from six axes that are given in any other way.

use super::geometry::{Link, Mechanism};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Rotation, Vector};
use std::f64::consts::{PI, TAU};

/// How far from what the rows can describe the first axis and the flange may be, metres or radians.
const TOLERANCE: f64 = 1e-9;
/// Consecutive nominal axes with a smaller sine between them count as parallel.
const PARALLEL_SINE: f64 = 0.1;
/// Differences from the nominal rows that no arm of this type has.
const LARGEST_MM: f64 = 20.0;
const LARGEST_DEG: f64 = 5.0;

/// Six axes: `base_from_flange = steps[0] · Rz(q1) · steps[1] · Rz(q2) · … · steps[5] · Rz(q6) ·
/// last`.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    /// What stands before each joint.
    pub steps: [Pose; 6],
    /// From the last joint to the flange.
    pub last: Pose,
}

/// Why axes are no rows.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RowsError {
    /// The first axis does not cross the x axis of the base.
    #[error("axis 1 passes {distance_mm:.6} mm from the x axis of the base")]
    FirstAxis {
        /// By how much.
        distance_mm: f64,
    },
    /// The flange is not where the nominal one is, but for a rotation about and a shift along axis
    /// 6.
    #[error(
        "the flange is tilted {angle_deg:.6} deg and moved {distance_mm:.6} mm away from axis 6"
    )]
    Flange {
        /// Tilt.
        angle_deg: f64,
        /// Shift across the axis.
        distance_mm: f64,
    },
    /// Nothing of this arm.
    #[error(
        "{key} of row {row} differs by {found:.3} {unit} from the nominal one, more than {limit} \
         {unit}"
    )]
    TooDifferent {
        /// Which number.
        key: &'static str,
        /// Of which row, from 1.
        row: usize,
        /// The difference.
        found: f64,
        /// Its unit.
        unit: &'static str,
        /// The largest that is believed.
        limit: f64,
    },
    /// A joint that the nominal chain counts backwards or together with another.
    #[error("joint {joint} of the nominal chain is turned over or coupled; these axes are not")]
    Sense {
        /// The joint, from 1.
        joint: usize,
    },
}

impl Axes {
    /// `base_from_flange` at these angles.
    #[must_use]
    pub fn forward(&self, q: &[f64; 6]) -> Pose {
        let mut pose = Pose::identity();
        for (step, angle) in self.steps.iter().zip(q) {
            pose = pose * *step * about_z(*angle);
        }
        pose * self.last
    }

    /// The rows of a chain with the same axes and flange, near the nominal rows; exact for all
    /// joint angles.
    ///
    /// The frame of a row may turn about its own axis and slide along it; the row before takes that
    /// up in its θ and d. So the frames that the steps start from do not matter, only the lines
    /// of the axes. A row whose axis is nearly perpendicular to the one before has its x on
    /// their common normal, and β = 0. Where two axes are nearly parallel that normal may lie
    /// hundreds of metres away, at a place that says nothing; there the d before stays the nominal
    /// one, and β takes its place (Hayati).
    ///
    /// # Errors
    /// Where axis 1 or the flange cannot be described so, or where the axes are those of another
    /// arm.
    ///
    /// # Source
    /// J. J. Craig, "Introduction to robotics" (the rows); S. Hayati, M. Mirmirani, "Improving the
    /// absolute positioning accuracy of robot manipulators", J. Robotic Systems 2 (1985) (β).
    pub fn rows(
        &self,
        nominal: &[Link; 6],
        mechanism: &Mechanism,
        link6_from_flange: &Pose,
    ) -> Result<[Link; 6], RowsError> {
        let turned = |i: usize| mechanism.joints[i].sign < 0.0;
        let coupled = |i: usize| mechanism.coupling.iter().any(|c| c.joint == i);
        if let Some(joint) = (0..6).find(|&i| turned(i) || coupled(i)) {
            return Err(RowsError::Sense { joint: joint + 1 });
        }
        let mut links = *nominal;
        // axis 1: there is no row before it that could take up a turn or a shift
        let (mut at, offset) = crossing(&self.steps[0], 0.0);
        if offset.abs() > TOLERANCE {
            return Err(RowsError::FirstAxis {
                distance_mm: mm_from_m(offset),
            });
        }
        take(&mut links[0], &at);
        // the given frame of the present axis, seen from the row's frame before its θ: a rotation
        // about z and a shift along it
        let mut row_from_given = at.pose().inverse() * self.steps[0];
        for i in 1..6 {
            let axis = row_from_given * self.steps[i];
            let (theta, d) = if nominal[i].alpha_rad.sin().abs() < PARALLEL_SINE {
                parallel(&axis, nominal[i - 1].d_m, nominal[i].a_m)
            } else {
                common_normal(&axis, nominal[i].alpha_rad)
            };
            let seen = (about_z(theta) * Pose::from_translation(0.0, 0.0, d)).inverse() * axis;
            (at, _) = crossing(&seen, 0.0);
            row_from_given = at.pose().inverse() * seen;
            set_turn(&mut links[i - 1], mechanism, i - 1, theta, d);
            take(&mut links[i], &at);
        }
        let rest = row_from_given * self.last * link6_from_flange.inverse();
        let ([x, y, d], tilt) = (rest.translation, rest.rotation.axis(2));
        let angle = tilt[0].hypot(tilt[1]).atan2(tilt[2]);
        let distance = x.hypot(y);
        if angle > TOLERANCE || distance > TOLERANCE {
            return Err(RowsError::Flange {
                angle_deg: angle / DEG,
                distance_mm: mm_from_m(distance),
            });
        }
        let forward = rest.rotation.axis(0);
        set_turn(&mut links[5], mechanism, 5, forward[1].atan2(forward[0]), d);
        compare(&links, nominal)?;
        Ok(links)
    }
}

fn about_z(angle: f64) -> Pose {
    Pose::from_rotation(Rotation::about_z(angle))
}

/// `Rot(x, α) · Trans(a, 0, 0) · Rot(y, β)`
struct Crossing {
    alpha: f64,
    a: f64,
    beta: f64,
}

impl Crossing {
    fn pose(&self) -> Pose {
        Pose::from_rotation(Rotation::about_x(self.alpha))
            * Pose::from_translation(self.a, 0.0, 0.0)
            * Pose::from_rotation(Rotation::about_y(self.beta))
    }
}

/// The crossing whose z axis has the direction of this frame's, and how far from the x axis the
/// line passes at height z.
fn crossing(axis: &Pose, z: f64) -> (Crossing, f64) {
    let [x, y, along] = axis.rotation.axis(2);
    let (point, beta) = if along.abs() > PARALLEL_SINE {
        (at_height(axis, z), x.clamp(-1.0, 1.0).asin())
    } else {
        // the line lies across, on the common normal: its point nearest to the x axis
        let p = axis.translation;
        let by = -(p[1] * y + p[2] * along) / (y * y + along * along);
        ([p[0] + by * x, p[1] + by * y, p[2] + by * along], 0.0)
    };
    let crossing = Crossing {
        alpha: (-y).atan2(along),
        a: point[0],
        beta,
    };
    (crossing, point[1].hypot(point[2] - z))
}

/// The point of a frame's z axis at this height.
fn at_height(axis: &Pose, z: f64) -> Vector {
    let (p, u) = (axis.translation, axis.rotation.axis(2));
    let by = (z - p[2]) / u[2];
    [p[0] + by * u[0], p[1] + by * u[1], z]
}

/// θ and d before an axis that is nearly parallel: to the point at the nominal height.
fn parallel(axis: &Pose, nominal_d: f64, nominal_a: f64) -> (f64, f64) {
    let [x, y, _] = at_height(axis, nominal_d);
    let side = 1.0_f64.copysign(nominal_a);
    ((side * y).atan2(side * x), nominal_d)
}

/// θ and d before an axis that is not: to the common normal.
fn common_normal(axis: &Pose, nominal_alpha: f64) -> (f64, f64) {
    let (p, u) = (axis.translation, axis.rotation.axis(2));
    let side = 1.0_f64.copysign(nominal_alpha.sin());
    // z × u
    let theta = (side * u[0]).atan2(side * -u[1]);
    let across = u[0] * u[0] + u[1] * u[1];
    // where the line is nearest to the z axis
    let by = -(p[0] * u[0] + p[1] * u[1]) / across;
    (theta, p[2] + by * u[2])
}

fn take(link: &mut Link, at: &Crossing) {
    link.alpha_rad = near(at.alpha, link.alpha_rad);
    link.a_m = at.a;
    link.beta_rad = at.beta;
}

fn set_turn(link: &mut Link, mechanism: &Mechanism, joint: usize, theta: f64, d: f64) {
    link.theta_rad = near(theta - mechanism.joints[joint].offset_rad, link.theta_rad);
    link.d_m = d;
}

/// The angle by whole revolutions nearest to another.
fn near(angle: f64, to: f64) -> f64 {
    let gap = (angle - to + PI).rem_euclid(TAU) - PI;
    to + gap
}

/// Rows of the same type of arm differ by little.
fn compare(links: &[Link; 6], nominal: &[Link; 6]) -> Result<(), RowsError> {
    for (i, (link, nominal)) in links.iter().zip(nominal).enumerate() {
        for (key, by) in [
            ("alpha", link.alpha_rad - nominal.alpha_rad),
            ("beta", link.beta_rad - nominal.beta_rad),
            ("theta", link.theta_rad - nominal.theta_rad),
        ] {
            within(key, i, by / DEG, LARGEST_DEG, "deg")?;
        }
        for (key, by) in [("a", link.a_m - nominal.a_m), ("d", link.d_m - nominal.d_m)] {
            within(key, i, mm_from_m(by), LARGEST_MM, "mm")?;
        }
    }
    Ok(())
}

fn within(
    key: &'static str,
    index: usize,
    found: f64,
    limit: f64,
    unit: &'static str,
) -> Result<(), RowsError> {
    if found.abs() <= limit {
        return Ok(());
    }
    Err(RowsError::TooDifferent {
        key,
        row: index + 1,
        found,
        unit,
        limit,
    })
}
