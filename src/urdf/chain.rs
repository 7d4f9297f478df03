//! Rows of modified Denavit–Hartenberg parameters from six axes.
//!
//! Frame i has its z axis on axis i. Its x axis is the common normal of axes i and i + 1, so
//! row i + 1 is the step along and about it, and row i's θ and d the step about and along axis i
//! from the common normal before. Parallel axes have many common normals: the one through the foot
//! of the last is taken. The base takes up where axis 1 is, the flange what is behind axis 6.

use super::{MOST_M, UrdfArm, UrdfError};
use crate::geometry::{Pose, Rotation, Vector, add, cross, dot, norm, scale, sub};
use crate::model::Link;

/// Sine of the angle between axes below which they are parallel, and distance below which they
/// meet, metres.
const PARALLEL: f64 = 1e-9;
const MEETING_M: f64 = 1e-9;

/// The rows, with what is before and behind them.
pub(super) struct Rows {
    /// The frame in which the rows begin, in the URDF's base link.
    pub base: Pose,
    pub links: [Link; 6],
    /// `link6_from_tip`.
    pub flange: Pose,
    /// The frame after each row at zero, in the URDF's base link; the base first.
    pub frames: [Pose; 7],
}

/// The common normal of two axes: its feet on them and its direction.
struct Normal {
    feet: [Vector; 2],
    direction: Vector,
}

fn frame(origin: Vector, x: Vector, z: Vector) -> Pose {
    let y = cross(z, x);
    let rows = std::array::from_fn(|i| [x[i], y[i], z[i]]);
    Pose {
        rotation: Rotation(rows),
        translation: origin,
    }
}

fn unit(v: Vector) -> Vector {
    scale(norm(v).recip(), v)
}

/// `v` without its part along a unit vector.
fn across(v: Vector, axis: Vector) -> Vector {
    sub(v, scale(dot(v, axis), axis))
}

/// Angle about `axis` from `a` to `b`, both unit and across it.
fn angle(axis: Vector, a: Vector, b: Vector) -> f64 {
    let found = dot(axis, cross(a, b)).atan2(dot(a, b));
    // the angles of drawings are whole
    let degrees = found.to_degrees();
    if (degrees - degrees.round()).abs() < 1e-10 {
        degrees.round().to_radians()
    } else {
        found
    }
}

/// Lengths below this are rounding.
fn length(found: f64) -> f64 {
    if found.abs() < 1e-13 { 0.0 } else { found }
}

fn normal(p: Vector, z: Vector, q: Vector, w: Vector, foot: Vector) -> Option<Normal> {
    let out = cross(z, w);
    let sine = norm(out);
    let between = sub(q, p);
    if sine < PARALLEL {
        let gap = across(sub(q, foot), z);
        let far = norm(gap);
        if far < MEETING_M {
            return None;
        }
        return Some(Normal {
            feet: [foot, add(foot, gap)],
            direction: scale(far.recip(), gap),
        });
    }
    let squared = sine * sine;
    // feet of the common perpendicular
    let s = dot(cross(between, w), out) / squared;
    let t = dot(cross(between, z), out) / squared;
    let feet = [add(p, scale(s, z)), add(q, scale(t, w))];
    let gap = sub(feet[1], feet[0]);
    let along = dot(gap, out) / sine;
    let side = if along < -MEETING_M { -1.0 } else { 1.0 };
    Some(Normal {
        feet,
        direction: scale(side / sine, out),
    })
}

/// Derives the rows.
pub(super) fn rows(arm: &UrdfArm) -> Result<Rows, UrdfError> {
    let joints = arm.frames();
    let points: [Vector; 6] = std::array::from_fn(|i| joints[i + 1].translation);
    let axes: [Vector; 6] =
        std::array::from_fn(|i| unit(joints[i + 1].rotation * arm.joints[i].axis));
    // the base: z on axis 1, as high as the base link, x as there where that is across
    let (z, p) = (axes[0], points[0]);
    let foot = sub(p, scale(dot(p, z), z));
    let wish = across([1.0, 0.0, 0.0], z);
    let x = if norm(wish) > 1e-6 {
        unit(wish)
    } else {
        unit(across([0.0, 1.0, 0.0], z))
    };
    let base = frame(foot, x, z);
    let zero = Link {
        alpha_rad: 0.0,
        a_m: 0.0,
        beta_rad: 0.0,
        theta_rad: 0.0,
        d_m: 0.0,
    };
    let mut links = [zero; 6];
    let mut frames = [base; 7];
    // where the last common normal met the present axis, and its direction
    let (mut arrived, mut from) = (foot, x);
    for i in 0..6 {
        let z = axes[i];
        let next = if i < 5 {
            let found = normal(points[i], z, points[i + 1], axes[i + 1], arrived);
            found.ok_or_else(|| UrdfError::SameAxis {
                first: arm.joints[i].name.clone(),
                second: arm.joints[i + 1].name.clone(),
            })?
        } else {
            // the last row goes as far as the tip, and turns its x axis that way where it can
            let tip = joints[6] * arm.last_from_tip;
            let on_axis = add(arrived, scale(dot(sub(tip.translation, arrived), z), z));
            let wish = across(tip.rotation.axis(0), z);
            let direction = if norm(wish) > 0.5 { unit(wish) } else { from };
            Normal {
                feet: [on_axis; 2],
                direction,
            }
        };
        let far_m = norm(sub(next.feet[0], points[i]));
        if i < 5 && far_m > MOST_M {
            return Err(UrdfError::FarNormal {
                first: arm.joints[i].name.clone(),
                second: arm.joints[i + 1].name.clone(),
                apart_rad: norm(cross(z, axes[i + 1])),
                far_m,
                limit_m: MOST_M,
            });
        }
        links[i].theta_rad = angle(z, from, next.direction);
        links[i].d_m = length(dot(sub(next.feet[0], arrived), z));
        frames[i + 1] = frame(next.feet[0], next.direction, z);
        if i < 5 {
            links[i + 1].alpha_rad = angle(next.direction, z, axes[i + 1]);
            links[i + 1].a_m = length(dot(sub(next.feet[1], next.feet[0]), next.direction));
        }
        (arrived, from) = (next.feet[1], next.direction);
    }
    let flange = frames[6].inverse() * joints[6] * arm.last_from_tip;
    Ok(Rows {
        base,
        links,
        flange,
        frames,
    })
}
