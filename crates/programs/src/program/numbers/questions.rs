//! What conditions ask of names, and the values that branches tell apart: `n==1`, `(tool<>#A) AND b`,
//! `NOT b`.

use super::super::quantity::is_letter;
use super::bounds::{Relation, comparison};
use super::joins::{First, Part, logic};
use crate::program::script::{Held, Logic, Wanted};

/// A value that branches tell from others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) enum Literal {
    Flag(bool),
    Number(i64),
}

impl Literal {
    /// TRUE or FALSE, in whatever case.
    pub(in crate::program) fn flag(text: &[u8]) -> Option<Self> {
        let is = |word: &[u8]| text.eq_ignore_ascii_case(word);
        (is(b"TRUE") || is(b"FALSE")).then(|| Self::Flag(is(b"TRUE")))
    }

    /// A whole number whose size is at most that of the language's type.
    pub(in crate::program) fn whole(value: f64, most: u32) -> Option<Self> {
        let is_whole = value.fract() == 0.0 && value.abs() <= f64::from(most);
        #[allow(clippy::cast_possible_truncation)]
        is_whole.then_some(Self::Number(value as i64))
    }

    pub(in crate::program) fn held(self) -> Held {
        match self {
            Self::Flag(flag) => Held::Flag(flag),
            Self::Number(number) => Held::Number(number),
        }
    }

    pub(in crate::program) fn number(self) -> Option<i64> {
        match self {
            Self::Flag(_) => None,
            Self::Number(number) => Some(number),
        }
    }
}

/// The numbers of a CASE, between commas; none where any of them is no number of the text.
pub(in crate::program) fn cases(
    text: &[u8],
    literal: &mut dyn FnMut(&[u8]) -> Option<Literal>,
) -> Vec<i64> {
    let parts = text.split(|b| *b == b',');
    let numbers = parts.map(|part| literal(part.trim_ascii()).and_then(Literal::number));
    numbers.collect::<Option<_>>().unwrap_or_default()
}

/// What a condition asks of one name: `n==1`, `(tool<>#A)`, `NOT b`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) struct Question<'a> {
    pub name: &'a [u8],
    /// With what it is compared; it is a flag where it stands alone.
    pub of: Option<&'a [u8]>,
    /// Whether it is to be that, or anything else.
    pub holds: bool,
}

/// What the parts of a condition ask that are about one name.
pub(in crate::program) fn questions(condition: &[u8], first: First) -> Logic<Option<Question<'_>>> {
    logic(condition, true, first).map(&mut |part| question(*part))
}

fn question(Part { text, holds }: Part<'_>) -> Option<Question<'_>> {
    let is_name = |text: &[u8]| {
        text.iter().all(|b| is_letter(*b)) && text.first().is_some_and(|b| !b.is_ascii_digit())
    };
    if is_name(text) {
        return Some(Question {
            name: text,
            of: None,
            holds,
        });
    }
    let (before, behind, is_equal) = equality(text)?;
    let (name, of) = if is_name(before) && Literal::flag(before).is_none() {
        (before, behind)
    } else {
        (behind, before)
    };
    // what stands between the words of two comparisons is none
    let is_one = |text: &[u8]| !text.iter().any(u8::is_ascii_whitespace);
    (is_name(name) && is_one(of)).then_some(Question {
        name,
        of: Some(of),
        holds: holds == is_equal,
    })
}

/// The names that a condition asks about.
pub(in crate::program) fn names_asked(condition: &[u8]) -> Vec<&[u8]> {
    let questions = questions(condition, First::Comparisons);
    let asked = questions.parts().into_iter().flatten();
    asked.map(|question| question.name).collect()
}

impl Question<'_> {
    /// What its name is to hold, where `literal` tells what it is compared with.
    pub(in crate::program) fn wanted(
        &self,
        literal: impl FnOnce(&[u8]) -> Option<Literal>,
    ) -> Option<Wanted> {
        Some(match self.of.map_or(Some(Literal::Flag(true)), literal)? {
            Literal::Flag(flag) => Wanted::Flag(flag == self.holds),
            Literal::Number(number) if self.holds => Wanted::Number(number),
            Literal::Number(number) => Wanted::NotNumber(number),
        })
    }
}

/// The sides of a condition that is one comparison, of equal (true) or not equal.
pub(in crate::program) fn equality(condition: &[u8]) -> Option<(&[u8], &[u8], bool)> {
    let (before, relation, behind) = comparison(condition)?;
    match relation {
        Relation::Equal => Some((before, behind, true)),
        Relation::NotEqual => Some((before, behind, false)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(of: &[u8]) -> String {
        String::from_utf8_lossy(of).into_owned()
    }

    #[test]
    fn conditions_ask_of_one_name() {
        for (condition, wanted) in [
            ("n==1", Some(("n", "1", true))),
            (" ( tool <> #Cutter ) ", Some(("tool", "#Cutter", false))),
            ("#Cutter==tool", Some(("tool", "#Cutter", true))),
            ("b", Some(("b", "", true))),
            ("NOT(b)", Some(("b", "", false))),
            ("NOT b==FALSE", Some(("b", "FALSE", false))),
            ("TRUE==b", Some(("b", "TRUE", true))),
            ("NOT NOT n==2", Some(("n", "2", true))),
            ("notice", Some(("notice", "", true))),
            ("n<1", None),
            ("NOT b AND n==1", None),
            ("b==TRUE AND n==1", None),
            ("a b", None),
            ("f(n)==1", None),
            ("n[1]==1", None),
            ("", None),
            ("NOT", Some(("NOT", "", true))),
        ] {
            let asked = questions(condition.as_bytes(), First::Comparisons);
            let [found] = asked.parts()[..] else {
                panic!("{condition}: {asked:?}");
            };
            let found = found
                .as_ref()
                .map(|of| (text(of.name), text(of.of.unwrap_or_default()), of.holds));
            let wanted = wanted.map(|(name, of, holds)| (name.to_owned(), of.to_owned(), holds));
            assert_eq!(found, wanted, "{condition}");
        }
    }
}
