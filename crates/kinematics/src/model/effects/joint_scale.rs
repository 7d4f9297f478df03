//! A joint that turns in proportion to its command, but not one to one.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{deg, joint, too};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::units::DEG;
use crate::geometry::Scalar;

/// a joint rotates more or less than commanded, in proportion.
pub(super) struct JointScale;

impl Equation for JointScale {
    const DEFINITION: Definition = Definition {
        id: "joint_scale",
        summary: "a joint rotates more or less than commanded, in proportion",
        equation: "δq = ratio · q",
        source: "A. Nubiola, thesis, level-1 models",
        site: &[SiteKey::Joint],
        parameters: &[Parameter { key: "ratio", unit: Unit::Ratio, prior_sigma: 5e-4 }],
        needs: &[],
        deflects: true,
        bends: false,
        of_data: false,
        shown_against: Shown::Angle,
        search: Search::PLAIN,
    };
    // 2 degrees in a whole rotation
    const LARGEST: &'static [(&'static str, f64)] = &[("ratio", 2.0 / 360.0)];

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        deflection.joints[site.index] += p[0] * state.commanded[site.index];
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        let ratio = effect.parameters[0];
        format!("{} rotates {}° too {} in 90°", joint(effect), deg(ratio.abs() * 90.0 * DEG), too(ratio))
    }
}
