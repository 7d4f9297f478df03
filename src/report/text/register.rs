//! The text of `register`.

use super::fixed;
use crate::report::Style;
use crate::report::layout::{aligned, row};
use crate::task::parts::Pose;
use crate::task::register::{Registration, Residual};

/// Residuals shown to a person, largest first.
const SHOWN: usize = 12;

pub(super) fn text(found: &Registration, style: Style) -> String {
    let mut text = format!("{} -> {} ({})\n", found.from, found.to, found.method);
    for (what, value) in lines(found) {
        text += &format!("  {what:<22} {value}\n");
    }
    let mut order: Vec<&Residual> = found.points.iter().collect();
    if order.len() > SHOWN && !style.every {
        order.sort_by(|a, b| b.distance_mm.total_cmp(&a.distance_mm));
        text += &format!(
            "  largest {SHOWN} of {} residuals (-v shows all)\n",
            order.len()
        );
        order.truncate(SHOWN);
    }
    if !order.is_empty() {
        let mut rows = vec![row(["  point", "dx", "dy", "dz", "distance mm"])];
        let some_left_out = order.iter().any(|row| row.rejected.is_some());
        rows[0].extend(some_left_out.then(|| "left out".to_owned()));
        for row in order {
            let mut cells = vec![format!("  {}", row.id)];
            cells.extend(row.residual_mm.map(|d| format!("{d:.4}")));
            cells.push(format!("{:.4}", row.distance_mm));
            cells.extend(row.rejected.clone());
            rows.push(cells);
        }
        text += &aligned(&rows, style.width);
    }
    text.extend(found.output.iter().map(|path| format!("  wrote {path}\n")));
    text
}

/// The motion as a frame.
pub(super) fn poses(found: &Registration) -> Vec<(String, Pose)> {
    vec![("TO from FROM".into(), found.pose)]
}

/// What is known of the motion: name and value.
fn lines(found: &Registration) -> Vec<(&'static str, String)> {
    let three = |v: [f64; 3], decimals: usize| v.map(|x| format!("{x:.decimals$}")).join(" ");
    let mut lines = vec![
        ("translation", three(found.translation_mm, 4) + " mm"),
        (
            "rotation Rx·Ry·Rz",
            three(found.pose.rxryrz_deg(), 5) + " deg",
        ),
        (
            "quaternion w x y z",
            found.quaternion.map(|x| format!("{x:.8}")).join(" "),
        ),
    ];
    if let Some(sigma) = &found.sigma {
        lines.push(("sigma of FROM's origin", three(sigma.xyz_mm(), 4) + " mm"));
        let about = three(sigma.rxryrz_deg(), 5) + " deg about TO's axes";
        lines.push(("sigma of the rotation", about));
    }
    if found.rmsd_mm.is_some() {
        let over = match found.points.len() {
            0 => String::new(),
            count => format!(" over {count} points"),
        };
        lines.push(("rmsd", format!("{} mm{over}", fixed(found.rmsd_mm, 4))));
    }
    lines.extend(
        noise(found).map(|(value, source)| ("noise of a coordinate", format!("{value}, {source}"))),
    );
    if let Some(scale) = &found.scale {
        let value = format!("{:.6} +/- {:.6}", scale.value, scale.sigma);
        lines.push(("scale", value));
    }
    lines.extend(search(found));
    for e in found.at.iter().flatten() {
        let [x, y, z] = e.from_mm;
        let [u, v, w] = e.axes[0];
        let half = three(e.half_axes_mm, 4);
        lines.push((
            "error ellipsoid",
            format!("at {x} {y} {z}: {half} mm, longest along ({u:.2} {v:.2} {w:.2})"),
        ));
    }
    lines
}

/// The noise of a coordinate, and where it comes from.
pub(in crate::report) fn noise(found: &Registration) -> Option<(String, &'static str)> {
    let source = if found.noise_from == "given" {
        "given"
    } else {
        "from the residuals"
    };
    let noise_mm = found.noise_mm?;
    Some((format!("{noise_mm:.4} mm"), source))
}

/// What is known of a search by nearness: name and value.
pub(in crate::report) fn search(found: &Registration) -> Vec<(&'static str, String)> {
    let Some(icp) = &found.icp else {
        return Vec::new();
    };
    let last = icp.steps.last().map_or(0.0, |s| s.moved_mm);
    vec![
        (
            "search",
            format!(
                "{} starts, {} steps, the last moved points by {last:.1e} mm",
                icp.starts,
                icp.steps.len()
            ),
        ),
        ("overlap", format!("{:.3} of FROM lies on TO", icp.overlap)),
        (
            "residual",
            format!(
                "{:.4} mm; the points' roughness explains {:.4} mm",
                icp.rms_mm, icp.expected_mm
            ),
        ),
    ]
}
