//! Makes an offline-programmed robot path land where the simulation wanted it.
#![allow(missing_docs)]
pub mod cli;
pub mod compensate;
pub mod finding;
pub mod geometry;
pub mod inverse;
pub mod model;
pub mod program;
pub mod report;
