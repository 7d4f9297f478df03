//! Words of the code of a program, one statement at a time.
//!
//! A statement is a line; one with a bracket open goes on. Before s7 quotes and signs are entities
//! (`&quot;`, `&lt;`).

/// What a word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Name,
    Number,
    /// A text, with its quotes.
    Text,
    /// A sign; of several signs the first, but `==` and the like are `~`.
    Sign(u8),
}

/// A word and where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token {
    pub kind: Kind,
    pub start: usize,
    pub end: usize,
}

impl Token {
    pub(super) fn is(&self, sign: u8) -> bool {
        self.kind == Kind::Sign(sign)
    }
}

/// Lines that a statement has at most.
const MOST_LINES: usize = 40;

/// Reads the statements of a program.
pub(super) struct Statements<'a> {
    pub bytes: &'a [u8],
    at: usize,
    end: usize,
    is_escaped: bool,
}

impl<'a> Statements<'a> {
    pub(super) fn of(bytes: &'a [u8], code: &std::ops::Range<usize>, is_escaped: bool) -> Self {
        Self {
            bytes,
            at: code.start,
            end: code.end,
            is_escaped,
        }
    }

    /// The entity here, and the bytes of it.
    fn entity(&self) -> Option<(u8, usize)> {
        let rest = &self.bytes[self.at..self.end];
        let known: [(&[u8], u8); 5] = [
            (b"&quot;", b'"'),
            (b"&lt;", b'<'),
            (b"&gt;", b'>'),
            (b"&amp;", b'&'),
            (b"&apos;", b'\''),
        ];
        let found = known.iter().find(|(text, _)| rest.starts_with(text));
        found
            .filter(|_| self.is_escaped)
            .map(|(text, sign)| (*sign, text.len()))
    }

    /// The sign here, and its bytes; nothing at the end.
    fn sign(&self) -> Option<(u8, usize)> {
        let byte = *self.bytes[..self.end].get(self.at)?;
        Some(match byte {
            b'&' => self.entity().unwrap_or((byte, 1)),
            _ => (byte, 1),
        })
    }

    /// Puts the words of the next statement into `tokens`; `false` at the end of the code.
    pub(super) fn next(&mut self, tokens: &mut Vec<Token>) -> bool {
        tokens.clear();
        let (mut depth, mut lines) = (0_usize, 0);
        while let Some((sign, length)) = self.sign() {
            let start = self.at;
            match sign {
                b'\n' | b'\r' => {
                    self.at += 1;
                    lines += usize::from(sign == b'\n');
                    let goes_on = depth > 0 && lines < MOST_LINES;
                    if !tokens.is_empty() && !goes_on {
                        return true;
                    }
                    continue;
                }
                b'/' if self.bytes[..self.end].get(start + 1) == Some(&b'/') => {
                    let rest = &self.bytes[start..self.end];
                    self.at += memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
                    continue;
                }
                b' ' | b'\t' | 0x0b | 0x0c => {
                    self.at += 1;
                    continue;
                }
                _ => {}
            }
            let kind = match sign {
                b'"' => {
                    self.at += length;
                    self.text();
                    Kind::Text
                }
                b'0'..=b'9' | b'.' if self.number() => Kind::Number,
                b'$' | b'_' | b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | 0x80.. => {
                    let word =
                        |b: &u8| matches!(b, b'$' | b'_' | 0x80..) || b.is_ascii_alphanumeric();
                    let rest = &self.bytes[start..self.end];
                    self.at += rest.iter().take_while(|b| word(b)).count();
                    Kind::Name
                }
                _ => {
                    self.at += length;
                    match sign {
                        b'(' | b'[' | b'{' => depth += 1,
                        b')' | b']' | b'}' => depth = depth.saturating_sub(1),
                        _ => {}
                    }
                    let pair = matches!(sign, b'=' | b'!' | b'<' | b'>')
                        && self.bytes[..self.end].get(self.at) == Some(&b'=');
                    self.at += usize::from(pair);
                    Kind::Sign(if pair { b'~' } else { sign })
                }
            };
            tokens.push(Token {
                kind,
                start,
                end: self.at,
            });
        }
        !tokens.is_empty()
    }

    /// Goes behind a text; one that is not closed ends with its line.
    fn text(&mut self) {
        while let Some((sign, length)) = self.sign() {
            match sign {
                b'\n' | b'\r' => return,
                b'\\' => self.at += 1,
                _ => {}
            }
            self.at = (self.at + length).min(self.end);
            if sign == b'"' {
                return;
            }
        }
    }

    /// Goes behind a number; false where none is.
    fn number(&mut self) -> bool {
        let rest = &self.bytes[self.at..self.end];
        let digits = |from: usize| {
            let digits = rest[from..].iter().take_while(|b| b.is_ascii_digit());
            from + digits.count()
        };
        let mut end = digits(0);
        if rest.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        if end == 1 && rest[0] == b'.' {
            return false;
        }
        if matches!(rest.get(end), Some(b'e' | b'E')) {
            let signed = usize::from(matches!(rest.get(end + 1), Some(b'+' | b'-')));
            let power = digits(end + 1 + signed);
            if power > end + 1 + signed {
                end = power;
            }
        }
        self.at += end;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(code: &str, is_escaped: bool) -> Vec<Vec<&str>> {
        let mut statements = Statements::of(code.as_bytes(), &(0..code.len()), is_escaped);
        let (mut tokens, mut all) = (Vec::new(), Vec::new());
        while statements.next(&mut tokens) {
            all.push(tokens.iter().map(|t| &code[t.start..t.end]).collect());
        }
        all
    }

    #[test]
    fn a_line_is_a_statement_and_open_brackets_go_on() {
        let code = "a=b[1] // movel(\r\n\r\nmovel(p,\n {1,-2.5e1,.5},t)\nx!=\"a//\\\"b\" & 3\n";
        assert_eq!(
            words(code, false),
            [
                vec!["a", "=", "b", "[", "1", "]"],
                vec![
                    "movel", "(", "p", ",", "{", "1", ",", "-", "2.5e1", ",", ".5", "}", ",", "t",
                    ")"
                ],
                vec!["x", "!=", "\"a//\\\"b\"", "&", "3"],
            ]
        );
    }

    #[test]
    fn entities_are_the_signs_that_they_stand_for() {
        let code = "put(&quot;a&lt;b&quot;)\nif a&lt;=3 &amp; b\n";
        assert_eq!(
            words(code, true),
            [
                vec!["put", "(", "&quot;a&lt;b&quot;", ")"],
                vec!["if", "a", "&lt;=", "3", "&amp;", "b"]
            ]
        );
    }
}
