//! Registration of point clouds without known correspondence: iterative closest point.
//!
//! Nearest neighbours come from a k-d tree on TO. Coarse starts (the given one, or turns of the main axes) run on a thin
//! sample; the best goes on with more points and ends with all. Pairs beyond the trimmed share are left out in every step.
//! A result is called success only if its residual is that of the surfaces' own roughness, enough of FROM lies on TO, no
//! motion is left free, and no other start ends as well elsewhere.
//!
//! # Source
//! P. Besl, N. `McKay` (1992); Y. Chen, G. Medioni (1992) for the tangent planes; D. Chetverikov et al. (2002) for trimming.

use super::kabsch::{kabsch, scatter};
use super::uncertainty::PoseCovariance;
use super::{RegisterError, linear};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Rotation, Vector, add, cross, dot, norm, scale, sub};
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use nalgebra::{DMatrix, Matrix6, Vector6};
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// Neighbours that give a tangent plane.
const NEIGHBOURS: usize = 10;
/// Fewest points of a cloud.
const FEWEST: usize = 50;
/// Points of FROM in the coarse and middle stage.
const COARSE: usize = 400;
/// Points of FROM in the middle stage.
const MIDDLE: usize = 4000;
/// Points of TO in the coarse stage: far from a surface a search in a large tree is slow.
const THIN: usize = 3000;
/// Steps of a coarse run from every start.
const COARSE_STEPS: usize = 12;
/// Ends of coarse runs that go on.
const FINALISTS: usize = 4;
/// Steps of those.
const MORE_STEPS: usize = 15;
/// Least number of groups of neighbouring points whose scatter widens the uncertainty.
const GROUPS: usize = 50;
/// Points of such a group at least: more than share a tangent plane.
const GROUP: usize = 16;
/// Clouds up to this size are matched the other way round, too.
const MIRRORED: usize = 20_000;
/// Steps of a stage before it is called not converged.
const STEPS: usize = 300;
/// Steps after which small steps back and forth are taken for standing still.
const PATIENT: usize = 25;
/// The residual may be this many times what the roughness of the surfaces explains.
const RESIDUAL: f64 = 3.0;
/// Share of the points' spacing by which point-to-point may be off.
const DRAWN: f64 = 0.03;
/// Another start within this factor of the best residual is as good.
const ALIKE: f64 = 1.3;
/// Points handed to a thread at a time.
const CHUNK: usize = 4096;

/// What is made small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// Distance of a point from its nearest point.
    PointToPoint,
    /// Distance of a point from the tangent plane at its nearest point.
    PointToPlane,
}

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// What is made small.
    pub metric: Metric,
    /// Where to start: `to_from_from`; none for a search over turns.
    pub start: Option<Pose>,
    /// Share of the nearest pairs that is kept, in (0, 1].
    pub kept: f64,
    /// Share of FROM that must lie on TO.
    pub min_overlap: f64,
    /// Standard deviation of a point off its surface, both sets together, metres; none: from the roughness.
    pub sigma_m: Option<f64>,
}

/// One step of the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Points of FROM in it.
    pub points: usize,
    /// Root mean square residual of the kept pairs before it, metres.
    pub rms_m: f64,
    /// How far the outermost point moved, metres.
    pub moved_m: f64,
}

/// Why a result is not called success.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Doubt {
    /// Still moving.
    #[error("not converged: after {steps} steps points still move by {moved_mm:.2e} mm")]
    Moving {
        /// Steps done.
        steps: usize,
        /// The last step, mm.
        moved_mm: f64,
    },
    /// A residual that the noise does not explain.
    #[error(
        "a local minimum, or not the same surface: the residual is {rms_mm:.4} mm and the noise of the points explains {expected_mm:.4} mm (limit {limit} times)"
    )]
    Residual {
        /// Of the kept pairs, mm.
        rms_mm: f64,
        /// Roughness of both, mm.
        expected_mm: f64,
        /// How many times it may be.
        limit: f64,
    },
    /// Too little of FROM lies on TO.
    #[error("only {found:.3} of FROM lies on TO (limit {limit})")]
    Overlap {
        /// Share.
        found: f64,
        /// The least that is accepted.
        limit: f64,
    },
    /// A surface that slides on itself.
    #[error(
        "the surface leaves a motion free: {motion} (information {ratio:.1e} of the strongest, limit {limit:.1e})"
    )]
    Free {
        /// Which.
        motion: String,
        /// Ratio of eigenvalues.
        ratio: f64,
        /// The least that is accepted.
        limit: f64,
    },
    /// Another pose as good.
    #[error(
        "another pose fits as well ({other_mm:.4} mm against {rms_mm:.4} mm), turned by {turn_deg:.1} deg: the part is symmetric, or the points do not show what breaks its symmetry"
    )]
    Ambiguous {
        /// Residual of this one, mm.
        rms_mm: f64,
        /// Residual of the other, mm.
        other_mm: f64,
        /// Angle between the two, degrees.
        turn_deg: f64,
    },
}

/// What the search found.
#[derive(Clone, Debug)]
pub struct Found {
    /// Maps coordinates of FROM into TO.
    pub to_from_from: Pose,
    /// Every step of the last stages.
    pub steps: Vec<Step>,
    /// Starts that were tried.
    pub starts: usize,
    /// Root mean square residual of the kept pairs in the metric, metres.
    pub rms_m: f64,
    /// What the roughness of both surfaces explains, metres.
    pub expected_m: f64,
    /// Share of FROM that lies on TO.
    pub overlap: f64,
    /// Covariance for independent noise of the points.
    pub covariance: Option<PoseCovariance>,
    /// Why it is no success; empty if it is.
    pub doubts: Vec<Doubt>,
}

/// A cloud with a tree, normals, and how rough it is.
struct Surface {
    points: Vec<Vector>,
    tree: ImmutableKdTree<f64, 3>,
    normals: Vec<Vector>,
    /// Median deviation from the tangent planes, metres.
    roughness_m: f64,
    /// Median distance to the fourth neighbour, metres.
    spacing_m: f64,
    /// Median of what noise and curvature make of a normal, squared angle.
    tilt: f64,
}

/// Positions in the order of a space-filling curve (Z order): neighbours in space are neighbours in memory.
fn along_curve(points: &[Vector]) -> Vec<usize> {
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
    fn of(points: &[Vector], normals: Option<&[Vector]>) -> Self {
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
}

impl Surface {
    /// About so many of its points with their normals.
    fn thinned(&self, count: usize) -> Option<Self> {
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

/// Eigenvalues, least first, of the symmetric matrix `[xx, xy, xz, yy, yz, zz]`, and the direction of the least.
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

/// Finds the motion that lays FROM on TO.
///
/// `normals` are unit normals of TO, if they are known. Points in metres, any number from 50 on each side.
///
/// # Errors
/// If a set is too small, not finite, coincident, or of other units than the other. A result that is found but doubtful
/// is returned with its doubts.
pub fn icp(
    from: &[Vector],
    to: &[Vector],
    normals: Option<&[Vector]>,
    options: &Options,
) -> Result<Found, RegisterError> {
    check(from, to)?;
    let sorted = |points: &[Vector], order: &[usize]| -> Vec<Vector> {
        order.iter().map(|i| points[*i]).collect()
    };
    let from = &sorted(from, &along_curve(from))[..];
    let order = along_curve(to);
    let normals = normals.map(|normals| sorted(normals, &order));
    let surface = Surface::of(&sorted(to, &order), normals.as_deref());
    let extent = from_extent(from);
    let coarse = sample(from, COARSE);
    let (start, starts, rival) = match options.start {
        Some(start) => (start, 1, None),
        None => coarse_search(from, &coarse, &surface, options, extent.1),
    };
    let mut pose = start;
    let mut steps = Vec::new();
    let mut settled = false;
    let stages = [coarse, sample(from, MIDDLE), from.to_vec()];
    for (index, points) in stages.iter().enumerate() {
        if index > 0 && points.len() == stages[index - 1].len() {
            continue;
        }
        let is_last = index + 1 == stages.len() || points.len() == from.len();
        settled = false;
        for round in 0..STEPS {
            let Some((better, rms_m)) = step(points, &surface, &pose, options) else {
                break;
            };
            let moved_m = motion(&pose, &better, &extent);
            steps.push(Step {
                points: points.len(),
                rms_m,
                moved_m,
            });
            pose = better;
            // where clouds are noisy partners change places for ever: well below what the noise does to the pose is enough,
            // and so is just below it where it goes on for long
            let noise = rms_m / (points.len() as f64).sqrt();
            let share = if round < PATIENT { 0.2 } else { 4.0 };
            let fine = extent.1 * if is_last { 1e-7 } else { 1e-5 };
            let tolerance = match options.metric {
                Metric::PointToPlane => fine.max(share * noise),
                // creeps along the surface: a small step says little about what is left
                Metric::PointToPoint => extent.1 * 1e-5,
            };
            if moved_m < tolerance {
                settled = true;
                break;
            }
        }
    }
    let mut found = judge(from, &surface, pose, options, extent);
    found.starts = starts;
    if !settled {
        found.doubts.push(Doubt::Moving {
            steps: steps.len(),
            moved_mm: steps.last().map_or(f64::MAX, |s| mm_from_m(s.moved_m)),
        });
    }
    found.steps = steps;
    if let Some(other) = rival {
        doubt_rival(from, &surface, other, options, &extent, &mut found);
    }
    Ok(found)
}

fn check(from: &[Vector], to: &[Vector]) -> Result<(), RegisterError> {
    let fewest = from.len().min(to.len());
    if fewest < FEWEST {
        return Err(RegisterError::SmallCloud {
            found: fewest,
            needed: FEWEST,
        });
    }
    if from.iter().chain(to).flatten().any(|c| !c.is_finite()) {
        return Err(RegisterError::NotFinite);
    }
    let (f, t) = (from_extent(from).1, from_extent(to).1);
    for (set, extent) in [("FROM", f), ("TO", t)] {
        if extent < 1e-6 {
            return Err(RegisterError::Coincident {
                set,
                spread_mm: mm_from_m(extent),
                limit_mm: 1e-3,
            });
        }
    }
    // one may be a part of the other, but not another unit
    if !(0.05..20.0).contains(&(t / f)) {
        return Err(RegisterError::Units { ratio: t / f });
    }
    Ok(())
}

/// Centre and largest distance from it.
fn from_extent(points: &[Vector]) -> (Vector, f64) {
    let sum = points.iter().fold([0.0; 3], |sum, p| add(sum, *p));
    let centre = scale(1.0 / points.len() as f64, sum);
    let far = points
        .iter()
        .map(|p| norm(sub(*p, centre)))
        .fold(0.0, f64::max);
    (centre, far)
}

/// About so many points, evenly through the list.
fn sample(points: &[Vector], count: usize) -> Vec<Vector> {
    if points.len() <= 2 * count {
        return points.to_vec();
    }
    // an odd stride that shares no period with the rows of a scan
    let mut draw = super::Draw::new(0x51);
    let stride = points.len() / count;
    (0..count)
        .map(|i| points[i * stride + draw.below(stride)])
        .collect()
}

/// How far the outermost point moves between two poses.
fn motion(a: &Pose, b: &Pose, extent: &(Vector, f64)) -> f64 {
    let turn = (a.rotation.transpose() * b.rotation).angle();
    norm(sub(a.transform(extent.0), b.transform(extent.0))) + turn * extent.1
}

/// A point of FROM carried over, its partner, and the squared distance in the metric.
struct Pairing {
    at: Vector,
    partner: usize,
    squared: f64,
}

fn pairings(points: &[Vector], surface: &Surface, pose: &Pose, metric: Metric) -> Vec<Pairing> {
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
fn trimmed(mut pairs: Vec<Pairing>, surface: &Surface, kept: f64) -> Vec<Pairing> {
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

fn rms(pairs: &[Pairing]) -> f64 {
    (pairs.iter().map(|p| p.squared).sum::<f64>() / pairs.len() as f64).sqrt()
}

/// One step: the better pose and the residual before it; none where the kept pairs fix no motion.
fn step(
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

/// Kabsch where many of FROM meet few of TO in the first steps: a ratio of extents says nothing yet.
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

/// Derivatives of a pair's distance from the tangent plane by a turn (times `size`) about `centre` and a shift, and that
/// distance.
fn line(pair: &Pairing, surface: &Surface, centre: Vector, size: f64) -> (Vector6<f64>, f64) {
    let normal = surface.normals[pair.partner];
    let turn = scale(1.0 / size, cross(sub(pair.at, centre), normal));
    let row = Vector6::new(turn[0], turn[1], turn[2], normal[0], normal[1], normal[2]);
    let left = dot(normal, sub(pair.at, surface.points[pair.partner]));
    (row, left)
}

/// Normal equations of a small motion about the middle of the pairs, turns scaled to the size of the cloud.
fn information(pairs: &[Pairing], surface: &Surface) -> (Matrix6<f64>, Vector6<f64>, Vector, f64) {
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

/// Runs from turned main axes and from where the files stand; the best, how many there were, and the best of those that end
/// elsewhere.
fn coarse_search(
    from: &[Vector],
    coarse: &[Vector],
    surface: &Surface,
    options: &Options,
    size: f64,
) -> (Pose, usize, Option<Pose>) {
    let mut starts = vec![Pose::identity()];
    let (from_centre, from_axes) = main_axes(from);
    let (to_centre, to_axes) = main_axes(&surface.points);
    for turn in cube_turns() {
        let rotation = to_axes * turn * from_axes.transpose();
        starts.push(Pose {
            rotation,
            translation: sub(to_centre, rotation * from_centre),
        });
    }
    let thin = surface.thinned(THIN);
    let thin = thin.as_ref().unwrap_or(surface);
    let rough = Options {
        metric: Metric::PointToPoint,
        ..*options
    };
    let walk = |surface: &Surface, pose: Pose, options: &Options, steps: usize| {
        let mut pose = pose;
        for _ in 0..steps {
            match step(coarse, surface, &pose, options) {
                Some((better, _)) => pose = better,
                None => break,
            }
        }
        let pairs = pairings(coarse, surface, &pose, Metric::PointToPoint);
        (rms(&trimmed(pairs, surface, options.kept)), pose)
    };
    // first by points, which draws from farther away
    let first = |start: &Pose| walk(thin, *start, &rough, COARSE_STEPS);
    let mut ends: Vec<(f64, Pose)> = starts.par_iter().map(first).collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let apart = |a: &Pose, b: &Pose| {
        let turn = (a.rotation.transpose() * b.rotation).angle();
        let shift = norm(sub(a.transform(from_centre), b.transform(from_centre)));
        turn > 0.1 || shift > 0.1 * size
    };
    let mut last: Vec<Pose> = Vec::new();
    for (_, pose) in &ends {
        if last.len() < FINALISTS && last.iter().all(|other| apart(other, pose)) {
            last.push(*pose);
        }
    }
    let on = |pose: &Pose| walk(surface, *pose, options, MORE_STEPS);
    let mut ends: Vec<(f64, Pose)> = last.par_iter().map(on).collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let best = ends[0].1;
    let rival = ends[1..]
        .iter()
        .find(|end| apart(&best, &end.1))
        .map(|end| end.1);
    (best, starts.len(), rival)
}

fn main_axes(points: &[Vector]) -> (Vector, Rotation) {
    let (centre, scatter) = scatter(points, None);
    let eigen = scatter.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let column = |i: usize| {
        let c = eigen.eigenvectors.column(order[i]);
        [c[0], c[1], c[2]]
    };
    let (x, y) = (column(0), column(1));
    let z = cross(x, y);
    (
        centre,
        Rotation(std::array::from_fn(|i| [x[i], y[i], z[i]])),
    )
}

/// The 24 turns of a cube.
fn cube_turns() -> Vec<Rotation> {
    let mut turns = Vec::new();
    let axes = [0_usize, 1, 2];
    for a in axes {
        for b in axes.into_iter().filter(|b| *b != a) {
            for signs in 0..4 {
                let mut x = [0.0; 3];
                let mut y = [0.0; 3];
                x[a] = if signs & 1 == 0 { 1.0 } else { -1.0 };
                y[b] = if signs & 2 == 0 { 1.0 } else { -1.0 };
                let z = cross(x, y);
                turns.push(Rotation(std::array::from_fn(|i| [x[i], y[i], z[i]])));
            }
        }
    }
    turns
}

/// The tests that tell success from a local minimum.
fn judge(
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
    let mut doubts = Vec::new();
    // partners that are no nearer than the points are apart draw points along the surface, too
    let drawn_m = match options.metric {
        Metric::PointToPlane => 0.0,
        Metric::PointToPoint => DRAWN * surface.spacing_m,
    };
    if plane_rms > RESIDUAL * expected_m.hypot(drawn_m) {
        doubts.push(Doubt::Residual {
            rms_mm: mm_from_m(plane_rms),
            expected_mm: mm_from_m(expected_m),
            limit: RESIDUAL,
        });
    }
    if overlap < options.min_overlap {
        doubts.push(Doubt::Overlap {
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
            ("turning about", scale(1.0 / norm(turn), turn))
        } else {
            ("sliding along", scale(1.0 / norm(shift), shift))
        };
        doubts.push(Doubt::Free {
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
        doubts,
    }
}

/// How many times the variance of independent noise the residuals of neighbouring points make, 1 or more.
///
/// Neighbours share tangent planes, and these are off where the surface is curved or has steps. The sum of `Jᵀr` over groups of
/// neighbours scatters as they do.
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

/// The same from a match the other way round, whose tangent planes are those of FROM: both are off by what planes make of the
/// surface, not in the same way. Only of clouds that are coarse enough for it to matter.
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

/// Neighbouring points of a cloud: those nearest to some of its own.
fn sample_block(points: &[Vector]) -> Vec<Vector> {
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

/// Refines the other end a little and compares.
fn doubt_rival(
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
        found.doubts.push(Doubt::Ambiguous {
            rms_mm: mm_from_m(mine),
            other_mm: mm_from_m(others),
            turn_deg: gap.angle_rad.to_degrees(),
        });
    }
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
