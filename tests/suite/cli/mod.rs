//! The command line as a user meets it: files, exit statuses, messages.

mod compensate;
mod fuzzed;
mod hostile;
mod identify;
mod jobs_and_tables_of_poses;
mod limits;
mod outputs;
mod planning;
pub mod reports;
mod robots;
mod tables;
mod validating;
mod widths;
