//! What can keep an identification from its answer.

use super::line::Line;
use crate::nearest;

/// A word that names no parameter.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SelectionError {
    /// No effect has this name.
    #[error("no effect is called `{id}`")]
    UnknownEffect {
        /// The name.
        id: String,
    },
    /// The effect has no such parameter.
    #[error("`{id}` has no parameter `{key}`")]
    UnknownKey {
        /// The effect.
        id: &'static str,
        /// The key.
        key: String,
    },
    /// A place the effect cannot have.
    #[error("`{found}` behind `{id}`: expected {expected}")]
    BadPlace {
        /// The effect.
        id: &'static str,
        /// What stands there.
        found: String,
        /// What belongs there.
        expected: String,
    },
}

impl SelectionError {
    /// The way out.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::UnknownEffect { id } => nearest::hint(id, "names", super::pick::words()),
            _ => "`poseshift effects` lists every effect with its parameters; write \
                joint_compliance:2-6 or link_geometry:3.beta_deg"
                .into(),
        }
    }
}

fn listed(names: &[String]) -> String {
    match names {
        [] => "none".into(),
        names => names.join(", "),
    }
}

/// A point is of no arm that is this many times farther from the middle of all points than half of
/// them are.
pub(super) const FAR_OFF: f64 = 100.0;

/// Why nothing was identified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum IdentifyError {
    /// A row's tool is not in the profile.
    #[error("{line}: the profile has no tool `{tool}`; it has {}", listed(known))]
    UnknownTool {
        /// Which row.
        line: Line,
        /// The name.
        tool: String,
        /// Those it has.
        known: Vec<String>,
    },
    /// Rows without a tool, and several to choose from.
    #[error("{line}: no tool is named and the profile has {}: {}", known.len(), known.join(", "))]
    AmbiguousTool {
        /// Which row.
        line: Line,
        /// Those it has.
        known: Vec<String>,
    },
    /// Rows for this purpose are missing.
    #[error("no rows to identify with: every row is for `validate`")]
    NothingToFit,
    /// Fewer numbers than parameters.
    #[error("{numbers} measured numbers in {rows} rows are too few for {parameters} parameters")]
    TooFew {
        /// Measured numbers.
        numbers: usize,
        /// Rows.
        rows: usize,
        /// Parameters asked for.
        parameters: usize,
    },
    /// The measurements contradict the format or the robot, by evidence.
    #[error("{message}")]
    Suspicious {
        /// What is wrong, with the evidence.
        message: String,
        /// The way out.
        hint: String,
    },
    /// A point far from all others.
    #[error(
        "{line}: the point is {away_mm:.0} mm from the middle of the others, of which half are \
         within {half_mm:.0} mm; the limit is {FAR_OFF} times as far"
    )]
    FarOff {
        /// Which row.
        line: Line,
        /// How far, mm.
        away_mm: f64,
        /// How far half of the points are at most, mm.
        half_mm: f64,
    },
    /// The model of the arm gives no finite numbers.
    #[error("{line}: the model of the arm gives no finite pose or torques there")]
    NotFinite {
        /// The first such row.
        line: Line,
    },
    /// The place of the base does not follow from the measurements.
    #[error("where the base stands does not follow from the measurements: {reason}")]
    NoStart {
        /// Why.
        reason: String,
    },
    /// An effect needs what the measurements or the profile do not have.
    #[error("`{id}` cannot be identified: it needs {need}")]
    Missing {
        /// The effect.
        id: &'static str,
        /// What it needs.
        need: &'static str,
    },
    /// A touched feature that its touches do not tell.
    #[error("{line}: feature `{feature}`: {reason}")]
    Feature {
        /// Its first row.
        line: Line,
        /// Its name.
        feature: String,
        /// Why.
        reason: String,
    },
    /// No parameter is left.
    #[error("no parameter is left to identify")]
    NoParameters,
    /// The iteration did not come to rest.
    #[error(
        "not solved after {passes} passes: the last step was {step:.2e} of the typical size, the \
         limit is {limit:.0e}"
    )]
    NotConverged {
        /// Passes over the data.
        passes: usize,
        /// Largest step, in the parameters' typical sizes.
        step: f64,
        /// The limit.
        limit: f64,
    },
}

impl IdentifyError {
    /// The way out; empty where the message says it all.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::UnknownTool { tool, known, .. } if known.is_empty() => {
                format!(
                    "write it under `tools` of the profile: `{tool}: {{frame: {{x_mm: …, \
                    rz_deg: …}}}}`; or leave the column tool out and points are on the flange"
                )
            }
            Self::UnknownTool { tool, known, .. } => nearest::hint(
                tool,
                "tools of the profile",
                known.iter().map(String::as_str),
            ),
            Self::AmbiguousTool { .. } => "add a column tool".into(),
            Self::TooFew { .. } => "measure more configurations, or identify less: a lower \
                --level of `poseshift calibrate`, or its --fix"
                .into(),
            Self::Suspicious { hint, .. } => hint.clone(),
            Self::FarOff { .. } => "is a decimal point lost, or is the row in another unit? \
                correct it or leave it out"
                .into(),
            Self::NotFinite { .. } => "look for a number out of all bounds in the effects, masses \
                and frames of the profile and in the tool"
                .into(),
            Self::NoStart { .. } => {
                "measure at least 5 configurations in which every joint moves; \
                or give the base in the profile"
                    .into()
            }
            Self::Feature { .. } => "touch it more often and farther apart, or give its numbers: \
                cx_mm,cy_mm,cz_mm, radius_mm, nx,ny,nz"
                .into(),
            Self::NotConverged { .. } => "identify less (`poseshift calibrate --level 1` first), \
                or look at the rows with the largest residuals"
                .into(),
            _ => String::new(),
        }
    }
}
