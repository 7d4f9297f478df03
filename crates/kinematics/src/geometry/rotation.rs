//! Rotations, named by their shape: each maker's angle names are translated in its own language
//! folder.

use super::{Scalar, Vector, constant, dot, norm};
use std::ops::Mul;

/// A rotation matrix, rows first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation<S = f64>(pub [[S; 3]; 3]);

/// A quaternion `[w, x, y, z]`, scalar first; the functions that need a unit length say so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternion(pub [f64; 4]);

impl<S: Scalar> Rotation<S> {
    /// The rotation that changes nothing.
    #[inline(always)]
    #[must_use]
    pub fn identity() -> Self {
        let (o, i) = (S::zero(), S::one());
        Self([[i, o, o], [o, i, o], [o, o, i]])
    }

    /// Rotation by `angle` radians about the x axis.
    #[inline(always)]
    #[must_use]
    pub fn about_x(angle: S) -> Self {
        let (s, c) = angle.sin_cos();
        let (o, i) = (S::zero(), S::one());
        Self([[i, o, o], [o, c, -s], [o, s, c]])
    }

    /// Rotation by `angle` radians about the y axis.
    #[inline(always)]
    #[must_use]
    pub fn about_y(angle: S) -> Self {
        let (s, c) = angle.sin_cos();
        let (o, i) = (S::zero(), S::one());
        Self([[c, o, s], [o, i, o], [-s, o, c]])
    }

    /// Rotation by `angle` radians about the z axis.
    #[inline(always)]
    #[must_use]
    pub fn about_z(angle: S) -> Self {
        let (s, c) = angle.sin_cos();
        let (o, i) = (S::zero(), S::one());
        Self([[c, -s, o], [s, c, o], [o, o, i]])
    }

    /// The rotation back.
    #[inline(always)]
    #[must_use]
    pub fn transpose(&self) -> Self {
        let m = &self.0;
        Self([
            [m[0][0], m[1][0], m[2][0]],
            [m[0][1], m[1][1], m[2][1]],
            [m[0][2], m[1][2], m[2][2]],
        ])
    }

    /// The `index`-th axis of the rotated frame, in the frame it is rotated from.
    #[inline(always)]
    #[must_use]
    pub fn axis(&self, index: usize) -> Vector<S> {
        [self.0[0][index], self.0[1][index], self.0[2][index]]
    }

    /// Half the antisymmetric part: axis times the sine of the angle.
    #[inline(always)]
    #[must_use]
    pub fn sine_axis(&self) -> Vector<S> {
        let m = &self.0;
        let half = S::constant(0.5);
        [
            half * (m[2][1] - m[1][2]),
            half * (m[0][2] - m[2][0]),
            half * (m[1][0] - m[0][1]),
        ]
    }

    /// Cosine of the rotation angle.
    #[inline(always)]
    #[must_use]
    pub fn cosine(&self) -> S {
        let m = &self.0;
        S::constant(0.5) * (m[0][0] + m[1][1] + m[2][2] - S::one())
    }

    /// Angle of the rotation in [0, π] radians.
    #[inline(always)]
    #[must_use]
    pub fn angle(&self) -> S {
        norm(self.sine_axis()).atan2(self.cosine())
    }
}

impl Rotation {
    /// The same rotation as constants of another scalar.
    #[inline(always)]
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Rotation<S> {
        let [a, b, c] = self.0;
        Rotation([constant(a), constant(b), constant(c)])
    }

    /// `Rz(a) · Ry(b) · Rx(c)`, radians: `[a, b, c]` (A B C of KRL, R P W of FANUC, Rz Ry Rx of
    /// INFORM).
    #[must_use]
    pub fn from_rzryrx([a, b, c]: [f64; 3]) -> Self {
        Self::about_z(a) * Self::about_y(b) * Self::about_x(c)
    }

    /// Yaw, pitch and roll, the angles of `Rz · Ry · Rx`; what yaw loses near pitch = ±90° roll
    /// takes up.
    pub fn yaw_pitch_roll(&self) -> [f64; 3] {
        let [yaw, pitch, _] = self.rzryrx(0.0);
        let behind = (Self::about_z(yaw) * Self::about_y(pitch)).transpose() * *self;
        let roll = behind.0[2][1].atan2(behind.0[1][1]);
        [yaw, pitch, roll].map(|angle| angle + 0.0)
    }

    /// The angles of [`Rotation::from_rzryrx`]; b in [−π/2, π/2]. Where b = ±π/2 only the sum or
    /// difference of a and c is determined, and c is the given one.
    #[must_use]
    pub fn rzryrx(&self, c_if_undetermined: f64) -> [f64; 3] {
        let m = &self.0;
        let cosine = m[0][0].hypot(m[1][0]);
        let b = (-m[2][0]).atan2(cosine);
        if cosine > 1e-12 {
            [m[1][0].atan2(m[0][0]), b, m[2][1].atan2(m[2][2])]
        } else {
            // m[0][1] = ∓sin(a ∓ c), m[1][1] = cos(a ∓ c)
            let turn = (-m[0][1]).atan2(m[1][1]);
            let a = if b > 0.0 {
                turn + c_if_undetermined
            } else {
                turn - c_if_undetermined
            };
            [wrap(a), b, c_if_undetermined]
        }
    }

    /// `Rx(a) · Ry(b) · Rz(c)` angles `[a, b, c]` in radians, b in [−π/2, π/2]; c is 0 where b =
    /// ±π/2.
    #[must_use]
    pub fn rxryrz(&self) -> [f64; 3] {
        // Rx(a)·Ry(b)·Rz(c) is the transpose of Rz(−c)·Ry(−b)·Rx(−a)
        let [c, b, a] = self.transpose().rzryrx(0.0);
        [-a, -b, -c]
    }

    /// `Rz(o) · Ry(a) · Rz(t)` angles `[o, a, t]` in radians, a in [0, π]; t is 0 where a = 0 or π.
    #[must_use]
    pub fn rzryrz(&self) -> [f64; 3] {
        let m = &self.0;
        let sine = m[0][2].hypot(m[1][2]);
        let a = sine.atan2(m[2][2]);
        if sine > 1e-12 {
            [m[1][2].atan2(m[0][2]), a, m[2][1].atan2(-m[2][0])]
        } else {
            [(-m[0][1]).atan2(m[1][1]), a, 0.0]
        }
    }

    /// Rotation about `vector` by its length in radians.
    #[must_use]
    pub fn from_vector(vector: Vector) -> Self {
        Quaternion::from_vector(vector).rotation()
    }

    /// Axis times angle, angle in [0, π].
    #[must_use]
    pub fn vector(&self) -> Vector {
        self.quaternion().vector()
    }

    /// The unit quaternion with non-negative scalar part.
    ///
    /// # Source
    /// S. W. Shepperd, "Quaternion from rotation matrix", J. Guidance and Control 1 (1978): divide
    /// by the largest part.
    #[must_use]
    pub fn quaternion(&self) -> Quaternion {
        let m = &self.0;
        let squares = [
            1.0 + m[0][0] + m[1][1] + m[2][2],
            1.0 + m[0][0] - m[1][1] - m[2][2],
            1.0 - m[0][0] + m[1][1] - m[2][2],
            1.0 - m[0][0] - m[1][1] + m[2][2],
        ];
        let largest = (0..4).fold(
            0,
            |best, i| if squares[i] > squares[best] { i } else { best },
        );
        let q = match largest {
            0 => [
                squares[0],
                m[2][1] - m[1][2],
                m[0][2] - m[2][0],
                m[1][0] - m[0][1],
            ],
            1 => [
                m[2][1] - m[1][2],
                squares[1],
                m[1][0] + m[0][1],
                m[0][2] + m[2][0],
            ],
            2 => [
                m[0][2] - m[2][0],
                m[1][0] + m[0][1],
                squares[2],
                m[2][1] + m[1][2],
            ],
            _ => [
                m[1][0] - m[0][1],
                m[0][2] + m[2][0],
                m[2][1] + m[1][2],
                squares[3],
            ],
        };
        let q = Quaternion(q).normalized();
        if q.0[0] < 0.0 { q.negated() } else { q }
    }
}

impl Quaternion {
    /// Length; 1 for a rotation.
    #[must_use]
    pub fn norm(&self) -> f64 {
        self.0.iter().map(|c| c * c).sum::<f64>().sqrt()
    }

    /// The same direction with length 1. A zero quaternion becomes not-a-number: check
    /// [`Quaternion::norm`] first.
    #[must_use]
    pub fn normalized(&self) -> Self {
        let length = self.norm();
        Self(self.0.map(|c| c / length))
    }

    /// The other sign: the same rotation.
    #[must_use]
    pub fn negated(&self) -> Self {
        Self(self.0.map(|c| -c))
    }

    /// This quaternion or its negative, whichever is nearer to `other`.
    #[must_use]
    pub fn nearest_to(&self, other: &Self) -> Self {
        let product: f64 = (0..4).map(|i| self.0[i] * other.0[i]).sum();
        if product < 0.0 { self.negated() } else { *self }
    }

    /// The rotation matrix of a unit quaternion.
    #[must_use]
    pub fn rotation(&self) -> Rotation {
        let [w, x, y, z] = self.0;
        Rotation([
            [
                1.0 - 2.0 * (y * y + z * z),
                2.0 * (x * y - w * z),
                2.0 * (x * z + w * y),
            ],
            [
                2.0 * (x * y + w * z),
                1.0 - 2.0 * (x * x + z * z),
                2.0 * (y * z - w * x),
            ],
            [
                2.0 * (x * z - w * y),
                2.0 * (y * z + w * x),
                1.0 - 2.0 * (x * x + y * y),
            ],
        ])
    }

    /// Rotation about `vector` by its length in radians.
    #[must_use]
    pub fn from_vector(vector: Vector) -> Self {
        let angle = norm(vector);
        // sin(angle/2)/angle, by its series where the quotient is undetermined
        let k = if angle < 1e-6 {
            0.5 - angle * angle / 48.0
        } else {
            (0.5 * angle).sin() / angle
        };
        Self([
            (0.5 * angle).cos(),
            k * vector[0],
            k * vector[1],
            k * vector[2],
        ])
    }

    /// Axis times angle of a unit quaternion, angle in [0, π].
    #[must_use]
    pub fn vector(&self) -> Vector {
        let q = if self.0[0] < 0.0 {
            self.negated().0
        } else {
            self.0
        };
        let sine = (q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
        let k = if sine < 1e-12 {
            2.0
        } else {
            2.0 * sine.atan2(q[0]) / sine
        };
        [k * q[1], k * q[2], k * q[3]]
    }
}

/// The angle in (−π, π] that differs from `angle` by whole revolutions.
#[must_use]
pub fn wrap(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    let wrapped = angle - turn * (angle / turn).round();
    if wrapped <= -std::f64::consts::PI {
        wrapped + turn
    } else {
        wrapped
    }
}

impl<S: Scalar> Mul for Rotation<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        let mut out = [[S::zero(); 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
            }
        }
        Self(out)
    }
}

impl<S: Scalar> Mul<Vector<S>> for Rotation<S> {
    type Output = Vector<S>;
    #[inline(always)]
    fn mul(self, v: Vector<S>) -> Vector<S> {
        [dot(self.0[0], v), dot(self.0[1], v), dot(self.0[2], v)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: f64 = 1e-14;

    fn far(a: &Rotation, b: &Rotation) -> f64 {
        (a.transpose() * *b).angle()
    }

    #[test]
    fn every_form_gives_the_same_rotation_back() {
        for k in 0..2000_i32 {
            let t = f64::from(k);
            let r = Rotation::from_rzryrx([wrap(1.7 * t), 1.5 * (0.37 * t).sin(), wrap(2.3 * t)]);
            assert!(far(&r, &Rotation::from_rzryrx(r.rzryrx(0.0))) < TOLERANCE);
            assert!(far(&r, &r.quaternion().rotation()) < TOLERANCE);
            assert!(far(&r, &Rotation::from_vector(r.vector())) < TOLERANCE);
            let [a, b, c] = r.rxryrz();
            assert!(
                far(
                    &r,
                    &(Rotation::about_x(a) * Rotation::about_y(b) * Rotation::about_z(c))
                ) < TOLERANCE
            );
        }
    }

    #[test]
    fn a_pole_keeps_the_rotation_and_the_chosen_angle() {
        for b in [1.0, -1.0] {
            let r = Rotation::from_rzryrx([0.3, b * std::f64::consts::FRAC_PI_2, -1.2]);
            let angles = r.rzryrx(0.7);
            assert!(
                (angles[2] - 0.7).abs() < TOLERANCE
                    && far(&r, &Rotation::from_rzryrx(angles)) < TOLERANCE
            );
        }
    }

    #[test]
    fn quaternions_agree_with_nalgebra() {
        let q = Quaternion([0.5, -0.1, 0.7, 0.2]).normalized();
        let peer =
            nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(0.5, -0.1, 0.7, 0.2));
        let matrix = peer.to_rotation_matrix();
        for i in 0..3 {
            for j in 0..3 {
                assert!((q.rotation().0[i][j] - matrix[(i, j)]).abs() < TOLERANCE);
            }
        }
        let axis = peer.scaled_axis();
        for i in 0..3 {
            assert!((q.vector()[i] - axis[i]).abs() < TOLERANCE);
        }
    }

    #[test]
    fn tiny_and_half_turn_vectors_survive() {
        for v in [
            [1e-9, -2e-9, 3e-10],
            [std::f64::consts::PI, 0.0, 0.0],
            [0.0, 0.0, 0.0],
        ] {
            let back = Rotation::from_vector(v).vector();
            assert!(
                (0..3).all(|i| (back[i] - v[i]).abs() < TOLERANCE),
                "{v:?} {back:?}"
            );
        }
    }
}
