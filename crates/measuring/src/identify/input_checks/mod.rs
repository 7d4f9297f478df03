//! Measurements, and what is made of them, that contradict the robot, the format or themselves:
//! never a confident wrong answer.
//!
//! [`csv`] looks at the text, [`screening`] at the rows before anything is believed (`readings` are
//! what else a file may mean), `finite` at the model of the arm, `plausibility` at a fit,
//! `validation` at a profile judged on rows, [`sweeps`] at sweeps of single joints, `temperatures` at
//! their unit.

pub mod csv;
pub(crate) mod finite;
pub(crate) mod plausibility;
mod readings;
pub mod screening;
pub mod sweeps;
pub(crate) mod temperatures;
pub(super) mod validation;

use super::error::IdentifyError;
use super::line::Line;

/// Another reading of a file must be better by this factor to be suggested; by twice as much where
/// the file as it is may be of an uncalibrated arm.
pub(super) const BETTER: f64 = 4.0;
/// The way out where nothing fits.
const NOT_OF_THIS_ROBOT: &str = "is it this robot, this tool, this order of rows? every column in \
    its unit? `poseshift calibrate --loss tukey` if single rows are wrong";
/// Residuals beyond this many of their stated standard deviations, or below one over it, are
/// reported.
const SIGMA_FACTOR: f64 = 3.0;

/// The line of what is no line's.
pub(crate) const WHOLE_FILE: usize = 0;

/// Something about the measurements that a person should look at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// Stable name in kebab-case.
    pub id: &'static str,
    /// Whether it is more than a note.
    pub warning: bool,
    /// Where in the measurements.
    pub line: Line,
    /// What was found, with the evidence.
    pub message: String,
    /// The way out; empty where there is none.
    pub hint: String,
}

fn remark(id: &'static str, line: impl Into<Line>, message: String, hint: &str) -> Remark {
    Remark {
        id,
        warning: true,
        line: line.into(),
        message,
        hint: hint.into(),
    }
}

fn suspicious(message: String, hint: &str) -> IdentifyError {
    IdentifyError::Suspicious {
        message,
        hint: hint.into(),
    }
}

/// A standard normal number is beyond this on one side once in a thousand times.
const RARELY: f64 = 3.09;

/// Residuals that are so many times their stated standard deviations, by their degrees of freedom;
/// reported where the right deviations give such a number rarely.
///
/// # Source
/// E. B. Wilson, M. M. Hilferty, *PNAS* 17 (1931) 684, for the quantiles of chi-squared.
pub(crate) fn sigma(times: f64, freedom: f64) -> Option<Remark> {
    let part = 2.0 / (9.0 * freedom);
    let quantile = |z: f64| (1.0 - part + z * part.sqrt()).max(0.0).powi(3).sqrt();
    if times > SIGMA_FACTOR.max(quantile(RARELY)) {
        let message = format!(
            "residuals are {times:.1} times the stated standard deviations: they are too small by \
             that, or the model misses something"
        );
        let hint = if times > 300.0 {
            "is sigma_mm in millimetres?"
        } else {
            "sigma_mm is one standard deviation of a coordinate; `poseshift diagnose` looks for \
             what the model misses"
        };
        return Some(remark("sigma-small", WHOLE_FILE, message, hint));
    }
    (times < SIGMA_FACTOR.recip().min(quantile(-RARELY))).then(|| {
        let message = format!(
            "residuals are {times:.3} times the stated standard deviations: they are too large by \
             a factor of {:.0}",
            times.max(1e-9).recip()
        );
        let hint = "sigma_mm is one standard deviation of a coordinate in mm, not in micrometres";
        remark("sigma-large", WHOLE_FILE, message, hint)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_degrees_of_freedom_say_little_of_stated_deviations() {
        let id = |times, freedom| sigma(times, freedom).map(|remark| remark.id);
        // chi-squared of 5 is below 0.21 once in a thousand times: 0.205 of the deviation
        assert_eq!(id(0.25, 5.0), None);
        assert_eq!(id(0.15, 5.0), Some("sigma-large"));
        assert_eq!(id(0.25, 60.0), Some("sigma-large"));
        // of 1 it is above 10.8 as rarely: 3.29 of the deviation
        assert_eq!(id(3.2, 1.0), None);
        assert_eq!(id(3.2, 60.0), Some("sigma-small"));
        assert_eq!(id(3.5, f64::INFINITY), Some("sigma-small"));
    }
}
