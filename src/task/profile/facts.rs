//! A profile in words and numbers.

use super::details::details;
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::external::{Coordinates, Follows};
use crate::model::profile::{ControllerModel, Mounted, Profile};
use crate::model::{Conditions, Model};
use schemars::JsonSchema;
use serde::Serialize;

/// How far a robot's real tool is from where its controller believes it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Deviation {
    /// Mean distance, mm.
    pub mean_mm: f64,
    /// Largest distance, mm.
    pub max_mm: f64,
    /// How many postures were looked at.
    pub postures: usize,
}

/// Everything a profile says, one name and value a fact, lengths in mm and angles in degrees.
#[must_use]
pub(super) fn facts(profile: &Profile) -> Vec<(String, String)> {
    let mut facts: Vec<(String, String)> = Vec::new();
    let mut fact = |name: String, value: String| facts.push((name, value));
    fact(
        "robot".into(),
        format!("{} {}", profile.manufacturer, profile.model),
    );
    fact("serial".into(), profile.serial.clone().unwrap_or_default());
    let controller = match profile.controller {
        ControllerModel::Nominal => "nominal",
        ControllerModel::Calibrated => "calibrated",
    };
    fact(
        "controller".into(),
        format!(
            "{} {controller}",
            profile.language.as_deref().unwrap_or("-")
        ),
    );
    fact("base".into(), pose(&profile.world_from_base));
    if let Some(device) = &profile.device {
        fact("world_from_device".into(), pose(&device.world_from_device));
    }
    for (i, (link, joint)) in profile
        .links
        .iter()
        .zip(&profile.mechanism.joints)
        .enumerate()
    {
        let sign = if joint.sign < 0.0 { " sign -1" } else { "" };
        let offset = if joint.offset_rad == 0.0 {
            String::new()
        } else {
            format!(" offset {}", number(joint.offset_rad / DEG))
        };
        let value = format!(
            "alpha {} a {} theta {} d {} from {} to {}{sign}{offset}",
            number(link.alpha_rad / DEG),
            number(mm_from_m(link.a_m)),
            number(link.theta_rad / DEG),
            number(mm_from_m(link.d_m)),
            number(joint.min_rad / DEG),
            number(joint.max_rad / DEG),
        );
        fact(format!("joint {}", i + 1), value);
    }
    for c in &profile.mechanism.coupling {
        fact(
            format!("coupling {} on {}", c.joint + 1, c.on + 1),
            number(c.ratio),
        );
    }
    fact("flange".into(), pose(&profile.link6_from_flange));
    for (i, body) in profile.bodies.iter().enumerate() {
        fact(
            format!("body {}", i + 1),
            format!(
                "link {}: {} kg at {}",
                body.link + 1,
                number(body.mass_kg),
                triple(body.cog_m)
            ),
        );
    }
    fact("gravity".into(), profile.gravity_m_s2.map(number).join(" "));
    external(profile, &mut fact);
    details(profile, &mut fact);
    for (name, tool) in &profile.tools {
        let load = tool.load.map_or_else(String::new, |(kg, cog)| {
            format!(", {} kg at {}", number(kg), triple(cog))
        });
        fact(format!("tool {name}"), pose(&tool.flange_from_tool) + &load);
    }
    for (name, point) in &profile.points {
        fact(format!("point {name}"), triple(*point));
    }
    let own = profile.own_effects.iter().flatten();
    let of_controller = own.map(|effect| ("controller effect", effect));
    let of_arm = profile.effects.iter().map(|effect| ("effect", effect));
    for (whose, effect) in of_controller.chain(of_arm) {
        let units = effect
            .definition()
            .parameters
            .iter()
            .zip(effect.parameters)
            .filter(|(_, value)| *value != 0.0);
        let values =
            units.map(|(p, value)| format!("{} {}", p.key, number(value / p.unit.in_si())));
        fact(
            format!("{whose} {}", effect.label()),
            values.collect::<Vec<_>>().join(" "),
        );
    }
    facts
}

/// What stands around the arm and moves.
fn external(profile: &Profile, fact: &mut impl FnMut(String, String)) {
    let axes = &profile.external;
    for axis in &axes.track {
        let [zero, min, max] = [axis.zero_m, axis.min_m, axis.max_m].map(|m| number(mm_from_m(m)));
        let along = axis.direction.map(number).join(" ");
        let relative = match axis.coordinates {
            Coordinates::World => "",
            Coordinates::Base => " in the base's coordinates",
        };
        fact(
            format!("external axis {}", axis.axis),
            format!("track along ({along}) zero {zero} from {min} to {max}{relative}"),
        );
        fact(
            format!("up of {}", axis.axis),
            axis.up.map(number).join(" "),
        );
        if let Some(pulses) = axis.pulses_per_mm {
            fact(format!("pulses_per_mm of {}", axis.axis), number(pulses));
        }
    }
    for positioner in &axes.positioners {
        for axis in &positioner.axes {
            let angles = [axis.zero_rad, axis.min_rad, axis.max_rad];
            let [zero, min, max] = angles.map(|a| number(a / DEG));
            let sense = if axis.sign < 0.0 { " sign -1" } else { "" };
            let (name, at) = (&positioner.name, pose(&axis.at));
            fact(
                format!("external axis {}", axis.axis),
                format!("positioner {name} at {at} zero {zero} from {min} to {max}{sense}"),
            );
            if let Some(pulses) = axis.pulses_per_deg {
                fact(format!("pulses_per_deg of {}", axis.axis), number(pulses));
            }
        }
        let follows = match positioner.follows {
            Follows::Frame => "frame",
            Follows::Always => "always",
            Follows::Never => "never",
        };
        let (name, plate) = (&positioner.name, pose(&positioner.plate));
        fact(
            format!("positioner {name}"),
            format!("follows {follows}, plate at {plate}"),
        );
        for (point, place) in &positioner.points {
            fact(format!("positioner {name} point {point}"), triple(*place));
        }
    }
    for name in &axes.other {
        fact(format!("external axis {name}"), "carries nothing".into());
    }
}

/// Mean and largest distance between the real and the controller's tool over an even grid of
/// postures.
#[must_use]
pub(super) fn typical_deviation(profile: &Profile) -> Deviation {
    let (tool, conditions) = (first_tool(profile), Conditions::default());
    deviation(
        profile,
        &profile.real_model(&tool, &conditions),
        &profile.controller_model(&tool),
        &conditions,
    )
}

/// Mean and largest distance between the tools of two controllers of one type of arm over an even
/// grid of postures.
#[must_use]
pub(super) fn typical_deviation_of(a: &Profile, b: &Profile) -> Deviation {
    let tool = first_tool(a);
    let models = (a.controller_model(&tool), b.controller_model(&tool));
    deviation(a, &models.0, &models.1, &Conditions::default())
}

pub(super) fn first_tool(profile: &Profile) -> Mounted {
    let name = profile.tools.keys().next();
    name.and_then(|name| profile.tool(name))
        .unwrap_or_else(Mounted::flange)
}

pub(super) fn deviation(
    profile: &Profile,
    a: &Model,
    b: &Model,
    conditions: &Conditions,
) -> Deviation {
    /// Postures: enough for two digits of the mean.
    const POSTURES: u32 = 1000;
    let distances: Vec<f64> = (1..=POSTURES)
        .map(|n| {
            let q = std::array::from_fn(|i| {
                let joint = &profile.mechanism.joints[i];
                joint.min_rad + (joint.max_rad - joint.min_rad) * halton(n, i)
            });
            let gap = a
                .forward(&q, conditions)
                .separation(&b.forward(&q, conditions));
            // an effect that puts the tool nowhere puts it farther than any other
            Some(mm_from_m(gap.distance_m))
                .filter(|d| d.is_finite())
                .unwrap_or(f64::INFINITY)
        })
        .collect();
    Deviation {
        mean_mm: distances.iter().sum::<f64>() / distances.len() as f64,
        max_mm: distances.iter().copied().fold(0.0, f64::max),
        postures: distances.len(),
    }
}

/// The `n`-th number in [0, 1) of the Halton sequence of one dimension.
///
/// # Source
/// J. H. Halton, Numerische Mathematik 2 (1960).
fn halton(mut n: u32, dimension: usize) -> f64 {
    const PRIMES: [u32; 6] = [2, 3, 5, 7, 11, 13];
    let base = PRIMES[dimension];
    let (mut value, mut part) = (0.0, 1.0);
    while n > 0 {
        part /= f64::from(base);
        value += part * f64::from(n % base);
        n /= base;
    }
    value
}

/// A number with the digits that matter: rounding of the unit's factor is not shown.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.9e}");
    let rounded: f64 = text.parse().expect("a written number");
    let rounded = if rounded == 0.0 { 0.0 } else { rounded };
    if rounded != 0.0 && rounded.abs() < 1e-3 {
        format!("{rounded:e}")
    } else {
        rounded.to_string()
    }
}

pub(super) fn triple(metres: [f64; 3]) -> String {
    format!("({})", metres.map(|m| number(mm_from_m(m))).join(", "))
}

pub(super) fn pose(pose: &Pose) -> String {
    let [x, y, z, rx, ry, rz] = pose.xyz_rxryrz();
    let clean = |angle: f64| {
        number(if (angle / DEG).abs() < 1e-12 {
            0.0
        } else {
            angle / DEG
        })
    };
    format!(
        "{} rotated {} {} {}",
        triple([x, y, z]),
        clean(rx),
        clean(ry),
        clean(rz)
    )
}
