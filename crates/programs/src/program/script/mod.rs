//! What program files say, statement by statement and in no language: what readers hand to
//! [`crate::motion`].
//!
//! A reader translates; it does not follow. It says *here is a move to this with that*, *here this
//! variable is written*, *here a block may be passed over*, *here that routine is called with these
//! arguments*. Which tool a variable holds at a move and from where the robot comes there is worked
//! out in [`crate::motion`], once for all languages.

mod adding;
mod builder;
mod order;

pub use builder::Builder;

use super::{Displacement, External, Load, Motion, Number, SpeedZone, Target, TargetId};
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
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

/// The statements of all files.
#[derive(Debug)]
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
    /// Routines, by file and place; text outside routines is one too.
    pub routines: Vec<Routine>,
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
    /// What speaks against targets themselves, should a move go to them.
    pub refused: Vec<(TargetId, RemarkId)>,
    /// Where targets say that external axes stand, by target.
    pub externals: Vec<(TargetId, External)>,
    /// Likewise moves, by index in [`Script::instructions`]: they go before their targets.
    pub externals_of_moves: Vec<(u32, External)>,
    /// What moves add to where their targets say that external axes stand, likewise.
    pub external_shifts: Vec<(u32, External)>,
    /// Sets of what moves expect variables to hold, see [`Modal::expected`].
    pub expected: Vec<Box<[Expected]>>,
    /// What no move in the files uses, nothing uses: targets cannot be named from other files.
    pub is_closed: bool,
    /// How many labels there are.
    pub labels: u32,
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
            ],
            routines: Vec::new(),
            statements: Vec::new(),
            instructions: Vec::new(),
            modals: Vec::new(),
            writes: Vec::new(),
            calls: Vec::new(),
            arguments: Vec::new(),
            conditions: Vec::new(),
            guards: vec![Box::default()],
            refused: Vec::new(),
            externals: Vec::new(),
            externals_of_moves: Vec::new(),
            external_shifts: Vec::new(),
            expected: vec![Box::default()],
            is_closed: false,
            labels: 0,
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
    /// The load of the flange; none where it is set to nothing.
    Load(Option<Load>),
    /// The number of a tool or frame.
    Number(i64),
    /// On or off.
    Flag(bool),
    /// As long as this holds there is something to say of each move; it is refused where the remark
    /// is an error.
    Remark(RemarkId),
    /// Where the robot is when the statement runs.
    Actual,
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
    /// Only the running program knows, or nobody does.
    Unknown(RemarkId),
}

/// Why something is unknown, refused, or worth a word.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Remark {
    /// Identifier of the finding.
    pub id: &'static str,
    /// How much it matters: at an error the target stays and the program is refused.
    pub severity: Severity,
    /// What is wrong: a sentence without its subject where `of_target`, else a whole one.
    pub text: Box<str>,
    /// The way out.
    pub hint: &'static str,
}

impl Remark {
    /// Why a move or a target is refused.
    #[must_use]
    pub fn error(id: &'static str, text: impl Into<Box<str>>, hint: &'static str) -> Self {
        Self {
            id,
            severity: Severity::Error,
            text: text.into(),
            hint,
        }
    }

    /// What a person should look at.
    #[must_use]
    pub fn warning(id: &'static str, text: impl Into<Box<str>>, hint: &'static str) -> Self {
        Self {
            severity: Severity::Warning,
            ..Self::error(id, text, hint)
        }
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
        Self::error(
            "external-axis-unknown",
            format!("external axis {name} is {to}, and the profile does not say what that carries"),
            "describe it under `external_axes` of the profile: as an axis of `track:` or of one of \
             `positioners:`, or in `other:` where it moves nothing that a pose depends on",
        )
    }
}

/// A routine, or the text of a file outside routines.
#[derive(Clone, Debug, PartialEq)]
pub struct Routine {
    /// Its name; empty outside routines.
    pub name: Box<str>,
    /// Where it begins.
    pub place: Place,
    /// Who starts it.
    pub start: Start,
    /// Its statements, a part of [`Script::statements`].
    pub statements: Range<u32>,
    /// Its moves, a part of [`Script::instructions`].
    pub instructions: Range<u32>,
}

/// Who starts a routine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Calls; the operator where nothing calls it.
    Called,
    /// The controller or the operator, calls or not (`main`).
    Main,
    /// An event: it runs between any two statements, or concurrently with them.
    Concurrent,
}

/// A statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statement {
    /// Index in [`Script::instructions`].
    Move(u32),
    /// Index in [`Script::writes`].
    Write(u32),
    /// Index in [`Script::calls`].
    Call(u32),
    /// Starts routines that then run concurrently with this one ([`Start::Concurrent`]): index in
    /// [`Script::calls`].
    Start(u32),
    /// Statements come here.
    Label(Label),
    /// Goes on there, or with the next statement.
    Branch(Label),
    /// Goes on there or with the next statement as a variable says: index in
    /// [`Script::conditions`].
    BranchUnless(u32),
    /// Goes on there.
    Jump(Label),
    /// Back to the caller.
    Return,
    /// The program ends.
    Exit,
}

/// What a branch depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Condition {
    /// It holds a [`Held::Flag`], or what only the running program knows.
    pub variable: VariableId,
    /// The next statement follows where the variable holds this, …
    pub wanted: bool,
    /// … else the one here.
    pub otherwise: Label,
}

/// A range of bytes of the file of its instruction; empty where there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// Behind the last.
    pub end: u32,
}

impl Span {
    /// As a range of indices; `None` where there is none.
    #[must_use]
    pub fn range(self) -> Option<Range<usize>> {
        (self.end > self.start).then_some(self.start as usize..self.end as usize)
    }
}

/// A move. An arc is two: one to the point it passes through and one to its end, with the same
/// span.
#[derive(Clone, Debug, PartialEq)]
pub struct Instruction {
    /// File and first byte.
    pub place: Place,
    /// Behind its last byte.
    pub end: u32,
    /// How the robot gets there.
    pub motion: Motion,
    /// On the path the orientation is free (`SingArea \Wrist`, `Wjnt`): only the end counts.
    pub free_orientation: bool,
    /// Where to.
    pub target: Expr,
    /// Index in [`Script::modals`]; [`Builder::go`] sets it.
    pub modal: ModalId,
    /// The joints, radians, from which the controller's inverse starts.
    pub near: Option<Box<[f64; 6]>>,
    /// Added to the target by the instruction itself.
    pub displacement: DisplacementId,
    /// Where its target stands in it.
    pub target_span: Span,
}

impl Instruction {
    /// A joint move to nowhere, of no length: what is not named is as most moves have it.
    #[must_use]
    pub fn at(place: Place) -> Self {
        Self {
            place,
            end: place.offset,
            motion: Motion::Joint,
            free_orientation: false,
            target: Expr::Absent,
            modal: 0,
            near: None,
            displacement: NOT_DISPLACED,
            target_span: Span::default(),
        }
    }

    /// Its bytes in its file.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        self.place.offset as usize..self.end as usize
    }
}

/// With what a move runs: mostly with the same as the one before it, so that it stands once for
/// both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Modal {
    /// With which tool.
    pub tool: Expr,
    /// In which work frame.
    pub frame: Expr,
    /// With which load where it is not the tool's own.
    pub load: Expr,
    /// Whether the controller honours configuration data in this move: a flag.
    pub configured: Expr,
    /// A flag of the controller that leaves the orientation free on the path, too.
    pub wrist: Expr,
    /// Index in [`Script::guards`]: variables that may hold a [`Held::Remark`] against this move.
    pub guards: u32,
    /// Index in [`Script::expected`]: numbers that variables should hold at this move.
    pub expected: u32,
    /// Speed and corner.
    pub speed_zone: SpeedZone,
}

impl Default for Modal {
    /// Nothing is said.
    fn default() -> Self {
        Self {
            tool: Expr::Absent,
            frame: Expr::Absent,
            load: Expr::Absent,
            configured: Expr::Absent,
            wrist: Expr::Absent,
            guards: 0,
            expected: 0,
            speed_zone: SpeedZone::default(),
        }
    }
}

/// A number that a variable should hold at a move; a word where it certainly holds another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Expected {
    /// The variable.
    pub variable: VariableId,
    /// The number.
    pub number: i64,
    /// What is said where the other number was written.
    pub remark: RemarkId,
}

/// A write of a variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Write {
    /// Where.
    pub place: Place,
    /// What is written.
    pub variable: Written,
    /// What it is then.
    pub how: How,
}

/// What a write may concern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// A variable.
    One(VariableId),
    /// One of a table, and only the running program knows which.
    AnyOf(TableId),
}

/// How a variable is written.
#[derive(Clone, Debug, PartialEq)]
pub enum How {
    /// As a whole.
    Whole(Expr),
    /// Some parts of a record or of a position: those from `first` on become these
    /// [`Script::parts`].
    Parts {
        /// Index of the first part in the record.
        first: u32,
        /// What they become.
        parts: Range<u32>,
    },
    /// A part of it, in a manner that only the running program knows.
    PartSomehow(RemarkId),
    /// A part of a position becomes a number of the text.
    PartNumber(RemarkId),
    /// A part of a position grows by a number of the text: that displaces it.
    PartBy(RemarkId, DisplacementId),
}

/// A call.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// Where.
    pub place: Place,
    /// The routines that it may call; none where it is not in the files.
    pub callees: Box<[RoutineId]>,
    /// It may also be one that is not in the files, which then may write what it is given, and
    /// what is shared.
    pub foreign: bool,
    /// What is called, for messages.
    pub name: Box<str>,
    /// In [`Script::arguments`].
    pub arguments: Range<u32>,
}

/// An argument of a call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Argument {
    /// The parameter, a variable of the callee; `None` where it is not known.
    pub parameter: Option<VariableId>,
    /// What it is given.
    pub value: Expr,
    /// The caller's variable that the routine may write through it.
    pub back: Option<VariableId>,
}

impl How {
    /// A part of a position becomes what a text says: a number, or what the running program
    /// computes.
    #[must_use]
    pub fn part(text: &[u8], remark: RemarkId) -> Self {
        let text = text.trim_ascii();
        let text = text.strip_prefix(b"=").unwrap_or(text).trim_ascii();
        let inside = text.strip_prefix(b"(").and_then(|t| t.strip_suffix(b")"));
        if super::number::parse(inside.unwrap_or(text).trim_ascii()).is_some() {
            Self::PartNumber(remark)
        } else {
            Self::PartSomehow(remark)
        }
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
