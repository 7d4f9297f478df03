//! Makes an offline-programmed robot path land where the simulation wanted it.
//!
//! An industrial arm repeats to hundredths of a millimetre but misses by millimetres, because its
//! controller computes with a nominal model. This library rewrites each target of a robot program
//! into a *fake target* with which the nominal controller brings the real tool to the wanted pose:
//!
//! ```text
//! program bytes → targets → (profile, frames) → fake targets → findings → edits + report
//! ```
//!
//! [`compensate()`](compensate::compensate) is the main job; [`program`] reads and rewrites
//! programs, [`model`] says where the real tool is, [`inverse`] finds joints for a pose,
//! [`geometry`] is what they compute with.
//!
//! Lengths are metres and angles radians everywhere but in files and printed text.
//!
//! # Features
//!
//! `cli` (default) is the command line and brings all others, `html` (default) the texts and pages
//! of results; the library needs neither. `urdf` reads and writes URDF files, `icp` registers
//! clouds of points by nearness, `mesh` reads STL, OBJ, COLLADA and glTF. What each command does is
//! in [`task`]; `examples/` has one program a task.
//!
//! # Example
//!
//! ```
//! use poseshift::model::{Conditions, profile::Profile};
//!
//! let profile = Profile::from_yaml(include_str!("../robots/abb_irb120_thesis.yaml"))?;
//! let tool = profile.tool("artifact").expect("a tool of this profile");
//! let q = [0.0, 0.3, 0.2, 0.0, 1.0, 0.0];
//! let controller = profile.controller_model(&tool).forward(&q, &Conditions::default());
//! let real = profile.real_model(&tool, &Conditions::default()).forward(&q, &Conditions::default());
//! assert!(real.separation(&controller).distance_m > 0.5e-3);
//! # Ok::<(), poseshift::model::profile::ProfileError>(())
//! ```

#![forbid(unsafe_code)]
#![warn(unreachable_pub)]

#[doc(inline)]
pub use poseshift_kinematics::{geometry, inverse};
#[doc(inline)]
pub use poseshift_measuring::{diagnose, identify, register};
#[doc(inline)]
pub use poseshift_programs::{check, compensate, finding, motion, program};

/// Where a robot's tool is: the nominal chain, every physical cause that makes the real one differ,
/// and the profile of one robot.
pub mod model {
    pub use poseshift_kinematics::model::*;
    #[doc(inline)]
    pub use poseshift_profile as profile;
}

#[cfg(feature = "cli")]
mod cli;
#[cfg(feature = "html")]
#[cfg_attr(
    not(feature = "cli"),
    allow(
        dead_code,
        reason = "the command line alone lays texts out for a terminal"
    )
)]
mod report;
pub mod task;
#[cfg(feature = "urdf")]
pub mod urdf;

use poseshift_kinematics::{nearest, printable};
#[cfg(feature = "urdf")]
use poseshift_programs::xml;

#[cfg(feature = "cli")]
pub use cli::run_with;
#[cfg(feature = "html")]
pub use report::{Drawing, Readable, check_html, check_junit, check_words, compensation_words};
