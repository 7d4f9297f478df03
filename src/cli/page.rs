//! `--report FILE.html`: a page beside what a command tells.

use super::failure::Failure;
use super::files;
use crate::report::html::page::Page;
use clap::Args;
use std::path::{Path, PathBuf};

/// The page that is asked for.
#[derive(Args)]
pub struct ReportFile {
    /// Write a report to look at: one HTML file with views, charts and tables that needs no network
    #[arg(long = "report", value_name = "FILE.html")]
    file: Option<PathBuf>,
}

impl ReportFile {
    /// Whether there is one to write.
    pub fn is_wanted(&self) -> bool {
        self.file.is_some()
    }

    /// Neither the report nor another output may take the place of what is read, nor of one another.
    pub fn refuse_over<'a>(
        &'a self,
        inputs: impl IntoIterator<Item = &'a Path>,
        outputs: impl IntoIterator<Item = &'a Path>,
    ) -> Result<(), Failure> {
        let own = self.file.iter().map(PathBuf::as_path);
        files::refuse_over(inputs, outputs.into_iter().chain(own))
    }

    /// The page as one more output.
    pub fn output(&self, page: Option<&Page>) -> Option<(PathBuf, Vec<u8>)> {
        let file = self.file.as_ref()?;
        Some((file.clone(), page?.html().into_bytes()))
    }

    /// What is told when it is written.
    pub fn told(&self) -> String {
        let told = |file: &PathBuf| format!("report written to {}\n", file.display());
        self.file.as_ref().map_or(String::new(), told)
    }
}
