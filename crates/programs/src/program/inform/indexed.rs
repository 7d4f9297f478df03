//! Moves to a P variable by a number that only the running program knows: `P[B000]`, `P[I000]`.
//!
//! They go to one of the P positions of the files, if to none that the controller has besides.

use super::reader::Reader;
use super::remarks::Cause;
use crate::program::Place;
use crate::program::script::{Expr, Remark, VariableId};

/// What such moves go to.
#[derive(Default)]
pub(super) struct Indexed {
    /// Indices of the instructions, and where they are.
    moves: Vec<(usize, Place)>,
    /// The one of all, with the P variables that it was made of.
    any: Option<(Expr, usize)>,
}

impl Reader<'_> {
    /// Where the next instruction goes: any P position of the files, where all have the same tool
    /// and frame.
    pub(super) fn any_position(&mut self, place: Place) -> Expr {
        let any = match self.indexed.any {
            Some((any, _)) => any,
            None => match self.any_of_one_frame() {
                Some(any) => any,
                None => return self.unknown(Cause::Computed),
            },
        };
        let next = self.builder.script.instructions.len();
        self.indexed.moves.push((next, place));
        any
    }

    fn any_of_one_frame(&mut self) -> Option<Expr> {
        let entries = &self.builder.script.tables[self.variables.positions as usize].entries;
        let mut all: Vec<(i64, VariableId)> = entries.iter().map(|(key, of)| (*key, *of)).collect();
        all.sort_unstable();
        let variables: Vec<Expr> = all.iter().map(|(_, of)| Expr::Variable(*of)).collect();
        let targets = variables.iter().flat_map(|of| self.targets_of(*of));
        let mut kinds = targets.map(|target| {
            let header = self.positions.header(target);
            (self.frames_of(target), header.coordinates())
        });
        let first = kinds.next()?;
        if !kinds.all(|kind| kind == first) {
            return None;
        }
        let count = variables.len();
        let any = self.builder.script.any(variables);
        self.indexed.any = Some((any, count));
        Some(any)
    }

    /// Where a job writes P variables that the files do not hold, or any of them, these moves may go
    /// there.
    pub(super) fn settle_indexed(&mut self) {
        let Some((_, count)) = self.indexed.any else {
            return;
        };
        let positions = self.variables.positions;
        let now = self.builder.script.tables[positions as usize].entries.len();
        let is_settled = now == count && !self.all_written.contains(&positions);
        let computed = self.unknown(Cause::Computed);
        for (at, place) in std::mem::take(&mut self.indexed.moves) {
            if is_settled {
                let remark = Remark::warning(
                    "computed-target",
                    "the number of the P variable that this move goes to is known at run time only; \
                     those of the files are corrected, others of the controller are not",
                    "give the jobs that hold all P variables which it may go to",
                );
                self.say(place, remark);
            } else {
                self.builder.script.instructions[at].target = computed;
            }
        }
    }
}
