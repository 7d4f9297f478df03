//! Where to start when nothing is known: turned main axes.

use super::pairs::{pairings, rms, step, trimmed};
use super::surface::Surface;
use super::{Metric, Options};
use crate::geometry::{Pose, Rotation, Vector, cross, norm, sub};
use crate::register::kabsch::scatter;
use rayon::prelude::*;

/// Points of TO in the coarse stage: far from a surface a search in a large tree is slow.
const THIN: usize = 3000;
/// Steps of a coarse run from every start.
const COARSE_STEPS: usize = 12;
/// Ends of coarse runs that go on.
const FINALISTS: usize = 4;
/// Steps of those.
const MORE_STEPS: usize = 15;

/// Runs from turned main axes and from where the files stand; the best, how many there were, and
/// the best of those that end elsewhere.
pub(super) fn coarse_search(
    from: &[Vector],
    coarse: &[Vector],
    surface: &Surface,
    options: &Options,
    size: f64,
) -> (Pose, usize, Option<Pose>) {
    let mut starts = vec![Pose::identity()];
    let (from_centre, from_axes) = main_axes(from);
    let (to_centre, to_axes) = main_axes(&surface.points);
    for turn in cube_turns() {
        let rotation = to_axes * turn * from_axes.transpose();
        starts.push(Pose {
            rotation,
            translation: sub(to_centre, rotation * from_centre),
        });
    }
    let thin = surface.thinned(THIN);
    let thin = thin.as_ref().unwrap_or(surface);
    let rough = Options {
        metric: Metric::PointToPoint,
        ..*options
    };
    let walk = |surface: &Surface, pose: Pose, options: &Options, steps: usize| {
        let mut pose = pose;
        for _ in 0..steps {
            match step(coarse, surface, &pose, options) {
                Some((better, _)) => pose = better,
                None => break,
            }
        }
        let pairs = pairings(coarse, surface, &pose, Metric::PointToPoint);
        (rms(&trimmed(pairs, surface, options.kept)), pose)
    };
    // first by points, which draws from farther away
    let first = |start: &Pose| walk(thin, *start, &rough, COARSE_STEPS);
    let mut ends: Vec<(f64, Pose)> = starts.par_iter().map(first).collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let apart = |a: &Pose, b: &Pose| {
        let turn = (a.rotation.transpose() * b.rotation).angle();
        let shift = norm(sub(a.transform(from_centre), b.transform(from_centre)));
        turn > 0.1 || shift > 0.1 * size
    };
    let mut last: Vec<Pose> = Vec::new();
    for (_, pose) in &ends {
        if last.len() < FINALISTS && last.iter().all(|other| apart(other, pose)) {
            last.push(*pose);
        }
    }
    let on = |pose: &Pose| walk(surface, *pose, options, MORE_STEPS);
    let mut ends: Vec<(f64, Pose)> = last.par_iter().map(on).collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let best = ends[0].1;
    let alternative = ends[1..]
        .iter()
        .find(|end| apart(&best, &end.1))
        .map(|end| end.1);
    (best, starts.len(), alternative)
}

fn main_axes(points: &[Vector]) -> (Vector, Rotation) {
    let (centre, scatter) = scatter(points, None);
    let eigen = scatter.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let column = |i: usize| {
        let c = eigen.eigenvectors.column(order[i]);
        [c[0], c[1], c[2]]
    };
    let (x, y) = (column(0), column(1));
    let z = cross(x, y);
    (
        centre,
        Rotation(std::array::from_fn(|i| [x[i], y[i], z[i]])),
    )
}

/// The 24 turns of a cube.
fn cube_turns() -> Vec<Rotation> {
    let mut turns = Vec::new();
    let axes = [0_usize, 1, 2];
    for a in axes {
        for b in axes.into_iter().filter(|b| *b != a) {
            for signs in 0..4 {
                let mut x = [0.0; 3];
                let mut y = [0.0; 3];
                x[a] = if signs & 1 == 0 { 1.0 } else { -1.0 };
                y[b] = if signs & 2 == 0 { 1.0 } else { -1.0 };
                let z = cross(x, y);
                turns.push(Rotation(std::array::from_fn(|i| [x[i], y[i], z[i]])));
            }
        }
    }
    turns
}
