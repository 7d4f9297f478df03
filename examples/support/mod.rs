//! What the examples of measurements share: an arm as its maker describes it, and what a tracker
//! saw of a real one.

use poseshift::identify::parameters::Level;
use poseshift::identify::parameters::Selection;
use poseshift::identify::plan::{Constraints, Request};
use poseshift::identify::simulate::Session;
use poseshift::program::Source;
use poseshift::task::{ProfileFile, plan::plan, simulate::simulate};
use std::error::Error;

/// The nominal profile, and simulated measurements of the calibrated one and a `hidden` effect with
/// 20 µm of noise.
pub fn nominal_and_measured(hidden: &str) -> Result<(ProfileFile, Source), Box<dyn Error>> {
    let real = include_str!("../../robots/abb_irb120_thesis.yaml");
    let real = real.replacen("effects:\n", &format!("effects:\n{hidden}"), 1);
    let real = ProfileFile::read(&Source::new("real.yaml", real.into()))?;
    let mut nominal = real.profile.clone();
    nominal.effects.clear();
    let nominal = real.rewritten(&nominal)?;
    let nominal = ProfileFile::read(&Source::new("nominal.yaml", nominal.into_bytes()))?;
    let request = Request {
        count: 60,
        candidates: 500,
        starts: 1,
        seed: 1,
        sigma_m: 50e-6,
        poses: false,
        given: Vec::new(),
        given_stands: Vec::new(),
        stations: 11,
        constraints: Constraints::default(),
    };
    let selection = Selection::level(Level::Geometry);
    let none = |_: &std::path::Path| Err(std::io::ErrorKind::NotFound.into());
    let chosen = plan(
        &nominal,
        None,
        &selection,
        &request,
        None,
        &none,
        &mut |_, _| (),
    )?;
    let joints = Source::new("joints.csv", chosen.csv().into_bytes());
    let session = Session {
        noise_m: 20e-6,
        ..Session::default()
    };
    let seen = simulate(&real, &joints, None, &session)?;
    let csv = seen.csv.ok_or("no measurements")?;
    Ok((nominal, Source::new("measured.csv", csv.into_bytes())))
}
