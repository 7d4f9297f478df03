//! Registers as indices, `P[R[1]]`, `PR[R[1]]`, `PR[4,R[2]]`: which numbers they may tell.
//!
//! A register that has just been written is what was written, one that nothing else writes counts
//! from the start of its loop to its end. Elsewhere it is any of what all programs write into it:
//! where one has such an index, they are gone through twice, so that this is known.

use super::content::canonical;
use super::lines::Line;
use super::moves::Goal;
use super::numbers::{Known, MOST_NUMBER};
use super::reader::{Group, Listing, Reader};
use super::words::{behind_group, bracket_end, is_word, whole, word_length};
use crate::program::quantity::Quantity;
use crate::program::script::{Expr, Place, short};
use std::ops::Range;

/// Numbers of an index that are followed each.
const MOST_NUMBERS: u32 = 64;
/// Texts that one instruction may come to.
const MOST_TEXTS: usize = 16;
/// Rounds of a loop that are gone through one by one, and their lines altogether.
const MOST_ROUNDS: f64 = 16.0;
const MOST_LINES: usize = 512;
/// Between the parts of an assignment.
const BETWEEN: u8 = 0;

/// Whether a program has a register for an index.
pub(super) fn has_index(bytes: &[u8]) -> bool {
    memchr::memmem::find_iter(bytes, b"R[").any(|at| is_index(bytes, at).is_some())
}

/// The first byte of a register that stands for an index, by that of its `R[`.
fn is_index(text: &[u8], at: usize) -> Option<usize> {
    let start = match at.checked_sub(1).map(|before| text[before]) {
        Some(b'A') => at - 1,
        _ => at,
    };
    let before = text[..start].trim_ascii_end();
    let (open, is_element) = match before.last()? {
        b'[' => (before.len() - 1, false),
        b',' => (memchr::memrchr(b'[', before)?, true),
        _ => return None,
    };
    let name = before[..open].rsplit(|b| !is_word(*b)).next()?;
    let has_index = match name {
        b"PR" | b"LPR" => true,
        b"P" | b"R" | b"LR" | b"UFRAME" | b"UTOOL" => !is_element,
        _ => false,
    };
    has_index.then_some(start)
}

/// The registers of a text that stand alone, each with its bytes.
fn registers(text: &[u8]) -> impl Iterator<Item = Range<usize>> {
    memchr::memmem::find_iter(text, b"R[").filter_map(|at| {
        let is_argument = at > 0 && text[at - 1] == b'A';
        let start = at - usize::from(is_argument);
        let is_alone = start == 0 || !is_word(text[start - 1]);
        let length = bracket_end(&text[at + 2..]).filter(|_| is_alone)?;
        Some(start..at + 2 + length + 1)
    })
}

/// A text in which a register is a number.
fn with(text: &[u8], register: &[u8], number: u32) -> Vec<u8> {
    let mut out = Vec::with_capacity(text.len());
    let mut behind = 0;
    for range in registers(text) {
        if range.start >= behind && canonical(&text[range.clone()]) == register {
            out.extend_from_slice(&text[behind..range.start]);
            out.extend_from_slice(number.to_string().as_bytes());
            behind = range.end;
        }
    }
    out.extend_from_slice(&text[behind..]);
    out
}

/// Whether a value may be a number, rounded either way.
fn may_be(value: &Quantity, number: u32) -> bool {
    if value.unknown.is_some() || !value.readings.is_empty() {
        return true;
    }
    let number = f64::from(number);
    let most = |most: Option<u32>| most.map_or(f64::INFINITY, f64::from);
    if let [step] = value.steps[..] {
        let times = ((number - value.first) / step.by).round();
        let times = times.clamp(0.0, most(step.most));
        return (value.first + times * step.by - number).abs() < 1.0;
    }
    let (mut least, mut greatest) = (value.first, value.first);
    for step in &value.steps {
        let far = step.by * most(step.most);
        (least, greatest) = (least + far.min(0.0), greatest + far.max(0.0));
    }
    least - 1.0 < number && number < greatest + 1.0
}

/// What an index may tell.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Meant(Quantity);

impl Meant {
    pub(super) fn may_be(&self, number: u32) -> bool {
        may_be(&self.0, number)
    }

    /// All that it may be; `None` where these are not few.
    pub(super) fn all(&self) -> Option<Vec<u32>> {
        let (least, most) = self.0.ends()?;
        let is_few = most - least < f64::from(MOST_NUMBERS);
        let is_number = least > -1.0 && most < f64::from(MOST_NUMBER - 1);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let all = least.floor().max(0.0) as u32..=most.ceil() as u32;
        (is_few && is_number).then(|| all.filter(|number| self.may_be(*number)).collect())
    }
}

impl Known {
    /// What an index, `R[1]`, may tell; `before` is what was known when all programs were read.
    pub(super) fn meant(&mut self, index: &[u8], before: Option<&Self>) -> Meant {
        let entered = self.entered(u32::MAX, &canonical(index), 0);
        self.reads(&entered);
        Meant(match (entered.exact(), before) {
            (Some(exact), _) => Quantity::exactly(exact),
            (None, Some(before)) => before.value(&entered, None),
            (None, None) => Quantity::unknown(),
        })
    }
}

/// A loop that is gone through round by round.
struct Rounds {
    counter: u32,
    /// Its number in each round.
    numbers: Vec<f64>,
    /// Instructions of a round.
    lines: usize,
}

impl Listing {
    /// The points with one of these numbers, as indices.
    fn numbered(&self, numbers: &[u32]) -> Vec<u32> {
        let mut found = Vec::new();
        for number in numbers {
            let mut next = self.by_number.get(number).copied();
            while let Some(at) = next {
                found.push(at);
                next = self.points[at as usize].twin;
            }
        }
        found
    }
}

impl Reader<'_> {
    /// Instructions one after another; those of a loop for each of its rounds where registers in it
    /// stand for numbers.
    pub(super) fn lines(&mut self, file: u32, lines: &[Line]) {
        let mut at = 0;
        while let Some(line) = lines.get(at) {
            self.place = Place::new(file, short(line.text.start));
            at += 1;
            let Some(rounds) = self.rounds(&lines[at - 1..]) else {
                self.line(line);
                continue;
            };
            let body = &lines[at..at + rounds.lines];
            self.end_select();
            let before = self.state.begin_rounds(rounds.numbers.len());
            for number in rounds.numbers {
                self.known.count(rounds.counter, number);
                self.lines(file, body);
                self.end_select();
            }
            self.state.end_rounds(before);
            // with ENDFOR
            at += rounds.lines + 1;
        }
    }

    /// The rounds of a loop that begins with the first of these lines, where registers in it stand for
    /// numbers and the text counts it: nothing comes to it from elsewhere, and nothing else writes its
    /// counter.
    fn rounds(&self, lines: &[Line]) -> Option<Rounds> {
        let text_of = |line: &Line| self.bytes[line.text.clone()].trim_ascii_end();
        let starts = |line: &Line, word: &[u8]| {
            let text = text_of(line);
            text[..word_length(text)].eq_ignore_ascii_case(word)
        };
        let before = self
            .before
            .as_deref()
            .filter(|_| !self.known.is_concurrent)?;
        let first = lines.first().filter(|line| starts(line, b"FOR"))?;
        let text = canonical(text_of(first)[b"FOR".len()..].trim_ascii());
        let (number, range) = counter(&text).filter(|(of, _)| before.is_only_counted(*of))?;
        let (from, to, is_down) = ends(range)?;
        let exact = |text: &[u8]| {
            let entered = self.known.entered(u32::MAX, text.trim_ascii(), 0);
            entered.exact().filter(|value| value.fract() == 0.0)
        };
        let (from, to) = (exact(from)?, exact(to)?);
        let step = if is_down { -1.0 } else { 1.0 };
        let more = (to - from) * step;
        let mut depth = 0_usize;
        let mut length = 0;
        for line in &lines[1..] {
            if starts(line, b"ENDFOR") {
                if depth == 0 {
                    break;
                }
                depth -= 1;
            }
            depth += usize::from(starts(line, b"FOR"));
            length += 1;
            if length > MOST_LINES {
                return None;
            }
        }
        let body = &lines[1..=length];
        let is_label = |line: &Line| starts(line, b"LBL") || starts(line, b"LABEL");
        let counts_again = |line: &Line| {
            let text = text_of(line);
            let inner = starts(line, b"FOR").then(|| canonical(text[b"FOR".len()..].trim_ascii()));
            inner.is_some_and(|text| counter(&text).is_some_and(|(of, _)| of == number))
        };
        let is_followed = (0.0..MOST_ROUNDS).contains(&more)
            && length + 1 < lines.len()
            && body.iter().any(|line| has_index(text_of(line)))
            && !body.iter().any(|line| is_label(line) || counts_again(line));
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let rounds = is_followed.then_some(more as u32 + 1)?;
        let times = self.state.rounds() * rounds as usize;
        let is_short = length.saturating_mul(times) <= MOST_LINES;
        is_short.then(|| Rounds {
            counter: number,
            numbers: (0..rounds).map(|at| from + step * f64::from(at)).collect(),
            lines: length,
        })
    }

    /// What an index may tell.
    pub(super) fn meant(&mut self, index: &[u8]) -> Meant {
        self.known.meant(index, self.before.as_deref())
    }

    /// What the index of a position, `P[R[1]]`, may tell.
    pub(super) fn meant_in(&mut self, text: &[u8]) -> Meant {
        let index = memchr::memchr(b'[', text).map_or(text, |at| &text[at + 1..]);
        let length = bracket_end(index).unwrap_or(index.len());
        self.meant(behind_group(index[..length].trim_ascii()))
    }

    /// The points that an index may tell, of one tool and frame together.
    fn grouped(&mut self, meant: &Meant, few: Option<&[u32]>) -> Vec<Group> {
        let indices: Vec<u32> = match few {
            Some(numbers) => self.listing.numbered(numbers),
            None => (0..short(self.listing.points.len())).collect(),
        };
        let points = indices
            .into_iter()
            .map(|at| &self.listing.points[at as usize]);
        let mut groups: Vec<(Option<u32>, Option<u32>, Vec<Expr>)> = Vec::new();
        for point in points.filter(|point| meant.may_be(point.number)) {
            let Some(target) = point.target.map(Expr::Target) else {
                continue;
            };
            let key = (point.tool, point.frame);
            match groups.iter_mut().find(|group| (group.0, group.1) == key) {
                Some((.., all)) => all.push(target),
                None => groups.push((key.0, key.1, vec![target])),
            }
        }
        let script = &mut self.builder.script;
        let any = |(tool, frame, all)| (tool, frame, script.any(all));
        groups.into_iter().map(any).collect()
    }

    /// The points that an index may tell, or any of the program: those of one tool and frame
    /// together.
    pub(super) fn any_point(&mut self, text: &[u8]) -> Vec<Goal> {
        let meant = self.meant_in(text);
        let few = meant.all();
        let known = self.listing.any.take_if(|_| few.is_none());
        let known = known.filter(|(of, _)| *of == meant);
        let groups = match known {
            Some((_, groups)) => groups,
            None => self.grouped(&meant, few.as_deref()),
        };
        let goals = groups
            .iter()
            .map(|(tool, frame, any)| self.goal(*any, *tool, *frame, false));
        let mut goals: Vec<Goal> = goals.collect();
        let is_missing = |numbers: &Vec<u32>| self.listing.numbered(numbers).is_empty();
        if few.as_ref().is_some_and(is_missing) {
            goals.push(self.goal(Expr::Unknown(self.controller.missing), None, None, false));
        }
        if few.is_none() {
            self.listing.any = Some((meant, groups));
        }
        goals
    }

    /// An assignment for each of what its indices may be, index and value; one whose indices are not
    /// known stays as it is.
    pub(super) fn instances(&mut self, index: &[u8], value: &[u8]) -> Vec<(Vec<u8>, Vec<u8>)> {
        let text = [b"PR[", index, b"]", &[BETWEEN], value].concat();
        let mut indices: Vec<Vec<u8>> = Vec::new();
        for at in memchr::memmem::find_iter(&text, b"R[") {
            if is_index(&text, at).is_some()
                && let Some(length) = bracket_end(&text[at + 2..])
            {
                let start = at - usize::from(text[at - 1] == b'A');
                let register = canonical(&text[start..=at + 2 + length]);
                if !indices.contains(&register) {
                    indices.push(register);
                }
            }
        }
        let mut all = vec![text];
        for register in indices {
            let Some(numbers) = self.meant(&register).all() else {
                continue;
            };
            if numbers.len() * all.len() <= MOST_TEXTS {
                let each = all.iter().flat_map(|text| {
                    let each = numbers.iter();
                    each.map(|number| with(text, &register, *number))
                });
                all = each.collect();
            }
        }
        let halves = all.into_iter().map(|text| {
            let end = text
                .iter()
                .position(|byte| *byte == BETWEEN)
                .unwrap_or(text.len());
            let (index, value) = text.split_at(end);
            let index = &index[b"PR[".len()..index.len() - 1];
            (index.to_vec(), value[1..].to_vec())
        });
        halves.collect()
    }
}

/// The ends of `1 TO 4`, and whether it counts down.
pub(super) fn ends(range: &[u8]) -> Option<(&[u8], &[u8], bool)> {
    let at = |word: &[u8]| memchr::memmem::find(range, word);
    let (start, length, is_down) = match (at(b"DOWNTO"), at(b"TO")) {
        (Some(at), _) => (at, 6, true),
        (None, Some(at)) => (at, 2, false),
        _ => return None,
    };
    Some((&range[..start], &range[start + length..], is_down))
}

/// The counter and range of `R[1]=1 TO 4`.
pub(super) fn counter(text: &[u8]) -> Option<(u32, &[u8])> {
    let inside = text.strip_prefix(b"R[")?;
    let end = bracket_end(inside)?;
    let number = whole(&inside[..end]).filter(|number| *number < MOST_NUMBER)?;
    let range = inside[end + 1..].trim_ascii_start().strip_prefix(b"=")?;
    Some((number, range))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_register_stands_for_a_number() {
        for (text, wanted) in [
            ("PR[R[1:which],3:z]+R[1]*2", "PR[7,3:z]+7*2"),
            ("PR[4,R[1]]+SR[1]+AR[1]+R[11]", "PR[4,7]+SR[1]+AR[1]+R[11]"),
            ("R[R[1]]", "R[7]"),
        ] {
            let found = with(text.as_bytes(), b"R[1]", 7);
            assert_eq!(std::str::from_utf8(&found), Ok(wanted), "{text}");
        }
        for (text, wanted) in [
            ("P[R[1]]", true),
            ("PR[ R[1:x]]", true),
            ("PR[4, R[1]]", true),
            ("P[AR[1]]", true),
            ("SIN[R[1]]", false),
            ("CALL X(R[1],R[2])", false),
            ("R[1]=R[2]+1", false),
        ] {
            assert_eq!(has_index(text.as_bytes()), wanted, "{text}");
        }
    }

    #[test]
    fn what_is_counted_may_be_some_numbers() {
        let of = |value: Quantity| {
            let meant = Meant(value);
            (meant.all(), meant.may_be(7))
        };
        let counted = Quantity::counted(1.0, 2.0, Some(3));
        assert_eq!(of(counted), (Some(vec![1, 3, 5, 7]), true));
        assert_eq!(of(Quantity::counted(1.0, 2.0, None)), (None, true));
        assert_eq!(of(Quantity::counted(8.0, 1.0, None)), (None, false));
        assert_eq!(
            of(Quantity::between(2.0, 4.0)),
            (Some(vec![2, 3, 4]), false)
        );
        assert_eq!(of(Quantity::unknown()), (None, true));
        // on which side it is rounded is not known
        assert_eq!(of(Quantity::exactly(1.5)), (Some(vec![1, 2]), false));
    }
}
