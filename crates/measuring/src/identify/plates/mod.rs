//! Positioners from points on their plates.
//!
//! A device that stands where the profile has it sees reflectors on a plate at several angles of
//! the positioner's axes: no tool of the arm takes part. The same rows, solver and uncertainty as
//! of the arm, with [`crate::identify::holder::Plate`] in the place of the arm's model.
//!
//! What is the same thing is not sought twice. Coordinates of unknown points stand for the plate's
//! six numbers, and both for the zero of the last axis; the zero of an axis before is the place of
//! the next one. One axis is then known by four numbers and its scale, two by eight and two scales.

use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::geometry::{Vector, add, scale};
use crate::identify::calibration::{Calibration, Options, observability_of};
use crate::identify::error::IdentifyError;
use crate::identify::external::{places, plate_of};
use crate::identify::identifiability::Identifiable;
use crate::identify::input_checks::plausibility;
use crate::identify::measurements::{Measurements, Purpose};
use crate::identify::outlying::of_fit;
use crate::identify::parameters::{Level, Parameter, Selection, Subject, Wanted, at};
use crate::identify::pick::Pick;
use crate::identify::problem::{Estimate, NamedPoint, PointRef, Problem};
use crate::identify::robust::Shape;
use crate::identify::solver::solve;
use crate::identify::start::Start;
use crate::identify::statistics::{Quality, misses};
use crate::identify::uncertainty::Uncertainty;
use crate::model::effects::{Effect, Kind};
use crate::profile::{Profile, is_of_profile};
use std::ops::Range;

mod plan;
mod validation;

pub use plan::plan_plates;
pub use validation::validate_plates;

/// An axis shows from so many values of its angle on,
const LEAST_VALUES: usize = 3;
/// that are spread over so much, radians.
const LEAST_SPAN_RAD: f64 = 60.0 * DEG;
/// Farther from where the profile has it an axis is not believed to be the profile's, metres.
const FAR_M: f64 = 20.0 * MM;
/// And rotated by more, radians.
const FAR_RAD: f64 = 1.0 * DEG;
/// Points that miss by more do not go round as the angles say, metres, root mean square.
const ASTRAY_M: f64 = 5.0 * MM;
/// And before the axes are fitted, by more than any axis near the profile's explains.
const ELSEWHERE_M: f64 = 100.0 * MM;

/// What points on plates show.
#[derive(Clone, Debug)]
pub(in crate::identify) struct PlateRows {
    /// The positioner of each row, and its point.
    pub rows: Vec<(usize, PointRef)>,
    /// The named points.
    pub points: Vec<NamedPoint>,
    /// Their coordinates on the plate, metres; where nothing says them, by the profile's axes.
    pub points_m: Vec<Vector>,
    /// Positioners in use, and their axes among all that are listed.
    used: Vec<(usize, Range<usize>)>,
    /// At how many values each listed axis stood, and over how much they spread, radians.
    stood: Vec<(usize, f64)>,
}

impl PlateRows {
    /// Of rows on plates, in the controller's world; with `free` no coordinates of named points are
    /// known.
    fn of(profile: &Profile, rows: &Measurements, free: bool) -> Result<Self, IdentifyError> {
        let axes = &profile.external;
        let mut found = Self {
            rows: Vec::new(),
            points: Vec::new(),
            points_m: Vec::new(),
            used: Vec::new(),
            stood: Vec::new(),
        };
        for row in &rows.rows {
            let plate = plate_of(row, axes)?.ok_or_else(|| IdentifyError::Suspicious {
                message: format!("{}: the point is on no plate", row.line),
                hint: "keep rows of the tool apart from rows on plates".into(),
            })?;
            let given = row.point_in_tool_m;
            let Some(name) = &row.point else {
                let known = PointRef::Known(given.unwrap_or_default());
                found.rows.push((plate, known));
                continue;
            };
            let same = |point: &NamedPoint| point.name == *name && point.plate == Some(plate);
            let index = found.points.iter().position(same).unwrap_or_else(|| {
                let known = axes.positioners[plate].points.get(name).copied();
                found.points.push(NamedPoint {
                    name: name.clone(),
                    plate: Some(plate),
                    known: known.is_some() && !free,
                });
                found.points_m.push(known.unwrap_or_default());
                found.points.len() - 1
            });
            if let Some(given) = given {
                found.points_m[index] = given;
                found.points[index].known = !free;
            }
            found.rows.push((plate, PointRef::Named(index)));
        }
        for (positioner, own) in axes.positioners.iter().enumerate() {
            let first = axes.first_of(positioner);
            if found.rows.iter().any(|(plate, _)| *plate == positioner) {
                let range = first..first + own.axes.len();
                found.used.push((positioner, range));
            }
        }
        found.stood = vec![(0, 0.0); axes.listed().count()];
        for (positioner, range) in &found.used {
            let own = rows.filtered(|i, _| found.rows[i].0 == *positioner);
            let counts = places(axes, &own);
            for k in range.clone() {
                let values = own.rows.iter().map(|row| row.stand.values[k]);
                let low = values.clone().fold(f64::INFINITY, f64::min);
                let high = values.fold(f64::NEG_INFINITY, f64::max);
                found.stood[k] = (counts[k], high - low);
            }
        }
        found.guess(profile, rows)?;
        Ok(found)
    }

    /// Where unknown points are on their plates, if the axes are where the profile has them.
    fn guess(&mut self, profile: &Profile, rows: &Measurements) -> Result<(), IdentifyError> {
        for index in 0..self.points.len() {
            if self.points[index].known {
                continue;
            }
            let own = rows.rows.iter().zip(&self.rows);
            let own = own.filter(|(_, (_, point))| *point == PointRef::Named(index));
            let seen: Vec<Vector> = own
                .filter_map(|(row, (plate, _))| {
                    let stand = row.stand.at();
                    let plate = profile.external.plate(*plate, stand, &profile.effects);
                    Some(plate.inverse().transform(row.observed.point_m()?))
                })
                .collect();
            if seen.is_empty() {
                return Err(IdentifyError::Suspicious {
                    message: format!(
                        "where point `{}` is on the plate does not follow from distances",
                        self.points[index].name
                    ),
                    hint: "say it: px_mm,py_mm,pz_mm, or `points` of the positioner in the profile"
                        .into(),
                });
            }
            let sum = seen.iter().fold([0.0; 3], |sum, p| add(sum, *p));
            self.points_m[index] = scale(1.0 / seen.len() as f64, sum);
        }
        Ok(())
    }

    /// Whether coordinates of points on this plate are known.
    fn is_given(&self, positioner: usize) -> bool {
        let known = |point: &PointRef| match point {
            PointRef::Known(_) => true,
            PointRef::Named(index) => self.points[*index].known,
        };
        let mut own = self.rows.iter().filter(|(plate, _)| *plate == positioner);
        own.any(|(_, point)| known(point))
    }

    /// Points whose coordinates are sought, by index, with their names.
    fn unknown_points(&self, profile: &Profile) -> Vec<(usize, String)> {
        let unknown = self.points.iter().enumerate().filter(|(_, p)| !p.known);
        let named = unknown.map(|(index, point)| {
            let plate = point.plate.map(|p| &profile.external.positioners[p].name);
            let name = match plate {
                Some(plate) => format!("{} on {plate}", point.name),
                None => point.name.clone(),
            };
            (index, name)
        });
        named.collect()
    }

    /// Whether an axis shows at all.
    fn has_rotated(&self, axis: usize) -> bool {
        let (values, span_rad) = self.stood[axis];
        values >= LEAST_VALUES && span_rad >= LEAST_SPAN_RAD
    }

    /// Whether an effect that is meant may show: a wave takes two values a period and two more. An
    /// effect that is named alone is sought in any case.
    fn shows(&self, pick: &Pick, effect: &Effect) -> bool {
        let axis = effect.site.index;
        if !self.used.iter().any(|(_, axes)| axes.contains(&axis)) {
            return false;
        }
        let wave = || self.stood[axis].0 as f64 >= 2.0 * effect.site.periods() + 2.0;
        pick.is_of_one()
            || matches!(effect.kind, Kind::PositionerPlate | Kind::PositionerZero)
            || self.has_rotated(axis) && (!effect.definition().has_periods() || wave())
    }

    /// The effects and parameters that are sought:
    /// where a plate is if its points have coordinates, the coordinates if they have none, and what
    /// is wrong with the axes. A zero is sought where it is asked for, and the plate is not then.
    pub(in crate::identify) fn choose(
        &self,
        profile: &Profile,
        selection: &Selection,
    ) -> (Vec<Effect>, Vec<Parameter>) {
        let mut wanted = Wanted::of(profile);
        let asked = |kind: Kind| {
            selection
                .identify
                .iter()
                .any(|pick| pick.kind == Some(kind))
        };
        for (positioner, axes) in &self.used {
            if self.is_given(*positioner) && !asked(Kind::PositionerZero) {
                wanted.add(&at(Kind::PositionerPlate, axes.end - 1), &|_| true);
            }
        }
        let usual = is_usual(selection).then(Pick::positioner);
        for pick in usual.iter().flatten().chain(&selection.identify) {
            for effect in pick.effects() {
                let own = effect.definition().of_positioner();
                if own && is_of_profile(&effect, &profile.external) && self.shows(pick, &effect) {
                    wanted.add(&effect, &|key| pick.holds(&effect, key));
                }
            }
        }
        let unknown = self.unknown_points(profile);
        wanted.parameters(profile, selection, Vec::new(), &unknown)
    }

    /// What is usually sought of the positioners in use, their zeros, and where coordinates of
    /// points are known the plate.
    fn effects(&self, profile: &Profile) -> Vec<Effect> {
        let usual = Pick::positioner();
        let usual = usual.iter().flat_map(|pick| {
            let own = pick.effects().into_iter();
            own.filter(|effect| {
                is_of_profile(effect, &profile.external) && self.shows(pick, effect)
            })
        });
        let mut all: Vec<Effect> = usual.collect();
        for (positioner, axes) in &self.used {
            let last = axes.end - 1;
            let is_given = self.is_given(*positioner);
            // the zero of the last axis is where unknown points are
            let zeros = axes.clone().filter(|axis| is_given || *axis != last);
            all.extend(zeros.map(|axis| at(Kind::PositionerZero, axis)));
            all.extend(is_given.then(|| at(Kind::PositionerPlate, last)));
        }
        all
    }

    /// Axes that have not moved enough to show.
    fn still(&self, profile: &Profile) -> Vec<String> {
        let axes = self.used.iter().flat_map(|(_, axes)| axes.clone());
        let still = axes.filter(|axis| !self.has_rotated(*axis));
        let said = still.map(|axis| {
            let (values, span_rad) = self.stood[axis];
            let name = profile.external.listed().nth(axis);
            format!(
                "{} stood at {values} angles over {:.1} deg: an axis shows from {LEAST_VALUES} \
                 angles over {:.0} deg on",
                name.map_or_else(String::new, |axis| axis.name().to_owned()),
                span_rad / DEG,
                LEAST_SPAN_RAD / DEG
            )
        });
        said.collect()
    }

    /// Refuses what cannot tell an axis, or the plate that is to be sought.
    fn refuse(&self, profile: &Profile, selection: &Selection) -> Result<(), IdentifyError> {
        let asked = |kind: Kind| {
            selection
                .identify
                .iter()
                .find(|pick| pick.kind == Some(kind))
        };
        for (positioner, axes) in &self.used {
            let given = self.is_given(*positioner);
            for (kind, need) in [
                (
                    Kind::PositionerZero,
                    "points with known coordinates on the plate: of others the zero is where they \
                     are",
                ),
                (
                    Kind::PositionerPlate,
                    "points with known coordinates on the plate: of others the plate is where \
                     they are",
                ),
            ] {
                if !given && asked(kind).is_some() {
                    let id = kind.definition().id;
                    return Err(IdentifyError::Missing { id, need });
                }
            }
            let together = asked(Kind::PositionerAxis).is_some_and(|pick| !pick.is_of_one());
            let still = axes.clone().find(|axis| !self.has_rotated(*axis));
            let Some(axis) = still.filter(|_| together || is_usual(selection)) else {
                continue;
            };
            let listed = profile.external.listed().nth(axis);
            let (values, span_rad) = self.stood[axis];
            return Err(IdentifyError::Suspicious {
                message: format!(
                    "the plate of {} was seen at {values} angles of {} over {:.1} deg: an axis \
                     shows from {LEAST_VALUES} angles over {:.0} deg on",
                    profile.external.positioners[*positioner].name,
                    listed.map_or_else(String::new, |axis| axis.name().to_owned()),
                    span_rad / DEG,
                    LEAST_SPAN_RAD / DEG
                ),
                hint: "measure it at more angles, farther apart; or say which axes are sought: \
                    --identify positioner_axis:2,positioner_scale:2"
                    .into(),
            });
        }
        Ok(())
    }
}

/// Whether all that positioners usually have is sought.
fn is_usual(selection: &Selection) -> bool {
    matches!(selection.level, Level::Geometry | Level::Compliance)
}

/// Rows on plates as a problem, and where it starts.
fn begin(
    profile: &Profile,
    rows: &Measurements,
    selection: &Selection,
) -> Result<(Problem, Estimate), IdentifyError> {
    let rows_on_plates = PlateRows::of(profile, rows, selection.wants_points())?;
    rows_on_plates.refuse(profile, selection)?;
    Ok(Problem::on_plates(profile, rows, selection, rows_on_plates))
}

/// What points on one plate may show.
pub(crate) struct Shown {
    /// The rows; unknown coordinates of points are its parameters.
    pub problem: Problem,
    /// With these coordinates fitted.
    pub estimate: Estimate,
    /// Effects of the positioner that the rows may tell.
    pub effects: Vec<Effect>,
    /// Which axes they do not, and why, one sentence each.
    pub still: Vec<String>,
}

/// Points on the plate of one positioner, in the controller's world, as the profile has it.
///
/// # Errors
/// Coordinates that do not follow; points that are nowhere near where the axes take them.
pub(crate) fn shown(profile: &Profile, rows: &Measurements) -> Result<Shown, IdentifyError> {
    let of = PlateRows::of(profile, rows, false)?;
    let (effects, still) = (of.effects(profile), of.still(profile));
    let selection = Selection::level(Level::Frames);
    let (mut problem, begun) = Problem::on_plates(profile, rows, &selection, of);
    (problem.parameters).retain(|p| matches!(p.subject, Subject::Point { .. }));
    let estimate = if problem.parameters.is_empty() {
        begun
    } else {
        solve(&problem, begun, Shape::Huber, false)?.estimate
    };
    let found = Quality::of(&problem.rows, &misses(&problem, &estimate));
    refuse_astray(&found, ELSEWHERE_M)?;
    Ok(Shown {
        problem,
        estimate,
        effects,
        still,
    })
}

/// A selection of frames alone: where the plate is, or its points.
fn frames_of(selection: &Selection) -> Selection {
    let points = selection.identify.iter().filter(|pick| pick.kind.is_none());
    Selection {
        level: Level::Frames,
        identify: points.cloned().collect(),
        ..selection.clone()
    }
}

/// Identifies positioners of a profile from points on their plates.
///
/// The device is where the profile has it: the rows are of a calibration's device, or of the
/// controller's world.
///
/// # Errors
/// Rows of the tool; too few angles, or too narrow ones; axes that are not where the profile has
/// them at all, or go otherwise than their angles say; what [`crate::identify::calibrate`] refuses.
pub fn calibrate_plates(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
) -> Result<Calibration, IdentifyError> {
    let measurements = &*measurements.in_world_of(profile)?;
    let fit = measurements.filtered(|_, row| row.purpose != Some(Purpose::Validate));
    if fit.rows.is_empty() {
        return Err(IdentifyError::NothingToFit);
    }
    let selection = &options.selection;
    let (problem, begun) = begin(profile, &fit, selection)?;
    if problem.parameters.is_empty() {
        return Err(IdentifyError::NoParameters);
    }
    let numbers = problem.distinct_numbers();
    if numbers <= problem.parameters.len() {
        return Err(IdentifyError::TooFew {
            numbers,
            rows: problem.rows.len(),
            parameters: problem.parameters.len(),
        });
    }
    let before_misses = misses(&problem, &begun);
    let frames_only = {
        let (alone, _) = begin(profile, &fit, &frames_of(selection))?;
        let mut frames = problem.clone();
        let is_frame = |p: &Parameter| alone.parameters.iter().any(|f| f.key == p.key);
        frames.parameters.retain(is_frame);
        solve(&frames, begun, options.shape, false)?
    };
    let quality = |estimate: &Estimate| Quality::of(&problem.rows, &misses(&problem, estimate));
    let frames_only_quality = quality(&frames_only.estimate);
    refuse_astray(&frames_only_quality, ELSEWHERE_M)?;
    let solution = solve(&problem, frames_only.estimate.clone(), options.shape, false)?;
    refuse_lost(&problem, &solution.identifiable)?;
    refuse_far(profile, &solution.estimate)?;
    let uncertainty = Uncertainty::of(&problem, &solution);
    let after_misses = misses(&problem, &solution.estimate);
    let after = Quality::of(&problem.rows, &after_misses);
    refuse_astray(&after, ASTRAY_M)?;
    let outliers = of_fit(&problem, &fit, &solution, &after_misses);
    let held = measurements.filtered(|_, row| row.purpose == Some(Purpose::Validate));
    let held_out = if held.rows.is_empty() {
        None
    } else {
        Some((
            judge(profile, &held, (&problem, &frames_only.estimate))?,
            judge(profile, &held, (&problem, &solution.estimate))?,
        ))
    };
    Ok(Calibration {
        start: Start::at(profile.world_from_base),
        base_replaced: false,
        world_from_base: profile.world_from_base,
        device: profile.device,
        frame_from_device: profile.world_from_device(),
        expected_m: None,
        orientation_lever_m: None,
        observability: observability_of(&problem, &solution, &fit),
        before: Quality::of(&problem.rows, &before_misses),
        before_misses,
        frames_only_quality,
        after,
        held_out,
        remarks: plausibility::check_rows(&outliers).into_iter().collect(),
        outliers,
        uncertainty,
        fit,
        frames_only,
        problem,
        solution,
    })
}

/// An axis that is sought must be found.
fn refuse_lost(problem: &Problem, known: &Identifiable) -> Result<(), IdentifyError> {
    let is_axis = |p: &Parameter| p.key.starts_with(Kind::PositionerAxis.definition().id);
    let parameter = |index: &usize| &problem.parameters[*index];
    let lost = known.dropped.iter().find(|dropped| {
        let own = parameter(&dropped.parameter);
        is_axis(own) && !own.asked
    });
    let Some(lost) = lost else {
        return Ok(());
    };
    let like: Vec<&str> = (lost.confounded_with.iter().take(3))
        .map(|other| parameter(other).key.as_str())
        .collect();
    let why = match like[..] {
        [] => "it does not show".to_owned(),
        _ => format!("nothing tells it from {}", like.join(", ")),
    };
    Err(IdentifyError::Suspicious {
        message: format!(
            "{} does not follow from these points: {why}",
            parameter(&lost.parameter).key
        ),
        hint: "reflectors farther from the axis, at different radii and heights, and more angles \
            of each axis at several of the others"
            .into(),
    })
}

/// An axis far from where the profile has it is another one, or seen from elsewhere.
fn refuse_far(profile: &Profile, estimate: &Estimate) -> Result<(), IdentifyError> {
    let axes = estimate
        .effects
        .iter()
        .filter(|e| e.kind == Kind::PositionerAxis);
    for effect in axes {
        let [x, y, rx, ry, ..] = effect.parameters;
        let (far_m, rotated_rad) = (x.hypot(y), rx.hypot(ry));
        if far_m <= FAR_M && rotated_rad <= FAR_RAD {
            continue;
        }
        let axis = profile.external.listed().nth(effect.site.index);
        return Err(IdentifyError::Suspicious {
            message: format!(
                "axis {} is {:.1} mm and {:.2} deg from where the profile has it; the limits are \
                 {:.0} mm and {:.0} deg",
                axis.map_or_else(String::new, |axis| axis.name().to_owned()),
                mm_from_m(far_m),
                rotated_rad / DEG,
                mm_from_m(FAR_M),
                FAR_RAD / DEG
            ),
            hint: "where the device stands tells the tool: measure it too, in the same file; \
                where that is known, `poseshift axes` finds what `at` of the axis should be"
                .into(),
        });
    }
    Ok(())
}

/// Points that are not where any such positioner takes them.
fn refuse_astray(found: &Quality, most_m: f64) -> Result<(), IdentifyError> {
    let rms_mm = found.main().map_or(0.0, |spread| spread.rms);
    if rms_mm <= mm_from_m(most_m) {
        return Ok(());
    }
    Err(IdentifyError::Suspicious {
        message: format!(
            "the points are {rms_mm:.1} mm rms from where the axes take them (limit {:.0} mm): \
             they do not go round as the angles say",
            mm_from_m(most_m)
        ),
        hint: "where the device stands (rows of the tool tell it), the unit and the order of the \
            columns e1_deg …, `sign` of the axes, or the names of the points"
            .into(),
    })
}

/// Quality of an estimate on other rows of the same set-up.
fn judge(
    profile: &Profile,
    rows: &Measurements,
    (problem, estimate): (&Problem, &Estimate),
) -> Result<Quality, IdentifyError> {
    let (mut other, mut values) = begin(profile, rows, &Selection::level(Level::Frames))?;
    for (point, value) in other.points.iter().zip(&mut values.points_m) {
        let same = |p: &NamedPoint| p.name == point.name && p.plate == point.plate;
        if let Some(index) = problem.points.iter().position(same) {
            *value = estimate.points_m[index];
        }
    }
    values.effects.clone_from(&estimate.effects);
    other.sort_rigs(&values.effects);
    Ok(Quality::of(&other.rows, &misses(&other, &values)))
}
