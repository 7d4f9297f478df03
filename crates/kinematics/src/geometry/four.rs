//! Four numbers side by side.

use super::{Scalar, scalar::elementary};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// How many numbers stand side by side.
pub const WIDTH: usize = 4;

/// Four numbers on which every operation acts alike; the compiler turns it into vector
/// instructions.
///
/// The four are written out: the kernels hold thousands of operations, and to unroll a loop in each
/// of them took most of the time that this crate is compiled (docs/performance.md has what that
/// costs the batched kernels).
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Four(pub [f64; WIDTH]);

impl Four {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let ([a0, a1, a2, a3], [b0, b1, b2, b3]) = (self.0, other.0);
        Self([f(a0, b0), f(a1, b1), f(a2, b2), f(a3, b3)])
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let [a, b, c, d] = self.0;
        Self([f(a), f(b), f(c), f(d)])
    }
}

impl Add for Four {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}
impl Sub for Four {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}
impl Mul for Four {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}
impl Div for Four {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}
impl Neg for Four {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}
impl AddAssign for Four {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
impl SubAssign for Four {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Scalar for Four {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self([value; WIDTH])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        self.map(f64::exp)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let [a, b, c, d] = self.0;
        let ((sin_a, cos_a), (sin_b, cos_b)) = (elementary::sin_cos(a), elementary::sin_cos(b));
        let ((sin_c, cos_c), (sin_d, cos_d)) = (elementary::sin_cos(c), elementary::sin_cos(d));
        (
            Self([sin_a, sin_b, sin_c, sin_d]),
            Self([cos_a, cos_b, cos_c, cos_d]),
        )
    }
    #[inline(always)]
    fn atan2(self, other: Self) -> Self {
        self.zip(other, elementary::atan2)
    }
    #[inline(always)]
    fn choose_less(self, limit: Self, then: Self, otherwise: Self) -> Self {
        let lane = |i: usize| {
            if self.0[i] < limit.0[i] {
                then.0[i]
            } else {
                otherwise.0[i]
            }
        };
        Self([lane(0), lane(1), lane(2), lane(3)])
    }
    #[inline(always)]
    fn every_below(self, limit: f64) -> bool {
        // all four without a branch
        #[expect(clippy::needless_bitwise_bool, reason = "no branch")]
        {
            let [a, b, c, d] = self.0;
            (a < limit) & (b < limit) & (c < limit) & (d < limit)
        }
    }
    #[inline(always)]
    fn round(self) -> Self {
        self.map(Scalar::round)
    }
}
