//! What numbers may be: what FOR counts, and variables with all that is written into them.
//!
//! Variables of one name are taken for one, but for those that routines declare.

use super::components::{FrameWrite, Value, part_of};
use super::given::Given;
use super::names::{DataKind, Names};
use super::reader::Reader;
use super::statements::action;
use super::tokens::{Cursor, Kind, Token};
use crate::program::TargetId;
use crate::program::names::{Context, Symbol};
use crate::program::numbers::{
    self, Blocks, Numbers, Operand, bounds_in, compared_in, counted, evaluated, rounds,
};
use crate::program::quantity::{Arithmetic, Quantity, evaluate, is_letter};
use crate::program::script::{Place, short};
use foldhash::{HashMap, HashSet};
use std::ops::Range;

/// Variables that routines declare have their number above this.
pub(super) const OF_ROUTINE: u32 = 1 << 31;
/// What functions give has the number of the routine, above this.
const RESULT: u32 = 1 << 30;
/// Components of frames have their number above this.
pub(super) const COMPONENT: u32 = 1 << 29;

/// `FOR i=0 TO 9 STEP 2`
#[derive(Debug)]
struct Counting {
    counter: u32,
    context: Context,
    file: u32,
    /// The bytes between FOR and ENDFOR.
    inside: (u32, u32),
    /// In capitals, from `=` on.
    text: Box<[u8]>,
    /// How often it runs at most, where the text tells.
    most: Option<u32>,
    /// Its number among the blocks of its routine.
    block: (u32, u32),
}

/// What is written into a variable.
#[derive(Debug)]
pub(super) enum Written {
    Exactly(f64),
    /// A component of a target as it is declared: which of the six.
    Coordinate(f64, TargetId, u8),
    Value(Box<[u8]>, Place, Context),
    /// What a loop counts, and once more.
    Counted(usize),
}

/// What is known of numbers.
#[derive(Debug, Default)]
pub(super) struct Known {
    pub numbers: Numbers<Written>,
    blocks: Blocks,
    loops: Vec<Counting>,
    /// Those that are not closed yet.
    open: Vec<usize>,
    /// What calls give, and the routines that they name.
    pub given: Vec<Given>,
    pub called: HashSet<(Symbol, Context)>,
    /// What interrupts call.
    pub interrupting: Vec<(Symbol, Context)>,
    pub declared: HashSet<u32>,
    /// Frames that are asked for components, or displace positions.
    pub displacing: Vec<Symbol>,
    /// What is written into frames.
    pub frames: Vec<FrameWrite>,
    /// What the components of frames are called.
    pub components: HashMap<(u32, u8), u32>,
    /// Those that are written not by FOR alone, and by which routines.
    assigned: HashMap<u32, HashSet<u32>>,
}

impl Known {
    pub(super) fn begin(&mut self, routine: u32) {
        self.end();
        self.blocks.begin(routine);
        self.open.clear();
    }

    /// The text of a routine ends.
    pub(super) fn end(&mut self) {
        let (routine, _) = self.blocks.last();
        let flow = std::mem::take(&mut self.blocks.flow);
        if !flow.is_empty() && !self.numbers.has_jumps(routine) {
            self.numbers.goes(routine, flow);
        }
    }

    /// A number is written, and not by FOR alone: loops around that count with it run any number of
    /// times, and those of other routines that it is known in.
    fn assign(&mut self, number: u32) {
        let routine = self.blocks.last().0;
        let is_of_loop = |of: &&Counting| of.counter == number;
        for of in self.open.iter().map(|at| &self.loops[*at]) {
            if is_of_loop(&of) {
                self.numbers.unbounded(of.block);
            }
        }
        let is_new = self.assigned.entry(number).or_default().insert(routine);
        if is_new && number & OF_ROUTINE == 0 {
            for of in self.loops.iter().filter(is_of_loop) {
                if of.block.0 != routine {
                    self.numbers.unbounded(of.block);
                }
            }
        }
    }

    /// Whether another routine than the present one writes a number.
    fn is_assigned_elsewhere(&self, number: u32) -> bool {
        let routine = self.blocks.last().0;
        let assigned = self.assigned.get(&number);
        assigned.is_some_and(|routines| routines.iter().any(|one| *one != routine))
    }

    /// How often the loop runs at most whose first line ends there.
    pub(super) fn rounds(&self, file: u32, end: usize) -> Option<u32> {
        let start = |of: &Counting| (of.file, of.inside.0);
        let at = (file, short(end));
        let before = self.loops.partition_point(|of| start(of) < at);
        let of = self.loops.get(before).filter(|of| start(of) == at)?;
        of.most.filter(|_| self.numbers.is_bounded(of.block))
    }

    fn counting(&self, name: u32, at: Place) -> Option<usize> {
        if self.assigned.contains_key(&name) {
            return None;
        }
        let start = |of: &Counting| (of.file, of.inside.0);
        let before = self
            .loops
            .partition_point(|of| start(of) <= (at.file, at.offset));
        (0..before).rev().find(|of| {
            let of = &self.loops[*of];
            of.counter == name && of.file == at.file && at.offset < of.inside.1
        })
    }
}

impl Names {
    /// What a name is called in the numbers.
    pub(super) fn number(&self, name: Symbol, context: Context) -> u32 {
        let datum = self.datum(name, context);
        let is_own = |datum: &u32| self.data[*datum as usize].context.routine.is_some();
        datum
            .filter(is_own)
            .map_or(name.0, |datum| OF_ROUTINE | datum)
    }
}

impl Reader {
    /// A routine may write a variable that it is given.
    pub(super) fn note_given_number(&mut self, name: Symbol) {
        let number = self.names.number(name, self.context());
        self.names.known.assign(number);
    }

    /// Only the running program knows a variable, or a component of it.
    fn lose_number(&mut self, name: Symbol, part: Option<u8>) {
        let context = self.context();
        self.names.note_own_written(name, context);
        let number = self.names.number(name, context);
        let known = &mut self.names.known;
        known.assign(number);
        known.numbers.lose(number);
        known.frame_lost((name, context), part, Value::Lost);
    }

    /// Names behind a type, with values or without.
    pub(super) fn numbers_declared(&mut self, mut cursor: Cursor) {
        loop {
            let name = cursor.next();
            if name.kind != Kind::Name {
                return;
            }
            let Ok(sizes) = cursor.brackets() else { return };
            let symbol = self.symbol(&cursor, name);
            let number = self.names.number(symbol, self.context());
            self.names.known.declared.insert(number);
            if cursor.take(b'=') {
                if cursor.blanks() == b'{' || sizes.is_some() {
                    return;
                }
                let start = cursor.at;
                while !matches!(cursor.blanks(), 0 | b';' | b',') {
                    cursor.next();
                }
                self.number_written(symbol, start, &cursor, None);
            }
            if !cursor.take(b',') {
                return;
            }
        }
    }

    /// A value in a data list, behind the name.
    pub(super) fn number_initial(&mut self, name: Token, mut cursor: Cursor) {
        if cursor.brackets().is_ok() && cursor.take(b'=') && cursor.blanks() != b'{' {
            let start = cursor.at;
            cursor.skip_all();
            let symbol = self.symbol(&cursor, name);
            self.number_written(symbol, start, &cursor, None);
        }
    }

    fn number_written(&mut self, name: Symbol, start: usize, cursor: &Cursor, site: Option<()>) {
        let text = cursor.bytes[start..cursor.at.min(cursor.end)].trim_ascii();
        let at = Place {
            file: self.file,
            offset: short(start),
        };
        let context = self.context();
        let number = self.names.number(name, context);
        let known = &mut self.names.known;
        known.assign(number);
        let site = site.map(|()| known.blocks.site());
        let value = Written::Value(text.into(), at, context);
        known.numbers.write(number, value, site);
    }

    /// What a statement writes into numbers, before any is read.
    pub(super) fn note_numbers(&mut self, word: &[u8], first: Token, mut cursor: Cursor) {
        let known = &mut self.names.known;
        let next = cursor.blanks();
        match word {
            b"IF" => {
                let inside = known.blocks.open_branch();
                let start = cursor.at;
                cursor.skip_all();
                let text = &cursor.bytes[start..cursor.at];
                let capitals = text.to_ascii_uppercase();
                let end = numbers::word(&capitals, "THEN").unwrap_or(text.len());
                self.check((inside, true), &text[..end], start);
            }
            b"SWITCH" => known.blocks.open(Some(1)),
            b"ELSE" | b"CASE" | b"DEFAULT" => known.blocks.branch(),
            b"LOOP" | b"REPEAT" => known.blocks.open(None),
            b"WHILE" => {
                let inside = known.blocks.open_loop(None);
                let block = known.blocks.last();
                let start = cursor.at;
                cursor.skip_all();
                let condition = &cursor.bytes[start..cursor.at];
                let context = self.context();
                for (name, relation, limit) in bounds_in(condition) {
                    let name = self.names.symbols.intern(name);
                    let number = self.names.number(name, context);
                    let at = Place::new(self.file, short(start));
                    let limit = Written::Value(limit.into(), at, context);
                    let numbers = &mut self.names.known.numbers;
                    numbers.bound(block, number, (relation, limit));
                }
                self.check((inside, true), condition, start);
            }
            b"UNTIL" => {
                if let Some(end) = known.blocks.close_or_repeat() {
                    let start = cursor.at;
                    cursor.skip_all();
                    self.check((end, true), &cursor.bytes[start..cursor.at], start);
                }
            }
            b"ENDIF" | b"ENDSWITCH" | b"ENDLOOP" | b"ENDWHILE" => known.blocks.close(),
            b"EXIT" => known.blocks.flow.leave(),
            b"ENDFOR" => {
                known.blocks.close();
                if let Some(open) = known.open.pop() {
                    known.loops[open].inside.1 = first.start;
                }
            }
            b"GOTO" => {
                if let Some(routine) = self.context().routine {
                    self.names.known.numbers.jumps(routine);
                }
            }
            b"FOR" => {
                let name = cursor.next();
                let start = cursor.at;
                cursor.skip_all();
                let text = cursor.bytes[start..cursor.at].to_ascii_uppercase();
                let counter = self.symbol(&cursor, name);
                let context = self.context();
                let counter = self.names.number(counter, context);
                let known = &mut self.names.known;
                let at = known.loops.len();
                known.loops.push(Counting {
                    counter,
                    context,
                    file: self.file,
                    inside: (short(cursor.end), u32::MAX),
                    text: text.into(),
                    most: None,
                    block: (0, 0),
                });
                known.open.push(at);
                let site = known.blocks.site();
                known
                    .numbers
                    .write(counter, Written::Counted(at), Some(site));
                let plain = evaluate_loop(&known.loops[at].text, &mut |_| Quantity::unknown());
                let most = plain
                    .and_then(|(from, to, step)| rounds(from.exact()?, to.exact()?, step.exact()?));
                // one that other routines change counts otherwise
                let is_counted = !known.is_assigned_elsewhere(counter);
                known.numbers.writes_elsewhere(counter);
                let most = most.filter(|_| is_counted);
                known.blocks.open_loop(most);
                (known.loops[at].most, known.loops[at].block) = (most, known.blocks.last());
            }
            b"ANIN" | b"DIGIN" => {
                cursor.next();
                let name = cursor.next();
                let name = self.symbol(&cursor, name);
                let part = cursor.brackets().is_ok() && cursor.take(b'.');
                let part = part.then(|| cursor.next());
                let part = part.and_then(|part| part_of(cursor.text(part)));
                self.lose_number(name, part);
            }
            b"INTERRUPT" | b"TRIGGER" => {
                if let Some((name, rest)) = action(cursor) {
                    let called = self.symbol(&cursor, name);
                    let context = self.context();
                    self.names.known.interrupting.push((called, context));
                    self.note_write(name, rest, false);
                }
            }
            b"RETURN" => {
                known.blocks.flow.stop();
                if let Some(routine) = self.context().routine {
                    let start = cursor.at;
                    cursor.skip_all();
                    let value = cursor.bytes[start..cursor.at].trim_ascii();
                    if !value.is_empty() {
                        let at = Place::new(self.file, short(start));
                        let value = Written::Value(value.into(), at, self.context());
                        let numbers = &mut self.names.known.numbers;
                        numbers.write(RESULT | routine, value, None);
                    }
                }
            }
            _ if matches!(next, b'=' | b'[' | b'.') => self.note_write(first, cursor, true),
            _ => {}
        }
    }

    /// Notes what a condition says of numbers where an edge is gone, and where it is not.
    fn check(&mut self, (step, is_next): (u32, bool), condition: &[u8], start: usize) {
        let Some(routine) = self.context().routine else {
            return;
        };
        let context = self.context();
        let at = Place::new(self.file, short(start));
        for (holds, side, relation, limit) in compared_in(condition) {
            if side.iter().all(|b| is_letter(*b)) && !side[0].is_ascii_digit() {
                let name = self.names.symbols.intern(side);
                let number = self.names.number(name, context);
                let limit = Written::Value(limit.into(), at, context);
                let (edge, numbers) = ((step, is_next == holds), &mut self.names.known.numbers);
                numbers.check(routine, edge, number, (relation, limit));
            }
        }
    }

    /// Notes what `name[..].part=value` writes, behind the name; in the order of the text or at any
    /// time.
    fn note_write(&mut self, name: Token, mut cursor: Cursor, is_in_order: bool) {
        let Ok(at) = cursor.brackets() else { return };
        let part = cursor.take(b'.').then(|| cursor.next());
        if !cursor.take(b'=') || cursor.blanks() == b'=' {
            return;
        }
        let start = cursor.at;
        let is_aggregate = cursor.blanks() == b'{';
        cursor.skip_all();
        let name = self.symbol(&cursor, name);
        let is_whole = at.is_none() && is_in_order;
        if part.is_none() && !is_aggregate {
            if !is_whole {
                let number = self.names.number(name, self.context());
                self.names.known.numbers.writes_elsewhere(number);
            }
            self.number_written(name, start, &cursor, is_whole.then_some(()));
        }
        let site = is_whole.then(|| self.names.known.blocks.site());
        self.frame_written(name, part, start, &cursor, site);
    }

    /// The value of an expression at the present statement; `own` gives that of operands that are
    /// no variables.
    pub(super) fn quantity(
        &self,
        text: &[u8],
        own: &mut dyn FnMut(&[u8]) -> Option<Quantity>,
    ) -> Quantity {
        let mut of = |number| self.number_value_of(number);
        self.evaluated(text, (self.here, self.context()), &mut of, own)
    }

    /// What a number may be, by what it is called.
    pub(super) fn number_value_of(&self, number: u32) -> Quantity {
        let written =
            |what: &Written, of: &mut dyn FnMut(u32) -> Quantity| self.written_value(what, of);
        self.names.known.numbers.value(number, &written)
    }

    /// The one part of a position that stands in a sum: its letters, where it is in the text, and the
    /// rest of the sum.
    pub(super) fn term_and_rest(
        &self,
        value: &[u8],
        own: &[u8],
        letters: &dyn Fn(&[u8]) -> Vec<u8>,
    ) -> Option<(Vec<u8>, Range<usize>, Quantity)> {
        let (mut term, mut is_one) = (None, true);
        let quantity = self.quantity(value, &mut |operand| {
            let start = operand.as_ptr().addr() - value.as_ptr().addr();
            let range = start..start + operand.len();
            let operand = letters(operand);
            let name = operand.split(|b| matches!(b, b'.' | b'[')).next();
            let name = name.and_then(|name| self.names.symbols.find(name));
            let kind = name.and_then(|name| self.names.kind(name, self.context()));
            let is_place = kind.is_some_and(|kind| kind.is_position() || kind == DataKind::Axes);
            let is_part = operand.contains(&b'.') && is_place;
            if operand != own && !is_part {
                return None;
            }
            is_one &= term.is_none();
            term = Some((operand, range));
            Some(Quantity::own())
        });
        let (count, rest) = quantity.apart();
        let (term, range) = term.filter(|_| is_one && count == 1.0)?;
        Some((term, range, rest))
    }

    fn written_value(&self, what: &Written, of: &mut dyn FnMut(u32) -> Quantity) -> Quantity {
        match what {
            Written::Exactly(value) => Quantity::exactly(*value),
            Written::Coordinate(value, target, part) => {
                Quantity::coordinate(*value, *target, *part)
            }
            Written::Value(text, at, context) => {
                self.evaluated(text, (*at, *context), of, &mut |_| None)
            }
            Written::Counted(at) => {
                let counted = self.counted(*at, of);
                // behind the loop the counter is beyond its last value
                let step = counted.steps.first().map_or(1.0, |step| step.by);
                let step = if step.abs() < 1.0 {
                    step.signum()
                } else {
                    step
                };
                counted.plus(Quantity::counted(0.0, step, Some(1)))
            }
        }
    }

    fn counted(&self, at: usize, of: &mut dyn FnMut(u32) -> Quantity) -> Quantity {
        let counting = &self.names.known.loops[at];
        let at = Place {
            file: counting.file,
            offset: counting.inside.0.saturating_sub(1),
        };
        let found = evaluate_loop(&counting.text, &mut |text| {
            self.evaluated(text, (at, counting.context), of, &mut |_| None)
        });
        found.map_or_else(Quantity::unknown, |(from, to, step)| {
            counted(&from, &to, Some(step))
        })
    }

    fn evaluated(
        &self,
        text: &[u8],
        (at, context): (Place, Context),
        of: &mut dyn FnMut(u32) -> Quantity,
        own: &mut dyn FnMut(&[u8]) -> Option<Quantity>,
    ) -> Quantity {
        evaluated(Arithmetic::Typed, text, &mut |operand| match operand {
            Operand::Name(name) => Some(self.value_of_name(name, (at, context), of)),
            Operand::Other(operand) => {
                own(operand).or_else(|| self.given_or_part(operand, context, of))
            }
        })
    }

    /// The value of a name.
    fn value_of_name(
        &self,
        name: &[u8],
        (at, context): (Place, Context),
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        let known = &self.names.known;
        let Some(name) = self.names.symbols.find(name) else {
            return Quantity::unknown();
        };
        let number = self.names.number(name, context);
        if let Some(counting) = known.counting(number, at) {
            return self.counted(counting, of);
        }
        if known.declared.contains(&number) {
            of(number)
        } else {
            self.declared_elsewhere(number, of)
        }
    }

    /// The value of a number of the controller, or of files that are not here.
    fn declared_elsewhere(&self, number: u32, of: &mut dyn FnMut(u32) -> Quantity) -> Quantity {
        let elsewhere = Quantity::unknown();
        if self.names.known.numbers.is_written(number) {
            Quantity::any(&[of(number), elsewhere])
        } else {
            elsewhere
        }
    }

    /// The value of an operand that is no name alone: what a function gives, or a component; `None`
    /// where it is worked out of the numbers in it.
    fn given_or_part(
        &self,
        operand: &[u8],
        context: Context,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Option<Quantity> {
        let length = operand.iter().take_while(|b| is_letter(**b)).count();
        let (text, rest) = operand.split_at(length);
        let sign = *rest.trim_ascii_start().first()?;
        let name = self.names.symbols.find(text);
        if sign == b'(' {
            let routine = name.and_then(|name| self.names.routine(name, context));
            return match routine {
                Some(routine) => Some(of(RESULT | routine)),
                // one of arithmetic, or one that is not in the files
                None => (!is_worked_out(text)).then(Quantity::unknown),
            };
        }
        let part = memchr::memrchr(b'.', rest).map(|at| rest[at + 1..].trim_ascii());
        let (Some(name), Some(part)) = (name, part) else {
            return None;
        };
        if text.eq_ignore_ascii_case(b"$NULLFRAME") {
            return Some(Quantity::exactly(0.0));
        }
        // where the robot is may be anywhere
        let place = text.get(..5).unwrap_or_default();
        if [&b"$POS_"[..], b"$AXIS"]
            .iter()
            .any(|of| place.eq_ignore_ascii_case(of))
        {
            return Some(Quantity::endless());
        }
        let is_declared = self.names.datum(name, context).is_some();
        let number = self.names.number(name, context);
        let component = part_of(part)
            .and_then(|part| self.names.known.components.get(&(number, part)).copied());
        Some(match component {
            Some(component) if is_declared => of(component),
            Some(component) => self.declared_elsewhere(component, of),
            None if is_declared => Quantity::endless(),
            None => Quantity::unknown(),
        })
    }
}

/// Whether the value of a function is worked out of what it is given.
pub(super) fn is_worked_out(name: &[u8]) -> bool {
    WORKED_OUT.iter().any(|of| name.eq_ignore_ascii_case(of))
}

/// Functions whose value is.
///
/// # Source
/// KUKA System Software, Operating and Programming Instructions for System Integrators ("Standard
/// functions").
const WORKED_OUT: [&[u8]; 8] = [
    b"ABS", b"SQRT", b"SIN", b"COS", b"TAN", b"ACOS", b"ATAN2", b"ROUND",
];

/// The numbers of `=0 TO 9 STEP 2`.
fn evaluate_loop(
    text: &[u8],
    of: &mut dyn FnMut(&[u8]) -> Quantity,
) -> Option<(Quantity, Quantity, Quantity)> {
    let text = text.trim_ascii().strip_prefix(b"=")?;
    let to = numbers::word(text, "TO")?;
    let rest = &text[to + 2..];
    let step = numbers::word(rest, "STEP");
    let mut value = |text: &[u8]| {
        evaluate(text, &mut |_| Quantity::unknown())
            .filter(|value| value.exact().is_some())
            .unwrap_or_else(|| of(text))
    };
    let (from, last) = (
        value(&text[..to]),
        value(&rest[..step.unwrap_or(rest.len())]),
    );
    let step = step.map_or_else(|| Quantity::exactly(1.0), |at| value(&rest[at + 4..]));
    Some((from, last, step))
}
