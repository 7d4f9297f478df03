//! Instructions as statements: calls, jumps, blocks.

use super::asked::case;
use super::content::canonical;
use super::controller::{Kind, Which};
use super::indices::counter;
use super::lines::Line;
use super::moves::Row;
use super::numbers::ANY_LABEL;
use super::offsets::Axes;
use super::reader::{Reader, called};
use super::words::{
    Named, assigned, behind_group, bracket_end, comma, concerns_group_1, each_position, indexed,
    is_word, motion, parts, whole, word_length, words,
};
use crate::program::script::{Argument, Call, Expr, Remark, RoutineId, Start, VariableId, short};
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
    /// The rounds of loops that are open and gone through round by round, one times another; 0 where
    /// there are none.
    rounds: usize,
    /// A register says which label the program goes to.
    goes_anywhere: bool,
}

impl State {
    /// How often the present text is gone through.
    pub(super) fn rounds(&self) -> usize {
        self.rounds.max(1)
    }

    /// A loop begins of so many rounds that are gone through one by one; hands over what was before.
    pub(super) fn begin_rounds(&mut self, count: usize) -> usize {
        let rounds = self.rounds() * count;
        std::mem::replace(&mut self.rounds, rounds)
    }

    /// It ends.
    pub(super) fn end_rounds(&mut self, before: usize) {
        self.rounds = before;
    }
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
        if !is_case {
            self.end_select();
        }
        if is_case || is_else {
            // what the branch before wrote is not there in this one
            self.known.branch();
            self.builder.next_branch(true);
            if is_case && !is_else {
                self.builder.pass_cases(case(text).as_slice());
            }
            self.behind_comma(text, 0);
        } else if let Some((letter, at)) = motion(text) {
            self.go(line, letter, at);
        } else if !text.is_empty() {
            self.statement(text, 0);
        }
    }

    /// What follows is no case of a SELECT.
    pub(super) fn end_select(&mut self) {
        if std::mem::take(&mut self.state.selects) {
            self.builder.end_choice();
            self.known.close();
        }
    }

    /// The end of a program's text.
    pub(super) fn end(&mut self) {
        self.end_select();
        let state = std::mem::take(&mut self.state);
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
                let inside = self.known.open();
                let condition = before_then(rest).unwrap_or_default();
                self.known.check(inside, condition);
                let tests = self.tests(condition);
                self.builder.begin_if(tests);
            }
            (b"ENDIF", _) => {
                self.known.close();
                self.builder.end_choice();
            }
            (b"FOR", _) => {
                let text = canonical(rest);
                let next = self.builder.script.loops.len();
                let before = self.before.as_deref();
                let most = self.known.begin_loop(next, counter(&text), before);
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
                let of = self.selected(rest);
                self.builder.begin_switch(of);
                self.builder.next_branch(true);
                let first = memchr::memchr(b'=', rest).and_then(|at| case(&rest[at..]));
                self.builder.pass_cases(first.as_slice());
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
            (b"END" | b"ENDE", None) => {
                self.known.stop();
                self.builder.back();
            }
            (b"ABORT" | b"ABBRUCH", None) => {
                self.known.stop();
                self.builder.exit();
            }
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
            let inside = if is_jump {
                self.known.open_jump()
            } else {
                self.known.open()
            };
            let mut tests = None.into();
            if matches!(name, b"IF" | b"WENN") {
                let condition = &known[name.len()..];
                self.known.check(inside, condition);
                tests = self.tests(condition);
            }
            self.builder.begin_if(tests);
            self.behind_comma(text, depth);
            self.builder.end_choice();
            if is_jump {
                self.known.close_jump();
            } else {
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
        self.known.jump(key, may);
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
            self.known.leave(self.before.as_deref());
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
}

/// Whether a register says which program is called.
pub(super) fn is_chosen(text: &[u8]) -> bool {
    text[word_length(text)..]
        .trim_ascii_start()
        .starts_with(b"[")
}

/// Whether `THEN` ends a condition.
fn ends_with_then(text: &[u8]) -> bool {
    before_then(text).is_some()
}

/// The condition before THEN, with which a text ends.
fn before_then(text: &[u8]) -> Option<&[u8]> {
    let last = text.rsplit(|&b| !is_word(b)).next()?;
    let is_then = last.eq_ignore_ascii_case(b"THEN");
    is_then.then(|| &text[..text.len() - last.len()])
}

/// Whether a text begins what is done on a condition.
fn is_action(text: &[u8]) -> bool {
    let word = text[..word_length(text)].to_ascii_uppercase();
    let known = "ABORT ABBRUCH AUFRUF CALL END ENDE JMP LABEL LBL SPRUNG";
    is_one_of(&word, known) || selects(&word).is_some()
}

/// Whether a word in capitals is one of those.
pub(super) fn is_one_of(word: &[u8], all: &str) -> bool {
    all.split_ascii_whitespace()
        .any(|known| known.as_bytes() == word)
}

/// `UTOOL_NUM` and its translations.
pub(super) fn selects(name: &[u8]) -> Option<Which> {
    name.strip_suffix(b"_NUM").map(kind_of)
}

pub(super) fn kind_of(name: &[u8]) -> Which {
    match name {
        [b'U', b'T', ..] | [b'W', b'K', b'Z', ..] => Some(Kind::Tool),
        [b'U', b'F', ..] | [b'B', b'E', b'N', ..] => Some(Kind::Frame),
        _ => None,
    }
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
