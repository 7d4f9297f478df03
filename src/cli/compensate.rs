//! `compensate`: program files in, program files with fake targets out.

use super::ending::{ReportFile, Said, deliver_verified};
use super::files::{Files, is_standard_output, is_stream};
use super::layout;
use super::programs::{Gathered, Ignored, ProgramFile, gather, meant, read_context};
use super::progress::Progress;
use super::{Answer, Output, values};
use crate::compensate::{AtSingularity, Compensation, Methods, Options};
use crate::geometry::units::m_from_mm;
use crate::model::profile::Profile;
use crate::printable::name_of;
use crate::program::Source;
use crate::report;
use crate::report::html::programs::Drawing;
use crate::task::compensate::{Compensated, DespiteErrors, Header, Request, prepare, read_again};
use crate::task::programs::{acceptance, language_by_id};
use crate::task::{Failure, frame};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Rewrite the targets of programs so that the real tool arrives where the simulation wanted it
#[derive(Args)]
pub(super) struct Compensate {
    /// Program files that belong together, or folders of them; `-` is one program on standard
    /// input
    #[arg(required = true, value_name = "PROGRAM")]
    programs: Vec<PathBuf>,
    /// Robot profile (YAML) with a calibration
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Where to write: a file, `-` for standard output, or a folder for several programs
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
    #[arg(long, conflicts_with = "write_good")]
    keep_going: bool,
    /// Write the programs that share neither targets nor calls with one that is refused; the
    /// status is 1
    #[arg(long)]
    write_good: bool,
    /// Files and folders that are read for their declarations and calls only
    #[arg(long, value_name = "PATH")]
    with: Vec<PathBuf>,
    /// Of the programs only those of this name, with or without its ending; the others are read as
    /// with --with
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Take an error, by its id, everywhere or at one place; the marker records it (not for reach,
    /// numbers that are not finite, unknown tools and frames)
    #[arg(long, value_name = "ID[:FILE[:LINE]]")]
    accept: Vec<String>,
    /// Write a target out at each of its moves where one set of numbers does not serve all
    #[arg(long)]
    split_targets: bool,
    /// A target at the wrist's singularity that the real arm does not reach on the meant side
    #[arg(long, value_enum, default_value = "refuse")]
    at_singularity: Singularity,
    /// Compensate files that already are, and targets that the controller corrects itself (KRL: S
    /// with bit 4)
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
    /// Tool for names that no file declares: a tool of the profile, or x,y,z,rx,ry,rz in mm and
    /// degrees on the flange
    #[arg(long = "tool", value_name = "[NAME=]TOOL", allow_hyphen_values = true)]
    tools: Vec<String>,
    /// Work frame for names that no file declares: x,y,z,rx,ry,rz in mm and degrees in the world
    #[arg(long = "frame", value_name = "[NAME=]POSE", allow_hyphen_values = true)]
    frames: Vec<String>,
    /// Where the part stands: a frame file that maps the part as simulated into the part as
    /// measured, both in the world; moves every target with the part
    #[arg(long, value_name = "FRAME.yaml")]
    work_offset: Option<PathBuf>,
    /// Where a work object stands in the world: a frame file. Like --frame, but a program that
    /// declares it elsewhere is refused
    #[arg(long = "wobj", value_name = "NAME=FRAME.yaml")]
    wobjs: Vec<String>,
    /// Joints of the robot when a program starts, degrees, and its external axes, mm or degrees:
    /// they give the first posture and direction
    #[arg(long, value_name = "Q1,…,Q6[,E1,…]", allow_hyphen_values = true)]
    start_joints: Option<String>,
    /// How far points that the running program derives from a target may land off their own wanted
    /// pose, mm
    #[arg(long, value_name = "MM", default_value_t = 0.05)]
    max_derived_error: f64,
    /// How far a correction may shift a target (default: ten times what the profile's effects
    /// usually do, at most 20mm,2deg); the marker records it
    #[arg(long, value_name = "MM,DEG")]
    max_shift: Option<String>,
    /// Language of the programs (default: by file name and content)
    #[arg(long, value_name = "ID")]
    language: Option<String>,
    #[command(flatten)]
    ignored: Ignored,
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

/// What becomes of a target at the wrist's singularity
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Singularity {
    /// An error, which says what the others would give
    Refuse,
    /// Joint 5 goes through zero: the tool lands, in another configuration
    Flip,
    /// Joint 4 stays: the tip lands, the orientation nearly
    Nearest,
}

impl Compensate {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let files = Files::default();
        let file = files.profile(&self.profile)?;
        let each = output.json || self.max_path_error.is_some() || self.report.is_wanted();
        let options = self.options(&files, &file.profile, each)?;
        let language = self.language.as_deref().map(language_by_id).transpose()?;
        let progress = Progress::new(output, "reading");
        let Gathered { programs, left_out } =
            gather(&files, &self.programs, language, &self.ignored)?;
        let paths: Vec<PathBuf> = programs
            .iter()
            .map(|program| program.path.clone())
            .collect();
        let (mut sources, places) = self.jobs(&files, programs)?;
        sources.extend(read_context(
            &files,
            &self.with,
            language,
            &self.ignored,
            &paths,
        )?);
        self.ignored.warn_of_unused();
        let outputs = places.iter().flatten().map(PathBuf::as_path);
        self.report.refuse_over(&files, outputs)?;
        let request = Request {
            sources: &sources,
            language,
            profile: &file,
            options,
            force: self.force,
            max_path_error_mm: self.max_path_error,
            despite_errors: match (self.keep_going, self.write_good) {
                (true, _) => DespiteErrors::All,
                (_, true) => DespiteErrors::Good,
                _ => DespiteErrors::Nothing,
            },
        };
        progress.say("compensating");
        let prepared = prepare(&request)?;
        let refused = prepared.is_refused();
        let will_write = prepared.will_write();
        let places = |at: usize| places.get(at).cloned().flatten();
        let outputs = (0..sources.len())
            .filter(|at| will_write[*at])
            .filter_map(places);
        let header = Header {
            inputs: sources.iter().map(|s| s.name.clone()).collect(),
            outputs: outputs.map(|path| name_of(&path)).collect(),
            written: will_write,
            sources: &sources,
            language: prepared.language,
            profile_sha256: &file.sha256,
            left_out: &left_out,
        };
        let mut said = self.tell(&header, &prepared.compensation, output)?;
        let inserted = prepared.compensation.added.paths();
        let is_written = header.written.contains(&true);
        if inserted > 0 && is_written && !output.quiet {
            said.text += &format!(
                "{inserted} moves inserted for a path within {} mm\n",
                self.max_path_error.unwrap_or_default()
            );
        }
        let mut drawing = self.report.is_wanted().then(|| {
            let (compensation, options) = (&prepared.compensation, &request.options);
            let read = |path: &Path| files.mesh(path);
            Drawing::begin(&header, compensation, &file, options, &read)
        });
        let language = prepared.language;
        let draft = header.written.contains(&true).then(|| prepared.draft());
        let (written, check) = draft.unzip();
        let mut outputs = Vec::new();
        if let Some(written) = &written {
            if let Some(drawing) = &mut drawing {
                drawing.say_inserted(inserted);
                let after = &written.sources;
                drawing.add_written(language, after, &sources, &file.profile, &request.options);
            }
            for (at, source) in written.sources.iter().enumerate() {
                if written.is_written[at] {
                    outputs.extend(places(at).map(|path| (path, source.bytes.as_slice().into())));
                }
            }
        }
        outputs.extend(self.report.output(drawing.as_ref().map(|d| &d.page)));
        progress.say("reading what is written");
        if !output.quiet {
            said.text += &self.report.written();
        }
        if output.json {
            said.text.clear();
        } else if self.is_to_stream() {
            // whether or not there is a program, nothing else is taken for it
            said.errors = std::mem::take(&mut said.text);
        }
        let answer = if refused { Answer::No } else { Answer::Yes };
        let read_again = || {
            let draft = check.zip(written.as_ref());
            let verified = draft.map_or(Ok(()), |(check, written)| {
                read_again(check, written, language)
            });
            drop(progress);
            verified
        };
        deliver_verified(&files, &outputs, read_again, said, answer)
    }

    /// Whether the program goes to standard output.
    fn is_to_stream(&self) -> bool {
        self.output.as_deref().is_some_and(is_standard_output)
    }

    /// `each`: each target is reported on.
    fn options(&self, files: &Files, profile: &Profile, each: bool) -> Result<Options, Failure> {
        values::check_size("--max-derived-error", self.max_derived_error, 0.0)?;
        let mut given = values::given(&self.tools, &self.frames, profile)?;
        let start = values::start(self.start_joints.as_deref(), profile)?;
        for text in &self.wobjs {
            let (name, file) = values::named(text);
            let name = name.ok_or_else(|| {
                Failure::new(format!("--wobj {text}: it must be NAME=FRAME.yaml"))
            })?;
            let frame = frame(&files.source(Path::new(file))?)?;
            let known = given
                .measured_frames
                .insert(name.clone(), frame.to_from_from);
            if known.is_some() || given.frames.contains_key(&Some(name.clone())) {
                return Err(Failure::with_hint(
                    format!("--wobj {name}: this frame is given twice"),
                    "one --wobj or --frame a name",
                ));
            }
        }
        let work_offset = match &self.work_offset {
            Some(path) => Some(frame(&files.source(path)?)?.to_from_from),
            None => None,
        };
        Ok(Options {
            given,
            work_offset,
            correct_joint_targets: self.joint_targets == JointTargets::Correct,
            decimals: self.decimals.map(usize::from),
            summary_only: !each,
            max_derived_error_m: Some(m_from_mm(self.max_derived_error)),
            start_joints: start.joints_rad,
            start_external: start.external,
            max_shift: self
                .max_shift
                .as_deref()
                .map(values::max_shift)
                .transpose()?,
            split_targets: self.split_targets,
            at_singularity: match self.at_singularity {
                Singularity::Refuse => AtSingularity::Refuse,
                Singularity::Flip => AtSingularity::Flip,
                Singularity::Nearest => AtSingularity::Nearest,
            },
            accepted: self
                .accept
                .iter()
                .map(|text| acceptance(text))
                .collect::<Result<_, _>>()?,
            methods: match self.method {
                Search::Auto => Methods::Auto,
                Search::PoseShift => Methods::PoseShift,
            },
            ..Options::default()
        })
    }

    /// The sources, and where each one's compensated version goes: nowhere where it is read for its
    /// declarations only.
    fn jobs(
        &self,
        files: &Files,
        programs: Vec<ProgramFile>,
    ) -> Result<(Vec<Source>, Vec<Option<PathBuf>>), Failure> {
        let meant = meant(&programs, &self.only)?;
        let several = programs.len() > 1 || self.programs.iter().any(|p| p.is_dir());
        if several && self.is_to_stream() {
            return Err(Failure::with_hint(
                format!(
                    "{} programs would be written to standard output",
                    programs.len()
                ),
                "name a folder for them",
            ));
        }
        if let Some(output) = &self.output {
            files.settle(output)?;
        }
        let mut jobs = (Vec::new(), Vec::new());
        for (
            ProgramFile {
                path,
                below,
                source,
            },
            is_meant,
        ) in programs.into_iter().zip(meant)
        {
            let place = match &self.output {
                _ if !is_meant => None,
                None if is_stream(&path) => {
                    return Err(Failure::new("standard input is no file to write over"));
                }
                None => {
                    files.replace(&path);
                    Some(path)
                }
                Some(out) if !several && !out.is_dir() => Some(out.clone()),
                Some(out) if is_stream(&path) => {
                    return Err(Failure::with_hint(
                        format!(
                            "{} is a folder, and standard input has no name",
                            name_of(out)
                        ),
                        "name the file, or `-` for standard output",
                    ));
                }
                Some(out) => Some(out.join(below)),
            };
            jobs.0.push(if place.is_some() {
                source
            } else {
                Source::context(source.name, source.bytes)
            });
            jobs.1.push(place);
        }
        Ok(jobs)
    }

    /// What is printed when all is done.
    fn tell(
        &self,
        header: &Header,
        compensation: &Compensation,
        output: Output,
    ) -> Result<Said, Failure> {
        let found = Compensated::new(header, compensation);
        if output.json {
            return Said::json(&found);
        }
        let mut text = layout::findings(&compensation.findings, output);
        if !output.quiet {
            text += &layout::fitted(&report::compensation::text(&found, header.language));
        }
        match header.outputs.as_slice() {
            [] if self.write_good => {
                text += &layout::fitted(
                    "nothing is written: each program has an error, or shares data or calls with one \
                     that has",
                );
            }
            [] => {
                text += &layout::fitted(
                    "nothing is written: not every target could be compensated (--keep-going \
                     leaves those as they are)",
                );
            }
            _ if output.quiet || self.is_to_stream() => {}
            [one] => text += &format!("written to {one}\n"),
            many => text += &format!("{} files written\n", many.len()),
        }
        Ok(Said::text(text))
    }
}
