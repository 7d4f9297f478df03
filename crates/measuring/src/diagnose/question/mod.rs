//! What a diagnosis starts from: the model's residuals and the parameters that are fitted along.

pub mod noise;
pub mod shifts;
mod worth;

use self::noise::{Orientations, Repeats, of_repeats};
use self::shifts::Shifts;
use self::worth::g_at_rows;
use crate::diagnose::estimator::fit::Normal;
use crate::diagnose::estimator::refit::{Start, refit};
use crate::diagnose::estimator::table::{Column, Layout, table};
use crate::diagnose::search::candidates::{Candidate, Candidates, columns_of};
use crate::diagnose::search::tried::{Tried, choice};
use crate::diagnose::search::waves;
use crate::diagnose::search::{Chosen, World};
use crate::geometry::Pose;
use crate::identify::IdentifyError;
use crate::identify::base::{BasePolicy, is_same_place};
use crate::identify::calibration::{Options as CalibrationOptions, calibrate, fit_frames};
use crate::identify::input_checks::{Remark, finite, screening, temperatures};
use crate::identify::measurements::{Measurements, Purpose};
use crate::identify::parameters::{Level, Selection, Subject};
use crate::identify::pick::Pick;
use crate::identify::problem::{Estimate, Problem};
use crate::identify::robust::Shape;
use crate::identify::start::{self, base_gap};
use crate::model::effects::{Effect, Kind};
use crate::profile::{ControllerModel, Profile};

/// Numbers beyond the parameters that an estimate of the noise takes.
const SPARE: usize = 10;

/// Least scale of residuals where nothing is known of the noise.
pub(crate) const LEAST: f64 = 1e-6;

/// What is known of the arm before its effects are sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trust {
    /// The profile's calibration holds but for its uncertainty: it is worth 1/g of these
    /// measurements.
    Calibrated {
        /// Zellner's g.
        g: f64,
    },
    /// Frames, geometry and the profile's other parameters are fitted anew.
    Nothing,
}

/// The measurements against the model.
pub struct Session {
    /// The comparison, all rows.
    pub problem: Problem,
    /// Values before any effect is added.
    pub estimate: Estimate,
    /// The present model with its frames fitted where they have to be: residuals in standard
    /// deviations.
    pub present: Column,
    /// Its values.
    pub present_estimate: Estimate,
    /// Numbers of rows.
    pub layout: Layout,
    /// The values about which everything is linear: those before any effect is added, and large
    /// steps of the device or the base.
    pub about: Estimate,
    /// Residuals at `estimate`, as they follow from `about`.
    pub residual: Column,
    /// Columns of the problem's parameters.
    pub columns: Vec<Column>,
    /// How freely each is fitted.
    pub shares: Vec<f64>,
    /// What is known of the arm, where it is measured.
    pub trust: Trust,
    /// Values that are chosen from lists.
    pub tried: Tried,
    /// What is tried.
    pub candidates: Candidates,
    /// Noise by repeated poses, where `sigma_mm` does not state it.
    pub repeats: Option<Repeats>,
    /// Poses of whose orientations no column says how sure they are.
    pub(crate) orientations: Orientations,
    /// Their standard deviation, in that which the sigma of their places gives them.
    pub(crate) orientations_by: f64,
    /// Whether the device's frame is not the profile's: the base is fitted.
    pub elsewhere: bool,
    /// What brings the measurements to where the profile has the base, where the device is
    /// elsewhere.
    pub(crate) nearer: Pose,
    /// Large steps of the device or the base.
    pub(crate) shifts: Shifts,
    /// Where the device's frame is taken to be; what the base is fitted to beyond it is the
    /// device's, too.
    pub world_from_device: Pose,
}

/// Whether a profile has no calibration at all.
#[must_use]
pub fn is_nominal(profile: &Profile) -> bool {
    let geometry = profile.effects.iter().any(|e| e.kind == Kind::LinkGeometry);
    !geometry && profile.controller == ControllerModel::Nominal
}

/// What every calibration fits, whatever the profile has.
pub(crate) fn is_frame_or_geometry(kind: Kind) -> bool {
    matches!(kind, Kind::BaseFrame | Kind::ToolFrame | Kind::LinkGeometry)
}

/// What is fitted along: frames and geometry, what the profile already has, and joint compliance
/// where it has nothing yet.
fn selection(profile: &Profile) -> Selection {
    let nominal = is_nominal(profile);
    let mut selection = Selection::level(if nominal {
        Level::Compliance
    } else {
        Level::Geometry
    });
    // what a rail does is sought on top of what the profile has: no part of it is fitted along
    selection.fix = Pick::track();
    let own = profile.effects.iter().filter(|e| {
        let is_of_arm = !e.definition().of_external_axis();
        // of frames and geometry the level says what is fitted
        is_of_arm && !is_frame_or_geometry(e.kind) && !e.definition().search.held
    });
    selection.identify = own.map(Pick::of).collect();
    selection
}

/// Rows to choose effects with.
#[must_use]
pub fn for_choice(measurements: &Measurements) -> Vec<bool> {
    measurements
        .rows
        .iter()
        .map(|row| row.purpose != Some(Purpose::Validate))
        .collect()
}

fn take_over(into: &mut Estimate, from: &Estimate, problem: &Problem, other: &Problem) {
    into.world_from_base = from.world_from_base;
    for effect in &mut into.effects {
        if let Some(known) = from.effects.iter().find(|e| e.same_place(effect)) {
            effect.parameters = known.parameters;
        }
    }
    for (point, value) in problem.points.iter().zip(&mut into.points_m) {
        if let Some(index) = other.points.iter().position(|p| p.name == point.name) {
            *value = from.points_m[index];
        }
    }
    for (feature, value) in problem.features.iter().zip(&mut into.features) {
        if let Some(index) = other.features.iter().position(|f| f.name == feature.name) {
            *value = feature.numbers_of(&other.features[index].place(&from.features[index]));
        }
    }
}

/// Whether the model with its effects fits the rows at least as well as they are as it does when they
/// are moved: the place of the base was found with the arm without its effects, which a soft arm is
/// far from.
fn is_at_home(
    profile: &Profile,
    rows: &Measurements,
    selection: &Selection,
    nearer: &Pose,
) -> bool {
    let missed = |rows: &Measurements| {
        let made = Problem::new(profile, rows, selection, profile.world_from_base);
        let (problem, own) = made
            .ok()
            .filter(|(of, _)| of.points.iter().all(|p| p.known))?;
        let (residual, _) = table(&problem, &own, &[]);
        Some(residual.iter().map(|number| number * number).sum::<f64>())
    };
    match (missed(rows), missed(&rows.clone().moved(nearer))) {
        (Some(own), Some(moved)) => own <= moved,
        _ => false,
    }
}

/// Prepares a session; `weight` is that of orientations of which no column says how sure they are.
///
/// # Errors
/// As [`calibrate`]: measurements that contradict the robot or themselves, or are too few.
pub fn session(
    profile: &Profile,
    measurements: &Measurements,
    trust: Trust,
    leave: &dyn Fn(&Effect) -> bool,
    (shifts, weight): (&Shifts, Option<f64>),
) -> Result<(Session, Vec<Remark>), IdentifyError> {
    let fit = shifts.undone(measurements);
    let fit = fit.filtered(|_, row| row.purpose != Some(Purpose::Validate));
    if fit.rows.is_empty() {
        return Err(IdentifyError::NothingToFit);
    }
    finite::check(profile, measurements)?;
    let mut remarks = screening::look(profile, &fit)?;
    remarks.extend(temperatures::check(measurements)?);
    let guess = start::find(profile, &fit);
    if let Some(guess) = &guess {
        remarks.extend(screening::check_start(profile, &fit, guess)?);
        screening::check_points(guess)?;
        if !is_nominal(profile) {
            screening::check_rotated_tools(profile, guess)?;
        }
    }
    let selection = selection(profile);
    let base = guess
        .as_ref()
        .map_or(profile.world_from_base, |g| g.world_from_base);
    let real = profile.world_from_real_base();
    // a track would take a turned device for its own error
    let on_track = !profile.external.track.is_empty();
    let elsewhere = on_track
        || !is_same_place(base_gap(&real, &base))
            && !is_at_home(profile, &fit, &selection, &(real * base.inverse()));
    let nearer = if elsewhere {
        real * base.inverse()
    } else {
        Pose::identity()
    };
    let (fit, measurements) = (fit.moved(&nearer), &measurements.clone().moved(&nearer));
    let (mut problem, own) =
        Problem::new(profile, measurements, &selection, profile.world_from_base)?;
    problem.gravity_by_base = on_track;
    let layout = Layout::of(&problem).by_configuration(&measurements.configurations());
    let used = fit.rows.len();
    let numbers: usize = (0..layout.rows())
        .filter(|r| measurements.rows[*r].purpose != Some(Purpose::Validate))
        .map(|r| layout.row(r).len())
        .sum();
    // some numbers beyond the parameters, or there is no telling what is noise
    if numbers < problem.parameters.len() + SPARE {
        return Err(IdentifyError::TooFew {
            numbers,
            rows: used,
            parameters: problem.parameters.len(),
        });
    }
    let unknown_points = problem.points.iter().any(|p| !p.known);
    let mut present_estimate = own.clone();
    if elsewhere || unknown_points || is_nominal(profile) || trust == Trust::Nothing {
        // where a calibration has the tool is a finding if it is elsewhere
        let tools_held = !is_nominal(profile) && trust != Trust::Nothing;
        let (other, solution) = fit_frames(profile, &fit, Shape::Huber, tools_held)?;
        take_over(&mut present_estimate, &solution.estimate, &problem, &other);
    }
    let estimate = match trust {
        Trust::Nothing => {
            let options = CalibrationOptions {
                selection: selection.clone(),
                shape: Shape::Huber,
                base: BasePolicy::Device,
            };
            // the rows are in the controller's world already
            let here = Profile {
                device: None,
                ..profile.clone()
            };
            match calibrate(&here, &fit, &options) {
                Ok(found) => {
                    let mut estimate = own.clone();
                    take_over(
                        &mut estimate,
                        &found.solution.estimate,
                        &problem,
                        &found.problem,
                    );
                    estimate
                }
                // what is missing may keep it from resting: a few robust steps are enough to start
                // from
                Err(IdentifyError::NotConverged { .. }) => {
                    let shares = vec![1.0; problem.parameters.len()];
                    let used = for_choice(measurements);
                    let start = Start {
                        problem: &problem,
                        layout: &layout,
                        estimate: &present_estimate,
                        shares: &shares,
                        floor: 1e-6,
                    };
                    refit(start, &[], &used).0.estimate
                }
                Err(other) => return Err(other),
            }
        }
        Trust::Calibrated { .. } => present_estimate.clone(),
    };
    let about = shifts.in_estimate(&estimate, &nearer);
    let share = match trust {
        Trust::Nothing => 1.0,
        Trust::Calibrated { g } => g / (1.0 + g),
    };
    let free = |subject: Subject| match subject {
        Subject::Point { .. } | Subject::Feature { .. } => true,
        Subject::Effect(slot) => elsewhere && estimate.effects[slot.effect].kind == Kind::BaseFrame,
    };
    let shares: Vec<f64> = problem
        .parameters
        .iter()
        .map(|p| if free(p.subject) { 1.0 } else { share })
        .collect();
    let used = for_choice(measurements);
    let orientations = Orientations::of(&problem, measurements, &used);
    let orientations_by = if let Some(times) = weight {
        orientations.scale(&mut problem, times);
        times
    } else {
        orientations.weigh(&mut problem, (&layout, &used), (&about, &shares))
    };
    let (residual, columns) = shifts.linear(&problem, &about);
    // columns that do what those before them do are left out for good: given an effect found later,
    // a last link that bends, they would be distinguished by almost nothing and run away together
    let own = (&columns[..], &shares[..]);
    let mut kept = Normal::of((&layout, &used), &residual, own, LEAST).kept();
    kept.sort_unstable();
    let columns = columns.into_iter().enumerate();
    let columns: Vec<Column> = columns
        .filter(|(i, _)| kept.contains(i))
        .map(|(_, column)| column)
        .collect();
    let mut shares: Vec<f64> = kept.iter().map(|i| shares[*i]).collect();
    problem.parameters = kept
        .iter()
        .map(|i| problem.parameters[*i].clone())
        .collect();
    let trust = match trust {
        Trust::Nothing => trust,
        Trust::Calibrated { g } => {
            let own = (&columns[..], &shares[..]);
            let g = g_at_rows(g, profile, (&problem, &about), (&layout, &used), own);
            for share in shares.iter_mut().filter(|share| **share < 1.0) {
                *share = g / (1.0 + g);
            }
            Trust::Calibrated { g }
        }
    };
    let (present, _) = table(&problem, &present_estimate, &[]);
    let tried = Tried::of(&problem, &estimate);
    let mut candidates = Candidates::of(&problem, &about, measurements, &tried, leave);
    let own = (&columns[..], &shares[..]);
    let normal = Normal::of((&layout, &used), &residual, own, LEAST);
    candidates.say_absorbed(&normal, &estimate.effects);
    let repeats = if problem.sigma_assumed {
        of_repeats(&problem, &layout, &residual, &used)
    } else {
        None
    };
    Ok((
        Session {
            problem,
            estimate,
            present,
            present_estimate,
            layout,
            about,
            residual,
            columns,
            shares,
            trust,
            tried,
            candidates,
            repeats,
            orientations,
            orientations_by,
            elsewhere,
            nearer,
            shifts: shifts.clone(),
            world_from_device: nearer * profile.world_from_device(),
        },
        remarks,
    ))
}

impl Session {
    /// What a fit of everything begins with.
    #[must_use]
    pub(crate) fn start(&self) -> Start<'_> {
        Start {
            problem: &self.problem,
            layout: &self.layout,
            estimate: &self.estimate,
            shares: &self.shares,
            floor: self.floor(),
        }
    }

    /// What the search looks at, with the rows in use.
    #[must_use]
    pub fn world<'a>(&'a self, used: &'a [bool], accepted: &'a [Pick]) -> World<'a> {
        self.world_of(used, accepted, &self.shares)
    }

    /// The same with other shares: how freely what the profile has is fitted.
    #[must_use]
    pub(crate) fn world_of<'a>(
        &'a self,
        used: &'a [bool],
        accepted: &'a [Pick],
        shares: &'a [f64],
    ) -> World<'a> {
        let layout = &self.layout;
        let own = (&self.columns[..], shares);
        let in_use = (0..layout.rows()).filter(|row| used[*row]);
        let numbers: usize = in_use.map(|row| layout.row(row).len()).sum();
        World {
            layout,
            held: &self.columns,
            candidates: &self.candidates,
            normal: Normal::of((layout, used), &self.residual, own, self.floor()),
            numbers: numbers as f64,
            used,
            accepted,
        }
    }

    /// The residuals' scale is at least this: stated noise is not lowered, that of
    /// repeated poses not below what it is known to be.
    #[must_use]
    pub fn floor(&self) -> f64 {
        if self.problem.sigma_assumed {
            self.repeats.map_or(LEAST, |r| r.least().max(LEAST))
        } else {
            1.0
        }
    }

    /// Adds candidates with list values nearer to those found, a knee's torque, a time constant,
    /// and waves that the residual has. Whether there were any.
    pub fn refine(
        &mut self,
        chosen: &[Chosen],
        used: &[bool],
        leave: &dyn Fn(&Effect) -> bool,
    ) -> bool {
        let world = self.world(used, &[]);
        let fit = world.fit(chosen);
        let least = 2.0 * world.numbers.ln() + 2.0 * (waves::places() as f64).ln();
        let (problem, estimate) = (&self.problem, &self.about);
        let mut peaks = waves::peaks(
            problem,
            estimate,
            &self.layout,
            &fit,
            &self.candidates,
            least,
        );
        // those next to a wave found say how well its order is known
        let found = chosen.iter().map(|c| &c.candidate.effect);
        peaks.extend(found.flat_map(|effect| waves::neighbours(effect, &self.candidates)));
        peaks.retain(|effect| !leave(effect));
        let mut any = !peaks.is_empty();
        (self.candidates).add_waves(&self.problem, &self.about, peaks);
        for found in chosen {
            let effect = &found.candidate.effect;
            let Some(number) = choice(&self.problem, effect) else {
                continue;
            };
            let at = effect.parameters[number];
            let near: Vec<f64> = self
                .candidates
                .list
                .iter()
                .filter(|c| c.effect.kind == effect.kind && c.effect.site == effect.site)
                .filter(|c| !c.is_measure)
                .map(|c| c.effect.parameters[number])
                .collect();
            let below = near
                .iter()
                .copied()
                .filter(|v| *v < at)
                .fold(0.5 * at, f64::max);
            let above = near
                .iter()
                .copied()
                .filter(|v| *v > at)
                .fold(f64::INFINITY, f64::min)
                .min(2.0 * at);
            let mut wanted = Vec::new();
            for value in [
                0.6 * at + 0.4 * below,
                0.8 * at + 0.2 * below,
                0.8 * at + 0.2 * above,
                0.6 * at + 0.4 * above,
            ] {
                let mut effect = effect.clone();
                effect.parameters[number] = value;
                wanted.push((effect, found.candidate.sought.clone()));
            }
            let columns = columns_of(&self.problem, &self.about, &wanted);
            for ((effect, _), own) in wanted.into_iter().zip(columns) {
                let first = self.candidates.columns.len();
                let count = own.len();
                self.candidates.columns.extend(own);
                self.candidates.list.push(Candidate {
                    steady: self.candidates.steady(&effect),
                    effect,
                    columns: (first..first + count).collect(),
                    ..found.candidate.clone()
                });
            }
            any = true;
        }
        any
    }
}
