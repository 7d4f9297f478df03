//! A measuring device whose lengths are too long or too short.

use super::definition::{Definition, Need, Parameter, Unit};
use super::search::{Search, Shown};
use super::words::digits;
use super::{Deflection, Effect, Equation, Kind, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// The device sees everything farther away from its origin than it is. An effect of the data, not of the robot.
pub(super) struct MeasurementScale;

impl Equation for MeasurementScale {
    const DEFINITION: Definition = Definition {
        id: "measurement_scale",
        summary: "the measuring device's lengths are wrong in proportion: refraction, a scale bar, \
            a frequency (an effect of the data)",
        equation: "measured place = (1 + ppm · 1e-6) · place in the frame of the measurements",
        source: "ISO 10360-10, range error of laser trackers; refraction of air: P. E. Ciddor \
            (1996)",
        site: &[],
        parameters: &[Parameter { key: "ppm", unit: Unit::Ppm, prior_sigma: 50.0 }],
        needs: &[Need::Places],
        deflects: true,
        bends: true,
        of_data: true,
        shown_against: Shown::Order,
        search: Search {
            rare: true,
            alternatives: &[Kind::ThermalGrowth],
            ..Search::PLAIN
        },
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let Some(frames) = state.frames else { return };
        for k in 0..3 {
            deflection.world[k] += p[0] * frames.tool.translation[k];
        }
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "The measuring device's lengths are {} ppm too {}",
            digits(1e6 * effect.parameters[0].abs()),
            if effect.parameters[0] < 0.0 { "short" } else { "long" }
        )
    }
}
