//! The exchange of configurations for better ones, by updates of a determinant.

use super::random::Random;
use nalgebra::DMatrix;
use pulp::Arch;

/// Exchanges of one start before it counts as done.
const EXCHANGES: usize = 400;
/// A factor of the determinant below which an exchange is not worth it.
const WORTH: f64 = 1.0 + 1e-9;

/// Derivatives of all candidates, one candidate a lane: `rows[row][parameter][candidate]`.
pub(super) struct Rows {
    pub lanes: usize,
    pub height: usize,
    pub width: usize,
    pub cells: Vec<f32>,
}

impl Rows {
    fn at(&self, row: usize, column: usize) -> &[f32] {
        let start = (row * self.width + column) * self.lanes;
        &self.cells[start..start + self.lanes]
    }
}

/// `J_c · U` for every candidate c, then the candidate's block `G_c` changed by it.
struct Update<'a> {
    rows: &'a Rows,
    /// `U = M⁻¹ Jₖᵀ`, one column a row of the block.
    direction: &'a DMatrix<f64>,
    /// `± S⁻¹`, symmetric.
    middle: &'a DMatrix<f64>,
    /// Upper triangles of all blocks, by lane.
    blocks: &'a mut [Vec<f32>],
    scratch: &'a mut [Vec<f32>],
}

impl pulp::NullaryFnOnce for Update<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(
        clippy::cast_possible_truncation,
        reason = "what is chosen by it is checked in double precision"
    )]
    fn call(self) {
        let (height, width, lanes) = (self.rows.height, self.rows.width, self.rows.lanes);
        // scratch[r * height + s] = Σ J[r][c] U[c][s]
        for r in 0..height {
            for s in 0..height {
                self.scratch[r * height + s].fill(0.0);
            }
            for c in 0..width {
                let j = self.rows.at(r, c);
                for s in 0..height {
                    let u = self.direction[(c, s)] as f32;
                    let into = &mut self.scratch[r * height + s][..lanes];
                    for (into, j) in into.iter_mut().zip(j) {
                        *into += u * j;
                    }
                }
            }
        }
        let mut index = 0;
        for r in 0..height {
            for t in r..height {
                for s in 0..height {
                    for v in 0..height {
                        let k = self.middle[(s, v)] as f32;
                        let (a, b) = (&self.scratch[r * height + s], &self.scratch[t * height + v]);
                        let into = &mut self.blocks[index][..lanes];
                        for ((into, a), b) in into.iter_mut().zip(a).zip(b) {
                            *into += k * a * b;
                        }
                    }
                }
                index += 1;
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

    /// Adds or removes (`sign` −1) one candidate: inverse and blocks by rank-3 (or 6) updates.
    fn change(
        &self,
        inverse: &mut DMatrix<f64>,
        blocks: &mut [Vec<f32>],
        scratch: &mut [Vec<f32>],
        k: usize,
        sign: f64,
    ) -> Option<f64> {
        let j = &self.jacobians[k];
        let direction = &*inverse * j.transpose();
        let height = j.nrows();
        let s = DMatrix::identity(height, height) + sign * (j * &direction);
        let determinant = s.determinant();
        let middle = s.try_inverse()? * -sign;
        inverse.gemm(1.0, &(&direction * &middle), &direction.transpose(), 1.0);
        Arch::new().dispatch(Update {
            rows: self.rows,
            direction: &direction,
            middle: &middle,
            blocks,
            scratch,
        });
        Some(determinant)
    }

    /// `det(1 + sign · G)` of each candidate.
    fn ratios(&self, blocks: &[Vec<f32>], sign: f32) -> Vec<f32> {
        let (height, lanes) = (self.rows.height, self.rows.lanes);
        if height == 3 {
            let [a, b, c, d, e, f] = std::array::from_fn(|i| &blocks[i][..lanes]);
            return (0..lanes)
                .map(|i| {
                    let (a, d, f) = (1.0 + sign * a[i], 1.0 + sign * d[i], 1.0 + sign * f[i]);
                    let (b, c, e) = (sign * b[i], sign * c[i], sign * e[i]);
                    a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d)
                })
                .collect();
        }
        (0..lanes)
            .map(|lane| {
                let mut m = DMatrix::<f32>::identity(height, height);
                let mut index = 0;
                for r in 0..height {
                    for t in r..height {
                        let value = sign * blocks[index][lane];
                        m[(r, t)] += value;
                        if r != t {
                            m[(t, r)] += value;
                        }
                        index += 1;
                    }
                }
                m.determinant()
            })
            .collect()
    }

    /// One start: a random set, improved by exchanges until none raises the determinant.
    pub fn run(&self, count: usize, random: &mut Random) -> (f64, Vec<usize>, usize) {
        let total = self.jacobians.len();
        let height = self.rows.height;
        let mut used = vec![false; total];
        let mut set = Vec::with_capacity(count);
        while set.len() < count {
            let i = random.below(total);
            if !used[i] {
                used[i] = true;
                set.push(i);
            }
        }
        let mut best = Self::log_determinant(&self.information(&set));
        let mut exchanges = 0;
        let Some(mut inverse) = self.information(&set).try_inverse() else {
            return (best, set, 0);
        };
        let mut blocks = vec![vec![0.0_f32; self.rows.lanes]; height * (height + 1) / 2];
        let mut scratch = vec![vec![0.0_f32; self.rows.lanes]; height * height];
        // G of every candidate: one column of the inverse's factor at a time
        if let Some(factor) = inverse.clone().cholesky() {
            let l = factor.l();
            for column in 0..l.ncols() {
                let direction = l.column(column);
                for (r, line) in scratch.iter_mut().take(height).enumerate() {
                    line.fill(0.0);
                    for c in 0..self.rows.width {
                        #[allow(
                            clippy::cast_possible_truncation,
                            reason = "checked in double precision"
                        )]
                        let u = direction[c] as f32;
                        for (into, j) in line.iter_mut().zip(self.rows.at(r, c)) {
                            *into += u * j;
                        }
                    }
                }
                let mut index = 0;
                for r in 0..height {
                    for t in r..height {
                        for lane in 0..self.rows.lanes {
                            blocks[index][lane] += scratch[r][lane] * scratch[t][lane];
                        }
                        index += 1;
                    }
                }
            }
        }
        while exchanges < EXCHANGES {
            let add = self.ratios(&blocks, 1.0);
            let entering = (0..total)
                .filter(|i| !used[*i])
                .max_by(|a, b| add[*a].total_cmp(&add[*b]));
            let Some(entering) = entering else { break };
            if self
                .change(&mut inverse, &mut blocks, &mut scratch, entering, 1.0)
                .is_none()
            {
                break;
            }
            let lose = self.ratios(&blocks, -1.0);
            let inside = set.iter().copied().chain([entering]);
            let leaving = inside
                .max_by(|a, b| lose[*a].total_cmp(&lose[*b]))
                .expect("one entered");
            if leaving == entering {
                break;
            }
            if self
                .change(&mut inverse, &mut blocks, &mut scratch, leaving, -1.0)
                .is_none()
            {
                break;
            }
            let mut next = set.clone();
            next.retain(|i| *i != leaving);
            next.push(entering);
            // the decision in double precision
            let now = Self::log_determinant(&self.information(&next));
            if now.is_finite() && (now - best).exp() < WORTH {
                break;
            }
            (used[leaving], used[entering]) = (false, true);
            set = next;
            best = now;
            exchanges += 1;
        }
        (best, set, exchanges)
    }
}
