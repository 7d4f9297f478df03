//! Generalised least squares, robustly weighted: what is fitted along, and what a column would gain
//! beyond it.
//!
//! `table` (residuals and columns) → `fit` (normal equations with priors, by a `factor`) → `gain`
//! and `steps` (score tests, effects in the model that come and go) → `refit` (values, not
//! linearised).

pub mod chances;
pub mod clusters;
mod factor;
pub mod fit;
pub mod gain;
pub mod refit;
pub(crate) mod steps;
pub mod table;
