//! Manufacturing and assembly errors of one link.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Sets, Shown};
use super::{Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::Scalar;
use crate::model::{Conditions, Geometry};

/// Deviations of one row of the chain; θ is the joint's zero offset in the sense of the chain.
pub(super) struct LinkGeometry;

impl Equation for LinkGeometry {
    const DEFINITION: Definition = Definition {
        id: "link_geometry",
        summary: "one link is longer, twisted or mounted at another angle than drawn; theta is the \
            joint offset",
        equation: "A = Rx(α + alpha) · Trans(a + a) · Ry(beta) · Rz(θ + theta + q) · Trans(0, 0, d \
            + d)",
        source: "J. J. Craig (modified Denavit–Hartenberg); S. Hayati (1985) for beta; A. Nubiola, \
            thesis, Annex I",
        site: &[SiteKey::Link],
        parameters: &[
            Parameter { key: "alpha_deg", unit: Unit::Degree, prior_sigma: 0.1 },
            Parameter { key: "a_mm", unit: Unit::Millimetre, prior_sigma: 0.5 },
            Parameter { key: "beta_deg", unit: Unit::Degree, prior_sigma: 0.1 },
            Parameter { key: "theta_deg", unit: Unit::Degree, prior_sigma: 0.3 },
            Parameter { key: "d_mm", unit: Unit::Millimetre, prior_sigma: 0.5 },
        ],
        needs: &[],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Angle,
        search: Search {
            sets: Sets::Minimal,
            ..Search::PLAIN
        },
    };

    fn change_geometry<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], _: &Conditions, geometry: &mut Geometry<S>) {
        let link = &mut geometry.links[site.index];
        link.alpha_rad += p[0];
        link.a_m += p[1];
        link.beta_rad += p[2];
        link.theta_rad += p[3];
        link.d_m += p[4];
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!("Link {} differs from the profile", effect.site.index + 1)
    }
}
