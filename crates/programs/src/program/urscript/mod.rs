//! Universal Robots `URScript`: .script, .urscript.
//!
//! A pose is `p[x, y, z, rx, ry, rz]`, metres and a rotation vector in radians; joints are `[q0, …,
//! q5]`, radians, or `d2r(…)` of degrees. The pose is that of the tool of the last `set_tcp` in the
//! controller's base; `pose_trans(feature, pose)` puts it in a feature. A variable that is assigned
//! once stands for its value; each literal that is assigned to one with several is a target of its
//! own. Parameters are what calls give them, results what functions return, an element of a
//! list any of its poses or, by a number in a list that is written once, the one.
//!
//! `get_inverse_kin(pose, qnear=joints)`: the pose is the target, the joints tell which of its
//! solutions is meant and stay. Joints that are computed so keep the tool that is set where they
//! are computed. `p[a[0], a[1], a[2] + 0.1, a[3], a[4], a[5]]` of a target a that moves go to is a
//! displacement of it, too, and what is computed from targets in another manner stands next to them
//! by something. `pose_trans(target, offset)` of a target that other moves go to, and `pose_add`,
//! are displacements of it.
//!
//! ```text
//! text → tokens → reader (statements, values: syntax) → variables, uses (what names and literals are) → translate
//! ```
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! # Limits
//!
//! A file stands for itself, or with those that have the functions that it calls. The pendant opens .urp, not .script: a compensated script is sent
//! or run as a script. A literal that is given to a function outside the file alone is no target:
//! nothing tells whether it moves there, and it stays with a warning (`pose-passed-to-routine`). One
//! that moves go to, in a list or structure too, is refused (`target-passed-to-routine`), unless the
//! function is one of the language or of a server (`server.name()`): those move nothing. What `qnear` holds is read where it is a literal or a
//! variable that is assigned once.

mod asked;
mod calls;
mod common;
mod composed;
mod deciding;
mod drive;
mod expressions;
mod files;
mod goals;
mod literals;
mod numbers;
mod reader;
mod rotation;
mod sniff;
mod steps;
mod syntax;
mod threads;
mod tokens;
mod translate;
mod uses;
mod variables;
mod verbs;

use super::insert::Manner;
use super::kit::{judge_base, not_this_language};
use super::notation;
use super::script::{Builder, Script};
use super::{
    About, Deciding, Inserted, Insertions, Language, Layout, Marker, ReadError, Role, Settings,
    Source, Step,
};
use crate::geometry::Pose;
use crate::geometry::units::DEG;
use common::Common;
use files::Text;
use reader::Reader;
use translate::translate;

/// Universal Robots `URScript`.
#[derive(Debug)]
pub struct UrScript;

static ABOUT: About = About {
    id: "urscript",
    name: "Universal Robots URScript",
    extensions: &["script", "urscript", "urs"],
    rewrites: &[
        "poses in movej, movel, movep, movec, and in get_inverse_kin, pose_trans and pose_add \
         there",
        "poses of variables, parameters, results and lists that moves go to",
        "joints in movej, movel, movep, servoj",
    ],
    leaves: &[
        "qnear of get_inverse_kin, features, set_tcp, loads, speeds, blends",
        "comments, annotations, strings, line ends, encoding",
        "speedj, speedl, force_mode and other motion without a target",
    ],
    refuses: &[
        "targets with expressions of numbers, such as pi/2; variables whose parts are assigned",
        "features and tools that only the running program knows",
        "targets that functions outside the file are given, servoing to poses",
        "conveyor tracking and path offsets",
    ],
    has: "function, move, set_tcp or assignment",
};

/// Calls are written again with a pose written out.
const MANNER: Manner = Manner {
    forbids: |_| None,
    external: None,
    longest: usize::MAX,
    comment: b'#',
};

impl Language for UrScript {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn is_in_metres(&self) -> bool {
        true
    }

    fn recognises(&self, source: &Source) -> bool {
        sniff::recognises(&source.bytes)
    }

    fn accepts(&self, source: &Source) -> bool {
        self.recognises(source)
            || Reader::new(source)
                .read()
                .is_ok_and(|reader| reader.is_program())
    }

    fn script(&self, sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
        let mut script = script(sources, settings)?;
        judge_base(
            &mut script,
            sources,
            settings,
            ("base-not-of-controller", false),
        );
        Ok(script)
    }

    fn pose_roles(&self, _: Layout) -> &'static [Role] {
        &notation::WITH_ANGLES[..6]
    }

    fn most_orientation(&self, layout: Layout) -> f64 {
        if in_degrees(layout) != 0 {
            rotation::MOST_ANGLE / DEG
        } else {
            rotation::MOST_ANGLE
        }
    }

    fn decimals(&self, role: Role, millimetre_decimals: usize) -> usize {
        match role {
            // metres; and radians, of which a millionth is a thousandth of a millimetre at one
            // metre
            Role::Position | Role::Orientation | Role::Joint => millimetre_decimals + 3,
            Role::Configuration => 0,
        }
    }

    fn pose_of(&self, layout: Layout, numbers: &[f64]) -> Pose {
        rotation::pose(std::array::from_fn(|i| numbers[i]), in_degrees(layout))
    }

    fn write_pose(&self, layout: Layout, pose: &Pose, numbers: &mut [f64]) {
        let present = std::array::from_fn(|i| numbers[i]);
        numbers.copy_from_slice(&rotation::numbers(pose, present, in_degrees(layout)));
    }

    fn joint_units(&self, layout: Layout, _: &Settings) -> [f64; 6] {
        std::array::from_fn(|at| syntax::unit(in_degrees(layout), at))
    }

    fn insert(&self, into: &Insertions) -> Inserted {
        MANNER.insert(into)
    }

    fn drive(&self, steps: &[Step], _: &Settings) -> Option<String> {
        Some(drive::drive(steps))
    }

    fn deciding(&self) -> Option<&'static Deciding> {
        Some(&deciding::MANNER)
    }

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        sniff::mark(source, marker)
    }
}

/// Which numbers of a target are written as `d2r(…)`, bit by bit.
fn in_degrees(layout: Layout) -> u8 {
    layout.variant
}

/// Each file, or several together where their functions call each other.
fn script(sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
    let mut builder = Builder::default();
    let mut common = Common::new(&mut builder.script, settings.gravity_m_s2);
    let mut alone = Vec::with_capacity(sources.len());
    for source in sources {
        let reader = Reader::new(source).read()?;
        if !reader.is_program() {
            return Err(not_this_language(&ABOUT, source));
        }
        alone.push(reader.parsed);
    }
    for together in files::together(&alone) {
        if let [file] = together[..] {
            let parsed = std::mem::take(&mut alone[file]);
            translate(&mut builder, &mut common, &Text::of(sources, file), parsed);
        } else {
            let (text, joined) = Text::joined(sources, &together);
            let reader = Reader::new(&joined).of_files(text.starts()).read()?;
            translate(&mut builder, &mut common, &text, reader.parsed);
        }
    }
    Ok(builder.finish())
}

#[cfg(test)]
mod tests;
