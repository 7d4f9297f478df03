//! What program files say, statement by statement and in no language: what readers hand to
//! [`crate::motion`].
//!
//! A reader translates; it does not follow. It says *here is a move to this with that*, *here this
//! variable is written*, *here a block may be passed over*, *here that routine is called with these
//! arguments*. Which tool a variable holds at a move and from where the robot comes there is worked
//! out in [`crate::motion`], once for all languages.

mod adding;
mod builder;
mod logic;
mod order;
mod reach;
mod statement;

pub use builder::Builder;
pub use logic::{Logic, Tests};
pub use statement::{
    Argument, Call, Condition, Expected, How, Instruction, Loop, Modal, Routine, Span, Start,
    Statement, Test, Turn, Wanted, Write, Written,
};

use super::{Displacement, External, Load, Number, Source, Stride, Target, TargetId};
use crate::finding::{Finding, Severity};
use crate::geometry::{Pose, Vector};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

/// A byte of one of the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// Index of the file in the sources.
    pub file: u32,
    /// The byte.
    pub offset: u32,
}

impl Place {
    /// Of what stands in no file.
    pub const NOWHERE: Self = Self::new(0, 0);

    /// A byte of a file.
    #[must_use]
    pub const fn new(file: u32, offset: u32) -> Self {
        Self { file, offset }
    }
}

/// Index in [`Script::variables`].
pub type VariableId = u32;
/// Index in [`Script::values`].
pub type ValueId = u32;
/// Index in [`Script::tables`].
pub type TableId = u32;
/// Index in [`Script::routines`].
pub type RoutineId = u32;
/// Index in [`Script::remarks`].
pub type RemarkId = u32;
/// Index in [`Script::displacements`].
pub type DisplacementId = u32;
/// Index in [`Script::modals`].
pub type ModalId = u32;
/// A place in a routine that statements go to, numbered over the whole script.
pub type Label = u32;

/// [`Displacement::None`] in [`Script::displacements`].
pub const NOT_DISPLACED: DisplacementId = 0;
/// [`Displacement::Unknown`] in [`Script::displacements`].
pub const DISPLACED_SOMEHOW: DisplacementId = 1;
/// [`Displacement::Overwritten`] in [`Script::displacements`].
pub const OVERWRITTEN: DisplacementId = 2;
/// [`Displacement::Unbounded`] in [`Script::displacements`].
pub const UNBOUNDED: DisplacementId = 3;
/// The tool turns by an angle that only the running program knows, in [`Script::displacements`].
pub const TURNED: DisplacementId = 4;

/// The statements of all files.
#[derive(Clone, Debug)]
pub struct Script {
    /// Targets with numbers in the files, by file and place.
    pub targets: Vec<Target>,
    /// The numbers of all targets.
    pub numbers: Vec<Number>,
    /// What can be written, or is given by a caller.
    pub variables: Vec<Variable>,
    /// Variables that are reached by a number.
    pub tables: Vec<Table>,
    /// What variables may hold besides targets.
    pub values: Vec<Held>,
    /// Parts of records.
    pub parts: Vec<Part>,
    /// Expressions of several values, see [`Expr::Any`].
    pub lists: Vec<Expr>,
    /// Why something is unknown or refused.
    pub remarks: Vec<Remark>,
    /// What moves add to their targets.
    pub displacements: Vec<Displacement>,
    /// What calls make moves add to their targets.
    pub by_calls: Vec<ByCall>,
    /// Tools and work frames that are products of others.
    pub products: Vec<Product>,
    /// Routines, by file and place; text outside routines is one too.
    pub routines: Vec<Routine>,
    /// What runs concurrently ends with the program that started it.
    pub ends_what_runs: bool,
    /// The statements of all routines.
    pub statements: Vec<Statement>,
    /// Moves.
    pub instructions: Vec<Instruction>,
    /// With what moves run.
    pub modals: Vec<Modal>,
    /// Writes.
    pub writes: Vec<Write>,
    /// Calls.
    pub calls: Vec<Call>,
    /// Arguments of calls.
    pub arguments: Vec<Argument>,
    /// What branches depend on, where a variable tells.
    pub conditions: Vec<Condition>,
    /// Sets of variables that may refuse a move, see [`Modal::guards`].
    pub guards: Vec<Box<[VariableId]>>,
    /// Targets whose numbers make up tools, frames and displacements: these do not change with a
    /// correction.
    pub offsets: Vec<TargetId>,
    /// What speaks against targets themselves, should a move go to them.
    pub refused: Vec<(TargetId, RemarkId)>,
    /// The work frames of targets that have one of their own, whatever moves go to them.
    pub own_frames: Vec<(TargetId, Expr)>,
    /// Where targets say that external axes stand, by target.
    pub externals: Vec<(TargetId, External)>,
    /// Likewise moves, by index in [`Script::instructions`]: they go before their targets.
    pub externals_of_moves: Vec<(u32, External)>,
    /// Moves after which external axes stand where they stood before, whatever their targets say, by index in
    /// [`Script::instructions`].
    pub axes_stay: Vec<u32>,
    /// What moves add to where their targets say that external axes stand, likewise.
    pub external_shifts: Vec<(u32, External)>,
    /// Joints, radians, near which moves that never run say that they come to a target: programs
    /// keep taught points so.
    pub named: Vec<(TargetId, [f64; 6])>,
    /// Sets of what moves expect variables to hold, see [`Modal::expected`].
    pub expected: Vec<Box<[Expected]>>,
    /// What no move in the files uses, nothing uses: targets cannot be named from other files.
    pub is_closed: bool,
    /// How many labels there are.
    pub labels: u32,
    /// Loops, by where they begin.
    pub loops: Vec<Loop>,
    /// What the reader saw that a person should look at.
    pub findings: Vec<Finding>,
}

impl Default for Script {
    fn default() -> Self {
        Self {
            targets: Vec::new(),
            numbers: Vec::new(),
            variables: Vec::new(),
            tables: Vec::new(),
            values: Vec::new(),
            parts: Vec::new(),
            lists: Vec::new(),
            remarks: Vec::new(),
            displacements: vec![
                Displacement::None,
                Displacement::Unknown,
                Displacement::Overwritten,
                Displacement::Unbounded,
                Displacement::Within(Box::new([Stride::Turned(None)])),
            ],
            by_calls: Vec::new(),
            products: Vec::new(),
            ends_what_runs: false,
            routines: Vec::new(),
            statements: Vec::new(),
            instructions: Vec::new(),
            modals: Vec::new(),
            writes: Vec::new(),
            calls: Vec::new(),
            arguments: Vec::new(),
            conditions: Vec::new(),
            guards: vec![Box::default()],
            named: Vec::new(),
            offsets: Vec::new(),
            refused: Vec::new(),
            own_frames: Vec::new(),
            externals: Vec::new(),
            externals_of_moves: Vec::new(),
            axes_stay: Vec::new(),
            external_shifts: Vec::new(),
            expected: vec![Box::default()],
            is_closed: false,
            labels: 0,
            loops: Vec::new(),
            findings: Vec::new(),
        }
    }
}

/// Something that statements write: a tool, a work frame, a position, a mode of the controller.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name in the program.
    pub name: Box<str>,
    /// Where it is declared; where it is used first if it is not.
    pub place: Place,
    /// What it holds before a statement runs; [`Expr::Unknown`] where the files do not tell.
    pub declared: Expr,
    /// The controller keeps it from run to run.
    pub kept: bool,
    /// It is a state of the controller that any routine may set: after one that is not in the
    /// files it is uncertain.
    pub shared: bool,
    /// The routine it belongs to; parameters and local data.
    pub routine: Option<RoutineId>,
}

impl Variable {
    /// One of the program's own, that begins anew with every run.
    #[must_use]
    pub fn new(name: impl Into<Box<str>>, place: Place, declared: Expr) -> Self {
        Self {
            name: name.into(),
            place,
            declared,
            kept: false,
            shared: false,
            routine: None,
        }
    }
}

/// Variables that a running program reaches by a number, such as the entries of `UTOOL[…]`.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Table {
    /// Its name in the program.
    pub name: Box<str>,
    /// By number.
    pub entries: BTreeMap<i64, VariableId>,
    /// What is to be said where only the running program knows the number; that of the number itself
    /// where there is none.
    pub unknown: Option<RemarkId>,
}

/// What a variable may hold.
#[derive(Clone, Debug, PartialEq)]
pub enum Held {
    /// A tool or a work frame.
    Frame(NamedFrame),
    /// A tool or a work frame whose parts may be written one by one; [`super::Language::frame_of`]
    /// understands it.
    Record {
        /// Its name in the program.
        name: Box<str>,
        /// In [`Script::parts`].
        parts: Range<u32>,
        /// The mechanical unit that carries it, by all its names; none where it stands still.
        on: Box<[Box<str>]>,
    },
    /// The product of tools or work frames.
    Product {
        /// Its name in the program.
        name: Box<str>,
        /// The first one outermost.
        of: Box<[Factor]>,
        /// What is to be said where one of them is not known.
        otherwise: RemarkId,
    },
    /// The load of the flange; none where it is set to nothing.
    Load(Option<Load>),
    /// That of the tool of this name; with another tool only the running program knows it.
    LoadOf {
        /// The tool's name in the program.
        tool: Box<str>,
        /// What is to be said of another one.
        otherwise: RemarkId,
    },
    /// What the tool carries as well as its own load; none where it is empty.
    Carried(Option<Load>),
    /// The number of a tool or frame.
    Number(i64),
    /// On or off.
    Flag(bool),
    /// As long as this holds there is something to say of each move; it is refused where the remark
    /// is an error.
    Remark(RemarkId),
    /// Where the robot is when the statement runs.
    Actual,
    /// Likewise, as a pose of this tool in this work frame: moves with others go elsewhere. Absent
    /// are those of the move before.
    ActualWith {
        /// The tool.
        tool: Expr,
        /// The work frame.
        frame: Expr,
    },
    /// Where the robot was, displaced as the text says.
    NearActual,
    /// As long as this holds it displaces what moves go to; an index of [`Script::displacements`].
    Shift(DisplacementId),
    /// What is added to external axes, in the units and the order of the language.
    ExternalOffset(Box<[f64; 6]>),
    /// As long as this holds these external axes, bit by bit as listed, stand elsewhere than
    /// targets say.
    AxesOff(u16),
}

/// A tool or a work frame.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedFrame {
    /// Its name in the program.
    pub name: Box<str>,
    /// `flange_from_tool` or `world_from_frame`; `None` where the files do not tell.
    pub pose: Option<Pose>,
    /// The mechanical unit that carries a work frame, by all its names: the pose is then on the
    /// unit. None where it stands still.
    pub on: Box<[Box<str>]>,
    /// Of a tool: its load, where the files give one.
    pub load: Option<Load>,
    /// Of a tool on another tool: where it stands on that one, metres.
    pub on_tool: Option<Vector>,
}

impl NamedFrame {
    /// One that stands still, and of whose load nothing is said.
    #[must_use]
    pub fn still(name: impl Into<Box<str>>, pose: Option<Pose>) -> Self {
        Self {
            name: name.into(),
            pose,
            on: Box::default(),
            load: None,
            on_tool: None,
        }
    }
}

/// One part of a record, and where it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// What it is.
    pub value: PartValue,
    /// Where it stands.
    pub place: Place,
    /// Its length in bytes.
    pub length: u16,
}

/// What a part of a record is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PartValue {
    /// A number in the file's unit.
    Number(f64),
    /// A truth value.
    Flag(bool),
    /// A text, and whether it is empty.
    Text {
        /// Nothing stands in it.
        empty: bool,
    },
    /// It is not given.
    Missing,
    /// Known at run time only.
    Computed,
}

/// What stands in a statement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expr {
    /// Nothing stands there.
    Absent,
    /// A position with numbers of its own.
    Target(TargetId),
    /// A value.
    Value(ValueId),
    /// What a variable holds.
    Variable(VariableId),
    /// What the entry of a table holds whose number another variable holds.
    Element {
        /// The table.
        table: TableId,
        /// The variable with the number.
        number: VariableId,
    },
    /// One of several, and only the running program knows which: a part of [`Script::lists`].
    Any {
        /// The first.
        first: u32,
        /// Behind the last.
        end: u32,
    },
    /// Another position, the `base`-th of [`Script::lists`], displaced.
    Displaced {
        /// Index in [`Script::lists`].
        base: u32,
        /// By what.
        by: DisplacementId,
    },
    /// Another position, the `base`-th of [`Script::lists`], displaced by what the call of the routine
    /// says.
    DisplacedByCall {
        /// Index in [`Script::lists`].
        base: u32,
        /// Index in [`Script::by_calls`].
        by: u32,
    },
    /// The product of frames: an index of [`Script::products`].
    Product(u32),
    /// Only the running program knows, or nobody does.
    Unknown(RemarkId),
}

/// A tool or a work frame that is the product of others, the first one outermost.
#[derive(Clone, Debug, PartialEq)]
pub struct Product {
    /// Its name in the program.
    pub name: Box<str>,
    /// What is multiplied.
    pub factors: Box<[Expr]>,
    /// What is to be said where one of them is not known.
    pub otherwise: RemarkId,
}

/// One factor of a product of frames whose factors are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Factor {
    /// A frame or a record.
    Value(ValueId),
    /// A position with numbers in the files.
    Target(u32),
}

impl Expr {
    /// The variable that it is.
    #[must_use]
    pub fn variable(self) -> Option<VariableId> {
        match self {
            Self::Variable(variable) => Some(variable),
            _ => None,
        }
    }
}

/// By what a position is displaced, by the call of its routine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ByCall {
    /// Holds the number of the call.
    pub call: VariableId,
    /// By number.
    pub by: BTreeMap<i64, DisplacementId>,
    /// In a call that has no number, or where the routine is not called.
    pub otherwise: DisplacementId,
}

/// Why something is unknown, refused, or worth a word.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Remark {
    /// Identifier of the finding.
    pub id: &'static str,
    /// How much it matters: at an error the target stays and the program is refused.
    pub severity: Severity,
    /// What is wrong: a sentence without its subject where `of_target`, else a whole one.
    pub text: Cow<'static, str>,
    /// The way out.
    pub hint: &'static str,
}

impl Remark {
    const fn new(
        id: &'static str,
        severity: Severity,
        text: Cow<'static, str>,
        hint: &'static str,
    ) -> Self {
        Self {
            id,
            severity,
            text,
            hint,
        }
    }

    /// Why a move or a target is refused.
    #[must_use]
    pub const fn error(id: &'static str, text: &'static str, hint: &'static str) -> Self {
        Self::new(id, Severity::Error, Cow::Borrowed(text), hint)
    }

    /// Likewise, in words that name something.
    #[must_use]
    pub const fn error_about(id: &'static str, text: String, hint: &'static str) -> Self {
        Self::new(id, Severity::Error, Cow::Owned(text), hint)
    }

    /// What a person should look at.
    #[must_use]
    pub const fn warning(id: &'static str, text: &'static str, hint: &'static str) -> Self {
        Self::new(id, Severity::Warning, Cow::Borrowed(text), hint)
    }

    /// Likewise, in words that name something.
    #[must_use]
    pub const fn warning_about(id: &'static str, text: String, hint: &'static str) -> Self {
        Self::new(id, Severity::Warning, Cow::Owned(text), hint)
    }

    /// What a person may like to know.
    #[must_use]
    pub const fn note(id: &'static str, text: &'static str, hint: &'static str) -> Self {
        Self::new(id, Severity::Note, Cow::Borrowed(text), hint)
    }

    /// Likewise, in words that name something.
    #[must_use]
    pub const fn note_about(id: &'static str, text: String, hint: &'static str) -> Self {
        Self::new(id, Severity::Note, Cow::Owned(text), hint)
    }

    /// As a finding at a byte of a file.
    #[must_use]
    pub fn found_in(self, source: &Source, offset: u32) -> Finding {
        let text = self.text.into_owned();
        source.finding(offset as usize, self.id, self.severity, text, self.hint)
    }

    /// Against a position whose external axis the program writes.
    #[must_use]
    pub fn external_written(axis: &str) -> Self {
        Self::error_about(
            "external-value-unknown",
            format!(
                "the running program writes external axis {axis} of the position that this move \
                 goes to: its correction would be that of another place"
            ),
            "write the position with all its numbers, one for each value of the axis",
        )
    }

    /// Why a target is refused whose external axis nobody knows; a value that is not a number is an
    /// expression.
    #[must_use]
    pub fn external_unknown(name: &str, value: f64) -> Self {
        let to = if value.is_nan() {
            "an expression".to_owned()
        } else {
            value.to_string()
        };
        Self::error_about(
            "external-axis-unknown",
            format!("external axis {name} is {to}, and the profile does not say what that carries"),
            "describe it under `external_axes` of the profile: as an axis of `track:` or of one of \
             `positioners:`, or in `other:` where it moves nothing that a pose depends on",
        )
    }
}

/// An index or place: files are below 4 GiB, so that there are fewer of anything.
///
/// # Panics
/// If it is not.
#[must_use]
pub fn short(index: usize) -> u32 {
    u32::try_from(index).expect("sources are smaller than 4 GiB")
}
