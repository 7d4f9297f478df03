//! A profile of a URDF.

use super::inverse;
use crate::model::profile::{MAKERS, Maker, Profile, ToolOfProfile};
use crate::nearest;
use crate::program::{LANGUAGES, Source};
use crate::task::{Document, Failure, text};
use crate::urdf::{About, Choice, Meshes, UrdfArm, UrdfError, profile_text};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// A URDF and what to take of it.
pub struct Inputs<'a> {
    /// The URDF.
    pub urdf: &'a Source,
    /// Its name in the profile's comments.
    pub origin: &'a str,
    /// What to take of it.
    pub choice: Choice,
    /// Where its meshes are.
    pub meshes: Meshes<'a>,
    /// The maker, the controller's language and the serial number where they are given.
    pub about: [Option<&'a str>; 3],
    /// Tools by name.
    pub tools: BTreeMap<String, ToolOfProfile>,
}

/// A profile made of a URDF.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct FromUrdf {
    /// The robot's name.
    pub robot: String,
    /// The link where the world is.
    pub base: String,
    /// The link that tools are mounted on.
    pub tip: String,
    /// Whether and how the arm has an inverse.
    pub inverse: String,
    /// What was taken differently from what stands in the URDF, what was added, and what is
    /// missing.
    pub notes: Vec<String>,
    /// The profile's text.
    pub profile: String,
    /// The file written.
    pub output: Option<String>,
}

impl Document for FromUrdf {
    const KIND: &'static str = "new-profile/1";
}

/// Makes a profile of a URDF: its six axes, limits, masses and collision shapes.
///
/// # Errors
/// A URDF that is no arm of six rotary joints, an unknown language.
pub fn from_urdf(inputs: &Inputs) -> Result<FromUrdf, Failure> {
    let name = &inputs.urdf.name;
    let failure = |error: UrdfError| Failure::with_hint(format!("{name}: {error}"), error.hint());
    let [maker, language, serial] = inputs.about;
    if let Some(language) = language {
        check_language(language)?;
    }
    let arm = UrdfArm::read(&text(inputs.urdf)?, &inputs.choice).map_err(failure)?;
    let about = About {
        maker,
        language,
        serial,
        tools: inputs.tools.clone(),
        ..About::of(inputs.origin, inputs.meshes)
    };
    let (yaml, mut notes) = profile_text(&arm, &about).map_err(failure)?;
    notes.extend(maker.and_then(unknown_maker));
    let profile =
        Profile::from_yaml(&yaml).map_err(|error| Failure::profile(name, &yaml, &error))?;
    if profile.language.is_none() {
        notes.push("the controller's language is not known: --language names it".into());
    }
    let [base, tip] = arm.ends;
    Ok(FromUrdf {
        robot: arm.name,
        base,
        tip,
        inverse: inverse(&profile),
        notes,
        profile: yaml,
        output: None,
    })
}

/// That a language is one of those that are read.
pub(super) fn check_language(language: &str) -> Result<(), Failure> {
    let ids = || LANGUAGES.iter().map(|known| known.about().id);
    if ids().any(|id| id == language) {
        return Ok(());
    }
    Err(Failure::with_hint(
        format!("no language is called `{language}`"),
        nearest::hint(language, "languages", ids()),
    ))
}

/// A maker that may be a misspelt one.
fn unknown_maker(maker: &str) -> Option<String> {
    if Maker::by_name(maker).is_some() {
        return None;
    }
    let near = nearest::nearest(maker, MAKERS.iter().map(|maker| maker.name));
    let meant = near.first()?;
    Some(format!(
        "nothing is known of the controllers of `{maker}`; did you mean `{meant}`?"
    ))
}
