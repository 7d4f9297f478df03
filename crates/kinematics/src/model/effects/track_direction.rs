//! In which direction a linear axis runs.

use super::definition::{Definition, Parameter, SiteKey, Unit};
use super::search::{EITHER, Search, Shown};
use super::words::{axis, deg, length};
use super::{AxisError, AxisState, Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::Scalar;

/// Pitch (about y) and yaw (about z) of the rail.
pub(super) struct TrackDirection;

impl Equation for TrackDirection {
    const DEFINITION: Definition = Definition {
        id: "track_direction",
        summary: "a linear axis runs in another direction than the controller has it",
        equation: "travel along Ry(y) · Rz(z) · x of the rail; z is up, y = z × x",
        source: "J. Kleinkes, W. Neddermeyer, M. Schnell, \"Improved method for highly accurate \
            integration of track motions\", SciTePress (2006), as polynomials of the travel",
        site: &[SiteKey::Axis],
        parameters: &[
            Parameter { key: "y_deg", unit: Unit::Degree, prior_sigma: 0.05 },
            Parameter { key: "z_deg", unit: Unit::Degree, prior_sigma: 0.05 },
        ],
        needs: &[],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Order,
        search: Search {
            sets: EITHER,
            ..Search::PLAIN
        },
    };
    const READS_ANGLES: bool = false;

    fn carry<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], _: &AxisState<S>, error: &mut AxisError<S>) {
        for k in 0..2 {
            error.direction[k] += p[k];
        }
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!("{} runs {}° off the direction of the profile", axis(effect), deg(length(&effect.parameters[..2])))
    }
}
