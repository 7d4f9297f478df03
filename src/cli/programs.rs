//! Program files on the command line: files, and folders of them.

use super::files;
use crate::nearest;
use crate::program::{LANGUAGES, Language, Source, has_extension};
use crate::task::Failure;
use crate::task::files::existing;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// Program files in a folder and below, with their paths relative to it.
pub(super) fn programs_in(
    folder: &Path,
    asked: Option<&'static dyn Language>,
) -> Result<Vec<(PathBuf, PathBuf)>, Failure> {
    let mut found = Vec::new();
    for entry in walkdir::WalkDir::new(folder).sort_by_file_name() {
        let entry = entry.map_err(|error| {
            Failure::new(format!(
                "cannot read the folder {}: {error}",
                folder.display()
            ))
        })?;
        let path = entry.path();
        let known = LANGUAGES
            .iter()
            .filter(|l| asked.is_none_or(|a| a.about().id == l.about().id));
        let mut candidates = known.filter(|l| has_extension(**l, path)).peekable();
        if !entry.file_type().is_file() || candidates.peek().is_none() {
            continue;
        }
        let source = Source::new("", files::read(path)?);
        if candidates.any(|language| language.recognises(&source)) {
            let below = path
                .strip_prefix(folder)
                .expect("a walk stays below its top");
            found.push((path.to_owned(), below.to_owned()));
        }
    }
    Ok(found)
}

/// Program files in the order of the arguments; folders give theirs by name.
pub(super) fn read_programs(
    paths: &[PathBuf],
    asked: Option<&'static dyn Language>,
) -> Result<Vec<Source>, Failure> {
    let mut sources = Vec::new();
    for path in paths {
        let found = if path.is_dir() {
            programs_in(path, asked)?
                .into_iter()
                .map(|(path, _)| path)
                .collect()
        } else {
            vec![path.clone()]
        };
        for path in found {
            sources.push(files::source(&path)?);
        }
    }
    if sources.is_empty() {
        return Err(Failure::with_hint(
            "no program files in these folders",
            "`poseshift languages` lists what is recognised",
        ));
    }
    Ok(sources)
}

/// Which of the program files `--only` means: all where it names none.
pub(super) fn meant(files: &[&Path], only: &[String]) -> Result<Vec<bool>, Failure> {
    let is = |path: &Path, name: &String| {
        let same = |part: Option<&std::ffi::OsStr>| {
            part.is_some_and(|part| part.to_string_lossy().eq_ignore_ascii_case(name))
        };
        same(path.file_name()) || same(path.file_stem())
    };
    for name in only {
        if !files.iter().any(|path| is(path, name)) {
            let names: Vec<_> = files
                .iter()
                .map(|path| path.display().to_string())
                .collect();
            return Err(Failure::with_hint(
                format!("--only {name}: no program is called so"),
                nearest::hint(name, "programs", names.iter().map(String::as_str)),
            ));
        }
    }
    let meant = |path: &&Path| only.is_empty() || only.iter().any(|name| is(path, name));
    Ok(files.iter().map(meant).collect())
}

/// The programs that `--only` means, and behind them the others, which are read for what they declare.
pub(super) fn only(programs: Vec<Source>, names: &[String]) -> Result<Vec<Source>, Failure> {
    let paths: Vec<&Path> = programs
        .iter()
        .map(|source| Path::new(&source.name))
        .collect();
    let meant = meant(&paths, names)?;
    let (mut own, mut others) = (Vec::new(), Vec::new());
    for (source, is_meant) in programs.into_iter().zip(meant) {
        if is_meant {
            own.push(source);
        } else {
            others.push(Source::context(source.name, source.bytes));
        }
    }
    own.extend(others);
    Ok(own)
}

/// Files that are read for what they declare only, those left out that are programs of the run.
pub(super) fn read_context(
    paths: &[PathBuf],
    asked: Option<&'static dyn Language>,
    programs: &[Source],
) -> Result<Vec<Source>, Failure> {
    if paths.is_empty() {
        return Ok(Vec::new());
    }
    let at = |source: &Source| existing(Path::new(&source.name));
    let programs: HashSet<_> = programs.iter().filter_map(at).collect();
    let is_program = |source: &Source| at(source).is_some_and(|at| programs.contains(&at));
    let found = read_programs(paths, asked)?.into_iter();
    Ok(found
        .filter(|source| !is_program(source))
        .map(|source| Source::context(source.name, source.bytes))
        .collect())
}
