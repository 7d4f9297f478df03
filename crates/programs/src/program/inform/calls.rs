//! Calls of other jobs, with what they give.

use super::instruction::Operand;
use super::lines::{Line, words};
use super::reader::Reader;
use super::remarks::Cause;
use crate::program::Source;
use crate::program::script::{Argument, Call, RoutineId, Written, short};

/// Arguments that a call gives at most.
///
/// # Source
/// Yaskawa, DX200 options instructions, "For Jobs with Arguments": `IARG#(1)` to `IARG#(8)`.
const MOST_ARGUMENTS: u32 = 8;

impl<'a> Reader<'a> {
    /// The jobs of a name such as `JOB:A`.
    fn callees(&self, name: &[u8]) -> Box<[RoutineId]> {
        let known = name
            .strip_prefix(b"JOB:")
            .and_then(|name| self.names.get(name));
        known.map_or_else(Box::default, |routines| routines.as_slice().into())
    }

    pub(super) fn call(&mut self, line: Line<'a>, name: &'a [u8]) -> Call {
        let callees = self.callees(name);
        for callee in &callees {
            self.numbers.calls(*callee);
        }
        if callees.is_empty() {
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
            }
            if callees.is_empty() && operand.is_some() {
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
        Call::of(place, callees, Source::text(name), first..end)
    }
}
