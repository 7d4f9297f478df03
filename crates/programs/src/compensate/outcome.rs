//! What compensating a program gave.

use super::Job;
use super::approach::Solved;
use crate::finding::{Finding, Severity};
use crate::geometry::{Pose, Separation};
use crate::inverse::{Branch, Method, Status};
use crate::program::{Edits, Insertion, Program, Replacements, Settings, Shape, Source, Target};
use std::collections::BTreeMap;

/// A program with fake targets, not yet written.
#[derive(Debug)]
pub struct Compensation {
    /// The program as it was read.
    pub program: Program,
    /// What its language had to know besides the files.
    pub settings: Settings,
    /// SHA-256 of each source, for the marker.
    pub source_sha256: Vec<String>,
    /// What became of each of its targets; none with [`super::Options::summary_only`].
    pub targets: Vec<TargetReport>,
    /// What a person should look at, by file and place.
    pub findings: Vec<Finding>,
    /// The changes to each source.
    pub edits: Vec<Edits>,
    /// Whether each source has targets that now are compensated, changed or not.
    pub compensated: Vec<bool>,
    /// Whether each source has an error, or shares data or calls with one that has.
    pub refused: Vec<bool>,
    /// Targets and moves that were put between those of the program.
    pub added: Added,
    /// Edits of files before moves and targets were put into them, by file.
    pub(super) untouched: BTreeMap<usize, Edits>,
    /// What the moves of a file put into it and into others: the file of the moves and that of the
    /// text.
    pub(super) put_in: BTreeMap<(usize, usize), Replacements>,
    /// What was put in, by move.
    pub(super) inserted: BTreeMap<usize, Insertion>,
    /// The controller's joints at targets that moves were given for their own, by move.
    pub(crate) own_joints: BTreeMap<usize, [f64; 6]>,
    /// How far off the point may land that only the running program knows, by the move to it, metres;
    /// infinite where nothing bounds it.
    pub(crate) derived_off: BTreeMap<usize, f64>,
    /// How far targets with each tool may be shifted; none for tools without a target that is.
    pub(crate) shift_limits: Vec<Option<Separation>>,
    /// Configuration data that were written: index in the program's numbers, and the value.
    pub meant: Vec<(u32, f64)>,
    /// What was decided against a default, for the marker.
    pub decided: Vec<String>,
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

/// Targets and moves that were put between those of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Added {
    /// Moves; an arc is two, to the point that it passes through and to its end.
    pub moves: usize,
    /// How many arcs are among them.
    pub arcs: usize,
    /// The numbers of each target, in the order of [`crate::program::Language::roles`]; 0 for
    /// configuration data.
    pub targets: Vec<Vec<f64>>,
    /// Targets of the program whose moves have others now: some languages know no target that
    /// nothing goes to.
    pub freed: Vec<usize>,
}

impl Added {
    /// Paths: an arc is one.
    #[must_use]
    pub fn paths(&self) -> usize {
        self.moves - self.arcs
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
    /// Largest distance from the wanted pose with the targets as they were.
    pub max_before_m: f64,
    /// Their mean.
    pub mean_before_m: f64,
    /// Mean distance from the wanted pose with the numbers as written.
    pub mean_after_m: f64,
    /// Largest residual of the search.
    pub max_residual_m: f64,
    /// Farthest landing from the wanted pose with the numbers as written.
    pub max_rounding_m: f64,
    /// Likewise its largest turn, radians.
    pub max_rounding_rad: f64,
    /// Targets whose search ended by the pose shift alone.
    pub by_pose_shift: usize,
    /// Targets whose search ended by damped Newton.
    pub by_newton: usize,
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
    /// How far from the wanted pose the real tool lands with the target as it was; `None` where that is
    /// not known.
    pub before: Option<Separation>,
    /// The residual of the search.
    pub residual: Separation,
    /// Likewise with the numbers as written.
    pub rounding: Option<Separation>,
    /// Evaluations of the real model.
    pub iterations: u32,
    /// Those of the pose shift.
    pub shift_evaluations: u32,
    /// Those of damped Newton.
    pub newton_evaluations: u32,
    /// By which method the search ended; `None` where there was none.
    pub method: Option<Method>,
    /// The branch of the inverse.
    pub branch: Option<Branch>,
    /// How the search ended; `None` where there was none.
    pub status: Option<Status>,
    /// Its text changes.
    pub changed: bool,
}

impl TargetReport {
    pub(super) fn new(solved: Option<&Solved>) -> Self {
        let none = Separation::default();
        let outcome = solved.map(|solved| solved.outcome);
        Self {
            tool: None,
            frame: None,
            fake: None,
            q: outcome.map(|outcome| outcome.q),
            shift: none,
            before: None,
            residual: outcome.map_or(none, |outcome| outcome.residual),
            rounding: None,
            iterations: outcome.map_or(0, |outcome| outcome.iterations),
            shift_evaluations: outcome.map_or(0, |outcome| outcome.shift_evaluations),
            newton_evaluations: outcome.map_or(0, |outcome| outcome.newton_evaluations),
            method: outcome.map(|outcome| outcome.method),
            branch: solved.map(|solved| solved.approach.branch),
            status: outcome.map(|outcome| outcome.status),
            changed: false,
        }
    }
}

/// Counts what became of the targets.
pub(super) struct Tally {
    summary: Summary,
    /// All shifts added up, metres.
    shifts_m: f64,
    /// Targets that were solved, and their distances from the wanted pose before and after, added
    /// up, metres.
    solved: usize,
    before_m: f64,
    after_m: f64,
    compensated: Vec<bool>,
}

impl Tally {
    /// Nothing is changed yet.
    pub(super) fn new(job: &Job) -> Self {
        let is_own = |target: &&Target| !job.ground.sources[target.file as usize].is_context;
        let targets = || job.ground.program.targets.iter().filter(is_own);
        let is_joints = |target: &&Target| target.layout.shape == Shape::Joints;
        Self {
            summary: Summary {
                targets: targets().count(),
                joint_targets: targets().filter(is_joints).count(),
                ..Summary::default()
            },
            shifts_m: 0.0,
            solved: 0,
            before_m: 0.0,
            after_m: 0.0,
            compensated: vec![false; job.ground.sources.len()],
        }
    }

    /// Adds one target.
    pub(super) fn add(&mut self, job: &Job, target: usize, report: &TargetReport) {
        let target = &job.ground.program.targets[target];
        let summary = &mut self.summary;
        if report.changed {
            summary.compensated += 1;
            summary.joint_targets -= usize::from(target.layout.shape == Shape::Joints);
            self.shifts_m += report.shift.distance_m;
        }
        if report.status == Some(Status::Converged) {
            self.solved += 1;
            match report.method {
                Some(Method::PoseShift) => summary.by_pose_shift += 1,
                Some(Method::Newton) => summary.by_newton += 1,
                None => {}
            }
            let [before, after] = [report.before, report.rounding].map(Option::unwrap_or_default);
            self.before_m += before.distance_m;
            self.after_m += after.distance_m;
            summary.max_before_m = summary.max_before_m.max(before.distance_m);
            self.compensated[target.file as usize] = true;
            summary.max_shift_m = summary.max_shift_m.max(report.shift.distance_m);
            summary.max_residual_m = summary.max_residual_m.max(report.residual.distance_m);
            summary.max_rounding_m = summary.max_rounding_m.max(after.distance_m);
            summary.max_rounding_rad = summary.max_rounding_rad.max(after.angle_rad);
        }
    }

    /// Which sources have compensated targets, and the numbers of the whole.
    pub(super) fn finish(self) -> (Vec<bool>, Summary) {
        let mut summary = self.summary;
        summary.unchanged = summary.targets - summary.compensated;
        if summary.compensated > 0 {
            summary.mean_shift_m = self.shifts_m / summary.compensated as f64;
        }
        if self.solved > 0 {
            summary.mean_before_m = self.before_m / self.solved as f64;
            summary.mean_after_m = self.after_m / self.solved as f64;
        }
        (self.compensated, summary)
    }
}

/// Names each target's first tool and frame.
pub(super) fn name_places(job: &Job, reports: &mut [TargetReport]) {
    for motion in job.ground.program.moves.iter().rev() {
        if let Some(report) = motion.target.and_then(|target| reports.get_mut(target)) {
            (report.tool, report.frame) = (Some(small(motion.tool)), Some(small(motion.frame)));
        }
    }
}

/// Brings findings into the order of the files.
pub(super) fn sort(sources: &[Source], findings: &mut Vec<Finding>) {
    let names = sources.iter().enumerate();
    let order: BTreeMap<&str, usize> = names.map(|(i, s)| (s.name.as_str(), i)).collect();
    findings.sort_by_cached_key(|f| (order.get(f.file.as_str()).copied(), f.line, f.column, f.id));
    findings.dedup();
}

/// An index that is kept small.
pub(super) fn small(index: usize) -> u32 {
    u32::try_from(index).expect("a program's text is below 4 GiB")
}
