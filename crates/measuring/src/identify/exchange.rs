//! The exchange of configurations for better ones, by updates of a determinant.
//!
//! A pass over all candidates finds those that add most to the set; exchanges are then made
//! among these few alone, until none of them is worth one, and a pass over all of them follows.

mod lanes;

use super::imagined::Derivatives;
use super::random::Random;
use lanes::{Determinants, Grams, LANES, PORTION, Rows, Update, grouped, swap_lanes, triangle};
use nalgebra::DMatrix;
use pulp::Arch;
use rayon::prelude::*;

/// Exchanges of one start before it counts as done.
const EXCHANGES: usize = 400;
/// A factor of the determinant below which an exchange is not worth it.
const WORTH: f64 = 1.0 + 1e-5;
/// Candidates that tell most, among which exchanges are looked for.
pub(super) const SHORTLIST: usize = 64;

/// Chooses among configurations.
pub(super) struct Chooser<'a> {
    /// In the parameters' scales and standard deviations.
    derivatives: &'a Derivatives,
    /// The first of them are in every set.
    given: usize,
    rows: Rows,
    /// What the given configurations contribute.
    base: DMatrix<f64>,
    arch: Arch,
}

/// A set and the candidates that add most to it.
struct Shortlist {
    /// The set first.
    indices: Vec<usize>,
    rows: Rows,
    grams: Vec<f32>,
}

/// A set that no exchange improves.
pub(super) struct Improved {
    /// Logarithm of the determinant of its information.
    pub log_determinant: f64,
    /// Which candidates.
    pub set: Vec<usize>,
    /// How many exchanges led to it.
    pub exchanges: usize,
}

/// One configuration added to (`sign` 1) or taken from (−1) an inverse.
struct Change {
    /// `M⁻¹ Jᵀ`.
    direction: DMatrix<f64>,
    /// `∓(1 ± J M⁻¹ Jᵀ)⁻¹`.
    middle: DMatrix<f64>,
    /// By what it multiplies the determinant.
    factor: f64,
}

impl Change {
    fn apply(&self, inverse: &mut DMatrix<f64>) {
        let turned = &self.direction * &self.middle;
        inverse.gemm(1.0, &turned, &self.direction.transpose(), 1.0);
    }
}

impl<'a> Chooser<'a> {
    /// Of configurations, the first of which are `given`.
    pub(super) fn new(derivatives: &'a Derivatives, given: usize) -> Self {
        let candidates: Vec<usize> = (given..derivatives.count()).collect();
        let mut base = DMatrix::zeros(derivatives.width, derivatives.width);
        for i in 0..given {
            derivatives.add_information(i, &mut base);
        }
        Self {
            derivatives,
            given,
            rows: Rows::of(derivatives, &candidates),
            base,
            arch: Arch::new(),
        }
    }

    fn total(&self) -> usize {
        self.derivatives.count() - self.given
    }

    /// What the given configurations and these candidates tell.
    pub(super) fn information(&self, set: &[usize]) -> DMatrix<f64> {
        let mut m = self.base.clone();
        for i in set {
            self.derivatives.add_information(self.given + i, &mut m);
        }
        m
    }

    /// A random set.
    pub(super) fn draw(&self, count: usize, random: &mut Random) -> Vec<usize> {
        let mut used = vec![false; self.total()];
        let mut set = Vec::with_capacity(count);
        while set.len() < count {
            let i = random.below(self.total());
            if !used[i] {
                used[i] = true;
                set.push(i);
            }
        }
        set
    }

    /// `det(1 + G)` of every candidate.
    fn ratios(&self, upper: &DMatrix<f64>) -> Vec<f32> {
        let (height, width) = (self.rows.height, self.rows.width);
        let upper = grouped(upper, height);
        let mut ratios = vec![0.0_f32; self.total().div_ceil(LANES) * LANES];
        ratios
            .par_chunks_mut(PORTION * LANES)
            .zip(self.rows.cells.par_chunks(PORTION * self.rows.size()))
            .for_each(|(out, cells)| {
                let mut grams = vec![0.0; out.len() * triangle(height)];
                self.arch.dispatch(Grams {
                    height,
                    width,
                    cells,
                    upper: &upper,
                    out: &mut grams,
                });
                self.determinants(&grams, 1.0, out);
            });
        ratios
    }

    fn determinants(&self, grams: &[f32], sign: f32, out: &mut [f32]) {
        self.arch.dispatch(Determinants {
            height: self.rows.height,
            sign,
            grams,
            out,
        });
    }

    fn change(&self, inverse: &DMatrix<f64>, candidate: usize, sign: f64) -> Option<Change> {
        let columns = self.derivatives.columns(self.given + candidate);
        let direction = inverse * columns;
        let height = columns.ncols();
        let s = DMatrix::identity(height, height) + sign * columns.tr_mul(&direction);
        let factor = s.determinant();
        let middle = s.try_inverse()? * -sign;
        Some(Change {
            direction,
            middle,
            factor,
        })
    }

    /// Changes the blocks of a shortlist's candidates; fewer blocks than there are change those
    /// alone.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "what is chosen by it is checked in double precision"
    )]
    fn update(&self, rows: &Rows, change: &Change, grams: &mut [f32]) {
        let narrow = |m: &DMatrix<f64>| m.iter().map(|x| *x as f32).collect::<Vec<_>>();
        self.arch.dispatch(Update {
            rows,
            direction: &narrow(&change.direction),
            columns: change.direction.ncols(),
            middle: &narrow(&change.middle),
            grams,
        });
    }

    /// A set improved by exchanges until none of the candidates that add most to it is worth
    /// one.
    pub(super) fn improve(&self, mut set: Vec<usize>, tried: usize) -> Improved {
        let mut exchanges = 0;
        loop {
            let Some(factor) = self.information(&set).cholesky() else {
                return Improved {
                    log_determinant: f64::NEG_INFINITY,
                    set,
                    exchanges,
                };
            };
            let lower = factor.l();
            let log_determinant = 2.0 * lower.diagonal().map(f64::ln).sum();
            let unit = DMatrix::identity(lower.nrows(), lower.nrows());
            let upper = lower.solve_lower_triangular(&unit).map(|m| m.transpose());
            let mut made = 0;
            if let Some(upper) = upper.filter(|_| exchanges < EXCHANGES) {
                let ratios = self.ratios(&upper);
                let most = largest(&ratios[..self.total()], &set);
                made = self.exchange(&mut set, &most, &upper, tried);
            }
            if made == 0 {
                return Improved {
                    log_determinant,
                    set,
                    exchanges,
                };
            }
            exchanges += made;
        }
    }

    /// Exchanges members of a set for some candidates while one of the `tried` best of them is
    /// worth it; how many there were.
    fn exchange(
        &self,
        set: &mut [usize],
        candidates: &[usize],
        upper: &DMatrix<f64>,
        tried: usize,
    ) -> usize {
        let count = set.len();
        let indices: Vec<usize> = set.iter().chain(candidates).copied().collect();
        let of: Vec<usize> = indices.iter().map(|i| self.given + i).collect();
        let rows = Rows::of(self.derivatives, &of);
        let lanes = indices.len().div_ceil(LANES) * LANES;
        let size = triangle(rows.height) * LANES;
        let mut list = Shortlist {
            grams: vec![0.0; lanes / LANES * size],
            indices,
            rows,
        };
        self.arch.dispatch(Grams {
            height: list.rows.height,
            width: list.rows.width,
            cells: &list.rows.cells,
            upper: &grouped(upper, list.rows.height),
            out: &mut list.grams,
        });
        let mut inverse = upper * upper.transpose();
        let mut ratios = vec![0.0_f32; lanes];
        let members = count.div_ceil(LANES);
        let mut without = vec![0.0_f32; members * LANES];
        let mut made = 0;
        'exchanges: while made < EXCHANGES {
            self.determinants(&list.grams, 1.0, &mut ratios);
            let mut order: Vec<usize> = (count..list.indices.len()).collect();
            order.sort_unstable_by(|a, b| ratios[*b].total_cmp(&ratios[*a]).then(a.cmp(b)));
            for entering in order.into_iter().take(tried) {
                let Some(enter) = self.change(&inverse, list.indices[entering], 1.0) else {
                    continue;
                };
                // what the members would be missed by with this one among them
                let mut grams = list.grams[..members * size].to_vec();
                self.update(&list.rows, &enter, &mut grams);
                self.determinants(&grams, -1.0, &mut without);
                let leaving = (0..count).max_by(|a, b| without[*a].total_cmp(&without[*b]));
                let Some(leaving) =
                    leaving.filter(|at| f64::from(without[*at]) * enter.factor >= WORTH)
                else {
                    continue;
                };
                // the decision in double precision
                let mut next = inverse.clone();
                enter.apply(&mut next);
                let leave = self.change(&next, list.indices[leaving], -1.0);
                let Some(leave) = leave.filter(|c| c.factor * enter.factor >= WORTH) else {
                    continue;
                };
                leave.apply(&mut next);
                inverse = next;
                self.update(&list.rows, &enter, &mut list.grams);
                self.update(&list.rows, &leave, &mut list.grams);
                list.indices.swap(entering, leaving);
                list.rows.swap(entering, leaving);
                swap_lanes(
                    &mut list.grams,
                    triangle(list.rows.height),
                    entering,
                    leaving,
                );
                made += 1;
                continue 'exchanges;
            }
            break;
        }
        set.copy_from_slice(&list.indices[..count]);
        made
    }
}

/// The candidates with the largest ratios that are not in the set.
fn largest(ratios: &[f32], set: &[usize]) -> Vec<usize> {
    let mut used = vec![false; ratios.len()];
    for i in set {
        used[*i] = true;
    }
    let mut found: Vec<usize> = (0..ratios.len()).filter(|i| !used[*i]).collect();
    let order = |a: &usize, b: &usize| ratios[*b].total_cmp(&ratios[*a]).then(a.cmp(b));
    if found.len() > SHORTLIST {
        found.select_nth_unstable_by(SHORTLIST, order);
        found.truncate(SHORTLIST);
    }
    found
}
