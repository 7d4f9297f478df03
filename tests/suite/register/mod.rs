//! The measuring side: registration, hand-eye, hexapod, axes.

mod camera;
mod commands;
mod few;
mod mistakes;
mod oracle;
mod part;
mod procedure;
mod recovery;
mod spoiled;
mod sweeps;

use crate::support::table;
use poseshift::geometry::{Pose, Quaternion, Rotation, Vector};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

fn points(path: &str) -> Vec<Vector> {
    let rows = table(path);
    let point =
        |row: &crate::support::Row| row.numbers(["x_mm", "y_mm", "z_mm"]).map(|v| v / 1000.0);
    rows.iter().map(point).collect()
}

fn poses(path: &str) -> Vec<Pose> {
    let pose = |row: &crate::support::Row| {
        let [x, y, z, qw, qx, qy, qz] =
            row.numbers(["x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"]);
        let t = [x, y, z].map(|v| v / 1000.0);
        Pose::from_parts(t, Quaternion([qw, qx, qy, qz]).normalized())
    };
    table(path).iter().map(pose).collect()
}

fn seeded(seed: u64) -> StdRng {
    StdRng::seed_from_u64(seed)
}

/// A normal deviate (Box and Muller).
fn normal(random: &mut StdRng) -> f64 {
    let (u, v): (f64, f64) = (random.random_range(1e-12..1.0), random.random());
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

fn noisy(random: &mut StdRng, p: Vector, sigma: f64) -> Vector {
    p.map(|v| v + sigma * normal(random))
}

fn random_pose(random: &mut StdRng, reach: f64) -> Pose {
    let turn: [f64; 3] = std::array::from_fn(|_| random.random_range(-1.5..1.5));
    Pose {
        rotation: Rotation::from_vector(turn),
        translation: std::array::from_fn(|_| random.random_range(-reach..reach)),
    }
}
