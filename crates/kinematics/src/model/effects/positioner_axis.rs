//! Where a rotary axis of a positioner really is.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{axis, deg, length, mm};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::Scalar;

/// Along and about the axis itself nothing shows: that is `positioner_zero` and the plate.
pub(super) struct PositionerAxis;

impl Equation for PositionerAxis {
    const DEFINITION: Definition = Definition {
        id: "positioner_axis",
        summary: "an axis of a positioner is elsewhere than the controller has it",
        equation: "axis · Trans(x, y, 0) · Rx(rx) · Ry(ry)",
        source: "rigid motions of a rotary axis (ISO 230-7: tilt, eccentricity, axial and radial \
            error motion)",
        site: &[SiteKey::Axis],
        parameters: &[
            Parameter { key: "x_mm", unit: Unit::Millimetre, prior_sigma: 1.0 },
            Parameter { key: "y_mm", unit: Unit::Millimetre, prior_sigma: 1.0 },
            Parameter { key: "rx_deg", unit: Unit::Degree, prior_sigma: 0.1 },
            Parameter { key: "ry_deg", unit: Unit::Degree, prior_sigma: 0.1 },
        ],
        needs: &[],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Order,
        search: Search::PLAIN,
    };
    const READS_ANGLES: bool = false;

    fn carry<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], _: &AxisState<S>, error: &mut AxisError<S>) {
        for k in 0..4 {
            error.place[k] += p[k];
        }
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "{} is {} mm and {}° from where the profile has it",
            axis(effect),
            mm(length(&effect.parameters[..2])),
            deg(length(&effect.parameters[2..4]))
        )
    }
}
