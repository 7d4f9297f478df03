//! The calibrated inverse: multiply what is still missing into the pose given to the nominal inverse.
//!
//! ```text
//! H0 = W                                     W: wanted pose; H: pose given to the nominal inverse
//! qk = nominal_inverse(Hk; branch)
//! Ek = W · real_forward(qk)⁻¹                what is still missing, a rigid motion in the world
//! Hk+1 = Ek · Hk
//! until |Ek| < tolerance
//! ```
//!
//! # Source
//! A. Nubiola, I. A. Bonev, "Geometric approach to solving the inverse displacement problem of calibrated decoupled 6R
//! serial robots", Trans. CSME 38 (2014), after N. Chen, G. A. Parker (1994).

use super::branch::Branch;
use super::closed_form::{Arm, Margins, Stance, Turned};
use super::newton;
use crate::geometry::{Pose, Scalar, Separation, Turn, norm, sub};
use crate::model::{Conditions, Model};

/// How near the real tool must come: 1e-6 mm.
pub const TOLERANCE_M: f64 = 1e-9;
/// How near the real tool must come in orientation, radians.
pub const TOLERANCE_RAD: f64 = 1e-9;
/// Iterations after which the pose shift gives up; it needs four to six where it converges well.
const MOST_ITERATIONS: u32 = 12;
/// A posture this near to a singularity counts as on either side of it, radians or metres.
const ON_THE_BORDER: f64 = 1e-9;

/// How the search for one target ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The real tool reaches the wanted pose within the tolerances.
    Converged,
    /// The real arm cannot reach so far, or not in this direction.
    OutOfReach,
    /// It would, but this joint (index) leaves its limits.
    JointLimit(usize),
    /// The wanted pose can be reached on another branch only.
    BranchLost,
    /// Neither method came within the tolerances.
    NotConverged,
}

impl Status {
    /// Its name in tables and reports.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::OutOfReach => "out-of-reach",
            Self::JointLimit(_) => "joint-limit",
            Self::BranchLost => "branch-lost",
            Self::NotConverged => "not-converged",
        }
    }
}

/// The joint angles found for one target, and how good they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The controller's joint angles, radians.
    pub q: [f64; 6],
    /// How it ended.
    pub status: Status,
    /// What is still missing at `q`.
    pub residual: Separation,
    /// Evaluations of the real model, both methods together.
    pub iterations: u32,
    /// Distances from the singularities at `q`.
    pub margins: Margins,
}

/// The inverse of one arm with one tool under one set of conditions.
#[derive(Clone, Debug)]
pub struct Inverse {
    /// The nominal inverse.
    pub arm: Arm,
    /// The arm as it really is.
    pub real: Model,
    /// Direction, force, temperature, time.
    pub conditions: Conditions,
}

/// One evaluation of the pose shift.
#[derive(Clone, Copy)]
pub(super) struct Step<S> {
    /// Turns of the mechanical joints.
    pub turns: [Turn<S>; 6],
    /// The pose to give to the nominal inverse next.
    pub next: Pose<S>,
    pub distance: S,
    /// Sine of the angle still missing; the angle itself where it is small, and 2 where it is above a right angle.
    pub angle: S,
    pub beyond: S,
}

/// One evaluation: nominal inverse of `given`, real forward, what is missing to `wanted`.
#[inline(always)]
pub(super) fn step<S: Scalar>(
    arm: &Arm,
    real: &Model<S>,
    conditions: &Conditions,
    wanted: &Pose<S>,
    given: &Pose<S>,
    signs: [S; 3],
    near: &[S; 6],
) -> Step<S> {
    let Turned { turns, beyond } = arm.solve_turns(given, signs, near);
    let angles = if real.reads_angles() {
        arm.angles(&turns, near)
    } else {
        [S::zero(); 6]
    };
    let reached = real.forward_turned(&angles, &turns, conditions);
    let missing = *wanted * reached.inverse();
    let sine = norm(missing.rotation.sine_axis());
    let angle = missing
        .rotation
        .cosine()
        .choose_less(S::zero(), S::constant(2.0), sine);
    Step {
        turns,
        next: missing * *given,
        distance: norm(sub(wanted.translation, reached.translation)),
        angle,
        beyond,
    }
}

pub(super) fn within(distance_m: f64, angle_rad: f64) -> bool {
    distance_m < TOLERANCE_M && angle_rad < TOLERANCE_RAD
}

impl Inverse {
    /// The joint angles with which the real arm brings its tool to `wanted`, on one branch, by whole turns nearest to `near`.
    #[must_use]
    #[allow(clippy::missing_panics_doc)]
    pub fn solve(&self, wanted: &Pose, branch: Branch, near: &[f64; 6]) -> Outcome {
        let signs = branch.signs();
        let mut given = *wanted;
        let mut best: Option<Step<f64>> = None;
        for iteration in 1..=MOST_ITERATIONS {
            let now = step(
                &self.arm,
                &self.real,
                &self.conditions,
                wanted,
                &given,
                signs,
                near,
            );
            if within(now.distance, now.angle) && now.beyond == 0.0 {
                let angles = self.arm.angles(&now.turns, near);
                return self.finish(
                    self.arm.mechanism().controller(&angles),
                    &self.arm.stance(&now.turns),
                    Separation {
                        distance_m: now.distance,
                        angle_rad: now.angle,
                    },
                    iteration,
                    branch,
                );
            }
            let last = best
                .as_ref()
                .map_or(f64::INFINITY, |b| b.distance + b.angle);
            // without progress, or out of the nominal reach, the other method takes over
            if now.beyond > 0.0 || now.distance + now.angle > 0.5 * last {
                let start = best
                    .filter(|_| now.distance + now.angle > last)
                    .unwrap_or(now);
                return self.solve_by_newton(wanted, branch, near, &start.turns, iteration);
            }
            given = now.next;
            best = Some(now);
        }
        let start = best.expect("there is at least one iteration");
        self.solve_by_newton(wanted, branch, near, &start.turns, MOST_ITERATIONS)
    }

    /// Goes on from a posture that the pose shift could not improve.
    pub(super) fn solve_by_newton(
        &self,
        wanted: &Pose,
        branch: Branch,
        near: &[f64; 6],
        start: &[Turn; 6],
        spent: u32,
    ) -> Outcome {
        let nominal = self.arm.solve_branch(wanted, branch, near);
        let start = self.arm.angles(start, near);
        let start = self.arm.mechanism().controller(&start);
        let found = newton::solve(self, wanted, branch, near, &start);
        let iterations = spent + found.iterations;
        let q = self.arm.mechanism().nearest_turns(&found.q, near);
        let stance = self
            .arm
            .stance(&Turn::of_each(&self.arm.mechanism().commanded(&q)));
        if within(found.residual.distance_m, found.residual.angle_rad) {
            return self.finish(q, &stance, found.residual, iterations, branch);
        }
        let status = if nominal.beyond > 0.0 {
            Status::OutOfReach
        } else {
            Status::NotConverged
        };
        Outcome {
            q,
            status,
            residual: found.residual,
            iterations,
            margins: stance.margins(),
        }
    }

    /// Judges joint angles that bring the tool where it should be.
    pub(super) fn finish(
        &self,
        q: [f64; 6],
        stance: &Stance,
        residual: Separation,
        iterations: u32,
        wanted: Branch,
    ) -> Outcome {
        let (branch, margins) = (stance.branch(), stance.margins());
        let left = |is: bool, was: bool, margin: f64| is != was && margin > ON_THE_BORDER;
        let lost = left(
            branch.behind_axis_1,
            wanted.behind_axis_1,
            margins.shoulder_m,
        ) || left(
            branch.behind_lower_arm,
            wanted.behind_lower_arm,
            margins.elbow_rad,
        ) || left(
            branch.joint_5_negative,
            wanted.joint_5_negative,
            margins.wrist_rad,
        );
        let status = if lost {
            Status::BranchLost
        } else {
            match self.arm.mechanism().beyond_limit(&q, ON_THE_BORDER) {
                Some(joint) => Status::JointLimit(joint),
                None => Status::Converged,
            }
        };
        Outcome {
            q,
            status,
            residual,
            iterations,
            margins,
        }
    }
}
