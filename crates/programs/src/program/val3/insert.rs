//! Moves between those of a program: the statement again, to a new point of the data.

use super::data::{self, POSE, SIDES};
use super::xml::{Node, Nodes, Tag};
use crate::program::insert::{Repeated, indent};
use crate::program::kit::line_behind;
use crate::program::{Inserted, Insertion, Program, Replacements, Shape, Source, Target};
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
    count: usize,
    text: Vec<u8>,
}

/// See [`crate::program::Language::insert`].
pub(super) fn insert(
    sources: &[Source],
    program: &Program,
    file: usize,
    insertions: &[Insertion],
) -> Inserted {
    let mut inserted = Inserted::none(insertions);
    let mut points: BTreeMap<usize, Option<NewPoints>> = BTreeMap::new();
    for (insertion, done) in insertions.iter().zip(&mut inserted.moves) {
        let motion = &program.moves[insertion.motion];
        let Some(target) = program.target_of(motion) else {
            continue;
        };
        let data = target.file as usize;
        let new = points
            .entry(data)
            .or_insert_with(|| NewPoints::of(sources, data, file));
        if let Some(new) = new {
            let before = (new.count, new.text.len());
            *done = new.repeat(sources, program, target, insertion);
            if done.is_none() {
                (new.count, _) = before;
                new.text.truncate(before.1);
            }
        }
    }
    for (data, new) in points {
        if let Some(new) = new.filter(|new| new.count > 0) {
            inserted
                .elsewhere
                .push((data, vec![(new.at..new.at, new.text)]));
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
        // the names of each file's moves differ from those of all others
        let stem = (0..MOST_STEMS)
            .map(|round| format!("pShift{}_", file + round * sources.len()))
            .find(|stem| memchr::memmem::find(&source.bytes, stem.as_bytes()).is_none())?;
        Some(Self {
            source,
            is_old: found.is_old,
            at,
            blanks: indent(&source.bytes, first).unwrap_or_default(),
            stem,
            count: 0,
            text: Vec::new(),
        })
    }

    fn repeat(
        &mut self,
        sources: &[Source],
        program: &Program,
        target: &Target,
        insertion: &Insertion,
    ) -> Option<Replacements> {
        let motion = &program.moves[insertion.motion];
        let instruction = &program.instructions[motion.instruction as usize];
        let bytes = &sources[motion.file as usize].bytes;
        let end = instruction.span().end;
        let rest = &bytes[end..line_behind(bytes, end).unwrap_or(bytes.len())];
        let rest = rest.trim_ascii_start();
        // a point of a library has another name there
        let name = &bytes[instruction.target_span.range()?];
        let is_plain = (rest.is_empty() || rest.starts_with(b"//")) && !name.contains(&b':');
        if !is_plain || target.layout.shape != Shape::Pose {
            return None;
        }
        let repeated = Repeated::of(sources, program, insertion, LONGEST_LINE)?;
        repeated.insert(insertion, |numbers| self.add(target, numbers))
    }

    /// A point like a target with other numbers; its name.
    fn add(&mut self, target: &Target, numbers: &[Vec<u8>]) -> Option<Vec<u8>> {
        let bytes: &'a [u8] = &self.source.bytes;
        let name = format!("{}{}", self.stem, self.count);
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
        self.text.extend(line);
        self.count += 1;
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
