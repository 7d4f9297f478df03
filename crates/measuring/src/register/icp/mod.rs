//! Registration of point clouds without known correspondence: iterative closest point.
//!
//! Nearest neighbours come from a k-d tree on TO. Coarse starts (the given one, or turns of the
//! main axes) run on a thin sample; the best goes on with more points and ends with all. Pairs
//! beyond the trimmed share are left out in every step. A result is called success only if its
//! residual is that of the surfaces' own roughness, enough of FROM lies on TO, no motion is left
//! free, and no other start ends as well elsewhere.
//!
//! # Source
//! P. Besl, N. `McKay` (1992); Y. Chen, G. Medioni (1992) for the tangent planes; D. Chetverikov et
//! al. (2002) for trimming.

mod pairs;
mod search;
mod surface;
mod trust;

use super::RegisterError;
use super::uncertainty::PoseCovariance;
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Vector, add, dot, norm, scale, sub};
use pairs::{Pairing, pairings, step};
use search::coarse_search;
use surface::{Surface, along_curve};
use trust::{check_alternative, judge};

/// Fewest points of a cloud.
const FEWEST: usize = 50;
/// Points of FROM in the coarse and middle stage.
const COARSE: usize = 400;
/// Points of FROM in the middle stage.
const MIDDLE: usize = 4000;
/// Steps of a stage before it is called not converged.
const STEPS: usize = 300;
/// Steps after which small steps back and forth are taken for standing still.
const PATIENT: usize = 25;
/// Points of which the residual is reported.
const MOST_LEFT: usize = 2000;
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
    /// Standard deviation of a point off its surface, both sets together, metres; none: from the
    /// roughness.
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
pub enum Concern {
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
        "a local minimum, or not the same surface: the residual is {rms_mm:.4} mm and the noise of \
         the points explains {expected_mm:.4} mm (limit {limit} times)"
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
        "the surface leaves a motion free: {motion} (information {ratio:.1e} of the strongest, \
         limit {limit:.1e})"
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
        "another pose fits as well ({other_mm:.4} mm against {rms_mm:.4} mm), turned by \
         {turn_deg:.1} deg: the part is symmetric, or the points do not show what breaks its \
         symmetry"
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
    pub concerns: Vec<Concern>,
    /// What is left at some points of FROM, evenly spread.
    pub left: Vec<PointResidual>,
}

/// What is left at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointResidual {
    /// Its index in FROM.
    pub index: usize,
    /// Where it lies in TO, metres.
    pub at_m: Vector,
    /// From there to the nearest point of TO or, with [`Metric::PointToPlane`], to the plane
    /// there, metres.
    pub residual_m: Vector,
    /// Whether it is among the nearest that are kept.
    pub kept: bool,
}

/// Finds the motion that lays FROM on TO.
///
/// `normals` are unit normals of TO, if they are known. Points in metres, any number from 50 on
/// each side.
///
/// # Errors
/// If a set is too small, not finite, coincident, or of other units than the other. A result that
/// is found but uncertain is returned with its concerns.
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
    let order_of_from = along_curve(from);
    let from = &sorted(from, &order_of_from)[..];
    let order = along_curve(to);
    let normals = normals.map(|normals| sorted(normals, &order));
    let surface = Surface::of(&sorted(to, &order), normals.as_deref());
    let extent = from_extent(from);
    let coarse = sample(from, COARSE);
    let (start, starts, alternative) = match options.start {
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
            // where clouds are noisy partners change places for ever: well below what the noise
            // does to the pose is enough, and so is just below it where it goes on for
            // long
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
    found.left = left(from, &order_of_from, &surface, &pose, options);
    if !settled {
        found.concerns.push(Concern::Moving {
            steps: steps.len(),
            moved_mm: steps.last().map_or(f64::MAX, |s| mm_from_m(s.moved_m)),
        });
    }
    found.steps = steps;
    if let Some(other) = alternative {
        check_alternative(from, &surface, other, options, &extent, &mut found);
    }
    Ok(found)
}

/// What is left at every so many points.
fn left(
    from: &[Vector],
    order: &[usize],
    surface: &Surface,
    pose: &Pose,
    options: &Options,
) -> Vec<PointResidual> {
    let step = from.len().div_ceil(MOST_LEFT).max(1);
    let some: Vec<Vector> = from.iter().step_by(step).copied().collect();
    let pairs = pairings(&some, surface, pose, options.metric);
    let gap = |pair: &Pairing| sub(surface.points[pair.partner], pair.at);
    let mut distances: Vec<f64> = pairs.iter().map(|pair| norm(gap(pair))).collect();
    distances.sort_by(f64::total_cmp);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let last = (distances.len() as f64 * options.kept).round() as usize;
    let limit = distances[last.clamp(1, distances.len()) - 1];
    let one = |(pair, index): (&Pairing, &usize)| PointResidual {
        index: *index,
        at_m: pair.at,
        residual_m: match options.metric {
            Metric::PointToPoint => gap(pair),
            Metric::PointToPlane => {
                let normal = surface.normals[pair.partner];
                scale(dot(normal, gap(pair)), normal)
            }
        },
        kept: norm(gap(pair)) <= limit,
    };
    pairs
        .iter()
        .zip(order.iter().step_by(step))
        .map(one)
        .collect()
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
