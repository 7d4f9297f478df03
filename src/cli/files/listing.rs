//! What a folder held when a run read it, to see what has come since.

use super::journal::PREFIX;
use globset::GlobSet;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use walkdir::{DirEntry, WalkDir};

/// The files of a folder that a run could have read.
pub(in crate::cli) struct Listing {
    /// The folder.
    pub folder: PathBuf,
    /// What is no matter.
    pub ignored: GlobSet,
    /// The files that were there.
    pub known: HashSet<PathBuf>,
    /// Whether a run reads a file that is called so.
    pub is_read: Box<dyn Fn(&Path) -> bool>,
}

impl Listing {
    /// A file that has come since; an error names a folder that cannot be listed any more.
    pub(super) fn added(&self) -> Result<Option<PathBuf>, PathBuf> {
        let is_meant = |entry: &DirEntry| {
            let below = entry.path().strip_prefix(&self.folder);
            let below = below.expect("a walk stays below its top");
            !is_own(entry) && meant_by(&self.ignored, below, entry.path()).is_empty()
        };
        let walk = WalkDir::new(&self.folder).min_depth(1);
        for entry in walk.into_iter().filter_entry(is_meant) {
            match entry {
                Ok(entry) => {
                    let path = entry.path();
                    let is_new = !entry.file_type().is_dir() && !self.known.contains(path);
                    if is_new && (entry.path_is_symlink() || (self.is_read)(path)) {
                        return Ok(Some(path.to_owned()));
                    }
                }
                Err(error) => return Err(error.path().unwrap_or(&self.folder).to_owned()),
            }
        }
        Ok(None)
    }
}

/// What a run that is at work has next to its places is none of the folder's.
pub(in crate::cli) fn is_own(entry: &DirEntry) -> bool {
    entry.file_name().to_string_lossy().starts_with(PREFIX)
}

/// Which patterns mean a file or folder: by its path below the folder that is read, or as it was
/// named and is shown.
pub(in crate::cli) fn meant_by(patterns: &GlobSet, below: &Path, named: &Path) -> Vec<usize> {
    let mut meant = patterns.matches(below);
    meant.extend(patterns.matches(named.strip_prefix(".").unwrap_or(named)));
    meant
}
