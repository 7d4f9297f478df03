//! How the plate sits on its axis.

use super::definition::{Definition, SiteKey, frame_parameters};
use super::search::{Search, Shown};
use super::words::{axis, deg, length, mm};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::Scalar;

/// `axis` is the positioner’s last one. Eccentricity is x and y.
pub(super) struct PositionerPlate;

impl Equation for PositionerPlate {
    const DEFINITION: Definition = Definition {
        id: "positioner_plate",
        summary: "the plate sits elsewhere on the last axis of a positioner",
        equation: "plate · Trans(x, y, z) · Rx(rx) · Ry(ry) · Rz(rz)",
        source: "rigid motions of a rotary axis (ISO 230-7: tilt, eccentricity, axial and radial \
            error motion)",
        site: &[SiteKey::Axis],
        parameters: &frame_parameters(1.0, 0.1),
        needs: &[],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Order,
        search: Search::PLAIN,
    };
    const READS_ANGLES: bool = false;

    fn carry<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], _: &AxisState<S>, error: &mut AxisError<S>) {
        for k in 0..6 {
            error.plate[k] += p[k];
        }
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "The plate on {} sits {} mm and {}° from where the profile has it",
            axis(effect),
            mm(length(&effect.parameters[..3])),
            deg(length(&effect.parameters[3..]))
        )
    }
}
