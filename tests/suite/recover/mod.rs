//! Hidden truths found again.

mod contact;
mod identify;
mod judged;
mod kinds;
mod real;
