//! The sections of a listing: `/PROG`, `/ATTR`, `/APPL`, `/MN`, `/POS`, `/END`.

use crate::program::kit::{self, line_behind};
use std::ops::Range;

/// Where the sections of a listing are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Sections {
    /// The name behind `/PROG`.
    pub name: Range<usize>,
    /// From behind the `/PROG` line to the first byte of `/MN`: attributes and application data.
    pub head: Range<usize>,
    /// Behind the `/MN` line to the first byte of the next section.
    pub lines: Range<usize>,
    /// Behind the `/POS` line to the end.
    pub points: Range<usize>,
    /// `/END` closes it.
    pub is_closed: bool,
}

impl Sections {
    /// The sections; `None` where the text is not a program: a log, an error list.
    pub(super) fn of(bytes: &[u8]) -> Option<Self> {
        let start = content_start(bytes);
        let name = keyword(bytes, start, b"/PROG")?;
        let first_line = line_end(bytes, name);
        let mut sections = Self {
            name: trimmed(bytes, name..first_line),
            head: first_line..bytes.len(),
            lines: 0..0,
            points: bytes.len()..bytes.len(),
            is_closed: false,
        };
        let mut at = first_line;
        // the byte before is a line end
        while let Some(ahead) = slash_at_line_start(bytes, at) {
            if let Some(behind) = keyword(bytes, ahead, b"/MN") {
                if sections.lines.start == 0 {
                    sections.head.end = ahead;
                    sections.lines = line_end(bytes, behind)..bytes.len();
                }
            } else if sections.lines.start != 0 {
                let has_points = sections.points.start < bytes.len();
                if let Some(behind) = keyword(bytes, ahead, b"/POS").filter(|_| !has_points) {
                    sections.lines.end = ahead;
                    sections.points = line_end(bytes, behind)..bytes.len();
                } else if keyword(bytes, ahead, b"/END").is_some() {
                    if !has_points {
                        sections.lines.end = ahead;
                    }
                    sections.is_closed = true;
                    break;
                }
            }
            at = ahead + 1;
        }
        (sections.lines.start != 0).then_some(sections)
    }
}

/// The first byte behind a byte order mark and blanks.
pub(super) fn content_start(bytes: &[u8]) -> usize {
    let mark = kit::content_start(bytes);
    mark + blanks(&bytes[mark..])
}

/// The byte behind `word` where it stands at `at` and ends there.
fn keyword(bytes: &[u8], at: usize, word: &[u8]) -> Option<usize> {
    let behind = at + word.len();
    let stands = bytes.get(at..behind)?.eq_ignore_ascii_case(word);
    let ends = bytes
        .get(behind)
        .is_none_or(|b| !b.is_ascii_alphanumeric() && *b != b'_');
    (stands && ends).then_some(behind)
}

/// The first `/` at or behind `at` with nothing but blanks before it in its line; `at` starts a
/// line or is inside one.
fn slash_at_line_start(bytes: &[u8], at: usize) -> Option<usize> {
    let slashes = memchr::memchr_iter(b'/', &bytes[at..]);
    slashes.map(|k| at + k).find(|&slash| {
        let before = bytes[..slash].iter().rev();
        let kept = before.copied().find(|b| !matches!(b, b' ' | b'\t'));
        matches!(kept, None | Some(b'\n' | b'\r'))
    })
}

fn blanks(bytes: &[u8]) -> usize {
    bytes.iter().take_while(|b| b.is_ascii_whitespace()).count()
}

fn trimmed(bytes: &[u8], range: Range<usize>) -> Range<usize> {
    let text = &bytes[range.clone()];
    let start = range.start + text.len() - text.trim_ascii_start().len();
    start..start + text.trim_ascii().len()
}

/// The first byte behind the line of `at`, its end included.
pub(super) fn line_end(bytes: &[u8], at: usize) -> usize {
    line_behind(bytes, at).unwrap_or(bytes.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_found_in_any_line_ends() {
        for end in ["\n", "\r\n", "\r"] {
            let text =
                "/PROG  A1\tMacro\n/ATTR\nX = 1;\n/APPL\n/MN\n 1: ! a/b ;\n/POS\nP[1]{\n};\n/END\n";
            let text = text.replace('\n', end);
            let bytes = text.as_bytes();
            let found = Sections::of(bytes).expect("a program");
            assert!(bytes[found.name.clone()].starts_with(b"A1"));
            assert!(bytes[found.lines.clone()].starts_with(b" 1: !"));
            assert!(bytes[found.points.clone()].starts_with(b"P[1]{"));
            assert!(bytes[found.head].starts_with(b"/ATTR"));
        }
    }

    #[test]
    fn a_log_is_no_program() {
        for text in [
            "",
            "/PROG A",
            "/PROGRAM A\n/MN\n",
            "ERRALL.LS      Robot Name LINE1\n1/MN\n",
            "  123\" 05-JAN-20 SRVO-001 /MN\n",
        ] {
            assert_eq!(Sections::of(text.as_bytes()), None, "{text}");
        }
    }
}
