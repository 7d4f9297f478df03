//! How far a row is off, in the part of it that is wrong.

use super::problem::Row;
use super::statistics::Miss;
use crate::geometry::units::{DEG, mm_from_m};

/// How far a row is from what is expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Off {
    /// Of its place, or of a distance, metres.
    pub length_m: f64,
    /// Of its orientation, radians; of a pose.
    pub angle_rad: Option<f64>,
    /// A rotation counts as this length for each radian.
    lever_m: f64,
}

impl Off {
    /// Of a row whose place and orientation are off by so much: what their noise says of each is
    /// alike.
    #[must_use]
    pub fn new(row: &Row, length_m: f64, angle_rad: Option<f64>) -> Self {
        Self {
            length_m,
            angle_rad,
            lever_m: row.sigma_m / row.sigma_rad,
        }
    }

    /// What a model misses of a row.
    #[must_use]
    pub fn of(row: &Row, miss: &Miss) -> Self {
        Self::new(row, miss.length_m, miss.angle_rad)
    }

    fn turned_m(&self) -> f64 {
        self.angle_rad.unwrap_or_default() * self.lever_m
    }

    /// The larger of both as a length, metres.
    #[must_use]
    pub fn size_m(&self) -> f64 {
        self.length_m.max(self.turned_m())
    }

    /// The part that is wrong in words: `0.214 mm`, `178.9°`.
    #[must_use]
    pub fn words(&self) -> String {
        match self.angle_rad {
            Some(angle) if self.turned_m() > self.length_m => format!("{:.3}°", angle / DEG),
            _ => format!("{:.3} mm", mm_from_m(self.length_m)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_part_that_is_wrong_is_said() {
        let off = |length_m, angle_rad| Off {
            length_m,
            angle_rad,
            lever_m: 0.3,
        };
        assert_eq!(off(1e-5, Some(3.1)).words(), "177.617°");
        assert_eq!(off(1e-3, Some(1e-4)).words(), "1.000 mm");
        assert_eq!(off(1e-3, None).words(), "1.000 mm");
        assert!((off(1e-3, Some(1e-2)).size_m() - 3e-3).abs() < 1e-12);
    }
}
