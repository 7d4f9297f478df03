//! How statements read numbers of targets, and decide.

use super::sections::SPELLING;
use crate::program::Deciding;

pub(super) static MANNER: Deciding = Deciding {
    signs: &[
        b"DX",
        b"DY",
        b"DZ",
        b"DEXT",
        b"DISTANCE",
        b"dx",
        b"dy",
        b"dz",
        b"dext",
        b"distance",
    ],
    decides: &[
        b"IF", b"ELSEIF", b"WHILE", b"FOR", b"UNTIL", b"CASE", b"SCASE", b"WAIT",
    ],
    joins: &[
        b"AND", b"OR", b"XOR", b"NOT", b"BAND", b"BOR", b"BXOR", b"MOD", b"TO", b"STEP", b"COM",
    ],
    routines: &[b".PROGRAM"],
    measures: &[b"DX", b"DY", b"DZ", b"DEXT", b"DISTANCE"],
    apart: &[b"EXISTTRANS", b"EXISTJOINT", b"EXISTREAL"],
    ..Deciding::new(SPELLING)
};
