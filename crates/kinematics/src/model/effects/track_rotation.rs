//! How a carriage rotates along its rail.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{axis, deg};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site, power};
use crate::geometry::Scalar;

/// A power of the place on the rail about x (roll), y (pitch) or z (yaw); gravity stays in the world.
pub(super) struct TrackRotation;

impl Equation for TrackRotation {
    const DEFINITION: Definition = Definition {
        id: "track_rotation",
        summary: "the carriage rolls, pitches or yaws along a linear axis",
        equation: "Rx(Σ deg · sⁿ) · Ry(…) · Rz(…) about the base’s origin along the rail’s axes; s \
            from −1 to 1 over the limits",
        source: "J. Kleinkes, W. Neddermeyer, M. Schnell, \"Improved method for highly accurate \
            integration of track motions\", SciTePress (2006), as polynomials of the travel",
        site: &[SiteKey::Axis, SiteKey::About("xyz"), SiteKey::Degree(1, 4)],
        parameters: &[
            Parameter { key: "deg", unit: Unit::Degree, prior_sigma: 0.02 },
        ],
        needs: &[],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Order,
        search: Search::PLAIN,
    };
    const READS_ANGLES: bool = false;

    fn carry<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], at: &AxisState<S>, error: &mut AxisError<S>) {
        error.turn[site.on] += p[0] * power(at.part, site.order);
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!("The carriage of {} rotates by {}° to its ends", axis(effect), deg(effect.parameters[0]))
    }
}
