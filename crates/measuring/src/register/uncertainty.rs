//! What the noise of points does to a pose, and to points that the pose carries.

use crate::geometry::{Rotation, Vector, dot, sub};
use nalgebra::{Matrix3, Matrix3x6, Matrix6, Vector3};

/// The covariance of a rigid motion: a small rotation vector ω (radians) and a small displacement τ
/// (metres) of the point `centre_m`, both along the axes of the frame that the motion maps into.
///
/// A point x of that frame moves by `τ + ω × (x − centre)`, so its error grows with the distance
/// from the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseCovariance {
    /// Where τ is tabulated, metres.
    pub centre_m: Vector,
    /// Rows and columns ω, τ: rad², rad·m, m².
    pub matrix: [[f64; 6]; 6],
}

/// The region of one standard deviation about a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// Directions of the half-axes, one a column.
    pub axes: Rotation,
    /// Half-axes, longest first, metres.
    pub half_axes_m: [f64; 3],
}

/// The matrix `m` with `m · v = a × v`.
pub(crate) fn crossing(a: Vector) -> Matrix3<f64> {
    Matrix3::new(0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0)
}

impl PoseCovariance {
    /// From a 6×6 matrix about a centre.
    pub(crate) fn new(centre_m: Vector, matrix: &Matrix6<f64>) -> Self {
        Self {
            centre_m,
            matrix: std::array::from_fn(|i| {
                std::array::from_fn(|j| 0.5 * (matrix[(i, j)] + matrix[(j, i)]))
            }),
        }
    }

    /// The 6×6 matrix, rows and columns ω, τ.
    pub(crate) fn as_matrix(&self) -> Matrix6<f64> {
        Matrix6::from_fn(|i, j| self.matrix[i][j])
    }

    /// Standard uncertainties of the rotation about the axes of the frame mapped into, radians.
    #[must_use]
    pub fn rotation_sigma_rad(&self) -> [f64; 3] {
        std::array::from_fn(|i| self.matrix[i][i].sqrt())
    }

    /// Standard uncertainty of the rotation about a unit vector of the frame mapped into, radians.
    #[must_use]
    pub fn rotation_sigma_about_rad(&self, axis: Vector) -> f64 {
        let about = |i: usize| dot(axis, [0, 1, 2].map(|j| self.matrix[i][j]));
        dot(axis, [0, 1, 2].map(about)).max(0.0).sqrt()
    }

    /// Covariance of a point of the frame mapped into (metres), from the motion alone, m².
    #[must_use]
    pub fn at(&self, point_m: Vector) -> [[f64; 3]; 3] {
        let mut jacobian = Matrix3x6::zeros();
        let arm = crossing(sub(point_m, self.centre_m));
        jacobian.fixed_view_mut::<3, 3>(0, 0).copy_from(&-arm);
        jacobian.fixed_view_mut::<3, 3>(0, 3).fill_with_identity();
        let covariance = jacobian * self.as_matrix() * jacobian.transpose();
        std::array::from_fn(|i| std::array::from_fn(|j| covariance[(i, j)]))
    }

    /// Standard uncertainties of a point of the frame mapped into, along its axes, metres.
    #[must_use]
    pub fn sigma_at_m(&self, point_m: Vector) -> [f64; 3] {
        let covariance = self.at(point_m);
        std::array::from_fn(|i| covariance[i][i].max(0.0).sqrt())
    }

    /// The error ellipsoid of one standard deviation at a point of the frame mapped into.
    #[must_use]
    pub fn ellipsoid(&self, point_m: Vector) -> Ellipsoid {
        let covariance = self.at(point_m);
        let eigen = Matrix3::from_fn(|i, j| covariance[i][j]).symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        let column = |i: usize| -> Vector3<f64> { eigen.eigenvectors.column(order[i]).into() };
        let (x, y) = (column(0), column(1));
        let columns = [x, y, x.cross(&y)];
        Ellipsoid {
            axes: Rotation(std::array::from_fn(|i| {
                std::array::from_fn(|j| columns[j][i])
            })),
            half_axes_m: order.map(|i| eigen.eigenvalues[i].max(0.0).sqrt()),
        }
    }
}
