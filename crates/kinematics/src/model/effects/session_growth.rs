//! Lengths that grow in the course of a session of which nobody wrote down the temperature.

use super::definition::{Definition, Need, Parameter, Unit};
use super::search::{List, Search, Sets, Shown};
use super::words::{digits, gone, pace};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::{Scalar, sub};

/// All lengths of the arm grow with the row number, exponentially; they are those of the profile in the middle of the
/// session. An effect of the data.
pub(super) struct SessionGrowth;

impl Equation for SessionGrowth {
    const DEFINITION: Definition = Definition {
        id: "session_growth",
        summary: "the arm grows from row to row, all its lengths alike, as one that warms up (an \
            effect of the data)",
        equation: "a, d = (1 + ppm · 1e-6 · (exp(−rows / 2 / constant_rows) − exp(−row / \
            constant_rows))) · a, d: the last link's origin moves by that part of its distance \
            from the base",
        source: "linear thermal expansion; first-order heating (Newton's law of cooling), rows \
            read at an even pace",
        site: &[],
        parameters: &[
            Parameter { key: "ppm", unit: Unit::Ppm, prior_sigma: 100.0 },
            Parameter { key: "constant_rows", unit: Unit::Row, prior_sigma: 100.0 },
        ],
        needs: &[Need::NoTemperature],
        deflects: true,
        bends: true,
        of_data: true,
        shown_against: Shown::Order,
        search: Search {
            or_of_device: true,
            sets: Sets::At(1, List::Rows),
            ..Search::PLAIN
        },
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let (Some(frames), Some(row)) = (state.frames, state.conditions.row) else {
            return;
        };
        let at = |row: f64| gone(row, p[1]);
        let part = p[0] * (at(f64::from(row)) - at(0.5 * f64::from(state.conditions.rows)));
        let reach = sub(frames.links[5].translation, frames.base.translation);
        for k in 0..3 {
            deflection.world[k] += part * reach[k];
        }
    }

    fn sentence(effect: &Effect, seen: &Seen) -> String {
        let (rows, all) = (effect.parameters[1], seen.rows as f64);
        // what it reaches by the last row, not what it would reach
        let ppm = 1e6 * effect.parameters[0] * gone(all, rows);
        let does = if ppm < 0.0 { "shrinks" } else { "grows" };
        format!(
            "The arm {does} by {} ppm in the course of the session, {}: temperature_c would show why",
            digits(ppm.abs()),
            pace(rows, all)
        )
    }
}
