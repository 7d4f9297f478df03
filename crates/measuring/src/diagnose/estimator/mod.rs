//! Generalised least squares, robustly weighted: what is fitted along, and what a column would gain
//! beyond it.
//!
//! `table` (residuals and columns) → `weights` (what is held, at any weights) → `fit` (the fit) →
//! `given` and `steps` (what columns gain given effects) → `refit` (values, not linearised).

pub mod chances;
pub mod clusters;
pub mod fit;
pub mod given;
pub mod refit;
pub(crate) mod steps;
pub mod table;
pub mod weights;
