//! From measurements to a robot's parameters, with honest uncertainty.
//!
//! The data flow: [`measurements`] are read and checked ([`input_checks`], as is what is made of
//! them); [`start`] finds the base in closed form; [`problem`] makes rows that [`observation`]
//! compares with a model; [`normal`] gathers normal equations in one pass; [`identifiability`] says
//! which parameters they determine; [`solver`] finds these, [`uncertainty`] and [`statistics`] say
//! what they are worth. [`calibrate`] is all of it; [`validation`] judges, [`plan`] chooses what to
//! measure, [`simulate`] makes the truth that tests find again.
//!
//! [`normal::Normal::gain`] tests a candidate effect against a solved model without solving again.
//!
//! # Example
//!
//! ```
//! use poseshift_measuring::identify::measurements::Measurements;
//! use poseshift_measuring::identify::{Options, calibrate};
//! use poseshift_kinematics::model::Conditions;
//! use poseshift_profile::{Mounted, Profile};
//!
//! let robot = Profile::from_yaml(include_str!("../../../../robots/abb_irb120_thesis.yaml"))?;
//! let nominal = Profile::from_yaml(include_str!("../../../../robots/abb_irb120.yaml"))?;
//! let conditions = Conditions::default();
//! let real = robot.real_model(&Mounted::flange(), &conditions);
//! let mut csv = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n".to_owned();
//! for k in 0..80 {
//!     let q = [1.1, 0.6, 0.5, 1.5, 1.2, 2.0];
//!     let q: [f64; 6] = std::array::from_fn(|i| q[i] * (f64::from(k) * (0.7 + 0.31 * i as f64)).sin());
//!     let place = real.forward(&q, &conditions).translation;
//!     let numbers = q.map(f64::to_degrees).into_iter().chain(place.map(|m| 1e3 * m));
//!     csv += &(numbers.map(|n| format!("{n:.6}")).collect::<Vec<_>>().join(",") + "\n");
//! }
//! let found = calibrate(&nominal, &Measurements::from_csv(csv.as_bytes())?, &Options::default())?;
//! assert!(found.solution.parameters.len() > 20);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod identifiability;
pub mod measurements;
pub(crate) mod needs;
pub mod normal;
pub mod observation;
pub mod off;
mod outlying;
pub mod parameters;
pub mod pick;
pub mod plan;
pub mod plates;
pub mod problem;
pub mod random;
pub mod robust;
pub mod simulate;
pub mod solver;
pub mod start;

pub mod base;
pub mod calibration;
mod candidates;
pub mod clock;
pub(crate) mod clusters;
pub mod contact;
mod contact_cells;
mod degrees;
mod distances;
mod error;
mod exchange;
pub mod expectation;
pub mod external;
mod fault;
pub mod holder;
mod imagined;
pub mod input_checks;
mod levelled;
mod line;
pub(crate) mod orientations;
mod pairs;
mod reading;
mod repeated;
pub mod residuals;
pub mod route;
pub mod statistics;
pub mod table;
pub mod uncertainty;
pub mod validation;

pub use base::BasePolicy;
pub use calibration::{Calibration, Options, calibrate};
pub use error::{IdentifyError, SelectionError};
pub use line::Line;
