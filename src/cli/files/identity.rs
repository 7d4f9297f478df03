//! Which file a name leads to, whatever the name.

use std::fs::{File, Metadata};
use std::path::Path;

/// A file itself: its device and its number there.
#[cfg(unix)]
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(in crate::cli) struct Identity(u64, u64);

/// A file itself, as the system tells files apart.
#[cfg(not(unix))]
#[derive(Debug, PartialEq, Eq, Hash)]
pub(in crate::cli) struct Identity(same_file::Handle);

#[cfg(unix)]
impl Identity {
    fn new(found: &Metadata) -> Self {
        use std::os::unix::fs::MetadataExt;
        Self(found.dev(), found.ino())
    }

    /// Of what a path leads to; none where there is nothing.
    pub(in crate::cli) fn of(path: &Path) -> Option<Self> {
        std::fs::metadata(path).ok().map(|found| Self::new(&found))
    }

    /// Of an open file.
    pub(in crate::cli) fn of_file(file: &File) -> Option<Self> {
        file.metadata().ok().map(|found| Self::new(&found))
    }

    /// Of the plain file that a stream goes to; none of a terminal, a pipe or a device.
    fn of_stream(stream: impl std::os::fd::AsFd) -> Option<Self> {
        let file = File::from(stream.as_fd().try_clone_to_owned().ok()?);
        let found = file.metadata().ok()?;
        found.is_file().then(|| Self::new(&found))
    }

    /// Of the plain file that standard output goes to.
    pub(in crate::cli) fn of_standard_output() -> Option<Self> {
        Self::of_stream(std::io::stdout())
    }

    /// Of the plain file that standard error goes to.
    pub(in crate::cli) fn of_standard_error() -> Option<Self> {
        Self::of_stream(std::io::stderr())
    }
}

#[cfg(not(unix))]
impl Identity {
    /// Of what a path leads to; none where there is nothing.
    pub(in crate::cli) fn of(path: &Path) -> Option<Self> {
        same_file::Handle::from_path(path).ok().map(Self)
    }

    /// Of an open file.
    pub(in crate::cli) fn of_file(file: &File) -> Option<Self> {
        same_file::Handle::from_file(file.try_clone().ok()?)
            .ok()
            .map(Self)
    }

    /// Of what standard output goes to.
    pub(in crate::cli) fn of_standard_output() -> Option<Self> {
        same_file::Handle::stdout().ok().map(Self)
    }

    /// Of what standard error goes to.
    pub(in crate::cli) fn of_standard_error() -> Option<Self> {
        same_file::Handle::stderr().ok().map(Self)
    }
}

/// What tells that a file was changed, without reading it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Stamp {
    length: u64,
    times: [i128; 2],
}

impl Stamp {
    pub(super) fn new(found: &Metadata) -> Self {
        #[cfg(unix)]
        let times = {
            use std::os::unix::fs::MetadataExt;
            let ns = |s: i64, ns: i64| i128::from(s) * 1_000_000_000 + i128::from(ns);
            [
                ns(found.mtime(), found.mtime_nsec()),
                ns(found.ctime(), found.ctime_nsec()),
            ]
        };
        #[cfg(not(unix))]
        let times = {
            let since = |time: std::time::SystemTime| {
                let since = time.duration_since(std::time::UNIX_EPOCH).ok();
                since.and_then(|since| i128::try_from(since.as_nanos()).ok())
            };
            [found.modified().ok().and_then(since).unwrap_or(0), 0]
        };
        Self {
            length: found.len(),
            times,
        }
    }
}
