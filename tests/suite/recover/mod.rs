//! Hidden truths found again.

mod identify;
mod judged;
mod kinds;
mod real;
