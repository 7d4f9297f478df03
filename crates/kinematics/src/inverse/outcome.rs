//! How a search ended, and how good its joint angles are.

use super::branch::Branch;
use super::closed_form::{Margins, Stance, is_close};
use super::pose_shift::Inverse;
use crate::geometry::{AxisRotation, Separation};

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
    /// Neither method came within the tolerances; or a number of the target or of the posture near
    /// it is not finite.
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

/// By which method a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The pose shift alone.
    PoseShift,
    /// Damped Newton, after the pose shift stalled.
    Newton,
}

impl Method {
    /// Its name in tables and reports.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::PoseShift => "pose-shift",
            Self::Newton => "newton",
        }
    }
}

/// Which methods a search may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Methods {
    /// The pose shift, and damped Newton where it stalls.
    #[default]
    Auto,
    /// The pose shift alone: what it cannot reach has not converged.
    PoseShift,
}

/// The joint angles found for one target, and how good they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The controller's joint angles, radians.
    pub q: [f64; 6],
    /// How it ended.
    pub status: Status,
    /// By which method.
    pub method: Method,
    /// What is still missing at `q`.
    pub residual: Separation,
    /// Evaluations of the real model, both methods together.
    pub iterations: u32,
    /// Those of the pose shift.
    pub shift_evaluations: u32,
    /// Those of Newton's method, each with its Jacobian.
    pub newton_evaluations: u32,
    /// Distances from the singularities at `q`.
    pub margins: Margins,
}

/// Evaluations of the real model.
#[derive(Clone, Copy, Default)]
pub(super) struct Spent {
    pub shift: u32,
    pub newton: u32,
}

/// A posture that brings the tool to the target, to be judged.
pub(super) struct Landed<'a> {
    pub q: [f64; 6],
    pub stance: &'a Stance,
    pub residual: Separation,
    pub method: Method,
    pub spent: Spent,
    /// Whether it follows the nominal answer without a leap: with an offset wrist the branch may
    /// change on the way.
    pub follows: bool,
}

impl Inverse {
    pub(super) fn finish_newton(
        &self,
        branch: Branch,
        q: [f64; 6],
        track: &[f64; 6],
        residual: Separation,
        spent: Spent,
    ) -> Outcome {
        let landed = Landed {
            q,
            stance: &self.stance_at(&q),
            residual,
            method: Method::Newton,
            spent,
            follows: self.follows(&q, track),
        };
        self.finish(branch, &landed)
    }

    /// Whether a posture of an arm with an offset wrist follows another without a leap; never for
    /// other arms, whose branches end at singularities.
    pub(super) fn follows(&self, q: &[f64; 6], track: &[f64; 6]) -> bool {
        let turns = |q| AxisRotation::of_each(&self.arm.mechanism().commanded(q));
        self.arm.has_offset_wrist() && is_close(&turns(q), &turns(track))
    }

    pub(super) fn stance_at(&self, q: &[f64; 6]) -> Stance {
        let commanded = self.arm.mechanism().commanded(q);
        self.arm.stance(&AxisRotation::of_each(&commanded))
    }

    /// The answer to what is no pose or no posture.
    pub(super) fn refused(&self, near: &[f64; 6]) -> Outcome {
        Outcome {
            q: *near,
            status: Status::NotConverged,
            method: Method::PoseShift,
            residual: Separation {
                distance_m: f64::NAN,
                angle_rad: f64::NAN,
            },
            iterations: 0,
            shift_evaluations: 0,
            newton_evaluations: 0,
            margins: self.stance_at(near).margins(),
        }
    }

    /// Judges joint angles that bring the tool where it should be.
    pub(super) fn finish(&self, wanted: Branch, landed: &Landed) -> Outcome {
        let Landed { q, spent, .. } = *landed;
        let (branch, margins) = (landed.stance.branch(), landed.stance.margins());
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
        let status = if lost && !landed.follows {
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
            method: landed.method,
            residual: landed.residual,
            iterations: spent.shift + spent.newton,
            shift_evaluations: spent.shift,
            newton_evaluations: spent.newton,
            margins,
        }
    }
}
