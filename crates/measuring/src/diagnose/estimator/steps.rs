//! Effects that begin at a row: sums from the end give the products of every first row in one pass.

use super::fit::Fit;
use super::gain::{Given, Group};
use super::table::{Column, Layout, add_scaled, dot};

/// Columns that begin at a row, for each first row that is tried: the later first.
#[derive(Clone, Debug)]
pub(crate) struct Steps {
    /// First rows.
    pub rows: Vec<usize>,
    /// Products of the columns from each of those on.
    pub groups: Vec<Group>,
}

/// Rows in use, of those that the columns show in, that leave `margin` such rows on both sides, the
/// last first.
fn firsts(fit: &Fit, layout: &Layout, columns: &[Column], margin: usize) -> Vec<usize> {
    let is_used = |row: &usize| {
        let mut numbers = layout.row(*row);
        numbers.any(|n| fit.roots[n] > 0.0 && columns.iter().any(|c| c[n] != 0.0))
    };
    let used: Vec<usize> = (0..layout.rows()).rev().filter(is_used).collect();
    let count = used.len();
    let inside = used.into_iter().enumerate();
    let inside = inside.filter(|(k, _)| k + 1 >= margin && count - k > margin);
    inside.map(|(_, row)| row).collect()
}

impl Steps {
    /// Of columns that are tried, seen from a fit of those that are held.
    #[must_use]
    pub(crate) fn of(
        (fit, held): (&Fit, &[Column]),
        layout: &Layout,
        columns: &[Column],
        margin: usize,
    ) -> Self {
        let count = columns.len();
        let columns: Vec<Column> = columns.iter().map(|c| fit.weighted(c)).collect();
        let rows = firsts(fit, layout, &columns, margin);
        let mut slopes = vec![0.0; count];
        let mut gram = vec![vec![0.0; count]; count];
        let mut with_held = vec![vec![0.0; held.len()]; count];
        // what is held, number by number
        let mut across = vec![0.0; held.len()];
        let mut end = layout.numbers();
        let mut group = |row: &usize| -> Group {
            let start = layout.row(*row).start;
            for n in start..end {
                for (x, column) in across.iter_mut().zip(held) {
                    *x = fit.roots[n] * column[n];
                }
                for i in 0..count {
                    let c = columns[i][n];
                    if c == 0.0 {
                        continue;
                    }
                    slopes[i] += c * fit.left[n];
                    for j in 0..count {
                        gram[i][j] += c * columns[j][n];
                    }
                    add_scaled(&mut with_held[i], c, &across);
                }
            }
            end = start;
            let taken: Vec<Vec<f64>> = with_held.iter().map(|x| fit.forward(x)).collect();
            Group::of(gram.clone(), slopes.clone(), &taken)
        };
        let groups = rows.iter().map(&mut group).collect();
        Self { rows, groups }
    }

    /// Products of each of the columns from each first row on with those of the effects.
    #[must_use]
    pub(crate) fn cross(
        &self,
        fit: &Fit,
        layout: &Layout,
        columns: &[Column],
        given: &Given,
    ) -> Vec<Vec<Vec<f64>>> {
        let columns: Vec<Column> = columns.iter().map(|c| fit.weighted(c)).collect();
        let mut sums = vec![vec![0.0; given.partial().len()]; columns.len()];
        let mut end = layout.numbers();
        let mut of_row = |row: &usize| {
            let range = layout.row(*row).start..end;
            for (sums, column) in sums.iter_mut().zip(&columns) {
                for (sum, partial) in sums.iter_mut().zip(given.partial()) {
                    *sum += dot(&column[range.clone()], &partial[range.clone()]);
                }
            }
            end = range.start;
            sums.clone()
        };
        self.rows.iter().map(&mut of_row).collect()
    }
}
