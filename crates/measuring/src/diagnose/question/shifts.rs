//! Large steps of the device or the base within the measurements. Everything is linear about them,
//! and the start is that of the rows with them undone: it would stand between the two places else.

use crate::diagnose::estimator::refit::{Refit, refit};
use crate::diagnose::estimator::table::{Column, add_scaled, table};
use crate::diagnose::question::Session;
use crate::diagnose::search::candidates::parameter;
use crate::diagnose::search::{Chosen, World};
use crate::geometry::units::DEG;
use crate::geometry::{Pose, norm, sub};
use crate::identify::measurements::{Measurements, Purpose};
use crate::identify::parameters::Parameter;
use crate::identify::problem::{Estimate, Problem};
use crate::identify::start;
use crate::model::effects::{Effect, Kind, MOST_PARAMETERS, Site};
use crate::profile::Profile;

/// A step is large from so many metres on where the robot stands: a quarter of how far a base may
/// stand from where the profile has it.
const LARGE_M: f64 = 0.005;
/// Or from this rotation on, radians.
const LARGE_RAD: f64 = 0.25 * DEG;
/// It has come to rest where it moves by less, metres.
const AT_REST_M: f64 = 1e-5;
/// And rotates by less, radians.
const AT_REST_RAD: f64 = 1e-5;

/// Where the device or the base stands from a row on.
#[derive(Clone, Debug)]
struct Shift {
    /// From 1.
    row: u32,
    /// What all steps up to this one do to the measurements, in their frame.
    moved: Pose,
}

/// The steps, the first row first.
#[derive(Clone, Debug, Default)]
pub struct Shifts(Vec<Shift>);

fn is_shift(chosen: &Chosen) -> bool {
    chosen.candidate.effect.kind == Kind::FrameShift
}

impl Shifts {
    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether a search found a step at each of their rows.
    pub(crate) fn are_among(&self, chosen: &[Chosen]) -> bool {
        let rows = || chosen.iter().filter(|c| is_shift(c)).count();
        self.0.len() <= rows()
    }

    /// The steps that a search found, where they are large, or not where these are; `None` where
    /// these will do.
    pub(crate) fn next(
        &self,
        (profile, measurements): (&Profile, &Measurements),
        session: &Session,
        chosen: &[Chosen],
        used: &[bool],
    ) -> Option<Self> {
        let mut own: Vec<usize> = (0..chosen.len())
            .filter(|i| is_shift(&chosen[*i]))
            .collect();
        own.sort_by_key(|i| chosen[*i].candidate.effect.site.order);
        if own.is_empty() {
            return None;
        }
        if self.is_empty() {
            let is_large = |i: &usize| is_large(session, &chosen[*i]);
            if !own.iter().any(is_large) {
                return None;
            }
            let rows = own.iter().map(|i| chosen[*i].candidate.effect.site.order);
            return Self::by_parts(profile, measurements, &rows.collect::<Vec<_>>());
        }
        let (refit, _) = refit(session.start(), chosen, used);
        let next = Self::fitted(session, &refit, &own);
        (!next.is_near(self)).then_some(next)
    }

    /// By where each part of the rows sees the base.
    fn by_parts(profile: &Profile, measurements: &Measurements, rows: &[u32]) -> Option<Self> {
        let base = |from: u32, to: u32| {
            let part = measurements.filtered(|row, m| {
                let row = u32::try_from(row + 1).unwrap_or(u32::MAX);
                (from..to).contains(&row) && m.purpose != Some(Purpose::Validate)
            });
            let found = (!part.rows.is_empty()).then(|| start::find(profile, &part));
            found.flatten().map(|start| start.world_from_base)
        };
        let first = base(1, rows[0])?.inverse();
        let ends = rows[1..].iter().copied().chain([u32::MAX]);
        let each = rows.iter().zip(ends).map(|(row, end)| {
            let moved = base(*row, end)? * first;
            Some(Shift { row: *row, moved })
        });
        each.collect::<Option<_>>().map(Self)
    }

    /// As everything together was fitted.
    fn fitted(session: &Session, refit: &Refit, own: &[usize]) -> Self {
        let mut total = [0.0; MOST_PARAMETERS];
        let mut all = Vec::new();
        for i in own {
            let effect = &refit.estimate.effects[refit.places[*i]];
            for (sum, by) in total.iter_mut().zip(effect.parameters) {
                *sum += by;
            }
            let nearer = &session.nearer;
            all.push(Shift {
                row: effect.site.order,
                moved: nearer.inverse() * Pose::from_xyz_rxryrz(total) * *nearer,
            });
        }
        Self(all)
    }

    fn is_near(&self, other: &Self) -> bool {
        let near = |(a, b): (&Shift, &Shift)| {
            let gap = a.moved.separation(&b.moved);
            a.row == b.row && gap.distance_m < AT_REST_M && gap.angle_rad < AT_REST_RAD
        };
        self.0.len() == other.0.len() && self.0.iter().zip(&other.0).all(near)
    }

    /// The measurements as if nothing had moved.
    pub(crate) fn undone(&self, measurements: &Measurements) -> Measurements {
        let mut undone = measurements.clone();
        for (number, row) in (1..).zip(&mut undone.rows) {
            if let Some(last) = self.0.iter().rfind(|shift| shift.row <= number) {
                row.move_by(&last.moved.inverse());
            }
        }
        undone
    }

    /// The same as effects, in a frame that is so much nearer to the controller's world.
    fn effects(&self, nearer: &Pose) -> Vec<Effect> {
        let mut before = [0.0; MOST_PARAMETERS];
        let each = self.0.iter().map(|shift| {
            let moved = *nearer * shift.moved * nearer.inverse();
            let now = moved.xyz_rxryrz();
            let parameters = std::array::from_fn(|k| now[k] - before[k]);
            before = now;
            Effect {
                kind: Kind::FrameShift,
                site: Site {
                    order: shift.row,
                    ..Site::default()
                },
                parameters,
            }
        });
        each.collect()
    }

    /// The steps as effects that a search begins with: where they hold for few rows, these hardly
    /// count before.
    fn begun(&self, world: &World, nearer: &Pose) -> Vec<Chosen> {
        let list = &world.candidates.list;
        let own = list
            .iter()
            .filter(|c| c.effect.kind == Kind::FrameShift && c.row.is_some());
        let Some(widest) = own.max_by_key(|c| c.sought.len()) else {
            return Vec::new();
        };
        let begun = |effect: Effect| {
            let mut candidate = widest.clone();
            candidate.row = Some(effect.site.order);
            candidate.effect.site.order = effect.site.order;
            let definition = effect.definition();
            let value = |number: &usize| {
                let parameter = &definition.parameters[*number];
                effect.parameters[*number] / (parameter.prior_sigma * parameter.unit.in_si())
            };
            Chosen {
                columns: world.columns(&candidate),
                values: candidate.sought.iter().map(value).collect(),
                candidate,
                gain: 0.0,
                cost: 0.0,
                alternatives: Vec::new(),
            }
        };
        self.effects(nearer).into_iter().map(begun).collect()
    }

    /// An estimate with these steps.
    pub(crate) fn in_estimate(&self, estimate: &Estimate, nearer: &Pose) -> Estimate {
        let mut about = estimate.clone();
        about.effects.extend(self.effects(nearer));
        about
    }

    /// Residuals and columns of the problem's parameters about an estimate with these steps, as if
    /// everything were linear: the residuals are those without the steps, of a model whose columns
    /// are those about them.
    pub(crate) fn linear(&self, problem: &Problem, about: &Estimate) -> (Column, Vec<Column>) {
        let first = about.effects.len() - self.0.len();
        let own = about.effects.iter().enumerate().skip(first);
        let own = own.flat_map(|(at, effect)| {
            (0..MOST_PARAMETERS).map(move |number| parameter(at, effect, number))
        });
        let own: Vec<Parameter> = own.collect();
        let all: Vec<Parameter> = problem.parameters.iter().chain(&own).cloned().collect();
        let (mut residual, mut columns) = table(problem, about, &all);
        let steps = columns.split_off(problem.parameters.len());
        for (parameter, column) in own.iter().zip(&steps) {
            let value = about.value(parameter.subject) / parameter.scale;
            add_scaled(&mut residual, value, column);
        }
        (residual, columns)
    }
}

impl Session {
    /// What a search begins with: large steps, where there are.
    #[must_use]
    pub(crate) fn first(&self, world: &World) -> Vec<Chosen> {
        self.shifts.begun(world, &self.nearer)
    }
}

/// Whether a step found is too large for a start that stands between, or for what is linear.
fn is_large(session: &Session, chosen: &Chosen) -> bool {
    let effect = chosen.candidate.with(&chosen.values);
    let base = session.estimate.world_from_base.translation;
    let moved = Pose::from_xyz_rxryrz(effect.parameters);
    norm(sub(moved.transform(base), base)) > LARGE_M || moved.rotation.angle() > LARGE_RAD
}
