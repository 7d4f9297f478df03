//! `MOC.cfg` of an ABB controller: where the base stands, and what moves it.
//!
//! ```text
//! base(e) = base frame of the ROBOT, moved by e along x of the base frame of the SINGLE that `base_frame_coordinated` names
//! ```
//!
//! Lengths are metres, angles radians, orientations quaternions; what is left out is 0, and 1 for
//! `u0`.

use super::external::Read;
use crate::geometry::{Pose, Quaternion};
use crate::model::external::{
    Coordinates, ExternalAxes, Follows, Positioner, RotaryAxis, TrackAxis,
};
use crate::program::Source;
use crate::task::{Failure, text};
use std::collections::BTreeMap;

/// Names of external axes in programs, by logical axis from 7.
const AXES: [&str; 6] = ["eax_a", "eax_b", "eax_c", "eax_d", "eax_e", "eax_f"];
/// A quaternion's length may differ from 1 by so much.
const UNIT: f64 = 1e-3;

/// One entry of a section.
struct Entry {
    section: String,
    /// Line, from 1.
    line: usize,
    values: BTreeMap<String, String>,
}

impl Entry {
    fn text(&self, key: &str) -> Option<&str> {
        let found = self.values.get(key).map(String::as_str);
        found.filter(|text| !text.is_empty())
    }

    fn name(&self) -> &str {
        self.text("name").unwrap_or_default()
    }
}

struct File<'a> {
    source: &'a Source,
    entries: Vec<Entry>,
}

/// Words of a line: what is in quotes is one.
fn words(line: &str) -> Vec<String> {
    let mut all = Vec::new();
    let (mut word, mut quoted, mut any) = (String::new(), false, false);
    for c in line.chars() {
        match c {
            '"' => {
                quoted = !quoted;
                any = true;
            }
            c if c.is_whitespace() && !quoted => {
                if any {
                    all.push(std::mem::take(&mut word));
                }
                any = false;
            }
            c => {
                word.push(c);
                any = true;
            }
        }
    }
    if any {
        all.push(word);
    }
    all
}

/// Whether a line is none that another one goes on in: an empty one, a comment, a section, an entry.
fn is_no_rest(line: &str) -> bool {
    line.is_empty()
        || line.starts_with('#')
        || line.starts_with("-name ")
        || !line.starts_with('-') && line.ends_with(':')
}

/// An entry that is not whole: numbers that it lacks would count as 0.
fn cut_off(source: &Source, line: usize, how: &str) -> Failure {
    let message =
        format!("{how} its entry is not whole: the file is cut off or was joined of parts");
    let hint =
        "copy it anew from the folder SYSPAR of the backup; the last line ends in a line break";
    Failure::at(source, line, 1, None, message, hint)
}

impl<'a> File<'a> {
    fn read(source: &'a Source) -> Result<Self, Failure> {
        let text = text(source)?;
        if !text
            .trim_start()
            .to_ascii_uppercase()
            .starts_with("MOC:CFG")
        {
            let (message, hint) = (
                "this is no MOC.cfg: it does not begin with `MOC:CFG_`",
                "it is in the folder SYSPAR of a backup",
            );
            return Err(Failure::at(source, 1, 1, None, message, hint));
        }
        let mut entries: Vec<Entry> = Vec::new();
        let (mut section, mut goes_on) = (String::new(), false);
        let last = text.lines().count();
        for (line, number) in text.lines().zip(1..) {
            let line = line.trim();
            if goes_on && is_no_rest(line) {
                return Err(cut_off(source, number - 1, "the line goes on (`\\`), and"));
            }
            let (line, continues) = match line.strip_suffix('\\') {
                Some(line) => (line, true),
                None => (line, false),
            };
            let heads = !goes_on && !line.starts_with(['-', '#']) && line.ends_with(':');
            if heads {
                line.trim_end_matches(':').clone_into(&mut section);
            } else if line.starts_with('-') || goes_on {
                if !goes_on {
                    entries.push(Entry {
                        section: section.clone(),
                        line: number,
                        values: BTreeMap::new(),
                    });
                }
                if line.matches('"').count() % 2 == 1 {
                    return Err(cut_off(source, number, "a quoted word has no end, and"));
                }
                if number == last && !continues && !text.ends_with(['\n', '\r']) {
                    return Err(cut_off(source, number, "the line has no end, and"));
                }
                if let Some(entry) = entries.last_mut() {
                    put(entry, &words(line));
                }
            }
            goes_on = continues;
        }
        if goes_on {
            return Err(cut_off(source, last, "the line goes on (`\\`), and"));
        }
        Ok(Self { source, entries })
    }

    fn of<'b>(&'b self, section: &'b str) -> impl Iterator<Item = &'b Entry> {
        self.entries.iter().filter(move |e| e.section == section)
    }

    fn named<'b>(&'b self, section: &'b str, name: &str) -> Option<&'b Entry> {
        self.of(section)
            .find(|entry| entry.name().eq_ignore_ascii_case(name))
    }

    fn refuse(&self, entry: &Entry, message: String, hint: &str) -> Failure {
        Failure::at(self.source, entry.line, 1, None, message, hint)
    }

    fn number(&self, entry: &Entry, key: &str, without: f64) -> Result<f64, Failure> {
        let Some(text) = entry.text(key) else {
            if entry.values.contains_key(key) {
                let message = format!("{key} of {} has no value", entry.name());
                return Err(self.refuse(entry, message, "write its number, or leave it out"));
            }
            return Ok(without);
        };
        let number = text.parse().ok().filter(|n: &f64| n.is_finite());
        number.ok_or_else(|| {
            let message = format!("{key} of {} is `{text}`: this is no number", entry.name());
            self.refuse(entry, message, "")
        })
    }

    fn frame(&self, entry: &Entry) -> Result<Pose, Failure> {
        let mut numbers = [0.0; 7];
        for (slot, key) in numbers.iter_mut().zip([
            "pos_x",
            "pos_y",
            "pos_z",
            "orient_u0",
            "orient_u1",
            "orient_u2",
            "orient_u3",
        ]) {
            let without = f64::from(u8::from(key == "orient_u0"));
            *slot = self.number(entry, &format!("base_frame_{key}"), without)?;
        }
        let [x, y, z, u @ ..] = numbers;
        let quaternion = Quaternion(u);
        let length = quaternion.norm();
        if (length - 1.0).abs() > UNIT {
            let message = format!(
                "base_frame_orient of {} has the length {length:.6}; it may differ from 1 by \
                 {UNIT}",
                entry.name()
            );
            return Err(self.refuse(entry, message, ""));
        }
        Ok(Pose::from_parts([x, y, z], quaternion.normalized()))
    }

    /// The single axis of a unit.
    fn single(&self, unit: &str) -> Option<&Entry> {
        let of_unit = self.named("MECHANICAL_UNIT", unit);
        let name = of_unit.and_then(|u| u.text("use_single_0").or_else(|| u.text("use_single")));
        self.named("SINGLE", name.unwrap_or(unit))
    }

    /// The name of a single's axis in programs.
    fn axis(&self, single: &Entry) -> Option<&'static str> {
        let joint = self.named("JOINT", single.text("use_joint")?)?;
        let logical: usize = joint.text("logical_axis")?.parse().ok()?;
        AXES.get(logical.checked_sub(7)?).copied()
    }

    /// Smallest and largest value of a single, metres or radians.
    fn bounds(&self, single: &Entry) -> Result<[f64; 2], Failure> {
        let joint = single.text("use_joint").unwrap_or_default();
        let is_own = |arm: &&Entry| {
            let type_of = arm.text("use_arm_type").unwrap_or_default();
            let names = [arm.name(), type_of];
            names
                .iter()
                .any(|name| !name.is_empty() && (*name == joint || *name == single.name()))
        };
        let arm = self.of("ARM").find(is_own);
        let arm = arm.filter(|arm| arm.text("upper_joint_bound").is_some());
        let Some(arm) = arm else {
            let message = format!(
                "nothing says how far {} goes: no ARM of the joint `{joint}` with \
                 upper_joint_bound",
                single.name()
            );
            let hint = "describe the axis with `poseshift profile add-track` or `add-positioner`";
            return Err(self.refuse(single, message, hint));
        };
        Ok([
            self.number(arm, "lower_joint_bound", 0.0)?,
            self.number(arm, "upper_joint_bound", 0.0)?,
        ])
    }
}

/// Keys with their values; a key without one is a switch.
fn put(entry: &mut Entry, words: &[String]) {
    let mut key: Option<String> = None;
    for word in words {
        let named = word
            .strip_prefix('-')
            .filter(|rest| rest.starts_with(|c: char| c.is_ascii_alphabetic()));
        if let Some(named) = named {
            entry.values.insert(named.to_owned(), String::new());
            key = Some(named.to_owned());
        } else if let Some(key) = key.take() {
            entry.values.insert(key, word.clone());
        }
    }
}

/// Reads where a robot stands and what moves it.
///
/// # Errors
/// No such robot, or one without the numbers that are needed, by line.
pub(super) fn read(
    source: &Source,
    robot: Option<&str>,
    axis: Option<&str>,
) -> Result<Read, Failure> {
    let file = File::read(source)?;
    let robots: Vec<&Entry> = file.of("ROBOT").collect();
    let names: Vec<&str> = robots.iter().map(|entry| entry.name()).collect();
    let found = match robot {
        Some(name) => robots.iter().find(|e| e.name().eq_ignore_ascii_case(name)),
        None if robots.len() == 1 => robots.first(),
        None => None,
    };
    let Some(found) = found else {
        let message = match robot {
            Some(name) => format!("there is no robot `{name}`"),
            None => format!("there are {} robots", robots.len()),
        };
        let hint = format!("say which with --robot: {}", names.join(", "));
        return Err(Failure::at(source, 1, 1, None, message, hint));
    };
    let base = file.frame(found)?;
    let from = |entry: &Entry| format!("{}:{}", source.name, entry.line);
    let mut notes = vec![format!(
        "kinematics.base: ROBOT {} ({})",
        found.name(),
        from(found)
    )];
    let mut axes = ExternalAxes::default();
    if let Some(unit) = found.text("base_frame_coordinated") {
        let single = file.single(unit).ok_or_else(|| {
            let message = format!(
                "{unit} moves the base of {}, and is no SINGLE",
                found.name()
            );
            let hint = "describe its axes with `poseshift profile add-track`";
            file.refuse(found, message, hint)
        })?;
        let name = file.axis(single).or(axis).ok_or_else(|| {
            let message = format!("nothing says which logical axis {unit} is");
            file.refuse(
                single,
                message,
                "say it with --axis: eax_a is logical axis 7",
            )
        })?;
        let frame = file.frame(single)?;
        let [min_m, max_m] = file.bounds(single)?;
        notes.push(format!(
            "{name}: SINGLE {} ({}): +{name} along x of its base frame",
            single.name(),
            from(single)
        ));
        axes.track.push(TrackAxis {
            axis: name.to_owned(),
            direction: frame.rotation.axis(0),
            up: frame.rotation.axis(2),
            zero_m: 0.0,
            min_m,
            max_m,
            coordinates: Coordinates::World,
            pulses_per_mm: None,
        });
    }
    let carriers: Vec<&str> = robots
        .iter()
        .filter_map(|robot| robot.text("base_frame_coordinated"))
        .collect();
    for unit in file.of("MECHANICAL_UNIT") {
        let name = unit.name();
        if carriers
            .iter()
            .any(|carrier| carrier.eq_ignore_ascii_case(name))
        {
            continue;
        }
        let Some(single) = file.single(name) else {
            continue;
        };
        let kind = single.text("use_single_type").unwrap_or_default();
        let mechanics = file.named("SINGLE_TYPE", kind);
        let mechanics = mechanics.and_then(|kind| kind.text("mechanics"));
        let (Some("FREE_ROT"), Some(own)) = (mechanics, file.axis(single)) else {
            notes.push(format!(
                "left out: the unit {name} ({}): the file does not say that it turns about an \
                 axis, or which logical axis it is",
                from(single)
            ));
            continue;
        };
        let [min_rad, max_rad] = file.bounds(single)?;
        notes.push(format!(
            "{own}: SINGLE {} ({}): it rotates about z of its base frame (not verified)",
            single.name(),
            from(single)
        ));
        axes.positioners.push(Positioner {
            name: name.to_owned(),
            follows: Follows::Frame,
            axes: vec![RotaryAxis {
                axis: own.to_owned(),
                at: file.frame(single)?,
                sign: 1.0,
                zero_rad: 0.0,
                min_rad,
                max_rad,
                pulses_per_deg: None,
            }],
            plate: Pose::identity(),
            points: BTreeMap::new(),
        });
    }
    Ok(Read {
        base: Some(base),
        axes,
        notes,
    })
}
