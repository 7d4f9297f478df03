//! The page of `check`.

use super::{
    Lines, SAMPLES, Scenery, answer, join, kept, largest, lead, path, stand_of, thinned, title_of,
    tools_of, wanted,
};
use crate::check::Check;
use crate::check::trace::{Traced, trace};
use crate::geometry::units::{DEG, mm_from_m};
use crate::program::{Motion, Source};
use crate::report::html::cell::{Along, Cell, Points, Robot, bodies};
use crate::report::html::chart::{Axis, Chart, Kind, Series, Tone};
use crate::report::html::numbers::{Column, DIGITS, Number, Table, fixed, significant};
use crate::report::html::page::{Level, Page, Section};
use crate::report::text::{at_least, at_most};
use crate::task::check::{Checking, Header};

/// What the page of `check` is made of.
struct Checked<'a> {
    header: &'a Header<'a>,
    sources: &'a [Source],
    check: &'a Check,
    traced: &'a [Traced],
    worse: usize,
    scenery: &'a Scenery<'a>,
}

/// The page of `check`; `worse` numbers are so than a stored run's.
#[must_use]
pub(crate) fn check_page(of: &Checking, header: &Header, worse: usize) -> Page {
    // what could be checked can be followed
    let traced = trace(&of.subject(), &of.request.options, SAMPLES).unwrap_or_default();
    page(&Checked {
        header,
        sources: of.request.sources,
        check: &of.check,
        traced: &traced,
        worse,
        scenery: &Scenery {
            profile: &of.profile,
            cell: of.cell.as_ref(),
            meshes: &of.meshes,
        },
    })
}

fn page(of: &Checked) -> Page {
    let (header, found) = (of.header, of.check);
    let (mut level, mut text) = answer(&found.findings, "No error found", "");
    if of.worse > 0 {
        level = Level::Error;
        text += &format!("; {} numbers are worse than the stored run's", of.worse);
    }
    let mut page = Page::new(format!("Check of {}", title_of(header.inputs)), level, text);
    lead(
        &mut page,
        header.inputs,
        &[],
        of.scenery.profile,
        header.profile_sha256,
    );
    if !header.nominal.is_empty() {
        page.lead
            .push(format!("wanted: {}", header.nominal.join(", ")));
    }
    let s = &found.summary;
    page.fact("moves", s.moves.to_string());
    let largest_of = |in_joints: bool| {
        let all = found
            .moves
            .iter()
            .filter(|m| m.in_joints(&found.program) == in_joints);
        all.map(|m| m.target_error.distance_m).reduce(f64::max)
    };
    for (label, in_joints) in [
        ("largest error at targets", false),
        ("largest error at joint targets, which stay", true),
    ] {
        if let Some(largest) = largest_of(in_joints) {
            page.fact(label, format!("{:.3} mm", mm_from_m(largest)));
        }
    }
    page.fact(
        "error along the path, never more than",
        format!(
            "{:.3} mm",
            at_most(mm_from_m(s.max_path_error.distance_m), 3)
        ),
    );
    if let Some(least) = s.min_clearance_m {
        page.fact(
            "clearance, never less than",
            format!("{:.2} mm", at_least(mm_from_m(least), 2)),
        );
        page.fact("moves that touch something", s.collisions.to_string());
        page.fact("moves that come too near", s.too_near.to_string());
    }
    if s.unknown > 0 {
        page.fact("moves not followed", s.unknown.to_string());
    }
    // notes do not stand before the view
    let findings_first = level != Level::Good;
    if findings_first {
        page.findings(&found.findings);
    }
    let moves = &found.moves;
    let error = |i: usize| {
        let path = moves[i].path.map_or(0.0, |p| p.bound.distance_m);
        path.max(moves[i].target_error.distance_m)
    };
    let rows = kept((0..moves.len()).collect(), &error);
    let tools = tools_of(of.scenery.profile, &found.program);
    let (table, columns) = move_table(of, &rows);
    let mut points = Points {
        name: "moves' ends",
        title: "Moves".into(),
        by: "largest error of the move",
        ..Points::default()
    };
    let mut row_of = vec![None; found.program.moves.len()];
    for (k, row) in rows.iter().enumerate() {
        let report = &moves[*row];
        row_of[report.motion] = Some(k);
        let (at, joints) = (found.commanded(report), found.joints(report));
        points.push(Some(at.translation), Some(*joints));
        points.push_stand(of.scenery.profile, stand_of(&found.program, report.motion));
        let tool = found.program.moves[report.motion].tool;
        points.tool.push(u32::try_from(tool).unwrap_or(0));
        points.error.push(fixed(mm_from_m(error(*row)), 4));
    }
    // a collision is worse than any error
    let touches = |row: &usize| {
        let room = moves[*row].clearance.as_ref().map(|c| c.clearance_m);
        room.filter(|room| *room <= 0.0)
    };
    let touching = rows.iter().enumerate();
    let touching = touching.filter_map(|(k, row)| Some((k, touches(row)?)));
    points.first = touching
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map_or_else(|| largest(&points.error), |(k, _)| k);
    page.tables.insert("moves".into(), table);
    let item = |one: &Traced| row_of.get(one.motion).copied().flatten();
    let real = path("real", Tone::Before, of.traced, None, &item);
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "In the cell".into(),
        note: join(&[
            "Where the tool is wanted and where the real tool goes. Deviations are magnified; \
             places are true.",
            &thinned(&rows, moves.len(), "moves"),
        ]),
        table: "moves".into(),
        robot: Some(Robot::of(
            of.scenery.profile,
            &tools,
            of.scenery.cell,
            of.scenery.meshes,
        )),
        bodies: bodies(of.scenery.cell, of.scenery.meshes),
        points,
        paths: vec![real, wanted(0)],
        ellipsoids: Vec::new(),
        along: Along::Note(
            "Distance of the real tool from where it is wanted, in samples; the \
            bounds between samples are those of each move."
                .into(),
        ),
    })));
    charts(&mut page, &columns, s.min_clearance_m.is_some());
    let errors_at = |in_joints: bool| -> Vec<f64> {
        let here = moves
            .iter()
            .filter(|m| m.in_joints(&found.program) == in_joints);
        here.map(|m| mm_from_m(m.target_error.distance_m)).collect()
    };
    let (errors, in_joints) = (errors_at(false), errors_at(true));
    let mut series: Vec<(&str, Tone, &[f64])> = vec![("targets", Tone::One, &errors)];
    if !in_joints.is_empty() {
        series.push(("joint targets, which stay", Tone::Wanted, &in_joints));
    }
    page.histogram("errors", "Errors at targets", ("error", "mm"), &series);
    if !findings_first {
        page.findings(&found.findings);
    }
    page
}

/// Columns that charts draw.
struct Drawn {
    number: usize,
    target: usize,
    bound: usize,
    clearance: usize,
    nominal: usize,
    required: usize,
    margin: usize,
}

fn move_table(of: &Checked, rows: &[usize]) -> (Table, Drawn) {
    let (moves, program) = (&of.check.moves, &of.check.program);
    let lines = Lines {
        sources: of.sources,
    };
    let mm = |value: f64| significant(mm_from_m(value), 5);
    let far = |value: f64| significant(mm_from_m(value), DIGITS);
    let some = |of: &dyn Fn(usize) -> Option<Number>| -> Vec<Option<Number>> {
        rows.iter().map(|row| of(*row)).collect()
    };
    let kind = |row: &usize| match program.moves[moves[*row].motion].motion {
        Motion::Joint => "joint",
        Motion::Linear => "linear",
        Motion::Spline => "spline",
        Motion::ArcVia => "arc-via",
        Motion::ArcEnd => "arc",
    };
    let pair = |row: &usize| {
        let clearance = moves[*row].clearance.as_ref()?;
        let (a, b) = of.header.scene.pair_names(clearance)?;
        Some(format!("{a} / {b}"))
    };
    let pairs: Vec<Option<String>> = rows.iter().map(pair).collect();
    let code = rows.iter().map(|row| {
        let report = &moves[*row];
        let offset = of.check.program.moves[report.motion].offset;
        lines.text(program.moves[report.motion].file as usize, offset as usize)
    });
    let mut columns = Vec::new();
    let mut add = |column: Column| {
        columns.push(column);
        columns.len() - 1
    };
    let number = add(Column::counts("move", rows.iter().map(|row| row + 1)));
    add(Column::names(
        "file",
        rows.iter()
            .map(|r| of.header.inputs[program.moves[moves[*r].motion].file as usize].as_str()),
    ));
    add(Column::counts(
        "line",
        rows.iter().map(|r| moves[*r].line as usize),
    ));
    add(Column::names("kind", rows.iter().map(kind)));
    add(Column::texts(
        "target",
        rows.iter().map(|r| {
            let target = program.target_of(&program.moves[moves[*r].motion])?;
            target.name.as_deref().map(str::to_owned)
        }),
    ));
    let target = add(Column::numbers(
        "target error",
        "mm",
        some(&|r| Some(mm(moves[r].target_error.distance_m))),
    )
    .to(4));
    add(Column::numbers(
        "uncertainty",
        "mm",
        some(&|r| moves[r].uncertainty_m.map(mm)),
    )
    .to(4));
    let bound = add(Column::numbers(
        "path error",
        "mm",
        some(&|r| moves[r].path.map(|p| mm(p.bound.distance_m))),
    )
    .to(4));
    add(Column::numbers(
        "path error",
        "deg",
        some(&|r| {
            moves[r]
                .path
                .map(|p| significant(p.bound.angle_rad / DEG, 4))
        }),
    )
    .to(4));
    let clearance = add(Column::numbers(
        "clearance",
        "mm",
        some(&|r| moves[r].clearance.as_ref().map(|c| far(c.clearance_m))),
    )
    .to(3));
    let nominal = add(Column::numbers(
        "nominal clearance",
        "mm",
        some(&|r| moves[r].nominal_clearance_m.map(|[along, _]| far(along))),
    )
    .to(3)
    .in_detail());
    let required = add(Column::numbers(
        "required",
        "mm",
        some(&|r| {
            moves[r]
                .clearance
                .as_ref()
                .filter(|c| c.pair.is_some())
                .map(|c| far(c.required_m))
        }),
    )
    .to(3)
    .in_detail());
    add(Column::names("nearest", pairs.iter().map(Option::as_deref)));
    let margin = add(Column::numbers(
        "joint margin",
        "deg",
        some(&|r| {
            moves[r]
                .limits
                .as_ref()
                .map(|l| significant(l.margin_rad / DEG, 5))
        }),
    )
    .to(2));
    add(Column::numbers(
        "wrist",
        "deg",
        some(&|r| {
            moves[r]
                .limits
                .as_ref()
                .map(|l| significant(l.margins.wrist_rad / DEG, 5))
        }),
    )
    .to(2)
    .in_detail());
    add(Column::texts("code", code).of_code());
    let drawn = Drawn {
        number,
        target,
        bound,
        clearance,
        nominal,
        required,
        margin,
    };
    (Table { columns }, drawn)
}

fn charts(page: &mut Page, at: &Drawn, bodies: bool) {
    let chart = |title: &str, note: &str, label: &str, unit: &'static str, series: Vec<Series>| {
        let mut chart = Chart::new(
            title,
            "moves",
            Axis::new("move", ""),
            Axis::new(label, unit),
        );
        chart.note = note.into();
        chart.series = series;
        chart.picks = true;
        Section::Chart(chart)
    };
    let dots = |y: usize, name: &str, tone: Tone| Series::new(Kind::Dots, at.number, y, name, tone);
    page.sections.push(chart(
        "Error of each move",
        "The largest anywhere on the move, guaranteed between samples, and that at its end.",
        "error",
        "mm",
        vec![
            dots(at.bound, "along the path", Tone::Before),
            dots(at.target, "at its end", Tone::After),
        ],
    ));
    if bodies {
        page.sections.push(chart(
            "Clearance along the path",
            "The least room on each move, of the real arm and of the nominal one, and what is \
             required.",
            "clearance",
            "mm",
            vec![
                dots(at.clearance, "real arm", Tone::After),
                dots(at.nominal, "nominal arm", Tone::Wanted),
                dots(at.required, "required", Tone::Limit),
            ],
        ));
    }
    page.sections.push(chart(
        "Room to the joint limits",
        "Of the joint that has least.",
        "margin",
        "deg",
        vec![dots(at.margin, "", Tone::One)],
    ));
}
