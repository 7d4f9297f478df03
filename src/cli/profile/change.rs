//! `profile set`, `profile add-tool`.

use super::super::ending::{Ending, finish};
use super::super::files::{Files, refuse_existing};
use super::super::{Answer, Output};
use crate::printable::name_of;
use crate::task::profile::{Changed, add_tool, set, tool};
use crate::task::{Failure, ProfileFile};
use clap::Args;
use std::path::{Path, PathBuf};

/// Where a changed profile goes.
#[derive(Args)]
struct Target {
    /// The profile
    profile: PathBuf,
    /// Where to write the changed profile
    #[arg(
        short,
        long,
        value_name = "FILE",
        required_unless_present = "in_place",
        conflicts_with = "in_place"
    )]
    output: Option<PathBuf>,
    /// Change the profile itself
    #[arg(long)]
    in_place: bool,
}

impl Target {
    fn path(&self) -> &Path {
        self.output.as_deref().unwrap_or(&self.profile)
    }

    /// Reads the profile, changes it and writes what came out; everything that is not changed stays byte by byte.
    fn change(
        &self,
        files: &Files,
        output: Output,
        change: impl FnOnce(&ProfileFile, &str) -> Result<Changed, Failure>,
    ) -> Result<Answer, Failure> {
        if let Some(path) = &self.output {
            refuse_existing(path)?;
        }
        let path = self.path();
        let found = change(&files.profile(&self.profile)?, &name_of(path))?;
        if self.in_place {
            files.replace(&self.profile);
        }
        let ending = Ending {
            written: vec![(path.to_owned(), found.text.as_bytes().to_vec())],
            ..Ending::default()
        };
        finish(files, &found, ending, output)
    }
}

/// Set values of a profile, its comments and layout kept: robot.serial=120-500123
#[derive(Args)]
pub(super) struct Set {
    #[command(flatten)]
    target: Target,
    /// What to set: keys with dots between, joints and other lists counted from 1
    #[arg(required = true, value_name = "PATH=VALUE")]
    values: Vec<String>,
}

impl Set {
    pub(super) fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        self.target
            .change(files, output, |file, name| set(file, &self.values, name))
    }
}

/// Add a tool to a profile
#[derive(Args)]
pub(super) struct AddTool {
    #[command(flatten)]
    target: Target,
    /// The tool on the flange in mm, degrees, kg, and mm of the centre of gravity
    #[arg(value_name = "NAME=X,Y,Z,RX,RY,RZ[,KG[,CX,CY,CZ]]")]
    tool: String,
}

impl AddTool {
    pub(super) fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        let tool = tool(&self.tool)?;
        self.target
            .change(files, output, |file, name| add_tool(file, &tool, name))
    }
}
