//! What conditions say of numbers, and counters of loops that they bound: `WHILE n<10`.

use super::super::quantity::{Quantity, is_letter};
use super::joins::{First, logic};
use super::rounds::growths;
use super::{Numbers, Site};

/// Where each round of a block begins, a number is to a limit as given.
#[derive(Debug)]
pub(super) struct Bound<W> {
    block: (u32, u32),
    number: u32,
    relation: Relation,
    limit: W,
}

impl<W> Numbers<W> {
    /// Each round of a block begins with a number that is to a limit as given.
    pub(in crate::program) fn bound(
        &mut self,
        block: (u32, u32),
        number: u32,
        (relation, limit): (Relation, W),
    ) {
        self.bounds.push(Bound {
            block,
            number,
            relation,
            limit,
        });
    }

    /// How often at most a number grows by a write in a loop whose condition bounds it, from these
    /// values on.
    pub(super) fn rounds_within(
        &self,
        number: u32,
        site: &Site,
        by: &Quantity,
        start: &[Quantity],
        limit: &mut dyn FnMut(&W) -> Quantity,
    ) -> Option<u32> {
        if self.jumping.contains(&site.routine) || self.runs_inside_itself(site.routine) {
            return None;
        }
        let by = by.exact()?;
        site.blocks.iter().enumerate().find_map(|(at, block)| {
            // so often in one round
            let each = site.blocks[at + 1..]
                .iter()
                .try_fold(1_u32, |each, inner| {
                    let is_bounded = !self.unbounded.contains(&(site.routine, inner.number));
                    Some(each.saturating_mul(inner.most.filter(|_| is_bounded)?))
                })?;
            let mut bounds = self.bounds.iter().filter(|bound| {
                bound.block == (site.routine, block.number)
                    && self.one(bound.number) == number
                    && (each == 1 || bound.relation != Relation::NotEqual)
            });
            let most = bounds
                .find_map(|bound| growths(bound.relation, start, by, &limit(&bound.limit)))?;
            Some(most.saturating_add(each - 1))
        })
    }
}

/// How what stands before a sign of comparison is to what stands behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) enum Relation {
    /// Below it, and never equal, or at most equal.
    Below {
        is_strict: bool,
    },
    /// Above it.
    Above {
        is_strict: bool,
    },
    Equal,
    NotEqual,
}

impl Relation {
    fn of(sign: &[u8]) -> Option<Self> {
        Some(match sign {
            b"<" => Self::Below { is_strict: true },
            b"<=" | b"=<" => Self::Below { is_strict: false },
            b">" => Self::Above { is_strict: true },
            b">=" | b"=>" => Self::Above { is_strict: false },
            b"=" | b"==" => Self::Equal,
            b"<>" | b"!=" => Self::NotEqual,
            _ => return None,
        })
    }

    /// What holds where it does not.
    #[must_use]
    pub(in crate::program) fn negated(self) -> Self {
        match self {
            Self::Below { is_strict } => Self::Above {
                is_strict: !is_strict,
            },
            Self::Above { is_strict } => Self::Below {
                is_strict: !is_strict,
            },
            Self::Equal => Self::NotEqual,
            Self::NotEqual => Self::Equal,
        }
    }

    /// With both sides exchanged.
    #[must_use]
    fn exchanged(self) -> Self {
        match self {
            Self::Below { is_strict } => Self::Above { is_strict },
            Self::Above { is_strict } => Self::Below { is_strict },
            same => same,
        }
    }
}

/// The comparisons of a condition that all are as they are here where it holds, or where it does not.
fn comparisons(condition: &[u8], holds: bool) -> Vec<(&[u8], Relation, &[u8])> {
    let parts = logic(condition, holds, First::Not);
    let compared = parts.conjuncts().into_iter().filter_map(|part| {
        let (before, relation, behind) = comparison(part.text)?;
        let relation = if part.holds {
            relation
        } else {
            relation.negated()
        };
        Some((before, relation, behind))
    });
    compared.collect()
}

/// Brackets around brackets that are looked into.
const DEEPEST: usize = 16;

/// A text without the brackets that stand around the whole of it.
pub(in crate::program) fn inside_brackets(mut text: &[u8]) -> &[u8] {
    for _ in 0..DEEPEST {
        text = text.trim_ascii();
        let inside = text.strip_prefix(b"(");
        let Some(inside) = inside.and_then(|text| text.strip_suffix(b")")) else {
            break;
        };
        let mut depth = 0_i32;
        let is_whole = inside.iter().all(|b| {
            depth += i32::from(*b == b'(') - i32::from(*b == b')');
            depth >= 0
        });
        if !is_whole {
            break;
        }
        text = inside;
    }
    text
}

pub(super) fn comparison(part: &[u8]) -> Option<(&[u8], Relation, &[u8])> {
    let part = inside_brackets(part);
    let is_sign = |b: &u8| matches!(b, b'<' | b'>' | b'=' | b'!');
    let at = part.iter().position(is_sign)?;
    let length = part[at..].iter().take_while(|b| is_sign(b)).count();
    let relation = Relation::of(&part[at..at + length])?;
    let [before, behind] = [&part[..at], &part[at + length..]].map(<[u8]>::trim_ascii);
    // brackets that do not stand around the whole
    let is_one = |text: &[u8]| {
        let count = |bracket| memchr::memchr_iter(bracket, text).count();
        !text.is_empty() && !text.iter().any(is_sign) && count(b'(') == count(b')')
    };
    (is_one(before) && is_one(behind)).then_some((before, relation, behind))
}

/// What a condition says of the one side of a comparison and the other, where it holds and (`false`) where
/// it does not.
pub(in crate::program) fn compared_in(
    condition: &[u8],
) -> impl Iterator<Item = (bool, &[u8], Relation, &[u8])> {
    [true, false].into_iter().flat_map(move |holds| {
        let all = comparisons(condition, holds).into_iter();
        all.flat_map(move |(before, relation, behind)| {
            [
                (holds, before, relation, behind),
                (holds, behind, relation.exchanged(), before),
            ]
        })
    })
}

/// What a condition says of names where it holds (`n<10`, `10>n`): the name, and how it is to the
/// other side.
pub(in crate::program) fn bounds_in(
    condition: &[u8],
) -> impl Iterator<Item = (&[u8], Relation, &[u8])> {
    let is_name = |text: &[u8]| text.iter().all(|b| is_letter(*b)) && !text[0].is_ascii_digit();
    compared_in(condition)
        .filter(move |(holds, side, ..)| *holds && is_name(side))
        .map(|(_, side, relation, limit)| (side, relation, limit))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(of: &[u8]) -> String {
        String::from_utf8_lossy(of).into_owned()
    }

    #[test]
    fn conditions_bound_names() {
        let below = |is_strict| Relation::Below { is_strict };
        let above = |is_strict| Relation::Above { is_strict };
        for (condition, wanted) in [
            (" n<10 ", &[("n", below(true), "10")][..]),
            ("(n <= 2*m) and di1", &[("n", below(false), "2*m")]),
            (
                "0<n AND m>-5",
                &[("n", above(true), "0"), ("m", above(true), "-5")],
            ),
            ("n<>10", &[("n", Relation::NotEqual, "10")]),
            ("n<m", &[("n", below(true), "m"), ("m", above(true), "n")]),
            ("n<10 OR x", &[]),
            ("NOT n<10", &[]),
            ("NOT (n<10)", &[("n", above(false), "10")]),
            ("NOT n<10 AND m<1", &[]),
            ("n<10 AND m<1 OR di1", &[]),
            ("n<10 AND (m<1 OR di1)", &[("n", below(true), "10")]),
            ("!(di1 AND n<10 AND di2)", &[]),
            ("TRUE", &[]),
            ("(n<10", &[]),
            (
                "((n<10) and (m>1))",
                &[("n", below(true), "10"), ("m", above(true), "1")],
            ),
            ("(n)<(m)", &[]),
            ("f(n)<10", &[]),
        ] {
            let found: Vec<_> = bounds_in(condition.as_bytes())
                .map(|(name, relation, limit)| (text(name), relation, text(limit)))
                .collect();
            let wanted: Vec<_> = wanted
                .iter()
                .map(|&(name, relation, limit)| (name.to_owned(), relation, limit.to_owned()))
                .collect();
            assert_eq!(found, wanted, "{condition}");
        }
    }

    #[test]
    fn what_does_not_hold_is_the_contrary_of_each_alternative() {
        let all = comparisons(b"n>=4 or m=2 or di1", false);
        let [first, second] = all[..] else {
            panic!("{all:?}");
        };
        assert_eq!((first.0, first.2), (&b"n"[..], &b"4"[..]));
        assert_eq!(first.1, Relation::Below { is_strict: true });
        assert_eq!(second.1, Relation::NotEqual);
        assert_eq!(comparisons(b"n>=4 and m=2", false), []);
    }
}
