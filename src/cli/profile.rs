//! `profile`: make and inspect profiles.

use super::telling::{Told, finish, print_schema, print_table};
use super::{Answer, Output, files};
use crate::model::profile::Profile;
use crate::report::Report;
use crate::task::Failure;
use crate::task::profile::{Inputs, diff, from_urdf, import_ur, new, show};
use crate::urdf::Choice;
use clap::{Args, Subcommand};
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
    /// Make a profile of a URDF: its six axes, limits, masses and collision shapes
    FromUrdf(FromUrdf),
}

/// A URDF and what to take of it
#[derive(Args)]
struct FromUrdf {
    /// The URDF (what xacro makes of a xacro file)
    file: PathBuf,
    /// The link that stands still (default: the one without a parent)
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// The link that tools are mounted on (default: tool0, flange, or the only end)
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// Where packages are: a folder that holds them, or NAME=FOLDER of one
    #[arg(long, value_name = "[NAME=]FOLDER")]
    package_path: Vec<String>,
    /// Leave the collision shapes out
    #[arg(long)]
    no_shapes: bool,
    /// Where to write it (default: standard output)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
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
                make(path, text, &found, output)
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

impl FromUrdf {
    fn run(&self, output: Output) -> Result<Answer, Failure> {
        let origin = self.file.file_name().unwrap_or_default().to_string_lossy();
        let mut found = from_urdf(&Inputs {
            urdf: &files::source(&self.file)?,
            origin: &origin,
            choice: Choice {
                base: self.base.clone(),
                tip: self.tip.clone(),
                shapes: !self.no_shapes,
            },
            meshes: &|file| self.mesh(file),
        })?;
        let Some(path) = &self.output else {
            print_table(&found, output)?;
            return Ok(Answer::Yes);
        };
        found.output = Some(path.display().to_string());
        make(path, &found.profile, &found, output)
    }

    /// Where a mesh is; `None` where it is not.
    fn mesh(&self, file: &str) -> Option<String> {
        let beside = self.file.parent().unwrap_or(Path::new(""));
        let candidates: Vec<PathBuf> = if let Some(rest) = file.strip_prefix("package://") {
            let (package, inside) = rest.split_once('/')?;
            let place = |given: &String| match given.split_once('=') {
                Some((name, folder)) if name == package => Some(Path::new(folder).join(inside)),
                Some(_) => None,
                None => Some(Path::new(given).join(rest)),
            };
            self.package_path.iter().filter_map(place).collect()
        } else {
            let plain = file.strip_prefix("file://").unwrap_or(file);
            vec![beside.join(plain)]
        };
        let found = candidates.into_iter().find(|path| path.is_file())?;
        // profiles name meshes relative to themselves, wherever they are written
        let whole = std::fs::canonicalize(&found).ok()?;
        Some(whole.display().to_string())
    }
}
