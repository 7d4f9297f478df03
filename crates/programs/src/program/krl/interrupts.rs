//! What runs at any time: interrupts and triggers.

use super::calls::only_reads;
use super::reader::Reader;
use super::statements::{action, is_kept};
use super::tokens::{Cursor, Read, Token};
use crate::program::names::{Context, Symbol};
use crate::program::number::whole;
use crate::program::script::{Call, Place, RoutineId, Start};
use foldhash::HashMap;

/// A routine of an interrupt or trigger.
#[derive(Debug)]
pub(super) struct Concurrent {
    name: Symbol,
    context: Context,
    /// The number of the interrupt, as it is declared; `None` of a trigger.
    interrupt: Option<Box<[u8]>>,
    /// What it does is read at the end of the file: it has arguments, or assigns. It stands there.
    kept: Option<Place>,
    /// It is a routine, and no variable that is assigned.
    is_routine: bool,
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
    /// The call that starts it, of a trigger.
    pub starts: Option<usize>,
}

/// What interrupts do whose action is read at the end of their file.
#[derive(Debug, Default)]
pub(super) struct Switched {
    /// The routines that do it.
    made: HashMap<Place, Option<RoutineId>>,
    /// The calls that start them.
    starts: Vec<(Place, usize)>,
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
            } = action;
            let mut cursor = Cursor { bytes, at, end };
            let name = cursor.next();
            self.routine = routine;
            let place = self.place(name);
            let made = self.builder.declare("", place, Start::Concurrent);
            self.builder.open(made);
            if cursor.peek().is(b'(') {
                self.here = place;
                self.calls_in(Cursor { bytes, at, end });
            } else {
                self.statement(name, cursor)?;
            }
            self.builder.close();
            let routines = &mut self.builder.script.routines;
            // no move depends on it
            let is_idle = routines[made as usize].statements.is_empty();
            if is_idle {
                routines.pop();
            }
            let made = (!is_idle).then_some(made);
            self.switched.made.insert(place, made);
            self.switched
                .starts
                .extend(starts.map(|call| (place, call)));
        }
        Ok(())
    }

    /// Puts in their place what is read at the ends of files.
    pub(super) fn link_actions(&mut self) {
        let Switched { made, starts } = std::mem::take(&mut self.switched);
        for (place, call) in starts {
            let call = &mut self.builder.script.calls[call];
            match made.get(&place).copied().flatten() {
                Some(made) => call.callees = [made].into(),
                None => call.leads = false,
            }
        }
    }

    /// `INTERRUPT DECL n WHEN ... DO routine()`, `TRIGGER WHEN ... DO n=1`: the routine runs, or the
    /// variable is written, at any time. One with arguments is called where these are read.
    pub(super) fn concurrent(&mut self, mut cursor: Cursor) {
        let Some((name, mut rest)) = action(cursor) else {
            return;
        };
        let kept = is_kept(rest).then(|| self.place(name));
        if kept.is_some() {
            self.note_assignment(name, rest);
        }
        let declares = cursor.next();
        let declares = cursor.text(declares).eq_ignore_ascii_case(b"DECL");
        let name = self.symbol(&rest, name);
        self.concurrent.push(Concurrent {
            name,
            context: self.context(),
            interrupt: declares.then(|| cursor.text(cursor.peek()).into()),
            kept,
            is_routine: rest.blanks() == b'(',
            routine: None,
        });
    }

    /// `INTERRUPT ON n`: from here on its routine may run at any time, without a number those of all.
    /// `TRIGGER WHEN ... DO routine()`: its routine may.
    pub(super) fn interrupts(&mut self, mut cursor: Cursor, action: Option<(Token, Cursor)>) {
        let mut started = Vec::new();
        let moves = action.is_none();
        let switch = cursor.next();
        if let Some((name, rest)) = action {
            let symbol = self.symbol(&rest, name);
            started.extend(self.names.routine(symbol, self.context()));
        } else if cursor.text(switch).eq_ignore_ascii_case(b"ON") {
            let number = cursor.next();
            let is_alone = matches!(cursor.blanks(), 0 | b';');
            let wanted = whole(cursor.text(number)).filter(|_| is_alone);
            let is_meant = |of: &&Concurrent| {
                let declared = of.interrupt.as_deref().map(whole);
                declared.is_some_and(|declared| {
                    wanted.is_none() || declared.is_none() || declared == wanted
                })
            };
            let mut foreign = Vec::new();
            let meant = || self.concurrent.iter().filter(is_meant);
            // a number stands for the interrupt that this module declares, where it does
            let is_own = |of: &Concurrent| of.context.module == self.module;
            let has_own = meant().any(is_own);
            let mut kept = Vec::new();
            for of in meant() {
                let name = self.names.symbols.spelling(of.name);
                kept.extend(of.kept);
                match of.routine {
                    _ if !of.is_routine => {}
                    Some(_) if of.kept.is_some() => {}
                    Some(routine) => started.push(routine),
                    None if only_reads(name.as_bytes()) || has_own && !is_own(of) => {}
                    None => foreign.push(name.to_owned()),
                }
            }
            if let Some(number) = wanted.filter(|_| meant().next().is_none()) {
                foreign.push(format!("INTERRUPT {number}"));
            }
            for place in kept {
                // what it does is put in its place later
                let starts = self.builder.script.calls.len();
                self.switched.starts.push((place, starts));
                let call = Call::of(self.here, Box::default(), "INTERRUPT", 0..0);
                self.builder.start(call, true);
            }
            for name in foreign {
                let call = Call::of(self.here, Box::default(), name, 0..0);
                self.builder.start(call, true);
            }
        }
        if !started.is_empty() {
            let call = Call::of(self.here, started.into(), "INTERRUPT", 0..0);
            self.builder.start(call, moves);
        }
    }

    /// Marks the routines that run at any time, once all are declared.
    pub(super) fn mark_concurrent(&mut self) {
        for of in &mut self.concurrent {
            if !of.is_routine {
                continue;
            }
            of.routine = self.names.routine(of.name, of.context);
            if let Some(routine) = of.routine.filter(|_| of.kept.is_none()) {
                self.builder.script.routines[routine as usize].start = Start::Concurrent;
            }
        }
    }
}
