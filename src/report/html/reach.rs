//! The page of `hexapod --reach`: which poses of the ballbar hexapod a robot can measure.

use super::cell::{Along, Cell, Points, Robot, Solid};
use super::chart::{Axis, Chart, Kind, Series, Tone};
use super::numbers::{Column, Number, Table, fixed, significant};
use super::page::{Level, Page, Section};
use crate::check::Meshes;
use crate::geometry::units::DEG;
use crate::task::hexapod::{Reach, Reached};

/// Radius of a ball where it is drawn, metres.
const BALL_M: f64 = 0.006;

/// The page.
#[must_use]
pub(crate) fn page(found: &Reach) -> Page {
    let (all, count) = (&found.reach, found.measurable);
    let (profile, tool, balls_m, file) = &found.drawn;
    let level = if count > 0 { Level::Good } else { Level::Error };
    let answer = format!("{count} of {} poses are measurable", all.len());
    let mut page = Page::new("Poses of the ballbar hexapod".into(), level, answer);
    page.lead.push(file.clone());
    page.lead.push(super::programs::robot_name(profile));
    let reached = all.iter().filter(|r| !r.postures.is_empty()).count();
    page.fact("poses within the joint limits", reached.to_string());
    page.fact(
        "ballbar",
        format!("{:.1} \u{b1} {:.1} mm", found.leg_mm, found.range_mm),
    );
    let state = |r: &Reached| match (r.measurable, r.leg_error_mm) {
        (true, _) => "measurable",
        (_, Some(_)) => "beyond the ballbar",
        _ => "out of reach",
    };
    let joint = |k: usize| {
        let angle = move |r: &Reached| Some(significant(r.postures.first()?.joints_deg[k], 6));
        Column::numbers(&format!("joint {}", k + 1), "deg", all.iter().map(angle))
    };
    let range = vec![Number(found.range_mm); all.len()];
    let mut columns = vec![
        Column::counts("pose", 1..=all.len()),
        Column::texts("design", all.iter().map(|r| r.design.clone())),
        Column::counts("mode", all.iter().map(|r| r.mode)),
        Column::names("state", all.iter().map(state)),
        Column::counts("postures", all.iter().map(|r| r.postures.len())),
        Column::numbers(
            "largest error of a leg",
            "mm",
            all.iter().map(|r| r.leg_error_mm.map(|e| fixed(e, 6))),
        )
        .to(4),
        Column::numbers("range", "mm", range).for_charts(),
    ];
    columns.extend((0..6).map(joint));
    page.tables.insert("poses".into(), Table { columns });
    let mut points = Points {
        name: "poses",
        title: "Poses".into(),
        ..Points::default()
    };
    for r in all {
        let first = r.postures.first();
        points.push(
            Some(r.place_m),
            first.map(|p| p.joints_deg.map(|q| q * DEG)),
        );
        // the cold end of the colours for what can be measured
        points
            .error
            .push(Number(if r.measurable { 0.0 } else { 1.0 }));
    }
    points.first = all.iter().position(|r| r.measurable).unwrap_or(0);
    let bodies = balls_m
        .iter()
        .zip(["B1", "B2", "B3"])
        .map(|(place, name)| Solid::ball(name, *place, BALL_M));
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "In the cell".into(),
        note: "The origin of the tool's balls at each pose, above the three balls of the base; \
            choose one to see the arm in its first posture. What cannot be measured is red."
            .into(),
        table: "poses".into(),
        robot: Some(Robot::of(
            profile,
            &[tool.flange_from_tool],
            None,
            &Meshes::default(),
        )),
        bodies: bodies.collect(),
        points,
        paths: Vec::new(),
        ellipsoids: Vec::new(),
        along: Along::No(false),
    })));
    let mut chart = Chart::new(
        "Largest error of a leg",
        "poses",
        Axis::new("pose", ""),
        Axis::new("error", "mm"),
    );
    chart.note =
        "Against the ballbar's nominal length; within its range a pose can be measured.".into();
    chart.picks = true;
    chart.wide = true;
    chart
        .series
        .push(Series::new(Kind::Dots, 0, 5, "leg", Tone::One));
    chart.series.push(Series::new(
        Kind::Line,
        0,
        6,
        "range of the ballbar",
        Tone::Limit,
    ));
    page.sections.push(Section::Chart(chart));
    page
}
