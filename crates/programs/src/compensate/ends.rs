//! How joints with backlash come to the end of each path between fake targets: from which side, and
//! whether they have wholly taken it up.

use super::approach::{Approach, stays};
use super::solve::fake_joints;
use super::{Job, LEAST_SIDE_M};
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::inverse::Outcome;
use crate::model::Conditions;
use crate::motion::arms::Equipped;
use crate::motion::backlash::{self, Stretch, Within};
use crate::motion::course::Course;
use crate::motion::passed;
use crate::motion::walk::{Arrival, Arrivals, NOWHERE, WalkOptions};
use crate::motion::{follow, middle, ride, sides};
use crate::program::script::short;
use crate::program::{Before, Displacement, Motion, Move, Program, TargetId};
use std::collections::BTreeMap;

/// So much of its backlash a joint need not have taken up.
const LEAST_LEFT: f64 = 0.01;
/// On a path on which no joint goes farther one can turn back once at most, radians.
const SHORT_RAD: f64 = 15.0 * DEG;
/// Times that where joints stand is handed on around loops.
const MOST_ROUNDS: usize = 8;

/// How the robot comes to each arrival on the path between fake targets.
pub(super) struct Ends {
    /// The controller's joints.
    pub fakes: Vec<[f64; 6]>,
    /// As [`Arrival::direction`]; 0 where it depends on the correction itself.
    pub directions: Vec<[i8; 6]>,
    /// The joints halfway.
    halves: Vec<[f64; 6]>,
}

/// The path to an arrival between fake targets.
pub(super) struct Path<'a> {
    pub equipped: &'a Equipped,
    pub course: Course,
    pub start: [f64; 6],
    /// The tool at its end.
    pub end: Pose,
}

impl Ends {
    pub(super) fn of(
        job: &Job,
        arrivals: &Arrivals,
        walk_options: &WalkOptions,
        approaches: &[Approach],
        outcomes: &[Option<Outcome>],
    ) -> Self {
        let program = job.ground.program;
        let fakes = fake_joints(job, arrivals, approaches, outcomes);
        let count = arrivals.all.len();
        let mut ends = Self {
            fakes,
            directions: vec![[0; 6]; count],
            halves: vec![[0.0; 6]; count],
        };
        // directions carry on from arrival to arrival: predecessors come first in the list
        for (at, arrival) in arrivals.all.iter().enumerate() {
            let fakes = &ends.fakes;
            let Some(start) = start_of(job, arrivals, walk_options, fakes, arrival) else {
                ends.directions[at] = arrival.direction;
                continue;
            };
            let motion = &program.moves[arrival.motion as usize];
            let carried = ends.directions.get(arrival.from as usize);
            let carried = carried.copied().unwrap_or_default();
            if program.turned(motion).is_some() {
                let mechanism = &job.ground.profile.mechanism;
                ends.directions[at] = follow::turned(mechanism, &start, &fakes[at], carried);
                ends.halves[at] = start;
                continue;
            }
            let Some(path) = Path::of(job, arrivals, walk_options, fakes, at) else {
                continue;
            };
            let coming = follow::direction_of(
                motion,
                path.equipped,
                &path.course,
                [&path.start, &fakes[at]],
                arrival.branch,
                carried,
            );
            ends.directions[at] = coming.direction;
            ends.halves[at] = coming.half;
        }
        ends
    }

    /// Approaches whose joints arrive from another side than they were solved for.
    pub(super) fn changed(&self, approaches: &[Approach]) -> Vec<(u32, [i8; 6])> {
        let differs = |(at, approach): (usize, &Approach)| {
            let direction = *self.directions.get(approach.arrival as usize)?;
            (direction != approach.direction).then_some((short(at), direction))
        };
        approaches.iter().enumerate().filter_map(differs).collect()
    }
}

impl<'a> Path<'a> {
    /// The path to an arrival; `None` where nobody knows where it begins.
    pub(super) fn of(
        job: &'a Job,
        arrivals: &Arrivals,
        walk_options: &WalkOptions,
        fakes: &[[f64; 6]],
        at: usize,
    ) -> Option<Self> {
        let ground = &job.ground;
        let arrival = &arrivals.all[at];
        let motion = &ground.program.moves[arrival.motion as usize];
        let equipped = ground.equipped(motion.tool)?;
        let end = &fakes[at];
        let start = start_of(job, arrivals, walk_options, fakes, arrival)?;
        let from = (arrival.from != NOWHERE).then(|| starts_at(job, arrivals, arrival));
        let before = from.map(|from| arrivals.all[from as usize].motion);
        let ride = ground.ride(before, motion);
        let via = from.filter(|from| *from != arrival.from).map(|_| {
            let (at, q) = (arrival.from as usize, &fakes[arrival.from as usize]);
            let pose = equipped.controller.forward(q, &Conditions::default());
            let point = &ground.program.moves[arrivals.all[at].motion as usize];
            ride::through(&pose, ground.ride(None, point).as_deref(), ride.as_deref())
        });
        let wanted = equipped.controller.forward(end, &Conditions::default());
        let turning = walk_options.turning;
        let via = via.or_else(|| {
            let end = fake_end(job, arrivals, fakes, at);
            let ends = (&start, &wanted, end);
            middle::halfway(
                ground,
                turning,
                arrival.motion as usize,
                ends,
                ride.as_deref(),
            )
        });
        let course = follow::course(
            motion,
            equipped,
            &start,
            via.as_ref(),
            &wanted,
            end,
            ride,
            walk_options,
        );
        Some(Self {
            equipped,
            course,
            start,
            end: wanted,
        })
    }
}

/// The arrival at the end of the arc through the point of an arrival, where that is known.
pub(super) fn end_of_arc(program: &Program, arrivals: &Arrivals, at: usize) -> Option<usize> {
    let via = arrivals.all.get(at)?.motion as usize;
    let ends = passed::ends_of(program, via).flat_map(|end| arrivals.at(end));
    let is_own = |end: &usize| {
        let end = &arrivals.all[*end];
        end.from as usize == at && end.known
    };
    ends.filter(is_own).min()
}

/// Where that arc ends between fake targets.
fn fake_end(job: &Job, arrivals: &Arrivals, fakes: &[[f64; 6]], at: usize) -> Option<Pose> {
    let program = job.ground.program;
    let end = end_of_arc(program, arrivals, at)?;
    let motion = &program.moves[arrivals.all[end].motion as usize];
    let equipped = job.ground.equipped(motion.tool)?;
    let conditions = Conditions::default();
    Some(equipped.controller.forward(&fakes[end], &conditions))
}

/// Where the path to an arrival begins.
pub(super) enum Begin {
    /// Where the program does, as `--start-joints` says.
    Joints([f64; 6]),
    /// At another arrival.
    At(usize),
}

impl Begin {
    /// `None` where nobody knows where that is.
    pub(super) fn of(
        job: &Job,
        arrivals: &Arrivals,
        walk_options: &WalkOptions,
        arrival: &Arrival,
    ) -> Option<Self> {
        let program = job.ground.program;
        if arrival.from == NOWHERE {
            let before = program.before(&program.moves[arrival.motion as usize]);
            // behind any of many moves nobody knows which
            let is_one_of = |before: &Before| matches!(before, Before::AnyOf { .. });
            let is_many = before.iter().any(is_one_of);
            let begins = arrival.known && before.contains(&Before::Start) && !is_many;
            return walk_options
                .start_joints
                .filter(|_| begins)
                .map(Self::Joints);
        }
        is_directed_at(job, arrivals, arrival)
            .then(|| Self::At(starts_at(job, arrivals, arrival) as usize))
    }

    /// The joints there, of those at each arrival.
    pub(super) fn joints<'a>(&'a self, of: impl Fn(usize) -> &'a [f64; 6]) -> &'a [f64; 6] {
        match self {
            Self::Joints(q) => q,
            Self::At(at) => of(*at),
        }
    }
}

/// The joints where the path to an arrival begins, of those at each arrival; `None` where nobody
/// knows them.
fn start_of(
    job: &Job,
    arrivals: &Arrivals,
    walk_options: &WalkOptions,
    joints: &[[f64; 6]],
    arrival: &Arrival,
) -> Option<[f64; 6]> {
    let begin = Begin::of(job, arrivals, walk_options, arrival)?;
    Some(*begin.joints(|at| &joints[at]))
}

/// Whether the sides from which joints come to an arrival are those of its path.
fn is_directed_at(job: &Job, arrivals: &Arrivals, arrival: &Arrival) -> bool {
    arrival.known
        && arrivals.start_of(arrival).is_some()
        && !arrivals.starts_unknown(job.ground.program, arrival)
}

/// The arrival where the path to one begins, whose start is known: an arc begins before the point on
/// its path.
fn starts_at(job: &Job, arrivals: &Arrivals, arrival: &Arrival) -> u32 {
    let moves = &job.ground.program.moves;
    let before = &arrivals.all[arrival.from as usize];
    let is_arc = moves[arrival.motion as usize].motion == Motion::ArcEnd
        && moves[before.motion as usize].motion == Motion::ArcVia
        && arrivals.start_of(before).is_some();
    if is_arc { before.from } else { arrival.from }
}

/// How much of its backlash each joint has taken up at each arrival.
pub(super) struct TakenUp(Vec<[Within; 6]>);

impl Ends {
    /// How much of its backlash each joint has taken up at each arrival.
    pub(super) fn take_up(
        &self,
        job: &Job,
        arrivals: &Arrivals,
        walk_options: &WalkOptions,
    ) -> TakenUp {
        let count = arrivals.all.len();
        let stretches = (0..count).map(|at| self.stretches(job, arrivals, walk_options, at));
        let stretches: Vec<_> = stretches.collect();
        let joins: Vec<_> = (0..count)
            .map(|at| (arrivals.leader_of(at), arrivals.left_out(at)))
            .collect();
        let mut within = vec![[Within::ANYWHERE; 6]; count];
        // the moves behind go on from one of those that are alike
        let mut joined: BTreeMap<usize, [Within; 6]> = BTreeMap::new();
        for round in 0..MOST_ROUNDS {
            let before = joined.clone();
            for (at, arrival) in arrivals.all.iter().enumerate() {
                let (leader, left_out) = &joins[at];
                let mut here = [Within::ANYWHERE; 6];
                if let Some(stretches) = &stretches[at] {
                    if arrival.from != NOWHERE {
                        here = within[starts_at(job, arrivals, arrival) as usize];
                        // those behind have not been looked at in the first round
                        let seen = |other: &&usize| round > 0 || **other < at;
                        for other in left_out.iter().filter(seen) {
                            here = either(&here, &within[*other]);
                        }
                    }
                    here = std::array::from_fn(|i| here[i].behind(&stretches[i]));
                }
                if *leader == at {
                    within[at] = joined.get(&at).map_or(here, |all| either(all, &here));
                } else {
                    within[at] = here;
                    let all = joined.entry(*leader).or_insert(here);
                    *all = either(all, &here);
                }
            }
            let is_seen = round > 0 || joins.iter().all(|(_, left_out)| left_out.is_empty());
            if is_seen && joined == before {
                break;
            }
        }
        TakenUp(within)
    }

    /// What the path to an arrival does to the backlash of each joint; `None` where nobody knows.
    fn stretches(
        &self,
        job: &Job,
        arrivals: &Arrivals,
        walk_options: &WalkOptions,
        at: usize,
    ) -> Option<[Stretch; 6]> {
        let program = job.ground.program;
        let arrival = &arrivals.all[at];
        let motion = &program.moves[arrival.motion as usize];
        let equipped = job.ground.equipped(motion.tool)?;
        let end = &self.fakes[at];
        let widths = widths(job, motion, end);
        let start = start_of(job, arrivals, walk_options, &self.fakes, arrival)?;
        if is_led(program, arrival) {
            return None;
        }
        let turning = |q: &[f64; 6]| equipped.mechanism.commanded(q);
        let [from, half, to] = [&start, &self.halves[at], end].map(turning);
        let mut parts = Vec::new();
        // on a long path a joint may turn back twice in one of its halves
        let is_short = (0..6).all(|i| (to[i] - from[i]).abs() < SHORT_RAD);
        Some(std::array::from_fn(|i| {
            if !equipped.has_backlash[i] {
                return Stretch::NONE;
            }
            let known = [from[i], half[i], to[i]];
            let roughly = || Stretch::roughly(known, self.directions[at][i], widths[i]);
            if let Some(stretch) = is_short.then(roughly).flatten() {
                return stretch;
            }
            if parts.is_empty() {
                let path = Path::of(job, arrivals, walk_options, &self.fakes, at);
                parts = path.map_or_else(Vec::new, |path| {
                    let leg = follow::leg(path.equipped, &path.course, &path.start, arrival.branch);
                    let parts = backlash::parts(&leg, end);
                    parts.iter().map(turning).collect()
                });
            }
            let is_led = i >= 3 && follow::leads_wrist(motion);
            if is_led || parts.is_empty() {
                return Stretch::through(&known, widths[i]);
            }
            let angles: Vec<f64> = parts.iter().map(|q| q[i]).collect();
            Stretch::through(&angles, widths[i])
        }))
    }
}

fn either(a: &[Within; 6], b: &[Within; 6]) -> [Within; 6] {
    std::array::from_fn(|i| a[i].or(b[i]))
}

/// Whether a call may have led the robot elsewhere before a move: a finding of its own.
fn is_led(program: &Program, arrival: &Arrival) -> bool {
    program
        .led
        .binary_search_by_key(&arrival.motion, |led| led.0)
        .is_ok()
}

/// How wide the backlash of each joint is at the end of a move, radians.
fn widths(job: &Job, motion: &Move, q: &[f64; 6]) -> [f64; 6] {
    let equipped = job.ground.arm_with(motion.tool);
    equipped.backlash_rad(q, &sides::conditions(&job.ground, motion))
}

impl TakenUp {
    /// Joints that may have taken up less than their backlash on the way to an arrival.
    fn open(&self, job: &Job, ends: &Ends, arrivals: &Arrivals, at: usize) -> [bool; 6] {
        let motion = &job.ground.program.moves[arrivals.all[at].motion as usize];
        let has_backlash = job.ground.equipped(motion.tool).map(|of| of.has_backlash);
        std::array::from_fn(|i| {
            let direction = ends.directions[at][i];
            let left = self.0[at][i].left(direction);
            has_backlash.is_some_and(|has| has[i]) && direction != 0 && left > LEAST_LEFT
        })
    }

    /// The directions in which joints arrive, 0 where one has not wholly taken up its backlash.
    pub(super) fn sides(&self, job: &Job, ends: &Ends, arrivals: &Arrivals, at: usize) -> [i8; 6] {
        let open = self.open(job, ends, arrivals, at);
        std::array::from_fn(|i| if open[i] { 0 } else { ends.directions[at][i] })
    }

    /// One finding a target to which a joint with backlash comes after less than its width.
    pub(super) fn report(
        &self,
        job: &Job,
        ends: &Ends,
        arrivals: &Arrivals,
        findings: &mut Vec<Finding>,
    ) {
        let program = job.ground.program;
        let mut worst: BTreeMap<TargetId, (f64, usize)> = BTreeMap::new();
        for (at, arrival) in arrivals.all.iter().enumerate() {
            let motion = &program.moves[arrival.motion as usize];
            let is_plain = motion.displacement == Displacement::None;
            let Some(target) = motion
                .target
                .filter(|target| is_plain && !stays(job, *target))
            else {
                continue;
            };
            let open = self.open(job, ends, arrivals, at);
            if !arrival.known || !open.contains(&true) || is_led(program, arrival) {
                continue;
            }
            let off_m = sides::apart_m(&job.ground, arrival, ends.directions[at], open);
            let before = worst.entry(target).or_insert((0.0, at));
            if off_m > before.0 {
                *before = (off_m, at);
            }
        }
        for (target, (off_m, at)) in worst {
            if off_m > LEAST_SIDE_M {
                let open = self.open(job, ends, arrivals, at);
                findings.push(self.finding(job, ends, arrivals, (target, at), open, off_m));
            }
        }
    }

    fn finding(
        &self,
        job: &Job,
        ends: &Ends,
        arrivals: &Arrivals,
        (target, at): (TargetId, usize),
        open: [bool; 6],
        off_m: f64,
    ) -> Finding {
        let ground = &job.ground;
        let motion = &ground.program.moves[arrivals.all[at].motion as usize];
        let widths = widths(job, motion, &ends.fakes[at]);
        let joints = (0..6).filter(|i| open[*i]).map(|i| {
            let left = self.0[at][i].left(ends.directions[at][i]);
            let width = widths[i] / DEG;
            let taken_up = (1.0 - left) * width;
            format!("joint {}: {taken_up:.3} of {width:.3} deg", i + 1)
        });
        let joints: Vec<String> = joints.collect();
        let message = format!(
            "on the move to {} in line {} joints with backlash have taken up less than its width \
             since they turned back, or the program began ({}): they are taken to come wholly from \
             their new side; from the other the tool would be {:.3} mm off",
            ground.name_of(target),
            ground.line_of(motion),
            joints.join(", "),
            mm_from_m(off_m)
        );
        let hint = "come to the target on a longer move in that direction";
        let (id, severity) = ("direction-uncertain", Severity::Warning);
        ground.at_target(id, severity, target, message, hint)
    }
}
