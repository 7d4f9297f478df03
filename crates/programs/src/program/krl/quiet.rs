//! Functions that leave everything where it is: the robot, tool and base, and positions of others.

use super::calls::only_reads;
use super::frames::{State, Table};
use super::names::Names;
use super::reader::Reader;
use super::tokens::capitals;
use crate::program::names::{Context, Symbol};
use foldhash::HashSet;

/// What routines do that functions in expressions mostly do not.
#[derive(Debug, Default)]
pub(super) struct Quiet {
    /// Routines that move, that set a tool or base, or that start others.
    loud: HashSet<u32>,
    /// What is written, and which routines are called by statements, each with the routine that does.
    written: Vec<(Symbol, Context)>,
    called: Vec<(Symbol, Context)>,
}

impl Reader {
    /// Notes that the present routine moves, or sets a tool or base.
    pub(super) fn note_loud(&mut self) {
        self.names.quiet.loud.extend(self.routine);
    }

    /// Notes that the present routine calls another by a statement.
    pub(super) fn note_called(&mut self, name: Symbol) {
        let context = self.context();
        self.names.quiet.called.push((name, context));
    }

    /// Notes what the present routine writes.
    pub(super) fn note_written(&mut self, name: Symbol) {
        let spelled = self.names.symbols.spelling(name).as_bytes();
        let word = capitals(spelled, &mut [0; 24]).to_vec();
        let is_frame = matches!(
            State::named(&word),
            Some(State::Tool | State::Base | State::Ipo)
        );
        if is_frame || Table::named(&word).is_some() || word == b"FDAT_ACT" {
            self.note_loud();
        } else {
            let context = self.context();
            self.names.quiet.written.push((name, context));
        }
    }
}

impl Names {
    /// Finds out which routines are quiet, once all are declared.
    pub(super) fn settle_quiet(&mut self) {
        let Quiet {
            mut loud,
            written,
            called,
        } = std::mem::take(&mut self.quiet);
        let writes = written.into_iter().filter(|&(name, context)| {
            let Some(datum) = self.datum(name, context) else {
                return false;
            };
            let of = &self.data[datum as usize];
            let is_parameter = |routine: u32| {
                let parameters = &self.heads[routine as usize].parameters;
                parameters.contains(&(datum, true))
            };
            of.kind.is_place() && of.context.routine.is_none_or(is_parameter)
        });
        let leads = called.into_iter().filter(|&(name, context)| {
            let spelled = self.symbols.spelling(name).as_bytes();
            self.routine(name, context).is_none() && !only_reads(spelled)
        });
        loud.extend(writes.chain(leads).filter_map(|(_, of)| of.routine));
        let calls =
            self.known.called.iter().filter_map(|&(name, context)| {
                Some((context.routine?, self.routine(name, context)?))
            });
        let calls: Vec<_> = calls.collect();
        let mut before = usize::MAX;
        while before != loud.len() {
            before = loud.len();
            let callers = calls.iter().filter(|(_, callee)| loud.contains(callee));
            let callers: Vec<u32> = callers.map(|(caller, _)| *caller).collect();
            loud.extend(callers);
        }
        self.quiet.loud = loud;
    }

    /// Whether a function may leave the robot, tool and base or a position of others changed.
    pub(super) fn is_loud(&self, routine: u32) -> bool {
        self.quiet.loud.contains(&routine)
    }
}
