//! What the reader parsed of a text before names are resolved.

use super::aggregate::Leaf;
use super::asked::Asked;
use super::errors::Handles;
use super::verbs::Led;
use crate::program::names::{Context, Symbol, Symbols};
use crate::program::script::{Place, short};
use crate::program::{Number, Target, TargetId};
use foldhash::{HashMap, HashSet};
use std::collections::BTreeMap;
use std::ops::Range;

/// Everything noted of all files.
#[derive(Debug, Default)]
pub(super) struct Parsed {
    /// Names.
    pub symbols: Symbols,
    /// The names of modules; text between modules counts as one, without a name.
    pub modules: Vec<Option<Symbol>>,
    /// Routines.
    pub routines: Vec<Routine>,
    /// Declarations and parameters.
    pub data: Vec<Datum>,
    /// Targets with their place.
    pub targets: Vec<Target>,
    /// Numbers of targets.
    pub numbers: Vec<Number>,
    /// What elements of declared targets hold.
    pub elements: Vec<Element>,
    /// Parts of tools, frames, loads and their assignments.
    pub leaves: Vec<Leaf>,
    /// Names in expressions.
    pub mentions: Vec<Symbol>,
    /// Values with expressions in them.
    pub composed: Vec<Composed>,
    /// Names in the values of constants: the datum and a part of [`Parsed::mentions`].
    pub initial: Vec<(u32, Part)>,
    /// Calls of Offs and `RelTool`.
    pub steps: Vec<Step>,
    /// Indices of names in arguments.
    pub indices: Vec<Index>,
    /// Parameters that a routine hands on with `?` where they are given: the routine and the name.
    pub if_given: HashSet<(u32, Symbol)>,
    /// Parameters of which a routine asks whether they are given (`Present`).
    pub asked: HashSet<(u32, Symbol)>,
    /// Parameters about whose value branches of a routine ask.
    pub values_asked: HashSet<(u32, Symbol)>,
    /// Elements that statements name by constants, with a number of each from 1 on.
    pub places: BTreeMap<(Symbol, [u32; 3]), u32>,
    /// Arguments of instructions.
    pub arguments: Vec<Argument>,
    /// Functions that are called in expressions.
    pub functions: Vec<Function>,
    /// Their arguments.
    pub given: Vec<Argument>,
    /// FOR loops, by file and place.
    pub loops: Vec<Counting>,
    /// What numbers are declared with, by datum: the bytes.
    pub values: HashMap<u32, (u32, u32)>,
    /// Names that optional arguments of instructions may write.
    pub results: Vec<(Symbol, Context)>,
    /// Statements that matter, by file and place.
    pub statements: Vec<Statement>,
    /// Numbers of targets that no robot can use.
    pub bad_values: Vec<BadValue>,
    /// External axes of targets that are neither 9E9 nor 0: the axis and its value.
    pub external: Vec<(TargetId, u8, f64)>,
    /// For each target which of its external axes are 0, bit by bit.
    pub external_zeros: Vec<u8>,
}

/// Lengths of the lists that an argument adds to, to take it back.
#[derive(Clone, Copy)]
pub(super) struct Lengths([usize; 13]);

impl Parsed {
    /// Makes room for what a file of this size may hold, so that lists need not move while they
    /// grow: a target with its numbers takes some 150 bytes, a statement 40.
    pub(super) fn reserve(&mut self, bytes: usize) {
        self.targets.reserve(bytes / 150);
        self.numbers.reserve(bytes / 14);
        self.data.reserve(bytes / 150);
        self.elements.reserve(bytes / 150);
        self.statements.reserve(bytes / 40);
        self.arguments.reserve(bytes / 20);
    }

    /// The index of a name in an argument; 0 is none.
    pub(super) fn index(&self, index: u32) -> Index {
        match index {
            0 => Index::Whole,
            _ => self.indices[index as usize - 1],
        }
    }

    /// Keeps the index of a name in an argument: see [`Self::index`].
    pub(super) fn keep_index(&mut self, name: Symbol, index: Index) -> u32 {
        if index == Index::Whole {
            return 0;
        }
        self.note_place(name, index);
        self.indices.push(index);
        short(self.indices.len())
    }

    /// Notes that a statement names an element.
    pub(super) fn note_place(&mut self, name: Symbol, index: Index) {
        if let Index::At(place) = index {
            let next = short(self.places.len()) + 1;
            self.places.entry((name, place)).or_insert(next);
        }
    }

    /// The innermost FOR loop around a place that counts with this name.
    pub(super) fn counting(&self, name: Symbol, at: Place) -> Option<&Counting> {
        let place = |of: &Counting| (of.file, of.inside.0);
        let before = self
            .loops
            .partition_point(|of| place(of) <= (at.file, at.offset));
        let mut around = self.loops[..before].iter().rev();
        around.find(|of| of.counter == name && of.file == at.file && at.offset < of.inside.1)
    }

    /// The names in a value with expressions in it.
    pub(super) fn names_in(&self, value: &Expression) -> &[Symbol] {
        let names = match *value {
            Expression::Composed(at) | Expression::List(at) => self.composed[at as usize].names,
            Expression::Computed(names) => names,
            _ => (0, 0),
        };
        &self.mentions[indices(names)]
    }

    /// The elements of a name that statements name, each with its number.
    pub(super) fn places_of(&self, name: Symbol) -> impl Iterator<Item = ([u32; 3], u32)> {
        let all = (name, [0; 3])..=(name, [u32::MAX; 3]);
        let found = self.places.range(all);
        found.map(|(&(_, place), &number)| (place, number))
    }

    /// Whether there is nothing but calls with plain arguments: see [`super::ahead`].
    pub(super) fn has_calls_alone(&self) -> bool {
        let Self {
            symbols: _,
            targets: _,
            numbers: _,
            mentions: _,
            arguments: _,
            statements: _,
            external: _,
            external_zeros: _,
            modules,
            routines,
            data,
            elements,
            leaves,
            composed,
            initial,
            steps,
            indices,
            if_given,
            asked,
            values_asked,
            places,
            functions,
            given,
            loops,
            values,
            results,
            bad_values,
        } = self;
        modules.is_empty()
            && routines.is_empty()
            && data.is_empty()
            && elements.is_empty()
            && leaves.is_empty()
            && composed.is_empty()
            && initial.is_empty()
            && steps.is_empty()
            && indices.is_empty()
            && if_given.is_empty()
            && asked.is_empty()
            && values_asked.is_empty()
            && places.is_empty()
            && functions.is_empty()
            && given.is_empty()
            && loops.is_empty()
            && values.is_empty()
            && results.is_empty()
            && bad_values.is_empty()
    }

    /// How long the lists are.
    pub(super) fn lengths(&self) -> Lengths {
        Lengths([
            self.mentions.len(),
            self.steps.len(),
            self.targets.len(),
            self.numbers.len(),
            self.bad_values.len(),
            self.external.len(),
            self.external_zeros.len(),
            self.functions.len(),
            self.given.len(),
            self.statements.len(),
            self.indices.len(),
            self.leaves.len(),
            self.composed.len(),
        ])
    }

    /// Takes back what was added since.
    pub(super) fn shorten(&mut self, to: Lengths) {
        let to = to.0;
        self.mentions.truncate(to[0]);
        self.steps.truncate(to[1]);
        self.targets.truncate(to[2]);
        self.numbers.truncate(to[3]);
        self.bad_values.truncate(to[4]);
        self.external.truncate(to[5]);
        self.external_zeros.truncate(to[6]);
        self.functions.truncate(to[7]);
        self.given.truncate(to[8]);
        self.statements.truncate(to[9]);
        self.indices.truncate(to[10]);
        self.leaves.truncate(to[11]);
        self.composed.truncate(to[12]);
    }
}

/// A part of a list of [`Parsed`].
pub(super) type Part = (u32, u32);

/// A part as a range of indices.
pub(super) fn indices(part: Part) -> Range<usize> {
    part.0 as usize..part.1 as usize
}

/// A value in brackets with expressions in it.
#[derive(Clone, Debug)]
pub(super) struct Composed {
    /// The names in it, in [`Parsed::mentions`].
    pub names: Part,
    /// Of a target those in each of its coordinates or joints, of other values those in each part.
    pub places: Box<[Part]>,
    /// Where it begins.
    pub at: Place,
}

/// A number that makes its target unusable.
#[derive(Clone, Copy, Debug)]
pub(super) struct BadValue {
    /// The target.
    pub target: TargetId,
    /// What is wrong.
    pub fault: super::tokens::Fault,
}

/// A procedure, function or trap.
#[derive(Clone, Copy, Debug)]
pub(super) struct Routine {
    /// Its name.
    pub name: Symbol,
    /// Its module.
    pub module: u32,
    /// Where it begins.
    pub place: Place,
    /// Seen in its module only.
    pub local: bool,
    /// What a function gives back.
    pub gives: Type,
    /// It is called by itself, and gives nothing back.
    pub is_procedure: bool,
    /// An interrupt starts it.
    pub is_trap: bool,
    /// Its parameters, part of [`Parsed::data`].
    pub parameters: Part,
    /// It has an error handler, or an undo or backward handler.
    pub has_handler: bool,
}

/// The types of data that matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Type {
    Robtarget,
    Jointtarget,
    Tooldata,
    Wobjdata,
    Loaddata,
    Num,
    /// Anything else; noted because it may hide a name.
    Other,
}

impl Type {
    /// The type of this name, in lower case.
    pub(super) fn named(name: &[u8]) -> Self {
        match name {
            b"robtarget" => Self::Robtarget,
            b"jointtarget" => Self::Jointtarget,
            b"tooldata" => Self::Tooldata,
            b"wobjdata" => Self::Wobjdata,
            b"loaddata" => Self::Loaddata,
            b"num" | b"dnum" => Self::Num,
            _ => Self::Other,
        }
    }

    /// Whether a robot can go to it.
    pub(super) fn is_target(self) -> bool {
        matches!(self, Self::Robtarget | Self::Jointtarget)
    }

    /// Whether it is a tool or a work object.
    pub(super) fn is_frame(self) -> bool {
        matches!(self, Self::Tooldata | Self::Wobjdata)
    }

    /// Whether moves depend on it.
    pub(super) fn is_of_moves(self) -> bool {
        self.is_target() || self.is_frame() || self == Self::Loaddata
    }
}

/// How long data keep what is written into them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Storage {
    /// CONST: nothing can be written.
    Constant,
    /// PERS: from run to run, of one task or module.
    Persistent,
    /// PERS that is neither LOCAL nor TASK: all tasks that declare it have the same.
    Shared,
    /// VAR.
    Variable,
    /// A parameter, with what its caller gives; what is written into it is written back where
    /// `by_reference`.
    Parameter { by_reference: bool, optional: bool },
}

/// A declaration or a parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Datum {
    pub name: Symbol,
    pub kind: Type,
    pub context: Context,
    pub place: Place,
    pub local: bool,
    pub storage: Storage,
    pub value: Stored,
}

/// What a declaration gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stored {
    /// No value.
    Nothing,
    /// Targets: a single one where `sizes` is all zero, else an array; part of
    /// [`Parsed::elements`].
    Elements { elements: Part, sizes: [u32; 3] },
    /// A tool, frame or load, part of [`Parsed::leaves`].
    Leaves(Part),
    /// A row of so many tools or frames, one after the other in [`Parsed::leaves`].
    Row { leaves: Part, count: u32 },
    /// A value that is not written out, or an array without one.
    Computed,
    /// A number.
    Number(f64),
}

/// An element of declared targets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Element {
    /// A target with its own numbers.
    Target(TargetId),
    /// A copy of another one.
    Named(Symbol),
    /// Parts of it are expressions: index in [`Parsed::composed`].
    Composed(u32),
    /// Anything else.
    Computed,
}

/// The index in braces after a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Index {
    /// None.
    Whole,
    /// Constants, from 1; 0 where there is no further one.
    At([u32; 3]),
    /// Known at run time only.
    Variable,
}

/// What stands in an argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Expression {
    /// Nothing: an option without value.
    Nothing,
    /// A name, a target written out or what a function gives, displaced by `steps` from the
    /// innermost out: part of [`Parsed::steps`].
    Point { base: Base, steps: Part },
    /// A component of data.
    Member { name: Symbol, index: u32 },
    /// A target some of whose parts are expressions: index in [`Parsed::composed`].
    Composed(u32),
    /// Any other list in brackets: likewise.
    List(u32),
    /// Anything else, with the names in it: part of [`Parsed::mentions`].
    Computed(Part),
    /// A load that is written out: part of [`Parsed::leaves`].
    Load(Part),
    /// A string, without its quotes: its bytes.
    Text(u32, u32),
}

/// What Offs and `RelTool` start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Base {
    /// A name, perhaps with an index: see [`Parsed::index`].
    Named { name: Symbol, index: u32 },
    /// A target written out.
    Target(u32),
    /// One of [`Parsed::functions`].
    Function(u32),
}

/// One call of Offs or `RelTool`: amounts x, y, z in mm and about x, y, z in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Step {
    Offs([Amount; 3]),
    RelTool([Amount; 6]),
}

/// What a FOR loop counts with, which hides data of its name there and which nothing writes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counting {
    pub counter: Symbol,
    pub file: u32,
    /// The bytes from `FROM` to `DO`, and those of the loop.
    pub range: (u32, u32),
    pub inside: (u32, u32),
    pub context: Context,
}

/// A number in a call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Amount {
    Number(f64),
    /// Anything else: its bytes.
    Text(u32, u32),
}

/// An argument of an instruction or function.
#[derive(Clone, Copy, Debug)]
pub(super) struct Argument {
    /// Name after the backslash.
    pub option: Option<Symbol>,
    /// What stands there.
    pub expression: Expression,
    /// Where.
    pub span: (u32, u32),
}

/// A function that an expression calls.
#[derive(Clone, Copy, Debug)]
pub(super) struct Function {
    pub name: Symbol,
    pub offset: u32,
    /// Part of [`Parsed::given`].
    pub arguments: Part,
}

/// A statement that matters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Statement {
    /// First byte.
    pub offset: u32,
    pub kind: StatementKind,
}

/// The part of a datum that an assignment sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Component {
    /// All of it.
    Whole,
    /// So many leaves of a tool or frame from the first on (see [`super::aggregate`]).
    Leaves(u8, u8),
    /// Coordinates or joints of a target: `trans`, `robax` or one of theirs.
    Place,
    /// Any other.
    Other,
}

/// What an assignment sets it to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Assigned {
    /// Parts of a tool, frame or load that are written out: part of [`Parsed::leaves`].
    Leaves(Part),
    /// Anything else.
    To(Expression),
}

/// An instruction or a procedure call.
#[derive(Clone, Copy, Debug)]
pub(super) struct Called {
    pub callee: Callee,
    pub verb: Verb,
    pub arguments: Part,
    /// Behind its last byte.
    pub end: u32,
}

/// Which statement.
#[derive(Clone, Copy, Debug)]
pub(super) enum StatementKind {
    /// What follows stands in this file and context.
    Text {
        file: u32,
        context: Context,
    },
    /// `name.component := value`
    Assign {
        name: Symbol,
        index: Index,
        component: Component,
        value: Assigned,
    },
    /// An instruction or a procedure call.
    Call(Called),
    /// A function of the files, or one that may write its arguments: one of [`Parsed::functions`].
    Function(u32),
    /// What its condition asks of a parameter.
    If(Option<Asked>),
    /// `ELSEIF`, and what it asks.
    ElseIf(Option<Asked>),
    /// `CASE`, and of what.
    Case(Option<Asked>),
    /// `ELSE`, `DEFAULT`
    Else,
    /// What it asks about.
    Test(Option<Asked>),
    EndChoice,
    Loop {
        may_pass: bool,
        /// How many rounds it makes at most, where the text tells.
        most: Option<u32>,
    },
    EndLoop {
        endless: bool,
    },
    /// Behind the loop.
    Leave,
    Label(Symbol),
    Goto(Symbol),
    /// From here on the trap of this name may run at any time.
    Connect(Symbol),
    /// `ERROR`, `UNDO`, `BACKWARD`: what follows may run between any statements before it.
    Handler(Handles),
    /// `RETRY`; `TRYNEXT` where the statement is not made again.
    Retry {
        is_next: bool,
    },
    Return(Expression),
    /// `RAISE`
    Raise,
    Exit,
}

/// What a call names.
#[derive(Clone, Copy, Debug)]
pub(super) enum Callee {
    Named(Symbol),
    /// `%"Module:Routine"%`: the bytes of the name.
    Text(u32, u32),
    /// Known at run time only.
    Late,
}

/// What an instruction does, as far as it matters here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verb {
    /// Goes to its targets.
    Move {
        path: Path,
        led: Led,
        /// The tool stands after targets, speed and zone, before other arguments.
        tool_inside: bool,
    },
    /// Goes where only the running program knows; along the path that it came where `back`.
    Wander { back: bool },
    /// The arm gives way to forces from here on, or no longer.
    Yields { begins: bool },
    /// `ClearPath`
    ClearsPath,
    /// A mode of the controller is set.
    Mode(Mode, Set),
    /// Measures and writes the tool in its arguments.
    WritesTool,
    /// Writes the argument at this position.
    Writes(u8),
    /// `SetDataVal`, `SetAllDataVal`: writes data by their names or types.
    WritesNamed,
    /// `CallByVar`
    CallByVar,
    /// `GripLoad`
    GripLoad,
    /// An instruction of the language that moves nothing and changes no target.
    Harmless,
    /// A procedure, or an instruction that is not known.
    Other,
}

/// What the controller keeps in mind from one statement to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    ConfJ,
    ConfL,
    Wrist,
    /// How the tool rotates on arcs.
    Circle,
    ProgramDisplacement,
    ExternalOffset,
    /// Whether a unit of external axes follows targets.
    Unit,
}

/// How a mode is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Set {
    /// By the options of the instruction.
    ByOption,
    /// By the numbers of the instruction.
    Given,
    On,
    Off,
}

/// How a move goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Path {
    Joint,
    /// To a joint target.
    Absolute,
    Linear,
    Arc,
}
