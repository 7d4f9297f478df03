//! How fast a move is and how near it must come to its target, from the tags behind its position.

use super::lines::words;
use crate::geometry::units::MM;
use crate::program::insert::line_end;
use crate::program::{Pace, number};

/// See [`crate::program::Language::pace`]. Speeds are in mm/s, as controllers are set up unless they are changed.
pub(super) fn pace(bytes: &[u8], offset: usize) -> Pace {
    let mut pace = Pace::default();
    for word in words(&bytes[offset..line_end(bytes, offset)]) {
        let tagged = |tag: &[u8]| word.strip_prefix(tag).and_then(number::parse);
        if let Some(speed_mm_s) = tagged(b"V=") {
            pace.speed_m_s = Some(speed_mm_s * MM);
        } else if let Some(level) = tagged(b"PL=") {
            // positioning level 0 is exact
            if level == 0.0 {
                pace.zone_m = Some(0.0);
            } else {
                pace.blends = true;
            }
        } else if let Some(radius_mm) = tagged(b"CR=") {
            pace.zone_m = Some(radius_mm * MM);
        }
    }
    pace
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speed_and_corner_are_tags_of_the_line() {
        let of = |text: &str| pace(text.as_bytes(), 0);
        let exact = of("MOVL C00001 V=30.0 PL=0\r\nMOVL C00002 V=50.0 PL=2");
        assert_eq!((exact.speed_m_s, exact.zone_m), (Some(0.03), Some(0.0)));
        assert!(of("MOVJ C00001 VJ=5.00 PL=2").cuts_corner());
        assert_eq!(of("MOVJ C00001 VJ=5.00"), Pace::default());
        assert_eq!(of("MOVL C00001 V=5 CR=12.5").zone_m, Some(12.5 * MM));
    }
}
