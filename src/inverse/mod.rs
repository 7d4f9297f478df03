//! From a wanted pose to joint angles: the nominal arm in closed form, the calibrated one by pose shift.
//!
//! The calibrated inverse needs no derivative: the pose shift feeds what is still missing back into the nominal inverse.
//! Where that stalls, near singularities and at the edge of reach, a damped Newton method on the exact Jacobian
//! goes on from the best posture and keeps the branch.

mod batch;
mod branch;
mod closed_form;
mod newton;
mod outcome;
mod pose_shift;
mod track;

pub use batch::{Targets, solve_batch, solve_batch_by};
pub use branch::Branch;
pub use closed_form::{Answer, Arm, Margins, Solution, Unsupported};
pub use outcome::{Method, Methods, Outcome, Status};
pub use pose_shift::{Inverse, TOLERANCE_M, TOLERANCE_RAD};
pub use track::{Ambiguous, TrackEnds};
