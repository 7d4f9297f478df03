//! From a wanted pose to joint angles: the nominal arm in closed form, the calibrated one by pose
//! shift.
//!
//! The calibrated inverse needs no derivative: the pose shift feeds what is still missing back into
//! the nominal inverse. Where that stalls, near singularities and at the edge of reach, a damped
//! Newton method on the exact Jacobian goes on from the best posture and keeps the branch.
//!
//! # Example
//!
//! ```
//! use poseshift_kinematics::inverse::{Arm, Inverse, Status};
//! use poseshift_kinematics::model::Conditions;
//! use poseshift_profile::{Mounted, Profile};
//!
//! let profile = Profile::from_yaml(include_str!("../../../../robots/abb_irb120_thesis.yaml"))?;
//! let (tool, conditions) = (Mounted::flange(), Conditions::default());
//! let inverse = Inverse {
//!     arm: Arm::of(&profile.geometry(&tool), &profile.mechanism)?,
//!     real: profile.real_model(&tool, &conditions),
//!     conditions,
//! };
//! let q = [0.1, 0.3, 0.2, 0.4, 1.0, 0.0];
//! let wanted = profile.controller_model(&tool).forward(&q, &conditions);
//! let found = inverse.solve_near(&wanted, &q);
//! assert_eq!(found.status, Status::Converged);
//! assert!(inverse.real.forward(&found.q, &conditions).separation(&wanted).distance_m < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
