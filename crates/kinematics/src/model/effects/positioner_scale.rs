//! How far a rotary axis goes.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{axis, deg, too};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::units::DEG;
use crate::geometry::Scalar;

/// The angle from its zero, times a ratio.
pub(super) struct PositionerScale;

impl Equation for PositionerScale {
    const DEFINITION: Definition = Definition {
        id: "positioner_scale",
        summary: "an axis of a positioner goes farther or less far than commanded",
        equation: "angle · (1 + ratio)",
        source: "rigid motions of a rotary axis (ISO 230-7: tilt, eccentricity, axial and radial \
            error motion)",
        site: &[SiteKey::Axis],
        parameters: &[
            Parameter { key: "ratio", unit: Unit::Ratio, prior_sigma: 1e-4 },
        ],
        needs: &[],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Order,
        search: Search::PLAIN,
    };
    const READS_ANGLES: bool = false;
    const LARGEST: &'static [(&'static str, f64)] = &[("ratio", 2.0 / 360.0)];

    fn carry<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], _: &AxisState<S>, error: &mut AxisError<S>) {
        error.scale += p[0];
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        let ratio = effect.parameters[0];
        format!("{} rotates {}° too {} in 90°", axis(effect), deg(ratio.abs() * 90.0 * DEG), too(ratio))
    }
}
