//! Denavit–Hartenberg parameters in the classic (distal) convention from rows of ours.

use super::Link;
use crate::geometry::{Pose, Rotation, Vector, cross, dot, norm, scale};

/// Below this sine two axes are parallel as far as numbers tell.
const PARALLEL_SINE: f64 = 1e-12;

/// One row `Rz(θ + q) · Tz(d) · Tx(a) · Rx(α)`, metres and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClassicRow {
    /// Angle about the joint's own axis where the joint stands at zero.
    pub theta_rad: f64,
    /// Distance along the joint's own axis.
    pub d_m: f64,
    /// Distance to the next axis.
    pub a_m: f64,
    /// Angle to the next axis.
    pub alpha_rad: f64,
}

/// `before · Π Rz(θi + qi) · Tz(di) · Tx(ai) · Rx(αi)`, exactly the chain of rows with β: where β
/// is not zero, the row goes over the common normal of the two axes. That of nearly parallel axes
/// lies far away; the d of the rows next to it are large and cancel, as in the factory calibrations
/// of Universal Robots.
///
/// # Source
/// J. Denavit, R. S. Hartenberg, "A kinematic notation for lower-pair mechanisms based on
/// matrices", J. Appl. Mech. 22 (1955).
#[must_use]
pub fn classic(rows: &[Link; 6]) -> (Pose, [ClassicRow; 6]) {
    let mut all: [ClassicRow; 6] = std::array::from_fn(|i| ClassicRow {
        theta_rad: rows[i].theta_rad,
        d_m: rows[i].d_m,
        a_m: 0.0,
        alpha_rad: 0.0,
    });
    for i in 0..5 {
        let step = step(&rows[i + 1]);
        all[i].theta_rad += step.turn_before;
        all[i].d_m += step.shift_before;
        (all[i].a_m, all[i].alpha_rad) = (step.a_m, step.alpha_rad);
        all[i + 1].theta_rad += step.turn_behind;
        all[i + 1].d_m += step.shift_behind;
    }
    let first = Pose {
        rotation: Rotation::about_x(rows[0].alpha_rad) * Rotation::about_y(rows[0].beta_rad),
        translation: [rows[0].a_m, 0.0, 0.0],
    };
    (first, all)
}

/// From one axis to the next: `Rz · Tz · Tx(a) · Rx(α) · Tz · Rz`.
struct Step {
    turn_before: f64,
    shift_before: f64,
    a_m: f64,
    alpha_rad: f64,
    shift_behind: f64,
    turn_behind: f64,
}

fn step(row: &Link) -> Step {
    let plain = Step {
        turn_before: 0.0,
        shift_before: 0.0,
        a_m: row.a_m,
        alpha_rad: row.alpha_rad,
        shift_behind: 0.0,
        turn_behind: 0.0,
    };
    if row.beta_rad == 0.0 {
        return plain;
    }
    let turn = Rotation::about_x(row.alpha_rad) * Rotation::about_y(row.beta_rad);
    let (z, next): (Vector, Vector) = ([0.0, 0.0, 1.0], turn.axis(2));
    let out = cross(z, next);
    let sine = norm(out);
    if sine < PARALLEL_SINE {
        return plain;
    }
    // along the normal as x points where that can be known
    let side = if out[0] < 0.0 { -1.0 } else { 1.0 };
    let normal = scale(side / sine, out);
    let between = [row.a_m, 0.0, 0.0];
    let shift_before = dot(cross(between, next), out) / (sine * sine);
    let along = dot(cross(between, z), out) / (sine * sine);
    Step {
        turn_before: normal[1].atan2(normal[0]),
        shift_before,
        a_m: dot(between, normal),
        alpha_rad: (side * sine).atan2(next[2]),
        shift_behind: -along,
        turn_behind: dot(cross(normal, turn.axis(0)), next).atan2(dot(normal, turn.axis(0))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ours(row: &Link, q: f64) -> Pose {
        Pose {
            rotation: Rotation::about_x(row.alpha_rad) * Rotation::about_y(row.beta_rad),
            translation: [row.a_m, 0.0, 0.0],
        } * Pose::from_rotation(Rotation::about_z(row.theta_rad + q))
            * Pose::from_translation(0.0, 0.0, row.d_m)
    }

    #[test]
    fn classic_rows_are_the_same_chain() {
        let h = std::f64::consts::FRAC_PI_2;
        for bend in [0.0, 1e-6, 3e-4, -2e-3, 0.4] {
            let row = |alpha_rad, a_m, theta_rad, d_m| Link {
                alpha_rad,
                a_m,
                beta_rad: bend,
                theta_rad,
                d_m,
            };
            let rows = [
                row(0.1, 0.02, 0.3, 0.29),
                row(-h + 1e-4, 0.01, -h, 0.0),
                row(2e-4, 0.27, 0.0, 0.001),
                row(-h, 0.07, 0.2, 0.302),
                row(h, 0.0, 0.0, 0.0),
                row(-h, 0.0, h, 0.072),
            ];
            let (before, table) = classic(&rows);
            for k in 0..50 {
                let q: [f64; 6] =
                    std::array::from_fn(|i| (f64::from(k) * (i as f64 + 1.3)).sin() * 2.5);
                let mut expected = Pose::identity();
                let mut found = before;
                for i in 0..6 {
                    expected = expected * ours(&rows[i], q[i]);
                    let r = &table[i];
                    found = found
                        * Pose::from_rotation(Rotation::about_z(r.theta_rad + q[i]))
                        * Pose::from_translation(0.0, 0.0, r.d_m)
                        * Pose::from_translation(r.a_m, 0.0, 0.0)
                        * Pose::from_rotation(Rotation::about_x(r.alpha_rad));
                }
                let gap = found.separation(&expected);
                assert!(
                    gap.distance_m < 1e-9 && gap.angle_rad < 1e-9,
                    "{bend} {gap:?}"
                );
            }
            assert_eq!((table[5].a_m, table[5].alpha_rad), (0.0, 0.0));
        }
    }
}
