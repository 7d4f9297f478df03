//! The load on the flange is not the one in the profile.

use super::definition::{Definition, Need, Parameter, SiteKey, Unit};
use super::search::{Search, Sets, Shown};
use super::words::{digits, length, mm};
use super::{Effect, Equation, MOST_PARAMETERS, Seen, Site};
use crate::geometry::{Scalar, add};
use crate::model::{Conditions, Geometry};

/// The tool weighs more, or elsewhere: seen only through what bends under it.
pub(super) struct PayloadError;

impl Equation for PayloadError {
    const DEFINITION: Definition = Definition {
        id: "payload_error",
        summary: "the tool on the flange is heavier, or its centre of gravity elsewhere, than the \
            profile says; shows only through compliance",
        equation: "real mass = mass + mass_kg, real cog = cog + (cog_x, cog_y, cog_z), in the \
            flange frame; enters every torque and moment",
        source: "A. Nubiola, thesis, eqs. I.5–I.10",
        site: &[SiteKey::Tool],
        parameters: &[
            Parameter { key: "mass_kg", unit: Unit::Kilogram, prior_sigma: 5.0 },
            Parameter { key: "cog_x_mm", unit: Unit::Millimetre, prior_sigma: 50.0 },
            Parameter { key: "cog_y_mm", unit: Unit::Millimetre, prior_sigma: 50.0 },
            Parameter { key: "cog_z_mm", unit: Unit::Millimetre, prior_sigma: 50.0 },
        ],
        needs: &[Need::Masses],
        deflects: false,
        bends: false,
        of_data: false,
        shown_against: Shown::Torque(Some(1)),
        search: Search {
            rare: true,
            held: true,
            sets: Sets::Of(&[&[0], &[1, 2, 3], &[0, 1, 2, 3]]),
            mass: Some(0),
            ..Search::PLAIN
        },
    };
    // what the largest robots carry, and half as much again
    const LARGEST: &'static [(&'static str, f64)] = &[("mass_kg", 3000.0)];

    fn change_geometry<S: Scalar>(site: &Site, p: &[S; MOST_PARAMETERS], _: &Conditions, geometry: &mut Geometry<S>) {
        if site.is_of_tool(&geometry.tool_name) {
            let (mass, cog) = geometry.load.unwrap_or((S::zero(), [S::zero(); 3]));
            geometry.load = Some((mass + p[0], add(cog, [p[1], p[2], p[3]])));
        }
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        let (mass, moved) = (effect.parameters[0], length(&effect.parameters[1..4]));
        let load = match &effect.site.tool {
            Some(tool) => format!("load of tool `{tool}`"),
            None => "load on the flange".into(),
        };
        let heavier = format!(
            "The {load} is {} kg {} than the profile says",
            digits(mass.abs()),
            if mass < 0.0 { "lighter" } else { "heavier" },
        );
        match (mass == 0.0, moved == 0.0) {
            (false, true) => heavier,
            (true, false) => format!(
                "The centre of gravity of the {load} is {} mm from where the profile has it",
                mm(moved)
            ),
            _ => format!("{heavier}, its centre of gravity {} mm elsewhere", mm(moved)),
        }
    }
}
