//! Hidden truths found again.

mod contact;
mod doubts;
mod identify;
mod judged;
mod kinds;
mod real;
