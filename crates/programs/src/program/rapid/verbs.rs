//! What instructions do, by their names.

use super::builtins::{self, Known};
use super::syntax::{Mode, Path, Routine, Set, Type, Verb};
use crate::program::Source;
use crate::program::names::Symbol;
use foldhash::{HashMap, HashSet};

/// First parts of the names of instructions that move; J, L, C or `AbsJ` follows. What another one
/// begins with stands behind that.
const MOVING: [(&[u8], Led); 21] = [
    (b"move", Led::Alone),
    (b"arc", Led::Alone),
    (b"trigg", Led::Alone),
    (b"search", Led::Search),
    (b"egmmove", Led::Guided),
    (b"cap", Led::Alone),
    (b"disp", Led::Alone),
    (b"spotm", Led::Alone),
    (b"spot", Led::Alone),
    (b"paint", Led::Alone),
    (b"cut", Led::Alone),
    (b"laser", Led::Alone),
    (b"clad", Led::Alone),
    (b"weld", Led::Alone),
    (b"glue", Led::Alone),
    (b"seal", Led::Alone),
    (b"process", Led::Alone),
    (b"contact", Led::Contact),
    (b"fcpress1", Led::Pressed),
    (b"fcpress", Led::Pressed),
    (b"nut", Led::Alone),
];

/// Functions that give a position near another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Displaces {
    /// `Offs`
    InFrame,
    /// `RelTool`
    InTool,
}

impl Displaces {
    /// The one of this name.
    pub(super) fn named(spelling: &[u8]) -> Option<Self> {
        let is = |name: &[u8]| spelling.eq_ignore_ascii_case(name);
        match () {
            () if is(b"offs") => Some(Self::InFrame),
            () if is(b"reltool") => Some(Self::InTool),
            () => None,
        }
    }
}

/// What says where a move goes, with its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Led {
    /// Nothing else.
    Alone,
    /// A signal: it may stop there.
    Search,
    /// Contact ends it.
    Contact,
    /// A device that corrects its path (EGM).
    Guided,
    /// The force with which the tool presses.
    Pressed,
}

impl Led {
    /// The first argument that can be a target.
    pub(super) fn first(self) -> u8 {
        match self {
            Self::Search => 2,
            Self::Guided => 1,
            Self::Alone | Self::Contact | Self::Pressed => 0,
        }
    }
}

/// Last parts of names of instructions that move.
const ENDINGS: [&[u8]; 8] = [b"", b"do", b"ao", b"go", b"sync", b"ios", b"start", b"end"];

/// Endings of instructions with arguments after the tool.
const TOOL_INSIDE: [&[u8]; 4] = [b"do", b"ao", b"go", b"sync"];

/// What the names that were met do.
#[derive(Debug, Default)]
pub(super) struct Verbs {
    instructions: Vec<Option<Verb>>,
    functions: Vec<Option<Known>>,
    /// Offs and `RelTool`, where they were met.
    displacing: HashSet<Symbol>,
    /// What routines of the files hide of these: names, and the module of a local one.
    hidden: HashSet<(Symbol, Option<u32>)>,
    /// What types the files call by other names (ALIAS).
    aliases: HashMap<Symbol, Type>,
}

impl Verbs {
    /// What an instruction of this name does in a module.
    pub(super) fn of(&mut self, name: Symbol, spelling: &[u8], module: u32) -> Verb {
        let known = *slot(&mut self.instructions, name).get_or_insert_with(|| verb(spelling));
        if known == Verb::Harmless && self.is_hidden(name, module) {
            return Verb::Other;
        }
        known
    }

    /// Whether an instruction or procedure of this name was met.
    pub(super) fn has_met(&self, name: Symbol) -> bool {
        self.instructions
            .get(name.0 as usize)
            .is_some_and(Option::is_some)
    }

    /// Whether a function was met.
    pub(super) fn has_functions(&self) -> bool {
        !self.functions.is_empty() || !self.displacing.is_empty()
    }

    /// Whether no routine hides an instruction or a function.
    pub(super) fn hides_nothing(&self) -> bool {
        self.hidden.is_empty()
    }

    /// What a function of this name does in a module.
    pub(super) fn function(&mut self, name: Symbol, spelling: &[u8], module: u32) -> Known {
        slot(&mut self.functions, name).get_or_insert_with(|| {
            builtins::function(&Source::text(spelling).to_ascii_lowercase())
        });
        self.known(name, module)
    }

    /// Whether the function of this name, one of [`Displaces`], is that of the language in a module.
    pub(super) fn displaces(&mut self, name: Symbol, module: u32) -> bool {
        self.displacing.insert(name);
        !self.is_hidden(name, module)
    }

    /// Within its scope a routine hides the instruction or function of its name: calls of what
    /// these routines hide mean something, too. Whether any was passed over, or declared before it
    /// was known what its type is.
    pub(super) fn hide(&mut self, routines: &[Routine]) -> bool {
        for routine in routines {
            let at = routine.name.0 as usize;
            let instruction = self.instructions.get(at).copied().flatten();
            let function = self.functions.get(at).copied().flatten();
            if instruction == Some(Verb::Harmless)
                || function.is_some_and(|known| known != Known::Other)
                || self.displacing.contains(&routine.name)
            {
                let module = routine.local.then_some(routine.module);
                self.hidden.insert((routine.name, module));
            }
        }
        !self.hidden.is_empty() || !self.aliases.is_empty()
    }

    /// A type has another name; of two types by one name neither is meant.
    pub(super) fn alias(&mut self, name: Symbol, of: Type) {
        let known = self.aliases.entry(name).or_insert(of);
        if *known != of {
            *known = Type::Other;
        }
    }

    /// The type of this name.
    pub(super) fn aliased(&self, name: Symbol) -> Type {
        self.aliases.get(&name).copied().unwrap_or(Type::Other)
    }

    /// What a function of this name does in a module, where it was met before.
    pub(super) fn known(&self, name: Symbol, module: u32) -> Known {
        let known = self.functions.get(name.0 as usize).copied().flatten();
        known
            .filter(|_| !self.is_hidden(name, module))
            .unwrap_or(Known::Other)
    }

    fn is_hidden(&self, name: Symbol, module: u32) -> bool {
        let hidden = |module| self.hidden.contains(&(name, module));
        hidden(None) || hidden(Some(module))
    }
}

fn slot<T: Copy>(list: &mut Vec<Option<T>>, name: Symbol) -> &mut Option<T> {
    let at = name.0 as usize;
    if list.len() <= at {
        list.resize(at + 1, None);
    }
    &mut list[at]
}

pub(super) fn verb(spelling: &[u8]) -> Verb {
    let lower = spelling.to_ascii_lowercase();
    match lower.as_slice() {
        b"confl" => Verb::Mode(Mode::ConfL, Set::ByOption),
        b"confj" => Verb::Mode(Mode::ConfJ, Set::ByOption),
        b"cirpathmode" => Verb::Mode(Mode::Circle, Set::ByOption),
        b"singarea" => Verb::Mode(Mode::Wrist, Set::ByOption),
        b"pdispon" | b"pdispset" | b"pdispadd" => Verb::Mode(Mode::ProgramDisplacement, Set::On),
        b"pdispoff" => Verb::Mode(Mode::ProgramDisplacement, Set::Off),
        b"eoffson" => Verb::Mode(Mode::ExternalOffset, Set::On),
        b"eoffsset" => Verb::Mode(Mode::ExternalOffset, Set::Given),
        b"actunit" => Verb::Mode(Mode::Unit, Set::On),
        b"deactunit" => Verb::Mode(Mode::Unit, Set::Off),
        b"eoffsoff" => Verb::Mode(Mode::ExternalOffset, Set::Off),
        b"pathrecmovebwd" | b"pathrecmovefwd" | b"stepbwdpath" => Verb::Wander { back: true },
        b"egmrunjoint" | b"egmrunpose" => Verb::Wander { back: false },
        b"fcact" | b"fcrefstart" => Verb::Yields { begins: true },
        b"fcrefstop" | b"fcdeact" | b"setleadthrough" => Verb::Yields { begins: false },
        b"clearpath" => Verb::ClearsPath,
        b"fcpressend" => Verb::Move {
            path: Path::Linear,
            led: Led::Pressed,
            tool_inside: false,
        },
        b"gripload" => Verb::GripLoad,
        b"setdataval" | b"setalldataval" => Verb::WritesNamed,
        b"callbyvar" => Verb::CallByVar,
        b"moveextj" => Verb::Harmless,
        _ => moving(spelling, &lower)
            .or_else(|| builtins::instruction(std::str::from_utf8(&lower).ok()?))
            .unwrap_or(Verb::Other),
    }
}

/// Whether a name is that of an instruction that moves.
pub(super) fn is_move(spelling: &[u8]) -> bool {
    moving(spelling, &spelling.to_ascii_lowercase()).is_some()
}

/// Whether an instruction that moves calls a procedure on its way (`MoveLSync`).
pub(super) fn calls(spelling: &[u8]) -> bool {
    spelling.to_ascii_lowercase().ends_with(b"sync")
}

fn moving(spelling: &[u8], lower: &[u8]) -> Option<Verb> {
    let (first, led) = MOVING.iter().find(|(first, _)| lower.starts_with(first))?;
    let rest = &lower[first.len()..];
    let (path, letters) = match rest {
        [b'a', b'b', b's', b'j', ..] => (Path::Absolute, 4),
        [b'j', ..] => (Path::Joint, 1),
        [b'l', ..] => (Path::Linear, 1),
        [b'c', ..] => (Path::Arc, 1),
        _ => return None,
    };
    let ending = &rest[letters..];
    // MoveLClad is a kind of MoveL, MoveLift is not
    let own_word = || {
        let next = spelling[first.len() + letters];
        next.is_ascii_digit() || next == b'_' || {
            next.is_ascii_uppercase() && spelling.iter().any(u8::is_ascii_lowercase)
        }
    };
    if !ENDINGS.contains(&ending) && !own_word() {
        return None;
    }
    Some(Verb::Move {
        path,
        led: *led,
        tool_inside: TOOL_INSIDE.contains(&ending),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(name: &str) -> Option<Path> {
        match verb(name.as_bytes()) {
            Verb::Move { path, .. } => Some(path),
            _ => None,
        }
    }

    #[test]
    fn moves_are_known_by_their_names() {
        for (name, expected) in [
            ("MoveL", Some(Path::Linear)),
            ("MOVEJ", Some(Path::Joint)),
            ("moveabsj", Some(Path::Absolute)),
            ("ArcLStart", Some(Path::Linear)),
            ("ArcC", Some(Path::Arc)),
            ("TriggJIOs", Some(Path::Joint)),
            ("SearchC", Some(Path::Arc)),
            ("EGMMoveL", Some(Path::Linear)),
            ("MoveLDO", Some(Path::Linear)),
            ("MoveLClad", Some(Path::Linear)),
            ("SpotML", Some(Path::Linear)),
            ("FCPress1LStart", Some(Path::Linear)),
            ("FCPressC", Some(Path::Arc)),
            ("FCPressEnd", Some(Path::Linear)),
            ("ContactL", Some(Path::Linear)),
            ("NutJ", Some(Path::Joint)),
            ("MoveLift", None),
            ("MoveCalibrate", None),
            ("MoveExtJ", None),
            ("TriggIO", None),
            ("Arcweld", None),
        ] {
            assert_eq!(path(name), expected, "{name}");
        }
    }

    #[test]
    fn common_instructions_are_harmless_and_procedures_are_not() {
        assert_eq!(verb(b"SetDO"), Verb::Harmless);
        assert_eq!(verb(b"WaitTime"), Verb::Harmless);
        assert_eq!(verb(b"PickPart"), Verb::Other);
        assert_eq!(
            verb(b"PDispSet"),
            Verb::Mode(Mode::ProgramDisplacement, Set::On)
        );
    }
}
