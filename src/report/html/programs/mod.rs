//! The pages of `compensate` and `check`: a program, where the real tool goes with it, and what
//! should be looked at.

mod check;
mod compensate;
mod drawing;

pub(crate) use check::check_page;
use compensate::{Compensated, add_written, compensate_page};
pub use drawing::Drawing;

use super::cell::Path;
use super::chart::Tone;
use super::numbers::{Number, fixed};
use super::page::{Level, Page};
use crate::check::Meshes;
use crate::check::cell::Cell as CellFile;
use crate::check::trace::Traced;
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Vector, sub};
use crate::model::profile::Profile;
use crate::program::{Program, Source};
use std::collections::BTreeMap;

/// Items that a page holds; of more it holds those with the largest numbers.
const MOST_ITEMS: usize = 20_000;
/// Samples of all paths together.
const SAMPLES: usize = 24_000;
/// Letters of a program's line that are shown.
const LETTERS: usize = 96;

/// What a page of a program draws besides its numbers.
struct Scenery<'a> {
    /// The robot.
    pub profile: &'a Profile,
    /// What stands around it.
    pub cell: Option<&'a CellFile>,
    /// Its meshes.
    pub meshes: &'a Meshes,
}

/// A line of a program as it stands in its file.
struct Lines<'a> {
    sources: &'a [Source],
}

impl Lines<'_> {
    fn text(&self, file: usize, offset: usize) -> String {
        let bytes = &self.sources[file].bytes;
        let offset = offset.min(bytes.len());
        let from = bytes[..offset].iter().rposition(|b| *b == b'\n');
        let from = from.map_or(0, |at| at + 1);
        let to = bytes[offset..]
            .iter()
            .position(|b| matches!(b, b'\n' | b'\r'));
        let to = to.map_or(bytes.len(), |at| offset + at);
        let text = String::from_utf8_lossy(&bytes[from..to]);
        let text = text.trim();
        match text.char_indices().nth(LETTERS) {
            Some((end, _)) => format!("{}\u{2026}", &text[..end]),
            None => text.to_owned(),
        }
    }
}

/// The rows to keep of those that there are: all, or the ones of the largest measure in their
/// order.
fn kept(mut rows: Vec<usize>, measure: &dyn Fn(usize) -> f64) -> Vec<usize> {
    if rows.len() > MOST_ITEMS {
        rows.sort_by(|a, b| measure(*b).total_cmp(&measure(*a)));
        rows.truncate(MOST_ITEMS);
        rows.sort_unstable();
    }
    rows
}

/// Where external axes stand at the end of a move, as far as the profile lists any.
fn stand_of(program: &Program, motion: usize) -> Option<&[f64]> {
    let frame = &program.frames[program.moves[motion].frame];
    frame.stand.as_ref().map(|stand| &*stand.values)
}

fn thinned(rows: &[usize], all: usize, what: &str) -> String {
    if rows.len() == all {
        return String::new();
    }
    format!(
        "{} of {all} {what} are listed, those with the largest error; --json has all.",
        rows.len()
    )
}

/// A coordinate of a deviation, mm: to the tenth of a micrometre, or to four digits.
fn deviation(mm: f64) -> Number {
    fixed(mm, if mm.abs() < 0.1 { 4 } else { 3 })
}

/// What becomes of a traced place: in space, moved with the part.
fn moved(offset: Option<&Pose>, wanted_m: Vector) -> Vector {
    offset.map_or(wanted_m, |offset| offset.transform(wanted_m))
}

/// The deviations of a program's path from the wanted one. `item` is the row of a move's target;
/// `offset` moves what is wanted.
fn path(
    name: &str,
    tone: Tone,
    traced: &[Traced],
    offset: Option<&Pose>,
    item: &dyn Fn(&Traced) -> Option<usize>,
) -> Path {
    let (mut at, mut by) = (Vec::new(), Vec::new());
    let (mut starts, mut items) = (Vec::new(), Vec::new());
    let every = traced.len().div_ceil(SAMPLES).max(1);
    let mut last = 0;
    for (k, one) in traced.iter().enumerate() {
        let thinned = every > 1 && k % every != 0;
        if !one.continues || k == 0 {
            starts.push(items.len());
        } else if thinned {
            continue;
        }
        last = item(one).unwrap_or(last);
        for place in &one.places {
            let wanted = moved(offset, place.wanted_m);
            at.extend(wanted.map(|x| fixed(mm_from_m(x), 2)));
            by.extend(sub(place.real_m, wanted).map(|x| deviation(mm_from_m(x))));
            items.push(last);
        }
    }
    Path {
        name: name.into(),
        tone,
        graded: true,
        off: false,
        at: Some(at),
        like: None,
        starts,
        items,
        by: Some(by),
    }
}

/// The wanted path, which shares the places of one with deviations.
fn wanted(like: usize) -> Path {
    Path {
        name: "wanted".into(),
        tone: Tone::Wanted,
        graded: false,
        off: false,
        at: None,
        like: Some(like),
        starts: Vec::new(),
        items: Vec::new(),
        by: None,
    }
}

/// Maker, model and serial number.
pub(super) fn robot_name(profile: &Profile) -> String {
    let serial = profile.serial.as_ref();
    let serial = serial.map_or(String::new(), |serial| format!(", serial {serial}"));
    format!("{} {}{serial}", profile.manufacturer, profile.model)
}

fn lead(page: &mut Page, inputs: &[String], outputs: &[String], profile: &Profile, hash: &str) {
    let shown = |names: &[String]| match names {
        [] => String::new(),
        [one] => one.clone(),
        [first, rest @ ..] => format!("{first} and {} more", rest.len()),
    };
    let mut line = shown(inputs);
    if !outputs.is_empty() {
        line += &format!(" \u{2192} {}", shown(outputs));
    }
    page.lead.push(line);
    let short = hash.get(..12).unwrap_or(hash);
    page.lead
        .push(format!("{}; profile sha256 {short}", robot_name(profile)));
}

/// An answer of findings: errors by name, warnings, or neither.
fn answer(findings: &[Finding], good: &str, bad: &str) -> (Level, String) {
    let count = |severity| findings.iter().filter(|f| f.severity == severity).count();
    let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
    let counted = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    match (errors, warnings) {
        (0, 0) => (Level::Good, good.to_owned()),
        (0, _) => (
            Level::Warning,
            format!("{good}; {}", counted(warnings, "warning")),
        ),
        _ => {
            let mut names: BTreeMap<&str, usize> = BTreeMap::new();
            for finding in findings.iter().filter(|f| f.severity == Severity::Error) {
                *names.entry(finding.id).or_default() += 1;
            }
            let mut names: Vec<(usize, &str)> = names.into_iter().map(|(id, n)| (n, id)).collect();
            names.sort_by_key(|(n, _)| std::cmp::Reverse(*n));
            let named: Vec<String> = names.iter().map(|(n, id)| format!("{n} {id}")).collect();
            let text = format!("{bad}{}: {}", counted(errors, "error"), named.join(", "));
            (Level::Error, text)
        }
    }
}

fn title_of(inputs: &[String]) -> String {
    let name = |path: &String| {
        let path = path.replace('\\', "/");
        path.rsplit('/').next().unwrap_or(&path).to_owned()
    };
    match inputs {
        [] => "no program".into(),
        [one] => name(one),
        [first, rest @ ..] => format!("{} and {} more", name(first), rest.len()),
    }
}

fn join(sentences: &[&str]) -> String {
    let said: Vec<&str> = sentences
        .iter()
        .copied()
        .filter(|s| !s.is_empty())
        .collect();
    said.join(" ")
}

/// The row with the largest size.
pub(super) fn largest(sizes: &[Number]) -> usize {
    let worst = sizes
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.0.total_cmp(&b.1.0));
    worst.map_or(0, |(row, _)| row)
}

fn tools_of(profile: &Profile, program: &Program) -> Vec<Pose> {
    let only = profile
        .tools
        .values()
        .next()
        .filter(|_| profile.tools.len() == 1);
    program
        .tools
        .iter()
        .map(|tool| {
            let known = profile.tools.get(tool.name.as_ref() as &str);
            tool.flange_from_tool
                .or(known.map(|t| t.flange_from_tool))
                .or(only.map(|t| t.flange_from_tool))
                .unwrap_or_else(Pose::identity)
        })
        .collect()
}
