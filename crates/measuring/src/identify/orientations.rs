//! How sure orientations are of which no column says it: by what they scatter.
//!
//! # Source
//! W. Förstner, "Ein Verfahren zur Schätzung von Varianz- und Kovarianzkomponenten" (1979): the
//! squares of each sort of numbers over their redundancy, until the weights rest.

use super::measurements::{Measurements, Observed};
use super::normal::Normal;
use super::parameters::Parameter;
use super::problem::{Problem, Row};
use super::robust::{Loss, scale_of};
use super::solver::Solution;
use std::sync::Arc;

/// Rounds of weights at most, and the change at which they rest.
pub(super) const TURNS: usize = 6;
pub(super) const AT_REST: f64 = 0.02;
/// Fewer degrees of freedom than this of places or of orientations say nothing of their noise.
const FEWEST: f64 = 15.0;
/// What misses by more standard deviations than this is no noise.
const CLIPPED: f64 = 4.0;
/// Numbers of a place, and of an orientation.
const EACH: usize = 3;
/// So many times less sure an orientation hardly counts.
const HARDLY: f64 = 1e6;

/// Whether a row is a pose of whose orientation no column says how sure it is.
pub(crate) fn is_unsure(row: &Row, measurements: &Measurements) -> bool {
    matches!(row.observed, Observed::Pose(_))
        && measurements.rows[row.measurement].sigma_rad.is_none()
}

/// The mean square that some numbers have, a wrong row not more than one that is far off, over their
/// redundancy.
fn mean_square(squares: &[f64], leverage: f64) -> Option<f64> {
    let numbers = (EACH * squares.len()) as f64;
    let redundancy = numbers - leverage;
    if redundancy < FEWEST {
        return None;
    }
    let scale = scale_of(squares, squares.iter().map(|_| EACH));
    let most = EACH as f64 * (CLIPPED * scale).powi(2);
    let sum: f64 = squares.iter().map(|squared| squared.min(most)).sum();
    Some(sum / redundancy)
}

/// So many times the standard deviation that such orientations have makes them as sure as they are
/// by what a solution leaves of them; `None` where there are none, or too few.
pub(super) fn rescaled(
    problem: &Problem,
    measurements: &Measurements,
    solution: &Solution,
) -> Option<f64> {
    let unsure = problem.with_rows(|i| is_unsure(&problem.rows[i], measurements));
    if unsure.rows.is_empty() {
        return None;
    }
    let parameters: Vec<Parameter> = (solution.parameters.iter())
        .map(|parameter| Parameter {
            prior: None,
            ..parameter.clone()
        })
        .collect();
    let of =
        |problem: &Problem| Normal::of(problem, &solution.estimate, &parameters, Loss::squares());
    let both = of(&unsure);
    let mut places = unsure;
    scale(&mut places, measurements, HARDLY);
    let places = of(&places);
    let inverse = solution.normal.matrix.clone().cholesky()?.inverse();
    let leverage = |matrix: &nalgebra::DMatrix<f64>| inverse.dot(matrix);
    let of_places = leverage(&places.matrix);
    let of_orientations = leverage(&both.matrix) - of_places;
    let squares = both.squares.iter().zip(&places.squares);
    let turned: Vec<f64> = squares
        .map(|(both, place)| (both - place).max(0.0))
        .collect();
    let orientations = mean_square(&turned, of_orientations)?;
    // where a column states the noise of places and they have less, so may have orientations
    let least = if problem.sigma_assumed { 0.0 } else { 1.0 };
    let noise = mean_square(&places.squares, of_places)?.max(least);
    let times = (orientations / noise).sqrt();
    (times.is_finite() && times > 0.0).then_some(times)
}

/// Gives such orientations so many times the standard deviation they have.
pub(super) fn scale(problem: &mut Problem, measurements: &Measurements, times: f64) {
    let rows = Arc::make_mut(&mut problem.rows).iter_mut();
    for row in rows.filter(|row| is_unsure(row, measurements)) {
        row.sigma_rad *= times;
    }
}
