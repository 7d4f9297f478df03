//! Position registers and points as programs write them: copies of points, and what displaces these.

use super::content::{Entered, canonical};
use super::controller::Kind;
use super::numbers::{ELEMENTS, MOST_NUMBER, OF_ARM, of_position};
use super::offsets::Copied;
use super::reader::Reader;
use super::words::{
    Named, Register, bracket_end, each_position, element, position, register, whole,
};
use crate::program::TargetId;
use crate::program::displacing::grown_by_any;
use crate::program::quantity::Quantity;
use crate::program::script::{
    DISPLACED_SOMEHOW, DisplacementId, Expr, Held, How, NOT_DISPLACED, UNBOUNDED, VariableId,
    Written,
};
use std::rc::Rc;

/// A number and what it is.
type Present = (u32, Option<Rc<Entered>>);

/// Where a list of the script begins that a sum may be displaced from, and the registers of these.
type Bases = (u32, Vec<Option<u32>>);

/// A write of a position that is a sum of others.
#[derive(Debug)]
pub(super) struct Sum {
    write: usize,
    /// What it may be displaced from: a list of the script, with the numbers of registers.
    first: u32,
    registers: Vec<Option<u32>>,
    /// What is added to each of these.
    added: Vec<Vec<Entered>>,
}

/// A write of a number of a position register.
#[derive(Debug)]
pub(super) struct Part {
    write: usize,
    at: usize,
    entered: Entered,
    own: Option<Present>,
    /// The same number of another register.
    of: Option<(VariableId, Present)>,
    is_own: bool,
    from_number: bool,
}

impl Reader<'_> {
    /// `P[2]=PR[4]`
    pub(super) fn set_point(&mut self, index: &[u8], value: &[u8]) {
        let one = whole(index).map(Named::Point);
        let (holds, sum) = self.position_value(value);
        for target in self.targets(one.unwrap_or(Named::AnyPoint)) {
            let variable = self.written(target);
            // a register says which: each may be written
            if one.is_none() {
                self.builder.begin_if(None);
            }
            self.add_sum(sum.as_ref(), value);
            self.set(variable, holds);
            if one.is_none() {
                self.builder.end_choice();
            }
        }
    }

    /// `PR[4]=P[2]`, `PR[4,3]=R[1]`
    pub(super) fn set_register(&mut self, index: &[u8], value: &[u8]) {
        let Register { number, is_element } = register(index);
        let text = canonical(value);
        if is_indirect(&text) || number.is_none() {
            self.known.clear();
        }
        let how = if let Some(at @ OF_ARM..ELEMENTS) = element(index).map(|at| at.saturating_sub(1))
        {
            self.axis_becomes(at, &text)
        } else if is_element {
            self.part_becomes(index, &text)
        } else {
            let (holds, sum) = self.position_value(value);
            self.add_sum(sum.as_ref(), value);
            let terms = terms(&text);
            let left = terms.map_or_else(|| text.clone(), |terms| joined(&terms));
            self.copied.copy(&self.listing, number, &left, &text);
            How::Whole(holds)
        };
        let elements = match element(index).filter(|_| is_element) {
            Some(one) => one.saturating_sub(1)..one,
            None => 0..ELEMENTS,
        };
        if is_element {
            let others = elements.clone().filter(|at| *at >= OF_ARM);
            self.known.axes.extend(others.map(|at| (number, at)));
        }
        let text = match terms(&text) {
            Some(terms) if !is_element => joined(&terms),
            _ => text,
        };
        self.note_points(&text);
        let mut all = Vec::new();
        // of an element that nobody knows each may be written
        let is_open = is_element && element(index).is_none();
        if is_open {
            self.known.open();
        }
        for at in elements.filter(|at| *at < ELEMENTS) {
            let own = of_position(number.unwrap_or(MOST_NUMBER), at);
            all.push((own, self.known.entered(own, &text, at as usize)));
        }
        for (own, entered) in all {
            match number {
                Some(..MOST_NUMBER) => self.known.write(own, entered),
                Some(_) => {}
                None => self.known.write_any(own, entered),
            }
        }
        if is_open {
            self.known.close();
        }
        let Some(number) = number else {
            return self.write(Written::AnyOf(self.controller.registers), how);
        };
        // of what it held nothing is left
        let is_written = is_element && self.known.pose(number).is_some();
        let how = match how {
            How::Axis(_) => how,
            _ if is_written => How::Whole(Expr::Unknown(self.controller.written)),
            how => how,
        };
        if matches!(how, How::Whole(holds) if !matches!(holds, Expr::Unknown(_))) {
            self.aliased.insert(number);
        }
        each_position(value, |named| {
            if matches!(named, Named::Point(_) | Named::AnyPoint) {
                self.copies.push((self.place, number));
            }
        });
        let register = self.register(number);
        self.write(Written::One(register), how);
    }

    /// `R[1]=PR[4,3]`
    pub(super) fn set_number(&mut self, index: &[u8], value: &[u8]) {
        let text = canonical(value);
        let number = whole(index);
        if is_indirect(&text) || number.is_none() {
            self.known.clear();
        }
        let own = number.unwrap_or(MOST_NUMBER);
        let entered = self.known.entered(own, &text, 0);
        match number {
            Some(..MOST_NUMBER) => self.known.write(own, entered),
            Some(_) => {}
            None => self.known.write_any(own, entered),
        }
    }

    /// Points whose numbers a text has.
    fn note_points(&mut self, text: &[u8]) {
        let routine = self.known.routine();
        let mut all = Vec::new();
        each_position(text, |named| {
            if let Named::Point(number) = named {
                all.push(number);
            }
        });
        for number in all {
            let index = self.listing.by_number.get(&number);
            let point = index.map(|index| self.listing.points[*index as usize]);
            // of two with one number nobody knows which
            let alone = point.filter(|point| point.twin.is_none());
            if let Some(target) = alone.and_then(|point| point.target) {
                self.known.points.insert((routine, number), target);
            }
        }
    }

    /// What `PR[4,3]=` makes of a register: it displaces it by 200 mm where `PR[4,3]+200` is behind
    /// it.
    fn part_becomes(&mut self, index: &[u8], text: &[u8]) -> How {
        let computed = self.controller.computed;
        let (own, at) = (register(index).number, element(index));
        let Some(at @ 1..=6) = at else {
            return How::part(false, false, computed);
        };
        let key = |number| of_position(number, at - 1);
        let mut others: Vec<u32> = Vec::new();
        let mut is_own = false;
        for start in memchr::memmem::find_iter(text, b"PR[") {
            let inside = &text[start + 3..];
            let one = &inside[..bracket_end(inside).unwrap_or(0)];
            let of = register(one);
            let is_same = of.is_element && element(one) == Some(at);
            match of.number {
                // it may be this one
                None => is_own |= own.is_none() && text[start + 3..].starts_with(b"R["),
                Some(number) if is_same && Some(number) != own => others.push(number),
                Some(_) => {}
            }
        }
        let own = own.filter(|number| *number < MOST_NUMBER);
        let own = own.map(|number| (key(number), self.known.now(key(number))));
        let other = match others[..] {
            [one] if at < 4 && one < MOST_NUMBER => {
                Some((self.register(one), (key(one), self.known.now(key(one)))))
            }
            _ => None,
        };
        let from_number = memchr::memmem::find_iter(text, b"R[")
            .any(|at| at.checked_sub(1).is_none_or(|before| text[before] != b'P'));
        let entered = own.as_ref().map_or(u32::MAX, |(own, _)| *own);
        let part = Part {
            write: self.builder.script.writes.len(),
            at: at as usize - 1,
            entered: self.known.entered(entered, text, 0),
            own,
            of: other,
            is_own,
            from_number: from_number && self.gets_elements,
        };
        let unknown = &mut |_| Quantity::unknown();
        if let Some(how) = self.part(&part, unknown) {
            return how;
        }
        self.parts.push(part);
        // until all programs are read
        How::PartNumber(computed)
    }

    /// What a write of a number makes of a copy, where the numbers added tell.
    fn part(&mut self, part: &Part, of: &mut dyn FnMut(u32) -> Quantity) -> Option<How> {
        let computed = self.controller.computed;
        let mut added = |own: &Present| {
            let own = (own.0, own.1.as_ref());
            self.known.evaluate(&part.entered, Some(own), of).apart()
        };
        let exactly = |rest: &Quantity| rest.exact().is_some();
        if let Some((times, rest)) = part.own.as_ref().map(&mut added)
            && times == 1.0
            && exactly(&rest)
        {
            let by = grown_by_any(part.at, rest)?;
            return Some(self.builder.script.part_by(computed, by));
        }
        if let Some((other, present)) = &part.of {
            let (times, rest) = added(present);
            if times == 1.0 && exactly(&rest) {
                let (of, by) = (Expr::Variable(*other), grown_by_any(part.at, rest)?);
                let by = self.builder.script.displacement(by);
                let (remark, axis) = (computed, part.at);
                return Some(How::PartOf {
                    remark,
                    of,
                    axis,
                    by,
                });
            }
        }
        None
    }

    /// Likewise, once all programs are read.
    fn part_of_all(&mut self, part: &Part) -> How {
        let computed = self.controller.computed;
        let is_angle = part.at > 2;
        let added = |known: &super::numbers::Known, own: &Present| {
            known
                .value(&part.entered, Some((own.0, own.1.as_ref())))
                .apart()
        };
        let unbounded = How::PartBy(computed, UNBOUNDED);
        if part.is_own {
            return unbounded;
        }
        if let Some(own) = &part.own {
            let (times, rest) = added(&self.known, own);
            if times == 1.0 {
                let by = grown_by_any(part.at, rest);
                return match by {
                    Some(by) => self.builder.script.part_by(computed, by),
                    None => How::part(true, is_angle, computed),
                };
            }
            if times != 0.0 {
                return unbounded;
            }
        }
        if let Some((other, present)) = &part.of {
            let (times, rest) = added(&self.known, present);
            if times == 1.0
                && let Some(by) = grown_by_any(part.at, rest)
            {
                return How::PartOf {
                    remark: computed,
                    of: Expr::Variable(*other),
                    axis: part.at,
                    by: self.builder.script.displacement(by),
                };
            }
        }
        let value = self.known.value(&part.entered, None);
        if part.from_number && value.is_endless() {
            return unbounded;
        }
        How::part(false, is_angle, computed)
    }

    /// The position that a value is: a point, another register, where the robot is, or what is
    /// computed of these: of which positions, where that is a sum.
    fn position_value(&mut self, value: &[u8]) -> (Expr, Option<Bases>) {
        if value == b"JPOS" {
            return (Expr::Value(self.controller.actual), None);
        }
        if value == b"LPOS" {
            let [tool, frame] = [Kind::Tool, Kind::Frame].map(|kind| self.controller.active(kind));
            let here = Held::ActualWith { tool, frame };
            return (self.builder.script.held(here), None);
        }
        if let Some(frame) = self.other_frame(value) {
            return (frame, None);
        }
        let text = canonical(value);
        let terms = terms(&text);
        let (mut all, mut positions) = (Vec::new(), Vec::new());
        each_position(value, |named| {
            if let Named::Register(register) = named {
                all.push(register);
            }
        });
        for register in all {
            self.reads(register);
        }
        let added: Vec<&[u8]> = match &terms {
            Some(terms) => {
                let added = terms.iter().filter(|(is_less, _)| !is_less);
                added.map(|(_, term)| *term).collect()
            }
            None => vec![&text],
        };
        for term in added {
            let mut here = Vec::new();
            each_position(term, |named| here.push(named));
            for named in here {
                match named {
                    Named::Point(_) => {
                        let targets = self.targets(named).into_iter();
                        positions.extend(targets.map(|target| (Expr::Target(target), None)));
                    }
                    Named::Register(Register {
                        number: Some(number),
                        is_element: false,
                    }) => {
                        let register = Expr::Variable(self.register(number));
                        positions.push((register, Some(number)));
                    }
                    _ => {}
                }
            }
        }
        let is_whole = matches!(terms.as_deref(), Some([_]));
        match positions.as_slice() {
            [] => (Expr::Unknown(self.controller.computed), None),
            [(one, _)] if is_whole => (*one, None),
            _ => {
                let bases = positions.iter().map(|(base, _)| *base);
                let any = self.builder.script.any(bases);
                let Expr::Any { first, .. } = any else {
                    unreachable!("a list");
                };
                let registers = positions.into_iter().map(|(_, register)| register);
                (any, Some((first, registers.collect())))
            }
        }
    }

    /// The next write is that of a sum.
    fn add_sum(&mut self, sum: Option<&Bases>, value: &[u8]) {
        let Some((first, registers)) = sum else {
            return;
        };
        let text = canonical(value);
        self.note_points(&text);
        let terms = terms(&text);
        let mut added = Vec::new();
        let bases = terms.iter().flatten().filter(|(is_less, _)| !is_less);
        let bases: Vec<*const u8> = bases.map(|(_, term)| term.as_ptr()).collect();
        for at in 0..registers.len() {
            let others = match &terms {
                // one of them is the base
                Some(terms) if bases.len() == registers.len() => {
                    let others = terms.iter().filter(|(_, term)| term.as_ptr() != bases[at]);
                    joined(&others.copied().collect::<Vec<_>>())
                }
                _ => [b"F[", &text[..], b"]"].concat(),
            };
            let each = (0..ELEMENTS as usize).map(|at| self.known.entered(u32::MAX, &others, at));
            added.push(each.collect());
        }
        self.sums.push(Sum {
            write: self.builder.script.writes.len(),
            first: *first,
            registers: registers.clone(),
            added,
        });
    }

    // ---- when all programs are read

    /// What is written, now that the numbers are known.
    pub(super) fn finish_registers(&mut self, copied: &Copied) {
        for part in std::mem::take(&mut self.parts) {
            let how = self.part_of_all(&part);
            let write = &mut self.builder.script.writes[part.write];
            if matches!(write.how, How::PartNumber(_)) {
                write.how = how;
            }
        }
        for sum in std::mem::take(&mut self.sums) {
            let holds = |register: &Option<u32>| register.is_none_or(|one| copied.holds(one));
            // registers that hold no point are what is added
            let is_known = sum.registers.iter().any(holds);
            let mut all = Vec::new();
            for (at, (register, added)) in sum.registers.iter().zip(&sum.added).enumerate() {
                if is_known && !holds(register) {
                    continue;
                }
                let base = self.builder.script.lists[sum.first as usize + at];
                let is_joints = register.is_some_and(|one| copied.is_joints(Some(one)));
                let by = match self.added(added) {
                    by @ (NOT_DISPLACED | DISPLACED_SOMEHOW) => by,
                    // of another joint the correction is another one
                    _ if is_joints || self.is_joints(base) => UNBOUNDED,
                    by => by,
                };
                all.push(self.builder.script.displaced(base, by));
            }
            let holds = match all[..] {
                [one] => one,
                _ => self.builder.script.any(all),
            };
            self.builder.script.writes[sum.write].how = How::Whole(holds);
        }
    }

    /// What numbers add to a position.
    fn added(&mut self, added: &[Entered]) -> DisplacementId {
        let values = added.iter().map(|entered| self.known.value(entered, None));
        let values: Vec<_> = values.collect();
        let is_of = |number, at| added[at as usize].names(of_position(number, at));
        if !self.open_axes(&values, &is_of).is_empty() {
            return UNBOUNDED;
        }
        let by = super::offsets::of_sum(&values);
        self.builder.script.displacement(by)
    }

    /// The targets that moves go to, and the registers.
    pub(super) fn gone_to(&self) -> (Vec<TargetId>, Vec<VariableId>) {
        let script = &self.builder.script;
        let (mut targets, mut variables) = (Vec::new(), Vec::new());
        let mut open: Vec<Expr> = script.instructions.iter().map(|of| of.target).collect();
        while let Some(one) = open.pop() {
            match one {
                Expr::Target(target) => targets.push(target),
                Expr::Any { first, end } => {
                    open.extend(&script.lists[first as usize..end as usize]);
                }
                Expr::Variable(variable) => {
                    if let Expr::Target(target) = script.variables[variable as usize].declared {
                        targets.push(target);
                    }
                    variables.push(variable);
                }
                _ => {}
            }
        }
        (targets, variables)
    }
}

/// Whether a register says which register is read.
pub(super) fn is_indirect(text: &[u8]) -> bool {
    memchr::memmem::find(text, b"[R[").is_some() || memchr::memchr(b'?', text).is_some()
}

/// The positions of a sum, and whether each is subtracted, without those that leave nothing; `None`
/// where the text is none.
pub(super) fn terms(text: &[u8]) -> Option<Vec<(bool, &[u8])>> {
    let mut terms: Vec<(bool, &[u8])> = Vec::new();
    let mut rest = text.trim_ascii();
    let mut is_less = false;
    loop {
        let length = match position(rest) {
            Some((Named::Register(register), _)) if register.is_element => return None,
            Some((Named::Computed, _)) => return None,
            Some((_, length)) => length,
            None if rest.starts_with(b"LPOS") || rest.starts_with(b"JPOS") => 4,
            None => return None,
        };
        let term = &rest[..length];
        let opposite = terms.iter().position(|of| *of == (!is_less, term));
        match opposite {
            Some(at) => _ = terms.remove(at),
            None => terms.push((is_less, term)),
        }
        rest = rest[length..].trim_ascii_start();
        is_less = match rest.first() {
            None => return Some(terms),
            Some(b'+') => false,
            Some(b'-') => true,
            Some(_) => return None,
        };
        rest = rest[1..].trim_ascii_start();
    }
}

fn joined(terms: &[(bool, &[u8])]) -> Vec<u8> {
    let mut text = b"0".to_vec();
    for (is_less, term) in terms {
        text.push(if *is_less { b'-' } else { b'+' });
        text.extend_from_slice(term);
    }
    text
}
