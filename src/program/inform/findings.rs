//! What is wrong with positions and moves, in words.

use super::lines::index;
use crate::finding::{Finding, Severity};
use crate::program::{Program, Source, TargetId};
use std::collections::HashSet;

/// A byte of a source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    pub file: u32,
    pub offset: u32,
}

/// Why a target has to stay as it is, or a move runs without correction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cause {
    Assigned,
    Ambiguous,
    FrameAssigned,
    Shifted,
    Coordinated,
    Incremental,
    Search,
    SecondRobot,
    OtherMove,
    BaseAxis,
    ToolCoordinates,
    FrameNotNamed,
    AxisCount,
    NotInFiles,
    Computed,
    Pulses,
}

impl Cause {
    /// Stable name, what is wrong, and the way out.
    pub fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Assigned => (
                "target-assigned-at-run-time",
                "the running program changes this position variable",
                "correct the value where the program computes it, or move to a C position",
            ),
            Self::Ambiguous => (
                "target-name-ambiguous",
                "this name stands for different positions",
                "pass only the jobs that run together, with one value for each P variable",
            ),
            Self::FrameAssigned => (
                "frame-assigned-at-run-time",
                "the running program changes the tool or user frame",
                "set it once, outside these jobs, and give its value with --tool or --frame",
            ),
            Self::Shifted => (
                "displacement-active",
                "a shift (SFTON) may be on",
                "switch it off with SFTOF before the move, or write the shifted positions",
            ),
            Self::Coordinated => (
                "coordinated-move",
                "the path is relative to a station or another robot (SMOV)",
                "coordinated moves are not compensated",
            ),
            Self::Incremental => (
                "incremental-move",
                "where the move (IMOV) starts only the running program knows",
                "write the position that it leads to",
            ),
            Self::Search => (
                "search-move",
                "where the move (SRCH) ends only the sensor knows",
                "searches are not compensated",
            ),
            Self::SecondRobot => (
                "second-robot",
                "the position is one of a second robot",
                "compensate the jobs of each robot on their own",
            ),
            Self::OtherMove => (
                "move-not-supported",
                "moves of this kind are not known",
                "use MOVJ, MOVL, MOVC or MOVS",
            ),
            Self::BaseAxis => (
                "base-axis",
                "the robot stands on a base axis that is not at zero, so its place is unknown",
                "write the position in robot coordinates (POSTYPE ROBOT)",
            ),
            Self::ToolCoordinates => (
                "tool-coordinates",
                "the position is relative to a tool",
                "write the position in base, robot or user coordinates",
            ),
            Self::FrameNotNamed => (
                "frame-not-named",
                "the header does not tell the frame (POSTYPE, USER) of this position",
                "add ///POSTYPE, and ///USER with the frame's number, above it",
            ),
            Self::AxisCount => (
                "axis-count",
                "the position does not have six axes",
                "only robots with six joints are compensated",
            ),
            Self::NotInFiles => (
                "target-not-in-files",
                "the files do not have the position that this move goes to",
                "give the job that holds the position too",
            ),
            Self::Computed => (
                "computed-target",
                "only the running program knows the position that this move goes to",
                "move to a C position or a P variable by its number",
            ),
            Self::Pulses => (
                "pulses-per-degree-unknown",
                "positions of this job are in pulses, and the profile does not say how many make a degree",
                "add `pulses_per_deg: [S, L, U, R, B, T]` to the profile (ALL.PRM, or pulses and angles on the pendant)",
            ),
        }
    }
}

/// Collects findings.
#[derive(Debug)]
pub struct Report<'a> {
    pub sources: &'a [Source],
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

    /// The target has to stay as it is; `because` is where the program says so.
    pub fn block(&mut self, target: TargetId, cause: Cause, because: Option<Place>) {
        if !self.said.insert((target, cause)) {
            return;
        }
        let blocked = &mut self.program.targets[target];
        blocked.blocked = true;
        let place = Place {
            file: blocked.file,
            offset: blocked.offset,
        };
        let name = blocked
            .name
            .as_deref()
            .unwrap_or("this position")
            .to_owned();
        let see = because.map_or_else(String::new, |because| {
            let source = &self.sources[because.file as usize];
            let (line, _) = source.line_column(because.offset as usize);
            format!(" (see {} line {line})", source.name)
        });
        let (id, wrong, hint) = cause.words();
        self.say(
            id,
            Severity::Error,
            place,
            format!("{name}: {wrong}{see}"),
            hint,
        );
    }

    /// A move that runs without correction.
    pub fn refuse(&mut self, cause: Cause, place: Place) {
        let (id, wrong, hint) = cause.words();
        self.say(id, Severity::Error, place, wrong.to_owned(), hint);
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
        findings.sort_by_key(|(place, finding)| (place.file, place.offset, finding.id));
        self.program.findings = findings.into_iter().map(|(_, finding)| finding).collect();
        self.program
    }
}

/// A byte of a source.
pub fn place(file: usize, offset: u32) -> Place {
    Place {
        file: index(file),
        offset,
    }
}
