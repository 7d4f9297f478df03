//! Rows that miss by far more than most others do.

use super::calibration::Outlier;
use super::measurements::Measurements;
use super::off::Off;
use super::problem::Problem;
use super::robust::{limit, scale_of};
use super::solver::Solution;
use super::statistics::Miss;

/// A row is an outlier whose residual is beyond this many times the limit of normal ones.
const OUTLIER: f64 = 1.6;
/// Residuals below this are nobody's outliers, metres.
const SMALL_M: f64 = 1e-6;

/// Those of a fit, with the weights that they had.
pub(super) fn of_fit(
    problem: &Problem,
    measurements: &Measurements,
    solution: &Solution,
    misses: &[Miss],
) -> Vec<Outlier> {
    let weight = |squared, count| solution.loss.of(squared, count).1;
    let squares = &solution.normal.squares;
    outliers(problem, measurements, (squares, misses), weight)
}

/// Those of rows that no parameter follows.
pub(super) fn of_judged(
    problem: &Problem,
    measurements: &Measurements,
    misses: &[Miss],
) -> Vec<Outlier> {
    let all = problem.rows.iter().zip(misses);
    let squares = all.map(|(row, miss)| miss.normalised.powi(2) * row.observed.count() as f64);
    let squares: Vec<f64> = squares.collect();
    outliers(problem, measurements, (&squares, misses), |_, _| 1.0)
}

fn outliers(
    problem: &Problem,
    measurements: &Measurements,
    (squares, misses): (&[f64], &[Miss]),
    weight: impl Fn(f64, usize) -> f64,
) -> Vec<Outlier> {
    let counts = problem.rows.iter().map(|row| row.observed.count());
    let scale = scale_of(squares, counts);
    let mut found = Vec::new();
    for ((row, miss), squared) in problem.rows.iter().zip(misses).zip(squares) {
        let count = row.observed.count();
        let typical = scale * (count as f64).sqrt();
        let most = OUTLIER * limit(count) * scale;
        let off = Off::of(row, miss);
        if squared.sqrt() > most && off.size_m() > SMALL_M {
            let m = &measurements.rows[row.measurement];
            found.push(Outlier {
                measurement: row.measurement,
                line: m.line.clone(),
                id: m.id.clone(),
                off,
                times: squared.sqrt() / typical,
                limit: most / typical,
                weight: weight(*squared, count),
            });
        }
    }
    found.sort_by(|a, b| b.times.total_cmp(&a.times));
    found
}
