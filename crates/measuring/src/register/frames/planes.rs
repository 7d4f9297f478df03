//! Registration of points and planes together.

use super::contradicted::{Contradicted, contradicted};
use super::{FrameError, NEAR_LINE};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Rotation, Vector, add, cross, dot, norm, scale, sub};
use crate::register::features::{self, Plane};
use crate::register::kabsch::kabsch;
use crate::register::uncertainty::{PoseCovariance, crossing};
use crate::register::{RegisterError, linear};
use nalgebra::{DMatrix, DVector, Matrix6, Vector3};

/// A nominal plane of FROM and where the probe's ball stood when it touched the real one.
#[derive(Clone, Debug, PartialEq)]
pub struct TouchedPlane {
    /// A point of the nominal plane in FROM, metres.
    pub point_m: Vector,
    /// Its outward normal in FROM, unit.
    pub normal: Vector,
    /// Centres of the ball in TO, at least three, metres.
    pub touches_m: Vec<Vector>,
}

/// A motion fitted to points and planes together.
#[derive(Clone, Debug)]
pub struct FeatureFit {
    /// Maps coordinates of FROM into TO.
    pub to_from_from: Pose,
    /// The residual of each point, metres.
    pub points_m: Vec<Vector>,
    /// The residual of each touch of each plane, along its normal, metres.
    pub planes_m: Vec<Vec<f64>>,
    /// Standard deviation of one residual, metres; of the touches where `sigma_m` was given.
    pub sigma_m: f64,
    /// Covariance of the motion.
    pub covariance: PoseCovariance,
    /// How many other poses fit as well but put touches of a plane outside of another: the planes
    /// are taken as faces of a convex corner.
    pub others: usize,
    /// What the other touches contradict; it is in the fit.
    pub misfits: Vec<Misfit>,
}

/// A feature of a fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A point by its index.
    Point(usize),
    /// A touch of a plane, both by their indices.
    Touch(usize, usize),
    /// A plane with all its touches.
    Plane(usize),
}

/// A feature that the others contradict.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    /// Which.
    pub part: Part,
    /// How far it is from where the others put it (of a plane the root mean square), metres.
    pub off_m: f64,
    /// The same in standard deviations of what the others leave.
    pub sigmas: f64,
}

/// Form of a good face and noise of a good probe, metres: poses that differ by less fit
/// alike.
const FORM_M: f64 = 1e-5;
/// A pose that leaves more than the best by this many standard deviations does not fit.
const APART: f64 = 5.0;
/// A start whose squared directions are off by this much more than the best one's has a normal
/// inverted.
const START: f64 = 1.0;

/// Fits the motion that carries nominal points to measured ones and nominal planes to their
/// touches, all with the same standard deviation: Gauss–Newton on `T p − q` and `n·(T⁻¹ q − p) − r`
/// from a closed-form start.
///
/// A plane fitted to touches has no outer side, so that several motions may fit alike. Of these the
/// one is taken under which no touch lies outside of another plane (a convex corner).
///
/// # Errors
/// If a plane cannot be fitted or points and planes together leave a motion free (it is named), or
/// if several motions fit and the rule of the convex corner does not leave one.
pub fn points_and_planes(
    points: &[(Vector, Vector)],
    planes: &[TouchedPlane],
    probe_radius_m: f64,
    sigma_m: Option<f64>,
) -> Result<FeatureFit, FrameError> {
    weighted_points_and_planes(points, planes, None, probe_radius_m, sigma_m)
}

/// The same with weights 1/σ² in any unit: one a point, then one a touch, in order.
///
/// # Errors
/// As [`points_and_planes`]; a weight that is negative or no number.
///
/// # Panics
/// If there are fewer weights than points and touches.
pub fn weighted_points_and_planes(
    points: &[(Vector, Vector)],
    planes: &[TouchedPlane],
    weights: Option<&[f64]>,
    probe_radius_m: f64,
    sigma_m: Option<f64>,
) -> Result<FeatureFit, FrameError> {
    let is_good = |w: &f64| w.is_finite() && *w >= 0.0;
    if let Some(at) = weights.and_then(|w| w.iter().position(|w| !is_good(w))) {
        return Err(RegisterError::Weight { row: at + 1 }.into());
    }
    let touches: usize = planes.iter().map(|p| p.touches_m.len()).sum();
    let rows = 3 * points.len() + touches;
    let roots: Vec<f64> = (0..points.len() + touches)
        .flat_map(|i| {
            let root = weights.map_or(1.0, |w| w[i]).sqrt();
            std::iter::repeat_n(root, if i < points.len() { 3 } else { 1 })
        })
        .collect();
    let problem = Problem {
        points,
        planes,
        roots: &roots,
        probe_radius_m,
        centre: measured_centre(points, planes),
    };
    let mut fits = Vec::new();
    let mut failed = None;
    for start in starts(points, planes, probe_radius_m)? {
        match problem.refined(start) {
            Ok(fit) => fits.push(fit),
            Err(error) => failed = failed.or(Some(error)),
        }
    }
    fits.sort_by(|a, b| a.left.norm_squared().total_cmp(&b.left.norm_squared()));
    let Some(best) = fits.first() else {
        return Err(failed.unwrap_or(FrameError::Free {
            motion: "the directions of the features are all parallel".into(),
            smallest: 0.0,
        }));
    };
    #[allow(clippy::cast_precision_loss)]
    let freedom = (rows as f64 - 6.0).max(1.0);
    let of = |fit: &Refined| sigma_m.unwrap_or((fit.left.norm_squared() / freedom).sqrt());
    let noise = of(best).max(FORM_M);
    let limit = best.left.norm_squared() + (APART * noise).powi(2);
    let mut alike: Vec<Refined> = Vec::new();
    for fit in fits {
        let known = alike.iter().any(|a| a.apart_rad(&fit) < NEAR_LINE);
        if !known && fit.left.norm_squared() <= limit {
            alike.push(fit);
        }
    }
    let found = alike.len();
    if found > 1 {
        let error = ambiguous(&alike, rows);
        alike.retain(|fit| problem.is_convex(&fit.pose, APART * noise));
        if alike.len() != 1 {
            return Err(error);
        }
    }
    let fit = alike.swap_remove(0);
    let sigma = of(&fit);
    let misfits = problem.misfits(&fit, sigma_m);
    let reach = spread(points, planes, problem.centre);
    let scaled = Matrix6::from_fn(|i, j| {
        let value: f64 = (0..6)
            .map(|k| fit.svd.right[(i, k)] * fit.svd.right[(j, k)] / fit.svd.values[k].powi(2))
            .sum();
        let unit = |i: usize| if i < 3 { 1.0 / reach } else { 1.0 };
        value * unit(i) * unit(j) * sigma * sigma
    });
    let pose = fit.pose;
    let points_m = points
        .iter()
        .map(|(p, q)| sub(*q, pose.transform(*p)))
        .collect();
    let planes_m = planes.iter().map(|plane| {
        let normal = pose.rotation * plane.normal;
        let on = pose.transform(plane.point_m);
        let left = plane.touches_m.iter();
        left.map(|q| dot(normal, sub(*q, on)) - probe_radius_m)
            .collect()
    });
    Ok(FeatureFit {
        to_from_from: pose,
        points_m,
        planes_m: planes_m.collect(),
        sigma_m: sigma,
        covariance: PoseCovariance::new(problem.centre, &scaled),
        others: found - 1,
        misfits,
    })
}

/// The two best of several that fit alike.
fn ambiguous(alike: &[Refined], rows: usize) -> FrameError {
    #[allow(clippy::cast_precision_loss)]
    let left_mm = |fit: &Refined| mm_from_m((fit.left.norm_squared() / rows as f64).sqrt());
    FrameError::Ambiguous {
        apart_deg: alike[0].apart_rad(&alike[1]).to_degrees(),
        other_mm: left_mm(&alike[1]),
        best_mm: left_mm(&alike[0]),
    }
}

/// Points and planes with the roots of their weights, row by row.
struct Problem<'a> {
    points: &'a [(Vector, Vector)],
    planes: &'a [TouchedPlane],
    roots: &'a [f64],
    probe_radius_m: f64,
    centre: Vector,
}

/// A motion that fits best near its start.
struct Refined {
    pose: Pose,
    left: DVector<f64>,
    svd: linear::Svd,
}

impl Refined {
    fn apart_rad(&self, other: &Self) -> f64 {
        (self.pose.rotation * other.pose.rotation.transpose()).angle()
    }
}

impl Problem<'_> {
    /// What a pose leaves, and its derivative.
    fn linearised(&self, pose: &Pose, reach: f64) -> (DVector<f64>, DMatrix<f64>) {
        let rows = self.roots.len().max(6);
        let mut jacobian = DMatrix::zeros(rows, 6);
        let mut left = DVector::zeros(rows);
        let mut row = 0;
        for (p, q) in self.points {
            let at = pose.transform(*p);
            let arm = crossing(sub(at, self.centre));
            for k in 0..3 {
                left[row] = at[k] - q[k];
                for j in 0..3 {
                    jacobian[(row, j)] = -arm[(k, j)] / reach;
                    jacobian[(row, 3 + j)] = f64::from(u8::from(j == k));
                }
                row += 1;
            }
        }
        for plane in self.planes {
            let normal = pose.rotation * plane.normal;
            let on = pose.transform(plane.point_m);
            for q in &plane.touches_m {
                left[row] = dot(normal, sub(*q, on)) - self.probe_radius_m;
                let turn = cross(sub(*q, self.centre), normal);
                for j in 0..3 {
                    jacobian[(row, j)] = -turn[j] / reach;
                    jacobian[(row, 3 + j)] = -normal[j];
                }
                row += 1;
            }
        }
        for (row, root) in self.roots.iter().enumerate() {
            left[row] *= root;
            jacobian.row_mut(row).scale_mut(*root);
        }
        (left, jacobian)
    }

    fn refined(&self, start: Pose) -> Result<Refined, FrameError> {
        let mut pose = start;
        let reach = spread(self.points, self.planes, self.centre);
        let mut steps = 0;
        loop {
            let (left, jacobian) = self.linearised(&pose, reach);
            let svd = linear::svd(&jacobian);
            refuse_free(&svd)?;
            let along = svd.left.transpose() * -&left;
            let step = &svd.right * along.component_div(&svd.values);
            let turn = [step[0], step[1], step[2]].map(|v| v / reach);
            let shift = [step[3], step[4], step[5]];
            steps += 1;
            if steps > 30 || norm(turn) < 1e-14 && norm(shift) < 1e-14 {
                return Ok(Refined { pose, left, svd });
            }
            let back = sub(pose.translation, self.centre);
            let turned = Rotation::from_vector(turn);
            pose = Pose {
                rotation: turned * pose.rotation,
                translation: add(add(self.centre, shift), turned * back),
            };
        }
    }

    /// What the other rows contradict.
    fn misfits(&self, fit: &Refined, sigma_m: Option<f64>) -> Vec<Misfit> {
        let mut parts: Vec<(Part, Vec<usize>)> = Vec::new();
        parts
            .extend((0..self.points.len()).map(|i| (Part::Point(i), (3 * i..3 * i + 3).collect())));
        let mut row = 3 * self.points.len();
        for (i, plane) in self.planes.iter().enumerate() {
            let touches = plane.touches_m.len();
            parts.extend((0..touches).map(|k| (Part::Touch(i, k), vec![row + k])));
            parts.push((Part::Plane(i), (row..row + touches).collect()));
            row += touches;
        }
        let rows: Vec<Vec<usize>> = parts.iter().map(|(_, rows)| rows.clone()).collect();
        let found = contradicted(&fit.svd.left, &fit.left, &rows, sigma_m);
        let misfit = |one: Contradicted| {
            let (part, rows) = &parts[one.part];
            let squares = rows.iter().zip(&one.left);
            let squares = squares.map(|(row, left)| (left / self.roots[*row]).powi(2));
            let sum: f64 = squares.filter(|square| square.is_finite()).sum();
            #[allow(clippy::cast_precision_loss)]
            let of = match part {
                Part::Plane(_) => rows.len() as f64,
                _ => 1.0,
            };
            Misfit {
                part: *part,
                off_m: (sum / of).sqrt(),
                sigmas: one.times,
            }
        };
        found.into_iter().map(misfit).collect()
    }

    /// Whether no touch of a plane lies outside of another one.
    fn is_convex(&self, pose: &Pose, slack_m: f64) -> bool {
        let from_to = pose.inverse();
        self.planes.iter().enumerate().all(|(i, plane)| {
            let mut touches = plane.touches_m.iter().map(|q| from_to.transform(*q));
            touches.all(|q| {
                let mut others = self.planes.iter().enumerate().filter(|(j, _)| *j != i);
                others.all(|(_, other)| {
                    let outside = dot(other.normal, sub(q, other.point_m));
                    outside <= self.probe_radius_m + slack_m
                })
            })
        })
    }
}

fn measured_centre(points: &[(Vector, Vector)], planes: &[TouchedPlane]) -> Vector {
    let all = points
        .iter()
        .map(|p| p.1)
        .chain(planes.iter().flat_map(|p| p.touches_m.iter().copied()));
    let (sum, count) = all.fold(([0.0; 3], 0.0), |(sum, n), p| (add(sum, p), n + 1.0));
    scale(1.0 / f64::max(count, 1.0), sum)
}

fn spread(points: &[(Vector, Vector)], planes: &[TouchedPlane], centre: Vector) -> f64 {
    let all = points
        .iter()
        .map(|p| p.1)
        .chain(planes.iter().flat_map(|p| p.touches_m.iter().copied()));
    all.map(|p| norm(sub(p, centre))).fold(1e-9, f64::max)
}

fn refuse_free(svd: &linear::Svd) -> Result<(), FrameError> {
    let smallest = svd.values[5] / svd.values[0];
    if smallest > 1e-4 {
        return Ok(());
    }
    let open = svd.right.column(5);
    let (turn, shift) = (
        Vector3::new(open[0], open[1], open[2]),
        Vector3::new(open[3], open[4], open[5]),
    );
    let (what, v) = if turn.norm() > shift.norm() {
        ("rotating about", turn.normalize())
    } else {
        ("sliding along", shift.normalize())
    };
    Err(FrameError::Free {
        motion: format!("{what} ({:.2}, {:.2}, {:.2})", v[0], v[1], v[2]),
        smallest,
    })
}

/// Rotations from matched directions (normals, and points from their centre), translations by least
/// squares: one for each choice of the fitted normals' signs that goes together.
fn starts(
    points: &[(Vector, Vector)],
    planes: &[TouchedPlane],
    probe_radius_m: f64,
) -> Result<Vec<Pose>, FrameError> {
    if planes.is_empty() {
        let (from, to): (Vec<_>, Vec<_>) = points.iter().copied().unzip();
        return Ok(vec![kabsch(&from, &to, None)?.to_from_from]);
    }
    let mut fitted = Vec::new();
    for plane in planes {
        let fit = features::plane(&plane.touches_m).map_err(|error| FrameError::Feature {
            datum: "a plane",
            error,
        })?;
        fitted.push(fit);
    }
    let signs = 1_usize << fitted.len().min(10);
    let found: Vec<(f64, Pose)> = (0..signs)
        .filter_map(|sign| start_with(points, planes, &fitted, sign, probe_radius_m))
        .collect();
    let least = found
        .iter()
        .fold(f64::INFINITY, |l, (cost, _)| l.min(*cost));
    let near = found.into_iter().filter(|(cost, _)| *cost <= least + START);
    Ok(near.map(|(_, pose)| pose).collect())
}

fn start_with(
    points: &[(Vector, Vector)],
    planes: &[TouchedPlane],
    fitted: &[Plane],
    sign: usize,
    probe_radius_m: f64,
) -> Option<(f64, Pose)> {
    let mut directions = Vec::new();
    for (i, (plane, fit)) in planes.iter().zip(fitted).enumerate() {
        let s = if sign >> i & 1 == 1 { -1.0 } else { 1.0 };
        directions.push((plane.normal, scale(s, fit.normal)));
    }
    for pair in points.windows(2) {
        let (a, b) = (sub(pair[1].0, pair[0].0), sub(pair[1].1, pair[0].1));
        let (la, lb) = (norm(a), norm(b));
        if la > 0.0 && lb > 0.0 {
            directions.push((scale(1.0 / la, a), scale(1.0 / lb, b)));
        }
    }
    // a rotation about the origin: the directions and their opposites as points
    let (mut from, mut to) = (Vec::new(), Vec::new());
    for (a, b) in directions {
        from.extend([a, scale(-1.0, a)]);
        to.extend([b, scale(-1.0, b)]);
    }
    // two directions alone have no third: their product
    let products: Vec<_> = (2..from.len())
        .step_by(2)
        .map(|i| (cross(from[0], from[i]), cross(to[0], to[i])))
        .collect();
    for (a, b) in products {
        from.extend([a, scale(-1.0, a)]);
        to.extend([b, scale(-1.0, b)]);
    }
    let rotation = kabsch(&from, &to, None).ok()?.to_from_from.rotation;
    let rows = 3 * points.len() + planes.len();
    let mut a = DMatrix::zeros(rows.max(3), 3);
    let mut b = DVector::zeros(rows.max(3));
    let mut row = 0;
    for (p, q) in points {
        let missing = sub(*q, rotation * *p);
        for k in 0..3 {
            a[(row, k)] = 1.0;
            b[row] = missing[k];
            row += 1;
        }
    }
    for (plane, fit) in planes.iter().zip(fitted) {
        let normal = rotation * plane.normal;
        for k in 0..3 {
            a[(row, k)] = normal[k];
        }
        b[row] = dot(normal, sub(fit.centre_m, rotation * plane.point_m)) - probe_radius_m;
        row += 1;
    }
    let svd = linear::svd(&a);
    let mut along = svd.left.transpose() * &b;
    for (value, s) in along.iter_mut().zip(svd.values.iter()) {
        *value = if *s > 1e-9 { *value / s } else { 0.0 };
    }
    let t = &svd.right * along;
    let directions_left: f64 = from
        .iter()
        .zip(&to)
        .map(|(a, b)| norm(sub(*b, rotation * *a)).powi(2))
        .sum();
    let cost = directions_left + (&a * &t - &b).norm_squared();
    let pose = Pose {
        rotation,
        translation: [t[0], t[1], t[2]],
    };
    Some((cost, pose))
}
