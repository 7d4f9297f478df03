//! `validate`: what a profile is worth on measurements it has not seen.

use super::ending::{Ending, ReportFile, Shown, finish};
use super::files::Files;
use super::measurements::{MeasurementFiles, level};
use super::progress::Progress;
use super::{Answer, Output};
use crate::identify::validation::Folds;
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
    /// Fit base, tool and points first, to the rows not marked for `validate` where there are
    /// both, else to those judged: the device or the tool was set up anew
    #[arg(long)]
    refit_frames: bool,
    /// Identify the profile's effects again without each of so many parts of the configurations
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(2..=1000))]
    folds: Option<u32>,
    /// Identify so much of the arm in each of the --folds, as `calibrate` does: 0 frames alone; 1
    /// and joint offsets and scales; 2 and link geometry; 3 and joint compliance
    #[arg(long, value_name = "0..3", requires = "folds", value_parser = clap::value_parser!(u8).range(0..=3))]
    level: Option<u8>,
    /// Count each effect's typical size as one more measurement in each of the --folds
    #[arg(long, requires = "folds")]
    priors: bool,
    /// Use rows of every set, not only those for `validate`
    #[arg(long)]
    all_sets: bool,
    /// Say whether the arm errs as it did when it was calibrated (`as calibrated` or `measure
    /// again`), and what would have been seen: ten poses are enough
    #[arg(long)]
    as_calibrated: bool,
    #[command(flatten)]
    report: ReportFile,
}

impl Validate {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let files = Files::default();
        let profile = files.profile(&self.profile)?;
        let options = Options {
            refit_frames: self.refit_frames,
            folds: self.folds.map(|count| Folds {
                count: count as usize,
                level: self.level.map(level),
                priors: self.priors,
            }),
            all_sets: self.all_sets,
            as_calibrated: self.as_calibrated,
        };
        let progress = Progress::new(output, "reading");
        let measurements = self.measurements.read(&files, &profile)?;
        self.report.refuse_over(&files, [])?;
        progress.say("validating");
        let found = validate(&profile, measurements, &options, &mut |done, of| {
            progress.tell(done, of);
        })?;
        let ending = Ending {
            report: Some(&self.report),
            shown: Shown::All,
            answer: match &found.as_calibrated {
                Some(standing) if !standing.is_so() => Answer::No,
                _ => Answer::Yes,
            },
            progress: Some(progress),
            ..Ending::default()
        };
        finish(&files, &found, ending, output)
    }
}
