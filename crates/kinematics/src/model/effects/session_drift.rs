//! Drift in the course of a session of which nobody wrote down the time.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{List, Search, Sets, Shown};
use super::words::{deg, gone, joint, length, mm, pace};
use super::{BASE, Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// A joint or the base moves with the row number to its last place, exponentially. An effect of the data.
pub(super) struct SessionDrift;

impl Equation for SessionDrift {
    const DEFINITION: Definition = Definition {
        id: "session_drift",
        summary: "a joint drifts from row to row; without `joint` the base or the device does (an \
            effect of the data)",
        equation: "δq = angle_deg · (1 − exp(−row / constant_rows)); the base by (x_mm, y_mm, \
            z_mm) along the world's axes likewise",
        source: "first-order heating (Newton's law of cooling), rows read at an even pace",
        site: &[SiteKey::JointOrBase],
        parameters: &[
            Parameter { key: "angle_deg", unit: Unit::Degree, prior_sigma: 0.02 },
            Parameter { key: "x_mm", unit: Unit::Millimetre, prior_sigma: 0.1 },
            Parameter { key: "y_mm", unit: Unit::Millimetre, prior_sigma: 0.1 },
            Parameter { key: "z_mm", unit: Unit::Millimetre, prior_sigma: 0.1 },
            Parameter { key: "constant_rows", unit: Unit::Row, prior_sigma: 100.0 },
        ],
        needs: &[Need::NoTime],
        deflects: true,
        bends: true,
        of_data: true,
        shown_against: Shown::Order,
        search: Search {
            sets: Sets::At(4, List::Rows),
            ..Search::PLAIN
        },
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let Some(row) = state.conditions.row else { return };
        let gone = gone(f64::from(row), p[4]);
        if let Some(joint) = deflection.joints.get_mut(site.index) {
            *joint += p[0] * gone;
        }
        for k in 0..3 {
            deflection.world[k] += p[1 + k] * gone;
        }
    }

    fn sentence(effect: &Effect, seen: &Seen) -> String {
        let (rows, all) = (effect.parameters[4], seen.rows as f64);
        // what it reaches by the last row, not what it would reach
        let part = gone(all, rows);
        let (what, by) = if effect.site.index == BASE {
            ("The base or the measuring device".to_owned(), mm(part * length(&effect.parameters[1..4])) + " mm")
        } else {
            (joint(effect), deg(part * effect.parameters[0]) + "°")
        };
        format!("{what} drifts by {by} in the course of the session, {}", pace(rows, all))
    }
}
