//! What is hidden in a robot: effects of every kind, of typical proportions.

use super::Start;
use poseshift::model::effects::{BASE, Effect, Kind, MOST_PARAMETERS, Need, Site, SiteKey, of_arm};
use rand::RngExt;
use rand::rngs::StdRng;

fn sign(random: &mut StdRng) -> f64 {
    if random.random_range(0..2) == 0 {
        1.0
    } else {
        -1.0
    }
}

/// A hidden effect of this kind with values of typical proportions.
pub fn hidden(
    kind: Kind,
    rows: usize,
    length_s: f64,
    torques: &[f64; 6],
    random: &mut StdRng,
) -> Effect {
    let definition = kind.definition();
    let mut site = Site {
        order: 1,
        ..Site::default()
    };
    for place in definition.site {
        match place {
            SiteKey::Link if kind == Kind::LinkGeometry => site.index = random.random_range(1..5),
            SiteKey::Link | SiteKey::Joint => site.index = random.random_range(0..6),
            SiteKey::JointOrBase => site.index = random.random_range(0..=BASE),
            SiteKey::On => {
                while site.on == site.index {
                    site.on = random.random_range(0..6);
                }
            }
            SiteKey::Order => site.order = place.one() * random.random_range(1..5),
            SiteKey::Row => {
                site.order =
                    u32::try_from(random.random_range(rows / 5..rows * 4 / 5)).expect("small");
            }
            SiteKey::Tool => {}
            other => unreachable!("an effect of the arm has no {}", other.key()),
        }
    }
    if definition.needs_masses() && definition.site.contains(&SiteKey::Joint) {
        // a joint that carries a torque
        while torques[site.index] < 0.02 * torques.iter().fold(0.0, |m, t| f64::max(m, *t)) {
            site.index = random.random_range(0..6);
        }
    }
    let mut p = [0.0; MOST_PARAMETERS];
    for (value, parameter) in p.iter_mut().zip(definition.parameters) {
        *value = parameter.prior_sigma
            * parameter.unit.in_si()
            * random.random_range(0.3..1.0)
            * sign(random);
    }
    match kind {
        Kind::LinkGeometry => {
            // one of the parameters that no neighbour can stand for
            let which = [0, 1, 3][random.random_range(0..3)];
            (0..5).filter(|k| *k != which).for_each(|k| p[k] = 0.0);
        }
        Kind::JointCompliance
        | Kind::LinkCompliance
        | Kind::BaseCompliance
        | Kind::ToolCompliance => p = p.map(f64::abs),
        Kind::ComplianceKnee => {
            p = [
                random.random_range(0.1..0.4) * torques[site.index],
                p[1].abs(),
                0.0,
                0.0,
                0.0,
                0.0,
            ];
        }
        Kind::ThermalGrowth => p = [p[0].abs(), 20.0, 0.0, 0.0, 0.0, 0.0],
        Kind::WarmUpDrift => {
            p[4] = random.random_range(0.1..0.5) * length_s;
            if site.index == BASE {
                p[0] = 0.0;
            } else {
                p[1..4].fill(0.0);
            }
        }
        Kind::PayloadError => p = [p[0].abs(), 0.3 * p[1], 0.3 * p[2], 0.3 * p[3], 0.0, 0.0],
        _ => {}
    }
    Effect {
        kind,
        site,
        parameters: p,
    }
}

/// Parameters that scale with the size of an effect: not torques, temperatures, times.
pub fn scaled(effect: &Effect, by: f64) -> Effect {
    let fixed: &[usize] = match effect.kind {
        Kind::ComplianceKnee => &[0],
        Kind::ThermalGrowth => &[1],
        Kind::WarmUpDrift => &[4],
        _ => &[],
    };
    let mut scaled = effect.clone();
    for (k, p) in scaled.parameters.iter_mut().enumerate() {
        if !fixed.contains(&k) {
            *p *= by;
        }
    }
    scaled
}

/// Kinds that may be hidden: all, but those that are fitted anew where the start is a drawing.
pub fn kinds(start: Start) -> Vec<Kind> {
    // what frames, geometry and compliance that are fitted along do: the length of every link with
    // that of the device, too
    let absorbed = [
        Kind::BaseFrame,
        Kind::ToolFrame,
        Kind::LinkGeometry,
        Kind::JointCompliance,
        Kind::MeasurementScale,
    ];
    of_arm()
        .filter(|k| start != Start::Nominal || !absorbed.contains(k))
        // cases have a clock and a thermometer, and no names of points
        .filter(|k| {
            let needs = k.definition().needs;
            [Need::NoTime, Need::NoTemperature, Need::Points]
                .iter()
                .all(|n| !needs.contains(n))
        })
        .collect()
}
