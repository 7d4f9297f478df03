//! What is written into registers, as text without the names in it, and what numbers that comes to.

use super::numbers::{ELEMENTS, Known, MOST_NUMBER, of_call, of_position};
use super::words::{
    Named, behind_group, bracket_end, concerns_group_1, element, local, position, register, whole,
    word_length,
};
use crate::program::TargetId;
use crate::program::numbers::counted;
use crate::program::quantity::{Quantity, evaluate};
use crate::program::script::RoutineId;
use std::rc::Rc;

/// Numbers of a range that are looked at one by one.
const MOST_IN_RANGE: f64 = 64.0;

/// What a number becomes.
#[derive(Debug)]
pub(super) struct Entered {
    pub content: Content,
    /// Which number of a position; of texts with whole positions.
    pub element: usize,
    pub routine: RoutineId,
    /// What the program has just written into numbers of the text.
    pub bound: Box<[(u32, Rc<Entered>)]>,
    /// How many texts that is altogether.
    pub size: usize,
    /// Numbers in it that the program has not just written.
    pub read: Box<[u32]>,
    /// The number itself stands in it, and the program has not just written it.
    pub is_own: bool,
}

#[derive(Debug)]
pub(super) enum Content {
    Exactly(f64),
    /// What is not followed.
    Endless,
    Text(Rc<[u8]>),
    /// What FOR counts.
    Counted {
        from: Rc<[u8]>,
        to: Rc<[u8]>,
        is_down: bool,
    },
}

impl Entered {
    pub(super) fn of(content: Content, routine: RoutineId) -> Self {
        Self {
            content,
            element: 0,
            routine,
            bound: Box::default(),
            size: 1,
            read: Box::default(),
            is_own: false,
        }
    }

    /// Whether a number stands in it as it was before the program wrote any.
    pub(super) fn has_read(&self, number: u32) -> bool {
        let mut bound = self.bound.iter();
        self.read.contains(&number) || bound.any(|(_, entered)| entered.has_read(number))
    }

    /// Whether a number stands in it.
    pub(super) fn names(&self, number: u32) -> bool {
        self.read.contains(&number) || self.bound.iter().any(|(bound, _)| *bound == number)
    }

    /// Whether it is the number of a point.
    pub(super) fn is_of_point(&self) -> bool {
        match &self.content {
            Content::Text(text) => text.strip_prefix(b"0+").is_some_and(|text| {
                let point = position(text);
                point.is_some_and(|(of, end)| matches!(of, Named::Point(_)) && end == text.len())
            }),
            _ => false,
        }
    }

    pub(super) fn exact(&self) -> Option<f64> {
        match self.content {
            Content::Exactly(value) => Some(value),
            _ => None,
        }
    }
}

/// A number and what it is now: it stands for itself where it is that.
pub(super) type Own<'a> = (u32, Option<&'a Rc<Entered>>);

impl Known {
    /// What something written comes to; `of` gives the value of other numbers.
    pub(super) fn evaluate(
        &self,
        entered: &Entered,
        own: Option<Own>,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        let mut inside = |number: u32| {
            let bound = entered.bound.iter().find(|(bound, _)| *bound == number);
            let bound = bound.map(|(_, entered)| entered);
            if let Some((_, present)) = own.filter(|(own, _)| *own == number) {
                let is_present = match (bound, present) {
                    (None, None) => true,
                    (Some(bound), Some(present)) => Rc::ptr_eq(bound, present),
                    _ => false,
                };
                if is_present {
                    return Quantity::own();
                }
            }
            match bound {
                Some(bound) => self.evaluate(bound, own, of),
                None => of(self.existing(number)),
            }
        };
        match &entered.content {
            Content::Exactly(value) => Quantity::exactly(*value),
            Content::Endless => Quantity::endless(),
            Content::Text(text) => {
                self.of_text(text, (entered.element, entered.routine), &mut inside)
            }
            Content::Counted { from, to, is_down } => {
                let mut value = |text| self.of_text(text, (0, entered.routine), &mut inside);
                let (from, to) = (value(from), value(to));
                let step = if *is_down { -1.0 } else { 1.0 };
                counted(&from, &to, Some(Quantity::exactly(step)))
            }
        }
    }

    /// The value of a text without names.
    pub(super) fn of_text(
        &self,
        text: &[u8],
        at: (usize, RoutineId),
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        let value = evaluate(text, &mut |operand| self.operand(operand, at, of));
        value.unwrap_or_else(|| self.of_other(text, at, of))
    }

    /// What is computed in another way than by sums and products: not followed where the text tells
    /// anything that is in it.
    fn of_other(
        &self,
        text: &[u8],
        at: (usize, RoutineId),
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        let mut is_of_program = false;
        let mut rest = text;
        while let Some(&first) = rest.first() {
            let name = word_length(rest);
            if name == 0 {
                rest = &rest[1..];
                continue;
            }
            let word = &rest[..name];
            rest = &rest[name..];
            let length = rest.strip_prefix(b"[").and_then(bracket_end);
            let is_register = matches!(word, b"R" | b"AR" | b"PR" | b"P");
            if let Some(length) = length.filter(|_| is_register && !first.is_ascii_digit()) {
                let operand = [word, &rest[..length + 2]].concat();
                is_of_program |= self.operand(&operand, at, of).is_of_program();
                rest = &rest[length + 2..];
            }
        }
        if is_of_program {
            Quantity::endless()
        } else {
            Quantity::unknown()
        }
    }

    fn operand(
        &self,
        operand: &[u8],
        at: (usize, RoutineId),
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        let (word, rest) = operand.split_at(word_length(operand));
        let index = rest.strip_prefix(b"[").and_then(|r| r.strip_suffix(b"]"));
        match (word, index) {
            (b"R", Some(index)) => self.indexed(index, at, &|number| number, of),
            (b"PR", Some(index)) => {
                let comma = memchr::memrchr(b',', index);
                let (index, part) = match comma {
                    Some(comma) => (&index[..comma], whole(&index[comma + 1..])),
                    None => (index, u32::try_from(at.0 + 1).ok()),
                };
                match part {
                    Some(part @ 1..=ELEMENTS) => {
                        self.indexed(index, at, &|number| of_position(number, part - 1), of)
                    }
                    _ => Quantity::endless(),
                }
            }
            (b"AR", Some(index)) => match whole(index) {
                Some(number @ ..=15) => of(of_call(at.1, number)),
                _ => Quantity::endless(),
            },
            (b"P", Some(index)) => whole(index).map_or_else(Quantity::endless, |number| {
                self.of_point((at.1, number), at.0)
            }),
            // where the robot is may be anywhere
            (b"LPOS" | b"JPOS", None) => Quantity::endless(),
            (_, None) if memchr::memchr(b'[', rest).is_none() => Quantity::unknown(),
            // what stands in the brackets of a function
            _ => {
                let inside = memchr::memchr(b'[', rest).map_or(&rest[..0], |at| &rest[at..]);
                self.of_other(inside, at, of)
            }
        }
    }

    /// The number that an index tells, or any that it may tell.
    fn indexed(
        &self,
        index: &[u8],
        at: (usize, RoutineId),
        number: &dyn Fn(u32) -> u32,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        if let Some(one) = whole(index) {
            return if one < MOST_NUMBER {
                of(number(one))
            } else {
                Quantity::endless()
            };
        }
        let range = self.range(index, at, of);
        let all: Option<Vec<Quantity>> = range.map(|all| all.map(|one| of(number(one))).collect());
        all.map_or_else(Quantity::endless, |all| Quantity::any(&all))
    }

    /// The numbers that an index, `R[1]`, may tell; `None` where they are not few.
    pub(super) fn range(
        &self,
        index: &[u8],
        at: (usize, RoutineId),
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Option<std::ops::RangeInclusive<u32>> {
        if !index.starts_with(b"R[") {
            return None;
        }
        let (least, most) = self.operand(index, at, of).ends()?;
        let is_few = least >= 0.0 && most < f64::from(MOST_NUMBER) && most - least < MOST_IN_RANGE;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let range = least.floor() as u32..=most.ceil() as u32;
        is_few.then_some(range)
    }

    /// A number of a point: what the file has, where nothing rewrites it.
    fn of_point(&self, point: (RoutineId, u32), element: usize) -> Quantity {
        let target: Option<&TargetId> = self.points.get(&point);
        let values = target.and_then(|target| self.values.get(target));
        match values.map(|values| values.get(element)) {
            Some(Some(value)) => Quantity::exactly(*value),
            // an axis besides the arm's
            Some(None) => Quantity::unknown(),
            None => Quantity::endless(),
        }
    }
}

/// A value without the names of what is in it: `R[5]*(PR[4,2]+1)` of `R[5:a*b]*(PR[GP1:4,2:c]+1)`.
/// Where something else is the index stands `?`.
pub(super) fn canonical(text: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(text.len());
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let mut name = word_length(rest);
        if name == 0 {
            out.push(rest[0]);
            at += 1;
            continue;
        }
        let is_operator = matches!(&rest[..name.min(3)], b"DIV" | b"MOD");
        if is_operator && rest.get(name) == Some(&b'[') {
            name = 3;
        }
        let word = &rest[..name];
        at += name;
        let inside = text[at..].strip_prefix(b"[");
        let length = inside.and_then(bracket_end).filter(|_| !is_operator);
        if let (Some(inside), Some(length)) = (inside, length) {
            push_indexed(&mut out, word, inside[..length].trim_ascii());
            at += length + 2;
        } else {
            out.extend_from_slice(word);
        }
        // a name goes on behind a bracket
        let next = text.get(at).copied();
        let is_letter = next.is_some_and(|b| b.is_ascii_alphabetic());
        if is_letter || is_operator {
            out.push(b' ');
        }
    }
    out
}

fn push_indexed(out: &mut Vec<u8>, word: &[u8], index: &[u8]) {
    // those of one program have numbers of their own
    let (word, is_local) = match word {
        b"LR" => (&b"R"[..], true),
        b"LPR" => (&b"PR"[..], true),
        _ => (word, false),
    };
    let is_register = matches!(word, b"R" | b"AR" | b"PR" | b"P");
    let is_other = is_register && !concerns_group_1(index);
    out.extend_from_slice(if is_other { b"P" } else { word });
    out.push(b'[');
    if is_other {
        out.push(b'?');
    } else if is_register {
        let of = register(index);
        let number = if word == b"PR" {
            of.number
        } else {
            whole(index)
        };
        let number = match number {
            Some(number) if is_local => local(number),
            number => number,
        };
        match number {
            Some(number) => out.extend_from_slice(number.to_string().as_bytes()),
            None if is_local => out.push(b'?'),
            None => push_index(out, behind_group(index)),
        }
        if word == b"PR" && of.is_element {
            out.push(b',');
            let part = element(index).map_or("?".into(), |part| part.to_string());
            out.extend_from_slice(part.as_bytes());
        }
    } else if memchr::memchr(b'[', index).is_some() {
        out.extend_from_slice(&canonical(index));
    } else {
        out.push(b'0');
    }
    out.push(b']');
}

/// `R[1]` of `R[1:which],3:name`
fn push_index(out: &mut Vec<u8>, index: &[u8]) {
    let inside = index.strip_prefix(b"R[");
    match inside.and_then(bracket_end) {
        Some(length) => out.extend_from_slice(&canonical(&index[..length + 3])),
        None => out.push(b'?'),
    }
}

/// Whether an instruction is `R[1]=PR[4,3]`, or a sum with such an element.
pub(super) fn gets_elements(bytes: &[u8]) -> bool {
    memchr::memmem::find_iter(bytes, b"PR[").any(|at| {
        let start = memchr::memrchr2(b'\n', b'\r', &bytes[..at]).map_or(0, |end| end + 1);
        let before = &bytes[start..at];
        let before = before.splitn(2, |&b| b == b':').nth(1).unwrap_or(before);
        let before = before.trim_ascii_start();
        let is_number = before.starts_with(b"R[") || before.starts_with(b"LR[");
        is_number && before.contains(&b'=')
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_left_out() {
        for (text, wanted) in [
            ("(R[5:a*b (c]-R[6: it's])*2", "(R[5]-R[6])*2"),
            ("PR[GP1:4,2:x, y]+PR[R[1:n],3:z]", "PR[4,2]+PR[R[1],3]"),
            ("R[1:q]DIVR[2:r]", "R[1] DIV R[2]"),
            ("R[1]DIV R[2]", "R[1] DIV  R[2]"),
            ("R[1] MOD 5", "R[1] MOD  5"),
            ("ABS[R[2:x]]+GI[3:y]", "ABS[R[2]]+GI[0]"),
            ("PR[GP2:4]", "P[?]"),
            ("R[AR[1]]", "R[?]"),
            ("LR[1:a]+LPR[2,3:b]", "R[262145]+PR[262146,3]"),
            ("LPR[R[1]]", "PR[?]"),
        ] {
            let found = canonical(text.as_bytes());
            assert_eq!(std::str::from_utf8(&found), Ok(wanted), "{text}");
        }
    }
}
