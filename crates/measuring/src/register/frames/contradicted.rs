//! Which parts of a least-squares fit of six unknowns the other rows contradict.

use crate::register::linear::svd;
use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

/// A part is contradicted beyond so many standard deviations of chance.
const CHANCE: f64 = 4.0;
/// A part without which less than this of a direction is left fixes that direction alone: nothing
/// contradicts it.
const ALONE: f64 = 1e-6;
/// Rounding of coordinates, metres.
const FLOOR_M: f64 = 1e-9;
/// Parts that are named at most.
const MOST: usize = 20;

/// A part of the rows, and what the fit to the others leaves of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contradicted {
    /// Index of the part.
    pub part: usize,
    /// What the fit without it leaves of each of its rows.
    pub left: Vec<f64>,
    /// How many times as much as the others leave.
    pub times: f64,
}

/// The parts that the others contradict, the worst first: each is judged without those before it.
///
/// A part is left out, and the F test compares what that takes from the sum of squares with what
/// remains, or with the standard deviation `sigma` where that is larger.
///
/// # Source
/// R. D. Cook, S. Weisberg, "Residuals and Influence in Regression" (1982), for rows left out of a
/// linear fit; E. Paulson, Ann. Math. Stat. 13 (1942), for the normal deviate of F.
pub(super) fn contradicted(
    design: &DMatrix<f64>,
    left: &DVector<f64>,
    parts: &[Vec<usize>],
    sigma: Option<f64>,
) -> Vec<Contradicted> {
    let (mut design, mut left) = (design.clone(), left.clone());
    let mut is_out = vec![false; left.len()];
    let mut found = Vec::new();
    while found.len() < MOST {
        let basis = svd(&design).left;
        left -= &basis * (basis.transpose() * &left);
        let count = is_out.iter().filter(|out| !**out).count();
        let rest = Rest {
            basis: &basis,
            left: &left,
            count,
            sigma,
        };
        let inside = |rows: &[usize]| rows.iter().all(|row| !is_out[*row]);
        let judged = parts.iter().enumerate().filter(|(_, rows)| inside(rows));
        let judged = judged.filter_map(|(part, rows)| rest.judge(part, rows));
        let worst = judged.max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, worst)) = worst.filter(|(chance, _)| *chance > CHANCE) else {
            break;
        };
        for row in &parts[worst.part] {
            is_out[*row] = true;
            left[*row] = 0.0;
            design.row_mut(*row).fill(0.0);
        }
        found.push(worst);
    }
    found
}

/// Rows that are still in the fit.
struct Rest<'a> {
    /// An orthonormal basis of the design.
    basis: &'a DMatrix<f64>,
    left: &'a DVector<f64>,
    count: usize,
    sigma: Option<f64>,
}

impl Rest<'_> {
    /// A part against the others, with the normal deviate of that; none where they do not judge it.
    #[allow(clippy::cast_precision_loss)]
    fn judge(&self, part: usize, rows: &[usize]) -> Option<(f64, Contradicted)> {
        let freedom = self.count.checked_sub(6 + rows.len()).filter(|f| *f > 0)? as f64;
        let (mut others, mut along, mut own) = (Matrix6::identity(), Vector6::zeros(), 0.0);
        for row in rows {
            let u = Vector6::from_fn(|k, _| self.basis[(*row, k)]);
            others -= u * u.transpose();
            along += u * self.left[*row];
            own += self.left[*row].powi(2);
        }
        let eigen = others.symmetric_eigen();
        if eigen.eigenvalues.min() < ALONE {
            return None;
        }
        let turned = eigen.eigenvectors.transpose() * along;
        let moved = eigen.eigenvectors * turned.component_div(&eigen.eigenvalues);
        let taken = own + along.dot(&moved);
        let remains = (self.left.norm_squared() - taken).max(0.0) / freedom;
        let stated = self.sigma.map_or(0.0, |sigma| sigma.powi(2));
        let variance = remains.max(stated).max(FLOOR_M.powi(2));
        let size = rows.len() as f64;
        let ratio = taken / size / variance;
        let freedom = if variance > remains {
            f64::INFINITY
        } else {
            freedom
        };
        let left = rows.iter().map(|row| {
            let across: f64 = (0..6).map(|k| self.basis[(*row, k)] * moved[k]).sum();
            self.left[*row] + across
        });
        let judged = Contradicted {
            part,
            left: left.collect(),
            times: ratio.sqrt(),
        };
        Some((deviate(ratio, size, freedom), judged))
    }
}

/// The normal deviate of a ratio of mean squares of as many degrees of freedom.
fn deviate(ratio: f64, above: f64, below: f64) -> f64 {
    let (a, b) = (2.0 / (9.0 * above), 2.0 / (9.0 * below));
    let root = ratio.cbrt();
    ((1.0 - b) * root - (1.0 - a)) / (b * root * root + a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twenty rows that fit but for a little, and what is added to one of them.
    fn rows(added: f64) -> (DMatrix<f64>, DVector<f64>) {
        let design = DMatrix::from_fn(20, 6, |i, j| {
            let (i, j) = (i as f64, j as f64);
            (0.7 * i + 1.3 * j + 0.2 * i * j).sin()
        });
        let mut left = DVector::from_fn(20, |i, _| 1e-5 * (2.1 * i as f64).cos());
        left[7] += added;
        (design, left)
    }

    #[test]
    fn the_part_that_the_others_contradict_is_found_with_its_size() {
        let parts: Vec<Vec<usize>> = (0..20).map(|row| vec![row]).collect();
        let (design, left) = rows(5e-3);
        let found = contradicted(&design, &left, &parts, None);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].part, 7);
        assert!((found[0].left[0] - 5e-3).abs() < 2e-4, "{found:?}");
        // noise alone, and what is small against the stated deviation
        let (design, left) = rows(0.0);
        assert!(contradicted(&design, &left, &parts, None).is_empty());
        let (design, left) = rows(5e-3);
        assert!(contradicted(&design, &left, &parts, Some(5e-3)).is_empty());
    }
}
