//! The pages of `register`, `handeye` and `hexapod`: frames with residuals and uncertainties.

use super::cell::{Along, Cell, Ellipsoid as Drawn, Path, Points};
use super::chart::{Axis, Chart, Kind, Series, Tone};
use super::numbers::{Column, DIGITS, Number, Table, fixed, significant};
use super::page::{Level, Page, Section};
use crate::finding::Finding;
use crate::geometry::units::m_from_mm;
use crate::geometry::{Vector, norm, scale};
use crate::report::text::{noise, search};
use crate::task::handeye::{HandEye, Row};
use crate::task::hexapod;
use crate::task::parts::{Ellipsoid, Pose, Sigma};
use crate::task::register::{Ellipsoid as PointEllipsoid, Registration, Residual};

/// Points of a page; of more every so many, and the largest residual.
const MOST_POINTS: usize = 5000;

/// Points, residuals and ellipsoids with the numbers that stand first.
#[derive(Default)]
struct Frame {
    /// Its title.
    title: String,
    /// Files and method.
    lead: Vec<String>,
    /// The answer.
    answer: String,
    /// Numbers with their names.
    facts: Vec<(String, String)>,
    /// Points that have a place; may be none.
    points: Vec<Residual>,
    /// Ellipsoids; may be none.
    ellipsoids: Vec<Ellipsoid>,
    /// Findings.
    findings: Vec<Finding>,
}

/// The numbers of a pose.
#[must_use]
pub(crate) fn pose_text(pose: &Pose) -> String {
    let [x, y, z] = pose.xyz_mm();
    // a zero has no sign
    let [rx, ry, rz] = pose.rxryrz_deg().map(|r| (r * 1e4).round() / 1e4 + 0.0);
    format!("x {x:.3}  y {y:.3}  z {z:.3} mm, Rx {rx:.4}  Ry {ry:.4}  Rz {rz:.4} deg (Rx·Ry·Rz)")
}

/// Standard deviations of a pose.
pub(crate) fn sigma_text(sigma: &Sigma) -> String {
    let ([x, y, z], [rx, ry, rz]) = (sigma.xyz_mm(), sigma.rxryrz_deg());
    format!("x {x:.3}  y {y:.3}  z {z:.3} mm, about x {rx:.5}  y {ry:.5}  z {rz:.5} deg")
}

/// A page of points, residuals and ellipsoids.
fn frame_page(frame: &Frame) -> Page {
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
    let size = |one: &Residual| one.distance_mm;
    let every = frame.points.len().div_ceil(MOST_POINTS).max(1);
    let worst = frame.points.iter().map(size).fold(0.0, f64::max);
    let shown: Vec<&Residual> = frame
        .points
        .iter()
        .enumerate()
        .filter(|(k, one)| k % every == 0 || (worst > 0.0 && size(one) >= worst))
        .map(|(_, one)| one)
        .collect();
    let axis = |k: usize| {
        let of = move |one: &&Residual| significant(one.residual_mm[k], DIGITS);
        shown.iter().map(of)
    };
    let place = |k: usize| {
        let of = move |one: &&Residual| one.place_mm.map(|p| fixed(p[k], 3));
        shown.iter().map(of)
    };
    let mut columns = vec![
        Column::texts("point", shown.iter().map(|one| one.id.clone())),
        Column::numbers("x", "mm", place(0)).to(3),
        Column::numbers("y", "mm", place(1)).to(3),
        Column::numbers("z", "mm", place(2)).to(3),
    ];
    let mut points = Points {
        name: "points",
        title: "Points".into(),
        by: "residual",
        ..Points::default()
    };
    let mut paths = Vec::new();
    // points without residuals by construction have none to show
    if worst > 0.0 {
        let sizes = shown.iter().map(|l| significant(size(l), DIGITS));
        columns.extend([
            Column::numbers("residual", "mm", sizes).to(4),
            Column::numbers("dx", "mm", axis(0)).to(4),
            Column::numbers("dy", "mm", axis(1)).to(4),
            Column::numbers("dz", "mm", axis(2)).to(4),
            Column::texts("left out", shown.iter().map(|one| one.rejected.clone())),
        ]);
        let sizes = shown.iter().map(|l| fixed(size(l), 6));
        points.error = sizes.collect();
        points.first = super::programs::largest(&points.error);
        let at: Vec<Vector> = shown.iter().filter_map(|one| place_m(one)).collect();
        let by: Vec<Vector> = shown
            .iter()
            .map(|one| one.residual_mm.map(m_from_mm))
            .collect();
        paths.push(Path::vectors("residuals", Tone::Before, &at, &by));
    }
    page.tables.insert("points".into(), Table { columns });
    for one in &shown {
        points.push(place_m(one), None);
    }
    points.joints = Vec::new();
    let thinned = if every > 1 {
        format!(" Every {every}th of {} points.", frame.points.len())
    } else {
        String::new()
    };
    let what = match (worst > 0.0, frame.ellipsoids.is_empty()) {
        (true, true) => "The residual of each point, magnified.",
        (false, _) => "One standard deviation as an ellipsoid, magnified.",
        _ => {
            "The residual of each point, and one standard deviation as an ellipsoid, both \
             magnified."
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
    let sizes: Vec<f64> = frame.points.iter().map(size).collect();
    if sizes.len() > 3 && worst > 0.0 {
        page.histogram(
            "residuals",
            "Residuals",
            ("residual", "mm"),
            &[("", Tone::One, &sizes)],
        );
    }
}

/// Where a point was measured, metres.
fn place_m(one: &Residual) -> Option<Vector> {
    one.place_mm.map(|p| p.map(m_from_mm))
}

fn drawn(of: &Ellipsoid) -> Drawn {
    let mut axes = [Number(0.0); 9];
    for (k, (axis, half)) in of.axes.iter().zip(of.half_axes_mm).enumerate() {
        for (slot, x) in axes[3 * k..].iter_mut().zip(scale(half, *axis)) {
            *slot = significant(x, 5);
        }
    }
    Drawn {
        at: of.place_mm.map(|x| fixed(x, 3)),
        axes,
    }
}

fn show_ellipsoids(page: &mut Page, list: &[Ellipsoid]) {
    if list.is_empty() {
        return;
    }
    let half = |k: usize| {
        list.iter()
            .map(move |e| significant(e.half_axes_mm[k], DIGITS))
    };
    let place = |k: usize| list.iter().map(move |e| fixed(e.place_mm[k], 3));
    let longest = |e: &Ellipsoid| {
        let [x, y, z] = e.axes[0];
        format!("{x:.2} {y:.2} {z:.2}")
    };
    let table = Table {
        columns: vec![
            Column::texts("of", list.iter().map(|e| e.of.clone())),
            Column::numbers("x", "mm", place(0)).to(3),
            Column::numbers("y", "mm", place(1)).to(3),
            Column::numbers("z", "mm", place(2)).to(3),
            Column::numbers("longest half axis", "mm", half(0))
                .to(5)
                .worst_first(),
            Column::numbers("middle", "mm", half(1)).to(5),
            Column::numbers("shortest", "mm", half(2)).to(5),
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

/// The largest residual and whose it is; nothing of points that have none.
fn worst_fact<'a>(points: impl Iterator<Item = &'a Residual>) -> Option<(String, String)> {
    let worst = points.max_by(|a, b| a.distance_mm.total_cmp(&b.distance_mm))?;
    let label = format!("largest residual, {}", worst.id);
    (worst.distance_mm > 0.0).then(|| (label, format!("{:.4} mm", worst.distance_mm)))
}

/// The page of `register`: residuals where points are known, ellipsoids where they were asked for
/// and at FROM's origin.
#[must_use]
pub(crate) fn registration_page(found: &Registration) -> Page {
    let mut facts = Vec::new();
    facts.extend(worst_fact(found.points.iter()));
    facts.push(("TO from FROM".to_owned(), pose_text(&found.pose)));
    if let Some(rmsd) = found.rmsd_mm {
        facts.push(("rmsd".into(), format!("{rmsd:.4} mm")));
    }
    facts.extend(
        noise(found).map(|(value, source)| (format!("noise of a coordinate, {source}"), value)),
    );
    if let Some(scale) = &found.scale {
        let value = format!("{:.6} \u{b1} {:.6}", scale.value, scale.sigma);
        facts.push(("scale".into(), value));
    }
    let of_search = search(found).into_iter();
    facts.extend(of_search.map(|(name, value)| (name.to_owned(), value)));
    let points = found.points.iter().chain(&found.drawn);
    let at = found.at.iter().flatten().map(|e| {
        let [x, y, z] = e.from_mm;
        (format!("{x} {y} {z} of FROM"), e)
    });
    let origin = found.origin.iter().map(|e| ("FROM's origin".to_owned(), e));
    let ellipsoid = |(of, e): (String, &PointEllipsoid)| Ellipsoid {
        of,
        place_mm: e.to_mm,
        half_axes_mm: e.half_axes_mm,
        axes: e.axes,
    };
    frame_page(&Frame {
        title: "Registration".into(),
        lead: vec![format!(
            "{} \u{2192} {} ({})",
            found.from, found.to, found.method
        )],
        answer: found.rmsd_mm.map_or_else(
            || "The frame is constructed".into(),
            |rmsd| format!("The points agree to {rmsd:.4} mm (rmsd)"),
        ),
        facts,
        points: points
            .filter(|one| one.place_mm.is_some())
            .cloned()
            .collect(),
        ellipsoids: origin.chain(at).map(ellipsoid).collect(),
        findings: found.findings.clone(),
    })
}

/// The page of `hexapod`: the tool balls of every pose with their ellipsoids.
#[must_use]
pub(crate) fn hexapod_page(found: &hexapod::Poses) -> Page {
    let ellipsoids: Vec<Ellipsoid> = found
        .poses
        .iter()
        .flat_map(|pose| pose.ellipsoids.iter().cloned())
        .collect();
    let poses = found.poses.iter();
    let worst = poses.max_by(|a, b| a.largest_sigma_mm.total_cmp(&b.largest_sigma_mm));
    let worst = worst.map_or_else(String::new, |pose| {
        let (id, mode, sigma) = (&pose.id, pose.mode, pose.largest_sigma_mm);
        format!("; the worst known ball to {sigma:.5} mm (pose {id}, mode {mode})")
    });
    let points = ellipsoids
        .iter()
        .map(|e| Residual::still(&e.of, e.place_mm));
    frame_page(&Frame {
        title: "Ballbar hexapod".into(),
        lead: vec![format!(
            "{}, in the frame of the base balls; {} mm a length",
            found.name, found.sigma_mm
        )],
        answer: format!("{} poses of {} rows{worst}", found.poses.len(), found.rows),
        facts: vec![(
            "rows with more than one mode".into(),
            found.undecided.to_string(),
        )],
        points: points.collect(),
        ellipsoids,
        findings: found.findings.clone(),
    })
}

/// The page of `hexapod --taught`: the residuals of the three points.
#[must_use]
pub(crate) fn base_page(found: &hexapod::Base) -> Page {
    let points = found.taught_mm.iter().zip(found.residuals_mm);
    let points = points.zip(["B1", "B2", "B3"]);
    let points: Vec<Residual> = points
        .map(|((place_mm, residual_mm), id)| Residual {
            residual_mm,
            distance_mm: norm(residual_mm),
            ..Residual::still(id, *place_mm)
        })
        .collect();
    let mut facts = Vec::new();
    facts.extend(worst_fact(points.iter()));
    facts.push((
        "base balls' frame in the robot's".into(),
        pose_text(&found.base),
    ));
    frame_page(&Frame {
        title: "Base of the ballbar hexapod".into(),
        lead: vec![format!(
            "{}: the base balls as they were taught",
            found.name
        )],
        answer: format!(
            "The taught points agree with the exact distances to {:.4} mm (rmsd)",
            found.rmsd_mm
        ),
        facts,
        points,
        findings: found.findings.clone(),
        ..Frame::default()
    })
}

/// The worst rows, camera and board.
fn hand_eye_facts(found: &HandEye) -> Vec<(String, String)> {
    let worst = |of: &dyn Fn(&Row) -> f64| {
        let rows = found.poses.iter().enumerate();
        let each = rows.map(|(k, row)| (of(row), k + 1));
        each.filter(|(size, _)| size.is_finite())
            .max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut facts = Vec::new();
    let fact = |(size, row): (f64, usize)| {
        let label = format!("largest residual of a position, row {row}");
        (label, format!("{size:.4} mm"))
    };
    facts.extend(worst(&|row| row.residual_mm).map(fact));
    let fact = |(size, row): (f64, usize)| {
        let label = format!("largest residual of an orientation, row {row}");
        (label, format!("{size:.5} deg"))
    };
    facts.extend(worst(&|row| row.residual_deg).map(fact));
    facts.push(("camera".into(), pose_text(&found.camera)));
    let sigma = |sigma: &Option<Sigma>| match sigma {
        Some(sigma) => sigma_text(sigma),
        None => "not known from so few poses".into(),
    };
    facts.push(("camera, sigma".into(), sigma(&found.sigma)));
    facts.push(("board".into(), pose_text(&found.board)));
    facts.push(("board, sigma".into(), sigma(&found.board_sigma)));
    facts
}

/// The page of `handeye`.
#[must_use]
pub(crate) fn hand_eye_page(found: &HandEye) -> Page {
    let in_hand = found.setup == "eye-in-hand";
    let mut page = frame_page(&Frame {
        title: "Hand-eye calibration".into(),
        lead: vec![format!(
            "{} and {}, {}",
            found.names[0],
            found.names[1],
            if in_hand {
                "eye in hand"
            } else {
                "eye to hand"
            }
        )],
        answer: format!(
            "{} poses agree to {:.4} mm and {:.5} deg; a pose left out of the fit to {:.4} mm and \
             {:.5} deg",
            found.poses.len(),
            found.residual_mm,
            found.residual_deg,
            found.left_out_mm,
            found.left_out_deg
        ),
        facts: hand_eye_facts(found),
        points: Vec::new(),
        ellipsoids: found.ellipsoids.clone(),
        findings: found.findings.clone(),
    });
    let of = if in_hand { "board" } else { "camera" };
    let in_base = found.ellipsoids.iter().find(|one| one.of == of);
    show_hand_eye(&mut page, found, in_base);
    page
}

/// The rows of a hand-eye pair, what is uncertain in the base, and what each method found.
fn show_hand_eye(page: &mut Page, found: &HandEye, in_base: Option<&Ellipsoid>) {
    let rows = &found.poses;
    let place = |k: usize| rows.iter().map(move |r| fixed(r.place_mm[k], 2));
    let table = Table {
        columns: vec![
            Column::counts("row", 1..=rows.len()),
            Column::numbers("x", "mm", place(0)).to(2),
            Column::numbers("y", "mm", place(1)).to(2),
            Column::numbers("z", "mm", place(2)).to(2),
            Column::numbers(
                "residual",
                "mm",
                rows.iter().map(|r| significant(r.residual_mm, DIGITS)),
            )
            .to(4),
            Column::numbers(
                "residual",
                "deg",
                rows.iter().map(|r| significant(r.residual_deg, DIGITS)),
            )
            .to(5),
            Column::numbers(
                "left out",
                "mm",
                rows.iter().map(|r| significant(r.left_out_mm, DIGITS)),
            )
            .to(4),
            Column::numbers(
                "left out",
                "deg",
                rows.iter().map(|r| significant(r.left_out_deg, DIGITS)),
            )
            .to(5),
        ],
    };
    page.tables.insert("rows".into(), table);
    let mut points = Points {
        name: "poses",
        title: "Poses".into(),
        by: "residual",
        ..Points::default()
    };
    for row in rows {
        points.push(Some(row.place_mm.map(m_from_mm)), None);
        points.error.push(fixed(row.residual_mm, 6));
    }
    points.joints = Vec::new();
    points.first = super::programs::largest(&points.error);
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "Poses".into(),
        note: format!(
            "Where the flange was, seen from the base; the colour is the residual of each pose.{}",
            in_base.map_or_else(String::new, |one| format!(
                " The ellipsoid, magnified, is one standard deviation of the {}.",
                one.of
            ))
        ),
        table: "rows".into(),
        robot: None,
        bodies: Vec::new(),
        points,
        paths: Vec::new(),
        ellipsoids: in_base.map(drawn).into_iter().collect(),
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
    let methods = found.by_method.named();
    let place = |k: usize| {
        let of = methods.iter();
        of.map(move |(_, pose)| pose.map(|pose| fixed(pose.xyz_mm()[k], 3)))
    };
    let angle = |k: usize| {
        let of = methods.iter();
        of.map(move |(_, pose)| pose.map(|pose| fixed(pose.rxryrz_deg()[k], 4)))
    };
    let table = Table {
        columns: vec![
            Column::texts("method", methods.iter().map(|(name, _)| (*name).to_owned())),
            Column::numbers("x", "mm", place(0)).to(3),
            Column::numbers("y", "mm", place(1)).to(3),
            Column::numbers("z", "mm", place(2)).to(3),
            Column::numbers("Rx", "deg", angle(0)).to(4),
            Column::numbers("Ry", "deg", angle(1)).to(4),
            Column::numbers("Rz", "deg", angle(2)).to(4),
        ],
    };
    let note = "The camera, Rx·Ry·Rz; a method without a solution has dashes.";
    page.show("methods", "What each method finds", note, table);
}
