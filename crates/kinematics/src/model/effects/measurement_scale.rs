//! A measuring device whose lengths are too long or too short.

use super::definition::{Definition, Need, Parameter, Unit};
use super::search::{Search, Shown};
use super::words::digits;
use super::{Deflection, Effect, Equation, Kind, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// The device sees everything farther away from its origin than it is, and a distance from where it is read. An effect of
/// the data, not of the robot.
pub(super) struct MeasurementScale;

impl Equation for MeasurementScale {
    const DEFINITION: Definition = Definition {
        id: "measurement_scale",
        summary: "the measuring device's lengths are wrong in proportion: refraction, a scale bar, \
            a frequency (an effect of the data)",
        equation: "measured place = (1 + ppm · 1e-6) · place in the device's frame",
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
            let from = S::constant(state.conditions.device_m[k]);
            deflection.world[k] += p[0] * (frames.tool.translation[k] - from);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Conditions, Model, example};

    #[test]
    fn lengths_are_too_long_from_the_device() {
        let effect = Effect {
            kind: Kind::MeasurementScale,
            site: Site::default(),
            parameters: [2e-4, 0.0, 0.0, 0.0, 0.0, 0.0],
        };
        let q = [0.3, -0.4, 0.5, 0.6, -0.7, 0.8];
        let seen = |effects: &[Effect], device_m| {
            let conditions = Conditions { device_m, ..Conditions::default() };
            let (geometry, mechanism) = (example::geometry(), example::mechanism());
            let model = Model::build(&geometry, &mechanism, effects, &conditions);
            model.forward(&q, &conditions).translation
        };
        let place = seen(&[], [0.0; 3]);
        // a device that stands 3 m in front of the tool and 1 m below it
        let device = [place[0] + 3.0, place[1], place[2] - 1.0];
        let far = seen(std::slice::from_ref(&effect), device);
        let shift = [-6e-4, 0.0, 2e-4];
        for k in 0..3 {
            assert!((far[k] - place[k] - shift[k]).abs() < 1e-12, "{k}");
            let at_origin = seen(std::slice::from_ref(&effect), [0.0; 3])[k];
            assert!((at_origin - (1.0 + 2e-4) * place[k]).abs() < 1e-12, "{k}");
        }
    }
}
