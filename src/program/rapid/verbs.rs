//! What instructions do, by their names.

use super::names::Symbol;
use super::syntax::{Path, Verb};

/// First parts of the names of instructions that move; J, L, C or `AbsJ` follows.
const MOVING: [&[u8]; 16] = [
    b"move", b"arc", b"trigg", b"search", b"egmmove", b"cap", b"disp", b"spot", b"paint", b"cut",
    b"laser", b"clad", b"weld", b"glue", b"seal", b"process",
];

/// Last parts of names of instructions that move.
const ENDINGS: [&[u8]; 8] = [b"", b"do", b"ao", b"go", b"sync", b"ios", b"start", b"end"];

/// Endings of instructions with arguments after the tool.
const TOOL_INSIDE: [&[u8]; 4] = [b"do", b"ao", b"go", b"sync"];

/// Instructions of the language that move nothing and write no target, tool or frame; sorted.
const HARMLESS: [&[u8]; 173] = [
    b"accset",
    b"actevent",
    b"actunit",
    b"add",
    b"aliasio",
    b"bitclear",
    b"bitset",
    b"bookerrno",
    b"break",
    b"callbyvar",
    b"circpathmode",
    b"cirpathmode",
    b"clear",
    b"clearpath",
    b"clkreset",
    b"clkstart",
    b"clkstop",
    b"close",
    b"closedir",
    b"collisiondetect",
    b"copyfile",
    b"corrclear",
    b"corrcon",
    b"corrdiscon",
    b"corrwrite",
    b"deactunit",
    b"decr",
    b"eoffsgoto",
    b"erase",
    b"errlog",
    b"errraise",
    b"errwrite",
    b"exit",
    b"exitcycle",
    b"idelete",
    b"idisable",
    b"ienable",
    b"ierror",
    b"incr",
    b"invertdo",
    b"iodisable",
    b"ioenable",
    b"ipers",
    b"isignalai",
    b"isignalao",
    b"isignaldi",
    b"isignaldo",
    b"isignalgi",
    b"isignalgo",
    b"isleep",
    b"itimer",
    b"ivarvalue",
    b"iwatch",
    b"load",
    b"loadid",
    b"makedir",
    b"mechunitload",
    b"motionsup",
    b"moveextj",
    b"nop",
    b"open",
    b"opendir",
    b"pathacclim",
    b"pathreclstart",
    b"pathrecstart",
    b"pathrecstop",
    b"pathresol",
    b"pulsedo",
    b"raise",
    b"readanybin",
    b"readerrdata",
    b"readrawbytes",
    b"removedir",
    b"removefile",
    b"renamefile",
    b"reset",
    b"resetppmoved",
    b"restopath",
    b"retry",
    b"return",
    b"save",
    b"setalldatavalue",
    b"setao",
    b"setdatasearch",
    b"setdatavalue",
    b"setdo",
    b"setgo",
    b"setsysdata",
    b"singarea",
    b"sismoveoff",
    b"skipwarn",
    b"socketaccept",
    b"socketbind",
    b"socketclose",
    b"socketconnect",
    b"socketcreate",
    b"socketlisten",
    b"socketreceive",
    b"socketsend",
    b"softact",
    b"softdeact",
    b"speedlimaxis",
    b"speedlimcheckpoint",
    b"speedrefresh",
    b"startload",
    b"startmove",
    b"startmoveretry",
    b"stop",
    b"stopmove",
    b"stopmovereset",
    b"storepath",
    b"syncmoveoff",
    b"syncmoveon",
    b"syncmoveundo",
    b"systemstopaction",
    b"testsigndefine",
    b"testsignreset",
    b"texttabinstall",
    b"tpdefaultdi",
    b"tperase",
    b"tpreaddnum",
    b"tpreadfk",
    b"tpreadnum",
    b"tpshow",
    b"tpwrite",
    b"triggcheckio",
    b"triggequip",
    b"triggint",
    b"triggio",
    b"triggrampao",
    b"triggspeed",
    b"triggstopproc",
    b"trynext",
    b"tunereset",
    b"tuneservo",
    b"uimsgbox",
    b"uimsgwrite",
    b"uishow",
    b"unload",
    b"unpackrawbytes",
    b"velset",
    b"waitai",
    b"waitao",
    b"waitdi",
    b"waitdo",
    b"waitgi",
    b"waitgo",
    b"waitload",
    b"waitrob",
    b"waitsyncmove",
    b"waitsynctask",
    b"waittestandset",
    b"waittime",
    b"waituntil",
    b"waitwobj",
    b"warmstart",
    b"worldacclim",
    b"worldzone",
    b"write",
    b"writeanybin",
    b"writebin",
    b"writerawbytes",
    b"writestrbin",
    b"wzboxdef",
    b"wzcyldef",
    b"wzdisable",
    b"wzdosset",
    b"wzenable",
    b"wzfree",
    b"wzhomejointdef",
    b"wzlimjointdef",
    b"wzlimsup",
    b"wzsphdef",
];

/// Verbs of the names that were met.
#[derive(Debug, Default)]
pub(super) struct Verbs(Vec<Option<Verb>>);

impl Verbs {
    /// What an instruction of this name does.
    pub(super) fn of(&mut self, name: Symbol, spelling: &[u8]) -> Verb {
        let at = name.0 as usize;
        if self.0.len() <= at {
            self.0.resize(at + 1, None);
        }
        *self.0[at].get_or_insert_with(|| verb(spelling))
    }
}

pub(super) fn verb(spelling: &[u8]) -> Verb {
    let lower = spelling.to_ascii_lowercase();
    match lower.as_slice() {
        b"confl" => Verb::ConfL,
        b"confj" => Verb::ConfJ,
        b"pdispon" | b"pdispset" => Verb::ProgramDisplacement,
        b"pdispoff" => Verb::ProgramDisplacementOff,
        b"eoffson" | b"eoffsset" => Verb::ExternalOffset,
        b"eoffsoff" => Verb::ExternalOffsetOff,
        b"mtooltcpcalib" | b"mtoolrotcalib" | b"stooltcpcalib" | b"stoolrotcalib" => {
            Verb::WritesTool
        }
        b"gripload" => Verb::GripLoad,
        b"moveextj" => Verb::Harmless,
        _ => moving(spelling, &lower).unwrap_or_else(|| {
            let known = HARMLESS.binary_search(&lower.as_slice()).is_ok();
            if known { Verb::Harmless } else { Verb::Other }
        }),
    }
}

fn moving(spelling: &[u8], lower: &[u8]) -> Option<Verb> {
    let first = MOVING.iter().find(|first| lower.starts_with(first))?;
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
        first: match *first {
            b"search" => 2,
            b"egmmove" => 1,
            _ => 0,
        },
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
    fn moves_are_told_by_their_names() {
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
    fn the_list_of_harmless_instructions_is_sorted() {
        assert!(HARMLESS.is_sorted());
    }

    #[test]
    fn common_instructions_are_harmless_and_procedures_are_not() {
        assert_eq!(verb(b"SetDO"), Verb::Harmless);
        assert_eq!(verb(b"WaitTime"), Verb::Harmless);
        assert_eq!(verb(b"PickPart"), Verb::Other);
        assert_eq!(verb(b"PDispSet"), Verb::ProgramDisplacement);
    }
}
