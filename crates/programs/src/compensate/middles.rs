//! The rotation in which the robot passes the middle of an arc between fake targets.
//!
//! The tool rotates from the fake beginning to the fake end. Where joints with backlash come to
//! these from one side and to the middle from the other that is not the rotation for which the
//! middle was corrected at first.

use super::Job;
use super::approach::Approach;
use super::ends::{Ends, Path, end_of_arc};
use crate::geometry::Rotation;
use crate::inverse::{Outcome, Status};
use crate::model::Conditions;
use crate::motion::course::Course;
use crate::motion::walk::{Arrivals, WalkOptions};
use crate::program::Displacement;
use crate::program::script::short;
use std::sync::Arc;

/// A middle that is corrected for another rotation by less lands, radians.
const SAME_RAD: f64 = 1e-6;

/// Corrects the rotations of middles to those of the paths between fake targets; which approaches
/// are to be solved again.
pub(super) fn turn(
    job: &Job,
    (arrivals, walk_options): (&Arrivals, &WalkOptions),
    approaches: &mut [Approach],
    outcomes: &[Option<Outcome>],
    ends: &Ends,
) -> Vec<u32> {
    let mut again = Vec::new();
    for (at, (approach, outcome)) in approaches.iter_mut().zip(outcomes).enumerate() {
        let Some(middle) = approach.middle.as_deref().copied() else {
            continue;
        };
        let is_solved = |of: &&Outcome| of.status == Status::Converged;
        let solved = outcome.as_ref().filter(is_solved);
        let turned =
            solved.and_then(|of| turned(job, (arrivals, walk_options), approach, of, ends));
        if let Some(turned) = turned.filter(|turned| turned.angle() > SAME_RAD) {
            approach.middle = Some(Arc::new(middle * turned));
            again.push(short(at));
        }
    }
    again
}

/// From the real tool as the middle is corrected for it to the real tool as it passes there.
fn turned(
    job: &Job,
    (arrivals, walk_options): (&Arrivals, &WalkOptions),
    approach: &Approach,
    outcome: &Outcome,
    ends: &Ends,
) -> Option<Rotation> {
    let program = job.ground.program;
    let own = program.moves.get(approach.motion as usize)?;
    // through a point that is derived from the target the path is another one
    if own.displacement != Displacement::None {
        return None;
    }
    let at = approach.arrival as usize;
    let end = end_of_arc(program, arrivals, at)?;
    let path = Path::of(job, arrivals, walk_options, &ends.fakes, end)?;
    let Course::Tool(course) = path.course else {
        return None;
    };
    if course.is_bent() {
        return None;
    }
    let conditions = Conditions::default();
    let mut passed = path.equipped.controller.forward(&outcome.q, &conditions);
    passed.rotation = course.rotation_at(passed.translation);
    let (q, is_reached) = path
        .equipped
        .controller_joints(&passed, approach.branch, &outcome.q);
    let real = &job.ground.arm_with(approach.tool as usize).inverse.real;
    let there = real.forward(&q, &approach.conditions(job));
    is_reached.then(|| approach.wanted(job).rotation.transpose() * there.rotation)
}
