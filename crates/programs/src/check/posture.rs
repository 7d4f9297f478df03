//! Whether an arm that stands still touches anything.

use super::scene::{FixedForm, On, Other, Scene};
use crate::model::{Conditions, Model};

/// Names of two bodies that touch, or come nearer than they must, at these joints (radians); the
/// convex ones: of fixed meshes nothing is said here, and nothing of what is on positioners.
#[must_use]
pub fn touching<'a>(scene: &'a Scene, model: &Model, q: &[f64; 6]) -> Option<(&'a str, &'a str)> {
    let frames = model.link_frames(q, &Conditions::default());
    let near = |pair: &&super::scene::Watched| {
        let moving = &scene.moving[pair.a];
        let On::Link(link) = moving.on else {
            return false;
        };
        let world_from_a = frames[link];
        let found = match pair.b {
            Other::Moving(b) => {
                let other = &scene.moving[b];
                let On::Link(link) = other.on else {
                    return false;
                };
                let b_from_a = frames[link].inverse() * world_from_a;
                moving.body.nearest(&b_from_a, &other.body)
            }
            Other::Fixed(k) => match &scene.fixed[k].form {
                FixedForm::Convex(other) => moving.body.nearest(&world_from_a, other),
                FixedForm::Mesh { .. } => return false,
            },
        };
        found.distance_m <= pair.required_m
    };
    let pair = scene.watched.iter().find(near)?;
    Some(scene.names_of(pair))
}
