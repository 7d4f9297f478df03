//! The profile file as it is written: one type a block, keys with units.

use schemars::JsonSchema;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use serde_yaml::Spanned;
use std::collections::BTreeMap;

/// The format name that stands first in a profile.
pub const FORMAT: &str = "profile/1";

/// A finite number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(transparent)]
pub struct Number(pub f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = f64::deserialize(deserializer)?;
        if value.is_finite() {
            Ok(Self(value))
        } else {
            Err(D::Error::custom(format!("{value} is not a finite number")))
        }
    }
}

/// Robot profile: nominal kinematics, masses, tools and the calibration of one robot.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProfileFile {
    /// Format and version: `profile/1`.
    #[schemars(with = "String")]
    pub poseshift: Spanned<String>,
    /// Which robot.
    pub robot: RobotFile,
    /// How its controller is programmed and what it computes with.
    pub controller: ControllerFile,
    /// The nominal chain.
    pub kinematics: KinematicsFile,
    /// Masses of the links.
    #[serde(default)]
    #[schemars(with = "Vec<BodyFile>")]
    pub bodies: Vec<Spanned<BodyFile>>,
    /// Bodies of the links, for collisions.
    #[serde(default)]
    #[schemars(with = "Vec<super::shape::LinkShapeFile>")]
    pub shapes: Vec<Spanned<super::shape::LinkShapeFile>>,
    /// What stands around the arm and moves: a track that carries the base, positioners that carry
    /// work pieces.
    #[serde(default)]
    pub external_axes: super::external::ExternalFile,
    /// Gravity in the world.
    #[serde(default = "unsaid_earth")]
    #[schemars(with = "[Number; 3]", default = "earth")]
    pub gravity_m_s2: Spanned<[Number; 3]>,
    /// Tools by name.
    #[serde(default)]
    pub tools: BTreeMap<String, ToolFile>,
    /// Measured points in the tool frame by name.
    #[serde(default)]
    pub points: BTreeMap<String, [Number; 3]>,
    /// How the columns of measurements are named that are read with this profile.
    #[serde(default)]
    pub measurement: Tables,
    /// What was identified.
    #[serde(default)]
    pub calibration: CalibrationFile,
}

/// How tables of measurements name their columns, and in which units they are.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tables {
    /// Their name of each column of the format, where a file has it: `q1_deg: J1`; several where
    /// files differ.
    #[serde(default)]
    pub columns: BTreeMap<String, Theirs>,
    /// Units of these columns, as `--units` has them.
    #[serde(default)]
    pub units: Vec<String>,
    /// How angles of an orientation turn, as `--euler` has it.
    #[serde(default)]
    pub euler: Option<String>,
}

fn unsaid_earth() -> Spanned<[Number; 3]> {
    Spanned::new(
        earth(),
        serde_yaml::Location::UNKNOWN,
        serde_yaml::Location::UNKNOWN,
    )
}

pub(super) fn earth() -> [Number; 3] {
    [Number(0.0), Number(0.0), Number(-9.81)]
}

/// Which robot.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RobotFile {
    /// Maker.
    pub manufacturer: String,
    /// Type.
    pub model: String,
    /// Serial number.
    #[serde(default)]
    pub serial: Option<String>,
    /// The largest mass that the flange may carry; without it masses of tools and loads are not
    /// checked.
    #[serde(default)]
    #[schemars(with = "Option<Number>")]
    pub payload_kg: Option<Spanned<Number>>,
}

/// How the controller is programmed and what it computes with.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ControllerFile {
    /// Its programming language, as `poseshift languages` names it.
    #[serde(default)]
    #[schemars(with = "Option<String>")]
    pub language: Option<Spanned<String>>,
    /// Whether it computes with the nominal chain or with a calibrated one of its own.
    pub model: ControllerModel,
    /// What the calibrated chain of the controller has that the nominal one has not (usually
    /// `link_geometry`), in the form of `calibration.effects`. Where it is absent, a
    /// calibrated controller applies the link geometry of the calibration.
    #[serde(default)]
    #[schemars(schema_with = "effects_schema")]
    pub effects: Option<Vec<EffectFile>>,
    /// Encoder pulses of one degree of each joint, for programs that count in pulses (INFORM).
    #[serde(default)]
    #[schemars(with = "Option<[Number; 6]>")]
    pub pulses_per_deg: Option<Spanned<[Number; 6]>>,
}

/// What the controller computes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ControllerModel {
    /// The nominal chain.
    Nominal,
    /// A calibrated chain: its own where the file gives the controller's effects, else that of the
    /// calibration's link geometry.
    Calibrated,
}

/// The nominal chain.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KinematicsFile {
    /// `world_from_base`.
    #[serde(default)]
    #[schemars(with = "Option<PoseFile>")]
    pub base: Option<Spanned<PoseFile>>,
    /// Six rows of modified Denavit–Hartenberg parameters.
    #[schemars(with = "[JointFile; 6]")]
    pub joints: Spanned<Vec<Spanned<JointFile>>>,
    /// Controller joints that count another joint in.
    #[serde(default)]
    #[schemars(with = "Vec<CouplingFile>")]
    pub coupling: Vec<Spanned<CouplingFile>>,
    /// `link6_from_flange`.
    #[serde(default)]
    #[schemars(with = "Option<PoseFile>")]
    pub flange: Option<Spanned<PoseFile>>,
}

/// One row of the chain.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointFile {
    /// Angle between the axes.
    pub alpha_deg: Number,
    /// Distance of the axes.
    pub a_mm: Number,
    /// Angle where the joint stands at zero.
    pub theta_deg: Number,
    /// Distance along the axis.
    pub d_mm: Number,
    /// Smallest controller's angle.
    pub min_deg: Number,
    /// Largest controller's angle.
    pub max_deg: Number,
    /// Largest speed of the joint, for the estimate of what a programmed speed asks.
    #[serde(default)]
    pub speed_deg_s: Option<Number>,
    /// −1 where the controller counts the other way.
    #[serde(default = "plus")]
    pub sign: i8,
    /// Chain angle where the controller shows zero.
    #[serde(default)]
    pub offset_deg: Number,
}

pub(super) fn plus() -> i8 {
    1
}

/// A controller's joint that counts another joint in.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CouplingFile {
    /// The joint, from 1.
    pub joint: u8,
    /// The joint counted in, from 1.
    pub on: u8,
    /// How much of it.
    pub ratio: Number,
}

/// A pose: `Trans(x, y, z) · Rx · Ry · Rz`, or a position with a quaternion `[w, x, y, z]`.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PoseFile {
    /// Position.
    pub x_mm: Number,
    /// Position.
    pub y_mm: Number,
    /// Position.
    pub z_mm: Number,
    /// Angle about x.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rx_deg: Option<Number>,
    /// Angle about the turned y.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ry_deg: Option<Number>,
    /// Angle about the turned z.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rz_deg: Option<Number>,
    /// Orientation instead of the three angles.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quaternion: Option<[Number; 4]>,
}

/// A mass on a link.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyFile {
    /// The link, from 1.
    pub link: u8,
    /// Mass.
    #[schemars(with = "Number")]
    pub mass_kg: Spanned<Number>,
    /// Centre of gravity in the link's frame.
    pub cog_mm: [Number; 3],
    /// That the mass is meant though it is beyond what links have; stands with `reason`.
    #[serde(default)]
    #[schemars(with = "Option<bool>")]
    pub large: Option<Spanned<bool>>,
    /// Why it is meant.
    #[serde(default)]
    #[schemars(with = "Option<String>")]
    pub reason: Option<Spanned<String>>,
}

/// A tool.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToolFile {
    /// `flange_from_tool`.
    #[schemars(with = "PoseFile")]
    pub frame: Spanned<PoseFile>,
    /// Mass on the flange.
    #[serde(default)]
    #[schemars(with = "Number")]
    pub mass_kg: Option<Spanned<Number>>,
    /// Its centre of gravity in the flange frame.
    #[serde(default)]
    pub cog_mm: Option<[Number; 3]>,
}

/// An effect: its keys and values, as [`crate::model::effects::Effect::from_entry`] reads them;
/// besides them `large: true` with a `reason` where a value is beyond the usual.
pub(crate) type EffectFile = Spanned<BTreeMap<String, Spanned<serde_json::Value>>>;

/// A name, or several of which each file has one at most.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Theirs {
    /// One.
    One(String),
    /// Several.
    Many(Vec<String>),
}

impl Theirs {
    /// All of them.
    #[must_use]
    pub fn names(&self) -> &[String] {
        match self {
            Self::One(name) => std::slice::from_ref(name),
            Self::Many(names) => names,
        }
    }
}

/// What was identified.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CalibrationFile {
    /// Effects with their parameters.
    #[serde(default)]
    #[schemars(schema_with = "effects_schema")]
    pub effects: Vec<EffectFile>,
    /// Where the measuring device stood.
    #[serde(default)]
    pub world_from_device: Option<DeviceFile>,
    /// Statistics of the fit.
    #[serde(default)]
    #[schemars(with = "Option<serde_json::Value>")]
    pub quality: Option<Spanned<serde_json::Value>>,
    /// Where the calibration comes from.
    #[serde(default)]
    pub provenance: Option<serde_json::Value>,
}

/// Where the device's frame was in the controller's world when the calibration was measured. What
/// reads measurements applies it; `compensate` and `check` do not.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeviceFile {
    /// `world_from_device`.
    #[schemars(with = "PoseFile")]
    pub pose: Spanned<PoseFile>,
    /// Standard deviations of the numbers of the pose.
    #[serde(default)]
    #[schemars(with = "Option<SigmaFile>")]
    pub sigma: Option<Spanned<SigmaFile>>,
}

/// Standard deviations of the six numbers of a pose.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SigmaFile {
    /// Of `x_mm`.
    pub x_mm: Number,
    /// Of `y_mm`.
    pub y_mm: Number,
    /// Of `z_mm`.
    pub z_mm: Number,
    /// Of `rx_deg`.
    pub rx_deg: Number,
    /// Of `ry_deg`.
    pub ry_deg: Number,
    /// Of `rz_deg`.
    pub rz_deg: Number,
}

fn effects_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let schema =
        serde_json::json!({"type": "array", "items": crate::model::effects::entry_schema()});
    schema.try_into().expect("an object is a schema")
}

/// The JSON Schema of a file format whose first key names it.
#[must_use]
pub fn schema<F: JsonSchema>(format: &str) -> serde_json::Value {
    let mut schema = schemars::schema_for!(F).to_value();
    schema["title"] = format!("poseshift {format}").into();
    schema["properties"]["poseshift"] = serde_json::json!({"const": format});
    schema
}
