//! Damped Gauss–Newton on exact derivatives, with re-weighting where a robust loss asks for it.

use super::error::IdentifyError;
use super::identifiability::{Identifiable, identifiable};
use super::normal::Normal;
use super::parameters::{Parameter, Subject};
use super::problem::{Estimate, Problem};
use super::robust::{Loss, Shape, scale_of};
use crate::geometry::Pose;
use crate::model::effects::{Kind, MOST_PARAMETERS};
use nalgebra::DVector;

/// Passes over the data before parameters that are hardly seen are looked for.
const FIRST_PASSES: usize = 12;
/// Passes over the data with one loss and choice of parameters before the iteration counts as
/// failed.
const MOST_PASSES: usize = 60;
/// A step below this part of every parameter's typical size ends the iteration.
pub const STEP_LIMIT: f64 = 1e-7;
/// A sum of squares that falls by less than this part of itself ends the iteration, if it promised
/// no more.
const FALL_LIMIT: f64 = 1e-9;
/// Passes that a loss may take that weighs rows: its steps are those of weights, not of Newton.
const MOST_SLOW_PASSES: usize = 240;
/// A step of it is small that is this part of the parameters' standard deviations.
const SMALL_PART: f64 = 0.01;
/// A step below this part of every parameter's typical size leaves its square to a further one.
const SMALL_STEP: f64 = 1e-3;
/// From so many rows on, a sample is solved first.
const SAMPLE_FROM: usize = 2000;
/// Rows of that sample.
const SAMPLE: usize = 600;
/// A robust scale that changes by less ends the re-weighting.
const SCALE_LIMIT: f64 = 0.01;
/// A robust scale is not smaller: measurements without noise fit exactly.
const LEAST_SCALE: f64 = 1e-9;
/// How often the loss or the choice of parameters may change.
const MOST_ROUNDS: usize = 14;
/// How often parameters that were left out may come back.
const MOST_RETURNS: usize = 3;

/// Why the iteration stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// The last step is below [`STEP_LIMIT`] of the parameters' typical sizes.
    Step(f64),
    /// The sum of squares falls by less than this part of itself.
    Fall(f64),
}

impl Stop {
    /// In words, with the number.
    #[must_use]
    pub fn describe(self) -> String {
        match self {
            Self::Step(step) => format!(
                "the last step was {step:.1e} of the parameters' typical sizes (limit \
                 {STEP_LIMIT:.0e})"
            ),
            Self::Fall(part) => {
                format!("the sum of squares fell by {part:.1e} of itself (limit {FALL_LIMIT:.0e})")
            }
        }
    }
}

/// What the iteration found.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The values.
    pub estimate: Estimate,
    /// Which parameters the data determine; the others kept their values.
    pub identifiable: Identifiable,
    /// The parameters kept.
    pub parameters: Vec<Parameter>,
    /// The normal equations of those at the solution.
    pub normal: Normal,
    /// The loss with its final scale.
    pub loss: Loss,
    /// Passes over the data.
    pub passes: usize,
    /// Why it stopped.
    pub stop: Stop,
}

fn moved(estimate: &Estimate, parameters: &[Parameter], step: &DVector<f64>) -> Estimate {
    let mut next = estimate.clone();
    for (parameter, size) in parameters.iter().zip(step.iter()) {
        *next.value_mut(parameter.subject) += size * parameter.scale;
    }
    next
}

/// Moves the deviation of the base into its place, so that its angles stay small.
pub fn absorb_base(estimate: &mut Estimate) {
    for effect in estimate
        .effects
        .iter_mut()
        .filter(|e| e.kind == Kind::BaseFrame)
    {
        estimate.world_from_base =
            estimate.world_from_base * Pose::from_xyz_rxryrz(effect.parameters);
        effect.parameters = [0.0; MOST_PARAMETERS];
    }
}

struct Iteration<'a> {
    problem: &'a Problem,
    parameters: &'a [Parameter],
    loss: Loss,
    passes: usize,
    /// Whether the base's deviation may be moved into its place.
    free_base: bool,
    /// Called before each pass.
    tell: &'a mut dyn FnMut(),
}

impl Iteration<'_> {
    fn normal(&mut self, estimate: &Estimate) -> Normal {
        self.passes += 1;
        (self.tell)();
        Normal::of(self.problem, estimate, self.parameters, self.loss)
    }

    /// Until the step or the fall is below its limit.
    fn run(
        &mut self,
        estimate: &mut Estimate,
        normal: &mut Normal,
        most_passes: usize,
    ) -> Result<Stop, IdentifyError> {
        let mut damping = 0.0;
        let mut largest = f64::INFINITY;
        while self.passes < most_passes {
            let mut damped = normal.matrix.clone();
            for i in 0..damped.nrows() {
                damped[(i, i)] *= 1.0 + damping;
            }
            let Some(factor) = damped.cholesky() else {
                damping = f64::max(10.0 * damping, 1e-9);
                self.passes += 1;
                continue;
            };
            let step = factor.solve(&normal.gradient);
            largest = step.amax();
            let promised = step.dot(&normal.gradient) / normal.cost.max(f64::MIN_POSITIVE);
            if largest < STEP_LIMIT {
                *estimate = moved(estimate, self.parameters, &step);
                return Ok(Stop::Step(largest));
            }
            let mut next = moved(estimate, self.parameters, &step);
            if self.free_base {
                absorb_base(&mut next);
            }
            if promised < FALL_LIMIT && damping == 0.0 && largest < SMALL_STEP {
                // what a further pass would find is smaller still, as the square of this
                *estimate = next;
                return Ok(Stop::Fall(promised));
            }
            let tried = self.normal(&next);
            if tried.cost.is_finite() && tried.cost <= normal.cost * (1.0 + 1e-12) {
                let fall = 1.0 - tried.cost / normal.cost.max(f64::MIN_POSITIVE);
                *estimate = next;
                *normal = tried;
                damping = if damping < 1e-8 { 0.0 } else { 0.1 * damping };
                if damping == 0.0 && fall < FALL_LIMIT && promised < FALL_LIMIT {
                    return Ok(Stop::Fall(fall));
                }
            } else if promised < FALL_LIMIT {
                return Ok(Stop::Fall(promised));
            } else {
                damping = f64::max(10.0 * damping, 1e-4);
            }
        }
        if let Some(fall) = self.nearly(normal) {
            return Ok(Stop::Fall(fall));
        }
        Err(IdentifyError::NotConverged {
            passes: self.passes,
            step: largest,
            limit: STEP_LIMIT,
        })
    }

    /// The part of the loss that a full step promises still, where that step is a small part of the
    /// parameters' standard deviations: what weighs rows comes to rest slowly.
    fn nearly(&self, normal: &Normal) -> Option<f64> {
        if self.loss.shape == Shape::Squares {
            return None;
        }
        let step = normal.matrix.clone().cholesky()?.solve(&normal.gradient);
        let fall = step.dot(&normal.gradient);
        let is_small = fall < (SMALL_PART * self.loss.scale).powi(2);
        is_small.then(|| fall / normal.cost.max(f64::MIN_POSITIVE))
    }
}

/// Parameters that the data determine, and the normal equations of those, while they are being
/// found.
struct Chosen {
    known: Identifiable,
    normal: Normal,
}

impl Chosen {
    /// Chooses among all parameters of a problem at an estimate.
    fn of(problem: &Problem, estimate: &Estimate, loss: Loss) -> Self {
        let all = &problem.parameters;
        let normal = Normal::of(problem, estimate, all, loss);
        let known = identifiable(&normal, all, None);
        let normal = normal.part(&known.kept);
        Self { known, normal }
    }

    fn parameters(&self, problem: &Problem) -> Vec<Parameter> {
        picked(problem, &self.known.kept)
    }

    /// Those that were left out because too little was known of them; what others do as well stays
    /// out.
    fn may_return(&self) -> Vec<usize> {
        let dropped = self.known.dropped.iter();
        let unseen = dropped.filter(|d| d.weak.is_some() || d.confounded_with.is_empty());
        unseen.map(|d| d.parameter).collect()
    }

    /// Chooses again among some parameters, of which `normal` has the normal equations; those left
    /// out go back to their origin. Whether the choice is another one.
    fn choose_again(
        &mut self,
        problem: &Problem,
        (among, normal): (&[usize], &Normal),
        noise: f64,
        (estimate, origin): (&mut Estimate, &Estimate),
    ) -> bool {
        let parameters = picked(problem, among);
        let left = problem.numbers().saturating_sub(parameters.len()).max(1);
        let noise = noise * (problem.numbers() as f64 / left as f64).sqrt();
        let again = identifiable(normal, &parameters, Some(noise));
        let kept: Vec<usize> = again.kept.iter().map(|i| among[*i]).collect();
        let is_other = kept != self.known.kept;
        self.known.dropped.retain(|d| !among.contains(&d.parameter));
        for mut dropped in again.dropped {
            dropped.parameter = among[dropped.parameter];
            for other in &mut dropped.confounded_with {
                *other = among[*other];
            }
            let subject = problem.parameters[dropped.parameter].subject;
            *estimate.value_mut(subject) = origin.value(subject);
            self.known.dropped.push(dropped);
        }
        self.known.kept = kept;
        is_other
    }
}

fn picked(problem: &Problem, indices: &[usize]) -> Vec<Parameter> {
    let each = indices.iter().map(|i| problem.parameters[*i].clone());
    each.collect()
}

/// The scale of the residuals in their standard deviations.
fn noise_of(problem: &Problem, normal: &Normal) -> f64 {
    let counts = problem.rows.iter().map(|row| row.observed.count());
    scale_of(&normal.squares, counts)
}

/// Solves a problem from a start.
///
/// Gauss–Newton steps on the normal equations; a step that does not lower the loss is damped
/// (Levenberg–Marquardt). Where there are many rows a sample of them comes first. The scale of a
/// robust loss is the residuals' median and is found again until it rests; parameters that were
/// left out before that are tried once more. With `free_base` the deviation of the base goes into
/// [`Estimate::world_from_base`].
///
/// # Errors
/// Too few numbers for the parameters that the data determine; no rest within 60 passes (240 with
/// a shape that weighs rows).
pub fn solve(
    problem: &Problem,
    start: Estimate,
    shape: Shape,
    free_base: bool,
) -> Result<Solution, IdentifyError> {
    solve_telling(problem, start, shape, free_base, &mut || ())
}

/// As [`solve`]; `tell` is called before each pass.
///
/// # Errors
/// As [`solve`].
pub fn solve_telling(
    problem: &Problem,
    start: Estimate,
    shape: Shape,
    free_base: bool,
    tell: &mut dyn FnMut(),
) -> Result<Solution, IdentifyError> {
    let mut estimate = start.clone();
    let origin = start;
    if free_base {
        absorb_base(&mut estimate);
    }
    let mut loss = Loss::squares();
    if problem.rows.len() > SAMPLE_FROM {
        let every = problem.rows.len() / SAMPLE;
        let sample = problem.with_rows(|i| i % every == 0);
        let mut chosen = begin(&sample, &estimate, shape, &mut loss);
        let parameters = chosen.parameters(&sample);
        let mut iteration = Iteration {
            problem: &sample,
            parameters: &parameters,
            loss,
            passes: 0,
            free_base,
            tell,
        };
        // what the sample cannot settle, all rows may
        let _ = iteration.run(&mut estimate, &mut chosen.normal, FIRST_PASSES);
        if shape != Shape::Squares {
            loss.scale = noise_of(&sample, &chosen.normal).max(LEAST_SCALE);
        }
    }
    let mut chosen = if loss.shape == Shape::Squares {
        begin(problem, &estimate, shape, &mut loss)
    } else {
        Chosen::of(problem, &estimate, loss)
    };
    let (mut passes, mut rounds, mut returns) = (1, 0, 0);
    loop {
        let parameters = chosen.parameters(problem);
        if problem.numbers() <= parameters.len() {
            return Err(IdentifyError::TooFew {
                numbers: problem.numbers(),
                rows: problem.rows.len(),
                parameters: parameters.len(),
            });
        }
        let mut iteration = Iteration {
            problem,
            parameters: &parameters,
            loss,
            passes,
            free_base,
            tell,
        };
        let own = match (rounds, loss.shape) {
            (0, _) => FIRST_PASSES,
            (_, Shape::Squares) => MOST_PASSES,
            _ => MOST_SLOW_PASSES,
        };
        let rested = iteration.run(&mut estimate, &mut chosen.normal, passes + own);
        passes = iteration.passes;
        // far from the start columns may have become redundant; and only now the noise is known
        let noise = noise_of(problem, &chosen.normal);
        let (kept, normal) = (chosen.known.kept.clone(), chosen.normal.clone());
        let fewer = chosen.choose_again(problem, (&kept, &normal), noise, (&mut estimate, &origin));
        let stop = match rested {
            Ok(stop) => stop,
            Err(error) if rounds > 0 => return Err(error),
            Err(_) if !fewer => {
                rounds += 1;
                continue;
            }
            Err(_) => Stop::Step(f64::NAN),
        };
        if fewer && rounds < MOST_ROUNDS {
            let parameters = chosen.parameters(problem);
            chosen.normal = Normal::of(problem, &estimate, &parameters, loss);
            passes += 1;
            rounds += 1;
            continue;
        }
        if shape != Shape::Squares && rounds < MOST_ROUNDS {
            let scale = noise.max(LEAST_SCALE);
            let settled = loss.shape == shape && (scale / loss.scale - 1.0).abs() < SCALE_LIMIT;
            if !settled {
                loss = Loss { shape, scale };
                rounds += 1;
                passes += 1;
                chosen.normal = Normal::of(problem, &estimate, &parameters, loss);
                continue;
            }
        }
        let mut among = chosen.may_return();
        if !among.is_empty() && returns < MOST_RETURNS && rounds < MOST_ROUNDS {
            // what was left out when less was known
            among.extend(&chosen.known.kept);
            among.sort_unstable();
            let normal = Normal::of(problem, &estimate, &picked(problem, &among), loss);
            passes += 1;
            let values = (&mut estimate, &origin);
            if chosen.choose_again(problem, (&among, &normal), noise, values) {
                let parameters = chosen.parameters(problem);
                chosen.normal = Normal::of(problem, &estimate, &parameters, loss);
                passes += 1;
                returns += 1;
                rounds += 1;
                continue;
            }
        }
        return Ok(Solution {
            estimate,
            identifiable: chosen.known,
            parameters,
            normal: chosen.normal,
            loss,
            passes,
            stop,
        });
    }
}

/// What is identified first. Of a robust loss the scale is that of the residuals at the start, so
/// that gross errors do not bend the first steps.
fn begin(problem: &Problem, estimate: &Estimate, shape: Shape, loss: &mut Loss) -> Chosen {
    let first = Chosen::of(problem, estimate, *loss);
    if shape == Shape::Squares {
        return first;
    }
    *loss = Loss {
        shape: Shape::Huber,
        scale: noise_of(problem, &first.normal).max(LEAST_SCALE),
    };
    Chosen::of(problem, estimate, *loss)
}

/// Whether a parameter is one of an effect of this kind.
#[must_use]
pub fn belongs(estimate: &Estimate, parameter: &Parameter, kind: Kind) -> bool {
    match parameter.subject {
        Subject::Effect(slot) => estimate.effects[slot.effect].kind == kind,
        Subject::Point { .. } | Subject::Feature { .. } => false,
    }
}
