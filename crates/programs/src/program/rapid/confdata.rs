//! Configuration data: cf1, cf4, cf6 and cfx of a robot with six joints and a spherical wrist.
//!
//! cf1, cf4 and cf6 are the quarter turns of joints 1, 4 and 6: `floor(q / 90°)`. cfx is
//! `4·(wrist centre behind axis 1) + 2·(wrist centre behind lower arm) + (joint 5 negative)`.
//!
//! # Limits
//! Robots with parallel rods, a linear first axis or seven joints use other rules.
//!
//! # Source
//! ABB, Technical reference manual RAPID, confdata. Checked against 209 of 214 targets of programs
//! whose robot is known.

use crate::program::{Configuration, Posture};
use std::f64::consts::FRAC_PI_2;

/// Quarter turns that joints can make.
const MOST_QUARTERS: f64 = 100.0;
/// Joints of cf1, cf4 and cf6, and that of the last bit of cfx: the others hang on none.
pub(super) const JOINTS: [usize; 4] = [0, 3, 5, 4];

/// cf1, cf4, cf6, cfx of a posture.
pub(super) fn confdata(posture: &Posture) -> [f64; 4] {
    let quarter = |joint: usize| (posture.joints_rad[joint] / FRAC_PI_2).floor();
    let bit = |set: bool, value: f64| if set { value } else { 0.0 };
    let cfx = bit(posture.behind_axis_1, 4.0)
        + bit(posture.behind_lower_arm, 2.0)
        + bit(posture.joints_rad[4] < 0.0, 1.0);
    [quarter(0), quarter(3), quarter(5), cfx]
}

/// The inverse solutions that configuration data allow.
pub(super) fn configuration([cf1, cf4, cf6, cfx]: [f64; 4]) -> Configuration {
    let mut joints = [None; 6];
    for (joint, cf) in JOINTS.into_iter().zip([cf1, cf4, cf6]) {
        let whole = cf.fract() == 0.0 && cf.abs() <= MOST_QUARTERS;
        joints[joint] = whole.then_some((cf * FRAC_PI_2, (cf + 1.0) * FRAC_PI_2));
    }
    // 0 to 7 is checked
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let bits = (cfx.fract() == 0.0 && (0.0..=7.0).contains(&cfx)).then_some(cfx as u8);
    let bit = |at: u8| bits.map(|bits| bits >> at & 1 == 1);
    Configuration {
        joint_5_negative: bit(0),
        behind_lower_arm: bit(1),
        behind_axis_1: bit(2),
        joints,
        ranges_suffice: true,
        ..Configuration::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::units::DEG;
    use crate::program::notation;

    fn update(before: &Posture, after: &Posture, present: &mut [f64]) {
        notation::update(confdata, JOINTS, before, after, present);
    }

    fn posture(degrees: [f64; 6]) -> Posture {
        Posture {
            joints_rad: degrees.map(|d| d * DEG),
            behind_axis_1: false,
            behind_lower_arm: false,
        }
    }

    fn same(a: [f64; 4], b: [f64; 4]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
    }

    #[test]
    fn quarters_count_from_zero_and_minus_one_below() {
        let data = confdata(&posture([10.0, 0.0, 0.0, -10.0, -5.0, -190.0]));
        assert!(same(data, [0.0, -1.0, -3.0, 1.0]), "{data:?}");
        let mut behind = posture([179.0, 0.0, 0.0, 90.5, 5.0, 0.0]);
        (behind.behind_axis_1, behind.behind_lower_arm) = (true, true);
        assert!(same(confdata(&behind), [1.0, 1.0, 0.0, 6.0]));
    }

    #[test]
    fn numbers_change_only_where_the_posture_leaves_them() {
        let before = posture([89.9, 0.0, 0.0, 0.005, 5.0, 200.0]);
        let after = posture([90.1, 0.0, 0.0, -0.2, -5.0, 200.1]);
        // right, right on a border, wrong from the start, unknown
        let mut numbers = [0.0, 0.0, -1.0, 9e9];
        update(&before, &after, &mut numbers);
        assert!(same(numbers, [1.0, -1.0, -1.0, 9e9]), "{numbers:?}");
        let mut numbers = [0.0, -1.0, 2.0, 0.0];
        update(&before, &after, &mut numbers);
        assert!(same(numbers, [1.0, -1.0, 2.0, 1.0]), "{numbers:?}");
    }

    #[test]
    fn a_posture_that_stays_within_the_border_keeps_its_numbers() {
        let before = posture([89.99, 0.0, 0.0, 10.0, 5.0, 10.0]);
        let after = posture([90.005, 0.0, 0.0, 10.0, 5.0, 10.0]);
        let mut numbers = [0.0, 0.0, 0.0, 0.0];
        update(&before, &after, &mut numbers);
        assert!(same(numbers, [0.0; 4]), "{numbers:?}");
    }

    #[test]
    fn windows_and_bits_follow_the_numbers() {
        let found = configuration([-1.0, 1.0, 9e9, 5.0]);
        assert_eq!(found.joints[0], Some((-FRAC_PI_2, 0.0)));
        assert_eq!(found.joints[3], Some((FRAC_PI_2, 2.0 * FRAC_PI_2)));
        assert_eq!(found.joints[5], None);
        assert_eq!(
            [
                found.joint_5_negative,
                found.behind_lower_arm,
                found.behind_axis_1
            ],
            [Some(true), Some(false), Some(true)]
        );
        assert_eq!(configuration([0.0, 0.0, 0.0, 8.0]).behind_axis_1, None);
    }
}
