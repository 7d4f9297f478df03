//! What commands that read measurements share.

use super::files::Files;
use crate::identify::parameters::{Level, Pick};
use crate::task::{Failure, Rows};
use clap::Args;
use std::path::{Path, PathBuf};

/// Files of measurements.
#[derive(Args)]
pub(super) struct MeasurementFiles {
    /// Measurements (CSV); several files are one after another
    #[arg(long, value_name = "FILE", required = true)]
    measurements: Vec<PathBuf>,
}

impl MeasurementFiles {
    /// All rows.
    pub(super) fn read(&self, files: &Files) -> Result<Rows, Failure> {
        let sources = self.paths().map(|path| files.source(path));
        Rows::read(&sources.collect::<Result<Vec<_>, _>>()?)
    }

    /// Where they are.
    pub(super) fn paths(&self) -> impl Iterator<Item = &Path> {
        self.measurements.iter().map(PathBuf::as_path)
    }
}

/// Words of `--identify` and `--fix`.
pub(super) fn picks(option: &str, text: Option<&str>) -> Result<Vec<Pick>, Failure> {
    Pick::parse_list(text.unwrap_or_default())
        .map_err(|error| Failure::with_hint(format!("{option}: {error}"), error.hint()))
}

/// What `--level` means.
pub(super) fn level(number: u8) -> Level {
    match number {
        0 => Level::Frames,
        1 => Level::Joints,
        2 => Level::Geometry,
        _ => Level::Compliance,
    }
}
