//! Calls of other jobs, with what they give.

use super::instruction::Operand;
use super::lines::{Line, words};
use super::reader::Reader;
use super::remarks::Cause;
use crate::program::Source;
use crate::program::script::{Argument, Call, RoutineId, Script, Statement, Written, short};
use foldhash::HashSet;

/// Arguments that a call gives at most.
///
/// # Source
/// Yaskawa, DX200 options instructions, "For Jobs with Arguments": `IARG#(1)` to `IARG#(8)`.
const MOST_ARGUMENTS: u32 = 8;

/// How a statement says which job it goes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Callee<'a> {
    /// `JOB:A`
    Named(&'a [u8]),
    /// `IG#(1)`, `B000`, `I000`, `D000`: the job whose name is this number.
    Numbered,
    /// `S000`, or in a form that is not known: any job.
    Any,
    /// `MACRO1 MJ#(3)`: the job that the controller has for this macro.
    Macro,
}

impl<'a> Callee<'a> {
    /// # Source
    /// Yaskawa, FS100 instructions, "CALL" and "JUMP": a job that an input group or a variable names
    /// has a number for its name.
    fn of(word: &'a [u8]) -> Self {
        let name = |word: &'a [u8]| word.strip_prefix(b"JOB:").map(Self::Named);
        let number = match word {
            [b'L', rest @ ..] => rest,
            _ => word,
        };
        match number {
            _ if word.starts_with(b"MJ#") => Self::Macro,
            [b'I', b'G', b'#', ..] | [b'B' | b'I' | b'D', b'0'..=b'9' | b'[', ..] => Self::Numbered,
            _ => name(word).unwrap_or(Self::Any),
        }
    }
}

/// Whether a word calls a macro: MACRO1.
pub(super) fn is_macro(word: &[u8]) -> bool {
    word.strip_prefix(b"MACRO")
        .is_some_and(|number| number.iter().all(u8::is_ascii_digit))
}

impl<'a> Reader<'a> {
    /// The jobs of the files that a call may go to, and whether it may be one that they do not have.
    fn callees(&self, callee: Callee) -> (Box<[RoutineId]>, bool) {
        let numbered = |name: &[u8]| name.iter().all(u8::is_ascii_digit);
        let of = |is_it: &dyn Fn(&[u8]) -> bool| {
            let named = self.names.iter().filter(|(name, _)| is_it(name));
            let mut found: Vec<RoutineId> = named.flat_map(|(_, jobs)| jobs).copied().collect();
            found.sort_unstable();
            found.into_boxed_slice()
        };
        let found = match callee {
            Callee::Named(name) => {
                let known = self.names.get(name).map(Vec::as_slice);
                let known: Box<[RoutineId]> = known.unwrap_or_default().into();
                let is_foreign = known.is_empty();
                return (known, is_foreign);
            }
            Callee::Numbered => of(&numbered),
            Callee::Any => of(&|_| true),
            Callee::Macro => Box::default(),
        };
        (found, true)
    }

    pub(super) fn call(&mut self, line: Line<'a>, name: &'a [u8]) -> Call {
        let callee = Callee::of(name);
        let (callees, is_foreign) = self.callees(callee);
        if callee == Callee::Macro {
            let next = self.builder.script.calls.len();
            self.macros.push((next, self.routine()));
        }
        for callee in &callees {
            self.numbers.calls(*callee);
        }
        if is_foreign {
            self.numbers.clear();
        }
        let place = self.place(line.start);
        let first = short(self.builder.script.arguments.len());
        let mut given = words(line.text).skip(2);
        let mut number = 0;
        while let Some(word) = given.next() {
            let Some(text) = word.strip_prefix(b"ARGF") else {
                continue;
            };
            number += 1;
            let text = if text.is_empty() {
                given.next().unwrap_or_default()
            } else {
                text
            };
            let operand = Operand::of(text);
            let value = match operand {
                Some(operand) => self.value(operand, place),
                // whatever it is: what another call gave is there no more
                None => self.unknown(Cause::Computed),
            };
            for &callee in &callees {
                self.numbers.give(callee, number, Some(text));
                let builder = &mut self.builder;
                let parameter = self.variables.parameter(builder, callee, number, place);
                self.note_copy(Written::One(parameter), value);
                let argument = Argument::new(Some(parameter), value, None);
                self.builder.script.arguments.push(argument);
                for (to, of) in self.frames_given(parameter, value).into_iter().flatten() {
                    let argument = Argument::new(Some(to), of, None);
                    self.builder.script.arguments.push(argument);
                }
            }
            if is_foreign && operand.is_some() {
                self.builder
                    .script
                    .arguments
                    .push(Argument::new(None, value, None));
            }
        }
        // what a call does not give nobody knows
        for (callee, number) in callees.iter().flat_map(|one| {
            let missing = number + 1..=MOST_ARGUMENTS;
            missing.map(move |number| (*one, number))
        }) {
            self.numbers.give(callee, number, None);
        }
        let end = short(self.builder.script.arguments.len());
        Call {
            foreign: is_foreign,
            leads: is_foreign,
            ..Call::of(place, callees, Source::text(name), first..end)
        }
    }

    // ---- when all jobs are read

    /// A macro runs a job that no call or jump names, and that does not come to the macro itself:
    /// what these write may be written there.
    pub(super) fn settle_macros(&mut self) {
        let macros = std::mem::take(&mut self.macros);
        if macros.is_empty() {
            return;
        }
        let script = &mut self.builder.script;
        let names = script.calls.iter();
        let named: HashSet<&str> = names
            .filter_map(|of| of.name.strip_prefix("JOB:"))
            .collect();
        let jobs = (0..).zip(&script.routines);
        let unnamed = jobs.filter(|(_, job)| !named.contains(&*job.name));
        let unnamed = unnamed.map(|(job, _)| (job, script.reached_from(&[job])));
        let writing: Vec<(RoutineId, HashSet<RoutineId>)> = unnamed
            .filter(|(_, reached)| reached.iter().any(|job| writes_shared(script, *job)))
            .collect();
        for (job, number) in writing.iter().flat_map(|(job, _)| {
            let numbers = 1..=MOST_ARGUMENTS;
            numbers.map(move |number| (*job, number))
        }) {
            self.numbers.give(job, number, None);
        }
        for (at, caller) in macros {
            let others = writing
                .iter()
                .filter(|(_, reached)| !reached.contains(&caller));
            let call = &mut script.calls[at];
            call.callees = others.map(|(job, _)| *job).collect();
            call.writes_only = true;
        }
    }
}

/// Whether a job writes what is not its own.
fn writes_shared(script: &Script, job: RoutineId) -> bool {
    let own = &script.routines[job as usize].statements;
    let mut own = script.statements[own.start as usize..own.end as usize].iter();
    own.any(|statement| match *statement {
        Statement::Write(write) => match script.writes[write as usize].variable {
            Written::One(variable) => script.variables[variable as usize].routine.is_none(),
            Written::AnyOf(_) => true,
        },
        _ => false,
    })
}
