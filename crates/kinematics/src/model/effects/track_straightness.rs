//! How a rail is bent.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{axis, mm};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site, power};
use crate::geometry::Scalar;

/// A power of the place on the rail; degree 1 is `track_direction`, degree 0 `base_frame`.
pub(super) struct TrackStraightness;

impl Equation for TrackStraightness {
    const DEFINITION: Definition = Definition {
        id: "track_straightness",
        summary: "a linear axis is bent",
        equation: "mm · sⁿ along y or z of the rail, n the degree, s from −1 to 1 over the axis’ \
            limits",
        source: "J. Kleinkes, W. Neddermeyer, M. Schnell, \"Improved method for highly accurate \
            integration of track motions\", SciTePress (2006), as polynomials of the travel",
        site: &[SiteKey::Axis, SiteKey::Along("yz"), SiteKey::Degree(2, 6)],
        parameters: &[
            Parameter { key: "mm", unit: Unit::Millimetre, prior_sigma: 0.3 },
        ],
        needs: &[],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Order,
        search: Search::PLAIN,
    };
    const READS_ANGLES: bool = false;

    fn carry<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], at: &AxisState<S>, error: &mut AxisError<S>) {
        error.offset[site.on] += p[0] * power(at.part, site.order);
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!("{} is bent by {} mm at its ends", axis(effect), mm(effect.parameters[0]))
    }
}
