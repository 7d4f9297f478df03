//! Hidden truths found again.

mod identify;
mod real;
