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

    /// Whether there is anything; where the disk does not say, nobody goes on.
    fn exists(&self, path: &Path) -> Result<bool, Stop> {
        self.disk.exists(path).map_err(Stop::at(path))
    }

    /// Whether the place is as it was before the run.
    fn is_old(&self, entry: &Entry) -> Result<bool, Stop> {
        match &entry.old {
            Some(hash) => Ok(holds(&entry.target, hash)),
            None => Ok(!self.exists(&entry.target)?),
        }
    }

    /// Whether at a path is what the run puts into the place of an entry, and nothing else.
    fn is_new(entry: &Entry, at: &Path) -> bool {
        let whole = |(path, hash): &(PathBuf, String)| {
            if path.as_os_str().is_empty() {
                holds(at, hash)
            } else {
                holds(&at.join(path), hash)
            }
        };
        let files = walkdir::WalkDir::new(at).into_iter();
        let files = files.filter(|found| !found.as_ref().is_ok_and(|f| f.file_type().is_dir()));
        files.count() == entry.new.len() && entry.new.iter().all(whole)
    }

    /// That every new file is as it was made, next to its place or in it.
    pub(super) fn refuse_damaged(&self) -> Result<(), Stop> {
        for entry in &self.entries {
            let staged = self.staged(entry);
            let (at, why) = if self.exists(&staged)? {
                (&staged, "it is not what the run wrote")
            } else {
                (&entry.target, "what the run wrote for it is gone")
            };
            if !Self::is_new(entry, at) {
                return Err(Stop::at(at)(io::Error::other(why)));
            }
        }
        Ok(())
    }

    /// That nobody has removed a new file before any is in its place.
    pub(super) fn refuse_gone(&self) -> Result<(), Stop> {
        for entry in &self.entries {
            if !self.exists(&self.staged(entry))? {
                let why = io::Error::other("what the run wrote for it is gone");
                return Err(Stop::at(&entry.target)(why));
            }
        }
        Ok(())
    }

    /// Puts every new file into its place.
    pub(super) fn forward(&self) -> Result<(), Stop> {
        let mut waiting = Vec::with_capacity(self.entries.len());
        for entry in &self.entries {
            if !self.exists(&self.staged(entry))? {
                continue;
            }
            if !self.is_old(entry)? {
                let why = io::Error::other("it was changed by another program meanwhile");
                return Err(Stop::at(&entry.target)(why));
            }
            waiting.push(entry);
        }
        for entry in waiting {
            let renamed = self.disk.rename(&self.staged(entry), &entry.target);
            renamed.map_err(Stop::at(&entry.target))?;
        }
        self.sync()
    }

    /// What puts a place back: what is renamed to what; none where it is as before.
    fn step_back(&self, entry: &Entry) -> Result<Option<(PathBuf, PathBuf)>, Stop> {
        let (staged, backup) = (self.staged(entry), self.backup(entry));
        let stop = |why: &str| Err(Stop::at(&entry.target)(io::Error::other(why)));
        if self.exists(&staged)? {
            return Ok(None);
        }
        if Self::is_new(entry, &entry.target) {
            match &entry.old {
                // away in one step, whatever it holds
                None => return Ok(Some((entry.target.clone(), staged))),
                Some(hash) if holds(&backup, hash) => {
                    return Ok(Some((backup, entry.target.clone())));
                }
                Some(_) if self.exists(&backup)? => {
                    return stop("what it held before was changed after a run was stopped");
                }
                Some(_) => {}
            }
        }
        if self.is_old(entry)? {
            return Ok(None);
        }
        stop("it was changed after a run that wrote it was stopped")
    }

    /// Puts everything back: what was replaced comes to its place again, what was not there goes.
    /// Where one cannot be, none is.
    fn backward(&self) -> Result<(), Stop> {
        let entries = self.entries.iter().rev();
        let steps: Result<Vec<_>, Stop> = entries
            .map(|entry| Ok((entry, self.step_back(entry)?)))
            .collect();
        for (entry, step) in steps? {
            if let Some((from, to)) = step {
                let renamed = self.disk.rename(&from, &to);
                renamed.map_err(Stop::at(&entry.target))?;
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
