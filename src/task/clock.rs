//! What `time_s` counts from, by what a model that counts with it misses.

use crate::diagnose::estimator::chances::mean_tail;
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::identify::clock::{Late, from_first_row};
use crate::identify::measurements::Measurements;
use crate::identify::problem::Problem;
use crate::identify::statistics::Miss;
use crate::model::effects::{Kind, Need};
use std::collections::BTreeMap;

/// One clock is better than another where that is less likely by chance.
const BEYOND_CHANCE: f64 = 1e-3;

/// Whether one of these effects counts with time.
pub(super) fn any_timed<'a>(mut kinds: impl Iterator<Item = &'a Kind>) -> bool {
    kinds.any(|kind| kind.definition().needs.contains(&Need::Time))
}

/// Times that begin late, and the same rows by a clock that counts from the first of them.
pub(super) struct Doubted {
    late: Late,
    pub(super) from_first: Measurements,
}

/// What rows say of a clock that begins late.
pub(super) enum Answer {
    /// With it the model misses less than with one that counts from the first row.
    Right,
    /// Neither is better.
    Open,
    /// One that counts from the first row is better.
    Wrong {
        /// Mean error by the clock, metres.
        by_it_m: f64,
        /// By one that counts from the first row.
        from_first_m: f64,
    },
}

fn mean_m(misses: &[Miss]) -> f64 {
    let sum: f64 = misses.iter().map(|miss| miss.length_m).sum();
    sum / misses.len().max(1) as f64
}

/// What the same model says of a clock: what it misses of these rows by it, and by one that counts
/// from the first of them.
pub(super) fn judged(
    rows: &Measurements,
    problem: &Problem,
    by_it: &[Miss],
    from_first: &[Miss],
) -> Answer {
    let configurations = rows.configurations();
    let mut by: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
    for ((row, own), other) in problem.rows.iter().zip(by_it).zip(from_first) {
        let (sum, count) = by.entry(configurations[row.measurement]).or_default();
        *sum += own.length_m - other.length_m;
        *count += 1.0;
    }
    let more: Vec<f64> = by.values().map(|(sum, count)| sum / count).collect();
    let less: Vec<f64> = more.iter().map(|more| -more).collect();
    if mean_tail(&more) < BEYOND_CHANCE {
        Answer::Wrong {
            by_it_m: mean_m(by_it),
            from_first_m: mean_m(from_first),
        }
    } else if mean_tail(&less) < BEYOND_CHANCE {
        Answer::Right
    } else {
        Answer::Open
    }
}

impl Doubted {
    pub(super) fn of(all: &Measurements) -> Option<Self> {
        Some(Self {
            late: Late::of(&all.rows)?,
            from_first: from_first_row(all),
        })
    }

    /// That the clock begins late.
    pub(super) fn finding(&self, name: &str, answer: &Answer) -> Finding {
        let late = &self.late;
        let (message, hint) = match answer {
            Answer::Wrong {
                by_it_m,
                from_first_m,
            } => (
                format!(
                    "{late}: that clock does not count from switching the cold robot on, as \
                     warm-up does; counted from the first row the mean error is {:.3} mm, by it \
                     {:.3} mm",
                    mm_from_m(*from_first_m),
                    mm_from_m(*by_it_m)
                ),
                "let time_s count from when the cold robot was switched on; where it stood cold \
                 until the first row, from the first row",
            ),
            Answer::Right | Answer::Open => (
                format!(
                    "{late}: warm-up counts from switching the cold robot on, and is over before \
                     the first row, or that clock counts from elsewhere"
                ),
                "let time_s count from when the cold robot was switched on, and measure from then \
                 on",
            ),
        };
        Finding::of_file("time-late", Severity::Warning, name, message).hint(hint)
    }
}
