//! Bad touches: found by the agreement of the others, named with the reason.

use super::RegisterError;
use super::kabsch::{Fit, kabsch, noise_m};
use crate::geometry::{Vector, dot};

/// Largest number of triples that are all tried; above it so many are drawn.
const TRIPLES: usize = 3000;
/// Median of χ² with three degrees of freedom.
const MEDIAN_CHI2_3: f64 = 2.366;
/// A touch is bad if its distance is more than this many standard deviations of a coordinate: χ² of
/// three at 99.97 %.
pub const LIMIT: f64 = 4.35;
/// Fewest points from which a bad one can be found: with four, one that is off across the plane of
/// the others tilts them; with five, the three that happen to fit best often contradict good ones.
pub const FEWEST: usize = 6;

/// A touch that disagrees with the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BadTouch {
    /// Index in the sets.
    pub index: usize,
    /// How far it is from where the others put it, metres.
    pub distance_m: f64,
    /// The same in standard deviations of a coordinate.
    pub sigmas: f64,
}

/// A fit without the bad touches.
#[derive(Clone, Debug)]
pub struct Robust {
    /// Fitted to the good ones.
    pub fit: Fit,
    /// Weights of all: zero for the bad ones.
    pub weights: Vec<f64>,
    /// The bad ones, in order.
    pub rejected: Vec<BadTouch>,
    /// Standard deviation of a coordinate by which they were judged, metres.
    pub sigma_m: f64,
}

/// Fits a rigid motion to the points that agree, and tells which do not.
///
/// Motions through triples of points are judged by the median of the squared distances of all; the
/// best gives the noise (unless `sigma_m` does) and the points within [`LIMIT`] of it. Fit and
/// choice are repeated until they stay.
///
/// # Errors
/// As [`kabsch`]; fewer than [`FEWEST`] points; or no motion that more than half of the points
/// agree with.
///
/// # Source
/// P. Rousseeuw, "Least median of squares regression" (1984); M. Fischler, R. Bolles (1981) for the
/// choice by triples.
pub fn robust(
    from: &[Vector],
    to: &[Vector],
    weights: Option<&[f64]>,
    sigma_m: Option<f64>,
) -> Result<Robust, RegisterError> {
    kabsch_of_whole(from, to, weights)?;
    agreeing(from, to, weights, sigma_m, FEWEST)
}

/// The same of at least `fewest` points: of five, what it names is a suspicion.
///
/// # Errors
/// As [`robust`].
pub fn agreeing(
    from: &[Vector],
    to: &[Vector],
    weights: Option<&[f64]>,
    sigma_m: Option<f64>,
    fewest: usize,
) -> Result<Robust, RegisterError> {
    let n = from.len();
    if n < fewest {
        return Err(RegisterError::TooFewToJudge {
            found: n,
            needed: fewest,
        });
    }
    let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
    let squared = |fit: &Fit| -> Vec<f64> {
        let left = fit.residuals_m(from, to);
        let each = left.iter().enumerate();
        each.map(|(i, r)| weight(i) * dot(*r, *r)).collect()
    };
    let mut best: Option<(f64, Fit)> = None;
    for triple in triples(n) {
        let (f, t) = (triple.map(|i| from[i]), triple.map(|i| to[i]));
        let Ok(fit) = kabsch(&f, &t, None) else {
            continue;
        };
        let median = median(squared(&fit));
        if best.as_ref().is_none_or(|(least, _)| median < *least) {
            best = Some((median, fit));
        }
    }
    let (least, mut fit) = best.ok_or(RegisterError::NoAgreement { points: n })?;
    #[allow(clippy::cast_precision_loss)]
    let small_set = 1.0 + 5.0 / (n as f64 - 3.0);
    let mut sigma = sigma_m.unwrap_or(small_set * (least / MEDIAN_CHI2_3).sqrt());
    let floor = 1e-9;
    let mut kept: Vec<f64> = Vec::new();
    for _ in 0..20 {
        let one_m = sigma.max(floor);
        let inside = squared(&fit);
        // where the others put a point they do not know exactly either
        let others = (!kept.is_empty()).then(|| fit.covariance(from, Some(&kept), one_m));
        let limit = |i: usize| {
            let of_others = others
                .as_ref()
                .filter(|_| kept[i] == 0.0)
                .map_or(0.0, |of| {
                    let sigmas = of.sigma_at_m(fit.to_from_from.transform(from[i]));
                    dot(sigmas, sigmas) / 3.0
                });
            LIMIT * LIMIT * (one_m * one_m + weight(i) * of_others)
        };
        let now: Vec<f64> = (0..n)
            .map(|i| {
                if inside[i] <= limit(i) {
                    weight(i)
                } else {
                    0.0
                }
            })
            .collect();
        let count = now.iter().filter(|w| **w > 0.0).count();
        if 2 * count <= n || count < 4 {
            return Err(RegisterError::NoAgreement { points: n });
        }
        fit = kabsch(from, to, Some(&now))?;
        if sigma_m.is_none() {
            sigma = noise_m(&fit.residuals_m(from, to), Some(&now));
        }
        if now == kept {
            break;
        }
        kept = now;
    }
    let distances = squared(&fit);
    let rejected = (0..n)
        .filter(|i| kept[*i] == 0.0 && weight(*i) > 0.0)
        .map(|index| BadTouch {
            index,
            distance_m: (distances[index] / weight(index)).sqrt(),
            sigmas: distances[index].sqrt() / sigma.max(floor),
        })
        .collect();
    Ok(Robust {
        fit,
        weights: kept,
        rejected,
        sigma_m: sigma,
    })
}

/// The faults of whole sets that no choice of points heals; a mirror image may be the work of bad
/// touches.
fn kabsch_of_whole(
    from: &[Vector],
    to: &[Vector],
    weights: Option<&[f64]>,
) -> Result<(), RegisterError> {
    match kabsch(from, to, weights) {
        Ok(_) | Err(RegisterError::Mirrored { .. } | RegisterError::Unlike { .. }) => Ok(()),
        Err(error) => Err(error),
    }
}

/// All triples of `n`, or a repeatable draw of them.
fn triples(n: usize) -> Vec<[usize; 3]> {
    if n * (n - 1) * (n - 2) / 6 <= TRIPLES {
        let pairs = (0..n).flat_map(|a| (a + 1..n).map(move |b| (a, b)));
        return pairs
            .flat_map(|(a, b)| (b + 1..n).map(move |c| [a, b, c]))
            .collect();
    }
    let mut draw = super::Draw::new(0x7021);
    let mut triples = Vec::with_capacity(TRIPLES);
    while triples.len() < TRIPLES {
        let [a, b, c] = [(); 3].map(|()| draw.below(n));
        if a != b && b != c && a != c {
            triples.push([a, b, c]);
        }
    }
    triples
}

fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}
