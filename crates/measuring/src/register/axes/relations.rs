//! How measured axes stand to one another, compared with the drawing: it depends on no frame and no
//! tool.

use super::{Axis, Line, Sweep, nominal};
use crate::geometry::{Vector, add, cross, dot, norm, scale, sub};
use crate::profile::Profile;

/// Two axes, measured and nominal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relation {
    /// The joints, from 0.
    pub joints: [usize; 2],
    /// Angle between the axes: measured, nominal; radians.
    pub angle_rad: [f64; 2],
    /// Distance of the axes: measured, nominal; metres.
    pub distance_m: [f64; 2],
}

/// Below this sine of their angle, axes count as parallel.
const PARALLEL: f64 = 0.02;

fn angle_and_distance(a: &Line, b: &Line) -> (f64, f64) {
    let across = cross(a.direction, b.direction);
    let sine = norm(across);
    let angle = sine.atan2(dot(a.direction, b.direction));
    let between = sub(b.point_m, a.point_m);
    let distance = if sine > PARALLEL {
        dot(between, scale(1.0 / sine, across)).abs()
    } else {
        let along: Vector = scale(-dot(between, a.direction), a.direction);
        norm(add(between, along))
    };
    (angle, distance)
}

/// Each swept axis offset from the next swept one.
#[must_use]
pub fn relations(axes: &[Axis], sweeps: &[Sweep], profile: &Profile) -> Vec<Relation> {
    // an axis stands where the joints before it put it
    let drawn = |sweep: &Sweep| nominal(profile, &sweep.rows[0].q).0[sweep.joint];
    let pairs = axes.windows(2).zip(sweeps.windows(2));
    pairs
        .filter(|(_, sweeps)| {
            let [a, b] = [&sweeps[0].rows[0].q, &sweeps[1].rows[0].q];
            // the joints that carry both must stand alike
            (0..sweeps[0].joint).all(|k| (a[k] - b[k]).abs() < super::STILL_RAD)
        })
        .map(|(axes, sweeps)| {
            let measured = angle_and_distance(&axes[0].circle.line, &axes[1].circle.line);
            let nominal = angle_and_distance(&drawn(&sweeps[0]), &drawn(&sweeps[1]));
            Relation {
                joints: [axes[0].joint, axes[1].joint],
                angle_rad: [measured.0, nominal.0],
                distance_m: [measured.1, nominal.1],
            }
        })
        .collect()
}
