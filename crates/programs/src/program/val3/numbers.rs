//! What numbers and transformations are, by what statements write into them.

use super::code::{PLAIN, Reference};
use super::data::{Kind, POSE};
use super::reader::{Reader, functions, written_argument};
use super::targets::{Known, Of};
use crate::program::contexts::{Varied, varied};
use crate::program::notation::turned_by;
use crate::program::numbers::{Operand, evaluated};
use crate::program::quantity::{Arithmetic, Quantity};
use crate::program::script::{RoutineId, short};
use crate::program::transformations::{
    EACH, Edge, Entries, Numbering, Of as Value, Reads, Steps, Written, exactly,
};
use crate::program::words::Words;
use crate::program::{Displacement, Stride};

/// Functions of what only the running program knows.
///
/// # Source
/// Staubli, "VAL 3 Reference Manual", version 7. *Not verified on a controller.*
const INPUTS: &[&[u8]] = &[
    b"aioGet",
    b"dioGet",
    b"sioGet",
    b"get",
    b"clock",
    b"getJointForce",
    b"getSpeed",
    b"getPositionErr",
    b"getLatch",
    b"getMoveId",
    b"getMonitorSpeed",
    b"taskStatus",
    b"toNum",
    b"isKeyPressed",
];

/// `*` in `*` and in brackets.
const DEEPEST: u32 = 32;

impl<'a> Reader<'a> {
    /// The first number of a name that is a number or a transformation.
    fn number(&self, name: &Reference<'a>, routine: RoutineId) -> Option<u32> {
        let known = self.meaning_in(name, routine)?;
        matches!(known.kind, Kind::Num | Kind::Trsf).then_some(known.table * EACH)
    }

    /// Notes what numbers begin with.
    pub(super) fn declare_numbers(&mut self) {
        let is_number = |kind: Kind| matches!(kind, Kind::Num | Kind::Trsf);
        for (at, datum) in self.world.data.iter().enumerate() {
            if !is_number(datum.kind) {
                continue;
            }
            let first = self.variables.table_of(at) * EACH;
            let count = if datum.kind == Kind::Num { 1 } else { EACH };
            for number in 0..count {
                for element in &datum.elements {
                    let value = element.numbers[number as usize].value;
                    let is_said = datum.kind == Kind::Trsf || element.is_given;
                    self.entries
                        .declare(first + number, is_said.then_some(value));
                }
                if datum.elements.is_empty() {
                    self.entries.declare(first + number, None);
                }
            }
        }
        for (routine, program) in (0..).zip(&self.world.programs) {
            for own in program.declared.iter().filter(|own| is_number(own.kind)) {
                if own.is_parameter {
                    continue;
                }
                let first = self.variables.table_of_local(routine, own.name) * EACH;
                for number in first..first + EACH {
                    self.entries.declare_own(number, routine);
                }
            }
        }
    }

    /// Notes what a condition says of numbers where an edge is gone, and where it is not.
    fn check(&mut self, edge: Edge, condition: Words<'a, '_>) {
        let routine = self.here.routine;
        let mut entries = std::mem::take(&mut self.entries);
        entries.check(edge, condition.whole(), &mut |side| {
            let words = condition.within(side);
            let name = Reference::of(words);
            let name = name.filter(|name| name.words == words.len() && !name.has_field)?;
            let is_whole = !(0..words.len()).any(|at| words.is(at, b'['));
            self.number(&name, routine)
                .filter(|_| is_whole && self.kind_of(&name) == Kind::Num)
        });
        self.entries = entries;
    }

    /// Notes what a statement writes into numbers.
    pub(super) fn tell(&mut self, line: Words<'a, '_>) {
        let routine = self.here.routine;
        self.entries.begin_statement(line.span().start);
        match line.text(0) {
            b"if" => {
                let inside = self.entries.open_branch();
                self.check(inside, line.behind(1));
            }
            b"switch" => self.entries.open_switch(),
            b"elseIf" | b"case" | b"else" | b"default" => self.entries.branch(),
            b"while" => {
                let inside = self.entries.open_loop();
                self.check(inside, line.behind(1));
            }
            b"do" => _ = self.entries.open_loop(),
            b"endIf" | b"endSwitch" | b"endWhile" | b"endFor" => self.entries.close(),
            b"until" => {
                if let Some(behind) = self.entries.close_or_repeat() {
                    self.check(behind, line.behind(1));
                }
            }
            b"break" => self.entries.leave(),
            b"return" => self.entries.stop(),
            b"for" => self.tell_loop(line.behind(1)),
            _ => {}
        }
        for at in functions(line) {
            let given = || line.inside(at + 1).0.list();
            if let Some(argument) = written_argument(line.text(at)) {
                let target = given().get(argument).and_then(|one| Reference::of(*one));
                if let Some(number) = target.and_then(|target| self.number(&target, routine)) {
                    self.entries.lose(number);
                }
            } else if let Some((callee, _)) = self.callee(line, at) {
                if let Some(callee) = callee {
                    self.entries.calls(callee);
                    if line.text(0) != b"call" {
                        self.entries.starts(callee);
                    }
                }
                for (number, given) in given().into_iter().enumerate() {
                    self.tell_given(callee, number, given);
                }
            }
        }
        let Some(target) = Reference::of(line).filter(|target| line.is(target.words, b'=')) else {
            return;
        };
        let Some(first) = self.number(&target, routine) else {
            return;
        };
        let value = line.behind(target.words + 1).whole();
        let is_whole = !(0..target.words).any(|at| line.is(at, b'['));
        if self.kind_of(&target) == Kind::Num {
            self.entries.assign(first, Written::Text(value), is_whole);
        } else if let Some(at) = axis(line.text(target.words - 1)).filter(|_| target.has_field) {
            let number = first + short(at);
            self.entries.assign(number, Written::Text(value), is_whole);
        } else {
            let value = Some(value).filter(|_| !target.has_field);
            self.entries.assign_all(first, value, is_whole);
        }
    }

    /// `for n=0 to 5 step 2`
    fn tell_loop(&mut self, line: Words<'a, '_>) {
        let counter = Reference::of(line).filter(|name| line.is(name.words, b'='));
        let number = counter.and_then(|name| {
            let is_whole = !(0..name.words).any(|at| line.is(at, b'['));
            Some((self.number(&name, self.here.routine)?, is_whole))
        });
        let range = line.behind(counter.map_or(0, |name| name.words + 1));
        self.entries.count(number, range);
    }

    /// An argument of a call.
    fn tell_given(&mut self, callee: Option<RoutineId>, number: usize, given: Words<'a, '_>) {
        let name = Reference::of(given).filter(|name| name.words == given.len());
        let back = name.and_then(|name| self.number(&name, self.here.routine));
        let Some(callee) = callee else {
            if let Some(back) = back {
                self.entries.lose(back);
            }
            return;
        };
        let Some(parameter) = self.parameter(callee, number) else {
            return;
        };
        let own = self.variables.table_of_local(callee, parameter.name) * EACH;
        let back = back.filter(|_| parameter.by_reference);
        match parameter.kind {
            Kind::Num => self.entries.give(callee, own, given.whole(), back),
            Kind::Trsf => self.entries.give_all(callee, own, given.whole(), back),
            _ => {}
        }
    }

    // ---- values

    /// How often the loop runs at most that the present statement begins.
    pub(super) fn rounds(&self) -> Option<u32> {
        self.entries.rounds((self.here.routine, self.here.at))
    }

    fn value(&self, number: u32) -> Quantity {
        let at = (self.here.routine, self.here.at);
        self.entries.value(number, at, self)
    }

    /// The transformation that words of the present statement are, call by call.
    pub(super) fn varied_steps(&self, words: Words<'a, '_>) -> Varied<Steps> {
        let (routine, at) = (self.here.routine, self.here.at);
        varied(&Numbering(self), (routine, at), &mut |of| {
            self.product(words, routine, 0, of)
        })
    }

    /// The transformation that words of the present statement are.
    pub(super) fn steps(&self, words: Words<'a, '_>) -> Steps {
        let of = &mut |number| self.value(number);
        self.product(words, self.here.routine, 0, of)
    }

    /// `a*!b`
    fn product(
        &self,
        words: Words<'a, '_>,
        routine: RoutineId,
        depth: u32,
        of: &mut Value,
    ) -> Steps {
        let factors = words.factors();
        if factors.len() > 1 {
            let each = factors.into_iter();
            let each = each.map(|factor| self.factor(factor, routine, depth, of));
            return each.fold(Steps::default(), Steps::then);
        }
        self.factor(words, routine, depth, of)
    }

    fn factor(
        &self,
        words: Words<'a, '_>,
        routine: RoutineId,
        depth: u32,
        of: &mut Value,
    ) -> Steps {
        if depth > DEEPEST {
            return Steps::endless();
        }
        if words.is(0, b'!') {
            return self
                .factor(words.behind(1), routine, depth + 1, of)
                .inverse();
        }
        if words.is(0, b'(') && words.closing(0) + 1 == words.len() {
            return self.product(words.inside(0).0, routine, depth + 1, of);
        }
        if self.is_plain(words, routine) {
            let mut numbers = exactly([0.0; 6]);
            for (at, number) in numbers.iter_mut().enumerate() {
                *number = self.plain(words, at, routine, of);
            }
            return Steps::one(numbers);
        }
        let is_strange =
            Reference::whole(words).is_some_and(|name| self.meaning_in(&name, routine).is_none());
        if is_strange {
            return Steps::unknown();
        }
        Steps::endless()
    }

    /// Whether words are a transformation by its six numbers or by its name.
    fn is_plain(&self, words: Words<'a, '_>, routine: RoutineId) -> bool {
        let list = words.rest_list(0).filter(|_| words.is(0, b'{'));
        let is_named = || {
            let name = Reference::whole(words)?;
            let known = self.meaning_in(&name, routine)?;
            (known.kind == Kind::Trsf).then_some(())
        };
        list.map_or_else(|| is_named().is_some(), |list| list.len() == EACH as usize)
    }

    /// One of the numbers of such a transformation.
    fn plain(
        &self,
        words: Words<'a, '_>,
        at: usize,
        routine: RoutineId,
        of: &mut Value,
    ) -> Quantity {
        if let Some(list) = words.rest_list(0).filter(|_| words.is(0, b'{')) {
            return list
                .get(at)
                .map_or_else(Quantity::endless, |number| match number.value() {
                    Some(value) => Quantity::exactly(value),
                    None => Reads::quantity(self, number.whole(), routine, of),
                });
        }
        let Some(name) = Reference::whole(words) else {
            return Quantity::endless();
        };
        if let Some(found) = self.constant_in(&name, Kind::Trsf, routine) {
            return Quantity::exactly(found.numbers[at].value);
        }
        let number = self.number(&name, routine);
        number.map_or_else(Quantity::unknown, |number| of(number + short(at)))
    }

    // ---- parts of points

    /// What is added to a part of a point, and the part that it is added to, in the letters of the
    /// text: 200 and `p.trsf.z` of `p.trsf.z+200`.
    pub(super) fn term_and_rest(
        &self,
        value: &[u8],
        letters: impl Fn(&[u8]) -> Vec<u8>,
    ) -> Option<(Vec<u8>, Quantity)> {
        let (mut term, mut is_one) = (None, true);
        let routine = self.here.routine;
        let value = evaluated(Arithmetic::Real, value, &mut |operand| {
            let (Operand::Name(operand) | Operand::Other(operand)) = operand;
            let text = letters(operand);
            if memchr::memmem::find(&text, b".trsf.").is_none() {
                let of = &mut |number| self.value(number);
                return self.operand(operand, routine, of);
            }
            is_one &= term.is_none();
            term = Some(text);
            Some(Quantity::own())
        });
        let (count, rest) = value.apart();
        let term = term.filter(|_| is_one && count == 1.0)?;
        Some((term, rest))
    }
}

/// What a point is displaced by one of whose angles, degrees, grows so much; `None` where only the
/// running program knows.
pub(super) fn turned_by_any(by: &Quantity) -> Option<Displacement> {
    if by.is_endless() {
        return Some(Displacement::Unbounded);
    }
    let turned = by
        .ends()
        .map(|(least, most)| turned_by(most.abs().max(least.abs())));
    let is_of_program = by.unknown.is_none() || by.of_text() > 0.0;
    turned.or_else(|| is_of_program.then(|| Displacement::Within(Box::new([Stride::Turned(None)]))))
}

/// Which number of a transformation a field is.
pub(super) fn axis(field: &[u8]) -> Option<usize> {
    POSE.iter().position(|known| known.as_bytes() == field)
}

impl<'a> Reads<'a> for Reader<'a> {
    fn entries(&self) -> &Entries<'a> {
        &self.entries
    }

    fn operand(&self, operand: &[u8], routine: u32, of: &mut Value) -> Option<Quantity> {
        let mut found = Vec::new();
        PLAIN.add(operand, 0..operand.len(), &mut found);
        let words = Words {
            bytes: operand,
            all: &found,
        };
        if words.is(1, b'(') {
            let is_input = INPUTS.contains(&words.text(0));
            return is_input.then(Quantity::unknown);
        }
        let name = Reference::of(words).filter(|name| name.words == words.len())?;
        let Some(Known {
            kind,
            table,
            of: owner,
        }) = self.meaning_in(&name, routine)
        else {
            return Some(Quantity::unknown());
        };
        let first = table * EACH;
        Some(match kind {
            Kind::Num => {
                // one of an array that nothing writes is what is declared
                if let Of::Project(datum) = owner
                    && let Some(key) = name.key
                    && !self.assigned.contains_key(&datum)
                {
                    let of = &self.world.data[datum as usize];
                    if let Some(at) = of.element(key).filter(|at| of.elements[*at].is_given) {
                        return Some(Quantity::exactly(of.elements[at].numbers[0].value));
                    }
                }
                of(first)
            }
            Kind::Trsf => match axis(words.text(words.len() - 1)) {
                Some(at) if name.has_field => of(first + short(at)),
                _ => Quantity::endless(),
            },
            _ => Quantity::endless(),
        })
    }

    fn part(&self, text: &'a [u8], at: usize, routine: u32, of: &mut Value) -> Quantity {
        let mut found = Vec::new();
        PLAIN.add(text, 0..text.len(), &mut found);
        let words = Words {
            bytes: text,
            all: &found,
        };
        if self.is_plain(words, routine) {
            return self.plain(words, at, routine, of);
        }
        let steps = self.product(words, routine, 0, of);
        if let Some(pose) = steps.exact() {
            let mut numbers = [0.0; 6];
            crate::program::notation::write_turning_angles(&pose, &mut numbers);
            return Quantity::exactly(numbers[at]);
        }
        if steps.is_unknown() {
            Quantity::unknown()
        } else {
            Quantity::endless()
        }
    }
}
