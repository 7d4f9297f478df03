//! Moves to a P variable by a number that only the running program knows: `P[B000]`, `P[I000]`.
//!
//! They go to one of the P positions of the files, if to none that the controller has besides.

use super::reader::Reader;
use super::remarks::Cause;
use crate::program::Place;
use crate::program::script::{Expr, Remark, VariableId};
use std::collections::BTreeMap;

/// What such moves go to.
#[derive(Default)]
pub(super) struct Indexed {
    /// Indices of the instructions, and where they are.
    moves: Vec<(usize, Place)>,
    /// How many P variables there were at the first of them, and any of these where all have the
    /// same tool and frame.
    any: Option<(usize, Option<Expr>)>,
}

impl Reader<'_> {
    /// Where the next instruction goes: any P position of the files, where all have the same tool
    /// and frame.
    pub(super) fn any_position(&mut self, place: Place) -> Expr {
        if self.indexed.any.is_none() {
            let count = self.positions_of_files().len();
            self.indexed.any = Some((count, self.any_of_one_frame()));
        }
        let Some((_, Some(any))) = self.indexed.any else {
            return self.unknown(Cause::Computed);
        };
        let next = self.builder.script.instructions.len();
        self.indexed.moves.push((next, place));
        any
    }

    /// By number.
    fn positions_of_files(&self) -> &BTreeMap<i64, VariableId> {
        &self.builder.script.tables[self.variables.positions as usize].entries
    }

    fn any_of_one_frame(&mut self) -> Option<Expr> {
        let entries = self.positions_of_files().values();
        let variables: Vec<Expr> = entries.map(|of| Expr::Variable(*of)).collect();
        let targets = variables.iter().flat_map(|of| self.targets_of(*of));
        let mut kinds = targets.map(|target| {
            let header = self.positions.header(target);
            (self.frames_of(target), header.coordinates())
        });
        let first = kinds.next()?;
        let are_alike = kinds.all(|kind| kind == first);
        are_alike.then(|| self.builder.script.any(variables))
    }

    /// Where a job writes P variables that the files do not hold, or any of them, these moves may go
    /// there.
    pub(super) fn settle_indexed(&mut self) {
        let Some((count, _)) = self.indexed.any else {
            return;
        };
        let are_all = self.positions_of_files().len() == count;
        let is_settled = are_all && !self.all_written.contains(&self.variables.positions);
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
