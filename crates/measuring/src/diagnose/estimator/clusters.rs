//! Rows of one configuration count together where they miss alike.

use super::table::Layout;
use crate::identify::clusters::Shared;

/// How many times the mean square of all numbers that of what configurations have in common is, of
/// residuals `left` that so many parameters were fitted to: see `Shared::design`.
#[must_use]
pub fn design(layout: &Layout, used: &[bool], left: &[f64], fitted: f64) -> f64 {
    let mut shared = Shared::default();
    for configuration in layout.configurations() {
        let rows = configuration.iter().filter(|row| used[**row]);
        let rows: Vec<&[f64]> = rows.map(|row| &left[layout.row(*row)]).collect();
        shared.add(&rows);
    }
    shared.design(fitted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::estimator::fit::Normal;
    use crate::diagnose::estimator::table::{Column, dot, noise};

    /// Three rows of each of 200 configurations, which share this part of their variance.
    fn rows(share: f64) -> (Layout, Column) {
        let numbers: Vec<usize> = (0..600).map(|row| row / 3).collect();
        let (own, common) = (noise(5, 1800), noise(6, 600));
        let of =
            |n: usize| (1.0 - share).sqrt() * own[n] + share.sqrt() * common[n / 9 * 3 + n % 3];
        let layout = Layout::even(600, 3).by_configuration(&numbers);
        (layout, (0..1800).map(of).collect())
    }

    #[test]
    fn rows_that_miss_alike_count_once() {
        // 1 + (3 - 1) · share, known to the root of 2 / 600
        for (share, expected) in [(0.0, 1.0), (0.5, 2.0), (1.0, 3.0)] {
            let (layout, left) = rows(share);
            let found = design(&layout, &[true; 600], &left, 0.0);
            assert!((found / expected - 1.0).abs() < 0.15, "{share}: {found}");
        }
    }

    #[test]
    fn single_rows_count_as_they_are() {
        let numbers: Vec<usize> = (0..30).collect();
        let layout = Layout::even(30, 3).by_configuration(&numbers);
        assert_eq!(layout, Layout::even(30, 3));
        let exactly = design(&layout, &[true; 30], &noise(3, 90), 7.0);
        assert!((exactly - 1.0).abs() < f64::EPSILON);
        // one of three rows of each configuration is in use
        let (layout, left) = rows(1.0);
        let used: Vec<bool> = (0..600).map(|row| row % 3 == 1).collect();
        let exactly = design(&layout, &used, &left, 7.0);
        assert!((exactly - 1.0).abs() < f64::EPSILON);
    }

    #[test]
    fn a_column_gains_by_configurations() {
        // a column that is the same in all rows of a configuration, as what a joint does nearly is
        let common = noise(9, 600);
        let column: Column = (0..1800).map(|n| common[n / 9 * 3 + n % 3]).collect();
        let (layout, residual) = rows(1.0);
        let single = Layout::even(600, 3);
        let used = [true; 600];
        let gain = |layout: &Layout| {
            let normal = Normal::of((layout, &used), &residual, (&[], &[]), 1e-6);
            let fit = normal.fit(&[]);
            let slope = dot(&fit.weighted(&column), &fit.left);
            slope.powi(2) / dot(&column, &column) / fit.evidence().powi(2)
        };
        let (counted, rows) = (gain(&layout), gain(&single));
        let times = rows / counted;
        assert!((times - 3.0).abs() < 0.2, "{times:?}");
    }
}
