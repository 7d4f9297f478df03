//! Joint angles of the real arm for many poses at once: `cargo run --example inverse_of_an_array`.

use poseshift::inverse::{Status, Targets, solve_batch};
use poseshift::model::{Conditions, forward_batch, profile::Profile};
use poseshift::task::{fk::Which, ik::inverse};
use std::error::Error;

/// The example; an error where its result is not what it should be.
pub fn main() -> Result<(), Box<dyn Error>> {
    let profile = Profile::from_yaml(include_str!("../robots/abb_irb120_thesis.yaml"))?;
    let tool = profile.tool("artifact").ok_or("no such tool")?;
    let inverse = inverse(&profile, &tool, Which::Real, Conditions::default())?;
    let near: Vec<[f64; 6]> = (0..1000)
        .map(|k| [f64::from(k) * 1e-3, 0.3, 0.2, 0.1, 1.0, 0.0])
        .collect();
    let wanted = forward_batch(&inverse.real, &inverse.conditions, &near);
    let branches: Vec<_> = near.iter().map(|q| inverse.arm.posture(q).0).collect();
    let found = solve_batch(
        &inverse,
        Targets {
            wanted: &wanted,
            branches: &branches,
            near: &near,
        },
    );
    let reached = found
        .iter()
        .filter(|one| one.status == Status::Converged)
        .count();
    println!("{reached} of {} poses reached", found.len());
    // forward and back is where it began
    let apart = |(found, near): (&[f64; 6], &[f64; 6])| {
        let apart = found.iter().zip(near).map(|(a, b)| (a - b).abs());
        apart.fold(0.0, f64::max)
    };
    let joints: Vec<[f64; 6]> = found.iter().map(|one| one.q).collect();
    let worst = joints.iter().zip(&near).map(apart).fold(0.0, f64::max);
    println!("joints agree within {worst:.1e} rad");
    if reached < near.len() || worst > 1e-6 {
        return Err("the inverse does not undo the forward kinematics".into());
    }
    Ok(())
}
