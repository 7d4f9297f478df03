//! Candidates side by side: what is reckoned of each of them, sixteen at a time.

use crate::identify::imagined::Derivatives;
use nalgebra::DMatrix;
use pulp::{Simd, WithSimd};
use rayon::prelude::*;

/// Candidates of a block: their numbers stand side by side.
pub(super) const LANES: usize = 16;
/// Blocks that one thread takes at a time.
pub(super) const PORTION: usize = 64;

/// Derivatives of candidates in blocks of [`LANES`]: `[block][row][parameter][candidate of the
/// block]`.
pub(super) struct Rows {
    pub(super) height: usize,
    pub(super) width: usize,
    pub(super) cells: Vec<f32>,
}

impl Rows {
    /// Of some configurations.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "what is chosen by it is checked in double precision"
    )]
    pub(super) fn of(derivatives: &Derivatives, some: &[usize]) -> Self {
        let (height, width) = (derivatives.height, derivatives.width);
        let size = height * width * LANES;
        let mut cells = vec![0.0; size * some.len().div_ceil(LANES)];
        let fill = |(block, some): (&mut [f32], &[usize])| {
            for (lane, i) in some.iter().enumerate() {
                for (at, value) in derivatives.of(*i).iter().enumerate() {
                    block[at * LANES + lane] = *value as f32;
                }
            }
        };
        if some.len() > PORTION * LANES {
            let blocks = cells.par_chunks_mut(size).with_min_len(PORTION);
            blocks.zip(some.par_chunks(LANES)).for_each(fill);
        } else {
            cells
                .chunks_mut(size)
                .zip(some.chunks(LANES))
                .for_each(fill);
        }
        Self {
            height,
            width,
            cells,
        }
    }

    /// Numbers of a block.
    pub(super) fn size(&self) -> usize {
        self.height * self.width * LANES
    }

    fn blocks(&self) -> std::slice::ChunksExact<'_, f32> {
        self.cells.chunks_exact(self.size())
    }

    /// Exchanges the places of two candidates.
    pub(super) fn swap(&mut self, a: usize, b: usize) {
        let numbers = self.height * self.width;
        swap_lanes(&mut self.cells, numbers, a, b);
    }
}

/// Exchanges two candidates' numbers in blocks of [`LANES`].
pub(super) fn swap_lanes(cells: &mut [f32], numbers: usize, a: usize, b: usize) {
    for k in 0..numbers {
        let at = |i: usize| (i / LANES * numbers + k) * LANES + i % LANES;
        cells.swap(at(a), at(b));
    }
}

/// Numbers of the upper triangle of a candidate's block.
pub(super) const fn triangle(height: usize) -> usize {
    height * (height + 1) / 2
}

/// Changes the block `G_c` of every candidate c by `(J_c U) · K · (J_c U)ᵀ`.
pub(super) struct Update<'a> {
    pub(super) rows: &'a Rows,
    /// `U` by columns.
    pub(super) direction: &'a [f32],
    /// How many columns.
    pub(super) columns: usize,
    /// `K`, symmetric.
    pub(super) middle: &'a [f32],
    /// Upper triangles: `[block][number][candidate of the block]`.
    pub(super) grams: &'a mut [f32],
}

impl WithSimd for Update<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match (self.rows.height, self.columns) {
            (3, 3) => self.fixed::<S, 3, 3>(simd),
            (6, 6) => self.fixed::<S, 6, 6>(simd),
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

/// The block `G_c = (J_c U) (J_c U)ᵀ` of every candidate c of some blocks, where `U Uᵀ` is the
/// inverse of the information.
pub(super) struct Grams<'a> {
    pub(super) height: usize,
    pub(super) width: usize,
    pub(super) cells: &'a [f32],
    /// The upper triangle `U`, `[group of columns][row][column of the group]`.
    pub(super) upper: &'a [f32],
    /// Upper triangles: `[block][number][candidate of the block]`.
    pub(super) out: &'a mut [f32],
}

/// Columns of `U` that are multiplied at once.
const fn group(height: usize) -> usize {
    match height {
        3 => 3,
        6 => 2,
        _ => 1,
    }
}

/// `U` in groups of columns.
#[allow(
    clippy::cast_possible_truncation,
    reason = "what is chosen by it is checked in double precision"
)]
pub(super) fn grouped(upper: &DMatrix<f64>, height: usize) -> Vec<f32> {
    let (width, group) = (upper.nrows(), group(height));
    let groups = 0..width.div_ceil(group);
    groups
        .flat_map(|g| (0..width).flat_map(move |c| (0..group).map(move |s| (c, g * group + s))))
        .map(|(c, s)| if s < width { upper[(c, s)] as f32 } else { 0.0 })
        .collect()
}

impl WithSimd for Grams<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match self.height {
            3 => self.fixed::<S, 3, { group(3) }>(simd),
            6 => self.fixed::<S, 6, { group(6) }>(simd),
            _ => self.any(),
        }
    }
}

impl Grams<'_> {
    #[inline(always)]
    fn fixed<S: Simd, const H: usize, const C: usize>(self, simd: S) {
        let width = self.width;
        let step = LANES / S::F32_LANES;
        let zero = simd.splat_f32s(0.0);
        let blocks = self.cells.chunks_exact(H * width * LANES);
        for (cells, out) in blocks.zip(self.out.chunks_exact_mut(triangle(H) * LANES)) {
            let (cells, _) = S::as_simd_f32s(cells);
            let (out, _) = S::as_mut_simd_f32s(out);
            for part in 0..step {
                let mut sums = [[zero; H]; H];
                for (g, upper) in self.upper.chunks_exact(width * C).enumerate() {
                    let mut products = [[zero; C]; H];
                    let rows = ((g + 1) * C).min(width);
                    for (c, upper) in upper.chunks_exact(C).enumerate().take(rows) {
                        let u: [S::f32s; C] = std::array::from_fn(|s| simd.splat_f32s(upper[s]));
                        for r in 0..H {
                            let j = cells[(r * width + c) * step + part];
                            for s in 0..C {
                                products[r][s] = simd.mul_add_e_f32s(j, u[s], products[r][s]);
                            }
                        }
                    }
                    for r in 0..H {
                        for t in r..H {
                            for s in 0..C {
                                sums[r][t] =
                                    simd.mul_add_e_f32s(products[r][s], products[t][s], sums[r][t]);
                            }
                        }
                    }
                }
                let mut index = 0;
                for r in 0..H {
                    for t in r..H {
                        out[index * step + part] = sums[r][t];
                        index += 1;
                    }
                }
            }
        }
    }

    /// Blocks of several points.
    #[inline(always)]
    fn any(self) {
        let (height, width) = (self.height, self.width);
        let mut products = vec![[0.0_f32; LANES]; height];
        self.out.fill(0.0);
        let blocks = self.cells.chunks_exact(height * width * LANES);
        for (cells, out) in blocks.zip(self.out.chunks_exact_mut(triangle(height) * LANES)) {
            for (s, upper) in self.upper.chunks_exact(width).enumerate() {
                products.fill([0.0; LANES]);
                for (r, product) in products.iter_mut().enumerate() {
                    for (c, u) in upper.iter().enumerate().take(s + 1) {
                        let j = &cells[(r * width + c) * LANES..][..LANES];
                        for (into, j) in product.iter_mut().zip(j) {
                            *into += u * j;
                        }
                    }
                }
                let pairs = (0..height).flat_map(|r| (r..height).map(move |t| (r, t)));
                for ((r, t), into) in pairs.zip(out.chunks_exact_mut(LANES)) {
                    for l in 0..LANES {
                        into[l] += products[r][l] * products[t][l];
                    }
                }
            }
        }
    }
}

/// `det(1 + G_c)` of every candidate c, or with a sign of −1 `det(1 − G_c)`, by elimination without
/// exchanges of rows, which these matrices never need.
pub(super) struct Determinants<'a> {
    pub(super) height: usize,
    pub(super) sign: f32,
    pub(super) grams: &'a [f32],
    pub(super) out: &'a mut [f32],
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
        let sign = simd.splat_f32s(self.sign);
        let blocks = self.grams.chunks_exact(triangle(H) * LANES);
        for (grams, out) in blocks.zip(self.out.chunks_exact_mut(LANES)) {
            let (grams, _) = S::as_simd_f32s(grams);
            let (out, _) = S::as_mut_simd_f32s(out);
            for part in 0..step {
                let mut m = [[one; H]; H];
                let mut index = 0;
                for r in 0..H {
                    for t in r..H {
                        let cell = simd.mul_f32s(sign, grams[index * step + part]);
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
                for l in 0..LANES {
                    cell[l] = self.sign * gram[l];
                }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::random::Random;
    use pulp::Arch;

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
                sign: 1.0,
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
