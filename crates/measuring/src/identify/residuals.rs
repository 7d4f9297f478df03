//! An identification as a function: residuals and their exact derivatives at any values, for
//! solvers from elsewhere.

use super::calibration::Calibration;
use super::parameters::{Parameter, Subject};
use super::problem::{Estimate, Problem};
use crate::model::Motion;
use crate::model::effects::Kind;
use crate::profile::Profile;

/// The residuals of a calibration's rows as a function of its parameters, in SI units.
#[derive(Clone, Debug)]
pub struct Residuals {
    problem: Problem,
    /// What is not a parameter stays as it is here.
    estimate: Estimate,
    parameters: Vec<Parameter>,
}

impl Residuals {
    /// Of what was identified: the parameters that the data determine; all else is as it was found.
    #[must_use]
    pub fn of(found: &Calibration) -> Self {
        Self {
            problem: found.problem.clone(),
            estimate: found.solution.estimate.clone(),
            parameters: found.solution.parameters.clone(),
        }
    }

    /// What the parameters are.
    #[must_use]
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Their values as they were found.
    #[must_use]
    pub fn found(&self) -> Vec<f64> {
        let value = |p: &Parameter| self.estimate.value(p.subject);
        self.parameters.iter().map(value).collect()
    }

    /// Their values as a profile has them; frames, tools and points, which no profile knows, as
    /// they were found.
    #[must_use]
    pub fn start(&self, profile: &Profile) -> Vec<f64> {
        let value = |p: &Parameter| {
            let found = self.estimate.value(p.subject);
            let Subject::Effect(slot) = p.subject else {
                return found;
            };
            let sought = &self.estimate.effects[slot.effect];
            if matches!(sought.kind, Kind::BaseFrame | Kind::ToolFrame) {
                return found;
            }
            let mut known = profile.effects.iter();
            known
                .find(|e| e.kind == sought.kind && e.site == sought.site)
                .map_or(0.0, |e| e.parameters[slot.parameter])
        };
        self.parameters.iter().map(value).collect()
    }

    /// How many residuals there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.problem.numbers()
    }

    fn at(&self, x: &[f64]) -> Estimate {
        let mut estimate = self.estimate.clone();
        for (parameter, value) in self.parameters.iter().zip(x) {
            *estimate.value_mut(parameter.subject) = *value;
        }
        estimate
    }

    /// Measured minus expected at these values, in standard deviations, row by row.
    ///
    /// # Panics
    /// If there are not as many values as parameters: the caller's bug.
    #[must_use]
    pub fn residuals(&self, x: &[f64]) -> Vec<f64> {
        self.evaluate(x, false).0
    }

    /// The derivatives of the residuals by the values, a row a residual.
    ///
    /// # Panics
    /// If there are not as many values as parameters: the caller's bug.
    #[must_use]
    pub fn jacobian(&self, x: &[f64]) -> Vec<f64> {
        self.evaluate(x, true).1
    }

    fn evaluate(&self, x: &[f64], with_slopes: bool) -> (Vec<f64>, Vec<f64>) {
        assert_eq!(x.len(), self.parameters.len(), "a value a parameter");
        let (estimate, count) = (self.at(x), self.count());
        let sought: &[Parameter] = if with_slopes { &self.parameters } else { &[] };
        let models = self.problem.models(&estimate, sought);
        let is_effect = |p: &&Parameter| matches!(p.subject, Subject::Effect(_));
        let mut motions = vec![Motion::default(); sought.iter().filter(is_effect).count()];
        let mut residuals = Vec::with_capacity(count);
        let mut slopes = Vec::with_capacity(count * sought.len());
        for row in self.problem.rows.iter() {
            let pose = models[row.rig].evaluate(&row.q, &row.conditions, &mut motions);
            let seen = self.problem.observe(&estimate, row, pose);
            let (gap, weights, numbers) = (seen.gap(), seen.weights(), row.observed.count());
            residuals.extend((0..numbers).map(|k| gap[k] * weights[k]));
            let mut of_effects = motions.iter();
            let columns = sought.iter().map(|p| match p.subject {
                Subject::Effect(_) => {
                    let motion = of_effects.next().expect("a motion an effect's parameter");
                    seen.slope(motion)
                }
                Subject::Point { point, axis } => seen.slope_of_point(point, axis),
                Subject::Feature { feature, value } => seen.slope_of_feature(feature, value),
            });
            let columns: Vec<_> = columns.collect();
            for k in 0..numbers {
                slopes.extend(columns.iter().map(|slope| -slope[k] * weights[k]));
            }
        }
        (residuals, slopes)
    }
}
