//! What repeats along a rail.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{axis, length, mm};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::Scalar;

/// Zero in the middle of the rail, where `base_frame` stands for the constant part.
pub(super) struct TrackRipple;

impl Equation for TrackRipple {
    const DEFINITION: Definition = Definition {
        id: "track_ripple",
        summary: "the error of a linear axis repeats with the pitch of its rack or the segments of \
            its rail",
        equation: "cos · (cos(2π travel / period) − 1) + sin · sin(2π travel / period) along x, y \
            or z of the rail",
        source: "J. Kleinkes, W. Neddermeyer, M. Schnell, \"Improved method for highly accurate \
            integration of track motions\", SciTePress (2006), as polynomials of the travel",
        site: &[SiteKey::Axis, SiteKey::Along("xyz"), SiteKey::Period],
        parameters: &[
            Parameter { key: "cos_mm", unit: Unit::Millimetre, prior_sigma: 0.05 },
            Parameter { key: "sin_mm", unit: Unit::Millimetre, prior_sigma: 0.05 },
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
        let turns = S::constant(std::f64::consts::TAU / site.period_m());
        let (sine, cosine) = (turns * at.moved).sin_cos();
        error.offset[site.on] += p[0] * (cosine - S::one()) + p[1] * sine;
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "The error of {} repeats every {} mm, by {} mm",
            axis(effect),
            mm(effect.site.period_m()),
            mm(length(&effect.parameters[..2]))
        )
    }
}
