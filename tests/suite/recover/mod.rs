//! Hidden truths found again.

mod contact;
mod controller;
mod generated;
mod identify;
mod input_checks;
mod judged;
mod kinds;
mod real;
