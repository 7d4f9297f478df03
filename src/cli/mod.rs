//! The command line: the only place with paths, colour and standard output. One file a command.

mod axes;
mod calibrate;
mod catalogue;
mod check;
mod compensate;
mod diagnose;
mod ending;
mod explain;
mod failure;
mod files;
mod handeye;
mod hexapod;
mod kinematics;
mod layout;
mod measurements;
mod plan;
mod profile;
mod programs;
mod progress;
mod register;
mod schema;
mod screen;
mod shell;
mod simulate;
mod validate;
mod values;

use crate::task::{Blame, Failure};
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;

/// Makes an offline-programmed robot path land where the simulation wanted it
#[derive(Parser)]
#[command(
    name = "poseshift",
    version,
    propagate_version = true,
    max_term_width = 100,
    arg_required_else_help = true
)]
#[command(
    after_help = "Exit status: 0 done; 1 done, and the answer is no (nothing is written); 2 could \
        not do it; 3 a fault of poseshift itself."
)]
pub(crate) struct CommandLine {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    output: Output,
}

/// How results are printed.
#[derive(Args, Clone, Copy)]
pub(crate) struct Output {
    /// Print a machine-readable report (JSON) and nothing else
    #[arg(long, global = true)]
    json: bool,
    /// Print less: errors only
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Print more: every finding
    #[arg(short, long, global = true)]
    verbose: bool,
}

#[derive(Subcommand)]
enum Command {
    Compensate(compensate::Compensate),
    Check(check::Check),
    Calibrate(calibrate::Calibrate),
    Validate(validate::Validate),
    Diagnose(diagnose::Diagnose),
    Plan(plan::PlanCommand),
    Simulate(simulate::Simulate),
    Register(register::Register),
    Handeye(handeye::Handeye),
    Hexapod(Box<hexapod::Hexapod>),
    Axes(axes::Axes),
    Fk(kinematics::Fk),
    Ik(kinematics::Ik),
    Profile(profile::ProfileCommand),
    Robots(catalogue::Robots),
    Effects(catalogue::Effects),
    Languages(catalogue::Languages),
    Explain(explain::Explain),
    Schema(schema::Schema),
    Completions(shell::Completions),
    Man(shell::Man),
}

/// How a command ended that did what it was asked.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Answer {
    /// Done.
    Yes,
    /// Done, and the answer is no.
    No,
}

/// Runs the command line with these arguments, the program's own name first.
///
/// Exit status: 0 done; 1 done, and the answer is no; 2 could not do it; 3 a fault of poseshift
/// itself, also a panic.
///
/// # Example
///
/// ```no_run
/// fn main() -> std::process::ExitCode {
///     poseshift::run_with(std::env::args_os()).into()
/// }
/// ```
#[must_use]
pub fn run_with<A>(arguments: impl IntoIterator<Item = A>) -> u8
where
    A: Into<OsString> + Clone,
{
    let arguments: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    ending::remember(&arguments);
    match parsed(arguments) {
        Ok(CommandLine { command, output }) => guarded(|| command.run(output)),
        Err(error) => screen::print_usage(&error),
    }
}

/// The command line of these arguments. What stands behind an option that takes a value is one where
/// it is a negative number: the option says what it may be.
fn parsed(arguments: Vec<OsString>) -> Result<CommandLine, clap::Error> {
    fn with_negative_numbers(command: clap::Command) -> clap::Command {
        let command = command.mut_args(|argument| {
            let has_value = argument.get_action().takes_values() && !argument.is_positional();
            if has_value && !argument.is_allow_hyphen_values_set() {
                argument.allow_negative_numbers(true)
            } else {
                argument
            }
        });
        command.mut_subcommands(with_negative_numbers)
    }
    let mut command = with_negative_numbers(CommandLine::command());
    let matches = command.try_get_matches_from_mut(arguments)?;
    CommandLine::from_arg_matches(&matches).map_err(|error| error.format(&mut command))
}

/// The exit status of what a command does; a panic is a fault of poseshift itself.
fn guarded(command: impl FnOnce() -> Result<Answer, Failure>) -> u8 {
    let before = std::panic::take_hook();
    std::panic::set_hook(Box::new(|panic| {
        let place = panic.location().map(ToString::to_string);
        let message = panic.payload_as_str().unwrap_or("no message");
        let place = place.unwrap_or_else(|| "somewhere".into());
        let failure = Failure::internal(format!("{message} (at {place})"));
        screen::complain(&failure);
    }));
    // a command that panicked is not gone on with
    let answer = std::panic::catch_unwind(std::panic::AssertUnwindSafe(command));
    std::panic::set_hook(before);
    match answer {
        Ok(Ok(Answer::Yes)) => 0,
        Ok(Ok(Answer::No)) => 1,
        Ok(Err(failure)) => {
            screen::complain(&failure);
            match failure.blame {
                Blame::Given => 2,
                Blame::Program => 3,
            }
        }
        Err(_) => 3,
    }
}

impl Command {
    fn run(self, output: Output) -> Result<Answer, Failure> {
        match self {
            Self::Compensate(command) => command.run(output),
            Self::Check(command) => command.run(output),
            Self::Calibrate(command) => command.run(output),
            Self::Validate(command) => command.run(output),
            Self::Diagnose(command) => command.run(output),
            Self::Plan(command) => command.run(output),
            Self::Simulate(command) => command.run(output),
            Self::Register(command) => command.run(output),
            Self::Handeye(command) => command.run(output),
            Self::Hexapod(command) => command.run(output),
            Self::Axes(command) => command.run(output),
            Self::Fk(command) => command.run(output),
            Self::Ik(command) => command.run(output),
            Self::Profile(command) => command.run(output),
            Self::Robots(command) => command.run(output),
            Self::Effects(command) => command.run(output),
            Self::Languages(command) => command.run(output),
            Self::Explain(command) => command.run(output),
            Self::Schema(command) => command.run(output),
            Self::Completions(command) => command.run(output),
            Self::Man(command) => command.run(output),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_of_the_program_is_status_3_and_a_fault_of_what_is_given_2() {
        assert_eq!(guarded(|| Ok(Answer::Yes)), 0);
        assert_eq!(guarded(|| Ok(Answer::No)), 1);
        assert_eq!(guarded(|| Err(Failure::new("no such file"))), 2);
        assert_eq!(guarded(|| Err(Failure::internal("impossible"))), 3);
        assert_eq!(guarded(|| panic!("a pose that is none")), 3);
    }

    #[test]
    fn a_fault_of_the_program_says_how_to_report_it() {
        let said = failure::render(&Failure::internal("impossible"));
        let words: Vec<&str> = said.split_whitespace().collect();
        let said = words.join(" ");
        assert!(said.contains("internal error"), "{said}");
        assert!(said.contains("please report it"), "{said}");
        assert!(!failure::render(&Failure::new("no such file")).contains("report it"));
    }
}
