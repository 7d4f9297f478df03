//! Effects that begin at a row: sums from the end give the products of every first row in one pass.

use super::fit::Fit;
use super::given::{Given, Group};
use super::table::{Column, Layout, add_scaled};

/// Columns that begin at a row, for each first row that is tried: the later first.
#[derive(Clone, Debug)]
pub(super) struct Steps {
    /// Weighted columns from row 1 on.
    columns: Vec<Column>,
    /// First rows.
    pub rows: Vec<usize>,
    /// Products of the columns from each of those on.
    pub groups: Vec<Group>,
}

/// Rows in use that leave `margin` rows in use on both sides, the last first.
fn firsts(fit: &Fit, layout: &Layout, margin: usize) -> Vec<usize> {
    let is_used = |row: &usize| fit.roots[layout.row(*row)].iter().any(|r| *r > 0.0);
    let used: Vec<usize> = (0..layout.rows()).rev().filter(is_used).collect();
    let count = used.len();
    let inside = used.into_iter().enumerate();
    let inside = inside.filter(|(k, _)| k + 1 >= margin && count - k > margin);
    inside.map(|(_, row)| row).collect()
}

impl Steps {
    /// Of columns, seen from a fit without effects.
    #[must_use]
    pub(super) fn of(fit: &Fit, layout: &Layout, columns: &[Column], margin: usize) -> Self {
        let count = columns.len();
        let weighted = |c: &Column| c.iter().zip(&fit.roots).map(|(c, w)| c * w).collect();
        let columns: Vec<Column> = columns.iter().map(weighted).collect();
        let rows = firsts(fit, layout, margin);
        let mut slopes = vec![0.0; count];
        let mut gram = vec![vec![0.0; count]; count];
        let mut along = vec![vec![0.0; fit.basis.len()]; count];
        // the basis, number by number
        let mut across = vec![0.0; fit.basis.len()];
        let mut groups = Vec::with_capacity(rows.len());
        let mut end = layout.numbers();
        for row in &rows {
            let start = layout.row(*row).start;
            for n in start..end {
                for (q, column) in across.iter_mut().zip(&fit.basis) {
                    *q = column[n];
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
                    add_scaled(&mut along[i], c, &across);
                }
            }
            end = start;
            let squares = (0..count).map(|i| gram[i][i]).collect();
            let mut rest = gram.clone();
            for i in 0..count {
                for j in 0..=i {
                    let parts = along[i].iter().zip(&along[j]).zip(&fit.shares);
                    rest[i][j] -= parts.map(|((x, y), s)| x * y * s).sum::<f64>();
                    rest[j][i] = rest[i][j];
                }
            }
            groups.push(Group::known(rest, slopes.clone(), squares));
        }
        Self {
            columns,
            rows,
            groups,
        }
    }

    /// Products of each column with those of the effects, for each first row.
    #[must_use]
    pub(super) fn cross(&self, layout: &Layout, given: &Given) -> Vec<Vec<Vec<f64>>> {
        let turned = given.turned();
        let mut sums = vec![vec![0.0; turned.len()]; self.columns.len()];
        let mut end = layout.numbers();
        let each = self.rows.iter().map(|row| {
            let start = layout.row(*row).start;
            for (sums, column) in sums.iter_mut().zip(&self.columns) {
                for (sum, turned) in sums.iter_mut().zip(turned) {
                    let own = column[start..end].iter().zip(&turned[start..end]);
                    *sum += own.map(|(c, t)| c * t).sum::<f64>();
                }
            }
            end = start;
            sums.clone()
        });
        each.collect()
    }
}
