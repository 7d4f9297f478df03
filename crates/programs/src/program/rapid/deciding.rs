//! How statements read numbers of targets, and decide.

use crate::program::Deciding;
use crate::program::words::{Spelling, in_names};

pub(super) static MANNER: Deciding = Deciding {
    signs: &[b".trans", b".rot", b".robconf", b".robax", b".Trans"],
    end: Some(b';'),
    condition_end: b":",
    index: b'{',
    decides: &[
        b"IF",
        b"ELSEIF",
        b"WHILE",
        b"FOR",
        b"TEST",
        b"CASE",
        b"WaitUntil",
    ],
    skips: &[
        b"THEN",
        b"DO",
        b"ELSE",
        b"DEFAULT",
        b"ENDIF",
        b"ENDFOR",
        b"ENDWHILE",
        b"ENDTEST",
        b"ENDPROC",
        b"ENDFUNC",
        b"ENDTRAP",
    ],
    joins: &[
        b"AND", b"OR", b"XOR", b"NOT", b"DIV", b"MOD", b"FROM", b"TO", b"STEP",
    ],
    routines: &[b"PROC", b"FUNC", b"TRAP"],
    declares: &[b"VAR", b"PERS", b"CONST"],
    measures: &[b"Distance", b"EulerZYX"],
    apart: &[
        b"Dim", b"Present", b"IsPers", b"IsVar", b"CRobT", b"CJointT",
    ],
    stays: &[b"extax"],
    ..Deciding::new(Spelling {
        comment: b"!",
        in_names: in_names(b"_"),
        has_escapes: false,
        has_entities: false,
    })
};
