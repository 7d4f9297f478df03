//! Findings about targets and moves.

use super::tokens::Place;
use crate::finding::{Finding, Severity};
use crate::program::{Program, Shape, Source, TargetId};
use std::collections::HashSet;

/// Why a target has to stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cause {
    Assigned,
    Computed,
    Partial,
    Passed,
    Ambiguous,
    UsedAsFrame,
    FrameAssigned,
    FrameChosen,
    FrameAmbiguous,
    MovingFrame,
    ExternalTcp,
    AbsolutelyAccurate,
}

impl Cause {
    /// Identifier, what is wrong, and the way out.
    fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Assigned => (
                "target-assigned-at-run-time",
                "the running program changes this target",
                "compensate where the program computes it, or keep the target out of the path",
            ),
            Self::Computed => (
                "target-has-expressions",
                "parts of this target are expressions, not numbers",
                "write the target with numbers in the offline system",
            ),
            Self::Partial => (
                "partial-target",
                "components are missing, which keep the value of the position before",
                "write X, Y, Z, A, B and C",
            ),
            Self::Passed => (
                "target-passed-to-routine",
                "this target is handed to a routine, which may use it with any tool and base",
                "move to the target where its tool and base are set",
            ),
            Self::Ambiguous => (
                "target-name-ambiguous",
                "this name is declared more than once, and a use does not tell which one is meant",
                "pass only the programs of one robot",
            ),
            Self::UsedAsFrame => (
                "target-used-as-frame",
                "this target is a tool or base, too",
                "give the frame a variable of its own",
            ),
            Self::FrameAssigned => (
                "frame-assigned-at-run-time",
                "the running program changes the tool or base",
                "assign it once, with numbers, or use another entry for each place",
            ),
            Self::FrameChosen => (
                "frame-chosen-at-run-time",
                "only the running program knows the tool or base",
                "set $TOOL and $BASE before the move in the same routine",
            ),
            Self::FrameAmbiguous => (
                "frame-name-ambiguous",
                "the tool or base is declared more than once with different values",
                "pass one $config.dat only, and where the program writes the entry the one that it has written",
            ),
            Self::MovingFrame => (
                "moving-frame",
                "another kinematic moves the base (EK, MACHINE_FRAME_DAT)",
                "moves in a moving base are not compensated",
            ),
            Self::ExternalTcp => (
                "external-tcp",
                "the robot holds the work piece and the tool stands still (#TCP)",
                "moves with a fixed tool are not compensated",
            ),
            Self::AbsolutelyAccurate => (
                "absolutely-accurate",
                "taught on an absolutely accurate robot (S has bit 4, 16), which corrects its targets itself",
                "switch the correction of the controller off, or --force",
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
    /// What blocks a target that may turn out to be none.
    blocks: Vec<(TargetId, Cause, Place, String)>,
    places: Vec<Place>,
}

impl<'a> Report<'a> {
    pub fn new(sources: &'a [Source]) -> Self {
        Self {
            sources,
            program: Program::default(),
            said: HashSet::new(),
            blocks: Vec::new(),
            places: Vec::new(),
        }
    }

    /// The target has to stay as it is; `because` is where the program says so, `what` a name there.
    pub fn block(&mut self, target: TargetId, cause: Cause, because: Place, what: &str) {
        if self.said.insert((target, cause)) {
            self.blocks.push((target, cause, because, what.to_owned()));
        }
    }

    /// Blocks the targets that are `kept`, and says why.
    fn say_blocks(&mut self, kept: &[bool]) {
        for (target, cause, because, what) in std::mem::take(&mut self.blocks) {
            if !kept[target] {
                continue;
            }
            let blocked = &mut self.program.targets[target];
            blocked.blocked = true;
            let place = Place {
                file: blocked.file,
                offset: blocked.offset,
            };
            let name = blocked.name.as_deref().unwrap_or("target").to_owned();
            // joint targets stay as they are unless asked for
            let severity = match blocked.layout.shape {
                Shape::Pose => Severity::Error,
                Shape::Joints => Severity::Warning,
            };
            let (id, wrong, hint) = cause.words();
            let see = if because == place {
                String::new()
            } else {
                let source = &self.sources[because.file as usize];
                let (line, _) = source.line_column(because.offset as usize);
                let what = if what.is_empty() { "the move" } else { &what };
                format!(" (see {what}, {} line {line})", source.name)
            };
            self.say(id, severity, place, format!("{name}: {wrong}{see}"), hint);
        }
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
            accepted: false,
        });
    }

    /// The program without the targets that are not `kept`, its findings by file and place.
    pub fn finish(mut self, kept: &[bool]) -> Program {
        self.say_blocks(kept);
        let mut program = self.program;
        let findings = std::mem::take(&mut program.findings);
        let mut findings: Vec<_> = self.places.into_iter().zip(findings).collect();
        findings.sort_by_key(|(place, finding)| (place.file, place.offset, finding.id));
        program.findings = findings.into_iter().map(|(_, finding)| finding).collect();
        if kept.iter().all(|&kept| kept) {
            return program;
        }
        let mut new_ids = vec![0; kept.len()];
        let old_targets = std::mem::take(&mut program.targets);
        let old_numbers = std::mem::take(&mut program.numbers);
        for (old, mut target) in old_targets.into_iter().enumerate() {
            if !kept[old] {
                continue;
            }
            new_ids[old] = program.targets.len();
            let first = super::tokens::index(program.numbers.len());
            let range = target.numbers.start as usize..target.numbers.end as usize;
            program.numbers.extend_from_slice(&old_numbers[range]);
            target.numbers = first..super::tokens::index(program.numbers.len());
            program.targets.push(target);
        }
        for motion in &mut program.moves {
            motion.target = motion.target.map(|target| new_ids[target]);
        }
        program
    }
}
