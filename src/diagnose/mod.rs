//! Where simulation and measurement disagree, which effect explains it, and what is left.
//!
//! Everything is linear about the profile (or about its frames, geometry and compliance fitted anew): every effect of the
//! registry, at every joint, order, torque, time constant or row it may have, is a group of columns, tested by what it gains
//! beyond the parameters that are fitted with it. Source: C. R. Rao's score test; A. Zellner's g-prior for a calibration
//! that is trusted in part; G. Schwarz (1978) for the information criterion.

mod attempt;
pub mod beside;
pub mod candidates;
pub mod chances;
mod conclusion;
pub mod diagnosis;
pub mod fit;
mod improved;
mod judgement;
pub mod noise;
pub mod poses;
mod proof;
pub mod refit;
mod scan;
pub mod search;
pub mod session;
pub mod stand_ins;
mod steps;
pub mod table;
pub mod unknown;
mod waves;
pub mod weights;
pub mod whereabouts;

pub use diagnosis::{Diagnosis, Found, NoiseSource, Options, Rival, Verdict, diagnose};
pub use judgement::{Against, Standing};
pub use proof::Compared;
