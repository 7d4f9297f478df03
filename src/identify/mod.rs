//! From measurements to a robot's parameters, with honest uncertainty.

pub mod identifiability;
pub mod measurements;
pub mod normal;
pub mod observation;
pub mod parameters;
pub mod plan;
pub mod problem;
pub mod random;
pub mod robust;
pub mod simulate;
pub mod solver;
pub mod start;

pub mod calibration;
mod error;
pub mod screening;
pub mod statistics;
pub mod uncertainty;
pub mod validation;

pub use calibration::{BasePolicy, Calibration, Options, calibrate};
pub use error::{IdentifyError, SelectionError};
