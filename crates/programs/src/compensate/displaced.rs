//! Points that the running program derives from a target (`Offs`, `RelTool`) take its correction
//! along; here is found how far from their own wanted poses they land: with the tool, in the work
//! frame and where external axes stand at the move to them.

use super::approach::Approach;
use super::{Job, LIMIT_DERIVED_M, strides};
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Separation, norm};
use crate::inverse::Branch;
use crate::motion::walk::{Arrival, Arrivals};
use crate::program::script::short;
use crate::program::{Displacement, Move, SOMEHOW_M, Shift};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::f64::consts::TAU;

/// So far from a target is looked how long its correction is right, metres.
const DISTANCES_M: [f64; 10] = [1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 0.1, 0.2, 0.5, 1.0];

fn is_displaced(motion: &Move) -> bool {
    motion.displacement != Displacement::None
}

/// The targets that points are derived from.
pub(super) fn bases(job: &Job) -> BTreeSet<usize> {
    let displaced = job.ground.program.moves.iter().filter(|m| is_displaced(m));
    displaced.filter_map(|motion| motion.target).collect()
}

/// The known arrivals at moves to points that are derived from a target, by move.
pub(super) fn arrivals(job: &Job, arrivals: &Arrivals) -> BTreeMap<usize, Vec<Arrival>> {
    let moves = job.ground.program.moves.iter().enumerate();
    let displaced = moves.filter(|(_, motion)| is_displaced(motion));
    let known = |at: usize| {
        let here = arrivals.at(at).map(|index| arrivals.all[index]);
        here.filter(|arrival| arrival.known).collect()
    };
    displaced.map(|(at, _)| (at, known(at))).collect()
}

/// How far off its own wanted pose may land what takes the numbers of another.
pub(super) fn limit_m(job: &Job) -> f64 {
    job.options.max_derived_error_m.unwrap_or(LIMIT_DERIVED_M)
}

/// Adds a finding for each move to a displaced target; `fakes` has the fake targets of those that
/// points are derived from.
pub(super) fn check(
    job: &Job,
    arrivals: &BTreeMap<usize, Vec<Arrival>>,
    approaches: &[Approach],
    fakes: &BTreeMap<usize, Pose>,
    findings: &mut Vec<Finding>,
) {
    let ground = &job.ground;
    let limit_m = limit_m(job);
    let mut judged = Judged::default();
    for (&at, arrivals) in arrivals {
        let motion = &ground.program.moves[at];
        let Some(target) = motion.target else {
            continue;
        };
        let first = approaches.partition_point(|approach| (approach.target as usize) < target);
        let approach = approaches
            .get(first)
            .filter(|approach| approach.target as usize == target);
        let (Some(approach), Some(fake)) = (approach, fakes.get(&target)) else {
            continue;
        };
        let uses = uses(job, arrivals, at, approach);
        let name = ground.name_of(target);
        let hint = "give the point a target of its own if it must be exact; --max-derived-error \
            raises the limit";
        let limit_mm = mm_from_m(limit_m);
        let severity_of = |miss_m: f64| {
            if miss_m > limit_m {
                Severity::Error
            } else {
                Severity::Warning
            }
        };
        // the largest miss at these places from the target; from which side joints come there
        // nobody knows, and that is a finding of its own
        let most_m = |shifts: &mut dyn Iterator<Item = Shift>| -> f64 {
            let uses = uses.iter().map(|of| Approach {
                direction: approach.direction,
                ..*of
            });
            let uses: Vec<Approach> = uses.collect();
            let gaps = shifts.flat_map(|shift| {
                let gaps = uses.iter().map(move |of| landing(job, of, fake, &shift));
                gaps.collect::<Vec<_>>()
            });
            gaps.flatten().map(|gap| gap.distance_m).fold(0.0, f64::max)
        };
        // how far from the target its correction is worth that much
        let holds = || {
            let holds = |by: &f64| most_m(&mut strides::along_each_axis(*by)) <= limit_m;
            match DISTANCES_M.iter().take_while(|by| holds(by)).last() {
                Some(by) => format!("within the limit up to {:.0} mm from it", mm_from_m(*by)),
                None => "within the limit for less than 1 mm from it".into(),
            }
        };
        let unbounded = || {
            let message = format!(
                "a copy of {name} is displaced in a way that the text does not bound, or that is \
                 not followed (again and again, by many steps, by where the robot is, by what is \
                 computed of other numbers): how far from {name} it comes is not known; its correction is right {} \
                 (the limit is {limit_mm:.3} mm)",
                holds()
            );
            ("displacement-unknown", Severity::Error, message)
        };
        let (id, severity, message) = match &motion.displacement {
            Displacement::None => continue,
            Displacement::Unknown => {
                let most = most_m(&mut strides::along_each_axis(SOMEHOW_M));
                let message = format!(
                    "a point derived from {name} at run time takes its correction along: up to \
                     {:.0} mm from it that is {:.3} mm off (the limit is {limit_mm:.3} mm), and {}",
                    mm_from_m(SOMEHOW_M),
                    mm_from_m(most),
                    holds(),
                );
                ("displacement-unknown", severity_of(most), message)
            }
            Displacement::Within(steps) => {
                let reach_m = reach_m(job, approach);
                let most = judged.most_m(&motion.displacement, &uses, || {
                    let places = strides::places(steps, reach_m, false)?;
                    Some(most_m(&mut places.into_iter()))
                });
                if let Some(most) = most {
                    let message = format!(
                        "a point derived from {name} takes its correction along {}: within reach \
                         that is up to {:.3} mm off (the limit is {limit_mm:.3} mm)",
                        strides::in_words(steps),
                        mm_from_m(most),
                    );
                    ("displacement-unknown", severity_of(most), message)
                } else {
                    unbounded()
                }
            }
            Displacement::AtLeast(steps) => {
                let reach_m = reach_m(job, approach);
                let most = judged.most_m(&motion.displacement, &uses, || {
                    let known = strides::places(steps, reach_m, true)?.into_iter();
                    Some(most_m(
                        &mut known.chain(strides::along_each_axis(SOMEHOW_M)),
                    ))
                });
                if let Some(most) = most {
                    let message = format!(
                        "a point derived from {name} at run time takes its correction along: the \
                         numbers of the text alone, with 1 for each factor that only the running \
                         program knows, lead it {}, and on that way within reach it is up to {:.3} \
                         mm off (the limit is {limit_mm:.3} mm)",
                        strides::in_words(steps),
                        mm_from_m(most),
                    );
                    ("displacement-unknown", severity_of(most), message)
                } else {
                    unbounded()
                }
            }
            Displacement::Unbounded => unbounded(),
            Displacement::Overwritten => {
                // of numbers that are all written over nothing is left, of others some
                let lost = uses.iter().flat_map(|of| {
                    let given = [of.numbers_in_frame(job), *fake];
                    given.map(|given| landing(job, of, &given, &Shift::none()))
                });
                let lost_m = lost.flatten().map(|gap| gap.distance_m).fold(0.0, f64::max);
                let message = format!(
                    "the running program writes numbers over some of a copy of {name}: these lose \
                     a correction of {:.3} mm (the limit is {limit_mm:.3} mm)",
                    mm_from_m(lost_m),
                );
                ("target-overwritten", severity_of(lost_m), message)
            }
            Displacement::By(shift) => {
                let landings = uses.iter().map(|of| landing(job, of, fake, shift));
                let farthest = landings.reduce(|a, b| {
                    let (a, b) = (a?, b?);
                    Some(if b.distance_m > a.distance_m { b } else { a })
                });
                let (severity, message) = match farthest.flatten() {
                    None => (
                        Severity::Warning,
                        format!("a point derived from {name} is out of reach"),
                    ),
                    Some(gap) => (
                        if gap.distance_m > limit_m {
                            Severity::Warning
                        } else {
                            Severity::Note
                        },
                        format!(
                            "a point derived from {name} takes its correction along and lands \
                             {:.3} mm off its own wanted pose",
                            mm_from_m(gap.distance_m)
                        ),
                    ),
                };
                ("displaced-target", severity, message)
            }
        };
        findings.push(ground.at_move(id, severity, motion, message, hint));
    }
}

/// Displacements that were judged last: many moves to the same target are displaced by the same
/// numbers, and each is judged at thousands of places.
#[derive(Default)]
struct Judged {
    last: VecDeque<(Displacement, Vec<Use>, Option<f64>)>,
}

/// Displacements that are remembered.
const MOST_JUDGED: usize = 16;

/// What the error of a use depends on: the target, with what the robot comes there and in which
/// posture, with whole rotations.
#[derive(Clone, PartialEq)]
struct Use {
    target: u32,
    tool: u32,
    frame: u32,
    branch: Branch,
    direction: [i8; 6],
    middle: bool,
    rotations: [f64; 6],
}

impl Use {
    fn of(approach: &Approach) -> Self {
        Self {
            target: approach.target,
            tool: approach.tool,
            frame: approach.frame,
            branch: approach.branch,
            direction: approach.direction,
            middle: approach.middle.is_some(),
            rotations: approach.nominal_q.map(|q| (q / TAU).round()),
        }
    }
}

impl Judged {
    /// The largest miss of a displacement, worked out where it is none of the last; `None` where
    /// nothing bounds it.
    fn most_m(
        &mut self,
        displacement: &Displacement,
        uses: &[Approach],
        work_out: impl FnOnce() -> Option<f64>,
    ) -> Option<f64> {
        let uses: Vec<Use> = uses.iter().map(Use::of).collect();
        let is_arc = uses.iter().any(|of| of.middle);
        let same = |of: &&(Displacement, Vec<Use>, Option<f64>)| {
            of.0 == *displacement && of.1 == uses && !is_arc
        };
        if let Some((_, _, most)) = self.last.iter().find(same) {
            return *most;
        }
        let most = work_out();
        self.last.truncate(MOST_JUDGED - 1);
        self.last.push_front((displacement.clone(), uses, most));
        most
    }
}

/// Between two points that the tool reaches is no more than this, metres.
fn reach_m(job: &Job, approach: &Approach) -> f64 {
    let tool = approach.tool as usize;
    let equipped = job.ground.arm_with(tool);
    let links: f64 = equipped.inverse.real.reaches().iter().sum();
    let mounted = job.ground.setting.tools[tool].as_ref();
    2.0 * (links + mounted.map_or(0.0, |mounted| norm(mounted.flange_from_tool.translation)))
}

/// How the robot comes to a point that is derived from the target of an approach: with the posture
/// of that where the walk does not know its own.
fn uses(job: &Job, arrivals: &[Arrival], at: usize, approach: &Approach) -> Vec<Approach> {
    let motion = &job.ground.program.moves[at];
    let there = Approach {
        motion: short(at),
        tool: short(motion.tool),
        frame: short(job.ground.frame_of(motion)),
        ..*approach
    };
    if arrivals.is_empty() {
        return vec![there];
    }
    let of = |arrival: &Arrival| Approach {
        nominal_q: arrival.q,
        branch: arrival.branch,
        direction: arrival.direction,
        middle: arrival.middle,
        ..there
    };
    arrivals.iter().map(of).collect()
}

/// How far from its wanted pose a displaced use of a target lands whose numbers in the work frame
/// are given; `None` where the controller does not reach it.
fn landing(
    job: &Job,
    approach: &Approach,
    given_in_frame: &Pose,
    shift: &Shift,
) -> Option<Separation> {
    let ground = &job.ground;
    let placed = ground.placed(approach.frame as usize);
    let at = |numbers: &Pose| approach.taken(shift.apply(numbers));
    let wanted = placed.real * at(&approach.numbers_in_frame(job));
    let given = placed.nominal * at(given_in_frame);
    let equipped = ground.arm_with(approach.tool as usize);
    let (q, reached) = equipped.controller_joints(&given, approach.branch, &approach.nominal_q);
    let real = &equipped.inverse.real;
    reached.then(|| {
        real.forward(&q, &approach.conditions(job))
            .separation(&wanted)
    })
}
