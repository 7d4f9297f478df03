//! What can be wrong with a profile, and where.

use crate::model::effects::EntryError;
use crate::nearest;
use serde_yaml::Location;

/// A number of four digits with its unit, where it has one.
fn in_unit(number: f64, unit: &str) -> String {
    let number: f64 = format!("{number:.3e}").parse().unwrap_or(number);
    match unit {
        "1" => number.to_string(),
        _ => format!("{number} {unit}"),
    }
}

/// A fault at its place in the file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{line}:{column}: {fault}")]
pub struct ProfileError {
    /// Line, from 1; 0 where the parser cannot tell.
    pub line: usize,
    /// Column, from 1; 0 where the parser cannot tell.
    pub column: usize,
    /// Bytes of the text that is to blame, where they are known.
    pub span: Option<(usize, usize)>,
    /// What is wrong.
    pub fault: Fault,
}

/// What is wrong with a profile.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Fault {
    /// No YAML, an unknown or missing key, or a value of the wrong type.
    #[error("{message}")]
    Yaml {
        /// What the parser says.
        message: String,
    },
    /// Statistics of a calibration that are none.
    #[error("calibration.quality: {message}")]
    Quality {
        /// Which key, and what is wrong with it.
        message: String,
    },
    /// Not a profile, or of another version.
    #[error("format is `{found}`; this program reads `{reads}`")]
    Format {
        /// What the file says.
        found: String,
        /// What it should say.
        reads: &'static str,
    },
    /// A list of joints that are not six.
    #[error("{found} joints; a profile has 6")]
    NotSix {
        /// How many there are.
        found: usize,
    },
    /// A sign that is neither 1 nor −1.
    #[error("sign is {found}; it must be 1 or -1")]
    Sign {
        /// What the file says.
        found: i8,
    },
    /// Limits the wrong way round.
    #[error("min_deg {min} is not below max_deg {max}")]
    Limits {
        /// Lower limit, degrees.
        min: f64,
        /// Upper limit, degrees.
        max: f64,
    },
    /// Limits of a linear axis the wrong way round.
    #[error("min_mm {min} is not below max_mm {max}")]
    LimitsMm {
        /// Lower limit, mm.
        min: f64,
        /// Upper limit, mm.
        max: f64,
    },
    /// A direction of no length.
    #[error("{key} is [0, 0, 0], which is no direction")]
    NoDirection {
        /// The key.
        key: &'static str,
    },
    /// A rail of which nobody knows the sides.
    #[error("up is nearly along direction: the sides of the rail are not known")]
    UpAlong,
    /// More axes than there can be.
    #[error("too many {what}; the limit is {most}")]
    TooManyAxes {
        /// Of what.
        what: &'static str,
        /// The limit.
        most: usize,
    },
    /// A positioner that does not turn.
    #[error("positioner `{name}` has no axis")]
    NoAxis {
        /// Its name.
        name: String,
    },
    /// A second positioner that carries every work frame.
    #[error(
        "positioner `{name}` has `follows: always`, and `{other}` before it has that too; the \
         limit is one: every work frame is on it"
    )]
    SecondAlways {
        /// Its name.
        name: String,
        /// Of the one before.
        other: String,
    },
    /// An external axis or unit without a name of its own.
    #[error("the external axis or unit `{name}` has no name of its own")]
    AxisName {
        /// The name.
        name: String,
    },
    /// An effect of an external axis that is not listed, or of another kind.
    #[error("`{label}`: axis {axis} is not {needs}")]
    NoSuchAxis {
        /// The effect.
        label: String,
        /// The number, from 1.
        axis: usize,
        /// What it should be.
        needs: &'static str,
        /// Names of the listed axes in their order.
        listed: Vec<String>,
    },
    /// A number outside its range.
    #[error("{key} is {found}; it must be from {low} to {high}")]
    OutOfRange {
        /// The key.
        key: &'static str,
        /// What the file says.
        found: f64,
        /// Smallest.
        low: f64,
        /// Largest.
        high: f64,
    },
    /// Couplings that refer to each other.
    #[error("joint {joint} is coupled on joint {on}, which in the end is coupled on joint {joint}")]
    CircularCoupling {
        /// The joint.
        joint: usize,
        /// The joint counted in.
        on: usize,
    },
    /// A coupling that stands there twice.
    #[error("the coupling of joint {joint} on joint {on} stands twice in `coupling`")]
    DuplicateCoupling {
        /// The joint.
        joint: usize,
        /// The joint counted in.
        on: usize,
    },
    /// Neither three angles nor a quaternion, or both.
    #[error("a pose has either rx_deg, ry_deg and rz_deg, or quaternion: [w, x, y, z]")]
    Orientation,
    /// A quaternion that is no rotation.
    #[error("the quaternion's length is {norm:.6}; it may differ from 1 by {tolerance}")]
    NotUnit {
        /// Its length.
        norm: f64,
        /// How far it may be from 1.
        tolerance: f64,
    },
    /// A centre of gravity of nothing.
    #[error("tool `{tool}` has cog_mm but no mass_kg")]
    CogWithoutMass {
        /// The tool.
        tool: String,
    },
    /// A length that is zero or negative.
    #[error("{key} is {found}; it must be above 0")]
    NotPositive {
        /// The key.
        key: &'static str,
        /// What the file says.
        found: f64,
    },
    /// A scale of nothing.
    #[error("scale belongs to a mesh, and there is none")]
    ScaleWithoutMesh,
    /// An entry with no shape or with several.
    #[error("{found} shapes in one entry; each has exactly one")]
    NotOneShape {
        /// How many there are.
        found: usize,
    },
    /// A shape that cannot move.
    #[error("a plane cannot move: `{name}` is not fixed in the world")]
    MovingPlane {
        /// Its name or its link.
        name: String,
    },
    /// Two bodies of one name.
    #[error("two bodies are called `{name}`")]
    DuplicateBody {
        /// The name.
        name: String,
    },
    /// A name that no body has.
    #[error("no body is called `{name}`")]
    UnknownBody {
        /// The name.
        name: String,
        /// Names there are.
        known: Vec<String>,
    },
    /// A pair that says nothing, or two things.
    #[error("a pair has either clearance_mm or allow: true")]
    PairMeaning,
    /// A pair of bodies that stands twice.
    #[error("the pair of `{a}` and `{b}` stands twice: which of the two counts?")]
    PairTwice {
        /// One of them.
        a: String,
        /// The other.
        b: String,
    },
    /// A pair of bodies whose clearance never changes.
    #[error("`{a}` and `{b}` have no clearance that a program changes: {why}")]
    PairStill {
        /// One of them.
        a: String,
        /// The other.
        b: String,
        /// Why.
        why: &'static str,
    },
    /// A wrong entry in the list of effects.
    #[error(transparent)]
    Effect(EntryError),
    /// An effect of the data in a robot's profile.
    #[error("`{id}` is an effect of measurements, not of the robot: a profile cannot have it")]
    EffectOfData {
        /// Which.
        id: &'static str,
    },
    /// An effect that stands there twice.
    #[error("`{label}` stands twice in the list of effects")]
    DuplicateEffect {
        /// Which.
        label: String,
    },
    /// An effect beyond what arms have.
    #[error(
        "`{key}` of `{label}` is {}; more than {} is no error of an arm",
        in_unit(*found, unit),
        in_unit(*limit, unit)
    )]
    Large {
        /// The effect.
        label: String,
        /// The key.
        key: &'static str,
        /// What the file says.
        found: f64,
        /// The limit.
        limit: f64,
        /// Their unit.
        unit: &'static str,
    },
    /// A mass beyond what links of arms have.
    #[error("`mass_kg` of the {label} is {found} kg; no link of an arm has {limit} kg or more")]
    HeavyBody {
        /// The body.
        label: String,
        /// What the file says, kg.
        found: f64,
        /// The limit, kg.
        limit: f64,
    },
    /// `large: true` that nobody can judge, or a reason for nothing.
    #[error(
        "`{label}`: `large: true` and `reason: \"…\"` stand together, and the reason is a text"
    )]
    LargeWithoutReason {
        /// The effect.
        label: String,
    },
    /// Two tools whose names programs do not distinguish.
    #[error(
        "tools `{other}` and `{name}` are one name: case, blanks and leading zeros do not count"
    )]
    SameTool {
        /// The name.
        name: String,
        /// The one before.
        other: String,
    },
    /// A mass beyond what the robot carries.
    #[error("mass_kg of tool `{tool}` is {found}; robot.payload_kg is {payload}")]
    BeyondPayload {
        /// The tool.
        tool: String,
        /// Its mass, kg.
        found: f64,
        /// The limit, kg.
        payload: f64,
    },
    /// An effect that makes a load heavier than the robot carries.
    #[error("`{label}` makes the load {found} kg; robot.payload_kg is {payload}")]
    LoadBeyondPayload {
        /// The effect.
        label: String,
        /// The load with it, kg.
        found: f64,
        /// The limit, kg.
        payload: f64,
    },
    /// A tool so small that its lengths must be in another unit.
    #[error(
        "the frame of tool `{tool}` is {largest_mm} mm from the flange at most in each coordinate; \
         below 1 mm it is none, or in metres"
    )]
    TinyTool {
        /// The tool.
        tool: String,
        /// Its largest coordinate, mm.
        largest_mm: f64,
    },
    /// A chain so short that its lengths must be in another unit.
    #[error(
        "a_mm and d_mm of the joints add up to {found_mm:.3} mm (limit {limit_mm} mm): are they in \
         metres?"
    )]
    TinyArm {
        /// Their sum, mm.
        found_mm: f64,
        /// The limit, mm.
        limit_mm: f64,
    },
    /// A centre of gravity in another unit.
    #[error(
        "cog_mm of {of} is {largest_mm} mm at most in each coordinate; below 1 mm it is 0, or in \
         metres"
    )]
    TinyCog {
        /// Of what.
        of: String,
        /// The largest coordinate, mm.
        largest_mm: f64,
    },
    /// A body in another unit.
    #[error("this body measures {largest_mm} mm at most; below {limit_mm} mm it is in metres")]
    TinyBody {
        /// Its largest dimension, mm.
        largest_mm: f64,
        /// The limit, mm.
        limit_mm: f64,
    },
    /// Gravity in another unit.
    #[error("gravity_m_s2 has a length of {found} m/s²; on Earth it is from {low} to {high}")]
    Gravity {
        /// Its length.
        found: f64,
        /// Smallest.
        low: f64,
        /// Largest.
        high: f64,
    },
    /// An angle of a frame in another unit than degrees.
    #[error("{key} is {found}; a frame has at most {limit} deg")]
    EndlessAngle {
        /// The key.
        key: &'static str,
        /// What the file says, degrees.
        found: f64,
        /// The limit, degrees.
        limit: f64,
    },
    /// Effects of a controller that has none.
    #[error("the controller has effects, but computes with the nominal chain")]
    EffectsOfNominal,
    /// An effect that no controller can compute.
    #[error("`{label}` cannot be part of a controller's own model: it needs {need}")]
    NotOfController {
        /// Which.
        label: String,
        /// What it needs.
        need: &'static str,
    },
}

impl Fault {
    /// This fault at a place of the file.
    pub fn at(self, location: Location) -> ProfileError {
        let span = location.span();
        let bytes = span.byte_offset().zip(span.byte_len());
        #[allow(clippy::cast_possible_truncation)]
        ProfileError {
            line: location.line() as usize,
            column: location.column() as usize,
            span: bytes.map(|(start, length)| (start as usize, (start + length) as usize)),
            fault: self,
        }
    }
}

impl ProfileError {
    /// The way out; empty where the message says it all.
    #[must_use]
    pub fn hint(&self) -> String {
        match &self.fault {
            Fault::Effect(error) => error.hint(),
            Fault::EffectOfData { .. } => {
                "leave it out; `poseshift diagnose` finds it in measurements and repairs their \
                 analysis"
                    .into()
            }
            Fault::DuplicateEffect { .. } => "add the two up into one entry".into(),
            Fault::Format { reads, .. } => {
                let name = reads.split('/').next().unwrap_or(reads);
                format!("`poseshift schema {name}` prints the format")
            }
            Fault::Quality { message } if !message.starts_with("unknown field") => {
                "`calibrate` writes this block: take it from the file as it was written, or leave \
                 it out"
                    .into()
            }
            Fault::Yaml { message } | Fault::Quality { message } => {
                let formats = "docs/formats.md and `poseshift profile schema` describe the formats";
                // the parser names a key that it does not know, and then those it knows
                let rest = message.strip_prefix("unknown field `");
                let names = rest.and_then(|rest| rest.split_once("`, expected one of "));
                let near = names.map(|(key, known)| nearest::nearest(key, known.split(", ")));
                let meant = near.and_then(|near| near.first().copied());
                meant.map_or_else(
                    || formats.to_owned(),
                    |meant| format!("did you mean `{meant}`? {formats}"),
                )
            }
            Fault::NotOneShape { .. } => {
                "one of capsule_mm, box_mm, sphere_mm, cylinder_mm, plane, mesh".into()
            }
            Fault::UnknownBody { name, known } => {
                nearest::hint(name, "bodies", known.iter().map(String::as_str))
            }
            Fault::MovingPlane { .. } => "a box does the same".into(),
            Fault::EffectsOfNominal => "set `model: calibrated`, or take the effects away".into(),
            Fault::Large { .. } => "is it in the unit of its key? `large: true` with `reason: \
                \"…\"` in the entry says that it is meant"
                .into(),
            Fault::HeavyBody { .. } => "masses are in kg; `large: true` with `reason: \"…\"` in \
                the entry says that it is meant"
                .into(),
            Fault::LargeWithoutReason { .. } => {
                "write `large: true, reason: \"…\"`, or leave both \
                out"
                .into()
            }
            Fault::SameTool { .. } => "leave one of them out, or rename it".into(),
            Fault::BeyondPayload { .. } => "masses are in kg; correct the tool or \
                robot.payload_kg"
                .into(),
            Fault::LoadBeyondPayload { .. } => "masses are in kg; correct the effect or \
                robot.payload_kg; `large: true` with `reason: \"…\"` in the entry says that it is \
                meant"
                .into(),
            Fault::TinyTool { .. } => "lengths are in mm: 0.1 m is 100; write 0 for the flange \
                itself"
                .into(),
            Fault::TinyBody { .. } => "lengths are in mm: 0.6 m is 600".into(),
            Fault::TinyArm { .. } => "lengths are in mm: 0.29 m is 290".into(),
            Fault::TinyCog { .. } => "lengths are in mm: 0.1 m is 100; write 0 for none".into(),
            Fault::Gravity { .. } => "it is in m/s², not in g: [0, 0, -9.81] of a robot on the \
                floor, [0, 0, 9.81] of one on the ceiling in its own frame"
                .into(),
            Fault::OutOfRange { key, .. } if key.ends_with("_deg") => {
                "angles are in degrees".into()
            }
            Fault::OutOfRange { key, .. } if key.ends_with("_mm") => "lengths are in mm".into(),
            Fault::OutOfRange { key: "mass_kg", .. } => "masses are in kg".into(),
            Fault::EndlessAngle { .. } => "angles are in degrees, between -360 and 360".into(),
            Fault::NotOfController { .. } => "it belongs under `calibration`".into(),
            Fault::UpAlong => "give `up` across the rail: for a lift [1, 0, 0]".into(),
            Fault::AxisName { .. } => "each name stands once, as programs write it".into(),
            Fault::NoSuchAxis { listed, .. } if listed.is_empty() => {
                "list the axes under `external_axes`".into()
            }
            Fault::NoSuchAxis { listed, .. } => {
                let listed = listed
                    .iter()
                    .zip(1..)
                    .map(|(name, n)| format!("{n} is {name}"));
                listed.collect::<Vec<_>>().join(", ")
            }
            Fault::NotSix { .. } => "only arms with six revolute joints are supported".into(),
            _ => String::new(),
        }
    }
}

/// What the parser says, without the options that only a caller of it has.
fn message_of(error: &serde_yaml::Error) -> String {
    let message = error.without_snippet().to_string();
    // the parser repeats the place at the end of its message
    let message = message.split(" at line ").next().unwrap_or(&message);
    if message.starts_with("multiple YAML documents") {
        return "a second document begins (`---`); the file may hold one".into();
    }
    let twice = message.strip_prefix("duplicate mapping key: ");
    if let Some(rest) = twice {
        let key = rest.split(", set ").next().unwrap_or(rest);
        return format!("the key `{key}` stands twice");
    }
    let lengths = message.strip_prefix("invalid length ");
    if let Some((found, wanted)) =
        lengths.and_then(|rest| rest.split_once(", expected an array of length "))
    {
        return format!("{wanted} values are needed here, there are {found}");
    }
    match message {
        "invalid floating point" => "a number is expected here".into(),
        "invalid u8" | "invalid i8" => "a whole number is expected here".into(),
        "expected sequence start" => "a list is expected here: [first, second]".into(),
        "expected mapping start" => "keys with their values are expected here".into(),
        _ => message.to_owned(),
    }
}

impl ProfileError {
    /// A text that cannot be read as `format`: it is of another one, or something in it is wrong.
    pub fn of(text: &str, format: &'static str, error: serde_yaml::Error) -> Self {
        let lines = text.lines().zip(1..);
        let declared = lines.filter_map(|(text, line)| {
            let value = text.strip_prefix("poseshift:")?;
            let value = value.split('#').next().unwrap_or(value);
            Some((value.trim().trim_matches(['"', '\'']), line))
        });
        match declared.into_iter().next() {
            Some((found, line)) if found != format => Self {
                line,
                column: 1,
                span: None,
                fault: Fault::Format {
                    found: found.into(),
                    reads: format,
                },
            },
            _ => error.into(),
        }
    }
}

impl From<serde_yaml::Error> for ProfileError {
    fn from(error: serde_yaml::Error) -> Self {
        let location = error.location();
        let fault = Fault::Yaml {
            message: message_of(&error),
        };
        match location {
            Some(location) => fault.at(location),
            None => Self {
                line: 0,
                column: 0,
                span: None,
                fault,
            },
        }
    }
}
