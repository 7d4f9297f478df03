//! New numbers in the place of the old ones, read back to tell what rounding costs.

use super::Job;
use super::approach::Approach;
use super::limit;
use super::outcome::{TargetReport, small};
use super::shared::{self, Fake};
use super::singular;
use crate::finding::{Acceptance, Finding, Severity};
use crate::geometry::Separation;
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::inverse::{Arm, Outcome, Status};
use crate::motion::walk::NOWHERE;
use crate::program::number::{self, Fraction, Style};
use crate::program::{Edits, Insertion, Number, Posture, Role, Shape, Target, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A shift below this is none: the target's text stays as it is.
const NO_SHIFT: Separation = Separation {
    distance_m: 1e-9,
    angle_rad: 1e-9,
};
/// More than this may not be left by rounding.
const ROUNDING_LIMIT: Separation = Separation {
    distance_m: 0.01 * MM,
    angle_rad: 0.01 * DEG,
};
/// Nearer to a singularity than this the joints move much for a small shift.
const NEAR_STRAIGHT_RAD: f64 = 1.0 * DEG;
const NEAR_AXIS_1_M: f64 = 5.0 * MM;

/// What became of some of the targets.
pub(super) struct Portion<'a> {
    /// Targets that points are derived from.
    bases: &'a BTreeSet<usize>,
    /// Target by index, and its report.
    pub reports: Vec<(usize, TargetReport)>,
    /// Changes to sources by index.
    pub edits: BTreeMap<u32, Edits>,
    pub findings: Vec<Finding>,
    /// Moves that are to get a target of their own.
    pub splits: Vec<Split>,
    /// Configuration data that change: index in the program's numbers, and the value.
    pub configurations: Vec<(u32, f64)>,
}

/// A move that is to get a target of its own, and what is said where its text cannot have one.
#[derive(Clone, Debug)]
pub(super) struct Split {
    pub insertion: Insertion,
    pub refusal: Finding,
}

/// How each source writes magnitudes below one.
pub(super) fn fractions(job: &Job) -> Vec<Fraction> {
    let mut fractions: Vec<Option<Fraction>> = vec![None; job.ground.sources.len()];
    for target in &job.ground.program.targets {
        let fraction = &mut fractions[target.file as usize];
        if fraction.is_none() {
            let numbers = job.ground.program.numbers_of(target);
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

impl<'a> Portion<'a> {
    /// Nothing yet.
    pub(super) fn new(bases: &'a BTreeSet<usize>) -> Self {
        Self {
            bases,
            reports: Vec::new(),
            edits: BTreeMap::new(),
            findings: Vec::new(),
            splits: Vec::new(),
            configurations: Vec::new(),
        }
    }

    /// Writes the new text of one target, where it converged from wherever the robot comes, and reports on it.
    pub(super) fn add(&mut self, job: &Job, group: &[(Approach, Outcome)], fractions: &[Fraction]) {
        let (approach, outcome) = &group[0];
        let mut report = TargetReport::new(Some((approach, outcome)));
        let strange = group
            .iter()
            .find_map(|(approach, outcome)| limit::not_finite(job, approach, outcome));
        if let Some(finding) = strange {
            report.status = None;
            self.findings.push(finding);
            self.reports.push((approach.target as usize, report));
            return;
        }
        let lost = group
            .iter()
            .find(|(_, outcome)| outcome.status != Status::Converged);
        if let Some((approach, outcome)) = lost {
            report = TargetReport::new(Some((approach, outcome)));
            self.findings.push(failure(job, approach, outcome));
        } else {
            match shared::common(job, group) {
                Ok(fake) => self.add_converged(job, group, &fake, fractions, &mut report),
                Err((finding, mean)) => {
                    let takes = |acceptance: &Acceptance| acceptance.takes(&finding);
                    if job.options.accepted.iter().any(takes) {
                        // the numbers that miss least on all ways
                        self.add_converged(job, group, &mean, fractions, &mut report);
                        self.findings
                            .retain(|other| other.id != "rounding" || other.line != finding.line);
                        self.findings.push(finding);
                    } else if !self.split(job, group, fractions, &finding, &mut report) {
                        report.status = None;
                        self.findings.push(finding);
                    }
                }
            }
        }
        self.reports.push((approach.target as usize, report));
    }

    /// Gives each of the moves a target of its own; false where one of them cannot be served alone.
    fn split(
        &mut self,
        job: &Job,
        group: &[(Approach, Outcome)],
        fractions: &[Fraction],
        refusal: &Finding,
        report: &mut TargetReport,
    ) -> bool {
        let target = group[0].0.target as usize;
        let moves = &job.ground.program.moves;
        let is_bare = |(approach, _): &(Approach, Outcome)| approach.motion != NOWHERE;
        if !job.options.split_targets || self.bases.contains(&target) || !group.iter().all(is_bare)
        {
            return false;
        }
        let mut each: BTreeMap<u32, Vec<(Approach, Outcome)>> = BTreeMap::new();
        for one in group {
            let instruction = moves[one.0.motion as usize].instruction;
            each.entry(instruction).or_default().push(*one);
        }
        let numbers = job
            .ground
            .program
            .numbers_of(&job.ground.program.targets[target]);
        let mut splits = Vec::with_capacity(each.len());
        for alone in each.values() {
            let Ok(fake) = shared::common(job, alone) else {
                return false;
            };
            let approach = &alone[0].0;
            let wanted = approach.wanted(job);
            let frame = *job.ground.world_from_frame(approach.frame as usize);
            let shift = wanted.separation(&(frame * fake.frame_from_tool));
            if let Some(finding) = job.limits.judge(job, approach, &shift) {
                self.findings.push(finding);
                return false;
            }
            report.shift = largest(report.shift, shift);
            let Some(written) = self.written(job, approach, &fake, fractions) else {
                return false;
            };
            let meant = Fake::meant(job, approach, &written.numbers);
            let landed = worst(
                alone
                    .iter()
                    .map(|(a, o)| shared::landing(job, a, o, &meant)),
            );
            if landed.distance_m > ROUNDING_LIMIT.distance_m
                || landed.angle_rad > ROUNDING_LIMIT.angle_rad
            {
                return false;
            }
            let given =
                *job.ground.world_from_frame(approach.frame as usize) * fake.frame_from_tool;
            report.shift = largest(report.shift, approach.wanted(job).separation(&given));
            let before = worst(alone.iter().map(|(approach, _)| uncorrected(job, approach)));
            report.before = largest(report.before, before);
            report.rounding = largest(report.rounding, landed);
            let target = &job.ground.program.targets[target];
            let mut texts: Vec<Vec<u8>> = numbers
                .iter()
                .map(|number| text(job, target, number).trim_ascii().to_vec())
                .collect();
            for (index, _, digits) in &written.texts {
                texts[*index] = written.digits[digits.clone()].trim_ascii().to_vec();
            }
            splits.push(Split {
                insertion: Insertion {
                    motion: approach.motion as usize,
                    between: Vec::new(),
                    own: Some(texts),
                },
                refusal: refusal.clone(),
            });
        }
        report.changed = true;
        self.splits.extend(splits);
        true
    }

    fn add_converged(
        &mut self,
        job: &Job,
        group: &[(Approach, Outcome)],
        fake: &Fake,
        fractions: &[Fraction],
        report: &mut TargetReport,
    ) {
        let (approach, outcome) = &group[0];
        let wanted = approach.wanted(job);
        let given = *job.ground.world_from_frame(approach.frame as usize) * fake.frame_from_tool;
        let shift = wanted.separation(&given);
        if !given.is_finite() || !limit::are_finite(&[shift.distance_m, shift.angle_rad]) {
            report.status = None;
            let finding = limit::not_finite_finding(job, approach, "the fake target");
            self.findings.push(finding);
            return;
        }
        if let Some(finding) = job.limits.judge(job, approach, &shift) {
            self.findings.push(finding);
            (report.status, report.shift) = (None, shift);
            return;
        }
        (report.fake, report.shift) = (Some(fake.frame_from_tool), shift);
        report.before = worst(group.iter().map(|(approach, _)| uncorrected(job, approach)));
        self.findings.extend(singularity(job, approach, outcome));
        self.findings.extend(other_posture(job, approach, outcome));
        let moved = job.ground.off_part(wanted).separation(&given);
        if moved.distance_m < NO_SHIFT.distance_m && moved.angle_rad < NO_SHIFT.angle_rad {
            return;
        }
        let Some(written) = self.written(job, approach, fake, fractions) else {
            (report.fake, report.shift) = (None, Separation::default());
            return;
        };
        let numbers = Fake::meant(job, approach, &written.numbers);
        let landed = group
            .iter()
            .map(|(approach, outcome)| shared::landing(job, approach, outcome, &numbers));
        report.rounding = worst(landed);
        let (left, before) = (report.rounding, report.before);
        let no_better = left.distance_m >= before.distance_m && left.angle_rad >= before.angle_rad;
        if no_better {
            report.rounding = before;
            report.fake = None;
        } else {
            report.changed = written.changed;
            self.configurations.extend(written.configurations);
            self.findings.extend(written.finding);
            let edits = self
                .edits
                .entry(job.ground.program.targets[approach.target as usize].file)
                .or_default();
            for (_, span, text) in &written.texts {
                edits.replace(span.clone(), |out| {
                    out.extend_from_slice(&written.digits[text.clone()]);
                });
            }
        }
        let left = report.rounding;
        // what the search itself could not reach is told by itself
        if left.distance_m > report.residual.distance_m + ROUNDING_LIMIT.distance_m
            || left.angle_rad > report.residual.angle_rad + ROUNDING_LIMIT.angle_rad
        {
            self.findings
                .push(rounding_finding(job, approach, left, shift));
        }
    }

    /// The text of the new numbers; `None` where the target has to stay.
    fn written(
        &mut self,
        job: &Job,
        approach: &Approach,
        fake: &Fake,
        fractions: &[Fraction],
    ) -> Option<Written> {
        let ground = &job.ground;
        let target = &ground.program.targets[approach.target as usize];
        let numbers = ground.program.numbers_of(target);
        let roles = ground.language.roles(target.layout);
        let arm = &ground.arm_with(approach.tool as usize).arm;
        let value = match target.layout.shape {
            Shape::Pose => Value::Pose(fake.frame_from_tool),
            Shape::Joints => Value::Joints(fake.q),
        };
        let old: Vec<f64> = numbers.iter().map(|n| n.value).collect();
        let mut new = old.clone();
        let (before, after) = (
            posture_of(arm, &approach.nominal_q),
            posture_of(arm, &fake.q),
        );
        ground.language.encode(
            target.layout,
            &value,
            &before,
            &after,
            ground.settings,
            &mut new,
        );
        if !limit::are_finite(&new) {
            let finding = limit::not_finite_finding(job, approach, "a number to be written");
            self.findings.push(finding);
            return None;
        }
        if let Some(joint) = kept_configuration(job, approach, &fake.q, &new) {
            self.findings.push(kept_finding(job, approach, joint));
            return None;
        }
        let styles = styles(job, target, numbers, roles, fractions[target.file as usize]);
        let mut written = Written {
            numbers: new,
            ..Written::default()
        };
        let new = &mut written.numbers;
        if (0..new.len()).any(|i| roles[i] == Role::Configuration && new[i] != old[i]) {
            written.finding = Some(configuration_finding(job, approach, roles, &old, new));
        }
        let mut digits = Vec::with_capacity(32);
        for (index, number) in numbers.iter().enumerate() {
            if new[index] == old[index] {
                continue;
            }
            let old_text = text(job, target, number);
            digits.clear();
            if roles[index] == Role::Configuration {
                ground.language.write_configuration(
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
                written.changed = true;
                let start = number.start as usize;
                let from = written.digits.len();
                written.digits.extend_from_slice(&digits);
                if roles[index] == Role::Configuration {
                    let number = target.numbers.start + small(index);
                    written.configurations.push((number, new[index]));
                }
                written.texts.push((
                    index,
                    start..start + usize::from(number.length),
                    from..written.digits.len(),
                ));
            }
        }
        Some(written)
    }
}

/// New numbers as they are to be written.
#[derive(Default)]
struct Written {
    numbers: Vec<f64>,
    changed: bool,
    digits: Vec<u8>,
    /// Index of the number, bytes of the file, and in `digits` what replaces them.
    texts: Vec<(usize, Range<usize>, Range<usize>)>,
    /// Index in the program's numbers, and the value.
    configurations: Vec<(u32, f64)>,
    finding: Option<Finding>,
}

/// The largest distance and the largest angle.
fn worst(all: impl Iterator<Item = Separation>) -> Separation {
    all.fold(Separation::default(), largest)
}

fn largest(a: Separation, b: Separation) -> Separation {
    Separation {
        distance_m: a.distance_m.max(b.distance_m),
        angle_rad: a.angle_rad.max(b.angle_rad),
    }
}

/// How far from the wanted pose the real tool lands with the target as it is.
fn uncorrected(job: &Job, approach: &Approach) -> Separation {
    let equipped = job.ground.arm_with(approach.tool as usize);
    let is_joints = job.ground.is_joints(approach.target as usize);
    let q = match &equipped.calibrated_controller {
        Some(_) if !is_joints => {
            let as_programmed = job.ground.off_part(approach.wanted(job));
            equipped
                .controller_joints(&as_programmed, approach.branch, &approach.nominal_q)
                .0
        }
        _ if job.ground.work_offset.is_some() => {
            let as_programmed = job.ground.off_part(approach.wanted(job));
            equipped
                .controller_joints(&as_programmed, approach.branch, &approach.nominal_q)
                .0
        }
        _ => approach.nominal_q,
    };
    let real = &equipped.inverse.real;
    real.forward(&q, &approach.conditions(job))
        .separation(&approach.wanted(job))
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
        let language = job.ground.language;
        let at_least = match job.options.decimals {
            Some(decimals) => language.decimals(role, decimals),
            None => language.least_decimals(role),
        };
        let texts = numbers
            .iter()
            .zip(roles)
            .filter(|(_, r)| **r == role)
            .map(|(n, _)| text(job, target, n));
        Style::of_group(texts, at_least, fraction)
    })
}

fn rounding_finding(
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
        "rounding to the file's decimals leaves {} {:.3} mm and {:.3} deg off its wanted pose; the limit is 0.010 mm and 0.010 deg (the shift is {:.3} mm, {:.3} deg)",
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

fn text<'a>(job: &'a Job, target: &Target, number: &Number) -> &'a [u8] {
    let start = number.start as usize;
    &job.ground.sources[target.file as usize].bytes[start..start + usize::from(number.length)]
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
fn kept_configuration(job: &Job, approach: &Approach, q: &[f64; 6], new: &[f64]) -> Option<usize> {
    let target = &job.ground.program.targets[approach.target as usize];
    let roles = job.ground.language.roles(target.layout);
    let writes_its_own = roles.contains(&Role::Configuration);
    if !approach.honoured || target.layout.shape != Shape::Pose || writes_its_own {
        return None;
    }
    let decoded = job
        .ground
        .language
        .decode(target.layout, new, job.ground.settings);
    let is_inside = |q: f64, (low, high): (f64, f64)| (low..=high).contains(&q);
    (0..6).find(|&i| {
        decoded.configuration.joints[i]
            .is_some_and(|range| is_inside(approach.nominal_q[i], range) && !is_inside(q[i], range))
    })
}

fn kept_finding(job: &Job, approach: &Approach, joint: usize) -> Finding {
    let message = format!(
        "the correction takes joint {} of {} across the border of its configuration data, which are those of other \
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

fn configuration_finding(
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

fn failure(job: &Job, approach: &Approach, outcome: &Outcome) -> Finding {
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
                approach.branch
            ),
        ),
        Status::NotConverged | Status::Converged => (
            "not-converged",
            format!("no joints found for {name}: {missing}; {near}"),
        ),
    };
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

fn singularity(job: &Job, approach: &Approach, outcome: &Outcome) -> Option<Finding> {
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
        "{} is {distance} from the {which} singularity: the correction turns a joint by {by:.2} deg",
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
fn other_posture(job: &Job, approach: &Approach, outcome: &Outcome) -> Option<Finding> {
    let is_pose = job.ground.program.targets[approach.target as usize]
        .layout
        .shape
        == Shape::Pose;
    let only = job
        .ground
        .arm_with(approach.tool as usize)
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
