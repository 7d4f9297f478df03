//! Tools and work frames in files of the controller: `SYSFRAME.VA` and `FRAME.DG`; with them what
//! `POSREG.VA` shows of position registers.

use super::posreg;
use crate::geometry::{Pose, Separation};
use crate::program::notation::pose_of_angles;
use crate::program::{MOST_ANGLE_DEG, number};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// Tools and work frames of group 1, by number.
#[derive(Clone, Debug, Default, PartialEq)]
#[allow(clippy::struct_field_names)]
pub(super) struct Frames {
    /// `flange_from_tool`
    pub tools: BTreeMap<u32, Pose>,
    /// `world_from_frame`
    pub frames: BTreeMap<u32, Pose>,
    /// Position registers.
    pub registers: BTreeMap<u32, posreg::Shown>,
    /// They are shown with one decimal only.
    pub rounded: bool,
}

/// A tool or frame as the files show it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shown {
    pub pose: Pose,
    rounded: bool,
    file: String,
    /// Another file shows another one.
    other: Option<String>,
}

impl Shown {
    /// The two files that disagree.
    pub(super) fn disagreeing(&self) -> Option<[&str; 2]> {
        self.other.as_ref().map(|other| [&*self.file, &**other])
    }

    /// Takes in what another file shows: what is exact goes before what is rounded.
    fn meet(&mut self, mut other: Self) {
        if self.rounded != other.rounded {
            if self.rounded {
                std::mem::swap(self, &mut other);
            }
            return;
        }
        let apart = self.pose.separation(&other.pose);
        if apart.distance_m > SAME.distance_m || apart.angle_rad > SAME.angle_rad {
            self.other.get_or_insert(other.file);
        }
    }
}

/// By number.
pub(super) type Numbered = BTreeMap<u32, Shown>;

/// The tools and frames of all files.
#[derive(Clone, Debug, Default)]
pub(super) struct All {
    pub tools: Numbered,
    pub frames: Numbered,
    /// Position registers; `None` where two files show other numbers.
    pub registers: BTreeMap<u32, Option<posreg::Shown>>,
}

impl All {
    fn disagree(&self) -> bool {
        let mut all = self.tools.values().chain(self.frames.values());
        all.any(|shown| shown.other.is_some())
    }

    /// Takes in those of a file.
    fn add(&mut self, found: Frames, file: &str) {
        let rounded = found.rounded;
        for (number, shown) in found.registers {
            let known = self.registers.entry(number).or_insert(Some(shown));
            if *known != Some(shown) {
                *known = None;
            }
        }
        for (all, more) in [
            (&mut self.tools, found.tools),
            (&mut self.frames, found.frames),
        ] {
            for (number, pose) in more {
                let shown = Shown {
                    pose,
                    rounded,
                    file: file.to_owned(),
                    other: None,
                };
                match all.entry(number) {
                    Entry::Vacant(place) => _ = place.insert(shown),
                    Entry::Occupied(mut place) => place.get_mut().meet(shown),
                }
            }
        }
    }
}

/// The folder of a file.
fn folder(name: &str) -> &str {
    name.rfind(['/', '\\']).map_or("", |end| &name[..=end])
}

/// Each controller with one of its files, what they show, and its programs. Where files
/// disagree a program belongs to the nearest folder around it that has some, if each folder has
/// programs and each program a folder; else all are of one.
pub(super) fn controllers<'s, P>(
    shown: Vec<(&'s str, Frames)>,
    programs: Vec<P>,
    name_of: impl Fn(&P) -> &'s str,
) -> Vec<(&'s str, All, Vec<P>)> {
    let mut one = All::default();
    let mut by_folder: BTreeMap<&str, (&str, All, Vec<P>)> = BTreeMap::new();
    for (name, frames) in shown {
        one.add(frames.clone(), name);
        let new = || (name, All::default(), Vec::new());
        let (_, all, _) = by_folder.entry(folder(name)).or_insert_with(new);
        all.add(frames, name);
    }
    let nearest = |program: &P| {
        let folders = by_folder.keys().copied();
        let around = folders.filter(|folder| name_of(program).starts_with(folder));
        around.max_by_key(|folder| folder.len())
    };
    let homes: Vec<Option<&str>> = programs.iter().map(nearest).collect();
    let is_clear = homes.iter().all(Option::is_some)
        && by_folder.keys().all(|folder| homes.contains(&Some(folder)));
    if !is_clear || !one.disagree() {
        return vec![("", one, programs)];
    }
    for (home, program) in homes.into_iter().zip(programs) {
        let of = home.and_then(|home| by_folder.get_mut(home));
        of.expect("the folder is one of them").2.push(program);
    }
    by_folder.into_values().collect()
}

/// Farther apart than this are no two readings of one text.
const SAME: Separation = Separation {
    distance_m: 1e-9,
    angle_rad: 1e-9,
};

/// A number that no robot can use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct BadNumber {
    pub at: usize,
    pub length: usize,
}

/// Millimetres or degrees.
pub(super) const LARGEST: f64 = 1e6;
/// The kinds of files that show frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Variables as text.
    Variables,
    /// The list of frames.
    List,
}

/// Which kind the bytes are; `None` where they show no frames.
pub(super) fn kind(bytes: &[u8]) -> Option<Kind> {
    let variable = |name: &[u8]| {
        memchr::memmem::find_iter(bytes, name).any(|at| {
            let rest = &bytes[at + name.len()..];
            rest.starts_with(b" ") && starts(lines(rest).next(), b"Storage:")
        })
    };
    let names = [&b"]$MNUTOOL"[..], b"]$MNUFRAME", b"]$POSREG"];
    if names.into_iter().any(variable) {
        return Some(Kind::Variables);
    }
    // the list is short and starts with a few lines about the controller
    let headings =
        lines(&bytes[..bytes.len().min(LIST_HEAD)]).filter_map(|(_, line)| heading(line));
    let rows = || lines(&bytes[..bytes.len().min(LIST_HEAD)]).any(|(_, line)| row(line).is_some());
    (headings.count() > 0 && rows()).then_some(Kind::List)
}

/// Bytes of a list that hold a heading and a row.
const LIST_HEAD: usize = 4096;

fn starts(line: Option<(usize, &[u8])>, word: &[u8]) -> bool {
    line.is_some_and(|(_, line)| line.trim_ascii_start().starts_with(word))
}

/// The frames of a file of this kind.
pub(super) fn read(bytes: &[u8], kind: Kind) -> Result<Frames, BadNumber> {
    match kind {
        Kind::Variables => Ok(Frames {
            registers: posreg::read(bytes)?,
            ..variables(bytes)?
        }),
        Kind::List => Ok(list(bytes)),
    }
}

/// Lines without their ends, with their first bytes.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut at = 0;
    bytes
        .split(|&b| matches!(b, b'\n' | b'\r'))
        .map(move |line| {
            let start = at;
            at += line.len() + 1;
            (start, line)
        })
}

/// What is being listed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Tools,
    Frames,
    Other,
}

/// `[*SYSTEM*]$MNUTOOL … ARRAY[1,10] OF POSITION`, then for each element `[1,2] =`, `X: … Y: … Z:
/// …`, `W: … P: … R: …`.
fn variables(bytes: &[u8]) -> Result<Frames, BadNumber> {
    let mut frames = Frames::default();
    let mut section = Section::Other;
    let mut element = None;
    let mut values: [Option<f64>; 6] = [None; 6];
    for (start, line) in lines(bytes) {
        let text = line.trim_ascii_start();
        if text.starts_with(b"[*") || text.starts_with(b"[") && text.contains(&b'$') {
            let name = memchr::memchr(b'$', text).map_or(&b""[..], |at| &text[at..]);
            let word = name.iter().take_while(|b| !b.is_ascii_whitespace()).count();
            section = match &name[..word] {
                b"$MNUTOOL" => Section::Tools,
                b"$MNUFRAME" => Section::Frames,
                _ => Section::Other,
            };
            element = None;
        } else if section == Section::Other {
            continue;
        } else if text.starts_with(b"[") {
            element = index(text).filter(|(group, _)| *group == 1);
            values = [None; 6];
        }
        let Some((_, number)) = element else { continue };
        // behind a comment in quotes
        let text = memchr::memrchr(b'\'', text).map_or(text, |quote| &text[quote + 1..]);
        coordinates(text, start + line.len() - text.len(), &mut values)?;
        if let [Some(x), Some(y), Some(z), Some(w), Some(p), Some(r)] = values {
            let pose = pose_of_angles([x, y, z, w, p, r]);
            let place = match section {
                Section::Tools => &mut frames.tools,
                _ => &mut frames.frames,
            };
            place.insert(number, pose);
            element = None;
        }
    }
    Ok(frames)
}

/// 1 and 2 of `[1,2] =`.
pub(super) fn index(text: &[u8]) -> Option<(u32, u32)> {
    let close = memchr::memchr(b']', text)?;
    let inside = std::str::from_utf8(&text[1..close]).ok()?;
    let (group, number) = inside.split_once(',')?;
    Some((group.trim().parse().ok()?, number.trim().parse().ok()?))
}

/// The values behind `X:`, `Y:`, … of a line.
pub(super) fn coordinates(
    text: &[u8],
    start: usize,
    values: &mut [Option<f64>; 6],
) -> Result<(), BadNumber> {
    for colon in memchr::memchr_iter(b':', text) {
        let Some(key) = colon.checked_sub(1).map(|at| text[at]) else {
            continue;
        };
        let alone = colon < 2 || text[colon - 2].is_ascii_whitespace();
        let Some(slot) = b"XYZWPR".iter().position(|&k| alone && k == key) else {
            continue;
        };
        let largest = if slot < 3 { LARGEST } else { MOST_ANGLE_DEG };
        let value = value(&text[colon + 1..], start + colon + 1, largest)?;
        values[slot] = value.or(values[slot]);
    }
    Ok(())
}

/// The number that a text begins with; `None` where stars stand for it.
pub(super) fn value(text: &[u8], start: usize, largest: f64) -> Result<Option<f64>, BadNumber> {
    let blanks = text.iter().take_while(|b| b.is_ascii_whitespace()).count();
    let rest = &text[blanks..];
    let ends = |b: &&u8| b.is_ascii_whitespace() || **b == b',';
    let length = rest.iter().take_while(|b| !ends(b)).count();
    // uninitialised: it is not known
    if rest[..length].contains(&b'*') {
        return Ok(None);
    }
    let value = number::parse(&rest[..length]).filter(|value| value.abs() <= largest);
    let at = start + blanks;
    value.map(Some).ok_or(BadNumber { at, length })
}

/// `Tool Frame`, `Jog Frame`, `User Frame`, then a row of six numbers and a comment for each; rows
/// count from 1.
fn list(bytes: &[u8]) -> Frames {
    let mut frames = Frames {
        rounded: true,
        ..Frames::default()
    };
    let mut section = Section::Other;
    let (mut number, mut seen) = (0, [false; 2]);
    for (_, line) in lines(bytes) {
        if let Some(found) = heading(line) {
            section = found;
            number = 0;
            let again = match section {
                Section::Tools => std::mem::replace(&mut seen[0], true),
                Section::Frames => std::mem::replace(&mut seen[1], true),
                Section::Other => false,
            };
            // a second list is that of another group
            if again {
                section = Section::Other;
            }
            continue;
        }
        let Some(values) = row(line) else { continue };
        number += 1;
        let Some(values) = values else { continue };
        match section {
            Section::Tools => frames.tools.insert(number, pose_of_angles(values)),
            Section::Frames => frames.frames.insert(number, pose_of_angles(values)),
            Section::Other => None,
        };
    }
    frames
}

fn heading(line: &[u8]) -> Option<Section> {
    match line.trim_ascii() {
        b"Tool Frame" => Some(Section::Tools),
        b"User Frame" => Some(Section::Frames),
        b"Jog Frame" => Some(Section::Other),
        _ => None,
    }
}

/// The six numbers that a line starts with; `Some(None)` where stars stand for some.
#[allow(clippy::option_option)]
fn row(line: &[u8]) -> Option<Option<[f64; 6]>> {
    let mut words = line
        .split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty());
    let mut values = [0.0; 6];
    let mut known = true;
    for value in &mut values {
        let word = words.next()?;
        if word.iter().all(|&b| b == b'*') {
            known = false;
        } else {
            *value = number::parse(word).filter(|value| value.abs() <= LARGEST)?;
        }
    }
    Some(known.then_some(values))
}
