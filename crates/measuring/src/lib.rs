//! What measurements say about a robot and its cell.
//!
//! [`identify`] makes a calibrated model of them, [`diagnose`] names the effect that the model
//! lacks, [`register`] finds frames and transforms between sets of points.
//!
//! Lengths are metres and angles radians everywhere but in files and printed text.

#![forbid(unsafe_code)]

pub mod diagnose;
pub mod identify;
pub mod register;

use poseshift_kinematics::{geometry, inverse, model, nearest, printable};
use poseshift_profile as profile;
