//! What instructions add to copies of positions: `ADD LP001 P002`, `SETE LP001 (3) D005`.
//!
//! What only the running robot knows displaces a copy as a sensor does. Another position displaces
//! it by its numbers, which are what the files have and what jobs write into them (`numbers`);
//! whatever else the text tells is not followed, and has no bound.

use super::instruction::{Effect, Operand, is_actual, is_move, numbered};
use super::job::Coordinates;
use super::jumps::is_condition;
use super::lines::{Line, Lines, words};
use super::numbers::{self, Amounts, OF_POSITION};
use super::reader::Reader;
use super::remarks::Cause;
use super::shifts::PER_MM;
use crate::program::displacing::grown_by_any;
use crate::program::quantity::Quantity;
use crate::program::script::{
    DISPLACED_SOMEHOW, DisplacementId, Expr, How, RemarkId, TURNED, UNBOUNDED, VariableId, Written,
};
use crate::program::{Number, TargetId, number};
use foldhash::{HashSet, HashSetExt};

/// Angles in variables count in ten-thousandths of a degree.
const PER_DEGREE: f64 = 1e4;
/// Instructions that write what the robot or the cell tells.
const OF_ROBOT: &[&[u8]] = &[b"GETS", b"DIN", b"AIN", b"LOADV", b"VWAIT"];

/// A write that adds one position to another.
#[derive(Debug)]
pub(super) struct Added {
    write: usize,
    added: VariableId,
    now: Amounts,
    /// 1, or −1 where it is subtracted.
    sign: f64,
}

/// A position of which another is computed, in the lists of the script.
#[derive(Debug)]
pub(super) struct Computed {
    at: u32,
    variable: VariableId,
    unknown: Expr,
}

/// The variables with numbers (`D005`) that the text of all jobs writes.
pub(super) fn known_numbers<'a>(lines: &[Vec<Line<'a>>]) -> HashSet<&'a [u8]> {
    let mut written_parts = HashSet::new();
    for line in lines.iter().flatten() {
        let mut words = words(line.text);
        let (first, second) = (words.next(), words.next());
        if let Some((first, second)) = first.zip(second)
            && !OF_ROBOT.contains(&first)
        {
            written_parts.insert(second);
        }
    }
    written_parts
}

impl Reader<'_> {
    /// What an instruction makes of a part of a position: it is displaced where what it becomes
    /// may come from one.
    pub(super) fn part_becomes(&mut self, line: Line, written: Written, computed: RemarkId) -> How {
        let first = words(line.text).next().unwrap_or_default();
        let mut behind = words(line.text).skip(2);
        let third = behind.next();
        let part = third.filter(|word| word.starts_with(b"("));
        let value = if part.is_some() { behind.next() } else { third };
        let value = value.unwrap_or_default();
        let is_number = number::parse(value).is_some();
        let is_angle = part.is_some_and(|part| matches!(part, b"(4)" | b"(5)" | b"(6)"));
        let is_indexed = memchr::memchr(b'[', value).is_some();
        let is_of_program = is_number || is_indexed || self.known_numbers.contains(value);
        if first == b"SETE" {
            if let Some(how) = self.element_becomes(written, part, value, computed) {
                return how;
            }
            return match !is_number && self.gets_parts {
                true if is_of_program => How::PartBy(computed, UNBOUNDED),
                is_own => How::part(is_own, is_angle, computed),
            };
        }
        let sign = match first {
            b"ADD" => 1.0,
            b"SUB" => -1.0,
            _ => 0.0,
        };
        let place = self.place(line.start);
        match Operand::of(value).map(|of| self.written_by(of, place)) {
            Some(Some(Written::One(added))) if sign != 0.0 => {
                let write = self.builder.script.writes.len();
                let now = self.numbers.position_now(added);
                self.added.push(Added {
                    write,
                    added,
                    now,
                    sign,
                });
                // until all jobs are read
                How::PartNumber(computed)
            }
            Some(_) => How::PartBy(computed, UNBOUNDED),
            None if is_of_program => How::PartBy(computed, UNBOUNDED),
            None => How::part(true, is_angle, computed),
        }
    }

    /// `GETE D000 P001 (3)`
    pub(super) fn get_element(&mut self, line: Line) {
        let all: Vec<&[u8]> = words(line.text).skip(1).take(3).collect();
        let [to, of, part] = all[..] else {
            return self.numbers.clear();
        };
        let place = self.place(line.start);
        let of = Operand::of(of).and_then(|of| self.written_by(of, place));
        let of = match of {
            Some(Written::One(variable)) => numbers::place(part).map(|at| (variable, at)),
            _ => None,
        };
        self.numbers.get(to, of);
    }

    /// What `SETE LP001 (3) D005` makes of a position, where the job has just written D005: it is
    /// displaced where that is the same number of this position, or of another, and something more.
    fn element_becomes(
        &mut self,
        written: Written,
        part: Option<&[u8]>,
        value: &[u8],
        computed: RemarkId,
    ) -> Option<How> {
        let at = part.and_then(numbers::place);
        let (Written::One(position), Some(at)) = (written, at) else {
            let one = match written {
                Written::One(variable) => Some(variable),
                Written::AnyOf(_) => None,
            };
            self.numbers.replace(one, false);
            return None;
        };
        let is_angle = at > 2;
        let now = self.numbers.set(position, at, value)?;
        let Some((of, place)) = now.of else {
            return Some(How::part(false, is_angle, computed));
        };
        if place != at {
            return None;
        }
        let unit = if is_angle { PER_DEGREE } else { PER_MM };
        let by = grown_by_any(at, Quantity::exactly(now.value / unit))?;
        if of == position {
            return Some(self.builder.script.part_by(computed, by));
        }
        let by = self.builder.script.displacement(by);
        (!is_angle).then_some(How::PartOf {
            remark: computed,
            of: Expr::Variable(of),
            axis: at,
            by,
        })
    }

    /// The numbers that the files have for positions.
    pub(super) fn declare_numbers(&mut self) {
        let table = self.variables.positions as usize;
        let entries = self.builder.script.tables[table].entries.values();
        for variable in entries.copied().collect::<Vec<_>>() {
            for target in self.targets_of(Expr::Variable(variable)) {
                let range = self.positions.targets[target].numbers.clone();
                let numbers = &self.positions.numbers[range.start as usize..range.end as usize];
                let header = self.positions.header(target);
                let is_pose = header.coordinates() == Some(Coordinates::Rectangular);
                if let Some(numbers) = numbers.first_chunk::<OF_POSITION>().filter(|_| is_pose) {
                    let value = |at: usize| {
                        let number: &Number = &numbers[at];
                        number.value * if at > 2 { PER_DEGREE } else { PER_MM }
                    };
                    let values = std::array::from_fn(value);
                    self.numbers.declare(variable, &values);
                }
            }
        }
    }

    /// The numbers of a position that an instruction writes as a whole: `SET P001 P002` copies them,
    /// `ADD P001 P002` and `SUB` add them up.
    pub(super) fn position_becomes(
        &mut self,
        line: Line,
        (first, effect): (&[u8], Effect),
        to: Written,
    ) {
        let place = self.place(line.start);
        let mut given = words(line.text).skip(2);
        let from = given.next().and_then(Operand::of);
        // what else is said changes them
        let is_plain = given
            .take_while(|word| !is_condition(word))
            .next()
            .is_none();
        let from = from
            .filter(|_| is_plain)
            .and_then(|of| self.written_by(of, place));
        match (first, to, from) {
            (b"SET", Written::One(to), Some(Written::One(from))) => {
                self.numbers.add_up(to, &[(1.0, from)]);
            }
            (b"ADD", Written::One(to), Some(Written::One(by))) => {
                self.numbers.add_up(to, &[(1.0, to), (1.0, by)]);
            }
            (b"SUB", Written::One(to), Some(Written::One(by))) => {
                self.numbers.add_up(to, &[(1.0, to), (-1.0, by)]);
            }
            (_, Written::One(to), _) => {
                self.numbers.replace(Some(to), effect == Effect::System);
            }
            (_, Written::AnyOf(_), _) => self.numbers.replace(None, effect == Effect::System),
        }
    }

    /// What an instruction computes of the positions that it names: each of them, displaced by what
    /// is not followed (`MULMAT P003 P001 P004`, `SET P003 EXPRESS P001 + P002`, a copy with another
    /// tool).
    pub(super) fn computed_from(&mut self, line: Line, written: Written) -> Expr {
        let place = self.place(line.start);
        let named = words(line.text).skip(2).filter_map(Operand::of);
        let named: Vec<Operand> = named.collect();
        let mut bases = Vec::new();
        for operand in named {
            let value = self.value(operand, place);
            if let Expr::Variable(variable) = value {
                self.note_copy(written, value);
                bases.push(variable);
            }
        }
        let unknown = self.unknown(Cause::Computed);
        if bases.is_empty() {
            return unknown;
        }
        let script = &mut self.builder.script;
        let displaced = bases.iter().map(|variable| {
            let base = Expr::Variable(*variable);
            script.displaced(base, UNBOUNDED)
        });
        let displaced: Vec<Expr> = displaced.collect();
        let all = script.any(displaced);
        if let Expr::Any { first, .. } = all {
            let listed = (first..).zip(bases);
            self.computed.extend(listed.map(|(at, variable)| Computed {
                at,
                variable,
                unknown,
            }));
        }
        all
    }

    /// The position of a step of the job, `STEP#(2)`: of its second move.
    pub(super) fn taught_at(&self, step: &[u8]) -> Option<TargetId> {
        let step = numbered(step, b"STEP#")?.checked_sub(1)?;
        let job = &self.positions.jobs[self.here.job];
        let bytes = &self.sources[job.file as usize].bytes[..job.instructions.end];
        let lines = Lines::from(bytes, job.instructions.start).map(|line| line.text);
        let mut moves = lines.filter(|text| words(text).next().is_some_and(is_move));
        let operand = words(moves.nth(step as usize)?)
            .nth(1)
            .and_then(Operand::of);
        match operand? {
            Operand::C(number) => self.target(number),
            _ => None,
        }
    }

    /// Whether the text tells what an instruction writes.
    pub(super) fn note_known(&mut self, effect_of: Effect, third: &[u8], written: Written) {
        let is_of_program = matches!(
            effect_of,
            Effect::Copy | Effect::Argument | Effect::Taught | Effect::Part | Effect::Computed
        );
        if is_of_program && !is_actual(third) {
            match written {
                Written::One(variable) => _ = self.written_parts.insert(variable),
                Written::AnyOf(table) => _ = self.written_any.insert(table),
            }
        }
    }

    // ---- when all jobs are read

    pub(super) fn finish_parts(&mut self) {
        for computed in std::mem::take(&mut self.computed) {
            // what no move goes to is not rewritten
            let mut poses = self.poses_of(computed.variable).into_iter();
            if !poses.any(|target| self.named[target]) {
                self.builder.script.lists[computed.at as usize] = computed.unknown;
            }
        }
        for added in std::mem::take(&mut self.added) {
            let by = self.amount(&added);
            let write = &mut self.builder.script.writes[added.write];
            if let How::PartNumber(remark) = write.how {
                write.how = How::PartBy(remark, by);
            }
        }
        self.displace_converted();
    }

    /// What displaces a position in the coordinates of another frame goes along the axes of that one,
    /// which are not those of its target.
    fn displace_converted(&mut self) {
        if self.converted.is_empty() {
            return;
        }
        let mut converted = std::mem::take(&mut self.converted);
        loop {
            let is_one = |of: &Expr| of.variable().is_some_and(|of| converted.contains(&of));
            let copies = self.copies.iter();
            let more = copies.filter(|(to, of)| !converted.contains(*to) && of.iter().any(is_one));
            let more: Vec<VariableId> = more.map(|(to, _)| *to).collect();
            if more.is_empty() {
                break;
            }
            converted.extend(more);
        }
        let script = &mut self.builder.script;
        for write in &mut script.writes {
            let may_be = match write.variable {
                Written::One(variable) => converted.contains(&variable),
                Written::AnyOf(table) => {
                    let mut entries = script.tables[table as usize].entries.values();
                    entries.any(|entry| converted.contains(entry))
                }
            };
            match &mut write.how {
                How::PartBy(_, by) | How::PartOf { by, .. }
                    if may_be && ![DISPLACED_SOMEHOW, TURNED].contains(by) =>
                {
                    *by = UNBOUNDED;
                }
                _ => {}
            }
        }
    }

    /// What a position displaces another by that it is added to.
    fn amount(&mut self, added: &Added) -> DisplacementId {
        let variable = added.added;
        let script = &self.builder.script;
        let is_entry = |table: &u32| {
            let mut entries = script.tables[*table as usize].entries.values();
            entries.any(|one| *one == variable)
        };
        let is_written =
            self.written_parts.contains(&variable) || self.written_any.iter().any(is_entry);
        let is_declared = matches!(
            script.variables[variable as usize].declared,
            Expr::Target(_) | Expr::Any { .. }
        );
        if !is_declared && !is_written {
            return DISPLACED_SOMEHOW;
        }
        match self.displacing(variable, &added.now, added.sign) {
            Some(by) => self.builder.script.displacement(by),
            None => UNBOUNDED,
        }
    }
}
