//! What the numbers of a program may be, from all that its text writes into them.
//!
//! A number that nothing writes but its declaration is that. One that is assigned itself and
//! something more adds up: as often as the loops around that assignment count where the same
//! routine sets it anew before, or as conditions let it, else any number of times.

mod blocks;
mod bounds;
mod flow;
mod joins;
mod present;
mod questions;
mod rounds;

pub(super) use blocks::{Blocks, Site};
pub(super) use bounds::{bounds_in, compared_in, inside_brackets};
use flow::Flow;
pub(super) use joins::{First, logic};
pub(super) use questions::{Literal, Question, cases, equality, names_asked, questions};

use super::functions;
use super::quantity::{Arithmetic, Quantity, evaluate_in, is_letter};
use foldhash::{HashMap, HashSet};
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// Numbers that are computed from each other that are followed.
const DEEPEST: usize = 24;
/// Rounds of a loop that are counted.
const MOST_ROUNDS: f64 = 1e6;
/// Of a round, so that what controllers add up in single precision may come to a last one:
/// 0.1 + 0.1 + 0.1 is not above 0.3.
const OF_SUMS: f64 = 1e-3;

/// What is known of a number; `W` is what the text writes into it.
#[derive(Debug)]
struct Facts<W> {
    writes: Vec<(W, Option<Site>)>,
    /// Something that only the running program knows may write it.
    is_lost: bool,
    /// It may be written in a way that is not followed.
    is_endless: bool,
    /// It is also written where no site tells.
    is_elsewhere: bool,
    /// One of several numbers of this name is written, and which is not followed.
    is_scattered: bool,
}

impl<W> Default for Facts<W> {
    fn default() -> Self {
        Self {
            writes: Vec::new(),
            is_lost: false,
            is_endless: false,
            is_elsewhere: false,
            is_scattered: false,
        }
    }
}

/// The numbers of a program, by what the language calls them.
#[derive(Debug)]
pub(super) struct Numbers<W> {
    facts: HashMap<u32, Facts<W>>,
    /// Routines in which the program goes elsewhere than to the next statement.
    jumping: HashSet<u32>,
    /// Blocks that run any number of times.
    unbounded: HashSet<(u32, u32)>,
    /// What bounds numbers in the rounds of a block: `WHILE n<10`.
    bounds: Vec<bounds::Bound<W>>,
    /// How routines go from label to label, and what conditions say on the way.
    flows: HashMap<u32, Flow>,
    checks: Vec<rounds::Check<W>>,
    bounded: RefCell<HashMap<u32, Option<Rc<rounds::Bounded>>>>,
    work_left: Cell<usize>,
    /// The routines that each calls.
    calls: HashMap<u32, HashSet<u32>>,
    /// Routines that run at any time.
    concurrent: HashSet<u32>,
    /// Numbers that are one with another.
    same: HashMap<u32, u32>,
    known: RefCell<HashMap<u32, Quantity>>,
    /// A statement calls a routine that only the running program knows.
    calls_any: bool,
    /// Where routines stand behind which writes, in the order of the text.
    marks: HashMap<u32, Vec<present::Mark>>,
    owns: RefCell<HashMap<u32, Option<Rc<present::Own>>>>,
    /// Whether routines are followed statement by statement.
    followed: RefCell<HashMap<u32, bool>>,
}

impl<W> Default for Numbers<W> {
    fn default() -> Self {
        Self {
            facts: HashMap::default(),
            jumping: HashSet::default(),
            unbounded: HashSet::default(),
            bounds: Vec::new(),
            flows: HashMap::default(),
            checks: Vec::new(),
            bounded: RefCell::default(),
            work_left: Cell::new(rounds::MOST_WORK),
            calls: HashMap::default(),
            concurrent: HashSet::default(),
            same: HashMap::default(),
            known: RefCell::default(),
            calls_any: false,
            marks: HashMap::default(),
            owns: RefCell::default(),
            followed: RefCell::default(),
        }
    }
}

/// Evaluates what is written, with the values of the numbers in it.
pub(super) type Evaluate<'a, W> = dyn Fn(&W, &mut dyn FnMut(u32) -> Quantity) -> Quantity + 'a;

impl<W> Numbers<W> {
    /// A number is written; without a site by its declaration.
    pub(super) fn write(&mut self, number: u32, what: W, site: Option<Site>) {
        self.facts_of(number).writes.push((what, site));
    }

    fn facts_of(&mut self, number: u32) -> &mut Facts<W> {
        let number = self.one(number);
        self.facts.entry(number).or_default()
    }

    /// What stands for all that are one with a number.
    fn one(&self, mut number: u32) -> u32 {
        while let Some(&other) = self.same.get(&number) {
            number = other;
        }
        number
    }

    /// Two numbers are one: a variable, and the parameter by reference that it is given for.
    pub(super) fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.one(a), self.one(b));
        if a == b {
            return;
        }
        self.same.insert(b, a);
        if let Some(facts) = self.facts.remove(&b) {
            let of = self.facts_of(a);
            of.writes.extend(facts.writes);
            of.is_lost |= facts.is_lost;
            of.is_endless |= facts.is_endless;
            of.is_elsewhere |= facts.is_elsewhere;
            of.is_scattered |= facts.is_scattered;
        }
    }

    /// What the text writes into a number.
    pub(super) fn writes(&self, number: u32) -> impl Iterator<Item = &W> {
        let facts = self.facts.get(&self.one(number)).into_iter();
        facts.flat_map(|facts| facts.writes.iter().map(|(what, _)| what))
    }

    /// Whether the text writes a number.
    pub(super) fn is_written(&self, number: u32) -> bool {
        self.facts.contains_key(&self.one(number))
    }

    /// Whether nothing writes a number but so many texts.
    pub(super) fn is_only_written(&self, number: u32, times: usize) -> bool {
        let facts = self.facts.get(&self.one(number));
        let is_own = self.one(number) == number && !self.same.values().any(|of| *of == number);
        is_own
            && facts.is_some_and(|facts| {
                facts.writes.len() == times && !facts.is_lost && !facts.is_endless
            })
    }

    /// What only the running program knows writes a number.
    pub(super) fn lose(&mut self, number: u32) {
        self.facts_of(number).is_lost = true;
    }

    /// A number is written in a way that is not followed.
    pub(super) fn give_up(&mut self, number: u32) {
        self.facts_of(number).is_endless = true;
    }

    /// The program jumps inside a routine.
    pub(super) fn jumps(&mut self, routine: u32) {
        self.jumping.insert(routine);
    }

    /// Whether the program jumps inside a routine.
    pub(super) fn has_jumps(&self, routine: u32) -> bool {
        self.jumping.contains(&routine)
    }

    /// Whether a routine may run while another does: that calls it, or one of the two runs
    /// concurrently with others.
    pub(super) fn runs_while(&self, routine: u32, other: u32, concurrent: &[u32]) -> bool {
        if self.called_by(vec![other]).contains(&routine) {
            return true;
        }
        let mut at_any_time = self.called_by(concurrent.to_vec());
        at_any_time.extend(concurrent);
        routine != other && (at_any_time.contains(&routine) || at_any_time.contains(&other))
    }

    /// How a routine goes from label to label, where its jumps are followed.
    pub(super) fn goes(&mut self, routine: u32, mut flow: Flow) {
        flow.end();
        self.flows.insert(routine, flow);
    }

    /// A number is also written where no site tells: by a loop that counts, or by an index.
    pub(super) fn writes_elsewhere(&mut self, number: u32) {
        self.facts_of(number).is_elsewhere = true;
    }

    /// A statement writes one of several numbers that this stands for.
    pub(super) fn scatters(&mut self, number: u32) {
        self.facts_of(number).is_scattered = true;
    }

    /// A block, by its routine and number, runs any number of times.
    pub(super) fn unbounded(&mut self, block: (u32, u32)) {
        self.unbounded.insert(block);
    }

    /// Whether a block runs no more often than where it begins says.
    pub(super) fn is_bounded(&self, block: (u32, u32)) -> bool {
        !self.unbounded.contains(&block)
    }

    /// A routine calls another.
    pub(super) fn calls(&mut self, caller: u32, callee: u32) {
        self.calls.entry(caller).or_default().insert(callee);
    }

    /// A statement calls a routine that only the running program knows: it may be any.
    pub(super) fn calls_any(&mut self) {
        self.calls_any = true;
    }

    /// An interrupt or a thread runs a routine.
    pub(super) fn runs_at_any_time(&mut self, routine: u32) {
        self.concurrent.insert(routine);
    }

    /// The routines that these call, and so on.
    fn called_by(&self, mut open: Vec<u32>) -> HashSet<u32> {
        let mut seen = HashSet::default();
        while let Some(callees) = open.pop().map(|one| self.calls.get(&one)) {
            for &callee in callees.into_iter().flatten() {
                if seen.insert(callee) {
                    open.push(callee);
                }
            }
        }
        seen
    }

    /// Whether a routine may run again before it has ended: it calls itself, or an interrupt or
    /// thread calls it as others do.
    fn runs_inside_itself(&self, routine: u32) -> bool {
        if self.called_by(vec![routine]).contains(&routine) {
            return true;
        }
        if self.concurrent.is_empty() {
            return false;
        }
        let mut at_any_time = self.called_by(self.concurrent.iter().copied().collect());
        at_any_time.extend(&self.concurrent);
        let is_called = |(caller, callees): (&u32, &HashSet<u32>)| {
            callees.contains(&routine) && !at_any_time.contains(caller)
        };
        at_any_time.contains(&routine) && self.calls.iter().any(is_called)
    }

    /// What a number may be, whenever it is looked at.
    pub(super) fn value(&self, number: u32, evaluate: &Evaluate<W>) -> Quantity {
        self.value_in(number, evaluate, &mut Vec::new())
    }

    fn value_in(&self, number: u32, evaluate: &Evaluate<W>, open: &mut Vec<u32>) -> Quantity {
        let number = self.one(number);
        if let Some(known) = self.known.borrow().get(&number) {
            return known.clone();
        }
        // numbers that are computed from each other in a circle may add up
        if open.contains(&number) || open.len() > DEEPEST {
            return Quantity::endless();
        }
        open.push(number);
        let value = self.computed(number, evaluate, open);
        open.pop();
        self.known.borrow_mut().insert(number, value.clone());
        value
    }

    fn computed(&self, number: u32, evaluate: &Evaluate<W>, open: &mut Vec<u32>) -> Quantity {
        let Some(facts) = self.facts.get(&number) else {
            return Quantity::unknown();
        };
        if facts.is_endless {
            return Quantity::endless();
        }
        let Some(gathered) = self.gathered(number, evaluate, open) else {
            return Quantity::endless();
        };
        let mut value = Quantity::any(&gathered.all);
        for (by, site) in &gathered.growing {
            // what else writes it may be what sets it anew, or may not
            let most = site.and_then(|site| {
                let most = self.most(site, &gathered.resets);
                most.or_else(|| {
                    let is_alone = gathered.is_alone();
                    let start = is_alone.then_some(&gathered.all[..])?;
                    let mut limit = |what: &W| {
                        let mut of = |other: u32| self.value_in(other, evaluate, open);
                        evaluate(what, &mut of)
                    };
                    self.rounds_within(number, site, by, start, &mut limit)
                })
            });
            let most = most.or_else(|| self.rounds_between(number, &gathered, evaluate, open));
            value = value.plus(again(by, most));
            if gathered.is_turned {
                value = value.plus(again(&by.clone().times(-1.0), most));
            }
        }
        value
    }

    /// What a number is set to, and what is added to it; `None` where it becomes something else of
    /// itself.
    fn gathered(
        &self,
        number: u32,
        evaluate: &Evaluate<W>,
        open: &mut Vec<u32>,
    ) -> Option<Gathered<'_>> {
        let facts = self.facts.get(&number)?;
        let mut gathered = Gathered::default();
        for (what, site) in &facts.writes {
            let mut of = |other: u32| {
                if self.one(other) == number {
                    Quantity::own()
                } else {
                    self.value_in(other, evaluate, open)
                }
            };
            let (own, rest) = evaluate(what, &mut of).apart();
            if own == 0.0 {
                gathered.all.push(rest);
                gathered.resets.extend(site);
            } else if own == 1.0 {
                gathered.growing.push((rest, site.as_ref()));
            } else if own == -1.0 && rest.exact() == Some(0.0) {
                gathered.is_turned = true;
            } else {
                return None;
            }
        }
        (gathered.is_lost, gathered.is_elsewhere) = (facts.is_lost, facts.is_elsewhere);
        if facts.is_lost {
            gathered.all.push(Quantity::unknown());
        }
        if gathered.is_turned {
            let all = gathered.all.iter();
            let turned: Vec<_> = all.map(|value| value.clone().times(-1.0)).collect();
            gathered.all.extend(turned);
        }
        Some(gathered)
    }

    /// How often at most a write is come to between two that set the number anew.
    fn most(&self, site: &Site, resets: &[&Site]) -> Option<u32> {
        if self.jumping.contains(&site.routine) || self.runs_inside_itself(site.routine) {
            return None;
        }
        let mut before: Vec<_> = resets
            .iter()
            .filter(|reset| {
                reset.routine == site.routine
                    && reset.order < site.order
                    && site.blocks.starts_with(&reset.blocks)
            })
            .collect();
        before.sort_unstable_by_key(|reset| reset.order);
        let inside = &site.blocks[before.last()?.blocks.len()..];
        inside.iter().try_fold(1_u32, |product, block| {
            let is_bounded = self.is_bounded((site.routine, block.number));
            Some(product.saturating_mul(block.most.filter(|_| is_bounded)?))
        })
    }
}

/// What the text makes of a number.
#[derive(Debug, Default)]
struct Gathered<'a> {
    /// All that it is set to.
    all: Vec<Quantity>,
    /// Where that is.
    resets: Vec<&'a Site>,
    /// What is added to it, and where.
    growing: Vec<(Quantity, Option<&'a Site>)>,
    /// It may change its sign.
    is_turned: bool,
    /// Something that only the running program knows may write it.
    is_lost: bool,
    /// It is also written where no site tells.
    is_elsewhere: bool,
}

impl Gathered<'_> {
    /// Whether it grows at one place alone, from what the text tells.
    fn is_alone(&self) -> bool {
        self.growing.len() == 1 && !self.is_turned && !self.is_lost
    }
}

/// What is added up to so often; `None` where nothing bounds that.
fn again(by: &Quantity, most: Option<u32>) -> Quantity {
    if most == Some(1) {
        // made or not
        return Quantity::any(&[Quantity::exactly(0.0), by.clone()]);
    }
    match by.ends() {
        Some((least, greatest)) => [least.min(0.0), greatest.max(0.0)]
            .into_iter()
            .map(|by| Quantity::counted(0.0, by, most))
            .fold(Quantity::exactly(0.0), Quantity::plus),
        None => Quantity::endless(),
    }
}

/// What a loop counts with, from one number to another.
pub(super) fn counted(from: &Quantity, to: &Quantity, step: Option<Quantity>) -> Quantity {
    if let (Some(first), Some(last)) = (from.exact(), to.exact()) {
        let step = match step.map(|step| step.exact()) {
            None => Some(1.0_f64.copysign(last - first)),
            Some(step) => step,
        };
        if let Some(step) = step.filter(|step| *step != 0.0) {
            return match rounds(first, last, step) {
                // a loop that never runs counts nothing
                Some(rounds) => Quantity::counted(first, step, Some(rounds - 1)),
                None => Quantity::between(first.min(last), first.max(last)),
            };
        }
    }
    match (from.ends(), to.ends()) {
        (Some((a, b)), Some((c, d))) => Quantity::between(a.min(c), b.max(d)),
        _ if from.is_endless() || to.is_endless() => Quantity::endless(),
        _ => Quantity::unknown(),
    }
}

/// How often a loop runs at most that counts from one number to another; `None` where it does not
/// end, or not before many rounds.
pub(super) fn rounds(from: f64, to: f64, step: f64) -> Option<u32> {
    let more = ((to - from) / step + OF_SUMS).floor();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let rounds = |more: f64| more.max(0.0) as u32 + 1;
    (step != 0.0 && more < MOST_ROUNDS).then(|| rounds(more))
}

/// What stands in an expression for a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operand<'a> {
    /// A name alone.
    Name(&'a [u8]),
    /// A name with what belongs to it: `p.trans.z`, `q[2]`, `Abs(x)`.
    Other(&'a [u8]),
}

/// The value of an expression; `of` gives that of names, and of other operands where the language
/// knows it. Of the rest an element of an array, `h{2}`, may be any of them, and so may a list;
/// functions of arithmetic are worked out; nothing bounds what any other operand is.
pub(super) fn evaluated(
    arithmetic: Arithmetic,
    text: &[u8],
    of: &mut dyn FnMut(Operand) -> Option<Quantity>,
) -> Quantity {
    evaluated_inside(arithmetic, text, of, 0)
}

/// Likewise, inside so many calls.
fn evaluated_inside(
    arithmetic: Arithmetic,
    text: &[u8],
    of: &mut dyn FnMut(Operand) -> Option<Quantity>,
    depth: usize,
) -> Quantity {
    if depth > DEEPEST {
        return Quantity::endless();
    }
    if let Some(inside) = list(text.trim_ascii()) {
        let all = inside.map(|part| evaluated_inside(arithmetic, part, of, depth + 1));
        return Quantity::any(&all.collect::<Vec<_>>());
    }
    let value = evaluate_in(arithmetic, text, &mut |operand| {
        let length = operand.iter().take_while(|b| is_letter(**b)).count();
        let (name, rest) = operand.split_at(length);
        let known = match rest {
            [] => of(Operand::Name(name)),
            _ => of(Operand::Other(operand)),
        };
        if let Some(known) = known {
            return known;
        }
        match rest.trim_ascii_start() {
            [b'{' | b'[', inside @ .., b'}' | b']'] if !inside.contains(&b'.') => {
                let value = of(Operand::Name(name)).unwrap_or_else(Quantity::endless);
                if value.adds_up() {
                    Quantity::endless()
                } else {
                    value
                }
            }
            [b'(', inside @ .., b')'] => {
                let given = parts(inside).map(|part| {
                    // without options
                    let end = memchr::memchr(b'\\', part).unwrap_or(part.len());
                    evaluated_inside(arithmetic, &part[..end], of, depth + 1)
                });
                functions::value(name, &given.collect::<Vec<_>>())
            }
            _ => Quantity::endless(),
        }
    });
    value.unwrap_or_else(Quantity::endless)
}

/// The numbers of a list, `[[1,2],[3,4]]`.
fn list(text: &[u8]) -> Option<impl Iterator<Item = &[u8]>> {
    let inside = text.strip_prefix(b"[")?.strip_suffix(b"]")?;
    let parts = inside.split(|byte| matches!(byte, b'[' | b']' | b','));
    Some(parts.filter(|part| !part.trim_ascii().is_empty()))
}

/// What stands between the commas of a list, up to the bracket that closes it.
pub(super) fn parts(inside: &[u8]) -> impl Iterator<Item = &[u8]> {
    let deeper = |byte: u8| {
        i32::from(matches!(byte, b'(' | b'[' | b'{'))
            - i32::from(matches!(byte, b')' | b']' | b'}'))
    };
    let mut depth = 0_i32;
    let end = inside.iter().position(|byte| {
        depth += deeper(*byte);
        depth < 0
    });
    let mut depth = 0_i32;
    inside[..end.unwrap_or(inside.len())].split(move |byte| {
        depth += deeper(*byte);
        depth == 0 && *byte == b','
    })
}

/// Where a word stands by itself.
pub(super) fn word(text: &[u8], word: &str) -> Option<usize> {
    let is_letter =
        |byte: Option<&u8>| byte.is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_');
    memchr::memmem::find_iter(text, word.as_bytes()).find(|&at| {
        let before = at.checked_sub(1).and_then(|at| text.get(at));
        !is_letter(before) && !is_letter(text.get(at + word.len()))
    })
}

#[cfg(test)]
mod tests;
