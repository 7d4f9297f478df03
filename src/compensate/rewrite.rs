//! New numbers in the place of the old ones, read back to tell what rounding costs.

use super::outcome::TargetReport;
use super::placement::name_of;
use super::{Job, Task};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::geometry::{Pose, Separation};
use crate::inverse::{Arm, Outcome, Status};
use crate::model::Conditions;
use crate::program::number::{self, Fraction, Style};
use crate::program::{Edits, Number, Posture, Role, Shape, Target, Value};
use std::collections::BTreeMap;

/// A shift below this is none: the target's text stays as it is.
const NO_SHIFT: Separation = Separation {
    distance_m: 1e-9,
    angle_rad: 1e-9,
};
/// Rounding that costs more than this, and more than a tenth of the shift, is worth a finding.
const ROUNDING_LIMIT: Separation = Separation {
    distance_m: 0.01 * MM,
    angle_rad: 0.02 * DEG,
};
/// Nearer to a singularity than this the joints move much for a small shift.
const NEAR_STRAIGHT_RAD: f64 = 1.0 * DEG;
const NEAR_AXIS_1_M: f64 = 5.0 * MM;

/// What became of some of the targets.
#[derive(Default)]
pub(super) struct Portion {
    /// Target by index, and its report.
    pub reports: Vec<(usize, TargetReport)>,
    /// Changes to sources by index.
    pub edits: BTreeMap<u32, Edits>,
    pub findings: Vec<Finding>,
}

/// How each source writes magnitudes below one.
pub(super) fn fractions(job: &Job) -> Vec<Fraction> {
    let mut fractions: Vec<Option<Fraction>> = vec![None; job.sources.len()];
    for target in &job.program.targets {
        let fraction = &mut fractions[target.file as usize];
        if fraction.is_none() {
            let numbers = job.program.numbers_of(target);
            *fraction = numbers
                .iter()
                .find_map(|n| Fraction::shown_by(text(job, target, n)));
        }
    }
    fractions
        .into_iter()
        .map(|f| f.unwrap_or(Fraction::Zero))
        .collect()
}

impl Portion {
    /// Writes the new text of one target, where it converged, and reports on it.
    pub fn add(&mut self, job: &Job, task: &Task, outcome: &Outcome, fractions: &[Fraction]) {
        let mut report = TargetReport::new(Some((task, outcome)));
        if outcome.status == Status::Converged {
            self.add_converged(job, task, outcome, fractions, &mut report);
        } else {
            self.findings.push(failure(job, task, outcome));
        }
        self.reports.push((task.target, report));
    }

    fn add_converged(
        &mut self,
        job: &Job,
        task: &Task,
        outcome: &Outcome,
        fractions: &[Fraction],
        report: &mut TargetReport,
    ) {
        let controller_pose = job
            .equipped(task.tool)
            .controller
            .forward(&outcome.q, &Conditions::default());
        let fake = job.world_from_frame(task.frame).inverse() * controller_pose;
        let shift = task.wanted.separation(&controller_pose);
        (report.fake, report.shift) = (Some(fake), shift);
        self.findings.extend(singularity(job, task, outcome));
        self.findings.extend(other_posture(job, task, outcome));
        if shift.distance_m < NO_SHIFT.distance_m && shift.angle_rad < NO_SHIFT.angle_rad {
            return;
        }
        let Some((written, changed)) = self.write(job, task, outcome, &fake, fractions) else {
            (report.fake, report.shift) = (None, Separation::default());
            return;
        };
        report.changed = changed;
        report.rounding = landing(job, task, outcome, &written);
        let left = report.rounding;
        let beside =
            left.distance_m > ROUNDING_LIMIT.distance_m && left.distance_m > 0.1 * shift.distance_m;
        let turned =
            left.angle_rad > ROUNDING_LIMIT.angle_rad && left.angle_rad > 0.1 * shift.angle_rad;
        if beside || turned {
            self.findings.push(rounding_finding(job, task, left, shift));
        }
    }

    /// Puts the new numbers' text into the edits; returns the numbers as they are written and whether any changed,
    /// or nothing where the target has to stay.
    fn write(
        &mut self,
        job: &Job,
        task: &Task,
        outcome: &Outcome,
        fake: &Pose,
        fractions: &[Fraction],
    ) -> Option<(Vec<f64>, bool)> {
        let target = &job.program.targets[task.target];
        let numbers = job.program.numbers_of(target);
        let roles = job.language.roles(target.layout);
        let arm = &job.equipped(task.tool).arm;
        let value = match target.layout.shape {
            Shape::Pose => Value::Pose(*fake),
            Shape::Joints => Value::Joints(outcome.q),
        };
        let old: Vec<f64> = numbers.iter().map(|n| n.value).collect();
        let mut new = old.clone();
        let (before, after) = (
            posture_of(arm, &task.nominal_q),
            posture_of(arm, &outcome.q),
        );
        job.language.encode(
            target.layout,
            &value,
            &before,
            &after,
            job.settings,
            &mut new,
        );
        if let Some(joint) = kept_configuration(job, task, outcome, &new) {
            self.findings.push(kept_finding(job, task, joint));
            return None;
        }
        let styles = styles(job, target, numbers, roles, fractions[target.file as usize]);
        if (0..new.len()).any(|i| roles[i] == Role::Configuration && new[i] != old[i]) {
            self.findings
                .push(configuration_finding(job, task, roles, &old, &new));
        }
        let edits = self.edits.entry(target.file).or_default();
        let mut digits = Vec::with_capacity(32);
        let mut changed = false;
        for (index, number) in numbers.iter().enumerate() {
            if new[index] == old[index] {
                continue;
            }
            let old_text = text(job, target, number);
            digits.clear();
            if roles[index] == Role::Configuration {
                job.language.write_configuration(
                    target.layout,
                    index,
                    new[index],
                    old_text,
                    &mut digits,
                );
            } else {
                styles[roles[index] as usize].write(old_text, new[index], &mut digits);
                new[index] =
                    number::parse(digits.trim_ascii_start()).expect("a written number is a number");
            }
            if new[index] != old[index] {
                changed = true;
                let start = number.start as usize;
                edits.replace(start..start + usize::from(number.length), |out| {
                    out.extend_from_slice(&digits);
                });
            }
        }
        Some((new, changed))
    }
}

/// The style of each role's numbers in one target.
fn styles(
    job: &Job,
    target: &Target,
    numbers: &[Number],
    roles: &[Role],
    fraction: Fraction,
) -> [Style; 4] {
    [
        Role::Position,
        Role::Orientation,
        Role::Joint,
        Role::Configuration,
    ]
    .map(|role| {
        let at_least = job
            .options
            .decimals
            .map_or(0, |decimals| job.language.decimals(role, decimals));
        let texts = numbers
            .iter()
            .zip(roles)
            .filter(|(_, r)| **r == role)
            .map(|(n, _)| text(job, target, n));
        Style::of_group(texts, at_least, fraction)
    })
}

/// How far from the wanted pose the real tool lands with the numbers as they are written.
fn landing(job: &Job, task: &Task, outcome: &Outcome, written: &[f64]) -> Separation {
    let target = &job.program.targets[task.target];
    let q = match job
        .language
        .decode(target.layout, written, job.settings)
        .value
    {
        Value::Joints(q) => q,
        Value::Pose(frame_from_tool) => {
            let given = *job.world_from_frame(task.frame) * frame_from_tool;
            let equipped = job.equipped(task.tool);
            let (q, _) = equipped.controller_joints(&given, task.branch, &outcome.q);
            q
        }
    };
    job.equipped(task.tool)
        .inverse
        .real
        .forward(&q, &job.conditions(task))
        .separation(&task.wanted)
}

fn rounding_finding(job: &Job, task: &Task, rounding: Separation, shift: Separation) -> Finding {
    let message = format!(
        "rounding to the file's decimals leaves {} {:.3} mm and {:.3} deg beside its wanted pose (the shift is {:.3} mm, {:.3} deg)",
        name_of(job, task.target),
        mm_from_m(rounding.distance_m),
        rounding.angle_rad / DEG,
        mm_from_m(shift.distance_m),
        shift.angle_rad / DEG
    );
    job.at_target(
        "rounding",
        Severity::Warning,
        task.target,
        message,
        "--decimals 3 writes more",
    )
}

fn text<'a>(job: &'a Job, target: &Target, number: &Number) -> &'a [u8] {
    let start = number.start as usize;
    &job.sources[target.file as usize].bytes[start..start + usize::from(number.length)]
}

pub(super) fn posture_of(arm: &Arm, q: &[f64; 6]) -> Posture {
    let (branch, _) = arm.posture(q);
    Posture {
        joints_rad: *q,
        behind_axis_1: branch.behind_axis_1,
        behind_lower_arm: branch.behind_lower_arm,
    }
}

/// A joint that the correction takes out of the range that the configuration data name, where these stay as they are
/// because the language cannot write them for one target alone.
fn kept_configuration(job: &Job, task: &Task, outcome: &Outcome, new: &[f64]) -> Option<usize> {
    let target = &job.program.targets[task.target];
    let roles = job.language.roles(target.layout);
    let writes_its_own = roles.contains(&Role::Configuration);
    if !task.honoured || target.layout.shape != Shape::Pose || writes_its_own {
        return None;
    }
    let decoded = job.language.decode(target.layout, new, job.settings);
    let is_inside = |q: f64, (low, high): (f64, f64)| (low..=high).contains(&q);
    (0..6).find(|&i| {
        decoded.configuration.joints[i].is_some_and(|range| {
            is_inside(task.nominal_q[i], range) && !is_inside(outcome.q[i], range)
        })
    })
}

fn kept_finding(job: &Job, task: &Task, joint: usize) -> Finding {
    let message = format!(
        "the correction takes joint {} of {} across the border of its configuration data, which are those of other \
         targets too and stay: a joint move would come out a turn away",
        joint + 1,
        name_of(job, task.target)
    );
    job.at_target(
        "configuration-kept",
        Severity::Error,
        task.target,
        message,
        "go there on a straight line, or move the target away from the border",
    )
}

fn configuration_finding(
    job: &Job,
    task: &Task,
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
        name_of(job, task.target),
        shown(old),
        shown(new)
    );
    job.at_target(
        "configuration-changed",
        Severity::Warning,
        task.target,
        message,
        "check the move on the robot slowly",
    )
}

fn failure(job: &Job, task: &Task, outcome: &Outcome) -> Finding {
    let name = name_of(job, task.target);
    let mechanism = job.equipped(task.tool).arm.mechanism();
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
    let (id, message) = match outcome.status {
        Status::OutOfReach => (
            "out-of-reach",
            format!("the real robot does not reach {name}: {missing}; {near}"),
        ),
        Status::JointLimit(joint) => {
            let limits = &mechanism.joints[joint];
            let at = outcome.q[joint] / DEG;
            let message = format!(
                "to reach {name} joint {} must go to {at:.3} deg; its limits are {:.3} to {:.3} deg",
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
                task.branch
            ),
        ),
        Status::NotConverged | Status::Converged => (
            "not-converged",
            format!("no joints found for {name}: {missing}; {near}"),
        ),
    };
    let hint = "move the target, or --keep-going to leave it as it is";
    job.at_target(id, Severity::Error, task.target, message, hint)
}

fn singularity(job: &Job, task: &Task, outcome: &Outcome) -> Option<Finding> {
    let margins = &outcome.margins;
    let by = (0..6)
        .map(|i| (outcome.q[i] - task.nominal_q[i]).abs())
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
        "{} is {distance} from the {which} singularity: the correction turns a joint by {by:.2} deg",
        name_of(job, task.target)
    );
    let hint = "the move may be fast there; check it slowly";
    Some(job.at_target(
        "near-singularity",
        Severity::Warning,
        task.target,
        message,
        hint,
    ))
}

/// A pose that the controller may reach in another posture than the one it was compensated for.
fn other_posture(job: &Job, task: &Task, outcome: &Outcome) -> Option<Finding> {
    let is_pose = job.program.targets[task.target].layout.shape == Shape::Pose;
    let only = job
        .equipped(task.tool)
        .inverse
        .arm
        .is_only_posture(&outcome.margins);
    if !is_pose || only {
        return None;
    }
    let q: Vec<String> = outcome
        .q
        .iter()
        .map(|q| format!("{:.1}", q / DEG))
        .collect();
    let message = format!(
        "{} is near a singularity, where this arm can have another posture on the same branch: joints {} deg are meant",
        name_of(job, task.target),
        q.join(", ")
    );
    Some(job.at_target(
        "several-postures",
        Severity::Warning,
        task.target,
        message,
        "see that the controller stands so, or teach the joints",
    ))
}
