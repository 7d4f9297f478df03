//! Profiles and frame files as they are read: with their hash, and their faults with line and
//! column.

use super::failure::Failure;
use crate::model::profile::{Mounted, Profile, rewritten};
use crate::nearest;
use crate::program::Source;
use crate::program::sha256;
use crate::register::frame_file::Frame;

/// A profile with the file it comes from.
#[derive(Clone, Debug)]
pub struct ProfileFile {
    /// The file as the user named it.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Its SHA-256.
    pub sha256: String,
    /// What it says.
    pub profile: Profile,
}

impl ProfileFile {
    /// Reads a profile.
    ///
    /// # Errors
    /// What the format does not allow, with line and column.
    pub fn read(source: &Source) -> Result<Self, Failure> {
        let text = text(source)?;
        let profile = Profile::from_yaml(&text)
            .map_err(|error| Failure::profile(&source.name, &text, &error))?;
        Ok(Self {
            name: source.name.clone(),
            sha256: sha256(&source.bytes),
            text,
            profile,
        })
    }

    /// The text with another calibration, comments and order kept.
    ///
    /// # Errors
    /// The text is laid out so that the place of the calibration cannot be found.
    pub fn rewritten(&self, profile: &Profile) -> Result<String, Failure> {
        rewritten(&self.text, profile)
            .map_err(|error| Failure::new(format!("{}: {error}", self.name)))
    }

    /// The tool that `--tool NAME` means: that one, else the only one, else the flange.
    ///
    /// # Errors
    /// No such tool; several without a name.
    pub fn tool(&self, name: Option<&str>) -> Result<Mounted, Failure> {
        let profile = &self.profile;
        let names: Vec<_> = profile.tools.keys().map(String::as_str).collect();
        match (name, names.as_slice()) {
            (Some(name), _) => profile.tool(name).ok_or_else(|| {
                Failure::with_hint(
                    format!("the profile has no tool `{name}`"),
                    nearest::hint(name, "tools of the profile", names.iter().copied()),
                )
            }),
            (None, []) => Ok(Mounted::flange()),
            (None, [only]) => Ok(profile.tool(only).unwrap_or_else(Mounted::flange)),
            (None, _) => Err(Failure::with_hint(
                "the profile has several tools",
                format!("choose one with --tool: {}", names.join(", ")),
            )),
        }
    }
}

/// Bytes of a profile, a cell, a frame or a URDF: a hundred thousand bodies.
const LARGEST_TEXT: usize = 64 << 20;

/// A file's text, which must be UTF-8.
///
/// # Errors
/// A byte that is not; more than any such file has.
pub fn text(source: &Source) -> Result<String, Failure> {
    if source.bytes.len() > LARGEST_TEXT {
        return Err(Failure::with_hint(
            format!(
                "{}: it has {} bytes; of profiles, cells, frames and URDFs at most {LARGEST_TEXT} \
                 are read",
                source.name,
                source.bytes.len()
            ),
            "is it the right file?",
        ));
    }
    String::from_utf8(source.bytes.clone()).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let name = &source.name;
        Failure::new(format!("{name}: not a text file (byte {at} is not UTF-8)"))
    })
}

/// A frame file.
///
/// # Errors
/// What the format does not allow, with line and column.
pub fn frame(source: &Source) -> Result<Frame, Failure> {
    Frame::from_yaml(&text(source)?).map_err(|error| {
        let hint = "a frame file is written by `poseshift register FROM.csv TO.csv -o FRAME.yaml`";
        Failure::at(source, error.line, error.column, None, error.message, hint)
    })
}
