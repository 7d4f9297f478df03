//! A robot program in, a program with fake targets out: `cargo run --example compensate_program`.

use poseshift::compensate::Options;
use poseshift::program::Source;
use poseshift::task::ProfileFile;
use poseshift::task::compensate::{DespiteErrors, Request, prepare};
use std::error::Error;

/// The example; an error where its result is not what it should be.
pub fn main() -> Result<(), Box<dyn Error>> {
    let profile = include_bytes!("../robots/abb_irb120_thesis.yaml");
    let profile = ProfileFile::read(&Source::new("irb120.yaml", profile.to_vec()))?;
    let program = include_bytes!("../programs/rapid/olp/in/Deburr.mod");
    let sources = [Source::new("Deburr.mod", program.to_vec())];
    let request = Request {
        sources: &sources,
        language: None,
        profile: &profile,
        options: Options::default(),
        force: false,
        max_path_error_mm: None,
        despite_errors: DespiteErrors::Nothing,
    };
    let prepared = prepare(&request)?;
    if prepared.is_refused() {
        return Err("not every target can be compensated".into());
    }
    let s = prepared.compensation.summary;
    println!("{} of {} targets shifted", s.compensated, s.targets);
    println!(
        "mean error {:.6} m before, {:.6} m after",
        s.mean_before_m, s.mean_after_m
    );
    let written = prepared.written()?;
    println!(
        "{}: {} bytes",
        written.sources[0].name,
        written.sources[0].bytes.len()
    );
    // what is left is the rounding of the numbers that the file has
    if s.mean_after_m > s.mean_before_m / 10.0 {
        return Err("the real tool does not come nearer".into());
    }
    Ok(())
}
