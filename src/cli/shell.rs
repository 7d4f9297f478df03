//! `completions` and `man`: what shells and readers want to know of the command line.

use super::{Answer, CommandLine, screen};
use crate::task::Failure;
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
    pub(super) fn run(&self) -> Result<Answer, Failure> {
        let mut text = Vec::new();
        clap_complete::generate(
            self.shell,
            &mut CommandLine::command(),
            "poseshift",
            &mut text,
        );
        screen::print_data(&mut text.as_slice())?;
        Ok(Answer::Yes)
    }
}

impl Man {
    pub(super) fn run(&self) -> Result<Answer, Failure> {
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
        screen::print_data(&mut text.as_slice())?;
        Ok(Answer::Yes)
    }
}
