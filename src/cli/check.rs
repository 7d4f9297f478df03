//! `check`: where the real robot goes with programs as they are, and what it comes near.

use super::ending::{ReportFile, Said, deliver};
use super::files::Files;
use super::layout;
use super::programs::{Ignored, gather, read_context};
use super::progress::Progress;
use super::{Answer, Output, screen, values};
use crate::check::{Options, ToolRotation, baseline};
use crate::finding::Acceptance;
use crate::geometry::units::{DEG, MM};
use crate::model::profile::Profile;
use crate::printable::name_of;
use crate::report;
use crate::report::html::programs::check_page;
use crate::task::check::{Checked as Run, Request, check};
use crate::task::programs::{acceptance, common_language, language_by_id};
use crate::task::{Document, Failure, text};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Predict where the real robot goes with programs as they are: accuracy along the path, limits,
/// collisions
#[derive(Args)]
pub(super) struct Check {
    /// Program files that belong together, or folders of them; `-` is one program on standard
    /// input
    #[arg(required = true, value_name = "PROGRAM")]
    programs: Vec<PathBuf>,
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// What stands around the robot and what it carries (YAML)
    #[arg(long, value_name = "FILE")]
    cell: Option<PathBuf>,
    /// The program that a compensated one was made from: where the tool is wanted
    #[arg(long, value_name = "ORIGINAL")]
    nominal: Vec<PathBuf>,
    /// Compare with --nominal and --profile although the marker of a program names another
    /// original or profile
    #[arg(long)]
    force: bool,
    /// A path error above this is an error, mm
    #[arg(long, value_name = "MM")]
    max_path_error: Option<f64>,
    /// How the controller rotates the tool on straight and circular moves
    #[arg(long, value_enum, default_value = "slerp")]
    orientation: Orientation,
    /// Bodies farther apart than this beyond what is required are not measured, mm
    #[arg(long, value_name = "MM", default_value_t = 100.0)]
    horizon: f64,
    /// A joint nearer to its limits is a warning, degrees
    #[arg(long, value_name = "DEG", default_value_t = 1.0)]
    limit_margin: f64,
    /// A stored run to compare with; status 1 where something got worse
    #[arg(long, value_name = "JSON")]
    baseline: Option<PathBuf>,
    /// Store this run as the baseline
    #[arg(long, requires = "baseline")]
    update_baseline: bool,
    /// Differences from the baseline below this are none, mm and degrees
    #[arg(long, value_name = "MM", default_value_t = 0.0005)]
    tolerance: f64,
    /// Write `JUnit` XML for a build server
    #[arg(long, value_name = "XML")]
    junit: Option<PathBuf>,
    /// Tool for names that no file declares: a tool of the profile, or x,y,z,rx,ry,rz in mm and
    /// degrees on the flange
    #[arg(long = "tool", value_name = "[NAME=]TOOL", allow_hyphen_values = true)]
    tools: Vec<String>,
    /// Work frame for names that no file declares: x,y,z,rx,ry,rz in mm and degrees in the world
    #[arg(long = "frame", value_name = "[NAME=]POSE", allow_hyphen_values = true)]
    frames: Vec<String>,
    /// Files and folders that are read for their declarations and calls only
    #[arg(long, value_name = "PATH")]
    with: Vec<PathBuf>,
    /// Of the programs and originals only those of this name, with or without its ending; the
    /// others are read as with --with
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Take an error, by its id, everywhere or at one place
    #[arg(long, value_name = "ID[:FILE[:LINE]]")]
    accept: Vec<String>,
    /// Joints of the robot when a program starts, degrees, and its external axes, mm or degrees:
    /// they give the first posture and direction
    #[arg(long, value_name = "Q1,…,Q6[,E1,…]", allow_hyphen_values = true)]
    start_joints: Option<String>,
    /// Language of the programs (default: by file name and content)
    #[arg(long, value_name = "ID")]
    language: Option<String>,
    #[command(flatten)]
    ignored: Ignored,
    #[command(flatten)]
    report: ReportFile,
}

/// How the controller rotates the tool
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Orientation {
    /// About one axis at a constant rate
    Slerp,
    /// Three angles (Rz Ry Rx), each at a constant rate
    Euler,
}

impl Check {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        self.refuse_nonsense()?;
        let files = Files::default();
        let file = files.profile(&self.profile)?;
        let read = |path: &Path| files.mesh(path);
        let cell = self.cell.as_ref().map(|path| files.source(path));
        let cell = cell.transpose()?;
        let asked = self.language.as_deref().map(language_by_id).transpose()?;
        let accepted: Vec<Acceptance> = self
            .accept
            .iter()
            .map(|text| acceptance(text))
            .collect::<Result<_, _>>()?;
        let progress = Progress::new(output, "reading");
        let gathered = gather(&files, &self.programs, asked, &self.ignored)?;
        let left_out = gathered.left_out.clone();
        let (paths, below) = (gathered.paths(), gathered.below());
        let mut sources = gathered.only(&self.only)?;
        let with = |asked, programs: &[PathBuf]| {
            read_context(&files, &self.with, asked, &self.ignored, programs)
        };
        sources.extend(with(asked, &paths)?);
        let language = asked.map_or_else(|| common_language(&sources, Some(&file.profile)), Ok)?;
        let nominal = if self.nominal.is_empty() {
            None
        } else {
            let gathered = gather(&files, &self.nominal, Some(language), &self.ignored)?;
            let paths = gathered.paths();
            let mut nominal = if self.are_folders() {
                let shared = gathered.shared_with(&below, &self.only)?;
                Self::say_left_out(&shared.left_out);
                shared.sources
            } else {
                gathered.only(&self.only)?
            };
            nominal.extend(with(Some(language), &paths)?);
            Some(nominal)
        };
        self.ignored.warn_of_unused();
        let written = self.baseline.iter().filter(|_| self.update_baseline);
        let written = written.chain(&self.junit).map(PathBuf::as_path);
        self.report.refuse_over(&files, written)?;
        let request = Request {
            sources: &sources,
            nominal: nominal.as_deref(),
            language: Some(language),
            profile: &file,
            cell: cell.as_ref(),
            read: &read,
            options: self.options(&file.profile)?,
            accepted: &accepted,
            force: self.force,
        };
        progress.say("checking");
        let found = check(&request, &mut |done, of| progress.tell(done, of))?;
        progress.say("reporting");
        let header = found.header(&left_out);
        let run = Run::new(&header, &found.check, None);
        let comparison = self.compare(&files, &run)?;
        let mut outputs = Vec::new();
        if let (Some(path), true) = (&self.baseline, self.update_baseline) {
            outputs.push((path.clone(), run.json().into_bytes().into()));
        }
        if let Some(path) = &self.junit {
            let xml = report::check::junit(&run, comparison.as_ref());
            outputs.push((path.clone(), xml.into_bytes().into()));
        }
        let worse = comparison.as_ref().map_or(0, |c| c.worse.len());
        let page = self.report.is_wanted();
        let page = page.then(|| check_page(&found, &header, worse));
        outputs.extend(self.report.output(page.as_ref()));
        let refused = found.check.is_refused();
        let answer = if refused || worse > 0 {
            Answer::No
        } else {
            Answer::Yes
        };
        let run = Run::new(&header, &found.check, comparison.as_ref());
        let said = if output.json {
            Said::json(&run)?
        } else {
            Said::text(self.tell(&run, refused, &found.notes, output))
        };
        drop(progress);
        deliver(&files, &outputs, said, answer)
    }

    /// Whether folders are compared with folders.
    fn are_folders(&self) -> bool {
        let mut both = self.programs.iter().chain(&self.nominal);
        both.all(|path| path.is_dir())
    }

    /// Says which originals have no program.
    fn say_left_out(names: &[String]) {
        if !names.is_empty() {
            screen::warn(&format!(
                "not compared, for no program is called so: {} of --nominal",
                names.join(", ")
            ));
        }
    }

    fn refuse_nonsense(&self) -> Result<(), Failure> {
        let numbers = [
            ("--max-path-error", self.max_path_error, f64::MIN_POSITIVE),
            ("--horizon", Some(self.horizon), 0.0),
            ("--limit-margin", Some(self.limit_margin), 0.0),
            ("--tolerance", Some(self.tolerance), 0.0),
        ];
        for (name, value, least) in numbers {
            value.map_or(Ok(()), |value| values::check_size(name, value, least))?;
        }
        Ok(())
    }

    fn options(&self, profile: &Profile) -> Result<Options, Failure> {
        let given = values::given(&self.tools, &self.frames, profile)?;
        let start = values::start(self.start_joints.as_deref(), profile)?;
        Ok(Options {
            given,
            turning: match self.orientation {
                Orientation::Slerp => ToolRotation::Slerp,
                Orientation::Euler => ToolRotation::Euler,
            },
            max_path_error_m: self.max_path_error.map(|mm| mm * MM),
            horizon_m: self.horizon * MM,
            limit_margin_rad: self.limit_margin * DEG,
            start_joints: start.joints_rad,
            start_external: start.external,
            ..Options::default()
        })
    }

    /// The comparison with the stored run; none where there is no baseline, or where it is to be
    /// written for the first time.
    fn compare(&self, files: &Files, now: &Run) -> Result<Option<baseline::Comparison>, Failure> {
        let Some(path) = &self.baseline else {
            return Ok(None);
        };
        if self.update_baseline {
            return Ok(None);
        }
        if !path.exists() {
            return Err(Failure::with_hint(
                format!("there is no baseline {}", name_of(path)),
                "--update-baseline stores this run",
            ));
        }
        let source = files.source(path)?;
        now.compare(&text(&source)?, self.tolerance)
            .map(Some)
            .map_err(|error| match error {
                baseline::BaselineError::TooLarge { line, .. } => {
                    let length = source.line(line.saturating_sub(1)).map(<[u8]>::len);
                    let hint = "--update-baseline stores a run anew";
                    Failure::at(&source, line, 1, length, error.to_string(), hint)
                }
                _ => Failure::new(format!("{}: {error}", name_of(path))),
            })
    }

    fn tell(&self, found: &Run, refused: bool, notes: &[String], output: Output) -> String {
        let mut text = String::new();
        if output.verbose {
            let lines = notes.iter().map(|note| format!("note: {note}\n"));
            text += &layout::fitted(&lines.collect::<String>());
        }
        if !output.quiet || refused {
            text += &layout::findings(found.findings, output);
        }
        if output.quiet {
            if let Some(comparison) = found.baseline.filter(|c| !c.worse.is_empty()) {
                text += &layout::fitted(&baseline::text(comparison));
            }
        } else {
            text += &layout::fitted(&report::check::text(found));
        }
        if let (Some(path), true) = (&self.baseline, self.update_baseline && !output.quiet) {
            text += &format!("stored as {}\n", name_of(path));
        }
        if !output.quiet {
            text += &self.report.written();
        }
        text
    }
}
