//! The text of `compensate`.

use super::text::left_out as left_out_lines;
use crate::finding::{Finding, Severity};
use crate::program::Language;
use crate::task::compensate::{Compensated, MethodCounts, Summary};

/// The text for people, without the findings.
#[must_use]
pub(crate) fn text(found: &Compensated, language: &dyn Language) -> String {
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
        methods,
        added,
        ref files,
        ref left_out,
    } = found.summary;
    let mut lines = vec![format!(
        "{} file(s) of {}, {targets} targets: {compensated} shifted, {unchanged} unchanged",
        files.written.len() + files.refused.len(),
        language.about().name
    )];
    if joint_targets > 0 {
        lines.push(format!(
            "  {joint_targets} joint targets stay as they are (--joint-targets correct shifts them)"
        ));
    }
    let has = |is_so: &dyn Fn(&Finding) -> bool| found.findings.iter().any(is_so);
    // what else than decimals leaves a target off
    let mut also = String::new();
    if has(&|f| f.accepted && f.id == "target-shared") {
        also += ", and targets that serve several moves";
    }
    if has(&|f| f.id == "at-singularity") {
        also += ", and targets that --at-singularity settled";
    }
    if compensated > 0 {
        lines.push(format!(
            "  real tool off by  mean {before_mm:.3} mm, largest {max_before_mm:.3} mm before; \
             mean {after_mm:.4} mm, largest {max_rounding_mm:.4} mm after"
        ));
        lines.push(format!(
            "  shift     mean {mean_shift_mm:.3} mm, largest {max_shift_mm:.3} mm"
        ));
        lines.push(format!(
            "  residual  largest {max_residual_mm:.1e} mm (of the search)"
        ));
        lines.push(format!(
            "  rounding  largest {max_rounding_mm:.4} mm, {max_rounding_deg:.4} deg (what the \
             file's decimals cost{also})"
        ));
    }
    let MethodCounts { pose_shift, newton } = methods;
    if pose_shift + newton > 0 {
        lines.push(format!(
            "  method    {pose_shift} by pose shift, {newton} by damped Newton"
        ));
    }
    if added > 0 {
        lines.push(format!(
            "  added     {added} targets, between others or for moves that shared one"
        ));
    }
    if !files.written.is_empty() && !files.refused.is_empty() {
        lines.push(format!("  written   {}", files.written.join(", ")));
        let shown = |name: &String| {
            let is_own = |f: &Finding| f.severity == Severity::Error && f.file == *name;
            if found.findings.iter().any(is_own) {
                name.clone()
            } else {
                format!("{name} (shares data or calls with a refused one)")
            }
        };
        let refused: Vec<String> = files.refused.iter().map(shown).collect();
        lines.push(format!("  refused   {}", refused.join(", ")));
    }
    lines.extend(left_out_lines(left_out));
    lines.join("\n") + "\n"
}
