//! Several numbers side by side.

#![allow(
    clippy::needless_range_loop,
    reason = "one index runs over several arrays"
)]

use super::{Scalar, scalar::elementary};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// `N` numbers on which every operation acts alike; the compiler turns it into vector instructions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Lanes<const N: usize>(pub [f64; N]);

impl<const N: usize> Lanes<N> {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = [0.0; N];
        for i in 0..N {
            out[i] = f(self.0[i], other.0[i]);
        }
        Self(out)
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut out = [0.0; N];
        for i in 0..N {
            out[i] = f(self.0[i]);
        }
        Self(out)
    }
}

impl<const N: usize> Add for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}
impl<const N: usize> Sub for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}
impl<const N: usize> Mul for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}
impl<const N: usize> Div for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}
impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}
impl<const N: usize> AddAssign for Lanes<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
impl<const N: usize> SubAssign for Lanes<N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<const N: usize> Scalar for Lanes<N> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self([value; N])
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
        let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            (sines[i], cosines[i]) = elementary::sin_cos(self.0[i]);
        }
        (Self(sines), Self(cosines))
    }
    #[inline(always)]
    fn atan2(self, other: Self) -> Self {
        self.zip(other, elementary::atan2)
    }
    #[inline(always)]
    fn choose_less(self, limit: Self, then: Self, otherwise: Self) -> Self {
        let mut out = [0.0; N];
        for i in 0..N {
            out[i] = if self.0[i] < limit.0[i] {
                then.0[i]
            } else {
                otherwise.0[i]
            };
        }
        Self(out)
    }
    #[inline(always)]
    fn every_below(self, limit: f64) -> bool {
        // all lanes without a branch
        #[allow(clippy::needless_bitwise_bool)]
        let below = self.0.iter().fold(true, |all, x| all & (*x < limit));
        below
    }
    #[inline(always)]
    fn round(self) -> Self {
        self.map(Scalar::round)
    }
}
