//! Drift while the robot warms up.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{List, Search, Sets, Shown};
use super::words::{deg, joint, length, mm};
use super::{BASE, Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// A joint or the base moves to its warm place, exponentially. Time counts from when the robot, cold
/// until then, was switched on; without a time it is cold.
pub(super) struct WarmUpDrift;

/// Shorter time constants count as this, seconds.
const SHORTEST_S: f64 = 1.0;

impl Equation for WarmUpDrift {
    const DEFINITION: Definition = Definition {
        id: "warm_up_drift",
        summary: "a joint drifts to its warm place while the robot warms up; without `joint` the \
            base does",
        equation: "δq = angle_deg · (1 − exp(−time_s / time_constant_s)); the base by (x_mm, y_mm, \
            z_mm) along the world's axes likewise",
        source: "first-order heating (Newton's law of cooling)",
        site: &[SiteKey::JointOrBase],
        parameters: &[
            Parameter { key: "angle_deg", unit: Unit::Degree, prior_sigma: 0.02 },
            Parameter { key: "x_mm", unit: Unit::Millimetre, prior_sigma: 0.1 },
            Parameter { key: "y_mm", unit: Unit::Millimetre, prior_sigma: 0.1 },
            Parameter { key: "z_mm", unit: Unit::Millimetre, prior_sigma: 0.1 },
            Parameter { key: "time_constant_s", unit: Unit::Second, prior_sigma: 1800.0 },
        ],
        needs: &[Need::Time],
        deflects: true,
        bends: true,
        of_data: false,
        shown_against: Shown::Time,
        search: Search {
            held: true,
            or_of_device: true,
            sets: Sets::At(4, List::Times),
            ..Search::PLAIN
        },
    };
    // four months
    const LARGEST: &'static [(&'static str, f64)] = &[("time_constant_s", 1e7)];
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let Some(time) = state.conditions.time_s else { return };
        let constant = p[4].max(S::constant(SHORTEST_S));
        let warm = S::one() - (S::constant(-time.max(0.0)) / constant).exp();
        if let Some(joint) = deflection.joints.get_mut(site.index) {
            *joint += p[0] * warm;
        }
        for k in 0..3 {
            deflection.world[k] += p[1 + k] * warm;
        }
    }

    fn sentence(effect: &Effect, seen: &Seen) -> String {
        let (constant, all) = (effect.parameters[4], seen.seconds);
        // what it reaches in the session, not what it would reach
        let part = if all > 0.0 { 1.0 - (-all / constant.max(SHORTEST_S)).exp() } else { 1.0 };
        let (what, by) = if effect.site.index == BASE {
            ("The base".to_owned(), mm(part * length(&effect.parameters[1..4])) + " mm")
        } else {
            (joint(effect), deg(part * effect.parameters[0]) + "°")
        };
        let when = if all > 0.0 && constant >= all {
            "about evenly in the session".to_owned()
        } else {
            format!("in some {:.0} min", constant / 60.0)
        };
        format!("{what} drifts by {by} while it warms up, {when}")
    }
}
