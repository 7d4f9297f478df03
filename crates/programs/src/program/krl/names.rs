//! Names and what is declared of them.

use super::structures::{Import, Structure};
use super::tokens::Cursor;
use crate::program::names::{Context, Meaning, Scopes, Symbol, Symbols};
use crate::program::script::{Place, VariableId, short};
use crate::program::{TargetId, number};
use foldhash::HashSet;
use std::collections::BTreeSet;

/// Which element of an array is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Index {
    /// The variable itself.
    Whole,
    /// This element.
    At([u32; 3]),
    /// One that only the running program knows.
    Variable,
}

impl Index {
    /// The element between brackets.
    pub(super) fn of(at: Option<(usize, usize)>, cursor: &Cursor) -> Self {
        let Some((start, end)) = at else {
            return Self::Whole;
        };
        let mut place = [0; 3];
        let mut parts = cursor.bytes[start..end].split(|&b| b == b',');
        for slot in &mut place {
            let Some(part) = parts.next() else { break };
            match whole(number::parse(part.trim_ascii())) {
                Some(value) => *slot = value,
                None => return Self::Variable,
            }
        }
        if parts.next().is_some() {
            return Self::Variable;
        }
        Self::At(place)
    }

    /// The element of an array in an element of another.
    pub(super) fn inside(self, inner: Self) -> Self {
        match (self, inner) {
            (at, Self::Whole) | (Self::Whole, at) => at,
            (Self::At([a, 0, 0]), Self::At([b, c, 0])) => Self::At([a, b, c]),
            (Self::At([a, b, 0]), Self::At([c, 0, 0])) => Self::At([a, b, c]),
            _ => Self::Variable,
        }
    }

    /// The entry of a table with one index, where the text says which.
    pub(super) fn first(self) -> Option<u32> {
        match self {
            Self::At([entry, 0, 0]) => Some(entry),
            _ => None,
        }
    }
}

/// A whole number of a table.
pub(super) fn whole(value: Option<f64>) -> Option<u32> {
    let value = value.filter(|v| v.fract() == 0.0 && (0.0..1e9).contains(v))?;
    // 0 to 1e9 is checked
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    Some(value as u32)
}

/// What a variable holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DataKind {
    /// FRAME: a target where a move goes to it, else an offset or a work frame.
    Frame,
    /// POS: with S and T, without external axes.
    Pos,
    /// E3POS, E6POS.
    Position,
    /// AXIS, E3AXIS, E6AXIS.
    Axes,
    /// FDAT: numbers of a tool and a base.
    Fdat,
    /// LDAT: how the tool rotates on straight moves and arcs.
    Ldat,
    /// INT.
    Number,
    /// A structure: which of [`Names::structures`].
    Structure(usize),
    /// Anything else.
    Other,
}

impl DataKind {
    /// The kind of a type in capitals.
    pub(super) fn named(word: &[u8]) -> Self {
        match word {
            b"FRAME" => Self::Frame,
            b"POS" => Self::Pos,
            b"E3POS" | b"E6POS" => Self::Position,
            b"AXIS" | b"E3AXIS" | b"E6AXIS" => Self::Axes,
            b"FDAT" => Self::Fdat,
            b"LDAT" => Self::Ldat,
            b"INT" => Self::Number,
            _ => Self::Other,
        }
    }

    /// Whether it is somewhere to go to.
    pub(super) fn is_place(self) -> bool {
        self.is_pose() || self == Self::Axes
    }

    /// Whether it is a pose.
    pub(super) fn is_pose(self) -> bool {
        self == Self::Frame || self.is_position()
    }

    /// Whether it is a pose without external axes: a move leaves these where they stand.
    pub(super) fn lacks_axes(self) -> bool {
        matches!(self, Self::Frame | Self::Pos)
    }

    /// Whether it is a pose that no move has as an offset.
    pub(super) fn is_position(self) -> bool {
        matches!(self, Self::Pos | Self::Position)
    }
}

/// A declared variable.
#[derive(Clone, Copy, Debug)]
pub(super) struct Datum {
    pub name: Symbol,
    pub context: Context,
    pub kind: DataKind,
    pub place: Place,
    /// It stands in a data list, which the controller keeps.
    pub kept: bool,
    /// It is declared CONST.
    pub constant: bool,
}

/// How the tool rotates on straight moves and arcs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turning {
    /// Evenly from orientation to orientation.
    Evenly,
    /// As the axes of the wrist do, each at a constant rate.
    AsWrist,
    /// Not at all.
    Kept,
    /// Evenly past the point, whose own orientation does not count.
    Ignored,
}

impl Turning {
    /// Of `#VAR`, `#JOINT`, `#CONSTANT`, `#IGNORE`: by this name in capitals. What is not known may
    /// keep it.
    pub(super) fn named(name: &[u8]) -> Self {
        match name {
            b"VAR" => Self::Evenly,
            b"JOINT" => Self::AsWrist,
            b"IGNORE" => Self::Ignored,
            _ => Self::Kept,
        }
    }
}

/// What LDAT tells of how the tool turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Ldat {
    pub turning: Turning,
    /// Whether its arcs are usual ones, by [`super::turning::Arc`].
    pub arcs: [bool; 3],
}

impl Default for Ldat {
    fn default() -> Self {
        Self {
            turning: Turning::Evenly,
            arcs: [true; 3],
        }
    }
}

impl Ldat {
    /// Only the running program knows it.
    pub(super) const UNKNOWN: Self = Self {
        turning: Turning::Kept,
        arcs: [false; 3],
    };
}

/// The value of a variable.
#[derive(Clone, Copy, Debug)]
pub(super) enum Stored {
    /// A position or axes.
    Target(TargetId),
    /// Numbers of a tool and a base.
    Fdat(Fdat),
    /// How the tool rotates on straight moves and arcs.
    Ldat(Ldat),
    /// A whole number.
    Number(u32),
    /// Not written out.
    Computed,
}

/// What FDAT tells; `None` is: it does not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub(super) struct Fdat {
    pub tool: Option<u32>,
    pub base: Option<u32>,
    /// The robot holds the work piece and the tool stands still.
    pub is_external: Option<bool>,
}

/// A routine, besides what the script has of it.
#[derive(Clone, Debug)]
pub(super) struct Head {
    pub module: u32,
    /// Its parameters, and whether it may write what they are given.
    pub parameters: Vec<(u32, bool)>,
    /// What a function returns.
    pub returns: DataKind,
    /// The variable that holds it.
    pub result: Option<VariableId>,
}

/// A module: the files of one name.
#[derive(Clone, Debug)]
pub(super) struct Module {
    pub key: String,
    pub has_routine: bool,
    /// The data list is one of the controller: only what moves use is a target.
    pub is_system: bool,
}

/// What is declared in all files.
#[derive(Debug, Default)]
pub(super) struct Names {
    pub symbols: Symbols,
    pub modules: Vec<Module>,
    pub heads: Vec<Head>,
    pub data: Vec<Datum>,
    scopes: Scopes,
    routines: Scopes,
    /// Values by declaration and element, in that order once all are read.
    pub values: Vec<(u32, Index, Stored)>,
    /// The last declaration of each symbol.
    last: Vec<u32>,
    /// Names that statements write or hand to routines.
    pub touched: HashSet<Symbol>,
    /// Names that are written as a whole, or given to routines.
    pub handed: HashSet<Symbol>,
    /// Those that are given to routines.
    pub given_away: HashSet<Symbol>,
    /// Types of the files.
    pub structures: Vec<(Symbol, Structure)>,
    pub imports: Vec<Import>,
    /// Whether a routine ends what runs by RESUME.
    pub resumes: bool,
    /// Routines that declare interrupts: RESUME goes on in them, behind their call.
    pub interrupted: HashSet<u32>,
    /// Likewise with the element of an array.
    pub elements: BTreeSet<(Symbol, Index)>,
    /// What is written into numbers.
    pub known: super::numbers::Known,
    /// Which functions change nothing that moves depend on.
    pub quiet: super::quiet::Quiet,
    /// Names that choose tools, bases and loads.
    pub choosing: HashSet<Symbol>,
    /// Parameters that branches ask about.
    pub asked: super::asked::Asked,
    /// Names that are given to routines: the name, the routine, which argument, and where.
    pub given: Vec<(Symbol, Symbol, usize, Context)>,
}

impl Names {
    /// The module of a file.
    pub(super) fn module(&mut self, file: &str) -> u32 {
        let key = module_key(file);
        let known = self.modules.iter().rposition(|module| module.key == key);
        short(known.unwrap_or_else(|| {
            self.modules.push(Module {
                is_system: is_system(&key),
                key,
                has_routine: false,
            });
            self.modules.len() - 1
        }))
    }

    /// Adds a variable; one of a routine may be a parameter whose type is not known yet.
    pub(super) fn declare(&mut self, datum: Datum, global: bool) -> u32 {
        let at = datum.name.0 as usize;
        if self.last.len() <= at {
            self.last.resize(at + 1, u32::MAX);
        }
        if datum.context.routine.is_some()
            && let Some(known) = self.data.get_mut(self.last[at] as usize)
            && known.context == datum.context
        {
            known.kind = datum.kind;
            return self.last[at];
        }
        let id = short(self.data.len());
        self.scopes.add(datum.name, datum.context, !global, id);
        self.data.push(datum);
        self.last[at] = id;
        id
    }

    /// A variable is known by another name, too.
    pub(super) fn alias(&mut self, name: Symbol, context: Context, datum: u32) {
        self.scopes.add(name, context, true, datum);
    }

    /// The last variable of a name, where that is one of a module.
    pub(super) fn last_of(&self, name: Symbol, module: u32) -> Option<u32> {
        let last = *self.last.get(name.0 as usize)?;
        let datum = self.data.get(last as usize)?;
        (datum.context.module == module).then_some(last)
    }

    /// Adds a routine, the next of the script; the first of a file is seen everywhere.
    pub(super) fn add_routine(&mut self, name: Symbol, head: Head, global: bool) {
        let module = head.module;
        let known = &mut self.modules[module as usize].has_routine;
        let first = !std::mem::replace(known, true);
        let context = Context {
            module,
            routine: None,
        };
        let id = short(self.heads.len());
        self.routines.add(name, context, !(first || global), id);
        self.heads.push(head);
    }

    /// Puts values in order and carries what chooses through calls, once all are read.
    pub(super) fn settle(&mut self) {
        self.settle_structures();
        self.values.sort_by_key(|&(datum, index, _)| (datum, index));
        self.settle_asked();
        self.carry_choosing();
        self.settle_quiet();
        self.give_numbers();
    }

    /// What chooses a tool, base or load does so under the name of the parameter that it is given
    /// to, too, and the other direction: what is given to a parameter that chooses.
    fn carry_choosing(&mut self) {
        let parameter = |&(name, routine, at, context): &(Symbol, Symbol, usize, Context)| {
            let head = &self.heads[self.routine(routine, context)? as usize];
            let &(datum, _) = head.parameters.get(at)?;
            let parameter = &self.data[datum as usize];
            let is_other = parameter.kind == DataKind::Number && parameter.name != name;
            is_other.then_some((name, parameter.name))
        };
        let pairs: HashSet<_> = self.given.iter().filter_map(parameter).collect();
        self.given = Vec::new();
        let mut before = usize::MAX;
        while before != self.choosing.len() {
            before = self.choosing.len();
            for &(name, parameter) in &pairs {
                if self.choosing.contains(&name) || self.choosing.contains(&parameter) {
                    self.choosing.extend([name, parameter]);
                }
            }
        }
    }

    /// The routine of a name.
    pub(super) fn routine(&self, name: Symbol, context: Context) -> Option<u32> {
        match self.routines.meaning(name, context) {
            Meaning::One(routine) => Some(routine),
            _ => None,
        }
    }

    /// What a name means.
    pub(super) fn meaning(&self, name: Symbol, context: Context) -> Meaning {
        self.scopes.meaning(name, context)
    }

    /// The declarations that an ambiguous name may mean.
    pub(super) fn several(&self, list: u32) -> &[u32] {
        self.scopes.several(list)
    }

    /// The one declaration of a name.
    pub(super) fn datum(&self, name: Symbol, context: Context) -> Option<u32> {
        match self.meaning(name, context) {
            Meaning::One(datum) => Some(datum),
            _ => None,
        }
    }

    pub(super) fn kind(&self, name: Symbol, context: Context) -> Option<DataKind> {
        let datum = self.datum(name, context)?;
        Some(self.data[datum as usize].kind)
    }

    /// The values of a declaration, or of one element of it.
    pub(super) fn values(&self, datum: u32, at: Index) -> &[(u32, Index, Stored)] {
        let first = self.values.partition_point(|&(d, ..)| d < datum);
        let rest = &self.values[first..];
        if at == Index::Variable {
            let count = rest.iter().take_while(|&&(d, ..)| d == datum).count();
            return &rest[..count];
        }
        let before = |&(d, i, _): &(u32, Index, Stored)| (d, i) < (datum, at);
        let skip = match rest.first() {
            Some(first) if before(first) => rest.partition_point(before),
            _ => 0,
        };
        let is = |&&(d, i, _): &&(u32, Index, Stored)| (d, i) == (datum, at);
        let count = rest[skip..].iter().take_while(is).count();
        &rest[skip..skip + count]
    }

    /// The only value of an element, where nothing writes it.
    pub(super) fn constant(&self, name: Symbol, at: Index, context: Context) -> Option<Stored> {
        let datum = self.datum(name, context)?;
        match self.values(datum, at) {
            [(_, _, value)] if !self.touched.contains(&name) => Some(*value),
            _ => None,
        }
    }
}

/// What the files of one module have in common: folder and name without ending, in lower case.
fn module_key(name: &str) -> String {
    let lower = name.to_ascii_lowercase();
    let name_start = lower.rfind(['/', '\\']).map_or(0, |at| at + 1);
    match lower[name_start..].rfind('.') {
        Some(dot) if dot > 0 => lower[..name_start + dot].to_owned(),
        _ => lower,
    }
}

/// Whether a data list is one of the controller's own.
fn is_system(key: &str) -> bool {
    let mut parts = key.rsplit(['/', '\\']);
    parts.next().is_some_and(|name| name.starts_with('$'))
        || parts.any(|folder| matches!(folder, "mada" | "steu"))
}
