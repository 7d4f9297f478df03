//! The whole identification: screened measurements, a start, a solution, what it is worth.

use super::base::{BasePolicy, base_policy, device_of, is_same_place, refuse_other_world};
use super::contact;
use super::degrees;
use super::error::IdentifyError;
use super::expectation::expected_error_m;
use super::identifiability::{Observability, observability, singular_values};
use super::input_checks::{Remark, finite, plausibility, screening, temperatures};
use super::levelled::by_the_device;
use super::line::Line;
use super::measurements::{Measurements, Purpose};
use super::off::Off;
use super::orientations;
use super::outlying::of_fit;
use super::parameters::{Level, Parameter, Selection, Subject};
use super::pick::Pick;
use super::problem::{Estimate, LEVER_M, Problem};
use super::robust::Shape;
use super::solver::{Solution, Stop, solve, solve_telling};
use super::start::{self, Start, base_gap};
use super::statistics::{Miss, Quality, misses};
use super::uncertainty::Uncertainty;
use crate::geometry::Pose;
use crate::model::effects::Kind;
use crate::profile::{DevicePlace, Profile};

/// Correlations above this are reported.
pub const STRONG_CORRELATION: f64 = 0.9;

/// How to identify.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// What.
    pub selection: Selection,
    /// The loss.
    pub shape: Shape,
    /// What becomes of the base.
    pub base: BasePolicy,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            selection: Selection::level(Level::Compliance),
            shape: Shape::Huber,
            base: BasePolicy::Controller,
        }
    }
}

/// A row that the model misses by far more than the others.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlier {
    /// Index of the measurement.
    pub measurement: usize,
    /// Where it stands.
    pub line: Line,
    /// Its id.
    pub id: String,
    /// Measured minus expected.
    pub off: Off,
    /// How many times the typical residual it is, and from how many on a row is an outlier.
    pub times: f64,
    /// The limit.
    pub limit: f64,
    /// The weight it had, 0 to 1.
    pub weight: f64,
}

/// What was identified.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// The comparison.
    pub problem: Problem,
    /// The first guess.
    pub start: Start,
    /// The solution.
    pub solution: Solution,
    /// Base, tool and points alone.
    pub frames_only: Solution,
    /// Whether the measured base replaces the profile's.
    pub base_replaced: bool,
    /// Where the base stands in the calibrated profile.
    pub world_from_base: Pose,
    /// Where the device stands in the calibrated profile.
    pub device: Option<DevicePlace>,
    /// The rows used, in the frame that the estimates are in.
    pub fit: Measurements,
    /// Maps what the device gave into that frame.
    pub frame_from_device: Pose,
    /// How well it is known.
    pub uncertainty: Uncertainty,
    /// Orientations of which no column says how sure they are weigh as a position at this distance,
    /// metres, by what they scatter; `None` where there are none, or too few.
    pub orientation_lever_m: Option<f64>,
    /// Error of position that is to be expected over the joint limits, root mean square, metres.
    pub expected_m: Option<f64>,
    /// How well the configurations show the parameters.
    pub observability: Observability,
    /// The profile as it was, on the measurements.
    pub before: Quality,
    /// What it missed of every row.
    pub before_misses: Vec<Miss>,
    /// With base, tool and points fitted.
    pub frames_only_quality: Quality,
    /// With everything.
    pub after: Quality,
    /// Rows for `validate`, not used: frames only and everything.
    pub held_out: Option<(Quality, Quality)>,
    /// Rows that do not fit.
    pub outliers: Vec<Outlier>,
    /// What a person should look at.
    pub remarks: Vec<Remark>,
}

/// The start with what the first guess says of tools and points.
pub(super) fn begin(problem: &Problem, estimate: &mut Estimate, start: &Start) {
    for ((tool, point), on_flange) in &start.points_on_flange_m {
        let Some(mounted) = problem.tools.iter().find(|t| t.name == *tool) else {
            continue;
        };
        let back = mounted.flange_from_tool.inverse();
        if let Some(name) = point {
            let index = problem.points.iter().position(|p| p.name == *name);
            if let Some(index) = index.filter(|i| !problem.points[*i].known) {
                estimate.points_m[index] = back.transform(*on_flange);
            }
            continue;
        }
        // the tool's origin was measured: its frame moves there
        let turned = start
            .turned
            .iter()
            .find(|(name, _)| name == tool)
            .map(|(_, r)| *r);
        let real = Pose {
            rotation: turned.unwrap_or(mounted.flange_from_tool.rotation),
            translation: *on_flange,
        };
        let fitted = |kind: Kind, subject: Subject| match subject {
            Subject::Effect(slot) => estimate.effects[slot.effect].kind == kind,
            Subject::Point { .. } | Subject::Feature { .. } => false,
        };
        if !problem
            .parameters
            .iter()
            .any(|p| fitted(Kind::ToolFrame, p.subject))
        {
            continue;
        }
        let deviation = (mounted.flange_from_tool.inverse() * real).xyz_rxryrz();
        for parameter in &problem.parameters {
            if let Subject::Effect(slot) = parameter.subject {
                let effect = &mut estimate.effects[slot.effect];
                let mine = effect.site.is_of_tool(tool);
                if effect.kind == Kind::ToolFrame && mine {
                    effect.parameters[slot.parameter] = deviation[slot.parameter];
                }
            }
        }
    }
}

/// Whether a frame is to stay wholly where it is.
fn is_fixed(selection: &Selection, frame: Kind) -> bool {
    let mut fixed = selection.fix.iter();
    fixed.any(|pick| pick.kind == Some(frame) && pick.key.is_none())
}

/// Fits base, tools, unless they are held, and unknown points of a model to measurements and leaves
/// its arm as it is.
///
/// # Errors
/// As [`calibrate`].
pub fn fit_frames(
    profile: &Profile,
    measurements: &Measurements,
    shape: Shape,
    tools_held: bool,
) -> Result<(Problem, Solution), IdentifyError> {
    let mut selection = Selection::level(Level::Frames);
    if tools_held {
        selection.fix = picks("tool_frame");
    }
    let (problem, begun) = begin_frames(profile, measurements, &selection)?;
    let solution = solve(&problem, begun, shape, true)?;
    Ok((problem, solution))
}

/// What a list of words picks.
fn picks(words: &str) -> Vec<Pick> {
    Pick::parse_list(words).expect("words of the list")
}

/// The frames of a model that are fitted to measurements, and its points as well.
pub(super) fn frames_of(measurements: &Measurements, points_too: bool) -> Selection {
    let mut selection = Selection::level(Level::Frames);
    if points_too && measurements.rows.iter().any(|row| row.point.is_some()) {
        selection.identify = picks("points");
    }
    selection
}

/// The problem of fitting frames, and where it starts.
pub(super) fn begin_frames(
    profile: &Profile,
    measurements: &Measurements,
    selection: &Selection,
) -> Result<(Problem, Estimate), IdentifyError> {
    let guess = start::find(profile, measurements);
    let base = guess
        .as_ref()
        .map_or(profile.world_from_base, |s| s.world_from_base);
    let (mut problem, mut estimate) = Problem::new(profile, measurements, selection, base)?;
    problem.gravity_by_base = true;
    if let Some(guess) = &guess {
        estimate
            .effects
            .iter_mut()
            .filter(|e| e.kind == Kind::BaseFrame)
            .for_each(|e| e.parameters = [0.0; 6]);
        begin(&problem, &mut estimate, guess);
        contact::start(&mut problem, &mut estimate)?;
    }
    Ok((problem, estimate))
}

/// Identifies a robot's parameters from measurements.
///
/// # Errors
/// Measurements that contradict the robot or themselves, too few of them, a start that does not
/// follow from them, no convergence.
pub fn calibrate(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
) -> Result<Calibration, IdentifyError> {
    calibrate_telling(profile, measurements, options, &mut || ())
}

/// As [`calibrate`]; `tell` is called before each pass over the rows.
///
/// # Errors
/// As [`calibrate`].
pub fn calibrate_telling(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
    tell: &mut dyn FnMut(),
) -> Result<Calibration, IdentifyError> {
    let measurements = &*measurements.in_world_of(profile)?;
    let mut found = identify(profile, measurements, options, tell)?;
    let more = degrees::of_rail(profile, measurements, options, &found);
    let mut options = options.clone();
    if !more.is_empty() {
        options.selection.identify.extend(more);
        found = identify(profile, measurements, &options, tell)?;
    }
    let options = &options;
    let missed = |found: &Calibration| misses(&found.problem, &found.solution.estimate);
    plausibility::check_touches(measurements, &missed(&found), |other| {
        Ok(missed(&identify(profile, other, options, tell)?))
    })?;
    by_the_device(profile, measurements, options, found, tell)
}

/// As [`calibrate`], with the device where the profile has it, and without asking whether touches
/// are meant otherwise.
pub(super) fn identify(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
    tell: &mut dyn FnMut(),
) -> Result<Calibration, IdentifyError> {
    let fit = measurements.filtered(|_, row| row.purpose != Some(Purpose::Validate));
    if fit.rows.is_empty() {
        return Err(IdentifyError::NothingToFit);
    }
    finite::check(profile, measurements)?;
    let mut remarks = screening::look(profile, &fit)?;
    remarks.extend(temperatures::check(&fit)?);
    let found = start::find(profile, &fit);
    if let Some(found) = &found {
        remarks.extend(screening::check_start(profile, &fit, found)?);
        if is_fixed(&options.selection, Kind::ToolFrame) {
            screening::check_fixed_tool(profile, found)?;
        }
    }
    let sought = !is_fixed(&options.selection, Kind::BaseFrame);
    let mut guess = match found {
        Some(found) if sought => found,
        _ => Start::at(profile.world_from_base),
    };
    let by_controller = sought && options.base == BasePolicy::Controller;
    let mut world_from_device = profile.world_from_device();
    let mut fit = fit;
    let mut held = measurements.filtered(|_, row| row.purpose == Some(Purpose::Validate));
    let mut as_profile_has = None;
    if by_controller {
        // near enough for the axes of forces; gravity follows the base
        let real = profile.world_from_real_base();
        let has_device = profile.device.is_some();
        if has_device && is_same_place(base_gap(&real, &guess.world_from_base)) {
            as_profile_has = Some(fit.clone());
        }
        let nearer = real * guess.world_from_base.inverse();
        world_from_device = nearer * world_from_device;
        fit = fit.moved(&nearer);
        held = held.moved(&nearer);
        guess.world_from_base = real;
    }
    let moved_base = guess.world_from_base != profile.world_from_base;
    let (mut problem, mut estimate) =
        Problem::new(profile, &fit, &options.selection, guess.world_from_base)?;
    if problem.points.iter().all(|point| point.known) {
        screening::check_points(&guess)?;
    }
    problem.gravity_by_base = by_controller;
    let numbers = problem.distinct_numbers();
    if numbers <= problem.parameters.len() {
        return Err(IdentifyError::TooFew {
            numbers,
            rows: problem.rows.len(),
            parameters: problem.parameters.len(),
        });
    }
    let (before, before_misses) = {
        let mut own = Estimate {
            world_from_base: profile.world_from_base,
            ..estimate.clone()
        };
        let mut problem = match &as_profile_has {
            // the device stands where the profile has it
            Some(fit) => Problem::new(profile, fit, &options.selection, own.world_from_base)?.0,
            None => problem.clone(),
        };
        // what was touched stands where this model puts it
        contact::start(&mut problem, &mut own)?;
        let misses = misses(&problem, &own);
        (Quality::of(&problem.rows, &misses), misses)
    };
    if moved_base {
        estimate
            .effects
            .iter_mut()
            .filter(|e| e.kind == Kind::BaseFrame)
            .for_each(|e| e.parameters = [0.0; 6]);
    }
    begin(&problem, &mut estimate, &guess);
    contact::start(&mut problem, &mut estimate)?;
    let frames_selection = Selection {
        level: Level::Frames,
        identify: options
            .selection
            .identify
            .iter()
            .filter(|p| p.kind.is_none())
            .cloned()
            .collect(),
        ..options.selection.clone()
    };
    let frames_only = {
        let (frames, _) = Problem::new(profile, &fit, &frames_selection, guess.world_from_base)?;
        let mut start = estimate.clone();
        start.effects.truncate(start.effects.len());
        let mut frames = frames;
        frames.gravity_by_base = by_controller;
        frames.features.clone_from(&problem.features);
        frames.parameters = problem
            .parameters
            .iter()
            .filter(|p| frames.parameters.iter().any(|f| f.key == p.key))
            .cloned()
            .collect();
        solve_telling(&frames, start, options.shape, sought, tell)
            .map_err(|error| screening::check_rest(error, &guess))?
    };
    let frames_only_misses = misses(&problem, &frames_only.estimate);
    let frames_only_quality = Quality::of(&problem.rows, &frames_only_misses);
    let mut solve = |problem: &Problem| {
        let start = frames_only.estimate.clone();
        solve_telling(problem, start, options.shape, sought, tell)
            .map_err(|error| screening::check_rest(error, &guess))
    };
    let mut solution = solve(&problem)?;
    let mut orientation_lever_m = None;
    for _ in 0..orientations::TURNS {
        let Some(times) = orientations::rescaled(&problem, &fit, &solution) else {
            break;
        };
        orientations::scale(&mut problem, &fit, times);
        orientation_lever_m = Some(orientation_lever_m.unwrap_or(LEVER_M) / times);
        solution = solve(&problem)?;
        if (times - 1.0).abs() < orientations::AT_REST {
            break;
        }
    }
    let uncertainty = Uncertainty::of(&problem, &solution);
    let after_misses = misses(&problem, &solution.estimate);
    let after = Quality::of(&problem.rows, &after_misses);
    remarks.extend(plausibility::check_fit(
        &problem,
        &after_misses,
        &frames_only_misses,
        uncertainty.degrees_of_freedom,
    )?);
    remarks.extend(plausibility::check_values(
        &solution.parameters,
        &solution.estimate,
        &uncertainty.sigma,
        frames_only_quality.main().map_or(0.0, |spread| spread.rms),
    )?);
    remarks.extend(plausibility::check_scale(
        profile,
        &solution.parameters,
        &solution.estimate,
        &uncertainty.sigma,
    ));
    let observability = observability_of(&problem, &solution, &fit);
    let expected_m = expected_error_m(&problem, &solution.estimate, solution.loss, &uncertainty);
    remarks.extend(plausibility::check_reach(expected_m, &after_misses));
    remarks.extend(plausibility::check_left_out(
        &problem,
        options.shape,
        solution.parameters.len(),
    ));
    remarks.extend(plausibility::check_tool(&problem));
    let compliance = options.selection.level == Level::Compliance;
    remarks.extend(screening::check_masses(&problem, compliance));
    let base_replaced = sought && base_policy(options.base, profile, &mut solution)?;
    let (world_from_base, device) = if by_controller {
        let device = device_of(profile, &solution, &uncertainty, &world_from_device);
        (profile.world_from_base, Some(device))
    } else if base_replaced {
        // the device's frame becomes the world
        let base = world_from_device.inverse() * solution.estimate.world_from_base;
        refuse_other_world(profile, &base)?;
        (base, None)
    } else {
        (solution.estimate.world_from_base, profile.device)
    };
    let outliers = of_fit(&problem, &fit, &solution, &after_misses);
    remarks.extend(plausibility::check_rows(&outliers));
    // distances and contacts say of a tool only what the fit makes of them
    let is_known = guess.moved_m.iter().any(Option::is_some);
    if !is_known && remarks.iter().all(|known| known.id != "tool-elsewhere") {
        let estimate = &solution.estimate;
        remarks.extend(screening::moved_fitted_tools(profile, estimate));
    }
    let held_out = if held.rows.is_empty() {
        None
    } else {
        Some((
            judge(profile, &held, &problem, &frames_only.estimate)?,
            judge(profile, &held, &problem, &solution.estimate)?,
        ))
    };
    Ok(Calibration {
        observability,
        problem,
        start: guess,
        frames_only,
        base_replaced,
        world_from_base,
        device,
        fit,
        frame_from_device: world_from_device,
        expected_m,
        orientation_lever_m,
        uncertainty,
        before,
        before_misses,
        frames_only_quality,
        after,
        held_out,
        outliers,
        remarks,
        solution,
    })
}

/// What rows say of the parameters kept, by the singular values of the Jacobian in metres and
/// radians by the parameters in SI units, for rows of one standard deviation: their mean.
pub(super) fn observability_of(
    problem: &Problem,
    solution: &Solution,
    fit: &Measurements,
) -> Observability {
    let logs = problem.rows.iter().map(|row| row.sigma_m.ln());
    let sigma_m = (logs.sum::<f64>() / problem.rows.len().max(1) as f64).exp();
    let factor = solution.normal.factor().map(|mut r| {
        for (i, parameter) in solution.parameters.iter().enumerate() {
            r.column_mut(i).scale_mut(sigma_m / parameter.scale);
        }
        singular_values(&r)
    });
    let configurations = fit
        .configurations()
        .into_iter()
        .max()
        .map_or(0, |last| last + 1);
    observability(factor.unwrap_or_default(), configurations)
}

/// Quality of an estimate on other measurements of the same set-up.
///
/// # Errors
/// Unknown tools.
pub fn judge(
    profile: &Profile,
    measurements: &Measurements,
    problem: &Problem,
    estimate: &Estimate,
) -> Result<Quality, IdentifyError> {
    let selection = Selection::level(Level::Frames);
    let (other, mut values) =
        Problem::new(profile, measurements, &selection, estimate.world_from_base)?;
    for (point, value) in other.points.iter().zip(&mut values.points_m) {
        let same = problem.points.iter().position(|p| p.name == point.name);
        if let Some(index) = same {
            *value = estimate.points_m[index];
        }
    }
    values.effects.clone_from(&estimate.effects);
    let mut other = other;
    other.gravity_by_base = problem.gravity_by_base;
    contact::carry((problem, estimate), &mut other, &mut values)?;
    other.sort_rigs(&values.effects);
    Ok(Quality::of(&other.rows, &misses(&other, &values)))
}

impl Calibration {
    /// Why the iteration stopped.
    #[must_use]
    pub fn stop(&self) -> Stop {
        self.solution.stop
    }

    /// Every parameter that was asked for with its value and, where the data determine it, its
    /// standard deviation, SI.
    pub fn parameters(&self) -> impl Iterator<Item = (&Parameter, f64, Option<f64>)> {
        self.problem
            .parameters
            .iter()
            .enumerate()
            .map(|(i, parameter)| {
                let at = self.solution.identifiable.kept.iter().position(|k| *k == i);
                let value = self.solution.estimate.value(parameter.subject);
                (parameter, value, at.map(|at| self.uncertainty.sigma[at]))
            })
    }

    /// What the probe touched and was not wholly known, and where it was found in the device's
    /// frame.
    pub fn features(&self) -> impl Iterator<Item = (&contact::Feature, contact::Fitted)> {
        let values = &self.solution.estimate.features;
        let all = self.problem.features.iter().zip(values);
        let back = self.frame_from_device.inverse();
        all.filter(|(feature, _)| feature.unknowns() > 0)
            .map(move |(feature, values)| {
                let place = feature.place(values);
                let seen = contact::Fitted {
                    centre_m: back.transform(place.centre_m),
                    normal: place.normal.map(|normal| back.rotation * normal),
                    ..place
                };
                (feature, seen)
            })
    }

    /// The calibrated robot: the profile with the identified effects, points and, where it was
    /// replaced, base.
    #[must_use]
    pub fn profile(&self) -> Profile {
        let mut profile = self.problem.profile.clone();
        profile.world_from_base = self.world_from_base;
        profile.device = self.device;
        let estimate = &self.solution.estimate;
        let known = self.problem.profile.effects.iter();
        let of_base = known.filter(|e| self.problem.gravity_by_base && e.kind == Kind::BaseFrame);
        let found = estimate.effects.iter().filter(|e| !e.is_zero());
        profile.effects = found.chain(of_base).cloned().collect();
        for (point, value) in self
            .problem
            .points
            .iter()
            .zip(&self.solution.estimate.points_m)
        {
            let points = match point.plate {
                None => &mut profile.points,
                Some(plate) => &mut profile.external.positioners[plate].points,
            };
            points.insert(point.name.clone(), *value);
        }
        profile
    }
}
