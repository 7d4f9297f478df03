//! How statements read numbers of targets, and decide.

use crate::program::Deciding;
use crate::program::deciding::Headers;
use crate::program::words::{Spelling, in_names};

pub(super) static MANNER: Deciding = Deciding {
    signs: &[b".trsf", b"distance(", b"position("],
    part: |bytes| {
        let start = memchr::memmem::find(bytes, b"<Code");
        let end = memchr::memmem::rfind(bytes, b"</Code");
        match (start, end) {
            (Some(start), Some(end)) if start < end => start..end,
            _ => 0..0,
        }
    },
    decides: &[
        b"if", b"elseIf", b"while", b"for", b"switch", b"case", b"until", b"wait",
    ],
    joins: &[b"and", b"or", b"xor", b"not", b"to", b"step"],
    routines: &[b"<Program"],
    headers: Some(Headers {
        routine: b"<Program name=\"",
        parameter: b"<Parameter name=\"",
        own: b"<Local name=\"",
    }),
    measures: &[b"distance", b"position"],
    apart: &[
        b"size",
        b"isDefined",
        b"movej",
        b"movel",
        b"movec",
        b"pointToJoint",
        b"isInRange",
        b"config",
    ],
    stays: &[b"config"],
    ..Deciding::new(Spelling {
        comment: b"//",
        in_names: in_names(b"$_"),
        has_escapes: true,
        has_entities: true,
    })
};
