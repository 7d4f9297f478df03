//! `validate`: what a profile is worth on measurements it has not seen.

use super::files::Files;
use super::measurements::MeasurementFiles;
use super::progress::Progress;
use super::telling::{Ending, ReportFile, Told, finish};
use super::{Answer, Output};
use crate::task::Failure;
use crate::task::validate::{Options, validate};
use clap::Args;
use std::path::PathBuf;

/// Print the errors of a profile's models on measurements
#[derive(Args)]
pub(super) struct Validate {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    #[command(flatten)]
    measurements: MeasurementFiles,
    /// Fit base, tool and points first, to the rows not marked for `validate` where there are both, else to those judged: the
    /// device or the tool was set up anew
    #[arg(long)]
    refit_frames: bool,
    /// Identify the profile's effects again without each of so many parts of the configurations
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(2..=1000))]
    folds: Option<u32>,
    /// Use rows of every set, not only those for `validate`
    #[arg(long)]
    all_sets: bool,
    #[command(flatten)]
    report: ReportFile,
}

impl Validate {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let files = Files::default();
        let profile = files.profile(&self.profile)?;
        let options = Options {
            refit_frames: self.refit_frames,
            folds: self.folds.map(|n| n as usize),
            all_sets: self.all_sets,
        };
        let measurements = self.measurements.read(&files, &profile)?;
        self.report.refuse_over(&files, [])?;
        let progress = Progress::new(output, "validating");
        let found = validate(&profile, measurements, &options, &mut |done, of| {
            progress.tell(done, of);
        })?;
        drop(progress);
        let ending = Ending {
            report: Some(&self.report),
            told: Told::All,
            ..Ending::default()
        };
        finish(&files, &found, ending, output)
    }
}
