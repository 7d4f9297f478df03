//! The command line as a user meets it: files, exit statuses, messages.

mod compensate;
mod tables;
