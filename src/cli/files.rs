//! Files in.

use crate::program::Source;
use crate::task::profile::way_to_built_in;
use crate::task::{Failure, ProfileFile};
use std::path::Path;

/// A file's bytes.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| Failure::file(path, "read", &error))
}

/// A file by its name and its bytes.
pub(super) fn source(path: &Path) -> Result<Source, Failure> {
    Ok(Source::new(path.display().to_string(), read(path)?))
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
