//! What no effect of the registry is: functions of the posture, the load, the motion and the time that may explain what is
//! left. Where one of them does, or does it better than an effect that was named, the truth is not in the registry.

use super::beside::{Beside, Group, Kept};
use super::candidates::columns_of;
use super::chances::{chi_squared_tail, normal_tail};
use super::fit::{Fit, Gain};
use super::table::{Column, Layout, dot};
use crate::identify::problem::{Estimate, Problem};
use crate::model::JOINTS;
use crate::model::effects::{Effect, Kind, MOST_PARAMETERS, Site};
use rayon::prelude::*;

/// A function must be better than nothing by this beyond the logarithm of how many there are, in twice a log likelihood.
const MARGIN: f64 = 10.0;

/// What effects of the registry do already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Registered {
    /// At this joint.
    Of(usize),
    /// At every joint.
    OfAll,
}

/// A function of the rows.
#[derive(Clone, Debug)]
struct Feature {
    name: String,
    /// One value a row, mean square about one.
    values: Vec<f64>,
    /// Only for this joint; all where none.
    joint: Option<usize>,
    /// Moves the base and the tool as well.
    moves_frames: bool,
    /// An effect does this.
    registered: Option<Registered>,
}

/// The functions, and the motions that each may cause.
#[derive(Clone, Debug)]
pub struct Library {
    features: Vec<Feature>,
    /// A turn of each joint, then a motion of the base, then of the tool: name and columns.
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
}

impl Unknown {
    /// Its gain less what its parameters beyond those of an effect gain by chance.
    #[must_use]
    pub fn fair_gain(&self, parameters: usize) -> f64 {
        self.gain - 3.0 * (self.count as f64 - parameters as f64).max(0.0)
    }
}

/// Which functions are a joint's scale, coupling, harmonic, compliance or backlash.
fn registered(name: &str) -> Option<Registered> {
    let joint = |digits: &str| digits.parse::<usize>().ok().map(|n| Registered::Of(n - 1));
    let words: Vec<&str> = name.split(' ').collect();
    match words.as_slice() {
        [q] if q.ends_with("^1") && q.starts_with('q') => Some(Registered::OfAll),
        ["cos" | "sin", order, q] if q.starts_with('q') => {
            let is_whole = order.parse::<u32>().is_ok();
            is_whole.then(|| joint(&q[1..])).flatten()
        }
        ["torque", n] => joint(n),
        [d] | [d, "|torque", _] if d.starts_with("dir") => joint(&d[3..]),
        _ => None,
    }
}

fn features(problem: &Problem, estimate: &Estimate) -> Vec<Feature> {
    let rows = &problem.rows;
    let mut all: Vec<Feature> = Vec::new();
    let mut push = |name: String, joint: Option<usize>, moves_frames: bool, values: Vec<f64>| {
        let registered = registered(&name);
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let spread = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt();
        let size = (values.iter().map(|v| v * v).sum::<f64>() / count).sqrt();
        if spread > 1e-9 * size.max(1e-12) && size.is_finite() {
            let values = values.iter().map(|v| v / size).collect();
            all.push(Feature {
                name,
                values,
                joint,
                moves_frames,
                registered,
            });
        }
    };
    let mechanism = problem.mechanism();
    let angles: Vec<[f64; 6]> = rows.iter().map(|r| mechanism.commanded(&r.q)).collect();
    let models = problem.models(estimate, &[]);
    let torques: Vec<[f64; 6]> = rows
        .iter()
        .map(|r| models[r.rig].model().torques(&r.q, &r.conditions))
        .collect();
    let each = |of: &dyn Fn(usize) -> f64| (0..rows.len()).map(of).collect::<Vec<f64>>();
    for i in 0..JOINTS {
        let q = format!("q{}", i + 1);
        for power in 1..=4 {
            push(
                format!("{q}^{power}"),
                None,
                power < 3,
                each(&|r| angles[r][i].powi(power)),
            );
        }
        for order in 1..=4 {
            let n = f64::from(order);
            push(
                format!("cos {order} {q}"),
                None,
                order < 3,
                each(&|r| (n * angles[r][i]).cos()),
            );
            push(
                format!("sin {order} {q}"),
                None,
                order < 3,
                each(&|r| (n * angles[r][i]).sin()),
            );
        }
        for half in [0.5, 1.5, 2.5] {
            push(
                format!("cos {half} {q}"),
                Some(i),
                false,
                each(&|r| (half * angles[r][i]).cos()),
            );
            push(
                format!("sin {half} {q}"),
                Some(i),
                false,
                each(&|r| (half * angles[r][i]).sin()),
            );
        }
        let mut sorted: Vec<f64> = angles.iter().map(|a| a[i]).collect();
        sorted.sort_by(f64::total_cmp);
        for tenth in 1..10 {
            let at = sorted[sorted.len() * tenth / 10];
            push(
                format!("{q} beyond {:.0} deg", at.to_degrees()),
                Some(i),
                false,
                each(&|r| f64::from(u8::from(angles[r][i] > at))),
            );
            push(
                format!("{q} bent at {:.0} deg", at.to_degrees()),
                Some(i),
                false,
                each(&|r| (angles[r][i] - at).max(0.0)),
            );
        }
        for k in i + 1..JOINTS {
            let p = format!("q{}", k + 1);
            push(
                format!("{q} {p}"),
                None,
                false,
                each(&|r| angles[r][i] * angles[r][k]),
            );
            push(
                format!("cos ({q}+{p})"),
                None,
                false,
                each(&|r| (angles[r][i] + angles[r][k]).cos()),
            );
            push(
                format!("sin ({q}+{p})"),
                None,
                false,
                each(&|r| (angles[r][i] + angles[r][k]).sin()),
            );
            push(
                format!("cos ({q}-{p})"),
                None,
                false,
                each(&|r| (angles[r][i] - angles[r][k]).cos()),
            );
            push(
                format!("sin ({q}-{p})"),
                None,
                false,
                each(&|r| (angles[r][i] - angles[r][k]).sin()),
            );
        }
        let t = format!("torque {}", i + 1);
        push(t.clone(), None, true, each(&|r| torques[r][i]));
        push(
            format!("{t}^2"),
            None,
            true,
            each(&|r| torques[r][i].powi(2)),
        );
        push(
            format!("{t}^3"),
            None,
            false,
            each(&|r| torques[r][i].powi(3)),
        );
        push(
            format!("sign of {t}"),
            None,
            false,
            each(&|r| torques[r][i].signum()),
        );
        let d = format!("dir{}", i + 1);
        let direction = |r: usize| rows[r].conditions.direction;
        push(d.clone(), None, true, each(&|r| direction(r)[i]));
        push(
            format!("{d} |{t}|"),
            Some(i),
            false,
            each(&|r| direction(r)[i] * torques[r][i].abs()),
        );
        push(
            format!("{d} {t}"),
            Some(i),
            false,
            each(&|r| direction(r)[i] * torques[r][i]),
        );
        push(
            format!("{d} cos {q}"),
            Some(i),
            false,
            each(&|r| direction(r)[i] * angles[r][i].cos()),
        );
        push(
            format!("{d} sin {q}"),
            Some(i),
            false,
            each(&|r| direction(r)[i] * angles[r][i].sin()),
        );
        for k in i + 1..JOINTS {
            push(
                format!("{d} dir{}", k + 1),
                None,
                false,
                each(&|r| direction(r)[i] * direction(r)[k]),
            );
        }
    }
    let temperatures = each(&|r| rows[r].conditions.temperature_c.unwrap_or(0.0));
    let mean = temperatures.iter().sum::<f64>() / rows.len().max(1) as f64;
    push(
        "temperature".into(),
        None,
        true,
        temperatures.iter().map(|t| t - mean).collect(),
    );
    push(
        "temperature^2".into(),
        None,
        true,
        temperatures.iter().map(|t| (t - mean).powi(2)).collect(),
    );
    let last = (rows.len() as f64 - 1.0).max(1.0);
    let order = each(&|r| 2.0 * (r as f64) / last - 1.0);
    let times: Vec<f64> = rows.iter().filter_map(|r| r.conditions.time_s).collect();
    let mut clocks = vec![("row", order)];
    if times.len() == rows.len() {
        let (low, high) = times
            .iter()
            .fold((f64::MAX, f64::MIN), |(l, h), t| (l.min(*t), h.max(*t)));
        if high > low {
            clocks.push((
                "time",
                times
                    .iter()
                    .map(|t| 2.0 * (t - low) / (high - low) - 1.0)
                    .collect(),
            ));
        }
    }
    for (name, clock) in &clocks {
        for power in 1..=3 {
            push(
                format!("{name}^{power}"),
                None,
                true,
                clock.iter().map(|t| t.powi(power)).collect(),
            );
        }
        for half in 1..=12 {
            let n = f64::from(half) * std::f64::consts::FRAC_PI_2;
            push(
                format!("cos {half}/2 {name}"),
                None,
                true,
                clock.iter().map(|t| (n * (t + 1.0)).cos()).collect(),
            );
            push(
                format!("sin {half}/2 {name}"),
                None,
                true,
                clock.iter().map(|t| (n * (t + 1.0)).sin()).collect(),
            );
        }
    }
    all
}

/// A motion's columns multiplied with everything that they may be multiplied with, summed over the numbers of each row: a function
/// of the rows is then a factor of each sum.
struct Summed {
    /// For each column, products with the basis.
    along: Vec<Vec<Column>>,
    /// With what is left.
    left: Vec<Column>,
    /// With the effects.
    effects: Vec<Vec<Column>>,
    /// With each other.
    own: Vec<Vec<Column>>,
}

impl Summed {
    fn of(columns: &[Column], layout: &Layout, fit: &Fit, beside: &Beside) -> Self {
        let weighted =
            |c: &Column| -> Column { c.iter().zip(&fit.roots).map(|(c, w)| c * w).collect() };
        let columns: Vec<Column> = columns.iter().map(weighted).collect();
        let with = |column: &Column, other: &Column| -> Column {
            let rows = (0..layout.rows()).map(|row| layout.row(row));
            rows.map(|row| dot(&column[row.clone()], &other[row]))
                .collect()
        };
        let all = |others: &[Column]| -> Vec<Vec<Column>> {
            let each = |c: &Column| others.iter().map(|o| with(c, o)).collect();
            columns.iter().map(each).collect()
        };
        Self {
            along: all(&fit.basis),
            left: columns.iter().map(|c| with(c, &fit.left)).collect(),
            effects: all(beside.turned()),
            own: all(&columns),
        }
    }

    /// The columns times a function of the rows: their products, and those with the effects.
    fn times(&self, values: &[f64], shares: &[f64]) -> (Group, Vec<Vec<f64>>) {
        let with = |sums: &Vec<Column>| sums.iter().map(|s| dot(s, values)).collect::<Vec<f64>>();
        let squared: Column = values.iter().map(|v| v * v).collect();
        let along: Vec<Vec<f64>> = self.along.iter().map(with).collect();
        let projected = |i: usize, j: usize| {
            let parts = along[i].iter().zip(&along[j]).zip(shares);
            dot(&self.own[i][j], &squared) - parts.map(|((x, y), s)| x * y * s).sum::<f64>()
        };
        let columns = 0..along.len();
        let gram = columns
            .clone()
            .map(|i| columns.clone().map(|j| projected(i, j)).collect());
        let squares = columns.clone().map(|i| dot(&self.own[i][i], &squared));
        let group = Group::known(gram.collect(), with(&self.left), squares.collect());
        (group, self.effects.iter().map(with).collect())
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
        Self {
            features: features(problem, estimate),
            motions: names.zip(columns).collect(),
        }
    }

    fn pairs(&self) -> Vec<(usize, usize)> {
        let mut all = Vec::new();
        for (m, _) in self.motions.iter().enumerate() {
            for (f, feature) in self.features.iter().enumerate() {
                let fits = if m < JOINTS {
                    feature.joint.is_none_or(|j| j == m)
                        && feature.registered != Some(Registered::Of(m))
                        && feature.registered != Some(Registered::OfAll)
                } else {
                    feature.moves_frames
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

    /// The functions that gain most, best first, at most eight, for each choice of effects beside a fit.
    #[must_use]
    pub fn scan(
        &self,
        layout: &Layout,
        fit: &Fit,
        beside: &Beside,
        kept: &[Kept],
    ) -> Vec<Vec<Unknown>> {
        let pairs = self.pairs();
        let motions = self.motions.iter();
        let motions: Vec<Summed> = motions
            .map(|(_, columns)| Summed::of(columns, layout, fit, beside))
            .collect();
        let each: Vec<Vec<Option<Gain>>> = pairs
            .par_iter()
            .map(|(m, f)| {
                let (group, cross) = motions[*m].times(&self.features[*f].values, &fit.shares);
                let cross: Vec<&[f64]> = cross.iter().map(Vec::as_slice).collect();
                let free = vec![None; cross.len()];
                let gain = |kept: &Kept| beside.gain(&group, &cross, kept, &free);
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
                        self.motions[pairs[i].0].0, self.features[pairs[i].1].name
                    ),
                    gain: gain.gain,
                    count: gain.count,
                };
                all.into_iter().map(named).collect()
            })
            .collect()
    }
}

/// Whether neighbours in time or posture have like residuals: p-values of the mean product of neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Likeness {
    /// Rows one after another.
    pub in_order: f64,
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
    let tail = |pairs: &[(usize, usize)]| {
        let (mut sum, mut squares) = (0.0, 0.0);
        for (a, b) in pairs {
            let (x, y) = (part(*a), part(*b));
            if x.len() == y.len() {
                let product = dot(x, y);
                sum += product;
                squares += product * product;
            }
        }
        if squares > 0.0 {
            normal_tail(sum / squares.sqrt())
        } else {
            1.0
        }
    };
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
    Likeness {
        in_order: tail(&in_order),
        in_posture: tail(&once),
    }
}

/// Probability of a gain or more by chance, for one test.
#[must_use]
pub fn chance(gain: f64, count: usize) -> f64 {
    chi_squared_tail(gain, count as f64)
}
