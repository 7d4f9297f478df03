//! What compensating a program gave.

use super::rewrite::Rewritten;
use super::{Job, Task};
use crate::finding::{Finding, Severity};
use crate::geometry::{Pose, Separation};
use crate::inverse::{Branch, Outcome, Status};
use crate::program::{Decoded, Edits, Program, Settings, Shape};
use std::collections::BTreeMap;

/// A program with fake targets, not yet written.
#[derive(Debug)]
pub struct Compensation {
    /// The program as it was read.
    pub program: Program,
    /// What its language had to know beside the files.
    pub settings: Settings,
    /// What became of each of its targets.
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

impl Compensation {
    /// Whether an error finding says that the program must not be written.
    #[must_use]
    pub fn is_refused(&self) -> bool {
        self.findings
            .iter()
            .any(|finding| finding.severity == Severity::Error)
    }
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
    /// Mean shift of those that changed.
    pub mean_shift_m: f64,
    /// Largest shift.
    pub max_shift_m: f64,
    /// Largest residual of the search.
    pub max_residual_m: f64,
    /// Farthest landing from the wanted pose with the numbers as written.
    pub max_rounding_m: f64,
}

/// What became of one target.
#[derive(Clone, Debug)]
pub struct TargetReport {
    /// Index of its first tool in the program; `None` where no move uses it.
    pub tool: Option<u32>,
    /// Index of its first work frame.
    pub frame: Option<u32>,
    /// `frame_from_tool` to be written instead, before rounding; `None` where it stays.
    pub fake: Option<Pose>,
    /// The controller's joints at the fake target, radians.
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
    /// Its text changes.
    pub changed: bool,
}

impl TargetReport {
    pub(super) fn new(program: &Program, target: usize, solved: Option<(&Task, &Outcome)>) -> Self {
        debug_assert!(target < program.targets.len());
        let none = Separation::default();
        Self {
            tool: None,
            frame: None,
            fake: None,
            q: solved.map(|(_, outcome)| outcome.q),
            shift: none,
            residual: solved.map_or(none, |(_, outcome)| outcome.residual),
            rounding: none,
            iterations: solved.map_or(0, |(_, outcome)| outcome.iterations),
            branch: solved.map(|(task, _)| task.branch),
            status: solved.map(|(_, outcome)| outcome.status),
            changed: false,
        }
    }
}

/// Puts the rewritten targets together: a report a target, edits a source, which sources are compensated, the numbers of
/// the whole. Adds the targets' findings and brings all into the order of the files.
pub(super) fn assemble(
    job: &Job,
    rewritten: Vec<Rewritten>,
    findings: &mut Vec<Finding>,
) -> (Vec<TargetReport>, Vec<Edits>, Vec<bool>, Summary) {
    let program = job.program;
    let mut reports: Vec<_> = (0..program.targets.len())
        .map(|index| TargetReport::new(program, index, None))
        .collect();
    let mut edits: Vec<Edits> = job.sources.iter().map(|_| Edits::default()).collect();
    for one in rewritten {
        let target = &program.targets[one.target];
        let numbers = program.numbers_of(target);
        let mut start = 0;
        for (index, end) in one.changes {
            let number = &numbers[usize::from(index)];
            let span = number.start as usize..number.start as usize + usize::from(number.length);
            let digits = &one.text[start..usize::from(end)];
            edits[target.file as usize].replace(span, |out| out.extend_from_slice(digits));
            start = usize::from(end);
        }
        findings.extend(one.findings);
        reports[one.target] = one.report;
    }
    for motion in program.moves.iter().rev() {
        let report = &mut reports[motion.target];
        (report.tool, report.frame) = (Some(small(motion.tool)), Some(small(motion.frame)));
    }
    let order: BTreeMap<&str, usize> = job
        .sources
        .iter()
        .enumerate()
        .map(|(i, s)| (s.name.as_str(), i))
        .collect();
    findings.sort_by_cached_key(|f| (order.get(f.file.as_str()).copied(), f.line, f.column, f.id));
    let mut compensated = vec![false; job.sources.len()];
    let mut summary = Summary {
        targets: reports.len(),
        ..Summary::default()
    };
    let mut shifts = 0.0;
    for (report, target) in reports.iter().zip(&program.targets) {
        summary.compensated += usize::from(report.changed);
        summary.unchanged += usize::from(!report.changed);
        summary.joint_targets +=
            usize::from(target.layout.shape == Shape::Joints && !report.changed);
        if report.status == Some(Status::Converged) {
            compensated[target.file as usize] = true;
            shifts += if report.changed {
                report.shift.distance_m
            } else {
                0.0
            };
            summary.max_shift_m = summary.max_shift_m.max(report.shift.distance_m);
            summary.max_residual_m = summary.max_residual_m.max(report.residual.distance_m);
            summary.max_rounding_m = summary.max_rounding_m.max(report.rounding.distance_m);
        }
    }
    if summary.compensated > 0 {
        summary.mean_shift_m = shifts / summary.compensated as f64;
    }
    (reports, edits, compensated, summary)
}

fn small(index: usize) -> u32 {
    u32::try_from(index).expect("a program's text is below 4 GiB")
}

/// What the numbers of a target mean; a blocked target may have none.
#[must_use]
pub fn meaning(
    language: &dyn crate::program::Language,
    program: &Program,
    settings: &Settings,
    target: usize,
) -> Option<Decoded> {
    let target = &program.targets[target];
    let numbers: Vec<f64> = program.numbers_of(target).iter().map(|n| n.value).collect();
    (!numbers.is_empty()).then(|| language.decode(target.layout, &numbers, settings))
}
