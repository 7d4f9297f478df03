//! The section `external_axes` of a profile: what it holds, what is wrong with it, and its text.

use super::error::{Fault, ProfileError};
use super::file::{Number, PoseFile};
use super::reading::{check_angles, pose};
use super::text::{flow_pose, number, quoted};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Vector, cross, norm, scale};
use crate::model::effects::{Effect, MOST_EXTERNAL_AXES, SiteKey};
use crate::model::external::{
    Coordinates, ExternalAxes, Follows, Listed, Positioner, RotaryAxis, TrackAxis,
};
use schemars::JsonSchema;
use serde::Deserialize;
use serde_yaml::{Location, Spanned};
use std::collections::BTreeMap;

/// Most linear axes of a track, and rotary axes of a positioner.
const MOST_TRACK: usize = 3;
const MOST_ROTARY: usize = 2;
/// A direction shorter than this, in its own unit, is none; nearer to `up` than this its sides are
/// not known.
const LEAST: f64 = 1e-6;
const LEAST_SINE: f64 = 0.1;
/// No axis is longer, mm, and none goes farther round, degrees.
const MOST_MM: f64 = 1e6;
const MOST_DEG: f64 = 1e6;

/// What stands around the arm and moves: a track that carries the base, positioners that carry work
/// pieces.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExternalFile {
    /// Linear axes that carry the base, from the floor up: one of a track, two or three of a
    /// gantry.
    #[serde(default)]
    #[schemars(with = "Vec<TrackAxisFile>")]
    pub track: Vec<Spanned<TrackAxisFile>>,
    /// What carries work pieces.
    #[serde(default)]
    #[schemars(with = "Vec<PositionerFile>")]
    pub positioners: Vec<Spanned<PositionerFile>>,
    /// Axes that move nothing a pose depends on, by their names in programs.
    #[serde(default)]
    #[schemars(with = "Vec<String>")]
    pub other: Vec<Spanned<String>>,
}

/// A linear axis that carries the base.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TrackAxisFile {
    /// Its name in programs: `eax_a`…`eax_f`, `E1`…`E6`, `BC1`…
    pub axis: String,
    /// Its direction in the world, as the controller has it; of any length.
    pub direction: [Number; 3],
    /// Roughly up, in the world.
    #[serde(default = "up")]
    pub up: [Number; 3],
    /// Its value where the base stands as `kinematics.base` says.
    #[serde(default)]
    pub zero_mm: Number,
    /// Smallest value.
    pub min_mm: Number,
    /// Largest value.
    pub max_mm: Number,
    /// `world`: the controller's poses include the axis; `base`: they do not, and work frames ride
    /// along.
    #[serde(default)]
    pub coordinates: CoordinatesFile,
    /// Encoder pulses of one millimetre, for programs that count in pulses (INFORM).
    #[serde(default)]
    pub pulses_per_mm: Option<Number>,
}

/// What the controller's poses are relative to.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CoordinatesFile {
    /// The world.
    #[default]
    World,
    /// The base.
    Base,
}

/// What carries a work piece.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PositionerFile {
    /// Its name in programs: the unit of RAPID, the machine of KRL or its number, `ST1` of INFORM.
    pub name: String,
    /// Which work frames it carries: `frame`, those of which the program says so; `always`;
    /// `never`.
    #[serde(default)]
    pub follows: FollowsFile,
    /// Its rotary axes.
    #[schemars(with = "Vec<RotaryAxisFile>")]
    pub axes: Vec<Spanned<RotaryAxisFile>>,
    /// The plate on the last axis.
    #[serde(default)]
    #[schemars(with = "Option<PoseFile>")]
    pub plate: Option<Spanned<PoseFile>>,
    /// Measured points in the plate's frame by name.
    #[serde(default)]
    pub points: BTreeMap<String, [Number; 3]>,
}

/// Which work frames a positioner carries.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FollowsFile {
    /// Those of which the program says so.
    #[default]
    Frame,
    /// All.
    Always,
    /// None: it moves nothing that a pose depends on.
    Never,
}

/// A rotary axis of a positioner.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RotaryAxisFile {
    /// Its name in programs.
    pub axis: String,
    /// Where it is: the first in the world, another in the frame of the axis before at its zero; z
    /// is the axis.
    #[schemars(with = "PoseFile")]
    pub at: Spanned<PoseFile>,
    /// −1 where the controller counts the other way.
    #[serde(default = "super::file::plus")]
    pub sign: i8,
    /// Its value at zero.
    #[serde(default)]
    pub zero_deg: Number,
    /// Smallest value.
    pub min_deg: Number,
    /// Largest value.
    pub max_deg: Number,
    /// Encoder pulses of one degree, for programs that count in pulses (INFORM).
    #[serde(default)]
    pub pulses_per_deg: Option<Number>,
}

fn up() -> [Number; 3] {
    [Number(0.0), Number(0.0), Number(1.0)]
}

fn positive(
    key: &'static str,
    value: Option<Number>,
    at: Location,
) -> Result<Option<f64>, ProfileError> {
    match value {
        Some(Number(found)) if found <= 0.0 => Err(Fault::NotPositive { key, found }.at(at)),
        value => Ok(value.map(|n| n.0)),
    }
}

fn within(key: &'static str, found: f64, most: f64, at: Location) -> Result<(), ProfileError> {
    if found.abs() <= most {
        return Ok(());
    }
    let (low, high) = (-most, most);
    Err(Fault::OutOfRange {
        key,
        found,
        low,
        high,
    }
    .at(at))
}

impl ExternalFile {
    /// What it means.
    ///
    /// # Errors
    /// A direction that is none, limits the wrong way round, too many axes or none, a name that
    /// stands twice.
    pub(super) fn read(self) -> Result<ExternalAxes, ProfileError> {
        let mut names: Vec<(String, Location)> = Vec::new();
        let mut track = Vec::new();
        for entry in self.track {
            let at = entry.defined;
            if track.len() == MOST_TRACK {
                let (what, most) = ("linear axes of a track", MOST_TRACK);
                return Err(Fault::TooManyAxes { what, most }.at(at));
            }
            names.push((entry.value.axis.clone(), at));
            track.push(linear(entry.value, at)?);
        }
        let mut positioners: Vec<Positioner> = Vec::new();
        for entry in self.positioners {
            let (at, file) = (entry.defined, entry.value);
            let is_same = |other: &Positioner| other.name.eq_ignore_ascii_case(&file.name);
            if file.name.trim().is_empty() || positioners.iter().any(is_same) {
                return Err(Fault::AxisName { name: file.name }.at(at));
            }
            let is_always = |follows: &Follows| *follows == Follows::Always;
            let mut before = positioners.iter();
            if let (FollowsFile::Always, Some(other)) =
                (file.follows, before.find(|other| is_always(&other.follows)))
            {
                let (name, other) = (file.name, other.name.clone());
                return Err(Fault::SecondAlways { name, other }.at(at));
            }
            if file.axes.is_empty() {
                return Err(Fault::NoAxis { name: file.name }.at(at));
            }
            let mut axes = Vec::new();
            for entry in file.axes {
                let at = entry.defined;
                if axes.len() == MOST_ROTARY {
                    let (what, most) = ("rotary axes of a positioner", MOST_ROTARY);
                    return Err(Fault::TooManyAxes { what, most }.at(at));
                }
                names.push((entry.value.axis.clone(), at));
                axes.push(rotary(entry.value, at)?);
            }
            if let Some(plate) = &file.plate {
                check_angles(plate)?;
            }
            positioners.push(Positioner {
                name: file.name,
                follows: match file.follows {
                    FollowsFile::Frame => Follows::Frame,
                    FollowsFile::Always => Follows::Always,
                    FollowsFile::Never => Follows::Never,
                },
                axes,
                plate: file.plate.as_ref().map_or(Ok(Pose::identity()), pose)?,
                points: points(&file.points, at)?,
            });
        }
        names.extend(
            self.other
                .iter()
                .map(|name| (name.value.clone(), name.defined)),
        );
        for (n, (name, at)) in names.iter().enumerate() {
            let again = names[..n]
                .iter()
                .any(|(other, _)| other.eq_ignore_ascii_case(name));
            if again || name.trim().is_empty() {
                return Err(Fault::AxisName { name: name.clone() }.at(*at));
            }
        }
        let axes = ExternalAxes {
            track,
            positioners,
            other: self.other.into_iter().map(|name| name.value).collect(),
        };
        let count = axes.listed().count();
        if let (true, Some((_, at))) = (count > MOST_EXTERNAL_AXES as usize, names.last()) {
            let (what, most) = ("external axes", MOST_EXTERNAL_AXES as usize);
            return Err(Fault::TooManyAxes { what, most }.at(*at));
        }
        Ok(axes)
    }
}

fn points(
    file: &BTreeMap<String, [Number; 3]>,
    at: Location,
) -> Result<BTreeMap<String, Vector>, ProfileError> {
    let each = file.iter().map(|(name, point)| {
        for number in point {
            within("points", number.0, MOST_MM, at)?;
        }
        Ok((name.clone(), point.map(|n| m_from_mm(n.0))))
    });
    each.collect()
}

fn linear(file: TrackAxisFile, at: Location) -> Result<TrackAxis, ProfileError> {
    let [direction, up]: [Vector; 2] = [file.direction, file.up].map(|v| v.map(|n| n.0));
    for (key, vector) in [("direction", direction), ("up", up)] {
        if norm(vector) < LEAST {
            return Err(Fault::NoDirection { key }.at(at));
        }
    }
    let direction = scale(1.0 / norm(direction), direction);
    let up = scale(1.0 / norm(up), up);
    if norm(cross(up, direction)) < LEAST_SINE {
        return Err(Fault::UpAlong.at(at));
    }
    let (min, max) = (file.min_mm.0, file.max_mm.0);
    for (key, found) in [
        ("zero_mm", file.zero_mm.0),
        ("min_mm", min),
        ("max_mm", max),
    ] {
        within(key, found, MOST_MM, at)?;
    }
    if min >= max {
        return Err(Fault::LimitsMm { min, max }.at(at));
    }
    Ok(TrackAxis {
        axis: file.axis,
        direction,
        up,
        zero_m: m_from_mm(file.zero_mm.0),
        min_m: m_from_mm(min),
        max_m: m_from_mm(max),
        coordinates: match file.coordinates {
            CoordinatesFile::World => Coordinates::World,
            CoordinatesFile::Base => Coordinates::Base,
        },
        pulses_per_mm: positive("pulses_per_mm", file.pulses_per_mm, at)?,
    })
}

fn rotary(file: RotaryAxisFile, at: Location) -> Result<RotaryAxis, ProfileError> {
    if file.sign.abs() != 1 {
        return Err(Fault::Sign { found: file.sign }.at(at));
    }
    let (min, max) = (file.min_deg.0, file.max_deg.0);
    for (key, found) in [
        ("zero_deg", file.zero_deg.0),
        ("min_deg", min),
        ("max_deg", max),
    ] {
        within(key, found, MOST_DEG, at)?;
    }
    if min >= max {
        return Err(Fault::Limits { min, max }.at(at));
    }
    check_angles(&file.at)?;
    Ok(RotaryAxis {
        axis: file.axis,
        at: pose(&file.at)?,
        sign: f64::from(file.sign),
        zero_rad: file.zero_deg.0 * DEG,
        min_rad: min * DEG,
        max_rad: max * DEG,
        pulses_per_deg: positive("pulses_per_deg", file.pulses_per_deg, at)?,
    })
}

/// Whether an effect is of none of the external axes, or of one that is listed.
#[must_use]
pub fn is_of_profile(effect: &Effect, axes: &ExternalAxes) -> bool {
    check_effect(effect, axes).is_none()
}

/// What is wrong with an effect of an external axis: there is no such axis, or it is of the other
/// kind.
pub(super) fn check_effect(effect: &Effect, axes: &ExternalAxes) -> Option<Fault> {
    if !effect.definition().site.contains(&SiteKey::Axis) {
        return None;
    }
    let id = effect.definition().id;
    let axis = effect.site.index + 1;
    let found = axes.listed().nth(effect.site.index);
    let needs = match id {
        _ if id.starts_with("track_") => "a linear axis of the track",
        "positioner_plate" => "the last axis of a positioner",
        _ => "an axis of a positioner",
    };
    let fits = match found {
        None => false,
        Some(Listed::Track(_)) => id.starts_with("track_"),
        Some(Listed::Rotary(_, _, last)) => {
            id.starts_with("positioner_") && (last || id != "positioner_plate")
        }
    };
    (!fits).then(|| Fault::NoSuchAxis {
        label: effect.label(),
        axis,
        needs,
        listed: axes.listed().map(|axis| axis.name().to_owned()).collect(),
    })
}

/// The section's text; empty where nothing moves.
pub(crate) fn section(axes: &ExternalAxes) -> String {
    if axes.is_empty() {
        return String::new();
    }
    let mut out = "external_axes:\n".to_owned();
    if !axes.track.is_empty() {
        out += "  track:\n";
    }
    let numbers = |v: Vector| v.map(number).join(", ");
    for axis in &axes.track {
        let mm = |m: f64| number(mm_from_m(m));
        out += &format!(
            "    - {{axis: {}, direction: [{}], up: [{}], zero_mm: {}, min_mm: {}, max_mm: {}, \
             coordinates: {}",
            quoted(&axis.axis),
            numbers(axis.direction),
            numbers(axis.up),
            mm(axis.zero_m),
            mm(axis.min_m),
            mm(axis.max_m),
            match axis.coordinates {
                Coordinates::World => "world",
                Coordinates::Base => "base",
            }
        );
        if let Some(pulses) = axis.pulses_per_mm {
            out += &format!(", pulses_per_mm: {}", number(pulses));
        }
        out += "}\n";
    }
    if !axes.positioners.is_empty() {
        out += "  positioners:\n";
    }
    for positioner in &axes.positioners {
        out += &format!(
            "    - name: {}\n      follows: {}\n      axes:\n",
            quoted(&positioner.name),
            match positioner.follows {
                Follows::Frame => "frame",
                Follows::Always => "always",
                Follows::Never => "never",
            }
        );
        for axis in &positioner.axes {
            let deg = |rad: f64| number(rad / DEG);
            out += &format!(
                "        - {{axis: {}, at: {}, sign: {}, zero_deg: {}, min_deg: {}, max_deg: {}",
                quoted(&axis.axis),
                flow_pose(&axis.at),
                axis.sign,
                deg(axis.zero_rad),
                deg(axis.min_rad),
                deg(axis.max_rad)
            );
            if let Some(pulses) = axis.pulses_per_deg {
                out += &format!(", pulses_per_deg: {}", number(pulses));
            }
            out += "}\n";
        }
        out += &format!("      plate: {}\n", flow_pose(&positioner.plate));
        if !positioner.points.is_empty() {
            out += "      points:\n";
        }
        for (name, point) in &positioner.points {
            let numbers = numbers(point.map(mm_from_m));
            out += &format!("        {}: [{numbers}]\n", quoted(name));
        }
    }
    if !axes.other.is_empty() {
        let names: Vec<String> = axes.other.iter().map(|name| quoted(name)).collect();
        out += &format!("  other: [{}]\n", names.join(", "));
    }
    out
}
