//! What is done, but should be looked at, and the [table](TABLE) of all that there is to find.
//!
//! # Example
//!
//! ```
//! use poseshift_programs::finding::{Acceptance, kind};
//!
//! let shared = kind("target-shared").expect("a finding of the table");
//! println!("{}: {}", shared.meaning, shared.remedy);
//! assert!("target-shared:Deburr.mod:12".parse::<Acceptance>().is_ok());
//! assert!("out-of-reach".parse::<Acceptance>().is_err());
//! ```

mod accept;
mod table;

pub use accept::{Acceptance, AcceptanceError, accept, accept_errors};
pub use table::{Kind, TABLE, kind};

use schemars::JsonSchema;
use serde::Serialize;

/// How much a [`Finding`] matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Worth knowing.
    Note,
    /// Look at it before the file is downloaded.
    Warning,
    /// The answer is no: no program is written (exit status 1).
    Error,
}

/// Something in a program that a person should look at.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, JsonSchema)]
#[serde(into = "Written")]
pub struct Finding {
    /// Stable name in kebab-case.
    pub id: &'static str,
    /// How much it matters.
    pub severity: Severity,
    /// The file as the user named it.
    pub file: String,
    /// Line, from 1; 0 where the finding concerns the whole file.
    pub line: usize,
    /// Column in bytes, from 1; 0 where the finding concerns the whole file.
    pub column: usize,
    /// What was found, with the value and the limit.
    pub message: String,
    /// The way out; empty where there is none.
    pub hint: String,
    /// It was an error, and the user takes it: `--accept`.
    pub accepted: bool,
}

/// A finding as reports have it.
#[derive(Serialize, JsonSchema)]
struct Written {
    /// Stable name in kebab-case.
    id: &'static str,
    /// How much it matters.
    severity: Severity,
    /// The file as the user named it.
    file: String,
    /// Line, from 1; 0 where the finding concerns the whole file.
    line: usize,
    /// Column in bytes, from 1; 0 where the finding concerns the whole file.
    column: usize,
    /// What was found, with the value and the limit.
    message: String,
    /// The way out; empty where there is none.
    hint: String,
    /// It was an error, and the user takes it.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    accepted: bool,
    /// What it was called in earlier versions.
    #[serde(skip_serializing_if = "<[_]>::is_empty", default)]
    was: &'static [&'static str],
}

impl From<Finding> for Written {
    fn from(finding: Finding) -> Self {
        Self {
            id: finding.id,
            severity: finding.severity,
            file: finding.file,
            line: finding.line,
            column: finding.column,
            message: finding.message,
            hint: finding.hint,
            accepted: finding.accepted,
            was: kind(finding.id).map_or(&[], |kind| kind.was),
        }
    }
}

impl Finding {
    /// A finding of a whole file, without a hint.
    pub fn of_file(
        id: &'static str,
        severity: Severity,
        file: &str,
        message: impl Into<String>,
    ) -> Self {
        Self {
            id,
            severity,
            file: file.into(),
            line: 0,
            column: 0,
            message: message.into(),
            hint: String::new(),
            accepted: false,
        }
    }

    /// With the way out.
    #[must_use]
    pub fn hint(self, hint: impl Into<String>) -> Self {
        Self {
            hint: hint.into(),
            ..self
        }
    }
}
