//! The command line as a user meets it: files, exit statuses, messages.

mod as_they_come;
mod compensate;
mod control;
mod doubted;
mod exported;
mod external;
mod folders;
mod fuzzed;
mod hostile;
mod identify;
mod inputs;
mod jobs_and_tables_of_poses;
mod limits;
mod marked;
mod mistakes;
mod out_of_bounds;
mod outputs;
mod outputs_kept;
mod planning;
mod progress;
pub mod reports;
mod robots;
mod streams;
mod tables;
mod validating;
mod whole;
mod widths;
