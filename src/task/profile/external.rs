//! `profile add-track`, `add-positioner`, `import-moc`, `import-krc`: external axes put into a
//! profile's text.

use super::change::{Changed, changed};
use super::krc;
use super::moc;
use crate::geometry::Pose;
use crate::model::external::{ExternalAxes, Positioner, TrackAxis};
use crate::model::profile::{flow_pose, with_external, with_value};
use crate::program::Source;
use crate::task::{Failure, ProfileFile};

/// What a controller's files say of external axes.
pub(super) struct Read {
    /// Where the base stands with every axis of the track at zero, where the files say it.
    pub base: Option<Pose>,
    /// The axes.
    pub axes: ExternalAxes,
    /// Where each number comes from, and what is left out.
    pub notes: Vec<String>,
}

/// A profile with one more linear axis under the base.
///
/// # Errors
/// An axis that the format does not allow; a layout that cannot be changed in place.
pub fn add_track(file: &ProfileFile, axis: TrackAxis, output: &str) -> Result<Changed, Failure> {
    let mut axes = file.profile.external.clone();
    axes.track.push(axis);
    written(file, &file.text, &axes, Vec::new(), output)
}

/// A profile with one more positioner.
///
/// # Errors
/// As [`add_track`].
pub fn add_positioner(
    file: &ProfileFile,
    positioner: Positioner,
    output: &str,
) -> Result<Changed, Failure> {
    let mut axes = file.profile.external.clone();
    axes.positioners.push(positioner);
    written(file, &file.text, &axes, Vec::new(), output)
}

/// A profile with the base frame, track and stations of an ABB controller's `MOC.cfg`: of the robot
/// of this name, its only one without; `axis` is the track's axis where the file does not say it.
///
/// # Errors
/// A file without such a robot or its numbers, a profile that has external axes already, a layout
/// that cannot be changed in place.
pub fn import_moc(
    moc: &Source,
    file: &ProfileFile,
    (robot, axis): (Option<&str>, Option<&str>),
    output: &str,
) -> Result<Changed, Failure> {
    imported(file, moc::read(moc, robot, axis)?, output)
}

/// A profile with the base frame, track and positioners of a KUKA controller's `$machine.dat` and
/// `$config.dat`.
///
/// # Errors
/// As [`import_moc`].
pub fn import_krc(
    sources: &[Source],
    file: &ProfileFile,
    output: &str,
) -> Result<Changed, Failure> {
    imported(file, krc::read(sources)?, output)
}

fn imported(file: &ProfileFile, read: Read, output: &str) -> Result<Changed, Failure> {
    if !file.profile.external.is_empty() {
        return Err(Failure::with_hint(
            format!("{}: it has external axes already", file.name),
            "import into a profile without `external_axes`",
        ));
    }
    let text = match &read.base {
        None => file.text.clone(),
        Some(base) => {
            let path = "kinematics.base";
            let base = &file.profile.base_and_foot(*base);
            with_value(&file.text, path, &flow_pose(base)).map_err(|error| {
                let hint = format!("write it as one line: `base: {}`", flow_pose(base));
                Failure::with_hint(format!("{}: {error}", file.name), hint)
            })?
        }
    };
    written(file, &text, &read.axes, read.notes, output)
}

fn written(
    file: &ProfileFile,
    text: &str,
    axes: &ExternalAxes,
    notes: Vec<String>,
    output: &str,
) -> Result<Changed, Failure> {
    let text = with_external(text, axes).ok_or_else(|| {
        Failure::with_hint(
            format!(
                "{}: cannot tell where `external_axes` starts and ends",
                file.name
            ),
            "write it as a block of its own lines, as docs/external-axes.md has it",
        )
    })?;
    let mut done = changed(file, text, output)?;
    done.notes.extend(notes);
    Ok(done)
}
