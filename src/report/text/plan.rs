//! The text of `plan`.

use super::{fixed, scientific};
use crate::report::Style;
use crate::report::layout::{aligned, row};
use crate::task::plan::Plan;

pub(super) fn text(found: &Plan, style: Style) -> String {
    let o = &found.observability;
    let mut out = format!(
        "{} configurations; {:.1} % of random ones meet the constraints\n",
        found.count(),
        100.0 * found.admitted
    );
    out += &format!(
        "O1 {}, condition number {}, rank {}\n",
        fixed(o.o1, 4),
        scientific(o.condition_number),
        o.rank
    );
    let [o2, o3, o4, o5] = [o.o2, o.o3, o.o4, o.o5].map(scientific);
    out += &format!("O2 {o2}, O3 {o3}, O4 {o4}, O5 {o5}\n\n");
    out += &format!(
        "expected standard deviations with {} mm a coordinate\n",
        found.device_sigma_mm
    );
    let mut rows = vec![row(["parameter", "sigma", "unit"])];
    for p in &found.expected_sigma {
        rows.push(vec![
            p.key.clone(),
            format!("{:.3e}", p.sigma),
            p.unit.into(),
        ]);
    }
    out += &aligned(&rows, style.width);
    for p in &found.not_determined {
        out += &format!("not determined: {}\n", p.key);
    }
    if found.poses_between > 0 {
        out += &format!(
            "the program goes over {} poses between that are not measured\n",
            found.poses_between
        );
    }
    out
}
