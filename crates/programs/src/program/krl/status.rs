//! S (status) and T (turn).
//!
//! T has a bit for each axis, set where its angle is negative. S: bit 0 the wrist centre lies
//! behind axis 1 (overhead), bit 1 the forearm is bent forward of the stretched arm, bit 2 axis 5
//! is negative; bit 3 is not used, bit 4 marks points of an absolutely accurate robot. Bits of
//! external axes in T, and bits 3 and up of S, are never changed.
//!
//! The arm is stretched where the wrist centre lies on the line through axes 2 and 3: at `A3 = φ =
//! atan(a / d)` with the offset a and the length d of the forearm. Forward of it the wrist centre
//! is in front of the lower arm, so bit 1 is the opposite of "behind the lower arm" for every A3
//! that the axis reaches.
//!
//! # Source
//! KUKA, KUKA System Software, Operating and Programming Instructions for System Integrators,
//! "Status" and "Turn".

use crate::program::notation::truly_changes;
use crate::program::{Configuration, Posture, Source};
use std::ops::Range;

/// Bit of S that an absolutely accurate robot sets.
pub(super) const ABSOLUTELY_ACCURATE: u32 = 16;

/// S of a posture.
pub(super) fn status(posture: &Posture) -> u32 {
    u32::from(posture.behind_axis_1)
        | u32::from(!posture.behind_lower_arm) << 1
        | u32::from(posture.joints_rad[4].sin() < 0.0) << 2
}

/// T of a posture.
pub(super) fn turn(posture: &Posture) -> u32 {
    (0..6).fold(0, |bits, joint| {
        bits | u32::from(posture.joints_rad[joint] < 0.0) << joint
    })
}

/// The inverse solutions that S and T allow.
pub(super) fn configuration(status: Option<u32>, turn: Option<u32>) -> Configuration {
    let bit = |at: u32| status.map(|bits| bits >> at & 1 == 1);
    let window = |joint: u32| {
        turn.map(|bits| {
            if bits >> joint & 1 == 1 {
                (f64::NEG_INFINITY, 0.0)
            } else {
                (0.0, f64::INFINITY)
            }
        })
    };
    let joints = [0, 1, 2, 3, 4, 5].map(window);
    Configuration {
        behind_axis_1: bit(0),
        behind_lower_arm: bit(1).map(|bent| !bent),
        joint_5_negative: bit(2),
        joints,
        ..Configuration::default()
    }
}

/// S with the bits changed that truly change.
pub(super) fn update_status(before: &Posture, after: &Posture, present: u32) -> u32 {
    update(status, |_| 4, 0..3, before, after, present)
}

/// T likewise.
pub(super) fn update_turn(before: &Posture, after: &Posture, present: u32) -> u32 {
    update(turn, |bit| bit as usize, 0..6, before, after, present)
}

fn update(
    of: impl Fn(&Posture) -> u32,
    joint: impl Fn(u32) -> usize,
    bits: Range<u32>,
    before: &Posture,
    after: &Posture,
    present: u32,
) -> u32 {
    bits.fold(present, |bits, at| {
        let is = |posture: &Posture| (of(posture) ^ present) >> at & 1 == 0;
        if truly_changes(before, after, joint(at), is) {
            bits ^ 1 << at
        } else {
            bits
        }
    })
}

/// Writes S or T as whole number or as the bits that stood there, at least as many.
pub(super) fn write(value: u32, old: &[u8], out: &mut Vec<u8>) {
    let text = match old {
        [b'\'', literal @ .., b'\''] => {
            // what stands around the digits stays: the letter, blanks
            let is_digit = |byte: &u8| byte.is_ascii_hexdigit();
            let letter = literal.iter().position(|b| *b != b' ').unwrap_or_default();
            let start = (letter + 1..literal.len()).find(|at| is_digit(&literal[*at]));
            let start = start.unwrap_or(literal.len());
            let width = literal[start..].iter().take_while(|b| is_digit(b)).count();
            let digits = &literal[start..start + width];
            let small = digits.iter().any(u8::is_ascii_lowercase);
            let digits = match literal.get(letter) {
                Some(b'B' | b'b') => format!("{value:0width$b}"),
                _ if small => format!("{value:0width$x}"),
                _ => format!("{value:0width$X}"),
            };
            let around = [&literal[..start], &literal[start + width..]].map(Source::text);
            format!("'{}{digits}{}'", around[0], around[1])
        }
        [b'+', ..] => format!("+{value}"),
        _ => {
            // `2.0` stays `10.0`
            let point = old.iter().position(|&b| b == b'.');
            match point {
                Some(at) => {
                    let decimals = old.len() - at - 1;
                    format!("{value}.{}", "0".repeat(decimals))
                }
                None => value.to_string(),
            }
        }
    };
    out.extend_from_slice(text.as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::units::DEG;

    fn posture(degrees: [f64; 6]) -> Posture {
        Posture {
            joints_rad: degrees.map(|d| d * DEG),
            behind_axis_1: false,
            behind_lower_arm: false,
        }
    }

    #[test]
    fn bits_say_which_axes_are_negative() {
        let mut at = posture([-10.0, -90.0, 90.0, 5.0, -30.0, 170.0]);
        assert_eq!((status(&at), turn(&at)), (0b110, 0b1_0011));
        (at.behind_axis_1, at.behind_lower_arm) = (true, true);
        assert_eq!(status(&at), 0b101);
    }

    #[test]
    fn only_bits_that_truly_change_are_changed() {
        let before = posture([0.05, -90.0, 90.0, -0.0004, 30.0, 10.0]);
        let after = posture([-0.05, -90.1, 90.0, 0.0003, 30.0, 10.0]);
        // A1 crosses; A4 stays at the border; the bit of A6 was wrong before; bit 7 is an external
        // axis
        let present = 0b1010_1010;
        assert_eq!(update_turn(&before, &after, present), 0b1010_1011);
        assert_eq!(update_status(&before, &after, 0b1_0010), 0b1_0010);
        // with its bit as it was A4 would come to -359.995
        let mut crossed = after;
        crossed.joints_rad[3] = 0.005 * DEG;
        assert_eq!(update_turn(&before, &crossed, present), 0b1010_0011);
        let mut flipped = after;
        flipped.joints_rad[4] = -DEG;
        assert_eq!(update_status(&before, &flipped, 0b1_0010), 0b1_0110);
    }

    #[test]
    fn windows_start_at_zero() {
        let found = configuration(Some(0b110), Some(0b10));
        assert_eq!(found.joints[0], Some((0.0, f64::INFINITY)));
        assert_eq!(found.joints[1], Some((f64::NEG_INFINITY, 0.0)));
        assert_eq!(found.behind_axis_1, Some(false));
        assert_eq!(found.behind_lower_arm, Some(false));
        assert_eq!(found.joint_5_negative, Some(true));
        assert_eq!(configuration(None, None), Configuration::default());
    }

    #[test]
    fn bits_are_written_in_the_manner_that_stood_there() {
        for (old, value, new) in [
            ("2", 10, "10"),
            ("'B010'", 6, "'B110'"),
            ("'B000010'", 51, "'B110011'"),
            ("'b10'", 51, "'b110011'"),
            ("'H0a'", 26, "'H1a'"),
            ("'B 010'", 6, "'B 110'"),
            ("' H FF '", 10, "' H 0A '"),
            ("2.0", 6, "6.0"),
        ] {
            let mut out = Vec::new();
            write(value, old.as_bytes(), &mut out);
            assert_eq!(out, new.as_bytes());
        }
    }
}
