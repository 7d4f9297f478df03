//! Moves between those of a program: the statement again, to a new point of the data.

use super::data::{self, POSE, SIDES};
use super::project;
use crate::program::insert::{Added, Repeated, indent};
use crate::program::kit::line_behind;
use crate::program::xml::{Node, Nodes, Tag};
use crate::program::{Inserted, Insertion, Insertions, Replacements, Shape, Source, Target};
use std::cell::LazyCell;
use std::collections::BTreeMap;

/// Names that are tried for new points.
const MOST_STEMS: usize = 1000;
/// The longest line of a program.
const LONGEST_LINE: usize = 1 << 15;

/// New points of one data file.
struct NewPoints<'a> {
    source: &'a Source,
    is_old: bool,
    /// Behind the last point that is declared, and the blanks before it.
    at: usize,
    blanks: &'a [u8],
    /// What their names begin with.
    stem: String,
}

/// See [`crate::program::Language::insert`].
pub(super) fn insert(into: &Insertions) -> Inserted {
    let mut files: BTreeMap<usize, Option<(NewPoints, Added)>> = BTreeMap::new();
    let world = LazyCell::new(|| project::read(into.sources).ok());
    let mut inserted = Inserted::each(into.list, |one| {
        let target = into.program.target_of(&into.program.moves[one.motion])?;
        let data = target.file as usize;
        let known = files.entry(data).or_insert_with(|| {
            // in the code of another project the names of new points mean nothing
            let world = world.as_ref()?;
            let is_own = world.project_of_data(target.file) == world.project_of_code(into.file);
            let new = is_own.then(|| NewPoints::of(into.sources, data, into.file));
            new.flatten().map(|new| (new, Added::default()))
        });
        let (new, added) = known.as_mut()?;
        added.attempt(|added| new.repeat(into, target, one, added))
    });
    for (data, known) in files {
        if let Some((new, added)) = known.filter(|(_, added)| added.count > 0) {
            let text = vec![(new.at..new.at, added.text)];
            inserted.elsewhere.push((data, text));
        }
    }
    inserted
}

impl<'a> NewPoints<'a> {
    /// `None` where the file cannot have more.
    fn of(sources: &'a [Source], data: usize, file: usize) -> Option<Self> {
        let source = &sources[data];
        if source.is_context {
            return None;
        }
        let found = data::read(&source.bytes, 0, 0).ok()?;
        let (first, at) = found.last_point?;
        // names differ from those of other moves' files and other data, and from all that are there
        let count = sources.len();
        let has = |stem: &str| {
            let mut all = sources.iter();
            all.any(|one| memchr::memmem::find(&one.bytes, stem.as_bytes()).is_some())
        };
        let stem = (0..MOST_STEMS)
            .map(|round| format!("pShift{}_", file + count * (data + count * round)))
            .find(|stem| !has(stem))?;
        Some(Self {
            source,
            is_old: found.is_old,
            at,
            blanks: indent(&source.bytes, first).unwrap_or_default(),
            stem,
        })
    }

    fn repeat(
        &self,
        into: &Insertions,
        target: &Target,
        insertion: &Insertion,
        added: &mut Added,
    ) -> Option<Replacements> {
        let motion = &into.program.moves[insertion.motion];
        let instruction = &into.program.instructions[motion.instruction as usize];
        let bytes = &into.sources[motion.file as usize].bytes;
        let end = instruction.span().end;
        let rest = &bytes[end..line_behind(bytes, end).unwrap_or(bytes.len())];
        let rest = rest.trim_ascii_start();
        let is_plain = rest.is_empty() || rest.starts_with(b"//");
        if !is_plain || target.layout.shape != Shape::Pose {
            return None;
        }
        let repeated = Repeated::of(into, insertion, LONGEST_LINE)?;
        repeated.insert(insertion, |_, numbers| self.add(target, numbers, added))
    }

    /// A point like a target with other numbers; its name.
    fn add(&self, target: &Target, numbers: &[Vec<u8>], added: &mut Added) -> Option<Vec<u8>> {
        let bytes: &'a [u8] = &self.source.bytes;
        let name = format!("{}{}", self.stem, added.count);
        let mut line = [self.source.line_end(), self.blanks].concat();
        let value = &bytes[target.span()];
        if self.is_old {
            let (tags, father) = (tags(value), father(&bytes[..target.span().start]));
            line.extend(
                format!("<point name=\"{name}\" public=\"false\" privilege=\"0\" >").bytes(),
            );
            line.extend_from_slice(father);
            line.extend_from_slice(b"<valuePoint index=\"0\" >");
            for tag in tags.iter().filter(|tag| tag.name != b"valuePoint") {
                line.extend(written(tag, target, numbers)?);
            }
            line.extend_from_slice(b"</valuePoint></point>");
        } else {
            let start = "access=\"private\" xsi:type=\"array\" type=\"pointRx\" size=\"1\">";
            line.extend(format!("<Data name=\"{name}\" {start}").bytes());
            line.extend(written(tags(value).first()?, target, numbers)?);
            line.extend_from_slice(b"</Data>");
        }
        added.text.extend(line);
        added.count += 1;
        Some(name.into_bytes())
    }
}

/// The tags that open in a part of a file.
fn tags(bytes: &[u8]) -> Vec<Tag<'_>> {
    let mut nodes = Nodes::of(bytes);
    let mut found = Vec::new();
    while let Ok(Some(Node::Open(tag))) = nodes.next() {
        found.push(tag);
    }
    found
}

/// The tag of the last father in a text before a value.
fn father(bytes: &[u8]) -> &[u8] {
    let Some(start) = memchr::memmem::rfind(bytes, b"<pFather") else {
        return b"";
    };
    let end = memchr::memchr(b'>', &bytes[start..]).map_or(bytes.len(), |end| start + end + 1);
    &bytes[start..end]
}

/// A tag of a value with other numbers, alone under its key.
fn written(tag: &Tag, target: &Target, numbers: &[Vec<u8>]) -> Option<Vec<u8>> {
    let attributes: Result<Vec<_>, _> = tag.attributes().collect();
    let attributes = attributes.ok()?;
    let mut out = [b"<", tag.name].concat();
    let mut put = |name: &[u8], value: &[u8]| {
        out.extend_from_slice(&[b" ", name, b"=\"", value, b"\""].concat());
    };
    let is_place = tag.name != b"cpValue";
    if attributes.iter().any(|one| one.name == b"key") {
        put(b"key", b"0");
    }
    if is_place {
        for (name, number) in POSE.iter().zip(numbers) {
            put(name.as_bytes(), number);
        }
    }
    let mut stated = numbers[6..].iter();
    for (side, (name, _)) in SIDES.iter().enumerate() {
        let is_stated = target.layout.variant & 1 << side != 0;
        if let Some(old) = attributes.iter().find(|one| one.name == name.as_bytes()) {
            let value = if is_stated { stated.next()? } else { old.value };
            put(name.as_bytes(), value);
        }
    }
    let is_other = |name: &[u8]| {
        name != b"key"
            && !POSE.iter().any(|known| known.as_bytes() == name)
            && !SIDES.iter().any(|(known, _)| known.as_bytes() == name)
    };
    for attribute in attributes.iter().filter(|one| is_other(one.name)) {
        put(attribute.name, attribute.value);
    }
    out.extend_from_slice(b" />");
    Some(out)
}
