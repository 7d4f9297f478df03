//! Lengths that grow with temperature.

use super::definition::{Definition, Need, Parameter, Unit};
use super::search::{List, Search, Sets, Shown};
use super::words::mm;
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::{Scalar, sub};

/// All lengths of the arm from the base to the last link grow alike, so that the flange moves away from the base's origin.
pub(super) struct ThermalGrowth;

impl Equation for ThermalGrowth {
    const DEFINITION: Definition = Definition {
        id: "thermal_growth",
        summary: "the arm is longer when it is warm: all its lengths grow alike with temperature",
        equation: "a, d = (1 + per_k · (T − reference_c)) · a, d: the last link's origin moves by \
            that part of its distance from the base",
        source: "linear thermal expansion; 2.3e-5 /K for aluminium, 1.2e-5 /K for steel",
        site: &[],
        parameters: &[
            Parameter { key: "per_k", unit: Unit::PerKelvin, prior_sigma: 2e-5 },
            Parameter { key: "reference_c", unit: Unit::Celsius, prior_sigma: 20.0 },
        ],
        needs: &[Need::Temperature],
        deflects: true,
        bends: true,
        of_data: false,
        shown_against: Shown::Temperature,
        search: Search {
            held: true,
            never_negative: &[0],
            sets: Sets::At(1, List::Temperatures),
            ..Search::PLAIN
        },
    };
    // four times aluminium
    const LARGEST: &'static [(&'static str, f64)] = &[("per_k", 1e-4)];
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let (Some(frames), Some(temperature)) = (state.frames, state.conditions.temperature_c) else {
            return;
        };
        let part = p[0] * (S::constant(temperature) - p[1]);
        let reach = sub(frames.links[5].translation, frames.base.translation);
        for k in 0..3 {
            deflection.world[k] += part * reach[k];
        }
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!("The arm grows with temperature: {} mm a metre in 10 K", mm(10.0 * effect.parameters[0]))
    }
}
