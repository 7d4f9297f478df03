//! What the numbers in registers may be: `R[n]`, `PR[n,i]`, and arguments of programs, `AR[n]`.
//!
//! What the program has just written is known, from the last branch, label or call on; elsewhere a
//! register is any of what the text writes into it (see [`crate::program::numbers`]), and what it
//! held before where the text may come to a move without a write.

mod loops;

use super::content::{Content, Entered, Own, canonical};
use super::posreg::Shown;
use super::start::{Step, Steps};
use crate::geometry::Pose;
use crate::program::TargetId;
use crate::program::notation::pose_of_angles;
use crate::program::numbers::{Blocks, Numbers, Site, compared_in};
use crate::program::quantity::Quantity;
use crate::program::script::RoutineId;
use foldhash::{HashMap, HashSet};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Numbers of a position: of the arm, and of other axes.
pub(super) const ELEMENTS: u32 = 9;
/// Those of the arm stand first.
pub(super) const OF_ARM: u32 = 6;
/// Registers have numbers below this.
pub(super) const MOST_NUMBER: u32 = (1 << 19) - 1;
const OF_POSITIONS: u32 = 1 << 24;
const OF_CALLS: u32 = 1 << 30;
/// The label that a register names.
pub(super) const ANY_LABEL: u64 = u64::MAX;
/// Numbers that are known as they were written last.
const MOST_NOW: usize = 512;
/// Texts in a value.
const MOST_TEXTS: usize = 64;

/// One of a position register, the first being 0; any of all registers where those have no number.
pub(super) fn of_position(number: u32, element: u32) -> u32 {
    OF_POSITIONS | number << 4 | element
}

/// An argument of a program.
pub(super) fn of_call(routine: RoutineId, number: u32) -> u32 {
    OF_CALLS | routine << 4 | number
}

/// A register is written that another register names.
fn any_of(number: u32) -> u32 {
    match number {
        OF_CALLS.. => number,
        OF_POSITIONS.. => of_position(MOST_NUMBER, number & 15),
        _ => MOST_NUMBER,
    }
}

/// What the program has just written.
#[derive(Debug)]
struct Written {
    entered: Rc<Entered>,
    site: Site,
    is_settled: bool,
}

/// The way through the present program.
#[derive(Debug, Default)]
struct Path {
    routine: RoutineId,
    order: u32,
    /// Branches that are open.
    depth: u32,
    jumps: Vec<(u32, u64)>,
    labels: HashMap<u64, u32>,
    /// The last move or call.
    last_use: u32,
    /// What it does with numbers, and where it does that in no branch.
    steps: Vec<(Option<u32>, Step)>,
    /// What is written in each of the blocks that are open.
    written: Vec<Vec<u32>>,
}

/// A loop that counts.
#[derive(Debug)]
struct Loop {
    counter: u32,
    block: (u32, u32),
    /// Among those of the script.
    number: usize,
}

/// What is known of the numbers in registers.
#[derive(Debug, Default)]
pub(super) struct Known {
    numbers: Numbers<Rc<Entered>>,
    blocks: Blocks,
    now: BTreeMap<u32, Written>,
    path: Path,
    /// Other programs run at the same time.
    pub is_concurrent: bool,
    steps: Steps,
    all: HashSet<u32>,
    /// Any register may be written.
    any: Vec<(u32, Rc<Entered>)>,
    loops: Vec<Loop>,
    assigned: HashSet<u32>,
    /// Points whose numbers are written into registers.
    pub points: HashMap<(RoutineId, u32), TargetId>,
    /// The numbers of those that nothing rewrites.
    pub values: HashMap<TargetId, [f64; 6]>,
    /// Numbers of other axes that are written one by one, of a register or any: the first of a
    /// position being 0.
    pub axes: HashSet<(Option<u32>, u32)>,
    /// What POSREG.VA shows of registers; `None` where two such files differ.
    pub shown: BTreeMap<u32, Option<Shown>>,
}

impl Known {
    // ---- the way

    pub(super) fn begin(&mut self, routine: RoutineId) {
        self.blocks.begin(routine);
        self.path = Path {
            routine,
            ..Path::default()
        };
    }

    /// The end of a program: what it writes before all moves and calls that a jump may come to.
    pub(super) fn end(&mut self) {
        self.clear();
        let path = std::mem::take(&mut self.path);
        let flow = std::mem::take(&mut self.blocks.flow);
        if !path.jumps.iter().any(|(_, label)| *label == ANY_LABEL) {
            self.numbers.goes(path.routine, flow);
        }
        let last_jump = path.jumps.iter().map(|(at, _)| *at).max().unwrap_or(0);
        // by jumps that come to something else of the program, and by any
        let mut passed = vec![[0_i32; 2]; path.order as usize + 2];
        for (at, label) in &path.jumps {
            let to = path.labels.get(label).copied().unwrap_or(path.order + 1);
            let comes_to_uses = *label == ANY_LABEL || to <= path.last_use || last_jump > to;
            if to > *at {
                let by = [i32::from(comes_to_uses), 1];
                for k in 0..2 {
                    passed[*at as usize][k] += by[k];
                    passed[to as usize][k] -= by[k];
                }
            }
        }
        let mut over = [0, 0];
        for passed in &mut passed {
            over = [over[0] + passed[0], over[1] + passed[1]];
            *passed = over;
        }
        let steps = path.steps.into_iter().filter_map(|(at, step)| {
            let by = at.map(|at| passed[at as usize]);
            let [is_sure, at_end] = [0, 1].map(|k| by.is_some_and(|by| by[k] == 0));
            match step {
                Step::Writes { .. } if !is_sure => None,
                Step::Writes { number, .. } => Some(Step::Writes { number, at_end }),
                Step::Calls { routine, .. } => Some(Step::Calls {
                    routine,
                    is_sure,
                    at_end,
                }),
                step => Some(step),
            }
        });
        self.steps.add(path.routine, steps);
    }

    /// A branch begins. The step from which its statements are the next.
    pub(super) fn open(&mut self) -> u32 {
        self.settle();
        self.path.depth += 1;
        self.path.written.push(Vec::new());
        self.blocks.open_branch()
    }

    /// A statement begins that goes elsewhere, where it is run. The step from which it is the next.
    pub(super) fn open_jump(&mut self) -> u32 {
        self.blocks.open_branch()
    }

    pub(super) fn close_jump(&mut self) {
        self.blocks.close();
    }

    /// The program ends here.
    pub(super) fn stop(&mut self) {
        self.blocks.flow.stop();
    }

    /// From a step the program goes to the next where a condition holds, else elsewhere.
    pub(super) fn check(&mut self, step: u32, condition: &[u8]) {
        let condition = canonical(condition);
        for (holds, side, relation, limit) in compared_in(&condition) {
            if let Some(number) = self.alone(side) {
                let limit = self.entered(u32::MAX, limit, 0);
                self.reads(&limit);
                let (at, limited) = ((step, holds), (relation, Rc::new(limit)));
                self.numbers.check(self.path.routine, at, number, limited);
            }
        }
    }

    /// The number that a text is.
    fn alone(&self, text: &[u8]) -> Option<u32> {
        let mut all = Vec::new();
        let value = self.of_text(text, (0, self.path.routine), &mut |number| {
            all.push(number);
            Quantity::own()
        });
        let [number] = all[..] else { return None };
        (value == Quantity::own()).then_some(number)
    }

    /// Another branch begins: what the one before has written is not there.
    pub(super) fn branch(&mut self) {
        self.leave_branch();
        self.blocks.branch();
    }

    fn leave_branch(&mut self) {
        self.settle();
        match self.path.written.last() {
            Some(written) => written
                .iter()
                .for_each(|number| _ = self.now.remove(number)),
            None => self.now.clear(),
        }
    }

    pub(super) fn close(&mut self) {
        self.leave_branch();
        self.path.depth = self.path.depth.saturating_sub(1);
        let written = self.path.written.pop().unwrap_or_default();
        if let Some(around) = self.path.written.last_mut() {
            around.extend(written);
        }
        self.blocks.close();
    }

    /// A number is written in the block that is open.
    fn note_written(&mut self, number: u32) {
        if let Some(block) = self.path.written.last_mut() {
            block.push(number);
        }
    }

    pub(super) fn label(&mut self, key: u64) {
        self.clear();
        self.path.order += 1;
        self.path.labels.insert(key, self.path.order);
        self.blocks.flow.label(key);
    }

    /// The program goes to a label, or may go there.
    pub(super) fn jump(&mut self, key: u64, may: bool) {
        self.settle();
        self.blocks.flow.jump(key, may);
        self.path.order += 1;
        self.path.jumps.push((self.path.order, key));
        self.numbers.jumps(self.path.routine);
    }

    /// A program is called, or one of several.
    pub(super) fn calls(&mut self, routine: RoutineId, is_one: bool) {
        self.numbers.calls(self.path.routine, routine);
        self.moves();
        let at = Some(self.path.order).filter(|_| is_one && self.path.depth == 0);
        let is_sure = at.is_some();
        self.path.steps.push((
            at,
            Step::Calls {
                routine,
                is_sure,
                at_end: is_sure,
            },
        ));
    }

    /// A program is started next to this one.
    pub(super) fn starts(&mut self, routine: RoutineId) {
        self.steps.starts(routine);
    }

    /// A position register is read as it is.
    pub(super) fn reads_position(&mut self, number: u32) {
        let all = (0..ELEMENTS).map(|element| of_position(number, element));
        let open = all.filter(|number| !self.now.contains_key(number));
        let steps = open.map(|number| (None, Step::Reads(number)));
        self.path.steps.extend(steps);
    }

    /// Likewise the one that an index, `R[1]`, tells.
    pub(super) fn reads_any_position(&mut self, index: &[u8]) {
        let entered = self.entered(u32::MAX, index, 0);
        self.reads(&entered);
        self.path.steps.push((None, Step::ReadsAny));
    }

    /// What is computed reads numbers as they are.
    pub(super) fn reads(&mut self, entered: &Entered) {
        let read = entered.read.iter();
        let steps = read.map(|number| (None, Step::Reads(*number)));
        self.path.steps.extend(steps);
    }

    /// A move that may be displaced.
    pub(super) fn moves(&mut self) {
        self.path.order += 1;
        self.path.last_use = self.path.order;
    }

    // ---- what is written

    /// What a number becomes, by a text without names.
    pub(super) fn entered(&self, own: u32, text: &[u8], element: usize) -> Entered {
        let at = (element, self.path.routine);
        let mut read = Vec::new();
        let now = |number| self.now.get(&number).map(|written| &written.entered);
        let known = |number| now(number).and_then(|entered| entered.exact());
        let value = |number| known(number).map_or_else(Quantity::unknown, Quantity::exactly);
        let whole = self.of_text(text, at, &mut |number| {
            read.push(number);
            value(number)
        });
        let count = read.len();
        let size = read
            .iter()
            .map(|number| now(*number).map_or(1, |entered| entered.size));
        let size = 1 + size.sum::<usize>();
        read.sort_unstable();
        read.dedup();
        let is_own = read.contains(&own) && now(own).is_none();
        // what is subtracted from itself is nothing
        let without = |one: u32| {
            let mut of = |number| {
                if number == one {
                    Quantity::own()
                } else {
                    value(number)
                }
            };
            let (times, rest) = self.of_text(text, at, &mut of).apart();
            rest.exact().filter(|_| times == 0.0)
        };
        let mut twice = read.iter().filter(|_| read.len() < count);
        let exact = whole
            .exact()
            .or_else(|| twice.find_map(|one| without(*one)));
        let bound = read.iter().filter_map(|number| {
            let entered = now(*number)?;
            Some((*number, Rc::clone(entered)))
        });
        let content = match exact {
            Some(exact) => Content::Exactly(exact),
            None if size > MOST_TEXTS => Content::Endless,
            None => Content::Text(text.into()),
        };
        let is_text = matches!(content, Content::Text(_));
        let read = read.iter().copied();
        let read = read.filter(|number| is_text && now(*number).is_none());
        Entered {
            content,
            element,
            routine: at.1,
            bound: bound.filter(|_| is_text).collect(),
            size: if is_text { size } else { 1 },
            is_own: is_text && is_own,
            read: read.collect(),
        }
    }

    /// A number becomes something.
    pub(super) fn write(&mut self, number: u32, entered: Entered) {
        self.path.order += 1;
        self.reads(&entered);
        if self.path.depth == 0 && !entered.is_own {
            let step = (
                Some(self.path.order),
                Step::Writes {
                    number,
                    at_end: true,
                },
            );
            self.path.steps.push(step);
        }
        let written = Written {
            entered: Rc::new(entered),
            site: self.blocks.site(),
            is_settled: false,
        };
        self.assigned.insert(number);
        self.note_written(number);
        if self.now.len() > MOST_NOW {
            self.clear();
        }
        if written.entered.is_own {
            // it adds up: how often is known once all programs are read
            self.settle();
            self.now.retain(|_, of| !of.entered.has_read(number));
            self.all.insert(number);
            self.numbers
                .write(number, written.entered, Some(written.site));
            return;
        }
        self.now.insert(number, written);
        if self.is_concurrent {
            self.clear();
        }
    }

    /// A register becomes something, and another register says which.
    pub(super) fn write_any(&mut self, of: u32, entered: Entered) {
        self.reads(&entered);
        self.clear();
        self.any.push((any_of(of), Rc::new(entered)));
    }

    /// Something else may write a number.
    pub(super) fn lose(&mut self, number: u32) {
        self.settle();
        self.now.remove(&number);
        self.note_written(number);
        self.assigned.insert(number);
        self.all.insert(number);
        self.numbers.lose(number);
    }

    /// A program has what a call gives it.
    pub(super) fn give(&mut self, routine: RoutineId, number: u32, text: &[u8]) {
        let parameter = of_call(routine, number);
        let entered = Rc::new(self.entered(parameter, text, 0));
        self.reads(&entered);
        let site = Some(Site::at_start(routine));
        self.numbers.write(parameter, entered, site);
    }

    /// What was written is all that is known elsewhere.
    pub(super) fn settle(&mut self) {
        for (&number, written) in &mut self.now {
            if std::mem::replace(&mut written.is_settled, true) {
                continue;
            }
            let (entered, site) = (Rc::clone(&written.entered), written.site.clone());
            self.all.insert(number);
            self.numbers.write(number, entered, Some(site));
        }
    }

    /// What was written may not be there any more.
    pub(super) fn clear(&mut self) {
        self.settle();
        self.now.clear();
    }

    // ---- what they are

    /// What the program has just written into a number.
    pub(super) fn now(&self, number: u32) -> Option<Rc<Entered>> {
        self.now
            .get(&number)
            .map(|written| Rc::clone(&written.entered))
    }

    /// The pose of a register all of whose numbers are known.
    pub(super) fn pose(&self, register: u32) -> Option<Pose> {
        let mut values = [0.0; 6];
        for (value, element) in values.iter_mut().zip(0..) {
            *value = self.now(of_position(register, element))?.exact()?;
        }
        Some(pose_of_angles(values))
    }

    /// The number as the text writes it, or any.
    pub(super) fn existing(&self, number: u32) -> u32 {
        if self.numbers.is_written(number) {
            number
        } else {
            any_of(number)
        }
    }

    /// All programs are read. The loops of the script that do not count as they say.
    pub(super) fn finish(&mut self) -> Vec<usize> {
        let is_any = |number: u32| number == any_of(number);
        let held = self.write_shown();
        for (of, entered) in std::mem::take(&mut self.any) {
            let concerned = self.all.iter().filter(|number| any_of(**number) == of);
            for number in concerned.copied().chain([of]).collect::<Vec<_>>() {
                self.numbers.write(number, Rc::clone(&entered), None);
                self.numbers.writes_elsewhere(number);
                self.assigned.insert(number);
            }
            self.numbers.lose(of);
        }
        let positions = self.all.iter().copied();
        let positions = positions.filter(|number| (OF_POSITIONS..OF_CALLS).contains(number));
        let read = self.steps.read_before(&positions.collect::<Vec<_>>());
        for &number in &self.all {
            if read.contains(&number) && !is_any(number) {
                let is_counter = self.loops.iter().any(|of| of.counter == number);
                if let Some(value) = held.get(&number) {
                    let entered = Entered::of(Content::Exactly(*value), self.path.routine);
                    self.numbers.write(number, Rc::new(entered), None);
                } else if !is_counter || self.assigned.contains(&number) {
                    self.numbers.lose(number);
                }
            }
        }
        let assigned = self.loops.iter();
        let assigned = assigned.filter(|of| self.assigned.contains(&of.counter));
        let assigned = assigned.map(|of| {
            self.numbers.unbounded(of.block);
            self.numbers.writes_elsewhere(of.counter);
            of.number
        });
        assigned.collect()
    }

    /// Numbers of registers that no program writes are what a file of the controller shows. Hands
    /// over the others, which are that before they are written.
    fn write_shown(&mut self) -> HashMap<u32, f64> {
        let written_by_index: HashSet<u32> = self.any.iter().map(|(of, _)| *of).collect();
        let mut held = HashMap::default();
        for (&register, shown) in &self.shown {
            let values = (0..ELEMENTS).zip(shown.iter().flatten());
            for (number, value) in values.map(|(at, value)| (of_position(register, at), value)) {
                let is_written = self.all.contains(&number);
                if !is_written {
                    let entered = Entered::of(Content::Exactly(*value), self.path.routine);
                    self.numbers.write(number, Rc::new(entered), None);
                }
                let may_be_written = written_by_index.contains(&any_of(number));
                if may_be_written {
                    self.all.insert(number);
                }
                if is_written || may_be_written {
                    held.insert(number, *value);
                }
            }
        }
        held
    }

    /// What is written comes to; `own` where that number stands for itself.
    pub(super) fn value(&self, entered: &Entered, own: Option<Own>) -> Quantity {
        self.evaluate(entered, own, &mut |number| self.anywhere(number))
    }

    /// What a number may be anywhere.
    pub(super) fn anywhere(&self, number: u32) -> Quantity {
        let evaluate = |entered: &Rc<Entered>, of: &mut dyn FnMut(u32) -> Quantity| {
            self.evaluate(entered, None, of)
        };
        self.numbers.value(self.existing(number), &evaluate)
    }

    /// Whether the text writes numbers of positions.
    pub(super) fn writes_positions(&self) -> bool {
        let is_position = |number: &u32| (OF_POSITIONS..OF_CALLS).contains(number);
        self.all.iter().any(is_position)
            || !self.shown.is_empty()
            || self.numbers.is_written(of_position(MOST_NUMBER, 0))
    }

    /// The present program.
    pub(super) fn routine(&self) -> RoutineId {
        self.path.routine
    }
}
