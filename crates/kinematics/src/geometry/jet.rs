//! Enclosures of a function of one variable, its slope and its curvature over a whole interval.

use super::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Attempts to enclose an implicit function.
const INCLUSIONS: usize = 6;

/// All real numbers within `radius` of `middle`. An unbounded set has an infinite radius.
///
/// Rounding of the arithmetic itself, some 1e-15 of the values, is not counted in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its middle.
    pub middle: f64,
    /// Half its width.
    pub radius: f64,
}

impl Ball {
    /// One number.
    #[inline(always)]
    #[must_use]
    pub fn point(middle: f64) -> Self {
        Self {
            middle,
            radius: 0.0,
        }
    }

    /// The numbers from `low` to `high`.
    #[inline(always)]
    #[must_use]
    pub fn between(low: f64, high: f64) -> Self {
        Self {
            middle: 0.5 * (low + high),
            radius: 0.5 * (high - low),
        }
    }

    #[inline(always)]
    fn of(middle: f64, radius: f64) -> Self {
        if middle.is_finite() && radius < f64::INFINITY {
            Self { middle, radius }
        } else {
            Self {
                middle: 0.0,
                radius: f64::INFINITY,
            }
        }
    }

    /// Smallest number.
    #[inline(always)]
    #[must_use]
    pub fn low(self) -> f64 {
        self.middle - self.radius
    }

    /// Largest number.
    #[inline(always)]
    #[must_use]
    pub fn high(self) -> f64 {
        self.middle + self.radius
    }

    /// Largest magnitude.
    #[inline(always)]
    #[must_use]
    pub fn magnitude(self) -> f64 {
        self.middle.abs() + self.radius
    }

    /// Smallest magnitude.
    #[inline(always)]
    #[must_use]
    pub fn mignitude(self) -> f64 {
        (self.middle.abs() - self.radius).max(0.0)
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self {
            middle: self.middle + other.middle,
            radius: self.radius + other.radius,
        }
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self {
            middle: self.middle - other.middle,
            radius: self.radius + other.radius,
        }
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        Self {
            middle: self.middle * other.middle,
            radius: self.middle.abs() * other.radius
                + self.radius * (other.middle.abs() + other.radius),
        }
    }

    #[inline(always)]
    fn by(self, factor: f64) -> Self {
        Self {
            middle: factor * self.middle,
            radius: factor.abs() * self.radius,
        }
    }

    fn reciprocal(self) -> Self {
        let least = self.mignitude();
        if least > 0.0 {
            let value = self.middle.recip();
            Self::of(value, self.radius * value.abs() / least)
        } else {
            Self::of(0.0, f64::INFINITY)
        }
    }

    fn hull(self, other: Self) -> Self {
        let low = self.low().min(other.low());
        let high = self.high().max(other.high());
        Self::of(0.5 * (low + high), 0.5 * (high - low))
    }
}

/// A function of one variable s over an interval of s: enclosures of its values, its first and its
/// second derivative.
///
/// An equation written over [`Scalar`] and evaluated with jets gives bounds that hold everywhere in
/// the interval, so that what happens between samples is known. Where a bound cannot be given (a
/// division by what may be zero) the radius is infinite or not a number. An angle of a point is
/// continued across the cut at π: it is right but for whole revolutions.
///
/// # Source
/// R. E. Moore, "Interval Analysis" (1966); midpoint–radius arithmetic after S. M. Rump (1999).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// Values.
    pub value: Ball,
    /// First derivative.
    pub slope: Ball,
    /// Second derivative.
    pub bend: Ball,
}

impl Jet {
    /// The variable itself over `[low, high]`.
    #[must_use]
    pub fn variable(low: f64, high: f64) -> Self {
        Self {
            value: Ball::between(low, high),
            slope: Ball::point(1.0),
            bend: Ball::point(0.0),
        }
    }

    /// f(self) by the chain rule, from enclosures of f and its first two derivatives.
    #[inline(always)]
    fn chain(self, value: Ball, first: Ball, second: Ball) -> Self {
        Self {
            value,
            slope: first.times(self.slope),
            bend: second
                .times(self.slope.times(self.slope))
                .plus(first.times(self.bend)),
        }
    }

    /// Anything.
    fn unknown() -> Self {
        let unbounded = Ball::of(0.0, f64::INFINITY);
        Self {
            value: unbounded,
            slope: unbounded,
            bend: unbounded,
        }
    }

    /// Either of two functions: where one goes over into the other there is no derivative to
    /// enclose.
    fn either(self, other: Self) -> Self {
        Self {
            value: self.value.hull(other.value),
            ..Self::unknown()
        }
    }

    /// The same values, as if nothing moved.
    #[must_use]
    pub fn at_rest(self) -> Self {
        Self {
            value: self.value,
            ..Self::constant(0.0)
        }
    }

    /// The function x(s) that solves x = g(s, x) and is zero, but for `slack`, in the middle of an
    /// interval of s that reaches `half_width` to either side.
    ///
    /// `moving` encloses g over the interval; `resting` does with everything but x at rest, so that
    /// its slope is ∂g/∂x where that of x is one. Slope and bend are those of the implicit
    /// function; they bound how far x comes from zero. Unbounded where no such bound is found.
    #[must_use]
    pub fn implicit(
        half_width: f64,
        slack: f64,
        moving: impl Fn(Self) -> Self,
        resting: impl Fn(Self) -> Self,
    ) -> Self {
        let with = |value: Ball, slope: Ball| Self {
            value,
            slope,
            bend: Ball::point(0.0),
        };
        let (none, one) = (Ball::point(0.0), Ball::point(1.0));
        let mut ball = Ball::of(0.0, slack);
        for _ in 0..INCLUSIONS {
            let by_x = resting(with(ball, one)).slope;
            if by_x.magnitude() >= 1.0 || !by_x.radius.is_finite() {
                break;
            }
            let divisor = one.minus(by_x).reciprocal();
            let slope = moving(with(ball, none)).slope.times(divisor);
            let reach = slope.magnitude() * half_width + slack;
            if reach <= ball.radius {
                let bend = moving(with(ball, slope)).bend.times(divisor);
                return Self {
                    value: Ball::of(0.0, reach),
                    slope,
                    bend,
                };
            }
            ball = Ball::of(0.0, 1.25 * reach);
        }
        Self::unknown()
    }

    fn reciprocal(self) -> Self {
        let value = self.value.reciprocal();
        let square = value.times(value);
        self.chain(value, square.by(-1.0), square.times(value).by(2.0))
    }
}

impl Add for Jet {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value.plus(other.value),
            slope: self.slope.plus(other.slope),
            bend: self.bend.plus(other.bend),
        }
    }
}
impl Sub for Jet {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value.minus(other.value),
            slope: self.slope.minus(other.slope),
            bend: self.bend.minus(other.bend),
        }
    }
}
impl Mul for Jet {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value.times(other.value),
            slope: self
                .slope
                .times(other.value)
                .plus(self.value.times(other.slope)),
            bend: self
                .bend
                .times(other.value)
                .plus(self.slope.times(other.slope).by(2.0))
                .plus(self.value.times(other.bend)),
        }
    }
}
impl Div for Jet {
    type Output = Self;
    #[inline(always)]
    #[allow(clippy::suspicious_arithmetic_impl)] // a quotient is the product with the reciprocal
    fn div(self, other: Self) -> Self {
        self * other.reciprocal()
    }
}
impl Neg for Jet {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            value: self.value.by(-1.0),
            slope: self.slope.by(-1.0),
            bend: self.bend.by(-1.0),
        }
    }
}
impl AddAssign for Jet {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
impl SubAssign for Jet {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Scalar for Jet {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self {
            value: Ball::point(value),
            slope: Ball::point(0.0),
            bend: Ball::point(0.0),
        }
    }

    fn sqrt(self) -> Self {
        let (low, high) = (
            self.value.low().max(0.0).sqrt(),
            self.value.high().max(0.0).sqrt(),
        );
        let value = Ball::between(low, high);
        let value = Ball::of(value.middle, value.radius);
        let inverse = value.reciprocal();
        let cube = inverse.times(inverse).times(inverse);
        self.chain(value, inverse.by(0.5), cube.by(-0.25))
    }

    fn exp(self) -> Self {
        let value = Ball::between(self.value.low().exp(), self.value.high().exp());
        let value = Ball::of(value.middle, value.radius);
        self.chain(value, value, value)
    }

    fn sin_cos(self) -> (Self, Self) {
        let Ball { middle, radius } = self.value;
        let (s, c) = Scalar::sin_cos(middle);
        // second-order remainder, and never more than the range
        let half = 0.5 * radius * radius;
        let around = |value: f64, slope: f64| Ball {
            middle: value,
            radius: (slope.abs() * radius + half).min(1.0 + value.abs()),
        };
        let (sine, cosine) = (around(s, c), around(c, s));
        (
            self.chain(sine, cosine, sine.by(-1.0)),
            self.chain(cosine, sine.by(-1.0), cosine.by(-1.0)),
        )
    }

    fn atan2(self, other: Self) -> Self {
        let (y, x) = (self, other);
        let middle = Scalar::atan2(y.value.middle, x.value.middle);
        let distance = y.value.middle.hypot(x.value.middle);
        let off = y.value.radius.hypot(x.value.radius);
        let radius = if off < distance {
            (off / distance).asin()
        } else {
            f64::INFINITY
        };
        // θ' = (x y' − y x') / (x² + y²), θ'' from its derivative
        let squared = x.value.times(x.value).plus(y.value.times(y.value));
        let least = (distance - off).max(0.0);
        let squared = Ball::between(
            squared.low().max(least * least),
            squared.high().max(least * least),
        );
        let inverse = squared.reciprocal();
        let turn = x.value.times(y.slope).minus(y.value.times(x.slope));
        let slope = turn.times(inverse);
        let bend = x.value.times(y.bend).minus(y.value.times(x.bend));
        let spread = x.value.times(x.slope).plus(y.value.times(y.slope)).by(2.0);
        Self {
            value: Ball::of(middle, radius),
            slope,
            bend: bend.minus(spread.times(slope)).times(inverse),
        }
    }

    #[inline(always)]
    fn choose_less(self, limit: Self, then: Self, otherwise: Self) -> Self {
        let gap = self.value.minus(limit.value);
        if gap.high() < 0.0 {
            then
        } else if gap.low() >= 0.0 {
            otherwise
        } else {
            then.either(otherwise)
        }
    }

    #[inline(always)]
    fn every_below(self, limit: f64) -> bool {
        self.value.high() < limit
    }

    fn round(self) -> Self {
        let [low, high] = [self.value.low(), self.value.high()].map(Scalar::round);
        if low == high {
            Self::constant(low)
        } else {
            Self::constant(low).either(Self::constant(high))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds(ball: Ball, value: f64) -> bool {
        value >= ball.low() - 1e-9 && value <= ball.high() + 1e-9
    }

    fn sample<S: Scalar>(s: S) -> S {
        let k = S::constant;
        let (sine, cosine) = (k(0.7) + s * k(2.0)).sin_cos();
        let angle = (k(0.3) + sine).atan2(k(4.7) + cosine * s);
        (angle * angle + sine.abs() + k(1.0)).sqrt() / (k(2.0) + cosine) - (s * k(-0.5)).exp()
    }

    #[test]
    fn values_slopes_and_bends_everywhere_in_the_interval_are_enclosed() {
        let mut checked = 0;
        for k in 0..400 {
            let low = 0.01 * f64::from(k) - 2.0;
            let high = low + 0.002 * f64::from(1 + k % 7);
            let jet = sample(Jet::variable(low, high));
            for j in 0..=8 {
                let s = low + (high - low) * f64::from(j) / 8.0;
                let h = 1e-5;
                let [a, b, c] = [s - h, s, s + h].map(sample::<f64>);
                let slope = (c - a) / (2.0 * h);
                let bend = (c - 2.0 * b + a) / (h * h);
                let widened = |ball: Ball, by| Ball {
                    radius: ball.radius + by,
                    ..ball
                };
                assert!(holds(jet.value, b), "{jet:?} {b}");
                // where the sine changes sign the function has a corner: no bound
                if jet.bend.radius.is_finite() {
                    assert!(
                        holds(widened(jet.slope, 1e-6), slope),
                        "{jet:?} {slope} {s}"
                    );
                    assert!(holds(widened(jet.bend, 1e-3), bend), "{jet:?} {bend} {s}");
                    checked += 1;
                }
            }
        }
        assert!(checked > 3000, "{checked}");
    }

    /// The root of Kepler's equation x = c + e sin x, with an eccentricity of 0.3.
    fn kepler(c: f64) -> f64 {
        let mut x = c;
        for _ in 0..20 {
            x -= (x - 0.3 * x.sin() - c) / (1.0 - 0.3 * x.cos());
        }
        x
    }

    #[test]
    fn an_enclosure_holds_every_solution_its_slope_and_its_bend() {
        for k in -20..20 {
            let low = 0.1 * f64::from(k);
            let k = Jet::constant;
            let middle = kepler(low + 0.005);
            let around = |s: Jet, x: Jet| s + k(0.3) * (k(middle) + x).sin_cos().0 - k(middle);
            let s = Jet::variable(low, low + 0.01);
            let implicit =
                Jet::implicit(0.005, 1e-11, |x| around(s, x), |x| around(s.at_rest(), x));
            let jet = implicit + k(middle);
            assert!(jet.slope.radius < 0.1, "{jet:?}");
            for j in 0..=10 {
                let x = kepler(low + 0.001 * f64::from(j));
                let slope = (1.0 - 0.3 * x.cos()).recip();
                let bend = -0.3 * x.sin() * slope.powi(3);
                for (ball, number) in [(jet.value, x), (jet.slope, slope), (jet.bend, bend)] {
                    assert!(
                        number >= ball.low() - 1e-11 && number <= ball.high() + 1e-11,
                        "{jet:?} {x}"
                    );
                }
            }
        }
    }

    #[test]
    fn what_has_no_bound_says_so() {
        let s = Jet::variable(0.0, 1.0);
        let steep = |s: Jet, x: Jet| s + Jet::constant(3.0) * x;
        let x = Jet::implicit(0.5, 1e-11, |x| steep(s, x), |x| steep(s.at_rest(), x));
        assert!(!x.value.radius.is_finite());
        let through_zero = Jet::variable(-1.0, 1.0);
        assert!(!(Jet::constant(1.0) / through_zero).value.radius.is_finite());
        assert!(!through_zero.atan2(through_zero).value.radius.is_finite());
    }
}
