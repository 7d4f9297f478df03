//! Meshes whose unit nobody says, next to bodies whose size is known: an STL in metres, taken as
//! millimetres, is a crumb that nothing ever touches.

use super::Meshes;
use super::cell::{Cell, LINKS};
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::geometry::{norm, sub};
use crate::model::shape::{Form, Shape};
use crate::profile::{Mounted, Profile};

/// A body this many times smaller than another one is in another unit, unless somebody says its
/// unit.
const SMALLER: f64 = 100.0;

/// Errors of meshes that are too small compared with the largest body or the arm.
pub(super) fn unlikely(profile: &Profile, cell: &Cell, meshes: &Meshes) -> Vec<Finding> {
    let links = profile.shapes.iter().map(|s| (LINKS[s.link], &s.shape));
    let carried = cell.attached.iter().map(|b| (b.name.as_str(), &b.shape));
    let standing = cell.bodies.iter().map(|b| (b.name.as_str(), &b.shape));
    let bodies: Vec<(&str, &Shape)> = links.chain(carried).chain(standing).collect();
    let arm = profile.controller_model(&Mounted::flange()).reaches();
    // as far as it reaches to both sides
    let arm_m = 2.0 * arm.iter().sum::<f64>();
    let sizes = bodies.iter().map(|(name, shape)| {
        let size_m = size_m(&shape.form, meshes);
        (format!("`{name}` is {} mm long", mm(size_m)), size_m)
    });
    let arm = (format!("the arm reaches over {} mm", mm(arm_m)), arm_m);
    let largest = sizes.chain([arm]).max_by(|a, b| a.1.total_cmp(&b.1));
    let (described, largest_m) = largest.expect("the arm, at least");
    let mut found = Vec::new();
    for (name, shape) in &bodies {
        let Form::Mesh { file, .. } = &shape.form else {
            continue;
        };
        let mesh = meshes.get(file);
        let Some(mesh) = mesh.filter(|mesh| mesh.unit_assumed || mesh.shrunk) else {
            continue;
        };
        let long_m = mesh.longest_side_m();
        if SMALLER * long_m > largest_m {
            continue;
        }
        let (by, hint) = if mesh.shrunk {
            (
                "with its `scale`",
                "leave `scale` out: the file says how long its unit is, and `scale: 1000` is its \
                 true size",
            )
        } else {
            (
                "if its unit is a millimetre",
                "`scale: 1000` next to `mesh` says that the file is in metres, `scale: 1` that it \
                 is in millimetres",
            )
        };
        let message = format!(
            "the mesh of `{name}` is {} mm long {by}, and {described}: at most {SMALLER} times as \
             much is believed",
            mm(long_m)
        );
        found.push(Finding::of_file("mesh-unit", Severity::Error, &mesh.file, message).hint(hint));
    }
    found
}

fn mm(length_m: f64) -> f64 {
    (mm_from_m(length_m) * 10.0).round() / 10.0
}

/// The longest extent of a body, metres; of a plane none.
fn size_m(form: &Form, meshes: &Meshes) -> f64 {
    match form {
        Form::Capsule {
            from_m,
            to_m,
            radius_m,
        } => norm(sub(*to_m, *from_m)) + 2.0 * radius_m,
        Form::Box { size_m } => size_m.iter().copied().fold(0.0, f64::max),
        Form::Sphere { radius_m } => 2.0 * radius_m,
        Form::Cylinder { radius_m, height_m } => height_m.max(2.0 * radius_m),
        Form::Plane { .. } => 0.0,
        Form::Mesh { file, .. } => meshes
            .get(file)
            .map_or(0.0, super::mesh::Mesh::longest_side_m),
    }
}
