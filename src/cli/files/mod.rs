//! Files in and out of one run: what was read stays what it was until what is written stands in its
//! place, and nothing is written over it.

mod disk;
mod identity;
mod journal;
mod listing;
mod place;
mod recovery;
#[cfg(test)]
mod tests;
mod transaction;
mod work;

pub(super) use identity::Identity;
pub(super) use listing::{Listing, is_own, meant_by};
pub(super) use place::{is_standard_output, is_stream};

use super::screen;
use crate::printable::name_of;
use crate::program::Source;
use crate::task::profile::way_to_built_in;
use crate::task::{Failure, ProfileFile};
use disk::Disk;
use foldhash::quality::RandomState;
use identity::Stamp;
use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs::File;
use std::hash::BuildHasher;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use transaction::{New, Transaction};

/// A file to write: where, as the user names it, and what it holds.
pub(super) type NewFile<'a> = (PathBuf, Cow<'a, [u8]>);

/// Bytes of a file: some ten million triangles, moves or rows.
const LARGEST: u64 = 1 << 30;
/// A file that was changed so shortly before it was read may be changed again without another time.
const RACY: Duration = Duration::from_secs(2);

/// A file that was read.
struct Input {
    path: PathBuf,
    identity: Option<Identity>,
    stamp: Stamp,
    hash: u64,
    /// Its time says nothing of changes after it was read.
    is_racy: bool,
    /// What is written may take its place.
    is_replaced: bool,
}

/// What a run has read, and what becomes of what it writes.
#[derive(Default)]
pub(super) struct Files {
    disk: Disk,
    inputs: RefCell<Vec<Input>>,
    /// The folders that were read.
    listings: RefCell<Vec<Listing>>,
    /// Folders in which no run is left that was stopped.
    settled: RefCell<BTreeSet<PathBuf>>,
    /// Standard input gives its bytes once.
    has_read_input: Cell<bool>,
    /// Of the contents of the inputs.
    hasher: RandomState,
}

/// What is no file that bytes can be taken from.
fn refuse_device(found: &std::fs::Metadata) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        let kind = found.file_type();
        if kind.is_char_device() || kind.is_block_device() || kind.is_socket() {
            return Err(io::Error::other("it is a device or a socket, no file"));
        }
    }
    if found.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    Ok(())
}

/// That what is printed does not go into a file that is read: `… >> INPUT`.
fn refuse_onto_itself(identity: Option<&Identity>) -> io::Result<()> {
    if identity.is_none() {
        return Ok(());
    }
    if identity == Identity::of_standard_error().as_ref() {
        screen::mute_errors();
        return Err(io::Error::other("standard error would be written onto it"));
    }
    if identity == Identity::of_standard_output().as_ref() {
        return Err(io::Error::other("standard output would be written onto it"));
    }
    Ok(())
}

/// More than any file has that is read as a whole.
fn refuse_large(about: &std::fs::Metadata) -> io::Result<()> {
    if about.is_file() && about.len() > LARGEST {
        let message = format!("it has {} bytes; at most {LARGEST} are read", about.len());
        return Err(io::Error::other(message));
    }
    Ok(())
}

impl Files {
    /// A file's bytes.
    pub(super) fn read(&self, path: &Path) -> Result<Vec<u8>, Failure> {
        self.settle(path)?;
        self.bytes(path)
            .map_err(|error| Failure::file(path, "read", &error))
    }

    /// A file's bytes, for those who name it themselves where that fails.
    pub(super) fn bytes(&self, path: &Path) -> io::Result<Vec<u8>> {
        refuse_device(&std::fs::metadata(path)?)?;
        self.taken(path, File::open(path)?)
    }

    /// All that an open file gives.
    fn taken(&self, path: &Path, mut file: File) -> io::Result<Vec<u8>> {
        let before = file.metadata()?;
        refuse_large(&before)?;
        let identity = Identity::of_file(&file).filter(|_| before.is_file());
        refuse_onto_itself(identity.as_ref())?;
        let mut bytes = Vec::with_capacity(usize::try_from(before.len()).unwrap_or(0));
        file.read_to_end(&mut bytes)?;
        if !before.is_file() {
            // what a pipe gave cannot change any more
            return Ok(bytes);
        }
        let stamp = Stamp::new(&before);
        if Stamp::new(&file.metadata()?) != stamp {
            return Err(io::Error::other("it changed while it was read"));
        }
        let age = before
            .modified()
            .map(|time| SystemTime::now().duration_since(time));
        self.inputs.borrow_mut().push(Input {
            path: path.to_owned(),
            identity,
            stamp,
            hash: self.hasher.hash_one(&bytes),
            is_racy: !matches!(age, Ok(Ok(age)) if age > RACY),
            is_replaced: false,
        });
        Ok(bytes)
    }

    /// What standard input gives, once.
    pub(super) fn standard_input(&self) -> Result<Vec<u8>, Failure> {
        let fault = |error: io::Error| Failure::new(format!("cannot read standard input: {error}"));
        if self.has_read_input.replace(true) {
            return Err(Failure::new("standard input is read once only"));
        }
        #[cfg(unix)]
        {
            use std::os::fd::AsFd;
            let input = io::stdin().as_fd().try_clone_to_owned();
            let input = File::from(input.map_err(fault)?);
            let bytes = self.taken(Path::new("/dev/stdin"), input).map_err(fault)?;
            if let Some(input) = self.inputs.borrow_mut().last_mut() {
                // where it began to be read is not known: its time has to do
                input.is_racy &= input.path != Path::new("/dev/stdin");
            }
            Ok(bytes)
        }
        #[cfg(not(unix))]
        {
            let mut bytes = Vec::new();
            let read = io::stdin().read_to_end(&mut bytes);
            read.map(|_| bytes).map_err(fault)
        }
    }

    /// A file by its name and its bytes.
    pub(super) fn source(&self, path: &Path) -> Result<Source, Failure> {
        Ok(Source::new(name_of(path), self.read(path)?))
    }

    /// The bytes of a mesh, or of a file that a mesh names: of a plain file, as a device has no
    /// end.
    pub(super) fn mesh(&self, path: &Path) -> io::Result<Vec<u8>> {
        let about = std::fs::metadata(path)?;
        if !about.is_file() {
            return Err(io::Error::other("it is no plain file"));
        }
        self.bytes(path)
    }

    /// A profile.
    pub(super) fn profile(&self, path: &Path) -> Result<ProfileFile, Failure> {
        let source = self.source(path).map_err(|failure| {
            let name = path.file_stem().and_then(|name| name.to_str());
            let built_in = name.and_then(way_to_built_in).filter(|_| !path.exists());
            Failure {
                hint: built_in.unwrap_or(failure.hint),
                ..failure
            }
        })?;
        ProfileFile::read(&source)
    }

    /// Takes that a file which was read is written over.
    pub(super) fn replace(&self, path: &Path) {
        let identity = Identity::of(path);
        for input in self.inputs.borrow_mut().iter_mut() {
            input.is_replaced |= input.identity == identity;
        }
    }

    /// Finishes or undoes what a run that was stopped left in the folder of a file, or in a folder;
    /// whether there was any.
    pub(super) fn settle(&self, path: &Path) -> Result<bool, Failure> {
        let mut was_any = false;
        let linked = || {
            path.is_symlink()
                .then(|| path.canonicalize().ok())
                .flatten()
        };
        let linked = linked();
        let above = [Some(path), linked.as_deref()].into_iter().flatten();
        let above = above.filter_map(Path::parent).map(|folder| {
            if folder.as_os_str().is_empty() {
                Path::new(".")
            } else {
                folder
            }
        });
        let mut recover = |folder: &Path| -> Result<(), Failure> {
            if let Some(said) = recovery::recover(&self.disk, folder)? {
                screen::warn(&said);
                was_any = true;
            }
            Ok(())
        };
        let mut is_new = false;
        for folder in above.chain([path]) {
            if !self.settled.borrow_mut().insert(folder.to_owned()) {
                continue;
            }
            is_new = true;
            if let Ok(folder) = folder.canonicalize()
                && folder.is_dir()
            {
                recover(&folder)?;
            }
        }
        // new folders are put in place as a whole: the journal stands above the first of them
        let whole = path.canonicalize().or_else(|_| std::path::absolute(path));
        if let Some(whole) = whole.ok().filter(|_| is_new) {
            for folder in whole.ancestors().skip(2) {
                if recovery::concerns(folder, &whole) {
                    recover(folder)?;
                }
            }
        }
        Ok(was_any)
    }

    /// Where outputs go, those to standard output left out.
    ///
    /// # Errors
    /// One takes the place of what is read, or of another; or nothing can be written there.
    fn places<'a>(&self, outputs: &[&'a Path]) -> Result<Vec<(PathBuf, &'a Path)>, Failure> {
        let mut places = Vec::new();
        let mut streams = 0;
        for output in outputs {
            if is_standard_output(output) {
                streams += 1;
            } else {
                self.settle(output)?;
                places.push((place::place(output)?, *output));
            }
        }
        if streams > 1 {
            return Err(Failure::new(
                "two outputs would be written to standard output",
            ));
        }
        let inputs = self.inputs.borrow();
        let kept = inputs.iter().filter(|input| !input.is_replaced);
        let read: HashMap<&Identity, &Path> = kept
            .filter_map(|input| Some((input.identity.as_ref()?, input.path.as_path())))
            .collect();
        let mut taken: BTreeMap<&Path, &Path> = BTreeMap::new();
        let mut same: HashMap<Identity, &Path> = HashMap::new();
        let streams = [
            (Identity::of_standard_output(), "standard output"),
            (Identity::of_standard_error(), "standard error"),
        ];
        for (place, output) in &places {
            let identity = Identity::of(place);
            if let Some(input) = identity.as_ref().and_then(|identity| read.get(identity)) {
                let as_read = if input == output {
                    String::new()
                } else {
                    format!(" (as {})", name_of(input))
                };
                return Err(Failure::with_hint(
                    format!(
                        "{} is read{as_read} and would be written over",
                        name_of(output)
                    ),
                    "name another file for what is written, or say by --in-place that it is meant \
                     where the command has that option",
                ));
            }
            let onto = streams.iter().find(|(s, _)| s.is_some() && *s == identity);
            if let Some((_, stream)) = onto {
                return Err(Failure::with_hint(
                    format!(
                        "{} takes the place of what {stream} goes to",
                        name_of(output)
                    ),
                    "name another file for one of them; `-` is standard output",
                ));
            }
            let other = taken.insert(place, output);
            if other
                .or(identity.and_then(|identity| same.insert(identity, output)))
                .is_some()
            {
                return Err(Failure::with_hint(
                    format!("two outputs would be written to {}", name_of(output)),
                    "name another file for one of them, or give the folder above both inputs",
                ));
            }
        }
        for (place, output) in &places {
            let mut above = place.ancestors().skip(1);
            if above.any(|folder| taken.contains_key(folder)) {
                return Err(Failure::with_hint(
                    format!(
                        "{} would be written into a file that is written, too",
                        name_of(output)
                    ),
                    "name another file for one of them",
                ));
            }
        }
        Ok(places)
    }

    /// An output takes the place of nothing that is read, nor of another output. Asked again when
    /// it is written; asked before, it spares the work.
    ///
    /// # Errors
    /// One would, or nothing can be written there.
    pub(super) fn refuse_over<'a>(
        &self,
        outputs: impl IntoIterator<Item = &'a Path>,
    ) -> Result<(), Failure> {
        let outputs: Vec<&Path> = outputs.into_iter().collect();
        self.places(&outputs).map(|_| ())
    }

    /// Keeps what a folder holds: what comes to it before the end is an error.
    pub(super) fn listed(&self, listing: Listing) {
        self.listings.borrow_mut().push(listing);
    }

    /// That nothing that was read is another file by now, and no other has come.
    fn refuse_changed(&self) -> Result<(), Failure> {
        for listing in self.listings.borrow().iter() {
            let how = match listing.added() {
                Ok(None) => continue,
                Ok(Some(path)) => format!("{} was added", name_of(&path)),
                Err(path) => format!("{} cannot be listed any more", name_of(&path)),
            };
            return Err(Failure::with_hint(
                format!("{how} after the folder was read"),
                "nothing is written; run it again",
            ));
        }
        for input in self.inputs.borrow().iter() {
            let changed = |how: &str| {
                Err(Failure::with_hint(
                    format!("{} {how} after it was read", name_of(&input.path)),
                    "nothing is written; run it again",
                ))
            };
            let Ok(now) = std::fs::metadata(&input.path) else {
                return changed("was removed");
            };
            let same =
                Stamp::new(&now) == input.stamp && Identity::of(&input.path) == input.identity;
            if same && !input.is_racy {
                continue;
            }
            let bytes = std::fs::read(&input.path);
            if !bytes.is_ok_and(|bytes| self.hasher.hash_one(&bytes) == input.hash) {
                return changed("was changed");
            }
        }
        Ok(())
    }

    /// Writes all files, or none: while they are made next to their places, `verify` looks at what
    /// they hold; between what can go wrong and putting them into place, `print` is done.
    ///
    /// # Errors
    /// One cannot be written; what was read has changed; or those of `verify` and `print`. Nothing
    /// is written then.
    pub(super) fn write<E: From<Failure>>(
        &self,
        outputs: &[NewFile],
        verify: impl FnOnce() -> Result<(), Failure> + Send,
        print: impl FnOnce() -> Result<(), E>,
    ) -> Result<(), E> {
        let paths: Vec<&Path> = outputs.iter().map(|(path, _)| path.as_path()).collect();
        let places = self.places(&paths)?;
        if places.is_empty() {
            verify()?;
            return print();
        }
        let files = outputs.iter().filter(|(path, _)| !is_standard_output(path));
        let new: Vec<New> = places
            .into_iter()
            .zip(files)
            .map(|((place, name), (_, bytes))| New { place, name, bytes })
            .collect();
        let mut said = Vec::new();
        let disk = &self.disk;
        let stage = || Transaction::stage(disk, &new, &mut said);
        // what waits for a disk takes no thread from what computes
        let (staged, verified) = std::thread::scope(|scope| {
            let staged = scope.spawn(stage);
            let verified = verify();
            (staged.join(), verified)
        });
        let staged = staged.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        for line in said {
            screen::warn(&line);
        }
        verified?;
        let staged = staged?;
        self.refuse_changed()?;
        print()?;
        self.refuse_changed()?;
        if let Some(left) = staged.commit()? {
            screen::warn(&left);
        }
        Ok(())
    }
}

/// That a profile which is made is not written over another, but by force.
pub(super) fn refuse_existing(path: &Path, force: bool) -> Result<(), Failure> {
    if force || !path.exists() || is_standard_output(path) {
        return Ok(());
    }
    Err(Failure::with_hint(
        format!("{} exists; profiles are not written over", name_of(path)),
        "another name, or --force",
    ))
}
