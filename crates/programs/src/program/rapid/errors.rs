//! Errors that leave a routine: the handler of its caller has them, or that of the caller's caller.
//!
//! A handler that changes nothing and goes on with `RETRY` or `TRYNEXT` leads to the same call again
//! or to what stands behind it, as whatever the routine had done so far left it; one that does
//! something may go on anywhere, as [`super::handlers`] says. Errors in handlers stop the program.
//!
//! # Source
//! ABB, RAPID Reference Manual, Basic Characteristics: error recovery, and the instruction `RAISE`.

use super::handlers::{HANDLERS, NOWHERE};
use super::resolved::Resolved;
use super::syntax::{Callee, StatementKind, Verb};
use super::translate::Translator;
use crate::program::names::Context;
use crate::program::script::Call;
use foldhash::{HashMap, HashSet};

/// Keys of labels: calls that are made again, what stands behind them, and where the routine ends
/// with an error.
const AGAIN: u64 = 1 << 44;
const BEHIND: u64 = 1 << 45;
const RAISED: u64 = 1 << 46;

/// What a handler is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Handles {
    /// All errors.
    Errors,
    /// Errors of these numbers: `ERROR(ERR_PATH_STOP)`.
    SomeErrors,
    /// `UNDO`, `BACKWARD`
    Other,
}

/// The handler of a routine that errors go to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Caught {
    /// Which of its handlers.
    at: usize,
    /// Others than those that it is for leave the routine.
    is_listed: bool,
    retries: bool,
    passes: bool,
}

impl Caught {
    pub(super) fn by(at: usize, is_listed: bool) -> Self {
        Self {
            at,
            is_listed,
            retries: false,
            passes: false,
        }
    }

    /// It goes on with the statement that failed, or the next one.
    pub(super) fn goes_on(&mut self, is_next: bool) {
        self.passes |= is_next;
        self.retries |= !is_next;
    }
}

impl Translator<'_> {
    /// What stands here may fail, and the error leave the routine.
    pub(super) fn may_raise(&mut self) {
        let handlers = &mut self.handlers;
        let leaves = handlers.caught.is_none_or(|caught| caught.is_listed);
        if handlers.is_guarded && leaves {
            handlers.raises = true;
            self.builder.may_go_to(RAISED);
        }
    }

    /// `RAISE`
    pub(super) fn raise(&mut self) {
        let own = self.handlers.caught;
        let Some(caught) = own.filter(|_| self.handlers.present == 0) else {
            return self.builder.raise();
        };
        if caught.is_listed {
            self.handlers.raises = true;
            self.builder.may_go_to(RAISED);
        }
        if self.handlers.matters[caught.at] {
            self.builder.go_to(HANDLERS + caught.at as u64);
        } else if !caught.passes {
            self.builder.go_to(NOWHERE);
        }
    }

    /// A statement ends, or begins that its functions do not belong to as a whole: what stands behind
    /// it where they fail.
    pub(super) fn behind_functions(&mut self) {
        for key in std::mem::take(&mut self.handlers.behind) {
            self.builder.place(key);
        }
    }

    /// A call, and where the program goes on when a routine that it runs ends with an error.
    pub(super) fn call_caught(&mut self, call: Call) {
        let own = self.handlers.caught;
        let is_own = self.handlers.present == 0 && !call.callees.is_empty();
        let Some(caught) = own.filter(|_| is_own) else {
            return self.builder.call(call);
        };
        let matters = self.handlers.matters[caught.at];
        let number = self.handlers.calls;
        self.handlers.calls += 1;
        let (again, behind) = (!matters && caught.retries, !matters && caught.passes);
        if again {
            self.builder.place(AGAIN + number);
        }
        self.builder.call(call);
        if matters {
            self.builder.catch(HANDLERS + caught.at as u64);
        }
        if again {
            self.builder.catch(AGAIN + number);
        }
        if behind {
            self.builder.catch(BEHIND + number);
        }
        if caught.is_listed {
            self.handlers.raises = true;
            self.builder.catch(RAISED);
        }
        // what a function was to give is not written
        if behind && self.is_function {
            self.handlers.behind.push(BEHIND + number);
        } else if behind {
            self.builder.place(BEHIND + number);
        }
    }

    /// The routine ends: what errors leave it with.
    pub(super) fn end_raising(&mut self) {
        if self.handlers.raises {
            self.builder.label(RAISED);
            self.builder.raise();
        }
    }
}

impl Resolved<'_> {
    /// The routines of whose errors handlers of their callers may hear: those that a routine with an
    /// error handler calls, and those that such a one calls.
    pub(super) fn guarded(&self) -> HashSet<u32> {
        let mut called: HashMap<u32, Vec<u32>> = HashMap::default();
        let mut open = Vec::new();
        let nowhere = Context {
            module: 0,
            routine: None,
        };
        let (mut context, mut file, mut is_own) = (nowhere, 0, true);
        let mut handling = HashSet::default();
        for statement in &self.parsed.statements {
            let (callee, arguments) = match statement.kind {
                StatementKind::Text {
                    file: in_file,
                    context: now,
                } => {
                    (context, file, is_own) = (now, in_file, true);
                    continue;
                }
                StatementKind::Handler(handles) => {
                    is_own = false;
                    if handles != Handles::Other {
                        handling.extend(context.routine);
                    }
                    continue;
                }
                StatementKind::Call(call) if call.verb == Verb::CallByVar => {
                    (Callee::Late, call.arguments)
                }
                StatementKind::Call(call) => (call.callee, call.arguments),
                StatementKind::Function(function) => {
                    let of = self.parsed.functions[function as usize];
                    (Callee::Named(of.name), of.arguments)
                }
                _ => continue,
            };
            if let Some(caller) = context.routine.filter(|_| is_own) {
                let callees = self.callees(callee, arguments, context, file);
                called.entry(caller).or_default().extend(callees.routines);
            }
        }
        let mut guarded = HashSet::default();
        open.extend(handling);
        while let Some(caller) = open.pop() {
            for &callee in called.get(&caller).into_iter().flatten() {
                if guarded.insert(callee) {
                    open.push(callee);
                }
            }
        }
        guarded
    }
}
