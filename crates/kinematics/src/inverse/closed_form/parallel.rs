//! Axes 2, 3 and 4 are parallel.

use super::{Arm, arm_rotation};
use crate::geometry::{AxisRotation, Pose, Rotation, Scalar};

impl Arm {
    #[inline(always)]
    pub(super) fn solve_parallel<S: Scalar>(
        &self,
        target: &Pose<S>,
        [front, before, positive]: [S; 3],
        near: &[S; 6],
    ) -> ([AxisRotation<S>; 6], S) {
        let p = target.translation;
        let (first, r, beyond_1) = self.shoulder(p, front);
        let (e2, e5, e6) = (
            S::constant(self.e2),
            S::constant(self.e5),
            S::constant(self.e6),
        );
        let (s3, s34) = (S::constant(self.s3), S::constant(self.s3 * self.s4));
        // axis 4 in the last frame: (s5·e5·c6, −s5·e5·s6, −e5·e6·c5)
        let axis_4 = [s34 * e2 * first.sine, -(s34 * e2 * first.cosine), S::zero()];
        let m = target.rotation.transpose() * axis_4;
        let side = positive * S::constant(self.wrist_sign);
        let length = (m[0] * m[0] + m[1] * m[1]).sqrt();
        let fifth = AxisRotation {
            sine: side * length,
            cosine: -(e5 * e6) * m[2],
        };
        let scale = side * e5 / length.max(S::constant(f64::MIN_POSITIVE));
        let sixth = AxisRotation {
            sine: -(scale * m[1]),
            cosine: scale * m[0],
        };
        let sixth = self.unless_aligned(length, sixth, 5, near);
        let AxisRotation { sine, cosine } = fifth;
        let wrist = Pose::from_rotation(Rotation([
            [cosine, S::zero(), e6 * sine],
            [S::zero(), -(e5 * e6), S::zero()],
            [e5 * sine, S::zero(), -(e5 * e6) * cosine],
        ]))
        .turned(sixth)
        .rotation;
        let fourth_in_turning = target.rotation * wrist.transpose();
        // into the plane: Rx(−α2) · Rz(−1)
        let turned =
            arm_rotation(first, AxisRotation::none(), e2, S::one()).transpose() * fourth_in_turning;
        let k = &turned.0;
        let sum = AxisRotation::toward(k[1][0], k[0][0]);
        let (a5, d5) = (S::constant(self.a5_m), S::constant(self.d5_m));
        let end = turned * [a5, -(d5 * e5), S::zero()];
        let [u, v] = [r - S::constant(self.a2_m) - end[0], e2 * p[2] - end[1]];
        let (second, third, beyond_2) = self.planar(u, v, before);
        let fourth = (sum * (second * third.signed(s3)).inverse()).signed(s34);
        (
            [first, second, third, fourth, fifth, sixth],
            beyond_1 + beyond_2,
        )
    }
}
