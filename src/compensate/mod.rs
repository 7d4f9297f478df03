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
//! Each step is one file: `placement` finds the tool and frame of each target, `posture` the branch of the inverse that
//! the program means, `rewrite` puts the new numbers in the place of the old ones and reads them back to tell what
//! rounding costs, `displaced` tells what a correction does to points that the program derives from a target.
//!
//! # Source
//! A. Nubiola, I. A. Bonev (2014), see [`crate::inverse`].

mod displaced;
mod outcome;
mod placement;
mod posture;
mod rewrite;
pub(crate) mod route;

use outcome::Tally;
pub use outcome::{Compensation, Summary, TargetReport, meaning};
pub use placement::{Given, MeasuredFrameError, PlacementError};
use placement::{Place, Setting};
use rewrite::Portion;

use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::inverse::{Arm, Branch, Inverse, Methods, Status, Targets, Unsupported, solve_batch_by};
use crate::model::profile::{Mounted, Profile};
use crate::model::{Conditions, Model};
use crate::program::{Edits, Language, Program, ReadError, Settings, Source, Value};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Targets solved by one thread at a time.
const CHUNK: usize = 512;

/// What the user decides.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Tools and work frames for names that the program files do not tell.
    pub given: Given,
    /// Where the part really stands: moves every wanted pose in the world, `W' = work_offset · W` (FROM: as simulated; TO: as
    /// measured). The controller's frames stay what they are.
    pub work_offset: Option<Pose>,
    /// Shift joint targets too.
    pub correct_joint_targets: bool,
    /// At least so many decimals of a millimetre, and as many of other units as that is worth.
    pub decimals: Option<usize>,
    /// Report on the whole only, not on each target: a long program needs less memory.
    pub summary_only: bool,
    /// Rewrite targets that are marked as taught on a robot whose controller corrects them itself.
    pub accept_absolutely_accurate: bool,
    /// Which methods may search the joints of the real arm.
    pub methods: Methods,
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
    /// A measured work frame cannot be meant.
    #[error(transparent)]
    MeasuredFrame(#[from] MeasuredFrameError),
    /// The arm has no closed-form inverse.
    #[error(transparent)]
    Arm(#[from] Unsupported),
    /// Not one of several targets can be reached.
    #[error("none of the {targets} targets is within reach: is this the profile of this robot?")]
    NothingInReach {
        /// How many there are.
        targets: usize,
    },
}

/// Where fewer targets than this are all out of reach, each is told on its own.
const FEW: usize = 3;

/// What every step looks at.
struct Job<'a> {
    language: &'a dyn Language,
    settings: &'a Settings,
    program: &'a Program,
    sources: &'a [Source],
    profile: &'a Profile,
    options: &'a Options,
    setting: Setting,
    /// The arm with each of the program's tools that a target needs.
    arms: Vec<Option<Equipped>>,
}

/// An arm with one of the program's tools.
pub(crate) struct Equipped {
    pub(crate) arm: Arm,
    pub(crate) controller: Model,
    /// The inverse of a controller that computes with a calibrated chain of its own.
    pub(crate) calibrated_controller: Option<Inverse>,
    /// The real arm without conditions.
    pub(crate) inverse: Inverse,
}

impl Equipped {
    /// The joints that the controller computes for `world_from_tool` near others, and whether they reach it.
    fn controller_joints(
        &self,
        world_from_tool: &Pose,
        branch: Branch,
        near: &[f64; 6],
    ) -> ([f64; 6], bool) {
        match &self.calibrated_controller {
            None => {
                let solution = self.arm.solve_branch(world_from_tool, branch, near);
                (solution.q, solution.beyond == 0.0)
            }
            Some(controller) => {
                let outcome = controller.solve(world_from_tool, branch, near);
                let missed = matches!(outcome.status, Status::OutOfReach | Status::NotConverged);
                (outcome.q, !missed)
            }
        }
    }
}

/// A target whose tool, frame and branch are known.
#[derive(Clone, Copy, Debug)]
struct Task {
    /// Index in [`Program::targets`].
    target: usize,
    /// Index of its tool.
    tool: usize,
    /// Index of its work frame.
    frame: usize,
    /// Where the simulation wants the tool, in the world.
    wanted: Pose,
    branch: Branch,
    /// The controller's joints at the wanted pose.
    nominal_q: [f64; 6],
    /// Direction in which each joint last moved, where an effect depends on it.
    direction: [i8; 6],
    /// The controller goes by the target's configuration data.
    honoured: bool,
}

/// A task as it is kept: all but what the program's text tells again.
#[derive(Clone, Copy, Debug)]
struct Draft {
    nominal_q: [f64; 6],
    target: u32,
    tool: u32,
    frame: u32,
    branch: Branch,
    direction: [i8; 6],
    honoured: bool,
}

impl Draft {
    fn of(task: &Task) -> Self {
        Self {
            nominal_q: task.nominal_q,
            target: outcome::small(task.target),
            tool: outcome::small(task.tool),
            frame: outcome::small(task.frame),
            branch: task.branch,
            direction: task.direction,
            honoured: task.honoured,
        }
    }
}

impl Job<'_> {
    fn equipped(&self, tool: usize) -> &Equipped {
        self.arms[tool]
            .as_ref()
            .expect("an arm was made for each tool that a target needs")
    }

    fn world_from_frame(&self, frame: usize) -> &Pose {
        self.setting.frames[frame]
            .as_ref()
            .expect("a placed target has a known frame")
    }

    /// A pose that the program means, where the part as it stands has it.
    fn on_part(&self, wanted: Pose) -> Pose {
        self.options
            .work_offset
            .map_or(wanted, |offset| offset * wanted)
    }

    /// Where a target's numbers want the tool, in the world.
    fn wanted(&self, value: &Value, tool: usize, frame: usize) -> Pose {
        let controller = &self.equipped(tool).controller;
        self.on_part(match value {
            Value::Joints(q) => controller.forward(q, &Conditions::default()),
            Value::Pose(frame_from_tool) => *self.world_from_frame(frame) * *frame_from_tool,
        })
    }

    /// The task of a draft.
    fn task(&self, draft: &Draft) -> Task {
        let (target, tool, frame) = (draft.target, draft.tool, draft.frame);
        let (target, tool, frame) = (target as usize, tool as usize, frame as usize);
        let decoded = meaning(self.language, self.program, self.settings, target);
        let value = decoded.expect("a task's target has numbers").value;
        Task {
            target,
            tool,
            frame,
            wanted: self.wanted(&value, tool, frame),
            branch: draft.branch,
            nominal_q: draft.nominal_q,
            direction: draft.direction,
            honoured: draft.honoured,
        }
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
        source.finding(offset as usize, id, severity, message, hint)
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
        accept_absolutely_accurate: options.accept_absolutely_accurate,
    };
    let mut program = language.read(sources, &settings)?;
    program.shrink_to_fit();
    let mut findings = std::mem::take(&mut program.findings);
    if program.targets.is_empty()
        && let Some(source) = sources.first()
    {
        let message = "no target in this program: nothing is changed".to_owned();
        let hint = "a program that calls others is compensated together with them";
        findings.push(source.finding(0, "no-targets", Severity::Warning, message, hint));
    }
    placement::check_measured(&program, &options.given)?;
    let setting = Setting::of(language, &program, profile, &options.given);
    let mut job = Job {
        language,
        settings: &settings,
        program: &program,
        sources,
        profile,
        options,
        setting,
        arms: Vec::new(),
    };
    let places = placement::place(&job, &mut findings)?;
    job.arms = equip(&job, &places)?;
    let drafts = posture::choose(&job, &places, &mut findings);
    let placed = places.iter().flatten().count();
    let out_of_reach = findings
        .iter()
        .filter(|finding| finding.id == posture::OUT_OF_REACH)
        .count();
    if placed >= FEW && out_of_reach == placed {
        return Err(CompensateError::NothingInReach { targets: placed });
    }
    drop(places);
    let Solved {
        reports: mut targets,
        edits,
        tally,
        fakes,
    } = solve(&job, &drafts, &mut findings);
    displaced::check(&job, &drafts, &fakes, &mut findings);
    drop(drafts);
    outcome::name_places(&job, &mut targets);
    outcome::sort(&job, &mut findings);
    let (compensated, summary) = tally.finish();
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
fn equip(job: &Job, places: &[Option<Place>]) -> Result<Vec<Option<Equipped>>, Unsupported> {
    let mut arms: Vec<Option<Equipped>> = job.setting.tools.iter().map(|_| None).collect();
    for Place { tool, .. } in places.iter().flatten() {
        if arms[*tool].is_none() {
            let mounted = job.setting.tools[*tool]
                .as_ref()
                .expect("a placed target has a known tool");
            arms[*tool] = Some(mount(job.profile, mounted)?);
        }
    }
    Ok(arms)
}

/// The arm with one tool.
pub(crate) fn mount(profile: &Profile, tool: &Mounted) -> Result<Equipped, Unsupported> {
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

/// What became of all tasks.
struct Solved {
    /// Of each of the program's targets, unless only the summary is asked for.
    reports: Vec<TargetReport>,
    /// Of each source.
    edits: Vec<Edits>,
    tally: Tally,
    /// Fake targets that points are derived from.
    fakes: BTreeMap<usize, Pose>,
}

/// Solves and rewrites all tasks, those with the same tool and conditions side by side, on all processors.
fn solve(job: &Job, drafts: &[Draft], findings: &mut Vec<Finding>) -> Solved {
    let mut alike: BTreeMap<(u32, [i8; 6]), Vec<u32>> = BTreeMap::new();
    for (index, draft) in drafts.iter().enumerate() {
        let same = alike.entry((draft.tool, draft.direction)).or_default();
        same.push(outcome::small(index));
    }
    let fractions = rewrite::fractions(job);
    let chunks: Vec<&[u32]> = alike
        .values()
        .flat_map(|indices| indices.chunks(CHUNK))
        .collect();
    let solve_chunk = |chunk: &&[u32]| {
        let draft = |index: &u32| job.task(&drafts[*index as usize]);
        let tasks: Vec<Task> = chunk.iter().map(draft).collect();
        let inverse = Inverse {
            conditions: job.conditions(&tasks[0]),
            ..job.equipped(tasks[0].tool).inverse.clone()
        };
        let wanted: Vec<_> = tasks.iter().map(|task| task.wanted).collect();
        let branches: Vec<_> = tasks.iter().map(|task| task.branch).collect();
        let near: Vec<_> = tasks.iter().map(|task| task.nominal_q).collect();
        let outcomes = solve_batch_by(
            job.options.methods,
            &inverse,
            Targets {
                wanted: &wanted,
                branches: &branches,
                near: &near,
            },
        );
        let mut portion = Portion::default();
        for (task, outcome) in tasks.iter().zip(&outcomes) {
            portion.add(job, task, outcome, &fractions);
        }
        portion
    };
    let reported = if job.options.summary_only {
        0
    } else {
        job.program.targets.len()
    };
    let bases = displaced::bases(job);
    let mut solved = Solved {
        reports: vec![TargetReport::new(None); reported],
        edits: room_for_edits(job),
        tally: Tally::new(job),
        fakes: BTreeMap::new(),
    };
    // a few chunks for each thread at a time: what they return is not in memory twice for a long program
    for some in chunks.chunks(4 * rayon::current_num_threads()) {
        let portions: Vec<Portion> = some.par_iter().map(solve_chunk).collect();
        for portion in portions {
            for (target, report) in portion.reports {
                solved.tally.add(job, target, &report);
                if let Some(fake) = report.fake.filter(|_| bases.contains(&target)) {
                    solved.fakes.insert(target, fake);
                }
                if reported > 0 {
                    solved.reports[target] = report;
                }
            }
            for (source, changes) in &portion.edits {
                solved.edits[*source as usize].append(changes);
            }
            findings.extend(portion.findings);
        }
    }
    solved
}

/// For each file an empty list with room for new text in place of all numbers of its targets.
fn room_for_edits(job: &Job) -> Vec<Edits> {
    let mut room = vec![(0, 0); job.sources.len()];
    for target in &job.program.targets {
        let (spans, bytes) = &mut room[target.file as usize];
        for number in job.program.numbers_of(target) {
            *spans += 1;
            *bytes += usize::from(number.length) + 1;
        }
    }
    room.into_iter()
        .map(|(spans, bytes)| Edits::with_room(spans, bytes))
        .collect()
}
