//! W, P, R: `R = Rz(R) · Ry(P) · Rx(W)`, degrees.

use crate::geometry::Rotation;
use crate::geometry::units::DEG;

/// Printed with three decimals an angle up to this far beyond a half turn is still 180.000.
const BEYOND_DEG: f64 = 0.0005;

/// The rotation of W, P, R.
pub(super) fn rotation([w, p, r]: [f64; 3]) -> Rotation {
    Rotation::from_rzryrx([r * DEG, p * DEG, w * DEG])
}

/// W, P, R of a rotation, written as near to the present ones as they can: of the two triples that every rotation has, and
/// of the turns of each angle, those that the file uses.
pub(super) fn nearest(rotation: &Rotation, present: [f64; 3]) -> [f64; 3] {
    let [r, p, w] = rotation.rzryrx(present[0] * DEG).map(|a| a / DEG);
    let usual = unwound([w, p, r], present);
    let other = unwound([w + 180.0, 180.0 - p, r + 180.0], present);
    let far = |angles: &[f64; 3]| (0..3).map(|i| (angles[i] - present[i]).abs()).sum::<f64>();
    // a controller shows P within a quarter turn
    if present[1].abs() > 90.0 && far(&other) < far(&usual) {
        other
    } else {
        usual
    }
}

fn unwound(angles: [f64; 3], present: [f64; 3]) -> [f64; 3] {
    let mut angles = angles;
    for (angle, present) in angles.iter_mut().zip(present) {
        let limit = if present.abs() > 180.0 {
            f64::INFINITY
        } else {
            180.0 + BEYOND_DEG
        };
        *angle -= 360.0 * (*angle / 360.0).round();
        let near = *angle + 360.0 * ((present - *angle) / 360.0).round();
        if near.abs() < limit {
            *angle = near;
        }
    }
    angles
}

#[cfg(test)]
mod tests {
    use super::*;

    fn back(angles: [f64; 3], present: [f64; 3]) -> [f64; 3] {
        nearest(&rotation(angles), present)
    }

    fn close(a: [f64; 3], b: [f64; 3]) -> bool {
        (0..3).all(|i| (a[i] - b[i]).abs() < 1e-9)
    }

    #[test]
    fn w_turns_about_x_first_and_r_about_z_last() {
        let about_z = rotation([0.0, 0.0, 90.0]) * [1.0, 0.0, 0.0];
        assert!((about_z[1] - 1.0).abs() < 1e-12);
        // W turns z to -y, P leaves that, R turns -y to x
        let all = rotation([90.0, 30.0, 90.0]) * [0.0, 0.0, 1.0];
        assert!((all[0] - 1.0).abs() < 1e-12, "{all:?}");
    }

    #[test]
    fn angles_come_back_as_the_file_writes_them() {
        for angles in [
            [-179.532, 0.193, -120.974],
            [180.0, 0.0, 180.0],
            [10.0, 100.0, 20.0],
            [270.0, -20.0, -350.0],
            [30.0, 90.0, 40.0],
        ] {
            let found = back(angles, angles);
            assert!(close(found, angles), "{found:?} {angles:?}");
        }
    }

    #[test]
    fn a_half_turn_keeps_its_sign_only_where_it_prints_the_same() {
        assert!(close(
            back([-179.9997, 0.0, 0.0], [180.0, 0.0, 0.0]),
            [180.0003, 0.0, 0.0]
        ));
        assert!(close(
            back([-179.99, 0.0, 0.0], [180.0, 0.0, 0.0]),
            [-179.99, 0.0, 0.0]
        ));
    }
}
