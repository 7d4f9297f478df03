//! What commands that read measurements share.

use super::failure::Failure;
use super::layout::print_findings;
use super::{Output, files};
use crate::finding::Finding;
use crate::identify::IdentifyError;
use crate::identify::measurements::Measurements;
use crate::identify::parameters::Pick;
use crate::program::Source;
use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Files of measurements.
#[derive(Args)]
pub struct MeasurementFiles {
    /// Measurements (CSV); several files are one after another
    #[arg(long, value_name = "FILE", required = true)]
    measurements: Vec<PathBuf>,
}

impl MeasurementFiles {
    /// All rows, and the SHA-256 of each file.
    pub fn read(&self) -> Result<(Measurements, Vec<String>), Failure> {
        let mut all: Option<Measurements> = None;
        let mut hashes = Vec::new();
        for path in &self.measurements {
            let source = Source::new(path.display().to_string(), files::read(path)?);
            let mut read = Measurements::from_csv(&source.bytes).map_err(|error| {
                let length = (error.length > 0).then_some(error.length);
                Failure::at(
                    &source,
                    error.line,
                    error.column,
                    length,
                    error.to_string(),
                    error.hint(),
                )
            })?;
            hashes.push(files::sha256(&source.bytes));
            // rows of several files are told apart by their names and lines
            if self.measurements.len() > 1 {
                let file: Arc<str> = path.display().to_string().into();
                for row in &mut read.rows {
                    row.id = format!("{file}:{}", row.id);
                    row.line.file = Some(Arc::clone(&file));
                }
            }
            match &mut all {
                None => all = Some(read),
                Some(all) => {
                    all.rows.append(&mut read.rows);
                    all.columns.retain(|column| read.columns.contains(column));
                }
            }
        }
        Ok((all.expect("at least one file is required"), hashes))
    }

    /// Where they are.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.measurements.iter().map(PathBuf::as_path)
    }

    /// How reports name them.
    pub fn name(&self) -> String {
        let names: Vec<String> = self
            .measurements
            .iter()
            .map(|p| p.display().to_string())
            .collect();
        names.join(", ")
    }
}

/// A failed identification with its way out.
pub fn identify_failure(name: &str, error: &IdentifyError) -> Failure {
    let several = matches!(error, IdentifyError::Missing { .. }) && name.contains(", ");
    let hint = if several {
        "of several files, each must have the columns that an effect needs".into()
    } else {
        error.hint()
    };
    Failure::with_hint(format!("{name}: {error}"), hint)
}

/// Words of `--identify` and `--fix`.
pub fn picks(option: &str, text: Option<&str>) -> Result<Vec<Pick>, Failure> {
    Pick::parse_list(text.unwrap_or_default())
        .map_err(|error| Failure::with_hint(format!("{option}: {error}"), error.hint()))
}

/// Findings on standard error.
pub fn tell_findings(findings: &[Finding], output: Output) {
    if output.quiet {
        return;
    }
    print_findings(findings, true);
}
