//! Values of a profile changed in its text: `profile set`, `profile add-tool` and their like.

use super::{Difference, diff};
use crate::model::profile::{EditError, Profile, ToolOfProfile, flow_tool, with_value};
use crate::nearest;
use crate::task::programs::language_by_id;
use crate::task::{Document, Failure, ProfileFile};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

/// A profile with other values.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Changed {
    /// The file written.
    pub output: String,
    /// Every fact that differs now.
    pub differences: Vec<Difference>,
    /// What should be looked at.
    pub notes: Vec<String>,
    /// The profile's text.
    #[serde(skip)]
    pub text: String,
}

impl Document for Changed {
    const KIND: &'static str = "changed-profile/1";
}

/// A profile with values set: `kinematics.joints.3.min_deg=-70`, `robot.serial=120-500123`.
///
/// # Errors
/// A path that leads nowhere, a value that the format does not allow, a layout that cannot be
/// changed in place.
pub fn set(file: &ProfileFile, values: &[String], output: &str) -> Result<Changed, Failure> {
    let mut text = file.text.clone();
    for given in values {
        let (path, value) = given.split_once('=').ok_or_else(|| {
            Failure::with_hint(
                format!("`{given}` has no `=`"),
                "PATH=VALUE, such as robot.serial=120-500123 or kinematics.joints.3.max_deg=70",
            )
        })?;
        let (path, value) = (path.trim(), value.trim());
        if path == "controller.language" {
            language_by_id(value)?;
        }
        text = with(&file.name, &text, path, &as_yaml(path, value))?;
    }
    changed(file, text, output)
}

/// A profile with one more tool.
///
/// # Errors
/// The profile has a tool of this name, or a layout that cannot be changed in place.
pub fn add_tool(
    file: &ProfileFile,
    (name, tool): &(String, ToolOfProfile),
    output: &str,
) -> Result<Changed, Failure> {
    if file.profile.tools.contains_key(name) {
        return Err(Failure::with_hint(
            format!("{}: there is a tool `{name}` already", file.name),
            "another name, or `profile set` with the keys of this one, such as \
             tools.NAME.mass_kg=2.5",
        ));
    }
    if name.contains('.') {
        return Err(Failure::new(format!("the tool's name `{name}` has a dot")));
    }
    let path = format!("tools.{name}");
    let text = with(&file.name, &file.text, &path, &flow_tool(tool))?;
    let mut made = changed(file, text, output)?;
    if let Some((mass_kg, [0.0, 0.0, 0.0])) = tool.load.filter(|(mass_kg, _)| *mass_kg > 0.0) {
        made.notes.push(format!(
            "the {mass_kg} kg of `{name}` are taken to be at the flange, as no centre of gravity is \
             given: `{name}=…,{mass_kg},CX,CY,CZ` in mm on the flange"
        ));
    }
    Ok(made)
}

/// Words where words are meant, whatever they look like.
fn as_yaml(path: &str, value: &str) -> String {
    let is_word = match path.split_once('.') {
        Some(("robot", key)) => key != "payload_kg",
        Some(("controller", key)) => key == "language",
        _ => false,
    };
    if is_word && !value.starts_with(['"', '\'']) {
        Value::from(value).to_string()
    } else {
        value.to_owned()
    }
}

fn with(name: &str, text: &str, path: &str, value: &str) -> Result<String, Failure> {
    with_value(text, path, value).map_err(|error| {
        let hint = match &error {
            EditError::NoSuch { key, known, .. } => {
                nearest::hint(key, "there are", known.iter().map(String::as_str))
            }
            EditError::Layout { .. } => "edit the file by hand".into(),
            EditError::Comma { value } => {
                format!("decimals stand behind a point: {}", value.replace(',', "."))
            }
            EditError::Yaml { .. } | EditError::Block { .. } => String::new(),
        };
        Failure::with_hint(format!("{name}: {error}"), hint)
    })
}

/// The change with what differs.
pub(super) fn changed(file: &ProfileFile, text: String, output: &str) -> Result<Changed, Failure> {
    let profile =
        Profile::from_yaml(&text).map_err(|error| Failure::profile(&file.name, &text, &error))?;
    let mut notes = Vec::new();
    if profile.provenance.is_some() && profile.links != file.profile.links {
        notes.push(
            "the calibration was identified with the earlier nominal rows: it does not hold for \
             these"
                .into(),
        );
    }
    Ok(Changed {
        output: output.into(),
        differences: diff(&file.profile, &profile).differences,
        notes,
        text,
    })
}
