//! The tests that look at the program from outside, in one binary.

mod architecture;
mod cli;
mod documents;
mod golden;
mod laws;
mod oracle;
mod path;
mod recover;
mod support;
