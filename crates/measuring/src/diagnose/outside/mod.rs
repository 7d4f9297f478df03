//! What no effect of the registry is: functions of the posture, the load, the motion and the time
//! that may explain the residual. Where one of them does, or does it better than an effect that was
//! named, the truth is not in the registry.

mod functions;

use self::functions::{Facts, Function, Registered, facts, functions};
use crate::diagnose::estimator::chances::{chi_squared_tail, normal_tail};
use crate::diagnose::estimator::fit::Fit;
use crate::diagnose::estimator::gain::{Gain, Given, Group, Kept};
use crate::diagnose::estimator::table::{Column, Layout, dot};
use crate::diagnose::search::candidates::columns_of;
use crate::identify::problem::{Estimate, Problem};
use crate::model::JOINTS;
use crate::model::effects::{Effect, Kind, MOST_PARAMETERS, Site};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;

/// A function must be better than nothing by this beyond the logarithm of how many there are, in
/// twice a log likelihood.
const MARGIN: f64 = 10.0;

/// Rows whose products are in memory at a time.
const BLOCK: usize = 2048;

/// A function that differs from row to row.
#[derive(Clone, Copy, Debug)]
struct Feature {
    function: Function,
    /// The root of its mean square.
    size: f64,
}

impl Feature {
    /// `None` of one that is the same at all rows.
    fn of(function: Function, rows: &[Facts]) -> Option<Self> {
        let values: Vec<f64> = rows.iter().map(|row| function.at(row)).collect();
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let spread = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt();
        let size = (values.iter().map(|v| v * v).sum::<f64>() / count).sqrt();
        let differs = spread > 1e-9 * size.max(1e-12) && size.is_finite();
        differs.then_some(Self { function, size })
    }

    /// Its values, of mean square one over all rows.
    fn values(&self, rows: &[Facts]) -> Column {
        let values = rows.iter().map(|row| self.function.at(row) / self.size);
        values.collect()
    }
}

/// The functions, and the motions that each may cause.
#[derive(Clone, Debug)]
pub struct Library {
    rows: Vec<Facts>,
    features: Vec<Feature>,
    /// A rotation of each joint, then a motion of the base, then of the tool: name and columns.
    motions: Vec<(String, Vec<Column>)>,
}

/// A function that explains something.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown {
    /// What it does: `joint 3 by q3²`.
    pub name: String,
    /// Fall of chi-squared.
    pub gain: f64,
    /// Its parameters.
    pub count: usize,
    /// It runs with the session: of the row or the time.
    pub of_session: bool,
}

impl Unknown {
    /// Its gain less what its parameters beyond those of an effect gain by chance.
    #[must_use]
    pub fn fair_gain(&self, parameters: usize) -> f64 {
        self.gain - 3.0 * (self.count as f64 - parameters as f64).max(0.0)
    }
}

/// A motion's columns multiplied with everything that they may be multiplied with, summed over the
/// numbers of each row of a block: a function of the rows is then a factor of each sum.
struct Summed {
    /// For each column, products with those that are fitted.
    fitted: Vec<Vec<Column>>,
    /// With the residual.
    left: Vec<Column>,
    /// With the effects.
    effects: Vec<Vec<Column>>,
    /// With each other.
    own: Vec<Vec<Column>>,
}

fn slices(all: &[Column]) -> Vec<&[f64]> {
    all.iter().map(Vec::as_slice).collect()
}

impl Summed {
    fn of(
        columns: &[Column],
        (layout, rows): (&Layout, &Range<usize>),
        (fit, fitted): (&Fit, &[Column]),
        given: &Given,
    ) -> Self {
        let numbers = layout.row(rows.start).start..layout.row(rows.end - 1).end;
        let weighted = |c: &Column| -> Column {
            let both = c[numbers.clone()].iter().zip(&fit.roots[numbers.clone()]);
            both.map(|(c, w)| c * w).collect()
        };
        let columns: Vec<Column> = columns.iter().map(weighted).collect();
        // `other` has the numbers of all rows from the one that begins at `first`
        let with = |column: &Column, other: &[f64], first: usize| -> Column {
            let row = |row: usize| {
                let (start, end) = (layout.row(row).start, layout.row(row).end);
                let own = &column[start - numbers.start..end - numbers.start];
                dot(own, &other[start - first..end - first])
            };
            rows.clone().map(row).collect()
        };
        let all = |others: &[&[f64]], first: usize| -> Vec<Vec<Column>> {
            let each = |c: &Column| others.iter().map(|o| with(c, o, first)).collect();
            columns.iter().map(each).collect()
        };
        let own = fitted.iter().map(weighted);
        let own: Vec<Column> = own.collect();
        Self {
            fitted: all(&slices(&own), numbers.start),
            left: columns.iter().map(|c| with(c, &fit.left, 0)).collect(),
            effects: all(&slices(given.partial()), 0),
            own: all(&slices(&columns), numbers.start),
        }
    }
}

/// Products of a motion's columns times a function of the rows.
struct Products {
    fitted: Vec<Vec<f64>>,
    left: Vec<f64>,
    effects: Vec<Vec<f64>>,
    own: Vec<Vec<f64>>,
}

impl Products {
    /// None yet, of so many columns.
    fn none(columns: usize, fitted: usize, given: &Given) -> Self {
        let zeros = |count: usize| vec![vec![0.0; count]; columns];
        Self {
            fitted: zeros(fitted),
            left: vec![0.0; columns],
            effects: zeros(given.partial().len()),
            own: zeros(columns),
        }
    }

    /// Adds a block of rows.
    fn add(&mut self, summed: &Summed, values: &[f64]) {
        let add = |to: &mut [f64], sums: &[Column], values: &[f64]| {
            for (to, sum) in to.iter_mut().zip(sums) {
                *to += dot(sum, values);
            }
        };
        let add_all = |to: &mut [Vec<f64>], sums: &[Vec<Column>], values: &[f64]| {
            for (to, sums) in to.iter_mut().zip(sums) {
                add(to, sums, values);
            }
        };
        let squared: Column = values.iter().map(|v| v * v).collect();
        add_all(&mut self.fitted, &summed.fitted, values);
        add(&mut self.left, &summed.left, values);
        add_all(&mut self.effects, &summed.effects, values);
        add_all(&mut self.own, &summed.own, &squared);
    }

    /// The columns as a group given a fit.
    fn group(&self, fit: &Fit) -> Group {
        let taken: Vec<Vec<f64>> = self.fitted.iter().map(|x| fit.forward(x)).collect();
        Group::of(self.own.clone(), self.left.clone(), &taken)
    }
}

impl Library {
    /// The functions of these rows.
    #[must_use]
    pub fn of(problem: &Problem, estimate: &Estimate) -> Self {
        let effect = |kind, index| Effect {
            kind,
            site: Site {
                index,
                order: 1,
                ..Site::default()
            },
            parameters: [0.0; MOST_PARAMETERS],
        };
        let mut wanted: Vec<(Effect, Vec<usize>)> = (0..JOINTS)
            .map(|i| (effect(Kind::LinkGeometry, i), vec![3]))
            .collect();
        wanted.push((effect(Kind::FrameShift, 0), vec![0, 1, 2]));
        wanted.push((effect(Kind::ToolSlip, 0), vec![0, 1, 2]));
        let columns = columns_of(problem, estimate, &wanted);
        let names = (0..JOINTS)
            .map(|i| format!("joint {}", i + 1))
            .chain(["base".into(), "tool".into()]);
        let rows = facts(problem, estimate);
        let features = functions(problem, &rows).into_par_iter();
        let features = features.filter_map(|function| Feature::of(function, &rows));
        Self {
            features: features.collect(),
            rows,
            motions: names.zip(columns).collect(),
        }
    }

    fn pairs(&self) -> Vec<(usize, usize)> {
        let mut all = Vec::new();
        for (m, _) in self.motions.iter().enumerate() {
            for (f, feature) in self.features.iter().enumerate() {
                let function = &feature.function;
                let registered = function.registered();
                let fits = if m < JOINTS {
                    function.joint().is_none_or(|j| j == m)
                        && registered != Some(Registered::Of(m))
                        && registered != Some(Registered::OfAll)
                } else {
                    function.moves_frames()
                };
                if fits {
                    all.push((m, f));
                }
            }
        }
        all
    }

    /// How much better than its parameters' cost a function must be.
    #[must_use]
    pub fn cost(&self, count: usize) -> f64 {
        2.0 * (self.pairs().len() as f64).ln() + 3.0 * (count as f64 - 1.0) + MARGIN
    }

    /// The functions that gain most, best first, at most eight, for each choice of effects given a
    /// fit of these columns.
    #[must_use]
    pub fn scan(
        &self,
        layout: &Layout,
        (fit, fitted): (&Fit, &[Column]),
        given: &Given,
        kept: &[Kept],
    ) -> Vec<Vec<Unknown>> {
        let pairs = self.pairs();
        let count = |motion: usize| self.motions[motion].1.len();
        let mut products: Vec<Products> = (pairs.iter())
            .map(|(m, _)| Products::none(count(*m), fitted.len(), given))
            .collect();
        for start in (0..layout.rows()).step_by(BLOCK) {
            let rows = start..layout.rows().min(start + BLOCK);
            let summed = self.motions.par_iter();
            let summed =
                summed.map(|(_, own)| Summed::of(own, (layout, &rows), (fit, fitted), given));
            let summed: Vec<Summed> = summed.collect();
            let values = self.features.par_iter();
            let values = values.map(|feature| feature.values(&self.rows[rows.clone()]));
            let values: Vec<Column> = values.collect();
            let both = products.par_iter_mut().zip(&pairs);
            both.for_each(|(products, (m, f))| products.add(&summed[*m], &values[*f]));
        }
        let each: Vec<Vec<Option<Gain>>> = (products.par_iter())
            .map(|products| {
                let group = products.group(fit);
                let cross: Vec<&[f64]> = products.effects.iter().map(Vec::as_slice).collect();
                let free = vec![None; cross.len()];
                let gain = |kept: &Kept| given.gain(&group, &cross, kept, &free);
                kept.iter().map(gain).collect()
            })
            .collect();
        (0..kept.len())
            .map(|k| {
                let merit = |gain: &Gain| gain.gain - 3.0 * gain.count as f64;
                let mut all: Vec<(usize, &Gain)> = (each.iter().enumerate())
                    .filter_map(|(i, gains)| Some((i, gains[k].as_ref()?)))
                    .collect();
                all.sort_by(|(_, a), (_, b)| merit(b).total_cmp(&merit(a)));
                all.truncate(8);
                let named = |(i, gain): (usize, &Gain)| Unknown {
                    name: format!(
                        "{} by {}",
                        self.motions[pairs[i].0].0, self.features[pairs[i].1].function
                    ),
                    gain: gain.gain,
                    count: gain.count,
                    of_session: self.features[pairs[i].1].function.of_session(),
                };
                all.into_iter().map(named).collect()
            })
            .collect()
    }
}

/// Whether neighbours in time or posture have like residuals: p-values of the mean product of
/// neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Likeness {
    /// Rows one after another.
    pub in_order: f64,
    /// The same of opposite ones.
    pub opposite: f64,
    /// Rows of like posture.
    pub in_posture: f64,
}

/// Of what a fit leaves. Rows of one configuration are one.
#[must_use]
pub fn likeness(problem: &Problem, layout: &Layout, used: &[bool], fit: &Fit) -> Likeness {
    let rows: Vec<usize> = (0..layout.rows()).filter(|r| used[*r]).collect();
    let part = |row: usize| &fit.left[layout.row(row)];
    let place = |row: usize| {
        let q = problem.rows[row].q;
        q.map(f64::sin_cos)
    };
    let distance = |a: usize, b: usize| {
        let (x, y) = (place(a), place(b));
        (0..6)
            .map(|i| (x[i].0 - y[i].0).powi(2) + (x[i].1 - y[i].1).powi(2))
            .sum::<f64>()
    };
    // in standard deviations
    let mean = |products: &[f64]| {
        let sum: f64 = products.iter().sum();
        let squares: f64 = products.iter().map(|product| product * product).sum();
        (squares > 0.0).then(|| sum / squares.sqrt())
    };
    let product = |(a, b): &(usize, usize)| {
        let (x, y) = (part(*a), part(*b));
        (x.len() == y.len()).then(|| dot(x, y))
    };
    let tail = |product: Option<f64>| product.map_or(1.0, normal_tail);
    let same = |a: usize, b: usize| problem.rows[a].q == problem.rows[b].q;
    let in_order: Vec<_> = rows
        .windows(2)
        .map(|w| (w[0], w[1]))
        .filter(|(a, b)| !same(*a, *b))
        .collect();
    let limited: Vec<usize> = rows.iter().copied().take(1500).collect();
    let in_posture: Vec<(usize, usize)> = limited
        .par_iter()
        .filter_map(|a| {
            let others = limited.iter().copied().filter(|b| !same(*a, *b));
            let near = others.min_by(|x, y| distance(*a, *x).total_cmp(&distance(*a, *y)))?;
            Some((*a, near))
        })
        .collect();
    let mut once: Vec<(usize, usize)> = in_posture
        .iter()
        .map(|(a, b)| (*a.min(b), *a.max(b)))
        .collect();
    once.sort_unstable();
    once.dedup();
    let mut first: Vec<usize> = (0..layout.rows()).collect();
    for configuration in layout.configurations() {
        for row in configuration {
            first[*row] = configuration[0];
        }
    }
    // pairs of rows of the same two configurations are one
    let mut of_configurations: BTreeMap<(usize, usize), f64> = BTreeMap::new();
    for pair in &once {
        if let Some(product) = product(pair) {
            let (a, b) = (first[pair.0], first[pair.1]);
            *of_configurations.entry((a.min(b), a.max(b))).or_default() += product;
        }
    }
    let near: Vec<f64> = of_configurations.into_values().collect();
    let along: Vec<f64> = in_order.iter().filter_map(product).collect();
    let along = mean(&along);
    Likeness {
        in_order: tail(along),
        opposite: tail(along.map(|product| -product)),
        in_posture: tail(mean(&near)),
    }
}

/// Probability of a gain or more by chance, for one test.
#[must_use]
pub fn chance(gain: f64, count: usize) -> f64 {
    chi_squared_tail(gain, count as f64)
}
