//! What a robot program makes the robot do, and the program that makes the real robot do it.
//!
//! ```text
//! program bytes → program → motion → compensate → edits
//!                                  → check → bounds, findings
//! ```
//!
//! [`program`] reads and rewrites programs, [`motion`] follows what they do, [`compensate`]
//! finds the fake targets, [`check`] says where the real robot goes; [`finding`] is the one table
//! of what is found on the path.
//!
//! Lengths are metres and angles radians everywhere but in files and printed text.

#![forbid(unsafe_code)]

pub mod check;
pub mod compensate;
pub mod finding;
pub mod motion;
pub mod program;
pub mod xml;

use poseshift_kinematics::{geometry, inverse, model, nearest, printable};
use poseshift_profile as profile;
