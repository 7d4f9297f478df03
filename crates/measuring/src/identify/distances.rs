//! Where the base stands by distances from points of a device that stand still.

use super::measurements::{Measurements, Observed};
use super::start::{Start, align, carried, deviation, spreads};
use crate::geometry::{Pose, Rotation, Vector, add, cross, dot, norm, scale, sub};
use crate::model::{Conditions, Model};
use crate::profile::{Mounted, Profile};
use nalgebra::Matrix4;

/// The least rotation between two directions.
fn least_rotation(from: Vector, to: Vector) -> Rotation {
    let (from, to) = (scale(norm(from).recip(), from), scale(norm(to).recip(), to));
    let axis = cross(from, to);
    let sine = norm(axis);
    if sine < 1e-12 {
        return Rotation::identity();
    }
    Rotation::from_vector(scale(sine.atan2(dot(from, to)) / sine, axis))
}

/// A device's fixed points in the base's frame by their distances, then the base by aligning them.
pub(super) fn by_distances(
    profile: &Profile,
    arm: &Model,
    measurements: &Measurements,
) -> Option<Start> {
    let mut fixed: Vec<(Vector, Vec<(Vector, f64)>)> = Vec::new();
    for row in &measurements.rows {
        let Observed::Distance { distance_m, from_m } = row.observed else {
            continue;
        };
        let tool = row
            .tool
            .as_deref()
            .or_else(|| profile.tools.keys().next().map(String::as_str));
        let tool = tool
            .and_then(|t| profile.tool(t))
            .unwrap_or_else(Mounted::flange);
        let flange = carried(profile, &row.stand) * arm.forward(&row.q, &Conditions::default());
        let named = row
            .point
            .as_ref()
            .and_then(|p| profile.points.get(p).copied());
        let point = row.point_in_tool_m.or(named).unwrap_or_default();
        let at = (flange * tool.flange_from_tool).transform(point);
        match fixed.iter_mut().find(|(from, _)| *from == from_m) {
            Some((_, all)) => all.push((at, distance_m)),
            None => fixed.push((from_m, vec![(at, distance_m)])),
        }
    }
    let mut pairs = Vec::new();
    for (from, all) in &fixed {
        let spread = spreads(&all.iter().map(|(s, _)| *s).collect::<Vec<_>>());
        if all.len() < 5 || spread[2] < 1e-3 {
            continue;
        }
        // d² = |s|² − 2 s·f + |f|²
        let mut normal = Matrix4::<f64>::zeros();
        let mut right = nalgebra::Vector4::<f64>::zeros();
        for (s, d) in all {
            let line = nalgebra::Vector4::new(-2.0 * s[0], -2.0 * s[1], -2.0 * s[2], 1.0);
            normal += line * line.transpose();
            right += line * (d * d - dot(*s, *s));
        }
        let f = normal.cholesky()?.solve(&right);
        pairs.push(([f[0], f[1], f[2]], *from));
    }
    let world: Vec<Vector> = pairs.iter().map(|(_, b)| *b).collect();
    let world_from_base = match pairs[..] {
        [] => return None,
        [_, _, _, ..] if spreads(&world)[1] > 1e-3 => align(pairs.iter().copied()),
        // too few fixed points for a rotation: the profile's, turned as little as two of them ask
        // for
        _ => {
            let mut rotation = profile.world_from_base.rotation;
            if let [(a, b), (c, d), ..] = pairs[..]
                && norm(sub(c, a)) > 1e-3
            {
                rotation = least_rotation(rotation * sub(c, a), sub(d, b)) * rotation;
            }
            let shifts = pairs.iter().map(|(a, b)| sub(*b, rotation * *a));
            let sum = shifts.fold([0.0; 3], add);
            Pose {
                rotation,
                translation: scale(1.0 / pairs.len() as f64, sum),
            }
        }
    };
    let (mut gaps, mut distances) = (Vec::new(), Vec::new());
    for (from, all) in &fixed {
        for (at, distance_m) in all {
            gaps.push(norm(sub(world_from_base.transform(*at), *from)) - distance_m);
            distances.push(*distance_m);
        }
    }
    let squares: f64 = gaps.iter().map(|gap| gap * gap).sum();
    Some(Start {
        rms_m: (squares / gaps.len() as f64).sqrt(),
        spread_m: deviation(&distances),
        fixed_points: measurements
            .rows
            .iter()
            .all(|row| row.contact.is_none())
            .then_some(pairs.len()),
        ..Start::at(world_from_base)
    })
}
