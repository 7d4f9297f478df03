//! What a calibrated model is worth on measurements it has not seen.

pub use super::repeated::{Repeated, RepeatedDistance};

use super::calibration::{begin, begin_frames, frames_of};
use super::contact;
use super::error::IdentifyError;
use super::external::{in_files, plate_of};
use super::input_checks::{self, Remark};
use super::measurements::{Measurement, Measurements, Purpose};
use super::outlying;
use super::parameters::{Level, Parameter, Selection, Subject};
use super::problem::{Estimate, Problem};
use super::repeated::{groups, repeated, repeated_distances};
use super::robust::Shape;
use super::solver::solve;
use super::start;
use super::statistics::{Miss, Pairs, Quality, Spread, misses, pairs};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Vector, norm, sub};
use crate::model::effects::Kind;
use crate::model::external::Listed;
use crate::profile::Profile;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Regions of distance from the middle of the calibration that errors are reported by.
pub const REGIONS: usize = 5;

/// One model on the measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Position, orientation, distances from fixed points.
    pub quality: Quality,
    /// Distances between all pairs of points, mm.
    pub distance: Option<Pairs>,
    /// Every row.
    pub misses: Vec<Miss>,
}

/// Errors of a part of the rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What divides: `point`, `tool`, `set`, `region`, `track`, `positioner`.
    pub by: &'static str,
    /// Which part.
    pub name: String,
    /// Errors of the real model, mm.
    pub spread: Spread,
}

/// Which rows base, tool and points of the real model are fitted to before it is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refit {
    /// None: they are the profile's.
    No,
    /// Those that it is judged on.
    Judged,
    /// Those not marked for `validate`; it is judged on the others.
    Others,
}

impl Refit {
    /// A sentence that says it.
    #[must_use]
    pub fn note(self) -> Option<&'static str> {
        match self {
            Self::No => None,
            Self::Judged => Some(
                "Base, tool and points were fitted to these rows first, of the controller's model \
                 too.",
            ),
            Self::Others => Some(
                "Base, tool and points were fitted to the rows not marked for `validate`, of the \
                 controller's model too.",
            ),
        }
    }
}

/// What a validation found.
#[derive(Clone, Debug)]
pub struct Validation {
    /// The rows that are judged, as they were measured.
    pub measurements: Measurements,
    /// The same rows for the real model.
    pub problem: Problem,
    /// Its values.
    pub estimate: Estimate,
    /// The controller's model; where frames are fitted, with fitted ones, which is `frames_only`.
    pub controller: Judged,
    /// The controller's model with base, tool and points fitted to these rows.
    pub frames_only: Judged,
    /// The real model.
    pub real: Judged,
    /// Which rows base, tool and points of the real model were fitted to.
    pub refit: Refit,
    /// Errors of the real model by parts.
    pub parts: Vec<Part>,
    /// Repeated poses.
    pub repeated: Vec<Repeated>,
    /// Distances of repeated poses.
    pub repeated_distances: Vec<RepeatedDistance>,
    /// What a person should look at.
    pub remarks: Vec<Remark>,
    /// Root mean square of residuals in standard deviations; near one where the rows' sigmas are
    /// right.
    pub normalised_rms: Option<f64>,
    /// Errors of every row by a model that was identified without it, and the same for frames
    /// alone.
    pub folds: Option<(usize, Quality, Quality)>,
}

pub(super) fn judged(problem: &Problem, estimate: &Estimate) -> Judged {
    let misses = misses(problem, estimate);
    let mut measured: Vec<Vector> = Vec::new();
    let mut expected: Vec<Vector> = Vec::new();
    for (row, miss) in problem.rows.iter().zip(&misses) {
        if let Some(point) = row.observed.point_m() {
            measured.push(point.map(mm_from_m));
            expected.push(miss.expected_m.map(mm_from_m));
        }
    }
    Judged {
        quality: Quality::of(&problem.rows, &misses),
        distance: pairs(&measured, &expected),
        misses,
    }
}

/// The profile with what its controller computes with.
pub(super) fn controller_profile(profile: &Profile) -> Profile {
    let mut controller = profile.clone();
    controller.effects = profile.controller_effects();
    controller
}

/// Compares measurements with a profile's models.
///
/// Where base, tool and points of the real model are fitted (`refit`), the device or the tool was
/// set up anew. With `folds` the effects of the profile are identified again without each part of
/// the configurations in turn.
///
/// # Errors
/// As [`super::calibrate`]; points without coordinates where they are not to be fitted.
pub fn validate(
    profile: &Profile,
    measurements: &Measurements,
    refit: Refit,
    folds: Option<Folds>,
) -> Result<Validation, IdentifyError> {
    let measurements = Cow::Borrowed(measurements);
    validate_telling(profile, measurements, refit, folds, &mut |_, _| ())
}

/// As [`validate`]; `tell` hears how many of how many folds are done.
///
/// # Errors
/// As [`validate`].
pub fn validate_telling(
    profile: &Profile,
    measurements: Cow<Measurements>,
    refit: Refit,
    folds: Option<Folds>,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Validation, IdentifyError> {
    let moved = match measurements.in_world_of(profile)? {
        Cow::Owned(moved) => Some(moved),
        Cow::Borrowed(_) => None,
    };
    let all = moved.map_or(measurements, Cow::Owned);
    let measurements = &*all;
    let selection = Selection::level(Level::Frames);
    let unknown = measurements.rows.iter().find(|row| {
        row.point_in_tool_m.is_none()
            && row
                .point
                .as_ref()
                .is_some_and(|name| !profile.points.contains_key(name))
    });
    if let Some(row) = unknown.filter(|_| refit == Refit::No) {
        return Err(IdentifyError::Suspicious {
            message: format!(
                "{}: where point `{}` is on the tool is neither in the file nor in the profile",
                row.line,
                row.point.as_deref().unwrap_or_default()
            ),
            hint: "with --refit-frames base and points are fitted to these rows first".into(),
        });
    }
    let mut remarks = input_checks::validation::before(profile, measurements, refit)?;
    let controller = controller_profile(profile);
    let at_rest = |profile: &Profile| {
        Problem::new(profile, measurements, &selection, profile.world_from_base)
    };
    let (features, nominal) = {
        let (bare, nominal) = at_rest(&controller)?;
        (bare.features, nominal)
    };
    let (problem, own) = at_rest(profile)?;
    // the controller knows nothing of fitted frames: the effects that the selection added are zero
    let mut controller_problem = problem.clone();
    controller_problem.features = features;
    controller_problem.sort_rigs(&nominal.effects);
    let is_for = |row: usize| measurements.rows[row].purpose == Some(Purpose::Validate);
    let is_judged = |row: usize| refit != Refit::Others || is_for(row);
    let is_fitted = |row: usize| refit != Refit::Others || !is_for(row);
    let fitted = |profile: &Profile, points_too: bool| {
        let selection = frames_of(measurements, points_too);
        let (problem, begun) = begin_frames(profile, measurements, &selection)?;
        let training = problem.with_rows(is_fitted);
        let solution = solve(&training, begun, Shape::Squares, true)?;
        Ok::<_, IdentifyError>((problem, solution.estimate))
    };
    let (mut frames_problem, frames) = fitted(&controller, refit != Refit::No)?;
    frames_problem.rows.clone_from(&problem.rows);
    frames_problem.sort_rigs(&frames.effects);
    let (real_problem, real) = match refit {
        Refit::No => (problem, own),
        Refit::Judged | Refit::Others => fitted(profile, true)?,
    };
    // where the rows are in the frame of the calibration's device, whatever device measured them
    let places = match refit {
        Refit::No => None,
        Refit::Judged | Refit::Others => {
            let (problem, own) = at_rest(profile)?;
            let expected = misses(&problem.with_rows(is_judged), &own);
            Some(expected.iter().map(|m| m.expected_m).collect::<Vec<_>>())
        }
    };
    let real_problem = real_problem.with_rows(is_judged);
    let judged_rows = match refit {
        Refit::Others => Cow::Owned(measurements.filtered(|row, _| is_judged(row))),
        Refit::No | Refit::Judged => Cow::Borrowed(measurements),
    };
    let judged_real = judged(&real_problem, &real);
    let given = !real_problem.sigma_assumed;
    let squares = judged_real
        .misses
        .iter()
        .map(|m| m.normalised * m.normalised);
    let normalised = (squares.sum::<f64>() / judged_real.misses.len() as f64).sqrt();
    let folds = match folds {
        Some(folds) => Some(cross_validate(profile, &judged_rows, folds, tell)?),
        None => None,
    };
    let frames_only = judged(&frames_problem.with_rows(is_judged), &frames);
    let controller = match refit {
        Refit::No => judged(&controller_problem.with_rows(is_judged), &nominal),
        Refit::Judged | Refit::Others => frames_only.clone(),
    };
    remarks.extend(input_checks::validation::after(
        (&judged_real.quality, &judged_real.misses),
        &frames_only.quality,
        given.then_some(normalised),
        &outlying::of_judged(&real_problem, measurements, &judged_real.misses),
        refit,
    ));
    let by = [judged_real.misses.as_slice(), &controller.misses];
    let repetitions = groups(&judged_rows);
    Ok(Validation {
        parts: parts(
            profile,
            &judged_rows,
            &judged_real.misses,
            places.as_deref(),
        ),
        repeated: repeated(&judged_rows, &repetitions, by),
        repeated_distances: repeated_distances(&judged_rows, &repetitions, by),
        measurements: match judged_rows {
            Cow::Owned(some) => some,
            Cow::Borrowed(_) => all.into_owned(),
        },
        remarks,
        controller,
        frames_only,
        real: judged_real,
        refit,
        normalised_rms: given.then_some(normalised),
        problem: real_problem,
        estimate: real,
        folds,
    })
}

/// `places`: where the rows are in the frame of the calibration's device; `None` where they were
/// measured.
pub(super) fn parts(
    profile: &Profile,
    measurements: &Measurements,
    misses: &[Miss],
    places: Option<&[Vector]>,
) -> Vec<Part> {
    let mut groups: BTreeMap<(&'static str, String), Vec<f64>> = BTreeMap::new();
    let rows = &measurements.rows;
    let place = |row: usize| {
        let measured = rows[row].observed.point_m()?;
        Some(places.map_or(measured, |places| places[row]))
    };
    let seen: Vec<Vector> = (0..rows.len()).filter_map(place).collect();
    let middle = calibration_middle(profile).unwrap_or_else(|| {
        let sum = seen
            .iter()
            .fold([0.0; 3], |sum, p| crate::geometry::add(sum, *p));
        sum.map(|x| x / seen.len().max(1) as f64)
    });
    let far = seen
        .iter()
        .map(|p| norm(sub(*p, middle)))
        .fold(0.0, f64::max);
    let carrying = |row: &Measurement| {
        let plate = plate_of(row, &profile.external).ok().flatten();
        let listed = profile.external.listed().enumerate();
        listed.filter(move |(_, axis)| match axis {
            Listed::Track(_) => plate.is_none(),
            Listed::Rotary(_, of, _) => plate == Some(*of),
        })
    };
    for (number, (row, miss)) in rows.iter().zip(misses).enumerate() {
        let error = mm_from_m(miss.length_m);
        let mut add = |by, name: String| groups.entry((by, name)).or_default().push(error);
        if let Some(point) = &row.point {
            add("point", point.clone());
        }
        if let Some(tool) = &row.tool {
            let mass = profile
                .tool(tool)
                .and_then(|t| t.load)
                .map_or(0.0, |(mass, _)| mass);
            add("tool", format!("{tool} ({mass} kg)"));
        }
        if let Some(purpose) = row.purpose {
            add("set", purpose.id().into());
        }
        for (k, axis) in carrying(row) {
            let (low, high) = axis.limits();
            let width = (high - low) / REGIONS as f64;
            let values = &row.stand.values;
            let along = values.get(k).map_or(f64::NAN, |e| (e - low) / width);
            if along.is_finite() {
                let part = along.floor().clamp(0.0, (REGIONS - 1) as f64);
                let [from, to] = [part, part + 1.0].map(|n| in_files(&axis, low + width * n));
                let (by, unit) = if axis.is_linear() {
                    ("track", "mm")
                } else {
                    ("positioner", "deg")
                };
                let name = axis.name();
                add(
                    by,
                    format!("{name} {}: {from:.0} to {to:.0} {unit}", part + 1.0),
                );
            }
        }
        if let Some(point) = place(number).filter(|_| far > 0.0) {
            let width = far / REGIONS as f64;
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "0 to REGIONS"
            )]
            let ring = ((norm(sub(point, middle)) / width) as usize).min(REGIONS - 1);
            let (from, to) = (
                mm_from_m(width) * ring as f64,
                mm_from_m(width) * (ring + 1) as f64,
            );
            add("region", format!("{}: {from:.0} to {to:.0} mm", ring + 1));
        }
    }
    let several = |by: &str| groups.keys().filter(|(b, _)| *b == by).count() > 1;
    groups
        .iter()
        .filter(|((by, _), _)| several(by))
        .filter_map(|((by, name), errors)| {
            Some(Part {
                by,
                name: name.clone(),
                spread: Spread::of(errors)?,
            })
        })
        .collect()
}

/// The middle of the points that the profile was calibrated with, metres, where it says so.
fn calibration_middle(profile: &Profile) -> Option<Vector> {
    let middle = profile.quality.as_ref()?.get("middle_mm")?.as_array()?;
    let numbers: Vec<f64> = middle
        .iter()
        .filter_map(serde_json::Value::as_f64)
        .collect();
    let [x, y, z]: [f64; 3] = numbers.try_into().ok()?;
    Some([x, y, z].map(crate::geometry::units::m_from_mm))
}

/// How rows are left out in turn, and what is identified again without them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Folds {
    /// How many parts.
    pub count: usize,
    /// So much of the arm; the profile's own effects without.
    pub level: Option<Level>,
    /// Whether each parameter's typical size counts as one more measurement.
    pub priors: bool,
}

impl Folds {
    /// So many parts, the profile's own effects, no priors.
    #[must_use]
    pub const fn of(count: usize) -> Self {
        Self {
            count,
            level: None,
            priors: false,
        }
    }
}

/// Errors of every row by models that were identified without it: the profile's effects and frames,
/// and frames alone.
///
/// Rows of one configuration stay together; part k has every k-th configuration.
fn cross_validate(
    profile: &Profile,
    measurements: &Measurements,
    folds: Folds,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<(usize, Quality, Quality), IdentifyError> {
    let configurations = measurements.configurations();
    let total = configurations.iter().max().map_or(0, |last| last + 1);
    let count = folds.count.clamp(2, total.max(2));
    let free = measurements
        .rows
        .iter()
        .any(|row| row.point.is_some() && row.point_in_tool_m.is_none());
    let mut selection = Selection::level(Level::Frames);
    if free {
        selection.identify = super::pick::Pick::parse_list("points").expect("a word of the list");
    }
    let guess = start::find(profile, measurements);
    let base = guess
        .as_ref()
        .map_or(profile.world_from_base, |s| s.world_from_base);
    let (mut problem, mut begun) = Problem::new(profile, measurements, &selection, base)?;
    let mut frames = problem.parameters.clone();
    if let Some(level) = folds.level {
        selection.level = level;
        selection.priors = folds.priors;
        (problem, begun) = Problem::new(profile, measurements, &selection, base)?;
        let is_frame = |p: &&Parameter| frames.iter().any(|f| f.key == p.key);
        frames = problem
            .parameters
            .iter()
            .filter(is_frame)
            .cloned()
            .collect();
    } else {
        let own = present(&begun, &frames, folds.priors);
        problem.parameters.extend(own);
    }
    problem.gravity_by_base = true;
    problem.parameters.sort_by_key(|p| p.rank);
    begun
        .effects
        .iter_mut()
        .filter(|e| e.kind == Kind::BaseFrame)
        .for_each(|e| e.parameters = [0.0; 6]);
    if let Some(guess) = &guess {
        begin(&problem, &mut begun, guess);
        contact::start(&mut problem, &mut begun)?;
    }
    let provenance = profile.provenance.as_ref();
    let is_calibrated = provenance.is_some_and(|it| it.get("measurements_sha256").is_some());
    let (mut full, mut alone) = (Vec::new(), Vec::new());
    let mut rows = Vec::new();
    let nominal = {
        let mut bare = begun.clone();
        for effect in &mut bare.effects {
            if !matches!(effect.kind, Kind::BaseFrame | Kind::ToolFrame) {
                effect.parameters = [0.0; 6];
            }
        }
        bare
    };
    for part in 0..count {
        tell(part, count);
        let inside = |i: usize| configurations[i] % count == part;
        let training = problem.with_rows(|i| !inside(i));
        let test = problem.with_rows(inside);
        let mut only_frames = training.clone();
        only_frames.parameters.clone_from(&frames);
        let solved = solve(&only_frames, nominal.clone(), Shape::Squares, true)?;
        alone.extend(misses(&test, &solved.estimate));
        // what a level does not seek stays as a profile has it that was never calibrated; else all is
        // found again from nothing: what was identified may have seen the rows that are left out
        let from = match folds.level {
            Some(_) if !is_calibrated => begun.clone(),
            _ => solved.estimate,
        };
        let solved = solve(&training, from, Shape::Huber, true)?;
        full.extend(misses(&test, &solved.estimate));
        rows.extend(test.rows.iter().cloned());
    }
    Ok((count, Quality::of(&rows, &full), Quality::of(&rows, &alone)))
}

/// A parameter for each number of the profile's effects that is not zero and not sought already.
fn present(estimate: &Estimate, sought: &[Parameter], priors: bool) -> Vec<Parameter> {
    let mut all = Vec::new();
    for (index, effect) in estimate.effects.iter().enumerate() {
        for (number, parameter) in effect.definition().parameters.iter().enumerate() {
            let subject = Subject::Effect(crate::model::Slot {
                effect: index,
                parameter: number,
            });
            if effect.parameters[number] != 0.0 && sought.iter().all(|p| p.subject != subject) {
                let scale = parameter.prior_sigma * parameter.unit.in_si();
                all.push(Parameter {
                    key: format!("{} {}", effect.label(), parameter.key),
                    subject,
                    unit: parameter.unit,
                    scale,
                    rank: 7,
                    prior: (priors && effect.kind != Kind::BaseFrame).then_some((0.0, scale)),
                    asked: false,
                });
            }
        }
    }
    all
}
