//! What runs at any time: interrupts and triggers.

use super::calls::only_reads;
use super::reader::Reader;
use super::statements::{action, is_kept};
use super::tokens::{Cursor, Read, Token};
use crate::program::names::{Context, Symbol};
use crate::program::script::{Call, RoutineId, Script, Start, Statement};

/// A routine of an interrupt or trigger.
#[derive(Debug)]
pub(super) struct Concurrent {
    name: Symbol,
    context: Context,
    /// The number of the interrupt, as it is declared; `None` of a trigger.
    interrupt: Option<Box<[u8]>>,
    /// It has arguments: one that is in the files is called where these are read.
    has_arguments: bool,
    /// Once all are declared.
    routine: Option<RoutineId>,
}

/// What an interrupt or trigger assigns or hands to a routine.
#[derive(Debug)]
pub(super) struct Action {
    /// The routine that its words stand in.
    pub routine: Option<u32>,
    /// Their bytes.
    pub at: usize,
    pub end: usize,
    /// The call that starts it.
    pub starts: usize,
    /// It is that of a trigger, which does not move the robot.
    pub is_trigger: bool,
}

impl Reader {
    /// What interrupts and triggers of a file assign or hand to routines, each as a routine that
    /// runs at any time.
    pub(super) fn act_at_any_time(&mut self, bytes: &[u8]) -> Read<()> {
        for action in std::mem::take(&mut self.actions) {
            let Action {
                routine,
                at,
                end,
                starts,
                is_trigger,
            } = action;
            let mut cursor = Cursor { bytes, at, end };
            let name = cursor.next();
            self.routine = routine;
            let place = self.place(name);
            let made = self.builder.declare("", place, Start::Concurrent);
            let first = self.builder.script.calls.len();
            self.builder.open(made);
            if cursor.peek().is(b'(') {
                self.here = place;
                self.calls_in(Cursor { bytes, at, end });
            } else {
                self.statement(name, cursor)?;
            }
            self.builder.close();
            for call in &mut self.builder.script.calls[first..] {
                call.leads &= !is_trigger;
            }
            let routines = &mut self.builder.script.routines;
            // no move depends on it
            if routines[made as usize].statements.is_empty() {
                routines.pop();
            } else {
                self.builder.script.calls[starts].callees = [made].into();
            }
        }
        Ok(())
    }

    /// `INTERRUPT DECL n WHEN ... DO routine()`, `TRIGGER WHEN ... DO n=1`: the routine runs, or the
    /// variable is written, at any time. One with arguments is called where these are read.
    pub(super) fn concurrent(&mut self, mut cursor: Cursor) {
        let Some((name, mut rest)) = action(cursor) else {
            return;
        };
        let has_arguments = is_kept(rest);
        if has_arguments {
            self.note_assignment(name, rest);
        }
        if rest.blanks() == b'(' {
            let declares = cursor.next();
            let declares = cursor.text(declares).eq_ignore_ascii_case(b"DECL");
            let name = self.symbol(&rest, name);
            self.concurrent.push(Concurrent {
                name,
                context: self.context(),
                interrupt: declares.then(|| cursor.text(cursor.peek()).into()),
                has_arguments,
                routine: None,
            });
        }
    }

    /// `INTERRUPT ON n`: from here on its routine may run at any time, without a number those of all.
    /// `TRIGGER WHEN ... DO routine()`: its routine may.
    pub(super) fn interrupts(&mut self, mut cursor: Cursor, action: Option<(Token, Cursor)>) {
        let (mut started, mut foreign) = (Vec::new(), Vec::new());
        let switch = cursor.next();
        if let Some((name, rest)) = action {
            let symbol = self.symbol(&rest, name);
            started.extend(self.names.routine(symbol, self.context()));
        } else if cursor.text(switch).eq_ignore_ascii_case(b"ON") {
            let number = cursor.next();
            let text = cursor.text(number);
            let is_number = |text: &[u8]| text.first().is_some_and(u8::is_ascii_digit);
            let is_meant =
                |interrupt: &[u8]| !is_number(text) || !is_number(interrupt) || interrupt == text;
            let all = self.concurrent.iter();
            let meant = all.filter(|of| of.interrupt.as_deref().is_some_and(is_meant));
            for of in meant {
                let name = self.names.symbols.spelling(of.name);
                match of.routine {
                    Some(_) if of.has_arguments => {}
                    Some(routine) => started.push(routine),
                    None if only_reads(name.as_bytes()) => {}
                    None => foreign.push(Call::of(self.here, Box::default(), name, 0..0)),
                }
            }
        }
        for call in foreign {
            self.builder.start(call);
        }
        if !started.is_empty() {
            let call = Call::of(self.here, started.into(), "INTERRUPT", 0..0);
            self.builder.start(call);
        }
    }

    /// Marks the routines that run at any time, once all are declared.
    pub(super) fn mark_concurrent(&mut self) {
        for of in &mut self.concurrent {
            of.routine = self.names.routine(of.name, of.context);
            if let Some(routine) = of.routine.filter(|_| !of.has_arguments) {
                self.builder.script.routines[routine as usize].start = Start::Concurrent;
            }
        }
    }
}

/// Takes it that routines which triggers alone run do not move the robot, nor do those that they
/// call: a trigger's runs next to a motion.
pub(super) fn leave_triggered(script: &mut Script, concurrent: &[Concurrent]) {
    let mut is_triggered = vec![false; script.routines.len()];
    for triggers in [true, false] {
        let of_kind = concurrent
            .iter()
            .filter(|of| of.interrupt.is_none() == triggers);
        for routine in of_kind.filter_map(|of| of.routine) {
            is_triggered[routine as usize] = triggers;
        }
    }
    for statement in &script.statements {
        if let Statement::Call(call) = statement {
            for routine in &*script.calls[*call as usize].callees {
                is_triggered[*routine as usize] = false;
            }
        }
    }
    for (routine, _) in script
        .routines
        .iter()
        .zip(is_triggered)
        .filter(|(_, is)| *is)
    {
        let own = routine.statements.start as usize..routine.statements.end as usize;
        for statement in &script.statements[own] {
            if let Statement::Call(call) = statement {
                script.calls[*call as usize].leads = false;
            }
        }
    }
}
