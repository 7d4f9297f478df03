//! How statements read numbers of targets, and decide.

use crate::program::Deciding;
use crate::program::words::{Spelling, in_names};

pub(super) static MANNER: Deciding = Deciding {
    signs: &[b"pose_dist(", b"point_dist(", b"norm("],
    // an index behind a name, which is not `p` of a pose in numbers
    reads: |text| {
        let is_letter = |at: usize| text[at] == b'_' || text[at].is_ascii_alphanumeric();
        memchr::memchr_iter(b'[', text).any(|at| {
            let is_p = at > 0 && text[at - 1] == b'p' && (at == 1 || !is_letter(at - 2));
            let end = memchr::memchr2(b',', b']', &text[at..]);
            let is_pose = is_p && end.is_none_or(|end| text[at + end] == b',');
            at > 0 && is_letter(at - 1) && !is_pose
        })
    },
    condition_end: b":",
    index_reads: true,
    decides: &[b"if", b"elif", b"while", b"switch", b"case", b"until"],
    joins: &[b"and", b"or", b"xor", b"not"],
    routines: &[b"def", b"thread", b"sec"],
    blocks: &[
        b"def", b"thread", b"sec", b"if", b"while", b"for", b"switch",
    ],
    declares: &[b"local"],
    measures: &[b"pose_dist", b"point_dist", b"norm"],
    apart: &[
        b"length",
        b"get_list_length",
        b"size",
        b"is_within_safety_limits",
        b"get_inverse_kin_has_solution",
    ],
    literal: b"p",
    ..Deciding::new(Spelling {
        comment: b"#",
        in_names: in_names(b"_"),
        has_escapes: false,
        has_entities: false,
    })
};
