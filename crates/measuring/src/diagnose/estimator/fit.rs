//! Generalised least squares of everything that is fitted, with robust weights.
//!
//! With the columns X of the parameters, their prior's precision P and the weights W everything
//! follows from the weighted Gram matrix:
//!
//! ```text
//! N = XᵀW²X + P          β = N⁻¹ XᵀW²r          deviance = rᵀW²r − rᵀW²X N⁻¹ XᵀW²r
//! ```
//!
//! A parameter that is held by its calibration has Zellner's prior: P is `1/g` times what is left of
//! `XᵀW²X` when the free ones have taken their part (the Schur complement), so that N is
//! `(1 + 1/g)` times it there, and its factor that of the Gram matrix with these columns divided by
//! the root of the share `s = g/(1 + g)`. Columns that are sought come last, without a prior: that
//! of the others stays the same whatever is sought.
//!
//! # Source
//! A. C. Aitken (1935) for generalised least squares; A. Zellner, "On assessing prior distributions
//! and Bayesian regression analysis with g-prior distributions" (1986); P. J. Huber (1964) for
//! weights. G. H. Golub, C. F. Van Loan, "Matrix Computations", for normal equations by Cholesky.

use super::clusters::design;
use super::factor::Factor;
use super::table::{Column, Layout, add_scaled, dot};
use crate::identify::robust::{limit, median_of_squares};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// A column is redundant where less than this part of its square is left when earlier ones have
/// explained the rest: half of the digits of the Gram matrix.
pub(crate) const REDUNDANT: f64 = 1e-7;
/// A column shows nothing where its parameter's typical size moves all numbers together by fewer
/// standard deviations: a hundredth of the least that a candidate has to show.
const NOTHING: f64 = 1e-3;
/// Rounds of re-weighting.
const TURNS: usize = 8;
/// The scale has come to rest where it changes by no more than this part.
const AT_REST: f64 = 1e-3;
/// A parameter beyond its typical size by this factor is one standard deviation off.
const PRIOR_WIDTH: f64 = 5.0;

/// The inner products of everything that is fitted, all rows in use counting fully.
#[derive(Clone, Debug)]
pub struct Normal<'a> {
    layout: &'a Layout,
    used: &'a [bool],
    /// The residual, then the columns of the parameters.
    columns: Vec<&'a [f64]>,
    /// How freely each parameter is fitted: 1, or `g/(1 + g)` of one whose calibration is worth
    /// `1/g` of these measurements.
    shares: Vec<f64>,
    /// Indices of those that are not sought, the free ones first.
    order: Vec<usize>,
    /// The lower triangle of the Gram matrix.
    gram: Vec<Vec<f64>>,
    /// One for the numbers of rows in use, else zero.
    plain: Column,
    floor: f64,
}

/// A number that counts less.
#[derive(Clone, Copy, Debug)]
struct Less {
    number: usize,
    /// By how much: one less the weight.
    by: f64,
}

/// The fit, at some weights.
#[derive(Clone, Debug)]
pub struct Fit {
    /// Roots of the weights of all numbers; zero for rows not used.
    pub roots: Column,
    less: Vec<Less>,
    /// Of N.
    factor: Factor,
    /// The share of each column that is kept.
    pub(crate) shares: Vec<f64>,
    /// `L⁻¹ XᵀW²r`.
    right: Vec<f64>,
    /// Values of the columns that are kept.
    solved: Vec<f64>,
    /// How many of those are not sought.
    held: usize,
    /// `W (r − Xβ)`.
    pub left: Column,
    /// Of the residual given the prior, before division by the scale squared.
    pub deviance: f64,
    /// Residuals are so many standard deviations of the rows, and no less than the floor.
    pub scale: f64,
    /// The same, however little it is.
    pub mean: f64,
    /// Measured numbers in use, by weight, minus free parameters.
    pub freedom: f64,
    /// The scale is at least this.
    pub floor: f64,
    /// The variance by which evidence counts is this many times the square of the scale: above one
    /// where rows of one configuration miss alike, see [`design`].
    pub design: f64,
    /// Sum of squared parts along columns held by their calibration, and how many there are.
    pub strain: (f64, usize),
}

/// Median length of rows, in standard deviations.
fn scale_of(layout: &Layout, used: &[bool], residual: &[f64], freedom: f64) -> f64 {
    let mut ratios: Vec<f64> = Vec::new();
    let mut numbers = 0;
    for row in (0..layout.rows()).filter(|row| used[*row]) {
        let range = layout.row(row);
        numbers += range.len();
        let own = &residual[range.clone()];
        ratios.push(dot(own, own) / median_of_squares(range.len()));
    }
    if ratios.is_empty() {
        return 1.0;
    }
    let middle = ratios.len() / 2;
    let (_, median, _) = ratios.select_nth_unstable_by(middle, f64::total_cmp);
    let lost = (numbers as f64 / freedom.max(1.0)).min(100.0);
    (*median * lost).sqrt().max(1e-12)
}

/// A column times the roots of weights.
fn weighted(column: &[f64], roots: &[f64]) -> Column {
    column.iter().zip(roots).map(|(c, w)| c * w).collect()
}

impl<'a> Normal<'a> {
    /// Of parameters with their shares, on the rows in use.
    #[must_use]
    pub fn of(
        (layout, used): (&'a Layout, &'a [bool]),
        residual: &'a [f64],
        (held, shares): (&'a [Column], &'a [f64]),
        floor: f64,
    ) -> Self {
        let mut plain = vec![0.0; layout.numbers()];
        for row in (0..layout.rows()).filter(|row| used[*row]) {
            plain[layout.row(row)].fill(1.0);
        }
        let mut order: Vec<usize> = (0..held.len()).collect();
        order.sort_by(|a, b| shares[*b].total_cmp(&shares[*a]));
        let mut normal = Self {
            layout,
            used,
            columns: vec![residual],
            shares: shares.to_vec(),
            order,
            gram: vec![vec![dot(&weighted(residual, &plain), residual)]],
            plain,
            floor,
        };
        normal.add(held.iter().map(Vec::as_slice));
        normal
    }

    /// The same with more columns.
    fn add(&mut self, columns: impl Iterator<Item = &'a [f64]>) {
        let known = self.columns.len();
        self.columns.extend(columns);
        let (all, plain) = (&self.columns, &self.plain);
        let products = |i: usize| -> Vec<f64> {
            let own = weighted(all[i], plain);
            all[..=i].iter().map(|other| dot(&own, other)).collect()
        };
        let rows = (known..all.len()).into_par_iter().map(products);
        self.gram.par_extend(rows);
    }

    /// With columns that are sought: free, and behind the others.
    fn with<'b>(&self, sought: &[&'b [f64]]) -> Normal<'b>
    where
        'a: 'b,
    {
        let (mut normal, first): (Normal<'b>, _) = (self.clone(), self.shares.len());
        normal.shares.resize(first + sought.len(), 1.0);
        normal.add(sought.iter().copied());
        normal
    }

    /// The parameters that are not redundant given those before them, the free ones first.
    #[must_use]
    pub fn kept(&self) -> Vec<usize> {
        self.factor(&self.gram).kept
    }

    /// The factor of N by the Gram matrix.
    fn factor(&self, gram: &[Vec<f64>]) -> Factor {
        let mut factor = Factor::default();
        let add = |factor: &mut Factor, index: usize| {
            let product = |other: usize| gram[index.max(other) + 1][index.min(other) + 1];
            let square = product(index);
            if square > NOTHING * NOTHING {
                factor.add(index, product, (REDUNDANT * square, 0.0));
            }
        };
        for index in &self.order {
            add(&mut factor, *index);
        }
        // the priors
        let roots = factor.kept.iter().map(|index| self.shares[*index].sqrt());
        let roots: Vec<f64> = roots.collect();
        for row in &mut factor.rows {
            for (part, root) in row.iter_mut().zip(&roots) {
                *part /= root;
            }
        }
        for index in self.order.len()..self.shares.len() {
            add(&mut factor, index);
        }
        factor
    }

    /// The Gram matrix where some numbers count less.
    fn gram_at(&self, less: &[Less]) -> Vec<Vec<f64>> {
        let mut gram = self.gram.clone();
        let mut across = vec![0.0; self.columns.len()];
        for Less { number, by } in less {
            for (x, column) in across.iter_mut().zip(&self.columns) {
                *x = column[*number];
            }
            for (row, x) in gram.iter_mut().zip(&across) {
                add_scaled(row, -by * x, &across);
            }
        }
        gram
    }

    fn less(&self, roots: &[f64]) -> Vec<Less> {
        let both = roots.iter().zip(&self.plain).enumerate();
        both.filter(|(_, (root, plain))| root != plain)
            .map(|(number, (root, _))| Less {
                number,
                by: 1.0 - root * root,
            })
            .collect()
    }

    /// Residuals of all rows at these values of the columns that are kept, without weights.
    fn less_fitted(&self, kept: &[usize], values: &[f64]) -> Column {
        let mut rest = self.columns[0].to_vec();
        for (index, value) in kept.iter().zip(values) {
            add_scaled(&mut rest, -value, self.columns[index + 1]);
        }
        rest
    }

    /// Roots of weights that let a wrong row count as one at the limit of what is normal.
    fn robust(&self) -> Column {
        let in_use = || (0..self.layout.rows()).filter(|row| self.used[*row]);
        let numbers: usize = in_use().map(|row| self.layout.row(row).len()).sum();
        let mut roots = self.plain.clone();
        let mut last = f64::INFINITY;
        for _ in 0..TURNS {
            let less = self.less(&roots);
            let gram = self.gram_at(&less);
            let factor = self.factor(&gram);
            let values = factor.backward(&factor.forward(|index| gram[index + 1][0]));
            let rest = self.less_fitted(&factor.kept, &values);
            let fitted: f64 = factor.kept.iter().map(|index| self.shares[*index]).sum();
            let scale = scale_of(self.layout, self.used, &rest, numbers as f64 - fitted);
            let scale = scale.max(self.floor);
            let mut clipped = 0;
            let mut next = roots.clone();
            for row in in_use() {
                let range = self.layout.row(row);
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
            if (scale / last - 1.0).abs() < AT_REST {
                break;
            }
            last = scale;
        }
        roots
    }

    /// The fit at some weights.
    fn at(&self, roots: Column) -> Fit {
        let less = self.less(&roots);
        let gram = self.gram_at(&less);
        let factor = self.factor(&gram);
        let right = factor.forward(|index| gram[index + 1][0]);
        let solved = factor.backward(&right);
        let is_held = |index: &&usize| **index < self.order.len();
        let held = factor.kept.iter().filter(is_held).count();
        let mut fit = Fit {
            left: weighted(&self.less_fitted(&factor.kept, &solved), &roots),
            roots,
            less,
            shares: factor.kept.iter().map(|i| self.shares[*i]).collect(),
            deviance: gram[0][0] - dot(&right, &right),
            factor,
            right,
            solved,
            held,
            scale: 1.0,
            mean: 1.0,
            freedom: 1.0,
            floor: self.floor,
            design: 1.0,
            strain: (0.0, 0),
        };
        let remaining = fit.remaining();
        let pulls = remaining.iter().zip(&fit.shares).filter(|(_, s)| **s < 1.0);
        fit.strain = pulls.fold((0.0, 0), |(sum, n), (p, s)| (sum + p * p / s, n + 1));
        fit
    }

    /// The robust fit with columns that are sought, and before it that of the others at its weights
    /// and scale.
    ///
    /// Weights are one up to the length that 99.7 % of normal rows stay below, and fall with the
    /// square beyond it, so that a gross error counts as one row at the limit, whatever its
    /// size.
    #[must_use]
    pub fn fits(&self, sought: &[&[f64]]) -> (Fit, Fit) {
        let with = self.with(sought);
        let mut full = with.at(with.robust());
        // the spread of what counts, by the mean where weights let it
        let weight = dot(&full.roots, &full.roots);
        let free: f64 = full.shares.iter().filter(|s| **s == 1.0).sum();
        full.freedom = (weight - free).max(1.0);
        full.mean = (full.deviance / full.freedom).max(0.0).sqrt();
        // normal rows beyond the limit are cut: their part of the mean square is small
        full.scale = full.mean.max(self.floor).max(1e-12);
        full.design = design(self.layout, self.used, &full.left, full.shares.iter().sum());
        // so many numbers that tell as much as these
        full.freedom = (weight / full.design - free).max(1.0);
        let mut base = self.at(full.roots.clone());
        (base.scale, base.freedom, base.design) = (full.scale, full.freedom, full.design);
        (base, full)
    }

    /// The fit without columns that are sought, all rows in use counting fully.
    #[must_use]
    pub fn plain(&self) -> Fit {
        self.at(self.plain.clone())
    }

    /// The robust fit with columns that are sought.
    #[must_use]
    pub fn fit(&self, sought: &[&[f64]]) -> Fit {
        self.fits(sought).1
    }

    /// Residuals of all rows, those not in use included, of the robust fit with columns that are
    /// sought; without weights.
    #[must_use]
    pub fn rest(&self, sought: &[&[f64]]) -> Column {
        let fit = self.fit(sought);
        self.with(sought).less_fitted(&fit.factor.kept, &fit.solved)
    }

    /// Products of a column with those of the parameters, all rows in use counting fully.
    #[must_use]
    pub(crate) fn products(&self, column: &[f64]) -> Vec<f64> {
        let own = weighted(column, &self.plain);
        self.columns[1..].iter().map(|c| dot(&own, c)).collect()
    }

    /// `L⁻¹ XᵀW²c` at the weights of a fit, of a column with these products: what the fit takes of
    /// its products with others.
    #[must_use]
    pub(crate) fn taken(&self, fit: &Fit, column: &[f64], products: &[f64]) -> Vec<f64> {
        let mut products = products.to_vec();
        for Less { number, by } in &fit.less {
            let by = by * column[*number];
            for (product, own) in products.iter_mut().zip(&self.columns[1..]) {
                *product -= by * own[*number];
            }
        }
        fit.factor.forward(|index| products[index])
    }
}

impl Fit {
    /// The standard deviation by which evidence counts.
    #[must_use]
    pub fn evidence(&self) -> f64 {
        self.scale * self.design.sqrt()
    }

    /// The square of one over a typical size, in numbers' units: the scale is that of the noise,
    /// not of what is missing.
    pub(crate) fn ridge(&self) -> f64 {
        let variance = self.scale * self.scale;
        let noise = variance.min((self.floor * self.floor).max(0.01 * variance));
        noise / (PRIOR_WIDTH * PRIOR_WIDTH)
    }

    /// `Lᵀβ` of the columns that are not sought: what the others leave of the residual along them.
    fn remaining(&self) -> Vec<f64> {
        let mut along = self.right[..self.held].to_vec();
        let sought = self.factor.rows.iter().zip(&self.solved).skip(self.held);
        for (row, value) in sought {
            add_scaled(&mut along, -value, &row[..self.held]);
        }
        along
    }

    /// Values of the columns, in their parameters' scales; redundant ones are zero.
    #[must_use]
    pub fn values(&self, count: usize) -> Vec<f64> {
        self.by_index(count, &self.solved)
    }

    fn by_index(&self, count: usize, of_kept: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; count];
        for (index, value) in self.factor.kept.iter().zip(of_kept) {
            values[*index] = *value;
        }
        values
    }

    /// Values of the columns where those held by their calibration stay at it: the free ones fit
    /// what those that are sought leave.
    #[must_use]
    pub(crate) fn values_as_calibrated(&self, count: usize) -> Vec<f64> {
        let free = self.shares[..self.held].iter().take_while(|s| **s == 1.0);
        let mut values = self.factor.backward(&self.remaining()[..free.count()]);
        values.resize(self.held, 0.0);
        values.extend(&self.solved[self.held..]);
        self.by_index(count, &values)
    }

    /// Values of the columns that are held, of `count`, which follow a part of what is left along
    /// them as far as their `precision` lets them; those sought stay.
    pub(crate) fn followed(&self, count: usize, part: f64, precision: &DMatrix<f64>) -> Vec<f64> {
        let lower = DMatrix::from_fn(self.held, self.held, |j, k| {
            self.factor.rows[j].get(k).copied().unwrap_or(0.0)
        });
        let shares = DMatrix::from_diagonal(&DVector::from_column_slice(&self.shares[..self.held]));
        let own = |i: usize, j: usize| precision[(self.factor.kept[i], self.factor.kept[j])];
        let gram = &lower * shares * lower.transpose();
        let matrix = gram + DMatrix::from_fn(self.held, self.held, own);
        let pulled = part * lower * DVector::from_vec(self.remaining());
        let solved = matrix.cholesky().map(|factor| factor.solve(&pulled));
        let solved = solved.map_or_else(Vec::new, |x| x.as_slice().to_vec());
        self.by_index(count, &solved)
    }

    /// Standard deviation of a parameter with everything fitted, in its scale; infinite where it is
    /// redundant.
    #[must_use]
    pub fn deviation(&self, index: usize) -> f64 {
        self.evidence() * self.factor.deviation(index)
    }

    /// How much of each row's own numbers its expectation follows, by the parameters' columns: near
    /// 1, its residual says nothing of it.
    #[must_use]
    pub fn leverage(&self, layout: &Layout, columns: &[Column]) -> Vec<f64> {
        let of_row = |row: usize| {
            let range = layout.row(row);
            let own = range
                .clone()
                .map(|number| self.leverage_of(number, columns));
            own.sum::<f64>() / range.len().max(1) as f64
        };
        (0..layout.rows()).map(of_row).collect()
    }

    /// The same of one number.
    pub(crate) fn leverage_of(&self, number: usize, columns: &[Column]) -> f64 {
        let along = self.factor.forward(|index| columns[index][number]);
        self.roots[number].powi(2) * dot(&along, &along)
    }

    /// A column, weighted, less what the fit takes of it (R. Frisch, F. V. Waugh (1933)): products
    /// with it are those of the Schur complement.
    #[must_use]
    pub(crate) fn partial(&self, columns: &[Column], column: &[f64]) -> Column {
        let squared = weighted(column, &weighted(&self.roots, &self.roots));
        let taken = self.factor.forward(|index| dot(&squared, &columns[index]));
        let mut rest = column.to_vec();
        let values = self.factor.backward(&taken);
        for (index, value) in self.factor.kept.iter().zip(values) {
            add_scaled(&mut rest, -value, &columns[*index]);
        }
        weighted(&rest, &self.roots)
    }

    /// A column with the weights.
    #[must_use]
    pub(crate) fn weighted(&self, column: &[f64]) -> Column {
        weighted(column, &self.roots)
    }

    /// `L⁻¹ x` for weighted products of a column with those of the parameters.
    #[must_use]
    pub(crate) fn forward(&self, products: &[f64]) -> Vec<f64> {
        self.factor.forward(|index| products[index])
    }
}

#[cfg(test)]
mod tests;
