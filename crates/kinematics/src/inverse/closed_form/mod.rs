//! The nominal inverse in closed form, from the numbers of the chain.
//!
//! All kinds of arm share the shoulder (axis 1 rotates the arm's plane) and the planar pair of
//! links; they differ in the wrist. Every step is written over [`Scalar`] without branches, so that
//! several targets are solved side by side.

#![allow(
    clippy::needless_range_loop,
    reason = "one index runs over several arrays"
)]

mod answers;
mod conditions;
mod offset;
mod parallel;
mod spherical;

pub use answers::Answer;
pub(super) use answers::is_close;
pub use conditions::Unsupported;

use super::branch::Branch;
use crate::geometry::units::{DEG, MM};
use crate::geometry::{AxisRotation, Jet, Pose, Rotation, Scalar, Vector, add};
use crate::model::{Chain, Mechanism};

/// Joint 5 of an arm with three parallel axes farther than this from alignment, radians, multiplies
/// an error of the orientation in joint 6 by seven at most.
const STEADY_WRIST_RAD: f64 = 0.15;
/// Below this sine of joint 5 the angles of the two joints next to it cannot be distinguished in
/// 64-bit numbers.
const WRIST_SINE: f64 = 1e-12;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wrist {
    /// Axes 4, 5 and 6 meet in one point.
    Spherical,
    /// Axes 4 and 5 meet; axis 6 passes axis 5 or axis 4 at a distance, or stands slanted on axis
    /// 5.
    Offset,
    /// Axes 2, 3 and 4 are parallel.
    Parallel,
}

/// An arm whose inverse has a closed form: (a) ortho-parallel base and spherical wrist, with
/// shoulder, lateral and elbow offsets; (b) the same with axis 6 offset from axis 4 or 5 and wrists
/// bent at any angles, closed but for the angle of joint 6; (c) three parallel axes.
///
/// # Source
/// Derived here from the rows of the chain. The conditions are those of M. Brandstötter, A.
/// Angerer, M. Hofbaur, "An analytical solution of the inverse kinematics problem of industrial
/// serial manipulators with an ortho-parallel basis and a spherical wrist" (2014), with the lateral
/// offsets of every row.
#[derive(Clone, Debug)]
pub struct Arm {
    wrist: Wrist,
    mechanism: Mechanism,
    chain: Chain,
    /// θ of each row plus the controller's offset.
    home: [AxisRotation; 6],
    sign: [f64; 6],
    /// From the world to the frame that axis 1 turns, and from the tool to the last row's frame
    /// without its d.
    turning_from_world: Pose,
    tool_from_link6: Pose,
    /// Sines of α2, α5, α6 and cosines of α3, α4: +1 or −1 where the kind of arm needs a right or
    /// a straight angle.
    e2: f64,
    e5: f64,
    e6: f64,
    s3: f64,
    s4: f64,
    link4_from_wrist: Rotation,
    /// Distance of the arm's plane from axis 1, along y of the frame that axis 1 turned.
    lateral_m: f64,
    a2_m: f64,
    a3_m: f64,
    /// The forearm in frame 3: its length and its direction.
    forearm_m: f64,
    forearm: AxisRotation,
    a5_m: f64,
    d5_m: f64,
    /// α4, α5 and α6, for the offset wrist.
    alpha_4: AxisRotation,
    alpha_5: AxisRotation,
    alpha_6: AxisRotation,
    /// Where axes 4 and 5 meet, in the last row's frame without its d and before joint 6 turns it.
    meeting_in_last_m: Vector,
    /// Sign that turns "in front of axis 1" into x of the frame that axis 1 turned.
    front_sign: f64,
    /// Sign that turns "in front of the lower arm" into the sine of the elbow.
    elbow_sign: f64,
    /// Sign that turns the controller's joint 5 into the sine of the chain's.
    wrist_sign: f64,
}

/// A solution on one branch.
#[derive(Clone, Copy, Debug)]
pub struct Solution<S = f64> {
    /// The controller's joint angles, radians.
    pub q: [S; 6],
    /// Zero where the pose is in reach; else how far it is beyond (squared cosine or relative
    /// lengths, not metres).
    pub beyond: S,
}

/// A solution by its sines and cosines.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rotated<S = f64> {
    /// Rotations of the mechanical joints in the controller's sense.
    pub turns: [AxisRotation<S>; 6],
    /// As [`Solution::beyond`].
    pub beyond: S,
}

/// [`Margins`] with the sign of the side of each singularity: negative behind axis 1, behind the
/// lower arm, and where joint 5 is negative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stance<S = f64> {
    pub wrist_rad: S,
    pub elbow_rad: S,
    pub shoulder_m: S,
}

/// A posture this near to the border of a branch belongs to it, too: a correction may lead across.
const BORDER_RAD: f64 = 2.0 * DEG;
const BORDER_M: f64 = 5.0 * MM;

impl Stance {
    /// Whether a posture is on a branch, or at its border.
    pub(super) fn is_on(&self, branch: Branch) -> bool {
        let (own, margins) = (self.branch(), self.margins());
        (own.behind_axis_1 == branch.behind_axis_1 || margins.shoulder_m < BORDER_M)
            && (own.behind_lower_arm == branch.behind_lower_arm || margins.elbow_rad < BORDER_RAD)
            && (own.joint_5_negative == branch.joint_5_negative || margins.wrist_rad < BORDER_RAD)
    }

    pub(super) fn branch(&self) -> Branch {
        Branch {
            behind_axis_1: self.shoulder_m < 0.0,
            behind_lower_arm: self.elbow_rad < 0.0,
            joint_5_negative: self.wrist_rad < 0.0,
        }
    }

    pub(super) fn margins(&self) -> Margins {
        Margins {
            wrist_rad: self.wrist_rad.abs(),
            elbow_rad: self.elbow_rad.abs(),
            shoulder_m: self.shoulder_m.abs(),
        }
    }
}

/// How near a posture is to the three singularities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// Angle of joint 5 from alignment of axes 4 and 6, radians, in [0, π/2].
    pub wrist_rad: f64,
    /// Angle of the elbow from stretched or folded, radians, in [0, π/2].
    pub elbow_rad: f64,
    /// Distance of the wrist centre from the plane where the shoulder rotates freely, metres.
    pub shoulder_m: f64,
}

impl Arm {
    /// A name for the kind of arm.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self.wrist {
            Wrist::Spherical => "spherical wrist",
            Wrist::Offset => "offset wrist, joint 6 by iteration",
            Wrist::Parallel => "three parallel axes",
        }
    }

    /// How the controller counts the joints of this arm.
    #[must_use]
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// `world_from_tool` of the nominal arm at the controller's joint angles `q`, radians.
    #[must_use]
    pub fn forward(&self, q: &[f64; 6]) -> Pose {
        self.chain
            .forward(&AxisRotation::of_each(&self.mechanism.commanded(q)))
    }

    /// The joint angles on one branch that bring the nominal tool to `world_from_tool`, by whole
    /// turns nearest to `near`.
    ///
    /// Where the pose is out of reach the nearest posture of the stretched or folded arm is
    /// returned, and [`Solution::beyond`] is positive. Where joint 5 aligns axes 4 and 6, joint
    /// 4 (on arms with three parallel axes joint
    /// 6) is that of `near`.
    #[inline(always)]
    #[must_use]
    pub fn solve<S: Scalar>(
        &self,
        world_from_tool: &Pose<S>,
        signs: [S; 3],
        near: &[S; 6],
    ) -> Solution<S> {
        let Rotated { turns, beyond } = self.solve_turns(world_from_tool, signs, near);
        Solution {
            q: self.mechanism.controller(&self.angles(&turns, near)),
            beyond,
        }
    }

    /// Enclosures of the joint angles over an interval of a path, `half_width` to either side of
    /// the middle, where the controller's joints are `middle`.
    #[must_use]
    pub fn enclose(
        &self,
        world_from_tool: &Pose<Jet>,
        half_width: f64,
        signs: [f64; 3],
        middle: &[f64; 6],
    ) -> [Jet; 6] {
        let (signs, near) = (signs.map(Jet::constant), middle.map(Jet::constant));
        let target = self.last_row(world_from_tool);
        let (rows, _) = match self.wrist {
            Wrist::Spherical => self.solve_spherical(&target, signs, &near),
            Wrist::Offset => self.enclose_offset(&target, half_width, middle),
            Wrist::Parallel => self.solve_parallel(&target, signs, &near),
        };
        let angles = self.angles(&self.turns_of(rows), &near);
        self.mechanism.controller(&angles)
    }

    /// [`Arm::solve`] as far as sines and cosines.
    #[inline(always)]
    pub(super) fn solve_turns<S: Scalar>(
        &self,
        world_from_tool: &Pose<S>,
        signs: [S; 3],
        near: &[S; 6],
    ) -> Rotated<S> {
        let target = self.last_row(world_from_tool);
        let (rows, beyond) = match self.wrist {
            Wrist::Spherical => self.solve_spherical(&target, signs, near),
            Wrist::Offset => self.solve_offset(&target, signs, near),
            Wrist::Parallel => self.solve_parallel(&target, signs, near),
        };
        Rotated {
            turns: self.turns_of(rows),
            beyond,
        }
    }

    /// The frame of the last row without its d, seen from the frame that axis 1 turns.
    #[inline(always)]
    fn last_row<S: Scalar>(&self, world_from_tool: &Pose<S>) -> Pose<S> {
        self.turning_from_world.cast() * *world_from_tool * self.tool_from_link6.cast()
    }

    /// Rotations of the mechanical joints with these rotations of the rows of the chain.
    #[inline(always)]
    fn turns_of<S: Scalar>(&self, mut rows: [AxisRotation<S>; 6]) -> [AxisRotation<S>; 6] {
        for i in 0..6 {
            let home = self.home[i].cast();
            rows[i] = (rows[i] * home.inverse()).signed(S::constant(self.sign[i]));
        }
        rows
    }

    /// Mechanical joint angles of these turns, by whole revolutions nearest to the controller's
    /// angles `near`.
    #[inline(always)]
    pub(super) fn angles<S: Scalar>(&self, turns: &[AxisRotation<S>; 6], near: &[S; 6]) -> [S; 6] {
        let turn = S::constant(std::f64::consts::TAU);
        let per_turn = S::constant(std::f64::consts::TAU.recip());
        let near = self.mechanism.commanded(near);
        let mut angles = near;
        for i in 0..6 {
            let angle = turns[i].angle();
            angles[i] = angle + turn * ((near[i] - angle) * per_turn).round();
        }
        angles
    }

    /// Rotation of a row of the chain with this rotation of its mechanical joint.
    #[inline(always)]
    fn row<S: Scalar>(&self, index: usize, turn: AxisRotation<S>) -> AxisRotation<S> {
        turn.signed(S::constant(self.sign[index])) * self.home[index].cast()
    }

    /// `found` where the wrist is clear of alignment, else the rotation of row `index` in the
    /// posture `near`.
    #[inline(always)]
    fn unless_aligned<S: Scalar>(
        &self,
        sine: S,
        found: AxisRotation<S>,
        index: usize,
        near: &[S; 6],
    ) -> AxisRotation<S> {
        let clear = S::constant(WRIST_SINE) - sine.abs();
        if clear.every_below(0.0) {
            return found;
        }
        let given = self.row(
            index,
            AxisRotation::of(self.mechanism.commanded(near)[index]),
        );
        AxisRotation {
            sine: clear.choose_less(S::zero(), found.sine, given.sine),
            cosine: clear.choose_less(S::zero(), found.cosine, given.cosine),
        }
    }

    /// The solution on one branch for plain numbers.
    ///
    /// An arm with an offset wrist can have several on a branch ([`Arm::solve_all`]): this is the
    /// one nearest to `near`.
    #[must_use]
    pub fn solve_branch(
        &self,
        world_from_tool: &Pose,
        branch: Branch,
        near: &[f64; 6],
    ) -> Solution {
        if self.wrist != Wrist::Offset {
            return self.solve(world_from_tool, branch.signs(), near);
        }
        self.solution(&self.offset_on_branch(world_from_tool, branch, near), near)
    }

    /// Joint angles of a solution by sines and cosines.
    pub(super) fn solution(&self, turned: &Rotated, near: &[f64; 6]) -> Solution {
        Solution {
            q: self.mechanism.controller(&self.angles(&turned.turns, near)),
            beyond: turned.beyond,
        }
    }

    /// Rotation of row 1 and the distance of the wrist centre from axis 1 within the arm's plane.
    #[inline(always)]
    fn shoulder<S: Scalar>(&self, p: Vector<S>, front: S) -> (AxisRotation<S>, S, S) {
        let b = S::constant(self.lateral_m);
        let squared = p[0] * p[0] + p[1] * p[1];
        let beyond = (b * b - squared).max(S::zero());
        let front = front * S::constant(self.front_sign);
        let r = front * (squared - b * b).max(S::zero()).sqrt();
        let first = AxisRotation::toward(r * p[1] - b * p[0], r * p[0] + b * p[1]);
        (first, r, beyond)
    }

    /// Rotations of rows 2 and 3 that bring the end of the forearm to (u, v) in the arm's plane.
    #[inline(always)]
    fn planar<S: Scalar>(&self, u: S, v: S, before: S) -> (AxisRotation<S>, AxisRotation<S>, S) {
        let (upper, fore) = (S::constant(self.a3_m), S::constant(self.forearm_m));
        let raw = self.elbow_cosine(u, v);
        let one = S::one();
        let cosine = raw.max(-one).min(one);
        let beyond = (raw.abs() - one).max(S::zero());
        let sine =
            before * S::constant(self.elbow_sign) * (one - cosine * cosine).max(S::zero()).sqrt();
        let along = upper + fore * cosine;
        let across = S::constant(self.s3) * fore * sine;
        let second = AxisRotation::toward(along * v - across * u, along * u + across * v);
        // row 3 rotates by the elbow's angle less the direction of the forearm in its frame
        let third = AxisRotation { sine, cosine } * self.forearm.cast().inverse();
        (second, third, beyond)
    }

    /// Cosine of the elbow by the law of cosines; out of reach its magnitude is above one.
    #[inline(always)]
    fn elbow_cosine<S: Scalar>(&self, u: S, v: S) -> S {
        let (upper, fore) = (S::constant(self.a3_m), S::constant(self.forearm_m));
        let squared = u * u + v * v;
        let inverse = S::constant((2.0 * self.a3_m * self.forearm_m).recip());
        (squared - upper * upper - fore * fore) * inverse
    }

    /// A pose moved across axis 1 by `radius_m` in the direction `angle_rad` about it.
    #[must_use]
    pub fn displaced(&self, world_from_tool: &Pose, radius_m: f64, angle_rad: f64) -> Pose {
        let (sine, cosine) = angle_rad.sin_cos();
        let across = self.turning_from_world.rotation.transpose()
            * [radius_m * cosine, radius_m * sine, 0.0];
        Pose {
            translation: add(world_from_tool.translation, across),
            ..*world_from_tool
        }
    }

    /// The branch of a posture and its distances from the singularities.
    #[must_use]
    pub fn posture(&self, q: &[f64; 6]) -> (Branch, Margins) {
        let angles = self.mechanism.commanded(q);
        let mut turns = [AxisRotation::none(); 6];
        // neither the first nor the last decides
        for i in 1..5 {
            turns[i] = AxisRotation::of(angles[i]);
        }
        let stance = self.stance(&turns);
        (stance.branch(), stance.margins())
    }

    /// Whether a small change of the pose changes little of what the first three joints must reach.
    /// With three parallel axes that hangs on joint 6, which rotates freely where joint 5 aligns
    /// the wrist.
    pub(super) fn reach_is_steady(&self, stance: &Stance) -> bool {
        self.wrist != Wrist::Parallel || stance.wrist_rad.abs() > STEADY_WRIST_RAD
    }

    /// On which side of each singularity the mechanical joints stand, and how far from it.
    #[inline(always)]
    pub(super) fn stance<S: Scalar>(&self, turns: &[AxisRotation<S>; 6]) -> Stance<S> {
        let [second, third] = [1, 2].map(|i| self.row(i, turns[i]));
        let k = S::constant;
        let elbow = third * self.forearm.cast();
        let along = k(self.a3_m) + k(self.forearm_m) * elbow.cosine;
        let across = k(self.s3 * self.forearm_m) * elbow.sine;
        let mut reach = k(self.a2_m) + second.cosine * along - second.sine * across;
        if self.wrist == Wrist::Parallel {
            let fourth = self.row(3, turns[3]);
            let sum = second * third.signed(k(self.s3)) * fourth.signed(k(self.s3 * self.s4));
            let across = k(-self.d5_m * self.e5 * self.s3 * self.s4);
            reach += sum.cosine * k(self.a5_m) - sum.sine * across;
        }
        let fifth = self.row(4, turns[4]);
        Stance {
            wrist_rad: (k(self.wrist_sign) * fifth.sine).atan2(fifth.cosine.abs()),
            elbow_rad: (k(self.elbow_sign) * elbow.sine).atan2(elbow.cosine.abs()),
            shoulder_m: k(self.front_sign) * reach,
        }
    }
}

/// `Rz(first) · Rx(±90°) · Rz(sum) · Rx(0 or 180°)`.
#[inline(always)]
fn arm_rotation<S: Scalar>(
    first: AxisRotation<S>,
    sum: AxisRotation<S>,
    e2: S,
    flip: S,
) -> Rotation<S> {
    let (s1, c1, s, c) = (first.sine, first.cosine, sum.sine, sum.cosine);
    // Rx(±90°) takes (x, y, z) to (x, −e2 z, e2 y)
    Rotation([
        [c1 * c, -(flip * c1 * s), flip * e2 * s1],
        [s1 * c, -(flip * s1 * s), -(flip * e2 * c1)],
        [e2 * s, flip * e2 * c, S::zero()],
    ])
}
