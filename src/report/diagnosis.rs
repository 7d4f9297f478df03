//! What a diagnosis found: JSON for programs, sentences for people.

use super::identification::{findings, spread, with_file};
use crate::diagnose::stand_ins::{Impossible, StandIn};
use crate::diagnose::{Diagnosis, Found, NoiseSource, Rival, Verdict};
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::JOINTS;
use crate::model::effects::{BASE, Effect, Kind};
use serde_json::{Map, Value, json};

fn finite(value: f64) -> Value {
    if value.is_finite() {
        json!(value)
    } else {
        Value::Null
    }
}

/// An effect's name and place as keys, and its parameters in the units of files.
fn entry(effect: &Effect) -> (Map<String, Value>, Map<String, Value>) {
    let definition = effect.definition();
    let (mut head, mut parameters) = (Map::new(), Map::new());
    for (key, value) in effect.to_entry() {
        if definition.parameters.iter().any(|p| p.key == key) {
            parameters.insert(key.into(), value);
        } else {
            head.insert(key.into(), value);
        }
    }
    (head, parameters)
}

fn found(f: &Found) -> Value {
    let (mut map, parameters) = entry(&f.effect);
    let definition = f.effect.definition();
    let sigmas: Map<String, Value> = f
        .sought
        .iter()
        .zip(&f.sigmas)
        .map(|(n, s)| {
            (
                definition.parameters[*n].key.to_owned(),
                finite(s / definition.parameters[*n].unit.in_si()),
            )
        })
        .collect();
    map.insert("parameters".into(), Value::Object(parameters));
    map.insert("sigma".into(), Value::Object(sigmas));
    let (again, of) = f.found_again;
    let evidence = json!({
        "chi_squared_fall": finite(f.gain), "p_value": finite(f.p_value), "bic_fall": finite(f.bic),
        "found_again": again, "found_again_of": of, "accepted_by_hand": f.accepted,
    });
    map.insert("evidence".into(), evidence);
    map.insert("before".into(), spread(f.before, "mm"));
    map.insert("after".into(), spread(f.after, "mm"));
    map.insert("of_data".into(), json!(definition.of_data()));
    map.insert("sentence".into(), json!(sentence(&f.effect)));
    Value::Object(map)
}

fn rival(r: &Rival, found: &[Found]) -> Value {
    let (mut map, parameters) = entry(&r.effect);
    map.insert("parameters".into(), Value::Object(parameters));
    map.insert(
        "instead_of".into(),
        json!(found[r.instead_of].effect.label()),
    );
    map.insert("chi_squared_fall".into(), finite(r.gain));
    map.insert("behind".into(), finite(r.behind));
    Value::Object(map)
}

fn whole(e: &Effect) -> Value {
    let (mut map, parameters) = entry(e);
    map.insert("parameters".into(), Value::Object(parameters));
    Value::Object(map)
}

fn stand_in(s: &StandIn, found: &[Found]) -> Value {
    let labels = s.instead_of.iter().map(|i| found[*i].effect.label());
    json!({
        "effects": s.effects.iter().map(whole).collect::<Vec<_>>(),
        "instead_of": labels.collect::<Vec<_>>(),
        "chi_squared_fall": finite(s.gain), "part": finite(s.part), "behind": finite(s.behind),
        "left_mm": finite(mm_from_m(s.left_m)),
    })
}

fn impossible(i: &Impossible, found: &[Found]) -> Value {
    let labels = i.instead_of.iter().map(|i| found[*i].effect.label());
    json!({
        "effects": i.effects.iter().map(whole).collect::<Vec<_>>(),
        "instead_of": labels.collect::<Vec<_>>(), "part": finite(i.part),
    })
}

/// The report `diagnosis/1`.
#[must_use]
pub fn diagnosis(d: &Diagnosis, file: &str) -> Value {
    let (before, after) = d.held_out.map_or((None, None), |(b, a)| (Some(b), Some(a)));
    json!({
        "poseshift": "diagnosis/1",
        "verdict": d.verdict.id(),
        "reasons": d.reasons,
        "effects": d.found.iter().map(found).collect::<Vec<_>>(),
        "where": d.spots.iter().map(|s| json!({
            "column": s.column, "values": s.values, "size_mm": mm_from_m(s.size_m), "largest_mm": mm_from_m(s.largest_m),
            "part": finite(s.part), "p_value": finite(s.p_value),
        })).collect::<Vec<_>>(),
        "alternatives": d.rivals.iter().map(|r| rival(r, &d.found)).collect::<Vec<_>>(),
        "impossible": d.impossible.iter().map(|i| impossible(i, &d.found)).collect::<Vec<_>>(),
        "alternative_groups": d.stand_ins.iter().map(|s| stand_in(s, &d.found)).collect::<Vec<_>>(),
        "unregistered": d.unknown.iter().map(|u| json!({"function": u.name, "chi_squared_fall": finite(u.gain)})).collect::<Vec<_>>(),
        "telling_poses": d.telling.iter().map(|t| json!({
            "joints_deg": t.q.map(|q| q / DEG), "apart_mm": mm_from_m(t.apart_m), "tells": [t.tells.0, t.tells.1],
        })).collect::<Vec<_>>(),
        "cannot_test": d.cannot_test.iter().map(|c| json!({"effect": c.kind.definition().id, "missing": c.missing})).collect::<Vec<_>>(),
        "absorbed": absorbed(d),
        "held_out": {"before": spread(before, "mm"), "absorbed": spread(d.absorbed_only, "mm"), "after": spread(after, "mm")},
        "noise_mm": finite(mm_from_m(d.noise_m)),
        "noise_source": match d.noise_source {
            NoiseSource::Given => "sigma_mm",
            NoiseSource::Repeats => "repeats",
            NoiseSource::Left => "residuals",
        },
        "left_mm": finite(mm_from_m(d.left_m)),
        "outliers": d.outliers.iter().map(|o| with_file(json!({
            "line": o.line.number, "id": o.id, "residual_mm": mm_from_m(o.length_m), "times_noise": finite(o.times),
        }), &o.line)).collect::<Vec<_>>(),
        "leverage": d.followed.iter().map(|f| with_file(json!({
            "line": f.line.number, "id": f.id, "leverage": finite(f.leverage),
        }), &f.line)).collect::<Vec<_>>(),
        "findings": findings(&d.remarks, file),
    })
}

/// What was fitted along the way and is no finding.
fn absorbed(d: &Diagnosis) -> Vec<&'static str> {
    let mut all = Vec::new();
    if d.elsewhere || d.absorbed {
        all.push("base_frame");
    }
    if d.absorbed {
        all.extend(["tool_frame", "link_geometry"]);
        if d.problem
            .parameters
            .iter()
            .any(|p| p.key.starts_with("joint_compliance"))
        {
            all.push("joint_compliance");
        }
    }
    all
}

fn digits(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (0.01..1000.0).contains(&size) {
        format!("{value:.3}")
    } else {
        format!("{value:.1e}")
    }
}

/// An effect in one sentence a person understands.
#[must_use]
pub fn sentence(effect: &Effect) -> String {
    let (p, site) = (&effect.parameters, &effect.site);
    let joint = format!("J{}", site.index + 1);
    let deg = |value: f64| digits(value / DEG);
    let mm = |value: f64| digits(mm_from_m(value));
    let length = |x: &[f64]| x.iter().map(|v| v * v).sum::<f64>().sqrt();
    let text = match effect.kind {
        Kind::BaseFrame => format!(
            "The base stands {} mm from where the profile has it and is turned by {}°",
            mm(length(&p[..3])),
            deg(length(&p[3..]))
        ),
        Kind::ToolFrame => format!(
            "The tool's tip is {} mm from where the profile has it",
            mm(length(&p[..3]))
        ),
        Kind::LinkGeometry => format!("Link {} differs from the profile", site.index + 1),
        Kind::JointScale => format!("{joint} turns {}° too far in 90°", deg(p[0] * 90.0 * DEG)),
        Kind::JointCompliance => {
            format!("{joint} gives way by {}° under 100 N m", deg(100.0 * p[0]))
        }
        Kind::JointHarmonic => format!(
            "{joint} runs fast and slow by {}°, {} times a turn (eccentric gear or encoder)",
            deg(length(&p[..2])),
            site.order
        ),
        Kind::JointCoupling => format!(
            "{joint} is taken along by J{}: {}° in 90°",
            site.on + 1,
            deg(p[0] * 90.0 * DEG)
        ),
        Kind::Backlash if p[0] < 0.0 => {
            format!("{joint} loses {}° when it turns the other way", deg(-p[0]))
        }
        Kind::Backlash => format!(
            "{joint} runs {}° ahead when it turns the other way",
            deg(p[0])
        ),
        Kind::PayloadError => format!(
            "The load on the flange is {} kg heavier than the profile says, its centre of gravity {} mm elsewhere",
            digits(p[0]),
            mm(length(&p[1..4]))
        ),
        Kind::ComplianceKnee => format!(
            "{joint} is soft near zero load: {}° more up to {} N m",
            deg(p[0] * p[1]),
            digits(p[0])
        ),
        Kind::LinkCompliance => format!(
            "Link {} bends: {}° under 100 N m",
            site.index + 1,
            deg(100.0 * length(&p[..2]))
        ),
        Kind::BaseCompliance => format!(
            "The pedestal tilts: {}° under 100 N m",
            deg(100.0 * length(&p[..2]))
        ),
        Kind::ThermalGrowth => format!(
            "The arm grows with temperature: {} mm a metre in 10 K",
            mm(10.0 * p[0])
        ),
        Kind::WarmUpDrift if site.index == BASE => format!(
            "The base drifts by {} mm while it warms up, in some {:.0} min",
            mm(length(&p[1..4])),
            p[4] / 60.0
        ),
        Kind::WarmUpDrift => format!(
            "{joint} drifts by {}° while it warms up, in some {:.0} min",
            deg(p[0]),
            p[4] / 60.0
        ),
        Kind::FrameShift => format!(
            "The measuring device or the base moved before row {} by {} mm",
            site.order,
            mm(length(&p[..3]))
        ),
        Kind::ToolSlip => format!(
            "The tool or the reflector slipped before row {} by {} mm",
            site.order,
            mm(length(&p[..3]))
        ),
    };
    debug_assert!(site.index <= JOINTS);
    format!("{text} ({}).", effect.definition().id)
}

/// Labels of effects with those of one kind together: `joint_harmonic joint 1 order 4, joint 2 order 1`.
#[must_use]
pub fn together<'a>(effects: impl Iterator<Item = &'a Effect>) -> String {
    let mut words: Vec<String> = Vec::new();
    let mut last = None;
    for effect in effects {
        let (label, id) = (effect.label(), effect.definition().id);
        let place = label.strip_prefix(id).unwrap_or_default().trim();
        match words.last_mut() {
            Some(word) if last == Some(id) => *word += &format!(", {place}"),
            _ => words.push(label.clone()),
        }
        last = Some(id);
    }
    words.join("; ")
}

/// A group of effects, those that compete with it, and what is left with either, in one sentence.
#[must_use]
pub fn competes(s: &StandIn, d: &Diagnosis) -> String {
    format!(
        "{} instead of {}: {:.0} % as much, {:.4} mm left instead of {:.4} mm (behind by {:.1})",
        together(s.effects.iter()),
        together(s.instead_of.iter().map(|i| &d.found[*i].effect)),
        100.0 * s.part,
        mm_from_m(s.left_m),
        mm_from_m(d.left_m),
        s.behind
    )
}

/// What would compete with a group of the effects found if it were possible.
#[must_use]
pub fn impossibly(i: &Impossible, d: &Diagnosis) -> String {
    let values = i.effects.iter().map(|effect| {
        let definition = effect.definition();
        let known = definition.parameters.iter().zip(effect.parameters);
        let numbers = known.map(|(p, x)| format!("{:.1e} {}", x / p.unit.in_si(), p.unit.symbol()));
        numbers.collect::<Vec<_>>().join(", ")
    });
    format!(
        "{} would explain {:.0} % as much as {}, but only with {}: nothing springs against its load",
        together(i.effects.iter()),
        100.0 * i.part,
        together(i.instead_of.iter().map(|i| &d.found[*i].effect)),
        values.collect::<Vec<_>>().join(" and ")
    )
}

/// Columns of a terminal.
const WIDTH: usize = 80;

/// Text in lines that a terminal shows whole, the first behind `first`, the others behind `others`.
#[must_use]
pub fn wrapped(text: &str, first: &str, others: &str) -> String {
    let mut out = first.to_owned();
    let mut width = first.chars().count();
    let mut is_start = true;
    for word in text.split(' ') {
        let long = word.chars().count();
        if !is_start && width + 1 + long > WIDTH {
            out += "\n";
            out += others;
            width = others.chars().count();
            is_start = true;
        }
        if !is_start {
            out.push(' ');
            width += 1;
        }
        out += word;
        width += long;
        is_start = false;
    }
    out.push('\n');
    out
}

/// The first lines of a report: what it is, and how much of the disagreement goes.
#[must_use]
pub fn summary(d: &Diagnosis) -> String {
    let mut out = match d.verdict {
        Verdict::Explained => String::new(),
        Verdict::NothingMissing => {
            "Nothing is missing: the model agrees with the measurements within the noise.\n"
                .to_owned()
        }
        Verdict::Undetermined => "It cannot be told what is missing:\n".to_owned(),
    };
    for reason in &d.reasons {
        out += &wrapped(reason, "  - ", "    ");
    }
    if d.verdict == Verdict::Undetermined && !d.found.is_empty() {
        out += "The best that the effects known can do:\n";
    }
    for f in &d.found {
        out += &wrapped(&sentence(&f.effect), "", "  ");
    }
    if let Some((before, after)) = d.held_out.filter(|_| !d.found.is_empty() || d.absorbed) {
        let gone = 100.0 * (1.0 - after.mean / before.mean.max(1e-12));
        out += &format!(
            "{gone:.0} % of the disagreement goes: {:.3} → {:.3} mm on {} poses not used.\n",
            before.mean, after.mean, after.n
        );
    }
    out
}
