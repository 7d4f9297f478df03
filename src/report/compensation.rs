//! The report of `compensate`: `compensation/1`.

use super::{one_or_many, pose};
use crate::compensate::{Compensation, Summary, meaning};
use crate::geometry::units::{DEG, mm_from_m};
use crate::program::{Language, Source, Value as TargetValue};
use serde_json::{Value, json};
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

/// The JSON document.
#[must_use]
pub fn json(header: &Header, compensation: &Compensation) -> Value {
    let mut findings_of: BTreeMap<(&str, usize), Vec<&str>> = BTreeMap::new();
    for finding in &compensation.findings {
        let place = (finding.file.as_str(), finding.line);
        findings_of.entry(place).or_default().push(finding.id);
    }
    let targets: Vec<_> = (0..compensation.targets.len())
        .map(|index| target(header, compensation, index, &findings_of))
        .collect();
    let s = &compensation.summary;
    json!({
        "poseshift": "compensation/1",
        "input": one_or_many(&header.inputs),
        "output": one_or_many(&header.outputs),
        "language": header.language.about().id,
        "profile_sha256": header.profile_sha256,
        "targets": targets,
        "summary": {
            "targets": s.targets,
            "compensated": s.compensated,
            "unchanged": s.unchanged,
            "joint_targets": s.joint_targets,
            "mean_shift_mm": mm_from_m(s.mean_shift_m),
            "max_shift_mm": mm_from_m(s.max_shift_m),
            "max_residual_mm": mm_from_m(s.max_residual_m),
            "max_rounding_mm": mm_from_m(s.max_rounding_m),
            "max_rounding_deg": s.max_rounding_rad / DEG,
        },
        "findings": compensation.findings,
    })
}

fn target(
    header: &Header,
    compensation: &Compensation,
    index: usize,
    findings_of: &BTreeMap<(&str, usize), Vec<&str>>,
) -> Value {
    let program = &compensation.program;
    let (t, text) = (&compensation.targets[index], &program.targets[index]);
    let (file, line) = (
        text.file as usize,
        header.sources[text.file as usize]
            .line_column(text.offset as usize)
            .0,
    );
    let (mut wanted, mut wanted_joints) = (Value::Null, Value::Null);
    match meaning(header.language, program, &compensation.settings, index)
        .map(|decoded| decoded.value)
    {
        Some(TargetValue::Pose(p)) => wanted = pose(&p),
        Some(TargetValue::Joints(q)) => wanted_joints = json!(q.map(|q| q / DEG)),
        None => {}
    }
    json!({
        "name": text.name,
        "file": header.inputs[file],
        "line": line,
        "tool": t.tool.map(|tool| &program.tools[tool as usize].name),
        "frame": t.frame.map(|frame| &program.frames[frame as usize].name),
        "wanted": wanted,
        "wanted_joints_deg": wanted_joints,
        "fake": t.fake.as_ref().map(pose),
        "joints_deg": t.q.map(|q| q.map(|q| q / DEG)),
        "shift_mm": mm_from_m(t.shift.distance_m),
        "shift_deg": t.shift.angle_rad / DEG,
        "residual_mm": mm_from_m(t.residual.distance_m),
        "residual_deg": t.residual.angle_rad / DEG,
        "rounding_mm": mm_from_m(t.rounding.distance_m),
        "rounding_deg": t.rounding.angle_rad / DEG,
        "iterations": t.iterations,
        "branch": t.branch.map(|b| b.to_string()),
        "status": t.status.map(crate::inverse::Status::id),
        "changed": t.changed,
        "findings": findings_of.get(&(header.inputs[file].as_str(), line)).cloned().unwrap_or_default(),
    })
}

/// The text for people, without the findings.
#[must_use]
pub fn text(header: &Header, compensation: &Compensation) -> String {
    let Summary {
        targets,
        compensated,
        unchanged,
        joint_targets,
        mean_shift_m,
        max_shift_m,
        max_before_m,
        mean_before_m,
        mean_after_m,
        max_residual_m,
        max_rounding_m,
        max_rounding_rad,
    } = compensation.summary;
    let mut lines = vec![format!(
        "{} file(s) of {}, {targets} targets: {compensated} shifted, {unchanged} unchanged",
        header.inputs.len(),
        header.language.about().name
    )];
    if joint_targets > 0 {
        lines.push(format!(
            "  {joint_targets} joint targets stay as they are (--joint-targets correct shifts them)"
        ));
    }
    if compensated > 0 {
        lines.push(format!(
            "  real tool off by  mean {:.3} mm, largest {:.3} mm before; mean {:.4} mm, largest {:.4} mm after",
            mm_from_m(mean_before_m),
            mm_from_m(max_before_m),
            mm_from_m(mean_after_m),
            mm_from_m(max_rounding_m)
        ));
        lines.push(format!(
            "  shift     mean {:.3} mm, largest {:.3} mm",
            mm_from_m(mean_shift_m),
            mm_from_m(max_shift_m)
        ));
        lines.push(format!(
            "  residual  largest {:.1e} mm (what the search left)",
            mm_from_m(max_residual_m)
        ));
        lines.push(format!(
            "  rounding  largest {:.4} mm, {:.4} deg (what the file's decimals cost)",
            mm_from_m(max_rounding_m),
            max_rounding_rad / DEG
        ));
    }
    lines.join("\n") + "\n"
}
