//! In which posture the robot arrives at the end of each move, and which way each joint moves then.
//!
//! Moves are gone through along the moves before them, from where programs start. On a joint move
//! configuration data decide as the controller does; on a straight line or an arc the posture is
//! that of the path itself, followed from the posture before. The direction of a joint is the sign
//! of its rate at the end of the path; one that stands keeps its last.

use super::course::ToolRotation;
use super::crowds::{Crowds, starts};
use super::follow::{course, direction_of, turned};
use super::ground::Ground;
use super::inherited::Assumptions;
use super::posture::OUT_OF_REACH;
use super::{middle, plausibility, ride, sides};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Rotation};
use crate::inverse::Branch;
use crate::model::Conditions;
use crate::program::insert::sole_use;
use crate::program::script::Turn;
use crate::program::{Before, Configuration, Motion, Program, Role, TargetId, Value};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};
use std::sync::Arc;

/// A joint that stands beyond this is written in another unit: 278 rotations, as of orientations.
const MOST_JOINT_RAD: f64 = 1e5 * DEG;
/// Numbers above this are written with an exponent.
const READABLE: f64 = 1e6;
/// Arrivals at one move that are distinguished.
const MOST_ARRIVALS: usize = 64;
/// Moves to positions that only the running program knows that are gone back over.
const MOST_UNKNOWN: usize = 256;
/// Likewise at one that turns joints from where they are.
const MOST_TURNS: usize = 16;
/// Joints that differ by less are the same, radians.
const SAME_RAD: f64 = 1e-7;

/// The robot at the end of a move.
#[derive(Clone, Debug)]
pub(crate) struct Arrival {
    /// Index in the program's moves.
    pub motion: u32,
    /// The arrival that it comes from; [`NOWHERE`] where that is not known.
    pub from: u32,
    /// The controller's joints, radians.
    pub q: [f64; 6],
    /// The branch of the inverse.
    pub branch: Branch,
    /// Direction in which each joint last moved; 0 where it is not known.
    pub direction: [i8; 6],
    /// The joints are known.
    pub known: bool,
    /// The joints are those of the target, and the robot goes near it.
    pub displaced: bool,
    /// The controller goes by the target's configuration data.
    pub honoured: bool,
    /// The assumption that its posture goes back to: an index in the walk's own list, from 1; 0 is
    /// none.
    pub assumed: u32,
    /// In the middle of an arc: from the tool as the target's numbers have it to the tool as the
    /// path has it there, where the controller looks at the position alone.
    pub middle: Option<Arc<Rotation>>,
}

/// Name of the finding about a path that ends in another configuration than the file gives.
pub(crate) const CONFIGURATION_CHANGE: &str = "configuration-change";
/// No arrival.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// All arrivals of a program.
#[derive(Debug, Default)]
pub(crate) struct Arrivals {
    pub all: Vec<Arrival>,
    /// First arrival at each move, and the next one at the same move behind each.
    pub(super) first: Vec<u32>,
    pub(super) next: Vec<u32>,
}

impl Arrivals {
    /// Indices of the arrivals at a move.
    pub(crate) fn at(&self, motion: usize) -> impl Iterator<Item = usize> + '_ {
        let first = self.first.get(motion).copied().unwrap_or(NOWHERE);
        let mut next = (first != NOWHERE).then_some(first as usize);
        std::iter::from_fn(move || {
            let here = next?;
            let behind = self.next[here];
            next = (behind != NOWHERE).then_some(behind as usize);
            Some(here)
        })
    }

    /// Where an arrival comes from, where its joints are known.
    pub(crate) fn start_of(&self, arrival: &Arrival) -> Option<&Arrival> {
        let from = self.all.get(arrival.from as usize)?;
        from.known.then_some(from)
    }

    /// The point that only the running program knows where a move from an arrival begins; of an
    /// arc also the point on its path.
    fn unknown_start(&self, program: &Program, from: u32) -> Option<&Arrival> {
        let before = self.all.get(from as usize).filter(|before| before.known)?;
        if before.displaced {
            return Some(before);
        }
        let is_via = program.moves[before.motion as usize].motion == Motion::ArcVia;
        let start = self.start_of(before).filter(|start| start.displaced);
        start.filter(|_| is_via)
    }

    /// Whether a move begins where only the running program knows: nothing says from which side its
    /// joints come.
    pub(crate) fn starts_unknown(&self, program: &Program, arrival: &Arrival) -> bool {
        self.unknown_start(program, arrival.from).is_some()
    }

    /// The last point before an arrival that only the running program knows: a joint whose
    /// direction is unknown has not moved since the move behind it.
    pub(crate) fn unknown_before(&self, program: &Program, arrival: u32) -> Option<&Arrival> {
        let mut at = self.all.get(arrival as usize);
        while let Some(arrival) = at {
            if let Some(point) = self.unknown_start(program, arrival.from) {
                return Some(point);
            }
            at = self.all.get(arrival.from as usize);
        }
        None
    }

    /// Whether an arrival goes back, by moves whose ends are known, to where a program starts.
    pub(crate) fn is_from_start(&self, program: &Program, arrival: u32) -> bool {
        let mut at = self.all.get(arrival as usize);
        while let Some(arrival) = at.filter(|arrival| arrival.known) {
            if arrival.from == NOWHERE {
                let motion = &program.moves[arrival.motion as usize];
                return program.before(motion).contains(&Before::Start);
            }
            at = self.all.get(arrival.from as usize);
        }
        false
    }

    /// The joints in which the robot stood last, as far as that is known, else those of the move
    /// that was looked at last: from a position that only the running program knows it most likely
    /// goes on in the same posture.
    fn last_known(&self, before: Option<&Arrival>) -> Option<[f64; 6]> {
        let back = |arrival: &&Arrival| self.all.get(arrival.from as usize);
        let chain = std::iter::successors(before, back).take(MOST_UNKNOWN);
        let others = self.all.iter().rev().take(MOST_UNKNOWN);
        let mut known = chain.chain(others).filter(|arrival| arrival.known);
        known.next().map(|arrival| arrival.q)
    }

    /// The arrival at the same move, alike in all, that the moves behind are gone on from.
    pub(crate) fn leader_of(&self, at: usize) -> usize {
        let arrival = &self.all[at];
        let alike = self.at(arrival.motion as usize);
        alike
            .filter(|other| is_alike(&self.all[*other], arrival))
            .fold(at, usize::min)
    }

    /// Other arrivals at the move before one that go on to it as that does: they are not listed
    /// there.
    pub(crate) fn left_out(&self, at: usize) -> Vec<usize> {
        let arrival = &self.all[at];
        let Some(from) = self.all.get(arrival.from as usize) else {
            return Vec::new();
        };
        let goes_on = |other: usize| {
            let mut here = self.at(arrival.motion as usize);
            here.any(|at| self.all[at].from as usize == other)
        };
        let others = self.at(from.motion as usize);
        let others = others.filter(|other| *other != arrival.from as usize);
        others
            .filter(|other| self.leader_of(*other) == *other && !goes_on(*other))
            .collect()
    }

    pub(super) fn add(&mut self, arrival: Arrival) {
        let here = crate::program::script::short(self.all.len());
        let first = &mut self.first[arrival.motion as usize];
        self.next.push(std::mem::replace(first, here));
        self.all.push(arrival);
    }
}

/// How a program is walked.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WalkOptions {
    /// The joints in which the robot stands when a program starts, radians.
    pub start_joints: Option<[f64; 6]>,
    /// Joints are those of a controller that computes with a calibrated chain of its own, where it
    /// does; else those of the nominal arm.
    pub exact: bool,
    /// A path that ends in another configuration than the file gives is an error.
    pub strict: bool,
    /// Directions of arrival matter.
    pub directed: bool,
    /// How the controller rotates the tool on its path.
    pub turning: ToolRotation,
    /// Targets are corrected afterwards.
    pub corrects: bool,
    /// Those in joints, too.
    pub corrects_joints: bool,
}

/// Goes through all moves of a program.
pub(crate) fn walk(
    ground: &Ground,
    walk_options: &WalkOptions,
    findings: &mut Vec<Finding>,
) -> Arrivals {
    let count = ground.program.moves.len();
    let mut walker = Walker {
        ground,
        walk_options,
        findings,
        arrivals: Arrivals {
            all: Vec::with_capacity(count),
            first: vec![NOWHERE; count],
            next: Vec::with_capacity(count),
        },
        open: BinaryHeap::new(),
        many: false,
        named: ground.program.named.iter().copied().collect(),
        beyond: HashSet::new(),
        assumed: Assumptions::default(),
        no_row_before: 0,
    };
    let behind = Behind::of(ground);
    let mut crowds = Crowds::of(ground);
    for at in 0..count {
        let motion = &ground.program.moves[at];
        if ground
            .program
            .before(motion)
            .iter()
            .any(|before| starts(motion, before))
        {
            walker
                .open
                .push(Reverse((crate::program::script::short(at), NOWHERE)));
        }
    }
    walker.run(&behind);
    walker.run_crowds(&behind, &mut crowds);
    // moves that only moves without an arrival come before
    for at in 0..count {
        if walker.arrivals.first[at] == NOWHERE {
            walker
                .open
                .push(Reverse((crate::program::script::short(at), NOWHERE)));
            walker.run(&behind);
            walker.run_crowds(&behind, &mut crowds);
        }
    }
    walker.name_inherited();
    walker.arrivals
}

/// The moves behind each move.
pub(super) struct Behind {
    first: Vec<u32>,
    list: Vec<u32>,
}

impl Behind {
    fn of(ground: &Ground) -> Self {
        let moves = &ground.program.moves;
        let mut first = vec![0_u32; moves.len() + 1];
        let each = |take: &mut dyn FnMut(u32, u32)| {
            for (at, motion) in moves.iter().enumerate() {
                for before in ground.program.before(motion) {
                    if let Before::One(before) = before {
                        take(*before, crate::program::script::short(at));
                    }
                }
            }
        };
        each(&mut |before, _| first[before as usize + 1] += 1);
        for at in 1..first.len() {
            first[at] += first[at - 1];
        }
        let mut list = vec![0; first[moves.len()] as usize];
        let mut free = first.clone();
        each(&mut |before, at| {
            list[free[before as usize] as usize] = at;
            free[before as usize] += 1;
        });
        Self { first, list }
    }

    pub(super) fn of_move(&self, at: u32) -> &[u32] {
        let at = at as usize;
        &self.list[self.first[at] as usize..self.first[at + 1] as usize]
    }
}

pub(super) struct Walker<'a, 'f> {
    pub(super) ground: &'a Ground<'a>,
    pub(super) walk_options: &'a WalkOptions,
    pub(super) findings: &'f mut Vec<Finding>,
    pub(super) arrivals: Arrivals,
    /// Moves to arrive at, and from which arrival: the first of the text first.
    pub(super) open: BinaryHeap<Reverse<(u32, u32)>>,
    pub(super) many: bool,
    /// Where a move says itself near which joints it comes to a target: its posture there.
    pub(super) named: HashMap<TargetId, [f64; 6]>,
    /// Targets whose joints have been reported beyond their limits.
    pub(super) beyond: HashSet<TargetId>,
    /// Postures that were assumed.
    pub(super) assumed: Assumptions,
    /// Where rows of moves have been looked for.
    pub(super) no_row_before: u32,
}

impl Walker<'_, '_> {
    pub(super) fn run(&mut self, behind: &Behind) {
        while let Some(Reverse((at, from))) = self.open.pop() {
            if self.walk_row(behind, at, from) {
                continue;
            }
            let arrival = self.arrive(at, from);
            self.add(behind, arrival);
        }
    }

    /// Adds an arrival where it is another than those at its move, and goes on from there.
    pub(super) fn add(&mut self, behind: &Behind, arrival: Arrival) {
        let at = arrival.motion;
        let program = self.ground.program;
        let motion = program.moves[at as usize].motion;
        // of the elements of an array most do not go with each beginning
        let is_via = motion == Motion::ArcVia && sole_use(program, at as usize).is_some();
        let mut others = 0;
        let mut is_same = false;
        let mut is_new = true;
        for other in self.arrivals.at(at as usize) {
            let other = &self.arrivals.all[other];
            let alike = is_alike(other, &arrival);
            let is_known = alike && self.start_of(other.from) == self.start_of(arrival.from);
            is_same |= is_known;
            // beginnings are counted where the point of the arc is
            others += usize::from(motion != Motion::ArcEnd || !alike);
            // the arc through a point is another one from each beginning
            is_new &= !(if is_via { is_known } else { alike });
        }
        if is_same {
            return;
        }
        if others >= MOST_ARRIVALS {
            return self.too_many(at);
        }
        self.arrivals.add(arrival);
        if is_new {
            let here = crate::program::script::short(self.arrivals.all.len() - 1);
            for &next in behind.of_move(at) {
                self.open.push(Reverse((next, here)));
            }
        }
    }

    /// The move from which a move behind an arrival begins, and of an arc also the one before the point
    /// on its path.
    fn start_of(&self, arrival: u32) -> Option<(u32, Option<u32>)> {
        let all = &self.arrivals.all;
        let before = all.get(arrival as usize)?;
        let is_via = self.ground.program.moves[before.motion as usize].motion == Motion::ArcVia;
        let start = all.get(before.from as usize).filter(|_| is_via);
        Some((before.motion, start.map(|start| start.motion)))
    }

    fn too_many(&mut self, at: u32) {
        if std::mem::replace(&mut self.many, true) {
            return;
        }
        let motion = &self.ground.program.moves[at as usize];
        let message = format!(
            "the robot comes here in more than {MOST_ARRIVALS} ways; the others are not checked"
        );
        let hint = "give fewer files in one call";
        let severity = Severity::Error;
        self.findings.push(
            self.ground
                .at_move("too-many-uses", severity, motion, message, hint),
        );
    }

    pub(super) fn arrive(&mut self, at: u32, from: u32) -> Arrival {
        let ground = self.ground;
        let motion = &ground.program.moves[at as usize];
        let before = self.arrivals.all.get(from as usize).cloned();
        let before = before.as_ref();
        let start = before.filter(|before| before.known).map(|before| before.q);
        let is_first = ground.program.before(motion).contains(&Before::Start);
        let start = match (start, from) {
            (None, NOWHERE) if is_first => self.walk_options.start_joints,
            _ => start,
        };
        let honoured = motion.configured && self.ground.program.near(motion).is_none();
        let nowhere = Arrival {
            motion: at,
            from,
            q: start.unwrap_or([0.0; 6]),
            branch: Branch::ALL[0],
            direction: [0; 6],
            known: false,
            displaced: false,
            honoured,
            assumed: before.map_or(0, |before| before.assumed),
            middle: None,
        };
        // where the robot goes from a point that only the running program knows, no side is known
        let starts_unknown = self.arrivals.unknown_start(ground.program, from).is_some();
        let carried = before.filter(|_| !starts_unknown);
        let direction = carried.map_or([0; 6], |before| before.direction);
        let in_joints = |q: [f64; 6], displaced: bool| {
            let arm = ground.arms.iter().flatten().next();
            Arrival {
                q,
                branch: arm.map_or(Branch::ALL[0], |equipped| equipped.arm.posture(&q).0),
                direction: start.filter(|_| !starts_unknown).map_or([0; 6], |start| {
                    turned(&ground.profile.mechanism, &start, &q, direction)
                }),
                known: true,
                displaced,
                ..nowhere.clone()
            }
        };
        let Some(target) = motion.target else {
            if let Some(there) = self.stood(at, from) {
                let direction = before.map_or([0; 6], |before| {
                    sides::sides_from(ground, self.walk_options, motion, before, there)
                });
                return Arrival {
                    q: there.q,
                    branch: there.branch,
                    direction,
                    known: true,
                    assumed: there.assumed,
                    ..nowhere
                };
            }
            // a call that may have led the robot elsewhere leaves the other joints unknown, and so
            // does a move that turns them on, again and again
            let is_led = ground.program.led.binary_search_by_key(&at, |led| led.0);
            let is_many = self.arrivals.at(at as usize).nth(MOST_TURNS).is_some();
            let turns_on = |turn: &Turn| matches!(turn, Turn::By(_)) && is_many;
            let turned = ground.program.turned(motion);
            let turned = turned.filter(|turned| is_led.is_err() && !turned.iter().any(turns_on));
            if let Some((turned, start)) = turned.zip(start) {
                return in_joints(Turn::apply(turned, &start), starts_unknown);
            }
            let step = motion.step().filter(|_| is_led.is_err() && !is_many);
            let there = step.zip(start);
            let there = there.and_then(|(step, start)| self.stepped(motion, step, &start));
            return match there {
                Some(there) => in_joints(there, true),
                None => nowhere,
            };
        };
        let Some(goal) = ground.goal(motion) else {
            return nowhere;
        };
        if let Value::Joints(q) = goal.value {
            if let Some(angle) = q.iter().find(|angle| angle.abs() > MOST_JOINT_RAD) {
                self.say_endless(target, ("a joint", angle / DEG, MOST_JOINT_RAD / DEG));
                return nowhere;
            }
            if self.stands_beyond(target, &q) {
                return nowhere;
            }
            return Arrival {
                assumed: 0,
                ..in_joints(q, goal.is_near)
            };
        }
        let frame = ground.frame_of(motion);
        let is_known = ground.equipped(motion.tool).is_some()
            && ground.setting.frames[frame].is_some()
            && !ground.is_adrift(motion);
        if !is_known {
            return nowhere;
        }
        if let Some(angle) = self.endless_angle(target) {
            let limit = ground
                .language
                .most_orientation(ground.program.targets[target].layout);
            self.say_endless(target, ("the orientation", angle, limit));
            return nowhere;
        }
        let mut wanted = ground.meant(&goal.value, motion.tool, frame);
        if plausibility::farthest(&wanted.translation) > plausibility::FARTHEST_M {
            self.say_far(target, &wanted);
            return nowhere;
        }
        let known = before.filter(|before| before.known);
        let middle = known.and_then(|before| {
            let (at, walk_options) = (at as usize, self.walk_options);
            middle::middle(ground, walk_options, at, before, &wanted, self.findings)
        });
        let is_via = motion.motion == Motion::ArcVia;
        if is_via && known.is_none() && !ground.language.turns_through_middle() {
            self.findings.push(middle::begins_unknown(ground, motion));
        }
        let mut configuration = goal.configuration;
        if let Some(middle) = middle.filter(|middle| *middle != Rotation::identity()) {
            wanted.rotation = wanted.rotation * middle;
            // that is of another orientation
            configuration = Configuration::default();
        }
        // the point on the way of an arc comes before its end
        let (via, start) = match (motion.motion, before) {
            (Motion::ArcEnd, Some(before)) => self.arc_start(before, start),
            _ => (None, start),
        };
        let from = match via {
            Some(_) => before.and_then(|before| self.arrivals.start_of(before)),
            None => before,
        };
        let ride = ground.ride(from.map(|from| from.motion), motion);
        let via = via.zip(before).map(|(pose, at)| {
            let point = ground.ride(None, &ground.program.moves[at.motion as usize]);
            ride::through(&pose, point.as_deref(), ride.as_deref())
        });
        let turning = self.walk_options.turning;
        let via = via.or_else(|| {
            let ends = (&start?, &wanted, None);
            middle::halfway(ground, turning, at as usize, ends, ride.as_deref())
        });
        let said = self.findings.len();
        let Some(posture) = self.posture(
            motion,
            target,
            &wanted,
            &configuration,
            (start, via.as_ref(), ride.clone()),
            match start {
                Some(_) => None,
                None => self.arrivals.last_known(before),
            },
        ) else {
            return nowhere;
        };
        let is_said = honoured && configuration != Configuration::default()
            || ground.program.near(motion).is_some();
        let assumed = self.assumption(at, said, if is_said { 0 } else { nowhere.assumed });
        let equipped = ground.arm_with(motion.tool);
        let q = match &equipped.calibrated_controller {
            Some(controller) if self.walk_options.exact => {
                controller.solve(&wanted, posture.branch, &posture.q).q
            }
            _ => posture.q,
        };
        let direction = match start.filter(|_| self.walk_options.directed && !starts_unknown) {
            Some(start) => {
                let course = course(
                    motion,
                    equipped,
                    &start,
                    via.as_ref(),
                    &wanted,
                    &q,
                    ride,
                    self.walk_options,
                );
                direction_of(
                    motion,
                    equipped,
                    &course,
                    [&start, &q],
                    posture.branch,
                    direction,
                )
                .direction
            }
            None => [0; 6],
        };
        Arrival {
            q,
            branch: posture.branch,
            direction,
            known: true,
            displaced: goal.is_near,
            assumed,
            middle: middle.map(Arc::new),
            ..nowhere
        }
    }

    /// How the robot stood where a move goes back to, the last time that it was there.
    fn stood(&self, motion: u32, from: u32) -> Option<&Arrival> {
        let stood = self.ground.program.stands_as(motion);
        let back = |arrival: &&Arrival| self.arrivals.all.get(arrival.from as usize);
        let chain = std::iter::successors(self.arrivals.all.get(from as usize), back);
        let there = chain.take(MOST_UNKNOWN).find(|at| at.motion == stood);
        there.filter(|there| there.known && !there.displaced)
    }

    /// The pose that an arc passes through, and the joints where it begins.
    fn arc_start(
        &self,
        via: &Arrival,
        start: Option<[f64; 6]>,
    ) -> (Option<Pose>, Option<[f64; 6]>) {
        let ground = self.ground;
        let motion = &ground.program.moves[via.motion as usize];
        if motion.motion != Motion::ArcVia || !via.known {
            return (None, start);
        }
        let pose = ground
            .equipped(motion.tool)
            .map(|equipped| equipped.controller.forward(&via.q, &Conditions::default()));
        (pose, self.arrivals.start_of(via).map(|before| before.q))
    }

    /// A part of the target's orientation so large that its angle is lost in rounding.
    fn endless_angle(&self, target: TargetId) -> Option<f64> {
        let program = self.ground.program;
        let target = &program.targets[target];
        let roles = self.ground.language.roles(target.layout);
        let numbers = program.numbers_of(target).iter().zip(roles);
        let mut angles = numbers.filter(|(_, role)| **role == Role::Orientation);
        let limit = self.ground.language.most_orientation(target.layout);
        angles.find_map(|(number, _)| Some(number.value).filter(|angle| angle.abs() > limit))
    }

    fn say_far(&mut self, target: TargetId, wanted: &Pose) {
        let ground = self.ground;
        self.findings.push(ground.at_target(
            OUT_OF_REACH,
            Severity::Error,
            target,
            format!(
                "the robot would go {:e} mm away to {}; the limit is {} mm",
                mm_from_m(plausibility::farthest(&wanted.translation)),
                ground.name_of(target),
                mm_from_m(plausibility::FARTHEST_M)
            ),
            "is it in the unit of the language (metres in URScript, else millimetres)?",
        ));
    }

    fn say_endless(&mut self, target: TargetId, (what, angle, limit): (&str, f64, f64)) {
        let ground = self.ground;
        let shown = if angle.abs() < READABLE {
            angle.to_string()
        } else {
            format!("{angle:e}")
        };
        self.findings.push(ground.at_target(
            "angle-too-large",
            Severity::Error,
            target,
            format!(
                "an angle of {shown} in {what} of {}; the limit is {limit:.3}",
                ground.name_of(target),
            ),
            "is it in the unit of the language (radians in URScript, else degrees)? write angles \
             of a few rotations at most",
        ));
    }
}

fn is_alike(a: &Arrival, b: &Arrival) -> bool {
    a.known == b.known
        && (a.assumed == 0) == (b.assumed == 0)
        && a.branch == b.branch
        && a.direction == b.direction
        && (0..6).all(|i| (a.q[i] - b.q[i]).abs() < SAME_RAD)
}
