//! Effects that begin at a row: sums from the end give the products of every first row in one pass.

use super::fit::Fit;
use super::given::{Given, Group};
use super::table::{Column, Layout, add_scaled};

/// Columns that begin at a row, for each first row that is tried: the later first.
#[derive(Clone, Debug)]
pub(crate) struct Steps {
    /// How many columns.
    count: usize,
    /// First rows.
    pub rows: Vec<usize>,
    /// Products of the columns from each of those on, one after the other: the Gram matrix, the
    /// slopes, the squares.
    products: Vec<f64>,
}

/// Products of each column with those of the effects, from each first row on.
#[derive(Debug)]
pub(crate) struct Cross {
    effects: usize,
    products: Vec<f64>,
}

/// Numbers times the roots of their weights.
fn weighted(column: &mut Column, fit: &Fit) {
    for (c, w) in column.iter_mut().zip(&fit.roots) {
        *c *= w;
    }
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
    pub(crate) fn of(fit: &Fit, layout: &Layout, mut columns: Vec<Column>, margin: usize) -> Self {
        let count = columns.len();
        for column in &mut columns {
            weighted(column, fit);
        }
        let rows = firsts(fit, layout, margin);
        let mut slopes = vec![0.0; count];
        let mut gram = vec![vec![0.0; count]; count];
        let mut along = vec![vec![0.0; fit.basis.len()]; count];
        // the basis, number by number
        let mut across = vec![0.0; fit.basis.len()];
        let mut products = Vec::with_capacity(rows.len() * count * (count + 2));
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
            for i in 0..count {
                for j in 0..count {
                    let (a, b) = (i.max(j), i.min(j));
                    let parts = along[a].iter().zip(&along[b]).zip(&fit.shares);
                    let held: f64 = parts.map(|((x, y), s)| x * y * s).sum();
                    products.push(gram[a][b] - held);
                }
            }
            products.extend(&slopes);
            products.extend((0..count).map(|i| gram[i][i]));
        }
        Self {
            count,
            rows,
            products,
        }
    }

    /// Products of the columns from the k-th first row on.
    #[must_use]
    pub(crate) fn group(&self, k: usize) -> Group {
        let each = self.count * (self.count + 2);
        let own = &self.products[k * each..][..each];
        let (gram, rest) = own.split_at(self.count * self.count);
        let (slopes, squares) = rest.split_at(self.count);
        let gram = gram.chunks(self.count).map(<[f64]>::to_vec).collect();
        Group::known(gram, slopes.to_vec(), squares.to_vec())
    }

    /// Products of each of its columns with those of the effects, for each first row.
    #[must_use]
    pub(crate) fn cross(
        &self,
        fit: &Fit,
        layout: &Layout,
        mut columns: Vec<Column>,
        given: &Given,
    ) -> Cross {
        for column in &mut columns {
            weighted(column, fit);
        }
        let turned = given.turned();
        let effects = turned.len();
        let mut sums = vec![0.0; effects * columns.len()];
        let mut products = Vec::with_capacity(sums.len() * self.rows.len());
        let mut end = layout.numbers();
        for row in &self.rows {
            let start = layout.row(*row).start;
            let pairs = columns
                .iter()
                .flat_map(|c| turned.iter().map(move |t| (c, t)));
            for (sum, (column, turned)) in sums.iter_mut().zip(pairs) {
                let own = column[start..end].iter().zip(&turned[start..end]);
                *sum += own.map(|(c, t)| c * t).sum::<f64>();
            }
            end = start;
            products.extend(&sums);
        }
        Cross { effects, products }
    }
}

impl Cross {
    /// Those of a number of columns from the k-th first row on.
    #[must_use]
    pub(crate) fn of_row(&self, k: usize, columns: usize) -> Vec<&[f64]> {
        let column = |i: usize| &self.products[(k * columns + i) * self.effects..][..self.effects];
        (0..columns).map(column).collect()
    }
}
