//! The steps on disk that a transaction is made of. Tests stop them anywhere.

use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{Error, ErrorKind, Result, Write};
use std::path::Path;

/// What may stop a step.
type Gate = Box<dyn Fn() -> Result<()> + Send + Sync>;

/// Makes the steps.
pub(super) struct Disk {
    /// Asked before each step.
    gate: Gate,
}

impl Default for Disk {
    fn default() -> Self {
        Self::gated(|| Ok(()))
    }
}

impl Disk {
    /// A disk whose steps are asked for first.
    pub(super) fn gated(gate: impl Fn() -> Result<()> + Send + Sync + 'static) -> Self {
        Self {
            gate: Box::new(gate),
        }
    }

    /// Asks whether a step is made.
    pub(super) fn step(&self) -> Result<()> {
        (self.gate)()
    }

    /// A new file that stays when the power goes. It has the mode and the owner of `like`; without
    /// it what the umask says.
    pub(super) fn create(&self, path: &Path, bytes: &[u8], like: Option<&Path>) -> Result<()> {
        self.step()?;
        let mut options = OpenOptions::new();
        options.write(true).create_new(true);
        #[cfg(unix)]
        if like.is_some() {
            // nobody else reads it before it has its own mode
            std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        }
        let mut file = options.open(path)?;
        self.step()?;
        file.write_all(bytes)?;
        self.step()?;
        if let Some(like) = like {
            dress(&file, &fs::metadata(like)?)?;
        }
        file.sync_all()
    }

    /// Whether there is anything at a path.
    pub(super) fn exists(&self, path: &Path) -> Result<bool> {
        self.step()?;
        match fs::symlink_metadata(path) {
            Ok(_) => Ok(true),
            Err(error)
                if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) =>
            {
                Ok(false)
            }
            Err(error) => Err(error),
        }
    }

    /// Writes over the beginning of a file.
    pub(super) fn overwrite(&self, path: &Path, bytes: &[u8]) -> Result<()> {
        self.step()?;
        let mut file = OpenOptions::new().write(true).open(path)?;
        file.write_all(bytes)?;
        file.sync_all()
    }

    /// A new folder.
    pub(super) fn create_folder(&self, path: &Path) -> Result<()> {
        self.step()?;
        fs::create_dir(path)
    }

    /// A second name of a file, or where there is no such thing a copy with its mode, owner and
    /// time.
    pub(super) fn keep(&self, path: &Path, backup: &Path) -> Result<()> {
        self.step()?;
        if fs::hard_link(path, backup).is_ok() {
            return Ok(());
        }
        self.create(backup, &fs::read(path)?, Some(path))?;
        let time = fs::metadata(path)?.modified()?;
        OpenOptions::new()
            .write(true)
            .open(backup)?
            .set_modified(time)
    }

    /// Puts a file or folder in the place of another.
    pub(super) fn rename(&self, from: &Path, to: &Path) -> Result<()> {
        self.step()?;
        fs::rename(from, to)
    }

    /// Removes a file or a folder with all that it holds, where it is.
    pub(super) fn remove(&self, path: &Path) -> Result<()> {
        self.step()?;
        let removed = match fs::symlink_metadata(path) {
            Ok(found) if found.is_dir() => fs::remove_dir_all(path),
            Ok(_) => fs::remove_file(path),
            Err(error) => Err(error),
        };
        match removed {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    /// Makes the names in a folder stay when the power goes.
    pub(super) fn sync_folder(&self, path: &Path) -> Result<()> {
        self.step()?;
        if cfg!(unix) {
            File::open(path)?.sync_all()?;
        }
        Ok(())
    }
}

/// Gives a new file the mode and the owner of the one whose place it will take.
fn dress(file: &File, old: &fs::Metadata) -> Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let new = file.metadata()?;
        let other = |new: u32, old: u32| (new != old).then_some(old);
        let (owner, group) = (other(new.uid(), old.uid()), other(new.gid(), old.gid()));
        if owner.is_some() || group.is_some() {
            fchown(file, owner, group).map_err(|error| {
                let (user, group) = (old.uid(), old.gid());
                let message =
                    format!("its owner (user {user}, group {group}) cannot be kept: {error}");
                Error::new(error.kind(), message)
            })?;
        }
    }
    file.set_permissions(Permissions::clone(&old.permissions()))
}
