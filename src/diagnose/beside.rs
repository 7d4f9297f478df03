//! What columns gain beside effects that come and go: products with the effects' columns are made once, and every choice of
//! effects that are kept takes a small triangle only.

use super::fit::{Fit, Gain, Projection, REDUNDANT, gain_of};
use super::table::{Column, dot};

/// Effects in the model, seen from a fit of everything else.
#[derive(Clone, Debug)]
pub struct Beside {
    deviance: f64,
    scale: f64,
    ridge: f64,
    /// Columns of the effects times the fit's M.
    turned: Vec<Column>,
    owners: Vec<usize>,
    squares: Vec<f64>,
    slopes: Vec<f64>,
    gram: Vec<Vec<f64>>,
}

/// Which effects are kept, and the triangle of their products.
#[derive(Clone, Debug)]
pub struct Kept {
    columns: Vec<usize>,
    triangle: Vec<Vec<f64>>,
    parts: Vec<f64>,
}

/// Products of a group of columns that is tried.
#[derive(Clone, Debug)]
pub struct Group {
    gram: Vec<Vec<f64>>,
    slopes: Vec<f64>,
    squares: Vec<f64>,
}

impl Group {
    /// Of columns seen from the fit of everything but effects.
    #[must_use]
    pub fn of(fit: &Fit, columns: &[&Projection]) -> Self {
        let each = |a: &&Projection| columns.iter().map(|b| fit.product(a, b)).collect();
        Self {
            gram: columns.iter().map(each).collect(),
            slopes: columns.iter().map(|p| p.slope).collect(),
            squares: columns.iter().map(|p| p.square).collect(),
        }
    }
}

impl Beside {
    /// Of a fit without effects, at the scale of `full`, the fit with all of them.
    #[must_use]
    pub fn of(fit: &Fit, full: &Fit, effects: &[&[Column]]) -> Self {
        let mut owners = Vec::new();
        let mut columns = Vec::new();
        for (owner, own) in effects.iter().enumerate() {
            owners.extend(own.iter().map(|_| owner));
            columns.extend(own.iter().cloned());
        }
        let seen = fit.projections(&columns);
        let turned: Vec<Column> = seen.iter().map(|p| fit.turned(p)).collect();
        let products = |t: &Column| seen.iter().map(|p| dot(t, &p.column)).collect();
        Self {
            deviance: fit.deviance,
            scale: full.scale,
            ridge: full.ridge(),
            gram: turned.iter().map(products).collect(),
            squares: seen.iter().map(|p| p.square).collect(),
            slopes: seen.iter().map(|p| p.slope).collect(),
            turned,
            owners,
        }
    }

    /// Products of a column with those of the effects.
    #[must_use]
    pub fn cross(&self, column: &Projection) -> Vec<f64> {
        let products = self.turned.iter().map(|t| dot(t, &column.column));
        products.collect()
    }

    /// Some of the effects: one flag for each.
    #[must_use]
    pub fn kept(&self, keep: &[bool]) -> Kept {
        let mut kept = Kept {
            columns: Vec::new(),
            triangle: Vec::new(),
            parts: Vec::new(),
        };
        for column in (0..self.owners.len()).filter(|c| keep[self.owners[*c]]) {
            let mut row = kept.solved(&self.gram[column]);
            let left = self.gram[column][column] - dot(&row, &row);
            if left <= REDUNDANT * self.squares[column] {
                continue;
            }
            let part = (self.slopes[column] - dot(&row, &kept.parts)) / left.sqrt();
            row.push(left.sqrt());
            kept.columns.push(column);
            kept.triangle.push(row);
            kept.parts.push(part);
        }
        kept
    }

    /// The deviance with the effects kept.
    #[must_use]
    pub fn deviance(&self, kept: &Kept) -> f64 {
        self.deviance - dot(&kept.parts, &kept.parts)
    }

    /// What a group of columns gains beside the effects kept; `cross` are each column's products with all effects.
    #[must_use]
    pub fn gain(
        &self,
        group: &Group,
        cross: &[&[f64]],
        kept: &Kept,
        least: &[Option<f64>],
    ) -> Option<Gain> {
        let along: Vec<Vec<f64>> = cross.iter().map(|c| kept.solved(c)).collect();
        let mut gram = group.gram.clone();
        for (i, row) in gram.iter_mut().enumerate() {
            for (j, x) in row.iter_mut().enumerate() {
                *x -= dot(&along[i], &along[j]);
            }
        }
        let slopes = group.slopes.iter().zip(&along);
        let slopes: Vec<f64> = slopes.map(|(s, a)| s - dot(a, &kept.parts)).collect();
        gain_of(
            &gram,
            &slopes,
            &group.squares,
            least,
            self.scale,
            self.ridge,
        )
    }
}

impl Kept {
    /// `L⁻¹ x` for products x of a column with all effects.
    fn solved(&self, products: &[f64]) -> Vec<f64> {
        let mut solved: Vec<f64> = Vec::with_capacity(self.columns.len());
        for (row, column) in self.triangle.iter().zip(&self.columns) {
            let known = dot(&row[..solved.len()], &solved);
            solved.push((products[*column] - known) / row[row.len() - 1]);
        }
        solved
    }
}
