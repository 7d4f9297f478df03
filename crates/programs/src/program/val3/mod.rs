//! Staubli VAL 3: project folders of project (.pjx), data (.dtx) and programs (.pgx).
//!
//! Targets stand in the data, moves in the programs. A point is x, y, z in mm and rx, ry, rz in
//! degrees, `R = Rx · Ry · Rz`, in its frame, which has fathers up to `world`; tools hang on
//! `flange` or on other tools. Of both generations of XML, before s7 and since. Numbers that a
//! value leaves out are zero: where a correction needs them they are put in, in the order of the
//! format, and reported. `world` is the crossing of axes 1 and 2: `kinematics.base` of the profile
//! places the arm there.
//!
//! Shoulder, elbow and wrist tell the posture of joint moves: `lefty` is the wrist centre in front
//! of axis 1, `epositive` j3 ≥ 0, `wpositive` j5 ≥ 0. What is left out or `same` stays as it is in
//! the posture before; `free` may be either. Straight moves and arcs keep the posture. There are no
//! data of rotations: each joint is taken near the present one.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! # Limits
//!
//! A frame that the running program changes anywhere is unknown everywhere. Fields of structures of
//! the user's own are not followed.

mod arrays;
mod code;
mod data;
mod deciding;
mod drive;
mod frames;
mod insert;
mod moves;
mod numbers;
mod project;
mod reader;
mod remarks;
mod targets;

use super::drive::Step;
use super::kit::not_this_language;
use super::notation;
use super::script::Script;
use super::{
    About, Configuration, Deciding, Inserted, Insertions, Language, Layout, Marker, Posture,
    ReadError, Role, Settings, Shape, Source,
};
use crate::geometry::Pose;
use data::{JOINTS, POSE, SIDES};
use project::FileKind;

/// Staubli VAL 3.
#[derive(Debug)]
pub struct Val3;

static ABOUT: About = About {
    id: "val3",
    name: "Staubli VAL 3",
    extensions: &["pgx", "dtx", "pjx"],
    rewrites: &[
        "points of the .dtx that movej, movel and movec go to: single, in arrays and collections, \
         of libraries that are given",
        "numbers that a point leaves out: put in, in the order of the format, and reported one by \
         one",
        "shoulder, elbow and wrist, where a joint crosses zero or the arm changes sides",
        "joints (jointRx), also written out in a program: movej({0,-20,110,0,90,0},tool,mdesc)",
    ],
    leaves: &[
        "programs, unless moves are put between theirs; project files",
        "tools, frames, transformations, motion descriptors, points that no move goes to",
        "moves to here, herej, and to what the running program computes: reported",
        "comments, line ends, encoding, order and blanks of attributes",
    ],
    refuses: &[
        "projects in inches (millimeterUnit=\"false\"), points of arms with four axes",
        "frames that the running program changes, tools that only it knows",
        "points that are not in the files: local values, libraries that are not given",
    ],
    has: "Project, Database or Programs of VAL 3",
};

/// Bits of a variant from here on: sides that are free.
const FREE: u8 = 3;

impl Language for Val3 {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn recognises(&self, source: &Source) -> bool {
        project::kind_of(&source.bytes).is_some()
    }

    fn script(&self, sources: &[Source], _: &Settings) -> Result<Script, ReadError> {
        let is_strange = |source: &&Source| !self.recognises(source);
        if let Some(strange) = sources.iter().find(is_strange) {
            return Err(not_this_language(&ABOUT, strange));
        }
        Ok(reader::script(sources, project::read(sources)?))
    }

    fn turns_through_middle(&self) -> bool {
        true
    }

    fn pose_roles(&self, layout: Layout) -> &'static [Role] {
        &notation::WITH_ANGLES[..6 + stated(layout).count()]
    }

    fn has_framed_positions(&self) -> bool {
        true
    }

    fn pose_of(&self, _: Layout, numbers: &[f64]) -> Pose {
        pose_of(std::array::from_fn(|i| numbers[i]))
    }

    fn write_pose(&self, _: Layout, pose: &Pose, numbers: &mut [f64]) {
        notation::write_turning_angles(pose, numbers);
    }

    fn configuration(&self, layout: Layout, numbers: &[f64]) -> Configuration {
        let mut found = Configuration {
            kept: [0, 1, 2].map(|side| layout.variant & 0b1001 << side == 0),
            ..Configuration::default()
        };
        let half = |negative: bool| {
            Some(if negative {
                (f64::NEG_INFINITY, 0.0)
            } else {
                (0.0, f64::INFINITY)
            })
        };
        for (number, side) in numbers[6..].iter().zip(stated(layout)) {
            let is_second = *number > 0.5;
            match side {
                0 => found.behind_axis_1 = Some(is_second),
                1 => found.joints[2] = half(is_second),
                _ => found.joints[4] = half(is_second),
            }
        }
        found
    }

    fn update_configuration(
        &self,
        layout: Layout,
        before: &Posture,
        after: &Posture,
        numbers: &mut [f64],
    ) {
        // the joint whose border each side hangs on
        const JOINT: [usize; 3] = [0, 2, 4];
        let second = |posture: &Posture, side: usize| match side {
            0 => posture.behind_axis_1,
            side => posture.joints_rad[JOINT[side]] < 0.0,
        };
        for (number, side) in numbers[6..].iter_mut().zip(stated(layout)) {
            let is = |posture: &Posture| second(posture, side) == (*number > 0.5);
            if notation::truly_changes(before, after, JOINT[side], is) {
                *number = 1.0 - *number;
            }
        }
    }

    fn write_configuration(&self, _: Layout, _: usize, value: f64, old: &[u8], out: &mut Vec<u8>) {
        let is_same = |words: &&[&str; 2]| words.iter().any(|word| word.as_bytes() == old);
        let words = SIDES.iter().map(|(_, words)| words).find(is_same);
        let words = words.expect("sides that are stated are known words");
        out.extend_from_slice(words[usize::from(value > 0.5)].as_bytes());
    }

    fn around_missing(&self, layout: Layout, index: usize) -> (String, &'static str) {
        let names = match layout.shape {
            Shape::Pose => POSE,
            Shape::Joints => JOINTS,
        };
        (format!(" {}=\"", names[index]), "\"")
    }

    fn insert(&self, into: &Insertions) -> Inserted {
        insert::insert(into)
    }

    fn drive(&self, steps: &[Step], _: &Settings) -> Option<String> {
        Some(drive::drive(steps))
    }

    /// A comment inside the data, or behind `begin` of the first program.
    fn deciding(&self) -> Option<&'static Deciding> {
        Some(&deciding::MANNER)
    }

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        let (bytes, end) = (&source.bytes, source.line_end());
        if project::kind_of(bytes) == Some(FileKind::Programs)
            && let Some(at) = project::behind_begin(bytes)
        {
            return (at, super::kit::comments(source, marker, "// "));
        }
        let mut text = [end, b"<!--", end].concat();
        for line in marker.lines() {
            text.extend_from_slice(line.as_bytes());
            text.extend_from_slice(end);
        }
        text.extend_from_slice(b"-->");
        (data::start_of_data(bytes).unwrap_or(bytes.len()), text)
    }
}

/// The sides of the arm that a layout tells.
fn stated(layout: Layout) -> impl Iterator<Item = usize> {
    (0..usize::from(FREE)).filter(move |side| layout.variant & 1 << side != 0)
}

/// The pose of `x y z rx ry rz`.
fn pose_of(numbers: [f64; 6]) -> Pose {
    notation::pose_of_turning_angles(numbers)
}

#[cfg(test)]
mod tests;
