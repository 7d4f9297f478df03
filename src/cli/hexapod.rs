//! `hexapod`: ballbar lengths to poses with uncertainty, the base frame, and the poses that a robot
//! can measure.

use super::ending::{Ending, ReportFile, Said, Shown, deliver, findings, finish};
use super::files::{Files, is_standard_output};
use super::progress::Progress;
use super::{Answer, Output, values};
use crate::geometry::Pose;
use crate::geometry::units::m_from_mm;
use crate::register::hexapod::Device;
use crate::report::Report;
use crate::task::hexapod::{base, measurable_poses, poses};
use crate::task::{Failure, frame};
use clap::Args;
use std::path::{Path, PathBuf};

/// Turn ballbar lengths into tool poses with uncertainty
#[derive(Args)]
#[command(
    after_help = "LENGTHS: design (e.g. 123/123), b12_mm, b23_mm, b31_mm, t12_mm, t23_mm, t31_mm, \
        r11_mm, r21_mm, r31_mm, \
r12_mm, r22_mm, r23_mm; optional mode (1 to 4) or a rough pose x_mm, y_mm, z_mm, qw, qx, qy, qz; \
    q1_deg…q6_deg for -o.\nWith --taught: three points \
and --base-mm give the frame of the base balls. With --reach: the 72 measurable poses and the \
    joints that go there."
)]
pub(super) struct Hexapod {
    /// Lengths, one setting a row
    #[arg(value_name = "LENGTHS.csv", required_unless_present_any = ["taught", "reach"])]
    lengths: Option<PathBuf>,
    /// Standard deviation of every length, for uncertainties in mm and degrees
    #[arg(long, value_name = "MM", default_value_t = 0.001)]
    sigma_mm: f64,
    /// Where the base balls stand in the world: a frame file
    #[arg(long, value_name = "FRAME.yaml")]
    frame: Option<PathBuf>,
    /// Write measurements for `calibrate` (rows with joints), the frame file (--taught), or joints
    /// (--reach)
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// The base balls B1 B2 B3 as the robot was taught them (points): find their frame
    #[arg(long, value_name = "POINTS.csv", requires = "base_mm", conflicts_with_all = ["lengths", "reach"])]
    taught: Option<PathBuf>,
    /// List the measurable poses and whether the robot of --profile reaches them
    #[arg(long, requires_all = ["base_mm", "tool_mm", "profile", "frame"], conflicts_with = "lengths")]
    reach: bool,
    /// Exact distances B1B2,B2B3,B3B1
    #[arg(long, value_name = "B12,B23,B31", allow_hyphen_values = true)]
    base_mm: Option<String>,
    /// Exact distances T1T2,T2T3,T3T1
    #[arg(long, value_name = "T12,T23,T31", allow_hyphen_values = true)]
    tool_mm: Option<String>,
    /// Nominal length of the ballbar
    #[arg(long, value_name = "MM", default_value_t = 300.0)]
    leg_mm: f64,
    /// The ballbar measures so far to each side of it
    #[arg(long, value_name = "MM", default_value_t = 1.0)]
    range_mm: f64,
    /// Robot profile (YAML), for --reach
    #[arg(long, value_name = "FILE")]
    profile: Option<PathBuf>,
    /// Tool of the profile whose frame is that of the tool balls: origin T1, x to T2, T3 in the xy
    /// plane
    #[arg(long, value_name = "NAME")]
    tool: Option<String>,
    #[command(flatten)]
    report: ReportFile,
}

impl Hexapod {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        if !(self.sigma_mm.is_finite() && self.sigma_mm >= 0.0) {
            return Err(Failure::new(format!(
                "--sigma-mm {}: it must be 0 or more",
                self.sigma_mm
            )));
        }
        let files = Files::default();
        let progress = Progress::new(output, "reading");
        if let Some(path) = &self.taught {
            return self.set_base(&files, path, progress, output);
        }
        if self.reach {
            return self.list(&files, progress, output);
        }
        let path = self.lengths.as_ref();
        let path = path.expect("clap asks for LENGTHS where nothing else is asked");
        let lengths = files.source(path)?;
        progress.say("solving");
        let found = poses(&lengths, m_from_mm(self.sigma_mm))?;
        let measurements = self.output.as_ref().map(|_| {
            let world_from_base = match &self.frame {
                Some(path) => frame(&files.source(path)?)?.to_from_from,
                None => Pose::identity(),
            };
            found.measurements(&world_from_base)
        });
        self.finish(&files, &found, measurements.transpose()?, progress, output)
    }

    /// Tells a result; `text` is what is written to the output.
    fn finish(
        &self,
        files: &Files,
        found: &impl Report,
        text: Option<String>,
        progress: Progress,
        output: Output,
    ) -> Result<Answer, Failure> {
        let written = self
            .output
            .iter()
            .cloned()
            .zip(text.map(|text| text.into_bytes().into()));
        let ending = Ending {
            written: written.collect(),
            report: Some(&self.report),
            progress: Some(progress),
            ..Ending::default()
        };
        finish(files, found, ending, output)
    }

    fn set_base(
        &self,
        files: &Files,
        path: &Path,
        progress: Progress,
        output: Output,
    ) -> Result<Answer, Failure> {
        let base_m = three("--base-mm", self.base_mm.as_deref())?;
        let found = base(&files.source(path)?, base_m)?;
        if output.json {
            let text = Some(found.frame_text.clone());
            return self.finish(files, &found, text, progress, output);
        }
        let text = found.frame_text.clone().into_bytes();
        let written = self
            .output
            .iter()
            .map(|path| (path.clone(), text.clone().into()));
        let written = written.chain(self.report.output(found.page().as_ref()));
        let written: Vec<_> = written.collect();
        let to_stream = self.output.as_deref().is_some_and(is_standard_output);
        // the frame file is what is printed: it stays one that can be read
        let errors = findings(&found, Shown::All, output);
        let said = match (output.quiet, to_stream) {
            (true, _) => Said {
                errors,
                ..Said::default()
            },
            (false, true) => Said {
                errors,
                ..Said::text(self.report.written())
            },
            (false, false) => Said {
                errors: errors + &self.report.written(),
                ..Said::data(text)
            },
        };
        drop(progress);
        deliver(files, &written, said, Answer::Yes)
    }

    fn list(&self, files: &Files, progress: Progress, output: Output) -> Result<Answer, Failure> {
        let device = Device {
            base_m: three("--base-mm", self.base_mm.as_deref())?,
            tool_m: three("--tool-mm", self.tool_mm.as_deref())?,
            leg_m: m_from_mm(self.leg_mm),
            range_m: m_from_mm(self.range_mm),
        };
        let missing = "clap asks for it with --reach";
        let profile = files.profile(self.profile.as_ref().expect(missing))?;
        let frame = files.source(self.frame.as_ref().expect(missing))?;
        progress.say("solving");
        let found = measurable_poses(&profile, self.tool.as_deref(), &frame, &device)?;
        self.finish(files, &found, Some(found.csv()), progress, output)
    }
}

/// Three lengths in mm.
fn three(option: &str, text: Option<&str>) -> Result<[f64; 3], Failure> {
    let text = text.unwrap_or_default();
    values::point(text)
        .filter(|lengths| lengths.iter().all(|l| *l > 0.0))
        .ok_or_else(|| {
            Failure::new(format!(
                "{option} {text}: it must be three lengths in mm, such as 300,300,300"
            ))
        })
}
