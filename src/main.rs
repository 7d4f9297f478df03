//! The command line of poseshift.

fn main() -> std::process::ExitCode {
    poseshift::run_with(std::env::args_os()).into()
}
