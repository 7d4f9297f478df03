//! Errors of distances between all pairs of points, streamed.

use crate::geometry::{Vector, norm};
use rayon::prelude::*;

/// Errors of the distances between all pairs of points.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Pairs {
    /// How many pairs.
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

/// Points that are compared with a block of others at a time: their coordinates stay in the nearest cache.
const BLOCK: usize = 256;
/// Pairs side by side.
const WIDTH: usize = 8;
/// Beyond this part of a distance, squared, its error is computed the long way.
const LARGE: f32 = 1e-3;

/// Coordinates by axis, padded to whole blocks with the last point.
struct Cloud {
    /// Measured x, y, z, then expected x, y, z.
    axes: [Vec<f64>; 6],
    count: usize,
}

#[derive(Clone, Copy, Default)]
struct PairSums {
    sum: f64,
    squares: f64,
    max: f64,
}

struct PairKernel<'a> {
    cloud: &'a Cloud,
    /// Blocks of first points.
    blocks: std::ops::Range<usize>,
}

impl pulp::NullaryFnOnce for PairKernel<'_> {
    type Output = PairSums;

    #[inline(always)]
    fn call(self) -> PairSums {
        let mut total = PairSums::default();
        let count = self.cloud.count;
        let [ax, ay, az, bx, by, bz] = self.cloud.axes.each_ref().map(Vec::as_slice);
        for block in self.blocks {
            let (from, to) = (block * BLOCK, ((block + 1) * BLOCK).min(count));
            let mut second = from;
            while second < count {
                let end = (second + BLOCK).min(count);
                for i in from..to {
                    let a = [ax[i], ay[i], az[i]];
                    let b = [bx[i], by[i], bz[i]];
                    // pairs with a later point only
                    let start = second.max(i + 1);
                    if start >= end {
                        continue;
                    }
                    let mut sums = [0.0_f32; WIDTH];
                    let mut squares = [0.0_f32; WIDTH];
                    let mut most = [0.0_f32; WIDTH];
                    let mut doubt = [0.0_f32; WIDTH];
                    let whole = (end - start) / WIDTH;
                    for k in 0..whole {
                        let j = start + k * WIDTH;
                        let (px, py, pz) =
                            (&ax[j..j + WIDTH], &ay[j..j + WIDTH], &az[j..j + WIDTH]);
                        let (rx, ry, rz) =
                            (&bx[j..j + WIDTH], &by[j..j + WIDTH], &bz[j..j + WIDTH]);
                        let mut difference = [0.0_f32; WIDTH];
                        let mut both = [0.0_f32; WIDTH];
                        for l in 0..WIDTH {
                            let (x, y, z) = (px[l] - a[0], py[l] - a[1], pz[l] - a[2]);
                            let (u, v, w) = (rx[l] - b[0], ry[l] - b[1], rz[l] - b[2]);
                            // |p|² − |r|² without cancellation, and their sum
                            let d = (x - u) * (x + u) + (y - v) * (y + v) + (z - w) * (z + w);
                            let s = (x * x + y * y + z * z) + (u * u + v * v + w * w);
                            #[allow(
                                clippy::cast_possible_truncation,
                                reason = "a quotient of them is taken"
                            )]
                            {
                                difference[l] = d as f32;
                                both[l] = s as f32;
                            }
                        }
                        for l in 0..WIDTH {
                            // |p| − |r| = d / (|p| + |r|), and (|p| + |r|)² = 2s − (|p| − |r|)²
                            let first =
                                difference[l] / (both[l] + both[l] + f32::MIN_POSITIVE).sqrt();
                            let part = first * first / (both[l] + both[l] + f32::MIN_POSITIVE);
                            let error = first.abs() * (1.0 + 0.5 * part);
                            sums[l] += error;
                            squares[l] += error * error;
                            most[l] = if error > most[l] { error } else { most[l] };
                            doubt[l] = if part > doubt[l] { part } else { doubt[l] };
                        }
                    }
                    let mut tail = start + whole * WIDTH;
                    if doubt.iter().any(|d| *d > LARGE) {
                        // some pair is as near as its error: all of this strip the long way
                        tail = start;
                    } else {
                        for l in 0..WIDTH {
                            total.sum += f64::from(sums[l]);
                            total.squares += f64::from(squares[l]);
                            total.max = total.max.max(f64::from(most[l]));
                        }
                    }
                    for j in tail..end {
                        let p = [ax[j] - a[0], ay[j] - a[1], az[j] - a[2]];
                        let r = [bx[j] - b[0], by[j] - b[1], bz[j] - b[2]];
                        let error = (norm(p) - norm(r)).abs();
                        total.sum += error;
                        total.squares += error * error;
                        total.max = total.max.max(error);
                    }
                }
                second += BLOCK;
            }
        }
        total
    }
}

/// Errors of the distances between all pairs of points, in the unit of the points; `None` with fewer than two points.
///
/// Memory is that of the points. Differences are taken in double precision and only their quotient in single: the mean is
/// right to some 1e-6 of itself.
#[must_use]
pub fn pairs(measured: &[Vector], expected: &[Vector]) -> Option<Pairs> {
    let count = measured.len().min(expected.len());
    if count < 2 {
        return None;
    }
    let axis =
        |points: &[Vector], k: usize| points[..count].iter().map(|p| p[k]).collect::<Vec<_>>();
    let cloud = Cloud {
        axes: std::array::from_fn(|k| {
            if k < 3 {
                axis(measured, k)
            } else {
                axis(expected, k - 3)
            }
        }),
        count,
    };
    let blocks = count.div_ceil(BLOCK);
    let run = |block: usize| {
        let kernel = PairKernel {
            cloud: &cloud,
            blocks: block..block + 1,
        };
        pulp::Arch::new().dispatch(kernel)
    };
    let parts: Vec<PairSums> = if count > 1000 {
        (0..blocks).into_par_iter().map(run).collect()
    } else {
        (0..blocks).map(run).collect()
    };
    let mut total = PairSums::default();
    for part in parts {
        total.sum += part.sum;
        total.squares += part.squares;
        total.max = total.max.max(part.max);
    }
    let pairs = (count as u64) * (count as u64 - 1) / 2;
    let n = pairs as f64;
    let mean = total.sum / n;
    let about = (total.squares - n * mean * mean).max(0.0);
    Some(Pairs {
        pairs,
        mean,
        std: if pairs > 1 {
            (about / (n - 1.0)).sqrt()
        } else {
            0.0
        },
        max: total.max,
    })
}
