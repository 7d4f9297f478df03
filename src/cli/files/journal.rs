//! The journal: what a run is about to put in place, written down in the folder where it does so.
//!
//! A run that writes into several folders has its journal in the first of them; those in the others
//! name that folder. The first line says how far it is. Whoever holds the lock of the first may
//! finish or undo what it lists.

use super::disk::Disk;
use super::identity::Identity;
use crate::printable::name_of;
use crate::task::Failure;
use serde::{Deserialize, Serialize};
use std::ffi::{OsStr, OsString};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// How names of poseshift's own files in somebody's folder begin.
pub(in crate::cli) const PREFIX: &str = ".poseshift-";
/// The journal's name.
const NAME: &str = ".poseshift-journal";
/// What its first line begins with.
const FORMAT: &str = "poseshift journal 1 ";
/// How long another run is waited for.
const PATIENCE: Duration = Duration::from_secs(10);
/// How often it is looked again.
const TICK: Duration = Duration::from_millis(10);

/// Whether a text is what a run is called by.
fn is_id(text: &str) -> bool {
    text.len() == 16 && text.bytes().all(|b| b.is_ascii_hexdigit())
}

/// Whether a name is that of a file or folder which a run makes before it has its place.
pub(super) fn is_new_file(name: &OsStr) -> bool {
    let name = name.to_str().and_then(|name| name.strip_prefix(PREFIX));
    let of_run = name.and_then(|name| name.strip_suffix(".new")?.rsplit_once('-'));
    of_run.is_some_and(|(id, number)| is_id(id) && number.parse::<usize>().is_ok())
}

/// Where the journal of a folder is.
pub(super) fn of(folder: &Path) -> PathBuf {
    folder.join(NAME)
}

/// How far a run came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stage {
    /// New files are made next to their places; no other file is touched.
    Staging,
    /// All are made, and are put into their places.
    Commit,
    /// One could not be put into its place: all is put back.
    Undo,
}

impl Stage {
    const ALL: [Self; 3] = [Self::Staging, Self::Commit, Self::Undo];

    /// The first line, of one length.
    pub(super) fn line(self) -> String {
        let word = match self {
            Self::Staging => "staging",
            Self::Commit => "commit ",
            Self::Undo => "undo   ",
        };
        format!("{FORMAT}{word}\n")
    }
}

/// A path as JSON can have it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(untagged)]
enum Name {
    Text(String),
    Raw(OsString),
}

impl From<&Path> for Name {
    fn from(path: &Path) -> Self {
        match path.to_str() {
            Some(text) => Self::Text(text.to_owned()),
            None => Self::Raw(path.as_os_str().to_owned()),
        }
    }
}

impl From<Name> for PathBuf {
    fn from(name: Name) -> Self {
        match name {
            Name::Text(text) => text.into(),
            Name::Raw(raw) => raw.into(),
        }
    }
}

/// A file, or a folder with all that is in it, that is to come to a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Entry {
    /// Its number in the journal: what is next to its place is called by it.
    pub number: usize,
    /// Where it is to be.
    pub target: PathBuf,
    /// SHA-256 of the file that is there; none where none is.
    pub old: Option<String>,
    /// The files, relative to the target, with their SHA-256; a file alone has an empty path.
    pub new: Vec<(PathBuf, String)>,
}

impl Entry {
    /// The folder that holds it.
    pub(super) fn folder(&self) -> &Path {
        self.target.parent().expect("a target stands in a folder")
    }
}

/// What a journal says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Journal {
    /// The run: no other has the same.
    pub id: String,
    /// The folder of the main journal; none where this is it.
    pub main: Option<PathBuf>,
    /// What is to come where.
    pub entries: Vec<Entry>,
}

#[derive(Serialize, Deserialize)]
struct Written {
    what: String,
    id: String,
    main: Option<Name>,
    entries: Vec<WrittenEntry>,
}

#[derive(Serialize, Deserialize)]
struct WrittenEntry {
    target: Name,
    old: Option<String>,
    new: Vec<(Name, String)>,
}

/// For whoever finds it.
const WHAT: &str = "a run of poseshift that was stopped while it wrote here: the next one that \
    reads or writes in this folder finishes or undoes it";

impl Journal {
    /// The bytes of the file that stands in a folder; names in that folder do not say where it is.
    pub(super) fn bytes(&self, folder: &Path, stage: Stage) -> Vec<u8> {
        let entries = self.entries.iter().map(|entry| WrittenEntry {
            target: entry
                .target
                .strip_prefix(folder)
                .unwrap_or(&entry.target)
                .into(),
            old: entry.old.clone(),
            new: entry
                .new
                .iter()
                .map(|(path, hash)| (path.as_path().into(), hash.clone()))
                .collect(),
        });
        let written = Written {
            what: WHAT.into(),
            id: self.id.clone(),
            main: self.main.as_deref().map(Name::from),
            entries: entries.collect(),
        };
        let text = serde_json::to_string_pretty(&written).expect("names and hashes");
        (stage.line() + &text + "\n").into_bytes()
    }

    /// What a journal in this folder says; none where it was not written to its end, and so nothing
    /// else was.
    pub(super) fn read(bytes: &[u8], folder: &Path) -> Result<Option<(Stage, Self)>, String> {
        let stage = Stage::ALL
            .into_iter()
            .find(|stage| bytes.starts_with(stage.line().as_bytes()));
        let Some(stage) = stage else {
            let begun = Stage::Staging.line().into_bytes();
            return if begun.starts_with(bytes) {
                Ok(None)
            } else {
                Err("it is no journal that this version of poseshift knows".into())
            };
        };
        let text = &bytes[stage.line().len()..];
        let written: Written = match serde_json::from_slice(text) {
            Ok(written) => written,
            Err(_) if stage == Stage::Staging => return Ok(None),
            Err(error) => return Err(error.to_string()),
        };
        let entries = written.entries.into_iter().enumerate();
        let entries = entries.map(|(number, entry)| Entry {
            number,
            target: folder.join(PathBuf::from(entry.target)),
            old: entry.old,
            new: entry
                .new
                .into_iter()
                .map(|(path, hash)| (path.into(), hash))
                .collect(),
        });
        let journal = Self {
            id: written.id,
            main: written.main.map(PathBuf::from),
            entries: entries.collect(),
        };
        journal.refuse_elsewhere()?;
        Ok(Some((stage, journal)))
    }

    /// Names that lead out of their folders are no work of poseshift.
    fn refuse_elsewhere(&self) -> Result<(), String> {
        use std::path::Component::{Normal, ParentDir};
        let id = is_id(&self.id);
        let inside = |path: &Path| path.components().all(|part| matches!(part, Normal(_)));
        let is_sound = |entry: &Entry| {
            entry.target.file_name().is_some()
                && !entry.target.components().any(|part| part == ParentDir)
                && entry.new.iter().all(|(path, _)| inside(path))
        };
        if id && self.entries.iter().all(is_sound) {
            Ok(())
        } else {
            Err("its names lead elsewhere".into())
        }
    }
}

/// A journal that no other run works with.
pub(super) struct Held {
    pub path: PathBuf,
    pub file: File,
}

/// Waits for the lock of a file.
fn lock(file: &File, path: &Path) -> Result<(), Failure> {
    let mut waited = Duration::ZERO;
    loop {
        match file.try_lock() {
            // a file system without locks
            Ok(()) | Err(TryLockError::Error(_)) => return Ok(()),
            Err(TryLockError::WouldBlock) if waited >= PATIENCE => {
                let folder = path.parent().unwrap_or(path);
                return Err(Failure::with_hint(
                    format!(
                        "another run of poseshift has been writing into {} for {} s",
                        name_of(folder),
                        PATIENCE.as_secs()
                    ),
                    "wait for it, or end it: it holds the journal there",
                ));
            }
            Err(TryLockError::WouldBlock) => std::thread::sleep(TICK),
        }
        waited += TICK;
    }
}

/// Whether the file is still the one at the path.
fn is_there(file: &File, path: &Path) -> bool {
    Identity::of_file(file).is_some_and(|own| Identity::of(path).is_some_and(|at| at == own))
}

impl Held {
    /// The journal of a folder; none where there is none.
    pub(super) fn existing(folder: &Path) -> Result<Option<Self>, Failure> {
        let path = of(folder);
        loop {
            match std::fs::symlink_metadata(&path) {
                Err(_) => return Ok(None),
                Ok(found) if !found.is_file() => {
                    return Err(foreign(&path, "it is no file"));
                }
                Ok(_) => {}
            }
            let file = match File::open(&path) {
                Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
                file => file.map_err(|error| Failure::file(&path, "read", &error))?,
            };
            lock(&file, &path)?;
            if is_there(&file, &path) {
                return Ok(Some(Self { path, file }));
            }
        }
    }

    /// A new journal in a folder; none where there is one already.
    pub(super) fn new(disk: &Disk, folder: &Path, bytes: &[u8]) -> Result<Option<Self>, Failure> {
        let path = of(folder);
        let fault = |error: &std::io::Error| Failure::file(folder, "write into", error);
        disk.step().map_err(|error| fault(&error))?;
        let opened = OpenOptions::new().write(true).create_new(true).open(&path);
        let mut file = match opened {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => return Ok(None),
            file => file.map_err(|error| fault(&error))?,
        };
        lock(&file, &path)?;
        if !is_there(&file, &path) {
            // taken for one that was left behind before it was locked
            return Ok(None);
        }
        let written = disk.step().and_then(|()| file.write_all(bytes));
        let written = written.and_then(|()| file.sync_all());
        if let Err(error) = written {
            // nothing is listed, nothing is undone
            let _ = disk.remove(&path);
            return Err(fault(&error));
        }
        Ok(Some(Self { path, file }))
    }

    /// Says how far the run is.
    pub(super) fn set(&self, disk: &Disk, stage: Stage) -> std::io::Result<()> {
        disk.overwrite(&self.path, stage.line().as_bytes())
    }
}

/// That a journal is none that this run may act upon.
pub(super) fn foreign(path: &Path, why: &str) -> Failure {
    Failure::with_hint(
        format!("{}: {why}", name_of(path)),
        format!(
            "nothing is read or written in a folder with a run that was stopped and can be neither \
             finished nor undone: put back what its files held before (what ends in .old holds \
             it), or keep them as they are; then remove this one and those next to it that begin \
             with {PREFIX}"
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn journal() -> Journal {
        Journal {
            id: "0123456789abcdef".into(),
            main: None,
            entries: vec![Entry {
                number: 0,
                target: "/a/b.mod".into(),
                old: None,
                new: vec![(PathBuf::new(), "00".into())],
            }],
        }
    }

    #[test]
    fn a_journal_is_read_as_it_is_written_and_its_beginning_says_nothing() {
        let folder = Path::new("/a");
        for stage in Stage::ALL {
            let bytes = journal().bytes(folder, stage);
            assert_eq!(Journal::read(&bytes, folder), Ok(Some((stage, journal()))));
        }
        let bytes = journal().bytes(folder, Stage::Staging);
        for end in 0..bytes.len() - 2 {
            assert_eq!(Journal::read(&bytes[..end], folder), Ok(None), "{end}");
        }
        // the folder may have been moved
        let (_, moved) = Journal::read(&bytes, Path::new("/c"))
            .expect("one")
            .expect("whole");
        assert_eq!(moved.entries[0].target, Path::new("/c/b.mod"));
    }

    #[test]
    fn names_that_lead_out_of_the_folder_are_refused() {
        let folder = Path::new("/a");
        for target in ["../b.mod", "/", "x/../../b.mod"] {
            let mut journal = journal();
            journal.entries[0].target = target.into();
            let bytes = journal.bytes(folder, Stage::Commit);
            assert!(Journal::read(&bytes, folder).is_err(), "{target}");
        }
        assert!(Journal::read(b"PK\x03\x04", folder).is_err());
        assert!(Journal::read(b"poseshift journal 2 staging\n{}", folder).is_err());
    }
}
