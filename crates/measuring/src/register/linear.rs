//! Small dense problems whose rank matters: singular values by one-sided Jacobi rotations.

use nalgebra::{DMatrix, DVector};

/// `A = U · diag(S) · Vᵀ` with the singular values in falling order.
#[derive(Clone, Debug)]
pub(crate) struct Svd {
    /// Left singular vectors, one a column; not orthonormal where the singular value is zero.
    pub left: DMatrix<f64>,
    /// Singular values, largest first.
    pub values: DVector<f64>,
    /// Right singular vectors, one a column.
    pub right: DMatrix<f64>,
}

/// Sweeps after which the rotations have long stopped for any matrix of finite numbers.
const SWEEPS: usize = 60;

/// Singular value decomposition of a matrix with at least as many rows as columns.
///
/// One-sided Jacobi: columns are turned in pairs until all are orthogonal. A tall matrix is reduced
/// by QR first.
///
/// # Source
/// G. Golub, C. Van Loan, "Matrix Computations", sec. 8.6.3 (M. Hestenes 1958).
pub(crate) fn svd(matrix: &DMatrix<f64>) -> Svd {
    let (rows, columns) = matrix.shape();
    if rows > 2 * columns {
        let qr = matrix.clone().qr();
        let small = svd(&qr.r());
        return Svd {
            left: qr.q() * &small.left,
            ..small
        };
    }
    let mut work = matrix.clone();
    let mut right = DMatrix::identity(columns, columns);
    for _ in 0..SWEEPS {
        let mut turned = false;
        for i in 0..columns {
            for j in i + 1..columns {
                let (a, b) = (work.column(i).norm_squared(), work.column(j).norm_squared());
                let c = work.column(i).dot(&work.column(j));
                if c.abs() <= f64::EPSILON * (a * b).sqrt() || c == 0.0 {
                    continue;
                }
                turned = true;
                let zeta = (b - a) / (2.0 * c);
                let t = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
                let cosine = 1.0 / t.hypot(1.0);
                let sine = cosine * t;
                for matrix in [&mut work, &mut right] {
                    for row in 0..matrix.nrows() {
                        let (x, y) = (matrix[(row, i)], matrix[(row, j)]);
                        matrix[(row, i)] = cosine * x - sine * y;
                        matrix[(row, j)] = sine * x + cosine * y;
                    }
                }
            }
        }
        if !turned {
            break;
        }
    }
    let norms: Vec<f64> = work.column_iter().map(|c| c.norm()).collect();
    let mut order: Vec<usize> = (0..columns).collect();
    order.sort_by(|a, b| norms[*b].total_cmp(&norms[*a]));
    let mut left = DMatrix::zeros(rows, columns);
    let mut sorted = DMatrix::zeros(columns, columns);
    let mut values = DVector::zeros(columns);
    for (to, &from) in order.iter().enumerate() {
        values[to] = norms[from];
        sorted.set_column(to, &right.column(from));
        if norms[from] > 0.0 {
            left.set_column(to, &(work.column(from) / norms[from]));
        }
    }
    Svd {
        left,
        values,
        right: sorted,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};

    #[test]
    fn products_are_met_and_equal_columns_give_a_zero() {
        let mut random = rand::rngs::StdRng::seed_from_u64(3);
        for _ in 0..2000 {
            let columns = random.random_range(2..8);
            let rows = columns + random.random_range(0..30);
            let mut a = DMatrix::from_fn(rows, columns, |_, _| random.random_range(-1.0..1.0));
            let first = a.column(0).into_owned();
            a.set_column(columns - 1, &first);
            let svd = svd(&a);
            let back = &svd.left * DMatrix::from_diagonal(&svd.values) * svd.right.transpose();
            assert!((back - &a).norm() < 1e-13 * a.norm());
            assert!(svd.values[columns - 1] < 1e-14 * svd.values[0]);
            let unit = svd.right.transpose() * &svd.right;
            assert!((unit - DMatrix::identity(columns, columns)).norm() < 1e-13);
        }
    }
}
