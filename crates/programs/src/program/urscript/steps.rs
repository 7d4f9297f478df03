//! Steps from positions that no move goes to itself: `pose_trans(base, p[i*0.05, 0, 0, 0, 0, 0])`,
//! `def above(at): return pose_trans(at, p[0, 0, 0.1, 0, 0, 0])`.
//!
//! What stands in a feature turns the tool there, as a rule by half a rotation; a step turns
//! nothing. Where its numbers count, or where it is made from several positions, no numbers of its
//! own could be right: these positions are the targets. One that is a feature elsewhere stays one.

use super::syntax::{Content, Event, Expr, ExprId, FunctionId, LiteralId};
use super::variables::{VarId, Variables};
use crate::program::quantity::Quantity;
use foldhash::{HashSet, HashSetExt};

/// Positions that one step is made from that are looked at.
const MOST_POSITIONS: usize = 64;

impl Variables<'_, '_> {
    /// Finds the literals of features that targets stand in.
    pub(super) fn find_features(&mut self) {
        let parsed = self.parsed;
        let mut all = parsed.expressions.iter();
        if !all.any(|of| matches!(of, Expr::Trans(..))) {
            return;
        }
        let mut open: Vec<(ExprId, FunctionId)> = Vec::new();
        let assignments = parsed.assignments.iter();
        open.extend(assignments.map(|of| (of.value, of.function)));
        for (at, function) in (0..).zip(&parsed.functions) {
            open.extend(function.events.iter().filter_map(|event| match *event {
                Event::Return(value, _) => Some((value, at)),
                Event::Step(step) => Some((parsed.steps[step as usize].target?, at)),
                _ => None,
            }));
        }
        for call in &parsed.calls {
            let given = parsed.arguments_of(call).iter();
            open.extend(given.map(|(_, value)| (*value, call.function)));
        }
        let mut outer = Vec::new();
        while let Some((value, function)) = open.pop() {
            match parsed.expression(value) {
                Expr::Trans(a, b) => {
                    if !self.is_step(b, function) {
                        outer.push((a, function));
                    }
                    open.extend([(a, function), (b, function)]);
                }
                Expr::Add(a, b) => open.extend([(a, function), (b, function)]),
                Expr::Inverse(of) | Expr::Kinematics { pose: of, .. } => open.push((of, function)),
                Expr::List(list) => {
                    let elements = parsed.lists[list as usize].elements.iter();
                    open.extend(elements.map(|value| (*value, function)));
                }
                _ => {}
            }
        }
        let mut seen = HashSet::new();
        let mut features = HashSet::new();
        while let Some((value, function)) = outer.pop() {
            self.behind(value, function, &mut seen, &mut outer, &mut features);
        }
        self.features = features;
    }

    /// Adds the literal that a value is, or what else may be one of the values of its variable.
    fn behind(
        &self,
        value: ExprId,
        function: FunctionId,
        seen: &mut HashSet<VarId>,
        open: &mut Vec<(ExprId, FunctionId)>,
        found: &mut HashSet<LiteralId>,
    ) {
        let variable = match self.parsed.expression(value) {
            Expr::Literal(id) => {
                found.insert(id);
                return;
            }
            Expr::Name(name, _) => self.meaning(name, function),
            Expr::Element(name, at) => {
                let elements = self.elements(name, at, function);
                open.extend(elements.into_iter().flat_map(|of| of.values));
                return;
            }
            Expr::Call(call) => self.result(call),
            _ => None,
        };
        if let Some(variable) = variable.filter(|variable| seen.insert(*variable)) {
            let sources = self.sources(variable);
            open.extend(sources.map(|source| (source.value, source.function)));
        }
    }

    /// Whether a value is a pose that turns nothing.
    fn is_step(&self, value: ExprId, function: FunctionId) -> bool {
        let (Expr::Literal(id), function) = self.follow(value, function) else {
            return false;
        };
        let amounts = self.amounts_of(id, function);
        amounts.is_some_and(|[_, _, _, turns @ ..]| {
            turns.iter().map(Quantity::exact).all(|by| by == Some(0.0))
        })
    }

    /// Whether `pose_trans(a, b)` is a step from one of several positions, or one of several steps
    /// from a position: none of those may be a feature of targets.
    pub(super) fn is_stepped_from(&self, a: ExprId, b: ExprId, function: FunctionId) -> bool {
        if !self.is_step(b, function) {
            return false;
        }
        let (mut seen, mut found) = (HashSet::new(), HashSet::new());
        let mut open = vec![(a, function)];
        while let Some((value, function)) = open.pop() {
            self.behind(value, function, &mut seen, &mut open, &mut found);
            if found.len() > MOST_POSITIONS || open.len() > MOST_POSITIONS {
                return false;
            }
        }
        let is_position = |id: &LiteralId| {
            let literal = self.parsed.literal(*id);
            literal.pose && literal.content != Content::Expressions && !self.features.contains(id)
        };
        // where the text does not bound it, it may lead anywhere
        let is_counted = match self.follow(b, function) {
            (Expr::Literal(id), function) => {
                let is_bounded = |of: [Quantity; 6]| of.iter().all(|of| of.ends().is_some());
                self.parsed.literal(id).computed
                    && self.is_made_of_numbers(id, function)
                    && self.amounts_of(id, function).is_some_and(is_bounded)
            }
            _ => false,
        };
        found.iter().all(is_position) && found.len() > usize::from(!is_counted)
    }
}
