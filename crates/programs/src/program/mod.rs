//! Robot programs as bytes, and the targets in them.
//!
//! A [`Language`] reads program files into a [`Program`]: which numbers at which bytes make a
//! target, and which moves drive to it with which tool in which work frame. It never evaluates
//! kinematics. Writing is the reverse: the new numbers of a target replace the digits at their
//! spans, in the style of the digits that stood there ([`number`]), and every other byte
//! stays as it was ([`Edits`]).
//!
//! # Example
//!
//! ```
//! use poseshift_programs::motion;
//! use poseshift_programs::program::{Settings, Source, language_of};
//!
//! let text = include_bytes!("../../../../programs/rapid/olp/in/Deburr.mod");
//! let sources = [Source::new("Deburr.mod", text.to_vec())];
//! let language = language_of(&sources[0]).expect("a language");
//! assert_eq!(language.about().id, "rapid");
//! let program = motion::read(language, &sources, &Settings::default())?;
//! assert!(program.targets.len() > 10);
//! # Ok::<(), poseshift_programs::program::ReadError>(())
//! ```

mod before;
mod contexts;
mod coordinates_read;
pub mod csv;
mod deciding;
mod displacement;
mod displacing;
mod drive;
mod edit;
mod equipment;
mod error;
mod external;
pub mod fanuc;
mod functions;
pub mod inform;
pub(crate) mod insert;
pub mod kawasaki;
mod kit;
pub mod krl;
mod language;
mod marker;
mod names;
mod notation;
pub mod number;
mod numbers;
mod quantity;
pub mod rapid;
pub mod script;
mod source;
mod transformations;
pub mod urscript;
pub mod val3;
mod words;
mod xml;

pub use before::Before;
pub use coordinates_read::Readings;
pub use deciding::{Decided, Deciding};
pub(crate) use deciding::{decided, may_decide};
pub use displacement::{Displacement, Shift, Stride};
pub(crate) use displacing::SOMEHOW_M;
pub use drive::Step;
pub use edit::Edits;
pub use equipment::{BASE_UNIT, Frame, Load, Stand, Tool};
pub use error::ReadError;
pub use external::{External, ExternalNames, ExternalState, ExternalUse};
pub use insert::{Between, Inserted, Insertion, Insertions, Replacements};
pub(crate) use kit::check_bytes;
pub(crate) use language::MOST_ANGLE_DEG;
pub use language::{About, Language};
pub use marker::{Found, Marker, sha256, sha256_of};
pub use script::{Instruction, Place, Script};
pub use source::Source;

use crate::finding::Finding;
use crate::geometry::{Pose, Vector};
use std::ops::Range;
use std::path::Path;

/// Moves back to where the robot stood, one to where it stood after another, that are followed.
const MOST_REVISITS: usize = 8;

/// Every language there is.
pub const LANGUAGES: &[&dyn Language] = &[
    &rapid::Rapid,
    &krl::Krl,
    &fanuc::Fanuc,
    &urscript::UrScript,
    &inform::Inform,
    &val3::Val3,
    &kawasaki::Kawasaki,
    &csv::Csv,
];

/// Whether a file's name ends as programs of a language do.
#[must_use]
pub fn has_extension(language: &dyn Language, path: &Path) -> bool {
    let extension = path
        .extension()
        .and_then(|e| e.to_str())
        .map(str::to_ascii_lowercase);
    extension.is_some_and(|e| language.about().extensions.contains(&e.as_str()))
}

/// The language of a file: the one whose ending it has and whose content it shows, else the only
/// one whose content it shows, else the only one whose ending it has.
#[must_use]
pub fn language_of(source: &Source) -> Option<&'static dyn Language> {
    let ends =
        |language: &&&'static dyn Language| has_extension(**language, Path::new(&source.name));
    let shows = |language: &&&'static dyn Language| language.recognises(source);
    let only = |mut found: Box<dyn Iterator<Item = &&'static dyn Language> + '_>| {
        let first = found.next();
        first.filter(|_| found.next().is_none()).copied()
    };
    let both = LANGUAGES
        .iter()
        .filter(ends)
        .find(|language| shows(language));
    both.copied()
        .or_else(|| only(Box::new(LANGUAGES.iter().filter(shows))))
        .or_else(|| only(Box::new(LANGUAGES.iter().filter(ends))))
}

/// Which kind of target the numbers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// A tool pose in a work frame, with or without configuration data.
    Pose,
    /// Six joint angles.
    Joints,
}

/// Which numbers make a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Layout {
    /// Pose or joints.
    pub shape: Shape,
    /// Which of the language's own forms: with or without configuration data, Euler angles or
    /// quaternion, degrees or pulses.
    pub variant: u8,
}

impl Layout {
    /// The first form of a shape.
    #[must_use]
    pub const fn of(shape: Shape) -> Self {
        Self { shape, variant: 0 }
    }
}

/// What a language must know besides the files.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Settings {
    /// External axes that the profile describes.
    pub external: ExternalNames,
    /// Where the profile has the base of an arm that stands still.
    pub world_from_base: Option<Pose>,
    /// Where the profile has the base with every axis of a track at zero, where it describes external
    /// axes.
    pub world_from_base_at_home: Option<Pose>,
    /// Gravity along the axes of the base as the profile has it, where its effects depend on loads.
    pub gravity_m_s2: Option<Vector>,
    /// Encoder pulses of one degree of each joint, where programs count in pulses.
    pub pulses_per_deg: Option<[f64; 6]>,
    /// Rewrite targets that are marked as taught on a robot whose controller corrects them itself.
    pub accept_absolutely_accurate: bool,
}

/// What one number of a target is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Coordinate of the position.
    Position,
    /// Part of the orientation.
    Orientation,
    /// Joint angle.
    Joint,
    /// Integer that tells which inverse solution is meant.
    Configuration,
}

/// What a target asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// `frame_from_tool`, metres.
    Pose(Pose),
    /// Controller's joint angles, radians.
    Joints([f64; 6]),
}

/// A target's numbers, understood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decoded {
    /// The pose or the joints.
    pub value: Value,
    /// What the configuration data say about the joints.
    pub configuration: Configuration,
}

/// How far beyond its quadrant or turn a joint may stand, radians: files round, and borders belong to
/// both sides.
pub(crate) const BORDER_RAD: f64 = 0.05 * crate::geometry::units::DEG;

/// Which inverse solutions a target's configuration data allow. `None` is: they do not say.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Configuration {
    /// The wrist centre lies behind axis 1.
    pub behind_axis_1: Option<bool>,
    /// The wrist centre lies behind the lower arm.
    pub behind_lower_arm: Option<bool>,
    /// Joint 5 is negative.
    pub joint_5_negative: Option<bool>,
    /// The range `[low, high)` of each of the controller's joint angles, radians.
    pub joints: [Option<(f64, f64)>; 6],
    /// How far from zero each of the controller's joints stands at least, on either side, radians.
    pub beyond: [Option<f64>; 6],
    /// The file tells more of the sides than is understood: where several solutions are left, the
    /// nearest is not certain.
    pub partly_understood: bool,
    /// Which of the three sides above, in their order, are those of the posture before where they
    /// are not stated.
    pub kept: [bool; 3],
    /// Many files leave the sides at zero: where no solution has them, the ranges count alone.
    pub ranges_suffice: bool,
}

impl Configuration {
    /// Whether one of the controller's joints is where the configuration data ask for, or no more
    /// than `border` radians from there.
    #[must_use]
    pub fn has_joint(&self, joint: usize, angle: f64, border: f64) -> bool {
        let in_range = |(low, high): (f64, f64)| (low - border..=high + border).contains(&angle);
        self.joints[joint].is_none_or(in_range)
            && self.beyond[joint].is_none_or(|least| angle.abs() >= least - border)
    }
}

/// What configuration data are computed from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Posture {
    /// Controller's joint angles, radians.
    pub joints_rad: [f64; 6],
    /// The wrist centre lies behind axis 1: its x is negative in the frame that turns with axis 1.
    pub behind_axis_1: bool,
    /// The wrist centre lies behind the lower arm.
    pub behind_lower_arm: bool,
}

/// A number at its place in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// First byte of its field: the sign or first digit, or the blanks before it where the column
    /// is kept.
    pub start: u32,
    /// Bytes of the field; 0 where the text leaves the number out, which then is 0 and would stand
    /// there.
    pub length: u16,
    /// Its value in the file's unit.
    pub value: f64,
}

impl Number {
    /// Its text; `0` where the file leaves it out.
    #[must_use]
    pub fn text<'a>(&self, bytes: &'a [u8]) -> &'a [u8] {
        let start = self.start as usize;
        match self.length {
            0 => b"0",
            length => &bytes[start..start + usize::from(length)],
        }
    }
}

/// Index of a target in [`Program::targets`].
pub type TargetId = usize;
/// Index of a tool in [`Program::tools`].
pub type ToolId = usize;
/// Index of a work frame in [`Program::frames`].
pub type FrameId = usize;

/// One target and where its numbers stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Its name in the program, such as `p10` or `P[3]`; none where it stands inside a move.
    pub name: Option<Box<str>>,
    /// Index of its file in the sources.
    pub file: u32,
    /// First byte of the whole target.
    pub offset: u32,
    /// Behind its last byte.
    pub end: u32,
    /// Which numbers it has.
    pub layout: Layout,
    /// Its numbers in [`Program::numbers`], in the order of [`Language::roles`]. None where it is
    /// blocked because it has no numbers of its own.
    pub numbers: Range<u32>,
    /// It must stay as it is; a finding says why.
    pub blocked: bool,
}

/// How the controller goes to a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Motion {
    /// Joints interpolated.
    Joint,
    /// Straight line of the tool.
    Linear,
    /// A curve through successive points, whose shape the controller alone knows: taken as straight
    /// from point to point.
    Spline,
    /// The point an arc passes through.
    ArcVia,
    /// The end of an arc.
    ArcEnd,
}

/// How fast a move is, and how far from its target the next one may begin, where the program tells.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct SpeedZone {
    /// Programmed speed of the tool, m/s.
    pub speed_m_s: Option<f64>,
    /// Radius of the corner, metres; 0 where the robot stops.
    pub zone_m: Option<f64>,
    /// The robot cuts the corner, by how much the text does not tell.
    pub blends: bool,
}

impl SpeedZone {
    /// Whether the robot may pass its target by.
    #[must_use]
    pub fn cuts_corner(&self) -> bool {
        self.blends || self.zone_m.is_some_and(|zone| zone > 0.0)
    }
}

/// One use of a target by a move instruction with one tool in one work frame, in the order of the
/// text.
#[derive(Clone, Debug, PartialEq)]
pub struct Move {
    /// Index of the file in the sources.
    pub file: u32,
    /// First byte of the instruction.
    pub offset: u32,
    /// How the robot gets there.
    pub motion: Motion,
    /// Where to; `None` where only the running program knows, or nobody does.
    pub target: Option<TargetId>,
    /// With which tool.
    pub tool: ToolId,
    /// In which work frame.
    pub frame: FrameId,
    /// Added to the target.
    pub displacement: Displacement,
    /// The controller honours the target's configuration data in this move.
    pub configured: bool,
    /// On the way the orientation is free: only the end counts.
    pub free_orientation: bool,
    /// Where a positioner carries the work frame, the path is relative to it.
    pub coordinated: bool,
    /// Index in [`Program::instructions`].
    pub instruction: u32,
    /// The moves that may come before it, see [`Program::before`].
    pub before: Before,
    /// Where its tool is written, where that is not its declaration.
    pub tool_written: Option<Place>,
    /// Likewise its work frame.
    pub frame_written: Option<Place>,
    /// What is done to external axes besides the target: from 1 an index in
    /// [`Program::external_states`], 0 is nothing.
    pub external_state: u32,
    /// Nothing reaches it.
    pub is_dead: bool,
    /// Its target is what its routine is given: by a call, or in a variable that others write.
    pub is_given: bool,
}

impl Default for Move {
    /// A joint move to nowhere.
    fn default() -> Self {
        Self {
            file: 0,
            offset: 0,
            motion: Motion::Joint,
            target: None,
            tool: 0,
            frame: 0,
            displacement: Displacement::None,
            configured: false,
            free_orientation: false,
            coordinated: true,
            instruction: 0,
            before: Before::Start,
            tool_written: None,
            frame_written: None,
            external_state: 0,
            is_dead: false,
            is_given: false,
        }
    }
}

/// A routine that may run between any two moves of others (a trap, an interrupt, a thread), and
/// moves the robot, or may.
#[derive(Clone, Debug, PartialEq)]
pub struct Interrupt {
    /// Where it stands.
    pub place: Place,
    /// Its name.
    pub name: Box<str>,
    /// Its moves, in order: indices in [`Program::moves`].
    pub moves: Vec<u32>,
    /// The routine that it calls, or is, and that is not in the files: that one may move the robot.
    pub foreign: Option<Box<str>>,
}

/// A call, or a search that stops.
#[derive(Clone, Debug, PartialEq)]
pub struct Called {
    /// Where it stands.
    pub place: Place,
    /// What it calls.
    pub name: Box<str>,
    /// That may be a routine that is not in the files.
    pub is_foreign: bool,
}

/// What program files hold.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Program {
    /// All targets with numbers in the files, by file and place.
    pub targets: Vec<Target>,
    /// The numbers of all targets.
    pub numbers: Vec<Number>,
    /// The moves to them, by file and place.
    pub moves: Vec<Move>,
    /// Tools as moves use them; one name may stand for several values.
    pub tools: Vec<Tool>,
    /// Work frames as moves use them.
    pub frames: Vec<Frame>,
    /// What moves say, with the bytes where they say it.
    pub instructions: Vec<Instruction>,
    /// Speeds and corners by [`Instruction::modal`].
    pub speed_zones: Vec<SpeedZone>,
    /// Joints, radians, near which the text says elsewhere than at a move that the robot comes to a
    /// target.
    pub named: Vec<(TargetId, [f64; 6])>,
    /// Moves that come before others where there are several.
    pub befores: Vec<Box<[Before]>>,
    /// Moves, by index in [`Program::moves`], to where the robot itself was, and the moves that it may
    /// have come from when that was read: as [`Program::listed`] takes them.
    pub revisits: Vec<(u32, Before)>,
    /// Calls between a move and the ones before that may have left the robot elsewhere: of routines
    /// that are not in the files, and searches that stop. Indices in [`Program::moves`], which are
    /// in order, and in [`Program::calls`].
    pub led: Vec<(u32, u32)>,
    /// Each call; empty where none of them is in [`Program::led`].
    pub calls: Vec<Called>,
    /// Routines that may run between any two moves of the others, and move the robot.
    pub interrupts: Vec<Interrupt>,
    /// Where targets say that external axes stand, by target.
    pub externals: Vec<(TargetId, External)>,
    /// Likewise moves, by [`Move::instruction`]: they go before their targets.
    pub externals_of_moves: Vec<(u32, External)>,
    /// Moves after which external axes stand where they stood before, whatever their targets say, by
    /// [`Move::instruction`].
    pub axes_stay: Vec<u32>,
    /// What moves add to where their targets say that external axes stand, by
    /// [`Move::instruction`].
    pub external_shifts: Vec<(u32, External)>,
    /// What programs do to external axes besides their targets.
    pub external_states: Vec<ExternalState>,
    /// Where each listed external axis stands at the end of each move, see
    /// [`Program::stands_at`].
    pub stands: Vec<Option<f64>>,
    /// Where they stand when the program starts, where that is said.
    pub stands_at_start: Vec<Option<f64>>,
    /// Statements that read numbers of targets by which the program decides.
    pub decided: Vec<Decided>,
    /// Files with statements that write targets, tools or frames of another file, and that.
    pub writes_into: Vec<(u32, u32)>,
    /// What the reader saw that a person should look at.
    pub findings: Vec<Finding>,
}

impl Target {
    /// One without a name and, so far, without numbers, from a place up to a byte.
    #[must_use]
    pub fn new(place: Place, end: u32, layout: Layout) -> Self {
        Self {
            name: None,
            file: place.file,
            offset: place.offset,
            end,
            layout,
            numbers: 0..0,
            blocked: false,
        }
    }

    /// Where it begins.
    #[must_use]
    pub fn place(&self) -> Place {
        Place::new(self.file, self.offset)
    }

    /// Its bytes in its file.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        self.offset as usize..self.end as usize
    }
}

impl Program {
    /// What becomes of each joint, where a move turns joints from where the robot is.
    pub fn turned(&self, motion: &Move) -> Option<&[script::Turn; 6]> {
        let instruction = &self.instructions[motion.instruction as usize];
        let turned = instruction.turned.as_deref();
        turned.filter(|_| motion.target.is_none())
    }

    /// Whether it is where the robot may stop on the way of the move before.
    pub fn is_stop(&self, motion: &Move) -> bool {
        let instruction = &self.instructions[motion.instruction as usize];
        motion.target.is_none() && instruction.span().is_empty()
    }

    /// The call before a move that may have left the robot elsewhere, by its name.
    pub fn call_before(&self, motion: usize) -> Option<&str> {
        let led = self
            .led
            .binary_search_by(|led| (led.0 as usize).cmp(&motion));
        let (_, call) = self.led[led.ok()?];
        Some(&self.calls[call as usize].name)
    }

    /// Where each listed external axis stands at the end of a move, metres and radians, where that
    /// is known; empty where none is listed.
    pub fn stands_at(&self, motion: usize) -> &[Option<f64>] {
        let count = self.stands.len() / self.moves.len().max(1);
        &self.stands[motion * count..(motion + 1) * count]
    }

    /// The move at whose end the robot stands as it does at the end of a move: another one where
    /// that goes back to where the robot stood after one move, and stopped there.
    pub fn stands_as(&self, motion: u32) -> u32 {
        let stood = |motion: &u32| {
            let at = self.revisits.binary_search_by_key(motion, |(of, _)| *of);
            let (_, Before::One(stood)) = self.revisits[at.ok()?] else {
                return None;
            };
            let stops = !self.speed_zone(&self.moves[stood as usize]).cuts_corner();
            let is_led = self.interrupts.iter().any(|of| !of.moves.is_empty());
            Some(stood).filter(|_| stops && !is_led)
        };
        let all = std::iter::successors(Some(motion), stood);
        all.take(MOST_REVISITS).last().unwrap_or(motion)
    }

    /// How fast a move is, and with which corner.
    pub fn speed_zone(&self, motion: &Move) -> SpeedZone {
        let instruction = &self.instructions[motion.instruction as usize];
        self.speed_zones[instruction.modal as usize]
    }

    /// The joints, radians, that the controller's inverse starts from where the move names them.
    pub fn near(&self, motion: &Move) -> Option<&[f64; 6]> {
        let text = &self.instructions[motion.instruction as usize];
        text.near.as_deref()
    }

    /// The moves that may come before a move, as [`Program::listed`] gives them.
    pub fn before<'a>(&'a self, motion: &'a Move) -> &'a [Before] {
        self.listed(&motion.before)
    }

    /// What comes before, one by one: none is [`Before::Several`].
    pub fn listed<'a>(&'a self, before: &'a Before) -> &'a [Before] {
        match before {
            Before::Several(at) => &self.befores[*at as usize],
            one => std::slice::from_ref(one),
        }
    }

    /// Gives back the memory that lists of unknown length took too much.
    pub fn shrink_to_fit(&mut self) {
        self.targets.shrink_to_fit();
        self.numbers.shrink_to_fit();
        self.moves.shrink_to_fit();
        self.instructions.shrink_to_fit();
    }

    /// The target of a move.
    #[must_use]
    pub fn target_of(&self, motion: &Move) -> Option<&Target> {
        motion.target.map(|target| &self.targets[target])
    }

    /// Whether a move goes to a pose with numbers in the files.
    #[must_use]
    pub fn goes_to_pose(&self, motion: &Move) -> bool {
        self.target_of(motion)
            .is_some_and(|target| target.layout.shape == Shape::Pose)
    }

    /// The numbers of one target.
    #[must_use]
    pub fn numbers_of(&self, target: &Target) -> &[Number] {
        &self.numbers[target.numbers.start as usize..target.numbers.end as usize]
    }
}

/// What the numbers of a target mean; a blocked target may have none.
#[must_use]
pub fn meaning(
    language: &dyn Language,
    program: &Program,
    settings: &Settings,
    target: TargetId,
) -> Option<Decoded> {
    let layout = program.targets[target].layout;
    with_values(program, target, |values| {
        language.decode(layout, values, settings)
    })
}

/// The pose or the joints alone that the numbers of a target mean, likewise.
pub(crate) fn value(
    language: &dyn Language,
    program: &Program,
    settings: &Settings,
    target: TargetId,
) -> Option<Value> {
    let layout = program.targets[target].layout;
    with_values(program, target, |values| {
        language.value(layout, values, settings)
    })
}

/// What is made of the numbers of a target, where it has any.
fn with_values<T>(program: &Program, target: TargetId, of: impl FnOnce(&[f64]) -> T) -> Option<T> {
    let numbers = program.numbers_of(&program.targets[target]);
    // a target has few, and this is asked often
    let mut few = [0.0; FEW_NUMBERS];
    let many: Vec<f64>;
    let values = if let Some(values) = few.get_mut(..numbers.len()) {
        for (value, number) in values.iter_mut().zip(numbers) {
            *value = number.value;
        }
        &*values
    } else {
        many = numbers.iter().map(|number| number.value).collect();
        &many
    };
    (!values.is_empty()).then(|| of(values))
}

/// As many numbers as a target mostly has.
const FEW_NUMBERS: usize = 24;
