//! Since which run an arm errs otherwise: a change-point test over its errors run by run.
//!
//! Logarithms of the errors are compared with those before them by a CUSUM chart that learns mean
//! and spread as it goes: with `m` and `s` of the `n − 1` runs before, `T = √((n−1)/n)·(x − m)/s`
//! is Student's with `n − 2` degrees of freedom where nothing has changed, and its normal score `u`
//! independent of the others. So that a large change is seen after few runs the spread begins as if
//! two differences of the usual spread were known, which many runs outweigh. Behind a change the
//! mean is learnt anew; the spread within the runs before stays known; from a run that is too rare
//! nothing is learnt. The first run has nothing before it: it is compared with those behind it, and
//! where it is too rare to be one of them the second begins anew. `up = max(0, up + u − k)` and `down` likewise; one beyond `h` is a change.
//! When it came is the most likely split of the runs: the one with the largest sum of squares between
//! its halves.
//!
//! # Source
//! E. S. Page, "Continuous inspection schemes", Biometrika 41 (1954); D. M. Hawkins, "Self-starting
//! CUSUM charts for location and scale", The Statistician 36 (1987); D. V. Hinkley, "Inference
//! about the change-point in a sequence of random variables", Biometrika 57 (1970).

use crate::diagnose::estimator::chances::normal_score;

/// Half of the shift that is sought, in standard deviations from run to run: `k`.
pub const ALLOWANCE: f64 = 0.5;
/// The sum beyond which something has changed: `h`. In 365 runs without a change it comes to half a
/// false alarm.
pub const LIMIT: f64 = 6.0;
/// Runs vary by this part of their error at least: less is no change that matters.
const LEAST_SPREAD: f64 = 0.02;
/// Spread from run to run that errors of 10 to 60 positions commonly have, in their logarithm.
const USUAL_SPREAD: f64 = 0.1;
/// For so many degrees of freedom it counts.
const USUAL_FREEDOM: f64 = 2.0;
/// From a run that is as rare as this nothing is learnt: it may be the first after a change.
const UNLIKELY: f64 = 4.0;
/// The same with fewer degrees of freedom than [`FEW`]: Student's hardly comes to 4 there.
const UNLIKELY_OF_FEW: f64 = 3.0;
/// Degrees of freedom below which the spread is hardly known.
const FEW: f64 = 8.0;
/// The first run is apart from those behind it that is as rare as this: of 1000 times 30 runs alike
/// it is once.
const FIRST_APART: f64 = 3.5;
/// Runs that a change can be seen in at all.
pub const LEAST_RUNS: usize = 4;

/// A change of the error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// The first run with it, from 0.
    pub since: usize,
    /// The run in which it was noticed.
    pub noticed: usize,
    /// Geometric mean of the errors of the runs before it, back to the change before.
    pub before: f64,
    /// Of the runs since, up to the next change.
    pub after: f64,
}

/// Changes of errors in the order of their runs, by the limit `h`; errors are greater than zero.
#[must_use]
pub fn changes_beyond(errors: &[f64], h: f64) -> Vec<Change> {
    charted(errors, h).0
}

/// Geometric mean of the errors before the last one, since the last change, where the last is too
/// rare to be one of them and no change is sure yet.
#[must_use]
pub fn before_last(errors: &[f64]) -> Option<f64> {
    charted(errors, LIMIT).1
}

fn charted(errors: &[f64], h: f64) -> (Vec<Change>, Option<f64>) {
    let logs: Vec<f64> = errors
        .iter()
        .map(|e| e.max(f64::MIN_POSITIVE).ln())
        .collect();
    let mut found: Vec<Change> = Vec::new();
    let (mut start, mut known) = (0, Spread::usual());
    let mut chart = Chart::of(&logs[start..], known, h);
    let alarm = chart.alarm.unwrap_or(logs.len());
    if let Some(noticed) = first_apart(&logs[..alarm], known) {
        start = 1;
        found.push(Change {
            since: 1,
            noticed,
            before: logs[0].exp(),
            after: 0.0,
        });
        chart = Chart::of(&logs[start..], known, h);
    }
    while let Some(noticed) = chart.alarm.map(|n| start + n) {
        let since = start + split(&logs[start..=noticed]);
        let before = mean(&logs[start..since]).exp();
        known = known.and(&logs[start..since]);
        if let Some(last) = found.last_mut() {
            last.after = before;
        }
        found.push(Change {
            since,
            noticed,
            before,
            after: 0.0,
        });
        start = since;
        chart = Chart::of(&logs[start..], known, h);
    }
    if let Some(last) = found.last_mut() {
        last.after = mean(&logs[last.since..]).exp();
    }
    (found, chart.before_last.map(f64::exp))
}

/// Changes of errors in the order of their runs.
#[must_use]
pub fn changes(errors: &[f64]) -> Vec<Change> {
    changes_beyond(errors, LIMIT)
}

fn mean(x: &[f64]) -> f64 {
    x.iter().sum::<f64>() / x.len() as f64
}

/// How runs vary about the means of their parts.
#[derive(Clone, Copy, Default)]
struct Spread {
    /// Sum of squares.
    squares: f64,
    /// Its degrees of freedom.
    freedom: f64,
}

impl Spread {
    /// What is known before the first run.
    fn usual() -> Self {
        Self {
            squares: USUAL_FREEDOM * USUAL_SPREAD * USUAL_SPREAD,
            freedom: USUAL_FREEDOM,
        }
    }

    fn and(self, x: &[f64]) -> Self {
        let mean = mean(x);
        Self {
            squares: self.squares + x.iter().map(|x| (x - mean).powi(2)).sum::<f64>(),
            freedom: self.freedom + x.len() as f64 - 1.0,
        }
    }
}

/// What the chart says of some runs.
#[derive(Default)]
struct Chart {
    /// The run at which it leaves its limits.
    alarm: Option<usize>,
    /// The mean before the last run, where that is too rare to learn from.
    before_last: Option<f64>,
}

impl Chart {
    fn of(x: &[f64], known: Spread, h: f64) -> Self {
        let mut own = Self::default();
        let (mut up, mut down) = (0.0_f64, 0.0_f64);
        // mean and sum of squares about it, brought up to date run by run
        let (mut mean, mut squares, mut n) = (0.0, known.squares, 0.0);
        for (at, x) in x.iter().enumerate() {
            own.before_last = None;
            let freedom = known.freedom + n - 1.0;
            if n >= 1.0 && freedom >= 1.0 {
                let spread = (squares / freedom).sqrt().max(LEAST_SPREAD);
                let u = normal_score((n / (n + 1.0)).sqrt() * (x - mean) / spread, freedom);
                up = (up + u - ALLOWANCE).max(0.0);
                down = (down - u - ALLOWANCE).max(0.0);
                if up.max(down) > h {
                    own.alarm = Some(at);
                    return own;
                }
                let unlikely = if freedom < FEW {
                    UNLIKELY_OF_FEW
                } else {
                    UNLIKELY
                };
                if u.abs() > unlikely {
                    own.before_last = Some(mean);
                    continue;
                }
            }
            let step = x - mean;
            n += 1.0;
            mean += step / n;
            squares += step * (x - mean);
        }
        own
    }
}

/// The run in which it is noticed that the first is not like those behind it.
fn first_apart(x: &[f64], known: Spread) -> Option<usize> {
    (LEAST_RUNS..=x.len()).map(|count| count - 1).find(|last| {
        let behind = &x[1..=*last];
        let Spread { squares, freedom } = known.and(behind);
        let spread = (squares / freedom).sqrt().max(LEAST_SPREAD);
        let n = behind.len() as f64;
        let off = (n / (n + 1.0)).sqrt() * (x[0] - mean(behind)) / spread;
        normal_score(off, freedom).abs() > FIRST_APART
    })
}

/// The first run of the second part of the split with the largest sum of squares between its parts.
fn split(x: &[f64]) -> usize {
    let n = x.len() as f64;
    let all = mean(x);
    let mut sum = 0.0;
    let mut best = (x.len() - 1, 0.0);
    for (index, x) in x.iter().enumerate().take(x.len() - 1) {
        sum += x - all;
        let first = index as f64 + 1.0;
        let between = sum * sum * n / (first * (n - first));
        if between > best.1 {
            best = (index + 1, between);
        }
    }
    best.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::random::Random;

    /// Root mean square of so many normal numbers: the error of a run that measures a third as many
    /// positions, with a spread of its own from run to run.
    fn error(random: &mut Random, numbers: u32, spread: f64) -> f64 {
        let squares: f64 = (0..numbers).map(|_| random.normal().powi(2)).sum();
        (squares / f64::from(numbers)).sqrt() * (spread * random.normal()).exp()
    }

    /// Alarms a year of 365 runs, and runs up to the first, of `robots` that do not change.
    fn quiet(robots: u32, h: f64, draw: impl Fn(&mut Random) -> f64) -> f64 {
        let mut random = Random::new(21);
        let mut alarms = 0;
        for _ in 0..robots {
            let errors: Vec<f64> = (0..365).map(|_| draw(&mut random)).collect();
            alarms += changes_beyond(&errors, h).len();
        }
        alarms as f64 / f64::from(robots)
    }

    #[test]
    fn a_change_is_seen_after_four_runs() {
        let before = [0.031, 0.033, 0.035, 0.030];
        for after in [[0.270, 0.271, 0.273], [0.075, 0.080, 0.070]] {
            let found = changes(&[&before[..], &after].concat());
            assert_eq!(found.len(), 1, "{after:?}");
            assert_eq!(found[0].since, 4, "{after:?}");
        }
    }

    #[test]
    fn a_change_after_the_first_run_is_seen() {
        let mut random = Random::new(13);
        for (times, within) in [(3.0, 6), (6.0, 5), (0.2, 5)] {
            let (mut seen, count) = (0, 500);
            for _ in 0..count {
                let mut errors: Vec<f64> = (0..10).map(|_| error(&mut random, 60, 0.03)).collect();
                for e in &mut errors[1..] {
                    *e *= times;
                }
                let found = changes(&errors);
                let first = found.first();
                seen += usize::from(first.is_some_and(|c| c.since == 1 && c.noticed < within));
            }
            println!("{times} times after the first run: {seen} of {count}");
            assert!(20 * seen > 17 * count, "{times}: {seen}");
        }
        // one that goes on to change is seen again
        let found = changes(&[0.05, 0.3, 0.31, 0.29, 0.3, 0.31, 0.05, 0.051, 0.049]);
        assert_eq!(found.iter().map(|c| c.since).collect::<Vec<_>>(), [1, 6]);
        assert!((found[0].before - 0.05).abs() < 1e-12);
        assert!((found[0].after - 0.302).abs() < 1e-3, "{found:?}");
    }

    #[test]
    fn a_large_change_is_seen_after_two_runs() {
        let mut random = Random::new(12);
        for (before, times, within) in [(2, 6.0, 4), (2, 60.0, 3), (3, 6.0, 3), (4, 3.0, 4)] {
            let (mut seen, count) = (0, 500);
            for _ in 0..count {
                let mut errors: Vec<f64> = (0..10).map(|_| error(&mut random, 60, 0.03)).collect();
                for e in &mut errors[before..] {
                    *e *= times;
                }
                let found = changes(&errors);
                seen += usize::from(
                    found
                        .first()
                        .is_some_and(|c| c.since == before && c.noticed < before + within),
                );
            }
            println!("{times} times after {before} runs: {seen} of {count}");
            assert!(20 * seen > 19 * count, "{before} {times}: {seen}");
        }
        // and where nothing changes, a few runs are as quiet as many
        for spread in [0.0, 0.05, 0.2] {
            let (mut alarms, count) = (0, 4000);
            for _ in 0..count {
                let errors: Vec<f64> = (0..10).map(|_| error(&mut random, 60, spread)).collect();
                alarms += changes(&errors).len();
            }
            println!("{spread}: {alarms} alarms in {count} times ten runs");
            assert!(50 * alarms < count, "{spread}: {alarms}");
        }
    }

    #[test]
    fn runs_to_an_alarm_are_those_of_printed_tables() {
        // Montgomery, Introduction to Statistical Quality Control, table 9.3: k = 1/2, shifts of 0,
        // 1 and 2 standard deviations from the first run on that the chart judges
        for (h, shift, runs) in [(4.0, 0.0, 168.0), (5.0, 0.0, 465.0)] {
            let mut random = Random::new(5);
            let (count, mut sum) = (1500, 0.0);
            for _ in 0..count {
                // a spread far above the least one
                let x: Vec<f64> = (0..8000).map(|_| random.normal() + shift).collect();
                sum += Chart::of(&x, Spread::default(), h)
                    .alarm
                    .expect("in 8000 runs") as f64
                    - 1.0;
            }
            let found = sum / f64::from(count);
            assert!((found / runs - 1.0_f64).abs() < 0.08, "{h}: {found} {runs}");
        }
        // after many runs a shift is noticed as fast as by a chart that knows mean and spread
        for (h, shift, runs) in [
            (4.0, 1.0, 8.38),
            (4.0, 2.0, 3.34),
            (5.0, 1.0, 10.4),
            (5.0, 2.0, 4.01),
        ] {
            let mut random = Random::new(6);
            let (mut count, mut sum) = (0.0, 0.0);
            while count < 1500.0 {
                let quiet = (0..400).map(|_| random.normal());
                let mut x: Vec<f64> = quiet.collect();
                if Chart::of(&x, Spread::default(), h).alarm.is_some() {
                    continue;
                }
                x.extend((0..300).map(|_| random.normal() + shift));
                let Some(at) = Chart::of(&x, Spread::default(), h).alarm else {
                    continue;
                };
                sum += at as f64 - 399.0;
                count += 1.0;
            }
            let found = sum / count;
            assert!(
                (found / runs - 1.0).abs() < 0.08,
                "{h} {shift}: {found} {runs}"
            );
        }
    }

    #[test]
    fn a_robot_year_has_less_than_one_false_alarm() {
        for (positions, spread) in [(10, 0.0), (60, 0.0), (60, 0.05), (60, 0.2)] {
            let a_year = quiet(2000, LIMIT, |random| error(random, 3 * positions, spread));
            println!(
                "{positions} positions, {spread} from run to run: {a_year:.2} false alarms a \
                 robot-year"
            );
            assert!(a_year < 1.0);
        }
    }

    #[test]
    fn when_it_changed_is_said() {
        println!("error grows by | noticed after (median runs) | day right | within two runs");
        for (grows, soon, near) in [
            (1.1, 12, 0.5),
            (1.2, 6, 0.8),
            (1.5, 3, 0.95),
            (3.0, 1, 0.99),
        ] {
            let mut random = Random::new(8);
            let (mut after, mut right, mut close, count) = (Vec::new(), 0, 0, 1000);
            while after.len() < count {
                let mut errors: Vec<f64> = (0..90).map(|_| error(&mut random, 180, 0.03)).collect();
                for e in &mut errors[60..] {
                    *e *= grows;
                }
                let Some(change) = changes(&errors).into_iter().find(|c| c.noticed >= 60) else {
                    after.push(usize::MAX);
                    continue;
                };
                after.push(change.noticed - 59);
                right += usize::from(change.since == 60);
                close += usize::from(change.since.abs_diff(60) <= 2);
            }
            after.sort_unstable();
            let (median, part) = (after[count / 2], |n: usize| n as f64 / count as f64);
            println!(
                "{grows} | {median} | {:.2} | {:.2}",
                part(right),
                part(close)
            );
            assert!(
                median <= soon && part(close) >= near,
                "{grows}: {median} {}",
                part(close)
            );
        }
    }

    #[test]
    fn a_last_run_apart_is_said_before_a_change_is_sure() {
        let mut errors = vec![
            0.048, 0.050, 0.038, 0.051, 0.055, 0.055, 0.053, 0.054, 0.047,
        ];
        assert_eq!(before_last(&errors), None);
        errors.push(0.216);
        assert!(changes(&errors).is_empty());
        let before = before_last(&errors).expect("four times larger");
        assert!((before - 0.05).abs() < 0.002, "{before}");
        // and all is well again, or it is sure
        let again = [&errors[..], &[0.05]].concat();
        assert_eq!((before_last(&again), changes(&again).len()), (None, 0));
        let sure = [&errors[..], &[0.2]].concat();
        assert_eq!((before_last(&sure), changes(&sure).len()), (None, 1));
    }

    #[test]
    fn what_cannot_be_seen_is_no_change() {
        assert!(
            changes(&[]).is_empty()
                && changes(&[1.0]).is_empty()
                && changes(&[1.0, 9.0]).is_empty()
        );
        // the same error to the last digit, and none at all
        assert!(changes(&[0.05; 300]).is_empty() && changes(&[0.0; 20]).is_empty());
        // two bad runs, and all is well again
        let mut errors = [0.05, 0.051, 0.049, 0.05, 0.052].repeat(3);
        errors.extend([0.5, 0.51, 0.05, 0.05, 0.049, 0.051]);
        let found = changes(&errors);
        assert_eq!(found.iter().map(|c| c.since).collect::<Vec<_>>(), [15, 17]);
        assert!((found[0].after / found[1].before - 1.0).abs() < 1e-12 && found[0].after > 0.4);
        assert!((found[1].after / 0.05 - 1.0).abs() < 0.02);
    }
}
