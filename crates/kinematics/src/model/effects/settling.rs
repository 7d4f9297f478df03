//! A joint that is read before it has come to rest.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{Search, Shown};
use super::words::{digits, joint};
use super::{Deflection, Effect, Equation, Kind, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::Scalar;

/// A part of the joint's last move is still missing when it is read.
pub(super) struct Settling;

impl Equation for Settling {
    const DEFINITION: Definition = Definition {
        id: "settling",
        summary: "a joint is read before it has come to rest: a part of its last move is still \
            missing (negative: it has gone too far)",
        equation: "δq = −share · (q − q before), the angles of the row and of the posture before \
            it",
        source: "creep of a first-order lag: A. Ruderman, F. Hoffmann, T. Bertram, \"Modeling and \
            identification of elastic robot joints with hysteresis and backlash\" (2009)",
        site: &[SiteKey::Joint],
        parameters: &[Parameter { key: "share", unit: Unit::Ratio, prior_sigma: 2e-4 }],
        needs: &[Need::Moves],
        deflects: true,
        bends: false,
        of_data: false,
        shown_against: Shown::Move,
        search: Search {
            rare: true,
            alternatives: &[Kind::Backlash, Kind::FrictionBacklash],
            ..Search::PLAIN
        },
    };
    // the whole move
    const LARGEST: &'static [(&'static str, f64)] = &[("share", 1.0)];
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let moved = S::constant(-state.conditions.moved[site.index]);
        deflection.joints[site.index] += moved * p[0];
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!(
            "{} is read before it rests: {} % of its last move {}",
            joint(effect),
            digits(100.0 * effect.parameters[0].abs()),
            if effect.parameters[0] < 0.0 { "too far" } else { "is missing" }
        )
    }
}
