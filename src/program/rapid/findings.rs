//! What is wrong with targets, moves and frames, in words.

use super::syntax::Place;
use crate::finding::{Finding, Severity};
use crate::program::{Program, Source, TargetId};
use std::collections::HashSet;

/// Why a target has to stay as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cause {
    Assigned,
    Expressions,
    Named,
    Passed,
    Ambiguous,
    FrameAmbiguous,
    FrameAssigned,
    FrameChosen,
    HeldWorkPiece,
    StationaryTool,
    MovingFrame,
    Displaced,
}

impl Cause {
    /// Stable name, what is wrong, and the way out.
    pub fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Assigned => (
                "target-assigned-at-run-time",
                "the running program changes this target",
                "correct the value where the program computes it, or keep the target out of the path",
            ),
            Self::Expressions => (
                "target-has-expressions",
                "parts of this target are expressions, not numbers",
                "write the target with numbers in the offline system",
            ),
            Self::Named => (
                "target-in-array-of-names",
                "this target is used through another name",
                "move to the target by its own name, or write its numbers into the array",
            ),
            Self::Passed => (
                "target-passed-to-routine",
                "this target is handed to a routine, which may use it with any tool and frame",
                "move to the target where its tool and frame are named",
            ),
            Self::Ambiguous => (
                "target-name-ambiguous",
                "this name is declared more than once, and a use does not tell which one is meant",
                "pass only the modules of one task, or make the data LOCAL",
            ),
            Self::FrameAmbiguous => (
                "frame-name-ambiguous",
                "the tool or work object is declared more than once",
                "pass only the modules of one task, or make the data LOCAL",
            ),
            Self::FrameAssigned => (
                "frame-assigned-at-run-time",
                "the running program changes the tool or work object",
                "assign it once, with numbers, or declare one for each place",
            ),
            Self::FrameChosen => (
                "frame-chosen-at-run-time",
                "only the running program knows the tool or work object",
                "name the tool and the work object in the move",
            ),
            Self::HeldWorkPiece => (
                "held-work-piece",
                "the robot holds the work object (robhold TRUE)",
                "moves with a held work piece are not compensated",
            ),
            Self::StationaryTool => (
                "stationary-tool",
                "the tool does not hang on the robot (robhold FALSE)",
                "moves with a stationary tool are not compensated",
            ),
            Self::MovingFrame => (
                "moving-frame",
                "a conveyor or another mechanical unit moves the work object (ufprog FALSE or ufmec named)",
                "moves in a moving frame are not compensated",
            ),
            Self::Displaced => (
                "displacement-active",
                "a program displacement or external offset may be active",
                "switch it off with PDispOff or EOffsOff in the same routine before the move",
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

    /// The target has to stay as it is; `because` is where the program says so, `what` a name there.
    pub fn block(&mut self, target: TargetId, cause: Cause, because: Place, what: &str) {
        if !self.said.insert((target, cause)) {
            return;
        }
        let blocked = &mut self.program.targets[target];
        blocked.blocked = true;
        let place = Place {
            file: blocked.file,
            offset: blocked.offset,
        };
        let name = blocked.name.as_deref().unwrap_or("target").to_owned();
        let (id, wrong, hint) = cause.words();
        let cause = if because == place {
            String::new()
        } else {
            format!(" (see {what}, {})", self.line(because))
        };
        let message = format!("{name}: {wrong}{cause}");
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

    /// Whether a target is blocked for this cause.
    pub fn is_blocked(&self, target: TargetId, cause: Cause) -> bool {
        self.said.contains(&(target, cause))
    }

    /// The program with its findings by file and place.
    pub fn finish(mut self) -> Program {
        let mut findings: Vec<_> = self.places.into_iter().zip(self.program.findings).collect();
        findings.sort_by_key(|(place, finding)| (place.file, place.offset, finding.id));
        self.program.findings = findings.into_iter().map(|(_, finding)| finding).collect();
        self.program
    }

    /// File and line in words.
    fn line(&self, place: Place) -> String {
        let source = &self.sources[place.file as usize];
        let (line, _) = source.line_column(place.offset as usize);
        format!("{} line {line}", source.name)
    }
}
