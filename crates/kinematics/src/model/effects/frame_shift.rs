//! A step of the measuring device or the base during the session.

use super::definition::{Definition, Need, SiteKey, frame_parameters};
use super::search::{FRAME, Search, Shown};
use super::words::mm;
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::{Pose, Scalar, norm, sub};

/// From one row of the measurements on, everything is seen moved in the world. An effect of the data, not of the robot.
pub(super) struct FrameShift;

impl Equation for FrameShift {
    const DEFINITION: Definition = Definition {
        id: "frame_shift",
        summary: "the measuring device or the base moved during the session: a step from one row \
            on (an effect of the data)",
        equation: "rows from `row` on: Trans(x, y, z) · Rx(rx) · Ry(ry) · Rz(rz) · world_from_tool",
        source: "A. Nubiola, thesis, eq. I.2, from a change point on",
        site: &[SiteKey::Row],
        parameters: &frame_parameters(0.5, 0.05),
        needs: &[Need::Order],
        deflects: true,
        bends: true,
        of_data: true,
        shown_against: Shown::Time,
        search: Search {
            sets: FRAME,
            ..Search::PLAIN
        },
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        if state.conditions.row.is_some_and(|row| row >= site.order) {
            for k in 0..6 {
                deflection.world[k] += p[k];
            }
        }
    }

    fn sentence(effect: &Effect, seen: &Seen) -> String {
        // a rotation about the device far away moves it by the lever
        let moved = Pose::from_xyz_rxryrz(effect.parameters).transform(seen.base_m);
        format!(
            "The measuring device or the base moved before row {} by {} mm where the robot stands",
            effect.site.order,
            mm(norm(sub(moved, seen.base_m)))
        )
    }
}
