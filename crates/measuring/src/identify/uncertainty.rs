//! How well each parameter is known.

use super::clusters::clustered;
use super::problem::Problem;
use super::robust::{Shape, limit};
use super::solver::Solution;
use nalgebra::DMatrix;

/// Standard deviations and correlations of the parameters of a solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertainty {
    /// Covariance in the parameters' scales.
    pub covariance: DMatrix<f64>,
    /// Standard deviation of each parameter, SI.
    pub sigma: Vec<f64>,
    /// Residuals in standard deviations of the rows: their root mean square over the degrees of
    /// freedom.
    pub sigma_factor: f64,
    /// What the standard deviations of the rows were multiplied by: `sigma_factor` where it is
    /// above one or no row gave any.
    pub applied_factor: f64,
    /// What they are multiplied by besides where rows of one configuration miss alike: the root of
    /// the design effect, else one.
    pub shared_factor: f64,
    /// Measured numbers minus parameters.
    pub degrees_of_freedom: usize,
}

impl Uncertainty {
    /// Covariance `(JᵀWJ)⁻¹` of the kept parameters, times what the residuals say of the rows'
    /// standard deviations.
    ///
    /// A model that misses more than the rows' standard deviations say has parameters that are
    /// known less well: the factor is never below one unless no standard deviations were given.
    /// Where rows of one configuration miss alike, several reflectors that share what the joints
    /// scatter by, the covariance is that of the sums of configurations.
    #[must_use]
    pub fn of(problem: &Problem, solution: &Solution) -> Self {
        let Solution {
            normal,
            parameters,
            loss,
            ..
        } = solution;
        let counts: Vec<usize> = (problem.rows.iter())
            .map(|row| row.observed.count())
            .collect();
        // a row that the loss leaves out says nothing of the noise either
        let rows = || {
            let both = normal.squares.iter().zip(&counts);
            both.filter(|(squared, count)| loss.of(**squared, **count).1 > 0.0)
        };
        let numbers: usize = rows().map(|(_, count)| count).sum();
        let priors = parameters.iter().filter(|p| p.prior.is_some()).count();
        let degrees_of_freedom = (numbers + priors).saturating_sub(parameters.len());
        let clipped = rows().map(|(squared, count)| {
            let most = (limit(*count) * loss.scale).powi(2);
            if loss.shape == Shape::Squares {
                *squared
            } else {
                squared.min(most)
            }
        });
        let squares = clipped.sum::<f64>() + normal.prior_squares.iter().sum::<f64>();
        let sigma_factor = (squares / degrees_of_freedom.max(1) as f64).sqrt();
        let applied_factor = if problem.sigma_assumed {
            sigma_factor
        } else {
            sigma_factor.max(1.0)
        };
        let count = parameters.len();
        let inverse = normal
            .matrix
            .clone()
            .cholesky()
            .map_or_else(|| DMatrix::zeros(count, count), |factor| factor.inverse());
        let clustered = clustered(problem, solution, &inverse);
        let shared_factor = clustered.as_ref().map_or(1.0, |c| c.design.sqrt());
        // the sums have the residuals' own size
        let beyond = (applied_factor / sigma_factor.max(f64::MIN_POSITIVE)).max(1.0);
        let covariance = match clustered.and_then(|c| c.covariance) {
            Some(covariance) => covariance * (beyond * beyond),
            None => inverse * (applied_factor * shared_factor).powi(2),
        };
        let sigma = parameters
            .iter()
            .enumerate()
            .map(|(i, p)| p.scale * covariance[(i, i)].max(0.0).sqrt())
            .collect();
        Self {
            covariance,
            sigma,
            sigma_factor,
            applied_factor,
            shared_factor,
            degrees_of_freedom,
        }
    }

    /// Correlation of two parameters.
    #[must_use]
    pub fn correlation(&self, i: usize, j: usize) -> f64 {
        let product = self.covariance[(i, i)] * self.covariance[(j, j)];
        if product > 0.0 {
            self.covariance[(i, j)] / product.sqrt()
        } else {
            0.0
        }
    }

    /// Pairs of parameters correlated by more than `threshold` in size, strongest first.
    #[must_use]
    pub fn strong_correlations(&self, threshold: f64) -> Vec<(usize, usize, f64)> {
        let count = self.sigma.len();
        let mut pairs: Vec<_> = (0..count)
            .flat_map(|i| (i + 1..count).map(move |j| (i, j)))
            .map(|(i, j)| (i, j, self.correlation(i, j)))
            .filter(|(_, _, c)| c.abs() > threshold)
            .collect();
        pairs.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
        pairs
    }
}
