//! From which side a linear axis comes.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{LAGS, axis, mm};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::Scalar;

/// Half the width in the direction of the last motion; nothing where that is not known.
pub(super) struct TrackBacklash;

impl Equation for TrackBacklash {
    const DEFINITION: Definition = Definition {
        id: "track_backlash",
        summary: "a linear axis stands elsewhere when it comes from the other side",
        equation: "half of width_mm along the rail in the direction of the last motion",
        source: "J. Kleinkes, W. Neddermeyer, M. Schnell, \"Improved method for highly accurate \
            integration of track motions\", SciTePress (2006), as polynomials of the travel",
        site: &[SiteKey::Axis],
        parameters: &[
            Parameter { key: "width_mm", unit: Unit::Millimetre, prior_sigma: 0.05 },
        ],
        needs: &[Need::ExternalDirections],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Order,
        search: Search::PLAIN,
    };
    const READS_ANGLES: bool = false;

    fn carry<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], at: &AxisState<S>, error: &mut AxisError<S>) {
        error.offset[0] += p[0] * S::constant(0.5 * at.direction);
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        if effect.parameters[0] < 0.0 {
            format!("{} loses {} mm when it reverses", axis(effect), mm(-effect.parameters[0]))
        } else {
            format!("{} runs {} mm ahead when it reverses{LAGS}", axis(effect), mm(effect.parameters[0]))
        }
    }
}
