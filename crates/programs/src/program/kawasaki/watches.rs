//! Signals that are watched: `ON … GOTO` and `ONI … GOTO` until `IGNORE`.
//!
//! They hold in the order in which the program runs, which may be another than that of its lines:
//! what may be watched counts as watched.

use super::keywords::find;
use super::reader::key;
use super::sections::Program;
use crate::program::words::Words;
use std::ops::Range;

/// A signal at which a program goes to a label.
pub(super) struct Watch {
    signal: Vec<u8>,
    pub label: u64,
    /// The bytes of the lines in which it may come.
    pub lines: Range<usize>,
}

/// The statements that open a block.
pub(super) const OPENING: &[&str] = &["CASE", "SCASE", "WHile", "FOR", "DO"];

/// The signals that a program watches.
pub(super) fn watches(bytes: &[u8], of: &Program) -> Vec<Watch> {
    let mut found: Vec<Watch> = Vec::new();
    let has = |line: &[u8], word: &[u8]| {
        (line.windows(word.len())).any(|part| part.eq_ignore_ascii_case(word))
    };
    // most programs watch nothing
    let may_watch = |line: &[u8]| has(line, b"ON") && has(line, b"GO");
    let text = &bytes[of.lines.clone()];
    if !text.split(|b| matches!(b, b'\n' | b'\r')).any(may_watch) {
        return found;
    }
    // the first line that the program may come back to, and the outermost block that is open
    let (mut first_label, mut outermost, mut depth) = (None, None, 0_u32);
    of.each(
        bytes,
        |_| true,
        |line| {
            let (keyword, part) = (line.keyword, line.words);
            if line.label.is_some() {
                first_label.get_or_insert(line.start);
                // the jump to here may have passed over what ended it
                let is_open = |ended: &Watch| {
                    let same = |one: &Watch| one.signal == ended.signal && one.label == ended.label;
                    (found.iter()).any(|one| one.lines.end == usize::MAX && same(one))
                };
                let ended: Vec<Watch> = (found.iter())
                    .filter(|one| one.lines.end < usize::MAX && !is_open(one))
                    .map(|one| Watch {
                        signal: one.signal.clone(),
                        label: one.label,
                        lines: line.start..usize::MAX,
                    })
                    .collect();
                found.extend(ended);
            }
            let is_block = keyword == "IF" && part.find(b"THEN").is_some();
            if OPENING.contains(&keyword) || is_block {
                if depth == 0 {
                    outermost = Some(line.start);
                }
                depth += 1;
            } else if matches!(keyword, "ENd" | "UNtil") {
                depth = depth.saturating_sub(1);
            } else if matches!(keyword, "ON" | "ONI") && find(part, "CAll").is_none() {
                let Some(at) = find(part, "GOto") else {
                    return;
                };
                let block = outermost.filter(|_| depth > 0);
                let from = first_label.into_iter().chain(block).min();
                found.push(Watch {
                    signal: signal(part.part(1..at)).to_vec(),
                    label: key(part.text(at + 1)),
                    lines: from.unwrap_or(line.start)..usize::MAX,
                });
            } else if keyword == "IGnore" && depth == 0 {
                let ignored = signal(part.behind(1));
                let open = found.iter_mut().filter(|one| one.lines.end == usize::MAX);
                for one in open.filter(|one| one.signal == ignored) {
                    one.lines.end = line.start;
                }
            }
        },
    );
    found
}

/// A signal without its mode: `/LVL 1001`.
fn signal<'a>(part: Words<'a, '_>) -> &'a [u8] {
    let mode = if part.is(0, b'/') { 2 } else { 0 };
    part.behind(mode).whole()
}
