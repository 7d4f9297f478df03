//! Instructions as statements: calls, jumps, blocks, and writes of tools, frames, registers and
//! points.

use super::content::canonical;
use super::controller::{Kind, Mode, Which, kinds};
use super::lines::Line;
use super::moves::Row;
use super::numbers::{ANY_LABEL, MOST_NUMBER, counter, of_position};
use super::offsets::Axes;
use super::reader::{Reader, called};
use super::words::{
    Named, Register, assigned, behind_group, bracket_end, comma, concerns_group_1, each_position,
    element, indexed, is_word, local, motion, parts, position, register, whole, word_length, words,
};
use crate::program::script::{
    Argument, Call, Expr, How, Remark, RoutineId, Start, VariableId, Written, short,
};
use std::collections::BTreeSet;

/// Conditions inside conditions.
const DEEPEST: u32 = 4;
/// Arguments of a call.
const MOST_ARGUMENTS: u32 = 10;
/// Words of the language that begin instructions.
const KNOWN: &str = "ABORT ABBRUCH ARC BREAK CASE COL CONTINUE DEFAULT ENABLE END ENDE IF WENN \
    JOINT_MAX_SPEED LINEAR_MAX_SPEED LOCK MOVE OFFSET OVERRIDE PAUSE RESET RESUME_PROG \
    RETURN_PATH_DSBL SEMAPHORE SKIP STOP TIMER TOOL_OFFSET UALM UNLOCK VOFFSET WAIT WARTEN WEAVE \
    WELD";

/// Where one program is while it is read.
#[derive(Debug, Default)]
pub(super) struct State {
    /// A SELECT is open.
    selects: bool,
    /// The row of arcs that is open.
    pub row: Option<Row>,
    labels: BTreeSet<u64>,
    /// A register says which label the program goes to.
    goes_anywhere: bool,
}

impl Reader<'_> {
    /// One instruction.
    pub(super) fn line(&mut self, line: &Line) {
        let bytes = self.bytes;
        let text = bytes[line.text.clone()].trim_ascii_end();
        // taken out
        if text.starts_with(b"//") {
            return;
        }
        let word = &text[..word_length(text)];
        let is_else = word.eq_ignore_ascii_case(b"ELSE") || word.eq_ignore_ascii_case(b"SONST");
        let is_case = text.starts_with(b"=") || is_else && comma(text).is_some();
        if !is_case && std::mem::take(&mut self.state.selects) {
            self.builder.end_choice();
            self.known.close();
        }
        if is_case || is_else {
            // what the branch before wrote is not there in this one
            self.known.branch();
            self.builder.next_branch(is_else);
            self.behind_comma(text, 0);
        } else if let Some((letter, at)) = motion(text) {
            self.go(line, letter, at);
        } else if !text.is_empty() {
            self.statement(text, 0);
        }
    }

    /// The end of a program's text.
    pub(super) fn end(&mut self) {
        let state = std::mem::take(&mut self.state);
        if state.selects {
            self.builder.end_choice();
        }
        self.known.end();
        if state.goes_anywhere {
            self.builder.back();
            self.builder.label(ANY_LABEL);
            for label in state.labels {
                self.builder.may_go_to(label);
            }
        }
    }

    /// An instruction that is no move. At a depth it stands behind a condition.
    pub(super) fn statement(&mut self, text: &[u8], depth: u32) {
        let (word, rest) = text.split_at(word_length(text));
        let name = word.to_ascii_uppercase();
        let rest = rest.trim_ascii();
        match (name.as_slice(), rest.first()) {
            (b"MESSAGE" | b"MSG", _) => {}
            (b"LBL" | b"LABEL", _) if depth == 0 => {
                if let Some(Some(number)) = indexed(rest) {
                    self.state.labels.insert(number.into());
                    self.known.label(number.into());
                    self.builder.label(number.into());
                }
            }
            (b"LBL" | b"LABEL", _) => self.jump(rest, false),
            (b"JMP" | b"SPRUNG", _) => self.jump(&rest[word_length(rest)..], false),
            (b"IF" | b"WENN", _) if depth == 0 && ends_with_then(rest) => {
                self.known.open();
                self.builder.begin_if(None);
            }
            (b"ENDIF", _) => {
                self.known.close();
                self.builder.end_choice();
            }
            (b"FOR", _) => {
                let text = canonical(rest);
                let most = self
                    .known
                    .begin_loop(self.builder.script.loops.len(), counter(&text));
                self.builder.begin_rounds(true, most);
            }
            (b"ENDFOR", _) => {
                self.known.end_loop();
                self.builder.end_loop(false);
            }
            (b"SELECT", _) if depth == 0 => {
                self.state.selects = true;
                self.known.clear();
                self.known.open();
                self.builder.begin_choice();
                self.builder.next_branch(false);
                self.behind_comma(rest, 0);
            }
            (b"CALL" | b"AUFRUF", _) => self.call(rest),
            (b"RUN", _) => {
                self.known.clear();
                self.start(rest);
            }
            (b"MONITOR", _) => {
                self.known.clear();
                self.monitor(&name, rest);
            }
            (b"ERROR_PROG" | b"RESUME_PROG", Some(b'=' | b'[')) => {
                let program = memchr::memchr(b'=', rest).map(|at| rest[at + 1..].trim_ascii());
                self.monitor(&name, program.unwrap_or_default());
            }
            (b"END" | b"ENDE", None) => self.builder.back(),
            (b"ABORT" | b"ABBRUCH", None) => self.builder.exit(),
            (b"TOUCH" | b"SEARCH" | b"TRACK" | b"MP", _) => {
                self.known.clear();
                self.mode(&name, rest);
            }
            (b"PAYLOAD", Some(b'[')) => self.payload(&rest[1..]),
            (_, Some(b'=')) if selects(&name).is_some() => {
                self.select(selects(&name).flatten(), rest[1..].trim_ascii());
            }
            (_, Some(b'[')) if assigned(rest).is_some() => {
                let (index, value) = assigned(rest).expect("just asked");
                self.assign(&name, index, value);
            }
            _ => match Axes::of(&name) {
                Some(axes) if memchr::memmem::find(rest, b"PR[").is_some() => {
                    self.condition(axes, rest);
                }
                _ => self.other(&name, text, depth),
            },
        }
    }

    /// What a condition or a choice does: the text behind its comma.
    fn behind_comma(&mut self, text: &[u8], depth: u32) {
        let Some(comma) = comma(text).filter(|_| depth < DEEPEST) else {
            return;
        };
        let action = text[comma + 1..].trim_ascii();
        if let Some((letter, at)) = motion(action) {
            let start = action.as_ptr() as usize - self.bytes.as_ptr() as usize;
            let text = start..start + action.len();
            let is_closed = false;
            self.go(&Line { text, is_closed }, letter, at);
        } else {
            self.statement(action, depth + 1);
        }
    }

    /// An instruction that is none of those above: a condition, or one of which nothing is known.
    fn other(&mut self, name: &[u8], text: &[u8], depth: u32) {
        let comma = comma(text);
        let is_condition = matches!(name, b"IF" | b"WENN" | b"WAIT" | b"WARTEN")
            || comma.is_some_and(|comma| is_action(text[comma + 1..].trim_ascii()));
        let mut known = text;
        if let Some(comma) = comma.filter(|_| is_condition) {
            known = &text[..comma];
            let action = text[comma + 1..].trim_ascii();
            let word = action[..word_length(action)].to_ascii_uppercase();
            // what goes elsewhere leaves behind it all as it is
            let is_jump = is_one_of(&word, "JMP SPRUNG LBL LABEL END ENDE ABORT ABBRUCH");
            if !is_jump {
                self.known.open();
            }
            self.builder.begin_if(None);
            self.behind_comma(text, depth);
            self.builder.end_choice();
            if !is_jump {
                self.known.close();
            }
        } else if !is_condition && !is_harmless(name) {
            self.known.clear();
            self.lose_registers(text);
        }
        let mut given = Vec::new();
        each_position(known, |named| {
            given.extend(matches!(named, Named::Point(_) | Named::AnyPoint).then_some(named));
        });
        if !given.is_empty() || !is_condition && is_macro(name, text) {
            self.unknown(text, &given);
        }
    }

    // ---- calls and jumps

    /// `[2]` of a label; the program may go there, or goes.
    pub(super) fn jump(&mut self, index: &[u8], may: bool) {
        let Some(number) = indexed(index) else { return };
        self.state.goes_anywhere |= number.is_none();
        let key = number.map_or(ANY_LABEL, u64::from);
        self.known.jump(key);
        if may {
            self.builder.may_go_to(key);
        } else {
            self.builder.go_to(key);
        }
    }

    /// `PROGRAM(1,R[2])`
    pub(super) fn call(&mut self, text: &[u8]) {
        let name = called(&text[..word_length(text)]);
        let given = text[word_length(text)..].trim_ascii_start();
        let index = given.strip_prefix(b"[").and_then(bracket_end);
        let given = given[index.map_or(0, |length| length + 2)..].trim_ascii_start();
        let given = given.strip_prefix(b"(").unwrap_or_default();
        let given = given.strip_suffix(b")").unwrap_or(given);
        let callees = self.callees(text);
        if callees.len() > 1 && !is_chosen(text) && self.reported_names.insert(name.clone()) {
            let files = callees.iter().map(|(routine, _)| {
                let file = self.builder.script.routines[*routine as usize].place.file;
                &*self.sources[file as usize].name
            });
            let files: Vec<&str> = files.collect();
            let message = format!(
                "{} are programs {name}: either may run here",
                files.join(" and ")
            );
            let hint = "give the programs of one controller, and of its backups one";
            let remark = Remark::warning_about("program-name-ambiguous", message, hint);
            self.say(self.place, remark);
        }
        let first = short(self.builder.script.arguments.len());
        let is_one = callees.len() == 1 && !is_chosen(text);
        for (routine, _) in &callees {
            self.known.calls(*routine, is_one);
        }
        for (routine, _) in callees.iter().filter(|(_, uses_arguments)| *uses_arguments) {
            for (number, value) in (1..=MOST_ARGUMENTS).zip(parts(given)) {
                self.known.give(*routine, number, &canonical(value));
                let value = self.selection(None, value);
                let parameter = Some(self.argument(*routine, number));
                self.give(parameter, value);
            }
        }
        let is_quiet = |(routine, _): &(RoutineId, bool)| self.quiet.contains(routine);
        if callees.is_empty() || is_chosen(text) || !callees.iter().all(is_quiet) {
            self.known.clear();
        }
        let callees = callees.iter().map(|(routine, _)| *routine).collect();
        let arguments = first..short(self.builder.script.arguments.len());
        let mut call = Call::of(self.place, callees, name, arguments);
        call.foreign |= is_chosen(text);
        self.builder.call(call);
    }

    /// The programs that `PROGRAM` may be; with `SR[1]`, `AR[1]`, `PROGRAM[R[1]]` any but the
    /// present one.
    fn callees(&self, text: &[u8]) -> Vec<(RoutineId, bool)> {
        if is_chosen(text) {
            let all = self.by_name.values().flatten().copied();
            let others = all.filter(|(routine, _)| *routine != self.listing.routine);
            let mut all: Vec<_> = others.collect();
            all.sort_unstable();
            return all;
        }
        let name = called(&text[..word_length(text)]);
        self.by_name.get(&name).cloned().unwrap_or_default()
    }

    fn give(&mut self, parameter: Option<VariableId>, value: Expr) {
        self.builder
            .script
            .arguments
            .push(Argument::new(parameter, value, None));
    }

    /// `RUN PROGRAM`: it runs concurrently with this one.
    fn start(&mut self, text: &[u8]) {
        for (routine, _) in self.callees(text) {
            self.known.starts(routine);
            self.builder.script.routines[routine as usize].start = Start::Concurrent;
        }
    }

    /// `MONITOR CONDITION`, `RESUME_PROG[1]=PROGRAM`: from here on it may run between two moves, or
    /// in the middle of one, and move the robot. `MONITOR END CONDITION` ends that.
    fn monitor(&mut self, verb: &[u8], text: &[u8]) {
        let name = &text[..word_length(text)];
        if name.is_empty() || is_one_of(&name.to_ascii_uppercase(), "END ENDE") {
            return;
        }
        self.start(text);
        let routines = self.callees(text).into_iter().map(|(routine, _)| routine);
        let shown = if is_chosen(text) { verb } else { name };
        let call = Call::of(self.place, routines.collect(), called(shown), 0..0);
        self.builder.start(call, true);
    }

    /// An instruction of which only its name is known, such as a macro: a call, which is given the
    /// points that it names.
    fn unknown(&mut self, text: &[u8], given: &[Named]) {
        let first = short(self.builder.script.arguments.len());
        for named in given {
            // once all are given away nothing is new
            let is_new =
                *named != Named::AnyPoint || !std::mem::replace(&mut self.listing.gives_any, true);
            for target in self.targets(*named).into_iter().filter(|_| is_new) {
                self.give(None, Expr::Target(target));
            }
        }
        // a macro has the name of its program as a rule; a call in a dictionary that is not known has
        // it for its last word
        let mut words = words(text);
        let (own, second) = (words.next(), words.next());
        let last = second.or(own).filter(|_| words.next().is_none());
        let callees = last.and_then(|name| self.by_name.get(&called(name)));
        let callees = callees.into_iter().flatten().map(|(routine, _)| *routine);
        self.builder.call(Call {
            place: self.place,
            callees: callees.collect(),
            foreign: true,
            leads: true,
            writes_only: false,
            name: called(&text[..word_length(text)]),
            arguments: first..short(self.builder.script.arguments.len()),
        });
    }

    /// `PAYLOAD[2]`: what the schedules say is not in the files. One is the load of the tool.
    fn payload(&mut self, inside: &[u8]) {
        let index = &inside[..bracket_end(inside).unwrap_or(0)];
        if !concerns_group_1(index) {
            return;
        }
        self.payloads
            .insert(whole(behind_group(index.trim_ascii())));
        let is_one = self.payloads.len() == 1 && !self.payloads.contains(&None);
        if !is_one && !std::mem::replace(&mut self.reported_payload, true) {
            let message = "PAYLOAD selects one of several loads here, which the files do not have; \
                moves are taken with the load of their tool";
            let hint = "give the tool of the profile the load that counts where it must be exact, \
                and compensate programs with another one alone";
            let remark = Remark::warning("load-chosen-at-run-time", message, hint);
            self.say(self.place, remark);
        }
    }

    // ---- writes

    pub(super) fn write(&mut self, variable: Written, how: How) {
        let place = self.place;
        self.builder.write(place, variable, how);
    }

    pub(super) fn set(&mut self, variable: VariableId, value: Expr) {
        self.write(Written::One(variable), How::Whole(value));
    }

    /// An instruction that nobody knows may write the registers that it names.
    fn lose_registers(&mut self, text: &[u8]) {
        let text = canonical(text);
        for at in memchr::memmem::find_iter(&text, b"R[") {
            let is_position = at.checked_sub(1).is_some_and(|before| text[before] == b'P');
            let inside = &text[at + 2..];
            let number = register(&inside[..bracket_end(inside).unwrap_or(0)]).number;
            let Some(number) = number.filter(|number| *number < MOST_NUMBER) else {
                continue;
            };
            if is_position {
                for element in 0..6 {
                    self.known.lose(of_position(number, element));
                }
            } else if at == 0 || !is_word(text[at - 1]) {
                self.known.lose(number);
            }
        }
    }

    fn mode(&mut self, name: &[u8], rest: &[u8]) {
        let Some((mode, variable, holds)) = self.controller.mode(name, rest) else {
            return;
        };
        self.set(variable, holds);
        if mode == Mode::Search && holds != Expr::Absent {
            // what is found goes into the register
            let mut found = None;
            each_position(rest, |named| found = found.or(Some(named)));
            if let Some(Named::Register(Register {
                number: Some(number),
                ..
            })) = found
            {
                let register = self.register(number);
                self.set(register, Expr::Unknown(self.controller.computed));
                self.lose_registers(rest);
            }
        }
    }

    /// `UTOOL_NUM=5`
    fn select(&mut self, which: Which, value: &[u8]) {
        for kind in kinds(which) {
            let value = match which {
                Some(_) => self.selection(which, value),
                None => Expr::Unknown(self.controller.chosen),
            };
            let of = self.controller.of(kind);
            let (selected, active) = (of.selected, of.active);
            self.set(selected, value);
            self.set(active, value);
        }
    }

    /// A number that selects a tool or frame: written out, or an argument of the program's call,
    /// `AR[1]`.
    fn selection(&mut self, which: Which, text: &[u8]) -> Expr {
        if let Some(number) = whole(text) {
            return self
                .controller
                .number(&mut self.builder.script, which, number);
        }
        // what the program has just written into a register
        let written = self.known.entered(u32::MAX, &canonical(text), 0).exact();
        let is_number =
            |value: &f64| value.fract() == 0.0 && (0.0..=f64::from(u8::MAX)).contains(value);
        if let Some(number) = written.filter(is_number) {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let number = number as u32;
            return self
                .controller
                .number(&mut self.builder.script, which, number);
        }
        match text.strip_prefix(b"AR").and_then(indexed).flatten() {
            Some(number) => Expr::Variable(self.argument(self.listing.routine, number)),
            None => Expr::Unknown(self.controller.chosen),
        }
    }

    /// `NAME[index]=value`
    fn assign(&mut self, name: &[u8], index: &[u8], value: &[u8]) {
        let is_ours = concerns_group_1(index);
        match name {
            b"P" => self.set_point(index, value),
            b"PR" | b"LPR" | b"UFRAME" | b"UTOOL" if !is_ours => {}
            b"PR" => self.set_register(index, value),
            b"R" => self.set_number(index, value),
            b"LPR" => self.set_register(&of_program(index), value),
            b"LR" => self.set_number(&of_program(index), value),
            b"UFRAME" | b"UTOOL" => {
                self.set_frame(kind_of(name), whole(behind_group(index)), value);
            }
            b"$MNUTOOLNUM" | b"$MNUFRAMENUM" => {
                if whole(index).is_none_or(|group| group == 1) {
                    self.select(kind_of(&name[3..]), value);
                }
            }
            b"$MNUTOOL" | b"$MNUFRAME" => {
                let mut parts = index.split(|&b| b == b',').map(<[u8]>::trim_ascii);
                let group = parts.next().and_then(whole);
                if group.is_none_or(|group| group == 1) {
                    let number = parts.next().and_then(whole);
                    self.set_frame(kind_of(&name[3..]), number, value);
                }
            }
            _ => match selects(name) {
                Some(which) if is_ours => self.select(which, value),
                Some(_) => {}
                // a position goes into nothing else, in any dictionary
                None if is_whole_position(value) && !is_data(name) => {
                    self.set_frame(None, whole(index), value);
                }
                None => {}
            },
        }
    }

    /// `UFRAME[6]=PR[60]`; without a number a register says which.
    fn set_frame(&mut self, which: Which, number: Option<u32>, value: &[u8]) {
        let assigned = Expr::Unknown(self.controller.assigned);
        let source = match position(value) {
            Some((Named::Register(register), _)) => self.reads(register),
            _ => None,
        };
        for kind in kinds(which).filter(|_| number != Some(0)) {
            let Some(number) = number else {
                let others = self.controller.of(kind).others;
                self.write(Written::AnyOf(others), How::Whole(assigned));
                continue;
            };
            let script = &mut self.builder.script;
            let entry = self.controller.entry(script, kind, number);
            let written = source.filter(|_| which.is_some());
            let numbers = written.and_then(|register| self.known.pose(register));
            if let Some(pose) = numbers {
                let value = Expr::Value(script.frame(number.to_string(), Some(pose)));
                self.set(entry, value);
                continue;
            }
            // whether the register is known depends on the other programs, too
            if let Some(register) = written {
                self.from_registers.push((script.writes.len(), register));
            }
            let value = self.other_frame(value).unwrap_or(assigned);
            self.set(entry, value);
        }
    }

    /// `UTOOL[1]` as a value.
    pub(super) fn other_frame(&mut self, value: &[u8]) -> Option<Expr> {
        let (word, index) = value.split_at(word_length(value));
        let kind = match word {
            b"UTOOL" => Kind::Tool,
            b"UFRAME" => Kind::Frame,
            _ => return None,
        };
        let number = indexed(index)??;
        let entry = self
            .controller
            .entry(&mut self.builder.script, kind, number);
        Some(Expr::Variable(entry))
    }
}

/// Whether a register says which program is called.
pub(super) fn is_chosen(text: &[u8]) -> bool {
    text[word_length(text)..]
        .trim_ascii_start()
        .starts_with(b"[")
}

/// The index of `LPR[4,3]`, as that of a register that other programs do not have; `?` where
/// another register says it.
fn of_program(index: &[u8]) -> Vec<u8> {
    let of = register(index);
    let number = of.number.and_then(local);
    let number = number.map_or("?".into(), |number| number.to_string());
    let element = of.is_element.then(|| element(index)).flatten();
    let element = element.map(|element| format!(",{element}"));
    let element = element.unwrap_or_else(|| if of.is_element { ",?" } else { "" }.into());
    (number + &element).into_bytes()
}

/// Whether `THEN` ends a condition.
fn ends_with_then(text: &[u8]) -> bool {
    let last = text.rsplit(|&b| !is_word(b)).next();
    last.is_some_and(|word| word.eq_ignore_ascii_case(b"THEN"))
}

/// Whether a text begins what is done on a condition.
fn is_action(text: &[u8]) -> bool {
    let word = text[..word_length(text)].to_ascii_uppercase();
    let known = "ABORT ABBRUCH AUFRUF CALL END ENDE JMP LABEL LBL SPRUNG";
    is_one_of(&word, known) || selects(&word).is_some()
}

/// Whether a word in capitals is one of those.
fn is_one_of(word: &[u8], all: &str) -> bool {
    all.split_ascii_whitespace()
        .any(|known| known.as_bytes() == word)
}

/// `UTOOL_NUM` and its translations.
fn selects(name: &[u8]) -> Option<Which> {
    name.strip_suffix(b"_NUM").map(kind_of)
}

fn kind_of(name: &[u8]) -> Which {
    match name {
        [b'U', b'T', ..] | [b'W', b'K', b'Z', ..] => Some(Kind::Tool),
        [b'U', b'F', ..] | [b'B', b'E', b'N', ..] => Some(Kind::Frame),
        _ => None,
    }
}

/// Whether a value is a position, and not one number of it.
fn is_whole_position(value: &[u8]) -> bool {
    position(value).is_some_and(|(named, _)| match named {
        Named::Register(register) => !register.is_element,
        Named::Point(_) | Named::AnyPoint => true,
        Named::Computed => false,
    })
}

/// Registers and signals.
fn is_data(name: &[u8]) -> bool {
    is_one_of(name, "R AR SR VR DO RO GO AO DI RI GI AI F M TIMER")
}

/// Whether an instruction that is no assignment writes no registers, and calls nothing.
fn is_harmless(name: &[u8]) -> bool {
    let is_value = matches!(name, [] | [b'$', ..]);
    is_value || is_one_of(name, "OVERRIDE PAYLOAD PAUSE UALM LOCK UNLOCK SKIP")
}

/// Whether an instruction may be a macro of the user's, which is a call: words of the language, and
/// those with an index or an assignment, are none.
fn is_macro(name: &[u8], text: &[u8]) -> bool {
    let plain = !text.iter().any(|b| matches!(b, b'[' | b'='));
    plain && !is_one_of(name, KNOWN) && name.first().is_some_and(|b| *b != b'$')
}
