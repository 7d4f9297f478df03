//! How a rotary axis wobbles.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{axis, length, mm};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::Scalar;

/// Radial and axial error motion.
pub(super) struct PositionerRunout;

impl Equation for PositionerRunout {
    const DEFINITION: Definition = Definition {
        id: "positioner_runout",
        summary: "an axis of a positioner wobbles as it rotates",
        equation: "cos · cos(n · angle) + sin · sin(n · angle) along x, y or z of the axis as it \
            stands; across the axis order 1 is the plate’s x and y",
        source: "rigid motions of a rotary axis (ISO 230-7: tilt, eccentricity, axial and radial \
            error motion)",
        site: &[SiteKey::Axis, SiteKey::Along("xyz"), SiteKey::Order],
        parameters: &[
            Parameter { key: "cos_mm", unit: Unit::Millimetre, prior_sigma: 0.05 },
            Parameter { key: "sin_mm", unit: Unit::Millimetre, prior_sigma: 0.05 },
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
        error.offset[site.on] += p[0] * cosine + p[1] * sine;
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "{} wobbles by {} mm, {} times a revolution",
            axis(effect),
            mm(length(&effect.parameters[..2])),
            effect.site.periods()
        )
    }
}
