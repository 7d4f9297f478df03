//! The registry of effects: each physical cause of error is one file that states its equation once.
//!
//! An effect's file has a type that implements `Equation`: its [`Definition`] (name, equation,
//! source, parameters with units and priors, what it needs, how a diagnosis seeks it and what it is
//! drawn against), its sentence, and its functions. Profile keys, JSON Schema, help, identification,
//! diagnosis, pages and the law tests follow from the list in [`registry!`](self); elsewhere only
//! places and lengths are named (frames, geometry, what a level of `calibrate` holds).
//!
//! To add one: write the file, add its line to the list.

mod definition;
mod entry;
mod search;
mod words;

#[cfg(test)]
mod laws;

pub use definition::{Definition, MOST_EXTERNAL_AXES, Need, Parameter, SiteKey, Unit};
pub use entry::{EntryError, entry_schema};
pub use search::{List, Search, Sets, Shown};

use super::chain::Frames;
use super::conditions::Conditions;
use super::geometry::Geometry;
use crate::geometry::{Scalar, Vector};
use std::sync::Arc;

/// [`Site::index`] of the base.
pub const BASE: usize = 6;

/// Most parameters an effect has.
pub const MOST_PARAMETERS: usize = 6;

/// One effect's equation. Both functions take the parameters in SI units, in the order of the
/// definition.
trait Equation {
    /// Everything about the effect but its equation.
    const DEFINITION: Definition;

    /// Whether it reads [`State::commanded`]; where no effect does, an inverse need not know the
    /// angles on its way.
    const READS_ANGLES: bool = true;

    /// Parameters by key with the largest value, in the profile's unit, that a profile takes without
    /// a reason, where their unit alone does not say it.
    const LARGEST: &'static [(&'static str, f64)] = &[];

    /// Changes the arm's geometry, before any posture is known.
    fn change_geometry<S: Scalar>(
        site: &Site,
        p: &[S; MOST_PARAMETERS],
        conditions: &Conditions,
        geometry: &mut Geometry<S>,
    ) {
        let _ = (site, p, conditions, geometry);
    }

    /// Adds what the posture does to `deflection`.
    #[inline(always)]
    fn deflect<S: Scalar>(
        site: &Site,
        p: &[S; MOST_PARAMETERS],
        state: &State<S>,
        deflection: &mut Deflection<S>,
    ) {
        let _ = (site, p, state, deflection);
    }

    /// Adds what is wrong with an external axis to `error`.
    fn carry<S: Scalar>(
        site: &Site,
        p: &[S; MOST_PARAMETERS],
        at: &AxisState<S>,
        error: &mut AxisError<S>,
    ) {
        let _ = (site, p, at, error);
    }

    /// The effect in one sentence that a person understands.
    fn sentence(effect: &Effect, seen: &Seen) -> String;
}

/// Where an effect was seen: what its sentence may need to know of the measurements.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// Where the robot stands in the world, metres.
    pub base_m: Vector,
    /// How many rows there are.
    pub rows: usize,
    /// How long the session lasted, seconds; zero where nobody wrote it down.
    pub seconds: f64,
    /// Names of the points measured, by [`Site::index`] of an effect that belongs to one.
    pub points: Arc<[String]>,
}

/// Where an external axis stands.
#[derive(Clone, Copy, Debug)]
pub struct AxisState<S> {
    /// How far from the middle of its limits a linear axis is, metres; the angle of a rotary one
    /// from its zero, radians.
    pub moved: S,
    /// The same of a linear axis as a part of half its travel: −1 to 1.
    pub part: S,
    /// Direction in which it last moved: −1, +1, or 0 where it is unknown.
    pub direction: f64,
}

/// What is wrong with an external axis at one place: sums over its effects.
#[derive(Clone, Copy, Debug)]
pub struct AxisError<S> {
    /// Of the travel or angle.
    pub scale: S,
    /// Pitch and yaw of a rail, radians.
    pub direction: [S; 2],
    /// Along the axes of the rail, or of the rotary axis as it stands, metres.
    pub offset: Vector<S>,
    /// Of the carriage about the axes of the rail, radians.
    pub turn: Vector<S>,
    /// x, y, rx, ry of a rotary axis.
    pub place: [S; 4],
    /// Added to the angle, radians.
    pub angle: S,
    /// Of the plate, as [`crate::geometry::Pose::from_xyz_rxryrz`].
    pub plate: [S; 6],
}

impl<S: Scalar> AxisError<S> {
    /// Nothing is wrong.
    #[must_use]
    pub fn none() -> Self {
        let zero = S::zero();
        Self {
            scale: zero,
            direction: [zero; 2],
            offset: [zero; 3],
            turn: [zero; 3],
            place: [zero; 4],
            angle: zero,
            plate: [zero; 6],
        }
    }
}

/// A whole power.
fn power<S: Scalar>(base: S, degree: u32) -> S {
    (0..degree).fold(S::one(), |product, _| product * base)
}

macro_rules! registry {
    ($($file:ident :: $name:ident),+ $(,)?) => {
        $(mod $file;)+

        /// Which effect.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Kind {
            $(#[doc = concat!("The effect of the file `", stringify!($file), ".rs`.")] $name,)+
        }

        /// Every effect there is.
        pub const REGISTRY: &[Kind] = &[$(Kind::$name),+];

        impl Kind {
            /// Everything about the effect but its equation.
            #[must_use]
            pub const fn definition(self) -> &'static Definition {
                match self { $(Kind::$name => const { &$file::$name::DEFINITION },)+ }
            }

            /// Largest values of parameters by key.
            const fn largest(self) -> &'static [(&'static str, f64)] {
                match self { $(Kind::$name => $file::$name::LARGEST,)+ }
            }
        }

        impl Effect {
            /// The effect in one sentence that a person understands.
            #[must_use]
            pub fn sentence(&self, seen: &Seen) -> String {
                let text = match self.kind { $(Kind::$name => $file::$name::sentence(self, seen),)+ };
                format!("{text} ({}).", self.definition().id)
            }
        }

        impl<S: Scalar> Effect<S> {
            /// Whether it depends on the joint angles themselves, not only on their sines and cosines.
            #[must_use]
            pub const fn reads_angles(&self) -> bool {
                match self.kind { $(Kind::$name => $file::$name::READS_ANGLES,)+ }
            }

            /// Changes the arm's geometry where this effect does.
            pub fn change_geometry(&self, conditions: &Conditions, geometry: &mut Geometry<S>) {
                match self.kind {
                    $(Kind::$name => $file::$name::change_geometry(&self.site, &self.parameters, conditions, geometry),)+
                }
            }

            /// Adds what is wrong with the external axis that this effect belongs to, where it does to one.
            pub fn carry(&self, at: &AxisState<S>, error: &mut AxisError<S>) {
                match self.kind {
                    $(Kind::$name => $file::$name::carry(&self.site, &self.parameters, at, error),)+
                }
            }

            /// Adds what the posture does where this effect depends on it.
            #[inline(always)]
            pub fn deflect(&self, state: &State<S>, deflection: &mut Deflection<S>) {
                match self.kind {
                    $(Kind::$name => $file::$name::deflect(&self.site, &self.parameters, state, deflection),)+
                }
            }
        }
    };
}

registry! {
    base_frame::BaseFrame,
    link_geometry::LinkGeometry,
    tool_frame::ToolFrame,
    joint_scale::JointScale,
    joint_compliance::JointCompliance,
    joint_harmonic::JointHarmonic,
    joint_coupling::JointCoupling,
    backlash::Backlash,
    payload_error::PayloadError,
    compliance_knee::ComplianceKnee,
    link_compliance::LinkCompliance,
    base_compliance::BaseCompliance,
    thermal_growth::ThermalGrowth,
    warm_up_drift::WarmUpDrift,
    frame_shift::FrameShift,
    tool_slip::ToolSlip,
    reflector_slip::ReflectorSlip,
    settling::Settling,
    friction_backlash::FrictionBacklash,
    tool_compliance::ToolCompliance,
    measurement_scale::MeasurementScale,
    session_drift::SessionDrift,
    session_growth::SessionGrowth,
    track_scale::TrackScale,
    track_direction::TrackDirection,
    track_straightness::TrackStraightness,
    track_ripple::TrackRipple,
    track_rotation::TrackRotation,
    track_backlash::TrackBacklash,
    positioner_axis::PositionerAxis,
    positioner_zero::PositionerZero,
    positioner_scale::PositionerScale,
    positioner_ripple::PositionerRipple,
    positioner_runout::PositionerRunout,
    positioner_plate::PositionerPlate,
}

/// The effects of the arm, its place and its measurements: all that belong to no external axis.
pub fn of_arm() -> impl Iterator<Item = Kind> + Clone {
    let all = REGISTRY.iter().copied();
    all.filter(|kind| !kind.definition().of_external_axis())
}

/// Those that the place of the tool shows: of the arm and of the track that carries it.
pub fn shown_by_tool() -> impl Iterator<Item = Kind> + Clone {
    let of_track = REGISTRY.iter().copied().filter(|kind| kind.of_track());
    of_arm().chain(of_track)
}

impl Kind {
    /// Whether it belongs to a linear axis that carries the base.
    #[must_use]
    pub fn of_track(self) -> bool {
        self.definition().of_external_axis() && self.definition().id.starts_with("track_")
    }

    /// The effect of this name.
    #[must_use]
    pub fn by_id(id: &str) -> Option<Self> {
        REGISTRY
            .iter()
            .copied()
            .find(|kind| kind.definition().id == id)
    }
}

/// What an effect belongs to. Only what its [`Definition::site`] lists is used.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct Site {
    /// Index of the joint or link, 0 to 5; 6 is the base where an effect may belong to it; or
    /// index of the external axis in the profile's list, or of the point that is measured.
    pub index: usize,
    /// Index of the joint it leaks from; of an external axis the direction: 0 is x, 1 is y, 2 is
    /// z.
    pub on: usize,
    /// Thousandths of periods in one revolution; the degree of a power; a period in micrometres;
    /// or the first row of the measurements, from 1, where an effect begins there.
    pub order: u32,
    /// Name of the tool; `None` is every tool.
    pub tool: Option<String>,
}

/// Whether two names are of one tool. Most languages fold case, and controllers and people write
/// `TOOL_DATA[1]`, `tool_data[ 01 ]`, `1` and `01`: ASCII case, blanks, and zeros that lead a
/// number at the start or in brackets are nothing.
pub fn same_tool(a: &str, b: &str) -> bool {
    a == b || plain_tool(a) == plain_tool(b)
}

fn plain_tool(name: &str) -> String {
    let letters = name.chars().filter(|c| !c.is_whitespace());
    let mut letters = letters.map(|c| c.to_ascii_lowercase()).peekable();
    let mut plain = String::with_capacity(name.len());
    while let Some(letter) = letters.next() {
        let leads = plain.is_empty() || plain.ends_with('[');
        let goes_on = letters.peek().is_some_and(char::is_ascii_digit);
        if !(letter == '0' && leads && goes_on) {
            plain.push(letter);
        }
    }
    plain
}

impl Site {
    /// Whether it belongs to the tool of this name.
    #[must_use]
    pub fn is_of_tool(&self, name: &str) -> bool {
        self.tool.as_ref().is_none_or(|tool| same_tool(tool, name))
    }

    /// The period along a rail, metres.
    #[must_use]
    pub fn period_m(&self) -> f64 {
        f64::from(self.order) * 1e-6
    }
}

/// One effect with its parameters in SI units, in the order of its definition; unused ones are
/// zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect<S = f64> {
    /// Which effect.
    pub kind: Kind,
    /// What it belongs to.
    pub site: Site,
    /// Its parameters.
    pub parameters: [S; MOST_PARAMETERS],
}

impl<S> Effect<S> {
    /// Everything about the effect but its equation.
    #[must_use]
    pub fn definition(&self) -> &'static Definition {
        self.kind.definition()
    }
}

impl Site {
    /// Periods in one revolution, of a wave.
    #[must_use]
    pub fn periods(&self) -> f64 {
        f64::from(self.order) / f64::from(SiteKey::Order.one())
    }
}

impl Effect {
    /// The same effect with constants of another scalar.
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Effect<S> {
        Effect {
            kind: self.kind,
            site: self.site.clone(),
            parameters: self.parameters.map(S::constant),
        }
    }

    /// Whether the parameter of this key means something at its place: a joint drifts by an angle,
    /// the base by lengths.
    #[must_use]
    pub fn has(&self, key: &str) -> bool {
        !self.definition().site.contains(&SiteKey::JointOrBase)
            || match key {
                "angle_deg" => self.site.index != BASE,
                "x_mm" | "y_mm" | "z_mm" => self.site.index == BASE,
                _ => true,
            }
    }

    /// Whether every parameter is zero, so that it does nothing.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.parameters.iter().all(|&p| p == 0.0)
    }
}

/// The posture that effects are evaluated at.
#[derive(Clone, Debug)]
pub struct State<'a, S> {
    /// Commanded angle of each mechanical joint in the controller's sense, radians.
    pub commanded: &'a [S; 6],
    /// Torque about each joint in the controller's sense, N·m; zero unless an effect needs masses.
    pub torques: &'a [S; 6],
    /// Frames and moments of the links; present where an effect bends links or moves the base or
    /// the tool.
    pub frames: Option<&'a Frames<S>>,
    /// Direction, force, temperature, time.
    pub conditions: &'a Conditions,
}

/// What a posture does to the arm, small.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deflection<S = f64> {
    /// Added to each commanded joint angle in the controller's sense, radians.
    pub joints: [S; 6],
    /// Rotation of each link about its frame's origin and axes, radians.
    pub links: [Vector<S>; 6],
    /// Motion of the whole arm in the world: metres and radians as
    /// [`crate::geometry::Pose::from_xyz_rxryrz`].
    pub world: [S; 6],
    /// Motion of the tool in its own frame, likewise.
    pub tool: [S; 6],
}

impl<S: Scalar> Deflection<S> {
    /// Nothing moves.
    #[inline(always)]
    #[must_use]
    pub fn none() -> Self {
        let zero = S::zero();
        Self {
            joints: [zero; 6],
            links: [[zero; 3]; 6],
            world: [zero; 6],
            tool: [zero; 6],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_one_tool_differ_in_case_blanks_and_leading_zeros_alone() {
        for (a, b) in [
            ("TOOL_DATA[1]", "tool_data[ 01 ]"),
            ("RDKTool", "rdkTool"),
            ("1", "01"),
            ("0", "00"),
        ] {
            assert!(same_tool(a, b), "{a} {b}");
        }
        for (a, b) in [
            ("TOOL_DATA[1]", "TOOL_DATA[10]"),
            ("gun", "gun1"),
            ("gun1", "gun01"),
            ("1", "0"),
            ("10", "1"),
        ] {
            assert!(!same_tool(a, b), "{a} {b}");
        }
        let of = |tool: Option<&str>| Site {
            tool: tool.map(Into::into),
            ..Site::default()
        };
        assert!(of(None).is_of_tool("gun") && of(Some("GUN")).is_of_tool("gun"));
        assert!(!of(Some("gum")).is_of_tool("gun"));
    }

    #[test]
    fn an_effect_that_does_not_read_angles_is_the_same_at_all() {
        let conditions = Conditions {
            direction: [1.0; 6],
            moved: [0.2; 6],
            ..Conditions::default()
        };
        let mut found = 0;
        for &kind in REGISTRY {
            let effect = Effect {
                kind,
                site: Site::default(),
                parameters: [0.5; MOST_PARAMETERS],
            };
            if !effect.definition().deflects || effect.reads_angles() || effect.definition().bends {
                continue;
            }
            found += 1;
            let at = |angle: f64| {
                let state = State {
                    commanded: &[angle; 6],
                    torques: &[2.0; 6],
                    frames: None,
                    conditions: &conditions,
                };
                let mut deflection = Deflection::none();
                effect.deflect(&state, &mut deflection);
                deflection
            };
            assert_eq!(at(0.3), at(-1.1), "{}", effect.definition().id);
            assert_ne!(at(0.3), Deflection::none());
        }
        assert!(found >= 2);
    }
}
