//! Pairs of nearest points, and the step that they ask for.

use super::surface::Surface;
use super::{CHUNK, Metric, Options, from_extent};
use crate::geometry::{Pose, Rotation, Vector, add, cross, dot, scale, sub};
use crate::register::RegisterError;
use crate::register::kabsch::kabsch;
use kiddo::SquaredEuclidean;
use nalgebra::{Matrix6, Vector6};
use rayon::prelude::*;

/// A point of FROM carried over, its partner, and the squared distance in the metric.
pub(super) struct Pairing {
    pub(super) at: Vector,
    pub(super) partner: usize,
    pub(super) squared: f64,
}

pub(super) fn pairings(
    points: &[Vector],
    surface: &Surface,
    pose: &Pose,
    metric: Metric,
) -> Vec<Pairing> {
    let pair = |p: &Vector| {
        let at = pose.transform(*p);
        let hit = surface.tree.nearest_one::<SquaredEuclidean>(&at);
        #[allow(clippy::cast_possible_truncation)]
        let partner = hit.item as usize;
        let squared = match metric {
            Metric::PointToPoint => hit.distance,
            Metric::PointToPlane => {
                let along = dot(surface.normals[partner], sub(at, surface.points[partner]));
                along * along
            }
        };
        Pairing {
            at,
            partner,
            squared,
        }
    };
    points
        .par_chunks(CHUNK)
        .flat_map_iter(|chunk| chunk.iter().map(pair))
        .collect()
}

/// Pairs by distance of the points, whatever the metric: what is left out has no partner.
pub(super) fn trimmed(mut pairs: Vec<Pairing>, surface: &Surface, kept: f64) -> Vec<Pairing> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let count = ((pairs.len() as f64 * kept).round() as usize).clamp(6, pairs.len());
    if count == pairs.len() {
        return pairs;
    }
    let distance = |pair: &Pairing| {
        let d = sub(pair.at, surface.points[pair.partner]);
        dot(d, d)
    };
    let mut distances: Vec<f64> = pairs.iter().map(distance).collect();
    let limit = *distances
        .select_nth_unstable_by(count - 1, f64::total_cmp)
        .1;
    pairs.retain(|pair| distance(pair) <= limit);
    pairs
}

pub(super) fn rms(pairs: &[Pairing]) -> f64 {
    (pairs.iter().map(|p| p.squared).sum::<f64>() / pairs.len() as f64).sqrt()
}

/// One step: the better pose and the residual before it; none where the kept pairs fix no motion.
pub(super) fn step(
    points: &[Vector],
    surface: &Surface,
    pose: &Pose,
    options: &Options,
) -> Option<(Pose, f64)> {
    let pairs = trimmed(
        pairings(points, surface, pose, options.metric),
        surface,
        options.kept,
    );
    let before = rms(&pairs);
    let better = match options.metric {
        Metric::PointToPoint => {
            let from: Vec<_> = pairs.iter().map(|p| p.at).collect();
            let to: Vec<_> = pairs.iter().map(|p| surface.points[p.partner]).collect();
            kabsch_any_size(&from, &to)? * *pose
        }
        Metric::PointToPlane => plane_step(&pairs, surface)? * *pose,
    };
    Some((better, before))
}

/// Kabsch where many of FROM meet few of TO in the first steps: a ratio of extents says nothing
/// yet.
fn kabsch_any_size(from: &[Vector], to: &[Vector]) -> Option<Pose> {
    match kabsch(from, to, None) {
        Ok(fit) => Some(fit.to_from_from),
        Err(RegisterError::Units { .. }) => {
            let shift = sub(from_extent(to).0, from_extent(from).0);
            Some(Pose::from_translation(shift[0], shift[1], shift[2]))
        }
        Err(_) => None,
    }
}

/// Derivatives of a pair's distance from the tangent plane by a turn (times `size`) about `centre`
/// and a shift, and that distance.
pub(super) fn line(
    pair: &Pairing,
    surface: &Surface,
    centre: Vector,
    size: f64,
) -> (Vector6<f64>, f64) {
    let normal = surface.normals[pair.partner];
    let turn = scale(1.0 / size, cross(sub(pair.at, centre), normal));
    let row = Vector6::new(turn[0], turn[1], turn[2], normal[0], normal[1], normal[2]);
    let left = dot(normal, sub(pair.at, surface.points[pair.partner]));
    (row, left)
}

/// Normal equations of a small motion about the middle of the pairs, turns scaled to the size of
/// the cloud.
pub(super) fn information(
    pairs: &[Pairing],
    surface: &Surface,
) -> (Matrix6<f64>, Vector6<f64>, Vector, f64) {
    let sum = pairs.iter().fold([0.0; 3], |sum, p| add(sum, p.at));
    let centre = scale(1.0 / pairs.len() as f64, sum);
    let square = pairs
        .iter()
        .map(|p| dot(sub(p.at, centre), sub(p.at, centre)))
        .sum::<f64>();
    let size = (square / pairs.len() as f64).sqrt().max(f64::MIN_POSITIVE);
    let add_up = |chunk: &[Pairing]| {
        let (mut n, mut r) = (Matrix6::zeros(), Vector6::zeros());
        for pair in chunk {
            let (row, left) = line(pair, surface, centre, size);
            for i in 0..6 {
                for j in 0..=i {
                    n[(i, j)] += row[i] * row[j];
                }
                r[i] -= row[i] * left;
            }
        }
        (n, r)
    };
    let parts: Vec<_> = pairs.par_chunks(CHUNK).map(add_up).collect();
    let (mut n, mut r) = (Matrix6::zeros(), Vector6::zeros());
    for part in &parts {
        n += part.0;
        r += part.1;
    }
    n.fill_upper_triangle_with_lower_triangle();
    (n, r, centre, size)
}

fn plane_step(pairs: &[Pairing], surface: &Surface) -> Option<Pose> {
    let (mut n, r, centre, size) = information(pairs, surface);
    // motions that the surface leaves free stay still
    let damping = 1e-9 * n.trace() / 6.0;
    for i in 0..6 {
        n[(i, i)] += damping;
    }
    let x = n.cholesky()?.solve(&r);
    let turn = Rotation::from_vector([x[0] / size, x[1] / size, x[2] / size]);
    let shift = [x[3], x[4], x[5]];
    Some(Pose {
        rotation: turn,
        translation: sub(add(centre, shift), turn * centre),
    })
}
