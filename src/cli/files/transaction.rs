//! Everything that a run writes, put in place as a whole: made and synced next to its places, then
//! renamed.
//!
//! At any moment the journal says what is to be done with what is there, so that a run that is
//! killed is finished or undone by the next: before the journal says `commit` nothing but new names
//! was made; from then on every new file is on disk.

use super::disk::Disk;
use super::journal::{Entry, Held, Journal, Stage};
use super::recovery::recover;
use super::work::{Stop, Work, hash_of};
use crate::printable::name_of;
use crate::program::sha256;
use crate::task::Failure;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::hash::{BuildHasher, RandomState};
use std::path::{Path, PathBuf};

/// How often a journal that another run left is settled before one of our own is begun.
const TRIES: usize = 10;

/// One file to write: where it really is to be, as whom the user knows it, and what it holds.
pub(super) struct New<'a> {
    pub place: PathBuf,
    pub name: &'a Path,
    pub bytes: &'a [u8],
}

/// All that a run writes, on disk next to its places; put back where it is dropped.
pub(super) struct Transaction<'a> {
    work: Work<'a>,
    /// As whom the user knows the places.
    names: BTreeMap<PathBuf, PathBuf>,
    is_done: bool,
}

impl<'a> Transaction<'a> {
    /// Makes all files next to their places. `said` takes what is to be said of runs before.
    ///
    /// # Errors
    /// One cannot be made: nothing is changed.
    pub(super) fn stage(
        disk: &'a Disk,
        files: &[New],
        said: &mut Vec<String>,
    ) -> Result<Self, Failure> {
        let hashes: Vec<String> = files.par_iter().map(|file| sha256(file.bytes)).collect();
        for _ in 0..TRIES {
            let (planned, contents) = entries(disk, files, &hashes)?;
            let transaction = Self::begun(disk, files, planned, said)?;
            // until the journal was ours another run may have written there
            let (entries, _) = entries(disk, files, &hashes)?;
            if entries != transaction.work.entries {
                continue;
            }
            let made = (0..contents.len())
                .into_par_iter()
                .map(|number| transaction.make(number, &contents[number]))
                .find_any(Result::is_err);
            return match made {
                Some(Err(stop)) => Err(transaction.failure(&stop)),
                _ => Ok(transaction),
            };
        }
        Err(busy(files[0].name))
    }

    /// The journals, and nothing else.
    fn begun(
        disk: &'a Disk,
        files: &[New],
        entries: Vec<Entry>,
        said: &mut Vec<String>,
    ) -> Result<Self, Failure> {
        let journal = Journal {
            id: format!("{:016x}", RandomState::new().hash_one(std::process::id())),
            main: None,
            entries,
        };
        let folders = journal
            .entries
            .iter()
            .map(|entry| entry.folder().to_owned());
        let folders: BTreeSet<PathBuf> = folders.collect();
        // always in the same order: no two runs wait for one another
        let mut folders = folders.iter();
        let main = folders.next().expect("something is written");
        let held = begin(disk, main, &journal, said)?;
        let pointer = Journal {
            main: Some(main.clone()),
            entries: Vec::new(),
            ..journal.clone()
        };
        let names = files
            .iter()
            .map(|file| (file.place.clone(), file.name.to_owned()));
        let transaction = Self {
            work: Work {
                disk,
                held,
                id: journal.id,
                entries: journal.entries,
            },
            names: names.collect(),
            is_done: false,
        };
        for folder in folders {
            begin(disk, folder, &pointer, said)?;
        }
        Ok(transaction)
    }

    /// Makes one entry next to its place.
    fn make(&self, number: usize, files: &[(PathBuf, &[u8])]) -> Result<(), Stop> {
        let (work, entry) = (&self.work, &self.work.entries[number]);
        let (disk, staged, target) = (work.disk, work.staged(entry), &entry.target);
        if let [(path, bytes)] = files
            && path.as_os_str().is_empty()
        {
            let stop = Stop::at(target);
            let like = entry.old.as_ref().map(|_| target.as_path());
            disk.create(&staged, bytes, like).map_err(&stop)?;
            if like.is_some() {
                disk.keep(target, &work.backup(entry)).map_err(&stop)?;
            }
            return Ok(());
        }
        let mut folders = BTreeSet::new();
        for (path, _) in files {
            let file = staged.join(path);
            let above = file.ancestors().skip(1);
            let above = above.take_while(|folder| folder.starts_with(&staged));
            folders.extend(above.map(Path::to_owned));
        }
        // those above come before those below
        for folder in &folders {
            disk.create_folder(folder).map_err(Stop::at(target))?;
        }
        files.par_iter().try_for_each(|(path, bytes)| {
            let made = disk.create(&staged.join(path), bytes, None);
            made.map_err(Stop::at(&target.join(path)))
        })?;
        for folder in folders {
            disk.sync_folder(&folder).map_err(Stop::at(target))?;
        }
        Ok(())
    }

    fn failure(&self, stop: &Stop) -> Failure {
        let known = self.names.get(&stop.path).unwrap_or(&stop.path);
        Failure::file(known, "write", &stop.why)
    }

    /// Puts all files into their places. What is to be said where something that is no longer needed
    /// stays.
    ///
    /// # Errors
    /// One cannot be put there: all are put back.
    pub(super) fn commit(mut self) -> Result<Option<String>, Failure> {
        let work = &self.work;
        let stop_at_journal = Stop::at(&work.held.path);
        let begun = work.refuse_gone().and_then(|()| work.sync());
        let begun = begun.and_then(|()| {
            let set = work.held.set(work.disk, Stage::Commit);
            set.map_err(stop_at_journal)
        });
        if let Err(stop) = begun {
            // it may say `commit` already: what it lists is put back either way
            let failure = self.failure(&stop);
            return Err(self.put_back(failure));
        }
        if let Err(stop) = work.forward() {
            let failure = self.failure(&stop);
            return Err(self.put_back(failure));
        }
        let cleaned = work.clean();
        self.is_done = true;
        Ok(cleaned.err().map(|stop| {
            format!(
                "all files are written; {} could not be removed ({}): the next run that writes in its \
                 folder does so",
                name_of(&stop.path),
                stop.why
            )
        }))
    }

    fn put_back(&mut self, failure: Failure) -> Failure {
        self.is_done = true;
        match self.work.undo() {
            Ok(()) => Failure {
                hint: "nothing is written".into(),
                ..failure
            },
            Err(stop) => Failure {
                hint: format!(
                    "and {} could not be put back ({}): the next run in this folder tries it again",
                    name_of(&stop.path),
                    stop.why
                ),
                ..failure
            },
        }
    }
}

impl Drop for Transaction<'_> {
    fn drop(&mut self) {
        if !self.is_done {
            // nothing is in its place yet; what cannot be removed is removed by the next run
            let _ = self.work.clean();
        }
    }
}

/// A journal of our own in a folder, after those before are settled.
fn begin(
    disk: &Disk,
    folder: &Path,
    journal: &Journal,
    said: &mut Vec<String>,
) -> Result<Held, Failure> {
    let bytes = journal.bytes(folder, Stage::Staging);
    for _ in 0..TRIES {
        said.extend(recover(disk, folder)?);
        if let Some(held) = Held::new(disk, folder, &bytes)? {
            return Ok(held);
        }
    }
    Err(busy(folder))
}

fn busy(path: &Path) -> Failure {
    Failure::new(format!(
        "other runs of poseshift keep writing to {}",
        name_of(path)
    ))
}

/// Whether there is anything at a path.
fn exists(disk: &Disk, path: &Path) -> Result<bool, Failure> {
    let found = disk.exists(path);
    found.map_err(|error| Failure::file(path, "read", &error))
}

/// The highest folder of a file that is not there yet.
fn new_folder<'a>(disk: &Disk, place: &'a Path) -> Result<Option<&'a Path>, Failure> {
    let mut highest = None;
    for folder in place.ancestors().skip(1) {
        if exists(disk, folder)? {
            break;
        }
        highest = Some(folder);
    }
    Ok(highest)
}

/// Files relative to an entry, with what they hold.
type Contents<'a> = Vec<(PathBuf, &'a [u8])>;

/// What is renamed: files, and new folders whole. `hashes` are those of the files.
fn entries<'a>(
    disk: &Disk,
    files: &[New<'a>],
    hashes: &[String],
) -> Result<(Vec<Entry>, Vec<Contents<'a>>), Failure> {
    let mut trees: BTreeMap<&Path, Vec<(PathBuf, usize)>> = BTreeMap::new();
    for (index, file) in files.iter().enumerate() {
        let target = new_folder(disk, &file.place)?.unwrap_or(&file.place);
        let below = file
            .place
            .strip_prefix(target)
            .expect("it is below")
            .to_owned();
        trees.entry(target).or_default().push((below, index));
    }
    let mut entries = Vec::with_capacity(trees.len());
    let mut contents = Vec::with_capacity(trees.len());
    for (target, below) in trees {
        let old = if exists(disk, target)? {
            Some(hash_of(target).map_err(|error| Failure::file(target, "read", &error))?)
        } else {
            None
        };
        let new = below.iter();
        let new = new.map(|(path, index)| (path.clone(), hashes[*index].clone()));
        entries.push(Entry {
            number: entries.len(),
            target: target.to_owned(),
            old,
            new: new.collect(),
        });
        let held = below.into_iter();
        let held = held.map(|(path, index)| (path, files[index].bytes));
        contents.push(held.collect());
    }
    Ok((entries, contents))
}
