//! The pages of `calibrate` and `validate`: how far models are from measurements, row by row.

use super::cell::{Along, Cell, Path, Points, Robot};
use super::numbers::{Column, Number, Table, fixed, significant};
use super::page::{Axis, Chart, Heat, Kind, Level, Page, Section, Series, Summary, Tone};
use crate::check::Meshes;
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Vector, norm, scale, sub};
use crate::identify::calibration::{Calibration, STRONG_CORRELATION};
use crate::identify::measurements::Measurements;
use crate::identify::problem::Problem;
use crate::identify::statistics::{Miss, Quality, Spread, misses};
use crate::identify::validation::Validation;
use crate::model::profile::Profile;
use crate::report::identification;
use serde_json::Value;

/// Points whose distances are compared; of more every so many.
const MOST_POINTS: usize = 500;
/// Parameters in the square of correlations.
const MOST_NAMES: usize = 60;

/// One model's misses of every row.
pub struct Judged<'a> {
    /// Its name.
    pub name: &'static str,
    /// Its colour.
    pub tone: Tone,
    /// One for each row of the problem.
    pub misses: &'a [Miss],
}

/// Rows with the misses of several models, the best last.
pub struct Rows<'a> {
    /// The rows.
    pub problem: &'a Problem,
    /// What the rows' indices are of.
    pub measurements: &'a Measurements,
    /// The models.
    pub models: Vec<Judged<'a>>,
    /// Where errors are counted from, metres; `None` is the middle of the rows.
    pub centre_m: Option<Vector>,
}

/// Where a row's point is: as measured where it was seen, else as expected.
fn place(rows: &Rows, index: usize) -> Vector {
    let seen = rows.problem.rows[index].observed.point_m();
    seen.unwrap_or_else(|| {
        let best = rows.models.last();
        best.map_or([0.0; 3], |model| model.misses[index].expected_m)
    })
}

fn sizes(judged: &Judged) -> Vec<f64> {
    judged
        .misses
        .iter()
        .map(|m| mm_from_m(m.length_m))
        .collect()
}

/// The table of rows; its columns in order: line, id, distance from the middle, then one error for each model.
fn row_table(rows: &Rows, places: &[Vector]) -> (Table, usize) {
    let of = |row: &crate::identify::problem::Row| &rows.measurements.rows[row.measurement];
    let all = &rows.problem.rows;
    let count = places.len().max(1) as f64;
    let mean = places
        .iter()
        .fold([0.0; 3], |sum, p| crate::geometry::add(sum, *p));
    let middle = rows.centre_m.unwrap_or_else(|| scale(1.0 / count, mean));
    let mut columns = vec![
        Column::counts("line", all.iter().map(|row| of(row).line)),
        Column::texts(
            "id",
            all.iter()
                .map(|row| Some(of(row).id.clone()).filter(|id| !id.is_empty())),
        ),
        Column::names(
            "tool",
            all.iter()
                .map(|row| rows.problem.tools[row.tool].name.as_str()),
        ),
        Column::numbers(
            "from the middle",
            "mm",
            places
                .iter()
                .map(|p| fixed(mm_from_m(norm(sub(*p, middle))), 1)),
        ),
    ];
    let first = columns.len();
    for model in &rows.models {
        let label = format!("error, {}", model.name);
        columns.push(Column::numbers(
            &label,
            "mm",
            sizes(model).into_iter().map(|e| significant(e, 5)),
        ));
    }
    let angles = |model: &Judged| -> Vec<Option<f64>> {
        model
            .misses
            .iter()
            .map(|m| m.angle_rad.map(|a| a / DEG))
            .collect()
    };
    for model in &rows.models {
        let angles = angles(model);
        if angles.iter().any(Option::is_some) {
            let label = format!("turn, {}", model.name);
            columns.push(Column::numbers(
                &label,
                "deg",
                angles.into_iter().map(|a| a.map(|a| significant(a, 4))),
            ));
        }
    }
    for (axis, name) in ["dx", "dy", "dz"].into_iter().enumerate() {
        if let Some(best) = rows.models.last() {
            let label = format!("{name}, {}", best.name);
            let seen = all.iter().zip(best.misses);
            columns.push(Column::numbers(
                &label,
                "mm",
                seen.map(|(row, m)| {
                    row.observed
                        .point_m()
                        .map(|_| significant(mm_from_m(m.gap[axis]), 4))
                }),
            ));
        }
    }
    (Table { columns }, first)
}

/// The view in space, and the charts of errors.
fn show_rows(page: &mut Page, rows: &Rows, robot: &Profile) {
    let places: Vec<Vector> = (0..rows.problem.rows.len())
        .map(|i| place(rows, i))
        .collect();
    let (table, first) = row_table(rows, &places);
    page.tables.insert("rows".into(), table);
    let mut points = Points {
        name: "points",
        title: "Measurements".into(),
        ..Points::default()
    };
    let best = rows.models.len().saturating_sub(1);
    for (row, place) in rows.problem.rows.iter().zip(&places) {
        points.push(Some(*place), Some(row.q));
        points.tool.push(u32::try_from(row.tool).unwrap_or(0));
    }
    if let Some(model) = rows.models.get(best) {
        points.error = sizes(model).into_iter().map(|e| fixed(e, 5)).collect();
    }
    points.first = super::programs::largest(&points.error);
    let seen: Vec<usize> = (0..places.len())
        .filter(|i| rows.problem.rows[*i].observed.point_m().is_some())
        .collect();
    let at: Vec<Vector> = seen.iter().map(|i| places[*i]).collect();
    let mut paths = Vec::new();
    // what came before the frames were fitted may be metres away: it would hide the rest
    for model in rows.models.iter().skip(rows.models.len().saturating_sub(2)) {
        let by: Vec<Vector> = seen
            .iter()
            .map(|i| {
                let gap = model.misses[*i].gap;
                // from measured to expected
                [-gap[0], -gap[1], -gap[2]]
            })
            .collect();
        let mut path = Path::vectors(model.name, model.tone, &at, &by);
        path.items = seen.iter().flat_map(|i| [*i, *i]).collect();
        paths.push(path);
    }
    let tools: Vec<_> = rows
        .problem
        .tools
        .iter()
        .map(|t| t.flange_from_tool)
        .collect();
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "Residuals in space".into(),
        note: "From each measured point to where the model expects it, magnified; the points' colour is the error of the best model.".into(),
        table: "rows".into(),
        robot: Some(Robot::of(robot, &tools, None, &Meshes::default())),
        bodies: Vec::new(),
        points,
        paths,
        ellipsoids: Vec::new(),
        along: Along::No(false),
    })));
    for (k, model) in rows.models.iter().enumerate() {
        let title = format!("Errors, {}", model.name);
        page.histogram(
            &format!("histogram-{k}"),
            &title,
            ("error", "mm"),
            &sizes(model),
            model.tone,
        );
    }
    let mut chart = Chart::new(
        "Error against the distance from the middle",
        "rows",
        Axis::new("distance from the middle of the calibration", "mm"),
        Axis::new("error", "mm"),
    );
    chart.note = "A model that was fitted in one region may be worse away from it.".into();
    chart.picks = true;
    let shown = rows.models.len().saturating_sub(2);
    for (k, model) in rows.models.iter().enumerate().skip(shown) {
        chart.series.push(Series::new(
            Kind::Dots,
            3,
            first + k,
            model.name,
            model.tone,
        ));
    }
    page.sections.push(Section::Chart(chart));
    for (k, model) in rows.models.iter().enumerate().skip(shown) {
        let errors = distance_errors(&at, &seen, model);
        let title = format!("Errors of distances between points, {}", model.name);
        page.histogram(
            &format!("distances-{k}"),
            &title,
            ("error of a distance", "mm"),
            &errors,
            model.tone,
        );
    }
}

/// Errors of distances between all pairs of the points, or of every so many of them, mm.
fn distance_errors(places: &[Vector], seen: &[usize], model: &Judged) -> Vec<f64> {
    let every = places.len().div_ceil(MOST_POINTS).max(1);
    let points: Vec<(Vector, Vector)> = places
        .iter()
        .zip(seen)
        .step_by(every)
        .map(|(place, i)| (*place, model.misses[*i].expected_m))
        .collect();
    let mut errors = Vec::with_capacity(points.len() * points.len() / 2);
    for (i, (a, expected_a)) in points.iter().enumerate() {
        for (b, expected_b) in &points[i + 1..] {
            let apart = norm(sub(*a, *b)) - norm(sub(*expected_a, *expected_b));
            errors.push(mm_from_m(apart).abs());
        }
    }
    errors
}

/// The heads of a summary of spreads.
const HEADS: [&str; 8] = [
    "model",
    "n",
    "mean",
    "std",
    "mean + 3 std",
    "95 %",
    "99.7 %",
    "largest",
];

fn summary_row(name: &str, s: &Spread) -> Vec<String> {
    let numbers = [s.mean, s.std, s.mean_plus_3std(), s.p95, s.p997, s.max];
    let mut row = vec![name.to_owned(), s.n.to_string()];
    row.extend(numbers.map(|x| format!("{x:.4}")));
    row
}

fn summary(models: &[(String, &Quality)]) -> Summary {
    let mut rows = Vec::new();
    for (name, quality) in models {
        for (what, spread) in [
            ("position, mm", quality.position),
            ("orientation, deg", quality.orientation),
            ("distance, mm", quality.range),
        ] {
            rows.extend(spread.map(|s| summary_row(&format!("{name}: {what}"), &s)));
        }
    }
    Summary {
        heads: HEADS.map(str::to_owned).to_vec(),
        rows,
    }
}

fn robot_lead(page: &mut Page, files: &str, profile: &Profile) {
    page.lead.push(files.to_owned());
    page.lead.push(super::programs::robot_name(profile));
}

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
    let before = misses(problem, &found.before_estimate);
    let frames = misses(problem, &found.frames_only.estimate);
    let after = misses(problem, &found.solution.estimate);
    let rows = Rows {
        problem,
        measurements: fit,
        models: vec![
            Judged {
                name: "before",
                tone: Tone::Before,
                misses: &before,
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
            Column::counts("line", list.iter().map(|o| o.line)),
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

/// The page of `validate`.
#[must_use]
pub fn validate_page(
    found: &Validation,
    measurements: &Measurements,
    profile: &Profile,
    files: &str,
) -> Page {
    let mean = |q: &Quality| q.main().map_or(f64::NAN, |s| s.mean);
    let (controller, real) = (mean(&found.controller.quality), mean(&found.real.quality));
    let level = if real <= controller {
        Level::Good
    } else {
        Level::Warning
    };
    let answer = format!(
        "Mean error {real:.3} mm of the real model, {controller:.3} mm of the controller's"
    );
    let mut page = Page::new("Validation".into(), level, answer);
    robot_lead(&mut page, files, profile);
    if found.refitted {
        page.lead
            .push("Base, tool and points were fitted to these rows first.".into());
    }
    page.fact("rows", found.problem.rows.len().to_string());
    if let Some(pairs) = found.real.distance {
        page.fact("distances between points", pairs.pairs.to_string());
        page.fact("their error, mean", format!("{:.4} mm", pairs.mean));
        page.fact(
            "their error, mean + 3 std",
            format!("{:.4} mm", pairs.mean_plus_3std()),
        );
        page.fact("their error, largest", format!("{:.4} mm", pairs.max));
    }
    if let Some(rms) = found.normalised_rms {
        page.fact("residuals in standard deviations", format!("{rms:.2}"));
    }
    page.summary = Some(summary(&[
        ("controller".to_owned(), &found.controller.quality),
        ("frames only".to_owned(), &found.frames_only.quality),
        ("real".to_owned(), &found.real.quality),
    ]));
    let middle = profile.quality.as_ref().and_then(|quality| {
        let numbers = quality["middle_mm"].as_array()?;
        let number = |k: usize| numbers.get(k)?.as_f64();
        Some([number(0)?, number(1)?, number(2)?].map(crate::geometry::units::m_from_mm))
    });
    let rows = Rows {
        problem: &found.problem,
        measurements,
        models: vec![
            Judged {
                name: "controller",
                tone: Tone::Before,
                misses: &found.controller.misses,
            },
            Judged {
                name: "frames only",
                tone: Tone::Frames,
                misses: &found.frames_only.misses,
            },
            Judged {
                name: "real",
                tone: Tone::After,
                misses: &found.real.misses,
            },
        ],
        centre_m: middle,
    };
    show_rows(&mut page, &rows, profile);
    if !found.parts.is_empty() {
        let parts = &found.parts;
        let table = Table {
            columns: vec![
                Column::texts("part", parts.iter().map(|p| format!("{} {}", p.by, p.name))),
                Column::counts("n", parts.iter().map(|p| p.spread.n)),
                Column::numbers(
                    "mean",
                    "mm",
                    parts.iter().map(|p| significant(p.spread.mean, 5)),
                ),
                Column::numbers(
                    "std",
                    "mm",
                    parts.iter().map(|p| significant(p.spread.std, 5)),
                ),
                Column::numbers(
                    "largest",
                    "mm",
                    parts.iter().map(|p| significant(p.spread.max, 5)),
                ),
            ],
        };
        page.show("parts", "Real model by parts", "", table);
    }
    if !found.repeated.is_empty() {
        let list = &found.repeated;
        let table = Table {
            columns: vec![
                Column::counts("line", list.iter().map(|r| r.line)),
                Column::counts("count", list.iter().map(|r| r.count)),
                Column::numbers(
                    "AP",
                    "mm",
                    list.iter().map(|r| significant(r.accuracy_mm, 4)),
                ),
                Column::numbers(
                    "RP",
                    "mm",
                    list.iter().map(|r| significant(r.repeatability_mm, 4)),
                ),
                Column::numbers(
                    "vAP",
                    "mm",
                    list.iter()
                        .map(|r| r.variation_mm.map(|v| significant(v, 4))),
                ),
            ],
        };
        page.show("repeated", "Repeated poses, ISO 9283", "", table);
    }
    page
}
