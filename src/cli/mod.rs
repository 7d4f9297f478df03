//! The command line: the only place with paths, colour and standard output. One file a command.

mod axes;
mod calibrate;
mod catalogue;
mod check;
mod compensate;
mod diagnose;
mod driving;
mod failure;
mod files;
mod handeye;
mod hexapod;
mod icp;
mod import_ur;
mod kinematics;
mod layout;
mod measurements;
mod page;
mod plan;
mod points;
mod profile;
mod progress;
mod register;
mod registration;
mod shell;
mod simulate;
mod table;
mod validate;
mod values;
mod way;

use clap::{Args, Parser, Subcommand};
use failure::Failure;
use std::process::ExitCode;

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
    after_help = "Exit status: 0 done; 1 done, and the answer is no (nothing is written); 2 could not do it."
)]
pub struct CommandLine {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    output: Output,
}

/// How results are told.
#[derive(Args, Clone, Copy)]
pub struct Output {
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

/// Runs the program with the arguments of this process.
#[must_use]
pub fn run() -> ExitCode {
    let CommandLine { command, output } = CommandLine::parse();
    let answer = match command {
        Command::Compensate(command) => command.run(output),
        Command::Check(command) => command.run(output),
        Command::Calibrate(command) => command.run(output),
        Command::Validate(command) => command.run(output),
        Command::Diagnose(command) => command.run(output),
        Command::Plan(command) => command.run(output),
        Command::Simulate(command) => command.run(output),
        Command::Register(command) => command.run(output),
        Command::Handeye(command) => command.run(output),
        Command::Hexapod(command) => command.run(output),
        Command::Axes(command) => command.run(output),
        Command::Fk(command) => command.run(output),
        Command::Ik(command) => command.run(output),
        Command::Profile(command) => command.run(output),
        Command::Robots(command) => command.run(output),
        Command::Effects(command) => command.run(output),
        Command::Languages(command) => command.run(output),
        Command::Completions(command) => command.run(),
        Command::Man(command) => command.run(),
    };
    match answer {
        // whoever reads the output may have gone: nothing to tell
        Ok(Answer::Yes) | Err(Failure::Pipe) => ExitCode::SUCCESS,
        Ok(Answer::No) => ExitCode::from(1),
        Err(failure) => {
            anstream::eprintln!("{}", failure.render());
            ExitCode::from(2)
        }
    }
}

/// Prints text to standard output.
fn print(text: &str) -> Result<(), Failure> {
    use std::io::Write;
    let mut out = anstream::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(Failure::output)
}

/// Prints a JSON document to standard output.
fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    print(&json_text(value))
}

/// A JSON document as it is printed.
fn json_text(value: &impl serde::Serialize) -> String {
    serde_json::to_string_pretty(value).expect("a report holds only finite numbers and text keys")
        + "\n"
}
