//! What numbers of jobs come to: `B`, `I`, `D` and `R` variables, those of a job alone (`LD000`), what
//! calls give, and the numbers of positions (`SETE P010 (3) D000`).
//!
//! What a job has just written counts as it is, up to the next label, branch or call. Elsewhere a
//! number is any of what the text writes into it; where a job may read it before it has set it, also
//! what only the running program knows.

mod sums;

pub(super) use sums::Amounts;

use super::calls::is_macro;
use super::job::Job;
use super::lines::{Line, words};
use crate::program::number;
use crate::program::numbers::{
    Blocks, Numbers, Operand as Part, Site, bounds_in, compared_in, counted, evaluated, rounds,
};
use crate::program::quantity::{Arithmetic, Quantity, evaluate_in, is_letter};
use crate::program::script::VariableId;
use foldhash::{HashMap, HashSet};
use std::rc::Rc;
use sums::{Terms, summed};

/// Numbers that are known as they were written last.
const MOST_NOW: usize = 512;
/// Bytes of a text that stands for a number in others.
const LONGEST: usize = 200;
/// Numbers of a position.
pub(super) const OF_POSITION: usize = 6;

/// What a number is called: a letter, the job that it belongs to, its number.
type Key = (u8, Option<u32>, u32);
/// What calls give a job.
const ARGUMENT: u8 = b'A';
/// The numbers of positions, by the variable: six times its number and the place.
const ELEMENT: u8 = b'P';

/// What is written into a number.
#[derive(Debug)]
pub(super) enum Written {
    /// By a text, in a job.
    Text(Rc<[u8]>, u32),
    /// What `FOR` counts from the first to the second.
    Counted([Rc<[u8]>; 2], u32),
    Sum(Terms),
}

/// What a job has just written: the number of a position and something more, or something alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Now {
    pub of: Option<(VariableId, usize)>,
    pub value: f64,
}

/// What is known of the numbers of all jobs.
#[derive(Debug, Default)]
pub(super) struct Known {
    numbers: Numbers<Written>,
    blocks: Blocks,
    keys: HashMap<Key, u32>,
    now: HashMap<u32, Now>,
    /// The texts that the job has just written, and the sums.
    texts: HashMap<u32, Rc<[u8]>>,
    sums: HashMap<u32, Terms>,
    job: u32,
    /// Branches and loops that are open, with what these count.
    open: Vec<Option<u32>>,
    /// What was set so far, inside so many branches and loops: what follows has it.
    set: HashMap<u32, usize>,
    /// Labels, and those ahead that the job may have gone on to.
    labels: HashSet<u64>,
    ahead: HashSet<u64>,
    /// Numbers of positions in the files.
    declared: HashSet<u32>,
    /// Letters of which an instruction writes any.
    any: HashSet<u8>,
    /// Jobs that the files do not have may write numbers, and others run at the same time.
    pub calls_others: bool,
    pub is_concurrent: bool,
    /// Loops that count: the counter, the block, and the loop of the script.
    loops: Vec<(u32, (u32, u32), usize)>,
    /// Numbers that are written not by FOR alone.
    assigned: HashSet<u32>,
    /// The positions of which each is a copy or a sum.
    sources: HashMap<VariableId, HashSet<VariableId>>,
}

impl Known {
    fn key(&mut self, key: Key) -> u32 {
        let next = u32::try_from(self.keys.len()).unwrap_or(u32::MAX);
        *self.keys.entry(key).or_insert(next)
    }

    /// The number that a word names: `D000`, `LB001`.
    fn named(&mut self, word: &[u8], job: u32) -> Option<u32> {
        let key = key_of(word, job)?;
        Some(self.key(key))
    }

    fn element(&mut self, position: VariableId, at: usize) -> u32 {
        let at = u32::try_from(at).unwrap_or(0);
        self.key((ELEMENT, None, position.saturating_mul(8).saturating_add(at)))
    }

    /// The numbers that the files have for a position.
    pub(super) fn declare(&mut self, position: VariableId, values: &[f64; OF_POSITION]) {
        for (at, value) in values.iter().enumerate() {
            let element = self.element(position, at);
            self.declared.insert(element);
            let written = Written::Text(value.to_string().as_bytes().into(), 0);
            self.numbers.write(element, written, None);
        }
    }

    // ---- the way

    pub(super) fn begin(&mut self, job: u32) {
        self.blocks.begin(job);
        self.job = job;
        self.clear();
        self.open.clear();
        self.set.clear();
        self.labels.clear();
        self.ahead.clear();
    }

    /// A label, or another job that runs.
    pub(super) fn clear(&mut self) {
        self.now.clear();
        self.texts.clear();
        self.sums.clear();
    }

    /// Of a number nothing is known here.
    fn forget(&mut self, number: u32) {
        self.now.remove(&number);
        self.texts.remove(&number);
        self.sums.remove(&number);
    }

    pub(super) fn label(&mut self, key: u64) {
        self.blocks.flow.label(key);
        self.clear();
        self.ahead.remove(&key);
        self.labels.insert(key);
    }

    /// The job goes to a label; where there is a condition, if that holds.
    pub(super) fn jump(&mut self, key: u64, condition: Option<&[u8]>) {
        let step = self.blocks.flow.jump(key, condition.is_some());
        self.check((step, false), condition.unwrap_or_default());
        if !self.labels.contains(&key) {
            self.ahead.insert(key);
        }
        self.numbers.jumps(self.job);
    }

    /// A branch begins on a condition, where there is one.
    pub(super) fn open(&mut self, condition: &[u8]) {
        self.clear();
        let inside = self.blocks.open_branch();
        self.check((inside, true), condition);
        self.open.push(None);
    }

    /// A loop begins. The step from which its statements are the next.
    fn open_loop(&mut self, most: Option<u32>, counter: Option<u32>) -> u32 {
        self.clear();
        self.open.push(counter);
        self.blocks.open_loop(most)
    }

    /// From a step the job goes one way where a condition holds, else the other.
    fn check(&mut self, (step, is_next): (u32, bool), condition: &[u8]) {
        for (holds, side, relation, limit) in compared_in(condition) {
            if let Some(number) = self.named(side, self.job) {
                let limit = Written::Text(limit.into(), self.job);
                let edge = (step, is_next == holds);
                self.numbers
                    .check(self.job, edge, number, (relation, limit));
            }
        }
    }

    /// The job ends here.
    pub(super) fn stop(&mut self) {
        self.blocks.flow.stop();
    }

    /// The end of a job; `is_followed` where its jumps go to labels that they name.
    pub(super) fn end(&mut self, is_followed: bool) {
        let flow = std::mem::take(&mut self.blocks.flow);
        if is_followed {
            self.numbers.goes(self.job, flow);
        }
    }

    pub(super) fn branch(&mut self) {
        self.clear();
        self.leave();
        self.blocks.branch();
    }

    pub(super) fn close(&mut self) {
        self.clear();
        self.leave();
        self.blocks.close();
        self.open.pop();
    }

    /// What a branch or a loop has set is not there behind it.
    fn leave(&mut self) {
        let depth = self.open.len();
        self.set.retain(|_, inside| *inside < depth);
    }

    /// `B000= 0 TO 5`, behind FOR, of a loop of the script: how often it runs at most.
    pub(super) fn begin_loop(&mut self, text: &[u8], next: usize) -> Option<u32> {
        let parts = memchr::memchr(b'=', text).and_then(|equals| {
            let (name, range) = (text[..equals].trim_ascii(), &text[equals + 1..]);
            let to = crate::program::numbers::word(range, "TO")?;
            let behind = &range[to + 2..];
            let has_step = crate::program::numbers::word(behind, "STEP").is_some();
            let last = words(behind).next().filter(|_| !has_step)?;
            Some((name, range[..to].trim_ascii(), last))
        });
        let Some((name, first, last)) = parts else {
            if let Some(number) = words(text)
                .next()
                .and_then(|word| self.named(word, self.job))
            {
                self.numbers.lose(number);
            }
            self.open_loop(None, None);
            return None;
        };
        for text in [first, last] {
            self.reads(text);
        }
        let ends = [first, last].map(|text| self.present(text));
        let most = match ends {
            [
                Some(Now { of: None, value: a }),
                Some(Now { of: None, value: b }),
            ] => rounds(a, b, 1.0),
            _ => None,
        };
        let counter = self.named(name, self.job);
        self.clear();
        if let Some(counter) = counter {
            let written = Written::Counted([first.into(), last.into()], self.job);
            let site = self.blocks.site();
            self.numbers.write(counter, written, Some(site));
        }
        self.open_loop(most, counter);
        if let Some(counter) = counter {
            self.loops.push((counter, self.blocks.last(), next));
        }
        most
    }

    /// `B000<5`, behind WHILE: each round begins with that.
    pub(super) fn begin_while(&mut self, condition: &[u8]) {
        let inside = self.open_loop(None, None);
        let block = self.blocks.last();
        for (name, relation, limit) in bounds_in(condition) {
            if let Some(number) = self.named(name, self.job) {
                let limit = Written::Text(limit.into(), self.job);
                self.numbers.bound(block, number, (relation, limit));
            }
        }
        self.check((inside, true), condition);
    }

    // ---- what is written

    /// A number becomes what a text says.
    fn write(&mut self, number: u32, text: &[u8]) {
        // another number as the job has just written it
        let other = self.named(text.trim_ascii(), self.job);
        let other = other.and_then(|other| self.texts.get(&other));
        let other = other.filter(|text| text.len() < LONGEST).cloned();
        self.write_as(number, text, other.as_deref().unwrap_or(text));
    }

    /// Likewise; what it comes to elsewhere another text says.
    fn write_as(&mut self, number: u32, text: &[u8], elsewhere: &[u8]) {
        self.reads(text);
        let present = self.present(text);
        self.put(number, present, Written::Text(elsewhere.into(), self.job));
    }

    /// A number becomes something, which is so much here.
    fn put(&mut self, number: u32, present: Option<Now>, written: Written) {
        if self.texts.len() > MOST_NOW || self.now.len() > MOST_NOW {
            self.clear();
        }
        self.forget(number);
        if let Some(present) = present {
            self.now.insert(number, present);
        }
        match &written {
            Written::Text(text, _) => _ = self.texts.insert(number, Rc::clone(text)),
            Written::Sum(terms) => _ = self.sums.insert(number, terms.clone()),
            Written::Counted(..) => {}
        }
        let site = self.blocks.site();
        self.numbers.write(number, written, Some(site));
        self.assigned.insert(number);
        if self.ahead.is_empty() {
            let depth = self.open.len();
            let inside = self.set.entry(number).or_insert(depth);
            *inside = depth.min(*inside);
        }
        if self.is_concurrent {
            self.clear();
        }
    }

    /// An instruction that writes a number, `ADD D000 5`; whether it is one.
    pub(super) fn instruction(&mut self, text: &[u8]) -> bool {
        let mut all = words(text);
        let (first, second) = (
            all.next().unwrap_or_default(),
            all.next().unwrap_or_default(),
        );
        if let [letter @ (b'B' | b'I' | b'D' | b'R'), b'[', ..]
        | [b'L', letter @ (b'B' | b'I' | b'D' | b'R'), b'[', ..] = *second
        {
            self.clear();
            self.any.insert(letter);
            return true;
        }
        let Some(number) = self.named(second, self.job) else {
            return false;
        };
        let behind = || {
            let at = second.as_ptr() as usize - text.as_ptr() as usize + second.len();
            let rest = &text[at..];
            let end = crate::program::numbers::word(rest, "IF").unwrap_or(rest.len());
            rest[..end].trim_ascii()
        };
        match first {
            b"SET" => {
                let value = behind();
                let value = value.strip_prefix(b"EXPRESS").unwrap_or(value);
                self.write(number, value.trim_ascii());
            }
            b"ADD" => self.grow(number, second, b"+", behind()),
            b"SUB" => self.grow(number, second, b"-", behind()),
            b"MUL" => self.grow(number, second, b"*", behind()),
            b"DIV" => self.grow(number, second, b"/", behind()),
            b"INC" => self.grow(number, second, b"+", b"1"),
            b"DEC" => self.grow(number, second, b"-", b"1"),
            b"GETARG" => {
                let argument = super::instruction::numbered(behind(), b"IARG#");
                match argument {
                    Some(argument) => self.write(number, format!("IARG{argument}").as_bytes()),
                    None => self.lose(number),
                }
            }
            b"GETS" | b"DIN" | b"AIN" | b"LOADV" | b"VWAIT" => self.lose(number),
            b"CLEAR" => {
                self.clear();
                self.any
                    .insert(key_of(second, self.job).map_or(0, |key| key.0));
            }
            _ => {
                self.forget(number);
                self.assigned.insert(number);
                self.numbers.give_up(number);
            }
        }
        true
    }

    /// `ADD D000 5`: a number of this name becomes what it was and something more, or so many times
    /// that.
    fn grow(&mut self, number: u32, name: &[u8], sign: &[u8], by: &[u8]) {
        let of = |before: &[u8]| [b"(", before, b")", sign, b"(", by, b")"].concat();
        let before = self.texts.get(&number);
        let before = before.filter(|text| text.len() < LONGEST).cloned();
        let elsewhere = before.map(|before| of(&before));
        let text = of(name);
        self.write_as(number, &text, elsewhere.as_deref().unwrap_or(&text));
    }

    /// `GETE D000 P001 (3)`
    pub(super) fn get(&mut self, word: &[u8], of: Option<(VariableId, usize)>) {
        let Some(number) = self.named(word, self.job) else {
            return;
        };
        // what comes from a position is followed up to the next branch
        self.forget(number);
        self.assigned.insert(number);
        self.numbers.give_up(number);
        if let Some(of) = of {
            let now = Now {
                of: Some(of),
                value: 0.0,
            };
            let element = self.element(of.0, of.1);
            let known = self.now.get(&element).copied();
            self.now.insert(number, known.unwrap_or(now));
        }
    }

    fn lose(&mut self, number: u32) {
        self.forget(number);
        self.assigned.insert(number);
        self.numbers.lose(number);
    }

    /// A number of a position becomes what a text says: that, as far as it was just written.
    pub(super) fn set(&mut self, position: VariableId, at: usize, text: &[u8]) -> Option<Now> {
        let present = self.present(text);
        let element = self.element(position, at);
        let is_part = |now: &Now| now.of == Some((position, at));
        self.now.retain(|_, now| !is_part(now));
        match present {
            // of another position, or not followed
            Some(Now { of: Some(_), .. }) => {
                self.reads(text);
                self.numbers.give_up(element);
                self.forget(element);
            }
            _ => self.write(element, text),
        }
        present
    }

    /// A position becomes another one, or what is not followed.
    pub(super) fn replace(&mut self, position: Option<VariableId>, is_of_robot: bool) {
        let Some(position) = position else {
            self.clear();
            self.any.insert(ELEMENT);
            return;
        };
        self.now
            .retain(|_, now| now.of.is_none_or(|(of, _)| of != position));
        for at in 0..OF_POSITION {
            let element = self.element(position, at);
            self.forget(element);
            if is_of_robot {
                self.numbers.lose(element);
            } else {
                self.numbers.give_up(element);
            }
        }
    }

    /// A job has what a call gives it.
    pub(super) fn give(&mut self, job: u32, argument: u32, text: Option<&[u8]>) {
        let parameter = self.key((ARGUMENT, Some(job), argument));
        let Some(text) = text else {
            self.numbers.lose(parameter);
            return;
        };
        self.reads(text);
        let text: Rc<[u8]> = match self.present(text) {
            Some(Now { of: None, value }) => value.to_string().as_bytes().into(),
            _ => text.into(),
        };
        let written = Written::Text(text, self.job);
        let site = Site::at_start(job);
        self.numbers.write(parameter, written, Some(site));
    }

    /// A job calls another.
    pub(super) fn calls(&mut self, job: u32) {
        self.numbers.calls(self.job, job);
        self.clear();
    }

    /// Numbers that a text reads: what only the running program knows, too, where nothing says that
    /// they were set before.
    fn reads(&mut self, text: &[u8]) {
        let names = text.split(|b| !is_letter(*b));
        for name in names.filter(|name| !name.is_empty()) {
            let Some(number) = self.named(name, self.job) else {
                continue;
            };
            // what calls give is there
            let is_set = name.starts_with(b"IARG")
                || self.now.contains_key(&number)
                || self.set.contains_key(&number)
                || self.open.contains(&Some(number));
            if !is_set {
                self.numbers.lose(number);
            }
        }
    }

    // ---- what they are

    /// What a text comes to, of what was just written.
    pub(super) fn present(&mut self, text: &[u8]) -> Option<Now> {
        let mut of = None;
        let mut is_one = true;
        let job = self.job;
        let (keys, now) = (&self.keys, &self.now);
        let value = evaluate_in(Arithmetic::Typed, text.trim_ascii(), &mut |name| {
            let key = key_of(name, job).and_then(|key| keys.get(&key));
            match key.and_then(|key| now.get(key)) {
                Some(Now { of: None, value }) => Quantity::exactly(*value),
                Some(Now {
                    of: Some(term),
                    value,
                }) => {
                    is_one &= of.replace(*term).is_none_or(|before| before == *term);
                    Quantity::own().plus(Quantity::exactly(*value))
                }
                None => Quantity::unknown(),
            }
        })?;
        let (times, rest) = value.apart();
        let value = rest.exact()?;
        if times == 0.0 {
            return Some(Now { of: None, value });
        }
        (times == 1.0 && is_one).then_some(Now { of, value })
    }

    /// All jobs are read. The loops of the script that may not count as they say.
    pub(super) fn finish(&mut self) -> Vec<usize> {
        self.clear();
        for (&(letter, job, _), &number) in &self.keys {
            if self.any.contains(&letter) {
                self.numbers.give_up(number);
                self.assigned.insert(number);
            }
            if self.calls_others && job.is_none() && letter != ELEMENT {
                self.numbers.lose(number);
                self.assigned.insert(number);
            }
        }
        let assigned = self.loops.iter();
        let assigned = assigned.filter(|(counter, ..)| self.assigned.contains(counter));
        let assigned = assigned.map(|(counter, block, number)| {
            self.numbers.unbounded(*block);
            self.numbers.writes_elsewhere(*counter);
            *number
        });
        assigned.collect()
    }

    fn value(&self, number: u32) -> Quantity {
        let evaluate = |written: &Written, of: &mut dyn FnMut(u32) -> Quantity| match written {
            Written::Text(text, job) => self.evaluated(text, *job, of),
            Written::Counted([from, to], job) => {
                let from = self.evaluated(from, *job, of);
                counted(
                    &from,
                    &self.evaluated(to, *job, of),
                    Some(Quantity::exactly(1.0)),
                )
            }
            Written::Sum(terms) => summed(terms, of),
        };
        self.numbers.value(number, &evaluate)
    }

    fn evaluated(&self, text: &[u8], job: u32, of: &mut dyn FnMut(u32) -> Quantity) -> Quantity {
        evaluated(Arithmetic::Typed, text, &mut |part| match part {
            Part::Name(name) => {
                let key = key_of(name, job).and_then(|key| self.keys.get(&key));
                Some(key.map_or_else(Quantity::endless, |key| of(*key)))
            }
            // any number of an array
            Part::Other(other) if memchr::memchr(b'[', other).is_some() => {
                Some(Quantity::endless())
            }
            Part::Other(_) => None,
        })
    }
}

/// The key of `D000`, `LB001`, and of what calls give, `IARG1`.
fn key_of(word: &[u8], job: u32) -> Option<Key> {
    if let Some(number) = word.strip_prefix(b"IARG") {
        return Some((ARGUMENT, Some(job), number::whole(number)?));
    }
    let (job, word) = match word {
        [b'L', rest @ ..] => (Some(job), rest),
        _ => (None, word),
    };
    match word {
        [letter @ (b'B' | b'I' | b'D' | b'R'), digits @ ..] => {
            Some((*letter, job, number::whole(digits)?))
        }
        _ => None,
    }
}

/// The place of a number in a position, `(3)`.
pub(super) fn place(word: &[u8]) -> Option<usize> {
    let inside = word.strip_prefix(b"(")?.strip_suffix(b")")?;
    let number = number::whole(inside)? as usize;
    (1..=OF_POSITION).contains(&number).then(|| number - 1)
}

/// Whether jobs call some that the files do not have, which may write numbers; and whether some run
/// at the same time.
pub(super) fn shared(jobs: &[Job], lines: &[Vec<Line>]) -> [bool; 2] {
    let mut shared = [false; 2];
    for line in lines.iter().flatten() {
        let mut words = words(line.text);
        let first = words.next().unwrap_or_default();
        let name = words.next().and_then(|name| name.strip_prefix(b"JOB:"));
        let is_here = name.is_some_and(|name| jobs.iter().any(|of| of.name == name));
        match first {
            b"CALL" => shared[0] |= !is_here,
            b"PSTART" => shared = [true; 2],
            _ => shared[0] |= is_macro(first),
        }
    }
    shared
}
