//! Words of statements: names, numbers, texts and signs, and lists of them in brackets.

use super::numbers::{First, logic};
use super::script::{Logic, Wanted, short};
use super::{Number, number};
use std::ops::Range;

/// Whole numbers are below this, so that each has its own value.
const MOST_WHOLE: f64 = 1e15;

/// What a word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A keyword or a name.
    Name,
    Number,
    /// A text, with its quotes.
    Text,
    /// A sign; of `==`, `<=` and the like the whole, as `~`.
    Sign(u8),
}

/// A word, and where it stands in its file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word {
    pub kind: Kind,
    start: u32,
    end: u32,
}

/// How a language writes words.
#[derive(Debug)]
pub(super) struct Spelling {
    /// What a comment begins with, which ends with its line.
    pub comment: &'static [u8],
    /// The bytes of names: see [`in_names`].
    pub in_names: [bool; 256],
    /// A backslash in a text takes the next sign with it.
    pub has_escapes: bool,
    /// Quotes and signs are entities of XML.
    pub has_entities: bool,
}

/// Letters, digits, bytes of 0x80 and above, and these signs.
pub(super) const fn in_names(signs: &[u8]) -> [bool; 256] {
    let mut found = [false; 256];
    let mut byte = u8::MIN;
    loop {
        found[byte as usize] = byte >= 0x80 || byte.is_ascii_alphanumeric();
        if byte == u8::MAX {
            break;
        }
        byte += 1;
    }
    let mut at = 0;
    while at < signs.len() {
        found[signs[at] as usize] = true;
        at += 1;
    }
    found
}

/// Entities, and the signs that they are.
const ENTITIES: [(&[u8], u8); 5] = [
    (b"&quot;", b'"'),
    (b"&lt;", b'<'),
    (b"&gt;", b'>'),
    (b"&amp;", b'&'),
    (b"&apos;", b'\''),
];

impl Spelling {
    /// Adds the words of a line, or of what is left of one; nothing is added of a comment.
    pub(super) fn add(&self, bytes: &[u8], line: Range<usize>, found: &mut Vec<Word>) {
        let mut at = line.start;
        let bytes = &bytes[..line.end];
        while let Some(&byte) = bytes.get(at) {
            let rest = &bytes[at..];
            if matches!(byte, b' ' | b'\t' | b'\r' | b'\n' | 0x0b | 0x0c | 0x1a) {
                at += 1;
                continue;
            }
            if byte == self.comment[0] && rest.starts_with(self.comment) {
                return;
            }
            let number = match byte {
                b'0'..=b'9' | b'.' => number_length(rest),
                _ => 0,
            };
            let (kind, length) = if number > 0 {
                (Kind::Number, number)
            } else if self.in_names[usize::from(byte)] {
                let is_other = |byte: &u8| !self.in_names[usize::from(*byte)];
                let other = rest.iter().position(is_other);
                (Kind::Name, other.unwrap_or(rest.len()))
            } else {
                let (sign, width) = self.sign(rest);
                match sign {
                    b'"' => (Kind::Text, self.text_length(rest, width)),
                    b'=' | b'!' | b'<' | b'>' if rest.get(width) == Some(&b'=') => {
                        (Kind::Sign(b'~'), width + 1)
                    }
                    _ => (Kind::Sign(sign), width),
                }
            };
            found.push(Word {
                kind,
                start: short(at),
                end: short(at + length),
            });
            at += length;
        }
    }

    /// The sign that a text begins with, and its bytes.
    fn sign(&self, text: &[u8]) -> (u8, usize) {
        let is_entity = self.has_entities && text[0] == b'&';
        let known = ENTITIES.iter().filter(|_| is_entity);
        let found = known.into_iter().find(|(name, _)| text.starts_with(name));
        found.map_or((text[0], 1), |(name, sign)| (*sign, name.len()))
    }

    /// The bytes of a text whose first quote is that wide; one that is not closed ends with its
    /// line.
    fn text_length(&self, text: &[u8], quote: usize) -> usize {
        let mut at = quote;
        while at < text.len() {
            let (sign, width) = self.sign(&text[at..]);
            at += width;
            match sign {
                b'"' => return at,
                b'\\' if self.has_escapes && at < text.len() => at += self.sign(&text[at..]).1,
                _ => {}
            }
        }
        text.len()
    }
}

/// The bytes of the number that a text begins with; 0 where a name or nothing stands there.
fn number_length(text: &[u8]) -> usize {
    let digits = |from: usize| {
        let digits = text[from..].iter().take_while(|b| b.is_ascii_digit());
        from + digits.count()
    };
    let whole = digits(0);
    let mut end = whole;
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

/// Some words of a statement, with the bytes of its file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Words<'a, 'w> {
    pub bytes: &'a [u8],
    pub all: &'w [Word],
}

impl<'a, 'w> Words<'a, 'w> {
    /// Those in a part of its bytes.
    pub(super) fn within(&self, part: &[u8]) -> Words<'a, 'w> {
        let start = part.as_ptr() as usize - self.bytes.as_ptr() as usize;
        let end = start + part.len();
        let first = self
            .all
            .partition_point(|word| (word.start as usize) < start);
        let last = self.all.partition_point(|word| (word.end as usize) <= end);
        Words {
            bytes: self.bytes,
            all: self.all.get(first..last).unwrap_or_default(),
        }
    }
}

impl<'a> Words<'a, '_> {
    pub(super) fn len(&self) -> usize {
        self.all.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// The bytes of a word; none behind the last.
    pub(super) fn text(&self, at: usize) -> &'a [u8] {
        self.all.get(at).map_or(b"", |word| {
            &self.bytes[word.start as usize..word.end as usize]
        })
    }

    pub(super) fn kind(&self, at: usize) -> Option<Kind> {
        self.all.get(at).map(|word| word.kind)
    }

    pub(super) fn is(&self, at: usize, sign: u8) -> bool {
        self.kind(at) == Some(Kind::Sign(sign))
    }

    pub(super) fn is_name(&self, at: usize) -> bool {
        self.kind(at) == Some(Kind::Name)
    }

    /// Whether a word is this keyword, in any case.
    pub(super) fn is_word(&self, at: usize, word: &[u8]) -> bool {
        self.is_name(at) && self.text(at).eq_ignore_ascii_case(word)
    }

    /// Where a keyword stands, in any case.
    pub(super) fn find(&self, word: &[u8]) -> Option<usize> {
        (0..self.len()).find(|at| self.is_word(*at, word))
    }

    pub(super) fn part(&self, range: Range<usize>) -> Self {
        Self {
            all: &self.all[range],
            ..*self
        }
    }

    /// What stands before a sign; all where there is none.
    pub(super) fn before(&self, sign: u8) -> Self {
        let at = (0..self.len()).find(|at| self.is(*at, sign));
        self.part(0..at.unwrap_or(self.len()))
    }

    /// Those before a keyword; all where it is not there.
    pub(super) fn before_word(&self, word: &[u8]) -> Self {
        self.part(0..self.find(word).unwrap_or(self.len()))
    }

    pub(super) fn behind(&self, at: usize) -> Self {
        self.part(at.min(self.len())..self.len())
    }

    /// First byte, and behind the last; nothing where there are no words.
    pub(super) fn span(&self) -> Range<usize> {
        match (self.all.first(), self.all.last()) {
            (Some(first), Some(last)) => first.start as usize..last.end as usize,
            _ => 0..0,
        }
    }

    /// All from the first byte to the last.
    pub(super) fn whole(&self) -> &'a [u8] {
        &self.bytes[self.span()]
    }

    /// Whether these words are a number with its sign, and whether that is a minus.
    fn is_number(&self) -> Option<bool> {
        let is_negative = self.is(0, b'-');
        let signs = usize::from(is_negative || self.is(0, b'+'));
        let is_number = self.len() == signs + 1 && self.kind(signs) == Some(Kind::Number);
        is_number.then_some(is_negative)
    }

    /// Whether these words are one number, however large.
    pub(super) fn is_numeral(&self) -> bool {
        self.is_number().is_some()
    }

    /// The value of the number that these words are, with its sign.
    pub(super) fn value(&self) -> Option<f64> {
        let is_negative = self.is_number()?;
        let value = number::parse(self.text(self.len() - 1))?;
        Some(if is_negative { -value } else { value })
    }

    /// The whole number that these words are, with its sign.
    pub(super) fn whole_number(&self) -> Option<i64> {
        let value = self.value()?;
        #[allow(clippy::cast_possible_truncation)]
        let whole = value as i64;
        (value.fract() == 0.0 && value.abs() < MOST_WHOLE).then_some(whole)
    }

    /// The whole numbers that a list is; none where anything else is in it.
    pub(super) fn whole_numbers(&self) -> Vec<i64> {
        let all = self.list().into_iter().map(|part| part.whole_number());
        all.collect::<Option<_>>().unwrap_or_default()
    }

    /// What the parts of a condition compare with a whole number, `n==1 AND (m<>1)`, and what that is
    /// to be.
    pub(super) fn compared(&self) -> Logic<Option<(Self, Wanted)>> {
        let whole = self.whole();
        let first = self.span().start;
        logic(whole, true, First::Not).map(&mut |part| {
            let start = first + (part.text.as_ptr() as usize - whole.as_ptr() as usize);
            let end = start + part.text.len();
            self.between(start..end).comparison(part.holds)
        })
    }

    /// The words between these bytes.
    fn between(&self, bytes: Range<usize>) -> Self {
        let before = |end: usize| self.all.partition_point(|word| (word.start as usize) < end);
        self.part(before(bytes.start)..before(bytes.end))
    }

    fn comparison(&self, holds: bool) -> Option<(Self, Wanted)> {
        let is_sign = |at: &usize| matches!(self.kind(*at), Some(Kind::Sign(b'~' | b'<')));
        let at = (0..self.len()).find(is_sign)?;
        let (is_equal, behind) = match self.text(at) {
            b"==" => (true, at + 1),
            b"!=" => (false, at + 1),
            _ if self.is(at, b'<') && self.is(at + 1, b'>') => (false, at + 2),
            _ => return None,
        };
        let number = self.behind(behind).whole_number()?;
        let wanted = if is_equal == holds {
            Wanted::Number(number)
        } else {
            Wanted::NotNumber(number)
        };
        Some((self.part(0..at), wanted))
    }

    /// The number that these words are; `None` also where blanks stand behind its sign.
    pub(super) fn number(&self) -> Option<Number> {
        self.is_number()?;
        number::placed(self.whole(), self.span().start)
    }

    /// The word that closes the bracket at one; behind the last where none does.
    pub(super) fn closing(&self, open: usize) -> usize {
        let mut depth = 0_usize;
        for (at, word) in self.all.iter().enumerate().skip(open) {
            match word.kind {
                Kind::Sign(b'(' | b'[' | b'{') => depth += 1,
                Kind::Sign(b')' | b']' | b'}') => {
                    depth = depth.saturating_sub(1);
                    if depth == 0 {
                        return at;
                    }
                }
                _ => {}
            }
        }
        self.len()
    }

    /// What stands in the bracket at a word, and the number of words from there with it.
    pub(super) fn inside(&self, open: usize) -> (Self, usize) {
        let close = self.closing(open);
        let inside = self.part((open + 1).min(close)..close);
        (inside, (close + 1).min(self.len()) - open)
    }

    /// What stands between certain signs outside brackets, each part with the sign before it; `-`
    /// and the like in front of a part belong to it.
    fn each_part(&self, parts: impl Fn(u8) -> bool, mut each: impl FnMut(u8, Self)) {
        let (mut start, mut before, mut at) = (0, 0, 0);
        while at < self.len() {
            match self.all[at].kind {
                Kind::Sign(b'(' | b'[' | b'{') => at = self.closing(at),
                Kind::Sign(sign) if parts(sign) && (sign == b',' || at > start) => {
                    each(before, self.part(start..at));
                    (start, before) = (at + 1, sign);
                }
                _ => {}
            }
            at += 1;
        }
        if !self.is_empty() {
            each(before, self.behind(start));
        }
    }

    /// What is added and subtracted outside brackets, each part with the sign before it.
    pub(super) fn terms(&self) -> Vec<(u8, Self)> {
        let mut found = Vec::new();
        let is_sign = |sign| matches!(sign, b'+' | b'-');
        self.each_part(is_sign, |before, part| found.push((before, part)));
        found
    }

    /// What is multiplied outside brackets.
    pub(super) fn factors(&self) -> Vec<Self> {
        let mut found = Vec::new();
        self.each_part(|sign| sign == b'*', |_, part| found.push(part));
        found
    }

    /// What stands between commas outside brackets.
    pub(super) fn list(&self) -> Vec<Self> {
        // a pose, joints: most lists
        let mut found = Vec::with_capacity(6);
        self.each_part(|sign| sign == b',', |_, part| found.push(part));
        found
    }

    /// The list in the bracket at a word where that is the rest of these words.
    pub(super) fn rest_list(&self, open: usize) -> Option<Vec<Self>> {
        let is_rest = self.closing(open) + 1 == self.len();
        is_rest.then(|| self.inside(open).0.list())
    }
}

/// A text without its quotes.
pub(super) fn unquoted(text: &[u8]) -> &[u8] {
    let text = text.strip_prefix(b"&quot;").unwrap_or(text);
    let text = text.strip_suffix(b"&quot;").unwrap_or(text);
    let text = text.strip_prefix(b"\"").unwrap_or(text);
    text.strip_suffix(b"\"").unwrap_or(text)
}

/// The six numbers that a list is.
pub(super) fn six(list: &[Words]) -> Option<[Number; 6]> {
    if list.len() != 6 {
        return None;
    }
    let numbers: [Option<Number>; 6] = std::array::from_fn(|at| list[at].number());
    let [Some(a), Some(b), Some(c), Some(d), Some(e), Some(f)] = numbers else {
        return None;
    };
    Some([a, b, c, d, e, f])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Source;

    const DOTTED: Spelling = Spelling {
        comment: b";",
        in_names: in_names(b"_.$"),
        has_escapes: false,
        has_entities: false,
    };

    fn with_words(text: &str, check: impl Fn(Words)) {
        let mut found = Vec::new();
        DOTTED.add(text.as_bytes(), 0..text.len(), &mut found);
        check(Words {
            bytes: text.as_bytes(),
            all: &found,
        });
    }

    #[test]
    fn names_have_dots_and_numbers_have_no_letters() {
        let text = "LMOVE .p[1]+TRANS(-1.5,.25,1e3) 100MM 2nd \"a;b\" >= ;c";
        with_words(text, |words| {
            let texts: Vec<_> = (0..words.len())
                .map(|at| Source::text(words.text(at)))
                .collect();
            assert_eq!(
                texts,
                [
                    "LMOVE", ".p", "[", "1", "]", "+", "TRANS", "(", "-", "1.5", ",", ".25", ",",
                    "1e3", ")", "100MM", "2nd", "\"a;b\"", ">="
                ]
            );
            assert_eq!(words.part(8..10).value(), Some(-1.5));
            let number = words.part(8..10).number().expect("a number");
            assert_eq!((number.start, number.length), (18, 4));
            assert!(words.is(18, b'~'));
        });
    }

    #[test]
    fn comparisons_are_of_all_words_with_one_number() {
        for (text, expected) in [
            (".n==2", Some((".n", Wanted::Number(2)))),
            ("(n <> -1)", Some(("n", Wanted::NotNumber(-1)))),
            ("n!=1.0", Some(("n", Wanted::NotNumber(1)))),
            ("NOT (n==1)", Some(("n", Wanted::NotNumber(1)))),
            ("NOT n==1", Some(("NOT n", Wanted::Number(1)))),
            ("n==1.5", None),
            ("n<1", None),
            ("n>=1", None),
            ("n==m", None),
        ] {
            with_words(text, |words| {
                let compared = words.compared();
                let [found] = compared.parts()[..] else {
                    panic!("{text}: {compared:?}");
                };
                let found = found.map(|(name, wanted)| (name.whole().to_vec(), wanted));
                let expected = expected.map(|(name, wanted)| (name.as_bytes().to_vec(), wanted));
                assert_eq!(found, expected, "{text}");
            });
        }
    }

    #[test]
    fn comparisons_that_words_join_are_each_one() {
        with_words(" ( .n==2 AND (m<>1 OR x) )", |words| {
            let named = words
                .compared()
                .map(&mut |of| of.map(|(name, wanted)| (name.whole().to_vec(), wanted)));
            let one = |name: &[u8], wanted| Logic::One(Some((name.to_vec(), wanted)));
            let either = Logic::Any(vec![one(b"m", Wanted::NotNumber(1)), Logic::One(None)]);
            let all = Logic::All(vec![one(b".n", Wanted::Number(2)), either]);
            assert_eq!(named, all);
        });
    }

    #[test]
    fn lists_are_split_outside_brackets() {
        with_words("f(a,(b,c),,- 5,)", |words| {
            let list = words.rest_list(1).expect("the bracket is the rest");
            let texts: Vec<_> = list.iter().map(|part| Source::text(part.whole())).collect();
            assert_eq!(texts, ["a", "(b,c)", "", "- 5", ""]);
            assert_eq!(list[3].value(), Some(-5.0));
            assert_eq!(list[3].number(), None, "no number of a file has blanks");
        });
        with_words("-a+b-(c+d)", |words| {
            let terms = words.terms();
            let of = |(sign, part): &(u8, Words)| (*sign, part.whole().to_vec());
            let terms: Vec<_> = terms.iter().map(of).collect();
            let expected: [(u8, &[u8]); 3] = [(0, b"-a"), (b'+', b"b"), (b'-', b"(c+d)")];
            assert_eq!(terms, expected.map(|(sign, text)| (sign, text.to_vec())));
        });
        with_words("f(a) b", |words| assert!(words.rest_list(1).is_none()));
        with_words("f(a", |words| assert!(words.rest_list(1).is_none()));
    }
}
