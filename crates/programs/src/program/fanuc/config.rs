//! Configuration data: `CONFIG : 'N U T, 0, 0, 0'` of a robot with six joints and a spherical
//! wrist.
//!
//! | place | written | is | number |
//! |---|---|---|---|
//! | 1 | `N`, `F` | joint 5 is negative, or not (FANUC's sign: a tool that points down has J5 = -90) | 0, 1 |
//! | 2 | `U`, `D` | the wrist centre lies before the lower arm, or behind it | 0, 1 |
//! | 3 | `T`, `B` | the wrist centre lies before axis 1, or behind it | 0, 1 |
//! | 4 to 6 | a whole number | `floor((q + 180°) / 360°)` of joints 1, 4 and 6 | itself |
//!
//! `U` and `D` are the two sides of the stretched arm, on whichever side of axis 1 the wrist is: an
//! arm that leans back until its wrist has passed over axis 1 goes from `U T` to `U B`, as it does
//! not pass the stretched position on the way. In the frame of such an arm the elbow of `U B` lies
//! below the line from shoulder to wrist.
//!
//! # Limits
//! Palletisers, robots with parallel links and SCARAs have other letters; they are not read.
//!
//! # Source
//! Signs and turns: 2466 points of 26 controllers whose tools are known (51 turns of joint 4 and
//! 174 of joint 6 are explained by `N` = negative, none by the opposite); "The perils of six-axis
//! robots" (ONE Robotics, 2013), joints of an R-2000iB/165F that a controller shows: `N U T, 0, 0,
//! 0` at J5 = -51.975. `U`: a controller's `F U B` points next to a joint point J2 = -42.883, J3 =
//! 70.004, J5 = 20, whose wrist is behind axis 1 and before the lower arm on any arm of FANUC's
//! proportions; and in public backups `U B` is common, where `D T` does not occur.

use crate::program::{Configuration, Posture};
use std::f64::consts::{PI, TAU};

/// Turns that joints can make.
const MOST_TURNS: f64 = 100.0;
/// Letters of the flags, by place, then by number.
pub(super) const LETTERS: [[u8; 2]; 3] = [*b"NF", *b"UD", *b"TB"];
/// The joint of each number: that of the first flag (the others hang on none), those of the turns.
pub(super) const JOINTS: [usize; 6] = [4, 4, 4, 0, 3, 5];

/// The six numbers of a posture.
pub(super) fn data(posture: &Posture) -> [f64; 6] {
    let bit = |set: bool| if set { 1.0 } else { 0.0 };
    let turn = |joint: usize| ((posture.joints_rad[joint] + PI) / TAU).floor();
    [
        bit(posture.joints_rad[4] >= 0.0),
        bit(posture.behind_lower_arm),
        bit(posture.behind_axis_1),
        turn(JOINTS[3]),
        turn(JOINTS[4]),
        turn(JOINTS[5]),
    ]
}

/// The inverse solutions that configuration data allow.
pub(super) fn configuration(data: &[f64; 6]) -> Configuration {
    let flag = |at: usize| match data[at] {
        0.0 => Some(false),
        1.0 => Some(true),
        _ => None,
    };
    let mut joints = [None; 6];
    for (joint, turn) in JOINTS.into_iter().zip(data).skip(3) {
        let whole = turn.fract() == 0.0 && turn.abs() <= MOST_TURNS;
        joints[joint] = whole.then_some((turn * TAU - PI, turn * TAU + PI));
    }
    Configuration {
        joint_5_negative: flag(0).map(|flipped| !flipped),
        behind_lower_arm: flag(1),
        behind_axis_1: flag(2),
        joints,
        ..Configuration::default()
    }
}

/// Whether two whole numbers are the same.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.5
}

/// Writes one of the numbers: a letter, or a whole number with the blanks before it that it had.
pub(super) fn write(k: usize, value: f64, old: &[u8], out: &mut Vec<u8>) {
    if let Some([zero, one]) = LETTERS.get(k) {
        out.push(if same(value, 0.0) { *zero } else { *one });
    } else {
        let text = format!("{value:.0}");
        let text = if same(value, 0.0) { "0" } else { &text };
        let blanks = old.iter().take_while(|b| b.is_ascii_whitespace()).count();
        if blanks > 0 {
            let padding = old.len().saturating_sub(text.len()).max(1);
            out.extend(std::iter::repeat_n(b' ', padding));
        }
        out.extend_from_slice(text.as_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::units::DEG;
    use crate::program::notation::update;

    fn posture(degrees: [f64; 6]) -> Posture {
        Posture {
            joints_rad: degrees.map(|d| d * DEG),
            behind_axis_1: false,
            behind_lower_arm: false,
        }
    }

    fn shown(posture: &Posture) -> String {
        let numbers = data(posture).into_iter().enumerate();
        let texts = numbers.map(|(k, value)| {
            let mut out = Vec::new();
            write(k, value, b"0", &mut out);
            String::from_utf8(out).expect("ASCII")
        });
        texts.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn letters_and_turns_are_those_that_a_controller_shows() {
        // joints that a controller shows at one pose for NUT 000 and FUT 000
        let down = posture([7.962, -5.284, -36.250, 77.661, -51.975, -79.273]);
        assert_eq!(shown(&down), "N U T 0 0 0");
        let flipped = posture([7.962, -5.284, -36.250, -102.339, 51.975, 100.727]);
        assert_eq!(shown(&flipped), "F U T 0 0 0");
        let mut far = posture([-180.5, 0.0, 0.0, 180.0, 0.0, 541.0]);
        (far.behind_axis_1, far.behind_lower_arm) = (true, true);
        assert_eq!(shown(&far), "F D B -1 1 2");
    }

    #[test]
    fn numbers_change_only_where_the_posture_leaves_them() {
        let change = |before: [f64; 6], after: [f64; 6], mut present: [f64; 6]| {
            update(
                data,
                JOINTS,
                &posture(before),
                &posture(after),
                &mut present,
            );
            present
        };
        let at = |j5: f64, j6: f64| [10.0, 0.0, 0.0, 20.0, j5, j6];
        let plain = [0.0; 6];
        assert_eq!(change(at(-5.0, 179.9), at(-5.0, 180.1), plain)[5], 1.0);
        // with the turn as it was the robot would come to -179.999
        assert_eq!(change(at(-5.0, 179.9), at(-5.0, 180.001), plain)[5], 1.0);
        assert_eq!(
            change(at(-5.0, -179.99), at(-5.0, -180.009), plain)[5],
            -1.0
        );
        // a target on the border is on either side of it in the file already
        assert_eq!(
            change(at(-5.0, 179.9998), at(-5.0, 180.0003), plain)[5],
            0.0
        );
        assert_eq!(change(at(-0.1, 0.0), at(0.1, 0.0), plain)[0], 1.0);
        // read as right, for files round, and then too far beyond
        let turned = [0.0, 0.0, 0.0, 0.0, 0.0, -1.0];
        assert_eq!(change(at(-5.0, -179.96), at(-5.0, -179.9), turned)[5], 0.0);
        // what was wrong before stays
        assert_eq!(change(at(5.0, 0.0), at(5.1, 0.0), plain), plain);
    }

    #[test]
    fn configuration_names_branch_and_turns() {
        let found = configuration(&[1.0, 0.0, 1.0, 0.0, -1.0, 7.5]);
        let flags = (
            found.joint_5_negative,
            found.behind_lower_arm,
            found.behind_axis_1,
        );
        assert_eq!(flags, (Some(false), Some(false), Some(true)));
        assert_eq!(found.joints[0], Some((-PI, PI)));
        assert_eq!(found.joints[3], Some((-3.0 * PI, -PI)));
        assert_eq!((found.joints[1], found.joints[5]), (None, None));
    }

    #[test]
    fn a_turn_keeps_the_width_of_its_field() {
        let mut out = Vec::new();
        write(5, -1.0, b"  0", &mut out);
        write(5, 0.0, b" -1", &mut out);
        assert_eq!(out, b" -1  0");
    }
}
