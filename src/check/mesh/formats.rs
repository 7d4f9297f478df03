//! The triangles of mesh files: STL and OBJ by a crate, COLLADA and glTF here.

mod affine;
mod collada;
mod gltf;

use super::{MeshError, Neighbour, Triangle, ending};
use crate::geometry::Vector;
use std::path::Path;

/// Most triangles of a file.
const MOST: usize = 20_000_000;

/// The triangles of a file, in its units.
pub(super) fn triangles(
    name: &str,
    bytes: &[u8],
    neighbour: Neighbour,
) -> Result<Vec<Triangle>, MeshError> {
    let found = match ending(name).as_str() {
        "stl" | "obj" => by_crate(name, bytes),
        "dae" => collada::read(bytes),
        "gltf" | "glb" => gltf::read(bytes, neighbour),
        other => {
            return Err(MeshError::Ending {
                ending: other.into(),
            });
        }
    };
    found.map_err(|message| MeshError::Unreadable { message })
}

/// A polygon as triangles about its first corner.
fn fan(corners: &[Vector], out: &mut Vec<Triangle>) {
    if let [first, others @ ..] = corners {
        out.extend(others.windows(2).map(|pair| [*first, pair[0], pair[1]]));
    }
}

/// STL and OBJ.
fn by_crate(name: &str, bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    // only this file's bytes are read: no material library or texture that it names
    fn none(_: &Path) -> std::io::Result<Vec<u8>> {
        Err(std::io::ErrorKind::NotFound.into())
    }
    let loader = mesh_loader::Loader::default().custom_reader(none);
    let scene = match ending(name).as_str() {
        "stl" => loader.load_stl_from_slice(bytes, name),
        _ => loader.load_obj_from_slice(bytes, name),
    }
    .map_err(|error| error.to_string())?;
    let mut triangles = Vec::new();
    for mesh in &scene.meshes {
        if triangles.len() + mesh.faces.len() > MOST {
            return Err(format!("more than {MOST} triangles"));
        }
        for face in &mesh.faces {
            let corner = |i: u32| mesh.vertices.get(i as usize).map(|v| v.map(f64::from));
            match face.map(corner) {
                [Some(a), Some(b), Some(c)] => triangles.push([a, b, c]),
                _ => return Err("a face names a corner that is not there".into()),
            }
        }
    }
    Ok(triangles)
}
