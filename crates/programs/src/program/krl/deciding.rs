//! How statements read numbers of targets, and decide.

use crate::program::Deciding;
use crate::program::words::{Spelling, in_names};

pub(super) static MANNER: Deciding = Deciding {
    signs: &[
        b".X", b".Y", b".Z", b".A", b".B", b".C", b".x", b".y", b".z", b".a", b".b", b".c",
    ],
    // a data list declares, and decides nothing
    part: |bytes| {
        let start = bytes[..bytes.len().min(LONGEST_HEADER)].to_ascii_uppercase();
        let is_list = memchr::memmem::find(&start, b"DEFDAT").is_some();
        0..if is_list { 0 } else { bytes.len() }
    },
    decides: &[
        b"IF", b"WHILE", b"FOR", b"UNTIL", b"SWITCH", b"CASE", b"WHEN",
    ],
    joins: &[
        b"AND", b"OR", b"EXOR", b"NOT", b"B_AND", b"B_OR", b"B_EXOR", b"B_NOT", b"TO", b"STEP",
    ],
    routines: &[b"DEF", b"DEFFCT"],
    declares: &[
        b"DECL", b"INT", b"REAL", b"BOOL", b"CHAR", b"FRAME", b"POS", b"E6POS", b"AXIS", b"E6AXIS",
    ],
    stays: &[b"E1", b"E2", b"E3", b"E4", b"E5", b"E6"],
    ..Deciding::new(Spelling {
        comment: b";",
        in_names: in_names(b"$_"),
        has_escapes: false,
        has_entities: false,
    })
};

/// Bytes in front of the first word of a file at most: `&ACCESS`, comments.
const LONGEST_HEADER: usize = 2000;
