//! Hidden truths found again.

mod contact;
mod identify;
mod real;
