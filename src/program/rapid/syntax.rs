//! What the reader notes of a text before names are resolved.

use super::aggregate::Leaf;
use super::names::{Context, Symbol, Symbols};
use crate::program::{Number, Target, TargetId};
use std::ops::Range;

/// Everything noted of all files.
#[derive(Debug, Default)]
pub struct Notes {
    /// Names.
    pub symbols: Symbols,
    /// File of each module.
    pub modules: Vec<u32>,
    /// Routines.
    pub routines: Vec<Routine>,
    /// Declarations and parameters of the types that matter.
    pub data: Vec<Datum>,
    /// Targets with their place; blocked where their numbers are not all there.
    pub targets: Vec<Target>,
    /// Numbers of targets.
    pub numbers: Vec<Number>,
    /// What elements of declared targets hold.
    pub elements: Vec<Element>,
    /// Parts of tools, frames and their assignments.
    pub leaves: Vec<Leaf>,
    /// Names in expressions.
    pub mentions: Vec<Symbol>,
    /// Calls of Offs and `RelTool`.
    pub steps: Vec<Step>,
    /// Indices of names in arguments.
    pub indices: Vec<Index>,
    /// Arguments of instructions.
    pub arguments: Vec<Argument>,
    /// Statements that matter, by file and place.
    pub statements: Vec<Statement>,
    /// A number of a target that no robot can use, if the target is one that is moved to.
    pub bad_values: Vec<BadValue>,
}

impl Notes {
    /// Makes room for what a file of this size may hold, so that lists need not move while they grow: a target with its
    /// numbers takes some 150 bytes, a statement 40.
    pub fn reserve(&mut self, bytes: usize) {
        self.targets.reserve(bytes / 150);
        self.numbers.reserve(bytes / 14);
        self.data.reserve(bytes / 150);
        self.elements.reserve(bytes / 150);
        self.statements.reserve(bytes / 40);
        self.arguments.reserve(bytes / 20);
    }

    /// The index of a name in an argument; 0 is none.
    pub fn index(&self, index: u32) -> Index {
        match index {
            0 => Index::Whole,
            _ => self.indices[index as usize - 1],
        }
    }
}

/// A part of [`Notes::leaves`], [`Notes::mentions`], [`Notes::elements`] or [`Notes::arguments`].
pub type Part = (u32, u32);

/// A part as a range of indices.
pub fn indices(part: Part) -> Range<usize> {
    part.0 as usize..part.1 as usize
}

/// A number that makes its target unusable.
#[derive(Clone, Copy, Debug)]
pub struct BadValue {
    /// The target.
    pub target: TargetId,
    /// What is wrong.
    pub fault: super::tokens::Fault,
}

/// A procedure, function or trap.
#[derive(Clone, Copy, Debug)]
pub struct Routine {
    /// Its name.
    pub name: Symbol,
    /// Its module.
    pub module: u32,
    /// Seen in its module only.
    pub local: bool,
    /// Its statements run one after another: no branches, loops, jumps, labels or error handlers.
    pub straight: bool,
}

/// The types of data that matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    Robtarget,
    Jointtarget,
    Tooldata,
    Wobjdata,
    Num,
    /// Anything else; noted because it may hide a name.
    Other,
}

impl Type {
    /// The type of this name, in lower case.
    pub fn named(name: &[u8]) -> Self {
        match name {
            b"robtarget" => Self::Robtarget,
            b"jointtarget" => Self::Jointtarget,
            b"tooldata" => Self::Tooldata,
            b"wobjdata" => Self::Wobjdata,
            b"num" | b"dnum" => Self::Num,
            _ => Self::Other,
        }
    }

    /// Whether a robot can go to it.
    pub fn is_target(self) -> bool {
        matches!(self, Self::Robtarget | Self::Jointtarget)
    }
}

/// Where something stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Index of the file.
    pub file: u32,
    /// Byte in it.
    pub offset: u32,
}

/// A declaration or a parameter.
#[derive(Clone, Copy, Debug)]
pub struct Datum {
    pub name: Symbol,
    pub kind: Type,
    pub context: Context,
    pub place: Place,
    pub local: bool,
    /// Parameter of a routine: its value comes from the call.
    pub parameter: bool,
    /// CONST: it cannot be assigned.
    pub constant: bool,
    pub value: Stored,
}

/// What a declaration gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stored {
    /// No value.
    Nothing,
    /// Targets: a single one where `sizes` is all zero, else an array; part of [`Notes::elements`].
    Elements { elements: Part, sizes: [u32; 3] },
    /// A tool or frame, part of [`Notes::leaves`].
    Leaves(Part),
    /// An array of tools or frames, or a value that is not written out.
    Computed(Part),
    /// A number.
    Number(f64),
}

/// An element of declared targets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// A target with its own numbers (or blocked because they are expressions).
    Target(TargetId),
    /// The name of another one.
    Named(Symbol),
    /// Anything else.
    Computed,
}

/// The index in braces after a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Index {
    /// None.
    Whole,
    /// Constants, from 1; 0 where there is no further one.
    At([u32; 3]),
    /// Known at run time only.
    Variable,
}

/// What stands in an argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expression {
    /// Nothing: an option without value.
    Nothing,
    /// A name or a target written out, displaced by `steps` from the innermost out: part of [`Notes::steps`].
    Point { base: Base, steps: Part },
    /// Anything else, with the names in it: part of [`Notes::mentions`].
    Computed(Part),
}

/// What Offs and `RelTool` start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// A name, perhaps with an index: see [`Notes::index`].
    Named { name: Symbol, index: u32 },
    /// A target written out.
    Target(u32),
}

/// One call of Offs or `RelTool`: amounts x, y, z in mm and about x, y, z in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    Offs([Amount; 3]),
    RelTool([Amount; 6]),
}

/// A number in a call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    Number(f64),
    /// A name, which may be a constant, times 1 or -1.
    Named(Symbol, f64),
    /// Anything else.
    Computed,
}

/// An argument of an instruction.
#[derive(Clone, Copy, Debug)]
pub struct Argument {
    /// Name after the backslash.
    pub option: Option<Symbol>,
    /// What stands there.
    pub expression: Expression,
}

/// A statement that matters.
#[derive(Clone, Copy, Debug)]
pub struct Statement {
    pub place: Place,
    pub context: Context,
    pub kind: StatementKind,
}

/// The part of a datum that an assignment sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// All of it.
    Whole,
    /// Leaves of a tool or frame from this one on (see [`super::aggregate`]).
    Leaves(u8),
    /// Any other.
    Other,
}

/// Which statement.
#[derive(Clone, Copy, Debug)]
pub enum StatementKind {
    /// `name.component := value`; what it names, and leaves where they are written out.
    Assign {
        name: Symbol,
        index: Index,
        component: Component,
        leaves: Option<Part>,
        mentions: Part,
        target: Option<TargetId>,
    },
    /// An instruction or a procedure call.
    Call {
        /// `None` for a late-bound call.
        name: Option<Symbol>,
        verb: Verb,
        arguments: Part,
    },
}

/// What an instruction does, as far as it matters here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verb {
    /// Goes to its targets.
    Move {
        path: Path,
        /// The first argument that can be a target, where the name tells.
        first: u8,
        /// The tool stands after targets, speed and zone, before other arguments.
        tool_inside: bool,
    },
    /// `ConfL`
    ConfL,
    /// `ConfJ`
    ConfJ,
    /// `PDispOn`, `PDispSet`
    ProgramDisplacement,
    /// `PDispOff`
    ProgramDisplacementOff,
    /// `EOffsOn`, `EOffsSet`
    ExternalOffset,
    /// `EOffsOff`
    ExternalOffsetOff,
    /// Measures and writes the tool in its arguments.
    WritesTool,
    /// `GripLoad`
    GripLoad,
    /// An instruction of the language that moves nothing and changes no target.
    Harmless,
    /// A procedure, or an instruction that is not known.
    Other,
}

/// How a move goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    Joint,
    /// To a joint target.
    Absolute,
    Linear,
    Arc,
}
