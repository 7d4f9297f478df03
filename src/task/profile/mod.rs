//! `profile`: make and inspect profiles.

mod change;
mod details;
mod export;
mod external;
mod facts;
mod import_ur;
mod krc;
mod moc;
mod tool;
#[cfg(feature = "urdf")]
mod urdf;

pub use change::{Changed, add_tool, set};
pub use export::{Coupled, Exported, ExportedChain, Form, Row, export};
pub use external::{add_positioner, add_track, import_krc, import_moc};
pub use facts::Deviation;
pub use import_ur::{Imported, import_ur};
pub use tool::tool;
#[cfg(feature = "urdf")]
pub use urdf::{FromUrdf, Inputs, from_urdf};

use super::Document;
use super::failure::Failure;
use crate::inverse::Arm;
use crate::model::profile::{ControllerModel, Mounted, Profile, SHIPPED, catalogue};
use crate::nearest;
use facts::{facts, typical_deviation};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// A built-in profile.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct NewProfile {
    /// Its name, as `poseshift robots` lists it.
    pub robot: String,
    /// Where its numbers are from, and what is to be set in it: nothing of a profile that was put
    /// together by hand.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// Its text, where it is not written to a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<String>,
    /// The file written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
}

impl Document for NewProfile {
    const KIND: &'static str = "new-profile/1";
}

/// A built-in robot's profile.
///
/// # Errors
/// No built-in robot has this name.
pub fn new(robot: &str) -> Result<NewProfile, Failure> {
    let made = |notes: Vec<String>, text: String| NewProfile {
        robot: robot.into(),
        notes,
        profile: Some(text),
        output: None,
    };
    if let Some((_, text)) = SHIPPED.iter().find(|(name, _)| *name == robot) {
        return Ok(made(Vec::new(), (*text).to_owned()));
    }
    let rows = catalogue();
    if let Some(arm) = rows.iter().find(|arm| arm.name == robot) {
        let text = arm.text();
        // what is reported is what stands in the file
        let notes = text.lines().map_while(|line| line.strip_prefix("# "));
        return Ok(made(notes.map(str::to_owned).collect(), text.clone()));
    }
    let names = SHIPPED.iter().map(|(name, _)| *name);
    let names = names.chain(rows.iter().map(|arm| arm.name.as_str()));
    Err(Failure::with_hint(
        format!("no built-in robot is called `{robot}`"),
        nearest::hint(robot, "robots", names) + " (`poseshift robots --search TEXT` looks for one)",
    ))
}

/// How a built-in robot becomes a profile that can be given; `None` where no robot has this name.
#[must_use]
pub fn way_to_built_in(robot: &str) -> Option<String> {
    let found = new(robot).ok()?.robot;
    Some(format!(
        "`{found}` is a built-in robot: `poseshift profile new --robot {found} -o {found}.yaml` \
         makes a profile of it"
    ))
}

/// What a person wants to know of a profile.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Facts {
    /// Everything the profile says: name and value, mm and degrees.
    pub facts: BTreeMap<String, String>,
    /// Whether and how the arm has an inverse.
    pub inverse: String,
    /// How far the real tool is from the controller's.
    pub deviation: Deviation,
    /// Where the effects come from and what they are worth, a line each.
    pub worth: Vec<String>,
    /// Standard deviations by the keys of the parameters.
    pub sigmas: BTreeMap<String, f64>,
    /// The facts in the order of the file.
    #[serde(skip)]
    pub ordered: Vec<(String, String)>,
    /// What the controller computes with.
    #[serde(skip)]
    pub controller: &'static str,
    /// Whether there is a calibration.
    #[serde(skip)]
    pub is_calibrated: bool,
    /// The robot's name, serial number and language, as the profile gives them.
    #[serde(skip)]
    pub robot: [Option<String>; 3],
}

impl Document for Facts {
    const KIND: &'static str = "profile-facts/1";
}

/// What a person wants to know of a profile.
#[must_use]
pub fn show(profile: &Profile) -> Facts {
    let ordered = facts(profile);
    Facts {
        facts: ordered.iter().cloned().collect(),
        inverse: inverse(profile),
        deviation: typical_deviation(profile),
        worth: worth(profile),
        sigmas: sigmas(profile),
        ordered,
        controller: match (profile.controller, &profile.own_effects) {
            (ControllerModel::Nominal, _) => "computes with the nominal chain",
            (ControllerModel::Calibrated, Some(_)) => "computes with a calibrated chain of its own",
            (ControllerModel::Calibrated, None) => "computes with a calibrated chain",
        },
        is_calibrated: !profile.effects.is_empty(),
        robot: [
            Some(format!("{} {}", profile.manufacturer, profile.model)),
            profile.serial.clone(),
            profile.language.clone(),
        ],
    }
}

/// Whether and how an arm has an inverse.
fn inverse(profile: &Profile) -> String {
    Arm::of(&profile.geometry(&Mounted::flange()), &profile.mechanism)
        .as_ref()
        .map_or_else(ToString::to_string, |arm| {
            format!("closed form, {}", arm.kind())
        })
}

/// A fact that differs.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Difference {
    /// Which.
    pub key: String,
    /// What the first profile says; `null` where it does not say it.
    pub a: Option<String>,
    /// What the second profile says; `null` where it does not say it.
    pub b: Option<String>,
}

/// How two profiles differ.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Diff {
    /// Every fact that differs.
    pub differences: Vec<Difference>,
}

impl Document for Diff {
    const KIND: &'static str = "profile-diff/1";
}

/// How two profiles differ.
#[must_use]
pub fn diff(a: &Profile, b: &Profile) -> Diff {
    let by_name = |profile| facts(profile).into_iter().collect::<BTreeMap<_, _>>();
    let (a, b) = (by_name(a), by_name(b));
    let keys: BTreeSet<&String> = a.keys().chain(b.keys()).collect();
    let changed = keys.into_iter().filter(|key| a.get(*key) != b.get(*key));
    let differences = changed.map(|key| Difference {
        key: key.clone(),
        a: a.get(key).cloned(),
        b: b.get(key).cloned(),
    });
    Diff {
        differences: differences.collect(),
    }
}

/// What a calibrated profile says of where its effects come from and what they are worth, a line
/// each.
fn worth(profile: &Profile) -> Vec<String> {
    let mut lines = Vec::new();
    let said = |key: &str| profile.provenance.as_ref()?.get(key);
    let word = |value: &Value| {
        let text = value.as_str().map(str::to_owned);
        text.unwrap_or_else(|| value.to_string())
    };
    for (name, key) in [
        ("date", "date"),
        ("program", "program"),
        ("rows", "rows"),
        ("temperature, C", "temperature_c"),
        ("measurements, SHA-256", "measurements_sha256"),
    ] {
        let Some(value) = said(key) else { continue };
        match value.as_array() {
            Some(list) => lines.extend(list.iter().map(|v| format!("{name}  {}", word(v)))),
            None => lines.push(format!("{name}  {}", word(value))),
        }
    }
    for (name, key) in [
        ("error before", "before"),
        ("error with base and tool fitted", "frames_only"),
        ("error after", "after"),
    ] {
        let kinds = [("position", "mm"), ("orientation", "deg"), ("range", "mm")];
        for (kind, unit) in kinds {
            let spread = profile
                .quality
                .as_ref()
                .and_then(|quality| quality.get(key)?.get(kind));
            let number = |what: &str| spread?.get(format!("{what}_{unit}"))?.as_f64();
            if let (Some(mean), Some(max)) = (number("mean"), number("max")) {
                lines.push(format!(
                    "{name}, {kind}  mean {mean:.4} {unit}, at most {max:.4} {unit}"
                ));
            }
        }
    }
    lines
}

/// The standard deviations that a calibrated profile gives, by the keys of its parameters.
fn sigmas(profile: &Profile) -> BTreeMap<String, f64> {
    let list = profile
        .quality
        .as_ref()
        .and_then(|quality| quality.get("parameters")?.as_array());
    let one = |entry: &Value| {
        let key = entry.get("key")?.as_str()?.to_owned();
        Some((key, entry.get("sigma")?.as_f64()?))
    };
    list.into_iter().flatten().filter_map(one).collect()
}

#[cfg(test)]
mod tests;
