//! Normal equations, gathered in one pass over the rows.

use super::expectation::four_slopes;
use super::holder::Holder;
use super::measurements::Observed;
use super::observation::{MOST_NUMBERS, Observation};
use super::parameters::{Parameter, Subject};
use super::problem::{Estimate, Problem, Row};
use super::robust::Loss;
use crate::geometry::{Four, Pose, Scalar, WIDTH};
use crate::model::batch::{lane_of, side_by_side};
use crate::model::{FourMotions, Motion};
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
    /// Squared distance of each parameter from its prior, in the prior's standard deviations; zero
    /// without one.
    pub prior_squares: Vec<f64>,
}

/// A row's residual as it counts.
struct Counted {
    gap: [f64; MOST_NUMBERS],
    /// One over the standard deviation of each number, times the root of the robust weight.
    by: [f64; MOST_NUMBERS],
    count: usize,
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

    /// Takes a row into the cost; how it counts in the products.
    #[inline(always)]
    fn count(&mut self, row: &Row, seen: &Observation, loss: Loss) -> Counted {
        let (gap, mut by, count) = (seen.gap(), seen.weights(), row.observed.count());
        let squared: f64 = (0..count).map(|k| (gap[k] * by[k]).powi(2)).sum();
        let (cost, weight) = loss.of(squared, count);
        self.cost += cost;
        self.squares.push(squared);
        let root = weight.sqrt();
        for by in &mut by {
            *by *= root;
        }
        Counted { gap, by, count }
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
    models: &'a [Holder],
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
            .filter(|p| matches!(p.subject, Subject::Effect(_)))
            .count();
        let mut motions = vec![Motion::default(); effects];
        let mut four_motions = vec![FourMotions::none(); effects];
        let mut slopes = vec![[0.0; MOST_NUMBERS]; width - 1];
        let mut four_slopes = vec![[Four::zero(); 3]; width - 1];
        let fours: Vec<_> = self.models.iter().map(Holder::four).collect();
        let mut rest = self.rows;
        while let Some(first) = rest.first() {
            let joined = rest.get(..WIDTH).zip(fours[first.rig].as_ref());
            let joined = joined.filter(|(rows, four)| {
                rows.iter().all(|row| {
                    row.rig == first.rig
                        && matches!(row.observed, Observed::Position(_))
                        && four.may_join(&first.conditions, &row.conditions)
                })
            });
            if let Some((rows, four)) = joined {
                let q = side_by_side([&rows[0].q, &rows[1].q, &rows[2].q, &rows[3].q]);
                let pose = four.evaluate(&q, &first.conditions, &mut four_motions);
                self.four_positions(rows, &pose, &four_motions, &mut four_slopes, &mut sums);
                rest = &rest[WIDTH..];
            } else {
                let pose =
                    self.models[first.rig].evaluate(&first.q, &first.conditions, &mut motions);
                self.one(first, pose, &motions, &mut slopes, &mut sums);
                rest = &rest[1..];
            }
        }
        sums.multiply();
        sums
    }
}

impl Pass<'_> {
    /// One row of any kind.
    #[inline(always)]
    fn one(
        &self,
        row: &Row,
        pose: Pose,
        motions: &[Motion],
        slopes: &mut [[f64; MOST_NUMBERS]],
        sums: &mut Sums,
    ) {
        let seen = self.problem.observe(self.estimate, row, pose);
        let counted = sums.count(row, &seen, self.loss);
        let mut motion = motions.iter();
        for (slope, parameter) in slopes.iter_mut().zip(self.parameters) {
            *slope = match parameter.subject {
                Subject::Effect(_) => match motion.next() {
                    Some(motion) => seen.slope(motion),
                    None => [0.0; MOST_NUMBERS],
                },
                Subject::Point { point, axis } => seen.slope_of_point(point, axis),
                Subject::Feature { feature, value } => seen.slope_of_feature(feature, value),
            }
            .map(|x| x * parameter.scale);
        }
        for k in 0..counted.count {
            let line = &mut sums.waiting[sums.filled];
            for (cell, slope) in line.iter_mut().zip(&*slopes) {
                *cell = counted.by[k] * slope[k];
            }
            line[slopes.len()] = counted.by[k] * counted.gap[k];
            sums.filled += 1;
            if sums.filled == BATCH {
                sums.multiply();
            }
        }
    }

    /// Four rows of one rig with measured positions.
    #[inline(always)]
    fn four_positions(
        &self,
        rows: &[Row],
        pose: &Pose<Four>,
        motions: &[FourMotions],
        slopes: &mut [[Four; 3]],
        sums: &mut Sums,
    ) {
        if sums.filled > 0 {
            sums.multiply();
        }
        let points: [_; WIDTH] =
            std::array::from_fn(|i| self.problem.point_in_tool_m(self.estimate, &rows[i]));
        let arm = pose.rotation * side_by_side([&points[0], &points[1], &points[2], &points[3]]);
        let mut by = [Four::zero(); 3];
        let mut gap = [Four::zero(); 3];
        for (lane, row) in rows.iter().enumerate() {
            let seen = Observation::new(row, lane_of(pose, lane), points[lane]);
            let counted = sums.count(row, &seen, self.loss);
            for k in 0..3 {
                by[k].0[lane] = counted.by[k];
                gap[k].0[lane] = counted.by[k] * counted.gap[k];
            }
        }
        let of: [_; WIDTH] = std::array::from_fn(|i| rows[i].point);
        four_slopes(
            pose,
            arm,
            motions,
            self.parameters,
            of,
            |column, shift, _| slopes[column] = shift,
        );
        for k in 0..3 {
            for (column, slope) in slopes.iter().enumerate() {
                let cell = by[k] * slope[k];
                for (line, value) in sums.waiting.iter_mut().zip(cell.0) {
                    line[column] = value;
                }
            }
            for (line, value) in sums.waiting.iter_mut().zip(gap[k].0) {
                line[slopes.len()] = value;
            }
            sums.filled = BATCH;
            sums.multiply();
        }
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
            prior_squares: vec![0.0; count],
        };
        for (i, parameter) in parameters.iter().enumerate() {
            if let Some((mean, sigma)) = parameter.prior {
                // one more row: (mean − value) / sigma
                let gap = (mean - estimate.value(parameter.subject)) / sigma;
                let slope = parameter.scale / sigma;
                normal.matrix[(i, i)] += slope * slope;
                normal.gradient[i] += slope * gap;
                normal.cost += gap * gap;
                normal.prior_squares[i] = gap * gap;
            }
        }
        normal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::measurements::Measurements;
    use crate::identify::parameters::{Level, Selection};
    use crate::identify::pick::Pick;
    use crate::identify::random::Random;
    use crate::identify::simulate::{Command, Session, simulate};
    use crate::model::external::Stand;
    use crate::profile::Profile;
    use std::sync::Arc;

    #[test]
    fn four_rows_side_by_side_count_as_one_after_another() {
        let profile = Profile::from_yaml(include_str!("../../../../robots/abb_irb120_thesis.yaml"))
            .expect("a shipped profile");
        let tool = profile.tool("artifact").expect("its tool");
        let mut random = Random::new(4);
        let commands: Vec<Command> = (0..20)
            .map(|_| Command {
                q: [0.0; 6].map(|_: f64| random.between(-1.5, 1.5)),
                stand: Stand::default(),
                plate: None,
                direction: None,
                force_n: [0.0; 3],
            })
            .collect();
        let points = [
            (Some("a".to_owned()), [0.01, 0.05, 0.02]),
            (Some("b".to_owned()), [-0.04, 0.0, 0.03]),
        ];
        let session = Session {
            noise_m: 1e-4,
            ..Session::default()
        };
        let measurements = Measurements {
            rows: simulate(&profile, &tool, &points, &commands, &session),
            columns: Vec::new(),
        };
        let mut selection = Selection::level(Level::Compliance);
        selection.identify = Pick::parse_list("points,joint_harmonic:5:2").expect("words");
        let (problem, estimate) =
            Problem::new(&profile, &measurements, &selection, profile.world_from_base)
                .expect("a problem");
        let of = |rows: &[Row]| {
            let mut part = problem.clone();
            part.rows = Arc::new(rows.to_vec());
            Normal::of(&part, &estimate, &problem.parameters, Loss::squares())
        };
        let together = of(&problem.rows);
        let ones: Vec<Normal> = problem.rows.chunks(1).map(of).collect();
        let matrix = ones
            .iter()
            .fold(together.matrix.clone() * 0.0, |sum, n| sum + &n.matrix);
        let gradient = ones
            .iter()
            .fold(together.gradient.clone() * 0.0, |sum, n| sum + &n.gradient);
        let count = problem.parameters.len();
        for i in 0..count {
            let length = matrix[(i, i)].sqrt();
            assert!(length > 0.0, "{}", problem.parameters[i].key);
            assert!(
                (gradient[i] - together.gradient[i]).abs() < 1e-9 * length,
                "{}",
                problem.parameters[i].key
            );
            for j in 0..count {
                let gap = (matrix[(i, j)] - together.matrix[(i, j)]).abs();
                assert!(gap < 1e-10 * length * matrix[(j, j)].sqrt(), "{i} {j}");
            }
        }
        assert!((together.cost / ones.iter().map(|n| n.cost).sum::<f64>() - 1.0).abs() < 1e-12);
    }
}
