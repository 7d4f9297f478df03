//! Normal equations, gathered in one pass over the rows.

use super::observation::MOST_NUMBERS;
use super::parameters::{Parameter, Subject};
use super::problem::{Estimate, Problem, Row};
use super::robust::Loss;
use crate::model::{Motion, Sensitivity};
use nalgebra::{DMatrix, DVector};
use pulp::Arch;
use rayon::prelude::*;

/// Rows that one thread takes at a time. The sums do not depend on the number of threads.
const PORTION: usize = 512;
/// Rows of the Jacobian that are multiplied at once.
const BATCH: usize = 4;

/// `JᵀWJ` and `JᵀWr` with columns in the parameters' scales and residuals in standard deviations.
#[derive(Clone, Debug)]
pub struct Normal {
    /// `JᵀWJ`.
    pub matrix: DMatrix<f64>,
    /// `JᵀWr`.
    pub gradient: DVector<f64>,
    /// Sum of the loss over all rows; the sum of squares without robust loss.
    pub cost: f64,
    /// Sum of squared residuals in standard deviations of each row, before robust weights.
    pub squares: Vec<f64>,
}

struct Sums {
    /// Parameters plus the residual as the last column.
    width: usize,
    stride: usize,
    /// Upper triangle, row by row.
    products: Vec<f64>,
    waiting: [Vec<f64>; BATCH],
    filled: usize,
    cost: f64,
    squares: Vec<f64>,
}

impl Sums {
    fn new(width: usize) -> Self {
        let stride = width.next_multiple_of(4);
        Self {
            width,
            stride,
            products: vec![0.0; stride * width],
            waiting: std::array::from_fn(|_| vec![0.0; stride]),
            filled: 0,
            cost: 0.0,
            squares: Vec::new(),
        }
    }

    #[inline(always)]
    fn push(&mut self, fill: impl FnOnce(&mut [f64])) {
        fill(&mut self.waiting[self.filled]);
        self.filled += 1;
        if self.filled == BATCH {
            self.multiply();
        }
    }

    #[inline(always)]
    fn multiply(&mut self) {
        for row in &mut self.waiting[self.filled..] {
            row.fill(0.0);
        }
        self.filled = 0;
        let [a, b, c, d] = &self.waiting;
        for i in 0..self.width {
            let (x, y, z, w) = (a[i], b[i], c[i], d[i]);
            // a row of points or of another tool has many zeros
            if x == 0.0 && y == 0.0 && z == 0.0 && w == 0.0 {
                continue;
            }
            let from = i & !3;
            let into = &mut self.products[i * self.stride + from..(i + 1) * self.stride];
            let (a, b, c, d) = (&a[from..], &b[from..], &c[from..], &d[from..]);
            let length = into.len();
            let (a, b, c, d) = (&a[..length], &b[..length], &c[..length], &d[..length]);
            for j in 0..length {
                into[j] += (x * a[j] + y * b[j]) + (z * c[j] + w * d[j]);
            }
        }
    }

    fn add(&mut self, other: &Self) {
        for (into, from) in self.products.iter_mut().zip(&other.products) {
            *into += from;
        }
        self.cost += other.cost;
        self.squares.extend(&other.squares);
    }
}

struct Pass<'a> {
    problem: &'a Problem,
    estimate: &'a Estimate,
    models: &'a [Sensitivity],
    parameters: &'a [Parameter],
    loss: Loss,
    rows: &'a [Row],
}

impl pulp::NullaryFnOnce for Pass<'_> {
    type Output = Sums;

    #[inline(always)]
    fn call(self) -> Sums {
        let width = self.parameters.len() + 1;
        let mut sums = Sums::new(width);
        let effects = self
            .parameters
            .iter()
            .filter(|p| matches!(p.subject, Subject::Effect(_)));
        let mut motions = vec![Motion::default(); effects.count()];
        let mut slopes = vec![[0.0; MOST_NUMBERS]; width - 1];
        for row in self.rows {
            let pose = self.models[row.rig].evaluate(&row.q, &row.conditions, &mut motions);
            let seen = self.problem.observe(self.estimate, row, pose);
            let (gap, weights, count) = (seen.gap(), seen.weights(), row.observed.count());
            let squared: f64 = (0..count).map(|k| (gap[k] * weights[k]).powi(2)).sum();
            let (loss, weight) = self.loss.of(squared, count);
            sums.cost += loss;
            sums.squares.push(squared);
            let root = weight.sqrt();
            let mut motion = motions.iter();
            for (slope, parameter) in slopes.iter_mut().zip(self.parameters) {
                *slope = match parameter.subject {
                    Subject::Effect(_) => match motion.next() {
                        Some(motion) => seen.slope(motion),
                        None => [0.0; MOST_NUMBERS],
                    },
                    Subject::Point { point, axis } => seen.slope_of_point(point, axis),
                    Subject::Feature { feature, value } => seen.slope_of_feature(feature, value),
                };
                for k in 0..MOST_NUMBERS {
                    slope[k] *= parameter.scale;
                }
            }
            for k in 0..count {
                let by = root * weights[k];
                sums.push(|line| {
                    for (cell, slope) in line.iter_mut().zip(&slopes) {
                        *cell = by * slope[k];
                    }
                    line[width - 1] = by * gap[k];
                });
            }
        }
        sums.multiply();
        sums
    }
}

impl Normal {
    /// One pass over all rows of a problem.
    #[must_use]
    pub fn of(
        problem: &Problem,
        estimate: &Estimate,
        parameters: &[Parameter],
        loss: Loss,
    ) -> Self {
        let models = problem.models(estimate, parameters);
        let portion = |rows: &[Row]| {
            Arch::new().dispatch(Pass {
                problem,
                estimate,
                models: &models,
                parameters,
                loss,
                rows,
            })
        };
        let parts: Vec<Sums> = if problem.rows.len() > 2 * PORTION {
            problem.rows.par_chunks(PORTION).map(portion).collect()
        } else {
            problem.rows.chunks(PORTION).map(portion).collect()
        };
        let width = parameters.len() + 1;
        let mut all = Sums::new(width);
        for part in &parts {
            all.add(part);
        }
        let count = parameters.len();
        let at = |i: usize, j: usize| all.products[i.min(j) * all.stride + i.max(j)];
        let mut normal = Self {
            matrix: DMatrix::from_fn(count, count, at),
            gradient: DVector::from_fn(count, |i, _| at(i, count)),
            cost: all.cost,
            squares: all.squares,
        };
        for (i, parameter) in parameters.iter().enumerate() {
            if let Some((mean, sigma)) = parameter.prior {
                // one more row: (mean − value) / sigma
                let gap = (mean - estimate.value(parameter.subject)) / sigma;
                let slope = parameter.scale / sigma;
                normal.matrix[(i, i)] += slope * slope;
                normal.gradient[i] += slope * gap;
                normal.cost += gap * gap;
            }
        }
        normal
    }
}
