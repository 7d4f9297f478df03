//! The module `poseshift._poseshift`: the library for Python, without a computation of its own.
//! What callers see is the package `poseshift` around it.
//!
//! Arrays are metres and radians, float64, C order; documents are the JSON of the commands.
//! Whatever computes releases the interpreter's lock.

#![forbid(unsafe_code)]
#![allow(
    clippy::needless_pass_by_value,
    clippy::trivially_copy_pass_by_ref,
    clippy::unnecessary_wraps,
    clippy::too_many_arguments,
    clippy::type_complexity,
    clippy::fn_params_excessive_bools,
    reason = "what the interpreter calls has these forms"
)]

mod arm;
mod arrays;
mod document;
mod errors;
mod measuring;
mod problem;
mod profile;
mod programs;
mod registering;
mod threads;

use pyo3::prelude::*;

/// Runs the command line, the program's own name first; the exit status.
#[pyfunction]
fn main(py: Python<'_>, arguments: Vec<String>) -> u8 {
    py.detach(|| poseshift::run_with(arguments))
}

/// Threads that computations use, up to 1024: `None` is one a core.
#[pyfunction]
#[pyo3(signature = (count=None))]
fn set_threads(count: Option<usize>) -> PyResult<()> {
    threads::set(count)
}

/// poseshift for Python.
#[pymodule(gil_used = false)]
mod _poseshift {
    #[pymodule_export]
    use super::arm::{Arm, Postures, Solutions};
    #[pymodule_export]
    use super::document::Document;
    #[pymodule_export]
    use super::measuring::{
        calibrate, changes, diagnose, measurements_of_arrays, plan, simulate, validate,
    };
    #[pymodule_export]
    use super::problem::Problem;
    #[pymodule_export]
    use super::profile::Profile;
    #[pymodule_export]
    use super::programs::{check, compensate, read_program};
    #[pymodule_export]
    use super::registering::{axes, hand_eye, hexapod, icp, register};
    #[pymodule_export]
    use super::{main, set_threads};
    use pyo3::prelude::*;

    /// The version of the library.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
