//! Rows of one configuration share what the joints scatter by, and what the model lacks there: they
//! are no evidence of their own, and parameters are known less well than from as many single rows.
//!
//! # Source
//! K.-Y. Liang, S. L. Zeger, "Longitudinal data analysis using generalized linear models",
//! Biometrika 73 (1986): the covariance by the sums of clusters. R. M. Bell, D. F. `McCaffrey`, "Bias
//! reduction in standard errors for linear regression with multi-stage samples", Survey Methodology
//! 28 (2002): residuals over the root of what their own rows leave of them (of single rows HC2 of
//! J. G. `MacKinnon`, H. White, Journal of Econometrics 29 (1985)). L. Kish, "Survey Sampling" (1965):
//! the design effect, here by mean squares of the analysis of variance.

use super::expectation::slopes;
use super::measurements::numbered;
use super::parameters::Subject;
use super::problem::{Problem, Row};
use super::solver::Solution;
use crate::model::Motion;
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

/// Where nearly as much is fitted as there are means of configurations, at least this part of them
/// counts as left.
const LEAST_LEFT: f64 = 0.1;
/// Rows of one configuration are taken to miss alike where independent ones would do so less often.
const BY_CHANCE: f64 = 0.05;
/// What a fit leaves of a direction that its rows decide alone.
const NOTHING: f64 = 1e-6;

/// Sums of squares of residuals, of all and of what rows of one configuration have in common.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shared {
    all: f64,
    numbers: f64,
    between: f64,
    means: f64,
}

impl Shared {
    /// Adds the rows of one configuration.
    pub(crate) fn add(&mut self, rows: &[&[f64]]) {
        let most = rows.iter().map(|row| row.len()).max().unwrap_or(0);
        for k in 0..most {
            let own: Vec<f64> = rows.iter().filter_map(|row| row.get(k).copied()).collect();
            let (sum, count) = (own.iter().sum::<f64>(), own.len() as f64);
            self.all += own.iter().map(|x| x * x).sum::<f64>();
            self.between += sum * sum / count;
            self.numbers += count;
            self.means += 1.0;
        }
    }

    /// The mean square of what configurations have in common over that of all numbers, with so many
    /// parameters fitted: one where rows miss independently, about the number of rows of a
    /// configuration where they miss alike; never below one. Exactly one where they do not beyond
    /// chance, and where no two rows are of one configuration.
    #[must_use]
    pub(crate) fn design(&self, fitted: f64) -> f64 {
        if !self.is_beyond_chance(fitted) {
            return 1.0;
        }
        let left = (self.means - fitted).max(LEAST_LEFT * self.means);
        let of_all = self.all / (self.numbers - fitted).max(1.0);
        (self.between / left / of_all).max(1.0)
    }

    /// Whether rows of one configuration miss alike beyond chance (an F test).
    fn is_beyond_chance(&self, fitted: f64) -> bool {
        let inside = self.numbers - self.means;
        if inside <= 0.0 || self.all <= 0.0 {
            return false;
        }
        let left = (self.means - fitted).max(LEAST_LEFT * self.means);
        let of_inside = (self.all - self.between).max(f64::EPSILON * self.all) / inside;
        let ratio = self.between / left / of_inside;
        FisherSnedecor::new(left, inside).is_ok_and(|f| f.sf(ratio) < BY_CHANCE)
    }
}

/// What it does to the parameters of a solution that rows of one configuration miss alike.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Clustered {
    /// The variance by which evidence counts is this many times that of the residuals.
    pub design: f64,
    /// The parameters' covariance in their scales, at the rows' standard deviations; `None` where
    /// there are too few configurations for it.
    pub covariance: Option<DMatrix<f64>>,
}

/// Rows of one configuration as they count in the normal equations.
struct Cluster {
    residuals: Vec<Vec<f64>>,
    /// A row a number, a column a parameter.
    slopes: DMatrix<f64>,
}

/// The rows of each configuration.
fn clusters(problem: &Problem, solution: &Solution, configurations: &[Vec<usize>]) -> Vec<Cluster> {
    let (estimate, parameters) = (&solution.estimate, &solution.parameters);
    let models = problem.models(estimate, parameters);
    let effects = parameters.iter();
    let effects = effects.filter(|p| matches!(p.subject, Subject::Effect(_)));
    let mut motions = vec![Motion::default(); effects.count()];
    let mut cluster = |rows: &Vec<usize>| -> Cluster {
        let rows: Vec<&Row> = rows.iter().map(|row| &problem.rows[*row]).collect();
        let numbers = rows.iter().map(|row| row.observed.count()).sum();
        let mut all = DMatrix::zeros(numbers, parameters.len());
        let (mut residuals, mut start) = (Vec::with_capacity(rows.len()), 0);
        for row in rows {
            let pose = models[row.rig].evaluate(&row.q, &row.conditions, &mut motions);
            let seen = problem.observe(estimate, row, pose);
            let (gap, mut by, count) = (seen.gap(), seen.weights(), row.observed.count());
            let squared: f64 = (0..count).map(|k| (gap[k] * by[k]).powi(2)).sum();
            let root = solution.loss.of(squared, count).1.sqrt();
            by = by.map(|by| by * root);
            slopes(&seen, &motions, parameters, |column, slope| {
                for k in 0..count {
                    all[(start + k, column)] = slope[k] * by[k];
                }
            });
            residuals.push((0..count).map(|k| gap[k] * by[k]).collect());
            start += count;
        }
        Cluster {
            residuals,
            slopes: all,
        }
    };
    configurations.iter().map(&mut cluster).collect()
}

impl Cluster {
    /// `Jᵀ (I - H)^-½ r`: the residuals as large as they were before the fit followed them.
    fn sum(&self, inverse: &DMatrix<f64>) -> DVector<f64> {
        let count = self.slopes.nrows();
        let followed = &self.slopes * inverse * self.slopes.transpose();
        let own = (DMatrix::identity(count, count) - followed).symmetric_eigen();
        let residual = DVector::from_vec(self.residuals.concat());
        let mut along = own.eigenvectors.tr_mul(&residual);
        for (part, left) in along.iter_mut().zip(own.eigenvalues.iter()) {
            *part = if *left > NOTHING {
                *part / left.sqrt()
            } else {
                0.0
            };
        }
        self.slopes.tr_mul(&(own.eigenvectors * along))
    }
}

/// Whether and how rows of one configuration miss alike; `inverse` is that of the normal equations.
/// `None` where they do not beyond chance, and where each configuration has one row.
pub(super) fn clustered(
    problem: &Problem,
    solution: &Solution,
    inverse: &DMatrix<f64>,
) -> Option<Clustered> {
    let numbers = numbered(problem.rows.iter().map(|row| (&row.q, &row.stand)));
    let count = numbers.iter().max().map_or(0, |last| last + 1);
    if count == numbers.len() {
        return None;
    }
    let mut configurations = vec![Vec::new(); count];
    for (row, number) in numbers.iter().enumerate() {
        configurations[*number].push(row);
    }
    let clusters = clusters(problem, solution, &configurations);
    let mut shared = Shared::default();
    for cluster in &clusters {
        let rows: Vec<&[f64]> = cluster.residuals.iter().map(Vec::as_slice).collect();
        shared.add(&rows);
    }
    let parameters = &solution.parameters;
    let fitted = parameters.len() as f64;
    if !shared.is_beyond_chance(fitted) {
        return None;
    }
    let mut middle = DMatrix::zeros(parameters.len(), parameters.len());
    for cluster in &clusters {
        let sum = cluster.sum(inverse);
        middle += &sum * sum.transpose();
    }
    // what was known before is a reading of its own
    for (i, parameter) in parameters.iter().enumerate() {
        let known = parameter.prior.map(|(_, sigma)| parameter.scale / sigma);
        middle[(i, i)] += known.map_or(0.0, |slope| slope * slope);
    }
    Some(Clustered {
        design: shared.design(fitted),
        covariance: (count > parameters.len()).then(|| inverse * middle * inverse),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::units::DEG;
    use crate::identify::measurements::Measurements;
    use crate::identify::parameters::{Level, Selection};
    use crate::identify::pick::Pick;
    use crate::identify::random::Random;
    use crate::identify::robust::Shape;
    use crate::identify::simulate::{Command, Session, simulate};
    use crate::identify::solver::solve;
    use crate::identify::uncertainty::Uncertainty;
    use crate::model::external::Stand;
    use crate::profile::Profile;

    const PLACES: [[f64; 3]; 3] = [[0.0, 0.0, 0.05], [0.06, -0.02, 0.08], [-0.04, 0.07, 0.06]];

    /// 40 configurations, in which each joint scatters by 0.003°, with noise of 0.01 mm, and so
    /// many reflectors: the deviation of each parameter from the truth, its standard deviation,
    /// and that of single rows.
    fn session(seed: u64, reflectors: usize) -> (Vec<[f64; 3]>, Uncertainty) {
        let profile = Profile::from_yaml(include_str!("../../../../robots/abb_irb120_thesis.yaml"))
            .expect("a shipped profile");
        let tool = profile.tool("artifact").expect("its tool");
        let mut random = Random::new(seed);
        let angles: Vec<[f64; 6]> = (0..40)
            .map(|_| [0.0; 6].map(|_: f64| random.between(-1.2, 1.2)))
            .collect();
        let commands: Vec<Command> = (angles.iter())
            .map(|q| Command {
                q: q.map(|q| q + 0.003 * DEG * random.normal()),
                stand: Stand::default(),
                plate: None,
                direction: None,
                force_n: [0.0; 3],
            })
            .collect();
        let points: Vec<(Option<String>, [f64; 3])> = (["a", "b", "c"].iter().zip(PLACES))
            .take(reflectors)
            .map(|(name, place)| (Some((*name).to_owned()), place))
            .collect();
        let session = Session {
            noise_m: 1e-5,
            seed,
            ..Session::default()
        };
        let mut rows = simulate(&profile, &tool, &points, &commands, &session);
        for (i, row) in rows.iter_mut().enumerate() {
            row.q = angles[i / reflectors];
        }
        let measurements = Measurements {
            rows,
            columns: Vec::new(),
        };
        let mut selection = Selection::level(Level::Frames);
        selection.identify = Pick::parse_list("points").expect("a word");
        let (problem, mut estimate) =
            Problem::new(&profile, &measurements, &selection, profile.world_from_base)
                .expect("a problem");
        for (i, place) in PLACES.iter().enumerate().take(reflectors) {
            estimate.points_m[i] = *place;
        }
        let truth = estimate.clone();
        let solution = solve(&problem, estimate, Shape::Squares, false).expect("it converges");
        let known = Uncertainty::of(&problem, &solution);
        let inverse = solution.normal.matrix.clone().try_inverse();
        let inverse = inverse.expect("normal equations of what is determined");
        let each = solution.parameters.iter().enumerate().map(|(i, p)| {
            let single = p.scale * known.applied_factor * inverse[(i, i)].sqrt();
            let off = solution.estimate.value(p.subject) - truth.value(p.subject);
            [off, known.sigma[i], single]
        });
        (each.collect(), known)
    }

    #[test]
    fn reflectors_of_one_pose_scatter_as_their_sigmas_say() {
        let sessions: Vec<Vec<[f64; 3]>> = (1..81).map(|seed| session(seed, 3).0).collect();
        let count = sessions.iter().map(Vec::len).sum::<usize>();
        assert!(count >= 12 * 80, "{count}");
        let squared = |by: usize| -> f64 {
            let all = sessions.iter().flatten();
            let all = all.map(|of| (of[0] / of[by]).powi(2));
            all.sum::<f64>() / count as f64
        };
        let (clustered, single) = (squared(1).sqrt(), squared(2).sqrt());
        assert!((0.85..1.2).contains(&clustered), "{clustered}");
        assert!(single > 1.2 * clustered, "{single} {clustered}");
    }

    #[test]
    fn one_reflector_is_as_it_was() {
        let (each, known) = session(5, 1);
        assert!((known.shared_factor - 1.0).abs() < f64::EPSILON);
        for [_, sigma, single] in each {
            assert!((sigma / single - 1.0).abs() < 1e-9, "{sigma} {single}");
        }
    }

    #[test]
    fn what_configurations_share_is_counted_by_them() {
        // two configurations of two rows: equal rows, then opposite ones
        let mut alike = Shared::default();
        alike.add(&[&[1.0, 2.0], &[1.0, 2.0]]);
        alike.add(&[&[-2.0, 1.0], &[-2.0, 1.0]]);
        // mean squares 20 / 4 of the means, 20 / 8 of all
        assert!((alike.design(0.0) - 2.0).abs() < 1e-12);
        let mut opposite = Shared::default();
        opposite.add(&[&[1.0, 2.0], &[-1.0, -2.0]]);
        opposite.add(&[&[-2.0, 1.0], &[2.0, -1.0]]);
        assert!((opposite.design(0.0) - 1.0).abs() < 1e-12);
        let mut single = Shared::default();
        single.add(&[&[1.0, 2.0]]);
        single.add(&[&[5.0, 2.0]]);
        assert!((single.design(1.0) - 1.0).abs() < f64::EPSILON);
        assert!(!opposite.is_beyond_chance(0.0));
    }
}
