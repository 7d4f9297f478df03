//! The report of `compensate`: what became of every target.

use super::Document;
use super::parts::{Names, Pose};
use crate::compensate::{Compensation, meaning};
use crate::finding::Finding;
use crate::geometry::units::{DEG, mm_from_m};
use crate::inverse::{Method, Status};
use crate::program::{Language, Source, Value};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

/// What the report says beside the compensation itself.
pub struct Header<'a> {
    /// Program files, as the user named them, in the order of the sources.
    pub inputs: Vec<String>,
    /// Where they were written; empty where nothing was.
    pub outputs: Vec<String>,
    /// The program files.
    pub sources: &'a [Source],
    /// The language.
    pub language: &'a dyn Language,
    /// Hash of the profile file.
    pub profile_sha256: &'a str,
}

/// What became of a target.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Target {
    /// Its name, where it has one.
    pub name: Option<String>,
    /// Its file.
    pub file: String,
    /// Its line, from 1.
    pub line: usize,
    /// The tool that goes there.
    pub tool: Option<String>,
    /// The frame that it is in.
    pub frame: Option<String>,
    /// The wanted pose, of a target that is one.
    pub wanted: Option<Pose>,
    /// The wanted joint angles, of a target that is given in joints.
    pub wanted_joints_deg: Option<[f64; 6]>,
    /// The fake target.
    pub fake: Option<Pose>,
    /// The controller's joint angles at the fake target.
    pub joints_deg: Option<[f64; 6]>,
    /// Distance of the fake target from the wanted pose.
    pub shift_mm: f64,
    /// Their angle.
    pub shift_deg: f64,
    /// Distance of the real tool from the wanted pose by the search.
    pub residual_mm: f64,
    /// Their angle.
    pub residual_deg: f64,
    /// Distance of the real tool from the wanted pose with the numbers as they are written.
    pub rounding_mm: f64,
    /// Their angle.
    pub rounding_deg: f64,
    /// Evaluations of the real model.
    pub iterations: u32,
    /// Which method found it: `pose-shift` or `newton`.
    pub method: Option<&'static str>,
    /// Evaluations by pose shift.
    pub shift_evaluations: u32,
    /// Evaluations by Newton's method.
    pub newton_evaluations: u32,
    /// The configuration.
    pub branch: Option<String>,
    /// How the search ended.
    pub status: Option<&'static str>,
    /// Whether its numbers are changed.
    pub changed: bool,
    /// Ids of the findings at its line.
    pub findings: Vec<&'static str>,
}

/// The targets, one after another: there may be a million.
pub struct Targets<'a> {
    header: &'a Header<'a>,
    compensation: &'a Compensation,
}

impl Targets<'_> {
    /// Each target in the order of the program.
    pub fn iter(&self) -> impl Iterator<Item = Target> {
        let mut findings: BTreeMap<(&str, usize), Vec<&'static str>> = BTreeMap::new();
        for finding in &self.compensation.findings {
            let place = (finding.file.as_str(), finding.line);
            findings.entry(place).or_default().push(finding.id);
        }
        let count = self.compensation.targets.len();
        (0..count).map(move |index| self.target(index, &findings))
    }

    fn target(
        &self,
        index: usize,
        findings: &BTreeMap<(&str, usize), Vec<&'static str>>,
    ) -> Target {
        let (header, compensation) = (self.header, self.compensation);
        let program = &compensation.program;
        let (t, text) = (&compensation.targets[index], &program.targets[index]);
        let file = text.file as usize;
        let (line, _) = header.sources[file].line_column(text.offset as usize);
        let name = &header.inputs[file];
        let decoded = meaning(header.language, program, &compensation.settings, index);
        let (wanted, wanted_joints_deg) = match decoded.map(|decoded| decoded.value) {
            Some(Value::Pose(pose)) => (Some((&pose).into()), None),
            Some(Value::Joints(q)) => (None, Some(q.map(|q| q / DEG))),
            None => (None, None),
        };
        Target {
            name: text.name.as_ref().map(ToString::to_string),
            file: name.clone(),
            line,
            tool: t
                .tool
                .map(|tool| program.tools[tool as usize].name.to_string()),
            frame: t
                .frame
                .map(|frame| program.frames[frame as usize].name.to_string()),
            wanted,
            wanted_joints_deg,
            fake: t.fake.as_ref().map(Into::into),
            joints_deg: t.q.map(|q| q.map(|q| q / DEG)),
            shift_mm: mm_from_m(t.shift.distance_m),
            shift_deg: t.shift.angle_rad / DEG,
            residual_mm: mm_from_m(t.residual.distance_m),
            residual_deg: t.residual.angle_rad / DEG,
            rounding_mm: mm_from_m(t.rounding.distance_m),
            rounding_deg: t.rounding.angle_rad / DEG,
            iterations: t.iterations,
            method: t.method.map(Method::id),
            shift_evaluations: t.shift_evaluations,
            newton_evaluations: t.newton_evaluations,
            branch: t.branch.map(|b| b.to_string()),
            status: t.status.map(Status::id),
            changed: t.changed,
            findings: findings
                .get(&(name.as_str(), line))
                .cloned()
                .unwrap_or_default(),
        }
    }
}

impl Serialize for Targets<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

/// The numbers of all targets together.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Summary {
    /// How many there are.
    pub targets: usize,
    /// How many are shifted.
    pub compensated: usize,
    /// How many stay as they are.
    pub unchanged: usize,
    /// How many are given in joints and stay.
    pub joint_targets: usize,
    /// Mean distance of the real tool from the wanted poses before.
    pub before_mm: f64,
    /// The largest.
    pub max_before_mm: f64,
    /// Mean distance of the real tool from the wanted poses with the numbers as they are written.
    pub after_mm: f64,
    /// Mean shift.
    pub mean_shift_mm: f64,
    /// Largest shift.
    pub max_shift_mm: f64,
    /// Largest residual of the search.
    pub max_residual_mm: f64,
    /// Largest distance of the real tool from the wanted poses with the numbers as they are written.
    pub max_rounding_mm: f64,
    /// Largest angle likewise.
    pub max_rounding_deg: f64,
}

/// What became of programs.
#[derive(Serialize, JsonSchema)]
pub struct Compensated<'a> {
    /// The programs.
    pub input: Names,
    /// Where they are written; `null` where they are not.
    pub output: Names,
    /// Their language.
    pub language: &'static str,
    /// SHA-256 of the profile.
    pub profile_sha256: &'a str,
    /// Every target.
    #[schemars(with = "Vec<Target>")]
    pub targets: Targets<'a>,
    /// All of them together.
    pub summary: Summary,
    /// What a person should look at.
    pub findings: &'a [Finding],
}

impl Document for Compensated<'_> {
    const KIND: &'static str = "compensation/1";
}

impl<'a> Compensated<'a> {
    /// The report of a compensation.
    #[must_use]
    pub fn new(header: &'a Header<'a>, compensation: &'a Compensation) -> Self {
        let s = &compensation.summary;
        Self {
            input: header.inputs.as_slice().into(),
            output: header.outputs.as_slice().into(),
            language: header.language.about().id,
            profile_sha256: header.profile_sha256,
            targets: Targets {
                header,
                compensation,
            },
            summary: Summary {
                targets: s.targets,
                compensated: s.compensated,
                unchanged: s.unchanged,
                joint_targets: s.joint_targets,
                before_mm: mm_from_m(s.mean_before_m),
                max_before_mm: mm_from_m(s.max_before_m),
                after_mm: mm_from_m(s.mean_after_m),
                mean_shift_mm: mm_from_m(s.mean_shift_m),
                max_shift_mm: mm_from_m(s.max_shift_m),
                max_residual_mm: mm_from_m(s.max_residual_m),
                max_rounding_mm: mm_from_m(s.max_rounding_m),
                max_rounding_deg: s.max_rounding_rad / DEG,
            },
            findings: &compensation.findings,
        }
    }
}
