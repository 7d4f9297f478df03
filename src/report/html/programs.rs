//! The pages of `compensate` and `check`: a program, where the real tool goes with it, and what should be looked at.

use super::cell::{Along, Cell, Path, Points, Robot, bodies};
use super::numbers::{Column, Number, Table, fixed, significant};
use super::page::{Axis, Chart, Kind, Level, Page, Section, Series, Tone};
use crate::check::cell::Cell as CellFile;
use crate::check::trace::Traced;
use crate::check::{Check, Meshes};
use crate::compensate::Compensation;
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector, sub};
use crate::model::profile::Profile;
use crate::program::{Motion, Source};
use crate::report::{check, compensation};

/// Items that a page holds; of more it holds those with the largest numbers.
const MOST_ITEMS: usize = 20_000;
/// Samples of all paths together.
pub const SAMPLES: usize = 24_000;
/// Letters of a program's line that are shown.
const LETTERS: usize = 96;

/// What a page of a program draws beside its numbers.
pub struct Scenery<'a> {
    /// The robot.
    pub profile: &'a Profile,
    /// What stands around it.
    pub cell: Option<&'a CellFile>,
    /// Its meshes.
    pub meshes: &'a Meshes,
}

/// A line of a program as it stands in its file.
struct Lines<'a> {
    sources: &'a [Source],
}

impl Lines<'_> {
    fn text(&self, file: usize, offset: usize) -> String {
        let bytes = &self.sources[file].bytes;
        let offset = offset.min(bytes.len());
        let from = bytes[..offset].iter().rposition(|b| *b == b'\n');
        let from = from.map_or(0, |at| at + 1);
        let to = bytes[offset..]
            .iter()
            .position(|b| matches!(b, b'\n' | b'\r'));
        let to = to.map_or(bytes.len(), |at| offset + at);
        let text = String::from_utf8_lossy(&bytes[from..to]);
        let text = text.trim();
        match text.char_indices().nth(LETTERS) {
            Some((end, _)) => format!("{}\u{2026}", &text[..end]),
            None => text.to_owned(),
        }
    }
}

/// The rows to keep of those that there are: all, or the ones of the largest measure in their order.
fn kept(count: usize, measure: &dyn Fn(usize) -> f64) -> Vec<usize> {
    let mut rows: Vec<usize> = (0..count).collect();
    if count > MOST_ITEMS {
        rows.sort_by(|a, b| measure(*b).total_cmp(&measure(*a)));
        rows.truncate(MOST_ITEMS);
        rows.sort_unstable();
    }
    rows
}

fn thinned(rows: &[usize], all: usize, what: &str) -> String {
    if rows.len() == all {
        return String::new();
    }
    format!(
        "{} of {all} {what} are listed, those with the largest error; --json has all.",
        rows.len()
    )
}

/// A coordinate of a deviation, mm: to the tenth of a micrometre, or to four digits.
fn deviation(mm: f64) -> Number {
    fixed(mm, if mm.abs() < 0.1 { 4 } else { 3 })
}

/// What becomes of a traced place: in space, moved with the part.
fn moved(offset: Option<&Pose>, wanted_m: Vector) -> Vector {
    offset.map_or(wanted_m, |offset| offset.transform(wanted_m))
}

/// The deviations of a program's way from the wanted one. `item` is the row of a move's target; `offset` moves what is wanted.
fn path(
    name: &str,
    tone: Tone,
    traced: &[Traced],
    offset: Option<&Pose>,
    item: &dyn Fn(&Traced) -> Option<usize>,
) -> Path {
    let (mut at, mut by) = (Vec::new(), Vec::new());
    let (mut starts, mut items) = (Vec::new(), Vec::new());
    let every = traced.len().div_ceil(SAMPLES).max(1);
    let mut last = 0;
    for (k, one) in traced.iter().enumerate() {
        let thinned = every > 1 && k % every != 0;
        if !one.continues || k == 0 {
            starts.push(items.len());
        } else if thinned {
            continue;
        }
        last = item(one).unwrap_or(last);
        for place in &one.places {
            let wanted = moved(offset, place.wanted_m);
            at.extend(wanted.map(|x| fixed(mm_from_m(x), 2)));
            by.extend(sub(place.real_m, wanted).map(|x| deviation(mm_from_m(x))));
            items.push(last);
        }
    }
    Path {
        name: name.into(),
        tone,
        graded: true,
        at: Some(at),
        like: None,
        starts,
        items,
        by: Some(by),
    }
}

/// The wanted path, which shares the places of one with deviations.
fn wanted(like: usize) -> Path {
    Path {
        name: "wanted".into(),
        tone: Tone::Wanted,
        graded: false,
        at: None,
        like: Some(like),
        starts: Vec::new(),
        items: Vec::new(),
        by: None,
    }
}

/// Maker, model and serial number.
pub(super) fn robot_name(profile: &Profile) -> String {
    let serial = profile.serial.as_ref();
    let serial = serial.map_or(String::new(), |serial| format!(", serial {serial}"));
    format!("{} {}{serial}", profile.manufacturer, profile.model)
}

fn lead(page: &mut Page, inputs: &[String], outputs: &[String], profile: &Profile, hash: &str) {
    let shown = |names: &[String]| match names {
        [] => String::new(),
        [one] => one.clone(),
        [first, rest @ ..] => format!("{first} and {} more", rest.len()),
    };
    let mut line = shown(inputs);
    if !outputs.is_empty() {
        line += &format!(" \u{2192} {}", shown(outputs));
    }
    page.lead.push(line);
    let short = hash.get(..12).unwrap_or(hash);
    page.lead
        .push(format!("{}; profile sha256 {short}", robot_name(profile)));
}

/// An answer of findings: errors, warnings, or neither.
fn answer(findings: &[Finding], good: &str, bad: &str) -> (Level, String) {
    let count = |severity| findings.iter().filter(|f| f.severity == severity).count();
    let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
    let told = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    match (errors, warnings) {
        (0, 0) => (Level::Good, good.to_owned()),
        (0, _) => (
            Level::Warning,
            format!("{good}; {}", told(warnings, "warning")),
        ),
        _ => (Level::Error, format!("{bad}: {}", told(errors, "error"))),
    }
}

/// What the page of `compensate` is made of.
pub struct Compensated<'a> {
    /// As for the JSON.
    pub header: &'a compensation::Header<'a>,
    /// The compensation, with every target.
    pub compensation: &'a Compensation,
    /// The original program's way.
    pub traced: &'a [Traced],
    /// Where the part really stands.
    pub work_offset: Option<&'a Pose>,
    /// What is drawn.
    pub scenery: &'a Scenery<'a>,
}

/// The page of `compensate`, without the way of the written program.
#[must_use]
pub fn compensate_page(of: &Compensated) -> Page {
    let (header, compensation) = (of.header, of.compensation);
    let program = &compensation.program;
    let reports = &compensation.targets;
    let written = !header.outputs.is_empty();
    let good = if written { "Written" } else { "Computed" };
    let bad = if written {
        "Written with targets left as they were"
    } else {
        "Nothing is written"
    };
    let (level, text) = answer(&compensation.findings, good, bad);
    let mut page = Page::new(
        format!("Compensation of {}", title_of(&header.inputs)),
        level,
        text,
    );
    lead(
        &mut page,
        &header.inputs,
        &header.outputs,
        of.scenery.profile,
        header.profile_sha256,
    );
    let s = &compensation.summary;
    page.fact("targets", s.targets.to_string());
    page.fact("shifted", s.compensated.to_string());
    page.fact("mean shift", format!("{:.3} mm", mm_from_m(s.mean_shift_m)));
    page.fact(
        "largest shift",
        format!("{:.3} mm", mm_from_m(s.max_shift_m)),
    );
    page.fact(
        "largest residual",
        format!("{:.1e} mm", mm_from_m(s.max_residual_m)),
    );
    page.fact(
        "largest rounding",
        format!(
            "{:.4} mm, {:.4} deg",
            mm_from_m(s.max_rounding_m),
            s.max_rounding_rad / DEG
        ),
    );
    let rows = kept(reports.len(), &|i| reports[i].shift.distance_m);
    let lines = Lines {
        sources: header.sources,
    };
    let of_row = |row: &usize| (&program.targets[*row], &reports[*row]);
    let tools = |row: &usize| {
        reports[*row]
            .tool
            .map(|t| program.tools[t as usize].name.as_ref())
    };
    let frames = |row: &usize| {
        reports[*row]
            .frame
            .map(|f| program.frames[f as usize].name.as_ref())
    };
    let number = |of: &dyn Fn(&usize) -> f64, digits| -> Vec<Number> {
        rows.iter()
            .map(|row| significant(of(row), digits))
            .collect()
    };
    let branches: Vec<Option<String>> = rows
        .iter()
        .map(|row| reports[*row].branch.map(|b| b.to_string()))
        .collect();
    let line_of = |row: &usize| {
        let target = of_row(row).0;
        header.sources[target.file as usize]
            .line_column(target.offset as usize)
            .0
    };
    let code = rows.iter().map(|row| {
        let target = of_row(row).0;
        lines.text(target.file as usize, target.offset as usize)
    });
    let mut columns = vec![
        Column::texts(
            "name",
            rows.iter()
                .map(|row| of_row(row).0.name.as_deref().map(str::to_owned)),
        ),
        Column::names(
            "file",
            rows.iter()
                .map(|row| header.inputs[of_row(row).0.file as usize].as_str()),
        ),
        Column::counts("line", rows.iter().map(line_of)),
        Column::names("tool", rows.iter().map(tools)),
        Column::names("frame", rows.iter().map(frames)),
        Column::numbers(
            "shift",
            "mm",
            number(&|r| mm_from_m(reports[*r].shift.distance_m), 5),
        ),
        Column::numbers(
            "shift",
            "deg",
            number(&|r| reports[*r].shift.angle_rad / DEG, 4),
        ),
        Column::numbers(
            "residual",
            "mm",
            number(&|r| mm_from_m(reports[*r].residual.distance_m), 2),
        ),
        Column::numbers(
            "rounding",
            "mm",
            number(&|r| mm_from_m(reports[*r].rounding.distance_m), 3),
        ),
        Column::counts(
            "iterations",
            rows.iter().map(|row| reports[*row].iterations as usize),
        ),
        Column::names("branch", branches.iter().map(Option::as_deref)),
        Column::names(
            "status",
            rows.iter()
                .map(|row| reports[*row].status.map(crate::inverse::Status::id)),
        ),
        Column::names(
            "changed",
            rows.iter()
                .map(|row| if reports[*row].changed { "yes" } else { "no" }),
        ),
    ];
    columns.push(Column::texts("code", code).of_code());
    // where each target is wanted: at the end of the first move to it
    let mut first_move: Vec<Option<&Traced>> = vec![None; program.targets.len()];
    for one in of.traced.iter().rev() {
        if let Some(slot) = first_move.get_mut(one.target) {
            *slot = Some(one);
        }
    }
    let mut row_of: Vec<Option<usize>> = vec![None; program.targets.len()];
    for (k, row) in rows.iter().enumerate() {
        row_of[*row] = Some(k);
    }
    let mut points = Points {
        name: "targets",
        title: "Targets".into(),
        ..Points::default()
    };
    for row in &rows {
        let place = first_move[*row].map(|one| moved(of.work_offset, one.commanded.translation));
        let joints = reports[*row].q.or(first_move[*row].map(|one| one.joints));
        points.push(place, joints);
        points.tool.push(reports[*row].tool.unwrap_or(0));
        points
            .error
            .push(fixed(mm_from_m(reports[*row].shift.distance_m), 4));
    }
    points.first = largest(&points.error);
    page.tables.insert("targets".into(), Table { columns });
    let item = |one: &Traced| row_of.get(one.target).copied().flatten();
    let uncompensated = path(
        "uncompensated",
        Tone::Before,
        of.traced,
        of.work_offset,
        &item,
    );
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "In the cell".into(),
        note: join(&[
            "Where the simulation wants the tool, and where the real tool goes without and with compensation. Deviations are magnified; places are true.",
            &thinned(&rows, reports.len(), "targets"),
        ]),
        table: "targets".into(),
        robot: Some(Robot::of(of.scenery.profile, &mounted(of.scenery.profile, compensation), of.scenery.cell, of.scenery.meshes)),
        bodies: bodies(of.scenery.cell, of.scenery.meshes),
        points,
        paths: vec![uncompensated, wanted(0)],
        ellipsoids: Vec::new(),
        along: Along::Note("Distance of the real tool from where it is wanted, between targets too.".into()),
    })));
    let shifts: Vec<f64> = reports
        .iter()
        .filter(|report| report.changed)
        .map(|report| mm_from_m(report.shift.distance_m))
        .collect();
    page.histogram(
        "shifts",
        "Shifts of targets",
        ("shift", "mm"),
        &shifts,
        Tone::One,
    );
    let roundings: Vec<f64> = reports
        .iter()
        .filter(|report| report.changed)
        .map(|report| 1000.0 * mm_from_m(report.rounding.distance_m))
        .collect();
    page.histogram(
        "roundings",
        "What the file's decimals cost",
        ("rounding", "\u{b5}m"),
        &roundings,
        Tone::One,
    );
    page.findings(&compensation.findings);
    page
}

/// Adds the way of the written program to the page of `compensate`.
pub fn add_written(
    page: &mut Page,
    traced: &[Traced],
    original: &[Traced],
    work_offset: Option<&Pose>,
) {
    let targets: std::collections::BTreeMap<usize, usize> = original
        .iter()
        .map(|one| (one.motion, one.target))
        .collect();
    for section in &mut page.sections {
        let Section::Cell(cell) = section else {
            continue;
        };
        let before = &cell.paths[0];
        // rows of targets, as the original's way has them
        let mut rows = std::collections::BTreeMap::new();
        for (one, item) in original.iter().zip(items_of_moves(original, before)) {
            rows.insert(one.target, item);
        }
        let item = |one: &Traced| rows.get(targets.get(&one.counterpart)?).copied();
        let mut after = path("compensated", Tone::After, traced, work_offset, &item);
        if after.at == before.at && after.starts == before.starts {
            (after.at, after.like) = (None, Some(0));
            (after.starts, after.items) = (Vec::new(), Vec::new());
        }
        cell.paths.insert(1, after);
    }
}

/// For each move the item that its places belong to.
fn items_of_moves<'a>(traced: &'a [Traced], path: &'a Path) -> impl Iterator<Item = usize> + 'a {
    let every = traced.len().div_ceil(SAMPLES).max(1);
    let mut at = 0;
    traced.iter().enumerate().map(move |(k, one)| {
        let drawn = !one.continues || k == 0 || every == 1 || k % every == 0;
        let item = path.items.get(at).copied().unwrap_or(0);
        if drawn {
            at += one.places.len();
        }
        item
    })
}

fn title_of(inputs: &[String]) -> String {
    let name = |path: &String| {
        let path = path.replace('\\', "/");
        path.rsplit('/').next().unwrap_or(&path).to_owned()
    };
    match inputs {
        [] => "no program".into(),
        [one] => name(one),
        [first, rest @ ..] => format!("{} and {} more", name(first), rest.len()),
    }
}

fn join(sentences: &[&str]) -> String {
    let told: Vec<&str> = sentences
        .iter()
        .copied()
        .filter(|s| !s.is_empty())
        .collect();
    told.join(" ")
}

/// The row with the largest size.
pub(super) fn largest(sizes: &[Number]) -> usize {
    let worst = sizes
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.0.total_cmp(&b.1.0));
    worst.map_or(0, |(row, _)| row)
}

/// The program's tools on the flange, as far as the profile or the program tells them.
fn mounted(profile: &Profile, compensation: &Compensation) -> Vec<Pose> {
    tools_of(profile, &compensation.program)
}

fn tools_of(profile: &Profile, program: &crate::program::Program) -> Vec<Pose> {
    let only = profile
        .tools
        .values()
        .next()
        .filter(|_| profile.tools.len() == 1);
    program
        .tools
        .iter()
        .map(|tool| {
            let known = profile.tools.get(tool.name.as_ref() as &str);
            tool.flange_from_tool
                .or(known.map(|t| t.flange_from_tool))
                .or(only.map(|t| t.flange_from_tool))
                .unwrap_or_else(Pose::identity)
        })
        .collect()
}

/// What the page of `check` is made of.
pub struct Checked<'a> {
    /// As for the JSON.
    pub header: &'a check::Header<'a>,
    /// The files.
    pub sources: &'a [Source],
    /// What was found.
    pub check: &'a Check,
    /// The way.
    pub traced: &'a [Traced],
    /// What got worse than a stored run.
    pub worse: usize,
    /// What is drawn.
    pub scenery: &'a Scenery<'a>,
}

/// The page of `check`.
#[must_use]
pub fn check_page(of: &Checked) -> Page {
    let (header, found) = (of.header, of.check);
    let (mut level, mut text) = answer(&found.findings, "No error found", "The answer is no");
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
    page.fact(
        "largest error at targets",
        format!("{:.3} mm", mm_from_m(s.max_target_error.distance_m)),
    );
    page.fact(
        "error along the way, never more than",
        format!("{:.3} mm", mm_from_m(s.max_path_error.distance_m)),
    );
    if let Some(least) = s.min_clearance_m {
        page.fact(
            "clearance, never less than",
            format!("{:.2} mm", mm_from_m(least)),
        );
        page.fact("moves that touch something", s.collisions.to_string());
        page.fact("moves that come too near", s.too_near.to_string());
    }
    if s.unknown > 0 {
        page.fact("moves not followed", s.unknown.to_string());
    }
    let moves = &found.moves;
    let error = |i: usize| {
        let path = moves[i].path.map_or(0.0, |p| p.bound.distance_m);
        path.max(moves[i].target_error.distance_m)
    };
    let rows = kept(moves.len(), &error);
    let tools = tools_of(of.scenery.profile, &found.program);
    let (table, columns) = move_table(of, &rows);
    let mut points = Points {
        name: "moves' ends",
        title: "Moves".into(),
        ..Points::default()
    };
    let mut row_of = vec![None; found.program.moves.len()];
    for (k, row) in rows.iter().enumerate() {
        let report = &moves[*row];
        row_of[report.motion] = Some(k);
        points.push(Some(report.commanded.translation), Some(report.joints));
        let tool = found.program.moves[report.motion].tool;
        points.tool.push(u32::try_from(tool).unwrap_or(0));
        points.error.push(fixed(mm_from_m(error(*row)), 4));
    }
    points.first = largest(&points.error);
    page.tables.insert("moves".into(), table);
    let item = |one: &Traced| row_of.get(one.motion).copied().flatten();
    let real = path("real", Tone::Before, of.traced, None, &item);
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "In the cell".into(),
        note: join(&[
            "Where the tool is wanted and where the real tool goes. Deviations are magnified; places are true.",
            &thinned(&rows, moves.len(), "moves"),
        ]),
        table: "moves".into(),
        robot: Some(Robot::of(of.scenery.profile, &tools, of.scenery.cell, of.scenery.meshes)),
        bodies: bodies(of.scenery.cell, of.scenery.meshes),
        points,
        paths: vec![real, wanted(0)],
        ellipsoids: Vec::new(),
        along: Along::Note("Distance of the real tool from where it is wanted, in samples; the bounds between samples are those of each move.".into()),
    })));
    charts(&mut page, &columns, s.min_clearance_m.is_some());
    let errors: Vec<f64> = moves
        .iter()
        .map(|m| mm_from_m(m.target_error.distance_m))
        .collect();
    page.histogram(
        "errors",
        "Errors at targets",
        ("error", "mm"),
        &errors,
        Tone::One,
    );
    page.findings(&found.findings);
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
    let moves = &of.check.moves;
    let lines = Lines {
        sources: of.sources,
    };
    let mm = |value: f64| significant(mm_from_m(value), 5);
    let some = |of: &dyn Fn(usize) -> Option<Number>| -> Vec<Option<Number>> {
        rows.iter().map(|row| of(*row)).collect()
    };
    let kind = |row: &usize| match moves[*row].kind {
        Motion::Joint => "joint",
        Motion::Linear => "linear",
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
        lines.text(report.file, offset as usize)
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
            .map(|r| of.header.inputs[moves[*r].file].as_str()),
    ));
    add(Column::counts("line", rows.iter().map(|r| moves[*r].line)));
    add(Column::names("kind", rows.iter().map(kind)));
    add(Column::texts(
        "target",
        rows.iter().map(|r| moves[*r].target.clone()),
    ));
    let target = add(Column::numbers(
        "target error",
        "mm",
        some(&|r| Some(mm(moves[r].target_error.distance_m))),
    ));
    add(Column::numbers(
        "uncertainty",
        "mm",
        some(&|r| moves[r].uncertainty_m.map(mm)),
    ));
    let bound = add(Column::numbers(
        "path error",
        "mm",
        some(&|r| moves[r].path.map(|p| mm(p.bound.distance_m))),
    ));
    add(Column::numbers(
        "path error",
        "deg",
        some(&|r| {
            moves[r]
                .path
                .map(|p| significant(p.bound.angle_rad / DEG, 4))
        }),
    ));
    let clearance = add(Column::numbers(
        "clearance",
        "mm",
        some(&|r| moves[r].clearance.map(|c| mm(c.clearance_m))),
    ));
    let nominal = add(Column::numbers(
        "nominal clearance",
        "mm",
        some(&|r| moves[r].nominal_clearance.map(|c| mm(c.clearance_m))),
    ));
    let required = add(Column::numbers(
        "required",
        "mm",
        some(&|r| {
            moves[r]
                .clearance
                .filter(|c| c.pair.is_some())
                .map(|c| mm(c.required_m))
        }),
    ));
    add(Column::names("nearest", pairs.iter().map(Option::as_deref)));
    let margin = add(Column::numbers(
        "joint margin",
        "deg",
        some(&|r| {
            moves[r]
                .limits
                .as_ref()
                .map(|l| significant(l.margin_rad / DEG, 4))
        }),
    ));
    add(Column::numbers(
        "wrist",
        "deg",
        some(&|r| {
            moves[r]
                .limits
                .as_ref()
                .map(|l| significant(l.margins.wrist_rad / DEG, 4))
        }),
    ));
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
    let line = |y: usize, name: &str, tone: Tone| Series::new(Kind::Line, at.number, y, name, tone);
    page.sections.push(chart(
        "Error of each move",
        "The largest anywhere on the move, guaranteed between samples, and that at its end.",
        "error",
        "mm",
        vec![
            line(at.bound, "along the way", Tone::Before),
            line(at.target, "at its end", Tone::After),
        ],
    ));
    if bodies {
        page.sections.push(chart(
            "Clearance along the path",
            "The least room on each move, of the real arm and of the nominal one, and what is required.",
            "clearance",
            "mm",
            vec![
                line(at.clearance, "real arm", Tone::After),
                line(at.nominal, "nominal arm", Tone::Wanted),
                line(at.required, "required", Tone::Limit),
            ],
        ));
    }
    page.sections.push(chart(
        "Room to the joint limits",
        "Of the joint that has least.",
        "margin",
        "deg",
        vec![line(at.margin, "", Tone::One)],
    ));
}
