//! Which effect does a profile lack? `cargo run --example diagnose`.

use poseshift::diagnose::Options;
use poseshift::task::{Rows, Said, diagnose::diagnose};
use std::error::Error;

/// The gear of joint 3 runs out.
const HIDDEN: &str =
    "    - {effect: joint_harmonic, joint: 3, order: 1, cos_deg: 0.05, sin_deg: 0}\n";

/// The example; an error where its result is not what it should be.
pub fn main() -> Result<(), Box<dyn Error>> {
    let (nominal, measured) = support::nominal_and_measured(HIDDEN)?;
    let rows = Rows::read(&[measured], &Said::default(), &nominal.profile)?;
    let options = Options {
        quick: true,
        ..Options::default()
    };
    let found = diagnose(&nominal, rows, &options, &mut |_| ())?;
    println!("{}", found.verdict);
    for effect in &found.effects {
        println!("  {}", effect.sentence);
    }
    let named = |id: &str| found.effects.iter().any(|e| e.effect.id() == id);
    if !named("joint_harmonic") {
        return Err("the hidden effect is not named".into());
    }
    Ok(())
}

// the suite runs both examples that use it
#[path = "support/mod.rs"]
#[allow(clippy::duplicate_mod)]
mod support;
