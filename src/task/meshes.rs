//! The meshes that profiles and cells name.

use super::failure::Failure;
use crate::check::Meshes;
use crate::check::cell::Cell;
use crate::check::mesh::Mesh;
use crate::geometry::units::mm_from_m;
use crate::model::shape::{Form, Shape};
use crate::printable::name_of;
use crate::program::Source;
use std::io;
use std::path::{Component, Path, PathBuf};

/// How a file that another one names is read.
pub type Reader<'a> = &'a dyn Fn(&Path) -> io::Result<Vec<u8>>;

/// Reads meshes, each once.
pub struct Loader<'a> {
    /// The meshes by their keys.
    pub meshes: Meshes,
    /// What is to be said of them.
    pub notes: Vec<String>,
    read: Reader<'a>,
}

impl<'a> Loader<'a> {
    /// A loader without meshes.
    #[must_use]
    pub fn new(read: Reader<'a>) -> Self {
        Self {
            meshes: Meshes::default(),
            notes: Vec::new(),
            read,
        }
    }

    /// Reads the mesh of a shape, if it is one, from next to the file that names it; its name
    /// becomes the key of the mesh.
    ///
    /// # Errors
    /// A file that cannot be read or is no mesh.
    pub fn load(&mut self, shape: &mut Shape, named_in: &str) -> Result<(), Failure> {
        let Form::Mesh { file, scale } = &mut shape.form else {
            return Ok(());
        };
        let folder = Path::new(named_in).parent().unwrap_or(Path::new(""));
        let path = folder.join(&*file);
        let key = format!("{} {scale:?}", path.display());
        if !self.meshes.contains_key(&key) {
            let bytes = (self.read)(&path).map_err(|error| {
                Failure::with_hint(
                    format!(
                        "{named_in}: cannot read the mesh {}: {error}",
                        path.display()
                    ),
                    "mesh files are looked for next to the file that names them",
                )
            })?;
            let neighbour = |uri: &str| {
                let folder = path.parent().unwrap_or(Path::new(""));
                let path = folder.join(below(uri)?);
                stays(&path, folder).map_err(|error| error.to_string())?;
                (self.read)(&path).map_err(|error| error.to_string())
            };
            let name = name_of(&path);
            let mesh = Mesh::read(&name, &bytes, *scale, &neighbour)
                .map_err(|error| Failure::with_hint(format!("{name}: {error}"), error.hint()))?;
            self.notes.push(bounds(&name, &mesh));
            if mesh.degenerate > 0 {
                self.notes.push(format!(
                    "{name}: {} triangles have no area and are left out",
                    mesh.degenerate
                ));
            }
            if mesh.open_edges > 0 {
                self.notes.push(format!(
                    "{name}: the mesh is open ({} edges): its surface is looked at, not what is \
                     inside",
                    mesh.open_edges
                ));
            }
            self.meshes.insert(key.clone(), mesh);
        }
        *file = key;
        Ok(())
    }

    /// A cell with its meshes.
    ///
    /// # Errors
    /// What the format does not allow, with line and column; a mesh that cannot be read.
    pub fn cell(&mut self, source: &Source) -> Result<Cell, Failure> {
        let text = super::text(source)?;
        let name = &source.name;
        let mut cell =
            Cell::from_yaml(&text).map_err(|error| Failure::profile(name, &text, &error))?;
        for body in &mut cell.bodies {
            self.load(&mut body.shape, name)?;
        }
        for body in &mut cell.attached {
            self.load(&mut body.shape, name)?;
        }
        Ok(cell)
    }
}

/// What a mesh is like, with the box about it in mm.
fn bounds(name: &str, mesh: &Mesh) -> String {
    let [low, high] = mesh.bounds();
    let sides = ["x", "y", "z"].iter().zip(low.iter().zip(&high));
    let sides: Vec<String> = sides
        .map(|(axis, (low, high))| {
            format!("{axis} {:.1} to {:.1}", mm_from_m(*low), mm_from_m(*high))
        })
        .collect();
    format!(
        "{name}: {} triangles, {} mm",
        mesh.triangles.len(),
        sides.join(", ")
    )
}

/// Only files in the mesh's folder, or below it, are read.
const OUTSIDE: &str = "only files in the mesh's folder, or below it, are read";

/// That no link leads out of a folder.
fn stays(path: &Path, folder: &Path) -> io::Result<()> {
    // of a name alone that is the working directory
    let folder = Path::new(".").join(folder).canonicalize()?;
    if path.canonicalize()?.starts_with(folder) {
        return Ok(());
    }
    Err(io::Error::other(format!("{OUTSIDE}, and a link leads out")))
}

/// The path of a file that a mesh file names by a URI (RFC 3986, relative): in its folder or below.
fn below(uri: &str) -> Result<PathBuf, String> {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let [first, others @ ..] = rest {
        let (byte, others) = match (first, others) {
            (b'%', [high, low, others @ ..]) => {
                let digit = |byte: &u8| char::from(*byte).to_digit(16);
                let code = digit(high)
                    .zip(digit(low))
                    .map(|(high, low)| 16 * high + low);
                let code = code.and_then(|code| u8::try_from(code).ok());
                (code.ok_or("a `%` without two digits")?, others)
            }
            (byte, others) => (*byte, others),
        };
        bytes.push(byte);
        rest = others;
    }
    let name = String::from_utf8(bytes).map_err(|error| error.to_string())?;
    let path = PathBuf::from(&name);
    let stays = path
        .components()
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    // a drive or another scheme, whatever system this is
    if !stays || name.is_empty() || name.contains([':', '\\', '\0']) {
        return Err(OUTSIDE.to_owned());
    }
    Ok(path)
}
