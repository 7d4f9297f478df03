//! The report of `check`: `check/1`, its text, and `JUnit` XML.

use super::{junit, one_or_many};
use crate::check::baseline::{Comparison, text as baseline_text};
use crate::check::collision::Clearance;
use crate::check::{Check, MoveReport, Scene, Summary};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::program::{Language, Motion};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// What the report says beside the check itself.
pub struct Header<'a> {
    /// Program files, as the user named them.
    pub inputs: &'a [String],
    /// The original's files, where there are any.
    pub nominal: &'a [String],
    /// The language.
    pub language: &'a dyn Language,
    /// Hash of the profile file.
    pub profile_sha256: &'a str,
    /// The bodies.
    pub scene: &'a Scene,
}

fn kind(motion: Motion) -> &'static str {
    match motion {
        Motion::Joint => "joint",
        Motion::Linear => "linear",
        Motion::ArcVia => "arc-via",
        Motion::ArcEnd => "arc",
    }
}

/// Rounded to a millionth: what is below is arithmetic, and files stay comparable.
fn tidy(number: f64) -> Value {
    if number.is_finite() {
        json!((number * 1e6).round() / 1e6)
    } else {
        Value::Null
    }
}

fn clearance(header: &Header, found: &Clearance) -> Value {
    let Some((a, b)) = header.scene.pair_names(found) else {
        return json!({"at_least_mm": tidy(mm_from_m(found.clearance_m))});
    };
    json!({
        "a": a,
        "b": b,
        "required_mm": tidy(mm_from_m(found.required_m)),
        "sampled_mm": tidy(mm_from_m(found.sampled_m)),
        "at": tidy(found.at),
        "joints_deg": found.joints.map(|q| tidy(q / DEG)),
        "point_mm": found.points[1].map(|x| tidy(mm_from_m(x))),
        "certified": found.certified,
    })
}

fn entry(header: &Header, report: &MoveReport) -> Value {
    let path = report.path.as_ref();
    let limits = report.limits.as_ref();
    let [x, y, z, rx, ry, rz] = report.commanded.xyz_rxryrz();
    let position = [x, y, z].map(mm_from_m);
    let target = position.into_iter().chain([rx, ry, rz].map(|a| a / DEG));
    let target: Vec<Value> = target.map(tidy).collect();
    json!({
        "file": header.inputs[report.file],
        "line": report.line,
        "kind": kind(report.kind),
        "name": report.target,
        "target": target,
        "joint_target": report.in_joints,
        "joints_deg": report.joints.map(|q| tidy(q / DEG)),
        "cuts_corner": report.cuts_corner,
        "zone_mm": report.zone_m.map(mm_from_m).map(tidy),
        "target_error_mm": tidy(mm_from_m(report.target_error.distance_m)),
        "target_error_deg": tidy(report.target_error.angle_rad / DEG),
        "uncertainty_mm": report.uncertainty_m.map(|m| tidy(mm_from_m(m))),
        "max_path_error_mm": path.map(|p| tidy(mm_from_m(p.bound.distance_m))),
        "max_path_error_deg": path.map(|p| tidy(p.bound.angle_rad / DEG)),
        "sampled_path_error_mm": path.map(|p| tidy(mm_from_m(p.sampled.distance_m))),
        "path_error_at": path.map(|p| tidy(p.at)),
        "path_certified": path.map(|p| p.certified),
        "clearance_mm": report.clearance.map(|c| tidy(mm_from_m(c.clearance_m))),
        "clearance": report.clearance.as_ref().map(|c| clearance(header, c)),
        "nominal_clearance_mm": report.nominal_clearance.map(|c| tidy(mm_from_m(c.clearance_m))),
        "joint_margin_deg": limits.map(|l| tidy(l.margin_rad / DEG)),
        "joint_margin_joint": limits.map(|l| l.joint + 1),
        "wrist_deg": limits.map(|l| tidy(l.margins.wrist_rad / DEG)),
        "elbow_deg": limits.map(|l| tidy(l.margins.elbow_rad / DEG)),
        "shoulder_mm": limits.map(|l| tidy(mm_from_m(l.margins.shoulder_m))),
        "duration_s": limits.and_then(|l| l.duration_s).map(tidy),
        "max_joint_speed_deg_s": limits.and_then(|l| {
            let duration = l.duration_s?;
            Some(tidy(l.rate_rad.iter().fold(0.0, |a: f64, b| a.max(*b)) / duration / DEG))
        }),
    })
}

/// The JSON document.
#[must_use]
pub fn json(header: &Header, check: &Check, comparison: Option<&Comparison>) -> Value {
    let moves: Vec<_> = check
        .moves
        .iter()
        .map(|report| entry(header, report))
        .collect();
    let s = &check.summary;
    let mut document = json!({
        "poseshift": "check/1",
        "input": one_or_many(header.inputs),
        "nominal": one_or_many(header.nominal),
        "language": header.language.about().id,
        "profile_sha256": header.profile_sha256,
        "moves": moves,
        "summary": {
            "moves": s.moves,
            "unknown": s.unknown,
            "max_target_error_mm": tidy(mm_from_m(s.max_target_error.distance_m)),
            "max_target_error_deg": tidy(s.max_target_error.angle_rad / DEG),
            "max_path_error_mm": tidy(mm_from_m(s.max_path_error.distance_m)),
            "max_path_error_deg": tidy(s.max_path_error.angle_rad / DEG),
            "min_clearance_mm": s.min_clearance_m.map(|m| tidy(mm_from_m(m))),
            "collisions": s.collisions,
            "nominal_collisions": s.nominal_collisions,
            "too_near": s.too_near,
            "uncertified": s.uncertified,
            "with_zone": s.with_zone,
        },
        "findings": check.findings,
    });
    if let Some(comparison) = comparison {
        document["baseline"] = json!(comparison);
    }
    document
}

/// The text for people, without the findings.
#[must_use]
pub fn text(header: &Header, check: &Check, comparison: Option<&Comparison>) -> String {
    let Summary {
        moves,
        unknown,
        max_path_error,
        min_clearance_m,
        collisions,
        nominal_collisions,
        too_near,
        uncertified,
        with_zone,
        ..
    } = check.summary;
    let mut lines = vec![format!("{} file(s), {moves} moves", header.inputs.len())];
    if unknown > 0 {
        lines.push(format!("  {unknown} moves could not be followed"));
    }
    let told = |size_m: f64, report: &MoveReport| {
        let sigma = report.uncertainty_m.map(mm_from_m);
        let sigma = sigma.map_or(String::new(), |s| format!(" \u{b1} {s:.3}"));
        format!("{:.3}{sigma} mm (line {})", mm_from_m(size_m), report.line)
    };
    let at_target = |in_joints: bool| {
        let all = check.moves.iter().filter(|m| m.in_joints == in_joints);
        let size = |m: &MoveReport| m.target_error.distance_m;
        let worst = all.max_by(|a, b| size(a).total_cmp(&size(b)))?;
        Some(told(size(worst), worst))
    };
    if let Some(worst) = at_target(false) {
        lines.push(format!("  at targets     the real tool is up to {worst}"));
    }
    if let Some(worst) = at_target(true) {
        lines.push(format!(
            "  joint targets  up to {worst}; compensate leaves them as they are"
        ));
    }
    let bound = |m: &MoveReport| m.path.map_or(0.0, |path| path.bound.distance_m);
    let worst = check
        .moves
        .iter()
        .max_by(|a, b| bound(a).total_cmp(&bound(b)));
    if let Some(worst) = worst {
        lines.push(format!(
            "  along the way  never more than {}, {:.3} deg",
            told(bound(worst), worst),
            max_path_error.angle_rad / DEG
        ));
    }
    if let Some(least) = min_clearance_m {
        lines.push(format!(
            "  clearance      never less than {:.3} mm; {collisions} moves touch something, {too_near} come too near",
            mm_from_m(least)
        ));
        if nominal_collisions > 0 {
            lines.push(format!(
                "                 the nominal arm touches something on {nominal_collisions} moves"
            ));
        }
    }
    if uncertified > 0 {
        lines.push(format!(
            "  {uncertified} moves are known by samples only (near singularities)"
        ));
    }
    if with_zone > 0 {
        lines.push(format!(
            "  {with_zone} moves have a corner that the robot cuts; the path here goes through it"
        ));
    }
    let mut text = lines.join("\n") + "\n";
    if let Some(comparison) = comparison {
        text += &baseline_text(comparison);
    }
    text
}

/// `JUnit` XML: one suite a file, one case a move; error findings and what got worse are failures.
#[must_use]
pub fn junit(header: &Header, check: &Check, comparison: Option<&Comparison>) -> String {
    let mut failures: BTreeMap<(&str, usize), Vec<String>> = BTreeMap::new();
    let errors = check
        .findings
        .iter()
        .filter(|f| f.severity == Severity::Error);
    for Finding {
        id,
        file,
        line,
        message,
        ..
    } in errors
    {
        let list = failures.entry((file, *line)).or_default();
        list.push(format!("{id}: {message}"));
    }
    for difference in comparison.iter().flat_map(|c| &c.worse) {
        let line = usize::try_from(difference.line).unwrap_or(0);
        let message = format!(
            "worse: {} {} -> {}",
            difference.what, difference.before, difference.now
        );
        failures
            .entry((&difference.file, line))
            .or_default()
            .push(message);
    }
    let mut suites = Vec::new();
    for (index, input) in header.inputs.iter().enumerate() {
        let mut cases = Vec::new();
        for entry in check.moves.iter().filter(|entry| entry.file == index) {
            let found = failures.remove(&(input.as_str(), entry.line));
            let target = entry.target.as_deref().unwrap_or("target");
            let name = format!("line {}: {} to {target}", entry.line, kind(entry.kind));
            cases.push((name, found.unwrap_or_default()));
        }
        // what belongs to no move: the whole file, a declaration, a move that is gone
        let rest: Vec<_> = failures
            .keys()
            .filter(|key| key.0 == input)
            .copied()
            .collect();
        for key in rest {
            let found = failures.remove(&key);
            cases.push((format!("line {}", key.1), found.unwrap_or_default()));
        }
        suites.push(junit::Suite { name: input, cases });
    }
    junit::xml("poseshift check", &suites)
}
