//! The path of one move: followed from the posture where it begins to the branch at its end, and
//! which way each joint moves there.

use super::arms::Equipped;
use super::course::{Course, ToolCourse};
use super::leg::{Leg, STANDSTILL_RAD, STANDSTILL_RAD_M};
use super::ride::Ride;
use super::walk::WalkOptions;
use crate::geometry::Pose;
use crate::geometry::units::DEG;
use crate::inverse::{Arm, Branch};
use crate::model::{Conditions, Mechanism};
use crate::program::{Motion, Move};
use std::sync::Arc;

/// A joint that moves more in a step of a path may have gone round: the step is halved.
const MOST_STEP_RAD: f64 = 45.0 * DEG;
/// Nearer to alignment than this is near the wrist's singularity; a path passes it where joint 4 sweeps
/// by more than the second angle there.
const NEAR_WRIST_RAD: f64 = 5.0 * DEG;
const LEAST_SWEEP_RAD: f64 = 90.0 * DEG;
/// A path that passes the wrist's singularity nearer than this goes through it: a straight line
/// between two points of a curve that does. Nearer than the second angle, or farther than the third,
/// nothing else is meant.
const THROUGH_WRIST_RAD: f64 = 0.5 * DEG;
pub(super) const SURELY_THROUGH_RAD: f64 = 0.1 * DEG;
const SURELY_PAST_RAD: f64 = 1.0 * DEG;
/// What is farther from it by less is as near.
const AS_NEAR_RAD: f64 = 0.001 * DEG;
/// Parts in which a path is looked at for where it is nearest to it, and how often that is narrowed.
const SAMPLES: u32 = 64;
const NARROWINGS: usize = 40;
/// The shortest step of a path.
const SHORTEST_STEP: f64 = 1.0 / 2048.0;
/// A path that rotates the tool by more, or is longer, is followed in several steps.
const MANY_RAD: f64 = 30.0 * DEG;
const MANY_M: f64 = 0.25;
/// Nearer to a singularity than this a posture belongs to both branches.
const SINGULAR_RAD: f64 = 0.02 * DEG;
const SINGULAR_M: f64 = 1e-4;
/// How far along a path that begins at a singularity its branch is seen.
const BEYOND_SINGULAR: f64 = 0.02;

/// Directions after a move of the joints at constant rates: those of the angles that turn them.
pub(crate) fn turned(
    mechanism: &Mechanism,
    from: &[f64; 6],
    to: &[f64; 6],
    before: [i8; 6],
) -> [i8; 6] {
    let (from, to) = (mechanism.commanded(from), mechanism.commanded(to));
    std::array::from_fn(|i| sign(to[i] - from[i], STANDSTILL_RAD).unwrap_or(before[i]))
}

fn sign(by: f64, least: f64) -> Option<i8> {
    (by.abs() > least).then_some(if by > 0.0 { 1 } else { -1 })
}

/// The controller's path of a move.
#[allow(
    clippy::too_many_arguments,
    reason = "where it begins, over what it goes, where it ends, on what it rides"
)]
pub(crate) fn course(
    motion: &Move,
    equipped: &Equipped,
    start: &[f64; 6],
    via: Option<&Pose>,
    wanted: &Pose,
    q: &[f64; 6],
    ride: Option<Arc<Ride>>,
    walk_options: &WalkOptions,
) -> Course {
    if motion.motion == Motion::Joint {
        return Course::Joint {
            from: *start,
            to: *q,
        };
    }
    let from = equipped.controller.forward(start, &Conditions::default());
    let turning = walk_options.turning;
    Course::Tool(ToolCourse::of(&from, via, wanted, turning, ride))
}

/// Where a path of the tool ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Followed {
    pub branch: Branch,
    pub q: [f64; 6],
    /// Where it goes through the wrist's singularity, or passes it so that it is not certain whether
    /// joint 5 does.
    pub passing: Option<Passing>,
}

/// How a path passes the wrist's singularity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passing {
    /// How near, radians.
    pub by_rad: f64,
    /// Joint 5 is taken to go through; else the joints next to it sweep.
    pub is_through: bool,
}

/// Follows a path of the tool on the branch where it begins: the joints at its end, whole rotations
/// by continuity. `None` where it leaves the reach on its way.
///
/// Where the path passes the wrist's singularity the joints next to it sweep, and the robot keeps to
/// its side; but very near it goes through.
///
/// `end` is the pose at its end: on the path it is the same but for rounding.
///
/// # Source
/// ABB, Technical reference manual RAPID Instructions, `SingArea`: with `\Off` axes may make a
/// sweeping movement near a singular point, and the tool keeps its orientation.
pub(crate) fn follow(
    equipped: &Equipped,
    course: &Course,
    start: &[f64; 6],
    end: &Pose,
) -> Option<Followed> {
    let Course::Tool(path) = course else {
        return None;
    };
    let arm = &equipped.arm;
    let at = |s: f64, branch: Branch, near: &[f64; 6]| {
        let pose = if s < 1.0 { path.pose(s) } else { *end };
        // several answers of such an arm are on one branch: the one to which the path leads
        if arm.has_offset_wrist()
            && let Ok(q) = arm.follow(near, &pose)
        {
            return Some(q);
        }
        let solution = arm.solve_along(&pose, branch, near);
        (solution.beyond == 0.0).then_some(solution.q)
    };
    let (mut branch, margins) = arm.posture(start);
    let is_singular = margins.wrist_rad < SINGULAR_RAD
        || margins.elbow_rad < SINGULAR_RAD
        || margins.shoulder_m < SINGULAR_M;
    if is_singular {
        let away = |branch: &Branch| {
            let q = at(BEYOND_SINGULAR, *branch, start)?;
            Some((0..6).map(|i| (q[i] - start[i]).abs()).fold(0.0, f64::max))
        };
        let nearest = Branch::ALL
            .iter()
            .filter_map(|branch| Some((away(branch)?, *branch)))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        branch = nearest?.1;
    }
    let is_long = path.angle_rad() > MANY_RAD || path.length_m() > MANY_M;
    let steps = if is_long || arm.has_offset_wrist() && path.is_arc() {
        8.0
    } else {
        1.0
    };
    let longest = 1.0 / steps;
    let (mut s, mut step, mut q) = (0.0_f64, longest, *start);
    let is_near = |q: &[f64; 6]| arm.posture(q).1.wrist_rad < NEAR_WRIST_RAD;
    let (mut entry, mut passing): (Option<(f64, [f64; 6])>, Option<Passing>) = (None, None);
    while s < 1.0 {
        let next: f64 = (s + step).min(1.0);
        let there = at(next, branch, &q)?;
        let most = farthest(&there, &q);
        if most > MOST_STEP_RAD
            && step > SHORTEST_STEP
            && !(is_singular && s == 0.0 && step < BEYOND_SINGULAR)
        {
            step *= 0.5;
            continue;
        }
        // a short path on which no joint sweeps needs no second look, nor an arm whose answers are
        // followed on their track
        if next - s < 1.0 && !arm.has_offset_wrist() {
            if entry.is_none() && (is_near(&q) || is_near(&there)) {
                entry = Some((s, q));
            }
            let is_behind = next == 1.0 || !is_near(&there);
            if let Some((from, before)) = entry.take_if(|_| is_behind)
                && let Some((by_rad, other, behind)) =
                    past_wrist(arm, branch, at, [(from, &before), (s, &q), (next, &there)])
            {
                let is_through = by_rad < THROUGH_WRIST_RAD;
                if by_rad < SURELY_PAST_RAD {
                    passing = Some(Passing { by_rad, is_through });
                }
                if is_through {
                    (s, q, branch) = (next, behind, other);
                    continue;
                }
            }
        }
        (s, q) = (next, there);
        step = (2.0 * step).min(longest);
    }
    if arm.has_offset_wrist() {
        // the track of such an arm goes from branch to branch
        branch = arm.posture(&q).0;
    }
    Some(Followed { branch, q, passing })
}

/// Where joint 5 goes through the wrist's singularity on a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// The part of the path.
    pub at: f64,
    /// The branch before.
    pub before: Branch,
    /// Where the path comes near the singularity, and where it leaves it.
    pub region: [f64; 2],
}

/// Where joint 5 goes through the wrist's singularity on a path that ends on a branch; `None` where it
/// does not, or begins there.
pub(super) fn crossing(
    equipped: &Equipped,
    path: &ToolCourse,
    start: &[f64; 6],
    end: Branch,
) -> Option<Crossing> {
    let arm = &equipped.arm;
    let (branch, margins) = arm.posture(start);
    let is_other = branch.joint_5_negative != end.joint_5_negative
        && branch
            == Branch {
                joint_5_negative: branch.joint_5_negative,
                ..end
            };
    if !is_other || margins.wrist_rad < SINGULAR_RAD || arm.has_offset_wrist() {
        return None;
    }
    let margin = |s: f64| {
        let solution = arm.solve_along(&path.pose(s), end, start);
        (solution.beyond == 0.0).then(|| arm.posture(&solution.q).1.wrist_rad)
    };
    let (at, _) = passage(margin, 0.0, 1.0)?;
    let is_near = |s: f64| Some(margin(s)? < NEAR_WRIST_RAD);
    let region = [border(is_near, 0.0, at)?, border(is_near, 1.0, at)?];
    Some(Crossing {
        at,
        before: branch,
        region,
    })
}

/// Where a path comes near something, from a part of it that is not near and one that is.
fn border(is_near: impl Fn(f64) -> Option<bool>, mut outside: f64, mut inside: f64) -> Option<f64> {
    if is_near(outside)? {
        return Some(outside);
    }
    for _ in 0..NARROWINGS {
        let middle = 0.5 * (outside + inside);
        if is_near(middle)? {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    Some(inside)
}

fn farthest(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    (0..6).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}

/// How near a path passes the wrist's singularity on whose other side joint 4 has swept, radians, and
/// the joints there with joint 5 on its other side. `at` gives the joints of a part of the path on a
/// branch; `samples` are the last one before the region around the singularity, the last one in it,
/// and the first one behind.
fn past_wrist(
    arm: &Arm,
    branch: Branch,
    at: impl Fn(f64, Branch, &[f64; 6]) -> Option<[f64; 6]>,
    samples: [(f64, &[f64; 6]); 3],
) -> Option<(f64, Branch, [f64; 6])> {
    let [(from, before), (inside, q), (to, there)] = samples;
    let margin = |s: f64| Some(arm.posture(&at(s, branch, before)?).1.wrist_rad);
    let is_near = |s: f64| Some(margin(s)? < NEAR_WRIST_RAD);
    let (first, by_rad) = passage(margin, from, to)?;
    let enters = border(is_near, from, first)?;
    let leaves = border(is_near, to, first.max(inside))?;
    let sweep = at(leaves, branch, if leaves > inside { there } else { q })?[3]
        - at(enters, branch, before)?[3];
    if by_rad >= NEAR_WRIST_RAD || sweep.abs() < LEAST_SWEEP_RAD {
        return None;
    }
    let other = Branch {
        joint_5_negative: !branch.joint_5_negative,
        ..branch
    };
    let near = at(enters, branch, before)?;
    let behind = at(to, other, &at(leaves, other, &near)?)?;
    Some((by_rad, other, behind))
}

/// Where between two parts of a path something is least that is more on both sides, and how much it
/// is there.
fn passage(of: impl Fn(f64) -> Option<f64>, from: f64, to: f64) -> Option<(f64, f64)> {
    let part = (to - from) / f64::from(SAMPLES);
    let samples = (0..=SAMPLES).map(|at| {
        let s = from + part * f64::from(at);
        Some((s, of(s)?))
    });
    let samples: Vec<(f64, f64)> = samples.collect::<Option<_>>()?;
    let mut passage: Option<(f64, f64)> = None;
    for (at, (s, value)) in samples.iter().enumerate() {
        let around = &samples[at.saturating_sub(1)..samples.len().min(at + 2)];
        if around.iter().any(|(_, other)| other < value) {
            continue;
        }
        let (mut low, mut high) = ((s - part).max(from), (s + part).min(to));
        for _ in 0..NARROWINGS {
            let third = (high - low) / 3.0;
            let [a, b] = [low + third, high - third];
            if of(a)? < of(b)? {
                high = b;
            } else {
                low = a;
            }
        }
        let s = 0.5 * (low + high);
        let least = of(s)?;
        let rises = |of: &(f64, f64)| of.1 > least + AS_NEAR_RAD;
        let before = samples.iter().filter(|of| of.0 < s).any(rises);
        let behind = samples.iter().filter(|of| of.0 > s).any(rises);
        if before && behind && passage.is_none_or(|other| least < other.1) {
            passage = Some((s, least));
        }
    }
    passage
}

/// As [`arrival_direction`] for a move, on which the joints of the wrist may lead the tool: they then go
/// at constant rates from beginning to end.
///
/// # Source
/// ABB, Technical reference manual RAPID Instructions, `SingArea`: with `\Wrist` the orientation is
/// joint-interpolated. KUKA, `$ORI_TYPE`: with `#JOINT` the axes of the wrist are. FANUC, `Wjnt`.
pub(crate) fn direction_of(
    motion: &Move,
    equipped: &Equipped,
    course: &Course,
    [start, end]: [&[f64; 6]; 2],
    branch: Branch,
    before: [i8; 6],
) -> Coming {
    let mut coming = arrival_direction(equipped, course, start, end, branch, before);
    if leads_wrist(motion) {
        coming.direction[3..]
            .copy_from_slice(&turned(&equipped.mechanism, start, end, before)[3..]);
        coming.half[3..].copy_from_slice(&halfway(start, end)[3..]);
    }
    coming
}

/// Whether the joints of the wrist go at constant rates while the tool goes on a path.
pub(crate) fn leads_wrist(motion: &Move) -> bool {
    motion.free_orientation && motion.motion != Motion::Joint
}

/// The finest part at the end of a path in which a slow joint is looked at: this many times halved.
const FINEST: i32 = 10;

/// How the joints come to the end of a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coming {
    /// As [`super::walk::Arrival::direction`].
    pub direction: [i8; 6],
    /// The joints halfway.
    pub half: [f64; 6],
}

fn halfway(start: &[f64; 6], end: &[f64; 6]) -> [f64; 6] {
    std::array::from_fn(|i| 0.5 * (start[i] + end[i]))
}

/// The sign of each joint's rate at the end of a path; a joint that stands keeps its direction.
fn arrival_direction(
    equipped: &Equipped,
    course: &Course,
    start: &[f64; 6],
    end: &[f64; 6],
    branch: Branch,
    before: [i8; 6],
) -> Coming {
    let mechanism = &equipped.mechanism;
    let Course::Tool(path) = course else {
        return Coming {
            direction: turned(mechanism, start, end, before),
            half: halfway(start, end),
        };
    };
    // a tenth of a millimetre before the end, or of a milliradian where the tool only rotates
    let length = path.length_m() + path.angle_rad();
    if length <= 1e-9 {
        return Coming {
            direction: before,
            half: *start,
        };
    }
    let back = (1e-4 / length).clamp(1e-6, 0.1);
    let leg = leg(equipped, course, start, branch);
    let last = leg.joints(1.0, end);
    let shortly_before = leg.joints(1.0 - back, &last);
    let per = back * length;
    let [to, from] = [&last, &shortly_before].map(|q| mechanism.commanded(q));
    let rates: [f64; 6] = std::array::from_fn(|i| (to[i] - from[i]) / per);
    // a joint that stands at the end keeps what it did on the way
    let half = leg.joints(0.5, end);
    let first = turned(mechanism, start, &half, before);
    let on_way = turned(mechanism, &half, end, first);
    let mut ends: Vec<[f64; 6]> = Vec::new();
    let direction = std::array::from_fn(|i| {
        let at = |q: &[f64; 6]| mechanism.commanded(q)[i];
        let stands = [start, &half]
            .iter()
            .all(|q| (at(q) - to[i]).abs() < STANDSTILL_RAD);
        sign(rates[i], STANDSTILL_RAD_M).unwrap_or_else(|| {
            if stands || !equipped.has_backlash[i] {
                return on_way[i];
            }
            if ends.is_empty() {
                // ever longer parts of the path, up to its end
                let parts = (2..=FINEST).rev().map(|k| 1.0 - 0.5_f64.powi(k));
                ends.extend(parts.map(|s| mechanism.commanded(&leg.joints(s, &last))));
            }
            let mut turns = ends.iter().map(|from| to[i] - from[i]);
            turns
                .find_map(|by| sign(by, STANDSTILL_RAD))
                .unwrap_or(on_way[i])
        })
    });
    Coming { direction, half }
}

/// A path of the controller's joints.
pub(crate) fn leg<'a>(
    equipped: &'a Equipped,
    course: &Course,
    start: &[f64; 6],
    branch: Branch,
) -> Leg<'a> {
    Leg {
        equipped,
        course: course.clone(),
        start: *start,
        branch,
        conditions: Conditions::default(),
        ride: None,
        crossing: None,
    }
    .with_crossing()
}
