//! `profile`: make and inspect profiles.

mod change;
mod export;
mod from_urdf;

use super::ending::{Ending, finish, print_schema, print_table};
use super::files::{Files, refuse_existing};
use super::{Answer, Output};
use crate::model::profile::Profile;
use crate::printable::name_of;
use crate::report::Report;
use crate::task::Failure;
use crate::task::profile::{diff, import_ur, new, show};
use change::{AddPositioner, AddTool, AddTrack, ImportKrc, ImportMoc, Set};
use clap::{Args, Subcommand};
use export::Export;
use from_urdf::FromUrdf;
use std::path::{Path, PathBuf};

/// Make and inspect robot profiles
#[derive(Args)]
pub(super) struct ProfileCommand {
    #[command(subcommand)]
    command: Sub,
}

/// Whether a file that exists is written over.
#[derive(Args, Clone, Copy)]
struct Over {
    /// Write over a file that exists
    #[arg(long)]
    force: bool,
}

#[derive(Subcommand)]
enum Sub {
    /// Start a profile from a built-in robot
    New {
        /// Name of the robot, as `poseshift robots` lists it
        #[arg(long, value_name = "NAME")]
        robot: String,
        /// Where to write it (default: standard output)
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
        #[command(flatten)]
        over: Over,
    },
    /// Print what a person wants to know of a profile
    Show {
        /// The profile
        profile: PathBuf,
    },
    /// Print how two profiles differ; status 1 where they do
    Diff {
        /// The one profile
        a: PathBuf,
        /// The other profile
        b: PathBuf,
    },
    ImportUr(ImportUr),
    /// Print the JSON Schema of the format
    Schema,
    FromUrdf(FromUrdf),
    Set(Set),
    AddTool(AddTool),
    AddTrack(AddTrack),
    AddPositioner(AddPositioner),
    ImportMoc(ImportMoc),
    ImportKrc(ImportKrc),
    Export(Export),
}

/// Put the factory calibration of a Universal Robots arm into its profile, as what the controller
/// computes with
#[derive(Args)]
struct ImportUr {
    /// The controller's calibration.conf, or the `kinematics:` file that the ROS driver's package
    /// for it writes
    calibration: PathBuf,
    /// The nominal profile of this type of arm
    #[arg(long, value_name = "NOMINAL")]
    profile: PathBuf,
    /// Where to write the profile
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    over: Over,
}

impl ProfileCommand {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let files = Files::default();
        match &self.command {
            Sub::New {
                robot,
                output: file,
                over,
            } => {
                let mut found = new(robot)?;
                let Some(path) = file else {
                    return print_table(&found, output, Answer::Yes);
                };
                let text = found.profile.take().unwrap_or_default();
                found.output = Some(name_of(path));
                make(&files, (path, *over), &text, &found, output)
            }
            Sub::Show { profile } => {
                let found = show(&files.profile(profile)?.profile);
                finish(&files, &found, Ending::default(), output)
            }
            Sub::Diff { a, b } => {
                let found = diff(&files.profile(a)?.profile, &files.profile(b)?.profile);
                let ending = Ending {
                    answer: if found.differences.is_empty() {
                        Answer::Yes
                    } else {
                        Answer::No
                    },
                    ..Ending::default()
                };
                finish(&files, &found, ending, output)
            }
            Sub::ImportUr(command) => command.run(&files, output),
            Sub::Schema => print_schema(&Profile::schema()),
            Sub::FromUrdf(command) => command.run(&files, output),
            Sub::Set(command) => command.run(&files, output),
            Sub::AddTool(command) => command.run(&files, output),
            Sub::AddTrack(command) => command.run(&files, output),
            Sub::AddPositioner(command) => command.run(&files, output),
            Sub::ImportMoc(command) => command.run(&files, output),
            Sub::ImportKrc(command) => command.run(&files, output),
            Sub::Export(command) => command.run(&files, output),
        }
    }
}

/// Writes a profile that is made, over none but by force.
fn make(
    files: &Files,
    (path, over): (&Path, Over),
    text: &str,
    found: &impl Report,
    output: Output,
) -> Result<Answer, Failure> {
    refuse_existing(path, over.force)?;
    let ending = Ending {
        written: vec![(path.to_owned(), text.as_bytes().into())],
        ..Ending::default()
    };
    finish(files, found, ending, output)
}

impl ImportUr {
    fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        refuse_existing(&self.output, self.over.force)?;
        let profile = files.profile(&self.profile)?;
        let calibration = files.source(&self.calibration)?;
        let name = name_of(&self.output);
        let found = import_ur(&calibration, &profile, &name)?;
        make(
            files,
            (&self.output, self.over),
            &found.text,
            &found,
            output,
        )
    }
}
