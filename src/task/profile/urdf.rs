//! A profile of a URDF.

use super::inverse;
use crate::model::profile::Profile;
use crate::program::Source;
use crate::task::{Document, Failure, text};
use crate::urdf::{Choice, UrdfArm, UrdfError, profile_text};
use schemars::JsonSchema;
use serde::Serialize;

/// Where a mesh file that the URDF names is; `None` where it is not.
pub type Meshes<'a> = &'a dyn Fn(&str) -> Option<String>;

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
}

/// A profile made of a URDF.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct FromUrdf {
    /// The robot's name.
    pub robot: String,
    /// The link that stands.
    pub base: String,
    /// The link that tools are mounted on.
    pub tip: String,
    /// Whether and how the arm has an inverse.
    pub inverse: String,
    /// What was taken differently from what stands in the URDF.
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
/// A URDF that is no arm of six turning joints.
pub fn from_urdf(inputs: &Inputs) -> Result<FromUrdf, Failure> {
    let name = &inputs.urdf.name;
    let told = |error: UrdfError| Failure::with_hint(format!("{name}: {error}"), error.hint());
    let arm = UrdfArm::read(&text(inputs.urdf)?, &inputs.choice).map_err(told)?;
    let yaml = profile_text(&arm, inputs.origin, inputs.meshes).map_err(told)?;
    let profile =
        Profile::from_yaml(&yaml).map_err(|error| Failure::profile(name, &yaml, &error))?;
    let [base, tip] = arm.ends;
    Ok(FromUrdf {
        robot: arm.name,
        base,
        tip,
        inverse: inverse(&profile),
        notes: arm.notes,
        profile: yaml,
        output: None,
    })
}
