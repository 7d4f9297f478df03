//! The 3-2-1 frame of a part.

use super::{FrameError, from_axes, unit};
use crate::geometry::{Pose, Vector, add, cross, dot, norm, scale, sub};
use crate::register::features::{self, Plane};

/// Touches of the three datums of a part, centres of the probe's ball, metres.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Datums {
    /// At least three on the primary plane, counter-clockwise seen from outside: z points out of
    /// the part. The first three count; where they lie nearly in a line, the order of all.
    pub primary_m: Vec<Vector>,
    /// Out of the part, roughly, where that is known: then the order of the touches does not count.
    pub primary_outward: Option<Vector>,
    /// At least two on the secondary plane, in the order of +x; the part lies on its +y side.
    pub secondary_m: Vec<Vector>,
    /// At least one on the tertiary plane; the part lies on its +x side.
    pub tertiary_m: Vec<Vector>,
}

/// The first three touches show the outer side where their triangle is larger than this part of the
/// product of the extents of all: a triangle alone has 2.6, the sides of a rectangle 4.
const FIRST_THREE: f64 = 0.1;
/// All touches in order show it where what they go round is larger than this part.
const ALL: f64 = 0.5;

/// The sign of a primary plane's normal that points out of the part.
fn outer_side(touches: &Datums, primary: &Plane) -> Result<f64, FrameError> {
    if let Some(outward) = touches.primary_outward {
        return Ok(dot(outward, primary.normal).signum());
    }
    let p = &touches.primary_m;
    let (centre, [(long, _), (short, _), _]) = features::extents(p);
    // twice the signed area, seen against the normal, of a line that goes round and back
    let round = |p: &[Vector]| -> f64 {
        let next = p.iter().cycle().skip(1);
        let each = p.iter().zip(next);
        each.map(|(a, b)| dot(cross(sub(*a, centre), sub(*b, centre)), primary.normal))
            .sum()
    };
    let limits = [(&p[..3], FIRST_THREE), (&p[..], ALL)];
    // extents are those of sums over the touches
    #[allow(clippy::cast_precision_loss)]
    let spread = 2.0 * long * short / p.len() as f64;
    let parts = limits.map(|(p, limit)| (round(p) / spread, limit));
    let clear = parts.iter().find(|(part, limit)| part.abs() > *limit);
    clear
        .map(|(part, _)| part.signum())
        .ok_or(FrameError::Order {
            part: parts[1].0.abs(),
            limit: ALL,
        })
}

/// The 3-2-1 frame: z is the primary plane's normal, x the direction of the secondary touches in
/// it, the origin where the three datum planes meet. The probe's ball stands outside the part:
/// above the primary, before the secondary in −y and the tertiary in −x.
///
/// # Errors
/// Too few touches, or touches that leave a direction open.
pub fn three_two_one(touches: &Datums, probe_radius_m: f64) -> Result<Pose, FrameError> {
    let counts = [
        ("the primary datum", touches.primary_m.len(), 3),
        ("the secondary datum", touches.secondary_m.len(), 2),
        ("the tertiary datum", touches.tertiary_m.len(), 1),
    ];
    for (datum, found, needed) in counts {
        if found < needed {
            return Err(FrameError::TooFew {
                datum,
                found,
                needed,
            });
        }
    }
    let primary = features::plane(&touches.primary_m).map_err(|error| FrameError::Feature {
        datum: "the primary datum",
        error,
    })?;
    let z = scale(outer_side(touches, &primary)?, primary.normal);
    let across = |v: Vector| sub(v, scale(dot(z, v), z));
    let s = &touches.secondary_m;
    let (middle, axes) = features::extents(s);
    let span = sub(s[s.len() - 1], s[0]);
    let direction = if s.len() == 2 {
        span
    } else {
        scale(dot(axes[0].1, span).signum(), axes[0].1)
    };
    let reach = norm(span);
    let x = unit(
        "the last secondary touch",
        "the first, along the primary plane",
        scale(if s.len() == 2 { 1.0 } else { reach }, across(direction)),
        reach.max(f64::MIN_POSITIVE),
    )?;
    let y = cross(z, x);
    #[allow(clippy::cast_precision_loss)]
    let mean = |points: &[Vector]| {
        let sum = points.iter().fold([0.0; 3], |sum, p| add(sum, *p));
        scale(1.0 / points.len() as f64, sum)
    };
    let height = dot(z, primary.centre_m) - probe_radius_m;
    let front = dot(y, middle) + probe_radius_m;
    let left = dot(x, mean(&touches.tertiary_m)) + probe_radius_m;
    let origin = add(add(scale(left, x), scale(front, y)), scale(height, z));
    Ok(from_axes(x, z, origin))
}
