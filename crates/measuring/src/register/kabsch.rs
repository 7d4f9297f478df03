//! The rigid motion between two sets of matched points.

use super::RegisterError;
use super::linear::svd;
use super::uncertainty::{PoseCovariance, crossing};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Rotation, Vector, add, dot, norm, scale, sub};
use nalgebra::{DMatrix, Matrix3, Matrix3x6, Matrix6};
use rayon::prelude::*;

/// Spreads below this are coincident points, metres.
const COINCIDENT_M: f64 = 1e-6;
/// Sets whose extent across their longest direction is below this part of it are collinear.
const COLLINEAR: f64 = 1e-3;
/// Sets whose extents differ by this factor or more are in different units.
const UNITS: f64 = 1.5;
/// Points summed by one thread at a time.
const CHUNK: usize = 1 << 15;

/// A rigid motion fitted to matched points, and what it was fitted to.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Maps coordinates of FROM into TO.
    pub to_from_from: Pose,
    /// Weighted centre of the FROM points, metres.
    pub from_centre_m: Vector,
    /// Weighted centre of the TO points, metres.
    pub to_centre_m: Vector,
    /// Scale of a similarity fitted to the same points: 1 where both sets have the same units and
    /// temperature.
    pub scale: f64,
    /// Number of points with a weight above zero.
    pub count: usize,
    /// Sum of weighted squared distances of the FROM points from their centre, m².
    pub from_spread_m2: f64,
    /// Root mean square distance that the best mirror image leaves, weighted, metres: that of the
    /// motion where the points lie on a plane.
    pub mirrored_m: f64,
    /// By what the motion turns the direction across the points, where they extend least, radians.
    pub across_turned_rad: f64,
}

/// Sums over matched points, relative to their first pair.
#[derive(Clone, Copy, Default)]
struct Sums {
    weight: f64,
    p: [f64; 3],
    q: [f64; 3],
    pq: [[f64; 3]; 3],
    pp: f64,
    qq: f64,
}

impl Sums {
    #[inline(always)]
    fn add(&mut self, w: f64, p: Vector, q: Vector) {
        self.weight += w;
        for i in 0..3 {
            let wp = w * p[i];
            self.p[i] += wp;
            self.q[i] += w * q[i];
            self.pp += wp * p[i];
            self.qq += w * q[i] * q[i];
            for j in 0..3 {
                self.pq[i][j] += wp * q[j];
            }
        }
    }

    fn and(mut self, other: &Self) -> Self {
        self.weight += other.weight;
        self.pp += other.pp;
        self.qq += other.qq;
        for i in 0..3 {
            self.p[i] += other.p[i];
            self.q[i] += other.q[i];
            for j in 0..3 {
                self.pq[i][j] += other.pq[i][j];
            }
        }
        self
    }

    fn of(from: &[Vector], to: &[Vector], weights: Option<&[f64]>) -> Self {
        let (a, b) = (from[0], to[0]);
        let chunk = |index: usize| {
            let range = index * CHUNK..((index + 1) * CHUNK).min(from.len());
            let mut sums = Self::default();
            let pairs = from[range.clone()].iter().zip(&to[range.clone()]);
            match weights {
                None => pairs.for_each(|(p, q)| sums.add(1.0, sub(*p, a), sub(*q, b))),
                Some(weights) => pairs
                    .zip(&weights[range])
                    .for_each(|((p, q), w)| sums.add(*w, sub(*p, a), sub(*q, b))),
            }
            sums
        };
        let chunks = from.len().div_ceil(CHUNK);
        if chunks == 1 {
            return chunk(0);
        }
        // added in the order of the points, whatever the number of threads
        let parts: Vec<Self> = (0..chunks).into_par_iter().map(chunk).collect();
        parts.iter().fold(Self::default(), Sums::and)
    }
}

/// The rotation and translation that carry `from` to `to` with the least sum of weighted squared
/// distances.
///
/// Centroids, `H = Σ w (p − p̄)(q − q̄)ᵀ = U S Vᵀ`, `R = V diag(1, 1, det(V Uᵀ)) Uᵀ`, `t = q̄ − R p̄`.
/// One pass over the points.
///
/// Shapes: as many points in both sets, metres; as many weights (1/σ², any unit), or none for equal
/// ones.
///
/// # Errors
/// If the numbers of points differ, a number is not finite, or the sets are fewer than three,
/// coincident, collinear, of different units, or mirrored; see [`RegisterError`].
///
/// # Source
/// W. Kabsch (1976); S. Umeyama, "Least-squares estimation of transformation parameters between two
/// point patterns" (1991).
pub fn kabsch(
    from: &[Vector],
    to: &[Vector],
    weights: Option<&[f64]>,
) -> Result<Fit, RegisterError> {
    if from.len() != to.len() {
        return Err(RegisterError::Counts {
            from: from.len(),
            to: to.len(),
        });
    }
    let is_good = |w: &f64| w.is_finite() && *w >= 0.0;
    if let Some(at) = weights.and_then(|w| w.iter().position(|w| !is_good(w))) {
        return Err(RegisterError::Weight { row: at + 1 });
    }
    let count = weights.map_or(from.len(), |w| w.iter().filter(|w| **w > 0.0).count());
    if count < 3 {
        return Err(RegisterError::TooFew { found: count });
    }
    let sums = Sums::of(from, to, weights);
    let w = sums.weight;
    let (p, q) = (scale(1.0 / w, sums.p), scale(1.0 / w, sums.q));
    let from_spread = sums.pp - w * dot(p, p);
    let to_spread = sums.qq - w * dot(q, q);
    if !(from_spread + to_spread).is_finite() {
        return Err(RegisterError::NotFinite);
    }
    for (set, spread) in [("FROM", from_spread), ("TO", to_spread)] {
        let spread_m = (spread / w).max(0.0).sqrt();
        if spread_m < COINCIDENT_M {
            return Err(RegisterError::Coincident {
                set,
                spread_mm: mm_from_m(spread_m),
                limit_mm: mm_from_m(COINCIDENT_M),
            });
        }
    }
    let h = DMatrix::from_fn(3, 3, |i, j| sums.pq[i][j] - w * p[i] * q[j]);
    let svd = svd(&h);
    let across = (svd.values[1] / svd.values[0]).max(0.0).sqrt();
    if across.is_nan() || across < COLLINEAR {
        return Err(collinear(from, to, weights, across));
    }
    let ratio = (to_spread / from_spread).sqrt();
    if !(1.0 / UNITS..UNITS).contains(&ratio) {
        return Err(RegisterError::Units { ratio });
    }
    // rank 2 (points in a plane) leaves the third columns open: a right-handed completion is the
    // rotation
    let column = |m: &DMatrix<f64>, j: usize| [m[(0, j)], m[(1, j)], m[(2, j)]];
    let handed = |m: &DMatrix<f64>| {
        let (x, y) = (column(m, 0), column(m, 1));
        [x, y, crate::geometry::cross(x, y)]
    };
    let (u, v) = (handed(&svd.left), handed(&svd.right));
    let rotation = Rotation(std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..3).map(|k| v[k][i] * u[k][j]).sum())
    }));
    // with the third columns completed right-handed, S3 counts negative where the true ones differ
    // in hand
    let third: f64 = (0..3)
        .flat_map(|i| (0..3).map(move |j| (i, j)))
        .map(|(i, j)| u[2][i] * h[(i, j)] * v[2][j])
        .sum();
    let gain = svd.values[0] + svd.values[1] + third;
    let left = |third: f64| {
        let gain = svd.values[0] + svd.values[1] + third;
        ((from_spread + to_spread - 2.0 * gain).max(0.0) / w).sqrt()
    };
    let mirrored_m = left(-third);
    refuse_mirrored(left(third), mirrored_m, third, (from_spread / w).sqrt())?;
    let to_centre_m = add(q, to[0]);
    let from_centre_m = add(p, from[0]);
    Ok(Fit {
        to_from_from: Pose {
            rotation,
            translation: sub(to_centre_m, rotation * from_centre_m),
        },
        from_centre_m,
        to_centre_m,
        scale: gain / from_spread,
        count,
        from_spread_m2: from_spread,
        mirrored_m,
        across_turned_rad: dot(u[2], v[2]).clamp(-1.0, 1.0).acos(),
    })
}

/// A mirror image fits better than any rotation, by more than noise can make a flat set seem turned
/// over.
fn refuse_mirrored(
    rigid_m: f64,
    mirrored_m: f64,
    third: f64,
    spread_m: f64,
) -> Result<(), RegisterError> {
    if third < 0.0 && rigid_m > 1e-6 * spread_m && mirrored_m < MIRRORED * rigid_m {
        return Err(RegisterError::Mirrored {
            rigid_mm: mm_from_m(rigid_m),
            mirrored_mm: mm_from_m(mirrored_m),
        });
    }
    Ok(())
}

/// A mirror image is one if it lowers the residual to this part.
const MIRRORED: f64 = 0.3;

fn collinear(
    from: &[Vector],
    to: &[Vector],
    weights: Option<&[f64]>,
    across: f64,
) -> RegisterError {
    let extent = |points: &[Vector]| {
        let scatter = scatter(points, weights).1;
        let mut values: Vec<f64> = scatter
            .symmetric_eigenvalues()
            .iter()
            .map(|v| v.max(0.0).sqrt())
            .collect();
        values.sort_by(f64::total_cmp);
        values[1] / values[2]
    };
    let (f, t) = (extent(from), extent(to));
    let set = match (f < COLLINEAR, t < COLLINEAR) {
        (true, true) => "both sets",
        (true, false) => "FROM",
        (false, true) => "TO",
        (false, false) => return RegisterError::Unlike { across },
    };
    RegisterError::Collinear {
        set,
        across: f.min(t),
        limit: COLLINEAR,
    }
}

/// Centre and scatter matrix of points.
pub(crate) fn scatter(points: &[Vector], weights: Option<&[f64]>) -> (Vector, Matrix3<f64>) {
    let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
    let total: f64 = (0..points.len()).map(weight).sum();
    let first = points[0];
    let sum = points.iter().enumerate().fold([0.0; 3], |sum, (i, p)| {
        add(sum, scale(weight(i), sub(*p, first)))
    });
    let centre = add(first, scale(1.0 / total, sum));
    let mut scatter = Matrix3::zeros();
    for (i, p) in points.iter().enumerate() {
        let d = nalgebra::Vector3::from(sub(*p, centre));
        scatter += weight(i) * d * d.transpose();
    }
    (centre, scatter)
}

impl Fit {
    /// The residual of each point: its place in TO minus where the motion carries it from FROM,
    /// metres.
    #[must_use]
    pub fn residuals_m(&self, from: &[Vector], to: &[Vector]) -> Vec<Vector> {
        let pose = &self.to_from_from;
        let left = |(p, q): (&Vector, &Vector)| sub(*q, pose.transform(*p));
        from.iter().zip(to).map(left).collect()
    }

    /// Root mean square distance that is left, weighted, metres.
    #[must_use]
    pub fn rmsd_m(&self, from: &[Vector], to: &[Vector], weights: Option<&[f64]>) -> f64 {
        let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
        let (mut sum, mut total) = (0.0, 0.0);
        for (i, (p, q)) in from.iter().zip(to).enumerate() {
            let d = sub(*q, self.to_from_from.transform(*p));
            sum += weight(i) * dot(d, d);
            total += weight(i);
        }
        (sum / total).sqrt()
    }

    /// The covariance of the motion where each coordinate of a point has standard deviation
    /// `sigma_m` (FROM and TO together) at weight one, metres.
    ///
    /// # Panics
    /// If these are not the points of the fit but others in a line.
    #[must_use]
    pub fn covariance(
        &self,
        from: &[Vector],
        weights: Option<&[f64]>,
        sigma_m: f64,
    ) -> PoseCovariance {
        let information = self.information(from, weights, None);
        self.covariance_by(&inverse_of(&information), sigma_m)
    }

    /// The same where the noise of a point is not alike in all directions, or not by its weight: its
    /// covariance, along the axes of TO, is `sigma_m²` by its weight by its matrix of `shapes`.
    ///
    /// With `N` the information at noise alike in all directions, and `M` the same sum of the
    /// shapes, `N⁻¹ M N⁻¹`.
    ///
    /// # Panics
    /// If these are not the points of the fit but others in a line.
    #[must_use]
    pub fn covariance_of_shapes(
        &self,
        from: &[Vector],
        weights: Option<&[f64]>,
        sigma_m: f64,
        shapes: &[[[f64; 3]; 3]],
    ) -> PoseCovariance {
        let inverse = inverse_of(&self.information(from, weights, None));
        let middle = self.information(from, weights, Some(shapes));
        self.covariance_by(&(inverse * middle * inverse), sigma_m)
    }

    /// What the sum of weighted squared residuals of such noise is in the mean, of `sigma_m` one, and
    /// the degrees of freedom with which it scatters.
    ///
    /// With the residuals' covariance `C`, `tr C` and `(tr C)²/tr C²`: noise along what the motion
    /// follows is not in the residuals, and one direction is one number.
    ///
    /// # Panics
    /// If these are not the points of the fit but others in a line.
    ///
    /// # Source
    /// F. E. Satterthwaite, Biometrics Bulletin 2 (1946).
    #[must_use]
    pub fn redundancy_of_shapes(
        &self,
        from: &[Vector],
        weights: Option<&[f64]>,
        shapes: &[[[f64; 3]; 3]],
    ) -> Redundancy {
        let inverse = inverse_of(&self.information(from, weights, None));
        let squares: Vec<[[f64; 3]; 3]> = shapes.iter().map(|shape| times(shape, shape)).collect();
        let by_motion = inverse * self.information(from, weights, Some(shapes));
        let by_squares = inverse * self.information(from, weights, Some(&squares));
        let is_used = |i: usize| weights.is_none_or(|w| w[i] > 0.0);
        let trace = |all: &[[[f64; 3]; 3]]| -> f64 {
            let each = all.iter().enumerate().filter(|(i, _)| is_used(*i));
            each.map(|(_, m)| m[0][0] + m[1][1] + m[2][2]).sum()
        };
        let mean = trace(shapes) - by_motion.trace();
        let spread = trace(&squares) - 2.0 * by_squares.trace() + (by_motion * by_motion).trace();
        Redundancy {
            mean,
            freedom: mean * mean / spread.max(f64::MIN_POSITIVE),
        }
    }

    /// Σ w Jᵀ C J of the points about the weighted centre, where rotation and translation do not
    /// mix if all C are one.
    fn information(
        &self,
        from: &[Vector],
        weights: Option<&[f64]>,
        shapes: Option<&[[[f64; 3]; 3]]>,
    ) -> Matrix6<f64> {
        let mut information = Matrix6::zeros();
        for (i, p) in from.iter().enumerate() {
            let w = weights.map_or(1.0, |w| w[i]);
            let shape = shapes.map_or_else(Matrix3::identity, |shapes| {
                Matrix3::from_fn(|row, column| shapes[i][row][column])
            });
            let arm = crossing(self.to_from_from.rotation * sub(*p, self.from_centre_m));
            let mut jacobian = Matrix3x6::zeros();
            jacobian.fixed_view_mut::<3, 3>(0, 0).copy_from(&-arm);
            jacobian.fixed_view_mut::<3, 3>(0, 3).fill_with_identity();
            information += w * jacobian.transpose() * shape * jacobian;
        }
        information
    }

    fn covariance_by(&self, matrix: &Matrix6<f64>, sigma_m: f64) -> PoseCovariance {
        PoseCovariance::new(self.to_centre_m, &(matrix * sigma_m * sigma_m))
    }

    /// Standard uncertainty of [`Fit::scale`] for the noise `sigma_m` of a coordinate, metres.
    #[must_use]
    pub fn scale_sigma(&self, sigma_m: f64) -> f64 {
        sigma_m / self.from_spread_m2.sqrt()
    }
}

/// What residuals of noise of standard deviation one come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Redundancy {
    /// The mean of their sum of squares.
    pub mean: f64,
    /// Its degrees of freedom.
    pub freedom: f64,
}

/// The largest variance of a covariance in any direction.
#[must_use]
pub fn largest_variance(covariance: &[[f64; 3]; 3]) -> f64 {
    let matrix = Matrix3::from_fn(|row, column| covariance[row][column]);
    matrix.symmetric_eigenvalues().max()
}

fn times(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

fn inverse_of(information: &Matrix6<f64>) -> Matrix6<f64> {
    let inverse = information.try_inverse();
    inverse.expect("points that are not collinear fix all six")
}

/// Standard deviation of one coordinate at weight one, from what is left of `count` points after a
/// fit of six numbers, metres: `√(Σ w |r|² / (3 n − 6))`.
#[must_use]
pub fn noise_m(residuals_m: &[Vector], weights: Option<&[f64]>) -> f64 {
    let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
    let used = (0..residuals_m.len()).filter(|i| weight(*i) > 0.0).count();
    let sum: f64 = residuals_m
        .iter()
        .enumerate()
        .map(|(i, r)| weight(i) * norm(*r).powi(2))
        .sum();
    #[allow(clippy::cast_precision_loss)]
    let freedom = (3 * used) as f64 - 6.0;
    (sum / freedom.max(1.0)).sqrt()
}
