//! `/MN`: the instructions of a program, each with its place.

use super::sections::line_end;
use super::words::{motion, outside};
use std::ops::Range;

/// Bytes of an instruction; what is longer is none.
const MOST_TEXT: usize = 1 << 16;

/// The instructions of a section.
pub(super) struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    end: usize,
}

/// The text of one instruction, over several lines where a colon continues it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Line {
    /// From its first byte to behind its last, without the semicolon.
    pub text: Range<usize>,
    /// A semicolon ends it.
    pub is_closed: bool,
}

impl<'a> Lines<'a> {
    /// The instructions in this range.
    pub(super) fn new(bytes: &'a [u8], range: Range<usize>) -> Self {
        Self {
            bytes,
            at: range.start,
            end: range.end,
        }
    }

    /// The first byte of what stands behind blanks, empty lines, line number and colon, and whether
    /// there was a number.
    fn line_start(&self) -> Option<(usize, bool)> {
        let bytes = &self.bytes[..self.end];
        let mut at = self.at;
        while bytes
            .get(at)
            .is_some_and(|b| b.is_ascii_whitespace() || *b == b';')
        {
            at += 1;
        }
        let digits = bytes[at..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count();
        let mut behind = at + digits;
        while matches!(bytes.get(behind), Some(b' ' | b'\t')) {
            behind += 1;
        }
        let colon = bytes.get(behind) == Some(&b':');
        if colon {
            at = behind + 1;
            while matches!(bytes.get(at), Some(b' ' | b'\t')) {
                at += 1;
            }
        }
        (at < bytes.len()).then_some((at, colon && digits > 0))
    }

    /// Goes behind `--eg:a comment`: over lines that begin with a colon alone, to the one that a
    /// semicolon ends.
    fn skip_comment(&mut self, start: usize) {
        let mut line = start;
        loop {
            let end = line_end(self.bytes, line).min(self.end);
            let text = self.bytes[line..end].trim_ascii_end();
            self.at = end;
            let next = self.bytes[end..self.end].trim_ascii_start();
            if text.ends_with(b";") || !next.starts_with(b":") {
                return;
            }
            line = self.end - next.len();
        }
    }

    /// Goes on to the `;`. A line with a number of its own, or that starts a move, is another
    /// instruction.
    fn collect(&mut self, start: usize) -> Line {
        loop {
            let line = line_end(self.bytes, self.at).min(self.end);
            let rest = &self.bytes[self.at..line];
            if let Some(semicolon) = semicolon(rest) {
                let text = start..self.at + semicolon;
                self.at = text.end + 1;
                return Line {
                    text,
                    is_closed: true,
                };
            }
            let text = start..self.at + rest.trim_ascii_end().len();
            self.at = line;
            let next = self.line_start().filter(|(ahead, numbered)| {
                let ahead = &self.bytes[*ahead..self.end];
                !numbered && motion(ahead).is_none() && !ahead.starts_with(b"!")
            });
            match next {
                Some((next, _)) if text.len() <= MOST_TEXT => self.at = next,
                _ => {
                    return Line {
                        text,
                        is_closed: false,
                    };
                }
            }
        }
    }
}

impl Iterator for Lines<'_> {
    type Item = Line;

    fn next(&mut self) -> Option<Line> {
        loop {
            let Some((start, _)) = self.line_start() else {
                self.at = self.end;
                return None;
            };
            let rest = &self.bytes[start..self.end];
            if rest.starts_with(b"!") {
                self.at = line_end(self.bytes, start).min(self.end);
                continue;
            }
            if rest.starts_with(b"--") {
                self.skip_comment(start);
                continue;
            }
            self.at = start;
            return Some(self.collect(start));
        }
    }
}

/// The `;` that ends an instruction: not one in a string or a name.
fn semicolon(line: &[u8]) -> Option<usize> {
    let found = memchr::memchr(b';', line)?;
    let before = &line[..found];
    let count = |bracket| memchr::memchr_iter(bracket, before).count();
    if memchr::memchr(b'\'', before).is_none() && count(b'[') == count(b']') {
        return Some(found);
    }
    let mut all = outside(line);
    let end = all.find(|(_, byte)| *byte == b';').map(|(at, _)| at);
    end.or(Some(found))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instructions_end_at_semicolons_or_where_another_begins() {
        let of = |text: &str| {
            let lines = Lines::new(text.as_bytes(), 0..text.len());
            let texts = lines.map(|line| text[line.text].to_owned());
            texts.collect::<Vec<_>>()
        };
        assert_eq!(
            of("   5:J P[1] 100% FINE    ;\n : ; \n  6: ! L P[9] ;\n"),
            ["J P[1] 100% FINE    ", ""]
        );
        let two = "1:L P[1] 100mm/sec FINE\r\n2:L P[2] 100mm/sec FINE ;\r\n";
        assert_eq!(of(two), ["L P[1] 100mm/sec FINE", "L P[2] 100mm/sec FINE "]);
        assert_eq!(of(":L P[1] 9mm/sec FINE\n:J P[2] 1% FINE ;").len(), 2);
        assert_eq!(
            of("31:C P[23] \n    :  P[24:end] 250mm/sec CNT2 ;"),
            ["C P[23] \n    :  P[24:end] 250mm/sec CNT2 "]
        );
        assert_eq!(of("1:X('a;b') ; Y ;"), ["X('a;b') ", "Y "]);
        let named = "1:PR[9,1:off;]=5 ;\n2:L P[2:Pick;Pt] 9mm/sec FINE Offset,PR[9:a[] ; X ;";
        assert_eq!(
            of(named),
            [
                "PR[9,1:off;]=5 ",
                "L P[2:Pick;Pt] 9mm/sec FINE Offset,PR[9:a[] ",
                "X "
            ]
        );
        assert_eq!(of("1: --eg:L P[1] ;\n2: !L P[1] ;").len(), 0);
        let long = "4:--eg:old tool\r\n  : UTOOL_NUM=2 ; and\r\n  : L P[1] ;\r\n  5:X ;";
        assert_eq!(of(long), ["X "]);
        assert_eq!(of("4:--eg:old tool\n5:X ;\n: Y ;"), ["X ", "Y "]);
        assert_eq!(of("2://C P[1]\n : P[2] 9mm/sec FINE ;").len(), 1);
    }
}
