//! A step of one of several reflectors on the tool during the session.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{length, mm};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// From one row of the measurements on, one of the points on the tool stands elsewhere, and the others do not. An effect of the data,
/// not of the robot.
pub(super) struct ReflectorSlip;

impl Equation for ReflectorSlip {
    const DEFINITION: Definition = Definition {
        id: "reflector_slip",
        summary: "one of several reflectors slipped on the tool during the session: a step from one \
            row on (an effect of the data)",
        equation: "rows of `point` from `row` on: world_from_tool · Trans(x, y, z)",
        source: "A. Nubiola, thesis, eq. I.2, from a change point on, of one point alone",
        site: &[SiteKey::Point, SiteKey::Row],
        parameters: &[
            Parameter { key: "x_mm", unit: Unit::Millimetre, prior_sigma: 0.5 },
            Parameter { key: "y_mm", unit: Unit::Millimetre, prior_sigma: 0.5 },
            Parameter { key: "z_mm", unit: Unit::Millimetre, prior_sigma: 0.5 },
        ],
        needs: &[Need::Order, Need::Points],
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
        let is_own = state.conditions.point.is_some_and(|point| point as usize == site.index);
        if is_own && state.conditions.row.is_some_and(|row| row >= site.order) {
            for k in 0..3 {
                deflection.tool[k] += p[k];
            }
        }
    }

    fn sentence(effect: &Effect, seen: &Seen) -> String {
        let name = seen.points.get(effect.site.index);
        format!(
            "The reflector {} slipped before row {} by {} mm, and no other",
            name.map_or_else(|| (effect.site.index + 1).to_string(), Clone::clone),
            effect.site.order,
            mm(length(&effect.parameters[..3]))
        )
    }
}
