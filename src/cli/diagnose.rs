//! `diagnose`: where model and measurement disagree, and which effect is missing.

use super::ending::{Ending, ReportFile, Shown, finish};
use super::files::Files;
use super::measurements::{MeasurementFiles, picks};
use super::progress::Progress;
use super::{Answer, Output};
use crate::diagnose::Options;
use crate::printable::name_of;
use crate::task::Failure;
use crate::task::diagnose::diagnose;
use crate::task::drift::diagnose_runs;
use clap::Args;
use std::path::PathBuf;

/// Find where model and measurements disagree, name the missing effect, add it
#[derive(Args)]
pub(super) struct Diagnose {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    #[command(flatten)]
    measurements: MeasurementFiles,
    /// Improved profile to write (YAML)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Have this effect in the model whatever the evidence, and no others: `backlash:3`; may be
    /// given again
    #[arg(long, value_name = "EFFECT")]
    accept: Vec<String>,
    /// Leave this effect out: `joint_harmonic`, `link_compliance:2`; may be given again
    #[arg(long, value_name = "EFFECT")]
    reject: Vec<String>,
    /// Joint angles to write (CSV) that would tell the alternatives apart
    #[arg(long, value_name = "FILE")]
    poses: Option<PathBuf>,
    /// Leave out the check on rows not used
    #[arg(long)]
    quick: bool,
    /// The files of --measurements are runs, the oldest first: say since which the arm errs
    /// otherwise, and diagnose the rows since
    #[arg(long, conflicts_with = "joints")]
    runs: bool,
    #[command(flatten)]
    report: ReportFile,
}

impl Diagnose {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let options = Options {
            accept: picks("--accept", Some(&self.accept.join(",")))?,
            reject: picks("--reject", Some(&self.reject.join(",")))?,
            quick: self.quick,
            steps: self.report.is_wanted(),
            ..Options::default()
        };
        let files = Files::default();
        let profile = files.profile(&self.profile)?;
        let progress = Progress::new(output, "reading");
        let measurements = self.measurements.read(&files, &profile)?;
        let outputs = self.output.iter().chain(&self.poses).map(PathBuf::as_path);
        self.report.refuse_over(&files, outputs)?;
        progress.say("diagnosing");
        let hear = &mut |what: &str| progress.say(what);
        let mut found = if self.runs {
            diagnose_runs(&profile, &measurements, &options, hear)?
        } else {
            diagnose(&profile, measurements, &options, hear)?
        };
        let is_sure = found.is_sure();
        let (mut written, mut also) = (Vec::new(), String::new());
        if let Some(path) = &self.output {
            if is_sure {
                let text = found.profile_text(&profile)?;
                written.push((path.clone(), text.into_bytes().into()));
                found.output = Some(name_of(path));
                also += &format!("\nwritten to {}\n", name_of(path));
            } else {
                also += &match found.accept.as_str() {
                    "" => "\nnothing written: no effect was found\n".to_owned(),
                    words => {
                        format!("\nnothing written; to have it all the same: --accept {words}\n")
                    }
                };
            }
        }
        if let Some(path) = &self.poses {
            if let Some(csv) = found.poses_csv() {
                written.push((path.clone(), csv.into_bytes().into()));
                found.poses = Some(name_of(path));
                also += &format!("\nwritten to {}\n", name_of(path));
            } else {
                also += "\nno alternatives to tell apart: no poses written\n";
            }
        }
        let ending = Ending {
            written,
            report: Some(&self.report),
            shown: Shown::All,
            also: &also,
            answer: if is_sure { Answer::Yes } else { Answer::No },
            progress: Some(progress),
            ..Ending::default()
        };
        finish(&files, &found, ending, output)
    }
}
