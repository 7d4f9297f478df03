//! The pages of `register`, `handeye`, `hexapod` and `plan`: frames with residuals and uncertainties, chosen configurations.

use super::cell::{Along, Cell, Ellipsoid, Path, Points, Robot};
use super::numbers::{Column, Number, Table, fixed, significant};
use super::page::{Axis, Chart, Kind, Level, Page, Section, Series, Tone};
use crate::check::Meshes;
use crate::finding::Finding;
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector, norm, scale};
use crate::identify::plan::Plan;
use crate::model::Conditions;
use crate::model::profile::{Mounted, Profile};

/// Points of a page; of more every so many, and the largest residual.
const MOST_POINTS: usize = 5000;

/// A point with what is left of it, metres.
#[derive(Clone, Debug)]
pub struct Left {
    /// Its name.
    pub id: String,
    /// Where it is.
    pub place_m: Vector,
    /// Measured minus mapped.
    pub left_m: Vector,
    /// Why it was left out.
    pub rejected: Option<String>,
}

/// An ellipsoid of uncertainty: one standard deviation, metres.
#[derive(Clone, Debug)]
pub struct Uncertain {
    /// What it is of.
    pub name: String,
    /// Its middle.
    pub place_m: Vector,
    /// Half axes.
    pub half_axes_m: [f64; 3],
    /// Their directions.
    pub axes: [Vector; 3],
}

/// Points, residuals and ellipsoids with the numbers that stand first.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// Its title.
    pub title: String,
    /// Files and method.
    pub lead: Vec<String>,
    /// The answer.
    pub answer: String,
    /// Numbers with their names.
    pub facts: Vec<(String, String)>,
    /// Points; may be none.
    pub points: Vec<Left>,
    /// Ellipsoids; may be none.
    pub ellipsoids: Vec<Uncertain>,
    /// Findings.
    pub findings: Vec<Finding>,
}

/// The numbers of a pose: millimetres and degrees.
#[must_use]
pub fn pose_text(pose: &Pose) -> String {
    let [x, y, z, rx, ry, rz] = pose.xyz_rxryrz();
    let [x, y, z] = [x, y, z].map(mm_from_m);
    // a zero has no sign
    let [rx, ry, rz] = [rx, ry, rz].map(|r| (r / DEG * 1e4).round() / 1e4 + 0.0);
    format!("{x:.3} {y:.3} {z:.3} mm, {rx:.4} {ry:.4} {rz:.4} deg")
}

/// A page of points, residuals and ellipsoids.
#[must_use]
pub fn frame_page(frame: &Frame) -> Page {
    let mut page = Page::new(
        frame.title.clone(),
        Level::of(&frame.findings),
        frame.answer.clone(),
    );
    page.lead.clone_from(&frame.lead);
    for (name, value) in &frame.facts {
        page.fact(name, value.clone());
    }
    if !frame.points.is_empty() {
        show_points(&mut page, frame);
    }
    show_ellipsoids(&mut page, &frame.ellipsoids);
    page.findings(&frame.findings);
    page
}

fn show_points(page: &mut Page, frame: &Frame) {
    let size = |left: &Left| norm(left.left_m);
    let every = frame.points.len().div_ceil(MOST_POINTS).max(1);
    let worst = frame.points.iter().map(size).fold(0.0, f64::max);
    let shown: Vec<&Left> = frame
        .points
        .iter()
        .enumerate()
        .filter(|(k, left)| k % every == 0 || (worst > 0.0 && size(left) >= worst))
        .map(|(_, left)| left)
        .collect();
    let axis = |k: usize| {
        let of = move |left: &&Left| significant(mm_from_m(left.left_m[k]), 4);
        shown.iter().map(of)
    };
    let place = |k: usize| {
        let of = move |left: &&Left| fixed(mm_from_m(left.place_m[k]), 3);
        shown.iter().map(of)
    };
    let mut columns = vec![
        Column::texts("point", shown.iter().map(|left| left.id.clone())),
        Column::numbers("x", "mm", place(0)),
        Column::numbers("y", "mm", place(1)),
        Column::numbers("z", "mm", place(2)),
    ];
    let mut points = Points {
        name: "points",
        title: "Points".into(),
        ..Points::default()
    };
    let mut paths = Vec::new();
    // points that nothing is left of by construction have no residuals to show
    if worst > 0.0 {
        let sizes = shown.iter().map(|l| significant(mm_from_m(size(l)), 5));
        columns.extend([
            Column::numbers("dx", "mm", axis(0)),
            Column::numbers("dy", "mm", axis(1)),
            Column::numbers("dz", "mm", axis(2)),
            Column::numbers("residual", "mm", sizes),
            Column::texts("left out", shown.iter().map(|left| left.rejected.clone())),
        ]);
        let sizes = shown.iter().map(|l| fixed(mm_from_m(size(l)), 6));
        points.error = sizes.collect();
        points.first = super::programs::largest(&points.error);
        let at: Vec<Vector> = shown.iter().map(|left| left.place_m).collect();
        let by: Vec<Vector> = shown.iter().map(|left| left.left_m).collect();
        paths.push(Path::vectors("residuals", Tone::Before, &at, &by));
    }
    page.tables.insert("points".into(), Table { columns });
    for left in &shown {
        points.push(Some(left.place_m), None);
    }
    points.joints = Vec::new();
    let thinned = if every > 1 {
        format!(" Every {every}th of {} points.", frame.points.len())
    } else {
        String::new()
    };
    let what = match (worst > 0.0, frame.ellipsoids.is_empty()) {
        (true, true) => "What is left at each point, magnified.",
        (false, _) => "One standard deviation as an ellipsoid, magnified.",
        _ => {
            "What is left at each point, and one standard deviation as an ellipsoid, both magnified."
        }
    };
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "In space".into(),
        note: format!("{what}{thinned}"),
        table: "points".into(),
        robot: None,
        bodies: Vec::new(),
        points,
        paths,
        ellipsoids: frame.ellipsoids.iter().map(drawn).collect(),
        along: Along::No(false),
    })));
    let sizes: Vec<f64> = frame.points.iter().map(|l| mm_from_m(size(l))).collect();
    if sizes.len() > 3 && worst > 0.0 {
        page.histogram(
            "residuals",
            "Residuals",
            ("residual", "mm"),
            &sizes,
            Tone::One,
        );
    }
}

fn drawn(of: &Uncertain) -> Ellipsoid {
    let mut axes = [Number(0.0); 9];
    for (k, (axis, half)) in of.axes.iter().zip(of.half_axes_m).enumerate() {
        for (slot, x) in axes[3 * k..].iter_mut().zip(scale(mm_from_m(half), *axis)) {
            *slot = significant(x, 5);
        }
    }
    Ellipsoid {
        at: of.place_m.map(|x| fixed(mm_from_m(x), 3)),
        axes,
    }
}

fn show_ellipsoids(page: &mut Page, list: &[Uncertain]) {
    if list.is_empty() {
        return;
    }
    let half = |k: usize| {
        list.iter()
            .map(move |e| significant(mm_from_m(e.half_axes_m[k]), 4))
    };
    let longest = |e: &Uncertain| {
        let [x, y, z] = e.axes[0];
        format!("{x:.2} {y:.2} {z:.2}")
    };
    let table = Table {
        columns: vec![
            Column::texts("of", list.iter().map(|e| e.name.clone())),
            Column::numbers(
                "x",
                "mm",
                list.iter().map(|e| fixed(mm_from_m(e.place_m[0]), 3)),
            ),
            Column::numbers(
                "y",
                "mm",
                list.iter().map(|e| fixed(mm_from_m(e.place_m[1]), 3)),
            ),
            Column::numbers(
                "z",
                "mm",
                list.iter().map(|e| fixed(mm_from_m(e.place_m[2]), 3)),
            ),
            Column::numbers("longest half axis", "mm", half(0)),
            Column::numbers("middle", "mm", half(1)),
            Column::numbers("shortest", "mm", half(2)),
            Column::texts("longest along", list.iter().map(longest)),
        ],
    };
    page.show(
        "ellipsoids",
        "Uncertainty, one standard deviation",
        "",
        table,
    );
}

/// A row of a hand-eye pair, metres and radians.
#[derive(Clone, Copy, Debug)]
pub struct HandEyeRow {
    /// Where the camera sees the board or the flange is, whichever moves.
    pub place_m: Vector,
    /// What is left.
    pub distance_m: f64,
    /// Its angle.
    pub rotation_rad: f64,
    /// The same where the row was left out of the fit.
    pub out_distance_m: f64,
    /// Its angle.
    pub out_rotation_rad: f64,
}

/// Adds the rows of a hand-eye pair, what is uncertain in the base, and what each method found.
pub fn add_hand_eye(
    page: &mut Page,
    rows: &[HandEyeRow],
    in_base: &Uncertain,
    methods: &[(String, Option<Pose>)],
) {
    let table = Table {
        columns: vec![
            Column::counts("row", 1..=rows.len()),
            Column::numbers(
                "x",
                "mm",
                rows.iter().map(|r| fixed(mm_from_m(r.place_m[0]), 2)),
            ),
            Column::numbers(
                "y",
                "mm",
                rows.iter().map(|r| fixed(mm_from_m(r.place_m[1]), 2)),
            ),
            Column::numbers(
                "z",
                "mm",
                rows.iter().map(|r| fixed(mm_from_m(r.place_m[2]), 2)),
            ),
            Column::numbers(
                "residual",
                "mm",
                rows.iter().map(|r| significant(mm_from_m(r.distance_m), 4)),
            ),
            Column::numbers(
                "residual",
                "deg",
                rows.iter().map(|r| significant(r.rotation_rad / DEG, 4)),
            ),
            Column::numbers(
                "left out",
                "mm",
                rows.iter()
                    .map(|r| significant(mm_from_m(r.out_distance_m), 4)),
            ),
            Column::numbers(
                "left out",
                "deg",
                rows.iter()
                    .map(|r| significant(r.out_rotation_rad / DEG, 4)),
            ),
        ],
    };
    page.tables.insert("rows".into(), table);
    let mut points = Points {
        name: "poses",
        title: "Poses".into(),
        ..Points::default()
    };
    for row in rows {
        points.push(Some(row.place_m), None);
        points.error.push(fixed(mm_from_m(row.distance_m), 6));
    }
    points.joints = Vec::new();
    points.first = super::programs::largest(&points.error);
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "Poses".into(),
        note: format!("Where the flange was, seen from the base; the colour is what is left of each pose. The ellipsoid, magnified, is one standard deviation of the {}.", in_base.name),
        table: "rows".into(),
        robot: None,
        bodies: Vec::new(),
        points,
        paths: Vec::new(),
        ellipsoids: vec![drawn(in_base)],
        along: Along::No(false),
    })));
    for (title, columns, unit) in [
        ("Residuals of positions", [4, 6], "mm"),
        ("Residuals of orientations", [5, 7], "deg"),
    ] {
        let mut chart = Chart::new(
            title,
            "rows",
            Axis::new("row", ""),
            Axis::new("residual", unit),
        );
        chart.picks = true;
        chart.series.push(Series::new(
            Kind::Dots,
            0,
            columns[0],
            "fitted",
            Tone::After,
        ));
        chart.series.push(Series::new(
            Kind::Dots,
            0,
            columns[1],
            "row left out",
            Tone::Before,
        ));
        page.sections.push(Section::Chart(chart));
    }
    let table = Table {
        columns: vec![
            Column::texts("method", methods.iter().map(|(name, _)| name.clone())),
            Column::texts(
                "camera",
                methods
                    .iter()
                    .map(|(_, pose)| pose.as_ref().map_or("no solution".to_owned(), pose_text)),
            ),
        ],
    };
    page.show("methods", "What each method finds", "", table);
}

/// The page of `plan`.
#[must_use]
pub fn plan_page(found: &Plan, profile: &Profile, tool: &Mounted, file: &str) -> Page {
    let o = &found.observability;
    let dropped = found.identifiable.dropped.len();
    let (level, answer) = if dropped == 0 {
        (
            Level::Good,
            format!(
                "{} configurations determine all {} parameters",
                found.joints.len(),
                found.parameters.len()
            ),
        )
    } else {
        (
            Level::Warning,
            format!(
                "{} configurations; {dropped} of {} parameters stay undetermined",
                found.joints.len(),
                found.parameters.len()
            ),
        )
    };
    let mut page = Page::new("Measurement plan".into(), level, answer);
    page.lead
        .push(format!("{file}; {}", super::programs::robot_name(profile)));
    page.fact("O1", format!("{:.4}", o.o1));
    page.fact("condition number", format!("{:.3e}", o.condition_number));
    page.fact("rank", o.rank.to_string());
    page.fact(
        "random configurations that meet the constraints",
        format!("{:.1} %", 100.0 * found.admitted),
    );
    let controller = profile.controller_model(tool);
    let places: Vec<Vector> = found
        .joints
        .iter()
        .map(|q| controller.forward(q, &Conditions::default()).translation)
        .collect();
    let mut columns = vec![Column::counts("configuration", 1..=found.joints.len())];
    for joint in 0..6 {
        columns.push(Column::numbers(
            &format!("joint {}", joint + 1),
            "deg",
            found.joints.iter().map(|q| fixed(q[joint] / DEG, 3)),
        ));
    }
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        columns.push(Column::numbers(
            name,
            "mm",
            places.iter().map(|p| fixed(mm_from_m(p[axis]), 2)),
        ));
    }
    page.tables
        .insert("configurations".into(), Table { columns });
    let mut points = Points {
        name: "configurations",
        title: "Configurations".into(),
        ..Points::default()
    };
    for (q, place) in found.joints.iter().zip(&places) {
        points.push(Some(*place), Some(*q));
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
    for (a, b) in [(1, 2), (3, 4), (5, 6)] {
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
    let kept: Vec<(usize, f64)> = found
        .identifiable
        .kept
        .iter()
        .copied()
        .zip(found.sigma.iter().copied())
        .collect();
    let parameter = |i: usize| &found.parameters[i];
    let table = Table {
        columns: vec![
            Column::texts(
                "parameter",
                kept.iter().map(|(i, _)| parameter(*i).key.clone()),
            ),
            Column::numbers(
                "expected sigma",
                "",
                kept.iter()
                    .map(|(i, s)| significant(s / parameter(*i).unit.in_si(), 4)),
            ),
            Column::texts(
                "unit",
                kept.iter()
                    .map(|(i, _)| parameter(*i).unit.symbol().to_owned()),
            ),
        ],
    };
    page.show("sigma", "Expected standard deviations", "", table);
    if dropped > 0 {
        let list = &found.identifiable.dropped;
        let like = |with: &[usize]| {
            with.iter()
                .map(|i| parameter(*i).key.clone())
                .collect::<Vec<_>>()
                .join(", ")
        };
        let table = Table {
            columns: vec![
                Column::texts(
                    "parameter",
                    list.iter().map(|d| parameter(d.parameter).key.clone()),
                ),
                Column::texts("like", list.iter().map(|d| like(&d.confounded_with))),
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
