//! The text of `handeye`.

use crate::report::Style;
use crate::report::layout::{aligned, row};
use crate::task::handeye::HandEye;
use crate::task::parts::Pose;

/// What the camera's and the board's poses are called.
fn names(found: &HandEye) -> (&'static str, &'static str) {
    if found.setup == "eye-to-hand" {
        ("base_from_camera", "flange_from_board")
    } else {
        ("flange_from_camera", "base_from_board")
    }
}

/// Camera and board as frames.
pub(super) fn poses(found: &HandEye) -> Vec<(String, Pose)> {
    let (camera, board) = names(found);
    vec![(camera.into(), found.camera), (board.into(), found.board)]
}

pub(super) fn text(found: &HandEye, style: Style) -> String {
    let (what, board) = names(found);
    let named = |name: &str, pose: &Pose| {
        let mut cells = vec![format!("  {name}")];
        cells.extend(pose.xyz_mm().map(|x| format!("{x:.3}")));
        cells.extend(pose.rxryrz_deg().map(|r| format!("{r:.4}")));
        cells
    };
    let mut rows = vec![row([
        what, "x mm", "y mm", "z mm", "rx deg", "ry deg", "rz deg",
    ])];
    for (method, pose) in found.by_method.named() {
        rows.push(pose.map_or_else(
            || row([&format!("  {method}"), "-", "-", "-", "-", "-", "-"]),
            |pose| named(method, pose),
        ));
    }
    if found.corners.is_some() {
        rows.push(named("corners", &found.camera));
    }
    let mut cells = vec!["  sigma".to_owned()];
    match &found.sigma {
        Some(sigma) => {
            cells.extend(sigma.xyz_mm().map(|m| format!("{m:.4}")));
            cells.extend(sigma.rxryrz_deg().map(|r| format!("{r:.5}")));
        }
        None => cells.extend([(); 6].map(|()| "-".to_owned())),
    }
    rows.push(cells);
    rows.push(row([board]));
    rows.push(named("refined", &found.board));
    let mut text = aligned(&rows, style.width);
    let count = found.poses.len();
    text += &if found.sigma.is_some() {
        let holder = what.split('_').next().unwrap_or_default();
        format!("{count} poses; sigma of the rotation about the axes of the {holder}\n")
    } else {
        format!("{count} poses; sigma is not known from so few\n")
    };
    if let Some(corners) = &found.corners {
        text += &format!(
            "corners {:.4} mm before, {:.4} mm after, {:.4} mm when left out: {}\n",
            corners.before_mm,
            corners.after_mm,
            corners.left_out_mm,
            if corners.accepted {
                "accepted"
            } else {
                "not accepted"
            }
        );
    }
    text += &format!(
        "residual: {:.4} mm, {:.5} deg; left out of the fit: {:.4} mm, {:.5} deg\n",
        found.residual_mm, found.residual_deg, found.left_out_mm, found.left_out_deg
    );
    if style.every {
        let mut rows = vec![row(["row", "residual mm", "deg", "left out mm", "deg"])];
        for (index, one) in found.poses.iter().enumerate() {
            rows.push(vec![
                (index + 1).to_string(),
                format!("{:.4}", one.residual_mm),
                format!("{:.5}", one.residual_deg),
                format!("{:.4}", one.left_out_mm),
                format!("{:.5}", one.left_out_deg),
            ]);
        }
        text += &aligned(&rows, style.width);
    }
    text
}
