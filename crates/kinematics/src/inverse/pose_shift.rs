//! The calibrated inverse: multiply what is still missing into the pose given to the nominal
//! inverse.
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
//! A. Nubiola, I. A. Bonev, "Geometric approach to solving the inverse displacement problem of
//! calibrated decoupled 6R serial robots", Trans. CSME 38 (2014), after N. Chen, G. A. Parker
//! (1994).

use super::branch::Branch;
use super::closed_form::{Arm, Rotated, is_close};
use super::newton;
use super::outcome::{Landed, Method, Methods, Outcome, Spent, Status};
use crate::geometry::{AxisRotation, Pose, Scalar, Separation, norm, sub};
use crate::model::{Conditions, Model};

/// How near the real tool must come: 1e-6 mm.
pub const TOLERANCE_M: f64 = 1e-9;
/// How near the real tool must come in orientation, radians.
pub const TOLERANCE_RAD: f64 = 1e-9;
/// Iterations after which the pose shift gives up; it needs four to six where it converges well.
const MOST_ITERATIONS: u32 = 12;
/// Farther beyond reach than this the real arm, which is millimetres longer or shorter, does not
/// reach either: in squared cosines of the elbow, more than 10 mm on an arm with links of 0.4 m.
const FAR_BEYOND: f64 = 0.05;
/// What is missing at the stretched nominal arm that no joint can make up: this and the turn of a
/// tool of a metre.
const HOPELESS_M: f64 = 0.01;
const LEVER_M: f64 = 1.0;
/// The nominal elbow at which that of the real arm may be straight.
const STRETCHED_RAD: f64 = 0.05;

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
    /// Rotations of the mechanical joints.
    pub turns: [AxisRotation<S>; 6],
    /// The pose to give to the nominal inverse next.
    pub next: Pose<S>,
    pub distance: S,
    /// Sine of the angle still missing; the angle itself where it is small, and 2 where it is
    /// above a right angle.
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
    let turned = arm.solve_turns(given, signs, near);
    evaluate(arm, real, conditions, wanted, given, turned, near)
}

/// The real forward model at a nominal solution of `given`, and what is missing to `wanted`.
#[inline(always)]
fn evaluate<S: Scalar>(
    arm: &Arm,
    real: &Model<S>,
    conditions: &Conditions,
    wanted: &Pose<S>,
    given: &Pose<S>,
    Rotated { turns, beyond }: Rotated<S>,
    near: &[S; 6],
) -> Step<S> {
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

/// How the pose shift ended.
enum Shifted {
    /// It brings the tool to the target; the joints may be beyond their limits or on another
    /// branch.
    Landed(Outcome),
    /// It does not, and this is the best it found.
    Stalled(Step<f64>, u32),
}

impl Inverse {
    /// The joint angles with which the real arm brings its tool to `wanted`, on one branch, by
    /// whole revolutions nearest to `near`.
    ///
    /// Where a branch holds several answers (an offset wrist) it is the one that the nearest
    /// nominal answer to `near` leads to.
    #[must_use]
    pub fn solve(&self, wanted: &Pose, branch: Branch, near: &[f64; 6]) -> Outcome {
        self.solve_by(Methods::Auto, wanted, branch, near)
    }

    /// [`Inverse::solve`] on the branch of `near`: the answer on the track of a posture.
    #[must_use]
    pub fn solve_near(&self, wanted: &Pose, near: &[f64; 6]) -> Outcome {
        self.solve(wanted, self.arm.posture(near).0, near)
    }

    /// The posture with one joint where it is in `near` that brings the tip of the real tool to
    /// `wanted`, and its orientation as near as may be: [`Status::Converged`] tells that the
    /// tip is there and the joints are within their limits.
    #[must_use]
    pub fn solve_held(&self, wanted: &Pose, near: &[f64; 6], joint: usize) -> Outcome {
        if !is_finite(wanted, near) {
            return self.refused(near);
        }
        let found = newton::held(self, wanted, near, joint);
        let beyond = self.arm.mechanism().beyond_limit(&found.q, 0.0);
        let status = match beyond {
            Some(joint) => Status::JointLimit(joint),
            None if found.residual.distance_m < TOLERANCE_M => Status::Converged,
            None => Status::NotConverged,
        };
        Outcome {
            q: found.q,
            status,
            method: Method::Newton,
            residual: found.residual,
            iterations: found.iterations,
            shift_evaluations: 0,
            newton_evaluations: found.iterations,
            margins: self.stance_at(&found.q).margins(),
        }
    }

    /// [`Inverse::solve`] with the methods that are allowed.
    #[must_use]
    pub fn solve_by(
        &self,
        methods: Methods,
        wanted: &Pose,
        branch: Branch,
        near: &[f64; 6],
    ) -> Outcome {
        if !is_finite(wanted, near) {
            return self.refused(near);
        }
        match self.shift(wanted, branch, near) {
            Shifted::Landed(outcome)
                if methods == Methods::PoseShift || outcome.status == Status::Converged =>
            {
                outcome
            }
            Shifted::Landed(outcome) => self.nearest(wanted, branch, near, outcome),
            Shifted::Stalled(step, spent) => {
                self.solve_stalled(methods, wanted, branch, near, &step, spent)
            }
        }
    }

    /// The pose shift until it lands, or makes no progress.
    #[inline(always)]
    fn shift(&self, wanted: &Pose, branch: Branch, near: &[f64; 6]) -> Shifted {
        let signs = branch.signs();
        let offset = self.arm.has_offset_wrist();
        let mut given = *wanted;
        let mut track = None;
        let mut best: Option<Step<f64>> = None;
        for iteration in 1..=MOST_ITERATIONS {
            let turned = match (&best, offset) {
                (_, false) => self.arm.solve_turns(&given, signs, near),
                (None, true) => self.arm.offset_start(&given, branch, near),
                (Some(last), true) => self.arm.offset_follow(&given, &last.turns),
            };
            if offset && track.is_none() {
                track = Some(turned.turns);
            }
            let (real, conditions) = (&self.real, &self.conditions);
            let now = evaluate(&self.arm, real, conditions, wanted, &given, turned, near);
            if within(now.distance, now.angle) && now.beyond == 0.0 {
                let angles = self.arm.angles(&now.turns, near);
                return Shifted::Landed(self.finish(
                    branch,
                    &Landed {
                        q: self.arm.mechanism().controller(&angles),
                        stance: &self.arm.stance(&now.turns),
                        residual: now.missing(),
                        method: Method::PoseShift,
                        spent: Spent {
                            shift: iteration,
                            newton: 0,
                        },
                        follows: track.is_some_and(|track| is_close(&track, &now.turns)),
                    },
                ));
            }
            let last = best
                .as_ref()
                .map_or(f64::INFINITY, |b| b.distance + b.angle);
            // without progress, or out of the nominal reach, the other method takes over
            if now.beyond > 0.0 || now.distance + now.angle > 0.5 * last {
                let start = best
                    .filter(|_| now.distance + now.angle > last)
                    .unwrap_or(now);
                return Shifted::Stalled(start, iteration);
            }
            given = now.next;
            best = Some(now);
        }
        let start = best.expect("there is at least one iteration");
        Shifted::Stalled(start, MOST_ITERATIONS)
    }

    /// What becomes of a target that the pose shift could not bring the tool to.
    pub(super) fn solve_stalled(
        &self,
        methods: Methods,
        wanted: &Pose,
        branch: Branch,
        near: &[f64; 6],
        start: &Step<f64>,
        shift: u32,
    ) -> Outcome {
        let q = self.controller(&start.turns, near);
        let failed = |q: [f64; 6], residual: Separation, is_beyond: bool, newton: u32| {
            let status = if is_beyond {
                Status::OutOfReach
            } else {
                Status::NotConverged
            };
            let margins = self.stance_at(&q).margins();
            let method = if newton > 0 {
                Method::Newton
            } else {
                Method::PoseShift
            };
            Outcome {
                q,
                status,
                method,
                residual,
                iterations: shift + newton,
                shift_evaluations: shift,
                newton_evaluations: newton,
                margins,
            }
        };
        if methods == Methods::PoseShift {
            return failed(q, start.missing(), start.beyond > 0.0, 0);
        }
        let mut newton = 0;
        if let Some(found) = newton::from_near(self, wanted, near) {
            newton += found.iterations;
            let q = self.arm.mechanism().nearest_turns(&found.q, near);
            let spent = Spent { shift, newton };
            if found.is_done() {
                let outcome = self.finish_newton(branch, q, near, found.residual, spent);
                if outcome.status == Status::Converged {
                    return outcome;
                }
            }
        }
        if self.is_hopeless(start) {
            return failed(q, start.missing(), start.beyond > 0.0, newton);
        }
        let nominal = self.arm.solve_branch(wanted, branch, near);
        let found = newton::solve(self, wanted, branch, near, &q, &nominal.q);
        let q = self.arm.mechanism().nearest_turns(&found.q, near);
        newton += found.iterations;
        if found.is_done() {
            let spent = Spent { shift, newton };
            return self.finish_newton(branch, q, &nominal.q, found.residual, spent);
        }
        let is_stretched =
            found.is_at_rest && self.stance_at(&q).margins().elbow_rad < STRETCHED_RAD;
        failed(
            q,
            found.residual,
            is_stretched || nominal.beyond > 0.0,
            newton,
        )
    }

    /// Whether the nominal arm ends so far from the target that the real one does not reach it
    /// either.
    fn is_hopeless(&self, stalled: &Step<f64>) -> bool {
        let far = stalled.beyond > FAR_BEYOND
            || (stalled.beyond > 0.0 && stalled.distance > HOPELESS_M + LEVER_M * stalled.angle);
        far && self.arm.reach_is_steady(&self.arm.stance(&stalled.turns))
    }

    /// A target that the pose shift reaches only beyond the limits or on another branch: where the
    /// posture near it is close to the target, Newton's method from there may stay within.
    fn nearest(
        &self,
        wanted: &Pose,
        branch: Branch,
        near: &[f64; 6],
        by_shift: Outcome,
    ) -> Outcome {
        let Some(found) = newton::from_near(self, wanted, near) else {
            return by_shift;
        };
        let spent = Spent {
            shift: by_shift.shift_evaluations,
            newton: found.iterations,
        };
        let q = self.arm.mechanism().nearest_turns(&found.q, near);
        let by_newton = self.finish_newton(branch, q, near, found.residual, spent);
        if found.is_done() && by_newton.status == Status::Converged {
            return by_newton;
        }
        Outcome {
            newton_evaluations: spent.newton,
            iterations: spent.shift + spent.newton,
            ..by_shift
        }
    }

    fn controller(&self, turns: &[AxisRotation; 6], near: &[f64; 6]) -> [f64; 6] {
        let angles = self.arm.angles(turns, near);
        self.arm.mechanism().controller(&angles)
    }
}

impl Step<f64> {
    fn missing(&self) -> Separation {
        Separation {
            distance_m: self.distance,
            angle_rad: self.angle,
        }
    }
}

fn is_finite(pose: &Pose, near: &[f64; 6]) -> bool {
    let rotation = pose.rotation.0.iter().flatten();
    let numbers = rotation.chain(&pose.translation).chain(near);
    // a sum of finite numbers that overflows is of no arm's world
    numbers.map(|x| x.abs()).sum::<f64>().is_finite()
}
