//! Rows one after another that fit no model: something moved between them, and they are not there by
//! chance.

use super::attempt::OUTLIER;
use crate::diagnose::estimator::refit::Refit;
use crate::diagnose::estimator::table::{Layout, dot};
use crate::diagnose::question::Session;
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector, add, norm, scale, sub};
use crate::identify::Line;
use crate::identify::measurements::Measurements;
use crate::identify::robust::limit;
use crate::identify::start::align;
use std::collections::BTreeMap;
use std::ops::Range;

/// Fewer configurations one after another are single wrong rows: where one row in fifty is wrong,
/// four in a row of 150 come up once in forty thousand sessions, three once in eight hundred.
const FEWEST: usize = 4;
/// Nor are they where as many wrong rows as there are make that as likely as this by chance.
const BY_CHANCE: f64 = 1e-3;
/// A motion explains rows where it leaves less than this part of how far they are off.
const EXPLAINS: f64 = 0.5;

/// Rows one after another that fit no model.
pub(crate) struct InARow {
    /// Which.
    pub rows: Vec<usize>,
    /// Where they stand, how far they are off, and what that mostly is.
    pub words: String,
}

/// How far a row is from what was found, in standard deviations of the noise, where it fits no
/// model.
pub(crate) fn beyond(layout: &Layout, refit: &Refit, row: usize) -> Option<f64> {
    let range = layout.row(row);
    let own = &refit.residual[range.clone()];
    let length = dot(own, own).sqrt();
    (length > OUTLIER * limit(range.len()) * refit.scale).then(|| length / refit.scale)
}

/// Stretches of rows that are `wrong`, of so many configurations that it is not by chance.
fn stretches(wrong: &[bool], configuration: &[usize]) -> Vec<Range<usize>> {
    let mut all: Vec<Range<usize>> = Vec::new();
    for row in (0..wrong.len()).filter(|row| wrong[*row]) {
        match all.last_mut() {
            Some(last) if last.end == row => last.end += 1,
            _ => all.push(row..row + 1),
        }
    }
    let poses = |rows: &Range<usize>| {
        let mut own = configuration[rows.clone()].to_vec();
        own.sort_unstable();
        own.dedup();
        own.len()
    };
    all.retain(|rows| poses(rows) >= FEWEST);
    let within: usize = all.iter().map(ExactSizeIterator::len).sum();
    let single = wrong.iter().filter(|w| **w).count() - within;
    let count = wrong.len() as f64;
    let rate = (single + 1) as f64 / (count - within as f64 + 1.0);
    let chance = |rows: &Range<usize>| count * rate.powf(poses(rows) as f64);
    all.retain(|rows| chance(rows) < BY_CHANCE);
    all
}

/// Stretches of all rows, and of those of one point where others stand between them: its reflector may
/// have moved alone.
fn of_points<'a>(
    wrong: &[bool],
    configuration: &[usize],
    measurements: &'a Measurements,
) -> Vec<(Vec<usize>, Option<&'a str>)> {
    let mut found = Vec::new();
    let mut is_found = vec![false; wrong.len()];
    for rows in stretches(wrong, configuration) {
        is_found[rows.clone()].fill(true);
        found.push((rows.collect(), None));
    }
    let mut points: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (at, row) in measurements.rows.iter().enumerate() {
        if let Some(point) = row.point.as_deref() {
            points.entry(point).or_default().push(at);
        }
    }
    for (point, own) in points {
        let wrong: Vec<bool> = own.iter().map(|row| wrong[*row]).collect();
        let configuration: Vec<usize> = own.iter().map(|row| configuration[*row]).collect();
        for rows in stretches(&wrong, &configuration) {
            let rows = own[rows].to_vec();
            if !rows.iter().any(|row| is_found[*row]) {
                found.push((rows, Some(point)));
            }
        }
    }
    found
}

/// What is expected of a row, and what was seen.
struct Seen {
    world_from_tool: Pose,
    expected_m: Vector,
    seen_m: Vector,
}

/// Root mean square of lengths.
fn rms(lengths: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = lengths.len() as f64;
    (lengths.map(|x| x * x).sum::<f64>() / count).sqrt()
}

/// What one motion of the device, or of the tool, leaves of rows, metres.
fn left(rows: &[Seen]) -> [f64; 2] {
    let mean_of = |gaps: &[Vector]| {
        let sum = gaps.iter().fold([0.0; 3], |all, gap| add(all, *gap));
        scale(1.0 / gaps.len() as f64, sum)
    };
    let about_mean = |gaps: &[Vector]| {
        let mean = mean_of(gaps);
        rms(gaps.iter().map(|gap| norm(sub(*gap, mean))))
    };
    let gaps = |turned: bool| -> Vec<Vector> {
        let gap = |r: &Seen| {
            let gap = sub(r.seen_m, r.expected_m);
            if turned {
                r.world_from_tool.rotation.transpose() * gap
            } else {
                gap
            }
        };
        rows.iter().map(gap).collect()
    };
    let moved = align(rows.iter().map(|r| (r.expected_m, r.seen_m)));
    let device = rms(rows
        .iter()
        .map(|r| norm(sub(r.seen_m, moved.transform(r.expected_m)))));
    [device, about_mean(&gaps(true))]
}

/// `lines 142 to 151`.
fn lines(first: &Line, last: &Line) -> String {
    if first.file == last.file {
        let of = first.file.as_ref();
        let of = of.map_or_else(String::new, |file| format!(" of {file}"));
        format!("lines {} to {}{of}", first.number, last.number)
    } else {
        format!("{first} to {last}")
    }
}

/// Rows one after another that fit no model, however far they are off.
pub(crate) fn in_a_row(
    session: &Session,
    refit: &Refit,
    measurements: &Measurements,
) -> Vec<InARow> {
    let (problem, layout) = (&session.problem, &session.layout);
    let wrong: Vec<bool> = (0..layout.rows())
        .map(|row| beyond(layout, refit, row).is_some())
        .collect();
    let all = of_points(&wrong, &measurements.configurations(), measurements);
    if all.is_empty() {
        return Vec::new();
    }
    let models = problem.models(&refit.estimate, &[]);
    let of = |(rows, point): (Vec<usize>, Option<&str>)| {
        let each = rows.iter().map(|row| {
            let row = &problem.rows[*row];
            let pose = models[row.rig].evaluate(&row.q, &row.conditions, &mut []);
            let seen = problem.observe(&refit.estimate, row, pose);
            (pose, seen.expected_m(), seen.gap(), row)
        });
        let each: Vec<_> = each.collect();
        let count = |row: &crate::identify::problem::Row| row.observed.count();
        let place = rms(each.iter().map(|(_, _, gap, row)| {
            let own = &gap[..count(row).min(3)];
            dot(own, own).sqrt()
        }));
        let turned = rms(each
            .iter()
            .map(|(_, _, gap, _)| norm([gap[3], gap[4], gap[5]])));
        let points = each.iter().filter_map(|(pose, expected, _, row)| {
            Some(Seen {
                world_from_tool: *pose,
                expected_m: *expected,
                seen_m: row.observed.point_m()?,
            })
        });
        let points: Vec<Seen> = points.collect();
        let line = |row: usize| &measurements.rows[row].line;
        let (start, end) = (rows[0], rows[rows.len() - 1]);
        let (first, last) = (line(start), line(end));
        let own = |row: usize| measurements.rows[row].point.as_deref();
        let is_same = |row: usize| point.is_none() || own(row) == point;
        let is_first = !(0..start).any(is_same);
        let is_last = !(end + 1..layout.rows()).any(is_same);
        let when = match (is_first, is_last) {
            (true, _) => format!("after {last}"),
            (_, true) => format!("before {first}"),
            _ => format!("before {first} and after {last}"),
        };
        let sigmas = (problem.rows[start].sigma_m, problem.rows[start].sigma_rad);
        let is_of_place = place / sigmas.0 >= turned / sigmas.1;
        let mut off = mm(place) + " mm";
        if turned / sigmas.1 > limit(3) * refit.scale {
            let degrees = format!("{:.3}°", turned / DEG);
            off = if is_of_place {
                format!("{off} and {degrees}")
            } else {
                degrees
            };
        }
        let motion = (points.len() == each.len() && is_of_place).then(|| left(&points));
        let motion = motion.map(|[device, tool]| {
            if device <= tool {
                ("the measuring device or the base", device)
            } else {
                ("the tool or the reflector", tool)
            }
        });
        let (together, what) = match motion {
            Some((name, least)) if least < EXPLAINS * place => (
                " together",
                format!(
                    "that is mostly {name}, which moved {when} ({} mm is left then)",
                    mm(least)
                ),
            ),
            Some(_) => (
                "",
                "no one motion of the device, the base or the tool does that: a joint lost its \
                 zero, or these rows are of another session"
                    .to_owned(),
            ),
            None => (
                "",
                "the device, the base or the tool moved, or these rows were read otherwise"
                    .to_owned(),
            ),
        };
        InARow {
            words: format!(
                "{}, {} rows{} one after another, are {off} off{together} and fit no model: {what}",
                lines(first, last),
                rows.len(),
                point.map_or_else(String::new, |point| format!(" of point {point}"))
            ),
            rows,
        }
    };
    all.into_iter().map(of).collect()
}

/// A length in millimetres, to a thousandth.
fn mm(length_m: f64) -> String {
    format!("{:.3}", mm_from_m(length_m))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_in_a_row_are_not_there_by_chance_but_among_many_wrong_rows() {
        let each: Vec<usize> = (0..150).collect();
        let with =
            |wrong: &[usize]| -> Vec<bool> { each.iter().map(|r| wrong.contains(r)).collect() };
        let found = |wrong: &[usize], poses: &[usize]| -> Vec<[usize; 2]> {
            let all = stretches(&with(wrong), poses);
            all.iter().map(|rows| [rows.start, rows.end]).collect()
        };
        let of = |wrong: &[usize]| found(wrong, &each);
        assert_eq!(of(&[0, 1, 2, 3]), [[0, 4]]);
        assert_eq!(of(&[146, 147, 148, 149]), [[146, 150]]);
        assert_eq!(of(&[70, 71, 72, 73, 74, 9, 30]), [[70, 75]]);
        // three rows, and single ones
        assert!(of(&[70, 71, 72]).is_empty());
        assert!(of(&[1, 3, 5, 7, 9, 11]).is_empty());
        // one row in eight is wrong
        let mut many: Vec<usize> = (0..18).map(|k| 7 * k).collect();
        many.extend([71, 72, 73]);
        assert!(of(&many).is_empty());
        // two stretches do not hide one another
        let two: Vec<usize> = (0..30).chain(90..130).collect();
        assert_eq!(of(&two), [[0, 30], [90, 130]]);
        // rows of one pose are one
        let poses: Vec<usize> = (0..150).map(|row| row / 3).collect();
        assert!(found(&[3, 4, 5, 6, 7, 8], &poses).is_empty());
        assert_eq!(found(&(3..15).collect::<Vec<_>>(), &poses), [[3, 15]]);
    }

    #[test]
    fn a_device_that_moved_is_distinguished_from_a_tool_that_did() {
        let moved = Pose::from_xyz_rxryrz([0.3, -0.1, 0.02, 0.1, -0.2, 1.5]);
        let slip = [0.02, -0.01, 0.03];
        let row = |k: usize, by: bool| {
            let x = k as f64;
            let own = [
                0.3 * x.sin(),
                0.4 * (2.1 * x).cos(),
                0.2 * (1.3 * x).sin(),
                x,
                2.0 * x,
                0.3 * x,
            ];
            let pose = Pose::from_xyz_rxryrz(own);
            let seen = if by {
                moved.transform(pose.translation)
            } else {
                pose.transform(slip)
            };
            Seen {
                world_from_tool: pose,
                expected_m: pose.translation,
                seen_m: seen,
            }
        };
        for by_device in [true, false] {
            let rows: Vec<Seen> = (0..6).map(|k| row(k, by_device)).collect();
            let [device, tool] = left(&rows);
            let (own, other) = if by_device {
                (device, tool)
            } else {
                (tool, device)
            };
            assert!(own < 1e-9 && other > 1e-3, "{own} {other}");
        }
    }
}
