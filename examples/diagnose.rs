//! Which effect does a profile lack? `cargo run --example diagnose`.

use poseshift::diagnose::Options;
use poseshift::task::{Rows, Said, diagnose::diagnose};
use std::error::Error;

/// The example; an error where its result is not what it should be.
pub fn main() -> Result<(), Box<dyn Error>> {
    let (nominal, measured) = support::nominal_and_measured()?;
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
    if found.effects.is_empty() {
        return Err("nothing is named although the geometry differs".into());
    }
    Ok(())
}

// the suite runs both examples that use it
#[path = "support/mod.rs"]
#[allow(clippy::duplicate_mod)]
mod support;
