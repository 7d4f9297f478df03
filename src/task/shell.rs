//! `completions` and `man`: texts for shells and readers, as documents.

use super::Document;
use schemars::JsonSchema;
use serde::Serialize;

/// A completion script.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Completions {
    /// The shell that runs it.
    pub shell: String,
    /// Its text.
    pub script: String,
}

impl Document for Completions {
    const KIND: &'static str = "completions/1";
}

/// The manual page.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Manual {
    /// Its text, in roff.
    pub page: String,
}

impl Document for Manual {
    const KIND: &'static str = "manual/1";
}
