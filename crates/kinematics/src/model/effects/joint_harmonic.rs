//! A joint whose error repeats with its angle.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{deg, joint, length};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// an eccentric gear or encoder adds a wave of so many periods in one revolution.
pub(super) struct JointHarmonic;

impl Equation for JointHarmonic {
    const DEFINITION: Definition = Definition {
        id: "joint_harmonic",
        summary: "an eccentric gear or encoder adds a wave of so many periods in one revolution",
        equation: "δq = cos · cos(order · q) + sin · sin(order · q)",
        source: "A. Nubiola, thesis, sec. 1.8",
        site: &[SiteKey::Joint, SiteKey::Order],
        parameters: &[
            Parameter { key: "cos_deg", unit: Unit::Degree, prior_sigma: 0.02 },
            Parameter { key: "sin_deg", unit: Unit::Degree, prior_sigma: 0.02 },],
        needs: &[],
        deflects: true,
        bends: false,
        of_data: false,
        shown_against: Shown::Angle,
        search: Search::PLAIN,
    };

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let (sine, cosine) = (S::constant(site.periods()) * state.commanded[site.index]).sin_cos();
        deflection.joints[site.index] += p[0] * cosine + p[1] * sine;
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "{} runs fast and slow by {}°, {} times a revolution (eccentric gear or encoder)",
            joint(effect),
            deg(length(&effect.parameters[..2])),
            effect.site.periods()
        )
    }
}
