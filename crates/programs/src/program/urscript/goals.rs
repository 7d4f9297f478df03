//! What values mean as positions, features and tools.

use super::common::{Common, TOOL};
use super::numbers::{along_base, in_base, in_tool};
use super::syntax::{At, Expr, ExprId, FunctionId, LiteralId, Parsed, Symbol, unit};
use super::variables::{MOST_STEPS, NotConstant, VarId, Variables};
use crate::geometry::Pose;
use crate::program::quantity::Quantity;
use crate::program::script::{
    self, Builder, DISPLACED_SOMEHOW, DisplacementId, Held, Remark, RemarkId, Span, UNBOUNDED,
    VariableId,
};
use crate::program::{Displacement, Shift, TargetId};
use foldhash::HashMap;

/// Values of a variable that are looked at where it had one of them.
const MOST_GIVEN: usize = 64;

/// Where a move goes.
pub(super) struct Goal {
    pub target: script::Expr,
    pub feature: Feature,
    /// The tool that the inverse is given, where it is not the one that is set.
    pub tool: Option<script::Expr>,
    pub near: Option<[f64; 6]>,
    /// The bytes of the target's numbers or of the variable that holds them alone.
    pub span: Span,
    /// It is nothing but a target's numbers, by whichever name.
    pub is_plain: bool,
}

impl Goal {
    pub(super) fn to(target: script::Expr) -> Self {
        Self {
            target,
            feature: Feature::Base,
            tool: None,
            near: None,
            span: Span::default(),
            is_plain: false,
        }
    }
}

/// The feature that a position is in.
pub(super) enum Feature {
    Base,
    Known(Pose, String),
    Held(script::Expr),
}

/// The script's variables for one of the program's.
#[derive(Clone, Copy, Default)]
pub(super) struct Facets {
    /// The position.
    pub position: Option<VariableId>,
    /// The feature that the position is in.
    pub feature: Option<VariableId>,
    /// The tool that the position is computed with.
    pub tool: Option<VariableId>,
    /// The variable as a feature or tool itself.
    pub frame: Option<VariableId>,
}

/// Understands the values of one file.
pub(super) struct Goals<'m, 'n, 'a> {
    pub parsed: &'n Parsed<'a>,
    pub variables: &'m Variables<'n, 'a>,
    pub builder: &'m mut Builder,
    pub common: &'m mut Common,
    pub tcp: VariableId,
    /// The function whose statements are translated.
    pub here: FunctionId,
    /// What is followed is an element of a list or structure: what stood in it when that was made.
    pub is_element: bool,
    /// By variable of the program.
    pub held: Vec<Facets>,
    /// By literal.
    pub targets: Vec<Option<TargetId>>,
    /// Names that the file does not assign.
    pub unknown: HashMap<Symbol, RemarkId>,
    /// Since this was last looked at, joints that an inverse starts from were none that the text
    /// tells.
    pub lost_start: bool,
    /// Targets that are offsets of others too, and the offset's first byte.
    pub offsets: Vec<(TargetId, u32)>,
}

impl Goals<'_, '_, '_> {
    /// Follows a position to its numbers.
    pub(super) fn goal(&mut self, value: ExprId, function: FunctionId) -> Goal {
        self.goal_within(value, function, MOST_STEPS)
    }

    fn unknown(&self) -> Goal {
        Goal::to(script::Expr::Unknown(self.common.computed))
    }

    pub(super) fn goal_within(&mut self, value: ExprId, function: FunctionId, steps: u32) -> Goal {
        let Some(steps) = steps.checked_sub(1) else {
            return self.unknown();
        };
        match self.parsed.expression(value) {
            Expr::Literal(id) if self.parsed.literal(id).computed => {
                self.composed(id, function, steps)
            }
            Expr::Literal(id) => self.literal(id),
            Expr::List(list) => match self.variables.joints_of(list) {
                Some(id) => self.literal(id),
                None => self.unknown(),
            },
            Expr::Name(name, offset) => self.named(name, offset, function, steps),
            Expr::Element(name, at) => self.element(name, at, function, steps),
            Expr::Call(call) => match self.variables.result(call) {
                Some(variable) => self.variable(variable),
                None if self
                    .variables
                    .is_of_language(&self.parsed.calls[call as usize]) =>
                {
                    self.made_of_arguments(value, function, steps)
                }
                None => self.unknown(),
            },
            Expr::Actual { is_pose } => {
                let tool = script::Expr::Variable(self.tcp);
                let frame = script::Expr::Value(self.common.base);
                Goal::to(self.builder.script.held(if is_pose {
                    Held::ActualWith { tool, frame }
                } else {
                    Held::Actual
                }))
            }
            Expr::Kinematics { pose, near, tcp } => {
                let goal = self.goal_within(pose, function, steps);
                let own = tcp.map(|tcp| self.tool(tcp, function));
                let start = near.and_then(|near| self.joints(near, function));
                self.lost_start |= start.is_none()
                    && near.is_some_and(|near| !self.variables.is_actual(near, function));
                Goal {
                    tool: own.or(goal.tool),
                    near: start.or(goal.near),
                    is_plain: false,
                    ..goal
                }
            }
            Expr::Trans(a, b) => {
                if self.variables.goes_to(a, function) {
                    let goal = self.goal_within(a, function, steps);
                    self.note_offset(goal.target, b, function);
                    let by = self.variables.constant(b, function).ok();
                    if by.is_none()
                        && let Some(amounts) = self.variables.amounts(b, function)
                        && let Some(by) = in_tool(amounts)
                    {
                        let by = self.builder.script.displacement(by);
                        return self.displaced_by(goal, by);
                    }
                    let by = by.map(|in_tool| Shift {
                        in_tool,
                        ..Shift::along([0.0; 3])
                    });
                    let otherwise = self.displaced_somehow(b, function);
                    return self.displaced(goal, by, otherwise);
                }
                if self.variables.is_actual(a, function) {
                    let Ok(in_tool) = self.variables.constant(b, function) else {
                        return self.unknown();
                    };
                    let goal = self.goal_within(a, function, steps);
                    let by = Shift {
                        in_tool,
                        ..Shift::along([0.0; 3])
                    };
                    return self.displaced(goal, Some(by), UNBOUNDED);
                }
                let goal = self.goal_within(b, function, steps);
                let is_known = !matches!(goal.target, script::Expr::Unknown(_));
                let is_in_known = is_known && self.variables.constant(a, function).is_ok();
                if !is_in_known {
                    // what it is made of may be rewritten
                    let of = if is_known { a } else { value };
                    let made = self.made_of_arguments(of, function, steps);
                    if !matches!(made.target, script::Expr::Unknown(_)) {
                        return made;
                    }
                }
                let feature = self.feature(a, function);
                Goal {
                    feature: self.inside(feature, goal.feature),
                    is_plain: false,
                    ..goal
                }
            }
            Expr::Add(a, b) => {
                if self.variables.is_actual(b, function) {
                    return self.unknown();
                }
                let goal = self.goal_within(a, function, steps);
                self.note_offset(goal.target, b, function);
                let by = self.variables.constant(b, function).ok();
                if by.is_none()
                    && matches!(goal.feature, Feature::Base)
                    && let Some(amounts) = self.variables.amounts(b, function)
                    && let Some(by) = in_base(amounts)
                {
                    let by = self.builder.script.displacement(by);
                    return self.displaced_by(goal, by);
                }
                let otherwise = self.displaced_somehow(b, function);
                self.shifted_in_base(goal, by, otherwise)
            }
            Expr::Made(..) => self.made_of_arguments(value, function, steps),
            Expr::Inverse(_) | Expr::Number(_) | Expr::Other => self.unknown(),
        }
    }

    /// Where a variable is.
    pub(super) fn named(
        &mut self,
        name: Symbol,
        offset: u32,
        function: FunctionId,
        steps: u32,
    ) -> Goal {
        let Some(variable) = self.variables.meaning(name, function) else {
            return Goal::to(self.not_in_files(name));
        };
        let Some(source) = self.variables.fixed(variable) else {
            return match self.held_before(variable) {
                Some(values) => self.any_of(values, steps / 2),
                None => self.variable(variable),
            };
        };
        let goal = self.goal_within(source.value, source.function, steps);
        let span = Span {
            start: offset,
            end: offset + script::short(self.parsed.bytes(name).len()),
        };
        Goal {
            span: if goal.is_plain { span } else { Span::default() },
            ..goal
        }
    }

    /// All values that a variable gets, where the one that counts is not the one that it holds where the
    /// move is: a parameter of a function that has ended, or what was put into a list before.
    fn held_before(&self, variable: VarId) -> Option<Vec<(ExprId, FunctionId)>> {
        let of = &self.variables.list[variable as usize];
        let is_gone = match of.parameter {
            Some(function) => !self.parsed.is_in(self.here, function),
            None => self.is_element && self.variables.sources(variable).nth(1).is_some(),
        };
        if !is_gone {
            return None;
        }
        let values = self.variables.sources(variable).take(MOST_GIVEN + 1);
        let values: Vec<_> = values.map(|of| (of.value, of.function)).collect();
        // too many, or changed in part: none that is known
        let is_known = values.len() <= MOST_GIVEN && !of.has_parts;
        Some(if is_known { values } else { Vec::new() })
    }

    /// What displaces by an offset that has not one value.
    fn displaced_somehow(&self, by: ExprId, function: FunctionId) -> DisplacementId {
        if self.variables.is_of_robot(by, function) {
            DISPLACED_SOMEHOW
        } else {
            UNBOUNDED
        }
    }

    /// The position that a variable holds, where that is known.
    pub(super) fn position_named(
        &mut self,
        name: Symbol,
        function: FunctionId,
    ) -> Option<script::Expr> {
        let goal = self.named(name, 0, function, MOST_STEPS);
        let is_known = !matches!(goal.target, script::Expr::Unknown(_));
        is_known.then_some(goal.target)
    }

    /// The sum of a position and an offset, as `pose_add` has it.
    pub(super) fn shifted_in_base(
        &mut self,
        goal: Goal,
        by: Option<Pose>,
        otherwise: DisplacementId,
    ) -> Goal {
        // the sum is in the base, the displacement in the feature
        let base_from_feature = match &goal.feature {
            Feature::Base => Some(Pose::identity()),
            Feature::Known(pose, _) => Some(*pose),
            Feature::Held(_) => None,
        };
        let by = by
            .zip(base_from_feature)
            .map(|(by, base_from_feature)| Shift {
                in_tool: Pose::from_rotation(by.rotation),
                ..Shift::along(base_from_feature.rotation.transpose() * by.translation)
            });
        self.displaced(goal, by, otherwise)
    }

    /// A position with something added to its coordinates.
    pub(super) fn shifted_along(&mut self, goal: Goal, along: &[Quantity; 3]) -> Goal {
        let exactly = along.each_ref().map(Quantity::exact);
        if let [Some(x), Some(y), Some(z)] = exactly {
            let by = Pose::from_translation(x, y, z);
            return self.shifted_in_base(goal, Some(by), UNBOUNDED);
        }
        let by = match goal.feature {
            Feature::Base => self.builder.script.displacement(along_base(along)),
            _ => UNBOUNDED,
        };
        self.displaced_by(goal, by)
    }

    fn literal(&self, id: LiteralId) -> Goal {
        let literal = self.parsed.literal(id);
        match self.targets[id as usize] {
            Some(target) => Goal {
                span: Span {
                    start: literal.offset,
                    end: literal.end,
                },
                is_plain: true,
                ..Goal::to(script::Expr::Target(target))
            },
            None => self.unknown(),
        }
    }

    /// What a variable holds that has several values.
    pub(super) fn variable(&self, variable: VarId) -> Goal {
        let held = self.held[variable as usize];
        let Some(position) = held.position else {
            return self.unknown();
        };
        Goal {
            feature: match held.feature {
                Some(feature) => Feature::Held(script::Expr::Variable(feature)),
                None => Feature::Base,
            },
            tool: held.tool.map(script::Expr::Variable),
            ..Goal::to(script::Expr::Variable(position))
        }
    }

    /// Any of the elements of a list that the index may mean; the member of a structure.
    fn element(&mut self, name: Symbol, at: At, function: FunctionId, steps: u32) -> Goal {
        let elements = match self.variables.meaning(name, function) {
            // what has members may be a service of another computer
            None if matches!(at, At::Member(_)) => return self.unknown(),
            None => return Goal::to(self.not_in_files(name)),
            Some(variable) => match self.variables.elements(name, at, function) {
                Some(elements) if !elements.values.is_empty() => elements,
                _ => return self.made_of(vec![variable], UNBOUNDED, self.common.computed, steps),
            },
        };
        let is_inside = std::mem::replace(&mut self.is_element, true);
        let goal = self.any_of(elements.values, steps);
        self.is_element = is_inside;
        match elements.changed {
            Some(by) => self.displaced_by(goal, by),
            None => goal,
        }
    }

    /// One of several values, each with the function in which its names are looked up.
    fn any_of(&mut self, values: Vec<(ExprId, FunctionId)>, steps: u32) -> Goal {
        if let [(value, within)] = values[..] {
            let goal = self.goal_within(value, within, steps);
            return Goal {
                span: Span::default(),
                is_plain: false,
                ..goal
            };
        }
        let mut all = Vec::with_capacity(values.len());
        for (value, within) in values {
            let goal = self.goal_within(value, within, steps);
            if !matches!(goal.feature, Feature::Base) || goal.tool.is_some() {
                return self.unknown();
            }
            all.push(goal.target);
        }
        match *all {
            [] => self.unknown(),
            _ => Goal::to(self.builder.script.any(all)),
        }
    }

    fn displaced(&mut self, goal: Goal, by: Option<Shift>, otherwise: DisplacementId) -> Goal {
        let by: DisplacementId = match by {
            Some(shift) => self
                .builder
                .script
                .displacement(Displacement::By(Box::new(shift))),
            None => otherwise,
        };
        self.displaced_by(goal, by)
    }

    pub(super) fn displaced_by(&mut self, goal: Goal, by: DisplacementId) -> Goal {
        Goal {
            target: match goal.target {
                script::Expr::Unknown(_) => goal.target,
                target => self.builder.script.displaced(target, by),
            },
            is_plain: false,
            ..goal
        }
    }

    /// A pose that moves go to may not be the offset of another.
    fn note_offset(&mut self, of: script::Expr, offset: ExprId, function: FunctionId) {
        let (Expr::Literal(id), _) = self.variables.follow(offset, function) else {
            return;
        };
        if let Some(target) = self.targets[id as usize] {
            let at = self.parsed.literal(id).offset;
            self.offsets.push((target, at));
            if let script::Expr::Target(of) = of {
                self.offsets.push((of, at));
            }
        }
    }

    fn not_in_files(&mut self, name: Symbol) -> script::Expr {
        let script = &mut self.builder.script;
        let parsed = self.parsed;
        let remark = *self.unknown.entry(name).or_insert_with(|| {
            script.remarks.push(Remark::error_about(
                "target-not-in-files",
                format!(
                    "`{}`: the file does not assign this variable; the move is not compensated",
                    parsed.spelling(name)
                ),
                "save the program together with the installation's variables",
            ));
            script::short(script.remarks.len() - 1)
        });
        script::Expr::Unknown(remark)
    }

    /// A feature that a target stands in.
    fn feature(&mut self, value: ExprId, function: FunctionId) -> Feature {
        match self.variables.constant(value, function) {
            Ok(pose) => {
                let name = match self.parsed.expression(value) {
                    Expr::Name(name, _) => self.parsed.spelling(name),
                    _ => "feature".into(),
                };
                Feature::Known(pose, name.into_owned())
            }
            Err(why) => Feature::Held(self.not_constant(why)),
        }
    }

    /// A feature inside another.
    fn inside(&mut self, outer: Feature, inner: Feature) -> Feature {
        match (outer, inner) {
            (outer, Feature::Base) => outer,
            (Feature::Base, inner) => inner,
            (Feature::Known(outer, before), Feature::Known(inner, name)) => {
                Feature::Known(outer * inner, format!("{before}.{name}"))
            }
            _ => Feature::Held(script::Expr::Unknown(self.common.frame_computed)),
        }
    }

    /// A feature as an expression.
    pub(super) fn frame_of(&mut self, feature: Feature) -> script::Expr {
        match feature {
            Feature::Base => script::Expr::Value(self.common.base),
            Feature::Known(pose, name) => {
                self.common
                    .frame(&mut self.builder.script, &name, Some(pose))
            }
            Feature::Held(held) => held,
        }
    }

    /// A feature or tool by its name.
    pub(super) fn named_frame(
        &mut self,
        value: ExprId,
        function: FunctionId,
        name: &str,
    ) -> script::Expr {
        match self.variables.constant(value, function) {
            Ok(pose) => self
                .common
                .frame(&mut self.builder.script, name, Some(pose)),
            Err(why) => self.not_constant(why),
        }
    }

    /// A tool.
    pub(super) fn tool(&mut self, value: ExprId, function: FunctionId) -> script::Expr {
        self.named_frame(value, function, TOOL)
    }

    fn not_constant(&mut self, why: NotConstant) -> script::Expr {
        let held = match why {
            NotConstant::Unknown(name) => {
                let name = self.parsed.spelling(name);
                return self.common.frame(&mut self.builder.script, &name, None);
            }
            NotConstant::Changing(variable) => self.held[variable as usize].frame,
            NotConstant::Computed => None,
            NotConstant::Endless(angle) => {
                let remark = Remark::error_about(
                    "angle-too-large",
                    format!(
                        "the rotation vector of its feature or tool has a part of {angle}; the \
                         limit is 4 pi rad"
                    ),
                    "rotation vectors are in radians; d2r(…) turns degrees into them",
                );
                let remark = self.builder.script.remark(remark);
                return script::Expr::Unknown(remark);
            }
        };
        held.map_or(
            script::Expr::Unknown(self.common.frame_computed),
            script::Expr::Variable,
        )
    }

    /// Six joint angles that the text tells, radians.
    pub(super) fn joints(&self, value: ExprId, function: FunctionId) -> Option<[f64; 6]> {
        let literal = self.parsed.literal(self.variables.joints(value, function)?);
        let values = self.parsed.values(literal).filter(|_| !literal.pose)?;
        let degrees = literal.content.degrees();
        Some(std::array::from_fn(|at| values[at] * unit(degrees, at)))
    }

    /// Whether a value holds a target that moves go to elsewhere.
    pub(super) fn has_target(&self, value: ExprId, function: FunctionId, steps: u32) -> bool {
        let Some(steps) = steps.checked_sub(1) else {
            return false;
        };
        let inner = |value| self.has_target(value, function, steps);
        match self.parsed.expression(value) {
            Expr::Literal(id) => self.targets[id as usize].is_some(),
            Expr::Name(name, _) => {
                self.variables.meaning(name, function).is_some_and(|v| {
                    match self.variables.fixed(v) {
                        Some(source) => self.has_target(source.value, source.function, steps),
                        None => self.held[v as usize].position.is_some(),
                    }
                })
            }
            Expr::Trans(a, b) => inner(a) || inner(b),
            Expr::Add(a, _) => inner(a),
            Expr::Kinematics { pose, .. } => inner(pose),
            Expr::Element(name, at) => {
                let elements = self.variables.elements(name, at, function);
                let mut elements = elements.into_iter().flat_map(|of| of.values);
                elements.any(|(value, function)| self.has_target(value, function, steps / 2))
            }
            _ => false,
        }
    }

    /// Whether a value may be a pose, not joints.
    pub(super) fn may_be_pose(&self, value: ExprId, function: FunctionId, steps: u32) -> bool {
        let Some(steps) = steps.checked_sub(1) else {
            return true;
        };
        match self.parsed.expression(value) {
            Expr::Literal(id) => self.parsed.literal(id).pose,
            Expr::Name(name, _) => self.variables.meaning(name, function).is_some_and(|v| {
                let mut sources = self.variables.sources(v);
                sources.any(|s| self.may_be_pose(s.value, s.function, steps / 2))
            }),
            Expr::List(_) => false,
            _ => true,
        }
    }
}
