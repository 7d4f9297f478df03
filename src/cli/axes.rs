//! `axes`: base and tool from sweeps of single joints.

use super::ending::{Ending, Pendant, ReportFile, Shown, finish};
use super::files::Files;
use super::progress::Progress;
use super::{Answer, Output};
use crate::task::Failure;
use crate::task::axes::axes;
use clap::Args;
use std::path::PathBuf;

/// Find base and tool frames from single-joint sweeps, and axes of positioners (circle fits)
#[derive(Args)]
#[command(
    after_help = "Sweeps: measurements (q1_deg…q6_deg, x_mm,y_mm,z_mm, optional qw,qx,qy,qz and \
        dir1…dir6) with a column \
sweep, 1 to 6: the joint that moves in this row's sweep. Joints 1 and 2 give the base, 5 and 6 the \
    tool. With e1, e2, … in it and columns e1_deg, e2_deg, …: a reflector on the plate of a \
    positioner of the profile, while that axis moves."
)]
pub(super) struct Axes {
    /// Measurements while one joint at a time moved
    #[arg(value_name = "SWEEPS.csv")]
    sweeps: PathBuf,
    /// Robot profile (YAML): the nominal arm
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Rows with this name in the column `point` only
    #[arg(long, value_name = "NAME")]
    point: Option<String>,
    #[command(flatten)]
    pendant: Pendant,
    #[command(flatten)]
    report: ReportFile,
}

impl Axes {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let files = Files::default();
        let profile = files.profile(&self.profile)?;
        let progress = Progress::new(output, "reading");
        let sweeps = files.source(&self.sweeps)?;
        self.report.refuse_over(&files, [])?;
        progress.say("fitting");
        let found = axes(&profile, &sweeps, self.point.as_deref())?;
        let ending = Ending {
            report: Some(&self.report),
            pendant: self.pendant,
            shown: Shown::All,
            progress: Some(progress),
            ..Ending::default()
        };
        finish(&files, &found, ending, output)
    }
}
