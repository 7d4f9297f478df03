//! Several files as one: hashes, what may not be written over, and writing that happens whole or not at all.

use super::failure::Failure;
use std::collections::HashSet;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Where a file is that exists, whatever name leads there: two names of one file give the same.
pub fn existing(path: &Path) -> Option<PathBuf> {
    std::fs::canonicalize(path).ok()
}

/// Whether two names lead to one file that exists.
pub fn same_file(a: &Path, b: &Path) -> bool {
    existing(a).is_some_and(|a| existing(b) == Some(a))
}

/// Where a file is or would be, whatever name leads there.
fn place(path: &Path) -> PathBuf {
    let folder = || {
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        let folder = existing(folder.unwrap_or(Path::new(".")))?;
        Some(folder.join(path.file_name()?))
    };
    existing(path)
        .or_else(folder)
        .unwrap_or_else(|| path.to_owned())
}

/// An output must not take the place of what is read, nor of another output.
///
/// # Errors
/// One would.
pub fn refuse_over<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    outputs: impl IntoIterator<Item = &'a Path>,
) -> Result<(), Failure> {
    let read: HashSet<PathBuf> = inputs.into_iter().filter_map(existing).collect();
    let mut written = HashSet::new();
    for output in outputs {
        if existing(output).is_some_and(|at| read.contains(&at)) {
            return Err(Failure::with_hint(
                format!("{} is read and would be written over", output.display()),
                "name another file for what is written",
            ));
        }
        if !written.insert(place(output)) {
            return Err(Failure::with_hint(
                format!("two outputs would be written to {}", output.display()),
                "name another file for one of them",
            ));
        }
    }
    Ok(())
}

/// Writes all files or none: each is written beside its place, and only when all are on disk they are renamed into it.
///
/// # Errors
/// One cannot be written.
pub fn write_all(files: &[(PathBuf, Vec<u8>)]) -> Result<(), Failure> {
    let mut waiting = Vec::with_capacity(files.len());
    for (path, bytes) in files {
        let folder = path
            .parent()
            .filter(|p| !p.as_os_str().is_empty())
            .unwrap_or(Path::new("."));
        let failure = |error: std::io::Error| Failure::file(path, "write", &error);
        std::fs::create_dir_all(folder).map_err(failure)?;
        if path.is_dir() {
            return Err(Failure::new(format!(
                "cannot write {}: it is a folder",
                path.display()
            )));
        }
        let mut file = tempfile::Builder::new()
            .prefix(".poseshift-")
            .tempfile_in(folder)
            .map_err(failure)?;
        file.write_all(bytes)
            .and_then(|()| file.as_file().sync_all())
            .map_err(failure)?;
        keep_permissions(path, file.as_file()).map_err(failure)?;
        waiting.push((path, file));
    }
    for (path, file) in waiting {
        file.persist(path)
            .map_err(|error| Failure::file(path, "write", &error.error))?;
    }
    Ok(())
}

/// A file that replaces another has its permissions; a new one those of any new file.
fn keep_permissions(path: &Path, file: &std::fs::File) -> std::io::Result<()> {
    match std::fs::metadata(path) {
        Ok(old) if old.permissions().readonly() => Err(std::io::Error::new(
            std::io::ErrorKind::PermissionDenied,
            "the file is read-only",
        )),
        Ok(old) => file.set_permissions(old.permissions()),
        Err(_) => new_permissions(file),
    }
}

#[cfg(unix)]
fn new_permissions(file: &std::fs::File) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn new_permissions(_: &std::fs::File) -> std::io::Result<()> {
    Ok(())
}
