//! What reals and transformations are, by what statements write into them.

use super::calls::{is_started, started};
use super::keywords::find;
use super::moves::is_joints;
use super::reader::{Reader, key};
use super::sections::{SPELLING, Statement};
use super::targets::{Name, shifted};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::program::TargetId;
use crate::program::contexts::{Varied, varied};
use crate::program::quantity::Quantity;
use crate::program::script::{Expr, Place, Remark, RoutineId, VariableId, short};
use crate::program::transformations::{
    EACH, Edge, Entries, Numbering, Of, Reads, Steps, Written, exactly,
};
use crate::program::words::Words;
use foldhash::HashMap;

/// What is known of reals and transformations.
#[derive(Debug, Default)]
pub(super) struct Known<'a> {
    pub entries: Entries<'a>,
    /// The first number of each name, by the program that it belongs to and its stem.
    names: HashMap<(Option<RoutineId>, Vec<u8>), u32>,
}

impl Known<'_> {
    fn number(&mut self, name: (Option<RoutineId>, Vec<u8>)) -> u32 {
        let next = short(self.names.len());
        *self.names.entry(name).or_insert(next * EACH)
    }
}

/// Functions of what only the running program knows.
///
/// # Source
/// Kawasaki AS Language Reference Manual (90209-1022DED), functions.
const INPUTS: &[&[u8]] = &[
    b"sig",
    b"bits",
    b"bits32",
    b"sigpoint",
    b"timer",
    b"utimer",
    b"task",
    b"switch",
    b"error",
    b"ain",
    b"adc",
    b"rnd",
    b"random",
    b"existreal",
    b"asc",
    b"val",
];

/// Instructions that write no variable.
const READING: &[&[u8]] = &[
    b"print",
    b"type",
    b"ifpwprint",
    b"signal",
    b"pulse",
    b"dlysig",
    b"twait",
    b"swait",
    b"wait",
    b"break",
    b"bits",
    b"bits32",
    b"reset",
    b"pause",
    b"open",
    b"openi",
    b"close",
    b"closei",
    b"relax",
    b"relaxi",
    b"cp",
    b"send",
    b"runmask",
];

impl<'a> Reader<'a> {
    /// What is known of numbers; that is looked for where a position first asks.
    fn known(&self) -> &Known<'a> {
        self.known.get_or_init(|| {
            let mut known = Known::default();
            for (name, value) in &self.sections.reals {
                let number = known.number((None, Name::of_entry(name).stem));
                known.entries.declare(number, Some(*value));
            }
            for entry in &self.sections.entries {
                let number = known.number((None, Name::of_entry(entry.name).stem));
                for (at, value) in (0..EACH).zip(&entry.numbers) {
                    known.entries.declare(number + at, Some(value.value));
                }
            }
            for (routine, program) in (0..).zip(&self.sections.programs) {
                let bytes = &self.sources[program.place.file as usize].bytes;
                known.entries.begin(routine);
                if is_started(program.name) {
                    known.entries.starts(routine);
                }
                let tell = |line: &Statement<'a, '_>| self.tell(line, routine, &mut known);
                program.each(bytes, |_| true, tell);
            }
            known.entries.finish();
            known
        })
    }

    /// How often the loop runs at most that a statement begins.
    pub(super) fn rounds(&self, statement: Words) -> Option<u32> {
        let at = short(statement.span().start);
        self.known().entries.rounds((self.here.routine, at))
    }

    /// Whether nothing but calls writes a parameter of a program.
    pub(super) fn is_only_given(&self, routine: RoutineId, stem: &[u8]) -> bool {
        let known = self.known();
        let number = known.names.get(&(Some(routine), stem.to_vec()));
        number.is_none_or(|number| known.entries.is_only_given(*number))
    }

    fn number_of(&self, name: &Name, routine: RoutineId, known: &mut Known) -> u32 {
        known.number((self.owner_in(name, routine), name.stem.clone()))
    }

    /// Notes what a statement writes.
    fn tell(&self, line: &Statement<'a, '_>, routine: RoutineId, known: &mut Known<'a>) {
        let part = line.words;
        let rest = part.behind(1);
        if !part.is_empty() {
            known.entries.begin_statement(part.span().start);
        }
        if let Some(label) = line.label {
            known.entries.label(key(label));
        }
        if let Some(at) = find(part, "GOto") {
            self.tell_jump(line, at, routine, known);
        }
        match line.keyword {
            "IF" if part.find(b"THEN").is_some() => {
                let inside = known.entries.open_branch();
                self.check(inside, rest.before_word(b"THEN"), routine, known);
            }
            "CASE" | "SCASE" => _ = known.entries.open_branch(),
            "ELSEIF" | "ELse" | "VALUE" | "SVALUE" => known.entries.branch(),
            "ANY" if part.len() == 1 || part.is(1, b':') => known.entries.branch(),
            "WHile" => {
                let inside = known.entries.open_loop();
                self.check(inside, rest.before_word(b"DO"), routine, known);
            }
            "DO" => _ = known.entries.open_loop(),
            "FOR" => self.tell_loop(rest, routine, known),
            "ENd" => known.entries.close(),
            "UNtil" => {
                if let Some(behind) = known.entries.close_or_repeat() {
                    self.check(behind, rest, routine, known);
                }
            }
            "RETurn" | "RETURNE" | "STOp" | "HAlt" => known.entries.stop(),
            "POint" => self.tell_point(rest, routine, known),
            "PCEXecute" | "ONE" => {
                for callee in self.programs_of(started(rest).text(0)) {
                    known.entries.starts(callee);
                }
            }
            "HEre" => {
                // where the robot is may be anywhere
                if let Some((name, _)) = Name::defined(rest) {
                    let number = self.number_of(&name, routine, known);
                    known.entries.assign_all(number, None, false);
                }
            }
            _ if find(part, "CAll").is_some() => {
                let call = part.behind(find(part, "CAll").map_or(0, |at| at + 1));
                let is_at_any_time = matches!(line.keyword, "ON" | "ONI");
                self.tell_call(call, is_at_any_time, routine, known);
            }
            "" | "HSENSE" => self.tell_other(part, routine, known),
            _ => {}
        }
    }

    /// `GOTO 10 IF n<5`, `IF n<5 GOTO 10`; from anywhere behind `ON`.
    fn tell_jump(
        &self,
        line: &Statement<'a, '_>,
        at: usize,
        routine: RoutineId,
        known: &mut Known<'a>,
    ) {
        let part = line.words;
        let label = part.text(at + 1);
        let condition = match line.keyword {
            "GOto" => part.find(b"IF").map(|of| part.behind(of + 1)),
            "IF" => Some(part.part(1..at)),
            _ => return known.entries.jumps_anywhere(),
        };
        let edge = known.entries.jump(key(label), condition.is_some());
        if let Some(condition) = condition {
            self.check(edge, condition, routine, known);
        }
    }

    /// What a condition says of numbers where an edge is gone, and where it is not.
    fn check(
        &self,
        edge: Edge,
        condition: Words<'a, '_>,
        routine: RoutineId,
        known: &mut Known<'a>,
    ) {
        let mut entries = std::mem::take(&mut known.entries);
        entries.check(edge, condition.whole(), &mut |side| {
            let words = condition.within(side);
            let (name, _) = Name::of(words).filter(|(_, length)| *length == words.len())?;
            let is_whole = name.key.as_ref().is_some_and(Vec::is_empty);
            is_whole.then(|| self.number_of(&name, routine, known))
        });
        known.entries = entries;
    }

    /// `FOR i = 1 TO 10 STEP 2`
    fn tell_loop(&self, part: Words<'a, '_>, routine: RoutineId, known: &mut Known<'a>) {
        let name = Name::of(part).filter(|(_, words)| part.is(*words, b'='));
        let range = part.behind(name.as_ref().map_or(0, |(_, words)| words + 1));
        let counter = name.map(|(name, _)| {
            let is_whole = name.key.as_ref().is_some_and(Vec::is_empty);
            (self.number_of(&name, routine, known), is_whole)
        });
        known.entries.count(counter, range);
    }

    /// `POINT p = …`, `POINT/Z p = …`
    fn tell_point(&self, part: Words<'a, '_>, routine: RoutineId, known: &mut Known<'a>) {
        let is_partial = part.is(0, b'/');
        let axis = part.text(1);
        let part = part.behind(if is_partial { 2 } else { 0 });
        let defined = part.before(b'=');
        let Some((name, is_sum)) = Name::defined(defined) else {
            return;
        };
        let value = part.behind(defined.len() + 1);
        let is_whole = name.key.as_ref().is_some_and(Vec::is_empty);
        let is_followed = !is_sum && !is_joints(value) && !name.is_joints();
        let text = Some(value.whole()).filter(|_| is_followed);
        let number = self.number_of(&name, routine, known);
        if !is_partial {
            return known.entries.assign_all(number, text, is_whole);
        }
        for at in axes(axis) {
            let part = |text| Written::Part(text, at as usize);
            let written = text.map_or(Written::Somehow, part);
            known.entries.assign(number + at, written, is_whole);
        }
    }

    /// `name(a,b)`
    fn tell_call(
        &self,
        call: Words<'a, '_>,
        is_at_any_time: bool,
        routine: RoutineId,
        known: &mut Known<'a>,
    ) {
        let callees = self.programs_of(call.text(0));
        for &callee in &callees {
            known.entries.calls(callee);
            if is_at_any_time {
                known.entries.starts(callee);
            }
        }
        if !call.is(1, b'(') {
            return;
        }
        for (at, given) in call.inside(1).0.list().into_iter().enumerate() {
            let name = Name::of(given).filter(|(_, words)| *words == given.len());
            let back = name.map(|(name, _)| self.number_of(&name, routine, known));
            if let Some(back) = back.filter(|_| callees.is_empty()) {
                known.entries.lose(back);
            }
            for &callee in &callees {
                let own = self.parameters[callee as usize].get(at);
                let Some(own) = own.cloned() else { continue };
                let own = known.number((Some(callee), own));
                // a real is the first number of it
                let is_pose = self.is_transformation(given, routine);
                if is_pose {
                    known.entries.give_all(callee, own, given.whole(), back);
                } else {
                    known.entries.give(callee, own, given.whole(), back);
                }
            }
        }
    }

    /// `h = 200`, and what instructions of other kinds write.
    fn tell_other(&self, part: Words<'a, '_>, routine: RoutineId, known: &mut Known<'a>) {
        if let Some((name, words)) = Name::of(part).filter(|(_, words)| part.is(*words, b'=')) {
            let number = self.number_of(&name, routine, known);
            let is_whole = name.key.as_ref().is_some_and(Vec::is_empty);
            let value = part.behind(words + 1).whole();
            let written = Written::Text(value);
            return known.entries.assign(number, written, is_whole);
        }
        let instruction = part.text(0).to_ascii_lowercase();
        if READING.contains(&&instruction[..]) {
            return;
        }
        let is_decomposing = instruction == b"decompose";
        for given in part.behind(1).list() {
            let given = if is_decomposing {
                given.before(b'=')
            } else {
                given
            };
            let name = Name::of(given).filter(|(_, words)| *words == given.len());
            let Some((name, _)) = name else { continue };
            let number = self.number_of(&name, routine, known);
            if is_decomposing {
                known.entries.assign_all(number, None, false);
            } else {
                known.entries.lose(number);
            }
        }
    }

    /// Whether words are a transformation, and not a real number.
    pub(super) fn is_transformation(&self, part: Words<'a, '_>, routine: RoutineId) -> bool {
        let (_, first) = part.terms().first().copied().unwrap_or((0, part));
        let is_built = [
            &b"TRANS"[..],
            b"SHIFT",
            b"FRAME",
            b"RX",
            b"RY",
            b"RZ",
            b"HERE",
            b"NULL",
        ];
        if is_built.iter().any(|word| first.is_word(0, word)) || first.is(0, b'&') {
            return true;
        }
        let name = Name::of(first);
        name.is_some_and(|(name, _)| {
            let written = (routine, name.stem.clone());
            self.owner_in(&name, routine).is_none() && self.is_assigned(&name, routine)
                || self.written.contains(&written)
                || self.elements_in(&name, routine).is_some()
        })
    }

    // ---- values

    /// What words of the present statement come to.
    pub(super) fn quantity(&self, part: Words<'a, '_>) -> Quantity {
        self.quantity_of(part, &mut |number| {
            let at = (self.here.routine, short(self.here.at));
            self.known().entries.value(number, at, self)
        })
    }

    fn quantity_of(&self, part: Words<'a, '_>, of: &mut Of) -> Quantity {
        // most are numbers
        if let Some(value) = part.value() {
            return Quantity::exactly(value);
        }
        Reads::quantity(self, part.whole(), self.here.routine, of)
    }

    /// The numbers of a list, blanks as 0; what is behind the sixth is not followed.
    pub(super) fn quantities(&self, list: &[Words<'a, '_>]) -> Varied<[Quantity; 6]> {
        if list.len() > EACH as usize {
            return Varied::one([(); 6].map(|()| Quantity::endless()));
        }
        self.varied(&mut |of| {
            let mut found = exactly([0.0; 6]);
            for (number, part) in found.iter_mut().zip(list) {
                *number = self.quantity_of(*part, of);
            }
            found
        })
    }

    /// What comes of numbers at the present statement, call by call.
    fn varied<T>(&self, evaluate: &mut dyn FnMut(&mut Of) -> T) -> Varied<T> {
        let at = (self.here.routine, short(self.here.at));
        varied(&Numbering(self), at, evaluate)
    }

    /// What is added to a position at the present statement; names whose numbers are taken keep
    /// them.
    pub(super) fn steps(&mut self, part: Words<'a, '_>) -> Varied<Steps> {
        self.keep_numbers(part);
        self.varied(&mut |of| self.sum(part, self.here.routine, of))
    }

    /// Targets that a statement adds up keep their numbers, and so do those that these are copies of.
    fn keep_numbers(&mut self, part: Words<'a, '_>) {
        let (mut open, mut targets) = (Vec::new(), Vec::new());
        added(part, &mut |term| {
            open.extend(added_name(term).map(|name| (name, self.here.routine)));
        });
        let source = &self.sources[self.here.file as usize];
        let (line, _) = source.line_column(self.here.at);
        let remark = super::remarks::added_up(&source.name, line);
        while let Some((name, routine)) = open.pop() {
            let owner = self.owner_in(&name, routine);
            if !self.added.insert((owner, name.clone())) {
                continue;
            }
            targets.extend(self.targets_of(&name, routine));
            if owner.is_none() && !self.is_assigned(&name, routine) {
                continue;
            }
            let known = self.known();
            let Some(number) = known.names.get(&(owner, name.stem)) else {
                continue;
            };
            let mut literals = Vec::new();
            for (text, routine) in known.entries.transformations(*number) {
                let mut found = Vec::new();
                SPELLING.add(text, 0..text.len(), &mut found);
                let part = Words {
                    bytes: text,
                    all: &found,
                };
                let file = self.sections.programs[routine as usize].place.file;
                let bytes = &self.sources[file as usize].bytes;
                let start = text.as_ptr() as usize - bytes.as_ptr() as usize;
                added(part, &mut |term| match added_name(term) {
                    Some(name) => open.push((name, routine)),
                    // a move may go to it by its name, too
                    None => literals.push(Place::new(file, short(start + term.span().start))),
                });
            }
            for place in literals {
                self.added_literals.push((place, remark.clone()));
            }
        }
        for target in targets {
            self.builder.script.refuse(target, remark.clone());
        }
    }

    /// Transformations that are written out keep their numbers where these are added up.
    pub(super) fn keep_literals(&mut self) {
        let all = std::mem::take(&mut self.added_literals);
        let all: HashMap<Place, Remark> = all.into_iter().rev().collect();
        for target in 0..self.builder.script.targets.len() {
            let of = &self.builder.script.targets[target];
            if let Some(remark) = all.get(&Place::new(of.file, of.offset)) {
                self.builder.script.refuse(target, remark.clone());
            }
        }
    }

    /// The targets that a name may have been declared with: one where nothing writes it and its
    /// index is known.
    fn targets_of(&self, name: &Name, routine: RoutineId) -> Vec<TargetId> {
        let elements = self.elements_in(name, routine);
        let key = name
            .key
            .as_ref()
            .filter(|_| !self.is_assigned(name, routine));
        let one = elements.and_then(|of| of.variables.get(key?)).copied();
        if let Some(target) = one.and_then(|one| self.declared_target(one)) {
            return vec![target];
        }
        let all = elements.into_iter().flat_map(|of| of.variables.values());
        all.filter_map(|one| self.declared_target(*one)).collect()
    }

    fn declared_target(&self, variable: VariableId) -> Option<TargetId> {
        match self.builder.script.variables[variable as usize].declared {
            Expr::Target(target) => Some(target),
            _ => None,
        }
    }

    fn sum(&self, part: Words<'a, '_>, routine: RoutineId, of: &mut Of) -> Steps {
        let mut all = Steps::default();
        for (sign, term) in part.terms() {
            let steps = self.term_steps(term, routine, of);
            let steps = if sign == b'-' { steps.inverse() } else { steps };
            all = all.then(steps);
        }
        all
    }

    fn term_steps(&self, part: Words<'a, '_>, routine: RoutineId, of: &mut Of) -> Steps {
        let list = part.rest_list(1).filter(|_| part.is(1, b'('));
        let axis = [&b"RX"[..], b"RY", b"RZ"]
            .iter()
            .position(|word| part.is_word(0, word));
        match (&list, axis) {
            (Some(list), Some(axis)) if list.len() == 1 => {
                return Steps::about(axis, Reads::quantity(self, list[0].whole(), routine, of));
            }
            (Some(list), None) if part.is_word(0, b"TRANS") && list.len() <= EACH as usize => {
                let mut numbers = exactly([0.0; 6]);
                for (number, text) in numbers.iter_mut().zip(list) {
                    *number = Reads::quantity(self, text.whole(), routine, of);
                }
                return steps_of(numbers);
            }
            _ => {}
        }
        if part.is_word(0, b"NULL") && part.len() == 1 {
            return Steps::default();
        }
        if let Some((shifted, way)) = shifted(part) {
            // along the axes that the sum counts in, before those that it turns
            let mut numbers = exactly([0.0; 6]);
            for (number, text) in numbers.iter_mut().zip(way.list().into_iter().take(3)) {
                *number = Reads::quantity(self, text.whole(), routine, of);
            }
            return Steps::one(numbers).then(self.sum(shifted, routine, of));
        }
        if part.is(0, b'(') && part.closing(0) + 1 == part.len() {
            return self.sum(part.inside(0).0, routine, of);
        }
        match Name::of(part).filter(|(_, words)| *words == part.len()) {
            Some((name, _)) if !name.is_joints() => {
                let at = |at| self.part_of(&name, at, routine, of);
                let numbers: Vec<Quantity> = (0..EACH).map(at).collect();
                numbers
                    .try_into()
                    .map_or_else(|_| Steps::endless(), steps_of)
            }
            _ => Steps::endless(),
        }
    }

    /// One of the numbers of a transformation with a name.
    fn part_of(&self, name: &Name, at: u32, routine: RoutineId, of: &mut Of) -> Quantity {
        if !self.is_assigned(name, routine)
            && let (Some(elements), Some(key)) = (self.elements_in(name, routine), &name.key)
            && let Some(one) = elements.variables.get(key)
            && let Some(target) = self.declared_target(*one)
        {
            let numbers = self.builder.script.numbers_of(target);
            return Quantity::exactly(numbers[at as usize].value);
        }
        let owner = self.owner_in(name, routine);
        match self.known().names.get(&(owner, name.stem.clone())) {
            Some(number) => of(number + at),
            None => Quantity::unknown(),
        }
    }
}

impl<'a> Reads<'a> for Reader<'a> {
    fn entries(&self) -> &Entries<'a> {
        &self.known().entries
    }

    fn operand(&self, operand: &[u8], routine: u32, of: &mut Of) -> Option<Quantity> {
        let is_in_name = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.' | 128..);
        let end = operand.iter().take_while(|b| is_in_name(b)).count();
        let (name, behind) = operand.split_at(end);
        let stem = name.to_ascii_lowercase();
        match behind.trim_ascii_start() {
            [] if stem == b"pi" => Some(Quantity::exactly(std::f64::consts::PI)),
            [] | [b'[', .., b']'] => {
                let name = Name { stem, key: None };
                let owner = self.owner_in(&name, routine);
                let number = self.known().names.get(&(owner, name.stem));
                Some(number.map_or_else(Quantity::unknown, |number| of(*number)))
            }
            _ => INPUTS.contains(&&stem[..]).then(Quantity::unknown),
        }
    }

    fn part(&self, text: &'a [u8], at: usize, routine: u32, of: &mut Of) -> Quantity {
        let mut found = Vec::new();
        SPELLING.add(text, 0..text.len(), &mut found);
        let part = Words {
            bytes: text,
            all: &found,
        };
        if let Some(list) = part
            .rest_list(1)
            .filter(|_| part.is_word(0, b"TRANS") && part.is(1, b'('))
        {
            return match list.get(at) {
                Some(number) => Reads::quantity(self, number.whole(), routine, of),
                None => Quantity::exactly(0.0),
            };
        }
        if part.len() == 1 && part.is_word(0, b"NULL") {
            return Quantity::exactly(0.0);
        }
        if part.is_word(0, b"HERE") {
            return Quantity::endless();
        }
        if let Some((name, words)) = Name::of(part)
            && words == part.len()
            && !name.is_joints()
        {
            return self.part_of(&name, short(at), routine, of);
        }
        let exact = self.sum(part, routine, of).exact();
        exact.map_or_else(Quantity::endless, |pose| {
            Quantity::exactly(numbers_of(&pose)[at])
        })
    }
}

/// Visits the transformations that a sum adds up: names, and what is written out.
fn added(part: Words, visit: &mut dyn FnMut(Words)) {
    for (_, term) in part.terms() {
        if term.is(0, b'(') && term.closing(0) + 1 == term.len() {
            added(term.inside(0).0, visit);
        } else if let Some((shifted, _)) = shifted(term) {
            added(shifted, visit);
        } else {
            visit(term);
        }
    }
}

/// The name of a transformation that a term is.
fn added_name(term: Words) -> Option<Name> {
    let (name, words) = Name::of(term)?;
    (words == term.len() && !name.is_joints()).then_some(name)
}

/// The numbers that `POINT/X` and the like write.
fn axes(name: &[u8]) -> std::ops::Range<u32> {
    match name.to_ascii_uppercase().as_slice() {
        b"X" => 0..1,
        b"Y" => 1..2,
        b"Z" => 2..3,
        b"OAT" => 3..6,
        _ => 0..EACH,
    }
}

/// `x y z O A T`: along, and then about z, the new y, the new z.
fn steps_of([x, y, z, o, a, t]: [Quantity; 6]) -> Steps {
    let none = || Quantity::exactly(0.0);
    Steps::one([x, y, z, none(), none(), o])
        .then(Steps::about(1, a))
        .then(Steps::about(2, t))
}

/// The numbers of a pose.
fn numbers_of(pose: &Pose) -> [f64; 6] {
    let [x, y, z] = pose.translation.map(mm_from_m);
    let [o, a, t] = pose.rotation.rzryrz().map(|angle| angle / DEG);
    [x, y, z, o, a, t]
}
