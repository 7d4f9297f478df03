//! `calibrate`: measurements to a profile.

use super::ending::{Ending, Pendant, ReportFile, Shown, finish};
use super::files::Files;
use super::measurements::{MeasurementFiles, level, picks};
use super::progress::Progress;
use super::{Answer, Output};
use crate::identify::base::BasePolicy;
use crate::identify::calibration::Options;
use crate::identify::parameters::Selection;
use crate::identify::robust::Shape;
use crate::printable::name_of;
use crate::task::Failure;
use crate::task::calibrate::calibrate;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Loss of a residual
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum LossName {
    /// Its square
    Squares,
    /// Its square, in proportion to it beyond 3 standard deviations
    Huber,
    /// Rows far beyond do not count at all
    Tukey,
}

impl LossName {
    /// The shape of this name.
    pub(super) const fn shape(self) -> Shape {
        match self {
            Self::Squares => Shape::Squares,
            Self::Huber => Shape::Huber,
            Self::Tukey => Shape::Tukey,
        }
    }
}

/// What becomes of the measured place of the base
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BaseName {
    /// The base is where the controller has it: where the device stands is identified apart, as
    /// `world_from_device`
    Controller,
    /// `profile` where they are within 20 mm and 1 deg, else `device`
    Auto,
    /// It replaces the profile's base: the world is the device's frame
    Device,
    /// The profile's base stays: the difference is the effect `base_frame`
    Profile,
}

/// Identify a robot's effects from measurements
#[derive(Args)]
pub(super) struct Calibrate {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    #[command(flatten)]
    measurements: MeasurementFiles,
    /// Calibrated profile to write (YAML)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// 0 frames alone; 1 and joint offsets and scales; 2 and link geometry; 3 and joint compliance
    #[arg(long, value_name = "0..3", value_parser = clap::value_parser!(u8).range(0..=3))]
    level: Option<u8>,
    /// Identify these effects, with --level as well as that, else with base and tool alone:
    /// `joint_compliance:2-6,joint_harmonic:6:1`
    #[arg(long, value_name = "LIST")]
    identify: Option<String>,
    /// Leave these as they are: `tool_frame,link_geometry:6.theta_deg`
    #[arg(long, value_name = "LIST")]
    fix: Option<String>,
    /// Count each effect's typical size as one more measurement
    #[arg(long)]
    priors: bool,
    /// How residuals count
    #[arg(long, value_enum, default_value = "huber")]
    loss: LossName,
    /// What becomes of the measured place of the base
    #[arg(long, value_enum, default_value = "controller")]
    base: BaseName,
    /// Date for the profile's provenance, as you write it
    #[arg(long, value_name = "TEXT")]
    date: Option<String>,
    #[command(flatten)]
    pendant: Pendant,
    #[command(flatten)]
    report: ReportFile,
}

impl Calibrate {
    fn options(&self) -> Result<Options, Failure> {
        let identify = picks("--identify", self.identify.as_deref())?;
        if self.identify.is_some() && identify.is_empty() {
            let hint = "`poseshift effects` lists them; without --identify the --level says which";
            return Err(Failure::with_hint("--identify names no effect", hint));
        }
        // a list without a level is meant alone
        let alone = if self.identify.is_some() { 0 } else { 3 };
        let level = level(self.level.unwrap_or(alone));
        Ok(Options {
            selection: Selection {
                level,
                identify,
                fix: picks("--fix", self.fix.as_deref())?,
                priors: self.priors,
            },
            shape: self.loss.shape(),
            base: match self.base {
                BaseName::Controller => BasePolicy::Controller,
                BaseName::Auto => BasePolicy::Nearest,
                BaseName::Device => BasePolicy::Device,
                BaseName::Profile => BasePolicy::Profile,
            },
        })
    }

    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let options = self.options()?;
        let files = Files::default();
        let profile = files.profile(&self.profile)?;
        let progress = Progress::new(output, "reading");
        let measurements = self.measurements.read(&files, &profile)?;
        self.report.refuse_over(&files, self.output.as_deref())?;
        progress.say("identifying");
        let mut found = calibrate(&profile, measurements, &options, &mut || ())?;
        let (mut written, mut also) = (Vec::new(), String::new());
        if let Some(path) = &self.output {
            let text = found.profile_text(&profile, self.date.as_deref())?;
            written.push((path.clone(), text.into_bytes().into()));
            also = format!("\nwritten to {}\n", name_of(path));
            found.output = Some(name_of(path));
        }
        let ending = Ending {
            written,
            report: Some(&self.report),
            shown: Shown::All,
            also: &also,
            answer: Answer::Yes,
            pendant: self.pendant,
            progress: Some(progress),
        };
        finish(&files, &found, ending, output)
    }
}
