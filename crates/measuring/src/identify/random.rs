//! Random numbers that a seed gives again on every machine and in every version.

use std::f64::consts::TAU;

/// A generator of 64-bit numbers.
///
/// # Source
/// G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators" (2014):
/// `SplitMix64`. Normal numbers by G. E. P. Box, M. E. Muller (1958).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Random(u64);

impl Random {
    /// A sequence of its own for each seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Even in [0, 1).
    pub fn even(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Even in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.even()
    }

    /// Normal with mean 0 and standard deviation 1.
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.even()).ln()).sqrt();
        radius * (TAU * self.even()).cos()
    }

    /// A whole number below `count`.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 to count"
    )]
    pub fn below(&mut self, count: usize) -> usize {
        (self.even() * count as f64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_spread_are_those_of_the_distributions() {
        let mut random = Random::new(7);
        let count = 100_000;
        let even: Vec<f64> = (0..count).map(|_| random.even()).collect();
        let normal: Vec<f64> = (0..count).map(|_| random.normal()).collect();
        let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
        let second = |x: &[f64]| x.iter().map(|v| v * v).sum::<f64>() / x.len() as f64;
        assert!((mean(&even) - 0.5).abs() < 0.005 && even.iter().all(|x| (0.0..1.0).contains(x)));
        assert!(mean(&normal).abs() < 0.02 && (second(&normal) - 1.0).abs() < 0.02);
    }
}
