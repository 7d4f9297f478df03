//! `fk` and `ik`: the models themselves, over tables.

use super::ending::print_table;
use super::files::Files;
use super::progress::Progress;
use super::{Answer, Output};
use crate::task::Failure;
use crate::task::fk::{self, Options, fk_telling};
use crate::task::ik::ik_telling;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Which arm is meant
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Which {
    /// Nominal kinematics with every effect of the calibration
    Real,
    /// What the controller computes with
    Controller,
}

/// Print the tool's poses for joint angles
#[derive(Args)]
pub(super) struct Fk {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Joint angles (CSV with `q1_deg…q6_deg`; optional dir1…dir6, `move1_deg…move6_deg`,
    /// `fx_n,fy_n,fz_n`, `temperature_c`, `time_s`, and `e1_mm`… of a track)
    #[arg(long, value_name = "FILE")]
    joints: PathBuf,
    /// Which arm
    #[arg(long, value_enum, default_value = "real")]
    model: Which,
    /// Tool of the profile (default: its only one)
    #[arg(long, value_name = "NAME")]
    tool: Option<String>,
}

/// Print the joint angles for poses of the tool
#[derive(Args)]
pub(super) struct Ik {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Poses (CSV with `x_mm,y_mm,z_mm,qw,qx,qy,qz` and branch, 0 to 7, or `near1_deg…near6_deg`;
    /// optional columns as of fk)
    #[arg(long, value_name = "FILE")]
    poses: PathBuf,
    /// Which arm
    #[arg(long, value_enum, default_value = "real")]
    model: Which,
    /// Tool of the profile (default: its only one)
    #[arg(long, value_name = "NAME")]
    tool: Option<String>,
    /// Every solution: one a branch, or as many as there are with an offset wrist
    /// (`branch/number`)
    #[arg(long)]
    all: bool,
}

fn options(which: Which, tool: Option<&String>) -> Options {
    Options {
        model: match which {
            Which::Real => fk::Which::Real,
            Which::Controller => fk::Which::Controller,
        },
        tool: tool.cloned(),
    }
}

impl Fk {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let files = Files::default();
        let profile = files.profile(&self.profile)?;
        let options = options(self.model, self.tool.as_ref());
        let progress = Progress::new(output, "reading");
        let joints = files.source(&self.joints)?;
        progress.say("computing poses");
        let mut tell = |done, of| progress.tell(done, of);
        let found = fk_telling(&profile, &joints, &options, &mut tell)?;
        drop(progress);
        print_table(&found, output, Answer::Yes)
    }
}

impl Ik {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let files = Files::default();
        let profile = files.profile(&self.profile)?;
        let options = options(self.model, self.tool.as_ref());
        let progress = Progress::new(output, "reading");
        let poses = files.source(&self.poses)?;
        progress.say("computing joints");
        let mut tell = |done, of| progress.tell(done, of);
        let found = ik_telling(&profile, &poses, &options, self.all, &mut tell)?;
        drop(progress);
        let answer = if found.reached {
            Answer::Yes
        } else {
            Answer::No
        };
        print_table(&found, output, answer)
    }
}
