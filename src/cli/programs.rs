//! Program files on the command line: files, folders of them, and standard input.

use super::files::{Files, Identity, Listing, is_own, is_stream, meant_by};
use super::screen;
use crate::nearest;
use crate::printable::{name_of, printable};
use crate::program::{LANGUAGES, Language, ReadError, Settings, Source, has_extension};
use crate::task::Failure;
use crate::task::programs::LeftOut;
use clap::Args;
use globset::{GlobBuilder, GlobSet, GlobSetBuilder};
use std::cell::RefCell;
use std::collections::{BTreeSet, HashSet};
use std::ffi::{OsStr, OsString};
use std::path::{Component, Path, PathBuf};

/// Bytes that tell whether a file is text.
const LOOKED_AT: usize = 1 << 16;

/// What of folders is no matter.
#[derive(Args)]
pub(super) struct Ignored {
    /// Leave files and folders out that are called so: `*.bak`, `old/**`, or a path as the summary
    /// shows it; may be given again. The summary lists them
    #[arg(long, value_name = "GLOB")]
    ignore: Vec<String>,
    /// Which of them have meant something.
    #[arg(skip)]
    used: RefCell<BTreeSet<usize>>,
}

impl Ignored {
    fn globs(&self) -> Result<GlobSet, Failure> {
        let mut all = GlobSetBuilder::new();
        for text in &self.ignore {
            let fault = |error: globset::Error| {
                Failure::with_hint(
                    format!("--ignore {text}: {}", error.kind()),
                    "a pattern is such as `*.bak`, `old/**` or `{a,b}.mod`",
                )
            };
            let pattern = text.trim_end_matches('/');
            if pattern.trim().is_empty() {
                return Err(Failure::with_hint(
                    "--ignore is empty",
                    "a pattern is such as `*.bak`, `old/**` or `{a,b}.mod`",
                ));
            }
            // a name without a folder is meant in every folder
            let pattern = if pattern.contains('/') {
                pattern.trim_start_matches("./").to_owned()
            } else {
                format!("**/{pattern}")
            };
            let glob = GlobBuilder::new(&pattern).literal_separator(true).build();
            all.add(glob.map_err(fault)?);
        }
        all.build()
            .map_err(|error| Failure::new(format!("--ignore: {error}")))
    }

    /// Warns of those that have meant nothing, once all files are read.
    pub(super) fn warn_of_unused(&self) {
        let used = self.used.borrow();
        for (_, text) in (0..).zip(&self.ignore).filter(|(n, _)| !used.contains(n)) {
            screen::warn(&format!(
                "--ignore {}: no file or folder is called so, nothing is left out for it",
                printable(text)
            ));
        }
    }
}

/// A program file.
pub(super) struct ProgramFile {
    /// Where it is.
    pub path: PathBuf,
    /// As it is called in a folder of outputs.
    pub below: PathBuf,
    /// Its name and its bytes.
    pub source: Source,
}

/// The programs that are meant, and what lies next to them.
pub(super) struct Gathered {
    /// In the order of the arguments; folders give theirs by name.
    pub programs: Vec<ProgramFile>,
    /// What of folders is none.
    pub left_out: LeftOut,
}

/// Originals that have programs.
#[derive(Default)]
pub(super) struct Shared {
    /// These, and behind them the others as context.
    pub sources: Vec<Source>,
    /// The names of those that have none.
    pub left_out: Vec<String>,
}

impl Gathered {
    /// As the programs are called in a folder of outputs.
    pub(super) fn below(&self) -> Vec<PathBuf> {
        let below = self.programs.iter().map(|program| program.below.clone());
        below.collect()
    }

    /// Where the programs are.
    pub(super) fn paths(&self) -> Vec<PathBuf> {
        let paths = self.programs.iter().map(|program| program.path.clone());
        paths.collect()
    }

    /// Leaves those out that have no file of their name among some others, where any has: their
    /// names, and what is left, the ones left out for what they declare.
    pub(super) fn shared_with(
        self,
        others: &[PathBuf],
        names: &[String],
    ) -> Result<Shared, Failure> {
        // files of one name are one module: a.src means a.dat, too
        let module = |path: &Path| {
            path.with_extension("")
                .into_os_string()
                .to_ascii_lowercase()
        };
        let others: HashSet<OsString> = others.iter().map(|other| module(other)).collect();
        let is_shared = |program: &ProgramFile| others.contains(&module(&program.below));
        let shared: Vec<bool> = self.programs.iter().map(is_shared).collect();
        let any = shared.contains(&true);
        let meant = meant(&self.programs, names)?;
        let mut found = Shared::default();
        let mut context = Vec::new();
        for ((program, is_shared), is_meant) in self.programs.into_iter().zip(shared).zip(meant) {
            let source = program.source;
            let is_alone = any && !is_shared;
            if is_alone && is_meant {
                found.left_out.push(source.name.clone());
            }
            if is_meant && !is_alone {
                found.sources.push(source);
            } else {
                context.push(Source::context(source.name, source.bytes));
            }
        }
        found.sources.extend(context);
        Ok(found)
    }

    /// The programs that `--only` means, and behind them the others, which are read for what they
    /// declare.
    pub(super) fn only(self, names: &[String]) -> Result<Vec<Source>, Failure> {
        let meant = meant(&self.programs, names)?;
        let (mut own, mut others) = (Vec::new(), Vec::new());
        for (program, is_meant) in self.programs.into_iter().zip(meant) {
            let source = program.source;
            if is_meant {
                own.push(source);
            } else {
                others.push(Source::context(source.name, source.bytes));
            }
        }
        own.extend(others);
        Ok(own)
    }
}

/// Why bytes are no text of a program.
fn no_text(bytes: &[u8]) -> Option<&'static str> {
    let head = &bytes[..bytes.len().min(LOOKED_AT)];
    if head.starts_with(&[0xff, 0xfe]) || head.starts_with(&[0xfe, 0xff]) {
        Some("it is UTF-16; save it as UTF-8 or in the controller's encoding")
    } else if memchr::memchr(0, head).is_some() {
        Some(
            "it holds bytes that are 0: UTF-16, no text, or a module that is encoded and that the controller alone \
             reads",
        )
    } else if bytes.trim_ascii().is_empty() {
        Some("it is empty")
    } else {
        None
    }
}

/// What a folder holds.
#[derive(Default)]
struct Walk {
    /// A run that was stopped there was finished or undone meanwhile.
    was_settled: bool,
    /// What is no folder, with its path below the top.
    entries: Vec<(walkdir::DirEntry, PathBuf)>,
    ignored: Vec<String>,
    wrong: Vec<String>,
}

/// Reads programs.
struct Reading<'a> {
    files: &'a Files,
    asked: Option<&'static dyn Language>,
    ignored: GlobSet,
    used: &'a RefCell<BTreeSet<usize>>,
    found: Gathered,
    /// The languages that files of folders are recognised by.
    spoken: Vec<&'static dyn Language>,
    /// What in folders may be files of another controller's own.
    doubtful: Vec<Doubtful>,
    /// What in folders can be neither read nor passed over, with the reason.
    wrong: Vec<String>,
}

/// A file that ends as programs of some languages do, and has nothing of them.
struct Doubtful {
    name: String,
    known: Vec<&'static dyn Language>,
    /// Why it is none of them.
    why: String,
}

impl Reading<'_> {
    /// Whether `--ignore` means a path.
    fn is_ignored(&self, below: &Path, named: &Path) -> bool {
        let meant = meant_by(&self.ignored, below, named);
        self.used.borrow_mut().extend(&meant);
        !meant.is_empty()
    }

    /// A file that is named.
    fn file(&mut self, path: &Path) -> Result<(), Failure> {
        let below = path.file_name().map_or_else(|| path.into(), PathBuf::from);
        if self.is_ignored(&below, path) {
            self.found.left_out.ignored.push(name_of(path));
            return Ok(());
        }
        let bytes = if is_stream(path) {
            self.files.standard_input()?
        } else {
            self.files.read(path)?
        };
        if let Some(why) = no_text(&bytes) {
            return Err(Failure::new(format!("{}: {why}", name_of(path))));
        }
        self.found.programs.push(ProgramFile {
            path: path.to_owned(),
            below,
            source: Source::new(name_of(path), bytes),
        });
        Ok(())
    }

    /// All files of a folder and below.
    fn folder(&mut self, folder: &Path) -> Result<(), Failure> {
        let mut walk = self.walk(folder)?;
        while walk.was_settled {
            // what is there has changed
            walk = self.walk(folder)?;
        }
        self.wrong.extend(walk.wrong);
        self.found.left_out.ignored.extend(walk.ignored);
        let asked = self.asked;
        let known = walk
            .entries
            .iter()
            .map(|(entry, _)| entry.path().to_owned());
        self.files.listed(Listing {
            folder: folder.to_owned(),
            ignored: self.ignored.clone(),
            known: known.collect(),
            is_read: Box::new(move |path| known_by(asked, path).next().is_some()),
        });
        for (entry, below) in walk.entries {
            self.entry(&entry, below);
        }
        Ok(())
    }

    fn walk(&self, folder: &Path) -> Result<Walk, Failure> {
        let mut found = Walk {
            was_settled: self.files.settle(folder)?,
            ..Walk::default()
        };
        let mut walk = walkdir::WalkDir::new(folder)
            .min_depth(1)
            .sort_by_file_name()
            .into_iter();
        while let Some(entry) = walk.next() {
            let entry = match entry {
                Ok(entry) => entry,
                Err(error) => {
                    let path = name_of(error.path().unwrap_or(folder));
                    let why = error.io_error().map(ToString::to_string);
                    let why = why.unwrap_or_else(|| error.to_string());
                    found.wrong.push(format!("{path}: {why}"));
                    continue;
                }
            };
            let is_folder = entry.file_type().is_dir();
            let is_own = is_own(&entry);
            let below = entry.path().strip_prefix(folder);
            let below = below.expect("a walk stays below its top").to_owned();
            if is_own || self.is_ignored(&below, entry.path()) {
                if is_folder {
                    walk.skip_current_dir();
                }
                if !is_own {
                    let sign = if is_folder { "/" } else { "" };
                    found.ignored.push(name_of(entry.path()) + sign);
                }
            } else if is_folder {
                found.was_settled |= self.files.settle(entry.path())?;
            } else {
                found.entries.push((entry, below));
            }
        }
        Ok(found)
    }

    /// A file of a folder.
    fn entry(&mut self, entry: &walkdir::DirEntry, below: PathBuf) {
        let path = entry.path();
        let name = name_of(path);
        let kind = entry.file_type();
        if kind.is_symlink() {
            let why = "it is a link, and links in folders are not followed";
            self.wrong.push(format!("{name}: {why}"));
            return;
        }
        let file = entry.file_name().to_string_lossy();
        let known: Vec<&'static dyn Language> = known_by(self.asked, path).collect();
        if known.is_empty() {
            self.found.left_out.other.push(name);
            return;
        }
        if !kind.is_file() {
            let why = "it is a device, a pipe or a socket";
            self.wrong.push(format!("{name}: {why}"));
            return;
        }
        let bytes = match self.files.bytes(path) {
            Ok(bytes) => bytes,
            Err(error) => {
                self.wrong
                    .push(format!("{name}: it cannot be read: {error}"));
                return;
            }
        };
        let no_text = no_text(&bytes);
        let source = Source::new(name, bytes);
        let speaks = |language: &&&'static dyn Language| language.accepts(&source);
        let why = match (no_text, known.iter().find(speaks)) {
            (None, Some(language)) => {
                self.spoken.push(*language);
                self.found.programs.push(ProgramFile {
                    path: path.to_owned(),
                    below,
                    source,
                });
                return;
            }
            (None, None) if known.iter().all(|language| language.is_record(&file)) => {
                self.found.left_out.other.push(source.name);
                return;
            }
            (Some(why), _) => why.to_owned(),
            (None, None) => why_none(&known, &source),
        };
        if known
            .iter()
            .all(|language| language.may_be_foreign(&source))
        {
            self.doubtful.push(Doubtful {
                name: source.name,
                known,
                why,
            });
        } else {
            self.wrong.push(format!("{}: {why}", source.name));
        }
    }

    /// What has nothing of the languages that it is called as is another controller's own file, where
    /// programs of that one are there and none of these languages.
    fn judge_doubtful(&mut self) {
        let spoken = self.spoken.iter().map(|language| language.about().id);
        // tables are of no controller
        let has_others = spoken.clone().any(|id| id != "csv");
        for doubtful in std::mem::take(&mut self.doubtful) {
            let is_of = |id| doubtful.known.iter().any(|known| known.about().id == id);
            if has_others && !spoken.clone().any(is_of) {
                self.found.left_out.other.push(doubtful.name);
            } else {
                self.wrong
                    .push(format!("{}: {}", doubtful.name, doubtful.why));
            }
        }
    }
}

/// Why a file is none of the languages that it is called as.
fn why_none(known: &[&'static dyn Language], source: &Source) -> String {
    let names: Vec<&str> = known.iter().map(|language| language.about().name).collect();
    let why = known.iter().find_map(|language| {
        let sources = std::slice::from_ref(source);
        match language.script(sources, &Settings::default()) {
            Ok(_) | Err(ReadError::NotThisLanguage { .. }) => None,
            Err(error) => Some(match error.place() {
                (_, 0, _) => error.message(),
                (_, line, column) => format!("{line}:{column}: {}", error.message()),
            }),
        }
    });
    let why = why.unwrap_or_else(|| "truncated?".into());
    let names = names.join(" or ");
    format!("it is called as {names}, and is none: {why}")
}

/// The languages whose files are called so, of those that are asked for.
fn known_by(
    asked: Option<&'static dyn Language>,
    path: &Path,
) -> impl Iterator<Item = &'static dyn Language> {
    let of = move |language: &&dyn Language| {
        asked.is_none_or(|asked| asked.about().id == language.about().id)
            && has_extension(*language, path)
    };
    LANGUAGES.iter().copied().filter(of)
}

/// The program files that are meant.
///
/// # Errors
/// One cannot be read; a folder holds what can be neither read nor passed over in silence; there is
/// none.
pub(super) fn gather(
    files: &Files,
    paths: &[PathBuf],
    asked: Option<&'static dyn Language>,
    ignored: &Ignored,
) -> Result<Gathered, Failure> {
    let mut reading = Reading {
        files,
        asked,
        ignored: ignored.globs()?,
        used: &ignored.used,
        found: Gathered {
            programs: Vec::new(),
            left_out: LeftOut::default(),
        },
        spoken: Vec::new(),
        doubtful: Vec::new(),
        wrong: Vec::new(),
    };
    for path in paths {
        files.settle(path)?;
        if path.is_dir() {
            reading.folder(path)?;
        } else {
            reading.file(path)?;
        }
    }
    reading.judge_doubtful();
    if !reading.wrong.is_empty() {
        return Err(Failure::with_hint(
            format!(
                "nothing of a folder is passed over in silence: {}",
                reading.wrong.join("; ")
            ),
            "mend them, or leave them out with --ignore GLOB",
        ));
    }
    if reading.found.programs.is_empty() {
        return Err(Failure::with_hint(
            "no program files in these folders",
            "`poseshift languages` lists what is recognised",
        ));
    }
    let mut known = HashSet::new();
    for program in &reading.found.programs {
        // a hard link is a file of its own
        let place = std::fs::canonicalize(&program.path).ok();
        if place.is_some_and(|place| !known.insert(place)) {
            return Err(Failure::with_hint(
                format!(
                    "{} is given twice: it would be read, or written, twice",
                    name_of(&program.path)
                ),
                "give each file once; a folder gives all files below it",
            ));
        }
    }
    if paths.len() > 1 && paths.iter().any(|path| is_stream(path)) {
        return Err(Failure::with_hint(
            "`-` is one program, without others next to it",
            "give files, or one program on standard input",
        ));
    }
    Ok(reading.found)
}

/// Which of the program files `--only` means: all where it names none. A name is that of a file, with
/// or without its extension and the folders above it, or leads to the file; files that differ by their
/// extensions alone are one program.
pub(super) fn meant(programs: &[ProgramFile], only: &[String]) -> Result<Vec<bool>, Failure> {
    let named: Vec<Option<Identity>> = only
        .iter()
        .map(|name| Identity::of(Path::new(name)))
        .collect();
    let is = |path: &Path, at: usize| {
        let leads_there = || named[at].is_some() && named[at] == Identity::of(path);
        ends_as(path, Path::new(&only[at])) || leads_there()
    };
    for (at, name) in only.iter().enumerate() {
        if !programs.iter().any(|program| is(&program.path, at)) {
            let names = programs.iter().map(|program| name_of(&program.below));
            let names: Vec<String> = names.collect();
            return Err(Failure::with_hint(
                format!("--only {name}: no program is called so"),
                nearest::hint(name, "programs", names.iter().map(String::as_str)),
            ));
        }
    }
    // files of one name are one module: a.src means a.dat, too
    let module = |program: &ProgramFile| program.path.with_extension("");
    let named = programs
        .iter()
        .filter(|program| (0..only.len()).any(|at| is(&program.path, at)));
    let named: BTreeSet<PathBuf> = named.map(module).collect();
    let meant = |program: &ProgramFile| only.is_empty() || named.contains(&module(program));
    Ok(programs.iter().map(meant).collect())
}

/// Whether a path ends as another one, in letters of any case, that may leave out the extension.
fn ends_as(path: &Path, end: &Path) -> bool {
    let same = |part: Option<&OsStr>, other: &OsStr| {
        part.is_some_and(|part| part.eq_ignore_ascii_case(other))
    };
    let Some(name) = end.file_name() else {
        return false;
    };
    if !same(path.file_name(), name) && !same(path.file_stem(), name) {
        return false;
    }
    let folders = |path: &Path| -> Vec<OsString> {
        let parents = path.parent().into_iter().flat_map(Path::components);
        let named = parents.filter(|part| *part != Component::CurDir);
        named.map(|part| part.as_os_str().to_owned()).collect()
    };
    let (above, asked) = (folders(path), folders(end));
    let from = above.len().checked_sub(asked.len());
    from.is_some_and(|from| {
        let mut pairs = above[from..].iter().zip(&asked);
        pairs.all(|(part, asked)| part.eq_ignore_ascii_case(asked))
    })
}

/// Files that are read for what they declare only, those left out that are programs of the run.
pub(super) fn read_context(
    files: &Files,
    paths: &[PathBuf],
    asked: Option<&'static dyn Language>,
    ignored: &Ignored,
    programs: &[PathBuf],
) -> Result<Vec<Source>, Failure> {
    if paths.is_empty() {
        return Ok(Vec::new());
    }
    let known: HashSet<Identity> = programs
        .iter()
        .filter_map(|path| Identity::of(path))
        .collect();
    let is_program = |path: &Path| Identity::of(path).is_some_and(|own| known.contains(&own));
    for path in paths
        .iter()
        .filter(|path| !path.is_dir() && is_program(path))
    {
        screen::warn(&format!(
            "--with {}: it is a program of this run already; --only names those that are written",
            name_of(path)
        ));
    }
    let found = gather(files, paths, asked, ignored)?.programs.into_iter();
    let others = found.filter(|program| !is_program(&program.path));
    Ok(others
        .map(|program| Source::context(program.source.name, program.source.bytes))
        .collect())
}
