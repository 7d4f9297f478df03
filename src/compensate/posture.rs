//! Which of the inverse's solutions the program means: by its configuration data where the controller honours them, and by
//! the way it comes from the target before.

use super::outcome::meaning;
use super::placement::{Place, name_of};
use super::{Draft, Job, Task};
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::geometry::units::DEG;
use crate::inverse::{Ambiguous, Answer, Arm, Branch};
use crate::model::effects::Need;
use crate::program::{Configuration, Decoded, Displacement, Role, Value};

/// How far beyond its quadrant or turn a joint may stand: files round, and borders belong to both sides.
const BORDER_RAD: f64 = 0.05 * DEG;
/// How far beyond its limits a joint of the nominal arm may stand; the real one is judged exactly.
const LIMIT_RAD: f64 = 2.0 * DEG;
/// A joint that moves less than this keeps the direction in which it moved before.
const STANDSTILL_RAD: f64 = 1e-6;

/// Parts of an orientation beyond this, in degrees or radians, are no angles: 1e5 degrees are 278 turns.
const MOST_ANGLE: f64 = 1e5;
/// Name of the finding about a target that the nominal arm does not reach.
pub(super) const OUT_OF_REACH: &str = "out-of-reach";

/// A way to reach a target with the nominal arm.
#[derive(Clone, Copy)]
struct Way {
    branch: Branch,
    q: [f64; 6],
    /// It is all that the configuration data ask for.
    configured: bool,
    /// Its joints are in the ranges that the configuration data name.
    in_ranges: bool,
}

/// Where the path has been.
#[derive(Clone, Copy, Default)]
pub(super) struct Path {
    pub file: u32,
    pub joints: Option<[f64; 6]>,
    pub direction: [i8; 6],
}

impl Path {
    pub fn go(&mut self, q: [f64; 6]) {
        if let Some(before) = self.joints {
            for i in 0..6 {
                let by = q[i] - before[i];
                if by.abs() > STANDSTILL_RAD {
                    self.direction[i] = if by > 0.0 { 1 } else { -1 };
                }
            }
        }
        self.joints = Some(q);
    }
}

/// Drafts of the tasks of all targets that have a place and a branch, in the order of the targets.
pub(super) fn choose(
    job: &Job,
    places: &[Option<Place>],
    findings: &mut Vec<Finding>,
) -> Vec<Draft> {
    let directed = job
        .profile
        .effects
        .iter()
        .any(|e| !e.is_zero() && e.definition().needs.contains(&Need::Directions));
    let mut tasks: Vec<Draft> = Vec::with_capacity(places.iter().flatten().count());
    // where the task of each target is in the list, once its first move is seen
    let mut seen: Vec<Option<Option<usize>>> = vec![None; places.len()];
    let mut path = Path::default();
    for motion in &job.program.moves {
        if motion.file != path.file {
            path = Path {
                file: motion.file,
                ..Path::default()
            };
        }
        let target = motion.target;
        let index = seen[target].unwrap_or_else(|| {
            let start = motion.near.as_deref().copied().or(path.joints);
            let task = task(
                job,
                target,
                places[target],
                &Displacement::None,
                motion.configured && motion.near.is_none(),
                start,
                findings,
            )?;
            tasks.push(Draft::of(&task));
            Some(tasks.len() - 1)
        });
        seen[target] = Some(index);
        match index.map(|index| &mut tasks[index]) {
            Some(task) => {
                path.go(task.nominal_q);
                if directed && task.direction == [0; 6] {
                    task.direction = path.direction;
                }
            }
            None => match decoded(job, target).map(|decoded| decoded.value) {
                Some(Value::Joints(q)) => path.go(q),
                // where the robot is after a target that nobody understands is unknown
                _ => {
                    path = Path {
                        file: motion.file,
                        ..Path::default()
                    }
                }
            },
        }
    }
    for target in (0..places.len()).filter(|target| seen[*target].is_none()) {
        let none = &Displacement::None;
        let task = task(job, target, places[target], none, true, None, findings);
        tasks.extend(task.as_ref().map(Draft::of));
    }
    tasks.sort_unstable_by_key(|task| task.target);
    tasks
}

fn decoded(job: &Job, target: usize) -> Option<Decoded> {
    meaning(job.language, job.program, job.settings, target)
}

/// The task of one target, displaced as a move to it says; `None` where that is unknown. `honoured`: the controller uses its configuration data. `start`: the joints from which the robot
/// comes, or from which its inverse starts.
pub(super) fn task(
    job: &Job,
    target: usize,
    place: Option<Place>,
    displacement: &Displacement,
    honoured: bool,
    start: Option<[f64; 6]>,
    findings: &mut Vec<Finding>,
) -> Option<Task> {
    let Place { tool, frame } = place?;
    let equipped = job.equipped(tool);
    let Decoded {
        value,
        configuration,
    } = decoded(job, target)?;
    if let Some(angle) = endless_angle(job, target) {
        findings.push(job.at_target(
            "angle-too-large",
            Severity::Error,
            target,
            format!(
                "an angle of {angle:e} in {} is none that anybody means",
                name_of(job, target)
            ),
            "write its orientation with angles of a few turns at most",
        ));
        return None;
    }
    let value = match (value, displacement) {
        (Value::Joints(_), _) | (_, Displacement::None) => value,
        (Value::Pose(pose), Displacement::By(shift)) => Value::Pose(shift.apply(&pose)),
        (Value::Pose(_), Displacement::Unknown) => return None,
    };
    let wanted = job.wanted(&value, tool, frame);
    let (branch, nominal_q) = match value {
        Value::Joints(q) => (equipped.arm.posture(&q).0, q),
        Value::Pose(_) => {
            let asked = Asked {
                target,
                arm: &equipped.arm,
                wanted,
                configuration,
                honoured,
                start,
            };
            let way = choose_way(job, &asked, findings)?;
            (way.branch, way.q)
        }
    };
    Some(Task {
        target,
        tool,
        frame,
        wanted,
        branch,
        nominal_q,
        direction: [0; 6],
        honoured,
    })
}

/// A part of the target's orientation so large that its turn is lost in rounding.
fn endless_angle(job: &Job, target: usize) -> Option<f64> {
    let target = &job.program.targets[target];
    let roles = job.language.roles(target.layout);
    let numbers = job.program.numbers_of(target).iter().zip(roles);
    let mut angles = numbers.filter(|(_, role)| **role == Role::Orientation);
    angles.find_map(|(number, _)| Some(number.value).filter(|angle| angle.abs() > MOST_ANGLE))
}

/// A target whose branch is to be found.
struct Asked<'a> {
    target: usize,
    arm: &'a Arm,
    wanted: Pose,
    configuration: Configuration,
    honoured: bool,
    start: Option<[f64; 6]>,
}

fn choose_way(job: &Job, asked: &Asked, findings: &mut Vec<Finding>) -> Option<Way> {
    let Asked {
        target,
        arm,
        wanted,
        configuration,
        honoured,
        start,
    } = asked;
    if arm.has_offset_wrist() {
        match on_track(asked) {
            Ok(None) => {}
            Ok(way) => return way,
            Err(ambiguous) => {
                findings.push(unclear(job, *target, &ambiguous));
                return None;
            }
        }
    }
    // along a path the next posture is mostly on the branch of the last one; the others are tried where it does not fit
    if let Some(before) = start {
        let way = way(arm, wanted, arm.posture(before).0, before, configuration);
        if let Some(way) = way.filter(|way| way.configured && is_close(&way.q, before)) {
            return Some(way);
        }
    }
    let middle = arm
        .mechanism()
        .joints
        .map(|joint| 0.0_f64.clamp(joint.min_rad, joint.max_rad));
    let near = start.unwrap_or(middle);
    let ways: Vec<Way> = Branch::ALL
        .iter()
        .filter_map(|&branch| way(arm, wanted, branch, &near, configuration))
        .collect();
    let nearest = |accept: &dyn Fn(&Way) -> bool| {
        let distance = |way: &Way| {
            (0..6)
                .map(|i| (way.q[i] - near[i]).abs())
                .fold(0.0, f64::max)
        };
        let accepted = ways.iter().filter(|way| accept(way)).copied();
        accepted.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    if ways.is_empty() {
        return out_of_reach(job, asked, &near, findings);
    }
    if !honoured && start.is_some() {
        return nearest(&|_| true);
    }
    if let Some(way) = nearest(&|way| way.configured).or_else(|| nearest(&|way| way.in_ranges)) {
        return Some(way);
    }
    let name = name_of(job, *target);
    let shown = nearest(&|_| true)?
        .q
        .map(|q| format!("{:.1}", q / DEG))
        .join(", ");
    if start.is_some() {
        let message = format!(
            "no solution at {name} has the configuration that the file gives; the one nearest to the target before is taken \
             (joints {shown} deg)"
        );
        let hint =
            "check the configuration data, and that robot, tool and frame are those of the program";
        findings.push(job.at_target(
            "configuration-mismatch",
            Severity::Warning,
            *target,
            message,
            hint,
        ));
        return nearest(&|_| true);
    }
    let message = format!(
        "no solution at {name} has the configuration that the file gives, and no target before tells how the robot comes here \
         (nearest: joints {shown} deg)"
    );
    let hint =
        "check that robot, tool and frame are those of the program; start with a joint target";
    findings.push(job.at_target(
        "configuration-unknown",
        Severity::Error,
        *target,
        message,
        hint,
    ));
    None
}

/// The answer of an arm with an offset wrist that the configuration means, by its track from the posture before where several
/// have it. `None` where none has it.
fn on_track(asked: &Asked) -> Result<Option<Way>, Ambiguous> {
    let (arm, wanted) = (asked.arm, &asked.wanted);
    let middle = arm
        .mechanism()
        .joints
        .map(|joint| 0.0_f64.clamp(joint.min_rad, joint.max_rad));
    let before = asked.start.as_ref();
    // a robot that does not honour its configuration goes on as it came
    let free = !asked.honoured && before.is_some();
    let fits = |way: &Way| free || way.configured;
    if let Some(q) = before.and_then(|before| arm.follow(before, wanted).ok()) {
        let way = configured(arm, arm.posture(&q).0, q, &asked.configuration);
        if let Some(way) = way.filter(fits) {
            return Ok(Some(way));
        }
    }
    let near = asked.start.unwrap_or(middle);
    let way = |answer: &Answer| configured(arm, answer.branch, answer.q, &asked.configuration);
    let is_meant = |answer: &Answer| way(answer).as_ref().is_some_and(fits);
    let chosen = arm.choose(wanted, &near, before, is_meant)?;
    Ok(chosen.as_ref().and_then(way))
}

/// Several postures of one branch have the configuration that the file gives.
fn unclear(job: &Job, target: usize, ambiguous: &Ambiguous) -> Finding {
    let joints = |answer: &Answer| {
        let q = answer.q.map(|q| format!("{:.1}", q / DEG));
        format!("({})", q.join(", "))
    };
    let candidates: Vec<String> = ambiguous.candidates.iter().map(joints).collect();
    let message = format!(
        "{} postures at {} have the configuration that the file gives, and no straight path from a target before leads to one of \
         them (joints {} deg)",
        candidates.len(),
        name_of(job, target),
        candidates.join(" or ")
    );
    job.at_target(
        "configuration-ambiguous",
        Severity::Error,
        target,
        message,
        "put a joint target before it",
    )
}

/// Whether a posture follows the one before without a change of branch or a turn in between.
fn is_close(q: &[f64; 6], before: &[f64; 6]) -> bool {
    (0..6).all(|i| (q[i] - before[i]).abs() < 45.0 * DEG)
}

/// The solution on one branch with the turns that the configuration data and the limits ask for; `None` out of reach or
/// beyond a limit.
fn way(
    arm: &Arm,
    wanted: &Pose,
    branch: Branch,
    near: &[f64; 6],
    configuration: &Configuration,
) -> Option<Way> {
    let solution = arm.solve_branch(wanted, branch, near);
    if solution.beyond > 0.0 {
        return None;
    }
    configured(arm, branch, solution.q, configuration)
}

/// A solution with the turns that the configuration data and the limits ask for; `None` beyond a limit.
fn configured(
    arm: &Arm,
    branch: Branch,
    mut q: [f64; 6],
    configuration: &Configuration,
) -> Option<Way> {
    let mechanism = arm.mechanism();
    let mut in_ranges = true;
    for i in 0..6 {
        let limits = (
            mechanism.joints[i].min_rad - LIMIT_RAD,
            mechanism.joints[i].max_rad + LIMIT_RAD,
        );
        let asked =
            configuration.joints[i].map(|(low, high)| (low - BORDER_RAD, high + BORDER_RAD));
        let turned = |range: (f64, f64)| turned_into(q[i], range, limits);
        if let Some(angle) = asked.and_then(turned) {
            q[i] = angle;
        } else {
            in_ranges &= asked.is_none();
            q[i] = turned_into(q[i], (f64::NEG_INFINITY, f64::INFINITY), limits)?;
        }
    }
    let agrees = |flag: Option<bool>, is: bool| flag.is_none_or(|flag| flag == is);
    let configured = in_ranges
        && agrees(configuration.behind_axis_1, branch.behind_axis_1)
        && agrees(configuration.behind_lower_arm, branch.behind_lower_arm)
        && agrees(configuration.joint_5_negative, branch.joint_5_negative);
    Some(Way {
        branch,
        q,
        configured,
        in_ranges,
    })
}

/// The angle, by as few whole turns as can be, that lies in both ranges.
fn turned_into(angle: f64, range: (f64, f64), limits: (f64, f64)) -> Option<f64> {
    let (low, high) = (range.0.max(limits.0), range.1.min(limits.1));
    let turn = std::f64::consts::TAU;
    if (low..=high).contains(&angle) {
        return Some(angle);
    }
    let moved = if angle < low {
        angle + turn * ((low - angle) / turn).ceil()
    } else {
        angle - turn * ((angle - high) / turn).ceil()
    };
    (low..=high).contains(&moved).then_some(moved)
}

/// A pose that the nominal arm does not reach within its limits: the real one may, so the branch of the posture before or of
/// the stretched arm goes on; with neither it is an error.
fn out_of_reach(
    job: &Job,
    asked: &Asked,
    near: &[f64; 6],
    findings: &mut Vec<Finding>,
) -> Option<Way> {
    let Asked {
        target,
        arm,
        wanted,
        ..
    } = asked;
    let branch = arm.posture(near).0;
    let stretched = arm.solve_branch(wanted, branch, near);
    // squared cosine of the elbow beyond 1: a few millimetres at full stretch
    if stretched.beyond > 0.0 && stretched.beyond < 0.02 {
        return Some(Way {
            branch,
            q: stretched.q,
            configured: false,
            in_ranges: false,
        });
    }
    let message = if stretched.beyond > 0.0 {
        format!(
            "{} is out of the nominal robot's reach",
            name_of(job, *target)
        )
    } else {
        let q = stretched.q;
        let joint = arm.mechanism().beyond_limit(&q, LIMIT_RAD).unwrap_or(0);
        let limits = &arm.mechanism().joints[joint];
        format!(
            "{} is reachable on no branch within the joint limits (nearest: joint {} at {:.2} deg, limits {:.2} to {:.2})",
            name_of(job, *target),
            joint + 1,
            q[joint] / DEG,
            limits.min_rad / DEG,
            limits.max_rad / DEG
        )
    };
    let hint = "check that robot, tool and frame are those of the program";
    findings.push(job.at_target(OUT_OF_REACH, Severity::Error, *target, message, hint));
    None
}
