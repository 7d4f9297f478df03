//! What may leave the robot elsewhere than the text says before a move: calls of routines that are
//! not in the files, searches that stop on their way, interrupts that move the robot. Joints may
//! come from other sides then, and the robot go on in another posture.

use super::Job;
use super::approach::Approach;
use super::solve::is_directed;
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Vector, norm, sub};
use crate::inverse::Branch;
use crate::model::Conditions;
use crate::motion::placed::Placed;
use crate::motion::posture;
use crate::motion::sides;
use crate::motion::walk::Arrivals;
use crate::program::{Called, Configuration, Interrupt, Motion, Stand, Value};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// A tool that the other sides of its joints, or another posture, put less off is not reported,
/// metres.
const LEAST_M: f64 = 2e-5;

/// What leads the robot elsewhere before a move.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum By {
    /// Index in [`crate::program::Program::calls`].
    Call(u32),
    /// Index in [`crate::program::Program::interrupts`].
    Interrupt(usize),
}

/// What may be otherwise then.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum What {
    Sides,
    Posture,
}

/// How far the tool is off at most, metres, at the end of which approach, and the moves behind the
/// cause.
struct Worst {
    off_m: f64,
    approach: Approach,
    moves: BTreeSet<u32>,
}

/// The worst of what calls and interrupts do to the moves behind them.
pub(super) struct Led {
    is_led: bool,
    is_directed: bool,
    /// The branches in which each interrupt may leave the robot.
    left_in: Vec<Vec<Branch>>,
    /// The call behind which the posture at each arrival goes on; empty where there is none.
    behind: Vec<Option<u32>>,
    /// By what is otherwise, and the cause.
    worst: BTreeMap<(What, By), Worst>,
}

impl Led {
    pub(super) fn of(job: &Job, arrivals: &Arrivals) -> Self {
        let program = job.ground.program;
        let left_in = |of: &Interrupt| {
            if of.foreign.is_some() {
                return Branch::ALL.to_vec();
            }
            let all = of.moves.iter();
            let all = all.flat_map(|motion| arrivals.at(*motion as usize));
            let mut branches = BTreeSet::new();
            for arrival in all.map(|at| &arrivals.all[at]) {
                let motion = &program.moves[arrival.motion as usize];
                if arrival.known {
                    branches.insert(arrival.branch);
                } else if motion.motion == Motion::Joint {
                    return Branch::ALL.to_vec();
                }
            }
            branches.into_iter().collect()
        };
        Self {
            behind: behind_calls(job, arrivals),
            is_led: !program.led.is_empty() || !program.interrupts.is_empty(),
            is_directed: is_directed(job)
                || (program.frames.iter()).any(|of| of.stand.as_ref().is_some_and(has_sides)),
            left_in: program.interrupts.iter().map(left_in).collect(),
            worst: BTreeMap::new(),
        }
    }

    /// Notes how far the tool is off at the end of a move where joints with backlash come from the
    /// other side than they do from the move before the call, or the interrupt, and where the robot
    /// is in another posture behind it.
    pub(super) fn look(&mut self, job: &Job, approach: &Approach) {
        if !self.is_led {
            return;
        }
        let program = job.ground.program;
        let called = program
            .led
            .binary_search_by_key(&approach.motion, |(motion, _)| *motion);
        let called = called.ok().map(|at| By::Call(program.led[at].1));
        let interrupts = program.interrupts.iter().enumerate();
        let other =
            |(_, of): &(usize, &Interrupt)| of.moves.binary_search(&approach.motion).is_err();
        let others = interrupts.filter(other).map(|(at, _)| By::Interrupt(at));
        let others: Vec<By> = others.collect();
        let causes: Vec<By> = called.into_iter().chain(others.iter().copied()).collect();
        if self.is_directed && !causes.is_empty() {
            let off_m = from_the_other_sides_m(job, approach);
            for by in causes {
                self.note(What::Sides, by, off_m, approach);
            }
        }
        let behind = self.behind.get(approach.arrival as usize).copied();
        let causes: Vec<By> = behind
            .flatten()
            .map(By::Call)
            .into_iter()
            .chain(others)
            .collect();
        if causes.is_empty() {
            return;
        }
        let open = open_branches(job, approach.motion as usize, approach.honoured);
        for by in causes {
            let mut branches = open.clone();
            if let By::Interrupt(at) = by {
                branches.retain(|branch| self.left_in[at].contains(branch));
            }
            let off_m = in_other_postures_m(job, approach, &branches);
            self.note(What::Posture, by, off_m, approach);
        }
    }

    fn note(&mut self, what: What, by: By, off_m: f64, approach: &Approach) {
        if off_m < LEAST_M {
            return;
        }
        let new = || Worst {
            off_m: 0.0,
            approach: approach.clone(),
            moves: BTreeSet::new(),
        };
        let worst = self.worst.entry((what, by)).or_insert_with(new);
        worst.moves.insert(approach.motion);
        if off_m > worst.off_m {
            (worst.off_m, worst.approach) = (off_m, approach.clone());
        }
    }

    /// One finding a cause.
    pub(super) fn report(self, job: &Job, findings: &mut Vec<Finding>) {
        let ground = &job.ground;
        let mut new = Vec::new();
        for ((what, by), worst) in self.worst {
            let Worst {
                off_m,
                approach,
                moves,
            } = worst;
            let (place, name, does) = match by {
                By::Call(call) => {
                    let of = &ground.program.calls[call as usize];
                    let does = "may leave the robot elsewhere than the text says";
                    (&of.place, &of.name, Cow::from(does))
                }
                By::Interrupt(at) => {
                    let of = &ground.program.interrupts[at];
                    (&of.place, &of.name, Cow::from(at_any_time(of)))
                }
            };
            let hint = match (what, by) {
                (What::Sides, By::Call(_)) => {
                    "give the files of the routine with --with, or go to a point of the text \
                     first, from which the joints come as they should"
                }
                (What::Sides, By::Interrupt(_)) => {
                    "go back in it to where the program was, on a longer move, from where joints \
                     come as they did; give the files of what it calls with --with"
                }
                (What::Posture, By::Call(_)) => {
                    "give the files of the routine with --with, or go to joints behind the call"
                }
                (What::Posture, By::Interrupt(_)) => {
                    "nothing is off where it ends in the joints in which it began; give the files of \
                     what it calls with --with"
                }
            };
            let motion = &ground.program.moves[approach.motion as usize];
            // of files that are read for their declarations nothing is reported
            let is_context = ground.sources[place.file as usize].is_context;
            let (file, offset) = if is_context {
                (motion.file, motion.offset)
            } else {
                (place.file, place.offset)
            };
            let mut line = format!("line {}", ground.line_of(motion));
            if file != motion.file {
                line += &format!(" of {}", ground.sources[motion.file as usize].name);
            }
            let to = ground.name_of(approach.target as usize);
            let otherwise = match what {
                What::Sides => {
                    let equipped = ground.arm_with(approach.tool as usize);
                    let joints: Vec<String> = (0..6)
                        .filter(|&i| equipped.has_backlash[i] && approach.direction[i] != 0)
                        .map(|i| (i + 1).to_string())
                        .collect();
                    let of = |what: &str, names: &[String]| {
                        (!names.is_empty()).then(|| format!("{what} {}", names.join(", ")))
                    };
                    let axes = external_sides(job, &approach);
                    let both = [of("joint", &joints), of("external axis", &axes)];
                    let both: Vec<String> = both.into_iter().flatten().collect();
                    format!(
                        "{} with backlash may come from the other side to {to}",
                        both.join(" and ")
                    )
                }
                What::Posture => format!("the robot may come in another posture to {to}"),
            };
            let others = match moves.len() {
                1 => String::new(),
                2 => ", and at another move".to_owned(),
                count => format!(", and at {} other moves", count - 1),
            };
            let message = format!(
                "{} {does}; if it does, {otherwise} in {line}, and the tool be {:.3} mm off{others}",
                shown(name),
                mm_from_m(off_m)
            );
            let id = match what {
                What::Sides => "direction-uncertain",
                What::Posture => "posture-assumed",
            };
            let severity = Severity::Warning;
            let found = ground.finding(id, severity, file, offset, message, hint);
            // of a thread that moves joints its posture is reported already
            let is_same = |of: &Finding| {
                of.id == "posture-assumed" && (&of.file, of.line) == (&found.file, found.line)
            };
            if what == What::Sides || is_context || !findings.iter().any(is_same) {
                new.push(found);
            }
        }
        findings.extend(new);
    }
}

/// A name, or what stands for one.
fn shown(name: &str) -> String {
    if name.starts_with("a ") {
        name.to_owned()
    } else {
        format!("`{name}`")
    }
}

/// What an interrupt does to the others.
fn at_any_time(of: &Interrupt) -> String {
    match of.foreign.as_deref() {
        None => "moves the robot, and may run between any two moves of the others".to_owned(),
        Some(name) if name == &*of.name => {
            "is not in the files, and may move the robot between any two moves of the others"
                .to_owned()
        }
        Some(name) => format!(
            "calls {}, which is not in the files and may move the robot between any two moves of the \
             others",
            shown(name)
        ),
    }
}

/// The first call of the routine that is not in the files behind which the posture at each arrival
/// goes on; empty where none is called.
fn behind_calls(job: &Job, arrivals: &Arrivals) -> Vec<Option<u32>> {
    let program = job.ground.program;
    if !program.calls.iter().any(|of| of.is_foreign) {
        return Vec::new();
    }
    let mut first = HashMap::new();
    let calls = (0..).zip(&program.calls);
    let first_of = |(at, of): (u32, &Called)| *first.entry(of.name.clone()).or_insert(at);
    let first: Vec<u32> = calls.map(first_of).collect();
    let mut behind: Vec<Option<u32>> = Vec::with_capacity(arrivals.all.len());
    // predecessors come first in the list
    for arrival in &arrivals.all {
        let motion = arrival.motion;
        let led = program.led.binary_search_by_key(&motion, |led| led.0);
        // a search stops on its path
        let called = led.ok().map(|at| program.led[at].1);
        let called = called.filter(|call| program.calls[*call as usize].is_foreign);
        let called = called.map(|call| first[call as usize]);
        let before = behind.get(arrival.from as usize).copied().flatten();
        let cause = called.or(before);
        let is_open = |_: &u32| {
            let all = open_branches(job, motion as usize, arrival.honoured);
            all.iter().any(|branch| *branch != arrival.branch)
        };
        behind.push(cause.filter(is_open));
    }
    behind
}

/// The branches on which the robot may come to the target of a move, as far as the file says.
fn open_branches(job: &Job, motion: usize, honoured: bool) -> Vec<Branch> {
    let ground = &job.ground;
    let motion = &ground.program.moves[motion];
    let mut all = Branch::ALL.to_vec();
    let goal = ground.goal(motion);
    if ground.program.near(motion).is_some()
        || goal
            .as_ref()
            .is_some_and(|goal| matches!(goal.value, Value::Joints(_)))
    {
        return Vec::new();
    }
    let Some(goal) = goal.filter(|_| honoured) else {
        return all;
    };
    let of = goal.configuration;
    let is_said = of
        != Configuration {
            kept: of.kept,
            ..Configuration::default()
        };
    if is_said && of.kept == [false; 3] {
        return Vec::new();
    }
    all.retain(|branch| {
        let sides = [
            (of.behind_axis_1, branch.behind_axis_1),
            (of.behind_lower_arm, branch.behind_lower_arm),
            (of.joint_5_negative, branch.joint_5_negative),
        ];
        sides
            .iter()
            .all(|(said, has)| said.is_none_or(|said| said == *has))
    });
    all
}

/// How far the tool may be off the part where joints and external axes with backlash come from the
/// other side.
fn from_the_other_sides_m(job: &Job, approach: &Approach) -> f64 {
    let equipped = job.ground.arm_with(approach.tool as usize);
    let conditions = approach.conditions(job);
    let real = &equipped.inverse.real;
    let landing = |conditions: &Conditions| real.forward(&approach.nominal_q, conditions);
    let open = (0..6).filter(|&i| equipped.has_backlash[i] && approach.direction[i] != 0);
    let joints = open.map(|i| sides::other_side(landing, &conditions, i));
    let mut steps: Vec<Vector> = joints.collect();
    if let Some(stand) = job.ground.stand_in(approach.frame as usize) {
        let on_part = |axis: usize, side: f64| {
            let mut stand = stand.clone();
            stand.directions[axis] *= side;
            let part = Placed::at(job.ground.profile, &stand, Pose::identity());
            (part.real.inverse() * landing(&conditions)).translation
        };
        let axes = (0..stand.directions.len()).filter(|&axis| stand.directions[axis] != 0.0);
        let by = axes.map(|axis| sub(on_part(axis, -1.0), on_part(axis, 1.0)));
        // seen from the arm: the sides of joints are
        let part = Placed::at(job.ground.profile, stand, Pose::identity());
        steps.extend(by.map(|by| part.real.rotation * by));
    }
    let steps: Vec<_> = steps
        .iter()
        .map(|step| (*step, &sides::OR_OTHER[..]))
        .collect();
    sides::largest_sum(&steps)
}

/// Whether it matters from which side external axes come.
fn has_sides(stand: &Stand) -> bool {
    stand.directions.iter().any(|of| *of != 0.0)
}

/// External axes for which it matters from which side they come, by their names.
fn external_sides(job: &Job, approach: &Approach) -> Vec<String> {
    let ground = &job.ground;
    let stand = ground.stand_in(approach.frame as usize);
    let directions = stand.iter().flat_map(|stand| &stand.directions);
    let axes = ground.profile.external.listed().zip(directions);
    let axes = axes.filter(|(_, direction)| **direction != 0.0);
    axes.map(|(axis, _)| axis.name().to_owned()).collect()
}

/// How far the tool is off where the robot comes to the target on another one of these branches.
fn in_other_postures_m(job: &Job, approach: &Approach, branches: &[Branch]) -> f64 {
    let equipped = job.ground.arm_with(approach.tool as usize);
    let conditions = approach.conditions(job);
    let meant = approach.meant(job);
    let error = |q: &[f64; 6]| {
        let real = equipped.inverse.real.forward(q, &conditions);
        let believed = equipped.controller.forward(q, &Conditions::default());
        sub(real.translation, believed.translation)
    };
    let here = error(&approach.nominal_q);
    let others = branches.iter().filter(|branch| **branch != approach.branch);
    let any = Configuration::default();
    let found = others.filter_map(|branch| {
        posture::on_branch(&equipped.arm, &meant, *branch, &approach.nominal_q, &any)
    });
    let off = found.map(|posture| norm(sub(error(&posture.q), here)));
    off.fold(0.0, f64::max)
}
