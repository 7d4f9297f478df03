//! The tests that look at the program from outside, in one binary.

mod architecture;
mod check;
mod cli;
mod diagnose;
mod documents;
mod examples;
mod external;
mod features;
mod findings;
mod golden;
mod laws;
mod motion;
mod oracle;
mod path;
#[path = "../physics/mod.rs"]
mod physics;
mod recover;
mod register;
mod report;
mod shapes;
mod support;
#[path = "../trial/mod.rs"]
#[allow(dead_code, reason = "the example prints more of it")]
mod trial;
mod walk;
