//! New numbers in the place of the old ones, read back to tell what rounding costs.

use super::Job;
use super::approach::{Approach, Solved};
use super::limit;
use super::outcome::{TargetReport, small};
use super::remarks;
use super::shared::{self, Fake};
use super::split::{self, Split};
use crate::finding::{Acceptance, Finding};
use crate::geometry::Separation;
use crate::geometry::units::{DEG, MM};
use crate::inverse::{Arm, Status};
use crate::program::number::{self, Fraction, Style};
use crate::program::{Edits, Number, Posture, Role, Shape, Target, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A shift below this is none: the target's text stays as it is.
const NO_SHIFT: Separation = Separation {
    distance_m: 1e-9,
    angle_rad: 1e-9,
};
/// More than this may not remain after rounding.
pub(super) const ROUNDING_LIMIT: Separation = Separation {
    distance_m: 0.01 * MM,
    angle_rad: 0.01 * DEG,
};

/// Bytes of a number that is written, mostly at most.
const LONG: usize = 16;

/// What became of some of the targets.
pub(super) struct Portion<'a> {
    /// Targets that points are derived from.
    pub bases: &'a BTreeSet<usize>,
    /// Target by index, and its report.
    pub reports: Vec<(usize, TargetReport)>,
    /// Changes to sources by index.
    pub edits: BTreeMap<u32, Edits>,
    pub findings: Vec<Finding>,
    /// Moves that are to get a target of their own.
    pub splits: Vec<Split>,
    /// Configuration data that change, and numbers that are put in: index in the program's
    /// numbers, and the value.
    pub meant: Vec<(u32, f64)>,
    /// The limit that allows every correction which shifts its target too far.
    pub needed: Separation,
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
    /// Nothing yet, with room for what becomes of so many targets.
    pub(super) fn new(bases: &'a BTreeSet<usize>, targets: usize) -> Self {
        Self {
            bases,
            reports: Vec::with_capacity(targets),
            edits: BTreeMap::new(),
            findings: Vec::new(),
            splits: Vec::new(),
            meant: Vec::new(),
            needed: Separation::default(),
        }
    }

    /// Writes the new text of one target, where it converged from wherever the robot comes, and
    /// reports on it.
    pub(super) fn add(&mut self, job: &Job, group: &[Solved], fractions: &[Fraction]) {
        let approach = group[0].approach;
        let mut report = TargetReport::new(Some(&group[0]));
        let strange = group
            .iter()
            .find_map(|solved| limit::not_finite(job, solved));
        if let Some(finding) = strange {
            report.status = None;
            self.findings.push(finding);
            self.reports.push((approach.target as usize, report));
            return;
        }
        let lost = group
            .iter()
            .find(|solved| solved.outcome.status != Status::Converged);
        if let Some(lost) = lost {
            report = TargetReport::new(Some(lost));
            let finding = remarks::failure(job, lost.approach, lost.outcome);
            self.findings.push(finding);
        } else {
            match shared::common(job, group) {
                Ok(fake) => self.add_converged(job, group, &fake, fractions, &mut report),
                Err((mut finding, mean)) => {
                    let obstacle = split::obstacle(job, self.bases, group);
                    let may_split = job.options.split_targets && obstacle.is_none();
                    if !may_split || !self.split(job, group, fractions, &finding, &mut report) {
                        if let Some(hint) = obstacle.filter(|_| job.options.split_targets) {
                            finding = finding.hint(hint);
                        }
                        self.refuse_shared(job, group, fractions, (finding, &mean), &mut report);
                    }
                }
            }
        }
        let is_reached = |solved: &Solved| solved.outcome.status == Status::Converged;
        if report.before.is_none() && group.iter().all(is_reached) {
            // it stays as it is
            report.before = Some(worst(group.iter().map(|solved| uncorrected(job, solved))));
            report.rounding = report.before;
        }
        self.reports.push((approach.target as usize, report));
    }

    /// No numbers serve all approaches, and none of them gets a target of its own: the numbers that miss
    /// least where that is accepted, else the target stays.
    fn refuse_shared(
        &mut self,
        job: &Job,
        group: &[Solved],
        fractions: &[Fraction],
        (finding, mean): (Finding, &Fake),
        report: &mut TargetReport,
    ) {
        let takes = |acceptance: &Acceptance| acceptance.takes(&finding);
        if job.options.accepted.iter().any(takes) {
            self.add_converged(job, group, mean, fractions, report);
            self.findings
                .retain(|other| other.id != "rounding" || other.line != finding.line);
        } else {
            report.status = None;
        }
        self.findings.push(finding);
    }

    fn add_converged(
        &mut self,
        job: &Job,
        group: &[Solved],
        fake: &Fake,
        fractions: &[Fraction],
        report: &mut TargetReport,
    ) {
        let Solved {
            approach, outcome, ..
        } = group[0];
        let given = job.ground.placed(approach.frame as usize).nominal
            * approach.taken(fake.frame_from_tool);
        let shift = group[0].meant(job).separation(&given);
        if !given.is_finite() || !limit::are_finite(&[shift.distance_m, shift.angle_rad]) {
            report.status = None;
            let finding = limit::not_finite_finding(job, approach, "the fake target");
            self.findings.push(finding);
            return;
        }
        if let Some((finding, needed)) = job.limits.judge(job, approach, &shift) {
            self.findings.push(finding);
            self.needed = largest(self.needed, needed);
            (report.status, report.shift) = (None, shift);
            return;
        }
        (report.fake, report.shift) = (Some(fake.frame_from_tool), shift);
        let before = worst(group.iter().map(|solved| uncorrected(job, solved)));
        (report.before, report.rounding) = (Some(before), Some(before));
        self.findings
            .extend(remarks::singularity(job, approach, outcome));
        self.findings
            .extend(remarks::other_posture(job, approach, outcome));
        let moved = if job.ground.part_moved {
            group[0].programmed(job).separation(&given)
        } else {
            shift
        };
        if moved.distance_m < NO_SHIFT.distance_m && moved.angle_rad < NO_SHIFT.angle_rad {
            return;
        }
        let Some(written) = self.written(job, approach, fake, fractions) else {
            (report.fake, report.shift) = (None, Separation::default());
            report.status = None;
            return;
        };
        let numbers = Fake::meant(job, approach, &written.numbers);
        let [landed, passed] = shared::landings(job, group, &numbers);
        self.findings.extend(shared::passed(job, approach, &passed));
        let no_better =
            landed.distance_m >= before.distance_m && landed.angle_rad >= before.angle_rad;
        let left = if no_better { before } else { landed };
        report.rounding = Some(left);
        if no_better {
            report.fake = None;
        } else {
            report.changed = written.changed;
            self.meant.extend(written.meant);
            self.findings.extend(written.findings);
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
        // what the search itself could not reach is reported on its own
        if left.distance_m > report.residual.distance_m + ROUNDING_LIMIT.distance_m
            || left.angle_rad > report.residual.angle_rad + ROUNDING_LIMIT.angle_rad
        {
            self.findings
                .push(remarks::rounding(job, approach, left, shift));
        }
    }

    /// The text of the new numbers; `None` where the target has to stay.
    pub(super) fn written(
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
        let mut new: Vec<f64> = numbers.iter().map(|n| n.value).collect();
        let programmed = as_programmed(job, approach);
        let posture = |q: &[f64; 6]| {
            // only configuration data hang on the sides
            if roles.contains(&Role::Configuration) {
                return posture_of(arm, q);
            }
            Posture {
                joints_rad: *q,
                behind_axis_1: false,
                behind_lower_arm: false,
            }
        };
        let (before, after) = (posture(&programmed), posture(&fake.q));
        ground.language.encode(
            target.layout,
            &value,
            &before,
            &after,
            ground.settings,
            &mut new,
        );
        if approach.is_turned() {
            // the configuration data are of the orientation that is written
            for (i, role) in roles.iter().enumerate() {
                if *role == Role::Configuration {
                    new[i] = numbers[i].value;
                }
            }
        }
        if !limit::are_finite(&new) {
            let finding = limit::not_finite_finding(job, approach, "a number to be written");
            self.findings.push(finding);
            return None;
        }
        if let Some(joint) = kept_configuration(job, approach, &programmed, &fake.q, &new) {
            self.findings
                .push(remarks::kept_configuration(job, approach, joint));
            return None;
        }
        let styles = styles(job, target, numbers, roles, fractions[target.file as usize]);
        let mut written = Written {
            digits: Vec::with_capacity(LONG * new.len()),
            texts: Vec::with_capacity(new.len()),
            numbers: new,
            ..Written::default()
        };
        let (new, digits) = (&mut written.numbers, &mut written.digits);
        let is_other = |new: &[f64], index: usize| new[index] != numbers[index].value;
        if (0..new.len()).any(|i| roles[i] == Role::Configuration && is_other(new, i)) {
            let old: Vec<f64> = numbers.iter().map(|n| n.value).collect();
            let finding = remarks::changed_configuration(job, approach, roles, &old, new);
            written.findings.push(finding);
        }
        let is_in_order = ground.language.has_missing_in_order();
        let is_written = |new: &[f64], index: usize| {
            let stands_before = is_in_order && numbers[index].length == 0;
            let end = if stands_before { new.len() } else { index + 1 };
            (index..end).any(|at| is_other(new, at))
        };
        let mut inserted = Vec::new();
        for (index, number) in numbers.iter().enumerate() {
            if !is_written(new, index) {
                continue;
            }
            let old_text = text(job, target, number);
            let from = digits.len();
            if roles[index] == Role::Configuration {
                ground.language.write_configuration(
                    target.layout,
                    index,
                    new[index],
                    old_text,
                    digits,
                );
            } else {
                styles[roles[index] as usize].write(old_text, new[index], digits);
                if clings(job, target, number) && digits[from].is_ascii_digit() {
                    digits.insert(from, b' ');
                }
                new[index] = number::parse(digits[from..].trim_ascii_start())
                    .expect("a written number is a number");
            }
            if !is_written(new, index) {
                digits.truncate(from);
                continue;
            }
            written.changed = true;
            let start = number.start as usize;
            let is_missing = number.length == 0;
            if is_missing {
                let (before, behind) = ground.language.around_missing(target.layout, index);
                digits.splice(from..from, before.bytes());
                digits.extend_from_slice(behind.as_bytes());
                inserted.extend_from_slice(&digits[from..]);
            }
            if is_missing || roles[index] == Role::Configuration {
                let number = target.numbers.start + small(index);
                written.meant.push((number, new[index]));
            }
            written.texts.push((
                index,
                start..start + usize::from(number.length),
                from..digits.len(),
            ));
        }
        if !inserted.is_empty() {
            let finding = remarks::inserted_numbers(job, approach, &inserted);
            written.findings.push(finding);
        }
        Some(written)
    }
}

/// New numbers as they are to be written.
#[derive(Default)]
pub(super) struct Written {
    pub numbers: Vec<f64>,
    changed: bool,
    pub digits: Vec<u8>,
    /// Index of the number, bytes of the file, and in `digits` what replaces them.
    pub texts: Vec<(usize, Range<usize>, Range<usize>)>,
    /// See [`Portion::meant`].
    meant: Vec<(u32, f64)>,
    findings: Vec<Finding>,
}

/// The largest distance and the largest angle.
pub(super) fn worst(all: impl Iterator<Item = Separation>) -> Separation {
    all.fold(Separation::default(), largest)
}

pub(super) fn largest(a: Separation, b: Separation) -> Separation {
    Separation {
        distance_m: a.distance_m.max(b.distance_m),
        angle_rad: a.angle_rad.max(b.angle_rad),
    }
}

/// The controller's joints where the program has the part.
fn as_programmed(job: &Job, approach: &Approach) -> [f64; 6] {
    let ground = &job.ground;
    if !ground.part_moved {
        return approach.nominal_q;
    }
    let programmed = ground.placed(approach.frame as usize).nominal * approach.in_frame(job);
    ground
        .arm_with(approach.tool as usize)
        .controller_joints(&programmed, approach.branch, &approach.nominal_q)
        .0
}

/// How far from the wanted pose the real tool lands with the target as it is.
pub(super) fn uncorrected(job: &Job, solved: &Solved) -> Separation {
    let approach = solved.approach;
    let equipped = job.ground.arm_with(approach.tool as usize);
    let is_joints = job.ground.is_joints(approach.target as usize);
    let q = match &equipped.calibrated_controller {
        Some(_) if !is_joints => {
            let as_programmed = solved.programmed(job);
            equipped
                .controller_joints(&as_programmed, approach.branch, &approach.nominal_q)
                .0
        }
        _ => as_programmed(job, approach),
    };
    let real = &equipped.inverse.real;
    real.forward(&q, &approach.conditions(job))
        .separation(&solved.wanted(job))
}

/// The style of each role's numbers in one target.
fn styles(
    job: &Job,
    target: &Target,
    numbers: &[Number],
    roles: &[Role],
    fraction: Fraction,
) -> [Style; 4] {
    let mut most = [None; 4];
    for (number, role) in numbers.iter().zip(roles) {
        let most = &mut most[*role as usize];
        *most = number::fixed_decimals(text(job, target, number)).max(*most);
    }
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
        Style::of_most(most[role as usize], at_least, fraction)
    })
}

pub(super) fn text<'a>(job: &'a Job, target: &Target, number: &Number) -> &'a [u8] {
    number.text(&job.ground.sources[target.file as usize].bytes)
}

/// Whether a number stands directly behind a name, from which its sign alone separates it
/// (`Y-20` of KRL): one without a sign would be a part of the name.
fn clings(job: &Job, target: &Target, number: &Number) -> bool {
    let before = &job.ground.sources[target.file as usize].bytes[..number.start as usize];
    let is_name = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    number.length > 0 && before.last().is_some_and(is_name)
}

pub(super) fn posture_of(arm: &Arm, q: &[f64; 6]) -> Posture {
    let (branch, _) = arm.posture(q);
    Posture {
        joints_rad: *q,
        behind_axis_1: branch.behind_axis_1,
        behind_lower_arm: branch.behind_lower_arm,
    }
}

/// A joint that the correction takes out of the range that the configuration data name, where these
/// stay as they are because the language cannot write them for one target alone.
fn kept_configuration(
    job: &Job,
    approach: &Approach,
    before: &[f64; 6],
    q: &[f64; 6],
    new: &[f64],
) -> Option<usize> {
    let target = &job.ground.program.targets[approach.target as usize];
    let roles = job.ground.language.roles(target.layout);
    let writes_its_own = roles.contains(&Role::Configuration);
    if approach.is_turned()
        || !approach.honoured
        || target.layout.shape != Shape::Pose
        || writes_its_own
    {
        return None;
    }
    let configuration = job.ground.language.configuration(target.layout, new);
    let is_inside = |i: usize, q: &[f64; 6]| configuration.has_joint(i, q[i], 0.0);
    (0..6).find(|&i| is_inside(i, before) && !is_inside(i, q))
}
