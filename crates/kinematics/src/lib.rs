//! Where an arm is: poses, the model of an arm with its effects, and the inverse of that model.
//!
//! [`geometry`] knows poses and rotations and no robots; [`model`] chains, torques and effects;
//! [`inverse`] finds joints for a pose. Everything else of poseshift stands on these
//! three; they are a crate of their own so that their kernels are compiled as one unit.
//!
//! Lengths are metres and angles radians everywhere but in files and printed text.

#![forbid(unsafe_code)]

pub mod geometry;
pub mod inverse;
pub mod model;
pub mod nearest;
pub mod printable;
