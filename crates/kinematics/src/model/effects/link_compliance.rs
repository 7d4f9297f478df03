//! Bending of a link.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{deg, largest};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// A link, and everything behind it, rotates about x and y of its frame in proportion to the moment it carries.
pub(super) struct LinkCompliance;

impl Equation for LinkCompliance {
    const DEFINITION: Definition = Definition {
        id: "link_compliance",
        summary: "a link or its bearing bends under the moment it carries, across the axis of its \
            joint",
        equation: "rotation about x of the link's frame = x_rad_per_n_m · M_x, about y = y_rad_per_n_m \
            · M_y, M the moment about the frame's origin in its axes",
        source: "A. Nubiola, thesis, eqs. I.5–I.10, with the components of the moment that are not \
            the joint's torque",
        site: &[SiteKey::Link],
        parameters: &[
            Parameter { key: "x_rad_per_n_m", unit: Unit::RadPerNm, prior_sigma: 2e-5 },
            Parameter { key: "y_rad_per_n_m", unit: Unit::RadPerNm, prior_sigma: 2e-5 },
        ],
        needs: &[Need::Masses],
        deflects: true,
        bends: true,
        of_data: false,
        shown_against: Shown::Torque(None),
        search: Search::BENDING,
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let Some(frames) = state.frames else { return };
        let moment = frames.links[site.index].rotation.transpose() * frames.moments[site.index];
        deflection.links[site.index][0] += p[0] * moment[0];
        deflection.links[site.index][1] += p[1] * moment[1];
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!("Link {} bends: {}° at most under 100 N m", effect.site.index + 1, deg(100.0 * largest(&effect.parameters[..2])))
    }
}
