//! What a calibration or a validation found, as JSON.

use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::identify::Line;
use crate::identify::calibration::{Calibration, STRONG_CORRELATION};
use crate::identify::doubt::Remark;
use crate::identify::identifiability::Observability;
use crate::identify::statistics::{Pairs, Quality, Spread};
use serde_json::{Value, json};

/// A number for JSON: what is not finite becomes null.
fn finite(value: f64) -> Value {
    if value.is_finite() {
        json!(value)
    } else {
        Value::Null
    }
}

/// Statistics of errors in a unit, `mm` or `deg`.
#[must_use]
pub fn spread(spread: Option<Spread>, unit: &str) -> Value {
    let Some(s) = spread else { return Value::Null };
    let mut map = serde_json::Map::new();
    map.insert("n".into(), json!(s.n));
    for (key, value) in [
        ("mean", s.mean),
        ("std", s.std),
        ("mean_plus_3std", s.mean_plus_3std()),
        ("rms", s.rms),
        ("p95", s.p95),
        ("p997", s.p997),
        ("max", s.max),
    ] {
        map.insert(format!("{key}_{unit}"), finite(value));
    }
    Value::Object(map)
}

/// Errors of distances between all pairs, which were computed in mm.
#[must_use]
pub fn pairs(pairs: Option<Pairs>) -> Value {
    let Some(p) = pairs else { return Value::Null };
    json!({
        "pairs": p.pairs, "mean_mm": p.mean, "std_mm": p.std, "mean_plus_3std_mm": p.mean_plus_3std(), "max_mm": p.max,
    })
}

/// One model's statistics.
#[must_use]
pub fn quality(quality: &Quality) -> Value {
    let mut map = serde_json::Map::new();
    if quality.position.is_some() {
        map.insert("position".into(), spread(quality.position, "mm"));
    }
    if quality.orientation.is_some() {
        map.insert("orientation".into(), spread(quality.orientation, "deg"));
    }
    if quality.range.is_some() {
        map.insert("range".into(), spread(quality.range, "mm"));
    }
    Value::Object(map)
}

/// How well configurations show the parameters.
#[must_use]
pub fn observability(o: &Observability) -> Value {
    json!({
        "o1": finite(o.o1), "o2": finite(o.o2), "o3": finite(o.o3), "o4": finite(o.o4), "o5": finite(o.o5),
        "condition_number": finite(o.condition_number), "rank": o.rank, "min_singular_value": finite(o.min_singular_value),
    })
}

/// What stands in a line, with the file where several are read as one.
#[must_use]
pub fn with_file(mut found: Value, line: &Line) -> Value {
    if let Some(file) = &line.file {
        found["file"] = json!(**file);
    }
    found
}

/// Remarks on measurements as findings.
#[must_use]
pub fn findings(remarks: &[Remark], file: &str) -> Vec<Finding> {
    let one = |r: &Remark| Finding {
        id: r.id,
        severity: if r.warning {
            Severity::Warning
        } else {
            Severity::Note
        },
        file: r.line.file.as_deref().unwrap_or(file).into(),
        line: r.line.number,
        column: usize::from(r.line.number > 0),
        message: r.message.clone(),
        hint: r.hint.clone(),
    };
    remarks.iter().map(one).collect()
}

/// Every parameter with its value in the unit of files.
#[must_use]
pub fn parameters(calibration: &Calibration) -> Vec<Value> {
    let identifiable = &calibration.solution.identifiable;
    let names = &calibration.problem.parameters;
    calibration
        .parameters()
        .enumerate()
        .map(|(i, (parameter, value, sigma))| {
            let dropped = identifiable.dropped.iter().find(|d| d.parameter == i);
            let confounded: Vec<&str> = dropped
                .map(|d| d.confounded_with.iter().map(|other| names[*other].key.as_str()).collect())
                .unwrap_or_default();
            let unit = parameter.unit.in_si();
            let weak = dropped.and_then(|d| d.weak).map(|w| w * parameter.scale / unit);
            json!({
                "sigma_if_identified": weak,
                "key": parameter.key, "value": value / unit, "unit": parameter.unit.symbol(),
                "sigma": sigma.map(|s| s / unit), "identifiable": sigma.is_some(), "confounded_with": confounded,
            })
        })
        .collect()
}

/// Pairs of parameters that move together.
#[must_use]
pub fn correlations(calibration: &Calibration) -> Vec<Value> {
    let names = &calibration.solution.parameters;
    let strong = calibration
        .uncertainty
        .strong_correlations(STRONG_CORRELATION);
    let one = |(i, j, c): (usize, usize, f64)| json!({"a": names[i].key, "b": names[j].key, "correlation": c});
    strong.into_iter().map(one).collect()
}

/// The report `calibration/1`.
#[must_use]
pub fn calibration(calibration: &Calibration, file: &str) -> Value {
    let outliers: Vec<Value> = calibration
        .outliers
        .iter()
        .map(|o| {
            let found = json!({
                "line": o.line.number, "id": o.id, "residual_mm": mm_from_m(o.length_m), "times_typical": o.times,
                "limit": o.limit, "weight": o.weight,
                "reason": format!(
                    "residual {:.3} mm is {:.1} times the typical one; the limit is {:.1}",
                    mm_from_m(o.length_m), o.times, o.limit
                ),
            });
            with_file(found, &o.line)
        })
        .collect();
    let u = &calibration.uncertainty;
    let mut report = json!({
        "poseshift": "calibration/1",
        "parameters": parameters(calibration),
        "observability": observability(&calibration.observability),
        "correlations": correlations(calibration),
        "outliers": outliers,
        "before": quality(&calibration.before),
        "frames_only": quality(&calibration.frames_only_quality),
        "after": quality(&calibration.after),
        "rows": calibration.problem.rows.len(),
        "numbers": calibration.problem.numbers(),
        "degrees_of_freedom": u.degrees_of_freedom,
        "sigma_factor": u.sigma_factor,
        "sigma_assumed": calibration.problem.sigma_assumed,
        "expected_error_mm": calibration.expected_m.map(mm_from_m),
        "base": crate::report::pose(&calibration.solution.estimate.world_from_base),
        "base_replaced": calibration.base_replaced,
        "passes": calibration.solution.passes,
        "stopped": calibration.stop().describe(),
        "findings": findings(&calibration.remarks, file),
    });
    let mm = |v: [f64; 3]| v.map(mm_from_m);
    let touched = calibration.features().map(|(feature, place)| {
        json!({
            "feature": feature.name, "contact": feature.kind.id(), "centre_mm": mm(place.centre_m),
            "radius_mm": place.radius_m.map(mm_from_m), "normal": place.normal,
        })
    });
    let touched: Vec<Value> = touched.collect();
    if !touched.is_empty() {
        report["features"] = json!(touched);
    }
    if let Some((frames, full)) = &calibration.held_out {
        report["held_out"] = json!({"frames_only": quality(frames), "after": quality(full)});
    }
    report
}

/// The block `quality` of a profile: statistics, and the covariance in the units of files.
#[must_use]
pub fn profile_quality(calibration: &Calibration) -> Value {
    let u = &calibration.uncertainty;
    let parameters = &calibration.solution.parameters;
    let unit = |i: usize| parameters[i].scale / parameters[i].unit.in_si();
    let keys: Vec<Value> = parameters
        .iter()
        .enumerate()
        .map(|(i, p)| json!({"key": p.key, "unit": p.unit.symbol(), "sigma": u.sigma[i] / p.unit.in_si()}))
        .collect();
    let rows: Vec<Vec<f64>> = (0..parameters.len())
        .map(|i| {
            (0..=i)
                .map(|j| u.covariance[(i, j)] * unit(i) * unit(j))
                .collect()
        })
        .collect();
    let seen: Vec<[f64; 3]> = calibration
        .problem
        .rows
        .iter()
        .filter_map(|r| r.observed.point_m())
        .collect();
    let middle = seen
        .iter()
        .fold([0.0; 3], |sum, p| crate::geometry::add(sum, *p));
    let middle = middle.map(|x| mm_from_m(x / seen.len().max(1) as f64));
    json!({
        "middle_mm": middle,
        "before": quality(&calibration.before),
        "frames_only": quality(&calibration.frames_only_quality),
        "after": quality(&calibration.after),
        "observability": observability(&calibration.observability),
        "sigma_factor": u.sigma_factor,
        "degrees_of_freedom": u.degrees_of_freedom,
        "parameters": keys,
        "covariance_lower_triangle": rows,
        "strong_correlations": correlations(calibration),
    })
}
