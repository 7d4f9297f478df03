//! The factory calibration of a Universal Robots arm into its profile.

use super::Deviation;
use super::facts::typical_deviation_of;
use crate::model::effects::{Effect, Kind};
use crate::model::profile::{Profile, universal_robots, with_controller};
use crate::program::Source;
use crate::program::sha256;
use crate::task::{Document, Failure, ProfileFile, text};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// A profile whose controller computes with its factory calibration.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Imported {
    /// The profile written.
    pub output: String,
    /// The effects that the controller applies, as in profiles.
    pub effects: Vec<BTreeMap<String, Value>>,
    /// How far the controller's chain is from the nominal one.
    pub deviation: Deviation,
    /// The profile's text.
    #[serde(skip)]
    pub text: String,
}

impl Document for Imported {
    const KIND: &'static str = "import-ur/1";
}

/// Puts a factory calibration into a nominal profile of this type of arm; `output` is how the new
/// profile is named.
///
/// # Errors
/// A file that is no such calibration; a profile whose own calibration would undo the controller's.
pub fn import_ur(
    calibration: &Source,
    file: &ProfileFile,
    output: &str,
) -> Result<Imported, Failure> {
    let profile = &file.profile;
    let is_geometry = |effect: &Effect| effect.kind == Kind::LinkGeometry;
    if !profile.effects.is_empty() && !profile.effects.iter().any(is_geometry) {
        return Err(Failure::with_hint(
            format!(
                "{}: its calibration has effects, but no link geometry; compensation would undo \
                 the controller's own",
                file.name
            ),
            "import into a profile without a calibration, then calibrate",
        ));
    }
    let conf = text(calibration)?;
    let effects = universal_robots::link_geometry(&conf, profile).map_err(|error| {
        let line = error.line();
        let length = calibration.line(line.saturating_sub(1)).map(<[u8]>::len);
        Failure::at(
            calibration,
            line,
            1,
            length,
            error.to_string(),
            error.hint(),
        )
    })?;
    let note = format!(
        "factory calibration, imported from a file with SHA-256 {}",
        sha256(&calibration.bytes)
    );
    let text = with_controller(&file.text, profile, &effects, &note).ok_or_else(|| {
        Failure::with_hint(
            format!(
                "{}: cannot find where `controller` starts and ends",
                file.name
            ),
            "write it as a block of its own lines, as the built-in profiles have it",
        )
    })?;
    let imported =
        Profile::from_yaml(&text).map_err(|error| Failure::profile(output, &text, &error))?;
    let nominal = Profile {
        effects: Vec::new(),
        own_effects: None,
        ..profile.clone()
    };
    let keys = |effect: &Effect| {
        let entry = effect.to_entry().into_iter();
        entry.map(|(key, value)| (key.to_owned(), value)).collect()
    };
    Ok(Imported {
        output: output.into(),
        effects: effects.iter().map(keys).collect(),
        deviation: typical_deviation_of(&imported, &nominal),
        text,
    })
}
