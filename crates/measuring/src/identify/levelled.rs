//! Where down is: a levelled device knows better than the robot's foot.

use super::calibration::{Calibration, Options, identify};
use super::error::IdentifyError;
use super::input_checks::screening;
use super::measurements::Measurements;
use crate::geometry::units::DEG;
use crate::geometry::{dot, norm, scale};
use crate::profile::Profile;

/// Gravity along the device's z is tried where that is tilted from the profile's by so much,
/// radians.
const TILTED_RAD: f64 = 3.0 * DEG;
/// And by no more.
const MOST_TILTED_RAD: f64 = 60.0 * DEG;
/// There is strong evidence for one of two models of as many parameters beyond this, twice a log
/// likelihood: odds of 20 (R. E. Kass, A. E. Raftery, "Bayes factors" (1995)).
const STRONG: f64 = 6.0;

/// The calibration with gravity along the device's z where axis 1 is tilted from where the profile
/// has it, and the arm clearly bends so: a levelled device knows better than the robot's foot where
/// down is.
pub(super) fn by_the_device(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
    found: Calibration,
    tell: &mut dyn FnMut(),
) -> Result<Calibration, IdentifyError> {
    let size = norm(profile.gravity_m_s2);
    let along = |found: &Calibration| {
        let device = found.device.filter(|_| !found.base_replaced)?;
        let down = scale(-size, device.world_from_device.rotation.axis(2));
        // as a profile writes it
        Some(down.map(|g| (1e6 * g).round() / 1e6))
    };
    let Some(first) = along(&found).filter(|_| size > 0.0) else {
        return Ok(found);
    };
    let cosine = dot(first, profile.gravity_m_s2) / (size * size);
    let tilt = cosine.clamp(-1.0, 1.0).acos();
    // one that lies or stands on its head was not levelled
    if !(TILTED_RAD..MOST_TILTED_RAD).contains(&tilt) {
        return Ok(found);
    }
    let mut with = |gravity_m_s2| {
        let levelled = Profile {
            gravity_m_s2,
            ..profile.clone()
        };
        identify(&levelled, measurements, options, tell)
    };
    // where the device stands follows from how the arm bends, by a little
    let mut other = with(first)?;
    let second = along(&other).unwrap_or(first);
    if second != first {
        other = with(second)?;
    }
    let counts: Vec<usize> = (other.problem.rows.iter())
        .map(|row| row.observed.count())
        .collect();
    let loss = other.solution.loss;
    let [own, others] = [&found, &other].map(|c| -> f64 {
        let rows = c.solution.normal.squares.iter().zip(&counts);
        rows.map(|(squared, count)| loss.of(*squared, *count).0)
            .sum()
    });
    let better = (own - others) / other.uncertainty.sigma_factor.powi(2);
    if better <= STRONG {
        return Ok(found);
    }
    other.remarks.retain(|remark| remark.id != "base-tilted");
    other
        .remarks
        .push(screening::gravity_by_device(tilt, better, second));
    Ok(other)
}
