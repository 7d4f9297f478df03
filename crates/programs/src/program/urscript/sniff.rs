//! Whether bytes look like `URScript`, and where the marker goes.

use crate::program::kit::{comments, content_start, line_behind};
use crate::program::{Marker, Source};

/// Bytes that are looked at: exports start with long libraries.
const LOOKED_AT: usize = 4 << 20;
/// Bytes at the end of a longer one in which the last function ends.
const LAST_LOOKED_AT: usize = 1 << 16;

/// Calls that no other language has under these names at the start of a statement.
const CALLS: [&[u8]; 12] = [
    b"movej(",
    b"movel(",
    b"movep(",
    b"movec(",
    b"servoj(",
    b"servoc(",
    b"speedl(",
    b"set_tcp(",
    b"set_payload(",
    b"textmsg(",
    b"get_inverse_kin(",
    b"pose_trans(",
];

fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut at = content_start(bytes);
    std::iter::from_fn(move || {
        if at >= bytes.len() {
            return None;
        }
        let rest = &bytes[at..];
        let length = memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        let line = (at, rest[..length].trim_ascii());
        at += length + 1;
        Some(line)
    })
}

/// `def name(…):`, `thread name():`
fn opens(line: &[u8]) -> bool {
    let rest = line
        .strip_prefix(b"def ")
        .or_else(|| line.strip_prefix(b"thread "))
        .or_else(|| line.strip_prefix(b"sec "));
    rest.is_some_and(|rest| {
        let colon = memchr::memchr(b':', rest);
        memchr::memchr(b'(', rest).is_some_and(|bracket| colon.is_some_and(|colon| bracket < colon))
    })
}

fn ends(line: &[u8]) -> bool {
    line == b"end" || line.starts_with(b"end ") || line.starts_with(b"end#")
}

fn calls(line: &[u8]) -> bool {
    CALLS.iter().any(|call| {
        memchr::memmem::find(line, call).is_some_and(|at| {
            at == 0
                || !(line[at - 1].is_ascii_alphanumeric() || matches!(line[at - 1], b'_' | b'.'))
        })
    })
}

/// Whether a pose of six numbers is written out in a line: `home = p[…]`, `return p[…]`.
fn has_pose(line: &[u8]) -> bool {
    let is_in_number = |b: &u8| b.is_ascii_digit() || b" .,+-eE".contains(b);
    memchr::memmem::find(line, b"p[").is_some_and(|at| {
        let is_word = at == 0 || line[at - 1] == b' ' || line[at - 1] == b'=';
        let inside = &line[at + 2..];
        let end = memchr::memchr(b']', inside).unwrap_or(0);
        let inside = &inside[..end];
        let numbers = inside.split(|b| *b == b',').count();
        is_word && numbers == 6 && inside.iter().all(is_in_number)
    })
}

/// Whether the bytes look like `URScript`.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    let (bytes, behind) = bytes.split_at(bytes.len().min(LOOKED_AT));
    let last = &behind[behind.len().saturating_sub(LAST_LOOKED_AT)..];
    if memchr::memchr(0, bytes).is_some() {
        return false;
    }
    let (mut opened, mut ended, mut called, mut poses) = (false, false, false, false);
    for (_, line) in lines(bytes) {
        if line.starts_with(b"import ") || line.starts_with(b"from ") || line.starts_with(b"#!") {
            return false;
        }
        if line.starts_with(b"#") || line.starts_with(b"$") {
            continue;
        }
        opened |= opens(line);
        ended |= ends(line);
        called |= !called && (calls(line) || has_pose(line));
        poses |= !poses && (CALLS[..4].iter().any(|call| line.starts_with(call)) || has_pose(line));
    }
    if opened {
        called && (ended || lines(last).any(|(_, line)| ends(line)))
    } else {
        poses && !ended
    }
}

/// Where the marker goes, and its text: behind the line that opens the first function, else at the
/// top.
pub(super) fn mark(source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
    let bytes = &source.bytes;
    let text = comments(source, marker, "  # ");
    let header = lines(bytes).find(|(_, line)| opens(line));
    let behind = header.and_then(|(at, _)| line_behind(bytes, at));
    (behind.unwrap_or_else(|| content_start(bytes)), text)
}
