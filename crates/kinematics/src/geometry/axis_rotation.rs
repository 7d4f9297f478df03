//! Plane rotations by sine and cosine.

use super::Scalar;
use std::ops::Mul;

/// Angles below this, radians, are rotated by a short series.
const SMALL_RAD: f64 = 1.0 / 64.0;

/// A plane rotation by its sine and cosine: what a chain needs of a joint's angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisRotation<S = f64> {
    /// Sine of the angle.
    pub sine: S,
    /// Cosine of the angle.
    pub cosine: S,
}

impl<S: Scalar> AxisRotation<S> {
    /// The rotation by `angle` radians.
    #[inline(always)]
    #[must_use]
    pub fn of(angle: S) -> Self {
        let (sine, cosine) = angle.sin_cos();
        Self { sine, cosine }
    }

    /// No rotation.
    #[inline(always)]
    #[must_use]
    pub fn none() -> Self {
        Self {
            sine: S::zero(),
            cosine: S::one(),
        }
    }

    /// The rotates by six angles.
    #[inline(always)]
    #[must_use]
    pub fn of_each(angles: &[S; 6]) -> [Self; 6] {
        let mut turns = [Self::none(); 6];
        for i in 0..6 {
            turns[i] = Self::of(angles[i]);
        }
        turns
    }

    /// The rotation that takes the x axis to the direction of (x, y); none at the origin.
    #[inline(always)]
    #[must_use]
    pub fn toward(y: S, x: S) -> Self {
        let squared = x * x + y * y;
        let tiny = S::constant(f64::MIN_POSITIVE);
        let scale = S::one() / squared.max(tiny).sqrt();
        Self {
            sine: y * scale,
            cosine: squared.choose_less(tiny, S::one(), x * scale),
        }
    }

    /// The angle in (−π, π].
    #[inline(always)]
    #[must_use]
    pub fn angle(self) -> S {
        self.sine.atan2(self.cosine)
    }

    /// The rotation back.
    #[inline(always)]
    #[must_use]
    pub fn inverse(self) -> Self {
        Self {
            sine: -self.sine,
            ..self
        }
    }

    /// The same angle, or its negative where `sign` is −1.
    #[inline(always)]
    #[must_use]
    pub fn signed(self, sign: S) -> Self {
        Self {
            sine: sign * self.sine,
            ..self
        }
    }

    /// This rotation and `angle` more; cheaper than [`AxisRotation::of`] where the angle is small.
    #[inline(always)]
    #[must_use]
    pub fn and(self, angle: S) -> Self {
        let more = if angle.abs().every_below(SMALL_RAD) {
            Self::of_small(angle)
        } else {
            Self::of(angle)
        };
        self * more
    }

    /// Series to the seventh power: the first term left out is below a tenth of the rounding of
    /// one.
    #[inline(always)]
    fn of_small(angle: S) -> Self {
        let k = S::constant;
        let squared = angle * angle;
        Self {
            sine: angle
                + angle
                    * squared
                    * (squared * (k(1.0 / 120.0) - k(1.0 / 5040.0) * squared) - k(1.0 / 6.0)),
            cosine: k(1.0)
                + squared * (squared * (k(1.0 / 24.0) - k(1.0 / 720.0) * squared) - k(0.5)),
        }
    }
}

impl AxisRotation {
    /// The same turn as constants of another scalar.
    #[inline(always)]
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> AxisRotation<S> {
        AxisRotation {
            sine: S::constant(self.sine),
            cosine: S::constant(self.cosine),
        }
    }
}

impl<S: Scalar> Mul for AxisRotation<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            sine: self.sine * other.cosine + self.cosine * other.sine,
            cosine: self.cosine * other.cosine - self.sine * other.sine,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Dual;

    const TOLERANCE: f64 = 4.0e-16;

    fn gap(a: AxisRotation, b: AxisRotation) -> f64 {
        (a.sine - b.sine).abs().max((a.cosine - b.cosine).abs())
    }

    #[test]
    fn small_and_large_angles_are_added_alike() {
        for k in -4000..4000_i32 {
            let (angle, more) = (0.7 * f64::from(k), 1e-5 * f64::from(k));
            assert!(
                gap(
                    AxisRotation::of(angle).and(more),
                    AxisRotation::of(angle + more)
                ) < 5e-13
            );
            assert!(gap(AxisRotation::of(0.0).and(more), AxisRotation::of(more)) < TOLERANCE);
        }
    }

    #[test]
    fn derivatives_of_a_small_turn_are_those_of_sine_and_cosine() {
        let by_series = AxisRotation::of(Dual::<1>::constant(0.4)).and(Dual::variable(0.015, 0));
        let exact = AxisRotation::of(Dual::<1>::variable(0.415, 0));
        assert!((by_series.sine.slope[0] - exact.sine.slope[0]).abs() < 1e-14);
        assert!((by_series.cosine.slope[0] - exact.cosine.slope[0]).abs() < 1e-14);
    }

    #[test]
    fn a_direction_gives_its_angle_and_the_origin_none() {
        assert!(
            gap(
                AxisRotation::toward(3.0 * 2.4_f64.sin(), 3.0 * 2.4_f64.cos()),
                AxisRotation::of(2.4)
            ) < TOLERANCE
        );
        assert_eq!(AxisRotation::toward(0.0, 0.0), AxisRotation::of(0.0));
    }
}
