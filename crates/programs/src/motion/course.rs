//! The controller's path from one target to the next.
//!
//! Every path is written over [`Scalar`], so that it gives poses at a parameter s from 0 to 1 and,
//! with [`Jet`]s, bounds of slope and curvature over whole intervals of s.

use super::ride::Ride;
use crate::geometry::{
    Pose, Rotation, Scalar, Vector, add, constant, cross, dot, norm, scale, sub,
};
use std::sync::Arc;

/// Angles below this, radians, are no rotation; circles whose three points are as near to a line
/// are a line.
const SMALL: f64 = 1e-9;
/// Points as near to each other, metres, are one: no controller finds the plane of an arc from them.
const SAME_POINT_M: f64 = 1e-6;
/// Rotations as near to half a revolution are as long one way as the other.
const EITHER_WAY_RAD: f64 = 0.02;

/// How a straight or circular move rotates the tool on its path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ToolRotation {
    /// About one axis at a constant rate (quaternion slerp, two-angle method).
    #[default]
    Slerp,
    /// The three angles of `Rz(a) · Ry(b) · Rx(c)` each at a constant rate.
    Euler,
}

/// A path of the tool in the world.
#[derive(Clone, Debug)]
pub(crate) enum Course {
    /// Each joint at a constant rate.
    Joint {
        /// Joints where it begins, radians.
        from: [f64; 6],
        /// Joints where it ends.
        to: [f64; 6],
    },
    /// A straight line or an arc of the tool.
    Tool(ToolCourse),
}

/// A straight or circular path of the tool.
#[derive(Clone, Debug)]
pub(crate) struct ToolCourse {
    line: Line,
    turn: PathRotation,
    /// It is a line on a part that moves.
    ride: Option<Arc<Ride>>,
}

#[derive(Clone, Debug)]
enum Line {
    Straight {
        from: Vector,
        along: Vector,
    },
    Circle {
        centre: Vector,
        /// From the centre to where it begins, and a quarter of a turn on.
        axes: [Vector; 2],
        angle_rad: f64,
    },
}

#[derive(Clone, Debug)]
enum PathRotation {
    Axis {
        from: Rotation,
        axis: Vector,
        angle_rad: f64,
    },
    Angles {
        from: [f64; 3],
        by: [f64; 3],
    },
}

impl ToolCourse {
    /// The straight line, or the arc through a point; on what external axes carry meanwhile where
    /// they bend it.
    #[must_use]
    pub(crate) fn of(
        from: &Pose,
        via: Option<&Pose>,
        to: &Pose,
        turning: ToolRotation,
        ride: Option<Arc<Ride>>,
    ) -> Self {
        let moves = |ride: &Arc<Ride>| ride.bends() || (via.is_some() && ride.moves());
        let ride = ride.filter(moves);
        let on_part = |pose: &Pose, s: f64| match &ride {
            Some(ride) => ride.home_from_part(s).inverse() * *pose,
            None => *pose,
        };
        let (from, to) = (on_part(from, 0.0), on_part(to, 1.0));
        let course = match via {
            // halfway, as far as anybody knows
            Some(via) => Self::arc(&from, on_part(via, 0.5).translation, &to, turning),
            None => Self::straight(&from, &to, turning),
        };
        Self { ride, ..course }
    }

    /// The straight line.
    #[must_use]
    pub(crate) fn straight(from: &Pose, to: &Pose, turning: ToolRotation) -> Self {
        Self {
            line: Line::Straight {
                from: from.translation,
                along: sub(to.translation, from.translation),
            },
            turn: PathRotation::between(from, to, turning),
            ride: None,
        }
    }

    /// The arc through a point; a straight line where the three are on one.
    #[must_use]
    pub(crate) fn arc(from: &Pose, via: Vector, to: &Pose, turning: ToolRotation) -> Self {
        let start = from.translation;
        let (u, v) = (sub(via, start), sub(to.translation, start));
        let normal = cross(u, v);
        let squared = dot(normal, normal);
        if squared.sqrt() <= SMALL * norm(u) * norm(v) {
            return Self::straight(from, to, turning);
        }
        // circumcentre of three points, seen from the first
        let out = sub(
            scale(dot(u, u), cross(v, normal)),
            scale(dot(v, v), cross(u, normal)),
        );
        let to_centre = scale(0.5 / squared, out);
        let centre = add(start, to_centre);
        let first = scale(-1.0, to_centre);
        let unit = scale(squared.sqrt().recip(), normal);
        let second = cross(unit, first);
        let axes = [first, second];
        // the normal of start, via, end makes via come before the end
        let angle_rad = angle_on(&axes, sub(to.translation, centre));
        Self {
            line: Line::Circle {
                centre,
                axes,
                angle_rad,
            },
            turn: PathRotation::between(from, to, turning),
            ride: None,
        }
    }

    /// Whether no arc leads from a point through another to a third: two of them are one, or all lie on a
    /// line and the second not between the others.
    pub(super) fn is_no_arc(from: Vector, via: Vector, to: Vector) -> bool {
        let (u, v, w) = (sub(via, from), sub(to, from), sub(to, via));
        let normal = cross(u, v);
        let is_line = norm(normal) <= SMALL * norm(u) * norm(v);
        [u, v, w].iter().any(|apart| norm(*apart) < SAME_POINT_M)
            || is_line && (dot(u, v) < 0.0 || dot(v, w) < 0.0)
    }

    /// Length of the path of the tool, metres.
    #[must_use]
    pub(crate) fn length_m(&self) -> f64 {
        let carried = self.ride.as_ref().map_or(0.0, |ride| ride.lengths().0);
        carried
            + match &self.line {
                Line::Straight { along, .. } => norm(*along),
                Line::Circle {
                    axes, angle_rad, ..
                } => norm(axes[0]) * angle_rad,
            }
    }

    /// By how much the tool rotates, radians.
    #[must_use]
    pub(crate) fn rotation_rad(&self) -> f64 {
        match &self.turn {
            PathRotation::Axis { angle_rad, .. } => angle_rad.abs(),
            PathRotation::Angles { by, .. } => by.iter().map(|angle| angle.abs()).sum(),
        }
    }

    /// By how much the tool turns, or the arc goes round, radians.
    #[must_use]
    pub(crate) fn angle_rad(&self) -> f64 {
        let turned = self.rotation_rad();
        let carried = self.ride.as_ref().map_or(0.0, |ride| ride.lengths().1);
        match &self.line {
            Line::Straight { .. } => turned + carried,
            Line::Circle { angle_rad, .. } => turned + angle_rad + carried,
        }
    }

    /// The part of the path, 0 to 1, at a point that lies on it.
    #[must_use]
    pub(super) fn part_at(&self, point: Vector) -> f64 {
        match &self.line {
            Line::Straight { from, along } => {
                let squared = dot(*along, *along);
                if squared == 0.0 {
                    return 0.0;
                }
                (dot(sub(point, *from), *along) / squared).clamp(0.0, 1.0)
            }
            Line::Circle {
                centre,
                axes,
                angle_rad,
            } => angle_on(axes, sub(point, *centre)) / angle_rad,
        }
    }

    /// The rotation of the tool at the point of the path that is nearest to one. Of a path that
    /// external axes bend both are seen from what they carry.
    #[must_use]
    pub(crate) fn rotation_at(&self, point: Vector) -> Rotation {
        self.pose(self.part_at(point)).rotation
    }

    /// Whether external axes bend the path.
    #[must_use]
    pub(crate) fn is_bent(&self) -> bool {
        self.ride.is_some()
    }

    /// The rotation at a part of an arc where the tool turns as seen from the path, the shorter way
    /// there; `None` where both ways are as short, or the tool ends as it began: nobody means a
    /// whole turn.
    #[must_use]
    pub(super) fn rotation_on_path(&self, s: f64, to: &Rotation) -> Option<Rotation> {
        let (
            Line::Circle {
                axes, angle_rad, ..
            },
            PathRotation::Axis { from, .. },
        ) = (&self.line, &self.turn)
        else {
            return None;
        };
        let world = *to * from.transpose();
        if world.angle() < EITHER_WAY_RAD {
            return None;
        }
        let normal = cross(axes[0], axes[1]);
        let normal = scale(norm(normal).recip(), normal);
        let seen = about(&normal, -angle_rad) * world;
        let by = seen.vector();
        let is_clear = (norm(by) - std::f64::consts::PI).abs() > EITHER_WAY_RAD;
        is_clear
            .then(|| about(&normal, angle_rad * s) * Rotation::from_vector(scale(s, by)) * *from)
    }

    /// The rotation at a part of the path where the tool turns the longer way, and by how much it
    /// turns the shorter one, radians.
    pub(super) fn long_way(&self, s: f64) -> Option<(Rotation, f64)> {
        let PathRotation::Axis {
            from,
            axis,
            angle_rad,
        } = &self.turn
        else {
            return None;
        };
        let round = angle_rad - std::f64::consts::TAU;
        Some((about(axis, round * s) * *from, *angle_rad))
    }

    /// Whether it is an arc.
    #[must_use]
    pub(crate) fn is_arc(&self) -> bool {
        matches!(self.line, Line::Circle { .. })
    }

    /// The tool at `s`.
    #[must_use]
    pub fn pose<S: Scalar>(&self, s: S) -> Pose<S> {
        let k = S::constant;
        let translation = match &self.line {
            Line::Straight { from, along } => add(constant(*from), scale(s, constant(*along))),
            Line::Circle {
                centre,
                axes,
                angle_rad,
            } => {
                let (sine, cosine) = (k(*angle_rad) * s).sin_cos();
                let across = add(
                    scale(cosine, constant(axes[0])),
                    scale(sine, constant(axes[1])),
                );
                add(constant(*centre), across)
            }
        };
        let rotation = match &self.turn {
            PathRotation::Axis {
                from,
                axis,
                angle_rad,
            } => {
                if *angle_rad == 0.0 {
                    from.cast()
                } else {
                    about(axis, k(*angle_rad) * s) * from.cast()
                }
            }
            PathRotation::Angles { from, by } => {
                let angle = |i: usize| k(from[i]) + k(by[i]) * s;
                Rotation::about_z(angle(0))
                    * Rotation::about_y(angle(1))
                    * Rotation::about_x(angle(2))
            }
        };
        let pose = Pose {
            rotation,
            translation,
        };
        match &self.ride {
            None => pose,
            Some(ride) => ride.home_from_part(s) * pose,
        }
    }
}

/// The angle from the first axis to a direction in the plane of both, 0 to 2 pi.
fn angle_on(axes: &[Vector; 2], seen: Vector) -> f64 {
    let angle = dot(seen, axes[1]).atan2(dot(seen, axes[0]));
    angle.rem_euclid(std::f64::consts::TAU)
}

/// Rotation about a unit axis (O. Rodrigues).
fn about<S: Scalar>(axis: &Vector, angle: S) -> Rotation<S> {
    let (sine, cosine) = angle.sin_cos();
    let rest = S::one() - cosine;
    let [x, y, z] = constant::<S>(*axis);
    Rotation([
        [
            cosine + rest * x * x,
            rest * x * y - sine * z,
            rest * x * z + sine * y,
        ],
        [
            rest * x * y + sine * z,
            cosine + rest * y * y,
            rest * y * z - sine * x,
        ],
        [
            rest * x * z - sine * y,
            rest * y * z + sine * x,
            cosine + rest * z * z,
        ],
    ])
}

impl PathRotation {
    fn between(from: &Pose, to: &Pose, turning: ToolRotation) -> Self {
        match turning {
            ToolRotation::Slerp => {
                let [w, x, y, z] = (to.rotation * from.rotation.transpose()).quaternion().0;
                let long = norm([x, y, z]);
                if long < SMALL {
                    return Self::Axis {
                        from: from.rotation,
                        axis: [0.0, 0.0, 1.0],
                        angle_rad: 0.0,
                    };
                }
                // the shorter way
                let side = if w < 0.0 { -1.0 } else { 1.0 };
                Self::Axis {
                    from: from.rotation,
                    axis: scale(side / long, [x, y, z]),
                    angle_rad: 2.0 * long.atan2(w.abs()),
                }
            }
            ToolRotation::Euler => {
                let (from, to) = (from.rotation.rzryrx(0.0), to.rotation.rzryrx(0.0));
                let turn = std::f64::consts::TAU;
                let by = std::array::from_fn(|i| {
                    let by = to[i] - from[i];
                    by - turn * (by / turn).round()
                });
                Self::Angles { from, by }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(p: [f64; 6]) -> Pose {
        Pose::from_xyz_rxryrz(p)
    }

    #[test]
    fn paths_begin_and_end_at_their_targets_and_arcs_pass_through_their_point() {
        let (a, b) = (
            pose([0.1, 0.2, 0.3, 0.1, 0.2, 0.3]),
            pose([0.5, -0.2, 0.4, 1.1, -0.4, 0.9]),
        );
        let via = [0.4, 0.3, 0.2];
        for turning in [ToolRotation::Slerp, ToolRotation::Euler] {
            for course in [
                ToolCourse::straight(&a, &b, turning),
                ToolCourse::arc(&a, via, &b, turning),
            ] {
                for (s, end) in [(0.0, &a), (1.0, &b)] {
                    let gap = course.pose(s).separation(end);
                    assert!(gap.distance_m < 1e-12 && gap.angle_rad < 1e-12, "{gap:?}");
                }
            }
        }
        let arc = ToolCourse::arc(&a, via, &b, ToolRotation::Slerp);
        let nearest = (0..=100_000)
            .map(|k| norm(sub(arc.pose(f64::from(k) / 1e5).translation, via)))
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-5, "{nearest}");
    }

    #[test]
    fn three_points_on_a_line_make_a_line() {
        let (a, b) = (pose([0.0; 6]), pose([1.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
        let arc = ToolCourse::arc(&a, [0.4, 0.0, 0.0], &b, ToolRotation::Slerp);
        assert!(!arc.is_arc());
        assert!((arc.length_m() - 1.0).abs() < 1e-12);
        assert!(!ToolCourse::is_no_arc(
            [0.0; 3],
            [0.4, 0.0, 0.0],
            [1.0, 0.0, 0.0]
        ));
    }

    #[test]
    fn two_points_in_one_or_a_second_behind_the_others_are_no_arc() {
        let (a, b, via) = ([0.1, 0.2, 0.3], [0.5, 0.2, 0.3], [0.3, 0.4, 0.3]);
        for [from, via, to] in [
            [a, a, b],
            [a, b, b],
            [a, via, a],
            [a, a, a],
            [a, [0.6, 0.2, 0.3], b],
            [a, [0.0, 0.2, 0.3], b],
        ] {
            assert!(
                ToolCourse::is_no_arc(from, via, to),
                "{from:?} {via:?} {to:?}"
            );
        }
        assert!(!ToolCourse::is_no_arc(a, via, b));
        // nearly a whole circle
        assert!(!ToolCourse::is_no_arc(a, via, [0.1, 0.2001, 0.3]));
    }
}
