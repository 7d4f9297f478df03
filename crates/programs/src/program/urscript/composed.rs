//! Poses with expressions in them: `p[x, y, z + 0.1, 0, 0, 0]`, `p[a[0], a[1], a[2] + 0.1, a[3],
//! a[4], a[5]]`.
//!
//! Their moves stay as they are, and so do those to what functions of the language make of poses:
//! `pose_sub(a, b)`, `interpolate_pose(a, b, 0.5)`. Where numbers of a rewritten target flow into
//! one, it takes the correction along: it is that target, displaced by what the text tells or by
//! something.

use super::goals::{Feature, Goal, Goals};
use super::reader::Reader;
use super::syntax::{
    Assignment, Event, Expr, ExprId, FunctionId, Literal, LiteralId, OTHER, Symbol,
};
use super::tokens::{Kind, Token};
use super::variables::{VarId, Variables};
use super::verbs::{self, PoseCall};
use crate::program::script::{self, DisplacementId, OVERWRITTEN, RemarkId, UNBOUNDED, short};
use foldhash::{HashMap, HashSet, HashSetExt};
use std::ops::Range;

/// Variables between a pose and the targets that it is computed from, that are looked into.
const MOST_BETWEEN: usize = 256;

/// Names of a list that are compared with each further one, so that each is noted once.
const MOST_COMPARED: usize = 64;

impl<'a> Reader<'a> {
    /// What the brackets behind `open` name.
    pub(super) fn look_into(&mut self, literal: &mut Literal, open: Token) {
        let end = self.scanner.at;
        let mut ahead = self.scanner;
        ahead.at = open.end;
        let is_pose = literal.pose && literal.elements == 6;
        let first = self.parsed.composed.len();
        while ahead.at < end
            && let Ok(token) = ahead.next()
        {
            let text = self.text(token);
            if token.kind != Kind::Word || verbs::is_operator(text) || verbs::is_constant(text) {
                continue;
            }
            literal.computed = is_pose;
            if !ahead.peek().is(b'(') {
                self.note_name(text, first);
            }
        }
        literal.names = short(first)..short(self.parsed.composed.len());
        if literal.computed {
            let coordinates = self.coordinates(open, end);
            let literal = short(self.parsed.literals.len());
            self.parsed.coordinates.insert(literal, coordinates);
        }
    }

    /// Notes a name of which a value is computed whose others stand from `first` on.
    fn note_name(&mut self, text: &'a [u8], first: usize) {
        let (symbol, _) = self.member(text);
        let known = &self.parsed.composed[first..];
        if !known[..known.len().min(MOST_COMPARED)].contains(&symbol) {
            self.parsed.composed.push(symbol);
        }
    }

    /// What is computed between these bytes, by the names in it.
    pub(super) fn made_of_names(&mut self, start: usize, end: usize) -> ExprId {
        let mut ahead = self.scanner;
        ahead.at = start;
        let first = self.parsed.composed.len();
        while ahead.at < end
            && let Ok(token) = ahead.next()
        {
            let text = self.text(token);
            if token.kind == Kind::Word && !verbs::is_operator(text) && !verbs::is_constant(text) {
                self.note_name(text, first);
            }
        }
        let behind = self.parsed.composed.len();
        if behind == first {
            return OTHER;
        }
        self.parsed.add(Expr::Made(short(first), short(behind)))
    }

    /// The names in each of the first three elements behind `open`, and the functions that they call;
    /// elements that ask where the robot is are left out.
    fn coordinates(&mut self, open: Token, end: usize) -> Vec<Range<u32>> {
        let mut ahead = self.scanner;
        ahead.at = open.end;
        let (mut found, mut elements, mut depth) = (Vec::new(), 0, 0);
        let (mut first, mut asks) = (self.parsed.composed.len(), false);
        while elements < 3
            && ahead.at < end
            && let Ok(token) = ahead.next()
        {
            match token.kind {
                Kind::Sign(b'(' | b'[') => depth += 1,
                Kind::Sign(b',' | b']') if depth == 0 => {
                    let behind = self.parsed.composed.len();
                    if !asks {
                        found.push(short(first)..short(behind));
                    }
                    (first, asks) = (behind, false);
                    elements += 1;
                }
                Kind::Sign(b')' | b']') => depth -= 1,
                Kind::Word => {
                    let text = self.text(token);
                    let is_call = ahead.peek().is(b'(');
                    asks |=
                        is_call && matches!(verbs::value_of(text), Some(PoseCall::Actual { .. }));
                    self.note_name(text, first);
                }
                _ => {}
            }
        }
        found
    }
}

impl Variables<'_, '_> {
    /// Variables whose values are computed from others, with those.
    pub(super) fn find_mentions(&mut self) {
        let parsed = self.parsed;
        let parts = parsed.assignments.iter().filter(|of| of.part);
        let mut parts: HashMap<u32, Vec<VarId>> = parts.map(|of| (of.offset, Vec::new())).collect();
        if parsed.composed.is_empty() && parts.is_empty() {
            return;
        }
        let assignments = parsed.assignments.iter().zip(&self.assigned);
        let mut at: HashMap<u32, VarId> = assignments
            .map(|(assignment, variable)| (assignment.offset, *variable))
            .collect();
        for (function, of) in (0..).zip(&parsed.functions) {
            let result = self.result_of(function);
            at.extend(of.events.iter().filter_map(|event| match event {
                Event::Return(_, offset) => Some((*offset, result?)),
                _ => None,
            }));
        }
        for &(name, function, offset) in &parsed.mentions {
            if let (Some(to), Some(from)) = (at.get(&offset), self.meaning(name, function)) {
                self.mentioned.entry(*to).or_default().push(from);
                if let Some(part) = parts.get_mut(&offset) {
                    part.push(from);
                }
            }
        }
        self.mentioned_in_parts = parts;
    }

    /// Whether an assignment writes a coordinate, or a joint, over that comes from no target and not
    /// from where the robot is.
    pub(super) fn writes_own_number(&self, assignment: &Assignment) -> bool {
        let value = self.parsed.expression(assignment.value);
        if assignment.is_number {
            return true;
        }
        if matches!(value, Expr::Literal(_) | Expr::List(_))
            || assignment.element.number().is_none_or(|at| at > 2)
        {
            return false;
        }
        let mentioned = self.mentioned_in_parts.get(&assignment.offset);
        let mut open = mentioned.cloned().unwrap_or_default();
        self.add_behind(assignment.value, assignment.function, &mut open);
        !matches!(value, Expr::Actual { .. }) && self.are_own_numbers(open)
    }

    /// Whether some coordinate of a pose with expressions comes from no target and not from where
    /// the robot is.
    fn has_own_coordinate(&self, id: LiteralId, function: FunctionId) -> bool {
        let parsed = self.parsed;
        let own = |coordinate: &Range<u32>| {
            let names = &parsed.composed[coordinate.start as usize..coordinate.end as usize];
            self.are_own_numbers(self.named(names, function))
        };
        let coordinates = parsed.coordinates.get(&id);
        coordinates.is_some_and(|all| all.iter().any(own))
    }

    /// Whether no number of a pose with expressions comes from a target or from where the robot is.
    pub(super) fn is_made_of_numbers(&self, id: LiteralId, function: FunctionId) -> bool {
        self.are_own_numbers(self.named(self.parsed.names_in(id), function))
    }

    /// The variables of these names, and what functions of these names return.
    pub(super) fn named(&self, names: &[Symbol], function: FunctionId) -> Vec<VarId> {
        let variable = |name: &Symbol| {
            let variable = self.meaning(*name, function);
            variable.or_else(|| self.result_named(*name, function))
        };
        names.iter().filter_map(variable).collect()
    }

    /// Whether what is computed from variables has no number of a target, or of where the robot is.
    fn are_own_numbers(&self, open: Vec<VarId>) -> bool {
        let mut is_actual = false;
        self.positions_behind(open, &mut is_actual).is_empty() && !is_actual
    }

    /// The positions that moves go to whose numbers may flow into what is computed from variables,
    /// and whether where the robot is may.
    fn positions_behind(&self, mut open: Vec<VarId>, is_actual: &mut bool) -> Vec<VarId> {
        let mut seen = HashSet::new();
        let mut found = Vec::new();
        while let Some(variable) = open.pop() {
            if !seen.insert(variable) || seen.len() > MOST_BETWEEN {
                continue;
            }
            if self.list[variable as usize].is_position {
                found.push(variable);
                continue;
            }
            for source in self.sources(variable) {
                let value = self.parsed.expression(source.value);
                *is_actual |= matches!(value, Expr::Actual { .. });
                self.add_behind(source.value, source.function, &mut open);
            }
            open.extend(self.mentioned.get(&variable).into_iter().flatten());
        }
        found.sort_unstable();
        found
    }

    /// The variables in a value.
    fn add_behind(&self, value: ExprId, function: FunctionId, open: &mut Vec<VarId>) {
        let parsed = self.parsed;
        let mut values = vec![value];
        // values inside each other come one after the other, and are not many
        while let Some(value) = values.pop() {
            match parsed.expression(value) {
                Expr::Name(name, _) | Expr::Element(name, _) => {
                    open.extend(self.meaning(name, function));
                }
                Expr::Literal(id) => {
                    let names = parsed.names_in(id).iter();
                    open.extend(names.filter_map(|name| self.meaning(*name, function)));
                }
                Expr::List(list) => {
                    let names = parsed.names_in(parsed.lists[list as usize].literal).iter();
                    open.extend(names.filter_map(|name| self.meaning(*name, function)));
                }
                Expr::Trans(a, b) | Expr::Add(a, b) => values.extend([a, b]),
                Expr::Inverse(a) | Expr::Kinematics { pose: a, .. } => values.push(a),
                Expr::Call(call) => {
                    open.extend(self.result(call));
                    let given = parsed.arguments_of(&parsed.calls[call as usize]);
                    values.extend(given.iter().map(|(_, value)| *value));
                }
                Expr::Made(from, to) => {
                    open.extend(self.named(parsed.composed_in(from..to), function));
                }
                Expr::Actual { .. } | Expr::Number(_) | Expr::Other => {}
            }
        }
    }
}

impl Goals<'_, '_, '_> {
    /// Where a pose with expressions is.
    pub(super) fn composed(&mut self, id: LiteralId, function: FunctionId, steps: u32) -> Goal {
        let parsed = self.parsed;
        let literal = parsed.literal(id);
        if let Some((name, along)) = self.variables.grown(id, function) {
            let goal = self.named(name, literal.offset, function, steps);
            return self.shifted_along(goal, &along);
        }
        let names = parsed.names_in(id).iter();
        let named = names.filter_map(|name| self.variables.meaning(*name, function));
        let named = named.collect();
        let by = if self.variables.has_own_coordinate(id, function) {
            OVERWRITTEN
        } else {
            UNBOUNDED
        };
        let unknown = self.common.expressions;
        self.made_of(named, by, unknown, steps)
    }

    /// Where the value of a function of the language is, as far as positions are given to it.
    pub(super) fn made_of_arguments(
        &mut self,
        value: ExprId,
        function: FunctionId,
        steps: u32,
    ) -> Goal {
        let mut named = Vec::new();
        self.variables.add_behind(value, function, &mut named);
        self.made_of(named, UNBOUNDED, self.common.computed, steps)
    }

    /// Where a pose is that is computed from variables: next to the targets that flow into it.
    pub(super) fn made_of(
        &mut self,
        named: Vec<VarId>,
        by: DisplacementId,
        unknown: RemarkId,
        steps: u32,
    ) -> Goal {
        let positions = self.variables.positions_behind(named, &mut false);
        // however these are made of each other, not many are looked into
        let steps = steps.div_ceil(short(positions.len()).max(1));
        let mut goals = Vec::new();
        for variable in positions {
            let goal = match self.variables.fixed(variable) {
                Some(source) => self.goal_within(source.value, source.function, steps),
                None => self.variable(variable),
            };
            if !matches!(goal.target, script::Expr::Unknown(_)) {
                goals.push(self.displaced_by(goal, by));
            }
        }
        if goals.len() < 2 {
            let unknown = Goal::to(script::Expr::Unknown(unknown));
            return goals.pop().unwrap_or(unknown);
        }
        let is_plain = |goal: &Goal| matches!(goal.feature, Feature::Base) && goal.tool.is_none();
        let feature = if goals.iter().all(is_plain) {
            Feature::Base
        } else {
            Feature::Held(script::Expr::Unknown(self.common.frame_computed))
        };
        let any = self
            .builder
            .script
            .any(goals.into_iter().map(|goal| goal.target));
        Goal {
            feature,
            ..Goal::to(any)
        }
    }
}
