//! A step of the tool or the reflector on the flange during the session.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{length, mm};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// From one row of the measurements on, the tool stands elsewhere on the flange. An effect of the data, not of the robot.
pub(super) struct ToolSlip;

impl Equation for ToolSlip {
    const DEFINITION: Definition = Definition {
        id: "tool_slip",
        summary: "the tool or reflector slipped on the flange during the session: a step from one \
            row on (an effect of the data)",
        equation: "rows from `row` on: world_from_tool · Trans(x, y, z)",
        source: "A. Nubiola, thesis, eq. I.2, from a change point on",
        site: &[SiteKey::Row],
        parameters: &[
            Parameter { key: "x_mm", unit: Unit::Millimetre, prior_sigma: 0.5 },
            Parameter { key: "y_mm", unit: Unit::Millimetre, prior_sigma: 0.5 },
            Parameter { key: "z_mm", unit: Unit::Millimetre, prior_sigma: 0.5 },
        ],
        needs: &[Need::Order],
        deflects: true,
        bends: true,
        of_data: true,
        shown_against: Shown::Time,
        search: Search {
            ..Search::PLAIN
        },
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        if state.conditions.row.is_some_and(|row| row >= site.order) {
            for k in 0..3 {
                deflection.tool[k] += p[k];
            }
        }
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "The tool or the reflector slipped before row {} by {} mm",
            effect.site.order,
            mm(length(&effect.parameters[..3]))
        )
    }
}
