//! Tail probabilities.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor, Normal, StudentsT};
use statrs::function::beta::beta_reg;

/// Probability that chi-squared with `k` degrees of freedom exceeds `x`.
#[must_use]
pub fn chi_squared_tail(x: f64, k: f64) -> f64 {
    match ChiSquared::new(k) {
        Ok(distribution) if x > 0.0 => distribution.sf(x),
        _ => 1.0,
    }
}

/// What chi-squared with `k` degrees of freedom stays below with probability `p`.
#[must_use]
pub fn chi_squared_quantile(p: f64, k: f64) -> f64 {
    ChiSquared::new(k).map_or(k, |distribution| distribution.inverse_cdf(p))
}

/// Probability that the ratio of two mean squares of the same variance, with `a` and `b` degrees of
/// freedom, exceeds `x`.
#[must_use]
pub fn f_tail(x: f64, a: f64, b: f64) -> f64 {
    match FisherSnedecor::new(a, b) {
        Ok(distribution) if x > 0.0 => distribution.sf(x),
        _ => 1.0,
    }
}

/// What this ratio stays below with probability `p`.
#[must_use]
pub fn f_quantile(p: f64, a: f64, b: f64) -> f64 {
    FisherSnedecor::new(a, b).map_or(f64::INFINITY, |distribution| distribution.inverse_cdf(p))
}

/// Probability that this ratio exceeds `x` where the first mean square has the noncentrality
/// `lambda`: F by Poisson's numbers of more degrees of freedom.
///
/// # Source
/// N. L. Johnson, S. Kotz, N. Balakrishnan, *Continuous Univariate Distributions* 2 (1995), 30.10.
#[must_use]
pub fn f_power(x: f64, a: f64, b: f64, lambda: f64) -> f64 {
    let (half, part) = (0.5 * lambda, a * x / (a * x + b));
    if !(x > 0.0 && half.is_finite()) {
        return 1.0;
    }
    let mut below = 0.0;
    let (mut log_weight, mut sum) = (-half, 0.0);
    let mut j = 0.0;
    // terms grow up to the mean `half`, then fall
    while j < half || 1.0 - sum > 1e-12 && j < half + 1e5 {
        let weight = log_weight.exp();
        sum += weight;
        below += weight * beta_reg(0.5 * a + j, 0.5 * b, part);
        j += 1.0;
        log_weight += half.ln() - j.ln();
        if half == 0.0 {
            break;
        }
    }
    (1.0 - below).clamp(0.0, 1.0)
}

/// By how much twice the logarithm of the Bayes factor of `k` parameters stays behind the fall of
/// chi-squared by them, in `n` numbers.
///
/// Their prior is Zellner's with a g of its own, the same for all k of them: several parameters of
/// one effect are as large as one another. Of g it is known that it is hardly above n, as large as
/// Schwarz takes it to be. One parameter costs about `ln n`; several cost the less for each, the
/// less they gain together.
///
/// ```text
/// ∫ (1 + g)^(−k/2) exp(h g / (1 + g)) dg / n (1 + g/n)²
///     =  n eʰ ∫₀¹ u^(k/2) e^(−h u) / (1 + (n − 1) u)² du,          h = gain / 2
/// ```
///
/// # Source
/// F. Liang, R. Paulo, G. Molina, M. A. Clyde, J. O. Berger, "Mixtures of g priors for Bayesian
/// variable selection" (2008): the hyper-g/n prior with a = 4; E. I. George, D. P. Foster,
/// "Calibration and empirical Bayes variable selection" (2000), for a known variance.
#[must_use]
pub fn occam(gain: f64, k: f64, n: f64) -> f64 {
    let half = 0.5 * gain;
    // by the logarithm of u, in which the trapezoidal rule is exact to many digits
    let steps = ((n.ln() + LN_NOTHING) / LN_STEP).ceil();
    let of = |step: f64| {
        let ln_u = -LN_STEP * step;
        let u = ln_u.exp();
        ((0.5 * k + 1.0) * ln_u - half * u).exp() / (1.0 + (n - 1.0) * u).powi(2)
    };
    let (mut sum, mut step) = (0.5 * of(0.0), 1.0);
    while step <= steps {
        sum += of(step);
        step += 1.0;
    }
    -2.0 * (n * LN_STEP * sum).max(f64::MIN_POSITIVE).ln()
}

/// Steps of the logarithm in [`occam`].
const LN_STEP: f64 = 0.5;
/// Beyond so many logarithms below 1/n nothing is added.
const LN_NOTHING: f64 = 8.0;

/// The standard normal number that is as rare as `t` is by Student's distribution.
#[must_use]
pub fn normal_score(t: f64, k: f64) -> f64 {
    let Ok(student) = StudentsT::new(0.0, 1.0, k) else {
        return 0.0;
    };
    let tail = student.sf(t.abs());
    if tail <= 0.0 {
        return t.signum() * MOST_SCORE;
    }
    let score = -Normal::standard().inverse_cdf(tail);
    t.signum() * score.clamp(0.0, MOST_SCORE)
}

/// Rarer than this is as rare, for every purpose.
const MOST_SCORE: f64 = 8.0;

/// Probability that a standard normal exceeds `z`.
#[must_use]
pub fn normal_tail(z: f64) -> f64 {
    Normal::standard().sf(z)
}

/// Probability that the mean of normal numbers about zero comes out as large as that of these, in
/// its standard deviations (Student's t); 1 of fewer than two.
#[must_use]
pub fn mean_tail(numbers: &[f64]) -> f64 {
    let n = numbers.len() as f64;
    let mean = numbers.iter().sum::<f64>() / n.max(1.0);
    let squares: f64 = numbers.iter().map(|x| (x - mean).powi(2)).sum();
    let sigma = (squares / (n - 1.0) / n).sqrt();
    match StudentsT::new(0.0, 1.0, n - 1.0) {
        Ok(distribution) if sigma > 0.0 => distribution.sf(mean / sigma),
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_parameters_cost_is_the_mean_over_the_sizes_they_may_have() {
        // the Bayes factor at each g, over the prior of g: midpoints of w = g / (n + g)
        let mean = |gain: f64, k: f64, n: f64| {
            let steps = 1_000_000;
            let of = |i: i32| {
                let w = (f64::from(i) + 0.5) / f64::from(steps);
                let g = n * w / (1.0 - w);
                (0.5 * gain * g / (1.0 + g) - 0.5 * k * (1.0 + g).ln()).exp()
            };
            (0..steps).map(of).sum::<f64>() / f64::from(steps)
        };
        for (gain, k, n) in [
            (17.0, 1.0, 450.0),
            (40.0, 6.0, 450.0),
            (200.0, 3.0, 3000.0),
            (900.0, 2.0, 240.0),
        ] {
            let expected = gain - 2.0 * mean(gain, k, n).ln();
            let found = occam(gain, k, n);
            assert!(
                (found - expected).abs() < 0.02,
                "{gain} {k}: {found} {expected}"
            );
        }
        // one parameter costs about what Schwarz takes, six that gain 40 two thirds of it
        assert!((occam(60.0, 1.0, 450.0) - 450.0_f64.ln()).abs() < 0.5);
        assert!((occam(40.0, 6.0, 450.0) / (6.0 * 450.0_f64.ln()) - 2.0 / 3.0).abs() < 0.01);
    }

    #[test]
    fn tails_agree_with_printed_tables() {
        // Abramowitz and Stegun, table 26.8: six decimals of chi-squared
        for (x, k, p) in [
            (3.841_459, 1.0, 0.05),
            (10.827_566, 1.0, 0.001),
            (5.991_465, 2.0, 0.05),
            (16.811_894, 6.0, 0.01),
            (43.772_972, 30.0, 0.05),
            (124.342_113, 100.0, 0.05),
        ] {
            assert!((chi_squared_tail(x, k) / p - 1.0).abs() < 1e-6, "{x} {k}");
        }
        assert!((chi_squared_tail(-1.0, 3.0) - 1.0).abs() < 1e-15);
        // far out: exp(-x / 2) for two degrees of freedom
        assert!((chi_squared_tail(1000.0, 2.0) / (-500.0_f64).exp() - 1.0).abs() < 1e-9);
        // tables 26.8 and 26.9: quantiles of chi-squared, and of F to four digits
        assert!((chi_squared_quantile(0.99, 6.0) - 16.811_894).abs() < 1e-5);
        assert!((chi_squared_quantile(0.95, 100.0) - 124.342_113).abs() < 1e-5);
        for (x, a, b, p) in [
            (4.965, 1.0, 10.0, 0.05),
            (2.978, 10.0, 10.0, 0.05),
            (4.849, 10.0, 10.0, 0.01),
            (2.387, 20.0, 60.0, 0.005),
        ] {
            assert!((f_tail(x, a, b) / p - 1.0).abs() < 2e-3, "{x} {a} {b}");
        }
        // far out, by scipy
        assert!((f_tail(25.0, 400.0, 60.0) / 1.884_382_151_421_661_8e-30 - 1.0).abs() < 1e-6);
        assert!((f_tail(0.0, 3.0, 4.0) - 1.0).abs() < 1e-15);
        assert!((normal_tail(5.0) / 2.866_515_718_791_939e-7 - 1.0).abs() < 1e-9);
        // Student's own example of the sleep of ten patients: t = 4.0621, and scipy's one-sided
        // tail
        let hours = [1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4];
        assert!((mean_tail(&hours) / 1.416_445e-3 - 1.0).abs() < 1e-4);
        assert!((mean_tail(&hours) + mean_tail(&hours.map(|x| -x)) - 1.0).abs() < 1e-12);
        assert!((mean_tail(&[1.0]) - 1.0).abs() < 1e-15);
        assert!((normal_tail(-1.0) - 0.841_344_746_068_543).abs() < 1e-9);
    }
}
