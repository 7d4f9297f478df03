//! The frame file: a pose found by measuring, with its uncertainty.
//!
//! ```yaml
//! poseshift: frame/1
//! pose: {x_mm: 812.4, y_mm: -3.1, z_mm: 401.9, quaternion: [1, 0, 0, 0]}   # to_from_from: maps FROM into TO
//! sigma: {x_mm: 0.03, y_mm: 0.03, z_mm: 0.02, rx_deg: 0.01, ry_deg: 0.01, rz_deg: 0.004}
//! rmsd_mm: 0.041
//! points: 8
//! provenance: {method: kabsch, from: nominal.csv, to: probed.csv}
//! ```
//!
//! `pose` is written as in profiles (three angles or a quaternion); `sigma` are standard
//! uncertainties of the place of FROM's origin and of rotates about the axes of TO. Only
//! `poseshift` and `pose` are required; unknown keys are errors.

use super::uncertainty::PoseCovariance;
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::printable::quoted;
use crate::profile::{Number, PoseFile, ProfileError, check_angles, file};
use schemars::JsonSchema;
use serde::Deserialize;
use serde_yaml::Spanned;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The format name that stands first in a frame file.
pub const FORMAT: &str = "frame/1";

/// A frame and how well it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Maps coordinates of the first frame (FROM) into the second (TO).
    pub to_from_from: Pose,
    /// Standard uncertainties: place of FROM's origin in metres, rotates about the axes of TO in
    /// radians.
    pub sigma: Option<Sigma>,
    /// Root mean square distance of the points, metres.
    pub rmsd_m: Option<f64>,
    /// Number of points it was found from.
    pub points: Option<usize>,
    /// Where it comes from: key and text.
    pub provenance: BTreeMap<String, String>,
}

/// Six standard uncertainties.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sigma {
    /// Of the place of FROM's origin along the axes of TO, metres.
    pub position_m: [f64; 3],
    /// Of rotates about the axes of TO, radians.
    pub rotation_rad: [f64; 3],
}

/// What is wrong with a frame file, and where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{line}:{column}: {message}")]
pub struct FrameFileError {
    /// Line, from 1; 0 where it is not known.
    pub line: usize,
    /// Column, from 1; 0 where it is not known.
    pub column: usize,
    /// What is wrong.
    pub message: String,
}

/// A pose found by measuring, with its uncertainty.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct File {
    /// Format and version: `frame/1`.
    #[schemars(with = "String")]
    poseshift: Spanned<String>,
    /// Maps FROM into TO.
    #[schemars(with = "PoseFile")]
    pose: Spanned<PoseFile>,
    /// Standard uncertainties of FROM's origin and of rotations about the axes of TO.
    #[serde(default)]
    sigma: Option<SigmaFile>,
    /// Root mean square distance of the points.
    #[serde(default)]
    rmsd_mm: Option<Number>,
    /// Number of points it was found from.
    #[serde(default)]
    points: Option<usize>,
    /// Where it comes from.
    #[serde(default)]
    provenance: BTreeMap<String, String>,
}

/// Six standard uncertainties.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SigmaFile {
    /// Along x.
    x_mm: Number,
    /// Along y.
    y_mm: Number,
    /// Along z.
    z_mm: Number,
    /// About x.
    rx_deg: Number,
    /// About y.
    ry_deg: Number,
    /// About z.
    rz_deg: Number,
}

impl From<ProfileError> for FrameFileError {
    fn from(error: ProfileError) -> Self {
        Self {
            line: error.line,
            column: error.column,
            message: error.fault.to_string(),
        }
    }
}

impl Sigma {
    /// The six of a covariance, at the origin of FROM.
    #[must_use]
    pub fn of(covariance: &PoseCovariance, to_from_from: &Pose) -> Self {
        Self {
            position_m: covariance.sigma_at_m(to_from_from.translation),
            rotation_rad: covariance.rotation_sigma_rad(),
        }
    }
}

impl Frame {
    /// The JSON Schema of the format.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        file::schema::<File>(FORMAT)
    }

    /// Reads a frame file's text.
    ///
    /// # Errors
    /// Anything that the format does not allow, with line and column.
    pub fn from_yaml(text: &str) -> Result<Self, FrameFileError> {
        let file: File =
            serde_yaml::from_str(text).map_err(|error| ProfileError::of(text, FORMAT, error))?;
        if file.poseshift.value != FORMAT {
            let at = file.poseshift.defined;
            #[allow(clippy::cast_possible_truncation)]
            return Err(FrameFileError {
                line: at.line() as usize,
                column: at.column() as usize,
                message: format!(
                    "format is `{}`; a frame file is `{FORMAT}`",
                    file.poseshift.value
                ),
            });
        }
        check_angles(&file.pose)?;
        let sigma = file.sigma.map(|s| Sigma {
            position_m: [s.x_mm, s.y_mm, s.z_mm].map(|n| n.0 * 1e-3),
            rotation_rad: [s.rx_deg, s.ry_deg, s.rz_deg].map(|n| n.0 * DEG),
        });
        Ok(Self {
            to_from_from: crate::profile::pose(&file.pose)?,
            sigma,
            rmsd_m: file.rmsd_mm.map(|n| n.0 * 1e-3),
            points: file.points,
            provenance: file.provenance,
        })
    }

    /// The file's text; read again it gives the same frame.
    #[must_use]
    pub fn to_yaml(&self) -> String {
        let t = self.to_from_from.translation.map(mm_from_m);
        let q = self.to_from_from.rotation.quaternion().0;
        let mut text = format!(
            "poseshift: {FORMAT}\npose: {{x_mm: {}, y_mm: {}, z_mm: {}, quaternion: [{}, {}, {}, \
             {}]}}\n",
            t[0], t[1], t[2], q[0], q[1], q[2], q[3]
        );
        let ok = "a string takes all text";
        if let Some(sigma) = self.sigma {
            let p = sigma.position_m.map(mm_from_m);
            let r = sigma.rotation_rad.map(|r| r / DEG);
            writeln!(
                text,
                "sigma: {{x_mm: {:.6}, y_mm: {:.6}, z_mm: {:.6}, rx_deg: {:.7}, ry_deg: {:.7}, \
                 rz_deg: {:.7}}}",
                p[0], p[1], p[2], r[0], r[1], r[2]
            )
            .expect(ok);
        }
        if let Some(rmsd) = self.rmsd_m {
            writeln!(text, "rmsd_mm: {:.6}", mm_from_m(rmsd)).expect(ok);
        }
        if let Some(points) = self.points {
            writeln!(text, "points: {points}").expect(ok);
        }
        if !self.provenance.is_empty() {
            text += "provenance:\n";
            for (key, value) in &self.provenance {
                writeln!(text, "  {}: {}", key_text(key), quoted(value)).expect(ok);
            }
        }
        text
    }
}

/// A key as YAML has it: in quotes where it is not a plain word, or one that YAML takes for a value.
fn key_text(key: &str) -> String {
    let is_word = key.starts_with(|c: char| c.is_ascii_lowercase())
        && key
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    let is_value = matches!(
        key,
        "true" | "false" | "null" | "yes" | "no" | "on" | "off" | "y" | "n"
    );
    if is_word && !is_value {
        key.to_owned()
    } else {
        quoted(key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_of_any_text_are_read_back() {
        for key in [
            "null",
            "true",
            "1",
            "a b",
            "m\n\n$\n=\n!o",
            "",
            "#",
            "- a",
            "ä",
            "from_to2",
            "N",
        ] {
            let frame = Frame {
                provenance: BTreeMap::from([(key.to_owned(), "a: b".to_owned())]),
                to_from_from: Pose::identity(),
                sigma: None,
                rmsd_m: None,
                points: None,
            };
            let back = Frame::from_yaml(&frame.to_yaml());
            assert_eq!(back.expect(key).provenance, frame.provenance);
        }
    }

    #[test]
    fn a_written_frame_is_read_back_and_other_keys_are_refused() {
        let frame = Frame {
            to_from_from: Pose::from_xyz_rxryrz([0.1, -2.0, 0.3, 0.4, 0.5, -0.6]),
            sigma: Some(Sigma {
                position_m: [1e-5, 2e-5, 3e-5],
                rotation_rad: [1e-4, 2e-4, 3e-4],
            }),
            rmsd_m: Some(4e-5),
            points: Some(7),
            provenance: BTreeMap::from([("from".into(), "a: \"b\"\\c.csv".into())]),
        };
        let text = frame.to_yaml();
        let back = Frame::from_yaml(&text).expect("our own file");
        let gap = back.to_from_from.separation(&frame.to_from_from);
        assert!(gap.distance_m < 1e-15 && gap.angle_rad < 1e-15);
        assert_eq!(back.provenance, frame.provenance);
        assert_eq!(back.points, Some(7));
        let error = Frame::from_yaml(&(text.clone() + "colour: red\n")).expect_err("strict");
        assert!(
            error.line > 0 && error.message.contains("colour"),
            "{error}"
        );
        let other = text.replace("frame/1", "profile/1");
        assert!(Frame::from_yaml(&other).expect_err("strict").line == 1);
        let endless = "poseshift: frame/1\npose: {x_mm: 0, y_mm: 0, z_mm: 0, rx_deg: 1800, ry_deg: 0, \
            rz_deg: 0}\n";
        let error = Frame::from_yaml(endless).expect_err("five turns");
        assert!(error.line == 2 && error.message.contains("720"), "{error}");
        let nan = text.replace("x_mm: 100", "x_mm: .nan");
        assert!(Frame::from_yaml(&nan).is_err());
    }
}
