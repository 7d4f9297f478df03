//! What is noted of one file before names mean anything.

use crate::program::{Load, Motion, Number};
use std::collections::HashMap;
use std::ops::Range;

/// A name of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Symbol(pub u32);

/// Index in [`Notes::expressions`].
pub type ExprId = u32;
/// Index in [`Notes::literals`].
pub type LiteralId = u32;
/// Index in [`Notes::functions`]; 0 is the text outside functions.
pub type FunctionId = u32;

/// A value as far as it matters here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expr {
    /// `p[…]` or `[…]`.
    Literal(LiteralId),
    /// A variable.
    Name(Symbol),
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
    /// Anything else.
    Other,
}

/// What stands between the brackets of a literal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Six numbers.
    Numbers,
    /// Six numbers, the angles (of joints all six, of poses the last three) inside `d2r(…)`.
    Degrees,
    /// Anything else.
    Expressions,
}

/// `p[…]` or `[…]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Literal {
    /// Its first byte.
    pub offset: u32,
    /// It has a `p`.
    pub pose: bool,
    pub content: Content,
    /// In [`Notes::numbers`].
    pub numbers: Range<u32>,
    /// Elements between its commas.
    pub elements: u32,
}

/// Where an assignment puts a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// `global x = …`
    Global,
    /// `local x = …`
    Local,
    /// `x = …`
    Plain,
}

/// `x = …`, or an element of x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assignment {
    pub name: Symbol,
    pub function: FunctionId,
    pub reach: Reach,
    pub value: ExprId,
    pub offset: u32,
    /// Only a part of the variable is assigned.
    pub part: bool,
}

/// A move as the text has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// First byte of the instruction.
    pub offset: u32,
    pub function: FunctionId,
    pub motion: Motion,
    pub target: ExprId,
    /// The controller follows it as a stream of set points.
    pub streamed: bool,
}

/// What matters for the tool and its load, in the order of the text of one function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// `set_tcp(…)`, at a byte.
    Tool(ExprId, u32),
    /// `set_payload(…)`; `None` where it is not written out.
    Load(Option<Load>),
    /// A call of something that may be a function of the file.
    Call(Symbol),
    If,
    Else,
    /// `elif`, `case`: the branches may still all be passed by.
    ElseIf,
    EndIf,
    Loop,
    EndLoop,
    Break,
    Continue,
    Return,
    /// Index in [`Notes::steps`].
    Step(u32),
}

/// A function, a thread, or the text outside them.
#[derive(Clone, Debug, Default)]
pub struct Function {
    pub name: Option<Symbol>,
    pub parent: FunctionId,
    pub thread: bool,
    pub parameters: Vec<Symbol>,
    pub events: Vec<Event>,
}

/// Something that moves the robot, or everything, in another way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Oddity {
    /// By speed, force or hand: there is no target.
    NoTarget,
    /// Along a frame that moves, or beside the path.
    MovingFrame,
}

/// All of one file.
#[derive(Debug, Default)]
pub struct Notes<'a> {
    pub expressions: Vec<Expr>,
    pub literals: Vec<Literal>,
    pub numbers: Vec<Number>,
    pub functions: Vec<Function>,
    pub assignments: Vec<Assignment>,
    pub steps: Vec<Step>,
    pub oddities: Vec<(Oddity, u32)>,
    /// Names in expressions that are assigned to another variable, with the place of that.
    pub mentions: Vec<(Symbol, FunctionId, u32)>,
    symbols: HashMap<&'a [u8], Symbol>,
    spellings: Vec<&'a [u8]>,
}

impl<'a> Notes<'a> {
    pub fn symbol(&mut self, name: &'a [u8]) -> Symbol {
        let next = Symbol(index(self.spellings.len()));
        let spellings = &mut self.spellings;
        *self.symbols.entry(name).or_insert_with(|| {
            spellings.push(name);
            next
        })
    }

    pub fn spelling(&self, symbol: Symbol) -> String {
        crate::program::Source::text(self.spellings[symbol.0 as usize])
    }

    pub fn expression(&self, id: ExprId) -> Expr {
        self.expressions[id as usize]
    }

    pub fn literal(&self, id: LiteralId) -> &Literal {
        &self.literals[id as usize]
    }

    pub fn add(&mut self, expression: Expr) -> ExprId {
        self.expressions.push(expression);
        index(self.expressions.len() - 1)
    }

    /// The values of a literal with its numbers written out, in the file's units.
    pub fn values(&self, literal: &Literal) -> Option<[f64; 6]> {
        let range = literal.numbers.start as usize..literal.numbers.end as usize;
        let numbers = self.numbers.get(range)?;
        (numbers.len() == 6).then(|| std::array::from_fn(|i| numbers[i].value))
    }
}

/// A place or count: files are below 4 GiB.
#[allow(clippy::cast_possible_truncation)]
pub fn index(number: usize) -> u32 {
    number as u32
}
