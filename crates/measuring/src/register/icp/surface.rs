//! A cloud as a surface: nearest neighbours, tangent planes, how rough it is.

use super::CHUNK;
use crate::geometry::{Vector, add, cross, dot, norm, scale, sub};
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// Neighbours that give a tangent plane.
const NEIGHBOURS: usize = 10;

/// A cloud with a tree, normals, and how rough it is.
pub(super) struct Surface {
    pub(super) points: Vec<Vector>,
    pub(super) tree: ImmutableKdTree<f64, 3>,
    pub(super) normals: Vec<Vector>,
    /// Median deviation from the tangent planes, metres.
    pub(super) roughness_m: f64,
    /// Median distance to the fourth neighbour, metres.
    pub(super) spacing_m: f64,
    /// Median of what noise and curvature make of a normal, squared angle.
    pub(super) tilt: f64,
}

/// Positions in the order of a space-filling curve (Z order): neighbours in space are neighbours in
/// memory.
pub(super) fn along_curve(points: &[Vector]) -> Vec<usize> {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for p in points {
        for i in 0..3 {
            low[i] = low[i].min(p[i]);
            high[i] = high[i].max(p[i]);
        }
    }
    let longest = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
    let unit = 1023.0 / longest.max(f64::MIN_POSITIVE);
    let spread = |cell: u32| (0..10).fold(0_u32, |key, bit| key | ((cell >> bit) & 1) << (3 * bit));
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let key = |p: &Vector| {
        (0..3).fold(0, |key, i| {
            key | spread(((p[i] - low[i]) * unit) as u32) << i
        })
    };
    let mut order: Vec<(u32, usize)> = points.iter().map(key).zip(0..).collect();
    order.sort_unstable();
    order.into_iter().map(|(_, index)| index).collect()
}

fn neighbours() -> NonZeroUsize {
    NonZeroUsize::new(NEIGHBOURS).expect("not zero")
}

impl Surface {
    pub(super) fn of(points: &[Vector], normals: Option<&[Vector]>) -> Self {
        let tree = ImmutableKdTree::<f64, 3>::new_from_slice(points);
        // roughness is a median: a sample is enough where normals are given
        let step = match normals {
            Some(_) => (points.len() / 2000).max(1),
            None => 1,
        };
        let tangent = |chunk: &[Vector]| -> Vec<(Vector, f64, f64, f64)> {
            chunk
                .iter()
                .step_by(step)
                .map(|p| tangent_plane(points, &tree, p))
                .collect()
        };
        let planes: Vec<_> = points.par_chunks(CHUNK).flat_map_iter(tangent).collect();
        let of = |f: fn(&(Vector, f64, f64, f64)) -> f64| {
            let mut values: Vec<f64> = planes.iter().map(f).collect();
            let middle = values.len() / 2;
            *values.select_nth_unstable_by(middle, f64::total_cmp).1
        };
        Self {
            roughness_m: of(|p| p.1),
            spacing_m: of(|p| p.2),
            tilt: of(|p| p.3),
            normals: match normals {
                Some(given) => given.to_vec(),
                None => planes.iter().map(|p| p.0).collect(),
            },
            points: points.to_vec(),
            tree,
        }
    }

    /// About so many of its points with their normals.
    pub(super) fn thinned(&self, count: usize) -> Option<Self> {
        if self.points.len() <= 2 * count {
            return None;
        }
        let step = self.points.len() / count;
        let pick = |all: &[Vector]| all.iter().step_by(step).copied().collect::<Vec<_>>();
        let points = pick(&self.points);
        Some(Self {
            tree: ImmutableKdTree::<f64, 3>::new_from_slice(&points),
            points,
            normals: pick(&self.normals),
            ..*self
        })
    }
}

/// Normal, deviation from the plane, distance to the fourth neighbour, squared tilt of the normal.
fn tangent_plane(
    points: &[Vector],
    tree: &ImmutableKdTree<f64, 3>,
    at: &Vector,
) -> (Vector, f64, f64, f64) {
    let near = tree.nearest_n::<SquaredEuclidean>(at, neighbours());
    let mut sum = [0.0; 3];
    let mut m = [0.0; 6];
    for hit in &near {
        #[allow(clippy::cast_possible_truncation)]
        let d = sub(points[hit.item as usize], *at);
        sum = add(sum, d);
        m[0] += d[0] * d[0];
        m[1] += d[0] * d[1];
        m[2] += d[0] * d[2];
        m[3] += d[1] * d[1];
        m[4] += d[1] * d[2];
        m[5] += d[2] * d[2];
    }
    let n = near.len() as f64;
    let c = scale(1.0 / n, sum);
    let a = [
        m[0] - n * c[0] * c[0],
        m[1] - n * c[0] * c[1],
        m[2] - n * c[0] * c[2],
        m[3] - n * c[1] * c[1],
        m[4] - n * c[1] * c[2],
        m[5] - n * c[2] * c[2],
    ];
    let (values, normal) = least_axis(a);
    let deviation = (values[0].max(0.0) / (n - 3.0)).sqrt();
    let fourth = near.get(4).map_or(0.0, |hit| hit.distance.sqrt());
    let tilt = values[0].max(0.0) / values[1].max(f64::MIN_POSITIVE) / (n - 3.0);
    (normal, deviation, fourth, tilt)
}

/// Eigenvalues, least first, of the symmetric matrix `[xx, xy, xz, yy, yz, zz]`, and the direction
/// of the least.
///
/// # Source
/// O. K. Smith, "Eigenvalues of a symmetric 3×3 matrix" (1961).
fn least_axis(a: [f64; 6]) -> ([f64; 3], Vector) {
    let [xx, xy, xz, yy, yz, zz] = a;
    let q = (xx + yy + zz) / 3.0;
    let (bx, by, bz) = (xx - q, yy - q, zz - q);
    let p2 = bx * bx + by * by + bz * bz + 2.0 * (xy * xy + xz * xz + yz * yz);
    let p = (p2 / 6.0).sqrt();
    if p <= 0.0 {
        return ([q; 3], [0.0, 0.0, 1.0]);
    }
    let det = bx * (by * bz - yz * yz) - xy * (xy * bz - yz * xz) + xz * (xy * yz - by * xz);
    let phi = (det / (2.0 * p * p * p)).clamp(-1.0, 1.0).acos() / 3.0;
    let largest = q + 2.0 * p * phi.cos();
    let least = q + 2.0 * p * (phi + std::f64::consts::TAU / 3.0).cos();
    let middle = 3.0 * q - largest - least;
    let rows = [
        [xx - least, xy, xz],
        [xy, yy - least, yz],
        [xz, yz, zz - least],
    ];
    let products = [
        cross(rows[0], rows[1]),
        cross(rows[0], rows[2]),
        cross(rows[1], rows[2]),
    ];
    let best = products
        .into_iter()
        .max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b)))
        .expect("three");
    let length = norm(best);
    let axis = if length > 0.0 {
        scale(1.0 / length, best)
    } else {
        [0.0, 0.0, 1.0]
    };
    ([least, middle, largest], axis)
}

/// Neighbouring points of a cloud: those nearest to some of its own.
pub(super) fn sample_block(points: &[Vector]) -> Vec<Vector> {
    const BLOCKS: usize = 40;
    const SIZE: usize = 60;
    if points.len() <= BLOCKS * SIZE {
        return points.to_vec();
    }
    let mut chosen = std::collections::BTreeSet::new();
    for k in 0..BLOCKS {
        let at = points[k * points.len() / BLOCKS];
        let gap = |p: &Vector| dot(sub(*p, at), sub(*p, at));
        let mut near: Vec<(f64, usize)> = points.iter().map(gap).zip(0..).collect();
        near.select_nth_unstable_by(SIZE - 1, |a, b| a.0.total_cmp(&b.0));
        chosen.extend(near[..SIZE].iter().map(|(_, index)| *index));
    }
    chosen.iter().map(|i| points[*i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;

    #[test]
    fn the_least_axis_is_that_of_a_symmetric_eigen_decomposition() {
        let mut draw = crate::register::Draw::new(5);
        for _ in 0..500 {
            #[allow(clippy::cast_precision_loss)]
            let mut number = || draw.below(2000) as f64 / 1000.0 - 1.0;
            let v: [[f64; 3]; 4] = [(); 4].map(|()| [number(), number(), 0.05 * number()]);
            let m = v.iter().fold(Matrix3::zeros(), |m: Matrix3<f64>, v| {
                let v = nalgebra::Vector3::from(*v);
                m + v * v.transpose()
            });
            let (values, axis) = least_axis([
                m[(0, 0)],
                m[(0, 1)],
                m[(0, 2)],
                m[(1, 1)],
                m[(1, 2)],
                m[(2, 2)],
            ]);
            let peer = m.symmetric_eigen();
            assert!((values[0] - peer.eigenvalues.min()).abs() < 1e-9);
            let along = m * nalgebra::Vector3::from(axis);
            assert!((along - values[0] * nalgebra::Vector3::from(axis)).norm() < 1e-7);
        }
    }
}
