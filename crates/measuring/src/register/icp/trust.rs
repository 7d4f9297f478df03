//! What a result is worth: the tests that tell success from a local minimum, and its uncertainty.

use super::pairs::{Pairing, information, line, pairings, rms, step, trimmed};
use super::surface::{Surface, sample_block};
use super::{Concern, Found, MIDDLE, Metric, Options, motion, sample};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Vector, norm, scale, sub};
use crate::register::linear;
use crate::register::uncertainty::PoseCovariance;
use nalgebra::{DMatrix, Matrix6, Vector6};

/// Least number of groups of neighbouring points whose scatter widens the uncertainty.
const GROUPS: usize = 50;
/// Points of such a group at least: more than share a tangent plane.
const GROUP: usize = 16;
/// Clouds up to this size are matched the other way round, too.
const MIRRORED: usize = 20_000;
/// The residual may be this many times what the roughness of the surfaces explains.
const RESIDUAL: f64 = 3.0;
/// Share of the points' spacing by which point-to-point may be off.
const DRAWN: f64 = 0.03;
/// Another start within this factor of the best residual is as good.
const ALIKE: f64 = 1.3;

/// The tests that tell success from a local minimum.
pub(super) fn judge(
    from: &[Vector],
    surface: &Surface,
    pose: Pose,
    options: &Options,
    extent: (Vector, f64),
) -> Found {
    let all = pairings(from, surface, &pose, Metric::PointToPlane);
    // the roughness of FROM itself, from a sample
    let own = Surface::of(&sample_block(from), None).roughness_m;
    let expected_m = options
        .sigma_m
        .unwrap_or_else(|| own.hypot(surface.roughness_m))
        .max(1e-9 * extent.1);
    let lateral = 3.0 * surface.spacing_m.max(expected_m);
    let on_it = all.iter().filter(|pair| {
        let apart = norm(sub(pair.at, surface.points[pair.partner]));
        pair.squared < (4.0 * expected_m).powi(2) && apart < lateral + 4.0 * expected_m
    });
    let overlap = on_it.count() as f64 / from.len() as f64;
    let kept = trimmed(all, surface, options.kept);
    let plane_rms = rms(&kept);
    let mut concerns = Vec::new();
    // partners that are no nearer than the points are apart draw points along the surface, too
    let drawn_m = match options.metric {
        Metric::PointToPlane => 0.0,
        Metric::PointToPoint => DRAWN * surface.spacing_m,
    };
    if plane_rms > RESIDUAL * expected_m.hypot(drawn_m) {
        concerns.push(Concern::Residual {
            rms_mm: mm_from_m(plane_rms),
            expected_mm: mm_from_m(expected_m),
            limit: RESIDUAL,
        });
    }
    if overlap < options.min_overlap {
        concerns.push(Concern::Overlap {
            found: overlap,
            limit: options.min_overlap,
        });
    }
    let (n, _, centre, size) = information(&kept, surface);
    let svd = linear::svd(&DMatrix::from_fn(6, 6, |i, j| n[(i, j)]));
    let ratio = svd.values[5] / svd.values[0];
    let limit = 1e-6 + 3.0 * surface.tilt;
    let mut covariance = None;
    if ratio < limit {
        let open = svd.right.column(5);
        let (turn, shift) = ([open[0], open[1], open[2]], [open[3], open[4], open[5]]);
        let (what, v) = if norm(turn) > norm(shift) {
            ("rotating about", scale(1.0 / norm(turn), turn))
        } else {
            ("sliding along", scale(1.0 / norm(shift), shift))
        };
        concerns.push(Concern::Free {
            motion: format!("{what} ({:.2}, {:.2}, {:.2})", v[0], v[1], v[2]),
            ratio,
            limit,
        });
    } else if let Some(inverse) = n.try_inverse() {
        let unit = |i: usize| if i < 3 { 1.0 / size } else { 1.0 };
        let noise = plane_rms.max(expected_m);
        let more = scattered(&kept, surface, centre, size, &inverse, noise)
            .max(mirrored(from, surface, &pose, options, &n, noise));
        let matrix =
            Matrix6::from_fn(|i, j| inverse[(i, j)] * unit(i) * unit(j) * more * noise.powi(2));
        covariance = Some(PoseCovariance::new(centre, &matrix));
    }
    let rms_m = match options.metric {
        Metric::PointToPlane => plane_rms,
        Metric::PointToPoint => {
            let pairs = pairings(from, surface, &pose, Metric::PointToPoint);
            rms(&trimmed(pairs, surface, options.kept))
        }
    };
    Found {
        to_from_from: pose,
        steps: Vec::new(),
        starts: 0,
        rms_m,
        expected_m,
        overlap,
        covariance,
        concerns,
        left: Vec::new(),
    }
}

/// How many times the variance of independent noise the residuals of neighbouring points make, 1 or
/// more.
///
/// Neighbours share tangent planes, and these are off where the surface is curved or has steps. The
/// sum of `Jᵀr` over groups of neighbours scatters as they do.
///
/// # Source
/// K.-Y. Liang, S. L. Zeger (1986): the covariance of clustered observations.
fn scattered(
    pairs: &[Pairing],
    surface: &Surface,
    centre: Vector,
    size: f64,
    inverse: &Matrix6<f64>,
    noise: f64,
) -> f64 {
    let group = (pairs.len() / (10 * GROUPS)).clamp(GROUP, 4 * GROUP);
    let groups = pairs.len() / group;
    if groups < GROUPS / 2 {
        return 1.0;
    }
    let sums = pairs.chunks(group).map(|chunk| {
        let mut sum = Vector6::zeros();
        for pair in chunk {
            let (row, left) = line(pair, surface, centre, size);
            sum += row * left;
        }
        sum
    });
    let scatter = sums.fold(Matrix6::zeros(), |all, sum| all + sum * sum.transpose());
    let ratio = (inverse * scatter).trace() / 6.0 / (noise * noise);
    (ratio * groups as f64 / (groups as f64 - 1.0)).max(1.0)
}

/// The same from a match the other way round, whose tangent planes are those of FROM: both are off
/// by what planes make of the surface, not in the same way. Only of clouds that are coarse enough
/// for it to matter.
fn mirrored(
    from: &[Vector],
    surface: &Surface,
    pose: &Pose,
    options: &Options,
    information_there: &Matrix6<f64>,
    noise: f64,
) -> f64 {
    if from.len().max(surface.points.len()) > MIRRORED {
        return 1.0;
    }
    let moved: Vec<Vector> = from.iter().map(|p| pose.transform(*p)).collect();
    let other = Surface::of(&moved, None);
    let pairs = pairings(
        &surface.points,
        &other,
        &Pose::identity(),
        Metric::PointToPlane,
    );
    let (n, r, ..) = information(&trimmed(pairs, &other, options.kept), &other);
    let Some(factor) = n.cholesky() else {
        return 1.0;
    };
    let step = factor.solve(&r);
    let squared = (step.transpose() * information_there * step)[0] / (noise * noise);
    // two independent estimates differ by twice the variance of one
    (squared / 12.0).max(1.0)
}

/// Refines the other end a little and compares.
pub(super) fn check_alternative(
    from: &[Vector],
    surface: &Surface,
    mut other: Pose,
    options: &Options,
    extent: &(Vector, f64),
    found: &mut Found,
) {
    let middle = sample(from, MIDDLE);
    for _ in 0..40 {
        match step(&middle, surface, &other, options) {
            Some((better, _)) => {
                let moved = motion(&other, &better, extent);
                other = better;
                if moved < 1e-6 * extent.1 {
                    break;
                }
            }
            None => return,
        }
    }
    let left = |pose: &Pose| {
        let pairs = pairings(&middle, surface, pose, Metric::PointToPlane);
        rms(&trimmed(pairs, surface, options.kept))
    };
    let (mine, others) = (left(&found.to_from_from), left(&other));
    let gap = other.separation(&found.to_from_from);
    let apart = motion(&other, &found.to_from_from, extent) > 0.05 * extent.1;
    if apart && others < ALIKE * mine.max(found.expected_m) {
        found.concerns.push(Concern::Ambiguous {
            rms_mm: mm_from_m(mine),
            other_mm: mm_from_m(others),
            turn_deg: gap.angle_rad.to_degrees(),
        });
    }
}
