//! Cholesky factors that grow column by column: how all normal equations here are solved.

use super::table::{add_scaled, dot};

/// `L Lᵀ` of the products of columns, those left out that are redundant given the ones before.
#[derive(Clone, Debug, Default)]
pub(crate) struct Factor {
    /// Which columns, in their order.
    pub kept: Vec<usize>,
    /// The rows of L.
    pub rows: Vec<Vec<f64>>,
}

impl Factor {
    /// `L⁻¹ x` for the products x of a column with the others.
    #[must_use]
    pub(crate) fn forward(&self, products: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut solved: Vec<f64> = Vec::with_capacity(self.kept.len() + 1);
        for (k, (row, column)) in self.rows.iter().zip(&self.kept).enumerate() {
            let known = dot(&row[..k], &solved);
            solved.push((products(*column) - known) / row[k]);
        }
        solved
    }

    /// `L⁻ᵀ z` of the first so many columns.
    #[must_use]
    pub(crate) fn backward(&self, z: &[f64]) -> Vec<f64> {
        let mut x = z.to_vec();
        for j in (0..x.len()).rev() {
            let (before, rest) = x.split_at_mut(j);
            rest[0] /= self.rows[j][j];
            add_scaled(before, -rest[0], &self.rows[j][..j]);
        }
        x
    }

    /// Adds a column by its products with the others and with itself, unless no more than `least`
    /// of its square is left given them. What is left is the Schur complement; `ridge` is added to
    /// it.
    pub(crate) fn add(
        &mut self,
        column: usize,
        products: impl Fn(usize) -> f64,
        (least, ridge): (f64, f64),
    ) {
        let mut row = self.forward(&products);
        let left = products(column) - dot(&row, &row);
        if left > least {
            row.push((left + ridge).sqrt());
            self.kept.push(column);
            self.rows.push(row);
        }
    }

    /// The root of the inverse's diagonal: a parameter's standard deviation where the noise is one.
    #[must_use]
    pub(crate) fn deviation(&self, column: usize) -> f64 {
        if !self.kept.contains(&column) {
            return f64::INFINITY;
        }
        let along = self.forward(|other| f64::from(u8::from(other == column)));
        dot(&along, &along).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn a_factor_solves_and_leaves_out_what_is_redundant() {
        // the third column is the sum of the first two
        let columns = [
            [2.0, 1.0, 0.0],
            [0.0, 1.0, 1.0],
            [2.0, 2.0, 1.0],
            [1.0, 0.0, 3.0],
        ];
        let product = |a: usize, b: usize| dot(&columns[a], &columns[b]);
        let mut factor = Factor::default();
        for column in 0..4 {
            factor.add(column, |other| product(column, other), (1e-9, 0.0));
        }
        assert_eq!(factor.kept, [0, 1, 3]);
        let matrix = DMatrix::from_fn(3, 3, |i, j| product(factor.kept[i], factor.kept[j]));
        let wanted = DVector::from_vec(vec![1.0, -2.0, 0.5]);
        let solved = factor.backward(&factor.forward(|c| [1.0, -2.0, 0.0, 0.5][c]));
        assert!((matrix.clone() * DVector::from_vec(solved) - wanted).norm() < 1e-12);
        let inverse = matrix
            .try_inverse()
            .expect("three columns in three numbers");
        for (k, column) in factor.kept.iter().enumerate() {
            let expected = inverse[(k, k)].sqrt();
            assert!((factor.deviation(*column) - expected).abs() < 1e-12);
        }
        assert!(factor.deviation(2).is_infinite());
    }
}
