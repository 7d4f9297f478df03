//! Numbers and transformations of languages that write a transformation as six numbers (VAL 3, AS):
//! what the text writes into them, and what they add to a position.

use super::contexts::{Given, Numbered};
use super::displacing::Displacing;
use super::notation::pose_of_turning_angles;
use super::numbers::{Blocks, Numbers, Operand, Site, compared_in, counted, evaluated, rounds};
use super::quantity::{Arithmetic, Quantity, evaluate};
use super::script::short;
use super::words::Words;
use crate::geometry::units::{DEG, MM};
use crate::geometry::{Pose, Rotation};
use foldhash::{HashMap, HashSet};
use std::cell::RefCell;

/// Numbers of a transformation: positions in mm, angles in degrees. What is one number has the
/// first of six.
pub(super) const EACH: u32 = 6;

/// A transformation: steps one after another, each along x, y, z and then about x, the new y, the
/// new z of where it is then.
#[derive(Clone, Debug, Default)]
pub(super) struct Steps(Vec<[Quantity; 6]>);

impl Steps {
    pub(super) fn one(step: [Quantity; 6]) -> Self {
        Self(vec![step])
    }

    /// About one of the axes.
    pub(super) fn about(axis: usize, degrees: Quantity) -> Self {
        let mut step = exactly([0.0; 6]);
        step[3 + axis] = degrees;
        Self::one(step)
    }

    /// What only the running program knows.
    pub(super) fn unknown() -> Self {
        Self::one([(); 6].map(|()| Quantity::unknown()))
    }

    /// What the text works out in a way that is not followed.
    pub(super) fn endless() -> Self {
        Self::one([(); 6].map(|()| Quantity::endless()))
    }

    pub(super) fn then(mut self, next: Self) -> Self {
        self.0.extend(next.0);
        self
    }

    /// Whether only the running program knows all of it.
    pub(super) fn is_unknown(&self) -> bool {
        let is = |number: &Quantity| *number == Quantity::unknown();
        self.0.len() == 1 && self.0[0].iter().all(is)
    }

    /// The steps back.
    pub(super) fn inverse(self) -> Self {
        let steps = self.0.into_iter().rev();
        let back = steps.flat_map(|[x, y, z, rx, ry, rz]| {
            let turns = [(2, rz), (1, ry), (0, rx)];
            let turns = turns.map(|(axis, by)| Self::about(axis, by.times(-1.0)));
            let mut along = exactly([0.0; 6]);
            for (back, by) in along.iter_mut().zip([x, y, z]) {
                *back = by.times(-1.0);
            }
            turns.into_iter().chain([Self::one(along)])
        });
        back.fold(Self::default(), Self::then)
    }

    /// The transformation where the text tells all of it.
    pub(super) fn exact(&self) -> Option<Pose> {
        let mut all = Pose::identity();
        for step in &self.0 {
            let mut numbers = [0.0; 6];
            for (number, of) in numbers.iter_mut().zip(step) {
                *number = of.exact()?;
            }
            all = all * pose_of_turning_angles(numbers);
        }
        Some(all)
    }

    /// Adds these steps in the tool.
    pub(super) fn in_tool(self, by: &mut Displacing) {
        for step in self.0 {
            let mut units = [MM, MM, MM, DEG, DEG, DEG].into_iter();
            by.in_tool(&step.map(|number| number.in_unit(units.next().unwrap_or(1.0))));
        }
    }

    /// Adds what these steps do in a frame of whose axes `turned` makes those of the work frame;
    /// whether it is followed.
    pub(super) fn in_frame(self, turned: &Rotation, by: &mut Displacing) -> bool {
        self.0.into_iter().all(|[x, y, z, angles @ ..]| {
            let is_turn = angles.iter().any(|angle| angle.exact() != Some(0.0));
            along(&[x, y, z], turned, by);
            !is_turn
        })
    }
}

/// Adds a way, mm, along axes of which `turned` makes those of the work frame.
pub(super) fn along(way: &[Quantity; 3], turned: &Rotation, by: &mut Displacing) {
    let sum = |row: [f64; 3]| {
        let parts = way.iter().zip(row);
        let parts = parts.map(|(part, factor)| part.clone().in_unit(factor * MM));
        parts.fold(Quantity::exactly(0.0), Quantity::plus)
    };
    by.along_frame(&turned.0.map(sum));
}

pub(super) fn exactly(numbers: [f64; 6]) -> [Quantity; 6] {
    numbers.map(Quantity::exactly)
}

/// What numbers are, by what the text writes into them.
pub(super) type Of<'o> = dyn FnMut(u32) -> Quantity + 'o;

/// How a language reads the texts that are written into numbers.
pub(super) trait Reads<'a> {
    /// What all texts write into numbers.
    fn entries(&self) -> &Entries<'a>;

    /// The value of an operand in an expression of a routine: a name with its index, a function
    /// with its brackets; `None` of one that is none of the language alone.
    fn operand(&self, operand: &[u8], routine: u32, of: &mut Of) -> Option<Quantity>;

    /// One of the six numbers of the transformation that a text of a routine is.
    fn part(&self, text: &'a [u8], at: usize, routine: u32, of: &mut Of) -> Quantity;

    /// The value of an expression; nothing is 0.
    fn quantity(&self, text: &[u8], routine: u32, of: &mut Of) -> Quantity {
        if text.trim_ascii().is_empty() {
            return Quantity::exactly(0.0);
        }
        evaluated(Arithmetic::Real, text, &mut |operand| {
            let (Operand::Name(operand) | Operand::Other(operand)) = operand;
            self.operand(operand, routine, of)
        })
    }
}

/// What is written into a number.
#[derive(Clone, Copy, Debug)]
pub(super) enum Written<'a> {
    Exactly(f64),
    Text(&'a [u8]),
    /// One of the numbers of the transformation that a text is.
    Part(&'a [u8], usize),
    /// What a loop counts: from, to, and the step.
    Counted([&'a [u8]; 3]),
    /// What another number is.
    Number(u32),
    /// In a way that is not followed.
    Somehow,
}

/// A routine, and the byte of its file at which one of its statements begins.
pub(super) type At = (u32, u32);

/// A loop that counts.
#[derive(Debug)]
struct Counter<'a> {
    number: u32,
    /// Whether that is all that has its name, and no array.
    is_whole: bool,
    /// From, to, and the step.
    texts: [&'a [u8]; 3],
    /// How often it runs at most, where the text tells.
    most: Option<u32>,
    block: (u32, u32),
    routine: u32,
    /// Where the loop begins, and where it ends.
    start: u32,
    end: u32,
}

/// From a step of a routine to the next one (`true`), or to another.
pub(super) type Edge = (u32, bool);

/// What all texts write into numbers.
#[derive(Debug, Default)]
pub(super) struct Entries<'a> {
    /// With the statement whose text it is.
    numbers: Numbers<(Written<'a>, At)>,
    blocks: Blocks,
    routine: u32,
    /// Something goes to a label of the routine from anywhere.
    jumps_anywhere: bool,
    /// Where the present statement begins.
    at: u32,
    counters: Vec<Counter<'a>>,
    /// Routines that run concurrently with others.
    concurrent: Vec<u32>,
    /// What calls give to numbers of routines.
    pub given: Given<Written<'a>>,
    /// By loop, once a statement in it asks: whether what it counts with is written nowhere else
    /// before it ends.
    alone: RefCell<HashMap<At, bool>>,
    /// Numbers that not only loops and calls write.
    assigned: HashSet<u32>,
    /// Numbers that routines are handed: the routine's own, and the caller's.
    handed: Vec<(u32, u32)>,
    /// Numbers that begin with 0, if anything is ever written into them.
    blank: Vec<(u32, Option<Site>)>,
}

impl<'a> Entries<'a> {
    pub(super) fn begin(&mut self, routine: u32) {
        self.end();
        self.routine = routine;
        self.blocks.begin(routine);
    }

    /// The text of the routine ends.
    fn end(&mut self) {
        let flow = std::mem::take(&mut self.blocks.flow);
        if !std::mem::take(&mut self.jumps_anywhere) && !flow.is_empty() {
            self.numbers.goes(self.routine, flow);
        }
    }

    /// A statement begins at a byte of its file.
    pub(super) fn begin_statement(&mut self, at: usize) {
        self.at = short(at);
    }

    fn here(&self) -> At {
        (self.routine, self.at)
    }

    /// A branch begins. The edge by which its statements are come to.
    pub(super) fn open_branch(&mut self) -> Edge {
        (self.blocks.open_branch(), true)
    }

    /// Likewise one of several that `break` leaves.
    pub(super) fn open_switch(&mut self) {
        self.blocks.open_switch();
    }

    /// Likewise a loop that the text does not count.
    pub(super) fn open_loop(&mut self) -> Edge {
        (self.blocks.open_loop(None), true)
    }

    /// Another branch of it begins.
    pub(super) fn branch(&mut self) {
        self.blocks.branch();
    }

    /// A block ends.
    pub(super) fn close(&mut self) {
        self.end_counter();
        self.blocks.close();
    }

    /// A loop ends with a condition. The edge to what is behind it; else it begins again.
    pub(super) fn close_or_repeat(&mut self) -> Option<Edge> {
        Some((self.blocks.close_or_repeat()?, true))
    }

    fn end_counter(&mut self) {
        let last = self.blocks.last();
        let mut counters = self.counters.iter_mut().rev();
        if let Some(counter) = counters.find(|counter| counter.block == last) {
            counter.end = self.at;
        }
    }

    /// `break`
    pub(super) fn leave(&mut self) {
        self.blocks.flow.leave();
    }

    /// The routine ends here.
    pub(super) fn stop(&mut self) {
        self.blocks.flow.stop();
    }

    /// A condition that holds where an edge is gone, and not where the other one of its step is: what it says of
    /// numbers that are these sides of comparisons.
    pub(super) fn check(
        &mut self,
        (step, is_next): Edge,
        condition: &'a [u8],
        number_of: &mut dyn FnMut(&'a [u8]) -> Option<u32>,
    ) {
        for (holds, side, relation, limit) in compared_in(condition) {
            if let Some(number) = number_of(side) {
                let edge = (step, is_next == holds);
                let limit = (Written::Text(limit), self.here());
                self.numbers
                    .check(self.routine, edge, number, (relation, limit));
            }
        }
    }

    /// What a number is before anything runs.
    pub(super) fn declare(&mut self, number: u32, value: Option<f64>) {
        match value {
            Some(value) => {
                let written = (Written::Exactly(value), self.here());
                self.numbers.write(number, written, None);
            }
            None => self.blank.push((number, None)),
        }
    }

    /// A number of a routine's own begins with 0.
    pub(super) fn declare_own(&mut self, number: u32, routine: u32) {
        self.blank.push((number, Some(Site::at_start(routine))));
    }

    /// A number is written, or (not `whole`) one of several that have its name.
    pub(super) fn assign(&mut self, number: u32, written: Written<'a>, is_whole: bool) {
        self.assigned.insert(number);
        if !is_whole {
            self.numbers.writes_elsewhere(number);
        }
        let site = is_whole.then(|| self.blocks.site());
        self.numbers.write(number, (written, self.here()), site);
    }

    /// Likewise a transformation.
    pub(super) fn assign_all(&mut self, first: u32, text: Option<&'a [u8]>, is_whole: bool) {
        for at in 0..EACH {
            let part = |text| Written::Part(text, at as usize);
            let written = text.map_or(Written::Somehow, part);
            self.assign(first + at, written, is_whole);
        }
    }

    /// Something writes a number, or a transformation, that only the running program knows.
    pub(super) fn lose(&mut self, first: u32) {
        for number in first..first + EACH {
            self.assigned.insert(number);
            self.numbers.lose(number);
        }
    }

    /// The texts that are written into the transformation of a first number, each with its routine.
    pub(super) fn transformations(&self, first: u32) -> Vec<(&'a [u8], u32)> {
        let mut open: Vec<u32> = (first..first + EACH).collect();
        let (mut seen, mut found) = (HashSet::default(), Vec::new());
        while let Some(number) = open.pop() {
            if !seen.insert(number) {
                continue;
            }
            for (written, (routine, _)) in self.numbers.writes(number) {
                match *written {
                    Written::Part(text, _) => found.push((text, *routine)),
                    Written::Number(other) => open.push(other),
                    _ => {}
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Whether nothing but calls writes a number.
    pub(super) fn is_only_given(&self, number: u32) -> bool {
        let is_counted = self.counters.iter().any(|counter| counter.number == number);
        !is_counted && !self.assigned.contains(&number)
    }

    /// A label.
    pub(super) fn label(&mut self, key: u64) {
        self.blocks.flow.label(key);
    }

    /// The program goes to a label, or may go there. The edge by which it does.
    pub(super) fn jump(&mut self, key: u64, may: bool) -> Edge {
        self.numbers.jumps(self.routine);
        (self.blocks.flow.jump(key, may), false)
    }

    /// The program may go from anywhere to a label.
    pub(super) fn jumps_anywhere(&mut self) {
        self.numbers.jumps(self.routine);
        self.jumps_anywhere = true;
    }

    pub(super) fn calls(&mut self, callee: u32) {
        self.numbers.calls(self.routine, callee);
    }

    /// A routine runs concurrently with others.
    pub(super) fn starts(&mut self, routine: u32) {
        self.concurrent.push(routine);
    }

    /// A routine is given a number, which is `own` to it, and what is `back` of the caller.
    pub(super) fn give(&mut self, callee: u32, own: u32, given: &'a [u8], back: Option<u32>) {
        self.handed.extend(back.map(|back| (own, back)));
        let written = Written::Text(given);
        self.given.note(callee, self.here(), own, written);
        let written = (written, self.here());
        let site = Site::at_start(callee);
        self.numbers.write(own, written, Some(site));
    }

    /// Likewise a transformation.
    pub(super) fn give_all(&mut self, callee: u32, own: u32, given: &'a [u8], back: Option<u32>) {
        for at in 0..EACH {
            let written = Written::Part(given, at as usize);
            self.given.note(callee, self.here(), own + at, written);
            let written = (written, self.here());
            let site = Site::at_start(callee);
            self.numbers.write(own + at, written, Some(site));
            self.handed.extend(back.map(|back| (own + at, back + at)));
        }
    }

    /// A loop begins that counts: `1 TO 10 STEP 2` with its counter, and whether that is all that
    /// has its name; `None` where it is not known.
    pub(super) fn count(&mut self, counter: Option<(u32, bool)>, words: Words<'a, '_>) {
        let to = words.find(b"TO");
        let (Some((counter, is_whole)), Some(to)) = (counter, to) else {
            self.blocks.open_loop(None);
            return;
        };
        let step = words.find(b"STEP").filter(|step| *step > to);
        let end = step.unwrap_or(words.len());
        let of = [
            words.part(0..to).whole(),
            words.part(to + 1..end).whole(),
            words.behind(end + 1).whole(),
        ];
        let written = (Written::Counted(of), self.here());
        let site = self.blocks.site();
        self.numbers.write(counter, written, Some(site));
        let plain = |text: &[u8]| evaluate(text, &mut |_| Quantity::unknown())?.exact();
        let [from, to, step] = of.map(plain);
        let step = if of[2].is_empty() { Some(1.0) } else { step };
        let most = from.zip(to).zip(step);
        let most = most.and_then(|((from, to), step)| rounds(from, to, step));
        self.numbers.writes_elsewhere(counter);
        self.blocks.open_loop(most);
        self.counters.push(Counter {
            number: counter,
            is_whole,
            texts: of,
            most,
            block: self.blocks.last(),
            routine: self.routine,
            start: self.at,
            end: self.at,
        });
    }

    /// All texts are entries: what routines write into what they are handed comes back, and loops whose
    /// counter something else writes run any number of times.
    pub(super) fn finish(&mut self) {
        self.end();
        let mut open = std::mem::take(&mut self.handed);
        let counted: HashSet<u32> = self.counters.iter().map(|of| of.number).collect();
        loop {
            let is_written = |own: &u32| self.assigned.contains(own) || counted.contains(own);
            let (written, others): (Vec<_>, Vec<_>) =
                open.into_iter().partition(|(own, _)| is_written(own));
            if written.is_empty() {
                break;
            }
            for (own, back) in written {
                self.assign(back, Written::Number(own), false);
            }
            open = others;
        }
        for counter in &self.counters {
            if self.assigned.contains(&counter.number) {
                self.numbers.unbounded(counter.block);
            }
        }
        for (number, site) in std::mem::take(&mut self.blank) {
            // where nothing writes them nothing is meant by that
            if self.numbers.is_written(number) {
                let zero = (Written::Exactly(0.0), self.here());
                self.numbers.write(number, zero, site);
            }
        }
    }

    /// How often the loop that begins at a statement runs at most; `None` where the text does not tell.
    pub(super) fn rounds(&self, at: At) -> Option<u32> {
        let start = |of: &Counter| (of.routine, of.start);
        let before = self.counters.partition_point(|of| start(of) < at);
        let of = self.counters.get(before).filter(|of| start(of) == at)?;
        let is_counted = of.is_whole && self.numbers.is_bounded(of.block);
        of.most.filter(|_| is_counted)
    }

    /// What a number may be at a statement.
    pub(super) fn value(&self, number: u32, at: At, reads: &dyn Reads<'a>) -> Quantity {
        let whenever = &mut |number| self.whenever(number, reads);
        self.value_at(number, at, reads, whenever)
    }

    /// What a number may be whenever it is looked at.
    fn whenever(&self, number: u32, reads: &dyn Reads<'a>) -> Quantity {
        let written = |(written, at): &(Written<'a>, At), of: &mut Of| {
            let mut of_counted = |number| self.value_at(number, *at, reads, of);
            self.written(*written, *at, reads, &mut of_counted)
        };
        self.numbers.value(number, &written)
    }

    /// What is written comes to.
    fn written(
        &self,
        written: Written<'a>,
        (routine, _): At,
        reads: &dyn Reads<'a>,
        of: &mut Of,
    ) -> Quantity {
        match written {
            Written::Exactly(value) => Quantity::exactly(value),
            Written::Text(text) => reads.quantity(text, routine, of),
            Written::Part(text, part) => reads.part(text, part, routine, of),
            Written::Number(number) => of(number),
            Written::Somehow => Quantity::endless(),
            Written::Counted(texts) => {
                let (all, beyond) = counted_by(texts, routine, reads, of);
                // behind the loop the counter is beyond its last value
                all.plus(Quantity::counted(0.0, beyond, Some(1)))
            }
        }
    }

    /// What a number is at a statement: in a loop that counts with it, what that counts.
    fn value_at(&self, number: u32, at: At, reads: &dyn Reads<'a>, of: &mut Of) -> Quantity {
        let Some(counter) = self.counting(number, at) else {
            return of(number);
        };
        let start = (counter.routine, counter.start);
        let mut before = |other| {
            if other == number {
                of(other)
            } else {
                self.value_at(other, start, reads, of)
            }
        };
        counted_by(counter.texts, at.0, reads, &mut before).0
    }

    /// The loop around a statement that counts with a number, where nothing else writes that before
    /// the loop ends.
    fn counting(&self, number: u32, (routine, at): At) -> Option<&Counter<'a>> {
        let loops = || self.counters.iter().filter(|of| of.number == number);
        let around = |of: &&Counter| of.routine == routine && of.start < at && at < of.end;
        let found = loops().filter(around).max_by_key(|of| of.start)?;
        if !found.is_whole || self.assigned.contains(&number) || self.numbers.has_jumps(routine) {
            return None;
        }
        let mut alone = self.alone.borrow_mut();
        let is_alone = alone.entry((routine, found.start)).or_insert_with(|| {
            let is_inside = |of: &Counter| found.start < of.start && of.start < found.end;
            !loops().any(|of| {
                of.routine == routine && is_inside(of)
                    || self
                        .numbers
                        .runs_while(of.routine, routine, &self.concurrent)
            })
        });
        is_alone.then_some(found)
    }
}

/// The numbers of entries, as a language reads them.
pub(super) struct Numbering<'e, 'a>(pub &'e dyn Reads<'a>);

impl<'a> Numbered for Numbering<'_, 'a> {
    type W = Written<'a>;

    fn given(&self) -> &Given<Written<'a>> {
        &self.0.entries().given
    }

    fn is_only_given(&self, number: u32) -> bool {
        self.0.entries().is_only_given(number)
    }

    fn whenever(&self, number: u32) -> Quantity {
        self.0.entries().whenever(number, self.0)
    }

    fn value_at(&self, number: u32, at: At, of: &mut Of) -> Quantity {
        self.0.entries().value_at(number, at, self.0, of)
    }

    fn written(&self, written: Written<'a>, at: At, of: &mut Of) -> Quantity {
        self.0.entries().written(written, at, self.0, of)
    }
}

/// What a loop counts, and by how much a step leads beyond it.
fn counted_by<'a>(
    texts: [&'a [u8]; 3],
    routine: u32,
    reads: &dyn Reads<'a>,
    of: &mut Of,
) -> (Quantity, f64) {
    let [from, to, step] = texts.map(|text| reads.quantity(text, routine, of));
    let step = if texts[2].is_empty() {
        Quantity::exactly(1.0)
    } else {
        step
    };
    let beyond = step.exact().unwrap_or(1.0);
    (counted(&from, &to, Some(step)), beyond)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{Displacement, Stride};

    const STEP: [f64; 6] = [10.0, -20.0, 30.0, 40.0, 50.0, -60.0];

    #[test]
    fn steps_lead_back() {
        let there = Steps::one(exactly(STEP)).then(Steps::about(1, Quantity::exactly(33.0)));
        let pose = there.exact().expect("the text tells it");
        assert_eq!(pose_of_turning_angles(STEP).translation, pose.translation);
        let back = there.clone().inverse().exact().expect("likewise");
        let gap = (pose * back).separation(&Pose::identity());
        assert!(gap.distance_m < 1e-12 && gap.angle_rad < 1e-7, "{gap:?}");
        let mut by = Displacing::new();
        there.in_tool(&mut by);
        let Displacement::By(by) = by.displacement() else {
            panic!("the text tells it");
        };
        assert!(by.in_tool.separation(&pose).distance_m < 1e-12);
    }

    #[test]
    fn a_way_in_another_frame_is_turned_into_the_work_frame() {
        let quarter = Rotation::about_z(std::f64::consts::FRAC_PI_2);
        let mut step = exactly([10.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        step[1] = Quantity::counted(0.0, 5.0, Some(3));
        let mut by = Displacing::new();
        assert!(Steps::one(step).in_frame(&quarter, &mut by));
        let Displacement::Within(strides) = by.displacement() else {
            panic!("either");
        };
        let along = |stride: &Stride| match stride {
            Stride::By { shift, most } => (shift.in_frame.translation, *most),
            _ => panic!("it turns nothing"),
        };
        let (first, _) = along(&strides[0]);
        assert!(first[0].abs() < 1e-12 && (first[1] - 0.01).abs() < 1e-12);
        let (step, most) = along(&strides[1]);
        assert_eq!(most, Some(3));
        assert!((step[0] + 0.005).abs() < 1e-12, "{step:?}");
        assert!(!Steps::one(exactly(STEP)).in_frame(&quarter, &mut Displacing::new()));
    }
}
