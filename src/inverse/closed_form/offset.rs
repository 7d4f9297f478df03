//! Axes 4 and 5 meet, and axis 6 passes axis 5 at a distance, as on many arc welding arms.
//!
//! Where axis 5 meets axis 4 is not known before joint 6 is: the point lies at the distance a6 from the tool's axis, in the
//! direction that joint 6 tells. With a guess of joint 6 the arm is one with a spherical wrist, whose closed form gives
//! joint 6 anew; what is sought is the angle that comes out as it went in, one equation with one unknown.
//!
//! # Source
//! Derived here. The general 6R arm has up to sixteen solutions (M. Raghavan, B. Roth, "Inverse kinematics of the general 6R
//! manipulator and related linkages", 1993); with an offset that is small beside the arm there is one on each of the eight
//! branches, except near their borders.

use super::{Arm, Margins, Wrist};
use crate::geometry::units::{DEG, MM};
use crate::geometry::{Jet, Pose, Rotation, Scalar, Turn, scale, sub};

/// What may be left of joint 6, radians: a few billionths of a millimetre.
const LEFT_RAD: f64 = 1e-10;
/// Farther than this from the borders of the branches there is one solution, by a search over all angles of joint 6 of 1500
/// random postures of the Motoman MA1400 (two of the 1061 that lie so far away had another).
const ONE_SOLUTION: Margins = Margins {
    wrist_rad: 10.0 * DEG,
    elbow_rad: 10.0 * DEG,
    shoulder_m: 100.0 * MM,
};

impl Arm {
    /// The rest of the arm with row 6 turned by `sixth`: what comes out of it for row 6 is another turn.
    #[inline(always)]
    fn with_sixth<S: Scalar>(
        &self,
        target: &Pose<S>,
        sixth: Turn<S>,
        signs: [S; 3],
        near: &[S; 6],
    ) -> ([Turn<S>; 6], S) {
        let across = target.rotation * [sixth.cosine, -sixth.sine, S::zero()];
        let meeting = Pose {
            rotation: target.rotation,
            translation: sub(target.translation, scale(S::constant(self.a6_m), across)),
        };
        self.solve_spherical(&meeting, signs, near)
    }

    /// With joint 6 as it settles from its angle in `near`.
    #[inline(always)]
    pub(super) fn solve_offset<S: Scalar>(
        &self,
        target: &Pose<S>,
        signs: [S; 3],
        near: &[S; 6],
    ) -> ([Turn<S>; 6], S) {
        let given = self.row(5, Turn::of(self.mechanism.commanded(near)[5]));
        let with = |beside: S| self.with_sixth(target, given * Turn::of(beside), signs, near);
        let (beside, left) = S::settled(|beside| (with(beside).0[5] * given.inverse()).angle());
        let (turns, beyond) = with(beside);
        (
            turns,
            beyond + (left - S::constant(LEFT_RAD)).max(S::zero()),
        )
    }

    /// The same over an interval, where `near` solves the middle of it.
    pub(super) fn enclose_offset(
        &self,
        target: &Pose<Jet>,
        half_width: f64,
        signs: [Jet; 3],
        near: &[Jet; 6],
    ) -> ([Turn<Jet>; 6], Jet) {
        let given = self.row(5, Turn::of(self.mechanism.commanded(near)[5]));
        let at = |target: &Pose<Jet>, beside: Jet| {
            self.with_sixth(target, given * Turn::of(beside), signs, near)
        };
        let back =
            |target: &Pose<Jet>, beside: Jet| (at(target, beside).0[5] * given.inverse()).angle();
        let resting = Pose {
            rotation: Rotation(target.rotation.0.map(|row| row.map(Jet::at_rest))),
            translation: target.translation.map(Jet::at_rest),
        };
        let beside = Jet::implicit(
            half_width,
            LEFT_RAD,
            |x| back(target, x),
            |x| back(&resting, x),
        );
        at(target, beside)
    }

    /// Whether a posture is the only one of its branch that reaches its pose, as far as can be told from how far it is from
    /// the branch's borders.
    #[must_use]
    pub fn is_only_posture(&self, margins: &Margins) -> bool {
        self.wrist != Wrist::Offset
            || (margins.wrist_rad > ONE_SOLUTION.wrist_rad
                && margins.elbow_rad > ONE_SOLUTION.elbow_rad
                && margins.shoulder_m > ONE_SOLUTION.shoulder_m)
    }
}
