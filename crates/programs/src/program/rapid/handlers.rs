//! Error, undo and backward handlers: they may run between any two statements of their routine.

use super::errors::{Caught, Handles};
use super::syntax::StatementKind;
use super::translate::Translator;
use crate::program::script::Expr;

/// Keys of labels besides those of names: handlers, places to go on at, where going on is chosen,
/// nowhere.
pub(super) const HANDLERS: u64 = 1 << 40;
const PLACES: u64 = 1 << 41;
const GOING_ON: u64 = 1 << 42;
pub(super) const NOWHERE: u64 = 1 << 43;

/// The handlers of the present routine.
#[derive(Debug, Default)]
pub(super) struct Handlers {
    /// For each whether it changes anything that matters, or ends the routine.
    pub matters: Vec<bool>,
    /// The one that errors go to.
    pub caught: Option<Caught>,
    /// Handlers of callers may hear of errors here.
    pub is_guarded: bool,
    /// Calls whose errors are met by a handler that changes nothing, so far.
    pub calls: u64,
    /// What stands behind the present statement, where one of these fails in a function of it.
    pub behind: Vec<u64>,
    /// Errors leave the routine where it ends.
    pub raises: bool,
    /// Some of them go on where the error was, after statements that change something.
    go_on: bool,
    /// Places to go on at so far.
    places: u64,
    /// The one that stands here, from 1; 0 in the routine's own statements.
    pub present: usize,
    /// The present one is passed over.
    pub is_skipping: bool,
}

impl Translator<'_> {
    /// The handlers of a routine whose statements begin there.
    pub(super) fn handlers_of(&self, first: usize) -> Handlers {
        let mut found = Handlers::default();
        let (mut inside, mut is_caught) = (false, false);
        let (mut acts, mut leaves, mut retries) = (false, true, false);
        let end = |found: &mut Handlers, acts: bool, leaves: bool, retries: bool| {
            found.matters.push(acts || leaves);
            found.go_on |= acts && retries;
        };
        for statement in &self.resolved.parsed.statements[first..] {
            match statement.kind {
                StatementKind::Text { .. } => break,
                StatementKind::Handler(handles) => {
                    if inside {
                        end(&mut found, acts, leaves, retries);
                    }
                    if handles != Handles::Other {
                        let at = found.matters.len();
                        found.caught = Some(Caught::by(at, handles == Handles::SomeErrors));
                    }
                    is_caught = handles != Handles::Other;
                    inside = true;
                    (acts, leaves, retries) = (false, true, false);
                }
                _ if !inside => {}
                StatementKind::Assign { name, .. } => {
                    let kind = self.resolved.kind(name, self.context);
                    acts |= kind.is_none_or(|kind| kind.is_target() || kind.is_frame());
                    leaves = true;
                }
                StatementKind::Call(_) | StatementKind::Function(_) => {
                    acts = true;
                    leaves = true;
                }
                StatementKind::Retry { is_next } => {
                    retries = true;
                    if let Some(caught) = found.caught.as_mut().filter(|_| is_caught) {
                        caught.goes_on(is_next);
                    }
                    // at its end it goes on, whatever it asked before
                    leaves = false;
                }
                StatementKind::Return(_) | StatementKind::Raise | StatementKind::Exit => {
                    acts = true;
                    leaves = true;
                }
                _ => {}
            }
        }
        if inside {
            end(&mut found, acts, leaves, retries);
        }
        found
    }

    /// What stands here may fail: a handler may run before it, and go on with it.
    pub(super) fn may_fail(&mut self) {
        if self.handlers.present > 0 {
            return;
        }
        if self.handlers.go_on {
            self.builder.label(PLACES + self.handlers.places);
            self.handlers.places += 1;
        }
        for (key, matters) in (HANDLERS..).zip(&self.handlers.matters) {
            if *matters {
                self.builder.may_go_to(key);
            }
        }
        self.may_raise();
    }

    /// A handler begins; what stands before it ends the routine.
    pub(super) fn handler(&mut self) {
        self.end_part();
        let key = HANDLERS + self.handlers.present as u64;
        self.handlers.present += 1;
        let matters = self.handlers.matters.get(self.handlers.present - 1);
        self.handlers.is_skipping = !matters.copied().unwrap_or(false);
        if !self.handlers.is_skipping {
            self.builder.label(key);
        }
    }

    fn end_part(&mut self) {
        if self.handlers.present == 0 {
            self.may_fail();
        }
        if !self.handlers.is_skipping {
            self.builder.back();
        }
    }

    /// `RETRY`, `TRYNEXT`
    pub(super) fn retry(&mut self) {
        let goes_on = self.handlers.go_on && self.handlers.present > 0;
        self.builder.go_to(if goes_on { GOING_ON } else { NOWHERE });
    }

    /// The routine ends: where handlers go on, and errors leave it.
    pub(super) fn end_handlers(&mut self) {
        let goes_on = self.handlers.present > 0 && self.handlers.go_on;
        if !goes_on && !self.handlers.raises {
            return;
        }
        if !self.handlers.is_skipping {
            self.builder.back();
        }
        if goes_on {
            self.builder.label(GOING_ON);
            for place in 0..self.handlers.places {
                self.builder.may_go_to(PLACES + place);
            }
            self.builder.back();
        }
        self.end_raising();
    }

    /// What a function gives back.
    pub(super) fn give_back(&mut self, value: super::syntax::Expression) {
        let Some(routine) = self.context.routine else {
            return;
        };
        let gives = self.resolved.parsed.routines[routine as usize].gives;
        let value = if gives.is_target() {
            self.position_from(value, gives)
        } else if gives.is_frame() {
            self.frame_from(value)
        } else {
            return;
        };
        let result = self.result(routine);
        self.set(result, value);
    }

    /// The variable that holds what a function of the files gives.
    pub(super) fn result(&mut self, routine: u32) -> u32 {
        if let Some(&known) = self.results.get(&routine) {
            return known;
        }
        let of = self.resolved.parsed.routines[routine as usize];
        let declared = if of.gives.is_frame() {
            self.frame_chosen()
        } else {
            self.computed()
        };
        let made = self.temporary(self.resolved.spelling(of.name), declared);
        self.results.insert(routine, made);
        made
    }

    /// A variable that is not in the text.
    pub(super) fn temporary(&mut self, name: &str, declared: Expr) -> u32 {
        self.builder
            .script
            .variable(crate::program::script::Variable::new(
                name, self.here, declared,
            ))
    }
}
