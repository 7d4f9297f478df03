//! Where the base stands, in closed form, wherever the measuring device is.

use super::distances::by_distances;
use super::input_checks::BETTER;
use super::measurements::{Measurements, Observed};
use crate::geometry::{Pose, Quaternion, Rotation, Vector, add, dot, norm, scale, sub};
use crate::model::effects::Kind;
use crate::model::external::Stand;
use crate::model::{Conditions, Model};
use crate::profile::{Mounted, Profile};
use nalgebra::{DMatrix, DVector, Matrix3, Matrix4};

/// Rounds of improving points and base in alternation.
const ALTERNATIONS: usize = 30;
/// Below this part of the largest spread, a direction counts as not covered.
const FLAT: f64 = 1e-6;
/// Where the points of the profile fit so well, metres, they are believed.
const BELIEVED_M: f64 = 0.02;
/// And where columns of the rows have them and they fit so well, metres, none is sought elsewhere.
const NEAR_M: f64 = 0.001;
/// A row that misses by this many times what half of the rows do is left out of the guess.
const GROSS: f64 = 4.0;
/// And the part of the rows that must remain.
const MOST_KEPT: f64 = 0.7;
/// How often rows are left out.
const CLEANINGS: usize = 6;
/// Rows whose orientation is tried as that of all.
const TRIED_ORIENTATIONS: usize = 5;

/// One reading reduced to what the start needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    /// `base_from_flange` by the nominal arm, from the base as it stands at home.
    pub flange: Pose,
    /// The point seen in the world, metres.
    pub seen: Vector,
    /// Which measured point.
    pub carrier: usize,
}

/// Tool and name of a measured point.
pub(super) type CarrierName = (String, Option<String>);
/// The measured points and where they are believed on the flange; `None` where that is not known.
pub(super) type Carriers = Vec<Option<Vector>>;

/// How two points of a tool lie to one another, the pair that differs most from the profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Mounting {
    /// The tool.
    pub tool: String,
    /// The two points whose distance differs most.
    pub points: [String; 2],
    /// Their distance as measured and in the profile, metres.
    pub apart_m: [f64; 2],
    /// The largest angle between a pair as measured and in the profile, radians.
    pub rotated_rad: f64,
}

/// A first guess.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Where the base stands.
    pub world_from_base: Pose,
    /// Each measured point on the flange, metres, by `(tool, point)`.
    pub points_on_flange_m: Vec<((String, Option<String>), Vector)>,
    /// How far each of them is from where the profile, or the columns of the point, have it, metres;
    /// `None` where they do not, or where they fit as well.
    pub moved_m: Vec<Option<f64>>,
    /// How the points of each tool lie to one another, of which the profile has more than one.
    pub mountings: Vec<Mounting>,
    /// Root mean square of the distances left, without gross errors, metres.
    pub rms_m: f64,
    /// The same with the tool and points as the profile has them; `None` where it does not have
    /// them all.
    pub believed_rms_m: Option<f64>,
    /// How far what was measured spreads, metres.
    pub spread_m: f64,
    /// Orientation of each tool on the flange, where poses were measured.
    pub turned: Vec<(String, Rotation)>,
    /// The angle between measured orientations and those, half of the rows are below it, radians.
    pub turned_apart_rad: Option<f64>,
    /// Number of fixed points that distances were measured from, where only such tell where the
    /// base is.
    pub fixed_points: Option<usize>,
}

impl Start {
    /// A base that is known, and nothing else.
    #[must_use]
    pub fn at(world_from_base: Pose) -> Self {
        Self {
            world_from_base,
            points_on_flange_m: Vec::new(),
            moved_m: Vec::new(),
            mountings: Vec::new(),
            rms_m: 0.0,
            believed_rms_m: None,
            spread_m: 0.0,
            turned: Vec::new(),
            turned_apart_rad: None,
            fixed_points: None,
        }
    }
}

/// The nominal arm with its base at the origin, to the flange.
pub(super) fn bare_arm(profile: &Profile) -> Model {
    let mut geometry = profile.geometry(&Mounted::flange());
    geometry.world_from_base = Pose::identity();
    let effects: Vec<_> = profile
        .effects
        .iter()
        .filter(|e| {
            !e.definition().deflects && !matches!(e.kind, Kind::BaseFrame | Kind::ToolFrame)
        })
        .cloned()
        .collect();
    Model::build(
        &geometry,
        &profile.mechanism,
        &effects,
        &Conditions::default(),
    )
}

/// Where the base is carried to, seen from where it stands at home, as the profile has its track.
pub(super) fn carried(profile: &Profile, stand: &Stand) -> Pose {
    profile
        .carried(stand, true)
        .map_or_else(Pose::identity, |carried| {
            carried.carry(Pose::identity(), &profile.effects)
        })
}

/// `b_from_a` that takes the points `a` nearest to the points `b`.
///
/// # Source
/// B. K. P. Horn, "Closed-form solution of absolute orientation using unit quaternions", JOSA A 4
/// (1987).
pub(crate) fn align(pairs: impl Iterator<Item = (Vector, Vector)> + Clone) -> Pose {
    let count = pairs.clone().count().max(1) as f64;
    let (mut a0, mut b0) = ([0.0; 3], [0.0; 3]);
    for (a, b) in pairs.clone() {
        a0 = add(a0, a);
        b0 = add(b0, b);
    }
    let (a0, b0) = (scale(1.0 / count, a0), scale(1.0 / count, b0));
    let mut s = Matrix3::<f64>::zeros();
    for (a, b) in pairs {
        let (a, b) = (sub(a, a0), sub(b, b0));
        for i in 0..3 {
            for j in 0..3 {
                s[(i, j)] += a[i] * b[j];
            }
        }
    }
    #[rustfmt::skip]
    let n = Matrix4::new(
        s[(0, 0)] + s[(1, 1)] + s[(2, 2)], s[(1, 2)] - s[(2, 1)], s[(2, 0)] - s[(0, 2)], s[(0, 1)] - s[(1, 0)],
        s[(1, 2)] - s[(2, 1)], s[(0, 0)] - s[(1, 1)] - s[(2, 2)], s[(0, 1)] + s[(1, 0)], s[(2, 0)] + s[(0, 2)],
        s[(2, 0)] - s[(0, 2)], s[(0, 1)] + s[(1, 0)], s[(1, 1)] - s[(0, 0)] - s[(2, 2)], s[(1, 2)] + s[(2, 1)],
        s[(0, 1)] - s[(1, 0)], s[(2, 0)] + s[(0, 2)], s[(1, 2)] + s[(2, 1)], s[(2, 2)] - s[(0, 0)] - s[(1, 1)],
    );
    let eigen = n.symmetric_eigen();
    let largest = eigen.eigenvalues.imax();
    let q = eigen.eigenvectors.column(largest);
    let rotation = Quaternion([q[0], q[1], q[2], q[3]]).normalized().rotation();
    Pose {
        rotation,
        translation: sub(b0, rotation * a0),
    }
}

/// Spread of points along their three main directions, metres, largest first.
pub(super) fn spreads(points: &[Vector]) -> [f64; 3] {
    let count = points.len().max(1) as f64;
    let sum = points.iter().fold([0.0; 3], |sum, p| add(sum, *p));
    let middle = scale(1.0 / count, sum);
    let mut s = Matrix3::<f64>::zeros();
    for p in points {
        let d = sub(*p, middle);
        for i in 0..3 {
            for j in 0..3 {
                s[(i, j)] += d[i] * d[j] / count;
            }
        }
    }
    let mut values = s.symmetric_eigenvalues().map(|v| v.max(0.0).sqrt());
    values.as_mut_slice().sort_by(|a, b| b.total_cmp(a));
    [values[0], values[1], values[2]]
}

fn rms(sights: &[Sight], base: &Pose, points: &[Vector]) -> f64 {
    let squares = sights.iter().map(|s| {
        let gap = sub(
            base.transform(s.flange.transform(points[s.carrier])),
            s.seen,
        );
        dot(gap, gap)
    });
    (squares.sum::<f64>() / sights.len().max(1) as f64).sqrt()
}

fn place(sights: &[Sight], points: &[Vector]) -> Pose {
    align(
        sights
            .iter()
            .map(|s| (s.flange.transform(points[s.carrier]), s.seen)),
    )
}

/// The points on the flange that fit best with the base here.
fn points_at(sights: &[Sight], base: &Pose, count: usize) -> Vec<Vector> {
    let back = base.inverse();
    let mut sums = vec![([0.0; 3], 0.0); count];
    for s in sights {
        let (sum, n) = &mut sums[s.carrier];
        *sum = add(*sum, s.flange.inverse().transform(back.transform(s.seen)));
        *n += 1.0;
    }
    sums.iter()
        .map(|(sum, n)| scale(1.0 / f64::max(*n, 1.0), *sum))
        .collect()
}

/// Base and points from `Rᵀp − t' − R_j c = t_j`, which is linear in the nine cells of R, in t' and
/// in the points c.
fn linear(sights: &[Sight], count: usize) -> Option<Pose> {
    let width = 12 + 3 * count;
    if 3 * sights.len() < width {
        return None;
    }
    let middle = {
        let sum = sights.iter().fold([0.0; 3], |sum, s| add(sum, s.seen));
        scale(1.0 / sights.len() as f64, sum)
    };
    let mut normal = DMatrix::<f64>::zeros(width, width);
    let mut right = DVector::<f64>::zeros(width);
    let mut line = vec![0.0; width];
    for s in sights {
        let p = sub(s.seen, middle);
        for i in 0..3 {
            line.fill(0.0);
            line[3 * i..3 * i + 3].copy_from_slice(&p);
            line[9 + i] = 1.0;
            let at = 12 + 3 * s.carrier;
            for k in 0..3 {
                line[at + k] = -s.flange.rotation.0[i][k];
            }
            for a in 0..width {
                right[a] += line[a] * s.flange.translation[i];
                for b in 0..width {
                    normal[(a, b)] += line[a] * line[b];
                }
            }
        }
    }
    // directions that do not show stay where they are
    let trace = normal.trace() / width as f64;
    for a in 0..width {
        normal[(a, a)] += 1e-12 * trace;
    }
    let solved = normal.cholesky()?.solve(&right);
    // the nearest rotation to the nine cells, by aligning the axes with their images
    let images: Vec<(Vector, Vector)> = (0..3)
        .map(|j| {
            let unit = std::array::from_fn(|i| f64::from(u8::from(i == j)));
            ([solved[j], solved[3 + j], solved[6 + j]], unit)
        })
        .collect();
    let both = images
        .iter()
        .flat_map(|(a, b)| [(*a, *b), (scale(-1.0, *a), scale(-1.0, *b))]);
    let rotation = align(both).rotation;
    Some(Pose {
        rotation,
        translation: middle,
    })
}

/// Improves base and points in alternation.
fn alternate(sights: &[Sight], mut base: Pose, count: usize) -> (Pose, Vec<Vector>) {
    // with the rotation known the rest is linear: points and translation together
    let width = 3 + 3 * count;
    for _ in 0..ALTERNATIONS {
        let mut normal = DMatrix::<f64>::zeros(width, width);
        let mut right = DVector::<f64>::zeros(width);
        for s in sights {
            let turn = base.rotation * s.flange.rotation;
            let rest = sub(s.seen, base.rotation * s.flange.translation);
            let at = 3 + 3 * s.carrier;
            // columns: identity for the translation, `turn` for the point
            for i in 0..3 {
                normal[(i, i)] += 1.0;
                right[i] += rest[i];
                for k in 0..3 {
                    normal[(i, at + k)] += turn.0[i][k];
                    normal[(at + k, i)] += turn.0[i][k];
                    right[at + k] += turn.0[i][k] * rest[i];
                }
                normal[(at + i, at + i)] += 1.0;
            }
        }
        for a in 0..width {
            normal[(a, a)] *= 1.0 + 1e-9;
        }
        let Some(factor) = normal.cholesky() else {
            break;
        };
        let solved = factor.solve(&right);
        base.translation = [solved[0], solved[1], solved[2]];
        let points: Vec<Vector> = (0..count)
            .map(|c| [solved[3 + 3 * c], solved[4 + 3 * c], solved[5 + 3 * c]])
            .collect();
        let next = place(sights, &points);
        let turned = next.separation(&base).angle_rad;
        base = next;
        if turned < 1e-9 {
            break;
        }
    }
    let points = points_at(sights, &base, count);
    (base, points)
}

/// What [`solve`] finds.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    pub base: Pose,
    pub points: Vec<Vector>,
    pub rms_m: f64,
    pub believed_rms_m: Option<f64>,
}

/// Base and points of some sights.
pub(super) fn solve(sights: &[Sight], carriers: &Carriers) -> Placed {
    let believed: Option<Vec<Vector>> = carriers.iter().copied().collect();
    let mut found: Vec<(Pose, Vec<Vector>)> = Vec::new();
    let mut believed_rms_m = None;
    if let Some(points) = believed {
        let base = place(sights, &points);
        let rms = rms(sights, &base, &points);
        believed_rms_m = Some(rms);
        if rms < BELIEVED_M {
            return Placed {
                base,
                points,
                rms_m: rms,
                believed_rms_m,
            };
        }
        found.push((base, points));
    }
    let guessed: Vec<Vector> = carriers.iter().map(|c| c.unwrap_or_default()).collect();
    found.push(alternate(sights, place(sights, &guessed), carriers.len()));
    found
        .extend(linear(sights, carriers.len()).map(|base| alternate(sights, base, carriers.len())));
    let best = found
        .into_iter()
        .map(|(base, points)| (rms(sights, &base, &points), base, points))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let (rms_m, base, points) = best.expect("at least one was found");
    Placed {
        base,
        points,
        rms_m,
        believed_rms_m,
    }
}

/// By what each point is from where it is believed, with all of them fitted, where they then fit
/// better by far; where those believed miss by less than `least`, metres, none.
fn moved(
    sights: &[Sight],
    carriers: &Carriers,
    placed: &Placed,
    least: f64,
) -> Option<Vec<Vector>> {
    let believed: Option<Vec<Vector>> = carriers.iter().copied().collect();
    let missed = placed.believed_rms_m.filter(|rms| *rms > least);
    let (believed, before) = believed.zip(missed)?;
    // what is fitted is how far each point is from there: what does not show stays zero
    let at = |s: &Sight| {
        let [x, y, z] = believed[s.carrier];
        let flange = s.flange * Pose::from_translation(x, y, z);
        Sight { flange, ..*s }
    };
    let sights: Vec<Sight> = sights.iter().map(at).collect();
    let fitted = alternate(&sights, placed.base, carriers.len());
    let after = rms(&sights, &fitted.0, &fitted.1);
    (after * BETTER < before).then_some(fitted.1)
}

/// How the named points of each tool lie to one another, moved by so much.
fn mountings(names: &[CarrierName], carriers: &Carriers, moved: &[Vector]) -> Vec<Mounting> {
    let mut all: Vec<Mounting> = Vec::new();
    for i in 0..names.len() {
        for j in i + 1..names.len() {
            let (tool, [Some(a), Some(b)]) = (&names[i].0, [&names[i].1, &names[j].1]) else {
                continue;
            };
            let (Some(p), Some(q)) = (carriers[i], carriers[j]) else {
                continue;
            };
            if names[j].0 != *tool || a == b {
                continue;
            }
            let believed = sub(q, p);
            let found = add(believed, sub(moved[j], moved[i]));
            let apart_m = [norm(found), norm(believed)];
            let cosine = dot(found, believed) / (apart_m[0] * apart_m[1]).max(1e-12);
            let rotated_rad = cosine.clamp(-1.0, 1.0).acos();
            let own = Mounting {
                tool: tool.clone(),
                points: [a.clone(), b.clone()],
                apart_m,
                rotated_rad,
            };
            match all.iter_mut().find(|known| known.tool == *tool) {
                Some(known) => {
                    let most = known.rotated_rad.max(rotated_rad);
                    if own.differs_m() > known.differs_m() {
                        *known = own;
                    }
                    known.rotated_rad = most;
                }
                None => all.push(own),
            }
        }
    }
    all
}

impl Mounting {
    /// By how much the distance of the two differs, metres.
    #[must_use]
    pub fn differs_m(&self) -> f64 {
        (self.apart_m[0] - self.apart_m[1]).abs()
    }
}

/// As [`solve`], without the rows that are far beyond the others; and those that remain.
fn solve_without_gross(sights: &[Sight], carriers: &Carriers) -> (Placed, Vec<Sight>) {
    let mut kept = sights.to_vec();
    let mut placed = solve(&kept, carriers);
    for _ in 0..CLEANINGS {
        let gap = |s: &Sight| {
            let expected = s.flange.transform(placed.points[s.carrier]);
            norm(sub(placed.base.transform(expected), s.seen))
        };
        let mut gaps: Vec<f64> = sights.iter().map(gap).collect();
        let largest = gaps.iter().copied().fold(0.0, f64::max);
        let middle = gaps.len() / 2;
        let limit = GROSS * *gaps.select_nth_unstable_by(middle, f64::total_cmp).1;
        if largest < BELIEVED_M || largest < GROSS * limit {
            break;
        }
        let next: Vec<Sight> = sights.iter().filter(|s| gap(s) <= limit).copied().collect();
        let all_seen = (0..carriers.len()).all(|c| next.iter().any(|s| s.carrier == c));
        if next.len() == kept.len()
            || (next.len() as f64) < MOST_KEPT * sights.len() as f64
            || !all_seen
        {
            break;
        }
        placed = solve(&next, carriers);
        kept = next;
    }
    (placed, kept)
}

/// The standard deviation of some numbers.
pub(super) fn deviation(numbers: &[f64]) -> f64 {
    let count = numbers.len().max(1) as f64;
    let mean = numbers.iter().sum::<f64>() / count;
    (numbers.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / count).sqrt()
}

/// Name of a row's tool; empty where the profile has none.
pub(super) fn tool_name(profile: &Profile, tool: Option<&str>) -> String {
    tool.or_else(|| profile.tools.keys().next().map(String::as_str))
        .unwrap_or("flange")
        .to_owned()
}

/// The sights of all rows that have a position, and the names and believed places of their points.
pub(super) fn sights(
    profile: &Profile,
    measurements: &Measurements,
) -> (Vec<Sight>, Vec<CarrierName>, Carriers) {
    let arm = bare_arm(profile);
    let mut names: Vec<(String, Option<String>, Option<[u64; 3]>)> = Vec::new();
    let mut carriers: Carriers = Vec::new();
    let mut all = Vec::new();
    for row in &measurements.rows {
        let Some(seen) = row.observed.point_m() else {
            continue;
        };
        let tool = tool_name(profile, row.tool.as_deref());
        let mounted = profile.tool(&tool).unwrap_or_else(Mounted::flange);
        let named = row
            .point
            .as_ref()
            .and_then(|p| profile.points.get(p).copied());
        let given = row.point_in_tool_m.or(named);
        let key = (
            tool,
            row.point.clone(),
            row.point_in_tool_m.map(|p| p.map(f64::to_bits)),
        );
        let carrier = names.iter().position(|k| *k == key).unwrap_or_else(|| {
            let point = given.or_else(|| row.point.is_none().then_some([0.0; 3]));
            let mut effects = profile.effects.iter();
            let real = effects.find(|e| e.kind == Kind::ToolFrame && e.site.is_of_tool(&key.0));
            let real = real.map_or(Pose::identity(), |e| Pose::from_xyz_rxryrz(e.parameters));
            carriers.push(point.map(|p| (mounted.flange_from_tool * real).transform(p)));
            names.push(key);
            names.len() - 1
        });
        all.push(Sight {
            flange: carried(profile, &row.stand) * arm.forward(&row.q, &Conditions::default()),
            seen,
            carrier,
        });
    }
    let names = names
        .into_iter()
        .map(|(tool, point, _)| (tool, point))
        .collect();
    (all, names, carriers)
}

/// Finds the base and the measured points. `None` where positions or distances do not determine it.
///
/// Positions: the points believed on the tool are aligned with those seen; where they do not fit,
/// or are not known, base and points follow from a linear system, then in alternation. Distances:
/// each fixed point in the base's frame is linear in squared distances.
#[must_use]
pub fn find(profile: &Profile, measurements: &Measurements) -> Option<Start> {
    let (sights, names, carriers) = sights(profile, measurements);
    let seen: Vec<Vector> = sights.iter().map(|s| s.seen).collect();
    let spread = spreads(&seen);
    if sights.len() < 3 || spread[1] < FLAT * spread[0].max(1e-3) {
        return by_distances(profile, &bare_arm(profile), measurements);
    }
    let (placed, kept) = solve_without_gross(&sights, &carriers);
    // what columns say of a point is not what a person has looked at in the profile
    let mut rows = measurements.rows.iter();
    let least = if rows.any(|row| row.point_in_tool_m.is_some()) {
        NEAR_M
    } else {
        BELIEVED_M
    };
    let moved = moved(&kept, &carriers, &placed, least);
    let gaps = moved.iter().flatten().map(|by| Some(norm(*by)));
    let moved_m = match &moved {
        Some(_) => gaps.collect(),
        None => vec![None; names.len()],
    };
    let mountings = moved.map(|moved| mountings(&names, &carriers, &moved));
    let (turned, turned_apart_rad) = orientations(measurements, &sights, &names, &placed.base);
    Some(Start {
        points_on_flange_m: names.into_iter().zip(placed.points).collect(),
        moved_m,
        mountings: mountings.unwrap_or_default(),
        rms_m: placed.rms_m,
        believed_rms_m: placed.believed_rms_m,
        spread_m: norm(spread),
        turned,
        turned_apart_rad,
        ..Start::at(placed.base)
    })
}

/// The orientation of each tool on the flange by poses, and how far they are from it: of some rows
/// that which fits the others best.
fn orientations(
    measurements: &Measurements,
    sights: &[Sight],
    names: &[CarrierName],
    base: &Pose,
) -> (Vec<(String, Rotation)>, Option<f64>) {
    let mut by_tool: Vec<(String, Vec<Rotation>)> = Vec::new();
    let rows = measurements
        .rows
        .iter()
        .filter(|row| row.observed.point_m().is_some());
    for (row, sight) in rows.zip(sights) {
        if let Observed::Pose(pose) = row.observed {
            let tool = &names[sight.carrier].0;
            let frame = (*base * sight.flange).rotation.transpose() * pose.rotation;
            match by_tool.iter_mut().find(|(name, _)| name == tool) {
                Some((_, all)) => all.push(frame),
                None => by_tool.push((tool.clone(), vec![frame])),
            }
        }
    }
    let mut apart: Option<f64> = None;
    let turned = by_tool.into_iter().map(|(tool, frames)| {
        let angle_to = |own: &Rotation| {
            let mut angles: Vec<f64> = frames
                .iter()
                .map(|other| (own.transpose() * *other).angle())
                .collect();
            let middle = angles.len() / 2;
            *angles.select_nth_unstable_by(middle, f64::total_cmp).1
        };
        let every = (frames.len() / TRIED_ORIENTATIONS).max(1);
        let tried = frames
            .iter()
            .step_by(every)
            .map(|own| (angle_to(own), *own));
        let (angle, own) = tried
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .expect("a tool has rows");
        apart = Some(apart.map_or(angle, |before| before.max(angle)));
        (tool, own)
    });
    let turned = turned.collect();
    (turned, apart)
}

/// Distance of the two places of the base, metres, and the angle between, radians.
#[must_use]
pub fn base_gap(a: &Pose, b: &Pose) -> (f64, f64) {
    let gap = a.separation(b);
    (norm(sub(a.translation, b.translation)), gap.angle_rad)
}
