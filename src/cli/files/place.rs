//! Where an output really goes.

use crate::printable::name_of;
use crate::task::Failure;
use std::collections::VecDeque;
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

/// Links that are followed from one name.
const MOST_LINKS: usize = 40;

/// Whether a name means standard input or output.
pub(in crate::cli) fn is_stream(path: &Path) -> bool {
    path == Path::new("-")
}

/// Whether a name means standard output.
pub(in crate::cli) fn is_standard_output(path: &Path) -> bool {
    let names = ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];
    is_stream(path) || names.iter().any(|name| path == Path::new(name))
}

/// The path without links, `.` and `..`; what is not there yet is taken as it is called.
pub(super) fn real(path: &Path) -> io::Result<PathBuf> {
    let mut at = PathBuf::new();
    let mut links = 0;
    let parts = |path: &Path| -> Vec<OsString> {
        path.components()
            .map(|part| part.as_os_str().to_owned())
            .collect()
    };
    let mut rest: VecDeque<OsString> = parts(&std::path::absolute(path)?).into();
    while let Some(part) = rest.pop_front() {
        match Path::new(&part).components().next() {
            Some(Component::ParentDir) => {
                at.pop();
            }
            Some(Component::Normal(name)) => {
                let next = at.join(name);
                match fs::symlink_metadata(&next) {
                    Ok(found) if found.is_symlink() => {
                        links += 1;
                        if links > MOST_LINKS {
                            return Err(io::Error::other("too many links lead on from there"));
                        }
                        for part in parts(&fs::read_link(&next)?).into_iter().rev() {
                            rest.push_front(part);
                        }
                    }
                    Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
                    _ => at = next,
                }
            }
            Some(Component::RootDir | Component::Prefix(_)) => at.push(&part),
            Some(Component::CurDir) | None => {}
        }
    }
    Ok(at)
}

/// Where a file is written that is called so.
///
/// # Errors
/// A folder, a device, a pipe, a socket, a file that may not be written.
pub(super) fn place(path: &Path) -> Result<PathBuf, Failure> {
    let fault = |error: io::Error| Failure::file(path, "write", &error);
    let place = real(path).map_err(fault)?;
    let refuse = |what: &str| {
        let message = format!("cannot write {}: it is {what}", name_of(path));
        Err(Failure::with_hint(
            message,
            "name a file; `-` is standard output",
        ))
    };
    match fs::symlink_metadata(&place) {
        Ok(found) if found.is_file() && found.permissions().readonly() => {
            let message = "the file is read-only";
            Err(fault(io::Error::new(
                io::ErrorKind::PermissionDenied,
                message,
            )))
        }
        Ok(found) if found.is_file() => {
            // what a rename would not ask: whether the file itself may be changed
            let opened = fs::OpenOptions::new().write(true).open(&place);
            opened.map(|_| place).map_err(fault)
        }
        Ok(found) if found.is_dir() => refuse("a folder"),
        Ok(_) => refuse("a device, a pipe or a socket"),
        Err(_) => match path.as_os_str().as_encoded_bytes().last() {
            Some(b'/') => refuse("the name of a folder"),
            _ => Ok(place),
        },
    }
}
