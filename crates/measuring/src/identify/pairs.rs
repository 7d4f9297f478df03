//! Errors of distances between all pairs of points, streamed.

use crate::geometry::{Vector, norm, sub};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

/// Errors of the distances between all pairs of points.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Pairs {
    /// How many pairs were compared.
    pub pairs: u64,
    /// Mean of the error's size.
    pub mean: f64,
    /// Its standard deviation (n − 1).
    pub std: f64,
    /// Largest.
    pub max: f64,
}

impl Pairs {
    /// Mean plus three standard deviations.
    #[must_use]
    pub fn mean_plus_3std(&self) -> f64 {
        self.mean + 3.0 * self.std
    }
}

/// Points that are compared with a block of others at a time: their coordinates stay in the nearest
/// cache.
const BLOCK: usize = 512;
/// Points of which all pairs are compared. Of more, as many pairs as these have are compared, picked
/// at random.
const ALL: usize = 20_000;
/// Beyond this part of a distance, squared, its error is computed the long way.
const LARGE: f32 = 1e-3;
/// Points nearer than this part of the cloud's extent are compared the long way.
const NEAR: f64 = 1e-3;

/// Coordinates by axis.
struct Cloud<'a> {
    measured: &'a [Vector],
    expected: &'a [Vector],
    /// Measured minus expected, less the mean of that.
    gaps: [Vec<f32>; 3],
    /// Measured plus expected, less the mean of that.
    sums: [Vec<f32>; 3],
    /// Square of the sum's difference below which the long way is gone.
    near: f32,
}

impl<'a> Cloud<'a> {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "relative to the mean, single precision tells a part in 1e7 of the extent"
    )]
    fn of(measured: &'a [Vector], expected: &'a [Vector]) -> Self {
        let axis = |k: usize, sign: f64| {
            let both = || {
                measured
                    .iter()
                    .zip(expected)
                    .map(|(m, e)| m[k] + sign * e[k])
            };
            let mean = both().sum::<f64>() / measured.len() as f64;
            both().map(|x| (x - mean) as f32).collect::<Vec<_>>()
        };
        let sums: [Vec<f32>; 3] = std::array::from_fn(|k| axis(k, 1.0));
        let extent = sums
            .iter()
            .flatten()
            .fold(0.0_f32, |most, x| most.max(x.abs()));
        Self {
            measured,
            expected,
            gaps: std::array::from_fn(|k| axis(k, -1.0)),
            sums,
            near: (NEAR * f64::from(extent)).powi(2) as f32,
        }
    }

    /// The pairs of point `i` with points `from..to`, in double precision.
    fn long_way(&self, i: usize, from: usize, to: usize, total: &mut PairSums) {
        for j in from..to {
            let p = sub(self.measured[j], self.measured[i]);
            let r = sub(self.expected[j], self.expected[i]);
            // |p| − |r| without cancellation
            let whole = norm(p) + norm(r);
            let parts: f64 = (0..3).map(|k| (p[k] - r[k]) * (p[k] + r[k])).sum();
            let error = if whole > 0.0 {
                (parts / whole).abs()
            } else {
                0.0
            };
            total.sum += error;
            total.squares += error * error;
            total.max = total.max.max(error);
        }
    }
}

#[derive(Clone, Copy, Default)]
struct PairSums {
    pairs: u64,
    sum: f64,
    squares: f64,
    max: f64,
}

/// With δ and σ the differences of the gaps and of the sums of two points, `|p|² − |r|² = δ·σ` and
/// `(|p| + |r|)² = |σ|² + |δ|² − (|p| − |r|)²`: nothing large is subtracted.
struct PairKernel<'a> {
    cloud: &'a Cloud<'a>,
    /// A block of first points.
    block: usize,
    /// Blocks of second points, its own the first.
    width: usize,
}

impl WithSimd for PairKernel<'_> {
    type Output = PairSums;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> PairSums {
        let mut total = PairSums::default();
        let cloud = self.cloud;
        let count = cloud.measured.len();
        let (one, half) = (simd.splat_f32s(1.0), simd.splat_f32s(0.5));
        let zero = simd.splat_f32s(0.0);
        let (first, last) = (self.block * BLOCK, ((self.block + 1) * BLOCK).min(count));
        let beyond = ((self.block + self.width) * BLOCK).min(count);
        let mut second = first;
        while second < beyond {
            let end = (second + BLOCK).min(count);
            // each with those behind it
            let (mine, theirs) = ((last - first) as u64, (end - second) as u64);
            total.pairs += if second == first {
                mine * (mine - 1) / 2
            } else {
                mine * theirs
            };
            for i in first..last {
                // pairs with a later point only
                let start = second.max(i + 1);
                if start >= end {
                    continue;
                }
                let at = |axis: &Vec<f32>| simd.splat_f32s(axis[i]);
                let (u0, v0, w0) = (at(&cloud.gaps[0]), at(&cloud.gaps[1]), at(&cloud.gaps[2]));
                let (x0, y0, z0) = (at(&cloud.sums[0]), at(&cloud.sums[1]), at(&cloud.sums[2]));
                let (us, _) = S::as_simd_f32s(&cloud.gaps[0][start..end]);
                let (vs, _) = S::as_simd_f32s(&cloud.gaps[1][start..end]);
                let (ws, _) = S::as_simd_f32s(&cloud.gaps[2][start..end]);
                let (xs, _) = S::as_simd_f32s(&cloud.sums[0][start..end]);
                let (ys, _) = S::as_simd_f32s(&cloud.sums[1][start..end]);
                let (zs, tail) = S::as_simd_f32s(&cloud.sums[2][start..end]);
                let (mut sum, mut squares, mut most, mut uncertain) = (zero, zero, zero, zero);
                let mut nearest = simd.splat_f32s(f32::MAX);
                let gaps = us.iter().zip(vs).zip(ws);
                for (((&u, &v), &w), ((&x, &y), &z)) in gaps.zip(xs.iter().zip(ys).zip(zs)) {
                    let (u, v, w) = (
                        simd.sub_f32s(u, u0),
                        simd.sub_f32s(v, v0),
                        simd.sub_f32s(w, w0),
                    );
                    let (x, y, z) = (
                        simd.sub_f32s(x, x0),
                        simd.sub_f32s(y, y0),
                        simd.sub_f32s(z, z0),
                    );
                    let across = simd.mul_f32s(u, x);
                    let across = simd.mul_add_e_f32s(v, y, across);
                    let across = simd.mul_add_e_f32s(w, z, across);
                    let whole = simd.mul_f32s(x, x);
                    let whole = simd.mul_add_e_f32s(y, y, whole);
                    let whole = simd.mul_add_e_f32s(z, z, whole);
                    nearest = simd.min_f32s(nearest, whole);
                    let whole = simd.mul_add_e_f32s(u, u, whole);
                    let whole = simd.mul_add_e_f32s(v, v, whole);
                    let whole = simd.mul_add_e_f32s(w, w, whole);
                    let inverse = simd.div_f32s(one, simd.sqrt_f32s(whole));
                    let near = simd.mul_f32s(across, inverse);
                    let part = simd.mul_f32s(near, inverse);
                    let part = simd.mul_f32s(part, part);
                    uncertain = simd.max_f32s(uncertain, part);
                    let near = simd.abs_f32s(near);
                    let error = simd.mul_add_e_f32s(near, simd.mul_f32s(half, part), near);
                    sum = simd.add_f32s(sum, error);
                    squares = simd.mul_add_e_f32s(error, error, squares);
                    most = simd.max_f32s(most, error);
                }
                let clear = simd.reduce_max_f32s(uncertain) < LARGE
                    && simd.reduce_min_f32s(nearest) > cloud.near;
                if clear {
                    total.sum += f64::from(simd.reduce_sum_f32s(sum));
                    total.squares += f64::from(simd.reduce_sum_f32s(squares));
                    total.max = total.max.max(f64::from(simd.reduce_max_f32s(most)));
                    cloud.long_way(i, end - tail.len(), end, &mut total);
                } else {
                    // some pair is as near as its error: all of this strip
                    cloud.long_way(i, start, end, &mut total);
                }
            }
            second += BLOCK;
        }
        total
    }
}

/// A fixed random order of so many things: Fisher–Yates by the numbers of splitmix64.
fn shuffled(count: usize) -> Vec<usize> {
    let mut state = 0u64;
    let mut random = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    };
    let mut order: Vec<usize> = (0..count).collect();
    for last in (1..count).rev() {
        let below = (u128::from(random()) * (last as u128 + 1)) >> 64;
        order.swap(last, usize::try_from(below).expect("at most `last`"));
    }
    order
}

/// Errors of the distances between all pairs of points, in the unit of the points; `None` with
/// fewer than two points.
///
/// Of more than 20 000 points not all pairs are compared but some 200 million, picked at random, the
/// same in every run. Mean and standard deviation are then those of this sample, and the largest
/// error is its largest.
///
/// Memory is that of the points. Sums and differences of measured and expected points are rounded
/// to single precision about their means: the mean is right to some 1e-6 of itself. Points that
/// nearly coincide are compared in double precision.
#[must_use]
pub fn pairs(measured: &[Vector], expected: &[Vector]) -> Option<Pairs> {
    let count = measured.len().min(expected.len());
    if count < 2 {
        return None;
    }
    let blocks = count.div_ceil(BLOCK);
    if count > ALL {
        let order = shuffled(count);
        let picked = |of: &[Vector]| order.iter().map(|i| of[*i]).collect::<Vec<_>>();
        let cloud = (picked(measured), picked(expected));
        let others = ALL.div_ceil(2 * BLOCK) * ALL.div_ceil(BLOCK);
        return Some(compared(&cloud.0, &cloud.1, others.div_ceil(blocks)));
    }
    Some(compared(&measured[..count], &expected[..count], blocks))
}

/// Errors of the distances from the points of each block to those of as many blocks from it on.
fn compared(measured: &[Vector], expected: &[Vector], width: usize) -> Pairs {
    let count = measured.len();
    let blocks = count.div_ceil(BLOCK);
    let cloud = Cloud::of(measured, expected);
    let arch = Arch::new();
    let run = |block: usize| {
        arch.dispatch(PairKernel {
            cloud: &cloud,
            block,
            width,
        })
    };
    let parts: Vec<PairSums> = if count > 1000 {
        (0..blocks).into_par_iter().map(run).collect()
    } else {
        (0..blocks).map(run).collect()
    };
    let mut total = PairSums::default();
    for part in parts {
        total.pairs += part.pairs;
        total.sum += part.sum;
        total.squares += part.squares;
        total.max = total.max.max(part.max);
    }
    let n = total.pairs as f64;
    let mean = total.sum / n;
    let about = (total.squares - n * mean * mean).max(0.0);
    Pairs {
        pairs: total.pairs,
        mean,
        std: if total.pairs > 1 {
            (about / (n - 1.0)).sqrt()
        } else {
            0.0
        },
        max: total.max,
    }
}
