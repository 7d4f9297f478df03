//! `handeye`: where a camera is.

use super::ending::{Ending, Pendant, ReportFile, finish};
use super::files::Files;
use super::progress::Progress;
use super::{Answer, Output};
use crate::register::handeye::Setup;
use crate::task::Failure;
use crate::task::handeye::{Inputs, handeye};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Find a camera's pose from robot and board poses (AX = XB)
#[derive(Args)]
#[command(
    after_help = "ROBOT: poses base_from_flange (x_mm,y_mm,z_mm,qw,qx,qy,qz), or joints \
        q1_deg…q6_deg with --profile: then the \
calibrated model says where the flange is, in the controller's world as fk has it. BOARD: poses camera_from_board, row by row.\nCorners: \
    x_mm,y_mm,z_mm as touched by \
the robot, in the frame of ROBOT, cx_mm,cy_mm,cz_mm as seen by the camera; eye in hand also row, the row of \
    ROBOT from which it was seen."
)]
pub(super) struct Handeye {
    /// Robot poses, or joints with --profile
    #[arg(value_name = "ROBOT.csv")]
    robot: PathBuf,
    /// Board poses in the camera
    #[arg(value_name = "BOARD.csv")]
    board: PathBuf,
    /// Where the camera is mounted
    #[arg(long, value_enum)]
    setup: SetupArg,
    /// Robot profile (YAML) for joints
    #[arg(long, value_name = "FILE")]
    profile: Option<PathBuf>,
    /// Tool whose load the arm carried (with --profile; default: its only one)
    #[arg(long, value_name = "NAME", requires = "profile")]
    tool: Option<String>,
    /// Corners seen by the camera and touched by the robot: refine the camera's pose if left-out
    /// corners improve
    #[arg(long, value_name = "CORNERS.csv")]
    corners: Option<PathBuf>,
    /// Write the camera's pose as a frame file
    #[arg(short, long, value_name = "FRAME.yaml")]
    output: Option<PathBuf>,
    #[command(flatten)]
    pendant: Pendant,
    #[command(flatten)]
    report: ReportFile,
}

/// Where the camera is mounted
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SetupArg {
    /// The camera stands in the cell, the board is on the flange
    EyeToHand,
    /// The camera is on the flange, the board stands in the cell
    EyeInHand,
}

impl Handeye {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let files = Files::default();
        let profile = self.profile.as_deref();
        let profile = profile.map(|path| files.profile(path)).transpose()?;
        let progress = Progress::new(output, "reading");
        let corners = self.corners.as_deref();
        let corners = corners.map(|path| files.source(path)).transpose()?;
        let inputs = Inputs {
            robot: &files.source(&self.robot)?,
            board: &files.source(&self.board)?,
            profile: profile.as_ref(),
            tool: self.tool.as_deref(),
            corners: corners.as_ref(),
        };
        self.report.refuse_over(&files, self.output.as_deref())?;
        let setup = match self.setup {
            SetupArg::EyeToHand => Setup::EyeToHand,
            SetupArg::EyeInHand => Setup::EyeInHand,
        };
        progress.say("solving");
        let found = handeye(&inputs, setup)?;
        let frame = self.output.iter().map(|path| {
            let text = found.frame_text.clone();
            (path.clone(), text.into_bytes().into())
        });
        let ending = Ending {
            written: frame.collect(),
            report: Some(&self.report),
            pendant: self.pendant,
            progress: Some(progress),
            ..Ending::default()
        };
        finish(&files, &found, ending, output)
    }
}
