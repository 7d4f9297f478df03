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

/// A shift below this is none: the target's text stays as it is.
const NO_SHIFT: Separation = Separation {
    distance_m: 1e-9,
    angle_rad: 1e-9,
};
/// Rounding that costs more than this, and more than a tenth of the shift, is worth a finding, metres.
const ROUNDING_LIMIT_M: f64 = 0.01 * MM;
/// Nearer to a singularity than this the joints move much for a small shift.
const NEAR_STRAIGHT_RAD: f64 = 1.0 * DEG;
const NEAR_AXIS_1_M: f64 = 5.0 * MM;

/// Writes targets into edits, one for each source.
pub(super) struct Writer<'a> {
    job: &'a Job<'a>,
    edits: Vec<Edits>,
    /// How each source writes magnitudes below one.
    fractions: Vec<Fraction>,
}

impl<'a> Writer<'a> {
    pub fn new(job: &'a Job<'a>) -> Self {
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
        let fractions = fractions
            .into_iter()
            .map(|f| f.unwrap_or(Fraction::Zero))
            .collect();
        Self {
            job,
            edits: job.sources.iter().map(|_| Edits::default()).collect(),
            fractions,
        }
    }

    pub fn into_edits(self) -> Vec<Edits> {
        self.edits
    }

    /// Writes one target, where it converged, and reports on it.
    pub fn target(
        &mut self,
        task: &Task,
        outcome: &Outcome,
        findings: &mut Vec<Finding>,
    ) -> TargetReport {
        let job = self.job;
        let equipped = job.equipped(task.tool);
        let mut report = TargetReport::new(job, task, outcome);
        let first = findings.len();
        if outcome.status != Status::Converged {
            findings.push(failure(job, task, outcome));
            report.findings = vec![findings[first].id];
            return report;
        }
        let controller_pose = equipped
            .controller
            .forward(&outcome.q, &Conditions::default());
        report.set_fake(task, &controller_pose);
        if let Some(finding) = singularity(job, task, outcome) {
            findings.push(finding);
        }
        let shift = task.wanted.separation(&controller_pose);
        if shift.distance_m >= NO_SHIFT.distance_m || shift.angle_rad >= NO_SHIFT.angle_rad {
            let written = self.write(task, outcome, &controller_pose, findings);
            report.rounding = self.landing(task, outcome, &written);
            report.changed = true;
            if report.rounding.distance_m > ROUNDING_LIMIT_M
                && report.rounding.distance_m > 0.1 * shift.distance_m
            {
                findings.push(self.rounding_finding(task, report.rounding, shift));
            }
        }
        report.findings = findings[first..].iter().map(|f| f.id).collect();
        report
    }

    /// Puts the new numbers into the edits; returns them as they were written.
    fn write(
        &mut self,
        task: &Task,
        outcome: &Outcome,
        controller_pose: &Pose,
        findings: &mut Vec<Finding>,
    ) -> Vec<f64> {
        let job = self.job;
        let target = &job.program.targets[task.target];
        let numbers = job.program.numbers_of(target);
        let roles = job.language.roles(target.shape);
        let arm = &job.equipped(task.tool).arm;
        let value = match target.shape {
            Shape::Pose => Value::Pose(task.world_from_frame.inverse() * *controller_pose),
            Shape::Joints => Value::Joints(outcome.q),
        };
        let old: Vec<f64> = numbers.iter().map(|n| n.value).collect();
        let mut new = old.clone();
        let (before, after) = (
            posture_of(arm, &task.nominal_q),
            posture_of(arm, &outcome.q),
        );
        job.language
            .encode(target.shape, &value, &before, &after, &mut new);
        let styles = self.styles(target, numbers, roles);
        let mut digits = Vec::with_capacity(32);
        for (index, number) in numbers.iter().enumerate() {
            if new[index] == old[index] {
                continue;
            }
            let role = roles[index];
            digits.clear();
            styles[role as usize].write(text(job, target, number), new[index], &mut digits);
            let read =
                number::parse(digits.trim_ascii_start()).expect("a written number is a number");
            if role == Role::Configuration {
                findings.push(configuration_finding(job, task, old[index], new[index]));
            }
            new[index] = read;
            if read != old[index] {
                let start = number.start as usize;
                let edits = &mut self.edits[target.file as usize];
                edits.replace(start..start + usize::from(number.length), |out| {
                    out.extend_from_slice(&digits)
                });
            } else {
                new[index] = old[index];
            }
        }
        new
    }

    /// The style of each role's numbers in one target.
    fn styles(&self, target: &Target, numbers: &[Number], roles: &[Role]) -> [Style; 4] {
        let job = self.job;
        [
            Role::Position,
            Role::Orientation,
            Role::Joint,
            Role::Configuration,
        ]
        .map(|role| {
            let at_least = match (role, job.options.decimals) {
                (Role::Configuration, _) | (_, None) => 0,
                (role, Some(decimals)) => job.language.decimals(role, decimals),
            };
            let texts = numbers
                .iter()
                .zip(roles)
                .filter(|(_, r)| **r == role)
                .map(|(n, _)| text(job, target, n));
            Style::of_group(texts, at_least, self.fractions[target.file as usize])
        })
    }

    /// How far from the wanted pose the real tool lands with the numbers as they were written.
    fn landing(&self, task: &Task, outcome: &Outcome, written: &[f64]) -> Separation {
        let job = self.job;
        let arm = &job.equipped(task.tool).arm;
        let target = &job.program.targets[task.target];
        let q = match job.language.decode(target.shape, written).value {
            Value::Joints(q) => q,
            Value::Pose(frame_from_tool) => {
                let given = task.world_from_frame * frame_from_tool;
                controller_joints(job, task, arm, &given, outcome)
            }
        };
        job.equipped(task.tool)
            .inverse
            .real
            .forward(&q, &job.conditions(task))
            .separation(&task.wanted)
    }

    fn rounding_finding(&self, task: &Task, rounding: Separation, shift: Separation) -> Finding {
        let message = format!(
            "rounding to the file's decimals leaves {} {:.3} mm beside its wanted pose (the shift is {:.3} mm)",
            name_of(self.job, task.target),
            mm_from_m(rounding.distance_m),
            mm_from_m(shift.distance_m)
        );
        self.job.at_target(
            "rounding",
            Severity::Warning,
            task.target,
            message,
            "--decimals 3 writes more",
        )
    }
}

/// The joints that the controller computes for a pose near the one found.
fn controller_joints(
    job: &Job,
    task: &Task,
    arm: &Arm,
    given: &Pose,
    outcome: &Outcome,
) -> [f64; 6] {
    match &job.equipped(task.tool).calibrated_controller {
        None => arm.solve_branch(given, task.branch, &outcome.q).q,
        Some(controller) => controller.solve(given, task.branch, &outcome.q).q,
    }
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

fn configuration_finding(job: &Job, task: &Task, old: f64, new: f64) -> Finding {
    let message = format!(
        "a joint of {} crosses into another range: configuration {old} becomes {new}",
        name_of(job, task.target)
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
