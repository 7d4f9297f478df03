//! From measurements to a robot's parameters, with honest uncertainty.
//!
//! The data flow: [`measurements`] are read and doubted ([`doubt`], as is what is made of them); [`start`] finds the base in closed form;
//! [`problem`] makes rows that [`observation`] compares with a model; [`normal`] gathers normal equations in one pass;
//! [`identifiability`] says which parameters they determine; [`solver`] finds these, [`uncertainty`] and [`statistics`] say
//! what they are worth. [`calibrate`] is all of it; [`validation`] judges, [`plan`] chooses what to measure,
//! [`simulate`] makes the truth that tests find again.
//!
//! [`normal::Normal::gain`] tests a candidate effect against a solved model without solving again.

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
mod candidates;
pub mod contact;
mod contact_cells;
pub mod doubt;
mod error;
mod exchange;
pub mod expectation;
mod fault;
mod imagined;
mod line;
mod pairs;
mod repeated;
pub mod route;
pub mod statistics;
pub mod uncertainty;
pub mod validation;

pub use calibration::{BasePolicy, Calibration, Options, calibrate};
pub use error::{IdentifyError, SelectionError};
pub use line::Line;
