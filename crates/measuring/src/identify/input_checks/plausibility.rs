//! A fit that no calibrated arm has, found before its values are believed.

use super::{BETTER, NOT_OF_THIS_ROBOT, Remark, WHOLE_FILE, remark, sigma, suspicious};
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::identify::calibration::Outlier;
use crate::identify::contact::Contact;
use crate::identify::error::IdentifyError;
use crate::identify::measurements::{Measurements, Observed};
use crate::identify::parameters::{FIRST_PHYSICAL, Parameter, Subject};
use crate::identify::problem::{Estimate, PointRef, Problem, Row};
use crate::identify::robust::Shape;
use crate::identify::statistics::{Miss, quantile};
use crate::model::Slot;
use crate::model::effects::{Kind, Unit};
use crate::profile::Profile;
use std::collections::BTreeSet;

/// A fit that misses by more is not of this robot, metres.
pub(crate) const HOPELESS_M: f64 = 20.0 * MM;
/// A fit that misses by more is worth a warning, metres.
const POOR_M: f64 = 2.0 * MM;
/// The same of orientations, radians.
const HOPELESS_RAD: f64 = 3.0 * DEG;
/// And worth a warning.
const POOR_RAD: f64 = 0.5 * DEG;
/// The nominal arm misses by less where positions are its controller's own: arms repeat to 0.01 mm at
/// best, and a controller shows thousandths, metres.
const COMPUTED_M: f64 = 0.005 * MM;
/// From so many rows on.
const COMPUTED_ROWS: usize = 10;
/// The part of the rows that a fit is judged by: gross errors are outliers, not the fit.
const JUDGED: f64 = 0.9;
/// So many numbers a parameter show the noise to a loss that leaves rows out. Over 60 to 100 draws of
/// Gaussian noise for 32 parameters the values scatter by 1.65 times what is said of them with 48
/// numbers, 1.58 with 60, 1.17 with 75 and 0.99 with 90.
const TELL_NOISE: f64 = 2.75;
/// A value this many times its typical size is of no arm,
const ABSURD: f64 = 100.0;
/// and beyond this many worth a warning.
const UNUSUAL: f64 = 20.0;
/// Touches that miss by more than this many are read in other ways.
const TOUCH_FACTOR: f64 = 5.0;
/// An expected error elsewhere is reported from here on, metres.
const FAR_OFF_M: f64 = 0.3 * MM;
/// One factor of all lengths is reported that is this many times its standard deviation, if each
/// length has its typical deviation,
const SCALED: f64 = 5.0;
/// and this many without the longest.
const SCALED_REST: f64 = 3.0;
/// A compliance is negative that is so by this many standard deviations.
const SURELY: f64 = 3.0;

/// Root mean square of the sizes without the largest tenth of them.
fn usual(sizes: impl Iterator<Item = f64>) -> Option<f64> {
    let mut sizes: Vec<f64> = sizes.collect();
    sizes.sort_by(f64::total_cmp);
    let limit = quantile(&sizes, JUDGED);
    let count = sizes.iter().take_while(|size| **size <= limit).count();
    (count > 0).then(|| {
        let squares: f64 = sizes[..count].iter().map(|size| size * size).sum();
        (squares / count as f64).sqrt()
    })
}

/// Says that no row shows where the tool is on the last link: all points are sought with everything
/// else.
pub(crate) fn check_tool(problem: &Problem) -> Option<Remark> {
    let is_free = |row: &Row| match row.point {
        PointRef::Named(point) => !problem.points[point].known && row.plate.is_none(),
        PointRef::Known(_) => false,
    };
    let of_places = |row: &Row| !matches!(row.observed, Observed::Pose(_)) && is_free(row);
    problem.rows.iter().all(of_places).then(|| {
        let names = problem.points.iter().map(|point| point.name.as_str());
        let names: Vec<&str> = names.collect();
        remark(
            "tool-not-measured",
            WHOLE_FILE,
            format!(
                "nothing says where the measured points ({}) are on the tool: how far the flange, and each tool on it, is \
                 from where the profile has it, is not identified",
                names.join(", ")
            ),
            "give the points' places in the tool's frame (px_mm, py_mm, pz_mm), or measure the tool that programs use \
             as well",
        )
    })
}

/// Checks a fit that misses by far more than any calibrated arm.
///
/// # Errors
/// The measurements are not of this robot.
pub(crate) fn check_fit(
    problem: &Problem,
    after: &[Miss],
    frames_only: &[Miss],
    degrees_of_freedom: usize,
) -> Result<Vec<Remark>, IdentifyError> {
    let length = |misses: &[Miss]| usual(misses.iter().map(|miss| miss.length_m)).unwrap_or(0.0);
    let (missed, frames) = (length(after), length(frames_only));
    if missed > HOPELESS_M {
        return Err(suspicious(
            format!(
                "the fitted model misses by {:.1} mm rms (base and tool alone fitted: {:.1} mm): \
                 no arm is that far from its drawing",
                mm_from_m(missed),
                mm_from_m(frames)
            ),
            NOT_OF_THIS_ROBOT,
        ));
    }
    let angle = usual(after.iter().filter_map(|miss| miss.angle_rad)).unwrap_or(0.0);
    if angle > HOPELESS_RAD {
        return Err(suspicious(
            format!(
                "the fitted model misses orientations by {:.1} deg rms, and positions by {:.3} mm",
                angle / DEG,
                mm_from_m(missed)
            ),
            "qw,qx,qy,qz turn the tool into the world's frame, the scalar first; without these \
             columns positions alone count",
        ));
    }
    let mut remarks = Vec::new();
    if missed > POOR_M || angle > POOR_RAD {
        remarks.push(remark(
            "poor-fit",
            WHOLE_FILE,
            format!(
                "the fitted model misses by {:.3} mm and {:.3} deg rms, more than a calibrated arm \
                 does",
                mm_from_m(missed),
                angle / DEG
            ),
            "look at the outliers, the tool and the masses; `poseshift diagnose` looks for what is \
             missing",
        ));
    }
    if frames < COMPUTED_M && frames_only.len() >= COMPUTED_ROWS {
        remarks.push(remark(
            "positions-computed",
            WHOLE_FILE,
            format!(
                "the nominal arm misses these rows by {:.4} mm rms once base and tool are fitted: no \
                 real arm is so near its drawing",
                mm_from_m(frames)
            ),
            "are these positions that the controller computed from its joints? those of a tracker, \
             probe or ballbar are needed",
        ));
    }
    let times = times_sigma(after).filter(|_| !problem.sigma_assumed);
    // what parameters take up is missing in the residuals of few rows
    let numbers: usize = problem.rows.iter().map(|row| row.observed.count()).sum();
    let freedom = degrees_of_freedom as f64;
    let taken = (numbers as f64 / freedom).max(1.0).sqrt();
    let times = times.filter(|_| degrees_of_freedom > 0);
    remarks.extend(times.and_then(|times| sigma(times * taken, freedom)));
    Ok(remarks)
}

/// How many of their standard deviations most residuals are.
pub(super) fn times_sigma(misses: &[Miss]) -> Option<f64> {
    usual(misses.iter().map(|miss| miss.normalised))
}

/// Checks touches that miss by far more than the probe's repeatability, where they fit if its ball
/// or a plane is meant otherwise. `again` gives what the model misses of other measurements.
///
/// # Errors
/// They fit if the radius is a diameter, or a normal points the other way.
pub(crate) fn check_touches(
    measurements: &Measurements,
    after: &[Miss],
    mut again: impl FnMut(&Measurements) -> Result<Vec<Miss>, IdentifyError>,
) -> Result<(), IdentifyError> {
    let touches = measurements
        .rows
        .iter()
        .filter_map(|row| row.contact.as_ref());
    let planes: BTreeSet<&str> = touches
        .clone()
        .filter(|contact| contact.normal.is_some())
        .map(|contact| contact.feature.as_str())
        .collect();
    let Some(times) = times_sigma(after).filter(|times| *times > TOUCH_FACTOR) else {
        return Ok(());
    };
    if touches.count() == 0 {
        return Ok(());
    }
    let with = |change: &dyn Fn(&mut Contact)| {
        let mut other = measurements.clone();
        for row in &mut other.rows {
            let Some(contact) = &mut row.contact else {
                continue;
            };
            let before = contact.probe_radius_m;
            change(contact);
            // a known sphere is a distance from its centre
            if let Observed::Distance { distance_m, .. } = &mut row.observed {
                *distance_m += contact.probe_radius_m - before;
            }
        }
        other
    };
    let mut tried = vec![
        (
            "probe_radius_mm is the ball's diameter".to_owned(),
            with(&|c| c.probe_radius_m *= 0.5),
        ),
        (
            "probe_radius_mm is half the ball's radius".to_owned(),
            with(&|c| c.probe_radius_m *= 2.0),
        ),
    ];
    for plane in planes {
        let flipped = with(&|c| {
            if c.feature == plane {
                c.normal = c.normal.map(|normal| normal.map(|x| -x));
            }
        });
        tried.push((
            format!("the normal of plane `{plane}` points the other way, out of the material"),
            flipped,
        ));
    }
    for (supposes, other) in tried {
        let Ok(misses) = again(&other) else { continue };
        if let Some(then) = times_sigma(&misses).filter(|then| BETTER * then < times) {
            return Err(suspicious(
                format!(
                    "the touches miss by {times:.1} times their standard deviation; if {supposes}, \
                     {then:.1} times"
                ),
                "probe_radius_mm is the radius of the probe's ball; nx,ny,nz point out of the \
                 material",
            ));
        }
    }
    Ok(())
}

/// Checks that the measurements say enough of the arm elsewhere.
#[must_use]
pub(crate) fn check_reach(expected_m: Option<f64>, after: &[Miss]) -> Option<Remark> {
    let missed = usual(after.iter().map(|miss| miss.length_m))?;
    let expected = expected_m.filter(|e| *e > FAR_OFF_M && *e > super::SIGMA_FACTOR * missed)?;
    let message = format!(
        "the fitted model misses these rows by {:.3} mm rms, and postures elsewhere within the \
         joint limits by {:.2} mm as it is to be expected",
        mm_from_m(missed),
        mm_from_m(expected)
    );
    let hint = "measure configurations over the whole workspace: `poseshift plan` chooses them";
    Some(remark("hardly-determined", WHOLE_FILE, message, hint))
}

/// Checks that what `--loss tukey` takes for the noise is it: with few numbers beyond the parameters
/// the fit follows some rows, and takes the others for outliers.
#[must_use]
pub(crate) fn check_left_out(problem: &Problem, shape: Shape, parameters: usize) -> Option<Remark> {
    let numbers: usize = problem.rows.iter().map(|row| row.observed.count()).sum();
    let are_few = (numbers as f64) < TELL_NOISE * parameters as f64;
    if shape != Shape::Tukey || !problem.sigma_assumed || !are_few {
        return None;
    }
    let message = format!(
        "`--loss tukey` has {numbers} numbers for {parameters} parameters to learn the noise from: \
         standard deviations may come out up to twice too small, and rows that are right as \
         outliers"
    );
    let hint = "measure more configurations, state sigma_mm, or take `--loss huber`";
    Some(remark("hardly-determined", WHOLE_FILE, message, hint))
}

/// Rows that do not fit the others: they are reported, whatever the loss makes of them.
#[must_use]
pub(crate) fn check_rows(outliers: &[Outlier]) -> Option<Remark> {
    let worst = outliers.iter().max_by(|a, b| a.times.total_cmp(&b.times))?;
    let message = format!(
        "{} row{} not fit the others, the worst misses by {}, {:.1} times the typical residual \
         (limit {:.1})",
        outliers.len(),
        if outliers.len() == 1 { " does" } else { "s do" },
        worst.off.words(),
        worst.times,
        worst.limit
    );
    let hint = "was the beam lost, the reflector not seated, the robot still moving? leave wrong \
        rows out; `poseshift calibrate --loss tukey` ignores them";
    Some(remark("outliers", worst.line.clone(), message, hint))
}

/// Checks whether the lengths of all links differ by one factor from the profile's: a device whose
/// scale is wrong measures such an arm. The factor is that of weighted least squares through the
/// origin; it is reported where it stands out with the longest length and without it.
#[must_use]
pub(crate) fn check_scale(
    profile: &Profile,
    parameters: &[Parameter],
    estimate: &Estimate,
    sigma: &[f64],
) -> Option<Remark> {
    // moments of nominal length and deviation, in typical deviations, and the nominal length
    let lengths = parameters.iter().zip(sigma).filter_map(|(p, sigma)| {
        let Subject::Effect(slot) = p.subject else {
            return None;
        };
        let effect = &estimate.effects[slot.effect];
        let is_geometry = effect.kind == Kind::LinkGeometry;
        let link = is_geometry.then(|| &profile.links[effect.site.index])?;
        let nominal_m = match effect.definition().parameters[slot.parameter].key {
            "a_mm" => link.a_m,
            "d_mm" => link.d_m,
            _ => return None,
        };
        let weight = 1.0 / (p.scale * p.scale + sigma * sigma);
        let deviation_m = estimate.value(p.subject);
        let moments = [nominal_m * nominal_m, nominal_m * deviation_m].map(|m| m * weight);
        (nominal_m != 0.0).then_some((moments, nominal_m.abs()))
    });
    let lengths: Vec<_> = lengths.collect();
    let longest = lengths
        .iter()
        .map(|(_, length)| *length)
        .max_by(f64::total_cmp)?;
    let factor_of = |most: f64| {
        let kept = lengths.iter().filter(|(_, length)| *length <= most);
        let [squares, products] = kept.fold([0.0; 2], |sum, ([squares, products], _)| {
            [sum[0] + squares, sum[1] + products]
        });
        (squares > 0.0).then(|| (products / squares, products / squares.sqrt()))
    };
    let (factor, times) = factor_of(longest)?;
    let (_, rest) = factor_of(longest.next_down())?;
    if times.abs() < SCALED || rest * times.signum() < SCALED_REST {
        return None;
    }
    let message = format!(
        "the lengths of all links come out {} by {:.2} %, {:.1} times what is usual",
        if factor > 0.0 { "longer" } else { "shorter" },
        100.0 * factor.abs(),
        times.abs()
    );
    let hint = "a device whose scale is wrong measures such an arm: see its temperature, pressure \
        and prism constant, and that the profile is of this robot";
    Some(remark("scale", WHOLE_FILE, message, hint))
}

/// Checks identified values that no arm has.
///
/// # Errors
/// A value a hundred times its typical size.
pub(crate) fn check_values(
    parameters: &[Parameter],
    estimate: &Estimate,
    sigma: &[f64],
    frames_rms_mm: f64,
) -> Result<Vec<Remark>, IdentifyError> {
    let mut remarks = Vec::new();
    let value = |p: &Parameter| estimate.value(p.subject);
    let physical = parameters.iter().zip(sigma);
    let physical = physical.filter(|(p, _)| p.rank >= FIRST_PHYSICAL && p.prior.is_none());
    let in_unit = |p: &Parameter, x: f64| format!("{} {}", p.digits(x), p.unit.symbol());
    let mut unusual: Vec<(f64, &Parameter)> = physical
        .clone()
        .map(|(p, sigma)| ((value(p).abs() - SURELY * sigma) / p.scale, p))
        .filter(|(times, _)| *times > UNUSUAL)
        .collect();
    unusual.sort_by(|a, b| b.0.total_cmp(&a.0));
    if let Some((times, p)) = unusual.first() {
        let message = format!(
            "{} comes out as {}, {:.0} times its typical size ({} values are beyond {UNUSUAL} \
             times); base and tool alone leave {frames_rms_mm:.1} mm",
            p.key,
            in_unit(p, value(p)),
            value(p).abs() / p.scale,
            unusual.len(),
        );
        if *times > ABSURD {
            return Err(suspicious(message, NOT_OF_THIS_ROBOT));
        }
        remarks.push(remark(
            "unusual-value",
            WHOLE_FILE,
            message,
            NOT_OF_THIS_ROBOT,
        ));
    }
    // what a profile may not have without a reason, that of the start excepted
    let large = estimate.effects.iter().find_map(|effect| {
        let is_frame = matches!(effect.kind, Kind::BaseFrame | Kind::ToolFrame);
        let (parameter, value, limit) = effect.beyond_usual().filter(|_| !is_frame)?;
        let is_identified = |p: &Parameter| {
            matches!(p.subject, Subject::Effect(slot)
                if estimate.effects[slot.effect].same_place(effect))
        };
        let is_identified = parameters.iter().any(is_identified);
        is_identified.then(|| (effect.label(), parameter.key, value, limit))
    });
    if let Some((label, key, value, limit)) = large.filter(|_| remarks.is_empty()) {
        remarks.push(remark(
            "unusual-value",
            WHOLE_FILE,
            format!("{label} {key} comes out as {value:.3e}, beyond the {limit} that arms have"),
            "was a motor or an encoder mounted anew, or a joint mastered at another place? where \
             that is so the controller's zero is better corrected than compensated",
        ));
    }
    // a spring: what gives way by a torque, against it
    let springs = |slot: Slot| {
        let definition = estimate.effects[slot.effect].definition();
        definition.search.never_negative.contains(&slot.parameter)
            && definition.parameters[slot.parameter].unit == Unit::RadPerNm
    };
    let springs: Vec<(&Parameter, &f64)> = physical
        .filter(|(p, _)| matches!(p.subject, Subject::Effect(slot) if springs(slot)))
        .collect();
    let negative = springs
        .iter()
        .filter(|(p, sigma)| value(p) < -SURELY * **sigma);
    let negative: Vec<String> = negative
        .map(|(p, sigma)| {
            let (value, sigma) = (in_unit(p, value(p)), in_unit(p, **sigma));
            format!("{} ({value} ± {sigma})", p.key)
        })
        .collect();
    if !negative.is_empty() {
        let message = format!(
            "{} {} negative: no joint springs against its load",
            negative.join(", "),
            if negative.len() == 1 { "is" } else { "are" }
        );
        let hint = if negative.len() > 1 && negative.len() == springs.len() {
            "all springs are: `gravity_m_s2` of the profile may be upside down (0, 0, -9.81 of an \
             arm on the floor), or the masses are wrong"
        } else {
            "it imitates another effect: `poseshift diagnose` looks for it; are the masses right?"
        };
        remarks.push(remark("negative-compliance", WHOLE_FILE, message, hint));
    }
    Ok(remarks)
}
