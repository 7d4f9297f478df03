//! The triangles of mesh files: STL and OBJ by a crate, COLLADA and glTF here.

mod affine;
mod collada;
mod gltf;
mod obj;
mod polygons;

use super::{MeshError, Neighbour, Triangle, ending};
use crate::geometry::Vector;
use std::borrow::Cow;
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

/// A fan of triangles about its first corner.
fn fan(corners: &[Vector], out: &mut Vec<Triangle>) {
    if let [first, others @ ..] = corners {
        out.extend(others.windows(2).map(|pair| [*first, pair[0], pair[1]]));
    }
}

/// That a binary STL holds as many triangles as its header counts: 50 bytes each behind 84.
fn refuse_cut(bytes: &[u8]) -> Result<(), String> {
    let is_text = (bytes.get(..5)).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    let Some((&count, triangles)) = bytes.get(80..).and_then(<[u8]>::split_first_chunk) else {
        return Ok(());
    };
    let (count, held) = (u32::from_le_bytes(count) as usize, triangles.len() / 50);
    if is_text || held >= count {
        return Ok(());
    }
    Err(format!(
        "it is cut off: its header counts {count} triangles, and it holds {held}"
    ))
}

/// The text of an ASCII STL as the crate reads it: keywords in small letters, nothing before `solid`, and
/// a blank behind it, where no name is. Others stay.
fn plain_stl(bytes: &[u8]) -> Cow<'_, [u8]> {
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let text = text.trim_ascii_start();
    let is_text = text
        .get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    // the header of a binary one may begin so
    if !is_text || !text.is_ascii() || text.contains(&0) {
        return bytes.into();
    }
    let mut plain = text.to_ascii_lowercase();
    if matches!(plain.get(5), Some(b'\r' | b'\n')) {
        plain.insert(5, b' ');
    }
    plain.into()
}

/// STL and OBJ.
fn by_crate(name: &str, bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    // only this file's bytes are read: no material library or texture that it names
    fn none(_: &Path) -> std::io::Result<Vec<u8>> {
        Err(std::io::ErrorKind::NotFound.into())
    }
    let loader = mesh_loader::Loader::default().custom_reader(none);
    let scene = if ending(name) == "stl" {
        let bytes = plain_stl(bytes);
        refuse_cut(&bytes)?;
        loader.load_stl_from_slice(&bytes, name)
    } else {
        loader.load_obj_from_slice(&obj::with_triangles(bytes)?, name)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_an_ascii_stl_may_be_missing_and_what_is_before_it_is_passed_over() {
        let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 9 \
                     0\nendloop\nendfacet\n";
        let read = |bytes: &[u8]| triangles("a.stl", bytes, &|_| Err(String::new()));
        for start in [
            "solid",
            "solid ",
            "solid a",
            "\n  solid",
            "\u{feff}solid a",
            "SOLID A",
        ] {
            for line in ["\n", "\r\n"] {
                let text = format!("{start}\n{facet}endsolid\n").replace('\n', line);
                assert_eq!(
                    read(text.as_bytes()).map(|found| found.len()),
                    Ok(1),
                    "{text}"
                );
            }
        }
    }

    #[test]
    fn a_binary_stl_that_is_cut_off_is_an_error() {
        let mut bytes = vec![0; 80];
        bytes.extend(2_u32.to_le_bytes());
        for _ in 0..2 {
            let corners = [
                0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 9.0, 0.0, 0.0, 0.0, 9.0, 0.0_f32,
            ];
            bytes.extend(corners.iter().flat_map(|number| number.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        let read = |bytes: &[u8]| triangles("a.stl", bytes, &|_| Err(String::new()));
        assert_eq!(read(&bytes).map(|found| found.len()), Ok(2));
        let error = read(&bytes[..bytes.len() - 1]).expect_err("cut");
        let said = "its header counts 2 triangles, and it holds 1";
        assert!(error.to_string().contains(said), "{error}");
    }
}
