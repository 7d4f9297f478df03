//! Direct kinematics in closed form, and what the noise of the lengths does to it.

use super::{Design, HexapodError, Lengths, NAMES};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Dual, Pose, Rotation, Scalar, Vector, add, cross, dot, norm, scale, sub};

/// A pose of the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solved {
    /// Assembly mode, 1 to 4.
    pub mode: usize,
    /// The tool's balls by their own names, metres.
    pub tool_points_m: [Vector; 3],
    /// The tool's frame in the base's.
    pub pose: Pose,
}

/// What a standard deviation σ of every length does, the lengths being independent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Standard deviations of the tool points' coordinates in multiples of σ.
    pub points: [[f64; 3]; 3],
    /// Covariance of the pose in multiples of σ²: rotation (rad/m) and position of T1, along the
    /// axes of the base.
    pub pose: [[f64; 6]; 6],
}

/// The point at given distances from three: `side` chooses on which side of their plane. The second
/// value is the squared height above the plane, below zero where the spheres do not meet.
#[inline(always)]
fn meet<S: Scalar>(p: [Vector<S>; 3], r: [S; 3], side: f64) -> (Vector<S>, S) {
    let along = sub(p[1], p[0]);
    let d = norm(along);
    let x = scale(S::one() / d, along);
    let other = sub(p[2], p[0]);
    let i = dot(x, other);
    let across = sub(other, scale(i, x));
    let j = norm(across);
    let y = scale(S::one() / j, across);
    let z = cross(x, y);
    let half = S::constant(0.5);
    let u = half * (r[0] * r[0] - r[1] * r[1] + d * d) / d;
    let v = half * (r[0] * r[0] - r[2] * r[2] + i * i + j * j - (i + i) * u) / j;
    let squared = r[0] * r[0] - u * u - v * v;
    let w = S::constant(side) * squared.max(S::zero()).sqrt();
    let point = add(p[0], add(scale(u, x), add(scale(v, y), scale(w, z))));
    (point, squared)
}

/// The base balls by their own names.
#[inline(always)]
pub(super) fn base_points<S: Scalar>(b: [S; 3]) -> ([Vector<S>; 3], S) {
    let (o, half) = (S::zero(), S::constant(0.5));
    let [b12, b23, b31] = b;
    let x = half * (b12 * b12 + b31 * b31 - b23 * b23) / b12;
    let squared = b31 * b31 - x * x;
    let y = squared.max(o).sqrt();
    ([[o, o, o], [b12, o, o], [x, y, o]], squared)
}

/// Distance between two balls from `[12, 23, 31]`.
#[inline(always)]
fn between<S: Scalar>(sides: &[S; 3], a: usize, b: usize) -> S {
    // 0+1 → 12, 1+2 → 23, 2+0 → 31
    sides[[0, 2, 1][a + b - 1]]
}

/// The four solutions share their beginnings: T1, then two T2, then two T3 each. Points in the
/// names of the design, and the squared heights of the three steps.
#[inline(always)]
fn build<S: Scalar>(l: &[S; 12], design: &Design, mode: usize) -> ([Vector<S>; 3], [S; 4]) {
    let (balls, base_height) = base_points([l[0], l[1], l[2]]);
    let b = design.base.map(|k| balls[k]);
    let tool = [l[3], l[4], l[5]];
    let [t12, t23, t31] =
        [[0, 1], [1, 2], [2, 0]].map(|[i, j]| between(&tool, design.tool[i], design.tool[j]));
    let hand = design.hand();
    let (second, third) = SIDES[mode - 1];
    let (t1, h1) = meet(b, [l[6], l[7], l[8]], hand);
    let (t2, h2) = meet([b[0], b[1], t1], [l[9], l[10], t12], hand * second);
    let (t3, h3) = meet([t2, b[1], t1], [t23, l[11], t31], hand * third);
    ([t1, t2, t3], [base_height, h1, h2, h3])
}

/// On which side T2 and T3 lie in modes 1 to 4, in the order of table 3.1 of the thesis.
const SIDES: [(f64, f64); 4] = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];

/// The frame with its origin at the first point, x toward the second, the third in the xy plane
/// with y > 0.
#[inline(always)]
fn frame<S: Scalar>(p: [Vector<S>; 3]) -> Pose<S> {
    let along = sub(p[1], p[0]);
    let x = scale(S::one() / norm(along), along);
    let to_third = sub(p[2], p[0]);
    let across = sub(to_third, scale(dot(x, to_third), x));
    let y = scale(S::one() / norm(across), across);
    let z = cross(x, y);
    let mut rotation = [[S::zero(); 3]; 3];
    for i in 0..3 {
        rotation[i] = [x[i], y[i], z[i]];
    }
    Pose {
        rotation: Rotation(rotation),
        translation: p[0],
    }
}

/// Points in the design's names by the balls' own names.
#[inline(always)]
fn own_names<S: Scalar>(points: [Vector<S>; 3], design: &Design) -> [Vector<S>; 3] {
    let mut own = points;
    for k in 0..3 {
        own[design.tool[k]] = points[k];
    }
    own
}

/// The pose of one assembly mode, 1 to 4.
///
/// # Errors
/// Lengths that are none, sides that make no triangle, or spheres that do not meet; with the length
/// that is likely wrong.
pub fn solve(lengths: &Lengths, design: &Design, mode: usize) -> Result<Solved, HexapodError> {
    #[allow(clippy::cast_precision_loss)]
    let found = mode as f64;
    if !(1..=4).contains(&mode) {
        return Err(HexapodError::Mode { found });
    }
    let all = lengths.all();
    let (points, heights) = build(&all, design, mode);
    // NaN is not above zero either
    if !heights.iter().all(|h| *h > 0.0) || !all.iter().all(|l| *l > 0.0) {
        return Err(fault(&all, design, mode));
    }
    let tool_points_m = own_names(points, design);
    Ok(Solved {
        mode,
        tool_points_m,
        pose: frame(tool_points_m),
    })
}

/// All four assembly modes.
///
/// # Errors
/// As [`solve`], if none has a solution; modes without one are left out.
pub fn modes(lengths: &Lengths, design: &Design) -> Result<Vec<Solved>, HexapodError> {
    let each: Vec<_> = (1..=4).map(|mode| solve(lengths, design, mode)).collect();
    if each.iter().all(Result::is_err) {
        return each.into_iter().collect();
    }
    Ok(each.into_iter().flatten().collect())
}

/// The mode whose tool points are nearest to those of a rough pose.
///
/// # Errors
/// As [`modes`]; or if two modes are about as near.
pub fn near(lengths: &Lengths, design: &Design, rough: &Pose) -> Result<Solved, HexapodError> {
    let found = modes(lengths, design)?;
    let distance = |solved: &Solved| {
        // the balls in the tool's frame are the same in all modes
        let back = solved.pose.inverse();
        let squares = solved
            .tool_points_m
            .map(|p| norm(sub(p, rough.transform(back.transform(p)))).powi(2));
        (squares.iter().sum::<f64>() / 3.0).sqrt()
    };
    let mut order: Vec<(f64, &Solved)> = found.iter().map(|s| (distance(s), s)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    match order.as_slice() {
        [(first, a), (second, b), ..] if second - first < 0.3 * second => {
            Err(HexapodError::Rough {
                first: a.mode,
                second: b.mode,
                first_mm: mm_from_m(*first),
                second_mm: mm_from_m(*second),
            })
        }
        [(_, best), ..] => Ok(**best),
        [] => unreachable!("modes gives at least one"),
    }
}

/// What the noise of the lengths does to the tool points and the pose of a mode that [`solve`] has
/// found: exact derivatives by all twelve lengths (JCGM 100, "GUM", sec. 5.1).
#[must_use]
pub fn spread(lengths: &Lengths, design: &Design, mode: usize) -> Spread {
    let all = lengths.all();
    let duals: [Dual<12>; 12] = std::array::from_fn(|i| Dual::variable(all[i], i));
    let (points, _) = build(&duals, design, mode);
    let points = own_names(points, design);
    let pose = frame(points);
    let sigma = |d: &Dual<12>| d.slope.iter().map(|s| s * s).sum::<f64>().sqrt();
    let mut jacobian = [[0.0; 12]; 6];
    for k in 0..12 {
        // ω = the axial vector of dR Rᵀ
        let turn = |i: usize, j: usize| -> f64 {
            (0..3)
                .map(|m| pose.rotation.0[i][m].slope[k] * pose.rotation.0[j][m].value)
                .sum()
        };
        jacobian[0][k] = 0.5 * (turn(2, 1) - turn(1, 2));
        jacobian[1][k] = 0.5 * (turn(0, 2) - turn(2, 0));
        jacobian[2][k] = 0.5 * (turn(1, 0) - turn(0, 1));
        for i in 0..3 {
            jacobian[3 + i][k] = pose.translation[i].slope[k];
        }
    }
    Spread {
        points: points.map(|p| [sigma(&p[0]), sigma(&p[1]), sigma(&p[2])]),
        pose: std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..12).map(|k| jacobian[i][k] * jacobian[j][k]).sum())
        }),
    }
}

/// The six legs of a design for tool points in the base's frame, metres.
#[must_use]
pub fn legs_at(base_m: [f64; 3], tool_points_m: &[Vector; 3], design: &Design) -> [f64; 6] {
    let (balls, _) = base_points(base_m);
    let b = design.base.map(|k| balls[k]);
    let t = design.tool.map(|k| tool_points_m[k]);
    [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (1, 2)].map(|(i, j)| norm(sub(t[j], b[i])))
}

/// Which length is at fault.
fn fault(all: &[f64; 12], design: &Design, mode: usize) -> HexapodError {
    if let Some(k) = (0..12).find(|k| !(all[*k].is_finite() && all[*k] > 0.0)) {
        return HexapodError::Length {
            name: NAMES[k],
            found_mm: mm_from_m(all[k]),
        };
    }
    for (which, at) in [("the base", 0), ("the tool", 3)] {
        let sides = &all[at..at + 3];
        let longest = (0..3).fold(0, |m, i| if sides[i] > sides[m] { i } else { m });
        let rest = sides.iter().sum::<f64>() - sides[longest];
        if sides[longest] >= rest {
            return HexapodError::Triangle {
                which,
                longest: NAMES[at + longest],
                found_mm: mm_from_m(sides[longest]),
                limit_mm: mm_from_m(rest),
            };
        }
    }
    let (_, heights) = build(all, design, mode);
    let stage = (1..4)
        .find(|s| heights[*s].is_nan() || heights[*s] <= 0.0)
        .unwrap_or(3);
    let tool_side = |i: usize, j: usize| 3 + [0, 2, 1][design.tool[i] + design.tool[j] - 1];
    let (point, involved) = match stage {
        1 => ("T1", vec![6, 7, 8]),
        2 => ("T2", vec![9, 10, tool_side(0, 1)]),
        _ => ("T3", vec![11, tool_side(1, 2), tool_side(2, 0)]),
    };
    // a length of an earlier step may be the wrong one as well
    let mut candidates: Vec<usize> = involved.clone();
    candidates.extend((6..12).filter(|k| !involved.contains(k)));
    let mut changes: Vec<(&'static str, f64)> = candidates
        .into_iter()
        .filter_map(|k| Some((NAMES[k], smallest_change(all, design, mode, k)?)))
        .collect();
    changes.sort_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    HexapodError::NoMeeting {
        point,
        lengths: involved.iter().map(|k| NAMES[*k]).collect(),
        changes,
    }
}

/// The smallest change of one length, mm, with which all spheres meet; none short of the whole of
/// it.
fn smallest_change(all: &[f64; 12], design: &Design, mode: usize, k: usize) -> Option<f64> {
    let works = |by: f64| {
        let mut lengths = *all;
        lengths[k] += by;
        build(&lengths, design, mode).1.iter().all(|h| *h > 0.0)
    };
    let mut last = 0.0;
    for n in 1..1000 {
        let by = all[k] * 0.001 * f64::from(n);
        for sign in [1.0, -1.0] {
            if works(sign * by) {
                let (mut low, mut high) = (last, by);
                for _ in 0..40 {
                    let middle = 0.5 * (low + high);
                    if works(sign * middle) {
                        high = middle;
                    } else {
                        low = middle;
                    }
                }
                return Some(mm_from_m(sign * high));
            }
        }
        last = by;
    }
    None
}
