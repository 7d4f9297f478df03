//! What each move drives to, with which tool, in which feature.

use super::findings::{Cause, Report};
use super::flow::{self, Set, State};
use super::syntax::{
    Content, Expr, ExprId, FunctionId, Literal, LiteralId, Notes, Oddity, Step, Symbol, index,
};
use super::variables::{Meaning, NotConstant, Variables, bits};
use crate::finding::Severity;
use crate::geometry::Pose;
use crate::geometry::units::DEG;
use crate::program::{
    Displacement, Frame, FrameId, Layout, Load, Move, Program, Shape, Shift, Source, Target,
    TargetId, Tool, ToolId,
};
use std::collections::HashMap;

/// Names and calls in turn that are followed.
const MOST_STEPS: usize = 12;
/// The name of every tool that `set_tcp` sets.
const TOOL: &str = "tcp";
/// The name of the frame of poses without a feature.
const BASE: &str = "base";

/// Where a move goes.
struct Goal {
    literal: LiteralId,
    name: Option<Symbol>,
    frame: FrameId,
    displacement: Displacement,
    near: Option<[f64; 6]>,
    /// The tool that the inverse is given, where it is not the one that is set.
    tool: Option<Result<Pose, ()>>,
    /// Why it has to stay as it is, and the place that says so.
    blocked: Vec<(Cause, u32)>,
}

/// What a move goes to that has no numbers.
struct NoGoal {
    cause: Cause,
    because: u32,
    name: Option<Symbol>,
}

/// Puts together one file.
pub struct Moves<'p, 's> {
    pub program: &'p mut Program,
    report: Report<'s>,
    file: u32,
    /// By literal.
    targets: Vec<Option<TargetId>>,
    tools: HashMap<([u64; 7], [u64; 4]), ToolId>,
    frames: HashMap<String, Vec<([u64; 7], FrameId)>>,
    unknown: HashMap<String, FrameId>,
}

impl<'p, 's> Moves<'p, 's> {
    pub fn new(program: &'p mut Program, source: &'s Source, file: usize) -> Self {
        Self {
            program,
            report: Report::new(source),
            file: index(file),
            targets: Vec::new(),
            tools: HashMap::new(),
            frames: HashMap::new(),
            unknown: HashMap::new(),
        }
    }

    /// Lists the moves of a file in their order.
    pub fn list(&mut self, notes: &Notes) {
        self.targets = vec![None; notes.literals.len()];
        let mut variables = Variables::new(notes);
        variables.targets = direct_targets(&variables);
        let variables = variables;
        let (first_target, first_finding) =
            (self.program.targets.len(), self.program.findings.len());
        let mut keys: HashMap<[u64; 7], u32> = HashMap::new();
        let mut poses: Vec<Pose> = Vec::new();
        let states = flow::states(notes, &mut |value, function| {
            let pose = variables.constant(value, function).ok()?;
            Some(*keys.entry(bits(&pose)).or_insert_with(|| {
                poses.push(pose);
                index(poses.len() - 1)
            }))
        });
        for (step, state) in notes.steps.iter().zip(&states) {
            self.step(&variables, step, state, &poses);
        }
        self.copies(&variables);
        for &(oddity, offset) in &notes.oddities {
            let (id, severity, message) = match oddity {
                Oddity::NoTarget => (
                    "motion-without-target",
                    Severity::Note,
                    "the robot moves by speed, force or hand here; this is not compensated",
                ),
                Oddity::MovingFrame => (
                    "moving-frame",
                    Severity::Error,
                    "moves along a conveyor, with a path offset or on a part that moves are not compensated",
                ),
            };
            self.report
                .say(self.program, id, severity, offset, message.into(), "");
        }
        self.sort(first_target, first_finding);
    }

    fn step(&mut self, variables: &Variables, step: &Step, state: &State, poses: &[Pose]) {
        let goal = self.goal(variables, step);
        let (target, frame, displacement, near, own_tool) = match goal {
            Ok(goal) => {
                let target = self.target(variables.notes, goal.literal, goal.name);
                for (cause, because) in goal.blocked {
                    self.report.block(self.program, target, cause, because);
                }
                (target, goal.frame, goal.displacement, goal.near, goal.tool)
            }
            Err(none) => {
                let name = none.name.map(|name| variables.notes.spelling(name).into());
                let target = self.program.targets.len();
                self.program.targets.push(Target {
                    name,
                    file: self.file,
                    offset: step.offset,
                    layout: Layout {
                        shape: Shape::Pose,
                        variant: 0,
                    },
                    numbers: 0..0,
                    blocked: true,
                });
                self.report
                    .block(self.program, target, none.cause, none.because);
                (target, self.base(), Displacement::None, None, None)
            }
        };
        let is_pose = self.program.targets[target].layout.shape == Shape::Pose;
        if step.streamed && is_pose && !self.program.targets[target].blocked {
            self.report
                .block(self.program, target, Cause::Streamed, step.offset);
        }
        let load = match state.load {
            Set::Value(load) => load,
            _ => None,
        };
        let tool = match (own_tool, state.tool) {
            (Some(Ok(pose)), _) => self.tool(Some(pose), load),
            (Some(Err(())), _) => self.several(target, step.offset, 0),
            (None, Set::Value(keyed)) => self.tool(poses.get(keyed.key as usize).copied(), load),
            (None, Set::Nothing | Set::Unreached) => self.tool(None, load),
            (None, Set::Several(a, b)) => {
                let because = if a == 0 { b } else { a };
                self.several(target, step.offset, because)
            }
        };
        self.program.moves.push(Move {
            file: self.file,
            offset: step.offset,
            motion: step.motion,
            target: Some(target),
            tool,
            frame,
            displacement,
            configured: false,
            near: near.map(Box::new),
            pace: crate::program::Pace::default(),
            ..Move::default()
        });
    }

    fn several(&mut self, target: TargetId, step: u32, because: u32) -> ToolId {
        if !self.program.targets[target].blocked {
            let because = if because == 0 { step } else { because };
            self.report
                .block(self.program, target, Cause::ToolSeveral, because);
        }
        self.tool(None, None)
    }

    fn tool(&mut self, pose: Option<Pose>, load: Option<Load>) -> ToolId {
        let of_pose = pose.as_ref().map_or([u64::MAX; 7], bits);
        let of_load = load.map_or([u64::MAX; 4], |load| {
            let [x, y, z] = load.cog_m;
            [load.mass_kg, x, y, z].map(f64::to_bits)
        });
        let tools = &mut self.program.tools;
        *self.tools.entry((of_pose, of_load)).or_insert_with(|| {
            tools.push(Tool {
                name: TOOL.into(),
                flange_from_tool: pose,
                load,
            });
            tools.len() - 1
        })
    }

    fn base(&mut self) -> FrameId {
        self.frame(BASE, Pose::identity())
    }

    fn frame(&mut self, name: &str, pose: Pose) -> FrameId {
        let key = bits(&pose);
        let known = self.frames.get(name).map_or(&[][..], Vec::as_slice);
        if let Some((_, id)) = known.iter().find(|(bits, _)| *bits == key) {
            return *id;
        }
        let id = self.program.frames.len();
        // a name has few values; more are only told apart by their places
        let known = self.frames.entry(name.into()).or_default();
        if known.len() < 16 {
            known.push((key, id));
        }
        self.program.frames.push(Frame {
            name: name.into(),
            world_from_frame: Some(pose),
        });
        id
    }

    fn unknown_frame(&mut self, name: String) -> FrameId {
        let frames = &mut self.program.frames;
        *self.unknown.entry(name.clone()).or_insert_with(|| {
            frames.push(Frame {
                name,
                world_from_frame: None,
            });
            frames.len() - 1
        })
    }

    /// The target of a literal.
    fn target(&mut self, notes: &Notes, id: LiteralId, name: Option<Symbol>) -> TargetId {
        if let Some(target) = self.targets[id as usize] {
            return target;
        }
        let literal = notes.literal(id);
        // the file's numbers follow those of the files before it
        let before = index(self.program.numbers.len());
        let target = self.program.targets.len();
        self.program.targets.push(Target {
            name: name.map(|name| notes.spelling(name).into()),
            file: self.file,
            offset: literal.offset,
            layout: Layout {
                shape: if literal.pose {
                    Shape::Pose
                } else {
                    Shape::Joints
                },
                variant: u8::from(literal.content == Content::Degrees),
            },
            numbers: before + literal.numbers.start..before + literal.numbers.end,
            blocked: literal.content == Content::Expressions,
        });
        self.targets[id as usize] = Some(target);
        target
    }

    /// Follows the target of a move to its numbers.
    fn goal(&mut self, variables: &Variables, step: &Step) -> Result<Goal, NoGoal> {
        let notes = variables.notes;
        let (mut value, mut function) = (step.target, step.function);
        let mut name = None;
        let mut frame: Option<(FrameId, Pose, String)> = None;
        let mut displacement = Displacement::None;
        let mut blocked = Vec::new();
        let (mut near, mut tool) = (None, None);
        let none = |cause, name| NoGoal {
            cause,
            because: step.offset,
            name,
        };
        for _ in 0..MOST_STEPS {
            match notes.expression(value) {
                Expr::Name(symbol) => {
                    name = Some(symbol);
                    match variables.meaning(symbol, function) {
                        Meaning::Value(next, within, _) => (value, function) = (next, within),
                        Meaning::Changing(next, within, again) => {
                            if !matches!(notes.expression(next), Expr::Literal(_)) {
                                return Err(NoGoal {
                                    because: again,
                                    ..none(Cause::Assigned, name)
                                });
                            }
                            blocked.push((Cause::Assigned, again));
                            (value, function) = (next, within);
                        }
                        Meaning::Parameter => return Err(none(Cause::Passed, name)),
                        Meaning::Unknown => return Err(none(Cause::NotInFile, name)),
                    }
                }
                Expr::Literal(id) => {
                    let literal = notes.literal(id);
                    if !literal.pose && literal.elements != 6 {
                        return Err(none(Cause::Computed, name));
                    }
                    if literal.content == Content::Expressions {
                        let cause = if literal.pose {
                            Cause::Expressions
                        } else {
                            Cause::JointExpressions
                        };
                        blocked.push((cause, literal.offset));
                    }
                    let frame = frame.map_or_else(|| self.base(), |(id, _, _)| id);
                    return Ok(Goal {
                        literal: id,
                        name,
                        frame,
                        displacement,
                        near,
                        tool,
                        blocked,
                    });
                }
                Expr::Kinematics {
                    pose,
                    near: seed,
                    tcp,
                } => {
                    near = near.or(seed.and_then(|seed| joints(variables, seed, function)));
                    tool =
                        tool.or(tcp.map(|tcp| variables.constant(tcp, function).map_err(|_| ())));
                    value = pose;
                }
                Expr::Trans(a, b) => {
                    if goes_to(variables, a, function, &variables.targets) {
                        displacement = match variables.constant(b, function) {
                            Ok(in_tool) if displacement == Displacement::None => {
                                Displacement::By(Box::new(Shift {
                                    in_frame_m: [0.0; 3],
                                    in_tool,
                                }))
                            }
                            _ => Displacement::Unknown,
                        };
                        self.offset_is_no_target(variables, b, function, &mut blocked);
                        value = a;
                        continue;
                    }
                    let around = frame.as_ref().map(|(_, pose, name)| (*pose, name.clone()));
                    frame = match self.feature(variables, a, function, around) {
                        Ok(found) => Some(found),
                        Err((cause, because)) => {
                            blocked.push((cause, because.unwrap_or(step.offset)));
                            Some((self.base(), Pose::identity(), BASE.into()))
                        }
                    };
                    name = None;
                    value = b;
                }
                Expr::Add(a, b) => {
                    displacement = match variables.constant(b, function) {
                        Ok(by) if displacement == Displacement::None => {
                            Displacement::By(Box::new(Shift {
                                in_frame_m: by.translation,
                                in_tool: Pose::from_rotation(by.rotation),
                            }))
                        }
                        _ => Displacement::Unknown,
                    };
                    self.offset_is_no_target(variables, b, function, &mut blocked);
                    value = a;
                }
                Expr::Inverse(_) | Expr::Other => return Err(none(Cause::Computed, name)),
            }
        }
        Err(none(Cause::Computed, name))
    }

    /// A pose that other moves go to may not be an offset here.
    fn offset_is_no_target(
        &mut self,
        variables: &Variables,
        offset: ExprId,
        function: FunctionId,
        blocked: &mut Vec<(Cause, u32)>,
    ) {
        if let (Expr::Literal(id), _, _) = variables.follow(offset, function)
            && variables.targets[id as usize]
        {
            let literal: &Literal = variables.notes.literal(id);
            blocked.push((Cause::Offset, literal.offset));
            let name = match variables.notes.expression(offset) {
                Expr::Name(name) => Some(name),
                _ => None,
            };
            let target = self.target(variables.notes, id, name);
            let at = literal.offset;
            self.report.block(self.program, target, Cause::Offset, at);
        }
    }

    /// The feature that a pose is given in, itself inside another where `around` is one.
    fn feature(
        &mut self,
        variables: &Variables,
        feature: ExprId,
        function: FunctionId,
        around: Option<(Pose, String)>,
    ) -> Result<(FrameId, Pose, String), (Cause, Option<u32>)> {
        let name = match variables.notes.expression(feature) {
            Expr::Name(name) => variables.notes.spelling(name),
            _ => "feature".into(),
        };
        match (variables.constant(feature, function), around) {
            (Ok(pose), None) => Ok((self.frame(&name, pose), pose, name)),
            (Ok(pose), Some((outer, before))) => {
                let name = format!("{before}.{name}");
                let pose = outer * pose;
                Ok((self.frame(&name, pose), pose, name))
            }
            (Err(NotConstant::Unknown(_)), None) => {
                let id = self.unknown_frame(name.clone());
                Ok((id, Pose::identity(), name))
            }
            (Err(NotConstant::Assigned(again)), _) => Err((Cause::FrameAssigned, Some(again))),
            (Err(_), _) => Err((Cause::FrameComputed, None)),
        }
    }

    /// Variables that are computed from targets.
    fn copies(&mut self, variables: &Variables) {
        let notes = variables.notes;
        let mut said = std::collections::HashSet::new();
        for &(name, function, offset) in &notes.mentions {
            let Meaning::Value(value, _, _) = variables.meaning(name, function) else {
                continue;
            };
            let Expr::Literal(id) = notes.expression(value) else {
                continue;
            };
            let Some(target) = self.targets[id as usize] else {
                continue;
            };
            let target = &self.program.targets[target];
            if target.blocked || target.layout.shape == Shape::Joints || !said.insert((id, offset))
            {
                continue;
            }
            let message = format!(
                "a value is computed from `{}`, whose numbers change",
                notes.spelling(name)
            );
            let hint = "look where the new value is used";
            self.report.say(
                self.program,
                "target-copied",
                Severity::Warning,
                offset,
                message,
                hint,
            );
        }
    }

    /// Targets, moves and findings of this file by place.
    fn sort(&mut self, first_target: usize, first_finding: usize) {
        let targets = &mut self.program.targets[first_target..];
        if !targets.is_sorted_by_key(|target| target.offset) {
            let mut order: Vec<usize> = (0..targets.len()).collect();
            order.sort_by_key(|&at| targets[at].offset);
            let mut place = vec![0; targets.len()];
            for (new, &old) in order.iter().enumerate() {
                place[old] = new;
            }
            for motion in &mut self.program.moves {
                if motion.file == self.file {
                    motion.target = motion
                        .target
                        .map(|t| first_target + place[t - first_target]);
                }
            }
            for at in 0..targets.len() {
                while place[at] != at {
                    let to = place[at];
                    targets.swap(at, to);
                    place.swap(at, to);
                }
            }
        }
        let file = self.file;
        let first_move = self
            .program
            .moves
            .partition_point(|motion| motion.file < file);
        self.program.moves[first_move..].sort_by_key(|motion| motion.offset);
        self.program.findings[first_finding..]
            .sort_by_key(|finding| (finding.line, finding.column, finding.id));
    }
}

/// Which literals are where moves go, not features or offsets.
fn direct_targets(variables: &Variables) -> Vec<bool> {
    let notes = variables.notes;
    let mut direct = vec![false; notes.literals.len()];
    // what `pose_trans(a, b)` goes to depends on whether others go to a
    for through_features in [false, true, true, true] {
        let mut changed = false;
        for step in &notes.steps {
            let (mut value, mut function) = (step.target, step.function);
            for _ in 0..MOST_STEPS {
                let (expression, _, within) = variables.follow(value, function);
                function = within;
                match expression {
                    Expr::Kinematics { pose, .. } => value = pose,
                    Expr::Trans(a, b)
                        if through_features && !goes_to(variables, a, function, &direct) =>
                    {
                        value = b;
                    }
                    Expr::Add(a, _) if through_features => value = a,
                    Expr::Literal(id) => {
                        changed |= !std::mem::replace(&mut direct[id as usize], true);
                        break;
                    }
                    _ => break,
                }
            }
        }
        if through_features && !changed {
            break;
        }
    }
    direct
}

/// Whether a value is, by names alone, a literal that moves go to.
fn goes_to(variables: &Variables, value: ExprId, function: FunctionId, direct: &[bool]) -> bool {
    match variables.follow(value, function).0 {
        Expr::Literal(id) => direct[id as usize],
        _ => false,
    }
}

/// Six joint angles that the text tells, radians.
fn joints(variables: &Variables, value: ExprId, function: FunctionId) -> Option<[f64; 6]> {
    let Expr::Literal(id) = variables.follow(value, function).0 else {
        return None;
    };
    let literal = variables.notes.literal(id);
    let values = variables.notes.values(literal).filter(|_| !literal.pose)?;
    let unit = if literal.content == Content::Degrees {
        DEG
    } else {
        1.0
    };
    Some(values.map(|value| value * unit))
}
