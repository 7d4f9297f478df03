//! `///RCONF l,m,n,o,p,q,...`: which of the inverse's solutions a rectangular position means.
//!
//! l flip, m lower arm, n wrist centre behind axis S, o, p, q: whether R, T, S stand at 180° or
//! beyond. One RCONF line is for all positions below it, so it is read and never rewritten. Of its
//! data those are used whose meaning is known: n, m where n is front (the elbow above or below the
//! line from axis L to the wrist), and o, p, q: 0 is within ±180°, 1 beyond +180° or below −180°.
//! What m says of an arm that reaches to the rear is not known: where both elbows are possible
//! there, the nearer one is assumed, and reported.
//!
//! The flip is stated by controllers of two generations:
//!
//! - DX100 and later write 24 fields. No flip is B below zero: `1,0,0,0,…` is what they write for
//!   arms with R near zero and the tool bent down, also on arms whose R cannot stand beyond ±150°.
//!   *Not verified on a controller.*
//! - The NX100 and earlier write 8. Their manual has flip where R stands within ±90°, no flip where it
//!   stands beyond.
//!
//! # Limits
//! A correction that takes R, S or T of a MOVJ across ±180° would need another RCONF; such a target
//! is refused (`configuration-kept`).
//!
//! # Source
//! Yaskawa, NX100 data transmission manual, page 4-5, and operator's manual, "Manipulator Types";
//! DX100 data transmission manual, page 4-5.

use super::lines::words;
use crate::program::Configuration;
use std::f64::consts::{FRAC_PI_2, PI};

/// What a variant tells of axis S and the lower arm: one of so many.
const SIDES: u8 = 5;
const FRONT: u8 = 1;
const FRONT_UPPER: u8 = 2;
const FRONT_LOWER: u8 = 3;
const REAR: u8 = 4;
/// What it tells of the wrist: one of so many.
const WRISTS: u8 = 5;
const B_POSITIVE: u8 = 1;
const B_NEGATIVE: u8 = 2;
const R_FORWARD: u8 = 3;
const R_BACKWARD: u8 = 4;
/// The joints of o, p and q.
const AXES: [usize; 3] = [3, 5, 0];
/// Fields that controllers before the DX100 write.
const FEW_FIELDS: usize = 8;

/// What an RCONF line tells, as the variant of a layout; 0 where it tells nothing.
pub(super) fn variant(text: &[u8]) -> u8 {
    let mut fields: [&[u8]; 6] = [b""; 6];
    let mut count = 0;
    for field in text.split(|&b| b == b',') {
        if let Some(kept) = fields.get_mut(count) {
            *kept = words(field).next().unwrap_or_default();
        }
        count += 1;
    }
    let [flip, arm, side, axes @ ..] = fields;
    let side = match (side, arm) {
        (b"0", b"0") => FRONT_UPPER,
        (b"0", b"1") => FRONT_LOWER,
        (b"0", _) => FRONT,
        (b"1", _) => REAR,
        _ => 0,
    };
    let wrist = match (flip, count > FEW_FIELDS) {
        (b"0", true) => B_POSITIVE,
        (b"1", true) => B_NEGATIVE,
        (b"0", false) => R_FORWARD,
        (b"1", false) => R_BACKWARD,
        _ => 0,
    };
    let beyond = |axis: &[u8]| match axis {
        b"0" => Some(0),
        b"1" => Some(1),
        _ => None,
    };
    let axes = match axes.map(beyond) {
        [Some(r), Some(t), Some(s)] => 1 + r + 2 * t + 4 * s,
        _ => 0,
    };
    (axes * SIDES + side) * WRISTS + wrist
}

/// Whether a variant tells which of the two ways of the wrist is meant.
pub(super) fn tells_wrist(variant: u8) -> bool {
    !variant.is_multiple_of(WRISTS)
}

/// The inverse solutions that a variant allows.
pub(super) fn configuration(variant: u8) -> Configuration {
    let (wrist, rest) = (variant % WRISTS, variant / WRISTS);
    let (side, axes) = (rest % SIDES, rest / SIDES);
    let mut found = Configuration {
        behind_axis_1: (side != 0).then_some(side == REAR),
        behind_lower_arm: match side {
            FRONT_UPPER => Some(false),
            FRONT_LOWER => Some(true),
            _ => None,
        },
        joint_5_negative: match wrist {
            B_POSITIVE => Some(false),
            B_NEGATIVE => Some(true),
            _ => None,
        },
        partly_understood: side == REAR,
        ..Configuration::default()
    };
    if let Some(axes) = axes.checked_sub(1) {
        for (bit, joint) in AXES.into_iter().enumerate() {
            if axes >> bit & 1 == 1 {
                found.beyond[joint] = Some(PI);
            } else {
                found.joints[joint] = Some((-PI, PI));
            }
        }
    }
    match wrist {
        R_FORWARD => found.joints[3] = Some((-FRAC_PI_2, FRAC_PI_2)),
        R_BACKWARD => {
            found.beyond[3].get_or_insert(FRAC_PI_2);
        }
        _ => {}
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_count_whose_meaning_is_known() {
        let found = configuration(variant(b"1,0,0,0,0,0,0,0"));
        assert_eq!(found.behind_axis_1, Some(false));
        assert_eq!(found.joint_5_negative, None);
        assert_eq!(found.behind_lower_arm, Some(false));
        let backward = Some(FRAC_PI_2);
        assert_eq!(found.beyond, [None, None, None, backward, None, None]);
        let lower = configuration(variant(b"0,1,0,0,0,0"));
        assert_eq!(lower.behind_lower_arm, Some(true));
        let within = Some((-PI, PI));
        assert_eq!(found.joints, [within, None, None, within, None, within]);
        let found = configuration(variant(b"1, 1, 1, 1, -1"));
        assert_eq!((found.behind_axis_1, found.joints), (Some(true), [None; 6]));
        assert_eq!(found.behind_lower_arm, None);
        assert!(found.partly_understood && !lower.partly_understood);
        let found = configuration(variant(b"1,0,0,1,0,1,0,0"));
        let beyond = Some(PI);
        assert_eq!(found.joints, [None, None, None, None, None, within]);
        assert_eq!(found.beyond, [beyond, None, None, beyond, None, None]);
        assert_eq!(configuration(variant(b"")), Configuration::default());
    }

    #[test]
    fn the_flip_is_that_of_the_controllers_generation() {
        let of = |flip: u8, fields: usize| {
            let text = format!("{flip}{}", ",0".repeat(fields - 1));
            let variant = variant(text.as_bytes());
            let found = configuration(variant);
            (
                tells_wrist(variant),
                found.joint_5_negative,
                found.joints[3],
            )
        };
        let within = Some((-PI, PI));
        assert_eq!(of(1, 24), (true, Some(true), within));
        assert_eq!(of(0, 24), (true, Some(false), within));
        assert_eq!(of(0, 8), (true, None, Some((-FRAC_PI_2, FRAC_PI_2))));
        assert_eq!(of(1, 8), (true, None, within));
    }
}
