//! Where the base and the device stand.

use super::error::IdentifyError;
use super::parameters::Subject;
use super::solver::{Solution, absorb_base, belongs};
use super::start::base_gap;
use super::uncertainty::Uncertainty;
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::effects::Kind;
use crate::profile::{DevicePlace, Profile};
use std::f64::consts::TAU;

/// The profile's base is believed to be in the device's frame where the measured one is nearer than
/// this, metres.
const SAME_PLACE_M: f64 = 0.02;
/// And rotated by less than this, radians.
const SAME_TURN_RAD: f64 = 1.0 * DEG;

/// What becomes of the measured place of the base.
///
/// A device sees the base in its own frame: `device_from_base`, the product of where the device
/// stands and where the base stands. No measurement of the arm divides that product; something else
/// must say where one of the two is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BasePolicy {
    /// The base is where the controller has it, with the effects `base_frame` of the profile; what
    /// was measured is where the device stands.
    Controller,
    /// It is the device's world that counts: `kinematics.base` is replaced.
    Device,
    /// The profile's base counts: the difference is the effect `base_frame`.
    Profile,
    /// `Profile` where they are within 20 mm and 1°, else `Device`.
    Nearest,
}

/// Whether a base so far (metres) and so rotated (radians) from another is believed to be in its
/// place.
pub(crate) fn is_same_place((far, turned): (f64, f64)) -> bool {
    far < SAME_PLACE_M && turned < SAME_TURN_RAD
}

/// A track's direction stands in the profile's world: another world needs another direction.
pub(super) fn refuse_other_world(profile: &Profile, base: &Pose) -> Result<(), IdentifyError> {
    let (far, turned) = base_gap(&profile.world_from_base, base);
    if profile.external.is_empty() || is_same_place((far, turned)) {
        return Ok(());
    }
    Err(IdentifyError::Suspicious {
        message: format!(
            "the base is {:.1} mm and {:.1} deg from where the profile has it, and `external_axes` \
             of the profile stand in the profile's world",
            mm_from_m(far),
            turned / DEG
        ),
        hint: "leave --base out: where the device stands is then identified apart".into(),
    })
}

/// Puts the measured base where the policy wants it. Whether it replaces the profile's.
pub(super) fn base_policy(
    policy: BasePolicy,
    profile: &Profile,
    solution: &mut Solution,
) -> Result<bool, IdentifyError> {
    if policy == BasePolicy::Controller {
        absorb_base(&mut solution.estimate);
        return Ok(false);
    }
    let measured = solution.estimate.world_from_base;
    let (far, turned) = base_gap(&profile.world_from_base, &measured);
    let near = is_same_place((far, turned));
    if policy == BasePolicy::Device || policy == BasePolicy::Nearest && !near {
        absorb_base(&mut solution.estimate);
        return Ok(true);
    }
    if turned > 60.0 * DEG {
        return Err(IdentifyError::Suspicious {
            message: format!(
                "the base is {:.1} mm and {:.1} deg from where the profile has it",
                mm_from_m(far),
                turned / DEG
            ),
            hint: "with --base device the measured place replaces the profile's".into(),
        });
    }
    let deviation = (profile.world_from_base.inverse() * measured).xyz_rxryrz();
    for effect in solution
        .estimate
        .effects
        .iter_mut()
        .filter(|e| e.kind == Kind::BaseFrame)
    {
        effect.parameters = deviation;
    }
    solution.estimate.world_from_base = profile.world_from_base;
    Ok(false)
}

/// Where the device stands, of rows in a frame that `frame_from_device` maps into, with the
/// standard deviations of its numbers.
///
/// `world_from_device = real_base · (measured_base · T(δ))⁻¹ · frame_from_device` with the
/// deviation δ of the base, whose covariance is propagated by central differences. No deviation is
/// known where one of the six is not determined.
pub(super) fn device_of(
    profile: &Profile,
    solution: &Solution,
    uncertainty: &Uncertainty,
    frame_from_device: &Pose,
) -> DevicePlace {
    const STEP: f64 = 1e-6;
    let estimate = &solution.estimate;
    let place = |deviation: [f64; 6]| {
        let base = estimate.world_from_base * Pose::from_xyz_rxryrz(deviation);
        profile.world_from_real_base() * base.inverse() * *frame_from_device
    };
    let parameters = solution.parameters.iter().enumerate();
    let of_base: Vec<(usize, usize, f64)> = parameters
        .filter(|(_, p)| belongs(estimate, p, Kind::BaseFrame))
        .filter_map(|(i, p)| match p.subject {
            Subject::Effect(slot) => Some((i, slot.parameter, p.scale)),
            _ => None,
        })
        .collect();
    let slopes: Vec<[f64; 6]> = of_base
        .iter()
        .map(|(_, number, scale)| {
            let ends = [-STEP, STEP].map(|step| {
                let mut deviation = [0.0; 6];
                deviation[*number] = step;
                place(deviation).xyz_rxryrz()
            });
            std::array::from_fn(|k| {
                let change = ends[1][k] - ends[0][k];
                // an angle may pass a half revolution between the two
                let turns = if k < 3 { 0.0 } else { (change / TAU).round() };
                scale * (change - turns * TAU) / (2.0 * STEP)
            })
        })
        .collect();
    let sigma = std::array::from_fn(|k| {
        let mut variance = 0.0;
        for (a, (i, ..)) in of_base.iter().enumerate() {
            for (b, (j, ..)) in of_base.iter().enumerate() {
                variance += slopes[a][k] * uncertainty.covariance[(*i, *j)] * slopes[b][k];
            }
        }
        variance.max(0.0).sqrt()
    });
    DevicePlace {
        world_from_device: place([0.0; 6]),
        sigma: (of_base.len() == 6).then_some(sigma),
    }
}
