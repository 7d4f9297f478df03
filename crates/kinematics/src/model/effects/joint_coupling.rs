//! A joint that another one rotates along.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{deg, joint};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::units::DEG;
use crate::geometry::Scalar;

/// motion of one joint leaks into another.
pub(super) struct JointCoupling;

impl Equation for JointCoupling {
    const DEFINITION: Definition = Definition {
        id: "joint_coupling",
        summary: "motion of one joint leaks into another",
        equation: "δq(joint) = ratio · q(on)",
        source: "A. Nubiola, thesis, ch. 1 (wrist gearing)",
        site: &[SiteKey::Joint, SiteKey::On],
        parameters: &[Parameter { key: "ratio", unit: Unit::Ratio, prior_sigma: 5e-4 }],
        needs: &[],
        deflects: true,
        bends: false,
        of_data: false,
        shown_against: Shown::OtherAngle,
        search: Search {
            rare: true,
            ..Search::PLAIN
        },
    };
    // 2 degrees in a whole rotation
    const LARGEST: &'static [(&'static str, f64)] = &[("ratio", 2.0 / 360.0)];

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        deflection.joints[site.index] += p[0] * state.commanded[site.on];
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "{} is taken along by J{}: {}° in 90°",
            joint(effect),
            effect.site.on + 1,
            deg(effect.parameters[0] * 90.0 * DEG)
        )
    }
}
