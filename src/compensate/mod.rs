//! Wanted target → fake target: the heart.
//!
//! For each target of a program, with its tool and work frame:
//!
//! ```text
//! W = world_from_frame · frame_from_tool              the wanted pose: the target as the file has it
//! q = the joints with which the real arm reaches W    pose shift on the branch that the program means
//! F = controller_forward(q)                           where the controller believes to be then
//! fake target = world_from_frame⁻¹ · F
//! ```
//!
//! Each step is one file: [`placement`] finds the tool and frame of each target, [`posture`] the branch of the inverse that
//! the program means, [`rewrite`] puts the new numbers in the place of the old ones and reads them back to tell what
//! rounding costs, [`displaced`] tells what a correction does to points that the program derives from a target.
//!
//! # Source
//! A. Nubiola, I. A. Bonev (2014), see [`crate::inverse`].

mod displaced;
mod outcome;
mod placement;
mod posture;
mod rewrite;

pub use outcome::{Compensation, Summary, TargetReport, meaning};
pub use placement::{Given, PlacementError};

use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::inverse::{Arm, Branch, Inverse, Outcome, Targets, Unsupported, solve_batch};
use crate::model::profile::{Mounted, Profile};
use crate::model::{Conditions, Model};
use crate::program::{Language, Program, ReadError, Settings, Source};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Targets solved by one thread at a time.
const CHUNK: usize = 2048;

/// What the user decides.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Tools and work frames for names that the program files do not tell.
    pub given: Given,
    /// Shift joint targets too.
    pub correct_joint_targets: bool,
    /// At least so many decimals of a millimetre, and as many of other units as that is worth.
    pub decimals: Option<usize>,
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
    /// The arm has no closed-form inverse.
    #[error(transparent)]
    Arm(#[from] Unsupported),
}

/// What every step looks at.
struct Job<'a> {
    language: &'a dyn Language,
    settings: &'a Settings,
    program: &'a Program,
    sources: &'a [Source],
    profile: &'a Profile,
    options: &'a Options,
    /// The arm with each of the program's tools that a target needs.
    arms: Vec<Option<Equipped>>,
}

/// An arm with one of the program's tools.
struct Equipped {
    arm: Arm,
    controller: Model,
    /// The inverse of a controller that computes with a calibrated chain of its own.
    calibrated_controller: Option<Inverse>,
    /// The real arm without conditions.
    inverse: Inverse,
}

/// A target whose tool, frame and branch are known.
#[derive(Clone, Copy, Debug)]
struct Task {
    /// Index in [`Program::targets`].
    target: usize,
    /// Index of its tool.
    tool: usize,
    world_from_frame: Pose,
    /// Where the simulation wants the tool, in the world.
    wanted: Pose,
    branch: Branch,
    /// The controller's joints at the wanted pose.
    nominal_q: [f64; 6],
    /// Direction in which each joint last moved, where an effect depends on it.
    direction: [i8; 6],
}

impl Job<'_> {
    fn equipped(&self, tool: usize) -> &Equipped {
        self.arms[tool]
            .as_ref()
            .expect("an arm was made for each tool that a target needs")
    }

    /// The conditions of one task.
    fn conditions(&self, task: &Task) -> Conditions {
        Conditions {
            direction: task.direction.map(f64::from),
            ..self.equipped(task.tool).inverse.conditions
        }
    }

    /// A finding at a byte of a source.
    fn finding(
        &self,
        id: &'static str,
        severity: Severity,
        file: u32,
        offset: u32,
        message: String,
        hint: &str,
    ) -> Finding {
        let source = &self.sources[file as usize];
        let (line, column) = source.line_column(offset as usize);
        Finding {
            id,
            severity,
            file: source.name.clone(),
            line,
            column,
            message,
            hint: hint.into(),
        }
    }

    /// A finding at a target.
    fn at_target(
        &self,
        id: &'static str,
        severity: Severity,
        target: usize,
        message: String,
        hint: &str,
    ) -> Finding {
        let target = &self.program.targets[target];
        self.finding(id, severity, target.file, target.offset, message, hint)
    }
}

/// Computes fake targets for a program and the edits that put them in its files.
///
/// # Errors
/// If the program cannot be read, a tool or frame is unknown, or the arm has no closed-form inverse. A target that cannot be
/// compensated is a [`Finding`] of severity error instead.
pub fn compensate(
    language: &dyn Language,
    sources: &[Source],
    profile: &Profile,
    options: &Options,
) -> Result<Compensation, CompensateError> {
    let settings = Settings {
        pulses_per_deg: profile.pulses_per_deg,
        ..Settings::default()
    };
    let mut program = language.read(sources, &settings)?;
    let mut findings = std::mem::take(&mut program.findings);
    let mut job = Job {
        language,
        settings: &settings,
        program: &program,
        sources,
        profile,
        options,
        arms: Vec::new(),
    };
    let places = placement::place(&job, &mut findings)?;
    job.arms = equip(&job, &places)?;
    let tasks = posture::choose(&job, &places, &mut findings);
    drop(places);
    let solved = solve(&job, &tasks);
    displaced::check(&job, &tasks, &solved, &mut findings);
    drop(tasks);
    let (targets, edits, compensated, summary) = outcome::assemble(&job, solved, &mut findings);
    Ok(Compensation {
        program,
        settings,
        targets,
        findings,
        edits,
        compensated,
        summary,
    })
}

/// The arm with each tool that a placed target needs.
fn equip(
    job: &Job,
    places: &[Option<placement::Place>],
) -> Result<Vec<Option<Equipped>>, Unsupported> {
    let mut arms: Vec<Option<Equipped>> = job.program.tools.iter().map(|_| None).collect();
    // the last place is for targets that no move uses but the user gave a tool for
    arms.push(None);
    for place in places.iter().flatten() {
        if arms[place.tool].is_none() {
            arms[place.tool] = Some(mount(job.profile, &place.mounted)?);
        }
    }
    Ok(arms)
}

fn mount(profile: &Profile, tool: &Mounted) -> Result<Equipped, Unsupported> {
    let conditions = Conditions::default();
    let arm = Arm::of(&profile.geometry(tool), &profile.mechanism)?;
    let inverse = Inverse {
        arm: arm.clone(),
        real: profile.real_model(tool, &conditions),
        conditions,
    };
    let controller = profile.controller_model(tool);
    let is_calibrated = !profile.controller_effects().is_empty();
    let calibrated_controller = is_calibrated.then(|| Inverse {
        arm: arm.clone(),
        real: controller.clone(),
        conditions,
    });
    Ok(Equipped {
        arm,
        controller,
        calibrated_controller,
        inverse,
    })
}

/// Solves and rewrites all tasks, those with the same tool and conditions side by side, on all processors; in the order of
/// the targets.
fn solve(job: &Job, tasks: &[Task]) -> Vec<rewrite::Rewritten> {
    let mut alike: BTreeMap<(usize, [i8; 6]), Vec<usize>> = BTreeMap::new();
    for (index, task) in tasks.iter().enumerate() {
        alike
            .entry((task.tool, task.direction))
            .or_default()
            .push(index);
    }
    let fractions = rewrite::fractions(job);
    let chunks: Vec<&[usize]> = alike
        .values()
        .flat_map(|indices| indices.chunks(CHUNK))
        .collect();
    let solved = chunks.par_iter().map(|chunk| {
        let first = &tasks[chunk[0]];
        let inverse = Inverse {
            conditions: job.conditions(first),
            ..job.equipped(first.tool).inverse.clone()
        };
        let wanted: Vec<_> = chunk.iter().map(|&i| tasks[i].wanted).collect();
        let branches: Vec<_> = chunk.iter().map(|&i| tasks[i].branch).collect();
        let near: Vec<_> = chunk.iter().map(|&i| tasks[i].nominal_q).collect();
        let outcomes = solve_batch(
            &inverse,
            Targets {
                wanted: &wanted,
                branches: &branches,
                near: &near,
            },
        );
        let rewrite = |(&index, outcome): (&usize, &Outcome)| {
            rewrite::rewrite(job, &tasks[index], outcome, &fractions)
        };
        chunk.iter().zip(&outcomes).map(rewrite).collect::<Vec<_>>()
    });
    let mut solved: Vec<_> = solved.collect::<Vec<_>>().into_iter().flatten().collect();
    solved.sort_by_key(|rewritten| rewritten.target);
    solved
}
