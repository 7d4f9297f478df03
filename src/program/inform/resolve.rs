//! Puts jobs and condition files together: which positions are targets, and which moves go to them.
//!
//! Targets are the positions that moves go to; others (shift amounts, results of searches, reference points) are data.

use super::cnd::Conditions;
use super::findings::{Cause, Place, Report, place};
use super::instruction::{Event, Kind, Operand};
use super::job::{Coordinates, Job, Letter, Origin, Point};
use super::lines::index;
use super::{DEGREES, PULSES, shift};
use crate::finding::Severity;
use crate::geometry::Pose;
use crate::program::{
    Displacement, Frame, FrameId, Layout, Motion, Move, Number, Program, Settings, Shape, Source,
    Target, TargetId, Tool, ToolId,
};
use std::collections::HashMap;

/// Name of the tool of positions that tell none.
const NO_TOOL: &str = "none";

/// The program of all files.
pub fn resolve(
    sources: &[Source],
    mut jobs: Vec<Job>,
    conditions: &Conditions,
    settings: &Settings,
) -> Program {
    let variables = variables(&jobs);
    let mut report = Report::new(sources);
    report.program.numbers = all_numbers(&mut jobs);
    let jobs = &jobs[..];
    let mut resolver = Resolver {
        jobs,
        conditions,
        variables,
        changes: Changes::of(jobs),
        targets: jobs
            .iter()
            .map(|job| vec![None; job.points.len()])
            .collect(),
        tools: HashMap::new(),
        frames: HashMap::new(),
        report,
    };
    let usable = |pulses: &[f64; 6]| pulses.iter().all(|p| p.is_finite() && *p != 0.0);
    resolver.list_targets(settings.pulses_per_deg.as_ref().is_some_and(usable));
    let shifted = shift::active(jobs);
    for (index, job) in jobs.iter().enumerate() {
        resolver.list_moves(index, &shifted[index]);
        resolver.check_count(job);
    }
    resolver.report_copies();
    resolver.report.finish()
}

/// The numbers of all positions of all jobs; targets are ranges of them.
fn all_numbers(jobs: &mut [Job]) -> Vec<Number> {
    let mut all = Vec::new();
    for job in jobs {
        job.numbers_start = index(all.len());
        let mut numbers = std::mem::take(&mut job.numbers);
        if all.is_empty() {
            all = numbers;
        } else {
            all.append(&mut numbers);
        }
    }
    all
}

/// The position of a P variable: job and index where it stands first, the other places, and whether files agree on it.
struct Variable {
    job: usize,
    point: u32,
    copies: Vec<(usize, u32)>,
    agreed: bool,
}

impl Variable {
    /// Job and index of every place.
    fn places(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let first = std::iter::once((self.job, self.point));
        let all = first.chain(self.copies.iter().copied());
        all.map(|(job, point)| (job, point as usize))
    }
}

fn variables(jobs: &[Job]) -> HashMap<u32, Variable> {
    let mut found: HashMap<u32, Variable> = HashMap::new();
    for (index, job) in jobs.iter().enumerate() {
        for (&(letter, number), &point) in &job.named {
            if letter != Letter::P {
                continue;
            }
            let here = Variable {
                job: index,
                point,
                copies: Vec::new(),
                agreed: true,
            };
            let known = found.entry(number).or_insert(here);
            if known.job != index {
                known.copies.push((index, point));
            }
            let (first, other) = (
                &jobs[known.job].points[known.point as usize],
                &job.points[point as usize],
            );
            known.agreed &= same(&jobs[known.job], first, job, other);
        }
    }
    found
}

fn same(a_job: &Job, a: &Point, b_job: &Job, b: &Point) -> bool {
    let values = |job: &Job, point: &Point| -> Vec<f64> {
        let (start, end) = point.numbers;
        let numbers = &job.numbers[start as usize..end as usize];
        numbers.iter().map(|n| n.value).collect()
    };
    let header = |point: &Point| (point.coordinates, point.tool, point.origin, point.variant);
    header(a) == header(b) && values(a_job, a) == values(b_job, b)
}

/// What the running jobs change, and where; `None` stands for any number.
#[derive(Default)]
struct Changes {
    variables: HashMap<Option<u32>, Place>,
    frames: HashMap<Option<u32>, Place>,
    tools: HashMap<Option<u32>, Place>,
}

impl Changes {
    fn of(jobs: &[Job]) -> Self {
        let mut changes = Self::default();
        for job in jobs {
            for event in &job.events {
                let (kind, number, offset) = match *event {
                    Event::Assign { offset, operand } => match operand {
                        Operand::P(number) => (&mut changes.variables, Some(number), offset),
                        Operand::Computed => (&mut changes.variables, None, offset),
                        Operand::C(_) => continue,
                    },
                    Event::SetFrame { offset, number } => (&mut changes.frames, number, offset),
                    Event::SetTool { offset, number } => (&mut changes.tools, number, offset),
                    _ => continue,
                };
                kind.entry(number)
                    .or_insert_with(|| place(job.file as usize, offset));
            }
        }
        changes
    }
}

/// Where something of this number is changed.
fn changed(changes: &HashMap<Option<u32>, Place>, number: u32) -> Option<Place> {
    let named = changes.get(&Some(number));
    named.or_else(|| changes.get(&None)).copied()
}

struct Resolver<'a> {
    jobs: &'a [Job<'a>],
    conditions: &'a Conditions,
    variables: HashMap<u32, Variable>,
    changes: Changes,
    /// The target of each position of each job, where it is one.
    targets: Vec<Vec<Option<TargetId>>>,
    tools: HashMap<Option<u32>, ToolId>,
    frames: HashMap<Origin, FrameId>,
    report: Report<'a>,
}

impl Resolver<'_> {
    /// Job and position that an operand of a job names.
    fn point(&self, job: usize, operand: Operand) -> Result<(usize, usize), Cause> {
        let (letter, number) = match operand {
            Operand::C(number) => (Letter::C, number),
            Operand::P(number) => (Letter::P, number),
            Operand::Computed => return Err(Cause::Computed),
        };
        if let Some(&point) = self.jobs[job].named.get(&(letter, number)) {
            return Ok((job, point as usize));
        }
        let elsewhere = self.variables.get(&number).filter(|_| letter == Letter::P);
        elsewhere
            .map(|variable| (variable.job, variable.point as usize))
            .ok_or(Cause::NotInFiles)
    }

    /// Every place of a P variable: whichever job is loaded last sets it.
    fn places_of(&self, operand: Operand) -> impl Iterator<Item = (usize, usize)> + '_ {
        let variable = match operand {
            Operand::P(number) => self.variables.get(&number),
            Operand::C(_) | Operand::Computed => None,
        };
        variable.into_iter().flat_map(Variable::places)
    }

    /// Makes targets of the positions that moves go to, in the order of the text.
    fn list_targets(&mut self, pulses_known: bool) {
        let mut used: Vec<Vec<bool>> = self
            .jobs
            .iter()
            .map(|job| vec![false; job.points.len()])
            .collect();
        for (index, job) in self.jobs.iter().enumerate() {
            for event in &job.events {
                if let Event::Move { kind, operand, .. } = *event
                    && kind != Kind::Incremental
                    && let Ok((job, point)) = self.point(index, operand)
                {
                    used[job][point] = true;
                    for (job, point) in self.places_of(operand) {
                        used[job][point] = true;
                    }
                }
            }
        }
        for (index, used) in used.iter().enumerate() {
            let mut unknown_pulses: Option<u32> = None;
            let (mut variables, job) = (0, &self.jobs[index]);
            for (at, point) in job.points.iter().enumerate().filter(|(at, _)| used[*at]) {
                let is_blind = point.coordinates == Coordinates::Pulses && !pulses_known;
                let target = self.push(job, point, is_blind);
                self.targets[index][at] = Some(target);
                if is_blind {
                    unknown_pulses.get_or_insert(point.offset);
                }
                variables += usize::from(point.letter == Letter::P);
                self.check(job, point, target);
            }
            if let Some(offset) = unknown_pulses {
                self.report
                    .refuse(Cause::Pulses, place(job.file as usize, offset));
            }
            if variables > 0 {
                let message = format!(
                    "moves go to {variables} position variable(s) of this job; other jobs of the controller may change them"
                );
                let hint = "make sure that only the jobs given here set them";
                let at = place(job.file as usize, job.offset);
                self.report
                    .say("position-variable", Severity::Note, at, message, hint);
            }
        }
    }

    fn push(&mut self, job: &Job, point: &Point, is_blind: bool) -> TargetId {
        let program = &mut self.report.program;
        let (from, to) = point.numbers;
        let complete = match point.coordinates {
            Coordinates::Rectangular => true,
            Coordinates::Pulses | Coordinates::Degrees => to - from == 6,
        };
        let start = job.numbers_start + from;
        let count = if complete && !is_blind { 6 } else { 0 };
        let (shape, variant) = match point.coordinates {
            Coordinates::Rectangular if job.mixes_rconf => (Shape::Pose, 0),
            Coordinates::Rectangular => (Shape::Pose, point.variant),
            Coordinates::Pulses => (Shape::Joints, PULSES),
            Coordinates::Degrees => (Shape::Joints, DEGREES),
        };
        let name = match point.letter {
            Letter::C => format!("C{:05}", point.number),
            Letter::P => format!("P{:03}", point.number),
        };
        program.targets.push(Target {
            name: Some(name.into()),
            file: job.file,
            offset: point.offset,
            layout: Layout { shape, variant },
            numbers: start..start + count,
            blocked: is_blind,
        });
        let target = program.targets.len() - 1;
        if !complete {
            self.report.block(target, Cause::AxisCount, None);
        }
        target
    }

    /// Blocks a target for what its own lines or changes at run time say.
    fn check(&mut self, job: &Job, point: &Point, target: TargetId) {
        let report = &mut self.report;
        if job.twice.contains(&(point.letter, point.number)) {
            report.block(target, Cause::Ambiguous, None);
        }
        if point.letter == Letter::P {
            if let Some(because) = changed(&self.changes.variables, point.number) {
                report.block(target, Cause::Assigned, Some(because));
            }
            if let Some(variable) = self.variables.get(&point.number).filter(|v| !v.agreed) {
                let first = &self.jobs[variable.job];
                let offset = first.points[variable.point as usize].offset;
                let because = place(first.file as usize, offset);
                report.block(target, Cause::Ambiguous, Some(because));
            }
        }
        if let Some(because) = point.tool.and_then(|n| changed(&self.changes.tools, n)) {
            report.block(target, Cause::FrameAssigned, Some(because));
        }
        if point.coordinates != Coordinates::Rectangular {
            return;
        }
        match point.origin {
            Origin::Base | Origin::Robot => {}
            Origin::User(number) => {
                if let Some(because) = changed(&self.changes.frames, number) {
                    report.block(target, Cause::FrameAssigned, Some(because));
                }
            }
            Origin::Tool => report.block(target, Cause::ToolCoordinates, None),
            Origin::Unknown => report.block(target, Cause::FrameNotNamed, None),
        }
    }

    /// Lists the moves of one job; `shifted` tells for each event whether a shift may be on.
    fn list_moves(&mut self, index: usize, shifted: &[bool]) {
        let job = &self.jobs[index];
        let mut arc = Arc::default();
        let (mut is_first, mut said) = (true, false);
        for (at, event) in job.events.iter().enumerate() {
            let (offset, kind, operand, base) = match *event {
                Event::Move {
                    offset,
                    kind,
                    operand,
                    base,
                } => (offset, kind, operand, base),
                Event::BlindMove { offset } => {
                    self.end_arc(&mut arc);
                    self.report
                        .refuse(Cause::OtherMove, place(job.file as usize, offset));
                    continue;
                }
                _ => continue,
            };
            if kind != Kind::Circular {
                self.end_arc(&mut arc);
            }
            let here = place(job.file as usize, offset);
            if kind == Kind::Incremental {
                self.report.refuse(Cause::Incremental, here);
                continue;
            }
            let (owner, point) = match self.point(index, operand) {
                Ok(found) => found,
                Err(cause) => {
                    self.report.refuse(cause, here);
                    continue;
                }
            };
            let is_shifted = shifted.get(at) == Some(&true);
            let copies: Vec<(usize, usize)> = self
                .places_of(operand)
                .filter(|copy| *copy != (owner, point))
                .collect();
            for &(owner, point) in copies.iter().chain([&(owner, point)]) {
                let target = self.target(owner, point);
                let point = &self.jobs[owner].points[point];
                if let Some(cause) = cause_of(kind) {
                    self.report.block(target, cause, Some(here));
                }
                if is_shifted {
                    self.report.block(target, Cause::Shifted, Some(here));
                }
                if point.coordinates == Coordinates::Rectangular
                    && point.origin != Origin::Robot
                    && base.is_some_and(|base| job.base_moved.get(&base) != Some(&false))
                {
                    self.report.block(target, Cause::BaseAxis, Some(here));
                }
            }
            let target = self.target(owner, point);
            let point = &self.jobs[owner].points[point];
            let motion = match kind {
                Kind::Joint => Motion::Joint,
                Kind::Circular => {
                    arc.points += 1;
                    arc.last = self.report.program.moves.len();
                    match arc.points {
                        1 => Motion::Linear,
                        n if n % 2 == 0 => Motion::ArcVia,
                        _ => Motion::ArcEnd,
                    }
                }
                _ => Motion::Linear,
            };
            let (tool, frame) = (self.tool(point.tool), self.frame(point));
            let is_rectangular = point.coordinates == Coordinates::Rectangular;
            if std::mem::take(&mut is_first) && is_rectangular {
                let message = "the job starts with a rectangular position, and the flip of RCONF is not used: the solution \
                               with the joints nearest to zero is taken";
                let hint = "start with a joint position (PULSE or ANGLE)";
                let id = "wrist-not-told";
                self.report
                    .say(id, Severity::Warning, here, message.to_owned(), hint);
            }
            let is_mixed = self.jobs[owner].mixes_rconf && point.variant != 0;
            if kind == Kind::Joint && is_rectangular && is_mixed && !said {
                said = true;
                let message =
                    "the post that wrote this job mixes the fields of RCONF up: it is not used";
                let hint = "check the configuration of the joint moves on the robot";
                let id = "rconf-of-post";
                self.report
                    .say(id, Severity::Warning, here, message.to_owned(), hint);
            }
            let mut used = Move {
                file: job.file,
                offset,
                motion,
                target: Some(target),
                tool,
                frame,
                displacement: if is_shifted {
                    Displacement::Unknown
                } else {
                    Displacement::None
                },
                configured: kind == Kind::Joint,
                near: None,
                pace: crate::program::Pace::default(),
                ..Move::default()
            };
            self.report.program.moves.push(used.clone());
            // the same variable elsewhere stands for the same point: the robot is there already
            used.configured = false;
            if kind == Kind::Circular {
                used.motion = Motion::Linear;
            }
            for (owner, point) in copies {
                let target = self.target(owner, point);
                let moves = &mut self.report.program.moves;
                moves.push(Move {
                    target: Some(target),
                    ..used.clone()
                });
            }
        }
        self.end_arc(&mut arc);
    }

    /// The target of a position that a move goes to.
    fn target(&self, job: usize, point: usize) -> TargetId {
        self.targets[job][point].expect("a target for each position that moves go to")
    }

    /// The last point of an arc is its end.
    fn end_arc(&mut self, arc: &mut Arc) {
        if arc.points > 1 {
            self.report.program.moves[arc.last].motion = Motion::ArcEnd;
        }
        *arc = Arc::default();
    }

    fn tool(&mut self, number: Option<u32>) -> ToolId {
        let tools = &mut self.report.program.tools;
        *self.tools.entry(number).or_insert_with(|| {
            let known = number.and_then(|n| self.conditions.tools.get(&n).copied().flatten());
            tools.push(Tool {
                name: number.map_or_else(|| NO_TOOL.to_owned(), |n| n.to_string()),
                flange_from_tool: known.map(|(pose, _)| pose),
                load: known.and_then(|(_, load)| load),
            });
            tools.len() - 1
        })
    }

    fn frame(&mut self, point: &Point) -> FrameId {
        // joints have no frame
        let origin = match point.coordinates {
            Coordinates::Rectangular => point.origin,
            Coordinates::Pulses | Coordinates::Degrees => Origin::Base,
        };
        let frames = &mut self.report.program.frames;
        *self.frames.entry(origin).or_insert_with(|| {
            let (name, world_from_frame) = match origin {
                Origin::Base => ("BASE".to_owned(), Some(Pose::identity())),
                Origin::Robot => ("ROBOT".to_owned(), Some(Pose::identity())),
                Origin::User(number) => {
                    let known = self.conditions.frames.get(&number).copied().flatten();
                    (number.to_string(), known)
                }
                Origin::Tool => ("TOOL".to_owned(), None),
                Origin::Unknown => (NO_TOOL.to_owned(), None),
            };
            frames.push(Frame {
                name,
                world_from_frame,
            });
            frames.len() - 1
        })
    }

    /// The header announces as many positions as there are; the controller refuses others.
    fn check_count(&mut self, job: &Job) {
        let Some((announced, offset)) = job.announced else {
            return;
        };
        let count = job.points.iter().filter(|p| p.letter == Letter::C).count();
        if count != announced as usize {
            let message = format!(
                "the header announces {announced} C positions (NPOS), and there are {count}"
            );
            let at = place(job.file as usize, offset);
            let hint = "is the file complete?";
            self.report
                .say("position-count", Severity::Warning, at, message, hint);
        }
    }

    /// Reports values that are computed from targets.
    fn report_copies(&mut self) {
        for (index, job) in self.jobs.iter().enumerate() {
            for event in &job.events {
                let Event::Copy { offset, from } = *event else {
                    continue;
                };
                let found = self.point(index, Operand::P(from));
                if found.is_ok_and(|(job, point)| self.targets[job][point].is_some()) {
                    let message = format!(
                        "a position is computed from P{from:03}, which may be compensated for other moves"
                    );
                    let at = place(job.file as usize, offset);
                    let hint = "look where the new position is used";
                    self.report
                        .say("target-copied", Severity::Warning, at, message, hint);
                }
            }
        }
    }
}

/// Successive MOVC: how many so far, and the last one's place in the moves.
#[derive(Default)]
struct Arc {
    points: usize,
    last: usize,
}

/// Why the position of a move of this kind has to stay.
fn cause_of(kind: Kind) -> Option<Cause> {
    match kind {
        Kind::Joint | Kind::Linear | Kind::Circular => None,
        Kind::Coordinated => Some(Cause::Coordinated),
        Kind::Incremental => Some(Cause::Incremental),
        Kind::Search => Some(Cause::Search),
        Kind::SecondRobot => Some(Cause::SecondRobot),
        Kind::Other => Some(Cause::OtherMove),
    }
}
