//! `compensate`: program files in, program files with fake targets out.

use super::layout;
use super::programs::programs_in;
use super::telling::ReportFile;
use super::way::Drawing;
use super::{Answer, Output, files, print, values};
use crate::check::CheckError;
use crate::check::refine::{Refined, refine};
use crate::compensate::Methods;
use crate::compensate::{Compensation, Given, Options, compensate};
use crate::geometry::units::MM;
use crate::geometry::units::m_from_mm;
use crate::model::profile::Profile;
use crate::program::{Language, Marker, Source};
use crate::report;
use crate::task::compensate::{Compensated, Header};
use crate::task::files::{same_file, sha256, write_all};
use crate::task::programs::{
    common_language, explain, language_by_id, refuse_doubtful, refuse_marked,
};
use crate::task::{Document, Failure, frame};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Rewrite the targets of programs so that the real tool arrives where the simulation wanted it
#[derive(Args)]
pub struct Compensate {
    /// Program files that belong together, or folders of them
    #[arg(required = true, value_name = "PROGRAM")]
    programs: Vec<PathBuf>,
    /// Robot profile (YAML) with a calibration
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Where to write: a file, or a folder for several programs
    #[arg(
        short,
        long,
        value_name = "OUT",
        required_unless_present = "in_place",
        conflicts_with = "in_place"
    )]
    output: Option<PathBuf>,
    /// Write over the program files
    #[arg(long)]
    in_place: bool,
    /// Write even when targets cannot be compensated; these stay as they are, and the status is 1
    #[arg(long)]
    keep_going: bool,
    /// Compensate files that already are, and targets that the controller corrects itself (KRL: S with bit 4)
    #[arg(long)]
    force: bool,
    /// Write at least so many decimals of a millimetre (default: as many as the file has)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=9))]
    decimals: Option<u8>,
    /// Insert targets until the path between targets, too, is within so many mm of the wanted one
    #[arg(long, value_name = "MM", conflicts_with = "work_offset")]
    max_path_error: Option<f64>,
    /// What to do with joint targets
    #[arg(long, value_enum, default_value = "keep")]
    joint_targets: JointTargets,
    /// How to search the joints of the real arm
    #[arg(long, value_enum, default_value = "auto")]
    method: Search,
    /// Tool for names the files do not tell: a tool of the profile, or x,y,z,rx,ry,rz in mm and degrees on the flange
    #[arg(long = "tool", value_name = "[NAME=]TOOL", allow_hyphen_values = true)]
    tools: Vec<String>,
    /// Work frame for names the files do not tell: x,y,z,rx,ry,rz in mm and degrees in the world
    #[arg(long = "frame", value_name = "[NAME=]POSE", allow_hyphen_values = true)]
    frames: Vec<String>,
    /// Where the part stands: a frame file that maps the part as simulated into the part as measured, both in the world;
    /// moves every target with the part
    #[arg(long, value_name = "FRAME.yaml")]
    work_offset: Option<PathBuf>,
    /// Where a work object stands in the world: a frame file. Like --frame, but a program that declares it elsewhere is refused
    #[arg(long = "wobj", value_name = "NAME=FRAME.yaml")]
    wobjs: Vec<String>,
    /// Joints of the robot when a program starts, degrees: they tell the first posture and direction
    #[arg(long, value_name = "Q1,…,Q6", allow_hyphen_values = true)]
    start_joints: Option<String>,
    /// How far points that the running program derives from a target may land off their own wanted pose, mm
    #[arg(long, value_name = "MM", default_value_t = 0.05)]
    max_derived_error: f64,
    /// Language of the programs (default: by file name and content)
    #[arg(long, value_name = "ID")]
    language: Option<String>,
    #[command(flatten)]
    report: ReportFile,
}

/// How to search the joints of the real arm
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Search {
    /// Pose shift, and damped Newton where it stalls
    Auto,
    /// Pose shift alone; where it stalls the target is refused
    PoseShift,
}

/// What to do with joint targets
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum JointTargets {
    /// Leave them: they are exact for the joints, not for the tool
    Keep,
    /// Shift them so that the real tool comes where the nominal one would
    Correct,
}

/// A program file and where its compensated version goes.
struct Job {
    input: PathBuf,
    output: PathBuf,
}

impl Compensate {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let file = files::profile(&self.profile)?;
        refuse_doubtful(&file)?;
        let (profile, profile_sha256) = (&file.profile, &file.sha256);
        let each = output.json || self.max_path_error.is_some() || self.report.is_wanted();
        let options = self.options(profile, each)?;
        let asked = self.language.as_deref().map(language_by_id).transpose()?;
        let found = self.find_programs(asked)?;
        let inputs = found.iter().map(|job| job.input.as_path());
        let read = [&self.profile].into_iter().chain(&self.work_offset);
        let placed = self.wobjs.iter().filter_map(|text| text.split_once('='));
        let placed = placed.map(|(_, file)| Path::new(file.trim()));
        let read = read.map(PathBuf::as_path).chain(placed);
        let outputs = || found.iter().map(|job| job.output.as_path());
        // in place, every program is its own output
        if self.in_place {
            self.report.refuse_over(inputs, [])?;
            self.report.refuse_over(read, outputs())?;
        } else {
            self.report.refuse_over(inputs.chain(read), outputs())?;
        }
        let sources = found
            .iter()
            .map(|job| files::source(&job.input))
            .collect::<Result<Vec<_>, Failure>>()?;
        let language = asked.map_or_else(|| common_language(&sources, profile), Ok)?;
        if !self.force {
            refuse_marked(&sources)?;
        }
        let mut compensation = compensate(language, &sources, profile, &options)
            .map_err(|error| explain(&error, &sources))?;
        let refined = self.refine(language, &sources, profile, &options, &mut compensation)?;
        let refused = compensation.is_refused();
        let writes = !refused || self.keep_going;
        let outputs = found.iter().filter(|_| writes);
        let header = Header {
            inputs: sources.iter().map(|s| s.name.clone()).collect(),
            outputs: outputs
                .map(|job| job.output.display().to_string())
                .collect(),
            sources: &sources,
            language,
            profile_sha256,
        };
        let mut told = tell(&header, &compensation, output);
        if refined.moves > 0 && !output.json && !output.quiet {
            told += &format!(
                "{} moves inserted, so that the path is within {} mm\n",
                refined.moves,
                self.max_path_error.unwrap_or_default()
            );
        }
        let mut drawing = self
            .report
            .is_wanted()
            .then(|| Drawing::begin(&header, &compensation, &file, &options));
        let mut outputs = Vec::new();
        let inserted = refined.moves;
        if writes {
            let written = render(language, &sources, compensation, profile_sha256, refined)?;
            if let Some(drawing) = &mut drawing {
                drawing.tell_inserted(inserted);
                drawing.add_written(language, &written, &sources, profile, &options);
            }
            let written = written.into_iter().map(|source| source.bytes);
            outputs.extend(found.into_iter().map(|job| job.output).zip(written));
        }
        outputs.extend(self.report.output(drawing.as_ref().map(|d| &d.page)));
        write_all(&outputs)?;
        if !output.json && !output.quiet {
            told += &self.report.told();
        }
        print(&told)?;
        Ok(if refused { Answer::No } else { Answer::Yes })
    }

    /// `each`: each target is reported on.
    fn options(&self, profile: &Profile, each: bool) -> Result<Options, Failure> {
        let mut given = Given::default();
        for text in &self.tools {
            let (name, tool) = values::tool(text, profile)?;
            given.tools.insert(name, tool);
        }
        for text in &self.frames {
            let (name, frame) = values::frame(text)?;
            given.frames.insert(name, frame);
        }
        for text in &self.wobjs {
            let (name, file) = values::named(text);
            let name = name.ok_or_else(|| {
                Failure::new(format!("--wobj {text}: it must be NAME=FRAME.yaml"))
            })?;
            let frame = frame(&files::source(Path::new(file))?)?;
            given.measured_frames.insert(name, frame.to_from_from);
        }
        let work_offset = match &self.work_offset {
            Some(path) => Some(frame(&files::source(path)?)?.to_from_from),
            None => None,
        };
        Ok(Options {
            given,
            work_offset,
            correct_joint_targets: self.joint_targets == JointTargets::Correct,
            decimals: self.decimals.map(usize::from),
            summary_only: !each,
            accept_absolutely_accurate: self.force,
            max_derived_error_m: Some(m_from_mm(self.max_derived_error)),
            start_joints: self
                .start_joints
                .as_deref()
                .map(values::joints)
                .transpose()?,
            methods: match self.method {
                Search::Auto => Methods::Auto,
                Search::PoseShift => Methods::PoseShift,
            },
        })
    }

    /// Inserts targets where the path asks for them.
    fn refine(
        &self,
        language: &'static dyn Language,
        sources: &[Source],
        profile: &Profile,
        options: &Options,
        compensation: &mut Compensation,
    ) -> Result<Refined, Failure> {
        let Some(limit) = self.max_path_error else {
            return Ok(Refined::default());
        };
        if !(limit >= 0.001 && limit.is_finite()) {
            let message = format!("--max-path-error is {limit}; it must be at least 0.001 mm");
            return Err(Failure::new(message));
        }
        let scene = crate::check::Scene::default();
        let subject = crate::check::Subject {
            language,
            sources,
            nominal: None,
            profile,
            scene: &scene,
        };
        let checked = crate::check::Options {
            given: options.given.clone(),
            ..crate::check::Options::default()
        };
        refine(
            &subject,
            &checked,
            limit * MM,
            options.decimals,
            compensation,
        )
        .map_err(|error| match error {
            CheckError::Program(error) | CheckError::Nominal(error) => explain(&error, sources),
            CheckError::NoCounterpart { .. } => Failure::new(error.to_string()),
        })
    }

    /// The program files that are meant, in the order of the arguments; folders give theirs by name.
    fn find_programs(&self, asked: Option<&'static dyn Language>) -> Result<Vec<Job>, Failure> {
        let mut inputs: Vec<(PathBuf, PathBuf)> = Vec::new();
        for program in &self.programs {
            if program.is_dir() {
                inputs.extend(programs_in(program, asked)?);
            } else {
                let name = program
                    .file_name()
                    .map_or_else(|| program.clone(), PathBuf::from);
                inputs.push((program.clone(), name));
            }
        }
        if inputs.is_empty() {
            return Err(Failure::with_hint(
                "no program files in these folders",
                "`poseshift languages` lists what is recognised",
            ));
        }
        let several = inputs.len() > 1 || self.programs.iter().any(|p| p.is_dir());
        let mut jobs = Vec::with_capacity(inputs.len());
        for (input, name) in inputs {
            let output = match &self.output {
                None => input.clone(),
                Some(out) if several || out.is_dir() => out.join(name),
                Some(out) => out.clone(),
            };
            if !self.in_place && same_file(&input, &output) {
                let hint = "--in-place says that this is meant";
                return Err(Failure::with_hint(
                    format!("{} would be written over", input.display()),
                    hint,
                ));
            }
            jobs.push(Job { input, output });
        }
        Ok(jobs)
    }
}

/// The files' new bytes: edits and marker, read again to make sure that they say what was meant. Takes the compensation,
/// so that a long program is not in memory twice.
fn render(
    language: &dyn Language,
    sources: &[Source],
    compensation: Compensation,
    profile_sha256: &str,
    refined: Refined,
) -> Result<Vec<Source>, Failure> {
    let Compensation {
        program,
        settings,
        edits,
        compensated,
        ..
    } = compensation;
    let most = program.targets.len() + refined.targets;
    let targets = most - refined.freed..=most;
    let moves = program.moves.len() + refined.moves;
    drop(program);
    let mut written = Vec::with_capacity(sources.len());
    for ((source, mut edits), compensated) in sources.iter().zip(edits).zip(compensated) {
        if compensated {
            let marker = Marker {
                version: env!("CARGO_PKG_VERSION").into(),
                profile_sha256: profile_sha256.into(),
                source_sha256: sha256(&source.bytes),
            };
            let (at, text) = language.mark(source, &marker);
            edits.replace(at..at, |bytes| bytes.extend(text));
        }
        written.push(Source::new(source.name.clone(), edits.apply(&source.bytes)));
    }
    let same = crate::motion::read(language, &written, &settings)
        .is_ok_and(|after| targets.contains(&after.targets.len()) && after.moves.len() == moves);
    if !same {
        return Err(Failure::internal(
            "the rewritten program does not read back as the same program",
        ));
    }
    Ok(written)
}

/// What is printed when all is done.
fn tell(header: &Header, compensation: &Compensation, output: Output) -> String {
    let found = Compensated::new(header, compensation);
    if output.json {
        return found.json();
    }
    let written = !header.outputs.is_empty();
    let mut text = String::new();
    if !output.quiet || !written {
        text += &layout::findings(&compensation.findings, output.verbose);
    }
    if !output.quiet {
        text += &layout::fitted(&report::compensation::text(
            &found,
            header.inputs.len(),
            header.language,
        ));
    }
    match header.outputs.as_slice() {
        [] => {
            text += &layout::fitted(
                "nothing is written: not every target could be compensated (--keep-going leaves those as they are)",
            );
        }
        _ if output.quiet => {}
        [one] => text += &format!("written to {one}\n"),
        many => text += &format!("{} files written\n", many.len()),
    }
    text
}
