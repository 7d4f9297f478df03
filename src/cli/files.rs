//! Files in.

use crate::program::Source;
use crate::task::profile::way_to_built_in;
use crate::task::{Failure, ProfileFile};
use std::io;
use std::path::Path;

/// Bytes of a mesh file: some ten million triangles.
const LARGEST_MESH: u64 = 1 << 30;

/// A file's bytes.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| Failure::file(path, "read", &error))
}

/// A file by its name and its bytes.
pub(super) fn source(path: &Path) -> Result<Source, Failure> {
    Ok(Source::new(path.display().to_string(), read(path)?))
}

/// The bytes of a mesh, or of a file that a mesh names: of a plain file, as a device has no end.
pub(super) fn mesh(path: &Path) -> io::Result<Vec<u8>> {
    let about = std::fs::metadata(path)?;
    if !about.is_file() {
        return Err(io::Error::other("it is no plain file"));
    }
    if about.len() > LARGEST_MESH {
        let message = format!(
            "it has {} bytes; at most {LARGEST_MESH} are read",
            about.len()
        );
        return Err(io::Error::other(message));
    }
    std::fs::read(path)
}

/// A profile.
pub(super) fn profile(path: &Path) -> Result<ProfileFile, Failure> {
    let source = source(path).map_err(|failure| {
        let name = path.file_stem().and_then(|name| name.to_str());
        let built_in = name.and_then(way_to_built_in).filter(|_| !path.exists());
        Failure {
            hint: built_in.unwrap_or(failure.hint),
            ..failure
        }
    })?;
    ProfileFile::read(&source)
}

/// That a profile which is made is not written over another.
pub(super) fn refuse_existing(path: &Path) -> Result<(), Failure> {
    if path.exists() {
        return Err(Failure::new(format!(
            "{} exists; profiles are not written over",
            path.display()
        )));
    }
    Ok(())
}
