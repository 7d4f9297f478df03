//! Columns that are held, made orthonormal once; weights then take a small triangle.
//!
//! Weights differ from one in few rows. With Q orthonormal on the rows in use and weights W, `W Q =
//! Q' Lᵀ` where `L Lᵀ = Qᵀ W² Q`, which is the identity less what those rows lack.
//!
//! # Source
//! G. H. Golub, C. F. Van Loan, "Matrix Computations": orthogonalisation by the Cholesky factor of
//! the products.

use super::clusters::design;
use super::fit::{Fit, Held, INVISIBLE, Projection, REDUNDANT, TURNS, scale_of};
use super::table::{Column, Layout, add_scaled, dot};
use crate::identify::robust::limit;
use std::sync::Arc;

/// Below this square a column has vanished by the weights.
const VANISHED: f64 = 1e-10;

/// The fit of columns that are held, before any row counts less than another.
#[derive(Clone, Debug)]
pub struct Plain {
    fit: Fit,
    used: Vec<bool>,
    floor: f64,
}

/// A number that counts less.
#[derive(Clone, Debug)]
struct Less {
    number: usize,
    /// By how much: one less the weight.
    by: f64,
    /// The basis there.
    across: Vec<f64>,
}

/// The same fit at some weights.
#[derive(Clone, Debug)]
pub struct Weighted {
    /// The fit.
    pub fit: Fit,
    less: Vec<Less>,
    /// L.
    lower: Vec<Vec<f64>>,
}

/// Products of a column with the basis and with itself, all rows in use counting fully.
#[derive(Clone, Debug)]
pub struct Products {
    parts: Vec<f64>,
    square: f64,
}

/// What a robust fit of columns that are sought needs, all rows counting fully.
struct Sought<'a> {
    columns: &'a [&'a [f64]],
    products: Vec<Products>,
    gram: Vec<Vec<f64>>,
    slopes: Vec<f64>,
}

/// `L⁻¹ x`.
fn forward(lower: &[Vec<f64>], x: &mut [f64]) {
    for (j, row) in lower.iter().enumerate() {
        let known = dot(&row[..j], &x[..j]);
        x[j] = (x[j] - known) / row[j];
    }
}

/// `L⁻ᵀ x`.
fn backward(lower: &[Vec<f64>], x: &mut [f64]) {
    for j in (0..x.len()).rev() {
        x[j] /= lower[j][j];
        let (known, value) = (&lower[j][..j], x[j]);
        add_scaled(&mut x[..j], -value, known);
    }
}

impl Plain {
    /// Of columns that are held; none of them is sought.
    #[must_use]
    pub fn of(layout: &Layout, used: &[bool], residual: &[f64], held: &[Held], floor: f64) -> Self {
        let mut roots = vec![0.0; layout.numbers()];
        for row in (0..layout.rows()).filter(|row| used[*row]) {
            roots[layout.row(row)].fill(1.0);
        }
        let fit = Fit::weighted(residual, held, roots);
        Self {
            fit,
            used: used.to_vec(),
            floor,
        }
    }

    /// Indices of the columns that are not redundant given those before them.
    #[must_use]
    pub fn kept(&self) -> Vec<usize> {
        self.fit.kept.clone()
    }

    /// L. Where the weights take a column away it is infinite on the diagonal.
    fn lower(&self, less: &[Less]) -> Vec<Vec<f64>> {
        let count = self.fit.basis.len();
        let mut lower: Vec<Vec<f64>> = (0..count)
            .map(|j| {
                let mut row = vec![0.0; j + 1];
                row[j] = 1.0;
                row
            })
            .collect();
        for Less { by, across, .. } in less {
            for (row, q) in lower.iter_mut().zip(across) {
                add_scaled(row, -by * q, across);
            }
        }
        for j in 0..count {
            let (above, rest) = lower.split_at_mut(j);
            let row = &mut rest[0];
            for (k, other) in above.iter().enumerate() {
                row[k] = (row[k] - dot(&row[..k], &other[..k])) / other[k];
            }
            let left = row[j] - dot(&row[..j], &row[..j]);
            row[j] = if left > VANISHED {
                left.sqrt()
            } else {
                f64::INFINITY
            };
        }
        lower
    }

    fn less(&self, roots: &[f64]) -> Vec<Less> {
        let both = roots.iter().zip(&self.fit.roots).enumerate();
        both.filter(|(_, (root, plain))| root != plain)
            .map(|(number, (root, _))| Less {
                number,
                by: 1.0 - root * root,
                across: self.fit.basis.iter().map(|q| q[number]).collect(),
            })
            .collect()
    }

    /// `L⁻¹ Qᵀ W² x` from `Qᵀ x`.
    fn parts(&self, lower: &[Vec<f64>], less: &[Less], column: &[f64], plain: &[f64]) -> Vec<f64> {
        let mut parts = plain.to_vec();
        for one in less {
            add_scaled(&mut parts, -one.by * column[one.number], &one.across);
        }
        forward(lower, &mut parts);
        parts
    }

    /// The fit at other weights.
    #[must_use]
    pub fn at(&self, residual: &[f64], roots: Column) -> Weighted {
        let less = self.less(&roots);
        let lower = self.lower(&less);
        let mut fit = self.fit.clone();
        if !less.is_empty() {
            for j in 0..fit.basis.len() {
                let (before, rest) = fit.basis.split_at_mut(j);
                let column = Arc::make_mut(&mut rest[0]);
                for Less { number, .. } in &less {
                    column[*number] *= roots[*number];
                }
                for (part, other) in lower[j].iter().zip(before.iter()) {
                    add_scaled(column, -part, other);
                }
                for x in column.iter_mut() {
                    *x /= lower[j][j];
                }
            }
            for (j, along) in fit.triangle.iter_mut().enumerate() {
                for i in 0..=j {
                    let counts = |l: &usize| *l > i || lower[i][i].is_finite() || i == j;
                    let known = (i..=j).filter(counts);
                    along[i] = known.map(|l| lower[l][i] * self.fit.triangle[j][l]).sum();
                }
            }
            fit.parts = self.parts(&lower, &less, residual, &self.fit.parts);
            let mut whole: Column = residual.iter().zip(&roots).map(|(r, w)| r * w).collect();
            fit.left.clone_from(&whole);
            fit.deviance = 0.0;
            for ((q, part), share) in fit.basis.iter().zip(&fit.parts).zip(&fit.shares) {
                add_scaled(&mut whole, -part, q);
                add_scaled(&mut fit.left, -share * part, q);
                fit.deviance += (1.0 - share) * part * part;
            }
            fit.deviance += dot(&whole, &whole);
            fit.roots = roots;
            fit.strained();
        }
        Weighted { fit, less, lower }
    }

    /// Products of a column, to be had at any weights.
    #[must_use]
    pub fn products(&self, column: &[f64]) -> Products {
        let (column, parts) = self.fit.parts_of(column);
        Products {
            parts,
            square: dot(&column, &column),
        }
    }

    /// A column seen from the fit at some weights.
    #[must_use]
    pub fn projection(&self, seen: &Weighted, column: &[f64], products: &Products) -> Projection {
        let parts = self.parts(&seen.lower, &seen.less, column, &products.parts);
        let lacks = seen.less.iter();
        let lacks = lacks.map(|one| one.by * column[one.number].powi(2));
        let square = (products.square - lacks.sum::<f64>()).max(0.0);
        let column: Column = (column.iter().zip(&seen.fit.roots))
            .map(|(c, w)| c * w)
            .collect();
        Projection {
            slope: dot(&column, &seen.fit.left),
            square,
            column,
            parts,
        }
    }

    /// Residuals on the rows in use with everything fitted at some weights, and how many parameters
    /// are free.
    fn rest(&self, residual: &[f64], sought: &Sought, less: &[Less]) -> (Column, f64) {
        let shares = &self.fit.shares;
        let lower = self.lower(less);
        let lacks = |a: &[f64], b: &[f64]| -> f64 {
            let each = less.iter();
            each.map(|one| one.by * a[one.number] * b[one.number]).sum()
        };
        let own = self.parts(&lower, less, residual, &self.fit.parts);
        let shared = |a: &[f64], b: &[f64]| -> f64 {
            let all = a.iter().zip(b).zip(shares);
            all.map(|((x, y), s)| x * y * s).sum()
        };
        let along: Vec<Vec<f64>> = (sought.columns.iter().zip(&sought.products))
            .map(|(column, products)| self.parts(&lower, less, column, &products.parts))
            .collect();
        // a triangle of those that are not redundant, in turn
        let mut kept: Vec<usize> = Vec::new();
        let mut triangle: Vec<Vec<f64>> = Vec::new();
        let mut solved: Vec<f64> = Vec::new();
        for (i, column) in sought.columns.iter().enumerate() {
            let square = sought.products[i].square - lacks(column, column);
            if square < INVISIBLE * INVISIBLE * 1e-4 {
                continue;
            }
            let mut row: Vec<f64> = Vec::with_capacity(kept.len() + 1);
            for (k, j) in kept.iter().enumerate() {
                let product = sought.gram[i][*j]
                    - lacks(column, sought.columns[*j])
                    - shared(&along[i], &along[*j]);
                row.push((product - dot(&row[..k], &triangle[k][..k])) / triangle[k][k]);
            }
            let left = square - shared(&along[i], &along[i]) - dot(&row, &row);
            if left <= REDUNDANT * square {
                continue;
            }
            let slope = sought.slopes[i] - lacks(column, residual) - shared(&along[i], &own);
            solved.push((slope - dot(&row, &solved)) / left.sqrt());
            row.push(left.sqrt());
            triangle.push(row);
            kept.push(i);
        }
        backward(&triangle, &mut solved);
        let mut parts = own;
        for (i, value) in kept.iter().zip(&solved) {
            add_scaled(&mut parts, -value, &along[*i]);
        }
        for (part, share) in parts.iter_mut().zip(shares) {
            *part *= share;
        }
        backward(&lower, &mut parts);
        let mut rest = residual.to_vec();
        for (q, part) in self.fit.basis.iter().zip(&parts) {
            add_scaled(&mut rest, -part, q);
        }
        for (i, value) in kept.iter().zip(&solved) {
            add_scaled(&mut rest, -value, sought.columns[*i]);
        }
        (rest, shares.iter().sum::<f64>() + kept.len() as f64)
    }

    /// Weights that let a wrong row count as one at the limit of what is normal.
    fn robust(&self, layout: &Layout, residual: &[f64], columns: &[&[f64]]) -> Column {
        let products: Vec<Products> = columns.iter().map(|c| self.products(c)).collect();
        let masked: Vec<Column> = columns
            .iter()
            .map(|column| {
                let both = column.iter().zip(&self.fit.roots);
                both.map(|(c, w)| c * w).collect()
            })
            .collect();
        let with = |other: &[f64]| masked.iter().map(|c| dot(c, other)).collect::<Vec<f64>>();
        let sought = Sought {
            columns,
            gram: columns.iter().map(|c| with(c)).collect(),
            slopes: with(residual),
            products,
        };
        let in_use = || (0..layout.rows()).filter(|row| self.used[*row]);
        let numbers: usize = in_use().map(|row| layout.row(row).len()).sum();
        let mut roots = self.fit.roots.clone();
        let mut last = f64::INFINITY;
        for _ in 0..TURNS {
            let less = self.less(&roots);
            let (rest, free) = self.rest(residual, &sought, &less);
            let freedom = numbers as f64 - free;
            let scale = scale_of(layout, &self.used, &rest, freedom).max(self.floor);
            let mut clipped = 0;
            let mut next = roots.clone();
            for row in in_use() {
                let range = layout.row(row);
                let length = dot(&rest[range.clone()], &rest[range.clone()]).sqrt();
                let most = limit(range.len()) * scale;
                let root = if length > most { most / length } else { 1.0 };
                clipped += usize::from(root < 1.0);
                next[range].fill(root);
            }
            if clipped == 0 && less.is_empty() {
                break;
            }
            roots = next;
            if (scale / last - 1.0).abs() < 1e-3 {
                break;
            }
            last = scale;
        }
        roots
    }

    /// The robust fit of columns that are sought given those held, and the fit of those held at
    /// its weights and scale.
    ///
    /// Weights are one up to the length that 99.7 % of normal rows stay below, and fall with the
    /// square beyond it, so that a gross error counts as one row at the limit, whatever its
    /// size.
    #[must_use]
    pub fn fits(
        &self,
        layout: &Layout,
        residual: &[f64],
        columns: &[&[f64]],
        first: usize,
    ) -> (Weighted, Fit) {
        let mut held = self.at(residual, self.robust(layout, residual, columns));
        let mut full = held.fit.clone();
        for (k, column) in columns.iter().enumerate() {
            full.seek(first + k, column);
        }
        full.strained();
        // the spread of what counts, by the mean where weights let it
        let weight: f64 = full.roots.iter().map(|r| r * r).sum();
        let free: f64 = full.shares.iter().filter(|s| **s == 1.0).sum();
        full.freedom = (weight - free).max(1.0);
        let mean = (full.deviance / full.freedom).sqrt();
        // normal rows beyond the limit are cut: their part of the mean square is small
        full.scale = mean.max(self.floor).max(1e-12);
        full.floor = self.floor;
        full.design = design(layout, &self.used, &full.left, full.shares.iter().sum());
        // so many numbers that tell as much as these
        full.freedom = (weight / full.design - free).max(1.0);
        (held.fit.scale, held.fit.freedom, held.fit.floor) = (full.scale, full.freedom, full.floor);
        held.fit.design = full.design;
        (held, full)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::estimator::table::noise;

    fn held(columns: &[Column]) -> Vec<Held<'_>> {
        let shares = [1.0, 1.0, 0.4, 0.1];
        let each = columns.iter().zip(shares.iter().cycle());
        each.map(|(column, share)| Held {
            column,
            share: *share,
            sought: false,
        })
        .collect()
    }

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-9 * (1.0 + a.abs())
    }

    #[test]
    fn weights_by_a_triangle_are_those_of_a_basis_made_anew() {
        let layout = Layout::even(30, 3);
        let columns: Vec<Column> = (1..9).map(|seed| noise(seed, 90)).collect();
        let held = held(&columns);
        let residual = noise(20, 90);
        let mut used = vec![true; 30];
        used[7] = false;
        let plain = Plain::of(&layout, &used, &residual, &held, 0.1);
        let tried = noise(31, 90);
        let products = plain.products(&tried);
        for weighted in [vec![], vec![3], vec![0, 12, 29]] {
            let mut roots = plain.fit.roots.clone();
            for (k, row) in weighted.iter().enumerate() {
                roots[layout.row(*row)].fill(0.9 / (1.0 + 30.0 * k as f64));
            }
            let anew = Fit::weighted(&residual, &held, roots.clone());
            let seen = plain.at(&residual, roots);
            assert!(near(anew.deviance, seen.fit.deviance));
            assert!(near(anew.strain.0, seen.fit.strain.0));
            let count = held.len();
            for (a, b) in anew.values(count).iter().zip(seen.fit.values(count)) {
                assert!(near(*a, b), "{a} {b}");
            }
            for (a, b) in anew.left.iter().zip(&seen.fit.left) {
                assert!(near(*a, *b));
            }
            let of = &anew.projections(std::slice::from_ref(&tried))[0];
            let quick = plain.projection(&seen, &tried, &products);
            assert!(near(of.slope, quick.slope) && near(of.square, quick.square));
            assert!(near(anew.product(of, of), seen.fit.product(&quick, &quick)));
        }
    }

    #[test]
    fn a_column_that_a_weight_takes_away_stays_out() {
        let layout = Layout::even(10, 3);
        let mut columns = vec![noise(1, 30), vec![0.0; 30], noise(2, 30)];
        // a parameter of one row alone
        columns[1][12..15].fill(1.0);
        let held: Vec<Held> = held(&columns);
        let mut residual = noise(5, 30);
        residual[12..15].fill(1e9);
        let plain = Plain::of(&layout, &[true; 10], &residual, &held, 0.1);
        let mut roots = vec![1.0; 30];
        roots[12..15].fill(1e-7);
        let seen = plain.at(&residual, roots).fit;
        let values = seen.values(3);
        assert!(values.iter().all(|v| v.is_finite()), "{values:?}");
        assert!(values[1] == 0.0 && seen.left.iter().all(|x| x.is_finite()));
        let without = [held[0], held[2]];
        let others = Fit::weighted(&residual, &without, seen.roots.clone()).values(2);
        assert!((values[0] - others[0]).abs() < 1e-3 && (values[2] - others[1]).abs() < 1e-3);
    }

    #[test]
    fn a_gross_error_counts_as_a_row_at_the_limit() {
        let layout = Layout::even(60, 3);
        let columns: Vec<Column> = (1..5).map(|seed| noise(seed, 180)).collect();
        let clean = noise(9, 180);
        let sought = noise(40, 180);
        let residual = |gross: f64| -> Column {
            let mut all: Column = clean
                .iter()
                .zip(&sought)
                .map(|(x, s)| x + 2.0 * s)
                .collect();
            all[30] += gross;
            all
        };
        let held = held(&columns);
        let value = |gross: f64| {
            let residual = residual(gross);
            let plain = Plain::of(&layout, &[true; 60], &residual, &held, 1e-6);
            let (base, full) = plain.fits(&layout, &residual, &[&sought], held.len());
            assert!(near(base.fit.scale, full.scale) && base.fit.roots == full.roots);
            (full.values(held.len() + 1)[held.len()], full.scale)
        };
        let (plain, scale) = value(0.0);
        assert!((plain - 2.0).abs() < 0.2, "{plain}");
        for gross in [1e2, 1e6] {
            let (moved, other) = value(gross);
            assert!((moved - plain).abs() < 0.1, "{gross}: {moved} {plain}");
            assert!((other / scale - 1.0).abs() < 0.2, "{gross}: {other}");
        }
    }
}
