//! Lost motion that grows with the load.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{LAGS, deg, joint};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// A joint stands before or after its command by the direction in which it last moved, the more the higher its torque.
pub(super) struct FrictionBacklash;

impl Equation for FrictionBacklash {
    const DEFINITION: Definition = Definition {
        id: "friction_backlash",
        summary: "friction in the gear holds a joint short of its command, in proportion to its \
            torque (negative: it lags)",
        equation: "δq = rad_per_n_m · |τ| · direction",
        source: "Coulomb friction in proportion to the load, wound up by the gear's stiffness: A. \
            C. Bittencourt, S. Gunnarsson, \"Static friction in a robot joint\" (2012)",
        site: &[SiteKey::Joint],
        parameters: &[Parameter { key: "rad_per_n_m", unit: Unit::RadPerNm, prior_sigma: 5e-6 }],
        needs: &[Need::Masses, Need::Directions],
        deflects: true,
        bends: false,
        of_data: false,
        shown_against: Shown::Torque(None),
        search: Search {
            rare: true,
            ..Search::PLAIN
        },
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let direction = S::constant(state.conditions.direction[site.index]);
        deflection.joints[site.index] += p[0] * state.torques[site.index].abs() * direction;
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "{} {} {}° under 100 N m by the side it comes from{}",
            joint(effect),
            if effect.parameters[0] < 0.0 { "is held back" } else { "runs ahead" },
            deg(100.0 * effect.parameters[0].abs()),
            if effect.parameters[0] < 0.0 { "" } else { LAGS },
        )
    }
}
