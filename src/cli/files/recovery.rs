//! What a run that was stopped left in a folder, finished or undone.

use super::disk::Disk;
use super::journal::{self, Entry, Held, Journal, Stage, foreign};
use super::work::{Stop, Work, is_of_run};
use crate::printable::name_of;
use crate::task::Failure;
use std::fs;
use std::path::{Path, PathBuf};

/// Names that a message lists.
const NAMED: usize = 5;

/// Whether a journal in a folder is of a file, or of a folder that it is in.
pub(super) fn concerns(folder: &Path, path: &Path) -> bool {
    let Ok(bytes) = fs::read(journal::of(folder)) else {
        return false;
    };
    let read = Journal::read(&bytes, folder).ok().flatten();
    let is_of = |entry: &Entry| path.starts_with(&entry.target);
    read.is_some_and(|(_, journal)| journal.entries.iter().any(is_of))
}

/// Finishes or undoes what a run that was stopped left in a folder, and says so.
///
/// # Errors
/// It can be neither finished nor undone; another run is writing there.
pub(super) fn recover(disk: &Disk, folder: &Path) -> Result<Option<String>, Failure> {
    settle(disk, folder, false)
}

/// `is_main`: the journal of another folder says that the main one is here.
fn settle(disk: &Disk, folder: &Path, is_main: bool) -> Result<Option<String>, Failure> {
    // in this order: a run that begins meanwhile has a journal before it has new files
    let made = new_files(folder);
    let Some(held) = Held::existing(folder)? else {
        return Ok(remove_abandoned(disk, folder, &made));
    };
    let path = held.path.clone();
    let bytes = fs::read(&path).map_err(|error| Failure::file(&path, "read", &error))?;
    refuse_of_another(&held, folder)?;
    let read = Journal::read(&bytes, folder).map_err(|why| foreign(&path, &why))?;
    let Some((stage, journal)) = read else {
        let removed = disk.remove(&path);
        removed.map_err(|error| Failure::file(&path, "remove", &error))?;
        return Ok(None);
    };
    if let Some(main) = journal.main {
        // who holds the main journal may remove this one
        drop(held);
        let said = if is_main {
            None
        } else {
            settle(disk, &main, true)?
        };
        return if is_of_run(&path, &journal.id) {
            Err(foreign(&path, "the journal of its run is gone"))
        } else {
            Ok(said)
        };
    }
    let mut work = Work {
        disk,
        held,
        id: journal.id,
        entries: Vec::new(),
    };
    // what is elsewhere is there only if that folder says so, too: else it is done already, or was
    // never begun
    let here = |entry: &Entry| {
        entry.folder() == folder || is_of_run(&journal::of(entry.folder()), &work.id)
    };
    let entries: Vec<Entry> = journal.entries.into_iter().filter(here).collect();
    work.entries = entries;
    let fault = |stop: Stop| foreign(&path, &format!("{}: {}", name_of(&stop.path), stop.why));
    if work.entries.is_empty() {
        return work.clean().map(|()| None).map_err(fault);
    }
    let names: Vec<String> = work
        .entries
        .iter()
        .map(|entry| name_of(&entry.target))
        .collect();
    let names = listed(&names);
    let undone =
        format!("undone what a run that was stopped had begun to write: as before are {names}");
    let done = match stage {
        Stage::Staging => work.clean().map(|()| undone),
        Stage::Undo => work.undo().map(|()| undone),
        Stage::Commit => match work
            .refuse_damaged()
            .and_then(|()| work.forward())
            .and_then(|()| work.clean())
        {
            Ok(()) => Ok(format!(
                "finished what a run that was stopped had begun to write: new are {names}"
            )),
            Err(stop) => {
                let why = format!("{undone} ({}: {})", name_of(&stop.path), stop.why);
                work.undo().map(|()| why)
            }
        },
    };
    done.map(Some).map_err(fault)
}

/// What runs have made in a folder that is not in its place yet.
fn new_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let is_new = |path: &PathBuf| path.file_name().is_some_and(journal::is_new_file);
    entries.map(|entry| entry.path()).filter(is_new).collect()
}

/// Removes new files that no journal speaks of any more: somebody has removed it.
fn remove_abandoned(disk: &Disk, folder: &Path, made: &[PathBuf]) -> Option<String> {
    let gone = made
        .iter()
        .filter(|path| disk.exists(path).unwrap_or(false) && disk.remove(path).is_ok());
    let names: Vec<String> = gone.map(|path| name_of(path)).collect();
    (!names.is_empty()).then(|| {
        format!(
            "removed what a run that was stopped had left in {}, without a journal of it: {}",
            name_of(folder),
            listed(&names)
        )
    })
}

/// Some names, and how many more there are.
fn listed(names: &[String]) -> String {
    let shown = names[..names.len().min(NAMED)].join(", ");
    match names.len().saturating_sub(NAMED) {
        0 => shown,
        rest => format!("{shown} and {rest} more"),
    }
}

/// That a journal is not that of another user: it says what is written over what.
fn refuse_of_another(held: &Held, folder: &Path) -> Result<(), Failure> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let fault = |error: std::io::Error| Failure::file(folder, "write into", &error);
        let owner = held.file.metadata().map_err(fault)?.uid();
        let own = tempfile::tempfile_in(folder).and_then(|file| file.metadata());
        if owner != own.map_err(fault)?.uid() {
            return Err(foreign(
                &held.path,
                &format!("it is of another user ({owner})"),
            ));
        }
    }
    Ok(())
}
