//! Distances between convex bodies. The only file that knows parry.
//!
//! Segments with a radius (capsules, spheres) are met in closed form; everything else by the
//! algorithm of Gilbert, Johnson and Keerthi. What the latter finds is only used as a direction:
//! the distance that is reported is the width of the gap between two parallel planes that separate
//! the bodies, which never is more than their distance, however well the search converged.
//!
//! # Source
//! C. Ericson, "Real-Time Collision Detection" (2005), 5.1.9 (segments); E. Gilbert, D. Johnson, S.
//! Keerthi (1988).

use crate::geometry::{Pose, Vector, add, cross, dot, norm, scale, sub};
use parry::bounding_volume::Aabb;
use parry::math::Vector as Glam;
use parry::partitioning::{Bvh, BvhBuildStrategy};
use parry::query::ClosestPoints;
use parry::query::details::closest_points_support_map_support_map;
use parry::shape::SupportMap;

/// A convex body in the frame of what carries it: all points within a radius of its core, metres.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Body {
    core: Core,
    radius_m: f64,
    /// A ball that holds it: centre and radius.
    ball: (Vector, f64),
}

#[derive(Clone, Debug, PartialEq)]
enum Core {
    Segment([Vector; 2]),
    Triangle([Vector; 3]),
    /// Corners of a convex hull.
    Points(Vec<Vector>),
    Cylinder {
        centre: Vector,
        axis: Vector,
        half_m: f64,
        radius_m: f64,
    },
    /// All points below a plane.
    Plane {
        normal: Vector,
        offset_m: f64,
    },
}

/// Two bodies' nearest points, in the frame of the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nearest {
    /// Lower bound of the distance, metres, exact to rounding; 0 where they touch or overlap.
    pub distance_m: f64,
    /// On the first body.
    pub on_a: Vector,
    /// On the second.
    pub on_b: Vector,
    /// Unit vector from the first to the second; zero where they touch.
    pub normal: Vector,
}

fn glam(v: Vector) -> Glam {
    Glam::new(v[0], v[1], v[2])
}

fn array(v: Glam) -> Vector {
    [v.x, v.y, v.z]
}

/// The point farthest along a direction.
fn farthest(points: &[Vector], direction: Vector) -> Vector {
    let mut best = (f64::NEG_INFINITY, points[0]);
    for point in points {
        let along = dot(*point, direction);
        if along > best.0 {
            best = (along, *point);
        }
    }
    best.1
}

impl Core {
    fn support(&self, direction: Vector) -> Vector {
        match self {
            Self::Segment(points) => farthest(points, direction),
            Self::Triangle(points) => farthest(points, direction),
            Self::Points(points) => farthest(points, direction),
            Self::Cylinder {
                centre,
                axis,
                half_m,
                radius_m,
            } => {
                let along = dot(*axis, direction);
                let across = sub(direction, scale(along, *axis));
                let long = norm(across);
                let out = if long > 1e-12 {
                    scale(radius_m / long, across)
                } else {
                    [0.0; 3]
                };
                add(*centre, add(scale(half_m.copysign(along), *axis), out))
            }
            Self::Plane { .. } => unreachable!("a plane is met in closed form"),
        }
    }
}

impl SupportMap for Core {
    fn local_support_point(&self, direction: Glam) -> Glam {
        glam(self.support(array(direction)))
    }
}

impl Body {
    fn of(core: Core, radius_m: f64) -> Self {
        let ball = match &core {
            Core::Plane { .. } => ([0.0; 3], f64::INFINITY),
            Core::Cylinder {
                centre,
                half_m,
                radius_m,
                ..
            } => (*centre, half_m.hypot(*radius_m)),
            Core::Segment(points) => around(points),
            Core::Triangle(points) => around(points),
            Core::Points(points) => around(points),
        };
        Self {
            core,
            radius_m,
            ball: (ball.0, ball.1 + radius_m),
        }
    }

    /// All points within a radius of a segment; a ball where its ends are one.
    #[must_use]
    pub(crate) fn capsule(from: Vector, to: Vector, radius_m: f64) -> Self {
        Self::of(Core::Segment([from, to]), radius_m)
    }

    /// A triangle.
    #[must_use]
    pub(crate) fn triangle(corners: [Vector; 3]) -> Self {
        Self::of(Core::Triangle(corners), 0.0)
    }

    /// The convex hull of points. At least one is needed.
    #[must_use]
    pub(crate) fn hull(points: &[Vector]) -> Self {
        let all: Vec<Glam> = points.iter().copied().map(glam).collect();
        // flat or broken sets have no hull with a volume; their points do as well
        let corners = parry::transformation::try_convex_hull(&all).map_or_else(
            |_| points.to_vec(),
            |hull| hull.0.into_iter().map(array).collect(),
        );
        Self::of(Core::Points(corners), 0.0)
    }

    /// A box of these full edge lengths about the origin of `place`.
    #[must_use]
    pub(crate) fn cuboid(size: Vector, place: &Pose) -> Self {
        let corner = |i: usize| {
            let side = |axis: usize| {
                let half = 0.5 * size[axis];
                if i >> axis & 1 == 0 { -half } else { half }
            };
            place.transform([side(0), side(1), side(2)])
        };
        Self::of(Core::Points((0..8).map(corner).collect()), 0.0)
    }

    /// A cylinder about the z axis of `place`, centred.
    #[must_use]
    pub(crate) fn cylinder(radius_m: f64, height_m: f64, place: &Pose) -> Self {
        let core = Core::Cylinder {
            centre: place.translation,
            axis: place.rotation.axis(2),
            half_m: 0.5 * height_m,
            radius_m,
        };
        Self::of(core, 0.0)
    }

    /// All points below a plane with this unit normal.
    #[must_use]
    pub(crate) fn plane(normal: Vector, offset_m: f64) -> Self {
        Self::of(Core::Plane { normal, offset_m }, 0.0)
    }

    /// Centre and radius of a ball that holds the body.
    #[must_use]
    pub(crate) fn ball(&self) -> (Vector, f64) {
        self.ball
    }

    /// The body is at least so far from a point of its own frame: exactly so where it is a capsule.
    /// Negative inside.
    #[must_use]
    pub(crate) fn least_distance(&self, point: Vector) -> f64 {
        match &self.core {
            Core::Segment([from, to]) => {
                let (along, here) = (sub(*to, *from), sub(point, *from));
                let part = dot(here, along) / dot(along, along).max(f64::MIN_POSITIVE);
                norm(sub(here, scale(part.clamp(0.0, 1.0), along))) - self.radius_m
            }
            _ => norm(sub(point, self.ball.0)) - self.ball.1,
        }
    }

    /// Largest distance of its points from the origin of its frame.
    #[must_use]
    pub(crate) fn extent(&self) -> f64 {
        norm(self.ball.0) + self.ball.1
    }

    /// A point of the body.
    #[must_use]
    pub(crate) fn some_point(&self) -> Vector {
        match &self.core {
            Core::Segment([a, _]) | Core::Triangle([a, ..]) => *a,
            Core::Points(points) => {
                let sum = points.iter().fold([0.0; 3], |sum, p| add(sum, *p));
                scale((points.len() as f64).recip(), sum)
            }
            Core::Cylinder { centre, .. } => *centre,
            Core::Plane { normal, offset_m } => scale(*offset_m, *normal),
        }
    }

    /// The largest coordinate of its points along a unit direction.
    #[inline]
    #[must_use]
    pub(crate) fn support(&self, direction: Vector) -> f64 {
        match &self.core {
            // unbounded but straight down
            Core::Plane { normal, offset_m } => {
                if dot(*normal, direction) > 1.0 - 1e-12 {
                    *offset_m
                } else {
                    f64::INFINITY
                }
            }
            core => dot(core.support(direction), direction) + self.radius_m,
        }
    }

    /// The largest coordinate along a unit direction `n` (in frame b) of its points placed by
    /// `b_from_a`.
    #[inline]
    #[must_use]
    pub(crate) fn support_placed(&self, b_from_a: &Pose, n: Vector) -> f64 {
        self.support(b_from_a.rotation.transpose() * n) + dot(n, b_from_a.translation)
    }

    /// Nearest points of this body, placed by `b_from_a`, and `b`, in the frame of `b`.
    #[must_use]
    pub(crate) fn nearest(&self, b_from_a: &Pose, b: &Self) -> Nearest {
        let placed = |point: Vector| b_from_a.transform(point);
        let (on_a, on_b) = match (&self.core, &b.core) {
            (_, Core::Plane { normal, offset_m }) => {
                let down = b_from_a.rotation.transpose() * scale(-1.0, *normal);
                let low = placed(self.core.support(down));
                let above = dot(low, *normal) - offset_m;
                (low, sub(low, scale(above.max(0.0), *normal)))
            }
            (Core::Segment(p), Core::Segment(q)) => segments(p.map(placed), *q),
            (Core::Segment(p), Core::Triangle(t)) => segment_triangle(p.map(placed), t),
            (a, other) => {
                let [w, x, y, z] = b_from_a.rotation.quaternion().0;
                let pose = parry::math::Pose {
                    rotation: glamx::DQuat::from_xyzw(x, y, z, w),
                    translation: glam(b_from_a.translation),
                };
                match closest_points_support_map_support_map(&pose, other, a, f64::MAX) {
                    ClosestPoints::WithinMargin(p, q) => (placed(array(q)), array(p)),
                    ClosestPoints::Intersecting | ClosestPoints::Disjoint => {
                        let middle = placed(self.some_point());
                        (middle, middle)
                    }
                }
            }
        };
        self.gap(b_from_a, b, on_a, on_b)
    }

    /// The gap along the line of two points of the cores.
    fn gap(&self, b_from_a: &Pose, b: &Self, on_a: Vector, on_b: Vector) -> Nearest {
        let between = sub(on_b, on_a);
        let long = norm(between);
        let touching = Nearest {
            distance_m: 0.0,
            on_a,
            on_b,
            normal: [0.0; 3],
        };
        if long < 1e-12 {
            return touching;
        }
        let normal = match &b.core {
            Core::Plane { normal, .. } => scale(-1.0, *normal),
            _ => scale(long.recip(), between),
        };
        let distance_m = -b.support(scale(-1.0, normal)) - self.support_placed(b_from_a, normal);
        if distance_m <= 0.0 {
            return touching;
        }
        Nearest {
            distance_m,
            on_a: add(on_a, scale(self.radius_m, normal)),
            on_b: sub(on_b, scale(b.radius_m, normal)),
            normal,
        }
    }
}

/// The middle of the points' box and their largest distance from it.
fn around(points: &[Vector]) -> (Vector, f64) {
    let centre = std::array::from_fn(|i| {
        let low = points.iter().map(|p| p[i]).fold(f64::INFINITY, f64::min);
        let high = points
            .iter()
            .map(|p| p[i])
            .fold(f64::NEG_INFINITY, f64::max);
        0.5 * (low + high)
    });
    let far = points.iter().map(|p| norm(sub(*p, centre)));
    (centre, far.fold(0.0, f64::max))
}

/// Nearest points of two segments.
fn segments(p: [Vector; 2], q: [Vector; 2]) -> (Vector, Vector) {
    let (u, v, w) = (sub(p[1], p[0]), sub(q[1], q[0]), sub(p[0], q[0]));
    let (a, e, f) = (dot(u, u), dot(v, v), dot(v, w));
    let tiny = 1e-24;
    let (s, t);
    if a <= tiny && e <= tiny {
        (s, t) = (0.0, 0.0);
    } else if a <= tiny {
        (s, t) = (0.0, (f / e).clamp(0.0, 1.0));
    } else {
        let c = dot(u, w);
        if e <= tiny {
            (s, t) = ((-c / a).clamp(0.0, 1.0), 0.0);
        } else {
            let b = dot(u, v);
            let det = a * e - b * b;
            let first = if det > 1e-14 * a * e {
                ((b * f - c * e) / det).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let second = (b * first + f) / e;
            (s, t) = if second < 0.0 {
                ((-c / a).clamp(0.0, 1.0), 0.0)
            } else if second > 1.0 {
                (((b - c) / a).clamp(0.0, 1.0), 1.0)
            } else {
                (first, second)
            };
        }
    }
    (add(p[0], scale(s, u)), add(q[0], scale(t, v)))
}

/// Nearest points of a segment and a triangle.
fn segment_triangle(p: [Vector; 2], t: &[Vector; 3]) -> (Vector, Vector) {
    let mut best = (f64::INFINITY, p[0], t[0]);
    let mut consider = |a: Vector, b: Vector| {
        let gap = sub(a, b);
        let squared = dot(gap, gap);
        if squared < best.0 {
            best = (squared, a, b);
        }
    };
    let normal = cross(sub(t[1], t[0]), sub(t[2], t[0]));
    let inside = |point: Vector| {
        (0..3).all(|i| {
            let edge = sub(t[(i + 1) % 3], t[i]);
            dot(cross(edge, sub(point, t[i])), normal) >= 0.0
        })
    };
    let squared = dot(normal, normal);
    let heights = p.map(|point| dot(sub(point, t[0]), normal));
    if (heights[0] > 0.0) != (heights[1] > 0.0) {
        let part = heights[0] / (heights[0] - heights[1]);
        let through = add(p[0], scale(part, sub(p[1], p[0])));
        if inside(through) {
            return (through, through);
        }
    }
    for i in 0..2 {
        let foot = sub(p[i], scale(heights[i] / squared, normal));
        if inside(foot) {
            consider(p[i], foot);
        }
    }
    for i in 0..3 {
        let (a, b) = segments(p, [t[i], t[(i + 1) % 3]]);
        consider(a, b);
    }
    (best.1, best.2)
}

/// Triangles that can be asked for by place.
pub(crate) struct Triangles {
    /// The triangles, in the world.
    pub bodies: Vec<Body>,
    tree: Bvh,
}

impl std::fmt::Debug for Triangles {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} triangles", self.bodies.len())
    }
}

impl Triangles {
    /// Builds the tree.
    #[must_use]
    pub(crate) fn new(triangles: &[[Vector; 3]]) -> Self {
        let leaves = triangles.iter().map(|t| Aabb::from_points(t.map(glam)));
        Self {
            tree: Bvh::from_iter(BvhBuildStrategy::Binned, leaves.enumerate()),
            bodies: triangles.iter().copied().map(Body::triangle).collect(),
        }
    }

    /// Indices of the triangles whose boxes meet the cube about a ball.
    pub(crate) fn near(&self, centre: Vector, radius_m: f64, mut each: impl FnMut(u32)) {
        let half = Glam::splat(radius_m);
        let cube = Aabb::new(glam(centre) - half, glam(centre) + half);
        for index in self.tree.intersect_aabb(&cube) {
            each(index);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64, z: f64) -> Pose {
        Pose::from_translation(x, y, z)
    }

    fn noise(seed: &mut u64) -> f64 {
        *seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    #[test]
    fn simple_distances_are_right() {
        let ball = Body::capsule([0.0; 3], [0.0; 3], 0.1);
        let place = Pose::from_xyz_rxryrz([0.0, 0.0, 0.0, 0.3, 0.0, 0.0]);
        let cases = [
            (Body::capsule([0.0; 3], [0.0, 0.0, 1.0], 0.2), 0.7),
            (Body::cuboid([1.0, 1.0, 1.0], &Pose::identity()), 0.4),
            (Body::cylinder(0.25, 1.0, &place), 0.65),
            (Body::plane([1.0, 0.0, 0.0], 0.5), 0.4),
            (
                Body::triangle([[0.0, -1.0, -1.0], [0.0, 1.0, -1.0], [0.0, 0.0, 1.0]]),
                0.9,
            ),
        ];
        for (body, distance) in cases {
            let found = ball.nearest(&at(1.0, 0.0, 0.0), &body);
            assert!(
                (found.distance_m - distance).abs() < 1e-6,
                "{body:?} {found:?}"
            );
            let gap = norm(sub(found.on_a, found.on_b));
            assert!((gap - distance).abs() < 1e-6, "{body:?} {found:?}");
            let inside = ball.nearest(&at(0.04, 0.0, 0.0), &body);
            assert_eq!(inside.distance_m, 0.0, "{body:?}");
        }
    }

    #[test]
    fn closed_forms_agree_with_the_general_search() {
        let mut seed = 7;
        let mut apart = 0;
        for _ in 0..2000 {
            let mut point = || [noise(&mut seed), noise(&mut seed), noise(&mut seed)];
            let (p, q, t) = (
                [point(), point()],
                [point(), point()],
                [point(), point(), point()],
            );
            let place = Pose::from_translation(0.4, 0.0, 0.0);
            let rod = Body::capsule(p[0], p[1], 0.05);
            let general = Body::of(Core::Points(p.to_vec()), 0.05);
            for other in [Body::capsule(q[0], q[1], 0.02), Body::triangle(t)] {
                let (a, b) = (rod.nearest(&place, &other), general.nearest(&place, &other));
                assert!((a.distance_m - b.distance_m).abs() < 1e-6, "{a:?} {b:?}");
                apart += usize::from(a.distance_m > 0.0);
            }
        }
        assert!(apart > 1000, "{apart}");
    }

    #[test]
    fn no_point_of_two_bodies_is_nearer_than_they_are_said_to_be() {
        let mut seed = 11;
        for _ in 0..300 {
            let mut point = || [noise(&mut seed), noise(&mut seed), noise(&mut seed)];
            let points: Vec<_> = (0..12).map(|_| point()).collect();
            let place = Pose::from_xyz_rxryrz([0.9, 0.1, 0.0, 1.0, 0.2, -0.4]);
            let a = Body::hull(&points);
            let b = Body::cylinder(0.3, 0.8, &Pose::identity());
            let found = a.nearest(&place, &b);
            for p in &points {
                let p = place.transform(*p);
                let out = [
                    (p[0].hypot(p[1]) - 0.3).max(0.0),
                    (p[2].abs() - 0.4).max(0.0),
                ];
                assert!(out[0].hypot(out[1]) >= found.distance_m - 1e-12);
            }
        }
    }
}
