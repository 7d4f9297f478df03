//! From a profile's file to the robot, every number judged.

use super::external;
use super::file::{self, ControllerModel, FORMAT, Number, PoseFile, ProfileFile};
use super::shape;
use super::{DevicePlace, Fault, Profile, ProfileError, Reasons, ToolOfProfile, is_tiny};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Quaternion, Vector, norm};
use crate::model::effects::{Effect, Need, same_tool};
use crate::model::external::ExternalAxes;
use crate::model::shape::{Form, LinkShape};
use crate::model::{Body, Coupling, JointSense, Link, Mechanism};
use serde_yaml::{Location, Spanned};
use std::collections::BTreeMap;

/// How far a quaternion's length may be from 1.
const UNIT_TOLERANCE: f64 = 1e-3;
/// Gravity on Earth, m/s².
const GRAVITY_M_S2: [f64; 2] = [9.7, 9.9];
/// No joint has limits beyond these: ten revolutions.
const MOST_LIMIT_DEG: f64 = 3600.0;
/// No arm or tool is longer.
const MOST_MM: f64 = 20_000.0;
/// No link or tool is heavier, kg.
const MOST_MASS_KG: f64 = 1e4;
/// The heaviest arms, for 2.3 t, have 11 t with their pedestals, and none of their links half of it.
pub(super) const HEAVY_KG: f64 = 5e3;
/// And none has its centre of gravity farther away.
const MOST_COG_MM: f64 = 1e6;
/// No arm is shorter, all its rows together.
const LEAST_ARM_MM: f64 = 20.0;
/// No base, flange or body is farther away.
pub(super) const MOST_FAR_MM: f64 = 1e6;
/// Rows of nearly parallel axes may be very far from each other.
const MOST_D_MM: f64 = 1e8;
/// No encoder has more pulses for a degree of its joint.
const MOST_PULSES: f64 = 1e6;
/// How many times the lengths of all rows the centre of gravity of a body or load may be away.
pub(super) const MOST_REACHES: f64 = 2.0;
/// No frame is rotated by more: two whole revolutions.
const MOST_ANGLE_DEG: f64 = 720.0;

impl Profile {
    pub(super) fn from_file(file: ProfileFile) -> Result<Self, ProfileError> {
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
        let payload_kg = match file.robot.payload_kg {
            Some(kg) if kg.value.0 <= 0.0 => {
                let (key, found) = ("payload_kg", kg.value.0);
                return Err(Fault::NotPositive { key, found }.at(kg.defined));
            }
            kg => kg.map(|kg| kg.value.0),
        };
        let bodies: Vec<Body> = file.bodies.iter().map(body).collect::<Result<_, _>>()?;
        // a wrist's own may be near its axes, those of all links are not
        let farthest = bodies
            .iter()
            .flat_map(|body| body.cog_m)
            .fold(0.0, |most: f64, m| most.max(m.abs()));
        if let Some(first) = file
            .bodies
            .first()
            .filter(|_| is_tiny(&[farthest, 0.0, 0.0]))
        {
            return Err(Fault::TinyCog {
                of: "all bodies".into(),
                largest_mm: mm_from_m(farthest),
            }
            .at(first.defined));
        }
        let shapes = shapes(&file.shapes)?;
        let mut tools: BTreeMap<String, ToolOfProfile> = BTreeMap::new();
        for (name, tool) in file.tools {
            if let Some(other) = tools.keys().find(|other| same_tool(other, &name)) {
                let other: String = other.clone();
                return Err(Fault::SameTool { name, other }.at(tool.frame.defined));
            }
            let load = match (tool.mass_kg, tool.cog_mm) {
                (Some(kg), cog_mm) => {
                    if let Some(payload) = payload_kg.filter(|most| kg.value.0 > *most) {
                        let (tool, found) = (name, kg.value.0);
                        return Err(Fault::BeyondPayload {
                            tool,
                            found,
                            payload,
                        }
                        .at(kg.defined));
                    }
                    let cog_m = cog_mm.map_or(Ok([0.0; 3]), |mm| cog(mm, tool.frame.defined))?;
                    Some((mass(kg.value, kg.defined)?, cog_m))
                }
                (None, Some(_)) => {
                    return Err(Fault::CogWithoutMass { tool: name }.at(tool.frame.defined));
                }
                (None, None) => None,
            };
            let flange_from_tool = pose(&tool.frame)?;
            check_angles(&tool.frame)?;
            check_lengths(&tool.frame, MOST_MM)?;
            if let Some((_, cog_m)) = load.filter(|(_, cog_m)| is_tiny(cog_m)) {
                let largest = cog_m.iter().fold(0.0, |most: f64, m| most.max(m.abs()));
                return Err(Fault::TinyCog {
                    of: format!("tool `{name}`"),
                    largest_mm: mm_from_m(largest),
                }
                .at(tool.frame.defined));
            }
            if is_tiny(&flange_from_tool.translation) {
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
        let beyond = |effect: &Effect| beyond_payload(payload_kg, &tools, effect);
        let own_effects = own_effects(
            file.controller.model,
            file.controller.effects,
            &mut large.controller,
            (&external, &beyond),
        )?;
        let calibrated = effects(
            file.calibration.effects,
            &mut large.calibration,
            (&external, &beyond),
        )?;
        for frame in kinematics.base.iter().chain(&kinematics.flange) {
            check_angles(frame)?;
            check_lengths(frame, MOST_FAR_MM)?;
        }
        let (links, joints) = rows(&kinematics.joints)?;
        let reach_mm = mm_from_m(reach_m(&links));
        for body in &file.bodies {
            for number in body.value.cog_mm {
                within("cog_mm", number, MOST_REACHES * reach_mm, body.defined)?;
            }
        }
        if let Some(pulses) = &file.controller.pulses_per_deg {
            for number in pulses.value {
                within("pulses_per_deg", number, MOST_PULSES, pulses.defined)?;
            }
        }
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
                .map(|pulses| pulses.value.map(|n| n.0)),
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
            gravity_m_s2: gravity(&file.gravity_m_s2)?,
            tools,
            points: file
                .points
                .into_iter()
                .map(|(name, point)| (name, metres(point)))
                .collect(),
            effects: calibrated,
            large,
            tables: file.measurement,
            device: file
                .calibration
                .world_from_device
                .as_ref()
                .map(DevicePlace::from_file)
                .transpose()?,
            quality: file.calibration.quality.map(quality).transpose()?,
            provenance: file.calibration.provenance,
            external,
        };
        Ok(profile)
    }
}

/// A block `quality` that may be believed.
fn quality(block: Spanned<serde_json::Value>) -> Result<serde_json::Value, ProfileError> {
    match super::quality::fault(&block.value) {
        Some(message) => Err(Fault::Quality { message }.at(block.defined)),
        None => Ok(block.value),
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

/// Gravity as the file has it: that of the Earth in any direction, or none.
fn gravity(file: &Spanned<[Number; 3]>) -> Result<Vector, ProfileError> {
    let gravity = file.value.map(|n| n.0);
    let [low, high] = GRAVITY_M_S2;
    let found = norm(gravity);
    if found != 0.0 && !(low..=high).contains(&found) {
        return Err(Fault::Gravity { found, low, high }.at(file.defined));
    }
    Ok(gravity)
}

/// A number of a key that may not be beyond a limit in either direction.
pub(super) fn within(
    key: &'static str,
    number: Number,
    most: f64,
    at: Location,
) -> Result<(), ProfileError> {
    if number.0.abs() > most {
        return Err(Fault::OutOfRange {
            key,
            found: number.0,
            low: -most,
            high: most,
        }
        .at(at));
    }
    Ok(())
}

/// The lengths of all rows together.
pub(super) fn reach_m(links: &[Link; 6]) -> f64 {
    links
        .iter()
        .map(|link| link.a_m.abs() + link.d_m.abs())
        .sum()
}

pub(super) fn metres(mm: [Number; 3]) -> Vector {
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
    if !(0.0..=MOST_MASS_KG).contains(&kg.0) {
        return Err(Fault::OutOfRange {
            key: "mass_kg",
            found: kg.0,
            low: 0.0,
            high: MOST_MASS_KG,
        }
        .at(at));
    }
    Ok(kg.0)
}

/// A mass on a link.
fn body(entry: &Spanned<file::BodyFile>) -> Result<Body, ProfileError> {
    let (body, at) = (&entry.value, entry.defined);
    let (kg, place) = (body.mass_kg.value, body.mass_kg.defined);
    let link = index("link", body.link, at)?;
    let mass_kg = mass(kg, place)?;
    let label = || format!("body of link {}", body.link);
    let why = body.reason.as_ref();
    match (body.large.as_ref(), why) {
        (Some(large), Some(why)) if large.value && !why.value.trim().is_empty() => {}
        (None, None) if mass_kg < HEAVY_KG => {}
        (None, None) => {
            let (label, found, limit) = (label(), mass_kg, HEAVY_KG);
            return Err(Fault::HeavyBody {
                label,
                found,
                limit,
            }
            .at(place));
        }
        (large, why) => {
            let place = large.map(|large| large.defined);
            let place = place.or(why.map(|why| why.defined)).unwrap_or(at);
            return Err(Fault::LargeWithoutReason { label: label() }.at(place));
        }
    }
    Ok(Body {
        link,
        mass_kg,
        cog_m: cog(body.cog_mm, at)?,
    })
}

fn cog(mm: [Number; 3], at: Location) -> Result<Vector, ProfileError> {
    for number in mm {
        within("cog_mm", number, MOST_COG_MM, at)?;
    }
    Ok(metres(mm))
}

/// What a load comes to that an effect makes heavier than the robot carries, and how much that is,
/// kg.
pub(super) fn beyond_payload(
    payload_kg: Option<f64>,
    tools: &BTreeMap<String, ToolOfProfile>,
    effect: &Effect,
) -> Option<(f64, f64)> {
    let (payload, number) = (payload_kg?, effect.definition().search.mass?);
    let meant = tools
        .iter()
        .filter(|(name, _)| effect.site.is_of_tool(name));
    let loads = meant.filter_map(|(_, tool)| tool.load);
    let most = loads.fold(0.0, |most: f64, (kg, _)| most.max(kg));
    let added = effect.parameters[number];
    (added > 0.0 && most + added > payload).then_some((most + added, payload))
}

/// The external axes that effects may belong to, and what an effect adds to a load beyond what the
/// robot carries.
type Judges<'a> = (&'a ExternalAxes, &'a dyn Fn(&Effect) -> Option<(f64, f64)>);

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
        within("min_deg", joint.min_deg, MOST_LIMIT_DEG, at)?;
        within("max_deg", joint.max_deg, MOST_LIMIT_DEG, at)?;
        // the d of nearly parallel axes may be any
        within("a_mm", joint.a_mm, MOST_MM, at)?;
        within("d_mm", joint.d_mm, MOST_D_MM, at)?;
        for (key, angle) in [
            ("alpha_deg", joint.alpha_deg),
            ("theta_deg", joint.theta_deg),
            ("offset_deg", joint.offset_deg),
        ] {
            within(key, angle, MOST_ANGLE_DEG, at)?;
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
    let found_mm = mm_from_m(reach_m(&six.each_ref().map(|(link, _)| *link)));
    if found_mm > 0.0 && found_mm < LEAST_ARM_MM {
        let limit_mm = LEAST_ARM_MM;
        return Err(Fault::TinyArm { found_mm, limit_mm }.at(joints.defined));
    }
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
        let is_same = |(c, _): &(Coupling, _)| c.joint == joint && c.on == on;
        if waiting.iter().any(is_same) {
            return Err(Fault::DuplicateCoupling {
                joint: joint + 1,
                on: on + 1,
            }
            .at(at));
        }
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

/// No frame is rotated by so much.
///
/// # Errors
/// An angle that is, at the place of the pose.
pub fn check_angles(file: &Spanned<PoseFile>) -> Result<(), ProfileError> {
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

/// That a frame is not farther away than this in any direction.
pub(super) fn check_lengths(file: &Spanned<PoseFile>, most_mm: f64) -> Result<(), ProfileError> {
    let (at, frame) = (file.defined, &file.value);
    within("x_mm", frame.x_mm, most_mm, at)?;
    within("y_mm", frame.y_mm, most_mm, at)?;
    within("z_mm", frame.z_mm, most_mm, at)
}

/// The pose that six numbers, or three and a quaternion, of a file describe: metres.
///
/// # Errors
/// Neither form is whole, both are given, or a number is none of a pose; at the place of the pose.
pub fn pose(file: &Spanned<PoseFile>) -> Result<Pose, ProfileError> {
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
    judges: Judges,
) -> Result<Option<Vec<Effect>>, ProfileError> {
    let Some(entries) = entries else {
        return Ok(None);
    };
    let places: Vec<Location> = entries.iter().map(|entry| entry.defined).collect();
    let effects = effects(entries, large, judges)?;
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
    (external, beyond_payload): Judges,
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
                if let Some((found, payload)) = beyond_payload(&effect) {
                    let definition = effect.definition();
                    let mass = definition.search.mass.map(|n| definition.parameters[n].key);
                    let at = mass.and_then(|key| places.get(key)).copied().unwrap_or(at);
                    return Err(Fault::LoadBeyondPayload {
                        label: effect.label(),
                        found,
                        payload,
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
