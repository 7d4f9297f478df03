//! Axes 4, 5 and 6 meet in one point.

use super::{Arm, arm_rotation};
use crate::geometry::{AxisRotation, Pose, Scalar};

impl Arm {
    #[inline(always)]
    pub(super) fn solve_spherical<S: Scalar>(
        &self,
        target: &Pose<S>,
        [front, before, positive]: [S; 3],
        near: &[S; 6],
    ) -> ([AxisRotation<S>; 6], S) {
        let p = target.translation;
        let (first, r, beyond_1) = self.shoulder(p, front);
        let v = S::constant(self.e2) * p[2];
        let (second, third, beyond_2) = self.planar(r - S::constant(self.a2_m), v, before);
        // rotation of row 3 seen from the rotating frame: Rz(1) · Rx(α2) · Rz(2 ± 3) · Rx(α3)
        let s3 = S::constant(self.s3);
        let sum = second * third.signed(s3);
        let third_from_turning = arm_rotation(first, sum, S::constant(self.e2), s3).transpose();
        let n = self.link4_from_wrist.cast() * (third_from_turning * target.rotation);
        let m = &n.0;
        let (e5, e6) = (S::constant(self.e5), S::constant(self.e6));
        let side = positive * S::constant(self.wrist_sign);
        let length = (m[0][2] * m[0][2] + m[1][2] * m[1][2]).sqrt();
        let fifth = AxisRotation {
            sine: side * length,
            cosine: -(e5 * e6) * m[2][2],
        };
        let scale = side * e6 / length.max(S::constant(f64::MIN_POSITIVE));
        let fourth = AxisRotation {
            sine: scale * m[1][2],
            cosine: scale * m[0][2],
        };
        let fourth = self.unless_aligned(length, fourth, 3, near);
        // Rz(−4) · n = M · Rz(6): the first row of M, which has the cosine of row 5, and the last,
        // which has its sine
        let AxisRotation {
            sine: s4,
            cosine: c4,
        } = fourth;
        let AxisRotation {
            sine: s5,
            cosine: c5,
        } = fifth;
        let sixth = AxisRotation {
            sine: -(c5 * (c4 * m[0][1] + s4 * m[1][1]) + e5 * s5 * m[2][1]),
            cosine: c5 * (c4 * m[0][0] + s4 * m[1][0]) + e5 * s5 * m[2][0],
        };
        (
            [first, second, third, fourth, fifth, sixth],
            beyond_1 + beyond_2,
        )
    }
}
