//! The exchange of configurations for better ones, by updates of a determinant.

use super::random::Random;
use nalgebra::DMatrix;
use pulp::{Arch, Simd, WithSimd};

/// Exchanges of one start before it counts as done.
const EXCHANGES: usize = 400;
/// A factor of the determinant below which an exchange is not worth it.
const WORTH: f64 = 1.0 + 1e-9;

/// Candidates of a block: their numbers stand side by side.
const LANES: usize = 16;

/// Derivatives of all candidates in blocks of [`LANES`]: `[block][row][parameter][candidate of the block]`.
pub(super) struct Rows {
    pub height: usize,
    pub width: usize,
    cells: Vec<f32>,
}

impl Rows {
    /// Of one matrix a candidate, rows by parameters.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "what is chosen by it is checked in double precision"
    )]
    pub fn of(jacobians: &[DMatrix<f64>], width: usize) -> Self {
        let height = jacobians.first().map_or(0, DMatrix::nrows);
        let size = height * width * LANES;
        let mut cells = vec![0.0; size * jacobians.len().div_ceil(LANES)];
        for (candidate, jacobian) in jacobians.iter().enumerate() {
            let block = &mut cells[candidate / LANES * size..][..size];
            for r in 0..height {
                for c in 0..width {
                    block[(r * width + c) * LANES + candidate % LANES] = jacobian[(r, c)] as f32;
                }
            }
        }
        Self {
            height,
            width,
            cells,
        }
    }

    fn blocks(&self) -> std::slice::ChunksExact<'_, f32> {
        self.cells.chunks_exact(self.height * self.width * LANES)
    }
}

/// Numbers of the upper triangle of a candidate's block.
const fn triangle(height: usize) -> usize {
    height * (height + 1) / 2
}

/// Changes the block `G_c` of every candidate c by `(J_c U) · K · (J_c U)ᵀ`.
struct Update<'a> {
    rows: &'a Rows,
    /// `U` by columns.
    direction: &'a [f32],
    /// How many columns.
    columns: usize,
    /// `K`, symmetric.
    middle: &'a [f32],
    /// Upper triangles: `[block][number][candidate of the block]`.
    grams: &'a mut [f32],
}

impl WithSimd for Update<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match (self.rows.height, self.columns) {
            (3, 3) => self.fixed::<S, 3, 3>(simd),
            (6, 6) => self.fixed::<S, 6, 6>(simd),
            (3, 1) => self.fixed::<S, 3, 1>(simd),
            (6, 1) => self.fixed::<S, 6, 1>(simd),
            _ => self.any(),
        }
    }
}

impl Update<'_> {
    /// With the products of a block in registers.
    #[inline(always)]
    fn fixed<S: Simd, const H: usize, const C: usize>(self, simd: S) {
        let width = self.rows.width;
        let middle: [[S::f32s; C]; C] = std::array::from_fn(|s| {
            std::array::from_fn(|v| simd.splat_f32s(self.middle[s * C + v]))
        });
        let step = LANES / S::F32_LANES;
        let grams = self.grams.chunks_exact_mut(triangle(H) * LANES);
        for (cells, grams) in self.rows.blocks().zip(grams) {
            let (cells, _) = S::as_simd_f32s(cells);
            let (grams, _) = S::as_mut_simd_f32s(grams);
            for part in 0..step {
                let mut products = [[simd.splat_f32s(0.0); C]; H];
                for c in 0..width {
                    let u: [S::f32s; C] =
                        std::array::from_fn(|s| simd.splat_f32s(self.direction[s * width + c]));
                    for r in 0..H {
                        let j = cells[(r * width + c) * step + part];
                        for s in 0..C {
                            products[r][s] = simd.mul_add_e_f32s(j, u[s], products[r][s]);
                        }
                    }
                }
                let mut index = 0;
                for r in 0..H {
                    let mut turned = [simd.splat_f32s(0.0); C];
                    for s in 0..C {
                        for v in 0..C {
                            turned[v] =
                                simd.mul_add_e_f32s(products[r][s], middle[s][v], turned[v]);
                        }
                    }
                    for t in r..H {
                        let into = &mut grams[index * step + part];
                        for v in 0..C {
                            *into = simd.mul_add_e_f32s(turned[v], products[t][v], *into);
                        }
                        index += 1;
                    }
                }
            }
        }
    }

    /// Blocks of several points.
    #[inline(always)]
    fn any(self) {
        let (height, width, columns) = (self.rows.height, self.rows.width, self.columns);
        let mut products = vec![[0.0_f32; LANES]; height * columns];
        let mut turned = vec![[0.0_f32; LANES]; height * columns];
        let grams = self.grams.chunks_exact_mut(triangle(height) * LANES);
        for (cells, grams) in self.rows.blocks().zip(grams) {
            products.fill([0.0; LANES]);
            turned.fill([0.0; LANES]);
            for r in 0..height {
                for c in 0..width {
                    let j = &cells[(r * width + c) * LANES..][..LANES];
                    for s in 0..columns {
                        let u = self.direction[s * width + c];
                        for (into, j) in products[r * columns + s].iter_mut().zip(j) {
                            *into += u * j;
                        }
                    }
                }
                for s in 0..columns {
                    for v in 0..columns {
                        let k = self.middle[s * columns + v];
                        for l in 0..LANES {
                            turned[r * columns + v][l] += k * products[r * columns + s][l];
                        }
                    }
                }
            }
            let mut index = 0;
            for r in 0..height {
                for t in r..height {
                    let into = &mut grams[index * LANES..][..LANES];
                    for v in 0..columns {
                        let (a, b) = (&turned[r * columns + v], &products[t * columns + v]);
                        for l in 0..LANES {
                            into[l] += a[l] * b[l];
                        }
                    }
                    index += 1;
                }
            }
        }
    }
}

/// `det(1 + G_c)` of every candidate c, by elimination without exchanges of rows, which these matrices never need.
struct Determinants<'a> {
    height: usize,
    grams: &'a [f32],
    out: &'a mut [f32],
}

impl WithSimd for Determinants<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match self.height {
            3 => self.fixed::<S, 3>(simd),
            6 => self.fixed::<S, 6>(simd),
            _ => self.any(),
        }
    }
}

impl Determinants<'_> {
    #[inline(always)]
    fn fixed<S: Simd, const H: usize>(self, simd: S) {
        let step = LANES / S::F32_LANES;
        let one = simd.splat_f32s(1.0);
        let blocks = self.grams.chunks_exact(triangle(H) * LANES);
        for (grams, out) in blocks.zip(self.out.chunks_exact_mut(LANES)) {
            let (grams, _) = S::as_simd_f32s(grams);
            let (out, _) = S::as_mut_simd_f32s(out);
            for part in 0..step {
                let mut m = [[one; H]; H];
                let mut index = 0;
                for r in 0..H {
                    for t in r..H {
                        let cell = grams[index * step + part];
                        m[r][t] = if r == t {
                            simd.add_f32s(one, cell)
                        } else {
                            cell
                        };
                        index += 1;
                    }
                }
                let mut product = one;
                for k in 0..H {
                    product = simd.mul_f32s(product, m[k][k]);
                    let inverse = simd.div_f32s(one, m[k][k]);
                    for r in k + 1..H {
                        let factor = simd.neg_f32s(simd.mul_f32s(m[k][r], inverse));
                        for t in r..H {
                            m[r][t] = simd.mul_add_e_f32s(factor, m[k][t], m[r][t]);
                        }
                    }
                }
                out[part] = product;
            }
        }
    }

    #[inline(always)]
    fn any(self) {
        let height = self.height;
        let size = triangle(height);
        let mut m = vec![[0.0_f32; LANES]; size];
        // where row r of the upper triangle starts, less r
        let starts: Vec<usize> = (0..height).map(|r| r * height - r * (r + 1) / 2).collect();
        let blocks = self.grams.chunks_exact(size * LANES);
        for (grams, out) in blocks.zip(self.out.chunks_exact_mut(LANES)) {
            for (cell, gram) in m.iter_mut().zip(grams.chunks_exact(LANES)) {
                cell.copy_from_slice(gram);
            }
            for r in 0..height {
                for cell in &mut m[starts[r] + r] {
                    *cell += 1.0;
                }
            }
            out.fill(1.0);
            for k in 0..height {
                let pivot = m[starts[k] + k];
                for (out, pivot) in out.iter_mut().zip(pivot) {
                    *out *= pivot;
                }
                for r in k + 1..height {
                    let row = m[starts[k] + r];
                    let mut factor = [0.0_f32; LANES];
                    for l in 0..LANES {
                        factor[l] = row[l] / pivot[l];
                    }
                    for t in r..height {
                        let above = m[starts[k] + t];
                        let into = &mut m[starts[r] + t];
                        for l in 0..LANES {
                            into[l] -= factor[l] * above[l];
                        }
                    }
                }
            }
        }
    }
}

pub(super) struct Chooser<'a> {
    /// One matrix a candidate: rows by parameters, in scales and standard deviations.
    pub jacobians: &'a [DMatrix<f64>],
    pub rows: &'a Rows,
    /// What the given configurations contribute.
    pub base: &'a DMatrix<f64>,
    pub arch: Arch,
}

impl Chooser<'_> {
    pub fn information(&self, set: &[usize]) -> DMatrix<f64> {
        let mut m = self.base.clone();
        for i in set {
            m.gemm_tr(1.0, &self.jacobians[*i], &self.jacobians[*i], 1.0);
        }
        m
    }

    /// `log det` by Cholesky; minus infinity where it is singular.
    fn log_determinant(m: &DMatrix<f64>) -> f64 {
        m.clone().cholesky().map_or(f64::NEG_INFINITY, |f| {
            2.0 * f.l_dirty().diagonal().map(f64::ln).sum()
        })
    }

    #[allow(
        clippy::cast_possible_truncation,
        reason = "what is chosen by it is checked in double precision"
    )]
    fn update(&self, direction: &DMatrix<f64>, middle: &DMatrix<f64>, grams: &mut [f32]) {
        let narrow = |m: &DMatrix<f64>| m.iter().map(|x| *x as f32).collect::<Vec<_>>();
        self.arch.dispatch(Update {
            rows: self.rows,
            direction: &narrow(direction),
            columns: direction.ncols(),
            middle: &narrow(middle),
            grams,
        });
    }

    /// Adds or removes (`sign` −1) one candidate: inverse and blocks by rank-3 (or 6) updates.
    fn change(
        &self,
        inverse: &mut DMatrix<f64>,
        grams: &mut [f32],
        k: usize,
        sign: f64,
    ) -> Option<()> {
        let j = &self.jacobians[k];
        let direction = &*inverse * j.transpose();
        let height = j.nrows();
        let s = DMatrix::identity(height, height) + sign * (j * &direction);
        let middle = s.try_inverse()? * -sign;
        inverse.gemm(1.0, &(&direction * &middle), &direction.transpose(), 1.0);
        self.update(&direction, &middle, grams);
        Some(())
    }

    /// `det(1 − G)` of one candidate.
    fn ratio_without(&self, grams: &[f32], candidate: usize) -> f32 {
        let height = self.rows.height;
        let block = &grams[candidate / LANES * triangle(height) * LANES..];
        let at = |index: usize| -block[index * LANES + candidate % LANES];
        if height == 3 {
            let (a, d, f) = (1.0 + at(0), 1.0 + at(3), 1.0 + at(5));
            let (b, c, e) = (at(1), at(2), at(4));
            return a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d);
        }
        let mut m = DMatrix::<f32>::identity(height, height);
        let mut index = 0;
        for r in 0..height {
            for t in r..height {
                m[(r, t)] += at(index);
                if r != t {
                    m[(t, r)] += at(index);
                }
                index += 1;
            }
        }
        m.determinant()
    }

    /// The one of some candidates without which the determinant is largest.
    fn least_missed(
        &self,
        grams: &[f32],
        candidates: impl Iterator<Item = usize>,
    ) -> Option<usize> {
        candidates
            .map(|i| (self.ratio_without(grams, i), i))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, i)| i)
    }

    /// One start: a random set, improved until the candidate that tells most beside it is worth no exchange.
    pub fn run(&self, count: usize, random: &mut Random) -> (f64, Vec<usize>, usize) {
        let total = self.jacobians.len();
        let mut used = vec![false; total];
        let mut set = Vec::with_capacity(count);
        while set.len() < count {
            let i = random.below(total);
            if !used[i] {
                used[i] = true;
                set.push(i);
            }
        }
        self.improve(set, 1)
    }

    /// A set improved by exchanges until none of the `tried` candidates that tell most beside it is worth one: the logarithm
    /// of its determinant, the set, and how many exchanges.
    pub fn improve(&self, mut set: Vec<usize>, tried: usize) -> (f64, Vec<usize>, usize) {
        let total = self.jacobians.len();
        let mut used = vec![false; total];
        for i in &set {
            used[*i] = true;
        }
        let mut information = self.information(&set);
        let mut best = Self::log_determinant(&information);
        let mut exchanges = 0;
        let Some(factor) = information.clone().cholesky() else {
            return (best, set, 0);
        };
        let mut inverse = factor.inverse();
        let lanes = total.div_ceil(LANES) * LANES;
        let mut grams = vec![0.0_f32; lanes * triangle(self.rows.height)];
        // G of every candidate: the inverse's factor, one column at a time
        if let Some(factor) = inverse.clone().cholesky() {
            let one = DMatrix::identity(1, 1);
            for column in factor.l().column_iter() {
                self.update(
                    &DMatrix::from_column_slice(column.len(), 1, column.clone_owned().as_slice()),
                    &one,
                    &mut grams,
                );
            }
        }
        let mut ratios = vec![0.0_f32; lanes];
        while exchanges < EXCHANGES {
            self.arch.dispatch(Determinants {
                height: self.rows.height,
                grams: &grams,
                out: &mut ratios,
            });
            let mut made = None;
            for entering in largest(&ratios, &used, tried) {
                if self
                    .change(&mut inverse, &mut grams, entering, 1.0)
                    .is_none()
                {
                    break;
                }
                let inside = set.iter().copied().chain([entering]);
                let leaving = self.least_missed(&grams, inside).expect("one entered");
                // the decision in double precision
                let mut next = information.clone();
                let (new, old) = (&self.jacobians[entering], &self.jacobians[leaving]);
                next.gemm_tr(1.0, new, new, 1.0);
                next.gemm_tr(-1.0, old, old, 1.0);
                let now = Self::log_determinant(&next);
                let is_worth = leaving != entering && (now - best).exp() >= WORTH;
                let out = if is_worth { leaving } else { entering };
                if self.change(&mut inverse, &mut grams, out, -1.0).is_none() {
                    break;
                }
                if is_worth {
                    made = Some((entering, leaving, next, now));
                    break;
                }
            }
            let Some((entering, leaving, next, now)) = made else {
                break;
            };
            (used[leaving], used[entering]) = (false, true);
            set.retain(|i| *i != leaving);
            set.push(entering);
            information = next;
            best = now;
            exchanges += 1;
        }
        (best, set, exchanges)
    }
}

/// The candidates with the largest ratios that are not used, largest first.
fn largest(ratios: &[f32], used: &[bool], count: usize) -> Vec<usize> {
    let mut found: Vec<usize> = Vec::with_capacity(count + 1);
    for i in (0..used.len()).filter(|i| !used[*i]) {
        if found.len() < count || ratios[i] > ratios[found[count - 1]] {
            let at = found.partition_point(|other| ratios[*other] >= ratios[i]);
            found.insert(at, i);
            found.truncate(count);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn determinants_of_all_candidates_are_those_of_their_matrices() {
        let mut random = Random::new(9);
        for height in [3, 6, 9] {
            let size = triangle(height) * LANES;
            let all: Vec<DMatrix<f64>> = (0..2 * LANES)
                .map(|_| {
                    let j = DMatrix::from_fn(height, height, |_, _| random.between(-1.0, 1.0));
                    &j * j.transpose()
                })
                .collect();
            let mut grams = vec![0.0_f32; 2 * size];
            for (candidate, gram) in all.iter().enumerate() {
                let block = &mut grams[candidate / LANES * size..];
                let cells = (0..height).flat_map(|r| (r..height).map(move |t| (r, t)));
                for (index, (r, t)) in cells.enumerate() {
                    #[allow(clippy::cast_possible_truncation)]
                    let value = gram[(r, t)] as f32;
                    block[index * LANES + candidate % LANES] = value;
                }
            }
            let mut out = vec![0.0_f32; 2 * LANES];
            Arch::new().dispatch(Determinants {
                height,
                grams: &grams,
                out: &mut out,
            });
            for (gram, found) in all.iter().zip(out) {
                let exact = (DMatrix::identity(height, height) + gram).determinant();
                let gap = (f64::from(found) / exact - 1.0).abs();
                assert!(gap < 1e-4, "{height}: {found} and {exact}");
            }
        }
    }
}
