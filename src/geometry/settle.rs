//! The angle that a function gives back.

use super::Scalar;

/// Evaluations after which nothing better is to be hoped for; five are usual.
const MOST: usize = 30;
/// Below this, radians, nothing is left but rounding.
const SETTLED_RAD: f64 = 1e-12;
/// Longer steps of the secant, radians, are not believed.
const LONGEST_RAD: f64 = 0.25;
/// A change that says nothing about the slope.
const FLAT_RAD: f64 = 1e-28;

/// [`Scalar::settled`] by the secant method; where that leaps, by the plain step to what came back, which approaches where
/// `each` contracts.
#[inline(always)]
pub(super) fn secant<S: Scalar>(mut each: impl FnMut(S) -> S) -> (S, S) {
    let k = S::constant;
    let turn = std::f64::consts::TAU;
    let (mut at, mut step, mut before) = (S::zero(), S::zero(), S::zero());
    for round in 1.. {
        let apart = each(at) - at;
        let missing = apart - k(turn) * (apart * k(turn.recip())).round();
        let left = missing.abs();
        if round == MOST || left.every_below(SETTLED_RAD) {
            return (at, left);
        }
        let change = missing - before;
        let is_flat = change.abs();
        let divisor = is_flat.choose_less(k(FLAT_RAD), S::one(), change);
        let secant = -missing * step / divisor;
        // the first step has no step before it
        let unknown = step.abs().min(is_flat);
        let secant = unknown.choose_less(k(FLAT_RAD), missing, secant);
        step = secant.abs().choose_less(k(LONGEST_RAD), secant, missing);
        at += step;
        before = missing;
    }
    unreachable!("the last round returns")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Dual, Jet, Lanes};

    /// Kepler's equation x = c + e sin x, with an eccentricity of 0.3.
    fn kepler<S: Scalar>(c: S) -> S {
        S::settled(|x| c + S::constant(0.3) * x.sin_cos().0).0
    }

    fn slope(x: f64) -> f64 {
        (1.0 - 0.3 * x.cos()).recip()
    }

    #[test]
    fn what_comes_back_is_what_went_in() {
        for k in -300..300 {
            let c = 0.01 * f64::from(k);
            let x = kepler(c);
            assert!((x - 0.3 * x.sin() - c).abs() < 1e-11, "{c} {x}");
            let lanes = kepler(Lanes([c, -c, 0.5 * c, 0.0]));
            for (lane, c) in lanes.0.iter().zip([c, -c, 0.5 * c, 0.0]) {
                assert!((lane - kepler(c)).abs() < 1e-11, "{c} {lane}");
            }
        }
    }

    #[test]
    fn its_slope_is_the_implicit_one() {
        for k in -20..20 {
            let x = kepler(Dual::<1>::variable(0.13 * f64::from(k), 0));
            assert!((x.slope[0] - slope(x.value)).abs() < 1e-9, "{x:?}");
        }
    }

    #[test]
    fn an_enclosure_holds_every_solution_its_slope_and_its_bend() {
        for k in -20..20 {
            let low = 0.1 * f64::from(k);
            let k = Jet::constant;
            let middle = kepler(low + 0.005);
            let around = |s: Jet, x: Jet| s + k(0.3) * (k(middle) + x).sin_cos().0 - k(middle);
            let s = Jet::variable(low, low + 0.01);
            let beside = Jet::implicit(0.005, 1e-11, |x| around(s, x), |x| around(s.at_rest(), x));
            let jet = beside + k(middle);
            assert!(jet.slope.radius < 0.1, "{jet:?}");
            for j in 0..=10 {
                let x = kepler(low + 0.001 * f64::from(j));
                let bend = -0.3 * x.sin() * slope(x).powi(3);
                for (ball, number) in [(jet.value, x), (jet.slope, slope(x)), (jet.bend, bend)] {
                    assert!(
                        number >= ball.low() - 1e-11 && number <= ball.high() + 1e-11,
                        "{jet:?} {x}"
                    );
                }
            }
        }
    }

    #[test]
    fn where_nothing_settles_it_is_told() {
        let (_, left) = f64::settled(|x| x + 1.0);
        assert!((left - 1.0).abs() < 1e-9);
        let s = Jet::variable(0.0, 1.0);
        let steep = |s: Jet, x: Jet| s + Jet::constant(3.0) * x;
        let x = Jet::implicit(0.5, 1e-11, |x| steep(s, x), |x| steep(s.at_rest(), x));
        assert!(!x.value.radius.is_finite());
    }
}
