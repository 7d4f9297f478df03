//! The 3-2-1 frame of a part.

use super::{FrameError, NEAR_LINE, from_axes, unit};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Vector, add, cross, dot, norm, scale, sub};
use crate::register::features::{self, Plane};

/// Touches of the three datums of a part, centres of the probe's ball, metres.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Datums {
    /// At least three on the primary plane: z points out of the part.
    pub primary_m: Vec<Vector>,
    /// Out of the part, roughly, where that is known.
    pub primary_outward: Option<Vector>,
    /// At least two on the secondary plane; the part lies on its +y side.
    pub secondary_m: Vec<Vector>,
    /// Out of the part, roughly, where that is known.
    pub secondary_outward: Option<Vector>,
    /// At least one on the tertiary plane; the part lies on its +x side.
    pub tertiary_m: Vec<Vector>,
}

/// The 3-2-1 frame: z is the primary plane's normal, x the direction of the secondary touches in
/// it, the origin where the three datum planes meet. The probe's ball stands outside the part:
/// above the primary, before the secondary in −y and the tertiary in −x.
///
/// Which of the two directions of z and x are meant say outward directions, where they are given.
/// Else the touches do, in any order: those of the other two datums lie on the part's side of each.
///
/// # Errors
/// Too few touches, touches that leave a direction open, or touches on the side of a datum on which
/// the part is not.
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
    let across = |v: Vector| sub(v, scale(dot(primary.normal, v), primary.normal));
    let s = &touches.secondary_m;
    let span = sub(s[s.len() - 1], s[0]);
    // a line in the primary plane: at which height each was touched does not tilt it
    let flat: Vec<Vector> = s.iter().map(|p| across(sub(*p, s[0]))).collect();
    let (_, axes) = features::extents(&flat);
    let (along, reach) = match s.len() {
        2 => (across(span), norm(span)),
        _ => (
            scale(dot(axes[0].1, span).signum() * axes[0].0, axes[0].1),
            features::extents(s).1[0].0,
        ),
    };
    let along = unit(
        "the last secondary touch",
        "the first, along the primary plane",
        along,
        reach.max(f64::MIN_POSITIVE),
    )?;
    let middle = mean(s);
    let corner = Corner {
        touches,
        primary,
        along,
        middle,
        probe_radius_m,
    };
    corner.frame()
}

/// The datums of a part, without the directions of z and x.
struct Corner<'a> {
    touches: &'a Datums,
    primary: Plane,
    /// Along the secondary touches and the primary plane, unit.
    along: Vector,
    /// Of the secondary touches.
    middle: Vector,
    probe_radius_m: f64,
}

impl Corner<'_> {
    fn frame(&self) -> Result<Pose, FrameError> {
        let toward = |outward: Option<Vector>, v: Vector| outward.map(|o| dot(o, v).signum());
        let up = toward(self.touches.primary_outward, self.primary.normal);
        let sign = |known: Option<f64>| match known {
            Some(sign) => vec![sign],
            None => vec![1.0, -1.0],
        };
        let mut frames = Vec::new();
        for up in sign(up) {
            // −y is where the secondary datum faces
            let back = cross(self.along, scale(up, self.primary.normal));
            let right = toward(self.touches.secondary_outward, back);
            frames.extend(sign(right).into_iter().map(|right| self.with(up, right)));
        }
        if let [only] = frames[..] {
            return Ok(only);
        }
        let fitting: Vec<&Pose> = frames.iter().filter(|f| self.wrong(f).is_none()).collect();
        if let [only] = fitting[..] {
            return Ok(*only);
        }
        // the order in which datums are touched by custom says best what is exchanged
        let usual = self.with(up.unwrap_or(self.around()), 1.0);
        let said = self.wrong(&usual).or_else(|| self.wrong(&frames[0]));
        said.map_or(Ok(usual), Err)
    }

    /// The sign of the primary normal from whose tip its touches in order go counter-clockwise.
    fn around(&self) -> f64 {
        let p = &self.touches.primary_m;
        let next = p.iter().cycle().skip(1);
        let arm = |p: &Vector| sub(*p, self.primary.centre_m);
        let each = p.iter().zip(next);
        let areas = each.map(|(a, b)| dot(cross(arm(a), arm(b)), self.primary.normal));
        areas.sum::<f64>().signum()
    }

    /// The frame with z along or against the primary plane's normal, x along or against the
    /// secondary touches.
    fn with(&self, up: f64, right: f64) -> Pose {
        let (z, x) = (scale(up, self.primary.normal), scale(right, self.along));
        let y = cross(z, x);
        let height = dot(z, self.primary.centre_m) - self.probe_radius_m;
        let front = dot(y, self.middle) + self.probe_radius_m;
        let left = dot(x, mean(&self.touches.tertiary_m)) + self.probe_radius_m;
        let origin = add(add(scale(left, x), scale(front, y)), scale(height, z));
        from_axes(x, z, origin)
    }

    /// The datum that has touches of the others farthest on the side where the part is not.
    fn wrong(&self, frame: &Pose) -> Option<FrameError> {
        let to_part = frame.inverse();
        let Datums {
            primary_m: one,
            secondary_m: two,
            tertiary_m: three,
            ..
        } = self.touches;
        let places = [one, two, three].map(|touches| {
            let places = touches.iter().map(|touch| to_part.transform(*touch));
            places.collect::<Vec<_>>()
        });
        let reach = places.iter().flatten().map(|p| norm(*p));
        let limit = NEAR_LINE * reach.fold(0.0, f64::max);
        let (mut worst, mut worst_m) = (None, 0.0);
        for (datum, (axis, sign)) in [(2, -1.0), (1, 1.0), (0, 1.0)].into_iter().enumerate() {
            let others = places.iter().enumerate().filter(|(of, _)| *of != datum);
            let each = others.flat_map(|(of, places)| {
                let outside = move |p: &Vector| -sign * p[axis];
                let each = places.iter().map(outside).enumerate();
                each.map(move |(index, off)| (off, (of, index)))
            });
            let off: Vec<_> = each.filter(|(off, _)| *off > limit).collect();
            let most = off.iter().map(|(off, _)| *off).fold(0.0, f64::max);
            if most > worst_m {
                worst_m = most;
                worst = Some(FrameError::OtherSide {
                    datum,
                    touches: off.into_iter().map(|(_, touch)| touch).collect(),
                    off_mm: mm_from_m(most),
                    limit_mm: mm_from_m(limit),
                });
            }
        }
        worst
    }
}

#[allow(clippy::cast_precision_loss)]
fn mean(points: &[Vector]) -> Vector {
    let sum = points.iter().fold([0.0; 3], |sum, p| add(sum, *p));
    scale(1.0 / points.len() as f64, sum)
}
