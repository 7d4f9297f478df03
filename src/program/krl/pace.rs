//! Whether a move stops at its target, and its speed where the instruction itself says it.

use crate::program::insert::line_end;
use crate::program::{Pace, number};

/// The number behind `$VEL.CP =` or `$VEL = {CP` of a move's WITH, metres a second.
fn speed(code: &[u8]) -> Option<f64> {
    let capitals = code.to_ascii_uppercase();
    let start = memchr::memmem::find(&capitals, b"$VEL")?;
    let behind = start + memchr::memmem::find(&capitals[start..], b"CP")? + 2;
    let rest = &capitals[behind..];
    let blank = |b: &&u8| matches!(b, b' ' | b'\t' | b'=');
    let rest = &rest[rest.iter().take_while(blank).count()..];
    let digits = rest
        .iter()
        .take_while(|b| b.is_ascii_digit() || **b == b'.')
        .count();
    number::parse(&rest[..digits])
}

/// See [`crate::program::Language::pace`]. $VEL and $APO that other statements set are not followed.
pub(super) fn pace(bytes: &[u8], offset: usize) -> Pace {
    let line = &bytes[offset..line_end(bytes, offset)];
    let code = line.split(|b| *b == b';').next().unwrap_or_default();
    let mut words = code.split(|b| !(b.is_ascii_alphanumeric() || *b == b'_' || *b == b'$'));
    let blends = words.any(|word| {
        [&b"C_DIS"[..], b"C_VEL", b"C_ORI", b"C_PTP", b"C_SPL"]
            .iter()
            .any(|known| word.eq_ignore_ascii_case(known))
    });
    Pace {
        speed_m_s: speed(code),
        zone_m: (!blends).then_some(0.0),
        blends,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_is_cut_where_the_instruction_says_so() {
        let of = |text: &str| pace(text.as_bytes(), 0);
        assert!(of("LIN XP1 c_dis ; seam").cuts_corner());
        let exact = of("LIN XP1 ; C_DIS\nLIN XP2 C_DIS");
        assert_eq!((exact.zone_m, exact.speed_m_s), (Some(0.0), None));
        for text in [
            "SLIN P1 WITH $VEL = {CP 0.25}, $ACC = {CP 2.0} C_SPL",
            "SLIN P1 WITH $VEL.CP=0.25",
        ] {
            assert_eq!(of(text).speed_m_s, Some(0.25), "{text}");
        }
    }
}
