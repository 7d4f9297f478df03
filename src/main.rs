//! The command line of poseshift.

fn main() -> std::process::ExitCode {
    poseshift::cli::run()
}
