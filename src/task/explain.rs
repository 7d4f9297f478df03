//! `explain`: what a finding means and what to do.

use super::Document;
use super::failure::Failure;
use crate::finding::{Kind, Severity, TABLE, kind};
use crate::nearest;
use schemars::JsonSchema;
use serde::Serialize;

/// What a finding means.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Explanation {
    /// Its id.
    pub id: &'static str,
    /// How much it usually matters.
    pub severity: Severity,
    /// What it means.
    pub meaning: &'static str,
    /// What to do.
    pub remedy: &'static str,
    /// The commands that find it.
    pub commands: &'static [&'static str],
    /// The languages in whose programs it is found; none where it is not a matter of the language.
    pub languages: &'static [&'static str],
    /// What it was called in earlier versions.
    pub was: &'static [&'static str],
    /// Whether `--accept` takes it.
    pub acceptable: bool,
}

impl From<&Kind> for Explanation {
    fn from(kind: &Kind) -> Self {
        Self {
            id: kind.id,
            severity: kind.severity,
            meaning: kind.meaning,
            remedy: kind.remedy,
            commands: kind.commands,
            languages: kind.languages,
            was: kind.was,
            acceptable: kind.severity == Severity::Error && !kind.never_accepted,
        }
    }
}

/// What findings mean.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Explanations {
    /// By id.
    pub findings: Vec<Explanation>,
}

impl Document for Explanations {
    const KIND: &'static str = "findings/1";
}

/// What the finding of this id means; without an id, what every finding means.
///
/// # Errors
/// No finding has this id.
pub fn explain(id: Option<&str>) -> Result<Explanations, Failure> {
    let Some(id) = id else {
        return Ok(Explanations {
            findings: TABLE.iter().map(Into::into).collect(),
        });
    };
    let found = kind(id).ok_or_else(|| {
        let ids = TABLE.iter().map(|kind| kind.id);
        Failure::with_hint(
            format!("no finding is called `{id}`"),
            nearest::hint(id, "findings", ids) + " (`poseshift explain` lists them)",
        )
    })?;
    Ok(Explanations {
        findings: vec![found.into()],
    })
}
