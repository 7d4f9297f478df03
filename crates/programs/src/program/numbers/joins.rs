//! What AND, OR and NOT make of the parts of a condition.

use super::super::quantity::is_letter;
use super::bounds::{comparison, inside_brackets};
use super::questions::Literal;
use super::word;
use crate::program::script::Logic;

/// Brackets in brackets that are looked into.
const DEEPEST: u32 = 16;

/// A part of a condition that nothing joins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) struct Part<'a> {
    pub text: &'a [u8],
    /// Whether it is to hold, or not.
    pub holds: bool,
}

/// What a language does first where no brackets tell: `b AND NOT n==1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) enum First {
    /// It compares.
    Comparisons,
    /// It may take the contrary of what stands behind NOT, then it compares.
    Not,
    /// It joins.
    Joins,
}

/// The parts of a condition where it holds, or (`false`) where it does not.
///
/// Languages differ in what AND, OR, NOT and comparisons bind first. Where that matters and no
/// brackets tell, it is one part.
pub(in crate::program) fn logic(condition: &[u8], holds: bool, first: First) -> Logic<Part<'_>> {
    within(condition, holds, first, DEEPEST)
}

fn within(condition: &[u8], holds: bool, first: First, depth: u32) -> Logic<Part<'_>> {
    let text = inside_brackets(condition);
    let one = Logic::One(Part { text, holds });
    let (Some(depth), Some((parts, joined))) = (depth.checked_sub(1), split(text)) else {
        return one;
    };
    let Some(by_and) = joined else {
        let is_clear = |rest: &&[u8]| {
            first != First::Not || comparison(rest).is_none() || is_in_brackets(rest)
        };
        return match behind_not(text).filter(is_clear) {
            Some(rest) => within(rest, !holds, first, depth),
            None => one,
        };
    };
    let (last, others) = parts.split_last().expect("two parts at least");
    let is_clear = |part: &&[u8]| {
        comparison(part).is_none_or(|(before, _, behind)| {
            is_in_brackets(part)
                || first != First::Joins
                    && Literal::flag(before)
                        .or_else(|| Literal::flag(behind))
                        .is_none()
        })
    };
    // NOT may reach over what follows
    let is_over = by_and
        && others
            .iter()
            .any(|part| behind_not(part.trim_ascii()).is_some());
    if is_over || !others.iter().chain([last]).all(is_clear) {
        return one;
    }
    let all = parts
        .iter()
        .map(|part| within(part, holds, first, depth))
        .collect();
    if by_and == holds {
        Logic::All(all)
    } else {
        Logic::Any(all)
    }
}

/// The parts between the joins outside brackets and texts, and whether AND (true) or OR joins them;
/// `None` for that where nothing does. `None` where both do, or something else.
fn split(text: &[u8]) -> Option<(Vec<&[u8]>, Option<bool>)> {
    let mut capitals = text.to_ascii_uppercase();
    let (mut depth, mut is_text) = (0_i32, false);
    for byte in &mut capitals {
        is_text ^= *byte == b'"';
        depth += i32::from(matches!(*byte, b'(' | b'[' | b'{'));
        depth -= i32::from(matches!(*byte, b')' | b']' | b'}'));
        if depth != 0 || is_text {
            // no letter, and no blank, which would part words
            *byte = b'(';
        }
    }
    let has = |join| word(&capitals, join).is_some();
    let by = match (has("AND"), has("OR")) {
        _ if ["XOR", "EXOR"].into_iter().any(has) => return None,
        (true, true) => return None,
        (false, false) => return Some((vec![text], None)),
        (by_and, _) => by_and,
    };
    let join = if by { "AND" } else { "OR" };
    let (mut parts, mut from) = (Vec::new(), 0);
    while let Some(at) = word(&capitals[from..], join) {
        parts.push(&text[from..from + at]);
        from += at + join.len();
    }
    parts.push(&text[from..]);
    Some((parts, Some(by)))
}

/// Whether brackets stand around the whole of a text.
fn is_in_brackets(text: &[u8]) -> bool {
    inside_brackets(text).len() < text.trim_ascii().len()
}

/// What stands behind a NOT in front.
fn behind_not(condition: &[u8]) -> Option<&[u8]> {
    if let Some(rest) = condition.strip_prefix(b"!") {
        return (rest.first() != Some(&b'=')).then_some(rest);
    }
    let (not, rest) = condition.split_at_checked(3)?;
    let is_word = rest.first().is_some_and(|b| !is_letter(*b));
    (is_word && not.eq_ignore_ascii_case(b"NOT")).then_some(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With `&`, `|` and `!`.
    fn written(of: &Logic<Part>) -> String {
        let join = |all: &[Logic<Part>], by: &str| {
            let all: Vec<String> = all.iter().map(written).collect();
            format!("({})", all.join(by))
        };
        match of {
            Logic::One(part) => {
                let sign = if part.holds { "" } else { "!" };
                format!("{sign}{}", String::from_utf8_lossy(part.text))
            }
            Logic::All(all) => join(all, " & "),
            Logic::Any(all) => join(all, " | "),
        }
    }

    #[test]
    fn conditions_are_taken_apart_where_brackets_or_one_join_tell_how() {
        for (condition, wanted) in [
            ("n==1", "n==1"),
            ("(n=1 AND b)", "(n=1 & b)"),
            ("n=1 or m=2 or b", "(n=1 | m=2 | b)"),
            ("NOT (n=1 AND b)", "(!n=1 | !b)"),
            ("not(n=1 or (b and NOT c))", "(!n=1 & (!b | c))"),
            ("(n=1 OR b) AND (m=2)", "((n=1 | b) & m=2)"),
            ("NOT NOT b", "b"),
            ("!b", "!b"),
            ("a!=b", "a!=b"),
            ("a AND NOT b", "(a & !b)"),
            ("NOT a OR b", "(!a | b)"),
            ("f(a AND b)", "f(a AND b)"),
            ("s=\"a AND b\" AND c", "(s=\"a AND b\" & c)"),
            ("ANDY OR ORA", "(ANDY | ORA)"),
            // what comes first differs
            ("NOT a AND b", "NOT a AND b"),
            ("a AND b OR c", "a AND b OR c"),
            ("a XOR b", "a XOR b"),
            ("a==TRUE AND b", "a==TRUE AND b"),
            ("(a==TRUE) AND b", "(a==TRUE & b)"),
            ("NOT(a OR b AND c)", "!a OR b AND c"),
            ("a AND", "(a & )"),
            ("", ""),
        ] {
            assert_eq!(
                written(&logic(condition.as_bytes(), true, First::Comparisons)),
                wanted,
                "{condition}"
            );
        }
        let contrary = logic(b"a AND n<1", false, First::Comparisons);
        assert_eq!(written(&contrary), "(!a | !n<1)");
        for (condition, wanted) in [
            ("NOT n==1", "NOT n==1"),
            ("NOT (n==1)", "!n==1"),
            ("b OR NOT n<1", "(b | NOT n<1)"),
            ("NOT b", "!b"),
        ] {
            let found = logic(condition.as_bytes(), true, First::Not);
            assert_eq!(written(&found), wanted, "{condition}");
        }
        // comparisons last
        for (condition, wanted) in [
            ("b AND c==$IN[1]", "b AND c==$IN[1]"),
            ("(n==1) OR b", "(n==1 | b)"),
            ("b AND NOT (c==d)", "(b & !c==d)"),
        ] {
            let found = logic(condition.as_bytes(), true, First::Joins);
            assert_eq!(written(&found), wanted, "{condition}");
        }
    }
}
