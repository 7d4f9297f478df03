//! Points that the running program derives from a target (`Offs`, `RelTool`) take its correction along; here is told how far
//! from their own wanted poses they land.

use super::placement::name_of;
use super::{Draft, Job, Task};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{MM, mm_from_m};
use crate::geometry::{Pose, Separation};
use crate::program::{Displacement, Move};
use std::collections::{BTreeMap, BTreeSet};

/// Landing farther from the wanted pose than this is a warning, metres.
const LIMIT_M: f64 = 0.05 * MM;

fn is_displaced(motion: &Move) -> bool {
    motion.displacement != Displacement::None
}

/// The targets that points are derived from.
pub(super) fn bases(job: &Job) -> BTreeSet<usize> {
    let displaced = job.program.moves.iter().filter(|m| is_displaced(m));
    displaced.filter_map(|motion| motion.target).collect()
}

/// Adds a finding for each move to a displaced target; `fakes` has the fake targets of those that points are derived from.
pub(super) fn check(
    job: &Job,
    drafts: &[Draft],
    fakes: &BTreeMap<usize, Pose>,
    findings: &mut Vec<Finding>,
) {
    for motion in job.program.moves.iter().filter(|m| is_displaced(m)) {
        let Some(target) = motion.target else {
            continue;
        };
        let found = drafts.binary_search_by_key(&target, |draft| draft.target as usize);
        let (Ok(draft), Some(fake)) = (found, fakes.get(&target)) else {
            continue;
        };
        let task = job.task(&drafts[draft]);
        let name = name_of(job, target);
        let finding = match landing(job, &task, fake, motion) {
            None => {
                let message = format!(
                    "a point derived from {name} at run time takes its correction along; how well is unknown"
                );
                let hint = "give the point a target of its own if it must be exact";
                job.finding(
                    "displacement-unknown",
                    Severity::Warning,
                    motion.file,
                    motion.offset,
                    message,
                    hint,
                )
            }
            Some(gap) => {
                let severity = if gap.distance_m > LIMIT_M {
                    Severity::Warning
                } else {
                    Severity::Note
                };
                let message = format!(
                    "a point derived from {name} takes its correction along and lands {:.3} mm beside its own wanted pose",
                    mm_from_m(gap.distance_m)
                );
                let hint = "give the point a target of its own if it must be exact";
                job.finding(
                    "displaced-target",
                    severity,
                    motion.file,
                    motion.offset,
                    message,
                    hint,
                )
            }
        };
        findings.push(finding);
    }
}

/// How far from its wanted pose a displaced use of a target lands; `None` where that cannot be told.
fn landing(job: &Job, task: &Task, fake_in_frame: &Pose, motion: &Move) -> Option<Separation> {
    let Displacement::By(shift) = &motion.displacement else {
        return None;
    };
    let wanted_from_frame = job.on_part(*job.world_from_frame(task.frame));
    let wanted = wanted_from_frame * shift.apply(&(wanted_from_frame.inverse() * task.wanted));
    let given = *job.world_from_frame(task.frame) * shift.apply(fake_in_frame);
    let equipped = job.equipped(task.tool);
    let (q, reached) = equipped.controller_joints(&given, task.branch, &task.nominal_q);
    let landed = || {
        equipped
            .inverse
            .real
            .forward(&q, &job.conditions(task))
            .separation(&wanted)
    };
    reached.then(landed)
}
