//! Where the base really stands.

use super::definition::{Definition, frame_parameters};
use super::search::{BASE_FRAME, Search, Shown};
use super::words::{deg, length, mm};
use super::{Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::{Pose, Scalar};
use crate::model::{Conditions, Geometry};

/// `world_from_base · Trans(x, y, z) · Rx · Ry · Rz`: the deviation is given in the base's own frame.
pub(super) struct BaseFrame;

impl Equation for BaseFrame {
    const DEFINITION: Definition = Definition {
        id: "base_frame",
        summary: "the base stands elsewhere than the profile says",
        equation: "real world_from_base = world_from_base · Trans(x, y, z) · Rx(rx) · Ry(ry) · \
            Rz(rz)",
        source: "A. Nubiola, thesis, eq. I.2",
        site: &[],
        parameters: &frame_parameters(2.0, 0.2),
        needs: &[],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Order,
        search: Search {
            sets: BASE_FRAME,
            ..Search::PLAIN
        },
    };

    fn change_geometry<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], _: &Conditions, geometry: &mut Geometry<S>) {
        geometry.world_from_base = geometry.world_from_base * Pose::from_xyz_rxryrz(*p);
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        let (place, turned) = (length(&effect.parameters[..3]), length(&effect.parameters[3..]));
        match (place == 0.0, turned == 0.0) {
            (false, true) => {
                format!("The base or the measuring device stands {} mm from where the profile has it", mm(place))
            }
            (true, false) => {
                format!("The base or the measuring device is rotated by {}° from how the profile has it", deg(turned))
            }
            _ => format!(
                "The base or the measuring device stands {} mm from where the profile has it and rotated by {}°",
                mm(place),
                deg(turned)
            ),
        }
    }
}
