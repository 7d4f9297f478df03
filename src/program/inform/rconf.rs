//! `///RCONF l,m,n,o,p,q,...`: which of the inverse's solutions a rectangular position means.
//!
//! l flip, m lower arm, n wrist centre behind axis S, o, p, q: whether R, T, S stand at 180° or beyond. One RCONF line is for
//! all positions below it, so it is read and never rewritten. Of its data only those are used whose meaning is certain:
//! n, m where n is front (the elbow above or below the line from axis L to the wrist), and o, p, q where they are 0: the axis
//! stands within ±180°. (1 is two ranges: beyond +180° or below −180°.) Flip is not used: the NX100 manual has it where R
//! stands within ±90°, but `1,0,0,0,…`, no flip, is what later controllers write for arms with R near zero.
//!
//! # Limits
//! A correction that takes R, S or T of a MOVJ across ±180° would need another RCONF; such a target is refused
//! (`configuration-kept`).
//!
//! # Source
//! Yaskawa, NX100 data transmission manual, page 4-5, and operator's manual, "Manipulator Types"; DX100 data transmission
//! manual, page 4-5.

use super::lines::words;
use crate::program::Configuration;
use std::f64::consts::PI;

const FRONT: u8 = 1;
const REAR: u8 = 2;
const UPPER: u8 = 32;
const LOWER: u8 = 64;
/// Bits for o, p, q being 0, and the joint of each.
const WITHIN: [(u8, usize); 3] = [(4, 3), (8, 5), (16, 0)];

/// What an RCONF line tells, as the variant of a layout; 0 where it tells nothing.
pub fn variant(text: &[u8]) -> u8 {
    let mut fields = text
        .split(|&b| b == b',')
        .map(|field| words(field).next().unwrap_or_default());
    let mut field = |at: usize| fields.nth(at).unwrap_or_default();
    let (arm, side) = (field(1), field(0));
    let front = match (side, arm) {
        (b"0", b"0") => FRONT | UPPER,
        (b"0", b"1") => FRONT | LOWER,
        (b"0", _) => FRONT,
        (b"1", _) => REAR,
        _ => 0,
    };
    WITHIN.iter().fold(front, |variant, (bit, _)| {
        variant | if field(0) == b"0" { *bit } else { 0 }
    })
}

/// The inverse solutions that a variant allows.
pub fn configuration(variant: u8) -> Configuration {
    let mut joints = [None; 6];
    for (bit, joint) in WITHIN {
        if variant & bit != 0 {
            joints[joint] = Some((-PI, PI));
        }
    }
    let behind_axis_1 = match variant & (FRONT | REAR) {
        FRONT => Some(false),
        REAR => Some(true),
        _ => None,
    };
    Configuration {
        behind_axis_1,
        behind_lower_arm: match variant & (UPPER | LOWER) {
            UPPER => Some(false),
            LOWER => Some(true),
            _ => None,
        },
        joints,
        ..Configuration::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_certain_fields_count() {
        let found = configuration(variant(b"1,0,0,0,0,0,0,0"));
        assert_eq!(found.behind_axis_1, Some(false));
        assert_eq!(found.joint_5_negative, None);
        assert_eq!(found.behind_lower_arm, Some(false));
        let lower = configuration(variant(b"0,1,0"));
        assert_eq!(lower.behind_lower_arm, Some(true));
        let within = Some((-PI, PI));
        assert_eq!(found.joints, [within, None, None, within, None, within]);
        let found = configuration(variant(b"0, 1, 1, 1, -1"));
        assert_eq!((found.behind_axis_1, found.joints), (Some(true), [None; 6]));
        assert_eq!(found.behind_lower_arm, None);
        assert_eq!(configuration(variant(b"")), Configuration::default());
    }
}
