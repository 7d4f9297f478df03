//! Axes 4 and 5 meet, and axis 6 passes either of them at a distance: most cobots with one motor
//! offset from the next, and many arc welding arms.
//!
//! With joint 6 given, the point where axes 4 and 5 meet and the direction of axis 5 are known, and
//! the arm in front of that point is the shoulder and the planar pair of the other kinds: four
//! branches, in front of or behind axis 1 with either elbow. One equation remains in one
//! unknown a branch, that axis 4 stands at its angle to axis 5:
//!
//! ```text
//! f(q6) = z4(q1, q2, q3) · z5(q6) − cos α5 = 0
//! ```
//!
//! # Source
//! Derived here. The general 6R arm has up to sixteen solutions (M. Raghavan, B. Roth, "Inverse
//! kinematics of the general 6R manipulator and related linkages", 1993), and so have these.
//! Searching one joint for the roots of what the others leave is that of A. Elias, J. Wen, "IK-Geo"
//! (arXiv 2211.05737).

mod all;

pub(super) use all::ArmSigns;

use super::{Arm, Margins, Wrist, arm_rotation};
use crate::geometry::units::{DEG, MM};
use crate::geometry::{AxisRotation, Jet, Pose, Rotation, Scalar, Vector, add, scale};

/// What the equation may miss zero by: the error of the orientation, radians.
const MISSED_RAD: f64 = 1e-12;
/// The same for an enclosure, over which the equation's rounding grows.
const ENCLOSED_RAD: f64 = 1e-10;
/// Steps of Newton's method from a posture nearby; three are usual.
const MOST_STEPS: u32 = 12;
/// A step of joint 6 is cut to this, radians: a longer one passes over the next root.
const LONGEST_RAD: f64 = 0.25;
/// Below this, radians, a step of joint 6 changes nothing any more.
const SETTLED_RAD: f64 = 1e-13;
/// Farther than this from the borders of the branches an arm with axis 6 offset from axis 5 alone
/// has one solution mostly, by a search over all angles of joint 6 of 1500 random postures of the
/// Motoman MA1400 (two of the 1061 that lie so far away had another).
const ONE_SOLUTION: Margins = Margins {
    wrist_rad: 10.0 * DEG,
    elbow_rad: 10.0 * DEG,
    shoulder_m: 100.0 * MM,
};

/// What rotates as joint 6 does, with the tool held: the point where axes 4 and 5 meet and the
/// direction of axis 5, in the frame that axis 1 turns. Each is `fixed + cosine · across + sine ·
/// along`.
#[derive(Clone, Copy, Debug)]
struct Circle<S> {
    point: [Vector<S>; 3],
    axis_5: [Vector<S>; 3],
}

/// [`Circle`] at one angle of joint 6, or its slope there.
#[derive(Clone, Copy, Debug)]
struct Meeting<S> {
    point: Vector<S>,
    axis_5: Vector<S>,
}

impl<S: Scalar> Circle<S> {
    /// `in_last` is a vector of the last row's frame before joint 6 turned it.
    #[inline(always)]
    fn spun(target: &Rotation<S>, in_last: Vector) -> [Vector<S>; 3] {
        let column = |j: usize| {
            let [x, y, z] = &target.0;
            [x[j], y[j], z[j]]
        };
        let [x, y, z] = in_last.map(S::constant);
        [
            scale(z, column(2)),
            add(scale(x, column(0)), scale(y, column(1))),
            add(scale(y, column(0)), scale(-x, column(1))),
        ]
    }

    #[inline(always)]
    fn at(&self, sixth: AxisRotation<S>) -> Meeting<S> {
        let of = |[fixed, across, along]: &[Vector<S>; 3]| {
            let mut sum = *fixed;
            for i in 0..3 {
                sum[i] += sixth.cosine * across[i] + sixth.sine * along[i];
            }
            sum
        };
        Meeting {
            point: of(&self.point),
            axis_5: of(&self.axis_5),
        }
    }

    #[inline(always)]
    fn slope(&self, sixth: AxisRotation<S>) -> Meeting<S> {
        let of = |[_, across, along]: &[Vector<S>; 3]| {
            let mut sum = [S::zero(); 3];
            for i in 0..3 {
                sum[i] = sixth.cosine * along[i] - sixth.sine * across[i];
            }
            sum
        };
        Meeting {
            point: of(&self.point),
            axis_5: of(&self.axis_5),
        }
    }
}

/// The arm in front of the meeting point on one of the four branches, and what the equation leaves.
#[derive(Clone, Copy, Debug)]
struct Reached<S> {
    first: AxisRotation<S>,
    second: AxisRotation<S>,
    third: AxisRotation<S>,
    /// Row 2 and, in its sense, row 3.
    sum: AxisRotation<S>,
    elbow: AxisRotation<S>,
    /// In the arm's plane: of the meeting point from axis 1, from axis 2, and above it.
    r: S,
    u: S,
    v: S,
    beyond: S,
    /// `z4 · z5 − cos α5`.
    value: S,
}

impl Arm {
    #[inline(always)]
    fn circle<S: Scalar>(&self, target: &Pose<S>) -> Circle<S> {
        let mut point = Circle::spun(&target.rotation, self.meeting_in_last_m);
        point[0] = add(target.translation, point[0]);
        let axis_5 = [0.0, self.alpha_6.sine, self.alpha_6.cosine];
        Circle {
            point,
            axis_5: Circle::spun(&target.rotation, axis_5),
        }
    }

    #[inline(always)]
    fn reached<S: Scalar>(&self, meeting: &Meeting<S>, front: S, before: S) -> Reached<S> {
        let k = S::constant;
        let (first, r, beyond_1) = self.shoulder(meeting.point, front);
        let (u, v) = (r - k(self.a2_m), k(self.e2) * meeting.point[2]);
        let (second, third, beyond_2) = self.planar(u, v, before);
        let sum = second * third.signed(k(self.s3));
        let [radial, tangential, up] = axis_in_plane(meeting.axis_5, first);
        let (sine_4, cosine_4) = (
            k(self.s3 * self.alpha_4.sine),
            k(self.s3 * self.alpha_4.cosine),
        );
        let e2 = k(self.e2);
        let value = sine_4 * (sum.sine * radial - e2 * sum.cosine * up)
            - e2 * cosine_4 * tangential
            - k(self.alpha_5.cosine);
        Reached {
            first,
            second,
            third,
            sum,
            elbow: third * self.forearm.cast(),
            r,
            u,
            v,
            beyond: beyond_1 + beyond_2,
            value,
        }
    }

    /// How the equation changes with joint 6: each of the first joints follows the meeting point.
    #[inline(always)]
    fn slope<S: Scalar>(&self, here: &Reached<S>, at: &Meeting<S>, moved: &Meeting<S>) -> S {
        let k = S::constant;
        let ([x, y, _], [dx, dy, dz]) = (at.point, moved.point);
        let (dr, first) = self.shoulder_slope([x, y], [dx, dy], here.r);
        let (du, dv) = (dr, k(self.e2) * dz);
        let (fore, upper) = (k(self.forearm_m), k(self.a3_m));
        // the elbow from the law of cosines, row 2 from the direction of the meeting point less
        // that of the bent pair
        let elbow = -(here.u * du + here.v * dv) / (upper * fore * here.elbow.sine);
        let squared = here.u * here.u + here.v * here.v;
        let pair = elbow * fore * (upper * here.elbow.cosine + fore);
        let s3 = k(self.s3);
        let sum = (here.u * dv - here.v * du - s3 * pair) / squared + s3 * elbow;
        let [radial, tangential, up] = axis_in_plane(at.axis_5, here.first);
        let [mut d_radial, mut d_tangential, d_up] = axis_in_plane(moved.axis_5, here.first);
        d_radial += first * tangential;
        d_tangential -= first * radial;
        let e2 = k(self.e2);
        let (sine_4, cosine_4) = (
            k(self.s3 * self.alpha_4.sine),
            k(self.s3 * self.alpha_4.cosine),
        );
        let turned = here.sum.cosine * radial + e2 * here.sum.sine * up;
        sine_4 * (here.sum.sine * d_radial - e2 * here.sum.cosine * d_up + sum * turned)
            - e2 * cosine_4 * d_tangential
    }

    /// Slopes of the distance from axis 1 within the arm's plane and of row 1.
    #[inline(always)]
    fn shoulder_slope<S: Scalar>(&self, [x, y]: [S; 2], [dx, dy]: [S; 2], r: S) -> (S, S) {
        let dr = (x * dx + y * dy) / r;
        let first = (x * dy - y * dx + S::constant(self.lateral_m) * dr) / (x * x + y * y);
        (dr, first)
    }

    /// All rows with row 6 at a root of the equation.
    #[inline(always)]
    fn rows_at<S: Scalar>(
        &self,
        target: &Pose<S>,
        sixth: AxisRotation<S>,
        here: &Reached<S>,
    ) -> [AxisRotation<S>; 6] {
        let k = S::constant;
        let third_from_turning =
            arm_rotation(here.first, here.sum, k(self.e2), k(self.s3)).transpose();
        let n = self.link4_from_wrist.cast() * (third_from_turning * target.rotation);
        // axes of row 5 in the last frame: Rz(−6) · Rx(−α6)
        let (sine_6, cosine_6) = (k(self.alpha_6.sine), k(self.alpha_6.cosine));
        let AxisRotation { sine: s, cosine: c } = sixth;
        let x5 = [c, -s, S::zero()];
        let y5 = [cosine_6 * s, cosine_6 * c, -sine_6];
        let z5 = [sine_6 * s, sine_6 * c, cosine_6];
        let along = |row: usize, axis: Vector<S>| {
            let m = &n.0[row];
            m[0] * axis[0] + m[1] * axis[1] + m[2] * axis[2]
        };
        // Rz(4) · Rx(α5) · Rz(5)
        let side = k(self.alpha_5.sine.signum());
        let fourth = AxisRotation::toward(side * along(0, z5), -(side * along(1, z5)));
        let fifth = AxisRotation::toward(side * along(2, x5), side * along(2, y5));
        [here.first, here.second, here.third, fourth, fifth, sixth]
    }

    /// With joint 6 as Newton's method finds it from its angle in `near`, on one of the four
    /// branches.
    ///
    /// Which side joint 5 is on comes out of it; the third sign is not looked at.
    #[inline(always)]
    pub(super) fn solve_offset<S: Scalar>(
        &self,
        target: &Pose<S>,
        [front, before, _]: [S; 3],
        near: &[S; 6],
    ) -> ([AxisRotation<S>; 6], S) {
        let k = S::constant;
        let circle = self.circle(target);
        let mut sixth = self.row(5, AxisRotation::of(self.mechanism.commanded(near)[5]));
        let mut at = circle.at(sixth);
        let mut here = self.reached(&at, front, before);
        for _ in 0..MOST_STEPS {
            let slope = self.slope(&here, &at, &circle.slope(sixth));
            let step = (-(here.value / slope))
                .max(k(-LONGEST_RAD))
                .min(k(LONGEST_RAD));
            sixth = sixth * AxisRotation::of(step);
            at = circle.at(sixth);
            here = self.reached(&at, front, before);
            if step.abs().every_below(SETTLED_RAD) {
                break;
            }
        }
        let rows = self.rows_at(target, sixth, &here);
        let missed = (here.value.abs() - k(MISSED_RAD)).max(S::zero());
        (rows, here.beyond + missed)
    }

    /// The same over an interval, where `near` solves the middle of it.
    pub(super) fn enclose_offset(
        &self,
        target: &Pose<Jet>,
        half_width: f64,
        near: &[f64; 6],
    ) -> ([AxisRotation<Jet>; 6], Jet) {
        // a track may have left the branch that it began on
        let [front, before, _] = self.posture(near).0.signs().map(Jet::constant);
        let given = self.row(5, AxisRotation::of(self.mechanism.commanded(near)[5]));
        let middle = Pose {
            rotation: Rotation(target.rotation.0.map(|row| row.map(|x| x.value.middle))),
            translation: target.translation.map(|x| x.value.middle),
        };
        let circle = self.circle(&middle);
        let at = circle.at(given);
        let here = self.reached(&at, front.value.middle, before.value.middle);
        // Newton's map with the slope of the middle: what it leaves of a step is small throughout a
        // short interval
        let inverse = Jet::constant(self.slope(&here, &at, &circle.slope(given)).recip());
        let turned = |fifth: Jet| given.cast() * AxisRotation::of(fifth);
        let back = |target: &Pose<Jet>, fifth: Jet| {
            let meeting = self.circle(target).at(turned(fifth));
            fifth - self.reached(&meeting, front, before).value * inverse
        };
        let resting = Pose {
            rotation: Rotation(target.rotation.0.map(|row| row.map(Jet::at_rest))),
            translation: target.translation.map(Jet::at_rest),
        };
        let fifth = Jet::implicit(
            half_width,
            ENCLOSED_RAD,
            |x| back(target, x),
            |x| back(&resting, x),
        );
        let sixth = turned(fifth);
        let here = self.reached(&self.circle(target).at(sixth), front, before);
        (self.rows_at(target, sixth, &here), here.beyond)
    }

    /// How far a posture of an arm with an offset wrist is from a fold, where two answers meet: the
    /// angle whose sine is the slope of the equation, radians, as joint 5's angle is that of a
    /// spherical wrist. `None` for other arms.
    ///
    /// Such an arm passes from one branch to the next without a fold, and folds within a branch.
    #[must_use]
    pub fn fold_rad(&self, q: &[f64; 6]) -> Option<f64> {
        if self.wrist != Wrist::Offset {
            return None;
        }
        let (branch, _) = self.posture(q);
        let [front, before, _] = branch.signs();
        let circle = self.circle(&self.last_row(&self.forward(q)));
        let sixth = self.row(5, AxisRotation::of(self.mechanism.commanded(q)[5]));
        let at = circle.at(sixth);
        let here = self.reached(&at, front, before);
        let slope = self.slope(&here, &at, &circle.slope(sixth));
        let sine = slope / (self.alpha_5.sine * self.alpha_6.sine);
        Some(sine.abs().min(1.0).asin())
    }

    /// Whether axis 6 passes axis 4 at a distance: [`Arm::is_only_posture`] knows of no posture that
    /// it is.
    #[must_use]
    pub fn passes_axis_4(&self) -> bool {
        self.wrist == Wrist::Offset && self.d5_m != 0.0
    }

    /// Whether a posture is the only one of its branch that reaches its pose, as far as can be
    /// known from how far it is from the branch's borders. Where axis 6 passes axis 4 at a
    /// distance that cannot be known: [`Arm::solve_all`] counts them.
    #[must_use]
    pub fn is_only_posture(&self, margins: &Margins) -> bool {
        self.wrist != Wrist::Offset
            || (self.d5_m == 0.0
                && margins.wrist_rad > ONE_SOLUTION.wrist_rad
                && margins.elbow_rad > ONE_SOLUTION.elbow_rad
                && margins.shoulder_m > ONE_SOLUTION.shoulder_m)
    }
}

/// A direction along the arm's plane, across it and upward, with the plane rotated by row 1.
#[inline(always)]
fn axis_in_plane<S: Scalar>([x, y, z]: Vector<S>, first: AxisRotation<S>) -> [S; 3] {
    [
        first.cosine * x + first.sine * y,
        first.cosine * y - first.sine * x,
        z,
    ]
}
