//! Checks of a validation: measurements that are not of this robot, or not as the file says.

use super::plausibility::{check_rows, times_sigma};
use super::screening::{check_points, check_start, duplicates, look, refuse_far_off};
use super::{Remark, WHOLE_FILE, finite, remark, sigma, temperatures};
use crate::identify::calibration::Outlier;
use crate::identify::error::IdentifyError;
use crate::identify::measurements::Measurements;
use crate::identify::start;
use crate::identify::statistics::{Miss, Quality};
use crate::identify::validation::Refit;
use crate::profile::Profile;

/// The real model is worse than the nominal arm with fitted frames by this factor where something
/// was moved.
const WORSE: f64 = 1.5;
/// Errors below this are never questioned, mm.
const SMALL_MM: f64 = 0.1;
/// Frames that are fitted and still miss by more are not of this robot, mm.
const HOPELESS_MM: f64 = 20.0;

/// What can be seen before any model is judged, as `calibrate` sees it.
///
/// # Errors
/// Another reading of the file fits much better; a point far from all others; a model that is not
/// finite.
pub(crate) fn before(
    profile: &Profile,
    measurements: &Measurements,
    refit: Refit,
) -> Result<Vec<Remark>, IdentifyError> {
    finite::check(profile, measurements)?;
    refuse_far_off(measurements)?;
    let unit = temperatures::check(measurements)?;
    let mut remarks = match look(profile, measurements) {
        Ok(remarks) => unit.into_iter().chain(remarks).collect::<Vec<_>>(),
        // one pose or one line may be what is to be judged
        Err(IdentifyError::Suspicious { message, hint }) => {
            let mut remarks = vec![remark("little-variety", WHOLE_FILE, message, &hint)];
            remarks.extend(unit);
            remarks.extend(duplicates(&measurements.rows));
            // what follows from poses that differ does not from these
            return Ok(remarks);
        }
        Err(other) => return Err(other),
    };
    // nothing is identified
    remarks.retain(|remark| remark.id != "joint-never-moved");
    if let Some(start) = start::find(profile, measurements) {
        let mut found = check_start(profile, measurements, &start)?;
        if refit == Refit::No {
            check_points(&start)?;
        }
        // fitted tools may be anywhere
        found.retain(|remark| remark.id != "tool-elsewhere" || refit == Refit::No);
        for remark in &mut found {
            if remark.id == "tool-elsewhere" {
                remark.hint =
                    "is it the tool of the profile? --refit-frames fits base, tool and points \
                     first"
                        .into();
            }
        }
        remarks.extend(found);
    }
    Ok(remarks)
}

/// What the errors say.
pub(crate) fn after(
    (real, misses): (&Quality, &[Miss]),
    frames: &Quality,
    normalised: Option<f64>,
    outliers: &[Outlier],
    refit: Refit,
) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let missed = real.main().zip(frames.main());
    let moved = missed.filter(|(real, frames)| {
        real.rms > SMALL_MM && real.rms > WORSE * frames.rms && frames.rms < HOPELESS_MM
    });
    if let Some((_, frames)) = missed.filter(|(_, frames)| frames.rms >= HOPELESS_MM) {
        remarks.push(remark(
            "poor-fit",
            WHOLE_FILE,
            format!(
                "the nominal arm misses by {:.1} mm rms with base and tool fitted to these rows: \
                 no arm is that far from its drawing",
                frames.rms
            ),
            "is it this robot, this order of rows? every column in its unit?",
        ));
    }
    if let Some((real, frames)) = moved {
        let (message, hint) = if refit == Refit::No {
            (
                format!(
                    "the real model misses by {:.3} mm rms, the nominal arm with base and tool \
                     fitted to these rows by {:.3} mm",
                    real.rms, frames.rms
                ),
                "was the device, the robot or the tool set up anew? --refit-frames fits base, tool \
                 and points first",
            )
        } else {
            (
                format!(
                    "the real model misses by {:.3} mm rms, more than the nominal arm: {:.3} mm",
                    real.rms, frames.rms
                ),
                "is it the profile of this arm? was the arm repaired or its joints set anew since \
                 the calibration?",
            )
        };
        remarks.push(remark("worse-than-nominal", WHOLE_FILE, message, hint));
    }
    if moved.is_some() {
        return remarks;
    }
    remarks.extend(rows_off(outliers));
    // single rows say nothing of what is stated of all
    let usual = match outliers {
        [] => normalised,
        _ => normalised.and_then(|_| times_sigma(misses)),
    };
    remarks.extend(usual.and_then(|times| sigma(times, f64::INFINITY)));
    remarks
}

/// Rows that do not fit the others, where nothing is identified.
pub(crate) fn rows_off(outliers: &[Outlier]) -> Option<Remark> {
    let hint = "was the beam lost, the reflector not seated, the robot still moving? leave wrong \
        rows out; where they are right the model misses something there";
    let found = check_rows(outliers)?;
    Some(Remark {
        hint: hint.into(),
        ..found
    })
}
