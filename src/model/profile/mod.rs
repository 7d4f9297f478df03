//! A robot's profile: read strictly, and made into models.

mod catalogue;
mod device;
mod edit;
mod error;
pub(crate) mod external;
pub(crate) mod file;
mod makers;
mod rewrite;
pub(crate) mod shape;
mod shipped;
mod text;
pub mod universal_robots;
mod write;

pub use catalogue::{CatalogueArm, catalogue};
pub(crate) use catalogue::{coupled, flange_remark};
pub use device::DevicePlace;
pub use edit::{EditError, with_value};
pub use error::{Fault, ProfileError};
pub use external::is_of_profile;
pub use file::{ControllerModel, FORMAT, ProfileFile, Tables, Theirs};
pub use makers::{MAKERS, Maker};
pub use rewrite::{with_controller, with_external};
pub use shipped::SHIPPED;
pub(crate) use text::flow_pose;
pub(crate) use text::flow_tool;
pub use text::{Comments, made};
pub use write::{WriteError, rewritten};

use super::effects::{Effect, Kind, Need};
use super::external::{Carried, ExternalAxes, Stand};
use super::shape::{Form, LinkShape};
use super::{Body, Conditions, Coupling, Geometry, JointSense, Link, Mechanism, Model};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Quaternion, Vector};
pub(crate) use file::{Number, PoseFile};
use serde_yaml::{Location, Spanned};
use std::collections::BTreeMap;

/// How far a quaternion's length may be from 1.
const UNIT_TOLERANCE: f64 = 1e-3;
/// A tool that is nearer to the flange in each coordinate is in another unit, or none.
const TINY_M: f64 = 1e-3;
/// Lengths below this are zero.
const NO_LENGTH_M: f64 = 1e-9;
/// No frame is rotated by more: two whole revolutions.
const MOST_ANGLE_DEG: f64 = 720.0;

/// One robot: its nominal arm, tools, and what was identified of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Maker.
    pub manufacturer: String,
    /// Type.
    pub model: String,
    /// Serial number.
    pub serial: Option<String>,
    /// The largest mass that the flange may carry, where the file gives it.
    pub payload_kg: Option<f64>,
    /// Programming language of the controller.
    pub language: Option<String>,
    /// What the controller computes with.
    pub controller: ControllerModel,
    /// The effects of the controller's own calibrated chain, where the file gives them.
    pub own_effects: Option<Vec<Effect>>,
    /// Encoder pulses of one degree of each joint, for programs that count in pulses.
    pub pulses_per_deg: Option<[f64; 6]>,
    /// Where the base stands.
    pub world_from_base: Pose,
    /// The nominal rows of the chain.
    pub links: [Link; 6],
    /// How the controller counts joint angles.
    pub mechanism: Mechanism,
    /// Largest speed of each joint where it is given, rad/s.
    pub joint_speeds: [Option<f64>; 6],
    /// The flange on the last link.
    pub link6_from_flange: Pose,
    /// Masses of the links.
    pub bodies: Vec<Body>,
    /// Bodies of the links, for collisions.
    pub shapes: Vec<LinkShape>,
    /// What stands around the arm and moves.
    pub external: ExternalAxes,
    /// Gravity in the world, m/s².
    pub gravity_m_s2: Vector,
    /// Tools by name.
    pub tools: BTreeMap<String, ToolOfProfile>,
    /// Measured points in the tool frame by name, metres.
    pub points: BTreeMap<String, Vector>,
    /// The identified effects.
    pub effects: Vec<Effect>,
    /// Why effects may be beyond the usual.
    pub large: Reasons,
    /// How the columns of measurements are named.
    pub tables: Tables,
    /// Where the device stood that the calibration was measured with; what reads measurements
    /// applies it.
    pub device: Option<DevicePlace>,
    /// Statistics of the calibration, as the file has them.
    pub quality: Option<serde_json::Value>,
    /// Where the calibration comes from, as the file has it.
    pub provenance: Option<serde_json::Value>,
}

/// Why effects of a profile may be beyond the usual (`large: true` with a `reason`), by
/// [`Effect::label`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reasons {
    /// Those of the controller's own chain.
    pub controller: BTreeMap<String, String>,
    /// Those of the calibration.
    pub calibration: BTreeMap<String, String>,
}

/// A tool of the profile.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolOfProfile {
    /// Where its tip is.
    pub flange_from_tool: Pose,
    /// Mass in kg and centre of gravity in the flange frame in metres.
    pub load: Option<(f64, Vector)>,
}

/// A tool to build a model with.
#[derive(Clone, Debug, PartialEq)]
pub struct Mounted {
    /// Name, for effects that belong to one tool.
    pub name: String,
    /// Where its tip is.
    pub flange_from_tool: Pose,
    /// Mass in kg and centre of gravity in the flange frame in metres.
    pub load: Option<(f64, Vector)>,
}

impl Mounted {
    /// No tool: the flange itself.
    #[must_use]
    pub fn flange() -> Self {
        Self {
            name: "flange".into(),
            flange_from_tool: Pose::identity(),
            load: None,
        }
    }
}

impl Profile {
    /// Reads a profile file's text.
    ///
    /// # Errors
    /// Anything the format does not allow, with line and column.
    pub fn from_yaml(text: &str) -> Result<Self, ProfileError> {
        let file: ProfileFile = serde_yaml::from_str(text).map_err(ProfileError::from)?;
        Self::from_file(file)
    }

    /// A nominal arm of these rows that stands at the world's origin, without anything else.
    #[must_use]
    pub fn nominal(links: [Link; 6], mechanism: Mechanism) -> Self {
        Self {
            manufacturer: "unknown".into(),
            model: "unknown".into(),
            serial: None,
            payload_kg: None,
            language: None,
            controller: ControllerModel::Nominal,
            own_effects: None,
            pulses_per_deg: None,
            world_from_base: Pose::identity(),
            links,
            mechanism,
            joint_speeds: [None; 6],
            link6_from_flange: Pose::identity(),
            bodies: Vec::new(),
            shapes: Vec::new(),
            external: ExternalAxes::default(),
            gravity_m_s2: file::earth().map(|n| n.0),
            tools: BTreeMap::new(),
            points: BTreeMap::new(),
            effects: Vec::new(),
            large: Reasons::default(),
            tables: Tables::default(),
            device: None,
            quality: None,
            provenance: None,
        }
    }

    fn from_file(file: ProfileFile) -> Result<Self, ProfileError> {
        if file.poseshift.value != FORMAT {
            return Err(Fault::Format {
                found: file.poseshift.value,
                reads: FORMAT,
            }
            .at(file.poseshift.defined));
        }
        let kinematics = file.kinematics;
        let mut large = Reasons::default();
        let external = file.external_axes.read()?;
        let own_effects = own_effects(
            file.controller.model,
            file.controller.effects,
            &mut large.controller,
            &external,
        )?;
        let payload_kg = match file.robot.payload_kg {
            Some(kg) if kg.value.0 <= 0.0 => {
                let (key, found) = ("payload_kg", kg.value.0);
                return Err(Fault::NotPositive { key, found }.at(kg.defined));
            }
            kg => kg.map(|kg| kg.value.0),
        };
        let mut bodies = Vec::new();
        for body in &file.bodies {
            let at = body.defined;
            let body = &body.value;
            let mass_kg = mass(body.mass_kg, at)?;
            bodies.push(Body {
                link: index("link", body.link, at)?,
                mass_kg,
                cog_m: metres(body.cog_mm),
            });
        }
        let shapes = shapes(&file.shapes)?;
        let mut tools = BTreeMap::new();
        for (name, tool) in file.tools {
            let load = match (tool.mass_kg, tool.cog_mm) {
                (Some(kg), cog) => {
                    if let Some(payload) = payload_kg.filter(|most| kg.value.0 > *most) {
                        let (tool, found) = (name, kg.value.0);
                        return Err(Fault::BeyondPayload {
                            tool,
                            found,
                            payload,
                        }
                        .at(kg.defined));
                    }
                    Some((mass(kg.value, kg.defined)?, cog.map_or([0.0; 3], metres)))
                }
                (None, Some(_)) => {
                    return Err(Fault::CogWithoutMass { tool: name }.at(tool.frame.defined));
                }
                (None, None) => None,
            };
            let flange_from_tool = pose(&tool.frame)?;
            check_angles(&tool.frame)?;
            if is_tiny(&flange_from_tool) {
                let largest = flange_from_tool
                    .translation
                    .iter()
                    .fold(0.0, |most: f64, m| most.max(m.abs()));
                return Err(Fault::TinyTool {
                    tool: name,
                    largest_mm: mm_from_m(largest),
                }
                .at(tool.frame.defined));
            }
            tools.insert(
                name,
                ToolOfProfile {
                    flange_from_tool,
                    load,
                },
            );
        }
        for frame in kinematics.base.iter().chain(&kinematics.flange) {
            check_angles(frame)?;
        }
        let (links, joints) = rows(&kinematics.joints)?;
        let mut joint_speeds = [None; 6];
        for (speed, joint) in joint_speeds.iter_mut().zip(&kinematics.joints.value) {
            if let Some(number) = joint.value.speed_deg_s {
                if number.0 <= 0.0 {
                    let found = number.0;
                    let key = "speed_deg_s";
                    return Err(Fault::NotPositive { key, found }.at(joint.defined));
                }
                *speed = Some(number.0 * DEG);
            }
        }
        let profile = Self {
            manufacturer: file.robot.manufacturer,
            model: file.robot.model,
            serial: file.robot.serial,
            payload_kg,
            language: file.controller.language.map(|language| language.value),
            controller: file.controller.model,
            own_effects,
            pulses_per_deg: file
                .controller
                .pulses_per_deg
                .map(|pulses| pulses.map(|n| n.0)),
            world_from_base: kinematics
                .base
                .as_ref()
                .map_or(Ok(Pose::identity()), pose)?,
            links,
            joint_speeds,
            mechanism: Mechanism {
                joints,
                coupling: couplings(&kinematics.coupling)?,
            },
            link6_from_flange: kinematics
                .flange
                .as_ref()
                .map_or(Ok(Pose::identity()), pose)?,
            bodies,
            shapes,
            gravity_m_s2: file.gravity_m_s2.map(|n| n.0),
            tools,
            points: file
                .points
                .into_iter()
                .map(|(name, point)| (name, metres(point)))
                .collect(),
            effects: effects(file.calibration.effects, &mut large.calibration, &external)?,
            large,
            tables: file.measurement,
            device: file
                .calibration
                .world_from_device
                .as_ref()
                .map(DevicePlace::from_file)
                .transpose()?,
            quality: file.calibration.quality,
            provenance: file.calibration.provenance,
            external,
        };
        Ok(profile)
    }

    /// The JSON Schema of the format.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        file::schema::<ProfileFile>(FORMAT)
    }

    /// The tool of this name ready to be mounted.
    #[must_use]
    pub fn tool(&self, name: &str) -> Option<Mounted> {
        let tool = self.tools.get(name)?;
        Some(Mounted {
            name: name.into(),
            flange_from_tool: tool.flange_from_tool,
            load: tool.load,
        })
    }

    /// The nominal arm with a tool.
    #[must_use]
    pub fn geometry(&self, tool: &Mounted) -> Geometry {
        Geometry {
            world_from_base: self.world_from_base,
            links: self.links,
            link6_from_flange: self.link6_from_flange,
            flange_from_tool: tool.flange_from_tool,
            flange_from_nominal_tool: tool.flange_from_tool,
            bodies: self.bodies.clone(),
            load: tool.load,
            gravity_m_s2: self.gravity_m_s2,
            tool_name: tool.name.clone(),
            carried: None,
        }
    }

    /// What carries the base where external axes stand so; `None` without a track, and where
    /// nothing is said of them. `with_base`: the track goes along with the base, wherever that
    /// is seen.
    #[must_use]
    pub fn carried(&self, stand: &Stand, with_base: bool) -> Option<Carried> {
        let is_carried = !self.external.track.is_empty() && !stand.values.is_empty();
        is_carried.then(|| Carried {
            axes: self.external.clone(),
            stand: stand.clone(),
            origin: self.world_from_base.translation,
            home: with_base.then(|| self.world_from_real_base()),
        })
    }

    /// The effects that the controller already applies itself: those of its own calibrated chain;
    /// where the profile does not give them, the link geometry of the calibration.
    #[must_use]
    pub fn controller_effects(&self) -> Vec<Effect> {
        match (self.controller, &self.own_effects) {
            (ControllerModel::Nominal, _) => Vec::new(),
            (ControllerModel::Calibrated, Some(effects)) => effects.clone(),
            (ControllerModel::Calibrated, None) => self
                .effects
                .iter()
                .filter(|effect| effect.kind == Kind::LinkGeometry)
                .cloned()
                .collect(),
        }
    }

    /// The effects of the arm as it really is: those of the calibration. Where there are none,
    /// nothing better is known than what the controller computes with.
    #[must_use]
    pub fn real_effects(&self) -> Vec<Effect> {
        if self.effects.is_empty() {
            self.controller_effects()
        } else {
            self.effects.clone()
        }
    }

    /// The arm as the controller computes with it.
    #[must_use]
    pub fn controller_model(&self, tool: &Mounted) -> Model {
        Model::build(
            &self.geometry(tool),
            &self.mechanism,
            &self.controller_effects(),
            &Conditions::default(),
        )
    }

    /// The arm as it really is, with the base where it stands at home.
    #[must_use]
    pub fn real_model(&self, tool: &Mounted, conditions: &Conditions) -> Model {
        self.real_model_at(tool, conditions, &Stand::default())
    }

    /// The arm as it really is where external axes stand so.
    #[must_use]
    pub fn real_model_at(&self, tool: &Mounted, conditions: &Conditions, stand: &Stand) -> Model {
        let geometry = Geometry {
            carried: self.carried(stand, false),
            ..self.geometry(tool)
        };
        Model::build(&geometry, &self.mechanism, &self.real_effects(), conditions)
    }
}

fn shapes(entries: &[Spanned<shape::LinkShapeFile>]) -> Result<Vec<LinkShape>, ProfileError> {
    let read = |entry: &Spanned<shape::LinkShapeFile>| {
        let (at, file) = (entry.defined, &entry.value);
        if file.link > 6 {
            return Err(Fault::OutOfRange {
                key: "link",
                found: f64::from(file.link),
                low: 0.0,
                high: 6.0,
            }
            .at(at));
        }
        let shape = file.shape(at)?;
        if matches!(shape.form, Form::Plane { .. }) {
            let name = format!("link {}", file.link);
            return Err(Fault::MovingPlane { name }.at(at));
        }
        Ok(LinkShape {
            link: usize::from(file.link),
            shape,
        })
    };
    entries.iter().map(read).collect()
}

fn metres(mm: [Number; 3]) -> Vector {
    mm.map(|n| m_from_mm(n.0))
}

fn index(key: &'static str, number: u8, at: Location) -> Result<usize, ProfileError> {
    match number {
        1..=6 => Ok(usize::from(number) - 1),
        _ => Err(Fault::OutOfRange {
            key,
            found: f64::from(number),
            low: 1.0,
            high: 6.0,
        }
        .at(at)),
    }
}

fn mass(kg: Number, at: Location) -> Result<f64, ProfileError> {
    if kg.0 < 0.0 {
        return Err(Fault::OutOfRange {
            key: "mass_kg",
            found: kg.0,
            low: 0.0,
            high: f64::INFINITY,
        }
        .at(at));
    }
    Ok(kg.0)
}

fn rows(
    joints: &Spanned<Vec<Spanned<file::JointFile>>>,
) -> Result<([Link; 6], [JointSense; 6]), ProfileError> {
    let mut rows = Vec::new();
    for joint in &joints.value {
        let (at, joint) = (joint.defined, &joint.value);
        if joint.sign.abs() != 1 {
            return Err(Fault::Sign { found: joint.sign }.at(at));
        }
        if joint.min_deg.0 >= joint.max_deg.0 {
            return Err(Fault::Limits {
                min: joint.min_deg.0,
                max: joint.max_deg.0,
            }
            .at(at));
        }
        let link = Link {
            alpha_rad: joint.alpha_deg.0 * DEG,
            a_m: m_from_mm(joint.a_mm.0),
            beta_rad: 0.0,
            theta_rad: joint.theta_deg.0 * DEG,
            d_m: m_from_mm(joint.d_mm.0),
        };
        let sense = JointSense {
            sign: f64::from(joint.sign),
            offset_rad: joint.offset_deg.0 * DEG,
            min_rad: joint.min_deg.0 * DEG,
            max_rad: joint.max_deg.0 * DEG,
        };
        rows.push((link, sense));
    }
    let six: [_; 6] = rows
        .try_into()
        .map_err(|rows: Vec<_>| Fault::NotSix { found: rows.len() }.at(joints.defined))?;
    Ok((six.map(|row| row.0), six.map(|row| row.1)))
}

/// The couplings in an order in which each refers only to joints whose own couplings stand before
/// it.
fn couplings(entries: &[Spanned<file::CouplingFile>]) -> Result<Vec<Coupling>, ProfileError> {
    let mut waiting = Vec::new();
    for entry in entries {
        let at = entry.defined;
        let (joint, on) = (
            index("joint", entry.value.joint, at)?,
            index("on", entry.value.on, at)?,
        );
        waiting.push((
            Coupling {
                joint,
                on,
                ratio: entry.value.ratio.0,
            },
            at,
        ));
    }
    let mut ordered = Vec::new();
    while !waiting.is_empty() {
        let free = waiting
            .iter()
            .position(|(c, _)| waiting.iter().all(|(other, _)| other.joint != c.on));
        let Some(free) = free else {
            let (coupling, at) = waiting[0];
            return Err(Fault::CircularCoupling {
                joint: coupling.joint + 1,
                on: coupling.on + 1,
            }
            .at(at));
        };
        ordered.push(waiting.remove(free).0);
    }
    Ok(ordered)
}

/// Whether a tool is off the flange, and by less than a millimetre in each coordinate: metres are
/// meant.
pub(crate) fn is_tiny(flange_from_tool: &Pose) -> bool {
    let off = flange_from_tool.translation.map(f64::abs);
    off.iter().all(|m| *m < TINY_M) && off.iter().any(|m| *m > NO_LENGTH_M)
}

/// No frame is rotated by so much.
fn check_angles(file: &Spanned<PoseFile>) -> Result<(), ProfileError> {
    let angles = [
        ("rx_deg", file.value.rx_deg),
        ("ry_deg", file.value.ry_deg),
        ("rz_deg", file.value.rz_deg),
    ];
    for (key, angle) in angles {
        if let Some(Number(found)) = angle.filter(|angle| angle.0.abs() > MOST_ANGLE_DEG) {
            let limit = MOST_ANGLE_DEG;
            return Err(Fault::EndlessAngle { key, found, limit }.at(file.defined));
        }
    }
    Ok(())
}

pub(crate) fn pose(file: &Spanned<PoseFile>) -> Result<Pose, ProfileError> {
    let p = &file.value;
    let translation = metres([p.x_mm, p.y_mm, p.z_mm]);
    match (p.rx_deg, p.ry_deg, p.rz_deg, p.quaternion) {
        (Some(rx), Some(ry), Some(rz), None) => {
            let [x, y, z] = translation;
            Ok(Pose::from_xyz_rxryrz([
                x,
                y,
                z,
                rx.0 * DEG,
                ry.0 * DEG,
                rz.0 * DEG,
            ]))
        }
        (None, None, None, Some(q)) => {
            let quaternion = Quaternion(q.map(|n| n.0));
            let norm = quaternion.norm();
            if (norm - 1.0).abs() > UNIT_TOLERANCE {
                return Err(Fault::NotUnit {
                    norm,
                    tolerance: UNIT_TOLERANCE,
                }
                .at(file.defined));
            }
            Ok(Pose::from_parts(translation, quaternion.normalized()))
        }
        _ => Err(Fault::Orientation.at(file.defined)),
    }
}

/// The effects of a controller's own chain. It knows its masses, but not how the arm came to a
/// posture.
fn own_effects(
    model: ControllerModel,
    entries: Option<Vec<file::EffectFile>>,
    large: &mut BTreeMap<String, String>,
    external: &ExternalAxes,
) -> Result<Option<Vec<Effect>>, ProfileError> {
    let Some(entries) = entries else {
        return Ok(None);
    };
    let places: Vec<Location> = entries.iter().map(|entry| entry.defined).collect();
    let effects = effects(entries, large, external)?;
    for (effect, at) in effects.iter().zip(places) {
        if model == ControllerModel::Nominal {
            return Err(Fault::EffectsOfNominal.at(at));
        }
        if effect.definition().of_external_axis() {
            return Err(Fault::NotOfController {
                label: effect.label(),
                need: "external_axes as the controller has them, which is their nominal form",
            }
            .at(at));
        }
        let needs = effect.definition().needs;
        if let Some(need) = needs.iter().find(|need| **need != Need::Masses) {
            return Err(Fault::NotOfController {
                label: effect.label(),
                need: need.describe(),
            }
            .at(at));
        }
    }
    Ok(Some(effects))
}

/// `large` takes the reasons of those that are beyond the usual.
fn effects(
    entries: Vec<file::EffectFile>,
    large: &mut BTreeMap<String, String>,
    external: &ExternalAxes,
) -> Result<Vec<Effect>, ProfileError> {
    let mut out: Vec<Effect> = Vec::new();
    for mut entry in entries {
        let says_large = entry.value.remove("large");
        let reason = entry.value.remove("reason");
        let at = entry.defined;
        let places: BTreeMap<_, _> = entry
            .value
            .iter()
            .map(|(key, value)| (key.clone(), value.defined))
            .collect();
        let map = entry
            .value
            .into_iter()
            .map(|(key, value)| (key, value.value))
            .collect();
        let effect = Effect::from_entry(&map).map_err(|error| {
            let at = error
                .key()
                .and_then(|key| places.get(key))
                .copied()
                .unwrap_or(at);
            Fault::Effect(error).at(at)
        })?;
        if effect.definition().of_data {
            let id = effect.definition().id;
            return Err(Fault::EffectOfData { id }.at(at));
        }
        if let Some(fault) = external::check_effect(&effect, external) {
            let at = places.get("axis").copied().unwrap_or(at);
            return Err(fault.at(at));
        }
        if out.iter().any(|other| other.same_place(&effect)) {
            return Err(Fault::DuplicateEffect {
                label: effect.label(),
            }
            .at(at));
        }
        let said = says_large.as_ref().map(|said| &said.value);
        let why = reason.as_ref().map(|reason| reason.value.as_str());
        let why = why.map(|why| why.filter(|why| !why.trim().is_empty()));
        match (said, why) {
            (Some(serde_json::Value::Bool(true)), Some(Some(why))) => {
                large.insert(effect.label(), why.to_owned());
            }
            (None | Some(serde_json::Value::Bool(false)), None) => {
                if let Some((parameter, found, limit)) = effect.beyond_usual() {
                    let at = places.get(parameter.key).copied().unwrap_or(at);
                    return Err(Fault::Large {
                        label: effect.label(),
                        key: parameter.key,
                        found,
                        limit,
                        unit: parameter.unit.symbol(),
                    }
                    .at(at));
                }
            }
            _ => {
                let place = says_large.or(reason).map_or(at, |said| said.defined);
                return Err(Fault::LargeWithoutReason {
                    label: effect.label(),
                }
                .at(place));
            }
        }
        out.push(effect);
    }
    Ok(out)
}

#[cfg(test)]
mod tests;
