//! `completions` and `man`: what shells and readers want to know of the command line.

use super::ending::{Said, deliver};
use super::files::Files;
use super::{Answer, CommandLine, Output};
use crate::task::{Failure, shell};
use clap::{Args, CommandFactory};

/// Print a completion script for a shell
#[derive(Args)]
pub(super) struct Completions {
    /// The shell
    shell: clap_complete::Shell,
}

/// Print the manual page
#[derive(Args)]
pub(super) struct Man {}

impl Completions {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let mut text = Vec::new();
        clap_complete::generate(
            self.shell,
            &mut CommandLine::command(),
            "poseshift",
            &mut text,
        );
        let said = if output.json {
            Said::json(&shell::Completions {
                shell: self.shell.to_string(),
                script: whole(text)?,
            })?
        } else {
            Said::data(text)
        };
        deliver(&Files::default(), &[], said, Answer::Yes)
    }
}

impl Man {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let mut text = Vec::new();
        let command = CommandLine::command();
        let mut page = |command: clap::Command| {
            clap_mangen::Man::new(command)
                .render(&mut text)
                .map_err(|error| Failure::internal(error.to_string()))
        };
        page(command.clone())?;
        for sub in command.get_subcommands() {
            page(sub.clone())?;
        }
        let said = if output.json {
            Said::json(&shell::Manual { page: whole(text)? })?
        } else {
            Said::data(text)
        };
        deliver(&Files::default(), &[], said, Answer::Yes)
    }
}

fn whole(text: Vec<u8>) -> Result<String, Failure> {
    String::from_utf8(text).map_err(|error| Failure::internal(error.to_string()))
}
