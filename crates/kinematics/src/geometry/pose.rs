//! Rigid motions.

use super::{AxisRotation, Quaternion, Rotation, Scalar, Vector, add, constant, norm, scale, sub};
use std::ops::Mul;

/// A rigid motion `a_from_b`: rotation and translation (metres) that map coordinates in b to
/// coordinates in a.
///
/// It is not checked to be orthonormal; every constructor here makes it so to rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<S = f64> {
    /// The axes of b in a.
    pub rotation: Rotation<S>,
    /// The origin of b in a, metres.
    pub translation: Vector<S>,
}

/// How far apart two poses are.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Separation {
    /// Distance of the origins, metres.
    pub distance_m: f64,
    /// Angle of the rotation between them, radians, in [0, π].
    pub angle_rad: f64,
}

impl<S: Scalar> Pose<S> {
    /// The motion that changes nothing.
    #[inline(always)]
    #[must_use]
    pub fn identity() -> Self {
        Self::from_rotation(Rotation::identity())
    }

    /// A pure rotation.
    #[inline(always)]
    #[must_use]
    pub fn from_rotation(rotation: Rotation<S>) -> Self {
        Self {
            rotation,
            translation: [S::zero(); 3],
        }
    }

    /// A pure translation in metres.
    #[inline(always)]
    #[must_use]
    pub fn from_translation(x: S, y: S, z: S) -> Self {
        Self {
            rotation: Rotation::identity(),
            translation: [x, y, z],
        }
    }

    /// `Trans(x, y, z) · Rx · Ry · Rz`, metres and radians in that order: the pose of profile
    /// files.
    ///
    /// # Source
    /// A. Nubiola, thesis, eq. I.2.
    #[must_use]
    pub fn from_xyz_rxryrz(p: [S; 6]) -> Self {
        Self {
            rotation: Rotation::about_x(p[3]) * Rotation::about_y(p[4]) * Rotation::about_z(p[5]),
            translation: [p[0], p[1], p[2]],
        }
    }

    /// The motion back: `b_from_a`.
    #[inline(always)]
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self {
            rotation,
            translation: rotation * scale(-S::one(), self.translation),
        }
    }

    /// This motion after a rotation about the z axis of b: only two columns change.
    #[inline(always)]
    #[must_use]
    pub fn turned(&self, turn: AxisRotation<S>) -> Self {
        let AxisRotation { sine, cosine } = turn;
        let mut rotation = self.rotation;
        for [x, y, _] in &mut rotation.0 {
            (*x, *y) = (cosine * *x + sine * *y, cosine * *y - sine * *x);
        }
        Self {
            rotation,
            translation: self.translation,
        }
    }

    /// Maps a point of b to coordinates in a.
    #[inline(always)]
    #[must_use]
    pub fn transform(&self, point: Vector<S>) -> Vector<S> {
        add(self.rotation * point, self.translation)
    }
}

impl Pose {
    /// From a translation in metres and a unit quaternion `[w, x, y, z]`.
    #[must_use]
    pub fn from_parts(translation: Vector, quaternion: Quaternion) -> Self {
        Self {
            rotation: quaternion.rotation(),
            translation,
        }
    }

    /// The same pose as constants of another scalar.
    #[inline(always)]
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Pose<S> {
        Pose {
            rotation: self.rotation.cast(),
            translation: constant(self.translation),
        }
    }

    /// Whether all its numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let numbers = self.rotation.0.iter().flatten().chain(&self.translation);
        numbers.into_iter().all(|number| number.is_finite())
    }

    /// Distance of the origins and angle between the axes of two poses given in the same frame.
    #[inline]
    #[must_use]
    pub fn separation(&self, other: &Pose) -> Separation {
        Separation {
            distance_m: norm(sub(self.translation, other.translation)),
            angle_rad: (self.rotation.transpose() * other.rotation).angle(),
        }
    }

    /// Rotation angles and translation such that [`Pose::from_xyz_rxryrz`] gives this pose again.
    #[must_use]
    pub fn xyz_rxryrz(&self) -> [f64; 6] {
        let [rx, ry, rz] = self.rotation.rxryrz();
        let [x, y, z] = self.translation;
        [x, y, z, rx, ry, rz]
    }
}

impl<S: Scalar> Mul for Pose<S> {
    type Output = Pose<S>;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Pose {
            rotation: self.rotation * other.rotation,
            translation: self.transform(other.translation),
        }
    }
}

impl From<Pose> for nalgebra::Isometry3<f64> {
    fn from(pose: Pose) -> Self {
        let [w, x, y, z] = pose.rotation.quaternion().0;
        let rotation =
            nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z));
        Self::from_parts(pose.translation.into(), rotation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Pose {
        Pose::from_xyz_rxryrz([0.3, -1.2, 0.7, 0.4, -1.1, 2.9])
    }

    #[test]
    fn a_pose_times_its_inverse_changes_nothing() {
        let gap = (sample() * sample().inverse()).separation(&Pose::identity());
        assert!(gap.distance_m < 1e-15 && gap.angle_rad < 1e-15);
    }

    #[test]
    fn angles_and_translation_are_read_back() {
        let back = Pose::from_xyz_rxryrz(sample().xyz_rxryrz()).separation(&sample());
        assert!(back.distance_m < 1e-15 && back.angle_rad < 1e-14);
    }

    #[test]
    fn products_agree_with_nalgebra() {
        let other = Pose::from_xyz_rxryrz([-0.1, 0.2, 0.9, -2.0, 0.3, 0.5]);
        let mine: nalgebra::Isometry3<f64> = (sample() * other).into();
        let peer = nalgebra::Isometry3::from(sample()) * nalgebra::Isometry3::from(other);
        assert!((mine.to_homogeneous() - peer.to_homogeneous()).norm() < 1e-14);
    }
}
