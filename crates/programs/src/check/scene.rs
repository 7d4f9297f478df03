//! All bodies of a check: what moves, what stands, and which pairs are looked at.

use super::cell::{Carrier, Cell, LINKS, Pair, UnknownPositioner};
use super::mesh::Mesh;
use super::query::{Body, Triangles};
use crate::finding::Finding;
use crate::geometry::units::MM;
use crate::geometry::{Pose, Vector};
use crate::model::shape::{Form, Shape};
use crate::motion::leg::Leg;
use crate::profile::Profile;
use std::collections::{BTreeMap, BTreeSet};

/// Meshes by the name that a profile or cell file gives them.
pub type Meshes = BTreeMap<String, Mesh>;

/// Bodies whose links are nearer than this in the chain are kept apart by the joint limits, and
/// their capsules overlap.
const APART: usize = 3;
/// What is no farther from the base at home is what it stands on, metres.
const TOUCHING_M: f64 = 1.0 * MM;

/// What a body moves with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum On {
    /// 0 is the base, 1 to 6 the rows of the chain.
    Link(usize),
    /// Index in [`Scene::plates`].
    Plate(usize),
}

/// A body that moves.
#[derive(Clone, Debug)]
pub(crate) struct Moving {
    /// Index in [`Scene::names`].
    pub name: usize,
    /// What it moves with.
    pub on: On,
    /// In the frame of that.
    pub body: Body,
}

/// A body that stands.
#[derive(Debug)]
pub(crate) struct Fixed {
    pub name: usize,
    pub form: FixedForm,
}

#[derive(Debug)]
pub(crate) enum FixedForm {
    /// One convex body, in the world.
    Convex(Body),
    /// Triangles in the world.
    Mesh { triangles: Triangles, mesh: Mesh },
}

impl FixedForm {
    /// Whether a body at a pose is within a distance of it.
    fn is_within(&self, body: &Body, pose: &Pose, distance_m: f64) -> bool {
        let near = |other: &Body| body.nearest(pose, other).distance_m <= distance_m;
        match self {
            Self::Convex(other) => near(other),
            Self::Mesh { triangles, .. } => {
                let (centre, radius) = body.ball();
                let mut found = false;
                triangles.near(pose.transform(centre), radius + distance_m, |t| {
                    found |= near(&triangles.bodies[t as usize]);
                });
                found
            }
        }
    }
}

/// Two bodies that must keep apart.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watched {
    /// Index in [`Scene::moving`]: the body farther out on the arm; one on a plate where the other
    /// is not on the arm.
    pub a: usize,
    /// What it must not come near.
    pub b: Other,
    /// Their clearance, metres.
    pub required_m: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Other {
    /// Index in [`Scene::moving`].
    Moving(usize),
    /// Index in [`Scene::fixed`].
    Fixed(usize),
}

/// All bodies and pairs.
#[derive(Debug, Default)]
pub struct Scene {
    pub(crate) names: Vec<String>,
    pub(crate) moving: Vec<Moving>,
    pub(crate) fixed: Vec<Fixed>,
    pub(crate) watched: Vec<Watched>,
    /// Indices of the positioners that carry bodies.
    pub(crate) plates: Vec<usize>,
    /// Bodies whose size is hardly meant.
    pub findings: Vec<Finding>,
}

/// Why bodies are none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SceneError {
    /// A mesh that was not given.
    #[error("the mesh `{file}` is not loaded")]
    MissingMesh {
        /// Its name as written.
        file: String,
    },
    /// A body on a positioner that the profile does not have.
    #[error(transparent)]
    UnknownPositioner(#[from] UnknownPositioner),
}

/// A shape as convex bodies in its frame; the triangles of a mesh as their hull.
fn convex(shape: &Shape, meshes: &Meshes) -> Result<Body, SceneError> {
    let place = &shape.frame_from_shape;
    Ok(match &shape.form {
        Form::Capsule {
            from_m,
            to_m,
            radius_m,
        } => Body::capsule(place.transform(*from_m), place.transform(*to_m), *radius_m),
        Form::Box { size_m } => Body::cuboid(*size_m, place),
        Form::Sphere { radius_m } => Body::capsule(place.translation, place.translation, *radius_m),
        Form::Cylinder { radius_m, height_m } => Body::cylinder(*radius_m, *height_m, place),
        Form::Plane { normal, offset_m } => {
            let normal = place.rotation * *normal;
            let offset_m = offset_m + crate::geometry::dot(normal, place.translation);
            Body::plane(normal, offset_m)
        }
        Form::Mesh { file, .. } => {
            let mesh = loaded(file, meshes)?;
            let corners: Vec<Vector> = mesh.triangles.iter().flatten().copied().collect();
            let placed: Vec<Vector> = corners.iter().map(|c| place.transform(*c)).collect();
            Body::hull(&placed)
        }
    })
}

fn loaded<'a>(file: &str, meshes: &'a Meshes) -> Result<&'a Mesh, SceneError> {
    meshes
        .get(file)
        .ok_or_else(|| SceneError::MissingMesh { file: file.into() })
}

impl Scene {
    /// Brings together the robot's own bodies and those of a cell.
    ///
    /// # Errors
    /// If a mesh was not loaded, or the profile lacks a positioner that carries something.
    pub fn new(
        profile: &Profile,
        cell: Option<&Cell>,
        meshes: &Meshes,
    ) -> Result<Self, SceneError> {
        let mut scene = Self {
            names: LINKS.map(String::from).to_vec(),
            ..Self::default()
        };
        for shape in &profile.shapes {
            scene.moving.push(Moving {
                name: shape.link,
                on: On::Link(shape.link),
                body: convex(&shape.shape, meshes)?,
            });
        }
        let empty = Cell::default();
        let cell = cell.unwrap_or(&empty);
        for attached in &cell.attached {
            let positioner = attached.positioner(&profile.external)?;
            let (on, place) = match (&attached.to, positioner) {
                (_, Some(positioner)) => (scene.plate(positioner), Pose::identity()),
                (Carrier::Link(link), None) => (On::Link(*link), Pose::identity()),
                (_, None) => (On::Link(6), profile.link6_from_flange),
            };
            let shape = Shape {
                frame_from_shape: place * attached.shape.frame_from_shape,
                form: attached.shape.form.clone(),
            };
            scene.moving.push(Moving {
                name: scene.names.len(),
                on,
                body: convex(&shape, meshes)?,
            });
            scene.names.push(attached.name.clone());
        }
        for body in &cell.bodies {
            let form = if let Form::Mesh { file, .. } = &body.shape.form {
                let mesh = loaded(file, meshes)?;
                let place = &body.shape.frame_from_shape;
                let placed = |t: &[Vector; 3]| t.map(|corner| place.transform(corner));
                let mesh = Mesh {
                    triangles: mesh.triangles.iter().map(placed).collect(),
                    ..mesh.clone()
                };
                FixedForm::Mesh {
                    triangles: Triangles::new(&mesh.triangles),
                    mesh,
                }
            } else {
                FixedForm::Convex(convex(&body.shape, meshes)?)
            };
            scene.fixed.push(Fixed {
                name: scene.names.len(),
                form,
            });
            scene.names.push(body.name.clone());
        }
        scene.watch(profile, cell);
        scene.findings = super::sizes::unlikely(profile, cell, meshes);
        Ok(scene)
    }

    /// The plate of a positioner.
    fn plate(&mut self, positioner: usize) -> On {
        let known = self.plates.iter().position(|plate| *plate == positioner);
        On::Plate(known.unwrap_or_else(|| {
            self.plates.push(positioner);
            self.plates.len() - 1
        }))
    }

    fn watch(&mut self, profile: &Profile, cell: &Cell) {
        let required = |a: usize, b: usize| {
            let (a, b) = (self.names[a].as_str(), self.names[b].as_str());
            let said = cell
                .pairs
                .iter()
                .rev()
                .find(|p| (p.a == a && p.b == b) || (p.a == b && p.b == a));
            said.map_or(Some(cell.clearance_m), |pair| pair.clearance_m)
        };
        let said = |a: usize, b: usize| {
            let names = [&self.names[a], &self.names[b]];
            let is_own = |pair: &Pair| names.contains(&&pair.a) && names.contains(&&pair.b);
            cell.pairs.iter().any(is_own)
        };
        let is_link = |name: usize| name < LINKS.len();
        let mut watched = Vec::new();
        for (i, one) in self.moving.iter().enumerate() {
            for (j, other) in self.moving.iter().enumerate().take(i) {
                let (a, b, apart) = match (one.on, other.on) {
                    (On::Link(high), On::Link(low)) if high >= low => (i, j, high - low),
                    (On::Link(low), On::Link(high)) => (j, i, high - low),
                    (On::Plate(one), On::Plate(other)) if one == other => (i, j, 0),
                    (On::Plate(_), On::Link(_)) => (j, i, usize::MAX),
                    _ => (i, j, usize::MAX),
                };
                let own = is_link(one.name) && is_link(other.name);
                let said = said(one.name, other.name);
                // what moves together cannot come nearer; neighbours touch; a cell file may name
                // others
                if apart == 0 || (apart < APART && !(said && apart > usize::from(own))) {
                    continue;
                }
                if let Some(required_m) = required(one.name, other.name) {
                    // the robot's own links need no more than not to touch, unless the cell says so
                    watched.push(Watched {
                        a,
                        b: Other::Moving(b),
                        required_m: if own && !said { 0.0 } else { required_m },
                    });
                }
            }
            // the base stands where it was put, and on a track on what it touches at home; a cell file
            // may name others
            let stands = one.on == On::Link(0);
            if stands && profile.external.track.is_empty() {
                continue;
            }
            for (k, fixed) in self.fixed.iter().enumerate() {
                if let Some(required_m) = required(one.name, fixed.name) {
                    let home = &profile.world_from_base;
                    let touches = || fixed.form.is_within(&one.body, home, TOUCHING_M);
                    if stands && !said(one.name, fixed.name) && touches() {
                        continue;
                    }
                    watched.push(Watched {
                        a: i,
                        b: Other::Fixed(k),
                        required_m,
                    });
                }
            }
        }
        self.watched = watched;
    }

    /// The names of all bodies: links and tool of the robot that have a shape, what is attached to
    /// them, and the cell's.
    #[must_use]
    pub fn bodies(&self) -> Vec<&str> {
        let moving = self.moving.iter().map(|body| body.name);
        let used: BTreeSet<usize> = moving.chain(self.fixed.iter().map(|f| f.name)).collect();
        used.into_iter().map(|at| self.names[at].as_str()).collect()
    }

    /// Name of the moving body of a pair, and of the other.
    pub(crate) fn names_of(&self, pair: &Watched) -> (&str, &str) {
        let other = match pair.b {
            Other::Moving(b) => self.moving[b].name,
            Other::Fixed(k) => self.fixed[k].name,
        };
        (&self.names[self.moving[pair.a].name], &self.names[other])
    }

    /// Names of the pair that a clearance is of; `None` where nothing came near.
    #[must_use]
    pub fn pair_names(&self, found: &super::collision::Clearance) -> Option<(&str, &str)> {
        found.pair.map(|pair| self.names_of(&self.watched[pair]))
    }

    /// Whether it is known where everything is on a move: plates that carry bodies are where external
    /// axes stand.
    pub(crate) fn is_known(&self, leg: &Leg) -> bool {
        self.plates.is_empty() || leg.ride.is_some()
    }

    /// Whether there is anything to look at.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.watched.is_empty()
    }
}
