//! What the files say, before names are resolved.

use super::tokens::{Fault, Place};
use crate::program::rapid::names::{Context, Symbol, Symbols};
use crate::program::{Number, Target, TargetId};

/// A stretch of one of the lists in [`Notes`].
pub type Part = (u32, u32);

/// A stretch as indices.
pub fn indices((start, end): Part) -> std::ops::Range<usize> {
    start as usize..end as usize
}

/// Which element of an array is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Index {
    /// The variable itself.
    Whole,
    /// This element.
    At([u32; 3]),
    /// One that only the running program knows.
    Variable,
}

/// What a variable holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DataKind {
    /// FRAME: a target where a move goes to it, else an offset or a work frame.
    Frame,
    /// POS, E3POS, E6POS.
    Position,
    /// AXIS, E3AXIS, E6AXIS.
    Axes,
    /// FDAT: numbers of a tool and a base.
    Fdat,
    /// Anything else.
    Other,
}

impl DataKind {
    /// The kind of a type in capitals.
    pub fn named(word: &[u8]) -> Self {
        match word {
            b"FRAME" => Self::Frame,
            b"POS" | b"E3POS" | b"E6POS" => Self::Position,
            b"AXIS" | b"E3AXIS" | b"E6AXIS" => Self::Axes,
            b"FDAT" => Self::Fdat,
            _ => Self::Other,
        }
    }
}

/// A declared variable.
#[derive(Clone, Copy, Debug)]
pub struct Datum {
    pub name: Symbol,
    pub context: Context,
    pub global: bool,
    pub kind: DataKind,
    pub place: Place,
}

/// A value that a data list gives to a variable.
#[derive(Clone, Copy, Debug)]
pub struct Initial {
    pub name: Symbol,
    pub index: Index,
    pub context: Context,
    pub value: Stored,
}

/// The value of a variable.
#[derive(Clone, Copy, Debug)]
pub enum Stored {
    /// A position or axes.
    Target(TargetId),
    /// Numbers of a tool and a base.
    Fdat(Fdat),
    /// Not written out.
    Computed,
}

/// What FDAT tells; `None` is: it does not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fdat {
    pub tool: Option<u32>,
    pub base: Option<u32>,
    pub ipo: Ipo,
}

/// Which of tool and base the robot holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ipo {
    /// The tool.
    Base,
    /// The work piece; the tool stands still.
    Tcp,
    /// Only the running program knows.
    Computed,
}

/// A table of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Table {
    Tool,
    Base,
}

/// A frame given to an entry of a table.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    pub table: Table,
    /// `None`: one that only the running program knows.
    pub index: Option<u32>,
    pub place: Place,
    /// By a statement, not by a data list.
    pub assigned: bool,
    /// X Y Z A B C; `None`: not written out, or not all.
    pub value: Option<[f64; 6]>,
}

/// A load of `LOAD_DATA`.
#[derive(Clone, Copy, Debug)]
pub struct LoadEntry {
    pub index: u32,
    pub mass_kg: f64,
    pub cog_mm: [f64; 3],
}

/// A value given to $TOOL, $BASE, `$IPO_MODE` or `FDAT_ACT`.
#[derive(Clone, Copy, Debug)]
pub enum Given {
    /// An entry of its table.
    Entry(u32),
    /// $NULLFRAME or, for a base, $WORLD.
    Zero,
    /// A variable.
    Named(Symbol, Index),
    /// Numbers.
    Literal([f64; 6]),
    /// What an FDAT says.
    OfFdat(Symbol, Index),
    /// Numbers of a tool and a base.
    Fdat(Fdat),
    /// A mode.
    Ipo(Ipo),
    /// EK: a base that hangs on another kinematic.
    Moving,
    /// Only the running program knows.
    Computed,
}

/// What is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    Tool,
    Base,
    Ipo,
    Fdat,
}

/// How the robot goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    Joint,
    Linear,
    Arc,
}

/// An argument of a move.
#[derive(Clone, Copy, Debug)]
pub enum Point {
    /// Written out here.
    Inline(TargetId),
    /// A variable.
    Named(Symbol, Index),
    /// Where the robot is or was: `$AXIS_ACT`, `$POS_RET`.
    Present,
    /// Operands between colons, part of [`Notes::operands`].
    Product(Part),
    /// An expression.
    Computed,
}

/// Part of a product of frames.
#[derive(Clone, Copy, Debug)]
pub enum Operand {
    Inline(TargetId),
    Named(Symbol, Index),
    Other,
}

/// Frames that a move or a spline block sets for itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct With {
    pub tool: Option<Given>,
    pub base: Option<Given>,
    pub ipo: Option<Given>,
}

/// Index of no entry of [`Notes::withs`].
pub const NO_WITH: u32 = u32::MAX;

/// Where control goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    If,
    Else,
    EndIf,
    Switch,
    Case,
    Default,
    EndSwitch,
    /// LOOP, WHILE, FOR, REPEAT.
    Repeat,
    /// ENDLOOP: left by EXIT only.
    EndEndless,
    /// ENDWHILE, ENDFOR: left at the top.
    EndCounted,
    /// UNTIL: left at the bottom.
    Until,
    Exit,
    Goto(Symbol),
    Label(Symbol),
    Return,
}

/// What BAS is called for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bas {
    /// #INITMOV.
    Init,
    /// `#FRAMES`, `#PTP_PARAMS`, `#CP_PARAMS`: tool and base of `FDAT_ACT`.
    Frames,
    /// #TOOL with a number, or one that only the running program knows.
    Tool(Option<u32>),
    /// #BASE.
    Base(Option<u32>),
}

/// What a statement does.
#[derive(Clone, Copy, Debug)]
pub enum Action {
    Move {
        path: Path,
        points: Part,
        with: u32,
    },
    /// A move relative to where the robot is; whether it is by axes, and by what in which frame where that is written out.
    Relative {
        path: Path,
        axes: bool,
        /// Index in [`Notes::offsets`].
        by: Option<u32>,
    },
    Spline(u32),
    EndSpline,
    /// By index in [`Notes::given`].
    Set(Variable, u32),
    Bas(Bas),
    Call(Symbol),
    Flow(Flow),
}

/// A statement that matters.
#[derive(Clone, Copy, Debug)]
pub struct Statement {
    pub place: Place,
    pub routine: u32,
    pub action: Action,
}

/// An assignment to a variable, or to a part of one.
#[derive(Clone, Copy, Debug)]
pub struct Assigned {
    pub name: Symbol,
    pub index: Index,
    pub context: Context,
    pub place: Place,
    /// Names in the expression, where a whole variable is assigned.
    pub mentions: Part,
}

/// A variable handed to a routine.
#[derive(Clone, Copy, Debug)]
pub struct Passed {
    pub name: Symbol,
    pub index: Index,
    pub context: Context,
    pub place: Place,
    pub callee: Symbol,
}

/// A routine.
#[derive(Clone, Copy, Debug)]
pub struct Routine {
    pub name: Symbol,
    pub module: u32,
    pub global: bool,
    /// Its part of [`Notes::statements`].
    pub statements: Part,
}

/// A module: the files of one name.
#[derive(Clone, Debug)]
pub struct Module {
    pub key: String,
    pub has_source: bool,
    /// The data list is one of the controller: only what moves use is a target.
    pub is_system: bool,
}

/// Why a target cannot be rewritten, seen where it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// Components are missing.
    Partial,
    /// Components are expressions.
    Computed,
}

/// All of it.
#[derive(Debug, Default)]
pub struct Notes {
    pub symbols: Symbols,
    pub modules: Vec<Module>,
    pub routines: Vec<Routine>,
    pub targets: Vec<Target>,
    pub numbers: Vec<Number>,
    /// Targets that cannot be rewritten, by index.
    pub flaws: Vec<(TargetId, Flaw)>,
    pub data: Vec<Datum>,
    pub initials: Vec<Initial>,
    pub entries: Vec<Entry>,
    pub loads: Vec<LoadEntry>,
    /// Bases that hang on another kinematic.
    pub moving_bases: Vec<u32>,
    pub statements: Vec<Statement>,
    pub given: Vec<Given>,
    /// Translations of relative moves, and whether they are in the tool's frame.
    pub offsets: Vec<([f64; 3], bool)>,
    pub points: Vec<Point>,
    pub operands: Vec<Operand>,
    pub withs: Vec<With>,
    pub assigned: Vec<Assigned>,
    pub mentions: Vec<Symbol>,
    pub passed: Vec<Passed>,
}

/// What reading gives where it fails.
pub type Read<T> = Result<T, Fault>;
