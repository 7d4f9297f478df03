//! Puts together points, moves and frames of all files.

use super::findings::{Cause, Place, Report};
use super::frames::Frames;
use super::instructions::{Event, Extras, Named, Way, Which};
use super::points::{Content, Point, Selected, Trouble, offset};
use crate::finding::Severity;
use crate::geometry::Pose;
use crate::program::{
    Displacement, Frame, FrameId, Layout, Motion, Move, Number, Program, Shape, Source, TargetId,
    Tool, ToolId,
};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// One program, read.
#[derive(Debug, Default)]
pub struct Listing {
    /// Index of its file.
    pub file: u32,
    /// Its name in capitals.
    pub name: Box<[u8]>,
    /// Its points.
    pub points: Vec<Point>,
    /// The numbers of its points, until they are the program's.
    pub numbers: Vec<Number>,
    /// What its instructions do, with their first bytes.
    pub events: Vec<(u32, Event)>,
    /// It follows a conveyor.
    pub tracks_line: bool,
}

/// The numbers of tools or work frames.
#[derive(Debug, Default)]
struct Numbers {
    /// Those that some program assigns, with the place.
    assigned: BTreeMap<u32, Place>,
    /// A place that assigns any.
    any: Option<Place>,
    /// Index in the program's list, by number.
    ids: BTreeMap<u32, usize>,
}

impl Numbers {
    fn assign(&mut self, number: Option<u32>, place: Place) {
        match number {
            Some(number) => {
                self.assigned.entry(number).or_insert(place);
            }
            None => self.any = self.any.or(Some(place)),
        }
    }

    /// Where the running program changes this number's value; 0 is fixed.
    fn changed(&self, number: u32) -> Option<Place> {
        let changed = match number {
            ACTIVE => self.assigned.values().next().copied(),
            number => self.assigned.get(&number).copied(),
        };
        let changed = changed.or(self.any);
        changed.filter(|_| number != 0)
    }
}

/// Stands for the number that is active when the program starts; no tool or frame has it.
const ACTIVE: u32 = u32::MAX;

/// The number that is active at a place of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Active {
    /// The one that was active when the program started.
    Start,
    Unknown,
    Number(u32),
}

/// Targets, moves, tools and frames of all programs.
pub fn resolve(sources: &[Source], listings: &mut [Listing], values: &Frames) -> Program {
    // the numbers are most of what there is: those of a single listing are taken over as they are
    let mut numbers = Vec::new();
    let mut first_numbers = Vec::with_capacity(listings.len());
    for listing in &mut *listings {
        first_numbers.push(numbers.len());
        if numbers.is_empty() {
            numbers = std::mem::take(&mut listing.numbers);
        } else {
            numbers.append(&mut listing.numbers);
        }
    }
    let listings = &*listings;
    let mut resolver = Resolver {
        report: Report::new(sources),
        values,
        tools: Numbers::default(),
        frames: Numbers::default(),
        harmless: harmless(listings),
    };
    for listing in listings {
        for (offset, event) in &listing.events {
            if let Event::Assign { which, number } = event {
                let place = listing.place(*offset);
                if *which != Which::Frame {
                    resolver.tools.assign(*number, place);
                }
                if *which != Which::Tool {
                    resolver.frames.assign(*number, place);
                }
            }
        }
    }
    resolver.report.program.numbers = numbers;
    for (listing, first_number) in listings.iter().zip(first_numbers) {
        resolver.listing(listing, first_number);
    }
    resolver.report.finish()
}

/// Programs that neither select tools or frames nor call others.
fn harmless(listings: &[Listing]) -> HashSet<&[u8]> {
    let still = |listing: &&Listing| {
        let mut events = listing.events.iter();
        !events.any(|(_, event)| matches!(event, Event::Select { .. } | Event::Call(_)))
    };
    let harmless = listings.iter().filter(still);
    harmless.map(|listing| &*listing.name).collect()
}

impl Listing {
    fn place(&self, offset: u32) -> Place {
        Place {
            file: self.file,
            offset,
        }
    }

    /// What is active wherever the program is: the number that all its selections name, or that of its start where it
    /// has none.
    fn everywhere(&self, tool: bool) -> Active {
        let mut selected = BTreeSet::new();
        for (_, event) in &self.events {
            if let Event::Select { which, number } = event
                && (*which == Which::Either || (*which == Which::Tool) == tool)
            {
                selected.insert((*which == Which::Either, *number));
            }
        }
        match (selected.pop_first(), selected.is_empty()) {
            (None, _) => Active::Start,
            (Some((false, Some(number))), true) => Active::Number(number),
            _ => Active::Unknown,
        }
    }
}

struct Resolver<'a> {
    report: Report<'a>,
    values: &'a Frames,
    tools: Numbers,
    frames: Numbers,
    harmless: HashSet<&'a [u8]>,
}

/// How many tools and frames are active, and which of one program's points are used.
struct State {
    tool: Active,
    frame: Active,
    used: Vec<bool>,
    /// Uses that are listed: a register as an index says nothing new the second time.
    listed: HashSet<(Way, Extras)>,
    mismatched: HashSet<usize>,
    row_open: bool,
}

impl<'a> Resolver<'a> {
    fn listing(&mut self, listing: &'a Listing, first_number: usize) {
        let first_target = self.report.program.targets.len();
        let mut by_number: HashMap<u32, usize> = HashMap::with_capacity(listing.points.len());
        let mut twice = HashSet::new();
        for (index, point) in listing.points.iter().enumerate() {
            if by_number.insert(point.number, index).is_some() {
                twice.insert(point.number);
            }
            self.target(listing, point, first_number);
        }
        let mut state = State {
            tool: Active::Start,
            frame: Active::Start,
            used: vec![false; listing.points.len()],
            listed: HashSet::new(),
            mismatched: HashSet::new(),
            row_open: false,
        };
        let everywhere = [true, false].map(|tool| listing.everywhere(tool));
        for (at, (offset, event)) in listing.events.iter().enumerate() {
            let place = listing.place(*offset);
            match event {
                Event::Move { way, to, extras } => {
                    let way = self.arc_row(&mut state, listing, at, *way);
                    let indices = self.points_of(listing, &by_number, *to, place, true);
                    if *to == Named::Any && !state.listed.insert((way, *extras)) {
                        continue;
                    }
                    for index in indices {
                        state.used[index] = true;
                        let use_ = Use { way, extras, place };
                        self.go(listing, &mut state, first_target, index, &use_);
                    }
                }
                Event::Mention(named) => {
                    for index in self.points_of(listing, &by_number, *named, place, false) {
                        state.used[index] = true;
                        self.block(first_target + index, Cause::Assigned, Some(place));
                    }
                }
                Event::Copy(named) => {
                    let message = "a point is copied into a register here; it takes its correction along, and moves to the register are not compensated";
                    if *named != Named::Register {
                        let hint = "look where the register is used";
                        let warning = Severity::Warning;
                        self.report
                            .say("target-copied", warning, place, message.into(), hint);
                    }
                }
                Event::Select { which, number } => {
                    let active = number.map_or(Active::Unknown, Active::Number);
                    let either = *which == Which::Either;
                    if *which != Which::Frame {
                        state.tool = if either { Active::Unknown } else { active };
                    }
                    if *which != Which::Tool {
                        state.frame = if either { Active::Unknown } else { active };
                    }
                }
                Event::Join => state.join(everywhere),
                Event::Call(name) if !self.harmless.contains(&**name) => {
                    (state.tool, state.frame) = (Active::Unknown, Active::Unknown);
                }
                Event::Call(_) | Event::Assign { .. } => {}
            }
        }
        for (index, point) in listing.points.iter().enumerate() {
            if twice.contains(&point.number) {
                state.used[index] = true;
                self.block(first_target + index, Cause::Twice, None);
            }
        }
        self.finish_points(listing, first_target, &state.used);
    }

    fn block(&mut self, target: TargetId, cause: Cause, because: Option<Place>) {
        self.report.block(target, cause, because);
    }

    /// Lists the target of a point; one without group 1 is kept too, so that indices stay the same.
    fn target(&mut self, listing: &Listing, point: &Point, first_number: usize) {
        let program = &mut self.report.program;
        let [start, end] =
            [point.numbers.start, point.numbers.end].map(|at| offset(first_number + at));
        let (shape, variant, blocked) = match point.content {
            Some(Content::Pose { configured }) => (Shape::Pose, u8::from(!configured), false),
            Some(Content::Joints) => (Shape::Joints, 0, false),
            Some(Content::Trouble(_)) | None => (Shape::Pose, 1, true),
        };
        program.targets.push(crate::program::Target {
            name: Some(format!("P[{}]", point.number).into()),
            file: listing.file,
            offset: point.offset,
            layout: Layout { shape, variant },
            numbers: start..end,
            blocked,
        });
    }

    /// Indices of the points that a move or instruction names.
    fn points_of(
        &mut self,
        listing: &Listing,
        by_number: &HashMap<u32, usize>,
        named: Named,
        place: Place,
        is_move: bool,
    ) -> std::ops::Range<usize> {
        match named {
            Named::Point(number) => match by_number.get(&number) {
                Some(&index) => index..index + 1,
                None if is_move => {
                    let message = format!(
                        "P[{number}] is not in /POS of this file; this move is not compensated"
                    );
                    let hint = "export the program again, whole";
                    let error = Severity::Error;
                    self.report
                        .say("target-not-in-files", error, place, message, hint);
                    0..0
                }
                None => 0..0,
            },
            Named::Any => 0..listing.points.len(),
            Named::Register if is_move => {
                let message = "this move goes to a position register, which only the running program knows; it is not compensated";
                let hint = "write the position as a point of the program";
                let error = Severity::Error;
                self.report
                    .say("computed-target", error, place, message.into(), hint);
                0..0
            }
            Named::Register => 0..0,
        }
    }

    /// What a point of a row of arcs is: the first is reached on a straight line, those after it lie on arcs.
    fn arc_row(&self, state: &mut State, listing: &Listing, at: usize, way: Way) -> Way {
        let was_open = std::mem::replace(&mut state.row_open, way == Way::ArcRow);
        if way != Way::ArcRow {
            return way;
        }
        let is_row = |event: &Event| {
            matches!(
                event,
                Event::Move {
                    way: Way::ArcRow,
                    ..
                }
            )
        };
        let next = listing.events[at + 1..]
            .iter()
            .find(|(_, event)| matches!(event, Event::Move { .. }));
        match (was_open, next.is_some_and(|(_, event)| is_row(event))) {
            (false, _) => Way::Linear,
            (true, true) => Way::ArcVia,
            (true, false) => Way::ArcEnd,
        }
    }

    /// One move to one point.
    fn go(
        &mut self,
        listing: &Listing,
        state: &mut State,
        first_target: TargetId,
        index: usize,
        use_: &Use,
    ) {
        let target = first_target + index;
        let point = &listing.points[index];
        // the move is one of another robot or a positioner
        let Some(content) = point.content else {
            return;
        };
        let cause = match content {
            Content::Trouble(Trouble::Uninitialised) => Some(Cause::Uninitialised),
            Content::Trouble(Trouble::RemoteTool) => Some(Cause::RemoteTool),
            Content::Trouble(Trouble::Axes) => Some(Cause::Axes),
            Content::Trouble(Trouble::Configuration) => Some(Cause::Configuration),
            _ => None,
        };
        if let Some(cause) = cause {
            self.block(target, cause, Some(use_.place));
            return;
        }
        let extras = use_.extras;
        for (is, cause) in [
            (extras.incremental, Cause::Incremental),
            (extras.remote, Cause::RemoteTool),
            (extras.coordinated, Cause::Coordinated),
            (listing.tracks_line, Cause::LineTracking),
        ] {
            if is {
                self.block(target, cause, Some(use_.place));
            }
        }
        let is_joints = content == Content::Joints;
        let tool = self.number(listing, state, index, use_.place, first_target, true);
        let frame = if is_joints {
            // joint targets have no work frame
            Some(match point.frame {
                Selected::Number(number) => number,
                Selected::Active => 0,
            })
        } else {
            self.number(listing, state, index, use_.place, first_target, false)
        };
        let (Some(tool), Some(frame)) = (tool, frame) else {
            return;
        };
        let motion = match use_.way {
            Way::Joint => Motion::Joint,
            Way::Linear | Way::ArcRow => Motion::Linear,
            Way::ArcVia => Motion::ArcVia,
            Way::ArcEnd => Motion::ArcEnd,
        };
        let displacement = if extras.displaced {
            Displacement::Unknown
        } else {
            Displacement::None
        };
        let (tool, frame) = (self.tool_id(tool), self.frame_id(frame));
        self.report.program.moves.push(Move {
            file: listing.file,
            offset: use_.place.offset,
            motion,
            target: Some(target),
            tool,
            frame,
            displacement,
            configured: !extras.wrist_joint,
            near: None,
            pace: crate::program::Pace::default(),
            ..Move::default()
        });
    }

    /// The number of a point's tool or frame in a move; `None`, and the point blocked, where only the running program
    /// knows it or its value.
    fn number(
        &mut self,
        listing: &Listing,
        state: &mut State,
        index: usize,
        place: Place,
        first_target: TargetId,
        is_tool: bool,
    ) -> Option<u32> {
        let point = &listing.points[index];
        let (selected, active, numbers, what) = if is_tool {
            (point.tool, state.tool, &self.tools, "tool")
        } else {
            (point.frame, state.frame, &self.frames, "user frame")
        };
        let number = match (selected, active) {
            (Selected::Number(number), _) | (Selected::Active, Active::Number(number)) => number,
            (Selected::Active, Active::Start) => ACTIVE,
            (Selected::Active, Active::Unknown) => {
                self.block(first_target + index, Cause::FrameUnknown, Some(place));
                return None;
            }
        };
        if let Some(changed) = numbers.changed(number) {
            self.block(first_target + index, Cause::FrameAssigned, Some(changed));
            return None;
        }
        if let Active::Number(other) = active
            && other != number
            && state.mismatched.insert(index)
        {
            let message = format!(
                "P[{}] was taught with {what} {number}, and {other} is selected here: the controller stops at this move",
                point.number
            );
            let hint = "select the number that the point was taught with";
            let warning = Severity::Warning;
            self.report
                .say("frame-number-differs", warning, place, message, hint);
        }
        Some(number)
    }

    fn tool_id(&mut self, number: u32) -> ToolId {
        let tools = &mut self.report.program.tools;
        let known = self.values.tools.get(&number).copied();
        *self.tools.ids.entry(number).or_insert_with(|| {
            tools.push(Tool {
                name: name(number),
                flange_from_tool: known.or_else(|| zero(number)),
                load: None,
            });
            tools.len() - 1
        })
    }

    fn frame_id(&mut self, number: u32) -> FrameId {
        let frames = &mut self.report.program.frames;
        let known = self.values.frames.get(&number).copied();
        *self.frames.ids.entry(number).or_insert_with(|| {
            frames.push(Frame {
                name: name(number),
                world_from_frame: known.or_else(|| zero(number)),
            });
            frames.len() - 1
        })
    }

    /// Tells of points that no move uses, and of axes beside the six of the arm.
    fn finish_points(&mut self, listing: &Listing, first_target: TargetId, used: &[bool]) {
        let unused = (0..used.len()).filter(|&index| !used[index]);
        let mut first = None;
        let mut count = 0;
        for index in unused {
            self.report.program.targets[first_target + index].blocked = true;
            first = first.or(Some(index));
            count += 1;
        }
        let note = |report: &mut Report, id, severity, index: usize, message: String, hint| {
            let place = listing.place(listing.points[index].offset);
            report.say(id, severity, place, message, hint);
        };
        if let Some(index) = first {
            let number = listing.points[index].number;
            let message = format!(
                "no move uses {count} of the points (the first is P[{number}]); they stay as they are"
            );
            let id = "target-unused-here";
            note(&mut self.report, id, Severity::Note, index, message, "");
        }
        let extended = (0..used.len()).find(|&index| {
            let point = &listing.points[index];
            let is_read = !matches!(point.content, Some(Content::Trouble(_)));
            used[index] && point.extended && is_read
        });
        if let Some(index) = extended {
            let message = "points have an axis beside the six of the arm that is away from zero: where it carries the arm, the arm's own pose is another than the one that is computed";
            let hint = "go on only if the axis does not carry the arm (a gun, a turntable)";
            let id = "extended-axis";
            let warning = Severity::Warning;
            note(&mut self.report, id, warning, index, message.into(), hint);
        }
        let elsewhere =
            (0..used.len()).find(|&index| used[index] && listing.points[index].content.is_none());
        if let Some(index) = elsewhere {
            let number = listing.points[index].number;
            let message =
                format!("P[{number}] has no group 1: it is a point of another group and stays");
            let id = "other-group";
            note(&mut self.report, id, Severity::Note, index, message, "");
        }
    }
}

/// As points and users call a tool or frame.
fn name(number: u32) -> String {
    match number {
        ACTIVE => "F".into(),
        number => number.to_string(),
    }
}

/// Tool and frame 0 are the flange and the world.
fn zero(number: u32) -> Option<Pose> {
    (number == 0).then(Pose::identity)
}

impl State {
    /// The program may come here from elsewhere: what is active stays known where it is the same in the whole program.
    fn join(&mut self, [tool, frame]: [Active; 2]) {
        for (active, everywhere) in [(&mut self.tool, tool), (&mut self.frame, frame)] {
            if *active != everywhere {
                *active = Active::Unknown;
            }
        }
    }
}

/// One move as an instruction has it.
struct Use<'a> {
    way: Way,
    extras: &'a Extras,
    place: Place,
}
