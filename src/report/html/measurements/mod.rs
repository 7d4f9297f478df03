//! The pages of `calibrate` and `validate`: how far models are from measurements, row by row.

mod calibrate;
mod validate;

pub(crate) use calibrate::calibrate_page;
pub(crate) use validate::validate_page;

use super::cell::{Along, Cell, Path, Points, Robot};
use super::chart::{Axis, Chart, Kind, Series, Tone};
use super::numbers::{Column, DIGITS, Table, fixed, significant};
use super::page::{Page, Section, Summary};
use crate::check::Meshes;
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Vector, norm, scale, sub};
use crate::identify::measurements::Measurements;
use crate::identify::problem::Problem;
use crate::identify::statistics::Miss;
use crate::model::profile::Profile;
use crate::task::parts::{Quality, Statistics, WorstRow};

/// A model whose errors are so many times those of the best two is not shown before it is asked
/// for: it would hide them.
const FAR_OFF: f64 = 20.0;
/// Points whose distances are compared; of more every so many.
const MOST_POINTS: usize = 500;

/// One model's misses of every row.
pub(crate) struct Judged<'a> {
    /// Its name.
    pub name: &'static str,
    /// Its colour.
    pub tone: Tone,
    /// One for each row of the problem.
    pub misses: &'a [Miss],
}

/// Rows with the misses of several models, the best last.
pub(crate) struct Rows<'a> {
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

/// The table of rows; its columns in order: line, id, distance from the middle, then one error for
/// each model.
fn row_table(rows: &Rows, places: &[Vector]) -> (Table, usize) {
    let of = |row: &crate::identify::problem::Row| &rows.measurements.rows[row.measurement];
    let all = &rows.problem.rows;
    let count = places.len().max(1) as f64;
    let mean = places
        .iter()
        .fold([0.0; 3], |sum, p| crate::geometry::add(sum, *p));
    let middle = rows.centre_m.unwrap_or_else(|| scale(1.0 / count, mean));
    let mut columns = vec![
        Column::counts("line", all.iter().map(|row| of(row).line.number)),
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
        )
        .to(1),
    ];
    let first = columns.len();
    for model in &rows.models {
        let label = format!("error, {}", model.name);
        columns.push(
            Column::numbers(
                &label,
                "mm",
                sizes(model).into_iter().map(|e| significant(e, DIGITS)),
            )
            .to(4),
        );
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
            let label = format!("rotation, {}", model.name);
            columns.push(
                Column::numbers(
                    &label,
                    "deg",
                    angles
                        .into_iter()
                        .map(|a| a.map(|a| significant(a, DIGITS))),
                )
                .to(5),
            );
        }
    }
    for (axis, name) in ["dx", "dy", "dz"].into_iter().enumerate() {
        if let Some(best) = rows.models.last() {
            let label = format!("{name}, {}", best.name);
            let seen = all.iter().zip(best.misses);
            columns.push(
                Column::numbers(
                    &label,
                    "mm",
                    seen.map(|(row, m)| {
                        row.observed
                            .point_m()
                            .map(|_| significant(mm_from_m(m.gap[axis]), DIGITS))
                    }),
                )
                .to(4),
            );
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
        by: "error of the best model",
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
    let worst = |model: &Judged| sizes(model).into_iter().fold(0.0, f64::max);
    let fitted = rows.models.len().saturating_sub(2);
    let near = rows.models[fitted..].iter().map(worst).fold(0.0, f64::max);
    for model in &rows.models {
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
        path.off = worst(model) > FAR_OFF * near;
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
        note: "From each measured point to where the model expects it, magnified; the points' \
            colour is the error of the best model."
            .into(),
        table: "rows".into(),
        robot: Some(Robot::of(robot, &tools, None, &Meshes::default())),
        bodies: Vec::new(),
        points,
        paths,
        ellipsoids: Vec::new(),
        along: Along::No(false),
    })));
    let of_all = |of: &dyn Fn(&Judged) -> Vec<f64>| -> Vec<Vec<f64>> {
        rows.models.iter().map(of).collect()
    };
    show_together(page, rows, "errors", ("Errors", "error"), &of_all(&sizes));
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
    let apart = of_all(&|model| distance_errors(&at, &seen, model));
    let names = ("Errors of distances between points", "error of a distance");
    show_together(page, rows, "distances-between", names, &apart);
}

/// The errors of every model on one axis.
fn show_together(
    page: &mut Page,
    rows: &Rows,
    table: &str,
    (title, label): (&str, &str),
    errors: &[Vec<f64>],
) {
    let each = rows.models.iter().zip(errors);
    let series: Vec<(&str, Tone, &[f64])> = each
        .map(|(model, errors)| (model.name, model.tone, errors.as_slice()))
        .collect();
    page.histogram(table, title, (label, "mm"), &series);
}

/// Two values with an arrow between them, mm.
fn from_to(before: Option<f64>, after: Option<f64>) -> String {
    let mm = |value| crate::report::text::fixed(value, 4);
    format!("{} \u{2192} {} mm", mm(before), mm(after))
}

/// Mean and largest error of one model and of a better one, and where the largest is.
fn show_improvement(
    page: &mut Page,
    what: &str,
    (before, after): (&Quality, &Quality),
    worst: Option<&WorstRow>,
) {
    let (Some(before), Some(after)) = (before.main(), after.main()) else {
        return;
    };
    let place = worst.filter(|row| row.is_of_place());
    let place = place.map_or_else(String::new, |row| {
        format!(" ({})", row.file.words(row.line))
    });
    page.fact(
        &format!("mean error, {what}"),
        from_to(before.mean_mm, after.mean_mm),
    );
    page.fact(
        &format!("largest error, {what}{place}"),
        from_to(before.max_mm, after.max_mm),
    );
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

fn summary_row(name: &str, of: &dyn Statistics) -> Vec<String> {
    let s = of.numbers();
    let numbers = [s.mean, s.std, s.mean_plus_3std(), s.p95, s.p997, s.max];
    let mut row = vec![name.to_owned(), s.n.to_string()];
    row.extend(numbers.map(|x| format!("{x:.4}")));
    row
}

fn summary(models: &[(&str, &Quality)]) -> Summary {
    let mut rows = Vec::new();
    for (name, quality) in models {
        let row = |what: &str, s: &dyn Statistics| summary_row(&format!("{name}: {what}"), s);
        rows.extend(quality.position.map(|s| row("position, mm", &s)));
        rows.extend(quality.orientation.map(|s| row("orientation, deg", &s)));
        rows.extend(quality.range.map(|s| row("distance, mm", &s)));
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
