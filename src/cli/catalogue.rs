//! `robots`, `effects`, `languages`: what is built in.

use super::ending::{Ending, finish};
use super::files::Files;
use super::{Answer, Output};
use crate::report::Report;
use crate::task::{Failure, catalogue};
use clap::Args;

/// List the robots that are built in
#[derive(Args)]
pub(super) struct Robots {
    /// Only those whose name, maker or model have every word of this: `--search "kuka r1100"`
    #[arg(long, value_name = "TEXT")]
    search: Option<String>,
}

/// List the physical effects that a calibration may have, with their keys and units
#[derive(Args)]
pub(super) struct Effects {}

/// List the robot languages: what is rewritten, left alone, refused
#[derive(Args)]
pub(super) struct Languages {}

fn tell(found: &impl Report, output: Output) -> Result<Answer, Failure> {
    finish(&Files::default(), found, Ending::default(), output)
}

impl Robots {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        tell(&catalogue::robots(self.search.as_deref())?, output)
    }
}

impl Effects {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        tell(&catalogue::effects(), output)
    }
}

impl Languages {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        tell(&catalogue::languages(), output)
    }
}
