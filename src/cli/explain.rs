//! `explain`: what a finding means and what to do.

use super::ending::{Ending, finish};
use super::files::Files;
use super::{Answer, Output};
use crate::task::Failure;
use crate::task::explain::explain;
use clap::Args;

/// Explain a finding: what it means and what to do; without an id, every one
#[derive(Args)]
pub(super) struct Explain {
    /// The finding's id, as messages have it in brackets
    id: Option<String>,
}

impl Explain {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let found = explain(self.id.as_deref())?;
        finish(&Files::default(), &found, Ending::default(), output)
    }
}
