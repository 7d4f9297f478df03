//! The steps between a journal and the files that it lists: forward, backward, and what is removed
//! at the end.

use super::disk::Disk;
use super::journal::{self, Entry, Held, Journal, PREFIX, Stage};
use crate::program::sha256_of;
use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Why something could not be put in place.
pub(super) struct Stop {
    pub path: PathBuf,
    pub why: io::Error,
}

impl Stop {
    /// For errors at this path.
    pub(super) fn at(path: &Path) -> impl Fn(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |why| Self {
            path: path.clone(),
            why,
        }
    }
}

/// The steps between a journal and the files that it lists.
pub(super) struct Work<'a> {
    pub disk: &'a Disk,
    pub held: Held,
    pub id: String,
    pub entries: Vec<Entry>,
}

/// Whether there is anything.
pub(super) fn exists(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

/// The hash of what a file holds.
pub(super) fn hash_of(path: &Path) -> io::Result<String> {
    sha256_of(&mut fs::File::open(path)?)
}

/// Whether a file, and no link, holds what has this hash.
fn holds(path: &Path, hash: &str) -> bool {
    let is_file = fs::symlink_metadata(path).is_ok_and(|found| found.is_file());
    is_file && hash_of(path).is_ok_and(|found| found == hash)
}

/// Whether a journal is of this run.
pub(super) fn is_of_run(path: &Path, id: &str) -> bool {
    let folder = path.parent().expect("a journal stands in a folder");
    let read = fs::read(path)
        .ok()
        .map(|bytes| Journal::read(&bytes, folder));
    matches!(read, Some(Ok(Some((_, journal)))) if journal.id == id)
}

impl Work<'_> {
    fn next_to(&self, entry: &Entry, ending: &str) -> PathBuf {
        let name = format!("{PREFIX}{}-{}.{ending}", self.id, entry.number);
        entry.folder().join(name)
    }

    /// Where a new file or folder is made.
    pub(super) fn staged(&self, entry: &Entry) -> PathBuf {
        self.next_to(entry, "new")
    }

    /// Where what is replaced is kept.
    pub(super) fn backup(&self, entry: &Entry) -> PathBuf {
        self.next_to(entry, "old")
    }

    fn folders(&self) -> BTreeSet<&Path> {
        self.entries.iter().map(Entry::folder).collect()
    }

    /// Whether the place is as it was before the run.
    fn is_old(entry: &Entry) -> bool {
        match &entry.old {
            Some(hash) => holds(&entry.target, hash),
            None => !exists(&entry.target),
        }
    }

    /// Whether at the place is what the run put there, and nothing else.
    fn is_new(entry: &Entry) -> bool {
        let whole = |(path, hash): &(PathBuf, String)| {
            let path = if path.as_os_str().is_empty() {
                entry.target.clone()
            } else {
                entry.target.join(path)
            };
            holds(&path, hash)
        };
        let files = walkdir::WalkDir::new(&entry.target).into_iter();
        let files = files.filter(|found| !found.as_ref().is_ok_and(|f| f.file_type().is_dir()));
        files.count() == entry.new.len() && entry.new.iter().all(whole)
    }

    /// Puts every new file into its place.
    pub(super) fn forward(&self) -> Result<(), Stop> {
        let waiting = |entry: &&Entry| exists(&self.staged(entry));
        let waiting: Vec<&Entry> = self.entries.iter().filter(waiting).collect();
        if let Some(entry) = waiting.iter().find(|entry| !Self::is_old(entry)) {
            let why = io::Error::other("it was changed by another program meanwhile");
            return Err(Stop::at(&entry.target)(why));
        }
        for entry in waiting {
            let renamed = self.disk.rename(&self.staged(entry), &entry.target);
            renamed.map_err(Stop::at(&entry.target))?;
        }
        self.sync()
    }

    /// Puts everything back: what was replaced comes to its place again, what was not there goes.
    fn backward(&self) -> Result<(), Stop> {
        for entry in self.entries.iter().rev() {
            let (staged, backup) = (self.staged(entry), self.backup(entry));
            let stop = Stop::at(&entry.target);
            if exists(&staged) {
                continue;
            }
            if Self::is_new(entry) && (entry.old.is_none() || exists(&backup)) {
                let undone = if entry.old.is_some() {
                    self.disk.rename(&backup, &entry.target)
                } else {
                    // away in one step, whatever it holds
                    self.disk.rename(&entry.target, &staged)
                };
                undone.map_err(stop)?;
            } else if !Self::is_old(entry) {
                let why = "it was changed after a run that wrote it was stopped";
                return Err(stop(io::Error::other(why)));
            }
        }
        self.sync()
    }

    /// Makes the names in all folders stay when the power goes.
    pub(super) fn sync(&self) -> Result<(), Stop> {
        for folder in self.folders() {
            self.disk.sync_folder(folder).map_err(Stop::at(folder))?;
        }
        Ok(())
    }

    /// Removes what is next to the places, the journal last.
    pub(super) fn clean(&self) -> Result<(), Stop> {
        for entry in &self.entries {
            for path in [self.staged(entry), self.backup(entry)] {
                self.disk.remove(&path).map_err(Stop::at(&path))?;
            }
        }
        let own = &self.held.path;
        let others = self.folders().into_iter().map(journal::of);
        for path in others.filter(|path| path != own && is_of_run(path, &self.id)) {
            self.disk.remove(&path).map_err(Stop::at(&path))?;
        }
        self.disk.remove(own).map_err(Stop::at(own))
    }

    /// Puts all back and removes what is next to it.
    pub(super) fn undo(&self) -> Result<(), Stop> {
        // a stage that cannot be written stays `commit`: then this is tried again by the next run
        let _ = self.held.set(self.disk, Stage::Undo);
        self.backward()?;
        self.clean()
    }
}
