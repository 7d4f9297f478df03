//! The texts of `hexapod`.

use crate::report::Style;
use crate::report::layout::{aligned, row};
use crate::task::hexapod::{Base, Poses, Reach};

pub(super) fn poses(found: &Poses, style: Style) -> String {
    let mut rows = vec![
        row([
            "id", "design", "mode", "x", "y", "z", "rx", "ry", "rz", "sigma",
        ]),
        row(["", "", "", "mm", "mm", "mm", "deg", "deg", "deg", "mm"]),
    ];
    for one in &found.poses {
        let mut cells = vec![one.id.clone(), one.design.clone(), one.mode.to_string()];
        cells.extend(one.pose.xyz_mm().map(|x| format!("{x:.4}")));
        cells.extend(one.pose.rxryrz_deg().map(|r| format!("{r:.4}")));
        cells.push(format!("{:.5}", one.largest_sigma_mm));
        rows.push(cells);
    }
    let mut text = format!(
        "poses in the frame of the base balls; sigma for {} mm a length\n{}",
        found.sigma_mm,
        aligned(&rows, style.width)
    );
    if found.undecided > 0 {
        text += &format!(
            "{} rows have more than one mode: a column mode or a rough pose (x_mm … qz) chooses\n",
            found.undecided
        );
    }
    text
}

/// The frame file is what is printed: it stays one that can be read.
pub(super) fn base(found: &Base, _: Style) -> String {
    found.frame_text.clone()
}

pub(super) fn reach(found: &Reach, style: Style) -> String {
    let mut rows = vec![row(["id", "design", "mode", "postures", "leg error mm"])];
    for r in &found.reach {
        let leg = match r.leg_error_mm {
            None => "out of reach".to_owned(),
            Some(e) if r.measurable => format!("{e:.4}"),
            Some(e) => format!("beyond the ballbar: {e:.4}"),
        };
        rows.push(vec![
            r.id.to_string(),
            r.design.clone(),
            r.mode.to_string(),
            r.postures.len().to_string(),
            leg,
        ]);
    }
    aligned(&rows, style.width)
        + &format!(
            "{} of {} poses are measurable\n",
            found.measurable,
            found.reach.len()
        )
}
