//! How statements read numbers of targets, and decide.

use crate::program::Deciding;
use crate::program::words::{Spelling, in_names};

pub(super) static MANNER: Deciding = Deciding {
    signs: &[b"GETE"],
    decides: &[
        b"IF",
        b"IFEXP",
        b"IFEXPRESS",
        b"IFTHEN",
        b"IFTHENEXP",
        b"ELSEIF",
        b"ELSEIFEXP",
        b"WHILE",
        b"WHILEEXP",
        b"UNTIL",
        b"FOR",
        b"SWITCH",
    ],
    joins: &[
        b"AND", b"OR", b"ANDEXP", b"OREXP", b"TO", b"STEP", b"EXPRESS", b"MOD",
    ],
    sets: &[
        b"SET", b"GETE", b"SETE", b"ADD", b"SUB", b"MUL", b"DIV", b"MULMAT", b"INVMAT", b"CNVRT",
        b"SQRT", b"SIN", b"COS",
    ],
    measures: &[b"GETE"],
    ..Deciding::new(Spelling {
        comment: b"'",
        in_names: in_names(b"_"),
        has_escapes: false,
        has_entities: false,
    })
};
