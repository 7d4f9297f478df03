//! What must hold for every input.

mod every_arm;
mod inverse;
mod offset_wrist;
mod sides;

use poseshift::model::Mechanism;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

/// Random postures within the limits of an arm.
fn postures(mechanism: &Mechanism, count: usize, seed: u64) -> Vec<[f64; 6]> {
    let mut random = StdRng::seed_from_u64(seed);
    let mut one = || {
        mechanism
            .joints
            .map(|joint| random.random_range(joint.min_rad..joint.max_rad))
    };
    (0..count).map(|_| one()).collect()
}
