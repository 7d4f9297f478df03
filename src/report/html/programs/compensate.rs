//! The page of `compensate`.

use super::{
    Lines, SAMPLES, Scenery, answer, join, kept, largest, lead, moved, path, stand_of, thinned,
    title_of, tools_of, wanted,
};
use crate::check::trace::Traced;
use crate::compensate::{Compensation, TargetReport};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Separation};
use crate::inverse::Method;
use crate::report::html::cell::{Along, Cell, Path, Points, Robot, bodies};
use crate::report::html::chart::Tone;
use crate::report::html::numbers::{Column, Number, Table, fixed, significant};
use crate::report::html::page::{Level, Page, Section};
use crate::task::compensate::{Files, Header};

/// What the page of `compensate` is made of.
pub(crate) struct Compensated<'a> {
    /// As for the JSON.
    pub header: &'a Header<'a>,
    /// The compensation, with every target.
    pub compensation: &'a Compensation,
    /// The original program's path.
    pub traced: &'a [Traced],
    /// Where the part really stands.
    pub work_offset: Option<&'a Pose>,
    /// What is drawn.
    pub scenery: &'a Scenery<'a>,
}

/// The page of `compensate`, without the path of the written program.
#[must_use]
pub(crate) fn compensate_page(of: &Compensated) -> Page {
    let (header, compensation) = (of.header, of.compensation);
    let program = &compensation.program;
    let reports = &compensation.targets;
    let written = !header.outputs.is_empty();
    let good = if written { "Written" } else { "Computed" };
    let files = Files::of(header);
    let bad = match (written, files.refused.len()) {
        (false, _) => "Nothing is written: ".to_owned(),
        (true, 0) => "Written with targets that stay as they were: ".to_owned(),
        (true, refused) => format!(
            "{} of {} programs are written, {refused} refused: ",
            files.written.len(),
            files.written.len() + refused
        ),
    };
    let (level, text) = answer(&compensation.findings, good, &bad);
    let inputs = header.own_inputs();
    let mut page = Page::new(
        format!("Compensation of {}", title_of(&inputs)),
        level,
        text,
    );
    lead(
        &mut page,
        &inputs,
        &header.outputs,
        of.scenery.profile,
        header.profile_sha256,
    );
    if written && !files.refused.is_empty() {
        page.fact("programs refused, not written", files.refused.join(", "));
    }
    let s = &compensation.summary;
    if s.compensated > 0 {
        let to = |before: f64, after: f64| {
            format!(
                "{:.3} \u{2192} {:.4} mm",
                mm_from_m(before),
                mm_from_m(after)
            )
        };
        page.fact(
            "mean error of the real tool, before and after",
            to(s.mean_before_m, s.mean_after_m),
        );
        page.fact(
            "largest error, before and after",
            to(s.max_before_m, s.max_rounding_m),
        );
        page.fact(
            "largest shift",
            format!("{:.3} mm", mm_from_m(s.max_shift_m)),
        );
    }
    page.fact(
        "targets shifted",
        format!("{} of {}", s.compensated, s.targets),
    );
    if s.joint_targets > 0 {
        page.fact("joint targets that stay", s.joint_targets.to_string());
    }
    if let Some(offset) = of.work_offset {
        let moved = Pose::identity().separation(offset);
        page.lead.push(format!(
            "the part stands {:.3} mm, {:.4} deg from where the program has it (--work-offset): \
             shifts hold that, errors do not",
            mm_from_m(moved.distance_m),
            moved.angle_rad / DEG
        ));
    }
    // notes do not stand before the view
    let findings_first = level != Level::Good;
    if findings_first {
        page.findings(&compensation.findings);
    }
    let own: Vec<usize> = header.own_targets(compensation).collect();
    let all = own.len();
    let rows = kept(own, &|i| reports[i].shift.distance_m);
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
    let off = |of: &dyn Fn(&TargetReport) -> Option<Separation>, digits| {
        let distance_m = |row: &usize| of(&reports[*row]).map_or(f64::NAN, |off| off.distance_m);
        number(&|row| mm_from_m(distance_m(row)), digits)
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
        Column::numbers("error before", "mm", off(&|report| report.before, 5)).to(4),
        Column::numbers("error after", "mm", off(&|report| report.rounding, 3)).to(4),
        Column::numbers(
            "shift",
            "mm",
            number(&|r| mm_from_m(reports[*r].shift.distance_m), 5),
        )
        .to(4),
        Column::numbers(
            "shift",
            "deg",
            number(&|r| reports[*r].shift.angle_rad / DEG, 4),
        )
        .to(4),
        Column::numbers(
            "residual",
            "mm",
            number(&|r| mm_from_m(reports[*r].residual.distance_m), 2),
        )
        .in_detail(),
        Column::names(
            "method",
            rows.iter().map(|row| reports[*row].method.map(Method::id)),
        )
        .in_detail(),
        Column::counts(
            "shift evaluations",
            rows.iter()
                .map(|row| reports[*row].shift_evaluations as usize),
        )
        .in_detail(),
        Column::counts(
            "newton evaluations",
            rows.iter()
                .map(|row| reports[*row].newton_evaluations as usize),
        )
        .in_detail(),
        Column::names("branch", branches.iter().map(Option::as_deref)).in_detail(),
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
        by: "shift",
        ..Points::default()
    };
    for row in &rows {
        let place = first_move[*row].map(|one| moved(of.work_offset, one.commanded.translation));
        let joints = reports[*row].q.or(first_move[*row].map(|one| one.joints));
        points.push(place, joints);
        let stand = first_move[*row].and_then(|one| stand_of(program, one.motion));
        points.push_stand(of.scenery.profile, stand);
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
            "Where the simulation wants the tool, and where the real tool goes without and with \
             compensation. Deviations are magnified; places are true.",
            &thinned(&rows, all, "targets"),
        ]),
        table: "targets".into(),
        robot: Some(Robot::of(
            of.scenery.profile,
            &tools_of(of.scenery.profile, program),
            of.scenery.cell,
            of.scenery.meshes,
        )),
        bodies: bodies(of.scenery.cell, of.scenery.meshes),
        points,
        paths: vec![uncompensated, wanted(0)],
        ellipsoids: Vec::new(),
        along: Along::Note(join(&[
            "Distance of the real tool from where it is wanted, between targets too.",
            if s.joint_targets > 0 {
                "Joint targets stay as they are (--joint-targets correct shifts them): there the \
                 error stays, too."
            } else {
                ""
            },
        ])),
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
        &[("", Tone::One, &shifts)],
    );
    let roundings: Vec<f64> = reports
        .iter()
        .filter(|report| report.changed)
        .filter_map(|report| Some(1000.0 * mm_from_m(report.rounding?.distance_m)))
        .collect();
    page.histogram(
        "roundings",
        "What the file's decimals cost",
        ("rounding", "\u{b5}m"),
        &[("", Tone::One, &roundings)],
    );
    if !findings_first {
        page.findings(&compensation.findings);
    }
    page
}

/// Adds the path of the written program to the page of `compensate`.
pub(crate) fn add_written(
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
        // rows of targets, as the original's path has them
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
