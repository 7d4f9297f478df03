//! Routines and their statements.

use super::{
    DisplacementId, Expr, Label, ModalId, NOT_DISPLACED, Place, RemarkId, RoutineId, TURNED,
    TableId, VariableId, short,
};
use crate::program::{Motion, SpeedZone};
use std::ops::Range;

/// A routine, or the text of a file outside routines.
#[derive(Clone, Debug, PartialEq)]
pub struct Routine {
    /// Its name; empty outside routines.
    pub name: Box<str>,
    /// Where it begins.
    pub place: Place,
    /// Who starts it.
    pub start: Start,
    /// Its statements, a part of [`super::Script::statements`].
    pub statements: Range<u32>,
    /// Its moves, a part of [`super::Script::instructions`].
    pub instructions: Range<u32>,
}

/// Who starts a routine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Calls; the operator where nothing calls it.
    Called,
    /// Calls alone: it is part of another routine.
    Inner,
    /// The controller or the operator, calls or not (`main`).
    Main,
    /// An event: it runs between any two statements, or concurrently with them.
    Concurrent,
}

/// A statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statement {
    /// Index in [`super::Script::instructions`].
    Move(u32),
    /// Index in [`super::Script::writes`].
    Write(u32),
    /// Index in [`super::Script::calls`].
    Call(u32),
    /// Starts routines that then run concurrently with this one ([`Start::Concurrent`]): index in
    /// [`super::Script::calls`].
    Start(u32),
    /// Statements come here.
    Label(Label),
    /// Goes on there, or with the next statement.
    Branch(Label),
    /// Goes on there or with the next statement as a variable says: index in
    /// [`super::Script::conditions`].
    BranchUnless(u32),
    /// Goes on there.
    Jump(Label),
    /// Back to the caller.
    Return,
    /// The program ends.
    Exit,
    /// The routine ends with an error, which its caller has then; behind the last of them the
    /// program stops.
    Raise,
    /// Behind a call, one or several: there the program goes on, where a routine that it calls ends
    /// with an error. Where none follows, the caller ends with it, too.
    Catch(Label),
    /// A loop begins that is in no other one whose rounds the text counts: index in
    /// [`super::Script::loops`].
    Enter(u32),
}

/// A loop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loop {
    /// Its statements, a part of [`super::Script::statements`].
    pub statements: Range<u32>,
    /// How many rounds it makes at most each time it begins; `None` where the text does not tell.
    pub most: Option<u32>,
    /// It is in no other loop, or in one whose rounds the text does not count.
    pub is_outer: bool,
}

/// What a branch depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Condition {
    /// Its variable may hold what only the running program knows.
    pub test: Test,
    /// The next statement follows where that holds, else the one here.
    pub otherwise: Label,
}

/// A variable, and what it is to hold.
pub type Test = (VariableId, Wanted);

/// What a variable is to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// This [`Held::Flag`](super::Held::Flag).
    Flag(bool),
    /// This [`Held::Number`](super::Held::Number).
    Number(i64),
    /// Another one.
    NotNumber(i64),
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
    /// Of these bytes.
    ///
    /// # Panics
    /// Beyond 4 GiB.
    #[must_use]
    pub fn of(range: Range<usize>) -> Self {
        Self {
            start: short(range.start),
            end: short(range.end),
        }
    }

    /// As a range of indices; `None` where there is none.
    #[must_use]
    pub fn range(self) -> Option<Range<usize>> {
        (self.end > self.start).then_some(self.start as usize..self.end as usize)
    }
}

/// What a move from where the robot is makes of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn {
    /// It stands.
    Stays,
    /// It goes there, radians.
    To(f64),
    /// It turns by so much, radians.
    By(f64),
}

impl Turn {
    /// Where the joints are then.
    #[must_use]
    pub fn apply(turned: &[Self; 6], q: &[f64; 6]) -> [f64; 6] {
        std::array::from_fn(|i| match turned[i] {
            Self::Stays => q[i],
            Self::To(angle) => angle,
            Self::By(angle) => q[i] + angle,
        })
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
    /// Where a positioner carries the work frame, the path is relative to it.
    pub coordinated: bool,
    /// Where to.
    pub target: Expr,
    /// Index in [`super::Script::modals`]; [`Builder::go`](super::Builder::go) sets it.
    pub modal: ModalId,
    /// The joints, radians, from which the controller's inverse starts.
    pub near: Option<Box<[f64; 6]>>,
    /// What becomes of each joint, where the move turns joints from where the robot is.
    pub turned: Option<Box<[Turn; 6]>>,
    /// Added to the target by the instruction itself.
    pub displacement: DisplacementId,
    /// Where its target stands in it.
    pub target_span: Span,
    /// It does more than go to its target: it cannot be written again.
    pub does_more: bool,
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
            coordinated: true,
            target: Expr::Absent,
            modal: 0,
            near: None,
            turned: None,
            displacement: NOT_DISPLACED,
            target_span: Span::default(),
            does_more: false,
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
    /// Index in [`super::Script::guards`]: variables that may hold a [`Held::Remark`](super::Held::Remark) against this move.
    pub guards: u32,
    /// Index in [`super::Script::expected`]: numbers that variables should hold at this move.
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
    /// [`super::Script::parts`].
    Parts {
        /// Index of the first part in the record.
        first: u32,
        /// What they become.
        parts: Range<u32>,
    },
    /// A part of it, in a manner that only the running program knows.
    PartSomehow(RemarkId),
    /// A part of a position becomes a number that is not what it was and something more.
    PartNumber(RemarkId),
    /// A part of a position grows by a number of the text, or its orientation changes: that
    /// displaces it.
    PartBy(RemarkId, DisplacementId),
    /// An external axis of a position becomes another one: for targets that is refused with the remark,
    /// where there is one.
    Axis(Option<RemarkId>),
    /// A part of a position becomes the same part of another position, displaced along it.
    PartOf {
        /// Why it is not what it was.
        remark: RemarkId,
        /// The other position.
        of: Expr,
        /// Which axis of the work frame that is: 0 to 2.
        axis: usize,
        /// What is added along it.
        by: DisplacementId,
    },
}

impl How {
    /// A part of a position becomes what is not followed: something more than it was (`is_own`), or something that has nothing to do with that. `is_angle` where it is one of the
    /// orientation.
    #[must_use]
    pub fn part(is_own: bool, is_angle: bool, remark: RemarkId) -> Self {
        match (is_own, is_angle) {
            (true, true) => Self::PartBy(remark, TURNED),
            (true, false) => Self::PartSomehow(remark),
            (false, _) => Self::PartNumber(remark),
        }
    }
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
    /// It may leave the robot elsewhere than the text says; of a start: what runs then may move the
    /// robot.
    pub leads: bool,
    /// Which of them it is the files do not say, and perhaps none: each counts by what it writes
    /// alone, and as one that nothing calls.
    pub writes_only: bool,
    /// What is called, for messages.
    pub name: Box<str>,
    /// In [`super::Script::arguments`].
    pub arguments: Range<u32>,
}

impl Call {
    /// A call of these routines; of one that is not in the files where they are none.
    #[must_use]
    pub fn of(
        place: Place,
        callees: Box<[RoutineId]>,
        name: impl Into<Box<str>>,
        arguments: Range<u32>,
    ) -> Self {
        Self {
            place,
            foreign: callees.is_empty(),
            leads: callees.is_empty(),
            writes_only: false,
            callees,
            name: name.into(),
            arguments,
        }
    }
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

impl Argument {
    /// What a parameter is given, and what may be written through it.
    #[must_use]
    pub fn new(parameter: Option<VariableId>, value: Expr, back: Option<VariableId>) -> Self {
        Self {
            parameter,
            value,
            back,
        }
    }
}
