//! Wanted target → fake target: the heart.
//!
//! For each target of a program, with its tool and work frame:
//!
//! ```text
//! W = world_from_frame · frame_from_tool              the wanted pose: the target as the file has it
//!     (work_offset · W where the part stands elsewhere than in the simulation)
//! q = the joints with which the real arm reaches W    pose shift on the branch that the program means
//! F = controller_forward(q)                           where the controller believes to be then
//! fake target = world_from_frame⁻¹ · F
//! ```
//!
//! External axes put the base and the frame elsewhere at each target ([`crate::motion`]): both
//! poses are then those that an arm with its base at home sees.
//!
//! Each step is one file. [`crate::motion`] says with what and in which posture the robot comes to
//! each target; `approach` lists the approaches, `solve` finds the joints (`singular` at
//! the wrist's singularity), `shared` one set of numbers for all approaches (`differing` says why
//! there is none), `limit` what a correction may be; `rewrite` puts the new numbers in the place of
//! the old ones, `added` new targets between them, `displaced` says what a correction does to points
//! that the program derives from a target, `deciding` that it decides by numbers of one, `ends` how
//! joints with backlash come to the end of each path between fake targets, `postures` where the
//! controller comes there in other joints, `led` what may leave the robot elsewhere before a move;
//! `written` puts it all into the files and reads them again.
//! `context` and `refused` say which files stay.
//!
//! # Source
//! A. Nubiola, I. A. Bonev (2014), see [`crate::inverse`].
//!
//! # Example
//!
//! ```
//! use poseshift_programs::compensate::{Options, compensate};
//! use poseshift_profile::Profile;
//! use poseshift_programs::program::{Source, language_of};
//!
//! let profile = Profile::from_yaml(include_str!("../../../../robots/abb_irb120_thesis.yaml"))?;
//! let text = include_bytes!("../../../../programs/rapid/olp/in/Deburr.mod");
//! let sources = [Source::new("Deburr.mod", text.to_vec())];
//! let language = language_of(&sources[0]).expect("a language");
//! let done = compensate(language, &sources, &profile, &Options::default())?;
//! assert!(!done.is_refused() && done.summary.mean_after_m < 0.01 * done.summary.mean_before_m);
//! let written = done.written(language, &sources, "", false)?;
//! assert_ne!(written.sources[0].bytes, text);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod added;
mod approach;
mod context;
mod curves;
mod deciding;
mod differing;
mod displaced;
mod ends;
mod led;
mod limit;
mod middles;
mod outcome;
mod portions;
mod postures;
mod refused;
mod remarks;
mod rewrite;
mod shared;
mod singular;
mod solve;
mod split;
mod strange;
mod strides;
#[cfg(test)]
mod tests;
mod written;

use limit::Limits;
pub(crate) use limit::MOST as MOST_SHIFT;
pub use outcome::{Added, Compensation, Summary, TargetReport};
use portions::{Rewritten, rewrite_all};
use split::Split;
pub use written::{Check, Differs, Written};

use crate::finding::{Acceptance, Finding, Severity, accept};
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::geometry::{Pose, Separation};
pub use crate::inverse::Methods;
use crate::inverse::Unsupported;
use crate::model::effects::Effect;
use crate::motion::ground::Ground;
use crate::motion::passed::Fakes;
use crate::motion::sides::{self, LEAST_SIDE_M};
use crate::motion::walk::{self, WalkOptions};
pub use crate::motion::{Given, GivenError, MeasuredFrameError, PlacementError};
use crate::motion::{external, plausibility, setting, unreached};
use crate::profile::Profile;
pub use crate::program::meaning;
use crate::program::{Language, Move, ReadError, Source, sha256};
use std::collections::{BTreeMap, BTreeSet};

/// How far points that are derived from a target may land off their wanted pose by default, metres.
const LIMIT_DERIVED_M: f64 = 0.05 * MM;
/// Angles of a positioner that differ by less are the same.
const SAME_ANGLE_RAD: f64 = 1e-9;

/// What the user decides.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Tools and work frames for names that the program files do not tell.
    pub given: Given,
    /// Where the part really stands: moves every wanted pose in the world, `W' = work_offset · W`
    /// (FROM: as simulated; TO: as measured). The controller's frames stay what they are.
    pub work_offset: Option<Pose>,
    /// Shift joint targets too.
    pub correct_joint_targets: bool,
    /// At least so many decimals of a millimetre, and as many of other units as that is worth.
    pub decimals: Option<usize>,
    /// Report on the whole only, not on each target: a long program needs less memory.
    pub summary_only: bool,
    /// Rewrite targets that are marked as taught on a robot whose controller corrects them itself.
    pub accept_absolutely_accurate: bool,
    /// How far points that the running program derives from a target may land off their wanted
    /// pose, metres; 0.05 mm where it is not given.
    pub max_derived_error_m: Option<f64>,
    /// Write a target out at each of its moves where one set of numbers does not serve all.
    pub split_targets: bool,
    /// What becomes of a target at the wrist's singularity that the real arm does not reach on the
    /// meant side.
    pub at_singularity: AtSingularity,
    /// Errors that the user takes.
    pub accepted: Vec<Acceptance>,
    /// A tool or frame that is not known is an error of the programs that use it, and does not
    /// stop the others.
    pub each_for_itself: bool,
    /// The joints in which the robot stands when a program starts, radians.
    pub start_joints: Option<[f64; 6]>,
    /// Where the external axes that the profile lists stand then, metres and radians; empty where
    /// that is not said.
    pub start_external: Vec<f64>,
    /// Which methods may search the joints of the real arm.
    pub methods: Methods,
    /// How far a correction may shift a target; without it ten times what the profile's effects
    /// usually do, and at most 20 mm and 2 degrees.
    pub max_shift: Option<Separation>,
}

impl Options {
    /// What differs from the defaults so that a reader of the file should know it.
    fn decided(&self) -> Vec<String> {
        let mut decided = Vec::new();
        if let Some(limit_m) = self
            .max_derived_error_m
            .filter(|limit| *limit > LIMIT_DERIVED_M)
        {
            decided.push(format!("max-derived-error {}", tidy(mm_from_m(limit_m))));
        }
        if let Some(offset) = &self.work_offset {
            let by = offset.separation(&Pose::identity());
            decided.push(in_marker("work-offset", &by));
        }
        match self.at_singularity {
            AtSingularity::Refuse => {}
            AtSingularity::Flip => decided.push("at-singularity flip".into()),
            AtSingularity::Nearest => decided.push("at-singularity nearest".into()),
        }
        decided
    }
}

/// What becomes of a target at the wrist's singularity that the real arm does not reach on the
/// meant side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AtSingularity {
    /// It is an error, which says what the others would give.
    #[default]
    Refuse,
    /// Joint 5 goes through zero: the tool lands, the configuration is another.
    Flip,
    /// Joint 4 stays where the nominal arm has it: the tip lands, the orientation nearly.
    Nearest,
}

/// Why nothing could be compensated.
#[derive(Debug, thiserror::Error)]
pub enum CompensateError {
    /// The program cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A tool or frame is unknown.
    #[error(transparent)]
    Placement(#[from] PlacementError),
    /// A tool or work frame is refused, without which the moves cannot be walked.
    #[error("{}:{}:{}: {}", .0.file, .0.line, .0.column, .0.message)]
    Refused(Box<Finding>),
    /// A measured work frame cannot be meant.
    #[error(transparent)]
    MeasuredFrame(#[from] MeasuredFrameError),
    /// A tool or work frame is given that none is needed for.
    #[error(transparent)]
    Given(#[from] GivenError),
    /// A tool, load or work frame is out of all bounds.
    #[error(transparent)]
    OutOfBounds(#[from] plausibility::OutOfBounds),
    /// The arm has no closed-form inverse.
    #[error(transparent)]
    Arm(#[from] Unsupported),
    /// There is nothing to correct.
    #[error(
        "the profile has no effect that moves the tool in a program (of time and temperature a program \
         says nothing): it would be marked as compensated and be the same"
    )]
    NothingToCorrect,
    /// The part is moved in the world, and a positioner rotates it in between.
    #[error(
        "{file}:{line}: --work-offset moves the part in the world, and positioner `{positioner}`, \
         which carries it, stands elsewhere here than in line {other_line}"
    )]
    OffsetOnPositioner {
        /// The file.
        file: String,
        /// The line of the move.
        line: usize,
        /// The positioner.
        positioner: String,
        /// The line of a move at which it stands elsewhere.
        other_line: usize,
    },
    /// Not one of several targets can be reached from where the base stands, but from the origin
    /// they can.
    #[error(
        "none of the {targets} targets is within reach from kinematics.base, which is at ({:.0}, \
         {:.0}, {:.0}) mm; with the base at the \
         origin {in_reach} are",
        base_mm[0], base_mm[1], base_mm[2]
    )]
    BaseElsewhere {
        /// How many there are.
        targets: usize,
        /// How many can be reached from the origin.
        in_reach: usize,
        /// Where the base stands.
        base_mm: [f64; 3],
    },
    /// Not one of several targets can be reached with the rail as the profile has it, but with
    /// another direction, or another rotation of the base, they can.
    #[error(
        "none of the {targets} targets is within reach; with {instead}, which the profile has \
         otherwise, {fit} are where their configuration data say"
    )]
    RailElsewhere {
        /// How many there are.
        targets: usize,
        /// How many fit.
        fit: usize,
        /// With what.
        instead: String,
    },
    /// Not one of several targets can be reached.
    #[error("none of the {targets} targets is within reach: is this the profile of this robot?")]
    NothingInReach {
        /// How many there are.
        targets: usize,
    },
}

/// A part on a positioner is moved in the world where the positioner stands alike at all moves.
fn check_offset(ground: &Ground, needs: impl Fn(&Move) -> bool) -> Result<(), CompensateError> {
    let external = &ground.profile.external;
    let mut first: Option<(&Move, usize, &[f64])> = None;
    for motion in ground.program.moves.iter().filter(|motion| needs(motion)) {
        let stand = ground.stand_in(motion.frame);
        let Some((stand, at)) = stand.and_then(|stand| Some((stand, stand.positioner?))) else {
            continue;
        };
        let own = external.first_of(at);
        let values = &stand.values[own..own + external.positioners[at].axes.len()];
        let Some((before, other, known)) = first else {
            first = Some((motion, at, values));
            continue;
        };
        let is_alike = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME_ANGLE_RAD;
        if at != other || !values.iter().zip(known).all(is_alike) {
            return Err(CompensateError::OffsetOnPositioner {
                file: ground.sources[motion.file as usize].name.clone(),
                line: ground.line_of(motion),
                positioner: external.positioners[at].name.clone(),
                other_line: ground.line_of(before),
            });
        }
    }
    Ok(())
}

/// What every step looks at.
struct Job<'a> {
    ground: Ground<'a>,
    options: &'a Options,
    limits: Limits,
    /// Targets of arcs on which external axes move.
    ridden: BTreeSet<usize>,
}

/// Where the controller passes the points of arcs on which external axes move follows from their fake
/// targets, and these from where it passes them.
#[derive(Default)]
struct Rounds {
    /// The fake targets of the last round.
    fakes: Fakes,
    /// Whether there are such arcs.
    is_ridden: bool,
    /// Part of a trial, which asks nothing of other profiles itself.
    is_trial: bool,
}

/// Rounds in which the fake targets of such arcs and the places where they are passed are found: the
/// corrections of two places hardly differ, so each leaves little of what the one before was off.
const MOST_ROUNDS: usize = 3;

/// Computes fake targets for a program and the edits that put them in its files.
///
/// # Errors
/// If the program cannot be read, a tool or frame is unknown, the arm has no inverse, or the
/// profile corrects nothing. A target that cannot be compensated is a [`Finding`] of severity error
/// instead.
///
/// # Panics
/// By a fault of poseshift alone: hashing fails on no bytes.
pub fn compensate(
    language: &dyn Language,
    sources: &[Source],
    profile: &Profile,
    options: &Options,
) -> Result<Compensation, CompensateError> {
    let mut rounds = Rounds::default();
    for _ in 1..MOST_ROUNDS {
        let done = with(language, sources, profile, options, &mut rounds)?;
        if !rounds.is_ridden {
            return Ok(done);
        }
    }
    with(language, sources, profile, options, &mut rounds)
}

/// A round of [`compensate`].
fn with(
    language: &dyn Language,
    sources: &[Source],
    profile: &Profile,
    options: &Options,
    rounds: &mut Rounds,
) -> Result<Compensation, CompensateError> {
    let settings = external::settings_of(profile, options.accept_absolutely_accurate);
    // the files are hashed while they are read
    let mut source_sha256 = Vec::new();
    let read = rayon::in_place_scope(|scope| {
        let hashes = sources.iter().map(|source| sha256(&source.bytes));
        scope.spawn(|_| source_sha256 = hashes.collect());
        crate::motion::read(language, sources, &settings)
    });
    let mut program = read?;
    program.shrink_to_fit();
    let mut findings = std::mem::take(&mut program.findings);
    if program.targets.is_empty()
        && let Some(source) = sources.first()
    {
        let message = "no target in this program: nothing is changed".to_owned();
        let hint = "a program that calls others is compensated together with them";
        findings.push(source.finding(0, "no-targets", Severity::Warning, message, hint));
    }
    let joints = options.correct_joint_targets;
    context::leave(&mut program, sources, joints, &mut findings);
    let ridden = external::settle(
        (language, &settings),
        &mut program,
        sources,
        (profile, &[]),
        (&options.given, &options.start_external),
        &rounds.fakes,
        &mut findings,
    );
    rounds.is_ridden = !ridden.is_empty();
    setting::check_measured(&program, &options.given)?;
    setting::check_given(language, profile, &[&program], &options.given)?;
    unreached::leave(
        language,
        &mut program,
        sources,
        (profile, &options.given),
        &mut findings,
        |program, motion| approach::needs(program, joints, motion),
    );
    if options.each_for_itself {
        setting::block_unplaced(
            language,
            &mut program,
            sources,
            profile,
            &options.given,
            &mut findings,
            |program, motion| approach::needs(program, joints, motion),
        );
    }
    let mut ground = Ground::new::<CompensateError>(
        language,
        &settings,
        &program,
        sources,
        profile,
        &options.given,
        |motion| approach::needs(&program, joints, motion),
    )?;
    if let Some(offset) = &options.work_offset {
        let is_moved = *offset != Pose::identity();
        check_offset(&ground, |motion| {
            is_moved && approach::needs(&program, joints, motion)
        })?;
        ground.move_part(offset);
        if is_moved && !joints {
            findings.extend(remarks::staying(&ground));
        }
    }
    plausibility::bounds(&ground)?;
    plausibility::units(&ground, Severity::Error, &mut findings);
    plausibility::names(&ground, &mut findings);
    plausibility::models(&ground, &mut findings);
    plausibility::left_out(&ground, &mut findings);
    let limits = Limits::new(&ground, options.max_shift);
    let job = Job {
        ground,
        options,
        limits,
        ridden,
    };
    let walk_options = WalkOptions {
        start_joints: options.start_joints,
        directed: solve::is_directed(&job),
        corrects: true,
        corrects_joints: job.options.correct_joint_targets,
        ..WalkOptions::default()
    };
    let arrivals = walk::walk(&job.ground, &walk_options, &mut findings);
    let mut approaches = approach::gather(&job, &arrivals, &mut findings);
    if !rounds.is_trial {
        let strange = strange::look(&job, &findings, &|profile: &Profile| {
            let mut trial = Rounds {
                is_trial: true,
                ..Rounds::default()
            };
            let found = with(language, sources, profile, options, &mut trial);
            found.map(|found| found.findings)
        });
        findings.extend(strange?);
    }
    let counting = |mut effects: Vec<Effect>| {
        effects.retain(plausibility::counts);
        effects
    };
    let is_same = counting(profile.real_effects()) == counting(profile.controller_effects());
    if options.work_offset.is_none() && is_same {
        return Err(CompensateError::NothingToCorrect);
    }
    let (outcomes, ends) = solve::solve(
        &job,
        &arrivals,
        &walk_options,
        &mut approaches,
        &mut findings,
    );
    if solve::is_directed(&job) {
        findings.extend(remarks::corners(&job, &approaches));
    }
    let derived = if let Some(ends) = ends {
        let taken_up = ends.take_up(&job, &arrivals, &walk_options);
        taken_up.report(&job, &ends, &arrivals, &mut findings);
        curves::report(&job, &arrivals, &walk_options, &ends, &mut findings);
        displaced::arrivals(&job, &arrivals, &|at| {
            taken_up.sides(&job, &ends, &arrivals, at)
        })
    } else {
        displaced::arrivals(&job, &arrivals, &|_| [0; 6])
    };
    sides::revisits(&job.ground, &arrivals, &walk_options, &mut findings);
    drop(arrivals);
    let Rewritten {
        reports: mut targets,
        edits,
        tally,
        fakes,
        deciding: shifts,
        mut splits,
        mut meant,
        needed,
    } = rewrite_all(&job, &approaches, &outcomes, &mut findings);
    limit::advise(&mut findings, &needed);
    let derived_off = displaced::check(&job, &derived, &approaches, &fakes, &mut findings);
    deciding::check(&job, &shifts, &mut findings);
    rounds.fakes = fakes;
    rounds.fakes.retain(|target, _| job.ridden.contains(target));
    drop((approaches, outcomes));
    outcome::name_places(&job, &mut targets);
    let (compensated, summary) = tally.finish();
    let shift_limits = job.limits.asked_for();
    splits.sort_unstable_by_key(|split| split.insertion.motion);
    meant.sort_unstable_by_key(|(index, _)| *index);
    let mut compensation = Compensation {
        program,
        settings,
        source_sha256,
        targets,
        findings,
        edits,
        compensated,
        refused: Vec::new(),
        added: Added::default(),
        untouched: BTreeMap::new(),
        put_in: BTreeMap::new(),
        inserted: BTreeMap::new(),
        own_joints: BTreeMap::new(),
        derived_off,
        shift_limits,
        meant,
        decided: (options.max_shift.iter())
            .map(|limit| in_marker("max-shift", limit))
            .collect(),
        summary,
    };
    compensation.decided.extend(options.decided());
    compensation.split(language, sources, &splits);
    compensation.judge(sources, &options.accepted);
    Ok(compensation)
}

/// Without the rounding of a unit.
fn tidy(number: f64) -> f64 {
    (number * 1e6).round() / 1e6
}

/// A shift as the marker has it.
fn in_marker(what: &str, by: &Separation) -> String {
    format!(
        "{what} {}mm,{}deg",
        tidy(mm_from_m(by.distance_m)),
        tidy(by.angle_rad / DEG)
    )
}

impl Compensation {
    /// Gives moves that share a target targets of their own.
    fn split(&mut self, language: &dyn Language, sources: &[Source], splits: &[Split]) {
        if splits.is_empty() {
            return;
        }
        let program = std::mem::take(&mut self.program);
        for file in 0..sources.len() {
            let of_file: Vec<&Split> = splits
                .iter()
                .filter(|split| program.moves[split.insertion.motion].file as usize == file)
                .collect();
            if of_file.is_empty() {
                continue;
            }
            let insertions: Vec<_> = of_file
                .iter()
                .map(|split| split.insertion.clone())
                .collect();
            let done = self.insert(language, sources, &program, file, &insertions);
            for (split, is_done) in of_file.iter().zip(done) {
                if is_done {
                    self.own_joints.insert(split.insertion.motion, split.joints);
                } else {
                    self.findings.push(split.refusal.clone());
                }
            }
        }
        self.program = program;
    }

    /// Looks at all findings: brings them into the order of the files, takes what the user accepts,
    /// tells which files are refused. Who adds findings later calls it again.
    pub fn judge(&mut self, sources: &[Source], accepted: &[Acceptance]) {
        let of_context = |finding: &Finding| {
            let mut of = sources.iter().filter(|source| source.name == finding.file);
            of.next().is_some_and(|source| source.is_context)
        };
        if sources.iter().any(|source| source.is_context) {
            self.findings.retain(|finding| !of_context(finding));
        }
        self.findings
            .retain(|finding| finding.id != "acceptance-unused");
        let (idle, taken) = accept(&mut self.findings, accepted);
        // what an earlier look took is no error any more
        let is_open = |acceptance: &&&Acceptance| {
            !self
                .decided
                .contains(&format!("accepted {}", acceptance.id()))
        };
        let idle: Vec<Finding> = idle
            .iter()
            .filter(is_open)
            .map(|acceptance| acceptance.idle(sources.first().map_or("", |source| &source.name)))
            .collect();
        self.findings.extend(idle);
        self.decided
            .extend(taken.iter().map(|id| format!("accepted {id}")));
        self.decided.sort_unstable();
        self.decided.dedup();
        outcome::sort(sources, &mut self.findings);
        self.refused = refused::files(&self.program, sources, &self.findings);
    }
}
