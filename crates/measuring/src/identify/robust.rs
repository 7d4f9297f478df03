//! Losses that keep a wrong reading from bending the whole answer.

/// How residuals count, with `r` the length of a row's residual in standard deviations.
///
/// # Source
/// P. J. Huber, "Robust Statistics" (1981); A. E. Beaton, J. W. Tukey (1974) for the biweight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// `r²`.
    Squares,
    /// `r²` to a limit, then in proportion to r.
    Huber,
    /// Constant beyond a limit: such rows do not count.
    Tukey,
}

/// A loss with the scale of the residuals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss {
    /// The shape.
    pub shape: Shape,
    /// Standard deviations of the rows are multiplied by this.
    pub scale: f64,
}

/// The length that 99.73 % of rows of `count` normal residuals stay below: the square root of
/// chi-squared's quantile.
#[must_use]
pub fn limit(count: usize) -> f64 {
    match count {
        0 | 1 => 3.0,
        2 => 3.44,
        3 => 3.762,
        4 => 4.03,
        5 => 4.267,
        _ => 4.482,
    }
}

/// The median of chi-squared with this many degrees of freedom.
#[must_use]
pub fn median_of_squares(count: usize) -> f64 {
    match count {
        0 | 1 => 0.454_936,
        2 => 1.386_294,
        3 => 2.365_974,
        4 => 3.356_694,
        5 => 4.351_46,
        _ => 5.348_12,
    }
}

impl Loss {
    /// Plain squares.
    #[must_use]
    pub const fn squares() -> Self {
        Self {
            shape: Shape::Squares,
            scale: 1.0,
        }
    }

    /// The loss of a row with this sum of squares of `count` residuals, and its weight: the loss's
    /// derivative by it.
    #[inline(always)]
    #[must_use]
    pub fn of(&self, squared: f64, count: usize) -> (f64, f64) {
        if self.shape == Shape::Squares {
            return (squared, 1.0);
        }
        let at = limit(count) * self.scale;
        match self.shape {
            Shape::Huber if squared > at * at => {
                let length = squared.sqrt();
                (at * (2.0 * length - at), at / length)
            }
            Shape::Tukey => {
                // 4.685 and 3 standard deviations, as for one residual
                let end = 1.56 * at;
                let part = squared / (end * end);
                if part >= 1.0 {
                    (end * end / 3.0, 0.0)
                } else {
                    let rest = 1.0 - part;
                    (end * end / 3.0 * (1.0 - rest * rest * rest), rest * rest)
                }
            }
            _ => (squared, 1.0),
        }
    }
}

/// A typical factor between residuals and their standard deviations, by the median, so that some
/// wrong rows do not matter.
#[must_use]
pub fn scale_of(squares: &[f64], counts: impl Iterator<Item = usize>) -> f64 {
    let mut ratios: Vec<f64> = squares
        .iter()
        .zip(counts)
        .map(|(squared, count)| squared / median_of_squares(count))
        .collect();
    if ratios.is_empty() {
        return 1.0;
    }
    let middle = ratios.len() / 2;
    let (_, median, _) = ratios.select_nth_unstable_by(middle, f64::total_cmp);
    median.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_weight_is_the_slope_of_the_loss() {
        for shape in [Shape::Squares, Shape::Huber, Shape::Tukey] {
            let loss = Loss { shape, scale: 1.7 };
            for count in [1, 3, 6] {
                for k in 1..200 {
                    let squared = f64::from(k) * 1.3;
                    let step = 1e-5;
                    let slope = (loss.of(squared + step, count).0
                        - loss.of(squared - step, count).0)
                        / (2.0 * step);
                    assert!(
                        (slope - loss.of(squared, count).1).abs() < 1e-5,
                        "{shape:?} {squared}"
                    );
                }
            }
        }
    }
}
