//! From measurements to a robot's parameters, with honest uncertainty.

pub mod identifiability;
pub mod measurements;
pub mod normal;
pub mod observation;
pub mod parameters;
pub mod problem;
pub mod robust;
pub mod solver;
pub mod start;

mod error;
pub mod calibration;
pub mod screening;
pub mod statistics;
pub mod uncertainty;

pub use calibration::{BasePolicy, Calibration, Options, calibrate};
pub use error::{IdentifyError, SelectionError};
