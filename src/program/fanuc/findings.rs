//! What is wrong with points, moves and frames, in words.

use crate::finding::{Finding, Severity};
use crate::program::{Program, Source, TargetId};
use std::collections::HashSet;

/// A byte of a source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    pub file: u32,
    pub offset: u32,
}

/// Why a point has to stay as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cause {
    Uninitialised,
    Axes,
    Configuration,
    Twice,
    Assigned,
    Incremental,
    RemoteTool,
    Coordinated,
    LineTracking,
    FrameAssigned,
    FrameUnknown,
}

impl Cause {
    /// Stable name, what is wrong, and the way out.
    pub fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Uninitialised => (
                "target-uninitialised",
                "this point was never taught (********), and a move goes there",
                "teach the point, or take the move out",
            ),
            Self::Axes => (
                "target-not-six-axes",
                "group 1 of this point is neither X Y Z W P R in mm and deg nor J1 to J6 in deg",
                "only arms with six joints are compensated",
            ),
            Self::Configuration => (
                "configuration-not-understood",
                "these configuration data are not those of an arm with six joints and a spherical wrist",
                "only arms with six joints and a spherical wrist are compensated",
            ),
            Self::Twice => (
                "target-declared-twice",
                "this point stands in /POS more than once",
                "keep the one that is meant",
            ),
            Self::Assigned => (
                "target-used-by-instruction",
                "an instruction that is no move changes or uses this point",
                "move to the point with J, L, C or A, or keep it out of the path",
            ),
            Self::Incremental => (
                "incremental-move",
                "this point is an increment (INC), not a place",
                "move to a point of its own instead",
            ),
            Self::RemoteTool => (
                "remote-tool",
                "the tool stands still and the robot holds the work piece (RTCP)",
                "moves with a held work piece are not compensated",
            ),
            Self::Coordinated => (
                "coordinated-move",
                "the move is coordinated with a positioner (COORD), which moves the work piece",
                "moves in a moving frame are not compensated",
            ),
            Self::LineTracking => (
                "line-tracking",
                "the program follows a conveyor",
                "moves in a moving frame are not compensated",
            ),
            Self::FrameAssigned => (
                "frame-assigned-at-run-time",
                "the running program changes the tool or user frame",
                "set it up once, and give its value",
            ),
            Self::FrameUnknown => (
                "frame-chosen-at-run-time",
                "the tool or user frame is the active one (F), and only the running program knows which",
                "select it with UTOOL_NUM and UFRAME_NUM before the first move, with one number in the whole program, or teach the point again",
            ),
        }
    }
}

/// Collects findings.
#[derive(Debug)]
pub struct Report<'a> {
    sources: &'a [Source],
    pub program: Program,
    said: HashSet<(TargetId, Cause)>,
    places: Vec<Place>,
}

impl<'a> Report<'a> {
    pub fn new(sources: &'a [Source]) -> Self {
        Self {
            sources,
            program: Program::default(),
            said: HashSet::new(),
            places: Vec::new(),
        }
    }

    /// The point has to stay as it is; `because` is where the program says so.
    pub fn block(&mut self, target: TargetId, cause: Cause, because: Option<Place>) {
        self.program.targets[target].blocked = true;
        if !self.said.insert((target, cause)) {
            return;
        }
        let blocked = &self.program.targets[target];
        let place = Place {
            file: blocked.file,
            offset: blocked.offset,
        };
        let name = blocked.name.as_deref().unwrap_or("point").to_owned();
        let (id, wrong, hint) = cause.words();
        let because = because.map_or_else(String::new, |because| {
            let source = &self.sources[because.file as usize];
            let (line, _) = source.line_column(because.offset as usize);
            if because.file == place.file {
                format!(" (see line {line})")
            } else {
                format!(" (see {} line {line})", source.name)
            }
        });
        let message = format!("{name}: {wrong}{because}");
        self.say(id, Severity::Error, place, message, hint);
    }

    pub fn say(
        &mut self,
        id: &'static str,
        severity: Severity,
        place: Place,
        message: String,
        hint: &str,
    ) {
        let source = &self.sources[place.file as usize];
        let (line, column) = source.line_column(place.offset as usize);
        self.places.push(place);
        self.program.findings.push(Finding {
            id,
            severity,
            file: source.name.clone(),
            line,
            column,
            message,
            hint: hint.to_owned(),
        });
    }

    /// The program with its findings by file and place.
    pub fn finish(mut self) -> Program {
        let mut findings: Vec<_> = self.places.into_iter().zip(self.program.findings).collect();
        findings.sort_by_key(|(place, finding)| (*place, finding.id));
        self.program.findings = findings.into_iter().map(|(_, finding)| finding).collect();
        self.program
    }
}
