//! The tests that look at the program from outside, in one binary.

mod laws;
mod oracle;
mod support;
