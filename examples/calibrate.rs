//! Measurements in, a calibrated profile out: `cargo run --example calibrate`.

use poseshift::identify::calibration::Options;
use poseshift::program::Source;
use poseshift::task::{ProfileFile, Rows, Said, calibrate::calibrate};
use std::error::Error;

/// The example; an error where its result is not what it should be.
pub fn main() -> Result<(), Box<dyn Error>> {
    let (nominal, measured) = support::nominal_and_measured("")?;
    let rows = Rows::read(&[measured], &Said::default(), &nominal.profile)?;
    let found = calibrate(&nominal, rows, &Options::default(), &mut || ())?;
    let (before, after) = (&found.found.frames_only_quality, &found.found.after);
    let (before, after) = (before.position, after.position);
    let (Some(before), Some(after)) = (before, after) else {
        return Err("no positions were measured".into());
    };
    println!(
        "frames alone: mean {:.6} m; calibrated: mean {:.6} m",
        before.mean, after.mean
    );
    let yaml = found.profile_text(&nominal, Some("2026-01-31"))?;
    let calibrated = ProfileFile::read(&Source::new("calibrated.yaml", yaml.into_bytes()))?;
    println!("{} effects identified", calibrated.profile.effects.len());
    if after.mean > before.mean / 4.0 {
        return Err("the calibration explains too little".into());
    }
    Ok(())
}

// the suite runs both examples that use it
#[path = "support/mod.rs"]
#[allow(clippy::duplicate_mod)]
mod support;
