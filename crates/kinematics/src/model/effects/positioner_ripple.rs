//! What repeats in each rotation of a positioner’s axis.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{axis, deg, length};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::Scalar;

/// As `joint_harmonic` of an arm’s joint.
pub(super) struct PositionerRipple;

impl Equation for PositionerRipple {
    const DEFINITION: Definition = Definition {
        id: "positioner_ripple",
        summary: "the gear of a positioner errs periodically",
        equation: "cos · cos(n · angle) + sin · sin(n · angle), n the order",
        source: "rigid motions of a rotary axis (ISO 230-7: tilt, eccentricity, axial and radial \
            error motion)",
        site: &[SiteKey::Axis, SiteKey::Order],
        parameters: &[
            Parameter { key: "cos_deg", unit: Unit::Degree, prior_sigma: 0.01 },
            Parameter { key: "sin_deg", unit: Unit::Degree, prior_sigma: 0.01 },
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
        let (sine, cosine) = (S::constant(site.periods()) * at.moved).sin_cos();
        error.angle += p[0] * cosine + p[1] * sine;
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "{} runs fast and slow by {}°, {} times a revolution",
            axis(effect),
            deg(length(&effect.parameters[..2])),
            effect.site.periods()
        )
    }
}
