//! What the tool really is.

use super::definition::{Definition, SiteKey, frame_parameters};
use super::search::{FRAME, Search, Shown};
use super::words::{deg, length, mm};
use super::{Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::{Pose, Scalar};
use crate::model::{Conditions, Geometry};

/// `flange_from_tool · Trans(x, y, z) · Rx · Ry · Rz`: the deviation is given in the tool's own frame.
pub(super) struct ToolFrame;

impl Equation for ToolFrame {
    const DEFINITION: Definition = Definition {
        id: "tool_frame",
        summary: "the tool's tip is elsewhere on the flange than the program or profile says",
        equation: "real flange_from_tool = flange_from_tool · Trans(x, y, z) · Rx(rx) · Ry(ry) · \
            Rz(rz)",
        source: "A. Nubiola, thesis, eq. I.2",
        site: &[SiteKey::Tool],
        parameters: &frame_parameters(1.0, 0.2),
        needs: &[],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Order,
        search: Search {
            sets: FRAME,
            ..Search::PLAIN
        },
    };

    fn change_geometry<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], _: &Conditions, geometry: &mut Geometry<S>) {
        if site.is_of_tool(&geometry.tool_name) {
            geometry.flange_from_tool = geometry.flange_from_tool * Pose::from_xyz_rxryrz(*p);
        }
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        let (place, turned) = (length(&effect.parameters[..3]), length(&effect.parameters[3..]));
        let off = format!("The tool's tip is {} mm from where the profile has it", mm(place));
        if turned == 0.0 {
            return off;
        }
        format!("{off}, the tool rotated by {}°", deg(turned))
    }
}
