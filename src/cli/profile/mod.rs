//! `profile`: make and inspect profiles.

mod change;
mod export;
mod from_urdf;

use super::telling::{Told, finish, print_schema, print_table};
use super::{Answer, Output, files};
use crate::model::profile::Profile;
use crate::report::Report;
use crate::task::Failure;
use crate::task::profile::{diff, import_ur, new, show};
use change::{AddTool, Set};
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
    Export(Export),
}

/// Put the factory calibration of a Universal Robots arm into its profile, as what the controller computes with
#[derive(Args)]
struct ImportUr {
    /// The controller's calibration.conf, or the `kinematics:` file that the ROS driver's package for it writes
    calibration: PathBuf,
    /// The nominal profile of this type of arm
    #[arg(long, value_name = "NOMINAL")]
    profile: PathBuf,
    /// Where to write the profile
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
}

impl ProfileCommand {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        match &self.command {
            Sub::New {
                robot,
                output: file,
            } => {
                let mut found = new(robot)?;
                let Some(path) = file else {
                    print_table(&found, output)?;
                    return Ok(Answer::Yes);
                };
                let text = found.profile.take().unwrap_or_default();
                found.output = Some(path.display().to_string());
                make(path, &text, &found, output)
            }
            Sub::Show { profile } => tell(&show(&files::profile(profile)?.profile), output),
            Sub::Diff { a, b } => {
                let found = diff(&files::profile(a)?.profile, &files::profile(b)?.profile);
                let same = found.differences.is_empty();
                tell(&found, output)?;
                Ok(if same { Answer::Yes } else { Answer::No })
            }
            Sub::ImportUr(command) => command.run(output),
            Sub::Schema => {
                print_schema(&Profile::schema())?;
                Ok(Answer::Yes)
            }
            Sub::FromUrdf(command) => command.run(output),
            Sub::Set(command) => command.run(output),
            Sub::AddTool(command) => command.run(output),
            Sub::Export(command) => command.run(output),
        }
    }
}

/// Tells what is looked at.
fn tell(found: &impl Report, output: Output) -> Result<Answer, Failure> {
    finish(found, Vec::new(), None, (Told::Main, ""), output)?;
    Ok(Answer::Yes)
}

/// Writes a profile that is made, over none.
fn make(path: &Path, text: &str, found: &impl Report, output: Output) -> Result<Answer, Failure> {
    files::refuse_existing(path)?;
    let written = vec![(path.to_owned(), text.as_bytes().to_vec())];
    finish(found, written, None, (Told::Main, ""), output)?;
    Ok(Answer::Yes)
}

impl ImportUr {
    fn run(&self, output: Output) -> Result<Answer, Failure> {
        files::refuse_existing(&self.output)?;
        let profile = files::profile(&self.profile)?;
        let calibration = files::source(&self.calibration)?;
        let name = self.output.display().to_string();
        let found = import_ur(&calibration, &profile, &name)?;
        make(&self.output, &found.text, &found, output)
    }
}
