//! How fast a move is and how near it must come to its target, from the words behind its points.

use crate::geometry::units::MM;
use crate::program::{Pace, number};

/// Metres a second of `250mm/sec`, `150cm/min`, `40inch/min`.
fn speed(word: &[u8]) -> Option<f64> {
    let digits = word
        .iter()
        .take_while(|b| b.is_ascii_digit() || **b == b'.')
        .count();
    let value = number::parse(&word[..digits])?;
    match word[digits..].to_ascii_lowercase().as_slice() {
        b"mm/sec" => Some(value * MM),
        b"cm/min" => Some(0.01 * value / 60.0),
        b"inch/min" => Some(0.0254 * value / 60.0),
        _ => None,
    }
}

/// See [`crate::program::Language::pace`].
pub(super) fn pace(bytes: &[u8], offset: usize) -> Pace {
    let mut pace = Pace::default();
    let end = memchr::memchr(b';', &bytes[offset..]).map_or(bytes.len(), |length| offset + length);
    let text = &bytes[offset..end];
    // the last bracket of a point
    let behind = memchr::memmem::rfind(text, b"P[")
        .and_then(|at| memchr::memchr(b']', &text[at..]).map(|length| at + length + 1));
    let words = text[behind.unwrap_or(0)..].split(u8::is_ascii_whitespace);
    for word in words.filter(|word| !word.is_empty()) {
        let numbered = |prefix: &[u8]| word.strip_prefix(prefix).and_then(number::parse);
        if word == b"FINE" || numbered(b"CNT") == Some(0.0) {
            pace.zone_m = Some(0.0);
        } else if let Some(radius_mm) = numbered(b"CR") {
            pace.zone_m = Some(radius_mm * MM);
        } else if word.starts_with(b"CNT") {
            pace.blends = true;
        } else {
            pace.speed_m_s = pace.speed_m_s.or(speed(word));
        }
    }
    pace
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speed_and_corner_stand_behind_the_points() {
        let of = |text: &str| pace(text.as_bytes(), 0);
        let fine = of("L P[1:FINE] 250mm/sec FINE ;");
        assert_eq!((fine.speed_m_s, fine.zone_m), (Some(0.25), Some(0.0)));
        let blended = of("C P[1]\n : P[2] 150cm/min CNT50 ;");
        assert!(blended.speed_m_s.is_some_and(|v| (v - 0.025).abs() < 1e-15));
        assert_eq!((blended.zone_m, blended.blends), (None, true));
        assert_eq!(of("L P[1] 100mm/sec CR10 ;").zone_m, Some(10.0 * MM));
        let joint = of("J P[1] 50% CNT0 ;");
        assert_eq!((joint.speed_m_s, joint.zone_m), (None, Some(0.0)));
    }
}
