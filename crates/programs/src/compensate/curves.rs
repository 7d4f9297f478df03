//! Joints with backlash that turn back near a point of a curve whose shape the controller alone
//! knows: from which side they come to it depends on that.

use super::approach::stays;
use super::ends::{Ends, Path};
use super::{Job, LEAST_SIDE_M};
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::motion::walk::{Arrivals, WalkOptions};
use crate::motion::{follow, sides};
use crate::program::{Displacement, Motion, TargetId};
use std::collections::BTreeMap;

/// The part of the next path by which a joint is seen to turn back.
const PART: f64 = 1.0 / 64.0;
/// A joint that goes less than this stands, radians.
const STANDSTILL_RAD: f64 = 1e-6;

/// Joints that go on from an arrival in another direction than they come to it along the chord.
fn turn_back(
    (job, walk_options): (&Job, &WalkOptions),
    (arrivals, ends): (&Arrivals, &Ends),
    (at, next): (usize, usize),
) -> Option<[bool; 6]> {
    let path = Path::of(job, arrivals, walk_options, &ends.fakes, next)?;
    let branch = arrivals.all[next].branch;
    let leg = follow::leg(path.equipped, &path.course, &path.start, branch);
    let on = leg.joints(PART, &path.start);
    Some(std::array::from_fn(|i| {
        let by = on[i] - path.start[i];
        let turns = f64::from(ends.directions[at][i]) * by < 0.0 && by.abs() > STANDSTILL_RAD;
        path.equipped.has_backlash[i] && turns
    }))
}

/// One finding a target in which a curve turns a joint with backlash back.
pub(super) fn report(
    job: &Job,
    arrivals: &Arrivals,
    walk_options: &WalkOptions,
    ends: &Ends,
    findings: &mut Vec<Finding>,
) {
    let program = job.ground.program;
    if !program.moves.iter().any(|of| of.motion == Motion::Spline) {
        return;
    }
    let mut worst: BTreeMap<TargetId, (f64, usize, [bool; 6])> = BTreeMap::new();
    for (next, arrival) in arrivals.all.iter().enumerate() {
        let at = arrival.from as usize;
        let Some(before) = arrivals.all.get(at).filter(|before| before.known) else {
            continue;
        };
        let own = &program.moves[before.motion as usize];
        let goes_on = program.moves[arrival.motion as usize].motion != Motion::Joint;
        if own.motion != Motion::Spline || own.displacement != Displacement::None || !goes_on {
            continue;
        }
        let Some(target) = own.target.filter(|target| !stays(job, *target)) else {
            continue;
        };
        let Some(turning) = turn_back((job, walk_options), (arrivals, ends), (at, next)) else {
            continue;
        };
        if turning.contains(&true) {
            let off_m = sides::apart_m(&job.ground, before, ends.directions[at], turning);
            let known = worst.entry(target).or_insert((0.0, at, turning));
            if off_m > known.0 {
                *known = (off_m, at, turning);
            }
        }
    }
    for (target, (off_m, at, turning)) in worst {
        if off_m <= LEAST_SIDE_M {
            continue;
        }
        let ground = &job.ground;
        let motion = &program.moves[arrivals.all[at].motion as usize];
        let joints = (0..6).filter(|i| turning[*i]).map(|i| (i + 1).to_string());
        let message = format!(
            "on the curve through {} in line {} joint {} with backlash turns back near the point: \
             it is taken to come along the chord, and the controller alone knows the curve; from \
             the other side the tool would be {:.3} mm off",
            ground.name_of(target),
            ground.line_of(motion),
            joints.collect::<Vec<_>>().join(", "),
            mm_from_m(off_m)
        );
        let hint = "write the curve in straight moves or arcs, or move the point from where the \
                    joint turns back";
        let (id, severity) = ("direction-uncertain", Severity::Warning);
        findings.push(ground.at_target(id, severity, target, message, hint));
    }
}
