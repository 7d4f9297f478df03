//! Where the disagreement lies: which columns and regions the residuals depend on.

use crate::diagnose::estimator::chances::chi_squared_tail;
use crate::diagnose::estimator::table::Layout;
use crate::identify::problem::{Estimate, PointRef, Problem};
use crate::identify::robust::limit;
use crate::model::JOINTS;

/// Groups that a column's values are sorted into.
const GROUPS: usize = 8;
/// Fewer rows in a group are none.
const LEAST_ROWS: usize = 3;
/// Corrected p-values below this are reported.
pub const SIGNIFICANT: f64 = 0.01;

/// A column or region that the residuals depend on.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// `q3_deg`, `torque 2`, `dir3`, `temperature_c`, `order`, `region x`, `point`.
    pub column: String,
    /// Which values have the largest mean residual: their range in the column's unit, or the name
    /// of a point.
    pub values: String,
    /// Root mean square of the groups' mean residuals, metres.
    pub size_m: f64,
    /// Largest group's mean residual, metres.
    pub largest_m: f64,
    /// Part of the squared residuals that the groups explain.
    pub part: f64,
    /// p-value after correction for all columns tested (Holm).
    pub p_value: f64,
}

struct Grouping {
    column: String,
    /// Group of each row and the words of each group.
    of_row: Vec<Option<usize>>,
    words: Vec<String>,
}

fn by_value(column: String, unit: f64, values: &[Option<f64>]) -> Option<Grouping> {
    let mut sorted: Vec<f64> = values.iter().flatten().copied().collect();
    if sorted.len() < 2 * LEAST_ROWS {
        return None;
    }
    sorted.sort_by(f64::total_cmp);
    let mut distinct = sorted.clone();
    distinct.dedup();
    if distinct.len() < 2 {
        return None;
    }
    let edges: Vec<f64> = if distinct.len() <= 3 {
        distinct[1..].to_vec()
    } else {
        let mut edges: Vec<f64> = (1..GROUPS)
            .map(|k| sorted[k * sorted.len() / GROUPS])
            .collect();
        edges.dedup();
        edges
    };
    let group = |v: f64| edges.iter().filter(|e| v >= **e).count();
    let mut lows = vec![f64::INFINITY; edges.len() + 1];
    let mut highs = vec![f64::NEG_INFINITY; edges.len() + 1];
    for v in values.iter().flatten() {
        let g = group(*v);
        lows[g] = lows[g].min(*v);
        highs[g] = highs[g].max(*v);
    }
    let words = lows.iter().zip(&highs).map(|(l, h)| {
        if l == h {
            format!("{:.4}", l / unit)
        } else {
            format!("{:.1} to {:.1}", l / unit, h / unit)
        }
    });
    Some(Grouping {
        words: words.collect(),
        of_row: values.iter().map(|v| v.map(group)).collect(),
        column,
    })
}

fn groupings(problem: &Problem, estimate: &Estimate) -> Vec<Grouping> {
    let rows = &problem.rows;
    let degree = std::f64::consts::PI / 180.0;
    let models = problem.models(estimate, &[]);
    let torques: Vec<[f64; 6]> = rows
        .iter()
        .map(|r| models[r.rig].torques(&r.q, &r.conditions))
        .collect();
    let mut all = Vec::new();
    for i in 0..JOINTS {
        all.extend(by_value(
            format!("q{}_deg", i + 1),
            degree,
            &rows.iter().map(|r| Some(r.q[i])).collect::<Vec<_>>(),
        ));
        let largest = torques.iter().fold(0.0, |m, t| f64::max(m, t[i].abs()));
        if largest > 1e-6 {
            all.extend(by_value(
                format!("torque {} in N m", i + 1),
                1.0,
                &torques.iter().map(|t| Some(t[i])).collect::<Vec<_>>(),
            ));
        }
        let directions: Vec<Option<f64>> = rows
            .iter()
            .map(|r| Some(r.conditions.direction[i]))
            .collect();
        all.extend(by_value(format!("dir{}", i + 1), 1.0, &directions));
        let moves: Vec<Option<f64>> = rows.iter().map(|r| Some(r.conditions.moved[i])).collect();
        all.extend(by_value(format!("move{}_deg", i + 1), degree, &moves));
    }
    all.extend(by_value(
        "temperature_c".into(),
        1.0,
        &rows
            .iter()
            .map(|r| r.conditions.temperature_c)
            .collect::<Vec<_>>(),
    ));
    let order: Vec<Option<f64>> = (0..rows.len()).map(|r| Some(r as f64 + 1.0)).collect();
    all.extend(by_value("row".into(), 1.0, &order));
    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let seen: Vec<Option<f64>> = rows
            .iter()
            .map(|r| r.observed.point_m().map(|p| p[k] * 1e3))
            .collect();
        all.extend(by_value(format!("{axis}_mm"), 1.0, &seen));
    }
    if problem.points.len() > 1 {
        all.push(Grouping {
            column: "point".into(),
            words: problem.points.iter().map(|p| p.name.clone()).collect(),
            of_row: rows
                .iter()
                .map(|r| match r.point {
                    PointRef::Named(i) => Some(i),
                    PointRef::Known(_) => None,
                })
                .collect(),
        });
    }
    if problem.tools.len() > 1 {
        all.push(Grouping {
            column: "tool".into(),
            words: problem.tools.iter().map(|t| t.name.clone()).collect(),
            of_row: rows.iter().map(|r| Some(r.tool)).collect(),
        });
    }
    all
}

/// Columns and regions on which residuals depend, strongest first. `residual` is in standard
/// deviations of the rows, `scale` their noise; rows far beyond it count as at the limit, but for
/// those that are off `together`.
#[must_use]
pub fn spots(
    problem: &Problem,
    layout: &Layout,
    estimate: &Estimate,
    used: &[bool],
    residual: &[f64],
    scale: f64,
    together: &[Vec<usize>],
) -> Vec<Spot> {
    let cut: Vec<f64> = {
        let mut lengths: Vec<f64> = (0..layout.rows())
            .map(|r| {
                residual[layout.row(r)]
                    .iter()
                    .map(|x| x * x)
                    .sum::<f64>()
                    .sqrt()
            })
            .collect();
        let own = lengths.clone();
        lengths.sort_by(f64::total_cmp);
        let typical = lengths[lengths.len() / 2].max(limit(3) * scale);
        own.iter()
            .enumerate()
            .map(|(row, l)| {
                let is_single = !together.iter().any(|rows| rows.contains(&row));
                if is_single && *l > 3.0 * typical {
                    3.0 * typical / l
                } else {
                    1.0
                }
            })
            .collect()
    };
    let mut found = Vec::new();
    for grouping in groupings(problem, estimate) {
        let groups = grouping.words.len();
        let mut sums = vec![[0.0; 6]; groups];
        let mut counts = vec![0.0_f64; groups];
        let mut squares = vec![0.0; groups];
        let (mut total, mut widest) = (0.0, 1);
        for row in (0..layout.rows()).filter(|r| used[*r]) {
            let range = layout.row(row);
            widest = widest.max(range.len());
            let Some(group) = grouping.of_row[row] else {
                continue;
            };
            counts[group] += 1.0;
            for (k, n) in range.enumerate() {
                let r = residual[n] * cut[row];
                sums[group][k] += r;
                squares[group] += r * r;
                total += r * r;
            }
        }
        let whole: [f64; 6] = std::array::from_fn(|k| sums.iter().map(|s| s[k]).sum());
        let count: f64 = counts.iter().sum();
        if count < 2.0 * LEAST_ROWS as f64 {
            continue;
        }
        let means = |g: usize| -> [f64; 6] {
            std::array::from_fn(|k| sums[g][k] / counts[g].max(1.0) - whole[k] / count)
        };
        let live: Vec<usize> = (0..groups)
            .filter(|g| counts[*g] >= LEAST_ROWS as f64)
            .collect();
        if live.len() < 2 {
            continue;
        }
        let between: f64 = live
            .iter()
            .map(|g| counts[*g] * means(*g).iter().map(|m| m * m).sum::<f64>())
            .sum();
        let freedom = (live.len() - 1) * widest;
        // against the residual within the groups, so that the test holds where the noise is not
        // known
        let within =
            (total - between).max(1e-12) / (count * widest as f64 - freedom as f64).max(1.0);
        let statistic = between / within.max(scale * scale * 0.25);
        let sigma_m = problem.rows[0].sigma_m;
        let position = |g: usize| means(g)[..widest.min(3)].iter().map(|m| m * m).sum::<f64>();
        let by_position = |a: &usize, b: &usize| position(*a).total_cmp(&position(*b));
        let Some(largest) = live.iter().copied().max_by(by_position) else {
            continue;
        };
        let mean_square = live.iter().map(|g| counts[*g] * position(*g)).sum::<f64>() / count;
        found.push(Spot {
            column: grouping.column,
            values: grouping.words[largest].clone(),
            size_m: mean_square.sqrt() * sigma_m,
            largest_m: position(largest).sqrt() * sigma_m,
            part: between / total.max(1e-12),
            p_value: chi_squared_tail(statistic, freedom as f64),
        });
    }
    found.sort_by(|a, b| {
        a.p_value
            .total_cmp(&b.p_value)
            .then(b.part.total_cmp(&a.part))
    });
    let tests = found.len();
    let mut most = 0.0_f64;
    for (rank, spot) in found.iter_mut().enumerate() {
        most = most.max((spot.p_value * (tests - rank) as f64).min(1.0));
        spot.p_value = most;
    }
    found.retain(|spot| spot.p_value < SIGNIFICANT);
    found
}
