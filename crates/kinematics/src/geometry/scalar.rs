//! The numbers that every equation is written over.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A real number: a plain `f64`, a dual number that carries derivatives, or several `f64` side by
/// side.
///
/// An equation written once over `Scalar` gives its value, its exact derivatives and its vectorised
/// batch form. No comparison says which of two ways to go, since lanes may disagree: use
/// [`Scalar::choose_less`]. Only a way that is right for all may be cut short, by
/// [`Scalar::every_below`].
pub trait Scalar:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + Send
    + Sync
    + 'static
{
    /// The number that has this value and no derivative, in every lane.
    fn constant(value: f64) -> Self;
    /// Square root; the derivative at zero is taken as zero.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Exponential.
    #[must_use]
    fn exp(self) -> Self;
    /// Sine and cosine of an angle in radians, |angle| < 1e5.
    fn sin_cos(self) -> (Self, Self);
    /// Angle of the point (x, y) = (`other`, `self`) in (−π, π].
    #[must_use]
    fn atan2(self, other: Self) -> Self;
    /// `then` where `self < limit`, `otherwise` elsewhere.
    #[must_use]
    fn choose_less(self, limit: Self, then: Self, otherwise: Self) -> Self;
    /// Whether the value is below `limit` in every lane.
    fn every_below(self, limit: f64) -> bool;

    /// The nearest whole number, |self| < 2^51; its derivative is zero.
    #[must_use]
    fn round(self) -> Self;

    /// Zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::constant(0.0)
    }

    /// One.
    #[inline(always)]
    fn one() -> Self {
        Self::constant(1.0)
    }

    /// Absolute value.
    #[inline(always)]
    #[must_use]
    fn abs(self) -> Self {
        self.choose_less(Self::zero(), -self, self)
    }

    /// The larger of two.
    #[inline(always)]
    #[must_use]
    fn max(self, other: Self) -> Self {
        self.choose_less(other, other, self)
    }

    /// The smaller of two.
    #[inline(always)]
    #[must_use]
    fn min(self, other: Self) -> Self {
        self.choose_less(other, self, other)
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        f64::exp(self)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }
    #[inline(always)]
    fn atan2(self, other: Self) -> Self {
        elementary::atan2(self, other)
    }
    #[inline(always)]
    fn choose_less(self, limit: Self, then: Self, otherwise: Self) -> Self {
        if self < limit { then } else { otherwise }
    }
    #[inline(always)]
    fn every_below(self, limit: f64) -> bool {
        self < limit
    }
    #[inline(always)]
    fn round(self) -> Self {
        (self + elementary::ROUND) - elementary::ROUND
    }
}

/// Branch-free elementary functions, so that a loop over lanes becomes vector instructions.
///
/// Reduction and polynomials as in S. L. Moshier's Cephes library (sin.c, atan.c): the coefficients
/// are its published minimax constants. Error below 2 units in the last place, tested against the
/// standard library.
pub(super) mod elementary {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

    /// π/4 in three parts whose products with small integers are exact.
    const PI_4: [f64; 3] = [
        7.853_981_256_484_985e-1,
        3.774_894_707_930_798e-8,
        2.695_151_429_079_059_5e-15,
    ];
    /// Adding and subtracting 1.5·2⁵² rounds to the nearest integer.
    pub(crate) const ROUND: f64 = 6_755_399_441_055_744.0;

    /// Sine and cosine, |x| < 1e5.
    #[inline(always)]
    pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
        // x = j·π/2 + z with |z| ≤ π/4
        let shifted = x * std::f64::consts::FRAC_2_PI + ROUND;
        let j = shifted - ROUND;
        let quadrant = shifted.to_bits();
        let twice = 2.0 * j;
        let z = ((x - twice * PI_4[0]) - twice * PI_4[1]) - twice * PI_4[2];
        let zz = z * z;
        let s = (((((1.589_623_015_765_465_7e-10 * zz - 2.505_074_776_285_780_7e-8) * zz
            + 2.755_731_362_138_572_5e-6)
            * zz
            - 1.984_126_982_958_954e-4)
            * zz
            + 8.333_333_333_322_118e-3)
            * zz
            - 1.666_666_666_666_663e-1)
            * zz
            * z
            + z;
        let c = (((((-1.135_853_652_138_768_2e-11 * zz + 2.087_570_084_197_473e-9) * zz
            - 2.755_731_417_929_674e-7)
            * zz
            + 2.480_158_728_885_17e-5)
            * zz
            - 1.388_888_888_887_305_6e-3)
            * zz
            + 4.166_666_666_666_659e-2)
            * zz
            * zz
            - 0.5 * zz
            + 1.0;
        let odd = quadrant & 1 == 1;
        let (sine, cosine) = if odd { (c, s) } else { (s, c) };
        let sine_sign = (quadrant & 2) << 62;
        let cosine_sign = ((quadrant.wrapping_add(1)) & 2) << 62;
        (
            f64::from_bits(sine.to_bits() ^ sine_sign),
            f64::from_bits(cosine.to_bits() ^ cosine_sign),
        )
    }

    /// Angle of the point (x, y) in (−π, π]; zero at the origin.
    #[inline(always)]
    pub(crate) fn atan2(y: f64, x: f64) -> f64 {
        let (ax, ay) = (x.abs(), y.abs());
        let swap = ay > ax;
        let (low, high) = if swap { (ax, ay) } else { (ay, ax) };
        let t = if high > 0.0 { low / high } else { 0.0 };
        // atan(t) = π/4 + atan((t − 1)/(t + 1)) above tan(π/8)-like threshold
        let large = t > 0.66;
        let u = if large { (t - 1.0) / (t + 1.0) } else { t };
        let z = u * u;
        let p = ((((-8.750_608_600_031_904e-1 * z - 1.615_753_718_733_365_2e1) * z
            - 7.500_855_792_314_705e1)
            * z
            - 1.228_866_684_490_136_2e2)
            * z
            - 6.485_021_904_942_025e1)
            * z;
        let q = ((((z + 2.485_846_490_142_306_2e1) * z + 1.650_270_098_316_988_7e2) * z
            + 4.328_810_604_912_903e2)
            * z
            + 4.853_903_996_359_137e2)
            * z
            + 1.945_506_571_482_614e2;
        let base = if large { FRAC_PI_4 } else { 0.0 };
        let rest = if large {
            3.061_616_997_868_383e-17
        } else {
            0.0
        };
        let small = base + (u * (p / q) + u + rest);
        let first = if swap { FRAC_PI_2 - small } else { small };
        let half = if x < 0.0 { PI - first } else { first };
        if y < 0.0 { -half } else { half }
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        /// Units in the last place of one that a result may differ from the standard library's.
        const TOLERANCE: f64 = 4.0e-16;

        #[test]
        fn sine_and_cosine_agree_with_the_standard_library() {
            for k in -200_000..200_000_i32 {
                let x = f64::from(k) * 0.000_137;
                let (s, c) = sin_cos(x);
                assert!(
                    (s - x.sin()).abs() < TOLERANCE && (c - x.cos()).abs() < TOLERANCE,
                    "{x}"
                );
            }
        }

        #[test]
        fn small_angles_keep_their_relative_precision() {
            for k in 1..300 {
                let x = 0.7_f64.powi(k);
                let (s, _) = sin_cos(x);
                assert!(
                    (s / x.sin() - 1.0).abs() < TOLERANCE
                        && (atan2(x, 1.0) / x.atan() - 1.0).abs() < TOLERANCE,
                    "{x}"
                );
            }
        }

        #[test]
        fn arc_tangent_agrees_in_every_quadrant_and_on_the_axes() {
            for k in 0..100_000_i32 {
                let a = f64::from(k) * 6.3e-5 - 3.1;
                let (y, x) = (a.sin() * 3.7, a.cos() * 3.7);
                assert!((atan2(y, x) - y.atan2(x)).abs() < 2.0 * TOLERANCE, "{a}");
            }
            for (y, x) in [
                (0.0, 1.0),
                (0.0, -1.0),
                (1.0, 0.0),
                (-1.0, 0.0),
                (0.0, 0.0),
                (2.0, 2.0),
                (-2.0, -2.0),
            ] {
                assert!(
                    (atan2(y, x) - y.atan2(x)).abs() < 2.0 * TOLERANCE,
                    "{y} {x}"
                );
            }
        }
    }
}
