//! Where a rotary axis has its zero.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{axis, deg};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::Scalar;

/// The same as a rotation of the plate about the last axis: known only where the plate is.
pub(super) struct PositionerZero;

impl Equation for PositionerZero {
    const DEFINITION: Definition = Definition {
        id: "positioner_zero",
        summary: "an axis of a positioner shows zero at another angle",
        equation: "angle + deg",
        source: "rigid motions of a rotary axis (ISO 230-7: tilt, eccentricity, axial and radial \
            error motion)",
        site: &[SiteKey::Axis],
        parameters: &[
            Parameter { key: "deg", unit: Unit::Degree, prior_sigma: 0.05 },
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
        error.angle += p[0];
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!("{} has its zero {}° elsewhere", axis(effect), deg(effect.parameters[0]))
    }
}
