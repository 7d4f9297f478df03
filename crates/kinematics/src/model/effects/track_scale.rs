//! How far a linear axis goes.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{axis, mm, too};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::Scalar;

/// Travel counted from the middle of the axis’ limits, times a ratio.
pub(super) struct TrackScale;

impl Equation for TrackScale {
    const DEFINITION: Definition = Definition {
        id: "track_scale",
        summary: "a linear axis goes farther or less far than commanded",
        equation: "travel · (1 + ratio), counted from the middle of its limits",
        source: "J. Kleinkes, W. Neddermeyer, M. Schnell, \"Improved method for highly accurate \
            integration of track motions\", SciTePress (2006), as polynomials of the travel",
        site: &[SiteKey::Axis],
        parameters: &[
            Parameter { key: "ratio", unit: Unit::Ratio, prior_sigma: 1e-4 },
        ],
        needs: &[],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Order,
        search: Search::PLAIN,
    };
    const READS_ANGLES: bool = false;
    const LARGEST: &'static [(&'static str, f64)] = &[("ratio", 0.01)];

    fn carry<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], _: &AxisState<S>, error: &mut AxisError<S>) {
        error.scale += p[0];
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        let ratio = effect.parameters[0];
        format!("{} goes {} mm too {} in a metre", axis(effect), mm(ratio.abs()), too(ratio))
    }
}
