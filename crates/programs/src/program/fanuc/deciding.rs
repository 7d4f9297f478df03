//! How statements read numbers of targets, and decide.

use crate::program::Deciding;
use crate::program::words::{Spelling, in_names};

pub(super) static MANNER: Deciding = Deciding {
    signs: &[b"PR["],
    part: |bytes| {
        let start = memchr::memmem::find(bytes, b"/MN").unwrap_or(bytes.len());
        let length = memchr::memmem::find(&bytes[start..], b"/POS");
        start..length.map_or(bytes.len(), |length| start + length)
    },
    condition_end: b",",
    decides: &[b"IF", b"ELSEIF", b"FOR", b"SELECT", b"WAIT"],
    joins: &[b"AND", b"OR", b"DIV", b"MOD", b"TO", b"DOWNTO"],
    of_file: &[b"P"],
    ..Deciding::new(Spelling {
        comment: b"--eg",
        in_names: in_names(b"_$"),
        has_escapes: false,
        has_entities: false,
    })
};
