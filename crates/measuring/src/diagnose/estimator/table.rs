//! Residuals and columns in memory: what a parameter does to every measured number, in standard
//! deviations of the rows.

use crate::identify::observation::MOST_NUMBERS;
use crate::identify::parameters::{Parameter, Subject};
use crate::identify::problem::{Estimate, Problem};
use crate::model::Motion;
use pulp::Arch;
use std::ops::Range;
use std::sync::LazyLock;

/// Sums of an inner product that run side by side.
const LANES: usize = 16;
/// The same of few numbers.
const FEW_LANES: usize = 4;
/// Fewer numbers are not worth choosing instructions for.
const SHORT: usize = 48;

/// What the processor can do.
static ARCH: LazyLock<Arch> = LazyLock::new(Arch::new);

/// One number for each measured number.
pub type Column = Vec<f64>;

/// A column that is kept while others are tried: seven digits, of which no measurement has more.
#[derive(Clone, Debug)]
pub struct Stored(Vec<f32>);

/// What a column is written into.
pub trait Numbers {
    /// Without a number, with room for so many.
    fn with_room(count: usize) -> Self;
    /// Adds a number.
    fn add(&mut self, number: f64);
}

impl Numbers for Column {
    fn with_room(count: usize) -> Self {
        Self::with_capacity(count)
    }

    fn add(&mut self, number: f64) {
        self.push(number);
    }
}

impl Numbers for Stored {
    fn with_room(count: usize) -> Self {
        Self(Vec::with_capacity(count))
    }

    #[allow(clippy::cast_possible_truncation, reason = "this is what it is for")]
    fn add(&mut self, number: f64) {
        self.0.push(number as f32);
    }
}

impl Stored {
    /// The column.
    #[must_use]
    pub fn column(&self) -> Column {
        self.0.iter().map(|number| f64::from(*number)).collect()
    }
}

/// Where the numbers of each row stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    starts: Vec<usize>,
    /// Rows of each configuration; none where each row is one of its own.
    configurations: Vec<Vec<usize>>,
}

impl Layout {
    /// Of a problem's rows.
    #[must_use]
    pub fn of(problem: &Problem) -> Self {
        Self::of_counts(problem.rows.iter().map(|row| row.observed.count()))
    }

    /// Of rows with so many numbers each.
    #[must_use]
    pub fn of_counts(counts: impl IntoIterator<Item = usize>) -> Self {
        let mut starts = vec![0];
        for count in counts {
            starts.push(starts[starts.len() - 1] + count);
        }
        Self {
            starts,
            configurations: Vec::new(),
        }
    }

    /// The same rows, of which those with the same number are of one configuration.
    #[must_use]
    pub fn by_configuration(mut self, numbers: &[usize]) -> Self {
        let count = numbers.iter().max().map_or(0, |last| last + 1);
        if count < numbers.len() {
            self.configurations = vec![Vec::new(); count];
            for (row, number) in numbers.iter().enumerate() {
                self.configurations[*number].push(row);
            }
        }
        self
    }

    /// Rows of each configuration; none where each row is one of its own.
    #[must_use]
    pub fn configurations(&self) -> &[Vec<usize>] {
        &self.configurations
    }

    /// Rows of equal length.
    #[cfg(test)]
    pub fn even(rows: usize, each: usize) -> Self {
        Self::of_counts(std::iter::repeat_n(each, rows))
    }

    /// Numbers of a row.
    #[must_use]
    pub fn row(&self, row: usize) -> Range<usize> {
        self.starts[row]..self.starts[row + 1]
    }

    /// How many rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// How many numbers.
    #[must_use]
    pub fn numbers(&self) -> usize {
        self.starts[self.rows()]
    }
}

/// Residuals (measured minus expected) and the columns of some parameters in their scales, both in
/// standard deviations.
#[must_use]
pub fn table(
    problem: &Problem,
    estimate: &Estimate,
    parameters: &[Parameter],
) -> (Column, Vec<Column>) {
    table_into(problem, estimate, parameters)
}

/// The same, into columns of any sort.
pub(crate) fn table_into<C: Numbers>(
    problem: &Problem,
    estimate: &Estimate,
    parameters: &[Parameter],
) -> (Column, Vec<C>) {
    let models = problem.models(estimate, parameters);
    let numbers = problem.numbers();
    let mut residual = Vec::with_capacity(numbers);
    let columns = parameters.iter().map(|_| C::with_room(numbers));
    let mut columns: Vec<C> = columns.collect();
    let effects = parameters
        .iter()
        .filter(|p| matches!(p.subject, Subject::Effect(_)));
    let mut motions = vec![Motion::default(); effects.count()];
    for row in problem.rows.iter() {
        let pose = models[row.rig].evaluate(&row.q, &row.conditions, &mut motions);
        let seen = problem.observe(estimate, row, pose);
        let (gap, weights, count) = (seen.gap(), seen.weights(), row.observed.count());
        residual.extend((0..count).map(|k| gap[k] * weights[k]));
        let mut motion = motions.iter();
        for (column, parameter) in columns.iter_mut().zip(parameters) {
            let slope = match parameter.subject {
                Subject::Effect(_) => motion.next().map_or([0.0; MOST_NUMBERS], |m| seen.slope(m)),
                Subject::Point { point, axis } => seen.slope_of_point(point, axis),
                Subject::Feature { feature, value } => seen.slope_of_feature(feature, value),
            };
            for k in 0..count {
                column.add(slope[k] * weights[k] * parameter.scale);
            }
        }
    }
    (residual, columns)
}

struct Dot<'a>(&'a [f64], &'a [f64]);

impl pulp::NullaryFnOnce for Dot<'_> {
    type Output = f64;

    // so many sums, whatever the machine: its results are those of every other
    #[inline(always)]
    fn call(self) -> f64 {
        let mut sums = [0.0; LANES];
        let (mut x, mut y) = (self.0.chunks_exact(LANES), self.1.chunks_exact(LANES));
        for (p, q) in x.by_ref().zip(y.by_ref()) {
            for k in 0..LANES {
                sums[k] += p[k] * q[k];
            }
        }
        let rest = x.remainder().iter().zip(y.remainder());
        let tail: f64 = rest.map(|(p, q)| p * q).sum();
        sums.iter().sum::<f64>() + tail
    }
}

struct Add<'a>(&'a mut [f64], f64, &'a [f64]);

impl pulp::NullaryFnOnce for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (a, b) in self.0.iter_mut().zip(self.2) {
            *a += self.1 * b;
        }
    }
}

/// Inner product.
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    if a.len() < SHORT {
        let (x, y) = (a.chunks_exact(FEW_LANES), b.chunks_exact(FEW_LANES));
        let rest = x.remainder().iter().zip(y.remainder());
        let tail: f64 = rest.map(|(p, q)| p * q).sum();
        let mut sums = [0.0; FEW_LANES];
        for (p, q) in x.zip(y) {
            for k in 0..FEW_LANES {
                sums[k] += p[k] * q[k];
            }
        }
        return sums.iter().sum::<f64>() + tail;
    }
    ARCH.dispatch(Dot(a, b))
}

/// `into += by · column`.
pub fn add_scaled(into: &mut [f64], by: f64, column: &[f64]) {
    if into.len() < SHORT {
        for (a, b) in into.iter_mut().zip(column) {
            *a += by * b;
        }
    } else {
        ARCH.dispatch(Add(into, by, column));
    }
}

/// Length of each row's residual of place, metres.
#[must_use]
pub fn lengths_m(problem: &Problem, layout: &Layout, residual: &[f64]) -> Vec<f64> {
    (0..layout.rows())
        .map(|row| {
            let range = layout.row(row);
            let part = &residual[range.start..range.start + range.len().min(3)];
            part.iter().map(|r| r * r).sum::<f64>().sqrt() * problem.rows[row].sigma_m
        })
        .collect()
}

/// Numbers that look random, and are the same each time.
#[cfg(test)]
pub(crate) fn noise(seed: u64, count: usize) -> Column {
    let mut state = seed;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (0..count).map(|_| next()).collect()
}
