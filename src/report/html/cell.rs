//! The view in space: a robot, bodies, items that can be chosen, and paths with deviations. Lengths
//! in mm, angles in degrees.

mod external;

use super::chart::Tone;
use super::numbers::{Number, fixed};
use crate::check::Meshes;
use crate::check::cell::{Carrier, Cell as CellFile};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector, norm, sub};
use crate::model::external::Listed;
use crate::model::profile::Profile;
use crate::model::shape::{Form, Shape};
use external::External;
use serde::Serialize;

/// Triangles that a page draws of one mesh; a finer one is coarsened.
const MOST_TRIANGLES: usize = 3000;

/// A view in space.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Cell {
    /// Its title.
    pub title: String,
    /// What it shows.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub note: String,
    /// Name of the table whose rows are the items.
    pub table: String,
    /// The robot, where one is known.
    pub robot: Option<Robot>,
    /// What stands around it.
    pub bodies: Vec<Solid>,
    /// The items.
    pub points: Points,
    /// Paths and vectors.
    pub paths: Vec<Path>,
    /// Ellipsoids of uncertainty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ellipsoids: Vec<Ellipsoid>,
    /// What the chart of the error along the paths says.
    pub along: Along,
}

/// Whether errors are drawn along the paths.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub(crate) enum Along {
    /// They are, and this is what that says.
    Note(String),
    /// They are not: `false`.
    No(bool),
}

/// The items of a view: a row of its table each.
#[derive(Clone, Debug, Serialize, Default)]
pub(crate) struct Points {
    /// What they are, in a word.
    pub name: &'static str,
    /// Title of their list.
    pub title: String,
    /// x, y, z of each in the world; `null` where an item has no place.
    pub at: Vec<Number>,
    /// Six joint angles of each; empty without a robot.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<Number>,
    /// Where each external axis stands at each item, mm and degrees, in the order of the profile;
    /// empty where nobody knows.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub external: Vec<Number>,
    /// Index of each item's tool among the robot's; empty where there is one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tool: Vec<u32>,
    /// The size that colours it; empty where they are alike.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub error: Vec<Number>,
    /// What that size is, mm; empty where it is no length.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub by: &'static str,
    /// The item that is chosen first.
    pub first: usize,
}

impl Points {
    /// Adds an item.
    pub(crate) fn push(&mut self, place_m: Option<Vector>, joints: Option<[f64; 6]>) {
        let place = place_m.map_or([Number(f64::NAN); 3], |p| p.map(|x| fixed(mm_from_m(x), 3)));
        self.at.extend(place);
        let joints = joints.map_or([Number(f64::NAN); 6], |q| q.map(|q| fixed(q / DEG, 2)));
        self.joints.extend(joints);
    }

    /// Adds where external axes stand at the item that was added last, metres and radians.
    pub(crate) fn push_stand(&mut self, profile: &Profile, values: Option<&[f64]>) {
        let listed = profile.external.listed().enumerate();
        let shown = listed.map(|(k, axis)| match (values.map(|values| values[k]), axis) {
            (None, _) => Number(f64::NAN),
            (Some(value), Listed::Track(_)) => length(value),
            (Some(value), Listed::Rotary(..)) => fixed(value / DEG, 3),
        });
        self.external.extend(shown);
    }
}

/// Lines through places, each with a deviation.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Path {
    /// What it is.
    pub name: String,
    /// Its colour.
    pub tone: Tone,
    /// Its colour is the size of the deviation.
    pub graded: bool,
    /// It is shown when it is asked for only.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub off: bool,
    /// x, y, z of each place; `None` where they are those of the path `like`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<Vec<Number>>,
    /// Index of the path whose places it shares.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub like: Option<usize>,
    /// Where a line begins, by index of places.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub starts: Vec<usize>,
    /// For each place the item it belongs to.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub items: Vec<usize>,
    /// Deviation at each place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by: Option<Vec<Number>>,
}

impl Path {
    /// Vectors from places, metres: a line from each place to where it deviates to.
    #[must_use]
    pub(crate) fn vectors(name: &str, tone: Tone, places_m: &[Vector], by_m: &[Vector]) -> Self {
        let mut path = Self {
            name: name.into(),
            tone,
            graded: false,
            off: false,
            at: Some(Vec::with_capacity(6 * places_m.len())),
            like: None,
            starts: (0..places_m.len()).map(|k| 2 * k).collect(),
            items: (0..places_m.len()).flat_map(|k| [k, k]).collect(),
            by: None,
        };
        let mut by = Vec::with_capacity(6 * places_m.len());
        for (place, vector) in places_m.iter().zip(by_m) {
            let place = place.map(|x| fixed(mm_from_m(x), 2));
            path.at
                .iter_mut()
                .for_each(|at| at.extend(place.iter().chain(&place)));
            by.extend([Number(0.0); 3]);
            by.extend(vector.map(|x| fixed(mm_from_m(x), 5)));
        }
        path.by = Some(by);
        path
    }
}

/// Half axes of an ellipsoid about a place.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Ellipsoid {
    /// Its middle.
    pub at: [Number; 3],
    /// Three half axes, one after the other.
    pub axes: [Number; 9],
}

/// The robot.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Robot {
    base: Vec<Number>,
    rows: Vec<[Number; 5]>,
    sign: Vec<Number>,
    offset: Vec<Number>,
    coupling: Vec<Coupling>,
    flange: Vec<Number>,
    tools: Vec<Vec<Number>>,
    shapes: Vec<Solid>,
    #[serde(skip_serializing_if = "Option::is_none")]
    external: Option<External>,
}

#[derive(Clone, Debug, Serialize)]
struct Coupling {
    joint: usize,
    on: usize,
    ratio: Number,
}

/// A body.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Solid {
    name: String,
    /// The link that carries it.
    #[serde(skip_serializing_if = "Option::is_none")]
    link: Option<usize>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    attached: bool,
    /// Sixteen numbers of a matrix, column by column.
    at: Vec<Number>,
    #[serde(flatten)]
    form: Drawn,
}

/// A form, lengths in mm.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "form", rename_all = "lowercase")]
enum Drawn {
    Capsule {
        from: [Number; 3],
        to: [Number; 3],
        radius: Number,
    },
    Box {
        size: [Number; 3],
    },
    Sphere {
        radius: Number,
    },
    Cylinder {
        radius: Number,
        height: Number,
    },
    Plane {
        normal: [Number; 3],
        offset: Number,
    },
    Mesh {
        /// Nine numbers for each triangle.
        corners: Vec<Number>,
    },
}

fn length(m: f64) -> Number {
    fixed(mm_from_m(m), 3)
}

fn matrix(pose: &Pose) -> Vec<Number> {
    let r = &pose.rotation.0;
    let mut columns = Vec::with_capacity(16);
    for j in 0..3 {
        columns.extend((0..3).map(|i| fixed(r[i][j], 9)));
        columns.push(Number(0.0));
    }
    columns.extend(pose.translation.map(length));
    columns.push(Number(1.0));
    columns
}

impl Solid {
    /// A ball, metres.
    #[must_use]
    pub(crate) fn ball(name: &str, centre_m: Vector, radius_m: f64) -> Self {
        Self {
            name: name.into(),
            link: None,
            attached: false,
            at: matrix(&Pose::from_translation(
                centre_m[0],
                centre_m[1],
                centre_m[2],
            )),
            form: Drawn::Sphere {
                radius: length(radius_m),
            },
        }
    }

    fn of(name: &str, link: Option<usize>, shape: &Shape, meshes: &Meshes) -> Option<Self> {
        let form = match &shape.form {
            Form::Capsule {
                from_m,
                to_m,
                radius_m,
            } => Drawn::Capsule {
                from: from_m.map(length),
                to: to_m.map(length),
                radius: length(*radius_m),
            },
            Form::Box { size_m } => Drawn::Box {
                size: size_m.map(length),
            },
            Form::Sphere { radius_m } => Drawn::Sphere {
                radius: length(*radius_m),
            },
            Form::Cylinder { radius_m, height_m } => Drawn::Cylinder {
                radius: length(*radius_m),
                height: length(*height_m),
            },
            Form::Plane { normal, offset_m } => Drawn::Plane {
                normal: normal.map(|x| fixed(x, 6)),
                offset: length(*offset_m),
            },
            Form::Mesh { file, .. } => Drawn::Mesh {
                corners: coarse(&meshes.get(file)?.triangles),
            },
        };
        Some(Self {
            name: name.into(),
            link,
            attached: false,
            at: matrix(&shape.frame_from_shape),
            form,
        })
    }
}

/// The corners of triangles, in mm; many triangles are coarsened by moving corners to a grid and
/// dropping those that vanish.
fn coarse(triangles: &[[Vector; 3]]) -> Vec<Number> {
    let mut kept: Vec<[Vector; 3]> = triangles.to_vec();
    let corners = || triangles.iter().flatten();
    let low: Vector = std::array::from_fn(|i| corners().fold(f64::INFINITY, |a, c| a.min(c[i])));
    let high: Vector =
        std::array::from_fn(|i| corners().fold(f64::NEG_INFINITY, |a, c| a.max(c[i])));
    let mut cells = 64.0;
    while kept.len() > MOST_TRIANGLES && cells > 2.0 {
        let step = norm(sub(high, low)) / cells;
        let snapped = |c: &Vector| c.map(|x| (x / step).round() * step);
        let mut seen = std::collections::BTreeSet::new();
        kept = triangles
            .iter()
            .map(|t| [snapped(&t[0]), snapped(&t[1]), snapped(&t[2])])
            .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            .filter(|t| {
                let mut key = t.map(|c| c.map(f64::to_bits));
                key.sort_unstable();
                seen.insert(key)
            })
            .collect();
        cells /= 1.5;
    }
    let numbers = kept.iter().flatten().flatten();
    numbers.map(|x| fixed(mm_from_m(*x), 1)).collect()
}

impl Robot {
    /// The robot of a profile with tools and what a cell has it carry.
    #[must_use]
    pub(crate) fn of(
        profile: &Profile,
        tools: &[Pose],
        cell: Option<&CellFile>,
        meshes: &Meshes,
    ) -> Self {
        let links = profile.links.iter().map(|link| {
            [
                fixed(link.alpha_rad / DEG, 6),
                length(link.a_m),
                fixed(link.beta_rad / DEG, 6),
                fixed(link.theta_rad / DEG, 6),
                length(link.d_m),
            ]
        });
        let joints = &profile.mechanism.joints;
        let mut shapes: Vec<Solid> = profile
            .shapes
            .iter()
            .filter_map(|shape| {
                let name = format!("link{}", shape.link);
                Solid::of(&name, Some(shape.link), &shape.shape, meshes)
            })
            .collect();
        for attached in cell.iter().flat_map(|cell| &cell.attached) {
            let (link, place) = match attached.to {
                Carrier::Flange => (6, profile.link6_from_flange),
                Carrier::Link(link) => (link, Pose::identity()),
                Carrier::Positioner(_) => continue,
            };
            let shape = Shape {
                frame_from_shape: place * attached.shape.frame_from_shape,
                form: attached.shape.form.clone(),
            };
            if let Some(mut solid) = Solid::of(&attached.name, Some(link), &shape, meshes) {
                solid.attached = true;
                shapes.push(solid);
            }
        }
        let none = [Pose::identity()];
        let tools = if tools.is_empty() { &none } else { tools };
        Self {
            base: matrix(&profile.world_from_base),
            rows: links.collect(),
            sign: joints.iter().map(|joint| Number(joint.sign)).collect(),
            offset: joints
                .iter()
                .map(|joint| fixed(joint.offset_rad / DEG, 6))
                .collect(),
            coupling: profile
                .mechanism
                .coupling
                .iter()
                .map(|c| Coupling {
                    joint: c.joint,
                    on: c.on,
                    ratio: Number(c.ratio),
                })
                .collect(),
            flange: matrix(&profile.link6_from_flange),
            tools: tools.iter().map(matrix).collect(),
            shapes,
            external: External::of(profile, cell, meshes),
        }
    }
}

/// What stands around the robot.
#[must_use]
pub(crate) fn bodies(cell: Option<&CellFile>, meshes: &Meshes) -> Vec<Solid> {
    cell.iter()
        .flat_map(|cell| &cell.bodies)
        .filter_map(|body| Solid::of(&body.name, None, &body.shape, meshes))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fine_mesh_is_coarsened_and_keeps_its_extent() {
        let count = 200;
        let point = |i: usize, j: usize| {
            let (u, v) = (i as f64 / count as f64, j as f64 / count as f64);
            [u, v, 0.1 * (6.0 * u).sin()]
        };
        let triangles: Vec<[Vector; 3]> = (0..count)
            .flat_map(|i| (0..count).map(move |j| (i, j)))
            .map(|(i, j)| [point(i, j), point(i + 1, j), point(i, j + 1)])
            .collect();
        let corners = coarse(&triangles);
        assert!(corners.len() <= 9 * MOST_TRIANGLES, "{}", corners.len());
        assert!(corners.len() > 900, "{}", corners.len());
        let widest = corners.iter().step_by(3).map(|n| n.0).fold(0.0, f64::max);
        assert!((widest - 1000.0).abs() < 50.0, "{widest}");
    }
}
