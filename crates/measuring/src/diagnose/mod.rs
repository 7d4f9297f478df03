//! Where simulation and measurement disagree, which effect explains it, and the residual.
//!
//! Everything is linear about the profile (or about its frames, geometry and compliance fitted
//! anew): every effect of the registry, at every joint, order, torque, time constant or row it may
//! have, is a group of columns, tested by what it gains beyond the parameters that are fitted with
//! it. Source: C. R. Rao's score test; A. Zellner's g-prior for a calibration that is trusted in
//! part; F. Liang and others (2008) for what a parameter costs.
//!
//! ```text
//! question (what the rows and the profile say) → estimator (what a column gains) → search (effects)
//!   → outside (functions that no effect is) → judgement (what may be believed) → proof (rows left
//!   out) → diagnosis (the answer)
//! ```
//!
//! # Example
//!
//! A robot whose joint 3 has backlash that its profile does not know, measured at 80 postures:
//!
//! ```
//! use poseshift_measuring::diagnose::{Options, Verdict, diagnose};
//! use poseshift_measuring::identify::measurements::Measurements;
//! use poseshift_kinematics::model::Conditions;
//! use poseshift_profile::Profile;
//!
//! let text = include_str!("../../../../robots/abb_irb120_thesis.yaml");
//! let profile = Profile::from_yaml(text)?;
//! let backlash = "  effects:\n    - {effect: backlash, joint: 3, width_deg: 0.08}\n";
//! let robot = Profile::from_yaml(&text.replace("  effects:\n", backlash))?;
//! let tool = robot.tool("artifact").expect("a tool of this profile");
//! let mut csv = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,dir1,dir2,dir3,dir4,dir5,dir6,x_mm,y_mm,z_mm,sigma_mm\n".to_owned();
//! let posture = |k: i32| -> [f64; 6] {
//!     std::array::from_fn(|i| [1.1, 0.6, 0.5, 1.5, 1.2, 2.0][i] * (f64::from(k) * (0.7 + 0.31 * i as f64)).sin())
//! };
//! for k in 1..=80 {
//!     let (q, before) = (posture(k), posture(k - 1));
//!     let direction: [f64; 6] = std::array::from_fn(|i| (q[i] - before[i]).signum());
//!     let conditions = Conditions { direction, ..Conditions::default() };
//!     let place = robot.real_model(&tool, &conditions).forward(&q, &conditions).translation;
//!     // the device reads hundredths of a millimetre
//!     let place = place.map(|m| (1e5 * m).round() / 1e2);
//!     let numbers = q.map(f64::to_degrees).into_iter().chain(direction).chain(place).chain([0.005]);
//!     csv += &(numbers.map(|n| format!("{n:.6}")).collect::<Vec<_>>().join(",") + "\n");
//! }
//! let measurements = Measurements::from_csv(csv.as_bytes())?;
//! let found = diagnose(&profile, &measurements, &Options::default(), &mut |_| ())?;
//! assert_eq!(found.verdict, Verdict::Explained);
//! assert_eq!(found.found[0].effect.label(), "backlash joint 3");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod as_calibrated;
pub mod diagnosis;
pub mod drift;
pub mod estimator;
pub mod judgement;
pub mod outside;
pub mod plates;
mod proof;
pub mod question;
pub mod search;

pub use diagnosis::{Alternative, Diagnosis, Found, NoiseSource, Options, Verdict, diagnose};
pub use estimator::refit::Changed;
pub use judgement::{Against, Standing};
pub use proof::Compared;
