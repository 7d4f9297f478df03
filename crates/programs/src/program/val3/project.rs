//! What belongs together: project files (.pjx), the data and programs that they name, their
//! libraries.

use super::code::Code;
use super::data::{self, Datum, Kind};
use super::remarks::{declared_again, file_missing, not_in_project};
use crate::finding::Finding;
use crate::program::kit::{Fault, line_behind};
use crate::program::script::short;
use crate::program::xml::{Node, Nodes};
use crate::program::{ReadError, Source, number};
use foldhash::{HashMap, HashMapExt};
use std::ops::Range;

/// A parameter or a variable of a program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Declared<'a> {
    pub name: &'a [u8],
    pub kind: Kind,
    pub is_parameter: bool,
    /// The program may write what it is given.
    pub by_reference: bool,
    /// It is given with all its values.
    pub is_array: bool,
    /// How many values it has; 0 where that is not said.
    pub size: u32,
}

/// One program.
#[derive(Clone, Debug)]
pub(super) struct Program<'a> {
    pub name: &'a [u8],
    /// Index in [`World::projects`].
    pub project: u32,
    pub file: u32,
    pub at: u32,
    pub declared: Vec<Declared<'a>>,
    /// Where its code stands.
    pub code: Range<usize>,
    /// Quotes and signs are entities there.
    pub is_escaped: bool,
}

/// A file that a .pjx names.
#[derive(Debug)]
struct Named {
    kind: FileKind,
    path: String,
    /// Index of the .pjx in the sources, and where it names the file.
    by: u32,
    at: u32,
    /// It is among the files.
    is_there: bool,
}

/// What belongs together.
#[derive(Debug, Default)]
pub(super) struct Project<'a> {
    /// Folder and name of the .pjx; the folder alone where there is none.
    path: String,
    /// Files that the .pjx names: others of their kinds do not belong to it.
    files: Vec<Named>,
    /// Indices in [`World::data`].
    pub data: HashMap<&'a [u8], u32>,
    /// Indices in [`World::programs`].
    pub programs: HashMap<&'a [u8], u32>,
    /// Alias and path.
    pub libraries: Vec<(&'a [u8], &'a [u8])>,
}

/// All that the files hold.
#[derive(Debug, Default)]
pub(super) struct World<'a> {
    pub projects: Vec<Project<'a>>,
    pub data: Vec<Datum<'a>>,
    pub programs: Vec<Program<'a>>,
    /// What a person should look at.
    pub findings: Vec<Finding>,
}

/// What a file is by its first tag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FileKind {
    Project,
    Data,
    Programs,
}

/// Bytes that are looked at.
const LOOKED_AT: usize = 4096;

/// What a file is; `None` where it is none of a project.
pub(super) fn kind_of(bytes: &[u8]) -> Option<FileKind> {
    let head = &bytes[..bytes.len().min(LOOKED_AT)];
    let has = |text: &[u8]| memchr::memmem::find(head, text).is_some();
    let is_new = has(b"www.staubli.com/robotics/VAL3/");
    if is_new && has(b"<Project") || has(b"ProjectNameSpace") {
        Some(FileKind::Project)
    } else if is_new && has(b"<Database") || has(b"DataNameSpace") {
        Some(FileKind::Data)
    } else if is_new && has(b"<Programs") || has(b"ProgramNameSpace") {
        Some(FileKind::Programs)
    } else {
        None
    }
}

/// A path with `/` alone, without `.` and `..` where they can be left out.
fn clean(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split(['/', '\\']) {
        match part {
            "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

fn folder_of(path: &str) -> &str {
    path.rfind('/').map_or("", |at| &path[..at])
}

fn below(folder: &str, name: &[u8]) -> String {
    let name = String::from_utf8_lossy(name);
    if folder.is_empty() {
        clean(&name)
    } else {
        clean(&format!("{folder}/{name}"))
    }
}

/// Files of a project, by path in small letters.
type Claims = HashMap<String, u32>;

/// Reads all files.
pub(super) fn read(sources: &[Source]) -> Result<World<'_>, ReadError> {
    let mut world = World::default();
    let mut claims = Claims::new();
    for (file, source) in (0..).zip(sources) {
        if kind_of(&source.bytes) == Some(FileKind::Project) {
            let read = world.project(source, file, &mut claims);
            read.map_err(|fault| fault.in_source(source))?;
        }
    }
    for source in sources {
        let path = clean(&source.name).to_lowercase();
        if let Some(project) = claims.get(&path) {
            let files = world.projects[*project as usize].files.iter_mut();
            let named = files.filter(|one| one.path.to_lowercase() == path);
            named.for_each(|one| one.is_there = true);
        }
    }
    let mut left_out = Vec::new();
    for (file, source) in (0..).zip(sources) {
        let kind = kind_of(&source.bytes).filter(|kind| *kind != FileKind::Project);
        let Some(kind) = kind else { continue };
        let project = match world.project_of(source, kind, &mut claims) {
            Ok(project) => project,
            Err(project) => {
                left_out.push((project, kind));
                continue;
            }
        };
        let read = match kind {
            FileKind::Data => world.data(source, file, project),
            _ => world.programs(source, file, project),
        };
        read.map_err(|fault| fault.in_source(source))?;
    }
    for (project, of) in (0..).zip(&world.projects) {
        for kind in [FileKind::Data, FileKind::Programs] {
            let named = || of.files.iter().filter(|one| one.kind == kind);
            if left_out.contains(&(project, kind)) && !named().any(|one| one.is_there) {
                let found = named().map(|one| {
                    let by = &sources[one.by as usize];
                    file_missing(&one.path).found_in(by, one.at)
                });
                world.findings.extend(found);
            }
        }
    }
    Ok(world)
}

impl<'a> World<'a> {
    fn project(&mut self, source: &'a Source, by: u32, claims: &mut Claims) -> Result<(), Fault> {
        let path = clean(&source.name);
        let folder = folder_of(&path).to_owned();
        let own = short(self.projects.len());
        let mut project = Project {
            path: path.clone(),
            ..Project::default()
        };
        let mut nodes = Nodes::of(&source.bytes);
        while let Some(node) = nodes.next()? {
            let Node::Open(tag) = node else { continue };
            match tag.name {
                b"Parameters" | b"parameters" => {
                    let unit = tag.attribute(b"millimeterUnit")?;
                    let is_mm = |value: &[u8]| {
                        let value = value.trim_ascii();
                        value.eq_ignore_ascii_case(b"true") || value == b"1"
                    };
                    if let Some(unit) = unit.filter(|unit| !is_mm(unit.value)) {
                        return Err(Fault::bad_value(
                            unit.start..unit.end - 1,
                            "millimeterUnit that is read",
                            "only projects in millimetres are; save the project with \
                             millimeterUnit=\"true\"",
                        ));
                    }
                }
                b"Program" | b"program" | b"Data" | b"data" => {
                    if let Some(file) = tag.attribute(b"file")? {
                        let path = below(&folder, file.value);
                        let known = claims.insert(path.to_lowercase(), own);
                        if known.is_some_and(|known| known != own) {
                            return Err(Fault::bad_value(
                                file.start..file.end - 1,
                                "file of this project alone (another project names it, too)",
                                "give each project in a call of its own",
                            ));
                        }
                        let is_data = tag.name.eq_ignore_ascii_case(b"data");
                        project.files.push(Named {
                            kind: if is_data {
                                FileKind::Data
                            } else {
                                FileKind::Programs
                            },
                            path,
                            by,
                            at: short(tag.at),
                            is_there: false,
                        });
                    }
                }
                b"Library" | b"alias" => {
                    let is_new = tag.name == b"Library";
                    let (alias, path): (&[u8], &[u8]) = if is_new {
                        (b"alias", b"path")
                    } else {
                        (b"name", b"interface")
                    };
                    if let (Some(alias), Some(path)) = (tag.attribute(alias)?, tag.attribute(path)?)
                    {
                        project.libraries.push((alias.value, path.value));
                    }
                }
                _ => {}
            }
        }
        self.projects.push(project);
        // what the project does not name may be in its folder all the same
        claims.entry(folder.to_lowercase()).or_insert(own);
        Ok(())
    }

    /// The project of a file: the one that names it, else that of its folder; an error with that
    /// where it names others of its kind.
    fn project_of(
        &mut self,
        source: &Source,
        kind: FileKind,
        claims: &mut Claims,
    ) -> Result<u32, u32> {
        let path = clean(&source.name);
        let folder = folder_of(&path).to_owned();
        if let Some(&project) = claims.get(&path.to_lowercase()) {
            return Ok(project);
        }
        let Some(&project) = claims.get(&folder.to_lowercase()) else {
            let made = short(self.projects.len());
            claims.insert(folder.to_lowercase(), made);
            self.projects.push(Project {
                path: folder,
                ..Project::default()
            });
            return Ok(made);
        };
        let of = &self.projects[project as usize];
        if of.files.iter().any(|one| one.kind == kind) {
            let remark = not_in_project(&of.path);
            self.findings.push(remark.found_in(source, 0));
            return Err(project);
        }
        Ok(project)
    }

    /// The project that the data of a file belong to.
    pub(super) fn project_of_data(&self, file: u32) -> Option<u32> {
        let found = self.data.iter().find(|datum| datum.file == file);
        found.map(|datum| datum.project)
    }

    /// The project that the programs of a file belong to.
    pub(super) fn project_of_code(&self, file: usize) -> Option<u32> {
        let mut programs = self.programs.iter();
        let found = programs.find(|program| program.file as usize == file);
        found.map(|program| program.project)
    }

    fn is_again(&mut self, name: &[u8], source: &Source, at: u32) {
        let remark = declared_again(&Source::text(name));
        self.findings.push(remark.found_in(source, at));
    }

    fn data(&mut self, source: &'a Source, file: u32, project: u32) -> Result<(), Fault> {
        for datum in data::read(&source.bytes, project, file)?.data {
            let own = &mut self.projects[project as usize].data;
            let known = own.insert(datum.name, short(self.data.len()));
            if known.is_some() && datum.kind != Kind::Other {
                self.is_again(datum.name, source, datum.at);
            }
            self.data.push(datum);
        }
        Ok(())
    }

    fn programs(&mut self, source: &'a Source, file: u32, project: u32) -> Result<(), Fault> {
        for program in programs(&source.bytes, project, file)? {
            let own = &mut self.projects[project as usize].programs;
            let known = own.insert(program.name, short(self.programs.len()));
            if known.is_some() {
                self.is_again(program.name, source, program.at);
            }
            self.programs.push(program);
        }
        Ok(())
    }

    /// The project that an alias in another means, that itself without one; `None` where it is not
    /// in the files.
    fn named(&self, project: u32, alias: &[u8]) -> Option<&Project<'a>> {
        let project = match alias {
            b"" => project,
            alias => self.library(project, alias)?,
        };
        Some(&self.projects[project as usize])
    }

    /// The datum of a name in a project; index in [`Self::data`].
    pub(super) fn datum(&self, project: u32, alias: &[u8], name: &[u8]) -> Option<u32> {
        self.named(project, alias)?.data.get(name).copied()
    }

    /// The program of a name in a project; index in [`Self::programs`].
    pub(super) fn program(&self, project: u32, alias: &[u8], name: &[u8]) -> Option<u32> {
        self.named(project, alias)?.programs.get(name).copied()
    }

    /// The project that an alias of another means; `None` where it is not in the files.
    pub(super) fn library(&self, project: u32, alias: &[u8]) -> Option<u32> {
        let own = &self.projects[project as usize];
        let (_, path) = own.libraries.iter().find(|(name, _)| *name == alias)?;
        self.at_path(project, path)
    }

    /// What an alias of a project means: the path of the library; that of the project without one.
    pub(super) fn meant_by(&self, project: u32, alias: &[u8]) -> String {
        let own = &self.projects[project as usize];
        let mut libraries = own.libraries.iter().filter(|_| !alias.is_empty());
        let Some((_, path)) = libraries.find(|(name, _)| *name == alias) else {
            return [&own.path, "/", &*Source::text(alias)].concat();
        };
        if memchr::memmem::find(path, b"://").is_some() {
            return String::from_utf8_lossy(path).into_owned();
        }
        below(folder_of(&own.path), path)
    }

    /// What a project is called: its name where no other has it, else its path.
    pub(super) fn label(&self, project: u32) -> &str {
        let stem = |of: &'_ Project| -> String {
            let name = of.path.rsplit('/').next().unwrap_or_default();
            name.to_lowercase()
        };
        let own = &self.projects[project as usize];
        let same = self
            .projects
            .iter()
            .filter(|other| stem(other) == stem(own));
        let path = own.path.strip_suffix(".pjx").unwrap_or(&own.path);
        if same.count() > 1 {
            path
        } else {
            path.rsplit('/').next().unwrap_or_default()
        }
    }

    /// The project at a path, from the folder of another: `./Prog1`, `Disk://Prog1/Prog1.pjx`. Where
    /// none is exactly there, the only one whose path ends so in the nearest folder around.
    pub(super) fn at_path(&self, project: u32, path: &[u8]) -> Option<u32> {
        let text = String::from_utf8_lossy(path);
        let text = text.split("://").last().unwrap_or_default();
        let own = folder_of(&self.projects[project as usize].path).to_lowercase();
        let wanted = clean(text).to_lowercase();
        let exact = paths_of(&below(&own, wanted.as_bytes()))?;
        let ends = paths_of(wanted.trim_start_matches("../"))?;
        let all = || {
            let paths = self.projects.iter().map(|other| other.path.to_lowercase());
            (0..).zip(paths)
        };
        if let Some((at, _)) = all().find(|(_, path)| exact.contains(path)) {
            return Some(at);
        }
        let is_at = |path: &str| ends.iter().any(|end| is_below(path, end));
        let mut around = &own[..];
        loop {
            let is_near = |path: &str| around.is_empty() || path.starts_with(&format!("{around}/"));
            let mut found = all().filter(|(_, path)| is_near(path) && is_at(path));
            match (found.next(), found.next()) {
                (Some((at, _)), None) => return Some(at),
                (None, _) if !around.is_empty() => around = folder_of(around),
                _ => return None,
            }
        }
    }
}

/// The project files that a path may mean: `Prog1` stands for `Prog1/Prog1.pjx`.
fn paths_of(path: &str) -> Option<[String; 2]> {
    let stem = path.strip_suffix(".pjx").unwrap_or(path);
    let name = stem.rsplit('/').next().filter(|name| !name.is_empty())?;
    Some([format!("{stem}.pjx"), format!("{stem}/{name}.pjx")])
}

/// Whether a path is another one, or that below some folder.
fn is_below(path: &str, end: &str) -> bool {
    let folder = path.strip_suffix(end);
    folder.is_some_and(|folder| folder.is_empty() || folder.ends_with('/'))
}

/// Behind the line of the `begin` of a file's first program.
pub(super) fn behind_begin(bytes: &[u8]) -> Option<usize> {
    let programs = programs(bytes, 0, 0).ok()?;
    let first = programs.first()?;
    let code = Code::of(bytes, first.code.clone(), first.is_escaped);
    let begin = (code.statements()).find(|statement| statement.text(0) == b"begin")?;
    let at = line_behind(bytes, begin.span().start);
    at.filter(|at| *at <= first.code.end)
}

/// The programs of a file.
fn programs(bytes: &[u8], project: u32, file: u32) -> Result<Vec<Program<'_>>, Fault> {
    let mut found: Vec<Program> = Vec::new();
    let mut nodes = Nodes::of(bytes);
    let mut code = None;
    while let Some(node) = nodes.next()? {
        match node {
            Node::Open(tag) => match tag.name {
                b"Program" | b"program" => {
                    found.push(Program {
                        name: tag.value(b"name")?,
                        project,
                        file,
                        at: short(tag.at),
                        declared: Vec::new(),
                        code: tag.end..tag.end,
                        is_escaped: false,
                    });
                }
                b"Parameter" | b"param" | b"Local" | b"local" => {
                    let is_parameter = matches!(tag.name, b"Parameter" | b"param");
                    let mut attributes = tag.attributes();
                    let declared = Declared {
                        name: tag.value(b"name")?,
                        kind: Kind::of(tag.value(b"type")?),
                        is_parameter,
                        by_reference: is_parameter
                            && (tag.value(b"use")? == b"reference"
                                || tag.value(b"byVal")? == b"false"),
                        size: number::whole(tag.value(b"size")?).unwrap_or(0),
                        is_array: attributes.any(|one| one.is_ok_and(|one| one.value == b"array")),
                    };
                    if let Some(program) = found.last_mut() {
                        program.declared.push(declared);
                    }
                }
                b"Code" | b"code" if !tag.is_empty => code = Some(tag.end),
                _ => {}
            },
            Node::Close(b"Code" | b"code", at, _) => {
                if let (Some(start), Some(program)) = (code.take(), found.last_mut()) {
                    let data = memchr::memmem::find(&bytes[start..at], b"<![CDATA[");
                    program.is_escaped = data.is_none();
                    program.code = match data {
                        None => start..at,
                        Some(open) => {
                            let start = start + open + b"<![CDATA[".len();
                            let end = memchr::memmem::find(&bytes[start..at], b"]]>");
                            start..end.map_or(at, |end| start + end)
                        }
                    };
                }
            }
            Node::Close(..) => {}
        }
    }
    Ok(found)
}
