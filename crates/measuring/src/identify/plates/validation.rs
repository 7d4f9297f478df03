//! What positioners of a profile are worth on points on their plates.

use super::begin;
use crate::identify::error::IdentifyError;
use crate::identify::input_checks::validation::rows_off;
use crate::identify::measurements::{Measurements, Purpose};
use crate::identify::outlying;
use crate::identify::parameters::{Level, Selection};
use crate::identify::problem::{Estimate, PointRef, Problem};
use crate::identify::robust::Shape;
use crate::identify::solver::solve;
use crate::identify::validation::{Judged, Refit, Validation, controller_profile, judged, parts};
use crate::profile::Profile;

/// Compares points on plates with a profile's positioners.
///
/// With `refit` the points, or where a plate is whose points are known, are fitted first; where the
/// device stands is the profile's.
///
/// # Errors
/// As [`super::calibrate_plates`]; points without coordinates where they are not to be fitted.
pub fn validate_plates(
    profile: &Profile,
    measurements: &Measurements,
    refit: Refit,
) -> Result<Validation, IdentifyError> {
    let measurements = &*measurements.in_world_of(profile)?;
    let is_for = |row: usize| measurements.rows[row].purpose == Some(Purpose::Validate);
    let is_judged = |row: usize| refit != Refit::Others || is_for(row);
    let is_fitted = |row: usize| refit != Refit::Others || !is_for(row);
    let frames = Selection::level(Level::Frames);
    let at_rest = |profile: &Profile| begin(profile, measurements, &frames);
    let fitted = |profile: &Profile| {
        let (problem, begun) = at_rest(profile)?;
        let training = problem.with_rows(is_fitted);
        let solution = solve(&training, begun, Shape::Squares, false)?;
        Ok::<_, IdentifyError>((problem, solution.estimate))
    };
    let controller = controller_profile(profile);
    let (problem, own) = at_rest(profile)?;
    let unknown = problem.rows.iter().find(|row| match row.point {
        PointRef::Known(_) => false,
        PointRef::Named(index) => !problem.points[index].known,
    });
    if let Some(row) = unknown.filter(|_| refit == Refit::No) {
        let row = &measurements.rows[row.measurement];
        return Err(IdentifyError::Suspicious {
            message: format!(
                "{}: where point `{}` is on the plate is neither in the file nor in the profile",
                row.line,
                row.point.as_deref().unwrap_or_default()
            ),
            hint: "with --refit-frames the points are fitted to these rows first".into(),
        });
    }
    let of = |(problem, estimate): &(Problem, Estimate)| -> Judged {
        judged(&problem.with_rows(is_judged), estimate)
    };
    let frames_only = of(&fitted(&controller)?);
    let (by_controller, real) = match refit {
        Refit::No => (of(&at_rest(&controller)?), (problem, own)),
        Refit::Judged | Refit::Others => (frames_only.clone(), fitted(profile)?),
    };
    let rows = measurements.filtered(|row, _| is_judged(row));
    let real_judged = of(&real);
    let squares = real_judged.misses.iter().map(|m| m.normalised.powi(2));
    let rms = (squares.sum::<f64>() / real_judged.misses.len().max(1) as f64).sqrt();
    let problem = real.0.with_rows(is_judged);
    let outliers = outlying::of_judged(&problem, measurements, &real_judged.misses);
    Ok(Validation {
        parts: parts(profile, &rows, &real_judged.misses, None),
        repeated: Vec::new(),
        repeated_distances: Vec::new(),
        remarks: rows_off(&outliers).into_iter().collect(),
        controller: by_controller,
        frames_only,
        real: real_judged,
        refit,
        normalised_rms: (!problem.sigma_assumed).then_some(rms),
        problem,
        estimate: real.1,
        measurements: rows,
        folds: None,
    })
}
