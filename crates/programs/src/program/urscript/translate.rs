//! The statements of one text.

mod dead;
mod handed;
mod loads;
mod parts;
mod postures;

use self::dead::Dead;
use self::loads::Present;
use super::common::{self, Common};
use super::files::Text;
use super::goals::{Facets, Goals};
use super::syntax::{Cog, Content, Event, Expr, ExprId, FunctionId, Parsed, Payload, Step};
use super::threads;
use super::variables::{Assigned, MOST_STEPS, VarId, Variables};
use crate::program::script::{
    self, Argument, Builder, Call, Held, How, Instruction, Modal, Place, Remark, RoutineId, Start,
    Variable, VariableId, Written, short,
};
use crate::program::{Layout, Shape, Target, TargetId, kit};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// Adds the statements of a text.
pub(super) fn translate(
    builder: &mut Builder,
    common: &mut Common,
    text: &Text,
    mut parsed: Parsed,
) {
    text.put(&mut parsed.numbers);
    let variables = Variables::new(&parsed);
    let mut translator = Translator::new(builder, common, text, &variables);
    translator.list_targets();
    translator.declare_variables();
    translator.name_waypoints();
    for function in 0..short(parsed.functions.len()) {
        translator.function(function);
    }
    translator.goals.builder.close();
    translator.report();
    builder.script.numbers.append(&mut parsed.numbers);
}

pub(super) struct Translator<'m, 'n, 'a> {
    pub(super) goals: Goals<'m, 'n, 'a>,
    text: &'m Text<'m>,
    tcp: VariableId,
    load: VariableId,
    /// What is to be said of the load.
    load_remark: VariableId,
    unknown_load: script::Expr,
    /// Whether moves go along a frame that moves.
    tracking: VariableId,
    /// Sets of guards: for moves, for streams, for arcs with which the tool rotates, for moves to
    /// joints that are computed from unknown ones.
    guards: [u32; 4],
    pub(super) first_routine: RoutineId,
    /// What parameters are about which branches ask.
    pub(super) choices: HashMap<VarId, VariableId>,
    /// What the condition of the next branch asks.
    question: Option<(u32, u32)>,
    loads: HashMap<[u64; 4], script::ValueId>,
    present: Present,
    /// Loads may go along with the tool.
    loads_in_tool: bool,
    /// Functions that others call.
    called: HashSet<FunctionId>,
    said: HashSet<(TargetId, &'static str)>,
}

impl<'m, 'n, 'a> Translator<'m, 'n, 'a> {
    fn new(
        builder: &'m mut Builder,
        common: &'m mut Common,
        text: &'m Text<'m>,
        variables: &'m Variables<'n, 'a>,
    ) -> Self {
        let parsed = variables.parsed;
        let place = text.place(0);
        let first_routine = short(builder.script.routines.len());
        for function in &parsed.functions {
            let start = match (function.name, function.thread) {
                (None, _) => Start::Main,
                (_, true) => Start::Concurrent,
                (_, false) if function.parent != function.unit => Start::Inner,
                (_, false) => Start::Called,
            };
            let name = function.name.map(|name| parsed.spelling(name));
            let place = text.place(function.offset);
            builder.declare(name.unwrap_or_default(), place, start);
        }
        let script = &mut builder.script;
        script.ends_what_runs = true;
        let unknown = common.no_tool(script);
        let mut variable = |name: &str, declared, shared| {
            script.variable(Variable {
                shared,
                ..Variable::new(name, place, declared)
            })
        };
        let tcp = variable("tcp", unknown, true);
        let load = variable("load", common.own_load(), true);
        let tracking = variable("tracking", script::Expr::Absent, false);
        let load_remark = script.variable(Variable::new("load", place, script::Expr::Absent));
        let [stream, rotated, lost] = common::refusals().map(|remark| {
            let held = Held::Remark(script.remark(remark));
            let declared = script.held(held);
            let variable = Variable::new("guard", place, declared);
            vec![tracking, load_remark, script.variable(variable)]
        });
        let guards =
            [vec![tracking, load_remark], stream, rotated, lost].map(|of| script.guard(of));
        let unknown_load = script.unknown(kit::load_chosen(
            "load-chosen-at-run-time",
            "write mass and centre of gravity with numbers: set_payload(1.5, [0, 0, 0.05])",
        ));
        let mut events = parsed.functions.iter().flat_map(|of| &of.events);
        let loads_in_tool = events.any(|event| match event {
            Event::Load(payload, _) => payload.cog == Cog::Tool,
            _ => false,
        });
        Self {
            goals: Goals {
                parsed,
                variables,
                builder,
                common,
                tcp,
                here: 0,
                is_element: false,
                held: vec![Facets::default(); variables.list.len()],
                targets: vec![None; parsed.literals.len()],
                unknown: HashMap::new(),
                lost_start: false,
                offsets: Vec::new(),
            },
            text,
            tcp,
            load,
            load_remark,
            unknown_load,
            tracking,
            guards,
            first_routine,
            choices: HashMap::new(),
            question: None,
            loads: HashMap::new(),
            present: Present::default(),
            loads_in_tool,
            called: (parsed.calls.iter())
                .flat_map(|call| variables.callees(call))
                .copied()
                .collect(),
            said: HashSet::new(),
        }
    }

    pub(super) fn at(&self, offset: u32) -> Place {
        self.text.place(offset)
    }

    // ---- targets and variables

    /// Lists the literals that moves go to.
    fn list_targets(&mut self) {
        let parsed = self.goals.parsed;
        let mut names = HashMap::new();
        for assignment in &parsed.assignments {
            let value = match parsed.expression(assignment.value) {
                Expr::Kinematics { pose, .. } => parsed.expression(pose),
                other => other,
            };
            if let Expr::Literal(id) = value
                && !assignment.part
            {
                names.insert(id, assignment.name);
            }
        }
        let all = &self.goals.variables.targets;
        let mut literals: Vec<u32> = (0..short(all.len()))
            .filter(|id| all[*id as usize])
            .collect();
        literals.retain(|id| {
            let literal = parsed.literal(*id);
            (literal.pose || literal.elements == 6) && !literal.computed
        });
        literals.sort_by_key(|id| parsed.literal(*id).offset);
        let first = short(self.goals.builder.script.numbers.len());
        self.goals.builder.script.targets.reserve(literals.len());
        for id in literals {
            let literal = parsed.literal(id);
            let is_known = literal.content != Content::Expressions;
            let (place, end) = (self.at(literal.offset), self.at(literal.end).offset);
            let layout = Layout {
                shape: if literal.pose {
                    Shape::Pose
                } else {
                    Shape::Joints
                },
                variant: literal.content.degrees(),
            };
            let targets = &mut self.goals.builder.script.targets;
            targets.push(Target {
                name: names.get(&id).map(|name| parsed.spelling(*name).into()),
                numbers: first + literal.numbers.start..first + literal.numbers.end,
                blocked: !is_known,
                ..Target::new(place, end, layout)
            });
            let target = targets.len() - 1;
            self.goals.targets[id as usize] = Some(target);
            if !is_known {
                self.block(
                    target,
                    "target-has-expressions",
                    "parts of this target are expressions, not numbers",
                    "write the target with numbers in the offline system",
                    literal.offset,
                );
            }
        }
    }

    /// The target stays as it is; `because` says so.
    fn block(
        &mut self,
        target: TargetId,
        id: &'static str,
        wrong: &str,
        hint: &'static str,
        because: u32,
    ) {
        let script = &mut self.goals.builder.script;
        script.targets[target].blocked = true;
        if !self.said.insert((target, id)) {
            return;
        }
        let found = &script.targets[target];
        let remark = match found.layout.shape {
            Shape::Pose => Remark::error_about,
            Shape::Joints => Remark::warning_about,
        };
        let because = self.text.place(because);
        let see = if because == found.place() {
            String::new()
        } else {
            let source = &self.text.sources[because.file as usize];
            let (line, _) = source.line_column(because.offset as usize);
            format!(" (see line {line})")
        };
        let name = found.name.as_ref().map(|name| format!("`{name}`: "));
        let message = format!("{}{wrong}{see}", name.unwrap_or_default());
        let place = found.place();
        self.say_at(place, remark(id, message, hint));
    }

    fn say(&mut self, offset: u32, remark: Remark) {
        self.say_at(self.at(offset), remark);
    }

    fn say_at(&mut self, place: Place, remark: Remark) {
        let script = &mut self.goals.builder.script;
        script.say(self.text.sources, place, remark);
    }

    /// Variables with several values become variables of the script.
    fn declare_variables(&mut self) {
        let variables = self.goals.variables;
        for (at, variable) in variables.list.iter().enumerate() {
            if variable.is_fixed {
                continue;
            }
            let place = self.at(variable.offset);
            let routine = variables
                .routine_of(short(at))
                .map(|f| self.first_routine + f);
            let name = self.goals.parsed.spelling(variable.name);
            let from_outside = match variable.parameter {
                Some(_) => self.goals.common.given_outside(),
                None => script::Expr::Absent,
            };
            let position = if variable.has_parts {
                self.first_target(short(at)).unwrap_or(from_outside)
            } else {
                from_outside
            };
            let frame = match variable.parameter {
                Some(_) => script::Expr::Unknown(self.goals.common.frame_computed),
                None => script::Expr::Absent,
            };
            let script = &mut self.goals.builder.script;
            let mut declare = |wanted: bool, declared| {
                wanted.then(|| {
                    script.variable(Variable {
                        routine,
                        ..Variable::new(&*name, place, declared)
                    })
                })
            };
            let is_position = variable.is_position;
            self.goals.held[at] = Facets {
                position: declare(is_position, position),
                feature: declare(is_position && variable.in_features, frame),
                tool: declare(is_position && variable.with_tools, frame),
                frame: declare(variable.is_frame, frame),
            };
        }
    }

    /// The first target that is assigned to a variable: what is written of it in parts is that
    /// target's.
    fn first_target(&self, variable: VarId) -> Option<script::Expr> {
        let mut sources = self.goals.variables.sources(variable);
        sources.find_map(|source| match self.goals.parsed.expression(source.value) {
            Expr::Literal(id) if source.way == Assigned::Whole => {
                self.goals.targets[id as usize].map(script::Expr::Target)
            }
            _ => None,
        })
    }

    // ---- statements

    fn function(&mut self, function: FunctionId) {
        let parsed = self.goals.parsed;
        let routine = self.first_routine + function;
        self.goals.here = function;
        self.goals.builder.open(routine);
        let of = &parsed.functions[function as usize];
        self.present = Present {
            // where a program begins no load has been given yet
            in_tool: (!of.thread && !self.called.contains(&function)).then_some(false),
            ..Present::default()
        };
        if let Some(remark) = threads::moves_joints(self.goals.variables, function) {
            self.say(of.offset, remark);
        }
        let calm = self.calm(&of.events);
        let mut dead = Dead::default();
        for (event, calm) in of.events.iter().zip(calm) {
            if dead.takes(event) {
                if let Event::Step(step) = event {
                    self.name_posture(&parsed.steps[*step as usize], function);
                }
                continue;
            }
            if event.is_crossing() && !calm {
                self.present = Present::default();
            }
            let builder = &mut *self.goals.builder;
            match *event {
                Event::Assign(number) if self.goals.variables.may_be_local(number) => {
                    builder.begin_if(None);
                    self.assign(number);
                    self.goals.builder.end_choice();
                }
                Event::Assign(number) => self.assign(number),
                Event::Tool(value, offset) => {
                    let tool = self.goals.tool(value, function);
                    self.write(Some(self.tcp), How::Whole(tool), offset);
                    self.present.tool = self.goals.variables.constant(value, function).ok();
                    if self.present.in_tool.unwrap_or(self.loads_in_tool) {
                        let again = Payload {
                            mass: None,
                            cog: Cog::Tool,
                        };
                        self.load(again, function, offset);
                    }
                }
                Event::Load(payload, offset) => self.load(payload, function, offset),
                Event::Tracking(on, offset) => {
                    let held = if on {
                        Held::Remark(builder.script.remark(Remark::error("moving-frame", "moves \
                            along a conveyor, with a path offset or on a part that moves are not compensated", "")))
                    } else {
                        Held::Flag(false)
                    };
                    let value = builder.script.value(held);
                    let how = How::Whole(script::Expr::Value(value));
                    self.write(Some(self.tracking), how, offset);
                }
                Event::Call(call) => self.call(call),
                Event::Question(start, end) => self.question = Some((start, end)),
                Event::If | Event::ElseIf => {
                    let question = self.question.take();
                    let tests = question.map(|part| self.tests_of(part, function));
                    let tests = tests.unwrap_or(None.into());
                    match event {
                        Event::If => self.goals.builder.begin_if(tests),
                        _ => self.goals.builder.pass_branch(tests),
                    }
                }
                Event::Switch => {
                    let question = self.question.take();
                    let of = question.and_then(|part| self.switched(part, function));
                    self.goals.builder.begin_switch(of);
                }
                Event::Never => {
                    self.question = None;
                    builder.begin_choice();
                }
                Event::Branch { is_last: true } => builder.next_branch(true),
                Event::Branch { is_last: false } => {
                    let question = self.question.take();
                    let number = question.and_then(|part| self.case(part, function));
                    self.goals.builder.next_branch(true);
                    self.goals.builder.pass_cases(number.as_slice());
                }
                Event::EndIf => builder.end_choice(),
                Event::Loop => builder.begin_loop(false),
                Event::Condition(..) => {
                    builder.begin_if(None);
                    builder.leave_loop();
                    builder.end_choice();
                }
                // text behind an endless loop is taken for text behind one
                Event::EndLoop { endless } => builder.end_loop(!endless),
                Event::Break => builder.leave_loop(),
                Event::Continue => builder.repeat_loop(),
                Event::Return(value, offset) => {
                    if let Some(result) = self.goals.variables.result_of(function) {
                        self.whole(result, value, function, offset);
                    }
                    self.goals.builder.back();
                }
                Event::Halt => builder.exit(),
                Event::Step(step) => {
                    let step = &parsed.steps[step as usize];
                    self.name_posture(step, function);
                    self.step(step, function);
                }
            }
        }
    }

    fn write(&mut self, variable: Option<VariableId>, how: How, offset: u32) {
        let place = self.at(offset);
        if let Some(variable) = variable {
            self.goals.builder.write(place, Written::One(variable), how);
        }
    }

    /// A variable with several values gets one of them.
    fn whole(&mut self, variable: VarId, value: ExprId, function: FunctionId, offset: u32) {
        for (of, value) in self.values(variable, value, function) {
            self.write(Some(of), How::Whole(value), offset);
        }
    }

    /// What a value is to each of the script's variables for one of the program's.
    fn values(
        &mut self,
        variable: VarId,
        value: ExprId,
        function: FunctionId,
    ) -> Vec<(VariableId, script::Expr)> {
        let held = self.goals.held[variable as usize];
        let mut found = Vec::new();
        if let Some(position) = held.position {
            let goal = self.goals.goal(value, function);
            found.push((position, goal.target));
            if let Some(feature) = held.feature {
                found.push((feature, self.goals.frame_of(goal.feature)));
            }
            if let Some(tool) = held.tool {
                let of = goal.tool.unwrap_or_else(|| self.tool_of(value, function));
                found.push((tool, of));
            }
        }
        if let Some(frame) = held.frame {
            let name = self.goals.variables.list[variable as usize].name;
            let name = self.goals.parsed.spelling(name);
            found.push((frame, self.goals.named_frame(value, function, &name)));
        }
        found
    }

    /// The tool of a position in a variable that also holds joints computed from poses: these have
    /// the tool that is set where they are computed, a pose that of its move.
    fn tool_of(&self, value: ExprId, function: FunctionId) -> script::Expr {
        let is_computed = matches!(
            self.goals.variables.follow(value, function).0,
            Expr::Kinematics { .. }
        );
        if is_computed || !self.goals.may_be_pose(value, function, MOST_STEPS) {
            script::Expr::Variable(self.tcp)
        } else {
            script::Expr::Unknown(self.goals.common.frame_computed)
        }
    }

    fn call(&mut self, number: u32) {
        let parsed = self.goals.parsed;
        let call = &parsed.calls[number as usize];
        if self.goals.variables.is_of_language(call) {
            return;
        }
        self.present = Present::default();
        let callees = self.goals.variables.callees(call).to_vec();
        let mut arguments = if callees.is_empty() {
            self.handed(call)
        } else {
            Vec::new()
        };
        for &callee in &callees {
            for position in 0..parsed.functions[callee as usize].parameters.len() {
                let (parameter, given) = self.goals.variables.given(call, callee, position);
                let values = if let Some((value, function)) = given {
                    self.values(parameter, value, function)
                } else {
                    // what was given before is no longer there
                    let held = self.goals.held[parameter as usize].position;
                    let outside = self.goals.common.given_outside();
                    held.map(|held| (held, outside)).into_iter().collect()
                };
                let given = |(parameter, value)| Argument::new(Some(parameter), value, None);
                arguments.extend(values.into_iter().map(given));
                arguments.extend(self.choice_given(number, callee, position));
            }
        }
        let place = self.at(call.offset);
        let builder = &mut *self.goals.builder;
        let routines = callees.iter().map(|f| self.first_routine + f).collect();
        let arguments = builder.script.give(arguments);
        let call = Call::of(place, routines, parsed.spelling(call.name), arguments);
        let is_thread = |callee: &FunctionId| parsed.functions[*callee as usize].thread;
        if callees.iter().any(is_thread) {
            builder.start(call, true);
        } else {
            builder.call(call);
        }
    }

    fn step(&mut self, step: &Step, function: FunctionId) {
        let place = self.at(step.offset);
        let mut instruction = Instruction {
            end: self.at(step.end).offset,
            motion: step.motion,
            target: script::Expr::Unknown(self.goals.common.somewhere),
            ..Instruction::at(place)
        };
        let mut modal = Modal {
            tool: script::Expr::Variable(self.tcp),
            frame: script::Expr::Value(self.goals.common.base),
            load: script::Expr::Variable(self.load),
            guards: self.guards[0],
            speed_zone: step.speed_zone,
            ..Modal::default()
        };
        if let Some(target) = step.target {
            self.goals.lost_start = false;
            let goal = self.goals.goal(target, function);
            let is_stream = step.streamed && self.goals.may_be_pose(target, function, MOST_STEPS);
            instruction.target = goal.target;
            modal.frame = self.goals.frame_of(goal.feature);
            instruction.near = goal.near.map(Box::new);
            if let Some(tool) = goal.tool {
                modal.tool = tool;
            }
            if is_stream {
                modal.guards = self.guards[1];
            } else if step.rotates_with_arc {
                modal.guards = self.guards[2];
            } else if self.goals.lost_start {
                modal.guards = self.guards[3];
            }
            if step.repeatable && !step.streamed {
                instruction.target_span = self.text.span(goal.span, place);
            }
        }
        self.goals.builder.go(instruction, modal);
    }

    // ---- what concerns the whole

    fn report(&mut self) {
        for (target, at) in std::mem::take(&mut self.goals.offsets) {
            self.block(
                target,
                "target-used-as-offset",
                "this target is the offset of another one too, or has one; compensating it would \
                 change that one",
                "give the offset a variable of its own",
                at,
            );
        }
        self.judge_gravity();
        for &offset in &self.goals.parsed.forces {
            let remarks = &self.goals.builder.script.remarks;
            let remark = remarks[self.goals.common.somewhere as usize].clone();
            self.say(offset, remark);
        }
        self.report_copies();
    }

    /// Values that are computed from targets.
    fn report_copies(&mut self) {
        let parsed = self.goals.parsed;
        let mut said = HashSet::new();
        for &(name, function, offset) in &parsed.mentions {
            let Some(variable) = self.goals.variables.meaning(name, function) else {
                continue;
            };
            if !self.holds_rewritten(variable, MOST_STEPS) || !said.insert((variable, offset)) {
                continue;
            }
            let message = format!(
                "a value is computed from `{}`, whose numbers change",
                parsed.spelling(name)
            );
            let hint = "look where the new value is used";
            self.say(
                offset,
                Remark::warning_about("target-copied", message, hint),
            );
        }
    }

    /// Whether numbers that change are in a variable, or in what calls give a parameter.
    fn holds_rewritten(&self, variable: VarId, steps: u32) -> bool {
        let of = &self.goals.variables.list[variable as usize];
        let (Some(steps), false) = (steps.checked_sub(1), of.has_parts) else {
            return false;
        };
        let targets = &self.goals.builder.script.targets;
        let is_parameter = of.parameter.is_some();
        let mut sources = self.goals.variables.sources(variable);
        sources.any(|source| match self.goals.parsed.expression(source.value) {
            Expr::Literal(id) => self.goals.targets[id as usize].is_some_and(|target| {
                let target = &targets[target];
                !target.blocked && target.layout.shape == Shape::Pose
            }),
            Expr::Name(name, _) | Expr::Element(name, _) if is_parameter => {
                let given = self.goals.variables.meaning(name, source.function);
                given.is_some_and(|given| self.holds_rewritten(given, steps / 2))
            }
            _ => false,
        })
    }
}
