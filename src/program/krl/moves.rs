//! Moves and the targets they go to.

use super::findings::{Cause, Report};
use super::flow::Flows;
use super::notes::{
    Action, DataKind, Flaw, Index, Operand, Path, Point, Statement, Stored, indices,
};
use super::places::{HERE, Places, pose_of};
use super::state::{BASE, IPO, Slot, State, States, TOOL};
use super::tokens::Place;
use super::world::{Lead, World};
use crate::finding::Severity;
use crate::geometry::Pose;
use crate::geometry::units::m_from_mm;
use crate::program::rapid::names::{Context, Symbol};
use crate::program::{Displacement, Frame, Motion, Move, Shape, Shift, TargetId, Tool};
use std::collections::HashSet;

/// Moves that are listed at most; beyond, elements of arrays are listed once.
const MOST_MOVES: usize = 20_000_000;

/// Lists all moves.
pub struct Moves<'a, 's> {
    world: &'a World,
    pub report: Report<'s>,
    places: Places<'a>,
    /// Targets that moves go to, or that are handed on.
    pub kept: Vec<bool>,
    /// The target that the robot is at.
    last: Option<(TargetId, usize, usize, Shift)>,
    /// Arrays that were used with an index that only the running program knows.
    listed: HashSet<Listed>,
    called: HashSet<Symbol>,
}

/// Module and name of an array, tool and base, and whether the joints are interpolated.
type Listed = (u32, Symbol, Option<(usize, usize)>, bool);

/// How a move goes to all its targets.
struct With {
    path: Path,
    motion: Motion,
    state: State,
    displacement: Displacement,
}

impl<'a, 's> Moves<'a, 's> {
    pub fn new(world: &'a World, mut report: Report<'s>, flows: Flows) -> (Self, States) {
        let Flows { settings, at } = flows;
        let used = world.notes.statements.iter().zip(at.iter());
        let used = used.filter_map(|(statement, state)| match statement.action {
            Action::Move { points, .. } => {
                let mut points = world.notes.points[indices(points)].iter();
                let context = world.context(statement);
                let to_pose = points.any(|point| goes_to_pose(world, *point, context));
                let State(slots) = state?;
                to_pose.then_some([slots[TOOL], slots[BASE], slots[IPO]])
            }
            _ => None,
        });
        let places = Places::new(world, settings, used);
        report.program.targets.clone_from(&world.notes.targets);
        let moves = Self {
            kept: vec![false; world.notes.targets.len()],
            world,
            report,
            places,
            last: None,
            listed: HashSet::new(),
            called: HashSet::new(),
        };
        (moves, at)
    }

    /// Goes through all statements.
    pub fn list(&mut self, at: &States) {
        let world = self.world;
        let mut routine = u32::MAX;
        for (statement, state) in world.notes.statements.iter().zip(at.iter()) {
            if statement.routine != routine || World::is_crossing(statement) {
                routine = statement.routine;
                self.last = None;
            }
            match (statement.action, state) {
                (Action::Move { path, points, .. }, Some(state)) => {
                    let points = indices(points);
                    for at in points.clone() {
                        let motion = match path {
                            Path::Joint => Motion::Joint,
                            Path::Linear => Motion::Linear,
                            Path::Arc if at == points.start && points.len() == 2 => Motion::ArcVia,
                            Path::Arc => Motion::ArcEnd,
                        };
                        let with = With {
                            path,
                            motion,
                            state,
                            displacement: Displacement::None,
                        };
                        self.go(statement, world.notes.points[at], with);
                    }
                }
                (Action::Relative { path, axes, by }, Some(state)) => {
                    let by = by.map(|by| world.notes.offsets[by as usize]);
                    self.relative(statement, path, axes, by, state);
                }
                (Action::Call(_), _) => self.last = None,
                _ => {}
            }
        }
        for (target, place) in std::mem::take(&mut self.places.frames) {
            self.report
                .block(target, Cause::UsedAsFrame, place, "its declaration");
        }
    }

    fn go(&mut self, statement: &Statement, point: Point, with: With) {
        self.last = None;
        match point {
            Point::Present => {}
            Point::Computed => self.computed(statement, "the position"),
            Point::Inline(target) => self.use_target(statement, target, with),
            Point::Named(name, index) => self.use_name(statement, name, index, &with),
            Point::Product(part) => self.product(statement, indices(part), with),
        }
    }

    fn computed(&mut self, statement: &Statement, what: &str) {
        let message = format!(
            "{what} that this move goes to is known at run time only; it is not compensated"
        );
        let (id, severity) = ("computed-target", Severity::Error);
        let hint = "write the target with numbers";
        self.report
            .say(id, severity, statement.place, message, hint);
    }

    fn use_name(&mut self, statement: &Statement, name: Symbol, index: Index, with: &With) {
        let world = self.world;
        let context = world.context(statement);
        let spelled = world.notes.symbols.spelling(name);
        match world.lead(name, index, context) {
            Lead::Values { first, last, .. } => {
                let is_one = last - first == 1;
                if !is_one && !self.first_use(name, with, statement) {
                    return;
                }
                for at in first..last {
                    match world.value(at).1 {
                        Stored::Target(target) => {
                            let with = With {
                                displacement: with.displacement.clone(),
                                ..*with
                            };
                            self.use_target(statement, target, with);
                        }
                        _ => self.computed(statement, spelled),
                    }
                }
                if !is_one {
                    self.last = None;
                }
            }
            Lead::Empty(datum) => self.empty(statement, datum, spelled),
            Lead::Ambiguous => {
                self.block_name(
                    name,
                    index,
                    context,
                    Cause::Ambiguous,
                    statement.place,
                    spelled,
                );
                self.computed(statement, spelled);
            }
            Lead::Unknown if is_home(spelled) => self.home(statement, spelled),
            Lead::Unknown => {
                let message =
                    format!("{spelled} is not declared in the files; this move is not compensated");
                let hint = "give the .dat file or the $config.dat that declares it, too";
                let id = "target-not-in-files";
                self.report
                    .say(id, Severity::Error, statement.place, message, hint);
            }
        }
    }

    fn empty(&mut self, statement: &Statement, datum: u32, spelled: &str) {
        let declared = self.world.declared(datum);
        if declared.kind == DataKind::Axes && !self.world.is_assigned(datum) {
            self.home(statement, spelled);
        } else {
            self.computed(statement, spelled);
        }
    }

    /// A joint target without numbers in the files.
    fn home(&mut self, statement: &Statement, spelled: &str) {
        let message = format!("{spelled} has no value in the files; as a joint target it stays");
        let hint = "give the $config.dat that declares it, too, to see it checked";
        let id = "joint-target-not-in-files";
        self.report
            .say(id, Severity::Note, statement.place, message, hint);
    }

    /// Whether an array was not used in this way before.
    fn first_use(&mut self, name: Symbol, with: &With, statement: &Statement) -> bool {
        let State(slots) = with.state;
        let tool = self.places.tool(slots[TOOL], &mut self.report.program);
        let base = self.places.base(slots[BASE], &mut self.report.program);
        let both = tool.ok().zip(base.ok());
        let key = (
            self.world.notes.routines[statement.routine as usize].module,
            name,
            both,
            with.motion == Motion::Joint,
        );
        with.displacement == Displacement::None
            && self.report.program.moves.len() < MOST_MOVES
            && self.listed.insert(key)
            || with.displacement != Displacement::None && self.called.insert(name)
    }

    /// Blocks every target that a name may lead to, and keeps it.
    pub fn block_name(
        &mut self,
        name: Symbol,
        index: Index,
        context: Context,
        cause: Cause,
        because: Place,
        what: &str,
    ) -> bool {
        let world = self.world;
        let mut any = false;
        for datum in world.candidates(name, context) {
            let whole = if index == Index::Whole {
                Index::Variable
            } else {
                index
            };
            let (first, last) = world.range(datum, whole);
            for at in first..last {
                if let Stored::Target(target) = world.value(at).1 {
                    self.report.block(target, cause, because, what);
                    any = true;
                    if matches!(cause, Cause::Ambiguous) {
                        self.kept[target] = true;
                    }
                }
            }
        }
        any
    }

    /// `a : b : c`: the one operand that is a position is the target, the others displace it.
    fn product(&mut self, statement: &Statement, part: std::ops::Range<usize>, mut with: With) {
        let world = self.world;
        let context = world.context(statement);
        let operands = &world.notes.operands[part];
        let is_position = |operand: &Operand| match *operand {
            Operand::Named(name, _) => world.kind(name, context) == Some(DataKind::Position),
            _ => false,
        };
        let mut positions = (0..operands.len()).filter(|&at| is_position(&operands[at]));
        let (Some(at), None) = (positions.next(), positions.next()) else {
            self.computed(statement, "the product of frames");
            return;
        };
        with.displacement = self
            .shift(operands, at, context)
            .map_or(Displacement::Unknown, |shift| {
                Displacement::By(Box::new(shift))
            });
        if let Operand::Named(name, index) = operands[at] {
            self.use_name(statement, name, index, &with);
            self.last = None;
        }
    }

    /// What the operands beside the target add, where that is a motion of the tool or a translation in the base.
    fn shift(&self, operands: &[Operand], at: usize, context: Context) -> Option<Shift> {
        let product = |operands: &[Operand]| {
            let mut pose = Pose::identity();
            for operand in operands {
                pose = pose * self.constant(*operand, context)?;
            }
            Some(pose)
        };
        let before = product(&operands[..at])?;
        let in_tool = product(&operands[at + 1..])?;
        let in_frame_m = before.translation;
        (before.rotation.angle() < 1e-12).then_some(Shift {
            in_frame_m,
            in_tool,
        })
    }

    /// A frame that no statement changes.
    fn constant(&self, operand: Operand, context: Context) -> Option<Pose> {
        let world = self.world;
        let target = match operand {
            Operand::Inline(target) => target,
            Operand::Named(name, index) => {
                let datum = world.datum(name, context)?.ok()?;
                match world.one(datum, index)? {
                    Stored::Target(target) if !world.is_assigned(datum) => target,
                    _ => return None,
                }
            }
            Operand::Other => return None,
        };
        let range = world.notes.targets[target].numbers.clone();
        let numbers = &world.notes.numbers[range.start as usize..range.end as usize];
        let is_pose = world.notes.targets[target].layout.shape == Shape::Pose;
        (is_pose && numbers.len() >= 6).then(|| pose_of(std::array::from_fn(|i| numbers[i].value)))
    }

    fn use_target(&mut self, statement: &Statement, target: TargetId, with: With) {
        self.kept[target] = true;
        let is_joints = self.world.notes.targets[target].layout.shape == Shape::Joints;
        let State(slots) = with.state;
        let program = &mut self.report.program;
        let tool = self.places.tool(slots[TOOL], program);
        let base = self.places.base(slots[BASE], program);
        let mode = self.places.mode(slots[IPO]);
        let mut ids = [0; 2];
        let mut is_blocked = false;
        for (id, used) in ids.iter_mut().zip([tool, base]) {
            match used {
                Ok(found) => *id = found,
                // axes stay as they are, whatever the tool
                Err(_) if is_joints => is_blocked = true,
                Err((cause, place, what)) => {
                    is_blocked = true;
                    self.block(target, cause, place, &what, statement);
                }
            }
        }
        if let (Err((cause, place, what)), false) = (mode, is_joints) {
            is_blocked = true;
            self.block(target, cause, place, &what, statement);
        }
        if is_blocked && !is_joints {
            return;
        }
        if is_blocked {
            // a joint target without a known tool cannot be corrected, only kept
            ids = self.nothing_known(&slots);
        }
        let [tool, frame] = ids;
        if with.displacement == Displacement::None && !is_joints {
            self.last = Some((target, tool, frame, Shift::in_frame([0.0; 3])));
        }
        self.push(statement, target, tool, frame, with);
    }

    fn push(
        &mut self,
        statement: &Statement,
        target: TargetId,
        tool: usize,
        frame: usize,
        with: With,
    ) {
        self.report.program.moves.push(Move {
            file: statement.place.file,
            offset: statement.place.offset,
            motion: with.motion,
            target: Some(target),
            tool,
            frame,
            displacement: with.displacement,
            configured: with.path == Path::Joint,
            near: None,
            pace: crate::program::Pace::default(),
            ..Move::default()
        });
    }

    /// Tool and frame that are asked for by the names of the controller's variables.
    fn nothing_known(&mut self, slots: &[Slot; 4]) -> [usize; 2] {
        let program = &mut self.report.program;
        let tool = self.places.tool(slots[TOOL], program).unwrap_or_else(|_| {
            let mut tools = program.tools.iter();
            let known =
                tools.position(|tool| tool.name == "$TOOL" && tool.flange_from_tool.is_none());
            known.unwrap_or_else(|| {
                program.tools.push(Tool {
                    name: "$TOOL".into(),
                    flange_from_tool: None,
                    load: None,
                });
                program.tools.len() - 1
            })
        });
        let frame = self.places.base(slots[BASE], program).unwrap_or_else(|_| {
            let mut frames = program.frames.iter();
            let known =
                frames.position(|frame| frame.name == "$BASE" && frame.world_from_frame.is_none());
            known.unwrap_or_else(|| {
                program.frames.push(Frame {
                    name: "$BASE".into(),
                    world_from_frame: None,
                });
                program.frames.len() - 1
            })
        });
        [tool, frame]
    }

    fn block(
        &mut self,
        target: TargetId,
        cause: Cause,
        place: Place,
        what: &str,
        statement: &Statement,
    ) {
        // no place of its own: the move itself
        let (place, what) = if place == HERE {
            (statement.place, "")
        } else {
            (place, what)
        };
        self.report.block(target, cause, place, what);
    }

    /// A move by so much from where the robot is.
    fn relative(
        &mut self,
        statement: &Statement,
        path: Path,
        axes: bool,
        by: Option<([f64; 3], bool)>,
        State(slots): State,
    ) {
        let last = self.last.take();
        let place = statement.place;
        if axes {
            let message =
                "this move turns axes from where the robot is; it is left as it is".to_owned();
            let id = "relative-joint-move";
            self.report.say(id, Severity::Note, place, message, "");
            return;
        }
        let program = &mut self.report.program;
        let tool = self.places.tool(slots[TOOL], program).ok();
        let frame = self.places.base(slots[BASE], program).ok();
        if let (Some((target, last_tool, last_frame, mut shift)), Some((by, in_tool))) = (last, by)
            && (tool, frame) == (Some(last_tool), Some(last_frame))
        {
            let [x, y, z] = by.map(m_from_mm);
            if in_tool {
                shift.in_tool = shift.in_tool * Pose::from_translation(x, y, z);
            } else {
                let [a, b, c] = shift.in_frame_m;
                shift.in_frame_m = [a + x, b + y, c + z];
            }
            let motion = match path {
                Path::Joint => Motion::Joint,
                _ => Motion::Linear,
            };
            let with = With {
                path,
                motion,
                state: State(slots),
                displacement: Displacement::By(Box::new(shift)),
            };
            self.push(statement, target, last_tool, last_frame, with);
            self.last = Some((target, last_tool, last_frame, shift));
            return;
        }
        let message = "this move goes relative to a position that the text does not tell; it is not compensated";
        let hint = "write the target, or put the move behind one to a known target";
        let id = "relative-move";
        self.report
            .say(id, Severity::Error, place, message.to_owned(), hint);
    }

    /// Says what is wrong with targets that stand in the text.
    pub fn flaws(&mut self) {
        for &(target, flaw) in &self.world.notes.flaws {
            let found = &self.world.notes.targets[target];
            let place = Place {
                file: found.file,
                offset: found.offset,
            };
            let cause = match flaw {
                Flaw::Partial => Cause::Partial,
                Flaw::Computed => Cause::Computed,
            };
            self.report.block(target, cause, place, "");
        }
    }
}

/// Names that every controller has for a joint target in its $config.dat.
fn is_home(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    let rest = name.strip_prefix("xhome").or(name.strip_prefix("home"));
    rest.is_some_and(|rest| rest.bytes().all(|b| b.is_ascii_digit()))
}

fn goes_to_pose(world: &World, point: Point, context: Context) -> bool {
    match point {
        Point::Inline(target) => world.notes.targets[target].layout.shape == Shape::Pose,
        Point::Named(name, _) => matches!(
            world.kind(name, context),
            Some(DataKind::Position | DataKind::Frame)
        ),
        Point::Product(_) => true,
        Point::Present | Point::Computed => false,
    }
}
