//! The noise that poses measured more than once show: pure error, whatever the model; and that of
//! orientations where no column states it.
//!
//! # Source
//! J. von Neumann, R. H. Kent, H. R. Bellinson, B. I. Hart, "The mean square successive difference"
//! (1941): what changes slowly cancels from one repetition to the next. N. R. Draper, H. Smith,
//! "Applied Regression Analysis", on pure error and lack of fit. W. Förstner, "Ein Verfahren zur
//! Schätzung von Varianz- und Kovarianzkomponenten" (1979), for components of variance: the squares
//! of each sort of numbers over their redundancy, until the weights rest.

use crate::diagnose::estimator::chances::{chi_squared_quantile, f_tail};
use crate::diagnose::estimator::fit::{Fit, Normal};
use crate::diagnose::estimator::table::{Column, Layout, table};
use crate::identify::measurements::{Measurements, Observed};
use crate::identify::orientations::is_unsure;
use crate::identify::problem::{Estimate, PointRef, Problem, Row};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

/// Repeated poses tell the noise from so many degrees of freedom on.
const FEWEST: f64 = 10.0;
/// Repetitions are near one another within this part of the session.
const NEAR_PART: f64 = 0.1;
/// And within so many degrees, °C.
const NEAR_C: f64 = 0.5;
/// The noise is at least the estimate's lower bound, which it stays above with this probability.
const SURE: f64 = 0.99;
/// Rounds of weights of orientations, and the change at which they rest.
const TURNS: usize = 8;
const AT_REST: f64 = 0.01;
/// Orientations that are so many times surer or less sure than places are weighed anew.
const OTHER: f64 = 1.2;
/// Numbers of a pose that are its place; the others are its orientation.
const OF_PLACE: usize = 3;

/// Noise of a measured number by repetitions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeats {
    /// In standard deviations of the rows.
    pub scale: f64,
    /// Degrees of freedom it is known from.
    pub freedom: f64,
}

impl Repeats {
    /// The noise is hardly less, in standard deviations of the rows.
    #[must_use]
    pub fn least(&self) -> f64 {
        self.scale * (self.freedom / chi_squared_quantile(SURE, self.freedom)).sqrt()
    }

    /// Probability that normal residuals of this noise, with so many degrees of freedom, come out
    /// as large as `scale`.
    #[must_use]
    pub fn chance_of(&self, scale: f64, freedom: f64) -> f64 {
        f_tail((scale / self.scale).powi(2), freedom, self.freedom)
    }
}

/// Bits of numbers that are equal: minus zero is zero.
fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|x| (x + 0.0).to_bits()).collect()
}

/// Rows of the same angles, arrived at from the same side under the same force, of the same point
/// on the same tool seen from the same place. An unknown direction is one of its own. Where
/// something was touched the angles are the reading: no two agree.
fn groups(problem: &Problem, used: &[bool]) -> Vec<Vec<usize>> {
    let mut groups: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for (i, row) in problem.rows.iter().enumerate().filter(|(i, _)| used[*i]) {
        let point = match row.point {
            PointRef::Named(index) => (Some(index), Vec::new()),
            PointRef::Known(place) => (None, bits(&place)),
        };
        let seen = match row.observed {
            Observed::Position(_) | Observed::Pose(_) => Vec::new(),
            Observed::Distance { from_m, .. } => bits(&from_m),
            Observed::Contact(_) => continue,
        };
        let conditions = &row.conditions;
        let key = (
            bits(&row.q),
            row.stand.bits(),
            bits(&conditions.direction),
            bits(&conditions.force_n),
            (row.tool, point, row.observed.count(), seen),
        );
        groups.entry(key).or_default().push(i);
    }
    groups.into_values().filter(|rows| rows.len() > 1).collect()
}

/// When rows were measured, in parts of the session: by the clock, else by their order.
fn moments(rows: &[Row]) -> Vec<f64> {
    let clock: Vec<f64> = rows.iter().filter_map(|r| r.conditions.time_s).collect();
    let times = if clock.len() == rows.len() {
        clock
    } else {
        (0..rows.len()).map(|r| r as f64).collect()
    };
    let first = times.iter().copied().fold(f64::INFINITY, f64::min);
    let last = times.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let length = (last - first).max(f64::MIN_POSITIVE);
    times.iter().map(|t| (t - first) / length).collect()
}

/// How many independent differences tell as much as these successive ones: by the variance of their
/// mean square, n normal numbers.
fn independent_of(differences: usize) -> f64 {
    let n = differences as f64 + 1.0;
    if differences == 0 {
        0.0
    } else {
        2.0 * (n - 1.0).powi(2) / (3.0 * n - 4.0)
    }
}

/// The noise of repeated poses on the rows in use, where there are enough; `residual` in standard
/// deviations of the rows.
///
/// Differences of successive repetitions count, so that drift hardly does; a reading that is wrong
/// counts as one at the limit of what is normal. Where there are enough repetitions near one
/// another in time and temperature, those far apart are left out: they differ by what the model
/// does not know of either. Readings that agree in every digit are copies, and say nothing.
#[must_use]
pub fn of_repeats(
    problem: &Problem,
    layout: &Layout,
    residual: &[f64],
    used: &[bool],
) -> Option<Repeats> {
    let groups = groups(problem, used);
    let moments = moments(&problem.rows);
    let is_copy = |a: usize, b: usize| problem.rows[a].observed == problem.rows[b].observed;
    let is_near = |a: usize, b: usize| {
        let temperature = |row: usize| problem.rows[row].conditions.temperature_c;
        let both = temperature(a).zip(temperature(b));
        (moments[a] - moments[b]).abs() <= NEAR_PART
            && both.is_none_or(|(a, b)| (a - b).abs() <= NEAR_C)
    };
    let of = |wanted: &dyn Fn(usize, usize) -> bool| {
        let (mut counts, mut differences, mut independent) = (Vec::new(), Column::new(), 0.0);
        for rows in &groups {
            let before = counts.len();
            for pair in rows.windows(2) {
                let (a, b) = (pair[0], pair[1]);
                if is_copy(a, b) || !wanted(a, b) {
                    continue;
                }
                let numbers = layout.row(a).zip(layout.row(b));
                let of_one = |(i, j)| (residual[i] - residual[j]) * FRAC_1_SQRT_2;
                differences.extend(numbers.map(of_one));
                counts.push(layout.row(a).len());
            }
            independent += independent_of(counts.len() - before);
        }
        let all = vec![true; counts.len()];
        let part = independent / counts.len().max(1) as f64;
        let layout = Layout::of_counts(counts);
        let fit = Normal::of((&layout, &all), &differences, (&[], &[]), 0.0).fit(&[]);
        let repeats = Repeats {
            scale: fit.scale,
            freedom: part * fit.freedom,
        };
        (repeats.freedom >= FEWEST).then_some(repeats)
    };
    of(&is_near).or_else(|| of(&|_, _| true))
}

/// Poses of whose orientations no column says how sure they are.
pub(crate) struct Orientations {
    rows: Vec<usize>,
}

impl Orientations {
    pub(crate) fn of(problem: &Problem, measurements: &Measurements, used: &[bool]) -> Self {
        let rows = problem.rows.iter().enumerate();
        let unsure = rows.filter(|(number, row)| used[*number] && is_unsure(row, measurements));
        Self {
            rows: unsure.map(|(number, _)| number).collect(),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Mean squares of places and of orientations that a fit leaves; `None` of too few numbers.
    fn mean_squares(&self, layout: &Layout, fit: &Fit, columns: &[Column]) -> Option<[f64; 2]> {
        let mut sums = [(0.0, 0.0); 2];
        for row in &self.rows {
            for (k, number) in layout.row(*row).enumerate() {
                let (squares, redundancy) = &mut sums[usize::from(k >= OF_PLACE)];
                *squares += fit.left[number].powi(2);
                *redundancy += fit.roots[number].powi(2) - fit.leverage_of(number, columns);
            }
        }
        let is_enough = sums.iter().all(|(_, redundancy)| *redundancy >= FEWEST);
        is_enough.then(|| sums.map(|(squares, redundancy)| squares / redundancy))
    }

    /// So many times the standard deviation that they have makes them as sure as the places of the
    /// same poses, by what a fit with the effects found leaves of both; `None` where they are.
    pub(crate) fn against_places(
        &self,
        layout: &Layout,
        (fit, columns): (&Fit, &[Column]),
    ) -> Option<f64> {
        let [places, orientations] = self.mean_squares(layout, fit, columns)?;
        let times = (orientations / places).sqrt();
        let is_other = times.is_finite() && times > 0.0 && times.ln().abs() > OTHER.ln();
        is_other.then_some(times)
    }

    /// Gives them so many times the standard deviation they have.
    pub(crate) fn scale(&self, problem: &mut Problem, times: f64) {
        let rows = Arc::make_mut(&mut problem.rows);
        for row in &self.rows {
            rows[*row].sigma_rad *= times;
        }
    }

    /// Weighs them by what a fit of the parameters with these shares leaves of them; how many times
    /// the standard deviation that was. Where a column states the noise of places, what is left
    /// of these beyond it is an effect and no noise, and orientations may have none of it.
    pub(crate) fn weigh(
        &self,
        problem: &mut Problem,
        (layout, used): (&Layout, &[bool]),
        (estimate, shares): (&Estimate, &[f64]),
    ) -> f64 {
        let mut product = 1.0;
        for _ in 0..TURNS {
            if self.is_empty() {
                break;
            }
            let (residual, columns) = table(problem, estimate, &problem.parameters);
            let fit = Normal::of((layout, used), &residual, (&columns, shares), 0.0).fit(&[]);
            let Some([places, orientations]) = self.mean_squares(layout, &fit, &columns) else {
                break;
            };
            let noise = if problem.sigma_assumed { places } else { 1.0 };
            let times = (orientations / noise).sqrt();
            if !(times.is_finite() && times > 0.0) {
                break;
            }
            self.scale(problem, times);
            product *= times;
            if (times - 1.0).abs() < AT_REST {
                break;
            }
        }
        product
    }
}
