//! Several files of measurements as one.

use super::failure::Failure;
use crate::identify::IdentifyError;
use crate::identify::measurements::Measurements;
use crate::program::Source;
use crate::program::sha256;
use std::sync::Arc;

/// Rows of one or several files, in their order.
#[derive(Clone, Debug)]
pub struct Rows {
    /// The rows.
    pub all: Measurements,
    /// How reports name the files.
    pub name: String,
    /// SHA-256 of each file.
    pub sha256: Vec<String>,
}

impl Rows {
    /// Reads the files; rows of several are told apart by their names and lines.
    ///
    /// # Errors
    /// A row that is no measurement, with line and column; no file.
    pub fn read(sources: &[Source]) -> Result<Self, Failure> {
        let mut all: Option<Measurements> = None;
        for source in sources {
            let mut read = Measurements::from_csv(&source.bytes).map_err(|error| {
                let length = (error.length > 0).then_some(error.length);
                let message = error.to_string();
                Failure::at(
                    source,
                    error.line,
                    error.column,
                    length,
                    message,
                    error.hint(),
                )
            })?;
            if sources.len() > 1 {
                let file: Arc<str> = source.name.as_str().into();
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
        let names: Vec<&str> = sources.iter().map(|source| source.name.as_str()).collect();
        Ok(Self {
            all: all.ok_or_else(|| Failure::new("no file of measurements"))?,
            name: names.join(", "),
            sha256: sources.iter().map(|source| sha256(&source.bytes)).collect(),
        })
    }
}

/// A failed identification with its way out.
pub(super) fn identify_failure(name: &str, error: &IdentifyError) -> Failure {
    let several = matches!(error, IdentifyError::Missing { .. }) && name.contains(", ");
    let hint = if several {
        "of several files, each must have the columns that an effect needs".into()
    } else {
        error.hint()
    };
    Failure::with_hint(format!("{name}: {error}"), hint)
}
