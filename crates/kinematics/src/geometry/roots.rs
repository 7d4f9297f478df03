//! All roots of a smooth function of one variable over an interval.

/// Cells narrower than this are not divided again: two roots so near to each other count as one.
const NARROWEST: f64 = 1e-7;
/// A function that comes no nearer to zero than this, in units of its own, touches it.
const TOUCHES: f64 = 1e-14;
/// Share of the cubic's own third-order part that it may miss the function by. Over a quarter of
/// the function's shortest wave it misses it by a thirtieth.
const UNCERTAINTY: f64 = 0.2;
/// Steps of Newton's method within a bracket; four are usual, and each that leaves the bracket
/// halves it.
const MOST_STEPS: usize = 60;
/// A step that changes a variable of some radians by rounding only.
const STEP: f64 = 4e-16;
/// Evaluations after which a function that stays at zero, whose roots cannot be counted, is left. A
/// hundred are usual.
const MOST_EVALUATIONS: u32 = 4000;

/// A function and its slope at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub at: f64,
    pub value: f64,
    pub slope: f64,
}

/// The roots of `function`, which gives value and slope, in `[from, to]` in ascending order,
/// appended to `found`.
///
/// The interval is cut into `cells`; on each the cubic through both ends with their slopes is
/// enclosed by its Bernstein coefficients. A cell is dropped where it stays clear of zero, searched
/// where it rises or falls throughout and changes its sign, and halved otherwise. Features much
/// narrower than a cell that show at neither end can be missed.
///
/// # Source
/// Bernstein subdivision as in T. W. Sederberg, T. Nishita, "Curve intersection using Bézier
/// clipping" (1990), on the cubic Hermite interpolant.
pub(crate) fn roots(
    function: &mut impl FnMut(f64) -> (f64, f64),
    [from, to]: [f64; 2],
    cells: u32,
    found: &mut Vec<f64>,
) {
    let mut evaluations = 0;
    let mut sample = |at: f64| {
        evaluations += 1;
        let (value, slope) = if evaluations > MOST_EVALUATIONS {
            (f64::NAN, f64::NAN)
        } else {
            function(at)
        };
        Sample { at, value, slope }
    };
    let mut low = sample(from);
    for cell in 1..=cells {
        let high = sample(from + (to - from) * f64::from(cell) / f64::from(cells));
        search(&mut sample, low, high, found);
        low = high;
    }
}

/// The roots between two samples.
fn search(sample: &mut impl FnMut(f64) -> Sample, low: Sample, high: Sample, found: &mut Vec<f64>) {
    let long = high.at - low.at;
    let (rise, fall) = (long * low.slope, long * high.slope);
    let inner = [low.value + rise / 3.0, high.value - fall / 3.0];
    let uncertainty = UNCERTAINTY * (high.value - low.value - 0.5 * (rise + fall)).abs();
    if !uncertainty.is_finite() {
        return;
    }
    let leaps = (low.value < 0.0) != (high.value < 0.0);
    let side = if low.value + high.value < 0.0 {
        -1.0
    } else {
        1.0
    };
    if leaps {
        let climb = if high.value < low.value { -1.0 } else { 1.0 };
        let steady = [rise, 3.0 * (inner[1] - inner[0]), fall]
            .iter()
            .all(|change| climb * change > uncertainty);
        if steady || long < NARROWEST {
            found.push(refined(sample, low, high));
            return;
        }
    } else {
        let clear = [low.value, inner[0], inner[1], high.value]
            .iter()
            .all(|value| side * value > uncertainty);
        if clear {
            return;
        }
        if long < NARROWEST {
            let nearest = if side * low.value < side * high.value {
                low
            } else {
                high
            };
            if nearest.value.abs() < TOUCHES && found.last().is_none_or(|r| nearest.at - r > long) {
                found.push(nearest.at);
            }
            return;
        }
    }
    let middle = sample(0.5 * (low.at + high.at));
    search(sample, low, middle, found);
    search(sample, middle, high, found);
}

/// The root in a bracket by Newton's method, halved where a step would leave it.
fn refined(sample: &mut impl FnMut(f64) -> Sample, mut low: Sample, mut high: Sample) -> f64 {
    let falls = high.value < low.value;
    let mut here = if low.value.abs() < high.value.abs() {
        low
    } else {
        high
    };
    for _ in 0..MOST_STEPS {
        let step = here.value / here.slope;
        let mut next = here.at - step;
        // a value that is not a number is not inside either
        if !(next > low.at && next < high.at) {
            if next == here.at || here.value == 0.0 {
                return here.at;
            }
            next = 0.5 * (low.at + high.at);
        }
        let near = (next - here.at).abs() <= STEP * (1.0 + next.abs());
        if near || high.at - low.at <= STEP {
            return next;
        }
        here = sample(next);
        if (here.value < 0.0) == falls {
            high = here;
        } else {
            low = here;
        }
    }
    here.at
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(mut function: impl FnMut(f64) -> (f64, f64), ends: [f64; 2], cells: u32) -> Vec<f64> {
        let mut found = Vec::new();
        roots(&mut function, ends, cells, &mut found);
        found
    }

    #[test]
    fn every_root_of_a_sum_of_waves_is_found() {
        let wave = |x: f64| {
            let value = (8.0 * x).sin() + 0.3 * (3.0 * x).cos();
            (value, 8.0 * (8.0 * x).cos() - 0.9 * (3.0 * x).sin())
        };
        let found = all(wave, [0.0, std::f64::consts::TAU], 24);
        assert_eq!(found.len(), 16, "{found:?}");
        assert!(found.iter().all(|x| wave(*x).0.abs() < 1e-14));
        assert!(found.is_sorted());
    }

    #[test]
    fn roots_as_near_as_a_millionth_are_distinguished() {
        let pair = |x: f64| ((x - 0.3) * (x - 0.300_001), 2.0 * x - 0.600_001);
        let found = all(pair, [-1.0, 1.0], 4);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!((found[1] - found[0] - 1e-6).abs() < 1e-9);
    }

    #[test]
    fn a_touching_root_is_found_once_and_a_near_miss_is_none() {
        let square = |x: f64| ((x - 0.3).powi(2), 2.0 * (x - 0.3));
        assert_eq!(all(square, [-1.0, 1.0], 4).len(), 1);
        let above = |x: f64| ((x - 0.3).powi(2) + 1e-6, 2.0 * (x - 0.3));
        assert!(all(above, [-1.0, 1.0], 4).is_empty());
    }

    #[test]
    fn a_function_that_stays_at_zero_is_left() {
        let mut evaluations = 0;
        let flat = |_: f64| {
            evaluations += 1;
            (0.0, 0.0)
        };
        let found = all(flat, [0.0, 1.0], 4);
        assert!(found.iter().all(|x| (0.0..=1.0).contains(x)));
        assert_eq!(evaluations, MOST_EVALUATIONS);
    }

    #[test]
    fn what_is_not_a_number_has_no_root() {
        assert!(all(|_| (f64::NAN, f64::NAN), [0.0, 1.0], 4).is_empty());
    }
}
