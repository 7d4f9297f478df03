//! What is noted of one file before names mean anything.

use crate::geometry::units::DEG;
use crate::program::script::short;
use crate::program::{Motion, Number, SpeedZone};
use foldhash::HashMap;
use std::borrow::Cow;
use std::ops::Range;

/// A name of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Symbol(pub u32);

/// Index in [`Parsed::expressions`].
pub(super) type ExprId = u32;
/// Index in [`Parsed::literals`].
pub(super) type LiteralId = u32;
/// Index in [`Parsed::functions`]; 0 is the text outside functions. Of several files that is empty,
/// and each has one of its own.
pub(super) type FunctionId = u32;

/// The value of everything that is not looked into.
pub(super) const OTHER: ExprId = 0;

/// A value as far as it matters here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Expr {
    /// `p[…]` or `[…]`.
    Literal(LiteralId),
    /// `[…]` with poses, lists or names in it: index in [`Parsed::lists`].
    List(u32),
    /// A variable, and its first byte.
    Name(Symbol, u32),
    /// An element of a list or structure.
    Element(Symbol, At),
    /// `pose_trans(a, b)`
    Trans(ExprId, ExprId),
    /// `pose_add(a, b)`
    Add(ExprId, ExprId),
    /// `pose_inv(a)`
    Inverse(ExprId),
    /// `get_inverse_kin(pose, qnear, …, tcp)`
    Kinematics {
        pose: ExprId,
        near: Option<ExprId>,
        tcp: Option<ExprId>,
    },
    /// What a function of the file returns: index in [`Parsed::calls`].
    Call(u32),
    /// Where the robot is.
    Actual { is_pose: bool },
    /// A number that is a load's mass, or all that a variable is assigned.
    Number(f64),
    /// Something computed in an argument: the names in it, a part of [`Parsed::composed`].
    Made(u32, u32),
    /// Anything else.
    Other,
}

/// Which element of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum At {
    /// One that only the running program knows.
    Any,
    /// By its number.
    Number(u32),
    /// By its name: `x.name`.
    Member(Symbol),
}

impl At {
    pub(super) fn number(self) -> Option<u32> {
        match self {
            Self::Number(number) => Some(number),
            Self::Any | Self::Member(_) => None,
        }
    }

    /// Whether both may name the same.
    pub(super) fn may_be(self, other: Self) -> bool {
        self == other || self == Self::Any || other == Self::Any
    }
}

/// What stands between the brackets of a literal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// Six numbers.
    Numbers,
    /// Six numbers, some angles of them inside `d2r(…)`: bit by bit, the first number the lowest.
    Degrees(u8),
    /// Anything else.
    Expressions,
}

impl Content {
    /// Which numbers are in degrees, bit by bit.
    pub fn degrees(self) -> u8 {
        match self {
            Self::Degrees(bits) => bits,
            Self::Numbers | Self::Expressions => 0,
        }
    }
}

/// The unit of a number of six, of which these are in degrees.
pub(super) fn unit(degrees: u8, at: usize) -> f64 {
    if degrees >> at & 1 == 1 { DEG } else { 1.0 }
}

/// `p[…]` or `[…]`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Literal {
    /// Its first byte.
    pub offset: u32,
    /// Behind its last byte.
    pub end: u32,
    /// It has a `p`.
    pub pose: bool,
    pub content: Content,
    /// In [`Parsed::numbers`].
    pub numbers: Range<u32>,
    /// Elements between its commas.
    pub elements: u32,
    /// Only the running program knows its elements.
    pub computed: bool,
    /// Where it is: the names in it, in [`Parsed::composed`].
    pub names: Range<u32>,
}

/// A list and what stands between its commas.
#[derive(Debug)]
pub(super) struct List {
    pub literal: LiteralId,
    pub elements: Vec<ExprId>,
}

/// Where an assignment puts a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reach {
    /// `global x = …`
    Global,
    /// `local x = …`
    Local,
    /// `x = …`
    Plain,
}

/// `x = …`, or an element of x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Assignment {
    pub name: Symbol,
    pub function: FunctionId,
    pub reach: Reach,
    pub value: ExprId,
    pub offset: u32,
    /// Only a part of the variable is assigned.
    pub part: bool,
    /// That is a part of an element: `x[i][j] = …`
    pub deep: bool,
    /// Which, where it is an element.
    pub element: At,
    /// Nothing but a number is.
    pub is_number: bool,
    /// It stands in a branch or loop.
    pub in_block: bool,
}

/// A move as the text has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// First byte of the instruction.
    pub offset: u32,
    /// Behind its last byte.
    pub end: u32,
    pub motion: Motion,
    /// `None` where the robot moves by speed, force or hand.
    pub target: Option<ExprId>,
    /// The controller follows it as a stream of set points.
    pub streamed: bool,
    /// An arc on which the tool keeps its orientation to the path.
    pub rotates_with_arc: bool,
    pub speed_zone: SpeedZone,
    /// The call can be written again with another target.
    pub repeatable: bool,
}

/// What a call says of the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Payload {
    /// `None` where it stays as it is.
    pub mass: Option<ExprId>,
    pub cog: Cog,
}

/// The centre of gravity of a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cog {
    /// As it is.
    Stays,
    /// The tool's origin, of tools that are set later too.
    Tool,
    /// Three numbers.
    At(ExprId),
}

/// A call of a function that is none of the language.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Called {
    pub name: Symbol,
    pub function: FunctionId,
    pub offset: u32,
    /// In [`Parsed::arguments`].
    pub arguments: Range<u32>,
}

/// A statement, in the order of the text of one function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Event {
    /// Index in [`Parsed::assignments`].
    Assign(u32),
    /// `set_tcp(…)`, at a byte.
    Tool(ExprId, u32),
    /// `set_payload(…)`, at a byte.
    Load(Payload, u32),
    /// Moves go along a frame that moves from here on, or no longer.
    Tracking(bool, u32),
    /// Index in [`Parsed::calls`].
    Call(u32),
    /// What the condition of the next `if`, `elif`, `switch` or `case` asks of a parameter, between these bytes.
    Question(u32, u32),
    If,
    /// `if` with a condition that is never true: nothing runs before its first branch.
    Never,
    /// `switch`: nothing runs before its first branch.
    Switch,
    /// `elif`, `case`; the last one is `else` or `default`, and `elif` before its condition.
    Branch {
        is_last: bool,
    },
    /// The condition of `elif`, which is not always true.
    ElseIf,
    EndIf,
    /// `while`, before its condition.
    Loop,
    /// The condition, which is not always true, between these bytes.
    Condition(u32, u32),
    EndLoop {
        endless: bool,
    },
    Break,
    Continue,
    Return(ExprId, u32),
    Halt,
    /// Index in [`Parsed::steps`].
    Step(u32),
}

impl Event {
    /// Whether it is what a call does, wherever in an expression that stands.
    pub(super) fn is_of_call(&self) -> bool {
        matches!(
            self,
            Self::Tool(..) | Self::Load(..) | Self::Tracking(..) | Self::Call(_) | Self::Step(_)
        )
    }

    /// Whether the program comes to what follows from elsewhere too.
    pub(super) fn is_crossing(&self) -> bool {
        matches!(
            self,
            Self::Never
                | Self::Switch
                | Self::Branch { .. }
                | Self::EndIf
                | Self::Loop
                | Self::EndLoop { .. }
        )
    }
}

/// A function, a thread, or the text outside them.
#[derive(Clone, Debug, Default)]
pub(super) struct Function {
    pub name: Option<Symbol>,
    pub offset: u32,
    pub parent: FunctionId,
    /// The text outside functions of its file.
    pub unit: FunctionId,
    pub thread: bool,
    /// With the value where a call gives none.
    pub parameters: Vec<(Symbol, Option<ExprId>)>,
    pub events: Vec<Event>,
}

/// All of one file.
#[derive(Debug, Default)]
pub(super) struct Parsed<'a> {
    pub expressions: Vec<Expr>,
    pub literals: Vec<Literal>,
    pub lists: Vec<List>,
    pub numbers: Vec<Number>,
    pub functions: Vec<Function>,
    pub assignments: Vec<Assignment>,
    pub steps: Vec<Step>,
    pub calls: Vec<Called>,
    /// By position, or by name.
    pub arguments: Vec<(Option<Symbol>, ExprId)>,
    /// Where the robot gives way to forces.
    pub forces: Vec<u32>,
    /// What `set_gravity` is given, in which function, and where.
    pub gravities: Vec<(ExprId, FunctionId, u32)>,
    /// Names in expressions that are assigned to another variable, with the place of that.
    pub mentions: Vec<(Symbol, FunctionId, u32)>,
    /// Names in poses with expressions.
    pub composed: Vec<Symbol>,
    /// Of such a pose the names in each of its coordinates, but for those that ask where the robot
    /// is: parts of `composed`.
    pub coordinates: HashMap<LiteralId, Vec<Range<u32>>>,
    /// The file.
    pub text: &'a [u8],
    symbols: HashMap<&'a [u8], Symbol>,
    spellings: Vec<&'a [u8]>,
}

impl<'a> Parsed<'a> {
    pub(super) fn symbol(&mut self, name: &'a [u8]) -> Symbol {
        let next = Symbol(short(self.spellings.len()));
        let spellings = &mut self.spellings;
        *self.symbols.entry(name).or_insert_with(|| {
            spellings.push(name);
            next
        })
    }

    /// Whether a function is another one or stands in it.
    pub(super) fn is_in(&self, function: FunctionId, other: FunctionId) -> bool {
        let parent = |of: &FunctionId| (*of != 0).then(|| self.functions[*of as usize].parent);
        std::iter::successors(Some(function), parent).any(|of| of == other)
    }

    /// The symbol of a name that was read.
    pub(super) fn known_symbol(&self, name: &[u8]) -> Option<Symbol> {
        self.symbols.get(name).copied()
    }

    pub(super) fn spelling(&self, symbol: Symbol) -> Cow<'a, str> {
        crate::program::Source::text(self.spellings[symbol.0 as usize])
    }

    /// A name as it stands in the file.
    pub(super) fn bytes(&self, symbol: Symbol) -> &'a [u8] {
        self.spellings[symbol.0 as usize]
    }

    pub(super) fn expression(&self, id: ExprId) -> Expr {
        self.expressions[id as usize]
    }

    /// Whether a pose is written out anywhere.
    pub(super) fn has_poses(&self) -> bool {
        self.literals.iter().any(|of| of.pose)
    }

    pub(super) fn literal(&self, id: LiteralId) -> &Literal {
        &self.literals[id as usize]
    }

    pub(super) fn add(&mut self, expression: Expr) -> ExprId {
        self.expressions.push(expression);
        short(self.expressions.len() - 1)
    }

    /// The names in a pose with expressions.
    pub(super) fn names_in(&self, id: LiteralId) -> &[Symbol] {
        self.composed_in(self.literal(id).names.clone())
    }

    /// Names that a value is computed from.
    pub(super) fn composed_in(&self, names: Range<u32>) -> &[Symbol] {
        &self.composed[names.start as usize..names.end as usize]
    }

    /// The values of a literal with its numbers written out, in the file's units.
    pub(super) fn values(&self, literal: &Literal) -> Option<[f64; 6]> {
        let range = literal.numbers.start as usize..literal.numbers.end as usize;
        let numbers = self.numbers.get(range)?;
        (numbers.len() == 6).then(|| std::array::from_fn(|i| numbers[i].value))
    }

    pub(super) fn arguments_of(&self, call: &Called) -> &[(Option<Symbol>, ExprId)] {
        &self.arguments[call.arguments.start as usize..call.arguments.end as usize]
    }
}
