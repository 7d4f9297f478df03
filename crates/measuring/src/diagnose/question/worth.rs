//! What a profile's calibration is worth where the arm is measured.
//!
//! Zellner's prior spreads what the calibration leaves open evenly over all that the measurements
//! see of its parameters. Rows from one part of the workspace see some directions of them well and
//! most hardly: what is open then lies in a few directions, and is larger there than a share by the
//! number of rows allows. An effect of one parameter would be found that is none.
//!
//! With the calibration's covariance Σ, of residuals of the variance v, and the columns X of its
//! parameters, metres, what is free taken from them, the predictions of the rows vary in the
//! directions of the eigenvectors of `Σ½ XᵀX Σ½ / v` by its eigenvalues: all are g where the prior
//! is exact.

use crate::diagnose::as_calibrated::{known_of, left_by_calibration};
use crate::diagnose::estimator::table::{Column, Layout};
use crate::identify::problem::{Estimate, Problem};
use crate::profile::Profile;
use nalgebra::{DMatrix, DVector};

/// By chance alone the largest eigenvalue is so many times g: a calibration from six times as many
/// numbers as it has parameters gives `(1 − √⅙)⁻² = 2.9` (V. Marchenko, L. Pastur, 1967).
const BY_CHANCE: f64 = 3.0;
/// More than this is no prior any more.
const MOST: f64 = 100.0;

/// Zellner's g with which the prior allows for all that the calibration leaves open, at least `g`.
pub(super) fn g_at_rows(
    g: f64,
    profile: &Profile,
    (problem, estimate): (&Problem, &Estimate),
    (layout, used): (&Layout, &[bool]),
    (columns, shares): (&[Column], &[f64]),
) -> f64 {
    let largest = || {
        let (subjects, covariance) = known_of(profile, estimate)?;
        let (variance_m2, _) = left_by_calibration(profile)?;
        let place = |i: usize| {
            let own = problem.parameters[i].subject;
            subjects.iter().position(|subject| *subject == own)
        };
        let known: Vec<(usize, usize)> = (0..columns.len())
            .filter(|i| shares[*i] < 1.0)
            .filter_map(|i| Some((i, place(i)?)))
            .collect();
        if known.is_empty() {
            return None;
        }
        // metres: a row counts by what its noise is
        let metres = |column: &Column| {
            let rows = (0..layout.rows()).filter(|row| used[*row]);
            let numbers = rows.flat_map(|row| {
                let sigma_m = problem.rows[row].sigma_m;
                layout.row(row).map(move |number| (number, sigma_m))
            });
            let all: Vec<f64> = numbers.map(|(at, sigma_m)| column[at] * sigma_m).collect();
            DVector::from_vec(all)
        };
        let free = (0..columns.len()).filter(|i| shares[*i] == 1.0);
        let mut basis: Vec<DVector<f64>> = Vec::new();
        let without = |basis: &[DVector<f64>], mut column: DVector<f64>| {
            for direction in basis {
                column -= direction * direction.dot(&column);
            }
            column
        };
        for i in free {
            let column = metres(&columns[i]);
            let whole = column.norm();
            let rest = without(&basis, column);
            if rest.norm() > 1e-7 * whole {
                basis.push(rest.normalize());
            }
        }
        let rest = known
            .iter()
            .map(|(i, _)| without(&basis, metres(&columns[*i])));
        let rest = DMatrix::from_columns(&rest.collect::<Vec<_>>());
        let own = DMatrix::from_fn(known.len(), known.len(), |a, b| {
            let ((i, at), (j, other)) = (known[a], known[b]);
            let scales = problem.parameters[i].scale * problem.parameters[j].scale;
            covariance[(at, other)] / scales
        });
        let eigen = own.symmetric_eigen();
        let roots = eigen.eigenvalues.map(|value| value.max(0.0).sqrt());
        let root = eigen.eigenvectors * DMatrix::from_diagonal(&roots);
        let spread = (rest * root).singular_values();
        Some(spread.max().powi(2) / variance_m2)
    };
    let needed = largest().filter(|largest| largest.is_finite());
    needed.map_or(g, |largest| (largest / BY_CHANCE).clamp(g, MOST.max(g)))
}
