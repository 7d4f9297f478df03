//! Where a robot's tool is: the nominal chain, and every physical cause that makes the real one
//! differ.
//!
//! The data flow: a profile (`poseshift_profile::Profile`) gives the nominal [`Geometry`] and a list of [`effects`];
//! [`Model::build`] applies the effects that change the geometry once, and [`Model::forward`]
//! evaluates the ones that depend on the posture for each set of commanded joint angles.
//!
//! # Example
//!
//! ```
//! use poseshift_kinematics::model::Conditions;
//! use poseshift_profile::{Mounted, Profile};
//!
//! let profile = Profile::from_yaml(include_str!("../../../../robots/abb_irb120_thesis.yaml"))?;
//! let (tool, conditions) = (Mounted::flange(), Conditions::default());
//! let q = [0.0, 0.3, 0.2, 0.0, 1.0, 0.0];
//! let nominal = profile.controller_model(&tool).forward(&q, &conditions);
//! let real = profile.real_model(&tool, &conditions).forward(&q, &conditions);
//! assert!(real.separation(&nominal).distance_m > 1e-4);
//! # Ok::<(), poseshift_profile::ProfileError>(())
//! ```

pub mod batch;
mod chain;
mod classic;
mod conditions;
pub mod effects;
#[cfg(test)]
pub(crate) mod example;
pub mod external;
mod geometry;
mod real;
mod rows;
mod sensitivity;
pub mod shape;

pub use batch::forward_batch;
pub use chain::{Chain, Frames};
pub use classic::{ClassicRow, classic};
pub use conditions::Conditions;
pub use geometry::{
    Body, Coupling, Geometry, JointSense, Link, Mechanism, UPSIDE_DOWN, set_upright,
};
pub use real::Model;
pub use rows::{Axes, RowsError};
pub use sensitivity::{FourMotions, FourSensitivities};
pub use sensitivity::{Motion, Sensitivity, Slot};

/// Number of joints of every robot here.
pub const JOINTS: usize = 6;
