//! What compensating a program gave.

use super::posture::decoded;
use super::{Job, Task};
use crate::finding::{Finding, Severity};
use crate::geometry::{Pose, Separation};
use crate::inverse::{Branch, Outcome, Status};
use crate::program::{Edits, Shape, Value};
use std::collections::BTreeMap;

/// A program with fake targets, not yet written.
#[derive(Debug)]
pub struct Compensation {
    /// Every target, by file and place.
    pub targets: Vec<TargetReport>,
    /// What a person should look at, by file and place.
    pub findings: Vec<Finding>,
    /// The changes to each source.
    pub edits: Vec<Edits>,
    /// Whether each source has targets that now are compensated, changed or not.
    pub compensated: Vec<bool>,
    /// The numbers of the whole.
    pub summary: Summary,
}

/// The numbers of a whole program.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Targets with numbers in the files.
    pub targets: usize,
    /// Targets whose numbers changed.
    pub compensated: usize,
    /// Targets whose numbers stayed.
    pub unchanged: usize,
    /// Joint targets among the unchanged.
    pub joint_targets: usize,
    /// Largest shift.
    pub max_shift_m: f64,
    /// Largest residual of the search.
    pub max_residual_m: f64,
    /// Farthest landing from the wanted pose with the numbers as written.
    pub max_rounding_m: f64,
}

/// One target and what became of it.
#[derive(Clone, Debug)]
pub struct TargetReport {
    /// Its name in the program.
    pub name: Option<Box<str>>,
    /// Index of its source.
    pub file: usize,
    /// Its line.
    pub line: usize,
    /// Name of its tool.
    pub tool: Option<String>,
    /// Name of its work frame.
    pub frame: Option<String>,
    /// The target as the file has it: `frame_from_tool`, or joints; `None` where it is blocked because it has no numbers.
    pub wanted: Option<Value>,
    /// The target written instead, before rounding; `None` where it stays.
    pub fake: Option<Pose>,
    /// The controller's joints at the fake target.
    pub q: Option<[f64; 6]>,
    /// From wanted to fake.
    pub shift: Separation,
    /// What the search left.
    pub residual: Separation,
    /// How far from the wanted pose the real tool lands with the numbers as written.
    pub rounding: Separation,
    /// Evaluations of the real model.
    pub iterations: u32,
    /// The branch of the inverse.
    pub branch: Option<Branch>,
    /// How the search ended; `None` where there was none.
    pub status: Option<Status>,
    /// Its text changed.
    pub changed: bool,
    /// Names of the findings about it.
    pub findings: Vec<&'static str>,
}

impl TargetReport {
    pub(super) fn new(job: &Job, task: &Task, outcome: &Outcome) -> Self {
        let mut report = Self::untouched(job, task.target);
        report.q = Some(outcome.q);
        report.residual = outcome.residual;
        report.iterations = outcome.iterations;
        report.branch = Some(task.branch);
        report.status = Some(outcome.status);
        report
    }

    /// A target that stays as it is.
    pub(super) fn untouched(job: &Job, index: usize) -> Self {
        let target = &job.program.targets[index];
        let none = Separation::default();
        Self {
            name: target.name.clone(),
            file: target.file as usize,
            line: job.sources[target.file as usize]
                .line_column(target.offset as usize)
                .0,
            tool: None,
            frame: None,
            wanted: decoded(job, index).map(|decoded| decoded.value),
            fake: None,
            q: None,
            shift: none,
            residual: none,
            rounding: none,
            iterations: 0,
            branch: None,
            status: None,
            changed: false,
            findings: Vec::new(),
        }
    }

    pub(super) fn set_fake(&mut self, task: &Task, controller_pose: &Pose) {
        self.fake = Some(task.world_from_frame.inverse() * *controller_pose);
        self.shift = task.wanted.separation(controller_pose);
    }
}

impl Compensation {
    pub(super) fn assemble(
        job: &Job,
        mut reports: BTreeMap<usize, TargetReport>,
        mut findings: Vec<Finding>,
        edits: Vec<Edits>,
    ) -> Self {
        let program = job.program;
        let mut targets: Vec<_> = (0..program.targets.len())
            .map(|index| {
                reports
                    .remove(&index)
                    .unwrap_or_else(|| TargetReport::untouched(job, index))
            })
            .collect();
        for motion in program.moves.iter().rev() {
            let report = &mut targets[motion.target];
            report.tool = Some(program.tools[motion.tool].name.clone());
            report.frame = Some(program.frames[motion.frame].name.clone());
        }
        let order: BTreeMap<&str, usize> = job
            .sources
            .iter()
            .enumerate()
            .map(|(i, s)| (s.name.as_str(), i))
            .collect();
        findings.sort_by_key(|f| (order.get(f.file.as_str()).copied(), f.line, f.column, f.id));
        let mut compensated = vec![false; job.sources.len()];
        let mut summary = Summary {
            targets: targets.len(),
            ..Summary::default()
        };
        for (index, report) in targets.iter().enumerate() {
            compensated[report.file] |= report.status == Some(Status::Converged);
            summary.compensated += usize::from(report.changed);
            summary.unchanged += usize::from(!report.changed);
            let is_joints = program.targets[index].shape == Shape::Joints;
            summary.joint_targets += usize::from(is_joints && !report.changed);
            if report.status == Some(Status::Converged) {
                summary.max_shift_m = summary.max_shift_m.max(report.shift.distance_m);
                summary.max_residual_m = summary.max_residual_m.max(report.residual.distance_m);
                summary.max_rounding_m = summary.max_rounding_m.max(report.rounding.distance_m);
            }
        }
        Self {
            targets,
            findings,
            edits,
            compensated,
            summary,
        }
    }

    /// Whether an error finding says that the program must not be written.
    #[must_use]
    pub fn is_refused(&self) -> bool {
        self.findings
            .iter()
            .any(|finding| finding.severity == Severity::Error)
    }
}
