//! Where the real robot goes when it runs a program as it is, how far that is from the wanted path,
//! and what it comes near.
//!
//! ```text
//! program → route (compensate) → legs (course) → pieces with bounds
//!                                    ├ deviation   real tool against the wanted path, bounded between samples
//!                                    ├ collision   real and nominal arm against themselves and the cell, likewise
//!                                    └ limits      joint limits, singularities, rates
//! ```
//!
//! The controller interpolates in its own model: joints, straight lines and arcs of the tool; the
//! real model says where the tool and the links are then. Corners (zones) are not rounded: the path
//! is that through the programmed corner, and moves with a zone are marked.
//!
//! # Example
//!
//! ```
//! use poseshift_programs::check::{Options, Scene, Subject, check};
//! use poseshift_profile::Profile;
//! use poseshift_programs::program::{Source, language_of};
//!
//! let profile = Profile::from_yaml(include_str!("../../../../robots/abb_irb120_thesis.yaml"))?;
//! let text = include_bytes!("../../../../programs/rapid/olp/in/Deburr.mod");
//! let sources = [Source::new("Deburr.mod", text.to_vec())];
//! let subject = Subject {
//!     language: language_of(&sources[0]).expect("a language"),
//!     sources: &sources,
//!     nominal: None,
//!     profile: &profile,
//!     scene: &Scene::default(),
//! };
//! let found = check(&subject, &Options::default())?;
//! // run as it is, this robot misses its targets by more than 0.1 mm
//! assert!(found.summary.max_target_error.distance_m > 1e-4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod baseline;
pub mod cell;
pub mod collision;
pub mod deviation;
mod judge;
pub mod limits;
pub mod mesh;
mod mover;
mod nominal;
pub mod passage;
pub mod posture;
mod query;
pub mod refine;
mod scene;
mod sizes;
mod sweep;
pub mod trace;
mod uncertainty;
mod walk;

pub use crate::motion::ToolRotation;
pub use scene::{Meshes, Scene, SceneError};

use crate::compensate::CompensateError;
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::geometry::{Pose, Separation, Vector};
use crate::motion::{Given, setting};
use crate::profile::Profile;
use crate::program::{Language, Motion, Move, Program, Source, SpeedZone};
use collision::Clearance;
use deviation::PathError;
use judge::Job;
use limits::Limits;
use rayon::prelude::*;
use std::collections::HashSet;
use walk::{Stop, Stops, Walk};

/// Moves judged by one thread at a time.
const CHUNK: usize = 16;
/// Moves judged by all of them before these are put to the others.
const BATCH: usize = 4096;

/// What the user decides.
#[derive(Clone, Debug)]
pub struct Options {
    /// Tools and work frames for names that the program files do not tell.
    pub given: Given,
    /// How the controller rotates the tool on straight and circular moves.
    pub turning: ToolRotation,
    /// A path error above this is an error finding, metres.
    pub max_path_error_m: Option<f64>,
    /// Bodies farther apart than this beyond what is required are only known to be, metres.
    pub horizon_m: f64,
    /// A joint nearer to its limits than this is a warning, radians.
    pub limit_margin_rad: f64,
    /// An axis nearer to a singularity than this is a warning, radians.
    pub singularity_rad: f64,
    /// The joints in which the robot stands when a program starts, radians.
    pub start_joints: Option<[f64; 6]>,
    /// Where the external axes that the profile lists stand then, metres and radians; empty where
    /// that is not said.
    pub start_external: Vec<f64>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            given: Given::default(),
            turning: ToolRotation::Slerp,
            max_path_error_m: None,
            horizon_m: 100.0 * MM,
            limit_margin_rad: 1.0 * DEG,
            singularity_rad: 1.0 * DEG,
            start_joints: None,
            start_external: Vec::new(),
        }
    }
}

/// What is checked.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The language of the program.
    pub language: &'a dyn Language,
    /// Its files.
    pub sources: &'a [Source],
    /// The program that says where the tool is wanted; `None` is the program itself.
    pub nominal: Option<&'a [Source]>,
    /// The robot.
    pub profile: &'a Profile,
    /// What stands around it.
    pub scene: &'a Scene,
}

impl Subject<'_> {
    fn finding(
        &self,
        motion: &Move,
        id: &'static str,
        severity: Severity,
        message: String,
        hint: &str,
    ) -> Finding {
        let source = &self.sources[motion.file as usize];
        source.finding(motion.offset as usize, id, severity, message, hint)
    }
}

/// Why nothing could be checked.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// The program, its tools and frames, or the arm.
    #[error(transparent)]
    Program(#[from] CompensateError),
    /// The original program, its tools and frames.
    #[error(transparent)]
    Nominal(CompensateError),
    /// The two programs have not the same moves.
    #[error("{file}:{line}: this move of the original has no counterpart in the program")]
    NoCounterpart {
        /// File of the original.
        file: String,
        /// Line of its move.
        line: usize,
    },
}

/// What a move does.
#[derive(Clone, Debug)]
pub struct MoveReport {
    /// Index in [`Program::moves`].
    pub motion: usize,
    /// Where it ends: index in [`Check::stops`].
    stop: u32,
    /// Its line, from 1.
    pub line: u32,
    /// How far from the wanted pose the real tool ends.
    pub target_error: Separation,
    /// One standard deviation of the real tool's predicted position at its end in the direction of
    /// its error, metres; `None` where the calibration tells no covariance.
    pub uncertainty_m: Option<f64>,
    /// The error along the path; `None` where it is unknown where the move begins.
    pub path: Option<PathError>,
    /// The nearest pair of the real arm; `None` where no bodies were compared.
    pub clearance: Option<Box<Clearance>>,
    /// The pair with the least room, distance less what is required of it; `None` where that is
    /// the nearest.
    pub least_room: Option<Box<Clearance>>,
    /// The least clearance of the arm as the controller, or the simulation, believes it, metres: along
    /// the whole move, and of samples.
    pub nominal_clearance_m: Option<[f64; 2]>,
    /// What it asks of the joints.
    pub limits: Option<Limits>,
}

impl MoveReport {
    /// Its speed and its corner.
    #[must_use]
    pub fn speed_zone(&self, program: &Program) -> SpeedZone {
        program.speed_zone(&program.moves[self.motion])
    }

    /// The pair of the real arm with the least room; `None` where no bodies were compared.
    #[must_use]
    pub fn room(&self) -> Option<&Clearance> {
        self.least_room.as_deref().or(self.clearance.as_deref())
    }

    /// Whether its target is given in joints, which compensation leaves as they are unless it is
    /// asked to shift them.
    #[must_use]
    pub fn in_joints(&self, program: &Program) -> bool {
        !program.goes_to_pose(&program.moves[self.motion])
    }
}

/// Numbers of the whole.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Moves looked at.
    pub moves: usize,
    /// Moves that could not be followed.
    pub unknown: usize,
    /// Largest error at a target.
    pub max_target_error: Separation,
    /// Largest bound of an error along a path.
    pub max_path_error: Separation,
    /// Least clearance, metres; `None` where no bodies were compared.
    pub min_clearance_m: Option<f64>,
    /// Moves of the real arm that touch something.
    pub collisions: usize,
    /// Moves of the nominal arm that touch something.
    pub nominal_collisions: usize,
    /// Moves nearer than required.
    pub too_near: usize,
    /// Moves whose bounds are only those of samples.
    pub uncertified: usize,
    /// Moves with a corner that is cut.
    pub with_zone: usize,
}

impl Check {
    fn stop(&self, report: &MoveReport) -> &Stop {
        let stop = self.stops.all[report.stop as usize].as_ref();
        stop.expect("a move that was followed ends somewhere")
    }

    /// Where the controller believes the tool to be at the end of a move, in the world.
    #[must_use]
    pub fn commanded(&self, report: &MoveReport) -> &Pose {
        self.stops.commanded(self.stop(report))
    }

    /// The point on the path of an arc, in the world.
    #[must_use]
    pub fn via(&self, report: &MoveReport) -> Option<Vector> {
        let is_arc = self.program.moves[report.motion].motion == Motion::ArcEnd;
        let via = self.stops.before(report.stop as usize).filter(|_| is_arc)?;
        let is_via = self.program.moves[self.motions[via] as usize].motion == Motion::ArcVia;
        let stop = self.stops.all[via].as_ref().filter(|_| is_via)?;
        Some(self.stops.commanded(stop).translation)
    }

    /// Where the external axes of the profile stand at the end of a move, millimetres and degrees;
    /// not a number where no pose depends on one.
    #[must_use]
    pub fn external(&self, report: &MoveReport) -> Option<Vec<f64>> {
        let frame = self.program.moves[report.motion].frame;
        let stand = self.program.frames[frame].stand.as_ref()?;
        let values = stand.values.iter().zip(&self.linear);
        let shown = |(value, linear): (&f64, &bool)| match linear {
            true => mm_from_m(*value),
            false => value / DEG,
        };
        Some(values.map(shown).collect())
    }

    /// The controller's joints at the end of a move, radians.
    #[must_use]
    pub fn joints(&self, report: &MoveReport) -> &[f64; 6] {
        &self.stop(report).q
    }
}

/// What a check found.
#[derive(Debug)]
pub struct Check {
    /// The program as it was read, without the numbers of its targets.
    pub program: Program,
    /// Each move that could be followed.
    pub moves: Vec<MoveReport>,
    /// Where the robot stands at the end of moves.
    stops: Stops,
    /// The move of each stop.
    motions: Vec<u32>,
    /// Which of the profile's external axes are linear.
    linear: Vec<bool>,
    /// What a person should look at, by file and place.
    pub findings: Vec<Finding>,
    /// Numbers of the whole.
    pub summary: Summary,
}

impl Check {
    /// Whether the answer is no.
    #[must_use]
    pub fn is_refused(&self) -> bool {
        self.findings.iter().any(|f| f.severity == Severity::Error)
    }
}

/// Follows a program through the real robot.
///
/// # Errors
/// If a program cannot be read, a tool or frame is unknown, the arm has no closed-form inverse, or
/// the original has other moves. What a move does wrong is a [`Finding`].
pub fn check(subject: &Subject, options: &Options) -> Result<Check, CheckError> {
    check_telling(subject, options, &mut |_, _| ())
}

/// As [`check`]; `tell` hears how many of how many moves are done.
///
/// # Errors
/// As [`check`].
pub fn check_telling(
    subject: &Subject,
    options: &Options,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Check, CheckError> {
    let mut walk = Walk::of(subject, subject.sources, options)?;
    let original = subject
        .nominal
        .map(|sources| Walk::of(subject, sources, options))
        .transpose()
        .map_err(CheckError::Nominal)?;
    let of_original = original.iter().map(|original| &original.program);
    let programs: Vec<&Program> = std::iter::once(&walk.program).chain(of_original).collect();
    setting::check_given(subject.language, subject.profile, &programs, &options.given)
        .map_err(CompensateError::from)?;
    let parts = original
        .as_ref()
        .map(|original| nominal::align(&walk, original, subject, options))
        .transpose()?;
    // nothing is rewritten: a million moves take that much less
    walk.program.numbers = Vec::new();
    for target in &mut walk.program.targets {
        target.numbers = 0..0;
    }
    let job = Job {
        subject,
        options,
        walk: &walk,
        original: original.as_ref(),
        parts: parts.as_deref(),
    };
    // where the robot may stop on the way of another move is no move of its own
    let is_own = |stop: &usize| {
        let motion = walk.motion(*stop);
        let is_context = subject.sources[motion.file as usize].is_context;
        !is_context && !walk.program.is_stop(motion)
    };
    let indices: Vec<usize> = (0..walk.stops.all.len()).filter(is_own).collect();
    let mut findings = walk.findings.clone();
    findings.extend(subject.scene.findings.iter().cloned());
    if let Some(original) = &original {
        soften(&mut findings, &original.findings);
    }
    let mut moves = Vec::with_capacity(indices.len());
    // a batch after another: a million moves are in memory once
    for (number, batch) in indices.chunks(BATCH).enumerate() {
        tell(number * BATCH, indices.len());
        let judged: Vec<(Option<MoveReport>, Vec<Finding>)> = batch
            .par_iter()
            .with_min_len(CHUNK)
            .map(|&index| job.judge(index))
            .collect();
        for (report, found) in judged {
            moves.extend(report);
            findings.extend(found);
        }
    }
    findings.extend(not_followed(&job, &indices));
    let order = |file: &str| subject.sources.iter().position(|s| s.name == file);
    findings.sort_by_cached_key(|f| (order(&f.file), f.line, f.column, f.id));
    findings.dedup();
    let contexts = subject.sources.iter().filter(|source| source.is_context);
    let contexts: Vec<&str> = contexts.map(|source| source.name.as_str()).collect();
    findings.retain(|finding| !contexts.contains(&finding.file.as_str()));
    let unknown = indices
        .iter()
        .filter(|stop| walk.stops.all[**stop].is_none());
    let unknown = unknown.count();
    let summary = sum_up(&walk.program, &moves, unknown, subject.scene.is_empty());
    Ok(Check {
        program: walk.program,
        moves,
        stops: walk.stops,
        motions: walk.motions,
        linear: crate::motion::external::settings_of(subject.profile, true)
            .external
            .linear,
        findings,
        summary,
    })
}

/// Moves that could not be followed, and of which nothing else says why.
fn not_followed(job: &Job, stops: &[usize]) -> Vec<Finding> {
    let Job { subject, walk, .. } = job;
    let said = walk.findings.iter().map(|f| (f.file.as_str(), f.line));
    let mut said: HashSet<(&str, usize)> = said.collect();
    let open = stops.iter().filter(|stop| walk.stops.all[**stop].is_none());
    open.filter_map(|stop| {
        let motion = walk.motion(*stop);
        let source = &subject.sources[motion.file as usize];
        let (line, _) = source.line_column(motion.offset as usize);
        said.insert((&source.name, line)).then(|| {
            let message = "where this move goes only the running program knows: it was not checked";
            let hint = "a target of its own, with numbers, is checked";
            subject.finding(
                motion,
                "not-followed",
                Severity::Warning,
                message.into(),
                hint,
            )
        })
    })
    .collect()
}

/// Configurations that the paths of the original do not end in either are those of its simulation:
/// worth a look, no more.
fn soften(findings: &mut [Finding], of_original: &[Finding]) {
    let id = crate::motion::walk::CONFIGURATION_CHANGE;
    let count = |findings: &[Finding]| findings.iter().filter(|f| f.id == id).count();
    if count(of_original) < count(findings) {
        return;
    }
    for finding in findings.iter_mut().filter(|finding| finding.id == id) {
        finding.id = "configuration-mismatch";
        finding.severity = Severity::Warning;
    }
}

/// The larger of two numbers; what is no number is larger than any.
fn larger(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

fn sum_up(program: &Program, moves: &[MoveReport], unknown: usize, no_bodies: bool) -> Summary {
    let worse = |a: Separation, b: Separation| Separation {
        distance_m: larger(a.distance_m, b.distance_m),
        angle_rad: larger(a.angle_rad, b.angle_rad),
    };
    let mut summary = Summary {
        moves: moves.len(),
        unknown,
        ..Summary::default()
    };
    for report in moves {
        summary.max_target_error = worse(summary.max_target_error, report.target_error);
        // of a move that begins nobody knows where the end alone is known
        let path = report
            .path
            .as_ref()
            .map_or(report.target_error, |path| path.bound);
        summary.max_path_error = worse(summary.max_path_error, path);
        let certified = report.path.is_none_or(|p| p.certified)
            && report.clearance.as_ref().is_none_or(|c| c.certified);
        summary.uncertified += usize::from(!certified);
        summary.with_zone += usize::from(report.speed_zone(program).cuts_corner());
        if let Some(c) = report.clearance.as_ref().filter(|_| !no_bodies) {
            let least = summary.min_clearance_m.unwrap_or(f64::INFINITY);
            summary.min_clearance_m = Some(least.min(c.clearance_m));
            summary.collisions += usize::from(c.sampled_m <= 0.0);
            let is_too_near = |room: &Clearance| room.pair.is_some() && room.room_m() < 0.0;
            summary.too_near += usize::from(report.room().is_some_and(is_too_near));
        }
        let nominal = report.nominal_clearance_m;
        summary.nominal_collisions +=
            usize::from(nominal.is_some_and(|[_, sampled]| sampled <= 0.0));
    }
    summary
}
