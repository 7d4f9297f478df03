//! Accuracy and repeatability of poses and distances that were measured several times.
//!
//! # Source
//! ISO 9283:1998, pose accuracy and repeatability (7.2), multi-directional pose accuracy variation
//! (7.2.3), distance accuracy and repeatability (7.3).

use super::line::Line;
use super::measurements::Measurements;
use super::statistics::{Miss, Spread};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Vector, add, norm, scale, sub};
use std::collections::BTreeMap;

/// Fewest measurements of one configuration.
const FEWEST: usize = 3;

/// Pose accuracy and repeatability of one configuration measured several times.
#[derive(Clone, Debug, PartialEq)]
pub struct Repeated {
    /// Its first row.
    pub line: Line,
    /// How often it was measured.
    pub count: usize,
    /// Distance of the mean of what was attained from what the real model expects, mm.
    pub accuracy_mm: f64,
    /// AP: its distance from what the controller believes, the commanded pose, mm.
    pub commanded_accuracy_mm: f64,
    /// RP: mean plus three standard deviations of the distances from their mean, mm.
    pub repeatability_mm: f64,
    /// vAP: largest distance between the means of different approach directions, mm; `None` from
    /// one direction only. Rows of unknown direction are left out.
    pub variation_mm: Option<f64>,
}

/// Distance accuracy and repeatability between two configurations measured several times.
#[derive(Clone, Debug, PartialEq)]
pub struct RepeatedDistance {
    /// Their first rows.
    pub lines: [Line; 2],
    /// How many pairs, in the order in which they were measured.
    pub count: usize,
    /// Mean distance, mm.
    pub distance_mm: f64,
    /// How far it is from the distance that the real model expects, mm.
    pub accuracy_mm: f64,
    /// AD: how far it is from the distance of the commanded poses, mm.
    pub commanded_accuracy_mm: f64,
    /// RD: three standard deviations of the distances, mm.
    pub repeatability_mm: f64,
}

fn mean(of: &[Vector]) -> Vector {
    let sum = of.iter().fold([0.0; 3], |sum, p| add(sum, *p));
    scale(1.0 / of.len().max(1) as f64, sum)
}

fn bits(of: &[f64]) -> impl Iterator<Item = u64> {
    of.iter().map(|x| x.to_bits())
}

/// Rows of one configuration and point that was measured several times, in the order of their first
/// ones.
pub(super) fn groups(measurements: &Measurements) -> Vec<Vec<usize>> {
    let rows = &measurements.rows;
    let compared = |a: &usize, b: &usize| {
        let [a, b] = [a, b].map(|row| &rows[*row]);
        bits(&a.q)
            .cmp(bits(&b.q))
            .then_with(|| bits(&a.stand.values).cmp(bits(&b.stand.values)))
            .then_with(|| a.point.cmp(&b.point))
    };
    let mut order: Vec<usize> = (0..rows.len())
        .filter(|row| rows[*row].observed.point_m().is_some())
        .collect();
    order.sort_by(compared);
    let mut found: Vec<Vec<usize>> = order
        .chunk_by(|a, b| compared(a, b).is_eq())
        .filter(|rows| rows.len() >= FEWEST)
        .map(<[usize]>::to_vec)
        .collect();
    found.sort_by_key(|rows| rows[0]);
    found
}

/// The directions that the joints of some rows arrived in, one word a row; `None` of a row that
/// does not tell them. A joint that no row tells of does not matter.
fn directions_of(measurements: &Measurements, rows: &[usize]) -> Vec<Option<Vec<bool>>> {
    let direction = |row: &usize| measurements.rows[*row].conditions.direction;
    let given: Vec<usize> = (0..6)
        .filter(|k| rows.iter().any(|row| direction(row)[*k] != 0.0))
        .collect();
    rows.iter()
        .map(|row| {
            let direction = direction(row);
            let known = !given.is_empty() && given.iter().all(|k| direction[*k] != 0.0);
            known.then(|| given.iter().map(|k| direction[*k] > 0.0).collect())
        })
        .collect()
}

/// Poses measured at least three times, as [`groups`] has them; `misses` of the real and of the
/// controller's model.
pub(super) fn repeated(
    measurements: &Measurements,
    groups: &[Vec<usize>],
    misses: [&[Miss]; 2],
) -> Vec<Repeated> {
    let gap = |misses: &[Miss], row: usize| {
        let [x, y, z, ..] = misses[row].gap;
        [x, y, z].map(mm_from_m)
    };
    groups
        .iter()
        .map(|rows| {
            let [gaps, commanded] =
                misses.map(|m| rows.iter().map(|row| gap(m, *row)).collect::<Vec<_>>());
            let middle = mean(&gaps);
            let about: Vec<f64> = gaps.iter().map(|g| norm(sub(*g, middle))).collect();
            let spread = Spread::of(&about).expect("at least three rows");
            let mut directions: BTreeMap<Vec<bool>, Vec<Vector>> = BTreeMap::new();
            for (direction, gap) in directions_of(measurements, rows).into_iter().zip(&gaps) {
                if let Some(direction) = direction {
                    directions.entry(direction).or_default().push(*gap);
                }
            }
            let means: Vec<Vector> = directions.values().map(|g| mean(g)).collect();
            let apart = means
                .iter()
                .flat_map(|a| means.iter().map(move |b| norm(sub(*a, *b))));
            Repeated {
                line: measurements.rows[rows[0]].line.clone(),
                count: rows.len(),
                accuracy_mm: norm(middle),
                commanded_accuracy_mm: norm(mean(&commanded)),
                repeatability_mm: spread.mean_plus_3std(),
                variation_mm: (means.len() > 1).then(|| apart.fold(0.0, f64::max)),
            }
        })
        .collect()
}

/// Distances from each pose measured at least three times to the next one of the same point.
pub(super) fn repeated_distances(
    measurements: &Measurements,
    groups: &[Vec<usize>],
    misses: [&[Miss]; 2],
) -> Vec<RepeatedDistance> {
    let point = |rows: &[usize]| &measurements.rows[rows[0]].point;
    let mut found = Vec::new();
    for (number, first) in groups.iter().enumerate() {
        let later = &groups[number + 1..];
        let Some(second) = later.iter().find(|rows| point(rows) == point(first)) else {
            continue;
        };
        let pairs: Vec<(usize, usize)> =
            first.iter().copied().zip(second.iter().copied()).collect();
        let seen = |row: usize| {
            let place = measurements.rows[row].observed.point_m();
            place.expect("rows of a group have points")
        };
        let lengths: Vec<f64> = pairs
            .iter()
            .map(|(a, b)| mm_from_m(norm(sub(seen(*a), seen(*b)))))
            .collect();
        let Some(spread) = Spread::of(&lengths) else {
            continue;
        };
        // what a model expects is the same each time but for what it says of time and direction
        let expected = misses.map(|misses| {
            let lengths = pairs
                .iter()
                .map(|(a, b)| mm_from_m(norm(sub(misses[*a].expected_m, misses[*b].expected_m))));
            lengths.sum::<f64>() / pairs.len() as f64
        });
        found.push(RepeatedDistance {
            lines: [first, second].map(|rows| measurements.rows[rows[0]].line.clone()),
            count: pairs.len(),
            distance_mm: spread.mean,
            accuracy_mm: (spread.mean - expected[0]).abs(),
            commanded_accuracy_mm: (spread.mean - expected[1]).abs(),
            repeatability_mm: 3.0 * spread.std,
        });
    }
    found
}
