//! Backlash between gears.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{LAGS, deg, joint};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// a joint stands half the width before or after its command, by the direction in which it last moved (negative width: it lags).
pub(super) struct Backlash;

impl Equation for Backlash {
    const DEFINITION: Definition = Definition {
        id: "backlash",
        summary: "a joint stands half the width before or after its command, by the direction in \
            which it last moved (negative width: it lags)",
        equation: "δq = width/2 · direction",
        source: "A. Nubiola, thesis, table 2.3",
        site: &[SiteKey::Joint],
        parameters: &[Parameter { key: "width_deg", unit: Unit::Degree, prior_sigma: 0.02 }],
        needs: &[Need::Directions],
        deflects: true,
        bends: false,
        of_data: false,
        shown_against: Shown::Direction,
        search: Search::PLAIN,
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let half = S::constant(0.5 * state.conditions.direction[site.index]);
        deflection.joints[site.index] += half * p[0];
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        if effect.parameters[0] < 0.0 {
            format!("{} loses {}° when it reverses", joint(effect), deg(-effect.parameters[0]))
        } else {
            format!("{} runs {}° ahead when it reverses{LAGS}", joint(effect), deg(effect.parameters[0]))
        }
    }
}
