//! A tool that bends under its own weight.

use super::definition::{Definition, Need, Parameter, Unit};
use super::search::{Search, Shown};
use super::words::{deg, largest};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::{Scalar, cross, sub};

/// The tool rotates about x and y of the flange in proportion to the moment of its own weight there.
pub(super) struct ToolCompliance;

impl Equation for ToolCompliance {
    const DEFINITION: Definition = Definition {
        id: "tool_compliance",
        summary: "the tool or its adapter bends at the flange under the tool's own weight",
        equation: "rotation about x of the flange = x_rad_per_n_m · M_x, about y = y_rad_per_n_m · \
            M_y, M the moment of the tool's weight about the flange in its axes",
        source: "a beam clamped at the flange: S. Timoshenko, \"Strength of materials\"",
        site: &[],
        parameters: &[
            Parameter { key: "x_rad_per_n_m", unit: Unit::RadPerNm, prior_sigma: 1e-4 },
            Parameter { key: "y_rad_per_n_m", unit: Unit::RadPerNm, prior_sigma: 1e-4 },
        ],
        needs: &[Need::Load],
        deflects: true,
        bends: true,
        of_data: false,
        shown_against: Shown::Torque(Some(4)),
        search: Search {
            ..Search::BENDING
        },
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let Some(frames) = state.frames else { return };
        let moment = frames.flange.rotation.transpose() * frames.tool_moment;
        let turn = frames.flange.rotation * [p[0] * moment[0], p[1] * moment[1], S::zero()];
        let lever = sub(frames.tool.translation, frames.flange.translation);
        // in the tool's own frame
        let back = frames.tool.rotation.transpose();
        let (shift, turn) = (back * cross(turn, lever), back * turn);
        for k in 0..3 {
            deflection.tool[k] += shift[k];
            deflection.tool[3 + k] += turn[k];
        }
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!("The tool bends at the flange: {}° at most under 10 N m", deg(10.0 * largest(&effect.parameters[..2])))
    }
}
