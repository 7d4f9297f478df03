//! The text of `compensate`.

use crate::program::Language;
use crate::task::compensate::{Compensated, Summary};

/// The text for people, without the findings.
#[must_use]
pub fn text(found: &Compensated, files: usize, language: &dyn Language) -> String {
    let Summary {
        targets,
        compensated,
        unchanged,
        joint_targets,
        before_mm,
        max_before_mm,
        after_mm,
        mean_shift_mm,
        max_shift_mm,
        max_residual_mm,
        max_rounding_mm,
        max_rounding_deg,
    } = found.summary;
    let mut lines = vec![format!(
        "{files} file(s) of {}, {targets} targets: {compensated} shifted, {unchanged} unchanged",
        language.about().name
    )];
    if joint_targets > 0 {
        lines.push(format!(
            "  {joint_targets} joint targets stay as they are (--joint-targets correct shifts them)"
        ));
    }
    if compensated > 0 {
        lines.push(format!(
            "  real tool off by  mean {:.3} mm, largest {:.3} mm before; mean {:.4} mm, largest {:.4} mm after",
            before_mm,
            max_before_mm,
            after_mm,
            max_rounding_mm
        ));
        lines.push(format!(
            "  shift     mean {:.3} mm, largest {:.3} mm",
            mean_shift_mm, max_shift_mm
        ));
        lines.push(format!(
            "  residual  largest {:.1e} mm (what the search left)",
            max_residual_mm
        ));
        lines.push(format!(
            "  rounding  largest {:.4} mm, {:.4} deg (what the file's decimals cost)",
            max_rounding_mm, max_rounding_deg
        ));
    }
    lines.join("\n") + "\n"
}
