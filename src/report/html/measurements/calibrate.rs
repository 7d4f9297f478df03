//! The page of `calibrate`.

use super::{Judged, Rows, robot_lead, show_rows, summary};
use crate::geometry::units::mm_from_m;
use crate::identify::calibration::{Calibration, STRONG_CORRELATION};
use crate::identify::measurements::Measurements;
use crate::identify::statistics::{Quality, misses};
use crate::report::html::numbers::{Column, Number, Table, fixed, significant};
use crate::report::html::page::{Axis, Chart, Heat, Kind, Level, Page, Section, Series, Tone};
use crate::report::identification;
use serde_json::Value;

/// Parameters in the square of correlations.
const MOST_NAMES: usize = 60;

fn texts(list: &[Value], key: &str) -> Vec<Option<String>> {
    let text = |value: &Value| match &value[key] {
        Value::Null => None,
        Value::String(text) => Some(text.clone()),
        Value::Bool(yes) => Some(if *yes { "yes" } else { "no" }.into()),
        Value::Array(all) => {
            let names: Vec<&str> = all.iter().filter_map(Value::as_str).collect();
            Some(names.join(", "))
        }
        other => Some(other.to_string()),
    };
    list.iter().map(text).collect()
}

fn numbers(list: &[Value], key: &str, digits: usize) -> Vec<Option<Number>> {
    let number = |value: &Value| value[key].as_f64().map(|x| significant(x, digits));
    list.iter().map(number).collect()
}

/// The page of `calibrate`.
#[must_use]
pub fn calibrate_page(
    found: &Calibration,
    fit: &Measurements,
    files: &str,
    written: Option<&str>,
) -> Page {
    let profile = found.profile();
    let findings = identification::findings(&found.remarks, files);
    let warnings = findings
        .iter()
        .filter(|f| f.severity > crate::finding::Severity::Note)
        .count();
    let level = if warnings > 0 {
        Level::Warning
    } else {
        Level::Good
    };
    let main = |q: &Quality| q.main().map_or(f64::NAN, |s| s.mean);
    let (frames, after) = (main(&found.frames_only_quality), main(&found.after));
    let mut answer =
        format!("Mean error {frames:.3} mm with the frames alone, {after:.3} mm with everything");
    if let Some(held) = found.held_out.as_ref().and_then(|(_, full)| full.main()) {
        answer += &format!("; {:.3} mm on rows held out", held.mean);
    }
    let mut page = Page::new("Calibration".into(), level, answer);
    robot_lead(&mut page, files, &profile);
    if let Some(written) = written {
        page.lead.push(format!("\u{2192} {written}"));
    }
    let problem = &found.problem;
    page.fact("rows", problem.rows.len().to_string());
    page.fact(
        "parameters determined",
        format!(
            "{} of {}",
            found.solution.parameters.len(),
            problem.parameters.len()
        ),
    );
    page.fact("observability O1", format!("{:.4}", found.observability.o1));
    page.fact(
        "condition number",
        format!("{:.3e}", found.observability.condition_number),
    );
    page.fact(
        "residuals in standard deviations",
        format!("{:.2}", found.uncertainty.sigma_factor),
    );
    page.fact("rows that do not fit", found.outliers.len().to_string());
    let mut models = vec![
        ("before".to_owned(), &found.before),
        ("frames only".to_owned(), &found.frames_only_quality),
        ("after".to_owned(), &found.after),
    ];
    if let Some((alone, full)) = &found.held_out {
        models.push(("held out, frames only".into(), alone));
        models.push(("held out, after".into(), full));
    }
    page.summary = Some(summary(&models));
    let frames = misses(problem, &found.frames_only.estimate);
    let after = misses(problem, &found.solution.estimate);
    let rows = Rows {
        problem,
        measurements: fit,
        models: vec![
            Judged {
                name: "before",
                tone: Tone::Before,
                misses: &found.before_misses,
            },
            Judged {
                name: "frames only",
                tone: Tone::Frames,
                misses: &frames,
            },
            Judged {
                name: "after",
                tone: Tone::After,
                misses: &after,
            },
        ],
        centre_m: None,
    };
    show_rows(&mut page, &rows, &profile);
    show_parameters(&mut page, found);
    show_correlations(&mut page, found);
    show_outliers(&mut page, found);
    page.findings(&findings);
    page
}

fn show_parameters(page: &mut Page, found: &Calibration) {
    let list = identification::parameters(found);
    let table = Table {
        columns: vec![
            Column::texts("parameter", texts(&list, "key")),
            Column::numbers("value", "", numbers(&list, "value", 6)),
            Column::numbers("sigma", "", numbers(&list, "sigma", 3)),
            Column::texts("unit", texts(&list, "unit")),
            Column::texts("determined", texts(&list, "identifiable")),
            Column::texts("like", texts(&list, "confounded_with")),
        ],
    };
    page.show(
        "parameters",
        "Parameters",
        "What these data do not determine is left as it was, and it is told what it is like.",
        table,
    );
    let mut units: Vec<&'static str> = Vec::new();
    for parameter in &found.solution.parameters {
        if !units.contains(&parameter.unit.symbol()) {
            units.push(parameter.unit.symbol());
        }
    }
    for unit in units {
        let known = |value: &&Value| value["unit"] == unit && value["sigma"].is_number();
        let list: Vec<Value> = list.iter().filter(known).cloned().collect();
        let twice = list
            .iter()
            .map(|value| value["sigma"].as_f64().map(|s| significant(2.0 * s, 3)));
        let table = Table {
            columns: vec![
                Column::texts("parameter", texts(&list, "key")),
                Column::numbers("value", unit, numbers(&list, "value", 6)),
                Column::numbers("two sigma", unit, twice),
            ],
        };
        let name = format!("parameters-{unit}");
        page.tables.insert(name.clone(), table);
        let mut chart = Chart::new(
            &format!("Parameters in {unit}"),
            &name,
            Axis::new("parameter", ""),
            Axis::new("value, with two standard deviations", unit),
        );
        let mut series = Series::new(Kind::Rows, 0, 1, "", Tone::One);
        series.y2 = Some(2);
        chart.series.push(series);
        page.sections.push(Section::Chart(chart));
    }
}

fn show_correlations(page: &mut Page, found: &Calibration) {
    let parameters = &found.solution.parameters;
    let count = parameters.len().min(MOST_NAMES);
    if count < 2 {
        return;
    }
    let mut note = format!(
        "Pairs beyond \u{b1}{STRONG_CORRELATION} move together: these data hardly tell one from the other."
    );
    if parameters.len() > count {
        note += &format!(" The first {count} of {} parameters.", parameters.len());
    }
    page.sections.push(Section::Heat(Heat {
        title: "Correlations of parameters".into(),
        note,
        names: parameters[..count].iter().map(|p| p.key.clone()).collect(),
        values: (0..count)
            .map(|i| {
                (0..=i)
                    .map(|j| fixed(found.uncertainty.correlation(i, j), 3))
                    .collect()
            })
            .collect(),
    }));
}

fn show_outliers(page: &mut Page, found: &Calibration) {
    let list = &found.outliers;
    if list.is_empty() {
        return;
    }
    let table = Table {
        columns: vec![
            Column::counts("line", list.iter().map(|o| o.line.number)),
            Column::texts("id", list.iter().map(|o| o.id.clone())),
            Column::numbers(
                "residual",
                "mm",
                list.iter().map(|o| significant(mm_from_m(o.length_m), 5)),
            ),
            Column::numbers(
                "times typical",
                "",
                list.iter().map(|o| significant(o.times, 3)),
            ),
            Column::numbers("weight", "", list.iter().map(|o| significant(o.weight, 3))),
        ],
    };
    page.show("outliers", "Rows that do not fit the others", "", table);
}
