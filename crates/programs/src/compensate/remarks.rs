//! What is said of a target whose numbers are written, or cannot be.

use super::approach::Approach;
use super::{Job, singular};
use crate::finding::{Finding, Severity};
use crate::geometry::Separation;
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::inverse::{Outcome, Status};
use crate::model::Conditions;
use crate::motion::ground::Ground;
use crate::program::{Motion, Move, Role, Shape};
use std::collections::BTreeMap;

/// Nearer to a singularity than this the joints move much for a small shift.
const NEAR_STRAIGHT_RAD: f64 = 1.0 * DEG;
const NEAR_AXIS_1_M: f64 = 5.0 * MM;

pub(super) fn rounding(
    job: &Job,
    approach: &Approach,
    rounding: Separation,
    shift: Separation,
) -> Finding {
    // what a field for joints takes is that
    let severity = if job.ground.is_joints(approach.target as usize) {
        Severity::Warning
    } else {
        Severity::Error
    };
    let message = format!(
        "rounding to the file's decimals leaves {} {:.3} mm and {:.3} deg off its wanted pose; the \
         limit is 0.010 mm and 0.010 deg (the shift is {:.3} mm, {:.3} deg)",
        job.ground.name_of(approach.target as usize),
        mm_from_m(rounding.distance_m),
        rounding.angle_rad / DEG,
        mm_from_m(shift.distance_m),
        shift.angle_rad / DEG
    );
    job.ground.at_target(
        "rounding",
        severity,
        approach.target as usize,
        message,
        "--decimals 4 writes more",
    )
}

/// From which side joints come where the robot cuts corners, as a note for each file.
pub(super) fn corners(job: &Job, approaches: &[Approach]) -> Vec<Finding> {
    let moves = &job.ground.program.moves;
    let cut = approaches
        .iter()
        .filter_map(|approach| moves.get(approach.motion as usize))
        .filter(|motion| job.ground.program.speed_zone(motion).cuts_corner());
    let mut files: BTreeMap<u32, (usize, &Move)> = BTreeMap::new();
    for motion in cut {
        let (count, first) = files.entry(motion.file).or_insert((0, motion));
        *count += 1;
        if motion.offset < first.offset {
            *first = motion;
        }
    }
    let note = |(count, first): &(usize, &Move)| {
        let message = format!(
            "corners are cut at {count} targets of this file, here first: joints with backlash are \
             taken to come from the side of \
             the programmed path to the target"
        );
        let (id, hint) = ("corner-direction", "stop at targets that must be exact");
        job.ground.at_move(id, Severity::Note, first, message, hint)
    };
    files.values().map(note).collect()
}

/// Joint targets that do not move with the part: an error where the robot comes on a path of the
/// tool, else a warning for each file.
pub(super) fn staying(ground: &Ground) -> Vec<Finding> {
    let id = "joint-target-stays";
    let hint = "--joint-targets correct moves joint targets with the part; or give the target as a \
        pose";
    let mut findings = Vec::new();
    let mut files: BTreeMap<u32, (usize, &Move)> = BTreeMap::new();
    for motion in &ground.program.moves {
        let is_context = ground.sources[motion.file as usize].is_context;
        let Some(target) = motion
            .target
            .filter(|target| ground.is_joints(*target) && !is_context)
        else {
            continue;
        };
        if motion.motion == Motion::Joint {
            files.entry(motion.file).or_insert((0, motion)).0 += 1;
            continue;
        }
        let message = format!(
            "this move goes on a path of the tool to {}, a joint target, which stays where it is \
             while --work-offset moves the part",
            ground.name_of(target)
        );
        findings.push(ground.at_move(id, Severity::Error, motion, message, hint));
    }
    let warning = |(count, first): &(usize, &Move)| {
        let message = format!(
            "{count} joint moves of this file, here the first, go to joint targets: these stay \
             where they are while --work-offset moves the part"
        );
        ground.at_move(id, Severity::Warning, first, message, hint)
    };
    findings.extend(files.values().map(warning));
    findings
}

pub(super) fn kept_configuration(job: &Job, approach: &Approach, joint: usize) -> Finding {
    let message = format!(
        "the correction takes joint {} of {} across the border of its configuration data, which \
         are those of other \
         targets too and stay: a joint move would come out a turn away",
        joint + 1,
        job.ground.name_of(approach.target as usize)
    );
    job.ground.at_target(
        "configuration-kept",
        Severity::Error,
        approach.target as usize,
        message,
        "go there on a straight line, or move the target away from the border",
    )
}

pub(super) fn changed_configuration(
    job: &Job,
    approach: &Approach,
    roles: &[Role],
    old: &[f64],
    new: &[f64],
) -> Finding {
    let shown = |numbers: &[f64]| {
        let data = numbers
            .iter()
            .zip(roles)
            .filter(|(_, role)| **role == Role::Configuration);
        data.map(|(number, _)| number.to_string())
            .collect::<Vec<_>>()
            .join(", ")
    };
    let message = format!(
        "a joint of {} crosses into another range: configuration {} becomes {}",
        job.ground.name_of(approach.target as usize),
        shown(old),
        shown(new)
    );
    job.ground.at_target(
        "configuration-changed",
        Severity::Warning,
        approach.target as usize,
        message,
        "check the move on the robot slowly",
    )
}

/// Numbers that the file leaves out and that the correction needs.
pub(super) fn inserted_numbers(job: &Job, approach: &Approach, text: &[u8]) -> Finding {
    let message = format!(
        "{} leaves numbers out that are no longer zero: `{}` is put in",
        job.ground.name_of(approach.target as usize),
        String::from_utf8_lossy(text).trim_ascii()
    );
    let target = approach.target as usize;
    job.ground
        .at_target("number-inserted", Severity::Note, target, message, "")
}

pub(super) fn failure(job: &Job, approach: &Approach, outcome: &Outcome) -> Finding {
    let name = job.ground.name_of(approach.target as usize);
    let mechanism = job.ground.arm_with(approach.tool as usize).arm.mechanism();
    let missing = format!(
        "{:.6} mm and {:.6} deg are missing",
        mm_from_m(outcome.residual.distance_m),
        outcome.residual.angle_rad / DEG
    );
    let margins = &outcome.margins;
    let near = format!(
        "wrist {:.3} deg, elbow {:.3} deg, axis 1 {:.1} mm from singular",
        margins.wrist_rad / DEG,
        margins.elbow_rad / DEG,
        mm_from_m(margins.shoulder_m)
    );
    let (id, mut message) = match outcome.status {
        Status::OutOfReach => (
            "out-of-reach",
            format!("the real robot does not reach {name}: {missing}; {near}"),
        ),
        Status::JointLimit(joint) => {
            let limits = &mechanism.joints[joint];
            let at = outcome.q[joint] / DEG;
            let message = format!(
                "to reach {name} joint {} must go to {at:.3} deg; its limits are {:.3} to {:.3} \
                 deg",
                joint + 1,
                limits.min_rad / DEG,
                limits.max_rad / DEG
            );
            ("joint-limit", message)
        }
        Status::BranchLost => (
            "branch-lost",
            format!(
                "the real robot reaches {name} only on another branch than {}; {near}",
                approach.branch
            ),
        ),
        Status::NotConverged | Status::Converged => (
            "not-converged",
            format!("no joints found for {name}: {missing}; {near}"),
        ),
    };
    let motion = job.ground.program.moves.get(approach.motion as usize);
    message.extend(motion.and_then(|motion| job.ground.among_uses(motion)));
    let mut hint = "move the target, or --keep-going to leave it as it is".to_owned();
    if let Some(offers) = singular::offers(job, approach) {
        hint = format!("{hint}; or {offers}");
    }
    job.ground.at_target(
        id,
        Severity::Error,
        approach.target as usize,
        message,
        &hint,
    )
}

pub(super) fn singularity(job: &Job, approach: &Approach, outcome: &Outcome) -> Option<Finding> {
    let margins = &outcome.margins;
    let by = (0..6)
        .map(|i| (outcome.q[i] - approach.nominal_q[i]).abs())
        .fold(0.0, f64::max)
        / DEG;
    let (which, distance) = if margins.wrist_rad < NEAR_STRAIGHT_RAD {
        ("wrist", format!("{:.3} deg", margins.wrist_rad / DEG))
    } else if margins.elbow_rad < NEAR_STRAIGHT_RAD {
        ("elbow", format!("{:.3} deg", margins.elbow_rad / DEG))
    } else if margins.shoulder_m < NEAR_AXIS_1_M {
        (
            "shoulder",
            format!("{:.2} mm", mm_from_m(margins.shoulder_m)),
        )
    } else {
        return None;
    };
    let message = format!(
        "{} is {distance} from the {which} singularity: the correction turns a joint by {by:.2} \
         deg",
        job.ground.name_of(approach.target as usize)
    );
    let hint = "the move may be fast there; check it slowly";
    Some(job.ground.at_target(
        "near-singularity",
        Severity::Warning,
        approach.target as usize,
        message,
        hint,
    ))
}

/// A pose that the controller may reach in another posture than the one it was compensated for.
pub(super) fn other_posture(job: &Job, approach: &Approach, outcome: &Outcome) -> Option<Finding> {
    let is_pose = job.ground.program.targets[approach.target as usize]
        .layout
        .shape
        == Shape::Pose;
    let equipped = job.ground.arm_with(approach.tool as usize);
    let arm = &equipped.inverse.arm;
    if !is_pose || arm.is_only_posture(&outcome.margins) {
        return None;
    }
    if arm.passes_axis_4() {
        let pose = (equipped.controller).forward(&outcome.q, &Conditions::default());
        let branch = arm.posture(&outcome.q).0;
        let answers = arm.solve_all(&pose, &outcome.q);
        if answers.iter().filter(|of| of.branch == branch).count() < 2 {
            return None;
        }
    }
    let q: Vec<String> = outcome
        .q
        .iter()
        .map(|q| format!("{:.1}", q / DEG))
        .collect();
    let message = format!(
        "this arm reaches {}, or a pose near it, in another posture on the same branch, too: joints {} \
         deg are meant",
        job.ground.name_of(approach.target as usize),
        q.join(", ")
    );
    Some(job.ground.at_target(
        "several-postures",
        Severity::Warning,
        approach.target as usize,
        message,
        "see that the controller stands so, or teach the joints",
    ))
}
