//! The page of `plan`: the configurations chosen, and what they will determine.

use super::cell::{Along, Cell, Points, Robot};
use super::chart::{Axis, Chart, Kind, Series, Tone};
use super::numbers::{Column, Table, fixed, significant};
use super::page::{Level, Page, Section};
use crate::check::Meshes;
use crate::geometry::units::{DEG, m_from_mm};
use crate::report::text::{fixed as decimals, scientific};
use crate::task::plan::{NotDetermined, Plan};

/// Parameters that a headline names.
const NAMED: usize = 3;

/// The first of parameters by name.
fn named(list: &[NotDetermined]) -> String {
    let names: Vec<&str> = list.iter().take(NAMED).map(|p| p.key.as_str()).collect();
    let more = if list.len() > NAMED { ", \u{2026}" } else { "" };
    names.join(", ") + more
}

/// The page of `plan`.
#[must_use]
pub(crate) fn plan_page(found: &Plan) -> Page {
    let (o, (profile, tool)) = (&found.observability, &found.drawn);
    let (count, dropped) = (found.count(), found.not_determined.len());
    let all = found.expected_sigma.len() + dropped;
    let (level, answer) = if dropped == 0 {
        (
            Level::Good,
            format!("{count} configurations determine all {all} parameters"),
        )
    } else {
        (
            Level::Warning,
            format!(
                "{count} configurations; {dropped} of {all} parameters stay undetermined: {}",
                named(&found.not_determined)
            ),
        )
    };
    let mut page = Page::new("Measurement plan".into(), level, answer);
    page.lead.push(format!(
        "{}; {}",
        found.name,
        super::programs::robot_name(profile)
    ));
    page.fact("O1", decimals(o.o1, 4));
    page.fact("condition number", scientific(o.condition_number));
    page.fact("rank", o.rank.to_string());
    page.fact(
        "random configurations that meet the constraints",
        format!("{:.1} %", 100.0 * found.admitted),
    );
    let mut columns = vec![Column::counts("configuration", 1..=count)];
    let of_arm = found.plate.is_none();
    for (axis, name) in found
        .plate
        .iter()
        .flat_map(|plate| plate.columns.iter().enumerate())
    {
        let angles = found.plate.iter().flat_map(|plate| &plate.angles_deg);
        columns.push(Column::numbers(name, "deg", angles.map(|e| fixed(e[axis], 3))).to(3));
    }
    for joint in (0..6).filter(|_| of_arm) {
        columns.push(
            Column::numbers(
                &format!("joint {}", joint + 1),
                "deg",
                found.joints_deg.iter().map(|q| fixed(q[joint], 3)),
            )
            .to(3),
        );
    }
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        columns.push(
            Column::numbers(
                name,
                "mm",
                found.places_mm.iter().map(|p| fixed(p[axis], 2)),
            )
            .to(2),
        );
    }
    page.tables
        .insert("configurations".into(), Table { columns });
    let mut points = Points {
        name: "configurations",
        title: "Configurations".into(),
        ..Points::default()
    };
    for (n, place) in found.places_mm.iter().enumerate() {
        let q = found.joints_deg.get(n).map(|q| q.map(|q| q * DEG));
        points.push(Some(place.map(m_from_mm)), q);
    }
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "In the cell".into(),
        note: "Where the tool is at each configuration; choose one to see the arm in it.".into(),
        table: "configurations".into(),
        robot: Some(Robot::of(
            profile,
            &[tool.flange_from_tool],
            None,
            &Meshes::default(),
        )),
        bodies: Vec::new(),
        points,
        paths: Vec::new(),
        ellipsoids: Vec::new(),
        along: Along::No(false),
    })));
    for (a, b) in [(1, 2), (3, 4), (5, 6)].into_iter().filter(|_| of_arm) {
        let axis = |joint: usize| Axis::new(&format!("joint {joint}"), "deg");
        let mut chart = Chart::new(
            &format!("Joints {a} and {b}"),
            "configurations",
            axis(a),
            axis(b),
        );
        chart.picks = true;
        chart
            .series
            .push(Series::new(Kind::Dots, a, b, "", Tone::One));
        page.sections.push(Section::Chart(chart));
    }
    let kept = &found.expected_sigma;
    let table = Table {
        columns: vec![
            Column::texts("parameter", kept.iter().map(|p| p.key.clone())),
            Column::numbers(
                "expected sigma",
                "",
                kept.iter().map(|p| significant(p.sigma, 4)),
            ),
            Column::texts("unit", kept.iter().map(|p| p.unit.to_owned())),
        ],
    };
    page.show("sigma", "Expected standard deviations", "", table);
    if dropped > 0 {
        let list = &found.not_determined;
        let table = Table {
            columns: vec![
                Column::texts("parameter", list.iter().map(|p| p.key.clone())),
                Column::texts("like", list.iter().map(|p| p.confounded_with.join(", "))),
            ],
        };
        page.show(
            "undetermined",
            "Parameters that stay undetermined",
            "",
            table,
        );
    }
    page
}
