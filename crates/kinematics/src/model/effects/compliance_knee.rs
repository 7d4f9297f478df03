//! A gearbox that is softer near zero load.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{List, Search, Sets, Shown};
use super::words::{deg, digits, joint};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// A joint that is more compliant while its torque is below the knee: beyond it the additional deflection stays.
pub(super) struct ComplianceKnee;

impl Equation for ComplianceKnee {
    const DEFINITION: Definition = Definition {
        id: "compliance_knee",
        summary: "a gearbox is softer near zero load: an additional compliance up to the torque of \
            the knee",
        equation: "δq = rad_per_n_m · clamp(τ, −torque_n_m, +torque_n_m), on top of \
            joint_compliance",
        source: "A. Nubiola, thesis, sec. 2.5; the piecewise linear torsional stiffness K1, K2 of \
            strain wave gears' data sheets",
        site: &[SiteKey::Joint],
        parameters: &[
            Parameter { key: "torque_n_m", unit: Unit::NewtonMetre, prior_sigma: 20.0 },
            Parameter { key: "rad_per_n_m", unit: Unit::RadPerNm, prior_sigma: 1e-4 },
        ],
        needs: &[Need::Masses],
        deflects: true,
        bends: false,
        of_data: false,
        shown_against: Shown::Torque(None),
        search: Search {
            rare: true,
            held: true,
            never_negative: &[1],
            sets: Sets::At(0, List::Torques),
            ..Search::PLAIN
        },
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let knee = p[0].abs();
        deflection.joints[site.index] += p[1] * state.torques[site.index].min(knee).max(-knee);
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "{} is soft near zero load: {}° more up to {} N m",
            joint(effect),
            deg(effect.parameters[0] * effect.parameters[1]),
            digits(effect.parameters[0])
        )
    }
}
