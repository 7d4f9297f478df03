//! How far a model is from measurements: positions, orientations, distances.

use super::measurements::Observed;
use super::observation::Observation;
use super::problem::{Estimate, Problem, Row};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Vector, norm};
use crate::model::Motion;

/// Statistics of the size of an error, in the unit it was given in.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Spread {
    /// How many.
    pub n: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation about the mean (n − 1).
    pub std: f64,
    /// Root mean square.
    pub rms: f64,
    /// 95 % are not larger.
    pub p95: f64,
    /// 99.7 % are not larger.
    pub p997: f64,
    /// Largest.
    pub max: f64,
}

impl Spread {
    /// Of these sizes; `None` of none.
    #[must_use]
    pub fn of(sizes: &[f64]) -> Option<Self> {
        if sizes.is_empty() {
            return None;
        }
        let n = sizes.len();
        let count = n as f64;
        let mean = sizes.iter().sum::<f64>() / count;
        let about: f64 = sizes.iter().map(|s| (s - mean).powi(2)).sum();
        let mut sorted = sizes.to_vec();
        sorted.sort_by(f64::total_cmp);
        Some(Self {
            n,
            mean,
            std: if n > 1 {
                (about / (count - 1.0)).sqrt()
            } else {
                0.0
            },
            rms: (sizes.iter().map(|s| s * s).sum::<f64>() / count).sqrt(),
            p95: quantile(&sorted, 0.95),
            p997: quantile(&sorted, 0.997),
            max: sorted[n - 1],
        })
    }

    /// Mean plus three standard deviations, as ISO 9283 states accuracy of a distance.
    #[must_use]
    pub fn mean_plus_3std(&self) -> f64 {
        self.mean + 3.0 * self.std
    }
}

/// Quantile of sorted numbers, linear between neighbours.
#[must_use]
pub fn quantile(sorted: &[f64], part: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return 0.0;
    };
    let at = part * last as f64;
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 to the length"
    )]
    let low = at.floor() as usize;
    let high = (low + 1).min(last);
    sorted[low] + (at - low as f64) * (sorted[high] - sorted[low])
}

/// What a model misses of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Miss {
    /// Measured minus expected: metres, then radians of a pose; one metre of a distance.
    pub gap: [f64; 6],
    /// Size of the gap in position, or of the distance, metres.
    pub length_m: f64,
    /// Angle between the orientations, radians; of a pose.
    pub angle_rad: Option<f64>,
    /// Root of the mean square of the gap in standard deviations of the row.
    pub normalised: f64,
    /// Where the point is expected in the world, metres.
    pub expected_m: Vector,
}

/// What a model misses of every row of a problem.
#[must_use]
pub fn misses(problem: &Problem, estimate: &Estimate) -> Vec<Miss> {
    let models = problem.models(estimate, &[]);
    let mut none: [Motion; 0] = [];
    problem
        .rows
        .iter()
        .map(|row| {
            let pose = models[row.rig].evaluate(&row.q, &row.conditions, &mut none);
            let seen = problem.observe(estimate, row, pose);
            miss(row, &seen)
        })
        .collect()
}

fn miss(row: &Row, seen: &Observation) -> Miss {
    let (gap, weights, count) = (seen.gap(), seen.weights(), row.observed.count());
    let squared: f64 = (0..count).map(|k| (gap[k] * weights[k]).powi(2)).sum();
    let first = [gap[0], gap[1], gap[2]];
    Miss {
        gap,
        length_m: norm(first),
        angle_rad: matches!(row.observed, Observed::Pose(_))
            .then(|| norm([gap[3], gap[4], gap[5]])),
        normalised: (squared / count as f64).sqrt(),
        expected_m: seen.expected_m(),
    }
}

/// Statistics of one model on measurements.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Quality {
    /// Error of position, mm.
    pub position: Option<Spread>,
    /// Error of orientation, degrees.
    pub orientation: Option<Spread>,
    /// Error of distances measured from fixed points, or between a ball and the surface it
    /// touches, mm.
    pub range: Option<Spread>,
}

impl Quality {
    /// Of these misses.
    #[must_use]
    pub fn of(rows: &[Row], misses: &[Miss]) -> Self {
        let is_range = |row: &Row| row.observed.count() == 1;
        let lengths = |ranges: bool| {
            let both = rows
                .iter()
                .zip(misses)
                .filter(|(row, _)| is_range(row) == ranges);
            both.map(|(_, miss)| mm_from_m(miss.length_m))
                .collect::<Vec<_>>()
        };
        let angles: Vec<f64> = misses
            .iter()
            .filter_map(|m| m.angle_rad)
            .map(|a| a / DEG)
            .collect();
        Self {
            position: Spread::of(&lengths(false)),
            orientation: Spread::of(&angles),
            range: Spread::of(&lengths(true)),
        }
    }

    /// The one that tells most: position where it was measured, else distances.
    #[must_use]
    pub fn main(&self) -> Option<Spread> {
        self.position.or(self.range)
    }
}

pub use super::pairs::{Pairs, pairs};

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud(count: usize, error: f64) -> (Vec<Vector>, Vec<Vector>) {
        let wave = |k: usize, f: f64| (k as f64 * f).sin();
        let measured: Vec<Vector> = (0..count)
            .map(|k| [wave(k, 1.3), wave(k, 2.1), wave(k, 0.7)])
            .collect();
        let expected = measured
            .iter()
            .enumerate()
            .map(|(k, p)| {
                [
                    p[0] + error * wave(k, 5.1),
                    p[1] + error * wave(k, 3.3),
                    p[2] - error * wave(k, 9.7),
                ]
            })
            .collect();
        (measured, expected)
    }

    fn plain(measured: &[Vector], expected: &[Vector]) -> Vec<f64> {
        let mut errors = Vec::new();
        for i in 0..measured.len() {
            for j in i + 1..measured.len() {
                let d = |p: &[Vector]| norm(crate::geometry::sub(p[i], p[j]));
                errors.push((d(measured) - d(expected)).abs());
            }
        }
        errors
    }

    #[test]
    fn streamed_pairs_agree_with_a_plain_loop() {
        for (count, error) in [(2, 1e-4), (9, 1e-4), (300, 1e-4), (611, 1e-3), (1203, 0.3)] {
            let (measured, expected) = cloud(count, error);
            let peer = Spread::of(&plain(&measured, &expected)).expect("some pairs");
            let mine = pairs(&measured, &expected).expect("some pairs");
            assert_eq!(mine.pairs, peer.n as u64);
            assert!((mine.mean / peer.mean - 1.0).abs() < 2e-6, "{count}");
            assert!(
                (mine.std - peer.std).abs() < 2e-6 * (peer.std + peer.mean),
                "{count}"
            );
            assert!((mine.max / peer.max - 1.0).abs() < 2e-6, "{count}");
        }
    }

    #[test]
    fn of_many_points_a_sample_of_pairs_stands_for_all() {
        let count = 21_000;
        let (measured, expected) = cloud(count, 1e-3);
        let mine = pairs(&measured, &expected).expect("some pairs");
        // each with thousands of others, in the order of the file no neighbours
        let each = mine.pairs as f64 / count as f64;
        assert!((7_000.0..11_000.0).contains(&each), "{each}");
        let plain: Vec<f64> = plain(&measured[..3_000], &expected[..3_000]);
        let peer = Spread::of(&plain).expect("some pairs");
        assert!((mine.mean / peer.mean - 1.0).abs() < 0.01);
        assert!((mine.std / peer.std - 1.0).abs() < 0.01);
    }

    #[test]
    fn points_that_coincide_have_the_error_of_their_distance() {
        let measured = vec![[0.5, 0.5, 0.5]; 20];
        let expected: Vec<Vector> = (0..20)
            .map(|k| [0.5 + 1e-5 * f64::from(k), 0.5, 0.5])
            .collect();
        let mine = pairs(&measured, &expected).expect("some pairs");
        assert!((mine.max - 19e-5).abs() < 1e-12);
    }

    #[test]
    fn quantiles_lie_between_their_neighbours() {
        let spread = Spread::of(&[1.0, 2.0, 3.0, 4.0, 5.0]).expect("five numbers");
        assert!((spread.p95 - 4.8).abs() < 1e-12 && spread.max == 5.0 && spread.mean == 3.0);
        assert!((spread.std - 2.5_f64.sqrt()).abs() < 1e-12);
    }
}
