//! A gearbox that is not stiff.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{deg, joint};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// a gearbox twists under the torque of gravity and external force.
pub(super) struct JointCompliance;

impl Equation for JointCompliance {
    const DEFINITION: Definition = Definition {
        id: "joint_compliance",
        summary: "a gearbox twists under the torque of gravity and external force",
        equation: "δq = rad_per_n_m · τ",
        source: "A. Nubiola, thesis, eqs. I.5–I.10",
        site: &[SiteKey::Joint],
        parameters: &[Parameter { key: "rad_per_n_m", unit: Unit::RadPerNm, prior_sigma: 1e-4 }],
        needs: &[Need::Masses],
        deflects: true,
        bends: false,
        of_data: false,
        shown_against: Shown::Torque(None),
        search: Search {
            as_a_set: true,
            never_negative: &[0],
            ..Search::PLAIN
        },
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        deflection.joints[site.index] += p[0] * state.torques[site.index];
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!("{} yields by {}° under 100 N m", joint(effect), deg(100.0 * effect.parameters[0]))
    }
}
