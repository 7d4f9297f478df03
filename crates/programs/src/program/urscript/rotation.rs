//! Poses as `p[x, y, z, rx, ry, rz]`: metres and a rotation vector.
//!
//! The vector's direction is the axis, its length the angle; lengths that differ by whole
//! revolutions are the same rotation, and so is the opposite direction with the complement of the
//! angle.

use super::syntax::unit;
use crate::geometry::{Pose, Quaternion, Vector, dot, norm, scale};
use std::f64::consts::TAU;

/// Below this angle, radians, a rotation has no direction of its own.
const NO_AXIS: f64 = 1e-12;

/// The pose of six numbers, angles in radians, or in degrees where the bit of the number is set.
pub(super) fn pose(numbers: [f64; 6], degrees: u8) -> Pose {
    let [x, y, z, ..] = numbers;
    let vector = std::array::from_fn(|k| numbers[3 + k] * unit(degrees, 3 + k));
    Pose::from_parts([x, y, z], Quaternion::from_vector(vector).normalized())
}

/// No rotation vector has a longer part, radians.
pub(super) const MOST_ANGLE: f64 = 2.0 * TAU;

/// A part of the rotation vector that is longer than any that is meant, in its own unit.
pub(super) fn endless(numbers: &[f64; 6], degrees: u8) -> Option<f64> {
    let mut parts = (3..6).filter(|at| numbers[*at].abs() * unit(degrees, *at) > MOST_ANGLE);
    parts.next().map(|at| numbers[at])
}

/// The six numbers of a pose, the vector as near as can be to that of the present numbers.
pub(super) fn numbers(pose: &Pose, present: [f64; 6], degrees: u8) -> [f64; 6] {
    let old = std::array::from_fn(|k| present[3 + k] * unit(degrees, 3 + k));
    let vector = nearest(pose.rotation.vector(), old);
    std::array::from_fn(|at| match at.checked_sub(3) {
        None => pose.translation[at],
        Some(k) => vector[k] / unit(degrees, at),
    })
}

/// The vector of the same rotation that is nearest to `old`.
fn nearest(vector: Vector, old: Vector) -> Vector {
    let angle = norm(vector);
    let axis = if angle > NO_AXIS {
        scale(angle.recip(), vector)
    } else {
        let length = norm(old);
        if length < 1.0 {
            return vector;
        }
        scale(length.recip(), old)
    };
    let turns = ((dot(axis, old) - angle) / TAU).round();
    scale(angle + turns * TAU, axis)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn far(a: Vector, b: Vector) -> f64 {
        (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn the_vector_keeps_its_branch() {
        for old in [
            [2.0, 2.0, 2.0],
            [-2.2, 2.3, 0.1],
            [0.0, 3.2, 0.0],
            [0.0, -3.2, 0.01],
            [0.1, 0.0, 6.2],
            [0.0, 0.0, TAU],
            [0.0, 0.0, 0.0],
            [1.0, 2.0, 9.0],
        ] {
            let numbers_of = [0.1, 0.2, 0.3, old[0], old[1], old[2]];
            let pose = pose(numbers_of, 0);
            let back = numbers(&pose, numbers_of, 0);
            assert!(
                far([back[3], back[4], back[5]], old) < 1e-9,
                "{old:?} {back:?}"
            );
            let turned = Pose {
                rotation: pose.rotation * crate::geometry::Rotation::about_x(1e-4),
                ..pose
            };
            let near = numbers(&turned, numbers_of, 0);
            let gap = super::pose(near, 0).separation(&turned);
            assert!(gap.angle_rad < 1e-12 && gap.distance_m < 1e-15);
            let length = norm(old);
            // next to a whole revolution the axis itself turns far
            if (length / TAU - (length / TAU).round()).abs() > 0.05 {
                assert!(
                    far([near[3], near[4], near[5]], old) < 2e-3,
                    "{old:?} {near:?}"
                );
            }
        }
    }

    #[test]
    fn degrees_are_the_same_rotation() {
        let a = pose([0.0, 0.0, 0.0, 0.0, 90.0, 0.0], 0b01_0000);
        let b = pose([0.0, 0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2, 0.0], 0);
        assert!(a.separation(&b).angle_rad < 1e-15);
        let numbers = numbers(&b, [0.0, 0.0, 0.0, 0.0, -270.0, 0.0], 0b11_1000);
        assert!((numbers[4] + 270.0).abs() < 1e-9);
    }
}
