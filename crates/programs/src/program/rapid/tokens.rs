//! RAPID text as tokens over bytes.
//!
//! A token is a kind and a span; nothing is decoded or copied. Bytes of 0x80 and above count as
//! letters, so Latin-1 and UTF-8 both pass. A line may end with LF, CR LF or CR.

pub(super) use crate::program::kit::Fault;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name or keyword.
    Name,
    /// Something that starts like a number, with everything that clings to it: `12`, `.5`, `9E+09`,
    /// `1.#QNAN`.
    Number,
    /// A string with its quotes.
    Text,
    /// `:=`
    Assign,
    /// Any other sign, one byte.
    Sign(u8),
    /// End of the file.
    End,
}

/// A token at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token {
    /// What it is.
    pub kind: Kind,
    /// Its first byte.
    pub start: u32,
    /// The byte after its last.
    pub end: u32,
}

impl Token {
    /// Whether it is this sign.
    pub(super) fn is(self, sign: u8) -> bool {
        self.kind == Kind::Sign(sign)
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Class {
    Blank,
    Letter,
    Digit,
    Quote,
    Remark,
    Other,
    Control,
}

#[allow(clippy::cast_possible_truncation)]
const CLASSES: [Class; 256] = {
    let mut classes = [Class::Other; 256];
    let mut byte = 0;
    while byte < 256 {
        classes[byte] = match byte as u8 {
            b' ' | b'\t' | b'\r' | b'\n' | 0x0b | 0x0c | 0x1a => Class::Blank,
            b'a'..=b'z' | b'A'..=b'Z' | b'_' | 0x80..=0xff => Class::Letter,
            b'0'..=b'9' => Class::Digit,
            b'"' => Class::Quote,
            b'!' => Class::Remark,
            0..0x20 | 0x7f => Class::Control,
            _ => Class::Other,
        };
        byte += 1;
    }
    classes
};

fn class(byte: u8) -> Class {
    CLASSES[byte as usize]
}

/// Reads tokens one after another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scanner<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Scanner<'a> {
    /// Starts at a byte.
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at }
    }

    /// The next token; blanks and comments are passed over.
    pub(super) fn next(&mut self) -> Result<Token, Fault> {
        let bytes = self.bytes;
        let mut at = self.at;
        let first = loop {
            let Some(&byte) = bytes.get(at) else {
                self.at = at;
                return Ok(self.token(Kind::End, at, at));
            };
            match class(byte) {
                Class::Blank => at += 1,
                Class::Remark => {
                    at = memchr::memchr2(b'\n', b'\r', &bytes[at..])
                        .map_or(bytes.len(), |length| at + length);
                }
                _ => break byte,
            }
        };
        let (kind, end) = match class(first) {
            Class::Letter => (Kind::Name, name_end(bytes, at)),
            Class::Digit => (Kind::Number, number_end(bytes, at)),
            Class::Quote => (Kind::Text, text_end(bytes, at)?),
            // files are smaller than 4 GiB
            #[allow(clippy::cast_possible_truncation)]
            Class::Control => return Err(Fault::Binary { at: at as u32 }),
            _ => match (first, bytes.get(at + 1)) {
                (b'.', Some(b'0'..=b'9')) => (Kind::Number, number_end(bytes, at)),
                (b':', Some(b'=')) => (Kind::Assign, at + 2),
                _ => (Kind::Sign(first), at + 1),
            },
        };
        self.at = end;
        Ok(self.token(kind, at, end))
    }

    #[allow(clippy::unused_self)]
    fn token(&self, kind: Kind, start: usize, end: usize) -> Token {
        // a source is never larger than a 32-bit offset: the reader checks it first
        #[allow(clippy::cast_possible_truncation)]
        Token {
            kind,
            start: start as u32,
            end: end as u32,
        }
    }
}

fn name_end(bytes: &[u8], start: usize) -> usize {
    let more = |b: &u8| matches!(class(*b), Class::Letter | Class::Digit);
    let rest = &bytes[start..];
    start + rest.iter().position(|b| !more(b)).unwrap_or(rest.len())
}

/// Digits, point, exponent, and what clings to them without a blank, so that `1.#QNAN` is one wrong
/// number.
fn number_end(bytes: &[u8], start: usize) -> usize {
    let mut at = start;
    while let Some(&byte) = bytes.get(at) {
        let part_of_it = match byte {
            b'0'..=b'9' | b'.' | b'#' => true,
            b'+' | b'-' => {
                matches!(bytes[at - 1], b'e' | b'E')
                    && at > start
                    && bytes[start..at - 1]
                        .iter()
                        .all(|b| matches!(b, b'0'..=b'9' | b'.'))
            }
            _ => class(byte) == Class::Letter,
        };
        if !part_of_it {
            break;
        }
        at += 1;
    }
    at
}

/// A string ends on its line; two quotes inside it are one.
fn text_end(bytes: &[u8], start: usize) -> Result<usize, Fault> {
    let unclosed = Fault::Unclosed {
        #[allow(clippy::cast_possible_truncation)]
        at: start as u32,
        what: "string",
    };
    let mut at = start + 1;
    loop {
        at += memchr::memchr3(b'"', b'\n', b'\r', &bytes[at..]).ok_or(unclosed)?;
        match (bytes[at], bytes.get(at + 1)) {
            (b'"', Some(b'"')) => at += 2,
            (b'"', _) => return Ok(at + 1),
            _ => return Err(unclosed),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<&str> {
        let mut scanner = Scanner::new(text.as_bytes(), 0);
        let mut all = Vec::new();
        loop {
            let token = scanner.next().expect("tokens");
            if token.kind == Kind::End {
                return all;
            }
            all.push(&text[token.start as usize..token.end as usize]);
        }
    }

    #[test]
    fn comments_end_with_their_line_whatever_ends_it() {
        assert_eq!(
            texts("a ! x\rb ! \"\nc ! [\r\nd ! last"),
            ["a", "b", "c", "d"]
        );
    }

    #[test]
    fn strings_hold_anything_but_a_line_end() {
        assert_eq!(
            texts(r#"TPWrite "say ""hi"" ! [";x"#),
            ["TPWrite", r#""say ""hi"" ! [""#, ";", "x"]
        );
        assert_eq!(
            Scanner::new(b"\"open\nx", 0).next(),
            Err(Fault::unclosed(0, "string"))
        );
    }

    #[test]
    fn numbers_keep_their_exponent_and_what_clings_to_them() {
        assert_eq!(
            texts("[9E+09,-1.5e-3,.5,1.#QNAN,3-2]"),
            [
                "[", "9E+09", ",", "-", "1.5e-3", ",", ".5", ",", "1.#QNAN", ",", "3", "-", "2",
                "]"
            ]
        );
        assert_eq!(texts("reg1:=2;l1:"), ["reg1", ":=", "2", ";", "l1", ":"]);
    }

    #[test]
    fn letters_beyond_ascii_belong_to_names() {
        let mut scanner = Scanner::new(b"GR\xd6SSE;", 0);
        assert_eq!(scanner.next().expect("a name").end, 6);
    }
}
