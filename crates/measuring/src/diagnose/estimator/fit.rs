//! A linear robust fit in which some parameters are free, others held by their calibration, and
//! what a new column would gain: a projected score test.

use super::table::{Column, Layout, add_scaled, dot};
use super::weights::Plain;
use crate::identify::robust::median_of_squares;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use std::sync::Arc;

/// A column is redundant where less than this part of its square is left when earlier ones have
/// explained the rest.
pub(crate) const REDUNDANT: f64 = 1e-7;
/// A column shows nothing where its parameter's typical size moves all numbers together by fewer
/// standard deviations.
pub(crate) const INVISIBLE: f64 = 0.1;
/// Rounds of re-weighting.
pub(crate) const TURNS: usize = 8;
/// A parameter beyond its typical size by this factor is one standard deviation off.
const PRIOR_WIDTH: f64 = 5.0;

/// A column of a parameter that is fitted with the candidates, and how freely.
#[derive(Clone, Copy, Debug)]
pub struct Held<'a> {
    /// What it does.
    pub column: &'a [f64],
    /// 1 for a free parameter; g/(1 + g) for one whose calibration is worth 1/g of these
    /// measurements (Zellner's prior).
    pub share: f64,
    /// A parameter of an effect that is sought: fitted freely, on top of what the others can
    /// absorb.
    pub sought: bool,
}

/// The fit: a basis of everything fitted, robust weights, residuals.
///
/// With the orthonormal basis Q of the columns that are held and their shares S, `M0 = I - Q S Qᵀ`
/// is the precision of the residuals when those are integrated out. Columns E that are sought lower
/// it to `M = M0 - U Uᵀ`, `U = M0 E L⁻ᵀ`, `L Lᵀ = Eᵀ M0 E`: generalised least squares. The prior of
/// what is held stays the same whatever is sought.
#[derive(Clone, Debug)]
pub struct Fit {
    /// Roots of the weights of all numbers; zero for rows not used.
    pub roots: Column,
    /// Columns of Q, then of U, weighted.
    pub(crate) basis: Vec<Arc<Column>>,
    /// One for each of the basis: those of S, then ones.
    pub(crate) shares: Vec<f64>,
    /// Which of the columns stands behind each of the basis.
    pub(crate) kept: Vec<usize>,
    /// How many of the basis belong to Q.
    base: usize,
    /// Triangle: `triangle[j]` are the parts of column `kept[j]` along the basis up to j.
    pub(crate) triangle: Vec<Vec<f64>>,
    /// Parts of the residual along the basis.
    pub(crate) parts: Vec<f64>,
    /// `M r`, weighted.
    pub left: Column,
    /// `rᵀ M r`: the deviance, before division by the scale squared.
    pub deviance: f64,
    /// Residuals are so many standard deviations of the rows.
    pub scale: f64,
    /// Measured numbers in use, by weight, minus free parameters.
    pub freedom: f64,
    /// The scale is at least this.
    pub floor: f64,
    /// The variance by which evidence counts is this many times the square of the scale: above one
    /// where rows of one configuration miss alike, see [`design`](super::clusters::design).
    pub design: f64,
    /// Sum of squared parts along columns held by their calibration, and how many there are.
    pub strain: (f64, usize),
}

fn weighted(column: &[f64], roots: &[f64]) -> Column {
    column.iter().zip(roots).map(|(c, w)| c * w).collect()
}

/// Median length of rows, in standard deviations.
pub(crate) fn scale_of(layout: &Layout, used: &[bool], residual: &[f64], freedom: f64) -> f64 {
    let mut ratios: Vec<f64> = Vec::new();
    let mut numbers = 0;
    for row in (0..layout.rows()).filter(|row| used[*row]) {
        let range = layout.row(row);
        numbers += range.len();
        let squared: f64 = residual[range.clone()].iter().map(|r| r * r).sum();
        ratios.push(squared / median_of_squares(range.len()));
    }
    if ratios.is_empty() {
        return 1.0;
    }
    let middle = ratios.len() / 2;
    let (_, median, _) = ratios.select_nth_unstable_by(middle, f64::total_cmp);
    let lost = (numbers as f64 / freedom.max(1.0)).min(100.0);
    (*median * lost).sqrt().max(1e-12)
}

impl Fit {
    /// Fits `residual` by `held` columns, those that are sought behind the others, on the rows in
    /// use: robustly, see [`Plain::fits`].
    #[must_use]
    pub fn of(layout: &Layout, used: &[bool], residual: &[f64], held: &[Held], floor: f64) -> Self {
        let first = held.iter().position(|h| h.sought).unwrap_or(held.len());
        let sought: Vec<&[f64]> = held[first..].iter().map(|h| h.column).collect();
        let plain = Plain::of(layout, used, residual, &held[..first], floor);
        plain.fits(layout, residual, &sought, first).1
    }

    /// The same rows, weights and scale with other columns.
    #[must_use]
    pub fn with_held(&self, residual: &[f64], held: &[Held]) -> Self {
        let mut fit = Self::weighted(residual, held, self.roots.clone());
        fit.scale = self.scale;
        fit.freedom = self.freedom;
        fit.floor = self.floor;
        fit.design = self.design;
        fit
    }

    /// The standard deviation by which evidence counts.
    #[must_use]
    pub fn evidence(&self) -> f64 {
        self.scale * self.design.sqrt()
    }

    pub(crate) fn weighted(residual: &[f64], held: &[Held], roots: Column) -> Self {
        let mut fit = Self {
            left: weighted(residual, &roots),
            roots,
            basis: Vec::new(),
            shares: Vec::new(),
            kept: Vec::new(),
            base: 0,
            triangle: Vec::new(),
            parts: Vec::new(),
            deviance: 0.0,
            scale: 1.0,
            freedom: 1.0,
            floor: 0.0,
            design: 1.0,
            strain: (0.0, 0),
        };
        let mut whole = fit.left.clone();
        // free columns first: what they explain is no strain on the calibration
        let mut order: Vec<usize> = (0..held.len()).filter(|i| !held[*i].sought).collect();
        order.sort_by(|a, b| held[*b].share.total_cmp(&held[*a].share));
        for index in order {
            let mut column = weighted(held[index].column, &fit.roots);
            let before = dot(&column, &column);
            if before < INVISIBLE * INVISIBLE * 1e-4 {
                continue;
            }
            let mut along = vec![0.0; fit.basis.len() + 1];
            // twice is enough (Kahan)
            for _ in 0..2 {
                for (k, q) in fit.basis.iter().enumerate() {
                    let part = dot(q, &column);
                    along[k] += part;
                    add_scaled(&mut column, -part, q);
                }
            }
            let after = dot(&column, &column);
            if after <= REDUNDANT * before {
                continue;
            }
            let length = after.sqrt();
            for x in &mut column {
                *x /= length;
            }
            along[fit.basis.len()] = length;
            let part = dot(&column, &whole);
            add_scaled(&mut whole, -part, &column);
            let share = held[index].share;
            add_scaled(&mut fit.left, -share * part, &column);
            fit.deviance += (1.0 - share) * part * part;
            fit.basis.push(Arc::new(column));
            fit.shares.push(share);
            fit.kept.push(index);
            fit.triangle.push(along);
            fit.parts.push(part);
        }
        fit.base = fit.basis.len();
        fit.deviance += dot(&whole, &whole);
        for index in (0..held.len()).filter(|i| held[*i].sought) {
            fit.seek(index, held[index].column);
        }
        fit.strained();
        fit
    }

    /// Adds a column that is sought.
    pub(crate) fn seek(&mut self, index: usize, column: &[f64]) {
        let column = weighted(column, &self.roots);
        let before = dot(&column, &column);
        if before < INVISIBLE * INVISIBLE * 1e-4 {
            return;
        }
        let mut along: Vec<f64> = self.basis.iter().map(|q| dot(q, &column)).collect();
        let mut turned = column.clone();
        for ((q, part), share) in self.basis.iter().zip(&along).zip(&self.shares) {
            add_scaled(&mut turned, -share * part, q);
        }
        let after = dot(&column, &turned);
        if after <= REDUNDANT * before {
            return;
        }
        let length = after.sqrt();
        for x in &mut turned {
            *x /= length;
        }
        let part = dot(&column, &self.left) / length;
        add_scaled(&mut self.left, -part, &turned);
        self.deviance -= part * part;
        along.push(length);
        self.basis.push(Arc::new(turned));
        self.shares.push(1.0);
        self.kept.push(index);
        self.triangle.push(along);
        self.parts.push(part);
    }

    /// Values of the columns that are sought, one for each of U.
    fn sought(&self) -> Vec<f64> {
        let mut solved = self.parts[self.base..].to_vec();
        for j in (0..solved.len()).rev() {
            solved[j] /= self.triangle[self.base + j][self.base + j];
            for k in 0..j {
                solved[k] -= self.triangle[self.base + j][self.base + k] * solved[j];
            }
        }
        solved
    }

    /// Parts along Q of the residual less what the columns sought explain.
    fn remaining(&self, sought: &[f64]) -> Vec<f64> {
        let mut parts = self.parts[..self.base].to_vec();
        for (j, value) in sought.iter().enumerate() {
            for (part, along) in parts.iter_mut().zip(&self.triangle[self.base + j]) {
                *part -= value * along;
            }
        }
        parts
    }

    pub(crate) fn strained(&mut self) {
        let parts = self.remaining(&self.sought());
        let pulls = parts.iter().zip(&self.shares).filter(|(_, s)| **s < 1.0);
        self.strain = pulls.fold((0.0, 0), |(sum, count), (p, _)| (sum + p * p, count + 1));
    }

    /// Values of the columns, in their parameters' scales; redundant ones are zero.
    #[must_use]
    pub fn values(&self, count: usize) -> Vec<f64> {
        let sought = self.sought();
        let mut solved: Vec<f64> = self
            .remaining(&sought)
            .iter()
            .zip(&self.shares)
            .map(|(p, s)| p * s)
            .collect();
        for j in (0..solved.len()).rev() {
            solved[j] /= self.triangle[j][j];
            for k in 0..j {
                solved[k] -= self.triangle[j][k] * solved[j];
            }
        }
        let mut values = vec![0.0; count];
        for (index, value) in self.kept.iter().zip(solved.into_iter().chain(sought)) {
            values[*index] = value;
        }
        values
    }

    /// Values of the columns that are held, of `count`, which follow a part of what is left along
    /// them as far as their `precision` lets them; those sought stay.
    pub(crate) fn followed(&self, count: usize, part: f64, precision: &DMatrix<f64>) -> Vec<f64> {
        let lower = DMatrix::from_fn(self.base, self.base, |j, k| {
            self.triangle[j].get(k).copied().unwrap_or(0.0)
        });
        let parts = part * DVector::from_vec(self.remaining(&self.sought()));
        let own = |i: usize, j: usize| precision[(self.kept[i], self.kept[j])];
        let matrix = &lower * lower.transpose() + DMatrix::from_fn(self.base, self.base, own);
        let mut values = vec![0.0; count];
        if let Some(factor) = matrix.cholesky() {
            let solved = factor.solve(&(&lower * parts));
            for (index, value) in self.kept.iter().zip(solved.iter()) {
                values[*index] = *value;
            }
        }
        values
    }

    /// Residuals of all rows, those not used included, without weights.
    #[must_use]
    pub fn unweighted_rest(&self, residual: &[f64], held: &[Held]) -> Column {
        let mut rest = residual.to_vec();
        for (value, held) in self.values(held.len()).iter().zip(held) {
            if *value != 0.0 {
                add_scaled(&mut rest, -value, held.column);
            }
        }
        rest
    }

    /// How much of each row's own numbers its expectation follows: near 1, its residual says
    /// nothing of it.
    #[must_use]
    pub fn leverage(&self, layout: &Layout) -> Vec<f64> {
        let of = |row: usize| {
            let range = layout.row(row);
            let along = self.basis.iter().zip(&self.shares);
            let followed = along.map(|(q, s)| s * dot(&q[range.clone()], &q[range.clone()]));
            followed.sum::<f64>() / range.len().max(1) as f64
        };
        (0..layout.rows()).map(of).collect()
    }

    /// The weighted column and its parts along the basis.
    pub(crate) fn parts_of(&self, column: &[f64]) -> (Column, Vec<f64>) {
        let column = weighted(column, &self.roots);
        let parts = self.basis.iter().map(|q| dot(q, &column)).collect();
        (column, parts)
    }

    /// Everything about columns that the gain of any group of them needs.
    #[must_use]
    pub fn projections(&self, columns: &[Column]) -> Vec<Projection> {
        columns
            .par_iter()
            .map(|column| {
                let (column, parts) = self.parts_of(column);
                Projection {
                    slope: dot(&column, &self.left),
                    square: dot(&column, &column),
                    column,
                    parts,
                }
            })
            .collect()
    }

    /// A weighted column times M.
    #[must_use]
    pub(crate) fn turned(&self, seen: &Projection) -> Column {
        let mut turned = seen.column.clone();
        for ((q, part), share) in self.basis.iter().zip(&seen.parts).zip(&self.shares) {
            add_scaled(&mut turned, -share * part, q);
        }
        turned
    }

    /// Inner product of two columns after projection.
    pub(crate) fn product(&self, a: &Projection, b: &Projection) -> f64 {
        let along: f64 = (a.parts.iter().zip(&b.parts).zip(&self.shares))
            .map(|((x, y), s)| x * y * s)
            .sum();
        dot(&a.column, &b.column) - along
    }

    /// The square of one over a typical size, in numbers' units: the scale is that of the noise,
    /// not of what is missing.
    pub(crate) fn ridge(&self) -> f64 {
        let variance = self.scale * self.scale;
        let noise = variance.min((self.floor * self.floor).max(0.01 * variance));
        noise / (PRIOR_WIDTH * PRIOR_WIDTH)
    }

    /// What a group of columns would gain together.
    #[must_use]
    pub fn gain(&self, group: &[&Projection], least: &[Option<f64>]) -> Option<Gain> {
        let count = group.len();
        let mut gram = vec![vec![0.0; count]; count];
        for i in 0..count {
            for j in 0..=i {
                let product = self.product(group[i], group[j]);
                gram[i][j] = product;
                gram[j][i] = product;
            }
        }
        let slopes: Vec<f64> = group.iter().map(|p| p.slope).collect();
        let squares: Vec<f64> = group.iter().map(|p| p.square).collect();
        gain_of(
            &gram,
            &slopes,
            &squares,
            least,
            self.evidence(),
            self.ridge(),
        )
    }

    /// Standard deviations of a group's parameters when all are fitted, in their typical sizes;
    /// infinite where redundant.
    #[must_use]
    pub fn deviations(&self, group: &[&Projection]) -> Vec<f64> {
        let count = group.len();
        let gram = DMatrix::from_fn(count, count, |i, j| self.product(group[i], group[j]));
        match gram.cholesky() {
            Some(factor) => {
                let inverse = factor.inverse();
                (0..count)
                    .map(|i| self.evidence() * inverse[(i, i)].max(0.0).sqrt())
                    .collect()
            }
            None => vec![f64::INFINITY; count],
        }
    }
}

/// A column seen from a fit.
#[derive(Clone, Debug)]
pub struct Projection {
    /// Weighted.
    pub(crate) column: Column,
    pub(crate) parts: Vec<f64>,
    /// Inner product with the residual.
    pub(crate) slope: f64,
    /// Inner product with itself, before projection.
    pub(crate) square: f64,
}

/// What a group of columns gains.
#[derive(Clone, Debug, PartialEq)]
pub struct Gain {
    /// Fall of the deviance in units of the variance by which evidence counts: chi-squared where
    /// the columns do nothing.
    pub gain: f64,
    /// Values of the group's parameters in their typical sizes; zero where a column is redundant
    /// or at its bound.
    pub values: Vec<f64>,
    /// How many of them are determined.
    pub count: usize,
}

pub(crate) fn gain_of(
    gram: &[Vec<f64>],
    slopes: &[f64],
    squares: &[f64],
    least: &[Option<f64>],
    scale: f64,
    ridge: f64,
) -> Option<Gain> {
    let mut active: Vec<usize> = (0..slopes.len())
        .filter(|i| squares[*i].sqrt() > INVISIBLE && gram[*i][*i] > REDUNDANT * squares[*i])
        .collect();
    let mut at_bound: Vec<usize> = Vec::new();
    let variance = scale * scale;
    loop {
        let count = active.len();
        if count == 0 {
            return None;
        }
        // Cholesky with the prior's width on the diagonal; a redundant column is left out
        let mut factor: Vec<Vec<f64>> = Vec::with_capacity(count);
        let mut good: Vec<usize> = Vec::with_capacity(count);
        for &i in &active {
            let mut row: Vec<f64> = Vec::with_capacity(good.len() + 1);
            for (k, &other) in good.iter().enumerate() {
                let known: f64 = (0..k).map(|l| row[l] * factor[k][l]).sum();
                row.push((gram[i][other] - known) / factor[k][k]);
            }
            let left = gram[i][i] - row.iter().map(|x| x * x).sum::<f64>();
            if left > 1e-6 * gram[i][i] {
                row.push((left + ridge).sqrt());
                factor.push(row);
                good.push(i);
            }
        }
        let count = good.len();
        let mut solved: Vec<f64> = good.iter().map(|i| slopes[*i]).collect();
        for k in 0..count {
            for l in 0..k {
                solved[k] -= factor[k][l] * solved[l];
            }
            solved[k] /= factor[k][k];
        }
        let gain: f64 = solved.iter().map(|x| x * x).sum::<f64>() / variance;
        for k in (0..count).rev() {
            solved[k] /= factor[k][k];
            for l in 0..k {
                solved[l] -= factor[k][l] * solved[k];
            }
        }
        let beyond = (0..count)
            .filter_map(|k| {
                least[good[k]]
                    .filter(|bound| solved[k] < *bound)
                    .map(|bound| (k, bound - solved[k]))
            })
            .max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((k, _)) = beyond {
            at_bound.push(good[k]);
            active.retain(|i| *i != good[k]);
            continue;
        }
        let mut values = vec![0.0; slopes.len()];
        for (i, value) in good.iter().zip(&solved) {
            values[*i] = *value;
        }
        return Some(Gain {
            gain,
            values,
            count,
        });
    }
}
