//! Words, numbers and signs of `URScript`; comments, annotations and blanks are passed over.
//!
//! A line end ends a statement except inside brackets. A line that starts with `$` is an annotation
//! of the pendant: no code.

use crate::program::kit::content_start;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name or a word of the language, dots inside included.
    Word,
    /// Something that starts as a number does, without its sign.
    Number,
    /// A text in quotes.
    Text,
    /// Any other byte.
    Sign(u8),
    /// The end of a line, or `;`.
    Line,
    /// The end of the file.
    End,
}

/// A token and its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token {
    pub kind: Kind,
    pub start: usize,
    pub end: usize,
}

impl Token {
    /// Whether it is this sign.
    pub(super) fn is(self, sign: u8) -> bool {
        self.kind == Kind::Sign(sign)
    }
}

/// Why there is no next token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct OpenText {
    /// Where the text starts.
    pub start: usize,
}

/// Reads tokens from the front.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scanner<'a> {
    pub bytes: &'a [u8],
    pub at: usize,
    line_start: bool,
}

fn in_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80
}

impl<'a> Scanner<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            at: content_start(bytes),
            line_start: true,
        }
    }

    fn skip_line(&mut self) {
        let rest = &self.bytes[self.at..];
        self.at += memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
    }

    /// The next token.
    ///
    /// # Errors
    /// Where a text has no end on its line.
    pub(super) fn next(&mut self) -> Result<Token, OpenText> {
        loop {
            let Some(&byte) = self.bytes.get(self.at) else {
                return Ok(self.token(Kind::End, 0));
            };
            match byte {
                b' ' | b'\t' | 0x0b | 0x0c | 0x1a => self.at += 1,
                b'#' => self.skip_line(),
                b'$' if self.line_start => self.skip_line(),
                _ => break,
            }
        }
        let byte = self.bytes[self.at];
        let was_start = std::mem::replace(&mut self.line_start, false);
        let rest = &self.bytes[self.at..];
        let token = match byte {
            b'\n' | b'\r' => {
                self.line_start = true;
                self.token(Kind::Line, 1)
            }
            b';' => {
                self.line_start = was_start;
                self.token(Kind::Line, 1)
            }
            b'"' => {
                let length = memchr::memchr3(b'"', b'\n', b'\r', &rest[1..]);
                match length {
                    Some(length) if rest[length + 1] == b'"' => self.token(Kind::Text, length + 2),
                    _ => return Err(OpenText { start: self.at }),
                }
            }
            b'0'..=b'9' => self.token(Kind::Number, number_length(rest)),
            b'.' if rest.get(1).is_some_and(u8::is_ascii_digit) => {
                self.token(Kind::Number, number_length(rest))
            }
            _ if in_word(byte) => {
                let dotted = |at: usize| {
                    rest[at] == b'.' && rest.get(at + 1).is_some_and(|&next| in_word(next))
                };
                let end = (1..rest.len()).find(|&at| !in_word(rest[at]) && !dotted(at));
                self.token(Kind::Word, end.unwrap_or(rest.len()))
            }
            _ => self.token(Kind::Sign(byte), 1),
        };
        self.at = token.end;
        Ok(token)
    }

    /// The next token, which stays next; a text without end is one to the end of the file.
    pub(super) fn peek(&self) -> Token {
        let mut ahead = *self;
        ahead.next().unwrap_or_else(|open| Token {
            kind: Kind::Text,
            start: open.start,
            end: self.bytes.len(),
        })
    }

    fn token(&self, kind: Kind, length: usize) -> Token {
        Token {
            kind,
            start: self.at,
            end: self.at + length,
        }
    }
}

/// Bytes of a number without sign: digits, points, letters, and a sign behind an exponent's letter.
pub(super) fn number_length(text: &[u8]) -> usize {
    let mut at = 0;
    while let Some(&byte) = text.get(at) {
        let exponent_sign = matches!(byte, b'+' | b'-')
            && at > 0
            && matches!(text[at - 1], b'e' | b'E')
            && text[..at - 1]
                .iter()
                .all(|b| b.is_ascii_digit() || *b == b'.');
        if !in_word(byte) && byte != b'.' && !exponent_sign {
            break;
        }
        at += 1;
        // no number is longer; what follows is another token
        if at == 400 {
            break;
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<String> {
        let mut scanner = Scanner::new(text.as_bytes());
        let mut found = Vec::new();
        while let Ok(token) = scanner.next() {
            if token.kind == Kind::End {
                break;
            }
            found.push(String::from_utf8_lossy(&scanner.bytes[token.start..token.end]).into());
        }
        found
    }

    #[test]
    fn comments_and_annotations_are_passed_over() {
        assert_eq!(
            words("$ 8 \"a≔p[1]\"\n  $ 9 \"\nx=1 # movel(p[\r\"a # b\"$"),
            ["\n", "\n", "x", "=", "1", "\r", "\"a # b\"", "$"]
        );
    }

    #[test]
    fn numbers_keep_their_exponents_and_words_their_dots() {
        assert_eq!(
            words("-.5e-4+1E3-2 a.b p[3.]"),
            [
                "-", ".5e-4", "+", "1E3", "-", "2", "a.b", "p", "[", "3.", "]"
            ]
        );
    }
}
