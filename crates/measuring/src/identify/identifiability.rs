//! What the data can tell apart, and how well: rank, confounding, observability.

use super::normal::Normal;
use super::parameters::{FIRST_PHYSICAL, Parameter};
use nalgebra::{DMatrix, DVector};

/// A column is redundant where less than this part of it is left when earlier columns have
/// explained the rest.
pub const REDUNDANT: f64 = 1e-4;
/// A column shows nothing where a typical size of its parameter moves all rows together by fewer
/// standard deviations.
const INVISIBLE: f64 = 1e-3;
/// A parameter is hardly seen that the data would tell with a standard deviation of more than this
/// many typical sizes.
pub const WEAK: f64 = 3.0;
/// The part of a redundant column that another parameter must explain to be named.
const NAMED: f64 = 0.1;

/// Why a parameter is left at its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Dropped {
    /// Index of the parameter.
    pub parameter: usize,
    /// Parameters that do the same to the data together, strongest first; empty where it does
    /// nothing.
    pub confounded_with: Vec<usize>,
    /// Its standard deviation in its typical sizes, where it is seen but known less well than
    /// before.
    pub weak: Option<f64>,
}

/// Which parameters the data determine.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Identifiable {
    /// Indices of the parameters kept, in order.
    pub kept: Vec<usize>,
    /// The others.
    pub dropped: Vec<Dropped>,
}

/// Finds redundant columns in the order of the parameters, earlier ones are kept: a Cholesky
/// factorisation of the scaled normal matrix that leaves out every column whose pivot vanishes.
/// With the residuals' size `noise` in standard deviations, those are left out as well, the least
/// known first, whose standard deviation besides all that is kept would be more than [`WEAK`]
/// typical sizes.
///
/// A pivot is the squared part of a column that earlier ones leave; rounding is some 1e-14 of it,
/// the limit is [`REDUNDANT`] squared.
#[must_use]
pub fn identifiable(normal: &Normal, parameters: &[Parameter], noise: Option<f64>) -> Identifiable {
    let count = parameters.len();
    let mut found = Identifiable::default();
    // rows of the factor for the kept columns
    let mut factor: Vec<Vec<f64>> = Vec::new();
    for j in 0..count {
        let length = normal.matrix[(j, j)];
        if length.sqrt() < INVISIBLE {
            found.dropped.push(Dropped {
                parameter: j,
                confounded_with: Vec::new(),
                weak: None,
            });
            continue;
        }
        let mut row: Vec<f64> = Vec::with_capacity(factor.len() + 1);
        for (k, other) in found.kept.iter().enumerate() {
            let known: f64 = (0..k).map(|l| row[l] * factor[k][l]).sum();
            row.push((normal.matrix[(j, *other)] - known) / factor[k][k]);
        }
        let left = length - row.iter().map(|x| x * x).sum::<f64>();
        if left > REDUNDANT * REDUNDANT * length {
            row.push(left.sqrt());
            factor.push(row);
            found.kept.push(j);
            continue;
        }
        // coefficients on the kept columns: back substitution
        let mut weights = row;
        for k in (0..weights.len()).rev() {
            weights[k] /= factor[k][k];
            for l in 0..k {
                weights[l] -= factor[k][l] * weights[k];
            }
        }
        let others = found.kept.iter().copied().zip(weights);
        let confounded_with = explained_by(normal, j, others);
        found.dropped.push(Dropped {
            parameter: j,
            confounded_with,
            weak: None,
        });
    }
    if let Some(noise) = noise {
        leave_out_weak(normal, parameters, noise, &mut found);
    }
    found
}

/// The columns that explain one, strongest first: those whose weight times their length is a good
/// part of its own.
fn explained_by(
    normal: &Normal,
    column: usize,
    others: impl Iterator<Item = (usize, f64)>,
) -> Vec<usize> {
    let length = normal.matrix[(column, column)];
    let mut parts: Vec<(f64, usize)> = others
        .map(|(other, weight)| {
            let part = weight.abs() * (normal.matrix[(other, other)] / length).sqrt();
            (part, other)
        })
        .filter(|(part, _)| *part > NAMED)
        .collect();
    parts.sort_by(|a, b| b.0.total_cmp(&a.0));
    parts.into_iter().map(|(_, other)| other).collect()
}

/// Leaves out what is kept but hardly known, one after another: without one the others are known
/// better.
fn leave_out_weak(normal: &Normal, parameters: &[Parameter], noise: f64, found: &mut Identifiable) {
    let Some(factor) = normal.part(&found.kept).matrix.cholesky() else {
        return;
    };
    let mut covariance = factor.inverse();
    loop {
        // what a person asked for by name is given with its standard deviation
        let physical = |at: &usize| {
            let parameter = &parameters[found.kept[*at]];
            parameter.rank >= FIRST_PHYSICAL && !parameter.asked
        };
        let sigma = |at: usize| noise * covariance[(at, at)].max(0.0).sqrt();
        let worst = (0..found.kept.len())
            .filter(physical)
            .max_by(|a, b| sigma(*a).total_cmp(&sigma(*b)));
        let Some(at) = worst.filter(|at| sigma(*at) > WEAK) else {
            return;
        };
        let own = covariance[(at, at)];
        let others = found.kept.iter().copied().enumerate();
        let others = others.filter(|(k, _)| *k != at);
        let others = others.map(|(k, other)| (other, covariance[(at, k)] / own));
        let confounded_with = explained_by(normal, found.kept[at], others);
        found.dropped.push(Dropped {
            parameter: found.kept.remove(at),
            confounded_with,
            weak: Some(sigma(at)),
        });
        // the others' covariance once this one is not sought
        let column = covariance.column(at) / own.sqrt();
        covariance -= &column * column.transpose();
        covariance = covariance.remove_row(at).remove_column(at);
    }
}

/// Singular values of a square matrix by one-sided Jacobi rotations, largest first.
///
/// # Source
/// M. R. Hestenes, "Inversion of matrices by biorthogonalization and related results" (1958); J.
/// Demmel, K. Veselić, "Jacobi's method is more accurate than QR" (1992).
#[must_use]
pub fn singular_values(matrix: &DMatrix<f64>) -> Vec<f64> {
    let mut a = matrix.clone();
    let count = a.ncols();
    for _ in 0..60 {
        let mut rotated = false;
        for p in 0..count {
            for q in p + 1..count {
                let (x, y) = (a.column(p).norm_squared(), a.column(q).norm_squared());
                let z = a.column(p).dot(&a.column(q));
                if z.abs() <= f64::EPSILON * (x * y).sqrt() || z == 0.0 {
                    continue;
                }
                rotated = true;
                let zeta = (y - x) / (2.0 * z);
                let t = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                let c = 1.0 / (1.0 + t * t).sqrt();
                let s = c * t;
                for i in 0..a.nrows() {
                    let (u, v) = (a[(i, p)], a[(i, q)]);
                    a[(i, p)] = c * u - s * v;
                    a[(i, q)] = s * u + c * v;
                }
            }
        }
        if !rotated {
            break;
        }
    }
    let mut values: Vec<f64> = a.column_iter().map(|c| c.norm()).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// How well a set of configurations shows the parameters.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Observability {
    /// Parameters determined.
    pub rank: usize,
    /// `(σ1·…·σm)^(1/m) / √n` with n rows (Borm and Menq).
    pub o1: f64,
    /// `σmin / σmax`, the inverse condition number (Driels and Pathre).
    pub o2: f64,
    /// `σmin` (Nahvi, Hollerbach and Hayward).
    pub o3: f64,
    /// `σmin² / σmax`, the noise amplification (Nahvi and Hollerbach).
    pub o4: f64,
    /// `1 / Σ 1/σ` (Sun and Hollerbach).
    pub o5: f64,
    /// `σmax / σmin`.
    pub condition_number: f64,
    /// `σmin`.
    pub min_singular_value: f64,
    /// All singular values, largest first.
    pub singular_values: Vec<f64>,
}

/// The indices of these singular values, with `rows` measured configurations.
///
/// # Source
/// J. H. Borm, C. H. Menq (1991); M. R. Driels, U. S. Pathre (1990); A. Nahvi, J. M. Hollerbach
/// (1994, 1996); Y. Sun, J. M. Hollerbach, "Observability index selection for robot calibration"
/// (2008).
#[must_use]
pub fn observability(singular_values: Vec<f64>, rows: usize) -> Observability {
    let count = singular_values.len();
    let (Some(&most), Some(&least)) = (singular_values.first(), singular_values.last()) else {
        return Observability::default();
    };
    let logs: f64 = singular_values.iter().map(|s| s.ln()).sum();
    let o1 = (logs / count as f64).exp() / (rows as f64).sqrt();
    Observability {
        rank: count,
        o1: if o1.is_finite() { o1 } else { 0.0 },
        o2: least / most,
        o3: least,
        o4: least * least / most,
        o5: 1.0 / singular_values.iter().map(|s| 1.0 / s).sum::<f64>(),
        condition_number: most / least,
        min_singular_value: least,
        singular_values,
    }
}

impl Normal {
    /// The rows and columns of some parameters.
    #[must_use]
    pub fn part(&self, kept: &[usize]) -> Self {
        let count = kept.len();
        Self {
            matrix: DMatrix::from_fn(count, count, |i, j| self.matrix[(kept[i], kept[j])]),
            gradient: DVector::from_fn(count, |i, _| self.gradient[kept[i]]),
            cost: self.cost,
            squares: self.squares.clone(),
            prior_squares: kept.iter().map(|i| self.prior_squares[*i]).collect(),
        }
    }

    /// `R` of the QR factorisation of the scaled Jacobian; `None` where a column is redundant.
    #[must_use]
    pub fn factor(&self) -> Option<DMatrix<f64>> {
        Some(self.matrix.clone().cholesky()?.l().transpose())
    }

    /// By how much the sum of squares falls when the columns `new` are added to the columns
    /// `present`, both fitted: the test of a candidate effect without solving again. The second
    /// value is the candidate's parameters in their scales.
    #[must_use]
    pub fn gain(&self, present: &[usize], new: &[usize]) -> Option<(f64, DVector<f64>)> {
        let block = |rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
                self.matrix[(rows[i], columns[j])]
            })
        };
        let take = |rows: &[usize]| DVector::from_fn(rows.len(), |i, _| self.gradient[rows[i]]);
        let mut rest = block(new, new);
        let mut slope = take(new);
        let before: Vec<f64> = rest.diagonal().iter().copied().collect();
        if !present.is_empty() {
            let factor = block(present, present).cholesky()?;
            let across = block(present, new);
            slope -= across.transpose() * factor.solve(&take(present));
            rest -= across.transpose() * factor.solve(&across);
        }
        // what the present columns explain already is no candidate
        let seen = rest
            .diagonal()
            .iter()
            .zip(&before)
            .all(|(now, then)| *now > REDUNDANT * REDUNDANT * then);
        if !seen {
            return None;
        }
        let values = rest.cholesky()?.solve(&slope);
        Some((slope.dot(&values), values))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn singular_values_agree_with_the_eigenvalues_of_the_product() {
        let a = DMatrix::from_fn(7, 7, |i, j| ((3 * i + 5 * j * j + 1) as f64).sin());
        let mut peer: Vec<f64> = (a.transpose() * &a)
            .symmetric_eigenvalues()
            .iter()
            .map(|v| v.max(0.0).sqrt())
            .collect();
        peer.sort_by(|a, b| b.total_cmp(a));
        for (mine, peer) in singular_values(&a).iter().zip(&peer) {
            assert!((mine - peer).abs() < 1e-7, "{mine} {peer}");
        }
    }

    #[test]
    fn equal_columns_give_a_singular_value_of_zero() {
        let mut a = DMatrix::from_fn(9, 9, |i, j| ((i * i + 7 * j) as f64).cos());
        let first = a.column(0).clone_owned();
        a.set_column(8, &first);
        let values = singular_values(&a);
        assert!(values[8] < 1e-14 * values[0]);
    }
}
