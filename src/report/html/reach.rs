//! The page of `hexapod --reach`: which poses of the ballbar hexapod a robot can measure.

use super::cell::{Along, Cell, Points, Robot, Solid};
use super::numbers::{Column, Number, Table, fixed, significant};
use super::page::{Axis, Chart, Kind, Level, Page, Section, Series, Tone};
use crate::check::Meshes;
use crate::geometry::Vector;
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::profile::{Mounted, Profile};

/// Radius of a ball where it is drawn, metres.
const BALL_M: f64 = 0.006;

/// A pose of the device, and how the robot stands there; metres and radians.
#[derive(Clone, Debug)]
pub struct Reached {
    /// The order of the balls.
    pub design: String,
    /// The assembly mode.
    pub mode: usize,
    /// Where the origin of the tool's balls is in the world.
    pub place_m: Vector,
    /// Postures within the joint limits.
    pub postures: usize,
    /// The first of them.
    pub joints: Option<[f64; 6]>,
    /// Largest difference of a leg from the ballbar's nominal length.
    pub leg_error_m: Option<f64>,
    /// Whether the ballbar measures it.
    pub measurable: bool,
}

/// The ballbar and the balls of the base, metres.
#[derive(Clone, Copy, Debug)]
pub struct Ballbar {
    /// Its nominal length.
    pub length_m: f64,
    /// How far it measures to each side.
    pub range_m: f64,
    /// Where the balls B1, B2, B3 are in the world.
    pub balls_m: [Vector; 3],
}

/// The page.
#[must_use]
pub fn page(
    all: &[Reached],
    ballbar: &Ballbar,
    profile: &Profile,
    tool: &Mounted,
    file: &str,
) -> Page {
    let count = all.iter().filter(|r| r.measurable).count();
    let level = if count > 0 { Level::Good } else { Level::Error };
    let answer = format!("{count} of {} poses are measurable", all.len());
    let mut page = Page::new("Poses of the ballbar hexapod".into(), level, answer);
    page.lead.push(file.to_owned());
    page.lead.push(super::programs::robot_name(profile));
    let reached = all.iter().filter(|r| r.postures > 0).count();
    page.fact("poses within the joint limits", reached.to_string());
    page.fact(
        "ballbar",
        format!(
            "{:.1} \u{b1} {:.1} mm",
            mm_from_m(ballbar.length_m),
            mm_from_m(ballbar.range_m)
        ),
    );
    let state = |r: &Reached| match (r.measurable, r.leg_error_m) {
        (true, _) => "measurable",
        (_, Some(_)) => "beyond the ballbar",
        _ => "out of reach",
    };
    let joint = |k: usize| {
        let angle = move |r: &Reached| Some(significant(r.joints?[k] / DEG, 6));
        Column::numbers(&format!("joint {}", k + 1), "deg", all.iter().map(angle))
    };
    let range = vec![Number(mm_from_m(ballbar.range_m)); all.len()];
    let mut columns = vec![
        Column::counts("pose", 1..=all.len()),
        Column::texts("design", all.iter().map(|r| r.design.clone())),
        Column::counts("mode", all.iter().map(|r| r.mode)),
        Column::names("state", all.iter().map(state)),
        Column::counts("postures", all.iter().map(|r| r.postures)),
        Column::numbers(
            "largest error of a leg",
            "mm",
            all.iter()
                .map(|r| r.leg_error_m.map(|e| fixed(mm_from_m(e), 6))),
        ),
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
        points.push(Some(r.place_m), r.joints);
        // the cold end of the colours for what can be measured
        points
            .error
            .push(Number(if r.measurable { 0.0 } else { 1.0 }));
    }
    points.first = all.iter().position(|r| r.measurable).unwrap_or(0);
    let bodies = ballbar
        .balls_m
        .iter()
        .zip(["B1", "B2", "B3"])
        .map(|(place, name)| Solid::ball(name, *place, BALL_M));
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "In the cell".into(),
        note: "The origin of the tool's balls at each pose, above the three balls of the base; choose one to see the arm in its first posture. What cannot be measured is red.".into(),
        table: "poses".into(),
        robot: Some(Robot::of(profile, &[tool.flange_from_tool], None, &Meshes::default())),
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
