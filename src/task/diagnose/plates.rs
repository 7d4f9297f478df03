//! Points on the plates of positioners, which show nothing of the arm.

use super::FoundEffect;
use crate::diagnose::plates::PlateDiagnosis;
use crate::diagnose::{Options, Verdict};
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::identify::IdentifyError;
use crate::identify::measurements::Measurements;
use crate::identify::pick::Pick;
use crate::task::failure::Failure;
use crate::task::parts::{SpreadMm, finite};
use schemars::JsonSchema;
use serde::Serialize;

/// What was found of a positioner.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct PositionerDiagnosis {
    /// Its name.
    pub positioner: String,
    /// `explained`, `improved`, `nothing_missing` or `undetermined`.
    pub verdict: &'static str,
    /// Why, one sentence each.
    pub reasons: Vec<String>,
    /// Rows of points on its plate.
    pub rows: usize,
    /// At how many stops of its axes.
    pub stops: usize,
    /// Effects, those first without which most is lost.
    pub effects: Vec<FoundEffect>,
    /// Errors at stops that were left out in turn, of the present model.
    pub before: Option<SpreadMm>,
    /// With the effects found.
    pub after: Option<SpreadMm>,
    /// Noise of a coordinate.
    pub noise_mm: Option<f64>,
    /// The residual of a coordinate.
    pub left_mm: Option<f64>,
    /// The same as the engine has it.
    #[serde(skip)]
    pub answer: Verdict,
}

impl From<&PlateDiagnosis> for PositionerDiagnosis {
    fn from(found: &PlateDiagnosis) -> Self {
        Self {
            positioner: found.positioner.clone(),
            verdict: found.verdict.id(),
            reasons: found.reasons.clone(),
            rows: found.rows,
            stops: found.stops,
            effects: found.found.iter().map(Into::into).collect(),
            before: found.held_out.map(|(before, _)| before.into()),
            after: found.held_out.map(|(_, after)| after.into()),
            noise_mm: finite(mm_from_m(found.noise_m)),
            left_mm: finite(mm_from_m(found.residual_m)),
            answer: found.verdict,
        }
    }
}

/// Rows of points on plates that tell nothing, and why.
pub(super) fn left_out(plates: &Measurements, why: &IdentifyError, name: &str) -> Finding {
    let first = plates.rows.first().map(|row| row.line.to_string());
    let message = format!(
        "{} rows of points on plates, from {} on, are left out: {why}",
        plates.rows.len(),
        first.unwrap_or_default()
    );
    let hint = why.hint();
    Finding::of_file("plate-rows-left-out", Severity::Note, name, message).hint(hint)
}

/// Rows of the tool, and those of points on plates.
///
/// # Errors
/// There are none of the tool.
pub(in crate::task) fn of_the_arm(
    all: Measurements,
    name: &str,
) -> Result<(Measurements, Measurements), Failure> {
    let (tool, plates) = all.split();
    if tool.rows.is_empty() {
        return Err(Failure::with_hint(
            format!("{name}: every row is of a point on a plate, which shows nothing of the arm"),
            "`poseshift calibrate` identifies the positioner with them",
        ));
    }
    Ok((tool, plates))
}

/// What a person asked for of the arm.
pub(super) fn of_arm(options: &Options) -> Options {
    let mut own = options.clone();
    let of_positioner = |pick: &Pick| pick.kind.is_some_and(|k| k.definition().of_positioner());
    own.accept.retain(|pick| !of_positioner(pick));
    own
}
