//! Camera and board poses fitted to all rows together.

use crate::geometry::{Pose, Rotation, Vector, norm};
use crate::register::uncertainty::{PoseCovariance, crossing};
use nalgebra::{Matrix6, SMatrix, SVector, Vector3, Vector6};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

/// Largest number of steps.
const STEPS: usize = 30;
/// Standard deviations below these are rounding: radians, metres.
const FLOOR: [f64; 2] = [1e-12, 1e-12];
/// The noise of positions is at least this part of that of rotations times the distance between
/// camera and board.
///
/// Corners of noise `s` on a board of extent `w` (root mean square along an axis) at distance `D`,
/// seen at the angle `θ` to its normal: the board's place comes out with `s` across and `s D / w`
/// along the view, its turn with `s / (w sin θ)` about the two axes that tilt it (a tilted square
/// shortens by `sin θ` a radian) and `s / (√2 w)` in its plane. The ratio of the root mean squares
/// is `√((2 w² + D²) / (2 / sin² θ + ½)) ≥ D / √(2 / sin² θ + ½)`, whatever `s` and `w` are: `D /
/// 4.2` at the 20° of tilt from which poses are good. A flange that is turned by an error of the
/// arm moves the board by more, `D √⅔`.
const LEVER_PART: f64 = 0.25;
/// The bound is no bound where residuals as small as these have less than this chance under it.
const CONTRADICTED: f64 = 0.01;
/// Unknowns that positions alone determine: both places, and the camera's turn.
const OF_POSITIONS: usize = 9;

/// What is left of one row: rotation (radians) and distance (metres) of the board from where the
/// others say it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseResidual {
    /// In the fit.
    pub rotation_rad: f64,
    /// In the fit.
    pub distance_m: f64,
    /// When this row is left out of the fit.
    pub out_rotation_rad: f64,
    /// When this row is left out of the fit.
    pub out_distance_m: f64,
}

/// The joint fit.
#[derive(Clone, Debug)]
pub struct Refined {
    /// X: `flange_from_camera` or `base_from_camera`.
    pub camera: Pose,
    /// Y: `base_from_board` or `flange_from_board`.
    pub board: Pose,
    /// Covariance of X along the axes of the frame it maps into, about the camera's origin.
    pub camera_covariance: PoseCovariance,
    /// Covariance of Y likewise.
    pub board_covariance: PoseCovariance,
    /// Standard deviation of one rotation coordinate of a row, radians.
    pub sigma_rotation_rad: f64,
    /// Standard deviation of one coordinate of a row's position, metres.
    pub sigma_position_m: f64,
    /// How many residuals more than unknowns show these two, of rotations and of positions: `3 n −
    /// tr(C N)` with what each kind adds to the normal matrix `N` of the fit. Together `6 n − 12`,
    /// which is what both have where one shows the other.
    pub redundancy: [f64; 2],
    /// Root mean square rotation left, radians.
    pub rotation_rad: f64,
    /// Root mean square distance left, metres.
    pub distance_m: f64,
    /// By what BOARD's positions would fit better: 1 where the board's squares are as large as the
    /// camera was given.
    pub board_scale: f64,
    /// Its standard uncertainty; none of fewer than four rows.
    pub board_scale_sigma: Option<f64>,
    /// Steps until it stood still.
    pub steps: usize,
    /// Each row.
    pub rows: Vec<PoseResidual>,
}

type Jacobian = SMatrix<f64, 6, 12>;

/// `log(Y⁻¹ A X B)` as rotation vector and translation in the board's frame, and its derivative by
/// small motions of X and Y behind each.
fn residual(a: &Pose, b: &Pose, camera: &Pose, board_back: &Pose) -> (Vector6<f64>, Jacobian) {
    let e = *board_back * *a * *camera * *b;
    let (r, t) = (e.rotation.vector(), e.translation);
    let left = Vector6::new(r[0], r[1], r[2], t[0], t[1], t[2]);
    let back = b.rotation.transpose();
    let turn = nalgebra::Matrix3::from_fn(|i, j| back.0[i][j]);
    let mut jacobian = Jacobian::zeros();
    jacobian.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    let lever = -(turn * crossing(b.translation));
    jacobian.fixed_view_mut::<3, 3>(3, 0).copy_from(&lever);
    jacobian.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    for i in 0..6 {
        jacobian[(i, 6 + i)] = -1.0;
    }
    (left, jacobian)
}

fn moved(pose: &Pose, step: &[f64]) -> Pose {
    *pose
        * Pose {
            rotation: Rotation::from_vector([step[0], step[1], step[2]]),
            translation: [step[3], step[4], step[5]],
        }
}

impl Refined {
    /// Whether the rows show their noise: three poses can be laid on each other in all positions,
    /// by a turn of the camera.
    #[must_use]
    pub fn shows_noise(&self) -> bool {
        3 * self.rows.len() > OF_POSITIONS
    }

    /// How many times the standard uncertainties may be as large as they are given, in one case of
    /// twenty: from χ² of the smaller [`redundancy`](Self::redundancy).
    #[must_use]
    pub fn sigma_times(&self) -> f64 {
        let freedom = self.redundancy[0].min(self.redundancy[1]);
        let low = ChiSquared::new(freedom).map_or(0.0, |chi| chi.inverse_cdf(0.05));
        (freedom / low).sqrt()
    }
}

/// Gauss–Newton from X; Y starts at the mean of what the rows say. Rotations and positions are
/// weighted by their own noise, which comes from what is left of them.
///
/// Few rows leave little of positions, however large their noise is: they are followed then, and
/// rotations given up for them. So their noise is not taken for smaller than [`LEVER_PART`] allows,
/// unless the residuals contradict it.
pub(super) fn refine(a: &[Pose], b: &[Pose], start: Pose) -> Refined {
    let free = solve(a, b, start, None);
    let places: Vec<Vector> = b.iter().map(|pose| pose.translation).collect();
    let least_m = LEVER_PART * rms_m(&places);
    if free.sigma[1] >= least_m * free.sigma[0] {
        return finish(a, b, &free);
    }
    let bound = solve(a, b, start, Some(least_m));
    let [rotations, positions] = bound.redundancy;
    let ratio = (bound.own[1] / (least_m * bound.own[0])).powi(2);
    let least = FisherSnedecor::new(positions, rotations)
        .map_or(0.0, |chance| chance.inverse_cdf(CONTRADICTED));
    let enough = 3 * a.len() > OF_POSITIONS;
    let contradicted = enough && ratio < least;
    finish(a, b, if contradicted { &free } else { &bound })
}

/// A fit with its weights.
struct Solved {
    camera: Pose,
    board: Pose,
    information: SMatrix<f64, 12, 12>,
    /// By which the rows are weighted: radians, metres.
    sigma: [f64; 2],
    /// What is left of each kind for itself: radians, metres.
    own: [f64; 2],
    redundancy: [f64; 2],
    steps: usize,
}

/// With the noise of each kind from what is left of it, or with a given ratio (metres) of
/// positions' noise to rotations' and the size from both.
fn solve(a: &[Pose], b: &[Pose], start: Pose, ratio_m: Option<f64>) -> Solved {
    let n = a.len();
    let mut solved = Solved {
        camera: start,
        board: a[0] * start * b[0],
        information: SMatrix::zeros(),
        sigma: [1.0, ratio_m.unwrap_or(1.0)],
        own: FLOOR,
        redundancy: [0.0; 2],
        steps: 0,
    };
    for round in 0..STEPS {
        solved.steps = round + 1;
        let sigma = solved.sigma;
        let mut parts = [SMatrix::<f64, 12, 12>::zeros(); 2];
        let mut right = SVector::<f64, 12>::zeros();
        let mut sums = [0.0; 2];
        let back = solved.board.inverse();
        for (a, b) in a.iter().zip(b) {
            let (left, jacobian) = residual(a, b, &solved.camera, &back);
            for k in 0..6 {
                let kind = k / 3;
                sums[kind] += left[k] * left[k];
                let weight = 1.0 / (sigma[kind] * sigma[kind]);
                let row = jacobian.row(k);
                // rows touch six or seven of the twelve: plain loops over the lower triangle
                for i in 0..12 {
                    let w = weight * row[i];
                    if w != 0.0 {
                        right[i] -= w * left[k];
                        for j in 0..=i {
                            parts[kind][(i, j)] += w * row[j];
                        }
                    }
                }
            }
        }
        for part in &mut parts {
            part.fill_upper_triangle_with_lower_triangle();
        }
        solved.information = parts[0] + parts[1];
        let Some(factor) = solved.information.cholesky() else {
            break;
        };
        let step = factor.solve(&right);
        solved.camera = moved(&solved.camera, &step.as_slice()[..6]);
        solved.board = moved(&solved.board, &step.as_slice()[6..]);
        let covariance = factor.inverse();
        #[allow(clippy::cast_precision_loss)]
        let (each, all) = (3.0 * n as f64, 6.0 * n as f64 - 12.0);
        solved.redundancy = parts.map(|part| each - (covariance * part).trace());
        solved.own = [0, 1].map(|k| {
            let freedom = solved.redundancy[k].max(f64::EPSILON);
            (sums[k] / freedom).sqrt().max(FLOOR[k])
        });
        let now = ratio_m.map_or(solved.own, |ratio_m| {
            let both = sums[0] + sums[1] / (ratio_m * ratio_m);
            let size = (both / all).sqrt().max(FLOOR[0]);
            [size, ratio_m * size]
        });
        let settled = (0..2).all(|k| (now[k] / sigma[k] - 1.0).abs() < 1e-6 || now[k] <= FLOOR[k]);
        // the first step mends what the start left; its noise is not yet that of the rows
        if round > 0 {
            solved.sigma = now;
        }
        if step.norm() < 1e-12 && (settled || round > 10) {
            break;
        }
    }
    solved
}

fn finish(a: &[Pose], b: &[Pose], solved: &Solved) -> Refined {
    let (camera, board, sigma) = (solved.camera, solved.board, solved.sigma);
    let covariance = solved
        .information
        .try_inverse()
        .unwrap_or_else(SMatrix::<f64, 12, 12>::zeros);
    let weights = Vector6::from_fn(|i, _| 1.0 / (sigma[i / 3] * sigma[i / 3]));
    let back = board.inverse();
    let row = |(a, b): (&Pose, &Pose)| {
        let (left, jacobian) = residual(a, b, &camera, &back);
        // left out, a residual grows by (1 − J C Jᵀ W)⁻¹
        let share = jacobian * covariance * jacobian.transpose() * Matrix6::from_diagonal(&weights);
        let out = (Matrix6::identity() - share)
            .try_inverse()
            .map_or(left, |grown| grown * left);
        let length = |v: &Vector6<f64>, at: usize| Vector3::new(v[at], v[at + 1], v[at + 2]).norm();
        PoseResidual {
            rotation_rad: length(&left, 0),
            distance_m: length(&left, 3),
            out_rotation_rad: length(&out, 0),
            out_distance_m: length(&out, 3),
        }
    };
    let rows: Vec<PoseResidual> = a.iter().zip(b).map(row).collect();
    #[allow(clippy::cast_precision_loss)]
    let rms = |of: fn(&PoseResidual) -> f64| {
        (rows.iter().map(|r| of(r).powi(2)).sum::<f64>() / rows.len() as f64).sqrt()
    };
    let part = |at: usize, pose: &Pose| {
        let block = Matrix6::from_fn(|i, j| covariance[(at + i, at + j)]);
        along_world(&block, pose)
    };
    let (board_scale, board_scale_sigma) = board_scale(a, b, &camera, &back, &covariance, sigma);
    Refined {
        board_scale,
        board_scale_sigma,
        camera_covariance: part(0, &camera),
        board_covariance: part(6, &board),
        camera,
        board,
        sigma_rotation_rad: sigma[0],
        sigma_position_m: sigma[1],
        rotation_rad: rms(|r| r.rotation_rad),
        redundancy: solved.redundancy,
        distance_m: rms(|r| r.distance_m),
        steps: solved.steps,
        rows,
    }
}

/// A factor of BOARD's positions as a thirteenth unknown, from the fit of the twelve: with the
/// derivative `g` of a residual by it, `1 − Σ gᵀ W r / (Σ gᵀ W g − hᵀ C h)`, `h = Σ Jᵀ W g`.
/// Positions alone weigh in it: rotations have no length.
fn board_scale(
    a: &[Pose],
    b: &[Pose],
    camera: &Pose,
    board_back: &Pose,
    covariance: &SMatrix<f64, 12, 12>,
    sigma: [f64; 2],
) -> (f64, Option<f64>) {
    let weight = 1.0 / (sigma[1] * sigma[1]);
    let (mut gr, mut gg, mut rr) = (0.0, 0.0, 0.0);
    let mut h = SVector::<f64, 12>::zeros();
    for (a, b) in a.iter().zip(b) {
        let (left, jacobian) = residual(a, b, camera, board_back);
        let turn = (*board_back * *a * *camera).rotation;
        let g = turn * b.translation;
        for k in 0..3 {
            gr += weight * g[k] * left[3 + k];
            gg += weight * g[k] * g[k];
            rr += weight * left[3 + k] * left[3 + k];
            h += jacobian.row(3 + k).transpose() * (weight * g[k]);
        }
    }
    let information = gg - (h.transpose() * covariance * h)[(0, 0)];
    // where all is taken by the other unknowns, nothing is left but rounding
    if a.len() < 4 || information.is_nan() || information <= 1e-9 * gg {
        return (1.0, None);
    }
    let off = -gr / information;
    // seven unknowns of positions
    #[allow(clippy::cast_precision_loss)]
    let freedom = (3 * a.len() - 7) as f64;
    let noise = ((rr - gr * gr / information).max(0.0) / freedom).sqrt();
    (1.0 + off, Some(noise / information.sqrt()))
}

/// A covariance of small motions behind a pose, expressed along the axes of the frame that the pose
/// maps into.
fn along_world(block: &Matrix6<f64>, pose: &Pose) -> PoseCovariance {
    let turn = nalgebra::Matrix3::from_fn(|i, j| pose.rotation.0[i][j]);
    let mut both = Matrix6::zeros();
    both.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    both.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    PoseCovariance::new(pose.translation, &(both * block * both.transpose()))
}

/// Root mean square of distances.
pub(super) fn rms_m(vectors: &[Vector]) -> f64 {
    #[allow(clippy::cast_precision_loss)]
    let mean = vectors.iter().map(|v| norm(*v).powi(2)).sum::<f64>() / vectors.len() as f64;
    mean.sqrt()
}
