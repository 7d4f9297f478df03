//! The words of a line.

use crate::program::number;

/// What a word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A keyword or a name, with its dots.
    Name,
    Number,
    Text,
    Sign(u8),
}

/// A word, with its place in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'a> {
    pub kind: Kind,
    pub text: &'a [u8],
    pub start: usize,
}

impl Word<'_> {
    pub(super) fn end(&self) -> usize {
        self.start + self.text.len()
    }

    pub(super) fn is(&self, sign: u8) -> bool {
        self.kind == Kind::Sign(sign)
    }

    /// Whether it is this keyword, in any case.
    pub(super) fn is_word(&self, word: &[u8]) -> bool {
        self.kind == Kind::Name && self.text.eq_ignore_ascii_case(word)
    }
}

/// Puts the words of a line into `found`, up to a comment; the line begins at a byte of the file.
pub(super) fn words<'a>(line: &'a [u8], start: usize, found: &mut Vec<Word<'a>>) {
    found.clear();
    let mut at = 0;
    while let Some(&byte) = line.get(at) {
        let rest = &line[at..];
        let in_name =
            |b: &&u8| matches!(b, b'_' | b'.' | b'$' | 0x80..) || b.is_ascii_alphanumeric();
        let (kind, length) = match byte {
            b';' => return,
            b' ' | b'\t' | 0x1a => {
                at += 1;
                continue;
            }
            b'"' => {
                let close = memchr::memchr(b'"', &rest[1..]);
                (Kind::Text, close.map_or(rest.len(), |close| close + 2))
            }
            b'0'..=b'9' | b'.' if number_length(rest) > 0 => (Kind::Number, number_length(rest)),
            b'_' | b'.' | b'$' | 0x80.. => (Kind::Name, rest.iter().take_while(in_name).count()),
            _ if byte.is_ascii_alphanumeric() => {
                (Kind::Name, rest.iter().take_while(in_name).count())
            }
            _ => (Kind::Sign(byte), 1),
        };
        found.push(Word {
            kind,
            text: &rest[..length],
            start: start + at,
        });
        at += length;
    }
}

/// The bytes of the number that a text begins with; 0 where a name or nothing stands there.
fn number_length(text: &[u8]) -> usize {
    let digits = |from: usize| {
        let digits = text[from..].iter().take_while(|b| b.is_ascii_digit());
        from + digits.count()
    };
    let mut end = digits(0);
    let whole = end;
    if text.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if whole == 0 && end <= 1 {
        return 0;
    }
    if matches!(text.get(end), Some(b'e' | b'E')) {
        let signed = usize::from(matches!(text.get(end + 1), Some(b'+' | b'-')));
        let power = digits(end + 1 + signed);
        if power > end + 1 + signed {
            end = power;
        }
    }
    let goes_on = text.get(end);
    let is_name = goes_on.is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_');
    if is_name { 0 } else { end }
}

/// Some words of a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<'a, 'w>(pub &'w [Word<'a>]);

impl Part<'_, '_> {
    pub(super) fn is(&self, at: usize, sign: u8) -> bool {
        self.0.get(at).is_some_and(|word| word.is(sign))
    }

    pub(super) fn is_word(&self, at: usize, word: &[u8]) -> bool {
        self.0.get(at).is_some_and(|known| known.is_word(word))
    }

    pub(super) fn behind(&self, at: usize) -> Self {
        Self(self.0.get(at..).unwrap_or_default())
    }

    /// First byte, and behind the last.
    pub(super) fn bytes(&self) -> Option<(usize, usize)> {
        Some((self.0.first()?.start, self.0.last()?.end()))
    }

    /// The number that these words are, with its sign.
    pub(super) fn number(&self) -> Option<f64> {
        let of = |word: &Word| number::parse(word.text).filter(|_| word.kind == Kind::Number);
        match self.0 {
            [one] => of(one),
            [sign, one] if sign.is(b'-') => of(one).map(|value| -value),
            [sign, one] if sign.is(b'+') => of(one),
            _ => None,
        }
    }

    /// The word that closes the bracket at one; behind the last where none does.
    pub(super) fn closing(&self, open: usize) -> usize {
        let mut depth = 0_usize;
        for (at, word) in self.0.iter().enumerate().skip(open) {
            match word.kind {
                Kind::Sign(b'(' | b'[') => depth += 1,
                Kind::Sign(b')' | b']') => {
                    depth = depth.saturating_sub(1);
                    if depth == 0 {
                        return at;
                    }
                }
                _ => {}
            }
        }
        self.0.len()
    }

    /// What stands between commas outside brackets.
    pub(super) fn list(&self) -> Vec<Self> {
        let (mut parts, mut start, mut at) = (Vec::new(), 0, 0);
        while at < self.0.len() {
            match self.0[at].kind {
                Kind::Sign(b',') => {
                    parts.push(Self(&self.0[start..at]));
                    start = at + 1;
                }
                Kind::Sign(b'(' | b'[') => at = self.closing(at),
                _ => {}
            }
            at += 1;
        }
        if !self.0.is_empty() {
            parts.push(Self(&self.0[start.min(self.0.len())..]));
        }
        parts
    }

    /// What stands in the bracket at a word, and the number of words with it.
    pub(super) fn inside(&self, open: usize) -> (Self, usize) {
        let close = self.closing(open);
        let inside = Self(&self.0[(open + 1).min(close)..close]);
        (inside, (close + 1).min(self.0.len()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_dots_and_numbers_have_not_letters() {
        let mut found = Vec::new();
        words(
            b"LMOVE .p[1]+TRANS(-1.5,.25,1e3) 100MM 2nd \"a;b\" ;c",
            0,
            &mut found,
        );
        let texts: Vec<_> = found.iter().map(|w| Source(w.text)).collect();
        assert_eq!(
            texts.iter().map(Source::text).collect::<Vec<_>>(),
            [
                "LMOVE", ".p", "[", "1", "]", "+", "TRANS", "(", "-", "1.5", ",", ".25", ",",
                "1e3", ")", "100MM", "2nd", "\"a;b\""
            ]
        );
        assert_eq!(Part(&found[8..10]).number(), Some(-1.5));
        assert_eq!(Part(&found[11..12]).number(), Some(0.25));
    }

    struct Source<'a>(&'a [u8]);

    impl<'a> Source<'a> {
        fn text(&self) -> &'a str {
            std::str::from_utf8(self.0).expect("ASCII")
        }
    }
}
