//! `simulate`: measurements of the robot that a profile describes.

use super::ending::{Ending, Shown, finish, print_table};
use super::files::Files;
use super::progress::Progress;
use super::{Answer, Output, values};
use crate::geometry::units::{DEG, m_from_mm};
use crate::identify::simulate::{Device, Session};
use crate::printable::name_of;
use crate::task::Failure;
use crate::task::simulate::simulate;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// What the imagined device gives
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Positions
    Position,
    /// Positions and orientations
    Pose,
    /// Distances from the points of --from
    Distance,
}

/// Make measurements of the robot that a profile describes
#[derive(Args)]
pub(super) struct Simulate {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Joint angles (CSV with `q1_deg…q6_deg`; optional dir1…dir6, `fx_n,fy_n,fz_n`,
    /// `temperature_c` and `time_s`)
    #[arg(long, value_name = "FILE")]
    joints: PathBuf,
    /// Measurements to write (CSV); without it they are printed
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Standard deviation of a coordinate or distance
    #[arg(long, value_name = "MM", default_value_t = 0.0)]
    noise_mm: f64,
    /// Standard deviation of an angle about each axis
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    noise_deg: f64,
    /// Seed of the noise
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// What the device gives
    #[arg(long, value_enum, default_value = "position")]
    kind: Kind,
    /// A point that distances are measured from: x,y,z in mm; several in turn
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    from: Vec<String>,
    /// Tool of the profile (default: its only one)
    #[arg(long, value_name = "NAME")]
    tool: Option<String>,
    /// Part of the rows that are wrong, 0 to 1
    #[arg(long, value_name = "PART", default_value_t = 0.0)]
    outliers: f64,
    /// Size of a wrong row's error (default: 10), with --outliers
    #[arg(long, value_name = "MM")]
    outlier_mm: Option<f64>,
    /// Temperature of the first and last row
    #[arg(long, value_name = "C,C", allow_hyphen_values = true)]
    temperature_c: Option<String>,
    /// Seconds from row to row
    #[arg(long, value_name = "S")]
    interval_s: Option<f64>,
}

impl Simulate {
    fn session(&self) -> Result<Session, Failure> {
        let from = self
            .from
            .iter()
            .map(|t| Ok(values::numbers::<3>("--from", t)?.map(m_from_mm)));
        let from: Vec<[f64; 3]> = from.collect::<Result<_, Failure>>()?;
        if (self.kind == Kind::Distance) == from.is_empty() {
            return Err(Failure::new("--kind distance and --from belong together"));
        }
        if self.outliers == 0.0 && self.outlier_mm.is_some_and(f64::is_finite) {
            return Err(Failure::with_hint(
                "--outlier-mm has no effect without --outliers",
                "--outliers says which part of the rows is wrong",
            ));
        }
        Ok(Session {
            device: match self.kind {
                Kind::Position => Device::Position,
                Kind::Pose => Device::Pose,
                Kind::Distance => Device::Distance(from),
            },
            noise_m: m_from_mm(self.noise_mm),
            noise_rad: self.noise_deg * DEG,
            outliers: self.outliers,
            outlier_m: m_from_mm(self.outlier_mm.unwrap_or(10.0)),
            temperature_c: self
                .temperature_c
                .as_deref()
                .map(|t| values::numbers("--temperature-c", t))
                .transpose()?,
            interval_s: self.interval_s,
            seed: self.seed,
        })
    }

    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let session = self.session()?;
        let files = Files::default();
        let profile = files.profile(&self.profile)?;
        let progress = Progress::new(output, "reading");
        let joints = files.source(&self.joints)?;
        files.refuse_over(self.output.as_deref())?;
        progress.say("measuring");
        let mut found = simulate(&profile, &joints, self.tool.as_deref(), &session)?;
        drop(progress);
        let Some(path) = &self.output else {
            return print_table(&found, output, Answer::Yes);
        };
        let csv = found.csv.take().unwrap_or_default();
        found.output = Some(name_of(path));
        let ending = Ending {
            written: vec![(path.clone(), csv.into_bytes().into())],
            shown: Shown::All,
            ..Ending::default()
        };
        finish(&files, &found, ending, output)
    }
}
