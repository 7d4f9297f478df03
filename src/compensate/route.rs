//! Where each move of a program ends: the same choice of tool, frame and branch that [`compensate`](super::compensate) makes,
//! move by move.

use super::placement::{Given, Setting};
use super::posture::{self, Path};
use super::{CompensateError, Equipped, Job, Options, Task, equip, placement};
use crate::finding::Finding;
use crate::geometry::Pose;
use crate::inverse::Branch;
use crate::model::profile::{Mounted, Profile};
use crate::program::{Language, Program, Settings, Source, Value};

/// The end of one move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    /// Index of the tool in the program.
    pub tool: usize,
    /// Where the controller believes the tool to be, in the world.
    pub pose: Pose,
    /// The branch of the inverse that the program means.
    pub branch: Branch,
    /// The controller's joint angles, radians.
    pub q: [f64; 6],
    /// Direction in which each joint last moved.
    pub direction: [i8; 6],
}

/// A program with the end of each of its moves.
pub(crate) struct Route {
    pub program: Program,
    pub findings: Vec<Finding>,
    /// By index of the program's moves; `None` where it is unknown where the robot is then.
    pub stops: Vec<Option<Stop>>,
    /// By index of the program's tools.
    pub arms: Vec<Option<Equipped>>,
    /// Likewise, as far as anybody knows them.
    pub tools: Vec<Option<Mounted>>,
    /// `world_from_frame` by index of the program's work frames, likewise.
    pub frames: Vec<Option<Pose>>,
}

/// Reads a program and follows its moves.
pub(crate) fn route(
    language: &dyn Language,
    sources: &[Source],
    profile: &Profile,
    given: &Given,
) -> Result<Route, CompensateError> {
    let settings = Settings {
        pulses_per_deg: profile.pulses_per_deg,
        // nothing is rewritten
        accept_absolutely_accurate: true,
    };
    let mut program = crate::motion::read(language, sources, &settings)?;
    program.shrink_to_fit();
    let mut findings = std::mem::take(&mut program.findings);
    let options = Options {
        given: given.clone(),
        correct_joint_targets: true,
        ..Options::default()
    };
    let setting = Setting::of(language, &program, profile, given);
    let mut job = Job {
        language,
        settings: &settings,
        program: &program,
        sources,
        profile,
        options: &options,
        setting,
        arms: Vec::new(),
    };
    let mut places = Vec::with_capacity(program.moves.len());
    for motion in &program.moves {
        let target = motion.target.map(|target| &program.targets[target]);
        let has_numbers = target.is_some_and(|target| !program.numbers_of(target).is_empty());
        places.push(if has_numbers {
            Some(placement::known(&job, motion)?)
        } else {
            None
        });
    }
    job.arms = equip(&job, &places)?;
    let mut stops: Vec<Option<Stop>> = Vec::with_capacity(places.len());
    let mut path = Path::default();
    for (motion, place) in program.moves.iter().zip(&places) {
        if motion.file != path.file {
            path = Path {
                file: motion.file,
                ..Path::default()
            };
        }
        let start = motion.near.as_deref().copied().or(path.joints);
        let honoured = motion.configured && motion.near.is_none();
        let task = motion.target.and_then(|target| {
            posture::task(
                &job,
                target,
                *place,
                &motion.displacement,
                honoured,
                start,
                &mut findings,
            )
        });
        let stop = task.map(|task| {
            let q = controller_joints(&job, &task);
            path.go(q);
            Stop {
                tool: task.tool,
                pose: task.wanted,
                branch: task.branch,
                q,
                direction: path.direction,
            }
        });
        if stop.is_none() {
            path = Path {
                file: motion.file,
                ..Path::default()
            };
        }
        stops.push(stop);
    }
    let arms = std::mem::take(&mut job.arms);
    let Setting { tools, frames } = job.setting;
    Ok(Route {
        program,
        findings,
        stops,
        arms,
        tools,
        frames,
    })
}

/// The joints that the controller itself computes: with its own calibrated chain where it has one.
fn controller_joints(job: &Job, task: &Task) -> [f64; 6] {
    let decoded = crate::program::meaning(job.language, job.program, job.settings, task.target);
    let is_joints = matches!(decoded.map(|d| d.value), Some(Value::Joints(_)));
    match &job.equipped(task.tool).calibrated_controller {
        Some(controller) if !is_joints => {
            controller
                .solve(&task.wanted, task.branch, &task.nominal_q)
                .q
        }
        _ => task.nominal_q,
    }
}
