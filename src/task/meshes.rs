//! The meshes that profiles and cells name.

use super::failure::Failure;
use crate::check::Meshes;
use crate::check::cell::Cell;
use crate::check::mesh::Mesh;
use crate::model::shape::{Form, Shape};
use crate::program::Source;
use std::io;
use std::path::Path;

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

    /// Reads the mesh of a shape, if it is one, from beside the file that names it; its name becomes the key of the mesh.
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
                    "mesh files are looked for beside the file that names them",
                )
            })?;
            let beside = |name: &str| (self.read)(&path.parent()?.join(name)).ok();
            let name = path.display().to_string();
            let mesh = Mesh::read(&name, &bytes, *scale, &beside)
                .map_err(|error| Failure::with_hint(format!("{name}: {error}"), error.hint()))?;
            if mesh.degenerate > 0 {
                self.notes.push(format!(
                    "{name}: {} triangles have no area and are left out",
                    mesh.degenerate
                ));
            }
            if mesh.open_edges > 0 {
                self.notes.push(format!(
                    "{name}: the mesh is open ({} edges): its surface is looked at, not what is inside",
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
