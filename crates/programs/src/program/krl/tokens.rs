//! KRL text as lines of tokens over bytes.
//!
//! A statement is one line; nothing goes on to the next. Nothing is decoded or copied. Bytes of
//! 0x80 and above count as letters, so Latin-1 and UTF-8 both pass. A line may end with LF, CR LF
//! or CR.

use crate::program::kit::Fault;
use crate::program::script::short;

/// What reading gives where it fails.
pub(super) type Read<T> = Result<T, Fault>;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name or keyword, `$` included.
    Name,
    /// Something that starts like a number, with everything that clings to it: `12`, `.5`,
    /// `1.5E-12`, `12.3.4`.
    Number,
    /// `'B0101'`, `'HFF'` or `'B 0101'`, quotes included.
    Bits,
    /// A string with its quotes.
    Text,
    /// Any other sign, one byte.
    Sign(u8),
    /// End of the line, or a comment.
    End,
}

/// A token at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token {
    pub kind: Kind,
    pub start: u32,
    pub end: u32,
}

impl Token {
    /// Whether it is this sign.
    pub(super) fn is(self, sign: u8) -> bool {
        self.kind == Kind::Sign(sign)
    }

    /// It stands where something else belongs.
    pub(super) fn unexpected(self, expected: &'static str) -> Fault {
        Fault::unexpected(self.start as usize..self.end as usize, expected)
    }
}

const LETTER: u8 = 1;
const DIGIT: u8 = 2;

const CLASSES: [u8; 256] = {
    let mut classes = [0; 256];
    let mut at = 0;
    while at < 256 {
        // at is below 256
        #[allow(clippy::cast_possible_truncation)]
        let byte = at as u8;
        classes[at] = if byte.is_ascii_alphabetic() || byte == b'_' || byte == b'$' || byte >= 0x80
        {
            LETTER
        } else if byte.is_ascii_digit() {
            DIGIT
        } else {
            0
        };
        at += 1;
    }
    classes
};

fn class(byte: u8) -> u8 {
    CLASSES[usize::from(byte)]
}

/// Reads the tokens of one line, one after another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor<'a> {
    pub bytes: &'a [u8],
    pub at: usize,
    /// The end of the line.
    pub end: usize,
}

impl<'a> Cursor<'a> {
    /// The bytes of a token.
    pub(super) fn text(&self, token: Token) -> &'a [u8] {
        &self.bytes[token.start as usize..token.end as usize]
    }

    /// Skips blanks; the byte behind them, 0 at the end of the line.
    pub(super) fn blanks(&mut self) -> u8 {
        while self.at < self.end {
            match self.bytes[self.at] {
                // a control character is a blank, too
                0..=b' ' => self.at += 1,
                other => return other,
            }
        }
        0
    }

    /// Skips an expression, up to a comma or colon outside brackets, a bracket that closes, or the
    /// end of the line.
    pub(super) fn skip(&mut self) {
        let mut depth = 0_u32;
        loop {
            let before = self.at;
            let token = self.next();
            match token.kind {
                Kind::End => return,
                Kind::Sign(b'(' | b'[' | b'{') => depth += 1,
                Kind::Sign(b')' | b']' | b'}') if depth > 0 => depth -= 1,
                Kind::Sign(b')' | b']' | b'}' | b',' | b':') if depth == 0 => {
                    self.at = before;
                    return;
                }
                _ => {}
            }
        }
    }

    /// Passes over the rest of the line, to its comment.
    pub(super) fn skip_all(&mut self) {
        while self.next().kind != Kind::End {}
    }

    /// The next token; a comment ends the line.
    pub(super) fn next(&mut self) -> Token {
        let first = self.blanks();
        let start = self.at;
        if start >= self.end || first == b';' {
            return Token {
                kind: Kind::End,
                start: short(start),
                end: short(start),
            };
        }
        let kind = match first {
            b'"' => self.string(),
            b'\'' => self.bits(),
            b'.' if self
                .bytes
                .get(start + 1)
                .is_some_and(|&b| class(b) == DIGIT) =>
            {
                self.number()
            }
            byte if class(byte) == LETTER => self.name(),
            byte if class(byte) == DIGIT => self.number(),
            byte => {
                self.at += 1;
                Kind::Sign(byte)
            }
        };
        Token {
            kind,
            start: short(start),
            end: short(self.at),
        }
    }

    /// The next token, left where it is.
    pub(super) fn peek(&self) -> Token {
        let mut copy = *self;
        copy.next()
    }

    /// The line from a byte to another.
    pub(super) fn part(&self, at: usize, end: usize) -> Self {
        Self {
            bytes: self.bytes,
            at,
            end,
        }
    }

    /// Takes the next token where it is this sign.
    pub(super) fn take(&mut self, sign: u8) -> bool {
        let is = self.blanks() == sign;
        self.at += usize::from(is);
        is
    }

    fn name(&mut self) -> Kind {
        while self.at < self.end && class(self.bytes[self.at]) != 0 {
            self.at += 1;
        }
        Kind::Name
    }

    fn number(&mut self) -> Kind {
        while self.at < self.end {
            let byte = self.bytes[self.at];
            let exponent = matches!(byte, b'+' | b'-')
                && matches!(self.bytes[self.at - 1], b'e' | b'E')
                && self
                    .bytes
                    .get(self.at + 1)
                    .is_some_and(|&b| class(b) == DIGIT);
            if class(byte) == 0 && byte != b'.' && !exponent {
                break;
            }
            self.at += 1;
        }
        Kind::Number
    }

    fn string(&mut self) -> Kind {
        let rest = &self.bytes[self.at + 1..self.end];
        self.at = memchr::memchr(b'"', rest).map_or(self.end, |close| self.at + 2 + close);
        Kind::Text
    }

    fn bits(&mut self) -> Kind {
        let rest = &self.bytes[self.at + 1..self.end];
        let digits = rest
            .iter()
            .take_while(|b| b.is_ascii_alphanumeric() || **b == b' ')
            .count();
        if rest.get(digits) == Some(&b'\'') && digits > 0 {
            self.at += digits + 2;
            return Kind::Bits;
        }
        self.at += 1;
        Kind::Sign(b'\'')
    }

    /// Takes `[...]` where it stands here.
    ///
    /// # Errors
    /// Where it is not closed.
    pub(super) fn brackets(&mut self) -> Result<Option<(usize, usize)>, Fault> {
        if self.blanks() == b'[' {
            self.bracketed().map(Some)
        } else {
            Ok(None)
        }
    }

    fn bracketed(&mut self) -> Result<(usize, usize), Fault> {
        let open = self.at;
        let mut depth = 0_u32;
        loop {
            let token = self.next();
            match token.kind {
                Kind::Sign(b'[') => depth += 1,
                Kind::Sign(b']') if depth == 1 => {
                    return Ok((open + 1, token.start as usize));
                }
                Kind::Sign(b']') => depth -= 1,
                Kind::End => {
                    return Err(Fault::unclosed(open, "a bracket"));
                }
                _ => {}
            }
        }
    }
}

/// A word in capitals; empty where it is longer than any keyword.
pub(super) fn capitals<'b>(word: &[u8], buffer: &'b mut [u8; 24]) -> &'b [u8] {
    match buffer.get_mut(..word.len()) {
        Some(copy) => {
            // words are short: letter by letter is faster than a copy of any length
            for (to, from) in copy.iter_mut().zip(word) {
                *to = from.to_ascii_uppercase();
            }
            copy
        }
        None => &[],
    }
}

/// The value of `'B0101'`, `'HFF'` or `'B 0101'`.
pub(super) fn bits_value(text: &[u8]) -> Option<u32> {
    let inner = text.strip_prefix(b"'")?.strip_suffix(b"'")?;
    let (&kind, digits) = inner.trim_ascii_start().split_first()?;
    let radix = match kind.to_ascii_uppercase() {
        b'B' => 2,
        b'H' => 16,
        _ => return None,
    };
    u32::from_str_radix(std::str::from_utf8(digits).ok()?.trim(), radix).ok()
}

/// The lines of a file: first byte and the byte behind the last, line end not included. Empty ones
/// may be left out.
pub(super) fn lines(bytes: &[u8], start: usize) -> impl Iterator<Item = (usize, usize)> {
    let mut at = start;
    let mut ends = memchr::memchr2_iter(b'\n', b'\r', &bytes[start.min(bytes.len())..]);
    std::iter::from_fn(move || {
        if at >= bytes.len() {
            return None;
        }
        let end = ends.next().map_or(bytes.len(), |end| start + end);
        let line = (at, end);
        at = end + 1;
        Some(line)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_numbers_bits_and_strings_are_distinguished() {
        let text = b"LIN {X -1.5E-12,s'B010'} \"a;b\" $TOOL[1].x ; rest";
        let mut cursor = Cursor {
            bytes: text,
            at: 0,
            end: text.len(),
        };
        let mut found = Vec::new();
        loop {
            let token = cursor.next();
            if token.kind == Kind::End {
                break;
            }
            found.push(std::str::from_utf8(cursor.text(token)).expect("ASCII"));
        }
        let expected = [
            "LIN", "{", "X", "-", "1.5E-12", ",", "s", "'B010'", "}", "\"a;b\"", "$TOOL", "[", "1",
            "]", ".", "x",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn bit_literals_have_two_bases() {
        assert_eq!(bits_value(b"'B110000'"), Some(48));
        assert_eq!(bits_value(b"'h1F'"), Some(31));
        assert_eq!(bits_value(b"'B 010'"), Some(2));
        assert_eq!(bits_value(b"' H FF '"), Some(255));
        assert_eq!(bits_value(b"'B 0 1'"), None);
        assert_eq!(bits_value(b"'B2'"), None);
        assert_eq!(bits_value(b"'B'"), None);
    }
}
