//! The joints with which the real arm reaches each wanted pose, and from which side each joint
//! comes on the path to it.

use super::Job;
use super::approach::{Approach, SAME_RAD};
use super::ends::Ends;
use super::{middles, postures, singular};
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::inverse::{Inverse, Outcome, Status, Targets, solve_batch_by};
use crate::model::Conditions;
use crate::model::effects::Need;
use crate::motion::sides;
use crate::motion::walk::{Arrival, Arrivals, WalkOptions};
use crate::program::script::{Turn, short};
use crate::program::{Displacement, Shape, Shift};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Targets solved by one thread at a time.
const CHUNK: usize = 512;
/// Times that the directions of arrival are looked at again on the path between fake targets.
const MOST_ROUNDS: usize = 3;
/// Whether the direction in which joints arrive matters to an effect of the profile.
pub(super) fn is_directed(job: &Job) -> bool {
    let effects = &job.ground.profile.effects;
    effects
        .iter()
        .any(|e| !e.is_zero() && e.definition().needs.contains(&Need::Directions))
}

/// The outcome of each approach, and how the robot comes to each arrival on the path between fake
/// targets.
pub(super) fn solve(
    job: &Job,
    arrivals: &Arrivals,
    walk_options: &WalkOptions,
    approaches: &mut [Approach],
    findings: &mut Vec<Finding>,
) -> (Vec<Outcome>, Option<Ends>) {
    let all: Vec<u32> = (0..short(approaches.len())).collect();
    let none = approaches.par_iter().map(|_| None);
    let mut outcomes: Vec<Option<Outcome>> = none.collect();
    solve_some(job, approaches, &all, &mut outcomes);
    let mut last = None;
    if walk_options.directed {
        for round in 0.. {
            let mut ends = Ends::of(job, arrivals, walk_options, approaches, &outcomes);
            let changed = ends.changed(approaches);
            let before: Option<Ends> = last.take();
            if changed.is_empty() {
                last = Some(ends);
                break;
            }
            if round == MOST_ROUNDS {
                // what goes to and fro is known of no side
                for (direction, before) in ends
                    .directions
                    .iter_mut()
                    .zip(before.iter().flat_map(|ends| &ends.directions))
                {
                    for (side, before) in direction.iter_mut().zip(before) {
                        if *side != *before {
                            *side = 0;
                        }
                    }
                }
                for (at, direction) in changed {
                    let approach = &approaches[at as usize];
                    if !is_derived(job, approach) {
                        findings.push(unsettled(job, approach, direction));
                    }
                }
                last = Some(ends);
                break;
            }
            let again: Vec<u32> = changed.iter().map(|(at, _)| *at).collect();
            for (at, direction) in changed {
                approaches[at as usize].direction = direction;
            }
            solve_some(job, approaches, &again, &mut outcomes);
            last = Some(ends);
        }
        for _ in 0..MOST_ROUNDS {
            let walked = (arrivals, walk_options);
            let again = last.as_ref();
            let again = again.map(|ends| middles::turn(job, walked, approaches, &outcomes, ends));
            let Some(again) = again.filter(|again| !again.is_empty()) else {
                break;
            };
            solve_some(job, approaches, &again, &mut outcomes);
            last = Some(Ends::of(job, arrivals, walk_options, approaches, &outcomes));
        }
        tell_unknown(job, arrivals, approaches, findings);
    }
    let is_settled = singular::settle(job, approaches, &mut outcomes, findings);
    if is_settled && walk_options.directed {
        let ends = Ends::of(job, arrivals, walk_options, approaches, &outcomes);
        for (at, direction) in ends.changed(approaches) {
            findings.push(unsettled(job, &approaches[at as usize], direction));
        }
        last = Some(ends);
    }
    postures::others(job, arrivals, walk_options, approaches, &outcomes, findings);
    let outcomes = outcomes.into_iter();
    let outcomes = outcomes.map(|outcome| outcome.expect("every approach is solved"));
    (outcomes.collect(), last)
}

/// Whether the robot goes near the target only: what is said of the points there has the sides from
/// which joints come in its figure.
fn is_derived(job: &Job, approach: &Approach) -> bool {
    let motion = job.ground.program.moves.get(approach.motion as usize);
    motion.is_some_and(|motion| motion.displacement != Displacement::None)
}

/// Says where a joint with backlash comes to a target from a side that nobody knows.
fn tell_unknown(
    job: &Job,
    arrivals: &Arrivals,
    approaches: &[Approach],
    findings: &mut Vec<Finding>,
) {
    let unknown = approaches
        .iter()
        .filter(|approach| has_unknown_side(job, approach) && !is_derived(job, approach));
    findings.extend(unknown.map(|approach| unknown_side(job, arrivals, approach, None)));
}

/// Whether nobody knows from which side a joint with backlash comes.
pub(super) fn has_unknown_side(job: &Job, approach: &Approach) -> bool {
    let equipped = job.ground.arm_with(approach.tool as usize);
    (0..6).any(|i| equipped.has_backlash[i] && approach.direction[i] == 0)
}

/// That nobody knows from which side joints come on an approach, and what is assumed: the middle,
/// or the sides of another approach, whose numbers serve this one.
pub(super) fn unknown_side(
    job: &Job,
    arrivals: &Arrivals,
    approach: &Approach,
    served_by: Option<&Approach>,
) -> Finding {
    let ground = &job.ground;
    let equipped = ground.arm_with(approach.tool as usize);
    let joints: Vec<String> = (0..6)
        .filter(|&i| equipped.has_backlash[i] && approach.direction[i] == 0)
        .map(|i| (i + 1).to_string())
        .collect();
    let conditions = approach.conditions(job);
    let q = &approach.nominal_q;
    let line_of = |motion: u32| ground.line_of(&ground.program.moves[motion as usize]);
    let (assumed, off_m) = match served_by {
        None => (
            " stand in the middle".to_owned(),
            sides::from_middle_m(equipped, q, &conditions),
        ),
        Some(other) => (
            if line_of(other.motion) == line_of(approach.motion) {
                " come as it does at other times".to_owned()
            } else {
                format!(" come as in line {}", line_of(other.motion))
            },
            2.0 * sides::from_middle_m(equipped, q, &conditions),
        ),
    };
    let (why, hint) = match arrivals.unknown_before(ground.program, approach.arrival) {
        None => (
            String::new(),
            "--start-joints says where the robot stands when the program starts".to_owned(),
        ),
        Some(point) => {
            let target = ground.program.moves[point.motion as usize].target;
            let from = target.map_or_else(String::new, |target| {
                format!(", derived from {},", ground.name_of(target))
            });
            let line = line_of(point.motion);
            (
                format!("only the running program knows the point of line {line}{from} and "),
                format!(
                    "write the displacement in line {line} as a number, or go there by a target of \
                     its own"
                ),
            )
        }
    };
    let message = format!(
        "{why}nothing says from which side joint {} with backlash comes to {}: it is taken \
         to{assumed}, and the tool may be {:.3} mm off",
        joints.join(", "),
        ground.name_of(approach.target as usize),
        mm_from_m(off_m)
    );
    ground.at_target(
        "direction-uncertain",
        Severity::Warning,
        approach.target as usize,
        message,
        &hint,
    )
}

/// What tells approaches of a base that leans apart; nothing where no effect feels gravity.
fn leaning(job: &Job, approach: &Approach) -> [u64; 3] {
    let conditions = approach.conditions(job);
    let gravity = conditions.gravity_m_s2.unwrap_or_default();
    gravity.map(f64::to_bits)
}

/// Solves some approaches, those with the same tool and conditions side by side, on all processors.
fn solve_some(job: &Job, approaches: &[Approach], which: &[u32], outcomes: &mut [Option<Outcome>]) {
    let is_alike = |a: &u32, b: &u32| {
        let [a, b] = [a, b].map(|at| &approaches[*at as usize]);
        (a.tool, a.frame, a.direction) == (b.tool, b.frame, b.direction)
    };
    let mut alike: BTreeMap<(u32, [i8; 6], [u64; 3]), Vec<u32>> = BTreeMap::new();
    for row in which.chunk_by(is_alike) {
        let approach = &approaches[row[0] as usize];
        let same = alike
            .entry((approach.tool, approach.direction, leaning(job, approach)))
            .or_default();
        same.extend_from_slice(row);
    }
    let chunks: Vec<&[u32]> = alike.values().flat_map(|same| same.chunks(CHUNK)).collect();
    let solve = |chunk: &&[u32]| {
        let of = |at: &u32| &approaches[*at as usize];
        let first = of(&chunk[0]);
        let inverse = Inverse {
            conditions: first.conditions(job),
            ..job.ground.arm_with(first.tool as usize).inverse.clone()
        };
        let wanted: Vec<_> = chunk.iter().map(|at| of(at).wanted(job)).collect();
        let branches: Vec<_> = chunk.iter().map(|at| of(at).branch).collect();
        let near: Vec<_> = chunk.iter().map(|at| of(at).nominal_q).collect();
        let targets = Targets {
            wanted: &wanted,
            branches: &branches,
            near: &near,
        };
        solve_batch_by(job.options.methods, &inverse, targets)
    };
    // a few chunks at a time: what they return is not in memory twice for a long program
    let mut some = chunks.chunks(8 * rayon::current_num_threads());
    let of = |some: &[&[u32]]| -> Vec<Vec<Outcome>> { some.par_iter().map(solve).collect() };
    let mut which = some.next();
    let mut solved = which.map(of);
    while let (Some(chunks), Some(done)) = (which, solved) {
        which = some.next();
        let put = || {
            for (at, outcome) in chunks
                .iter()
                .copied()
                .flatten()
                .zip(done.into_iter().flatten())
            {
                outcomes[*at as usize] = Some(outcome);
            }
        };
        // the next are solved while these are put in their places
        solved = rayon::join(|| which.map(of), put).0;
    }
}

/// The controller's joints at each arrival of the compensated program.
pub(super) fn fake_joints(
    job: &Job,
    arrivals: &Arrivals,
    approaches: &[Approach],
    outcomes: &[Option<Outcome>],
) -> Vec<[f64; 6]> {
    let program = job.ground.program;
    // predecessors come first in the list
    let mut fakes: Vec<[f64; 6]> = Vec::with_capacity(arrivals.all.len());
    for arrival in &arrivals.all {
        let turned = program.turned(&program.moves[arrival.motion as usize]);
        let from = fakes.get(arrival.from as usize);
        fakes.push(match turned.filter(|_| arrival.known).zip(from) {
            Some((turned, from)) => Turn::apply(turned, from),
            None => fake_of(job, approaches, outcomes, arrival).unwrap_or(arrival.q),
        });
    }
    fakes
}

/// The controller's joints at an arrival of the compensated program; `None` where they are as they
/// were.
fn fake_of(
    job: &Job,
    approaches: &[Approach],
    outcomes: &[Option<Outcome>],
    arrival: &Arrival,
) -> Option<[f64; 6]> {
    let moves = &job.ground.program.moves;
    let motion = &moves[arrival.motion as usize];
    let target = short(motion.target?);
    let first = approaches.partition_point(|approach| approach.target < target);
    let of_target = approaches[first..]
        .iter()
        .take_while(|a| a.target == target);
    let solved = of_target
        .zip(&outcomes[first..])
        .filter_map(|(a, outcome)| {
            let outcome = outcome.as_ref()?;
            (outcome.status == Status::Converged).then_some((a, outcome))
        });
    if let Displacement::By(shift) = &motion.displacement {
        let is_of_move = |(a, _): &(&Approach, &Outcome)| {
            a.tool as usize == motion.tool && a.frame as usize == job.ground.frame_of(motion)
        };
        let (approach, outcome) = solved
            .clone()
            .find(is_of_move)
            .or_else(|| solved.clone().next())?;
        return shifted(job, arrival, shift, approach, outcome);
    }
    let is_of_arrival = |(a, _): &(&Approach, &Outcome)| {
        // one that --at-singularity settled is on another branch
        !arrival.displaced && (0..6).all(|i| (a.nominal_q[i] - arrival.q[i]).abs() < SAME_RAD)
    };
    // other moves may come to the same joints from other sides
    let is_own = |(a, _): &(&Approach, &Outcome)| a.motion == arrival.motion;
    let mut found = solved.filter(is_of_arrival);
    let found = found.clone().find(is_own).or_else(|| found.next());
    found.map(|(_, outcome)| outcome.q)
}

/// The controller's joints at a point that the program displaces by a known shift from the target
/// of an approach.
fn shifted(
    job: &Job,
    arrival: &Arrival,
    shift: &Shift,
    approach: &Approach,
    outcome: &Outcome,
) -> Option<[f64; 6]> {
    let ground = &job.ground;
    let motion = &ground.program.moves[arrival.motion as usize];
    let equipped = ground.equipped(motion.tool)?;
    let controller = &ground.arm_with(approach.tool as usize).controller;
    let world_from_tool = controller.forward(&outcome.q, &Conditions::default());
    let frame = &ground.placed(approach.frame as usize).nominal;
    let numbers = approach.numbers_for(frame.inverse() * world_from_tool);
    let mut there = ground.placed(ground.frame_of(motion)).nominal * shift.apply(&numbers);
    // in the middle of an arc the tool is rotated as the path has it there
    if let Some(middle) = arrival.middle.as_deref() {
        there.rotation = there.rotation * *middle;
    }
    let (q, is_reached) = equipped.controller_joints(&there, arrival.branch, &arrival.q);
    is_reached.then_some(q)
}

/// Where the direction of a joint depends on the correction that depends on it.
fn unsettled(job: &Job, approach: &Approach, direction: [i8; 6]) -> Finding {
    let ground = &job.ground;
    let other = Approach {
        direction,
        ..approach.clone()
    };
    let real = &ground.arm_with(approach.tool as usize).inverse.real;
    let [a, b] = [approach, &other]
        .map(|approach| real.forward(&approach.nominal_q, &approach.conditions(job)));
    let is_pose = ground.program.targets[approach.target as usize]
        .layout
        .shape
        == Shape::Pose;
    let message = format!(
        "from which side a joint comes to {} depends on the correction itself: the {} may be off \
         by {:.3} mm",
        ground.name_of(approach.target as usize),
        if is_pose { "tool" } else { "joint target" },
        mm_from_m(a.separation(&b).distance_m)
    );
    ground.at_target(
        "direction-uncertain",
        Severity::Warning,
        approach.target as usize,
        message,
        "come to the target on a longer move",
    )
}
