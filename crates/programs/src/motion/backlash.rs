//! How much of its backlash a joint has taken up: it comes wholly from one side where it has gone
//! that way, since it last turned back, by the width of its backlash or more, over however many
//! moves.

use super::leg::{Leg, STANDSTILL_RAD};

/// Parts in which a path is looked at on which a joint turns back.
const PARTS: u32 = 64;
/// A width that is less is none, radians.
const LEAST_RAD: f64 = 1e-9;

/// What a path does to where a joint stands within its backlash, in parts of its width: it shifts it,
/// and leaves it between two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    by: f32,
    low: f32,
    high: f32,
}

impl Stretch {
    /// Of a joint that stands.
    pub(crate) const NONE: Self = Self {
        by: 0.0,
        low: 0.0,
        high: 1.0,
    };

    /// This, then one way by so many widths.
    fn then(self, by: f64) -> Self {
        #[allow(clippy::cast_possible_truncation)]
        let by = by as f32;
        Self {
            by: self.by + by,
            low: (self.low + by).clamp(0.0, 1.0),
            high: (self.high + by).clamp(0.0, 1.0),
        }
    }

    /// Of a joint that goes through these angles one after the other.
    pub(crate) fn through(angles: &[f64], width_rad: f64) -> Self {
        if width_rad < LEAST_RAD {
            return Self::NONE;
        }
        angles.windows(2).fold(Self::NONE, |stretch, pair| {
            stretch.then((pair[1] - pair[0]) / width_rad)
        })
    }

    /// Of a joint on a path, by where it stands at the beginning, halfway and at the end, where
    /// this says enough: it goes by its width from halfway on, or one way all along. `None` where
    /// it must be looked at more closely.
    pub(crate) fn roughly(
        [start, half, end]: [f64; 3],
        direction: i8,
        width_rad: f64,
    ) -> Option<Self> {
        let forth = |from: f64, to: f64| f64::from(direction) * (to - from);
        let is_taken_up = forth(half, end) >= width_rad;
        let is_one_way =
            forth(start, half) >= -STANDSTILL_RAD && forth(half, end) >= -STANDSTILL_RAD;
        (is_taken_up || is_one_way).then(|| Self::through(&[start, half, end], width_rad))
    }
}

/// The joints at even parts of a path: more finely they are not looked at where they turn back.
pub(crate) fn parts(leg: &Leg, end: &[f64; 6]) -> Vec<[f64; 6]> {
    let mut parts = vec![leg.start];
    for k in 1..PARTS {
        let near = parts[parts.len() - 1];
        parts.push(leg.joints(f64::from(k) / f64::from(PARTS), &near));
    }
    parts.push(*end);
    parts
}

/// Where a joint may stand within its backlash, in parts of its width: 0 where it comes wholly from
/// above, 1 where from below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Within {
    low: f32,
    high: f32,
}

impl Within {
    /// Nobody knows.
    pub(crate) const ANYWHERE: Self = Self {
        low: 0.0,
        high: 1.0,
    };

    /// Behind a path.
    pub(crate) fn behind(self, stretch: &Stretch) -> Self {
        let end = |from: f32| (from + stretch.by).clamp(stretch.low, stretch.high);
        Self {
            low: end(self.low),
            high: end(self.high),
        }
    }

    /// As one or the other.
    pub(crate) fn or(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// How much of the width may be left to take up on the way in a direction.
    pub(crate) fn left(self, direction: i8) -> f64 {
        f64::from(match direction {
            1 => 1.0 - self.low,
            -1 => self.high,
            _ => 1.0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn left(angles: &[f64], direction: i8) -> f64 {
        let stretch = Stretch::through(angles, 0.1);
        Within::ANYWHERE.behind(&stretch).left(direction)
    }

    #[test]
    fn a_joint_takes_its_backlash_up_over_however_many_moves() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-4, "{a} {b}");
        close(left(&[0.0, 0.06], 1), 0.4);
        close(left(&[0.0, 0.06, 0.11], 1), 0.0);
        // back, and again where it was
        close(left(&[0.0, 5.0, 4.96], -1), 0.6);
        close(left(&[0.0, 5.0, 4.96, 4.99], 1), 0.1);
        close(left(&[0.0, 5.0, 4.96, 5.0], 1), 0.0);
        let [one, other] = [[0.0, 5.0], [0.0, -5.0]]
            .map(|angles| Within::ANYWHERE.behind(&Stretch::through(&angles, 0.1)));
        close(one.or(other).left(1), 1.0);
    }

    #[test]
    fn a_path_is_looked_at_closely_where_a_joint_turns_back_on_it() {
        assert!(Stretch::roughly([0.0, 0.02, 0.03], 1, 0.1).is_some());
        assert!(Stretch::roughly([0.0, -0.5, 0.3], 1, 0.1).is_some());
        assert_eq!(Stretch::roughly([0.0, -0.5, -0.45], 1, 0.1), None);
        assert_eq!(Stretch::roughly([0.0, -0.5, -0.7], 1, 0.1), None);
    }
}
