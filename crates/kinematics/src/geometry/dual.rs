//! Dual numbers: a value with `N` exact partial derivatives.

use super::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A value and its partial derivatives with respect to `N` variables (forward-mode
/// differentiation).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// Partial derivatives, one a variable.
    pub slope: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The `index`-th variable with this value.
    #[must_use]
    pub fn variable(value: f64, index: usize) -> Self {
        let mut slope = [0.0; N];
        slope[index] = 1.0;
        Self { value, slope }
    }

    /// A function of this number with value `value` and derivative `derivative` there (chain rule).
    #[inline(always)]
    fn chain(self, value: f64, derivative: f64) -> Self {
        Self {
            value,
            slope: self.slope.map(|s| derivative * s),
        }
    }

    #[inline(always)]
    fn combine(self, other: Self, value: f64, from_self: f64, from_other: f64) -> Self {
        Self {
            value,
            slope: std::array::from_fn(|i| from_self * self.slope[i] + from_other * other.slope[i]),
        }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.combine(other, self.value + other.value, 1.0, 1.0)
    }
}
impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.combine(other, self.value - other.value, 1.0, -1.0)
    }
}
impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.combine(other, self.value * other.value, other.value, self.value)
    }
}
impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        self.combine(other, value, other.value.recip(), -value / other.value)
    }
}
impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}
impl<const N: usize> AddAssign for Dual<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
impl<const N: usize> SubAssign for Dual<N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<const N: usize> Scalar for Dual<N> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self {
            value,
            slope: [0.0; N],
        }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, if root > 0.0 { 0.5 / root } else { 0.0 })
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = Scalar::sin_cos(self.value);
        (self.chain(sine, cosine), self.chain(cosine, -sine))
    }
    #[inline(always)]
    fn atan2(self, other: Self) -> Self {
        let squared = self.value * self.value + other.value * other.value;
        let inverse = if squared > 0.0 { squared.recip() } else { 0.0 };
        self.combine(
            other,
            Scalar::atan2(self.value, other.value),
            other.value * inverse,
            -self.value * inverse,
        )
    }
    #[inline(always)]
    fn choose_less(self, limit: Self, then: Self, otherwise: Self) -> Self {
        if self.value < limit.value {
            then
        } else {
            otherwise
        }
    }
    #[inline(always)]
    fn every_below(self, limit: f64) -> bool {
        self.value < limit
    }
    #[inline(always)]
    fn round(self) -> Self {
        Self::constant(self.value.round())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::DualNum;

    fn by_peer(x: f64, y: f64) -> (f64, [f64; 2]) {
        let (value, slope) = num_dual::gradient(
            |v| {
                let (x, y) = (v[0], v[1]);
                (x * y).sin() / (x * x + y).sqrt() + (-x).exp() - y.cos()
            },
            &nalgebra::Vector2::new(x, y),
        );
        (value, [slope[0], slope[1]])
    }

    #[test]
    fn derivatives_agree_with_an_independent_dual_number_crate() {
        for k in 1..200 {
            let (a, b) = (0.013 * f64::from(k), 1.9 - 0.007 * f64::from(k));
            let (x, y) = (Dual::<2>::variable(a, 0), Dual::<2>::variable(b, 1));
            let mine = (x * y).sin_cos().0 / (x * x + y).sqrt() + (-x).exp() - y.sin_cos().1;
            let (value, slope) = by_peer(a, b);
            assert!((mine.value - value).abs() < 1e-14);
            for i in 0..2 {
                assert!((mine.slope[i] - slope[i]).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn arc_tangent_slope_is_that_of_the_polar_angle() {
        let angle = Dual::<1>::variable(2.4, 0);
        let (s, c) = angle.sin_cos();
        let back = (s * Dual::constant(3.0)).atan2(c * Dual::constant(3.0));
        assert!((back.value - 2.4).abs() < 1e-15 && (back.slope[0] - 1.0).abs() < 1e-15);
    }
}
