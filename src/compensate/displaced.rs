//! Points that the running program derives from a target (`Offs`, `RelTool`) take its correction
//! along; here is found how far from their own wanted poses they land.

use super::approach::Approach;
use super::{Job, LIMIT_DERIVED_M};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{MM, mm_from_m};
use crate::geometry::{Pose, Separation};
use crate::program::{Displacement, Move, Shift};
use std::collections::{BTreeMap, BTreeSet};

fn is_displaced(motion: &Move) -> bool {
    motion.displacement != Displacement::None
}

/// The targets that points are derived from.
pub(super) fn bases(job: &Job) -> BTreeSet<usize> {
    let displaced = job.ground.program.moves.iter().filter(|m| is_displaced(m));
    displaced.filter_map(|motion| motion.target).collect()
}

/// Adds a finding for each move to a displaced target; `fakes` has the fake targets of those that
/// points are derived from.
pub(super) fn check(
    job: &Job,
    approaches: &[Approach],
    fakes: &BTreeMap<usize, Pose>,
    findings: &mut Vec<Finding>,
) {
    let ground = &job.ground;
    let limit_m = job.options.max_derived_error_m.unwrap_or(LIMIT_DERIVED_M);
    for motion in ground.program.moves.iter().filter(|m| is_displaced(m)) {
        let Some(target) = motion.target else {
            continue;
        };
        let at = approaches.partition_point(|approach| (approach.target as usize) < target);
        let approach = approaches
            .get(at)
            .filter(|approach| approach.target as usize == target);
        let (Some(approach), Some(fake)) = (approach, fakes.get(&target)) else {
            continue;
        };
        let name = ground.name_of(target);
        let hint = "give the point a target of its own if it must be exact; --max-derived-error \
            raises the limit";
        let finding = match &motion.displacement {
            Displacement::None => continue,
            Displacement::Unknown => {
                let near = somehow().filter_map(|shift| landing(job, approach, fake, &shift));
                let most = near.map(|gap| gap.distance_m).fold(0.0, f64::max);
                let message = format!(
                    "a point derived from {name} at run time takes its correction along: up to \
                     {:.0} mm from it that is {:.3} mm off \
                     (the limit is {:.3} mm)",
                    mm_from_m(SOMEHOW_M),
                    mm_from_m(most),
                    mm_from_m(limit_m)
                );
                let severity = if most > limit_m {
                    Severity::Error
                } else {
                    Severity::Warning
                };
                ground.at_move("displacement-unknown", severity, motion, message, hint)
            }
            Displacement::Overwritten => {
                let lost = approach
                    .meant(job)
                    .separation(&(ground.placed(approach.frame as usize).nominal * *fake));
                let message = format!(
                    "the running program writes numbers over some of a copy of {name}: these lose \
                     a correction of {:.3} mm (the limit \
                     is {:.3} mm)",
                    mm_from_m(lost.distance_m),
                    mm_from_m(limit_m)
                );
                let severity = if lost.distance_m > limit_m {
                    Severity::Error
                } else {
                    Severity::Warning
                };
                ground.at_move("target-overwritten", severity, motion, message, hint)
            }
            Displacement::By(shift) => {
                let Some(gap) = landing(job, approach, fake, shift) else {
                    let message = format!("a point derived from {name} is out of reach");
                    let severity = Severity::Warning;
                    findings.push(ground.at_move(
                        "displaced-target",
                        severity,
                        motion,
                        message,
                        hint,
                    ));
                    continue;
                };
                let severity = if gap.distance_m > limit_m {
                    Severity::Warning
                } else {
                    Severity::Note
                };
                let message = format!(
                    "a point derived from {name} takes its correction along and lands {:.3} mm off \
                     its own wanted pose",
                    mm_from_m(gap.distance_m)
                );
                ground.at_move("displaced-target", severity, motion, message, hint)
            }
        };
        findings.push(finding);
    }
}

/// How far a sensor or a register usually displaces a point, metres.
const SOMEHOW_M: f64 = 5.0 * MM;

/// Displacements that stand for one that only the running program knows: along each axis of the
/// work frame.
fn somehow() -> impl Iterator<Item = Shift> {
    (0..6).map(|side| {
        let mut by = [0.0; 3];
        by[side / 2] = if side % 2 == 0 { SOMEHOW_M } else { -SOMEHOW_M };
        Shift::along(by)
    })
}

/// How far from its wanted pose a displaced use of a target lands; `None` where the controller does
/// not reach it.
fn landing(
    job: &Job,
    approach: &Approach,
    fake_in_frame: &Pose,
    shift: &Shift,
) -> Option<Separation> {
    let ground = &job.ground;
    let placed = ground.placed(approach.frame as usize);
    let wanted_from_frame = placed.real;
    let in_frame = wanted_from_frame.inverse() * approach.wanted(job);
    let wanted = wanted_from_frame * shift.apply(&in_frame);
    let given = placed.nominal * shift.apply(fake_in_frame);
    let equipped = ground.arm_with(approach.tool as usize);
    let (q, reached) = equipped.controller_joints(&given, approach.branch, &approach.nominal_q);
    let real = &equipped.inverse.real;
    reached.then(|| {
        real.forward(&q, &approach.conditions(job))
            .separation(&wanted)
    })
}
