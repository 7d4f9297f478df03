//! What speaks against moves: sets of variables that may hold a remark.

use super::frames::State;
use super::moves::With;
use super::reader::Reader;
use crate::program::Motion;
use crate::program::script::{Expr, Held, Place, Script, ValueId, Variable, VariableId};
use foldhash::HashMap;

/// Sets of guards, each once, and the variables in them that no statement writes.
#[derive(Debug, Default)]
pub(super) struct Guards {
    sets: HashMap<Box<[VariableId]>, u32>,
    values: HashMap<ValueId, VariableId>,
    remarks: HashMap<u32, VariableId>,
    /// The load of a move itself, where that is worked out when it runs.
    own: Option<VariableId>,
}

/// A variable of a move that no statement writes.
fn constant(script: &mut Script, value: Expr) -> VariableId {
    script.variable(Variable::new("the move", Place::NOWHERE, value))
}

impl Reader {
    /// What a move says itself, as the move has it, and the variable that may hold a remark against
    /// it.
    pub(super) fn watched(&mut self, place: Place, own: Expr) -> (Expr, Option<VariableId>) {
        let script = &mut self.builder.script;
        let variable = match own {
            Expr::Variable(variable) => variable,
            Expr::Value(value) if !matches!(script.values[value as usize], Held::Remark(_)) => {
                return (own, None);
            }
            Expr::Value(value) => *self
                .guards
                .values
                .entry(value)
                .or_insert_with(|| constant(script, own)),
            Expr::Unknown(remark) => *self
                .guards
                .remarks
                .entry(remark)
                .or_insert_with(|| constant(script, own)),
            _ => {
                let known = &mut self.guards.own;
                let variable = *known.get_or_insert_with(|| constant(script, Expr::Absent));
                self.put(place, variable, own);
                variable
            }
        };
        (Expr::Variable(variable), Some(variable))
    }

    fn guard(&mut self, place: Place, own: Option<Expr>, state: State) -> Option<VariableId> {
        let own = own.unwrap_or(self.states.expr(state));
        self.watched(place, own).1
    }

    /// The set of guards of a move to a pose. `may_turn`: its orientation is not known to be that of
    /// where it starts.
    pub(super) fn guards_of_pose(
        &mut self,
        place: Place,
        motion: Motion,
        with: &With,
        may_turn: bool,
        has_angle: bool,
    ) -> u32 {
        let mut all = Vec::with_capacity(8);
        all.extend(self.guard(place, with.mode, State::Ipo));
        all.extend(self.guard(place, with.load, State::Load));
        if !matches!(motion, Motion::Joint | Motion::ArcVia) {
            let is_ignored = with.orientation == Some(self.ignored());
            if may_turn || is_ignored {
                all.extend(self.guard(place, with.orientation, State::Orientation));
            } else if self.keeps {
                let [by_state, _] = self.states.keeping;
                let own = with.orientation.map(|own| self.kept_same(own));
                let own = own.unwrap_or(Expr::Variable(by_state));
                all.extend(self.watched(place, own).1);
            }
            if with.orientation.is_none() && self.ignores {
                all.push(self.states.ignoring);
            }
        }
        if matches!(motion, Motion::ArcVia | Motion::ArcEnd) {
            for (own, state) in with.circles.into_iter().zip(self.circles.states) {
                all.extend(self.watched(place, own.unwrap_or(Expr::Variable(state))).1);
            }
        }
        if has_angle {
            all.push(self.states.angle);
        }
        self.guards_with_axes(all, with)
    }

    /// Likewise of one to axes, which are the same whoever holds the tool.
    pub(super) fn guards_of_axes(&mut self, with: &With) -> u32 {
        self.guards_with_axes(Vec::new(), with)
    }

    fn guards_with_axes(&mut self, mut all: Vec<VariableId>, with: &With) -> u32 {
        all.extend(self.states.apart);
        if self.senses {
            all.push(self.states.sensor);
        }
        all.extend(with.axes_off);
        if let Some(known) = self.guards.sets.get(&*all) {
            return *known;
        }
        let made = self.builder.script.guard(all.iter().copied());
        self.guards.sets.insert(all.into(), made);
        made
    }
}
