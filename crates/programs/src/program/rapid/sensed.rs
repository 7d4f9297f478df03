//! Data that have nothing but what the running robot says.

use super::builtins::Known;
use super::resolved::Resolved;
use super::syntax::{Assigned, Base, Component, Expression, StatementKind};
use crate::program::names::{Context, Meaning, Symbol};
use foldhash::HashMap;

impl Resolved<'_> {
    /// Notes whether an assignment gives data what the running robot tells: all of them have to.
    pub(super) fn note_sensed(
        &self,
        name: Symbol,
        kind: StatementKind,
        context: Context,
        sensed: &mut HashMap<u32, bool>,
    ) {
        let StatementKind::Assign {
            component, value, ..
        } = kind
        else {
            return;
        };
        let function = match value {
            Assigned::To(Expression::Point {
                base: Base::Function(function),
                steps,
            }) if steps.0 == steps.1 => Some(self.parsed.functions[function as usize]),
            _ => None,
        };
        let is_known = function.is_some_and(|of| self.known(&of, context) == Known::Actual);
        if let Meaning::One(datum) = self.meaning(name, context) {
            let all = sensed.entry(datum).or_insert(true);
            *all &= is_known && component == Component::Whole;
        }
    }

    /// Whether data have nothing but what the running robot tells.
    pub(super) fn is_sensed(&self, datum: u32) -> bool {
        self.sensed.get(&datum).copied().unwrap_or(false)
    }
}
